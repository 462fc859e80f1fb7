# SPDX-License-Identifier: BSD-3-Clause
"""Lights a bas-relief with a rainbow that stands all around it, and turns the rainbow.

    python3 RainbowEnvironment.py [picture.png]
"""

import argparse
import colorsys

import numpy as np
from reliefshading import vtkImageReliefShading, vtkReliefEnvironment
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkRenderingCore import (vtkImageSlice, vtkImageSliceMapper, vtkRenderer,
                                         vtkRenderWindow)

from medallion_heights import medallion_heights
from show_or_write import show_or_write

parser = argparse.ArgumentParser(description="Light a bas-relief with a rainbow.")
parser.add_argument("picture", nargs="?", help="PNG file to write instead of opening a window")
arguments = parser.parse_args()


def rainbow():
    """A latitude-longitude image, linear RGB: the hue runs around the horizon once and fades to
    black overhead. An array begins with the zenith."""
    columns, rows = 180, 90
    hues = np.array([colorsys.hsv_to_rgb(i / columns, 1.0, 1.0) for i in range(columns)])
    polar = (np.arange(rows) + 0.5) / rows * np.pi
    low = np.sin(polar)[:, None, None] ** 12
    radiance = 3.6 * low * hues[None, :, :]
    image = vtkImageData()
    image.SetDimensions(columns, rows, 1)
    # An image of VTK begins with its bottom row.
    values = np.ascontiguousarray(radiance[::-1], np.float32).reshape(-1, 3)
    image.GetPointData().SetScalars(numpy_to_vtk(values, deep=True))
    return image


window = vtkRenderWindow()
window.SetSize(1200, 400)
window.SetWindowName("RainbowEnvironment")
map_of_colors = rainbow()
heights = medallion_heights()
for place, angle in enumerate((0.0, 120.0, 240.0)):
    environment = vtkReliefEnvironment()
    environment.SetImage(map_of_colors)
    environment.SetRotationZ(angle)
    environment.SetNumberOfSamples(128)

    shading = vtkImageReliefShading()
    shading.SetInputData(heights)
    shading.SetOutputScalarTypeToUnsignedChar()  # sRGB, as a screen expects
    scene = shading.GetScene()
    scene.SetEnvironment(environment)
    scene.GetMaterial().SetSubsurfaceDepth(0.006)

    mapper = vtkImageSliceMapper()
    mapper.SetInputConnection(shading.GetOutputPort())
    image = vtkImageSlice()
    image.SetMapper(mapper)
    renderer = vtkRenderer()
    renderer.SetViewport(place / 3.0, 0.0, (place + 1) / 3.0, 1.0)
    renderer.AddViewProp(image)
    window.AddRenderer(renderer)
    bounds = image.GetBounds()
    renderer.ResetCamera()
    renderer.GetActiveCamera().ParallelProjectionOn()
    renderer.GetActiveCamera().SetParallelScale((bounds[3] - bounds[2]) / 2.0)

show_or_write(window, arguments.picture)
