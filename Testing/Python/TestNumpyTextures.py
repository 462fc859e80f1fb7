# SPDX-License-Identifier: BSD-3-Clause
"""Textures and tints made of NumPy arrays, against the model's equation in NumPy."""

import os
import sys
import unittest

import numpy as np
from reliefshading import vtkImageReliefShading
from vtkmodules.vtkCommonCore import vtkLookupTable

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..",
                                "Examples", "Python"))
from NumpyShading import from_image, to_image  # noqa: E402

ROWS, COLUMNS = 50, 70
LAYERS = ("Base", "Diffuse", "Scatter", "Specular")


def decoded(encoded):
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def shading():
    y, x = np.mgrid[0:ROWS, 0:COLUMNS]
    result = vtkImageReliefShading()
    result.SetInputData(to_image(3.0 * np.sin(x / 7.0) * np.cos(y / 9.0)))
    scene = result.GetScene()
    scene.AddSun(315.0, 40.0).SetDiffuseColor(1.0, 0.8, 0.6)
    scene.AddSun(120.0, 25.0).SetIntensity(0.4)
    material = scene.GetMaterial()
    material.SetBaseColor(0.1, 0.2, 0.3)
    material.SetDiffuseColor(0.5, 0.5, 0.5)
    material.SetSpecularColor(0.5, 0.5, 0.5)
    material.SetSpecularCoefficient(0.3)
    material.SetForwardScatterCoefficient(0.4)
    material.SetForwardScatterRange(-1.0, 1.0)
    for layer in LAYERS:
        getattr(result, f"Generate{layer}On")()
    return result


def layers(filter_):
    filter_.Update()
    return {layer: from_image(filter_.GetOutput(), layer) for layer in LAYERS}


class TestNumpyTextures(unittest.TestCase):
    def setUp(self):
        self.random = np.random.default_rng(3)
        self.plain = layers(shading())

    def check(self, texture, expected):
        """The layers with a texture on every port are the plain ones times the expected colours."""
        textured = shading()
        for port in ("Diffuse", "Base", "Specular"):
            getattr(textured, f"Set{port}TextureData")(to_image(texture))
        got = layers(textured)
        for layer in LAYERS:
            constant = np.array((0.1, 0.2, 0.3)) if layer == "Base" else 0.5
            colors = expected(constant)
            np.testing.assert_allclose(got[layer], self.plain[layer] / constant * colors,
                                       rtol=1e-5, atol=1e-6)
        np.testing.assert_allclose(sum(got.values()),
                                   from_image(textured.GetOutput())[..., :3], rtol=1e-6, atol=1e-6)

    def test_codes(self):
        for dtype in (np.uint8, np.uint16):
            top = np.iinfo(dtype).max
            texture = self.random.integers(0, top, (ROWS, COLUMNS, 3), dtype, endpoint=True)
            self.check(texture, lambda _: decoded(texture / top))

    def test_floats(self):
        for dtype in (np.float32, np.float64):
            texture = self.random.uniform(0.0, 4.0, (ROWS, COLUMNS, 3)).astype(dtype)
            self.check(texture, lambda _: texture)

    def test_alpha(self):
        texture = self.random.uniform(0.0, 1.0, (ROWS, COLUMNS, 4))
        alpha = texture[..., 3:]
        self.check(texture, lambda constant: alpha * texture[..., :3] + (1.0 - alpha) * constant)

    def test_grey(self):
        texture = self.random.uniform(0.0, 1.0, (ROWS, COLUMNS))
        self.check(texture, lambda _: texture[..., np.newaxis])

    def test_row_0_is_on_top(self):
        texture = np.zeros((ROWS, COLUMNS, 3), np.uint8)
        texture[0] = 255
        tops = shading()
        tops.SetBaseTextureData(to_image(texture))
        base = layers(tops)["Base"]
        np.testing.assert_allclose(base[0], 0.7, rtol=1e-6)
        np.testing.assert_array_equal(base[1:], 0.0)

    def test_stretched(self):
        # 2 x 2 texels over the whole; bilinear between their centres, level beyond them.
        texture = np.array(((0.0, 1.0), (2.0, 3.0)))
        stretched = shading()
        stretched.SetBaseTextureData(to_image(texture, (1e-3, 1e-3)))
        stretched.StretchTexturesOn()
        y = np.clip((np.arange(ROWS) + 0.5) * 2.0 / ROWS - 0.5, 0.0, 1.0)
        x = np.clip((np.arange(COLUMNS) + 0.5) * 2.0 / COLUMNS - 0.5, 0.0, 1.0)
        expected = 0.7 * (2.0 * y[:, np.newaxis] + x)
        np.testing.assert_allclose(layers(stretched)["Base"][..., 0], expected, atol=1e-6)

    def test_tint(self):
        heights = np.round(self.random.uniform(0.0, 99.0, (ROWS, COLUMNS)))
        table = vtkLookupTable()
        table.SetNumberOfTableValues(100)
        table.SetTableRange(0.0, 100.0)
        table.Build()
        codes = self.random.integers(0, 256, (100, 3))
        for k, color in enumerate(codes / 255.0):
            table.SetTableValue(k, *color, 1.0)

        def diffuse(lookup_table):
            tinted = shading()
            tinted.SetInputData(to_image(heights))
            tinted.SetLookupTable(lookup_table)
            return layers(tinted)["Diffuse"]

        colors = decoded(codes / 255.0)[heights.astype(int)]
        np.testing.assert_allclose(diffuse(table), diffuse(None) / 0.5 * colors,
                                   rtol=1e-5, atol=1e-6)


if __name__ == "__main__":
    unittest.main()
