// SPDX-License-Identifier: BSD-3-Clause
#include "Gdal.h"
#include "Orientation.h"
#include "ReferencedPicture.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkPointData.h"

#include <cpl_error.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <memory>
#include <vector>

#ifdef __linux__
#include <dlfcn.h>
#endif

namespace relief::raster
{
namespace
{
//------------------------------------------------------------------------------
/// The types that colours have; others would be anybody's guess.
int ColorType(GDALRasterBand* band)
{
  switch (band->GetRasterDataType())
  {
    case GDT_Byte:
      return VTK_UNSIGNED_CHAR;
    case GDT_UInt16:
      return VTK_UNSIGNED_SHORT;
    case GDT_Float32:
      return VTK_FLOAT;
    case GDT_Float64:
      return VTK_DOUBLE;
    default:
      throw io::Failure(vtkErrorCode::FileFormatError,
        std::string("its samples are of the type ") +
          GDALGetDataTypeName(band->GetRasterDataType()) +
          "; expected are Byte or UInt16 (sRGB), Float32 or Float64 (linear)");
  }
}

//------------------------------------------------------------------------------
/// The bands of red, green and blue, or one of grey; infrared and others behind them are left out.
std::vector<int> ColorBands(GDALDataset* dataset)
{
  const int count = dataset->GetRasterCount();
  const bool grayAndAlpha =
    count > 1 && dataset->GetRasterBand(2)->GetColorInterpretation() == GCI_AlphaBand;
  return count < 3 || grayAndAlpha ? std::vector<int>{ 1 } : std::vector<int>{ 1, 2, 3 };
}

//------------------------------------------------------------------------------
/// The band of alpha, in the colours' own type; 0 if there is none.
int AlphaBand(GDALDataset* dataset)
{
  const GDALDataType type = dataset->GetRasterBand(1)->GetRasterDataType();
  for (int number = 2; number <= dataset->GetRasterCount(); ++number)
  {
    GDALRasterBand* band = dataset->GetRasterBand(number);
    if (band->GetColorInterpretation() == GCI_AlphaBand && band->GetRasterDataType() == type)
    {
      return number;
    }
  }
  return 0;
}

//------------------------------------------------------------------------------
/// The value of alpha that covers all.
double Opaque(int type)
{
  return type == VTK_UNSIGNED_CHAR ? 255.0 : type == VTK_UNSIGNED_SHORT ? 65535.0 : 1.0;
}

//------------------------------------------------------------------------------
/// Whether the file holds colours that alpha has multiplied.
bool IsPremultiplied(const std::string& file, GDALDataset* dataset)
{
  const GDALDriver* driver = dataset->GetDriver();
  const std::string format = driver ? driver->GetDescription() : "";
  return format == "EXR" || (format == "GTiff" && HasPremultipliedAlpha(GdalBytesOf(file)));
}

//------------------------------------------------------------------------------
/// Makes colours that alpha, the last component, has multiplied those that it covers with.
void DivideByAlpha(vtkImageData* image)
{
  vtkDataArray* pixels = image->GetPointData()->GetScalars();
  const double opaque = Opaque(image->GetScalarType());
  const bool whole = opaque > 1.0;
  const int last = pixels->GetNumberOfComponents() - 1;
  for (vtkIdType i = 0; i < pixels->GetNumberOfTuples(); ++i)
  {
    const double alpha = pixels->GetComponent(i, last) / opaque;
    for (int c = 0; alpha > 0.0 && alpha < 1.0 && c < last; ++c)
    {
      const double color = pixels->GetComponent(i, c) / alpha;
      pixels->SetComponent(i, c, whole ? std::min(opaque, std::floor(color + 0.5)) : color);
    }
  }
}

//------------------------------------------------------------------------------
/// Reads bands into the first components of an image, the southern row first.
void ReadBands(GDALDataset* dataset, std::vector<int> bands, vtkImageData* image, bool southUp,
  const io::StepWatcher& watcher)
{
  const int columns = dataset->GetRasterXSize();
  const int rows = dataset->GetRasterYSize();
  const GDALDataType type = dataset->GetRasterBand(1)->GetRasterDataType();
  const GSpacing size = GDALGetDataTypeSizeBytes(type);
  const GSpacing pixel = size * image->GetNumberOfScalarComponents();
  const GSpacing line = pixel * columns;
  auto* first = static_cast<char*>(image->GetScalarPointer());
  GDALRasterIOExtraArg extra;
  INIT_RASTERIO_EXTRA_ARG(extra);
  extra.pfnProgress = GoOn;
  extra.pProgressData = const_cast<io::StepWatcher*>(&watcher);
  const CPLErr error = dataset->RasterIO(GF_Read, 0, 0, columns, rows,
    southUp ? first : first + (rows - 1) * line, columns, rows, type,
    static_cast<int>(bands.size()), bands.data(), pixel, southUp ? line : -line, size, &extra);
  io::Advance(watcher, 1.0);
  if (error != CE_None)
  {
    throw io::Failure(vtkErrorCode::PrematureEndOfFileError, GdalErrors::Take("cannot be read"));
  }
}

//------------------------------------------------------------------------------
/// 0 where none of the bands has data, the file's own row first; empty if all have everywhere.
std::vector<unsigned char> ReadMask(GDALDataset* dataset, const std::vector<int>& bands)
{
  const int columns = dataset->GetRasterXSize();
  const int rows = dataset->GetRasterYSize();
  const std::size_t count = static_cast<std::size_t>(columns) * rows;
  std::vector<unsigned char> mask;
  for (const int number : bands)
  {
    GDALRasterBand* band = dataset->GetRasterBand(number);
    if (band->GetMaskFlags() & GMF_ALL_VALID)
    {
      return {};
    }
    std::vector<unsigned char> own(count);
    if (band->GetMaskBand()->RasterIO(GF_Read, 0, 0, columns, rows, own.data(), columns, rows,
          GDT_Byte, 0, 0, nullptr) != CE_None)
    {
      throw io::Failure(vtkErrorCode::FileFormatError, GdalErrors::Take("its mask cannot be read"));
    }
    mask.resize(count);
    std::transform(own.begin(), own.end(), mask.begin(), mask.begin(),
      [](unsigned char a, unsigned char b) { return std::max(a, b); });
  }
  return mask;
}

//------------------------------------------------------------------------------
/// Turns indices, in component 0, into red, green, blue and alpha.
void ApplyPalette(const GDALColorTable& palette, vtkImageData* image)
{
  auto* pixels = static_cast<unsigned char*>(image->GetScalarPointer());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    GDALColorEntry color{ 0, 0, 0, 0 };
    if (pixels[4 * i] < palette.GetColorEntryCount())
    {
      palette.GetColorEntryAsRGB(pixels[4 * i], &color);
    }
    const short components[] = { color.c1, color.c2, color.c3, color.c4 };
    std::copy_n(components, 4, pixels + 4 * i);
  }
}

//------------------------------------------------------------------------------
/// Multiplies the last component, alpha, by the mask's share.
void ApplyMask(const std::vector<unsigned char>& mask, vtkImageData* image, bool southUp)
{
  vtkDataArray* pixels = image->GetPointData()->GetScalars();
  const int alpha = pixels->GetNumberOfComponents() - 1;
  const int columns = image->GetDimensions()[0];
  const int rows = image->GetDimensions()[1];
  for (int row = 0; row < rows; ++row)
  {
    const std::size_t from = static_cast<std::size_t>(southUp ? row : rows - 1 - row) * columns;
    for (int i = 0; i < columns; ++i)
    {
      const vtkIdType pixel = static_cast<vtkIdType>(row) * columns + i;
      pixels->SetComponent(
        pixel, alpha, pixels->GetComponent(pixel, alpha) * mask[from + i] / 255.0);
    }
  }
}

}

