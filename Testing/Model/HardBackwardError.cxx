// SPDX-License-Identifier: BSD-3-Clause
#include "HardBackwardError.h"

#include <algorithm>

using oracle::Real;
using relief::Light;

Real EpsilonOf(Method method)
{
  return method == Method::Reference ? Real(0x1p-52) : Real(0x1p-23);
}

Real RoundingOf(const HardScene& scene, Method method)
{
  // At depth 0 the oracle's limit is that of a depth, so small that it is none beside the samples.
  const double depth = scene.medium.depth;
  const Real digits =
    depth > 0.0 ? 16 * std::numeric_limits<double>::denorm_min() / Real(depth) : Real(6e-8);
  return 16 * std::max(EpsilonOf(method), digits);
}

Real ReliefOf(const Terrain& terrain)
{
  Real lo = oracle::Infinity;
  Real hi = -oracle::Infinity;
  for (double height : terrain.heights)
  {
    lo = std::isfinite(height) ? std::min(lo, Real(height)) : lo;
    hi = std::isfinite(height) ? std::max(hi, Real(height)) : hi;
  }
  return hi > lo ? hi - lo : Real(0);
}

Real UnitOf(const HardScene& scene, Method method)
{
  return EpsilonOf(method) * (ReliefOf(scene.terrain) + scene.medium.depth);
}

namespace
{
// d at the start of a ray; at depth 0 by the definition of the limit, of a depth so small that the
// surface about the sample is flat.
Real IlluminationOf(const HardScene& scene, const Light& light, int i, int j, oracle::Nudge nudge,
  Real epsilon, Real stretch, Real cut)
{
  const Terrain& terrain = scene.terrain;
  const relief::f64::ReliefMedium& medium = scene.medium;
  oracle::Ray ray = oracle::RayOf(terrain, medium, light, i, j);
  ray.length -= std::isinf(ray.length) ? Real(0) : cut * ray.length;
  nudge.close = oracle::CloseTo(terrain, ray, epsilon);
  const Real r = oracle::Thickness(terrain, medium, ray, nudge) * (1 + stretch);
  if (medium.depth > 0.0 || std::isinf(r) || medium.attenuation == relief::f64::RELIEF_EXPONENTIAL)
  {
    return std::isinf(r) ? Real(0) : oracle::Illumination(medium, r);
  }
  if (r > 0)
  {
    return 0;
  }
  const Real cell = std::min(Real(terrain.spacingX), Real(terrain.spacingY));
  const Real way = ray.length > 0 ? std::min(ray.length, cell) : cell;
  // The depth goes to 0, and so leaves every floor below the surface beneath it.
  const Real toFloor = Real(terrain.At(i, j)) - medium.floorHeight;
  const Real room = medium.useFloor && toFloor > 0 ? std::min(way, toFloor) : way;
  relief::f64::ReliefMedium sunk = medium;
  sunk.depth = static_cast<double>(1e-16L * room);
  ray = oracle::RayOf(terrain, sunk, light, i, j);
  ray.length = std::min(ray.length, 1e-9L * way);
  return oracle::Illumination(sunk, oracle::Thickness(terrain, sunk, ray, nudge));
}
}

Spans SpansOf(const HardScene& scene, const Light& light, int i, int j, const Slack& slack)
{
  HardScene moved = scene;
  moved.terrain = WithoutInfinities(scene.terrain);
  const bool limit = scene.medium.depth == 0.0;
  // A dense material tells r from t to the last digit of either.
  const bool dense = scene.medium.attenuation == relief::f64::RELIEF_EXPONENTIAL;
  const int lifts = slack.distance > 0 ? 1 : 0;
  const int moves = light.positional ? lifts : 0;
  const int cuts = moves; // a ray may end a little before its lamp
  const Terrain& terrain = moved.terrain;
  const bool turns = slack.lateral != Lateral::None;
  const Real image = slack.lateral == Lateral::Image ? 1 : 0;
  Spans spans;
  for (int tie = -1; tie <= 1; ++tie)
  {
    Span lit;
    Span dark;
    for (int lift = -lifts; lift <= lifts; ++lift)
    {
      Span side; // as a lamp moves, d changes gradually
      for (int move = -moves; move <= moves; ++move)
      {
        for (int turn = turns ? 0 : 13; turn < (turns ? 27 : 14); ++turn)
        {
          for (int stretch = dense ? -1 : 0; stretch <= (dense ? 1 : 0); ++stretch)
          {
            Light lamp = light;
            lamp.vector.z += static_cast<double>(move * slack.distance);
            moved.medium.floorHeight =
              static_cast<double>(scene.medium.floorHeight - lift * slack.distance);
            oracle::Nudge nudge;
            nudge.stays = true;
            nudge.raise = lift * slack.distance;
            nudge.tie = tie;
            nudge.x = (turn % 3 - 1) * slack.epsilon *
              (image * terrain.columns + scene.medium.depth / terrain.spacingX);
            nudge.y = (turn / 3 % 3 - 1) * slack.epsilon *
              (image * terrain.rows + scene.medium.depth / terrain.spacingY);
            nudge.turn = (turn / 9 - 1) * slack.epsilon;
            for (int cut = 0; cut <= cuts; ++cut)
            {
              const Real d = IlluminationOf(moved, lamp, i, j, nudge, slack.epsilon,
                8 * stretch * slack.epsilon, 8 * cut * slack.epsilon);
              spans.all.Add(d);
              side.Add(d);
              (d > 0 ? lit : dark).Add(d);
            }
          }
        }
      }
      if (limit)
      {
        spans.sides.push_back(side);
      }
    }
    if (limit)
    {
      spans.sides.push_back(lit);
      spans.sides.push_back(dark);
    }
  }
  return spans;
}

Slack SlackOf(const HardScene& scene, Method method, double units)
{
  return { units * UnitOf(scene, method), std::max(units, 1.0) * EpsilonOf(method) };
}

double BackwardError(
  const HardScene& scene, const Light& light, int i, int j, double d, Method method, double most)
{
  const Real rounding = RoundingOf(scene, method);
  for (double units = 0.0; units <= most; units = units == 0.0 ? 1.0 : 2.0 * units)
  {
    if (SpansOf(scene, light, i, j, SlackOf(scene, method, units)).Hold(d, rounding))
    {
      return units;
    }
  }
  return Infinite;
}

bool IsJump(const HardScene& scene, const Light& light, int i, int j, double d, Method method)
{
  Slack slack = SlackOf(scene, method, 4.0);
  const Real rounding = std::max(RoundingOf(scene, method), 16 * slack.epsilon);
  for (Lateral lateral : { Lateral::Depth, Lateral::Image })
  {
    slack.lateral = lateral;
    if (SpansOf(scene, light, i, j, slack).Hold(d, rounding))
    {
      return true;
    }
  }
  return false;
}

bool IsExplained(const HardScene& scene, const Light& light, int i, int j, double d, Method method)
{
  return BackwardError(scene, light, i, j, d, method, MostUnits) <= MostUnits ||
    IsJump(scene, light, i, j, d, method);
}
