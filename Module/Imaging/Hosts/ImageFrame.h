// SPDX-License-Identifier: BSD-3-Clause
#ifndef ImageFrame_h
#define ImageFrame_h

/// @file
/// Where an image lies, and whether it can be shaded or read as a texture. Not installed; functions
/// return an empty text, or what is wrong.

#include "vtkReliefShadingModule.h" // For export macro

#include "ColorTexture.h"

#include <string>

class vtkDataArray;
class vtkImageData;

namespace relief::hosts
{
/// The image's own frame: world coordinates with origin and direction taken off, its first sample
/// at (0, 0), x and y growing with the index.
class VTKRELIEFSHADING_EXPORT ImageFrame
{
public:
  std::string Assign(vtkImageData* image);

  glm::dvec3 VectorFromWorld(const double world[3]) const;
  glm::dvec3 PointFromWorld(const double world[3]) const;
  bool IsWorld() const;
  void NormalToWorld(float* n) const;

  double Spacing[2] = { 1.0, 1.0 };

private:
  double Origin[3];
  double Direction[9];
  double Inverse[9];
  double Sign[2] = { 1.0, 1.0 };
  double First[2] = { 0.0, 0.0 };
};

/// Checks that an image is one slice of scalars.
VTKRELIEFSHADING_EXPORT std::string CheckImage(
  vtkImageData* image, vtkDataArray* scalars, const char* what);

/// Checks that an image is one slice of scalars of one component.
VTKRELIEFSHADING_EXPORT std::string CheckInput(
  vtkImageData* image, vtkDataArray* scalars, const char* what);

/// An image of grey, RGB or either with alpha as a texture whose place is left open.
VTKRELIEFSHADING_EXPORT std::string ConvertColors(
  vtkImageData* image, vtkDataArray* scalars, const char* what, ColorTexture& result);
}

#endif
