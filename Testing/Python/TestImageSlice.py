# SPDX-License-Identifier: BSD-3-Clause
"""vtkImageSlice shows 8-bit output pixel by pixel, its colours as they are."""

import unittest

import numpy as np
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (windows and mappers)
from reliefshading import vtkImageReliefShading
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkImagingSources import vtkImageGaussianSource
from vtkmodules.vtkRenderingCore import (vtkImageSlice, vtkImageSliceMapper, vtkRenderer,
                                         vtkRenderWindow, vtkWindowToImageFilter)


def rgb(image):
    columns, rows, _ = image.GetDimensions()
    return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(rows, columns, -1)[..., :3]


class TestImageSlice(unittest.TestCase):
    def test_colors_pass_through(self):
        source = vtkImageGaussianSource()
        source.SetWholeExtent(0, 199, 0, 149, 0, 0)
        source.SetCenter(90.0, 70.0, 0.0)
        source.SetStandardDeviation(20.0)
        source.SetMaximum(40.0)
        shading = vtkImageReliefShading()
        shading.SetInputConnection(source.GetOutputPort())
        shading.SetOutputScalarTypeToUnsignedChar()
        shading.GetScene().GetMaterial().SetDiffuseColor(0.9, 0.6, 0.3)
        shading.GetScene().AddSun(300.0, 25.0)

        mapper = vtkImageSliceMapper()
        mapper.SetInputConnection(shading.GetOutputPort())
        mapper.BorderOn()  # or the outer samples are shown by half
        image = vtkImageSlice()
        image.SetMapper(mapper)
        renderer = vtkRenderer()
        renderer.AddViewProp(image)
        window = vtkRenderWindow()
        window.OffScreenRenderingOn()
        window.SetSize(200, 150)
        window.AddRenderer(renderer)
        renderer.ResetCamera()
        renderer.GetActiveCamera().ParallelProjectionOn()
        renderer.GetActiveCamera().SetParallelScale(75.0)  # one pixel for each sample
        picture = vtkWindowToImageFilter()
        picture.SetInput(window)
        picture.ReadFrontBufferOff()
        picture.Update()

        expected = rgb(shading.GetOutput()).astype(int)
        self.assertGreater(np.ptp(expected), 100)
        difference = np.abs(rgb(picture.GetOutput()) - expected)
        self.assertLessEqual(difference.max(), 1)


if __name__ == "__main__":
    unittest.main()
