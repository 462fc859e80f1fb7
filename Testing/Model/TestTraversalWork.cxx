// SPDX-License-Identifier: BSD-3-Clause
//
// How much work it is to trace fixed scenes. Cells and blocks visited are the same in every run,
// unlike times; so a traversal that skips less than it did fails here. The bounds are what a ray
// visited when they were written down, and two in a hundred more, for sines that differ in their
// last digits. Whoever finds a way to skip more lowers them.
#include "PacketTiles.h"
#include "PreparedTerrain.h"
#include "SweptRows.h"

#include "PacketThickness.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iostream>
#include <string>
#include <vector>

using namespace relief;

namespace
{
constexpr double Margin = 1.02;

// Hills with a rough surface.
Terrain Landscape()
{
  Random random(3);
  Terrain terrain(320, 240, 1.0, 1.0);
  terrain.Fill([&](double x, double y)
    { return 6.0 * std::sin(0.05 * x) * std::cos(0.07 * y) + random.Uniform(0.0, 0.6); });
  terrain.RoundToSingle();
  return terrain;
}

// Level ground with a tower in its middle, as high as no ray is soon.
Terrain PlainWithTower()
{
  Terrain terrain(320, 240, 1.0, 1.0);
  terrain.At(160, 120) = 100.0;
  return terrain;
}

f64::ReliefMedium Medium(double tolerance = 0.002)
{
  f64::ReliefMedium medium = Sunk(1.0);
  medium.tolerance = tolerance;
  return medium;
}

// All rows of a field, by packets or ray by ray.
template <class Trace>
RayCount CountRows(Trace&& trace, const Field<float>& field, const Light& light, double tolerance)
{
  std::vector<float> d(field.heights.columns);
  RayCount count;
  for (int j = 0; j < field.heights.rows; ++j)
  {
    RowRequest<float> request;
    request.j = j;
    request.end = field.heights.columns;
    request.illumination = d.data();
    trace(field, ToSingle(Medium(tolerance)), light, request, count);
  }
  return count;
}

RayCount CountSwept(const HeightField& field, const Light& light, const f64::ReliefMedium& medium)
{
  RayCount count;
  ForEachSweptRow(field, medium, light, SweptLayers::Illumination, count,
    [](int, int, int, const float*, const float*) {});
  return count;
}

RayCount CountSwept(const HeightField& field, const Light& light, double tolerance)
{
  return CountSwept(field, light, Medium(tolerance));
}

void ExpectWork(const char* what, const RayCount& count, double cellsPerRay)
{
  const double found = static_cast<double>(count.cells) / static_cast<double>(count.rays);
  std::cout << what << ": " << found << " cells a ray" << std::endl;
  EXPECT_EQ(count.rays, 320u * 240u);
  EXPECT_LE(found, cellsPerRay * Margin) << what;
}

class TraversalWork : public EveryTarget
{
protected:
  // Rays that are traced together skip together: what a packet visits depends on how many it has.
  static double OfLanes(double sixteen, double eight, double four, double one)
  {
    const std::string target = hwy::TargetName(GetParam());
    return target.rfind("AVX3", 0) == 0                           ? sixteen
      : target == "AVX2"                                          ? eight
      : target == "SSE4" || target == "SSSE3" || target == "NEON" ? four
      : target == "SCALAR"                                        ? one
                           : std::max({ sixteen, eight, four, one });
  }
};
}

TEST_P(TraversalWork, OfSuns)
{
  HeightField field;
  Prepare(Landscape(), field);
  ExpectWork("sun at 2 degrees", CountSwept(field, Sun(300.0, 2.0), 0.002),
    OfLanes(59.621, 50.868, 49.131, 64.998));
  ExpectWork("sun at 10 degrees", CountSwept(field, Sun(300.0, 10.0), 0.002),
    OfLanes(31.880, 28.362, 27.021, 30.102));
  ExpectWork("sun at 45 degrees", CountSwept(field, Sun(300.0, 45.0), 0.002),
    OfLanes(5.102, 5.148, 5.382, 7.023));
  ExpectWork("sun at 80 degrees", CountSwept(field, Sun(300.0, 80.0), 0.002),
    OfLanes(4.059, 4.115, 4.226, 4.891));
  ExpectWork("sun at 10 degrees, 0.02", CountSwept(field, Sun(300.0, 10.0), 0.02),
    OfLanes(25.617, 23.037, 22.114, 25.773));
  ExpectWork("sun at 10 degrees, exact", CountSwept(field, Sun(300.0, 10.0), 0.0),
    OfLanes(33.016, 29.391, 27.956, 31.010));
}

// A tolerance is worth something where much lies in deep shadow.
TEST_P(TraversalWork, OfATolerance)
{
  HeightField field;
  Prepare(Landscape(), field);
  const Light low = Sun(300.0, 5.0);
  const RayCount exact = CountSwept(field, low, 0.0);
  const RayCount coarse = CountSwept(field, low, 0.02);
  EXPECT_EQ(coarse.rays, exact.rays);
  EXPECT_LT(static_cast<double>(coarse.cells), 0.8 * static_cast<double>(exact.cells));
}

