// SPDX-License-Identifier: BSD-3-Clause
//
// Directions, symmetries, voids and tolerances: what must come out alike, and the oracle's answer
// where nothing else tells.
#include "RayThickness.h"
#include "ThicknessOracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <tuple>

namespace
{
using relief::Light;
using relief::f64::ReliefMedium;

std::vector<double> Reference(
  const Terrain& terrain, const ReliefMedium& medium, const Light& light)
{
  Samples<double> samples(terrain);
  return Trace<double>(samples.WithoutBounds(), medium, light).d;
}
}

// Every whole degree of azimuth, and those beside which rounding of angles goes wrong.
class EveryDegree : public ::testing::TestWithParam<std::tuple<int, bool>>
{
};

TEST_P(EveryDegree, EqualsOracle)
{
  Random random(Seed());
  Terrain terrain(13, 11, 1.0, 0.7);
  for (double& height : terrain.heights)
  {
    height = random.Uniform(0.0, 2.0);
    height = std::get<1>(GetParam()) && random.Chance(0.15) ? NoData : height;
  }
  terrain.RoundToSingle();
  ReliefMedium medium = Sunk(0.3, std::get<0>(GetParam()));
  Samples<float> samples(terrain);
  Samples<double> exact(terrain);
  std::vector<double> azimuths = { 89.9, 179.9, 359.9 };
  for (int azimuth = 0; azimuth < 360; ++azimuth)
  {
    azimuths.push_back(azimuth);
  }
  long jumps = 0;
  long rays = 0;
  for (double azimuth : azimuths)
  {
    for (double altitude : { 0.1, 20.0, 45.0, 90.0 })
    {
      SCOPED_TRACE(::testing::Message()
        << "RELIEF_SEED=" << Seed() << " azimuth " << azimuth << " altitude " << altitude);
      Light light = Sun(azimuth, altitude);
      Traced<double> reference = Trace<double>(exact.WithoutBounds(), medium, light);
      Traced<float> single = Trace<float>(samples.WithBounds(), medium, light);
      for (int j = 0; j < terrain.rows; ++j)
      {
        for (int i = 0; i < terrain.columns; ++i)
        {
          std::size_t at = static_cast<std::size_t>(j) * terrain.columns + i;
          if (std::isnan(terrain.At(i, j)))
          {
            ASSERT_TRUE(std::isnan(reference.r[at]));
            continue;
          }
          ++rays;
          oracle::Ray ray = oracle::RayOf(terrain, medium, light, i, j);
          double r = static_cast<double>(oracle::Thickness(terrain, medium, ray));
          double d = static_cast<double>(oracle::Illumination(medium, r));
          if (std::abs(reference.r[at] - r) > 1e-9 * std::max(r, 1.0))
          {
            ++jumps;
            oracle::Range range = oracle::ThicknessRange(terrain, medium, ray, 1e-13L, 2.0L);
            ASSERT_GE(reference.r[at], range.lo - 1e-9) << "sample " << i << ' ' << j;
            ASSERT_LE(reference.r[at], range.hi + 1e-9) << "sample " << i << ' ' << j;
          }
          if (std::abs(single.d[at] - d) > 1e-5)
          {
            ++jumps;
            oracle::Range range = oracle::ThicknessRange(terrain, medium, ray, 0x1p-22L, 2.0L);
            ASSERT_GE(single.d[at], oracle::Illumination(medium, range.hi) - 1e-5L)
              << i << ' ' << j;
            ASSERT_LE(single.d[at], oracle::Illumination(medium, range.lo) + 1e-5L)
              << i << ' ' << j;
          }
        }
      }
    }
  }
  std::printf("%ld of %ld rays ill-conditioned\n", jumps, rays);
  EXPECT_LE(jumps, rays / 1000);
}

INSTANTIATE_TEST_SUITE_P(RayInvariance, EveryDegree,
  ::testing::Combine(::testing::ValuesIn(AllOffsets), ::testing::Bool()),
  [](const auto& instance)
  {
    return std::string(NameOfOffset(std::get<0>(instance.param))) +
      (std::get<1>(instance.param) ? "WithHoles" : "Whole");
  });

