# SPDX-License-Identifier: BSD-3-Clause
"""reliefshade takes over what rasters say about themselves, and keeps it."""

import math
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
        self.assertEqual(interpretations, ["Red", "Green", "Blue", "Alpha"])
        heights, alpha = self.values("in.tif"), self.values("out.tif", 4)
        self.assertIn(0, heights)
        self.assertEqual([a == 0 for a in alpha], [h == 0 for h in heights])
        self.assertEqual(before["metadata"][""], after["metadata"][""])  # area or point

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
        self.good(self.hills(size=0.01, corner=(10, 60)), "out.tif", "--degrees")
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

    @needsGdalTools
    def test_turned_rasters_are_refused(self):
        self.hills()
        for transform in ("0, 1, 0.1, 9, 0, -1", "0, 1, 0, 9, 0.1, -1", "9, -1, 0, 9, 0, -1"):
            with open(self.path("in.vrt"), "w") as stream:
                where = "<GeoTransform>%s</GeoTransform>" % transform
                stream.write(VRT % (16, 12, where, "", "hills.asc"))
            self.bad(1, ["in.vrt", "gdalwarp"], "in.vrt", "out.png")

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
        self.assertEqual(list(self.values("out.tif", 4)), alpha)

    def test_pictures_and_grids_agree(self):
        rows = [[(x * 7 + y * 5 + x * y) % 11 for x in range(16)] for y in range(12)]
        self.assertEqual(self.shade(self.hills()), self.shade(self.png(rows, "h.png")))


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
        picture = self.shade(self.png([[0, 60000], [0, 60000]], "p.png"), "--sun", "270,45")
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
