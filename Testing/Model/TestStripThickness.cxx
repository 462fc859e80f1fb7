// SPDX-License-Identifier: BSD-3-Clause
// Tiles of rays in strips against packets, row by row, and against the double reference, on every
// instruction set that this machine has.
#include "PacketTiles.h"
#include "PreparedTerrain.h"
#include "RandomScene.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <vector>

using namespace relief;

namespace
{
class Strip : public EveryTarget
{
};

// d of all samples, tile by tile.
std::vector<float> TraceTiles(const HeightField& field, const f64::ReliefMedium& medium,
  const Light& light, RayCount* work = nullptr)
{
  PacketField all = MakePacketField(field.GetField());
  RayCount count;
  TracePacketTiles(field.GetField(), ToSingle(medium), light, all, count);
  if (work)
  {
    *work = count;
  }
  return all.d;
}

// The same row by row, where packets never run in strips.
std::vector<float> TraceRows(const HeightField& field, const f64::ReliefMedium& medium,
  const Light& light, RayCount* work = nullptr)
{
  PacketField all = MakePacketField(field.GetField());
  const int columns = field.GetField().heights.columns;
  RayCount count;
  for (int j = 0; j < field.GetField().heights.rows; ++j)
  {
    const std::size_t at = static_cast<std::size_t>(j) * columns;
    RowRequest<float> request;
    request.j = j;
    request.end = columns;
    request.normals = all.normals.data() + at;
    request.illumination = all.d.data() + at;
    TracePackets(field.GetField(), ToSingle(medium), light, request, count);
  }
  if (work)
  {
    *work = count;
  }
  return all.d;
}

// Hills that are as rough as ground is, with or without what rays cannot cross in strips.
Terrain MakeHills(Random& random)
{
  const double unit = random.Logarithmic(0.01, 1000.0);
  Terrain terrain(random.Integer(40, 120), random.Integer(40, 120), unit,
    unit * (random.Chance(0.5) ? 1.0 : random.Uniform(0.5, 2.0)));
  const double size = unit * random.Uniform(0.5, 6.0);
  const double rough = unit * random.Logarithmic(0.01, 3.0);
  const double lift = random.Chance(0.3) ? unit * random.Uniform(-1000.0, 1000.0) : 0.0;
  const double wave = random.Uniform(0.05, 0.4) / unit;
  terrain.Fill(
    [&](double x, double y)
    {
      return lift + size * std::sin(wave * x) * std::cos(0.8 * wave * y) +
        random.Uniform(0.0, rough);
    });
  if (random.Chance(0.2))
  {
    terrain.At(random.Integer(0, terrain.columns - 1), random.Integer(0, terrain.rows - 1)) =
      NoData;
  }
  if (random.Chance(0.2))
  {
    terrain.At(random.Integer(0, terrain.columns - 1), random.Integer(0, terrain.rows - 1)) +=
      100.0 * unit;
  }
  terrain.RoundToSingle();
  return terrain;
}

// A lamp at any distance, or a sun, at any of the angles at which the order of crossings changes.
Light MakeLight(Random& random, const Terrain& terrain)
{
  const double azimuth =
    random.Chance(0.3) ? 45.0 * random.Integer(0, 7) : random.Uniform(0.0, 360.0);
  const double altitude = random.Logarithmic(1.0, 85.0);
  if (random.Chance(0.3))
  {
    return Sun(azimuth, altitude);
  }
  const glm::dvec3 toward = Toward(azimuth, altitude);
  const double x = 0.5 * terrain.spacingX * (terrain.columns - 1);
  const double y = 0.5 * terrain.spacingY * (terrain.rows - 1);
  const double distance = (x + y) * random.Logarithmic(0.2, 1.0e4);
  return Lamp(x + distance * toward.x, y + distance * toward.y,
    terrain.At(terrain.columns / 2, terrain.rows / 2) + distance * toward.z);
}
}

