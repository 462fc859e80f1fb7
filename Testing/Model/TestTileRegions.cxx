// SPDX-License-Identifier: BSD-3-Clause
//
// Shading a raster tile by tile, of which only what the tile needs is in memory.
#include "SparseTerrain.h"

#include "SceneShading.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <iostream>

using namespace relief;

class TileRegionsTest : public OfReservedMemory
{
};

namespace
{
// Ridges of many sizes, 3 km high.
void MakeMountains(int size, std::vector<float>& heights)
{
  Random random(Seed());
  std::vector<float> grid(static_cast<std::size_t>(257) * 257);
  for (float& value : grid)
  {
    value = static_cast<float>(random.Uniform(-1.0, 1.0));
  }
  float amplitude = 1500.0f;
  std::fill(heights.begin(), heights.end(), 1500.0f);
  for (int period = 512; period >= 2; period /= 2, amplitude *= 0.48f)
  {
    for (int j = 0; j < size; ++j)
    {
      const int y = j / period;
      const float v = static_cast<float>(j % period) / period;
      const float* lower = grid.data() + (y * 31 + period) % 256 * 257;
      const float* upper = grid.data() + ((y + 1) * 31 + period) % 256 * 257;
      for (int i = 0; i < size; ++i)
      {
        const int x = i / period % 256;
        const float u = static_cast<float>(i % period) / period;
        const float value = (1 - v) * ((1 - u) * lower[x] + u * lower[x + 1]) +
          v * ((1 - u) * upper[x] + u * upper[x + 1]);
        heights[static_cast<std::size_t>(j) * size + i] += amplitude * (0.5f - std::abs(value));
      }
    }
  }
}

// A terrain of whole numbers far above 0.
void LiftHigh(Terrain& terrain, Random& random)
{
  const double lift = random.Chance(0.5) ? 1e6 : -3e5;
  for (double& height : terrain.heights)
  {
    height = std::floor(height) + lift;
  }
}
}

TEST_F(TileRegionsTest, TilesEqualTheWholeBitForBit)
{
  const int only = std::getenv("RELIEF_CASE") ? std::atoi(std::getenv("RELIEF_CASE")) : -1;
  const int cases = std::getenv("RELIEF_CASES") ? std::atoi(std::getenv("RELIEF_CASES")) : 200;
  Regions count;
  for (int k = 0; k < cases; ++k)
  {
    if (only >= 0 && k != only)
    {
      continue;
    }
    const std::uint64_t seed = Seed() + 1000003ull * k;
    SCOPED_TRACE("RELIEF_SEED=" + std::to_string(Seed()) + " RELIEF_CASE=" + std::to_string(k));
    Random random(seed);
    const bool small = random.Chance(0.5);
    int columns = random.Chance(0.1) ? random.Integer(1, 3) : random.Integer(4, small ? 130 : 400);
    int rows = random.Chance(0.1) ? random.Integer(1, 3) : random.Integer(4, small ? 130 : 400);
    if (random.Chance(0.15))
    {
      (random.Chance(0.5) ? columns : rows) = random.Integer(400, 1500);
      (columns > rows ? rows : columns) = random.Integer(4, 150);
    }
    Terrain terrain = MakeLargeTerrain(random, columns, rows);
    if (random.Chance(0.15))
    {
      LiftHigh(terrain, random);
    }
    Both both(terrain, random.Chance(0.8));
    ASSERT_EQ(both.wrong, "");
    const double bottom = both.bounds.GetBottom();
    const double top = both.bounds.GetTop();
    if (!(top >= bottom))
    {
      continue;
    }
    const Scene scene = MakeLargeScene(random, terrain, bottom, top);
    const bool thickness = random.Chance(0.3);
    AllOf expected(columns, rows, thickness, !scene.sun.empty());
    SceneShading(both.whole, scene, expected.target).Shade(0, columns, 0, rows);
    AllOf tiled(columns, rows, thickness, !scene.sun.empty());
    const int tile = random.Integer(std::max(columns, rows) > 200 ? 48 : 16, 64);
    ShadeTiles(both, scene, tile, tiled, random, count);
    ASSERT_EQ(tiled.FindDifference(expected), "")
      << columns << " x " << rows << ", tile " << tile << ", light " << scene.lights[0].positional
      << ' ' << scene.lights[0].vector.x << ' ' << scene.lights[0].vector.y << ' '
      << scene.lights[0].vector.z << ", t " << scene.medium.depth << ", offset "
      << scene.medium.offset << ", tolerance " << scene.medium.tolerance << ", floor "
      << scene.medium.useFloor << ", heights " << bottom << " to " << top << ", spacing "
      << terrain.spacingX << ' ' << terrain.spacingY;
  }
  std::cout << "of " << count.all << " regions " << count.read << " are read, " << count.level
            << " level\n";
}

