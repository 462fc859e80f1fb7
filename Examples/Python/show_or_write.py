# SPDX-License-Identifier: BSD-3-Clause
"""What every example ends with: an interactive window or, with a file name, a picture."""

import vtkmodules.vtkRenderingFreeType  # noqa: F401 (text)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 (windows and mappers)
from vtkmodules.vtkInteractionStyle import vtkInteractorStyleTrackballCamera
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkRenderWindowInteractor, vtkWindowToImageFilter


def show_or_write(window, file_name=None, interactor=None):
    """Without a file name, shows the window until it is closed, with the given interactor or one
    that turns the camera. With a file name, renders off screen and writes a PNG."""
    if file_name is None:
        if interactor is None:
            interactor = vtkRenderWindowInteractor()
            interactor.SetInteractorStyle(vtkInteractorStyleTrackballCamera())
            interactor.SetRenderWindow(window)
        window.Render()
        interactor.Start()
        return

    window.OffScreenRenderingOn()
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(picture.GetOutputPort())
    writer.SetFileName(file_name)
    writer.Write()
    if writer.GetErrorCode():
        raise SystemExit(f"{file_name} cannot be written")
