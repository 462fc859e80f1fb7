# SPDX-License-Identifier: BSD-3-Clause
"""shade() gives what the classes give, whatever the array is like, and refuses what they refuse."""

import os
import re
import pickle
import subprocess
import sys
import tempfile
import unittest
import warnings

import numpy as np
import reliefshading
from reliefshading import Relief, shade, vtkImageReliefShading
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkRenderingCore import vtkLight

FILES = "vtkOpenImageIOReader" in reliefshading.__all__
LAYERS = ("illumination", "thickness", "shadow", "normals", "base", "diffuse", "scatter", "specular")


def hills(rows=60, columns=80, dtype=np.float32):
    y, x = np.mgrid[0:rows, 0:columns]
    return (30.0 * np.sin(x / 7.0) * np.cos(y / 9.0) + 30.0).astype(dtype)


def to_image(array, spacing, down=True):
    """An image of an array: its rows run down by a negative spacing, or they are turned over."""
    rows, columns = array.shape[:2]
    image = vtkImageData()
    image.SetDimensions(columns, rows, 1)
    image.SetSpacing(spacing[0], -spacing[1] if down else spacing[1], 1.0)
    image.SetOrigin(0.0, (rows - 1) * spacing[1] if down else 0.0, 0.0)
    image.AllocateScalars({np.dtype(np.float32): 10, np.dtype(np.uint8): 3}[array.dtype],
                          array.size // (rows * columns))
    values = array if down else array[::-1]
    scalars = image.GetPointData().GetScalars()
    vtk_to_numpy(scalars)[...] = values.reshape(vtk_to_numpy(scalars).shape)
    return image


def picture(shading, name="Shading", down=True):
    shading.Update()
    columns, rows, _ = shading.GetOutput().GetDimensions()
    values = vtk_to_numpy(shading.GetOutput().GetPointData().GetArray(name))
    values = values.reshape(rows, columns, *values.shape[1:])
    return values if down else values[::-1]


class TestShade(unittest.TestCase):
    def test_is_the_pipeline(self):
        """Every sample of every array, bit for bit."""
        heights = hills()
        for dtype in ("uint8", "float32"):
            shading = vtkImageReliefShading()
            shading.SetInputData(to_image(heights, (2.0, 3.0)))
            shading.SetOutputScalarType(3 if dtype == "uint8" else 10)
            scene = shading.GetScene()
            scene.SetHeightScale(0.5)
            scene.GetMaterial().SetSubsurfaceDepth(1.5)
            scene.GetMaterial().SetSpecularCoefficient(0.25)
            scene.GetMaterial().SetDiffuseColor(0.9, 0.5, 0.2)
            scene.AddSun(300.0, 30.0)
            scene.AddSun(90.0, 50.0).SetIntensity(0.25)
            lamp = vtkLight()
            lamp.PositionalOn()
            lamp.SetPosition(50.0, 60.0, 40.0)
            scene.AddLight(lamp)
            for layer in LAYERS:
                getattr(shading, f"Generate{layer.capitalize()}On")()
            result = shade(
                heights, spacing=(2.0, 3.0), dtype=dtype, height_scale=0.5, depth=1.5,
                specular_coefficient=0.25, diffuse_color=(0.9, 0.5, 0.2), lamp=(50, 60, 40),
                suns=[(300, 30), dict(azimuth=90, altitude=50, intensity=0.25)], layers=LAYERS)
            np.testing.assert_array_equal(result.image, picture(shading))
            self.assertEqual(list(result.layers), list(LAYERS))
            for layer in LAYERS:
                np.testing.assert_array_equal(result.layers[layer], picture(shading, layer.capitalize()))

    def test_is_the_pipeline_of_rows_turned_over(self):
        """The same surface from its other end: within the tolerance."""
        heights = hills()
        shading = vtkImageReliefShading()
        shading.SetInputData(to_image(heights, (1.0, 1.0), down=False))
        shading.GenerateIlluminationOn()
        shading.GenerateNormalsOn()
        shading.GetScene().AddSun(300.0, 20.0)
        result = shade(heights, sun=(300, 20), layers=("illumination", "normals"), dtype="float32")
        np.testing.assert_allclose(
            result.layers["illumination"], picture(shading, "Illumination", False), atol=6e-4)
        np.testing.assert_allclose(
            result.layers["normals"], picture(shading, "Normals", False), atol=1e-6)

    def test_images_of_vtk(self):
        heights = hills()
        picture = shade(heights, spacing=(2, 3), sun=(300, 20), layers="normals", nodata=heights[3, 4])
        for down in (True, False):
            image = to_image(heights, (2.0, 3.0), down)
            result = shade(image, sun=(300, 20), layers="normals", nodata=heights[3, 4])
            difference = result.image.astype(int) - picture.image
            self.assertLessEqual(abs(difference).max(), 0 if down else 1)
            np.testing.assert_allclose(result.layers["normals"], picture.layers["normals"], atol=1e-6)
            np.testing.assert_array_equal(result.mask, picture.mask)
            masked = shade(image, mask=picture.mask & (heights > 20))
            np.testing.assert_array_equal(masked.mask, picture.mask & (heights > 20))
            colors = np.random.default_rng(2).integers(0, 255, (60, 80, 3), np.uint8)
            np.testing.assert_array_equal(
                shade(image, base_texture=colors, layers="base").layers["base"],
                shade(heights, base_texture=colors, layers="base").layers["base"])
        with self.assertRaisesRegex(ValueError, "spacing: the image has its own"):
            shade(image, spacing=3)
        with self.assertRaisesRegex(ValueError, "heights: the image has no point scalars"):
            shade(vtkImageData())
        with self.assertRaisesRegex(ValueError, "heights: one slice"):
            shade(to_image(np.zeros((4, 5, 2), np.float32), (1.0, 1.0)))

    def test_lights_of_vtk(self):
        sun = vtkLight()
        sun.SetPosition(1.0, 1.0, 1.0)
        sun.SetIntensity(0.5)
        lamp = vtkLight()
        lamp.PositionalOn()
        lamp.SetPosition(30.0, 20.0, 50.0)
        lamp.SetDiffuseColor(1.0, 0.5, 0.0)
        got = shade(hills(), suns=[sun], lamp=lamp, dtype="float32").image
        altitude = np.degrees(np.arctan(0.5 ** 0.5))
        np.testing.assert_allclose(got, shade(
            hills(), sun=dict(azimuth=45, altitude=altitude, intensity=0.5), dtype="float32",
            lamp=dict(position=(30, 20, 50), color=(1, 0.5, 0))).image, atol=1e-3)
        off = shade(hills(), sun=dict(azimuth=0, altitude=45, on=False)).image
        self.assertEqual(off[..., :3].max(), 0)

    def test_row_0_is_north(self):
        heights = np.zeros((41, 41))
        heights[20] = 5.0
        light = shade(heights, sun=(0, 45), layers="illumination").layers["illumination"][:, 20]
        self.assertLess(light[23], 0.5 * light[17])
        # A lamp stands where x and y say, from the lower left sample.
        bright = shade(np.zeros((40, 60)), lamp=(50, 30, 2), dtype="float32").image[..., 0]
        self.assertEqual(np.unravel_index(bright.argmax(), bright.shape), (9, 50))

    def test_types(self):
        values = np.round(hills()) % 100
        expected = shade(values).image
        for dtype in ("i1", "u1", "i2", "u2", "i4", "u4", "i8", "u8", "f2", "f4", "f8", "g",
                      ">i2", ">f4", ">f8", "<i4", np.intc, np.longlong, np.ulonglong):
            with self.subTest(dtype):
                array = values.astype(dtype)
                before = array.copy()
                np.testing.assert_array_equal(shade(array).image, expected)
                np.testing.assert_array_equal(array, before)
        np.testing.assert_array_equal(shade(values > 50).image, shade((values > 50).astype("f8")).image)
        np.testing.assert_array_equal(shade(values.tolist()).image, expected)
        for array in (values + 1j, values.astype("M8[s]"), values.astype(str), values.astype(object),
                      np.zeros((4, 4), [("a", float)]), "heights", None, {}):
            with self.subTest(getattr(array, "dtype", array)), self.assertRaisesRegex(
                    TypeError, "heights: an array of real numbers is expected"):
                shade(array)

    def test_layouts(self):
        """The picture depends on values alone; an array in C order is used where it lies."""
        heights = hills()
        big = np.zeros((120, 240), np.float32)
        big[::2, 1::3] = heights
        read_only = heights.copy()
        read_only.flags.writeable = False
        unaligned = np.ndarray(heights.shape, np.float32, b"x" + heights.tobytes(), 1)
        layouts = {
            "unaligned": unaligned, "C": heights, "read-only": read_only, "F": np.asfortranarray(heights),
            "rows backward": np.ascontiguousarray(heights[::-1])[::-1],
            "columns backward": np.ascontiguousarray(heights[:, ::-1])[:, ::-1],
            "strided": big[::2, 1::3], "(1, n, m)": heights[np.newaxis],
            "(n, m, 1)": heights[..., np.newaxis],
            "memory": memoryview(heights), "transposed": np.ascontiguousarray(heights.T).T}
        free = ("C", "read-only", "(1, n, m)", "(n, m, 1)", "memory")
        expected = shade(heights, sun=(300, 20), dtype="float32").image
        for name, array in layouts.items():
            with self.subTest(name):
                relief = Relief(array, sun=(300, 20), dtype="float32")
                np.testing.assert_array_equal(relief.shade().image, expected)
                used = vtk_to_numpy(relief.filter.GetInput().GetPointData().GetScalars())
                self.assertEqual(np.shares_memory(used, np.asarray(array)), name in free)
                self.assertTrue(used.flags.aligned)

    def test_results_are_not_copied_and_live_on(self):
        relief = Relief(hills())
        first = relief.shade(sun=(0, 45), layers="illumination")
        kept, light = first.image.copy(), first.layers["illumination"].copy()
        second = relief.shade(sun=(180, 45), layers="illumination")
        self.assertFalse(first.image.flags.owndata)
        self.assertTrue(first.image.flags.c_contiguous and first.image.flags.writeable)
        self.assertFalse(np.shares_memory(first.image, second.image))
        del relief
        np.testing.assert_array_equal(first.image, kept)
        np.testing.assert_array_equal(first.layers["illumination"], light)
        self.assertFalse(np.array_equal(second.image, kept))

    def test_heights_live_as_long_as_they_are_needed(self):
        relief = Relief(np.ascontiguousarray(hills() * 2.0))
        expected = relief.shade().image.copy()
        relief.filter.ReleaseCache()
        rubbish = [np.full(hills().shape, k, np.float64) for k in range(9)]
        np.testing.assert_array_equal(relief.shade().image, expected)
        self.assertEqual(len(rubbish), 9)

    def test_no_data(self):
        heights = hills()
        hole = np.zeros(heights.shape, bool)
        hole[10:20, 30:50] = True
        expected = shade(np.where(hole, np.nan, heights), layers="illumination")
        self.assertTrue(np.isnan(expected.layers["illumination"])[hole].all())
        np.testing.assert_array_equal(expected.mask, ~hole)
        masked = np.ma.array(heights, mask=hole)
        for name, arguments in {
                "masked array": (masked, {}),
                "mask": (heights, {"mask": ~hole}),
                "numbers": (heights, {"mask": np.where(hole, 0.0, 7.0)}),
                "masked mask": (heights, {"mask": np.ma.array(np.ones(heights.shape, bool), mask=hole)}),
                "masked numbers": (heights, {"mask": np.ma.array(
                    np.full(heights.shape, 7.0), mask=hole & (heights > 30),
                ) * ~(hole & (heights <= 30))}),
                "NaN in the mask": (heights, {"mask": np.where(hole, np.nan, 1.0)}),
                "both": (np.ma.array(heights, mask=hole & (heights > 30)),
                         {"mask": ~hole | (heights > 30)}),
                "nodata": (np.where(hole, -9999.0, heights), {"nodata": -9999}),
                "half": (np.where(hole, -9999.0, heights), {"nodata": -9999})}.items():
            with self.subTest(name):
                array, keywords = arguments
                result = shade(array, **keywords)
                np.testing.assert_array_equal(result.mask, expected.mask)
                np.testing.assert_array_equal(result.image, expected.image)
        half = np.where(hole, -9999.0, heights).astype(np.float16)
        np.testing.assert_array_equal(shade(half, nodata=-9999).mask, ~hole)
        np.testing.assert_array_equal(shade(np.ma.array(heights)).image, shade(heights).image)
        painted = shade(masked, alpha=False, background="#102030")
        self.assertEqual(painted.shape, (60, 80, 3))
        np.testing.assert_array_equal(painted[15, 40], (16, 32, 48))
        np.testing.assert_array_equal(painted.mask, ~hole)
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            self.assertFalse(shade(np.full((4, 4), np.nan)).mask.any())
        self.assertEqual([w.category for w in caught], [reliefshading.ReliefWarning])
        self.assertIn("No sample has data", str(caught[0].message))
        self.assertEqual(caught[0].filename, __file__)

    def test_presets(self):
        heights = hills()
        for preset, call in {
                "default": lambda s: s.SetLightsToDefault(),
                "multidirectional": lambda s: s.SetLightsToMultidirectional(),
                "sky-dome": lambda s: s.SetLightsToSkyDome(),
                "sun-and-sky": lambda s: s.SetLightsToSunAndSky(315.0, 45.0),
                "combined": lambda s: s.SetLightsToCombined(315.0, 45.0),
                "igor": lambda s: s.SetLightsToIgor(315.0)}.items():
            with self.subTest(preset):
                shading = vtkImageReliefShading()
                shading.SetInputData(to_image(heights, (1.0, 1.0)))
                shading.SetOutputScalarTypeToUnsignedChar()
                call(shading.GetScene())
                expected = picture(shading)
                np.testing.assert_array_equal(shade(heights, preset=preset).image, expected)
                np.testing.assert_array_equal(
                    shade(heights, preset=preset.replace("-", "_")).image, expected)
        np.testing.assert_array_equal(shade(heights).image, shade(heights, preset="default").image)
        self.assertFalse(np.array_equal(shade(heights, preset="combined").image,
                                        shade(heights, preset="combined", sun=(90, 20)).image))
        np.testing.assert_array_equal(
            shade(heights, preset="combined", response="illumination").image,
            shade(heights, sun=(315, 45)).image)

    def test_suns_of_times(self):
        heights, place = hills(), (10.0, 47.0)
        shading = vtkImageReliefShading()
        shading.SetInputData(to_image(heights, (1.0, 1.0)))
        shading.SetOutputScalarTypeToUnsignedChar()
        shading.GetScene().AddSunAt("2026-06-21T08:30+02:00", *place, 2.0)
        import datetime
        zone = datetime.timezone(datetime.timedelta(hours=2))
        moment = datetime.datetime(2026, 6, 21, 8, 30, tzinfo=zone)
        for sun in (("2026-06-21T08:30+02:00", *place, 2.0), (moment, *place, 2.0),
                    dict(time=moment, longitude=10, latitude=47, convergence=2)):
            np.testing.assert_array_equal(shade(heights, sun_at=sun).image, picture(shading))
        angles = [0.0, 0.0]
        shading.GetScene().FindSun("2026-06-21T08:30+02:00", *place, 0.0, True, angles)
        np.testing.assert_array_equal(
            shade(heights, preset="sun-and-sky", sun_at=(moment, *place)).image,
            shade(heights, preset="sun-and-sky", sun=angles).image)
        with self.assertRaisesRegex(ValueError, "has no zone"):
            shade(heights, sun_at=(datetime.datetime(2026, 6, 21), *place))

    def test_environments(self):
        heights = hills()
        sky = np.zeros((8, 16, 3), np.float32)
        sky[:4, :4] = (4.0, 2.0, 1.0)  # the upper rows are up; the first columns begin in the east
        lit = shade(heights, environment=sky, environment_number_of_samples=128, layers="illumination",
                    dtype="float32")
        environment = reliefshading.vtkReliefEnvironment()
        image = to_image(sky, (1.0, 1.0), down=False)
        environment.SetImage(image)
        environment.SetNumberOfSamples(128)
        shading = vtkImageReliefShading()
        shading.SetInputData(to_image(heights, (1.0, 1.0)))
        shading.GetScene().SetEnvironment(environment)
        np.testing.assert_array_equal(lit.image, picture(shading))
        np.testing.assert_array_equal(
            shade(heights, environment=environment, dtype="float32").image, lit.image)
        self.assertEqual(environment.GetIntensity(), 1.0)
        half = shade(heights, environment=environment, environment_intensity=0.5, dtype="float32")
        self.assertEqual(environment.GetIntensity(), 1.0)
        np.testing.assert_allclose(half.image[..., :3], 0.5 * lit.image[..., :3], rtol=1e-5)

    def test_automatic(self):
        heights = np.uint8(np.round(hills() * 4.0))
        scene = reliefshading.vtkReliefScene()
        fitted = scene.FitHeightScale(to_image(heights, (1.0, 1.0)))
        result = shade(heights, height_scale="auto", exposure="auto", depth="auto")
        self.assertEqual(result.statistics["height_scale"], fitted)
        self.assertNotEqual(result.statistics["exposure"], 0.0)
        np.testing.assert_array_equal(
            result.image, shade(heights, height_scale=fitted, automatic_exposure=True,
                                exposure=0.0).image)
        np.testing.assert_array_equal(shade(heights, depth=2.5).image,
                                      shade(heights, subsurface_depth=2.5).image)
        self.assertFalse(np.array_equal(shade(heights, depth=2.5).image, shade(heights).image))

    def test_colors(self):
        heights = hills()
        table = vtkLookupTable()
        table.SetNumberOfTableValues(3)
        table.SetTableRange(0.0, 60.0)
        for i, color in enumerate(((0.0, 0.2, 0.4), (1.0, 0.4, 0.2), (0.2, 0.8, 0.0))):
            table.SetTableValue(i, *color, 1.0)
        expected = shade(heights, cmap=table).image
        codes = np.array(((0, 51, 102), (255, 102, 51), (51, 204, 0)))
        for cmap in (codes, codes / 255.0, np.uint8(codes)):
            np.testing.assert_array_equal(shade(heights, cmap=cmap, clim=(0, 60)).image, expected)
        # Without ends, the least and the greatest height.
        np.testing.assert_array_equal(
            shade(heights, cmap=codes).image,
            shade(heights, cmap=codes, clim=(heights.min(), heights.max())).image)
        hole = np.where(heights > 50.0, np.float32(1e6), heights)
        np.testing.assert_array_equal(
            shade(hole, cmap=codes, nodata=1e6).image,
            shade(hole, cmap=codes, nodata=1e6, clim=(heights.min(), hole[hole < 1e6].max())).image)
        grey = shade(np.zeros((8, 8)), cmap=[(-1, "black"), (1, (1.0, 1.0, 1.0))], sun=(0, 90))
        self.assertLessEqual(abs(int(grey[4, 4, 0]) - 128), 1)
        names = shade(heights, diffuse_color="#ff8000", base_color=0.25, dtype="float32").image
        linear = ((128 / 255 + 0.055) / 1.055) ** 2.4
        np.testing.assert_array_equal(names, shade(
            heights, diffuse_color=(1, linear, 0), base_color=(0.25,) * 3, dtype="float32").image)

    def test_textures(self):
        heights = hills()
        random = np.random.default_rng(3)
        for texture in (random.integers(0, 255, (60, 80, 3), np.uint8), random.random((60, 80, 4)),
                        random.random((60, 80)).astype("f4"), random.random((30, 20, 1))):
            shading = vtkImageReliefShading()
            shading.SetInputData(to_image(heights, (1.0, 1.0)))
            shading.StretchTexturesOn()
            shading.SetDiffuseTextureData(to_image(
                texture.astype("f4") if texture.dtype == float else texture, (1.0, 1.0)))
            np.testing.assert_allclose(shade(heights, diffuse_texture=texture, dtype="float32").image,
                                       picture(shading), atol=1e-6)
        top = np.zeros((60, 80, 3), np.uint8)
        top[0] = 255
        base = shade(heights, base_texture=top, layers="base").layers["base"]
        self.assertEqual((base[0].min(), base[1:].max()), (1.0, 0.0))
        for wrong in (top.astype(bool), top.astype("i4"), top.astype(str)):
            with self.assertRaises(TypeError):
                shade(heights, specular_texture=wrong)

    def test_scene(self):
        scene = reliefshading.vtkReliefScene()
        scene.AddSun(90.0, 20.0)
        scene.SetHeightScale(2.0)
        scene.GetMaterial().SetDiffuseColor(1.0, 0.5, 0.25)
        before = scene.GetMTime()
        heights = hills()
        np.testing.assert_array_equal(
            shade(heights, scene=scene).image,
            shade(heights, sun=(90, 20), height_scale=2, diffuse_color=(1, 0.5, 0.25)).image)
        np.testing.assert_array_equal(
            shade(heights, scene=scene, sun=(0, 45), height_scale=1).image,
            shade(heights, sun=(0, 45), diffuse_color=(1, 0.5, 0.25)).image)
        self.assertEqual(scene.GetMTime(), before)


class TestResults(unittest.TestCase):
    def test_array(self):
        result = shade(hills(), layers="all")
        self.assertEqual((result.shape, result.dtype, result.ndim), ((60, 80, 4), np.uint8, 3))
        self.assertTrue(np.shares_memory(np.asarray(result), result.image))
        self.assertEqual(np.asarray(result, float).dtype, float)
        np.testing.assert_array_equal(result[3, 4], result.image[3, 4])
        self.assertEqual(result.tobytes(), result.image.tobytes())
        again = pickle.loads(pickle.dumps(result))
        np.testing.assert_array_equal(again.image, result.image)
        self.assertEqual(again.statistics, result.statistics)
        self.assertEqual(list(result.layers), list(LAYERS))
        self.assertEqual(result.layers["normals"].shape, (60, 80, 3))
        self.assertEqual(list(shade(hills(), layers="all", preset="sky-dome").layers),
                         [name for name in LAYERS if name != "shadow"])
        self.assertEqual(result.statistics["lights_traced"], 1)
        self.assertIn("60 rows and 80 columns", repr(result))

    def test_picture_in_a_notebook(self):
        large = shade(hills(8, 4100), alpha=False)
        self.assertEqual(large._repr_png_(), large._png(large.image[::3, ::3]))
        for keywords in ({}, {"dtype": "float32"}, {"alpha": False}):
            result = shade(hills(), **keywords)
            reader = vtkPNGReader()
            with tempfile.TemporaryDirectory() as folder:
                name = os.path.join(folder, "picture.png")
                with open(name, "wb") as file:
                    file.write(result._repr_png_())
                reader.SetFileName(name)
                reader.Update()
            columns, rows, _ = reader.GetOutput().GetDimensions()
            codes = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
            expected = shade(hills()).image[..., :result.shape[2]]
            np.testing.assert_allclose(codes.reshape(rows, columns, -1)[::-1].astype(int),
                                       expected.astype(int), atol=1 if "dtype" in keywords else 0)

    def test_files(self):
        import pathlib
        result = shade(hills())
        with tempfile.TemporaryDirectory() as folder:
            for extension in ("png", "tif"):
                name = pathlib.Path(folder) / f"picture.{extension}"
                result.save(name)
                if extension == "png":
                    self.assertEqual(name.read_bytes(), result._repr_png_())
                elif hasattr(reliefshading, "vtkOpenImageIOReader"):
                    reader = reliefshading.vtkOpenImageIOReader()
                    reader.SetFileName(str(name))
                    reader.Update()
                    codes = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
                    np.testing.assert_array_equal(codes.reshape(60, 80, 4)[::-1], result.image)
            with self.assertRaises(FileNotFoundError):
                result.save(os.path.join(folder, "none", "picture.png"))
            with self.assertRaises((OSError, ValueError)):
                result.save(os.path.join(folder, "picture.xyz"))
            with self.assertRaisesRegex(ValueError, "float32"):
                result.save(os.path.join(folder, "picture.exr"))
            self.assertEqual(sorted(os.listdir(folder)), ["picture.png", "picture.tif"])

    def read(self, name):
        reader = reliefshading.vtkOpenImageIOReader()
        reader.SetFileName(name)
        reliefshading.update(reader)
        columns, rows, _ = reader.GetOutput().GetDimensions()
        values = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
        return values.reshape(rows, columns, -1)[::-1]

    @unittest.skipUnless(FILES, "no files in this build")
    def test_files_without_alpha(self):
        """They get the background where there is no data."""
        heights = hills(64, 64)
        heights[:32] = np.nan
        orange = np.array((255, 128, 0))
        for dtype in ("uint8", "float32"):
            picture = shade(heights, background="#ff8000", dtype=dtype)
            opaque = shade(heights, background="#ff8000", alpha=False, dtype=dtype)
            with tempfile.TemporaryDirectory() as folder:
                for extension in ("jpg", "JPEG", "gif", "ppm"):
                    with self.subTest(f"{extension} {dtype}"):
                        name = os.path.join(folder, f"picture.{extension}")
                        picture.save(name)
                        got = self.read(name)
                        self.assertTrue((got[..., 3:] == 255).all())
                        self.assertLess(abs(got[8:24, :, :3] - orange).max(), 8)
                        opaque.save(os.path.join(folder, f"opaque.{extension}"))
                        np.testing.assert_array_equal(
                            got, self.read(os.path.join(folder, f"opaque.{extension}")))
                if dtype == "float32":
                    name = os.path.join(folder, "picture.hdr")
                    picture.save(name)
                    np.testing.assert_allclose(self.read(name), opaque.image, atol=0.01)
                # It holds alpha.
                name = os.path.join(folder, "picture.webp")
                picture.save(name)
                np.testing.assert_array_equal(self.read(name)[..., 3] != 0, picture.mask)
        self.assertEqual(picture.shape, (64, 64, 4))

    @unittest.skipUnless(FILES, "no files in this build")
    def test_files_of_linear_pictures(self):
        picture = shade(hills(), dtype="float32")
        with tempfile.TemporaryDirectory() as folder:
            for extension in ("exr", "tif", "tiff"):
                name = os.path.join(folder, f"picture.{extension}")
                picture.save(name)
                np.testing.assert_array_equal(self.read(name), picture.image)
            for extension in ("png", "tga", "bmp", "jp2", "webp", "sgi"):
                with self.subTest(extension):
                    name = os.path.join(folder, f"picture.{extension}")
                    picture.save(name)
                    got = self.read(name)
                    self.assertEqual(got.dtype, np.uint8)
                    self.assertLess(abs(got.astype(int) - picture.encoded()[..., :got.shape[2]]).mean(), 3)

    def test_names_of_files(self):
        picture = shade(hills())
        with tempfile.TemporaryDirectory() as folder:
            for name in (b"bytes.png", b"bytes.tif", "Stra\u00dfe.tif".encode(), b"bytes \xff.png",
                         b"bytes \xff.tif"):
                path = os.path.join(os.fsencode(folder), name)
                try:
                    open(path, "wb").close()
                except OSError:
                    continue  # a file system of Unicode's names alone
                with self.subTest(name):
                    picture.save(path)
                    self.assertGreater(os.path.getsize(path), 99)
                os.remove(path)
            with self.assertRaises(TypeError):
                picture.save(3)
            long = os.path.join(folder, "n" * 240 + ".png")
            picture.save(long)
            self.assertEqual(os.listdir(folder), [os.path.basename(long)])

    @unittest.skipIf(os.name == "nt", "links and permissions are of Unix")
    def test_files_that_are_replaced(self):
        """A link is followed, and permissions stay."""
        with tempfile.TemporaryDirectory() as folder:
            name, link = os.path.join(folder, "picture.png"), os.path.join(folder, "link.png")
            picture = shade(hills())
            picture.save(name)
            usual = os.path.join(folder, "usual")
            open(usual, "wb").close()
            self.assertEqual(os.stat(name).st_mode, os.stat(usual).st_mode)
            os.chmod(name, 0o640)
            os.symlink("picture.png", link)
            other = shade(hills(), sun=(90, 20))
            other.save(link)
            self.assertTrue(os.path.islink(link))
            with open(name, "rb") as file:
                self.assertEqual(file.read(), other._repr_png_())
            self.assertEqual(os.stat(name).st_mode & 0o777, 0o640)
            # The format is that of the name that was given.
            os.symlink("picture.png", os.path.join(folder, "link.tif"))
            other.save(os.path.join(folder, "link.tif"))
            with open(name, "rb") as file:
                self.assertIn(file.read(2), (b"II", b"MM"))
            os.mkdir(os.path.join(folder, "folder.png"))
            with self.assertRaisesRegex(OSError, "folder"):
                picture.save(os.path.join(folder, "folder.png"))

    @unittest.skipUnless(sys.platform == "linux", "a file's size cannot be limited")
    def test_files_that_cannot_be_written(self):
        """The old ones stay, nothing is printed, and nothing else is left."""
        program = """if True:
            import os, resource, signal, sys, numpy as np, reliefshading as r
            from reliefshading import _results
            from vtkmodules.vtkIOImage import vtkTIFFWriter
            os.chdir(sys.argv[1])
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            picture = r.shade(np.random.default_rng(1).random((300, 300)))
            resource.setrlimit(resource.RLIMIT_FSIZE, (20000, resource.RLIM_INFINITY))
            files = "vtkOpenImageIOWriter" in r.__all__
            own = _results._writer
            for name in ["a.png", "a.tif", "b.tif"] + ["a.jpg", "a.webp", "a.tga"] * files:
                with open(name, "w") as file:
                    file.write("old")
                _results._writer = (lambda _: vtkTIFFWriter()) if name == "b.tif" else own
                try:
                    picture.save(name)
                except OSError as error:
                    text = str(error)
                    assert name in text and len(text) <= 200 and ".tmp" not in text, text
                else:
                    raise AssertionError(name)
                assert open(name).read() == "old", name
                os.remove(name)
                assert not os.listdir("."), os.listdir(".")
        """
        with tempfile.TemporaryDirectory() as folder:
            result = subprocess.run([sys.executable, "-c", program, folder], capture_output=True,
                                    text=True, check=False)
        # The libtiff in VTK's wheel prints a line by itself, whoever calls it.
        printed = re.sub(r"(?m)^TIFFAppendToStrip: Write error .*\n", "", result.stderr)
        self.assertEqual((result.returncode, result.stdout, printed), (0, "", ""))

    def test_messages_of_files(self):
        """They are short, and tell nothing of setters."""
        picture = shade(hills())
        with tempfile.TemporaryDirectory() as folder:
            for name in ("a.xyz", "a", "a.exr", "a.hdr", "a.pfm", "a.zfile", "a." + "x" * 200, "a.iff",
                         os.path.join("none" * 20, "a.png")):
                with self.subTest(name), self.assertRaises((OSError, ValueError)) as raised:
                    picture.save(os.path.join(folder, name))
                self.assertLessEqual(len(str(raised.exception)), 200)
                self.assertNotRegex(str(raised.exception), r"Set|PixelType|\.tmp")
            self.assertEqual(os.listdir(folder), [])


if __name__ == "__main__":
    unittest.main()
