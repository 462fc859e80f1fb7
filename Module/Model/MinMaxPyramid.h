// SPDX-License-Identifier: BSD-3-Clause
#ifndef MinMaxPyramid_h
#define MinMaxPyramid_h

#include "RawArray.h"

#include <cstddef>
#include <limits>
#include <vector>

namespace relief
{

template <class T>
struct HeightView;

/// Least and greatest height over square blocks of cells, in levels: the structure by which rays
/// skip what they cannot meet (maximum mipmaps: Tevs, Ihrke and Seidel 2008, "Maximum mipmaps for
/// fast, accurate, and scalable dynamic height field rendering").
///
/// Blocks are anchored to the field's first sample, and cover BlockSize << level cells along a
/// side. A block in which every cell is a hole has lo > hi; one in which some are is (-infinity,
/// infinity), so that no ray skips a hole, in which it needs the height at which it entered.
class MinMaxPyramid
{
public:
  struct Bounds
  {
    float lo = std::numeric_limits<float>::infinity();
    float hi = -std::numeric_limits<float>::infinity();
    float twist = 0.0f; ///< largest |h11 - h10 - h01 + h00| of its whole cells
  };

  static constexpr int BlockShift = 2;
  static constexpr int BlockSize = 1 << BlockShift;

  /// Makes room for a field of this many samples; its bounds are unset.
  void Allocate(int columns, int rows);

  ///@{
  /// Blocks of this many cells along a side, those of this level, are known of a whole raster when
  /// only parts of it are at hand.
  static constexpr int RegionLevel = 4;
  static constexpr int RegionShift = BlockShift + RegionLevel;
  static constexpr int RegionSize = 1 << RegionShift;
  ///@}

  /// Makes room as Allocate() does, of which the levels below RegionLevel take memory only where
  /// they are filled. Returns whether the system has any.
  bool Reserve(int columns, int rows);

  /// Fills the levels below RegionLevel in the regions [begin, end) of a row of regions, whose
  /// samples are at `heights`, from the field's first one on, with those that close them. Distinct
  /// regions may be filled at once.
  void BuildRegions(const HeightView<float>& heights, int begin, int end, int row);

  /// The blocks of a level, row by row.
  RawArray<Bounds>& GetBlocks(int level) { return this->Levels[level].blocks; }
  const RawArray<Bounds>& GetBlocks(int level) const { return this->Levels[level].blocks; }

  /// Fills rows [begin, end) of level 0 from the heights. Distinct rows may be filled at once.
  void BuildBase(const HeightView<float>& heights, int begin, int end);

  /// Fills one row of level 0 from its samples: of `count` rows, the last of which the next row of
  /// blocks begins with. Nothing where a field has no cells.
  void BuildBaseRow(int row, const float* const* samples, int count);

  /// Fills the levels above one from that.
  void BuildUpper(int below = 0);

  int GetNumberOfLevels() const { return static_cast<int>(this->Levels.size()); }
  int GetColumns(int level) const { return this->Levels[level].columns; } ///< of blocks
  int GetRows(int level) const { return this->Levels[level].rows; }
  int GetNumberOfBaseRows() const { return this->Levels.empty() ? 0 : this->Levels[0].rows; }
  std::size_t GetMemorySize() const;

  const Bounds& At(int level, int i, int j) const
  {
    const Level& l = this->Levels[level];
    return l.blocks[static_cast<std::size_t>(j) * l.columns + i];
  }

  /// Bounds of all the blocks that hold the cells [i0, i1] x [j0, j1], by the same rules:
  /// (-infinity, infinity) where any cell is a hole.
  Bounds Over(int level, int i0, int i1, int j0, int j1) const
  {
    const int shift = BlockShift + level;
    Bounds found;
    bool holes = false;
    for (int j = j0 >> shift; j <= j1 >> shift; ++j)
    {
      for (int i = i0 >> shift; i <= i1 >> shift; ++i)
      {
        const Bounds& block = this->At(level, i, j);
        holes = holes || block.lo > block.hi;
        found.lo = block.lo < found.lo ? block.lo : found.lo;
        found.hi = block.hi > found.hi ? block.hi : found.hi;
        found.twist = block.twist > found.twist ? block.twist : found.twist;
      }
    }
    return holes ? GetMixed() : found;
  }

  /// Bounds of cells of which some are holes.
  static Bounds GetMixed()
  {
    const float infinity = std::numeric_limits<float>::infinity();
    return { -infinity, infinity, infinity };
  }

private:
  struct Level
  {
    int columns = 0;
    int rows = 0;
    RawArray<Bounds> blocks;
  };
  // Lists the levels, and makes room for their blocks by makeRoom(level, blocks, count), which says
  // whether there is any.
  template <class MakeRoom>
  bool List(int columns, int rows, MakeRoom&& makeRoom);

  std::vector<Level> Levels;
  int Columns = 0; // of samples
};

}

#endif
