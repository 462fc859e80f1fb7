// SPDX-License-Identifier: BSD-3-Clause
#ifndef Raster_h
#define Raster_h

#include "vtkImageData.h"
#include "vtkSmartPointer.h"

#include <array>
#include <optional>
#include <string>

namespace reliefshade
{

/// Where a raster lies on the map, as its file says it.
struct GeoReference
{
  bool Present = false;
  /// GDAL's six numbers: x = t[0] + column * t[1], y = t[3] + row * t[5], at corners of samples,
  /// the rows as they are in the file. Rasters with t[2] or t[4], turned ones, are not read.
  std::array<double, 6> Transform{ 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 };
  /// The coordinate reference system as well-known text; empty if the file has none.
  std::string Crs;
  /// The file's first row is the southern one.
  bool SouthUp = false;
  /// The file says that its heights are those of points ("Point") or means of areas.
  std::string AreaOrPoint;
};

/// Heights, and all that is needed to shade them in true proportions. In memory the first row is
/// the southern (lower) one, as VTK has it.
struct Raster
{
  vtkSmartPointer<vtkImageData> Heights;
  /// 0 where the file's alpha or mask says that there is no data; null if it has neither.
  vtkSmartPointer<vtkImageData> Mask;
  /// The height that stands for no data, in the file's values.
  std::optional<double> NoData;
  /// Height = Scale * value in the file + Offset.
  double Scale = 1.0;
  double Offset = 0.0;
  GeoReference Reference;
  /// From one sample to the next along x and y: metres for a georeferenced raster, else 1.
  std::array<double, 2> Spacing{ 1.0, 1.0 };
  /// Metres per unit of the heights; 1 where the file does not say.
  double HeightUnit = 1.0;
  /// Map coordinates of the centre of the first sample, and from one sample to the next.
  std::array<double, 2> MapOrigin{ 0.0, 0.0 };
  std::array<double, 2> MapStep{ 1.0, 1.0 };
  /// The map's coordinates are longitude and latitude.
  bool Geographic = false;
};

/// The lengths, in metres, of one radian of longitude and of latitude at a latitude (in radians) on
/// an ellipsoid of equatorial radius `a` (in metres) and inverse flattening `f1` (0 for a sphere).
std::array<double, 2> metresPerRadian(double latitude, double a, double f1);

/// Where the samples of a raster lie on the map: the centre of the first one (the southern row's),
/// and the way from one to the next.
struct MapGrid
{
  std::array<double, 2> Origin;
  std::array<double, 2> Step;
};
MapGrid mapGrid(const GeoReference& reference, int rows);

/// Fills in MapOrigin and MapStep from the reference's transform and the extent of the heights.
void placeOnMap(Raster& raster);

/// Turns a raster whose steps on the map are angles into metres: `radians` is the size of the
/// angular unit.
void spaceByDegrees(Raster& raster, double radians, double a, double f1);

/// The equatorial radius and inverse flattening of WGS 84.
constexpr double Wgs84Radius = 6378137.0;
constexpr double Wgs84InverseFlattening = 298.257223563;

/// In floating point heights turns NoData into NaN and forgets it. The test allows for the rounding
/// of a value that was printed and read again: files say -3.4e+38 and hold -3.4028235e+38.
void markNoData(Raster& raster);

/// Heights that are stored as scaled integers become what they stand for.
void applyScale(Raster& raster);

}

#endif
