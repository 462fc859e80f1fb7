// SPDX-License-Identifier: BSD-3-Clause
//
// Fields under sampled light: what is traced, how far it errs, and how samplings compare.
#include "ClearSky.h"
#include "LightSampling.h"
#include "RandomScene.h"
#include "ScenePicture.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <iostream>

using namespace relief;

namespace
{

const glm::dmat3 Upright(1.0);

RadianceMap White()
{
  RadianceMap map(1, 1);
  map.Set(0, 0, glm::dvec3(1.0));
  return map;
}

// Out of doors: a clear sky, dim ground, and a sun 0.7 degrees wide with three quarters of the
// light.
RadianceMap Outdoors()
{
  RadianceMap map = ClearSky(Toward(300.0, 40.0), 3.0, 512, 256);
  for (int j = 128; j < 256; ++j)
  {
    for (int i = 0; i < 512; ++i)
    {
      map.Set(i, j, glm::dvec3(0.2, 0.17, 0.12));
    }
  }
  map.Set(150 * 512 / 360, 50 * 256 / 180, glm::dvec3(1e5, 8.75e4, 7e4));
  return map;
}

Terrain Ridges(int columns, int rows)
{
  Terrain terrain(columns, rows, 1.0, 1.0);
  terrain.Fill([](double x, double y)
    { return 3.0 * std::sin(0.4 * x + 0.1 * y) + 2.0 * std::cos(0.3 * y - 0.15 * x); });
  terrain.RoundToSingle();
  return terrain;
}

// Root mean square of the difference of two pictures, all channels.
double Difference(const Picture& a, const Picture& b)
{
  double sum = 0.0;
  for (std::size_t k = 0; k < a.rgba.size(); ++k)
  {
    const double difference = static_cast<double>(a.rgba[k]) - b.rgba[k];
    sum += difference * difference;
  }
  return std::sqrt(sum / (0.75 * static_cast<double>(a.rgba.size())));
}

}

// A level field with the normal offset, for which d is the cosine: through all the shading, the sky
// turns it white.
TEST(EnvironmentShading, WhiteFurnace)
{
  Prepared prepared(Terrain(70, 20));
  Scene scene;
  for (int offset : AllOffsets)
  {
    scene.medium.offset = offset;
    for (EnvironmentSampling sampling :
      { EnvironmentSampling::SolidAngle, EnvironmentSampling::Importance })
    {
      for (int n : { 16, 64, 256, 1024, 4096 })
      {
        scene.lights = SampleEnvironment(White(), sampling, n, Upright);
        const Picture picture = Shade(prepared.Field, scene);
        for (std::size_t k = 0; k < picture.rgba.size(); ++k)
        {
          ASSERT_NEAR(picture.rgba[k], 1.0, 2e-5) << n;
        }
      }
    }
  }
}

// The mean illumination of level ground is 1 under any sky alone: what there is less is hidden.
// Beside a sun the two are weighed by what open level ground has of them.
TEST(EnvironmentShading, LevelGroundSeesAllOfTheSky)
{
  Prepared prepared(Terrain(70, 20));
  Scene scene;
  scene.medium.depth = 0.5;
  for (EnvironmentSampling sampling : { EnvironmentSampling::Uniform,
         EnvironmentSampling::SolidAngle, EnvironmentSampling::Importance })
  {
    for (int n : { 8, 64, 100, 1024 })
    {
      scene.lights = SampleEnvironment(White(), sampling, n, Upright);
      for (Light& light : scene.lights)
      {
        light.intensity = 0.7;
      }
      const Picture sky = Shade(prepared.Field, scene, AllLayers);
      scene.lights.push_back(Sun(200.0, 30.0));
      scene.lights.back().intensity = 0.7;
      const Picture both = Shade(prepared.Field, scene, AllLayers);
      double open = 0.0; // half of it where evenly spread in the polar angle, else 1
      for (const Light& light : scene.lights)
      {
        open += light.positional || light.weight == 1.0 ? 0.0 : light.weight * light.open;
      }
      for (std::size_t k = 0; k < sky.illumination.size(); ++k)
      {
        ASSERT_NEAR(sky.illumination[k], 1.0, 2e-5) << n;
        ASSERT_NEAR(both.illumination[k], (open + 0.5) / (open + 1.0), 2e-5) << n;
      }
    }
  }
}

// Light from below only: the mean is over all of it.
TEST(EnvironmentShading, IlluminationFromBelow)
{
  Prepared prepared(Terrain(70, 20));
  Scene scene;
  scene.medium.useFloor = true;
  scene.medium.floorHeight = -1.0;
  scene.lights = { Sun(0.0, -90.0) };
  scene.lights[0].open = 0.0;
  const Picture picture = Shade(prepared.Field, scene, AllLayers);
  scene.lights[0].open = 1.0;
  const Picture expected = Shade(prepared.Field, scene, AllLayers);
  ExpectEqual(picture, expected);
  EXPECT_GT(picture.illumination[75], 0.5f);
}

