// SPDX-License-Identifier: BSD-3-Clause
#ifndef RayThickness_h
#define RayThickness_h

#include "HeightView.h"
#include "ReliefModel.h"

#include <cstdint>

namespace relief
{

/// A light in the field's frame: x and y from the field's first sample, z from the field's height
/// 0.
struct Light
{
  glm::dvec3 vector =
    glm::dvec3(0.0, 0.0, 1.0); ///< position, or unit vector toward a directional light
  bool positional = false;
  glm::dvec3 color = glm::dvec3(1.0);
  double intensity = 1.0;
  double weight = 1.0;
  double open = 1.0;           ///< its illumination that counts as 1 in the mean over the lights
  double toleranceScale = 1.0; ///< what the medium's tolerance is multiplied by for this light
};

/// The model's types in one precision.
template <class Real>
struct Precision;

template <>
struct Precision<float>
{
  using Medium = f32::ReliefMedium;
  using Vec3 = glm::vec3;
};

template <>
struct Precision<double>
{
  using Medium = f64::ReliefMedium;
  using Vec3 = glm::dvec3;
};

f32::ReliefMedium ToSingle(const f64::ReliefMedium& medium);

/// Work done, for the statistics.
struct RayCount
{
  std::uint64_t rays = 0;
  std::uint64_t cells = 0;
};

/// Part of a row of samples that one light is traced for.
template <class Real>
struct RowRequest
{
  int j = 0;
  int begin = 0; ///< first sample
  int end = 0;   ///< one past the last
  /// The columns of end - begin samples, in rising order, where they are not side by side.
  const int* columns = nullptr;
  const typename Precision<Real>::Vec3* normals =
    nullptr;                             ///< unit normals, unless all offsets are vertical
  const unsigned char* wanted = nullptr; ///< samples to trace, null for all with data
  Real* illumination = nullptr;          ///< d; samples that are not traced are left alone
  Real* thickness = nullptr;             ///< r, or null

  /// The column of a sample, whose place in the arrays is k.
  int ColumnOf(int k) const { return this->columns ? this->columns[k] : this->begin + k; }
};

/// Illuminates samples ray by ray in closed form, in float or double, with the field's bounds or
/// without: in double without bounds it is the reference that everything faster is measured
/// against.
template <class Real, class T>
void TraceRow(const Field<T>& field, const typename Precision<Real>::Medium& medium,
  const Light& light, const RowRequest<Real>& request, RayCount& count);

/// The vector that the model's reliefRay() takes for a sample: subtracted in double, so that a lamp
/// close to a sample keeps its place.
template <class Real, class T>
typename Precision<Real>::Vec3 LightFrom(
  const Light& light, const HeightView<T>& heights, int i, int j)
{
  return typename Precision<Real>::Vec3(light.positional ? light.vector -
        glm::dvec3(
          i * heights.spacingX, j * heights.spacingY, static_cast<double>(heights.At(i, j)))
                                                         : light.vector);
}

/// Calls body(k, ray, n, l) for every sample of a request that has data and is wanted, k its place
/// in the request's arrays.
template <class Real, class FieldType, class Body>
void ForEachRay(const FieldType& field, const typename Precision<Real>::Medium& medium,
  const Light& light, const RowRequest<Real>& request, RayCount& count, Body&& body)
{
  using Vec3 = typename Precision<Real>::Vec3;
  for (int k = 0; k < request.end - request.begin; ++k)
  {
    const int i = request.ColumnOf(k);
    if (std::isnan(field.heights.At(i, request.j)) || (request.wanted && !request.wanted[k]))
    {
      continue;
    }
    Vec3 n = request.normals ? request.normals[k] : Vec3(0, 0, 1);
    Vec3 l;
    auto ray = reliefRay(field, medium, i, request.j, n,
      LightFrom<Real>(light, field.heights, i, request.j), light.positional, l);
    ++count.rays;
    body(k, ray, n, l);
  }
}

}

#endif
