// SPDX-License-Identifier: BSD-3-Clause
#ifndef MapPlace_h
#define MapPlace_h

/// @file
/// Where on the Earth a raster lies, for the sun above it. Not installed.

#include "Raster.h"

namespace relief::raster
{
/// A place on the Earth and how the map lies there, in degrees.
struct MapPlace
{
  double Longitude = 0.0; ///< on WGS 84, to the east
  double Latitude = 0.0;  ///< to the north
  /// The grid's convergence: clockwise from true north to the map's, which is +y of the frame that
  /// heights are shaded in.
  double Convergence = 0.0;
};

/// The place of a raster's centre. Throws a Failure where it has none, or the map is not of the
/// Earth.
VTKIORELIEFRASTER_EXPORT MapPlace PlaceOfCenter(const RasterHeader& raster);
}

#endif