//------------------------------------------------------------------------------
ByteSource GdalBytesOf(const std::string& file)
{
  const std::shared_ptr<VSILFILE> stream(VSIFOpenL(file.c_str(), "rb"),
    [](VSILFILE* opened)
    {
      if (opened)
      {
        VSIFCloseL(opened);
      }
    });
  return [stream](std::uint64_t begin, std::size_t count)
  {
    std::string bytes(stream ? count : 0, '\0');
    const bool there = stream && VSIFSeekL(stream.get(), begin, SEEK_SET) == 0;
    bytes.resize(there ? VSIFReadL(&bytes[0], 1, count, stream.get()) : 0);
    return bytes;
  };
}

//------------------------------------------------------------------------------
bool ReadReferencedPicture(const std::string& file, MemoryBudget& budget,
  const io::StepWatcher& watcher, ReferencedPicture& picture)
{
  GdalErrors errors;
  const DatasetPointer dataset = OpenDataset(file);
  if (!dataset)
  {
    return false;
  }
  if (dataset->GetRasterCount() < 1)
  {
    throw io::Failure(vtkErrorCode::FileFormatError,
      "it holds no raster, but perhaps several: give the name that gdalinfo lists for one");
  }
  ReadTransform(dataset.get(), picture.Reference);
  picture.Reference.Crs = WellKnownText(dataset->GetSpatialRef());
  const bool southUp = picture.Reference.SouthUp;

  GDALRasterBand* band = dataset->GetRasterBand(1);
  const int type = ColorType(band);
  const GDALColorTable* palette = band->GetColorTable();
  const bool indices = palette && type == VTK_UNSIGNED_CHAR;
  const std::vector<int> bands = indices ? std::vector<int>{ 1 } : ColorBands(dataset.get());
  const int alpha = indices ? 0 : AlphaBand(dataset.get());
  // The bands, alpha, and the masks of two bands at a time; then the picture turned.
  const double bytes = (bands.size() + 1.0) * GDALGetDataTypeSizeBytes(band->GetRasterDataType());
  const int orientation = picture.Reference.Present ? 1 : FindOrientation(GdalBytesOf(file));
  MemoryPlan{ budget, orientation > 1 ? 2.0 : 1.0, indices ? 4.0 : 2.0 }.Claim(
    band->GetXSize(), band->GetYSize(), bytes, DecodingBytes(dataset.get()));
  // A mask that is made of alpha would round it.
  const bool masked = !(alpha > 0 && (band->GetMaskFlags() & GMF_ALPHA) != 0);
  const std::vector<unsigned char> mask =
    masked ? ReadMask(dataset.get(), bands) : std::vector<unsigned char>();
  std::vector<int> all = bands;
  all.insert(all.end(), alpha > 0 ? 1 : 0, alpha);
  const int stored = static_cast<int>(all.size());
  const int components = indices ? 4 : stored + (mask.empty() || alpha > 0 ? 0 : 1);

  picture.Image = vtkSmartPointer<vtkImageData>::New();
  picture.Image->SetDimensions(dataset->GetRasterXSize(), dataset->GetRasterYSize(), 1);
  picture.Image->AllocateScalars(type, components);
  if (components > stored)
  {
    picture.Image->GetPointData()->GetScalars()->FillComponent(components - 1, Opaque(type));
  }
  ReadBands(dataset.get(), all, picture.Image, southUp, watcher);
  if (alpha > 0 && IsPremultiplied(file, dataset.get()))
  {
    DivideByAlpha(picture.Image);
  }
  if (indices)
  {
    ApplyPalette(*palette, picture.Image);
  }
  if (!mask.empty())
  {
    ApplyMask(mask, picture.Image, southUp);
  }
  picture.Image = TurnUpright(picture.Image, orientation);
  return true;
}

//------------------------------------------------------------------------------
bool SameReferenceSystem(const std::string& one, const std::string& other)
{
  if (one.empty() || other.empty())
  {
    return true;
  }
  GdalErrors errors;
  OGRSpatialReference a;
  OGRSpatialReference b;
  a.importFromWkt(one.c_str());
  b.importFromWkt(other.c_str());
  const char* const options[] = { "IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES",
    "CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS", nullptr };
  return a.IsSame(&b, options) != 0;
}

//------------------------------------------------------------------------------
void KeepGdalQuiet()
{
  CPLSetErrorHandler(CPLQuietErrorHandler);
#ifdef __linux__
  // Since GDAL 3.7 libtiff keeps its own handlers, and prints what it tells GDAL as well.
  using Handler = void (*)(const char*, const char*, va_list);
  using SetHandler = Handler (*)(Handler);
  for (const char* name : { "TIFFSetErrorHandler", "TIFFSetWarningHandler" })
  {
    if (auto* const set = reinterpret_cast<SetHandler>(dlsym(RTLD_DEFAULT, name)))
    {
      set(nullptr);
    }
  }
#endif
}
}
