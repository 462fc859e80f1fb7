// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkReliefMeshAttributes_h
#define vtkReliefMeshAttributes_h

/// @file
/// Normals and colors of meshes at the samples of a grid. Not installed.

#include "vtkReliefMeshTriangles.h"

#include "vtkFloatArray.h"
#include "vtkUnsignedCharArray.h"

#include <cstdint>

namespace relief::hosts
{
/// Which triangle each sample of a grid is of, and how far apart samples are. The points of the
/// triangles are in samples, as TriangleMesh has them.
struct SampledTriangles
{
  const SceneTriangles* triangles = nullptr;
  const std::uint32_t* ofSamples = nullptr;
  int columns = 0;
  int rows = 0;
  double spacing[2] = { 1.0, 1.0 };
};

/// Normals in the view's frame, 0 where there is no triangle: the mesh's at its points, turned to
/// the side of the triangle that is seen, else the triangle's own.
void FillNormals(const SampledTriangles& samples, vtkFloatArray* normals);

/// How many components colors have, 3 or 4; 0 if no mesh has any.
int FindColorComponents(const SceneTriangles& triangles);

/// Colors, 0 where there is no triangle, white on meshes without.
void FillColors(const SampledTriangles& samples, vtkUnsignedCharArray* colors);
}

#endif
