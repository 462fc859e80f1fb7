// SPDX-License-Identifier: BSD-3-Clause
#include "PolygonCutter.h"

#include "TriangleOrientation.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>

namespace relief
{

namespace
{
glm::dvec3 Vector(const double* from, const double* to)
{
  return { to[0] - from[0], to[1] - from[1], to[2] - from[2] };
}
}

//------------------------------------------------------------------------------
PolygonCutter::PolygonCutter(
  MeshTriangles& result, std::size_t firstPoint, std::size_t points, bool keepCells)
  : Result(result)
  , FirstPoint(firstPoint)
  , Points(points)
  , KeepCells(keepCells)
{
}

//------------------------------------------------------------------------------
bool PolygonCutter::AreUsable(const std::size_t* ids, std::size_t count) const
{
  return std::all_of(ids, ids + count,
    [this](std::size_t id) { return id < this->Points && IsUsablePoint(this->Point(id)); });
}

//------------------------------------------------------------------------------
// The normal of a triangle, as long as twice its area; returns the square of its longest edge.
double PolygonCutter::Turn(std::size_t a, std::size_t b, std::size_t c, double normal[3]) const
{
  const glm::dvec3 first = Vector(this->Point(a), this->Point(b));
  const glm::dvec3 second = Vector(this->Point(a), this->Point(c));
  const glm::dvec3 third = Vector(this->Point(b), this->Point(c));
  const glm::dvec3 turned = glm::cross(first, second);
  for (int k = 0; k < 3; ++k)
  {
    normal[k] = turned[k];
  }
  return std::max(
    std::max(glm::dot(first, first), glm::dot(second, second)), glm::dot(third, third));
}

//------------------------------------------------------------------------------
void PolygonCutter::AddTriangle(std::size_t cell, std::size_t a, std::size_t b, std::size_t c)
{
  const std::size_t ids[3] = { a, b, c };
  if (!this->AreUsable(ids, 3))
  {
    ++this->Result.notFinite;
    return;
  }
  // One without area but for rounding may lie between others, and stays.
  glm::dvec3 normal;
  const double longest = this->Turn(a, b, c, &normal.x);
  const double area = glm::length(normal);
  this->Result.degenerate += area <= 1e-14 * longest ? 1 : 0;
  if (area == 0.0)
  {
    return;
  }
  for (const std::size_t id : ids)
  {
    this->Result.corners.push_back(static_cast<std::uint32_t>(this->FirstPoint + id));
  }
  if (this->KeepCells)
  {
    this->Result.cells.push_back(static_cast<std::uint32_t>(cell));
  }
}

//------------------------------------------------------------------------------
void PolygonCutter::Cut(std::size_t cell)
{
  const std::size_t count = this->Ids.size();
  if (count < 3)
  {
    ++this->Result.degenerate;
    return;
  }
  if (count > 3 && !this->AreUsable(this->Ids.data(), count))
  {
    this->Result.notFinite += count - 2;
    return;
  }
  if (count == 4)
  {
    this->CutQuad(cell);
    return;
  }
  if (count == 3 || this->IsFan())
  {
    for (std::size_t k = 2; k < count; ++k)
    {
      this->AddTriangle(cell, this->Ids[0], this->Ids[k - 1], this->Ids[k]);
    }
    return;
  }
  if (!this->CutEars())
  {
    this->Result.degenerate += count - 2;
    return;
  }
  for (std::size_t k = 0; k < this->Ears.size(); k += 3)
  {
    this->AddTriangle(
      cell, this->Ids[this->Ears[k]], this->Ids[this->Ears[k + 1]], this->Ids[this->Ears[k + 2]]);
  }
}

//------------------------------------------------------------------------------
void PolygonCutter::CutAsStrip(std::size_t cell)
{
  for (std::size_t k = 2; k < this->Ids.size(); ++k)
  {
    // Every other one turns the other way.
    this->AddTriangle(cell, this->Ids[k - 2], this->Ids[k - 1 + k % 2], this->Ids[k - k % 2]);
  }
}

//------------------------------------------------------------------------------
// By the diagonal from its first corner unless that one lies outside.
void PolygonCutter::CutQuad(std::size_t cell)
{
  const std::vector<std::size_t>& ids = this->Ids;
  glm::dvec3 one;
  glm::dvec3 other;
  this->Turn(ids[0], ids[1], ids[2], &one.x);
  this->Turn(ids[0], ids[2], ids[3], &other.x);
  const std::size_t first = glm::dot(one, other) >= 0.0 ? 0 : 1;
  this->AddTriangle(cell, ids[first], ids[first + 1], ids[first + 2]);
  this->AddTriangle(cell, ids[first], ids[first + 2], ids[(first + 3) % 4]);
}

//------------------------------------------------------------------------------
// Whether all corners can be seen from the first one, as in all convex polygons: triangles there
// turn alike, and not once around.
bool PolygonCutter::IsFan() const
{
  const std::vector<std::size_t>& ids = this->Ids;
  glm::dvec3 sum(0.0);
  glm::dvec3 normal;
  for (std::size_t k = 2; k < ids.size(); ++k)
  {
    this->Turn(ids[0], ids[k - 1], ids[k], &normal.x);
    sum += normal;
  }
  double angle = 0.0;
  for (std::size_t k = 2; k < ids.size(); ++k)
  {
    const double longest = this->Turn(ids[0], ids[k - 1], ids[k], &normal.x);
    const glm::dvec3 first = Vector(this->Point(ids[0]), this->Point(ids[k - 1]));
    const glm::dvec3 second = Vector(this->Point(ids[0]), this->Point(ids[k]));
    angle += std::atan2(glm::length(normal), glm::dot(first, second));
    if (!(glm::dot(normal, sum) > 0.0 && glm::length(normal) > 1e-12 * longest))
    {
      return false;
    }
  }
  return angle < 6.28;
}

//------------------------------------------------------------------------------
// Looks at the polygon along the axis that its normal is nearest to, so that it turns
// counterclockwise. Returns whether it has a normal.
bool PolygonCutter::Flatten()
{
  const std::size_t count = this->Ids.size();
  const double* first = this->Point(this->Ids[0]);
  glm::dvec3 normal(0.0);
  for (std::size_t k = 2; k < count; ++k)
  {
    normal += glm::cross(
      Vector(first, this->Point(this->Ids[k - 1])), Vector(first, this->Point(this->Ids[k])));
  }
  int axis = 0;
  for (int k = 1; k < 3; ++k)
  {
    axis = std::abs(normal[k]) > std::abs(normal[axis]) ? k : axis;
  }
  int right = (axis + 1) % 3;
  int up = (axis + 2) % 3;
  if (normal[axis] < 0.0)
  {
    std::swap(right, up);
  }
  this->Flat.clear();
  for (const std::size_t id : this->Ids)
  {
    this->Flat.push_back(this->Point(id)[right]);
    this->Flat.push_back(this->Point(id)[up]);
  }
  return std::abs(normal[axis]) > 0.0;
}

//------------------------------------------------------------------------------
double PolygonCutter::Area(std::size_t a, std::size_t b, std::size_t c) const
{
  const double* flat = this->Flat.data();
  return OrientedArea(
    flat[2 * a], flat[2 * a + 1], flat[2 * b], flat[2 * b + 1], flat[2 * c], flat[2 * c + 1]);
}

//------------------------------------------------------------------------------
// Whether no other corner lies in the triangle of a corner and its neighbours, which has an area.
bool PolygonCutter::IsEar(std::size_t place) const
{
  const std::size_t size = this->Rest.size();
  const std::size_t a = this->Rest[(place + size - 1) % size];
  const std::size_t b = this->Rest[place];
  const std::size_t c = this->Rest[(place + 1) % size];
  if (!(this->Area(a, b, c) > 0.0))
  {
    return false;
  }
  const auto same = [this](std::size_t p, std::size_t q)
  {
    return this->Flat[2 * p] == this->Flat[2 * q] && this->Flat[2 * p + 1] == this->Flat[2 * q + 1];
  };
  return std::none_of(this->Rest.begin(), this->Rest.end(),
    [&](std::size_t p)
    {
      return !same(p, a) && !same(p, b) && !same(p, c) && this->Area(a, b, p) >= 0.0 &&
        this->Area(b, c, p) >= 0.0 && this->Area(c, a, p) >= 0.0;
    });
}

//------------------------------------------------------------------------------
// Returns whether the polygon could be cut.
bool PolygonCutter::CutEars()
{
  this->Ears.clear();
  this->Rest.clear();
  if (!this->Flatten())
  {
    return false;
  }
  for (std::size_t k = 0; k < this->Ids.size(); ++k)
  {
    this->Rest.push_back(k);
  }
  std::size_t place = 0;
  std::size_t tried = 0;
  while (this->Rest.size() > 3)
  {
    const std::size_t size = this->Rest.size();
    place = place < size ? place : 0;
    const std::size_t before = this->Rest[(place + size - 1) % size];
    const std::size_t corner = this->Rest[place];
    const std::size_t after = this->Rest[(place + 1) % size];
    // Corners on a straight line only where there is no true ear: what is beside them may end
    // there.
    const bool straight = tried >= size && this->Area(before, corner, after) == 0.0;
    if (straight || this->IsEar(place))
    {
      this->Ears.insert(this->Ears.end(), { before, corner, after });
      this->Rest.erase(this->Rest.begin() + static_cast<std::ptrdiff_t>(place));
      tried = 0;
    }
    else if (++tried > 2 * size)
    {
      return false;
    }
    // The neighbour of an ear comes last, lest all ears have one corner.
    ++place;
  }
  this->Ears.insert(this->Ears.end(), this->Rest.begin(), this->Rest.end());
  return true;
}

}
