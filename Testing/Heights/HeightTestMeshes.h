// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightTestMeshes_h
#define HeightTestMeshes_h

#include "vtkCellArray.h"
#include "vtkDepthToHeightField.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include "ReliefTestUtilities.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <vector>

/// A mesh of polygons, points as x, y, z in double.
inline vtkSmartPointer<vtkPolyData> MakeMesh(const std::vector<double>& coordinates,
  const std::vector<std::vector<vtkIdType>>& polygons,
  const std::vector<std::vector<vtkIdType>>& strips = {})
{
  auto mesh = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3)
  {
    points->InsertNextPoint(&coordinates[i]);
  }
  mesh->SetPoints(points);
  const auto cells = [](const std::vector<std::vector<vtkIdType>>& lists)
  {
    auto array = vtkSmartPointer<vtkCellArray>::New();
    for (const auto& list : lists)
    {
      array->InsertNextCell(static_cast<vtkIdType>(list.size()), list.data());
    }
    return array;
  };
  mesh->SetPolys(cells(polygons));
  if (!strips.empty())
  {
    mesh->SetStrips(cells(strips));
  }
  return mesh;
}

/// What a line along the view has of a mesh of triangles, each looked at in turn, in long double.
/// Where it meets an edge as nearly as numbers tell, that may be a hit or none.
struct LineHits
{
  long double sure = -std::numeric_limits<long double>::infinity();
  long double possible = -std::numeric_limits<long double>::infinity();
};

/// A mesh of triangles as it is seen along a direction, for one line at a time.
class LookedAtMesh
{
public:
  LookedAtMesh(vtkPolyData* mesh, const double axes[9])
  {
    for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
    {
      double point[3];
      mesh->GetPoint(i, point);
      for (int k = 0; k < 3; ++k)
      {
        long double sum = 0.0L;
        for (int axis = 0; axis < 3; ++axis)
        {
          sum += static_cast<long double>(axes[3 * k + axis]) * point[axis];
        }
        this->Points.push_back(sum);
      }
    }
    vtkCellArray* polygons = mesh->GetPolys();
    for (vtkIdType i = 0; i < polygons->GetNumberOfCells(); ++i)
    {
      vtkIdType count = 0;
      const vtkIdType* ids = nullptr;
      polygons->GetCellAtId(i, count, ids);
      this->Corners.insert(this->Corners.end(), ids, ids + 3);
    }
  }

  LineHits Look(long double x, long double y) const
  {
    LineHits hits;
    for (std::size_t t = 0; t < this->Corners.size(); t += 3)
    {
      const long double* p[3];
      for (std::size_t k = 0; k < 3; ++k)
      {
        p[k] = &this->Points[3 * static_cast<std::size_t>(this->Corners[t + k])];
      }
      const long double ax = p[1][0] - p[0][0];
      const long double ay = p[1][1] - p[0][1];
      const long double bx = p[2][0] - p[0][0];
      const long double by = p[2][1] - p[0][1];
      const long double area = ax * by - ay * bx;
      const long double size = std::abs(ax) + std::abs(ay) + std::abs(bx) + std::abs(by);
      if (std::abs(area) <= 1e-13L * size * size)
      {
        continue;
      }
      const long double u = ((x - p[0][0]) * by - (y - p[0][1]) * bx) / area;
      const long double v = (ax * (y - p[0][1]) - ay * (x - p[0][0])) / area;
      const long double least = std::min(std::min(u, v), 1.0L - u - v);
      const long double height = p[0][2] + u * (p[1][2] - p[0][2]) + v * (p[2][2] - p[0][2]);
      hits.sure = least > 1e-10L ? std::max(hits.sure, height) : hits.sure;
      hits.possible = least > -1e-10L ? std::max(hits.possible, height) : hits.possible;
    }
    return hits;
  }

private:
  std::vector<long double> Points;
  std::vector<vtkIdType> Corners;
};

/// How many samples of an output differ from the mesh by more than an error, or are hit or not
/// where they should not be.
inline int CountWrong(
  vtkDepthToHeightField* filter, vtkPolyData* mesh, double error, int* hit = nullptr)
{
  vtkImageData* image = filter->GetOutput();
  int size[3];
  image->GetDimensions(size);
  const LookedAtMesh looked(mesh, filter->GetViewAxes());
  int wrong = 0;
  for (int j = 0; j < size[1]; ++j)
  {
    for (int i = 0; i < size[0]; ++i)
    {
      const double height = image->GetScalarComponentAsDouble(i, j, 0, 0);
      const LineHits hits = looked.Look(image->GetOrigin()[0] + i * image->GetSpacing()[0],
        image->GetOrigin()[1] + j * image->GetSpacing()[1]);
      const bool right = std::isnan(height) ? hits.sure == -INFINITY
                                            : height >= static_cast<double>(hits.sure) - error &&
          height <= static_cast<double>(hits.possible) + error;
      wrong += right ? 0 : 1;
      if (hit)
      {
        *hit += std::isnan(height) ? 0 : 1;
      }
    }
  }
  return wrong;
}

#endif