// Over ground where nearly all rays run in strips, at the sides, beside holes and near lamps not
// all the way. Nowhere do these differ from packets by more than rounding makes of either.
TEST_P(Strip, AgreesWithPacketsAndTheReference)
{
  const std::uint64_t seed = Seed() + 11;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  Random random(seed);
  std::size_t samples = 0;
  std::size_t beyond = 0;
  double worst = 0.0;
  std::uint64_t cells = 0;
  std::uint64_t cellsOfRows = 0;
  for (int round = 0; round < 120; ++round)
  {
    const Terrain terrain = MakeHills(random);
    HeightField field;
    Prepare(terrain, field, random.Chance(0.5));
    const double depth = terrain.spacingX * random.Logarithmic(0.05, 3.0);
    f64::ReliefMedium medium = Sunk(depth, AllOffsets[random.Integer(0, 2)]);
    if (random.Chance(0.2))
    {
      medium.attenuation = f64::RELIEF_EXPONENTIAL;
      medium.density = random.Logarithmic(0.1, 10.0) / terrain.spacingX;
    }
    Light light = MakeLight(random, terrain);
    light.vector.z -= light.positional ? field.GetDatum() : 0.0;
    if (random.Chance(0.2))
    {
      medium = WithFloor(medium, field.GetBottom() - terrain.spacingX * random.Uniform(-1.0, 5.0));
    }
    SCOPED_TRACE(testing::Message()
      << "scene " << round << ", t " << medium.depth << ", offset " << medium.offset << ", light "
      << light.vector.x << ' ' << light.vector.y << ' ' << light.vector.z);
    RayCount work;
    RayCount workOfRows;
    const std::vector<float> traced = TraceTiles(field, medium, light, &work);
    const std::vector<float> rows = TraceRows(field, medium, light, &workOfRows);
    const std::vector<double> expected = Reference(field, medium, light);
    EXPECT_EQ(work.rays, workOfRows.rays);
    cells += work.cells;
    cellsOfRows += workOfRows.cells;
    for (std::size_t at = 0; at < traced.size(); ++at)
    {
      if (std::isnan(terrain.heights[at]))
      {
        continue;
      }
      ++samples;
      const double error = std::abs(traced[at] - expected[at]);
      worst = std::max(worst, error);
      beyond += error > 1e-5 ? 1 : 0;
      ASSERT_LE(error, 2e-4 + 2.0 * std::abs(rows[at] - expected[at])) << "sample " << at;
    }
  }
  std::cout << "largest error " << worst << ", beyond 1e-5: " << 100.0 * beyond / samples
            << " % of " << samples << "; cells " << cells << ", row by row " << cellsOfRows
            << std::endl;
  EXPECT_LE(beyond, samples / 2000);
}

// Far beside their samples rays begin many lines before these, and all of a tile cross the same
// rows' borders at once, but for rounding, which must not tell on which side a tower stands.
TEST_P(Strip, AgreesFarBeforeTheSamples)
{
  for (const double fall : { 0.25, 0.5, 1.0 })
  {
    for (const double apart : { 12.0, 40.0 })
    {
      Terrain terrain(190, 130, 1.0, 1.0);
      terrain.Fill([&](double x, double y) { return -fall * (2.0 * x + y); });
      for (int k = 0; k < 40; ++k)
      {
        terrain.At((k * 37) % 190, (k * 53) % 130) += 60.0;
      }
      terrain.RoundToSingle();
      HeightField field;
      Prepare(terrain, field);
      const glm::dvec3 normal = glm::normalize(glm::dvec3(2.0 * fall, fall, 1.0));
      const f64::ReliefMedium medium = Sunk(apart / normal.x, f64::RELIEF_SURFACE_NORMAL);
      Light sun;
      sun.vector = glm::normalize(glm::dvec3(2.0, 1.0, 0.4));
      const std::vector<float> traced = TraceTiles(field, medium, sun);
      const std::vector<float> rows = TraceRows(field, medium, sun);
      const std::vector<double> expected = Reference(field, medium, sun);
      for (std::size_t at = 0; at < traced.size(); ++at)
      {
        ASSERT_LE(
          std::abs(traced[at] - expected[at]), 2e-4 + 2.0 * std::abs(rows[at] - expected[at]))
          << "fall " << fall << ", apart " << apart << ", sample " << at;
      }
    }
  }
}

TEST_P(Strip, AgreesInEveryKindOfScene)
{
  const std::uint64_t seed = Seed() + 12;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  Random random(seed);
  std::size_t samples = 0;
  std::size_t beyond = 0;
  for (int round = 0; round < 200; ++round)
  {
    const RandomScene scene = MakeRandomScene(random);
    SCOPED_TRACE(testing::Message() << "scene " << round << ": " << scene);
    HeightField field;
    Prepare(scene.terrain, field);
    const std::vector<float> traced = TraceTiles(field, scene.medium, scene.light);
    const std::vector<float> rows = TraceRows(field, scene.medium, scene.light);
    for (std::size_t at = 0; at < traced.size(); ++at)
    {
      if (std::isnan(scene.terrain.heights[at]) || IsEdge(scene.medium, traced[at], rows[at]))
      {
        continue;
      }
      ++samples;
      beyond += std::abs(traced[at] - rows[at]) > 2e-5 ? 1 : 0;
    }
  }
  std::cout << beyond << " of " << samples << " differ" << std::endl;
  EXPECT_LE(beyond, samples / 2000);
}

