// SPDX-License-Identifier: BSD-3-Clause
#ifndef SparseTerrain_h
#define SparseTerrain_h

/// @file
/// A field in memory, the same as a sparse one, and random scenes over large fields, for the tests
/// of shading tile by tile.

#include "RandomScene.h"
#include "ScenePicture.h"

#include "RasterBounds.h"
#include "SparseHeights.h"
#include "TileRegions.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

/// A test that needs memory to be reserved, which not every system can.
class OfReservedMemory : public testing::Test
{
protected:
  void SetUp() override
  {
    if (!relief::CanReserveMemory())
    {
      GTEST_SKIP() << "this system reserves no memory";
    }
  }
};

/// A source that gives every sample what height(i, j) says.
template <class Height>
relief::SparseHeights::Source EachBy(Height height)
{
  return [=](int i0, int i1, int j0, int j1, float* heights, std::ptrdiff_t pitch)
  {
    for (int j = j0; j < j1; ++j)
    {
      for (int i = i0; i < i1; ++i)
      {
        heights[(j - j0) * pitch + i - i0] = height(i, j);
      }
    }
  };
}

/// The heights of a field, as a file would give them.
inline relief::SparseHeights::Source HeightsOf(const relief::HeightField& field)
{
  const relief::HeightView<float>* view = &field.GetField().heights;
  return EachBy([=](int i, int j) { return view->At(i, j); });
}

/// The bounds of a field's rows, given some at a time.
inline relief::RasterBounds BoundsOf(const relief::HeightField& field, int rowsAtATime = 7)
{
  const relief::HeightView<float>& view = field.GetField().heights;
  relief::RasterBounds bounds;
  bounds.Begin(view.columns, view.rows);
  for (int j = 0; j < view.rows; j += rowsAtATime)
  {
    bounds.AddRows(view.data + j * view.stepY, view.stepY, std::min(rowsAtATime, view.rows - j));
  }
  return bounds;
}

/// All that a scene can give, as flat arrays with their numbers a sample.
struct AllOf
{
  std::vector<float> rgba, illumination, thickness, shadow, normals, base, diffuse, scatter,
    specular;
  std::vector<unsigned char> rgba8;
  relief::Target target;

  AllOf(int columns, int rows, bool withThickness, bool withShadow)
  {
    const std::size_t samples = static_cast<std::size_t>(columns) * rows;
    auto layer = [&](std::vector<float>& values, int components)
    {
      values.assign(samples * components, -7.0f);
      return values.data();
    };
    target.width = columns;
    target.rows = rows;
    target.rgba = layer(rgba, 4);
    rgba8.assign(samples * 4, 77);
    target.rgba8 = rgba8.data();
    target.illumination = layer(illumination, 1);
    target.thickness = withThickness ? layer(thickness, 1) : nullptr;
    target.shadow = withShadow ? layer(shadow, 1) : nullptr;
    target.normals = layer(normals, 3);
    target.base = layer(base, 3);
    target.diffuse = layer(diffuse, 3);
    target.scatter = layer(scatter, 3);
    target.specular = layer(specular, 3);
  }

  /// The first sample and layer that differ from another's, in words; empty if none does.
  std::string FindDifference(const AllOf& other) const
  {
    auto compare = [&](const char* name, const std::vector<float>& a, const std::vector<float>& b,
                     int components)
    {
      for (std::size_t k = 0; k < a.size(); ++k)
      {
        if (!(a[k] == b[k] || (std::isnan(a[k]) && std::isnan(b[k]))))
        {
          const std::size_t sample = k / components;
          return std::string(name) + " at (" + std::to_string(sample % target.width) + ", " +
            std::to_string(sample / target.width) + "): " + std::to_string(a[k]) + " is not " +
            std::to_string(b[k]);
        }
      }
      return std::string();
    };
    std::string found = compare("thickness", thickness, other.thickness, 1);
    found = found.empty() ? compare("illumination", illumination, other.illumination, 1) : found;
    found = found.empty() ? compare("shadow", shadow, other.shadow, 1) : found;
    found = found.empty() ? compare("normals", normals, other.normals, 3) : found;
    found = found.empty() ? compare("base", base, other.base, 3) : found;
    found = found.empty() ? compare("diffuse", diffuse, other.diffuse, 3) : found;
    found = found.empty() ? compare("scatter", scatter, other.scatter, 3) : found;
    found = found.empty() ? compare("specular", specular, other.specular, 3) : found;
    found = found.empty() ? compare("rgba", rgba, other.rgba, 4) : found;
    return found.empty() && rgba8 != other.rgba8 ? "rgba8" : found;
  }
};

