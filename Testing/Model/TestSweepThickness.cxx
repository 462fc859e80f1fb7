// SPDX-License-Identifier: BSD-3-Clause
// Lockstep against the double reference, ray by ray, on every instruction set that this machine
// has.
#include "PreparedTerrain.h"
#include "RandomScene.h"
#include "SweptRows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

using namespace relief;

namespace
{
// d of all samples.
std::vector<float> SweepAll(const HeightField& field, const f64::ReliefMedium& medium,
  const Light& light, RayCount* work = nullptr)
{
  const HeightView<float>& heights = field.GetField().heights;
  std::vector<float> result(static_cast<std::size_t>(heights.columns) * heights.rows);
  RayCount count;
  ForEachSweptRow(field, medium, light, SweptLayers::Illumination, count,
    [&](int i, int j, int size, const float* d, const float*) {
      std::copy_n(d, size, result.begin() + static_cast<std::ptrdiff_t>(j) * heights.columns + i);
    });
  if (work)
  {
    *work = count;
  }
  return result;
}

class Sweep : public EveryTarget
{
};

// A scene that is swept.
RandomScene MakeSweptScene(Random& random)
{
  for (;;)
  {
    RandomScene scene = MakeRandomScene(random);
    scene.medium.offset = random.Chance(0.3) ? f64::RELIEF_VERTICAL : f64::RELIEF_TANGENT_PLANE;
    if (SweepThickness::Applies(scene.medium, scene.light))
    {
      return scene;
    }
  }
}
}

TEST_P(Sweep, AgreesWithTheReference)
{
  const std::uint64_t seed = Seed();
  SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << SweepThickness::GetTargetName());
  Random random(seed);
  std::size_t samples = 0;
  std::size_t beyond = 0;
  std::size_t edges = 0;
  double worst = 0.0;
  for (int round = 0; round < 300; ++round)
  {
    const RandomScene scene = MakeSweptScene(random);
    SCOPED_TRACE(testing::Message() << "scene " << round << ": " << scene);
    HeightField field;
    Prepare(scene.terrain, field);
    const std::vector<float> swept = SweepAll(field, scene.medium, scene.light);
    const std::vector<double> expected = Reference(field, scene.medium, scene.light);
    for (std::size_t at = 0; at < swept.size(); ++at)
    {
      if (std::isnan(scene.terrain.heights[at]))
      {
        continue;
      }
      const double error = std::abs(swept[at] - expected[at]);
      ++samples;
      if (IsEdge(scene.medium, swept[at], expected[at]))
      {
        ++edges;
        continue;
      }
      beyond += error > 1e-5 ? 1 : 0;
      worst = std::max(worst, error);
      ASSERT_LE(error, 1e-3) << "sample " << at;
    }
  }
  std::cout << SweepThickness::GetTargetName() << ": largest error " << worst
            << ", beyond 1e-5: " << 100.0 * beyond / samples << " % of " << samples << ", " << edges
            << " at shadows' edges" << std::endl;
  EXPECT_LE(beyond, samples / 1000);
  EXPECT_LE(edges, samples / 10000);
}

TEST_P(Sweep, KeepsTheTolerance)
{
  const std::uint64_t seed = Seed() + 1;
  SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << SweepThickness::GetTargetName());
  Random random(seed);
  for (int round = 0; round < 40; ++round)
  {
    const RandomScene scene = MakeSweptScene(random);
    SCOPED_TRACE(testing::Message() << "scene " << round << ": " << scene);
    ExpectTolerance(scene.terrain, scene.medium,
      [&](const HeightField& field, const f64::ReliefMedium& medium, RayCount& work)
      { return SweepAll(field, medium, scene.light, &work); });
  }
}

