// SPDX-License-Identifier: BSD-3-Clause
#include "LightSampling.h"

#include "Angles.h"
#include "ImportanceSampling.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace relief
{

namespace
{

constexpr double GoldenRatio = 0.61803398874989484820; // (sqrt(5) - 1) / 2

double MiddleAzimuth(const SkyPatch& patch)
{
  return 0.5 * (patch.azimuth0 + patch.azimuth1);
}

// Patches of equal azimuth and polar angle, row by row.
std::vector<PatchLight> DivideUniformly(int samples)
{
  const int rows = static_cast<int>(std::lround(std::sqrt(samples)));
  std::vector<PatchLight> lights;
  for (int row = 0; row < rows; ++row)
  {
    const std::int64_t first = static_cast<std::int64_t>(samples) * row / rows;
    const std::int64_t end = static_cast<std::int64_t>(samples) * (row + 1) / rows;
    const double step = 2.0 * Pi / static_cast<double>(end - first);
    const double m0 = FromZenith(first, samples);
    const double m1 = FromZenith(end, samples);
    const double height = std::cos(0.5 * Pi * static_cast<double>(first + end) / samples);
    for (std::int64_t k = 0; k < end - first; ++k)
    {
      const SkyPatch patch = { step * static_cast<double>(k), step * static_cast<double>(k + 1), m0,
        m1 };
      lights.push_back({ patch, SkyDirection(height, MiddleAzimuth(patch)) });
    }
  }
  return lights;
}

// Patches of equal area for the upper half of the sphere, from the zenith down.
std::vector<SkyPatch> HalfSphere(int count)
{
  // As many bands as make patches as wide as high; a patch covers 2 pi / count.
  const int bands = std::max(1, static_cast<int>(std::lround(std::sqrt(Pi * count / 8.0))));
  const int symmetry = count % 4 == 0 ? 4 : 1;
  const int least = std::max(3, symmetry);
  std::vector<SkyPatch> patches;
  int first = 0;
  for (int band = 0; first < count; ++band)
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
  }
  return patches;
}

std::vector<PatchLight> DivideBySolidAngle(int samples)
{
  if (samples == 1)
  {
    // As high as gives level ground what the upper half gives.
    return { { { 0.0, 2.0 * Pi, 0.0, 2.0 }, SkyDirection(0.25, Pi) } };
  }
  std::vector<SkyPatch> patches = HalfSphere((samples + 1) / 2);
  for (const SkyPatch& patch : HalfSphere(samples / 2))
  {
    patches.push_back({ patch.azimuth0, patch.azimuth1, 2.0 - patch.m1, 2.0 - patch.m0 });
  }
  std::vector<PatchLight> lights;
  lights.reserve(patches.size());
  for (const SkyPatch& patch : patches)
  {
    lights.push_back(
      { patch, SkyDirection(1.0 - 0.5 * (patch.m0 + patch.m1), MiddleAzimuth(patch)) });
  }
  return lights;
}

// How far each of the Uniform lights may err, in units of what is allowed for the map's mean. It
// must not change when the map turns, so whole rows are looked at: the lights' own sum differs in
// its last digits.
double UniformTolerance(const RadianceMap& map, const std::vector<PatchLight>& divided)
{
  TurnedMap still(map, 0.0);
  glm::dvec3 sum(0.0);
  glm::dvec3 rowMean(0.0);
  double row = -1.0; // where the row of patches begins
  for (const PatchLight& one : divided)
  {
    if (one.patch.m0 != row)
    {
      row = one.patch.m0;
      rowMean = still.Mean({ 0.0, 2.0 * Pi, row, one.patch.m1 });
    }
    sum += rowMean / static_cast<double>(divided.size());
  }
  const glm::dvec3 mean = map.GetMean();
  double scale = 1.0;
  for (int c = 0; c < 3; ++c)
  {
    scale = sum[c] > 0.0 ? std::min(scale, mean[c] / sum[c]) : scale;
  }
  return scale;
}

// Were work per light inverse to its tolerance, it would be least with tolerances that are inverse
// to the root of a light's share.
void ShareTolerance(const glm::dvec3& mean, std::vector<Light>& lights)
{
  std::vector<double> roots;
  double sum = 0.0;
  for (const Light& light : lights)
  {
    double share = 0.0;
    for (int c = 0; c < 3; ++c)
    {
      share = mean[c] > 0.0 ? std::max(share, light.weight * light.color[c] / mean[c]) : share;
    }
    roots.push_back(std::sqrt(share));
    sum += roots.back();
  }
  for (std::size_t k = 0; k < lights.size(); ++k)
  {
    lights[k].toleranceScale = roots[k] > 0.0 ? 1.0 / (roots[k] * sum) : 1.0;
  }
}

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
  glm::dmat3 place = mirror * m * turnBack;
  // Without the last digits, which differ from turn to turn, a turning map keeps its directions,
  // and with them all that is known of the rays.
  constexpr double digits = 1ll << 44;
  for (int k = 0; k < 3; ++k)
  {
    place[k] = glm::round(place[k] * digits) / digits;
  }

  const bool uniform = sampling == EnvironmentSampling::Uniform;
  const std::vector<PatchLight> divided = uniform ? DivideUniformly(samples)
    : sampling == EnvironmentSampling::SolidAngle ? DivideBySolidAngle(samples)
                                                  : DivideByImportance(map, turn, samples);
  TurnedMap turned(map, turn);
  std::vector<Light> lights;
  lights.reserve(divided.size());
  const bool important = sampling == EnvironmentSampling::Importance;
  const double even = uniform ? UniformTolerance(map, divided) : 0.25; // weights sum to 4
  for (const PatchLight& one : divided)
  {
    Light light;
    light.vector = glm::normalize(place * one.toward);
    light.color = turned.Mean(one.patch);
    light.weight = uniform ? 1.0 / samples : one.patch.Area() / Pi;
    light.open = std::max(light.vector.z, 0.0); // on level ground
    light.toleranceScale = even;
    lights.push_back(light);
  }
  if (important)
  {
    ShareTolerance(map.GetMean(), lights);
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
