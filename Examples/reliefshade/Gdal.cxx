// SPDX-License-Identifier: BSD-3-Clause
#include "Gdal.h"

#include "Watch.h"

#include <cpl_error.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace
{

std::string firstFailure;

void CPL_STDCALL keepFailure(CPLErr severity, CPLErrorNum, const char* message)
{
  if (severity >= CE_Failure && firstFailure.empty())
  {
    firstFailure = message;
  }
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
GdalErrors::GdalErrors()
{
  if (GDALGetDriverCount() == 0)
  {
    GDALAllRegister();
    // GDAL takes over libtiff's messages too, of OpenImageIO's files as well, and would print them.
    CPLSetErrorHandler(CPLQuietErrorHandler);
  }
  firstFailure.clear();
  CPLPushErrorHandler(keepFailure);
}

//------------------------------------------------------------------------------
GdalErrors::~GdalErrors()
{
  CPLPopErrorHandler();
}

//------------------------------------------------------------------------------
bool GdalErrors::Any()
{
  return !firstFailure.empty();
}

//------------------------------------------------------------------------------
std::string GdalErrors::Take(const std::string& otherwise)
{
  std::string text;
  text.swap(firstFailure);
  return text.empty() ? otherwise : text;
}

//------------------------------------------------------------------------------
DatasetPointer openRaster(const std::string& file)
{
  if (!GDALIdentifyDriverEx(file.c_str(), GDAL_OF_RASTER, nullptr, nullptr))
  {
    return nullptr;
  }
  DatasetPointer dataset(
    GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR));
  if (!dataset)
  {
    throw std::runtime_error(GdalErrors::Take("cannot be opened"));
  }
  return dataset;
}

//------------------------------------------------------------------------------
void readTransform(GDALDataset* dataset, GeoReference& reference)
{
  std::array<double, 6>& t = reference.Transform;
  reference.Present = dataset->GetGeoTransform(t.data()) == CE_None;
  if (reference.Present &&
    !std::all_of(t.begin(), t.end(), [](double number) { return std::isfinite(number); }))
  {
    throw std::runtime_error("its georeference has numbers that are not finite");
  }
  if (reference.Present && (t[2] != 0.0 || t[4] != 0.0 || t[1] <= 0.0 || t[5] == 0.0))
  {
    throw std::runtime_error(
      "its rows do not run from west to east; gdalwarp makes a raster that is north up");
  }
  reference.SouthUp = reference.Present && t[5] > 0.0;
}

//------------------------------------------------------------------------------
double decodingBytes(GDALDataset* dataset)
{
  GDALRasterBand* band = dataset->GetRasterBand(1);
  const double bytes =
    1.0 * GDALGetDataTypeSizeBytes(band->GetRasterDataType()) * dataset->GetRasterCount();
  int columns;
  int rows;
  band->GetBlockSize(&columns, &rows);
  const double block = bytes * columns * rows;
  const double all = bytes * dataset->GetRasterXSize() * dataset->GetRasterYSize();
  // A block is decoded whole, then parted among the bands.
  return 2.0 * block + std::min(all, static_cast<double>(GDALGetCacheMax64()));
}

//------------------------------------------------------------------------------
std::string wellKnownText(const OGRSpatialReference* crs)
{
  char* text = nullptr;
  const char* const format[] = { "FORMAT=WKT2_2018", nullptr };
  const bool known = crs && crs->exportToWkt(&text, format) == OGRERR_NONE;
  const std::string result = known ? text : "";
  CPLFree(text);
  return result;
}

//------------------------------------------------------------------------------
int goOnUnlessInterrupted(double, const char*, void*)
{
  return interrupted() ? FALSE : TRUE;
}

}
