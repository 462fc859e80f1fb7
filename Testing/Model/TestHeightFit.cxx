// SPDX-License-Identifier: BSD-3-Clause
#include "HeightFit.h"
#include "PreparedTerrain.h"
#include "TestTerrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace
{
using relief::FitHeightScale;
using relief::HeightSource;

constexpr double SteepSlope = 0.7;

// Parts of three rows, last one first, as threads might.
void InParts(int count, const std::function<void(int, int)>& body)
{
  for (int begin = (count - 1) / 3 * 3; begin >= 0; begin -= 3)
  {
    body(begin, std::min(begin + 3, count));
  }
}

struct Relief
{
  std::string name;
  int columns;
  int rows;
  std::vector<double> heights; // from 0 to 1
};

Relief MakeRelief(const std::string& name, int columns, int rows,
  const std::function<double(double, double)>& height)
{
  Relief relief{ name, columns, rows, {} };
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      relief.heights.push_back(height(i, j));
    }
  }
  const auto range = std::minmax_element(relief.heights.begin(), relief.heights.end());
  const double lowest = *range.first;
  const double size = *range.second - lowest;
  for (double& h : relief.heights)
  {
    h = (h - lowest) / size;
  }
  return relief;
}

// Waves of all lengths, each as much lower as it is shorter.
double Waves(double x, double y)
{
  Random random(5);
  double height = 0.0;
  for (int k = 0; k < 40; ++k)
  {
    const double frequency = random.Logarithmic(0.01, 0.5);
    const double angle = random.Uniform(0.0, 2.0 * Pi);
    const double phase = random.Uniform(0.0, 2.0 * Pi);
    height += std::pow(frequency, -1.3) *
      std::sin(frequency * (std::cos(angle) * x + std::sin(angle) * y) + phase);
  }
  return height;
}

double Disc(double x, double y, double radius)
{
  return std::hypot(x - 200.0, y - 150.0) < radius ? 1.0 : 0.0;
}

// A ball with waves on it before a far background.
double Ball(double x, double y)
{
  const double square = 1.0 - std::pow(std::hypot(x - 200.0, y - 150.0) / 120.0, 2.0);
  return square > 0.0 ? 1.0 + std::sqrt(square) + 0.02 * std::sin(x / 6.0) * std::sin(y / 6.0)
                      : 0.0;
}

double Gauss(double x, double y)
{
  return std::exp(-0.5 * (std::pow((x - 200.0) / 40.0, 2.0) + std::pow((y - 150.0) / 40.0, 2.0)));
}

std::vector<Relief> Reliefs()
{
  return { MakeRelief("terrain", 403, 344, Waves),
    MakeRelief("hill on level ground", 403, 344, Gauss),
    MakeRelief("steps", 400, 300,
      [](double x, double y) { return Disc(x, y, 60.0) + 0.5 * Disc(x, y, 110.0); }),
    MakeRelief("depth map", 400, 300, Ball),
    MakeRelief("plane", 400, 300, [](double x, double y) { return x + 0.3 * y; }) };
}

template <class T>
std::vector<T> Store(const Relief& relief, double factor, double offset)
{
  std::vector<T> values;
  for (const double h : relief.heights)
  {
    const double value = h * factor + offset;
    values.push_back(static_cast<T>(std::is_integral_v<T> ? std::round(value) : value));
  }
  return values;
}

// What the relief's heights from 0 to 1 are scaled with, once they are stored in another way.
template <class T>
double ScaleOf(const Relief& relief, double factor, double offset)
{
  const std::vector<T> values = Store<T>(relief, factor, offset);
  return FitHeightScale(SourceOf(values, relief.columns), RunSerial) * std::abs(factor);
}

double FitOf(const Relief& relief)
{
  return FitHeightScale(SourceOf(relief.heights, relief.columns), RunSerial);
}
}

