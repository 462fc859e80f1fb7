// SPDX-License-Identifier: BSD-3-Clause
//
// Rows of heights in lanes against the same number by number, bit for bit, on every instruction set
// that this machine has.
#include "HeightRows.h"
#include "PreparedTerrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <vector>

using namespace relief;
using Bounds = MinMaxPyramid::Bounds;

namespace
{
constexpr float Infinity = std::numeric_limits<float>::infinity();

class HeightRows : public EveryTarget
{
};

bool SameBits(float a, float b)
{
  return std::memcmp(&a, &b, sizeof(float)) == 0 || (std::isnan(a) && std::isnan(b));
}

// Heights in which `missing` of all have no data.
std::vector<float> RandomHeights(Random& random, int count, double missing, double size)
{
  std::vector<float> heights(count);
  for (float& height : heights)
  {
    height =
      static_cast<float>(random.Chance(missing) ? NoData : random.Uniform(-size, 1.5 * size));
  }
  return heights;
}

// Bounds of the cells [begin, end) of rows, as the header of MinMaxPyramid says.
Bounds PlainBounds(const std::vector<const float*>& rows, int begin, int end)
{
  Bounds bounds;
  int cells = 0;
  int holes = 0;
  for (std::size_t j = 0; j + 1 < rows.size(); ++j)
  {
    for (int i = begin; i < end; ++i)
    {
      const float corners[] = { rows[j][i], rows[j][i + 1], rows[j + 1][i], rows[j + 1][i + 1] };
      ++cells;
      holes += std::any_of(corners, corners + 4, [](float h) { return std::isnan(h); }) ? 1 : 0;
      for (float height : corners)
      {
        bounds.lo = std::min(bounds.lo, height);
        bounds.hi = std::max(bounds.hi, height);
      }
      bounds.twist =
        std::max(bounds.twist, std::abs((corners[3] - corners[2]) - (corners[1] - corners[0])));
    }
  }
  return holes == 0 ? bounds : holes < cells ? MinMaxPyramid::GetMixed() : Bounds();
}

Bounds PlainParent(const std::vector<Bounds>& children)
{
  Bounds bounds;
  std::size_t empty = 0;
  bool mixed = false;
  for (const Bounds& child : children)
  {
    empty += child.lo > child.hi ? 1 : 0;
    mixed = mixed || child.lo == -Infinity;
    bounds.lo = std::min(bounds.lo, child.lo);
    bounds.hi = std::max(bounds.hi, child.hi);
    bounds.twist = std::max(bounds.twist, child.twist);
  }
  return mixed || (empty > 0 && empty < children.size()) ? MinMaxPyramid::GetMixed() : bounds;
}

void ExpectSame(const Bounds& a, const Bounds& b)
{
  ASSERT_TRUE(SameBits(a.lo, b.lo)) << a.lo << ' ' << b.lo;
  ASSERT_TRUE(SameBits(a.hi, b.hi)) << a.hi << ' ' << b.hi;
  ASSERT_TRUE(SameBits(a.twist, b.twist)) << a.twist << ' ' << b.twist;
}
}

TEST_P(HeightRows, ReadsWhatDoubleSays)
{
  Random random(Seed());
  for (int round = 0; round < 200; ++round)
  {
    const int count = random.Integer(1, 70);
    std::vector<float> values = RandomHeights(random, count, 0.1, 1000.0);
    values[random.Integer(0, count - 1)] = random.Chance(0.5) ? Infinity : -Infinity;
    values[random.Integer(0, count - 1)] = -9999.0f;
    const bool scaled = random.Chance(0.5);
    const double scale = scaled ? random.Uniform(-3.0, 3.0) : 1.0;
    const double datum = scaled && random.Chance(0.5) ? random.Uniform(-99.0, 99.0) : 0.0;
    const float marker = -9999.0f;
    const bool marked = random.Chance(0.5);
    std::vector<float> heights(count + 1, 7.0f);
    ReadHeights(values.data(), count, scale, datum, marked ? &marker : nullptr, heights.data());
    float least = Infinity;
    float greatest = -Infinity;
    for (int i = 0; i < count; ++i)
    {
      const bool has = std::isfinite(values[i]) && !(marked && values[i] == marker);
      const float expected = has
        ? static_cast<float>(static_cast<double>(values[i]) * scale - datum)
        : std::numeric_limits<float>::quiet_NaN();
      ASSERT_TRUE(SameBits(heights[i], expected)) << heights[i] << ' ' << expected;
      least = has ? std::min(least, expected) : least;
      greatest = has ? std::max(greatest, expected) : greatest;
    }
    EXPECT_EQ(heights[count], 7.0f);
    float lo = Infinity;
    float hi = -Infinity;
    AddToRange(heights.data(), count, lo, hi);
    EXPECT_EQ(lo, least);
    EXPECT_EQ(hi, greatest);
  }
}

