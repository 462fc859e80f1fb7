// SPDX-License-Identifier: BSD-3-Clause
#include "MinMaxPyramid.h"
#include "TestTerrain.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{
using relief::MinMaxPyramid;

constexpr float Infinity = std::numeric_limits<float>::infinity();

// Bounds of the block of `size` cells along a side from cell (ci, cj) on, as the header defines
// them.
MinMaxPyramid::Bounds BoundsOf(const Terrain& terrain, int ci, int cj, int size)
{
  MinMaxPyramid::Bounds bounds;
  int cells = 0;
  int holes = 0;
  for (int j = cj; j < std::min(cj + size, terrain.rows - 1); ++j)
  {
    for (int i = ci; i < std::min(ci + size, terrain.columns - 1); ++i)
    {
      double corners[] = { terrain.At(i, j), terrain.At(i + 1, j), terrain.At(i, j + 1),
        terrain.At(i + 1, j + 1) };
      bool hole = std::any_of(
        std::begin(corners), std::end(corners), [](double height) { return std::isnan(height); });
      ++cells;
      holes += hole ? 1 : 0;
      float twist = static_cast<float>(corners[3] - corners[1] - corners[2] + corners[0]);
      bounds.twist = hole ? bounds.twist : std::max(bounds.twist, std::abs(twist));
      for (double height : corners)
      {
        bounds.lo = hole ? bounds.lo : std::min(bounds.lo, static_cast<float>(height));
        bounds.hi = hole ? bounds.hi : std::max(bounds.hi, static_cast<float>(height));
      }
    }
  }
  if (holes > 0 && holes < cells)
  {
    bounds.lo = -Infinity;
    bounds.hi = Infinity;
    bounds.twist = Infinity; // not asked for: no ray skips such a block
  }
  return bounds;
}

void ExpectBruteForce(const Terrain& terrain)
{
  SCOPED_TRACE(::testing::Message() << terrain.columns << " x " << terrain.rows);
  Samples<float> samples(terrain);
  const MinMaxPyramid* pyramid = samples.WithBounds().bounds;
  int cellColumns = terrain.columns - 1;
  int cellRows = terrain.rows - 1;
  if (cellColumns < 1 || cellRows < 1)
  {
    EXPECT_EQ(pyramid->GetNumberOfLevels(), 0);
    EXPECT_EQ(pyramid->GetNumberOfBaseRows(), 0);
    EXPECT_EQ(pyramid->GetMemorySize(), 0u);
    return;
  }
  std::size_t blocks = 0;
  int size = MinMaxPyramid::BlockSize;
  for (int level = 0; level < pyramid->GetNumberOfLevels(); ++level, size *= 2)
  {
    int columns = (cellColumns + size - 1) / size;
    int rows = (cellRows + size - 1) / size;
    blocks += static_cast<std::size_t>(columns) * rows;
    // One block covers all at the top level, and only there.
    EXPECT_EQ(columns == 1 && rows == 1, level == pyramid->GetNumberOfLevels() - 1);
    for (int j = 0; j < rows; ++j)
    {
      for (int i = 0; i < columns; ++i)
      {
        const MinMaxPyramid::Bounds& bounds = pyramid->At(level, i, j);
        MinMaxPyramid::Bounds expected = BoundsOf(terrain, i * size, j * size, size);
        if (expected.lo > expected.hi)
        {
          EXPECT_GT(bounds.lo, bounds.hi) << level << ": " << i << ' ' << j;
        }
        else
        {
          EXPECT_EQ(bounds.lo, expected.lo) << level << ": " << i << ' ' << j;
          EXPECT_EQ(bounds.hi, expected.hi) << level << ": " << i << ' ' << j;
          // Heights up to 100, in single precision.
          EXPECT_TRUE(bounds.twist == expected.twist || bounds.lo == -Infinity ||
            std::abs(bounds.twist - expected.twist) < 1e-4f)
            << level << ": " << i << ' ' << j << ' ' << bounds.twist << ' ' << expected.twist;
        }
      }
    }
  }
  EXPECT_EQ(pyramid->GetMemorySize(), blocks * sizeof(MinMaxPyramid::Bounds));
}
}

TEST(MinMaxPyramid, EqualsBruteForce)
{
  Random random(Seed());
  const int sizes[][2] = { { 1, 1 }, { 1, 9 }, { 9, 1 }, { 2, 2 }, { 2, 7 }, { 3, 3 }, { 4, 4 },
    { 5, 5 }, { 6, 5 }, { 5, 6 }, { 9, 9 }, { 17, 17 }, { 18, 16 }, { 33, 5 }, { 64, 64 },
    { 65, 65 }, { 70, 50 }, { 131, 3 } };
  for (const auto& size : sizes)
  {
    // Whole, with a few samples missing, half of them, and all.
    for (double missing : { 0.0, 0.02, 0.5, 1.0 })
    {
      SCOPED_TRACE(missing);
      Terrain terrain(size[0], size[1]);
      for (double& height : terrain.heights)
      {
        height = random.Chance(missing) ? NoData : random.Uniform(-100.0, 100.0);
      }
      ExpectBruteForce(terrain);
    }
  }
}

// Large holes: blocks that are all hole, at several levels.
TEST(MinMaxPyramid, LargeHoles)
{
  Random random(Seed());
  Terrain terrain(101, 90);
  for (int j = 0; j < terrain.rows; ++j)
  {
    for (int i = 0; i < terrain.columns; ++i)
    {
      bool missing = (i > 30 && i < 70) || (j > 50 && i > 80);
      terrain.At(i, j) = missing ? NoData : random.Uniform(-1.0, 1.0);
    }
  }
  ExpectBruteForce(terrain);
}

// Rows of the lowest level may be filled in any order, and the memory is what HeightField promises.
TEST(MinMaxPyramid, RowsInAnyOrderAndSize)
{
  Random random(Seed());
  Terrain terrain(257, 203);
  for (double& height : terrain.heights)
  {
    height = random.Uniform(0.0, 1.0);
  }
  Samples<float> samples(terrain);
  MinMaxPyramid pyramid;
  pyramid.Allocate(terrain.columns, terrain.rows);
  for (int row = pyramid.GetNumberOfBaseRows() - 1; row >= 0; --row)
  {
    pyramid.BuildBase(samples.WithBounds().heights, row, row + 1);
  }
  pyramid.BuildUpper();
  for (int level = 0, columns = 64, rows = 51; level < pyramid.GetNumberOfLevels(); ++level)
  {
    for (int j = 0; j < rows; ++j)
    {
      for (int i = 0; i < columns; ++i)
      {
        EXPECT_EQ(pyramid.At(level, i, j).lo, samples.WithBounds().bounds->At(level, i, j).lo);
        EXPECT_EQ(pyramid.At(level, i, j).hi, samples.WithBounds().bounds->At(level, i, j).hi);
      }
    }
    columns = (columns + 1) / 2;
    rows = (rows + 1) / 2;
  }
  EXPECT_LE(pyramid.GetMemorySize(), 1.02 * 257 * 203);
}
