// SPDX-License-Identifier: BSD-3-Clause
//
// Fields of which only regions are in memory, and what is known of the whole.
#include "SparseTerrain.h"

#include "SceneShading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

using namespace relief;

class SparseHeightsTest : public OfReservedMemory
{
};

// Every bound of a field that is filled, and those within what is.
TEST_F(SparseHeightsTest, BoundsAreThoseOfTheWhole)
{
  Random random(Seed());
  SCOPED_TRACE("RELIEF_SEED=" + std::to_string(Seed()));
  for (int k = 0; k < 30; ++k)
  {
    const Terrain terrain =
      MakeLargeTerrain(random, random.Integer(1, 400), random.Integer(1, 300));
    Both both(terrain, true);
    ASSERT_EQ(both.wrong, "");
    RegionSet all(both.bounds.GetRegionColumns(), both.bounds.GetRegionRows());
    all.Add(0, all.GetColumns() - 1, 0, all.GetRows() - 1);
    both.sparse.Fill(all, HeightsOf(both.whole), k % 2 == 0 ? RunSerial : RunOnFour);
    both.sparse.Complete(k % 2 == 0 ? RunSerial : RunOnFour);
    const HeightField& a = both.sparse.GetField();
    const HeightField& b = both.whole;
    EXPECT_EQ(a.GetTop(), b.GetTop());
    EXPECT_EQ(a.GetBottom(), b.GetBottom());
    EXPECT_NE(a.GetVersion(), b.GetVersion());
    const MinMaxPyramid& pyramid = a.GetPyramid();
    ASSERT_EQ(pyramid.GetNumberOfLevels(), b.GetPyramid().GetNumberOfLevels());
    auto same = [](const MinMaxPyramid::Bounds& x, const MinMaxPyramid::Bounds& y)
    { return x.lo == y.lo && x.hi == y.hi && x.twist == y.twist; };
    for (int level = 0; level < pyramid.GetNumberOfLevels(); ++level)
    {
      for (int j = 0; j < pyramid.GetRows(level); ++j)
      {
        for (int i = 0; i < pyramid.GetColumns(level); ++i)
        {
          ASSERT_TRUE(same(pyramid.At(level, i, j), b.GetPyramid().At(level, i, j)))
            << level << ": " << i << ' ' << j;
        }
      }
    }
    for (int j = 0; j + 1 < terrain.rows; ++j)
    {
      for (int i = 0; i + 1 < terrain.columns; ++i)
      {
        ASSERT_EQ(*a.GetWindows().Lowest(i, j), *b.GetWindows().Lowest(i, j));
        ASSERT_EQ(*a.GetWindows().Highest(i, j), *b.GetWindows().Highest(i, j));
        for (int size = 0; size < HeightField::NumberOfSquares; ++size)
        {
          ASSERT_TRUE(same(a.GetSquares(size).From(i, j), b.GetSquares(size).From(i, j)));
        }
      }
    }
  }
}

TEST_F(SparseHeightsTest, BoundsTellHeightsThatAreOthers)
{
  Random random(Seed());
  SCOPED_TRACE("RELIEF_SEED=" + std::to_string(Seed()));
  constexpr int size = RasterBounds::RegionSize;
  for (int k = 0; k < 30; ++k)
  {
    const Terrain terrain =
      MakeLargeTerrain(random, random.Integer(1, 400), random.Integer(1, 300));
    Both both(terrain, true);
    ASSERT_EQ(both.wrong, "");
    const HeightView<float>& view = both.whole.GetField().heights;
    std::vector<float> heights(static_cast<std::size_t>(view.columns) * view.rows);
    HeightsOf(both.whole)(0, view.columns, 0, view.rows, heights.data(), view.columns);
    const auto agree = [&](int i, int j, int count, float rounding)
    {
      const float* first =
        heights.data() + static_cast<std::size_t>(j) * size * view.columns + i * size;
      return both.bounds.Agree(i, j, count, first, view.columns, rounding);
    };
    const int columns = both.bounds.GetRegionColumns();
    for (int j = 0; j < both.bounds.GetRegionRows(); ++j)
    {
      EXPECT_TRUE(agree(0, j, columns, 0.0f));
    }
    // One sample above all others.
    const int x = random.Integer(0, view.columns - 1);
    const int y = random.Integer(0, view.rows - 1);
    const float top = both.whole.GetTop() + 1.0f;
    heights[static_cast<std::size_t>(y) * view.columns + x] = top;
    const int i = x / size;
    const int j = y / size;
    EXPECT_FALSE(agree(0, j, columns, 0.0f));
    EXPECT_FALSE(agree(i, j, 1, 0.5f));
    EXPECT_TRUE(agree(0, j, i, 0.0f));
    EXPECT_TRUE(agree(i + 1, j, columns - i - 1, 0.0f));
    EXPECT_TRUE(j == 0 || agree(0, j - 1, columns, 0.0f));
  }
}

