// SPDX-License-Identifier: BSD-3-Clause
//
// A key changes with what a light's illumination depends on, and with nothing else.

#include "IlluminationKey.h"

#include <gtest/gtest.h>

#include <functional>
#include <vector>

namespace
{

struct Given
{
  std::uint64_t field = 7;
  relief::Scene scene;
  relief::LightPlan light{};

  relief::IlluminationKey Key() const
  {
    return relief::MakeIlluminationKey(this->field, this->scene, this->light);
  }
};

using Changes = std::vector<std::function<void(Given&)>>;

// How many of the changes, each made to a copy, give another key.
std::size_t CountOther(const Given& given, const Changes& changes)
{
  std::size_t other = 0;
  for (const auto& change : changes)
  {
    Given changed = given;
    change(changed);
    other += changed.Key() != given.Key() ? 1 : 0;
    if (changed.Key() == given.Key())
    {
      EXPECT_EQ(relief::IlluminationHash()(changed.Key()), relief::IlluminationHash()(given.Key()));
    }
  }
  return other;
}

Given Exponential()
{
  Given given;
  given.scene.medium.attenuation = relief::f64::RELIEF_EXPONENTIAL;
  given.scene.medium.tolerance = 0.002;
  return given;
}

Given FixedStep()
{
  Given given = Exponential();
  given.scene.integrator = relief::Integrator::FixedStep;
  return given;
}

const Changes Always = {
  [](Given& g) { ++g.field; },
  [](Given& g) { g.light.light.vector.x = 0.5; },
  [](Given& g) { g.light.light.positional = true; },
  [](Given& g) { g.scene.medium.depth = 2.0; },
  [](Given& g) { g.scene.medium.offset = relief::f64::RELIEF_SURFACE_NORMAL; },
  [](Given& g) { g.scene.medium.offset = relief::f64::RELIEF_TANGENT_PLANE; },
};
const Changes Never = {
  [](Given& g) { g.scene.base = g.scene.diffuse = g.scene.specular = glm::dvec3(0.3); },
  [](Given& g) { g.scene.specularCoefficient = g.scene.scatterCoefficient = 0.4; },
  [](Given& g) { g.scene.specularFalloff.power = g.scene.scatterFalloff.lo = -0.5; },
  [](Given& g) { g.light.light.color = glm::dvec3(0.5); },
  [](Given& g) { g.light.light.intensity = g.light.light.weight = 0.5; },
};
const Changes OfTheExactSum = {
  [](Given& g) { g.scene.medium.attenuation = relief::f64::RELIEF_RECIPROCAL; },
  [](Given& g) { g.scene.medium.density = 2.0; },
  [](Given& g) { g.scene.medium.useFloor = true; },
  [](Given& g) { g.scene.medium.tolerance = 0.01; },
  [](Given& g) { g.light.light.toleranceScale = 0.5; },
};

}

TEST(IlluminationKey, ChangesWithWhatDDependsOn)
{
  EXPECT_EQ(CountOther(Exponential(), Always), Always.size());
  EXPECT_EQ(CountOther(FixedStep(), Always), Always.size());
  EXPECT_EQ(CountOther(Exponential(), OfTheExactSum), OfTheExactSum.size());
  EXPECT_EQ(CountOther(FixedStep(), { [](Given& g) { g.scene.steps = 9; } }), 1U);
  EXPECT_NE(Exponential().Key(), FixedStep().Key());
}

TEST(IlluminationKey, StaysWithWhatItDoesNot)
{
  EXPECT_EQ(CountOther(Exponential(), Never), 0U);
  EXPECT_EQ(CountOther(FixedStep(), Never), 0U);
  EXPECT_EQ(CountOther(FixedStep(), OfTheExactSum), 0U);
  EXPECT_EQ(CountOther(Exponential(), { [](Given& g) { g.scene.steps = 9; } }), 0U);
}

TEST(IlluminationKey, LooksAtDensityAndFloorWhereTheyAreInUse)
{
  const Changes density = { [](Given& g) { g.scene.medium.density = 3.0; } };
  const Changes height = { [](Given& g) { g.scene.medium.floorHeight = -5.0; } };
  Given given = Exponential();
  EXPECT_EQ(CountOther(given, density), 1U);
  EXPECT_EQ(CountOther(given, height), 0U);
  given.scene.medium.attenuation = relief::f64::RELIEF_RECIPROCAL;
  given.scene.medium.useFloor = true;
  EXPECT_EQ(CountOther(given, density), 0U);
  EXPECT_EQ(CountOther(given, height), 1U);
}
