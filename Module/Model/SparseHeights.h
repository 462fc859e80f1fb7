// SPDX-License-Identifier: BSD-3-Clause
#ifndef SparseHeights_h
#define SparseHeights_h

#include "HeightField.h"
#include "ParallelFor.h"
#include "RasterBounds.h"
#include "RegionSet.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace relief
{

/// A field as large as a raster that does not fit into memory: it has the raster's addresses, but
/// only regions that are filled take memory. What is shaded from it, tile by tile, is bit for bit
/// what the whole raster would give, as long as the regions that TileRegions finds for a tile are
/// filled. Regions are squares of RasterBounds::RegionSize samples.
///
/// First a host goes through the raster for the least and the greatest height in double, where
/// samples are no floats, and finds the datum (HeightField::FindDatum()); then for RasterBounds,
/// with rows as float lengths above it. Both can be kept beside the raster.
///
/// Then it calls Reserve(), padded as SceneShading::WantsPadding() says, and makes a scene whose
/// lights stand above the datum, one SceneShading and one TileRegions for GetField().
///
/// For each tile it calls TileRegions::Find(); Forget() for all but what that found, read and
/// level, and what the next tiles want; Fill() for what FindMissing() tells of the regions to read;
/// FillLevel() for the level ones; Complete(); SceneShading::Redirect() to where the results go;
/// and shades the tile, or parts of it on several threads.
///
/// The field's address stays, and so does what SceneShading decided by it. What else reads a field
/// has to have it filled first: AutomaticExposure looks at tiles all over it.
///
/// Takes small pages of memory, in whole ones: a region is 64 samples wide, a page of heights 1024.
/// So what is filled should be wide rather than high; whole rows of regions get large pages, which
/// are touched sooner. Needs a system with POSIX's mmap().
class SparseHeights
{
public:
  /// Where heights come from: fills the samples [i0, i1) x [j0, j1), as float lengths above the
  /// field's datum, NaN without data. Sample (i, j) belongs at heights[(j - j0) * pitch + i - i0],
  /// which is where it stays. Called for some regions side by side, from several threads at once;
  /// what it throws comes out, if the host's ParallelFor lets it, and then no region counts as
  /// filled.
  using Source =
    std::function<void(int i0, int i1, int j0, int j1, float* heights, std::ptrdiff_t pitch)>;

  /// Prepares a field without any heights. `datum` is what the heights are lower by than the
  /// raster's; `padded` as for HeightField::Assign(). Returns an empty text, or what is wrong. The
  /// bounds must outlive this object.
  std::string Reserve(
    const RasterBounds& bounds, double spacingX, double spacingY, double datum, bool padded);

  /// The regions of a set that are not filled, or only level.
  RegionSet FindMissing(const RegionSet& regions) const;

  /// Fills regions, those that are filled already anew. Exact are their heights; what bounds them
  /// is after Complete(), where the regions behind them are filled too (TileRegions counts on
  /// that).
  void Fill(const RegionSet& regions, const Source& source, const ParallelFor& parallelFor);

  /// Fills regions that are not filled yet with their greatest height, for which no heights need to
  /// be read; they must be such that TileRegions calls level.
  void FillLevel(const RegionSet& regions, const ParallelFor& parallelFor);

  /// Finds the bounds of all that has been filled since the last call. Before that nothing is
  /// shaded.
  void Complete(const ParallelFor& parallelFor);

  /// Forgets all regions but these, and gives back the pages that hold nothing else.
  void Forget(const RegionSet& kept);

  bool IsFilled(int i, int j) const { return this->Filled.Has(i, j); }
  const RegionSet& GetFilled() const { return this->Filled; }

  /// How many bytes of memory the regions take; 0 where the system does not tell. Takes a while.
  std::size_t CountResident();

  const HeightField& GetField() const { return this->Heights; }
  const RasterBounds& GetBounds() const { return *this->Bounds; }

private:
  // An array of numbers for each of the samples or of their squares, and its part for a region.
  struct Layer
  {
    std::size_t pitch; // numbers from a row to the next
    std::size_t width; // of a region, in numbers
    int height;        // of a region, in rows
    int rows;
    std::size_t before; // numbers before the first region of a row
    std::function<void(std::size_t, std::size_t)> forget;
    std::function<void(std::size_t, std::size_t)> enlarge;
    std::function<std::size_t()> resident;
  };

  void ListLayers();
  void ForgetIn(const Layer& layer, const RegionSet& kept) const;
  void FillAll(const RegionSet& regions, const Source& source, const ParallelFor& parallelFor);
  void FillRun(const RegionSet::Interval& run, const Source& source);
  void Enlarge(const RegionSet& regions);
  bool ReserveRoom(int columns, int rows, bool padded);

  const RasterBounds* Bounds = nullptr;
  HeightField Heights;
  int Margin = 0;
  RegionSet Filled;
  RegionSet Level; // of them, those filled level
  RegionSet Fresh; // not completed
  std::vector<Layer> Layers;
};

}

#endif
