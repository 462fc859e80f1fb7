// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkReliefRasterWriter
 * @brief   writes a shaded image back to its place on the map
 *
 * The input is one slice in x and y, such as vtkImageReliefShading gives. A name that ends in .tif
 * or .tiff makes a GeoTIFF that keeps the place that vtkReliefRasterReader has read; .png, .jpg,
 * .jpeg, .bmp and .pnm make pictures without a place, by VTK's own writers. For other formats take
 * vtkOpenImageIOWriter.
 *
 * <b>Place.</b> It comes from the input's field data, which filters pass on, or from those of input
 * 1 if that is connected: SetReferenceConnection(reader->GetOutputPort()). Images of a part of the
 * raster, or in another resolution, come where they belong: origin and spacing count in the frame
 * that vtkReliefRasterReader gives. Where there are no such field data, TIFF is written without a
 * place. The first row of the file is the northern one, unless it was not in the raster either;
 * turned rasters stay so.
 *
 * <b>Values.</b> GeoTIFF takes integers of 8 to 32 bit, float and double, as they are. One
 * component is grey, two are grey and alpha, three of 8 bit red, green and blue, four these and
 * alpha; Bands leaves out what says nothing. In floating point numbers without alpha NaN is
 * declared to be no data. BigTIFF is written where 4 GB may not do.
 *
 * <b>Without GDAL.</b> TIFF is written by VTK's own writer, and has no place on the map: a warning
 * says so where one is lost.
 *
 * <b>Whole files.</b> As with vtkOpenImageIOWriter: the file is written beside its place and
 * renamed when it is whole. After an error or AbortExecute the temporary file is gone and a file
 * that was there before is untouched.
 *
 * <b>Errors.</b> Each gives one message with the file's name and a code. NoFileNameError.
 * UnrecognizedFileTypeError: no such extension. FileFormatError: the format does not hold the
 * input or GDAL refuses a creation option, the image lies beyond its raster or is turned against
 * it, or the field data are no place on a map. CannotOpenFileError: the place cannot be written.
 * OutOfDiskSpaceError: writing failed on the way. UnknownError: there is nothing to write.
 * AbortExecute gives the code UserError and no message.
 *
 * Of the superclass's settings only FileName is used.
 *
 * @sa vtkReliefRasterReader vtkImageReliefShading vtkOpenImageIOWriter
 */
#ifndef vtkReliefRasterWriter_h
#define vtkReliefRasterWriter_h

#include "vtkIOReliefRasterModule.h" // For export macro
#include "vtkImageWriter.h"

#include <memory> // For std::unique_ptr

class VTKIORELIEFRASTER_EXPORT vtkReliefRasterWriter : public vtkImageWriter
{
public:
  static vtkReliefRasterWriter* New();
  vtkTypeMacro(vtkReliefRasterWriter, vtkImageWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Which point array is written, by its name: "Illumination" and the like for a layer. Default:
   * null, the scalars.
   */
  vtkSetStringMacro(ArrayName);
  vtkGetStringMacro(ArrayName);
  ///@}

  ///@{
  /**
   * An image whose field data tell the place, in place of the input's: input 1. Optional.
   */
  void SetReferenceConnection(vtkAlgorithmOutput* port) { this->SetInputConnection(1, port); }
  void SetReferenceData(vtkDataObject* image) { this->SetInputDataObject(1, image); }
  ///@}

  enum BandChoices
  {
    GIVEN = 0,
    AUTO = 1,
    GREY = 2,
    RGB = 3,
    RGBA = 4
  };

  ///@{
  /**
   * Which components the file gets. GIVEN: those that the array has. AUTO: grey if red, green and
   * blue are one everywhere, else these, and alpha if any of it is below 1 (or the greatest
   * integer). GREY and RGB: without alpha; GREY is an error where colours are none. RGBA: all four,
   * whatever there is. Values stay as they are. Default: GIVEN. Range: 0 to 4, clamped.
   */
  vtkSetClampMacro(Bands, int, GIVEN, RGBA);
  vtkGetMacro(Bands, int);
  void SetBandsToGiven() { this->SetBands(GIVEN); }
  void SetBandsToAuto() { this->SetBands(AUTO); }
  void SetBandsToGrey() { this->SetBands(GREY); }
  void SetBandsToRGB() { this->SetBands(RGB); }
  void SetBandsToRGBA() { this->SetBands(RGBA); }
  ///@}

  enum Compressions
  {
    USUAL_COMPRESSION = 0,
    NO_COMPRESSION = 1,
    DEFLATE = 2,
    ZSTD = 3,
    LZW = 4
  };

  ///@{
  /**
   * How GeoTIFF is compressed, without loss; by all threads. ZSTD is fast and small, but not read
   * everywhere. Without GDAL it does not count. Default: USUAL_COMPRESSION, which is none or, for
   * CloudOptimized files, GDAL's choice. Range: 0 to 4, clamped.
   */
  vtkSetClampMacro(Compression, int, USUAL_COMPRESSION, LZW);
  vtkGetMacro(Compression, int);
  void SetCompressionToNone() { this->SetCompression(NO_COMPRESSION); }
  void SetCompressionToDeflate() { this->SetCompression(DEFLATE); }
  void SetCompressionToZSTD() { this->SetCompression(ZSTD); }
  void SetCompressionToLZW() { this->SetCompression(LZW); }
  ///@}

  ///@{
  /**
   * Whether GeoTIFF is cloud-optimized: with tiles and overviews, in an order for reading parts
   * from afar. It takes as much room again on the disk while it is written. Default: off.
   */
  vtkSetMacro(CloudOptimized, bool);
  vtkGetMacro(CloudOptimized, bool);
  vtkBooleanMacro(CloudOptimized, bool);
  ///@}

  ///@{
  /**
   * Whether GeoTIFF has overviews: smaller copies for maps that show it from afar, each half as
   * large as the one before, down to 512 samples along the longer side. CloudOptimized files have
   * them anyway. Default: off.
   */
  vtkSetMacro(Overviews, bool);
  vtkGetMacro(Overviews, bool);
  vtkBooleanMacro(Overviews, bool);
  ///@}

  ///@{
  /**
   * Creation options of GDAL's driver for GeoTIFF (COG if CloudOptimized), each as "NAME=VALUE":
   * "TILED=YES". They go before what the settings above choose. One that GDAL does not know is an
   * error, FileFormatError. Null is ignored. Default: none.
   */
  void AddCreationOption(const char* option);
  void ClearCreationOptions();
  int GetNumberOfCreationOptions();
  ///@}

  /**
   * An option by its number, from 0; null where there is none.
   */
  const char* GetCreationOption(int index);

  /**
   * Writes the file. GetErrorCode tells whether it could: vtkErrorCode::NoError if so.
   */
  void Write() override;

protected:
  vtkReliefRasterWriter();
  ~vtkReliefRasterWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  char* ArrayName = nullptr;
  int Bands = GIVEN;
  int Compression = USUAL_COMPRESSION;
  bool CloudOptimized = false;
  bool Overviews = false;

private:
  vtkReliefRasterWriter(const vtkReliefRasterWriter&) = delete;
  void operator=(const vtkReliefRasterWriter&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Internal;
};

#endif
