// SPDX-License-Identifier: BSD-3-Clause
//
// What a scene does not call for is not planned.

#include "EffectPlan.h"

#include <gtest/gtest.h>

#include <vector>

namespace
{

class EffectPlan : public testing::Test
{
protected:
  EffectPlan()
    : Samples(64, 1.0f)
  {
    relief::HeightSource<float> source;
    source.data = this->Samples.data();
    source.stepY = 8;
    source.columns = source.rows = 8;
    this->Field.Assign(source, [](int count, const auto& body) { body(0, count); });
    this->Scene.lights.resize(1);
    this->Scene.lights[0].vector = glm::dvec3(0.6, 0.0, 0.8);
  }

  relief::LightPlan Light() const { return this->Plan().lights.at(0); }
  relief::EffectPlan Plan() const { return relief::PlanEffects(this->Field, this->Scene); }

  std::vector<float> Samples;
  relief::HeightField Field;
  relief::Scene Scene;
};

}

TEST_F(EffectPlan, PlansTheEffectsInUse)
{
  EXPECT_TRUE(this->Plan().diffuse);
  EXPECT_FALSE(this->Plan().scatter);
  EXPECT_FALSE(this->Plan().specular);
  EXPECT_TRUE(this->Light().trace);
  this->Scene.scatterCoefficient = 0.5;
  this->Scene.specularCoefficient = 0.5;
  EXPECT_TRUE(this->Plan().diffuse && this->Plan().scatter && this->Plan().specular);
  this->Scene.specular = glm::dvec3(0.0);
  EXPECT_FALSE(this->Plan().specular);
}

TEST_F(EffectPlan, HighlightsAloneNeedNoRay)
{
  this->Scene.specularCoefficient = 1.0;
  EXPECT_TRUE(this->Light().shows);
  EXPECT_FALSE(this->Light().trace);
  EXPECT_FALSE(this->Plan().diffuse);
}

TEST_F(EffectPlan, ResponsesNeedNormals)
{
  const int wanted = relief::NormalsEffect;
  this->Scene.response = relief::f64::RELIEF_COMBINED;
  EXPECT_TRUE(this->Light().matte && this->Light().trace && this->Plan().diffuse);
  EXPECT_EQ(relief::FindEffects(this->Scene, this->Plan()), wanted | relief::IlluminationEffect);
  // Below the horizon there is nothing to trace, and slopes show all the same.
  this->Scene.lights[0].vector = glm::dvec3(0.6, 0.0, -0.8);
  EXPECT_TRUE(this->Light().matte && this->Light().shows && !this->Light().trace);
  // Igor's is of slope and aspect alone.
  this->Scene.lights[0].vector = glm::dvec3(0.6, 0.0, 0.8);
  this->Scene.response = relief::f64::RELIEF_IGOR;
  EXPECT_TRUE(this->Light().matte && !this->Light().trace && this->Plan().diffuse);
  EXPECT_EQ(relief::FindEffects(this->Scene, this->Plan()), wanted);
  EXPECT_EQ(
    relief::FindEffects(this->Scene, this->Plan(), true), wanted | relief::IlluminationEffect);
  this->Scene.diffuse = glm::dvec3(0.0);
  EXPECT_FALSE(this->Light().matte);
  EXPECT_EQ(relief::FindEffects(this->Scene, this->Plan()), 0);
}

TEST_F(EffectPlan, BlackIsNotTraced)
{
  this->Scene.diffuse = glm::dvec3(0.0);
  EXPECT_FALSE(this->Light().trace || this->Light().shows);
  // A texture may be anything but black.
  this->Scene.diffuseTextures.resize(1);
  EXPECT_TRUE(this->Light().trace);
  this->Scene.lights[0].intensity = 0.0;
  EXPECT_FALSE(this->Light().trace || this->Light().shows);
  this->Scene.lights[0].intensity = 1.0;
  this->Scene.lights[0].color = glm::dvec3(0.0);
  EXPECT_FALSE(this->Light().trace || this->Light().shows);
}

TEST_F(EffectPlan, ASunBelowShinesThroughAFloorOnly)
{
  this->Scene.lights[0].vector.z = -0.8;
  EXPECT_FALSE(this->Light().trace);
  this->Scene.medium.useFloor = true;
  EXPECT_TRUE(this->Light().trace);
  this->Scene.medium.useFloor = false;
  this->Scene.lights[0].positional = true;
  EXPECT_TRUE(this->Light().trace);
}

TEST_F(EffectPlan, WhatScattersNoneThisWayIsNotTraced)
{
  this->Scene.scatterCoefficient = 1.0; // from behind only, with the default range
  EXPECT_FALSE(this->Light().trace);
  EXPECT_FALSE(this->Plan().diffuse || this->Plan().scatter);
  this->Scene.scatterFalloff.lo = -1.0;
  EXPECT_TRUE(this->Light().trace);
  EXPECT_TRUE(this->Plan().scatter && !this->Plan().diffuse);
}

TEST_F(EffectPlan, FixedStepsPutASunOnTheSphere)
{
  this->Scene.integrator = relief::Integrator::FixedStep;
  EXPECT_TRUE(this->Light().light.positional);
  EXPECT_TRUE(this->Light().directional);
  EXPECT_FLOAT_EQ(this->Light().vector.x, 0.6f);
}

TEST_F(EffectPlan, EffectsAreThoseOfThePlan)
{
  auto effects = [&](bool traced = false, bool normals = false)
  { return relief::FindEffects(this->Scene, this->Plan(), traced, normals); };
  EXPECT_EQ(effects(), relief::IlluminationEffect);
  EXPECT_EQ(effects(false, true), relief::IlluminationEffect | relief::NormalsEffect);
  // Points that are sunk along normals need them, and nothing else of highlights.
  this->Scene.medium.offset = relief::f64::RELIEF_SURFACE_NORMAL;
  EXPECT_EQ(effects(), relief::IlluminationEffect | relief::NormalsEffect);
  this->Scene.diffuse = glm::dvec3(0.0);
  EXPECT_EQ(effects(), 0);
  EXPECT_EQ(effects(true), relief::IlluminationEffect | relief::NormalsEffect);
  // The way down to the tangent plane is found with the ray.
  for (int offset : { relief::f64::RELIEF_TANGENT_PLANE, relief::f64::RELIEF_VERTICAL })
  {
    this->Scene.medium.offset = offset;
    EXPECT_EQ(effects(true), relief::IlluminationEffect);
  }

  this->Scene.diffuse = glm::dvec3(1.0);
  this->Scene.specularCoefficient = this->Scene.scatterCoefficient = 0.5;
  const int all = relief::IlluminationEffect | relief::NormalsEffect | relief::SpecularEffect |
    relief::ScatterEffect;
  EXPECT_EQ(effects(), all);
  this->Scene.baseTextures.resize(1);
  this->Scene.diffuseTextures.resize(1);
  this->Scene.specularTextures.resize(1);
  EXPECT_EQ(effects(),
    all | relief::BaseTextureEffect | relief::DiffuseTextureEffect | relief::SpecularTextureEffect);
  this->Scene.lights.clear();
  EXPECT_EQ(effects(), relief::BaseTextureEffect);
  this->Scene.specularCoefficient = 1.0;
  EXPECT_EQ(effects(), 0);
}
