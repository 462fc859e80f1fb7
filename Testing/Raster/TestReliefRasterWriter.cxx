// SPDX-License-Identifier: BSD-3-Clause
// A raster is read, shaded and written back in its place; what cannot be written leaves nothing.
#include "vtkReliefRasterWriter.h"

#include "RasterTestUtilities.h"

#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkImageReliefShading.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefRasterReader.h"
#include "vtkReliefScene.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>

namespace
{
int Failures = 0;
std::string Directory;

/// What GDAL alone says about a file.
struct Found
{
  explicit Found(const std::string& name)
    : File(GDALDataset::Open(name.c_str(), GDAL_OF_RASTER))
  {
    if (this->File)
    {
      this->File->GetGeoTransform(this->Transform.data());
    }
  }
  ~Found() { GDALClose(this->File); }
  Found(const Found&) = delete;
  void operator=(const Found&) = delete;

  std::string Code() const
  {
    const OGRSpatialReference* crs = this->File->GetSpatialRef();
    const char* code = crs ? crs->GetAuthorityCode(nullptr) : nullptr;
    return code ? code : "";
  }
  double At(int band, int row, int column) const
  {
    double value = 0.0;
    const CPLErr error = this->File->GetRasterBand(band)->RasterIO(
      GF_Read, column, row, 1, 1, &value, 1, 1, GDT_Float64, 0, 0, nullptr);
    return error == CE_None ? value : std::nan("");
  }

