// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkReliefMeshTriangles_h
#define vtkReliefMeshTriangles_h

/// @file
/// The triangles of meshes as a viewer sees them, and what the meshes know of a point of theirs.
/// Not installed.

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include "TriangleHeights.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace relief::hosts
{
/// Right, up and toward the eye, in the scene; of length 1 and at right angles.
struct ViewAxes
{
  double axes[3][3];

  void Transform(const double scene[3], double view[3]) const
  {
    for (int k = 0; k < 3; ++k)
    {
      view[k] =
        this->axes[k][0] * scene[0] + this->axes[k][1] * scene[1] + this->axes[k][2] * scene[2];
    }
  }
};

/// The axes of a direction toward the eye, and of what is up where that is not along it.
ViewAxes MakeViewAxes(const double direction[3], const double up[3]);

/// Where the points and triangles of a mesh begin among those of all.
struct MeshPart
{
  vtkSmartPointer<vtkPolyData> mesh;
  std::size_t firstPoint = 0;
  std::size_t firstTriangle = 0;
};

/// The triangles of all meshes.
struct MeshTriangles
{
  ViewAxes view;
  std::vector<MeshPart> parts;
  double center[3] = { 0.0, 0.0, 0.0 };       ///< of the points in the view's frame
  std::vector<double> points;                 ///< in the view's frame, from the center
  std::vector<std::uint32_t> corners;         ///< three for each triangle
  std::vector<std::uint32_t> cells;           ///< of each triangle, in its mesh, if asked for
  double bounds[6] = { 1, -1, 1, -1, 1, -1 }; ///< of the points of triangles

  std::size_t notFinite = 0;  ///< triangles left out for corners that are no finite points
  std::size_t degenerate = 0; ///< triangles without area
  std::size_t otherCells = 0; ///< vertices and lines

  TriangleMesh GetMesh() const
  {
    return { this->points.data(), this->corners.data(), this->corners.size() / 3 };
  }
  /// The part that a triangle belongs to.
  const MeshPart& FindPart(std::uint32_t triangle) const;
};

/// Gathers the triangles of meshes; strips and polygons are cut into triangles. Returns an empty
/// text, or why it cannot be done.
std::string GatherTriangles(const std::vector<vtkPolyData*>& meshes, const ViewAxes& view,
  bool keepCells, MeshTriangles& result);
}

#endif
