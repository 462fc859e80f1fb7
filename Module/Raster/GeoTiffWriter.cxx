// SPDX-License-Identifier: BSD-3-Clause
#include "GeoTiffWriter.h"

#include "Gdal.h"
#include "StagedFile.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace relief::raster
{
namespace
{
constexpr double StripBytes = 256.0 * 1024.0;

//------------------------------------------------------------------------------
/// What GDAL says against a file, without its staged name.
io::Failure WriteFailure(unsigned long code, const std::string& file, const std::string& otherwise)
{
  return { code, "cannot be written: " + GdalErrors::Take(otherwise, file) };
}

//------------------------------------------------------------------------------
GDALDataType FileType(int scalarType)
{
  switch (scalarType)
  {
    case VTK_UNSIGNED_CHAR:
      return GDT_Byte;
    case VTK_UNSIGNED_SHORT:
      return GDT_UInt16;
    case VTK_SHORT:
      return GDT_Int16;
    case VTK_UNSIGNED_INT:
      return GDT_UInt32;
    case VTK_INT:
      return GDT_Int32;
    case VTK_FLOAT:
      return GDT_Float32;
    case VTK_DOUBLE:
      return GDT_Float64;
    default:
      throw io::Failure(vtkErrorCode::FileFormatError,
        std::string("TIFF is not written with numbers of the type ") +
          vtkImageScalarTypeNameMacro(scalarType));
  }
}

//------------------------------------------------------------------------------
const char* NameOf(GeoTiffForm::Compressions compression)
{
  static const char* const names[] = { "NONE", "NONE", "DEFLATE", "ZSTD", "LZW" };
  return names[compression];
}

//------------------------------------------------------------------------------
/// What GDAL warns of, which is refused here: an option that is passed over has been misspelt.
void CPL_STDCALL KeepWarning(CPLErr, CPLErrorNum, const char* message)
{
  auto& kept = *static_cast<std::string*>(CPLGetErrorHandlerUserData());
  kept = kept.empty() ? message : kept;
}

//------------------------------------------------------------------------------
void CheckOptions(GDALDriver* driver, const CPLStringList& options)
{
  std::string wrong;
  CPLPushErrorHandlerEx(KeepWarning, &wrong);
  const bool valid = GDALValidateCreationOptions(driver, options.List()) != FALSE;
  CPLPopErrorHandler();
  if (!valid)
  {
    throw io::Failure(
      vtkErrorCode::FileFormatError, "GDAL refuses a creation option: " + io::OneLine(wrong));
  }
}

//------------------------------------------------------------------------------
void SetIfUnset(CPLStringList& options, const char* name, const std::string& value)
{
  if (!options.FetchNameValue(name))
  {
    options.SetNameValue(name, value.c_str());
  }
}

//------------------------------------------------------------------------------
/// Whether something is compressed by what a predictor is for.
bool TakesPredictor(const CPLStringList& options)
{
  const std::string compression = options.FetchNameValueDef("COMPRESS", "NONE");
  return EQUAL(compression.c_str(), "DEFLATE") || EQUAL(compression.c_str(), "ZSTD") ||
    EQUAL(compression.c_str(), "LZW");
}

//------------------------------------------------------------------------------
/// The user's options, and the form's own where those say nothing.
CPLStringList OptionsOf(const GeoTiffForm& form)
{
  CPLStringList options;
  for (const std::string& option : form.CreationOptions)
  {
    if (option.find('=') == std::string::npos || option.front() == '=')
    {
      throw io::Failure(vtkErrorCode::FileFormatError,
        "\"" + option + "\" is no creation option of GDAL's; expected NAME=VALUE");
    }
    options.AddString(option.c_str());
  }
  for (const char* name : { "TFW", "RPB", "RPCTXT", "APPEND_SUBDATASET" })
  {
    if (options.FetchBool(name, false))
    {
      throw io::Failure(vtkErrorCode::FileFormatError,
        std::string("the creation option ") + name +
          " is about another file than the one that is written; leave it out");
    }
  }
  if (form.Compression != GeoTiffForm::Usual || !form.CloudOptimized)
  {
    SetIfUnset(options, "COMPRESS", NameOf(form.Compression));
  }
  if (!EQUAL(options.FetchNameValueDef("COMPRESS", "LZW"), "NONE"))
  {
    SetIfUnset(
      options, "NUM_THREADS", form.Threads > 0 ? std::to_string(form.Threads) : "ALL_CPUS");
  }
  if (form.CloudOptimized && TakesPredictor(options))
  {
    SetIfUnset(options, "PREDICTOR", "YES");
  }
  SetIfUnset(options, "BIGTIFF", "IF_SAFER");
  return options;
}

//------------------------------------------------------------------------------
/// Those that say what is in the file, and how it is laid out where nobody has said that.
CPLStringList TiffOptionsOf(
  const CPLStringList& given, const int size[2], int components, GDALDataType type)
{
  const bool isFloat = type == GDT_Float32 || type == GDT_Float64;
  const bool colors = components == 4 || (components == 3 && type == GDT_Byte);
  CPLStringList options(given);
  if (TakesPredictor(options))
  {
    SetIfUnset(options, "PREDICTOR", isFloat ? "3" : "2");
  }
  SetIfUnset(options, "INTERLEAVE", "PIXEL");
  SetIfUnset(options, "PHOTOMETRIC", colors ? "RGB" : "MINISBLACK");
  if (components == 2 || components == 4)
  {
    SetIfUnset(options, "ALPHA", "NON-PREMULTIPLIED");
  }
  if (!options.FetchBool("TILED", false))
  {
    // Strips of one row each, as GDAL makes them of wide pictures, cost more than what is in them.
    const double rowBytes = 1.0 * size[0] * components * GDALGetDataTypeSizeBytes(type);
    SetIfUnset(options, "BLOCKYSIZE",
      std::to_string(std::clamp(static_cast<int>(StripBytes / rowBytes), 1, size[1])));
  }
  return options;
}

//------------------------------------------------------------------------------
GDALDataset* CreateFile(const std::string& file, const int size[2], int components,
  GDALDataType type, const CPLStringList& options)
{
  GDALDriver* driver = FindDriver("GTiff");
  CheckOptions(driver, options);
  // GDAL would ask all of its formats whose the old file is.
  std::error_code ignored;
  fs::remove(file, ignored);
  GDALDataset* dataset =
    driver->Create(file.c_str(), size[0], size[1], components, type, options.List());
  if (!dataset)
  {
    throw WriteFailure(vtkErrorCode::CannotOpenFileError, file, "GDAL does not create it");
  }
  return dataset;
}

//------------------------------------------------------------------------------
/// By the code at the text's end, if that means the very same: the text does not hold the codes of
/// a system's parts, for which PROJ would search its database by name for longer than all else
/// takes.
OGRSpatialReference MakeReferenceSystem(const std::string& text)
{
  const std::string beginning = "ID[\"EPSG\",";
  const std::size_t at = text.rfind(beginning);
  OGRSpatialReference crs;
  if (FindLastReferenceSystem(text, crs))
  {
    return crs;
  }
  if (at != std::string::npos)
  {
    const int code = std::atoi(text.c_str() + at + beginning.size());
    if (crs.importFromEPSG(code) == OGRERR_NONE && WellKnownText(&crs) == text)
    {
      return crs;
    }
  }
  crs.importFromWkt(text.c_str());
  return crs;
}

//------------------------------------------------------------------------------
void SetReference(GDALDataset* dataset, const GeoReference& reference)
{
  for (const auto& [name, value] : reference.Metadata)
  {
    dataset->SetMetadataItem(name.c_str(), value.c_str());
  }
  if (!reference.Present)
  {
    return;
  }
  std::array<double, 6> transform = reference.Transform;
  dataset->SetGeoTransform(transform.data());
  if (!reference.Crs.empty())
  {
    const OGRSpatialReference crs = MakeReferenceSystem(reference.Crs);
    dataset->SetSpatialRef(&crs);
  }
  if (!reference.AreaOrPoint.empty())
  {
    dataset->SetMetadataItem(GDALMD_AREA_OR_POINT, reference.AreaOrPoint.c_str());
  }
}

//------------------------------------------------------------------------------
void DeclareNoData(GDALDataset* dataset, double value)
{
  for (int band = 1; band <= dataset->GetRasterCount(); ++band)
  {
    dataset->GetRasterBand(band)->SetNoDataValue(value);
  }
}

//------------------------------------------------------------------------------
/// GDAL does not always tell that it could not write, so a file is looked at once more.
void CheckWritten(const std::string& file, const int size[2], int components)
{
  const DatasetPointer written(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER));
  if (!written || written->GetRasterCount() != components || written->GetRasterXSize() != size[0] ||
    written->GetRasterYSize() != size[1])
  {
    throw io::Failure(vtkErrorCode::OutOfDiskSpaceError,
      "cannot be written: its end is missing, perhaps for want of space");
  }
}
}

