// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkReliefRasterReader
 * @brief   reads heights from a georeferenced raster, in metres, ready to be shaded
 *
 * GeoTIFF and every other raster that GDAL reads; ESRI ASCII grids; and pictures for which
 * vtkImageReader2Factory has a reader, such as PNG (with VTK::IOReliefShading loaded, any that
 * OpenImageIO reads). Without GDAL: ESRI ASCII grids and such pictures. Output 0 is the heights,
 * output 1 a mask.
 *
 * <b>Place.</b> One band becomes an image of one slice whose first row is the southern one. The
 * first sample lies at the origin, which is DataOrigin. The spacing is in metres on the ground: the
 * map's unit is converted and its projection's scale at the raster's centre counts, along x and
 * along y, unless both are within half a per cent of 1, so that UTM keeps its round numbers;
 * degrees become the metres that they are along the parallel and the meridian there, on the
 * raster's ellipsoid. A file whose axes are in degrees_east and degrees_north needs no reference
 * system. A raster that is turned on the map has a direction matrix: +x of the world is the map's
 * east, +y its north. Ground control points count where they make such a place. A sheared raster is
 * refused. A file without a georeference gets DataSpacing, by default 1.
 *
 * <b>Pictures.</b> Without a georeference, one that is stored turned or mirrored, as its TIFF or
 * EXIF says, comes upright.
 *
 * <b>Heights.</b> They are in metres: heights in feet, centimetres or any other unit of length by
 * its usual names, or stored as scaled integers, become what
 * they stand for, as float. Else the file's number type is kept, unless it has no NaN and there are
 * samples without data to be told by it: small integers then come as float, others as double. See
 * HeightsInMeters and NoDataToNaN.
 *
 * <b>No data.</b> What the file declares to be no data, what its mask hides, where its alpha is 0,
 * and floating point numbers from 3.4e38 on, above or below 0, which are no heights, is NaN in
 * output 0 and 0 in output 1, which is 255 elsewhere. So output 0 alone will do for
 * vtkImageReliefShading; output 1 fits its input 1.
 *
 * <b>Field data.</b> Output 0 tells where it comes from; filters pass it on, and
 * vtkReliefRasterWriter takes it:
 *
 * - `geo:transform`, 6 doubles: GDAL's numbers, of the file: map x of the first corner, its steps
 *   along a row and along a column, map y of that corner, its steps along a row and along a column.
 * - `geo:size`, 2 ints: columns and rows of the file.
 * - `geo:spacing`, 2 doubles: metres from one sample to the next.
 * - `geo:origin`, 2 doubles: x and y of the first sample, which are those of DataOrigin; 0 where
 *   they lack.
 * - `geo:direction`, 2 doubles, of turned rasters only: where rows run, to the east and to the
 *   north.
 * - `geo:crs`, a string: the coordinate reference system as well-known text (WKT 2), if the file
 *   names one.
 * - `geo:areaOrPoint`, a string: `Area` or `Point`, if the file says so.
 * - `geo:heightUnit`, a double: metres per unit of the file's heights.
 * - `geo:noData`, a double: the value of the file that stands for no data, if there is one.
 * - `geo:driver`, a string: the format, by GDAL's short name.
 *
 * Those above `geo:heightUnit` are there only if the file has a georeference.
 *
 * <b>Warnings.</b> The heights are read, but may mean something else: the coordinates look like
 * degrees (see Degrees); the unit of the heights is not known; the map is so large that its scale
 * changes by more than a quarter; ground control points make no place; a value looks like no data
 * that nobody declared, or the declared one cannot be a value of the file (see NoDataValue).
 *
 * <b>Errors.</b> As with vtkOpenImageIOReader: one message that names the file, an error code and
 * empty outputs. NoFileNameError, FileNotFoundError, CannotOpenFileError (a directory that is no
 * data set, no permission), UnrecognizedFileTypeError (no format fits), FileFormatError (colours, a
 * band that is not there, a sheared raster, more than MemoryLimit), PrematureEndOfFileError
 * (heights that end early or are damaged), UnknownError. AbortExecute gives empty outputs, the code
 * UserError and no message.
 *
 * <b>Parts.</b> Of most formats no more is read than the extent that is asked for; of ESRI ASCII
 * grids, encoded heights and what GDAL does not read all of it is. See ReadAsNeeded for rasters
 * that do not fit into memory.
 *
 * Only FileName, DataSpacing and DataOrigin are used of the superclass.
 *
 * @sa vtkReliefRasterWriter vtkImageReliefShading
 */
#ifndef vtkReliefRasterReader_h
#define vtkReliefRasterReader_h

#include "vtkIOReliefRasterModule.h" // For export macro
#include "vtkImageReader2.h"

#include <memory> // For std::unique_ptr

class VTKIORELIEFRASTER_EXPORT vtkReliefRasterReader : public vtkImageReader2
{
public:
  static vtkReliefRasterReader* New();
  vtkTypeMacro(vtkReliefRasterReader, vtkImageReader2);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Which band holds the heights, from 1. Default: 0, the first, but files of several colours are
   * refused. Range: 0 and above, clamped; a number that the file lacks is an error.
   */
  vtkSetClampMacro(Band, int, 0, VTK_INT_MAX);
  vtkGetMacro(Band, int);
  ///@}

  enum Encodings
  {
    NO_ENCODING = 0,
    TERRARIUM = 1,
    TERRAIN_RGB = 2
  };

