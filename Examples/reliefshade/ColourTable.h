// SPDX-License-Identifier: BSD-3-Clause
#ifndef ColourTable_h
#define ColourTable_h

#include "Raster.h"

#include <string>

class vtkScalarsToColors;

namespace reliefshade
{

/// Reads colours by height from a text file as GDAL's `gdaldem color-relief` takes it: in each line
/// a height, a share of the raster's range of heights (50%) or nv for no data, then red, green,
/// blue and perhaps alpha from 0 to 255, or the name of a colour; between them blanks, commas,
/// colons or tabs; # begins a comment. The order of lines does not matter; of two equal heights the
/// colour jumps from the first's to the second's. Throws a Failure that names the file and the
/// line.
vtkSmartPointer<vtkScalarsToColors> readColourTable(const std::string& file, const Raster& raster);

}

#endif
