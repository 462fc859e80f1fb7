// SPDX-License-Identifier: BSD-3-Clause
#ifndef WebMesh_h
#define WebMesh_h

#include "HeightFrame.h"
#include "MeshTriangles.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace relief::web
{

/// A mesh as JavaScript gives it: polygons between points.
struct WebMesh
{
  std::vector<double> points;         ///< x, y and z of each
  std::vector<std::uint32_t> corners; ///< of all polygons, one after the other
  std::vector<std::uint32_t> ends;    ///< where the corners of each polygon end

  /// Takes the text of an OBJ. Returns an empty text, or what is wrong.
  std::string ReadObj(const char* text, std::size_t length);
};

/// Heights of a mesh as seen from one side, its first row the southern one, and what they took.
struct MeshHeights
{
  HeightFrame frame;
  std::vector<double> heights; ///< NaN where nothing is seen
  std::size_t triangles = 0;
  std::size_t degenerate = 0; ///< triangles without area
  std::size_t notFinite = 0;  ///< triangles whose corners are no finite points of the mesh
};

/// Finds the heights by the same steps as vtkDepthToHeightField. The mesh is given up on the way.
/// Returns an empty text, or what is wrong.
std::string FindMeshHeights(WebMesh&& mesh, const double direction[3], const double up[3],
  const FrameRequest& request, MeshHeights& result);

}

#endif
