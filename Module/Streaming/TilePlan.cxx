// SPDX-License-Identifier: BSD-3-Clause
#include "TilePlan.h"

#include "FileGuard.h"
#include "Gdal.h"

#include "vtkErrorCode.h"
#include "vtkMath.h"

#include <ogr_spatialref.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace relief::streaming
{
namespace
{
/// Points along an edge and across the raster where its place is looked at.
constexpr int EdgePoints = 512;
constexpr int InnerPoints = 32;

struct Destroy
{
  void operator()(OGRCoordinateTransformation* transformation) const
  {
    OGRCoordinateTransformation::DestroyCT(transformation);
  }
};

//------------------------------------------------------------------------------
io::Failure Refusal(const std::string& reason)
{
  return { vtkErrorCode::FileFormatError, reason };
}

//------------------------------------------------------------------------------
/// From samples of the raster, counted from its first corner, to longitude and latitude.
class ToDegrees
{
public:
  explicit ToDegrees(const raster::GeoReference& reference)
    : Transform(reference.Transform)
  {
    OGRSpatialReference map;
    OGRSpatialReference degrees;
    if (!reference.Present || reference.Crs.empty())
    {
      throw Refusal("names no coordinate reference system, which tiles of web maps need; "
                    "gdal_edit.py -a_srs tells it to the file");
    }
    map.importFromWkt(reference.Crs.c_str());
    degrees.SetWellKnownGeogCS("WGS84");
    map.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    degrees.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    this->Crs.reset(OGRCreateCoordinateTransformation(&map, &degrees));
    if (!this->Crs)
    {
      throw Refusal("its coordinate reference system has no place on the Earth: " +
        raster::GdalErrors::Take("GDAL gives no reason"));
    }
  }

  /// Returns whether the point has a place.
  bool operator()(double column, double row, double& longitude, double& latitude) const
  {
    const std::array<double, 6>& t = this->Transform;
    longitude = t[0] + column * t[1] + row * t[2];
    latitude = t[3] + column * t[4] + row * t[5];
    int success = FALSE;
    this->Crs->Transform(1, &longitude, &latitude, nullptr, &success);
    return success && std::isfinite(longitude) && std::isfinite(latitude) &&
      std::abs(latitude) <= 90.0 + 1e-6;
  }

private:
  std::array<double, 6> Transform;
  std::unique_ptr<OGRCoordinateTransformation, Destroy> Crs;
};

//------------------------------------------------------------------------------
/// The northing of a latitude, which is held within the map.
double Northing(double latitude)
{
  const double phi =
    vtkMath::RadiansFromDegrees(std::clamp(latitude, -MercatorLatitude, MercatorLatitude));
  return MercatorHalf / vtkMath::Pi() * std::asinh(std::tan(phi));
}

/// The longitude nearest to another one.
double Near(double longitude, double other)
{
  return other + std::remainder(longitude - other, 360.0);
}

//------------------------------------------------------------------------------
/// What a sample has of the map's metres there, as a mean of its two sides; 0 where it has no
/// place.
double ResolutionAt(const ToDegrees& toDegrees, double column, double row)
{
  double at[3][2];
  const double steps[3][2] = { { 0.0, 0.0 }, { 1.0, 0.0 }, { 0.0, 1.0 } };
  for (int k = 0; k < 3; ++k)
  {
    double longitude;
    double latitude;
    if (!toDegrees(column + steps[k][0], row + steps[k][1], longitude, latitude) ||
      std::abs(latitude) > MercatorLatitude)
    {
      return 0.0;
    }
    at[k][0] =
      MercatorHalf / 180.0 * (k > 0 ? Near(longitude, at[0][0] / MercatorHalf * 180.0) : longitude);
    at[k][1] = Northing(latitude);
  }
  return std::sqrt(std::abs(
    (at[1][0] - at[0][0]) * (at[2][1] - at[0][1]) - (at[2][0] - at[0][0]) * (at[1][1] - at[0][1])));
}

//------------------------------------------------------------------------------
double MedianResolution(const ToDegrees& toDegrees, const int size[2])
{
  std::vector<double> resolutions;
  for (int j = 0; j < InnerPoints; ++j)
  {
    for (int i = 0; i < InnerPoints; ++i)
    {
      const double resolution = ResolutionAt(toDegrees, (i + 0.5) / InnerPoints * (size[0] - 1),
        (j + 0.5) / InnerPoints * (size[1] - 1));
      if (resolution > 0.0)
      {
        resolutions.push_back(resolution);
      }
    }
  }
  if (resolutions.empty())
  {
    throw Refusal("lies wholly beyond 85.05 degrees of latitude, or off the Earth, where tiles of "
                  "web maps end");
  }
  const auto middle = resolutions.begin() + static_cast<std::ptrdiff_t>(resolutions.size() / 2);
  std::nth_element(resolutions.begin(), middle, resolutions.end());
  return *middle;
}

//------------------------------------------------------------------------------
/// West, south, east and north; west to east may go beyond 180 degrees on either side.
std::array<double, 4> FindBounds(const ToDegrees& toDegrees, const int size[2])
{
  constexpr double far = std::numeric_limits<double>::infinity();
  std::array<double, 4> bounds{ far, far, -far, -far };
  double center = 0.0;
  double ignored;
  if (!toDegrees(0.5 * size[0], 0.5 * size[1], center, ignored))
  {
    center = 0.0;
  }
  const auto look = [&](double column, double row)
  {
    double longitude;
    double latitude;
    if (toDegrees(column * size[0], row * size[1], longitude, latitude))
    {
      longitude = Near(longitude, center);
      bounds = { std::min(bounds[0], longitude), std::min(bounds[1], latitude),
        std::max(bounds[2], longitude), std::max(bounds[3], latitude) };
    }
  };
  for (int k = 0; k <= EdgePoints; ++k)
  {
    const double share = static_cast<double>(k) / EdgePoints;
    look(share, 0.0);
    look(share, 1.0);
    look(0.0, share);
    look(1.0, share);
  }
  // A pole within, or edges without a place.
  for (int j = 1; j < InnerPoints; ++j)
  {
    for (int i = 1; i < InnerPoints; ++i)
    {
      look(static_cast<double>(i) / InnerPoints, static_cast<double>(j) / InnerPoints);
    }
  }
  bounds[1] = std::clamp(bounds[1], -MercatorLatitude, MercatorLatitude);
  bounds[3] = std::clamp(bounds[3], -MercatorLatitude, MercatorLatitude);
  return bounds;
}

//------------------------------------------------------------------------------
/// The tiles between two places of the map, from 0 to 1. What reaches into a tile by less than a
/// thousandth of a sample is rounding.
void TilesBetween(double begin, double end, int zoom, int size, std::int64_t tiles[2])
{
  const double count = std::ldexp(1.0, zoom);
  const double nothing = 0.001 / size;
  tiles[0] = static_cast<std::int64_t>(std::floor(begin * count + nothing));
  tiles[1] = static_cast<std::int64_t>(std::ceil(end * count - nothing)) - 1;
  tiles[1] = std::max(tiles[0], tiles[1]);
}

//------------------------------------------------------------------------------
std::vector<TileSpan> SpansOf(const std::array<double, 4>& bounds, int zoom, int size)
{
  const std::int64_t last = (std::int64_t{ 1 } << zoom) - 1;
  TileSpan span;
  TilesBetween(0.5 - 0.5 * Northing(bounds[3]) / MercatorHalf,
    0.5 - 0.5 * Northing(bounds[1]) / MercatorHalf, zoom, size, span.Rows);
  span.Rows[0] = std::clamp<std::int64_t>(span.Rows[0], 0, last);
  span.Rows[1] = std::clamp<std::int64_t>(span.Rows[1], 0, last);
  const double west = (bounds[0] + 180.0) / 360.0;
  TilesBetween(west, west + (bounds[2] - bounds[0]) / 360.0, zoom, size, span.Columns);
  std::vector<TileSpan> spans;
  if (span.Columns[1] - span.Columns[0] >= last)
  {
    span.Columns[0] = 0;
    span.Columns[1] = last;
    return { span };
  }
  // Round the Earth: what lies beyond 180 degrees comes in from the other side.
  const std::int64_t turns = span.Columns[0] > last ? -1 : span.Columns[1] < 0 ? 1 : 0;
  span.Columns[0] += turns * (last + 1);
  span.Columns[1] += turns * (last + 1);
  if (span.Columns[0] >= 0 && span.Columns[1] <= last)
  {
    return { span };
  }
  TileSpan other = span;
  if (span.Columns[0] < 0)
  {
    other.Columns[0] = span.Columns[0] + last + 1;
    other.Columns[1] = last;
    span.Columns[0] = 0;
  }
  else
  {
    other.Columns[0] = 0;
    other.Columns[1] = span.Columns[1] - last - 1;
    span.Columns[1] = last;
  }
  return { span, other };
}

//------------------------------------------------------------------------------
double CountOf(const std::vector<TileSpan>& spans)
{
  double count = 0.0;
  for (const TileSpan& span : spans)
  {
    count += static_cast<double>(span.Columns[1] - span.Columns[0] + 1) *
      static_cast<double>(span.Rows[1] - span.Rows[0] + 1);
  }
  return count;
}
}

//------------------------------------------------------------------------------
double ResolutionOf(int zoom, int size)
{
  return 2.0 * MercatorHalf / size / std::ldexp(1.0, zoom);
}

//------------------------------------------------------------------------------
TileSpan TilePlan::Around() const
{
  TileSpan all = this->Finest.front();
  if (this->Finest.size() > 1)
  {
    all.Columns[0] = 0;
    all.Columns[1] = (std::int64_t{ 1 } << this->Zoom[1]) - 1;
  }
  return all;
}

//------------------------------------------------------------------------------
std::vector<TileSpan> TilePlan::At(int zoom) const
{
  const int levels = this->Zoom[1] - zoom;
  std::vector<TileSpan> spans = this->Finest;
  for (TileSpan& span : spans)
  {
    for (int k = 0; k < 2; ++k)
    {
      span.Columns[k] >>= levels;
      span.Rows[k] >>= levels;
    }
  }
  if (spans.size() == 2 && spans[0].Columns[0] <= spans[1].Columns[1] &&
    spans[1].Columns[0] <= spans[0].Columns[1])
  {
    spans[0].Columns[0] = std::min(spans[0].Columns[0], spans[1].Columns[0]);
    spans[0].Columns[1] = std::max(spans[0].Columns[1], spans[1].Columns[1]);
    spans.pop_back();
  }
  return spans;
}

//------------------------------------------------------------------------------
TilePlan PlanTiles(const raster::GeoReference& reference, const int size[2], int tileSize,
  const std::optional<std::array<int, 2>>& zoom)
{
  const raster::GdalErrors errors;
  const ToDegrees toDegrees(reference);
  TilePlan plan;
  plan.Size = tileSize;
  plan.Resolution = MedianResolution(toDegrees, size);
  plan.Bounds = FindBounds(toDegrees, size);
  if (zoom)
  {
    plan.Zoom = *zoom;
  }
  else
  {
    const double own = std::log2(ResolutionOf(0, tileSize) / plan.Resolution);
    plan.Zoom[1] = static_cast<int>(std::clamp(std::round(own), 0.0, 1.0 * GreatestZoom));
    plan.Zoom[0] = plan.Zoom[1];
    while (plan.Zoom[0] > 0 && CountOf(SpansOf(plan.Bounds, plan.Zoom[0], tileSize)) > 2.0)
    {
      --plan.Zoom[0];
    }
  }
  plan.Finest = SpansOf(plan.Bounds, plan.Zoom[1], tileSize);
  const TileSpan all = plan.Around();
  const std::int64_t most = std::numeric_limits<int>::max() / tileSize;
  if (all.Columns[1] - all.Columns[0] >= most || all.Rows[1] - all.Rows[0] >= most)
  {
    throw Refusal("has more samples at zoom " + std::to_string(plan.Zoom[1]) +
      " than GDAL can count; a zoom that is less is expected");
  }
  if (plan.Bounds[2] - plan.Bounds[0] >= 360.0)
  {
    plan.Bounds[0] = -180.0;
    plan.Bounds[2] = 180.0;
  }
  for (const int k : { 0, 2 })
  {
    plan.Bounds[k] = Near(plan.Bounds[k], 0.0);
  }
  if (plan.Bounds[0] == 180.0)
  {
    plan.Bounds[0] = -180.0;
  }
  if (plan.Bounds[2] == -180.0)
  {
    plan.Bounds[2] = 180.0;
  }
  return plan;
}
}
