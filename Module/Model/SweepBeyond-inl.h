// SPDX-License-Identifier: BSD-3-Clause
// Included once for each instruction set, hence the guard that toggles.
#if defined(SweepBeyond_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef SweepBeyond_inl_h
#undef SweepBeyond_inl_h
#else
#define SweepBeyond_inl_h
#endif

#include "SweepTile-inl.h"

#include <algorithm>
#include <cstddef>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace relief
{
namespace HWY_NAMESPACE
{

// The ray from below a sample, as the text takes it.
HWY_INLINE f32::ReliefRay RayFrom(
  const SweepThickness::Plan& plan, int i, int j, float base, float sink)
{
  f32::ReliefRay ray = {};
  ray.i = i;
  ray.j = j;
  ray.base = base;
  ray.sink = sink;
  ray.dx = plan.dx;
  ray.dy = plan.dy;
  ray.dz = plan.dz;
  ray.end = std::numeric_limits<float>::infinity();
  return ray;
}

HWY_INLINE f32::ReliefRay RayOf(const SweepThickness::Plan& plan, const Tile& tile, int at)
{
  return RayFrom(plan, tile.x0 + at % SweepThickness::TileWidth,
    tile.y0 + at / SweepThickness::TileWidth, tile.base[at], plan.medium.depth + tile.more[at]);
}

// How far a ray has come where it enters a cell, and the axis whose grid line it crosses there.
struct Entry
{
  float distance;
  int axis;
};

HWY_INLINE Entry EntryOf(const Crossings& crossings, float index)
{
  const std::size_t k = static_cast<std::size_t>(index);
  if (k >= crossings.GetCells().size())
  {
    return { crossings.GetGroups().back().distance, crossings.GetLastAxis() };
  }
  return { crossings.GetCells()[k].distance, crossings.GetCells()[k].axis };
}

// Whether a ray has left data inside, so that what it has of the ground beyond is not known. Above
// a floor that is level.
HWY_INLINE bool IsOpen(const SweepThickness::Plan& plan, const Tile& tile, int at)
{
  return tile.left[at] >= 0.0f && !plan.medium.useFloor &&
    f32::reliefAbove(RayOf(plan, tile, at), tile.ground[at] - tile.base[at],
      EntryOf(plan.crossings, tile.left[at]).distance) > 0.0f;
}

// Adds what is left of rays that have left the image before a cell, under level ground.
void AddLevelRest(const SweepThickness::Plan& plan, const Crossings::Group& group, Tile& tile)
{
  for (int at = 0; at < SweepThickness::TileSize; ++at)
  {
    if (!(tile.left[at] >= 0.0f))
    {
      tile.left[at] = static_cast<float>(group.begin);
      tile.kept[at] = tile.thickness[at];
    }
    const float above = tile.ground[at] - tile.base[at];
    // Most have come out of the ground before.
    if (plan.dz > 0.0f && above + (plan.medium.depth + tile.more[at]) < group.distance * plan.dz)
    {
      continue;
    }
    const float from =
      plan.medium.useFloor ? std::max(group.distance, tile.from[at]) : group.distance;
    tile.thickness[at] += f32::reliefLevelLength(from, std::numeric_limits<float>::infinity(),
      f32::reliefAbove(RayOf(plan, tile, at), above, 0.0f), plan.dz);
  }
}

// Where rays have left the data for good, the ground goes on as it came.
void GoOn(const SweepThickness::Plan& plan, Tile& tile)
{
  const Field<float>& field = plan.field->GetField();
  for (int at = 0; at < SweepThickness::TileSize; ++at)
  {
    if (!(tile.left[at] >= 0.0f))
    {
      continue;
    }
    const Entry entry = EntryOf(plan.crossings, tile.left[at]);
    const float ground = tile.ground[at] - tile.base[at];
    const float sink = plan.medium.depth + tile.more[at];
    if (!(ground - (entry.distance * plan.dz - sink) > 0.0f))
    {
      continue;
    }
    const f32::ReliefRay ray = RayOf(plan, tile, at);
    const float above = f32::reliefAbove(ray, ground, entry.distance);
    if (above > 0.0f && f32::reliefNeverReturns(field, ray, entry.distance, entry.axis))
    {
      tile.thickness[at] = tile.kept[at] +
        f32::reliefBeyond(field, plan.medium, ray, entry.distance, entry.axis, above);
    }
  }
}

}
}
HWY_AFTER_NAMESPACE();

#endif
