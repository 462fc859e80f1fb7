// SPDX-License-Identifier: BSD-3-Clause
//
// How bright 8-bit pictures are: exposures that are given, and one that is found.
#include "AutomaticExposure.h"
#include "RandomScene.h"
#include "ScenePicture.h"

#include <algorithm>
#include <cmath>

using namespace relief;

namespace
{

double FindStops(const HeightField& field, const Scene& scene)
{
  AutomaticExposure exposure(field, scene);
  exposure.Measure(0, exposure.GetNumberOfTiles());
  return exposure.GetStops();
}

// How many samples with data have at least a code in their largest component.
int CountFrom(const Picture& picture, int code)
{
  int count = 0;
  for (std::size_t k = 0; k < picture.rgba8.size(); k += 4)
  {
    const unsigned char* rgba = picture.rgba8.data() + k;
    count += rgba[3] != 0 && *std::max_element(rgba, rgba + 3) >= code;
  }
  return count;
}

}

// Codes are those of the multiplied colour, and nothing else changes.
TEST(Exposure, MultipliesWhatIsEncodedAndNothingElse)
{
  Prepared prepared(Hills());
  Scene scene = Rich();
  const Picture before = Shade(prepared.Field, scene, AllLayers);
  for (double stops : { -20.0, -3.3, -1.0, 0.5, 2.0, 20.0 })
  {
    scene.exposure = stops;
    const Picture after = Shade(prepared.Field, scene, AllLayers);
    for (std::size_t k = 0; k < after.rgba.size(); ++k)
    {
      const double code = k % 4 == 3 ? 255.0 * after.rgba[k]
                                     : 255.0 * f64::reliefEncode(std::exp2(stops) * after.rgba[k]);
      ASSERT_NEAR(after.rgba8[k], code, 0.5 + 1e-3) << stops;
    }
    Picture same = after;
    same.rgba8 = before.rgba8;
    ExpectEqual(same, before);
  }
}

// Less than 1 % is pure white, and yet the brightest are not far from it: whatever the intensity,
// the number of lights and their colours.
TEST(Exposure, AutomaticUsesTheRange)
{
  const std::uint64_t seed = Seed();
  Random random(seed);
  for (int round = 0; round < 40; ++round)
  {
    const RandomScene drawn = MakeRandomScene(random);
    Prepared prepared(drawn.terrain, round % 2 == 0);
    Scene scene = Rich();
    scene.medium = drawn.medium;
    scene.lights = { drawn.light, Sun(random.Uniform(0.0, 360.0), random.Uniform(20.0, 90.0)) };
    const double intensity = random.Logarithmic(1e-3, 1e3);
    for (Light& light : scene.lights)
    {
      light.intensity = intensity;
    }
    if (round % 3 == 0)
    {
      scene.specularCoefficient = 0.0;
      scene.base = glm::dvec3(0.0);
    }
    SCOPED_TRACE(::testing::Message() << "seed " << seed << ", round " << round);
    scene.exposure = FindStops(prepared.Field, scene);
    const Picture picture = Shade(prepared.Field, scene, AllLayers);
    EXPECT_LE(CountFrom(picture, 255), 0.005 * CountFrom(picture, 0) + 1.0);
    EXPECT_GE(CountFrom(picture, 253), 1);
  }
}

// Also in a field of which a part is looked at only.
TEST(Exposure, AutomaticLooksAtTheWholeOfALargeField)
{
  Terrain terrain(2000, 1400);
  // Steeper from side to side, so that no corner of it tells of the rest.
  terrain.Fill([](double x, double y) { return 0.004 * x * std::sin(0.3 * x + 0.2 * y); });
  terrain.RoundToSingle();
  Prepared prepared(terrain);
  Scene scene = Plain();
  scene.lights[0].intensity = 7.0;
  AutomaticExposure exposure(prepared.Field, scene);
  EXPECT_LE(exposure.GetNumberOfTiles() * SweepThickness::TileSize, AutomaticExposure::MostSamples);
  EXPECT_GE(
    exposure.GetNumberOfTiles() * SweepThickness::TileSize, AutomaticExposure::MostSamples / 8);
  // In any order, in any pieces.
  for (int k = exposure.GetNumberOfTiles() - 1; k >= 0; --k)
  {
    exposure.Measure(k, k + 1);
  }
  scene.exposure = exposure.GetStops();
  EXPECT_EQ(scene.exposure, FindStops(prepared.Field, scene));
  const Picture picture = Shade(prepared.Field, scene, AllLayers);
  EXPECT_LE(CountFrom(picture, 255), 2000 * 1400 / 100);
  EXPECT_GE(CountFrom(picture, 250), 2000 * 1400 / 200);
}

TEST(Exposure, AutomaticOfNothingToSee)
{
  Terrain level(70, 40);
  Prepared prepared(level);
  Scene scene = Plain();
  scene.lights[0].intensity = 0.0;
  EXPECT_EQ(FindStops(prepared.Field, scene), 0.0);
  scene.lights[0] = Sun(0.0, -10.0);
  EXPECT_EQ(FindStops(prepared.Field, scene), 0.0);
  level.Fill([](double, double) { return NoData; });
  Prepared empty(level);
  EXPECT_EQ(FindStops(empty.Field, Plain()), 0.0);
  // What is too bright or too dark for 20 stops is shown at 20.
  scene = Plain();
  scene.lights[0].intensity = 1e9;
  EXPECT_EQ(FindStops(prepared.Field, scene), -20.0);
  scene.lights[0].intensity = 1e-9;
  EXPECT_EQ(FindStops(prepared.Field, scene), 20.0);
}
