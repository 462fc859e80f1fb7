// SPDX-License-Identifier: BSD-3-Clause
#include "HeightSteps.h"
#include "PreparedTerrain.h"
#include "TestTerrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace
{
using relief::FindHeightSteps;
using relief::HeightSource;
using relief::SmoothHeightSteps;

// Parts of three rows, last one first, as threads might.
void InParts(int count, const std::function<void(int, int)>& body)
{
  for (int begin = (count - 1) / 3 * 3; begin >= 0; begin -= 3)
  {
    body(begin, std::min(begin + 3, count));
  }
}

std::vector<double> MakeHeights(
  int columns, int rows, const std::function<double(double, double)>& height)
{
  std::vector<double> heights;
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      heights.push_back(height(i, j));
    }
  }
  return heights;
}

std::vector<unsigned char> Rounded(const std::vector<double>& heights)
{
  std::vector<unsigned char> values;
  for (const double h : heights)
  {
    values.push_back(static_cast<unsigned char>(std::lround(h)));
  }
  return values;
}

template <class T>
std::vector<double> Smoothed(const HeightSource<T>& source, double step = 1.0)
{
  std::vector<double> result(static_cast<std::size_t>(source.columns) * source.rows);
  SmoothHeightSteps(source, step, RunSerial, result.data());
  return result;
}

template <class T>
double RootMeanSquare(const std::vector<double>& expected, const std::vector<T>& given)
{
  double sum = 0.0;
  for (std::size_t k = 0; k < given.size(); ++k)
  {
    sum += std::pow(given[k] - expected[k], 2.0);
  }
  return std::sqrt(sum / static_cast<double>(given.size()));
}
}

//------------------------------------------------------------------------------
// Planes with terraces up to a hundred samples wide, in any direction.
TEST(HeightSteps, PlanesComeBack)
{
  for (const double width : { 3.3, 10.7, 31.0, 103.0 })
  {
    for (const double angle : { 0.0, 0.4, 1.2 })
    {
      const std::vector<double> plane = MakeHeights(500, 400,
        [=](double x, double y)
        { return 20.2 + (std::cos(angle) * x + std::sin(angle) * y) / width; });
      const std::vector<unsigned char> stored = Rounded(plane);
      EXPECT_NEAR(RootMeanSquare(plane, stored), 0.29, 0.02);
      EXPECT_LT(RootMeanSquare(plane, Smoothed(SourceOf(stored, 500))), width > 50 ? 0.18 : 0.15)
        << width << " " << angle;
    }
  }
}

//------------------------------------------------------------------------------
TEST(HeightSteps, HillsComeBack)
{
  const std::vector<double> hills = MakeHeights(400, 300,
    [](double x, double y) { return 40.0 + 15.0 * std::sin(0.02 * x) * std::cos(0.025 * y); });
  const std::vector<unsigned char> stored = Rounded(hills);
  EXPECT_LT(
    RootMeanSquare(hills, Smoothed(SourceOf(stored, 400))), 0.6 * RootMeanSquare(hills, stored));
}

//------------------------------------------------------------------------------
TEST(HeightSteps, NothingLeavesItsHalfStep)
{
  Random random(Seed());
  for (int trial = 0; trial < 200; ++trial)
  {
    const int columns = random.Integer(1, 60);
    const int rows = random.Integer(1, 60);
    const double step = random.Logarithmic(1e-3, 1e3);
    const double base = random.Uniform(-1e4, 1e4) * step;
    const double steep = random.Logarithmic(0.01, 10.0);
    std::vector<double> stored = MakeHeights(columns, rows,
      [&](double x, double y)
      { return base + step * std::round(steep * (x + 0.5 * y) + random.Uniform(-1.0, 1.0)); });
    const double holes = random.Uniform(0.0, 0.6);
    for (double& h : stored)
    {
      h = random.Chance(holes) ? NoData : h;
    }
    const std::vector<double> result = Smoothed(SourceOf(stored, columns), step);
    for (std::size_t k = 0; k < result.size(); ++k)
    {
      ASSERT_EQ(std::isnan(result[k]), std::isnan(stored[k]));
      ASSERT_FALSE(std::abs(result[k] - stored[k]) > 0.5 * step) << trial;
    }
    std::vector<double> inParts(result.size());
    SmoothHeightSteps(SourceOf(stored, columns), step, InParts, inParts.data());
    for (std::size_t k = 0; k < result.size(); ++k)
    {
      ASSERT_TRUE(inParts[k] == result[k] || std::isnan(result[k])) << trial;
    }
  }
}

