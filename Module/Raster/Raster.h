// SPDX-License-Identifier: BSD-3-Clause
#ifndef Raster_h
#define Raster_h

/// @file
/// What is known of a raster, and where it lies on the map. Not installed.

#include "vtkIOReliefRasterModule.h" // For export macro
#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace relief::raster
{
/// Where a raster lies on the map, as its file says it.
struct GeoReference
{
  bool Present = false;
  /// GDAL's six numbers: x = t[0] + column * t[1] + row * t[2], y = t[3] + column * t[4] +
  /// row * t[5], at corners of samples, the rows as they are in the file.
  std::array<double, 6> Transform{ 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 };
  /// The coordinate reference system as well-known text; empty if the file has none.
  std::string Crs;
  /// The file's first row is the lower one, seen with its columns running to the right: the
  /// southern one of a raster that is not turned.
  bool SouthUp = false;
  /// The file says that its heights are those of points ("Point") or means of areas.
  std::string AreaOrPoint;
  /// What else a GeoTIFF's header is to say, by GDAL's names of metadata.
  std::map<std::string, std::string> Metadata;
};

/// What may be wrong with heights that are read all the same, and the choice that mends it, which
/// programs and classes have their own names for.
struct Warning
{
  enum Choice
  {
    None,
    NoData,
    Spacing,
    HeightScale
  };
  std::string Text;
  Choice Remedy = None;
};

/// What a file says about its heights, and all that is needed to shade them in true proportions.
struct RasterHeader
{
  int Columns = 0;
  int Rows = 0;
  /// Of VTK, as the heights are stored.
  int ScalarType = 0;
  /// The file's bands that could be heights, the first one first, by their names: empty where the
  /// file has no name for one.
  std::vector<std::string> Bands{ "" };
  /// Whether the file's alpha or mask says where there is no data.
  bool Masked = false;
  /// The height that stands for no data, in the file's values.
  std::optional<double> NoData;
  /// Height = Scale * value in the file + Offset.
  double Scale = 1.0;
  double Offset = 0.0;
  GeoReference Reference;
  /// From one sample to the next along x and y: metres for a georeferenced raster, else 1.
  std::array<double, 2> Spacing{ 1.0, 1.0 };
  /// Heights and spacing have one unit, whatever it is: of a mesh, for example.
  bool OneUnit = false;
  /// Metres per unit of the heights; 1 where the file does not say.
  double HeightUnit = 1.0;
  /// Map coordinates of the centre of the first sample, and from one sample to the next along a row
  /// and along a column.
  std::array<double, 2> MapOrigin{ 0.0, 0.0 };
  std::array<double, 2> MapStep{ 1.0, 1.0 };
  /// The metres that a unit of the map's x and of its y has on the ground.
  std::array<double, 2> MetersPerUnit{ 1.0, 1.0 };
  /// Where rows run, in metres to the east and to the north; of length 1.
  std::array<double, 2> Direction{ 1.0, 0.0 };
  /// The map's coordinates are longitude and latitude.
  bool Geographic = false;
  /// The format, by the short name that its library gives to it.
  std::string Driver;
  std::vector<Warning> Warnings;

  bool IsTurned() const { return this->Direction[0] != 1.0; }
};

/// A raster that was read. In memory the first row is the southern (lower) one, as VTK has it.
struct Raster : RasterHeader
{
  vtkSmartPointer<vtkImageData> Heights;
  /// 0 where the file's alpha or mask says that there is no data; null if it has neither.
  vtkSmartPointer<vtkImageData> Mask;
  ///@{
  /// Whether any height is NaN, and the least and the greatest of the others (infinity and less of
  /// it without any), where somebody has looked.
  std::optional<bool> HasNaN;
  std::optional<std::array<double, 2>> Ends;
  ///@}
};

/// The lengths, in metres, of one radian of longitude and of latitude at a latitude (in radians) on
/// an ellipsoid of equatorial radius `a` (in metres) and inverse flattening `f1` (0 for a sphere).
std::array<double, 2> MetersPerRadian(double latitude, double a, double f1);

/// Fills in MapOrigin, MapStep, Spacing and Direction from the reference's transform and
/// MetersPerUnit.
void PlaceOnMap(RasterHeader& raster);

/// Throws a Failure unless rows and columns stand at right angles on the ground.
void CheckAngles(const RasterHeader& raster);

/// Map coordinates of a point that is given in samples of the file from its first corner.
std::array<double, 2> MapPoint(const GeoReference& reference, double column, double row);

/// Map coordinates of the outer corners of a raster.
std::array<std::array<double, 2>, 4> Corners(const RasterHeader& raster);

/// Turns a raster whose steps on the map are angles into metres: `radians` is the size of the
/// angular unit. Warns where parallels differ much in length. Throws a Failure.
void SpaceByDegrees(RasterHeader& raster, double radians, double a, double f1);

/// Warns if steps of the map are of so different lengths within the raster, as shares of their
/// length at its centre, that one spacing for all is far from the truth.
void WarnOfScales(RasterHeader& raster, double least, double greatest);

/// Scales of a map nearer to 1 than this, and shears nearer to a right angle, are left alone: the
/// map's metres are taken as they are, 30 for 30, and a slope is off by less than a fifth of a
/// degree.
constexpr double LeastScale = 0.995;
/// From which proportion of scales within a raster there is a warning.
constexpr double MostVariation = 1.25;

/// The equatorial radius and inverse flattening of WGS 84.
constexpr double Wgs84Radius = 6378137.0;
constexpr double Wgs84InverseFlattening = 298.257223563;

/// Whether the coordinates could be degrees although nothing in the file says so.
VTKIORELIEFRASTER_EXPORT bool LooksLikeDegrees(const RasterHeader& raster);

/// Whether heights and spacing are taken for lengths of one unit: those of a georeferenced raster,
/// and those that are known to be.
/// The values of a picture, as of a PNG or a JPEG file, are none, even if a file beside it tells
/// its place.
VTKIORELIEFRASTER_EXPORT bool HasLengths(const RasterHeader& raster);

/// In floating point heights turns NoData into NaN and forgets it. The test allows for the rounding
/// of a value that was printed and read again: files say -3.402823e+38 and hold -3.4028235e+38.
/// What lies at the end of single precision is no height in any case: files mark with the lowest
/// float or double what they do not declare, or declare as -3.4e+38.
VTKIORELIEFRASTER_EXPORT void MarkNoData(Raster& raster);

/// Whether any sample has no data: for its height, NaN, infinite or NoData, or by the mask.
VTKIORELIEFRASTER_EXPORT bool LacksData(const Raster& raster);

/// Whether ApplyScale would make other heights, 4 bytes each beside those that there are.
VTKIORELIEFRASTER_EXPORT bool IsScaled(const RasterHeader& raster);

/// Heights that are stored as scaled integers become what they stand for: float, in which samples
/// without data are NaN.
VTKIORELIEFRASTER_EXPORT void ApplyScale(Raster& raster);

/// A mask of alpha: 0 where it is 0 or not a number, 255 elsewhere.
vtkSmartPointer<vtkImageData> MakeMask(vtkImageData* alpha);

/// A mask of all that has no height: what the file masks out, NaN, and NoData.
vtkSmartPointer<vtkImageData> MaskOfHeights(const Raster& raster);

/// Turns heights that the mask hides into NaN, in an array of that type.
void MarkMasked(Raster& raster, vtkImageData* mask, int scalarType);

/// Samples that lie so many metres apart, whatever the file says; heights are in metres, too.
/// Throws a Failure where that would shear a turned raster.
VTKIORELIEFRASTER_EXPORT void SetSpacing(
  RasterHeader& raster, const std::array<double, 2>& spacing);

/// Gives the heights and their mask the frame in which they are shaded: the first sample at the
/// origin, x to the east and y to the north, the raster's spacing between samples. Without a
/// georeference that is the map's frame as well.
VTKIORELIEFRASTER_EXPORT void PlaceHeights(Raster& raster);

/// The direction matrix of an image whose rows run that way, 9 numbers.
std::array<double, 9> DirectionMatrix(const std::array<double, 2>& direction);
}

#endif
