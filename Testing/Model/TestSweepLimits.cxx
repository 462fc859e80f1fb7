// SPDX-License-Identifier: BSD-3-Clause
// Lockstep at depth 0 and above a floor, against what is known of simple shapes and against single
// rays, on every instruction set that this machine has.
#include "PreparedTerrain.h"
#include "RandomScene.h"
#include "SweptRows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

using namespace relief;

namespace
{
// d and r of all samples.
Traced<float> SweepAll(const Terrain& terrain, const f64::ReliefMedium& medium, const Light& light)
{
  HeightField field;
  Prepare(terrain, field);
  EXPECT_TRUE(SweepThickness::Applies(medium, light));
  f64::ReliefMedium lowered = medium; // the field's heights count from its datum
  lowered.floorHeight -= field.GetDatum();
  Traced<float> swept;
  swept.d.resize(terrain.heights.size());
  swept.r.resize(terrain.heights.size());
  ForEachSweptRow(field, lowered, light, SweptLayers::Thickness, swept.count,
    [&](int i, int j, int size, const float* d, const float* r)
    {
      const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(j) * terrain.columns + i;
      std::copy_n(d, size, swept.d.begin() + at);
      std::copy_n(r, size, swept.r.begin() + at);
    });
  return swept;
}

class SweepDepthZero : public EveryTarget
{
};
INSTANTIATE_FOR_EVERY_TARGET(SweepDepthZero);

class SweepFloor : public EveryTarget
{
};
INSTANTIATE_FOR_EVERY_TARGET(SweepFloor);

constexpr int Offsets[] = { f64::RELIEF_VERTICAL, f64::RELIEF_TANGENT_PLANE };
}

// Level ground is lit by the sine of the altitude up to the border, and no level sun lights it.
TEST_P(SweepDepthZero, LevelGround)
{
  Terrain terrain(37, 21, 2.0, 3.0);
  std::fill(terrain.heights.begin(), terrain.heights.end(), 123.4);
  for (int offset : Offsets)
  {
    for (double azimuth : { 0.0, 45.0, 90.0, 180.0, 200.0, 270.0, 333.0 })
    {
      for (double altitude : { 0.0, 1e-3, 5.0, 60.0 })
      {
        const Light sun = Sun(azimuth, altitude);
        for (float d : SweepAll(terrain, Sunk(0.0, offset), sun).d)
        {
          ASSERT_NEAR(d, sun.vector.z, 1e-6) << "azimuth " << azimuth;
        }
      }
    }
  }
}

// A roof with its ridge along y. The side that faces the sun has its cosine (above the vertical
// offset divided by n_z), the other the same or, if it is steeper than the ray, none. On the ridge
// the ray leaves over the near side, below a level tangent plane.
TEST_P(SweepDepthZero, Roof)
{
  Terrain terrain(33, 40, 1.0, 1.0);
  for (double slope : { 0.25, 1.0, 1.5 })
  {
    terrain.Fill([&](double x, double) { return 7.0 - slope * std::abs(x - 16.0); });
    for (double azimuth : { 90.0, 60.0, 125.0 })
    {
      for (double altitude : { 10.0, 35.0, 70.0 })
      {
        const glm::dvec3 l = Toward(azimuth, altitude);
        for (int offset : Offsets)
        {
          const Traced<float> swept = SweepAll(terrain, Sunk(0.0, offset), Sun(azimuth, altitude));
          const double sink = offset == f64::RELIEF_VERTICAL ? 1.0 : std::hypot(slope, 1.0);
          const double near = std::min((l.z + slope * l.x) / sink, 1.0);
          const double far = std::max(l.z - slope * l.x, 0.0) / sink;
          const double ridge = std::min(l.z + slope * l.x, 1.0);
          const int j = 18;
          for (int i = 1; i < 32; ++i)
          {
            const double expected = i < 16 ? far : i == 16 ? ridge : near;
            ASSERT_NEAR(swept.d[j * 33 + i], expected, 1e-6)
              << "slope " << slope << ", azimuth " << azimuth << ", altitude " << altitude
              << ", offset " << offset << ", column " << i;
          }
        }
      }
    }
  }
}

