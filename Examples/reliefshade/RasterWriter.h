// SPDX-License-Identifier: BSD-3-Clause
#ifndef RasterWriter_h
#define RasterWriter_h

#include "Raster.h"
#include "StagedFile.h"

#include <string>

class vtkImageData;

namespace reliefshade
{

/// The extension of a file's name with its dot, in lower case.
std::string lowerExtension(const std::string& file);

/// What a picture is written as where the user does not say: VTK_FLOAT, linear, for OpenEXR,
/// Radiance HDR and PFM, else VTK_UNSIGNED_CHAR, sRGB-encoded.
int usualScalarType(const std::string& file);

/// Writes one file, which is to be kept when all is written. TIFF gets the georeference, where
/// there is one and the program is built with GDAL; everything else is vtkOpenImageIOWriter's.
class RasterWriter
{
public:
  /// Finds out at once, with a picture of a few samples, whether the place and the format can take
  /// the result: nobody wants to hear of it after the shading. Throws a Failure that names the
  /// file.
  RasterWriter(
    const std::string& file, int scalarType, int components, const GeoReference& reference);

  /// Writes the image's scalars under the staged name. Throws a Failure.
  void Write(vtkImageData* image);

  /// Takes the target's name once it is kept.
  StagedFile& GetFile() { return this->File; }

  /// Whether writing needs a copy of the colours without their alpha.
  bool DropsAlpha() const { return this->DropAlpha; }

private:
  StagedFile File;
  const GeoReference& Reference;
  bool Referenced = false;
  /// The format has no alpha: samples without data, which are black, are not told apart.
  bool DropAlpha = false;
};

/// The GDAL side of it (RasterWriterGDAL.cxx). Throws a std::runtime_error.
void writeGeoTiff(const std::string& file, vtkImageData* image, const GeoReference& reference);

}

#endif
