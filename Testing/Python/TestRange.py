# SPDX-License-Identifier: BSD-3-Clause
"""Pictures use their range as they come: a terrain, three times as steep as it is, under every preset."""

import os
import unittest

import numpy as np
from reliefshading import vtkImageReliefShading, vtkReliefRasterReader, vtkReliefScene
from vtkmodules.util.numpy_support import vtk_to_numpy

TERRAIN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Examples", "Data",
                       "jacksboro.tif")
PRESETS = {
    "none": lambda scene: None,
    "default": vtkReliefScene.SetLightsToDefault,
    "multidirectional": vtkReliefScene.SetLightsToMultidirectional,
    "sky dome": vtkReliefScene.SetLightsToSkyDome,
    "sun and sky": lambda scene: scene.SetLightsToSunAndSky(315.0, 45.0),
}


def encoded(linear):
    c = np.clip(linear, 0.0, 1.0)
    return 255.0 * np.where(c <= 0.0031308, 12.92 * c, 1.055 * c ** (1.0 / 2.4) - 0.055)


def span(codes):
    low, high = np.percentile(codes, (5, 95))
    return high - low


def lambert(scene, normals):
    """What a hillshade without shadows makes of a scene's suns; a sky is the same all round."""
    total = np.zeros(len(normals))
    lights = scene.GetLights()
    for k in range(lights.GetNumberOfItems()):
        light = lights.GetItemAsObject(k)
        total += light.GetIntensity() * np.clip(normals @ np.array(light.GetPosition()), 0.0, None)
    if scene.GetEnvironment():
        total += scene.GetEnvironment().GetIntensity() * (1.0 + normals[:, 2]) / 2.0
    return encoded(total)


class TestRange(unittest.TestCase):
    def setUp(self):
        self.reader = vtkReliefRasterReader()
        self.reader.SetFileName(TERRAIN)
        self.shading = vtkImageReliefShading()
        self.shading.SetInputConnection(self.reader.GetOutputPort())
        self.shading.SetOutputScalarTypeToUnsignedChar()
        self.shading.GenerateNormalsOn()

    def shade(self):
        self.shading.Update()
        layers = self.shading.GetOutput().GetPointData()
        rgba = vtk_to_numpy(layers.GetScalars())
        seen = rgba[:, 3] > 0
        return rgba[seen, :3].astype(float), vtk_to_numpy(layers.GetArray("Normals"))[seen]

    def test_presets(self):
        for name, prepare in PRESETS.items():
            for scale in (1.0, 2.0, 3.0):
                with self.subTest(preset=name, scale=scale):
                    scene = vtkReliefScene()
                    prepare(scene)
                    scene.SetHeightScale(scale)
                    self.shading.SetScene(scene)
                    rgb, normals = self.shade()
                    if name == "none":
                        scene = vtkReliefScene()
                        scene.SetLightsToDefault()
                    hillshade = lambert(scene, normals)
                    self.assertLessEqual(np.mean(rgb.max(axis=1) == 255), 0.01)
                    # What a hillshade lights and a hill shadows is dark, and yet not black.
                    self.assertLessEqual(np.mean((rgb.max(axis=1) == 0) & (hillshade > 0)), 0.02)
                    if span(hillshade) >= 100:
                        self.assertGreaterEqual(span(rgb.mean(axis=1)), 100)

    def test_automatic_exposure(self):
        for name, prepare in PRESETS.items():
            with self.subTest(preset=name):
                scene = vtkReliefScene()
                prepare(scene)
                scene.AutomaticExposureOn()
                self.shading.SetScene(scene)
                rgb, _ = self.shade()
                self.assertLessEqual(np.mean(rgb.max(axis=1) == 255), 0.0051)
                self.assertGreaterEqual(np.mean(rgb.max(axis=1) >= 253), 0.002)


if __name__ == "__main__":
    unittest.main()
