# SPDX-License-Identifier: BSD-3-Clause
"""Shades a NumPy array of heights and gives back a NumPy array of colours.

    python3 NumpyShading.py [picture.png]
"""

import sys

import numpy as np
from reliefshading import vtkImageReliefShading, vtkReliefScene
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter


def to_image(array, spacing=(1.0, 1.0)):
    """An image of VTK from an array of (rows, columns) or (rows, columns, components). The first
    row of an array is its top, that of an image its bottom, so the rows are turned over."""
    rows, columns = array.shape[:2]
    image = vtkImageData()
    image.SetDimensions(columns, rows, 1)
    image.SetSpacing(spacing[0], spacing[1], 1.0)
    values = np.ascontiguousarray(array[::-1]).reshape(rows * columns, -1)
    image.GetPointData().SetScalars(numpy_to_vtk(values, deep=True))
    return image


def from_image(image, name=None):
    """The array of an image's scalars or of the layer named, its first row on top."""
    columns, rows, _ = image.GetDimensions()
    data = image.GetPointData()
    values = vtk_to_numpy(data.GetArray(name) if name else data.GetScalars())
    return values.reshape(rows, columns, -1)[::-1].copy()


def shade(heights, spacing=(1.0, 1.0), scene=None, encoded=False):
    """Colours of (rows, columns, 4) for heights of (rows, columns): linear floats, or 8 bits in
    sRGB. NaN heights are holes. Without a scene, the sun shines from the upper left."""
    shading = vtkImageReliefShading()
    shading.SetInputData(to_image(heights, spacing))
    if scene:
        shading.SetScene(scene)
    if encoded:
        shading.SetOutputScalarTypeToUnsignedChar()
    shading.Update()
    return from_image(shading.GetOutput())


def main():
    # A drop has fallen into water: rings that fade from the centre.
    y, x = np.mgrid[-1.0:1.0:600j, -1.0:1.0:600j]
    radius = np.hypot(x + 0.2, y - 0.15)
    heights = 0.04 * np.cos(40.0 * radius) * np.exp(-2.5 * radius) / (0.25 + radius)

    scene = vtkReliefScene()
    scene.AddSun(315.0, 30.0).SetDiffuseColor(0.6, 0.75, 0.9)
    scene.AddSun(80.0, 20.0).SetDiffuseColor(0.5, 0.2, 0.15)
    scene.GetMaterial().SetSubsurfaceDepth(0.015)
    scene.GetMaterial().SetBaseColor(0.0, 0.02, 0.05)
    scene.GetMaterial().SetSpecularCoefficient(0.25)
    scene.GetMaterial().SetSpecularPower(20.0)

    spacing = (2.0 / 599.0, 2.0 / 599.0)
    colors = shade(heights, spacing, scene)
    print("linear colours", colors.shape, colors.dtype, "mean", colors.mean(axis=(0, 1)).round(3))

    if len(sys.argv) > 1:
        writer = vtkPNGWriter()
        writer.SetInputData(to_image(shade(heights, spacing, scene, encoded=True)))
        writer.SetFileName(sys.argv[1])
        writer.Write()


if __name__ == "__main__":
    main()
