// SPDX-License-Identifier: BSD-3-Clause
//
// Rays through surfaces of which the thickness is known in closed form.
#include "RayThickness.h"
#include "TestTerrain.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

namespace
{
using relief::Light;
using relief::f64::RELIEF_SURFACE_NORMAL;
using relief::f64::RELIEF_VERTICAL;
using relief::f64::ReliefMedium;

constexpr double Infinite = std::numeric_limits<double>::infinity();

// A surface's d and r as the reference computes them, and the d of single precision with bounds.
struct Both
{
  Traced<double> exact;
  Traced<float> single;
};

Both TraceBoth(const Terrain& terrain, const ReliefMedium& medium, const Light& light)
{
  Samples<double> reference(terrain);
  Samples<float> samples(terrain);
  return { Trace<double>(reference.WithoutBounds(), medium, light),
    Trace<float>(samples.WithBounds(), medium, light) };
}

// Compares sample (i, j) with a known thickness. Single precision: heights and positions below 100
// carry errors below 4e-6, and r changes by as much over the sine of the angle at which the ray
// meets the surface; the tests keep that above 0.1 and depths at 0.1 and more, where d = t / r
// then moves by less than `single`.
void ExpectThickness(const Terrain& terrain, const ReliefMedium& medium, const Both& traced, int i,
  int j, double r, double single = 1e-6)
{
  std::size_t at = static_cast<std::size_t>(j) * terrain.columns + i;
  double d = r <= medium.depth ? 1.0 : medium.depth / r;
  EXPECT_NEAR(traced.exact.r[at], r, 1e-12 * std::max(r, 1.0)) << "sample " << i << ' ' << j;
  EXPECT_NEAR(traced.exact.d[at], d, 1e-12) << "sample " << i << ' ' << j;
  EXPECT_NEAR(traced.single.d[at], d, single) << "sample " << i << ' ' << j;
}

// Samples in the plane z = 5 + x / 4 - y / 8, which float holds exactly.
const glm::dvec2 PlaneSlope(0.25, -0.125);

Terrain Plane(int columns, int rows, double spacingX, double spacingY)
{
  Terrain terrain(columns, rows, spacingX, spacingY);
  terrain.Fill([](double x, double y) { return 5.0 + PlaneSlope.x * x + PlaneSlope.y * y; });
  return terrain;
}

// A level plain with a block of height `height` whose top spans the columns [first, last]: the
// surface between samples is bilinear, so its walls are ramps one cell wide.
Terrain Block(int columns, int rows, int first, int last, double height)
{
  Terrain terrain(columns, rows);
  terrain.Fill([=](double x, double) { return x >= first && x <= last ? height : 0.0; });
  return terrain;
}

// Inside length, over a profile of straight pieces between the points (x[k], h[k]), of the ray
// from (from, start) that climbs by `slope` per unit of x > from; level beyond the last point.
double UnderProfile(const std::vector<double>& x, const std::vector<double>& h, double from,
  double start, double slope)
{
  double length = 0.0;
  auto add = [&](double x0, double x1, double g0, double g1)
  {
    double share = g0 > 0.0 && g1 > 0.0 ? 1.0
      : g0 <= 0.0 && g1 <= 0.0          ? 0.0
                                        : std::max(g0, g1) / std::abs(g1 - g0);
    length += share * (x1 - x0);
  };
  for (std::size_t k = 0; k + 1 < x.size(); ++k)
  {
    double x0 = std::max(x[k], from);
    if (x0 < x[k + 1])
    {
      double h0 = h[k] + (h[k + 1] - h[k]) * (x0 - x[k]) / (x[k + 1] - x[k]);
      add(x0, x[k + 1], h0 - start - slope * (x0 - from),
        h[k + 1] - start - slope * (x[k + 1] - from));
    }
  }
  double rest = h.back() - start - slope * (x.back() - from);
  return rest > 0.0 ? length + rest / slope : length;
}
}

