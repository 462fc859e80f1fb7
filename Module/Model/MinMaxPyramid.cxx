// SPDX-License-Identifier: BSD-3-Clause
#include "MinMaxPyramid.h"

#include "HeightView.h"
#include "ReliefModel.h"

#include <algorithm>
#include <cmath>

namespace relief
{

static_assert(MinMaxPyramid::BlockShift == f32::RELIEF_BLOCK_SHIFT);

namespace
{
constexpr float Infinity = std::numeric_limits<float>::infinity();

bool IsEmpty(const MinMaxPyramid::Bounds& b)
{
  return b.lo > b.hi;
}

bool IsMixed(const MinMaxPyramid::Bounds& b)
{
  return b.lo == -Infinity;
}

void AddRow(int columns, const float* __restrict row, const float* __restrict below,
  std::ptrdiff_t step, float* __restrict lo, float* __restrict hi, float* __restrict sum,
  float* __restrict twist)
{
  if (step != 1)
  {
    for (int i = 0; i < columns; ++i)
    {
      float height = row[i * step];
      sum[i] += height;
      lo[i] = height < lo[i] ? height : lo[i];
      hi[i] = height > hi[i] ? height : hi[i];
    }
    for (int i = 0; i + 1 < columns; ++i)
    {
      float t =
        std::abs((row[(i + 1) * step] - row[i * step]) - (below[(i + 1) * step] - below[i * step]));
      twist[i] = t > twist[i] ? t : twist[i];
    }
    return;
  }
  for (int i = 0; i < columns; ++i)
  {
    sum[i] += row[i];
    lo[i] = row[i] < lo[i] ? row[i] : lo[i];
    hi[i] = row[i] > hi[i] ? row[i] : hi[i];
  }
  for (int i = 0; i + 1 < columns; ++i)
  {
    float t = std::abs((row[i + 1] - row[i]) - (below[i + 1] - below[i]));
    twist[i] = t > twist[i] ? t : twist[i];
  }
}

// Bounds of a block in which a sample seems to have no data. Where only the sum of huge heights was
// not a number, those found hold.
MinMaxPyramid::Bounds HoleBounds(const HeightView<float>& heights, int i0, int i1, int j0, int j1,
  const MinMaxPyramid::Bounds& found)
{
  bool anyHole = false;
  bool anyCell = false;
  for (int j = j0; j < j1; ++j)
  {
    for (int i = i0; i < i1; ++i)
    {
      bool hole = std::isnan(heights.At(i, j)) || std::isnan(heights.At(i + 1, j)) ||
        std::isnan(heights.At(i, j + 1)) || std::isnan(heights.At(i + 1, j + 1));
      anyHole = anyHole || hole;
      anyCell = anyCell || !hole;
    }
  }
  return !anyHole ? found : anyCell ? MinMaxPyramid::GetMixed() : MinMaxPyramid::Bounds();
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
  if (begin >= end)
  {
    return; // a field without cells has no levels
  }
  // Down the columns first, whole rows at a time, which the compiler makes vectors of; then along.
  const int columns = heights.columns;
  const std::ptrdiff_t step = heights.stepX;
  std::vector<float> lo(columns);
  std::vector<float> hi(columns);
  std::vector<float> sum(columns); // NaN where any is
  std::vector<float> twist(columns);
  Level& level = this->Levels[0];
  for (int bj = begin; bj < end; ++bj)
  {
    const int j0 = bj * BlockSize;
    const int j1 = std::min(j0 + BlockSize, heights.rows - 1);
    const float* row = heights.data + j0 * heights.stepY;
    for (int i = 0; i < columns; ++i)
    {
      lo[i] = hi[i] = sum[i] = row[i * step];
      twist[i] = 0.0f;
    }
    for (int j = j0 + 1; j <= j1; ++j)
    {
      const float* below = heights.data + (j - 1) * heights.stepY;
      row = heights.data + j * heights.stepY;
      AddRow(columns, row, below, step, lo.data(), hi.data(), sum.data(), twist.data());
    }
    for (int bi = 0; bi < level.columns; ++bi)
    {
      const int i0 = bi * BlockSize;
      const int i1 = std::min(i0 + BlockSize, columns - 1);
      Bounds bounds;
      float all = 0.0f;
      for (int i = i0; i <= i1; ++i)
      {
        all += sum[i];
        bounds.lo = std::min(bounds.lo, lo[i]);
        bounds.hi = std::max(bounds.hi, hi[i]);
        bounds.twist = i < i1 ? std::max(bounds.twist, twist[i]) : bounds.twist;
      }
      if (std::isnan(all))
      {
        bounds = HoleBounds(heights, i0, i1, j0, j1, bounds);
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
            bounds.twist = std::max(bounds.twist, child.twist);
          }
        }
        if (mixed || (empty > 0 && empty < children))
        {
          bounds = GetMixed();
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
