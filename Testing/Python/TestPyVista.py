# SPDX-License-Identifier: BSD-3-Clause
"""Reliefs in PyVista: heights of every grid, the same picture everywhere, a light that is dragged."""

import contextlib
import gc
import importlib.util
import io
import os
import pathlib
import re
import sys
import tempfile
import unittest
import unittest.mock
import weakref

import numpy as np
import reliefshading
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkJPEGReader

try:
    import pyvista as pv
    import reliefshading.pyvista as rs
except ImportError:
    pv = rs = None

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
TERRAIN = os.path.join(ROOT, "Examples", "Data", "jacksboro.tif")
FILES = "vtkReliefRasterReader" in reliefshading.__all__
# The wheel has no readers and borrows rioxarray's.
READS = FILES or importlib.util.find_spec("rioxarray") is not None
LIVE = {"vtkReliefImageMapper", "vtkReliefLightWidget"} <= set(reliefshading.__all__)


def heights(columns=50, rows=40):
    x, y = np.meshgrid(np.arange(columns), np.arange(rows))
    return (20.0 * np.sin(x / 6.0) * np.cos(y / 5.0) + 0.3 * x).astype(np.float32)


def image(values=None, spacing=(2.0, 3.0, 1.0), origin=(10.0, 20.0, 0.0)):
    """An image whose rows go up, as VTK's do."""
    values = heights() if values is None else values
    result = pv.ImageData(dimensions=(*values.shape[::-1], 1), spacing=spacing, origin=origin)
    result["z"] = values.ravel()
    return result


def expected(dem, prepare=lambda shading: None):
    shading = reliefshading.vtkImageReliefShading()
    shading.SetInputData(dem)
    shading.SetOutputScalarTypeToUnsignedChar()
    prepare(shading)
    shading.Update()
    return vtk_to_numpy(shading.GetOutput().GetPointData().GetScalars())


