// SPDX-License-Identifier: BSD-3-Clause
#include "EsriGrid.h"
#include "Gdal.h"
#include "RasterReader.h"
#include "Watch.h"

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <stdexcept>

namespace
{

using namespace reliefshade;

/// The type of a band's samples in GDAL's and in VTK's words.
struct SampleType
{
  GDALDataType Gdal;
  int Vtk;
};

//------------------------------------------------------------------------------
SampleType sampleType(GDALRasterBand* band)
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
        throw std::runtime_error(
          std::string("its samples are complex (") + GDALGetDataTypeName(type) + ")");
      }
      return GDALGetDataTypeSizeBytes(type) == 1 ? SampleType{ GDT_Int16, VTK_SHORT }
                                                 : SampleType{ GDT_Float64, VTK_DOUBLE };
  }
}

//------------------------------------------------------------------------------
/// Reads a band as it is into a new image, its southern row first.
vtkSmartPointer<vtkImageData> readBand(GDALRasterBand* band, SampleType type, bool southUp)
{
  const int columns = band->GetXSize();
  const int rows = band->GetYSize();
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(columns, rows, 1);
  image->AllocateScalars(type.Vtk, 1);
  auto* first = static_cast<char*>(image->GetScalarPointer());
  const GSpacing sampleSize = GDALGetDataTypeSizeBytes(type.Gdal);
  const GSpacing rowSize = columns * sampleSize;
  GDALRasterIOExtraArg extra;
  INIT_RASTERIO_EXTRA_ARG(extra);
  extra.pfnProgress = goOnUnlessInterrupted;
  const CPLErr error =
    band->RasterIO(GF_Read, 0, 0, columns, rows, southUp ? first : first + (rows - 1) * rowSize,
      columns, rows, type.Gdal, sampleSize, southUp ? rowSize : -rowSize, &extra);
  stopIfInterrupted();
  if (error != CE_None)
  {
    throw std::runtime_error(GdalErrors::Take("cannot be read"));
  }
  return image;
}

//------------------------------------------------------------------------------
void refuseColour(GDALDataset* dataset)
{
  int components = dataset->GetRasterCount();
  if (dataset->GetRasterBand(components)->GetColorInterpretation() == GCI_AlphaBand)
  {
    --components;
  }
  const GDALColorInterp meaning = dataset->GetRasterBand(1)->GetColorInterpretation();
  if (meaning == GCI_PaletteIndex)
  {
    throw std::runtime_error("it holds palette colours; expected heights");
  }
  if (components > 1 &&
    (meaning == GCI_RedBand || (meaning >= GCI_HueBand && meaning <= GCI_YCbCr_CrBand)))
  {
    throw std::runtime_error(std::to_string(components) +
      " components; expected 1 (height); reliefshade --band takes one of them as heights");
  }
}

//------------------------------------------------------------------------------
/// Metres per unit of the heights, by the band's own unit or else the vertical reference system's.
double heightUnit(GDALRasterBand* band, const OGRSpatialReference* crs)
{
  const std::string unit = band->GetUnitType();
  for (const char* foot : { "ft", "foot", "feet", "international foot" })
  {
    if (EQUAL(unit.c_str(), foot))
    {
      return 0.3048;
    }
  }
  for (const char* foot : { "us-ft", "ftUS", "US survey foot", "US survey feet" })
  {
    if (EQUAL(unit.c_str(), foot))
    {
      return 1200.0 / 3937.0;
    }
  }
  if (unit.empty() && crs && crs->IsVertical())
  {
    return crs->GetTargetLinearUnits("VERT_CS");
  }
  return 1.0;
}

//------------------------------------------------------------------------------
/// Takes over the reference, and the spacing in metres that follows from it.
void readReference(GDALDataset* dataset, const ReadOptions& options, Raster& raster)
{
  GeoReference& reference = raster.Reference;
  const OGRSpatialReference* crs = dataset->GetSpatialRef();
  OGRSpatialReference wgs84;
  if (options.Degrees)
  {
    if (crs)
    {
      throw std::runtime_error("--degrees is for files without a coordinate reference system, and "
                               "this one has " +
        std::string(crs->GetName() ? crs->GetName() : "one"));
    }
    wgs84.SetWellKnownGeogCS("WGS84");
    crs = &wgs84;
  }
  if (!reference.Present)
  {
    return;
  }
  if (const char* point = dataset->GetMetadataItem(GDALMD_AREA_OR_POINT))
  {
    reference.AreaOrPoint = point;
  }
  placeOnMap(raster);
  raster.Spacing = raster.MapStep;
  if (!crs)
  {
    return;
  }
  reference.Crs = wellKnownText(crs);
  if (crs->IsGeographic())
  {
    spaceByDegrees(raster, crs->GetAngularUnits(), crs->GetSemiMajor(), crs->GetInvFlattening());
  }
  else
  {
    const double metres = crs->GetLinearUnits();
    raster.Spacing = { raster.MapStep[0] * metres, raster.MapStep[1] * metres };
  }
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
bool readReferenced(
  const std::string& file, const ReadOptions& options, const MemoryPlan& plan, Raster& raster)
{
  GdalErrors errors;
  const DatasetPointer dataset = openRaster(file);
  if (!dataset)
  {
    return false;
  }
  const int count = dataset->GetRasterCount();
  if (count < 1 || options.Band > count)
  {
    throw std::runtime_error(count < 1
        ? "it holds no raster, but perhaps several: give the name that gdalinfo lists for one"
        : "it has no band " + std::to_string(options.Band) + ", only " + std::to_string(count));
  }
  if (options.Band == 0)
  {
    refuseColour(dataset.get());
  }
  GDALRasterBand* band = dataset->GetRasterBand(std::max(options.Band, 1));

  GeoReference& reference = raster.Reference;
  readTransform(dataset.get(), reference);

  raster.Scale = band->GetScale();
  raster.Offset = band->GetOffset();
  const bool masked = (band->GetMaskFlags() & (GMF_PER_DATASET | GMF_ALPHA)) != 0;
  MemoryPlan whole = plan;
  whole.PerPixel +=
    (masked ? 1.0 : 0.0) + (raster.Scale != 1.0 || raster.Offset != 0.0 ? 4.0 : 0.0);
  if (isEsriGrid(file))
  {
    raster.Heights = readEsriGrid(file, whole).Heights;
  }
  else
  {
    const SampleType type = sampleType(band);
    whole.Claim(band->GetXSize(), band->GetYSize(), GDALGetDataTypeSizeBytes(type.Gdal),
      decodingBytes(dataset.get()));
    raster.Heights = readBand(band, type, reference.SouthUp);
  }
  if (masked)
  {
    raster.Mask = readBand(band->GetMaskBand(), { GDT_Byte, VTK_UNSIGNED_CHAR }, reference.SouthUp);
  }
  int hasNoData = FALSE;
  const double noData = band->GetNoDataValue(&hasNoData);
  if (hasNoData)
  {
    raster.NoData = noData;
  }
  readReference(dataset.get(), options, raster);
  raster.HeightUnit = heightUnit(band, dataset->GetSpatialRef());
  return true;
}

}
