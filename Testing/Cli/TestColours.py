# SPDX-License-Identifier: BSD-3-Clause
"""reliefshade's pictures as colours, and its tints by height."""

import os
import unittest

from Reliefshade import Case, Picture, needsGdalTools

# Level ground under a sun overhead: what comes out is the material's colour.
FLAT = ("--sun", "0,90", "--height-scale", "0")
RED, GREEN, BLUE, WHITE = (255, 0, 0), (0, 255, 0), (0, 0, 255), (255, 255, 255)


class Textures(Case):
    def setUp(self):
        super().setUp()
        self.plane(size=10, corner=(5000, 7000))  # 8 x 8 samples

    def test_pictures_are_stretched(self):
        self.ppm([[(10, 200, 30)]], "one.ppm")
        picture = self.shade("plane.asc", *FLAT, "--texture", "one.ppm")
        self.assertTrue(all(row == bytes((10, 200, 30, 255)) * 8 for row in picture.rows))
        self.ppm([[RED, GREEN], [BLUE, WHITE]], "four.ppm")
        picture = self.shade("plane.asc", *FLAT, "--texture", "four.ppm")
        corners = [picture[place][:3] for place in ((0, 0), (7, 0), (0, 7), (7, 7))]
        self.assertEqual(corners, [RED, GREEN, BLUE, WHITE])
        self.ppm([[(x * 30, y * 30, 0) for x in range(8)] for y in range(8)], "same.ppm")
        picture = self.shade("plane.asc", *FLAT, "--texture", "same.ppm")
        for x, y in ((0, 0), (7, 3), (2, 7)):
            self.assertEqual(picture[x, y], (x * 30, y * 30, 0, 255))
        # Floating point is linear.
        self.good("plane.asc", "half.exr", "--sun", "0,30")
        self.assertColour([0.5] * 3, "plane.asc", *FLAT, "--texture", "half.exr")

    def test_base_and_specular(self):
        self.ppm([[(188, 0, 0)]], "red.ppm")  # half of full red
        dark = ("--sun", "0,90", "--diffuse", "0,0,0")
        self.assertColour([0.5, 0, 0], "plane.asc", *dark, "--base-texture", "red.ppm")
        self.assertColour([0.25, 0, 0], "plane.asc", *dark, "--specular-texture", "red.ppm",
                          "--ks", "0.5")

    def reference(self, name, left, top, right, bottom, *words, system="EPSG:32611", source="p.ppm"):
        return self.tiff(source, name, "-a_ullr", left, top, right, bottom, "-a_srs", system, *words)

    @needsGdalTools
    def test_georeferenced_pictures_lie_where_the_map_has_them(self):
        self.tiff("plane.asc", "in.tif", "-a_srs", "EPSG:32611")
        # Of twice the resolution, over the north-eastern quarter: 5040 to 5080, 7040 to 7080.
        self.ppm([[RED if y < 4 else BLUE for x in range(8)] for y in range(8)], "p.ppm")
        self.reference("quarter.tif", 5040, 7080, 5080, 7040)
        words = (*FLAT, "--texture", "quarter.tif", "--diffuse", "0,1,0")
        picture = self.shade("in.tif", *words)
        for x in range(8):
            for y in range(8):
                expected = GREEN if x < 4 or y > 3 else RED if y < 2 else BLUE
                self.assertEqual(picture[x, y][:3], expected, (x, y))
        # A picture and heights whose first row is the southern one.
        self.ppm([[RED if y >= 4 else BLUE for x in range(8)] for y in range(8)], "p.ppm")
        self.reference("turned.tif", 5040, 7040, 5080, 7080)
        self.tiff("in.tif", "south.tif", "-a_ullr", 5000, 7000, 5080, 7080)
        words = (*FLAT, "--texture", "turned.tif", "--diffuse", "0,1,0")
        self.assertEqual(self.shade("in.tif", *words), picture)
        self.assertEqual(self.shade("south.tif", *words), picture)
        # Coordinates without a name are the same as any.
        self.tiff("p.ppm", "unnamed.tif", "-a_ullr", 5040, 7040, 5080, 7080)
        words = (*FLAT, "--texture", "unnamed.tif", "--diffuse", "0,1,0")
        self.assertEqual(self.shade("in.tif", *words), picture)
        self.assertEqual(self.shade("in.tif", *words, "--spacing", "3,7"), picture)

    @needsGdalTools
    def test_degrees(self):
        self.plane(name="degrees.asc", size=0.01, corner=(10, 60))
        self.tiff("degrees.asc", "in.tif", "-a_srs", "EPSG:4326")
        self.ppm([[RED, BLUE]], "p.ppm")
        self.reference("p.tif", 10, 60.08, 10.08, 60, system="EPSG:4326")
        picture = self.shade("in.tif", *FLAT, "--texture", "p.tif")
        self.assertEqual((picture[0, 0][:3], picture[7, 7][:3]), (RED, BLUE))

    @needsGdalTools
    def test_other_reference_systems_are_refused(self):
        self.tiff("plane.asc", "in.tif", "-a_srs", "EPSG:32611")
        self.ppm([[RED]], "p.ppm")
        self.reference("p.tif", 5000, 7080, 5080, 7000, system="EPSG:32612")
        self.bad(1, ["p.tif", "gdalwarp -t_srs"], "in.tif", "o.png", "--texture", "p.tif")

    @needsGdalTools
    def test_pictures_of_another_place_are_refused(self):
        self.tiff("plane.asc", "in.tif", "-a_srs", "EPSG:32611")
        self.ppm([[RED]], "p.ppm")
        for left, top in ((4900, 7050), (5100, 7050), (5000, 6900), (5000, 7200)):
            self.reference("p.tif", left, top, left + 80, top - 80)
            self.bad(1, ["p.tif", "nowhere"], "in.tif", "o.png", "--texture", "p.tif")
        self.reference("p.tif", 4950, 7050, 5020, 6950)  # a corner is enough
        self.shade("in.tif", "--texture", "p.tif")

    @needsGdalTools
    def test_alpha_masks_and_further_bands(self):
        # A pixel is no data if all of its colours are 0, not if one is.
        self.ppm([[(0, 0, 0), (0, 0, 255)]], "p.ppm")
        self.tiff("p.ppm", "nodata.tif", "-a_nodata", 0)
        picture = self.shade("plane.asc", *FLAT, "--diffuse", "0,1,0", "--texture", "nodata.tif")
        self.assertEqual((picture[0, 0][:3], picture[7, 0][:3]), (GREEN, BLUE))
        # A fourth band that is not alpha: infrared, say.
        self.ppm([[(0, 7, 255)]], "p.ppm")
        self.tiff("p.ppm", "infrared.tif", "-b", 1, "-b", 2, "-b", 3, "-b", 1,
                  "-co", "ALPHA=UNSPECIFIED", "-co", "PHOTOMETRIC=RGB")
        picture = self.shade("plane.asc", *FLAT, "--texture", "infrared.tif")
        self.assertEqual(picture[3, 3][:3], (0, 7, 255))
        self.tiff("p.ppm", "alpha.tif", "-b", 1, "-b", 2, "-b", 3, "-b", 1,
                  "-colorinterp_4", "alpha")
        picture = self.shade("plane.asc", *FLAT, "--texture", "alpha.tif", "--diffuse", "0,1,0")
        self.assertEqual(picture[3, 3][:3], GREEN)
        self.tiff("p.ppm", "16.tif", "-ot", "UInt16", "-scale", 0, 255, 0, 65535)
        picture = self.shade("plane.asc", *FLAT, "--texture", "16.tif")
        self.assertEqual(picture[3, 3][:3], (0, 7, 255))
        self.tiff("p.ppm", "int.tif", "-ot", "Int16")
        self.bad(1, ["int.tif", "Int16"], "plane.asc", "o.png", "--texture", "int.tif")

    @needsGdalTools
    def test_palettes(self):
        with open(self.path("palette.vrt"), "w") as stream:
            stream.write("""<VRTDataset rasterXSize="2" rasterYSize="1">
<VRTRasterBand dataType="Byte" band="1"><ColorInterp>Palette</ColorInterp><ColorTable>
<Entry c1="1" c2="2" c3="3" c4="255"/><Entry c1="255" c2="0" c3="0" c4="255"/></ColorTable>
<SimpleSource><SourceFilename relativeToVRT="1">index.ppm</SourceFilename></SimpleSource>
</VRTRasterBand></VRTDataset>""")
        self.ppm([[(0, 0, 0), (1, 0, 0)]], "index.ppm")
        picture = self.shade("plane.asc", *FLAT, "--texture", "palette.vrt")
        self.assertEqual((picture[0, 0][:3], picture[7, 0][:3]), ((1, 2, 3), RED))

    def test_refusals(self):
        self.bad(1, "none.png", "plane.asc", "o.png", "--texture", "none.png")
        os.mkdir(self.path("folder"))
        for option in ("--texture", "--base-texture", "--specular-texture"):
            self.bad(1, ["folder", "directory"], "plane.asc", "o.png", option, "folder")
        with open(self.path("text.png"), "w") as stream:
            stream.write("This is no picture.")
        self.bad(1, "text.png", "plane.asc", "o.png", "--base-texture", "text.png")
        self.tool("oiiotool", "--create", "4x2", 5, "-d", "float", "-o", "five.exr")
        self.bad(1, ["five.exr", "5"], "plane.asc", "o.png", "--texture", "five.exr")
        self.assertFalse(os.path.exists(self.path("o.png")))


