// SPDX-License-Identifier: BSD-3-Clause
#include "ImportanceSampling.h"

#include "Angles.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

namespace relief
{

namespace
{

// Light from a set of directions: its energy, and its energy times direction, summed.
struct Moment
{
  double energy = 0.0;
  glm::dvec3 direction = glm::dvec3(0.0);

  Moment& operator+=(const Moment& o)
  {
    this->energy += o.energy;
    this->direction += o.direction;
    return *this;
  }
  Moment operator-(const Moment& o) const
  {
    Moment difference;
    difference.energy = this->energy - o.energy;
    difference.direction = this->direction - o.direction;
    return difference;
  }
};

// A patch of the sphere that one light stands for, and where it is best cut.
struct Region
{
  SkyPatch patch;
  Moment moment;
  double height; // above the horizon, weighted by energy
  bool acrossAzimuth;
  double cut;
  float urgency; // single precision: what differs by rounding alone is equal
  int order;

  bool operator<(const Region& o) const
  {
    return this->urgency != o.urgency ? this->urgency < o.urgency : this->order > o.order;
  }
};

// With z = 1 - m, a direction is (sqrt(1 - z^2) cos a, sqrt(1 - z^2) sin a, z). Its integral over a
// part of a texel is a product of one factor for the column and one for the row.
struct Factor
{
  double size;
  glm::dvec2 level; // of columns: integral of (cos a, sin a); of rows: of (sqrt(1 - z^2), z)
};

Factor OfColumn(const TurnedMap::Slab& s)
{
  const double middle = 0.5 * (s.begin + s.end);
  const double chord = 2.0 * std::sin(0.5 * (s.end - s.begin));
  return { s.end - s.begin, chord * glm::dvec2(std::cos(middle), std::sin(middle)) };
}

Factor OfRow(const TurnedMap::Slab& s)
{
  // Integral of sin(polar)^2 over the polar angle.
  auto primitive = [](double m)
  {
    const double level = std::sqrt(std::max(0.0, m * (2.0 - m)));
    return 0.5 * (std::atan2(level, 1.0 - m) - level * (1.0 - m));
  };
  const double size = s.end - s.begin;
  return { size,
    glm::dvec2(primitive(s.end) - primitive(s.begin), size * (1.0 - 0.5 * (s.begin + s.end))) };
}

class ImportanceSampler
{
public:
  ImportanceSampler(const RadianceMap& map, double turn)
    : Map(map)
    , Turned(map, turn)
    , Brightness(static_cast<std::size_t>(map.GetColumns()) * map.GetRows())
  {
    for (int j = 0; j < map.GetRows(); ++j)
    {
      for (int i = 0; i < map.GetColumns(); ++i)
      {
        this->Brightness[static_cast<std::size_t>(j) * map.GetColumns() + i] =
          Luminance(glm::dvec3(map.At(i, j)));
      }
    }
  }

  std::vector<PatchLight> Divide(int samples)
  {
    // The horizon is always a border, and where there are lights enough, quarters are: then a
    // quarter turn changes nothing.
    const int quarters = samples >= 8 ? 4 : 1;
    const int halves = samples >= 2 ? 2 : 1;
    for (int half = 0; half < halves; ++half)
    {
      for (int quarter = 0; quarter < quarters; ++quarter)
      {
        const double azimuth = 2.0 * Pi / quarters;
        const double m = 2.0 / halves;
        this->Add({ azimuth * quarter, azimuth * (quarter + 1), m * half, m * (half + 1) });
      }
    }
    std::vector<Region> done;
    while (!this->Regions.empty() &&
      this->Regions.size() + done.size() < static_cast<std::size_t>(samples))
    {
      const Region region = this->Regions.top();
      this->Regions.pop();
      if (!(region.urgency > 0.0f))
      {
        done.push_back(region);
        continue;
      }
      SkyPatch parts[2] = { region.patch, region.patch };
      (region.acrossAzimuth ? parts[0].azimuth1 : parts[0].m1) = region.cut;
      (region.acrossAzimuth ? parts[1].azimuth0 : parts[1].m0) = region.cut;
      this->Add(parts[0]);
      this->Add(parts[1]);
    }
    for (; !this->Regions.empty(); this->Regions.pop())
    {
      done.push_back(this->Regions.top());
    }
    std::sort(
      done.begin(), done.end(), [](const Region& a, const Region& b) { return a.order < b.order; });
    std::vector<PatchLight> lights;
    for (const Region& region : done)
    {
      const glm::dvec3& toward = region.moment.direction;
      const bool round =
        std::hypot(toward.x, toward.y) < 1e-9 * region.moment.energy; // all around the axis
      const double azimuth = round ? 0.5 * (region.patch.azimuth0 + region.patch.azimuth1)
                                   : std::atan2(toward.y, toward.x);
      lights.push_back({ region.patch, SkyDirection(region.height, azimuth) });
    }
    return lights;
  }

private:
  // Texels are cut further, so that a map of few is sampled too.
  static constexpr int LeastSlabs = 8;

