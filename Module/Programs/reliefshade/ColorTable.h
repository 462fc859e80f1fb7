// SPDX-License-Identifier: BSD-3-Clause
#ifndef ColorTable_h
#define ColorTable_h

#include "RasterFiles.h"

#include <string>

class vtkScalarsToColors;

namespace reliefshade
{

/// Reads colours by height from a text file in one of three forms; # begins a comment.
///
/// As GDAL's `gdaldem color-relief` takes it: in each line a height, a share of the raster's range
/// of heights (50%) or nv for no data, then red, green, blue and perhaps alpha from 0 to 255, or
/// the name of a colour; between them blanks, commas, colons or tabs. The order of lines does not
/// matter; of two equal heights the colour jumps from the first's to the second's.
///
/// As QGIS exports it, which its comment or an INTERPOLATION line tells: the same with a label
/// behind alpha. INTERPOLATED is as above; DISCRETE: a colour reaches from the height before, which
/// it leaves out, to its own; EXACT: it is for its own height alone. Other heights have no tint.
///
/// As GMT's .cpt, which that extension, its COLOR_MODEL (RGB or HSV) or a line of B, F or N tells:
/// segments of two heights with a colour each, B for below and F for above.
///
/// Throws a Failure that names the file and the line.
vtkSmartPointer<vtkScalarsToColors> readColorTable(const std::string& file, const Raster& raster);

}

#endif
