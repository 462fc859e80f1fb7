// SPDX-License-Identifier: BSD-3-Clause
//
// The text of a shading program holds what a scene calls for, and nothing else.

#include "ReliefPrograms.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace
{

bool Has(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}

int Count(const std::string& text, const std::string& part)
{
  int count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
  {
    ++count;
  }
  return count;
}

// What a program does, without the functions that it may call.
std::string MainOf(const std::string& text)
{
  return text.substr(text.find("void main()"));
}

const relief::FieldLayout Plain;

}

TEST(ReliefPrograms, TraceHoldsOneKindOfLight)
{
  relief::LightFeatures sun;
  const std::string text = relief::TraceProgram(Plain, sun);
  EXPECT_TRUE(Has(MainOf(text), "reliefExact("));
  EXPECT_FALSE(Has(MainOf(text), "reliefStepCount("));
  EXPECT_FALSE(Has(MainOf(text), "reliefNormal("));
  EXPECT_FALSE(Has(text, "uniform ivec2 lightSample"));
  EXPECT_FALSE(Has(text, "uniform float mediumDensity"));
  EXPECT_FALSE(Has(text, "uniform float mediumFloor"));
  EXPECT_TRUE(Has(text, "medium.useFloor = false;"));
  EXPECT_FALSE(Has(text, "sampler3D"));
  EXPECT_FALSE(Has(text, "RELIEF::"));
  EXPECT_FALSE(Has(MainOf(text), "for")); // no loop over lights

  relief::LightFeatures lamp;
  lamp.positional = lamp.surfaceNormal = lamp.exponential = lamp.floor = true;
  const std::string other = relief::TraceProgram(Plain, lamp);
  EXPECT_TRUE(Has(other, "uniform ivec2 lightSample"));
  EXPECT_TRUE(Has(other, "uniform float mediumDensity"));
  EXPECT_TRUE(Has(other, "uniform float mediumFloor"));
  EXPECT_TRUE(Has(MainOf(other), "reliefNormal("));

  relief::LightFeatures tangent;
  tangent.tangentPlane = true;
  const std::string below = relief::TraceProgram(Plain, tangent);
  EXPECT_TRUE(Has(below, "medium.offset = RELIEF_TANGENT_PLANE;"));
  EXPECT_FALSE(Has(text + other, "medium.offset = RELIEF_TANGENT_PLANE;"));
  EXPECT_FALSE(Has(MainOf(below), "reliefNormal("));

  relief::LightFeatures deep;
  deep.deep = true;
  EXPECT_TRUE(Has(MainOf(relief::TraceProgram(Plain, deep)), "reliefMeasured("));
  EXPECT_FALSE(Has(MainOf(relief::TraceProgram(Plain, deep)), "reliefExact("));

  relief::LightFeatures step;
  step.fixedStep = true;
  EXPECT_TRUE(Has(MainOf(relief::TraceProgram(Plain, step)), "reliefStepCount("));
  EXPECT_FALSE(Has(MainOf(relief::TraceProgram(Plain, step)), "reliefExact("));
}

TEST(ReliefPrograms, GatherHoldsTheEffectsInUse)
{
  relief::SumFeatures sums;
  sums.diffuse = true;
  const std::string diffuse = relief::GatherProgram(Plain, relief::LightFeatures(), sums);
  // Neither directions nor normals, and no ray: the thickness is not even there.
  EXPECT_FALSE(Has(MainOf(diffuse), "reliefSpecularity("));
  EXPECT_FALSE(Has(MainOf(diffuse), "reliefForwardScatter("));
  EXPECT_FALSE(Has(diffuse, "reliefNormal("));
  EXPECT_FALSE(Has(diffuse, "reliefTrace("));
  EXPECT_FALSE(Has(diffuse, "lightVector"));
  EXPECT_EQ(Count(diffuse, "gl_FragData["), 1);

  sums.scatter = true;
  const std::string scatter = relief::GatherProgram(Plain, relief::LightFeatures(), sums);
  EXPECT_TRUE(Has(MainOf(scatter), "reliefForwardScatter("));
  EXPECT_FALSE(Has(scatter, "reliefNormal("));
  EXPECT_FALSE(Has(MainOf(scatter), "lightRay("));
  EXPECT_EQ(Count(scatter, "gl_FragData["), 2);

  relief::LightFeatures lamp;
  lamp.positional = true;
  EXPECT_TRUE(Has(MainOf(relief::GatherProgram(Plain, lamp, sums)), "lightRay("));
  EXPECT_FALSE(Has(MainOf(relief::GatherProgram(Plain, lamp, sums)), "reliefNormal("));

  relief::SumFeatures mirror;
  mirror.specular = true;
  const std::string specular = relief::GatherProgram(Plain, relief::LightFeatures(), mirror);
  EXPECT_TRUE(Has(MainOf(specular), "reliefSpecularity("));
  EXPECT_TRUE(Has(MainOf(specular), "reliefNormal("));
  EXPECT_FALSE(Has(specular, "sampler2D illumination"));
}

