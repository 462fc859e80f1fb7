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

/// A file that is gone when its object goes, unless it has been renamed.
class TemporaryFile
{
public:
  explicit TemporaryFile(const fs::path& target)
    : Target(fs::is_symlink(target) ? fs::weakly_canonical(target) : target)
    , Path(this->Target.parent_path() /
        ("." + this->Target.filename().string() + "." + std::to_string(processNumber()) + ".tmp"))
  {
  }

  ~TemporaryFile()
  {
    std::error_code ignored;
    fs::remove(this->Path, ignored);
  }

  TemporaryFile(const TemporaryFile&) = delete;
  void operator=(const TemporaryFile&) = delete;

  std::string Name() const { return this->Path.string(); }

  /// What GDAL says against the file, without the temporary name.
  std::runtime_error Error(const std::string& otherwise) const
  {
    std::string text = GdalErrors::Take(otherwise);
    const std::string name = this->Path.filename().string() + ": ";
    const std::size_t at = text.find(name);
    if (at != std::string::npos)
    {
      text.erase(0, at + name.size());
    }
    return std::runtime_error("cannot be written: " + text);
  }

  /// Takes the place, and the permissions, of the target.
  void Keep()
  {
    std::error_code code;
    const fs::file_status old = fs::status(this->Target, code);
    if (fs::exists(old))
    {
      fs::permissions(this->Path, old.permissions(), code);
    }
    fs::rename(this->Path, this->Target, code);
    if (code)
    {
      throw std::runtime_error("cannot be replaced: " + code.message());
    }
  }

private:
  fs::path Target;
  fs::path Path;
};

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
  TemporaryFile temporary(file);
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  GDALDataset* dataset = driver
    ? driver->Create(temporary.Name().c_str(), size[0], size[1], components, type, create.List())
    : nullptr;
  if (!dataset)
  {
    throw temporary.Error("GDAL does not create it");
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
  // Closing writes what is still in memory, and may fail as well: on a full disk, for example.
  GDALClose(dataset);
  stopIfInterrupted();
  if (error != CE_None || GdalErrors::Any())
  {
    throw temporary.Error("GDAL gives no reason");
  }
  temporary.Keep();
}

}
