# SPDX-License-Identifier: BSD-3-Clause
"""Shades a translucent bas-relief, a roundel of alabaster in front of a lamp.

    python3 BacklitMedallion.py [picture.png]
"""

import argparse

from reliefshading import vtkImageReliefShading
from vtkmodules.vtkRenderingCore import (vtkImageSlice, vtkImageSliceMapper, vtkLight, vtkRenderer,
                                         vtkRenderWindow)

from medallion_heights import medallion_heights
from show_or_write import show_or_write

parser = argparse.ArgumentParser(description="Shade a translucent bas-relief, lit from behind.")
parser.add_argument("picture", nargs="?", help="PNG file to write instead of opening a window")
arguments = parser.parse_args()

shading = vtkImageReliefShading()
shading.SetInputData(medallion_heights(0.1))
shading.SetOutputScalarTypeToUnsignedChar()  # sRGB, as a screen expects

# The floor is the back of the slab. Light from behind it comes through where the slab is thin, and
# is scattered forward, most of it straight on.
scene = shading.GetScene()
alabaster = scene.GetMaterial()
alabaster.UseFloorOn()
alabaster.SetFloorHeight(-0.01)
alabaster.SetSubsurfaceDepth(0.015)
alabaster.SetOffsetModeToSurfaceNormal()
alabaster.SetAttenuationToExponential()
alabaster.SetDensity(28.0)
alabaster.SetForwardScatterCoefficient(0.6)
alabaster.SetForwardScatterPower(2.0)
alabaster.SetDiffuseColor(1.0, 0.42, 0.12)
alabaster.SetSpecularCoefficient(0.06)
alabaster.SetSpecularPower(10.0)

lamp = vtkLight()
lamp.PositionalOn()
lamp.SetPosition(0.1, -0.2, -0.7)
lamp.SetDiffuseColor(1.0, 0.8, 0.55)
lamp.SetIntensity(7.0)
scene.AddLight(lamp)

# Faint daylight from the front gives the dark parts their shape.
daylight = vtkLight()
daylight.PositionalOn()
daylight.SetPosition(-1.2, 1.4, 0.9)
daylight.SetDiffuseColor(0.7, 0.85, 1.0)
daylight.SetIntensity(0.4)
scene.AddLight(daylight)

# The lamp's intensity also multiplies the error that the illumination may have.
scene.SetTolerance(0.0002)

mapper = vtkImageSliceMapper()
mapper.SetInputConnection(shading.GetOutputPort())
image = vtkImageSlice()
image.SetMapper(mapper)

renderer = vtkRenderer()
renderer.AddViewProp(image)
window = vtkRenderWindow()
window.SetSize(900, 900)
window.SetWindowName("BacklitMedallion")
window.AddRenderer(renderer)

# Fill the window with the image.
bounds = image.GetBounds()
renderer.ResetCamera()
renderer.GetActiveCamera().ParallelProjectionOn()
renderer.GetActiveCamera().SetParallelScale((bounds[3] - bounds[2]) / 2.0)

show_or_write(window, arguments.picture)
