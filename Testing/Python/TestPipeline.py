# SPDX-License-Identifier: BSD-3-Clause
"""The filter executes when, and only when, something that it depends on has changed."""

import unittest

import numpy as np
from reliefshading import vtkImageReliefShading, vtkReliefMaterial, vtkReliefScene
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkImagingCore import vtkImageShiftScale
from vtkmodules.vtkImagingSources import vtkImageGaussianSource
from vtkmodules.vtkRenderingCore import vtkLight


def colors(image):
    columns, rows, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns, 4).copy()


class TestPipeline(unittest.TestCase):
    def setUp(self):
        self.source = vtkImageGaussianSource()
        self.source.SetWholeExtent(0, 49, 0, 39, 0, 0)
        self.source.SetCenter(25.0, 20.0, 0.0)
        self.source.SetStandardDeviation(6.0)
        self.source.SetMaximum(10.0)
        self.shading = vtkImageReliefShading()
        self.shading.SetInputConnection(self.source.GetOutputPort())
        self.scene = self.shading.GetScene()
        self.material = self.scene.GetMaterial()
        self.sun = self.scene.AddSun(315.0, 40.0)
        self.runs = 0
        self.shading.AddObserver("EndEvent", self.count)
        self.shading.Update()
        self.assertEqual(self.runs, 1)

    def count(self, *_):
        self.runs += 1

    def assert_runs(self, expected):
        self.runs = 0
        self.shading.Update()
        self.assertEqual(self.runs, expected)

    def test_nothing_changed(self):
        self.assert_runs(0)

    def test_same_values_change_nothing(self):
        self.material.SetDiffuseColor(self.material.GetDiffuseColor())
        self.material.SetSpecularCoefficient(self.material.GetSpecularCoefficient())
        self.material.SetOffsetModeToTangentPlane()
        self.scene.SetHeightScale(1.0)
        self.scene.SetTolerance(self.scene.GetTolerance())
        self.shading.SetScene(self.scene)
        self.shading.SetOutputScalarTypeToFloat()
        self.assert_runs(0)

    def test_each_change_executes_once(self):
        changes = (
            lambda: self.material.SetDiffuseColor(0.9, 0.5, 0.2),
            lambda: self.material.SetSpecularCoefficient(0.2),
            lambda: self.material.SetSubsurfaceDepth(2.0),
            lambda: self.material.SetOffsetModeToSurfaceNormal(),
            lambda: self.material.UseFloorOn(),
            lambda: self.sun.SetIntensity(0.5),
            lambda: self.sun.SetDiffuseColor(1.0, 0.9, 0.8),
            lambda: self.sun.SetPosition(1.0, 2.0, 3.0),
            lambda: self.sun.SwitchOff(),
            lambda: self.scene.AddSun(90.0, 20.0),
            lambda: self.scene.RemoveLight(self.sun),
            lambda: self.scene.SetHeightScale(2.0),
            lambda: self.scene.SetTolerance(0.0),
            lambda: self.scene.SetMaterial(vtkReliefMaterial()),
            lambda: self.shading.SetScene(vtkReliefScene()),
            lambda: self.shading.GenerateNormalsOn(),
            lambda: self.shading.SetOutputScalarTypeToUnsignedChar(),
            lambda: self.source.SetMaximum(5.0),
        )
        for number, change in enumerate(changes):
            with self.subTest(number):
                change()
                self.assert_runs(1)
                self.assert_runs(0)

    def test_replaced_parts_count_no_more(self):
        self.scene.SetMaterial(vtkReliefMaterial())
        self.scene.RemoveLight(self.sun)
        self.shading.Update()
        self.material.SetDiffuseColor(0.1, 0.2, 0.3)
        self.sun.SetIntensity(0.1)
        self.assert_runs(0)

    def test_a_change_changes_the_colors(self):
        before = colors(self.shading.GetOutput())
        self.material.SetDiffuseColor(0.5, 0.5, 0.5)
        self.shading.Update()
        np.testing.assert_allclose(colors(self.shading.GetOutput())[..., :3],
                                   0.5 * before[..., :3], rtol=1e-6)

    def test_connections(self):
        before = colors(self.shading.GetOutput())
        double = vtkImageShiftScale()
        double.SetInputConnection(self.source.GetOutputPort())
        double.SetScale(2.0)
        self.shading.SetInputConnection(double.GetOutputPort())
        self.assert_runs(1)
        self.assertFalse(np.array_equal(colors(self.shading.GetOutput()), before))
        # Heights doubled here and halved there are the same heights.
        self.scene.SetHeightScale(0.5)
        self.assert_runs(1)
        np.testing.assert_allclose(colors(self.shading.GetOutput()), before, atol=1e-6)
        # Data without a pipeline give the same again.
        self.source.Update()
        image = vtkImageData()
        image.ShallowCopy(self.source.GetOutput())
        self.scene.SetHeightScale(1.0)
        self.shading.SetInputData(image)
        self.assert_runs(1)
        np.testing.assert_array_equal(colors(self.shading.GetOutput()), before)

    def test_masks(self):
        mask = vtkImageShiftScale()
        mask.SetInputConnection(self.source.GetOutputPort())
        mask.SetShift(-5.0)
        mask.ClampOverflowOn()
        mask.SetOutputScalarTypeToUnsignedChar()
        self.shading.SetMaskConnection(mask.GetOutputPort())
        self.assert_runs(1)
        mask.Update()
        covered = vtk_to_numpy(mask.GetOutput().GetPointData().GetScalars()).reshape(40, 50) != 0
        np.testing.assert_array_equal(colors(self.shading.GetOutput())[..., 3], covered)
        mask.SetShift(-8.0)
        self.assert_runs(1)
        self.shading.SetMaskConnection(None)
        self.assert_runs(1)
        self.assertTrue((colors(self.shading.GetOutput())[..., 3] == 1.0).all())

    def test_update_extents(self):
        whole = colors(self.shading.GetOutput())
        part = vtkImageReliefShading()
        part.SetInputConnection(self.source.GetOutputPort())
        part.SetScene(self.scene)
        for extent in ((10, 29, 5, 14, 0, 0), (0, 0, 39, 39, 0, 0), (0, 49, 0, 39, 0, 0)):
            with self.subTest(extent):
                part.UpdateExtent(extent)
                output = part.GetOutput()
                i0, i1, j0, j1 = output.GetExtent()[:4]
                self.assertTrue(i0 <= extent[0] and i1 >= extent[1])
                self.assertTrue(j0 <= extent[2] and j1 >= extent[3])
                np.testing.assert_array_equal(colors(output), whole[j0:j1 + 1, i0:i1 + 1])

    def test_scene_shared_by_two_filters(self):
        other = vtkImageReliefShading()
        other.SetInputConnection(self.source.GetOutputPort())
        other.SetScene(self.scene)
        lamp = vtkLight()
        lamp.PositionalOn()
        lamp.SetPosition(25.0, 20.0, 30.0)
        self.scene.AddLight(lamp)
        self.assert_runs(1)
        other.Update()
        np.testing.assert_array_equal(colors(other.GetOutput()), colors(self.shading.GetOutput()))


if __name__ == "__main__":
    unittest.main()
