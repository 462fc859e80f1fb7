// SPDX-License-Identifier: BSD-3-Clause
// What heights mean: their unit by any of its names, and samples without data by alpha, by values
// that are declared, and by those that nobody declared.
#include "RasterReadingUtilities.h"

#include <limits>

namespace
{
constexpr double SurveyFoot = 1200.0 / 3937.0;

// As UDUNITS, EPSG, Esri, GRIB and people write them.
void TestUnits()
{
  const std::pair<const char*, double> units[] = { { "m", 1.0 }, { "Metre", 1.0 },
    { "meters", 1.0 }, { "[m]", 1.0 }, { " (m) ", 1.0 }, { "m.a.s.l.", 1.0 }, { "[gpm]", 1.0 },
    { "1", 1.0 }, { "unitless", 1.0 }, { "KM", 1000.0 }, { "kilometres", 1000.0 }, { "dm", 0.1 },
    { "decimeter", 0.1 }, { "cm", 0.01 }, { "Centimetres", 0.01 }, { "mm", 0.001 },
    { "millimeters", 0.001 }, { "0.1 m", 0.1 }, { "0.01*m", 0.01 }, { "ft", 0.3048 },
    { "Foot", 0.3048 }, { "feet", 0.3048 }, { "international_foot", 0.3048 },
    { "foot (international)", 0.3048 }, { "US survey foot", SurveyFoot },
    { "US_survey_foot", SurveyFoot }, { "US_survey_feet", SurveyFoot }, { "us-ft", SurveyFoot },
    { "ftUS", SurveyFoot }, { "Foot_US", SurveyFoot }, { "survey_foot", SurveyFoot },
    { "inch", 0.0254 }, { "inches", 0.0254 }, { "yard", 0.9144 }, { "yards", 0.9144 },
    { "fathom", 1.8288 }, { "Fathoms", 1.8288 }, { "nautical mile", 1852.0 },
    { "Clarke's foot", 0.3047972654 }, { "British foot (Sears 1922)", 12.0 / 39.370147 } };
  for (const auto& unit : units)
  {
    std::cout << "  " << unit.first << std::endl;
    TestRaster raster;
    raster.More = [&unit](GDALDataset* file) { file->GetRasterBand(1)->SetUnitType(unit.first); };
    Read read(raster);
    CHECK(Near(read.At(3, 4), 34.0 * unit.second));
    CHECK(Near(read.Told("geo:heightUnit"), unit.second));
  }
  for (const char* unknown : { "furlongs", "degree", "m2 s-2", "12", "s" })
  {
    TestRaster raster;
    raster.More = [unknown](GDALDataset* file) { file->GetRasterBand(1)->SetUnitType(unknown); };
    Read read(raster, "\"" + std::string(unknown) + "\", is not known; they are taken for metres");
    CHECK(read.At(3, 4) == 34.0 && read.Told("geo:heightUnit") == 1.0);
  }
}

// 0 hides, in whatever numbers alpha comes.
void TestAlpha()
{
  for (const GDALDataType type :
    { GDT_Byte, GDT_UInt16, GDT_Int16, GDT_Int32, GDT_UInt32, GDT_Float32, GDT_Float64 })
  {
    TestRaster raster;
    raster.Type = type;
    raster.Bands = 2;
    raster.Value = [](int band, int row, int column) {
      return band == 1 ? 10.0 * row + column : row == 1 && column == 2 ? 0.0 : 1.0;
    };
    raster.More = [](GDALDataset* file)
    { file->GetRasterBand(2)->SetColorInterpretation(GCI_AlphaBand); };
    Read read(raster);
    CHECK(std::isnan(read.At(1, 2)) && read.MaskAt(1, 2) == 0.0);
    CHECK(read.At(1, 3) == 13.0 && read.MaskAt(1, 3) == 255.0);
    // Beside a value that is declared; and as heights, if somebody wants that.
    raster.More = [](GDALDataset* file)
    {
      file->GetRasterBand(2)->SetColorInterpretation(GCI_AlphaBand);
      file->GetRasterBand(1)->SetNoDataValue(34.0);
    };
    Read both(raster);
    CHECK(both.MaskAt(1, 2) == 0.0 && both.MaskAt(3, 4) == 0.0 && both.MaskAt(3, 3) == 255.0);
    Read alpha(raster, [](vtkReliefRasterReader* reader) { reader->SetBand(2); });
    CHECK(alpha.At(3, 3) == 1.0 && alpha.MaskAt(3, 3) == 255.0);
  }
}

/// Relief from 400 to 434 with a value at four places.
TestRaster Marked(double value, GDALDataType type = GDT_Float32)
{
  TestRaster raster;
  raster.Type = type;
  raster.Value = [value](int, int row, int column)
  { return row < 2 && column < 2 ? value : 400.0 + 10.0 * row + column; };
  return raster;
}

// No height is as low as the lowest float.
void TestLowestFloat()
{
  const double lowest = -std::numeric_limits<float>::max();
  const auto declare = [](double value)
  { return [value](GDALDataset* file) { file->GetRasterBand(1)->SetNoDataValue(value); }; };
  for (const GDALDataType type : { GDT_Float32, GDT_Float64 })
  {
    for (const double sign : { 1.0, -1.0 })
    {
      TestRaster raster = Marked(sign * lowest, type);
      Read undeclared(raster);
      CHECK(std::isnan(undeclared.At(0, 0)) && undeclared.MaskAt(1, 1) == 0.0);
      CHECK(undeclared.At(0, 2) == 402.0 && undeclared.MaskAt(0, 2) == 255.0);
      raster.More = declare(sign * -3.4e38);
      CHECK(std::isnan(Read(raster).At(0, 0)));
      raster.More = declare(-9999.0);
      CHECK(std::isnan(Read(raster).At(0, 0)));
    }
  }
  TestRaster lowestDouble = Marked(-std::numeric_limits<double>::max(), GDT_Float64);
  CHECK(std::isnan(Read(lowestDouble).At(0, 0)));
  // Declared for floats, it is the lowest that they hold.
  TestRaster raster = Marked(lowest);
  raster.More = declare(-std::numeric_limits<double>::max());
  Read clamped(raster);
  CHECK(std::isnan(clamped.At(0, 0)) && clamped.Reader->GetFileNoDataValue() == lowest);
}

// Values that look like no data are told; they stay heights until somebody says so.
void TestUndeclared()
{
  struct Case
  {
    double Value;
    GDALDataType Type;
    const char* Text;
  };
  for (const Case& marked : { Case{ -9999.0, GDT_Float32, "value, -9999 in 4 of 20 samples" },
         Case{ -9999.0, GDT_Int16, "-9999" }, Case{ -32768.0, GDT_Int16, "-32768 in 4" },
         Case{ -32767.0, GDT_Int16, "-32767" }, Case{ 32767.0, GDT_Int16, "highest value, 32767" },
         Case{ 65535.0, GDT_UInt16, "65535" }, Case{ -99999.0, GDT_Float64, "-99999" },
         Case{ -2147483648.0, GDT_Int32, "-2147483648" }, Case{ 1e10, GDT_Float32, ", 1e+10 in" },
         Case{ -1e30, GDT_Float64, "-1e+30" }, Case{ 0.0, GDT_Float32, "lowest value, 0 in 4" } })
  {
    std::cout << "  " << marked.Text << std::endl;
    TestRaster raster = Marked(marked.Value, marked.Type);
    Read read(raster, marked.Text);
    CHECK(Near(read.At(0, 0), marked.Value) && read.MaskAt(0, 0) == 255.0);
    // Following the advice silences it.
    Read followed(raster,
      [&marked](vtkReliefRasterReader* reader)
      {
        reader->NoDataFromFileOff();
        reader->SetNoDataValue(marked.Value);
      });
    CHECK(followed.MaskAt(0, 0) == 0.0 && followed.MaskAt(0, 2) == 255.0);
  }
  TestRaster scaled = Marked(-9999.0, GDT_Int16);
  scaled.More = [](GDALDataset* file) { file->GetRasterBand(1)->SetScale(0.1); };
  Read read(scaled, "lowest value, -9999 in 4");
}

// Heights that are heights: nothing is said of them.
void TestHeights()
{
  for (const double value : { 390.0, -100.0, -8.0 })
  {
    Read read{ Marked(value) };
  }
  TestRaster shore; // a flat sea and an island that rises from it
  shore.Value = [](int, int row, int column)
  { return row == 0 || column == 0 ? 0.0 : 10.0 * row + column - 10.0; };
  Read sea(shore);
  TestRaster deep; // between other depths
  deep.Value = [](int, int row, int column)
  { return row < 2 && column < 2 ? -9999.0 : -10000.0 + 3000.0 * row - column; };
  Read depths(deep);
  TestRaster single = Marked(400.0);
  single.Value = [](int, int row, int column)
  { return row == 0 && column == 0 ? -9999.0 : 400.0 + row + column; };
  Read once(single);
  TestRaster picture; // black and white
  picture.Type = GDT_UInt16;
  picture.Epsg = 0;
  picture.Transform = {};
  picture.Value = [](int, int row, int) { return row < 2 ? 0.0 : 65535.0; };
  Read white(picture);
  TestRaster plateau; // two heights
  plateau.Value = [](int, int row, int) { return row < 2 ? 0.0 : 30.0; };
  CHECK(Read(plateau).At(3, 3) == 30.0);
}

// What the numbers cannot hold marks nothing.
void TestImpossible()
{
  TestRaster raster;
  raster.Type = GDT_UInt16;
  raster.More = [](GDALDataset* file) { file->GetRasterBand(1)->SetNoDataValue(-9999.0); };
  Read read(raster, "it declares -9999 to be no data, which its numbers (UInt16) cannot be");
  CHECK(std::isnan(read.Reader->GetFileNoDataValue()) && read.MaskAt(0, 0) == 255.0);
  CHECK(read.Image()->GetScalarType() == VTK_UNSIGNED_SHORT);
  raster.Type = GDT_Byte;
  raster.More = [](GDALDataset* file) { file->GetRasterBand(1)->SetNoDataValue(0.5); };
  Read half(raster, "it declares 0.5");
  CHECK(half.MaskAt(0, 0) == 255.0);
}
}

int TestReliefRasterUnits(int argc, char* argv[])
{
  Directory = EmptyDirectory(argc, argv, "TestReliefRasterUnits");
  CPLSetErrorHandler(CPLQuietErrorHandler);
  TestUnits();
  TestAlpha();
  TestLowestFloat();
  TestUndeclared();
  TestHeights();
  TestImpossible();
  return Failures;
}