@unittest.skipUnless(pv, "PyVista is not installed")
class TestShade(unittest.TestCase):
    def test_is_the_filter(self):
        dem = image()
        before = dem.copy()
        shaded = rs.shade(dem, sun=(300, 20), height_scale=2, layers="illumination")
        self.assertIsInstance(shaded, pv.ImageData)
        self.assertEqual((shaded.dimensions, shaded.spacing, shaded.origin),
                         (dem.dimensions, dem.spacing, dem.origin))
        self.assertEqual(shaded.active_scalars_name, "Shading")
        self.assertEqual(sorted(shaded.array_names), ["Illumination", "Shading"])

        def prepare(shading):
            shading.GetScene().AddSun(300.0, 20.0)
            shading.GetScene().SetHeightScale(2.0)

        np.testing.assert_array_equal(shaded["Shading"], expected(dem, prepare))
        self.assertEqual(dem, before)
        # The same as an array's, whose first row is on top.
        picture = reliefshading.shade(heights()[::-1], spacing=(2, 3), sun=(300, 20), height_scale=2)
        difference = picture.image[::-1].reshape(-1, 4).astype(int) - shaded["Shading"]
        self.assertLessEqual(abs(difference).max(), 1)

    def test_lamps_and_directions_are_of_the_world(self):
        dem = image()
        dem.direction_matrix = np.array(((0.0, -1, 0), (1, 0, 0), (0, 0, 1)))

        def prepare(shading):
            shading.GetScene().AddSun(300.0, 20.0)

        np.testing.assert_array_equal(rs.shade(dem, sun=(300, 20))["Shading"], expected(dem, prepare))

    def test_which_scalars(self):
        dem = image()
        dem["other"] = heights().ravel() * 2
        dem.set_active_scalars("z")
        np.testing.assert_array_equal(rs.shade(dem)["Shading"], expected(image()))
        np.testing.assert_array_equal(rs.shade(dem, scalars="other")["Shading"],
                                      expected(image(heights() * 2)))
        with self.assertRaisesRegex(ValueError, "no array 'none'; there are z, other"):
            rs.shade(dem, scalars="none")
        with self.assertRaisesRegex(ValueError, "no scalars"):
            rs.shade(pv.ImageData(dimensions=(3, 3, 1)))
        with self.assertRaises(TypeError):
            rs.shade(pv.Sphere())
        with self.assertRaises(ValueError):
            rs.shade(pv.ImageData(dimensions=(1, 3, 4)).compute_cell_sizes(), scalars="none")

    def test_cells(self):
        cells = pv.ImageData(dimensions=(51, 41, 1), spacing=(2.0, 3.0, 1.0))
        cells.cell_data["z"] = heights().ravel()
        shaded = rs.shade(cells)
        self.assertEqual(shaded.dimensions, cells.dimensions)
        np.testing.assert_array_equal(shaded.cell_data["Shading"], expected(image(origin=(1, 1.5, 0))))
        terrain = rs.drape(cells)
        self.assertEqual(terrain.dimensions, (50, 40, 1))
        self.assertEqual(terrain.bounds[:4], (1.0, 99.0, 1.5, 118.5))

    def test_other_grids(self):
        values = heights()
        picture = expected(image(origin=(0, 0, 0))).reshape(40, 50, 4)
        xs, ys = 2.0 * np.arange(50) + 4e5, 3.0 * np.arange(40) + 5e6
        grids = {
            "structured": pv.StructuredGrid(*np.meshgrid(xs, ys, indexing="xy"), values),
            "across": pv.StructuredGrid(*np.meshgrid(xs, ys, indexing="ij"), values.T)}
        for name, grid in grids.items():
            with self.subTest(name):
                shaded = rs.shade(grid)
                self.assertIsInstance(shaded, pv.StructuredGrid)
                np.testing.assert_array_equal(shaded.points, grid.points)
                rows = np.rint((grid.points[:, 1] - 5e6) / 3.0).astype(int)
                columns = np.rint((grid.points[:, 0] - 4e5) / 2.0).astype(int)
                np.testing.assert_allclose(shaded["Shading"].astype(int), picture[rows, columns], atol=1)
                terrain = rs.drape(grid, height_scale=2)
                np.testing.assert_allclose(terrain.points[:, 2], 2.0 * grid.points[:, 2], atol=1e-5)
        plane = pv.RectilinearGrid(2.0 * np.arange(50), 3.0 * np.arange(40))
        plane["z"] = values.ravel()
        np.testing.assert_array_equal(rs.shade(plane, scalars="z")["Shading"], picture.reshape(-1, 4))
        bent = pv.StructuredGrid(*np.meshgrid(np.arange(50.0) ** 2, ys), values)
        with self.assertRaisesRegex(ValueError, "equal steps"):
            rs.shade(bent)

    def test_whichever_way_coordinates_run(self):
        """Each point gets the colour of its place, and masks and textures lie as on the map."""
        values = heights()
        xs, ys = 2.0 * np.arange(50) + 4e5, 3.0 * np.arange(40) + 5e6
        mask = np.ones((40, 50), bool)
        mask[:4, 30:] = False  # at the map's north east
        colors = np.random.default_rng(7).integers(0, 255, (40, 50, 3), np.uint8)
        look = dict(sun=(300, 20), height_scale=2, mask=mask, base_texture=colors,
                    layers=("base", "illumination"))

        def placed(shaded):
            order = np.lexsort((shaded.points[:, 0], shaded.points[:, 1]))
            return {name: np.asarray(shaded[name])[order] for name in ("Shading", "Base", "Illumination")}

        north, east = np.meshgrid(ys, xs, indexing="ij")
        expected_arrays = placed(rs.shade(pv.StructuredGrid(east, north, values), **look))
        for down in (1, -1):
            for left in (1, -1):
                turn = np.s_[::down, ::left]
                for name, grid in {
                        "rows": pv.StructuredGrid(east[turn], north[turn], values[turn]),
                        "across": pv.StructuredGrid(east[turn].T, north[turn].T, values[turn].T)}.items():
                    with self.subTest(f"{name} {down} {left}"):
                        for array, got in placed(rs.shade(grid, **look)).items():
                            np.testing.assert_array_equal(got, expected_arrays[array])
                        terrain = rs.drape(grid, height_scale=2)
                        np.testing.assert_allclose(terrain.points[:, 2], 2.0 * grid.points[:, 2],
                                                   atol=1e-5)
                plane = pv.RectilinearGrid(xs[::left], ys[::down])
                plane["z"] = values[turn].ravel()
                with self.subTest(f"rectilinear {down} {left}"):
                    for array, got in placed(rs.shade(plane, scalars="z", **look)).items():
                        np.testing.assert_array_equal(got, expected_arrays[array])

    def test_looks(self):
        dem = image()
        plain = rs.shade(dem, diffuse_color="#ff6347", base_color="#102030")["Shading"]
        np.testing.assert_array_equal(
            rs.shade(dem, diffuse_color="tomato", base_color=pv.Color("#102030"))["Shading"], plain)
        limits = dem.get_data_range()
        table = pv.LookupTable("gist_earth", scalar_range=limits, n_values=256)
        # PyVista rounds the colors of its tables down.
        np.testing.assert_allclose(rs.shade(dem, cmap="gist_earth")["Shading"].astype(int),
                                   rs.shade(dem, cmap=table)["Shading"], atol=2)
        colors = np.random.default_rng(5).integers(0, 255, (40, 50, 3), np.uint8)
        texture = pv.Texture(colors)
        np.testing.assert_array_equal(
            rs.shade(dem, diffuse_texture=texture)["Shading"],
            rs.shade(dem, diffuse_texture=texture.to_image())["Shading"])
        base = rs.shade(dem, base_texture=texture, layers="base")["Base"].reshape(40, 50, 3)
        # The first row of a texture's array is on top.
        decoded = np.where(colors <= 10, colors / 255 / 12.92, ((colors / 255 + 0.055) / 1.055) ** 2.4)
        np.testing.assert_allclose(base[::-1], decoded, atol=1e-5)

    def test_refused(self):
        dem = image()
        for kind, text, keywords in (
                (TypeError, "did you mean 'depth'", {"dept": 3}),
                (TypeError, "spacing", {"spacing": 3}),
                (ValueError, "tolerance", {"tolerance": -1}),
                (ValueError, "cmap", {"cmap": "gist_erth"}),
                (ValueError, "[Cc]olor", {"diffuse_color": "reddishest"})):
            with self.subTest(str(keywords)), self.assertRaisesRegex(kind, text):
                rs.shade(dem, **keywords)
        for i in range(99):
            dem[f"array {i}"] = dem["z"]
        for keywords in ({"cmap": "x" * 999}, {"diffuse_color": "x" * 999}, {"scalars": "x" * 999}):
            with self.subTest(str(list(keywords))), self.assertRaises(ValueError) as raised:
                rs.shade(dem, **{"scalars": "z", **keywords})
            self.assertLessEqual(len(str(raised.exception)), 200)
        with self.assertRaisesRegex(ValueError, "drape"):
            rs.update(dem)


