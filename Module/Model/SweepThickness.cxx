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

// Bounds of the cells that a group's rays from the samples [x0, x1] x [y0, y1] run through, as far
// as they are in the image. Returns how much of them is: 0 nothing, 1 a part, 2 all.
HWY_INLINE int GroupBounds(const SweepThickness::Plan& plan, const SweepThickness::Group& group,
  int level, int x0, int x1, int y0, int y1, MinMaxPyramid::Bounds& found)
{
  const HeightView<float>& heights = plan.field->GetField().heights;
  const MinMaxPyramid& bounds = plan.field->GetPyramid();
  const int lastX = heights.columns - 2;
  const int lastY = heights.rows - 2;
  const int i0 = x0 + group.x0;
  const int i1 = x1 + group.x1;
  const int j0 = y0 + group.y0;
  const int j1 = y1 + group.y1;
  if (i1 < 0 || i0 > lastX || j1 < 0 || j0 > lastY)
  {
    return 0;
  }
  level = std::min(level, bounds.GetNumberOfLevels() - 1);
  found =
    bounds.Over(level, std::max(i0, 0), std::min(i1, lastX), std::max(j0, 0), std::min(j1, lastY));
  return i0 >= 0 && i1 <= lastX && j0 >= 0 && j1 <= lastY ? 2 : 1;
}

// How much of each ray is left to where it rises above everything.
HWY_INLINE Vector RestOf(Tag tag, const SweepThickness::Plan& plan, float distance, Vector base)
{
  const Vector top = hn::Set(tag, plan.field->GetTop() + plan.medium.depth);
  const Vector whole = hn::Mul(hn::Sub(top, base), hn::Set(tag, 1.0f / plan.dz));
  return hn::Max(hn::Sub(whole, hn::Set(tag, distance)), hn::Zero(tag));
}

void MeasureRest(const SweepThickness::Plan& plan, float distance, const Tile& tile, float* rest)
{
  const Tag tag;
  for (int at = 0; at < SweepThickness::TileSize; at += static_cast<int>(hn::Lanes(tag)))
  {
    hn::Store(RestOf(tag, plan, distance, hn::Load(tag, tile.base + at)), tag, rest + at);
  }
}

// Whether d is within the tolerance for every sample, however much of the rest is inside.
bool IsSettled(const SweepThickness::Plan& plan, float distance, const Tile& tile)
{
  const Tag tag;
  const Settler settler(plan.medium);
  for (int at = 0; at < SweepThickness::TileSize; at += static_cast<int>(hn::Lanes(tag)))
  {
    const Vector rest = RestOf(tag, plan, distance, hn::Load(tag, tile.base + at));
    // Samples without data compare false and so are never open.
    if (!hn::AllFalse(tag, settler.Open(tag, hn::Load(tag, tile.thickness + at), rest)))
    {
      return false;
    }
  }
  return true;
}

// Adds what is left of rays that have left the image, under level ground.
void AddLevelRest(const SweepThickness::Plan& plan, float distance, Tile& tile)
{
  const float margin = f32::RELIEF_ROUNDING * plan.medium.depth; // as reliefAbove() has it
  for (int at = 0; at < SweepThickness::TileSize; ++at)
  {
    const float above = tile.ground[at] - tile.base[at] + plan.medium.depth;
    tile.thickness[at] += f32::reliefLevelLength(distance, std::numeric_limits<float>::infinity(),
      std::abs(above) <= margin ? 0.0f : above, plan.dz);
  }
}

