// SPDX-License-Identifier: BSD-3-Clause
#include "MeshTriangles.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace relief
{

namespace
{
constexpr double Farthest = 1e100;

// A vector of any size that is finite and not 0.
glm::dvec3 Direction(const double v[3])
{
  const double most = std::max(std::max(std::abs(v[0]), std::abs(v[1])), std::abs(v[2]));
  const glm::dvec3 scaled(v[0] / most, v[1] / most, v[2] / most);
  return scaled / glm::length(scaled);
}

void Store(const glm::dvec3& v, double to[3])
{
  to[0] = v.x;
  to[1] = v.y;
  to[2] = v.z;
}
}

//------------------------------------------------------------------------------
ViewAxes MakeViewAxes(const double direction[3], const double up[3])
{
  const glm::dvec3 eye = Direction(direction);
  glm::dvec3 right(0.0);
  const double candidates[3][3] = { { up[0], up[1], up[2] }, { 0.0, 1.0, 0.0 },
    { 0.0, 0.0, -eye.y } };
  for (const double* candidate : candidates)
  {
    right = glm::cross(Direction(candidate), eye);
    const double length = glm::length(right);
    if (length > 0.0)
    {
      right /= length;
    }
    if (length > 1e-6)
    {
      break;
    }
  }
  ViewAxes view;
  Store(right, view.axes[0]);
  Store(glm::cross(eye, right), view.axes[1]);
  Store(eye, view.axes[2]);
  return view;
}

//------------------------------------------------------------------------------
void PointBounds::Add(const double from[3], const double to[3])
{
  for (int k = 0; k < 3; ++k)
  {
    this->low[k] = std::min(this->low[k], from[k]);
    this->high[k] = std::max(this->high[k], to[k]);
  }
}

//------------------------------------------------------------------------------
bool IsUsablePoint(const double point[3])
{
  return std::abs(point[0]) <= Farthest && std::abs(point[1]) <= Farthest &&
    std::abs(point[2]) <= Farthest;
}

//------------------------------------------------------------------------------
void FindMeshCenter(const PointBounds& usable, double center[3])
{
  std::fill_n(center, 3, 0.0);
  if (usable.IsEmpty())
  {
    return;
  }
  double size = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    size = std::max(size, usable.high[k] - usable.low[k]);
  }
  for (int k = 0; k < 3; ++k)
  {
    const double middle = 0.5 * usable.low[k] + 0.5 * usable.high[k];
    const double round = std::exp2(std::ceil(std::log2(size)));
    center[k] = std::abs(middle) <= 16.0 * size ? 0.0
      : size > 0.0                              ? std::round(middle / round) * round
                                                : middle;
  }
}

//------------------------------------------------------------------------------
void PlacePoint(
  const double point[3], const ViewAxes& view, const double center[3], double result[3])
{
  if (!IsUsablePoint(point))
  {
    std::fill_n(result, 3, std::numeric_limits<double>::quiet_NaN());
    return;
  }
  const double moved[3] = { point[0] - center[0], point[1] - center[1], point[2] - center[2] };
  view.Transform(moved, result);
}

//------------------------------------------------------------------------------
void FindTriangleBounds(MeshTriangles& triangles, const ParallelFor& parallelFor)
{
  const PointBounds all = FindPointBounds(triangles.corners.size(), parallelFor,
    [&triangles](std::size_t begin, std::size_t end, PointBounds& bounds)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        bounds.Add(triangles.points.data() + 3 * std::size_t{ triangles.corners[i] });
      }
    });
  for (int k = 0; k < 3; ++k)
  {
    triangles.bounds[2 * k] = all.low[k];
    triangles.bounds[2 * k + 1] = all.high[k];
  }
}

//------------------------------------------------------------------------------
void MoveToSamples(
  MeshTriangles& triangles, const HeightFrame& frame, const ParallelFor& parallelFor)
{
  double* points = triangles.points.data();
  ForPointBlocks(triangles.points.size() / 3, parallelFor,
    [&](std::size_t begin, std::size_t end, std::size_t)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        points[3 * i] = (points[3 * i] - frame.first[0]) / frame.spacing[0];
        points[3 * i + 1] = (points[3 * i + 1] - frame.first[1]) / frame.spacing[1];
      }
    });
}

}
