# SPDX-License-Identifier: BSD-3-Clause
"""reliefshade takes over what rasters say about themselves, and keeps it."""

import math
import os
import struct
import unittest

from Reliefshade import JACKSBORO, Case, Picture, needsGdal, needsGdalTools, srgb

VRT = """<VRTDataset rasterXSize="%d" rasterYSize="%d">%s
<VRTRasterBand dataType="Float32" band="1">%s<SimpleSource>
<SourceFilename relativeToVRT="1">%s</SourceFilename></SimpleSource></VRTRasterBand>
</VRTDataset>"""


def metres(latitude, a, f1):
    """Metres per degree of longitude and latitude: the ellipse's arcs, by differences of points."""
    b = a * (1 - 1 / f1)

    def point(degrees):
        beta = math.atan(b / a * math.tan(math.radians(degrees)))
        return a * math.cos(beta), b * math.sin(beta)

    south, north = point(latitude - 5e-4), point(latitude + 5e-4)
    return math.radians(point(latitude)[0]), math.dist(south, north) / 1e-3


def netcdf(path, axes, values):
    """Writes a classic NetCDF file: axes by name as values and unit, and a variable z over them."""

    def text(words):
        data = words.encode()
        return struct.pack(">i", len(data)) + data + b"\0" * (-len(data) % 4)

    names = list(axes)
    shape = names[::-1]  # latitude varies slowest
    attributes = {name: text("units") + struct.pack(">i", 2) + text(axes[name][1]) for name in axes}
    blocks = [struct.pack(">%dd" % len(axes[name][0]), *axes[name][0]) for name in names]
    blocks.append(struct.pack(">%df" % sum(map(len, values)), *sum(values, [])))

    def header(begin):
        out = b"CDF\1" + struct.pack(">iii", 0, 10, len(names))
        out += b"".join(text(name) + struct.pack(">i", len(axes[name][0])) for name in names)
        out += struct.pack(">iiii", 0, 0, 11, len(names) + 1)
        for k, block in enumerate(blocks):
            own = k < len(names)
            ids = [k] if own else [names.index(name) for name in shape]
            out += text(names[k] if own else "z") + struct.pack(">i", len(ids))
            out += struct.pack(">%di" % len(ids), *ids)
            out += struct.pack(">ii", 12, 1) + attributes[names[k]] if own else bytes(8)
            out += struct.pack(">iii", 6 if own else 5, len(block), begin)
            begin += len(block)
        return out

    with open(path, "wb") as stream:
        stream.write(header(len(header(0))) + b"".join(blocks))