// No special directions: every whole degree, with holes, on every border.
TEST_P(Sweep, EveryAzimuth)
{
  Random random(99);
  Terrain terrain(75, 41, 1.0, 1.25);
  for (int j = 0; j < terrain.rows; ++j)
  {
    for (int i = 0; i < terrain.columns; ++i)
    {
      terrain.At(i, j) = random.Chance(0.02)
        ? NoData
        : 4.0 * std::sin(0.3 * i) * std::cos(0.4 * j) + random.Uniform(0.0, 1.0);
    }
  }
  terrain.RoundToSingle();
  HeightField field;
  Prepare(terrain, field);
  const f64::ReliefMedium medium = Sunk(1.0, f64::RELIEF_TANGENT_PLANE);
  for (double altitude : { 0.1, 20.0, 45.0, 90.0 })
  {
    std::vector<double> azimuths = { 89.9, 179.9, 359.9 };
    for (int azimuth = 0; azimuth < 360; azimuth += altitude == 20.0 ? 1 : 15)
    {
      azimuths.push_back(azimuth);
    }
    for (double azimuth : azimuths)
    {
      const Light sun = Sun(azimuth, altitude);
      if (!SweepThickness::Applies(medium, sun))
      {
        EXPECT_EQ(altitude, 90.0);
        continue;
      }
      const std::vector<float> swept = SweepAll(field, medium, sun);
      const std::vector<double> expected = Reference(field, medium, sun);
      for (std::size_t at = 0; at < swept.size(); ++at)
      {
        if (!std::isnan(terrain.heights[at]))
        {
          ASSERT_NEAR(swept[at], expected[at], 1e-4)
            << "azimuth " << azimuth << ", altitude " << altitude << ", sample " << at;
        }
      }
    }
  }
}

// Lockstep tells what meets nothing as single rays do, and the limit from the same heights.
TEST_P(Sweep, AgreesWithRaysAtDepthZero)
{
  Random random(5);
  std::size_t samples = 0;
  std::size_t lit = 0;
  std::size_t edges = 0;
  for (int round = 0; round < 40; ++round)
  {
    RandomScene scene = MakeSweptScene(random);
    scene.medium.depth = 0.0;
    HeightField field;
    Prepare(scene.terrain, field);
    const std::vector<float> swept = SweepAll(field, scene.medium, scene.light);
    std::vector<float> row(scene.terrain.columns);
    RayCount count;
    for (int j = 0; j < scene.terrain.rows; ++j)
    {
      RowRequest<float> request;
      request.j = j;
      request.end = scene.terrain.columns;
      request.illumination = row.data();
      TraceRow<float>(field.GetField(), ToSingle(scene.medium), scene.light, request, count);
      for (int i = 0; i < scene.terrain.columns; ++i)
      {
        const std::size_t at = static_cast<std::size_t>(j) * scene.terrain.columns + i;
        if (std::isnan(scene.terrain.heights[at]))
        {
          continue;
        }
        ++samples;
        lit += row[i] > 0.0f ? 1 : 0;
        if (IsEdge(scene.medium, swept[at], row[i]))
        {
          ++edges;
          continue;
        }
        ASSERT_NEAR(swept[at], row[i], 1e-4) << "scene " << round << ": " << scene << " at " << at;
      }
    }
  }
  std::cout << samples << " samples, " << lit << " of them lit, " << edges << " at shadows' edges"
            << std::endl;
  EXPECT_GE(lit, samples / 4);
  EXPECT_LE(edges, samples / 10000);
}

INSTANTIATE_FOR_EVERY_TARGET(Sweep);

// As packets and rays do: PacketThickness.RunsAlongLevelGround.
TEST(SweepThickness, RunsAlongLevelGround)
{
  Terrain terrain(80, 9, 1.0, 1.0);
  terrain.Fill([](double, double) { return 0.6f; });
  terrain.At(2, 4) = 0.7f;
  terrain.At(20, 4) = std::numeric_limits<double>::quiet_NaN();
  HeightField field;
  Prepare(terrain, field);
  EXPECT_FLOAT_EQ(
    SweepAll(field, Sunk(0.1, f64::RELIEF_VERTICAL), Sun(90.0, 0.0))[4 * 80 + 2], 0.1f);
}

TEST(SweepThickness, ToleranceSavesWork)
{
  ExpectToleranceSavesWork(
    [](const HeightField& field, const f64::ReliefMedium& medium, RayCount& work)
    { return SweepAll(field, medium, Sun(300.0, 5.0), &work); });
}