TEST_F(SparseHeightsTest, RowsArePaddedAsThoseOfTheWhole)
{
  Random random(Seed());
  Both both(MakeLargeTerrain(random, 150, 70), true);
  RegionSet all(3, 2);
  all.Add(0, 2, 0, 1);
  both.sparse.Fill(all, HeightsOf(both.whole), RunSerial);
  const HeightView<float>& view = both.sparse.GetField().GetField().heights;
  ASSERT_EQ(view.stepY, both.whole.GetField().heights.stepY);
  for (int j = 0; j < view.rows; ++j)
  {
    for (int k = 1; k <= HeightField::Padding; ++k)
    {
      ASSERT_TRUE(std::isnan(view.data[j * view.stepY - k]));
      ASSERT_TRUE(std::isnan(view.data[j * view.stepY + view.columns - 1 + k]));
    }
  }
  ASSERT_EQ(both.sparse.GetField().GetMissingRow(), view.data + view.rows * view.stepY);
  for (int i = -HeightField::Padding; i < view.columns + HeightField::Padding; ++i)
  {
    ASSERT_TRUE(std::isnan(both.sparse.GetField().GetMissingRow()[i]));
  }
}

TEST_F(SparseHeightsTest, ForgettingGivesMemoryBack)
{
  const int size = 4096;
  RasterBounds bounds;
  bounds.Begin(size, size);
  const std::vector<float> row(size, 5.0f);
  bounds.AddRows(row.data(), 0, size);
  SparseHeights sparse;
  ASSERT_EQ(sparse.Reserve(bounds, 1.0, 1.0, 0.0, true), "");
  const std::size_t empty = sparse.CountResident();
  const SparseHeights::Source five = EachBy([](int, int) { return 5.0f; });
  RegionSet some(64, 64);
  some.Add(16, 31, 16, 31); // of 1024 x 1024 samples
  sparse.Fill(some, five, RunSerial);
  sparse.Complete(RunSerial);
  const std::size_t filled = sparse.CountResident();
  RegionSet half(64, 64);
  half.Add(16, 31, 16, 23);
  sparse.Forget(half);
  const std::size_t left = sparse.CountResident();
  EXPECT_TRUE(sparse.IsFilled(20, 20));
  EXPECT_FALSE(sparse.IsFilled(20, 24));
  EXPECT_EQ(sparse.FindMissing(some).Count(), 128u);
  // What is kept is still there.
  const HeightView<float>& view = sparse.GetField().GetField().heights;
  EXPECT_EQ(view.At(1024, 1024), 5.0f);
  EXPECT_EQ(view.At(2047, 1535), 5.0f);
  EXPECT_EQ(sparse.GetField().GetPyramid().At(0, 511, 383).hi, 5.0f);
  sparse.Forget(RegionSet(64, 64));
  const std::size_t nothing = sparse.CountResident();
  if (filled > 0) // where the system tells
  {
    EXPECT_LT(empty, 200000u);
    EXPECT_GT(filled, 1024u * 1024u * 7u);
    EXPECT_LT(filled, 1024u * 1024u * 20u);
    EXPECT_LT(left, empty + (filled - empty) * 6 / 10);
    EXPECT_LE(nothing, empty);
  }
  EXPECT_EQ(sparse.FindMissing(some).Count(), 256u);
  EXPECT_EQ(view.At(1100, 1100), 0.0f);
}

