// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefOpenGLTestUtilities_h
#define ReliefOpenGLTestUtilities_h

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkOpenGLRenderWindow.h"

#if __has_include("vtk_glad.h")
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

#include <iostream>

/// How often OpenGL has complained in any window that is watched.
inline int& OpenGLComplaints()
{
  static int count = 0;
  return count;
}

/// Takes the messages of OpenGL's debug output: what is an error, or may do anything, makes the
/// test fail by what is printed, even where it is a destructor that errs.
inline void GLAPIENTRY KeepOpenGLMessage(
  GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* message, const void*)
{
  if (type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR ||
    severity == GL_DEBUG_SEVERITY_HIGH)
  {
    std::cout << "ERR| OpenGL: " << message << std::endl;
    ++OpenGLComplaints();
  }
}

/// Makes tests fail where OpenGL complains of a call in a window: from its first frame on, in every
/// context that it gets.
inline void WatchOpenGL(vtkRenderWindow* window)
{
  vtkNew<vtkCallbackCommand> listen;
  listen->SetCallback(
    [](vtkObject* caller, unsigned long, void*, void*)
    {
      // There may be no context yet, or a new one.
      auto* opened = vtkOpenGLRenderWindow::SafeDownCast(caller);
      opened->Initialize();
      opened->MakeCurrent();
      if (!glDebugMessageCallback)
      {
        std::cout << "ERR| OpenGL: there is no debug output" << std::endl;
        return;
      }
      glEnable(GL_DEBUG_OUTPUT);
      glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
      glDebugMessageCallback(&KeepOpenGLMessage, nullptr);
    });
  window->AddObserver(vtkCommand::StartEvent, listen);
}

#endif
