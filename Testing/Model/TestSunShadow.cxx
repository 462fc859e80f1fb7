// SPDX-License-Identifier: BSD-3-Clause
//
// The shadow of the relief against the steepest line of sight, found by brute force.
#include "PreparedTerrain.h"

#include "LightSampling.h"
#include "SunShadow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace relief;

namespace
{
// The share that is hidden, of all samples.
std::vector<float> Hidden(const HeightField& field, const std::vector<Light>& disc)
{
  const HeightView<float>& heights = field.GetField().heights;
  const SunShadow shadow(field, disc);
  constexpr int width = SweepThickness::TileWidth;
  constexpr int height = SweepThickness::TileHeight;
  std::vector<float> result(static_cast<std::size_t>(heights.columns) * heights.rows);
  RayCount count;
  for (int row = 0; row * height < heights.rows; ++row)
  {
    for (int column = 0; column * width < heights.columns; ++column)
    {
      float tile[SweepThickness::TileSize];
      shadow.ShadeTile(column, row, tile, count);
      for (int j = row * height; j < std::min((row + 1) * height, heights.rows); ++j)
      {
        for (int i = column * width; i < std::min((column + 1) * width, heights.columns); ++i)
        {
          result[static_cast<std::size_t>(j) * heights.columns + i] =
            tile[(j - row * height) * width + (i - column * width)];
        }
      }
    }
  }
  return result;
}

// The height of the surface, by the samples around.
double Surface(const HeightView<float>& heights, double x, double y)
{
  const int i = std::min(static_cast<int>(x), heights.columns - 2);
  const int j = std::min(static_cast<int>(y), heights.rows - 2);
  const double u = x - i;
  const double v = y - j;
  return (1.0 - v) * ((1.0 - u) * heights.At(i, j) + u * heights.At(i + 1, j)) +
    v * ((1.0 - u) * heights.At(i, j + 1) + u * heights.At(i + 1, j + 1));
}

// The greatest slope at which the surface is seen from a sample in the direction of a light;
// without bound below where there is nothing.
double SteepestSight(const HeightView<float>& heights, int i, int j, const Light& light)
{
  const double across = std::hypot(light.vector.x, light.vector.y);
  const double dx = light.vector.x / across / heights.spacingX;
  const double dy = light.vector.y / across / heights.spacingY;
  double steepest = -std::numeric_limits<double>::infinity();
  for (double s = 1e-3;; s += s < 0.1 ? 1e-3 : 0.02)
  {
    const double x = i + s * dx;
    const double y = j + s * dy;
    if (!(x >= 0.0 && x <= heights.columns - 1 && y >= 0.0 && y <= heights.rows - 1))
    {
      return steepest;
    }
    steepest = std::max(steepest, (Surface(heights, x, y) - heights.At(i, j)) / s);
  }
}

// Rough ground of some size, with some relief.
Terrain Rough(Random& random)
{
  Terrain terrain(random.Integer(2, 75), random.Integer(2, 75), random.Uniform(0.5, 2.0),
    random.Uniform(0.5, 2.0));
  const double a = random.Uniform(0.05, 0.5);
  const double b = random.Uniform(0.05, 0.5);
  const double relief = random.Logarithmic(0.1, 10.0);
  terrain.Fill([&](double x, double y)
    { return relief * (std::sin(a * x) * std::cos(b * y) + random.Uniform(0.0, 0.4)); });
  terrain.RoundToSingle();
  return terrain;
}
}

// Hidden is what lies below the line of sight to the steepest ground, and nothing else; in lockstep
// and, where the field is not padded, in packets.
TEST(SunShadow, IsBelowTheSteepestSight)
{
  const std::uint64_t seed = Seed();
  Random random(seed);
  int lit = 0;
  int dark = 0;
  int close = 0;
  for (int round = 0; round < 60; ++round)
  {
    HeightField field;
    Prepare(Rough(random), field, round % 3 != 0);
    const HeightView<float>& heights = field.GetField().heights;
    const Light sun =
      Sun(random.Chance(0.3) ? 45.0 * random.Integer(0, 7) : random.Uniform(0.0, 360.0),
        random.Uniform(3.0, 85.0));
    const double slope = sun.vector.z / std::hypot(sun.vector.x, sun.vector.y);
    const std::vector<float> hidden = Hidden(field, { sun });
    for (int check = 0; check < 200; ++check)
    {
      const int i = random.Integer(0, heights.columns - 1);
      const int j = random.Integer(0, heights.rows - 1);
      const double sight = SteepestSight(heights, i, j, sun);
      const float found = hidden[static_cast<std::size_t>(j) * heights.columns + i];
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", round " << round << ": " << i << ' '
                                      << j << ", seen at " << sight << ", sun at " << slope);
      // Steps of the sight miss a little of a bow.
      if (std::abs(sight - slope) < 0.01 * (1.0 + slope))
      {
        ++close;
        continue;
      }
      ASSERT_EQ(found, sight > slope ? 1.0f : 0.0f);
      ++(sight > slope ? dark : lit);
    }
  }
  EXPECT_GT(lit, 2000);
  EXPECT_GT(dark, 1000);
  EXPECT_LT(close, 1200);
}

// A wall hides of a disc what lies below its upper edge: none, all, or the part by its weight.
TEST(SunShadow, OfADiscBehindAWall)
{
  HeightField field;
  Terrain terrain(200, 24);
  terrain.Fill([](double x, double) { return x >= 150.0 ? 20.0 : 0.0; });
  Prepare(terrain, field);
  constexpr double diameter = 4.0 * Pi / 180.0;
  const std::vector<Light> disc = SampleDisc(Sun(90.0, 20.0), diameter, 64);
  const std::vector<float> hidden = Hidden(field, disc);
  double sum = 0.0;
  for (const Light& light : disc)
  {
    sum += light.weight;
  }
  bool partly = false;
  for (int i = 0; i < 149; ++i)
  {
    // The wall rises from 149 to 150; its upper edge is what hides.
    double below = 0.0;
    for (const Light& light : disc)
    {
      below +=
        light.vector.z * (150.0 - i) / light.vector.x < 20.0 - 1e-4 ? light.weight / sum : 0.0;
    }
    const float found = hidden[static_cast<std::size_t>(12) * 200 + i];
    EXPECT_NEAR(found, below, 1e-6) << i;
    partly = partly || (found > 0.1f && found < 0.9f);
  }
  EXPECT_TRUE(partly);
  EXPECT_EQ(hidden[12 * 200 + 148], 1.0f);
  EXPECT_EQ(hidden[12 * 200 + 20], 0.0f);
}

// Below the horizon a sun is hidden, and a disc that rises is in part.
TEST(SunShadow, OfASunThatRises)
{
  HeightField field;
  Terrain terrain(80, 80);
  Prepare(terrain, field);
  const std::vector<float> night = Hidden(field, { Sun(120.0, -1.0) });
  EXPECT_EQ(*std::min_element(night.begin(), night.end()), 1.0f);
  const std::vector<float> dawn = Hidden(field, SampleDisc(Sun(120.0, 0.0), 2.0 * Pi / 180.0, 64));
  EXPECT_NEAR(dawn[80 * 40 + 40], 0.5, 0.1);
  const std::vector<float> day = Hidden(field, SampleDisc(Sun(120.0, 30.0), 2.0 * Pi / 180.0, 64));
  EXPECT_EQ(*std::max_element(day.begin(), day.end()), 0.0f);
}
