// SPDX-License-Identifier: BSD-3-Clause
#include "SweepThickness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "SweepThickness.cxx"
#include <hwy/foreach_target.h>

// After the loop over the targets, which defines for which one this is.
#include "SweepTrace-inl.h"

HWY_BEFORE_NAMESPACE();
namespace relief
{
namespace HWY_NAMESPACE
{

const char* TargetName()
{
  return hwy::TargetName(HWY_TARGET);
}

}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace relief
{
HWY_EXPORT(TraceTile);
HWY_EXPORT(IlluminateContacts);
HWY_EXPORT(IlluminateReciprocal);
HWY_EXPORT(TargetName);

bool SweepThickness::Applies(const f64::ReliefMedium& medium, const Light& light)
{
  bool vertical = std::abs(light.vector.x) < f64::RELIEF_ALONG_AXIS &&
    std::abs(light.vector.y) < f64::RELIEF_ALONG_AXIS;
  return !light.positional && light.vector.z >= 0.0 && !vertical &&
    medium.offset != f64::RELIEF_SURFACE_NORMAL;
}

std::unique_ptr<SweepThickness> SweepThickness::MakeWhereItApplies(
  const HeightField& field, const f64::ReliefMedium& medium, const Light& light, std::size_t& taken)
{
  if (!field.GetMissingRow() || !Applies(medium, light) || taken >= MostMemory)
  {
    return nullptr;
  }
  auto sweep = std::make_unique<SweepThickness>(field, medium, light);
  taken += sweep->GetMemorySize();
  return sweep;
}

namespace
{
// Greatest less least height, and t.
double ReliefOf(const HeightField& field, const f32::ReliefMedium& medium)
{
  return double(field.GetTop()) - field.GetBottom() + medium.depth;
}

std::vector<SweepThickness::Step> ListSteps(
  const Crossings& crossings, const f32::ReliefMedium& medium, std::ptrdiff_t pitch)
{
  auto marginAt = [&](float rise) { return f32::RELIEF_ROUNDING * (rise + 2.0f * medium.depth); };
  std::vector<SweepThickness::Step> steps;
  steps.reserve(crossings.GetCells().size() + 1);
  SweepThickness::Step start = {};
  start.rise = -medium.depth;
  start.margin = marginAt(start.rise);
  steps.push_back(start);
  for (const Crossings::Cell& cell : crossings.GetCells())
  {
    steps.push_back({ cell.firstY * pitch + cell.firstX, cell.secondY * pitch + cell.secondX,
      cell.y * pitch + cell.x, cell.weight, cell.distance, cell.length, cell.rise, cell.bend,
      marginAt(cell.rise) });
  }
  return steps;
}

SweepThickness::Plan MakePlan(
  const HeightField& field, const f32::ReliefMedium& medium, const Light& light)
{
  const HeightView<float>& heights = field.GetField().heights;
  const double dx = f64::reliefAlong(light.vector.x, heights.spacingX);
  const double dy = f64::reliefAlong(light.vector.y, heights.spacingY);
  const double dz = light.vector.z;
  // From a corner of the image to the opposite one, or to where the lowest ray is above everything.
  const double infinity = std::numeric_limits<double>::infinity();
  double end = std::min(dx != 0.0 ? heights.columns / std::abs(dx) : infinity,
    dy != 0.0 ? heights.rows / std::abs(dy) : infinity);
  const double deepest =
    ReliefOf(field, medium) + (medium.offset == f32::RELIEF_TANGENT_PLANE ? medium.depth : 0.0);
  end = dz > 0.0 ? std::min(end, deepest / dz) : end;
  Crossings crossings(dx, dy, dz, medium.depth, end, heights.columns + SweepThickness::TileWidth);
  std::vector<SweepThickness::Step> steps = ListSteps(crossings, medium, heights.stepY);
  return { &field, medium, static_cast<float>(dx), static_cast<float>(dy), static_cast<float>(dz),
    std::move(crossings), std::move(steps) };
}
}

SweepThickness::SweepThickness(
  const HeightField& field, const f64::ReliefMedium& medium, const Light& light)
  : Source(light)
  , Extreme(IsExtreme(ReliefOf(field, relief::ToSingle(medium))))
  , Prepared(MakePlan(field, relief::ToSingle(medium), light))
{
}

void SweepThickness::IlluminateTile(int column, int row, float* d, float* r, RayCount& count) const
{
  if (this->Extreme)
  {
    const HeightView<float>& heights = this->Prepared.field->GetField().heights;
    for (int j = 0; j < TileHeight && row * TileHeight + j < heights.rows; ++j)
    {
      RowRequest<float> request;
      request.j = row * TileHeight + j;
      request.begin = column * TileWidth;
      request.end = std::min(request.begin + TileWidth, heights.columns);
      request.illumination = d + j * TileWidth;
      request.thickness = r ? r + j * TileWidth : nullptr;
      TraceRow<float>(
        this->Prepared.field->GetField(), this->Prepared.medium, this->Source, request, count);
    }
    return;
  }
  // Aligned for any of the instruction sets.
  alignas(TileWidth * sizeof(float)) float thickness[TileSize];
  alignas(TileWidth * sizeof(float)) float restOf[TileSize];
  const f32::ReliefMedium& medium = this->Prepared.medium;
  const bool stopped = HWY_DYNAMIC_DISPATCH(TraceTile)(
    this->Prepared, column * TileWidth, row * TileHeight, thickness, restOf, count);
  const float* rest = stopped ? restOf : nullptr;
  if (medium.attenuation == f32::RELIEF_RECIPROCAL && medium.depth > 0.0f)
  {
    HWY_DYNAMIC_DISPATCH(IlluminateReciprocal)(medium.depth, TileSize, thickness, rest, d);
  }
  else if (medium.attenuation == f32::RELIEF_RECIPROCAL)
  {
    // Rays that stopped before their end are in the dark, whatever is left of them.
    HWY_DYNAMIC_DISPATCH(IlluminateContacts)
    (this->Prepared, column * TileWidth, row * TileHeight, thickness, d);
  }
  else
  {
    for (int at = 0; at < TileSize; ++at)
    {
      d[at] = f32::reliefIllumination(medium, thickness[at]);
      if (rest && rest[at] > 0.0f)
      {
        d[at] = (d[at] + f32::reliefIllumination(medium, thickness[at] + rest[at])) / 2.0f;
      }
    }
  }
  if (r)
  {
    std::copy_n(thickness, TileSize, r);
  }
}

const char* SweepThickness::GetTargetName()
{
  return HWY_DYNAMIC_DISPATCH(TargetName)();
}

}

#endif
