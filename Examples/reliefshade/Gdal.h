// SPDX-License-Identifier: BSD-3-Clause
#ifndef Gdal_h
#define Gdal_h

#include "Raster.h"

#include <gdal_priv.h>

#include <memory>
#include <string>

namespace reliefshade
{

/// While one lives, GDAL prints nothing: the first failure is kept for Take().
class GdalErrors
{
public:
  GdalErrors();
  ~GdalErrors();
  GdalErrors(const GdalErrors&) = delete;
  void operator=(const GdalErrors&) = delete;

  /// The failure, or what to say if GDAL gave no reason; it is forgotten then.
  static std::string Take(const std::string& otherwise);
  static bool Any();
};

struct CloseDataset
{
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using DatasetPointer = std::unique_ptr<GDALDataset, CloseDataset>;

/// Opens a raster for reading; null if the file is not one of GDAL's. Throws a std::runtime_error.
DatasetPointer openRaster(const std::string& file);

/// Takes over where the raster lies. Throws a std::runtime_error if it is turned.
void readTransform(GDALDataset* dataset, GeoReference& reference);

/// What GDAL itself takes while it reads bands: a block of all bands as it is decoded, and its
/// cache.
double decodingBytes(GDALDataset* dataset);

/// Empty for none.
std::string wellKnownText(const OGRSpatialReference* crs);

/// For GDAL's long steps: whether to go on.
int goOnUnlessInterrupted(double, const char*, void*);

}

#endif
