// SPDX-License-Identifier: BSD-3-Clause
#ifndef RasterBounds_h
#define RasterBounds_h

#include "MinMaxPyramid.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace relief
{

/// What is known of a whole raster of heights when only parts of it are in memory: its bounds
/// region by region, squares of RegionSize samples, and over all. They take less than 0.01 bytes a
/// sample, and are found in one pass over the rows.
///
/// The heights are those of a field: float lengths above its datum, NaN without data (HeightField).
class RasterBounds
{
public:
  static constexpr int RegionSize = MinMaxPyramid::RegionSize;

  /// Least and greatest height of a region's own samples; lo > hi where none has data.
  struct Range
  {
    float lo = std::numeric_limits<float>::infinity();
    float hi = -std::numeric_limits<float>::infinity();
  };

  /// Begins a pass over a raster of this many samples.
  void Begin(int columns, int rows);

  /// Adds the next `count` rows, each `pitch` samples after the one before. The heights are not
  /// needed afterwards. Rows behind the last one of the raster are not taken.
  void AddRows(const float* heights, std::ptrdiff_t pitch, int count);

  ///@{
  /// Instead of a pass, where nothing is known but the least and the greatest height of all: every
  /// region counts as one of these bounds until it is learned of, and its cells as whole, or as
  /// holes if they may be.
  void Assume(int columns, int rows, const Range& whole);
  void AssumeHoles();
  void Learn(int i, int j, const Range& range, const MinMaxPyramid::Bounds& bounds);
  bool IsAssumed(int i, int j) const
  {
    return !this->Assumed.empty() && this->Assumed[this->At(i, j)] != 0;
  }
  ///@}

  /// Whether all rows have been added.
  bool IsComplete() const { return this->Added == this->Rows; }

  int GetColumns() const { return this->Columns; }
  int GetRows() const { return this->Rows; }
  int GetRegionColumns() const { return (this->Columns + RegionSize - 1) / RegionSize; }
  int GetRegionRows() const { return (this->Rows + RegionSize - 1) / RegionSize; }

  /// How many samples have data.
  std::uint64_t GetNumberWithData() const { return this->WithData; }
  void SetNumberWithData(std::uint64_t number) { this->WithData = number; }

  ///@{
  /// Least and greatest height of all samples: greater than it if none has data.
  float GetBottom() const { return this->Whole().lo; }
  float GetTop() const { return this->Whole().hi; }
  ///@}

  ///@{
  /// All that has to be kept to have this object again: SetSize() and the same arrays filled. Of
  /// each region, row by row, first, the range of its own samples; and the bounds of the cells that
  /// begin in it, which are those of MinMaxPyramid. Regions of the last column and row may have no
  /// cells, and then have the bounds of none.
  void SetSize(int columns, int rows);
  std::vector<Range>& GetRanges() { return this->Ranges; }
  const std::vector<Range>& GetRanges() const { return this->Ranges; }
  std::vector<MinMaxPyramid::Bounds>& GetBounds() { return this->Bounds; }
  const std::vector<MinMaxPyramid::Bounds>& GetBounds() const { return this->Bounds; }
  ///@}

  const Range& RangeAt(int i, int j) const { return this->Ranges[this->At(i, j)]; }

  /// Whether heights of whole regions, of `count` regions from region (i, j) eastward, can be those
  /// that were added, as far as the regions' ranges tell: to within `rounding`.
  bool Agree(
    int i, int j, int count, const float* heights, std::ptrdiff_t pitch, float rounding) const;

  /// Whether any of the cells that begin in a region, by its column and row, is a hole.
  bool HasHoles(int i, int j) const
  {
    const MinMaxPyramid::Bounds& bounds = this->Bounds[this->At(i, j)];
    const bool whole =
      bounds.lo > -std::numeric_limits<float>::infinity() && bounds.lo <= bounds.hi;
    return this->HasCells(i, j) && !whole;
  }

  /// Whether there are cells that begin in a region.
  bool HasCells(int i, int j) const
  {
    return i * RegionSize < this->Columns - 1 && j * RegionSize < this->Rows - 1;
  }

  /// Fills the levels of a pyramid from MinMaxPyramid::RegionLevel on, as those of the whole
  /// raster.
  void FillPyramid(MinMaxPyramid& pyramid) const;

  std::size_t GetMemorySize() const
  {
    return this->Ranges.size() * sizeof(Range) +
      this->Bounds.size() * sizeof(MinMaxPyramid::Bounds);
  }

private:
  std::size_t At(int i, int j) const
  {
    return static_cast<std::size_t>(j) * this->GetRegionColumns() + i;
  }
  Range Whole() const;
  void AddToRanges(const float* row, int j);
  void CloseBand();

  int Columns = 0;
  int Rows = 0;
  int Added = 0; // rows
  std::uint64_t WithData = 0;
  std::vector<Range> Ranges;
  std::vector<MinMaxPyramid::Bounds> Bounds;
  std::vector<unsigned char> Assumed; // regions of which nothing is known yet; none after a pass
  std::vector<float> Band;            // the rows of a row of regions, and the one that closes it
  int InBand = 0;
};

}

#endif
