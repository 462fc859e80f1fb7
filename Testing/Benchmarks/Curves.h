// SPDX-License-Identifier: BSD-3-Clause
#ifndef Curves_h
#define Curves_h

#include "BenchmarkTerrain.h"
#include "Integrators.h"

#include <string>
#include <vector>

namespace bench
{

/// One integrator at one setting on one scene.
struct CurvePoint
{
  std::string scene;
  std::string integrator;
  double knob = 0.0;        ///< steps, or the tolerance
  double nanoseconds = 0.0; ///< a sample
  ErrorOfD error;
};

/// The names of the integrators, in the order of the curves.
extern const char* const Lockstep;
extern const char* const LampScene;
extern const char* const RayByRay;
extern const char* const StepsPublished;
extern const char* const StepsThickness;
extern const char* const StepsBilinear;

/// The tolerance that the charts mark and the comparisons take: the scene's default.
constexpr double MarkedTolerance = 0.0003;

/// What the charts call it, and the integrator with it.
extern const char* const Marked;
extern const char* const ExactMarked;

/// Where the light of the curves stands: low enough for long shadows.
constexpr double CurveAzimuth = 315.0;
constexpr double CurveAltitude = 20.0;

/// How far the lamps stand from the middle of the field, in its widths: their altitude is within
/// about 4 degrees of the sun's over all of the field.
constexpr double LampDistance = 4.0;

/// Runs every integrator over its knob. Each is compared with the double reference of the light
/// that it was given itself: fixed steps and lamps have positional lights.
std::vector<CurvePoint> MeasureCurves(const Relief& relief, int repetitions, int mostSteps);

/// A number of steps that reaches an error, and what it takes.
struct StepsFor
{
  int steps = 0;            ///< 0 if none does
  double nanoseconds = 0.0; ///< a sample
  double error = 0.0;       ///< that 99.9 % of the samples keep: at `steps`, or the least found
  std::vector<CurvePoint> tried;
};

/// Doubles the steps, on fewer and fewer samples, until 99.9 % of them keep to an error, or until
/// four doublings have not made the error less: where a surface is not the one that is asked for.
StepsFor FindSteps(
  const relief::HeightField& field, Stepping stepping, double error, int mostSteps);

/// How much of the way to the sphere, on average, lies below the highest ground: what steps that
/// ended there would save.
double ShareBelowTop(const relief::HeightField& field);

}

#endif