// Fills the thicknesses of a tile. Returns whether the rays stopped before their end: then `rest`
// is filled too. Both arrays are aligned.
bool TraceTile(
  const SweepThickness::Plan& plan, int x0, int y0, float* thickness, float* rest, RayCount& count)
{
  const Tag tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const HeightField& field = *plan.field;
  const HeightView<float>& heights = field.GetField().heights;
  const Rows rows = { heights.data, heights.stepY, field.GetMissingRow(), heights.rows };
  const float infinity = std::numeric_limits<float>::infinity();

  Tile tile;
  tile.thickness = thickness;
  tile.x0 = x0;
  tile.y0 = y0;
  tile.rows = std::min(SweepThickness::TileHeight, heights.rows - y0);
  const int x1 = std::min(x0 + SweepThickness::TileWidth, heights.columns) - 1;
  const int y1 = y0 + tile.rows - 1;
  Vector low = hn::Set(tag, infinity);
  Vector high = hn::Set(tag, -infinity);
  std::size_t samples = 0;
  for (int row = 0; row < SweepThickness::TileHeight; ++row)
  {
    const float* own = rows(y0 + row) + x0;
    for (int column = 0; column < SweepThickness::TileWidth; column += lanes)
    {
      const int at = row * SweepThickness::TileWidth + column;
      const Vector base = hn::LoadU(tag, own + column);
      hn::Store(base, tag, tile.base + at);
      hn::Store(base, tag, tile.surface + at);
      hn::Store(base, tag, tile.ground + at);
      hn::Store(hn::Zero(tag), tag, tile.thickness + at);
      const Mask missing = hn::IsNaN(base);
      low = hn::IfThenElse(missing, low, hn::Min(low, base));
      high = hn::IfThenElse(missing, high, hn::Max(high, base));
      samples += static_cast<std::size_t>(lanes) - hn::CountTrue(tag, missing);
    }
  }
  const float lowest = hn::GetLane(hn::MinOfLanes(tag, low));
  const float highest = hn::GetLane(hn::MaxOfLanes(tag, high));
  count.rays += samples;

  bool current = true;  // surface and ground belong to the crossing before the group
  bool holding = false; // some ray may hold its ground
  float held = highest; // no ray's ground is higher, once rays have left the image
  const int groups = samples > 0 ? static_cast<int>(plan.groups.size()) : 0;
  for (int g = 0; g < groups; ++g)
  {
    const SweepThickness::Group& group = plan.groups[g];
    if (lowest + group.riseIn > field.GetTop())
    {
      break;
    }
    MinMaxPyramid::Bounds bounds;
    if (g % SweepThickness::SpanSize == 0 && plan.dz > 0.0f && g > 0)
    {
      if (plan.medium.tolerance > 0.0f && IsSettled(plan, group.distance, tile))
      {
        MeasureRest(plan, group.distance, tile, rest);
        return true;
      }
      const SweepThickness::Group& span = plan.spans[g / SweepThickness::SpanSize];
      ++count.cells;
      if (GroupBounds(plan, span, 2, x0, x1, y0, y1, bounds) == 2 &&
        bounds.hi < lowest + span.riseIn)
      {
        current = false;
        holding = false;
        g += SweepThickness::SpanSize - 1;
        continue;
      }
    }
    const int inImage = GroupBounds(plan, group, 1, x0, x1, y0, y1, bounds);
    ++count.cells;
    if (inImage == 0)
    {
      if (!current)
      {
        Resume(plan, rows, group.begin - 1, tile);
      }
      AddLevelRest(plan, group.distance, tile);
      break;
    }
    if (bounds.hi < lowest + group.riseIn && (inImage == 2 || held < lowest + group.riseIn))
    {
      current = false;
      holding = inImage != 2;
      continue;
    }
    if (inImage == 2 && bounds.lo > highest + group.riseOut + MarginAt(plan, group.riseOut))
    {
      const Vector length = hn::Set(tag, group.length);
      for (int at = 0; at < SweepThickness::TileSize; at += lanes)
      {
        hn::Store(hn::Add(hn::Load(tag, tile.thickness + at), length), tag, tile.thickness + at);
      }
      current = false;
      holding = false;
      continue;
    }
    if (!current)
    {
      Resume(plan, rows, group.begin - 1, tile);
      current = true;
    }
    count.cells += samples * static_cast<std::size_t>(group.end - group.begin);
    const bool whole = inImage == 2 && bounds.lo > -infinity;
    if (whole && !(holding && plan.cells[group.begin].touches))
    {
      WalkWholeCells(plan, group, bounds.twist, tile);
      holding = false;
      continue;
    }
    WalkCells(plan, rows, group, tile);
    holding = !whole;
    if (inImage == 1)
    {
      held = -infinity;
      for (float ground : tile.ground)
      {
        held = ground > held ? ground : held;
      }
    }
  }
  return false;
}

