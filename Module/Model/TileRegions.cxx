// SPDX-License-Identifier: BSD-3-Clause
#include "TileRegions.h"

#include "EffectPlan.h"
#include "ReliefModel.h"
#include "SweepThickness.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relief
{

namespace
{
constexpr double Infinity = std::numeric_limits<double>::infinity();

// What integrators look at beside the cells of their rays, in samples: as far back as the largest
// block that they look at below the regions is wide, and as far on as the largest square reaches
// from the block that holds the cell, with the samples that close it.
constexpr double Before = 34.0;
constexpr double Behind = 68.0;
static_assert((1 << (MinMaxPyramid::BlockShift + 3)) <= 32);
static_assert(HeightField::GetReach(2) <= 65);

// How far ahead of a ray they look for what can be skipped.
constexpr double Ahead = 66.0;

// By how much rays of a tile toward a lamp may be ahead of others, and so be looked at together.
constexpr double Apart = 64.0;

// A lamp this near may be anywhere to the samples about it.
constexpr double Near = 512.0;

// So many lights have corridors of their own from each region.
constexpr std::size_t MostTight = 4096;

// Corridors are followed in steps of so many samples.
constexpr double Step = 32.0;

// Rounding of what is above and below.
double Slack(double a, double b)
{
  return 1e-4 * (std::abs(a) + std::abs(b)) + std::numeric_limits<float>::min();
}

constexpr int RegionSize = RasterBounds::RegionSize;

// The region that holds a place, as far as there can be one.
int RegionAt(double place, int regions)
{
  return static_cast<int>(std::floor(std::clamp(place / RegionSize, -2.0, regions + 1.0)));
}
}

TileRegions::TileRegions(const SparseHeights& heights, const Scene& scene)
  : Heights(heights)
  , Bounds(heights.GetBounds())
  , SpacingX(heights.GetField().GetField().heights.spacingX)
  , SpacingY(heights.GetField().GetField().heights.spacingY)
{
  const bool steps = scene.integrator == Integrator::FixedStep;
  // Lights that show nothing may still be a layer.
  for (const LightPlan& plan : PlanEffects(heights.GetField(), scene).lights)
  {
    if (!plan.dark)
    {
      this->AddPath(plan.light, scene.medium, steps);
    }
  }
  const f64::ReliefMedium opaque = { 0.0, f64::RELIEF_VERTICAL, f64::RELIEF_RECIPROCAL, 1.0, false,
    0.0, 0.0 };
  for (const Light& light : scene.sun)
  {
    if (light.vector.z >= 0.0)
    {
      this->AddPath(light, opaque, false);
    }
  }
}

void TileRegions::AddPath(const Light& light, const f64::ReliefMedium& medium, bool steps)
{
  Path path;
  path.positional = light.positional;
  path.x = light.vector.x / this->SpacingX;
  path.y = light.vector.y / this->SpacingY;
  path.z = light.vector.z;
  const bool tangent = medium.offset == f64::RELIEF_TANGENT_PLANE;
  const bool aside = medium.offset == f64::RELIEF_SURFACE_NORMAL;
  path.sink = (tangent ? 2.0 : 1.0) * medium.depth;
  path.asideX = aside ? medium.depth / this->SpacingX + 1.0 : 0.0;
  path.asideY = aside ? medium.depth / this->SpacingY + 1.0 : 0.0;
  path.steps = steps;
  path.floored = medium.useFloor && !steps;
  path.floor = medium.floorHeight;
  path.depth = medium.depth;
  this->Paths.push_back(path);
}

bool TileRegions::IsInImage(const Rectangle& r) const
{
  return r.x1 >= 0.0 && r.x0 <= this->Bounds.GetColumns() - 1.0 && r.y1 >= 0.0 &&
    r.y0 <= this->Bounds.GetRows() - 1.0;
}

// What is looked at where rays run over these samples, as much of it as there is.
RegionSet::Block TileRegions::LookedAt(const Rectangle& r, double more) const
{
  const int columns = this->Bounds.GetRegionColumns();
  const int rows = this->Bounds.GetRegionRows();
  return { std::max(RegionAt(r.x0 - Before - more, columns), 0),
    std::min(RegionAt(r.x1 + Behind + more, columns), columns - 1),
    std::max(RegionAt(r.y0 - Before - more, rows), 0),
    std::min(RegionAt(r.y1 + Behind + more, rows), rows - 1) };
}

// No height of these regions, nor one that a hole holds, is greater.
double TileRegions::HighestIn(const RegionSet::Block& regions) const
{
  double highest = -Infinity;
  for (int j = regions.j0; j <= regions.j1; ++j)
  {
    for (int i = regions.i0; i <= regions.i1; ++i)
    {
      highest = this->Bounds.HasHoles(i, j)
        ? Infinity
        : std::max<double>(highest, this->Bounds.RangeAt(i, j).hi);
    }
  }
  return highest;
}

bool TileRegions::HasHoles(const Rectangle& r) const
{
  const int columns = this->Bounds.GetRegionColumns();
  const int rows = this->Bounds.GetRegionRows();
  const int i1 = std::min(RegionAt(r.x1 + 2.0, columns), columns - 1);
  const int j1 = std::min(RegionAt(r.y1 + 2.0, rows), rows - 1);
  for (int j = std::max(RegionAt(r.y0 - 2.0, rows), 0); j <= j1; ++j)
  {
    for (int i = std::max(RegionAt(r.x0 - 2.0, columns), 0); i <= i1; ++i)
    {
      if (this->Bounds.HasHoles(i, j))
      {
        return true;
      }
    }
  }
  return false;
}

// Whether rays over these samples may leave the data.
bool TileRegions::MeetsEdge(const Rectangle& r) const
{
  return r.x0 < 2.0 || r.y0 < 2.0 || r.x1 > this->Bounds.GetColumns() - 3.0 ||
    r.y1 > this->Bounds.GetRows() - 3.0 || this->HasHoles(r);
}

void TileRegions::AddHoles(const Rectangle& r, Found& found) const
{
  const RegionSet::Block about = this->LookedAt(r, 0.0);
  for (int j = about.j0; j <= about.j1; ++j)
  {
    for (int i = about.i0; i <= about.i1; ++i)
    {
      if (this->Bounds.HasHoles(i, j) || this->Bounds.IsAssumed(i, j))
      {
        // With the samples that close its cells.
        found.read.Add(i - 1, i + 1, j - 1, j + 1);
        found.needed.Add(i - 1, i + 1, j - 1, j + 1);
      }
    }
  }
}

// Of the regions to read, those where rays may leave the data, with the samples that close their
// cells, are needed.
void TileRegions::AddEdges(Found& found) const
{
  const int last[2] = { this->Bounds.GetColumns() - 3, this->Bounds.GetRows() - 3 };
  auto need = [&](int i, int j)
  {
    if (i >= 0 && j >= 0 && i < found.read.GetColumns() && j < found.read.GetRows() &&
      found.read.Has(i, j))
    {
      found.needed.Add(i, i, j, j);
    }
  };
  for (const RegionSet::Interval& run : found.read.GetIntervals())
  {
    const int j = run.row;
    for (int i = run.begin; i < run.end; ++i)
    {
      if (i == 0 || j == 0 || (i + 1) * RegionSize > last[0] || (j + 1) * RegionSize > last[1])
      {
        need(i, j);
      }
      for (int k = 0; k < 9 && this->Bounds.HasHoles(i, j); ++k)
      {
        need(i + k % 3 - 1, j + k / 3 - 1);
      }
    }
  }
}

// Where the rays of a search are on their way: at so many samples of it for a sun, at a share of it
// for a lamp.
TileRegions::Rectangle TileRegions::At(const Search& search, double from, double to)
{
  const Path& path = search.path;
  const Rectangle& start = search.start;
  Rectangle all = { Infinity, -Infinity, Infinity, -Infinity };
  auto add = [](double place, double& lo, double& hi)
  {
    lo = std::min(lo, place);
    hi = std::max(hi, place);
  };
  const double most = std::max(std::abs(path.x), std::abs(path.y));
  for (double u : { from, to })
  {
    for (double x : { start.x0, start.x1 })
    {
      add(path.positional ? x + (path.x - x) * u : x + path.x / most * u, all.x0, all.x1);
    }
    for (double y : { start.y0, start.y1 })
    {
      add(path.positional ? y + (path.y - y) * u : y + path.y / most * u, all.y0, all.y1);
    }
  }
  return all;
}

// Adds what counts where rays may leave the data: what is behind the start, and on from a place,
// the holes as far as rays need not meet data.
void TileRegions::GoBeyond(const Search& search, const Way& way, double from) const
{
  for (double u = 0.0; u < way.back; u += way.step)
  {
    const Rectangle part = At(search, -u, -std::min(u + way.step, way.back));
    search.found.read.Add(this->LookedAt(part, way.more));
    search.found.needed.Add(this->LookedAt(part, way.more));
    if (!this->IsInImage(part))
    {
      break;
    }
  }
  // In as many samples without a hole, or more, every ray meets data.
  const double clear = 4.0 * way.step;
  for (double u = std::max(from - clear, 0.0);; u += clear)
  {
    const Rectangle part = At(search, u, u + clear);
    if (!this->IsInImage(part) || (u >= from && !this->HasHoles(part)))
    {
      break;
    }
    this->AddHoles(part, search.found);
  }
}

void TileRegions::Follow(const Search& search, const Way& way) const
{
  struct Part
  {
    double begin;
    RegionSet::Block regions;
    bool edge;
  };
  std::vector<Part> parts;
  for (double u = 0.0; u <= way.end; u += way.step)
  {
    const double end = std::min(u + way.step, way.end);
    const Rectangle samples = At(search, u, end);
    if (!this->IsInImage(samples))
    {
      break;
    }
    parts.push_back(
      { u, this->LookedAt(At(search, u, end + way.ahead), way.more), this->MeetsEdge(samples) });
  }
  // Where nothing is ahead that any ray can meet.
  std::size_t above = parts.size();
  double highest = -Infinity;
  while (way.climb > 0.0 && above > 0)
  {
    const Part& part = parts[above - 1];
    highest = std::max(highest, this->HighestIn(part.regions));
    if (!(search.lowest + way.climb * part.begin > highest + Slack(highest, search.lowest)))
    {
      break;
    }
    --above;
  }
  bool edge = false;
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    (k < above ? search.found.read : search.found.level).Add(parts[k].regions);
    edge = edge || (k < above && parts[k].edge);
  }
  if (edge && way.back >= 0.0)
  {
    this->GoBeyond(search, way, above < parts.size() ? parts[above].begin : parts.back().begin);
  }
}

