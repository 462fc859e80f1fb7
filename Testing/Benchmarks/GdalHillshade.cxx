// SPDX-License-Identifier: BSD-3-Clause
#include "GdalHillshade.h"

#include <gdal.h>
#include <gdal_utils.h>

#include <cstdlib>
#include <iostream>
#include <string>

namespace bench
{

class GdalHillshade::Internals
{
public:
  GDALDatasetH Heights = nullptr;
};

namespace
{
void Check(bool good, const char* what)
{
  if (!good)
  {
    std::cerr << "GDAL: " << what << ": " << CPLGetLastErrorMsg() << "\n";
    std::exit(EXIT_FAILURE);
  }
}
}

GdalHillshade::GdalHillshade(const Relief& relief)
  : Internal(new Internals)
{
  GDALAllRegister();
  this->Internal->Heights = GDALCreate(
    GDALGetDriverByName("MEM"), "", relief.columns, relief.rows, 1, GDT_Float32, nullptr);
  Check(this->Internal->Heights != nullptr, "no dataset in memory");
  double transform[6] = { 0.0, relief.spacing, 0.0, relief.rows * relief.spacing, 0.0,
    -relief.spacing };
  GDALSetGeoTransform(this->Internal->Heights, transform);
  // GDAL's first row is the northernmost.
  for (int j = 0; j < relief.rows; ++j)
  {
    const std::size_t at = static_cast<std::size_t>(relief.rows - 1 - j) * relief.columns;
    Check(GDALRasterIO(GDALGetRasterBand(this->Internal->Heights, 1), GF_Write, 0, j,
            relief.columns, 1, const_cast<float*>(relief.heights.data() + at), relief.columns, 1,
            GDT_Float32, 0, 0) == CE_None,
      "heights not taken");
  }
}

GdalHillshade::~GdalHillshade()
{
  GDALClose(this->Internal->Heights);
}

void GdalHillshade::Run(double azimuth, double altitude) const
{
  std::string words[] = { "-of", "MEM", "-az", std::to_string(azimuth), "-alt",
    std::to_string(altitude) };
  char* arguments[7] = {};
  for (int k = 0; k < 6; ++k)
  {
    arguments[k] = &words[k][0];
  }
  GDALDEMProcessingOptions* options = GDALDEMProcessingOptionsNew(arguments, nullptr);
  GDALDatasetH shaded =
    GDALDEMProcessing("", this->Internal->Heights, "hillshade", nullptr, options, nullptr);
  GDALDEMProcessingOptionsFree(options);
  Check(shaded != nullptr, "no hillshade");
  GDALClose(shaded);
}

}
