// SPDX-License-Identifier: BSD-3-Clause
//
// The catalogue of hard cases, by every method: in range, the result of heights within rounding,
// monotone, symmetric, the same at every scale, and continuous; and scenes of very many lights.
#include "HardCases.h"
#include "HardSceneChecks.h"
#include "ScenePicture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdio>

namespace
{

class HardCaseOf : public testing::TestWithParam<HardCase>
{
};

// The ends of the range, where a scale or a step takes heights or t out of it.
bool IsExtreme(const HardScene& scene)
{
  const double relief = scene.terrain.Greatest();
  return relief > 1e20 || (relief > 0.0 && relief < 1e-20);
}

}

TEST_P(HardCaseOf, Holds)
{
  const HardCase& test = GetParam();
  const HardScene& scene = test.scene;
  SCOPED_TRACE(testing::Message() << test.hard << "\n" << scene);
  const HardTracer tracer(scene);
  if (test.refused)
  {
    EXPECT_NE(tracer.GetRefusal().find(test.refused), std::string::npos) << tracer.GetRefusal();
    return;
  }
  ASSERT_EQ(tracer.GetRefusal(), "");

  BackwardErrors found;
  EXPECT_EQ(CheckRange(scene), "");
  EXPECT_EQ(CheckBackwardError(scene, MostUnits, found), "");
  EXPECT_EQ(CheckMirrors(scene), "");
  EXPECT_EQ(CheckNudges(scene), "");
  EXPECT_EQ(CheckTolerance(scene, 0.002), "");
  EXPECT_EQ(CheckFixedSteps(scene, 256), "");
  if (!IsExtreme(scene))
  {
    EXPECT_EQ(CheckScaling(scene), "");
  }
  const Terrain& terrain = scene.terrain;
  for (int at : { 0, terrain.columns * terrain.rows / 2, terrain.columns * terrain.rows - 1 })
  {
    const double height = terrain.heights[at];
    const double step = std::max(terrain.spacingX, 0.5 * std::abs(height));
    EXPECT_EQ(
      CheckRaisedWall(scene, at % terrain.columns, at / terrain.columns, height + step), "");
  }
  for (Method method : AllMethods)
  {
    if (test.known && tracer.Applies(method, scene.lights[0]))
    {
      const Traced<double> traced = tracer.Trace(method, scene.lights[0]);
      for (std::size_t at = 0; at < traced.d.size(); ++at)
      {
        if (std::isfinite(terrain.heights[at]))
        {
          EXPECT_NEAR(traced.d[at],
            test.known(
              static_cast<int>(at) % terrain.columns, static_cast<int>(at) / terrain.columns),
            1e-6)
            << NameOf(method) << ", sample " << at;
        }
      }
    }
  }
  std::printf("d computed %ld times: heights moved for %ld of them, by at most %g units in single "
              "precision and %g in double; rays moved for %ld\n",
    found.samples, found.moved, found.single, found.reference, found.jumps);
}

INSTANTIATE_TEST_SUITE_P(HardCases, HardCaseOf, testing::ValuesIn(HardCases()),
  [](const testing::TestParamInfo<HardCase>& info)
  {
    std::string name;
    for (const char* c = info.param.name; *c; ++c)
    {
      name += std::isalnum(static_cast<unsigned char>(*c)) ? *c : '_';
    }
    return name;
  });

// A million lights of a weight of a millionth each: in float the sum would stop growing or grow too
// fast, by 3 %.
TEST(HardCases, AMillionLights)
{
  Terrain terrain(3, 2);
  terrain.heights = { 0.0, 1.0, 0.0, 2.0, 0.5, 1.0 };
  Prepared prepared(terrain);
  const relief::Scene one = Plain();
  relief::Scene scene = one;
  scene.lights.assign(1000000, one.lights[0]);
  for (relief::Light& light : scene.lights)
  {
    light.weight = 1e-6;
  }
  const Picture expected = Shade(prepared.Field, one, AllLayers);
  const Picture given = Shade(prepared.Field, scene, AllLayers);
  for (std::size_t k = 0; k < expected.rgba.size(); ++k)
  {
    EXPECT_NEAR(given.rgba[k], expected.rgba[k], 1e-6);
  }
  for (std::size_t k = 0; k < expected.illumination.size(); ++k)
  {
    EXPECT_NEAR(given.illumination[k], expected.illumination[k], 1e-6);
  }
}
