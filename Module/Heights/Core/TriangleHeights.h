// SPDX-License-Identifier: BSD-3-Clause
#ifndef TriangleHeights_h
#define TriangleHeights_h

/// @file
/// The heights of triangles at the samples of a grid: for each sample the highest plane of the
/// triangles that it lies in. No picture is drawn: what is hit is decided exactly.

#include "ParallelFor.h"

#include <cstddef>
#include <cstdint>
#include <functional>

namespace relief
{

/// Triangles over a grid, in arrays that somebody else owns. x and y are in samples: sample (i, j)
/// lies at x = i, y = j. z is a height of any unit. Triangles may face either way, overlap, and
/// reach beyond the grid.
struct TriangleMesh
{
  const double* points = nullptr;         ///< x, y, z of each
  const std::uint32_t* corners = nullptr; ///< three points of each triangle
  std::size_t triangles = 0;              ///< fewer than NoTriangle
};

/// The triangle of a sample that none was found for.
constexpr std::uint32_t NoTriangle = 0xffffffffu;

/// Where the heights go: row by row without gaps, the row of y = 0 first.
struct TriangleHeights
{
  int columns = 0;
  int rows = 0;
  double* heights = nullptr;          ///< NaN where no triangle is
  std::uint32_t* triangles = nullptr; ///< which one was highest, else NoTriangle; may be null
};

/// What became of the triangles.
struct TriangleCount
{
  bool whole = false;      ///< false if it was told to stop
  std::size_t leftOut = 0; ///< triangles with a coordinate that is NaN or beyond 1e100
};

/// Finds the heights. A sample that lies on an edge or a corner belongs to all triangles there, so
/// that there are no cracks; which samples a triangle has is exact for the coordinates as given.
/// Triangles that are seen edge-on, or have no area, have none. Of triangles of the same height at
/// a sample the first one counts. A height has the error of 1e-7 of the triangle's own range of z
/// at most, and never leaves that range.
///
/// `goOn` is called now and then by the thread that called, with the part that is done, and
/// returns whether to go on; it may be empty. Takes up to 20 bytes for each of 2^20 triangles at a
/// time. The result does not depend on how the work is shared out. May throw std::bad_alloc.
TriangleCount FindTriangleHeights(const TriangleMesh& mesh, const ParallelFor& parallelFor,
  const std::function<bool(double done)>& goOn, const TriangleHeights& result);

/// How much of each corner a point of a triangle has; the sum is 1. For points in the triangle,
/// none is below 0.
void FindTriangleWeights(
  const TriangleMesh& mesh, std::uint32_t triangle, double x, double y, double weights[3]);

}

#endif
