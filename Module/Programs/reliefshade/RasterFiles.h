// SPDX-License-Identifier: BSD-3-Clause
#ifndef RasterFiles_h
#define RasterFiles_h

#include "MapFrame.h"
#include "RasterFile.h"

#include <memory>
#include <string>

namespace reliefshade
{

using relief::raster::GeoReference;
using relief::raster::MapFrame;
using relief::raster::MemoryBudget;
using relief::raster::MemoryPlan;
using relief::raster::Raster;
using relief::raster::ReadOptions;

/// The memory that the machine has, in bytes.
double machineMemory();

/// Opens such a file by its header. Throws a Failure, or an OptionFailure of Module/Raster.
std::unique_ptr<relief::raster::RasterFile> openRaster(
  const std::string& file, const ReadOptions& options);

/// Reads heights from any raster that Module/Raster knows, else from a picture that OpenImageIO
/// knows, in the file's own number type; `bytesPerSample` is what each of them will need besides.
/// `opened` may be the file, opened with these options. Throws a Failure that names the file.
Raster readRaster(const std::string& file, const ReadOptions& options, MemoryBudget& budget,
  double bytesPerSample = 0.0, std::unique_ptr<relief::raster::RasterFile> opened = nullptr);

/// Masks heights, which `heights` names, by a raster of their size: there is no data where that is
/// 0, or its alpha or mask hides it; of several colours with an alpha the alpha alone counts,
/// unless the options name a band. Samples that are masked already stay so. Throws a Failure.
void addMask(const std::string& file, const ReadOptions& options, const std::string& heights,
  MemoryBudget& budget, Raster& raster);

/// Reads a picture by its pixels alone, with all of its components; it will need so many copies of
/// them and `bytesPerPixel` besides. Throws a Failure.
vtkSmartPointer<vtkImageData> readPicture(
  const std::string& file, MemoryBudget& budget, double copies = 1.0, double bytesPerPixel = 0.0);

/// Reads a picture of 1 to 4 components and places it on the heights: by its georeference where
/// both have one, else over the whole of the heights, edge to edge. Throws a Failure, for a picture
/// in another coordinate reference system as well.
vtkSmartPointer<vtkImageData> readTexture(
  const std::string& file, const Raster& raster, MemoryBudget& budget);

}

#endif