// p' lies t below the plane along its normal, and the ray climbs away from the plane by cos(theta)
// per unit of length: r = t / cos(theta), d = cos(theta), for every t.
TEST(RayThickness, PlaneIsLambertianWithNormalOffset)
{
  Terrain terrain = Plane(49, 41, 2.0, 1.5);
  glm::dvec3 n = glm::normalize(glm::dvec3(-PlaneSlope.x, -PlaneSlope.y, 1.0));
  long checked = 0;
  for (double depth : { 0.0, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0, 5.0, 10.0, 20.0 })
  {
    ReliefMedium medium = Sunk(depth, RELIEF_SURFACE_NORMAL);
    for (double azimuth = 0.0; azimuth < 360.0; azimuth += 15.0)
    {
      for (double altitude : { 10.0, 25.0, 45.0, 70.0, 90.0 })
      {
        Light light = Sun(azimuth, altitude);
        double cosine = glm::dot(n, light.vector);
        if (cosine < 0.1)
        {
          continue;
        }
        Both traced = TraceBoth(terrain, medium, light);
        SCOPED_TRACE(::testing::Message() << depth << ' ' << azimuth << ' ' << altitude);
        for (int j = 1; j < terrain.rows - 1; j += 4)
        {
          for (int i = 1; i < terrain.columns - 1; i += 4)
          {
            glm::dvec2 start(2.0 * i - depth * n.x, 1.5 * j - depth * n.y);
            glm::dvec2 out = start + glm::dvec2(light.vector) * (depth / cosine);
            glm::dvec2 size(2.0 * (terrain.columns - 1), 1.5 * (terrain.rows - 1));
            bool within = start.x >= 0.0 && start.y >= 0.0 && start.x <= size.x &&
              start.y <= size.y && out.x >= 0.0 && out.y >= 0.0 && out.x <= size.x &&
              out.y <= size.y;
            if (!within)
            {
              continue;
            }
            ++checked;
            std::size_t at = static_cast<std::size_t>(j) * terrain.columns + i;
            ASSERT_NEAR(traced.exact.d[at], cosine, 1e-12) << i << ' ' << j;
            // Single precision: lengths up to 100 over depths from 0.2 on.
            ASSERT_NEAR(traced.single.d[at], cosine, 1e-6) << i << ' ' << j;
          }
        }
      }
    }
  }
  EXPECT_GT(checked, 50000);
}

// p' lies t below the plane upright. Along the ray the plane's height above it starts as t and
// falls by l_z - a.l per unit of length, a the plane's slope: r = t / (l_z - a.l), which is
// cos(theta) over n_z.
TEST(RayThickness, PlaneWithVerticalOffset)
{
  Terrain terrain = Plane(49, 41, 2.0, 1.5);
  for (double depth : { 0.0, 0.2, 0.5, 1.0, 2.0 })
  {
    for (double azimuth = 0.0; azimuth < 360.0; azimuth += 15.0)
    {
      for (double altitude : { 20.0, 45.0, 75.0, 90.0 })
      {
        Light light = Sun(azimuth, altitude);
        double rate = light.vector.z - glm::dot(PlaneSlope, glm::dvec2(light.vector));
        if (rate < 0.1)
        {
          continue;
        }
        Both traced = TraceBoth(terrain, Sunk(depth), light);
        SCOPED_TRACE(::testing::Message() << depth << ' ' << azimuth << ' ' << altitude);
        // 16 columns and 13 rows off the border: the ray's way is at most 2 / 0.1.
        for (int j = 14; j < 27; ++j)
        {
          for (int i = 16; i < 33; ++i)
          {
            std::size_t at = static_cast<std::size_t>(j) * terrain.columns + i;
            ASSERT_NEAR(traced.exact.d[at], std::min(rate, 1.0), 1e-12);
            ASSERT_NEAR(traced.single.d[at], std::min(rate, 1.0), 1e-6);
          }
        }
      }
    }
  }
}

// Toward a wall of height W whose ramp begins u away, the ray leaves the ground after t / m, m the
// tangent of the altitude; it enters the ramp where W (x - u) = m x - t, and leaves the plateau at
// W = m x - t. Horizontal ways become lengths over the cosine of the altitude.
TEST(RayThickness, Wall)
{
  constexpr double W = 4.0;
  constexpr double t = 0.5;
  Terrain terrain = Block(40, 6, 20, 39, W);
  for (double altitude : { 15.0, 30.0, 45.0, 60.0 })
  {
    Both traced = TraceBoth(terrain, Sunk(t), Sun(90.0, altitude));
    double m = std::tan(altitude * Pi / 180.0);
    double stretch = 1.0 / std::cos(altitude * Pi / 180.0);
    SCOPED_TRACE(altitude);
    for (int i = 0; i < 19; ++i)
    {
      double u = 19.0 - i;
      double ground = t / m;
      double in = (W * u - t) / (W - m);
      double out = (W + t) / m;
      double way = ground < u ? ground + (in < u + 1.0 ? out - in : 0.0) : out;
      for (int j : { 0, 3, 5 })
      {
        ExpectThickness(terrain, Sunk(t), traced, i, j, way * stretch);
      }
    }
    for (int i = 20; i < 40; ++i)
    {
      // On the plateau, which is held level beyond the image.
      ExpectThickness(terrain, Sunk(t), traced, i, 5, t / m * stretch);
    }
  }
}

