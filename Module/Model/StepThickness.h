// SPDX-License-Identifier: BSD-3-Clause
#ifndef StepThickness_h
#define StepThickness_h

#include "RayThickness.h"

namespace relief
{

/// Illuminates samples by Algorithm 1 of the thesis (section 4.3.1) as published: d = 1 / (1 + n),
/// n the number of the steps + 1 points of the ray that stand below the surface. The light must be
/// positional. The thickness it tells is n times the step.
void StepRow(const Field<float>& field, const f32::ReliefMedium& medium, const Light& light,
  int steps, const RowRequest<float>& request, RayCount& count);

///@{
/// What n points of a ray below the surface make of d and of r.
inline float StepIllumination(int n)
{
  return 1.0f / (1.0f + static_cast<float>(n));
}

inline float StepLength(const f32::ReliefRay& ray, int n, int steps)
{
  return ray.end * (static_cast<float>(n) / static_cast<float>(steps));
}
///@}

/// A directional light put on the sphere about the field's bounding box, from bottom to top, which
/// gives the algorithm the positional light that it needs.
Light OnBoundingSphere(
  const Light& light, const HeightView<float>& heights, double bottom, double top);

}

#endif