  GDALDataset* File;
  std::array<double, 6> Transform{};
};

/// Shades a raster into a file. Returns the writer's code.
unsigned long Shade(const TestRaster& raster, const std::string& name,
  const std::function<void(vtkImageReliefShading*, vtkReliefRasterWriter*)>& set)
{
  WriteRaster(Directory + "in.tif", raster);
  vtkNew<vtkReliefRasterReader> heights;
  heights->SetFileName((Directory + "in.tif").c_str());
  vtkNew<vtkImageReliefShading> shading;
  shading->SetInputConnection(heights->GetOutputPort());
  vtkNew<vtkReliefRasterWriter> writer;
  writer->SetInputConnection(shading->GetOutputPort());
  writer->SetFileName((Directory + name).c_str());
  set(shading, writer);
  MessageKeeper messages(writer);
  writer->Write();
  CHECK(messages.Silent());
  return writer->GetErrorCode();
}

// The way that people take: the filter passes on where the heights lie.
void TestInPlace()
{
  TestRaster raster;
  raster.Type = GDT_Int16;
  raster.More = [](GDALDataset* file) { file->GetRasterBand(1)->SetNoDataValue(12.0); };
  CHECK(Shade(raster, "out.tif",
          [](vtkImageReliefShading* shading, vtkReliefRasterWriter*)
          { shading->SetOutputScalarTypeToUnsignedChar(); }) == vtkErrorCode::NoError);
  {
    const Found found(Directory + "out.tif");
    CHECK(found.File && found.Transform == raster.Transform && found.Code() == "32632");
    CHECK(found.File && found.File->GetRasterCount() == 4);
    CHECK(found.At(4, 1, 2) == 0.0 && found.At(4, 1, 3) == 255.0);
    CHECK(found.File->GetRasterBand(4)->GetColorInterpretation() == GCI_AlphaBand);
  }
  // A layer, in floating point, and a raster whose first row is the southern one.
  raster.Transform = { 500000.0, 30.0, 0.0, 4000000.0, 0.0, 20.0 };
  CHECK(Shade(raster, "layer.tif",
          [](vtkImageReliefShading* shading, vtkReliefRasterWriter* writer)
          {
            shading->GenerateIlluminationOn();
            writer->SetArrayName("Illumination");
          }) == vtkErrorCode::NoError);
  {
    const Found found(Directory + "layer.tif");
    CHECK(found.Transform == raster.Transform && found.File->GetRasterCount() == 1);
    CHECK(std::isnan(found.At(1, 1, 2)) && found.At(1, 1, 3) >= 0.0);
    CHECK(found.File->GetRasterBand(1)->GetRasterDataType() == GDT_Float32);
  }
  CHECK(Shade(raster, "out.png",
          [](vtkImageReliefShading* shading, vtkReliefRasterWriter*)
          { shading->SetOutputScalarTypeToUnsignedChar(); }) == vtkErrorCode::NoError);
  CHECK(Found(Directory + "out.png").File->GetRasterCount() == 4);
}

std::string Structure(const Found& found, const char* item)
{
  const char* value = found.File->GetMetadataItem(item, "IMAGE_STRUCTURE");
  return value ? value : "";
}

// Which components there are, and how they are stored.
void TestForms()
{
  using Writer = vtkReliefRasterWriter;
  TestRaster raster;
  raster.Type = GDT_Int16;
  const auto shade = [&raster](int bands, const std::function<void(Writer*)>& set)
  {
    CHECK(Shade(raster, "form.tif",
            [&](vtkImageReliefShading* shading, Writer* writer)
            {
              shading->SetOutputScalarTypeToUnsignedChar();
              writer->SetBands(bands);
              set(writer);
            }) == vtkErrorCode::NoError);
  };
  const auto nothing = [](Writer*) {};
  shade(Writer::GIVEN, nothing);
  double values[4][5];
  {
    const Found whole(Directory + "form.tif");
    for (int k = 0; k < 20; ++k)
    {
      values[k / 5][k % 5] = whole.At(1, k / 5, k % 5);
    }
    CHECK(Structure(whole, "COMPRESSION").empty() && whole.File->GetRasterCount() == 4);
  }
  const auto expect = [&values](int count)
  {
    const Found found(Directory + "form.tif");
    CHECK(found.File->GetRasterCount() == count);
    for (int k = 0; k < 20; ++k)
    {
      CHECK(found.At(1, k / 5, k % 5) == values[k / 5][k % 5]);
    }
  };
  shade(Writer::AUTO, nothing);
  expect(1);
  shade(Writer::GREY, nothing);
  expect(1);
  shade(Writer::RGB, nothing);
  expect(3);
  shade(Writer::RGBA, nothing);
  expect(4);

  // Compression and what else GDAL is told.
  const char* const names[] = { "", "", "DEFLATE", "ZSTD", "LZW" };
  for (const int compression : { Writer::NO_COMPRESSION, Writer::DEFLATE, Writer::LZW })
  {
    shade(Writer::AUTO, [=](Writer* writer) { writer->SetCompression(compression); });
    expect(1);
    CHECK(Structure(Found(Directory + "form.tif"), "COMPRESSION") == names[compression]);
  }
  shade(Writer::RGBA,
    [](Writer* writer)
    {
      writer->SetCompressionToDeflate();
      writer->AddCreationOption("COMPRESS=LZW");
      writer->AddCreationOption("TILED=YES");
      writer->AddCreationOption(nullptr);
      CHECK(writer->GetNumberOfCreationOptions() == 2);
      CHECK(std::string(writer->GetCreationOption(1)) == "TILED=YES");
      CHECK(!writer->GetCreationOption(2) && !writer->GetCreationOption(-1));
    });
  expect(4);
  {
    const Found found(Directory + "form.tif");
    int block[2];
    found.File->GetRasterBand(1)->GetBlockSize(block, block + 1);
    CHECK(Structure(found, "COMPRESSION") == "LZW" && block[0] == 256 && block[1] == 256);
  }
  shade(Writer::AUTO, [](Writer* writer) { writer->OverviewsOn(); });
  expect(1); // too small for any
  if (GDALGetDriverByName("COG"))
  {
    shade(Writer::AUTO, [](Writer* writer) { writer->CloudOptimizedOn(); });
    expect(1);
    CHECK(Structure(Found(Directory + "form.tif"), "LAYOUT") == "COG");
  }

  // Where data lack, alpha stays; a colour does.
  raster.More = [](GDALDataset* file) { file->GetRasterBand(1)->SetNoDataValue(12.0); };
  shade(Writer::AUTO, nothing);
  const Found two(Directory + "form.tif");
  CHECK(two.File->GetRasterCount() == 2 && two.At(2, 1, 2) == 0.0 && two.At(2, 1, 3) == 255.0);
  CHECK(two.File->GetRasterBand(2)->GetColorInterpretation() == GCI_AlphaBand);
  CHECK(Shade(raster, "coloured.tif",
          [](vtkImageReliefShading* shading, Writer* writer)
          {
            shading->GetScene()->GetMaterial()->SetDiffuseColor(1.0, 0.9, 0.8);
            writer->SetBandsToAuto();
          }) == vtkErrorCode::NoError);
  CHECK(Found(Directory + "coloured.tif").File->GetRasterCount() == 4);
}

// What is no form of a file leaves none.
void TestRefusedForms()
{
  const std::string folder = Directory + "forms/";
  std::filesystem::create_directory(folder);
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  image->GetPointData()->GetScalars()->Fill(9.0);
  image->GetPointData()->GetScalars()->SetComponent(4, 1, 8.0);
  const auto refused = [&](const char* text, const std::function<void(vtkReliefRasterWriter*)>& set)
  {
    vtkNew<vtkReliefRasterWriter> writer;
    MessageKeeper messages(writer);
    writer->SetInputData(image);
    writer->SetFileName((folder + "o.tif").c_str());
    set(writer);
    writer->Write();
    CHECK(writer->GetErrorCode() == vtkErrorCode::FileFormatError && messages.OneError(text));
    CHECK(CountFiles(folder) == 0);
  };
  refused("not grey", [](vtkReliefRasterWriter* writer) { writer->SetBandsToGrey(); });
  refused("FOO", [](vtkReliefRasterWriter* writer) { writer->AddCreationOption("FOO=BAR"); });
  refused("NAME=VALUE", [](vtkReliefRasterWriter* writer) { writer->AddCreationOption("TILED"); });
}

// Parts and other resolutions come where they belong; an image without field data takes those of
// input 1.
void TestParts()
{
  WriteRaster(Directory + "in.tif", TestRaster());
  vtkNew<vtkReliefRasterReader> heights;
  heights->SetFileName((Directory + "in.tif").c_str());
  heights->Update();
  const auto write = [&](vtkImageData* image)
  {
    vtkNew<vtkReliefRasterWriter> writer;
    writer->SetInputData(image);
    writer->SetReferenceConnection(heights->GetOutputPort());
    writer->SetFileName((Directory + "part.tif").c_str());
    writer->Write();
    return writer->GetErrorCode();
  };
  vtkNew<vtkImageData> part;
  part->SetExtent(1, 3, 1, 2, 0, 0);
  part->SetSpacing(30.0, 20.0, 1.0);
  part->AllocateScalars(VTK_FLOAT, 1);
  part->GetPointData()->GetScalars()->Fill(1.0);
  CHECK(write(part) == vtkErrorCode::NoError);
  CHECK((Found(Directory + "part.tif").Transform ==
    std::array<double, 6>{ 500030.0, 30.0, 0.0, 4999980.0, 0.0, -20.0 }));

  // The frame may begin elsewhere: the field data know where.
  heights->SetDataOrigin(100.0, -40.0, 0.0);
  heights->Update();
  CHECK(write(heights->GetOutput()) == vtkErrorCode::NoError);
  CHECK(Found(Directory + "part.tif").Transform == TestRaster().Transform);
  heights->SetDataOrigin(0.0, 0.0, 0.0);

  // A reference that could not be read is none to be left out in silence.
  vtkNew<vtkReliefRasterReader> absent;
  MessageKeeper absentMessages(absent);
  absent->SetFileName((Directory + "absent.tif").c_str());
  vtkNew<vtkReliefRasterWriter> astray;
  MessageKeeper messages(astray);
  astray->SetInputData(part);
  astray->SetReferenceConnection(absent->GetOutputPort());
  astray->SetFileName((Directory + "astray.tif").c_str());
  astray->Write();
  CHECK(astray->GetErrorCode() != vtkErrorCode::NoError && messages.OneError("tell its place"));
  CHECK(!vtksys::SystemTools::FileExists(Directory + "astray.tif"));

  // Twice as fine: samples lie half a sample nearer to the edges.
  vtkNew<vtkImageData> fine;
  fine->SetDimensions(10, 8, 1);
  fine->SetSpacing(15.0, 10.0, 1.0);
  fine->SetOrigin(-7.5, -5.0, 0.0);
  fine->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  fine->GetPointData()->GetScalars()->Fill(1.0);
  CHECK(write(fine) == vtkErrorCode::NoError);
  CHECK((Found(Directory + "part.tif").Transform ==
    std::array<double, 6>{ 500000.0, 15.0, 0.0, 5000000.0, 0.0, -10.0 }));
}

void Refused(vtkImageData* image, const std::string& name, unsigned long code,
  const std::string& text, const char* array = nullptr)
{
  std::cout << "  " << name << std::endl;
  vtkNew<vtkReliefRasterWriter> writer;
  MessageKeeper messages(writer);
  MessageKeeper pipeline(writer->GetExecutive());
  writer->SetInputData(image);
  writer->SetFileName(name.c_str());
  writer->SetArrayName(array);
  writer->Write();
  CHECK(writer->GetErrorCode() == code && messages.OneError(EndOfName(name)));
  writer->Write();
  CHECK(messages.OneError(text) && pipeline.Silent());
}

// A part of a turned raster, and the same field twice as fine.
void TestTurnedParts()
{
  TestRaster raster;
  const double c = 0.8;
  const double s = 0.6;
  raster.Transform = { 500000.0, 30.0 * c, -20.0 * s, 5000000.0, -30.0 * s, -20.0 * c };
  WriteRaster(Directory + "in.tif", raster);
  vtkNew<vtkReliefRasterReader> heights;
  heights->SetFileName((Directory + "in.tif").c_str());
  heights->SetDataOrigin(100.0, -40.0, 0.0);
  heights->Update();
  const double* direction = heights->GetOutput()->GetDirectionMatrix()->GetData();
  vtkNew<vtkImageData> part; // without the first column and row
  part->SetDimensions(4, 3, 1);
  part->SetSpacing(30.0, 20.0, 1.0);
  part->SetDirectionMatrix(direction);
  part->SetOrigin(100.0 + 30.0 * direction[0], -40.0 + 30.0 * direction[3], 0.0);
  part->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  part->GetPointData()->GetScalars()->Fill(1.0);
  vtkNew<vtkReliefRasterWriter> writer;
  MessageKeeper messages(writer);
  writer->SetInputData(part);
  writer->SetReferenceConnection(heights->GetOutputPort());
  writer->SetFileName((Directory + "part.tif").c_str());
  writer->Write();
  CHECK(writer->GetErrorCode() == vtkErrorCode::NoError && messages.Silent());
  // The corner of the second column and the second row of the file.
  const std::array<double, 6> expected = { raster.Transform[0] + 30.0 * c - 20.0 * s, 30.0 * c,
    -20.0 * s, raster.Transform[3] - 30.0 * s - 20.0 * c, -30.0 * s, -20.0 * c };
  const std::array<double, 6> found = Found(Directory + "part.tif").Transform;
  for (int k = 0; k < 6; ++k)
  {
    CHECK(std::abs(found[k] - expected[k]) < 1e-6);
  }
}

// An image may hold the named layer alone.
void TestNoScalars()
{
  vtkNew<vtkFloatArray> layer;
  layer->SetName("layer");
  layer->SetNumberOfTuples(6);
  layer->Fill(7.0);
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 2, 1);
  image->GetPointData()->AddArray(layer);
  vtkNew<vtkReliefRasterWriter> writer;
  MessageKeeper messages(writer);
  writer->SetInputData(image);
  writer->SetArrayName("layer");
  writer->SetFileName((Directory + "alone.tif").c_str());
  writer->Write();
  CHECK(writer->GetErrorCode() == vtkErrorCode::NoError && messages.Silent());
  CHECK(Found(Directory + "alone.tif").At(1, 1, 2) == 7.0);
}