@unittest.skipUnless(pv, "PyVista is not installed")
class TestDrape(unittest.TestCase):
    def test_heights_and_colors(self):
        dem = image()
        look = dict(sun=(315, 25), height_scale=2.5, cmap="terrain")
        terrain = rs.drape(dem, **look)
        np.testing.assert_array_equal(terrain["Shading"], rs.shade(dem, **look)["Shading"])
        warped = dem.warp_by_scalar(factor=2.5)
        np.testing.assert_allclose(terrain.points, warped.points, rtol=1e-6)
        np.testing.assert_array_equal(terrain["Heights"], dem["z"])
        automatic = rs.drape(dem, height_scale="auto")
        scene = reliefshading.vtkReliefScene()
        fitted = scene.FitHeightScale(dem)
        np.testing.assert_allclose(automatic.points[:, 2], fitted * dem["z"], rtol=1e-5)

    def test_holes(self):
        values = heights()
        values[10:15, 20:30] = np.nan
        terrain = rs.drape(image(values))
        self.assertTrue(np.isfinite(terrain.points).all())
        self.assertEqual(np.count_nonzero(terrain["Shading"][:, 3] == 0), 50)
        hidden = (terrain.point_data["vtkGhostType"] & 2) != 0
        np.testing.assert_array_equal(hidden, np.isnan(values).ravel())

    def test_update(self):
        dem = image()
        terrain = rs.drape(dem, sun=(315, 25), cmap="terrain", height_scale=2)
        rs.update(terrain, sun=(90, 25))
        np.testing.assert_array_equal(
            terrain["Shading"], rs.shade(dem, sun=(90, 25), cmap="terrain", height_scale=2)["Shading"])
        scene = reliefshading.vtkReliefScene()
        scene.AddSun(180.0, 40.0)
        scene.SetHeightScale(3.0)
        rs.update(terrain, scene)
        np.testing.assert_array_equal(terrain["Shading"], rs.shade(dem, scene=scene, cmap="terrain")["Shading"])
        np.testing.assert_allclose(terrain.points[:, 2], 3.0 * dem["z"], rtol=1e-5)
        terrain = rs.drape(dem, suns=iter([(90, 25), (0, 25)]))
        rs.update(terrain, diffuse_color=0.5)
        rs.update(terrain, suns=iter([(180, 25), (0, 25)]))
        rs.update(terrain, diffuse_color=0.25)
        np.testing.assert_array_equal(terrain["Shading"], rs.shade(
            dem, suns=[(180, 25), (0, 25)], diffuse_color=0.25)["Shading"])
        gone = weakref.ref(rs._Draped.find(terrain))
        del terrain
        gc.collect()
        self.assertIsNone(gone())


