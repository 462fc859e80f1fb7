// SPDX-License-Identifier: BSD-3-Clause
#include "ClockTime.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace
{
using relief::ClockTime;
using relief::ParseDuration;
using relief::ParseTime;

std::int64_t Milliseconds(const std::string& text)
{
  ClockTime time;
  EXPECT_EQ(ParseTime(text, time), "");
  return time.milliseconds;
}

std::string Refusal(const std::string& text)
{
  ClockTime time;
  time.milliseconds = 42;
  const std::string wrong = ParseTime(text, time);
  EXPECT_EQ(time.milliseconds, 42) << "nothing is taken of " << text;
  EXPECT_LE(wrong.size(), 200u) << wrong;
  return wrong;
}

bool Says(const std::string& text, const std::string& part)
{
  return text.find(part) != std::string::npos;
}
}

TEST(ClockTime, OneMomentManyTexts)
{
  const std::int64_t moment = 1782016200000; // as POSIX counts, 2026-06-21T04:30Z
  for (const char* text : { "2026-06-21T06:30+02:00", "2026-06-21T06:30+0200", "20260621T0630+02",
         "2026-06-21T04:30Z", "2026-06-21 04:30:00.000z", "2026-06-21T01:00:00-03:30",
         "2026-06-20T24:00-04:30", "2026-06-21T04:30:00,0Z", "20260621t043000Z" })
  {
    EXPECT_EQ(Milliseconds(text), moment) << text;
  }
  EXPECT_EQ(Milliseconds("2026-06-21T04:30:01.2345Z"), moment + 1235);
}

TEST(ClockTime, Calendar)
{
  EXPECT_EQ(Milliseconds("1970-01-01T00:00Z"), 0);
  EXPECT_EQ(Milliseconds("2000-02-29T00:00Z"), 951782400000);
  EXPECT_EQ(Milliseconds("1600-01-01T00:00Z"), -11676096000000);
  EXPECT_EQ(Milliseconds("1900-03-01T00:00Z") - Milliseconds("1900-02-28T00:00Z"), 86400000);
  EXPECT_EQ(Milliseconds("2000-03-01T00:00Z") - Milliseconds("2000-02-28T00:00Z"), 2 * 86400000);
  ClockTime noon;
  EXPECT_EQ(ParseTime("2000-01-01T12:00Z", noon), "");
  EXPECT_EQ(JulianDay(noon), 2451545.0);
  // Every day of eight centuries has the name that it was read from.
  for (std::int64_t day = Milliseconds("1600-01-01T12:34Z");
       day < Milliseconds("2399-12-31T23:59Z"); day += 86400000)
  {
    const std::string name = relief::NameOf({ day, 0 }, false);
    ASSERT_EQ(Milliseconds(name), day) << name;
  }
}

// A leap second is the midnight after it, and there is none at other times.
TEST(ClockTime, LeapSecond)
{
  EXPECT_EQ(Milliseconds("2016-12-31T23:59:60Z"), Milliseconds("2017-01-01T00:00:00Z"));
  EXPECT_EQ(Milliseconds("2017-01-01T05:29:60+05:30"), Milliseconds("2017-01-01T00:00:00Z"));
  EXPECT_EQ(Milliseconds("1967-12-31T23:59:60Z"), Milliseconds("1968-01-01T00:00:00Z"));
  EXPECT_TRUE(Says(Refusal("2016-12-31T23:58:60Z"), "second 60"));
  EXPECT_TRUE(Says(Refusal("2016-12-31T23:59:60+01:00"), "second 60"));
}

TEST(ClockTime, Refused)
{
  EXPECT_TRUE(Says(Refusal("2026-06-21"), "has no time"));
  EXPECT_TRUE(Says(Refusal("2026-06-21T06:30"), "has no zone"));
  EXPECT_TRUE(Says(Refusal("2026-06-21T06:30 CEST"), "zone"));
  EXPECT_TRUE(Says(Refusal("2026-06-21T06:30+2"), "zone"));
  EXPECT_TRUE(Says(Refusal("2026-06-21T06:30+02:60"), "zone"));
  EXPECT_TRUE(Says(Refusal("2026-06-21T06:30Zulu"), "zone"));
  EXPECT_TRUE(Says(Refusal("2026-02-29T06:30Z"), "calendar"));
  EXPECT_TRUE(Says(Refusal("1900-02-29T06:30Z"), "calendar"));
  EXPECT_TRUE(Says(Refusal("2026-13-01T06:30Z"), "calendar"));
  EXPECT_TRUE(Says(Refusal("2026-04-00T06:30Z"), "calendar"));
  EXPECT_TRUE(Says(Refusal("2026-06-21T24:01Z"), "hour"));
  EXPECT_TRUE(Says(Refusal("2026-06-21T06:60Z"), "hour"));
  EXPECT_TRUE(Says(Refusal("2026-06-21T06:30:61Z"), "hour"));
  EXPECT_TRUE(Says(Refusal("1599-12-31T06:30Z"), "1600 to 2399"));
  EXPECT_TRUE(Says(Refusal("2400-01-01T06:30Z"), "1600 to 2399"));
  for (const char* text : { "", "noon", "21.06.2026 06:30", "2026-6-21T06:30Z", "26-06-21T06:30Z",
         "2026-06-21T6:30Z", "2026-06-21T0630Z", "20260621T06:30Z", "2026-06-21T06:30:Z",
         "2026-06-21T06:30:00.Z", "-026-06-21T06:30Z" })
  {
    EXPECT_NE(Refusal(text), "") << text;
  }
  EXPECT_NE(Refusal(std::string(5000, '2')), "");
}

TEST(ClockTime, Names)
{
  ClockTime time;
  EXPECT_EQ(ParseTime("2026-06-21T06:30+02:00", time), "");
  EXPECT_EQ(NameOf(time, false), "20260621T0630+0200");
  EXPECT_EQ(NameOf(time, true), "20260621T063000+0200");
  EXPECT_EQ(ParseTime("1969-12-31T23:59:59.5-03:30", time), "");
  EXPECT_EQ(NameOf(time, false), "19691231T235959.500-0330");
  EXPECT_EQ(ParseTime("2026-01-01T00:00Z", time), "");
  EXPECT_EQ(NameOf(time, false), "20260101T0000Z");
}

TEST(ClockTime, Durations)
{
  const auto length = [](const std::string& text)
  {
    std::int64_t milliseconds = -1;
    const std::string wrong = ParseDuration(text, milliseconds);
    EXPECT_EQ(wrong.empty(), milliseconds != -1) << text;
    EXPECT_LE(wrong.size(), 200u);
    return milliseconds;
  };
  const std::int64_t minute = 60000;
  EXPECT_EQ(length("15min"), 15 * minute);
  EXPECT_EQ(length("PT15M"), 15 * minute);
  EXPECT_EQ(length("90s"), 90000);
  EXPECT_EQ(length("0.5s"), 500);
  EXPECT_EQ(length("1.5h"), 90 * minute);
  EXPECT_EQ(length("PT1H30M"), 90 * minute);
  EXPECT_EQ(length("1d"), 24 * 60 * minute);
  EXPECT_EQ(length("P1DT1H1M1S"), 25 * 60 * minute + minute + 1000);
  for (const char* text :
    { "", "15", "15m", "min", "-15min", "0min", "PT", "P", "P1DT", "PT1D", "P1M", "PT5S3M",
      "PT5M5M", "P1D1D", "PT5", "1..5h", "1h30", "nan h", "1e9d", "0.0001s", "99999999999999999d" })
  {
    EXPECT_EQ(length(text), -1) << text;
  }
}