TEST_F(SparseHeightsTest, HighSunsNeedFewRegions)
{
  const int size = 16384;
  RasterBounds bounds;
  bounds.Begin(size, size);
  std::vector<float> row(size);
  for (int i = 0; i < size; ++i)
  {
    row[i] = 100.0f * std::sin(0.01f * i);
  }
  bounds.AddRows(row.data(), 0, size);
  EXPECT_LT(bounds.GetMemorySize(), 0.02 * size * size);
  SparseHeights sparse;
  ASSERT_EQ(sparse.Reserve(bounds, 1.0, 1.0, 0.0, true), "");
  auto count = [&](const Light& light)
  {
    Scene scene;
    scene.lights = { light };
    return TileRegions(sparse, scene).Find(4096, 5120, 4096, 5120).read.Count();
  };
  auto countAside = [&](double depth)
  {
    Scene scene;
    scene.lights = { Sun(30.0, 60.0), Lamp(100.0, 100.0, 500.0) };
    scene.medium.depth = depth;
    scene.medium.offset = f64::RELIEF_SURFACE_NORMAL;
    return TileRegions(sparse, scene).Find(4096, 5120, 4096, 5120).read.Count();
  };
  // Points that are sunk far aside need more, and then all.
  EXPECT_LE(countAside(1.0), countAside(500.0));
  EXPECT_LT(countAside(500.0), 65536u);
  EXPECT_EQ(countAside(1e9), 65536u);
  // The tile itself has 16 x 16, of 65536.
  EXPECT_LE(count(Sun(30.0, 90.0)), 19u * 19u);
  EXPECT_LE(count(Sun(300.0, 60.0)), 23u * 23u);
  EXPECT_LE(count(Sun(300.0, 30.0)), 26u * 26u);
  EXPECT_LE(count(Sun(270.0, 5.0)), 20u * 60u);
  EXPECT_LE(count(Lamp(4600.0, 4600.0, 1e4)), 24u * 24u);
  EXPECT_LE(count(Lamp(-20000.0, 4600.0, 1e5)), 26u * 26u);
  EXPECT_EQ(count(Sun(0.0, -10.0)), count(Sun(30.0, 90.0)));
}

TEST_F(SparseHeightsTest, ThreadsDoNotMatterNorDoesTheTarget)
{
  Random random(Seed());
  const Terrain terrain = MakeLargeTerrain(random, 500, 300);
  Both both(terrain, true);
  Scene scene = Rich();
  scene.medium.depth = terrain.spacingX;
  scene.lights = { Sun(315.0, 20.0), Sun(100.0, 50.0) };
  AllOf expected(500, 300, true, false);
  SceneShading(both.whole, scene, expected.target).Shade(0, 500, 0, 300);
  std::unique_ptr<SceneShading> shading;
  const TileRegions regions(both.sparse, scene);
  // Each tile into arrays of its own.
  for (int i = 0; i < 500; i += 128)
  {
    const int i1 = std::min(i + 128, 500);
    AllOf tile(i1 - i, 300, true, false);
    tile.target.i0 = i;
    if (!shading)
    {
      shading = std::make_unique<SceneShading>(both.sparse.GetField(), scene, tile.target);
    }
    shading->Redirect(tile.target);
    FillFor(both.sparse, regions.Find(i, i1, 0, 300), HeightsOf(both.whole), RunOnFour);
    RunOnFour(300, [&](int begin, int end) { shading->Shade(i, i1, begin, end); });
    AllOf part(i1 - i, 300, true, false);
    part.target.i0 = i;
    SceneShading(both.whole, scene, part.target).Shade(i, i1, 0, 300);
    ASSERT_EQ(tile.FindDifference(part), "");
    for (int j = 0; j < 300; ++j)
    {
      const float d = expected.illumination[j * 500 + i];
      ASSERT_TRUE(std::isnan(d) || tile.illumination[j * (i1 - i)] == d);
    }
  }
}

TEST_F(SparseHeightsTest, ReliefBeyondSinglePrecisionIsRefused)
{
  RasterBounds bounds;
  bounds.Begin(2, 2);
  const float heights[] = { -3e38f, 0.0f, 0.0f, 3e38f };
  bounds.AddRows(heights, 2, 2);
  SparseHeights sparse;
  const std::string wrong = sparse.Reserve(bounds, 1.0, 1.0, 0.0, false);
  EXPECT_NE(wrong.find("heights reach from"), std::string::npos) << wrong;
}

