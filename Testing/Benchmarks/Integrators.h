// SPDX-License-Identifier: BSD-3-Clause
#ifndef Integrators_h
#define Integrators_h

/// @file
/// Each way to get the illumination d of a field, called in the same manner, on one thread.

#include "HeightField.h"
#include "RayThickness.h"

#include <string>
#include <vector>

namespace bench
{

/// Samples on which what is too slow for all of them is measured: some rows, and in these one
/// sample of every `stride`.
struct Probe
{
  std::vector<int> rows;
  int columns = 0;
  int stride = 1;

  std::size_t Size() const { return this->rows.size() * ((this->columns - 1) / this->stride + 1); }
};

/// A probe of about so many samples, spread evenly: as many whole rows as a quarter of the field's
/// at most.
Probe SpreadProbe(const relief::HeightField& field, std::size_t samples);

/// The same rows, thinned to about so many samples.
Probe Thinned(const Probe& probe, std::size_t samples);

/// The unit vector toward a sun, azimuth clockwise from +y and altitude in degrees.
relief::Light Sun(double azimuth, double altitude);

/// A lamp in the direction of a sun, at a distance from the field's centre in widths of the field.
relief::Light Lamp(
  const relief::HeightField& field, double azimuth, double altitude, double widths);

/// A sun as the fixed steps take it: on the sphere about the field.
relief::Light SunOnSphere(const relief::HeightField& field, double azimuth, double altitude);

/// t = one sample's spacing, reciprocal attenuation.
relief::f64::ReliefMedium Medium(
  const relief::HeightField& field, double tolerance, int offset = relief::f64::RELIEF_VERTICAL);

/// Lockstep, all samples: d has columns x rows values.
void RunSweep(const relief::HeightField& field, const relief::f64::ReliefMedium& medium,
  const relief::Light& light, float* d);

/// What the filter runs, whatever that is for the light: all samples, d alone.
void RunScene(const relief::HeightField& field, const relief::f64::ReliefMedium& medium,
  const relief::Light& light, float* d);

/// Ray by ray with bounds, in float. Values stand row by row as in the probe; those of samples
/// that the stride leaves out are not written.
void RunRays(const relief::HeightField& field, const relief::f64::ReliefMedium& medium,
  const relief::Light& light, const Probe& probe, float* d);

/// The reference: ray by ray, in double, without bounds.
void RunReference(const relief::HeightField& field, const relief::f64::ReliefMedium& medium,
  const relief::Light& light, const Probe& probe, double* d);

/// Fixed steps, in three readings. The light must be positional.
enum class Stepping
{
  Published, ///< Algorithm 1: d = 1 / (1 + n)
  Thickness, ///< the same points, but d = min(1, t / r) of the thickness r = n steps
  Bilinear   ///< the same with the bilinear surface, points amid the steps, level beyond the edges
};

void RunSteps(const relief::HeightField& field, const relief::f64::ReliefMedium& medium,
  const relief::Light& light, Stepping stepping, int steps, const Probe& probe, float* d);

/// How far values of d are from the reference: the largest error, the one that 99.9 % of the
/// samples keep, and the root of the mean square.
struct ErrorOfD
{
  double most = 0.0;
  double mostOf999 = 0.0;
  double rms = 0.0;
};

/// Compares values that stand as a probe's.
ErrorOfD Compare(const Probe& probe, const std::vector<double>& reference, const float* d);

/// Takes a probe's rows out of all samples.
std::vector<float> Pick(const Probe& probe, const std::vector<float>& all);

/// The processor's name, the instruction set in use, compiler and date, for the head of a report.
std::string Environment();

}

#endif