// Turning the field and the light together by a quarter, or mirroring both, changes nothing. With
// holes that holds for rays that do not run along grid lines, beside which the cell after the line
// counts.
TEST(RayInvariance, QuarterTurnsAndMirrorsChangeNothing)
{
  Random random(Seed() + 1);
  for (int number = 0; number < 60; ++number)
  {
    SCOPED_TRACE(::testing::Message() << "RELIEF_SEED=" << Seed() << " field " << number);
    bool holes = number % 2 == 1;
    Terrain terrain(random.Integer(2, 24), random.Integer(2, 24), 1.0, random.Uniform(0.5, 2.0));
    for (double& height : terrain.heights)
    {
      height = random.Uniform(0.0, 3.0);
      height = holes && random.Chance(0.1) ? NoData : height;
    }
    Terrain turned(terrain.rows, terrain.columns, terrain.spacingY, terrain.spacingX);
    Terrain mirrored(terrain.columns, terrain.rows, terrain.spacingX, terrain.spacingY);
    for (int j = 0; j < terrain.rows; ++j)
    {
      for (int i = 0; i < terrain.columns; ++i)
      {
        turned.At(terrain.rows - 1 - j, i) = terrain.At(i, j);
        mirrored.At(terrain.columns - 1 - i, j) = terrain.At(i, j);
      }
    }
    double width = (terrain.columns - 1) * terrain.spacingX;
    double height = (terrain.rows - 1) * terrain.spacingY;

    std::vector<Light> lights;
    for (int k = 0; k < 8; ++k)
    {
      double azimuth = holes ? 1.0 + 88.0 * random.Uniform(0.0, 1.0) + 90.0 * (k % 4) : 45.0 * k;
      lights.push_back(Sun(azimuth, random.Uniform(2.0, 80.0)));
    }
    lights.push_back(Lamp(random.Uniform(-2.0, 20.0), random.Uniform(-2.0, 20.0), 4.0));
    for (const Light& light : lights)
    {
      for (int offset : AllOffsets)
      {
        ReliefMedium medium = Sunk(0.4, offset);
        Light other = light;
        other.vector.x = (light.positional ? height : 0.0) - light.vector.y;
        other.vector.y = light.vector.x;
        Light opposite = light;
        opposite.vector.x = (light.positional ? width : 0.0) - light.vector.x;
        std::vector<double> d = Reference(terrain, medium, light);
        std::vector<double> t = Reference(turned, medium, other);
        std::vector<double> m = Reference(mirrored, medium, opposite);
        for (int j = 0; j < terrain.rows; ++j)
        {
          for (int i = 0; i < terrain.columns; ++i)
          {
            if (std::isnan(terrain.At(i, j)))
            {
              continue;
            }
            double expected = d[j * terrain.columns + i];
            // Where a ray grazes the surface, rounding counts by its square root.
            ASSERT_NEAR(t[i * turned.columns + terrain.rows - 1 - j], expected, 1e-7);
            ASSERT_NEAR(m[j * terrain.columns + terrain.columns - 1 - i], expected, 1e-7);
          }
        }
      }
    }
  }
}

// Ground that is held level across a void continues a plain, so nothing shows where the void is; on
// a slope it is never higher than both the slope and a plain at the rim.
TEST(RayInvariance, VoidNeitherShadowsNorDarkensItsRim)
{
  Terrain plain(31, 31);
  Terrain slope(31, 31);
  slope.Fill([](double x, double y) { return 0.25 * x - 0.125 * y; });
  for (Terrain* terrain : { &plain, &slope })
  {
    for (int j = 0; j < 31; ++j)
    {
      for (int i = 0; i < 31; ++i)
      {
        if (std::hypot(i - 15.0, j - 14.0) < 7.0 || (i > 20 && j > 22))
        {
          terrain->At(i, j) = NoData;
        }
      }
    }
  }
  Samples<float> samples(plain);
  for (double azimuth = 0.0; azimuth < 360.0; azimuth += 5.0)
  {
    for (double altitude : { 3.0, 30.0, 60.0 })
    {
      SCOPED_TRACE(::testing::Message() << azimuth << ' ' << altitude);
      Light light = Sun(azimuth, altitude);
      double level = light.vector.z;
      double sloping = level - 0.25 * light.vector.x + 0.125 * light.vector.y;
      std::vector<double> flat = Reference(plain, Sunk(1.0), light);
      std::vector<double> tilted = Reference(slope, Sunk(1.0), light);
      std::vector<float> single = Trace<float>(samples.WithBounds(), Sunk(1.0), light).d;
      for (std::size_t k = 0; k < plain.heights.size(); ++k)
      {
        if (!std::isnan(plain.heights[k]))
        {
          ASSERT_NEAR(flat[k], level, 1e-12);
          ASSERT_NEAR(single[k], level, 1e-6);
          ASSERT_GE(tilted[k], std::min({ level, sloping, 1.0 }) - 1e-12);
        }
      }
    }
  }
}

// |d - d_exact| <= tolerance at every sample, and what is left out saves work.
TEST(RayInvariance, ToleranceBoundsTheError)
{
  Random random(Seed() + 2);
  Terrain terrain(160, 120);
  terrain.Fill(
    [&](double x, double y)
    {
      return 6.0 * std::sin(0.11 * x) * std::cos(0.07 * y) + 3.0 * std::sin(0.3 * x + 0.4 * y) +
        random.Uniform(0.0, 1.0);
    });
  Samples<float> samples(terrain);
  for (int attenuation : { relief::f64::RELIEF_RECIPROCAL, relief::f64::RELIEF_EXPONENTIAL })
  {
    for (const Light& light : { Sun(315.0, 12.0), Sun(100.0, 4.0), Lamp(80.0, 60.0, 12.0) })
    {
      ReliefMedium medium = Sunk(0.5);
      medium.attenuation = attenuation;
      medium.density = 0.7;
      Traced<double> exact = Trace<double>(samples.WithBounds(), medium, light);
      Traced<float> exactSingle = Trace<float>(samples.WithBounds(), medium, light);
      std::uint64_t cells = exact.count.cells;
      for (double tolerance : { 0.002, 0.02, 0.1 })
      {
        medium.tolerance = tolerance;
        Traced<double> traced = Trace<double>(samples.WithBounds(), medium, light);
        Traced<float> single = Trace<float>(samples.WithBounds(), medium, light);
        for (std::size_t k = 0; k < exact.d.size(); ++k)
        {
          ASSERT_NEAR(traced.d[k], exact.d[k], tolerance + 1e-12);
          ASSERT_NEAR(single.d[k], exactSingle.d[k], tolerance + 1e-6);
        }
        EXPECT_LT(traced.count.cells, cells);
        cells = traced.count.cells;
      }
    }
  }
}