TEST(EnvironmentShading, LightsThatCannotShowAreNotTraced)
{
  Prepared prepared(Ridges(40, 30));
  Scene scene;
  scene.lights = SampleEnvironment(White(), EnvironmentSampling::SolidAngle, 256, Upright);
  EXPECT_EQ(Shade(prepared.Field, scene).lightsTraced, 128); // those above the horizon
  scene.medium.useFloor = true;
  scene.medium.floorHeight = -8.0;
  EXPECT_EQ(Shade(prepared.Field, scene).lightsTraced, 256); // light comes from below too
  scene.scatterCoefficient = 1.0;
  EXPECT_EQ(Shade(prepared.Field, scene).lightsTraced, 128); // but all is scattered forward
  scene.specularCoefficient = 1.0;
  EXPECT_EQ(Shade(prepared.Field, scene).lightsTraced, 0);
  scene = Scene();
  scene.lights =
    SampleEnvironment(RadianceMap(3, 3), EnvironmentSampling::SolidAngle, 256, Upright);
  EXPECT_EQ(Shade(prepared.Field, scene).lightsTraced, 0);
}

// The sum errs by the tolerance times the mean radiance at most.
TEST(EnvironmentShading, SharedToleranceBoundsTheSum)
{
  Random random(Seed());
  double worst = 0.0;
  for (int round = 0; round < 25; ++round)
  {
    const RandomScene drawn = MakeRandomScene(random);
    Prepared prepared(drawn.terrain);
    const int columns = random.Integer(1, 12);
    const int rows = random.Integer(1, 8);
    RadianceMap map(columns, rows);
    for (int j = 0; j < rows; ++j)
    {
      for (int i = 0; i < columns; ++i)
      {
        map.Set(i, j,
          glm::dvec3(random.Logarithmic(0.001, 1.0), random.Logarithmic(0.1, 1.0),
            random.Uniform(0.0, 1.0)));
      }
    }
    map.Set(random.Integer(0, columns - 1), random.Integer(0, rows - 1), glm::dvec3(50.0));
    Scene scene;
    scene.medium = drawn.medium;
    scene.lights = SampleEnvironment(
      map, static_cast<EnvironmentSampling>(round % 3), random.Integer(1, 60), Upright);
    scene.medium.tolerance = 0.0;
    const Picture exact = Shade(prepared.Field, scene);
    scene.medium.tolerance = random.Logarithmic(0.003, 0.3);
    const Picture rough = Shade(prepared.Field, scene);
    for (std::size_t k = 0; k < exact.rgba.size(); ++k)
    {
      if (k % 4 == 3)
      {
        continue;
      }
      const double bound =
        scene.medium.tolerance * map.GetMean()[static_cast<glm::length_t>(k % 4)];
      const double error = std::abs(static_cast<double>(exact.rgba[k]) - rough.rgba[k]);
      // Beside rounding: at a shadow's rim the two may see different sides of it.
      ASSERT_LE(error, bound + 2e-4 * (1.0 + exact.rgba[k])) << drawn << ", seed " << Seed();
      worst = std::max(worst, error / bound);
    }
  }
  std::cout << "largest error: " << worst << " of what is allowed" << std::endl;
  EXPECT_GT(worst, 0.01); // the tolerance was used
}

TEST(EnvironmentShading, FewImportantLightsBeatManyEqualOnes)
{
  Prepared prepared(Ridges(48, 40));
  const RadianceMap map = Outdoors();
  Scene scene;
  auto shade = [&](EnvironmentSampling sampling, int samples)
  {
    scene.lights = SampleEnvironment(map, sampling, samples, Upright);
    return Shade(prepared.Field, scene);
  };
  for (EnvironmentSampling reference :
    { EnvironmentSampling::Importance, EnvironmentSampling::SolidAngle })
  {
    const Picture truth = shade(reference, 16384);
    const double important = Difference(shade(EnvironmentSampling::Importance, 64), truth);
    const double equal = Difference(shade(EnvironmentSampling::SolidAngle, 512), truth);
    std::cout << "error of 64 by importance: " << important << ", of 512 by solid angle: " << equal
              << std::endl;
    EXPECT_LT(important, equal);
  }
}