class Tints(Case):
    def write(self, text, name="tint.txt"):
        with open(self.path(name), "w") as stream:
            stream.write(text)
        return name

    @needsGdalTools
    def test_the_colours_are_those_of_gdaldem(self):
        # gdaldem's nv reaches into the colours beside it: let no height be near.
        self.hills(nodata=-9)
        tables = [
            "0 0 0 0\n10 255 255 255\n",
            "# a comment\n10,200,100,50 # and another\n2:255:0:128\n\n5\tgreen\n",
            "0% 10 20 30\n50% Orange\n100% 250 128 1\nnv 1 2 3\n",
            "-5 aqua\n4.5 brown\n4.75 indigo\n1e2 grey\n",
            "4 1 2 3\n",
        ]
        for text in tables:
            self.write(text)
            self.tool("gdaldem", "color-relief", "-q", "-of", "PNG", "hills.asc", "tint.txt", "g.png")
            wanted = Picture(self.path("g.png"))
            picture = self.shade("hills.asc", *FLAT, "--tint", "tint.txt")
            for y in range(12):
                for x in range(16):
                    if picture[x, y][3]:
                        for got, expected in zip(picture[x, y], wanted[x, y][:3]):
                            self.assertLessEqual(abs(got - expected), 2, (text, x, y))

    def test_values_are_the_files_own(self):
        self.grid([[100, 200], [100, 200]], "g.asc", nodata=-1)
        self.write("100 red\n200 blue\n")
        for scale in ("0", "0.00001"):
            picture = self.shade("g.asc", "--sun", "0,90", "--height-scale", scale, "--tint",
                                 "tint.txt")
            self.assertEqual((picture[0, 0][:3], picture[1, 0][:3]), (RED, BLUE))

    def test_shares_leave_out_what_is_no_data(self):
        self.grid([[0, 50, 100, -999, 5000]], "g.asc", nodata=-999)
        self.grid([[1, 1, 1, 1, 0]], "mask.asc")
        self.write("0% black\n100% white\n")
        picture = self.shade("g.asc", *FLAT, "--tint", "tint.txt", "--mask", "mask.asc", "--quiet")
        self.assertEqual([picture[x, 0][0] for x in range(3)], [0, 128, 255])

    def test_steps_and_alpha(self):
        self.grid([[1, 5, 5.001, 9]] * 2, "g.asc")
        self.write("0 red\n5 red\n5 blue\n10 blue\n")
        picture = self.shade("g.asc", *FLAT, "--tint", "tint.txt")
        self.assertEqual([picture[x, 0][:3] for x in range(4)], [RED, RED, BLUE, BLUE])
        self.write("0 red 0\n9 255 0 0 255\n")
        self.grid([[0, 4.5, 9]] * 2, "g.asc")
        picture = self.shade("g.asc", *FLAT, "--tint", "tint.txt", "--diffuse", "0,0,1")
        self.assertEqual((picture[0, 0][:3], picture[2, 0][:3]), (BLUE, RED))
        self.assertGreater(min(picture[1, 0][0], picture[1, 0][2]), 100)

    def tints(self, text, heights, name="tint.txt", *words):
        """The colours of these heights."""
        self.grid([heights] * 2, "g.asc")
        self.write(text, name)
        picture = self.shade("g.asc", *FLAT, "--tint", name, "--diffuse", "0,0,0", *words)
        return [picture[x, 0][:3] for x in range(len(heights))]

    def assertTints(self, expected, got):
        for wanted, color in zip(expected, got):
            for a, b in zip(wanted, color):
                self.assertLessEqual(abs(a - b), 1, (expected, got))

    def test_tables_of_qgis(self):
        comment = "# QGIS Generated Color Map Export File\n"
        # Labels are any text; alpha 128 over black is half of the light.
        lines = "400,0,0,255,255,below 400, # wet\n500,0,255,0,255,500 m\n700,255,0,0,128,> 700\n"
        linear = [(0, 0, 255), (0, 128, 128), (0, 255, 0), (188, 0, 0), (188, 0, 0)]
        heights = [400, 450, 500, 700, 900]
        for head in (comment, comment + "INTERPOLATION:INTERPOLATED\n",
                     "\ufeff" + comment, "INTERPOLATION:INTERPOLATED\n"):
            self.assertTints(linear, self.tints(head + lines, heights))
        black = (0, 0, 0)
        heights = [390, 400, 400.1, 500, 501, 700, 701]
        self.assertTints([BLUE, BLUE, GREEN, GREEN, (188, 0, 0), (188, 0, 0), black],
                         self.tints(comment + "INTERPOLATION:DISCRETE\n" + lines, heights))
        self.assertTints([BLUE, BLUE, RED, RED, RED, RED, RED],
                         self.tints(comment + "INTERPOLATION:DISCRETE\n400,0,0,255,255,a\n"
                                    "inf,255,0,0,255,> 400\n", heights))
        self.assertTints([black, BLUE, black, GREEN, black, (188, 0, 0), black],
                         self.tints(comment + "INTERPOLATION:EXACT\n" + lines, heights))
        # A height of single precision is that of the table.
        self.assertTints([RED, black],
                         self.tints("INTERPOLATION:EXACT\n0.1,255,0,0,255,x\n", [0.1, 0.10001]))

    def test_tables_of_gmt(self):
        rgb = "# COLOR_MODEL = RGB\n"
        text = rgb + ("400 0 0 255 500 0 255 0\n500 255 255 0 600 255 0 0 U ; upper\n"
                      "B 0 0 0\nF white\nN 128 128 128\n")
        heights = [399, 400, 450, 499.999, 500, 550, 600, 601]
        wanted = [(0, 0, 0), BLUE, (0, 128, 128), GREEN, (255, 255, 0), (255, 128, 0), RED, WHITE]
        self.assertTints(wanted, self.tints(text, heights))
        slashes = ("400 0/0/255 500 0/255/0\n500 yellow 600 #ff0000 L\nB black\nF 255\nN 128\n")
        self.assertTints(wanted, self.tints(slashes, heights))
        self.assertTints(wanted, self.tints("# COLOR_MODEL = HSV\n400 240 1 1 500 120 1 1\n"
                                            "500 60-1-1 600 0-1-1\nB 0 0 0\nF white\n", heights))
        # Segments of one colour each are steps; beyond the last ones their colours go on.
        steps = "0 red 5 red\n5 blue 10 blue\n"
        self.assertTints([RED, RED, BLUE, BLUE], self.tints(steps, [-1, 4.999, 5, 11], "steps.cpt"))
        # Between the colours the hue turns, or it does not.
        self.assertTints([RED, (255, 255, 0), GREEN],
                         self.tints("# COLOR_MODEL = +HSV\n0 0-1-1 2 120-1-1\n", [0, 1, 2]))
        self.assertTints([RED, (128, 128, 0), GREEN],
                         self.tints("# COLOR_MODEL = HSV\n0 0-1-1 2 120-1-1\n", [0, 1, 2]))
        self.assertTints([(188, 0, 0)] * 2, self.tints("0 red@50 2 red@50\n", [0, 2], "t.cpt"))

    def test_textures_lie_over_tints(self):
        self.plane()
        self.write("5 green\n")
        self.ppm([[RED]], "red.ppm")
        words = (*FLAT, "--tint", "tint.txt")
        self.assertEqual(self.shade("plane.asc", *words)[0, 0][:3], GREEN)
        self.assertEqual(self.shade("plane.asc", *words, "--texture", "red.ppm")[0, 0][:3], RED)

    def test_refusals(self):
        self.plane()
        self.bad(1, "none.txt", "plane.asc", "o.png", "--tint", "none.txt")
        for text, fragment in (
            ("", "no colours"), ("# 1 2 3 4\n", "no colours"), ("nv 1 2 3", "no colours"),
            ("0 red\n1 2 3\n", "line 2"), ("x 1 2 3\n", "'x'"), ("1 2 3 300", "'300'"),
            ("1 2 3 -4", "'-4'"), ("1 2 3 4 5 6", "'6'"), ("1 red 1 2", "'2'"), ("1 reddish", "line 1"),
            ("1 2 3 4x", "'4x'"), ("% 1 2 3", "''"), ("nan 1 2 3", "'nan'"),
        ):
            self.write(text)
            self.bad(1, ["tint.txt", fragment], "plane.asc", "o.png", "--tint", "tint.txt")
        for text, fragments in (
            ("INTERPOLATION:CUBIC\n0,1,2,3,4,x\n", ["line 1", "DISCRETE"]),
            ("INTERPOLATION:EXACT\ninf,1,2,3,4,x\n", ["line 2", "'inf'"]),
            ("# COLOR_MODEL = CMYK\n0 1/2/3/4 1 1/2/3/4\n", ["line 1", "'cmyk'"]),
            ("# COLOR_MODEL = RGB\n0 red\n", ["line 2", "two heights"]),
            ("# COLOR_MODEL = RGB\n0 red 1 blue\n0.5 red 2 blue\n", ["line 3", "rise"]),
            ("# COLOR_MODEL = RGB\n0 1/2 1 blue\n", ["line 2", "'1/2'"]),
            ("# COLOR_MODEL = RGB\n0 1/2/256 1 blue\n", ["line 2", "'256'"]),
            ("# COLOR_MODEL = RGB\nB 0 0 0\n", ["no colours"]),
        ):
            self.write(text)
            self.bad(1, ["tint.txt", *fragments], "plane.asc", "o.png", "--tint", "tint.txt")
        self.write("0 " + "x" * 5000)
        self.assertLess(len(self.bad(1, "line 1", "plane.asc", "o.png", "--tint", "tint.txt")), 200)
        self.assertFalse(os.path.exists(self.path("o.png")))


if __name__ == "__main__":
    unittest.main()