// At depth 0 no ray is traced twice, and under a floor none is traced: less than the same sun takes
// otherwise.
TEST_P(TraversalWork, OfSunsAtTheLimits)
{
  HeightField field;
  Prepare(Landscape(), field);
  f64::ReliefMedium opaque = Medium();
  opaque.depth = 0.0;
  const f64::ReliefMedium below = WithFloor(Medium(), -10.0); // below everything
  const f64::ReliefMedium amid = WithFloor(Medium(), 0.0);
  const f64::ReliefMedium above = WithFloor(Medium(), 10.0);
  const Light low = Sun(300.0, 10.0);
  const Light high = Sun(300.0, 45.0);
  ExpectWork("depth 0, sun at 10 degrees", CountSwept(field, low, opaque),
    OfLanes(19.885, 17.380, 16.571, 19.867));
  ExpectWork("depth 0, sun at 45 degrees", CountSwept(field, high, opaque),
    OfLanes(4.766, 4.888, 5.131, 6.588));
  ExpectWork("floor below, sun at 10 degrees", CountSwept(field, low, below),
    OfLanes(31.863, 28.344, 27.020, 30.098));
  ExpectWork("floor amid, sun at 10 degrees", CountSwept(field, low, amid),
    OfLanes(29.942, 26.591, 25.330, 28.415));
  ExpectWork("floor amid, sun at 45 degrees", CountSwept(field, high, amid),
    OfLanes(4.939, 4.983, 5.212, 6.823));
  ExpectWork("floor above, sun at 10 degrees", CountSwept(field, low, above), 0.0);
}

TEST_P(TraversalWork, OfLamps)
{
  HeightField field;
  Prepare(Landscape(), field);
  const Light low = Lamp(-100.0, 300.0, 20.0);
  const Light high = Lamp(160.0, 120.0, 100.0);
  ExpectWork("low lamp", CountRows(TracePackets, field.GetField(), low, 0.002),
    OfLanes(101.608, 83.227, 75.055, 77.657));
  ExpectWork("low lamp, exact", CountRows(TracePackets, field.GetField(), low, 0.0),
    OfLanes(104.049, 85.149, 76.706, 79.244));
  ExpectWork("lamp overhead", CountRows(TracePackets, field.GetField(), high, 0.002),
    OfLanes(8.447, 7.512, 7.372, 8.525));
}

// As the filter traces them: all rays of a tile together, as far as they run nearly the same way.
TEST_P(TraversalWork, OfTilesOfRays)
{
  HeightField field;
  Prepare(Landscape(), field);
  auto count = [&](const Light& light, int offset)
  {
    f64::ReliefMedium medium = Medium(0.0);
    medium.offset = offset;
    PacketField all = MakePacketField(field.GetField());
    RayCount work;
    TracePacketTiles(field.GetField(), ToSingle(medium), light, all, work);
    return work;
  };
  ExpectWork("tiles to a far lamp", count(Lamp(-1000.0, 800.0, 300.0), f64::RELIEF_VERTICAL),
    OfLanes(45.098, 41.444, 39.803, 38.395));
  ExpectWork("tiles to a low lamp", count(Lamp(-100.0, 300.0, 20.0), f64::RELIEF_VERTICAL),
    OfLanes(118.538, 100.300, 92.702, 93.290));
  ExpectWork("tiles to a sun, along normals", count(Sun(300.0, 20.0), f64::RELIEF_SURFACE_NORMAL),
    OfLanes(39.418, 37.174, 35.914, 34.529));
  ExpectWork("tiles to a sun overhead", count(Sun(0.0, 90.0), f64::RELIEF_VERTICAL), 1.0);
}

// Below a tower's height only blocks can be skipped.
TEST_P(TraversalWork, OfWhatIsSkipped)
{
  HeightField field;
  Prepare(PlainWithTower(), field);
  const Light lamp = Lamp(-100.0, 300.0, 60.0);
  ExpectWork(
    "swept plain", CountSwept(field, Sun(300.0, 5.0), 0.0), OfLanes(6.169, 6.108, 6.211, 7.213));
  ExpectWork("packets over a plain", CountRows(TracePackets, field.GetField(), lamp, 0.0),
    OfLanes(41.067, 34.497, 33.090, 38.073));
}

INSTANTIATE_FOR_EVERY_TARGET(TraversalWork);

TEST(RayWork, OfRays)
{
  HeightField field;
  Prepare(Landscape(), field);
  auto rays = [&](const Light& light, double tolerance)
  { return CountRows(TraceRow<float, float>, field.GetField(), light, tolerance); };
  ExpectWork("ray to a sun at 10 degrees", rays(Sun(300.0, 10.0), 0.002), 27.145);
  ExpectWork("ray to a sun at 45 degrees", rays(Sun(300.0, 45.0), 0.002), 7.240);
  ExpectWork("ray to a lamp", rays(Lamp(-100.0, 300.0, 20.0), 0.002), 43.965);
}

TEST(RayWork, OfRaysWithAndWithoutBounds)
{
  HeightField field;
  Prepare(PlainWithTower(), field);
  const Light sun = Sun(300.0, 5.0);
  Field<float> plain = field.GetField();
  ExpectWork("ray over a plain", CountRows(TraceRow<float, float>, plain, sun, 0.0), 19.682);
  plain.bounds = nullptr;
  ExpectWork("the same cell by cell", CountRows(TraceRow<float, float>, plain, sun, 0.0), 186.105);
}
