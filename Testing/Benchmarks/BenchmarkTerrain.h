// SPDX-License-Identifier: BSD-3-Clause
#ifndef BenchmarkTerrain_h
#define BenchmarkTerrain_h

/// @file
/// The height fields that are measured. All are the same on every run and machine.

#include "HeightField.h"

#include <memory>
#include <string>
#include <vector>

namespace bench
{

/// Heights and the distance between them, in one unit; row 0 is the southernmost.
struct Relief
{
  std::string name;
  int columns = 0;
  int rows = 0;
  double spacing = 1.0;
  std::vector<float> heights;
};

/// Spacing at which 2048 samples span the example terrain from west to east, in metres.
constexpr double TerrainSpacing = 403 * 74.6 / 2048;

/// The example terrain (Examples/Data/jacksboro.tif), smoothed by cubic B-splines, with fractal
/// detail finer than its own samples down to the given spacing. Beyond its edges it goes on as its
/// own mirror image, while the detail never repeats: so a larger field has more of the same ground.
/// The first sample stands `first` samples from the tile's corner along x and y.
Relief Terrain(int columns, int rows, double spacing = TerrainSpacing, int first = 0);

/// A bas-relief: the examples' medallion, or so many samples square from its middle.
Relief Medallion(int size = 900);

/// Blocks of houses with flat roofs, vertical walls, yards and streets, a metre a sample.
Relief City(int columns, int rows);

/// A hill without any roughness, 20 degrees steep at most.
Relief Dome(int columns, int rows);

/// Every sample a random height of its own, within two samples' spacing.
Relief WhiteNoise(int columns, int rows);

/// A relief's mean angle of slope, in degrees.
double MeanSlope(const Relief& relief);

/// Prepares a relief as the filter does, on one thread.
std::unique_ptr<relief::HeightField> Prepare(const Relief& relief, bool padded = true);

}

#endif
