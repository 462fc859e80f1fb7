// SPDX-License-Identifier: BSD-3-Clause
//
// Algorithm 1 counted by hand: n of the S + 1 points p' + k (p_L - p') / S stand below the surface
// at their nearest sample, d = 1 / (1 + n).
#include "StepThickness.h"
#include "TestTerrain.h"

#include <gtest/gtest.h>

namespace
{
// d and r of sample (i, j).
std::pair<float, float> Count(
  const Terrain& terrain, double depth, const relief::Light& light, int steps, int i, int j)
{
  Samples<float> samples(terrain);
  relief::RowRequest<float> request;
  float d = -1.0f;
  float r = -1.0f;
  request.j = j;
  request.begin = i;
  request.end = i + 1;
  request.illumination = &d;
  request.thickness = &r;
  relief::RayCount count;
  relief::StepRow(
    samples.WithBounds(), relief::ToSingle(Sunk(depth)), light, steps, request, count);
  EXPECT_EQ(count.rays, 1u);
  EXPECT_EQ(count.cells, static_cast<std::uint64_t>(steps) + 1);
  return { d, r };
}

// A plain with a ridge of height 2 along column 2.
Terrain Ridge()
{
  Terrain terrain(5, 3);
  terrain.Fill([](double x, double) { return x == 2.0 ? 2.0 : 0.0; });
  return terrain;
}
}

// From (0, 1, -1) to (4, 1, 4):
//   k       0     1     2     3     4
//   x       0     1     2     3     4
//   height  0     0     2     0     0
//   z      -1  0.25   1.5  2.75     4
//   below   *           *                n = 2
TEST(StepThickness, WholeSteps)
{
  auto [d, r] = Count(Ridge(), 1.0, Lamp(4.0, 1.0, 4.0), 4, 0, 1);
  EXPECT_EQ(d, 1.0f / 3.0f);
  EXPECT_FLOAT_EQ(r, 2.0f * std::sqrt(41.0f) / 4.0f); // two of four steps
}

// The two ends only: p' is below the surface, the light is not.
TEST(StepThickness, OneStep)
{
  EXPECT_EQ(Count(Ridge(), 1.0, Lamp(4.0, 1.0, 4.0), 1, 0, 1).first, 0.5f);
}

// From (0, 1, -1) to (4, 1, 3.5):
//   k       0     1     2     3     4     5
//   x       0   0.8   1.6   2.4   3.2     4
//   sample  0     1     2     2     3     4
//   height  0     0     2     2     0     0
//   z      -1  -0.1   0.8   1.7   2.6   3.5
//   below   *     *     *     *               n = 4
TEST(StepThickness, NearestSample)
{
  EXPECT_EQ(Count(Ridge(), 1.0, Lamp(4.0, 1.0, 3.5), 5, 0, 1).first, 0.2f);
}

// As above with sample 1 missing: k = 1 counts no more, n = 3.
TEST(StepThickness, MissingDataIsNotCounted)
{
  Terrain terrain = Ridge();
  terrain.At(1, 1) = NoData;
  EXPECT_EQ(Count(terrain, 1.0, Lamp(4.0, 1.0, 3.5), 5, 0, 1).first, 0.25f);
}

// Toward (-4, 1, -5), below everything: with 4 steps the points stand at x = 0, -1, -2, -3, -4, of
// which the first is in the image; with 10 that at -0.4 is nearest to sample 0 as well, and that at
// -0.8 to none. On the other side 4.4 is nearest to 4, and 4.8 to none.
TEST(StepThickness, OutsideTheImageIsNotCounted)
{
  EXPECT_EQ(Count(Ridge(), 1.0, Lamp(-4.0, 1.0, -5.0), 4, 0, 1).first, 1.0f / 2.0f);
  EXPECT_EQ(Count(Ridge(), 1.0, Lamp(-4.0, 1.0, -5.0), 10, 0, 1).first, 1.0f / 3.0f);
  EXPECT_EQ(Count(Ridge(), 1.0, Lamp(8.0, 1.0, -5.0), 10, 4, 1).first, 1.0f / 3.0f);
}

// A light at p' itself: all S + 1 points stand there.
TEST(StepThickness, LightAtTheStart)
{
  EXPECT_EQ(Count(Ridge(), 1.0, Lamp(0.0, 1.0, -1.0), 4, 0, 1).first, 1.0f / 6.0f);
}

// On a plain the count times the step tends to the thickness, t / l_z.
TEST(StepThickness, ManySteps)
{
  Terrain terrain(40, 40);
  relief::Light light = Lamp(30.0, 20.0, 9.0); // l_z = 10 / |(20, 10, 10)|
  double length = std::sqrt(600.0);
  for (int steps : { 64, 1000, 20000 })
  {
    auto [d, r] = Count(terrain, 1.0, light, steps, 10, 10);
    EXPECT_NEAR(r, length / 10.0, length / steps * 1.01);
    EXPECT_NEAR(1.0 / d - 1.0, steps / 10.0, 1.01);
  }
}

// The box about Ridge() measures 4 x 2 x 2 and has its centre at (2, 1, 1); half its diagonal is
// sqrt(4^2 + 2^2 + 2^2) / 2 = sqrt(6).
TEST(StepThickness, DirectionalLightOnTheBoundingSphere)
{
  Samples<float> samples(Ridge());
  const relief::HeightView<float>& heights = samples.WithBounds().heights;
  double radius = std::sqrt(6.0);

  relief::Light placed =
    relief::OnBoundingSphere(Directional(glm::dvec3(0.6, 0.0, 0.8)), heights, 0.0, 2.0);
  EXPECT_TRUE(placed.positional);
  EXPECT_NEAR(placed.vector.x, 2.0 + 0.6 * radius, 1e-15);
  EXPECT_NEAR(placed.vector.y, 1.0, 1e-15);
  EXPECT_NEAR(placed.vector.z, 1.0 + 0.8 * radius, 1e-15);

  // Toward (1, 0, 0) the light stands at (4.449, 1, 1). From (1, 1, -1), S = 3:
  //   k       0      1      2      3
  //   x       1   2.15   3.30   4.45
  //   height  0      2      0      0
  //   z      -1  -0.33   0.33      1
  //   below   *      *                 n = 2
  placed = relief::OnBoundingSphere(Directional(glm::dvec3(1.0, 0.0, 0.0)), heights, 0.0, 2.0);
  EXPECT_EQ(Count(Ridge(), 1.0, placed, 3, 1, 1).first, 1.0f / 3.0f);
}
