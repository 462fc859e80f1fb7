# SPDX-License-Identifier: BSD-3-Clause
"""Shades a digital elevation model on the graphics processor, under a lamp that you drag.

    python3 InteractiveRelief.py ../Data/jacksboro.tif [picture.png]

Drag with the left button to move the lamp, turn the wheel to lift or lower it. With a picture, a drag
is played and its result written.
"""

import argparse

from reliefshading import vtkReliefImageMapper, vtkReliefRasterReader
from vtkmodules.vtkInteractionStyle import vtkInteractorStyleUser
from vtkmodules.vtkRenderingCore import (vtkCellPicker, vtkImageSlice, vtkLight, vtkRenderer,
                                         vtkRenderWindow, vtkRenderWindowInteractor)

from show_or_write import show_or_write

parser = argparse.ArgumentParser(description="Drag a lamp over a digital elevation model.")
parser.add_argument("heights", help="TIFF file of heights in metres")
parser.add_argument("picture", nargs="?", help="PNG file to write instead of opening a window")
arguments = parser.parse_args()

heights = vtkReliefRasterReader()
heights.SetFileName(arguments.heights)
heights.Update()
if heights.GetErrorCode():
    raise SystemExit(1)  # the reader has said why

mapper = vtkReliefImageMapper()
mapper.SetInputConnection(heights.GetOutputPort())
image = vtkImageSlice()
image.SetMapper(mapper)

scene = mapper.GetScene()
scene.SetHeightScale(2.0)
scene.GetMaterial().SetSubsurfaceDepth(120.0)
scene.GetMaterial().SetDiffuseColor(1.0, 0.9, 0.75)
lamp = vtkLight()
lamp.PositionalOn()
lamp.SetPosition(8000.0, 20000.0, 5000.0)
scene.AddLight(lamp)

renderer = vtkRenderer()
renderer.AddViewProp(image)
window = vtkRenderWindow()
window.SetSize(850, 900)
window.SetWindowName("InteractiveRelief")
window.AddRenderer(renderer)

# Fill the window with the image.
bounds = image.GetBounds()
renderer.ResetCamera()
renderer.GetActiveCamera().ParallelProjectionOn()
renderer.GetActiveCamera().SetParallelScale((bounds[3] - bounds[2]) / 2.0)

interactor = vtkRenderWindowInteractor()
interactor.SetRenderWindow(window)
style = vtkInteractorStyleUser()
interactor.SetInteractorStyle(style)
picker = vtkCellPicker()
dragging = False


def move(*_):
    if dragging and picker.Pick(*interactor.GetEventPosition(), 0.0, renderer):
        lamp.SetPosition(*picker.GetPickPosition()[:2], lamp.GetPosition()[2])
        window.Render()


def hold(down):
    """While the button is held, the mapper gives up detail for a steady frame rate."""
    global dragging
    dragging = down
    window.SetDesiredUpdateRate(15.0 if down else 0.0001)
    move()
    window.Render()


def lift(factor):
    x, y, z = lamp.GetPosition()
    lamp.SetPosition(x, y, z * factor)
    window.Render()


style.AddObserver("LeftButtonPressEvent", lambda *_: hold(True))
style.AddObserver("MouseMoveEvent", move)
style.AddObserver("LeftButtonReleaseEvent", lambda *_: hold(False))
style.AddObserver("MouseWheelForwardEvent", lambda *_: lift(1.1))
style.AddObserver("MouseWheelBackwardEvent", lambda *_: lift(1.0 / 1.1))

if arguments.picture:
    window.OffScreenRenderingOn()
    mapper.ProgressiveOff()
    interactor.Initialize()
    for event, x, y in [("LeftButtonPressEvent", 200, 200), ("MouseMoveEvent", 400, 400),
                        ("MouseMoveEvent", 560, 610), ("LeftButtonReleaseEvent", 560, 610),
                        ("MouseWheelBackwardEvent", 560, 610)]:
        interactor.SetEventInformation(x, y)
        interactor.InvokeEvent(event)
    show_or_write(window, arguments.picture)
else:
    window.Render()
    interactor.Start()
