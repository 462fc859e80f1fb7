// SPDX-License-Identifier: BSD-3-Clause
//
// Planes, on which d is known: with the offset to the tangent plane it is the cosine of the angle
// at which light strikes, by every way to compute it.
#include "HardTracer.h"
#include "ThicknessOracle.h"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace
{
using relief::Light;

// Slopes of a plane, and a field of it. Multiples of 1/64, so that single precision holds all
// heights.
struct Plane
{
  glm::dvec2 slope;
  HardScene scene;

  Plane(Random& random, int offset)
  {
    const double steepest = std::tan(Pi / 3.0);
    do
    {
      this->slope = glm::dvec2(random.Integer(-110, 110), random.Integer(-110, 110)) / 64.0;
    } while (glm::length(this->slope) > steepest);
    Terrain& terrain = this->scene.terrain;
    // A depth beside which the last place of the heights is below 1e-6.
    terrain = Terrain(random.Integer(17, 40), random.Integer(17, 40), 0.125 * random.Integer(1, 4),
      0.125 * random.Integer(1, 4));
    terrain.Fill(
      [&](double x, double y) { return this->slope.x * (x - 4.0) + this->slope.y * (y - 4.0); });
    this->scene.medium = Sunk(random.Chance(0.2) ? 0.0 : random.Uniform(1.0, 3.0), offset);
  }

  // Toward one that shines on it from above.
  Light RandomLight(Random& random) const
  {
    const Terrain& terrain = this->scene.terrain;
    if (random.Chance(0.5))
    {
      const double azimuth =
        random.Chance(0.3) ? 45.0 * random.Integer(0, 7) : random.Uniform(0.0, 360.0);
      return Sun(azimuth, random.Uniform(3.0, 89.0));
    }
    const double x = terrain.spacingX * terrain.columns * random.Uniform(-0.5, 1.5);
    const double y = terrain.spacingY * terrain.rows * random.Uniform(-0.5, 1.5);
    return Lamp(
      x, y, this->slope.x * (x - 4.0) + this->slope.y * (y - 4.0) + random.Uniform(1.0, 60.0));
  }
};
}

class Planes : public testing::TestWithParam<int>
{
};

// d = cos theta below the tangent plane and along the normal, cos theta / n_z straight down. The
// border has no rim where the plane rises at most half as steeply as the ray.
TEST_P(Planes, AreLambertianUpToTheBorder)
{
  const int offset = GetParam();
  Random random(Seed());
  long checked = 0;
  long atBorder = 0;
  for (int number = 0; number < 40; ++number)
  {
    Plane plane(random, offset);
    const Terrain& terrain = plane.scene.terrain;
    const double depth = plane.scene.medium.depth;
    const glm::dvec3 n = glm::normalize(glm::dvec3(-plane.slope, 1.0));
    const glm::dvec3 sink = offset == relief::f64::RELIEF_SURFACE_NORMAL
      ? depth * n
      : glm::dvec3(0.0, 0.0, offset == relief::f64::RELIEF_VERTICAL ? depth : depth / n.z);
    const glm::dvec2 size(
      (terrain.columns - 1) * terrain.spacingX, (terrain.rows - 1) * terrain.spacingY);
    auto isIn = [&](const glm::dvec2& p)
    { return p.x >= 0.0 && p.y >= 0.0 && p.x <= size.x && p.y <= size.y; };
    const HardTracer tracer(plane.scene);
    for (int k = 0; k < 10; ++k)
    {
      const Light light = plane.RandomLight(random);
      for (Method method : AllMethods)
      {
        if (!tracer.Applies(method, light))
        {
          continue;
        }
        SCOPED_TRACE(testing::Message() << "RELIEF_SEED=" << Seed() << " plane " << number << ": "
                                        << NameOf(method) << ", light " << k);
        const Traced<double> traced = tracer.Trace(method, light);
        for (int j = 0; j < terrain.rows; ++j)
        {
          for (int i = 0; i < terrain.columns; ++i)
          {
            const glm::dvec3 start =
              glm::dvec3(i * terrain.spacingX, j * terrain.spacingY, terrain.At(i, j)) - sink;
            const glm::dvec3 l =
              light.positional ? glm::normalize(light.vector - start) : light.vector;
            const double cosine = glm::dot(n, l);
            const double expected =
              offset == relief::f64::RELIEF_VERTICAL ? std::min(cosine / n.z, 1.0) : cosine;
            const glm::dvec2 out = glm::dvec2(start) +
              glm::dvec2(l) * (std::max(depth, 1e-3) / std::max(expected, 1e-9));
            const double rise = glm::dot(plane.slope, glm::dvec2(l));
            // Outside the image the ground is another, which a falling ray may meet. A ray along
            // the surface is not inside, and rounding says which runs along it.
            const bool known = l.z > 0.0 ? isIn(out) || rise < 0.499 * l.z
                                         : isIn(out) && isIn(glm::dvec2(light.vector));
            // At depth 0 the point is beside its sample, too.
            const glm::dvec2 beside = depth > 0.0 ? start : start - 1e-3 * n;
            const bool starts = offset != relief::f64::RELIEF_SURFACE_NORMAL || isIn(beside);
            if (cosine > 0.01 && known && starts)
            {
              ++checked;
              atBorder += isIn(out) ? 0 : 1;
              const std::size_t at = static_cast<std::size_t>(j) * terrain.columns + i;
              // A point beside the grid has a place of as many digits as its coordinates.
              const double single = offset == relief::f64::RELIEF_SURFACE_NORMAL ? 5e-6 : 1e-6;
              ASSERT_NEAR(traced.d[at], expected, method == Method::Reference ? 1e-12 : single)
                << "sample " << i << ' ' << j;
            }
          }
        }
      }
    }
  }
  EXPECT_GT(checked, 300000);
  EXPECT_GT(atBorder, 30000);
}

