// SPDX-License-Identifier: BSD-3-Clause
#ifndef WebNormals_h
#define WebNormals_h

#include "NormalHeights.h"

#include <string>
#include <vector>

namespace relief::web
{

/// Types of a picture's numbers, as module.js numbers them.
enum class NormalType
{
  Uint8,
  Uint16,
  Float32,
  Float64
};

/// A picture of normals, its first row the northern one.
struct WebNormals
{
  const void* samples = nullptr;
  NormalType type = NormalType::Uint8;
  int columns = 0;
  int rows = 0;
  int components = 3;
  double spacing[2] = { 1.0, 1.0 };
  const unsigned char* mask = nullptr; ///< 0 where there are no data; may be null
  NormalEncoding encoding = NormalEncoding::Automatic;
};

/// Finds the heights, in the unit of the spacing, their first row the southern one, by the same
/// steps as vtkNormalMapToHeightField with an orthographic view. Returns an empty text, or what is
/// wrong.
std::string FindHeights(const WebNormals& normals, NormalRequest request, NormalHeights& result,
  NormalEncoding& encoding);

}

#endif
