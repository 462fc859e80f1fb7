// SPDX-License-Identifier: BSD-3-Clause
#ifndef RasterFile_h
#define RasterFile_h

/// @file
/// Files of heights that know their place on the map, and others. Not installed.

#include "FileGuard.h"
#include "MemoryBudget.h"
#include "Raster.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace relief::raster
{
/// How colours stand for heights: not at all; as whole numbers of three bytes, in steps of 1/256 m
/// from -32768 m on or of 0.1 m from -10000 m on.
enum class HeightEncoding
{
  None,
  Terrarium,
  TerrainRGB
};

struct ReadOptions
{
  /// Which band of the file holds the heights, from 1; 0 for the first, refused if that is a
  /// colour.
  int Band = 0;
  /// The same by names, in pictures whose format has them: a part, or its number from 1, and a
  /// channel. Empty for none.
  std::string Part;
  std::string Channel;
  /// The heights are in three bands of bytes; Band does not count then.
  HeightEncoding Encoding = HeightEncoding::None;
  /// Take the map coordinates of a file without a coordinate reference system as degrees on WGS 84.
  bool Degrees = false;
  /// Which height stands for no data: what the file says, or else NoData, which may be none.
  bool NoDataFromFile = true;
  std::optional<double> NoData;
  /// Heights may come as hosts::PaddedHeights: for who shades them, and takes no pointer to them.
  bool Padded = false;
};

/// A failure that another choice in the ReadOptions mends; programs know what to call it.
struct RELIEF_THROWN OptionFailure : io::Failure
{
  enum Choice
  {
    Band,
    Degrees,
    Colors,  ///< Encoding or Band
    Indices, ///< of a palette, by Band 1
    Channel  ///< or Band
  };
  OptionFailure(
    Choice option, const std::string& reason, const std::vector<std::string>& bands = {});
  Choice Option;
  std::vector<std::string> Bands; ///< to choose from, as RasterHeader has them
};

/// A file of heights. Its header is there once it is open; those whose readers tell all of it only
/// with the heights fill it in for the Raster that Read returns.
class VTKIORELIEFRASTER_EXPORT RasterFile
{
public:
  virtual ~RasterFile() = default;
  const RasterHeader& GetHeader() const { return this->Header; }

  /// Reads the heights as the file stores them, and its mask. It claims the memory for these; the
  /// plan is to have what the caller makes of them. Throws a Failure, or Aborted.
  virtual Raster Read(const MemoryPlan& plan, const io::StepWatcher& watcher) = 0;

  /// Samples [i0, i1) x [j0, j1), the rows from the southern one on.
  struct Window
  {
    int i0, i1, j0, j1;
  };

  /// Whether windows of it can be read without the rest.
  virtual bool HasWindows() const { return false; }

  /// What reading all of it takes beside its samples, in bytes.
  virtual double GetReadingBytes() const { return 0.0; }

  /// Reads a window's heights as the file stores them, and its mask; of what has windows. Throws a
  /// Failure.
  virtual Raster ReadWindow(const Window& window);

protected:
  RasterHeader Header;
};

/// Opens a file that knows its place on the map: any that GDAL reads (RasterFileGDAL.cxx) or, where
/// the library is built without it, an ESRI ASCII grid (RasterFilePlain.cxx). Null if the file is
/// of another kind. Throws a Failure.
VTKIORELIEFRASTER_EXPORT std::unique_ptr<RasterFile> OpenRaster(
  const std::string& file, const ReadOptions& options);

/// The files that a raster or picture is read from, as GDAL tells without reading it: itself, those
/// beside it, and what a virtual raster is put together from. None where it is not one of GDAL's or
/// the library is built without it. Throws nothing.
VTKIORELIEFRASTER_EXPORT std::vector<std::string> FilesOf(const std::string& file);

/// Opens a picture for which vtkImageReader2Factory has a reader. Null if it has none. Throws a
/// Failure.
std::unique_ptr<RasterFile> OpenPicture(const std::string& file, const ReadOptions& options);

/// Reads heights in the file's own number type, unless they are scaled there. Throws a Failure, or
/// Aborted.
VTKIORELIEFRASTER_EXPORT Raster ReadHeights(RasterFile& file, const ReadOptions& options,
  const MemoryPlan& plan, const io::StepWatcher& watcher);

/// The same of a window, as the file stores them; tells nothing of what looks like no data.
Raster ReadStored(RasterFile& file, const ReadOptions& options, const RasterFile::Window& window);

/// Sets the spacing that there is right after a header was read, as ReadHeights does: throws a
/// Failure where it is none, or the raster is sheared.
void CheckSpacing(const RasterHeader& header);

/// The refusal of a picture of several colours.
VTKIORELIEFRASTER_EXPORT OptionFailure ManyComponents(const std::vector<std::string>& bands);

/// The names of a picture's colours, without alpha: red, green and blue where there are three.
VTKIORELIEFRASTER_EXPORT std::vector<std::string> ColorNames(int colors);
}

#endif