INSTANTIATE_TEST_SUITE_P(, Planes, testing::ValuesIn(AllOffsets),
  [](const auto& instance) { return std::string(NameOfOffset(instance.param)); });

// Above 60 degrees the point is sunk by 2 t: deeper would be far from the sample.
TEST(TangentPlane, SteeperThanSixtyDegreesSinkByTwiceTheDepth)
{
  Terrain terrain(40, 40);
  terrain.Fill([](double x, double) { return 4.0 * x; });
  Samples<double> samples(terrain);
  const Traced<double> traced = Trace<double>(
    samples.WithoutBounds(), Sunk(1.0, relief::f64::RELIEF_TANGENT_PLANE), Sun(0.0, 30.0));
  EXPECT_NEAR(traced.r[20 * 40 + 20], 2.0 / 0.5, 1e-12);
}

namespace
{
// d of every sample of a scene with one light, by one way to compute it.
std::vector<double> IlluminationOf(const HardScene& scene, Method method)
{
  return HardTracer(scene).Trace(method, scene.lights.front()).d;
}

// Calls body(scene, method) for suns and lamps in the east of hills whose height is given, under
// every offset.
template <class Height, class Body>
void ForEachBorder(Height&& height, Body&& body)
{
  for (int offset : AllOffsets)
  {
    for (const Light& light : { Sun(90.0, 20.0), Sun(72.0, 20.0), Lamp(30.0, 3.0, 12.0) })
    {
      HardScene scene;
      scene.terrain = Terrain(12, 9);
      scene.terrain.Fill(height);
      scene.medium = Sunk(1.5, offset);
      scene.lights = { light };
      const HardTracer tracer(scene);
      for (Method method : AllMethods)
      {
        if (tracer.Applies(method, light))
        {
          SCOPED_TRACE(std::string(NameOf(method)) + ", " + NameOfOffset(offset));
          body(scene, method);
        }
      }
    }
  }
}
}

