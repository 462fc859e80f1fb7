# SPDX-License-Identifier: BSD-3-Clause
"""Scenes as files and texts from Python; Python's own parser takes them too."""

import json
import os
import tempfile
import unittest

from reliefshading import vtkReliefEnvironment, vtkReliefScene, vtkReliefSceneFile


class TestSceneFile(unittest.TestCase):
    def test_round_trip(self):
        scene = vtkReliefScene()
        scene.SetTolerance(0.1 + 0.2)
        scene.AddSun(315.0, 45.0).SetIntensity(1.0 / 3.0)
        environment = vtkReliefEnvironment()
        environment.SetImageToClearSky(315.0, 45.0, 2.5)
        environment.SetRadius(1e22)
        scene.SetEnvironment(environment)
        with tempfile.TemporaryDirectory() as folder:
            file = vtkReliefSceneFile()
            file.SetFileName(os.path.join(folder, "scéne.json"))
            file.SetScene(scene)
            self.assertTrue(file.Write())
            self.assertEqual(os.listdir(folder), ["scéne.json"])
            with open(file.GetFileName(), encoding="utf-8") as stream:
                content = json.load(stream)
            other = vtkReliefSceneFile()
            other.SetFileName(file.GetFileName())
            self.assertTrue(other.Read())
        self.assertEqual(content["reliefScene"], 1)
        self.assertEqual(content["tolerance"], 0.1 + 0.2)
        self.assertEqual(content["lights"][0]["azimuth"], 315)
        self.assertEqual(content["lights"][0]["intensity"], 1.0 / 3.0)
        self.assertEqual(content["environment"]["radius"], 1e22)
        self.assertEqual(other.GetScene().GetTolerance(), 0.1 + 0.2)
        self.assertEqual(other.GetScene().GetEnvironment().GetClearSkyParameters(),
                         (315.0, 45.0, 2.5))
        self.assertEqual(other.ToText(), file.ToText())

    def test_undo(self):
        file = vtkReliefSceneFile()
        before = file.ToText()
        file.GetScene().AddSun(1.0, 2.0)
        self.assertNotEqual(file.ToText(), before)
        self.assertTrue(file.FromText(before))
        self.assertEqual(file.ToText(), before)

    def test_mistake(self):
        file = vtkReliefSceneFile()
        errors = []
        file.AddObserver("ErrorEvent", lambda *_: errors.append(1))
        self.assertFalse(file.FromText(json.dumps({"reliefScene": 1, "heightScale": "high"})))
        self.assertEqual(len(errors), 1)
        self.assertNotEqual(file.GetErrorCode(), 0)


if __name__ == "__main__":
    unittest.main()
