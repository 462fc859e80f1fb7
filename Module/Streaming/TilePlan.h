// SPDX-License-Identifier: BSD-3-Clause
#ifndef TilePlan_h
#define TilePlan_h

/// @file
/// Which tiles of a web map a raster lies in. Not installed.

#include "Raster.h"

#include "vtkIOReliefStreamingModule.h" // For export macro

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace relief::streaming
{
/// Half of the side of the square that web maps make of the Earth, in their metres.
constexpr double MercatorHalf = 20037508.342789244;
/// Where that square ends, in degrees north and south.
constexpr double MercatorLatitude = 85.05112877980659;
/// The greatest zoom that can be asked for.
constexpr int GreatestZoom = 24;

/// Tiles side by side, the first and the last column and row.
struct TileSpan
{
  std::int64_t Columns[2];
  std::int64_t Rows[2]; ///< from the north
};

/// The tiles of a raster, from the least zoom to the greatest.
struct VTKIORELIEFSTREAMING_EXPORT TilePlan
{
  int Size = 256; ///< samples of a tile's side
  std::array<int, 2> Zoom{ 0, 0 };
  /// West, south, east and north, in degrees. Of a raster that lies on both sides of 180 degrees
  /// west is the greater one.
  std::array<double, 4> Bounds{ 0.0, 0.0, 0.0, 0.0 };
  /// What a sample of the raster has of the map's metres, as a median.
  double Resolution = 1.0;
  /// At the greatest zoom: one span, or two on both sides of 180 degrees.
  std::vector<TileSpan> Finest;

  /// All of them and what is between: every column where there are two spans.
  TileSpan Around() const;
  /// At any zoom from 0 to the greatest.
  std::vector<TileSpan> At(int zoom) const;
};

/// The metres of the map that a sample of a tile has.
VTKIORELIEFSTREAMING_EXPORT double ResolutionOf(int zoom, int size);

/// Plans the tiles of a raster of so many columns and rows. The zoom is as given, or from the one
/// at which the raster fits into one tile or two to the one whose resolution is nearest to the
/// raster's own. What lies beyond MercatorLatitude is left out. Throws a Failure where the raster
/// has no place on the Earth, or none on such a map.
VTKIORELIEFSTREAMING_EXPORT TilePlan PlanTiles(const raster::GeoReference& reference,
  const int size[2], int tileSize, const std::optional<std::array<int, 2>>& zoom);
}

#endif
