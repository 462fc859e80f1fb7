// SPDX-License-Identifier: BSD-3-Clause
// Included once for each instruction set, hence the guard that toggles.
#if defined(SweepTrace_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef SweepTrace_inl_h
#undef SweepTrace_inl_h
#else
#define SweepTrace_inl_h
#endif

#include "SweepBeyond-inl.h"
#include "SweepCells-inl.h"
#include "SweepContact-inl.h"

#include <algorithm>
#include <cstddef>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace relief
{
namespace HWY_NAMESPACE
{

// How much of something is in the image.
enum class InImage
{
  Nothing,
  Part,
  All
};

// How much of each ray can still be inside: what is left to where it rises above everything; twice
// as much where the ground goes on beyond the data, for it may be half as steep as the ray.
HWY_INLINE Vector RestOf(
  Tag tag, const SweepThickness::Plan& plan, float distance, const Tile& tile, int at)
{
  const Vector top = hn::Set(tag, plan.field->GetTop() + plan.medium.depth);
  const Vector whole =
    hn::Mul(hn::Add(hn::Sub(top, hn::Load(tag, tile.base + at)), hn::Load(tag, tile.more + at)),
      hn::Set(tag, 1.0f / plan.dz));
  const Vector rest = hn::Sub(whole, hn::Set(tag, distance));
  return hn::Max(plan.medium.useFloor ? rest : hn::Add(rest, rest), hn::Zero(tag));
}

void MeasureRest(const SweepThickness::Plan& plan, float distance, const Tile& tile, float* rest)
{
  const Tag tag;
  for (int at = 0; at < SweepThickness::TileSize; at += static_cast<int>(hn::Lanes(tag)))
  {
    hn::Store(hn::Add(RestOf(tag, plan, distance, tile, at), hn::Load(tag, tile.unknown + at)), tag,
      rest + at);
  }
}

// Whether d is within the tolerance for every sample, however much of the rest is inside.
bool IsSettled(const SweepThickness::Plan& plan, float distance, const Tile& tile, bool anyLeft)
{
  const Tag tag;
  const Settler settler(plan.medium);
  for (int at = 0; at < SweepThickness::TileSize; at += static_cast<int>(hn::Lanes(tag)))
  {
    const Vector rest =
      hn::Add(RestOf(tag, plan, distance, tile, at), hn::Load(tag, tile.unknown + at));
    // Samples without data compare false and so are never open.
    if (!hn::AllFalse(tag, settler.Open(tag, hn::Load(tag, tile.thickness + at), rest)))
    {
      return false;
    }
  }
  for (int at = 0; anyLeft && at < SweepThickness::TileSize; ++at)
  {
    if (IsOpen(plan, tile, at))
    {
      return false;
    }
  }
  return true;
}

// Adds a group's cells that are all inside.
void AddWhole(const Crossings::Group& group, bool floored, Tile& tile)
{
  const Tag tag;
  const Vector length = hn::Set(tag, group.length);
  for (int at = 0; at < SweepThickness::TileSize; at += static_cast<int>(hn::Lanes(tag)))
  {
    const Vector under = floored
      ? UnderFloor(tag, hn::Load(tag, tile.from + at), group.distance, group.length)
      : hn::Zero(tag);
    hn::Store(hn::Add(hn::Load(tag, tile.thickness + at), hn::Sub(length, under)), tag,
      tile.thickness + at);
  }
}

// The sweep of a tile: takes its rays through the groups of cells, one after the other.
class TileSweep
{
public:
  TileSweep(const SweepThickness::Plan& plan, int x0, int y0, float* thickness, RayCount& count);

  // Fills the thicknesses. Returns whether the rays stopped before their end: then `rest` is filled
  // too.
  bool Run(float* rest);

private:
  InImage FindBounds(const Crossings::Group& group, int size, MinMaxPyramid::Bounds& found) const;
  int SkipSpans(int g);
  bool IsBelow(const Crossings::Group& span, int size);
  bool Take(const Crossings::Group& group);
  void Walk(const Crossings::Group& group, bool floored, InImage inImage, bool whole);
  void Skip();
  void Arrive();
  void CatchUp(const Crossings::Group& group);

  const SweepThickness::Plan& Prepared;
  Rows AllRows;
  RayCount& Count;
  Tile Rays;
  Waiting Crossed;
  TileHeights Own;
  FloorExits Exits = {};
  int LastX; // the last sample in the image
  int LastY;
  bool Started = false; // surface and ground are in use
  bool Current = true;  // they belong to the crossing before the group
  bool Holding = false; // some ray may hold its ground
  bool AnyLeft = false; // or is marked to
  float Held;           // no ray's ground is higher, once rays have left the image
};

TileSweep::TileSweep(
  const SweepThickness::Plan& plan, int x0, int y0, float* thickness, RayCount& count)
  : Prepared(plan)
  , AllRows(RowsOf(plan))
  , Count(count)
{
  const HeightView<float>& heights = plan.field->GetField().heights;
  this->Rays.thickness = thickness;
  this->Rays.x0 = x0;
  this->Rays.y0 = y0;
  this->Rays.rows = std::min(SweepThickness::TileHeight, heights.rows - y0);
  this->LastX = std::min(x0 + SweepThickness::TileWidth, heights.columns) - 1;
  this->LastY = y0 + this->Rays.rows - 1;
  this->Own = LoadTile(plan, this->AllRows, this->Rays);
  this->Held = this->Own.highest;
  if (plan.medium.useFloor)
  {
    this->Exits = FindFloorExits(plan, this->Rays);
  }
}

bool TileSweep::Run(float* rest)
{
  const SweepThickness::Plan& plan = this->Prepared;
  this->Count.rays += this->Own.samples;
  const bool meetsNothing =
    this->Own.samples == 0 || this->Exits.first == std::numeric_limits<float>::infinity();
  const int groups = meetsNothing ? 0 : static_cast<int>(plan.crossings.GetGroups().size());
  for (int g = 0; g < groups; ++g)
  {
    const Crossings::Group& group = plan.crossings.GetGroups()[g];
    if (this->Own.lowest + group.riseIn > plan.field->GetTop())
    {
      break;
    }
    if (g % Crossings::SpanSize == 0 && plan.dz > 0.0f && g > 0)
    {
      // What waits makes rays thicker, and so settles them all the more.
      if (plan.medium.tolerance > 0.0f &&
        IsSettled(plan, group.distance, this->Rays, this->AnyLeft))
      {
        this->Crossed.AddTo(this->Rays.thickness);
        MeasureRest(plan, group.distance, this->Rays, rest);
        return true;
      }
      const int skipped = this->SkipSpans(g);
      if (skipped > 0)
      {
        g += skipped - 1;
        continue;
      }
    }
    if (!this->Take(group))
    {
      break;
    }
  }
  this->Crossed.AddTo(this->Rays.thickness);
  if (this->AnyLeft && plan.dz > 0.0f && !plan.medium.useFloor)
  {
    GoOn(plan, this->Rays);
  }
  if (plan.medium.tolerance > 0.0f)
  {
    std::copy_n(this->Rays.unknown, SweepThickness::TileSize, rest);
    return true;
  }
  return false;
}

// Bounds of the cells that the tile's rays run through in a group or a span, as far as they are in
// the image. Returns how much of them is.
InImage TileSweep::FindBounds(
  const Crossings::Group& group, int size, MinMaxPyramid::Bounds& found) const
{
  static_assert(SweepThickness::TileWidth == SweepThickness::TileHeight);
  constexpr int others = SweepThickness::TileWidth - 1;
  static_assert(others + Crossings::BoxSize <= HeightField::GetReach(0));
  static_assert(others + Crossings::SpanSize * Crossings::BoxSize <= HeightField::GetReach(1));
  static_assert(others + Crossings::LongSpanSize * Crossings::BoxSize <= HeightField::GetReach(2));
  const HeightView<float>& heights = this->Prepared.field->GetField().heights;
  const int lastX = heights.columns - 2;
  const int lastY = heights.rows - 2;
  const int i0 = this->Rays.x0 + group.x0;
  const int i1 = this->LastX + group.x1;
  const int j0 = this->Rays.y0 + group.y0;
  const int j1 = this->LastY + group.y1;
  if (lastX < 0 || lastY < 0 || i1 < 0 || i0 > lastX || j1 < 0 || j0 > lastY)
  {
    return InImage::Nothing;
  }
  found = this->Prepared.field->GetSquares(size).From(std::max(i0, 0), std::max(j0, 0));
  return i0 >= 0 && i1 <= lastX && j0 >= 0 && j1 <= lastY ? InImage::All : InImage::Part;
}

// Skips the spans that begin with a group, if they lie below all rays. Returns how many groups.
int TileSweep::SkipSpans(int g)
{
  const Crossings& crossings = this->Prepared.crossings;
  if (g % Crossings::LongSpanSize == 0 &&
    this->IsBelow(crossings.GetLongSpans()[g / Crossings::LongSpanSize], 2))
  {
    this->Skip();
    return Crossings::LongSpanSize;
  }
  if (this->IsBelow(crossings.GetSpans()[g / Crossings::SpanSize], 1))
  {
    this->Skip();
    return Crossings::SpanSize;
  }
  return 0;
}

bool TileSweep::IsBelow(const Crossings::Group& span, int size)
{
  ++this->Count.cells;
  MinMaxPyramid::Bounds bounds;
  return this->FindBounds(span, size, bounds) == InImage::All &&
    bounds.hi < this->Own.lowest + span.riseIn;
}

// Takes the rays through a group. Returns whether anything of the image can be behind it.
bool TileSweep::Take(const Crossings::Group& group)
{
  const SweepThickness::Plan& plan = this->Prepared;
  const bool floored = group.distance < this->Exits.last; // some ray is still under the floor
  MinMaxPyramid::Bounds bounds;
  const InImage inImage = this->FindBounds(group, 0, bounds);
  ++this->Count.cells;
  if (inImage == InImage::Nothing)
  {
    this->CatchUp(group);
    AddLevelRest(plan, group, this->Rays);
    this->AnyLeft = true;
    return false;
  }
  const float lowestIn = this->Own.lowest + group.riseIn;
  if (bounds.hi < lowestIn && (inImage == InImage::All || this->Held < lowestIn))
  {
    this->Current = false;
    this->Holding = true;
    if (inImage == InImage::All)
    {
      this->Arrive();
    }
    return true;
  }
  const float highestOut =
    this->Own.highest + group.riseOut + WidestMargin(plan, MarginAt(plan, group.riseOut));
  if (inImage == InImage::All && bounds.lo > highestOut)
  {
    AddWhole(group, floored, this->Rays);
    this->Skip();
    return true;
  }
  const bool whole = inImage == InImage::All && bounds.lo > -std::numeric_limits<float>::infinity();
  if (whole && !(this->Holding && plan.crossings.GetCells()[group.begin].touches))
  {
    // Nothing is inside under the floor; but what a hole holds there counts later.
    if (!(group.distance + group.length < this->Exits.first))
    {
      this->Count.cells +=
        WalkWholeCells(plan, group, bounds.twist, floored, this->Rays, this->Crossed);
    }
    this->Skip();
    return true;
  }
  this->Walk(group, floored, inImage, whole);
  return true;
}

// Walks a group that is not all in the image, or where there are holes.
void TileSweep::Walk(const Crossings::Group& group, bool floored, InImage inImage, bool whole)
{
  this->CatchUp(group);
  this->Count.cells += this->Own.samples * static_cast<std::size_t>(group.end - group.begin);
  (floored ? WalkCells<true> : WalkCells<false>)(this->Prepared, this->AllRows, group, this->Rays);
  this->AnyLeft = true;
  this->Holding = !whole;
  if (inImage == InImage::Part)
  {
    this->Held = -std::numeric_limits<float>::infinity();
    for (float ground : this->Rays.ground)
    {
      this->Held = ground > this->Held ? ground : this->Held;
    }
  }
}

// After cells that hold nothing; surface and ground are left behind.
void TileSweep::Skip()
{
  this->Current = false;
  this->Arrive();
}

// No ray holds its ground any more.
void TileSweep::Arrive()
{
  if (this->AnyLeft)
  {
    std::fill_n(this->Rays.left, SweepThickness::TileSize, -1.0f);
    this->AnyLeft = false;
  }
  this->Holding = false;
}

// Brings thickness, surface and ground to where a group begins. Few tiles need the last two, and
// what rays hold.
void TileSweep::CatchUp(const Crossings::Group& group)
{
  this->Crossed.AddTo(this->Rays.thickness);
  if (!this->Started)
  {
    std::copy_n(this->Rays.base, SweepThickness::TileSize, this->Rays.surface);
    std::copy_n(this->Rays.base, SweepThickness::TileSize, this->Rays.ground);
    std::fill_n(this->Rays.left, SweepThickness::TileSize, -1.0f);
    std::fill_n(this->Rays.kept, SweepThickness::TileSize, 0.0f);
    this->Started = true;
  }
  if (!this->Current)
  {
    Resume(this->Prepared, this->AllRows, group.begin - 1, this->Rays);
    this->Current = true;
  }
}

// Fills the thicknesses of a tile. Returns whether the rays stopped before their end: then `rest`
// is filled too. Both arrays are aligned.
bool TraceTile(
  const SweepThickness::Plan& plan, int x0, int y0, float* thickness, float* rest, RayCount& count)
{
  TileSweep sweep(plan, x0, y0, thickness, count);
  return sweep.Run(rest);
}

}
}
HWY_AFTER_NAMESPACE();

#endif
