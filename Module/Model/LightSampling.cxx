// SPDX-License-Identifier: BSD-3-Clause
#include "LightSampling.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <queue>
#include <utility>

namespace relief
{

namespace
{

constexpr double Pi = 3.14159265358979323846;
constexpr double GoldenRatio = 0.61803398874989484820; // (sqrt(5) - 1) / 2

// Rec. 709, as Debevec's median cut weighs channels.
double Luminance(const glm::dvec3& c)
{
  return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
}

// Where rows end in m = 1 - cos(polar angle), from 0 at the zenith to 2 at the nadir. Solid angle
// is azimuth times m. Both halves are exact mirror images.
std::vector<double> RowEdges(int rows)
{
  std::vector<double> edges(static_cast<std::size_t>(rows) + 1);
  auto fromPole = [rows](int j)
  {
    const double s = std::sin(Pi * j / (2.0 * rows));
    return 2 * j == rows ? 1.0 : 2.0 * s * s;
  };
  for (int j = 0; j <= rows; ++j)
  {
    edges[j] = 2 * j <= rows ? fromPole(j) : 2.0 - fromPole(rows - j);
  }
  return edges;
}

// Part of a column or row of texels, along the axis across it.
struct Slab
{
  int texel;
  double begin;
  double end;
};

// Columns between two azimuths of a map that is turned by `turn`.
void ColumnSlabs(int columns, double turn, double begin, double end, std::vector<Slab>& slabs)
{
  const double scale = columns / (2.0 * Pi);
  // Rounding must not leave slivers of a neighbour: a map turned by whole texels keeps them whole.
  auto place = [&](double azimuth)
  {
    const double x = (azimuth - turn) * scale;
    return std::abs(x - std::round(x)) < 1e-9 ? std::round(x) : x;
  };
  const double x0 = place(begin);
  const double x1 = place(end);
  slabs.clear();
  for (double x = std::floor(x0); x < x1; x += 1.0)
  {
    const int texel = static_cast<int>(x - std::floor(x / columns) * columns) % columns;
    const double from = std::max(x, x0);
    const double to = std::min(x + 1.0, x1);
    slabs.push_back({ texel, begin + (from - x0) / scale, begin + (to - x0) / scale });
  }
}

// Rows between two places, given where rows end.
void RowSlabs(const std::vector<double>& edges, double begin, double end, std::vector<Slab>& slabs)
{
  slabs.clear();
  auto row = std::upper_bound(edges.begin(), edges.end() - 1, begin) - edges.begin() - 1;
  for (; row + 1 < static_cast<std::ptrdiff_t>(edges.size()) && edges[row] < end; ++row)
  {
    const double from = std::max(begin, edges[row]);
    const double to = std::min(end, edges[row + 1]);
    if (to > from)
    {
      slabs.push_back({ static_cast<int>(row), from, to });
    }
  }
}

// A rectangle of azimuth and m (or of azimuth and v, for Uniform).
struct Patch
{
  double azimuth0;
  double azimuth1;
  double m0;
  double m1;

  double Area() const { return (this->azimuth1 - this->azimuth0) * (this->m1 - this->m0); }
};

// A map that is turned about its axis, and means over patches of it.
class TurnedMap
{
public:
  TurnedMap(const RadianceMap& map, double turn, std::vector<double> edges)
    : Map(map)
    , Turn(turn)
    , Edges(std::move(edges))
  {
  }

  glm::dvec3 Mean(const Patch& patch)
  {
    this->Cut(patch);
    glm::dvec3 sum(0.0);
    for (const Slab& row : this->RowsIn)
    {
      glm::dvec3 along(0.0);
      for (const Slab& column : this->ColumnsIn)
      {
        along += glm::dvec3(this->Map.At(column.texel, row.texel)) * (column.end - column.begin);
      }
      sum += along * (row.end - row.begin);
    }
    return sum / patch.Area();
  }

