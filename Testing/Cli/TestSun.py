# SPDX-License-Identifier: BSD-3-Clause
"""reliefshade's sun of a time and a place, and a day as frames."""

import json
import math
import os
import unittest

from Reliefshade import JACKSBORO, Case, Picture, needsGdal, needsGdalTools

MORNING = "2026-06-21T06:30+02:00"
BERLIN = ",13.4,52.52"
# By astropy and pvlib: Testing/Model/SunPositions.h.
AZIMUTH, BARE, REFRACTED = 68.15818, 12.89147, 12.96112


class Sun(Case):
    def setUp(self):
        super().setUp()
        self.plane()

    def angles(self, source, *words):
        """Azimuth and altitude of the suns that a run has had, as its saved scene tells them."""
        self.run_(source, "kept.png", "--save-scene", "kept.json", "--quiet", *words)
        with open(self.path("kept.json")) as stream:
            return [(light["azimuth"], light["altitude"]) for light in json.load(stream)["lights"]]

    def files(self):
        return sorted(os.listdir(self.folder))

    def read(self, name):
        with open(self.path(name), "rb") as stream:
            return stream.read()

    def test_stands_where_others_have_it(self):
        self.assertColour(
            [math.sin(math.radians(REFRACTED))] * 3, "plane.asc", "--sun-at", MORNING + BERLIN)
        for more, altitude in (((), REFRACTED), (("--refraction", "off"), BARE),
                               (("--refraction", "0"), REFRACTED)):
            ((azimuth, found),) = self.angles("plane.asc", "--sun-at", MORNING + BERLIN, *more)
            self.assertAlmostEqual(azimuth, AZIMUTH, delta=0.003)
            self.assertAlmostEqual(found, altitude, delta=0.003)
        ((_, high),) = self.angles(
            "plane.asc", "--sun-at", MORNING + BERLIN, "--refraction", "8849")
        self.assertTrue(BARE < high < REFRACTED - 0.03)

    def test_time_has_many_spellings(self):
        expected = self.angles("plane.asc", "--sun-at", MORNING + BERLIN)
        for time in ("2026-06-21T04:30Z", "20260621T0430Z", "2026-06-20T20:00:00-08:30"):
            self.assertEqual(self.angles("plane.asc", "--sun-at", time + BERLIN), expected)

    def test_adds_to_lights_in_order(self):
        words = ("--sun", "10,20,0.5", "--sun-at", MORNING + BERLIN + ",0.25", "--sun", "30,40")
        self.assertEqual([round(a) for a, _ in self.angles("plane.asc", *words)], [10, 68, 30])
        level = sum(share * math.sin(math.radians(altitude))
                    for share, altitude in ((0.5, 20), (0.25, REFRACTED), (0.2, 40)))
        self.assertColour([level] * 3, "plane.asc", "--sun", "10,20,0.5", "--sun-at",
                          MORNING + BERLIN + ",0.25", "--sun", "30,40,0.2")
        red = self.shade("plane.asc", "--sun-at", MORNING + BERLIN + ",1,1,0,0")[4, 4]
        self.assertTrue(red[0] > 0 and red[1] == red[2] == 0)
        # It takes the place of a file's lights, and has a disc as others do.
        self.angles("plane.asc", "--sun", "1,2")
        self.assertEqual(len(self.angles("plane.asc", "--scene", "kept.json", "--sun-at",
                                         MORNING + BERLIN)), 1)
        self.assertEqual(self.statistics("hills.asc" if self.hills() else "", "--sun-at",
                                         MORNING + BERLIN, "--sun-diameter", "0.533")["lights-traced"], "16")

    @needsGdal
    def test_place_of_the_heights(self):
        here = self.angles(JACKSBORO, "--sun-at", "2026-06-21T12:30Z")
        there = self.angles(JACKSBORO, "--sun-at", "2026-06-21T12:30Z,-84.2458333,36.5895833")
        for (a, b), (c, d) in zip(here, there):
            self.assertAlmostEqual(a, c, delta=1e-5)
            self.assertAlmostEqual(b, d, delta=1e-5)

    @needsGdalTools
    def test_north_of_the_map(self):
        """On a map whose north leans to the east by the convergence, suns are that much less far round."""
        source = self.hills()
        for epsg, x, sign in ((32632, 780000, 1), (32632, 220000, -1), (32732, 780000, -1)):
            box = ("-a_ullr", x - 80, 5900060, x + 80, 5899940)
            projected = self.tiff(source, "utm.tif", "-a_srs", f"EPSG:{epsg}", *box)
            info = self.info(projected)["wgs84Extent"]["coordinates"][0]
            longitude = sum(p[0] for p in info[:4]) / 4
            latitude = sum(p[1] for p in info[:4]) / 4
            lean = math.degrees(math.atan(math.tan(math.radians(longitude - 9)) *
                                          math.sin(math.radians(latitude))))
            self.assertGreater(sign * lean, 1.5)
            true = self.angles("plane.asc", "--sun-at", f"{MORNING},{longitude},{latitude}")
            map_ = self.angles(projected, "--sun-at", MORNING)
            self.assertAlmostEqual(
                math.remainder(true[0][0] - lean - map_[0][0], 360), 0, delta=2e-3)
            self.assertAlmostEqual(true[0][1], map_[0][1], delta=2e-3)
            # A place of one's own is of the same map.
            given = self.angles(projected, "--sun-at", f"{MORNING},{longitude},{latitude}")
            self.assertAlmostEqual(given[0][0], map_[0][0], delta=2e-3)

    def test_night(self):
        result = self.run_("plane.asc", "night.png", "--sun-at", "2026-06-21T23:00Z" + BERLIN)
        self.assertEqual(result.returncode, 0)
        self.assertEqual(len(result.stderr.splitlines()), 1)
        self.assertRegex(result.stderr, r"warning: night: the sun of 20260621T2300Z is 1\d(\.\d)? degrees below")
        self.assertEqual(set(Picture(self.path("night.png")).rows), {bytes(8)})
        self.good("plane.asc", "night.png", "--quiet", "--sun-at", "2026-06-21T23:00Z" + BERLIN)
        polar = ("--sun-at", "2026-06-21T00:00Z,20,89")
        self.assertColour([math.sin(math.radians(23.4 - 1))] * 3, "plane.asc", *polar)

    def test_frames(self):
        source = self.hills()
        times = ["2026-06-21T06:30:00+02:00", "2026-06-21T07:15:00+02:00", "2026-06-21T08:00:00+02:00"]
        light = ("--sun", "200,50,0.3", "--texture", self.ppm([[(200, 100, 50)]], "red.ppm"))
        frames = f"{times[0]},2026-06-21T08:44+02:00,PT45M{BERLIN}"
        before = self.files()
        report = self.good(source, "day.png", "--statistics", "--quiet", "--frames", frames, *light)
        names = ["day_20260621T%s+0200.png" % clock for clock in ("0630", "0715", "0800")]
        self.assertEqual(sorted(set(self.files()) - set(before)), names)
        self.assertIn("rays-traced: %d" % (2 * 3 * 16 * 12), report)
        for name, time in zip(names, times):
            self.good(source, "one.png", "--quiet", "--sun-at", time + BERLIN, *light)
            self.assertEqual(Picture(self.path(name)), Picture(self.path("one.png")))
        self.assertNotEqual(Picture(self.path(names[0])).rows, Picture(self.path(names[1])).rows)

    def test_frames_of_layers(self):
        source = self.hills()
        frames = f"2026-06-21T06:30:30Z,2026-06-21T06:31:00Z,30s{BERLIN}"
        self.good(source, "day.tif", "--quiet", "--frames", frames, "--layers", "illumination",
                  "--shadow-mask", "shadow.tif")
        self.good(source, "--quiet", "--frames", frames, "--layers", "normals,layers.exr")
        for time in ("20260621T063030Z", "20260621T063100Z"):
            for name in (f"day_{time}.tif", f"day_{time}-illumination.tif", f"layers_{time}.exr",
                         f"shadow_{time}.tif"):
                self.assertTrue(os.path.exists(self.path(name)), name)
        self.assertEqual(len([name for name in self.files() if "T063" in name]), 8)

    def test_frames_of_shadows(self):
        """Each frame has a mask of its own, and that is the one of its time."""
        source = self.hills()
        frames = f"{MORNING},2026-06-21T12:30+02:00,3h{BERLIN}"
        before = self.files()
        self.good(source, "--quiet", "--frames", frames, "--shadow-mask", "hidden.png")
        names = ["hidden_20260621T%s+0200.png" % clock for clock in ("0630", "0930", "1230")]
        self.assertEqual(sorted(set(self.files()) - set(before)), names)
        masks = [Picture(self.path(name)) for name in names]
        for mask, time in zip(masks, ("06:30", "09:30", "12:30")):
            at = f"2026-06-21T{time}+02:00{BERLIN}"
            self.good(source, "--quiet", "--sun-at", at, "--shadow-mask", "one.png")
            self.assertEqual(mask, Picture(self.path("one.png")))
        hidden = [sum(value == 255 for row in mask.rows for value in row) for mask in masks]
        self.assertTrue(hidden[0] > hidden[1] > hidden[2], hidden)
        # A frame's mask is held against what is read, too.
        other = self.plane(name=names[1])
        self.bad(2, ["would replace INPUT"], other, "--frames", frames, "--shadow-mask", "hidden.png")

    def test_frames_are_of_the_first_sun(self):
        """Whatever other lights there are, masks change with the frames."""
        source = self.hills()
        frames = f"2026-06-21T06:30+02:00,2026-06-21T08:30+02:00,1h{BERLIN}"
        for k, words in enumerate((["--sun", "315,20"], ["--preset", "multidirectional"])):
            self.good(source, "--quiet", "--frames", frames, "--shadow-mask", f"m{k}.png", *words)
            masks = [Picture(self.path(f"m{k}_20260621T{hour}30+0200.png")).rows
                     for hour in ("06", "07", "08")]
            self.assertNotEqual(masks[0], masks[1])
            self.assertNotEqual(masks[1], masks[2])

    @needsGdal
    def test_frames_in_bands_and_threads(self):
        """Heights that are prepared once give what they give anew, whatever the rows and threads."""
        large = self.grid([[(x * x + 3 * y) % 37 + x // 9 for x in range(2000)] for y in range(700)],
                          "large.asc", size=5)
        frames = f"{MORNING},2026-06-21T07:30+02:00,1h{BERLIN}"
        for threads in (1, 3):
            # The threads' library may say that there are fewer processors.
            done = self.run_(large, f"t{threads}.tif", "--frames", frames, "--threads", threads)
            self.assertEqual(done.returncode, 0)
        self.good(large, "one.tif", "--sun-at", "2026-06-21T07:30+02:00" + BERLIN)

        last = "20260621T0730+0200"
        self.assertEqual(self.read(f"t1_{last}.tif"), self.read(f"t3_{last}.tif"))
        self.assertEqual(self.read(f"t1_{last}.tif"), self.read("one.tif"))

    def test_frames_at_night(self):
        frames = f"2026-06-21T00:00+02:00,2026-06-21T06:00+02:00,2h{BERLIN}"
        result = self.run_("plane.asc", "day.png", "--frames", frames)
        self.assertEqual(result.returncode, 0)
        self.assertEqual(len(result.stderr.splitlines()), 1)
        self.assertIn("below the horizon in 3 of 4 frames", result.stderr)  # it rises at 4:43
        self.assertEqual(len([name for name in self.files() if name.startswith("day_")]), 4)

    def test_frames_replace_no_input(self):
        name = self.plane(name="day_20260621T0730+0200.png")
        frames = f"{MORNING},2026-06-21T08:30+02:00,30min{BERLIN}"
        before = self.read(name)
        self.bad(2, ["would replace INPUT"], name, "day.png", "--frames", frames)
        self.bad(2, ["would replace"], "plane.asc", "day.png", "--frames", frames, "--mask", name)
        self.assertEqual(self.read(name), before)
        self.assertEqual([n for n in self.files() if n.startswith("day")], [name])

    def test_frames_that_fail_leave_whole_ones(self):
        os.mkdir(self.path("day_20260621T0730+0200.png"))
        frames = f"{MORNING},2026-06-21T07:30+02:00,1h{BERLIN}"
        self.bad(1, "day_20260621T0730+0200.png", "plane.asc", "day.png", "--frames", frames)
        self.assertEqual(Picture(self.path("day_20260621T0630+0200.png")).width, 8)
        self.assertFalse([name for name in self.files() if ".tmp" in name])

    def test_refused(self):
        def refused(fragments, *words, code=2):
            line = self.bad(code, fragments, "plane.asc", "bad.png", *words)
            self.assertLessEqual(len(line), 220)
            self.assertFalse([name for name in self.files() if name.startswith("bad")])

        refused(["--sun-at", "'2026-06-21' has no time"], "--sun-at", "2026-06-21")
        refused(["--sun-at", "has no zone"], "--sun-at", "2026-06-21T06:30" + BERLIN)
        refused(["--sun-at", "calendar"], "--sun-at", "2025-02-29T06:30Z" + BERLIN)
        refused(["--sun-at", "1600 to 2399"], "--sun-at", "1599-02-28T06:30Z" + BERLIN)
        refused(["--sun-at", "latitude 91"], "--sun-at", MORNING + ",0,91")
        refused(["--sun-at", "longitude 400"], "--sun-at", MORNING + ",400,9")
        refused(["--sun-at", "'13' is not"], "--sun-at", MORNING + ",13")
        refused(["--refraction", "20000"], "--refraction", "20000")
        refused(["--refraction", "'low'"], "--refraction", "low")
        refused(["--frames", "START,END,STEP"], "--frames", MORNING)
        refused(["--frames", "no duration"], "--frames", f"{MORNING},{MORNING},15" + BERLIN)
        refused(["--frames", "not before"], "--frames", f"{MORNING},2026-06-21T00:00Z,1h" + BERLIN)
        refused(["--frames", "10000"], "--frames", f"{MORNING},2027-06-21T00:00Z,1s" + BERLIN)
        refused(["--frames", "more than once"], *2 * ("--frames", f"{MORNING},{MORNING},1h" + BERLIN))
        many = ("--frames", f"{MORNING},{MORNING},1h" + BERLIN)
        refused(["--save-scene", "--frames"], *many, "--save-scene", "bad.json")
        refused(["--accuracy-report", "--frames"], *many, "--accuracy-report", "bad.csv")
        # The place is not known.
        self.png([[1, 2], [3, 4]], "plain.png")
        self.bad(1, ["plain.png", "no georeference", "--sun-at TIME,LON,LAT"], "plain.png", "bad.png",
                 "--quiet", "--sun-at", MORNING)
        self.bad(1, ["plain.png", "--frames START,END,STEP,LON,LAT"], "plain.png", "bad.png", "--quiet",
                 "--frames", f"{MORNING},{MORNING},1h")


if __name__ == "__main__":
    unittest.main()
