// SPDX-License-Identifier: BSD-3-Clause
//
// What the other tests that render rely on: a call that OpenGL refuses is told, in each context of
// a window. CTest looks for the messages.

#include "ReliefOpenGLTestUtilities.h"

#include "vtkSmartPointer.h"

int TestOpenGLMessages(int, char*[])
{
  auto window = vtkSmartPointer<vtkRenderWindow>::New();
  window->OffScreenRenderingOn();
  WatchOpenGL(window);
  window->Render();
  std::cout << "Before: " << OpenGLComplaints() << " complaints" << std::endl;
  glEnable(GL_RGBA);
  window->Finalize();
  window->Render();
  glBindBuffer(GL_ARRAY_BUFFER, 0xffffu);
  return EXIT_SUCCESS;
}
