// SPDX-License-Identifier: BSD-3-Clause
#ifndef RegionSet_h
#define RegionSet_h

#include <cstddef>
#include <vector>

namespace relief
{

/// Regions of a raster, squares of RasterBounds::RegionSize samples anchored to its first one, by
/// their columns and rows.
class RegionSet
{
public:
  /// Regions [begin, end) of a row.
  struct Interval
  {
    int row;
    int begin;
    int end;
  };

  /// Regions [i0, i1] x [j0, j1].
  struct Block
  {
    int i0, i1, j0, j1;
  };

  RegionSet() = default;
  RegionSet(int columns, int rows)
    : Columns(columns)
    , Members(rows)
  {
  }

  int GetColumns() const { return this->Columns; }
  int GetRows() const { return static_cast<int>(this->Members.size()); }

  bool Has(int i, int j) const { return !this->Members[j].empty() && this->Members[j][i] != 0; }

  /// Adds [i0, i1] x [j0, j1], as much of it as there is.
  void Add(int i0, int i1, int j0, int j1)
  {
    i0 = i0 < 0 ? 0 : i0;
    j0 = j0 < 0 ? 0 : j0;
    i1 = i1 < this->Columns ? i1 : this->Columns - 1;
    j1 = j1 < this->GetRows() ? j1 : this->GetRows() - 1;
    for (int j = j0; j <= j1 && i0 <= i1; ++j)
    {
      std::vector<unsigned char>& row = this->Members[j];
      row.resize(this->Columns);
      for (int i = i0; i <= i1; ++i)
      {
        row[i] = 1;
      }
    }
  }

  void Add(const Block& block) { this->Add(block.i0, block.i1, block.j0, block.j1); }

  void Remove(int i, int j)
  {
    if (this->Has(i, j))
    {
      this->Members[j][i] = 0;
    }
  }

  /// Adds those of another set over the same raster.
  void Add(const RegionSet& other)
  {
    for (const Interval& run : other.GetIntervals())
    {
      this->Add(run.begin, run.end - 1, run.row, run.row);
    }
  }

  std::size_t Count() const
  {
    std::size_t count = 0;
    for (const Interval& run : this->GetIntervals())
    {
      count += static_cast<std::size_t>(run.end - run.begin);
    }
    return count;
  }

  /// Row by row, the intervals that cannot be longer.
  std::vector<Interval> GetIntervals() const
  {
    std::vector<Interval> intervals;
    for (int j = 0; j < this->GetRows(); ++j)
    {
      const std::vector<unsigned char>& row = this->Members[j];
      for (int i = 0; i < static_cast<int>(row.size()); ++i)
      {
        if (row[i] && (i == 0 || !row[i - 1]))
        {
          intervals.push_back({ j, i, i });
        }
        if (row[i])
        {
          intervals.back().end = i + 1;
        }
      }
    }
    return intervals;
  }

private:
  int Columns = 0;
  std::vector<std::vector<unsigned char>> Members; // no row that has none
};

}

#endif
