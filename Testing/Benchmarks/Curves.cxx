// SPDX-License-Identifier: BSD-3-Clause
#include "Curves.h"

#include "Timing.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <sstream>
#include <string>

namespace bench
{

namespace
{
std::string Name(const char* before)
{
  std::ostringstream name;
  name << before << "tolerance " << MarkedTolerance;
  return name.str();
}
const std::string MarkedName = Name("");
const std::string ExactMarkedName = Name("exact, ");
}

const char* const Marked = MarkedName.c_str();
const char* const ExactMarked = ExactMarkedName.c_str();
const char* const Lockstep = "exact, sun, in lockstep";
const char* const LampScene = "exact, lamp";
const char* const RayByRay = "exact, sun, ray by ray";
const char* const StepsPublished = "fixed steps, d = 1 / (1 + n) as published";
const char* const StepsThickness = "fixed steps, d = t / r";
const char* const StepsBilinear = "fixed steps, d = t / r, bilinear surface";

namespace
{
const double Tolerances[] = { 0.0, 1e-4, MarkedTolerance, 1e-3, 2e-3, 5e-3, 0.01, 0.02, 0.05, 0.1 };

// Samples on which errors are measured, and, of these, as many as keep a run of fixed steps short.
constexpr std::size_t ProbeSize = 131072;
constexpr double StepBudget = 1.0e8;
constexpr std::size_t LeastSamples = 8192;

Probe ProbeForSteps(const Probe& probe, int steps)
{
  const auto affordable = static_cast<std::size_t>(StepBudget / steps);
  return Thinned(probe, affordable > LeastSamples ? affordable : LeastSamples);
}

const std::pair<Stepping, const char*> Steppings[] = { { Stepping::Published, StepsPublished },
  { Stepping::Thickness, StepsThickness }, { Stepping::Bilinear, StepsBilinear } };
}

std::vector<CurvePoint> MeasureCurves(const Relief& relief, int repetitions, int mostSteps)
{
  const auto field = Prepare(relief);
  const Probe probe = SpreadProbe(*field, ProbeSize);
  const relief::Light sun = Sun(CurveAzimuth, CurveAltitude);
  const relief::Light lamp = Lamp(*field, CurveAzimuth, CurveAltitude, LampDistance);
  const relief::Light sphere = SunOnSphere(*field, CurveAzimuth, CurveAltitude);
  const std::size_t probeValues = probe.rows.size() * probe.columns;
  auto reference = [&](const relief::Light& light)
  {
    std::vector<double> d(probeValues, std::numeric_limits<double>::quiet_NaN());
    RunReference(*field, Medium(*field, 0.0), light, probe, d.data());
    return d;
  };
  const std::vector<double> sunReference = reference(sun);
  const std::vector<double> lampReference = reference(lamp);
  const std::vector<double> sphereReference = reference(sphere);

  std::vector<float> all(relief.heights.size());
  std::vector<float> some(probeValues);
  std::vector<CurvePoint> points;
  std::vector<Rival> rivals;
  // Each point's run, and the comparison of what it has left.
  auto add = [&](const char* integrator, double knob, std::size_t samples,
               const std::function<void()>& run, const std::function<ErrorOfD()>& compare)
  {
    run();
    points.push_back({ relief.name, integrator, knob, 0.0, compare() });
    Rival rival;
    rival.samples = static_cast<double>(samples);
    rival.run = run;
    rivals.push_back(rival);
  };

  for (double tolerance : Tolerances)
  {
    const relief::f64::ReliefMedium medium = Medium(*field, tolerance);
    add(
      Lockstep, tolerance, all.size(), [&, medium] { RunSweep(*field, medium, sun, all.data()); },
      [&] { return Compare(probe, sunReference, Pick(probe, all).data()); });
    add(
      LampScene, tolerance, all.size(), [&, medium] { RunScene(*field, medium, lamp, all.data()); },
      [&] { return Compare(probe, lampReference, Pick(probe, all).data()); });
    add(
      RayByRay, tolerance, probe.Size(),
      [&, medium] { RunRays(*field, medium, sun, probe, some.data()); },
      [&] { return Compare(probe, sunReference, some.data()); });
  }
  for (const auto& [stepping, name] : Steppings)
  {
    for (int steps = 8; steps <= mostSteps; steps *= 2)
    {
      const Probe thin = ProbeForSteps(probe, steps);
      add(
        name, steps, thin.Size(),
        [&, thin, steps, stepping = stepping]
        { RunSteps(*field, Medium(*field, 0.0), sphere, stepping, steps, thin, some.data()); },
        [&, thin] { return Compare(thin, sphereReference, some.data()); });
    }
  }
  Race(rivals, repetitions, false);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    points[k].nanoseconds = rivals[k].Least();
  }
  return points;
}

StepsFor FindSteps(const relief::HeightField& field, Stepping stepping, double error, int mostSteps)
{
  const Probe probe = SpreadProbe(field, ProbeSize);
  const relief::Light sphere = SunOnSphere(field, CurveAzimuth, CurveAltitude);
  std::vector<double> reference(probe.rows.size() * probe.columns);
  RunReference(field, Medium(field, 0.0), sphere, probe, reference.data());
  std::vector<float> d(reference.size());
  StepsFor found;
  found.error = std::numeric_limits<double>::infinity();
  int since = 0;
  for (int steps = 256; steps <= mostSteps; steps *= 2)
  {
    const Probe thin = ProbeForSteps(probe, steps);
    const double start = Seconds(Clock::Thread);
    RunSteps(field, Medium(field, 0.0), sphere, stepping, steps, thin, d.data());
    const double time = Seconds(Clock::Thread) - start;
    const ErrorOfD measured = Compare(thin, reference, d.data());
    const double reached = measured.mostOf999;
    const double nanoseconds = 1.0e9 * time / static_cast<double>(thin.Size());
    found.tried.push_back({ "", "", static_cast<double>(steps), nanoseconds, measured });
    since = reached < 0.9 * found.error ? 0 : since + 1;
    found.error = std::min(found.error, reached);
    if (reached <= error)
    {
      found.steps = steps;
      found.nanoseconds = nanoseconds;
      return found;
    }
    if (since == 4)
    {
      break;
    }
  }
  return found;
}

double ShareBelowTop(const relief::HeightField& field)
{
  const relief::HeightView<float>& heights = field.GetField().heights;
  const relief::Light sphere = SunOnSphere(field, CurveAzimuth, CurveAltitude);
  const Probe probe = SpreadProbe(field, ProbeSize);
  double sum = 0.0;
  for (int j : probe.rows)
  {
    for (int i = 0; i < probe.columns; ++i)
    {
      const double height = heights.At(i, j);
      const double rise = sphere.vector.z - height;
      sum += rise > 0.0 ? std::min((field.GetTop() - height) / rise, 1.0) : 1.0;
    }
  }
  return sum / static_cast<double>(probe.Size());
}

}
