// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefMeshTriangles.h"

#include "vtkCellArray.h"
#include "vtkIdList.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolygon.h"

#include "HeightInputs.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relief::hosts
{

namespace
{
constexpr double Farthest = 1e100;
constexpr std::size_t BlockSize = 65536;

// A vector of any size that is finite and not 0.
void Normalize(const double from[3], double to[3])
{
  const double most = std::max(std::max(std::abs(from[0]), std::abs(from[1])), std::abs(from[2]));
  for (int k = 0; k < 3; ++k)
  {
    to[k] = from[k] / most;
  }
  vtkMath::Normalize(to);
}

bool IsUsable(const double point[3])
{
  return std::abs(point[0]) <= Farthest && std::abs(point[1]) <= Farthest &&
    std::abs(point[2]) <= Farthest;
}

//------------------------------------------------------------------------------
// Calls body(begin, end, block) for blocks of [0, count), on many threads.
template <class Body>
void ForBlocks(std::size_t count, const Body& body)
{
  ForRows(static_cast<int>((count + BlockSize - 1) / BlockSize),
    [&](int begin, int end)
    {
      for (std::size_t block = static_cast<std::size_t>(begin);
           block < static_cast<std::size_t>(end); ++block)
      {
        body(block * BlockSize, std::min((block + 1) * BlockSize, count), block);
      }
    });
}

// Bounds that are empty as they begin.
struct Bounds
{
  double low[3];
  double high[3];

  Bounds()
  {
    std::fill_n(this->low, 3, std::numeric_limits<double>::infinity());
    std::fill_n(this->high, 3, -std::numeric_limits<double>::infinity());
  }
  void Add(const double point[3]) { this->Add(point, point); }
  void Add(const double from[3], const double to[3])
  {
    for (int k = 0; k < 3; ++k)
    {
      this->low[k] = std::min(this->low[k], from[k]);
      this->high[k] = std::max(this->high[k], to[k]);
    }
  }
};

// The bounds of what body(begin, end, bounds) adds of [0, count), on many threads.
template <class Body>
Bounds FindBounds(std::size_t count, const Body& body)
{
  std::vector<Bounds> parts((count + BlockSize - 1) / BlockSize);
  ForBlocks(count,
    [&](std::size_t begin, std::size_t end, std::size_t block) { body(begin, end, parts[block]); });
  Bounds all;
  for (const Bounds& part : parts)
  {
    all.Add(part.low, part.high);
  }
  return all;
}

//------------------------------------------------------------------------------
// What points are measured from, for those of a small scene far from the origin to keep their
// digits: 0 near the origin, else a round number, so that differences are exact in most scenes.
void FindSceneCenter(const std::vector<vtkPolyData*>& meshes, double center[3])
{
  Bounds all;
  for (vtkPolyData* mesh : meshes)
  {
    vtkPoints* points = mesh->GetPoints();
    const Bounds own = FindBounds(static_cast<std::size_t>(mesh->GetNumberOfPoints()),
      [points](std::size_t begin, std::size_t end, Bounds& bounds)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          double point[3];
          points->GetPoint(static_cast<vtkIdType>(i), point);
          if (IsUsable(point))
          {
            bounds.Add(point);
          }
        }
      });
    all.Add(own.low, own.high);
  }
  std::fill_n(center, 3, 0.0);
  if (!(all.low[0] <= all.high[0]))
  {
    return;
  }
  double size = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    size = std::max(size, all.high[k] - all.low[k]);
  }
  for (int k = 0; k < 3; ++k)
  {
    const double middle = 0.5 * all.low[k] + 0.5 * all.high[k];
    const double round = std::exp2(std::ceil(std::log2(size)));
    center[k] = std::abs(middle) <= 16.0 * size ? 0.0
      : size > 0.0                              ? std::round(middle / round) * round
                                                : middle;
  }
}

