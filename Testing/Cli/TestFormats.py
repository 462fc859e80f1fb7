#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""reliefshade's pictures of other programs: channels by name, alpha, orientation, heights as colours."""

import os
import struct
import unittest
import zlib

from Reliefshade import GDAL, Case, Picture, needsGdalTools

FLAT = ("--sun", "0,90", "--height-scale", "0")
WHITE = (255, 255, 255)


def rows(function, width=16, height=12):
    return [[float(function(x, y)) for x in range(width)] for y in range(height)]


def hill(x, y):
    return (x * 7 + y * 5 + x * y) % 11


class Formats(Case):
    def shade(self, *words):
        """Heights count as the file has them, where no other scale is given."""
        usual = () if "--height-scale" in words else ("--height-scale", "1")
        return super().shade(*words, *usual)


class Channels(Formats):
    def setUp(self):
        super().setUp()
        self.hills()
        self.expected = self.shade("hills.asc")
        self.depth = rows(hill)
        self.colour = rows(lambda x, y: x / 16)
        self.one = rows(lambda x, y: 1)

    def layers(self, **more):
        view = {"V.Combined." + c: self.colour for c in "RGB"}
        return {**view, "V.Combined.A": self.one, **more}

    def test_depth_beside_colours_is_found(self):
        for channels in (
            {"Z": self.depth},
            {"height": self.depth, "R": self.one, "G": self.one, "B": self.one},
            self.layers(**{"V.Depth.Z": self.depth}),
        ):
            self.exr(channels, "in.exr")
            self.assertEqual(self.shade("in.exr"), self.expected)

    def test_channels_by_name_and_number(self):
        self.exr(self.layers(**{"V.Depth.Z": self.depth, "V.Mist.Z": self.colour}), "in.exr")
        line = self.bad(1, ["in.exr", "V.Depth.Z, V.Mist.Z", "--channel"], "in.exr", "o.png")
        self.assertLess(len(line), 200)
        for name in ("V.Depth.Z", "Depth.Z"):
            self.assertEqual(self.shade("in.exr", "--channel", name), self.expected)
            self.assertEqual(self.shade("in.exr", "--channel", name, "--part", "1"), self.expected)
        # Bands are counted as the file has them, alpha among them: R, G, B, A, then by name.
        self.assertEqual(self.shade("in.exr", "--band", "5"), self.expected)
        self.bad(1, ["in.exr", "band 7", "only 6"], "in.exr", "o.png", "--band", "7")
        line = self.bad(1, ['no channel "Z"', "V.Depth.Z"], "in.exr", "o.png", "--channel", "Z")
        self.assertLess(len(line), 200)
        self.bad(1, 'no part "W", only 1', "in.exr", "o.png", "--part", "W")
        self.bad(1, ["in.exr", "part 2"], "in.exr", "o.png", "--part", "2", "--channel", "Depth.Z")
        self.exr({c: self.one for c in "RGBA"}, "rgb.exr")
        self.bad(1, ["3 components", "--band"], "rgb.exr", "o.png")

    def test_alpha_hides_and_nothing_is_far_away(self):
        alpha = rows(lambda x, y: 0 if x < 3 else 1)
        self.exr({"A": alpha, "Z": self.depth, "R": self.one, "G": self.one, "B": self.one}, "in.exr")
        picture = self.shade("in.exr")
        self.assertEqual([picture[x, 5][3] for x in (0, 2, 3, 15)], [0, 0, 255, 255])
        # Where Blender sees nothing, depth is 1e10.
        self.exr({"Z": rows(lambda x, y: 1e10 if x < 3 else hill(x, y))}, "far.exr")
        picture = self.shade("far.exr")
        self.assertEqual([picture[x, 5][3] for x in (0, 2, 3, 15)], [0, 0, 255, 255])
        picture = self.shade("far.exr", "--nodata", "none", "--height-scale", "0")
        self.assertEqual(picture[0, 5][3], 255)

    @needsGdalTools
    def test_rasters_have_bands(self):
        self.tiff("hills.asc", "in.tif", "-a_srs", "EPSG:32632")
        self.bad(1, ["in.tif", "--band"], "in.tif", "o.png", "--channel", "Z")