class Georeference(Case):
    @needsGdalTools
    def test_geotiff_keeps_transform_reference_system_and_nodata(self):
        hills = self.hills(nodata=0, size=30, corner=(376000, 3788000))
        self.tiff(hills, "in.tif", "-a_srs", "EPSG:32611", "-ot", "Int16")
        self.good("in.tif", "out.tif")
        before, after = self.info("in.tif"), self.info("out.tif")
        self.assertEqual(after["geoTransform"], before["geoTransform"])
        self.assertEqual(after["coordinateSystem"]["wkt"], before["coordinateSystem"]["wkt"])
        self.assertEqual(after["size"], before["size"])
        interpretations = [band["colorInterpretation"] for band in after["bands"]]
        self.assertEqual(interpretations, ["Gray", "Alpha"])
        heights, alpha = self.values("in.tif"), self.values("out.tif", 2)
        self.assertIn(0, heights)
        self.assertEqual([a == 0 for a in alpha], [h == 0 for h in heights])
        said = {name: text for name, text in after["metadata"][""].items()
                if name != "TIFFTAG_SOFTWARE" and not name.startswith("RELIEF_")}
        self.assertEqual(before["metadata"][""], said)  # area or point

    @needsGdalTools
    def test_pixel_is_point_is_kept(self):
        self.tiff(self.hills(), "in.tif", "-a_srs", "EPSG:32611", "-mo", "AREA_OR_POINT=Point")
        self.good("in.tif", "out.tif")
        before, after = self.info("in.tif"), self.info("out.tif")
        self.assertEqual(after["metadata"][""]["AREA_OR_POINT"], "Point")
        self.assertEqual(after["geoTransform"], before["geoTransform"])

    @needsGdalTools
    def test_layers_keep_it_too(self):
        self.good(JACKSBORO, "out.png", "--layers", "illumination")
        before, after = self.info(JACKSBORO), self.info("out-illumination.tif")
        self.assertEqual(after["geoTransform"], before["geoTransform"])
        self.assertEqual(after["coordinateSystem"]["wkt"], before["coordinateSystem"]["wkt"])

    @needsGdal
    def test_degrees_become_metres(self):
        x, y = metres((36.44625 + 36.73291666666) / 2, 6378137, 298.257223563)
        found = self.statistics(JACKSBORO)
        self.assertEqual(found["coordinates"], "geographic")
        sx, sy = map(float, found["spacing"].split())
        self.assertAlmostEqual(sx, x / 1200, places=4)
        self.assertAlmostEqual(sy, y / 1200, places=4)

    @needsGdalTools
    def test_degrees_are_those_of_the_ellipsoid(self):
        # EPSG:4267 is NAD27, on Clarke's ellipsoid of 1866.
        self.tiff(self.hills(size=0.01, corner=(10, 60)), "in.tif", "-a_srs", "EPSG:4267")
        x, y = metres(60 + 12 * 0.005, 6378206.4, 294.978698214)
        sx, sy = map(float, self.statistics("in.tif")["spacing"].split())
        self.assertAlmostEqual(sx, x * 0.01, places=3)
        self.assertAlmostEqual(sy, y * 0.01, places=3)

    def test_degrees_that_the_file_does_not_name(self):
        grid = self.hills(size=0.01, corner=(10, 60))
        result = self.run_(grid, "a.png")
        self.assertEqual(result.returncode, 0)
        self.assertEqual(len(result.stderr.splitlines()), 1)
        self.assertIn("--degrees", result.stderr)
        self.good(grid, "a.png", "--quiet")
        x, y = metres(60 + 12 * 0.005, 6378137, 298.257223563)
        sx, sy = map(float, self.statistics(grid, "--degrees")["spacing"].split())
        self.assertAlmostEqual(sx, x * 0.01, places=3)
        self.assertAlmostEqual(sy, y * 0.01, places=3)
        self.assertEqual(self.statistics(grid, "--degrees", "--spacing", "3")["spacing"], "3 3")

    @needsGdalTools
    def test_degrees_name_the_reference_system_of_the_output(self):
        self.good(self.hills(size=0.01, corner=(10, 60)), "out.tif", "--degrees", "--quiet")
        self.assertIn('ID["EPSG",4326]', self.info("out.tif")["coordinateSystem"]["wkt"])
        self.tiff("hills.asc", "utm.tif", "-a_srs", "EPSG:32611")
        self.bad(1, ["utm.tif", "--degrees"], "utm.tif", "out.png", "--degrees")

    def test_degrees_by_the_projection_file(self):
        grid = self.hills(size=0.01, corner=(10, 60))
        with open(self.path("hills.prj"), "w") as stream:
            stream.write(
                'GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137.0,'
                '298.257223563]],PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]]'
            )
        x, y = metres(60 + 12 * 0.005, 6378137, 298.257223563)
        sx, sy = map(float, self.statistics(grid)["spacing"].split())
        self.assertAlmostEqual(sx, x * 0.01, places=3)
        self.assertAlmostEqual(sy, y * 0.01, places=3)

    @needsGdalTools
    def test_map_units_become_metres(self):
        self.tiff(self.hills(size=10), "in.tif", "-a_srs", "EPSG:2263")  # US survey feet
        sx, sy = map(float, self.statistics("in.tif")["spacing"].split())
        self.assertAlmostEqual(sx, 12000 / 3937, places=6)
        self.assertAlmostEqual(sy, 12000 / 3937, places=6)

    @needsGdalTools
    def test_height_units_become_metres(self):
        self.hills()
        for unit, scale in (("ft", 0.3048), ("US survey foot", 1200 / 3937), ("m", 1)):
            with open(self.path("in.vrt"), "w") as stream:
                unitType = "<UnitType>%s</UnitType>" % unit
                stream.write(VRT % (16, 12, "", unitType, "hills.asc"))
            found = self.statistics("in.vrt", "--height-scale", "2")
            self.assertAlmostEqual(float(found["height-scale"]), 2 * scale, places=8)

    def vrt(self, transform, name="in.vrt", source="hills.asc", size=(16, 12)):
        """A raster of the source's samples at another place."""
        where = "<SRS>EPSG:32632</SRS><GeoTransform>%s</GeoTransform>" % ", ".join(
            "%.17g" % number for number in transform
        )
        with open(self.path(name), "w") as stream:
            stream.write(VRT % (*size, where, "", source))
        return name

    @needsGdalTools
    def test_sheared_rasters_are_refused(self):
        self.hills()
        for transform in ((0, 1, 0.1, 9, 0, -1), (0, 1, 0, 9, 0.1, -1), (0, 1, 0.2, 9, 0.2, 1)):
            self.bad(1, ["in.vrt", "gdalwarp -dstnodata"], self.vrt(transform), "out.png")

    @needsGdalTools
    def test_turned_rasters_have_the_light_of_the_map(self):
        # Turned by so many degrees clockwise, in samples of 10 x 10.
        self.hills()
        straight = self.vrt((500000, 10, 0, 5000000, 0, -10), "straight.vrt")
        for turn in (20, 90, 180, -60):
            c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
            turned = self.vrt((500000, 10 * c, -10 * s, 5000000, -10 * s, -10 * c))
            self.assertAlike(self.shade(straight, "--sun", "%g,25" % (300 - turn)),
                             self.shade(turned, "--sun", "300,25"))
            # A lamp at the middle of the sample in the fourth column of the fifth row.
            lamp = (500000 + 35 * c - 45 * s, 5000000 - 35 * s - 45 * c)
            self.assertAlike(self.shade(straight, "--point", "500035,4999955,60"),
                             self.shade(turned, "--point", "%.9g,%.9g,60" % lamp))
            self.good(turned, "out.tif")
            for got, wanted in zip(self.info("out.tif")["geoTransform"],
                                   self.info(turned)["geoTransform"]):
                self.assertAlmostEqual(got, wanted, places=6)
        # Turned by rounding only.
        tiny = self.vrt((500000, 10, 1e-13, 5000000, -1e-13, -10), "tiny.vrt")
        self.assertEqual(self.shade(straight), self.shade(tiny))
        # Other numbers for the samples' size may not shear it.
        self.shade(turned, "--spacing", "5")
        self.bad(1, ["in.vrt", "proportion"], turned, "out.png", "--spacing", "5,6")

    @needsGdalTools
    def test_textures_on_turned_heights(self):
        self.plane(width=12)
        c, s = math.cos(math.radians(30)), math.sin(math.radians(30))
        colours = [[(20 * x, 20 * y, 99) for x in range(12)] for y in range(12)]
        self.ppm(colours, "colours.ppm")
        whole = (500000, 10, 0, 5000000, 0, -10)
        turned = (500000, 10 * c, -10 * s, 5000000, -10 * s, -10 * c)
        words = ("--texture", "colours.tif", "--diffuse", "0,0,0")
        pictures = []
        for place in (whole, turned):
            heights = self.vrt(place, source="plane.asc", size=(12, 12))
            self.tool("gdal_translate", "-q", "-of", "VRT", "-a_srs", "EPSG:32632", "colours.ppm",
                      "place.vrt")
            where = "<GeoTransform>%s</GeoTransform>" % ", ".join("%.17g" % n for n in place)
            with open(self.path("place.vrt"), "r+") as stream:
                text = stream.read().replace("<VRTRasterBand", where + "<VRTRasterBand", 1)
                stream.seek(0)
                stream.write(text)
            self.tool("gdal_translate", "-q", "place.vrt", "colours.tif")
            pictures.append(self.shade(heights, *words))
            # Without a place of its own it is stretched over the heights, turned or not.
            pictures.append(self.shade(heights, "--texture", "colours.ppm", "--diffuse", "0,0,0"))
        for other in pictures[1:]:
            self.assertAlike(pictures[0], other)
        self.assertNotEqual(pictures[0][0, 0], pictures[0][11, 11])

    def assertAlike(self, one, other):
        worst = max(abs(a - b) for r, s in zip(one.rows, other.rows) for a, b in zip(r, s))
        self.assertLessEqual(worst, 1)

    @needsGdalTools
    def test_warnings(self):
        self.grid([[-9999, -9999, 5], [1, 2, 3]], "marked.asc")
        result = self.run_("marked.asc", "out.png")
        self.assertEqual(result.returncode, 0)
        for fragment in ("marked.asc: warning: ", "-9999 in 2 of 6 samples", "see --nodata"):
            self.assertIn(fragment, result.stderr)
        self.assertEqual(len(result.stderr.splitlines()), 1)
        self.good("marked.asc", "out.png", "--quiet")
        self.good("marked.asc", "out.png", "--nodata", "-9999")
        self.hills()
        with open(self.path("in.vrt"), "w") as stream:
            stream.write(VRT % (16, 12, "", "<UnitType>parasang</UnitType>", "hills.asc"))
        result = self.run_("in.vrt", "out.png")
        self.assertIn('"parasang", is not known; they are taken for metres', result.stderr)
        self.assertIn("see --height-scale", result.stderr)
        world = self.grid([[x * y for x in range(8)] for y in range(4)], "world.asc", size=45,
                          corner=(-180, -90))
        self.tiff(world, "world.tif", "-a_srs", "EPSG:4326")
        for line in self.run_("world.tif", "out.png").stderr.splitlines():
            self.assertNotIn("...", line)  # it is short enough to be whole
        self.assertIn("as long as at its centre", self.run_("world.tif", "out.png").stderr)
        self.good("world.tif", "out.png", "--spacing", "100")

    def test_messages_stay_short(self):
        folder = os.path.join(*(letter * 200 for letter in "abcde"))
        os.makedirs(self.path(folder))
        name = self.plane(name=os.path.join(folder, "marked.asc"))
        self.assertLessEqual(len(self.bad(1, "marked.asc: ", name, "out.png", "--band", "7")), 200)
        away = os.path.join(folder, "none", "out.tif")
        self.assertLessEqual(len(self.bad(1, "no directory", name, away)), 300)
        cut = os.path.join(folder, "cut.tif")
        with open(self.path(cut), "wb") as stream:
            stream.write(b"II*\0\x08\0\0\0\x09\0")
        self.assertLessEqual(len(self.bad(1, "cut.tif: ", cut, "out.png")), 300)

    @needsGdalTools
    def test_folders_that_are_data_sets(self):
        self.tiff(self.hills(), "in.tif", "-a_srs", "EPSG:32632")
        if "Zarr" not in self.tool("gdalinfo", "--formats"):
            self.skipTest("this GDAL writes no Zarr")
        self.tool("gdal_translate", "-q", "-of", "Zarr", "in.tif", "in.zarr")
        self.assertEqual(self.shade("in.zarr"), self.shade("in.tif"))
        os.mkdir(self.path("empty"))
        self.bad(1, ["empty", "is a directory"], "empty", "out.png")

    @needsGdalTools
    def test_axes_in_degrees(self):
        if "netCDF" not in self.tool("gdalinfo", "--formats"):
            self.skipTest("this GDAL reads no NetCDF")
        axes = {
            "lon": ([10 + 0.01 * k for k in range(6)], "degrees_east"),
            "lat": ([50 + 0.01 * k for k in range(4)], "degrees_north"),
        }
        heights = [[100 * row + column for column in range(6)] for row in range(4)]
        netcdf(self.path("axes.nc"), axes, heights)
        found = self.statistics("axes.nc")
        x, y = metres(50.015, 6378137, 298.257223563)
        sx, sy = map(float, found["spacing"].split())
        self.assertEqual(found["coordinates"], "geographic")
        self.assertAlmostEqual(sx, 0.01 * x, places=3)
        self.assertAlmostEqual(sy, 0.01 * y, places=3)
        self.good("axes.nc", "out.tif")
        self.assertIn("WGS 84", self.info("out.tif")["coordinateSystem"]["wkt"])
        # The first row of the file is the southern one.
        north = self.grid(heights[::-1], "north.asc")
        words = ("--spacing", found["spacing"].replace(" ", ","))
        self.assertEqual(self.shade("axes.nc", *words), self.shade(north, *words))

    def test_points_are_placed_by_map_coordinates(self):
        here = self.hills("here.asc", size=10)
        there = self.hills("there.asc", size=10, corner=(5000, 7000))
        centre = self.hills("centre.asc", size=10, corner=(5005, 7005), kind="center")
        lamp = self.shade(here, "--point", "60,40,30")
        self.assertEqual(lamp, self.shade(there, "--point", "5060,7040,30"))
        self.assertEqual(lamp, self.shade(centre, "--point", "5060,7040,30"))
        self.assertNotEqual(lamp, self.shade(here, "--point", "70,40,30"))
        # The frame of a picture has its origin in the centre of its lower left sample.
        rows = [[(x * 7 + y * 5 + x * y) % 11 for x in range(16)] for y in range(12)]
        picture = self.png(rows, "picture.png")
        words = ("--spacing", "10", "--point", "55,35,30")
        self.assertEqual(lamp, self.shade(picture, *words))

    @needsGdalTools
    def test_points_over_degrees(self):
        self.tiff(self.hills(size=0.001, corner=(10, 60)), "in.tif", "-a_srs", "EPSG:4326")
        sx, sy = self.statistics("in.tif")["spacing"].split()
        lamp = self.shade("in.tif", "--point", "10.0055,60.0065,300")
        rows = [[(x * 7 + y * 5 + x * y) % 11 for x in range(16)] for y in range(12)]
        point = "%.9g,%.9g,300" % (5 * float(sx), 6 * float(sy))
        words = ("--spacing", sx + "," + sy, "--point", point)
        other = self.shade(self.png(rows, "p.png"), *words)
        worst = max(abs(a - b) for r, s in zip(lamp.rows, other.rows) for a, b in zip(r, s))
        self.assertLessEqual(worst, 1)