//------------------------------------------------------------------------------
// Cliffs, and level ground at their feet, stay exactly; nothing comes across a hole.
TEST(HeightSteps, CliffsAndHolesStay)
{
  const std::vector<unsigned char> cliffs = Rounded(
    MakeHeights(90, 70, [](double x, double y) { return x < 40 ? 10.0
                                                   : y < 30    ? 12.0
                                                               : 200.0; }));
  const std::vector<double> result = Smoothed(SourceOf(cliffs, 90));
  for (std::size_t k = 0; k < result.size(); ++k)
  {
    ASSERT_EQ(result[k], cliffs[k]);
  }
  const std::vector<unsigned char> sides = Rounded(
    MakeHeights(90, 70, [](double x, double) { return x < 40 ? 10.0
                                                 : x < 42    ? 99.0
                                                             : 11.0; }));
  HeightSource<unsigned char> source = SourceOf(sides, 90);
  source.hasNoData = true;
  source.noData = 99.0;
  const std::vector<double> apart = Smoothed(source);
  for (std::size_t k = 0; k < apart.size(); ++k)
  {
    ASSERT_TRUE(sides[k] == 99 ? std::isnan(apart[k]) : apart[k] == sides[k]);
  }
}

//------------------------------------------------------------------------------
// Gentle ground in few steps; not what is steep, flat between flanks, small or finely stored.
TEST(HeightSteps, TerracesAreSeen)
{
  const auto shows = [](double (*height)(double, double), int size, double factor)
  {
    std::vector<unsigned short> values;
    for (const double h : MakeHeights(size, size, height))
    {
      values.push_back(static_cast<unsigned short>(std::lround(h * factor)));
    }
    return relief::ShowsTerraces(SourceOf(values, size));
  };
  const auto gentle = [](double x, double y) { return 9.0 + x / 8.0 + y / 9.0; };
  const auto steps = [](double x, double) { return x < 60.0 ? 3.0 : x < 90.0 ? 70.0 : 9.0; };
  EXPECT_TRUE(shows(gentle, 150, 1.0));
  EXPECT_FALSE(shows(gentle, 90, 1.0));
  EXPECT_FALSE(shows(gentle, 150, 1000.0));
  EXPECT_FALSE(shows([](double x, double y) { return x + y / 3.0; }, 150, 1.0));
  EXPECT_FALSE(shows(steps, 150, 1.0));
  EXPECT_FALSE(shows([](double, double) { return 5.0; }, 150, 1.0));
}

//------------------------------------------------------------------------------
TEST(HeightSteps, StepsAreFound)
{
  const std::vector<unsigned short> expanded = { 0, 257, 257 * 5, 257 * 255, 257 * 4, 0, 257, 514 };
  EXPECT_EQ(FindHeightSteps(SourceOf(expanded, 4)).step, 257.0);
  EXPECT_EQ(FindHeightSteps(SourceOf(expanded, 4)).levels, 6u);
  const std::vector<double> floats = { 0.25, 0.75, NoData, 0.375 };
  EXPECT_EQ(FindHeightSteps(SourceOf(floats, 2)).step, 0.125);
  EXPECT_EQ(FindHeightSteps(SourceOf(floats, 2)).samples, 3u);
  EXPECT_EQ(FindHeightSteps(SourceOf(std::vector<double>(9, 4.0), 3)).step, 0.0);
}
