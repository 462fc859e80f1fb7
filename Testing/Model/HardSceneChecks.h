// SPDX-License-Identifier: BSD-3-Clause
#ifndef HardSceneChecks_h
#define HardSceneChecks_h

/// @file
/// What must hold of every scene, whichever way it is computed. A check returns an empty text, or
/// what is wrong; so it serves the catalogue of hard cases, random scenes, and their shrinking.

#include "HardScene.h"
#include "HeightField.h"

#include <memory>
#include <string>

/// The ways in which d of one light is computed.
enum class Method
{
  Reference, ///< double, ray by ray, without bounds
  Rays,      ///< float, ray by ray, with bounds
  Sweep,     ///< suns in lockstep
  Packets,   ///< neighbouring rays in lanes
  Scene      ///< as a whole scene chooses
};
constexpr Method AllMethods[] = { Method::Reference, Method::Rays, Method::Sweep, Method::Packets,
  Method::Scene };
const char* NameOf(Method method);

/// A scene made ready for all methods.
class HardTracer
{
public:
  explicit HardTracer(const HardScene& scene);

  /// What is wrong with the heights, or nothing.
  const std::string& GetRefusal() const { return this->Refusal; }

  bool Applies(Method method, const relief::Light& light) const;

  /// d and r of every sample, NaN where nothing was traced.
  Traced<double> Trace(Method method, const relief::Light& light) const;

  /// d by the fixed steps.
  std::vector<float> Count(const relief::Light& light, int steps) const;

private:
  HardScene Scene;
  std::unique_ptr<Samples<double>> Exact;
  relief::HeightField Field;
  std::string Refusal;
};

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

/// d within [0, 1], r at least 0, both NaN just where there is no data; d is what the attenuation
/// makes of r.
std::string CheckRange(const HardScene& scene);

/// d of every method is that of heights within `units` units in the last place. The largest that
/// was needed is kept in `largest` (one for double, one for float).
struct BackwardErrors
{
  double reference = 0.0;
  double single = 0.0;
  long samples = 0;
  long moved = 0; ///< samples for which heights had to be moved at all
  long far = 0;   ///< by more than 4 units
  long jumps = 0; ///< or the ray itself, across a place where the model jumps
};
std::string CheckBackwardError(const HardScene& scene, double units, BackwardErrors& found);

/// Raising a sample's height darkens or leaves every other sample.
std::string CheckRaisedWall(const HardScene& scene, int i, int j, double height);

/// Mirrored along x, along y, or along the diagonal, with its lights, a scene has mirrored d.
std::string CheckMirrors(const HardScene& scene);

/// All lengths times a power of two change no bit of d, and r by that power.
std::string CheckScaling(const HardScene& scene);

/// Changes of one unit in the last place, of lights and t, change d by no more than rounding, or
/// the model itself jumps there.
std::string CheckNudges(const HardScene& scene);

/// With a tolerance d differs by no more than that.
std::string CheckTolerance(const HardScene& scene, double tolerance);

/// The fixed steps count what points stand below the surface.
std::string CheckFixedSteps(const HardScene& scene, int steps);

#endif