class Orientation(Case):
    def test_the_first_row_is_north(self):
        picture = self.shade(self.grid([[9, 1, 1], [1, 1, 1]], "g.asc", nodata=9))
        self.assertEqual(picture[0, 0], (0, 0, 0, 0))
        self.assertEqual(picture[0, 1][3], 255)

    @needsGdalTools
    def test_south_up(self):
        rows = [[(x * 7 + y * 5 + x * y) % 11 for x in range(16)] for y in range(12)]
        self.grid(rows, "north.asc", nodata=3)
        self.grid(rows[::-1], "turned.asc", nodata=3)
        self.tiff("turned.asc", "south.tif", "-a_ullr", 0, 0, 16, 12, "-a_srs", "EPSG:32611")
        self.assertGreater(self.info("south.tif")["geoTransform"][5], 0)
        self.assertEqual(self.shade("north.asc"), self.shade("south.tif"))
        lamp = ("--point", "3,2,20")
        self.assertEqual(self.shade("north.asc", *lamp), self.shade("south.tif", *lamp))
        # Written back as it came.
        self.good("south.tif", "out.tif")
        self.assertEqual(
            self.info("out.tif")["geoTransform"], self.info("south.tif")["geoTransform"]
        )
        shaded = self.shade("north.asc").flipped()
        alpha = [v for row in shaded.rows for v in row[3::4]]
        self.assertEqual(list(self.values("out.tif", 2)), alpha)

    def test_pictures_and_grids_agree(self):
        rows = [[(x * 7 + y * 5 + x * y) % 11 for x in range(16)] for y in range(12)]
        self.assertEqual(self.shade(self.hills()), self.shade(self.png(rows, "h.png"), "--height-scale", "1"))


