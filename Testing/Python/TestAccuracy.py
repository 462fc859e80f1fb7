# SPDX-License-Identifier: BSD-3-Clause
"""What accuracy costs, and the proof of what was shaded, with arrays of NumPy."""

import re
import unittest

import numpy as np
from reliefshading import vtkImageReliefShading, vtkReliefAccuracyReport, vtkReliefVerification
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData


class TestAccuracy(unittest.TestCase):
    def setUp(self):
        y, x = np.mgrid[0:40, 0:50]
        self.heights = (5 * np.sin(0.3 * x) * np.cos(0.2 * y) + (7 * x + 3 * y) % 4).astype(np.float32)
        self.image = vtkImageData()
        self.image.SetDimensions(50, 40, 1)
        self.image.GetPointData().SetScalars(numpy_to_vtk(self.heights.ravel(), deep=True))
        self.shading = vtkImageReliefShading()
        self.shading.SetInputData(self.image)
        self.scene = self.shading.GetScene()
        self.scene.AddSun(300.0, 15.0)

    def test_report(self):
        report = vtkReliefAccuracyReport()
        report.SetShading(self.shading)
        report.Update()
        table = report.GetOutput()
        columns = {table.GetColumnName(k): table.GetColumn(k)
                   for k in range(table.GetNumberOfColumns())}
        tolerances = vtk_to_numpy(columns["Tolerance"])
        errors = vtk_to_numpy(columns["ErrorOf999"])
        np.testing.assert_array_equal(
            tolerances[:8], [0, 0.0001, 0.0003, 0.001, 0.003, 0.01, 0.03, 0.1])
        self.assertTrue(np.all(np.isnan(tolerances[8:])))
        self.assertTrue(np.all(errors[:8] <= tolerances[:8] + 1e-5))
        np.testing.assert_array_equal(vtk_to_numpy(columns["Steps"])[8:], 8 * 2 ** np.arange(8))
        self.assertEqual(columns["Integrator"].GetValue(0), "Exact")
        self.assertEqual(columns["Integrator"].GetValue(8), "FixedStep")
        self.assertTrue(np.all(vtk_to_numpy(columns["Seconds"]) > 0))
        self.assertEqual(vtk_to_numpy(columns["Present"]).tolist().index(1), 2)
        self.assertIn(report.GetRecommendedRow(), range(8))
        self.assertEqual(report.GetNumberOfSamples(), 2000)

    def test_verification(self):
        self.shading.GenerateIlluminationOn()
        verification = vtkReliefVerification()
        verification.SetShading(self.shading)
        verification.SetNumberOfSamples(2000)
        verification.Update()
        self.assertTrue(verification.GetKept())
        self.assertLessEqual(verification.GetLargestError(), verification.GetPromisedError())
        self.assertEqual(verification.GetOutput().GetNumberOfRows(), 2000)
        # Somebody darkens one sample behind the shading's back.
        layer = vtk_to_numpy(self.shading.GetOutput().GetPointData().GetArray("Illumination"))
        layer.reshape(40, 50)[31, 7] += 0.01
        verification.Modified()
        verification.Update()
        self.assertFalse(verification.GetKept())
        self.assertEqual((verification.GetWorstColumn(), verification.GetWorstRow()), (7, 31))

    def test_hash(self):
        first = self.shading.GetHeightHash()
        self.assertTrue(re.fullmatch("[0-9a-f]{16}", first))
        doubles = numpy_to_vtk(self.heights.ravel().astype(np.float64), deep=True)
        self.image.GetPointData().SetScalars(doubles)
        self.assertEqual(self.shading.GetHeightHash(), first)
        doubles.SetValue(99, 1.0)
        self.image.Modified()
        self.assertNotEqual(self.shading.GetHeightHash(), first)


if __name__ == "__main__":
    unittest.main()
