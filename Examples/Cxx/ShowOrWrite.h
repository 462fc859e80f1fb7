// SPDX-License-Identifier: BSD-3-Clause
// What every example ends with: an interactive window or, with a file name, a picture.
#ifndef ShowOrWrite_h
#define ShowOrWrite_h

#include <vtkErrorCode.h>
#include <vtkInteractorStyleTrackballCamera.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkWindowToImageFilter.h>

#include <cstdlib>

// Without a file name, shows the window until it is closed. With one, renders off screen and writes
// a PNG. Returns the program's exit status.
inline int ShowOrWrite(vtkRenderWindow* window, const char* fileName)
{
  if (!fileName)
  {
    vtkNew<vtkInteractorStyleTrackballCamera> style;
    vtkNew<vtkRenderWindowInteractor> interactor;
    interactor->SetInteractorStyle(style);
    interactor->SetRenderWindow(window);
    window->Render();
    interactor->Start();
    return EXIT_SUCCESS;
  }

  window->OffScreenRenderingOn();
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(window);
  picture->ReadFrontBufferOff();
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(picture->GetOutputPort());
  writer->SetFileName(fileName);
  writer->Write();
  return writer->GetErrorCode() == vtkErrorCode::NoError ? EXIT_SUCCESS : EXIT_FAILURE;
}

#endif