  ///@{
  /**
   * How red, green and blue of 8 bits stand for heights in metres, as the tiles of web maps have
   * them. TERRARIUM: 256 red + green + blue / 256 - 32768. TERRAIN_RGB (Mapbox's): 0.1 (65536 red +
   * 256 green + blue) - 10000. Heights are float then, Band does not count, and NoDataValue is a
   * height in metres. A file without three bands of 8 bits is an error. Default: NO_ENCODING, the
   * heights are in one band. Range: 0 to 2, clamped.
   */
  vtkSetClampMacro(Encoding, int, NO_ENCODING, TERRAIN_RGB);
  vtkGetMacro(Encoding, int);
  void SetEncodingToNone() { this->SetEncoding(NO_ENCODING); }
  void SetEncodingToTerrarium() { this->SetEncoding(TERRARIUM); }
  void SetEncodingToTerrainRGB() { this->SetEncoding(TERRAIN_RGB); }
  ///@}

  ///@{
  /**
   * The file does not name its coordinate reference system: it is longitude and latitude in degrees
   * on WGS 84. An error for files that do name one. A file whose coordinates look like degrees
   * while this is off gives a warning. Default: off.
   */
  vtkSetMacro(Degrees, bool);
  vtkGetMacro(Degrees, bool);
  vtkBooleanMacro(Degrees, bool);
  ///@}

  ///@{
  /**
   * Whether heights in a unit that the file names are converted to metres. Off, they stay in the
   * file's unit, which the field data tell as `geo:heightUnit`. Default: on.
   */
  vtkSetMacro(HeightsInMeters, bool);
  vtkGetMacro(HeightsInMeters, bool);
  vtkBooleanMacro(HeightsInMeters, bool);
  ///@}

  ///@{
  /**
   * Whether heights are read when vtkImageReliefShading needs them, so that they need not fit into
   * memory. A first pass over all of them finds their bounds, which are kept beside the file, as
   * `<file>.bounds.tif`, for the next time. Ask the filter for one extent after another, each as
   * large as there is room for (vtkImageReliefShading::EstimateMemory()). To all others it is an
   * image of float heights that is slow to look at. Samples without data are NaN; output 1 stays
   * empty. An error for formats that are read as a whole. Default: off.
   */
  vtkSetMacro(ReadAsNeeded, bool);
  vtkGetMacro(ReadAsNeeded, bool);
  vtkBooleanMacro(ReadAsNeeded, bool);
  ///@}

  ///@{
  /**
   * Whether integers become floating point numbers where samples without data are to be told. Off,
   * they keep their value and their type: then give the filter GetFileNoDataValue, or output 1.
   * Default: on.
   */
  vtkSetMacro(NoDataToNaN, bool);
  vtkGetMacro(NoDataToNaN, bool);
  vtkBooleanMacro(NoDataToNaN, bool);
  ///@}

  ///@{
  /**
   * Which value of the file stands for no data: the one that it declares or, with NoDataFromFile
   * off, NoDataValue, where NaN means none. Numbers from 3.4e38 on are none in any case. Default:
   * on; NaN.
   */
  vtkSetMacro(NoDataFromFile, bool);
  vtkGetMacro(NoDataFromFile, bool);
  vtkBooleanMacro(NoDataFromFile, bool);
  void SetNoDataValue(double value);
  vtkGetMacro(NoDataValue, double);
  ///@}

  /**
   * The value that stands for no data, after UpdateInformation: NaN if there is none.
   */
  vtkGetMacro(FileNoDataValue, double);

  /**
   * Where on the Earth the raster's centre lies, for vtkReliefScene::AddSunAt: its longitude to the
   * east and latitude to the north, on WGS 84, and the map's convergence there, clockwise from true
   * north to the map's, which is +y; all in degrees. The header is read if need be. Three NaN, with
   * an error, where the file does not tell, and of maps that are not of the Earth.
   */
  double* GetPlace() VTK_SIZEHINT(3);

  ///@{
  /**
   * A raster that would need more memory than this, in kibibytes, is refused before any is
   * allocated. Default: the memory that the machine has. 0 refuses nothing. Range: 0 to 2^50,
   * clamped.
   */
  vtkSetClampMacro(MemoryLimit, vtkTypeInt64, 0, vtkTypeInt64(1) << 50);
  vtkGetMacro(MemoryLimit, vtkTypeInt64);
  ///@}

  /**
   * The mask, output 1.
   */
  vtkImageData* GetMaskOutput() { return this->GetOutput(1); }
  vtkAlgorithmOutput* GetMaskOutputPort() { return this->GetOutputPort(1); }

  /**
   * 2 if the file's header can be read and it holds heights, else 0. Reports nothing.
   */
  int CanReadFile(VTK_FILEPATH const char* fileName) override;

  /**
   * Extensions of usual rasters; GDAL goes by a file's content.
   */
  const char* GetFileExtensions() override;
  const char* GetDescriptiveName() override { return "Georeferenced raster"; }

protected:
  vtkReliefRasterReader();
  ~vtkReliefRasterReader() override;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

  int Band = 0;
  int Encoding = NO_ENCODING;
  bool Degrees = false;
  bool HeightsInMeters = true;
  bool NoDataToNaN = true;
  bool ReadAsNeeded = false;
  bool NoDataFromFile = true;
  double NoDataValue;
  double FileNoDataValue;
  double Place[3];
  vtkTypeInt64 MemoryLimit;

private:
  vtkReliefRasterReader(const vtkReliefRasterReader&) = delete;
  void operator=(const vtkReliefRasterReader&) = delete;

  struct Internals;
  std::unique_ptr<Internals> Header;
};

#endif
