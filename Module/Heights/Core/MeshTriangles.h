// SPDX-License-Identifier: BSD-3-Clause
#ifndef MeshTriangles_h
#define MeshTriangles_h

/// @file
/// The triangles of meshes as a viewer sees them.

#include "HeightFrame.h"
#include "ParallelFor.h"
#include "TriangleHeights.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace relief
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

/// The axes of a direction toward the eye, and of what is up where that is not along it. Both are
/// finite, of any length but 0.
ViewAxes MakeViewAxes(const double direction[3], const double up[3]);

/// Bounds that are empty as they begin.
struct PointBounds
{
  double low[3] = { Beyond, Beyond, Beyond };
  double high[3] = { -Beyond, -Beyond, -Beyond };

  void Add(const double point[3]) { this->Add(point, point); }
  void Add(const PointBounds& other) { this->Add(other.low, other.high); }
  bool IsEmpty() const { return !(this->low[0] <= this->high[0]); }

private:
  static constexpr double Beyond = std::numeric_limits<double>::infinity();

  void Add(const double from[3], const double to[3]);
};

/// The triangles of meshes.
struct MeshTriangles
{
  ViewAxes view;
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
};

/// Whether a point can be seen: its coordinates are up to 1e100.
bool IsUsablePoint(const double point[3]);

/// What points are measured from, for those of a small scene far from the origin to keep their
/// digits: 0 near the origin, else a round number, so that differences are exact in most scenes.
void FindMeshCenter(const PointBounds& usable, double center[3]);

/// A point of the scene in the view's frame, from a center; NaN if it is of no use.
void PlacePoint(
  const double point[3], const ViewAxes& view, const double center[3], double result[3]);

/// Finds the bounds of what the triangles have.
void FindTriangleBounds(MeshTriangles& triangles, const ParallelFor& parallelFor);

/// Brings the points from the view's frame to the samples of a frame, from the same center.
void MoveToSamples(
  MeshTriangles& triangles, const HeightFrame& frame, const ParallelFor& parallelFor);

/// How many points are taken at once.
constexpr std::size_t PointsAtOnce = 65536;

/// Calls body(begin, end, block) for blocks of [0, count).
template <class Body>
void ForPointBlocks(std::size_t count, const ParallelFor& parallelFor, const Body& body)
{
  parallelFor(static_cast<int>((count + PointsAtOnce - 1) / PointsAtOnce),
    [&](int first, int last)
    {
      for (std::size_t block = static_cast<std::size_t>(first);
           block < static_cast<std::size_t>(last); ++block)
      {
        const std::size_t end = (block + 1) * PointsAtOnce;
        body(block * PointsAtOnce, end < count ? end : count, block);
      }
    });
}

/// The bounds of what body(begin, end, bounds) adds of [0, count).
template <class Body>
PointBounds FindPointBounds(std::size_t count, const ParallelFor& parallelFor, const Body& body)
{
  std::vector<PointBounds> parts((count + PointsAtOnce - 1) / PointsAtOnce);
  ForPointBlocks(count, parallelFor,
    [&](std::size_t begin, std::size_t end, std::size_t block) { body(begin, end, parts[block]); });
  PointBounds all;
  for (const PointBounds& part : parts)
  {
    all.Add(part);
  }
  return all;
}

}

#endif
