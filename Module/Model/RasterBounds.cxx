// SPDX-License-Identifier: BSD-3-Clause
#include "RasterBounds.h"

#include "HeightRows.h"
#include "HeightView.h"

#include <algorithm>
#include <cmath>

namespace relief
{

void RasterBounds::SetSize(int columns, int rows)
{
  this->Columns = columns;
  this->Rows = rows;
  this->Added = rows;
  const std::size_t regions =
    static_cast<std::size_t>(this->GetRegionColumns()) * this->GetRegionRows();
  this->Ranges.assign(regions, Range());
  this->Bounds.assign(regions, MinMaxPyramid::Bounds());
  this->Assumed.clear();
}

void RasterBounds::Assume(int columns, int rows, const Range& whole)
{
  this->SetSize(columns, rows);
  std::fill(this->Ranges.begin(), this->Ranges.end(), whole);
  std::fill(this->Bounds.begin(), this->Bounds.end(),
    MinMaxPyramid::Bounds{ whole.lo, whole.hi, std::numeric_limits<float>::infinity() });
  this->Assumed.assign(this->Ranges.size(), 1);
}

void RasterBounds::AssumeHoles()
{
  for (std::size_t at = 0; at < this->Assumed.size(); ++at)
  {
    this->Bounds[at] = this->Assumed[at] ? MinMaxPyramid::GetMixed() : this->Bounds[at];
  }
}

void RasterBounds::Learn(int i, int j, const Range& range, const MinMaxPyramid::Bounds& bounds)
{
  const std::size_t at = this->At(i, j);
  this->Ranges[at] = range;
  this->Bounds[at] = bounds;
  this->Assumed[at] = 0;
}

void RasterBounds::Begin(int columns, int rows)
{
  this->SetSize(columns, rows);
  this->Added = 0;
  this->WithData = 0;
  this->InBand = 0;
  this->Band.resize(
    static_cast<std::size_t>(columns) * std::min(RegionSize + 1, std::max(rows, 0)));
}

void RasterBounds::AddRows(const float* heights, std::ptrdiff_t pitch, int count)
{
  count = std::min(count, this->Rows - this->Added);
  for (int k = 0; k < count; ++k)
  {
    const float* row = heights + k * pitch;
    this->AddToRanges(row, this->Added);
    std::copy_n(row, this->Columns,
      this->Band.data() + static_cast<std::size_t>(this->InBand) * this->Columns);
    ++this->InBand;
    ++this->Added;
    if (this->InBand == RegionSize + 1 || this->Added == this->Rows)
    {
      this->CloseBand();
    }
  }
  if (this->IsComplete())
  {
    this->Band.clear();
    this->Band.shrink_to_fit();
  }
}

void RasterBounds::AddToRanges(const float* row, int j)
{
  for (int region = 0; region < this->GetRegionColumns(); ++region)
  {
    const int i0 = region * RegionSize;
    const int size = std::min(RegionSize, this->Columns - i0);
    Range& range = this->Ranges[this->At(region, j / RegionSize)];
    AddToRange(row + i0, size, range.lo, range.hi);
    const auto missing =
      std::count_if(row + i0, row + i0 + size, [](float height) { return std::isnan(height); });
    this->WithData += static_cast<std::uint64_t>(size - missing);
  }
}

bool RasterBounds::Agree(
  int i, int j, int count, const float* heights, std::ptrdiff_t pitch, float rounding) const
{
  const auto same = [rounding](float one, float other)
  { return one == other || std::abs(one - other) <= rounding; };
  const int rows = std::min(RegionSize, this->Rows - j * RegionSize);
  for (int region = i; region < i + count; ++region, heights += RegionSize)
  {
    Range found;
    for (int k = 0; k < rows; ++k)
    {
      const int size = std::min(RegionSize, this->Columns - region * RegionSize);
      AddToRange(heights + k * pitch, size, found.lo, found.hi);
    }
    const Range& known = this->RangeAt(region, j);
    if (!same(found.lo, known.lo) || !same(found.hi, known.hi))
    {
      return false;
    }
  }
  return true;
}

// Bounds of the cells of a row of regions, once the row of samples that closes it is there.
void RasterBounds::CloseBand()
{
  const int last = this->InBand - 1;
  const int row = (this->Added - 1 - last) / RegionSize;
  // The regions as a field of their own.
  MinMaxPyramid pyramid;
  pyramid.Allocate(this->Columns, this->InBand);
  if (this->InBand > 1 && pyramid.GetNumberOfLevels() > 0)
  {
    HeightView<float> view;
    view.data = this->Band.data();
    view.stepY = this->Columns;
    view.columns = this->Columns;
    view.rows = this->InBand;
    pyramid.BuildBase(view, 0, pyramid.GetNumberOfBaseRows());
    pyramid.BuildUpper();
    // In a narrow one the last block is all.
    const int level = std::min(MinMaxPyramid::RegionLevel, pyramid.GetNumberOfLevels() - 1);
    for (int i = 0; i < pyramid.GetColumns(level); ++i)
    {
      this->Bounds[this->At(i, row)] = pyramid.At(level, i, 0);
    }
  }
  const float* closing = this->Band.data() + static_cast<std::size_t>(last) * this->Columns;
  std::copy_n(closing, last > 0 ? this->Columns : 0, this->Band.data());
  this->InBand = 1;
}

RasterBounds::Range RasterBounds::Whole() const
{
  Range whole;
  for (const Range& range : this->Ranges)
  {
    whole.lo = std::min(whole.lo, range.lo);
    whole.hi = std::max(whole.hi, range.hi);
  }
  return whole;
}

void RasterBounds::FillPyramid(MinMaxPyramid& pyramid) const
{
  const int first = MinMaxPyramid::RegionLevel;
  if (pyramid.GetNumberOfLevels() <= first)
  {
    return;
  }
  for (int j = 0; j < pyramid.GetRows(first); ++j)
  {
    std::copy_n(this->Bounds.begin() + this->At(0, j), pyramid.GetColumns(first),
      pyramid.GetBlocks(first).data() + static_cast<std::size_t>(j) * pyramid.GetColumns(first));
  }
  pyramid.BuildUpper(first);
}

}
