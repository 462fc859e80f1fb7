// SPDX-License-Identifier: BSD-3-Clause
#ifndef EsriGrid_h
#define EsriGrid_h

/// @file
/// ESRI ASCII grids: a header of keys and numbers, then heights, the northern row first. Not
/// installed.

#include "FileGuard.h"
#include "MemoryBudget.h"
#include "Raster.h"
#include "RasterFile.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace relief::raster
{
/// Whether the file begins as such a grid does.
VTKIORELIEFRASTER_EXPORT bool IsEsriGrid(const std::string& file);

/// What its header says, without spacing in metres. Throws a Failure.
RasterHeader ReadEsriHeader(const std::string& file);

/// The heights as float, the southern row first. Between them are blanks, semicolons or commas;
/// where the number of heights says so, a comma is a point. NaN is written in any usual way,
/// Microsoft's 1.#QNAN among them. Refuses what GDAL passes over: words that are no numbers (GDAL
/// takes them for 0) and heights too many. Throws a Failure that names the line, or Aborted.
VTKIORELIEFRASTER_EXPORT vtkSmartPointer<vtkImageData> ReadEsriHeights(
  const std::string& file, const MemoryPlan& plan, const io::StepWatcher& watcher);

/// The bytes of the file: all of it is in memory where all of its heights are read.
double SizeOfText(const std::string& file);

/// A grid of which windows are read. It is gone through once for where its rows begin, which takes
/// 16 bytes a row. Of any thread.
class VTKIORELIEFRASTER_EXPORT EsriRows
{
public:
  /// Throws a Failure, for too few or too many heights as well.
  explicit EsriRows(const std::string& file);

  /// The rows of a file that somebody has at hand in the same state, or else new ones.
  static std::shared_ptr<const EsriRows> Of(const std::string& file);

  /// The heights of a window, as ReadEsriHeights() has them. Throws a Failure.
  vtkSmartPointer<vtkImageData> Read(const RasterFile::Window& window) const;

  /// Where a row begins, and in which line.
  struct Start
  {
    std::uint64_t Offset;
    int Line;
  };
  using Starts = std::vector<Start>;

private:
  std::string Name;
  int Rows = 0;
  bool PartedByCommas = false;
  Starts Begins; // the northern row first, and behind the last
};

/// The file, and that of the same name that ends in .prj if it is there.
std::vector<std::string> FilesOfEsriGrid(const std::string& file);

/// Whether a file of the same name that ends in .prj says that the coordinates are degrees.
bool HasGeographicProjection(const std::string& file);
}

#endif
