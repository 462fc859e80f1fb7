# SPDX-License-Identifier: BSD-3-Clause
"""reliefshade scales heights that have no unit: one relief, however it is stored, is one picture."""

import json
import math
import re
import struct
import unittest
import zlib

from Reliefshade import JACKSBORO, Case, Picture, needsGdal, needsGdalTools

WIDTH, HEIGHT = 240, 160


def relief(x, y):
    """From 0 to 1."""
    hills = math.sin(0.06 * x) * math.cos(0.05 * y) + 0.2 * math.sin(0.25 * x + 0.2 * y)
    return (hills + 1.2) / 2.4


ROWS = [[relief(x, y) for x in range(WIDTH)] for y in range(HEIGHT)]


class HeightScale(Case):
    def fitted(self, *words):
        """Runs it and returns the picture, and the scale that it tells."""
        result = self.run_(words[0], "shaded.png", "--bands", "rgba", *words[1:])
        self.assertEqual(result.returncode, 0, result.stderr)
        lines = result.stderr.splitlines()
        self.assertEqual(len(lines), 1, result.stderr)
        self.assertLess(len(lines[0]), 200)
        found = re.fullmatch(r"reliefshade: %s: .*--height-scale (\S+) is taken" % words[0],
                             lines[0])
        self.assertTrue(found, lines[0])
        return Picture(self.path("shaded.png")), found[1]

    def png16(self, name="sixteen.png"):
        return self.png([[round(65535 * v) for v in row] for row in ROWS], name)

    def png8(self, name="eight.png"):
        def chunk(kind, data):
            check = struct.pack(">I", zlib.crc32(kind + data))
            return struct.pack(">I", len(data)) + kind + data + check

        data = b"".join(b"\0" + bytes(round(255 * v) for v in row) for row in ROWS)
        with open(self.path(name), "wb") as stream:
            stream.write(b"\x89PNG\r\n\x1a\n")
            stream.write(chunk(b"IHDR", struct.pack(">IIBBBBB", WIDTH, HEIGHT, 8, 0, 0, 0, 0)))
            stream.write(chunk(b"IDAT", zlib.compress(data)) + chunk(b"IEND", b""))
        return name

    def pfm(self, rows, name="floats.pfm"):
        with open(self.path(name), "wb") as stream:
            stream.write(b"Pf\n%d %d\n-1.0\n" % (len(rows[0]), len(rows)))
            for row in rows[::-1]:
                stream.write(struct.pack("<%df" % len(row), *row))
        return name

    def assertAlike(self, a, b, most):
        worst = max(abs(p - q) for r, s in zip(a.rows, b.rows) for p, q in zip(r, s))
        self.assertLessEqual(worst, most)

    def test_number_types(self):
        expected, scale = self.fitted(self.png16())
        tones = [v for row in expected.rows for v in row[::4]]
        self.assertGreater(max(tones) - min(tones), 60)
        floats, scaleOfFloats = self.fitted(self.pfm(ROWS))
        self.assertAlike(floats, expected, 2)
        self.assertAlmostEqual(65535 * float(scale) / float(scaleOfFloats), 1, delta=1e-4)
        shifted = [[3 * v - 100 for v in row] for row in ROWS]
        self.assertAlike(self.fitted(self.pfm(shifted))[0], expected, 2)
        # 8 bits: the same scale; the heights themselves are off by up to half a step.
        eight, scaleOfEight = self.fitted(self.png8())
        self.assertAlmostEqual(255 * float(scaleOfEight) / float(scaleOfFloats), 1, delta=5e-3)
        mean = sum(abs(p - q) for r, s in zip(eight.rows, expected.rows) for p, q in zip(r, s))
        self.assertLess(mean / (4 * WIDTH * HEIGHT), 4)

    def test_openexr(self):
        expected, scale = self.fitted(self.png16())
        floats, scaleOfFloats = self.fitted(self.exr({"Z": ROWS}, "floats.exr"))
        self.assertAlike(floats, expected, 2)
        self.assertAlmostEqual(65535 * float(scale) / float(scaleOfFloats), 1, delta=1e-4)
        # A layer of floats without a place: the illumination of a relief, taken for heights.
        self.good("sixteen.png", "a.exr", "--quiet", "--height-scale", "1e-4",
                  "--layers", "illumination")
        self.fitted("a-illumination.exr")

    @needsGdalTools
    def test_tiff_and_places(self):
        expected, scale = self.fitted(self.png16())
        floats, scaleOfFloats = self.fitted(self.pfm(ROWS))
        self.tool("gdal_translate", "-q", "-ot", "Float32", "-scale", 0, 65535, 0, 1,
                  "sixteen.png", "floats.tif")
        self.assertAlike(self.fitted("floats.tif")[0], expected, 2)
        # A georeference whose true scale is the fitted one: metres, and nothing to tell.
        top = 65535 * float(scale) * 30
        self.tool("gdal_translate", "-q", "-ot", "Float32", "-scale", 0, 65535, 0, top,
                  "-a_srs", "EPSG:32611", "-a_ullr", 5e5, 4e6 + 30 * HEIGHT, 5e5 + 30 * WIDTH, 4e6,
                  "sixteen.png", "placed.tif")
        self.assertAlike(self.shade("placed.tif"), expected, 2)
        self.assertEqual(self.statistics("placed.tif")["height-scale"], "1")
        self.assertAlike(self.fitted("placed.tif", "--height-scale", "auto")[0], expected, 2)
        # A picture with a world file lies somewhere, but its values are no heights.
        with open(self.path("sixteen.pgw"), "w") as stream:
            stream.write("30\n0\n0\n-30\n500015\n%d\n" % (4000000 + 30 * HEIGHT - 15))
        picture, scaleInPlace = self.fitted("sixteen.png")
        self.assertAlike(picture, expected, 2)
        self.assertAlmostEqual(float(scaleInPlace) / float(scale), 30, delta=1e-3)
        # Feet are a unit: --height-scale multiplies what they are in metres.
        self.tool("gdal_translate", "-q", "-of", "VRT", "placed.tif", "feet.vrt")
        with open(self.path("feet.vrt")) as stream:
            text = stream.read()
        with open(self.path("feet.vrt"), "w") as stream:
            stream.write(re.sub(r"(<VRTRasterBand[^>]*>)", r"\1<UnitType>ft</UnitType>", text))
        picture, scaleOfFeet = self.fitted("feet.vrt", "--height-scale", "auto")
        self.assertAlike(picture, expected, 2)
        self.assertAlmostEqual(float(scaleOfFeet) * 0.3048, 1, delta=1e-4)

    def test_number_repeats_it(self):
        picture, scale = self.fitted(self.png16())
        self.assertEqual(float("%.6g" % float(scale)), float(scale))
        self.assertEqual(self.shade("sixteen.png", "--height-scale", scale), picture)
        self.assertEqual(self.shade("sixteen.png", "--quiet"), picture)
        found = self.statistics("sixteen.png")
        self.assertEqual(found["height-scale"], scale)
        self.good("sixteen.png", "a.png", "--quiet", "--save-scene", "scene.json")
        with open(self.path("scene.json")) as stream:
            self.assertEqual(json.load(stream)["heightScale"], float(scale))
        self.assertEqual(self.shade("sixteen.png", "--scene", "scene.json"), picture)

    def test_what_was_given_wins(self):
        self.png16()
        self.assertEqual(self.statistics("sixteen.png", "--spacing", "9")["height-scale"], "1")
        scaleAt9 = self.fitted("sixteen.png", "--spacing", "9", "--height-scale", "auto")[1]
        self.assertAlmostEqual(float(scaleAt9) / float(self.fitted("sixteen.png")[1]), 9, delta=1e-3)
        for text, given in (('{"reliefScene": 1, "heightScale": 1}', True),
                            ('{"reliefScene": 1, "heightScale": 0.001}', True),
                            ('{"reliefScene": 1}', False)):
            with open(self.path("scene.json"), "w") as stream:
                stream.write(text)
            if given:
                found = self.statistics("sixteen.png", "--scene", "scene.json")
                self.assertEqual(float(found["height-scale"]), json.loads(text)["heightScale"])
            else:
                self.fitted("sixteen.png", "--scene", "scene.json")
            self.fitted("sixteen.png", "--scene", "scene.json", "--height-scale", "auto")
        self.bad(2, ["--height-scale", "'automatic'"], "sixteen.png", "a.png",
                 "--height-scale", "automatic")

    def test_places_keep_true_heights(self):
        grid = self.grid([[100 * v for v in row] for row in ROWS])
        self.assertEqual(self.statistics(grid)["height-scale"], "1")
        # Next to nothing over 30 m, and all walls: one line that says what helps.
        for top, word in ((1, "low"), (1e6, "high")):
            grid = self.grid([[top * v for v in row] for row in ROWS], size=30)
            result = self.run_(grid, "a.png")
            self.assertEqual(result.returncode, 0)
            lines = result.stderr.splitlines()
            self.assertEqual(len(lines), 1, result.stderr)
            self.assertIn("--height-scale auto", lines[0])
            self.assertIn("so " + word, lines[0])
            self.assertLess(len(lines[0]), 200)
            self.good(grid, "a.png", "--quiet")
            self.good(grid, "a.png", "--height-scale", "1")
            told = self.fitted(grid, "--height-scale", "auto")[1]
            self.assertEqual(lines[0].split()[-1], told)

    @needsGdal
    def test_terrain_is_left_alone(self):
        self.assertEqual(self.statistics(JACKSBORO)["height-scale"], "1")

    def test_nothing_to_scale(self):
        self.assertEqual(self.shade(self.png([[7] * 9] * 9, "flat.png"))[4, 4][3], 255)
        self.assertEqual(self.statistics("flat.png")["height-scale"], "1")

    def test_steps(self):
        rows = [[100 + round(x / 17 + y / 23) for x in range(200)] for y in range(200)]
        self.png(rows, "steps.png")
        told = self.run_("steps.png", "a.png").stderr.splitlines()
        self.assertEqual(len(told), 2, told)
        self.assertIn("--smooth-steps", told[0])
        smooth, scale = self.fitted("steps.png", "--smooth-steps")
        # A plane is one tone, but for its borders; its terraces are not.
        rough = self.shade("steps.png", "--quiet", "--height-scale", scale)

        def range_(picture):
            tones = [v for row in picture.rows[20:130] for v in row[80:520:4]]
            return max(tones) - min(tones)

        self.assertLess(1.5 * range_(smooth), range_(rough))
        small = ("steps.png", "a.png", "--quiet", "--memory-limit", "1")
        self.good(*small)
        self.bad(1, ["steps.png", "--memory-limit"], *small, "--smooth-steps")

    def test_masks_and_nodata(self):
        rows = [[round(50000 * v) for v in row] for row in ROWS]
        scale = self.fitted(self.png(rows, "a.png"), "--nodata", "65535")[1]
        for y in range(40, 100):
            rows[y][60:160] = [65535] * 100
        holed = self.fitted(self.png(rows, "a.png"), "--nodata", "65535")[1]
        mask = self.png([[v != 65535 for v in row] for row in rows], "mask.png")
        self.assertEqual(self.fitted("a.png", "--mask", mask)[1], holed)
        self.assertAlmostEqual(float(holed) / float(scale), 1, delta=0.2)
        self.assertNotEqual(self.fitted("a.png")[1], holed)


if __name__ == "__main__":
    unittest.main()
