// SPDX-License-Identifier: BSD-3-Clause
#ifndef PictureOutput_h
#define PictureOutput_h

#include "OutputFile.h"
#include "PictureForm.h"
#include "RasterFiles.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

class vtkImageData;

namespace relief::raster
{
class GeoTiffFile;
}

namespace reliefshade
{

class PictureRows;

/// The extension of a file's name with its dot, in lower case.
std::string lowerExtension(const std::string& file);

/// What a picture is written as where the user does not say: VTK_FLOAT, linear, for OpenEXR,
/// Radiance HDR and PFM, else VTK_UNSIGNED_CHAR, sRGB-encoded.
int usualScalarType(const std::string& file);

/// Whether a file of that name is GDAL's to write: TIFF, where the program is built with it.
bool isGeoTiff(const std::string& file);

/// Writes a picture as it is. Returns the writer's error code; the message is left to be taken.
unsigned long writePicture(const std::string& file, vtkImageData* image);

/// A part of a shaded image with its scalars in a form; what else it has is the same. The part
/// itself where they are, or where values mark what has no data, which is done as it is written.
vtkSmartPointer<vtkImageData> packPicture(vtkImageData* part, const PictureForm& form);

/// Writes one file, which is to be kept when all is written, some rows at a time. TIFF is GDAL's,
/// with the georeference where there is one, and takes no memory; everything else is
/// vtkOpenImageIOWriter's, which gets the picture as a whole.
class PictureOutput
{
public:
  /// Finds out at once, with a picture of a few samples, whether the place and the format can take
  /// the result: nobody wants to hear of it after the shading. What the format lacks of the form is
  /// left out: alpha, where samples without data are black then, or grey. Throws a Failure that
  /// names the file.
  /// A `streamed` one is not put together in memory where its format can do without: OpenEXR, whose
  /// float numbers are written in tiles.
  PictureOutput(const std::string& file, const PictureForm& form, const GeoReference& reference,
    bool streamed = false);
  ~PictureOutput();

  ///@{
  /// Writes a picture of so many columns and rows under the staged name, rows by rows in the order
  /// in which the file has them (IsUpward). A part has the whole width, and the scalars of the form
  /// or, as a shaded image, red, green, blue and alpha. What takes a while at the end, as overviews
  /// do, is shown if `bar`. Throws a Failure.
  void Begin(const int size[2]);
  void WriteRows(vtkImageData* part);
  void Finish(bool bar = false);
  ///@}

  /// All of these.
  void Write(vtkImageData* image);

  /// Whether the file's first row is that of the least y.
  bool IsUpward() const { return this->Referenced && this->Reference.SouthUp; }

  /// Bytes a sample, beside what is shaded at a time.
  double GetBytesPerSample() const;

  /// What of the form the format has.
  const PictureForm& GetForm() const { return this->Form; }

  /// Takes the target's name once it is kept.
  OutputFile& GetFile() { return this->File; }

private:
  void TryFormat();
  void BeginWhole(vtkImageData* part);

  OutputFile File;
  PictureForm Form;
  const GeoReference& Reference;
  bool Tiff;
  bool Referenced;
  bool Streamed;
  int Size[2] = { 0, 0 };
#ifdef RELIEFRASTER_USE_GDAL
  std::unique_ptr<relief::raster::GeoTiffFile> Rows; // of a TIFF
#endif
  std::vector<char> Buffer;            // rows in the file's order and form
  std::unique_ptr<PictureRows> Tiles;  // of OpenEXR, if it is streamed
  vtkSmartPointer<vtkImageData> Whole; // of another format
};

}

#endif
