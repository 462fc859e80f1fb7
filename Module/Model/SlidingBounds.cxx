// SPDX-License-Identifier: BSD-3-Clause
#include "SlidingBounds.h"

#include "HeightRows.h"

#include <algorithm>

namespace relief
{

namespace
{
// Calls widen(by) so that each number becomes the greatest of `blocks` from it on, if it becomes
// that of itself and the one `by` blocks on: of two at first, of these two by two, and so on.
template <class Widen>
void SlideOver(int blocks, const Widen& widen)
{
  int covered = 1;
  for (; 2 * covered <= blocks; covered *= 2)
  {
    widen(covered);
  }
  if (covered < blocks)
  {
    widen(blocks - covered);
  }
}
}

void SlidingBounds::Build(
  const MinMaxPyramid& pyramid, int level, int blocks, const ParallelFor& parallelFor)
{
  level = std::min(level, pyramid.GetNumberOfLevels() - 1);
  const bool any = level >= 0 && blocks > 0;
  const int columns = any ? pyramid.GetColumns(level) : 0;
  const int rows = any ? pyramid.GetRows(level) : 0;
  const std::size_t pitch = 3 * static_cast<std::size_t>(columns);
  this->Shift = MinMaxPyramid::BlockShift + level;
  this->Columns = columns;
  this->Greatest.Allocate(pitch * rows);
  // Along the rows, each by itself.
  parallelFor(rows,
    [&](int begin, int end)
    {
      for (int row = begin; row < end; ++row)
      {
        float* own = this->Greatest.data() + pitch * row;
        for (int column = 0; column < columns; ++column)
        {
          const MinMaxPyramid::Bounds& found = pyramid.At(level, column, row);
          const MinMaxPyramid::Bounds block =
            found.lo > found.hi ? MinMaxPyramid::GetMixed() : found;
          own[3 * column] = -block.lo;
          own[3 * column + 1] = block.hi;
          own[3 * column + 2] = block.twist;
        }
        SlideOver(blocks,
          [&](int by)
          {
            const std::size_t apart = 3 * static_cast<std::size_t>(by);
            RaiseTo(own + apart, pitch - std::min(apart, pitch), own);
          });
      }
    });
  // Across them, some columns at a time.
  parallelFor(columns,
    [&](int begin, int end)
    {
      SlideOver(blocks,
        [&](int by)
        {
          for (int row = 0; row + by < rows; ++row)
          {
            float* own = this->Greatest.data() + pitch * row + 3 * begin;
            RaiseTo(own + pitch * by, 3 * static_cast<std::size_t>(end - begin), own);
          }
        });
    });
}

}
