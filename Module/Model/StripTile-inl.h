// SPDX-License-Identifier: BSD-3-Clause
// Included once for each instruction set, hence the guard that toggles.
#if defined(StripTile_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef StripTile_inl_h
#undef StripTile_inl_h
#else
#define StripTile_inl_h
#endif

#include "StripSetUp-inl.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace relief
{
namespace HWY_NAMESPACE
{

// The greatest whole number that is not greater. Places are never too large for one.
HWY_INLINE int FloorOf(double x)
{
  const int whole = static_cast<int>(x);
  return whole - (whole > x ? 1 : 0);
}

// The strips behind a line, as many as are wanted and all rays cross in a few rows. Returns their
// number.
int ListStrips(const StripTile& tile, int line, int wanted, Strip* strips)
{
  auto lowAt = [&](int k) { return k * (k < 0 ? tile.slopeHi : tile.slopeLo) + tile.shiftLo; };
  auto highAt = [&](int k) { return k * (k < 0 ? tile.slopeLo : tile.slopeHi) + tile.shiftHi; };
  const double steepest = std::max(std::abs(tile.climbLo), std::abs(tile.climbHi));
  const double slack =
    1.0e-6 * (1.0 + std::abs(line) + wanted + std::max(-tile.shiftLo, tile.shiftHi));
  double low = lowAt(line);
  double high = highAt(line);
  int first = FloorOf(low);
  int last = -FloorOf(-high);
  for (int k = 0; k < wanted; ++k)
  {
    const double nextLow = lowAt(line + k + 1);
    const double nextHigh = highAt(line + k + 1);
    const int nextFirst = FloorOf(nextLow);
    const int nextLast = -FloorOf(-nextHigh);
    Strip& strip = strips[k];
    strip.line = line + k;
    strip.row = std::min(first, nextFirst);
    strip.rows = std::max(std::max(last, nextLast) - strip.row, 1);
    if (strip.rows > StripRows)
    {
      return k;
    }
    // A place on a border belongs to either of its rows.
    strip.farRow = std::min(nextFirst, strip.row + strip.rows - 1);
    strip.farRows = std::max(nextLast - strip.farRow, 1);
    // Whatever rounding makes of places.
    const double border = strip.row + 1;
    const double above = border + slack;
    const double below = border - slack;
    strip.allCross = strip.rows == 2 && strip.farRows == 1 &&
      ((high < below && nextLow > above) || (low > above && nextHigh < below));
    const double climbed = (strip.line + 1 - tile.startLo) * steepest;
    strip.margin = f32::RELIEF_ROUNDING * static_cast<float>(climbed + tile.sinkHi);
    strip.near = strip.line * tile.ahead + strip.row * tile.lateral;
    strip.far = (strip.line + 1) * tile.ahead + strip.farRow * tile.lateral;
    low = nextLow;
    high = nextHigh;
    first = nextFirst;
    last = nextLast;
  }
  return wanted;
}

// Cells of the image, or beside it.
struct StripCells
{
  int i0, i1, j0, j1;
};

// The cells that strips run through from anywhere in a tile where rays are active.
StripCells CellsOf(const StripTile& tile, const Strip* strips, int count)
{
  int low = strips[0].row;
  int high = low;
  for (int k = 0; k < count; ++k)
  {
    low = std::min(low, strips[k].row);
    high = std::max(high, strips[k].row + strips[k].rows - 1);
  }
  const int first = tile.side > 0 ? strips[0].line : -(strips[0].line + count);
  const int last = first + count - 1;
  StripCells cells;
  cells.i0 = tile.x0 + tile.column0 + (tile.alongX ? first : low);
  cells.i1 = tile.x0 + tile.column1 + (tile.alongX ? last : high);
  cells.j0 = tile.y0 + tile.row0 + (tile.alongX ? low : first);
  cells.j1 = tile.y0 + tile.row1 + (tile.alongX ? high : last);
  return cells;
}

// Bounds of how far rays rise from line 0 to another. Points that are sunk aside begin before it,
// where the steepest ray is the lowest.
HWY_INLINE double LeastRise(const StripTile& tile, double line)
{
  return std::min(line * tile.climbLo, line * tile.climbHi);
}

HWY_INLINE double GreatestRise(const StripTile& tile, double line)
{
  return std::max(line * tile.climbLo, line * tile.climbHi);
}

// Hands over a part of a tile's rays, from a line on.
void LeaveTile(int column0, int column1, int row0, int row1, float line, StripTile& tile)
{
  const int lanes = static_cast<int>(hn::Lanes(Tag()));
  for (int row = row0; row <= row1; ++row)
  {
    for (int column = column0; column <= column1; ++column)
    {
      const int at = row * StripTile::Width + column;
      if (tile.active[at])
      {
        tile.left[at] = line;
        tile.kept[at] = tile.inside[at];
        tile.active[at] = 0;
        tile.base[at] = StripTile::Idle;
        --tile.rays[at - column % lanes];
        tile.anyLeft[row] = true;
      }
    }
  }
}

// Whether d is within the tolerance for every ray at a line, whatever is inside of what follows;
// then `rest` tells how much that may be.
bool AreSettled(const Field<float>& field, const f32::ReliefMedium& medium, int line,
  const StripTile& tile, float* rest)
{
  const Tag tag;
  const IntTag intTag;
  const Settler settler(medium);
  const Vector top = hn::Set(tag, field.top);
  for (int at = 0; at < StripTile::Size; at += static_cast<int>(hn::Lanes(tag)))
  {
    if (tile.rays[at] == 0)
    {
      continue;
    }
    const Mask active = hn::MaskFromVec(hn::BitCast(tag, hn::Load(intTag, tile.active + at)));
    const Vector climb = hn::Load(tag, tile.climb + at);
    const Vector height = hn::Add(hn::Load(tag, tile.base + at),
      hn::MulAdd(climb, hn::Set(tag, static_cast<float>(line)), hn::Load(tag, tile.drop + at)));
    const Vector once = hn::Max(
      hn::Mul(hn::Div(hn::Sub(top, height), climb), hn::Load(tag, tile.span + at)), hn::Zero(tag));
    // As reliefRest().
    const Vector left = medium.useFloor ? once : hn::Add(once, once);
    const Vector thickness =
      hn::Mul(hn::Load(tag, tile.inside + at), hn::Load(tag, tile.span + at));
    if (!hn::AllFalse(tag, hn::And(active, settler.Open(tag, thickness, left))))
    {
      return false;
    }
    hn::Store(left, tag, rest + at);
  }
  return true;
}

// Traces the rays of a tile as far as they are in few rows of cells with data, and no light is
// reached. Those that cannot go on leave the tile.
class StripTracer
{
public:
  StripTracer(const Field<float>& field, const f32::ReliefMedium& medium, StripTile& tile)
    : Heights(field)
    , Medium(medium)
    , Tile(tile)
    , Level(std::min(1, field.bounds->GetNumberOfLevels() - 1))
  {
    const bool aside =
      tile.startHi != 0.0 || tile.startLo != 0.0 || tile.shiftLo != 0.0 || tile.shiftHi != 0.0;
    this->Line = aside ? static_cast<int>(std::floor(tile.startLo)) : 0;
    this->Regular = aside ? static_cast<int>(std::ceil(tile.startHi)) : 0;
    const double steepest = std::max(std::abs(tile.slopeLo), std::abs(tile.slopeHi));
    this->Bend = static_cast<float>(0.25 * std::min(steepest, 1.0));
  }

  // Returns whether rays have stopped within the tolerance; then `rest` is filled.
  bool Trace(float* rest, RayCount& count)
  {
    const StripTile& tile = this->Tile;
    int untilLook = 4 * StripGroup;
    while (this->FindStrips())
    {
      const bool starting = this->Line < this->Regular;
      if (!starting && tile.climbLo >= 0.0 &&
        tile.footLo + LeastRise(tile, this->Line) > this->Heights.top)
      {
        return false;
      }
      if (!starting && untilLook <= 0 && this->Medium.tolerance > 0.0f && tile.climbLo > 0.0)
      {
        untilLook = 4 * StripGroup;
        if (AreSettled(this->Heights, this->Medium, this->Line, tile, rest))
        {
          return true;
        }
      }
      ++count.cells;
      const MinMaxPyramid::Bounds bounds = this->Heights.bounds->Over(
        this->Level, this->Cells.i0, this->Cells.i1, this->Cells.j0, this->Cells.j1);
      if (!this->Cross(starting, bounds, count))
      {
        this->LeaveAll();
        return false;
      }
      untilLook -= this->Size;
      this->Line += this->Size;
    }
    return false;
  }

private:
  // Finds the next strips that all rays can cross, after those have left the tile that cannot.
  // Returns whether there are any rays.
  bool FindStrips()
  {
    StripTile& tile = this->Tile;
    const bool starting = this->Line < this->Regular;
    const int ahead = this->Regular - this->Line;
    const int wanted = starting ? std::min(ahead, StripGroup) : StripGroup;
    this->Size = ListStrips(tile, this->Line, wanted, this->Strips);
    this->Size = std::min(this->Size, FloorOf(tile.end) - this->Line);
    if (this->Size < (starting ? ahead : 1))
    {
      this->LeaveAll();
      return false;
    }
    // Where a border is near, few strips at a time.
    if (!this->Fits() && !starting)
    {
      this->Size = std::min(this->Size, 2);
    }
    while (tile.column0 <= tile.column1 && tile.row0 <= tile.row1 && !this->Fits())
    {
      const HeightView<float>& heights = this->Heights.heights;
      if (this->Cells.i0 < 0)
      {
        this->Leave(tile.column0, tile.column0, tile.row0, tile.row1);
        ++tile.column0;
      }
      else if (this->Cells.i1 > heights.columns - 2)
      {
        this->Leave(tile.column1, tile.column1, tile.row0, tile.row1);
        --tile.column1;
      }
      else if (this->Cells.j0 < 0 || this->ReadsBefore())
      {
        this->Leave(tile.column0, tile.column1, tile.row0, tile.row0);
        ++tile.row0;
      }
      else
      {
        this->Leave(tile.column0, tile.column1, tile.row1, tile.row1);
        --tile.row1;
      }
    }
    return tile.column0 <= tile.column1 && tile.row0 <= tile.row1;
  }

  // Whether the strips lie in the image, where they can be read.
  bool Fits()
  {
    const HeightView<float>& heights = this->Heights.heights;
    this->Cells = CellsOf(this->Tile, this->Strips, this->Size);
    // Vectors read beside the rays that are active, too.
    const std::ptrdiff_t end = heights.stepY * (heights.rows - 1) + heights.columns;
    const std::ptrdiff_t last = (this->Cells.j1 + 1) * heights.stepY + this->Cells.i1 + 1 +
      StripTile::Width - 1 - this->Tile.column1;
    return this->Cells.i0 >= 0 && this->Cells.j0 >= 0 && this->Cells.i1 <= heights.columns - 2 &&
      this->Cells.j1 <= heights.rows - 2 && last < end && !this->ReadsBefore();
  }
  bool ReadsBefore() const
  {
    return this->Cells.j0 * this->Heights.heights.stepY + this->Cells.i0 - this->Tile.column0 < 0;
  }

  void Leave(int column0, int column1, int row0, int row1)
  {
    const bool started = this->Started && this->Line >= this->Regular;
    LeaveTile(column0, column1, row0, row1,
      started ? static_cast<float>(this->Line) : StripTile::AtStart, this->Tile);
  }
  void LeaveAll()
  {
    this->Leave(this->Tile.column0, this->Tile.column1, this->Tile.row0, this->Tile.row1);
  }

  // Takes rays through the strips. Returns whether all of their cells have data.
  bool Cross(bool starting, const MinMaxPyramid::Bounds& bounds, RayCount& count)
  {
    StripTile& tile = this->Tile;
    const float infinity = std::numeric_limits<float>::infinity();
    const double in = this->Line;
    const double out = this->Line + this->Size;
    const double riseLo = std::min(LeastRise(tile, in), LeastRise(tile, out));
    const double riseHi = std::max(GreatestRise(tile, in), GreatestRise(tile, out));
    const float widest = this->Strips[this->Size - 1].margin;
    if (!starting && bounds.hi < tile.footLo + riseLo)
    {
      this->Started = true;
      return true;
    }
    if (!(bounds.lo > -infinity))
    {
      return false;
    }
    if (starting)
    {
      FindStartHeights(this->Heights, this->Strips, this->Size, tile);
    }
    const StripWalk walk = { this->Strips, this->Size, starting, this->Bend * bounds.twist + widest,
      starting ? infinity : bounds.hi - static_cast<float>(riseLo),
      starting ? -infinity : bounds.lo - static_cast<float>(riseHi) - widest };
    const std::uint64_t walked = WalkStrips(this->Heights.heights, walk, tile);
    for (int k = 0; k < this->Size; ++k)
    {
      count.cells += walked * this->Strips[k].rows;
    }
    this->Started = true;
    return true;
  }

  const Field<float>& Heights;
  const f32::ReliefMedium& Medium;
  StripTile& Tile;
  int Level;
  int Line;
  int Regular; // the first line at which all rays have started
  float Bend;  // times a twist, how far a patch rises above a line between its ends
  bool Started = false;
  Strip Strips[StripGroup];
  int Size = 0;
  StripCells Cells;
};

}
}
HWY_AFTER_NAMESPACE();

#endif