//------------------------------------------------------------------------------
TEST(HeightFit, NumberTypeDoesNotMatter)
{
  for (const Relief& relief : Reliefs())
  {
    SCOPED_TRACE(relief.name);
    const double expected = FitOf(relief);
    ASSERT_GT(expected, 0.0);
    EXPECT_NEAR(ScaleOf<unsigned char>(relief, 255.0, 0.0) / expected, 1.0, 0.005);
    EXPECT_NEAR(ScaleOf<signed char>(relief, 200.0, -100.0) / expected, 1.0, 0.005);
    EXPECT_NEAR(ScaleOf<unsigned short>(relief, 65535.0, 0.0) / expected, 1.0, 1e-4);
    EXPECT_NEAR(ScaleOf<int>(relief, -1e9, 5e8) / expected, 1.0, 1e-6);
    EXPECT_NEAR(ScaleOf<long long>(relief, 1e12, 1e15) / expected, 1.0, 1e-6);
    EXPECT_NEAR(ScaleOf<float>(relief, 1.0, 0.0) / expected, 1.0, 1e-5);
    EXPECT_NEAR(ScaleOf<double>(relief, -0.01, 1000.0) / expected, 1.0, 1e-6);
    EXPECT_NEAR(ScaleOf<double>(relief, 1e30, -1e29) / expected, 1.0, 1e-6);
    EXPECT_NEAR(ScaleOf<double>(relief, 1e-30, 0.0) / expected, 1.0, 1e-6);
  }
}

//------------------------------------------------------------------------------
TEST(HeightFit, SpacingScalesAlong)
{
  const Relief relief = Reliefs().front();
  HeightSource<double> source = SourceOf(relief.heights, relief.columns);
  const double expected = FitHeightScale(source, RunSerial);
  source.spacingX = source.spacingY = 30.0;
  EXPECT_NEAR(FitHeightScale(source, RunSerial) / expected, 30.0, 1e-9);

  // The same surface, with half as many columns.
  std::vector<double> half;
  for (int j = 0; j < relief.rows; ++j)
  {
    for (int i = 0; i < relief.columns; i += 2)
    {
      half.push_back(relief.heights[static_cast<std::size_t>(j) * relief.columns + i]);
    }
  }
  source = SourceOf(half, (relief.columns + 1) / 2);
  source.spacingX = 2.0;
  EXPECT_NEAR(FitHeightScale(source, RunSerial) / expected, 1.0, 0.1);
}

//------------------------------------------------------------------------------
TEST(HeightFit, ThreadsDoNotMatter)
{
  for (const Relief& relief : Reliefs())
  {
    const HeightSource<double> source = SourceOf(relief.heights, relief.columns);
    EXPECT_EQ(FitHeightScale(source, RunSerial), FitHeightScale(source, InParts)) << relief.name;
  }
}

//------------------------------------------------------------------------------
// Slopes that are all the same, up and down: the steep ones are known.
TEST(HeightFit, RoofsGetTheSlope)
{
  constexpr double slope = 2.5;
  std::vector<double> heights;
  for (int j = 0; j < 200; ++j)
  {
    for (int i = 0; i < 300; ++i)
    {
      heights.push_back(7.0 + slope * std::abs(std::fmod(i, 100.0) - 50.0));
    }
  }
  HeightSource<double> source = SourceOf(heights, 300);
  EXPECT_NEAR(FitHeightScale(source, RunSerial), SteepSlope / slope, 1e-9);

  // Holes leave the slope of a plane as it is, whatever stands in them.
  Random random(3);
  std::vector<char> hole;
  for (double& h : heights)
  {
    hole.push_back(random.Chance(0.4) ? 1 : 0);
    h = hole.back() ? random.Uniform(-1e6, 1e6) : h;
  }
  source.hasData = [&hole](int i, int j)
  { return hole[static_cast<std::size_t>(j) * 300 + i] == 0; };
  EXPECT_NEAR(FitHeightScale(source, RunSerial), SteepSlope / slope, 1e-9);

  // The same with values for holes, and with what is not finite.
  source.hasData = nullptr;
  source.hasNoData = true;
  source.noData = -9999.0;
  for (std::size_t k = 0; k < heights.size(); ++k)
  {
    const double none[] = { -9999.0, std::numeric_limits<double>::quiet_NaN(),
      std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() };
    heights[k] = hole[k] ? none[k % 4] : heights[k];
  }
  EXPECT_NEAR(FitHeightScale(source, RunSerial), SteepSlope / slope, 1e-9);
}

