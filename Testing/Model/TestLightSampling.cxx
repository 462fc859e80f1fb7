// SPDX-License-Identifier: BSD-3-Clause
//
// Environments and discs as lights: energy, known sums, symmetries, and what must not come out.
#include "LightSampling.h"
#include "TestTerrain.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <iostream>

using namespace relief;

namespace
{

constexpr EnvironmentSampling Samplings[] = { EnvironmentSampling::Uniform,
  EnvironmentSampling::SolidAngle, EnvironmentSampling::Importance };
const glm::dmat3 Upright(1.0);

glm::dmat3 AboutZ(double degrees)
{
  const double a = degrees * Pi / 180.0;
  return glm::dmat3(std::cos(a), std::sin(a), 0.0, -std::sin(a), std::cos(a), 0.0, 0.0, 0.0, 1.0);
}

glm::dmat3 AboutX(double degrees)
{
  const double a = degrees * Pi / 180.0;
  return glm::dmat3(1.0, 0.0, 0.0, 0.0, std::cos(a), std::sin(a), 0.0, -std::sin(a), std::cos(a));
}

RadianceMap MakeMap(int columns, int rows, const std::function<glm::dvec3(int, int)>& radiance)
{
  RadianceMap map(columns, rows);
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      map.Set(i, j, radiance(i, j));
    }
  }
  return map;
}

RadianceMap White()
{
  return MakeMap(8, 4, [](int, int) { return glm::dvec3(1.0); });
}

RadianceMap Noise(Random& random, int columns, int rows)
{
  return MakeMap(columns, rows,
    [&](int, int)
    {
      return glm::dvec3(
        random.Uniform(0.0, 1.0), random.Uniform(0.0, 2.0), random.Uniform(0.0, 0.5));
    });
}

glm::dvec3 Energy(const std::vector<Light>& lights)
{
  glm::dvec3 sum(0.0);
  for (const Light& light : lights)
  {
    sum += light.weight * light.color;
  }
  return sum;
}

// What a plane of that normal receives.
double Received(const std::vector<Light>& lights, const glm::dvec3& normal)
{
  double sum = 0.0;
  for (const Light& light : lights)
  {
    sum += light.weight * light.color.y * std::max(0.0, glm::dot(normal, light.vector));
  }
  return sum;
}

// What the Uniform lights sum to: the mean over rows of patches of equal polar angle, each the mean
// of its texels, weighted by their solid angle.
glm::dvec3 UniformSum(const RadianceMap& map, int samples)
{
  const int rows = static_cast<int>(std::lround(std::sqrt(samples)));
  glm::dvec3 sum(0.0);
  for (int row = 0; row < rows; ++row)
  {
    const int first = samples * row / rows;
    const int end = samples * (row + 1) / rows;
    const double from = Pi * first / samples;
    const double to = Pi * end / samples;
    glm::dvec3 band(0.0);
    for (int j = 0; j < map.GetRows(); ++j)
    {
      const double top = std::max(from, Pi * j / map.GetRows());
      const double bottom = std::min(to, Pi * (j + 1) / map.GetRows());
      for (int i = 0; bottom > top && i < map.GetColumns(); ++i)
      {
        band += glm::dvec3(map.At(i, j)) * ((std::cos(top) - std::cos(bottom)) / map.GetColumns());
      }
    }
    sum += band / (std::cos(from) - std::cos(to)) * (1.0 * (end - first) / samples);
  }
  return sum;
}

// Whether two sets hold the same lights but for rounding, in any order.
bool SameLights(std::vector<Light> a, const std::vector<Light>& b)
{
  if (a.size() != b.size())
  {
    return false;
  }
  for (const Light& light : b)
  {
    auto same = std::find_if(a.begin(), a.end(),
      [&](const Light& other)
      {
        return glm::distance(light.vector, other.vector) < 1e-9 &&
          glm::distance(light.color, other.color) < 1e-9 &&
          std::abs(light.weight - other.weight) < 1e-9;
      });
    if (same == a.end())
    {
      return false;
    }
    a.erase(same);
  }
  return true;
}