@unittest.skipUnless(pv and READS, "PyVista or readers are not there")
class TestRead(unittest.TestCase):
    def test_terrain(self):
        dem = rs.read(TERRAIN)
        self.assertEqual((dem.array_names, dem.dimensions), (["Heights"], (403, 344, 1)))
        self.assertAlmostEqual(dem.spacing[0], 74.6, 1)
        self.assertEqual(dem.field_data.keys(), [])
        if FILES:
            self.assertIn("geo:transform", rs.read(TERRAIN, georeference=True).field_data)
        else:
            with self.assertRaisesRegex(RuntimeError, "georeference"):
                rs.read(TERRAIN, georeference=True)
        self.assertEqual(rs.read(TERRAIN, spacing=(30, 40)).spacing, (30.0, 40.0, 1.0))
        self.assertEqual(rs.read(TERRAIN, spacing=30).spacing, (30.0, 30.0, 1.0))
        self.assertEqual(rs.read(TERRAIN, spacing=(30, 40, 1)).spacing, (30.0, 40.0, 1.0))
        for spacing in (0, -1, (30, -30), (0, 30), float("nan"), (1, float("inf")), 10 ** 400, (1, 2, 3, 4),
                        (), "wide", (30, None)):
            with self.subTest(str(spacing)[:30]), self.assertRaisesRegex(
                    (TypeError, ValueError), r"\Aspacing: .*expected") as raised:
                rs.read(TERRAIN, spacing=spacing)
            if np.ndim(spacing) == 0 and not isinstance(spacing, str):
                self.assertIsInstance(raised.exception, ValueError)
        self.assertEqual(rs.read(os.fsencode(TERRAIN)).dimensions, (403, 344, 1))
        with self.assertRaisesRegex(RuntimeError, "missing.tif"):
            rs.read("missing.tif")

    @unittest.skipUnless(importlib.util.find_spec("rioxarray"), "rioxarray is not installed")
    def test_by_rioxarray(self):
        """As a build without readers does it: the same heights, spacing and messages."""
        dem = rs._read_by_rioxarray(TERRAIN, None, False)
        self.assertEqual((dem.array_names, dem.dimensions), (["Heights"], (403, 344, 1)))
        np.testing.assert_allclose(dem.spacing, (74.6, 92.5, 1.0), rtol=1e-3)
        if FILES:
            read = rs.read(TERRAIN)
            np.testing.assert_allclose(dem.spacing, read.spacing, rtol=1e-4)
            np.testing.assert_array_equal(dem["Heights"], read["Heights"])
        self.assertEqual(rs._read_by_rioxarray(TERRAIN, (30.0, 40.0), False).spacing, (30.0, 40.0, 1.0))
        with self.assertRaisesRegex(RuntimeError, "missing.tif") as raised:
            rs._read_by_rioxarray("missing.tif", None, False)
        self.assertLessEqual(len(str(raised.exception)), 200)
        with unittest.mock.patch.dict(sys.modules, {"rioxarray": None}), self.assertRaisesRegex(
                RuntimeError, "install rioxarray"):
            rs._read_by_rioxarray(TERRAIN, None, False)

    @unittest.skipUnless(importlib.util.find_spec("xarray"), "xarray is not installed")
    def test_from_xarray(self):
        import xarray
        values = np.arange(12, dtype=np.int16).reshape(3, 4)
        array = xarray.DataArray(
            values, dims=("y", "x"), coords={"y": [70.0, 50.0, 30.0], "x": [10.0, 20.0, 30.0, 40.0]},
            attrs={"_FillValue": 5, "units": "feet"})
        for axis in ("y", "x"):
            array[axis].attrs["units"] = "m"
        for turned in (array, array[::-1], array[:, ::-1], array.transpose("x", "y"), array.expand_dims("band")):
            dem = rs.from_xarray(turned)
            self.assertEqual((dem.dimensions, dem.spacing), ((4, 3, 1), (10.0, 20.0, 1.0)))
            expected_heights = 0.3048 * np.where(values == 5, np.nan, values)[::-1].ravel()
            np.testing.assert_allclose(dem["Heights"], expected_heights, rtol=1e-6)
        self.assertEqual(rs.from_xarray(xarray.DataArray(values, dims=("y", "x"))).spacing, (1.0, 1.0, 1.0))
        with self.assertRaisesRegex(TypeError, "DataArray"):
            rs.from_xarray(values)

    @unittest.skipUnless(FILES, "no files in this build")
    def test_is_upright(self):
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "heights.tif")
            picture = reliefshading.shade(np.arange(12.0).reshape(3, 4), layers="all")
            picture.image = np.arange(12, dtype=np.float32).reshape(3, 4, 1)
            picture.save(name)
            dem = rs.read(name)
            np.testing.assert_array_equal(dem["Heights"].reshape(3, 4)[::-1], picture.image[..., 0])