/// Heights with what makes rays go far: hills, steps, spikes, coasts.
inline Terrain MakeLargeTerrain(Random& random, int columns, int rows)
{
  const double unit = random.Logarithmic(0.1, 100.0);
  Terrain terrain(
    columns, rows, unit, unit * (random.Chance(0.5) ? 1.0 : random.Logarithmic(0.3, 3.0)));
  const double relief = unit * random.Logarithmic(0.3, 60.0);
  const int kind = random.Integer(0, 4);
  double waves[4];
  for (double& wave : waves)
  {
    wave = random.Logarithmic(0.01, 0.4);
  }
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      const double hills = 0.5 +
        0.25 * (std::sin(waves[0] * i + waves[1] * j) + std::cos(waves[2] * i - waves[3] * j));
      const double noise = random.Uniform(0.0, 1.0);
      double& h = terrain.At(i, j);
      switch (kind)
      {
        case 0:
          h = 0.9 * hills + 0.1 * noise;
          break;
        case 1: // steps
          h = std::floor(5.0 * hills) / 5.0;
          break;
        case 2: // spikes on a plain
          h = random.Chance(0.001) ? noise : 0.02 * hills;
          break;
        case 3: // a mountain in a plain
          h = 0.05 * hills +
            0.95 *
              std::exp(-1e-3 * (std::pow(i - columns / 2.0, 2.0) + std::pow(j - rows / 3.0, 2.0)));
          break;
        default: // a slope
          h = (waves[0] * i + waves[1] * j) / 100.0 + 0.05 * noise;
      }
      h *= relief;
    }
  }
  const double lift = random.Chance(0.6) ? relief * random.Uniform(-3.0, 3.0) : 0.0;
  const bool coast = random.Chance(0.3);
  const double scattered = random.Chance(0.2) ? random.Logarithmic(1e-4, 0.3) : 0.0;
  const bool lake = random.Chance(0.2);
  const double cx = random.Uniform(0.0, columns);
  const double cy = random.Uniform(0.0, rows);
  const double radius = random.Uniform(1.0, 0.4 * std::max(columns, rows) + 1.0);
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      double& h = terrain.At(i, j);
      const bool missing = (coast && h < 0.15 * relief) ||
        (scattered > 0.0 && random.Chance(scattered)) ||
        (lake && std::hypot(i - cx, j - cy) < radius);
      h = missing ? NoData : h + lift;
    }
  }
  terrain.RoundToSingle();
  return terrain;
}

/// A light of any kind: high and low suns, some along the axes, and lamps near and far.
inline relief::Light MakeAnyLight(Random& random, const Terrain& terrain, double bottom, double top)
{
  if (random.Chance(0.3))
  {
    const bool far = random.Chance(0.3);
    const double reach = far ? 1000.0 : 1.5;
    const double x = terrain.spacingX * terrain.columns * random.Uniform(1.0 - reach, reach);
    const double y = terrain.spacingY * terrain.rows * random.Uniform(1.0 - reach, reach);
    return Lamp(x, y, bottom + (top - bottom) * random.Uniform(-0.3, far ? 3000.0 : 4.0));
  }
  const double azimuth =
    random.Chance(0.3) ? 45.0 * random.Integer(0, 7) : random.Uniform(0.0, 360.0);
  const double altitude = random.Chance(0.05) ? 0.0
    : random.Chance(0.05)                     ? 90.0
    : random.Chance(0.1)                      ? -random.Uniform(0.0, 40.0)
                                              : random.Logarithmic(1.0, 90.0);
  return Sun(azimuth, altitude);
}

inline relief::Scene MakeLargeScene(
  Random& random, const Terrain& terrain, double bottom, double top)
{
  relief::Scene scene;
  scene.base = glm::dvec3(0.05, 0.1, 0.02);
  scene.diffuse = glm::dvec3(0.9, 0.6, 0.3);
  scene.specularCoefficient = random.Chance(0.5) ? 0.3 : 0.0;
  scene.scatterCoefficient = random.Chance(0.3) ? 0.4 : 0.0;
  scene.scatterFalloff = { -1.0, 1.0, 2.0 };
  const double unit = terrain.spacingX;
  const double depth =
    random.Chance(0.15) ? 0.0 : unit * random.Logarithmic(0.1, random.Chance(0.1) ? 3000.0 : 30.0);
  scene.medium = Sunk(depth, AllOffsets[random.Integer(0, 2)]);
  if (random.Chance(0.3))
  {
    scene.medium.attenuation = relief::f64::RELIEF_EXPONENTIAL;
    scene.medium.density = random.Logarithmic(0.01, 10.0) / unit;
  }
  if (random.Chance(0.25))
  {
    scene.medium = WithFloor(scene.medium, bottom + (top - bottom) * random.Uniform(-0.5, 0.7));
  }
  const double tolerances[] = { 0.0, 0.0003, 0.02 };
  scene.medium.tolerance = tolerances[random.Integer(0, 2)];
  scene.lights.push_back(MakeAnyLight(random, terrain, bottom, top));
  if (random.Chance(0.3))
  {
    scene.lights.push_back(MakeAnyLight(random, terrain, bottom, top));
  }
  if (random.Chance(0.2))
  {
    // A dome of a few.
    for (int k = 0; k < 8; ++k)
    {
      relief::Light light = Sun(45.0 * k + 10.0, 15.0 + 8.0 * k);
      light.weight = 0.125;
      light.toleranceScale = 0.5;
      scene.lights.push_back(light);
    }
  }
  if (random.Chance(0.5))
  {
    const double azimuth = random.Uniform(0.0, 360.0);
    const double altitude = random.Logarithmic(1.0, 90.0);
    for (int k = 0; k < 3; ++k)
    {
      scene.sun.push_back(Sun(azimuth + k, altitude - k));
    }
  }
  if (random.Chance(0.05))
  {
    scene.integrator = relief::Integrator::FixedStep;
    scene.steps = 40;
  }
  return scene;
}

