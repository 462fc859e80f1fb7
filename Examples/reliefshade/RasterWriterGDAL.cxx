// SPDX-License-Identifier: BSD-3-Clause
#include "Gdal.h"
#include "RasterWriter.h"
#include "Watch.h"

#include "vtkImageData.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <filesystem>
#include <limits>
#include <stdexcept>

namespace fs = std::filesystem;

namespace
{

using namespace reliefshade;

/// What GDAL says against a file, without its staged name.
std::runtime_error failure(const std::string& file, const std::string& otherwise)
{
  std::string text = GdalErrors::Take(otherwise);
  const std::string name = fs::path(file).filename().string() + ": ";
  const std::size_t at = text.find(name);
  if (at != std::string::npos)
  {
    text.erase(0, at + name.size());
  }
  return std::runtime_error("cannot be written: " + text);
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
void writeGeoTiff(const std::string& file, vtkImageData* image, const GeoReference& reference)
{
  GdalErrors errors;
  // All is in the file: no .aux.xml of the temporary name stays behind.
  CPLConfigOptionSetter noSideFiles("GDAL_PAM_ENABLED", "NO", false);
  int size[3];
  image->GetDimensions(size);
  const int components = image->GetNumberOfScalarComponents();
  const bool isFloat = image->GetScalarType() == VTK_FLOAT;
  const GDALDataType type = isFloat ? GDT_Float32 : GDT_Byte;

  CPLStringList create;
  create.SetNameValue("COMPRESS", "DEFLATE");
  create.SetNameValue("PREDICTOR", isFloat ? "3" : "2");
  create.SetNameValue("INTERLEAVE", "PIXEL");
  create.SetNameValue("BIGTIFF", "IF_SAFER");
  create.SetNameValue("PHOTOMETRIC", components == 4 ? "RGB" : "MINISBLACK");
  if (components == 4)
  {
    create.SetNameValue("ALPHA", "NON-PREMULTIPLIED");
  }
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  GDALDataset* dataset = driver
    ? driver->Create(file.c_str(), size[0], size[1], components, type, create.List())
    : nullptr;
  if (!dataset)
  {
    throw failure(file, "GDAL does not create it");
  }
  std::array<double, 6> transform = reference.Transform;
  dataset->SetGeoTransform(transform.data());
  if (!reference.Crs.empty())
  {
    OGRSpatialReference crs;
    crs.importFromWkt(reference.Crs.c_str());
    dataset->SetSpatialRef(&crs);
  }
  if (!reference.AreaOrPoint.empty())
  {
    dataset->SetMetadataItem(GDALMD_AREA_OR_POINT, reference.AreaOrPoint.c_str());
  }
  if (components != 4)
  {
    dataset->GetRasterBand(1)->SetNoDataValue(std::numeric_limits<double>::quiet_NaN());
  }

  auto* first = static_cast<char*>(image->GetScalarPointer());
  const GSpacing componentSize = GDALGetDataTypeSizeBytes(type);
  const GSpacing sampleSize = components * componentSize;
  const GSpacing rowSize = size[0] * sampleSize;
  GDALRasterIOExtraArg extra;
  INIT_RASTERIO_EXTRA_ARG(extra);
  extra.pfnProgress = goOnUnlessInterrupted;
  const CPLErr error = dataset->RasterIO(GF_Write, 0, 0, size[0], size[1],
    reference.SouthUp ? first : first + (size[1] - 1) * rowSize, size[0], size[1], type, components,
    nullptr, sampleSize, reference.SouthUp ? rowSize : -rowSize, componentSize, &extra);
  // Closing writes what is still in memory, and may fail as well: on a full disk, for example. GDAL
  // does not always tell, so the file is looked at once more.
  dataset->FlushCache();
  GDALClose(dataset);
  stopIfInterrupted();
  if (error != CE_None || GdalErrors::Any())
  {
    throw failure(file, "GDAL gives no reason");
  }
  const DatasetPointer written(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER));
  if (!written || written->GetRasterCount() != components || written->GetRasterXSize() != size[0] ||
    written->GetRasterYSize() != size[1])
  {
    throw std::runtime_error("cannot be written: its end is missing, perhaps for want of space");
  }
}

}
