// SPDX-License-Identifier: BSD-3-Clause
#include "HardScene.h"

#include <algorithm>
#include <charconv>
#include <string>

namespace
{

// The shortest text that reads as the same number.
std::string Number(double x)
{
  if (std::isnan(x))
  {
    return "NoData";
  }
  if (std::isinf(x))
  {
    return x > 0.0 ? "Infinite" : "-Infinite";
  }
  char text[32];
  const std::string result(text, std::to_chars(text, text + sizeof text, x).ptr);
  return result.find_first_of(".e") == std::string::npos ? result + ".0" : result;
}

// A sun by its angles if whole degrees give it, by its vector otherwise.
std::string Code(const relief::Light& light)
{
  const glm::dvec3& v = light.vector;
  const std::string vector = Number(v.x) + ", " + Number(v.y) + ", " + Number(v.z);
  if (light.positional)
  {
    return "Lamp(" + vector + ")";
  }
  const double azimuth = std::round(std::atan2(v.x, v.y) * 180.0 / Pi);
  const double altitude = std::round(std::asin(std::min(std::max(v.z, -1.0), 1.0)) * 180.0 / Pi);
  if (Toward(azimuth, altitude) == v)
  {
    return "Sun(" + Number(azimuth) + ", " + Number(altitude) + ")";
  }
  return "Directional({ " + vector + " })";
}

}

std::ostream& operator<<(std::ostream& out, const HardScene& scene)
{
  const Terrain& terrain = scene.terrain;
  const relief::f64::ReliefMedium& medium = scene.medium;
  out << "HardScene scene;\nscene.terrain = Terrain(" << terrain.columns << ", " << terrain.rows
      << ", " << Number(terrain.spacingX) << ", " << Number(terrain.spacingY)
      << ");\nscene.terrain.heights = {";
  for (std::size_t k = 0; k < terrain.heights.size(); ++k)
  {
    out << (k == 0 ? " " : k % terrain.columns == 0 ? ",\n  " : ", ") << Number(terrain.heights[k]);
  }
  out << " };\nscene.medium = { " << Number(medium.depth) << ", "
      << (medium.offset == relief::f64::RELIEF_VERTICAL           ? "RELIEF_VERTICAL"
             : medium.offset == relief::f64::RELIEF_TANGENT_PLANE ? "RELIEF_TANGENT_PLANE"
                                                                  : "RELIEF_SURFACE_NORMAL")
      << ", "
      << (medium.attenuation == relief::f64::RELIEF_RECIPROCAL ? "RELIEF_RECIPROCAL"
                                                               : "RELIEF_EXPONENTIAL")
      << ", " << Number(medium.density) << ", " << (medium.useFloor ? "true" : "false") << ", "
      << Number(medium.floorHeight) << ", " << Number(medium.tolerance) << " };\nscene.lights = {";
  for (std::size_t k = 0; k < scene.lights.size(); ++k)
  {
    out << (k == 0 ? " " : ",\n  ") << Code(scene.lights[k]);
  }
  return out << " };\n";
}

Terrain WithoutInfinities(Terrain terrain)
{
  for (double& height : terrain.heights)
  {
    height = std::isinf(height) ? NoData : height;
  }
  return terrain;
}
