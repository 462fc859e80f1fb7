# SPDX-License-Identifier: BSD-3-Clause
"""Shades a digital elevation model and drapes the result over the terrain itself.

    python3 DrapeTerrain.py ../Data/jacksboro.tif [picture.png]
"""

import argparse

from reliefshading import vtkImageReliefShading, vtkReliefRasterReader
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow

from draped_relief import draped_relief
from show_or_write import show_or_write

EXAGGERATION = 2.5

parser = argparse.ArgumentParser(description="Drape a shaded elevation model over its terrain.")
parser.add_argument("heights", help="TIFF file of heights in metres")
parser.add_argument("picture", nargs="?", help="PNG file to write instead of opening a window")
arguments = parser.parse_args()

# The file's samples are 3 seconds of arc apart. They come in metres, as heights do.
heights = vtkReliefRasterReader()
heights.SetFileName(arguments.heights)
heights.Update()
if heights.GetErrorCode():
    raise SystemExit(1)  # the reader has said why

shading = vtkImageReliefShading()
shading.SetInputConnection(heights.GetOutputPort())
shading.SetOutputScalarTypeToUnsignedChar()  # sRGB, as a screen expects

scene = shading.GetScene()
scene.SetHeightScale(EXAGGERATION)
scene.GetMaterial().SetSubsurfaceDepth(90.0)

# A warm, low sun, and a blue sky that shines into its shadows from all sides.
sun = scene.AddSun(295.0, 20.0)
sun.SetDiffuseColor(1.0, 0.72, 0.42)
for azimuth in range(0, 360, 45):
    sky = scene.AddSun(azimuth, 45.0)
    sky.SetDiffuseColor(0.4, 0.6, 1.0)
    sky.SetIntensity(0.025)

renderer = vtkRenderer()
renderer.AddActor(draped_relief(heights, shading, EXAGGERATION))
renderer.GradientBackgroundOn()
renderer.SetBackground(1.0, 0.82, 0.6)
renderer.SetBackground2(0.6, 0.7, 0.84)
camera = renderer.GetActiveCamera()
camera.SetPosition(17000.0, -8000.0, 8500.0)
camera.SetFocalPoint(15200.0, 14000.0, 200.0)
camera.SetViewUp(0.0, 0.0, 1.0)
renderer.ResetCameraClippingRange()

window = vtkRenderWindow()
window.SetSize(900, 600)
window.SetWindowName("DrapeTerrain")
window.AddRenderer(renderer)
show_or_write(window, arguments.picture)
