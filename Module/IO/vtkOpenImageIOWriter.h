// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkOpenImageIOWriter
 * @brief   writes an image to any file format that OpenImageIO knows
 *
 * The input is one slice in x and y with scalars of any numeric type. The extension of FileName
 * chooses the format. For the order of rows see vtkOpenImageIOReader: what this class writes, that
 * one reads back the same way up. One component is written as grey, two as grey and alpha, three as
 * RGB, four as RGBA; further ones are further channels.
 *
 * <b>Values.</b> Values are written as they are, and no colour space is applied or claimed: linear
 * colour that goes into an 8-bit file is to be encoded before (vtkImageReliefShading does so in its
 * 8-bit output). Colour is not multiplied or divided by alpha. A PixelType other than the scalars'
 * makes OpenImageIO convert: the full range of an unsigned integer stands for 0 ... 1, floating
 * point numbers are clamped to that first and NaN becomes 0. Floating point files keep NaN and
 * infinities.
 *
 * <b>Nothing is dropped.</b> A format that cannot hold the components (JPEG and alpha, say), the
 * type (PNG and float) or the size (icons of more than 256 columns) is refused with a message that
 * names the format and what to do; so is what OpenImageIO's writer of a format would not survive or
 * would spoil. One exception: double becomes float, where PixelType is Automatic and the format has
 * no double.
 *
 * <b>Metadata.</b> Strings and numbers in the input's field data become attributes of the same
 * name, as far as the format can hold them. Left out are arrays of more than 64 KiB and those that
 * tell how another file was stored and not what it shows: Orientation, compression, colour profile,
 * the reader's ChannelNames and DataWindowOrigin, and all names that begin with `oiio:` or a
 * format's name and a colon.
 *
 * <b>Whole files.</b> The file is written as `.<name>.<process>-<count>.tmp.<extension>` beside its
 * place and renamed when it is whole. After an error or AbortExecute the temporary file is gone and
 * a file that was there before is untouched. A link is followed; permissions of a replaced file are
 * kept.
 *
 * <b>Errors.</b> Each gives one message with the file's name and, where the failure is
 * OpenImageIO's, its own text; no second message comes from the pipeline. NoFileNameError.
 * UnrecognizedFileTypeError: no format that is written has this extension. FileFormatError: the
 * format cannot hold the input. CannotOpenFileError: the place cannot be written.
 * OutOfDiskSpaceError: writing failed on the way. UnknownError: there is nothing to write (no
 * input, no scalars, no points, several slices). AbortExecute gives the code UserError and no
 * message.
 *
 * Of the superclass's settings only FileName is used.
 *
 * @sa vtkOpenImageIOReader vtkOpenEXRLayerWriter
 */
#ifndef vtkOpenImageIOWriter_h
#define vtkOpenImageIOWriter_h

#include "vtkIOReliefShadingModule.h" // For export macro
#include "vtkImageWriter.h"

class VTKIORELIEFSHADING_EXPORT vtkOpenImageIOWriter : public vtkImageWriter
{
public:
  static vtkOpenImageIOWriter* New();
  vtkTypeMacro(vtkOpenImageIOWriter, vtkImageWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum PixelTypes
  {
    Automatic,
    UnsignedChar,
    UnsignedShort,
    Half,
    Float
  };

  ///@{
  /**
   * The number type in the file. Automatic: the scalars' own. Default: Automatic. Range: the values
   * of PixelTypes, clamped.
   */
  vtkSetClampMacro(PixelType, int, Automatic, Float);
  vtkGetMacro(PixelType, int);
  void SetPixelTypeToAutomatic() { this->SetPixelType(Automatic); }
  void SetPixelTypeToUnsignedChar() { this->SetPixelType(UnsignedChar); }
  void SetPixelTypeToUnsignedShort() { this->SetPixelType(UnsignedShort); }
  void SetPixelTypeToHalf() { this->SetPixelType(Half); }
  void SetPixelTypeToFloat() { this->SetPixelType(Float); }
  ///@}

  ///@{
  /**
   * The compression, by OpenImageIO's name: "none", "zip", "piz", "dwaa:45" ... for OpenEXR,
   * "none", "lzw", "zip" ... for TIFF. OpenImageIO passes over a name that the format lacks.
   * Default: null, which like the empty string leaves the choice to OpenImageIO.
   */
  vtkSetStringMacro(Compression);
  vtkGetStringMacro(Compression);
  ///@}

  ///@{
  /**
   * The quality of JPEG, WebP, HEIF and TIFF with JPEG compression. Default: 95. Range: 1, the
   * smallest file, to 100, the best picture; clamped. Other formats do not use it.
   */
  vtkSetClampMacro(Quality, int, 1, 100);
  vtkGetMacro(Quality, int);
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

protected:
  vtkOpenImageIOWriter();
  ~vtkOpenImageIOWriter() override;

  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int PixelType = Automatic;
  char* Compression = nullptr;
  int Quality = 95;
  bool Staging = true;

private:
  vtkOpenImageIOWriter(const vtkOpenImageIOWriter&) = delete;
  void operator=(const vtkOpenImageIOWriter&) = delete;
};

#endif
