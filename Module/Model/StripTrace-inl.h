// SPDX-License-Identifier: BSD-3-Clause
// Included once for each instruction set, hence the guard that toggles.
#if defined(StripTrace_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef StripTrace_inl_h
#undef StripTrace_inl_h
#else
#define StripTrace_inl_h
#endif

#include "MinMaxPyramid.h"
#include "RayThickness.h"
#include "ThicknessLanes-inl.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace relief
{
namespace HWY_NAMESPACE
{

// A tile of rays that all run to the same side along one axis, and no further aside. The grid lines
// ahead of a ray count from its own sample's on. Between two of these lines is a strip: all rays of
// the tile cross it together, each in one or two cells out of a few rows that are the same for all.
struct StripTile
{
  static constexpr int Width = SweepThickness::TileWidth;
  static constexpr int Height = SweepThickness::TileHeight;
  static constexpr int Size = SweepThickness::TileSize;
  static constexpr float Idle = 1.0e30f; // the base of a ray that is not active: above everything
  static constexpr float NotLeft = -2.0e30f;
  static constexpr float AtStart = -1.0e30f;

  int x0; // the first sample
  int y0;
  bool alongX;            // whether the lines are those of constant x
  int side;               // 1 or -1, where they lie
  std::ptrdiff_t ahead;   // elements from a sample to the next line
  std::ptrdiff_t lateral; // and to the next row of cells

  // Of each ray. Where it is at line k: at the row slope * k + shift, at the height climb * k +
  // drop above its base.
  HWY_ALIGN float base[Size];
  HWY_ALIGN float sink[Size];
  HWY_ALIGN float slope[Size];
  HWY_ALIGN float shift[Size];
  HWY_ALIGN float climb[Size];
  HWY_ALIGN float drop[Size];
  HWY_ALIGN float span[Size];   // its length from line to line
  HWY_ALIGN float across[Size]; // lines from row to row; where it is at row v: at across * v + back
  HWY_ALIGN float back[Size];
  HWY_ALIGN float start[Size]; // where it starts, in lines and rows
  HWY_ALIGN float startRow[Size];
  HWY_ALIGN float startAbove[Size];    // how far below the surface
  HWY_ALIGN float inside[Size];        // its length inside so far, in lines
  HWY_ALIGN std::int32_t active[Size]; // -1 or 0
  // Rays that have left the tile: at which line, or before they began (StripTile::NotLeft and
  // ::AtStart), and their length inside till then.
  float left[Size];
  float kept[Size];
  bool anyLeft[Height]; // of a row

  int column0, column1; // the part of the tile in which rays may be active
  int row0, row1;

  // Of each vector, or more exactly at its first ray: how many rays are active, and least and
  // greatest of base + drop.
  int rays[Size];
  float lowest[Size];
  float highest[Size];

  // Least and greatest of these.
  double slopeLo, slopeHi;
  double shiftLo, shiftHi;
  double climbLo, climbHi;
  double footLo, footHi; // base + drop
  double startLo, startHi;
  double sinkHi;
  double end; // no light is nearer than this line
};

// What rays cross together: the strip behind a line.
struct Strip
{
  int line;
  int row; // the lowest that any ray is in
  int rows;
  int farRow; // the same at the line ahead
  int farRows;
  bool allCross; // whether every ray crosses from one row to another
  // From a ray's sample to the lowest sample at either line, in elements.
  std::ptrdiff_t near;
  std::ptrdiff_t far;
  float margin; // the widest within which of the surface a ray counts as on it, as reliefMargin()
};

constexpr int StripRows = 3;  // at most
constexpr int StripGroup = 4; // strips that are looked at together

// To which side rays of a tile run across rows.
enum class Aside
{
  Up,
  Down,
  Either
};

// The height above base between two samples, `share` of the way to the second.
HWY_INLINE Vector HeightBetween(Vector first, Vector second, Vector share, Vector base)
{
  return hn::MulAdd(hn::Sub(second, first), share, hn::Sub(first, base));
}

// The samples between which rays cross a grid line, and the row of the first. `line` is the sample
// of the lowest row in which any ray is.
template <int Rows>
HWY_INLINE void SamplesOn(const float* line, std::ptrdiff_t lateral, float lowest, Vector place,
  Vector& first, Vector& second, Vector& row)
{
  const Tag tag;
  first = hn::LoadU(tag, line);
  second = hn::LoadU(tag, line + lateral);
  row = hn::Set(tag, lowest);
  for (int k = 1; k < Rows; ++k)
  {
    const Vector border = hn::Set(tag, lowest + static_cast<float>(k));
    const Mask beyond = hn::Ge(place, border);
    first = hn::IfThenElse(beyond, second, first);
    second = hn::IfThenElse(beyond, hn::LoadU(tag, line + (k + 1) * lateral), second);
    row = hn::IfThenElse(beyond, border, row);
  }
}

HWY_INLINE void SamplesOn(int rows, const float* line, std::ptrdiff_t lateral, float lowest,
  Vector place, Vector& first, Vector& second, Vector& row)
{
  if (rows == 1)
  {
    SamplesOn<1>(line, lateral, lowest, place, first, second, row);
  }
  else if (rows == 2)
  {
    SamplesOn<2>(line, lateral, lowest, place, first, second, row);
  }
  else
  {
    SamplesOn<3>(line, lateral, lowest, place, first, second, row);
  }
}

// A vector's rays, as the loop over strips needs them.
struct StripRays
{
  const Vector& base;
  const Vector& slope;
  const Vector& shift;
  const Vector& climb;
  const Vector& drop;
  const Vector& across;
  const Vector& back;
};

// Where rays cross a grid line.
struct LinePlace
{
  Vector& row;   // of cells that they come to
  Vector& first; // the samples at both sides
  Vector& second;
  Vector& above; // how far the ground lies above them
};

// The way of rays through a strip.
struct StripWay
{
  const Vector& row; // at the first line, and at the second
  const Vector& farRow;
  const Vector& amid; // where they cross to another row, or else the second line
  const Vector&
    above; // how far the ground lies above them at the first line, there and at the second
  const Vector& aboveAmid;
  const Vector& aboveFar;
};

// The length inside, in lines, of rays in a strip, cell by cell.
template <bool Starting>
HWY_NOINLINE Vector InsideStrip(
  const StripTile& tile, int at, const Strip& strip, const float* sample, const StripWay& way)
{
  const Tag tag;
  const Vector zero = hn::Zero(tag);
  const Vector one = hn::Set(tag, 1.0f);

  // The twists of the two cells. A ray at a border between rows may count to either, and one that
  // seems to cross two borders, by rounding, is in the row between them.
  const Vector ownRow =
    hn::Min(hn::Max(way.row, hn::Sub(way.farRow, one)), hn::Add(way.farRow, one));
  const float* near = sample + strip.near;
  auto twistOf = [&](const float* lower)
  {
    const float* upper = lower + tile.lateral;
    return hn::Sub(hn::Sub(hn::LoadU(tag, upper + tile.ahead), hn::LoadU(tag, upper)),
      hn::Sub(hn::LoadU(tag, lower + tile.ahead), hn::LoadU(tag, lower)));
  };
  Vector twist = twistOf(near);
  Vector farTwist = twist;
  for (int k = 1; k < strip.rows; ++k)
  {
    near += tile.lateral;
    const Vector row = hn::Set(tag, static_cast<float>(strip.row + k));
    const Vector here = twistOf(near);
    twist = hn::IfThenElse(hn::Ge(ownRow, row), here, twist);
    farTwist = hn::IfThenElse(hn::Ge(way.farRow, row), here, farTwist);
  }

  const Vector line = hn::Set(tag, static_cast<float>(strip.line));
  const Vector end = hn::Add(line, one);
  Vector begin = line;
  Vector amid = hn::Min(hn::Max(way.amid, line), end);
  Vector a = way.above;
  Vector b = way.aboveAmid;
  Vector far = end;
  if constexpr (Starting)
  {
    const Vector start = hn::Load(tag, tile.start + at);
    const Vector startAbove = hn::Load(tag, tile.startAbove + at);
    a = hn::IfThenElse(hn::Lt(begin, start), startAbove, a);
    b = hn::IfThenElse(hn::Lt(amid, start), startAbove, b);
    begin = hn::Max(begin, start);
    amid = hn::Max(amid, start);
    far = hn::Max(far, start);
  }
  const Vector slope = hn::Load(tag, tile.slope + at);
  const Vector nearPart = hn::Sub(amid, begin);
  const Vector farPart = hn::Sub(far, amid);
  const Vector nearC = hn::Mul(twist, hn::Mul(slope, hn::Mul(nearPart, nearPart)));
  const Vector farC = hn::Mul(farTwist, hn::Mul(slope, hn::Mul(farPart, farPart)));
  // Each its own: a steep ray climbs far above its depth within a strip.
  const Vector climb = hn::Load(tag, tile.climb + at);
  const Vector sink = hn::Load(tag, tile.sink + at);
  const Vector level = hn::Add(hn::Load(tag, tile.drop + at), sink); // the rise at line 0
  auto marginAt = [&](Vector place)
  {
    return hn::Mul(
      hn::Set(tag, f32::RELIEF_ROUNDING), hn::Add(hn::Abs(hn::MulAdd(climb, place, level)), sink));
  };
  const Vector marginBegin = marginAt(begin);
  const Vector marginAmid = marginAt(amid);
  const Vector marginFar = marginAt(far);
  auto isClear = [&](Vector ownA, Vector ownB, Vector c, Vector margin)
  {
    const Vector bow = hn::MulAdd(hn::Abs(c), hn::Set(tag, 0.25f), margin);
    return hn::Or(
      hn::Gt(hn::Min(ownA, ownB), bow), hn::Lt(hn::Add(hn::Max(ownA, ownB), bow), zero));
  };
  // A ray hardly ever meets the surface in both cells: one share serves both.
  const Mask nearMeets = hn::AndNot(isClear(a, b, nearC, marginAmid), hn::Gt(nearPart, zero));
  const Vector share =
    InsideShare(tag, hn::IfThenElse(nearMeets, a, b), hn::IfThenElse(nearMeets, b, way.aboveFar),
      hn::IfThenElse(nearMeets, nearC, farC), hn::IfThenElse(nearMeets, marginBegin, marginAmid),
      hn::IfThenElse(nearMeets, marginAmid, marginFar));
  const Vector nearShare =
    hn::IfThenElse(nearMeets, share, hn::IfThenElseZero(hn::Gt(a, zero), one));
  Vector farShare =
    hn::IfThenElse(nearMeets, hn::IfThenElseZero(hn::Gt(way.aboveFar, zero), one), share);
  const Mask both = hn::AndNot(
    isClear(b, way.aboveFar, farC, marginFar), hn::And(nearMeets, hn::Gt(farPart, zero)));
  if (HWY_UNLIKELY(!hn::AllFalse(tag, both)))
  {
    farShare = hn::IfThenElse(
      both, InsideShare(tag, b, way.aboveFar, farC, marginAmid, marginFar), farShare);
  }
  return hn::MulAdd(nearPart, nearShare, hn::Mul(farPart, farShare));
}

// How to take rays through a strip.
template <int FarRows, bool AnyCross = true, bool AllCross = false>
struct StripKind
{
};

// How far the ground lies above rays that have come to `place` lines ahead, between two samples.
// Where rays start it is found from the nearer sample, as reliefEdgeHeight() does: the other may be
// a mountain.
template <bool Starting>
HWY_INLINE Vector AboveBetween(
  const StripRays& rays, Vector first, Vector second, Vector along, Vector from, Vector place)
{
  const Vector height = Starting
    ? lanes::reliefBetween(along, from, hn::Sub(first, rays.base), hn::Sub(second, rays.base))
    : HeightBetween(first, second, hn::Sub(along, from), rays.base);
  return hn::Sub(height, hn::MulAdd(rays.climb, place, rays.drop));
}

// Takes rays through a strip. If none is near the surface anywhere in it, a few heights tell.
template <Aside Way, bool Starting, int FarRows, bool AnyCross, bool AllCross>
HWY_INLINE void CrossStrip(StripKind<FarRows, AnyCross, AllCross>, const StripTile& tile, int at,
  const Strip& strip, const float* sample, float bow, const StripRays& rays, const LinePlace& here,
  Vector& inside)
{
  const Tag tag;
  const Vector line = hn::Set(tag, static_cast<float>(strip.line));
  const Vector end = hn::Set(tag, static_cast<float>(strip.line + 1));
  const Vector to = hn::MulAdd(rays.slope, end, rays.shift);
  Vector first;
  Vector second;
  Vector row;
  SamplesOn<FarRows>(
    sample + strip.far, tile.lateral, static_cast<float>(strip.farRow), to, first, second, row);
  const Vector above = AboveBetween<Starting>(rays, first, second, to, row, end);
  Vector low = hn::Min(here.above, above);
  Vector high = hn::Max(here.above, above);
  Vector amid = end;
  Vector aboveAmid = above;
  if constexpr (AnyCross)
  {
    const Mask crosses = hn::Ne(row, here.row);
    const Vector place = hn::MulAdd(rays.across, hn::Max(row, here.row), rays.back);
    // The sample of the border between the rows, at either line.
    Vector near = Way == Aside::Down ? here.first : here.second;
    Vector far = Way == Aside::Down ? second : first;
    if constexpr (Way == Aside::Either)
    {
      const Mask down = hn::Lt(row, here.row);
      near = hn::IfThenElse(down, here.first, near);
      far = hn::IfThenElse(down, second, far);
    }
    const Vector there = AboveBetween<Starting>(rays, near, far, place, line, place);
    amid = AllCross ? place : hn::IfThenElse(crosses, place, end);
    aboveAmid = AllCross ? there : hn::IfThenElse(crosses, there, above);
    low = hn::Min(low, aboveAmid);
    high = hn::Max(high, aboveAmid);
  }
  // Lanes whose heights are no numbers have no ray, and compare false.
  const Mask allInside = hn::Gt(low, hn::Set(tag, bow));
  const Mask meets = hn::AndNot(allInside, hn::Ge(high, hn::Set(tag, -bow)));
  if (HWY_LIKELY(!Starting && hn::AllFalse(tag, meets)))
  {
    inside = hn::Add(inside, hn::IfThenElseZero(allInside, hn::Set(tag, 1.0f)));
  }
  else
  {
    // Copies, so that the others stay in registers.
    const Vector rowBefore = here.row;
    const Vector aboveBefore = here.above;
    const Vector rowAfter = row;
    const Vector aboveAfter = above;
    const Vector place = amid;
    const Vector aboveThere = aboveAmid;
    inside = hn::Add(inside,
      InsideStrip<Starting>(tile, at, strip, sample,
        { rowBefore, rowAfter, place, aboveBefore, aboveThere, aboveAfter }));
  }
  here.row = row;
  here.first = first;
  here.second = second;
  here.above = above;
}

// Calls walk(kind) for the kind of a strip.
template <class Walk>
HWY_INLINE void WithKind(const Strip& strip, Walk&& walk)
{
  if (strip.rows == 1)
  {
    walk(StripKind<1, false>());
  }
  else if (strip.allCross)
  {
    walk(StripKind<1, true, true>());
  }
  else if (strip.farRows == 1)
  {
    walk(StripKind<1>());
  }
  else if (strip.farRows == 2)
  {
    walk(StripKind<2>());
  }
  else
  {
    walk(StripKind<3>());
  }
}

// How to walk through strips.
struct StripWalk
{
  const Strip* strips;
  int count;
  bool starting; // whether some rays start in them
  float bow;     // no patch rises further above a line between its ends, nor does rounding
  float above;   // rays that begin higher are above the ground
  float below;   // rays that begin lower are inside
};

// Walks through some strips with the rays of a tile. Returns with how many.
template <Aside Way, bool Starting>
int WalkStrips(const HeightView<float>& heights, const StripWalk& walk, StripTile& tile)
{
  const Tag tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const Strip& begin = walk.strips[0];
  int walked = 0;
  for (int at = 0; at < StripTile::Size; at += lanes)
  {
    if (tile.rays[at] == 0 || tile.lowest[at] > walk.above)
    {
      continue;
    }
    if (tile.highest[at] < walk.below)
    {
      const Vector whole = hn::Set(tag, static_cast<float>(walk.count));
      hn::Store(hn::Add(hn::Load(tag, tile.inside + at), whole), tag, tile.inside + at);
      continue;
    }
    walked += tile.rays[at];
    const float* sample = heights.data + (tile.y0 + at / StripTile::Width) * heights.stepY +
      tile.x0 + at % StripTile::Width;
    const Vector base = hn::Load(tag, tile.base + at);
    const Vector slope = hn::Load(tag, tile.slope + at);
    const Vector shift = hn::Load(tag, tile.shift + at);
    const Vector climb = hn::Load(tag, tile.climb + at);
    const Vector drop = hn::Load(tag, tile.drop + at);
    const Vector across = hn::Load(tag, tile.across + at);
    const Vector back = hn::Load(tag, tile.back + at);
    const StripRays rays = { base, slope, shift, climb, drop, across, back };
    Vector inside = hn::Load(tag, tile.inside + at);
    const Vector line = hn::Set(tag, static_cast<float>(begin.line));
    const Vector place = hn::MulAdd(slope, line, shift);
    Vector row;
    Vector first;
    Vector second;
    SamplesOn(begin.rows, sample + begin.near, tile.lateral, static_cast<float>(begin.row), place,
      first, second, row);
    Vector above = AboveBetween<Starting>(rays, first, second, place, row, line);
    const LinePlace here = { row, first, second, above };
    for (int k = 0; k < walk.count; ++k)
    {
      const Strip& strip = walk.strips[k];
      WithKind(strip,
        [&](auto kind) {
          CrossStrip<Way, Starting>(kind, tile, at, strip, sample, walk.bow, rays, here, inside);
        });
    }
    hn::Store(inside, tag, tile.inside + at);
  }
  return walked;
}

int WalkStrips(const HeightView<float>& heights, const StripWalk& walk, StripTile& tile)
{
  if (walk.starting)
  {
    return WalkStrips<Aside::Either, true>(heights, walk, tile);
  }
  return tile.slopeLo >= 0.0 ? WalkStrips<Aside::Up, false>(heights, walk, tile)
    : tile.slopeHi <= 0.0    ? WalkStrips<Aside::Down, false>(heights, walk, tile)
                             : WalkStrips<Aside::Either, false>(heights, walk, tile);
}

}
}
HWY_AFTER_NAMESPACE();

#endif
