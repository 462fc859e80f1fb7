// SPDX-License-Identifier: BSD-3-Clause
#ifndef WebTiles_h
#define WebTiles_h

/// @file
/// A shaded raster as tiles of a web map. Not installed.

#include "FileGuard.h"
#include "RunFolder.h"
#include "TilePlan.h"

#include <string>

namespace relief::streaming
{
/// Writes `z/x/y.png` in a folder of a run, see RunFolder: Web Mercator (EPSG:3857), rows from the
/// north, red, green, blue and alpha of 8 bits. Tiles of the greatest zoom are read from the
/// picture, see WarpedPicture; each of the others is the mean of its four, in linear light and
/// weighted by alpha. Tiles without any data are not written. Each appears when it is whole, and is
/// kept when a run goes on; `tiles.json` comes last.
class VTKIORELIEFSTREAMING_EXPORT WebTiles
{
public:
  /// Opens or makes the folder, and removes what a killed run has left unfinished. Throws a
  /// Failure.
  WebTiles(const std::string& folder, const std::string& key);

  /// Whether all tiles of the run are there: tiles.json is. Without it those that are missing are
  /// made.
  bool AreDone() const;

  /// Where the shaded picture is to be, as a GeoTIFF of red, green, blue and alpha, until the tiles
  /// are made of it.
  std::string GetPicture() const;
  bool HasPicture() const;

  /// Makes the tiles that are missing, on as many threads as VTK uses, then removes the picture.
  /// Throws a Failure, or Aborted; tiles that were made by then are kept.
  void Make(const TilePlan& plan, const io::StepWatcher& watcher);

  /// Where the picture in GetPicture() lies; throws a Failure.
  TilePlan Plan(int size, const std::optional<std::array<int, 2>>& zoom) const;

  /// Forgets a run that came to nothing: unless there are tiles or a picture, nothing of it stays.
  void Forget();

private:
  void RemoveUnfinished() const;
  bool HasTiles() const;

  RunFolder Folder;
};
}

#endif
