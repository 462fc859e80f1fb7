// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkReliefMeshTriangles_h
#define vtkReliefMeshTriangles_h

/// @file
/// The triangles of meshes as a viewer sees them, and what the meshes know of a point of theirs.
/// Not installed.

#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include "MeshTriangles.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace relief::hosts
{
/// Where the points and triangles of a mesh begin among those of all.
struct MeshPart
{
  vtkSmartPointer<vtkPolyData> mesh;
  std::size_t firstPoint = 0;
  std::size_t firstTriangle = 0;
};

/// The triangles of all meshes.
struct SceneTriangles : MeshTriangles
{
  std::vector<MeshPart> parts;

  /// The part that a triangle belongs to.
  const MeshPart& FindPart(std::uint32_t triangle) const;
};

/// Gathers the triangles of meshes; strips and polygons are cut into triangles. Returns an empty
/// text, or why it cannot be done.
std::string GatherTriangles(const std::vector<vtkPolyData*>& meshes, const ViewAxes& view,
  bool keepCells, SceneTriangles& result);
}

#endif
