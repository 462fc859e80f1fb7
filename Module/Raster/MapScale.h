// SPDX-License-Identifier: BSD-3-Clause
#ifndef MapScale_h
#define MapScale_h

/// @file
/// How long a projected map's units are on the ground. Not installed; there where GDAL is.

#include "Raster.h"

class OGRSpatialReference;

namespace relief::raster
{
/// Places a raster of a projected map: MetersPerUnit becomes the map's unit by the projection's
/// scale at the raster's centre, along x and along y; scales within half a per cent of 1 are taken
/// for 1. Warns where the scale changes much within the raster, or cannot be told.
void SpaceByProjection(RasterHeader& raster, const OGRSpatialReference& crs);
}

#endif
