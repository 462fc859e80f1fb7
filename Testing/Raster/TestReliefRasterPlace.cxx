// SPDX-License-Identifier: BSD-3-Clause
// True metres whatever the map is, and places that are turned or told by points.
#include "RasterReadingUtilities.h"

#include "vtkImageReliefShading.h"
#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkReliefRasterWriter.h"
#include "vtkReliefScene.h"

namespace
{
const double Pi = vtkMath::Pi();

bool Spaced(Read& read, double x, double y, double share = 1e-6)
{
  const double* spacing = read.Image()->GetSpacing();
  return std::abs(spacing[0] / x - 1.0) <= share && std::abs(spacing[1] / y - 1.0) <= share;
}

// A spherical map of an ellipsoid: its metres are too long by the cosine of the latitude, and by
// the ellipsoid's two radii of curvature.
void TestMercator()
{
  const double a = 6378137.0;
  const double e2 = 0.00669437999014;
  for (const double latitude : { -60.0, 0.2, 30.0, 70.0 })
  {
    const double phi = latitude * Pi / 180.0;
    const double y = a * std::log(std::tan(0.25 * Pi + 0.5 * phi));
    TestRaster raster;
    raster.Epsg = 3857;
    raster.Transform = { 1000000.0, 30.0, 0.0, y + 2.0 * 20.0, 0.0, -20.0 };
    Read read(raster);
    const double w = std::sqrt(1.0 - e2 * std::pow(std::sin(phi), 2));
    const double x = std::cos(phi) / w;
    const double meridian = std::cos(phi) * (1.0 - e2) / (w * w * w);
    // At the equator a meridian is shorter by more than half a per cent, so that both count.
    CHECK(Spaced(read, 30.0 * x, 20.0 * meridian));
    CHECK(Near(read.Told("geo:spacing", 0), read.Image()->GetSpacing()[0]));
  }
}

// An equal-area map, 1700 km south of its centre: stretched along x as much as it is pressed along
// y.
void TestEqualArea()
{
  TestRaster raster;
  raster.Epsg = 3035;
  raster.Transform = { 4321000.0 - 75.0, 30.0, 0.0, 1500000.0, 0.0, -30.0 };
  Read read(raster);
  const double* spacing = read.Image()->GetSpacing();
  const double half = 0.5 * (3210000.0 - 1500000.0) / 6371000.0; // of the angle, nearly
  CHECK(Spaced(read, 30.0 * std::cos(half), 30.0 / std::cos(half), 1e-3));
  CHECK(std::abs(spacing[0] * spacing[1] / 900.0 - 1.0) < 1e-6);
}

// Zones of 6 degrees stay round: their scale is within half a per cent of 1.
void TestRoundNumbers()
{
  for (const double east : { 200000.0, 500000.0, 800000.0 })
  {
    TestRaster raster;
    raster.Transform[0] = east;
    Read read(raster);
    CHECK(read.Image()->GetSpacing()[0] == 30.0 && read.Image()->GetSpacing()[1] == 20.0);
  }
  // Far outside of the zone it counts.
  TestRaster raster;
  raster.Transform[0] = 1500000.0;
  Read far(raster);
  CHECK(far.Image()->GetSpacing()[0] < 29.8 && far.Image()->GetSpacing()[0] > 29.0);
}

// One spacing for all is told where it is far from the truth.
void TestLargeMaps()
{
  TestRaster world;
  world.Epsg = 4326;
  world.Transform = { -180.0, 72.0, 0.0, 90.0, 0.0, -45.0 };
  Read degrees(world, "0.00 to 1.00 times as long as at its centre");
  world.Transform = { 10.0, 1.0, 0.0, 50.0, 0.0, -1.0 };
  Read country(world);
  TestRaster map;
  map.Epsg = 3857;
  map.Transform = { 0.0, 1e6, 0.0, 8e6, 0.0, -2e6 };
  Read mercator(map, "times as long as at its centre");
}

// Points that lie as a transform has it are one.
void TestPoints()
{
  TestRaster raster;
  raster.Epsg = 0;
  const std::array<double, 6> t = raster.Transform;
  raster.Transform = {};
  double bend = 0.0;
  raster.More = [&](GDALDataset* file)
  {
    std::vector<GDAL_GCP> points(4);
    GDALInitGCPs(4, points.data());
    for (int k = 0; k < 4; ++k)
    {
      const double column = k % 2 * 5.0;
      const double row = k / 2 * 4.0;
      points[k].dfGCPPixel = column;
      points[k].dfGCPLine = row;
      points[k].dfGCPX = t[0] + column * t[1] + (k == 3 ? bend : 0.0);
      points[k].dfGCPY = t[3] + row * t[5];
    }
    OGRSpatialReference crs;
    crs.importFromEPSG(32632);
    CHECK(file->SetGCPs(4, points.data(), &crs) == CE_None);
    GDALDeinitGCPs(4, points.data());
  };
  Read placed(raster);
  CHECK(Spaced(placed, 30.0, 20.0));
  for (int k = 0; k < 6; ++k)
  {
    CHECK(std::abs(placed.Told("geo:transform", k) - t[k]) < 1e-6);
  }
  CHECK(placed.Image()->GetFieldData()->GetAbstractArray("geo:crs"));
  bend = 100.0;
  Read bent(raster, "ground control points that no straight map fits");
  CHECK(Spaced(bent, 1.0, 1.0));
}

/// A transform turned clockwise by degrees.
std::array<double, 6> Turned(const std::array<double, 6>& t, double degrees)
{
  const double c = std::cos(degrees * Pi / 180.0);
  const double s = std::sin(degrees * Pi / 180.0);
  return { t[0], c * t[1], s * t[5], t[3], -s * t[1], c * t[5] };
}

vtkSmartPointer<vtkImageData> Shade(vtkAlgorithmOutput* heights, double azimuth)
{
  vtkNew<vtkImageReliefShading> shading;
  shading->SetInputConnection(heights);
  shading->GetScene()->AddSun(azimuth, 20.0);
  shading->Update();
  return shading->GetOutput();
}

// Turned rasters lie in the world as on the map: the sun keeps its direction, and what is written
// the place of what was read.
void TestTurned()
{
  const TestRaster straight;
  for (const double degrees : { 20.0, -70.0, 90.0, 135.0, 180.0 })
  {
    Read plain(straight);
    const auto expected = Shade(plain.Reader->GetOutputPort(), 315.0 - degrees);
    TestRaster raster;
    raster.Transform = Turned(straight.Transform, degrees);
    Read read(raster);
    CHECK(Spaced(read, 30.0, 20.0, 1e-12));
    CHECK(read.At(1, 2) == 12.0);
    const double* direction = read.Image()->GetDirectionMatrix()->GetData();
    CHECK(std::abs(direction[0] - std::cos(degrees * Pi / 180.0)) < 1e-12);
    CHECK(std::abs(direction[3] + std::sin(degrees * Pi / 180.0)) < 1e-12);
    const auto picture = Shade(read.Reader->GetOutputPort(), 315.0);
    double worst = 0.0;
    for (int k = 0; k < 20; ++k)
    {
      worst = std::max(worst,
        std::abs(picture->GetScalarComponentAsDouble(k % 5, k / 5, 0, 0) -
          expected->GetScalarComponentAsDouble(k % 5, k / 5, 0, 0)));
    }
    CHECK(worst < 1e-5);

    vtkNew<vtkReliefRasterWriter> writer;
    MessageKeeper messages(writer);
    const std::string name = Directory + "turned.tif";
    writer->SetInputData(picture);
    writer->SetFileName(name.c_str());
    writer->Write();
    CHECK(writer->GetErrorCode() == vtkErrorCode::NoError && messages.Silent());
    std::array<double, 6> written{};
    GDALDataset* file = static_cast<GDALDataset*>(GDALOpen(name.c_str(), GA_ReadOnly));
    CHECK(file && file->GetGeoTransform(written.data()) == CE_None);
    GDALClose(file);
    for (int k = 0; k < 6; ++k)
    {
      CHECK(std::abs(written[k] - raster.Transform[k]) < 1e-6);
    }
  }
  // Turns that come of rounding are none.
  TestRaster tiny;
  tiny.Transform[2] = 1e-13;
  tiny.Transform[4] = -1e-13;
  Read read(tiny);
  CHECK(read.Image()->GetDirectionMatrix()->IsIdentity() && Spaced(read, 30.0, 20.0, 0.0));
}
}

