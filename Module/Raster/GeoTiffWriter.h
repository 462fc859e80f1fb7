// SPDX-License-Identifier: BSD-3-Clause
#ifndef GeoTiffWriter_h
#define GeoTiffWriter_h

/// @file
/// Pictures that keep their place on the map. Not installed; there where GDAL is.

#include "FileGuard.h"
#include "GeoTiffForm.h"
#include "Raster.h"

#include <cstddef>
#include <memory>
#include <string>

class vtkDataArray;

namespace relief::raster
{
/// A GeoTIFF that is written some rows at a time, so that the picture is never in memory as a
/// whole. One component is grey, two are grey and alpha, three of bytes red, green and blue, four
/// these and alpha; in floating point numbers without alpha NaN is no data.
class VTKIORELIEFRASTER_EXPORT GeoTiffFile
{
public:
  /// Creates a file of that size under this very name. `scalarType` is VTK's. Throws a Failure,
  /// also for what the form asks of GDAL that GDAL does not know.
  GeoTiffFile(const std::string& file, const int size[2], int components, int scalarType,
    const GeoReference& reference, const GeoTiffForm& form);
  ~GeoTiffFile();
  GeoTiffFile(const GeoTiffFile&) = delete;
  void operator=(const GeoTiffFile&) = delete;

  /// Writes the file's next rows, `bytes` from one to the next in memory, below 0 where they lie
  /// the other way round. Throws a Failure, or Aborted.
  void Write(int rows, const void* first, std::ptrdiff_t bytes,
    const io::StepWatcher& watcher = io::StepWatcher());

  /// Writes what is still in memory, and looks whether all is there. Throws a Failure, or Aborted.
  void Finish(const io::StepWatcher& watcher);

private:
  struct Internals;
  std::unique_ptr<Internals> Internal;
};

/// Writes an array over the points of an image under this very name, the upper row first unless the
/// reference says otherwise. Throws a Failure, or Aborted.
VTKIORELIEFRASTER_EXPORT void WriteGeoTiff(const std::string& file, vtkImageData* image,
  vtkDataArray* values, const GeoReference& reference, const GeoTiffForm& form,
  const io::StepWatcher& watcher);

/// Throws a Failure for what the form asks of GDAL that GDAL does not know.
VTKIORELIEFRASTER_EXPORT void CheckForm(const GeoTiffForm& form);
}

#endif
