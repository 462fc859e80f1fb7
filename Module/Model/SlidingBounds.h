// SPDX-License-Identifier: BSD-3-Clause
#ifndef SlidingBounds_h
#define SlidingBounds_h

#include "MinMaxPyramid.h"
#include "ParallelFor.h"
#include "RawArray.h"

#include <cstddef>

namespace relief
{

/// Bounds over squares of a pyramid's blocks, one from each block on: what MinMaxPyramid::Over()
/// finds for all that lies within, by a single look-up.
class SlidingBounds
{
public:
  /// Finds the bounds over `blocks` x `blocks` blocks of a level, or of the last one if there are
  /// fewer, at which a single block is the whole field. With 0 blocks there are none.
  void Build(const MinMaxPyramid& pyramid, int level, int blocks, const ParallelFor& parallelFor);

  /// Makes such room for them that takes memory only where it is filled. Returns whether the system
  /// has any.
  bool Reserve(const MinMaxPyramid& pyramid, int level, int blocks);

  /// Finds the bounds of the squares that begin in the regions [begin, end) of a row of regions, as
  /// many blocks wide as Reserve() was told. Distinct regions may be filled at once.
  void BuildRegions(const MinMaxPyramid& pyramid, int begin, int end, int row);

  RawArray<float>& GetGreatest() { return this->Greatest; } ///< GetPitch() a row of squares
  std::size_t GetPitch() const { return 3 * static_cast<std::size_t>(this->Columns); }
  int GetNumberOfRows() const { return this->Rows; }
  int GetShift() const { return this->Shift; } ///< a square's first block has 1 << this many cells

  /// How many cells from any cell on are within the square that From() tells of.
  static constexpr int Reach(int level, int blocks)
  {
    return ((blocks - 1) << (MinMaxPyramid::BlockShift + level)) + 1;
  }

  /// The bounds over the square whose first block holds the cell (i, j).
  MinMaxPyramid::Bounds From(int i, int j) const
  {
    const float* greatest = this->Greatest.data() +
      3 * (static_cast<std::size_t>(j >> this->Shift) * this->Columns + (i >> this->Shift));
    return { -greatest[0], greatest[1], greatest[2] };
  }

private:
  int SetSize(const MinMaxPyramid& pyramid, int level, int blocks);

  int Shift = 0;
  int Columns = 0;
  int Rows = 0;
  int Blocks = 0; // along a side of a square
  // Three numbers a square, the lowest height negated: of each the greatest is looked for.
  RawArray<float> Greatest;
};

}

#endif
