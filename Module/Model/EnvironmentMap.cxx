// SPDX-License-Identifier: BSD-3-Clause
#include "EnvironmentMap.h"

#include "Angles.h"

#include <cmath>

namespace relief
{

RadianceMap MapOf(const ColorTexture& image, bool zenithFirst)
{
  RadianceMap map(image.columns, image.rows);
  for (int j = 0; j < image.rows; ++j)
  {
    for (int i = 0; i < image.columns; ++i)
    {
      map.Set(i, j, image.ReadColor(i, zenithFirst ? j : image.rows - 1 - j));
    }
  }
  return map;
}

RadianceMap WhiteDome()
{
  RadianceMap dome(1, 2);
  dome.Set(0, 0, glm::dvec3(1.0));
  return dome;
}

glm::dmat3 TurnOf(double rotationZ, double tilt)
{
  const double cz = CosDegrees(rotationZ);
  const double sz = SinDegrees(rotationZ);
  const double ct = CosDegrees(tilt);
  const double st = SinDegrees(tilt);
  return { { cz, ct * sz, st * sz }, { -sz, ct * cz, st * cz }, { 0.0, -st, ct } };
}

void PlaceAround(const HeightField& field, double radius, std::vector<Light>& lights)
{
  if (!std::isfinite(radius))
  {
    return;
  }
  const HeightView<float>& heights = field.GetField().heights;
  const glm::dvec3 center(0.5 * (heights.columns - 1) * heights.spacingX,
    0.5 * (heights.rows - 1) * heights.spacingY,
    field.HasData() ? 0.5 * (static_cast<double>(field.GetBottom()) + field.GetTop()) : 0.0);
  PlaceOnSphere(lights, center, radius);
}

}
