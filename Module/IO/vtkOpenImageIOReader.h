// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkOpenImageIOReader
 * @brief   reads a picture from any file format that OpenImageIO knows
 *
 * PNG, TIFF, OpenEXR, Radiance HDR, JPEG and some twenty more, with any number of channels of 8, 16
 * or 32 bit integers, half, float or double. Output 0 is the picture, output 1 a mask made from its
 * alpha.
 *
 * <b>Rows.</b> A file begins with the top row, an image of VTK with the bottom one (y points up).
 * So the reader turns the rows over, and the first row of the image is the last of the file. An
 * Orientation stored in the file (as cameras do) is carried out as well; the field data then says
 * Orientation 1. The extent starts at 0, 0, also for a data window of an OpenEXR file that lies
 * elsewhere. Spacing and origin are those of SetDataSpacing and SetDataOrigin, by default 1 and 0;
 * a resolution in the file is metadata only.
 *
 * <b>Values.</b> Values come as stored: no colour space is decoded and no colour is multiplied or
 * divided by alpha, unless StraightAlpha asks for it. Those of Radiance are divided by the EXPOSURE
 * and COLORCORR of their header, as it says, and lie as it says; its XYZE is refused. The file's
 * number type is kept (half becomes float, exactly); channels of different types come as the widest
 * of them, integers among floating point numbers then scaled to 0 ... 1. Fewer bits than the type
 * holds (10 bit DPX, 1 bit TIFF) are scaled up to its full range. All channels become components of
 * the scalars, red, green, blue and alpha first; palettes become colours.
 *
 * <b>Metadata.</b> The field data of output 0 gets every attribute of the file under the name that
 * OpenImageIO gives it: strings as vtkStringArray, numbers as arrays of their type.
 * `oiio:ColorSpace`, where the file tells it, names the encoding of the values. Two arrays are
 * always there: `ChannelNames` (one string for each channel of the file) and `DataWindowOrigin` (x
 * and y, in pixels from the top left corner of the format's own frame).
 *
 * <b>Mask.</b> Output 1 has one component of unsigned char: 0 where alpha is 0 or not a number, 255
 * elsewhere and wherever the file has no alpha. It fits input 1 of vtkImageReliefShading.
 *
 * <b>Errors.</b> A file that cannot be read gives one message, with its name and OpenImageIO's own
 * text, an error code and empty outputs, until the reader is modified; no second message comes from
 * the pipeline. NoFileNameError: no name. FileNotFoundError. CannotOpenFileError: a directory, or
 * no permission. UnrecognizedFileTypeError: no format accepts the file's header. FileFormatError: a
 * picture of a kind that is not read (a volume, deep samples, a part that is not there, one larger
 * than MemoryLimit), or a file that changed since its header was read. PrematureEndOfFileError: an
 * empty file, or pixels that end early or are damaged. UnknownError: not enough memory, or an
 * exception from another library. AbortExecute gives empty outputs, the code UserError and no
 * message. Not every filter of VTK takes an empty image well: look at GetErrorCode before running
 * one on the output.
 *
 * <b>Files of strangers.</b> Damaged files have been tried in PNG, TIFF, OpenEXR, JPEG, JPEG 2000,
 * Radiance HDR, PNM, BMP and GIF. OpenImageIO's decoders of other formats may not survive them:
 * those of IFF and WebP in version 2.4 do not.
 *
 * Only FileName is used; the superclass's series of files and memory buffer are not. Parts of the
 * extent can be asked for: only the rows that are needed are read. The reader is registered with
 * vtkImageReader2Factory when the library is loaded, behind VTK's own readers, which keep their
 * formats.
 *
 * @sa vtkOpenImageIOWriter vtkImageReader2Factory
 */
#ifndef vtkOpenImageIOReader_h
#define vtkOpenImageIOReader_h

#include "vtkIOReliefShadingModule.h" // For export macro
#include "vtkImageReader2.h"

#include <string> // For std::string
#include <vector> // For std::vector

class VTKIORELIEFSHADING_EXPORT vtkOpenImageIOReader : public vtkImageReader2
{
public:
  static vtkOpenImageIOReader* New();
  vtkTypeMacro(vtkOpenImageIOReader, vtkImageReader2);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Which of the pictures of one file is read (the parts of an OpenEXR file, the pages of a TIFF).
   * Default: 0, the first. Range: 0 and above, clamped; a number that the file lacks is an error.
   */
  vtkSetClampMacro(Subimage, int, 0, VTK_INT_MAX);
  vtkGetMacro(Subimage, int);
  ///@}

  ///@{
  /**
   * The same by the name that the file gives to it; it goes before the number. Default: null, by
   * number. A name that the file lacks is an error that lists those that it has.
   */
  vtkSetStringMacro(SubimageName);
  vtkGetStringMacro(SubimageName);
  ///@}

  ///@{
  /**
   * Reads one channel alone, by its name: "Z", "ViewLayer.Depth.Z", or the end of such a name
   * behind a point, "Depth.Z", if no other one has it. Where neither SubimageName nor Subimage is
   * set, the first of all pictures with such a channel is read. Default: null, all channels. A name
   * that the file lacks is an error that lists those that it has. Alpha still makes output 1.
   */
  vtkSetStringMacro(ChannelName);
  vtkGetStringMacro(ChannelName);
  ///@}

  ///@{
  /**
   * The channels of the file, after UpdateInformation.
   */
  int GetNumberOfFileChannels();
  std::string GetFileChannelName(int channel);
  ///@}

  ///@{
  /**
   * Whether colours that the file holds multiplied by alpha are divided by it: those of OpenEXR, of
   * TIFF unless its ExtraSamples say otherwise, IFF and RLA. What is then read is what textures of
   * vtkImageReliefShading are to be. Where alpha is 0 nothing changes. Default: off, as stored.
   */
  vtkSetMacro(StraightAlpha, vtkTypeBool);
  vtkGetMacro(StraightAlpha, vtkTypeBool);
  vtkBooleanMacro(StraightAlpha, vtkTypeBool);
  ///@}

  ///@{
  /**
   * Which resolution is read of a file that holds several. Default: 0, the full one; each further
   * level has half the width and height. Range: 0 and above, clamped; a number that the file lacks
   * is an error.
   */
  vtkSetClampMacro(MipLevel, int, 0, VTK_INT_MAX);
  vtkGetMacro(MipLevel, int);
  ///@}

  ///@{
  /**
   * When on, the alpha channel is no component of the scalars but a point array of its own,
   * "Alpha", of the file's number type. A file without alpha, or with nothing else, is read as if
   * it were off. Default: off. Output 1 does not depend on it.
   */
  vtkSetMacro(AlphaAsMask, vtkTypeBool);
  vtkGetMacro(AlphaAsMask, vtkTypeBool);
  vtkBooleanMacro(AlphaAsMask, vtkTypeBool);
  ///@}

  ///@{
  /**
   * A picture that would need more memory than this, in kibibytes, is refused before any is
   * allocated: a damaged header can promise any size. Counted are both outputs whole, whatever part
   * is asked for, and the rows and tiles that are decoded at a time. Default: the memory that the
   * machine has. 0 refuses nothing. Range: 0 to 2^50, clamped.
   */
  vtkSetClampMacro(MemoryLimit, vtkTypeInt64, 0, vtkTypeInt64(1) << 50);
  vtkGetMacro(MemoryLimit, vtkTypeInt64);
  ///@}

  /**
   * Why the last update failed, without the file's name and as a part of a sentence; empty after
   * success.
   */
  std::string GetErrorReason() { return this->ErrorReason; }

  /**
   * The mask, output 1.
   */
  vtkImageData* GetMaskOutput() { return this->GetOutput(1); }
  vtkAlgorithmOutput* GetMaskOutputPort() { return this->GetOutputPort(1); }

  /**
   * Makes the reader known to vtkImageReader2Factory, once. A shared library does so when it is
   * loaded; programs that link a static one call this first.
   */
  static void RegisterWithFactory();

  /**
   * 2 if OpenImageIO can read the file's header and it describes a flat picture, else 0. Reports
   * nothing.
   */
  int CanReadFile(VTK_FILEPATH const char* fileName) override;

  /**
   * The extensions, with their dots and lower case, of all formats that this build of OpenImageIO
   * reads.
   */
  const char* GetFileExtensions() override;
  const char* GetDescriptiveName() override { return "OpenImageIO"; }

protected:
  vtkOpenImageIOReader();
  ~vtkOpenImageIOReader() override;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int Subimage = 0;
  int MipLevel = 0;
  vtkTypeBool AlphaAsMask = 0;
  vtkTypeInt64 MemoryLimit;
  char* SubimageName = nullptr;
  char* ChannelName = nullptr;
  vtkTypeBool StraightAlpha = 0;

private:
  vtkOpenImageIOReader(const vtkOpenImageIOReader&) = delete;
  void operator=(const vtkOpenImageIOReader&) = delete;

  /// Why the file cannot be read, in one error.
  void Report();

  std::string ErrorReason;
  std::vector<std::string> FileChannels;
  // False once the file as it is named now has been reported as unreadable.
  bool Readable = false;
};

#endif
