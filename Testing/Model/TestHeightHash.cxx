// SPDX-License-Identifier: BSD-3-Clause
//
// The hash of heights: the same for the same heights however they are stored, another for others.
#include "HeightHash.h"
#include "PreparedTerrain.h"

#include <cstdint>
#include <set>

using namespace relief;

namespace
{

template <class T>
std::uint64_t HashOf(const std::vector<T>& values, int columns)
{
  return HashHeights(SourceOf(values, columns), RunSerial);
}

}

// Numbers that stay: files of another day and another machine name them.
TEST(HeightHash, IsWhatItWas)
{
  const float none = std::nanf("");
  EXPECT_EQ(HashText(HashOf<float>({ 0.0f }, 1)), "494e1871cc4d5b40");
  EXPECT_EQ(
    HashText(HashOf<float>({ 1.5f, -2.0f, 1e30f, none, 0.0f, 7.25f }, 3)), "c2942b511932c662");
  EXPECT_EQ(HashText(0), "0000000000000000");
  EXPECT_EQ(HashText(0x0123456789abcdefu), "0123456789abcdef");
}

TEST(HeightHash, DoesNotDependOnHowHeightsAreStored)
{
  const std::vector<float> heights = { 1, 2, 3, 250, 0, 17 };
  const std::uint64_t hash = HashOf(heights, 3);
  EXPECT_EQ(HashOf<double>({ 1, 2, 3, 250, -0.0, 17 }, 3), hash);
  EXPECT_EQ(HashOf<unsigned char>({ 1, 2, 3, 250, 0, 17 }, 3), hash);
  EXPECT_EQ(HashOf<std::int64_t>({ 1, 2, 3, 250, 0, 17 }, 3), hash);
  HeightSource<float> source = SourceOf(heights, 3);
  source.scale = 4.0;
  source.spacingX = 30.0;
  EXPECT_EQ(HashHeights(source, RunSerial), hash);
  // With other steps, and in parts.
  const std::vector<short> turned = { 250, 9, 0, 9, 17, 9, 1, 9, 2, 9, 3, 9 };
  HeightSource<short> other;
  other.data = turned.data() + 6;
  other.stepX = 2;
  other.stepY = -6;
  other.columns = 3;
  other.rows = 2;
  const auto backward = [](int count, const std::function<void(int, int)>& body)
  {
    for (int k = count - 1; k >= 0; --k)
    {
      body(k, k + 1);
    }
  };
  EXPECT_EQ(HashHeights(other, backward), hash);
}

TEST(HeightHash, TellsNoDataByWhereItIs)
{
  const float none = std::nanf("");
  const std::uint64_t hash = HashOf<float>({ 1, 2, none, 4 }, 2);
  EXPECT_NE(hash, HashOf<float>({ 1, 2, 0, 4 }, 2));
  EXPECT_NE(hash, HashOf<float>({ 1, none, 2, 4 }, 2));
  EXPECT_EQ(hash, HashOf<float>({ 1, 2, -none, 4 }, 2));
  EXPECT_EQ(hash, HashOf<float>({ 1, 2, std::numeric_limits<float>::infinity(), 4 }, 2));
  const std::vector<int> values = { 1, 2, -9999, 4 };
  HeightSource<int> source = SourceOf(values, 2);
  EXPECT_NE(hash, HashHeights(source, RunSerial));
  source.hasNoData = true;
  source.noData = -9999.0;
  EXPECT_EQ(hash, HashHeights(source, RunSerial));
  source.hasNoData = false;
  source.hasData = [](int i, int j) { return i != 0 || j != 1; };
  EXPECT_EQ(hash, HashHeights(source, RunSerial));
}

TEST(HeightHash, TellsFieldsApart)
{
  Random random(3);
  std::vector<float> heights(60);
  for (float& height : heights)
  {
    height = static_cast<float>(random.Uniform(0.0, 100.0));
  }
  std::set<std::uint64_t> hashes;
  std::size_t count = 0;
  for (const int columns : { 1, 2, 3, 4, 5, 6, 10, 12, 15, 20, 30, 60 })
  {
    hashes.insert(HashOf(heights, columns));
    ++count;
  }
  for (std::size_t at = 0; at < heights.size(); ++at)
  {
    std::vector<float> moved = heights;
    moved[at] = std::nextafter(moved[at], 200.0f);
    hashes.insert(HashOf(moved, 10));
    std::swap(moved[at], moved[(at + 10) % 60]);
    hashes.insert(HashOf(moved, 10));
    count += 2;
  }
  EXPECT_EQ(hashes.size(), count);
}