TEST_P(Strip, KeepsTheTolerance)
{
  const std::uint64_t seed = Seed() + 13;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  Random random(seed);
  for (int round = 0; round < 30; ++round)
  {
    const Terrain terrain = MakeHills(random);
    const f64::ReliefMedium medium =
      Sunk(terrain.spacingX * random.Logarithmic(0.05, 3.0), AllOffsets[random.Integer(0, 2)]);
    const Light light = MakeLight(random, terrain);
    ExpectTolerance(terrain, medium,
      [&](const HeightField& field, const f64::ReliefMedium& asked, RayCount& work)
      { return TraceTiles(field, asked, light, &work); });
  }
}

// Within the first strip such a ray climbs so far that rounding there is more than the depth.
TEST_P(Strip, MeasuresRaysThatAreNearlyUpright)
{
  Terrain terrain(40, 40, 1.0, 1.0);
  HeightField field;
  Prepare(terrain, field);
  for (const Light& light :
    { Lamp(6.0e8, -8.0e8, 5.6e16), Lamp(-3.0e8, 1.0e8, 4.0e15), Sun(30.0, 89.999999) })
  {
    PacketField all = MakePacketField(field.GetField());
    RayCount count;
    TracePacketTiles(
      field.GetField(), ToSingle(Sunk(1.0, f64::RELIEF_VERTICAL)), light, all, count);
    for (std::size_t at = 0; at < all.r.size(); ++at)
    {
      EXPECT_NEAR(all.r[at], 1.0f, 1e-5) << "sample " << at;
    }
  }
}

// A ray along the last line of samples, beside one that is sunk aside: the cell before the line is
// the row in which both run, and the one in which the first goes on alone.
TEST_P(Strip, GoesOnAlongTheLastLine)
{
  const double heights[] = { 0.0, -1.0, 2.0, 2.0, 3.0, 3.0, 3.0, 3.0 };
  for (const bool alongX : { false, true })
  {
    Terrain terrain(alongX ? 4 : 2, alongX ? 2 : 4);
    for (int k = 0; k < 8; ++k)
    {
      terrain.At(alongX ? k / 2 : k % 2, alongX ? k % 2 : k / 2) = heights[k];
    }
    HeightField field;
    Prepare(terrain, field);
    const f64::ReliefMedium medium = Sunk(1.0, f64::RELIEF_SURFACE_NORMAL);
    const Light sun = Sun(alongX ? 90.0 : 0.0, 45.0);
    const std::vector<float> traced = TraceTiles(field, medium, sun);
    const std::vector<double> expected = Reference(field, medium, sun);
    for (std::size_t at = 0; at < traced.size(); ++at)
    {
      EXPECT_NEAR(traced[at], expected[at], 1e-5) << "sample " << at;
    }
  }
}

// Samples that are not wanted are left alone and change nothing for the others of their tile.
TEST_P(Strip, TracesWhatIsWanted)
{
  Random random(8);
  Terrain terrain(100, 60, 1.0, 1.0);
  for (double& height : terrain.heights)
  {
    height = random.Uniform(0.0, 3.0);
  }
  HeightField field;
  Prepare(terrain, field);
  const f32::ReliefMedium medium = ToSingle(Sunk(1.0, f64::RELIEF_VERTICAL));
  const Light lamp = Lamp(-300.0, 400.0, 200.0);
  PacketField all = MakePacketField(field.GetField());
  PacketField some = all;
  RayCount count;
  TracePacketTiles(field.GetField(), medium, lamp, all, count);
  EXPECT_EQ(count.rays, terrain.heights.size());
  std::size_t wanted = 0;
  for (std::size_t at = 0; at < terrain.heights.size(); ++at)
  {
    // In some tiles none.
    const bool want = random.Chance(0.3) && at % 100 >= 32;
    some.wanted.push_back(want ? 1 : 0);
    wanted += want ? 1 : 0;
  }
  RayCount ofSome;
  TracePacketTiles(field.GetField(), medium, lamp, some, ofSome);
  EXPECT_EQ(ofSome.rays, wanted);
  for (std::size_t at = 0; at < some.d.size(); ++at)
  {
    EXPECT_NEAR(some.d[at], some.wanted[at] ? all.d[at] : -1.0f, 1e-5) << at;
    EXPECT_NEAR(some.r[at], some.wanted[at] ? all.r[at] : -1.0f, 1e-4) << at;
  }
}

INSTANTIATE_FOR_EVERY_TARGET(Strip);
