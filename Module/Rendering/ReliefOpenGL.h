// SPDX-License-Identifier: BSD-3-Clause
/// OpenGL's functions, as the VTK that is built with declares them: by glad since 9.4, by GLEW
/// before.
#ifndef ReliefOpenGL_h
#define ReliefOpenGL_h

#if __has_include("vtk_glad.h")
#include "vtk_glad.h"
#else
#include "vtk_glew.h"
#endif

#endif