std::vector<Light> Turned(std::vector<Light> lights, const glm::dmat3& turn)
{
  for (Light& light : lights)
  {
    light.vector = turn * light.vector;
  }
  return lights;
}

}

TEST(LightSampling, KeepsTheMapsEnergy)
{
  Random random(Seed());
  const int sizes[][2] = { { 1, 1 }, { 2, 1 }, { 1, 2 }, { 7, 5 }, { 33, 17 }, { 64, 32 } };
  for (const auto& size : sizes)
  {
    for (bool spike : { false, true })
    {
      RadianceMap map = Noise(random, size[0], size[1]);
      if (spike)
      {
        map.Set(random.Integer(0, size[0] - 1), random.Integer(0, size[1] - 1),
          glm::dvec3(1e6, 1e6, 1e6));
      }
      // The integral, texel by texel: solid angle is azimuth times the difference of cosines.
      glm::dvec3 integral(0.0);
      for (int j = 0; j < size[1]; ++j)
      {
        const double height = std::cos(Pi * j / size[1]) - std::cos(Pi * (j + 1) / size[1]);
        for (int i = 0; i < size[0]; ++i)
        {
          integral += glm::dvec3(map.At(i, j)) * (height * 2.0 * Pi / size[0]);
        }
      }
      const glm::dvec3 mean = map.GetMean() - integral / (4.0 * Pi);
      EXPECT_LE(glm::length(mean), 1e-12 * glm::length(integral));
      const glm::dmat3 turn =
        AboutX(random.Uniform(-180.0, 180.0)) * AboutZ(spike ? random.Uniform(-180.0, 180.0) : 0.0);
      for (EnvironmentSampling sampling : Samplings)
      {
        for (int n : { 1, 2, 3, 4, 5, 6, 7, 8, 9, 13, 16, 31, 64, 100, 257, 1024, 4099 })
        {
          const glm::dvec3 expected =
            sampling == EnvironmentSampling::Uniform ? UniformSum(map, n) : integral / Pi;
          const std::vector<Light> lights = SampleEnvironment(map, sampling, n, turn);
          EXPECT_EQ(static_cast<int>(lights.size()), n);
          const glm::dvec3 error = Energy(lights) - expected;
          EXPECT_LE(glm::length(error), 1e-9 * glm::length(expected))
            << size[0] << " x " << size[1] << ", " << n << " samples, sampling "
            << static_cast<int>(sampling) << ", seed " << Seed();
          for (const Light& light : lights)
          {
            EXPECT_NEAR(glm::length(light.vector), 1.0, 1e-12);
          }
        }
      }
    }
  }
}

// Level ground under a white sky is white at every number; the thesis's sum is what its formula
// gives: with R rows, 1 / R times the sum of the cosines of the polar angles above the horizon.
TEST(LightSampling, WhiteFurnaceOnLevelGround)
{
  const glm::dvec3 up(0.0, 0.0, 1.0);
  for (int n = 1; n <= 300; ++n)
  {
    for (EnvironmentSampling sampling :
      { EnvironmentSampling::SolidAngle, EnvironmentSampling::Importance })
    {
      EXPECT_NEAR(Received(SampleEnvironment(White(), sampling, n, AboutZ(25.0)), up), 1.0, 1e-12)
        << n;
    }
  }
  for (int rows = 1; rows <= 64; ++rows)
  {
    const double closed = rows % 2 == 0 ? 1.0 / (2.0 * rows * std::sin(Pi / (2.0 * rows)))
                                        : 1.0 / (2.0 * rows * std::tan(Pi / (2.0 * rows)));
    const std::vector<Light> lights =
      SampleEnvironment(White(), EnvironmentSampling::Uniform, rows * rows, Upright);
    EXPECT_NEAR(Received(lights, up), closed, 1e-12) << rows;
  }
}

