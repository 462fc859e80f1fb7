// SPDX-License-Identifier: BSD-3-Clause
#include "SlidingBounds.h"

#include "HeightRows.h"

#include <algorithm>
#include <vector>

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

// What is known of a row of blocks, each number such that the greatest is looked for.
void ReadBlocks(
  const MinMaxPyramid& pyramid, int level, int begin, int end, int row, float* greatest)
{
  for (int column = begin; column < end; ++column, greatest += 3)
  {
    const MinMaxPyramid::Bounds& found = pyramid.At(level, column, row);
    const MinMaxPyramid::Bounds block = found.lo > found.hi ? MinMaxPyramid::GetMixed() : found;
    greatest[0] = -block.lo;
    greatest[1] = block.hi;
    greatest[2] = block.twist;
  }
}

// Widens a row of blocks to squares.
void SlideAlong(int blocks, std::size_t pitch, float* row)
{
  SlideOver(blocks,
    [&](int by)
    {
      const std::size_t apart = 3 * static_cast<std::size_t>(by);
      RaiseTo(row + apart, pitch - std::min(apart, pitch), row);
    });
}
}

// Returns the level of the blocks.
int SlidingBounds::SetSize(const MinMaxPyramid& pyramid, int level, int blocks)
{
  level = std::min(level, pyramid.GetNumberOfLevels() - 1);
  const bool any = level >= 0 && blocks > 0;
  this->Shift = MinMaxPyramid::BlockShift + level;
  this->Columns = any ? pyramid.GetColumns(level) : 0;
  this->Rows = any ? pyramid.GetRows(level) : 0;
  this->Blocks = blocks;
  return level;
}

bool SlidingBounds::Reserve(const MinMaxPyramid& pyramid, int level, int blocks)
{
  this->SetSize(pyramid, level, blocks);
  return this->Greatest.Reserve(this->GetPitch() * this->Rows);
}

void SlidingBounds::BuildRegions(const MinMaxPyramid& pyramid, int begin, int end, int row)
{
  const int level = this->Shift - MinMaxPyramid::BlockShift;
  const int side = MinMaxPyramid::RegionSize >> this->Shift;
  const int column0 = begin * side;
  const int row0 = row * side;
  const int columns = std::min(end * side, this->Columns) - column0;
  const int rows = std::min((row + 1) * side, this->Rows) - row0;
  if (columns <= 0 || rows <= 0)
  {
    return;
  }
  // With the blocks of the regions behind that the squares reach over.
  const int lastColumn = std::min(column0 + columns + this->Blocks - 1, this->Columns);
  const int lastRow = std::min(row0 + rows + this->Blocks - 1, this->Rows);
  const std::size_t pitch = 3 * static_cast<std::size_t>(lastColumn - column0);
  std::vector<float> greatest(pitch * (lastRow - row0));
  auto rowAt = [&](int k) { return greatest.data() + pitch * (k - row0); };
  for (int k = row0; k < lastRow; ++k)
  {
    ReadBlocks(pyramid, level, column0, lastColumn, k, rowAt(k));
    SlideAlong(this->Blocks, pitch, rowAt(k));
  }
  SlideOver(this->Blocks,
    [&](int by)
    {
      for (int k = row0; k + by < lastRow; ++k)
      {
        RaiseTo(rowAt(k + by), pitch, rowAt(k));
      }
    });
  for (int k = row0; k < row0 + rows; ++k)
  {
    std::copy_n(rowAt(k), 3 * static_cast<std::size_t>(columns),
      this->Greatest.data() + this->GetPitch() * k + 3 * static_cast<std::size_t>(column0));
  }
}

void SlidingBounds::Build(
  const MinMaxPyramid& pyramid, int level, int blocks, const ParallelFor& parallelFor)
{
  level = this->SetSize(pyramid, level, blocks);
  const int columns = this->Columns;
  const int rows = this->Rows;
  const std::size_t pitch = this->GetPitch();
  this->Greatest.Allocate(pitch * rows);
  // Along the rows, each by itself.
  parallelFor(rows,
    [&](int begin, int end)
    {
      for (int row = begin; row < end; ++row)
      {
        float* own = this->Greatest.data() + pitch * row;
        ReadBlocks(pyramid, level, 0, columns, row, own);
        SlideAlong(blocks, pitch, own);
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
