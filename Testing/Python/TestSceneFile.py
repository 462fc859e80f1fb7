# SPDX-License-Identifier: BSD-3-Clause
"""Scenes as files and texts from Python; Python's own parser takes them too."""

import json
import os
import pathlib
import tempfile
import unittest

import numpy as np
import reliefshading
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

    def test_functions(self):
        """Written from one picture's scene and read for another, which is the same to the last bit."""
        y, x = np.mgrid[0:48, 0:64]
        heights = 9.0 * np.sin(x / 5.0) * np.cos(y / 7.0)
        relief = reliefshading.Relief(heights, spacing=3, suns=[(300, 20, 0.5), (70, 50)], depth=7,
                                      height_scale=1.5, diffuse_color="wheat")
        picture = relief.shade()
        with tempfile.TemporaryDirectory() as folder:
            name = pathlib.Path(folder) / "abend ä.json"
            reliefshading.write_scene(relief.scene, name)
            self.assertEqual(json.loads(name.read_text(encoding="utf-8"))["material"]["subsurfaceDepth"], 7)
            scene = reliefshading.read_scene(name)
            self.assertIsInstance(scene, vtkReliefScene)
            for given in (scene, name, str(name), os.fsencode(name)):
                again = reliefshading.shade(heights, spacing=3, scene=given)
                np.testing.assert_array_equal(again.image, picture.image)
            # What is given beside it holds, and a Relief reads its file but once.
            relief = reliefshading.Relief(heights, spacing=3, scene=name)
            other = reliefshading.shade(heights, spacing=3, scene=scene, depth=0, sun=(90, 10))
            name.unlink()
            np.testing.assert_array_equal(relief.shade(depth=0, sun=(90, 10)).image, other.image)
            np.testing.assert_array_equal(relief.shade().image, picture.image)
        self.assertTrue((other.image != picture.image).any())

    def test_mistakes_of_functions(self):
        heights = np.zeros((3, 4))
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "scene.json")

            def refused(kind, text, call, *arguments, **keywords):
                with self.assertRaisesRegex(kind, text) as caught:
                    call(*arguments, **keywords)
                self.assertLessEqual(len(str(caught.exception)), 300)
                self.assertIs(type(caught.exception), kind)

            for call in (lambda: reliefshading.read_scene(name), lambda: reliefshading.shade(heights, scene=name),
                         lambda: reliefshading.Relief(heights, scene=name)):
                refused(FileNotFoundError, "scene.json.*does not exist", call)
            refused(FileNotFoundError, "^scene: Cannot read", reliefshading.shade, heights, scene="none.json")
            for nothing in ("", "a\0b", b"\0"):
                refused(ValueError, "a scene file's name is expected", reliefshading.read_scene, nothing)
            odd = os.path.join(os.fsencode(folder), b"\xff.json")
            reliefshading.write_scene(vtkReliefScene(), odd)
            self.assertEqual(os.listdir(os.fsencode(folder)), [b"\xff.json"])
            reliefshading.read_scene(os.fsdecode(odd))
            os.remove(odd)
            refused(OSError, "folder", reliefshading.read_scene, folder)
            for content, text in (("", "empty"), ("{", "scene.json"), ("{}", "reliefScene"),
                                  ('{"reliefScene": 1,\n"tolerance": -1}', "line 2.*tolerance"),
                                  ('{"reliefScene": 2}', "version 2")):
                pathlib.Path(name).write_text(content, encoding="utf-8")
                refused(ValueError, text, reliefshading.read_scene, name)
            pathlib.Path(name).write_text('{"reliefScene": 1, "colour": 3}', encoding="utf-8")
            with self.assertWarnsRegex(reliefshading.ReliefWarning, "colour"):
                reliefshading.read_scene(name)
            refused(TypeError, "a scene file's name is expected, not 3", reliefshading.read_scene, 3)
            refused(TypeError, "scene: a vtkReliefScene or a file's name is expected, not int",
                    reliefshading.shade, heights, scene=3)
            refused(TypeError, "a vtkReliefScene is expected, not Relief", reliefshading.write_scene,
                    reliefshading.Relief(heights), name)
            refused(OSError, "none", reliefshading.write_scene, vtkReliefScene(),
                    os.path.join(folder, "none", "scene.json"))
            scene = reliefshading.Relief(heights, environment=np.ones((4, 8)))
            scene.shade()
            refused(ValueError, "without a file name", reliefshading.write_scene, scene.scene, name)

    def test_environment_of_a_file(self):
        """A Radiance picture beside the scene, by whatever reads it in this build."""
        heights = np.fromfunction(lambda y, x: 4 * np.hypot(x - 9, y - 7), (16, 20))
        codes = np.random.default_rng(5).integers(1, 256, (8, 16, 4), np.uint8)
        codes[..., 3] = codes[..., 3] % 8 + 124
        colors = (codes[..., :3] * np.exp2(codes[..., 3:].astype(float) - 136)).astype(np.float32)
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "sky.hdr").write_bytes(
                b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n" + codes.tobytes())
            name = pathlib.Path(folder) / "scene.json"
            name.write_text('{"reliefScene": 1, "environment": {"image": "file", "file": "sky.hdr"}}')
            read = reliefshading.shade(heights, scene=name, dtype="float32")
            given = reliefshading.shade(heights, environment=colors, dtype="float32")
            np.testing.assert_array_equal(read.image, given.image)
            self.assertGreater(np.ptp(given.image[..., 0]), 0.01)
            (pathlib.Path(folder) / "sky.hdr").write_bytes(b"#?RADIANCE\n\n-Y 8 +X 16\n" + bytes(99))
            with self.assertRaisesRegex(ValueError, "sky.hdr"):
                reliefshading.read_scene(name)


if __name__ == "__main__":
    unittest.main()
