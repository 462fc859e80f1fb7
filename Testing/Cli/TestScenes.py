# SPDX-License-Identifier: BSD-3-Clause
"""reliefshade's scene files: kept and read again, and changed by other options."""

import json
import os
import unittest

from Reliefshade import Case


class Scenes(Case):
    WORDS = ("--height-scale", "2", "--diffuse", "0.9,0.7,0.5", "--ks", "0.2", "--depth", "0.7",
             "--sun", "300.5,20,0.8", "--point", "3,4,9,0.5,1,0.5,0.25", "--sun-diameter", "2",
             "--tolerance", "0.001", "--offset", "normal", "--floor", "-3")

    def scene(self, name="scene.json"):
        with open(self.path(name)) as stream:
            return json.load(stream)

    def test_round_trip(self):
        hills = self.hills(size=30, corner=(1000, 2000))
        first = self.shade(hills, *self.WORDS, "--save-scene", "scene.json")
        scene = self.scene()
        self.assertEqual(scene["heightScale"], 2)
        self.assertEqual([light["kind"] for light in scene["lights"]], ["sun", "point"])
        self.assertEqual(scene["lights"][0]["azimuth"], 300.5)
        self.assertEqual(scene["lights"][1]["position"], [3, 4, 9])  # the map's
        second = self.shade(hills, "--scene", "scene.json", "--save-scene", "again.json")
        self.assertEqual(first, second)
        self.assertEqual(scene, self.scene("again.json"))

    def test_environments(self):
        hills = self.hills()
        for words in (("--preset", "sun-and-sky,100,30"), ("--preset", "sky-dome"),
                      ("--env", self.ppm([[(250, 200, 90), (10, 20, 90)]], "sky.ppm"),
                       "--env-rotation", "30")):
            first = self.shade(hills, *words, "--save-scene", "scene.json")
            self.assertEqual(first, self.shade(hills, "--scene", "scene.json"))
        self.assertEqual(self.scene()["environment"]["file"], "sky.ppm")
        # The folder may be moved.
        os.makedirs(self.path("moved"))
        for name in ("sky.ppm", "scene.json"):
            os.rename(self.path(name), self.path("moved/" + name))
        self.assertEqual(first, self.shade(hills, "--scene", "moved/scene.json"))

    def test_options_change_it(self):
        self.plane()
        with open(self.path("scene.json"), "w") as stream:
            json.dump({"reliefScene": 1, "material": {"diffuseColor": [0.5, 0.5, 0.5]},
                       "lights": [{"kind": "sun", "azimuth": 0, "altitude": 90}],
                       "environment": {"image": "whiteDome", "intensity": 0.5}}, stream)
        words = ("plane.asc", "--scene", "scene.json")
        self.assertColour([0.75] * 3, *words)
        self.assertColour([0.375] * 3, *words, "--diffuse", "0.25,0.25,0.25")
        self.assertColour([0.35] * 3, *words, "--sun", "0,90,0.2")
        self.assertColour([0.4] * 3, *words, "--sun", "0,90,0.1", "--sun", "0,90,0.2")
        self.assertColour([0.35] * 3, "plane.asc", "--sun", "0,90,0.2", "--scene=scene.json")
        self.assertColour([0.5] * 3, *words, "--env-intensity", "0")
        self.assertColour([0.31] * 3, *words, "--preset", "sky-dome")
        grey = self.ppm([[(188, 188, 188)]], "grey.ppm")  # half as bright as white
        self.assertColour([0.75] * 3, *words, "--env", grey)

    def test_mistakes(self):
        self.plane()
        words = ("plane.asc", "out.png", "--scene")
        self.bad(1, ["absent.json", "does not exist"], *words, "absent.json")
        for text, fragments in (("{", "line 1"),
                                ('{"reliefScene": 9}', "version 9"),
                                ('{"reliefScene": 1,\n"tolerance": -1}', "line 2, tolerance: -1")):
            with open(self.path("bad.json"), "w") as stream:
                stream.write(text)
            self.bad(1, ["bad.json", fragments], *words, "bad.json")
        self.bad(2, "--scene", *words)
        self.bad(2, "--save-scene", "plane.asc", "out.png", "--env", "x.exr", "--env-mirror",
                 "--save-scene", "s.json")
        self.assertFalse(os.path.exists(self.path("out.png")))
        self.bad(1, "no/such.json", "plane.asc", "out.png", "--save-scene", "no/such.json")

    def test_words_in_any_spelling(self):
        hills = self.hills()
        scene = {"reliefScene": 1, "integrator": "FixedStep", "material": {"offsetMode": "SurfaceNormal"},
                 "environment": {"image": "whiteDome", "sampling": "SolidAngle"}}
        pictures = []
        for words in (("FixedStep", "SurfaceNormal", "whiteDome", "SolidAngle"),
                      ("fixed-step", "normal", "white-dome", "solid-angle"),
                      ("Fixed step", "surface-normal", "WhiteDome", "solid_angle")):
            scene["integrator"], scene["material"]["offsetMode"] = words[:2]
            scene["environment"]["image"], scene["environment"]["sampling"] = words[2:]
            with open(self.path("s.json"), "w") as stream:
                json.dump(scene, stream)
            pictures.append(self.shade(hills, "--scene", "s.json"))
            pictures.append(self.shade(hills, "--integrator", words[0], "--offset", words[1],
                                       "--preset", "Sky-Dome", "--env-samples", "64",
                                       "--env-intensity", "1", "--type",
                                       "UInt8", "--depth", "Auto", "--nodata", "None",
                                       "--env-radius", "Infinite", "--env-sampling", words[3]))
        for picture in pictures[1:]:
            self.assertEqual(picture, pictures[0])
        self.good(hills, "o.png", "--scene", "s.json", "--save-scene", "again.json")
        self.assertEqual(self.scene("again.json")["integrator"], "FixedStep")

    def test_negative_light(self):
        """Takes light away, by whichever way it comes."""
        self.plane()
        with open(self.path("s.json"), "w") as stream:
            json.dump({"reliefScene": 1, "lights": [
                {"kind": "sun", "azimuth": 0, "altitude": 90},
                {"kind": "sun", "azimuth": 0, "altitude": 90, "intensity": -0.5, "color": [1, 0.5, -0.2]}]}, stream)
        linear = (0.5, 0.75, 1.1)
        self.assertColour(linear, "plane.asc", "--scene", "s.json")
        self.assertColour(linear, "plane.asc", "--sun", "0,90", "--sun", "0,90,-0.5,1,0.5,-0.2")
        self.assertColour((0, 0, 0), "plane.asc", "--sun", "0,90", "--sun", "0,90,-2")
        self.assertColour((0, 0, 0), "plane.asc", "--point", "4,4,1000,-1")

    def test_long_keys(self):
        self.plane()
        for long in ("k" * 50000, "k k" * 20000):
            for text in ('{"reliefScene": 1, "%s": 2}', '{"reliefScene": 1, "integrator": "%s"}',
                         '{"reliefScene": 1, "environment": {"image": "file", "file": "%s"}}', '{"%s'):
                with open(self.path("s.json"), "w") as stream:
                    stream.write(text.replace("%s", long))
                result = self.run_("plane.asc", "o.png", "--scene", "s.json")
                self.assertEqual(len(result.stderr.splitlines()), 1)
                self.assertLessEqual(len(result.stderr), 220, result.stderr)
                self.assertIn("s.json", result.stderr)

    def test_a_failed_run_keeps_the_old_file(self):
        with open(self.path("scene.json"), "w") as stream:
            stream.write("old")
        self.bad(1, "absent.asc", "absent.asc", "out.png", "--save-scene", "scene.json")
        with open(self.path("scene.json")) as stream:
            self.assertEqual(stream.read(), "old")


if __name__ == "__main__":
    unittest.main()
