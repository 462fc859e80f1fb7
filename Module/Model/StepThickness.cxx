// SPDX-License-Identifier: BSD-3-Clause
#include "StepThickness.h"

#include <glm/geometric.hpp>

namespace relief
{

void StepRow(const Field<float>& field, const f32::ReliefMedium& medium, const Light& light,
  int steps, const RowRequest<float>& request, RayCount& count)
{
  ForEachRay<float>(field, medium, light, request, count,
    [&](int k, const f32::ReliefRay& ray, const glm::vec3&, const glm::vec3&)
    {
      int n = f32::reliefStepCount(field, ray, steps);
      request.illumination[k] = StepIllumination(n);
      count.cells += static_cast<std::uint64_t>(steps) + 1;
      if (request.thickness)
      {
        request.thickness[k] = StepLength(ray, n, steps);
      }
    });
}

Light OnBoundingSphere(
  const Light& light, const HeightView<float>& heights, double bottom, double top)
{
  glm::dvec3 size(
    (heights.columns - 1) * heights.spacingX, (heights.rows - 1) * heights.spacingY, top - bottom);
  Light placed = light;
  placed.positional = true;
  placed.vector = glm::dvec3(size.x / 2.0, size.y / 2.0, bottom + size.z / 2.0) +
    light.vector * (glm::length(size) / 2.0);
  return placed;
}

}