//------------------------------------------------------------------------------
// Cuts the cells of one mesh, and keeps what is of use.
class Cutter
{
public:
  Cutter(const MeshPart& part, bool keepCells, MeshTriangles& result)
    : Part(part)
    , KeepCells(keepCells)
    , Result(result)
    , Points(part.mesh->GetNumberOfPoints())
  {
  }

  void CutPolygons();
  void CutStrips();

private:
  const double* Point(vtkIdType id) const
  {
    return this->Result.points.data() + 3 * (this->Part.firstPoint + static_cast<std::size_t>(id));
  }
  bool AreUsable(vtkIdType count, const vtkIdType* ids) const;
  void AddTriangle(vtkIdType cell, vtkIdType a, vtkIdType b, vtkIdType c);
  void AddQuad(vtkIdType cell, const vtkIdType* ids);
  void AddPolygon(vtkIdType cell, vtkIdType count, const vtkIdType* ids);
  bool IsFan(vtkIdType count, const vtkIdType* ids) const;
  double Turn(vtkIdType a, vtkIdType b, vtkIdType c, double normal[3]) const;

  const MeshPart& Part;
  bool KeepCells;
  MeshTriangles& Result;
  vtkIdType Points;
  vtkNew<vtkPolygon> Polygon;
  vtkNew<vtkIdList> Ears;
};

//------------------------------------------------------------------------------
bool Cutter::AreUsable(vtkIdType count, const vtkIdType* ids) const
{
  return std::all_of(ids, ids + count,
    [this](vtkIdType id) { return id >= 0 && id < this->Points && IsUsable(this->Point(id)); });
}

//------------------------------------------------------------------------------
// The normal of a triangle, as long as twice its area; returns the square of its longest edge.
double Cutter::Turn(vtkIdType a, vtkIdType b, vtkIdType c, double normal[3]) const
{
  double first[3];
  double second[3];
  double third[3];
  vtkMath::Subtract(this->Point(b), this->Point(a), first);
  vtkMath::Subtract(this->Point(c), this->Point(a), second);
  vtkMath::Subtract(this->Point(c), this->Point(b), third);
  vtkMath::Cross(first, second, normal);
  return std::max(
    std::max(vtkMath::Dot(first, first), vtkMath::Dot(second, second)), vtkMath::Dot(third, third));
}

//------------------------------------------------------------------------------
void Cutter::AddTriangle(vtkIdType cell, vtkIdType a, vtkIdType b, vtkIdType c)
{
  const vtkIdType ids[3] = { a, b, c };
  if (!this->AreUsable(3, ids))
  {
    ++this->Result.notFinite;
    return;
  }
  // One without area but for rounding may lie between others, and stays.
  double normal[3];
  const double longest = this->Turn(a, b, c, normal);
  const double area = vtkMath::Norm(normal);
  this->Result.degenerate += area <= 1e-14 * longest ? 1 : 0;
  if (area == 0.0)
  {
    return;
  }
  for (const vtkIdType id : ids)
  {
    this->Result.corners.push_back(
      static_cast<std::uint32_t>(this->Part.firstPoint + static_cast<std::size_t>(id)));
  }
  if (this->KeepCells)
  {
    this->Result.cells.push_back(static_cast<std::uint32_t>(cell));
  }
}

//------------------------------------------------------------------------------
// By the diagonal from its first corner unless that one lies outside.
void Cutter::AddQuad(vtkIdType cell, const vtkIdType* ids)
{
  double one[3];
  double other[3];
  this->Turn(ids[0], ids[1], ids[2], one);
  this->Turn(ids[0], ids[2], ids[3], other);
  const int first = vtkMath::Dot(one, other) >= 0.0 ? 0 : 1;
  this->AddTriangle(cell, ids[first], ids[first + 1], ids[first + 2]);
  this->AddTriangle(cell, ids[first], ids[first + 2], ids[(first + 3) % 4]);
}

