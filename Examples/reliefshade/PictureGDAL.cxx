// SPDX-License-Identifier: BSD-3-Clause
#include "Gdal.h"
#include "Picture.h"
#include "RasterReader.h"
#include "Watch.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"

#include <ogr_spatialref.h>

#include <algorithm>
#include <stdexcept>
#include <vector>

namespace
{

using namespace reliefshade;

//------------------------------------------------------------------------------
/// The types that colours have; others would be anybody's guess.
int colourType(GDALRasterBand* band)
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
      throw std::runtime_error(std::string("its samples are of the type ") +
        GDALGetDataTypeName(band->GetRasterDataType()) +
        "; expected are Byte or UInt16 (sRGB), Float32 or Float64 (linear)");
  }
}

//------------------------------------------------------------------------------
/// The bands of red, green and blue, or one of grey; infrared and others behind them are left out.
std::vector<int> colourBands(GDALDataset* dataset)
{
  const int count = dataset->GetRasterCount();
  const bool greyAndAlpha =
    count > 1 && dataset->GetRasterBand(2)->GetColorInterpretation() == GCI_AlphaBand;
  return count < 3 || greyAndAlpha ? std::vector<int>{ 1 } : std::vector<int>{ 1, 2, 3 };
}

//------------------------------------------------------------------------------
/// Reads bands into the first components of an image, the southern row first.
void readBands(GDALDataset* dataset, std::vector<int> bands, vtkImageData* image, bool southUp)
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
  extra.pfnProgress = goOnUnlessInterrupted;
  const CPLErr error = dataset->RasterIO(GF_Read, 0, 0, columns, rows,
    southUp ? first : first + (rows - 1) * line, columns, rows, type,
    static_cast<int>(bands.size()), bands.data(), pixel, southUp ? line : -line, size, &extra);
  stopIfInterrupted();
  if (error != CE_None)
  {
    throw std::runtime_error(GdalErrors::Take("cannot be read"));
  }
}

//------------------------------------------------------------------------------
/// 0 where none of the bands has data, the file's own row first; empty if all have everywhere.
std::vector<unsigned char> readMask(GDALDataset* dataset, const std::vector<int>& bands)
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
      throw std::runtime_error(GdalErrors::Take("its mask cannot be read"));
    }
    mask.resize(count);
    std::transform(own.begin(), own.end(), mask.begin(), mask.begin(),
      [](unsigned char a, unsigned char b) { return std::max(a, b); });
  }
  return mask;
}

//------------------------------------------------------------------------------
/// Turns indices, in component 0, into red, green, blue and alpha.
void applyPalette(const GDALColorTable& palette, vtkImageData* image)
{
  auto* pixels = static_cast<unsigned char*>(image->GetScalarPointer());
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    GDALColorEntry colour{ 0, 0, 0, 0 };
    if (pixels[4 * i] < palette.GetColorEntryCount())
    {
      palette.GetColorEntryAsRGB(pixels[4 * i], &colour);
    }
    const short components[] = { colour.c1, colour.c2, colour.c3, colour.c4 };
    std::copy_n(components, 4, pixels + 4 * i);
  }
}

//------------------------------------------------------------------------------
/// Multiplies the last component, alpha, by the mask's share.
void applyMask(const std::vector<unsigned char>& mask, vtkImageData* image, bool southUp)
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

namespace reliefshade
{

//------------------------------------------------------------------------------
bool readReferencedPicture(const std::string& file, MemoryBudget& budget, Picture& picture)
{
  GdalErrors errors;
  const DatasetPointer dataset = openRaster(file);
  if (!dataset)
  {
    return false;
  }
  if (dataset->GetRasterCount() < 1)
  {
    throw std::runtime_error(
      "it holds no raster, but perhaps several: give the name that gdalinfo lists for one");
  }
  readTransform(dataset.get(), picture.Reference);
  picture.Reference.Crs = wellKnownText(dataset->GetSpatialRef());
  const bool southUp = picture.Reference.SouthUp;

  GDALRasterBand* band = dataset->GetRasterBand(1);
  const int type = colourType(band);
  const GDALColorTable* palette = band->GetColorTable();
  const bool indices = palette && type == VTK_UNSIGNED_CHAR;
  const std::vector<int> bands = indices ? std::vector<int>{ 1 } : colourBands(dataset.get());
  // The bands, alpha, and the masks of two bands at a time.
  const double bytes = (bands.size() + 1.0) * GDALGetDataTypeSizeBytes(band->GetRasterDataType());
  MemoryPlan{ budget, 1.0, indices ? 4.0 : 2.0 }.Claim(
    band->GetXSize(), band->GetYSize(), bytes, decodingBytes(dataset.get()));
  const std::vector<unsigned char> mask = readMask(dataset.get(), bands);
  const int colours = static_cast<int>(bands.size());
  const int components = indices ? 4 : colours + (mask.empty() ? 0 : 1);

  picture.Image = vtkSmartPointer<vtkImageData>::New();
  picture.Image->SetDimensions(dataset->GetRasterXSize(), dataset->GetRasterYSize(), 1);
  picture.Image->AllocateScalars(type, components);
  if (components > colours)
  {
    const double opaque = type == VTK_UNSIGNED_CHAR ? 255.0
      : type == VTK_UNSIGNED_SHORT                  ? 65535.0
                                                    : 1.0;
    picture.Image->GetPointData()->GetScalars()->FillComponent(components - 1, opaque);
  }
  readBands(dataset.get(), bands, picture.Image, southUp);
  if (indices)
  {
    applyPalette(*palette, picture.Image);
  }
  if (!mask.empty())
  {
    applyMask(mask, picture.Image, southUp);
  }
  return true;
}

//------------------------------------------------------------------------------
bool sameReferenceSystem(const std::string& one, const std::string& other)
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

}