// Over a plain beside a mountain rays run far before they are above everything, and most of what
// they run over is level to them.
TEST_F(TileRegionsTest, TilesOverPlainsEqualTheWhole)
{
  Random random(Seed());
  SCOPED_TRACE("RELIEF_SEED=" + std::to_string(Seed()));
  Regions count;
  for (int k = 0; k < 40; ++k)
  {
    Terrain terrain(random.Integer(700, 1500), random.Integer(20, 200), 1.0, 1.0);
    const double place = terrain.columns * random.Uniform(0.0, 1.0);
    const double height = random.Uniform(20.0, 200.0);
    const double lift = random.Uniform(-300.0, 300.0);
    terrain.Fill(
      [&](double x, double y)
      {
        return lift + std::sin(0.3 * x) * std::cos(0.2 * y) + random.Uniform(0.0, 0.5) +
          std::max(height - std::abs(x - place), 0.0);
      });
    if (random.Chance(0.3))
    {
      terrain.At(random.Integer(0, terrain.columns - 1), random.Integer(0, terrain.rows - 1)) =
        NoData;
    }
    if (random.Chance(0.5))
    {
      Terrain turned(terrain.rows, terrain.columns);
      turned.Fill(
        [&](double x, double y) { return terrain.At(static_cast<int>(y), static_cast<int>(x)); });
      terrain = turned;
    }
    terrain.RoundToSingle();
    Both both(terrain, random.Chance(0.8));
    ASSERT_EQ(both.wrong, "");
    Scene scene = MakeLargeScene(random, terrain, both.bounds.GetBottom(), both.bounds.GetTop());
    scene.integrator = Integrator::Exact;
    scene.medium.useFloor = random.Chance(0.1);
    scene.medium.depth = random.Uniform(0.1, 3.0);
    scene.lights = { Sun(
      90.0 * random.Integer(0, 3) + random.Uniform(-10.0, 10.0), random.Uniform(5.0, 25.0)) };
    if (random.Chance(0.3))
    {
      const double high = both.bounds.GetTop() + random.Uniform(50.0, 500.0);
      scene.lights = { Lamp(random.Uniform(-1.0, 2.0) * terrain.columns,
        random.Uniform(-1.0, 2.0) * terrain.rows, high) };
    }
    AllOf expected(terrain.columns, terrain.rows, false, !scene.sun.empty());
    SceneShading(both.whole, scene, expected.target).Shade(0, terrain.columns, 0, terrain.rows);
    AllOf tiled(terrain.columns, terrain.rows, false, !scene.sun.empty());
    ShadeTiles(both, scene, 64, tiled, random, count);
    ASSERT_EQ(tiled.FindDifference(expected), "") << "case " << k;
  }
  std::cout << "of " << count.all << " regions " << count.read << " are read, " << count.level
            << " level\n";
  EXPECT_GT(count.level, count.read / 20);
}

