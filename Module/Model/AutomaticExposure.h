// SPDX-License-Identifier: BSD-3-Clause
#ifndef AutomaticExposure_h
#define AutomaticExposure_h

#include "SceneShading.h"

#include <vector>

namespace relief
{

/// Finds the exposure at which a scene's picture uses the range of 8 bits: 99.5 % of the samples
/// are darker than pure white. It looks at tiles that are spread over the whole field, the same
/// whatever part is asked for and however many threads there are.
class AutomaticExposure
{
public:
  /// Both must outlive this object.
  AutomaticExposure(const HeightField& field, const Scene& scene);

  int GetNumberOfTiles() const { return static_cast<int>(this->Tiles.size()); }

  ///@{
  /// The first sample of a tile, which has the size of SweepThickness's as far as there is a field.
  int GetFirstColumn(int tile) const
  {
    return this->Tiles[static_cast<std::size_t>(tile)].column * SweepThickness::TileWidth;
  }
  int GetFirstRow(int tile) const
  {
    return this->Tiles[static_cast<std::size_t>(tile)].row * SweepThickness::TileHeight;
  }
  ///@}

  /// Shades the tiles [begin, end); disjoint parts may be shaded at once.
  void Measure(int begin, int end);

  /// In stops, once all tiles are measured; 0 where nothing is to be seen.
  double GetStops() const;

  /// What traces for it, and what has been traced.
  SceneShading& GetShading() { return this->Shading; }

  /// How many samples are looked at, at most, and a tile.
  static constexpr int MostSamples = 1 << 18;

private:
  struct Tile
  {
    int column;
    int row;
  };

  SceneShading Shading;
  std::vector<Tile> Tiles;
  std::vector<float> Largest; // components of samples, tile by tile; NaN for no sample
};

}

#endif