TEST(ReliefPrograms, GatherTakesSeveralLights)
{
  relief::SumFeatures sums;
  sums.diffuse = true;
  for (int lights = 1; lights <= relief::MostGathered; ++lights)
  {
    const std::string text = relief::GatherProgram(Plain, relief::LightFeatures(), sums, lights);
    EXPECT_EQ(Count(text, "sampler2D illumination"), lights);
    EXPECT_EQ(Count(MainOf(text), "texelFetch(illumination"), lights);
    EXPECT_TRUE(Has(text, "#define LIGHTS " + std::to_string(lights) + "\n"));
    EXPECT_EQ(Count(text, "gl_FragData["), 1);
    // What does not depend on the surface does not look at it.
    EXPECT_FALSE(Has(MainOf(text), "reliefHeight("));
  }
  sums.specular = true;
  EXPECT_TRUE(
    Has(MainOf(relief::GatherProgram(Plain, relief::LightFeatures(), sums, 2)), "reliefHeight("));
}

TEST(ReliefPrograms, ComposeHoldsTheTermsInUse)
{
  relief::ComposeFeatures features;
  const std::string none = relief::ComposeProgram(Plain, features);
  EXPECT_TRUE(Has(MainOf(none), "reliefBaseTerm("));
  EXPECT_FALSE(Has(MainOf(none), "reliefDiffuseTerm("));
  EXPECT_FALSE(Has(none, "diffuseColor"));
  EXPECT_FALSE(Has(none, "baseColors"));

  features.sums.scatter = true;
  features.first = true;
  const std::string scatter = relief::ComposeProgram(Plain, features);
  EXPECT_TRUE(Has(MainOf(scatter), "reliefScatterTerm("));
  EXPECT_TRUE(Has(scatter, "uniform vec3 diffuseColor;"));
  EXPECT_FALSE(Has(MainOf(scatter), "reliefSpecularTerm("));
  EXPECT_FALSE(Has(scatter, "laterScale"));

  features.first = false;
  features.later = features.diffuseTexture = true;
  const std::string later = relief::ComposeProgram(Plain, features);
  EXPECT_TRUE(Has(later, "laterScale"));
  EXPECT_FALSE(Has(later, "firstScatter"));
  EXPECT_TRUE(Has(later, "uniform sampler2D diffuseColors;"));
  EXPECT_FALSE(Has(later, "uniform vec3 diffuseColor;"));
}

TEST(ReliefPrograms, TilesAreReadWhereThereAreTiles)
{
  relief::FieldLayout tiles;
  tiles.tiledHeights = true;
  const std::string text = relief::TraceProgram(tiles, relief::LightFeatures());
  EXPECT_TRUE(Has(text, "uniform sampler3D reliefHeights"));
  EXPECT_TRUE(Has(text, "uniform sampler2D reliefBlocks"));
}

TEST(ReliefPrograms, LinesAreSelected)
{
  const std::string text = "a\n//RELIEF::If X\nb\n//RELIEF::If Y\nc\n//RELIEF::Else\nd\n"
                           "//RELIEF::End\n//RELIEF::Else\ne\n  //RELIEF::End\nf\n";
  EXPECT_EQ(relief::SelectLines(text, {}), "a\ne\nf\n");
  EXPECT_EQ(relief::SelectLines(text, { "X" }), "a\nb\nd\nf\n");
  EXPECT_EQ(relief::SelectLines(text, { "X", "Y" }), "a\nb\nc\nf\n");
  EXPECT_EQ(relief::SelectLines(text, { "Y" }), "a\ne\nf\n");
  EXPECT_THROW(relief::SelectLines("//RELIEF::If X\n", {}), std::logic_error);
  EXPECT_THROW(relief::SelectLines("//RELIEF::End\n", {}), std::logic_error);
  EXPECT_THROW(relief::SelectLines("//RELIEF::When X\n", {}), std::logic_error);
}