// Not a test: what tiles cost, for a person to read. Run it by --gtest_also_run_disabled_tests; the
// size comes from RELIEF_SIZE, the sun from RELIEF_ALTITUDE, more of them from RELIEF_LIGHTS.
TEST_F(TileRegionsTest, DISABLED_Measure)
{
  const char* text = std::getenv("RELIEF_SIZE");
  const int size = text ? std::atoi(text) : 8192;
  const char* altitude = std::getenv("RELIEF_ALTITUDE");
  std::vector<float> heights(static_cast<std::size_t>(size) * size);
  MakeMountains(size, heights);
  HeightSource<float> source = SourceOf(heights, size);
  source.spacingX = source.spacingY = 30.0;
  Scene scene;
  scene.medium.depth = 30.0;
  scene.medium.offset = f64::RELIEF_TANGENT_PLANE;
  scene.medium.tolerance = 0.0003;
  scene.lights = { Sun(315.0, altitude ? std::atof(altitude) : 30.0) };
  const char* lights = std::getenv("RELIEF_LIGHTS");
  for (int k = 1; lights && k < std::atoi(lights); ++k)
  {
    scene.lights.push_back(Sun(137.5 * k, 10.0 + std::fmod(7.3 * k, 80.0)));
    scene.lights.back().weight = 0.01;
  }
  const std::size_t samples = heights.size();
  std::vector<unsigned char> expected(4 * samples);
  std::vector<unsigned char> tiled(4 * samples);
  using Clock = std::chrono::steady_clock; // there is one thread
  auto secondsSince = [](Clock::time_point begin)
  { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  Target target;
  target.width = target.rows = size;
  RasterBounds bounds;
  {
    HeightField whole;
    Clock::time_point begin = Clock::now();
    ASSERT_EQ(whole.Assign(source, RunSerial, true), "");
    const double prepared = secondsSince(begin);
    target.rgba8 = expected.data();
    begin = Clock::now();
    SceneShading(whole, scene, target).Shade(0, size, 0, size);
    std::cout << "in memory: " << prepared << " s to prepare, " << secondsSince(begin)
              << " s to shade, heights " << whole.GetBottom() << " to " << whole.GetTop() << '\n';
  }
  Clock::time_point begin = Clock::now();
  bounds.Begin(size, size);
  bounds.AddRows(heights.data(), size, size);
  std::cout << "bounds: " << secondsSince(begin) << " s, " << bounds.GetMemorySize() << " bytes\n";
  SparseHeights sparse;
  ASSERT_EQ(sparse.Reserve(bounds, 30.0, 30.0, 0.0, true), "");
  target.rgba8 = tiled.data();
  begin = Clock::now();
  SceneShading shading(sparse.GetField(), scene, target);
  const TileRegions regions(sparse, scene);
  const SparseHeights::Source rows =
    [&](int i0, int i1, int j0, int j1, float* to, std::ptrdiff_t pitch)
  {
    for (int j = j0; j < j1; ++j, to += pitch)
    {
      std::copy_n(heights.data() + static_cast<std::size_t>(j) * size + i0, i1 - i0, to);
    }
  };
  constexpr int tile = 1024;
  double finding = 0.0;
  double filling = 0.0;
  double seconds = 0.0;
  std::size_t read = 0;
  std::size_t level = 0;
  std::size_t resident = 0;
  for (int j = 0; j < size; j += tile)
  {
    for (int i = 0; i < size; i += tile)
    {
      Clock::time_point part = Clock::now();
      const TileRegions::Found found = regions.Find(i, i + tile, j, j + tile);
      finding += secondsSince(part);
      part = Clock::now();
      const std::size_t missing = sparse.FindMissing(found.read).Count();
      FillFor(sparse, found, rows, RunSerial);
      filling += secondsSince(part);
      read += missing;
      level += found.level.Count();
      part = Clock::now();
      shading.Shade(i, std::min(i + tile, size), j, std::min(j + tile, size));
      seconds += secondsSince(part);
      if ((i / tile + j / tile) % 4 == 0)
      {
        resident = std::max(resident, sparse.CountResident());
      }
    }
  }
  const double all = static_cast<double>(samples) / (64 * 64);
  std::cout << "tiles: finding " << finding << " s, filling " << filling << " s, shading "
            << seconds << " s; read " << read / all << " times, level " << level / all
            << ", resident at most " << resident / 1e6 << " MB of " << samples * 8 / 1e6 << "\n";
  EXPECT_EQ(tiled, expected);
}
