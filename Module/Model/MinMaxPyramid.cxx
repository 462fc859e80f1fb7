// SPDX-License-Identifier: BSD-3-Clause
#include "MinMaxPyramid.h"

#include "HeightView.h"
#include "ReliefModel.h"

#include <algorithm>
#include <cmath>

namespace relief
{

static_assert(MinMaxPyramid::BlockSize == 1 << f32::RELIEF_BLOCK_SHIFT);

namespace
{
constexpr float Infinity = std::numeric_limits<float>::infinity();
constexpr MinMaxPyramid::Bounds Mixed{ -Infinity, Infinity };

bool IsEmpty(const MinMaxPyramid::Bounds& b)
{
  return b.lo > b.hi;
}

bool IsMixed(const MinMaxPyramid::Bounds& b)
{
  return b.lo == -Infinity;
}
}

void MinMaxPyramid::Allocate(int columns, int rows)
{
  this->Levels.clear();
  int cellColumns = columns - 1;
  int cellRows = rows - 1;
  if (cellColumns < 1 || cellRows < 1)
  {
    return;
  }
  for (int size = BlockSize;; size *= 2)
  {
    Level level;
    level.columns = (cellColumns + size - 1) / size;
    level.rows = (cellRows + size - 1) / size;
    level.blocks.resize(static_cast<std::size_t>(level.columns) * level.rows);
    this->Levels.push_back(std::move(level));
    if (this->Levels.back().columns == 1 && this->Levels.back().rows == 1)
    {
      return;
    }
  }
}

void MinMaxPyramid::BuildBase(const HeightView<float>& heights, int begin, int end)
{
  Level& level = this->Levels[0];
  for (int bj = begin; bj < end; ++bj)
  {
    int j0 = bj * BlockSize;
    int j1 = std::min(j0 + BlockSize, heights.rows - 1);
    for (int bi = 0; bi < level.columns; ++bi)
    {
      int i0 = bi * BlockSize;
      int i1 = std::min(i0 + BlockSize, heights.columns - 1);
      Bounds bounds;
      int missing = 0;
      for (int j = j0; j <= j1; ++j)
      {
        for (int i = i0; i <= i1; ++i)
        {
          float height = heights.At(i, j);
          missing += std::isnan(height) ? 1 : 0;
          bounds.lo = height < bounds.lo ? height : bounds.lo;
          bounds.hi = height > bounds.hi ? height : bounds.hi;
        }
      }
      if (missing > 0)
      {
        // Rare: find out whether any cell is whole.
        bool anyCell = false;
        for (int j = j0; j < j1; ++j)
        {
          for (int i = i0; i < i1; ++i)
          {
            anyCell = anyCell ||
              !std::isnan(heights.At(i, j) + heights.At(i + 1, j) + heights.At(i, j + 1) +
                heights.At(i + 1, j + 1));
          }
        }
        bounds = anyCell ? Mixed : Bounds();
      }
      level.blocks[static_cast<std::size_t>(bj) * level.columns + bi] = bounds;
    }
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
      for (int i = 0; i < level.columns; ++i)
      {
        Bounds bounds;
        int empty = 0;
        int children = 0;
        bool mixed = false;
        for (int cj = 2 * j; cj < std::min(2 * j + 2, below.rows); ++cj)
        {
          for (int ci = 2 * i; ci < std::min(2 * i + 2, below.columns); ++ci)
          {
            const Bounds& child = below.blocks[static_cast<std::size_t>(cj) * below.columns + ci];
            ++children;
            empty += IsEmpty(child) ? 1 : 0;
            mixed = mixed || IsMixed(child);
            bounds.lo = std::min(bounds.lo, child.lo);
            bounds.hi = std::max(bounds.hi, child.hi);
          }
        }
        if (mixed || (empty > 0 && empty < children))
        {
          bounds = Mixed;
        }
        level.blocks[static_cast<std::size_t>(j) * level.columns + i] = bounds;
      }
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
