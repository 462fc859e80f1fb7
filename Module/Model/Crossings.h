// SPDX-License-Identifier: BSD-3-Clause
#ifndef Crossings_h
#define Crossings_h

#include "HeightWindows.h"

#include <array>
#include <cstddef>
#include <vector>

namespace relief
{

/// Where parallel rays cross grid lines: the cells that every ray of a directional light runs
/// through, by their offsets from the ray's own sample, and groups of them to be skipped together.
class Crossings
{
public:
  // One cell, and the two samples between which the ray leaves it.
  struct Cell
  {
    int x;
    int y;
    int firstX, firstY;
    int secondX, secondY;
    float weight;   // of the second sample at the exit
    float length;   // of the ray in the cell
    float rise;     // of the ray at the exit above its sample
    float distance; // of the entry along the ray, through a grid line of this axis
    int axis;
    bool touches; // only a corner, and so does not end a hole
    float bend;   // what the patch's twist is multiplied by to give the quadratic's curvature
  };

  // Consecutive cells that are skipped or walked together: as many as are in a box of BoxSize by
  // BoxSize, along a grid line with those beside it.
  struct Group
  {
    int begin;
    int end;
    int x0, x1, y0, y1; // offsets that its cells span
    float riseIn;       // of the ray above its sample where it enters the first cell
    float riseOut;      // and where it leaves the last
    float length;
    float distance; // of the entry along the ray
  };
  static constexpr int BoxSize = HeightWindows::Box;
  static constexpr int GroupSize = 2 * BoxSize - 1; // at most
  static constexpr int SpanSize = 4;
  static constexpr int LongSpanSize = SpanSize * SpanSize;

  /// Lists the cells of rays that start `depth` below their samples and are `end` long; per unit of
  /// length they run dx and dy samples and rise by dz. No sample has a neighbor `outside` samples
  /// away: one more group there ends the list.
  Crossings(double dx, double dy, double dz, double depth, double end, int outside);

  const std::vector<Cell>& GetCells() const { return this->Cells; }
  const std::vector<Group>& GetGroups() const { return this->Groups; }
  const std::vector<Group>& GetSpans() const { return this->Spans; } ///< of SpanSize groups each
  const std::vector<Group>& GetLongSpans() const { return this->LongSpans; } ///< of LongSpanSize

  /// Bytes that the lists take.
  std::size_t GetMemorySize() const
  {
    return this->Cells.capacity() * sizeof(Cell) +
      (this->Groups.capacity() + this->Spans.capacity() + this->LongSpans.capacity()) *
      sizeof(Group);
  }

  /// The axis of the grid line that rays cross where they leave the last cell.
  int GetLastAxis() const { return this->LastAxis; }

private:
  // Adds a cell that the ray enters at length s, risen by riseIn, and leaves at next. Along a grid
  // line the cell `beside` it before the line belongs to the group as well.
  void Add(
    const Cell& cell, double s, double next, double riseIn, const std::array<int, 2>& beside);
  static std::vector<Group> ListSpans(const std::vector<Group>& groups, std::size_t size);

  std::vector<Cell> Cells;
  std::vector<Group> Groups;
  std::vector<Group> Spans;
  std::vector<Group> LongSpans;
  int LastAxis = 0;
};

}

#endif
