// SPDX-License-Identifier: BSD-3-Clause
#ifndef Picture_h
#define Picture_h

#include "Raster.h"

#include <string>

namespace reliefshade
{

class MemoryBudget;

/// Colours, the southern (lower) row first.
struct Picture
{
  vtkSmartPointer<vtkImageData> Image;
  GeoReference Reference;
};

/// Reads a picture by its pixels alone, with all of its components; it will need so many copies of
/// them and `bytesPerPixel` besides. Throws a Failure.
vtkSmartPointer<vtkImageData> readPicture(
  const std::string& file, MemoryBudget& budget, double copies = 1.0, double bytesPerPixel = 0.0);

/// Reads a picture of 1 to 4 components and places it on the heights: by its georeference where
/// both have one, else over the whole of the heights, edge to edge. Throws a Failure, for a picture
/// in another coordinate reference system as well.
vtkSmartPointer<vtkImageData> readTexture(
  const std::string& file, const Raster& raster, MemoryBudget& budget);

/// The backend for pictures that know their place on the map (RasterReaderGDAL.cxx); the program
/// built without GDAL has none (RasterReaderPlain.cxx). Returns false if the file is not one of its
/// own; throws a std::runtime_error if it is one but cannot be read. Components are grey or red,
/// green and blue, and alpha if the file tells where it has no data.
bool readReferencedPicture(const std::string& file, MemoryBudget& budget, Picture& picture);

/// Whether two coordinate reference systems, as well-known text, are the same. Where one is not
/// given they are taken to be.
bool sameReferenceSystem(const std::string& one, const std::string& other);

}

#endif
