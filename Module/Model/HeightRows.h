// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightRows_h
#define HeightRows_h

#include "MinMaxPyramid.h"

#include <cstddef>

namespace relief
{

/// @file
/// Whole rows of heights in the lanes of vectors, compiled for several instruction sets and chosen
/// at run time.

/// Heights as lengths: values times a scale less a datum, in double; NaN where a value is not
/// finite or, where that is given, equals `noData`.
void ReadHeights(
  const float* values, int count, double scale, double datum, const float* noData, float* heights);

/// Lowers `lo` and raises `hi` to the least and the greatest height of a row; those that are NaN do
/// not count.
void AddToRange(const float* heights, int count, float& lo, float& hi);

/// Bounds of a row of blocks, by the rules of MinMaxPyramid: the blocks' cells lie between the
/// `count` rows, from 2 to BlockSize + 1, of so many columns, at least 2.
void BoundBlocks(const float* const* rows, int count, int columns, MinMaxPyramid::Bounds* blocks);

/// Bounds of a row of windows, by the rules of HeightWindows: the windows' samples are in the
/// `count` rows, from 2 to HeightWindows::Size + 1, of so many columns, at least 2.
void BoundWindows(const float* const* rows, int count, int columns, float* lowest, float* highest);

/// Bounds of a row of blocks from those of the next lower level: one or two rows of so many blocks.
void BoundParents(const MinMaxPyramid::Bounds* first, const MinMaxPyramid::Bounds* second,
  int columns, MinMaxPyramid::Bounds* parents);

/// Raises values to those of others, which may be the same row further on; none is NaN.
void RaiseTo(const float* others, std::size_t count, float* values);

}

#endif
