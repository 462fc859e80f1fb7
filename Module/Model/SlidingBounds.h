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
  int Shift = 0;
  int Columns = 0;
  // Three numbers a square, the lowest height negated: of each the greatest is looked for.
  RawArray<float> Greatest;
};

}

#endif