/// Fills a sparse field with what TileRegions finds for a tile, all else forgotten.
inline void FillFor(relief::SparseHeights& sparse, const relief::TileRegions::Found& found,
  const relief::SparseHeights::Source& source, const relief::ParallelFor& parallelFor)
{
  relief::RegionSet wanted = found.read;
  wanted.Add(found.level);
  sparse.Forget(wanted);
  sparse.Fill(sparse.FindMissing(found.read), source, parallelFor);
  sparse.FillLevel(found.level, parallelFor);
  sparse.Complete(parallelFor);
}

/// Runs parts on four threads.
inline void RunOnFour(int count, const std::function<void(int, int)>& body)
{
  std::vector<std::thread> threads;
  for (int k = 0; k < 4; ++k)
  {
    threads.emplace_back([&, k]() { body(count * k / 4, count * (k + 1) / 4); });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
}

/// A terrain in memory and sparse.
struct Both
{
  relief::HeightField whole;
  relief::RasterBounds bounds;
  relief::SparseHeights sparse;
  std::string wrong;

  Both(const Terrain& terrain, bool padded)
  {
    this->wrong = Assign(terrain, this->whole, padded);
    this->bounds = BoundsOf(this->whole);
    if (this->wrong.empty())
    {
      this->wrong = this->sparse.Reserve(
        this->bounds, terrain.spacingX, terrain.spacingY, this->whole.GetDatum(), padded);
    }
  }
};

/// Heights that would change the picture, wherever it depended on them.
inline relief::SparseHeights::Source Poison(int kind, float bottom, float top)
{
  return EachBy(
    [=](int i, int j)
    {
      const float wild = i * 7 % 5 + j * 3 % 4 < 3 ? top + (top - bottom) : bottom;
      return kind == 0 ? std::numeric_limits<float>::quiet_NaN()
        : kind == 1    ? top + 10.0f * (top - bottom)
        : kind == 2    ? bottom - 10.0f * (top - bottom)
                       : wild;
    });
}

/// Regions that tiles need, of all.
struct Regions
{
  std::uint64_t read = 0;
  std::uint64_t level = 0;
  std::uint64_t all = 0;
};

/// Shades a sparse field tile by tile, with all that a tile does not need poisoned or forgotten.
inline void ShadeTiles(
  Both& both, const relief::Scene& scene, int tile, AllOf& picture, Random& random, Regions& count)
{
  const relief::HeightView<float>& view = both.sparse.GetField().GetField().heights;
  relief::RegionSet all(both.bounds.GetRegionColumns(), both.bounds.GetRegionRows());
  all.Add(0, all.GetColumns() - 1, 0, all.GetRows() - 1);
  relief::SceneShading shading(both.sparse.GetField(), scene, picture.target);
  const relief::TileRegions regions(both.sparse, scene);
  const relief::SparseHeights::Source source = HeightsOf(both.whole);
  const relief::SparseHeights::Source levels =
    EachBy([&](int i, int j) { return both.bounds.RangeAt(i / 64, j / 64).hi; });
  bool poisoned = false;
  relief::RegionSet before;
  for (int j = 0; j < view.rows; j += tile)
  {
    for (int i = 0; i < view.columns; i += tile)
    {
      const int i1 = std::min(i + tile, view.columns);
      const int j1 = std::min(j + tile, view.rows);
      const relief::TileRegions::Found found = regions.Find(i, i1, j, j1);
      count.read += found.read.Count();
      count.level += found.level.Count();
      count.all += all.Count();
      const int kind = random.Integer(0, 7);
      if (kind < 4)
      {
        // What is not filled for this tile is poisoned, most of it from before.
        both.sparse.Fill(poisoned ? before : all,
          Poison(kind, both.bounds.GetBottom(), both.bounds.GetTop()), RunSerial);
        both.sparse.Complete(RunSerial);
        both.sparse.Fill(found.read, source, RunSerial);
        both.sparse.Fill(found.level, levels, RunSerial);
        both.sparse.Complete(RunSerial);
      }
      else
      {
        if (poisoned)
        {
          both.sparse.Forget(relief::RegionSet(all.GetColumns(), all.GetRows()));
        }
        FillFor(both.sparse, found, source, RunSerial);
      }
      poisoned = kind < 4;
      before = found.read;
      before.Add(found.level);
      shading.Shade(i, i1, j, j1);
    }
  }
}

#endif
