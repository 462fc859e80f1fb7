// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightWindows_h
#define HeightWindows_h

#include "RawArray.h"

#include <cstddef>

namespace relief
{

template <class T>
struct HeightView;

/// Least and greatest height in windows that overlap: one at every second sample, along both axes,
/// four cells wide and high. So any three by three cells are in one window, and where those of one
/// ray are, those of the ray beside it are beside: whole vectors of rays skip by them, each ray by
/// its own. The blocks of MinMaxPyramid are for all rays of a tile.
///
/// Samples without data do not count: for cells that are holes, windows tell nothing.
class HeightWindows
{
public:
  static constexpr int Step = 2;                ///< samples from one to the next
  static constexpr int Size = 4;                ///< cells along a side
  static constexpr int Box = Size - (Step - 1); ///< cells along a side that are in one anyway

  /// Makes room for a field of this many samples; the windows are unset. Behind the last window of
  /// a row a reader may go on for `margin` more, where any number is.
  void Allocate(int columns, int rows, int margin);

  /// Makes such room that takes memory only where it is filled. Returns whether the system has any.
  bool Reserve(int columns, int rows, int margin);

  /// Fills the windows that begin in the regions [begin, end) of a row of regions of
  /// MinMaxPyramid::RegionSize samples, of a field's heights. Distinct regions may be filled at
  /// once.
  void BuildRegions(const HeightView<float>& heights, int begin, int end, int row);

  /// Fills one row of windows from its samples: of `count` rows, from Step times the row on.
  /// Distinct rows may be filled at once.
  void BuildRow(int row, const float* const* samples, int count);

  int GetNumberOfRows() const { return this->Rows; }
  std::size_t GetPitch() const { return this->Pitch; } ///< from a row of windows to the next
  RawArray<float>& GetLows() { return this->Lows; }
  RawArray<float>& GetHighs() { return this->Highs; }

  ///@{
  /// The window that holds the cells from (i, j) on, where that is in the image, and those after
  /// it.
  const float* Lowest(int i, int j) const { return this->Lows.data() + this->At(i, j); }
  const float* Highest(int i, int j) const { return this->Highs.data() + this->At(i, j); }
  ///@}

private:
  void SetSize(int columns, int rows, int margin);
  std::size_t At(int i, int j) const
  {
    return static_cast<std::size_t>(j / Step) * this->Pitch + static_cast<std::size_t>(i / Step);
  }

  int Samples = 0; // in a row
  int Columns = 0;
  int Rows = 0;
  std::size_t Pitch = 0;
  RawArray<float> Lows;
  RawArray<float> Highs;
};

}

#endif
