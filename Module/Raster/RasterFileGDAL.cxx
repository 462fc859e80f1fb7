// SPDX-License-Identifier: BSD-3-Clause
#include "EsriGrid.h"
#include "Gdal.h"
#include "HeightUnits.h"
#include "MapScale.h"
#include "Orientation.h"
#include "PaddedHeights.h"
#include "RasterFile.h"

#include "vtkErrorCode.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>

namespace relief::raster
{
namespace
{
/// The type of a band's samples in GDAL's and in VTK's words.
struct SampleType
{
  GDALDataType Gdal;
  int Vtk;
};

//------------------------------------------------------------------------------
SampleType FindSampleType(GDALRasterBand* band)
{
  const GDALDataType type = band->GetRasterDataType();
  switch (type)
  {
    case GDT_Byte:
    {
      // Before GDAL 3.7 signed bytes were bytes with a remark.
      const char* pixelType = band->GetMetadataItem("PIXELTYPE", "IMAGE_STRUCTURE");
      const bool isSigned = pixelType && EQUAL(pixelType, "SIGNEDBYTE");
      return { GDT_Byte, isSigned ? VTK_SIGNED_CHAR : VTK_UNSIGNED_CHAR };
    }
    case GDT_UInt16:
      return { type, VTK_UNSIGNED_SHORT };
    case GDT_Int16:
      return { type, VTK_SHORT };
    case GDT_UInt32:
      return { type, VTK_UNSIGNED_INT };
    case GDT_Int32:
      return { type, VTK_INT };
    case GDT_Float32:
      return { type, VTK_FLOAT };
    default:
      if (GDALDataTypeIsComplex(type))
      {
        throw io::Failure(vtkErrorCode::FileFormatError,
          std::string("its samples are complex (") + GDALGetDataTypeName(type) + ")");
      }
      return GDALGetDataTypeSizeBytes(type) == 1 ? SampleType{ GDT_Int16, VTK_SHORT }
                                                 : SampleType{ GDT_Float64, VTK_DOUBLE };
  }
}

//------------------------------------------------------------------------------
/// Where a band's rows go.
struct RowsInMemory
{
  char* First; // the southern one
  GSpacing Pitch;
};

//------------------------------------------------------------------------------
/// The rows that are read at a time: whole blocks, which are decoded once.
int RowsAtOnce(GDALRasterBand* band, double rowBytes)
{
  constexpr double enough = 16.0 * 1024.0 * 1024.0;
  int columns;
  int height;
  band->GetBlockSize(&columns, &height);
  const double blocks = std::max(1.0, enough / (rowBytes * height));
  return static_cast<int>(std::min(1.0 * band->GetYSize(), std::floor(blocks) * height));
}

//------------------------------------------------------------------------------
/// Reads a band as it is.
void ReadRows(GDALRasterBand* band, GDALDataType type, bool southUp, const RowsInMemory& memory,
  const io::StepWatcher& watcher)
{
  const int columns = band->GetXSize();
  const int rows = band->GetYSize();
  const GSpacing sampleSize = GDALGetDataTypeSizeBytes(type);
  const GSpacing step = southUp ? memory.Pitch : -memory.Pitch;
  char* first = southUp ? memory.First : memory.First + (rows - 1) * memory.Pitch;
  const int atOnce = RowsAtOnce(band, 1.0 * columns * sampleSize);
  CPLErr error = CE_None;
  for (int row = 0; row < rows && error == CE_None; row += atOnce)
  {
    const int count = std::min(atOnce, rows - row);
    const std::unique_ptr<void, decltype(&GDALDestroyScaledProgress)> progress(
      GDALCreateScaledProgress(
        1.0 * row / rows, 1.0 * (row + count) / rows, GoOn, const_cast<io::StepWatcher*>(&watcher)),
      &GDALDestroyScaledProgress);
    GDALRasterIOExtraArg extra;
    INIT_RASTERIO_EXTRA_ARG(extra);
    extra.pfnProgress = GDALScaledProgress;
    extra.pProgressData = progress.get();
    error = band->RasterIO(GF_Read, 0, row, columns, count, first + row * step, columns, count,
      type, sampleSize, step, &extra);
    // GDAL would keep all of it until its cache is full, a twentieth of the machine's memory.
    band->FlushCache();
    // Rows that go to their place at once come without progress.
    io::Advance(watcher, 1.0 * (row + count) / rows);
  }
  if (error != CE_None)
  {
    throw io::Failure(vtkErrorCode::PrematureEndOfFileError, GdalErrors::Take("cannot be read"));
  }
}

//------------------------------------------------------------------------------
/// Reads a band as it is into a new image, its southern row first.
vtkSmartPointer<vtkImageData> ReadBand(
  GDALRasterBand* band, SampleType type, bool southUp, const io::StepWatcher& watcher)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(band->GetXSize(), band->GetYSize(), 1);
  image->AllocateScalars(type.Vtk, 1);
  const GSpacing rowBytes = GSpacing(band->GetXSize()) * GDALGetDataTypeSizeBytes(type.Gdal);
  ReadRows(
    band, type.Gdal, southUp, { static_cast<char*>(image->GetScalarPointer()), rowBytes }, watcher);
  return image;
}

//------------------------------------------------------------------------------
/// The same for a band of floats, ready to be shaded.
vtkSmartPointer<vtkImageData> ReadPadded(
  GDALRasterBand* band, bool southUp, const io::StepWatcher& watcher)
{
  vtkNew<hosts::PaddedHeights> heights;
  heights->MakeRoom(band->GetXSize(), band->GetYSize());
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(band->GetXSize(), band->GetYSize(), 1);
  image->GetPointData()->SetScalars(heights);
  const GSpacing pitch = heights->GetPitch() * GSpacing(sizeof(float));
  ReadRows(
    band, GDT_Float32, southUp, { reinterpret_cast<char*>(heights->GetRow(0)), pitch }, watcher);
  return image;
}

//------------------------------------------------------------------------------
/// Reads a window of a band as it is, its southern row first.
vtkSmartPointer<vtkImageData> ReadWindowOf(
  GDALRasterBand* band, SampleType type, bool southUp, const RasterFile::Window& window)
{
  const int width = window.i1 - window.i0;
  const int height = window.j1 - window.j0;
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  image->AllocateScalars(type.Vtk, 1);
  const GSpacing size = GDALGetDataTypeSizeBytes(type.Gdal);
  const GSpacing pitch = width * size;
  char* first = static_cast<char*>(image->GetScalarPointer());
  const int row = southUp ? window.j0 : band->GetYSize() - window.j1;
  if (band->RasterIO(GF_Read, window.i0, row, width, height,
        southUp ? first : first + (height - 1) * pitch, width, height, type.Gdal, size,
        southUp ? pitch : -pitch, nullptr) != CE_None)
  {
    throw io::Failure(vtkErrorCode::PrematureEndOfFileError, GdalErrors::Take("cannot be read"));
  }
  return image;
}

//------------------------------------------------------------------------------
/// Their descriptions, or else their colours; an alpha at the end is none of them.
std::vector<std::string> BandNames(GDALDataset* dataset)
{
  std::vector<std::string> names;
  const int count = dataset->GetRasterCount();
  for (int i = 1; i <= count; ++i)
  {
    GDALRasterBand* band = dataset->GetRasterBand(i);
    const GDALColorInterp meaning = band->GetColorInterpretation();
    const std::string description = band->GetDescription();
    if (i == count && count > 1 && meaning == GCI_AlphaBand)
    {
      break;
    }
    const bool colored = meaning >= GCI_RedBand && meaning <= GCI_YCbCr_CrBand;
    names.push_back(!description.empty() || !colored
        ? description
        : CPLString(GDALGetColorInterpretationName(meaning)).tolower());
  }
  return names;
}

//------------------------------------------------------------------------------
void RefuseColor(GDALDataset* dataset)
{
  const std::vector<std::string> bands = BandNames(dataset);
  const GDALColorInterp meaning = dataset->GetRasterBand(1)->GetColorInterpretation();
  if (meaning == GCI_PaletteIndex)
  {
    throw OptionFailure(OptionFailure::Indices,
      "it holds palette colours; expected heights, or the choice of band 1", bands);
  }
  if (bands.size() > 1 &&
    (meaning == GCI_RedBand || (meaning >= GCI_HueBand && meaning <= GCI_YCbCr_CrBand)))
  {
    throw ManyComponents(bands);
  }
}

//------------------------------------------------------------------------------
/// Metres per unit of the heights, by the band's own unit or else the vertical reference system's.
void ReadHeightUnit(GDALRasterBand* band, const OGRSpatialReference* crs, RasterHeader& raster)
{
  const std::string unit = band->GetUnitType();
  const std::optional<double> metres = MetersPerHeightUnit(unit);
  if (!metres)
  {
    raster.Warnings.push_back({ "the unit of its heights, \"" + io::OneLine(unit).substr(0, 40) +
        "\", is not known; they are taken for metres",
      Warning::HeightScale });
  }
  else if (unit.empty() && crs && crs->IsVertical())
  {
    raster.HeightUnit = crs->GetTargetLinearUnits("VERT_CS");
  }
  else
  {
    raster.HeightUnit = *metres;
  }
}

//------------------------------------------------------------------------------
/// Takes over the value that is declared to be no data, if the band's numbers can have it.
void ReadNoData(GDALRasterBand* band, RasterHeader& raster)
{
  int declared = FALSE;
  const double noData = band->GetNoDataValue(&declared);
  if (!declared)
  {
    return;
  }
  const GDALDataType type = band->GetRasterDataType();
  if (type == GDT_Float32 && std::abs(noData) > std::numeric_limits<float>::max())
  {
    // The lowest double, declared for floats: they hold the lowest float.
    raster.NoData = std::copysign(std::numeric_limits<float>::max(), noData);
    return;
  }
  int clamped = FALSE;
  int rounded = FALSE;
  GDALAdjustValueToDataType(type, noData, &clamped, &rounded);
  if (clamped || rounded || (std::isnan(noData) && !GDALDataTypeIsFloating(type)))
  {
    std::ostringstream text;
    text.precision(10);
    text << "it declares " << noData << " to be no data, which its numbers ("
         << GDALGetDataTypeName(type) << ") cannot be; all samples are taken for heights";
    raster.Warnings.push_back({ text.str(), Warning::NoData });
    return;
  }
  raster.NoData = noData;
}

//------------------------------------------------------------------------------
/// Whether the axes of a grid without a reference system say themselves that they are longitude
/// and latitude, as NetCDF's conventions have it.
bool HasAxesInDegrees(GDALDataset* dataset)
{
  bool east = false;
  bool north = false;
  char** items = dataset->GetMetadata();
  for (; items && *items; ++items)
  {
    const std::string item = *items;
    const std::size_t units = item.find("#units=");
    if (units == std::string::npos)
    {
      continue;
    }
    const std::string unit = item.substr(units + 7);
    for (const char* degrees : { "degrees_", "degree_", "degrees", "degree" })
    {
      east = east || EQUAL(unit.c_str(), (std::string(degrees) + "east").c_str()) ||
        EQUAL(unit.c_str(), (std::string(degrees) + "E").c_str());
      north = north || EQUAL(unit.c_str(), (std::string(degrees) + "north").c_str()) ||
        EQUAL(unit.c_str(), (std::string(degrees) + "N").c_str());
    }
  }
  return east && north;
}

//------------------------------------------------------------------------------
/// A place that is told in another way than by six numbers.
void WarnOfUnusedPlace(GDALDataset* dataset, RasterHeader& raster)
{
  const int points = dataset->GetGCPCount();
  const char* how = points > 0            ? "ground control points that no straight map fits"
    : dataset->GetMetadata("RPC")         ? "rational polynomials"
    : dataset->GetMetadata("GEOLOCATION") ? "arrays of coordinates"
                                          : nullptr;
  if (how)
  {
    raster.Warnings.push_back({ "its place is told by " + std::string(how) +
        ", which are not used: samples lie 1 apart; gdalwarp -dstnodata -9999 makes a raster with "
        "a place",
      Warning::Spacing });
  }
}

//------------------------------------------------------------------------------
/// Takes over the reference system, and the spacing in metres that follows from it.
void ReadReference(GDALDataset* dataset, const ReadOptions& options, RasterHeader& raster)
{
  GeoReference& reference = raster.Reference;
  const OGRSpatialReference* crs = ReferenceSystem(dataset);
  OGRSpatialReference wgs84;
  if (options.Degrees && crs)
  {
    throw OptionFailure(OptionFailure::Degrees,
      "degrees are for files without a coordinate reference system, and this one has " +
        std::string(crs->GetName() ? crs->GetName() : "one"));
  }
  if (!crs && (options.Degrees || HasAxesInDegrees(dataset)))
  {
    wgs84.SetWellKnownGeogCS("WGS84");
    crs = &wgs84;
  }
  if (!reference.Present)
  {
    WarnOfUnusedPlace(dataset, raster);
    return;
  }
  if (const char* point = dataset->GetMetadataItem(GDALMD_AREA_OR_POINT))
  {
    reference.AreaOrPoint = point;
  }
  PlaceOnMap(raster);
  if (!crs)
  {
    return;
  }
  reference.Crs = WellKnownText(crs);
  if (crs->IsGeographic())
  {
    SpaceByDegrees(raster, crs->GetAngularUnits(), crs->GetSemiMajor(), crs->GetInvFlattening());
  }
  else
  {
    SpaceByProjection(raster, *crs);
  }
}

//------------------------------------------------------------------------------
/// Bytes as they are, all others as numbers of which 0 and NaN stay what they are.
SampleType AlphaType(GDALRasterBand* alpha)
{
  return alpha->GetRasterDataType() == GDT_Byte ? SampleType{ GDT_Byte, VTK_UNSIGNED_CHAR }
                                                : SampleType{ GDT_Float32, VTK_FLOAT };
}

//------------------------------------------------------------------------------
/// The band of alpha beside one of heights; null if there is none.
GDALRasterBand* FindAlpha(GDALDataset* dataset, GDALRasterBand* heights)
{
  for (int number = 1; number <= dataset->GetRasterCount(); ++number)
  {
    GDALRasterBand* band = dataset->GetRasterBand(number);
    if (band != heights && band->GetColorInterpretation() == GCI_AlphaBand)
    {
      return band;
    }
  }
  return nullptr;
}

//------------------------------------------------------------------------------
class GdalRaster : public RasterFile
{
public:
  GdalRaster(const std::string& file, DatasetPointer dataset, const ReadOptions& options);
  Raster Read(const MemoryPlan& plan, const io::StepWatcher& watcher) override;
  bool HasWindows() const override { return true; }
  Raster ReadWindow(const Window& window) override;
  double GetReadingBytes() const override { return this->Esri ? SizeOfText(this->Name) : 0.0; }

private:
  vtkSmartPointer<vtkImageData> ReadMask(const io::StepWatcher& watcher) const;