// The wall's top stands (20 - i) cells away: at depth 0 its shadow covers the ground as far as the
// sun's ray comes down from it, to the sample; beyond, a level plain has d = l_z.
TEST(RayThickness, ShadowOfAStep)
{
  constexpr double W = 4.0;
  Terrain terrain = Block(40, 6, 20, 39, W);
  for (double altitude : { 14.0, 18.0, 31.0, 44.0, 59.0 })
  {
    Both traced = TraceBoth(terrain, Sunk(0.0), Sun(90.0, altitude));
    double length = W / std::tan(altitude * Pi / 180.0);
    for (int i = 0; i < 40; ++i)
    {
      bool shadowed = i < 20 && 20 - i < length;
      double d = shadowed ? 0.0 : std::sin(altitude * Pi / 180.0);
      EXPECT_NEAR(traced.exact.d[2 * 40 + i], d, 1e-12) << altitude << ' ' << i;
      EXPECT_NEAR(traced.single.d[2 * 40 + i], d, 1e-6) << altitude << ' ' << i;
    }
  }
}

// Through a block on a plain: in through the near ramp, out through the top or the far ramp, or
// over it. The profile is known in closed form, along the rows and askew, where every way along x
// is sin(azimuth) cos(altitude) of the length.
TEST(RayThickness, BlockOnAPlain)
{
  constexpr double t = 0.25;
  Terrain terrain = Block(64, 64, 30, 33, 3.0);
  std::vector<double> x = { 0.0, 29.0, 30.0, 33.0, 34.0, 63.0 };
  std::vector<double> h = { 0.0, 0.0, 3.0, 3.0, 0.0, 0.0 };
  for (double azimuth : { 90.0, 70.0, 101.0 })
  {
    for (double altitude : { 8.0, 15.0, 30.0, 50.0 })
    {
      SCOPED_TRACE(::testing::Message() << azimuth << ' ' << altitude);
      Light light = Sun(azimuth, altitude);
      Both traced = TraceBoth(terrain, Sunk(t), light);
      for (int i = 4; i < 40; ++i)
      {
        double way = UnderProfile(x, h, i, terrain.At(i, 32) - t, light.vector.z / light.vector.x);
        ExpectThickness(terrain, Sunk(t), traced, i, 32, way / light.vector.x);
      }
    }
  }
}

TEST(RayThickness, TriangularRidges)
{
  constexpr double t = 0.5;
  Terrain terrain(97, 65);
  terrain.Fill([](double x, double) { return 0.5 * std::abs(std::fmod(x, 8.0) - 4.0); });
  std::vector<double> x;
  std::vector<double> h;
  for (int k = 0; k <= 24; ++k)
  {
    x.push_back(4.0 * k);
    h.push_back(k % 2 == 0 ? 2.0 : 0.0);
  }
  for (double azimuth : { 30.0, 60.0, 90.0, 120.0, 150.0 })
  {
    for (double altitude : { 5.0, 12.0, 35.0, 80.0 })
    {
      SCOPED_TRACE(::testing::Message() << azimuth << ' ' << altitude);
      Light light = Sun(azimuth, altitude);
      Both traced = TraceBoth(terrain, Sunk(t), light);
      for (int i = 1; i < 60; ++i)
      {
        // The ray is above everything once it has climbed 2.5, or else has left the image.
        double length = 2.5 / light.vector.z;
        double away = 32.0 + length * light.vector.y;
        if (i + length * light.vector.x < 96.0 && away > 0.0 && away < 64.0)
        {
          double way =
            UnderProfile(x, h, i, terrain.At(i, 32) - t, light.vector.z / light.vector.x);
          // Some of these rays meet a flank at 1 in 40.
          ExpectThickness(terrain, Sunk(t), traced, i, 32, way / light.vector.x, 5e-6);
        }
      }
    }
  }
}