// On slopes the sum converges. The error of a patch's middle is of second order in its width, which
// is as 1 / sqrt(N), but where the slope's own horizon cuts patches it is of first order, in
// 1 / sqrt(N) of all patches: 1 / N over all, or better where errors cancel.
TEST(LightSampling, WhiteFurnaceOnSlopesConverges)
{
  for (EnvironmentSampling sampling :
    { EnvironmentSampling::SolidAngle, EnvironmentSampling::Importance })
  {
    std::vector<double> errors;
    for (int n = 16; n <= 4096; n *= 4)
    {
      const std::vector<Light> lights = SampleEnvironment(White(), sampling, n, Upright);
      double sum = 0.0;
      for (int k = 0; k < 200; ++k)
      {
        const double slope = 0.5 * Pi * (k + 0.5) / 200.0;
        const double aspect = 2.4 * k; // all around
        const glm::dvec3 normal(
          std::sin(slope) * std::cos(aspect), std::sin(slope) * std::sin(aspect), std::cos(slope));
        sum += std::abs(Received(lights, normal) - 1.0);
      }
      errors.push_back(sum / 200.0);
      std::cout << "sampling " << static_cast<int>(sampling) << ", " << n << " samples: error "
                << errors.back() << std::endl;
      EXPECT_LT(errors.back(), 1.0 / n);
    }
    EXPECT_LT(errors.back(), errors.front() * 16.0 / 4096.0 * 2.0);
  }
}

TEST(LightSampling, TurningASymmetricMapChangesNothing)
{
  Random random(Seed());
  for (int fold : { 2, 3, 4, 5, 6, 7, 12 })
  {
    const RadianceMap sector = Noise(random, 6, 20);
    const RadianceMap map =
      MakeMap(6 * fold, 20, [&](int i, int j) { return glm::dvec3(sector.At(i % 6, j)); });
    for (EnvironmentSampling sampling : Samplings)
    {
      for (int n : { 5, 16, 64, 100 })
      {
        for (const glm::dmat3& lean : { Upright, AboutX(35.0) })
        {
          const std::vector<Light> before = SampleEnvironment(map, sampling, n, lean);
          for (int times : { 1, fold - 1, -1 })
          {
            EXPECT_TRUE(SameLights(
              before, SampleEnvironment(map, sampling, n, lean * AboutZ(360.0 * times / fold))))
              << fold << "-fold, sampling " << static_cast<int>(sampling) << ", " << n
              << " samples, seed " << Seed();
          }
        }
      }
    }
  }
}

