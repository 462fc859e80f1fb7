// SPDX-License-Identifier: BSD-3-Clause
//
// What presets bring, and what they stand on: directions of angles.
#include "Angles.h"
#include "LightPresets.h"
#include "ReliefModel.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace relief;

namespace
{

//------------------------------------------------------------------------------
TEST(Angles, AreExactAtRightAngles)
{
  for (int turn = -8; turn <= 8; ++turn)
  {
    const double sines[] = { 0.0, 1.0, 0.0, -1.0 };
    EXPECT_EQ(SinDegrees(90.0 * turn), sines[(turn + 8) % 4]);
    EXPECT_EQ(CosDegrees(90.0 * turn), sines[(turn + 9) % 4]);
  }
  for (double degrees = -720.0; degrees < 720.0; degrees += 7.3)
  {
    EXPECT_NEAR(SinDegrees(degrees), std::sin(degrees * Degree), 1e-14);
    EXPECT_NEAR(CosDegrees(degrees), std::cos(degrees * Degree), 1e-14);
  }
  EXPECT_NEAR(Degree * Radian, 1.0, 1e-15);
}

//------------------------------------------------------------------------------
TEST(Angles, RunClockwiseFromNorth)
{
  double east[3];
  DirectionOf(90.0, 0.0, east);
  EXPECT_EQ(east[0], 1.0);
  EXPECT_EQ(east[1], 0.0);
  EXPECT_EQ(east[2], 0.0);
  double up[3];
  DirectionOf(123.0, 90.0, up);
  EXPECT_EQ(up[0], 0.0);
  EXPECT_EQ(up[2], 1.0);
}

//------------------------------------------------------------------------------
TEST(LightPresets, GiveLevelGroundAboutAsMuch)
{
  // What level ground in the open gets of the suns.
  auto sum = [](const LightPreset& preset)
  {
    double light = 0.0;
    for (const LightPreset::Sun& sun : preset.suns)
    {
      light += sun.intensity * Luminance(sun.color) * SinDegrees(sun.altitude);
    }
    return light;
  };
  EXPECT_NEAR(sum(DefaultLights()), 0.95 * std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(sum(MultidirectionalLights()), 0.5, 1e-12);
  EXPECT_NEAR(sum(SunAndSkyLights(100.0, 30.0)), 0.5 * 0.55, 1e-6);
}

//------------------------------------------------------------------------------
TEST(LightPresets, BringTheirSkyAndTheirResponse)
{
  EXPECT_EQ(DefaultLights().sky, LightPreset::Sky::None);
  EXPECT_EQ(SkyDomeLights().sky, LightPreset::Sky::WhiteDome);
  EXPECT_TRUE(SkyDomeLights().suns.empty());
  const LightPreset sunAndSky = SunAndSkyLights(100.0, 30.0);
  EXPECT_EQ(sunAndSky.sky, LightPreset::Sky::Clear);
  EXPECT_EQ(sunAndSky.suns.front().azimuth, 100.0);
  EXPECT_FALSE(sunAndSky.response.has_value());
  EXPECT_EQ(CombinedLights(1.0, 2.0).response, f64::RELIEF_COMBINED);
  EXPECT_EQ(IgorLights(1.0).response, f64::RELIEF_IGOR);
  EXPECT_EQ(IgorLights(1.0).suns.front().altitude, UsualAltitude);
}

}
