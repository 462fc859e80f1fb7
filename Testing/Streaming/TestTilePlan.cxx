// SPDX-License-Identifier: BSD-3-Clause
// Which tiles a raster lies in: by the formulas of web maps, at the map's edges and round the
// Earth.
#include "TilePlan.h"

#include "StreamingTestUtilities.h"

#include <ogr_spatialref.h>

#include <cmath>

namespace
{
int Failures = 0;

using relief::raster::GeoReference;
using relief::streaming::MercatorHalf;
using relief::streaming::PlanTiles;
using relief::streaming::ResolutionOf;
using relief::streaming::TilePlan;
using relief::streaming::TileSpan;

std::string TextOf(const char* name)
{
  OGRSpatialReference crs;
  crs.SetFromUserInput(name);
  char* text = nullptr;
  crs.exportToWkt(&text);
  std::string result = text ? text : "";
  CPLFree(text);
  return result;
}

/// A raster between two corners, the upper left one first.
GeoReference Place(const char* crs, double x0, double y0, double x1, double y1, const int size[2])
{
  GeoReference reference;
  reference.Present = true;
  reference.Crs = TextOf(crs);
  reference.Transform = { x0, (x1 - x0) / size[0], 0.0, y0, 0.0, (y1 - y0) / size[1] };
  return reference;
}

bool Is(const TileSpan& span, std::int64_t c0, std::int64_t c1, std::int64_t r0, std::int64_t r1)
{
  return span.Columns[0] == c0 && span.Columns[1] == c1 && span.Rows[0] == r0 && span.Rows[1] == r1;
}

/// The tile of a place by the usual formula.
void TileAt(double longitude, double latitude, int zoom, std::int64_t tile[2])
{
  const double pi = std::acos(-1.0);
  const double phi = latitude * pi / 180.0;
  const double n = std::pow(2.0, zoom);
  tile[0] = static_cast<std::int64_t>(std::floor((longitude + 180.0) / 360.0 * n));
  tile[1] = static_cast<std::int64_t>(
    std::floor((1.0 - std::log(std::tan(phi) + 1.0 / std::cos(phi)) / pi) / 2.0 * n));
}

void TestExactTiles()
{
  // Just a block of tiles: no rounding adds another.
  const int size[2] = { 512, 768 };
  for (const int zoom : { 1, 5, 11, 17, 22 })
  {
    const double tile = 2.0 * MercatorHalf / std::pow(2.0, zoom);
    const std::int64_t c = zoom == 1 ? 0 : (std::int64_t{ 1 } << zoom) / 3;
    const std::int64_t r = zoom == 1 ? 0 : (std::int64_t{ 1 } << zoom) / 5;
    const double x = static_cast<double>(c) * tile - MercatorHalf;
    const double y = MercatorHalf - static_cast<double>(r) * tile;
    const int rows = zoom == 1 ? 2 : 3;
    const int samples[2] = { size[0], 256 * rows };
    const TilePlan plan =
      PlanTiles(Place("EPSG:3857", x, y, x + 2 * tile, y - rows * tile, samples), samples, 256, {});
    CHECK(plan.Zoom[1] == zoom && plan.Finest.size() == 1);
    CHECK(Is(plan.Finest[0], c, c + 1, r, r + rows - 1));
    CHECK_NEAR(plan.Resolution / ResolutionOf(zoom, 256), 1.0, 1e-6);
    // Larger tiles, as many samples.
    CHECK(
      PlanTiles(Place("EPSG:3857", x, y, x + 2 * tile, y - rows * tile, samples), samples, 512, {})
        .Zoom[1] == zoom - 1);
  }
}

void TestPlaces()
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int k = 0; k < 200; ++k)
  {
    const double west = -179.0 + 340.0 * share(random);
    const double south = -80.0 + 150.0 * share(random);
    const double east = west + 0.001 + 10.0 * share(random);
    const double north = south + 0.001 + 10.0 * share(random);
    const int size[2] = { 1 + static_cast<int>(5000 * share(random)),
      1 + static_cast<int>(5000 * share(random)) };
    const TilePlan plan =
      PlanTiles(Place("EPSG:4326", west, north, east, south, size), size, 256, {});
    std::int64_t first[2];
    std::int64_t last[2];
    TileAt(west, north, plan.Zoom[1], first);
    TileAt(east, south, plan.Zoom[1], last);
    CHECK(plan.Finest.size() == 1 && Is(plan.Finest[0], first[0], last[0], first[1], last[1]));
    CHECK_NEAR(plan.Bounds[0], west, 1e-9);
    CHECK_NEAR(plan.Bounds[3], north, 1e-9);
    // The greatest zoom is the nearest one, and the least the last that needs two tiles at most.
    const double off = std::log2(plan.Resolution / ResolutionOf(plan.Zoom[1], 256));
    CHECK(std::abs(off) <= 0.5 || plan.Zoom[1] == 0 || plan.Zoom[1] == 24);
    const auto count = [&plan](int zoom)
    {
      const TileSpan span = plan.At(zoom).front();
      return (span.Columns[1] - span.Columns[0] + 1) * (span.Rows[1] - span.Rows[0] + 1);
    };
    CHECK(count(plan.Zoom[0]) <= 2 || plan.Zoom[0] == 0);
    CHECK(plan.Zoom[0] == plan.Zoom[1] || count(plan.Zoom[0] + 1) > 2);
  }
}

