// SPDX-License-Identifier: BSD-3-Clause
#include "EsriGrid.h"
#include "Gdal.h"

#include "vtkErrorCode.h"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <ogr_spatialref.h>

#include <filesystem>
#include <iomanip>
#include <limits>
#include <locale>
#include <memory>
#include <sstream>

namespace relief::raster
{
namespace
{
/// What the .prj file beside a grid says, as well-known text; empty if there is none.
std::string ReadProjection(const std::string& file)
{
  const std::string name = std::filesystem::path(file).replace_extension(".prj").string();
  const std::unique_ptr<char*, decltype(&CSLDestroy)> lines(CSLLoad(name.c_str()), &CSLDestroy);
  OGRSpatialReference crs;
  return lines && crs.importFromESRI(lines.get()) == OGRERR_NONE ? WellKnownText(&crs) : "";
}

//------------------------------------------------------------------------------
/// The header as a virtual raster of GDAL's, which has no heights.
std::string VirtualRaster(const std::string& file)
{
  const RasterHeader header = ReadEsriHeader(file);
  const std::unique_ptr<char, decltype(&VSIFree)> crs(
    CPLEscapeString(ReadProjection(file).c_str(), -1, CPLES_XML), &VSIFree);
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(std::numeric_limits<double>::max_digits10);
  text << "<VRTDataset rasterXSize=\"" << header.Columns << "\" rasterYSize=\"" << header.Rows
       << "\"><SRS>" << crs.get() << "</SRS><GeoTransform>";
  const char* separator = "";
  for (const double number : header.Reference.Transform)
  {
    text << separator << number;
    separator = ", ";
  }
  text << "</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\">";
  if (header.NoData)
  {
    text << "<NoDataValue>" << *header.NoData << "</NoDataValue>";
  }
  text << "</VRTRasterBand></VRTDataset>";
  return text.str();
}
}

//------------------------------------------------------------------------------
DatasetPointer OpenEsriGrid(const std::string& file)
{
  try
  {
    if (DatasetPointer dataset = OpenDataset(file))
    {
      return dataset;
    }
  }
  catch (const io::Failure&)
  {
    // The header, read by its own rules, tells more.
    GdalErrors::Take("");
  }
  DatasetPointer dataset(GDALDataset::Open(
    VirtualRaster(file).c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR));
  if (!dataset)
  {
    throw io::Failure(
      vtkErrorCode::FileFormatError, io::OneLine(GdalErrors::Take("cannot be opened")));
  }
  return dataset;
}
}