@unittest.skipUnless(pv and LIVE, "PyVista or the mapper is not there")
class TestLive(unittest.TestCase):
    @unittest.skipUnless(FILES, "no files in this build")
    def test_the_page(self):
        """The example of Python.md."""
        page = os.path.join(ROOT, "Documentation", "Python.md")
        with open(page, encoding="utf-8") as file:
            blocks = re.findall(r"```python\n(.*?)```", file.read(), re.DOTALL)
        (block,) = [block for block in blocks if "reliefshading.pyvista" in block]
        printed = io.StringIO()
        folder = os.getcwd()
        try:
            os.chdir(ROOT)
            with contextlib.redirect_stdout(printed):
                exec(block, {})
        finally:
            os.chdir(folder)
        self.assertEqual(printed.getvalue().splitlines(), re.findall("# prints (.*)", block))

    def plotter(self, dem, **look):
        plotter = pv.Plotter(off_screen=True, window_size=(300, 240))
        plotter.background_color = "black"
        relief = rs.add_relief(plotter, dem, **look)
        self.addCleanup(plotter.close)
        return plotter, relief

    def test_shows_what_is_shaded(self):
        dem = image(spacing=(1.0, 1.0, 1.0), origin=(0, 0, 0))
        for look in ({}, {"sun": (90, 30), "cmap": "terrain"}, {"preset": "multidirectional"}):
            with self.subTest(look):
                plotter, relief = self.plotter(dem, **look)
                plotter.enable_parallel_projection()
                plotter.camera.parallel_scale = 20.0  # six pixels a sample
                plotter.show(auto_close=False, interactive=False)
                shown = plotter.screenshot(return_img=True)[3::6, 3::6]
                colors = rs.shade(dem, **look)["Shading"].reshape(40, 50, 4)[::-1, :, :3]
                difference = np.abs(shown[1:-1, 1:-1].astype(int) - colors[1:-1, 1:-1])
                self.assertLess(difference.mean(), 12.0)
                self.assertEqual(relief.scene.GetLights().GetNumberOfItems(),
                                 4 if "preset" in look else 1)

    def test_update(self):
        _, relief = self.plotter(image(), sun=(315, 30), height_scale=2)
        relief.update(diffuse_color="tomato")
        self.assertEqual(relief.scene.GetHeightScale(), 2.0)
        self.assertNotEqual(relief.scene.GetMaterial().GetDiffuseColor(), (1.0, 1.0, 1.0))
        relief.update(suns=iter([(90, 30), (0, 30)]), cmap=iter([(0, "black"), (30, "white")]))
        for _ in range(2):
            relief.update(diffuse_color="tomato")
            self.assertEqual(relief.scene.GetLights().GetNumberOfItems(), 2)
        with self.assertRaisesRegex(TypeError, "layers"):
            relief.update(layers="all")
        with self.assertRaisesRegex(ValueError, "tolerance"):
            relief.update(tolerance=-1)

    def test_a_drape_is_not_lit_again(self):
        """Its colours are those of a mesh that is not lit, with shadows in the plotter, too."""
        dem = image()
        terrain = rs.drape(dem, cmap="terrain")

        def shown(shadows, **keywords):
            plotter = pv.Plotter(off_screen=True, window_size=(200, 150))
            if keywords:
                plotter.add_mesh(terrain, scalars="Shading", rgb=True, **keywords)
            else:
                _, added = rs.add_drape(plotter, terrain)
                self.assertIs(added, terrain)
            if shadows:
                plotter.enable_shadows()
            plotter.show(auto_close=False, interactive=False)
            picture = plotter.screenshot(return_img=True)
            plotter.close()
            return picture

        plain = shown(False, lighting=False)
        self.assertGreater(plain.std(), 0.0)
        np.testing.assert_array_equal(shown(False), plain)
        np.testing.assert_array_equal(shown(True), plain)

    def test_shadows_beside(self):
        """With the plotter's shadows a live relief stays as it is, and what is beside it is in shadow."""
        dem = image(spacing=(1.0, 1.0, 1.0), origin=(0, 0, 0))

        def shown(shadows):
            plotter, relief = self.plotter(dem, view=False, sun=(300, 25), height_scale=2)
            plotter.remove_all_lights()
            light = pv.Light(position=(-60, 20, 80), focal_point=(60, 20, 0), light_type="scene light")
            plotter.add_light(light)
            plotter.add_mesh(pv.Plane(center=(90, 20, -20), i_size=200, j_size=200), color="white", ambient=0.1)
            plotter.add_mesh(pv.Sphere(radius=8, center=(75, 20, 5)), color="tomato")
            plotter.enable_parallel_projection()
            plotter.camera_position = [(75, 20, 200), (75, 20, 0), (0, 1, 0)]
            plotter.camera.parallel_scale = 60
            plotter.camera.clipping_range = (1, 500)
            if shadows:
                plotter.enable_shadows()
            plotter.show(auto_close=False, interactive=False)
            plotter.render()
            picture = plotter.screenshot(return_img=True).astype(int)
            plotter.close()
            # Two pixels a unit; the camera looks at the middle.
            relief = picture[120 - 2 * 18:120 + 2 * 18, 2:90]
            return relief, picture[:, 95:]

        relief, around = shown(False)
        relief_in_shadows, around_in_shadows = shown(True)
        self.assertGreater(relief.std(), 10.0)
        np.testing.assert_array_equal(relief_in_shadows, relief)
        self.assertGreater((around_in_shadows < around - 60).all(axis=2).sum(), 300)

    def test_light_widget(self):
        dem, calls = image(), []
        plotter = pv.Plotter(shape=(1, 2), off_screen=True, window_size=(400, 200))
        relief = rs.add_relief(plotter, dem, sun=(315, 30))
        plotter.subplot(0, 1)
        _, terrain = rs.add_drape(plotter, dem, sun=(315, 30))
        before = terrain["Shading"].copy()

        def follow():
            calls.append(1)
            rs.update(terrain, relief)

        rs.add_light_widget(plotter, relief, follow)
        gc.collect()
        plotter.show(auto_close=False, interactive=False)
        widget = relief.widgets[0]
        at, interactor = [0.0, 0.0, 0.0], plotter.iren.interactor
        self.assertTrue(widget.GetLightRepresentation().GetDotPosition(at))
        relief.renderer.SetWorldPoint(*at, 1.0)
        relief.renderer.WorldToDisplay()
        x, y = (round(c) for c in relief.renderer.GetDisplayPoint()[:2])
        for event, dx, dy in (("LeftButtonPressEvent", 0, 0), ("MouseMoveEvent", 20, -20),
                              ("MouseMoveEvent", 40, -40), ("LeftButtonReleaseEvent", 40, -40)):
            interactor.SetEventInformation(x + dx, y + dy, 0, 0, "\0", 0, None)
            interactor.InvokeEvent(event)
        self.assertGreater(len(calls), 0)
        self.assertFalse(np.array_equal(terrain["Shading"], before))
        np.testing.assert_array_equal(terrain["Shading"], rs.shade(dem, scene=relief.scene)["Shading"])
        plotter.close()
        with self.assertRaises(TypeError):
            rs.add_light_widget(plotter, terrain)


