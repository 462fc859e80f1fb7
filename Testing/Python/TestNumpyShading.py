# SPDX-License-Identifier: BSD-3-Clause
"""Heights go in and colours come out as NumPy arrays, with the values that the model gives."""

import os
import sys
import unittest

import numpy as np
from reliefshading import vtkImageReliefShading, vtkReliefScene
from vtkmodules.vtkRenderingCore import vtkLight

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..",
                                "Examples", "Python"))
from NumpyShading import from_image, shade, to_image  # noqa: E402

RNG = np.random.default_rng(7)


def hills(rows=60, columns=80):
    y, x = np.mgrid[0:rows, 0:columns]
    return 3.0 * np.sin(x / 7.0) * np.cos(y / 9.0)


class TestNumpyShading(unittest.TestCase):
    def test_arrays_come_back_as_they_went_in(self):
        for shape in ((4, 7), (4, 7, 3)):
            for dtype in (np.uint8, np.int16, np.float32, np.float64):
                array = RNG.integers(0, 100, shape).astype(dtype)
                back = from_image(to_image(array))
                self.assertEqual(back.dtype, dtype)
                np.testing.assert_array_equal(back.reshape(shape), array)

    def test_shape_type_and_alpha(self):
        colors = shade(hills())
        self.assertEqual((colors.shape, colors.dtype), ((60, 80, 4), np.float32))
        np.testing.assert_array_equal(colors[..., 3], 1.0)
        encoded = shade(hills(), encoded=True)
        self.assertEqual((encoded.shape, encoded.dtype), ((60, 80, 4), np.uint8))

    def test_input_is_left_alone(self):
        heights = hills()
        before = heights.copy()
        shade(heights)
        np.testing.assert_array_equal(heights, before)

    def test_height_types_agree(self):
        heights = np.round(hills())
        expected = shade(heights)
        for dtype in (np.int8, np.int16, np.int32, np.float32):
            np.testing.assert_array_equal(shade(heights.astype(dtype)), expected)

    def test_views_agree(self):
        heights = hills()
        np.testing.assert_array_equal(shade(heights[::2, ::-1]),
                                      shade(np.ascontiguousarray(heights[::2, ::-1])))

    def test_tilted_plane_is_the_cosine(self):
        y, x = np.mgrid[0:60, 0:60]
        # Row 0 is on top, so y runs against the rows: z rises by 0.2 to the right and 0.1 up.
        heights = 0.5 * (0.2 * x - 0.1 * y)
        normal = np.array((-0.2, -0.1, 1.0)) / np.linalg.norm((-0.2, -0.1, 1.0))
        for azimuth, altitude in ((315.0, 45.0), (20.0, 35.0), (180.0, 80.0)):
            for depth in (0.25, 1.0):
                scene = vtkReliefScene()
                scene.SetTolerance(0.0)
                scene.GetMaterial().SetOffsetModeToSurfaceNormal()
                scene.GetMaterial().SetSubsurfaceDepth(depth)
                scene.AddSun(azimuth, altitude)
                a, h = np.radians((azimuth, altitude))
                sun = np.array((np.sin(a) * np.cos(h), np.cos(a) * np.cos(h), np.sin(h)))
                colors = shade(heights, (0.5, 0.5), scene)
                # Beyond the edge the surface is level, so the plane ends a few samples before it.
                np.testing.assert_allclose(colors[10:-10, 10:-10, :3], normal @ sun, atol=1e-5)

    def test_row_0_is_on_top(self):
        # A wall along the middle row, lit from the north: its shadow falls on the rows below it.
        heights = np.zeros((41, 41))
        heights[20] = 5.0
        scene = vtkReliefScene()
        scene.AddSun(0.0, 45.0)
        light = shade(heights, scene=scene)[:, 20, 0]
        self.assertLess(light[23], 0.5 * light[17])

    def test_two_suns_sum(self):
        def lit(*suns):
            scene = vtkReliefScene()
            scene.SetTolerance(0.0)
            scene.GetMaterial().SetSpecularCoefficient(0.3)
            for azimuth, color in suns:
                scene.AddSun(azimuth, 40.0).SetDiffuseColor(color)
            return shade(hills(), scene=scene)[..., :3]

        one, two = (300.0, (1.0, 0.5, 0.25)), (60.0, (0.2, 0.4, 0.8))
        np.testing.assert_allclose(lit(one, two), lit(one) + lit(two), rtol=1e-5, atol=1e-6)

    def test_layers_sum_to_the_color(self):
        shading = vtkImageReliefShading()
        shading.SetInputData(to_image(hills()))
        scene = shading.GetScene()
        scene.GetMaterial().SetBaseColor(0.1, 0.05, 0.0)
        scene.GetMaterial().SetSpecularCoefficient(0.2)
        scene.GetMaterial().SetForwardScatterCoefficient(0.3)
        scene.GetMaterial().SetForwardScatterRange(-1.0, 1.0)
        lamp = vtkLight()
        lamp.PositionalOn()
        lamp.SetPosition(40.0, 30.0, 25.0)
        scene.AddLight(lamp)
        layers = ("Base", "Diffuse", "Scatter", "Specular")
        for layer in layers:
            getattr(shading, f"Generate{layer}On")()
        shading.Update()
        output = shading.GetOutput()
        total = sum(from_image(output, layer) for layer in layers)
        np.testing.assert_allclose(total, from_image(output)[..., :3], atol=1e-6)

    def test_nan_is_a_hole(self):
        heights = hills()
        heights[10:20, 30:40] = np.nan
        colors = shade(heights)
        np.testing.assert_array_equal(colors[10:20, 30:40], 0.0)
        self.assertEqual(np.count_nonzero(colors[..., 3] == 0.0), 100)
        self.assertTrue(np.isfinite(colors).all())

    def test_encoding_is_srgb(self):
        linear = np.clip(shade(hills())[..., :3].astype(float), 0.0, 1.0)
        srgb = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
        encoded = shade(hills(), encoded=True)
        np.testing.assert_allclose(encoded[..., :3], 255.0 * srgb, atol=0.51)
        np.testing.assert_array_equal(encoded[..., 3], 255)


if __name__ == "__main__":
    unittest.main()