class Samples(Case):
    @needsGdalTools
    def test_every_number_type_gives_one_picture(self):
        expected = self.shade(self.hills(nodata=0))
        types = {
            "Byte": "unsigned char", "UInt16": "unsigned short", "Int16": "short",
            "UInt32": "unsigned int", "Int32": "int", "Float32": "float", "Float64": "double",
        }
        for name, inside in types.items():
            self.tiff("hills.asc", name + ".tif", "-ot", name)
            self.assertEqual(self.shade(name + ".tif"), expected, name)
            self.assertEqual(self.statistics(name + ".tif")["type"], inside)
        self.tiff("hills.asc", "complex.tif", "-ot", "CFloat32")
        self.bad(1, ["complex.tif", "complex"], "complex.tif", "out.png")

    @needsGdalTools
    def test_scale_and_offset(self):
        rows = [[(x * 7 + y * 5 + x * y) % 11 for x in range(16)] for y in range(12)]
        high = [[100 + 0.5 * v if v else -1 for v in row] for row in rows]
        expected = self.shade(self.grid(high, "high.asc", nodata=-1))
        self.hills(nodata=0)
        self.tiff("hills.asc", "s.tif", "-ot", "Int16", "-a_scale", "0.5", "-a_offset", "100")
        self.assertEqual(self.shade("s.tif"), expected)
        self.assertEqual(self.statistics("s.tif")["type"], "float")

    @needsGdalTools
    def test_nodata_that_was_rounded(self):
        low = "-3.4028234663852886e38"
        self.grid([[1, 1.5, low], [1, 2, 1]], "g.asc", nodata=low)
        for written in ("-3.402823e38", "-3.40282346638529e+38"):
            self.tiff("g.asc", "g.tif", "-a_nodata", "none", "-ot", "Float32")
            picture = self.shade("g.tif", "--nodata", written)
            self.assertEqual(picture[2, 0], (0, 0, 0, 0))
            self.assertEqual(picture[1, 0][3], 255)

    def test_nan(self):
        picture = self.shade(self.grid([["1.5", "nan", "1"], ["1", "1", "1"]], "g.asc"))
        self.assertEqual((picture[0, 0][3], picture[1, 0][3]), (255, 0))

    @needsGdalTools
    def test_mask_bands(self):
        self.plane(width=4)
        with open(self.path("two.ppm"), "wb") as stream:
            stream.write(b"P6 4 4 255\n" + b"".join(bytes((9, 0 if i == 5 else 255, 0))
                                                    for i in range(16)))
        self.tool("gdal_translate", "-q", "-b", 1, "-mask", 2, "--config",
                  "GDAL_TIFF_INTERNAL_MASK", "YES", "two.ppm", "in.tif")
        picture = self.shade("in.tif")
        self.assertEqual((picture[1, 1], picture[0, 0][3]), ((0, 0, 0, 0), 255))

    def test_pictures_of_16_bits(self):
        picture = self.shade(self.png([[0, 60000], [0, 60000]], "p.png"), "--quiet", "--sun", "270,45")
        self.assertEqual(picture.width, 2)
        self.assertEqual(self.statistics("p.png")["type"], "unsigned short")
        self.assertEqual(self.statistics("p.png")["coordinates"], "none")

    def test_alpha_of_pictures(self):
        rows = [[5, 65535, 5, 0], [5, 65535, 5, 65535]]
        picture = self.shade(self.png(rows, "p.png", components=2))
        self.assertEqual((picture[1, 0], picture[0, 0][3]), ((0, 0, 0, 0), 255))

    def test_linear_light_in_floating_point_files(self):
        # What is written linear reads back as heights of the same values.
        self.good(self.plane(), "p.exr", "--sun", "0,30", "--layers", "illumination")
        words = ("--height-scale", "0", "--sun", "0,90")
        self.assertEqual(self.shade("p-illumination.exr", *words)[4, 4], (255, 255, 255, 255))


if __name__ == "__main__":
    unittest.main()