// Ground beyond the border goes on steadily steeper or gentler with the border's, up to half as
// steep as the ray and beyond: d makes no jump.
TEST(Border, MakesNoJumpWhenItsSlopeChanges)
{
  // A dome, which a ray from below leaves once: where one begins to graze d changes as a root.
  ForEachBorder([](double x, double y) { return 0.1 * y - 0.01 * (x - 5.5) * (x - 5.5); },
    [](HardScene scene, Method method)
    {
      Terrain& terrain = scene.terrain;
      const Terrain hills = terrain;
      std::vector<double> before;
      double most = 0.0;
      double least = 1.0;
      for (int step = -256; step <= 256; ++step)
      {
        for (int j = 0; j < terrain.rows; ++j)
        {
          for (int i = 0; i < terrain.columns; ++i)
          {
            terrain.At(i, j) = hills.At(i, j) + i * step / 1024.0;
          }
        }
        const std::vector<double> d = IlluminationOf(scene, method);
        for (std::size_t at = 0; at < before.size(); ++at)
        {
          // Sunk along the normal, points of the border's samples move out of the image.
          const int i = static_cast<int>(at) % terrain.columns;
          const int j = static_cast<int>(at) / terrain.columns;
          const bool outermost =
            i == 0 || j == 0 || i == terrain.columns - 1 || j == terrain.rows - 1;
          if (outermost && scene.medium.offset == relief::f64::RELIEF_SURFACE_NORMAL)
          {
            continue;
          }
          ASSERT_NEAR(d[at], before[at], 0.03) << "sample " << at << ", step " << step;
        }
        before = d;
        most = std::max(most, d[static_cast<std::size_t>(terrain.columns) * 5 - 1]);
        least = std::min(least, d[static_cast<std::size_t>(terrain.columns) * 5 - 1]);
      }
      EXPECT_GT(most - least, 0.2); // the border's samples do change
    });
}

// A sample that is inside at the border has at most twice the thickness that level ground makes.
TEST(Border, AtMostDoublesTheThickness)
{
  ForEachBorder([](double x, double) { return 2.0 * x; },
    [](const HardScene& scene, Method method)
    {
      const Traced<double> traced = HardTracer(scene).Trace(method, scene.lights.front());
      const Terrain& terrain = scene.terrain;
      const std::size_t at = static_cast<std::size_t>(terrain.columns) * 5 - 1;
      const oracle::Ray ray =
        oracle::RayOf(terrain, scene.medium, scene.lights.front(), terrain.columns - 1, 4);
      if (ray.x == 0.0L && ray.stepZ > 0.0L)
      {
        const double level = static_cast<double>(-ray.z / ray.stepZ);
        EXPECT_NEAR(traced.r[at], 2.0 * level, 1e-5 * level);
      }
    });
}

// Raising ground between a sample and the sun never lights it, the border's own ground included.
TEST(Border, RaisedInFrontOfASampleNeverLightsIt)
{
  Random random(Seed());
  ForEachBorder([&random](double, double) { return random.Uniform(0.0, 1.0); },
    [&](const HardScene& scene, Method method)
    {
      const std::vector<double> low = IlluminationOf(scene, method);
      for (int i : { 7, 10, 11 })
      {
        HardScene raised = scene;
        const Terrain& terrain = scene.terrain;
        for (int j = 0; j < terrain.rows; ++j)
        {
          raised.terrain.At(i, j) += 0.5;
        }
        const std::vector<double> high = IlluminationOf(raised, method);
        for (int j = 0; j < terrain.rows; ++j)
        {
          for (int k = 0; k < i - 2; ++k)
          {
            const std::size_t at = static_cast<std::size_t>(j) * terrain.columns + k;
            ASSERT_LE(high[at], low[at] + 1e-5) << "column " << i << ", sample " << k << ' ' << j;
          }
        }
      }
    });
}

// One row or column has no surface, and so nothing that goes on: it is level ground.
TEST(Border, OfOneRowOrColumnIsLevel)
{
  for (bool row : { false, true })
  {
    for (int offset : { relief::f64::RELIEF_VERTICAL, relief::f64::RELIEF_TANGENT_PLANE })
    {
      HardScene scene;
      scene.terrain = row ? Terrain(20, 1) : Terrain(1, 20);
      scene.terrain.Fill([](double x, double y) { return 0.3 * (x + y); });
      scene.medium = Sunk(1.0, offset);
      scene.lights = { Sun(60.0, 30.0) };
      const HardTracer tracer(scene);
      for (Method method : AllMethods)
      {
        if (tracer.Applies(method, scene.lights.front()))
        {
          for (double d : IlluminationOf(scene, method))
          {
            ASSERT_NEAR(d, 0.5, 1e-6) << NameOf(method) << ", " << NameOfOffset(offset);
          }
        }
      }
    }
  }
}
