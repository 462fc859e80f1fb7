# SPDX-License-Identifier: BSD-3-Clause
"""Shades a bas-relief of bronze under a point light.

    python3 Medallion.py [picture.png]
"""

import argparse

from reliefshading import vtkImageReliefShading
from vtkmodules.vtkRenderingCore import (vtkImageSlice, vtkImageSliceMapper, vtkLight, vtkRenderer,
                                         vtkRenderWindow)

from medallion_heights import medallion_heights
from show_or_write import show_or_write

parser = argparse.ArgumentParser(description="Shade a bas-relief under a point light.")
parser.add_argument("picture", nargs="?", help="PNG file to write instead of opening a window")
arguments = parser.parse_args()

shading = vtkImageReliefShading()
shading.SetInputData(medallion_heights())
shading.SetOutputScalarTypeToUnsignedChar()  # sRGB, as a screen expects

# Light enters metal hardly at all: a small depth, and highlights of the metal's own colour.
scene = shading.GetScene()
bronze = scene.GetMaterial()
bronze.SetSubsurfaceDepth(0.004)
bronze.SetBaseColor(0.01, 0.01, 0.012)
bronze.SetDiffuseColor(0.42, 0.23, 0.1)
bronze.SetSpecularColor(1.0, 0.75, 0.4)
bronze.SetSpecularCoefficient(0.45)
bronze.SetSpecularPower(8.0)

lamp = vtkLight()
lamp.PositionalOn()
lamp.SetPosition(-1.2, 1.4, 1.4)
lamp.SetDiffuseColor(1.0, 0.9, 0.75)
lamp.SetIntensity(1.3)
scene.AddLight(lamp)

mapper = vtkImageSliceMapper()
mapper.SetInputConnection(shading.GetOutputPort())
image = vtkImageSlice()
image.SetMapper(mapper)

renderer = vtkRenderer()
renderer.AddViewProp(image)
window = vtkRenderWindow()
window.SetSize(900, 900)
window.SetWindowName("Medallion")
window.AddRenderer(renderer)

# Fill the window with the image.
bounds = image.GetBounds()
renderer.ResetCamera()
renderer.GetActiveCamera().ParallelProjectionOn()
renderer.GetActiveCamera().SetParallelScale((bounds[3] - bounds[2]) / 2.0)

show_or_write(window, arguments.picture)
