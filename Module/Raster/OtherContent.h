// SPDX-License-Identifier: BSD-3-Clause
#ifndef OtherContent_h
#define OtherContent_h

#include "vtkIOReliefRasterModule.h" // For export macro

#include <string>

namespace relief::raster
{
/// Throws a Failure where a file that no format of rasters reads is something that can be told: raw
/// samples whose header is missing, a point cloud, vectors, an archive, a web page or other text.
VTKIORELIEFRASTER_EXPORT void RefuseOtherContent(const std::string& file);
}

#endif
