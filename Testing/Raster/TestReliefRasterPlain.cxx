// SPDX-License-Identifier: BSD-3-Clause
// What is read in every build, with GDAL and without: grids of Esri's and VTK's own pictures.
#include "vtkReliefRasterReader.h"

#include "FileTestUtilities.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMetaImageWriter.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPointData.h"
#include "vtkVariant.h"

#include <algorithm>
#include <clocale>
#include <cmath>
#include <cstdio>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace
{
int Failures = 0;
std::string Directory;

/// A row of heights as text, in a grid.
void Grid(const std::string& heights, int columns)
{
  WriteText(Directory + "grid.asc",
    "ncols " + std::to_string(columns) +
      "\nnrows 1\nxllcorner 1e3\nyllcorner +2000.5\ncellsize 2.5\n" + heights + "\n");
}

// Numbers have a point, whatever the locale says.
void TestNumbers()
{
  vtkNew<vtkReliefRasterReader> reader;
  MessageKeeper messages(reader);
  reader->SetFileName((Directory + "grid.asc").c_str());
  const double nan = std::nan("");
  const double expected[] = { 12.5, 1.5, -0.25, 1200.0, 0.003, 3.0, 0.5, 0.0, nan, nan };
  Grid("12.5 +1.5 -.25 1.2e3 3E-3 3. 0.5 1e-999 nan NaN", 10);
  reader->Update();
  CHECK(reader->GetErrorCode() == vtkErrorCode::NoError && messages.Silent());
  vtkImageData* image = reader->GetOutput();
  CHECK(image->GetNumberOfPoints() == 10 && image->GetSpacing()[0] == 2.5);
  for (int k = 0; k < 10 && image->GetNumberOfPoints() == 10; ++k)
  {
    const double height = image->GetScalarComponentAsDouble(k, 0, 0, 0);
    CHECK(height == static_cast<float>(expected[k]) || std::isnan(height + expected[k]));
  }
  for (const char* word : { "1.5m", "1,5m", "1.#", "1.#Q-", "1,2,3", "+", "+-1", "--1", "e3" })
  {
    Grid(word, 1);
    reader->Modified();
    reader->Update();
    const bool commas = std::string(word).find(',') != std::string::npos;
    CHECK(messages.OneError(std::string(word) == "1,5m" ? "'1.5m' is no number"
        : commas                                        ? "1 heights are announced, 1 or 3 found"
                 : "'" + std::string(word) + "' is no number"));
  }
}

/// Reads a grid of one row; what it is to hold.
void CheckGrid(const std::string& heights, const std::vector<double>& expected)
{
  Grid(heights, static_cast<int>(expected.size()));
  vtkNew<vtkReliefRasterReader> reader;
  MessageKeeper messages(reader);
  reader->SetFileName((Directory + "grid.asc").c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  CHECK(messages.Silent());
  CHECK(image->GetNumberOfPoints() == static_cast<vtkIdType>(expected.size()));
  for (vtkIdType k = 0; k < image->GetNumberOfPoints(); ++k)
  {
    const double height = image->GetPointData()->GetScalars()->GetComponent(k, 0);
    // What is infinite is no data as well.
    CHECK(height == expected[k] || (!std::isfinite(height) && !std::isfinite(expected[k])));
  }
}

// Commas part numbers or are their points: the number of heights tells.
void TestCommas()
{
  CheckGrid("1.5,2.5,-3,4e2", { 1.5, 2.5, -3.0, 400.0 });
  CheckGrid("1.5, 2.5 ,\t-3 , 4,", { 1.5, 2.5, -3.0, 4.0 });
  CheckGrid("1,5 2,5 -3 4e2", { 1.5, 2.5, -3.0, 400.0 });
  CheckGrid("1,5;2,5;-3;4", { 1.5, 2.5, -3.0, 4.0 });
  CheckGrid("1,5 2,5", { 1.5, 2.5 });
  CheckGrid("1,5 2,5", { 1.0, 5.0, 2.0, 5.0 });
  CheckGrid("12,5", { 12.5 });
  vtkNew<vtkReliefRasterReader> reader;
  MessageKeeper messages(reader);
  reader->SetFileName((Directory + "grid.asc").c_str());
  // Neither count fits; or a number is missing; or there are points as well.
  for (const char* text : { "1,5 2,5 3 4 5", "1,,2,3", "1,5 2.5 3 4" })
  {
    Grid(text, std::string(text) == "1,,2,3" ? 3 : 4);
    reader->Modified();
    reader->Update();
    CHECK(messages.OneError("not clear whether they part numbers or stand for points"));
  }
  std::string wide = "1";
  for (int k = 0; k < 3000; ++k)
  {
    wide += ",1.5,x";
  }
  Grid(wide, 6001);
  reader->Modified();
  reader->Update();
  CHECK(messages.OneError("'x' is no number"));
  Grid(std::string(5000, 'x'), 1);
  reader->Modified();
  reader->Update();
  CHECK(messages.OneError("xxx' is no number") && reader->GetOutput()->GetNumberOfPoints() == 0);
}

// What other programs write where there is no number, and before the first word.
void TestForeignGrids()
{
  const double nan = std::nan("");
  const double infinity = HUGE_VAL;
  CheckGrid("1.#QNAN -1.#IND 1.#SNAN 1.#QNAN0 1.#IND00 1.#J nan(ind) -nan 7",
    { nan, nan, nan, nan, nan, nan, nan, nan, 7.0 });
  CheckGrid("1.#INF -1.#INF00 7", { infinity, -infinity, 7.0 });
  CheckGrid("nan nan 5 6", { nan, nan, 5.0, 6.0 });
  const std::string head = "\xEF\xBB\xBFncols 2\r\nnrows 1\r\nxllcorner 1000,5\r\nyllcorner 7\r\n"
                           "cellsize 2,5\r\n";
  vtkNew<vtkReliefRasterReader> reader;
  MessageKeeper messages(reader);
  reader->SetFileName((Directory + "grid.asc").c_str());
  WriteText(Directory + "grid.asc", head + "NODATA_value -9999,0\r\n-9999,0 4,5\r\n");
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  CHECK(messages.Silent() && image->GetNumberOfPoints() == 2 && image->GetSpacing()[0] == 2.5);
  CHECK(std::isnan(image->GetScalarComponentAsDouble(0, 0, 0, 0)));
  CHECK(image->GetScalarComponentAsDouble(1, 0, 0, 0) == 4.5);
  vtkDataArray* transform = image->GetFieldData()->GetArray("geo:transform");
  CHECK(transform && transform->GetComponent(0, 0) == 1000.5);
  CHECK(image->GetFieldData()->GetAbstractArray("geo:driver")->GetVariantValue(0).ToString() ==
    "AAIGrid");
  // A projection beside it is known, whether or not GDAL takes the grid for one.
  WriteText(Directory + "grid.prj",
    "GEOGCS[\"GCS_WGS_1984\",DATUM[\"D_WGS_1984\",SPHEROID[\"WGS_1984\",6378137,298.257223563]],"
    "PRIMEM[\"Greenwich\",0],UNIT[\"Degree\",0.0174532925199433]]");
  WriteText(Directory + "grid.asc",
    "\xEF\xBB\xBFncols 2\nnrows 2\nxllcorner 10\nyllcorner -1\ncellsize 1\n1 2\n3 4\n");
  reader->Modified();
  reader->Update();
  CHECK(messages.Silent() && std::abs(reader->GetOutput()->GetSpacing()[0] - 111319.49) < 1.0);
  std::remove((Directory + "grid.prj").c_str());
  WriteText(Directory + "grid.asc",
    "ncols 2\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value null\n1 2\n");
  reader->Modified();
  reader->Update();
  CHECK(messages.OneError("line 6: 'null' is no number, and nodata_value needs one"));
}

void TestLocales()
{
  TestNumbers();
  for (const char* name : { "de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "German_Germany" })
  {
    if (std::setlocale(LC_NUMERIC, name))
    {
      std::cout << "  with a comma: " << name << std::endl;
      TestNumbers();
      std::setlocale(LC_NUMERIC, "C");
      return;
    }
  }
  std::cout << "  no locale with a comma is installed" << std::endl;
}

// A picture of VTK's; its first row is the southern one.
void TestPicture()
{
  vtkNew<vtkImageData> picture;
  picture->SetDimensions(3, 2, 1);
  picture->AllocateScalars(VTK_UNSIGNED_SHORT, 1);
  for (int k = 0; k < 6; ++k)
  {
    picture->GetPointData()->GetScalars()->SetComponent(k, 0, 1000.0 + k);
  }
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(picture);
  writer->SetFileName((Directory + "heights.png").c_str());
  writer->Write();
  vtkNew<vtkReliefRasterReader> reader;
  MessageKeeper messages(reader);
  reader->SetFileName((Directory + "heights.png").c_str());
  reader->SetDataOrigin(7.0, 8.0, 0.0);
  reader->Update();
  CHECK(reader->GetErrorCode() == vtkErrorCode::NoError && messages.Silent());
  vtkImageData* image = reader->GetOutput();
  CHECK(image->GetNumberOfPoints() == 6 && image->GetScalarType() == VTK_UNSIGNED_SHORT);
  CHECK(image->GetScalarComponentAsDouble(0, 0, 0, 0) == 1000.0);
  CHECK(image->GetScalarComponentAsDouble(2, 1, 0, 0) == 1005.0);
  CHECK(image->GetOrigin()[0] == 7.0 && reader->GetMaskOutput()->GetNumberOfPoints() == 6);
  CHECK(vtkObject::GetGlobalWarningDisplay() == 1);
}

// Heights in three bytes.
void TestEncodings()
{
  vtkNew<vtkImageData> picture;
  picture->SetDimensions(2, 1, 1);
  picture->AllocateScalars(VTK_UNSIGNED_CHAR, 4);
  const unsigned char pixels[] = { 130, 7, 64, 255, 1, 2, 3, 0 };
  std::copy_n(pixels, 8, static_cast<unsigned char*>(picture->GetScalarPointer()));
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(picture);
  writer->SetFileName((Directory + "encoded.png").c_str());
  writer->Write();
  vtkNew<vtkReliefRasterReader> reader;
  MessageKeeper messages(reader);
  reader->SetFileName((Directory + "encoded.png").c_str());
  reader->Update();
  CHECK(messages.OneError("3 components; expected 1 (height), or the choice of the encoding"));
  CHECK(reader->GetEncoding() == vtkReliefRasterReader::NO_ENCODING);
  const double expected[] = { 256 * 130 + 7 + 0.25 - 32768,
    0.1 * (65536 * 130 + 256 * 7 + 64) - 1e4 };
  for (int k = 0; k < 2; ++k)
  {
    reader->SetEncoding(k + 1);
    reader->Update();
    vtkImageData* image = reader->GetOutput();
    CHECK(messages.Silent() && image->GetScalarType() == VTK_FLOAT);
    CHECK(image->GetNumberOfPoints() == 2 && reader->GetMaskOutput()->GetNumberOfPoints() == 2);
    CHECK(image->GetScalarComponentAsDouble(0, 0, 0, 0) == static_cast<float>(expected[k]));
    CHECK(std::isnan(image->GetScalarComponentAsDouble(1, 0, 0, 0)));
    CHECK(reader->GetMaskOutput()->GetScalarComponentAsDouble(1, 0, 0, 0) == 0.0);
  }
  reader->SetEncodingToTerrarium();
  reader->SetNoDataFromFile(false);
  reader->SetNoDataValue(expected[0]);
  reader->Update();
  CHECK(std::isnan(reader->GetOutput()->GetScalarComponentAsDouble(0, 0, 0, 0)));
  // One byte is not three.
  picture->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  picture->GetPointData()->GetScalars()->Fill(5.0);
  picture->Modified();
  writer->Write();
  reader->Modified();
  reader->Update();
  CHECK(messages.OneError("heights in three bytes have red, green and blue, and it has no band 2"));
  picture->AllocateScalars(VTK_UNSIGNED_SHORT, 3);
  picture->GetPointData()->GetScalars()->Fill(5.0);
  picture->Modified();
  writer->Write();
  reader->Modified();
  reader->Update();
  CHECK(messages.OneError("its bands are of the type unsigned short"));
}

// A TIFF of 3 x 2 samples, 1 to 6, whose orientation is the given one: what is read begins with the
// lower row.
void TestOrientation()
{
  const auto number = [](unsigned value, int bytes)
  {
    std::string text;
    for (int k = 0; k < bytes; ++k)
    {
      text += static_cast<char>(value >> 8 * k & 255);
    }
    return text;
  };
  const std::vector<std::vector<double>> expected{ { 4, 5, 6, 1, 2, 3 }, { 6, 5, 4, 3, 2, 1 },
    { 3, 2, 1, 6, 5, 4 }, { 1, 2, 3, 4, 5, 6 }, { 3, 6, 2, 5, 1, 4 }, { 6, 3, 5, 2, 4, 1 },
    { 4, 1, 5, 2, 6, 3 }, { 1, 4, 2, 5, 3, 6 } };
  for (unsigned orientation = 1; orientation <= 8; ++orientation)
  {
    const unsigned tags[][2] = { { 256, 3 }, { 257, 2 }, { 258, 8 }, { 259, 1 }, { 262, 1 },
      { 273, 8 }, { 274, orientation }, { 277, 1 }, { 278, 2 }, { 279, 6 } };
    std::string text = "II" + number(42, 2) + number(14, 4) + "\1\2\3\4\5\6" + number(10, 2);
    for (const auto& tag : tags)
    {
      text += number(tag[0], 2) + number(3, 2) + number(1, 4) + number(tag[1], 4);
    }
    WriteText(Directory + "turned.tif", text + number(0, 4));
    vtkNew<vtkReliefRasterReader> reader;
    MessageKeeper messages(reader);
    reader->SetFileName((Directory + "turned.tif").c_str());
    reader->Update();
    vtkImageData* image = reader->GetOutput();
    CHECK(messages.Silent() && image->GetNumberOfPoints() == 6);
    CHECK(image->GetDimensions()[0] == (orientation > 4 ? 2 : 3));
    for (vtkIdType k = 0; k < image->GetNumberOfPoints(); ++k)
    {
      CHECK(
        image->GetPointData()->GetScalars()->GetComponent(k, 0) == expected[orientation - 1][k]);
    }
  }
}

/// A number as a grid may write it: with a point or a comma.
std::string Written(std::mt19937& random, bool comma)
{
  const char* const numbers[] = { "12.5", "-7", "1e3", "+0.25", "nan", "1.#QNAN", "-9999", "3." };
  const char* const commas[] = { "12,5", "-7", "1e3", "+0,25", "nan", "-9999", "3,125", "0,5" };
  return comma ? commas[random() % 8] : numbers[random() % 8];
}

// Parts of a grid are what the whole has there, however its numbers stand in lines and are parted.
void TestParts()
{
  std::mt19937 random(11);
  for (int round = 0; round < 60; ++round)
  {
    const int columns = 1 + static_cast<int>(random() % 40);
    const int rows = 1 + static_cast<int>(random() % 40);
    // Blanks, points that are commas, commas, semicolons; rows in lines, or lines of any length.
    const int kind = round % 4;
    const char* const separators[] = { " ", " ", ",", "; " };
    const bool byRows = round % 3 != 0;
    std::string text = (round % 5 == 0 ? "\xEF\xBB\xBF" : "") + std::string("NCOLS ") +
      std::to_string(columns) + "\r\nnrows " + std::to_string(rows) +
      "\nxllcorner 0\nyllcorner 0\ncellsize 1\nNODATA_value -9999\n";
    for (int k = 0; k < columns * rows; ++k)
    {
      const bool endsRow = (k + 1) % columns == 0;
      text += Written(random, kind == 1) +
        ((byRows ? endsRow : random() % 7 == 0) ? (kind == 2 && !byRows ? ",\n" : "\r\n")
                                                : separators[kind]);
    }
    WriteText(Directory + "parts.asc", text);
    vtkNew<vtkReliefRasterReader> whole;
    MessageKeeper messages(whole);
    whole->SetFileName((Directory + "parts.asc").c_str());
    whole->Update();
    CHECK(whole->GetOutput()->GetNumberOfPoints() == columns * rows);
    for (int k = 0; k < 4; ++k)
    {
      int extent[6] = { static_cast<int>(random() % columns), 0, static_cast<int>(random() % rows),
        0, 0, 0 };
      extent[1] = extent[0] + static_cast<int>(random() % (columns - extent[0]));
      extent[3] = extent[2] + static_cast<int>(random() % (rows - extent[2]));
      vtkNew<vtkReliefRasterReader> reader;
      MessageKeeper partMessages(reader);
      reader->SetFileName((Directory + "parts.asc").c_str());
      reader->UpdateExtent(extent);
      CHECK(partMessages.Silent());
      vtkImageData* part = reader->GetOutput();
      CHECK(std::equal(extent, extent + 6, part->GetExtent()));
      for (int j = extent[2]; j <= part->GetExtent()[3]; ++j)
      {
        for (int i = extent[0]; i <= part->GetExtent()[1]; ++i)
        {
          const double expected = whole->GetOutput()->GetScalarComponentAsDouble(i, j, 0, 0);
          const double found = part->GetScalarComponentAsDouble(i, j, 0, 0);
          CHECK(found == expected || (std::isnan(found) && std::isnan(expected)));
        }
      }
    }
  }
}

// What is wrong with a grid is told of its parts in the same words.
void TestWrongParts()
{
  const std::string head = "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
  const std::pair<const char*, const char*> cases[] = { { "1 2 3\n4 5\n",
                                                          "line 8: the file ends early" },
    { "1 2 3\n4 5 6\n\n7", "line 9: more than 3 x 2 heights" },
    { "1 2 x\n4 5 6", "line 6: 'x' is no number" },
    { "1,2 3\n4 5\n7,5 9.5", "6 heights are announced, 6 or 8 found" },
    { "1,,3\n4,5,6\n", "line 8: the file ends early" } };
  for (const auto& [text, fragment] : cases)
  {
    WriteText(Directory + "wrong.asc", head + text);
    for (const bool part : { false, true })
    {
      vtkNew<vtkReliefRasterReader> reader;
      MessageKeeper messages(reader);
      reader->SetFileName((Directory + "wrong.asc").c_str());
      int extent[6] = { 1, 2, part ? 1 : 0, 1, 0, 0 };
      part ? static_cast<void>(reader->UpdateExtent(extent)) : reader->Update();
      CHECK(messages.OneError(fragment) && reader->GetOutput()->GetNumberOfPoints() == 0);
    }
  }
}

// Of several slices none is taken for the heights.
void TestVolume()
{
  vtkNew<vtkImageData> volume;
  volume->SetDimensions(3, 2, 4);
  volume->AllocateScalars(VTK_FLOAT, 1);
  volume->GetPointData()->GetScalars()->Fill(1.0);
  vtkNew<vtkMetaImageWriter> writer;
  writer->SetInputData(volume);
  writer->SetFileName((Directory + "volume.mha").c_str());
  writer->SetCompression(false);
  writer->Write();
  vtkNew<vtkReliefRasterReader> reader;
  MessageKeeper messages(reader);
  reader->SetFileName((Directory + "volume.mha").c_str());
  reader->Update();
  CHECK(reader->GetErrorCode() == vtkErrorCode::FileFormatError);
  CHECK(messages.OneError("4 slices") && reader->GetOutput()->GetNumberOfPoints() == 0);
}
}

int TestReliefRasterPlain(int argc, char* argv[])
{
  Directory = EmptyDirectory(argc, argv, "TestReliefRasterPlain");
  TestLocales();
  TestCommas();
  TestForeignGrids();
  TestPicture();
  TestEncodings();
  TestOrientation();
  TestParts();
  TestWrongParts();
  TestVolume();
  return Failures;
}
