// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReferencedPicture_h
#define ReferencedPicture_h

/// @file
/// Pictures that know their place on the map (PictureGDAL.cxx); without GDAL there are none
/// (RasterFilePlain.cxx). Not installed.

#include "FileGuard.h"
#include "MemoryBudget.h"
#include "Raster.h"

#include <string>

namespace relief::raster
{
/// Colours, the southern (lower) row first.
struct ReferencedPicture
{
  vtkSmartPointer<vtkImageData> Image;
  GeoReference Reference;
};

/// Returns false if the file is none that GDAL reads. Components are grey or red, green and blue,
/// and alpha if the file tells where it has no data. Throws a Failure, or Aborted.
VTKIORELIEFRASTER_EXPORT bool ReadReferencedPicture(const std::string& file, MemoryBudget& budget,
  const io::StepWatcher& watcher, ReferencedPicture& picture);

/// Places a picture in the heights' frame, whose origin is their first sample: by its georeference
/// where both have one, else over the whole of the heights, edge to edge. Throws a Failure where it
/// would lie beside them, or has another coordinate reference system.
VTKIORELIEFRASTER_EXPORT void PlacePicture(
  const RasterHeader& heights, const ReferencedPicture& picture);

/// Whether two coordinate reference systems, as well-known text, are the same. Where one is not
/// given they are taken to be.
bool SameReferenceSystem(const std::string& one, const std::string& other);

/// GDAL takes over libtiff's messages, of others' files as well: for programs that print none.
VTKIORELIEFRASTER_EXPORT void KeepGdalQuiet();
}

#endif
