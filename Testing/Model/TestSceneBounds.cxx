// SPDX-License-Identifier: BSD-3-Clause
//
// Numbers beyond single precision, and lights as a scene takes them.
#include "SceneBounds.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

using namespace relief;

namespace
{

//------------------------------------------------------------------------------
TEST(SceneBounds, KeepWhatThereIsRoomFor)
{
  Scene scene;
  scene.medium.depth = 1e31;
  scene.medium.floorHeight = -1e37;
  scene.base = glm::dvec3(1e5, 0.0, 1.0);
  const Scene before = scene;
  Bound(scene);
  EXPECT_EQ(scene.medium.depth, before.medium.depth);
  EXPECT_EQ(scene.medium.floorHeight, before.medium.floorHeight);
  EXPECT_EQ(scene.base, before.base);
  EXPECT_EQ(scene.medium.tolerance, before.medium.tolerance);
}

//------------------------------------------------------------------------------
TEST(SceneBounds, HoldBackAllElse)
{
  Scene scene;
  scene.medium.depth = 1e300;
  scene.medium.density = 1e300;
  scene.medium.floorHeight = -1e300;
  scene.medium.tolerance = 7.0;
  scene.specular = glm::dvec3(1e300);
  scene.scatterFalloff = { -1e300, 1e300, 1e300 };
  Bound(scene);
  EXPECT_EQ(scene.medium.depth, LargestLength);
  EXPECT_EQ(scene.medium.density, 1e30);
  EXPECT_EQ(scene.medium.floorHeight, -4e37);
  EXPECT_EQ(scene.medium.tolerance, 1.0);
  EXPECT_EQ(scene.specular, glm::dvec3(1e6));
  EXPECT_EQ(scene.scatterFalloff.lo, -1e30);
  EXPECT_EQ(scene.scatterFalloff.hi, 1e30);
}

//------------------------------------------------------------------------------
TEST(SceneBounds, KeepALampsDirectionAndALightsSign)
{
  Light lamp;
  lamp.positional = true;
  lamp.vector = glm::dvec3(3e100, 0.0, -4e100);
  lamp.intensity = -1e200;
  Bound(lamp);
  EXPECT_NEAR(glm::length(lamp.vector) / LargestLength, 1.0, 1e-12);
  EXPECT_NEAR(lamp.vector.x / LargestLength, 0.6, 1e-12);
  EXPECT_EQ(lamp.intensity, -1e30);
}

//------------------------------------------------------------------------------
TEST(Scene, SamplesDiscsAndKnowsItsFirstSun)
{
  Scene scene;
  Light lamp;
  lamp.positional = true;
  scene.Add(lamp, 0.1, 16);
  EXPECT_EQ(scene.lights.size(), 1u);
  EXPECT_TRUE(scene.sun.empty());
  scene.Add(Light(), 0.1, 16);
  scene.Add(Light(), 0.0, 16);
  EXPECT_EQ(scene.lights.size(), 18u);
  EXPECT_EQ(scene.sun.size(), 16u);
}

}
