// SPDX-License-Identifier: BSD-3-Clause
// True metres whatever the map is, and places that are turned or told by points.
#include "RasterReadingUtilities.h"

#include "vtkImageReliefShading.h"
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

int TestReliefRasterPlace(int argc, char* argv[])
{
  Directory = EmptyDirectory(argc, argv, "TestReliefRasterPlace");
  TestMercator();
  TestEqualArea();
  TestRoundNumbers();
  TestLargeMaps();
  TestPoints();
  TestTurned();
  return Failures;
}