void TestInvalid()
{
  WriteRaster(Directory + "in.tif", TestRaster());
  vtkNew<vtkReliefRasterReader> heights;
  heights->SetFileName((Directory + "in.tif").c_str());
  heights->Update();
  vtkImageData* good = heights->GetOutput();
  const std::string folder = Directory + "refused/";
  std::filesystem::create_directory(folder);
  std::filesystem::create_directory(folder + "folder.tif");
  const unsigned long place = vtkErrorCode::CannotOpenFileError;
  Refused(good, "", vtkErrorCode::NoFileNameError, "no file name");
  Refused(good, folder + "o.exr", vtkErrorCode::UnrecognizedFileTypeError, "vtkOpenImageIOWriter");
  Refused(good, folder + "o.png", vtkErrorCode::FileFormatError, "type float");
  Refused(good, folder + "none/o.tif", place, "no directory");
  Refused(good, folder + "folder.tif", place, "not a file");
  vtkNew<vtkImageData> empty;
  Refused(empty, folder + "o.tif", vtkErrorCode::UnknownError, "empty");
  vtkNew<vtkImageData> wide;
  wide->SetDimensions(40, 40, 1);
  wide->SetSpacing(30.0, 20.0, 1.0);
  wide->AllocateScalars(VTK_FLOAT, 1);
  wide->GetFieldData()->PassData(good->GetFieldData());
  Refused(wide, folder + "o.tif", vtkErrorCode::FileFormatError, "beyond the raster");
  // Field data that are no place.
  for (const std::array<double, 6>& transform :
    { std::array<double, 6>{}, { 1e308, 1e308, 1e308, 1e308, 1e308, 1e308 },
      { 0.0, 30.0, 60.0, 0.0, 10.0, 20.0 }, { 1e40, 30.0, 0.0, 0.0, 0.0, -30.0 } })
  {
    vtkNew<vtkImageData> astray;
    astray->DeepCopy(good);
    std::copy(transform.begin(), transform.end(),
      static_cast<double*>(astray->GetFieldData()->GetArray("geo:transform")->GetVoidPointer(0)));
    Refused(astray, folder + "o.tif", vtkErrorCode::FileFormatError, "no place on a map");
  }
  vtkNew<vtkImageData> turned;
  turned->ShallowCopy(good);
  turned->SetDirectionMatrix(0, -1, 0, 1, 0, 0, 0, 0, 1);
  Refused(turned, folder + "o.tif", vtkErrorCode::FileFormatError, "turned against");
  // An array that is shorter than the image.
  vtkNew<vtkImageData> cut;
  cut->ShallowCopy(good);
  vtkNew<vtkFloatArray> few;
  few->SetName("few");
  few->SetNumberOfTuples(3);
  few->Fill(1.0);
  cut->GetPointData()->AddArray(few);
  Refused(cut, folder + "o.tif", vtkErrorCode::UnknownError, "\"few\" has fewer", "few");
  Refused(cut, folder + "o.tif", vtkErrorCode::UnknownError, "no array \"none\"", "none");
  CHECK(CountFiles(folder) == 1);

  // An observer stops it; the old file stays.
  WriteText(folder + "old.tif", "before");
  vtkNew<vtkReliefRasterWriter> writer;
  writer->SetInputData(good);
  writer->SetFileName((folder + "old.tif").c_str());
  ProgressKeeper progress(writer);
  progress.StopAbove = -1.0;
  writer->Write();
  CHECK(writer->GetErrorCode() == vtkErrorCode::UserError);
  CHECK(FileText(folder + "old.tif") == "before" && CountFiles(folder) == 2);
}
}

int TestReliefRasterWriter(int argc, char* argv[])
{
  Directory = EmptyDirectory(argc, argv, "TestReliefRasterWriter");
  TestInPlace();
  TestForms();
  TestRefusedForms();
  TestParts();
  TestTurnedParts();
  TestNoScalars();
  TestInvalid();
  return Failures;
}