//------------------------------------------------------------------------------
// Whether all corners can be seen from the first one, as in all convex polygons: triangles there
// turn alike, and not once around.
bool Cutter::IsFan(vtkIdType count, const vtkIdType* ids) const
{
  double sum[3] = { 0.0, 0.0, 0.0 };
  double normal[3];
  for (vtkIdType k = 2; k < count; ++k)
  {
    this->Turn(ids[0], ids[k - 1], ids[k], normal);
    vtkMath::Add(sum, normal, sum);
  }
  double angle = 0.0;
  for (vtkIdType k = 2; k < count; ++k)
  {
    const double longest = this->Turn(ids[0], ids[k - 1], ids[k], normal);
    double first[3];
    double second[3];
    vtkMath::Subtract(this->Point(ids[k - 1]), this->Point(ids[0]), first);
    vtkMath::Subtract(this->Point(ids[k]), this->Point(ids[0]), second);
    angle += std::atan2(vtkMath::Norm(normal), vtkMath::Dot(first, second));
    if (!(vtkMath::Dot(normal, sum) > 0.0 && vtkMath::Norm(normal) > 1e-12 * longest))
    {
      return false;
    }
  }
  return angle < 6.28;
}

//------------------------------------------------------------------------------
// By its ears, which is what most concave ones need.
void Cutter::AddPolygon(vtkIdType cell, vtkIdType count, const vtkIdType* ids)
{
  if (!this->AreUsable(count, ids))
  {
    this->Result.notFinite += static_cast<std::size_t>(count - 2);
    return;
  }
  if (this->IsFan(count, ids))
  {
    for (vtkIdType k = 2; k < count; ++k)
    {
      this->AddTriangle(cell, ids[0], ids[k - 1], ids[k]);
    }
    return;
  }
  this->Polygon->PointIds->SetNumberOfIds(count);
  this->Polygon->Points->SetDataTypeToDouble();
  this->Polygon->Points->SetNumberOfPoints(count);
  for (vtkIdType k = 0; k < count; ++k)
  {
    this->Polygon->PointIds->SetId(k, k);
    this->Polygon->Points->SetPoint(k, this->Point(ids[k]));
  }
  this->Ears->Reset();
  if (!this->Polygon->EarCutTriangulation(this->Ears) || this->Ears->GetNumberOfIds() % 3 != 0)
  {
    this->Result.degenerate += static_cast<std::size_t>(count - 2);
    return;
  }
  for (vtkIdType k = 0; k < this->Ears->GetNumberOfIds(); k += 3)
  {
    this->AddTriangle(cell, ids[this->Ears->GetId(k)], ids[this->Ears->GetId(k + 1)],
      ids[this->Ears->GetId(k + 2)]);
  }
}

//------------------------------------------------------------------------------
void Cutter::CutPolygons()
{
  vtkCellArray* polygons = this->Part.mesh->GetPolys();
  const vtkIdType firstCell =
    this->Part.mesh->GetNumberOfVerts() + this->Part.mesh->GetNumberOfLines();
  for (vtkIdType i = 0; i < polygons->GetNumberOfCells(); ++i)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    polygons->GetCellAtId(i, count, ids);
    if (count == 3)
    {
      this->AddTriangle(firstCell + i, ids[0], ids[1], ids[2]);
    }
    else if (count == 4 && this->AreUsable(4, ids))
    {
      this->AddQuad(firstCell + i, ids);
    }
    else if (count > 3)
    {
      this->AddPolygon(firstCell + i, count, ids);
    }
    else
    {
      ++this->Result.degenerate;
    }
  }
}

//------------------------------------------------------------------------------
void Cutter::CutStrips()
{
  vtkCellArray* strips = this->Part.mesh->GetStrips();
  const vtkIdType firstCell = this->Part.mesh->GetNumberOfVerts() +
    this->Part.mesh->GetNumberOfLines() + this->Part.mesh->GetNumberOfPolys();
  for (vtkIdType i = 0; i < strips->GetNumberOfCells(); ++i)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    strips->GetCellAtId(i, count, ids);
    for (vtkIdType k = 2; k < count; ++k)
    {
      // Every other one turns the other way.
      this->AddTriangle(firstCell + i, ids[k - 2], ids[k - 1 + k % 2], ids[k - k % 2]);
    }
  }
}

