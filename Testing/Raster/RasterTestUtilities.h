// SPDX-License-Identifier: BSD-3-Clause
#ifndef RasterTestUtilities_h
#define RasterTestUtilities_h

#include "FileTestUtilities.h"

#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <array>
#include <functional>

/// A raster of 5 x 4 samples, written by GDAL alone: height 10 * row + column, the northern row 0,
/// unless another is given.
struct TestRaster
{
  static constexpr int Columns = 5;
  static constexpr int Rows = 4;
  GDALDataType Type = GDT_Float32;
  int Epsg = 32632;
  std::array<double, 6> Transform{ 500000.0, 30.0, 0.0, 5000000.0, 0.0, -20.0 };
  int Bands = 1;
  std::function<double(int, int, int)> Value = [](int band, int row, int column)
  { return 100.0 * (band - 1) + 10.0 * row + column; };
  /// What else is to be said.
  std::function<void(GDALDataset*)> More = [](GDALDataset*) {};
};

inline void WriteRaster(const std::string& name, TestRaster raster)
{
  GDALAllRegister();
  GDALDataset* file = GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
    name.c_str(), TestRaster::Columns, TestRaster::Rows, raster.Bands, raster.Type, nullptr);
  if (raster.Transform[1] != 0.0 || raster.Transform[2] != 0.0)
  {
    file->SetGeoTransform(raster.Transform.data());
  }
  if (raster.Epsg > 0)
  {
    OGRSpatialReference crs;
    crs.importFromEPSG(raster.Epsg);
    file->SetSpatialRef(&crs);
  }
  raster.More(file);
  for (int band = 1; band <= raster.Bands; ++band)
  {
    std::vector<double> values;
    for (int row = 0; row < TestRaster::Rows; ++row)
    {
      for (int column = 0; column < TestRaster::Columns; ++column)
      {
        values.push_back(raster.Value(band, row, column));
      }
    }
    CPLErr error =
      file->GetRasterBand(band)->RasterIO(GF_Write, 0, 0, TestRaster::Columns, TestRaster::Rows,
        values.data(), TestRaster::Columns, TestRaster::Rows, GDT_Float64, 0, 0, nullptr);
    static_cast<void>(error);
  }
  GDALClose(file);
}

#endif