  static void Refine(std::vector<TurnedMap::Slab>& slabs)
  {
    const int parts = (LeastSlabs + static_cast<int>(slabs.size()) - 1) /
      std::max(1, static_cast<int>(slabs.size()));
    if (parts == 1)
    {
      return;
    }
    std::vector<TurnedMap::Slab> refined;
    for (const TurnedMap::Slab& slab : slabs)
    {
      const double step = (slab.end - slab.begin) / parts;
      for (int k = 0; k < parts; ++k)
      {
        refined.push_back({ slab.texel, slab.begin + k * step,
          k == parts - 1 ? slab.end : slab.begin + (k + 1) * step });
      }
    }
    slabs = std::move(refined);
  }

  // Measures a patch, finds where to cut it and queues it, unless it is black.
  void Add(const SkyPatch& patch)
  {
    this->Turned.Cut(patch);
    std::vector<TurnedMap::Slab>& columns = this->Turned.ColumnsIn;
    std::vector<TurnedMap::Slab>& rows = this->Turned.RowsIn;
    Refine(columns);
    Refine(rows);

    std::vector<Factor> across(columns.size());
    std::vector<Factor> down(rows.size());
    std::transform(columns.begin(), columns.end(), across.begin(), OfColumn);
    std::transform(rows.begin(), rows.end(), down.begin(), OfRow);

    std::vector<Moment> byColumn(columns.size());
    std::vector<Moment> byRow(rows.size());
    double height = 0.0;
    for (std::size_t j = 0; j < rows.size(); ++j)
    {
      const double* brightness =
        this->Brightness.data() + static_cast<std::size_t>(rows[j].texel) * this->Map.GetColumns();
      const Factor row = down[j];
      double energy = 0.0;
      glm::dvec2 level(0.0);
      for (std::size_t i = 0; i < columns.size(); ++i)
      {
        const double b = brightness[columns[i].texel];
        energy += b * across[i].size;
        level += b * across[i].level;
        // Until the loop ends: energy, level length and height, without the column's factor.
        byColumn[i].energy += b * row.size;
        byColumn[i].direction.x += b * row.level.x;
        byColumn[i].direction.z += b * row.level.y;
      }
      byRow[j].energy = energy * row.size;
      byRow[j].direction = glm::dvec3(level * row.level.x, energy * row.level.y);
      // Where a patch is the whole sphere, level ground must still get what its upper half gives.
      height += energy * (patch.m1 - patch.m0 > 1.0 ? UpperHeight(rows[j]) : row.level.y);
    }
    for (std::size_t i = 0; i < columns.size(); ++i)
    {
      Moment& column = byColumn[i];
      column.energy *= across[i].size;
      column.direction =
        glm::dvec3(column.direction.x * across[i].level, column.direction.z * across[i].size);
    }

    Region region;
    region.patch = patch;
    for (const Moment& row : byRow)
    {
      region.moment += row;
    }
    if (!(region.moment.energy > 0.0))
    {
      return;
    }
    region.height = glm::clamp(height / region.moment.energy, -1.0, 1.0);
    float best = 0.0f;
    FindCut(region, columns, byColumn, true, best);
    FindCut(region, rows, byRow, false, best);
    // The energy times the root mean square distance of its directions from their mean. What comes
    // from below shows only through a floor or in highlights on steep flanks.
    const double length = glm::length(region.moment.direction) / region.moment.energy;
    const double spread = std::sqrt(std::max(0.0, (1.0 - length) * (1.0 + length)));
    const double interest = patch.m0 >= 1.0 ? 0.25 : 1.0;
    region.urgency =
      best > 0.0f ? static_cast<float>(region.moment.energy * spread * interest) : 0.0f;
    region.order = this->Count++;
    this->Regions.push(region);
  }

  static double UpperHeight(const TurnedMap::Slab& row)
  {
    const double end = std::min(row.end, 1.0);
    return row.begin < end ? (end - row.begin) * (1.0 - 0.5 * (row.begin + end)) : 0.0;
  }

  // Of the borders between slabs the one that takes most of the spread away, if it takes more than
  // `best`.
  static void FindCut(Region& region, const std::vector<TurnedMap::Slab>& slabs,
    const std::vector<Moment>& moments, bool acrossAzimuth, float& best)
  {
    Moment before;
    for (std::size_t k = 0; k + 1 < slabs.size(); ++k)
    {
      before += moments[k];
      const Moment after = region.moment - before;
      if (!(before.energy > 0.0) || !(after.energy > 1e-14 * region.moment.energy))
      {
        continue;
      }
      const glm::dvec3 apart = before.direction / before.energy - after.direction / after.energy;
      const float gain = static_cast<float>(
        before.energy * (after.energy / region.moment.energy) * glm::dot(apart, apart));
      if (gain > best)
      {
        best = gain;
        region.acrossAzimuth = acrossAzimuth;
        region.cut = slabs[k].end;
      }
    }
  }

  const RadianceMap& Map;
  TurnedMap Turned;
  std::vector<double> Brightness;
  std::priority_queue<Region> Regions;
  int Count = 0;
};

}

//------------------------------------------------------------------------------
std::vector<PatchLight> DivideByImportance(const RadianceMap& map, double turn, int samples)
{
  return ImportanceSampler(map, turn).Divide(samples);
}

}
