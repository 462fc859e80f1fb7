# SPDX-License-Identifier: BSD-3-Clause
"""Shades a digital elevation model and shows it as an image.

    python3 ShadeTerrain.py ../Data/jacksboro.tif [picture.png]
"""

import argparse

from reliefshading import vtkImageReliefShading, vtkReliefRasterReader
from vtkmodules.vtkRenderingCore import (vtkImageSlice, vtkImageSliceMapper, vtkRenderer,
                                         vtkRenderWindow)

from show_or_write import show_or_write

parser = argparse.ArgumentParser(description="Shade a digital elevation model.")
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
scene.SetHeightScale(2.0)
scene.GetMaterial().SetSubsurfaceDepth(60.0)

# A warm, low sun, and a blue sky that shines into its shadows from all sides.
sun = scene.AddSun(315.0, 28.0)
sun.SetDiffuseColor(1.0, 0.8, 0.55)
sun.SetIntensity(0.9)
for azimuth in range(0, 360, 45):
    sky = scene.AddSun(azimuth, 45.0)
    sky.SetDiffuseColor(0.4, 0.6, 1.0)
    sky.SetIntensity(0.025)

mapper = vtkImageSliceMapper()
mapper.SetInputConnection(shading.GetOutputPort())
image = vtkImageSlice()
image.SetMapper(mapper)
image.GetProperty().SetInterpolationTypeToCubic()

renderer = vtkRenderer()
renderer.AddViewProp(image)
window = vtkRenderWindow()
window.SetSize(850, 900)
window.SetWindowName("ShadeTerrain")
window.AddRenderer(renderer)

# Fill the window with the image.
bounds = image.GetBounds()
renderer.ResetCamera()
renderer.GetActiveCamera().ParallelProjectionOn()
renderer.GetActiveCamera().SetParallelScale((bounds[3] - bounds[2]) / 2.0)

show_or_write(window, arguments.picture)