struct GeoTiffFile::Internals
{
  std::ptrdiff_t RowBytes() const
  {
    return static_cast<std::ptrdiff_t>(this->Size[0]) * this->Components *
      GDALGetDataTypeSizeBytes(this->Type);
  }
  void Write(int rows, const char* first, std::ptrdiff_t bytes, const io::StepWatcher& watcher);
  int WriteBlocks(int rows, const char* first, std::ptrdiff_t bytes);
  void WriteAny(int rows, const char* first, std::ptrdiff_t bytes, const io::StepWatcher& watcher);
  void Close();
  void AddOverviews(const io::StepWatcher& watcher);
  void MakeCloudOptimized(const io::StepWatcher& watcher);

  std::string Name;
  std::unique_ptr<io::StagedFile> Plain; // what a cloud-optimized file is made from
  CPLStringList CloudOptions;
  bool Overviews = false;
  int Size[2];
  int Components;
  GDALDataType Type;
  int BlockRows = 1;
  int Done = 0;           // rows that have been written
  std::vector<char> Rest; // of rows that are no whole block yet
  DatasetPointer Dataset;
};

//------------------------------------------------------------------------------
/// Whole blocks of one band go to the file as they are, past GDAL's cache. Returns how many rows
/// did.
int GeoTiffFile::Internals::WriteBlocks(int rows, const char* first, std::ptrdiff_t bytes)
{
  GDALRasterBand* band = this->Dataset->GetRasterBand(1);
  int columns;
  int height;
  band->GetBlockSize(&columns, &height);
  if (this->Components > 1 || columns != this->Size[0] || bytes != this->RowBytes() ||
    this->Done % height != 0)
  {
    return 0;
  }
  const int blocks = rows / height;
  for (int k = 0; k < blocks; ++k)
  {
    // GDAL takes the block as something to write to, and does not.
    const char* data = first + k * height * bytes;
    if (band->WriteBlock(0, this->Done / height + k, const_cast<char*>(data)) != CE_None)
    {
      throw WriteFailure(vtkErrorCode::OutOfDiskSpaceError, this->Name, "GDAL gives no reason");
    }
  }
  return blocks * height;
}