// d of a tile of thicknesses by the reciprocal attenuation; `rest` may be null.
void IlluminateReciprocal(float depth, const float* thickness, const float* rest, float* d)
{
  const Tag tag;
  const Vector t = hn::Set(tag, depth);
  const int lanes = static_cast<int>(hn::Lanes(tag));
  for (int at = 0; at < SweepThickness::TileSize; at += lanes)
  {
    const Vector r = hn::Load(tag, thickness + at);
    Vector result = hn::Div(t, hn::Max(r, t));
    if (rest)
    {
      const Vector low = hn::Div(t, hn::Max(hn::Add(r, hn::Load(tag, rest + at)), t));
      result = hn::Mul(hn::Add(result, low), hn::Set(tag, 0.5f));
    }
    hn::StoreU(result, tag, d + at);
  }
}

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
HWY_EXPORT(IlluminateReciprocal);
HWY_EXPORT(TargetName);

namespace
{
// As the model takes directions along an axis.
constexpr double AlongAxis = 1.0e-12;
}

bool SweepThickness::Applies(const f64::ReliefMedium& medium, const Light& light)
{
  bool vertical = std::abs(light.vector.x) < AlongAxis && std::abs(light.vector.y) < AlongAxis;
  return !light.positional && light.vector.z >= 0.0 && !vertical && !medium.useFloor &&
    medium.offset == f64::RELIEF_VERTICAL;
}

SweepThickness::SweepThickness(
  const HeightField& field, const f64::ReliefMedium& medium, const Light& light)
  : Source(light)
{
  const HeightView<float>& heights = field.GetField().heights;
  this->AlongY = std::abs(light.vector.x) < AlongAxis;
  this->AlongX = std::abs(light.vector.y) < AlongAxis;
  const double dx = this->AlongY ? 0.0 : light.vector.x / heights.spacingX;
  const double dy = this->AlongX ? 0.0 : light.vector.y / heights.spacingY;
  const double dz = light.vector.z;
  this->Prepared.field = &field;
  this->Prepared.medium = relief::ToSingle(medium);
  const double depth = this->Prepared.medium.depth;
  const double relief = double(field.GetTop()) - field.GetBottom() + depth;
  this->Extreme = IsExtreme(relief);
  this->Prepared.dz = static_cast<float>(dz);

  // From a corner of the image to the opposite one, or to where the lowest ray is above everything.
  const double infinity = std::numeric_limits<double>::infinity();
  double end = std::min(dx != 0.0 ? heights.columns / std::abs(dx) : infinity,
    dy != 0.0 ? heights.rows / std::abs(dy) : infinity);
  if (dz > 0.0)
  {
    end = std::min(end, relief / dz);
  }

  int x = dx < 0.0 ? -1 : 0;
  int y = dy < 0.0 ? -1 : 0;
  double s = 0.0;
  while (s < end)
  {
    const double exitX = dx != 0.0 ? (dx > 0.0 ? x + 1 : x) / dx : infinity;
    const double exitY = dy != 0.0 ? (dy > 0.0 ? y + 1 : y) / dy : infinity;
    const bool throughX = exitX <= exitY;
    const double next = std::max(throughX ? exitX : exitY, s);
    Cell cell;
    cell.x = x;
    cell.y = y;
    cell.firstX = cell.secondX = throughX && dx > 0.0 ? x + 1 : x;
    cell.firstY = cell.secondY = !throughX && dy > 0.0 ? y + 1 : y;
    ++(throughX ? cell.secondY : cell.secondX);
    const double place = throughX ? dy * next - y : dx * next - x;
    if (place > 0.5)
    {
      // From the nearer sample, as reliefEdgeHeight().
      std::swap(cell.firstX, cell.secondX);
      std::swap(cell.firstY, cell.secondY);
    }
    cell.weight = static_cast<float>(std::max(std::min(place, 1.0 - place), 0.0));
    cell.length = static_cast<float>(next - s);
    cell.touches = next - s <= f64::RELIEF_TOUCH * next;
    cell.rise = static_cast<float>(next * dz - depth);
    // A bow that the rounding of heights hides is none: whether its square vanishes, too, would
    // depend on the unit of length.
    const double bend = dx * (next - s) * dy * (next - s);
    cell.bend =
      std::abs(bend) < std::numeric_limits<float>::epsilon() ? 0.0f : static_cast<float>(bend);
    if (this->Prepared.cells.size() % GroupSize == 0)
    {
      Group group = { static_cast<int>(this->Prepared.cells.size()), 0, x, x, y, y,
        static_cast<float>(s * dz - depth), 0.0f, 0.0f, static_cast<float>(s) };
      this->Prepared.groups.push_back(group);
    }
    this->Prepared.cells.push_back(cell);
    Group& group = this->Prepared.groups.back();
    group.end = static_cast<int>(this->Prepared.cells.size());
    group.x0 = std::min(group.x0, x);
    group.x1 = std::max(group.x1, x);
    group.y0 = std::min(group.y0, y);
    group.y1 = std::max(group.y1, y);
    group.riseOut = cell.rise;
    group.length = static_cast<float>(next - group.distance);
    s = next;
    (throughX ? x : y) += (throughX ? dx : dy) > 0.0 ? 1 : -1;
  }
  // After the last cell every ray is outside or above everything: one more group says so.
  Group last = { static_cast<int>(this->Prepared.cells.size()),
    static_cast<int>(this->Prepared.cells.size()), heights.columns + TileWidth,
    heights.columns + TileWidth, 0, 0, static_cast<float>(s * dz - depth), 0.0f, 0.0f,
    static_cast<float>(s) };
  this->Prepared.groups.push_back(last);

  for (std::size_t g = 0; g < this->Prepared.groups.size(); g += SpanSize)
  {
    Group span = this->Prepared.groups[g];
    for (std::size_t k = g; k < std::min(g + SpanSize, this->Prepared.groups.size()); ++k)
    {
      const Group& group = this->Prepared.groups[k];
      span.end = group.end;
      span.x0 = std::min(span.x0, group.x0);
      span.x1 = std::max(span.x1, group.x1);
      span.y0 = std::min(span.y0, group.y0);
      span.y1 = std::max(span.y1, group.y1);
    }
    this->Prepared.spans.push_back(span);
  }
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
    HWY_DYNAMIC_DISPATCH(IlluminateReciprocal)(medium.depth, thickness, rest, d);
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
  this->FixLastLine(column, row, d, r, count);
}

