// SPDX-License-Identifier: BSD-3-Clause
#include "RayThickness.h"

namespace relief
{

f32::ReliefMedium ToSingle(const f64::ReliefMedium& medium)
{
  f32::ReliefMedium single;
  // What is made of so small a depth would have few digits; d is its limit, to all that float has.
  const float depth = static_cast<float>(medium.depth);
  const float least = std::numeric_limits<float>::min() / std::numeric_limits<float>::epsilon();
  single.depth = depth < least ? 0.0f : depth;
  single.offset = medium.offset;
  single.attenuation = medium.attenuation;
  single.density = static_cast<float>(medium.density);
  single.useFloor = medium.useFloor;
  single.floorHeight = static_cast<float>(medium.floorHeight);
  single.tolerance = static_cast<float>(medium.tolerance);
  return single;
}

template <class Real, class T>
void TraceRow(const Field<T>& field, const typename Precision<Real>::Medium& medium,
  const Light& light, const RowRequest<Real>& request, RayCount& count)
{
  ForEachRay<Real>(field, medium, light, request, count,
    [&](int k, const auto& ray, const auto& n, const auto& l)
    {
      decltype(reliefTrace(field, medium, ray)) trace;
      request.illumination[k] = reliefExact(field, medium, ray, n, l, trace);
      count.cells += trace.cells;
      if (request.thickness)
      {
        request.thickness[k] = trace.thickness;
      }
    });
}

template void TraceRow<float>(
  const Field<float>&, const f32::ReliefMedium&, const Light&, const RowRequest<float>&, RayCount&);
template void TraceRow<double>(const Field<float>&, const f64::ReliefMedium&, const Light&,
  const RowRequest<double>&, RayCount&);
template void TraceRow<double>(const Field<double>&, const f64::ReliefMedium&, const Light&,
  const RowRequest<double>&, RayCount&);

}
