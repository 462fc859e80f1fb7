// SPDX-License-Identifier: BSD-3-Clause
// Heights come in metres and where they belong, whatever the file's units, types and marks are.
#include "vtkReliefRasterReader.h"

#include "RasterReadingUtilities.h"

#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkStringArray.h"

#include <cmath>

namespace
{
// Spacing, rows, types and field data of a projected raster.
void TestProjected()
{
  Read read{ TestRaster() };
  CHECK(read.Image()->GetScalarType() == VTK_FLOAT);
  CHECK(read.At(0, 0) == 0.0 && read.At(3, 4) == 34.0 && read.At(1, 2) == 12.0);
  const double* spacing = read.Image()->GetSpacing();
  CHECK(spacing[0] == 30.0 && spacing[1] == 20.0);
  const double* origin = read.Image()->GetOrigin();
  CHECK(origin[0] == 0.0 && origin[1] == 0.0);
  CHECK(read.Told("geo:transform", 0) == 500000.0 && read.Told("geo:transform", 5) == -20.0);
  CHECK(read.Told("geo:size", 0) == 5.0 && read.Told("geo:size", 1) == 4.0);
  CHECK(read.Told("geo:spacing", 1) == 20.0 && read.Told("geo:heightUnit") == 1.0);
  auto* crs =
    vtkStringArray::SafeDownCast(read.Image()->GetFieldData()->GetAbstractArray("geo:crs"));
  CHECK(crs && std::string(crs->GetValue(0)).find("32632") != std::string::npos);
  CHECK(read.Image()->GetFieldData()->GetArray("geo:noData") == nullptr);
  CHECK(std::isnan(read.Reader->GetFileNoDataValue()));
  CHECK(read.MaskAt(2, 2) == 255.0);

  for (const auto& type : { std::make_pair(GDT_Byte, VTK_UNSIGNED_CHAR), { GDT_Int16, VTK_SHORT },
         { GDT_UInt16, VTK_UNSIGNED_SHORT }, { GDT_Int32, VTK_INT }, { GDT_Float64, VTK_DOUBLE } })
  {
    TestRaster raster;
    raster.Type = type.first;
    Read typed(raster);
    CHECK(typed.Image()->GetScalarType() == type.second && typed.At(3, 4) == 34.0);
  }
}

// Degrees become metres at the middle latitude; files that do not name them are asked about.
void TestDegrees()
{
  TestRaster raster;
  raster.Epsg = 4326;
  raster.Transform = { 10.0, 0.01, 0.0, 60.02, 0.0, -0.01 };
  Read read(raster);
  // At 60 degrees on WGS 84: 55,800 m per degree of longitude, 111,412 m per degree of latitude.
  const double* spacing = read.Image()->GetSpacing();
  CHECK(std::abs(spacing[0] - 558.0) < 0.01 && std::abs(spacing[1] - 1114.12) < 0.01);

  raster.Epsg = 0;
  Read forced(raster, [](vtkReliefRasterReader* reader) { reader->DegreesOn(); });
  CHECK(Near(forced.Image()->GetSpacing()[0], spacing[0]));
  vtkNew<vtkReliefRasterReader> asks;
  MessageKeeper messages(asks);
  asks->SetFileName((Directory + "raster.tif").c_str());
  asks->Update();
  CHECK(messages.OneWarning("DegreesOn") && asks->GetErrorCode() == vtkErrorCode::NoError);
  CHECK(asks->GetOutput()->GetSpacing()[0] == 0.01);
}

// Feet on the map and feet of height.
void TestUnits()
{
  TestRaster raster;
  raster.Epsg = 2263; // US survey feet
  raster.Transform = { 980000.0, 30.0, 0.0, 200000.0, 0.0, -20.0 };
  raster.More = [](GDALDataset* file) { file->GetRasterBand(1)->SetUnitType("ft"); };
  Read read(raster);
  CHECK(Near(read.Image()->GetSpacing()[0], 30.0 * 1200.0 / 3937.0));
  CHECK(Near(read.At(3, 4), 34.0 * 0.3048) && Near(read.Told("geo:heightUnit"), 0.3048));
  Read raw(raster, [](vtkReliefRasterReader* reader) { reader->HeightsInMetersOff(); });
  CHECK(raw.At(3, 4) == 34.0);

  TestRaster scaled;
  scaled.Type = GDT_Int16;
  scaled.More = [](GDALDataset* file)
  {
    file->GetRasterBand(1)->SetScale(0.5);
    file->GetRasterBand(1)->SetOffset(100.0);
    file->GetRasterBand(1)->SetNoDataValue(12.0);
  };
  Read stored(scaled);
  CHECK(stored.Image()->GetScalarType() == VTK_FLOAT && stored.At(3, 4) == 117.0);
  CHECK(std::isnan(stored.At(1, 2)) && stored.MaskAt(1, 2) == 0.0);

  TestRaster bare;
  bare.Epsg = 0;
  bare.Transform[1] = 0.0;
  Read plain(bare, [](vtkReliefRasterReader* reader) { reader->SetDataSpacing(3.0, 4.0, 1.0); });
  CHECK(plain.Image()->GetSpacing()[0] == 3.0 && plain.Image()->GetSpacing()[1] == 4.0);
  CHECK(plain.Image()->GetFieldData()->GetArray("geo:transform") == nullptr);
}

// Samples without data are NaN, and 0 in the mask.
void TestNoData()
{
  TestRaster raster;
  raster.Type = GDT_Int16;
  raster.More = [](GDALDataset* file) { file->GetRasterBand(1)->SetNoDataValue(12.0); };
  Read read(raster);
  CHECK(read.Image()->GetScalarType() == VTK_FLOAT);
  CHECK(std::isnan(read.At(1, 2)) && read.At(1, 3) == 13.0);
  CHECK(read.MaskAt(1, 2) == 0.0 && read.MaskAt(1, 3) == 255.0);
  CHECK(read.Told("geo:noData") == 12.0 && read.Reader->GetFileNoDataValue() == 12.0);

  Read kept(raster, [](vtkReliefRasterReader* reader) { reader->NoDataToNaNOff(); });
  CHECK(kept.Image()->GetScalarType() == VTK_SHORT && kept.At(1, 2) == 12.0);
  CHECK(kept.MaskAt(1, 2) == 0.0);

  Read other(raster,
    [](vtkReliefRasterReader* reader)
    {
      reader->NoDataFromFileOff();
      reader->SetNoDataValue(20.0);
    });
  CHECK(other.At(1, 2) == 12.0 && std::isnan(other.At(2, 0)));

  TestRaster wide;
  wide.Type = GDT_Int32;
  wide.More = raster.More;
  CHECK(Read(wide).Image()->GetScalarType() == VTK_DOUBLE);

  TestRaster real;
  real.More = raster.More;
  Read floats(real);
  CHECK(std::isnan(floats.At(1, 2)) && floats.MaskAt(1, 2) == 0.0);
}

// Alpha hides; a band is chosen.
void TestBandsAndMask()
{
  TestRaster raster;
  raster.Type = GDT_Byte;
  raster.Bands = 2;
  raster.More = [](GDALDataset* file)
  { file->GetRasterBand(2)->SetColorInterpretation(GCI_AlphaBand); };
  Read masked(raster);
  CHECK(masked.Image()->GetScalarType() == VTK_FLOAT && masked.MaskAt(0, 0) == 255.0);

  TestRaster several;
  several.Bands = 3;
  Read third(several, [](vtkReliefRasterReader* reader) { reader->SetBand(3); });
  CHECK(third.At(1, 2) == 212.0);
  Read first(several);
  CHECK(first.At(1, 2) == 12.0);
}

// South up, and grids of Esri's.
void TestRows()
{
  TestRaster raster;
  raster.Transform = { 500000.0, 30.0, 0.0, 4000000.0, 0.0, 20.0 };
  Read read(raster);
  CHECK(read.Image()->GetScalarComponentAsDouble(0, 0, 0, 0) == 0.0);
  CHECK(read.Image()->GetScalarComponentAsDouble(4, 3, 0, 0) == 34.0);

  const std::string grid = Directory + "grid.asc";
  WriteText(grid, "ncols 2\nnrows 2\nxllcorner 1000\nyllcorner 2000\ncellsize 10\n1 2\n3 4\n");
  vtkNew<vtkReliefRasterReader> reader;
  MessageKeeper messages(reader);
  ProgressKeeper progress(reader);
  reader->SetFileName(grid.c_str());
  CHECK(reader->CanReadFile(grid.c_str()) == 2);
  reader->Update();
  CHECK(reader->GetErrorCode() == vtkErrorCode::NoError && messages.Silent());
  CHECK(!progress.Steps.empty() && progress.Rises());
  CHECK(reader->GetOutput()->GetScalarComponentAsDouble(0, 0, 0, 0) == 3.0);
  CHECK(reader->GetOutput()->GetSpacing()[0] == 10.0);
}
}

int TestReliefRasterReader(int argc, char* argv[])
{
  Directory = EmptyDirectory(argc, argv, "TestReliefRasterReader");
  TestProjected();
  TestDegrees();
  TestUnits();
  TestNoData();
  TestBandsAndMask();
  TestRows();
  return Failures;
}