//------------------------------------------------------------------------------
void GeoTiffFile::Internals::WriteAny(
  int rows, const char* first, std::ptrdiff_t bytes, const io::StepWatcher& watcher)
{
  const GSpacing componentSize = GDALGetDataTypeSizeBytes(this->Type);
  GDALRasterIOExtraArg extra;
  INIT_RASTERIO_EXTRA_ARG(extra);
  extra.pfnProgress = GoOn;
  extra.pProgressData = const_cast<io::StepWatcher*>(&watcher);
  CPLErr error = this->Dataset->RasterIO(GF_Write, 0, this->Done, this->Size[0], rows,
    const_cast<char*>(first), this->Size[0], rows, this->Type, this->Components, nullptr,
    this->Components * componentSize, bytes, componentSize, &extra);
  // What has been written would be kept until the cache is full.
  for (int k = 1; k <= this->Components && error == CE_None; ++k)
  {
    error = this->Dataset->GetRasterBand(k)->FlushCache();
  }
  if (error != CE_None || GdalErrors::Any())
  {
    io::Advance(watcher, 1.0);
    throw WriteFailure(vtkErrorCode::OutOfDiskSpaceError, this->Name, "GDAL gives no reason");
  }
}

//------------------------------------------------------------------------------
void GeoTiffFile::Internals::Write(
  int rows, const char* first, std::ptrdiff_t bytes, const io::StepWatcher& watcher)
{
  const int written = this->WriteBlocks(rows, first, bytes);
  this->Done += written;
  if (rows > written)
  {
    this->WriteAny(rows - written, first + written * bytes, bytes, watcher);
    this->Done += rows - written;
  }
}

