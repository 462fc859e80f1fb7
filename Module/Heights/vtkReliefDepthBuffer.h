// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkReliefDepthBuffer_h
#define vtkReliefDepthBuffer_h

/// @file
/// Heights from the depth buffer of a renderer, by whatever draws it. Not installed.

#include "vtkReliefMeshTriangles.h"

#include <string>
#include <vector>

class vtkRenderer;

namespace relief::hosts
{
/// What a renderer saw, in the frame of its camera: where samples are, and how high.
struct DepthHeights
{
  ViewAxes view;
  int columns = 0;
  int rows = 0;
  double origin[2] = { 0.0, 0.0 };
  double spacing[2] = { 1.0, 1.0 };
  std::vector<double> heights; ///< NaN where nothing was drawn
};

/// How many pixels a renderer has; false if it has none, or no window.
bool FindPixels(vtkRenderer* renderer, int& columns, int& rows);

/// Where the samples are, as the camera now stands. Returns an empty text, or what is wrong.
std::string FindDepthFrame(vtkRenderer* renderer, DepthHeights& result);

/// Draws the window and reads the heights. Returns an empty text, or what is wrong.
std::string ReadDepthHeights(vtkRenderer* renderer, DepthHeights& result);
}

#endif