namespace
{
bool Placed(Read& read, double longitude, double latitude, double convergence, double tolerance)
{
  const double* place = read.Reader->GetPlace();
  return std::abs(std::remainder(place[0] - longitude, 360.0)) <= tolerance &&
    std::abs(place[1] - latitude) <= tolerance &&
    std::abs(std::remainder(place[2] - convergence, 360.0)) <= tolerance;
}

// A raster whose centre is that place on its map.
TestRaster Around(int epsg, double x, double y, double step)
{
  TestRaster raster;
  raster.Epsg = epsg;
  raster.Transform = { x - 2.5 * step, step, 0.0, y + 2.0 * step, 0.0, -step };
  return raster;
}

// Where the sun of a place stands on the map: longitude, latitude and the grid's convergence.
void TestPlace()
{
  // Degrees are as they are, whatever the units, and turn nothing.
  Read degrees(Around(4326, 171.25, -43.5, 0.01));
  CHECK(Placed(degrees, 171.25, -43.5, 0.0, 1e-9));
  Read beyond(Around(4326, 190.0, 65.0, 0.01));
  CHECK(Placed(beyond, -170.0, 65.0, 0.0, 1e-9));
  // Transverse Mercator: none on the middle meridian, to the east of it north is to the west.
  Read middle(Around(32632, 500000.0, 5000000.0, 30.0));
  CHECK(Placed(middle, 9.0, middle.Reader->GetPlace()[1], 0.0, 1e-7));
  for (const int epsg : { 32632, 32732 })
  {
    for (const double x : { 250000.0, 780000.0 })
    {
      Read side(Around(epsg, x, 5900000.0, 30.0));
      const double* place = side.Reader->GetPlace();
      const double east = (place[0] - 9.0) * Pi / 180.0;
      const double expected =
        std::atan(std::tan(east) * std::sin(place[1] * Pi / 180.0)) * 180.0 / Pi;
      CHECK((x > 500000.0) == (place[0] > 9.0) && (epsg == 32632) == (place[1] > 0.0));
      CHECK(std::abs(expected) > 1.0 && std::abs(place[2] - expected) < 1e-4);
    }
  }
  // Web Mercator has none anywhere, though its scale is not that of the ground.
  Read web(Around(3857, 6378137.0 * Pi / 3.0, 6000000.0, 30.0));
  CHECK(Placed(web, 60.0, web.Reader->GetPlace()[1], 0.0, 1e-7));
  // About the poles north is inward and outward.
  for (const double longitude : { -150.0, -35.0, 0.0, 90.0, 178.0 })
  {
    const double sine = std::sin(longitude * Pi / 180.0);
    const double cosine = std::cos(longitude * Pi / 180.0);
    Read arctic(Around(3995, 800000.0 * sine, -800000.0 * cosine, 100.0));
    CHECK(Placed(arctic, longitude, arctic.Reader->GetPlace()[1], longitude, 1e-6));
    Read antarctic(Around(3031, 800000.0 * sine, 800000.0 * cosine, 100.0));
    CHECK(Placed(antarctic, longitude, antarctic.Reader->GetPlace()[1], -longitude, 1e-6));
  }
  // Five hundred metres from a pole it is the same, but for the metres of x and y: they are told by
  // places 10 m away, where meridians have turned, and differ by 4e-5.
  Read pole(Around(3995, 300.0, 400.0, 1.0));
  CHECK(Placed(pole, 143.1301, 90.0 - 500.0 * 180.0 / (Pi * 6.4e6), 143.1301, 2e-3));
  // A raster that is turned on its map has that map's place.
  TestRaster turned = Around(32632, 780000.0, 5900000.0, 30.0);
  turned.Transform = { 780000.0, 20.0, 10.0, 5900000.0, 10.0, -20.0 };
  Read aslant(turned);
  CHECK(std::abs(aslant.Reader->GetPlace()[2] - 3.35) < 0.1);

  // The sun at noon is in the true south: on this map 3.35 degrees beside it.
  Read east(Around(32632, 780000.0, 5900000.0, 30.0));
  vtkNew<vtkReliefScene> scene;
  const double* there = east.Reader->GetPlace();
  double angles[2];
  CHECK(scene->FindSun("2026-06-21T11:08:30Z", there[0], there[1], 0.0, true, angles));
  vtkLight* sun = scene->AddSunAt("2026-06-21T11:08:30Z", there[0], there[1], there[2]);
  const double onMap =
    std::atan2(sun->GetPosition()[0], sun->GetPosition()[1]) * 180.0 / Pi + 360.0;
  CHECK(std::abs(angles[0] - 180.0) < 1.0);
  CHECK(std::abs(std::remainder(onMap - (angles[0] - there[2]), 360.0)) < 1e-9);
}

// Without a place, and on another body.
void TestNoPlace()
{
  const auto isRefused = [](const TestRaster& raster, const std::string& reason)
  {
    const std::string name = Directory + "placeless.tif";
    WriteRaster(name, raster);
    vtkNew<vtkReliefRasterReader> reader;
    MessageKeeper messages(reader);
    reader->SetFileName(name.c_str());
    const double* place = reader->GetPlace();
    return std::isnan(place[0]) && std::isnan(place[1]) && std::isnan(place[2]) &&
      messages.OneError(reason);
  };
  TestRaster plain;
  plain.Epsg = 0;
  plain.Transform = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
  CHECK(isRefused(plain, "no georeference"));
  TestRaster unnamed;
  unnamed.Epsg = 0;
  CHECK(isRefused(unnamed, "no coordinate reference system"));
  TestRaster moon;
  moon.Epsg = 0;
  moon.Transform = { 10.0, 0.01, 0.0, 20.0, 0.0, -0.01 };
  moon.More = [](GDALDataset* file)
  {
    OGRSpatialReference crs;
    crs.importFromWkt("GEOGCS[\"Moon\",DATUM[\"D_Moon\",SPHEROID[\"Moon\",1737400,0]],"
                      "PRIMEM[\"Reference\",0],UNIT[\"degree\",0.0174532925199433]]");
    file->SetSpatialRef(&crs);
  };
  CHECK(isRefused(moon, "not of the Earth"));
}
}

int TestReliefRasterPlace(int argc, char* argv[])
{
  Directory = EmptyDirectory(argc, argv, "TestReliefRasterPlace");
  TestMercator();
  TestEqualArea();
  TestRoundNumbers();
  TestLargeMaps();
  TestPoints();
  TestTurned();
  TestPlace();
  TestNoPlace();
  return Failures;
}
