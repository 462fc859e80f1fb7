// SPDX-License-Identifier: BSD-3-Clause
#ifndef SweptRows_h
#define SweptRows_h

/// @file
/// A whole field in lockstep, for tests and benchmarks.

#include "SweepThickness.h"

#include <algorithm>

/// Whether r is asked for beside d.
enum class SweptLayers
{
  Illumination,
  Thickness
};

/// Sweeps the tiles of a field and calls keep(i, j, size, d, r) for the rows of each that are in
/// the image: `size` samples from (i, j) on. r is null unless it is asked for.
template <class Keep>
void ForEachSweptRow(const relief::HeightField& field, const relief::f64::ReliefMedium& medium,
  const relief::Light& light, SweptLayers layers, relief::RayCount& count, Keep&& keep)
{
  using relief::SweepThickness;
  const relief::HeightView<float>& heights = field.GetField().heights;
  const SweepThickness sweep(field, medium, light);
  float d[SweepThickness::TileSize];
  float thickness[SweepThickness::TileSize];
  float* const r = layers == SweptLayers::Thickness ? thickness : nullptr;
  for (int y = 0; y < heights.rows; y += SweepThickness::TileHeight)
  {
    const int rows = std::min(SweepThickness::TileHeight, heights.rows - y);
    for (int x = 0; x < heights.columns; x += SweepThickness::TileWidth)
    {
      const int columns = std::min(SweepThickness::TileWidth, heights.columns - x);
      sweep.IlluminateTile(
        x / SweepThickness::TileWidth, y / SweepThickness::TileHeight, d, r, count);
      for (int j = 0; j < rows; ++j)
      {
        const int at = j * SweepThickness::TileWidth;
        keep(x, y + j, columns, d + at, r ? r + at : nullptr);
      }
    }
  }
}

#endif