void TileRegions::FollowSun(const Search& search) const
{
  const Path& path = search.path;
  const double most = std::max(std::abs(path.x), std::abs(path.y));
  const double top = this->Heights.GetField().GetTop();
  if (most == 0.0)
  {
    search.found.read.Add(this->LookedAt(search.start, 0.0));
    return;
  }
  Way way = { Infinity, Step, Ahead, 0.0, path.z / most, -1.0 };
  if (way.climb > 0.0)
  {
    way.end = (top - search.lowest + Slack(top, search.lowest)) / way.climb;
    way.back = path.floored ? -1.0 : std::max(path.depth / way.climb, 1.0) + 2.0;
  }
  else if (way.climb < 0.0)
  {
    way.end = path.floored
      ? (search.highest - path.floor + Slack(search.highest, path.floor)) / -way.climb
      : 0.0;
  }
  way.end = std::max(way.end, 0.0);
  this->Follow(search, way);
}

// Rays to a lamp that is near run anywhere between.
void TileRegions::GoRound(const Search& search, Rectangle box) const
{
  const Path& path = search.path;
  search.found.read.Add(this->LookedAt(box, Ahead + Apart));
  if (path.floored || path.steps || !this->MeetsEdge(box))
  {
    return;
  }
  const double far =
    std::max(box.x1 - box.x0, box.y1 - box.y0) * std::hypot(this->SpacingX, this->SpacingY) +
    std::abs(path.z - search.lowest);
  const double rise = path.z - search.highest;
  const double back = rise > 0.0
    ? std::max(path.depth * far / rise / std::min(this->SpacingX, this->SpacingY), 1.0) + 2.0
    : Infinity;
  auto widen = [](Rectangle r, double by) {
    return Rectangle{ r.x0 - by, r.x1 + by, r.y0 - by, r.y1 + by };
  };
  search.found.read.Add(this->LookedAt(widen(box, back), 0.0));
  search.found.needed.Add(this->LookedAt(widen(box, back), 0.0));
  // Rings about it, until rays need not come through one without meeting data.
  const double last = std::max(this->Bounds.GetColumns(), this->Bounds.GetRows()) + Near;
  for (double by = 0.0; by < last; by += 4.0 * Step)
  {
    const Rectangle in = widen(box, by);
    const Rectangle out = widen(box, by + 4.0 * Step);
    const Rectangle sides[] = { { out.x0, in.x0, out.y0, out.y1 },
      { in.x1, out.x1, out.y0, out.y1 }, { out.x0, out.x1, out.y0, in.y0 },
      { out.x0, out.x1, in.y1, out.y1 } };
    bool holes = false;
    for (const Rectangle& side : sides)
    {
      holes = holes || (this->IsInImage(side) && this->HasHoles(side));
      this->AddHoles(side, search.found);
    }
    if (!holes)
    {
      break;
    }
  }
  this->AddHoles(box, search.found);
}

