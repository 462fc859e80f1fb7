// SPDX-License-Identifier: BSD-3-Clause
//
// A planted fault is found in its smallest form, and a scene prints as the code that builds it.
#include "HardSceneShrinking.h"
#include "RandomHardScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

using namespace relief::f64;

namespace
{
std::string Print(const HardScene& scene)
{
  std::ostringstream text;
  text << scene;
  return text.str();
}

// The same but for white space.
std::string Packed(std::string text)
{
  text.erase(std::remove_if(text.begin(), text.end(), [](char c) { return c == ' ' || c == '\n'; }),
    text.end());
  return text;
}
}

// Builds a scene by code, and holds that code as text.
#define WRITTEN(...)                                                                               \
  __VA_ARGS__                                                                                      \
  const std::string written = #__VA_ARGS__;

TEST(HardSceneShrinking, PrintsAsCode)
{
  // clang-format off
  WRITTEN(
    HardScene scene;
    scene.terrain = Terrain(3, 2, 1.0, 0.1);
    scene.terrain.heights = { 0.0, 1.5, NoData,
      -Infinite, 0.30000000000000004, 1e+30 };
    scene.medium = { 1e-310, RELIEF_SURFACE_NORMAL, RELIEF_EXPONENTIAL, 2.5, true, -3.0, 0.002 };
    scene.lights = { Sun(-45.0, 30.0),
      Lamp(1.0, 2.0, 3.25),
      Directional({ 0.6, 0.0, 0.8 }) };
  )
  // clang-format on
  EXPECT_EQ(Packed(Print(scene)), Packed(written));
}

// A fault that needs a spike beside a hole, a lamp and a floor, among other things that it does not
// need.
TEST(HardSceneShrinking, FindsThePlantedFault)
{
  auto fails = [](const HardScene& scene)
  {
    const Terrain& terrain = scene.terrain;
    bool spike = false;
    for (int j = 0; j < terrain.rows; ++j)
    {
      for (int i = 0; i + 1 < terrain.columns; ++i)
      {
        spike = spike || (terrain.At(i, j) > 3.7 && std::isnan(terrain.At(i + 1, j)));
      }
    }
    return spike && scene.medium.useFloor &&
      std::any_of(scene.lights.begin(), scene.lights.end(),
        [](const relief::Light& light) { return light.positional && light.vector.x > 0.5; });
  };
  Random random(Seed());
  int tried = 0;
  for (int number = 0; tried < 10 && number < 100000; ++number)
  {
    const HardScene scene = MakeRandomHardScene(random);
    if (fails(scene))
    {
      ++tried;
      HardScene expected;
      expected.terrain = Terrain(2, 1);
      expected.terrain.heights = { 4.0, NoData };
      expected.medium = WithFloor(Sunk(scene.medium.depth > 0.0 ? 1.0 : 0.0), 0.0);
      expected.lights = { Lamp(1.0, 0.0, 0.0) };
      EXPECT_EQ(Print(Shrink(scene, fails)), Print(expected)) << scene;
    }
  }
  EXPECT_EQ(tried, 10);
}

// Of numbers that have no short decimal form, too.
TEST(HardSceneShrinking, Ends)
{
  HardScene scene;
  scene.terrain = Terrain(2, 2);
  scene.terrain.heights = { 1e30, -35.280296325683594, 3e-38, 0.30000000000000004 };
  scene.medium = Sunk(1e-310);
  scene.medium.density = 1e30;
  scene.lights = { Lamp(-1e9, 1e-9, 0.99999999999999989) };
  const HardScene small = Shrink(scene,
    [](const HardScene& candidate)
    {
      const std::vector<double>& heights = candidate.terrain.heights;
      return candidate.medium.density >= 4e29 && candidate.medium.depth < 1e-309 &&
        candidate.lights[0].vector.x < -3e8 && heights.size() == 4 && heights[1] <= -35.28;
    });
  EXPECT_EQ(small.medium.density, 5e29);
  EXPECT_EQ(small.terrain.heights[1], -36.0);
}