  // The parts of texels in a patch, which stay until the next call.
  void Cut(const Patch& patch)
  {
    ColumnSlabs(
      this->Map.GetColumns(), this->Turn, patch.azimuth0, patch.azimuth1, this->ColumnsIn);
    RowSlabs(this->Edges, patch.m0, patch.m1, this->RowsIn);
  }
  std::vector<Slab> ColumnsIn;
  std::vector<Slab> RowsIn;

private:
  const RadianceMap& Map;
  double Turn;
  std::vector<double> Edges;
};

glm::dvec3 Direction(double z, double azimuth)
{
  const double level = std::sqrt(std::max(0.0, 1.0 - z * z));
  return { level * std::cos(azimuth), level * std::sin(azimuth), z };
}

Light MakeLight(const glm::dvec3& direction, const glm::dvec3& color, double weight)
{
  Light light;
  light.vector = direction;
  light.color = color;
  light.weight = weight;
  return light;
}

// The mean height above the horizon of a patch or, where it is the whole sphere, of its upper half
// spread over it all.
double MeanHeight(const Patch& patch)
{
  return patch.m0 < 1.0 && patch.m1 > 1.0 ? 0.25 : 1.0 - 0.5 * (patch.m0 + patch.m1);
}

//------------------------------------------------------------------------------
std::vector<Light> SampleUniform(const RadianceMap& map, double turn, int samples)
{
  std::vector<double> edges(static_cast<std::size_t>(map.GetRows()) + 1);
  for (int j = 0; j <= map.GetRows(); ++j)
  {
    edges[j] = static_cast<double>(j) / map.GetRows();
  }
  TurnedMap turned(map, turn, std::move(edges));
  const int rows = static_cast<int>(std::lround(std::sqrt(samples)));
  std::vector<Light> lights;
  for (int row = 0; row < rows; ++row)
  {
    const std::int64_t first = static_cast<std::int64_t>(samples) * row / rows;
    const std::int64_t end = static_cast<std::int64_t>(samples) * (row + 1) / rows;
    for (std::int64_t k = first; k < end; ++k)
    {
      const double step = 2.0 * Pi / static_cast<double>(end - first);
      const Patch patch = { step * static_cast<double>(k - first),
        step * static_cast<double>(k - first + 1), static_cast<double>(first) / samples,
        static_cast<double>(end) / samples };
      const double polar = 0.5 * Pi * (patch.m0 + patch.m1);
      lights.push_back(
        MakeLight(Direction(std::cos(polar), 0.5 * (patch.azimuth0 + patch.azimuth1)),
          turned.Mean(patch), 1.0 / samples));
    }
  }
  return lights;
}

//------------------------------------------------------------------------------
// Patches of equal area for the upper half of the sphere, from the zenith down.
std::vector<Patch> HalfSphere(int count)
{
  // As many bands as make patches as wide as high; a patch covers 2 pi / count.
  int bands = std::max(1, static_cast<int>(std::lround(std::sqrt(Pi * count / 8.0))));
  const int symmetry = count % 4 == 0 ? 4 : 1;
  const int least = std::max(3, symmetry);
  std::vector<Patch> patches;
  int first = 0;
  for (int band = 0; band < bands; ++band)
  {
    const double ideal = count * (1.0 - std::cos(0.5 * Pi * (band + 1) / bands));
    int end = symmetry * static_cast<int>(std::lround(ideal / symmetry));
    end = std::max(end, first + least);
    end = band == bands - 1 || end > count - least ? count : end;
    // Neighbouring bands do not line up.
    const double shift = (band + 1) * GoldenRatio;
    const double step = 2.0 * Pi / (end - first);
    for (int k = 0; k < end - first; ++k)
    {
      patches.push_back({ (k + shift) * step, (k + 1 + shift) * step,
        static_cast<double>(first) / count, static_cast<double>(end) / count });
    }
    first = end;
    if (first == count)
    {
      break;
    }
  }
  return patches;
}

std::vector<Light> SampleSolidAngle(const RadianceMap& map, double turn, int samples)
{
  std::vector<Patch> patches;
  if (samples == 1)
  {
    patches.push_back({ 0.0, 2.0 * Pi, 0.0, 2.0 });
  }
  else
  {
    patches = HalfSphere((samples + 1) / 2);
    for (const Patch& patch : HalfSphere(samples / 2))
    {
      patches.push_back({ patch.azimuth0, patch.azimuth1, 2.0 - patch.m1, 2.0 - patch.m0 });
    }
  }
  TurnedMap turned(map, turn, RowEdges(map.GetRows()));
  std::vector<Light> lights;
  for (const Patch& patch : patches)
  {
    lights.push_back(
      MakeLight(Direction(MeanHeight(patch), 0.5 * (patch.azimuth0 + patch.azimuth1)),
        turned.Mean(patch), patch.Area() / Pi));
  }
  return lights;
}

//------------------------------------------------------------------------------
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
  Patch patch;
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

class ImportanceSampler
{
public:
  ImportanceSampler(const RadianceMap& map, double turn)
    : Map(map)
    , Turned(map, turn, RowEdges(map.GetRows()))
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

