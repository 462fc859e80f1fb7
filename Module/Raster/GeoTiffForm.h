// SPDX-License-Identifier: BSD-3-Clause
#ifndef GeoTiffForm_h
#define GeoTiffForm_h

#include <optional>
#include <string>
#include <vector>

namespace relief::raster
{
/// How a GeoTIFF is stored. There without GDAL as well, which writes none.
struct GeoTiffForm
{
  enum Compressions
  {
    Usual, ///< none, or GDAL's choice where it is cloud-optimized
    None,
    Deflate,
    ZStd,
    LZW
  };
  Compressions Compression = Usual;
  /// GDAL's creation options, NAME=VALUE; they go before what is chosen here.
  std::vector<std::string> CreationOptions;
  /// Cloud-optimized: tiles and overviews, in an order for reading parts from afar. It is written
  /// twice: as a file of its own beside the other first.
  bool CloudOptimized = false;
  /// Smaller copies inside the file, each half as large as the one before, as those that are
  /// cloud-optimized have them anyway.
  bool Overviews = false;
  /// The value that is declared to be no data.
  std::optional<double> NoData;
  /// To compress with; 0 for one for each processor.
  int Threads = 0;
};
}

#endif