// Behind a long wall the share of the sun's disc that shows is that of a circle cut by a line.
TEST(EnvironmentShading, PenumbraOfADisc)
{
  Terrain terrain(400, 31, 0.25, 1.0); // wide enough for rays that run askew
  const double wall = 20.0;
  terrain.Fill([&](double x, double) { return x >= 90.0 ? wall : 0.0; });
  terrain.RoundToSingle();
  Prepared prepared(terrain);
  Scene scene;
  scene.medium.depth = 0.0;
  const double altitude = 30.0;
  const double diameter = 10.0 * Pi / 180.0;
  scene.lights = SampleDisc(Sun(90.0, altitude), diameter, 2000);
  const Picture picture = Shade(prepared.Field, scene);
  int inPenumbra = 0;
  double previous = 2.0;
  const double sine = std::sin(altitude * Pi / 180.0);
  const double radius = std::sin(0.5 * diameter);
  for (int i = 0; i < 355; ++i)
  {
    const double color = picture.rgba[4 * (15 * 400 + static_cast<std::size_t>(i))];
    // A plane through the wall's upper edge cuts the disc in a line, seen from the sun's direction.
    const double edge = std::atan2(wall, 90.0 - 0.25 * i);
    const double h = glm::clamp(std::sin(edge - altitude * Pi / 180.0) / radius, -1.0, 1.0);
    const double visible = (std::acos(h) - h * std::sqrt(1.0 - h * h)) / Pi;
    // Level ground gets the sine of the altitude, which is a little more where the disc is higher.
    const double higher = 2.0 / (3.0 * Pi) * std::pow(1.0 - h * h, 1.5) * radius;
    EXPECT_NEAR(color, visible * sine + higher * std::sqrt(1.0 - sine * sine), 0.004) << i;
    inPenumbra += visible > 0.0 && visible < 1.0 ? 1 : 0;
    EXPECT_LE(color, previous + 1e-6);
    previous = color;
  }
  EXPECT_GT(inPenumbra, 40);
}

// The parts of a disc below the horizon are below the horizon.
TEST(EnvironmentShading, HalfASun)
{
  Prepared prepared(Terrain(70, 20));
  Scene scene;
  scene.lights = SampleDisc(Sun(45.0, 0.0), 0.2, 500);
  const Picture picture = Shade(prepared.Field, scene);
  EXPECT_NEAR(picture.lightsTraced, 250, 2);
  // The mean over a disc of the height above its middle, where above: 4 r / (3 pi) over half.
  EXPECT_NEAR(picture.rgba[4 * 700], 0.5 * 4.0 * 0.1 / (3.0 * Pi), 3e-4);
}

TEST(ClearSky, IsAnEvenBlueAroundItsSun)
{
  for (double turbidity : { 2.0, 3.0, 6.0, 10.0 })
  {
    for (double altitude : { 0.0, 1.0, 15.0, 45.0, 90.0 })
    {
      const glm::dvec3 sun = Toward(0.0, altitude); // north, a quarter of the way round
      const RadianceMap sky = ClearSky(sun, turbidity, 64, 32);
      EXPECT_EQ(sky.GetCleaned(), 0u);
      double received = 0.0;
      for (const Light& light :
        SampleEnvironment(sky, EnvironmentSampling::SolidAngle, 20000, Upright))
      {
        received += light.weight * Luminance(light.color) * std::max(0.0, light.vector.z);
      }
      EXPECT_NEAR(received, 1.0, 0.005);
      for (int j = 0; j < 32; ++j)
      {
        for (int i = 0; i < 64; ++i)
        {
          const glm::dvec3 color(sky.At(i, j));
          const glm::dvec3 mirrored(sky.At((95 - i) % 64, j));
          EXPECT_LE(glm::distance(color, mirrored), 1e-5 * glm::length(color));
          EXPECT_EQ(Luminance(color) > 0.0, j < 16);
        }
      }
      if (altitude == 15.0)
      {
        EXPECT_GT(
          Luminance(glm::dvec3(sky.At(16, 13))), 2.0 * Luminance(glm::dvec3(sky.At(48, 4))));
      }
      const glm::dvec3 tint = SunColor(sun, turbidity);
      EXPECT_NEAR(Luminance(tint), 1.0, 1e-12);
      EXPECT_TRUE(tint.x > tint.y && tint.y > tint.z && tint.z > 0.0);
    }
  }
  // High and clear, the sky away from the sun is blue; a low sun is redder than a high one.
  const glm::dvec3 blue(ClearSky(Toward(0.0, 60.0), 2.0, 64, 32).At(48, 5));
  EXPECT_TRUE(blue.z > 1.5 * blue.y && blue.y > blue.x);
  EXPECT_GT(SunColor(Toward(0.0, 5.0), 3.0).x, 1.3 * SunColor(Toward(0.0, 60.0), 3.0).x);
  // An odd number of rows: the row that the horizon cuts counts with its part.
  EXPECT_GT(ClearSky(Toward(0.0, 60.0), 3.0, 8, 5).At(0, 2).y, 0.0f);
  EXPECT_EQ(ClearSky(Toward(0.0, 60.0), 3.0, 8, 5).At(0, 3).y, 0.0f);
}
