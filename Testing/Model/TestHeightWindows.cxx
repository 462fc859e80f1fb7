// SPDX-License-Identifier: BSD-3-Clause
//
// What lockstep skips by, against all the samples that are meant.
#include "PreparedTerrain.h"

#include "HeightWindows.h"
#include "SlidingBounds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace relief;

namespace
{
constexpr float Infinity = std::numeric_limits<float>::infinity();

// Random heights, some of them without data.
Terrain Rough(Random& random, double holes)
{
  Terrain terrain(random.Integer(1, 90), random.Integer(1, 90), 1.0, 1.0);
  terrain.Fill([&](double, double)
    { return random.Chance(holes) ? std::nan("") : random.Uniform(-5.0, 5.0); });
  terrain.RoundToSingle();
  return terrain;
}

struct Found
{
  float lo = Infinity;
  float hi = -Infinity;
  bool holes = false;
};

// Of the samples [i0, i1] x [j0, j1], as far as there are any.
Found Look(const HeightView<float>& heights, int i0, int i1, int j0, int j1)
{
  Found found;
  for (int j = j0; j <= std::min(j1, heights.rows - 1); ++j)
  {
    for (int i = i0; i <= std::min(i1, heights.columns - 1); ++i)
    {
      const float height = heights.At(i, j);
      found.holes |= std::isnan(height);
      found.lo = height < found.lo ? height : found.lo;
      found.hi = height > found.hi ? height : found.hi;
    }
  }
  return found;
}
}

// A window is what it says: the extremes of its samples. So it holds any box that lies within.
TEST(HeightWindows, HoldTheirSamples)
{
  Random random(Seed());
  for (int round = 0; round < 50; ++round)
  {
    HeightField field;
    Prepare(Rough(random, round % 2 == 0 ? 0.0 : 0.05), field);
    const HeightView<float>& heights = field.GetField().heights;
    const HeightWindows& windows = field.GetWindows();
    SCOPED_TRACE(
      testing::Message() << "round " << round << ": " << heights.columns << " x " << heights.rows);
    for (int j = 0; j + 1 < heights.rows; ++j)
    {
      for (int i = 0; i + 1 < heights.columns; ++i)
      {
        const int i0 = i - i % HeightWindows::Step;
        const int j0 = j - j % HeightWindows::Step;
        const Found found =
          Look(heights, i0, i0 + HeightWindows::Size, j0, j0 + HeightWindows::Size);
        ASSERT_EQ(*windows.Lowest(i, j), found.lo) << i << ' ' << j;
        ASSERT_EQ(*windows.Highest(i, j), found.hi) << i << ' ' << j;
        ASSERT_LE(i + HeightWindows::Box, i0 + HeightWindows::Size);
      }
    }
  }
}

// Bounds of a square hold every box within its reach, and tell of every hole in it.
TEST(SlidingBounds, HoldWhatIsInReach)
{
  Random random(Seed());
  for (int round = 0; round < 50; ++round)
  {
    HeightField field;
    Prepare(Rough(random, round % 2 == 0 ? 0.0 : 0.001), field);
    const HeightView<float>& heights = field.GetField().heights;
    for (int check = 0; check < 100 && heights.columns > 1 && heights.rows > 1; ++check)
    {
      const int size = random.Integer(0, HeightField::NumberOfSquares - 1);
      const int reach = HeightField::GetReach(size);
      const int i = random.Integer(0, heights.columns - 2);
      const int j = random.Integer(0, heights.rows - 2);
      const MinMaxPyramid::Bounds& bounds = field.GetSquares(size).From(i, j);
      const Found found = Look(heights, i, i + reach, j, j + reach);
      SCOPED_TRACE(testing::Message() << "round " << round << ", size " << size << ": " << i << ' '
                                      << j << " of " << heights.columns << " x " << heights.rows);
      EXPECT_LE(bounds.lo, found.lo);
      EXPECT_GE(bounds.hi, found.hi);
      if (found.holes)
      {
        EXPECT_EQ(bounds.lo, -Infinity);
        EXPECT_EQ(bounds.hi, Infinity);
      }
    }
  }
}

// They are no wider than the blocks that they stand for.
TEST(SlidingBounds, AreThoseOfTheBlocks)
{
  Random random(Seed());
  HeightField field;
  Terrain terrain(150, 120, 1.0, 1.0);
  terrain.Fill([&](double, double) { return random.Uniform(-5.0, 5.0); });
  terrain.RoundToSingle();
  Prepare(terrain, field);
  const HeightView<float>& heights = field.GetField().heights;
  for (int size = 0; size < HeightField::NumberOfSquares; ++size)
  {
    const int block = MinMaxPyramid::BlockSize << size;
    const int side = HeightField::GetReach(size) - 1 + block;
    for (int j = 0; j + 1 < heights.rows; j += block)
    {
      for (int i = 0; i + 1 < heights.columns; i += block)
      {
        const MinMaxPyramid::Bounds& bounds = field.GetSquares(size).From(i, j);
        const Found found = Look(heights, i, i + side, j, j + side);
        ASSERT_EQ(bounds.lo, found.lo) << size << ": " << i << ' ' << j;
        ASSERT_EQ(bounds.hi, found.hi) << size << ": " << i << ' ' << j;
      }
    }
  }
}
