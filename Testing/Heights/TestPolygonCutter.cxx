// SPDX-License-Identifier: BSD-3-Clause
// PolygonCutter: triangles that fill polygons of any shape without overlap, in any plane; and what
// cannot be cut.
#include "PolygonCutter.h"

#include "ReliefTestUtilities.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <vector>

namespace
{
using relief::MeshTriangles;
using relief::PolygonCutter;

int Failures = 0;

using Flat = std::vector<std::pair<double, double>>;

// Twice the area that a polygon turns around.
double AreaOf(const Flat& corners)
{
  double sum = 0.0;
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const auto& [ax, ay] = corners[k];
    const auto& [bx, by] = corners[(k + 1) % corners.size()];
    sum += ax * by - bx * ay;
  }
  return sum;
}

// The polygon on the plane z = 2 x - 3 y, along axes that are exchanged `turn` times.
MeshTriangles Place(const Flat& corners, int turn)
{
  MeshTriangles mesh;
  for (const auto& [x, y] : corners)
  {
    const double place[3] = { x, y, 2.0 * x - 3.0 * y };
    for (int k = 0; k < 3; ++k)
    {
      mesh.points.push_back(place[(k + turn) % 3]);
    }
  }
  return mesh;
}

void Cut(MeshTriangles& mesh, const std::vector<std::uint32_t>& ids)
{
  PolygonCutter(mesh, 0, mesh.points.size() / 3, false).CutPolygon(0, ids.data(), ids.size());
}

std::vector<std::uint32_t> Around(std::size_t count, std::size_t begin, bool backward)
{
  std::vector<std::uint32_t> ids;
  for (std::size_t k = 0; k < count; ++k)
  {
    ids.push_back(static_cast<std::uint32_t>((begin + (backward ? count - k : k)) % count));
  }
  return ids;
}

//------------------------------------------------------------------------------
// All triangles turn alike, and together they have the polygon's area: then they fill it and do not
// overlap.
void CheckFilled(const Flat& corners)
{
  for (int turn = 0; turn < 3; ++turn)
  {
    for (std::size_t begin = 0; begin < corners.size(); begin += 1 + corners.size() / 6)
    {
      for (const bool backward : { false, true })
      {
        MeshTriangles mesh = Place(corners, turn);
        Cut(mesh, Around(corners.size(), begin, backward));
        CHECK(mesh.corners.size() == 3 * (corners.size() - 2) - 3 * mesh.degenerate);
        double sum = 0.0;
        for (std::size_t t = 0; t + 2 < mesh.corners.size(); t += 3)
        {
          const double area = AreaOf({ corners[mesh.corners[t]], corners[mesh.corners[t + 1]],
            corners[mesh.corners[t + 2]] });
          CHECK(backward ? area <= 0.0 : area >= 0.0);
          sum += area;
        }
        const double expected = backward ? -AreaOf(corners) : AreaOf(corners);
        CHECK_NEAR(sum, expected, 1e-12 * std::abs(expected));
      }
    }
  }
}

// A simple polygon around the origin, whose corners lie at random distances.
Flat MakeStar(int count, unsigned int seed)
{
  std::mt19937 random(seed);
  Flat corners;
  for (int k = 0; k < count; ++k)
  {
    const double angle = 2.0 * 3.14159265358979 * k / count;
    const double distance = 0.1 + random() / 4294967296.0;
    corners.emplace_back(distance * std::cos(angle), distance * std::sin(angle));
  }
  return corners;
}

