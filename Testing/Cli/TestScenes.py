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
        self.assertColour([0.5] * 3, *words, "--preset", "sky-dome")
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

    def test_a_failed_run_keeps_the_old_file(self):
        with open(self.path("scene.json"), "w") as stream:
            stream.write("old")
        self.bad(1, "absent.asc", "absent.asc", "out.png", "--save-scene", "scene.json")
        with open(self.path("scene.json")) as stream:
            self.assertEqual(stream.read(), "old")


if __name__ == "__main__":
    unittest.main()