// A quarter turn of the map is a quarter turn of its lights, and so is a mirror image.
TEST(LightSampling, LightsTurnWithTheMap)
{
  Random random(Seed());
  const RadianceMap map = Noise(random, 24, 12);
  const glm::dmat3 mirror(-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
  for (EnvironmentSampling sampling : Samplings)
  {
    for (int n : { 16, 64, 256 })
    {
      for (double tilt : { 0.0, 20.0 })
      {
        const glm::dmat3 lean = AboutX(tilt) * AboutZ(11.0);
        const std::vector<Light> lights = SampleEnvironment(map, sampling, n, lean);
        EXPECT_TRUE(SameLights(
          Turned(lights, AboutZ(90.0)), SampleEnvironment(map, sampling, n, AboutZ(90.0) * lean)))
          << static_cast<int>(sampling) << ' ' << n << ' ' << tilt;
        EXPECT_TRUE(
          SameLights(Turned(lights, mirror), SampleEnvironment(map, sampling, n, mirror * lean)));
      }
    }
  }
}

// Where the light is, samples are: a map of one bright texel has all its light from there, and
// columns run counter-clockwise from +x, rows down from +z.
TEST(LightSampling, LightComesFromItsTexel)
{
  const int at[][2] = { { 0, 0 }, { 2, 1 }, { 5, 2 }, { 11, 5 }, { 8, 3 } };
  for (const auto& texel : at)
  {
    RadianceMap map(12, 6);
    map.Set(texel[0], texel[1], glm::dvec3(3.0, 2.0, 1.0));
    for (int n : { 1, 2, 9, 64 })
    {
      const std::vector<Light> lights =
        SampleEnvironment(map, EnvironmentSampling::Importance, n, Upright);
      ASSERT_GE(lights.size(), 1u);
      EXPECT_LE(static_cast<int>(lights.size()), n);
      for (const Light& light : lights)
      {
        double azimuth = std::atan2(light.vector.y, light.vector.x) / (2.0 * Pi) * 12.0;
        azimuth += azimuth < 0.0 ? 12.0 : 0.0;
        const double polar = std::acos(light.vector.z) / Pi * 6.0;
        EXPECT_TRUE(azimuth >= texel[0] - 1e-9 && azimuth <= texel[0] + 1 + 1e-9) << azimuth;
        if (n > 1)
        {
          EXPECT_TRUE(polar >= texel[1] - 1e-9 && polar <= texel[1] + 1 + 1e-9) << polar;
        }
      }
    }
  }
}

TEST(LightSampling, CleansWhatIsNoRadiance)
{
  const double infinite = std::numeric_limits<double>::infinity();
  RadianceMap map(4, 2);
  map.Set(0, 0, glm::dvec3(NoData, 1.0, 1.0));
  map.Set(1, 0, glm::dvec3(1.0, infinite, 1.0));
  map.Set(2, 0, glm::dvec3(1.0, 2.0, -infinite));
  map.Set(3, 0, glm::dvec3(0.5, -2.0, 0.25));
  map.Set(0, 1, glm::dvec3(1e300, 0.0, 0.0));
  map.Set(1, 1, glm::dvec3(RadianceMap::Largest, 0.0, 0.0));
  map.Set(2, 1, glm::dvec3(0.0, 0.0, 1e-40));
  EXPECT_EQ(map.GetCleaned(), 5u);
  for (int black : { 0, 1, 2 })
  {
    EXPECT_EQ(glm::dvec3(map.At(black, 0)), glm::dvec3(0.0));
  }
  EXPECT_EQ(glm::dvec3(map.At(3, 0)), glm::dvec3(0.5, 0.0, 0.25));
  for (EnvironmentSampling sampling : Samplings)
  {
    for (int n : { 1, 2, 8, 64, 999 })
    {
      const std::vector<Light> lights = SampleEnvironment(map, sampling, n, Upright);
      for (const Light& light : lights)
      {
        const glm::vec3 radiance(light.color * light.weight);
        EXPECT_TRUE(std::isfinite(radiance.x + radiance.y + radiance.z));
        EXPECT_TRUE(std::isfinite(light.toleranceScale) && light.toleranceScale > 0.0);
        EXPECT_NEAR(glm::length(light.vector), 1.0, 1e-12);
        EXPECT_TRUE(light.color.x >= 0.0 && light.color.y >= 0.0 && light.color.z >= 0.0);
      }
    }
  }
  // A black map has no light worth a ray.
  for (EnvironmentSampling sampling : Samplings)
  {
    EXPECT_EQ(Energy(SampleEnvironment(RadianceMap(4, 2), sampling, 16, Upright)), glm::dvec3(0.0));
  }
}

// The weighted sum of all tolerances is the mean radiance, in the channel that has most of it.
TEST(LightSampling, ToleranceIsSharedOut)
{
  Random random(Seed());
  for (EnvironmentSampling sampling : Samplings)
  {
    const RadianceMap map = Noise(random, 16, 8);
    glm::dvec3 error(0.0);
    double least = std::numeric_limits<double>::infinity();
    double most = 0.0;
    for (const Light& light : SampleEnvironment(map, sampling, 50, Upright))
    {
      error += light.weight * light.color * light.toleranceScale;
      least = std::min(least, light.toleranceScale);
      most = std::max(most, light.toleranceScale);
    }
    error /= map.GetMean();
    const double largest = std::max({ error.x, error.y, error.z });
    EXPECT_LE(largest, 1.0 + 1e-12);
    EXPECT_GT(largest, 0.6);
    EXPECT_EQ(least < most, sampling == EnvironmentSampling::Importance);
  }
  // A light in one channel only: exactly its mean.
  RadianceMap red(2, 2);
  red.Set(0, 0, glm::dvec3(2.0, 0.0, 0.0));
  for (EnvironmentSampling sampling : Samplings)
  {
    double error = 0.0;
    for (const Light& light : SampleEnvironment(red, sampling, 32, Upright))
    {
      error += light.weight * light.color.x * light.toleranceScale;
    }
    EXPECT_NEAR(error, red.GetMean().x, 1e-12);
  }
}

// Nothing that rays depend on changes while the map turns about its axis, however it leans.
TEST(LightSampling, TurningKeepsDirectionsAndTolerances)
{
  Random random(Seed());
  const RadianceMap map = Noise(random, 16, 8);
  for (EnvironmentSampling sampling :
    { EnvironmentSampling::Uniform, EnvironmentSampling::SolidAngle })
  {
    for (double lean : { 0.0, 0.4 })
    {
      const glm::dmat3 leaning(
        1.0, 0.0, 0.0, 0.0, std::cos(lean), std::sin(lean), 0.0, -std::sin(lean), std::cos(lean));
      const std::vector<Light> still = SampleEnvironment(map, sampling, 50, leaning);
      int differ = 0;
      for (int round = 0; round < 100; ++round)
      {
        const double turn = random.Uniform(-10.0, 10.0);
        const glm::dmat3 turning(
          std::cos(turn), std::sin(turn), 0.0, -std::sin(turn), std::cos(turn), 0.0, 0.0, 0.0, 1.0);
        const std::vector<Light> turned = SampleEnvironment(map, sampling, 50, leaning * turning);
        ASSERT_EQ(turned.size(), still.size());
        for (std::size_t k = 0; k < still.size(); ++k)
        {
          differ += turned[k].vector != still[k].vector;
          EXPECT_EQ(turned[k].toleranceScale, still[k].toleranceScale);
          EXPECT_EQ(turned[k].weight, still[k].weight);
        }
      }
      EXPECT_EQ(differ, 0);
    }
  }
}

TEST(LightSampling, OnASphere)
{
  const glm::dvec3 center(3.0, 4.0, 5.0);
  std::vector<Light> lights =
    SampleEnvironment(White(), EnvironmentSampling::SolidAngle, 40, Upright);
  const std::vector<Light> directions = lights;
  PlaceOnSphere(lights, center, 7.0);
  for (std::size_t k = 0; k < lights.size(); ++k)
  {
    EXPECT_TRUE(lights[k].positional);
    EXPECT_LE(glm::distance(lights[k].vector, center + 7.0 * directions[k].vector), 1e-12);
  }
}

// A disc's lights have equal shares of it: of its area within any radius, of its weight, and
// around its middle.
TEST(LightSampling, Disc)
{
  for (const Light& axis : { Sun(315.0, 30.0), Sun(77.0, 0.0), Sun(0.0, 90.0), Sun(10.0, -5.0) })
  {
    Light sun = axis;
    sun.color = glm::dvec3(1.0, 0.5, 0.25);
    sun.intensity = 3.0;
    sun.weight = 0.5;
    EXPECT_EQ(SampleDisc(sun, 0.0, 16).size(), 1u);
    EXPECT_EQ(SampleDisc(sun, 0.1, 1)[0].vector, sun.vector);
    for (double diameter : { 0.0093, 0.2, 1.5 })
    {
      for (int n : { 2, 3, 4, 16, 101, 1000 })
      {
        const std::vector<Light> lights = SampleDisc(sun, diameter, n);
        ASSERT_EQ(static_cast<int>(lights.size()), n);
        glm::dvec3 mean(0.0);
        double weight = 0.0;
        int inner = 0;
        const double half = (1.0 - std::cos(0.5 * diameter)) / 2.0; // of its solid angle
        for (const Light& light : lights)
        {
          EXPECT_NEAR(glm::length(light.vector), 1.0, 1e-12);
          const double away = glm::distance(light.vector, sun.vector); // a chord
          EXPECT_LE(away, 2.0 * std::sin(0.25 * diameter));
          inner += 0.5 * away * away <= half ? 1 : 0;
          mean += light.vector;
          weight += light.weight;
          EXPECT_EQ(light.color, sun.color);
          EXPECT_EQ(light.intensity, sun.intensity);
        }
        EXPECT_LE(glm::distance(glm::normalize(mean), sun.vector), 1e-12);
        EXPECT_NEAR(weight, sun.weight, 1e-12);
        EXPECT_NEAR(inner, 0.5 * n, 1.0);
      }
    }
  }
}
