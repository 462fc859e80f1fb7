// SPDX-License-Identifier: BSD-3-Clause
#ifndef PictureForm_h
#define PictureForm_h

#include "GeoTiffForm.h"

#include "vtkType.h"

#include <string>

class vtkReliefScene;

namespace reliefshade
{

/// What of a shaded image is in a picture's file, and how it is stored there.
struct PictureForm
{
  /// VTK_FLOAT, linear, or VTK_UNSIGNED_CHAR, sRGB-encoded.
  int ScalarType = VTK_UNSIGNED_CHAR;
  /// Components: 1, grey, of images whose red, green and blue are one, or 3.
  int Colors = 3;
  /// One more component, for where there is no data.
  bool Alpha = true;
  /// Where there is no data is told by a value, which nothing else has: 0 or, in float, NaN.
  bool ByValue = false;
  /// Of TIFF, where the program is built with GDAL.
  relief::raster::GeoTiffForm Tiff;

  int GetComponents() const { return this->Colors + (this->Alpha ? 1 : 0); }
};

/// What gives a scene's picture colour, for a message; empty where red, green and blue of every
/// sample are one number, as long as no picture and no colour table lie over it.
std::string colorOf(vtkReliefScene* scene);

/// What a file holds where nobody says: grey, if it is that, and alpha where of some samples there
/// are no data; NaN tells of them in floating point TIFF. Programs that put pictures together want
/// all four components: OpenEXR, Radiance HDR and PFM have them.
PictureForm usualForm(const std::string& file, int scalarType, bool isGrey, bool lacksData);

}

#endif
