// SPDX-License-Identifier: BSD-3-Clause
// Parts of a raster are what the whole has there, and the filter shades heights that are read as
// they are needed as it shades those in memory. RELIEF_SEED repeats a run.
#include "vtkReliefRasterReader.h"

#include "RasterReadingUtilities.h"
#include "ReliefLongRunTestUtilities.h"

#include "vtkImageReliefShading.h"
#include "vtkPointData.h"
#include "vtkReliefScene.h"

#include <cstring>
#include <filesystem>
#include <fstream>
#include <random>

namespace
{
namespace fs = std::filesystem;

constexpr int Columns = 333;
constexpr int Rows = 271;

// Hills by GDAL alone, of any type, some of them without data, the southern row first if asked for.
std::string WriteHills(GDALDataType type, bool southUp, double noData, double scale)
{
  GDALAllRegister();
  const std::string name = Directory + "hills.tif";
  fs::remove(name + ".bounds.tif");
  GDALDataset* file = GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
    name.c_str(), Columns, Rows, 1, type, nullptr);
  std::array<double, 6> transform{ 500000.0, 30.0, 0.0, 5000000.0, 0.0, southUp ? 30.0 : -30.0 };
  file->SetGeoTransform(transform.data());
  OGRSpatialReference crs;
  crs.importFromEPSG(32632);
  file->SetSpatialRef(&crs);
  GDALRasterBand* band = file->GetRasterBand(1);
  band->SetNoDataValue(noData);
  band->SetScale(scale);
  std::vector<double> values;
  for (int row = 0; row < Rows; ++row)
  {
    for (int column = 0; column < Columns; ++column)
    {
      const double height =
        std::round(900.0 + 300.0 * std::sin(0.03 * column) * std::cos(0.05 * row));
      values.push_back(column > 200 && column < 210 && row > 90 && row < 120 ? noData : height);
    }
  }
  const CPLErr error = band->RasterIO(
    GF_Write, 0, 0, Columns, Rows, values.data(), Columns, Rows, GDT_Float64, 0, 0, nullptr);
  CHECK(error == CE_None);
  GDALClose(file);
  return name;
}

// An extent's bytes of an image of one component or more.
std::string BytesOf(vtkImageData* image, const int extent[6])
{
  const std::size_t pixel =
    static_cast<std::size_t>(image->GetScalarSize()) * image->GetNumberOfScalarComponents();
  std::string bytes;
  for (int j = extent[2]; j <= extent[3]; ++j)
  {
    bytes.append(static_cast<const char*>(image->GetScalarPointer(extent[0], j, 0)),
      pixel * (extent[1] - extent[0] + 1));
  }
  return bytes;
}

void TestParts(std::mt19937& random)
{
  for (const GDALDataType type : { GDT_Float32, GDT_Int16, GDT_Float64 })
  {
    for (const bool southUp : { false, true })
    {
      const std::string name = WriteHills(type, southUp, -9999.0, southUp ? 0.5 : 1.0);
      vtkNew<vtkReliefRasterReader> whole;
      whole->SetFileName(name.c_str());
      whole->Update();
      for (int k = 0; k < 8; ++k)
      {
        vtkNew<vtkReliefRasterReader> part;
        MessageKeeper messages(part);
        part->SetFileName(name.c_str());
        int extent[6] = { static_cast<int>(random() % Columns), 0,
          static_cast<int>(random() % Rows), 0, 0, 0 };
        extent[1] = extent[0] + static_cast<int>(random() % (Columns - extent[0]));
        extent[3] = extent[2] + static_cast<int>(random() % (Rows - extent[2]));
        part->UpdateExtent(extent);
        CHECK(messages.Silent());
        for (int port = 0; port < 2; ++port)
        {
          CHECK(std::equal(extent, extent + 6, part->GetOutput(port)->GetExtent()));
          CHECK(BytesOf(part->GetOutput(port), extent) == BytesOf(whole->GetOutput(port), extent));
        }
        CHECK(part->GetOutput()->GetFieldData()->GetArray("geo:transform"));
      }
    }
  }
}

void SetUp(vtkImageReliefShading* shading, vtkReliefRasterReader* reader)
{
  shading->SetInputConnection(reader->GetOutputPort());
  shading->GetScene()->AddSun(300.0, 12.0);
  shading->GenerateIlluminationOn();
}

void TestAsNeeded(std::mt19937& random)
{
  for (const GDALDataType type : { GDT_Float32, GDT_Int16 })
  {
    const std::string name = WriteHills(type, false, -9999.0, 1.0);
    vtkNew<vtkReliefRasterReader> inMemory;
    inMemory->SetFileName(name.c_str());
    vtkNew<vtkImageReliefShading> whole;
    SetUp(whole, inMemory);
    whole->Update();
    for (int run = 0; run < 2; ++run) // the second finds the first one's bounds
    {
      vtkNew<vtkReliefRasterReader> reader;
      MessageKeeper messages(reader);
      reader->SetFileName(name.c_str());
      reader->ReadAsNeededOn();
      vtkNew<vtkImageReliefShading> shading;
      SetUp(shading, reader);
      if (run == 1)
      {
        shading->SetHeightRange(500.0, 1300.0); // which is not needed, and changes nothing
      }
      for (int k = 0; k < 6; ++k)
      {
        int extent[6] = { static_cast<int>(random() % Columns), 0,
          static_cast<int>(random() % Rows), 0, 0, 0 };
        extent[1] = extent[0] + static_cast<int>(random() % (Columns - extent[0]));
        extent[3] = extent[2] + static_cast<int>(random() % (Rows - extent[2]));
        CHECK(shading->EstimateMemory(extent) > 0.0);
        shading->Modified();
        shading->UpdateExtent(extent);
        CHECK(BytesOf(shading->GetOutput(), extent) == BytesOf(whole->GetOutput(), extent));
      }
      CHECK(messages.Silent());
      CHECK(fs::exists(name + ".bounds.tif"));
      CHECK(shading->GetOutput()->GetFieldData()->GetArray("geo:transform"));
      // It is slow to look at, and right.
      vtkDataArray* heights = reader->GetOutput()->GetPointData()->GetScalars();
      for (int k = 0; k < 5; ++k)
      {
        const vtkIdType at = random() % (vtkIdType(Columns) * Rows);
        const double expected = inMemory->GetOutput()->GetPointData()->GetScalars()->GetTuple1(at);
        const double found = heights->GetTuple1(at);
        CHECK(found == expected || (std::isnan(found) && std::isnan(expected)));
      }
    }
  }
}

void TestWholeFormats()
{
  std::ofstream(Directory + "grid.mha")
    << "ObjectType = Image\nNDims = 2\nDimSize = 2 2\nElementType = MET_UCHAR\n"
    << "ElementDataFile = LOCAL\n1234";
  vtkNew<vtkReliefRasterReader> reader;
  MessageKeeper messages(reader);
  reader->SetFileName((Directory + "grid.mha").c_str());
  reader->ReadAsNeededOn();
  reader->Update();
  CHECK(messages.OneError("read as a whole"));
  CHECK(reader->GetOutput()->GetNumberOfPoints() == 0);
}
}

int TestReliefRasterReaderParts(int argc, char* argv[])
{
  Directory = EmptyDirectory(argc, argv, "TestReliefRasterReaderParts");
  std::mt19937 random(ChooseSeed());
  TestParts(random);
  TestAsNeeded(random);
  TestWholeFormats();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
