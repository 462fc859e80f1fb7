// SPDX-License-Identifier: BSD-3-Clause
#ifndef ThicknessOracle_h
#define ThicknessOracle_h

/// @file
/// The thickness of Documentation/Model.md by brute force, written from that page and from nothing
/// of the module's own. A ray's crossings with every grid line are computed from absolute
/// coordinates and sorted; each interval between two of them is told its cell by its midpoint; the
/// surface above the ray is sampled at three points of the interval, which make the quadratic that
/// it is there; the inside length is summed between the quadratic's roots. All in long double.

#include "ReliefModel.h"
#include "TestTerrain.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace oracle
{

using Real = long double;
constexpr Real Infinity = std::numeric_limits<Real>::infinity();

/// A ray in grid coordinates (x / sx, y / sy) and in lengths along z; s is a length. All count from
/// its sample, so that a small depth t keeps its digits.
struct Ray
{
  int i = 0; ///< the sample
  int j = 0;
  Real x = 0.0L; ///< start, in samples
  Real y = 0.0L;
  Real z = 0.0L;
  Real stepX = 0.0L; ///< samples per length
  Real stepY = 0.0L;
  Real stepZ = 0.0L;
  Real length = Infinity;
  Real base = 0.0L; ///< the sample's own height
};

/// A small change of what the model is given, by which the oracle tells how well-conditioned a
/// thickness is.
struct Nudge
{
  Real x = 0.0L;
  Real y = 0.0L;
  Real turn = 0.0L;   ///< of the ray, about z, in radians
  Real raise = 0.0L;  ///< of all heights
  bool stays = false; ///< but the sample's own
  /// What is held after a ray has passed this close by a sample, in lengths: the lesser (tie < 0)
  /// or the greater (tie > 0) of what was held and the sample's height. A ray through the corner
  /// between two holes meets the two other cells there on no length at all, and which of them it is
  /// told to have met, if any, is rounding's choice anew at every corner.
  Real close = 0.0L;
  int tie = 0;
};

/// The image as a ray's sample sees it: columns and rows count from there, and so do heights.
class View
{
public:
  View(const Terrain& terrain, const Ray& ray, const Nudge& nudge)
    : Field(terrain)
    , From(ray)
    , Change(nudge)
    , firstX(-ray.i)
    , firstY(-ray.j)
    , lastX(terrain.columns - 1 - ray.i)
    , lastY(terrain.rows - 1 - ray.j)
  {
  }

  Real At(int i, int j) const
  {
    const bool own = this->Change.stays && i == 0 && j == 0;
    return this->Field.At(this->From.i + i, this->From.j + j) - this->From.base +
      (own ? Real(0) : this->Change.raise);
  }

  bool IsHole(int i, int j) const
  {
    return std::isnan(
      this->At(i, j) + this->At(i + 1, j) + this->At(i, j + 1) + this->At(i + 1, j + 1));
  }

  /// Bilinear height at a place inside a cell whose corners all have data.
  Real Patch(int i, int j, Real x, Real y) const
  {
    // Each weight by its own subtraction: right beside a sample 1 - u would have lost its digits.
    Real west = i + 1 - x;
    Real east = x - i;
    Real south = j + 1 - y;
    Real north = y - j;
    return south * (west * this->At(i, j) + east * this->At(i + 1, j)) +
      north * (west * this->At(i, j + 1) + east * this->At(i + 1, j + 1));
  }

  /// The cell of a coordinate: the one after a grid line, the last one for the last line.
  static int CellOf(Real x, int first, int last)
  {
    Real line = std::clamp(std::floor(x), Real(first), Real(std::max(last - 1, first)));
    return static_cast<int>(line);
  }

  int CellX(Real x) const { return CellOf(x, this->firstX, this->lastX); }
  int CellY(Real y) const { return CellOf(y, this->firstY, this->lastY); }

private:
  const Terrain& Field;
  const Ray& From;
  const Nudge& Change;

public:
  const int firstX, firstY, lastX, lastY; ///< samples
};

/// Surface where a ray starts outside the image or in a hole: the bilinear height at the position
/// clamped to the image, over the corners that have data; the sample's own where none has.
inline Real ClampedHeight(const View& view, Real x, Real y)
{
  x = std::clamp(x, Real(view.firstX), Real(view.lastX));
  y = std::clamp(y, Real(view.firstY), Real(view.lastY));
  int i = view.CellX(x);
  int j = view.CellY(y);
  Real sum = 0;
  Real weights = 0;
  for (int cj = j; cj <= std::min(j + 1, view.lastY); ++cj)
  {
    for (int ci = i; ci <= std::min(i + 1, view.lastX); ++ci)
    {
      Real weight = (ci == i ? i + 1 - x : x - i) * (cj == j ? j + 1 - y : y - j);
      if (!std::isnan(view.At(ci, cj)) && weight > 0)
      {
        sum += weight * view.At(ci, cj);
        weights += weight;
      }
    }
  }
  return weights > 0 ? sum / weights : Real(0);
}

/// Length of the part of [s0, s1] in which c0 + c1 s > 0.
inline void ClipPositive(Real c0, Real c1, Real& s0, Real& s1)
{
  if (c1 == 0)
  {
    s1 = c0 > 0 ? s1 : s0;
  }
  else if (c1 > 0)
  {
    s0 = std::max(s0, -c0 / c1);
  }
  else
  {
    s1 = std::min(s1, -c0 / c1);
  }
  s1 = std::max(s0, s1);
}

/// Length of the part of [s0, s1] in which a quadratic is above 0, known by its values at s0, in
/// the middle and at s1.
inline Real PositiveLength(Real s0, Real s1, Real g0, Real gm, Real g1)
{
  Real a = 2 * (g0 + g1) - 4 * gm;
  Real b = 4 * gm - 3 * g0 - g1;
  std::vector<Real> cuts = { 0, 1 };
  auto add = [&cuts](Real u)
  {
    if (u > 0 && u < 1)
    {
      cuts.push_back(u);
    }
  };
  Real discriminant = b * b - 4 * a * g0;
  if (discriminant >= 0)
  {
    Real q = -(b + std::copysign(std::sqrt(discriminant), b)) / 2;
    if (a != 0)
    {
      add(q / a);
    }
    if (q != 0)
    {
      add(g0 / q);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  Real share = 0;
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
  {
    Real middle = (cuts[k] + cuts[k + 1]) / 2;
    share += (a * middle + b) * middle + g0 > 0 ? cuts[k + 1] - cuts[k] : 0;
  }
  return share * (s1 - s0);
}

/// Surface normal by central differences, one-sided beside an edge or a hole, level where neither
/// neighbour has data.
inline glm::dvec3 Normal(const Terrain& terrain, int i, int j)
{
  auto slope = [](double before, double here, double after, double spacing)
  {
    double lo = std::isnan(before) ? here : before;
    double hi = std::isnan(after) ? here : after;
    int steps = (std::isnan(before) ? 0 : 1) + (std::isnan(after) ? 0 : 1);
    return steps == 0 ? 0.0 : (hi - lo) / (steps * spacing);
  };
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  double here = terrain.At(i, j);
  double x = slope(i > 0 ? terrain.At(i - 1, j) : none, here,
    i + 1 < terrain.columns ? terrain.At(i + 1, j) : none, terrain.spacingX);
  double y = slope(j > 0 ? terrain.At(i, j - 1) : none, here,
    j + 1 < terrain.rows ? terrain.At(i, j + 1) : none, terrain.spacingY);
  double length = std::sqrt(x * x + y * y + 1.0);
  return glm::dvec3(-x / length, -y / length, 1.0 / length);
}

/// Lengths at which a line meets grid lines, sorted, from 0 to infinity.
inline std::vector<Real> CutsOf(const View& view, Real x, Real y, Real stepX, Real stepY)
{
  std::vector<Real> cuts = { 0 };
  auto cross = [&cuts](Real start, Real step, int first, int last)
  {
    for (int k = first; step != 0 && k <= last; ++k)
    {
      const Real s = (k - start) / step;
      if (s > 0)
      {
        cuts.push_back(s);
      }
    }
  };
  cross(x, stepX, view.firstX, view.lastX);
  cross(y, stepY, view.firstY, view.lastY);
  std::sort(cuts.begin(), cuts.end());
  cuts.push_back(Infinity);
  return cuts;
}

/// A cell, and whether it is outside the image or a hole.
struct Place
{
  int i;
  int j;
  bool outside;
  bool hole;
};

/// The cell at a place on a line; beside a line along a grid line one with data, if there is one.
inline Place PlaceAt(const View& view, Real x, Real y, bool alongX, bool alongY)
{
  Place place = { view.CellX(x), view.CellY(y), false, false };
  place.outside = x < view.firstX || y < view.firstY || x > view.lastX || y > view.lastY ||
    view.lastX == view.firstX || view.lastY == view.firstY;
  if (place.outside)
  {
    return place;
  }
  place.hole = view.IsHole(place.i, place.j);
  if (place.hole && alongX && y == place.j && place.j > view.firstY &&
    !view.IsHole(place.i, place.j - 1))
  {
    --place.j;
    place.hole = false;
  }
  else if (place.hole && alongY && x == place.i && place.i > view.firstX &&
    !view.IsHole(place.i - 1, place.j))
  {
    --place.i;
    place.hole = false;
  }
  return place;
}

/// How much the ground rises, per length of a ray, behind the place where the ray left the data at
/// s. To what heights raised by rounding make of d belongs that this rise may be greater, too.
inline Real RiseBehind(const Terrain& terrain, const relief::f64::ReliefMedium& medium,
  const Ray& ray, const View& view, Real left, bool sideways, Real raise)
{
  const Real alongX = ray.stepX * terrain.spacingX;
  const Real alongY = ray.stepY * terrain.spacingY;
  const Real across = std::hypot(alongX, alongY);
  if (across == 0 || terrain.columns < 2 || terrain.rows < 2)
  {
    return 0;
  }
  const Real shortest = std::max(Real(std::min(terrain.spacingX, terrain.spacingY)) / across,
    ray.stepZ > 0 ? medium.depth / ray.stepZ : Infinity);
  const Real reach = std::max(left, shortest);
  Real x = ray.x + left * ray.stepX;
  Real y = ray.y + left * ray.stepY;
  // Where a ray crosses a line it is on it.
  auto onLine = [&](Real place, Real start, Real step)
  {
    const Real digits = 1e-15L * (std::abs(start) + left * std::abs(step));
    return std::abs(place - std::round(place)) < digits ? std::round(place) : place;
  };
  x = onLine(x, ray.x, ray.stepX);
  y = onLine(y, ray.y, ray.stepY);
  const std::vector<Real> cuts = CutsOf(view, x, y, -ray.stepX, -ray.stepY);
  bool met = false;
  bool stopped = false; // by a hole
  Real first = 0;
  Real last = 0;
  Real firstHeight = 0;
  Real lastHeight = 0;
  for (std::size_t k = 0; k + 1 < cuts.size() && cuts[k] < reach; ++k)
  {
    const Real u0 = cuts[k];
    const Real u1 = cuts[k + 1];
    if (u1 <= u0)
    {
      continue;
    }
    const Real middle = std::isinf(u1) ? u0 + 1 : (u0 + u1) / 2;
    const Place place =
      PlaceAt(view, x - middle * ray.stepX, y - middle * ray.stepY, ray.stepY == 0, ray.stepX == 0);
    if (place.outside || place.hole)
    {
      // Does not count where the line only touches it.
      if (u1 - u0 <= Real(1e-6f) * (left + u1))
      {
        continue;
      }
      stopped = !place.outside;
      break;
    }
    auto height = [&](Real u)
    { return view.Patch(place.i, place.j, x - u * ray.stepX, y - u * ray.stepY); };
    first = met ? first : u0;
    firstHeight = met ? firstHeight : height(u0);
    met = true;
    last = std::min(u1, reach);
    lastHeight = height(last);
  }
  // Data in front of the start only say nothing.
  const bool outside =
    ray.x < view.firstX || ray.x > view.lastX || ray.y < view.firstY || ray.y > view.lastY;
  if (outside || (stopped && left - last > Real(1e-6f) * left))
  {
    return 0;
  }
  if (met && last - first > Real(1e-6f) * (left + last))
  {
    return (firstHeight - lastHeight + 2 * raise) / (last - first);
  }
  // A corner: the tangent plane of its sample. In a hole, level.
  const int ci = std::clamp(
    static_cast<int>(std::round(std::clamp(x, Real(-1e6), Real(1e6)))), view.firstX, view.lastX);
  const int cj = std::clamp(
    static_cast<int>(std::round(std::clamp(y, Real(-1e6), Real(1e6)))), view.firstY, view.lastY);
  const int i = ray.i + ci;
  const int j = ray.j + cj;
  const bool elsewhere = left > 0 ? std::max(std::abs(x - ci), std::abs(y - cj)) > 1e-3L : sideways;
  if (elsewhere || std::isnan(terrain.At(i, j)))
  {
    return 0;
  }
  auto slope = [](Real before, Real here, Real after, Real spacing)
  {
    const Real lo = std::isnan(before) ? here : before;
    const Real hi = std::isnan(after) ? here : after;
    const int steps = (std::isnan(before) ? 0 : 1) + (std::isnan(after) ? 0 : 1);
    return steps == 0 ? Real(0) : (hi - lo) / (steps * spacing);
  };
  auto at = [&](int di, int dj)
  {
    const bool within = ci + di >= view.firstX && ci + di <= view.lastX && cj + dj >= view.firstY &&
      cj + dj <= view.lastY;
    return within ? view.At(ci + di, cj + dj) : std::numeric_limits<Real>::quiet_NaN();
  };
  const Real steeper = 2 * raise * (std::abs(ray.stepX) + std::abs(ray.stepY));
  return slope(at(-1, 0), at(0, 0), at(1, 0), terrain.spacingX) * alongX +
    slope(at(0, -1), at(0, 0), at(0, 1), terrain.spacingY) * alongY + steeper;
}

/// r along a ray.
inline Real Thickness(
  const Terrain& terrain, const relief::f64::ReliefMedium& medium, Ray ray, const Nudge& nudge = {})
{
  const bool sideways = ray.x != 0 || ray.y != 0;
  ray.x += nudge.x;
  ray.y += nudge.y;
  Real alongX = ray.stepX * terrain.spacingX;
  Real alongY = ray.stepY * terrain.spacingY;
  ray.stepX = (alongX - nudge.turn * alongY) / terrain.spacingX;
  ray.stepY = (alongY + nudge.turn * alongX) / terrain.spacingY;

  const View view(terrain, ray, nudge);
  const std::vector<Real> cuts = CutsOf(view, ray.x, ray.y, ray.stepX, ray.stepY);
  Real held = ClampedHeight(view, ray.x, ray.y);
  bool holding = false;
  Real inside = 0;
  Real left = 0; // where data ended
  Real kept = 0; // and what was inside till then
  for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
  {
    Real s0 = cuts[k];
    Real s1 = cuts[k + 1];
    if (s1 <= s0)
    {
      continue;
    }
    Real middle = std::isinf(s1) ? s0 + 1 : (s0 + s1) / 2;
    Real x = ray.x + middle * ray.stepX;
    Real y = ray.y + middle * ray.stepY;
    const Place place = PlaceAt(view, x, y, ray.stepY == 0, ray.stepX == 0);
    int ni = view.CellOf(x + Real(0.5), view.firstX, view.lastX + 1);
    int nj = view.CellOf(y + Real(0.5), view.firstY, view.lastY + 1);
    Real corner = view.At(ni, nj);
    bool tied = nudge.tie != 0 && s1 - s0 <= nudge.close && !std::isnan(corner);
    if (tied)
    {
      held = nudge.tie < 0 ? std::min(held, corner) : std::max(held, corner);
    }
    // A ray upright in a cell never leaves it; its surface is that of its start.
    bool upright = ray.stepX == 0 && ray.stepY == 0;
    bool level = tied || place.outside || upright || place.hole;
    auto height = [&](Real s)
    {
      return level ? held
                   : view.Patch(place.i, place.j, ray.x + s * ray.stepX, ray.y + s * ray.stepY);
    };
    // A cell of which the ray only touches a corner does not end a hole.
    level = level || (holding && s1 - s0 <= Real(1e-6f) * s1);
    if (!level && !std::isinf(s1))
    {
      held = height(s1);
    }
    if (level && !holding)
    {
      left = s0;
      kept = inside;
    }
    holding = level;

    // Above the floor, then below the surface.
    Real from = s0;
    Real to = std::min(s1, ray.length);
    if (medium.useFloor)
    {
      ClipPositive(ray.z - (medium.floorHeight - ray.base), ray.stepZ, from, to);
    }
    if (level)
    {
      ClipPositive(held - ray.z, -ray.stepZ, from, to);
      inside += to > from ? to - from : 0;
    }
    else if (to > from)
    {
      Real half = (from + to) / 2;
      inside += PositiveLength(from, to, height(from) - (ray.z + from * ray.stepZ),
        height(half) - (ray.z + half * ray.stepZ), height(to) - (ray.z + to * ray.stepZ));
    }
  }
  // Beyond the data the ground goes on as it came, for a ray that rises.
  const Real below = held - (ray.z + left * ray.stepZ);
  if (holding && below > 0 && ray.stepZ > 0 && !medium.useFloor && left < ray.length)
  {
    const Real rise = RiseBehind(terrain, medium, ray, view, left, sideways, nudge.raise);
    const Real fall = ray.stepZ - std::min(rise, ray.stepZ / 2);
    inside = kept + std::min(fall > 0 ? below / fall : Infinity, ray.length - left);
  }
  return inside;
}

/// d behind a thickness r, for t > 0.
inline Real Illumination(const relief::f64::ReliefMedium& medium, Real r)
{
  Real t = medium.depth;
  if (medium.attenuation == relief::f64::RELIEF_EXPONENTIAL)
  {
    return std::exp(-static_cast<Real>(medium.density) * std::max(r - t, Real(0)));
  }
  return r <= t ? 1 : t / r;
}

/// The ray of a sample: from p' toward the light.
inline Ray RayOf(const Terrain& terrain, const relief::f64::ReliefMedium& medium,
  const relief::Light& light, int i, int j)
{
  glm::dvec3 n = medium.offset == relief::f64::RELIEF_SURFACE_NORMAL ? Normal(terrain, i, j)
                                                                     : glm::dvec3(0.0, 0.0, 1.0);
  Real t = medium.depth;
  Real offset[3] = { -t * n.x, -t * n.y, -t * n.z };
  if (medium.offset == relief::f64::RELIEF_TANGENT_PLANE && terrain.columns > 1 && terrain.rows > 1)
  {
    offset[2] = -std::min(t / Real(Normal(terrain, i, j).z), 2 * t);
  }
  Ray ray;
  ray.base = terrain.At(i, j);
  ray.i = i;
  ray.j = j;
  ray.x = offset[0] / terrain.spacingX;
  ray.y = offset[1] / terrain.spacingY;
  ray.z = offset[2];
  Real l[3] = { light.vector.x, light.vector.y, light.vector.z };
  if (light.positional)
  {
    // Samples stand where double has them.
    l[0] = l[0] - i * terrain.spacingX - offset[0];
    l[1] = l[1] - j * terrain.spacingY - offset[1];
    l[2] = l[2] - ray.base - offset[2];
    ray.length = std::sqrt(l[0] * l[0] + l[1] * l[1] + l[2] * l[2]);
    for (Real& component : l)
    {
      component = ray.length > 0 ? component / ray.length : &component == &l[2] ? 1 : 0;
    }
  }
  // Directions closer to an axis are along it.
  constexpr Real along = 1e-12L;
  ray.stepX = std::abs(l[0]) < along ? 0 : l[0] / terrain.spacingX;
  ray.stepY = std::abs(l[1]) < along ? 0 : l[1] / terrain.spacingY;
  ray.stepZ = l[2];
  return ray;
}

/// How long a ray may be in a cell that inputs within a relative distance may have it miss.
inline Real CloseTo(const Terrain& terrain, const Ray& ray, Real distance)
{
  Real across = std::hypot(ray.stepX * terrain.spacingX, ray.stepY * terrain.spacingY);
  Real size = terrain.columns * terrain.spacingX + terrain.rows * terrain.spacingY;
  return across > 0 ? 4 * distance * size / across : Real(0);
}

/// All the thicknesses that inputs within a distance of the given ones have: what a computation may
/// answer whose rounding amounts to such a change of its input. The distance is a few units in the
/// last place of what it computes with, so that where a thickness is well-conditioned this is a
/// point; where a ray grazes the surface, runs along a grid line between cells with and without
/// data or passes through the corner of a hole, it is not.
struct Range
{
  Real lo = Infinity;
  Real hi = -Infinity;
};

inline Range ThicknessRange(const Terrain& terrain, const relief::f64::ReliefMedium& medium,
  const Ray& ray, Real distance, Real scale)
{
  Range range;
  for (int k = 0; k < 162; ++k)
  {
    Nudge nudge;
    nudge.x = (k % 3 - 1) * distance * terrain.columns;
    nudge.y = (k / 3 % 3 - 1) * distance * terrain.rows;
    nudge.turn = (k / 9 % 3 - 1) * distance;
    nudge.raise = (k / 27 % 3 - 1) * distance * scale;
    nudge.tie = k < 81 ? -1 : 1;
    nudge.close = CloseTo(terrain, ray, distance);
    Real r = Thickness(terrain, medium, ray, nudge);
    range.lo = std::min(range.lo, r);
    range.hi = std::max(range.hi, r);
  }
  return range;
}

}

#endif
