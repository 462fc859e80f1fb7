// SPDX-License-Identifier: BSD-3-Clause
#ifndef EsriGrid_h
#define EsriGrid_h

/// @file
/// ESRI ASCII grids: a header of keys and numbers, then heights, the northern row first. Not
/// installed.

#include "FileGuard.h"
#include "MemoryBudget.h"
#include "Raster.h"

#include <string>

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

/// Whether a file of the same name that ends in .prj says that the coordinates are degrees.
bool HasGeographicProjection(const std::string& file);
}

#endif