void TestShapes()
{
  CheckFilled({ { 0, 0 }, { 1, 0 }, { 0, 1 } });
  CheckFilled({ { 0, 0 }, { 4, 2 }, { 0, 4 }, { 1, 2 } });                     // an arrow head
  CheckFilled({ { 0, 0 }, { 1, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 0, 1 } }); // on straight lines
  CheckFilled({ { 0, 0 }, { 5, 0 }, { 5, 5 }, { 4, 5 }, { 4, 1 }, { 3, 1 }, { 3, 5 }, { 2, 5 },
    { 2, 1 }, { 1, 1 }, { 1, 5 }, { 0, 5 } }); // a comb
  // A frame whose hole is reached by a cut, along which corners come twice.
  CheckFilled({ { 0, 0 }, { 6, 0 }, { 6, 6 }, { 0, 6 }, { 0, 0 }, { 2, 2 }, { 2, 4 }, { 4, 4 },
    { 4, 2 }, { 2, 2 } });
  Flat spiral;
  for (int k = 0; k < 40; ++k)
  {
    spiral.emplace_back((1.0 + 0.1 * k) * std::cos(0.4 * k), (1.0 + 0.1 * k) * std::sin(0.4 * k));
  }
  for (int k = 39; k >= 0; --k)
  {
    spiral.emplace_back((1.3 + 0.1 * k) * std::cos(0.4 * k), (1.3 + 0.1 * k) * std::sin(0.4 * k));
  }
  CheckFilled({ spiral.rbegin(), spiral.rend() });
  for (unsigned int seed = 1; seed <= 30; ++seed)
  {
    CheckFilled(MakeStar(5 + static_cast<int>(seed) * 3, seed));
  }
}

//------------------------------------------------------------------------------
// What has no triangles is counted, and the mesh is left alone.
void TestRefusals()
{
  const Flat bow = { { 0, 0 }, { 2, 2 }, { 2, 0 }, { 0, 2 }, { -3, 1 } };
  MeshTriangles mesh = Place({ { 0, 0 }, { 4, 4 }, { 4, 0 }, { 0, 4 }, { 3, 9 } }, 0);
  Cut(mesh, { 0, 1, 2, 3, 4 });
  CHECK(mesh.corners.size() % 3 == 0 && mesh.corners.size() / 3 + mesh.degenerate == 3);
  mesh = Place({ { 0, 0 }, { 1, 0 }, { 2, 0 }, { 3, 0 }, { 1.5, 0 } }, 0);
  Cut(mesh, { 0, 1, 2, 3, 4 });
  CHECK(mesh.corners.empty() && mesh.degenerate == 3);
  mesh = Place(bow, 0);
  Cut(mesh, { 0, 1 });
  CHECK(mesh.corners.empty() && mesh.degenerate == 1);
  // Points that are not there, and such as are no points.
  mesh = Place(bow, 0);
  Cut(mesh, { 0, 1, 9, 3, 4 });
  CHECK(mesh.corners.empty() && mesh.notFinite == 3);
  const long long below[3] = { 0, -1, 2 };
  PolygonCutter(mesh, 0, 5, false).CutPolygon(0, below, 3);
  CHECK(mesh.corners.empty() && mesh.notFinite == 4);
  mesh.points[5] = std::nan("");
  Cut(mesh, { 0, 1, 2, 3 });
  CHECK(mesh.corners.empty() && mesh.notFinite == 6);
}

//------------------------------------------------------------------------------
// Strips, and the cells that triangles are of.
void TestStrips()
{
  MeshTriangles mesh = Place({ { 0, 0 }, { 0, 1 }, { 1, 0 }, { 1, 1 }, { 2, 0 } }, 0);
  PolygonCutter cutter(mesh, 0, 5, true);
  const int strip[5] = { 0, 1, 2, 3, 4 };
  cutter.CutStrip(7, strip, 5);
  const int polygon[5] = { 0, 2, 4, 3, 1 };
  cutter.CutPolygon(8, polygon, 5);
  CHECK((mesh.cells == std::vector<std::uint32_t>{ 7, 7, 7, 8, 8, 8 } || mesh.degenerate > 0));
  for (std::size_t t = 0; t < 9; t += 3)
  {
    CHECK(AreaOf({ { mesh.points[3 * mesh.corners[t]], mesh.points[3 * mesh.corners[t] + 1] },
            { mesh.points[3 * mesh.corners[t + 1]], mesh.points[3 * mesh.corners[t + 1] + 1] },
            { mesh.points[3 * mesh.corners[t + 2]], mesh.points[3 * mesh.corners[t + 2] + 1] } }) <
      0.0);
  }
}
}

//------------------------------------------------------------------------------
int TestPolygonCutter(int, char*[])
{
  TestShapes();
  TestRefusals();
  TestStrips();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
