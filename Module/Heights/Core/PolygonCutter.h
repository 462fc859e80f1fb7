// SPDX-License-Identifier: BSD-3-Clause
#ifndef PolygonCutter_h
#define PolygonCutter_h

#include "MeshTriangles.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace relief
{

/// Cuts polygons and strips into triangles. Convex polygons become fans around their first corner;
/// of others ears are cut off. (G. H. Meisters, "Polygons have ears", American Mathematical Monthly
/// 82, 1975.) Polygons whose edges cross each other have no triangles and count as degenerate.
class PolygonCutter
{
public:
  /// Cuts what a mesh has whose points are `points` of the result's, from `firstPoint` on.
  PolygonCutter(MeshTriangles& result, std::size_t firstPoint, std::size_t points, bool keepCells);

  /// A polygon by its corners, points of the mesh; those that it does not have are not finite.
  template <class Id>
  void CutPolygon(std::size_t cell, const Id* ids, std::size_t count)
  {
    this->Ids.assign(ids, ids + count);
    this->Cut(cell);
  }

  /// A strip: each point makes a triangle with the two before it.
  template <class Id>
  void CutStrip(std::size_t cell, const Id* ids, std::size_t count)
  {
    this->Ids.assign(ids, ids + count);
    this->CutAsStrip(cell);
  }

private:
  const double* Point(std::size_t id) const
  {
    return this->Result.points.data() + 3 * (this->FirstPoint + id);
  }
  bool AreUsable(const std::size_t* ids, std::size_t count) const;
  double Turn(std::size_t a, std::size_t b, std::size_t c, double normal[3]) const;
  void AddTriangle(std::size_t cell, std::size_t a, std::size_t b, std::size_t c);
  void Cut(std::size_t cell);
  void CutAsStrip(std::size_t cell);
  void CutQuad(std::size_t cell);
  bool IsFan() const;
  bool CutEars();
  bool Flatten();
  double Area(std::size_t a, std::size_t b, std::size_t c) const;
  bool IsEar(std::size_t place) const;

  MeshTriangles& Result;
  std::size_t FirstPoint;
  std::size_t Points;
  bool KeepCells;

  std::vector<std::size_t> Ids;  // of the polygon that is cut
  std::vector<double> Flat;      // its corners along two axes
  std::vector<std::size_t> Rest; // corners that are not cut off
  std::vector<std::size_t> Ears; // three corners of each
};

}

#endif
