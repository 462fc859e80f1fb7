// SPDX-License-Identifier: BSD-3-Clause
#include "SparseHeights.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace relief
{

namespace
{
constexpr int RegionSize = RasterBounds::RegionSize;

// Calls body(run) for each of some intervals, in parallel.
template <class Body>
void ForIntervals(const RegionSet& regions, const ParallelFor& parallelFor, Body&& body)
{
  const std::vector<RegionSet::Interval> runs = regions.GetIntervals();
  parallelFor(static_cast<int>(runs.size()),
    [&](int begin, int end)
    {
      for (int k = begin; k < end; ++k)
      {
        body(runs[k]);
      }
    });
}
}

std::string SparseHeights::Reserve(
  const RasterBounds& bounds, double spacingX, double spacingY, double datum, bool padded)
{
  if (!CanReserveMemory())
  {
    return "shading tile by tile is not supported on this system, which cannot reserve memory";
  }
  const std::string wrong = HeightField::CheckRange(bounds.GetBottom(), bounds.GetTop());
  if (!wrong.empty())
  {
    return wrong;
  }
  const int columns = bounds.GetColumns();
  const int rows = bounds.GetRows();
  this->Bounds = &bounds;
  this->Filled = RegionSet(bounds.GetRegionColumns(), bounds.GetRegionRows());
  this->Level = this->Filled;
  this->Fresh = this->Filled;
  if (!this->ReserveRoom(columns, rows, padded))
  {
    return "the system reserves no addresses for " + std::to_string(columns) + " x " +
      std::to_string(rows) + " samples";
  }
  HeightField& field = this->Heights;
  const std::size_t pitch = static_cast<std::size_t>(columns) + 2 * this->Margin;
  float* first = field.Copy.data() + this->Margin;
  HeightView<float>& view = field.Prepared.heights;
  view = { first, 1, static_cast<std::ptrdiff_t>(pitch), columns, rows, spacingX, spacingY };
  field.MissingRow = nullptr;
  if (padded)
  {
    float* missing = first + pitch * rows;
    std::fill_n(missing - this->Margin, pitch, std::numeric_limits<float>::quiet_NaN());
    field.MissingRow = missing;
  }
  bounds.FillPyramid(field.Pyramid);
  field.Datum = datum;
  field.Bottom = bounds.GetBottom();
  field.Top = bounds.GetTop();
  field.Prepared.top = field.Top;
  field.Prepared.bounds = &field.Pyramid;
  field.Version = HeightField::NextVersion();
  this->ListLayers();
  return std::string();
}

bool SparseHeights::ReserveRoom(int columns, int rows, bool padded)
{
  HeightField& field = this->Heights;
  this->Margin = padded ? HeightField::Padding : 0;
  const std::size_t pitch = static_cast<std::size_t>(columns) + 2 * this->Margin;
  // The row of no data behind the last one, and what vectors read behind that.
  const std::size_t count = pitch * (static_cast<std::size_t>(rows) + (padded ? 1 : 0)) +
    2 * static_cast<std::size_t>(HeightField::Padding);
  bool reserved = field.Copy.Reserve(count) && field.Pyramid.Reserve(columns, rows) &&
    field.Windows.Reserve(padded ? columns : 0, padded ? rows : 0, 2 * HeightField::Padding);
  for (int size = 0; size < HeightField::NumberOfSquares; ++size)
  {
    reserved = reserved &&
      field.Squares[size].Reserve(
        field.Pyramid, size, padded ? HeightField::GetNumberOfBlocks(size) : 0);
  }
  return reserved;
}

void SparseHeights::ListLayers()
{
  this->Layers.clear();
  auto add = [&](auto& numbers, std::size_t pitch, std::size_t width, int height, int rows,
               std::size_t before)
  {
    if (!numbers.empty())
    {
      this->Layers.push_back({ pitch, width, height, rows, before,
        [&numbers](std::size_t begin, std::size_t end) { numbers.Forget(begin, end); },
        [&numbers](std::size_t begin, std::size_t end) { numbers.Enlarge(begin, end); },
        [&numbers]() { return numbers.CountResident(); } });
    }
  };
  HeightField& field = this->Heights;
  const HeightView<float>& view = field.Prepared.heights;
  add(field.Copy, view.stepY, RegionSize, RegionSize, view.rows, this->Margin);
  const int levels = std::min(field.Pyramid.GetNumberOfLevels(), MinMaxPyramid::RegionLevel);
  for (int level = 0; level < levels; ++level)
  {
    const int side = RegionSize >> (MinMaxPyramid::BlockShift + level);
    add(field.Pyramid.GetBlocks(level), field.Pyramid.GetColumns(level), side, side,
      field.Pyramid.GetRows(level), 0);
  }
  constexpr int side = RegionSize / HeightWindows::Step;
  HeightWindows& windows = field.Windows;
  add(windows.GetLows(), windows.GetPitch(), side, side, windows.GetNumberOfRows(), 0);
  add(windows.GetHighs(), windows.GetPitch(), side, side, windows.GetNumberOfRows(), 0);
  for (SlidingBounds& squares : field.Squares)
  {
    const int squaresOfSide = std::max(RegionSize >> squares.GetShift(), 1);
    add(squares.GetGreatest(), squares.GetPitch(), 3 * static_cast<std::size_t>(squaresOfSide),
      squaresOfSide, squares.GetNumberOfRows(), 0);
  }
}

RegionSet SparseHeights::FindMissing(const RegionSet& regions) const
{
  RegionSet missing(regions.GetColumns(), regions.GetRows());
  for (const RegionSet::Interval& run : regions.GetIntervals())
  {
    for (int i = run.begin; i < run.end; ++i)
    {
      if (!this->IsFilled(i, run.row) || this->Level.Has(i, run.row))
      {
        missing.Add(i, i, run.row, run.row);
      }
    }
  }
  return missing;
}

// Distinct intervals share no sample.
void SparseHeights::FillRun(const RegionSet::Interval& run, const Source& source)
{
  const HeightView<float>& view = this->Heights.Prepared.heights;
  float* first = this->Heights.Copy.data() + this->Margin;
  const int i0 = run.begin * RegionSize;
  const int i1 = std::min(run.end * RegionSize, view.columns);
  const float none = std::numeric_limits<float>::quiet_NaN();
  const int j0 = run.row * RegionSize;
  const int j1 = std::min(j0 + RegionSize, view.rows);
  source(i0, i1, j0, j1, first + j0 * view.stepY + i0, view.stepY);
  for (int j = j0; j < j1; ++j)
  {
    float* row = first + j * view.stepY;
    std::fill_n(row - this->Margin, i0 == 0 ? this->Margin : 0, none);
    std::fill_n(row + view.columns, i1 == view.columns ? this->Margin : 0, none);
  }
}

// Neighbouring rows are one stretch: large pages begin where they do.
void SparseHeights::Enlarge(const RegionSet& regions)
{
  const std::vector<RegionSet::Interval> runs = regions.GetIntervals();
  auto whole = [&](const RegionSet::Interval& run)
  { return run.begin == 0 && run.end == regions.GetColumns(); };
  for (std::size_t k = 0; k < runs.size();)
  {
    std::size_t next = k;
    for (; next < runs.size() && whole(runs[next]) &&
         runs[next].row == runs[k].row + static_cast<int>(next - k);
         ++next)
    {
    }
    for (const Layer& layer : this->Layers)
    {
      const int first = runs[k].row * layer.height;
      const int last = std::min(first + static_cast<int>(next - k) * layer.height, layer.rows);
      if (next > k && last > first)
      {
        layer.enlarge(first * layer.pitch, last * layer.pitch);
      }
    }
    k = std::max(next, k + 1);
  }
}

void SparseHeights::FillAll(
  const RegionSet& regions, const Source& source, const ParallelFor& parallelFor)
{
  this->Enlarge(regions);
  ForIntervals(
    regions, parallelFor, [&](const RegionSet::Interval& run) { this->FillRun(run, source); });
  this->Filled.Add(regions);
  this->Fresh.Add(regions);
}

void SparseHeights::Fill(
  const RegionSet& regions, const Source& source, const ParallelFor& parallelFor)
{
  this->FillAll(regions, source, parallelFor);
  for (const RegionSet::Interval& run : regions.GetIntervals())
  {
    for (int i = run.begin; i < run.end; ++i)
    {
      this->Level.Remove(i, run.row);
    }
  }
}

void SparseHeights::FillLevel(const RegionSet& regions, const ParallelFor& parallelFor)
{
  RegionSet empty(regions.GetColumns(), regions.GetRows());
  for (const RegionSet::Interval& run : regions.GetIntervals())
  {
    for (int i = run.begin; i < run.end; ++i)
    {
      if (!this->IsFilled(i, run.row))
      {
        empty.Add(i, i, run.row, run.row);
      }
    }
  }
  this->FillAll(
    empty,
    [&](int i0, int i1, int j0, int j1, float* heights, std::ptrdiff_t pitch)
    {
      for (int j = j0; j < j1; ++j, heights += pitch)
      {
        for (int i = i0; i < i1; ++i)
        {
          heights[i - i0] = this->Bounds->RangeAt(i / RegionSize, j / RegionSize).hi;
        }
      }
    },
    parallelFor);
  this->Level.Add(empty);
}

void SparseHeights::Complete(const ParallelFor& parallelFor)
{
  // What is bounded by heights of the regions that are new: by those of the next region, and
  // squares by those of the one behind that.
  RegionSet near(this->Filled.GetColumns(), this->Filled.GetRows());
  RegionSet far = near;
  for (const RegionSet::Interval& run : this->Fresh.GetIntervals())
  {
    for (int j = std::max(run.row - 2, 0); j <= run.row; ++j)
    {
      for (int i = std::max(run.begin - 2, 0); i < run.end; ++i)
      {
        if (this->IsFilled(i, j))
        {
          far.Add(i, i, j, j);
          if (j >= run.row - 1 && i >= run.begin - 1)
          {
            near.Add(i, i, j, j);
          }
        }
      }
    }
  }
  HeightField& field = this->Heights;
  const HeightView<float>& view = field.Prepared.heights;
  ForIntervals(near, parallelFor,
    [&](const RegionSet::Interval& run)
    {
      field.Pyramid.BuildRegions(view, run.begin, run.end, run.row);
      if (this->Margin > 0)
      {
        field.Windows.BuildRegions(view, run.begin, run.end, run.row);
      }
    });
  ForIntervals(far, parallelFor,
    [&](const RegionSet::Interval& run)
    {
      for (SlidingBounds& squares : field.Squares)
      {
        squares.BuildRegions(field.Pyramid, run.begin, run.end, run.row);
      }
    });
  this->Fresh = RegionSet(this->Filled.GetColumns(), this->Filled.GetRows());
}

// Forgets, of an array in its own order, the stretches between the regions that are kept.
void SparseHeights::ForgetIn(const Layer& layer, const RegionSet& kept) const
{
  std::size_t begin = 0; // of the stretch
  auto keep = [&](std::size_t first, std::size_t end)
  {
    if (first > begin)
    {
      layer.forget(begin, first);
    }
    begin = end;
  };
  const std::vector<RegionSet::Interval> runs = kept.GetIntervals();
  for (std::size_t k = 0; k < runs.size();)
  {
    std::size_t next = k;
    for (; next < runs.size() && runs[next].row == runs[k].row; ++next)
    {
    }
    const int last = std::min((runs[k].row + 1) * layer.height, layer.rows);
    for (int row = runs[k].row * layer.height; row < last; ++row)
    {
      for (std::size_t own = k; own < next; ++own)
      {
        // With what stands before the first and behind the last region of a row.
        const std::size_t start = runs[own].begin * layer.width + layer.before;
        const std::size_t end = runs[own].end * layer.width + layer.before;
        const bool toEnd = runs[own].end == kept.GetColumns();
        keep(row * layer.pitch + (runs[own].begin == 0 ? 0 : start),
          row * layer.pitch + (toEnd ? layer.pitch : std::min(end, layer.pitch)));
      }
    }
    k = next;
  }
  keep(layer.rows * layer.pitch, 0);
}

void SparseHeights::Forget(const RegionSet& kept)
{
  for (const Layer& layer : this->Layers)
  {
    this->ForgetIn(layer, kept);
  }
  RegionSet filled(kept.GetColumns(), kept.GetRows());
  RegionSet fresh = filled;
  RegionSet level = filled;
  for (const RegionSet::Interval& run : kept.GetIntervals())
  {
    for (int i = run.begin; i < run.end; ++i)
    {
      if (this->IsFilled(i, run.row))
      {
        filled.Add(i, i, run.row, run.row);
      }
      if (this->Level.Has(i, run.row))
      {
        level.Add(i, i, run.row, run.row);
      }
      if (this->Fresh.Has(i, run.row))
      {
        fresh.Add(i, i, run.row, run.row);
      }
    }
  }
  this->Filled = std::move(filled);
  this->Level = std::move(level);
  this->Fresh = std::move(fresh);
}

std::size_t SparseHeights::CountResident()
{
  std::size_t bytes = 0;
  for (const Layer& layer : this->Layers)
  {
    bytes += layer.resident();
  }
  return bytes;
}

}
