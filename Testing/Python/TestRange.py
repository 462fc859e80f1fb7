# SPDX-License-Identifier: BSD-3-Clause
"""Pictures use their range as they come: terrains, up to three times as steep as they are, under every preset."""

import os
import unittest

import numpy as np
from reliefshading import vtkImageReliefShading, vtkReliefRasterReader, vtkReliefScene
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData

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


def image(heights, spacing):
    result = vtkImageData()
    result.SetDimensions(heights.shape[1], heights.shape[0], 1)
    result.SetSpacing(spacing, spacing, 1.0)
    result.GetPointData().SetScalars(numpy_to_vtk(heights.ravel(), deep=1))
    return result


def fractal(rows, columns, power, seed):
    """Heights whose waves are the lower the shorter they are, between -1 and 1."""
    waves = np.fft.rfft2(np.random.default_rng(seed).normal(size=(rows, columns)))
    length = np.hypot(np.fft.fftfreq(rows)[:, None], np.fft.rfftfreq(columns)[None, :])
    length[0, 0] = np.inf
    heights = np.fft.irfft2(waves / length**power, (rows, columns))
    return heights / np.abs(heights).max()


def mountains():
    """As steep as any that are seen from far: half of their slopes are above 25 degrees."""
    heights = fractal(240, 320, 2.0, 1)
    slopes = np.hypot(*np.gradient(heights))
    return image(heights * np.tan(np.radians(25.0)) / np.median(slopes) * 30.0, 30.0)


def houses():
    """Half a metre between samples of gentle ground with walls on it."""
    heights = 4.0 * fractal(240, 320, 2.5, 2)
    for y, x in np.random.default_rng(3).integers((10, 10), (220, 300), (25, 2)):
        heights[y : y + 14, x : x + 18] = heights[y, x] + 5.0
    return image(heights, 0.5)


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
        self.check_presets()

    def test_mountains(self):
        self.shading.SetInputData(mountains())
        self.check_presets()

    def test_houses(self):
        self.shading.SetInputData(houses())
        self.check_presets()

    def check_presets(self):
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
