// SPDX-License-Identifier: BSD-3-Clause
#ifndef RasterFieldData_h
#define RasterFieldData_h

/// @file
/// A georeference as arrays of field data, which vtkReliefRasterReader documents. Not installed.

#include "Raster.h"

class vtkFieldData;

namespace relief::raster
{
/// Adds what the header tells, and where the first sample lies in the image: at `origin`, x and y.
void AddFieldData(const RasterHeader& header, const double* origin, vtkFieldData* data);

/// Where an image of a raster, or of a part of it, or of it in another resolution, lies on the map:
/// by the raster's field data, and the place and spacing of the image. Not Present where there are
/// no such data. Throws a Failure where they are damaged or the image is turned.
VTKIORELIEFRASTER_EXPORT GeoReference FindReference(vtkFieldData* data, vtkImageData* image);
}

#endif
