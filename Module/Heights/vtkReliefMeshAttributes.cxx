// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefMeshAttributes.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkMath.h"
#include "vtkPointData.h"

#include "HeightInputs.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace relief::hosts
{

namespace
{
// What a mesh knows of its points or cells, and of which.
struct MeshColors
{
  vtkDataArray* values = nullptr;
  bool ofCells = false;
};

vtkDataArray* AsColors(vtkDataArray* scalars)
{
  const bool are = scalars && scalars->GetDataType() == VTK_UNSIGNED_CHAR &&
    (scalars->GetNumberOfComponents() == 3 || scalars->GetNumberOfComponents() == 4);
  return are ? scalars : nullptr;
}

// As mappers have it: points first.
MeshColors FindColors(vtkPolyData* mesh)
{
  MeshColors colors;
  colors.values = AsColors(mesh->GetPointData()->GetScalars());
  if (!colors.values)
  {
    colors.values = AsColors(mesh->GetCellData()->GetScalars());
    colors.ofCells = true;
  }
  const vtkIdType needed = colors.ofCells ? mesh->GetNumberOfCells() : mesh->GetNumberOfPoints();
  if (colors.values && colors.values->GetNumberOfTuples() < needed)
  {
    colors.values = nullptr;
  }
  return colors;
}

// The three corners of a triangle in their own mesh, and their shares of a sample.
struct Hit
{
  const MeshPart& part;
  vtkIdType points[3];
  double weights[3];

  Hit(const SceneTriangles& triangles, std::uint32_t triangle, int column, int row)
    : part(triangles.FindPart(triangle))
  {
    for (int k = 0; k < 3; ++k)
    {
      this->points[k] = static_cast<vtkIdType>(
        triangles.corners[3 * std::size_t{ triangle } + static_cast<std::size_t>(k)] -
        this->part.firstPoint);
    }
    FindTriangleWeights(triangles.GetMesh(), triangle, column, row, this->weights);
  }

  // The mean of what the corners have.
  void Interpolate(vtkDataArray* array, int components, double* result) const
  {
    std::fill_n(result, components, 0.0);
    for (int k = 0; k < 3; ++k)
    {
      for (int c = 0; c < components; ++c)
      {
        result[c] += this->weights[k] * array->GetComponent(this->points[k], c);
      }
    }
  }
};

//------------------------------------------------------------------------------
// Calls body with each sample that has a triangle.
void ForHits(const SampledTriangles& samples,
  const std::function<void(vtkIdType sample, std::uint32_t triangle, const Hit& hit)>& body)
{
  ForRows(samples.rows,
    [&](int begin, int end)
    {
      for (int row = begin; row < end; ++row)
      {
        for (int column = 0; column < samples.columns; ++column)
        {
          const vtkIdType sample = static_cast<vtkIdType>(row) * samples.columns + column;
          const std::uint32_t triangle = samples.ofSamples[sample];
          if (triangle != NoTriangle)
          {
            body(sample, triangle, Hit(*samples.triangles, triangle, column, row));
          }
        }
      }
    });
}

//------------------------------------------------------------------------------
// The normal of a triangle toward the eye, of length 1.
void FindFacetNormal(const SampledTriangles& samples, std::uint32_t triangle, double normal[3])
{
  const SceneTriangles& triangles = *samples.triangles;
  double edges[2][3];
  for (int e = 0; e < 2; ++e)
  {
    const std::size_t corner = 3 * std::size_t{ triangle };
    const double* from = triangles.points.data() + 3 * std::size_t{ triangles.corners[corner] };
    const double* to = triangles.points.data() +
      3 * std::size_t{ triangles.corners[corner + static_cast<std::size_t>(e) + 1] };
    edges[e][0] = (to[0] - from[0]) * samples.spacing[0];
    edges[e][1] = (to[1] - from[1]) * samples.spacing[1];
    edges[e][2] = to[2] - from[2];
    vtkMath::Normalize(edges[e]);
  }
  vtkMath::Cross(edges[0], edges[1], normal);
  if (normal[2] < 0.0)
  {
    vtkMath::MultiplyScalar(normal, -1.0);
  }
  if (!(vtkMath::Normalize(normal) > 0.0))
  {
    normal[0] = normal[1] = 0.0;
    normal[2] = 1.0;
  }
}
}

//------------------------------------------------------------------------------
void FillNormals(const SampledTriangles& samples, vtkFloatArray* normals)
{
  normals->FillValue(0.0f);
  float* values = normals->GetPointer(0);
  ForHits(samples,
    [&](vtkIdType sample, std::uint32_t triangle, const Hit& hit)
    {
      double facet[3];
      FindFacetNormal(samples, triangle, facet);
      double normal[3] = { facet[0], facet[1], facet[2] };
      vtkPolyData* mesh = hit.part.mesh;
      vtkDataArray* own = mesh->GetPointData()->GetNormals();
      if (own && own->GetNumberOfComponents() == 3 &&
        own->GetNumberOfTuples() >= mesh->GetNumberOfPoints())
      {
        double scene[3];
        hit.Interpolate(own, 3, scene);
        double smooth[3];
        samples.triangles->view.Transform(scene, smooth);
        const double length = vtkMath::Normalize(smooth);
        const double side = vtkMath::Dot(smooth, facet);
        for (int k = 0; std::isfinite(length) && length > 0.0 && k < 3; ++k)
        {
          normal[k] = side < 0.0 ? -smooth[k] : smooth[k];
        }
      }
      std::copy_n(normal, 3, values + 3 * sample);
    });
}

//------------------------------------------------------------------------------
int FindColorComponents(const SceneTriangles& triangles)
{
  int components = 0;
  for (const MeshPart& part : triangles.parts)
  {
    const MeshColors colors = FindColors(part.mesh);
    components = std::max(components, colors.values ? colors.values->GetNumberOfComponents() : 0);
  }
  return components;
}

//------------------------------------------------------------------------------
void FillColors(const SampledTriangles& samples, vtkUnsignedCharArray* colors)
{
  colors->FillValue(0);
  const int components = colors->GetNumberOfComponents();
  unsigned char* values = colors->GetPointer(0);
  ForHits(samples,
    [&](vtkIdType sample, std::uint32_t triangle, const Hit& hit)
    {
      const MeshColors own = FindColors(hit.part.mesh);
      double color[4] = { 255.0, 255.0, 255.0, 255.0 };
      if (own.values && own.ofCells)
      {
        for (int c = 0; c < own.values->GetNumberOfComponents(); ++c)
        {
          color[c] = own.values->GetComponent(samples.triangles->cells[std::size_t{ triangle }], c);
        }
      }
      else if (own.values)
      {
        hit.Interpolate(own.values, own.values->GetNumberOfComponents(), color);
      }
      for (int c = 0; c < components; ++c)
      {
        values[components * sample + c] =
          static_cast<unsigned char>(std::min(std::max(std::round(color[c]), 0.0), 255.0));
      }
    });
}

}
