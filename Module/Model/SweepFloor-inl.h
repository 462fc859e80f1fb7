// SPDX-License-Identifier: BSD-3-Clause
// Included once for each instruction set, hence the guard that toggles.
#if defined(SweepFloor_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef SweepFloor_inl_h
#undef SweepFloor_inl_h
#else
#define SweepFloor_inl_h
#endif

#include "SweepTile-inl.h"

#include <limits>

HWY_BEFORE_NAMESPACE();
namespace relief
{
namespace HWY_NAMESPACE
{

// The least and the greatest length at which a tile's rays come out of the floor.
struct FloorExits
{
  float first;
  float last;
};

// Finds where the rays of a tile come out of the floor: at their starts if these lie above it, and
// nowhere if that is above everything.
HWY_INLINE FloorExits FindFloorExits(const SweepThickness::Plan& plan, Tile& tile)
{
  const Tag tag;
  const Vector infinity = hn::Set(tag, std::numeric_limits<float>::infinity());
  const Vector depth = hn::Set(tag, plan.medium.depth);
  Vector first = infinity;
  Vector last = hn::Zero(tag);
  for (int at = 0; at < SweepThickness::TileSize; at += static_cast<int>(hn::Lanes(tag)))
  {
    const Vector base = hn::Load(tag, tile.base + at);
    Vector from;
    Vector to;
    lanes::reliefStretch(true, hn::Set(tag, plan.medium.floorHeight),
      hn::Set(tag, plan.field->GetTop()), base, hn::Add(depth, hn::Load(tag, tile.more + at)),
      hn::Set(tag, plan.dz), infinity, from, to);
    from = hn::IfThenElse(hn::Lt(from, to), from, infinity);
    hn::Store(from, tag, tile.from + at);
    const Mask missing = hn::IsNaN(base);
    first = hn::IfThenElse(missing, first, hn::Min(first, from));
    last = hn::IfThenElse(missing, last, hn::Max(last, from));
  }
  return { hn::GetLane(hn::MinOfLanes(tag, first)), hn::GetLane(hn::MaxOfLanes(tag, last)) };
}

// How much of a stretch of rays is under the floor.
HWY_INLINE Vector UnderFloor(Tag tag, Vector from, float entry, float length)
{
  const Vector before = hn::Max(hn::Sub(from, hn::Set(tag, entry)), hn::Zero(tag));
  return hn::Min(before, hn::Set(tag, length));
}

// Makes of what rays have of a cell of this length, as InsideShare() takes it, what they have of it
// beyond a first part that is `under` the floor.
HWY_INLINE void ComeOut(Tag tag, Vector under, float length, Vector b, Vector marginB, Vector& a,
  Vector& c, Vector& marginA)
{
  const Vector one = hn::Set(tag, 1.0f);
  // A cell that is only touched may have no length.
  const float inverse = length > 0.0f ? 1.0f / length : 0.0f;
  const Vector u = hn::Min(hn::Mul(under, hn::Set(tag, inverse)), one);
  const Vector rest = hn::Sub(one, u);
  a = hn::NegMulAdd(hn::Mul(c, u), rest, hn::MulAdd(hn::Sub(b, a), u, a));
  c = hn::Mul(c, hn::Mul(rest, rest));
  marginA = hn::MulAdd(hn::Sub(marginB, marginA), u, marginA);
}

}
}
HWY_AFTER_NAMESPACE();

#endif