// What lockstep does not say of single samples. A ray along the last grid line belongs to the last
// cell, while its neighbours' belong to the cell after their line; and the limit for depth 0.
void SweepThickness::FixLastLine(int column, int row, float* d, float* r, RayCount& count) const
{
  const Field<float>& field = this->Prepared.field->GetField();
  const f32::ReliefMedium& medium = this->Prepared.medium;
  const int lastX = field.heights.columns - 1;
  const int lastY = field.heights.rows - 1;
  const bool contact = medium.depth == 0.0f && medium.attenuation == f32::RELIEF_RECIPROCAL;
  const bool lastColumn = this->AlongY && lastX / TileWidth == column;
  const bool lastRow = this->AlongX && lastY / TileHeight == row;
  if (!contact && !lastColumn && !lastRow)
  {
    return;
  }
  for (int at = 0; at < TileSize; ++at)
  {
    const int i = column * TileWidth + at % TileWidth;
    const int j = row * TileHeight + at / TileWidth;
    const bool onLastLine = (lastColumn && i == lastX) || (lastRow && j == lastY);
    if (i > lastX || j > lastY || (!onLastLine && !(contact && d[at] == 1.0f)))
    {
      continue;
    }
    RowRequest<float> request;
    request.j = j;
    request.begin = i;
    request.end = i + 1;
    request.illumination = d + at;
    request.thickness = r ? r + at : nullptr;
    RayCount again;
    TraceRow<float>(field, medium, this->Source, request, again);
    count.cells += again.cells;
  }
}

const char* SweepThickness::GetTargetName()
{
  return HWY_DYNAMIC_DISPATCH(TargetName)();
}

}

#endif