// Inside a sphere of radius R about the origin a ray from p' runs until |p' + r l| = R:
// r = -p'.l + sqrt((p'.l)^2 - |p'|^2 + R^2). The bilinear surface approaches the sphere with the
// square of the spacing.
TEST(RayThickness, DomeConvergesAtSecondOrder)
{
  constexpr double R = 10.0;
  ReliefMedium medium = Sunk(1.0);
  for (double azimuth : { 30.0, 90.0, 135.0, 250.0 })
  {
    Light light = Sun(azimuth, 35.0);
    std::vector<double> errors;
    for (int cells : { 24, 48, 96, 192, 384 })
    {
      double spacing = 12.0 / cells;
      Terrain terrain(cells + 1, cells + 1, spacing, spacing);
      auto dome = [](double x, double y)
      { return std::sqrt(R * R - (x - 6.0) * (x - 6.0) - (y - 6.0) * (y - 6.0)); };
      terrain.Fill(dome);
      Samples<double> samples(terrain);
      Traced<double> traced = Trace<double>(samples.WithoutBounds(), medium, light);
      double sum = 0.0;
      int count = 0;
      for (int j = cells / 4; j <= 3 * cells / 4; j += cells / 24)
      {
        for (int i = cells / 4; i <= 3 * cells / 4; i += cells / 24)
        {
          glm::dvec3 p(i * spacing - 6.0, j * spacing - 6.0, terrain.At(i, j) - medium.depth);
          double along = glm::dot(p, light.vector);
          double r = -along + std::sqrt(along * along - glm::dot(p, p) + R * R);
          double error = traced.r[static_cast<std::size_t>(j) * terrain.columns + i] - r;
          sum += error * error;
          ++count;
        }
      }
      errors.push_back(std::sqrt(sum / count));
    }
    // A single step's order wavers with where in their cells the rays leave.
    for (std::size_t k = 1; k < errors.size(); ++k)
    {
      std::printf("azimuth %g: rms %.3g, order %.3f\n", azimuth, errors[k],
        std::log2(errors[k - 1] / errors[k]));
    }
    double steps = static_cast<double>(errors.size() - 1);
    EXPECT_GT(std::log2(errors.front() / errors.back()) / steps, 1.8);
  }
}

// A plain at height 2, t = 0.5, so p' at 1.5. Above a floor the thickness is the way from the floor
// to the surface, or what of it p' sees.
TEST(RayThickness, Floor)
{
  Terrain terrain(9, 9);
  terrain.Fill([](double, double) { return 2.0; });
  struct Case
  {
    double floor;
    Light light;
    double r;
  };
  double rise = std::sin(40.0 * Pi / 180.0);
  const Case cases[] = {
    { 1.0, Sun(30.0, 40.0), 0.5 / rise },   // p' above the floor, light above
    { 1.0, Sun(30.0, -40.0), 0.5 / rise },  // light from below, through the floor
    { 1.75, Sun(30.0, 40.0), 0.25 / rise }, // p' below the floor
    { 1.75, Sun(30.0, -40.0), 0.0 },        // and light from below
    { 1.75, Sun(30.0, 0.0), 0.0 },          // level below the floor
    { 1.0, Sun(30.0, 0.0), Infinite },      // level inside
    { 3.0, Sun(30.0, 40.0), 0.0 },          // floor above the surface
    { 3.0, Sun(30.0, -40.0), 0.0 },         //
    { 1.0, Sun(0.0, 90.0), 0.5 },           // upright
    { 1.0, Sun(0.0, -90.0), 0.5 },          // upright from below
    { 1.0, Lamp(4.0, 4.0, -6.0), 0.5 },     // lamp below the floor
    { 1.0, Lamp(4.0, 4.0, 1.25), 0.25 },    // lamp in the material
    { 1.75, Lamp(4.0, 4.0, 1.9), 0.15 },    // p' below the floor, lamp inside
    { -10.0, Lamp(4.0, 4.0, -8.5), 10.0 },  // lamp in the material far below
  };
  for (int offset : AllOffsets) // the same where n = (0, 0, 1)
  {
    for (const Case& c : cases)
    {
      ReliefMedium medium = WithFloor(Sunk(0.5, offset), c.floor);
      Both traced = TraceBoth(terrain, medium, c.light);
      SCOPED_TRACE(::testing::Message() << "floor " << c.floor << " light " << c.light.vector.z);
      if (std::isinf(c.r))
      {
        EXPECT_EQ(traced.exact.r[40], Infinite);
        EXPECT_EQ(traced.exact.d[40], 0.0);
        EXPECT_EQ(traced.single.d[40], 0.0f);
      }
      else
      {
        ExpectThickness(terrain, medium, traced, 4, 4, c.r);
      }
    }
  }
}