//------------------------------------------------------------------------------
/// Closing writes what is still in memory, and may fail as well: on a full disk, for example.
void GeoTiffFile::Internals::Close()
{
  if (this->Dataset)
  {
    this->Dataset->FlushCache();
    this->Dataset.reset();
  }
}

//------------------------------------------------------------------------------
/// Down to those that have room in one of a cloud-optimized file's tiles, as that has them.
void GeoTiffFile::Internals::AddOverviews(const io::StepWatcher& watcher)
{
  constexpr int tile = 512;
  std::vector<int> factors;
  for (int factor = 2; std::max(this->Size[0], this->Size[1]) > tile * (factor / 2); factor *= 2)
  {
    factors.push_back(factor);
  }
  if (factors.empty())
  {
    return;
  }
  const DatasetPointer made(GDALDataset::Open(this->Name.c_str(), GDAL_OF_RASTER | GDAL_OF_UPDATE));
  const bool added = made &&
    made->BuildOverviews("AVERAGE", static_cast<int>(factors.size()), factors.data(), 0, nullptr,
      GoOn, const_cast<io::StepWatcher*>(&watcher)) == CE_None;
  io::Advance(watcher, 1.0);
  if (!added)
  {
    throw WriteFailure(vtkErrorCode::OutOfDiskSpaceError, this->Name, "GDAL gives no reason");
  }
}

//------------------------------------------------------------------------------
void GeoTiffFile::Internals::MakeCloudOptimized(const io::StepWatcher& watcher)
{
  const DatasetPointer plain(GDALDataset::Open(this->Plain->Name().c_str(), GDAL_OF_RASTER));
  DatasetPointer made;
  if (plain)
  {
    made.reset(FindDriver("COG")->CreateCopy(this->Name.c_str(), plain.get(), FALSE,
      this->CloudOptions.List(), GoOn, const_cast<io::StepWatcher*>(&watcher)));
  }
  io::Advance(watcher, 1.0);
  if (!made)
  {
    throw WriteFailure(vtkErrorCode::OutOfDiskSpaceError, this->Name, "GDAL gives no reason");
  }
}

//------------------------------------------------------------------------------
GeoTiffFile::GeoTiffFile(const std::string& file, const int size[2], int components, int scalarType,
  const GeoReference& reference, const GeoTiffForm& form)
  : Internal(new Internals)
{
  const GdalErrors errors;
  // All is in the file: no .aux.xml of the temporary name stays behind.
  const CPLConfigOptionSetter noSideFiles("GDAL_PAM_ENABLED", "NO", false);
  Internals& self = *this->Internal;
  self.Name = file;
  self.Size[0] = size[0];
  self.Size[1] = size[1];
  self.Components = components;
  self.Type = FileType(scalarType);
  self.Overviews = form.Overviews && !form.CloudOptimized;
  CPLStringList options = OptionsOf(form);
  std::string name = file;
  if (form.CloudOptimized)
  {
    CheckOptions(FindDriver("COG"), options);
    self.CloudOptions = options;
    options = OptionsOf(GeoTiffForm());
    self.Plain = std::make_unique<io::StagedFile>(file);
    name = self.Plain->Name();
  }
  options = TiffOptionsOf(options, size, components, self.Type);
  self.Dataset.reset(CreateFile(name, size, components, self.Type, options));
  SetReference(self.Dataset.get(), reference);
  int columns;
  self.Dataset->GetRasterBand(1)->GetBlockSize(&columns, &self.BlockRows);
  const bool isFloat = self.Type == GDT_Float32 || self.Type == GDT_Float64;
  if (form.NoData)
  {
    DeclareNoData(self.Dataset.get(), *form.NoData);
  }
  else if (isFloat && (components == 1 || components == 3))
  {
    DeclareNoData(self.Dataset.get(), std::numeric_limits<double>::quiet_NaN());
  }
}

