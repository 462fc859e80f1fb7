// SPDX-License-Identifier: BSD-3-Clause
#include "WarpedPicture.h"

#include "FileGuard.h"
#include "Gdal.h"

#include "vtkErrorCode.h"

#include <cpl_string.h>
#include <gdal_alg.h>
#include <gdalwarper.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>

namespace relief::streaming
{
namespace
{
using raster::DatasetPointer;
using raster::GdalErrors;

struct DestroyOptions
{
  void operator()(GDALWarpOptions* options) const { GDALDestroyWarpOptions(options); }
};

io::Failure Refusal(const char* what, const std::string& file)
{
  return { vtkErrorCode::FileFormatError,
    what + (": " + GdalErrors::Take("GDAL gives no reason", file)) };
}

//------------------------------------------------------------------------------
/// Cubic: at the raster's own resolution it keeps what bilinear would blur. Where the tiles are
/// coarser, its width grows with them, so that no sample is passed over.
std::unique_ptr<GDALWarpOptions, DestroyOptions> OptionsOf(GDALDataset* picture, double scale)
{
  std::unique_ptr<GDALWarpOptions, DestroyOptions> options(GDALCreateWarpOptions());
  options->hSrcDS = picture;
  options->eResampleAlg = GRA_Cubic;
  options->eWorkingDataType = GDT_Byte;
  options->nBandCount = 3;
  options->panSrcBands = static_cast<int*>(CPLMalloc(3 * sizeof(int)));
  options->panDstBands = static_cast<int*>(CPLMalloc(3 * sizeof(int)));
  for (int k = 0; k < 3; ++k)
  {
    options->panSrcBands[k] = k + 1;
    options->panDstBands[k] = k + 1;
  }
  options->nSrcAlphaBand = 4;
  options->nDstAlphaBand = 4;
  CPLStringList words;
  words.SetNameValue("INIT_DEST", "0");
  // GDAL would find it out for each part that is read, from that part's edges.
  const std::string text = std::to_string(std::min(1.0, scale));
  words.SetNameValue("XSCALE", text.c_str());
  words.SetNameValue("YSCALE", text.c_str());
  options->papszWarpOptions = words.StealList();
  return options;
}
}

struct WarpedPicture::Internals
{
  DatasetPointer Picture; // before what reads from it goes
  DatasetPointer Warped;
};

//------------------------------------------------------------------------------
WarpedPicture::WarpedPicture(const std::string& file, const TilePlan& plan)
  : Internal(new Internals)
{
  const GdalErrors errors;
  DatasetPointer& picture = this->Internal->Picture;
  picture.reset(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR));
  if (!picture || picture->GetRasterCount() != 4)
  {
    throw Refusal("the shaded picture cannot be read", file);
  }
  const int zoom = plan.Zoom[1];
  const double resolution = ResolutionOf(zoom, plan.Size);
  const TileSpan all = plan.Around();
  this->First[0] = all.Columns[0] * plan.Size;
  this->First[1] = all.Rows[0] * plan.Size;
  const std::int64_t columns = (all.Columns[1] + 1) * plan.Size - this->First[0];
  const std::int64_t rows = (all.Rows[1] + 1) * plan.Size - this->First[1];
  double transform[6] = { static_cast<double>(this->First[0]) * resolution - MercatorHalf,
    resolution, 0.0, MercatorHalf - static_cast<double>(this->First[1]) * resolution, 0.0,
    -resolution };

  // From the map to the picture, sample by sample.
  CPLStringList words;
  words.SetNameValue("DST_SRS", "EPSG:3857");
  void* transformer = GDALCreateGenImgProjTransformer2(picture.get(), nullptr, words.List());
  if (!transformer)
  {
    throw Refusal("the shaded picture cannot be put on a web map", file);
  }
  GDALSetGenImgProjTransformerDstGeoTransform(transformer, transform);
  const auto options = OptionsOf(picture.get(), plan.Resolution / resolution);
  options->pfnTransformer = GDALGenImgProjTransform;
  options->pTransformerArg = transformer;
  this->Internal->Warped.reset(GDALDataset::FromHandle(GDALCreateWarpedVRT(
    picture.get(), static_cast<int>(columns), static_cast<int>(rows), transform, options.get())));
  if (!this->Internal->Warped || this->Internal->Warped->GetRasterCount() != 4)
  {
    throw Refusal("the shaded picture cannot be put on a web map", file);
  }
}

//------------------------------------------------------------------------------
WarpedPicture::~WarpedPicture()
{
  const GdalErrors errors;
  this->Internal->Warped.reset();
}

//------------------------------------------------------------------------------
void WarpedPicture::Read(
  std::int64_t column, std::int64_t row, int columns, int rows, unsigned char* rgba)
{
  const GdalErrors errors;
  const CPLErr error =
    this->Internal->Warped->RasterIO(GF_Read, static_cast<int>(column - this->First[0]),
      static_cast<int>(row - this->First[1]), columns, rows, rgba, columns, rows, GDT_Byte, 4,
      nullptr, 4, static_cast<GSpacing>(4) * columns, 1, nullptr);
  if (error != CE_None || GdalErrors::Any())
  {
    throw Refusal("the shaded picture cannot be put on a web map", "");
  }
}
}
