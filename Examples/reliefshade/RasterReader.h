// SPDX-License-Identifier: BSD-3-Clause
#ifndef RasterReader_h
#define RasterReader_h

#include "Raster.h"

#include <string>

class vtkOpenImageIOReader;

namespace reliefshade
{

class MemoryBudget;

struct ReadOptions
{
  /// Which band of the file holds the heights, from 1; 0 for the first, refused if that is a
  /// colour.
  int Band = 0;
  /// Take the map coordinates of a file without a coordinate reference system as degrees on WGS 84.
  bool Degrees = false;
  /// Which height stands for no data: what the file says, or else NoData, which may be none.
  bool NoDataFromFile = true;
  std::optional<double> NoData;
};

/// What a file's pixels take beside what they take in the file.
struct MemoryPlan
{
  MemoryBudget& Budget;
  /// How often the pixels are in memory as the file stores them.
  double Copies = 1.0;
  /// Bytes for each pixel beside that.
  double PerPixel = 0.0;

  /// Claims the memory for pixels of so many bytes, and `meanwhile` more until they are read.
  /// Throws a std::runtime_error.
  void Claim(double columns, double rows, double bytes, double meanwhile = 0.0) const;
};

/// Reads heights from any file that one of the backends knows, in the file's own number type;
/// `bytesPerSample` is what each of them will need besides. Throws a Failure that names the file.
Raster readRaster(const std::string& file, const ReadOptions& options, MemoryBudget& budget,
  double bytesPerSample = 0.0);

/// Reads a file that OpenImageIO knows, for the program to be interrupted. Throws a
/// std::runtime_error.
void updateReader(vtkOpenImageIOReader* reader, const std::string& file, const MemoryPlan& plan);

/// Whether the coordinates could be degrees although nothing in the file says so.
bool looksLikeDegrees(const Raster& raster);

/// The backend for rasters that know their place on the map: all that GDAL reads
/// (RasterReaderGDAL.cxx) or, where the program is built without it, ESRI ASCII grids
/// (RasterReaderPlain.cxx). Returns false if the file is not one of its own; throws a
/// std::runtime_error if it is one but cannot be read.
bool readReferenced(
  const std::string& file, const ReadOptions& options, const MemoryPlan& plan, Raster& raster);

}

#endif