//------------------------------------------------------------------------------
void TransformPoints(
  vtkPoints* points, const ViewAxes& view, const double center[3], double* result)
{
  ForBlocks(static_cast<std::size_t>(points->GetNumberOfPoints()),
    [&](std::size_t begin, std::size_t end, std::size_t)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        double point[3];
        points->GetPoint(static_cast<vtkIdType>(i), point);
        if (!IsUsable(point))
        {
          std::fill_n(result + 3 * i, 3, std::numeric_limits<double>::quiet_NaN());
          continue;
        }
        vtkMath::Subtract(point, center, point);
        view.Transform(point, result + 3 * i);
      }
    });
}

//------------------------------------------------------------------------------
void FindTriangleBounds(MeshTriangles& triangles)
{
  const Bounds all = FindBounds(triangles.corners.size(),
    [&triangles](std::size_t begin, std::size_t end, Bounds& bounds)
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
}

//------------------------------------------------------------------------------
ViewAxes MakeViewAxes(const double direction[3], const double up[3])
{
  ViewAxes view;
  double* right = view.axes[0];
  double* eye = view.axes[2];
  Normalize(direction, eye);
  const double candidates[3][3] = { { up[0], up[1], up[2] }, { 0.0, 1.0, 0.0 },
    { 0.0, 0.0, -eye[1] } };
  for (const double* candidate : candidates)
  {
    double unit[3];
    Normalize(candidate, unit);
    vtkMath::Cross(unit, eye, right);
    if (vtkMath::Normalize(right) > 1e-6)
    {
      break;
    }
  }
  vtkMath::Cross(eye, right, view.axes[1]);
  return view;
}

//------------------------------------------------------------------------------
const MeshPart& MeshTriangles::FindPart(std::uint32_t triangle) const
{
  const auto after = std::upper_bound(this->parts.begin(), this->parts.end(), triangle,
    [](std::uint32_t value, const MeshPart& part) { return value < part.firstTriangle; });
  return *(after - 1);
}

//------------------------------------------------------------------------------
std::string GatherTriangles(const std::vector<vtkPolyData*>& meshes, const ViewAxes& view,
  bool keepCells, MeshTriangles& result)
{
  result = MeshTriangles();
  result.view = view;
  std::size_t points = 0;
  std::size_t cells = 0;
  for (vtkPolyData* mesh : meshes)
  {
    points += static_cast<std::size_t>(mesh->GetNumberOfPoints());
    cells += static_cast<std::size_t>(mesh->GetNumberOfPolys());
  }
  // Three indices a triangle, in 32 bits each.
  const std::string tooMany =
    "there are more than 4294967294 points or triangles: use fewer meshes";
  if (points >= NoTriangle || cells >= NoTriangle)
  {
    return tooMany;
  }
  double center[3];
  FindSceneCenter(meshes, center);
  view.Transform(center, result.center);
  result.points.resize(3 * points);
  result.corners.reserve(3 * cells);
  MeshPart part;
  for (vtkPolyData* mesh : meshes)
  {
    part.mesh = mesh;
    part.firstTriangle = result.corners.size() / 3;
    result.parts.push_back(part);
    if (mesh->GetNumberOfPoints() > 0)
    {
      TransformPoints(mesh->GetPoints(), view, center, result.points.data() + 3 * part.firstPoint);
    }
    Cutter cutter(part, keepCells, result);
    cutter.CutPolygons();
    cutter.CutStrips();
    result.otherCells +=
      static_cast<std::size_t>(mesh->GetNumberOfVerts() + mesh->GetNumberOfLines());
    part.firstPoint += static_cast<std::size_t>(mesh->GetNumberOfPoints());
    if (result.corners.size() / 3 >= NoTriangle)
    {
      return tooMany;
    }
  }
  FindTriangleBounds(result);
  return {};
}

}
