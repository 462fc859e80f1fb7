// SPDX-License-Identifier: BSD-3-Clause
#ifndef TileRegions_h
#define TileRegions_h

#include "RegionSet.h"
#include "Scene.h"
#include "SparseHeights.h"

#include <vector>

namespace relief
{

/// Which regions of a raster a tile's picture depends on, by the raster's bounds alone: what must
/// be filled of SparseHeights before SceneShading shades the tile, that the picture and all of its
/// layers are bit for bit those of the whole raster.
///
/// From every region of the tile a corridor runs toward each light, as wide as what the integrators
/// look at beside their rays. It ends at the light, at the raster's border, or where the lowest ray
/// is above all heights that are still ahead: from there on to where it is above all heights of the
/// raster, the integrators look at bounds that tell them nothing but that, and level regions do.
/// Where it meets holes or the border, the ground goes on as it came: then it includes what lies
/// behind the tile's samples and, as far as there are holes, what lies beyond. With fixed steps it
/// runs to the light, or the border, in any case.
class TileRegions
{
public:
  /// Regions to fill with the raster's heights, and regions to fill level.
  struct Found
  {
    RegionSet read;
    RegionSet level; ///< over which all rays are above the greatest height
    /// Of those to read, those without which d has no bounds (HeightOutline): where rays start, at
    /// holes and borders that rays may meet, and what lies behind the start for how the ground goes
    /// on there.
    RegionSet needed;
  };

  /// For a scene over a field of SparseHeights, which must outlive this object.
  TileRegions(const SparseHeights& heights, const Scene& scene);

  /// For the samples [i0, i1) x [j0, j1).
  Found Find(int i0, int i1, int j0, int j1) const;

private:
  // The light's rays: cells and lengths, from the first sample.
  struct Path
  {
    bool positional;
    double x, y, z;        // place, or the way per unit of length
    double sink;           // how far below its sample a ray may start
    double asideX, asideY; // and how far beside it
    bool steps;            // looks at single samples all the way
    bool floored;
    double floor;
    double depth;
  };

  // Samples, inclusive; of any number.
  struct Rectangle
  {
    double x0, x1, y0, y1;
  };

  // What is found of a tile, and what of it is at hand.
  struct Search
  {
    Found& found;
    const Path& path;
    Rectangle start; // of the rays
    double lowest;   // a ray's start
    double highest;  // a sample
  };

  // How a corridor is followed, by samples of the way for a sun, by shares of it for a lamp.
  struct Way
  {
    double end;
    double step;
    double ahead; // how far ahead is looked
    double more;  // and how many samples more to the sides
    double climb; // of the lowest ray
    double
      back; // how far behind the start, where the ground goes on as it came; less than 0: no such
  };

  void AddPath(const Light& light, const f64::ReliefMedium& medium, bool steps);
  void FollowFrom(const Path& path, const Rectangle& samples, Found& found) const;
  void Follow(const Search& search, const Way& way) const;
  void FollowSun(const Search& search) const;
  void FollowLamp(const Search& search) const;
  void GoRound(const Search& search, Rectangle box) const;
  void GoBeyond(const Search& search, const Way& way, double from) const;
  bool MeetsEdge(const Rectangle& samples) const;
  bool HasHoles(const Rectangle& samples) const;
  bool IsInImage(const Rectangle& samples) const;
  double HighestIn(const RegionSet::Block& regions) const;
  void AddHoles(const Rectangle& samples, Found& found) const;
  void AddEdges(Found& found) const;
  RegionSet::Block LookedAt(const Rectangle& samples, double more) const;
  static Rectangle At(const Search& search, double from, double to);

  const SparseHeights& Heights;
  const RasterBounds& Bounds;
  double SpacingX;
  double SpacingY;
  std::vector<Path> Paths;
};

}

#endif
