// SPDX-License-Identifier: BSD-3-Clause
//
// Regions that are left out, of which the least and the greatest height are known: what is shaded
// without them is no further from what the whole field gives than it says.
#include "SparseTerrain.h"

#include "EffectPlan.h"
#include "HeightOutline.h"
#include "SceneShading.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <limits>

using namespace relief;

class HeightOutlineTest : public OfReservedMemory
{
};

namespace
{
constexpr int RegionSize = RasterBounds::RegionSize;

bool Holds(const RegionSet& all, const RegionSet& some)
{
  RegionSet both = all;
  both.Add(some);
  return both.Count() == all.Count();
}

// A tile, and what of the regions that it depends on is filled.
struct Tile
{
  int i0, i1, j0, j1;
  TileRegions::Found found;
  RegionSet read;
  RegionSet level;
  std::size_t leftOut = 0; // of those to read
};

// Leaves out any of the regions but those that are needed.
Tile MakeTile(Random& random, const TileRegions& regions, const HeightView<float>& view)
{
  Tile tile;
  tile.i0 = random.Integer(0, view.columns - 1) / 16 * 16;
  tile.j0 = random.Integer(0, view.rows - 1) / 16 * 16;
  tile.i1 = std::min(tile.i0 + 16 * random.Integer(1, 3), view.columns);
  tile.j1 = std::min(tile.j0 + 16 * random.Integer(1, 3), view.rows);
  tile.found = regions.Find(tile.i0, tile.i1, tile.j0, tile.j1);
  EXPECT_TRUE(Holds(tile.found.read, tile.found.needed));
  tile.read = tile.found.read;
  tile.level = tile.found.level;
  const double share = random.Chance(0.2) ? 0.0 : random.Uniform(0.1, 1.0);
  for (const RegionSet::Interval& run : tile.found.read.GetIntervals())
  {
    for (int i = run.begin; i < run.end; ++i)
    {
      if (!tile.found.needed.Has(i, run.row) && random.Chance(share))
      {
        tile.read.Remove(i, run.row);
        ++tile.leftOut;
      }
    }
  }
  for (const RegionSet::Interval& run : tile.found.level.GetIntervals())
  {
    for (int i = run.begin; i < run.end; ++i)
    {
      if (random.Chance(share))
      {
        tile.level.Remove(i, run.row);
      }
    }
  }
  return tile;
}

// Fills what is there, and poisons the memory of all else.
void FillTile(Random& random, Both& both, const Tile& tile)
{
  RegionSet all(both.bounds.GetRegionColumns(), both.bounds.GetRegionRows());
  all.Add(0, all.GetColumns() - 1, 0, all.GetRows() - 1);
  both.sparse.Fill(
    all, Poison(random.Integer(0, 3), both.bounds.GetBottom(), both.bounds.GetTop()), RunSerial);
  both.sparse.Complete(RunSerial);
  RegionSet kept = tile.read;
  kept.Add(tile.level);
  both.sparse.Forget(kept);
  both.sparse.Fill(tile.read, HeightsOf(both.whole), RunSerial);
  both.sparse.Fill(tile.level,
    EachBy([&](int i, int j) { return both.bounds.RangeAt(i / 64, j / 64).hi; }), RunSerial);
  both.sparse.Complete(RunSerial);
}

// The regions of a tile that depend on nothing that is left out.
RegionSet FindWhole(const TileRegions& regions, const Tile& tile)
{
  RegionSet whole(tile.read.GetColumns(), tile.read.GetRows());
  RegionSet any = tile.read;
  any.Add(tile.level);
  for (int j = tile.j0 / RegionSize; j <= (tile.j1 - 1) / RegionSize; ++j)
  {
    for (int i = tile.i0 / RegionSize; i <= (tile.i1 - 1) / RegionSize; ++i)
    {
      const TileRegions::Found found =
        regions.Find(std::max(tile.i0, i * RegionSize), std::min(tile.i1, (i + 1) * RegionSize),
          std::max(tile.j0, j * RegionSize), std::min(tile.j1, (j + 1) * RegionSize));
      if (Holds(tile.read, found.read) && Holds(any, found.level))
      {
        whole.Add(i, i, j, j);
      }
    }
  }
  return whole;
}

// As a raster without holes has it, where rays may be long.
void FillHoles(Terrain& terrain)
{
  double least = std::numeric_limits<double>::infinity();
  for (const double height : terrain.heights)
  {
    least = height < least ? height : least;
  }
  for (double& height : terrain.heights)
  {
    height = std::isnan(height) ? (std::isfinite(least) ? least : 0.0) : height;
  }
}

// Suns near the horizon, and lamps not far above the ground.
void LowerLights(Random& random, const Terrain& terrain, const Both& both, Scene& scene)
{
  const double relief = both.bounds.GetTop() - both.bounds.GetBottom();
  scene.lights.clear();
  for (int k = random.Integer(1, 3); k > 0; --k)
  {
    scene.lights.push_back(random.Chance(0.3)
        ? Lamp(terrain.spacingX * terrain.columns * random.Uniform(-1.0, 2.0),
            terrain.spacingY * terrain.rows * random.Uniform(-1.0, 2.0),
            both.bounds.GetBottom() + relief * random.Uniform(0.5, 2.0))
        : Sun(random.Uniform(0.0, 360.0), random.Logarithmic(0.3, 20.0)));
  }
  if (random.Chance(0.5))
  {
    scene.sun = { Sun(random.Uniform(0.0, 360.0), random.Logarithmic(0.3, 20.0)) };
  }
}

// What was looked at, over all cases.
struct Tally
{
  std::uint64_t rays = 0;
  std::uint64_t open = 0;    // whose bounds differ
  std::uint64_t rough = 0;   // shaded otherwise than rounding and bounds allow, in single precision
  double furthest = 0.0;     // by how much at most
  std::uint64_t tiles = 0;   // with something left out
  std::uint64_t certain = 0; // of these, those that are as known as ever
};

// Compares the bounds of one light's d with the reference.
void CheckLight(const Both& both, const HeightOutline& outline, const Scene& scene,
  const Light& light, const Tile& tile, Tally& tally)
{
  f64::ReliefMedium medium = scene.medium;
  medium.tolerance = 0.0;
  RayCount count;
  const HeightView<float>& view = both.whole.GetField().heights;
  std::vector<glm::vec3> normals(static_cast<std::size_t>(view.columns));
  std::vector<glm::dvec3> exactNormals(normals.size());
  HeightOutline::Row row;
  for (int j = tile.j0; j < tile.j1; ++j)
  {
    RowRequest<float> request;
    request.j = j;
    request.begin = tile.i0;
    request.end = tile.i1;
    RowRequest<double> exact;
    exact.j = j;
    exact.begin = tile.i0;
    exact.end = tile.i1;
    double d[HeightOutline::MostSamples];
    double r[HeightOutline::MostSamples];
    exact.illumination = d;
    exact.thickness = r;
    if (medium.offset == f64::RELIEF_SURFACE_NORMAL)
    {
      for (int i = tile.i0; i < tile.i1; ++i)
      {
        normals[i - tile.i0] = f32::reliefNormal(both.whole.GetField(), i, j);
        exactNormals[i - tile.i0] = glm::dvec3(normals[i - tile.i0]);
      }
      request.normals = normals.data();
      exact.normals = exactNormals.data();
    }
    float dummy[HeightOutline::MostSamples];
    request.thickness = dummy; // so that r is bounded, too
    outline.TraceRow(medium, light, request, row, count);
    TraceRow<double>(both.whole.GetField(), medium, light, exact, count);
    for (int i = tile.i0; i < tile.i1; ++i)
    {
      const int k = i - tile.i0;
      if (std::isnan(view.At(i, j)))
      {
        continue;
      }
      ++tally.rays;
      tally.open += row.leastD[k] != row.greatestD[k] ? 1 : 0;
      const double off = std::max({ row.leastD[k] - d[k], d[k] - row.greatestD[k], 0.0 });
      tally.furthest = std::max(tally.furthest, off);
      EXPECT_TRUE(off < 1e-9 || IsEdge(medium, d[k], row.leastD[k]))
        << i << ", " << j << ": " << d[k] << " is not from " << row.leastD[k] << " to "
        << row.greatestD[k];
      // Where a ray grazes, or goes on beyond the data, rounding shows more.
      const double slack =
        1e-6 * (std::min({ r[k], row.leastR[k], 1e30 }) + medium.depth + view.spacingX);
      EXPECT_TRUE(r[k] >= row.leastR[k] - slack && r[k] <= row.greatestR[k] + slack)
        << i << ", " << j << ": " << r[k] << " is not from " << row.leastR[k] << " to "
        << row.greatestR[k];
    }
  }
}

// Compares what is shaded with the whole field's picture.
void CheckShading(const Both& both, const HeightOutline& outline, const Scene& scene,
  const Tile& tile, const AllOf& expected, bool thickness, Tally& tally)
{
  const HeightView<float>& view = both.whole.GetField().heights;
  AllOf shaded(view.columns, view.rows, thickness, !scene.sun.empty());
  SceneShading shading(both.sparse.GetField(), scene, shaded.target);
  shading.SetOutline(&outline);
  shading.Shade(tile.i0, tile.i1, tile.j0, tile.j1);
  const OutlineError error = shading.GetOutlineError();
  // Of the mean over the lights.
  const EffectPlan effects = PlanEffects(both.whole, scene);
  double off = 0.0;
  double sum = 0.0;
  for (const LightPlan& plan : effects.lights)
  {
    off += std::abs(plan.share) * plan.light.toleranceScale;
    sum += std::abs(plan.share) * plan.light.open;
  }
  const double allowed = sum > 0.0 ? off / sum * (error.tolerance + scene.medium.tolerance) : 0.0;
  bool equal = true;
  for (int j = tile.j0; j < tile.j1; ++j)
  {
    for (int i = tile.i0; i < tile.i1; ++i)
    {
      const std::size_t at = static_cast<std::size_t>(j) * view.columns + i;
      if (std::isnan(view.At(i, j)))
      {
        continue;
      }
      const bool same = shaded.illumination[at] == expected.illumination[at];
      equal = equal && same;
      if (outline.IsWhole(i, j))
      {
        ASSERT_TRUE(same);
        ASSERT_EQ(shaded.rgba[4 * at], expected.rgba[4 * at]);
      }
      const bool jumps = scene.medium.depth == 0.0 &&
        (shaded.illumination[at] == 0.0f) != (expected.illumination[at] == 0.0f);
      if (!jumps && scene.integrator == Integrator::Exact)
      {
        // What single precision has, see Documentation/Model.md.
        const double beside = std::abs(shaded.illumination[at] - expected.illumination[at]);
        tally.rough += beside > allowed + 1e-5 ? 1 : 0;
        EXPECT_LE(beside, allowed + 1e-3) << i << ", " << j;
      }
      if (scene.integrator == Integrator::FixedStep && error.tolerance == 0.0)
      {
        EXPECT_TRUE(same);
      }
      if (!scene.sun.empty() && !error.shadow)
      {
        EXPECT_EQ(shaded.shadow[at], expected.shadow[at]) << i << ", " << j;
      }
      if (thickness && !error.thickness && scene.integrator == Integrator::Exact)
      {
        const double r = expected.thickness[at];
        EXPECT_TRUE(shaded.thickness[at] == expected.thickness[at] ||
          std::abs(shaded.thickness[at] - r) <= 1e-2 * (r + view.spacingX))
          << i << ", " << j << ": " << shaded.thickness[at] << " is not " << r;
      }
    }
  }
  tally.tiles += tile.leftOut > 0 ? 1 : 0;
  tally.certain +=
    tile.leftOut > 0 && error.tolerance == 0.0 && !error.thickness && !error.shadow ? 1 : 0;
}
}

