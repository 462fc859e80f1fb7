# SPDX-License-Identifier: BSD-3-Clause
"""Arrays of xarray are shaded as they lie on the map."""

import contextlib
import io
import os
import re
import tempfile
import unittest

import numpy as np
import reliefshading

try:
    import xarray as xr
    import reliefshading.xarray  # noqa: F401
except ImportError:
    xr = None
try:
    import pyproj
except ImportError:
    pyproj = None
try:
    import rioxarray
except ImportError:
    rioxarray = None

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
TERRAIN = os.path.join(ROOT, "Examples", "Data", "jacksboro.tif")


def heights(rows=40, columns=50):
    y, x = np.mgrid[0:rows, 0:columns]
    return (20.0 * np.sin(x / 6.0) * np.cos(y / 5.0) + 0.3 * x).astype(np.float32)


def on_map(values, xs, ys, **more):
    return xr.DataArray(values, dims=("y", "x"), coords={"y": ys, "x": xs}, **more)


@unittest.skipUnless(xr, "xarray is not installed")
class TestXarray(unittest.TestCase):
    XS, YS = 4e5 + 20.0 * np.arange(50), 5e6 - 30.0 * np.arange(40)

    def test_is_shade(self):
        dem = on_map(heights(), self.XS, self.YS)
        picture = dem.relief.shade(sun=(300, 20), height_scale=5)
        expected = reliefshading.shade(heights(), spacing=(20, 30), sun=(300, 20), height_scale=5)
        np.testing.assert_array_equal(picture, expected.image)
        self.assertEqual((picture.dims, picture.dtype), (("y", "x", "band"), np.uint8))
        np.testing.assert_array_equal(picture.x, dem.x)
        np.testing.assert_array_equal(picture.y, dem.y)
        self.assertEqual(list(picture.band.values), ["red", "green", "blue", "alpha"])
        self.assertEqual(dem.relief.spacing, (20.0, 30.0))

    def test_which_way_rows_run(self):
        dem = on_map(heights(), self.XS, self.YS)
        expected = dem.relief.shade(sun=(300, 20))
        for name, other in {"south first": dem.isel(y=slice(None, None, -1)),
                            "east first": dem.isel(x=slice(None, None, -1)),
                            "across": dem.transpose("x", "y"),
                            "a band": dem.expand_dims("band")}.items():
            with self.subTest(name):
                picture = other.relief.shade(sun=(300, 20))
                xr.testing.assert_equal(picture.sortby("y").sortby("x"),
                                        expected.sortby("y").sortby("x"))
                if name != "across":
                    np.testing.assert_array_equal(picture.y, other.y)
        plain = xr.DataArray(heights(), dims=("rows", "columns"))
        np.testing.assert_array_equal(plain.relief.shade(), reliefshading.shade(heights()).image)
        np.testing.assert_array_equal(plain.relief.shade(spacing=3),
                                      reliefshading.shade(heights(), spacing=3).image)

    def test_degrees(self):
        dem = xr.DataArray(heights(), dims=("lat", "lon"), coords={
            "lat": 60.0 + 0.01 * np.arange(19.5, -20.5, -1), "lon": 10.0 + 0.01 * np.arange(50)})
        dx, dy = dem.relief.spacing
        # A degree of longitude at 60 degrees is 55800 m, one of latitude 111412 m, on WGS 84.
        self.assertAlmostEqual(dx, 558.00, delta=0.02)
        self.assertAlmostEqual(dy, 1114.12, delta=0.02)
        self.assertAlmostEqual(dem.relief.place[0], 10.245)
        np.testing.assert_array_equal(
            dem.relief.shade(sun_at="2026-06-21T08:30Z"), reliefshading.shade(
                heights(), spacing=(dx, dy), sun_at=("2026-06-21T08:30Z", *dem.relief.place)).image)
        units = on_map(heights(), 10 + 0.01 * np.arange(50), 60.0 + 0.01 * np.arange(19.5, -20.5, -1))
        self.assertAlmostEqual(units.relief.spacing[0], 0.01)
        units.x.attrs["units"], units.y.attrs["units"] = "degrees_east", "degrees_north"
        np.testing.assert_allclose(units.relief.spacing, (dx, dy))
        kilometres = on_map(heights(), 0.5 * np.arange(50.0), 0.5 * np.arange(40.0))
        kilometres.x.attrs["units"] = kilometres.y.attrs["units"] = "km"
        self.assertEqual(kilometres.relief.spacing, (500.0, 500.0))
        with self.assertRaisesRegex(ValueError, "sun_at: where"):
            kilometres.relief.shade(sun_at="2026-06-21T08:30Z")

    def test_units_of_heights(self):
        feet = on_map(heights(), self.XS, self.YS, attrs={"units": "ft"})
        feet.x.attrs["units"] = feet.y.attrs["units"] = "m"
        for look, scale in (({}, 0.3048), ({"height_scale": 5}, 5 * 0.3048)):
            np.testing.assert_array_equal(feet.relief.shade(**look), reliefshading.shade(
                heights(), spacing=(20, 30), height_scale=scale).image)

    def test_no_data(self):
        hole = np.zeros((40, 50), bool)
        hole[5:9, 10:20] = True
        expected = reliefshading.shade(heights(), spacing=(20, 30), mask=~hole).image
        marked = on_map(np.where(hole, -9999, heights()), self.XS, self.YS)
        for key, value in (("_FillValue", -9999), ("missing_value", -9999.0), ("nodatavals", (-9999.0,))):
            np.testing.assert_array_equal(
                marked.assign_attrs({key: value}).relief.shade(), expected)
        np.testing.assert_array_equal(marked.relief.shade(nodata=-9999), expected)
        dem = on_map(heights(), self.XS, self.YS)
        np.testing.assert_array_equal(dem.relief.shade(mask=~hole), expected)
        turned = dem.isel(y=slice(None, None, -1))
        mask = xr.DataArray(~hole, dims=("y", "x")).isel(y=slice(None, None, -1))
        np.testing.assert_array_equal(turned.relief.shade(mask=mask)[::-1], expected)
        np.testing.assert_array_equal(turned.relief.shade(mask=mask.values)[::-1], expected)
        whole = on_map(np.int16(np.where(hole, -9999, heights())), self.XS, self.YS)
        whole.encoding["_FillValue"] = -9999
        np.testing.assert_array_equal(whole.relief.shade()[..., 3] == 0, hole)

    def test_layers(self):
        dem = on_map(heights(), self.XS, self.YS[::-1])
        data = dem.relief.shade(layers=("illumination", "normals", "diffuse"))
        self.assertEqual(sorted(data), ["diffuse", "illumination", "normals", "shading"])
        expected = reliefshading.shade(heights()[::-1], spacing=(20, 30), layers="all")
        np.testing.assert_array_equal(data["illumination"][::-1], expected.layers["illumination"])
        np.testing.assert_array_equal(data["normals"][::-1], expected.layers["normals"])
        self.assertEqual(data["diffuse"].dims, ("y", "x", "color"))

    def test_prepared(self):
        dem = on_map(heights(), self.XS, self.YS)
        relief = dem.relief.prepare(diffuse_color="tomato")
        np.testing.assert_array_equal(relief.shade(sun=(90, 30)),
                                      dem.relief.shade(sun=(90, 30), diffuse_color="tomato"))

    def test_the_page(self):
        """The example of Python.md."""
        page = os.path.join(ROOT, "Documentation", "Python.md")
        with open(page, encoding="utf-8") as file:
            blocks = re.findall(r"```python\n(.*?)```", file.read(), re.DOTALL)
        (block,) = [block for block in blocks if "reliefshading.xarray" in block]
        printed = io.StringIO()
        folder = os.getcwd()
        try:
            os.chdir(ROOT)
            with contextlib.redirect_stdout(printed):
                exec(block, {})
        finally:
            os.chdir(folder)
        self.assertEqual(printed.getvalue().splitlines(), re.findall("# prints (.*)", block))

    def test_refused(self):
        uneven = on_map(heights(), np.arange(50) ** 2, self.YS)
        with self.assertRaisesRegex(ValueError, "x: the coordinates are not at equal steps"):
            uneven.relief.shade()
        np.testing.assert_array_equal(uneven.relief.shade(spacing=2),
                                      reliefshading.shade(heights(), spacing=2).image)
        with self.assertRaisesRegex(ValueError, "two dimensions"):
            xr.DataArray(np.zeros((3, 4, 5)), dims=("t", "y", "x")).relief.shade()
        with self.assertRaisesRegex(TypeError, "did you mean"):
            on_map(heights(), self.XS, self.YS).relief.shade(dept=3)

    def test_empty_arrays(self):
        for shape in ((0, 50), (40, 0), (0, 0)):
            empty = on_map(np.zeros(shape), self.XS[:shape[1]], self.YS[:shape[0]])
            plain = xr.DataArray(np.zeros(shape), dims=("rows", "columns"))
            for array in (empty, plain, empty.expand_dims("band"), empty.transpose("x", "y")):
                with self.subTest(str(array.sizes)):
                    with self.assertRaisesRegex(ValueError, r"\Aheights: .*empty, its shape is .*expected"):
                        array.relief.shade()
                    with self.assertRaisesRegex(ValueError, r"\Aheights: "):
                        array.relief.spacing
        for array in (xr.DataArray(3.0), xr.DataArray(np.zeros(3), dims="x")):
            with self.assertRaisesRegex(ValueError, r"\Aheights: two dimensions are expected"):
                array.relief.shade()

    def test_masks(self):
        """Have the heights' dimensions or their shape; others are told what is expected."""
        dem = on_map(heights(), self.XS, self.YS[::-1])
        mask = np.ones((40, 50), bool)
        mask[:9, 30:] = False
        expected = dem.relief.shade(mask=mask)
        np.testing.assert_array_equal(expected[..., 3] != 0, mask)
        labelled = xr.DataArray(mask, dims=("y", "x"))
        for name, other in {"of xarray": labelled, "across": labelled.transpose("x", "y"),
                            "with a band": labelled.expand_dims("band"), "numbers": mask.astype("u1"),
                            "masked": np.ma.array(np.ones((40, 50), bool), mask=~mask),
                            "a list": mask.tolist()}.items():
            with self.subTest(name):
                np.testing.assert_array_equal(dem.relief.shade(mask=other), expected)
        band = dem.expand_dims("band")
        for other in (mask, mask[np.newaxis], labelled):
            np.testing.assert_array_equal(band.relief.shade(mask=other), expected)
        across = dem.transpose("x", "y")
        for other in (mask, mask.T, labelled):
            np.testing.assert_array_equal(across.relief.shade(mask=other), expected)
        for other in (True, np.ones(40), np.ones((39, 50)), np.ones((50, 40)), np.ones((2, 40, 50)),
                      np.ones((0, 0)), np.ma.array(np.ones(3))):
            with self.subTest(np.shape(other)), self.assertRaisesRegex(
                    ValueError, r"\Amask: the shape is .*, \(40, 50\) is expected"):
                dem.relief.shade(mask=other)
        for other in (labelled.rename(x="lon"), labelled.isel(x=0), labelled.isel(y=slice(3)),
                      labelled.isel(y=slice(0)), labelled.expand_dims(time=3),
                      labelled.isel(x=slice(1))):
            with self.subTest(str(other.sizes)), self.assertRaisesRegex(
                    ValueError, r"\Amask: .* was given, \(y: 40, x: 50\) is expected"):
                dem.relief.shade(mask=other)
        with self.assertRaisesRegex(TypeError, r"\Amask: "):
            dem.relief.shade(mask=np.full((40, 50), "a"))

    @unittest.skipUnless(pyproj, "pyproj is not installed")
    def test_maps(self):
        # At 60 degrees north the metres of Web Mercator are about half a metre long.
        north = 8399738.0
        dem = on_map(heights(), 1e6 + 100.0 * np.arange(50), north - 100.0 * np.arange(-20, 20))
        dem = dem.assign_coords(spatial_ref=0)
        dem.spatial_ref.attrs["crs_wkt"] = pyproj.CRS(3857).to_wkt()
        # From the sphere of the map to the ellipsoid, where north and east differ.
        self.assertAlmostEqual(dem.relief.spacing[0], 100.0 * 55800.0 / 111319.49, delta=0.05)
        self.assertAlmostEqual(dem.relief.spacing[1], 100.0 * 111412.0 / 2.0 / 111319.49, delta=0.2)
        dem.spatial_ref.attrs["crs_wkt"] = pyproj.CRS(32632).to_wkt()
        moved = dem.assign_coords(x=dem.x - 3e5, y=dem.y - north + 6.6e6)
        self.assertEqual(moved.relief.spacing, (100.0, 100.0))  # UTM keeps its round numbers
        self.assertNotEqual(moved.relief.place[2], 0.0)
        feet = pyproj.CRS("EPSG:2263")  # New York, US survey feet
        dem.spatial_ref.attrs["crs_wkt"] = feet.to_wkt()
        near = dem.assign_coords(x=dem.x - 1e4, y=dem.y - north + 2e5)
        np.testing.assert_allclose(near.relief.spacing, (30.48006, 30.48006), rtol=1e-6)

    @unittest.skipUnless(rioxarray and "vtkReliefRasterReader" in reliefshading.__all__,
                         "rioxarray or the reader is not there")
    def test_is_the_reader(self):
        """One file, read by either."""
        dem = rioxarray.open_rasterio(TERRAIN)
        reader = reliefshading.vtkReliefRasterReader()
        reader.SetFileName(TERRAIN)
        reliefshading.update(reader)
        np.testing.assert_allclose(dem.relief.spacing, reader.GetOutput().GetSpacing()[:2], rtol=1e-4)
        np.testing.assert_allclose(dem.relief.place, reader.GetPlace(), atol=1e-3)
        image = reliefshading.shade(reader.GetOutput(), sun=(315, 30)).image
        picture = dem.relief.shade(sun=(315, 30))
        self.assertLessEqual(np.abs(picture.values.astype(int) - image).max(), 2)
        self.assertEqual(picture.rio.crs, dem.rio.crs)

    @unittest.skipUnless(rioxarray, "rioxarray is not installed")
    def test_to_geotiff_and_back(self):
        """A picture lies where its heights lie, whichever way their rows run."""
        heights = rioxarray.open_rasterio(TERRAIN).squeeze("band")
        with tempfile.TemporaryDirectory() as folder:
            for name, dem in (("down", heights), ("up", heights[::-1])):
                picture = dem.relief.shade(sun=(315, 25), height_scale=2)
                path = os.path.join(folder, name + ".tif")
                picture.transpose("band", ...).rio.to_raster(path)
                with rioxarray.open_rasterio(path) as back:
                    self.assertEqual(back.rio.crs, heights.rio.crs)
                    np.testing.assert_allclose(tuple(back.rio.transform()),
                                               tuple(dem.rio.transform(recalc=True)), rtol=1e-9)
                    np.testing.assert_array_equal(back.transpose("y", "x", "band").values, picture.values)
                np.testing.assert_allclose(picture.sortby("y").values.astype(int),
                                           heights.relief.shade(sun=(315, 25), height_scale=2).sortby("y").values,
                                           atol=1)


if __name__ == "__main__":
    unittest.main()