  std::string Name;
  DatasetPointer Dataset;
  GDALRasterBand* Band;
  GDALRasterBand* Alpha;
  SampleType Type;
  bool HasMask;
  bool Esri;
  std::shared_ptr<const EsriRows> Grid; // of such a grid, once windows are read
  bool Padded;
};

//------------------------------------------------------------------------------
GdalRaster::GdalRaster(const std::string& file, DatasetPointer dataset, const ReadOptions& options)
  : Name(file)
  , Dataset(std::move(dataset))
  , Band(this->Dataset->GetRasterBand(std::max(options.Band, 1)))
  , Alpha(FindAlpha(this->Dataset.get(), this->Band))
  , Type(FindSampleType(this->Band))
  , HasMask((this->Band->GetMaskFlags() & GMF_PER_DATASET) != 0 &&
      (this->Band->GetMaskFlags() & GMF_ALPHA) == 0)
  , Esri(IsEsriGrid(file))
  , Padded(options.Padded)
{
  RasterHeader& header = this->Header;
  ReadTransform(this->Dataset.get(), header.Reference);
  header.Columns = this->Band->GetXSize();
  header.Rows = this->Band->GetYSize();
  header.Bands = BandNames(this->Dataset.get());
  header.ScalarType = this->Esri ? VTK_FLOAT : this->Type.Vtk;
  header.Scale = this->Band->GetScale();
  header.Offset = this->Band->GetOffset();
  header.Masked = this->HasMask || this->Alpha;
  const GDALDriver* driver = this->Dataset->GetDriver();
  header.Driver = this->Esri ? "AAIGrid" : driver ? driver->GetDescription() : "";
  if (options.NoDataFromFile)
  {
    ReadNoData(this->Band, header);
  }
  ReadReference(this->Dataset.get(), options, header);
  ReadHeightUnit(this->Band, ReferenceSystem(this->Dataset.get()), header);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> GdalRaster::ReadMask(const io::StepWatcher& watcher) const
{
  const bool southUp = this->Header.Reference.SouthUp;
  return this->HasMask
    ? ReadBand(this->Band->GetMaskBand(), { GDT_Byte, VTK_UNSIGNED_CHAR }, southUp, watcher)
    : MakeMask(ReadBand(this->Alpha, AlphaType(this->Alpha), southUp, watcher));
}

//------------------------------------------------------------------------------
Raster GdalRaster::Read(const MemoryPlan& plan, const io::StepWatcher& watcher)
{
  GdalErrors errors;
  Raster raster;
  static_cast<RasterHeader&>(raster) = this->Header;
  const bool southUp = raster.Reference.SouthUp;
  MemoryPlan whole = plan;
  const double alpha =
    raster.Masked && !this->HasMask ? GDALGetDataTypeSizeBytes(AlphaType(this->Alpha).Gdal) : 0.0;
  whole.PerPixel += raster.Masked ? 1.0 + alpha : 0.0;
  if (this->Esri)
  {
    raster.Heights = ReadEsriHeights(this->Name, whole, watcher);
  }
  else
  {
    whole.Claim(raster.Columns, raster.Rows, GDALGetDataTypeSizeBytes(this->Type.Gdal),
      DecodingBytes(this->Dataset.get()));
    // What stands upright by an option of pictures is turned in one piece of memory.
    const bool padded =
      this->Padded && this->Type.Vtk == VTK_FLOAT && raster.Reference.Present && !IsScaled(raster);
    raster.Heights = padded ? ReadPadded(this->Band, southUp, watcher)
                            : ReadBand(this->Band, this->Type, southUp, watcher);
  }
  if (raster.Masked)
  {
    raster.Mask = this->ReadMask(watcher);
  }
  return raster;
}

//------------------------------------------------------------------------------
Raster GdalRaster::ReadWindow(const Window& window)
{
  GdalErrors errors;
  Raster raster;
  static_cast<RasterHeader&>(raster) = this->Header;
  raster.Columns = window.i1 - window.i0;
  raster.Rows = window.j1 - window.j0;
  const bool southUp = raster.Reference.SouthUp;
  if (this->Esri)
  {
    this->Grid = this->Grid ? this->Grid : EsriRows::Of(this->Name);
    raster.Heights = this->Grid->Read(window);
    return raster;
  }
  raster.Heights = ReadWindowOf(this->Band, this->Type, southUp, window);
  if (this->HasMask)
  {
    raster.Mask =
      ReadWindowOf(this->Band->GetMaskBand(), { GDT_Byte, VTK_UNSIGNED_CHAR }, southUp, window);
  }
  else if (this->Alpha)
  {
    raster.Mask = MakeMask(ReadWindowOf(this->Alpha, AlphaType(this->Alpha), southUp, window));
  }
  return raster;
}
}

//------------------------------------------------------------------------------
std::unique_ptr<RasterFile> OpenRaster(const std::string& file, const ReadOptions& options)
{
  GdalErrors errors;
  DatasetPointer dataset = IsEsriGrid(file) ? OpenEsriGrid(file) : OpenDataset(file);
  if (!dataset)
  {
    return nullptr;
  }
  const int count = dataset->GetRasterCount();
  if (count < 1 || options.Band > count)
  {
    throw io::Failure(vtkErrorCode::FileFormatError,
      count < 1
        ? "it holds no raster, but perhaps several: give the name that gdalinfo lists for one"
        : "it has no band " + std::to_string(options.Band) + ", only " + std::to_string(count));
  }
  if (options.Band == 0)
  {
    RefuseColor(dataset.get());
  }
  return TurnUpright(std::make_unique<GdalRaster>(file, std::move(dataset), options),
    FindOrientation(GdalBytesOf(file)));
}
//------------------------------------------------------------------------------
std::vector<std::string> FilesOf(const std::string& file)
{
  GdalErrors errors;
  std::vector<std::string> files;
  std::vector<std::string> left{ file };
  for (std::size_t k = 0; k < left.size(); ++k)
  {
    std::string reason; // whoever reads it says so
    DatasetPointer dataset;
    io::Guard([&] { dataset = OpenDataset(left[k]); }, reason);
    char** list = dataset ? dataset->GetFileList() : nullptr;
    for (char** name = list; name && *name; ++name)
    {
      files.emplace_back(*name);
      // A virtual raster names its sources, but not theirs.
      const bool further = io::LowerExtension(*name) == ".vrt";
      if (further && std::find(left.begin(), left.end(), *name) == left.end())
      {
        left.emplace_back(*name);
      }
    }
    CSLDestroy(list);
  }
  return files;
}
}
