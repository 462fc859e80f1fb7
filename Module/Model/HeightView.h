// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightView_h
#define HeightView_h

#include "MinMaxPyramid.h"

#include <algorithm>
#include <cstddef>

namespace relief
{

/// Heights that somebody else owns: sample (i, j) stands at (i * spacingX, j * spacingY); NaN marks
/// a sample without data. Heights and spacing share one unit of length.
template <class T>
struct HeightView
{
  const T* data = nullptr;
  std::ptrdiff_t stepX = 1; ///< elements from a sample to the next along x
  std::ptrdiff_t stepY = 0; ///< elements from a row to the next
  int columns = 0;
  int rows = 0;
  double spacingX = 1.0; ///< above 0
  double spacingY = 1.0; ///< above 0

  T At(int i, int j) const { return this->data[i * this->stepX + j * this->stepY]; }
};

/// The height field that the model's functions read: the samples, the height that none exceeds, and
/// bounds to skip by. Without bounds every cell of a ray is visited.
template <class T>
struct Field
{
  HeightView<T> heights;
  T top = T(0);
  const MinMaxPyramid* bounds = nullptr;
};

template <class T>
int reliefColumns(const Field<T>& field)
{
  return field.heights.columns;
}

template <class T>
int reliefRows(const Field<T>& field)
{
  return field.heights.rows;
}

template <class T>
T reliefSpacingX(const Field<T>& field)
{
  return static_cast<T>(field.heights.spacingX);
}

template <class T>
T reliefSpacingY(const Field<T>& field)
{
  return static_cast<T>(field.heights.spacingY);
}

template <class T>
T reliefHeight(const Field<T>& field, int i, int j)
{
  return field.heights.At(i, j);
}

template <class T>
T reliefTop(const Field<T>& field)
{
  return field.top;
}

// Blocks larger than these tell of places far away: rays would differ, by rounding, where only a
// part of a raster is at hand.
template <class T>
int reliefLevels(const Field<T>& field)
{
  return field.bounds ? std::min(field.bounds->GetNumberOfLevels(), MinMaxPyramid::RegionLevel) : 0;
}

template <class T, class R>
void reliefBounds(const Field<T>& field, int level, int i, int j, R& lo, R& hi)
{
  const MinMaxPyramid::Bounds& bounds = field.bounds->At(level, i, j);
  lo = bounds.lo;
  hi = bounds.hi;
}

}

#endif
