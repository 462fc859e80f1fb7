// SPDX-License-Identifier: BSD-3-Clause
#ifndef Gdal_h
#define Gdal_h

#include "FileGuard.h"
#include "PictureTags.h"
#include "Raster.h"

#include <gdal_priv.h>

#include <memory>
#include <string>

namespace relief::raster
{
/// While one lives, GDAL prints nothing: the first failure is kept for Take().
class VTKIORELIEFRASTER_EXPORT GdalErrors
{
public:
  /// Registers GDAL's formats, too.
  GdalErrors();
  ~GdalErrors();
  GdalErrors(const GdalErrors&) = delete;
  void operator=(const GdalErrors&) = delete;

  /// The failure, or what to say if GDAL gave no reason; it is forgotten then. Where it begins with
  /// the name of the file, that is left out.
  static std::string Take(const std::string& otherwise, const std::string& file = "");
  static bool Any();
};

struct CloseDataset
{
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using DatasetPointer = std::unique_ptr<GDALDataset, CloseDataset>;

/// One of GDAL's formats. Throws a Failure where this GDAL lacks it.
VTKIORELIEFRASTER_EXPORT GDALDriver* FindDriver(const char* name);

/// Opens a raster for reading; null if the file is not one of GDAL's. Throws a Failure.
DatasetPointer OpenDataset(const std::string& file);

/// Opens an ESRI ASCII grid for all but its heights, also where GDAL does not know it for one: it
/// balks at a byte order mark, and at heights that begin with NaN. Throws a Failure.
DatasetPointer OpenEsriGrid(const std::string& file);

/// The bytes of a file, which may lie where GDAL alone gets at them; none where a name is of a data
/// set in a file.
ByteSource GdalBytesOf(const std::string& file);

/// Takes over where the raster lies: by its transform, or by ground control points that make one.
/// Throws a Failure where it is not finite.
void ReadTransform(GDALDataset* dataset, GeoReference& reference);

/// The reference system of the transform; null for none.
const OGRSpatialReference* ReferenceSystem(GDALDataset* dataset);

/// What GDAL itself takes while it reads bands: a block of all bands as it is decoded, and its
/// cache.
double DecodingBytes(GDALDataset* dataset);

/// Empty for none.
std::string WellKnownText(const OGRSpatialReference* crs);

/// Takes over the reference system that was last put into these very words, if it was: to make it
/// from them takes PROJ's database, and longer than a small raster is shaded. Returns whether.
bool FindLastReferenceSystem(const std::string& text, OGRSpatialReference& crs);

/// For GDAL's long steps, with a pointer to a StepWatcher: whether to go on.
int CPL_STDCALL GoOn(double share, const char* text, void* watcher);
}

#endif