TEST_P(HeightRows, BlocksHaveTheBoundsOfTheirCells)
{
  Random random(Seed());
  for (int round = 0; round < 400; ++round)
  {
    const int columns = round < 100 ? round + 2 : random.Integer(2, 700);
    const int count = random.Integer(2, MinMaxPyramid::BlockSize + 1);
    const double missing = round % 3 == 0 ? 0.0 : round % 3 == 1 ? 0.01 : 0.7;
    // Of the hugest that a field takes the sum is infinite.
    const double size = random.Chance(0.2) ? 1e37 : 100.0;
    const std::vector<float> heights = RandomHeights(random, count * columns, missing, size);
    std::vector<const float*> rows;
    for (int j = 0; j < count; ++j)
    {
      rows.push_back(heights.data() + static_cast<std::ptrdiff_t>(j) * columns);
    }
    const int number = (columns - 1 + MinMaxPyramid::BlockSize - 1) / MinMaxPyramid::BlockSize;
    std::vector<Bounds> blocks(number + 1, Bounds{ 1.0f, 2.0f, 3.0f });
    BoundBlocks(rows.data(), count, columns, blocks.data());
    for (int k = 0; k < number; ++k)
    {
      SCOPED_TRACE(testing::Message() << columns << " x " << count << ", block " << k);
      const int begin = k * MinMaxPyramid::BlockSize;
      ExpectSame(blocks[k],
        PlainBounds(rows, begin, std::min(begin + MinMaxPyramid::BlockSize, columns - 1)));
    }
    ExpectSame(blocks[number], { 1.0f, 2.0f, 3.0f });
  }
}

TEST_P(HeightRows, ParentsHaveTheBoundsOfTheirChildren)
{
  Random random(Seed());
  for (int round = 0; round < 300; ++round)
  {
    const int columns = round < 100 ? round + 1 : random.Integer(1, 300);
    const bool two = random.Chance(0.8);
    std::vector<Bounds> rows[2];
    for (std::vector<Bounds>& row : rows)
    {
      for (int i = 0; i < columns; ++i)
      {
        const float lo = static_cast<float>(random.Uniform(-9.0, 9.0));
        const float rise = static_cast<float>(random.Uniform(0.0, 2.0));
        row.push_back(random.Chance(0.2) ? Bounds()
            : random.Chance(0.1)         ? MinMaxPyramid::GetMixed()
                                         : Bounds{ lo, lo + rise, rise });
      }
    }
    std::vector<Bounds> parents((columns + 1) / 2 + 1, Bounds{ 1.0f, 2.0f, 3.0f });
    BoundParents(rows[0].data(), rows[two ? 1 : 0].data(), columns, parents.data());
    for (int k = 0; 2 * k < columns; ++k)
    {
      std::vector<Bounds> children;
      for (int row = 0; row < (two ? 2 : 1); ++row)
      {
        children.insert(children.end(), rows[row].begin() + 2 * k,
          rows[row].begin() + std::min(2 * k + 2, columns));
      }
      SCOPED_TRACE(testing::Message() << columns << ", parent " << k);
      ExpectSame(parents[k], PlainParent(children));
    }
    ExpectSame(parents.back(), { 1.0f, 2.0f, 3.0f });
  }
}

INSTANTIATE_FOR_EVERY_TARGET(HeightRows);

// Parts of any size, in any order, give the same field.
TEST(HeightRows, PartsMakeTheSameField)
{
  Random random(Seed());
  for (int round = 0; round < 60; ++round)
  {
    const int columns = random.Integer(1, 40);
    const int rows = random.Integer(1, 40);
    const std::vector<float> heights = RandomHeights(random, columns * rows, 0.05, 10.0);
    HeightSource<float> source;
    source.data = heights.data();
    source.stepY = columns;
    source.columns = columns;
    source.rows = rows;
    HeightField whole;
    HeightField parts;
    ASSERT_EQ(whole.Assign(source, RunSerial, true), "");
    auto backward = [&](int count, const std::function<void(int, int)>& body)
    {
      for (int end = count; end > 0;)
      {
        const int begin = std::max(end - random.Integer(1, 3), 0);
        body(begin, end);
        end = begin;
      }
    };
    ASSERT_EQ(parts.Assign(source, backward, true), "");
    for (int k = 0; k < columns * rows; ++k)
    {
      ASSERT_TRUE(SameBits(parts.GetField().heights.At(k % columns, k / columns), heights[k]));
    }
    EXPECT_EQ(whole.GetTop(), parts.GetTop());
    EXPECT_EQ(whole.GetBottom(), parts.GetBottom());
    ASSERT_EQ(whole.GetPyramid().GetNumberOfLevels(), parts.GetPyramid().GetNumberOfLevels());
    for (int j = 0; j < whole.GetPyramid().GetNumberOfBaseRows(); ++j)
    {
      for (int i = 0; 4 * i < columns - 1; ++i)
      {
        ExpectSame(whole.GetPyramid().At(0, i, j), parts.GetPyramid().At(0, i, j));
      }
    }
  }
}
