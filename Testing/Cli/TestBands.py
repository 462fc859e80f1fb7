# SPDX-License-Identifier: BSD-3-Clause
"""What is in the pictures' files, and how it is stored: components, no data, compression."""

import os
import signal
import struct
import sys
import unittest

try:
    import resource
except ImportError:
    resource = None  # Windows has none

from Reliefshade import GDAL, Case, Picture, needsGdal, needsGdalTools

HOLE = 3


class Bands(Case):
    def components(self, *words, more=()):
        """The picture of a run as it comes, or with more words, beside that of all four components."""
        whole = self.shade(*words)
        self.good(words[0], "shaded.png", *words[1:], *more)
        return Picture(self.path("shaded.png")), whole

    def assertPart(self, picture, whole, places):
        """A picture has these components of another one, exactly."""
        self.assertEqual(picture.components, len(places))
        for k, place in enumerate(places):
            for row, other in zip(picture.rows, whole.rows):
                self.assertEqual(row[k :: len(places)], other[place::4])

    def test_grey_scenes_are_grey(self):
        grey = ("--sun", "300,20", "--ks", "0.3", "--base", "0.1,0.1,0.1")
        for words in ((), grey, ("--preset", "sky-dome"), ("--preset", "multidirectional")):
            picture, whole = self.components(self.hills(), *words)
            self.assertPart(picture, whole, [0])
            self.assertGreater(len(set(whole.rows[5])), 3)
            for row in whole.rows:
                self.assertEqual(row[0::4], row[1::4])
                self.assertEqual(row[0::4], row[2::4])

    def test_what_has_colour_keeps_it(self):
        self.ppm([[(9, 9, 9)]], "grey.ppm")
        with open(self.path("tint.txt"), "w") as stream:
            stream.write("0 10 20 30\n10 200 210 220\n")
        for words in (("--diffuse", "0.5,0.5,0.4"), ("--base", "0,0,0.1"), ("--specular", "1,1,0"),
                      ("--sun", "300,20,1,1,1,0.9"), ("--point", "5,5,9,1,1,0.9,1"),
                      ("--preset", "sun-and-sky"), ("--texture", "grey.ppm"),
                      ("--tint", "tint.txt")):
            picture, whole = self.components(self.hills(), *words)
            self.assertPart(picture, whole, [0, 1, 2])
            self.bad(2, ["--bands", "not grey", "auto or rgb"], "hills.asc", "o.png", *words,
                     "--bands", "grey")

    def test_alpha_where_data_lack(self):
        self.assertPart(*self.components(self.hills(nodata=HOLE)), [0, 3])
        self.assertPart(*self.components("hills.asc", "--diffuse", "1,0.9,0.8"), [0, 1, 2, 3])
        self.assertPart(*self.components("hills.asc", "--nodata", "none"), [0])
        self.assertPart(*self.components("hills.asc", "--nodata", "-1"), [0])
        # By a mask alone.
        self.hills()
        self.grid([[int(x > 2) for x in range(16)] for _ in range(12)], "mask.asc")
        picture, whole = self.components("hills.asc", "--mask", "mask.asc")
        self.assertPart(picture, whole, [0, 3])
        self.assertEqual(picture[0, 0], (0, 0))

    def test_bands_that_are_asked_for(self):
        self.hills(nodata=HOLE)
        for more, places in ((("--bands", "grey"), [0]), (("--bands", "gray"), [0]),
                             (("--bands", "rgb"), [0, 1, 2]),
                             (("--bands", "grey", "--nodata-out", "alpha"), [0, 3]),
                             (("--bands", "rgb", "--nodata-out", "alpha"), [0, 1, 2, 3])):
            self.assertPart(*self.components("hills.asc", more=more), places)
        self.bad(2, ["--bands", "grae", "did you mean"], "hills.asc", "o.png", "--bands", "grae")
        if GDAL:
            self.bad(2, ["--nodata-out", "rgba has an alpha"], "hills.asc", "o.tif", "--bands",
                     "rgba", "--nodata-out", "value")

    def test_formats_get_what_they_hold(self):
        # JPEG has no alpha, OpenEXR gets all four.
        self.hills(nodata=HOLE)
        self.good("hills.asc", "o.jpg")
        with open(self.path("o.jpg"), "rb") as stream:
            data = stream.read()
        frame = max(data.find(b"\xff\xc0"), data.find(b"\xff\xc2"))
        self.assertEqual(data[frame + 9], 1)
        self.good("hills.asc", "o.exr")
        with open(self.path("o.exr"), "rb") as stream:
            header = stream.read(400)
        for channel in b"ABGR":
            self.assertIn(bytes((0, channel, 0)), b"\0" + header)

    def wide(self):
        """Heights of more rows than are shaded at a time, which no strip and no tile divides."""
        width, height = 3000, 1501
        data = struct.pack("<%df" % width, *((x * 37 % 91) / 7 for x in range(width)))
        with open(self.path("wide.raw"), "wb") as stream:
            for y in range(height):
                stream.write(data[4 * (y % 50) :] + data[: 4 * (y % 50)])
        with open(self.path("wide.hdr"), "w") as stream:
            stream.write("ENVI\nsamples=%d\nlines=%d\nbands=1\ndata type=4\ninterleave=bsq\n"
                         "byte order=0\nmap info = {UTM, 1, 1, 500000, 4000000, 1, 1, 11, North}\n"
                         % (width, height))
        return self.tiff("wide.raw", "wide.tif")

    def whole(self, *words):
        """Shaded at once, as the picture beside a file of layers is."""
        self.good(words[0], "whole.png", *words[1:], "--bands", "rgba", "--layers",
                  "illumination,l.exr")
        return Picture(self.path("whole.png"))

    @needsGdalTools
    def test_bands_of_rows_are_one_picture(self):
        self.wide()
        for words in (("--sun", "315,10"), ("--exposure", "auto", "--depth", "3")):
            self.assertEqual(self.shade("wide.tif", *words, "--threads", "1"),
                             self.whole("wide.tif", *words))

    @needsGdalTools
    def test_bands_of_rows_in_tiff(self):
        whole = self.whole(self.wide())
        grey = [value for row in whole.rows for value in row[0::4]]
        for words in ((), ("--compress", "deflate"), ("--compress", "lzw", "--threads", 2),
                      ("--co", "TILED=YES"), ("--co", "TILED=YES", "--compress", "deflate"),
                      ("--bands", "rgba"), ("--bands", "rgba", "--compress", "lzw")):
            self.good("wide.tif", "out.tif", *words)
            self.assertEqual(list(self.values("out.tif")), grey, words)
            if "deflate" in words and "--co" not in words:
                # No block takes its place twice.
                self.tool("gdal_translate", "-q", "-co", "COMPRESS=DEFLATE", "-co", "PREDICTOR=2",
                          "-co", "BLOCKYSIZE=%d" % self.info("out.tif")["bands"][0]["block"][1],
                          "out.tif", "again.tif")
                self.assertLess(os.path.getsize(self.path("out.tif")),
                                1.02 * os.path.getsize(self.path("again.tif")) + 4096)


    @needsGdalTools
    def test_overviews(self):
        self.wide()
        for words in ((), ("--compress", "deflate"), ("--bands", "rgba", "--co", "TILED=YES"),
                      ("--type", "float")):
            self.good("wide.tif", "out.tif", "--overviews", *words)
            self.good("wide.tif", "plain.tif", *words)
            self.assertEqual(self.values("out.tif"), self.values("plain.tif"))
            band = self.info("out.tif")["bands"][0]
            self.assertEqual([level["size"] for level in band["overviews"]],
                             [[1500, 751], [750, 376], [375, 188]])
            self.assertNotIn("overviews", self.info("plain.tif")["bands"][0])
            self.tool("gdaladdo", "-q", "-r", "average", "plain.tif", 2, 4, 8)
            for level in range(3):
                copies = [self.tool("gdal_translate", "-q", "-oo", "OVERVIEW_LEVEL=%d" % level, name,
                                    "copy.tif") or self.values("copy.tif")
                          for name in ("out.tif", "plain.tif")]
                self.assertEqual(*copies)
            self.assertEqual(sorted(os.listdir(self.folder)).count("out.tif.ovr"), 0)
        # A small picture needs none, and other formats have none.
        self.hills()
        self.good("hills.asc", "out.tif", "--overviews")
        self.assertNotIn("overviews", self.info("out.tif")["bands"][0])
        self.bad(2, ["--overviews", "TIFF"], "hills.asc", "out.png", "--overviews")

    @unittest.skipIf(sys.platform == "win32", "no limits on files")
    @needsGdalTools
    def test_a_disk_that_is_full_on_the_way(self):
        self.wide()
        before = sorted(os.listdir(self.folder))

        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (2000000, 2000000))

        for words in ((), ("--bands", "rgba"), ("--co", "TILED=YES"), ("--threads", 1)):
            self.bad(1, ["out.tif", "cannot be written"], "wide.tif", "out.tif", *words,
                     preexec_fn=limit)
            self.assertEqual(sorted(os.listdir(self.folder)), before)