// Behind a step it is dark as far as its edge hides the sun, and as bright as anywhere beyond.
TEST_P(SweepDepthZero, ShadowOfAStep)
{
  const double height = 5.3;
  Terrain terrain(60, 30);
  terrain.Fill([&](double x, double) { return x >= 40.0 ? height : 0.0; });
  for (double azimuth : { 90.0, 70.0 })
  {
    for (double altitude : { 12.0, 27.0, 50.0 })
    {
      const glm::dvec3 l = Toward(azimuth, altitude);
      for (int offset : Offsets)
      {
        const Traced<float> swept = SweepAll(terrain, Sunk(0.0, offset), Sun(azimuth, altitude));
        int dark = 0;
        for (int i = 5; i < 58; ++i)
        {
          if (i == 39 || i == 40)
          {
            continue; // the tangent planes there are steep
          }
          const bool hidden = i < 40 && (40 - i) * l.z < height * l.x;
          dark += hidden ? 1 : 0;
          ASSERT_NEAR(swept.d[10 * 60 + i], hidden ? 0.0 : l.z, 1e-6)
            << "azimuth " << azimuth << ", altitude " << altitude << ", column " << i;
        }
        EXPECT_GT(dark, 2);
        EXPECT_LT(dark, 30);
      }
    }
  }
}

// A ray that runs along a slope is not inside it; but it lights nothing either, for from any depth
// it never leaves.
TEST_P(SweepDepthZero, AlongAPlane)
{
  Terrain terrain(40, 20);
  terrain.Fill([](double x, double) { return x < 20.0 ? 0.5 * x : 10.0; });
  const Light sun = Directional(glm::dvec3(2.0, 0.0, 1.0) / std::sqrt(5.0));
  for (int offset : Offsets)
  {
    const Traced<float> swept = SweepAll(terrain, Sunk(0.0, offset), sun);
    const double crest = offset == f64::RELIEF_VERTICAL ? 1.0 : std::hypot(1.0, 0.25);
    for (int i = 0; i < 40; ++i)
    {
      EXPECT_NEAR(swept.d[10 * 40 + i], i < 20 ? 0.0 : sun.vector.z / (i == 20 ? crest : 1.0), 1e-6)
        << "column " << i;
    }
  }
}

// d of depth 0 is what d of ever smaller depths comes to, on every border and beside holes, as far
// as no shadow's edge is there.
TEST_P(SweepDepthZero, IsTheLimit)
{
  Random random(11);
  std::size_t samples = 0;
  std::size_t edges = 0;
  std::size_t lit = 0;
  for (int round = 0; round < 12; ++round)
  {
    Terrain terrain(random.Integer(20, 50), random.Integer(20, 50), 1.0, random.Uniform(0.5, 2.0));
    terrain.Fill([&](double x, double y)
      { return 3.0 * std::sin(0.3 * x) * std::cos(0.25 * y) + random.Uniform(0.0, 0.3); });
    for (int hole = 0; hole < 30; ++hole)
    {
      terrain.At(random.Integer(0, terrain.columns - 1), random.Integer(0, terrain.rows - 1)) =
        NoData;
    }
    terrain.RoundToSingle();
    const Light sun = Sun(random.Chance(0.3) ? 45.0 * random.Integer(0, 7) : 360.0 * round / 12.0,
      random.Uniform(5.0, 60.0));
    HeightField field;
    Prepare(terrain, field);
    for (int offset : Offsets)
    {
      const Traced<float> swept = SweepAll(terrain, Sunk(0.0, offset), sun);
      const std::vector<double> small = Reference(field, Sunk(1e-9, offset), sun);
      const std::vector<double> larger = Reference(field, Sunk(1e-8, offset), sun);
      for (std::size_t at = 0; at < small.size(); ++at)
      {
        if (std::isnan(terrain.heights[at]))
        {
          continue;
        }
        ++samples;
        lit += swept.d[at] > 0.0f ? 1 : 0;
        const bool edge =
          std::abs(small[at] - larger[at]) > 1e-5 || (swept.d[at] > 0.0f) != (swept.r[at] == 0.0f);
        edges += edge ? 1 : 0;
        ASSERT_TRUE(edge || std::abs(swept.d[at] - small[at]) < 1e-5)
          << "round " << round << ", sample " << at << ": " << swept.d[at] << ", not " << small[at];
      }
    }
  }
  EXPECT_GE(lit, samples / 4);
  EXPECT_LE(edges, samples / 100);
}

