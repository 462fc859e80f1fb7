# SPDX-License-Identifier: BSD-3-Clause
"""reliefshade's presets, environments and suns with a disc."""

import math
import os
import unittest

from Reliefshade import JACKSBORO, Case

WHITE, BLACK = (255, 255, 255), (0, 0, 0)


def encoded(linear):
    return 12.92 * linear if linear <= 0.0031308 else 1.055 * linear ** (1 / 2.4) - 0.055


class Lights(Case):
    def setUp(self):
        super().setUp()
        self.plane()

    def peak(self):
        heights = [[0] * 9 for _ in range(9)]
        heights[4][4] = 3
        return self.grid(heights, "peak.asc")

    def test_presets(self):
        self.assertColour([0.5] * 3, "plane.asc", "--preset", "multidirectional")
        self.assertColour([0.62] * 3, "plane.asc", "--preset", "sky-dome")
        sun = self.shade("plane.asc", "--preset", "sun-and-sky", "--env-intensity", "0")[4, 4]
        both = self.shade("plane.asc", "--preset", "sun-and-sky")[4, 4]
        self.assertGreater(sun[0], sun[2])  # the sun is reddened, the sky blue
        self.assertTrue(all(b > s for s, b in zip(sun[:3], both)))
        self.assertEqual(both, self.shade("plane.asc", "--preset", "sun-and-sky,315,45")[4, 4])
        for level in ("combined", "combined,20,5", "igor", "igor,100"):
            self.assertColour([1] * 3, "plane.asc", "--preset", level)
        self.assertColour([0.5] * 3, "plane.asc", "--preset", "combined,315,30", "--response", "illumination")
        low = self.shade("plane.asc", "--preset", "sun-and-sky,100,10")[4, 4]
        self.assertLess(low[0], both[0])

    def gdaldem(self, *words):
        """A hillshade's codes but for those of the border, which needs neighbours on each side."""
        self.tool("gdaldem", "hillshade", "-q", "-alg", "ZevenbergenThorne", *words,
                  self.metric(), "hillshade.tif")
        return self.inside(self.values("hillshade.tif"))

    def metric(self):
        """Real terrain as if it were in metres, with squares for samples."""
        if not os.path.exists(self.path("metric.tif")):
            self.tool("gdal_translate", "-q", "-a_srs", "EPSG:32616", "-a_ullr", "500000", "4030960",
                      "536270", "4000000", JACKSBORO, "metric.tif")
        return "metric.tif"

    @staticmethod
    def inside(values, width=403):
        rows = [values[begin:begin + width] for begin in range(0, len(values), width)]
        return [value for row in rows[1:-1] for value in row[1:-1]]

    def shaded(self, *words):
        self.good(self.metric(), "shaded.tif", *words, "--type", "float", "--bands", "grey")
        return [encoded(linear) for linear in self.inside(self.values("shaded.tif"))]

    def test_igor_is_that_of_gdaldem(self):
        for words, theirs in ((["--preset", "igor"], ["-az", "315"]),
                              (["--preset", "igor,20"], ["-az", "20"]),
                              (["--preset", "igor", "--height-scale", "4"], ["-z", "4"])):
            for ours, code in zip(self.shaded(*words), self.gdaldem("-igor", *theirs)):
                self.assertLess(abs(255 * ours - code), 0.53, words)
        self.assertEqual(self.statistics(self.metric(), "--preset", "igor")["rays-traced"], "0")

    def test_combined_is_that_of_gdaldem_with_shadows(self):
        for angles in ((315, 45), (100, 20)):
            # Of combined shading gdaldem keeps 0 for no data.
            ours = [1 + 254 * code for code in self.shaded(
                "--preset", "combined,{},{}".format(*angles), "--height-scale", "3")]
            theirs = self.gdaldem("-combined", "-z", "3", "-az", str(angles[0]), "-alt", str(angles[1]))
            # d is the cosine but where ground is in the way.
            self.assertLess(max(a - b for a, b in zip(ours, theirs)), 0.52)
            self.assertLess(sum(b - a for a, b in zip(ours, theirs)) / len(ours), 6)

    def test_presets_add_to_suns(self):
        words = ("--diffuse", "0.25,0.25,0.25", "--sun", "0,90,0.5")
        self.assertColour([0.28] * 3, "plane.asc", "--preset", "sky-dome", *words)
        self.assertColour([0.25] * 3, "plane.asc", *words, "--preset", "multidirectional")

    def test_environment_file(self):
        grey = self.ppm([[(188, 188, 188)]], "grey.ppm")  # sRGB, half as bright as white
        self.assertColour([0.5] * 3, "plane.asc", "--env", grey)
        self.assertColour([0.25] * 3, "plane.asc", "--env", grey, "--env-intensity", "0.5")
        self.assertColour([0.75] * 3, "plane.asc", "--env", grey, "--sun", "0,90,0.25")
        # A linear one: what reliefshade itself writes for half a sun.
        self.good("plane.asc", "linear.exr", "--sun", "0,30")
        self.assertColour([0.5] * 3, "plane.asc", "--env", "linear.exr")

    def test_environment_lies_as_documented(self):
        # Light from the north-eastern quarter above the horizon: the first of four columns.
        self.ppm([[WHITE, BLACK, BLACK, BLACK], [BLACK] * 4], "east.ppm")
        peak, words = self.peak(), ("--env", "east.ppm", "--depth", "0.2")

        def sides(*more):
            picture = self.shade(peak, *words, *more)
            return [picture[place][0] for place in ((5, 3), (3, 3), (3, 5), (5, 5))]

        northEast, northWest, southWest, southEast = sides()
        self.assertGreater(northEast, southWest)
        turned = sides("--env-rotation", "180")
        self.assertGreater(turned[2], turned[0])
        turned = sides("--env-rotation", "90")
        self.assertGreater(turned[1], turned[3])
        mirrored = sides("--env-mirror")
        self.assertGreater(mirrored[3], mirrored[1])
        # The zenith leans toward the south.
        self.ppm([[WHITE], [BLACK], [BLACK], [BLACK]], "zenith.ppm")
        picture = self.shade(peak, "--env", "zenith.ppm", "--depth", "0.2", "--env-tilt", "60")
        self.assertGreater(picture[4, 5][0], picture[4, 3][0])

    def test_samples_and_sampling(self):
        traced = lambda *words: int(self.statistics("plane.asc", *words)["lights-traced"])
        self.assertEqual(traced("--preset", "sky-dome"), 64)  # of 128, half above the horizon
        self.assertEqual(traced("--preset", "sky-dome", "--env-samples", "32"), 16)
        self.ppm([[WHITE]], "white.ppm")
        self.assertEqual(traced("--env", "white.ppm"), 32)
        words = ("--env", "white.ppm", "--env-samples", "1024", "--env-sampling")
        self.assertColour([1 / math.pi] * 3, "plane.asc", *words, "uniform")
        self.assertColour([1] * 3, "plane.asc", *words, "solid-angle")
        self.assertColour([1] * 3, "plane.asc", *words, "importance")

    def test_radius(self):
        # Lamps on a small sphere shine from their places, those of a large one as if from everywhere.
        hills, sky = self.hills(), ("--preset", "sky-dome")
        far = self.shade(hills, *sky)
        self.assertEqual(far, self.shade(hills, *sky, "--env-radius", "infinite"))
        self.assertNotEqual(far, self.shade(hills, *sky, "--env-radius", "20"))
        self.shade(hills, *sky, "--env-radius", "20", "--save-scene", "near.json")
        self.assertEqual(self.shade(hills, "--scene", "near.json"),
                         self.shade(hills, *sky, "--env-radius", "20"))

    def test_sun_diameter(self):
        traced = lambda *words: int(self.statistics("plane.asc", *words)["lights-traced"])
        self.assertEqual(traced("--sun-diameter", "0"), 1)
        self.assertEqual(traced("--sun-diameter", "5"), 16)
        self.assertEqual(traced("--sun", "0,40", "--sun-diameter", "5", "--sun", "90,40"), 32)
        self.assertEqual(
            traced("--point", "4,4,9", "--sun-diameter", "5", "--preset", "multidirectional"), 65)
        self.assertEqual(traced("--sun-diameter", "5", "--sun-samples", "4"), 4)
        self.assertEqual(traced("--sun-samples", "4"), 1)
        # Behind a wall, farther away, the shadow's edge has more than two shades.
        heights = [[20 if x < 4 else 0 for x in range(60)] for _ in range(8)]
        self.grid(heights, "wall.asc")

        def shades(*words):
            picture = self.shade("wall.asc", "--sun", "270,30", "--depth", "0.01", *words)
            return len({picture[x, 4][0] for x in range(20, 60)})

        self.assertGreater(shades("--sun-diameter", "10"), shades() + 3)

    def test_refusals(self):
        plane = "plane.asc"
        for option, value in (("--env-samples", "8"), ("--env-sampling", "uniform"),
                              ("--env-rotation", "1"), ("--env-tilt", "1"),
                              ("--env-intensity", "1"), ("--env-radius", "1")):
            self.bad(2, [option, "--env"], plane, "o.png", option, value)
        self.bad(2, ["--env-mirror", "--env"], plane, "o.png", "--env-mirror")
        sky = (plane, "o.png", "--preset", "sky-dome")
        for option, value in (("--env-samples", "0"), ("--env-samples", "65537"),
                              ("--env-samples", "x"), ("--env-sampling", "fine"),
                              ("--env-rotation", "nan"), ("--env-tilt", "inf"),
                              ("--env-intensity", "-1"), ("--env", "grey.ppm")):
            self.bad(2, option, *sky, option, value)
        self.bad(2, ["--sun-diameter", "no sun"], *sky, "--sun-diameter", "1")
        self.bad(2, ["--sun-diameter", "no sun"], plane, "o.png", "--point", "1,1,1",
                 "--sun-diameter", "1")
        for value in ("-1", "91", "nan"):
            self.bad(2, "--sun-diameter", plane, "o.png", "--sun-diameter", value)
        for preset in ("dawn", "sky-dome,1,2", "sun-and-sky,1", "sun-and-sky,a,b", "sun-and-sky,0,91",
                       "multidirectional,"):
            self.bad(2, "--preset", plane, "o.png", "--preset", preset)
        self.bad(1, "none.hdr", plane, "o.png", "--env", "none.hdr")
        with open(self.path("text.exr"), "w") as stream:
            stream.write("This is no picture.")
        self.bad(1, "text.exr", plane, "o.png", "--env", "text.exr")
        self.tool("oiiotool", "--create", "4x2", 5, "-d", "float", "-o", "five.exr")
        self.bad(1, ["five.exr", "5"], plane, "o.png", "--env", "five.exr")
        self.assertFalse(os.path.exists(self.path("o.png")))


if __name__ == "__main__":
    unittest.main()
