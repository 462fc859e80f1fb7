// SPDX-License-Identifier: BSD-3-Clause
#include "MapPlace.h"

#include "FileGuard.h"
#ifdef RELIEFRASTER_USE_GDAL
#include "Gdal.h"

#include <ogr_spatialref.h>
#endif

#include "vtkErrorCode.h"
#include "vtkMath.h"

#include <cmath>
#include <memory>

namespace relief::raster
{
namespace
{
using Pair = std::array<double, 2>;

[[noreturn]] void Fail(const std::string& reason)
{
  throw io::Failure(vtkErrorCode::FileFormatError, reason);
}

MapPlace Checked(double longitude, double latitude, double convergence)
{
  if (!(std::abs(longitude) <= 360.0 && std::abs(latitude) <= 90.0 && std::isfinite(convergence)))
  {
    Fail("its centre is no place on the Earth");
  }
  MapPlace place;
  place.Longitude = longitude > 180.0 ? longitude - 360.0
    : longitude < -180.0              ? longitude + 360.0
                                      : longitude;
  place.Latitude = latitude;
  place.Convergence = convergence;
  return place;
}

#ifdef RELIEFRASTER_USE_GDAL
struct DestroyTransformation
{
  void operator()(OGRCoordinateTransformation* way) const
  {
    OGRCoordinateTransformation::DestroyCT(way);
  }
};
using Transformation = std::unique_ptr<OGRCoordinateTransformation, DestroyTransformation>;

// A reference system as maps are drawn, x to the right, and without heights.
void PrepareSystem(OGRSpatialReference& crs)
{
  crs.StripVertical();
  crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
}

MapPlace PlaceByProjection(const RasterHeader& raster, const Pair& center)
{
  const GdalErrors quiet;
  OGRSpatialReference map;
  OGRSpatialReference degrees;
  if (map.importFromWkt(raster.Reference.Crs.c_str()) != OGRERR_NONE ||
    degrees.SetWellKnownGeogCS("WGS84") != OGRERR_NONE)
  {
    Fail("its coordinate reference system is not understood");
  }
  // Spheres and ellipsoids of the Earth are within half a per cent; PROJ may take others for it.
  if (std::abs(map.GetSemiMajor() / Wgs84Radius - 1.0) > 0.005)
  {
    Fail("its map is not of the Earth, whose sun is known");
  }
  PrepareSystem(map);
  PrepareSystem(degrees);
  const Transformation toDegrees(OGRCreateCoordinateTransformation(&map, &degrees));
  const Transformation toMap(OGRCreateCoordinateTransformation(&degrees, &map));
  double longitude = center[0];
  double latitude = center[1];
  if (!toDegrees || !toMap || !toDegrees->Transform(1, &longitude, &latitude))
  {
    Fail("longitude and latitude of its centre cannot be told by its coordinate reference system");
  }
  if (map.IsGeographic())
  {
    return Checked(longitude, latitude, 0.0);
  }
  // A hundred metres along the meridian, toward the equator: it ends at the poles.
  constexpr double step = 0.001;
  const double side = latitude > 0.0 ? -1.0 : 1.0;
  double x[2] = { longitude, longitude };
  double y[2] = { latitude, latitude + side * step };
  if (!toMap->Transform(2, x, y))
  {
    Fail("the direction of north at its centre cannot be told by its coordinate reference system");
  }
  // North, in the frame that heights are shaded in.
  const double east = side * (x[1] - x[0]) * raster.MetersPerUnit[0];
  const double north = side * (y[1] - y[0]) * raster.MetersPerUnit[1];
  return Checked(longitude, latitude, vtkMath::DegreesFromRadians(-std::atan2(east, north)));
}
#endif
}

//------------------------------------------------------------------------------
MapPlace PlaceOfCenter(const RasterHeader& raster)
{
  if (!raster.Reference.Present)
  {
    Fail("it has no georeference, by which its place could be told");
  }
  const Pair center = MapPoint(raster.Reference, 0.5 * raster.Columns, 0.5 * raster.Rows);
#ifdef RELIEFRASTER_USE_GDAL
  if (!raster.Reference.Crs.empty())
  {
    return PlaceByProjection(raster, center);
  }
#endif
  if (!raster.Geographic)
  {
    Fail(raster.Reference.Crs.empty()
        ? "its georeference names no coordinate reference system, by which its place could be told"
        : "its place cannot be told without GDAL");
  }
  return Checked(center[0], center[1], 0.0);
}
}
