// SPDX-License-Identifier: BSD-3-Clause
#include "MinMaxPyramid.h"

#include "HeightRows.h"
#include "HeightView.h"
#include "ReliefModel.h"

#include <algorithm>

namespace relief
{

static_assert(MinMaxPyramid::BlockShift == f32::RELIEF_BLOCK_SHIFT);

template <class MakeRoom>
bool MinMaxPyramid::List(int columns, int rows, MakeRoom&& makeRoom)
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
    if (!makeRoom(static_cast<int>(levels) - 1, level.blocks,
          static_cast<std::size_t>(level.columns) * level.rows))
    {
      return false;
    }
    if (level.columns == 1 && level.rows == 1)
    {
      break;
    }
  }
  this->Levels.resize(levels);
  return true;
}

void MinMaxPyramid::Allocate(int columns, int rows)
{
  this->List(columns, rows,
    [](int, RawArray<Bounds>& blocks, std::size_t count)
    {
      blocks.Allocate(count);
      return true;
    });
}

bool MinMaxPyramid::Reserve(int columns, int rows)
{
  return this->List(columns, rows,
    [](int level, RawArray<Bounds>& blocks, std::size_t count)
    {
      if (level < RegionLevel)
      {
        return blocks.Reserve(count);
      }
      blocks.Allocate(count);
      return true;
    });
}

void MinMaxPyramid::BuildRegions(const HeightView<float>& heights, int begin, int end, int row)
{
  const int i0 = begin * RegionSize;
  const int columns = std::min((end - begin) * RegionSize + 1, this->Columns - i0);
  if (this->Levels.empty() || columns < 2)
  {
    return;
  }
  constexpr int blocks = RegionSize / BlockSize; // along a side of a region
  Level& base = this->Levels[0];
  for (int j = row * blocks; j < std::min((row + 1) * blocks, base.rows); ++j)
  {
    const float* samples[BlockSize + 1];
    int count = 0;
    for (int k = j * BlockSize; k <= std::min((j + 1) * BlockSize, heights.rows - 1); ++k)
    {
      samples[count++] = heights.data + k * heights.stepY + i0;
    }
    BoundBlocks(samples, count, columns,
      base.blocks.data() + static_cast<std::size_t>(j) * base.columns + begin * blocks);
  }
  const int levels = std::min(this->GetNumberOfLevels(), RegionLevel);
  for (int l = 1; l < levels; ++l)
  {
    const Level& below = this->Levels[l - 1];
    Level& level = this->Levels[l];
    const int side = blocks >> l;
    const int first = begin * 2 * side;
    const int width = std::min((end - begin) * 2 * side, below.columns - first);
    for (int j = row * side; j < std::min((row + 1) * side, level.rows); ++j)
    {
      auto rowBelow = [&](int k)
      { return below.blocks.data() + static_cast<std::size_t>(k) * below.columns + first; };
      BoundParents(rowBelow(2 * j), rowBelow(std::min(2 * j + 1, below.rows - 1)), width,
        level.blocks.data() + static_cast<std::size_t>(j) * level.columns + begin * side);
    }
  }
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

void MinMaxPyramid::BuildUpper(int below)
{
  for (std::size_t l = static_cast<std::size_t>(below) + 1; l < this->Levels.size(); ++l)
  {
    const Level& lower = this->Levels[l - 1];
    Level& level = this->Levels[l];
    for (int j = 0; j < level.rows; ++j)
    {
      auto rowBelow = [&](int k)
      { return lower.blocks.data() + static_cast<std::size_t>(k) * lower.columns; };
      BoundParents(rowBelow(2 * j), rowBelow(std::min(2 * j + 1, lower.rows - 1)), lower.columns,
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