  std::vector<Light> Sample(int samples)
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
      Patch parts[2] = { region.patch, region.patch };
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
    std::vector<Light> lights;
    for (const Region& region : done)
    {
      const glm::dvec3& toward = region.moment.direction;
      const bool round =
        std::hypot(toward.x, toward.y) < 1e-9 * region.moment.energy; // all around the axis
      const double azimuth = round ? 0.5 * (region.patch.azimuth0 + region.patch.azimuth1)
                                   : std::atan2(toward.y, toward.x);
      lights.push_back(MakeLight(Direction(region.height, azimuth), this->Turned.Mean(region.patch),
        region.patch.Area() / Pi));
    }
    return lights;
  }

private:
  // Texels are cut further, so that a map of few is sampled too.
  static constexpr int LeastSlabs = 8;

  static void Refine(std::vector<Slab>& slabs)
  {
    const int parts = (LeastSlabs + static_cast<int>(slabs.size()) - 1) /
      std::max(1, static_cast<int>(slabs.size()));
    if (parts == 1)
    {
      return;
    }
    std::vector<Slab> refined;
    for (const Slab& slab : slabs)
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
  void Add(const Patch& patch)
  {
    this->Turned.Cut(patch);
    std::vector<Slab>& columns = this->Turned.ColumnsIn;
    std::vector<Slab>& rows = this->Turned.RowsIn;
    Refine(columns);
    Refine(rows);

    // With z = 1 - m, a direction is (sqrt(1 - z^2) cos a, sqrt(1 - z^2) sin a, z). Its integral
    // over a part of a texel is a product of one factor for the column and one for the row.
    struct Factor
    {
      double size;
      glm::dvec2 level; // of columns: integral of (cos a, sin a); of rows: of (sqrt(1 - z^2), z)
    };
    std::vector<Factor> across(columns.size());
    std::vector<Factor> down(rows.size());
    std::transform(columns.begin(), columns.end(), across.begin(),
      [](const Slab& s)
      {
        const double middle = 0.5 * (s.begin + s.end);
        const double chord = 2.0 * std::sin(0.5 * (s.end - s.begin));
        return Factor{ s.end - s.begin, chord * glm::dvec2(std::cos(middle), std::sin(middle)) };
      });
    std::transform(rows.begin(), rows.end(), down.begin(),
      [](const Slab& s)
      {
        // Integral of sin(polar)^2 over the polar angle.
        auto primitive = [](double m)
        {
          const double level = std::sqrt(std::max(0.0, m * (2.0 - m)));
          return 0.5 * (std::atan2(level, 1.0 - m) - level * (1.0 - m));
        };
        const double size = s.end - s.begin;
        return Factor{ size,
          glm::dvec2(
            primitive(s.end) - primitive(s.begin), size * (1.0 - 0.5 * (s.begin + s.end))) };
      });

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
      // A patch of both halves counts the upper alone, as MeanHeight() does.
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
    // E * sum of E_i |direction_i - mean|^2 is (E * spread)^2.
    const double length = glm::length(region.moment.direction) / region.moment.energy;
    region.urgency = best > 0.0f ? static_cast<float>(region.moment.energy *
                                     std::sqrt(std::max(0.0, (1.0 - length) * (1.0 + length))))
                                 : 0.0f;
    region.order = this->Count++;
    this->Regions.push(region);
  }

  static double UpperHeight(const Slab& row)
  {
    const double end = std::min(row.end, 1.0);
    return row.begin < end ? (end - row.begin) * (1.0 - 0.5 * (row.begin + end)) : 0.0;
  }

  // Of the borders between slabs the one that takes most of the spread away, if it takes more than
  // `best`.
  static void FindCut(Region& region, const std::vector<Slab>& slabs,
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
RadianceMap::RadianceMap(int columns, int rows)
  : Columns(columns)
  , Rows(rows)
  , Texels(static_cast<std::size_t>(columns) * rows, glm::vec3(0.0f))
{
}

//------------------------------------------------------------------------------
void RadianceMap::Set(int column, int row, const glm::dvec3& radiance)
{
  glm::dvec3 clean(0.0);
  bool whole = true;
  for (int c = 0; c < 3; ++c)
  {
    whole = whole && std::abs(radiance[c]) <= Largest; // not NaN either
    clean[c] = std::max(0.0, radiance[c]);
  }
  clean = whole ? clean : glm::dvec3(0.0);
  this->Cleaned += clean == radiance ? 0 : 1;
  this->Texels[static_cast<std::size_t>(row) * this->Columns + column] = glm::vec3(clean);
}

//------------------------------------------------------------------------------
glm::dvec3 RadianceMap::GetMean() const
{
  const std::vector<double> edges = RowEdges(this->Rows);
  glm::dvec3 sum(0.0);
  for (int j = 0; j < this->Rows; ++j)
  {
    glm::dvec3 along(0.0);
    for (int i = 0; i < this->Columns; ++i)
    {
      along += glm::dvec3(this->At(i, j));
    }
    sum += along * (edges[j + 1] - edges[j]);
  }
  return sum / (2.0 * this->Columns);
}

//------------------------------------------------------------------------------
std::vector<Light> SampleEnvironment(
  const RadianceMap& map, EnvironmentSampling sampling, int samples, const glm::dmat3& toField)
{
  // A mirrored frame is sampled as it was before, and its lights are mirrored.
  const glm::dmat3 mirror(
    glm::determinant(toField) < 0.0 ? -1.0 : 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
  const glm::dmat3 m = mirror * toField; // m[column][row]
  // m = lean * turn, with the turn about z and the lean about a level axis.
  const double turn = std::atan2(m[0][1] - m[1][0], m[0][0] + m[1][1]);
  const double c = std::cos(turn);
  const double s = std::sin(turn);
  const glm::dmat3 turnBack(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0);
  const glm::dmat3 place = mirror * m * turnBack;

  std::vector<Light> lights;
  switch (sampling)
  {
    case EnvironmentSampling::Uniform:
      lights = SampleUniform(map, turn, samples);
      break;
    case EnvironmentSampling::SolidAngle:
      lights = SampleSolidAngle(map, turn, samples);
      break;
    case EnvironmentSampling::Importance:
      lights = ImportanceSampler(map, turn).Sample(samples);
      break;
  }
  for (Light& light : lights)
  {
    light.vector = glm::normalize(place * light.vector);
  }
  return lights;
}

//------------------------------------------------------------------------------
void PlaceOnSphere(std::vector<Light>& lights, const glm::dvec3& center, double radius)
{
  for (Light& light : lights)
  {
    light.positional = true;
    light.vector = center + radius * light.vector;
  }
}

//------------------------------------------------------------------------------
void ShareTolerance(std::vector<Light>& lights, const glm::dvec3& mean, bool belowShows)
{
  std::vector<double> roots(lights.size(), 0.0);
  double sum = 0.0;
  for (std::size_t k = 0; k < lights.size(); ++k)
  {
    const Light& light = lights[k];
    const bool shows = light.positional || belowShows || light.vector.z >= 0.0;
    double share = 0.0;
    for (int c = 0; c < 3 && shows; ++c)
    {
      share = mean[c] > 0.0 ? std::max(share, light.weight * light.color[c] / mean[c]) : share;
    }
    roots[k] = std::sqrt(share);
    sum += roots[k];
  }
  for (std::size_t k = 0; k < lights.size(); ++k)
  {
    lights[k].toleranceScale = roots[k] > 0.0 ? 1.0 / (roots[k] * sum) : 1.0;
  }
}

//------------------------------------------------------------------------------
std::vector<Light> SampleDisc(const Light& sun, double diameter, int samples)
{
  if (diameter == 0.0 || samples == 1)
  {
    return { sun };
  }
  const glm::dvec3 axis = sun.vector;
  // Upright beside the sun, so that the pattern turns with it.
  const double level = std::hypot(axis.x, axis.y);
  const glm::dvec3 right =
    level > 0.0 ? glm::dvec3(-axis.y / level, axis.x / level, 0.0) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 up = glm::cross(axis, right);

  const double sine = std::sin(0.25 * diameter);
  const double area = 2.0 * sine * sine; // 1 - cos(diameter / 2)
  std::vector<Light> lights;
  for (int k = 0; k < samples; ++k)
  {
    // An odd one stands in the middle; every pair shares a ring of two samples' area.
    const int odd = samples % 2;
    const int pair = (k + odd) / 2;
    const double m = k < odd ? 0.0 : area * (2 * pair + 1 - odd) / samples;
    const double angle = Pi * (GoldenRatio * pair + (k + odd) % 2);
    const double away = std::sqrt(m * (2.0 - m));
    Light light = sun;
    light.vector =
      glm::normalize((1.0 - m) * axis + away * (std::cos(angle) * right + std::sin(angle) * up));
    light.weight = sun.weight / samples;
    lights.push_back(light);
  }
  return lights;
}

}
