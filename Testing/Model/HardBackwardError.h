// SPDX-License-Identifier: BSD-3-Clause
#ifndef HardBackwardError_h
#define HardBackwardError_h

/// @file
/// What rounding of the heights, by so many units in the last place, may make of d: the values that
/// a brute-force sum in extended precision gives for heights moved up and down.

#include "HardTracer.h"
#include "ThicknessOracle.h"

#include <algorithm>
#include <vector>

/// The relative spacing of the numbers in which a method computes.
oracle::Real EpsilonOf(Method method);

/// How far d may be from that of heights moved: the division t / r, the sum of r, and the few
/// operations in a cell that are no error of a height.
oracle::Real RoundingOf(const HardScene& scene, Method method);

/// Greatest less least height.
oracle::Real ReliefOf(const Terrain& terrain);

/// A unit in the last place of a method's precision at the relief and t.
oracle::Real UnitOf(const HardScene& scene, Method method);

/// The values of d that heights within a distance have.
struct Span
{
  oracle::Real lo = oracle::Infinity;
  oracle::Real hi = -oracle::Infinity;

  void Add(oracle::Real d)
  {
    this->lo = std::min(this->lo, d);
    this->hi = std::max(this->hi, d);
  }
  bool Holds(oracle::Real d, oracle::Real rounding) const
  {
    return d >= this->lo - rounding && d <= this->hi + rounding;
  }
};

/// All of them, and at depth 0, where a shadow's edge is a jump, what they may be on either side.
struct Spans
{
  Span all;
  std::vector<Span> sides;

  bool Hold(oracle::Real d, oracle::Real rounding) const
  {
    return this->sides.empty() ? this->all.Holds(d, rounding)
                               : std::any_of(this->sides.begin(), this->sides.end(),
                                   [&](const Span& side) { return side.Holds(d, rounding); });
  }
};

/// Whether a ray moves and turns by rounding, too: not at all, by that of the depth along its
/// normal, or by that of places in the image as well.
enum class Lateral
{
  None,
  Depth,
  Image
};

/// What may differ between a computation and the oracle.
struct Slack
{
  oracle::Real distance; ///< heights, and a lamp's and the floor's
  oracle::Real epsilon;  ///< relative: how close to the corner of a hole a ray meets it or not
  Lateral lateral = Lateral::None;
};

Spans SpansOf(const HardScene& scene, const relief::Light& light, int i, int j, const Slack& slack);

/// What rounding may make of d by moving heights by so many units.
Slack SlackOf(const HardScene& scene, Method method, double units);

/// How well d at a sample is conditioned: by how many units in the last place the heights must be
/// moved for a brute-force sum in extended precision to give `d`, 0 if it gives it as they are.
///
/// The unit is that of the method's precision at the relief (greatest less least height, and t).
/// The sample's own height stays: how deep a point lies below the surface is what t says exactly.
/// Moving all the others up makes r longer and moving them down shorter, so d lies between those
/// of the two. Returns infinity if no move up to `most` explains d.
double BackwardError(const HardScene& scene, const relief::Light& light, int i, int j, double d,
  Method method, double most = 1024.0);

/// Whether d is that of a ray moved and turned by rounding: as a ray meets or misses the corner of
/// a hole or of the image, where the model itself jumps.
bool IsJump(
  const HardScene& scene, const relief::Light& light, int i, int j, double d, Method method);

/// The most units by which heights must be moved to explain any d (Documentation/Numerics.md).
constexpr double MostUnits = 64.0;

/// Whether one of the two explains d, with no more than that.
bool IsExplained(
  const HardScene& scene, const relief::Light& light, int i, int j, double d, Method method);

#endif