void TileRegions::FollowLamp(const Search& search) const
{
  const Path& path = search.path;
  const Rectangle& start = search.start;
  const double nearX = std::max({ start.x0 - path.x, path.x - start.x1, 0.0 });
  const double nearY = std::max({ start.y0 - path.y, path.y - start.y1, 0.0 });
  const double farX = std::max(std::abs(start.x0 - path.x), std::abs(start.x1 - path.x));
  const double farY = std::max(std::abs(start.y0 - path.y), std::abs(start.y1 - path.y));
  const double near = std::max(nearX, nearY);
  const double far = std::max(farX, farY);
  if (near < Near)
  {
    this->GoRound(search,
      { std::min(start.x0, path.x), std::max(start.x1, path.x), std::min(start.y0, path.y),
        std::max(start.y1, path.y) });
    return;
  }
  // The lowest foot of rays that are traced together, and the least climb.
  const double top = this->Heights.GetField().GetTop();
  const double rise = path.z - search.highest;
  Way way = { 1.0, Step / far, Ahead / near, Apart + 4.0 * std::max(path.asideX, path.asideY), 0.0,
    -1.0 };
  if (rise > 0.0 && !path.steps)
  {
    way.climb = rise * (near / (far + 2.0 * RegionSize));
    way.end = std::min((top - search.lowest + Slack(top, search.lowest)) / way.climb, 1.0);
  }
  if (!path.floored && !path.steps)
  {
    const double length =
      std::hypot(far * this->SpacingX, far * this->SpacingY) + std::abs(path.z - search.lowest);
    const double back =
      rise > 0.0 ? path.depth * length / rise / std::min(this->SpacingX, this->SpacingY) : Infinity;
    way.back = (std::max(back, 1.0) + 2.0) / near;
  }
  this->Follow(search, way);
}

