// SPDX-License-Identifier: BSD-3-Clause
#ifndef Orientation_h
#define Orientation_h

/// @file
/// Turns pictures upright that are stored otherwise, as cameras do, by the number that
/// FindOrientation gives. Not installed.

#include "RasterFile.h"

#include <memory>

namespace relief::raster
{
/// The picture as it is to be seen; its lower row is the first one, before and after.
VTKIORELIEFRASTER_EXPORT vtkSmartPointer<vtkImageData> TurnUpright(
  vtkImageData* stored, int orientation);

/// The same for a file of heights, unless it has a georeference: that places the rows as they are
/// stored.
std::unique_ptr<RasterFile> TurnUpright(std::unique_ptr<RasterFile> file, int orientation);
}

#endif
