# SPDX-License-Identifier: BSD-3-Clause
"""Drag the sun over a digital elevation model: its dot is read like a compass, north is up.

    python3 DragLight.py ../Data/jacksboro.tif [picture.png]

Drag the dot; turn the wheel over it to raise the sun; double-click it to make a lamp of it.
"""

import argparse

from reliefshading import vtkImageReliefShading, vtkReliefLightWidget, vtkReliefRasterReader
from vtkmodules.vtkInteractionStyle import vtkInteractorStyleImage
from vtkmodules.vtkRenderingCore import (vtkImageSlice, vtkImageSliceMapper, vtkRenderer,
                                         vtkRenderWindow, vtkRenderWindowInteractor)

from show_or_write import show_or_write

parser = argparse.ArgumentParser(description="Drag the sun over a digital elevation model.")
parser.add_argument("heights", help="TIFF file of heights in metres")
parser.add_argument("picture", nargs="?", help="PNG file to write instead of opening a window")
arguments = parser.parse_args()

heights = vtkReliefRasterReader()
heights.SetFileName(arguments.heights)
heights.Update()
if heights.GetErrorCode():
    raise SystemExit(1)  # the reader has said why

shading = vtkImageReliefShading()
shading.SetInputConnection(heights.GetOutputPort())
shading.SetOutputScalarTypeToUnsignedChar()  # sRGB, as a screen expects
shading.GetScene().SetHeightScale(2.0)
shading.GetScene().AddSun(315.0, 40.0).SetDiffuseColor(1.0, 0.85, 0.6)

mapper = vtkImageSliceMapper()
mapper.SetInputConnection(shading.GetOutputPort())
image = vtkImageSlice()
image.SetMapper(mapper)
renderer = vtkRenderer()
renderer.AddViewProp(image)
window = vtkRenderWindow()
window.SetSize(850, 900)
window.SetWindowName("DragLight")
window.SetOffScreenRendering(arguments.picture is not None)
window.AddRenderer(renderer)

# Fill the window with the image.
bounds = image.GetBounds()
renderer.ResetCamera()
renderer.GetActiveCamera().ParallelProjectionOn()
renderer.GetActiveCamera().SetParallelScale((bounds[3] - bounds[2]) / 2.0)

interactor = vtkRenderWindowInteractor()
interactor.SetInteractorStyle(vtkInteractorStyleImage())
interactor.SetRenderWindow(window)
interactor.Initialize()

# The dot moves the scene's first light, and the filter follows.
widget = vtkReliefLightWidget()
widget.SetInteractor(interactor)
dot = widget.GetLightRepresentation()
dot.SetScene(shading.GetScene())
dot.PlaceWidget(heights.GetOutput())
widget.On()

if arguments.picture:
    # Nobody is at the mouse: do what a hand would do, from the north-west to the west.
    at = [0.0, 0.0, 0.0]
    dot.GetDotPosition(at)
    renderer.SetWorldPoint(*at, 1.0)
    renderer.WorldToDisplay()
    x, y = (round(c) for c in renderer.GetDisplayPoint()[:2])
    for event, dx, dy in (("LeftButtonPressEvent", 0, 0), ("MouseMoveEvent", -60, -80),
                          ("MouseMoveEvent", -120, -160), ("LeftButtonReleaseEvent", -120, -160)):
        interactor.SetEventInformation(x + dx, y + dy, 0, 0, "\0", 0, None)
        interactor.InvokeEvent(event)

show_or_write(window, arguments.picture, interactor)
