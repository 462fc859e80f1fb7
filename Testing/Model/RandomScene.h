// SPDX-License-Identifier: BSD-3-Clause
#ifndef RandomScene_h
#define RandomScene_h

/// @file
/// Random fields, media and lights that reach every branch of the model: sizes from one sample up,
/// spacings that differ, noise, hills and terraces from nearly flat to far steeper than terrain,
/// holes, floors, all offsets, both attenuations, and lights near, far, below and along the axes.

#include "TestTerrain.h"

#include <algorithm>
#include <ostream>

struct RandomScene
{
  Terrain terrain;
  relief::f64::ReliefMedium medium;
  relief::Light light;
  double relief = 0.0; ///< greatest height difference, in lengths
};

/// Takes data away in one of several patterns; at least one sample keeps it.
inline void Pierce(Terrain& terrain, Random& random)
{
  int kept = random.Integer(0, static_cast<int>(terrain.heights.size()) - 1);
  double height = terrain.heights[kept];
  int pattern = random.Integer(0, 4);
  double share = random.Chance(0.5) ? 0.02 : 0.3;
  int edge = random.Integer(0, terrain.columns - 1);
  double cx = random.Uniform(0.0, terrain.columns);
  double cy = random.Uniform(0.0, terrain.rows);
  double radius = random.Uniform(1.0, 0.5 * std::max(terrain.columns, terrain.rows) + 1.0);
  for (int j = 0; j < terrain.rows; ++j)
  {
    for (int i = 0; i < terrain.columns; ++i)
    {
      bool missing = false;
      switch (pattern)
      {
        case 0: // here and there
          missing = random.Chance(share);
          break;
        case 1: // a lake
          missing = std::hypot(i - cx, j - cy) < radius;
          break;
        case 2: // a map sheet that ends early
          missing = i > edge;
          break;
        case 3: // scan lines lost
          missing = j % 5 == 2;
          break;
        default: // a map sheet that stands askew in its image
          missing = std::abs(i - cx) + std::abs(j - cy) > radius;
      }
      if (missing)
      {
        terrain.At(i, j) = NoData;
      }
    }
  }
  terrain.heights[kept] = height;
}

inline RandomScene MakeRandomScene(Random& random)
{
  RandomScene scene;
  double unit = random.Logarithmic(0.01, 1000.0);
  int columns = random.Chance(0.1) ? random.Integer(1, 3) : random.Integer(4, 70);
  int rows = random.Chance(0.1) ? random.Integer(1, 3) : random.Integer(4, 50);
  Terrain terrain(
    columns, rows, unit, unit * (random.Chance(0.5) ? 1.0 : random.Uniform(0.4, 2.5)));

  scene.relief = unit * random.Logarithmic(0.01, 100.0);
  double lift = random.Chance(0.3) ? scene.relief * random.Uniform(-3.0, 3.0) : 0.0;
  int kind = random.Integer(0, 3);
  double waves[4];
  for (double& wave : waves)
  {
    wave = random.Uniform(0.05, 0.7);
  }
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      double hills = 0.5 +
        0.25 * (std::sin(waves[0] * i + waves[1] * j) + std::cos(waves[2] * i - waves[3] * j));
      double noise = random.Uniform(0.0, 1.0);
      double share = kind == 0 ? noise
        : kind == 1            ? hills
        : kind == 2            ? std::floor(hills * 5.0) / 5.0 // terraces
                               : 0.9 * hills + 0.1 * noise;
      terrain.At(i, j) = lift + scene.relief * share;
    }
  }
  if (random.Chance(0.5))
  {
    Pierce(terrain, random);
  }
  terrain.RoundToSingle();
  scene.terrain = terrain;

  double depth = unit * (random.Chance(0.7) ? random.Logarithmic(0.01, 10.0) : 1.0);
  scene.medium = Sunk(depth, AllOffsets[random.Integer(0, 2)]);
  if (random.Chance(0.3))
  {
    scene.medium.attenuation = relief::f64::RELIEF_EXPONENTIAL;
    scene.medium.density = random.Logarithmic(0.1, 10.0) / unit;
  }
  if (random.Chance(0.2))
  {
    scene.medium = WithFloor(scene.medium, lift + scene.relief * random.Uniform(-1.0, 1.0));
  }

  if (random.Chance(0.4))
  {
    double x = unit * random.Uniform(-0.5, 1.5) * columns;
    double y = unit * random.Uniform(-0.5, 1.5) * rows;
    double z = lift + scene.relief * random.Uniform(-0.2, 4.0);
    if (random.Chance(0.2))
    {
      // Upright above a sample.
      x = random.Integer(0, columns - 1) * terrain.spacingX;
      y = random.Integer(0, rows - 1) * terrain.spacingY;
    }
    scene.light = Lamp(x, y, z);
  }
  else
  {
    double azimuth = random.Chance(0.3) ? 45.0 * random.Integer(0, 7) : random.Uniform(0.0, 360.0);
    double altitude = random.Chance(0.1) ? 90.0
      : random.Chance(0.05)              ? 0.0
      : random.Chance(0.1)               ? random.Uniform(-30.0, 0.0)
                                         : random.Logarithmic(0.1, 90.0);
    scene.light = Sun(azimuth, altitude);
  }
  if (random.Chance(0.1))
  {
    scene.medium.depth = 0.0;
  }
  return scene;
}

/// Whether two ways to compute d stand at different sides of a shadow's edge: at depth 0 the
/// reciprocal attenuation lets nothing through the thinnest shadow, so that rounding decides.
inline bool IsEdge(const relief::f64::ReliefMedium& medium, double a, double b)
{
  return medium.depth == 0.0 && medium.attenuation == relief::f64::RELIEF_RECIPROCAL &&
    (a == 0.0) != (b == 0.0);
}

inline std::ostream& operator<<(std::ostream& out, const RandomScene& scene)
{
  const relief::Light& light = scene.light;
  return out << scene.terrain.columns << " x " << scene.terrain.rows << " samples, spacing "
             << scene.terrain.spacingX << " x " << scene.terrain.spacingY << ", relief "
             << scene.relief << ", t " << scene.medium.depth << ", offset " << scene.medium.offset
             << ", attenuation " << scene.medium.attenuation << " x " << scene.medium.density
             << ", floor " << (scene.medium.useFloor ? scene.medium.floorHeight : NoData) << ", "
             << (light.positional ? "light at " : "light toward ") << light.vector.x << ' '
             << light.vector.y << ' ' << light.vector.z;
}

#endif
