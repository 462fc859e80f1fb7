// SPDX-License-Identifier: BSD-3-Clause
#include "Gdal.h"

#include "vtkErrorCode.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <mutex>
#include <vector>

namespace relief::raster
{
namespace
{
thread_local std::string FirstFailure;

void CPL_STDCALL KeepFailure(CPLErr severity, CPLErrorNum, const char* message)
{
  if (severity >= CE_Failure && FirstFailure.empty())
  {
    FirstFailure = message;
  }
}

/// The system that was last put into words.
struct NamedSystem
{
  std::string Text;
  OGRSpatialReference Crs;
};

std::mutex LastMutex;

NamedSystem& Last()
{
  static auto* const last = new NamedSystem; // it stays: what GDAL has ends before
  return *last;
}
}

//------------------------------------------------------------------------------
GDALDriver* FindDriver(const char* name)
{
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(name);
  if (!driver)
  {
    throw io::Failure(
      vtkErrorCode::CannotOpenFileError, std::string("this GDAL has no driver ") + name);
  }
  return driver;
}

//------------------------------------------------------------------------------
GdalErrors::GdalErrors()
{
  if (GDALGetDriverCount() == 0)
  {
    GDALAllRegister();
  }
  FirstFailure.clear();
  CPLPushErrorHandler(KeepFailure);
}

//------------------------------------------------------------------------------
GdalErrors::~GdalErrors()
{
  CPLPopErrorHandler();
}

//------------------------------------------------------------------------------
bool GdalErrors::Any()
{
  return !FirstFailure.empty();
}

//------------------------------------------------------------------------------
std::string GdalErrors::Take(const std::string& otherwise, const std::string& file)
{
  std::string text;
  text.swap(FirstFailure);
  for (const std::string& name : { file, std::filesystem::path(file).filename().string() })
  {
    const std::string beginning = name + ": ";
    const std::size_t at = name.empty() ? std::string::npos : text.find(beginning);
    if (at != std::string::npos)
    {
      text.erase(0, at + beginning.size());
    }
  }
  return io::OneLine(text.empty() ? otherwise : text);
}

//------------------------------------------------------------------------------
DatasetPointer OpenDataset(const std::string& file)
{
  if (!GDALIdentifyDriverEx(file.c_str(), GDAL_OF_RASTER, nullptr, nullptr))
  {
    return nullptr;
  }
  // Uncompressed strips come straight from the file, not by way of GDAL's cache.
  const CPLConfigOptionSetter direct("GTIFF_DIRECT_IO", "YES", true);
  DatasetPointer dataset(
    GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR));
  if (!dataset)
  {
    throw io::Failure(vtkErrorCode::FileFormatError, GdalErrors::Take("cannot be opened", file));
  }
  return dataset;
}

//------------------------------------------------------------------------------
void ReadTransform(GDALDataset* dataset, GeoReference& reference)
{
  std::array<double, 6>& t = reference.Transform;
  reference.Present = dataset->GetGeoTransform(t.data()) == CE_None ||
    GDALGCPsToGeoTransform(dataset->GetGCPCount(), dataset->GetGCPs(), t.data(), FALSE);
  if (!reference.Present)
  {
    t = GeoReference().Transform;
    return;
  }
  if (!std::all_of(t.begin(), t.end(), [](double number) { return std::isfinite(number); }))
  {
    throw io::Failure(
      vtkErrorCode::FileFormatError, "its georeference has numbers that are not finite");
  }
  // Products of rotations, and what is left of them after printing, turn by nothing that shows.
  const double columns = dataset->GetRasterXSize();
  const double rows = dataset->GetRasterYSize();
  const double share = 0.01; // of a sample, over the whole raster
  if (std::abs(t[4]) * columns <= share * std::abs(t[5]) &&
    std::abs(t[2]) * rows <= share * std::abs(t[1]))
  {
    t[2] = t[4] = 0.0;
  }
  reference.SouthUp = t[1] * t[5] - t[2] * t[4] > 0.0;
}

//------------------------------------------------------------------------------
const OGRSpatialReference* ReferenceSystem(GDALDataset* dataset)
{
  const OGRSpatialReference* crs = dataset->GetSpatialRef();
  return crs || dataset->GetGCPCount() == 0 ? crs : dataset->GetGCPSpatialRef();
}

//------------------------------------------------------------------------------
double DecodingBytes(GDALDataset* dataset)
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
std::string WellKnownText(const OGRSpatialReference* crs)
{
  char* text = nullptr;
  const char* const format[] = { "FORMAT=WKT2_2018", nullptr };
  const bool known = crs && crs->exportToWkt(&text, format) == OGRERR_NONE;
  std::string result = known ? text : "";
  CPLFree(text);
  if (known)
  {
    const std::lock_guard<std::mutex> lock(LastMutex);
    Last().Text = result;
    Last().Crs = *crs;
  }
  return result;
}

//------------------------------------------------------------------------------
bool FindLastReferenceSystem(const std::string& text, OGRSpatialReference& crs)
{
  const std::lock_guard<std::mutex> lock(LastMutex);
  const bool found = !text.empty() && Last().Text == text;
  if (found)
  {
    crs = Last().Crs;
  }
  return found;
}

//------------------------------------------------------------------------------
int CPL_STDCALL GoOn(double share, const char*, void* watcher)
{
  const auto& step = *static_cast<const io::StepWatcher*>(watcher);
  return !step || step(share) ? TRUE : FALSE;
}
}