// By the exponential attenuation all that meets nothing is lit, and the rest by what it passes.
TEST_P(SweepDepthZero, Exponential)
{
  Terrain terrain(40, 20);
  terrain.At(30, 10) = 6.0; // a spike, a cell wide each way
  f64::ReliefMedium medium = Sunk(0.0);
  medium.attenuation = f64::RELIEF_EXPONENTIAL;
  medium.density = 0.7;
  const Traced<float> swept = SweepAll(terrain, medium, Sun(90.0, 20.0));
  const double rise = std::tan(20.0 * Pi / 180.0);
  int shadowed = 0;
  for (int i = 5; i < 29; ++i)
  {
    // In through 6 (x - 29), out through 6 (31 - x), as far as that is not above the tip.
    const double in = (6.0 * 29.0 - rise * i) / (6.0 - rise);
    const double out = (6.0 * 31.0 + rise * i) / (6.0 + rise);
    const double r = std::max(out - in, 0.0) / std::cos(20.0 * Pi / 180.0);
    shadowed += r > 0.0 ? 1 : 0;
    EXPECT_NEAR(swept.d[10 * 40 + i], std::exp(-0.7 * r), 2e-6) << i;
  }
  EXPECT_GT(shadowed, 5);
  EXPECT_LT(shadowed, 20);
}

// Level ground: from the floor, or from p' above it, to the surface.
TEST_P(SweepFloor, UnderLevelGround)
{
  const double t = 3.0;
  Terrain terrain(40, 21);
  std::fill(terrain.heights.begin(), terrain.heights.end(), 10.0);
  for (int offset : Offsets)
  {
    for (double floor : { -5.0, 6.9, 7.0, 7.1, 9.5, 10.0, 10.5, 1e6 })
    {
      for (double azimuth : { 0.0, 30.0, 45.0, 270.0 })
      {
        const Light sun = Sun(azimuth, 25.0);
        const Traced<float> swept = SweepAll(terrain, WithFloor(Sunk(t, offset), floor), sun);
        const double r = std::min(t, std::max(10.0 - floor, 0.0)) / sun.vector.z;
        for (std::size_t at = 0; at < swept.d.size(); ++at)
        {
          ASSERT_NEAR(swept.r[at], r, 1e-5) << "floor " << floor << ", sample " << at;
          ASSERT_NEAR(swept.d[at], std::min(t / r, 1.0), 1e-6);
        }
      }
      // A level ray is inside for ever, or under the floor.
      const Traced<float> level =
        SweepAll(terrain, WithFloor(Sunk(t, offset), floor), Sun(45., 0.));
      EXPECT_EQ(level.d[10 * 40 + 20], floor >= 7.0 ? 1.0f : 0.0f) << "floor " << floor;
    }
  }
}

// A wall across a plain: a ray enters it through its near side or comes out of the floor within it,
// and leaves it through its far side.
TEST_P(SweepFloor, BlockAboveTheFloor)
{
  const double height = 400.0;
  const double t = 2.0;
  Terrain terrain(64, 90);
  terrain.Fill([&](double x, double) { return x >= 30.0 && x <= 35.0 ? height : 0.0; });
  int within = 0;
  for (double floor : { -3.0, 0.0, 1.0, 6.0, 14.0, 30.0 })
  {
    for (double azimuth : { 90.0, 65.0, 120.0 })
    {
      for (double altitude : { 8.0, 30.0, 55.0 })
      {
        const glm::dvec3 l = Toward(azimuth, altitude);
        const double rise = l.z / l.x; // along x
        const Traced<float> swept =
          SweepAll(terrain, WithFloor(Sunk(t), floor), Sun(azimuth, altitude));
        for (int i = 8; i < 29; ++i)
        {
          if (i + t / rise > 29.0)
          {
            continue; // the ground and the wall are one
          }
          const double begin = (height * 29.0 - t - rise * i) / (height - rise);
          const double end = (height * 36.0 + t + rise * i) / (height + rise);
          const double out = i + (floor + t) / rise; // of the floor
          const double ground = floor < 0.0 ? std::min(t, -floor) : 0.0;
          const double block = std::max(end - std::max(begin, out), 0.0) / l.x;
          within += out > begin && out < end ? 1 : 0;
          const double r = ground / l.z + block;
          ASSERT_NEAR(swept.r[45 * 64 + i], r, 1e-4 * (1.0 + r))
            << "floor " << floor << ", azimuth " << azimuth << ", altitude " << altitude
            << ", column " << i;
          ASSERT_NEAR(swept.d[45 * 64 + i], r > t ? t / r : 1.0, 1e-5);
        }
      }
    }
  }
  EXPECT_GT(within, 50);
}

