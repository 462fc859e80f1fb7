// SPDX-License-Identifier: BSD-3-Clause
#include "ClockTime.h"
#include "SolarPosition.h"
#include "SunPositions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace
{
using relief::Air;
using relief::ClockTime;
using relief::FindSun;
using relief::SolarPosition;

constexpr double Pi = 3.14159265358979323846;
constexpr Air NoAir;

double TimeOf(const std::string& text)
{
  ClockTime time;
  EXPECT_EQ(relief::ParseTime(text, time), "");
  return JulianDay(time);
}

// Degrees between two places in the sky, along it: azimuths mean little beside the zenith.
double Away(const SolarPosition& one, double azimuth, double altitude)
{
  const double along =
    std::remainder(one.azimuth - azimuth, 360.0) * std::cos(altitude * Pi / 180.0);
  return std::hypot(along, one.altitude - altitude);
}
}

// The worked example of I. Reda and A. Andreas (2004), table A5.1.
TEST(SolarPosition, PublishedCase)
{
  const SolarPosition sun =
    FindSun(TimeOf("2003-10-17T12:30:30-07:00"), -105.1786, 39.742476, { 820.0, 11.0 });
  EXPECT_NEAR(90.0 - sun.altitude, 50.11162, 0.001);
  EXPECT_NEAR(sun.azimuth, 194.34024, 0.001);
}

TEST(SolarPosition, OtherImplementations)
{
  double farthest = 0.0;
  for (const SunSeen& seen : SunsSeen)
  {
    const double time = TimeOf(seen.time);
    const SolarPosition bare = FindSun(time, seen.longitude, seen.latitude, NoAir);
    EXPECT_LT(Away(bare, seen.azimuth, seen.altitude), 0.003) << seen.time;
    const SolarPosition sun =
      FindSun(time, seen.longitude, seen.latitude, relief::StandardAir(seen.elevation));
    EXPECT_LT(Away(sun, seen.azimuth, seen.refracted), 0.003) << seen.time;
    EXPECT_EQ(sun.azimuth, bare.azimuth); // air lifts, and turns nothing
    farthest = std::max(farthest, Away(bare, seen.azimuth, seen.altitude));
  }
  EXPECT_GT(farthest, 0.0); // it is not ours that is compared with itself
}

TEST(SolarPosition, ItIsOneSky)
{
  for (const char* text : { "1900-03-01T00:00Z", "2026-06-21T04:30Z", "2399-12-31T23:59Z" })
  {
    const double time = TimeOf(text);
    // The date line is no line in the sky.
    const SolarPosition east = FindSun(time, 180.0, 12.0, NoAir);
    const SolarPosition west = FindSun(time, -180.0, 12.0, NoAir);
    EXPECT_LT(Away(east, west.azimuth, west.altitude), 1e-9) << text;
    // Opposite places see opposite sides of it, but for the Earth's size: twice the parallax.
    const SolarPosition here = FindSun(time, 20.0, 30.0, NoAir);
    const SolarPosition there = FindSun(time, -160.0, -30.0, NoAir);
    EXPECT_NEAR(here.altitude, -there.altitude, 0.006) << text;
    // At a pole it goes round at one height, with the longitude.
    const SolarPosition pole = FindSun(time, 0.0, 90.0, NoAir);
    const SolarPosition turned = FindSun(time, 40.0, 90.0, NoAir);
    EXPECT_NEAR(pole.altitude, turned.altitude, 1e-9);
    EXPECT_NEAR(std::remainder(turned.azimuth - pole.azimuth - 40.0, 360.0), 0.0, 1e-9);
  }
}

