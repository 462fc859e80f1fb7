# SPDX-License-Identifier: BSD-3-Clause
"""Tints a digital elevation model by height, as maps do, and shades it.

    python3 TintTerrain.py ../Data/jacksboro.tif [picture.png]
"""

import argparse

from reliefshading import vtkImageReliefShading, vtkReliefRasterReader
from vtkmodules.vtkRenderingCore import (vtkColorTransferFunction, vtkImageSlice,
                                         vtkImageSliceMapper, vtkRenderer, vtkRenderWindow)

from show_or_write import show_or_write

# Height in metres and the colour there, as it is to look on the screen: green lowland, yellow hills,
# brown ridges, light summits.
TINTS = (
    (230.0, 0.38, 0.55, 0.47),
    (290.0, 0.55, 0.69, 0.51),
    (350.0, 0.77, 0.80, 0.57),
    (450.0, 0.92, 0.83, 0.58),
    (600.0, 0.85, 0.67, 0.46),
    (780.0, 0.68, 0.49, 0.37),
    (920.0, 0.67, 0.58, 0.54),
    (1070.0, 0.97, 0.96, 0.95),
)

parser = argparse.ArgumentParser(description="Tint an elevation model by height and shade it.")
parser.add_argument("heights", help="TIFF file of heights in metres")
parser.add_argument("picture", nargs="?", help="PNG file to write instead of opening a window")
arguments = parser.parse_args()

# The file's samples are 3 seconds of arc apart. They come in metres, as heights do.
heights = vtkReliefRasterReader()
heights.SetFileName(arguments.heights)
heights.Update()
if heights.GetErrorCode():
    raise SystemExit(1)  # the reader has said why

tints = vtkColorTransferFunction()
for tint in TINTS:
    tints.AddRGBPoint(*tint)

shading = vtkImageReliefShading()
shading.SetInputConnection(heights.GetOutputPort())
shading.SetLookupTable(tints)  # of the file's own heights, whatever the height scale
shading.SetOutputScalarTypeToUnsignedChar()  # sRGB, as a screen expects

scene = shading.GetScene()
scene.SetHeightScale(2.5)
scene.GetMaterial().SetSubsurfaceDepth(80.0)
scene.SetLightsToSunAndSky(315.0, 28.0)
# A little brighter, so that level ground shows its tint as the table has it.
scene.GetLights().GetItemAsObject(0).SetIntensity(1.15)
scene.GetEnvironment().SetIntensity(0.45)

mapper = vtkImageSliceMapper()
mapper.SetInputConnection(shading.GetOutputPort())
image = vtkImageSlice()
image.SetMapper(mapper)
image.GetProperty().SetInterpolationTypeToCubic()

renderer = vtkRenderer()
renderer.AddViewProp(image)
window = vtkRenderWindow()
window.SetSize(850, 900)
window.SetWindowName("TintTerrain")
window.AddRenderer(renderer)

# Fill the window with the image.
bounds = image.GetBounds()
renderer.ResetCamera()
renderer.GetActiveCamera().ParallelProjectionOn()
renderer.GetActiveCamera().SetParallelScale((bounds[3] - bounds[2]) / 2.0)

show_or_write(window, arguments.picture)