// Adds what rays from these samples want.
void TileRegions::FollowFrom(const Path& path, const Rectangle& samples, Found& found) const
{
  RasterBounds::Range range;
  const int i1 = static_cast<int>(samples.x1) / RegionSize;
  const int j1 = static_cast<int>(samples.y1) / RegionSize;
  for (int j = static_cast<int>(samples.y0) / RegionSize; j <= j1; ++j)
  {
    for (int i = static_cast<int>(samples.x0) / RegionSize; i <= i1; ++i)
    {
      range.lo = std::min(range.lo, this->Bounds.RangeAt(i, j).lo);
      range.hi = std::max(range.hi, this->Bounds.RangeAt(i, j).hi);
    }
  }
  if (range.lo > range.hi)
  {
    return;
  }
  const Rectangle start = { samples.x0 - path.asideX, samples.x1 + path.asideX,
    samples.y0 - path.asideY, samples.y1 + path.asideY };
  const Search search = { found, path, start, range.lo - path.sink, range.hi };
  path.positional ? this->FollowLamp(search) : this->FollowSun(search);
}

TileRegions::Found TileRegions::Find(int i0, int i1, int j0, int j1) const
{
  Found found;
  found.read = RegionSet(this->Bounds.GetRegionColumns(), this->Bounds.GetRegionRows());
  found.level = found.read;
  found.needed = found.read;
  // Tiles of samples are computed whole, with their neighbors.
  constexpr int size = SweepThickness::TileWidth;
  i0 = std::max(i0 / size * size, 0);
  j0 = std::max(j0 / size * size, 0);
  i1 = std::min((i1 + size - 1) / size * size, this->Bounds.GetColumns());
  j1 = std::min((j1 + size - 1) / size * size, this->Bounds.GetRows());
  if (i0 >= i1 || j0 >= j1)
  {
    return found;
  }
  found.read.Add(this->LookedAt({ i0 - 2.0, i1 + 1.0, j0 - 2.0, j1 + 1.0 }, 0.0));
  found.needed = found.read;
  for (const Path& path : this->Paths)
  {
    const double aside = std::max(path.asideX, path.asideY);
    const bool anywhere = aside > std::max(this->Bounds.GetColumns(), this->Bounds.GetRows());
    if (anywhere)
    {
      found.read.Add(0, found.read.GetColumns() - 1, 0, found.read.GetRows() - 1);
      found.needed = found.read;
      break;
    }
    // Region by region corridors are tight; of very many lights, or where points are sunk far
    // aside, one for all of the tile does.
    const int size =
      aside > 4.0 * RegionSize || this->Paths.size() > MostTight ? std::max(i1, j1) : RegionSize;
    for (int j = j0 / size * size; j < j1; j += size)
    {
      for (int i = i0 / size * size; i < i1; i += size)
      {
        this->FollowFrom(path,
          { double(std::max(i, i0)), std::min(i + size, i1) - 1.0, double(std::max(j, j0)),
            std::min(j + size, j1) - 1.0 },
          found);
      }
    }
  }
  for (const RegionSet::Interval& run : found.read.GetIntervals())
  {
    for (int i = run.begin; i < run.end; ++i)
    {
      found.level.Remove(i, run.row);
    }
  }
  this->AddEdges(found);
  return found;
}

}