//------------------------------------------------------------------------------
// Flanks decide, however little of the field they are; and a ball's own relief, not its outline.
TEST(HeightFit, FlatsAndOutlinesDoNotCount)
{
  const auto discs = [](int count)
  {
    return MakeRelief("discs", 400, 300,
      [count](double x, double y)
      {
        double height = 0.0;
        for (int k = 0; k < count; ++k)
        {
          height += std::hypot(x - 40.0 * k - 20.0, y - 150.0) < 15.0 ? 1.0 : 0.0;
        }
        return height;
      });
  };
  EXPECT_NEAR(FitOf(discs(1)) / FitOf(discs(10)), 1.0, 0.05);

  const Relief ball = MakeRelief("ball", 400, 300, Ball);
  // As a length; it is 240 samples wide.
  const double bulge = FitOf(ball) / 2.0;
  EXPECT_GT(bulge, 15.0);
  EXPECT_LT(bulge, 60.0);
}

//------------------------------------------------------------------------------
TEST(HeightFit, ReliefIsNotTooHigh)
{
  // A slope all across would be 35 degrees and higher than half the longer side.
  const Relief plane = Reliefs().back();
  const double side = plane.columns - 1;
  EXPECT_GT(FitOf(plane), 0.2 * side); // but for the lowest and the highest corner
  EXPECT_LT(FitOf(plane), 0.25 * side);
}

//------------------------------------------------------------------------------
TEST(HeightFit, NothingToScale)
{
  const double none = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> heights(50 * 40, 0.1);
  EXPECT_EQ(FitHeightScale(SourceOf(heights, 50), RunSerial), 0.0);
  EXPECT_EQ(FitHeightScale(SourceOf(heights, 2000), RunSerial), 0.0);
  heights[70] = none;
  EXPECT_EQ(FitHeightScale(SourceOf(heights, 50), RunSerial), 0.0);
  std::fill(heights.begin(), heights.end(), none);
  EXPECT_EQ(FitHeightScale(SourceOf(heights, 50), RunSerial), 0.0);
  for (std::size_t k = 0; k < heights.size(); ++k)
  {
    heights[k] = std::sin(static_cast<double>(k));
  }
  EXPECT_EQ(FitHeightScale(SourceOf(heights, 1), RunSerial), 0.0);
  EXPECT_EQ(FitHeightScale(SourceOf(heights, 2000), RunSerial), 0.0);
  EXPECT_GT(FitHeightScale(SourceOf(heights, 1000), RunSerial), 0.0);
}

//------------------------------------------------------------------------------
// Every value is a number, whatever the heights.
TEST(HeightFit, IsFinite)
{
  constexpr double most = std::numeric_limits<double>::max();
  constexpr double least = std::numeric_limits<double>::denorm_min();
  Random random(Seed());
  for (int trial = 0; trial < 2000; ++trial)
  {
    const int columns = random.Integer(2, 40);
    const int rows = random.Integer(2, 40);
    std::vector<double> heights(static_cast<std::size_t>(columns) * rows);
    const double some[] = { 0.0, 1.0, -1.0, most, -most, least, 1e-300, 1e300, NoData };
    const int kinds = random.Integer(1, 9);
    for (double& h : heights)
    {
      h = some[random.Integer(0, kinds - 1)];
    }
    HeightSource<double> source = SourceOf(heights, columns);
    source.spacingX = random.Logarithmic(1e-32, 1e32);
    source.spacingY = random.Logarithmic(1e-32, 1e32);
    const double scale = FitHeightScale(source, RunSerial);
    ASSERT_TRUE(std::isfinite(scale) && scale >= 0.0) << trial;
  }
}

//------------------------------------------------------------------------------
TEST(HeightFit, WorkIsBounded)
{
  const float height = 1.0f;
  HeightSource<float> source;
  source.data = &height;
  source.stepX = source.stepY = 0;
  std::atomic<std::int64_t> reads{ 0 };
  source.hasData = [&reads](int, int)
  {
    ++reads;
    return true;
  };
  for (const std::pair<int, int>& size :
    { std::pair<int, int>{ 100000, 70000 }, { 2, 2000000000 }, { 2000000000, 9 } })
  {
    source.columns = size.first;
    source.rows = size.second;
    reads = 0;
    EXPECT_EQ(FitHeightScale(source, RunSerial), 0.0);
    EXPECT_GT(reads, 1000);
    EXPECT_LE(reads, std::int64_t(1) << 22);
  }
}