//------------------------------------------------------------------------------
GeoTiffFile::~GeoTiffFile()
{
  const GdalErrors errors; // of a file that is given up
  const CPLConfigOptionSetter noSideFiles("GDAL_PAM_ENABLED", "NO", false);
  this->Internal->Dataset.reset();
}

//------------------------------------------------------------------------------
void GeoTiffFile::Write(
  int rows, const void* first, std::ptrdiff_t bytes, const io::StepWatcher& watcher)
{
  const GdalErrors errors;
  Internals& self = *this->Internal;
  const char* next = static_cast<const char*>(first);
  const auto keep = [&](int count)
  {
    for (int k = 0; k < count; ++k, next += bytes)
    {
      self.Rest.insert(self.Rest.end(), next, next + self.RowBytes());
    }
    rows -= count;
  };
  const auto kept = [&self] { return static_cast<int>(self.Rest.size() / self.RowBytes()); };

  // A block that is written in two parts would take its place in the file twice.
  if (kept() > 0)
  {
    keep(std::min(rows, self.BlockRows - kept()));
    if (kept() == self.BlockRows)
    {
      self.Write(self.BlockRows, self.Rest.data(), self.RowBytes(), watcher);
      self.Rest.clear();
    }
  }
  const int whole = kept() > 0 ? 0 : rows - rows % self.BlockRows;
  if (whole > 0)
  {
    self.Write(whole, next, bytes, watcher);
    next += whole * bytes;
    rows -= whole;
  }
  keep(rows);
}

//------------------------------------------------------------------------------
void GeoTiffFile::Finish(const io::StepWatcher& watcher)
{
  const GdalErrors errors;
  const CPLConfigOptionSetter noSideFiles("GDAL_PAM_ENABLED", "NO", false);
  Internals& self = *this->Internal;
  if (!self.Rest.empty())
  {
    const int rows = static_cast<int>(self.Rest.size() / self.RowBytes());
    self.Write(rows, self.Rest.data(), self.RowBytes(), watcher);
  }
  self.Close();
  if (!GdalErrors::Any())
  {
    CheckWritten(self.Plain ? self.Plain->Name() : self.Name, self.Size, self.Components);
  }
  if (self.Plain && !GdalErrors::Any())
  {
    self.MakeCloudOptimized(watcher);
  }
  if (self.Overviews && !GdalErrors::Any())
  {
    self.AddOverviews(watcher);
  }
  io::Advance(watcher, 1.0);
  if (GdalErrors::Any())
  {
    throw WriteFailure(vtkErrorCode::OutOfDiskSpaceError, self.Name, "GDAL gives no reason");
  }
}

//------------------------------------------------------------------------------
void WriteGeoTiff(const std::string& file, vtkImageData* image, vtkDataArray* values,
  const GeoReference& reference, const GeoTiffForm& form, const io::StepWatcher& watcher)
{
  int size[3];
  image->GetDimensions(size);
  const int components = values->GetNumberOfComponents();
  GeoTiffFile tiff(file, size, components, values->GetDataType(), reference, form);
  const std::ptrdiff_t bytes =
    static_cast<std::ptrdiff_t>(size[0]) * components * values->GetDataTypeSize();
  const char* first = static_cast<const char*>(values->GetVoidPointer(0));
  const bool southUp = reference.SouthUp;
  tiff.Write(
    size[1], southUp ? first : first + (size[1] - 1) * bytes, southUp ? bytes : -bytes, watcher);
  tiff.Finish(watcher);
}

//------------------------------------------------------------------------------
void CheckForm(const GeoTiffForm& form)
{
  const GdalErrors errors;
  CheckOptions(FindDriver(form.CloudOptimized ? "COG" : "GTiff"), OptionsOf(form));
}
}
