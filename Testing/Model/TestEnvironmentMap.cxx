// SPDX-License-Identifier: BSD-3-Clause
//
// Environments before they are sampled: which way their images lie, how they turn, where their
// lights stand.
#include "EnvironmentMap.h"

#include <glm/geometric.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <vector>

using namespace relief;

namespace
{

//------------------------------------------------------------------------------
TEST(EnvironmentMap, BeginsWithTheZenith)
{
  const std::vector<float> grey = { 1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f };
  ColorTexture image;
  image.texels = grey.data();
  image.type = ColorTexture::Type::Float;
  image.components = 1;
  image.columns = 2;
  image.rows = 3;
  const RadianceMap first = MapOf(image, true);
  const RadianceMap last = MapOf(image, false);
  EXPECT_EQ(first.At(1, 0).x, 2.0f);
  EXPECT_EQ(first.At(0, 2).x, 5.0f);
  EXPECT_EQ(last.At(1, 0).x, 6.0f);
  EXPECT_EQ(last.At(0, 2).x, 1.0f);
}

//------------------------------------------------------------------------------
TEST(EnvironmentMap, OfAWhiteDomeIsWhiteAboveAndBlackBelow)
{
  const RadianceMap dome = WhiteDome();
  EXPECT_EQ(dome.GetMean(), glm::dvec3(0.5));
  EXPECT_EQ(dome.At(0, 0), glm::vec3(1.0f));
}

//------------------------------------------------------------------------------
TEST(EnvironmentMap, TurnsFromEastToNorthAndLeansToTheSouth)
{
  EXPECT_EQ(TurnOf(0.0, 0.0), glm::dmat3(1.0));
  EXPECT_EQ(TurnOf(90.0, 0.0) * glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0));
  EXPECT_EQ(TurnOf(0.0, 90.0) * glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.0, -1.0, 0.0));
  const glm::dmat3 turn = TurnOf(33.0, -71.0);
  EXPECT_NEAR(
    glm::length(turn * glm::dvec3(0.1, -0.7, 0.4)), glm::length(glm::dvec3(0.1, -0.7, 0.4)), 1e-14);
}

//------------------------------------------------------------------------------
TEST(EnvironmentMap, StandsAboutTheMiddleOfTheField)
{
  const std::vector<float> heights = { 0.0f, 8.0f, 2.0f, 4.0f, 6.0f, 1.0f };
  HeightSource<float> source;
  source.data = heights.data();
  source.columns = 3;
  source.stepY = 3;
  source.rows = 2;
  source.spacingX = 10.0;
  source.spacingY = 20.0;
  HeightField field;
  ASSERT_EQ(field.Assign(source, [](int count, const auto& body) { body(0, count); }), "");
  Light east;
  east.vector = glm::dvec3(1.0, 0.0, 0.0);
  std::vector<Light> lights = { east };
  PlaceAround(field, std::numeric_limits<double>::infinity(), lights);
  EXPECT_FALSE(lights.front().positional);
  PlaceAround(field, 100.0, lights);
  EXPECT_TRUE(lights.front().positional);
  EXPECT_EQ(lights.front().vector, glm::dvec3(110.0, 10.0, 4.0));
}

}