// On a plain r = t / l_z; the attenuation counts what exceeds t.
TEST(RayThickness, ExponentialAttenuation)
{
  Terrain terrain(5, 5);
  for (double density : { 0.0, 0.5, 3.0 })
  {
    ReliefMedium medium = Sunk(0.5);
    medium.attenuation = relief::f64::RELIEF_EXPONENTIAL;
    medium.density = density;
    for (double altitude : { 5.0, 30.0, 90.0 })
    {
      Both traced = TraceBoth(terrain, medium, Sun(77.0, altitude));
      double r = 0.5 / std::sin(altitude * Pi / 180.0);
      EXPECT_NEAR(traced.exact.d[12], std::exp(-density * (r - 0.5)), 1e-12);
      EXPECT_NEAR(traced.single.d[12], std::exp(-density * (r - 0.5)), 1e-6);
    }
    EXPECT_EQ(TraceBoth(terrain, medium, Sun(77.0, -1.0)).exact.d[12], 0.0);
  }
}

// A plain at 0, t = 0.5. Above it a lamp's ray is inside for the share t / (z_L + t) of its length;
// below it, for all of it.
TEST(RayThickness, PositionalLight)
{
  Terrain terrain(17, 17);
  ReliefMedium medium = Sunk(0.5);
  auto at = [&](const Light& light) { return TraceBoth(terrain, medium, light); };
  double distance = glm::length(glm::dvec3(3.0, 4.0, 6.5));
  ExpectThickness(terrain, medium, at(Lamp(11.0, 12.0, 6.0)), 8, 8, distance * 0.5 / 6.5);
  ExpectThickness(
    terrain, medium, at(Lamp(11.0, 12.0, -2.5)), 8, 8, glm::length(glm::dvec3(3.0, 4.0, 2.0)));
  ExpectThickness(terrain, medium, at(Lamp(8.0, 8.0, 7.0)), 8, 8, 0.5);
  ExpectThickness(terrain, medium, at(Lamp(8.25, 8.0, -0.5)), 8, 8, 0.25);
  ExpectThickness(terrain, medium, at(Lamp(8.0, 8.0, -0.5)), 8, 8, 0.0);
  // Far outside the image, level with p': the plain is held level all the way.
  ExpectThickness(terrain, medium, at(Lamp(-92.0, 8.0, -0.5)), 8, 8, 100.0);
  // A light so far off that its square overflows in single precision is as good as a directional
  // one.
  glm::dvec3 far = 1e25 * Toward(33.0, 40.0);
  ExpectThickness(
    terrain, medium, at(Lamp(far.x, far.y, far.z)), 8, 8, 0.5 / std::sin(40.0 * Pi / 180.0));
}

TEST(RayThickness, HorizonAndZenith)
{
  Terrain terrain = Block(20, 5, 6, 9, 2.0);
  Samples<double> samples(terrain);
  auto trace = [&](const Light& light)
  { return Trace<double>(samples.WithoutBounds(), Sunk(0.5), light); };
  // Below the horizon, and level under the plain: nothing ever ends the material.
  for (const Light& light : { Sun(90.0, -20.0), Sun(90.0, 0.0), Sun(217.0, -90.0) })
  {
    EXPECT_EQ(trace(light).r[2 * 20 + 3], Infinite);
    EXPECT_EQ(trace(light).d[2 * 20 + 3], 0.0);
  }
  // Level from inside the block's top, at height 1.5: out through the ramp a quarter of its width
  // beyond the top's last column.
  Traced<double> level = trace(Sun(90.0, 0.0));
  for (int i = 6; i <= 9; ++i)
  {
    EXPECT_NEAR(level.r[2 * 20 + i], 9.25 - i, 1e-14);
  }
  // Upright: t of material above every point.
  for (double d : trace(Sun(0.0, 90.0)).d)
  {
    EXPECT_EQ(d, 1.0);
  }
}
