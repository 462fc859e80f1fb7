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