// Over a year every azimuth and altitude is finite and in its range, and at each solstice the noon
// sun stands as high as the obliquity has it.
TEST(SolarPosition, AYear)
{
  double highest = -90.0;
  double lowest = 90.0;
  for (int hour = 0; hour < 24 * 365; ++hour)
  {
    const double time = TimeOf("2026-01-01T12:00Z") + hour / 24.0;
    const SolarPosition sun = FindSun(time, 0.0, 45.0, NoAir);
    ASSERT_TRUE(sun.azimuth >= 0.0 && sun.azimuth < 360.0) << hour;
    ASSERT_TRUE(sun.altitude > -90.0 && sun.altitude < 90.0) << hour;
    highest = std::max(highest, sun.altitude);
    lowest = std::min(lowest, sun.altitude);
  }
  EXPECT_NEAR(highest, 45.0 + 23.436, 0.01);
  EXPECT_NEAR(lowest, -45.0 - 23.436, 0.01);
}

TEST(SolarPosition, Refraction)
{
  // As almanacs have it: about 34 minutes of arc at the horizon, 1 at 45 degrees, none in the
  // zenith and for a sun that has not risen.
  const Air air = relief::StandardAir(0.0);
  double last = 1.0;
  for (double time = TimeOf("2026-03-20T05:50Z"); time < TimeOf("2026-03-20T12:00Z"); time += 1e-3)
  {
    const SolarPosition bare = FindSun(time, 0.0, 0.0, NoAir);
    const double lift = FindSun(time, 0.0, 0.0, air).altitude - bare.altitude;
    if (bare.altitude < -0.84)
    {
      EXPECT_EQ(lift, 0.0);
      continue;
    }
    EXPECT_GE(lift, 0.0);
    EXPECT_LE(lift, last); // less and less
    last = lift;
    if (std::abs(bare.altitude) < 0.2)
    {
      EXPECT_NEAR(lift, 29.0 / 60.0, 4.0 / 60.0);
    }
    if (std::abs(bare.altitude - 45.0) < 0.5)
    {
      EXPECT_NEAR(lift, 1.0 / 60.0, 0.05 / 60.0);
    }
  }
  EXPECT_LT(last, 0.001);
  // Thinner air bends less, in proportion.
  EXPECT_NEAR(relief::StandardAir(0.0).pressure, 1013.25, 1e-9);
  EXPECT_NEAR(relief::StandardAir(5000.0).pressure, 540.2, 0.5);
  EXPECT_NEAR(relief::StandardAir(11000.0).temperature, -56.5, 1e-9);
}

TEST(SolarPosition, DynamicalTime)
{
  // Observed, in seconds: Espenak and Meeus's table.
  const double observed[][2] = { { 1600, 120 }, { 1700, 9 }, { 1800, 14 }, { 1850, 7 },
    { 1900, -3 }, { 1950, 29 }, { 1980, 50.5 }, { 2000, 63.8 }, { 2005, 64.7 } };
  for (const auto& [year, seconds] : observed)
  {
    EXPECT_NEAR(relief::DeltaT(year), seconds, 1.0) << year;
  }
  // Where two polynomials meet they differ by little.
  for (const double year : { 1700, 1800, 1860, 1900, 1920, 1941, 1961, 1986, 2005, 2050, 2150 })
  {
    EXPECT_NEAR(relief::DeltaT(year - 1e-9), relief::DeltaT(year), 1.0) << year;
  }
}

TEST(SolarPosition, Places)
{
  EXPECT_EQ(relief::CheckPlace(-180.0, 90.0, 8849.0), "");
  EXPECT_EQ(relief::CheckPlace(360.0, -90.0, -1000.0), "");
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double wrong : { -181.0, 361.0, nan })
  {
    EXPECT_NE(relief::CheckPlace(wrong, 0.0, 0.0).find("longitude"), std::string::npos);
  }
  for (const double wrong : { -90.5, 91.0, nan })
  {
    EXPECT_NE(relief::CheckPlace(0.0, wrong, 0.0).find("latitude"), std::string::npos);
  }
  for (const double wrong : { -1001.0, 11001.0, nan })
  {
    EXPECT_NE(relief::CheckPlace(0.0, 0.0, wrong).find("sea level"), std::string::npos);
  }
}