@unittest.skipUnless(pv and LIVE and READS, "PyVista, the mapper or readers are not there")
class TestExamples(unittest.TestCase):
    """Examples/PyVista run, and are what the page of them shows."""

    def setUp(self):
        sys.path.insert(0, os.path.join(ROOT, "Examples", "PyVista"))
        self.addCleanup(sys.path.remove, sys.path[0])
        self.pages = importlib.import_module("make_page")
        self.folder = pathlib.Path(ROOT, "Documentation", "PyVista")

    @staticmethod
    def difference(first, second):
        """Of means over squares of 8 pixels, for files are compressed with loss: the mean, and the share of
        squares that differ by more than 25."""
        rows, columns = (8 * (n // 8) for n in first.shape[:2])
        means = [picture[:rows, :columns].reshape(rows // 8, 8, columns // 8, 8, 3).mean(axis=(1, 3))
                 for picture in (first, second)]
        difference = np.abs(means[0] - means[1])
        return difference.mean(), (difference.max(axis=2) > 25.0).mean()

    def test_all(self):
        parts = []
        for name in self.pages.EXAMPLES:
            path = pathlib.Path(ROOT, "Examples", "PyVista", name + ".py").resolve()
            printed, picture = self.pages.run(path)
            parts.append(self.pages.text_of(path, printed))
            with self.subTest(name):
                reader = vtkJPEGReader()
                reader.SetFileName(str(self.folder / (name + ".jpg")))
                reader.Update()
                columns, rows, _ = reader.GetOutput().GetDimensions()
                kept = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(rows, columns, 3)[::-1]
                self.assertEqual(picture.shape, kept.shape)
                mean, beyond = self.difference(picture, kept)
                self.assertLess(mean, 2.0)
                # Lines and letters are drawn differently by other versions.
                self.assertLess(beyond, 0.02)
                gc.collect()
        page = (self.folder / "PyVista.md").read_text(encoding="utf-8")
        self.assertEqual(page, self.pages.INTRODUCTION + "\n".join(parts))

    def test_all_are_on_the_page(self):
        scripts = {path.stem for path in pathlib.Path(ROOT, "Examples", "PyVista").glob("*.py")} - {"make_page"}
        self.assertEqual(scripts, set(self.pages.EXAMPLES))
        self.assertEqual({path.stem for path in self.folder.glob("*.jpg")}, scripts)

    def test_compares(self):
        """A light from elsewhere would be noticed."""
        path = pathlib.Path(ROOT, "Examples", "PyVista", "flat_picture.py").resolve()
        _, picture = self.pages.run(path)
        with tempfile.TemporaryDirectory() as folder:
            other = pathlib.Path(folder, "Examples", "PyVista", "flat_picture.py")
            other.parent.mkdir(parents=True)
            text = path.read_text(encoding="utf-8").replace("sun=(315, 25)", "sun=(300, 25)").replace(
                "pathlib.Path(__file__)", f"pathlib.Path({str(path)!r})")
            other.write_text(text, encoding="utf-8")
            _, moved = self.pages.run(other)
        self.assertGreater(self.difference(picture, moved)[0], 2.0)


@unittest.skipUnless(pv, "PyVista is not installed")
class TestAccessor(unittest.TestCase):
    def test_is_registered(self):
        """As PyVista 0.48 and later have it; here by a register of ours where there is none."""
        registered = {}

        def register(name, kind):
            return lambda accessor: registered.setdefault((name, kind), accessor)

        with unittest.mock.patch.object(pv, "register_dataset_accessor", register, create=True):
            module = importlib.reload(sys.modules["reliefshading.pyvista"])
        accessor = registered["relief", pv.ImageData](image())
        np.testing.assert_array_equal(accessor.shade(sun=(0, 45))["Shading"],
                                      module.shade(image(), sun=(0, 45))["Shading"])
        self.assertIn("Shading", accessor.drape().array_names)

    @unittest.skipUnless(hasattr(pv, "register_dataset_accessor"), "this PyVista has no accessors")
    def test_is_there(self):
        """PyVista's own register."""
        dem = image()
        np.testing.assert_array_equal(dem.relief.shade(sun=(300, 20))["Shading"], rs.shade(dem, sun=(300, 20))["Shading"])
        for other in (dem.cast_to_structured_grid(), dem.cast_to_rectilinear_grid()):
            self.assertIn("Shading", other.relief.drape(sun=(300, 20)).array_names)
        plotter = pv.Plotter(off_screen=True, window_size=(100, 80))
        self.addCleanup(plotter.close)
        dem.relief.add_to(plotter, sun=(300, 20))
        plotter.show(auto_close=False)
        self.assertGreater(np.ptp(plotter.screenshot(return_img=True)), 50)


if __name__ == "__main__":
    unittest.main()