TEST(RasterBounds, AreThoseOfTheWholeHoweverRowsCome)
{
  Random random(Seed());
  SCOPED_TRACE("RELIEF_SEED=" + std::to_string(Seed()));
  for (int k = 0; k < 60; ++k)
  {
    const Terrain terrain =
      MakeLargeTerrain(random, random.Integer(1, 300), random.Integer(1, 300));
    HeightField whole;
    ASSERT_EQ(Assign(terrain, whole, false), "");
    const RasterBounds bounds = BoundsOf(whole, random.Integer(1, 150));
    ASSERT_TRUE(bounds.IsComplete());
    EXPECT_EQ(bounds.GetBottom(), whole.GetBottom());
    EXPECT_EQ(bounds.GetTop(), whole.GetTop());
    EXPECT_EQ(bounds.GetNumberWithData(),
      static_cast<std::uint64_t>(std::count_if(terrain.heights.begin(), terrain.heights.end(),
        [](double height) { return !std::isnan(height); })));
    for (int j = 0; j < bounds.GetRegionRows(); ++j)
    {
      for (int i = 0; i < bounds.GetRegionColumns(); ++i)
      {
        bool holes = false;
        float lo = std::numeric_limits<float>::infinity();
        float hi = -lo;
        for (int y = 64 * j; y < std::min(64 * j + 64, terrain.rows); ++y)
        {
          for (int x = 64 * i; x < std::min(64 * i + 64, terrain.columns); ++x)
          {
            const float height = whole.GetField().heights.At(x, y);
            lo = std::min(lo, std::isnan(height) ? lo : height);
            hi = std::max(hi, std::isnan(height) ? hi : height);
            holes = holes ||
              (x + 1 < terrain.columns && y + 1 < terrain.rows &&
                std::isnan(terrain.At(x, y) + terrain.At(x + 1, y) + terrain.At(x, y + 1) +
                  terrain.At(x + 1, y + 1)));
          }
        }
        EXPECT_EQ(bounds.RangeAt(i, j).lo, lo);
        EXPECT_EQ(bounds.RangeAt(i, j).hi, hi);
        EXPECT_EQ(bounds.HasHoles(i, j), holes) << i << ' ' << j;
      }
    }
  }
}

TEST(RasterBounds, AreKeptAsArrays)
{
  Random random(Seed());
  HeightField whole;
  ASSERT_EQ(Assign(MakeLargeTerrain(random, 300, 200), whole, false), "");
  const RasterBounds bounds = BoundsOf(whole);
  RasterBounds again;
  again.SetSize(bounds.GetColumns(), bounds.GetRows());
  again.GetRanges() = bounds.GetRanges();
  again.GetBounds() = bounds.GetBounds();
  again.SetNumberWithData(bounds.GetNumberWithData());
  EXPECT_TRUE(again.IsComplete());
  EXPECT_EQ(again.GetTop(), bounds.GetTop());
  MinMaxPyramid a;
  MinMaxPyramid b;
  a.Allocate(300, 200);
  b.Allocate(300, 200);
  bounds.FillPyramid(a);
  again.FillPyramid(b);
  for (int level = MinMaxPyramid::RegionLevel; level < a.GetNumberOfLevels(); ++level)
  {
    EXPECT_EQ(a.At(level, 0, 0).hi, b.At(level, 0, 0).hi);
    EXPECT_EQ(a.At(level, 0, 0).hi, whole.GetPyramid().At(level, 0, 0).hi);
  }
}

// What a first pass finds in double gives the datum of the whole field.
TEST(RasterBounds, GoWithTheDatumOfTheWhole)
{
  Random random(Seed());
  for (int k = 0; k < 50; ++k)
  {
    std::vector<int> heights(60);
    const int lift = random.Integer(-2, 2) * random.Integer(0, 500000000);
    for (int& height : heights)
    {
      height = lift + random.Integer(0, 1000);
    }
    HeightSource<int> source = SourceOf(heights, 10);
    source.scale = random.Chance(0.5) ? 1.0 : 0.1;
    HeightField whole;
    ASSERT_EQ(whole.Assign(source, RunSerial), "");
    const auto range = std::minmax_element(heights.begin(), heights.end());
    const double datum =
      HeightField::FindDatum(*range.first * source.scale, *range.second * source.scale, false);
    EXPECT_EQ(datum, whole.GetDatum());
    for (int i = 0; i < 10; ++i)
    {
      EXPECT_EQ(
        static_cast<float>(heights[i] * source.scale - datum), whole.GetField().heights.At(i, 0));
    }
    EXPECT_EQ(HeightField::FindDatum(*range.first, *range.second, true), 0.0);
  }
}

TEST_F(SparseHeightsTest, RoomIsForgotten)
{
  RawArray<float> numbers;
  ASSERT_TRUE(numbers.Reserve(std::size_t{ 1 } << 28));
  EXPECT_TRUE(numbers.IsReserved());
  EXPECT_EQ(numbers[12345678], 0.0f);
  std::fill_n(numbers.data(), 1 << 20, 3.0f);
  EXPECT_EQ(numbers[1 << 19], 3.0f);
  numbers.Forget(0, 1 << 20);
  EXPECT_EQ(numbers[1 << 19], 0.0f);
  RawArray<float> other = std::move(numbers);
  EXPECT_TRUE(other.IsReserved());
  other.Allocate(1000);
  EXPECT_FALSE(other.IsReserved());
  EXPECT_EQ(other.size(), 1000u);
  ASSERT_TRUE(other.Reserve(0));
  EXPECT_TRUE(other.empty());
}
