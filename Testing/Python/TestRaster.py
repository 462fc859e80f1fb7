# SPDX-License-Identifier: BSD-3-Clause
"""A raster is read, shaded and written back in its place, without a number typed."""

import math
import os
import tempfile
import unittest

from reliefshading import vtkImageReliefShading, vtkReliefRasterReader, vtkReliefRasterWriter

TERRAIN = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "Examples", "Data",
                       "jacksboro.tif")
GRID = "ncols 6\nnrows 5\nxllcorner 4000\nyllcorner 7000\ncellsize 30\nnodata_value -9\n"


class TestRaster(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.grid = os.path.join(folder.name, "heights.asc")
        self.picture = os.path.join(folder.name, "shaded.tif")
        with open(self.grid, "w", encoding="ascii") as stream:
            rows = [" ".join(str(7 * i + j * j) for i in range(6)) for j in range(5)]
            stream.write(GRID + "\n".join(rows).replace("28", "-9") + "\n")

    def test_in_place(self):
        heights = vtkReliefRasterReader()
        heights.SetFileName(self.grid)
        shading = vtkImageReliefShading()
        shading.SetInputConnection(heights.GetOutputPort())
        picture = vtkReliefRasterWriter()
        picture.SetInputConnection(shading.GetOutputPort())
        picture.SetFileName(self.picture)
        picture.Write()
        self.assertEqual(picture.GetErrorCode(), 0)

        told = heights.GetOutput().GetFieldData()
        transform = [told.GetArray("geo:transform").GetValue(k) for k in range(6)]
        self.assertEqual(transform, [4000, 30, 0, 7150, 0, -30])
        self.assertEqual(heights.GetOutput().GetSpacing()[:2], (30, 30))
        again = vtkReliefRasterReader()
        again.SetFileName(self.picture)
        again.SetBand(1)
        again.Update()
        self.assertEqual(again.GetErrorCode(), 0)
        if told.GetArray("geo:transform") and again.GetOutput().GetFieldData().HasArray("geo:size"):
            found = again.GetOutput().GetFieldData().GetArray("geo:transform")
            self.assertEqual([found.GetValue(k) for k in range(6)], transform)
        mask = heights.GetMaskOutput().GetPointData().GetScalars()
        self.assertIn(0, [mask.GetValue(k) for k in range(30)])
        self.assertIn(255, [mask.GetValue(k) for k in range(30)])

    def test_sun(self):
        """A sun of a time, at the place of the raster, on its map."""
        terrain = vtkReliefRasterReader()
        terrain.SetFileName(TERRAIN)
        longitude, latitude, convergence = terrain.GetPlace()
        self.assertAlmostEqual(longitude, -84.2458333, places=6)
        self.assertAlmostEqual(latitude, 36.5895833, places=6)
        self.assertEqual(convergence, 0.0)  # degrees
        shading = vtkImageReliefShading()
        scene = shading.GetScene()
        angles = [0.0, 0.0]
        self.assertTrue(scene.FindSun("2026-06-21T17:39Z", longitude, latitude, 0.0, True, angles))
        self.assertAlmostEqual(angles[1], 90.0 - latitude + 23.43, delta=0.1)  # about noon
        sun = scene.AddSunAt("2026-06-21T17:39Z", *terrain.GetPlace())
        self.assertAlmostEqual(sun.GetPosition()[2], math.sin(math.radians(angles[1])), places=12)
        shading.SetInputConnection(terrain.GetOutputPort())
        shading.Update()
        self.assertEqual(shading.GetStatistics().GetLightsTraced(), 1)

    def test_error(self):
        heights = vtkReliefRasterReader()
        said = []
        heights.AddObserver("ErrorEvent", lambda *_: said.append(1))
        heights.SetFileName(self.grid + ".none")
        heights.Update()
        self.assertEqual(len(said), 1)
        self.assertNotEqual(heights.GetErrorCode(), 0)
        self.assertEqual(heights.GetOutput().GetNumberOfPoints(), 0)


if __name__ == "__main__":
    unittest.main()
