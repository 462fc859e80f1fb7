// SPDX-License-Identifier: BSD-3-Clause
// Files that cannot be read: one message that names the file, a code, and empty outputs.
#include "vtkReliefRasterReader.h"

#include "RasterTestUtilities.h"

#include "vtkCallbackCommand.h"
#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkNew.h"

namespace
{
int Failures = 0;
std::string Directory;

void Refused(
  const std::string& name, unsigned long code, const std::string& text,
  const std::function<void(vtkReliefRasterReader*)>& set = [](vtkReliefRasterReader*) {})
{
  std::cout << "  " << name << std::endl;
  vtkNew<vtkReliefRasterReader> reader;
  MessageKeeper messages(reader);
  MessageKeeper pipeline(reader->GetExecutive());
  reader->SetFileName(name.c_str());
  set(reader);
  reader->Update();
  CHECK(reader->GetErrorCode() == code);
  CHECK(messages.OneError(EndOfName(name)));
  CHECK(reader->GetOutput()->GetNumberOfPoints() == 0);
  CHECK(reader->GetMaskOutput()->GetNumberOfPoints() == 0);
  reader->Modified();
  reader->Update();
  CHECK(messages.OneError(text) && pipeline.Silent());
}

void TestFiles()
{
  Refused("", vtkErrorCode::NoFileNameError, "no file name");
  Refused(Directory + "none.tif", vtkErrorCode::FileNotFoundError, "does not exist");
  Refused(Directory, vtkErrorCode::CannotOpenFileError, "directory");
  WriteText(Directory + "empty.tif", "");
  Refused(Directory + "empty.tif", vtkErrorCode::PrematureEndOfFileError, "empty");
  WriteText(Directory + "text.tif", "Once upon a time");
  Refused(Directory + "text.tif", vtkErrorCode::UnrecognizedFileTypeError, "no format");

  const std::string grid = "ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
  WriteText(Directory + "word.asc", grid + "1 2\n3 four\n");
  Refused(Directory + "word.asc", vtkErrorCode::FileFormatError, "line 7: 'four' is no number");
  WriteText(Directory + "short.asc", grid + "1 2\n");
  Refused(Directory + "short.asc", vtkErrorCode::PrematureEndOfFileError, "ends early");
}

void TestRasters()
{
  const std::string name = Directory + "raster.tif";
  WriteRaster(name, TestRaster());
  Refused(name, vtkErrorCode::FileFormatError, "no band 2, only 1",
    [](vtkReliefRasterReader* reader) { reader->SetBand(2); });
  Refused(name, vtkErrorCode::FileFormatError,
    "degrees are for files without a coordinate reference system, and this one has WGS 84 / UTM "
    "zone 32N",
    [](vtkReliefRasterReader* reader) { reader->DegreesOn(); });

  TestRaster sheared;
  sheared.Transform[2] = 5.0;
  WriteRaster(name, sheared);
  Refused(name, vtkErrorCode::FileFormatError, "gdalwarp -dstnodata -9999 makes");
  // At right angles on the map, of degrees, but not on the ground.
  TestRaster degrees;
  degrees.Epsg = 4326;
  degrees.Transform = { 10.0, 0.01, 0.005, 60.0, 0.005, -0.01 };
  WriteRaster(name, degrees);
  Refused(name, vtkErrorCode::FileFormatError, "right angles on the ground");

  TestRaster colors;
  colors.Type = GDT_Byte;
  colors.Bands = 3;
  colors.More = [](GDALDataset* file)
  {
    file->GetRasterBand(1)->SetColorInterpretation(GCI_RedBand);
    file->GetRasterBand(2)->SetColorInterpretation(GCI_GreenBand);
    file->GetRasterBand(3)->SetColorInterpretation(GCI_BlueBand);
  };
  WriteRaster(name, colors);
  Refused(name, vtkErrorCode::FileFormatError, "3 components; expected 1 (height)");

  TestRaster pole;
  pole.Epsg = 4326;
  pole.Transform = { 10.0, 10.0, 0.0, 200.0, 0.0, -10.0 };
  WriteRaster(name, pole);
  Refused(name, vtkErrorCode::FileFormatError, "beyond the pole");

  // A file that ends early.
  WriteRaster(name, TestRaster());
  const auto size = std::filesystem::file_size(name);
  std::filesystem::resize_file(name, size - 30);
  vtkNew<vtkReliefRasterReader> reader;
  MessageKeeper messages(reader);
  reader->SetFileName(name.c_str());
  reader->Update();
  CHECK(reader->GetErrorCode() != vtkErrorCode::NoError && messages.OneError(name));
  CHECK(reader->GetOutput()->GetNumberOfPoints() == 0);
}

// Files that are no rasters: what they are, or what lacks.
void TestOtherContent()
{
  const unsigned long code = vtkErrorCode::UnrecognizedFileTypeError;
  const auto refuse =
    [code](const std::string& name, const std::string& content, const std::string& text)
  {
    WriteText(Directory + name, content);
    Refused(Directory + name, code, text);
  };
  const std::string samples(400, '\1');
  refuse("raw.flt", samples, "its header is missing: raw.hdr is expected beside it");
  refuse("raw.bil", samples, "raw.hdr is expected");
  refuse("raw.r16", samples, "samples alone; an ENVI header");
  refuse("cloud.las", "LASF" + samples, "no raster but a point cloud");
  refuse("answer.tif", "{\"status\": \"denied\"}", "no raster but JSON");
  refuse("page.tif", "\n<!DOCTYPE html><html></html>", "no raster but a web page");
  refuse("mesh.ply", "ply\nformat ascii 1.0\n", "a mesh");
  refuse("roads.shp", std::string("\0\0\x27\x0a", 4) + samples, "vectors");
  refuse("packed.tif", "\x1f\x8b" + samples, "compressed; unpack it");

  // With a header that tells what it is, it is read.
  WriteText(Directory + "good.r16", std::string(2 * 6, '\1'));
  WriteText(Directory + "good.hdr",
    "ENVI\nsamples = 3\nlines = 2\nbands = 1\ndata type = 2\nbyte order = 0\n");
  vtkNew<vtkReliefRasterReader> reader;
  MessageKeeper messages(reader);
  reader->SetFileName((Directory + "good.r16").c_str());
  reader->Update();
  CHECK(reader->GetErrorCode() == vtkErrorCode::NoError && messages.Silent());
  CHECK(reader->GetOutput()->GetScalarComponentAsDouble(2, 1, 0, 0) == 257.0);
}

// However long the path is, a message can be read.
void TestLongNames()
{
  std::string name = Directory;
  for (int k = 0; k < 6; ++k)
  {
    name += std::string(200, static_cast<char>('a' + k)) + "/";
  }
  std::filesystem::create_directories(name);
  name += "heights.tif";
  WriteText(name, "Once upon a time");
  vtkNew<vtkReliefRasterReader> reader;
  std::string said;
  const auto keep = [](vtkObject*, unsigned long, void* said, void* text)
  { *static_cast<std::string*>(said) = static_cast<const char*>(text); };
  vtkNew<vtkCallbackCommand> command;
  command->SetCallback(keep);
  command->SetClientData(&said);
  reader->AddObserver(vtkCommand::ErrorEvent, command);
  reader->SetFileName(name.c_str());
  reader->Update();
  const std::size_t begin = said.find("Cannot read");
  CHECK(begin != std::string::npos && said.size() - begin <= 220);
  CHECK(said.find("heights.tif\": no format") != std::string::npos);
}

// More than the limit, and an observer that ends it.
void TestLimitAndAbort()
{
  const std::string name = Directory + "large.asc";
  std::string text = "ncols 600\nnrows 600\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
  for (int k = 0; k < 600 * 600; ++k)
  {
    text += std::to_string(k % 7) + (k % 600 == 599 ? "\n" : " ");
  }
  WriteText(name, text);
  Refused(name, vtkErrorCode::FileFormatError, "MemoryLimit allows 1 MiB",
    [](vtkReliefRasterReader* reader) { reader->SetMemoryLimit(1024); });
  Refused(name, vtkErrorCode::FileFormatError, "MemoryLimit allows 1 KiB",
    [](vtkReliefRasterReader* reader) { reader->SetMemoryLimit(1); });

  // Of heights in feet there is a second array of floats, as of scaled integers: 9 and 7 MB here.
  const std::string feet = Directory + "feet.tif";
  for (const GDALDataType type : { GDT_Float32, GDT_Int16 })
  {
    GDALDataset* file = GetGDALDriverManager()->GetDriverByName("GTiff")->Create(
      feet.c_str(), 1000, 1000, 1, type, nullptr);
    file->GetRasterBand(1)->SetUnitType("ft");
    file->GetRasterBand(1)->SetScale(0.5);
    CHECK(file->GetRasterBand(1)->Fill(1.0) == CE_None);
    GDALClose(file);
    const vtkTypeInt64 needed = (type == GDT_Float32 ? 9000000 : 7000000) / 1024;
    Refused(feet, vtkErrorCode::FileFormatError, "MemoryLimit allows",
      [needed](vtkReliefRasterReader* reader) { reader->SetMemoryLimit(needed - 1); });
    vtkNew<vtkReliefRasterReader> enough;
    enough->SetFileName(feet.c_str());
    enough->SetMemoryLimit(needed + 1);
    enough->Update();
    CHECK(enough->GetErrorCode() == vtkErrorCode::NoError);
  }

  vtkNew<vtkReliefRasterReader> reader;
  MessageKeeper messages(reader);
  reader->SetFileName(name.c_str());
  {
    ProgressKeeper progress(reader);
    progress.StopAbove = 0.2;
    reader->Update();
    CHECK(reader->GetErrorCode() == vtkErrorCode::UserError && messages.Silent());
    CHECK(reader->GetOutput()->GetNumberOfPoints() == 0);
    reader->AbortExecuteOff();
  }
  reader->Modified();
  reader->Update();
  CHECK(reader->GetErrorCode() == vtkErrorCode::NoError);
  CHECK(reader->GetOutput()->GetNumberOfPoints() == 600 * 600);
}
}

int TestReliefRasterReaderInvalid(int argc, char* argv[])
{
  Directory = EmptyDirectory(argc, argv, "TestReliefRasterReaderInvalid");
  CPLSetErrorHandler(CPLQuietErrorHandler);
  TestFiles();
  TestRasters();
  TestOtherContent();
  TestLongNames();
  TestLimitAndAbort();
  return Failures;
}
