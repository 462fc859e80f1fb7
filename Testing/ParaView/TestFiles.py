# SPDX-License-Identifier: BSD-3-Clause
"""Rasters and pictures, read and written by the plugin's readers and writers, which ParaView finds by a
file's extension."""

import json
import subprocess
import tempfile

from reliefparaview import *

load()
rng = np.random.default_rng(7)
raster = np.round(40 * np.sin(np.arange(30)[None, :] / 4) * np.cos(np.arange(20)[:, None] / 3)) + \
    rng.integers(0, 4, (20, 30))

with tempfile.TemporaryDirectory() as folder:
    def path(name):
        return os.path.join(folder, name)

    with open(path("hills.asc"), "w", encoding="utf-8") as grid:
        grid.write("ncols 30\nnrows 20\nxllcorner 500000\nyllcorner 4100000\ncellsize 10\n"
                   "NODATA_value -9999\n")
        rows = raster[::-1].copy()  # the file begins in the north
        rows[3, 5] = -9999
        grid.writelines(" ".join(f"{h:.0f}" for h in row) + "\n" for row in rows)
    with open(path("hills.prj"), "w", encoding="utf-8") as system:
        system.write("EPSG:32633")
    subprocess.run(["gdal_translate", "-q", "-a_srs", "EPSG:32633", path("hills.asc"), path("hills.tif")],
                   check=True)

    reader = pv.ReliefRasterReader(FileName=path("hills.tif"))
    reader.UpdatePipeline()
    image = pv.servermanager.Fetch(reader)
    got = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(20, 30)
    assert np.isnan(got[16, 5]) and image.GetSpacing()[:2] == (10.0, 10.0)
    assert np.array_equal(np.delete(got.ravel(), 16 * 30 + 5), np.delete(raster.ravel(), 16 * 30 + 5))

    # ParaView's own reader has the same heights, in cells.
    relief = pv.ReliefShading(Input=reader)
    own = pv.GDALRasterReader(FileName=path("hills.tif"))
    of_cells = pv.ReliefShading(Input=own, UseNoDataValue=1, NoDataValue=-9999.0)
    assert fetch(of_cells).shape == (20, 30, 4), fetch(of_cells).shape
    solid = fetch(relief)[..., 3] == 255
    assert solid.sum() == 599 and np.array_equal(fetch(of_cells)[solid], fetch(relief)[solid])

    # A picture goes back to its place.
    pv.SaveData(path("shaded.tif"), proxy=relief)
    told = json.loads(subprocess.run(["gdalinfo", "-json", path("shaded.tif")], check=True,
                                     capture_output=True).stdout)
    assert told["geoTransform"] == [500000, 10, 0, 4100200, 0, -10], told["geoTransform"]
    assert "32633" in json.dumps(told["coordinateSystem"]) and len(told["bands"]) == 4
    back = pv.ReliefImageReader(FileName=path("shaded.tif"))
    back.UpdatePipeline()
    image = pv.servermanager.Fetch(back)
    assert np.array_equal(picture_of(image, image.GetPointData().GetScalars().GetName()), fetch(relief))

    # Layers.
    relief.Output = "Float linear"
    relief.Illumination = 1
    pv.SaveData(path("layers.exr"), proxy=relief)
    back = pv.ReliefImageReader(FileName=path("layers.exr"))
    back.UpdatePipeline()
    layers = pv.servermanager.Fetch(back).GetPointData().GetScalars()
    assert layers.GetNumberOfComponents() == 5, layers.GetNumberOfComponents()
    linear = vtk_to_numpy(layers).reshape(20, 30, 5)[..., :3]
    assert np.array_equal(linear[solid], fetch(relief)[solid][:, :3])

    # An environment from a file: a row of white above one of black is the white dome.
    with open(path("dome.pgm"), "w", encoding="ascii") as dome:
        dome.write("P2 4 2 255\n255 255 255 255\n0 0 0 0\n")
    lit = pv.ReliefShading(Input=reader, Output="Float linear", Lighting="Sun and environment",
                           EnvironmentSource="White dome", SunSwitch=0)
    wanted = fetch(lit)
    lit.EnvironmentSource = "Image file"
    lit.EnvironmentFile = path("dome.pgm")
    check_equal(fetch(lit), wanted, "the dome of a file")
print("passed")
