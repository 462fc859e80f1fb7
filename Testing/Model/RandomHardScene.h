// SPDX-License-Identifier: BSD-3-Clause
#ifndef RandomHardScene_h
#define RandomHardScene_h

/// @file
/// Random scenes that prefer what is hard: whole numbers that make rays run along the surface, suns
/// along the axes and the diagonals or a unit in the last place beside them, lamps at samples, on
/// the surface, next to it and far away, depths from 0 to beyond everything, holes and floors.

#include "HardScene.h"

#include <iterator>

inline void FillHard(Terrain& terrain, double relief, Random& random)
{
  const int kind = random.Integer(0, 4);
  const int slopeX = random.Integer(-2, 2);
  const int slopeY = random.Integer(-2, 2);
  for (int j = 0; j < terrain.rows; ++j)
  {
    for (int i = 0; i < terrain.columns; ++i)
    {
      double& h = terrain.At(i, j);
      switch (kind)
      {
        case 0: // whole numbers
          h = random.Integer(0, 3);
          break;
        case 1: // noise
          h = random.Uniform(0.0, 1.0);
          break;
        case 2: // a plane, dented here and there
          h = slopeX * i + slopeY * j - (random.Chance(0.1) ? random.Integer(0, 2) : 0);
          break;
        case 3: // spikes
          h = random.Chance(0.1) ? random.Uniform(0.0, 10.0) : 0.0;
          break;
        default: // a gable
          h = -std::abs(2 * i - terrain.columns + 1) * (slopeX + 3) / 2;
      }
      h *= relief;
    }
  }
  const double lift = random.Chance(0.2) ? relief * random.Uniform(-50.0, 50.0) : 0.0;
  for (double& h : terrain.heights)
  {
    h += lift;
  }
  terrain.RoundToSingle();
  const double missing = random.Chance(0.3) ? random.Uniform(0.0, 0.9) : 0.0;
  for (double& h : terrain.heights)
  {
    h = random.Chance(missing) ? (random.Chance(0.1) ? -Infinite : NoData) : h;
  }
}

inline relief::Light HardSun(Random& random)
{
  double azimuth = random.Chance(0.5) ? 45.0 * random.Integer(0, 7) : random.Uniform(0.0, 360.0);
  azimuth = random.Chance(0.2) ? std::nextafter(azimuth, 400.0) : azimuth;
  const double altitudes[] = { 0.0, 1e-6, -1e-6, 45.0, std::atan(0.5) * 180.0 / Pi, 90.0,
    std::atan(std::sqrt(0.5)) * 180.0 / Pi };
  const double altitude = random.Chance(0.5)
    ? altitudes[random.Integer(0, static_cast<int>(std::size(altitudes)) - 1)]
    : random.Logarithmic(0.1, 90.0);
  return Sun(azimuth, altitude);
}

inline relief::Light HardLamp(const Terrain& terrain, double depth, double relief, Random& random)
{
  const int i = random.Integer(0, terrain.columns - 1);
  const int j = random.Integer(0, terrain.rows - 1);
  const double h = std::isfinite(terrain.At(i, j)) ? terrain.At(i, j) : 0.0;
  const double x = i * terrain.spacingX;
  const double y = j * terrain.spacingY;
  switch (random.Integer(0, 5))
  {
    case 0: // at a sample, at its sunken point, above and below
      return Lamp(x, y, h + random.Integer(-2, 2) * depth);
    case 1: // on the surface, between samples
      return Lamp(x + terrain.spacingX * random.Integer(0, 2) / 2.0, y, h);
    case 2: // beside a sample
      return Lamp(x + 1e-6 * terrain.spacingX * random.Uniform(-1.0, 1.0), y,
        h + relief * random.Uniform(-1e-6, 1e-6));
    case 3: // far away
      return Lamp(x + 1e9 * terrain.spacingX * random.Uniform(-1.0, 1.0),
        y + 1e9 * terrain.spacingY * random.Uniform(-1.0, 1.0),
        1e9 * (relief + terrain.spacingX) * random.Uniform(0.0, 1.0));
    default:
      return Lamp(terrain.spacingX * random.Uniform(-0.5, 1.5) * terrain.columns,
        terrain.spacingY * random.Uniform(-0.5, 1.5) * terrain.rows,
        h + relief * random.Uniform(-0.5, 5.0));
  }
}

inline HardScene MakeRandomHardScene(Random& random)
{
  HardScene scene;
  const double unit = random.Chance(0.5) ? 1.0 : random.Logarithmic(1e-3, 1e3);
  const double ratio = random.Chance(0.7) ? 1.0 : random.Logarithmic(1e-3, 1e3);
  const int largest = random.Chance(0.1) ? 24 : 8;
  scene.terrain =
    Terrain(random.Integer(1, largest), random.Integer(1, largest / 2), unit, unit * ratio);
  const double relief = random.Chance(0.5) ? unit
    : random.Chance(0.1)                   ? unit * random.Logarithmic(1e-12, 1e12)
                                           : unit * random.Logarithmic(1e-3, 1e3);
  FillHard(scene.terrain, relief, random);

  const int offset = AllOffsets[random.Integer(0, 2)];
  // So near the surface that a point beside it has no digits of its own, only below it.
  const double depths[] = { 0.0, 1e-6 * unit, 1e9 * unit, 1e-280, 1e-40 * unit };
  const int shallow = offset == relief::f64::RELIEF_SURFACE_NORMAL ? 2 : 4;
  const double depth = random.Chance(0.4) ? unit
    : random.Chance(0.4)                  ? depths[random.Integer(0, shallow)]
                                          : unit * random.Logarithmic(1e-2, 1e2);
  scene.medium = Sunk(depth, offset);
  if (random.Chance(0.2))
  {
    scene.medium.attenuation = relief::f64::RELIEF_EXPONENTIAL;
    const double densities[] = { 0.0, 1e30, 1.0 / unit, 0.1 / unit, 10.0 / unit };
    scene.medium.density = densities[random.Integer(0, 4)];
    // For which float takes the limit, and that of a level ray is another.
    scene.medium.depth = depth > 0.0 && depth < 1e-30 ? unit : depth;
  }
  if (random.Chance(0.2) && !(depth > 0.0 && depth < 1e-30))
  {
    double h =
      scene.terrain.heights[random.Integer(0, static_cast<int>(scene.terrain.heights.size()) - 1)];
    h = std::isfinite(h) ? h : 0.0;
    scene.medium = WithFloor(scene.medium, h - random.Integer(-1, 2) * depth);
  }

  const int lights = random.Integer(1, 3);
  for (int k = 0; k < lights; ++k)
  {
    // So close to a sample a lamp has no digits in float.
    const double beside = depth < 1e-30 ? 0.0 : depth;
    scene.lights.push_back(
      random.Chance(0.6) ? HardSun(random) : HardLamp(scene.terrain, beside, relief, random));
  }
  return scene;
}

#endif
