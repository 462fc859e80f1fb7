# SPDX-License-Identifier: BSD-3-Clause
"""Shades a digital elevation model under the sky: the whole dome, and a sun with a clear sky.

    python3 SkyTerrain.py ../Data/jacksboro.tif [picture.png]
"""

import argparse

from reliefshading import vtkImageReliefShading, vtkReliefRasterReader
from vtkmodules.vtkRenderingCore import (vtkImageSlice, vtkImageSliceMapper, vtkRenderer,
                                         vtkRenderWindow)

from show_or_write import show_or_write

parser = argparse.ArgumentParser(description="Shade a digital elevation model under the sky.")
parser.add_argument("heights", help="TIFF file of heights in metres")
parser.add_argument("picture", nargs="?", help="PNG file to write instead of opening a window")
arguments = parser.parse_args()

heights = vtkReliefRasterReader()
heights.SetFileName(arguments.heights)
heights.Update()
if heights.GetErrorCode():
    raise SystemExit(1)  # the reader has said why


def under_the_dome(scene):
    """No side is preferred: valleys are dark because they see little of the sky."""
    scene.SetLightsToSkyDome()
    scene.GetEnvironment().SetIntensity(0.75)


def under_the_sun(scene):
    """A low sun, reddened by the air, and shadows that are blue from the sky."""
    scene.SetLightsToSunAndSky(315.0, 22.0)
    scene.GetEnvironment().SetIntensity(0.25)
    scene.GetLights().GetItemAsObject(0).SetIntensity(0.55)


window = vtkRenderWindow()
window.SetSize(1200, 636)
window.SetWindowName("SkyTerrain")
for place, light in enumerate((under_the_dome, under_the_sun)):
    shading = vtkImageReliefShading()
    shading.SetInputConnection(heights.GetOutputPort())
    shading.SetOutputScalarTypeToUnsignedChar()  # sRGB, as a screen expects
    scene = shading.GetScene()
    scene.SetHeightScale(4.0)
    scene.GetMaterial().SetSubsurfaceDepth(40.0)
    light(scene)

    mapper = vtkImageSliceMapper()
    mapper.SetInputConnection(shading.GetOutputPort())
    image = vtkImageSlice()
    image.SetMapper(mapper)
    image.GetProperty().SetInterpolationTypeToCubic()
    renderer = vtkRenderer()
    renderer.SetViewport(place / 2.0, 0.0, (place + 1) / 2.0, 1.0)
    renderer.AddViewProp(image)
    window.AddRenderer(renderer)
    bounds = image.GetBounds()
    renderer.ResetCamera()
    renderer.GetActiveCamera().ParallelProjectionOn()
    renderer.GetActiveCamera().SetParallelScale((bounds[3] - bounds[2]) / 2.0)

show_or_write(window, arguments.picture)
