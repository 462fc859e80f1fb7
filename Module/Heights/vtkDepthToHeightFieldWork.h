// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkDepthToHeightFieldWork_h
#define vtkDepthToHeightFieldWork_h

/// @file
/// What vtkDepthToHeightField does in the passes of the pipeline. Not installed.

#include "vtkDepthToHeightField.h"
#include "vtkReliefMeshTriangles.h"

#include "HeightFrame.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

class vtkImageData;
class vtkInformationVector;

/// All that runs returns an empty text, or what is wrong.
class vtkDepthToHeightField::Implementation
{
public:
  explicit Implementation(vtkDepthToHeightField* self)
    : Self(self)
  {
  }

  std::string Plan(vtkInformationVector* inputs);
  std::string RunMeshes(vtkInformationVector* inputs, vtkImageData* output);
  std::string RunRenderer(vtkImageData* output);
  void Drop() { this->Triangles = {}; }
  void Forget();

  relief::HeightFrame Frame; // of the output, in the view's frame
  relief::ViewAxes View;

private:
  using Key = std::vector<std::pair<const void*, vtkMTimeType>>;

  std::string Gather(vtkInformationVector* inputs);
  std::string Fit();
  bool HasFrame() const;
  void WarnOfLeftOut();
  std::string Sample(vtkImageData* output);
  std::string Finish(vtkImageData* output, double* heights, double base);
  void Measure(const double* heights, vtkIdType count, double range[2]) const;
  template <class T>
  void Convert(const double* heights, vtkIdType count, double base, const double range[2], T* to);
  void WarnOfDigits();
  void AddMask(vtkImageData* output);
  void AddAttributes(vtkImageData* output, const std::vector<std::uint32_t>& triangles);

  vtkDepthToHeightField* Self;
  relief::hosts::SceneTriangles Triangles;
  relief::HeightFrame Relative; // as Frame, from the triangles' center
  Key GatheredFrom;
};

#endif
