// SPDX-License-Identifier: BSD-3-Clause
#include "SceneBounds.h"

#include <glm/common.hpp>

#include <algorithm>
#include <cmath>

namespace relief
{

namespace
{
constexpr double LargestColor = 1e6;
constexpr double LargestRadiance = 1e30;
constexpr double LargestNumber = 1e30;
constexpr double LargestHeight = 4e37; // beyond any relief that is not refused

double Bounded(double value, double largest)
{
  return std::clamp(value, -largest, largest);
}

void Bound(f64::ReliefFalloff& falloff)
{
  falloff.lo = Bounded(falloff.lo, LargestNumber);
  falloff.hi = Bounded(falloff.hi, LargestNumber);
  falloff.power = Bounded(falloff.power, LargestNumber);
}
}

void Bound(Light& light)
{
  const double length = std::hypot(light.vector.x, light.vector.y, light.vector.z);
  if (light.positional && length > LargestLength)
  {
    light.vector *= LargestLength / length;
  }
  const double brightest =
    std::max({ std::abs(light.color.x), std::abs(light.color.y), std::abs(light.color.z) }) *
    std::abs(light.weight);
  if (std::abs(light.intensity) * brightest > LargestRadiance)
  {
    light.intensity = std::copysign(LargestRadiance / brightest, light.intensity);
  }
}

void Bound(Scene& scene)
{
  for (glm::dvec3* color : { &scene.base, &scene.diffuse, &scene.specular })
  {
    *color = glm::min(*color, LargestColor);
  }
  Bound(scene.specularFalloff);
  Bound(scene.scatterFalloff);
  f64::ReliefMedium& medium = scene.medium;
  medium.depth = std::min(medium.depth, LargestLength);
  medium.density = std::min(medium.density, LargestNumber);
  medium.floorHeight = Bounded(medium.floorHeight, LargestHeight);
  medium.tolerance = std::min(medium.tolerance, 1.0); // of d, which is no more
}

}
