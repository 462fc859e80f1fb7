// SPDX-License-Identifier: BSD-3-Clause
#include "MapScale.h"

#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

namespace relief::raster
{
namespace
{
using Pair = std::array<double, 2>;

/// From a map to metres on its ellipsoid.
class Ground
{
public:
  explicit Ground(const OGRSpatialReference& crs);

  /// The metres of a unit of x and of y at a place, by places `step` units around it; empty where
  /// the map has no ground.
  std::optional<Pair> ScaleAt(const Pair& place, double step) const;

private:
  struct Destroy
  {
    void operator()(OGRSpatialReference* crs) const { crs->Release(); }
    void operator()(OGRCoordinateTransformation* way) const
    {
      OGRCoordinateTransformation::DestroyCT(way);
    }
  };
  std::unique_ptr<OGRSpatialReference, Destroy> Degrees;
  std::unique_ptr<OGRCoordinateTransformation, Destroy> ToDegrees;
};

//------------------------------------------------------------------------------
Ground::Ground(const OGRSpatialReference& crs)
  : Degrees(crs.CloneGeogCS())
{
  // A transform's x and y are those of the drawn map, whatever the order of the system's axes is.
  OGRSpatialReference map(crs);
  map.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  if (this->Degrees)
  {
    this->Degrees->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    this->ToDegrees.reset(OGRCreateCoordinateTransformation(&map, this->Degrees.get()));
  }
}

//------------------------------------------------------------------------------
std::optional<Pair> Ground::ScaleAt(const Pair& place, double step) const
{
  // East, west, north and south of it, and the place itself.
  double x[5] = { place[0] + step, place[0] - step, place[0], place[0], place[0] };
  double y[5] = { place[1], place[1], place[1] + step, place[1] - step, place[1] };
  if (!this->ToDegrees || !this->ToDegrees->Transform(5, x, y))
  {
    return std::nullopt;
  }
  const double radians = this->Degrees->GetAngularUnits();
  const Pair metres = MetersPerRadian(
    y[4] * radians, this->Degrees->GetSemiMajor(), this->Degrees->GetInvFlattening());
  Pair scale;
  for (int k = 0; k < 2; ++k)
  {
    const double circle = 2.0 * 3.14159265358979323846;
    const double longitude = std::remainder((x[2 * k] - x[2 * k + 1]) * radians, circle);
    const double latitude = (y[2 * k] - y[2 * k + 1]) * radians;
    scale[k] = std::hypot(longitude * metres[0], latitude * metres[1]) / (2.0 * step);
  }
  const bool real = std::isfinite(scale[0]) && std::isfinite(scale[1]) && scale[0] > 0.0 &&
    scale[1] > 0.0 && std::isfinite(y[4]);
  return real ? std::optional<Pair>(scale) : std::nullopt;
}
}

namespace
{
/// Whether a raster lies within a zone of UTM, or not far beside it: there the scale is at least
/// 0.9996 and less than 1.003 at all places, which is left alone. What would find that out by a
/// transformation takes longer than a small raster is shaded.
bool IsEvenByUtm(const RasterHeader& raster, const OGRSpatialReference& crs)
{
  const auto corners = Corners(raster);
  return crs.GetUTMZone() != 0 && crs.GetLinearUnits() == 1.0 &&
    std::all_of(corners.begin(), corners.end(),
      [](const Pair& corner) {
        return corner[0] >= 0.0 && corner[0] <= 1.0e6 && corner[1] >= -9.3e6 && corner[1] <= 1.93e7;
      });
}
}

//------------------------------------------------------------------------------
void SpaceByProjection(RasterHeader& raster, const OGRSpatialReference& crs)
{
  const double unit = crs.GetLinearUnits();
  raster.MetersPerUnit = { unit, unit };
  PlaceOnMap(raster);
  if (!crs.IsProjected() || IsEvenByUtm(raster, crs))
  {
    return; // else a plan of its own, whose unit is what there is
  }
  const Ground ground(crs);
  const GeoReference& reference = raster.Reference;
  // Far enough that differences of degrees keep their digits, and near enough for a slope.
  const double step = 10.0 / unit;
  const std::optional<Pair> center =
    ground.ScaleAt(MapPoint(reference, 0.5 * raster.Columns, 0.5 * raster.Rows), step);
  if (!center)
  {
    raster.Warnings.push_back({ "the scale of its map cannot be told at its centre; the map's "
                                "metres are taken as they are",
      Warning::Spacing });
    return;
  }
  double least = 1.0;
  double greatest = 1.0;
  bool even = true;
  for (int k = 0; k < 2; ++k)
  {
    even = even && std::abs((*center)[k] / unit - 1.0) <= 1.0 - LeastScale;
  }
  if (!even)
  {
    raster.MetersPerUnit = *center;
    PlaceOnMap(raster);
  }
  for (const Pair& corner : Corners(raster))
  {
    const std::optional<Pair> there = ground.ScaleAt(corner, step);
    for (int k = 0; there && k < 2; ++k)
    {
      const double share = (*there)[k] / (*center)[k];
      least = std::min(least, share);
      greatest = std::max(greatest, share);
    }
  }
  WarnOfScales(raster, least, greatest);
}
}
