# SPDX-License-Identifier: BSD-3-Clause
"""Shades a digital elevation model and drapes the result over the terrain itself.

    python3 DrapeTerrain.py ../Data/jacksboro.tif [picture.png]
"""

import argparse

from reliefshading import vtkImageReliefShading, vtkOpenImageIOReader
from vtkmodules.vtkFiltersGeneral import vtkWarpScalar
from vtkmodules.vtkFiltersGeometry import vtkImageDataGeometryFilter
from vtkmodules.vtkFiltersTexture import vtkTextureMapToPlane
from vtkmodules.vtkRenderingCore import (vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
                                         vtkTexture)

from show_or_write import show_or_write

EXAGGERATION = 2.5

parser = argparse.ArgumentParser(description="Drape a shaded elevation model over its terrain.")
parser.add_argument("heights", help="TIFF file of heights in metres")
parser.add_argument("picture", nargs="?", help="PNG file to write instead of opening a window")
arguments = parser.parse_args()

# The file's samples are 3 seconds of arc apart. Shading needs one unit of length for heights and
# spacing, so the spacing is set in metres, as it is at the latitude of this file.
heights = vtkOpenImageIOReader()
heights.SetFileName(arguments.heights)
heights.SetDataSpacing(74.6, 92.5, 1.0)
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

grid = vtkImageDataGeometryFilter()
grid.SetInputConnection(heights.GetOutputPort())
warp = vtkWarpScalar()
warp.SetInputConnection(grid.GetOutputPort())
warp.SetScaleFactor(EXAGGERATION)

# A texture runs from the outer edge of its first texel to that of its last one, half a sample
# beyond the image's bounds. The plane is set so that each texel's centre falls on its sample.
bounds = heights.GetOutput().GetBounds()
dx, dy, _ = heights.GetOutput().GetSpacing()
west, east = bounds[0] - dx / 2.0, bounds[1] + dx / 2.0
south, north = bounds[2] - dy / 2.0, bounds[3] + dy / 2.0
coordinates = vtkTextureMapToPlane()
coordinates.SetInputConnection(warp.GetOutputPort())
coordinates.SetOrigin(west, south, 0.0)
coordinates.SetPoint1(east, south, 0.0)
coordinates.SetPoint2(west, north, 0.0)

texture = vtkTexture()
texture.SetInputConnection(shading.GetOutputPort())
texture.SetColorModeToDirectScalars()
texture.InterpolateOn()
texture.MipmapOn()

mapper = vtkPolyDataMapper()
mapper.SetInputConnection(coordinates.GetOutputPort())
mapper.ScalarVisibilityOff()
terrain = vtkActor()
terrain.SetMapper(mapper)
terrain.SetTexture(texture)
terrain.GetProperty().LightingOff()  # the texture is lit already

renderer = vtkRenderer()
renderer.AddActor(terrain)
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
