// SPDX-License-Identifier: BSD-3-Clause
#ifndef WarpedPicture_h
#define WarpedPicture_h

/// @file
/// A picture as a web map has it. Not installed.

#include "TilePlan.h"

#include <cstdint>
#include <memory>
#include <string>

namespace relief::streaming
{
/// A GeoTIFF of red, green, blue and alpha in the projection and at the samples of the tiles of one
/// zoom, which GDAL works out where they are read. Any sample is what it is however much is read
/// at a time, so that tiles have no seams: places are exact, not interpolated over what is read,
/// and the width of the filter is the same everywhere. One thread at a time reads from it.
class VTKIORELIEFSTREAMING_EXPORT WarpedPicture
{
public:
  /// Throws a Failure.
  WarpedPicture(const std::string& file, const TilePlan& plan);
  ~WarpedPicture();
  WarpedPicture(const WarpedPicture&) = delete;
  void operator=(const WarpedPicture&) = delete;

  /// Reads samples of the map at the greatest zoom, red, green, blue and alpha side by side, row by
  /// row from the north. Throws a Failure.
  void Read(std::int64_t column, std::int64_t row, int columns, int rows, unsigned char* rgba);

  /// Reading goes quickest in parts that begin at a multiple of these from the plan's first column.
  static constexpr int BlockColumns = 512;

private:
  struct Internals;
  std::unique_ptr<Internals> Internal;
  std::int64_t First[2];
};
}

#endif
