// SPDX-License-Identifier: BSD-3-Clause
#ifndef HardSceneChecks_h
#define HardSceneChecks_h

/// @file
/// What must hold of every scene, whichever way it is computed. A check returns an empty text, or
/// what is wrong; so it serves the catalogue of hard cases, random scenes, and their shrinking.

#include "HardBackwardError.h"

#include <string>

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