void TestWholeEarth()
{
  const int size[2] = { 3600, 1800 };
  for (const double west : { -180.0, 0.0, -180.05 })
  {
    const TilePlan plan =
      PlanTiles(Place("EPSG:4326", west, 90.0, west + 360.0, -90.0, size), size, 256, {});
    const std::int64_t last = (std::int64_t{ 1 } << plan.Zoom[1]) - 1;
    CHECK(plan.Zoom[0] == 0 && plan.Finest.size() == 1 && Is(plan.Finest[0], 0, last, 0, last));
    CHECK_NEAR(plan.Bounds[3], 85.0511287798, 1e-9);
    CHECK_NEAR(plan.Bounds[1], -85.0511287798, 1e-9);
  }
  // Round a pole, to which no tile comes.
  const int polar[2] = { 1000, 1000 };
  const TilePlan plan = PlanTiles(
    Place("EPSG:3995", -2000000.0, 2000000.0, 2000000.0, -2000000.0, polar), polar, 256, {});
  const std::int64_t last = (std::int64_t{ 1 } << plan.Zoom[1]) - 1;
  CHECK(plan.Finest.size() == 1 && plan.Finest[0].Columns[0] == 0 &&
    plan.Finest[0].Columns[1] == last && plan.Finest[0].Rows[0] == 0);
}

void TestRoundTheEarth()
{
  // On both sides of 180 degrees, whichever way its longitudes are counted.
  const int size[2] = { 2000, 1000 };
  for (const double west : { 170.0, -190.0 })
  {
    const TilePlan plan =
      PlanTiles(Place("EPSG:4326", west, 5.0, west + 20.0, -5.0, size), size, 256, {});
    const std::int64_t count = std::int64_t{ 1 } << plan.Zoom[1];
    std::int64_t first[2];
    std::int64_t last[2];
    TileAt(170.0, 5.0, plan.Zoom[1], first);
    TileAt(-170.0, -5.0, plan.Zoom[1], last);
    CHECK(plan.Finest.size() == 2);
    bool left = false;
    bool right = false;
    for (const TileSpan& span : plan.Finest)
    {
      left = left || Is(span, first[0], count - 1, first[1], last[1]);
      right = right || Is(span, 0, last[0], first[1], last[1]);
    }
    CHECK(left && right);
    CHECK_NEAR(plan.Bounds[0], 170.0, 1e-9);
    CHECK_NEAR(plan.Bounds[2], -170.0, 1e-9);
    CHECK(plan.At(0).size() == 1 && Is(plan.At(0)[0], 0, 0, 0, 0));
  }
  // Just at it: nothing crosses.
  for (const double west : { 170.0, -180.0 })
  {
    const TilePlan plan =
      PlanTiles(Place("EPSG:4326", west, 5.0, west + 10.0, -5.0, size), size, 256, {});
    CHECK(plan.Finest.size() == 1 && plan.Bounds[0] < plan.Bounds[2]);
  }
  const int utm[2] = { 500, 400 };
  const TilePlan plan =
    PlanTiles(Place("EPSG:32601", 100000.0, 5000000.0, 350000.0, 4800000.0, utm), utm, 256, {});
  CHECK(plan.Finest.size() == 2 && plan.Bounds[0] > 170.0 && plan.Bounds[2] < -170.0);
}

void TestRefusals()
{
  const int size[2] = { 100, 100 };
  CHECK(Contains(
    Thrown([&] { PlanTiles(GeoReference(), size, 256, {}); }), "no coordinate reference system"));
  GeoReference unnamed = Place("EPSG:4326", 0.0, 1.0, 1.0, 0.0, size);
  unnamed.Crs.clear();
  CHECK(
    Contains(Thrown([&] { PlanTiles(unnamed, size, 256, {}); }), "no coordinate reference system"));
  unnamed.Crs = "LOCAL_CS[\"a site\",UNIT[\"metre\",1]]";
  CHECK(Contains(Thrown([&] { PlanTiles(unnamed, size, 256, {}); }), "no place on the Earth"));
  CHECK(Contains(
    Thrown([&] { PlanTiles(Place("EPSG:4326", 0.0, 90.0, 10.0, 86.0, size), size, 256, {}); }),
    "85.05"));
  CHECK(Contains(
    Thrown(
      [&] {
        PlanTiles(Place("EPSG:4326", -180.0, 90.0, 180.0, -90.0, size), size, 256, { { 0, 23 } });
      }),
    "at zoom 23"));
  CHECK(PlanTiles(Place("EPSG:4326", 0.0, 1.0, 1.0, 0.0, size), size, 256, { { 3, 9 } }).Zoom ==
    (std::array<int, 2>{ 3, 9 }));
}
}

int TestTilePlan(int, char*[])
{
  TestExactTiles();
  TestPlaces();
  TestWholeEarth();
  TestRoundTheEarth();
  TestRefusals();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