// Floors amid the heights, so that rays of one tile start under them and above.
TEST_P(SweepFloor, AgreesWithTheReference)
{
  const std::uint64_t seed = Seed() + 2;
  Random random(seed);
  std::size_t samples = 0;
  std::size_t beyond = 0;
  std::size_t edges = 0;
  for (int round = 0; round < 200; ++round)
  {
    RandomScene scene = MakeRandomScene(random);
    scene.medium.offset = Offsets[random.Integer(0, 1)];
    if (!SweepThickness::Applies(scene.medium, scene.light))
    {
      continue;
    }
    const double at =
      scene.terrain.heights[random.Integer(0, static_cast<int>(scene.terrain.heights.size()) - 1)];
    scene.medium = WithFloor(scene.medium, std::isnan(at) ? 0.0 : at);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", scene " << round << ": " << scene);
    HeightField field;
    Prepare(scene.terrain, field);
    const Traced<float> swept = SweepAll(scene.terrain, scene.medium, scene.light);
    f64::ReliefMedium lowered = scene.medium;
    lowered.floorHeight -= field.GetDatum();
    const std::vector<double> expected = Reference(field, lowered, scene.light);
    for (std::size_t k = 0; k < expected.size(); ++k)
    {
      if (std::isnan(scene.terrain.heights[k]))
      {
        continue;
      }
      ++samples;
      const bool edge = IsEdge(scene.medium, swept.d[k], expected[k]);
      edges += edge ? 1 : 0;
      const double error = std::abs(swept.d[k] - expected[k]);
      beyond += !edge && error > 1e-5 ? 1 : 0;
      ASSERT_TRUE(edge || error <= 1e-3) << "sample " << k << ": " << error;
    }
  }
  EXPECT_GT(samples, 40000u);
  EXPECT_LE(beyond, samples / 1000);
  EXPECT_LE(edges, samples / 10000);
}

// What holes hold under a floor counts where rays come out of it.
TEST_P(SweepFloor, HolesUnderIt)
{
  Random random(8);
  Terrain terrain(75, 41, 1.0, 1.25);
  terrain.Fill([&](double x, double y)
    { return 4.0 * std::sin(0.3 * x) * std::cos(0.4 * y) + random.Uniform(0.0, 1.0); });
  for (int hole = 0; hole < 80; ++hole)
  {
    terrain.At(random.Integer(0, 74), random.Integer(0, 40)) = NoData;
  }
  terrain.RoundToSingle();
  HeightField field;
  Prepare(terrain, field);
  for (double floor : { -2.0, 0.5, 3.0 })
  {
    const f64::ReliefMedium medium = WithFloor(Sunk(1.0, f64::RELIEF_TANGENT_PLANE), floor);
    for (int azimuth = 0; azimuth < 360; azimuth += 15)
    {
      for (double altitude : { 3.0, 20.0 })
      {
        const Light sun = Sun(azimuth, altitude);
        const Traced<float> swept = SweepAll(terrain, medium, sun);
        const std::vector<double> expected = Reference(field, medium, sun);
        ASSERT_EQ(field.GetDatum(), 0.0);
        for (std::size_t at = 0; at < expected.size(); ++at)
        {
          ASSERT_TRUE(
            std::isnan(terrain.heights[at]) || std::abs(swept.d[at] - expected[at]) < 1e-4)
            << "floor " << floor << ", azimuth " << azimuth << ", altitude " << altitude
            << ", sample " << at << ": " << swept.d[at] << ", not " << expected[at];
        }
      }
    }
  }
}
