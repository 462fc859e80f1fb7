// SPDX-License-Identifier: BSD-3-Clause
#include "MinMaxPyramid.h"

#include "HeightRows.h"
#include "HeightView.h"
#include "ReliefModel.h"

#include <algorithm>

namespace relief
{

static_assert(MinMaxPyramid::BlockShift == f32::RELIEF_BLOCK_SHIFT);

void MinMaxPyramid::Allocate(int columns, int rows)
{
  this->Columns = columns;
  const int cellColumns = columns - 1;
  const int cellRows = rows - 1;
  std::size_t levels = 0;
  for (int size = BlockSize; cellColumns > 0 && cellRows > 0; size *= 2)
  {
    this->Levels.resize(std::max(this->Levels.size(), ++levels));
    Level& level = this->Levels[levels - 1];
    level.columns = (cellColumns + size - 1) / size;
    level.rows = (cellRows + size - 1) / size;
    level.blocks.Allocate(static_cast<std::size_t>(level.columns) * level.rows);
    if (level.columns == 1 && level.rows == 1)
    {
      break;
    }
  }
  this->Levels.resize(levels);
}

void MinMaxPyramid::BuildBase(const HeightView<float>& heights, int begin, int end)
{
  // Samples that do not stand side by side are copied.
  const bool copies = heights.stepX != 1;
  std::vector<float> copy(copies ? std::size_t{ BlockSize + 1 } * heights.columns : 0);
  for (int row = begin; row < end; ++row)
  {
    const float* samples[BlockSize + 1];
    int count = 0;
    for (int j = row * BlockSize; j <= std::min((row + 1) * BlockSize, heights.rows - 1); ++j)
    {
      samples[count] = heights.data + j * heights.stepY;
      if (copies)
      {
        float* line = copy.data() + static_cast<std::size_t>(count) * heights.columns;
        for (int i = 0; i < heights.columns; ++i)
        {
          line[i] = heights.At(i, j);
        }
        samples[count] = line;
      }
      ++count;
    }
    this->BuildBaseRow(row, samples, count);
  }
}

void MinMaxPyramid::BuildBaseRow(int row, const float* const* samples, int count)
{
  if (!this->Levels.empty())
  {
    Level& level = this->Levels[0];
    BoundBlocks(samples, count, this->Columns,
      level.blocks.data() + static_cast<std::size_t>(row) * level.columns);
  }
}

void MinMaxPyramid::BuildUpper()
{
  for (std::size_t l = 1; l < this->Levels.size(); ++l)
  {
    const Level& below = this->Levels[l - 1];
    Level& level = this->Levels[l];
    for (int j = 0; j < level.rows; ++j)
    {
      auto rowBelow = [&](int k)
      { return below.blocks.data() + static_cast<std::size_t>(k) * below.columns; };
      BoundParents(rowBelow(2 * j), rowBelow(std::min(2 * j + 1, below.rows - 1)), below.columns,
        level.blocks.data() + static_cast<std::size_t>(j) * level.columns);
    }
  }
}

std::size_t MinMaxPyramid::GetMemorySize() const
{
  std::size_t size = 0;
  for (const Level& level : this->Levels)
  {
    size += level.blocks.size() * sizeof(Bounds);
  }
  return size;
}

}
