// SPDX-License-Identifier: BSD-3-Clause
#include "RasterReader.h"

#include "Failure.h"
#include "MemoryBudget.h"
#include "MessageLog.h"
#include "Watch.h"

#include "vtkDataArray.h"
#include "vtkImageExtractComponents.h"
#include "vtkNew.h"
#include "vtkOpenImageIOReader.h"
#include "vtkPointData.h"

#include <cmath>
#include <filesystem>
#include <functional>
#include <sstream>

namespace
{

using namespace reliefshade;

//------------------------------------------------------------------------------
void readGrey(const std::string& file, const ReadOptions& options, MemoryPlan plan, Raster& raster)
{
  vtkNew<vtkOpenImageIOReader> reader;
  reader->AlphaAsMaskOn();
  plan.Copies = 2.0; // one is of the band
  updateReader(reader, file, plan);
  vtkImageData* picture = reader->GetOutput();
  const bool masked = picture->GetPointData()->GetArray("Alpha") != nullptr;
  const int components = picture->GetNumberOfScalarComponents();
  if (options.Band > components)
  {
    throw std::runtime_error(
      "it has no band " + std::to_string(options.Band) + ", only " + std::to_string(components));
  }
  raster.Heights = picture;
  if (components != 1)
  {
    if (options.Band == 0)
    {
      throw std::runtime_error(std::to_string(components) +
        " components; expected 1 (height); reliefshade --band takes one of them as heights");
    }
    vtkNew<vtkImageExtractComponents> extract;
    extract->SetInputData(picture);
    extract->SetComponents(options.Band - 1);
    extract->Update();
    raster.Heights = extract->GetOutput();
  }
  if (masked)
  {
    raster.Mask = reader->GetMaskOutput();
  }
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
void MemoryPlan::Claim(double columns, double rows, double bytes, double meanwhile) const
{
  const double pixels = columns * rows;
  const double kept = (this->Copies * bytes + this->PerPixel) * pixels;
  this->Budget.Claim(kept, bytes * pixels + meanwhile);
}

//------------------------------------------------------------------------------
Raster readRaster(
  const std::string& file, const ReadOptions& options, MemoryBudget& budget, double bytesPerSample)
{
  Raster raster;
  aboutFile(file,
    [&]
    {
      std::error_code code;
      if (std::filesystem::is_directory(file, code))
      {
        throw std::runtime_error("is a directory");
      }
      const MemoryPlan plan{ budget, 1.0, bytesPerSample };
      if (!readReferenced(file, options, plan, raster))
      {
        readGrey(file, options, plan, raster);
      }
      for (const double spacing : raster.Spacing)
      {
        if (!(spacing > 0.0) || !std::isfinite(spacing))
        {
          std::ostringstream text;
          text << "its georeference sets samples " << raster.Spacing[0] << " x "
               << raster.Spacing[1] << " m apart; numbers above 0 are expected";
          throw std::runtime_error(text.str());
        }
      }
      if (!options.NoDataFromFile)
      {
        raster.NoData = options.NoData;
      }
      markNoData(raster);
      applyScale(raster);
    });
  return raster;
}

//------------------------------------------------------------------------------
void updateReader(vtkOpenImageIOReader* reader, const std::string& file, const MemoryPlan& plan)
{
  auto run = [](const std::function<void()>& step)
  {
    {
      const Silence silence;
      step();
    }
    stopIfInterrupted();
    if (hasError())
    {
      throw std::runtime_error(takeError());
    }
  };
  reader->SetFileName(file.c_str());
  watch(reader, false);
  // The program's own message tells what is needed in all.
  reader->SetMemoryLimit(0);
  run([&] { reader->UpdateInformation(); });
  const int* extent = reader->GetDataExtent();
  const int type = reader->GetDataScalarType();
  const double mask = 1.0;
  const vtkTypeInt64 left = plan.Budget.GetLeft();
  plan.Claim(extent[1] + 1.0, extent[3] + 1.0,
    static_cast<double>(reader->GetNumberOfScalarComponents()) *
        vtkDataArray::GetDataTypeSize(type) +
      mask);
  reader->SetMemoryLimit(left); // for tiles larger than the picture
  run([&] { reader->Update(); });
}

//------------------------------------------------------------------------------
bool looksLikeDegrees(const Raster& raster)
{
  if (!raster.Reference.Present || !raster.Reference.Crs.empty() || raster.Geographic)
  {
    return false;
  }
  int size[3];
  raster.Heights->GetDimensions(size);
  const double east = raster.MapOrigin[0] + size[0] * raster.MapStep[0];
  const double north = raster.MapOrigin[1] + size[1] * raster.MapStep[1];
  // Grids of metres are seldom finer than a tenth and start at the map's origin where they are.
  return raster.MapStep[0] < 0.1 && raster.MapOrigin[0] >= -181.0 && east <= 361.0 &&
    raster.MapOrigin[1] >= -91.0 && north <= 91.0;
}

}