class Alpha(Formats):
    def test_colours_are_multiplied_by_alpha_once(self):
        self.plane(width=16)
        alphas = [0.0, 0.25, 0.5, 1.0]
        alpha = rows(lambda x, y: alphas[x // 4], 16, 16)
        # A white disc over white is white; a picture that is darker than its alpha is so.
        for brightness in (1.0, 0.25):
            colour = rows(lambda x, y: brightness * alphas[x // 4], 16, 16)
            self.exr({"A": alpha, "R": colour, "G": colour, "B": colour}, "disc.exr")
            picture = self.shade("plane.asc", *FLAT, "--texture", "disc.exr", "--diffuse", "1,1,1")
            for x in range(16):
                share = alphas[x // 4]
                linear = share * brightness + 1 - share
                encoded = 255 * (1.055 * linear ** (1 / 2.4) - 0.055)
                self.assertLessEqual(abs(picture[x, 8][0] - encoded), 1, (x, brightness))

    def test_tiff_says_whether_alpha_has_multiplied(self):
        self.plane(width=4)
        for extra, stored in ((1, 128), (2, 255)):
            pixels = [[0] * 4 + [stored] * 3 + [128] + [255] * 8] * 4  # half transparent white
            self.plainTiff(pixels, "alpha.tif", 4, [(338, [extra])])
            picture = self.shade("plane.asc", *FLAT, "--texture", "alpha.tif", "--diffuse", "1,1,1")
            self.assertEqual({picture[x, y] for x in range(4) for y in range(4)}, {(255,) * 4})
            # Over black half of the light is left, whichever way it is stored.
            picture = self.shade("plane.asc", *FLAT, "--texture", "alpha.tif", "--diffuse", "0,0,0")
            self.assertEqual([picture[x, 2][0] for x in (0, 1, 3)], [0, 188, 255])

    @needsGdalTools
    def test_alpha_of_floating_point_textures(self):
        self.plane(width=4)
        pixels = [[255, 255, 255, 0] + [255, 255, 255, 128] + [255] * 8] * 4
        self.plainTiff(pixels, "bytes.tif", 4, [(338, [2])])
        for kind, greatest in (("Float32", 1), ("Float64", 1), ("UInt16", 65535)):
            self.tool("gdal_translate", "-q", "-ot", kind, "-scale", 0, 255, 0, greatest, "bytes.tif", "t.tif")
            picture = self.shade("plane.asc", *FLAT, "--texture", "t.tif", "--diffuse", "0,0,0")
            self.assertEqual([picture[x, 2][0] for x in (0, 1, 3)], [0, 188, 255], kind)


def stored(rows, orientation):
    """The rows as a file with that orientation has them."""
    if orientation >= 5:
        rows = [list(row) for row in zip(*rows)]
    if orientation in (2, 3, 7, 8):
        rows = [row[::-1] for row in rows]
    if orientation in (3, 4, 6, 7):
        rows = rows[::-1]
    return rows


def exif(orientation):
    """A TIFF with that tag and no pixels."""
    entry = struct.pack(">HHIHH", 274, 3, 1, orientation, 0)
    return b"MM\0*" + struct.pack(">IH", 8, 1) + entry + bytes(4)


class Orientation(Formats):
    def setUp(self):
        super().setUp()
        self.hills()
        self.upright = [[hill(x, y) for x in range(16)] for y in range(12)]
        self.expected = self.shade("hills.asc")

    def test_heights_of_tiff(self):
        for orientation in range(1, 9):
            for order in "<>":
                rows = stored(self.upright, orientation)
                self.plainTiff(rows, "in.tif", 1, [(274, [orientation])], order)
                self.assertEqual(self.shade("in.tif"), self.expected, (orientation, order))
        self.plainTiff(self.upright, "in.tif", 1, [(274, [9])])
        self.assertEqual(self.shade("in.tif"), self.expected)

    def test_masks_textures_and_environments(self):
        mask = [[0 if x < 2 or y == 3 else 255 for x in range(16)] for y in range(12)]
        self.grid(mask, "mask.asc")
        colours = [[(16 * x, 20 * y, 99) for x in range(16)] for y in range(12)]
        self.ppm(colours, "texture.ppm")
        words = [("--mask", "mask.asc"), (*FLAT, "--texture", "texture.ppm"), ("--env", "texture.ppm")]
        expected = [self.shade("hills.asc", *choice) for choice in words]
        for orientation in (2, 6, 7):
            self.plainTiff(stored(mask, orientation), "mask.tif", 1, [(274, [orientation])])
            pixels = [[c for pixel in row for c in pixel] for row in stored(colours, orientation)]
            self.plainTiff(pixels, "texture.tif", 3, [(274, [orientation])])
            for choice, wanted in zip(words, expected):
                name = os.path.splitext(choice[-1])[0] + ".tif"
                self.assertEqual(self.shade("hills.asc", *choice[:-1], name), wanted)

    @needsGdalTools
    def test_exif(self):
        for orientation in (1, 3, 6, 8):
            self.plainTiff(stored(self.upright, orientation), "in.tif")
            # The lossy picture, with and without what turns it: the same pixels.
            self.tool("gdal_translate", "-q", "-of", "JPEG", "in.tif", "in.jpg")
            with open(self.path("in.jpg"), "rb") as stream:
                data = stream.read()
            values = self.values("in.jpg")
            width = 12 if orientation > 4 else 16
            lossy = [values[k : k + width] for k in range(0, len(values), width)]
            block = b"Exif\0\0" + exif(orientation)
            with open(self.path("turned.jpg"), "wb") as stream:
                stream.write(data[:2] + struct.pack(">HH", 0xFFE1, len(block) + 2) + block + data[2:])
            upright = lossy
            for _ in range({1: 0, 3: 2, 6: 1, 8: 3}[orientation]):  # quarter turns, clockwise
                upright = [list(row) for row in zip(*upright[::-1])]
            self.grid(upright, "lossy.asc")
            self.assertEqual(self.shade("turned.jpg"), self.shade("lossy.asc"), orientation)
            # PNG
            self.tool("gdal_translate", "-q", "-of", "PNG", "in.tif", "in.png")
            with open(self.path("in.png"), "rb") as stream:
                data = stream.read()
            block = b"eXIf" + exif(orientation)
            chunk = struct.pack(">I", len(block) - 4) + block + struct.pack(">I", zlib.crc32(block))
            with open(self.path("turned.png"), "wb") as stream:
                stream.write(data[:33] + chunk + data[33:])
            self.assertEqual(self.shade("turned.png"), self.expected, orientation)

    @unittest.skipUnless(GDAL, "built without GDAL")
    def test_a_georeference_places_rows_as_they_are_stored(self):
        self.plainTiff(self.upright, "plain.tif", 1, [(274, [6])])
        with open(self.path("plain.tfw"), "w") as stream:
            stream.write("1\n0\n0\n-1\n0.5\n11.5\n")
        self.assertEqual(self.shade("plain.tif"), self.expected)


class Encodings(Formats):
    def encoded(self, codes, name):
        """A picture of three bytes for each code, and alpha: None is no data."""
        def pixel(code):
            return [0] * 4 if code is None else [code >> 16, code >> 8 & 255, code & 255, 255]

        pixels = [[byte for code in row for byte in pixel(code)] for row in codes]
        self.plainTiff(pixels, name, 4, [(338, [2])])

    def test_heights_in_three_bytes(self):
        # From the Dead Sea to the top of the world, and a sample without data.
        heights = [[-430 + 9278 * ((x * 7 + y * 5) % 16) / 15 for x in range(16)] for y in range(12)]
        for encoding, offset, step in (("terrarium", 32768, 1 / 256), ("terrain-rgb", 10000, 0.1)):
            codes = [[round((height + offset) / step) for height in row] for row in heights]
            exact = [[code * step - offset for code in row] for row in codes]
            codes[5][6], exact[5][6] = None, "nan"
            self.encoded(codes, "in.tif")
            self.grid(exact, "exact.asc")
            words = ("--height-scale", "0.001")
            expected = self.shade("exact.asc", *words)
            self.assertEqual(expected[6, 5][3], 0)
            self.assertEqual(self.shade("in.tif", "--encoding", encoding, *words), expected)
            # Nodata is a height in metres.
            nodata = ("--encoding", encoding, "--nodata", exact[0][0])
            self.assertEqual(self.shade("in.tif", *nodata, *words)[0, 0][3], 0)
        for fragment in ("3 components", "--encoding", "--band"):
            self.assertLess(len(self.bad(1, fragment, "in.tif", "o.png")), 200)
        self.bad(1, "band 2", self.hills(), "o.png", "--encoding", "terrarium")
        self.bad(2, "--encoding", "in.tif", "o.png", "--encoding", "mapbox")

    @needsGdalTools
    def test_palettes(self):
        with open(self.path("palette.vrt"), "w") as stream:
            stream.write('<VRTDataset rasterXSize="16" rasterYSize="12"><VRTRasterBand dataType="Byte" '
                         'band="1"><ColorInterp>Palette</ColorInterp><ColorTable>')
            stream.write("".join('<Entry c1="%d" c2="9" c3="200" c4="255"/>' % k for k in range(16)))
            stream.write("</ColorTable><SimpleSource><SourceFilename relativeToVRT=\"1\">hills.asc"
                         "</SourceFilename></SimpleSource></VRTRasterBand></VRTDataset>")
        expected = self.shade(self.hills())
        self.tool("gdal_translate", "-q", "-of", "PNG", "palette.vrt", "palette.png")
        line = self.bad(1, ["palette.png", "palette", "--band 1"], "palette.png", "o.png")
        self.assertLess(len(line), 200)
        self.assertEqual(self.shade("palette.png", "--band", "1"), expected)


if __name__ == "__main__":
    unittest.main()
