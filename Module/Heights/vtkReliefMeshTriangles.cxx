// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefMeshTriangles.h"

#include "vtkCellArray.h"
#include "vtkPoints.h"

#include "HeightInputs.h"
#include "PolygonCutter.h"

#include <algorithm>

namespace relief::hosts
{

namespace
{
// The bounds of all points that can be seen.
PointBounds FindSceneBounds(const std::vector<vtkPolyData*>& meshes)
{
  PointBounds all;
  for (vtkPolyData* mesh : meshes)
  {
    vtkPoints* points = mesh->GetPoints();
    all.Add(FindPointBounds(static_cast<std::size_t>(mesh->GetNumberOfPoints()), ForRows,
      [points](std::size_t begin, std::size_t end, PointBounds& bounds)
      {
        for (std::size_t i = begin; i < end; ++i)
        {
          double point[3];
          points->GetPoint(static_cast<vtkIdType>(i), point);
          if (IsUsablePoint(point))
          {
            bounds.Add(point);
          }
        }
      }));
  }
  return all;
}

//------------------------------------------------------------------------------
void CutPolygons(vtkPolyData* mesh, PolygonCutter& cutter)
{
  vtkCellArray* polygons = mesh->GetPolys();
  const vtkIdType firstCell = mesh->GetNumberOfVerts() + mesh->GetNumberOfLines();
  for (vtkIdType i = 0; i < polygons->GetNumberOfCells(); ++i)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    polygons->GetCellAtId(i, count, ids);
    cutter.CutPolygon(
      static_cast<std::size_t>(firstCell + i), ids, static_cast<std::size_t>(count));
  }
}

//------------------------------------------------------------------------------
void CutStrips(vtkPolyData* mesh, PolygonCutter& cutter)
{
  vtkCellArray* strips = mesh->GetStrips();
  const vtkIdType firstCell =
    mesh->GetNumberOfVerts() + mesh->GetNumberOfLines() + mesh->GetNumberOfPolys();
  for (vtkIdType i = 0; i < strips->GetNumberOfCells(); ++i)
  {
    vtkIdType count = 0;
    const vtkIdType* ids = nullptr;
    strips->GetCellAtId(i, count, ids);
    cutter.CutStrip(static_cast<std::size_t>(firstCell + i), ids, static_cast<std::size_t>(count));
  }
}

//------------------------------------------------------------------------------
void TransformPoints(
  vtkPoints* points, const ViewAxes& view, const double center[3], double* result)
{
  ForPointBlocks(static_cast<std::size_t>(points->GetNumberOfPoints()), ForRows,
    [&](std::size_t begin, std::size_t end, std::size_t)
    {
      for (std::size_t i = begin; i < end; ++i)
      {
        double point[3];
        points->GetPoint(static_cast<vtkIdType>(i), point);
        PlacePoint(point, view, center, result + 3 * i);
      }
    });
}
}

//------------------------------------------------------------------------------
const MeshPart& SceneTriangles::FindPart(std::uint32_t triangle) const
{
  const auto after = std::upper_bound(this->parts.begin(), this->parts.end(), triangle,
    [](std::uint32_t value, const MeshPart& part) { return value < part.firstTriangle; });
  return *(after - 1);
}

//------------------------------------------------------------------------------
std::string GatherTriangles(const std::vector<vtkPolyData*>& meshes, const ViewAxes& view,
  bool keepCells, SceneTriangles& result)
{
  result = SceneTriangles();
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
  FindMeshCenter(FindSceneBounds(meshes), center);
  view.Transform(center, result.center);
  result.points.resize(3 * points);
  result.corners.reserve(3 * cells);
  MeshPart part;
  for (vtkPolyData* mesh : meshes)
  {
    const auto own = static_cast<std::size_t>(mesh->GetNumberOfPoints());
    part.mesh = mesh;
    part.firstTriangle = result.corners.size() / 3;
    result.parts.push_back(part);
    if (own > 0)
    {
      TransformPoints(mesh->GetPoints(), view, center, result.points.data() + 3 * part.firstPoint);
    }
    PolygonCutter cutter(result, part.firstPoint, own, keepCells);
    CutPolygons(mesh, cutter);
    CutStrips(mesh, cutter);
    result.otherCells +=
      static_cast<std::size_t>(mesh->GetNumberOfVerts() + mesh->GetNumberOfLines());
    part.firstPoint += own;
    if (result.corners.size() / 3 >= NoTriangle)
    {
      return tooMany;
    }
  }
  FindTriangleBounds(result, ForRows);
  return {};
}

}
