// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkOpenEXRLayerWriter
 * @brief   writes a shaded image and its layers into one OpenEXR file, for compositing
 *
 * The input is one slice in x and y, as vtkImageReliefShading gives it: linear colour in the
 * scalars, and every other point array a layer. Scalars and layers are float or double with 1, 3 or
 * 4 components; ghost arrays are passed over, anything else is refused with a message, for nothing
 * is dropped.
 *
 * <b>Names.</b> The scalars become the channels R, G, B and A (Y if they have one component), which
 * is the picture that every program shows. A layer's channels have its array's name in front, with
 * a dot: `Diffuse.R`, `Diffuse.G`, `Diffuse.B`. One component becomes Y (`Illumination.Y`). Arrays
 * that are no colours have the names that compositors give to such things: `Normals` and point
 * data's active normals and vectors X, Y and Z; `Thickness`, a length like a depth, Z.
 *
 * <b>Values.</b> Colours are linear with the primaries of Rec. 709, which the header says. Alpha is
 * 0 or 1, so colours are premultiplied and not, both at once. With PixelType Float, values are
 * written as they are and the layers Base, Diffuse, Scatter and Specular sum to the colour as they
 * do in memory. NaN becomes NoDataValue; infinities stay. A finite number too large for the file's
 * type becomes the largest that it holds, with one warning that counts them.
 *
 * <b>Rows.</b> The file's first row is the image's last, which has the largest y: north stays up.
 * Data and display window begin at (0, 0) whatever the image's extent.
 *
 * <b>Metadata.</b> `relief:origin` (world coordinates of the lower left sample) and
 * `relief:spacing` are always there, and pixelAspectRatio is the ratio of the spacings. If a Scene
 * is set, its lights, material and accuracy follow; Documentation/Layers.md has the list.
 * SetAttribute adds texts of your own.
 *
 * <b>Whole files.</b> As with vtkOpenImageIOWriter: the file is written beside its place and
 * renamed when it is whole. After an error or AbortExecute the temporary file is gone and a file
 * that was there before is untouched.
 *
 * <b>Errors.</b> Each gives one message with the file's name and, where the failure is OpenEXR's,
 * its own text. NoFileNameError. FileFormatError: OpenEXR cannot hold the input.
 * CannotOpenFileError: the place cannot be written. OutOfDiskSpaceError: writing failed on the way.
 * UnknownError: there is nothing to write (no input, no scalars, no points, several slices).
 * AbortExecute gives the code UserError and no message.
 *
 * <b>Threads.</b> OpenEXR compresses with the threads that the process has given it
 * (Imf::setGlobalThreadCount). If that is none, it is given vtkSMPTools's number.
 *
 * Of the superclass's settings only FileName is used.
 *
 * @sa vtkImageReliefShading vtkOpenImageIOWriter
 */
#ifndef vtkOpenEXRLayerWriter_h
#define vtkOpenEXRLayerWriter_h

#include "vtkIOReliefShadingModule.h" // For export macro
#include "vtkImageWriter.h"
#include "vtkSmartPointer.h" // For vtkSmartPointer

#include <map>    // For std::map
#include <string> // For std::string

class vtkReliefScene;