TEST_F(HeightOutlineTest, WhatIsLeftOutIsBounded)
{
  const int only = std::getenv("RELIEF_CASE") ? std::atoi(std::getenv("RELIEF_CASE")) : -1;
  const int cases = std::getenv("RELIEF_CASES") ? std::atoi(std::getenv("RELIEF_CASES")) : 60;
  Tally tally;
  for (int k = 0; k < cases; ++k)
  {
    if (only >= 0 && k != only)
    {
      continue;
    }
    SCOPED_TRACE("RELIEF_SEED=" + std::to_string(Seed()) + " RELIEF_CASE=" + std::to_string(k));
    Random random(Seed() + 1000003ull * k);
    Terrain terrain = MakeLargeTerrain(random, random.Integer(200, 900), random.Integer(200, 700));
    // Of few digits, the same in both precisions.
    terrain.spacingX = std::round(1024.0 * terrain.spacingX) / 1024.0;
    terrain.spacingY = std::round(1024.0 * terrain.spacingY) / 1024.0;
    if (random.Chance(0.7))
    {
      FillHoles(terrain);
    }
    Both both(terrain, random.Chance(0.8));
    ASSERT_EQ(both.wrong, "");
    if (!both.whole.HasData())
    {
      continue;
    }
    Scene scene = MakeLargeScene(random, terrain, both.bounds.GetBottom(), both.bounds.GetTop());
    if (random.Chance(0.7))
    {
      LowerLights(random, terrain, both, scene);
    }
    const bool thickness = random.Chance(0.3);
    AllOf expected(terrain.columns, terrain.rows, thickness, !scene.sun.empty());
    SceneShading shading(both.whole, scene, expected.target);
    const TileRegions regions(both.sparse, scene);
    for (int part = 0; part < 3; ++part)
    {
      const Tile tile = MakeTile(random, regions, both.whole.GetField().heights);
      FillTile(random, both, tile);
      shading.Shade(tile.i0, tile.i1, tile.j0, tile.j1);
      const HeightOutline outline(both.sparse, FindWhole(regions, tile));
      for (const LightPlan& plan : PlanEffects(both.whole, scene).lights)
      {
        if (!plan.dark && scene.integrator == Integrator::Exact)
        {
          CheckLight(both, outline, scene, plan.light, tile, tally);
        }
      }
      CheckShading(both, outline, scene, tile, expected, thickness, tally);
      if (testing::Test::HasFailure())
      {
        FAIL() << terrain.columns << " x " << terrain.rows << ", tile " << tile.i0 << " to "
               << tile.i1 << ", " << tile.j0 << " to " << tile.j1 << ", t " << scene.medium.depth
               << ", offset " << scene.medium.offset << ", floor " << scene.medium.useFloor
               << ", tolerance " << scene.medium.tolerance;
      }
    }
  }
  std::cout << "of " << tally.rays << " rays " << tally.open
            << " are uncertain, none is further from "
            << "its bounds than " << tally.furthest << ", " << tally.rough
            << " are rounded more than usual; of " << tally.tiles << " tiles " << tally.certain
            << " are certain all the same\n";
  if (only < 0)
  {
    EXPECT_GT(tally.open, tally.rays / 100);
    EXPECT_GT(tally.tiles, 50u);
    EXPECT_GT(tally.certain, 0u);
    EXPECT_LT(tally.rough, tally.rays / 1000);
  }
}
