// SPDX-License-Identifier: BSD-3-Clause
#ifndef WebHeights_h
#define WebHeights_h

/// @file
/// Heights as JavaScript has them: a typed array whose first row is the northern one.

#include "ColorTexture.h"
#include "HeightField.h"

#include <string>

namespace relief::web
{

/// The types of JavaScript's arrays, as index.js numbers them.
enum class ArrayType
{
  Int8,
  Uint8,
  Int16,
  Uint16,
  Int32,
  Uint32,
  Float32,
  Float64
};

/// Arrays belong to the caller.
struct WebHeights
{
  const void* samples = nullptr;
  ArrayType type = ArrayType::Float32;
  int columns = 0;
  int rows = 0;
  double spacing[2] = { 1.0, 1.0 };
  bool hasNoData = false;
  double noData = 0.0;
  const unsigned char* mask = nullptr; ///< 0 where there are no data; may be null
};

/// The model's way to loop, here on one thread.
void ForRows(int count, const std::function<void(int, int)>& body);

/// As HeightField::Assign() has it.
std::string Assign(const WebHeights& heights, double scale, bool padded, HeightField& field);

/// As relief::FitHeightScale() has it.
double FitScale(const WebHeights& heights);

/// A picture as a texture over heights of so many samples, from edge to edge.
void StretchOver(const WebHeights& heights, ColorTexture& picture);

}

#endif