class Tiff(Case):
    def image(self, name):
        found = self.info(name)
        return found, [band["colorInterpretation"] for band in found["bands"]]

    @needsGdalTools
    def test_components(self):
        self.hills(nodata=HOLE)
        self.good("hills.asc", "out.tif")
        found, meaning = self.image("out.tif")
        self.assertEqual(meaning, ["Gray", "Alpha"])
        self.assertNotIn("COMPRESSION", found["metadata"].get("IMAGE_STRUCTURE", {}))
        self.good("hills.asc", "out.tif", "--nodata", "none")
        self.assertEqual(self.image("out.tif")[1], ["Gray"])
        self.good("hills.asc", "out.tif", "--bands", "rgba", "--nodata", "none")
        self.assertEqual(self.image("out.tif")[1], ["Red", "Green", "Blue", "Alpha"])
        self.good("hills.asc", "out.tif", "--diffuse", "1,0.9,0.8", "--nodata", "none")
        self.assertEqual(self.image("out.tif")[1], ["Red", "Green", "Blue"])

    @needsGdalTools
    def test_no_data_by_value(self):
        # A wall's shadow is black.
        rows = [[5 if x == 8 else HOLE if y == 1 and x < 3 else 0 for x in range(16)]
                for y in range(12)]
        self.grid(rows, "wall.asc", nodata=HOLE)
        words = ("--depth", "0", "--sun", "270,20")
        whole = self.shade("wall.asc", *words)
        self.assertIn((0, 0, 0, 255), [whole[x, 5] for x in range(16)])
        for more in (("--nodata-out", "value"), ("--bands", "grey"), ("--bands", "rgb")):
            self.good("wall.asc", "out.tif", *words, *more)
            for band in self.image("out.tif")[0]["bands"]:
                self.assertEqual(band["noDataValue"], 0)
                got = self.values("out.tif", band["band"])
                for y in range(12):
                    for x in range(16):
                        colour, _, _, alpha = whole[x, y]
                        self.assertEqual(got[16 * y + x], max(colour, 1) if alpha else 0)
        # Where all samples have data, none gives way.
        self.good("wall.asc", "out.tif", *words, "--nodata", "none", "--nodata-out", "value")
        self.assertNotIn("noDataValue", self.image("out.tif")[0]["bands"][0])
        self.assertIn(0, self.values("out.tif"))
        # In floating point it is NaN.
        self.good("wall.asc", "out.tif", *words, "--type", "float")
        found, meaning = self.image("out.tif")
        self.assertEqual((meaning, found["bands"][0]["type"]), (["Gray"], "Float32"))
        got = self.values("out.tif")
        self.assertNotEqual(got[16], got[16])
        self.assertEqual(got[0], got[0])

    @needsGdalTools
    def test_compression_and_creation_options(self):
        self.hills()
        self.good("hills.asc", "none.tif")
        for word in ("deflate", "lzw", "zstd"):
            if word == "zstd" and "ZSTD" not in self.tool("gdalinfo", "--format", "GTiff"):
                continue
            self.good("hills.asc", "out.tif", "--compress", word)
            found = self.info("out.tif")
            self.assertEqual(found["metadata"]["IMAGE_STRUCTURE"]["COMPRESSION"], word.upper())
            self.assertEqual(self.values("out.tif"), self.values("none.tif"))
        self.good("hills.asc", "out.tif", "--co", "TILED=YES", "--co", "BLOCKXSIZE=16", "--co",
                  "BLOCKYSIZE=32", "--co", "COMPRESS=LZW", "--compress", "deflate")
        found = self.info("out.tif")
        self.assertEqual(found["bands"][0]["block"], [16, 32])
        self.assertEqual(found["metadata"]["IMAGE_STRUCTURE"]["COMPRESSION"], "LZW")
        self.assertEqual(self.values("out.tif"), self.values("none.tif"))
        # Layers are stored so, too.
        self.good("hills.asc", "out.png", "--layers", "normals", "--compress", "deflate")
        found = self.info("out-normals.tif")
        self.assertEqual(found["metadata"]["IMAGE_STRUCTURE"]["COMPRESSION"], "DEFLATE")

    @needsGdal
    def test_creation_options_that_gdal_refuses(self):
        self.hills()
        with open(self.path("old.tif"), "w") as stream:
            stream.write("before")
        self.bad(1, ["old.tif", "FOO"], "hills.asc", "old.tif", "--co", "FOO=BAR")
        self.bad(1, ["old.tif", "TILED"], "hills.asc", "old.tif", "--co", "TILED=PERHAPS")
        self.bad(1, ["old.tif", "NAME=VALUE"], "hills.asc", "old.tif", "--co", "TILED")
        self.bad(1, ["old.tif", "17"], "hills.asc", "old.tif", "--co", "TILED=YES", "--co",
                 "BLOCKXSIZE=17")
        self.bad(2, ["--compress", "zip"], "hills.asc", "old.tif", "--compress", "zip")
        with open(self.path("old.tif")) as stream:
            self.assertEqual(stream.read(), "before")
        self.assertEqual(sorted(os.listdir(self.folder)), ["hills.asc", "old.tif"])
        for words in (("--co", "TILED=YES"), ("--compress", "lzw"), ("--format", "cog"),
                      ("--nodata-out", "value")):
            self.bad(2, [words[0], "TIFF"], "hills.asc", "o.png", *words)
        # Layers are TIFF, but how OUTPUT tells samples without data is not about them.
        self.bad(2, ["--nodata-out", "TIFF"], "hills.asc", "o.png", "--layers", "illumination",
                 "--nodata-out", "value")
        # A file beside would keep the name that is only its own until all is written.
        for option in ("TFW=YES", "APPEND_SUBDATASET=YES"):
            self.bad(1, ["old.tif", option.split("=")[0]], "hills.asc", "old.tif", "--co", option)
        self.assertEqual(sorted(os.listdir(self.folder)), ["hills.asc", "old.tif"])

    @needsGdalTools
    def test_cloud_optimized(self):
        if "COG" not in self.tool("gdalinfo", "--formats"):
            self.skipTest("this GDAL writes no cloud-optimized GeoTIFF")
        self.tiff(self.grid([[(x * 7 + y * 5) % 11 for x in range(600)] for y in range(520)],
                            "large.asc", nodata=HOLE), "large.tif", "-a_srs", "EPSG:32632")
        self.good("large.tif", "plain.tif")
        self.good("large.tif", "out.tif", "--format", "cog", "--co", "BLOCKSIZE=128")
        found = self.info("out.tif")
        self.assertEqual(found["metadata"]["IMAGE_STRUCTURE"]["LAYOUT"], "COG")
        self.assertEqual(found["bands"][0]["block"], [128, 128])
        self.assertGreater(len(found["bands"][0]["overviews"]), 1)
        self.assertEqual(found["geoTransform"], self.info("large.tif")["geoTransform"])
        for band in (1, 2):
            self.assertEqual(self.values("out.tif", band), self.values("plain.tif", band))
        self.bad(1, ["out.tif", "BLOCKYSIZE"], "large.tif", "out.tif", "--format", "cog", "--co",
                 "BLOCKYSIZE=128")
        self.good("large.tif", "out.tif", "--format", "cog", "--compress", "deflate")
        self.assertEqual(self.info("out.tif")["metadata"]["IMAGE_STRUCTURE"]["PREDICTOR"], "2")
        for band in (1, 2):
            self.assertEqual(self.values("out.tif", band), self.values("plain.tif", band))
        # GDAL makes a mask of alpha there.
        self.good("large.tif", "out.tif", "--format", "cog", "--co", "COMPRESS=JPEG", "--bands",
                  "rgba")
        self.assertEqual(len(self.info("out.tif")["bands"]), 3)
        self.assertFalse([name for name in os.listdir(self.folder) if ".tmp" in name])

    @needsGdalTools
    def test_tiff_without_a_place(self):
        self.png([[x * y for x in range(16)] for y in range(12)], "p.png")
        self.good("p.png", "out.tif", "--compress", "lzw", "--height-scale", "1")
        found = self.info("out.tif")
        self.assertNotIn("geoTransform", found)
        whole = self.shade("p.png", "--height-scale", "1")
        self.assertEqual(list(self.values("out.tif")),
                         [value for row in whole.rows for value in row[0::4]])


if __name__ == "__main__":
    unittest.main()