class VTKIORELIEFSHADING_EXPORT vtkOpenEXRLayerWriter : public vtkImageWriter
{
public:
  static vtkOpenEXRLayerWriter* New();
  vtkTypeMacro(vtkOpenEXRLayerWriter, vtkImageWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The scene that the image was shaded with: its parameters go into the header. Null for none.
   * Default: null.
   */
  void SetScene(vtkReliefScene* scene);
  vtkReliefScene* GetScene();
  ///@}

  enum PixelTypes
  {
    Half,
    Float
  };

  ///@{
  /**
   * The number type in the file: Float has 32 bits; Half has 16, which hold numbers up to 65504
   * with 11 significant bits. With Half, layers of one component (illumination, thickness) still
   * are Float, as renderers write depth. Default: Float. Range: the values of PixelTypes, clamped.
   */
  vtkSetClampMacro(PixelType, int, Half, Float);
  vtkGetMacro(PixelType, int);
  void SetPixelTypeToHalf() { this->SetPixelType(Half); }
  void SetPixelTypeToFloat() { this->SetPixelType(Float); }
  ///@}

  enum Compressions
  {
    NoCompression,
    ZIPS,
    ZIP,
    PIZ,
    DWAA
  };

  ///@{
  /**
   * The compression. ZIPS and ZIP are lossless, over blocks of 1 and of 16 rows: ZIPS is read
   * fastest by programs that go row by row, ZIP is smaller. PIZ, lossless, is best for noise. DWAA
   * is lossy in channels named R, G, B and Y, of layers too: take it for pictures, not for data.
   * Default: ZIP. Range: the values of Compressions, clamped.
   */
  vtkSetClampMacro(Compression, int, NoCompression, DWAA);
  vtkGetMacro(Compression, int);
  void SetCompressionToNone() { this->SetCompression(NoCompression); }
  void SetCompressionToZIPS() { this->SetCompression(ZIPS); }
  void SetCompressionToZIP() { this->SetCompression(ZIP); }
  void SetCompressionToPIZ() { this->SetCompression(PIZ); }
  void SetCompressionToDWAA() { this->SetCompression(DWAA); }
  ///@}

  ///@{
  /**
   * How much DWAA may lose: larger is smaller and worse. No unit, finite and at least 0, where it
   * loses next to nothing; else refused. Default: 45, OpenEXR's own, which the eye does not notice.
   */
  void SetDWACompressionLevel(double level);
  vtkGetMacro(DWACompressionLevel, double);
  ///@}

  ///@{
  /**
   * Whether the file is made of tiles, which viewers of large images read in part, or of rows,
   * which compositors read faster. Default: off.
   */
  vtkSetMacro(Tiled, bool);
  vtkGetMacro(Tiled, bool);
  vtkBooleanMacro(Tiled, bool);
  ///@}

  ///@{
  /**
   * Width and height of a tile, in samples. Used if Tiled is on. Default: 64. Range: 8 to 4096,
   * clamped.
   */
  vtkSetClampMacro(TileSize, int, 8, 4096);
  vtkGetMacro(TileSize, int);
  ///@}

  ///@{
  /**
   * What is written for NaN, which layers have where there is no data. In a compositor one NaN
   * spreads over the picture with every blur, so the default is 0, black below the alpha of 0 that
   * is there too. NaN keeps them NaN. Finite or NaN; infinities are refused.
   */
  void SetNoDataValue(double value);
  vtkGetMacro(NoDataValue, double);
  ///@}

  ///@{
  /**
   * Texts of your own for the header, by name: "owner", "comments", "capDate" and the like, or any
   * name of 1 to 255 characters that does not begin with "relief:" and is none by which OpenEXR
   * describes the file's structure ("channels", "compression" ...); those are refused. Null
   * removes. GetAttribute returns null if there is none of this name.
   */
  void SetAttribute(const std::string& name, const char* text);
  const char* GetAttribute(const std::string& name);
  void RemoveAllAttributes();
  ///@}

  ///@{
  /**
   * Whether the file is written under another name beside its place and renamed when it is whole.
   * Off, it is written in its place, and removed if it does not become whole: for callers who stage
   * several files themselves. Default: on.
   */
  vtkSetMacro(Staging, bool);
  vtkGetMacro(Staging, bool);
  vtkBooleanMacro(Staging, bool);
  ///@}

  /**
   * Writes the file. GetErrorCode tells whether it could: vtkErrorCode::NoError if so.
   */
  void Write() override;

  /**
   * Changes with the scene.
   */
  vtkMTimeType GetMTime() override;

protected:
  vtkOpenEXRLayerWriter();
  ~vtkOpenEXRLayerWriter() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  vtkSmartPointer<vtkReliefScene> Scene;
  int PixelType = Float;
  int Compression = ZIP;
  double DWACompressionLevel = 45.0;
  bool Tiled = false;
  int TileSize = 64;
  double NoDataValue = 0.0;
  bool Staging = true;
  std::map<std::string, std::string> Attributes;

private:
  vtkOpenEXRLayerWriter(const vtkOpenEXRLayerWriter&) = delete;
  void operator=(const vtkOpenEXRLayerWriter&) = delete;
};

#endif
