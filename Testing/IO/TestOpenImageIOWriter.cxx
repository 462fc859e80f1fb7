// SPDX-License-Identifier: BSD-3-Clause
// vtkOpenImageIOWriter: round trips, conversions, metadata, refusals, whole files or none.
#include "vtkOpenImageIOWriter.h"

#include "vtkErrorCode.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkOpenImageIOReader.h"
#include "vtkStringArray.h"

#include "ImageFileTestUtilities.h"

#include <algorithm>
#include <limits>
#include <sstream>

#ifndef _WIN32
#include <csignal>
#include <sys/resource.h>
#endif

namespace
{
int Failures = 0;
std::string Directory;

vtkSmartPointer<vtkImageData> MakeImage(
  int type, int components, int width = 21, int height = 17, double scale = 1.0)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  // An extent that begins elsewhere is written all the same.
  image->SetExtent(5, 4 + width, -3, height - 4, 2, 2);
  image->AllocateScalars(type, components);
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  for (vtkIdType t = 0; t < scalars->GetNumberOfTuples(); ++t)
  {
    for (int c = 0; c < components; ++c)
    {
      scalars->SetComponent(t, c, scale * static_cast<double>((t * 5 + c * 11) % 120));
    }
  }
  return image;
}

vtkSmartPointer<vtkImageData> ReadBack(const std::string& name)
{
  vtkNew<vtkOpenImageIOReader> reader;
  reader->SetFileName(name.c_str());
  reader->Update();
  return reader->GetOutput();
}

void TestRoundTrip(const std::string& extension, int type, int components,
  int pixelType = vtkOpenImageIOWriter::Automatic, double tolerance = 0.0, int readType = VTK_VOID)
{
  const std::string name = Directory + "trip." + extension;
  auto image = MakeImage(type, components);
  vtkNew<vtkOpenImageIOWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(name.c_str());
  writer->SetPixelType(pixelType);
  writer->Write();
  const bool written = writer->GetErrorCode() == vtkErrorCode::NoError;
  CHECK(written);
  auto back = ReadBack(name);
  vtkDataArray* values = back->GetPointData()->GetScalars();
  CHECK(values && values->GetDataType() == (readType == VTK_VOID ? type : readType));
  CHECK(back->GetDimensions()[0] == 21 && back->GetDimensions()[1] == 17);
  CHECK_NEAR(LargestDifference(image->GetPointData()->GetScalars(), values), 0.0, tolerance);
  if (!written || !values)
  {
    std::cout << "  " << extension << " " << components << " " << type << std::endl;
  }
}

void TestRoundTrips()
{
  for (int components = 1; components <= 4; ++components)
  {
    TestRoundTrip("png", VTK_UNSIGNED_CHAR, components);
    TestRoundTrip("png", VTK_UNSIGNED_SHORT, components);
    TestRoundTrip("sgi", VTK_UNSIGNED_CHAR, components); // written by name, not through a proxy
  }
  for (int components = 1; components <= 6; ++components)
  {
    TestRoundTrip("exr", VTK_FLOAT, components);
    TestRoundTrip("exr", VTK_UNSIGNED_INT, components);
    // The values are whole numbers that half holds.
    TestRoundTrip("exr", VTK_FLOAT, components, vtkOpenImageIOWriter::Half);
    TestRoundTrip("exr", VTK_DOUBLE, components, vtkOpenImageIOWriter::Automatic, 0.0, VTK_FLOAT);
    TestRoundTrip("tif", VTK_UNSIGNED_CHAR, components);
    TestRoundTrip("tif", VTK_UNSIGNED_SHORT, components);
    TestRoundTrip("tif", VTK_FLOAT, components);
    TestRoundTrip("tif", VTK_DOUBLE, components);
    TestRoundTrip("tif", VTK_SHORT, components);
  }
  TestRoundTrip("rla", VTK_DOUBLE, 3, vtkOpenImageIOWriter::Automatic, 0.0, VTK_FLOAT);
  TestRoundTrip("tga", VTK_UNSIGNED_CHAR, 4);
  TestRoundTrip("hdr", VTK_FLOAT, 3, vtkOpenImageIOWriter::Automatic, 0.5);
  TestRoundTrip("jpg", VTK_UNSIGNED_CHAR, 1, vtkOpenImageIOWriter::Automatic, 20.0);

  // The first row of the image is the last of the file.
  const std::string name = Directory + "rows.exr";
  auto image = MakeImage(VTK_FLOAT, 1);
  vtkNew<vtkOpenImageIOWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(name.c_str());
  writer->Write();
  OIIO::ImageSpec spec;
  const std::vector<float> file = ReadFile(name, spec);
  CHECK(file.size() == 21 * 17 && spec.height == 17);
  CHECK(!file.empty() && file[16 * 21] == Value(image, nullptr, 5, -3));
  CHECK(!file.empty() && file[1] == Value(image, nullptr, 6, 13));
}

// An image is written and read back as it was, or refused by one message and no file is there.
void TestSize(const std::string& extension, vtkImageData* image, bool held)
{
  const std::string name = Directory + "size." + extension;
  std::filesystem::remove(name);
  vtkNew<vtkOpenImageIOWriter> writer;
  MessageKeeper messages(writer);
  writer->SetInputData(image);
  writer->SetFileName(name.c_str());
  writer->Write();
  vtkDataArray* expected = image->GetPointData()->GetScalars();
  bool good = false;
  if (held)
  {
    auto back = ReadBack(name);
    vtkDataArray* values = back->GetPointData()->GetScalars();
    good = messages.Silent() && values && LargestDifference(expected, values) == 0.0;
  }
  else
  {
    good = messages.OneError("Cannot write \"" + name + "\": ") && !std::filesystem::exists(name);
  }
  CHECK(good);
  if (!good)
  {
    std::cout << "  " << extension << " " << expected->GetNumberOfComponents() << " "
              << expected->GetDataTypeAsString() << " " << image->GetDimensions()[0] << " x "
              << image->GetDimensions()[1] << std::endl;
  }
}

// Formats whose writers do not survive images of some sizes, or do not write them.
void TestSizes()
{
  const struct
  {
    const char* extension;
    int type;
    bool (*holds)(int components, int width, int height);
  } formats[] = {
    { "ico", VTK_UNSIGNED_CHAR,
      [](int c, int w, int h) { return c == 4 && std::max(w, h) <= 256; } },
    { "ico", VTK_UNSIGNED_SHORT, [](int, int, int) { return false; } },
    { "jp2", VTK_UNSIGNED_CHAR,
      [](int c, int w, int h) { return c != 2 && std::min(w, h) >= 32; } },
    { "j2k", VTK_UNSIGNED_SHORT,
      [](int c, int w, int h) { return c != 2 && std::min(w, h) >= 32; } },
    { "rla", VTK_UNSIGNED_CHAR, [](int, int, int) { return false; } },
    { "rla", VTK_FLOAT, [](int, int, int) { return true; } },
  };
  for (const auto& format : formats)
  {
    for (const int width : { 1, 5, 31, 32, 100, 255, 256, 257 })
    {
      for (const int height : { 1, 4, 32, 257 })
      {
        for (int components = 1; components <= 4; ++components)
        {
          TestSize(format.extension, MakeImage(format.type, components, width, height),
            format.holds(components, width, height));
        }
      }
    }
  }
}

void TestConversions()
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(7, 1, 1);
  image->AllocateScalars(VTK_FLOAT, 1);
  const float values[7] = { 0.0f, 1.0f, 0.5f, -3.0f, 7.0f, nan, infinity };
  std::copy_n(values, 7, static_cast<float*>(image->GetScalarPointer()));
  vtkNew<vtkOpenImageIOWriter> writer;
  writer->SetInputData(image);

  const std::string png = Directory + "convert.png";
  writer->SetFileName(png.c_str());
  writer->SetPixelTypeToUnsignedChar();
  writer->Write();
  auto back = ReadBack(png);
  const float bytes[7] = { 0, 255, 128, 0, 255, 0, 255 };
  for (int i = 0; i < 7; ++i)
  {
    CHECK_NEAR(Value(back, nullptr, i, 0), bytes[i], 0.0);
  }
  writer->SetPixelTypeToUnsignedShort();
  writer->Write();
  back = ReadBack(png);
  CHECK(back->GetScalarType() == VTK_UNSIGNED_SHORT);
  CHECK(Value(back, nullptr, 1, 0) == 65535 && Value(back, nullptr, 5, 0) == 0);

  // Floating point files keep what is no number.
  const std::string exr = Directory + "convert.exr";
  writer->SetFileName(exr.c_str());
  writer->SetPixelTypeToAutomatic();
  writer->Write();
  back = ReadBack(exr);
  CHECK(std::isnan(Value(back, nullptr, 5, 0)) && Value(back, nullptr, 6, 0) == infinity);
  CHECK(Value(back, nullptr, 3, 0) == -3.0f);
  writer->SetPixelTypeToHalf();
  writer->Write();
  back = ReadBack(exr);
  CHECK(std::isnan(Value(back, nullptr, 5, 0)) && Value(back, nullptr, 6, 0) == infinity);
  OIIO::ImageSpec spec;
  ReadFile(exr, spec);
  CHECK(spec.format == OIIO::TypeHalf);

  // Integers into floating point: the full range is 1.
  auto byte = MakeImage(VTK_UNSIGNED_CHAR, 3);
  writer->SetInputData(byte);
  writer->SetPixelTypeToFloat();
  writer->Write();
  back = ReadBack(exr);
  for (int i = 0; i < 21; ++i)
  {
    CHECK_NEAR(Value(back, nullptr, i, 3, 1), Value(byte, nullptr, 5 + i, 0, 1) / 255.0, 1e-6);
  }

  // Colour below alpha 0 is kept.
  auto clear = MakeImage(VTK_UNSIGNED_CHAR, 4, 2, 2);
  clear->GetPointData()->GetScalars()->FillComponent(3, 0.0);
  writer->SetInputData(clear);
  writer->SetFileName(png.c_str());
  writer->SetPixelTypeToAutomatic();
  writer->Write();
  back = ReadBack(png);
  CHECK(Value(back, nullptr, 1, 0, 1) == Value(clear, nullptr, 6, -3, 1));

  // Compression and quality reach the file.
  auto size = [&](const char* extension, const char* compression, int quality)
  {
    const std::string name = Directory + "size." + extension;
    vtkNew<vtkOpenImageIOWriter> w;
    w->SetInputData(MakeImage(VTK_UNSIGNED_CHAR, 3, 200, 200));
    w->SetFileName(name.c_str());
    w->SetCompression(compression);
    w->SetQuality(quality);
    w->Write();
    CHECK(w->GetErrorCode() == vtkErrorCode::NoError);
    ReadFile(name, spec);
    return std::filesystem::file_size(name);
  };
  CHECK(size("jpg", nullptr, 95) > 2 * size("jpg", nullptr, 20));
  CHECK(size("tif", "none", 95) > 2 * size("tif", "zip", 95));
  CHECK(size("tif", "lzw", 95) > 0 && spec.get_string_attribute("compression") == "lzw");
}

void TestMetadata()
{
  auto image = MakeImage(VTK_FLOAT, 3);
  auto addText = [&](const char* name, const char* text)
  {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    array->InsertNextValue(text);
    image->GetFieldData()->AddArray(array);
  };
  addText("Artist", "Mary Somerville");
  addText("oiio:ColorSpace", "sRGB");
  addText("compression", "none");
  addText("openexr:lineOrder", "decreasingY");
  vtkNew<vtkFloatArray> white;
  white->SetName("white");
  white->SetNumberOfComponents(3);
  white->InsertNextTuple3(0.25, 0.5, 0.75);
  image->GetFieldData()->AddArray(white);
  vtkNew<vtkIntArray> tries;
  tries->SetName("tries");
  tries->InsertNextValue(7);
  image->GetFieldData()->AddArray(tries);
  vtkNew<vtkIntArray> orientation;
  orientation->SetName("Orientation");
  orientation->InsertNextValue(6);
  image->GetFieldData()->AddArray(orientation);
  vtkNew<vtkDoubleArray> large;
  large->SetName("large");
  large->SetNumberOfTuples(100000);
  large->Fill(1.0);
  image->GetFieldData()->AddArray(large);
  vtkNew<vtkIntArray> unnamed;
  unnamed->InsertNextValue(1);
  image->GetFieldData()->AddArray(unnamed);

  const std::string name = Directory + "metadata.exr";
  vtkNew<vtkOpenImageIOWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName(name.c_str());
  writer->Write();
  CHECK(writer->GetErrorCode() == vtkErrorCode::NoError);
  OIIO::ImageSpec spec;
  ReadFile(name, spec);
  CHECK(spec.get_string_attribute("Artist") == "Mary Somerville");
  CHECK(spec.get_int_attribute("tries") == 7);
  CHECK(spec.get_string_attribute("compression") != "none");
  CHECK(spec.get_string_attribute("openexr:lineOrder") != "decreasingY");
  CHECK(spec.get_string_attribute("oiio:ColorSpace") != "sRGB");
  CHECK(spec.get_int_attribute("Orientation", 1) == 1);
  CHECK(spec.find_attribute("large") == nullptr);
  auto back = ReadBack(name);
  CHECK(LargestDifference(back->GetFieldData()->GetArray("white"), white) == 0.0);

  // What the reader hands on is written again, into another format as well.
  vtkNew<vtkOpenImageIOReader> reader;
  reader->SetFileName(name.c_str());
  const std::string copy = Directory + "copy.tif";
  vtkNew<vtkOpenImageIOWriter> second;
  second->SetInputConnection(reader->GetOutputPort());
  second->SetFileName(copy.c_str());
  second->Write();
  CHECK(second->GetErrorCode() == vtkErrorCode::NoError);
  ReadFile(copy, spec);
  CHECK(spec.get_string_attribute("Artist") == "Mary Somerville");
}

// Writes what is to be refused: one message with the file's name, nothing left behind.
void Refused(vtkImageData* image, const std::string& name, unsigned long code,
  const std::string& text, int pixelType = vtkOpenImageIOWriter::Automatic)
{
  std::cout << "  " << name << std::endl;
  const int files = CountFiles(Directory);
  vtkNew<vtkOpenImageIOWriter> writer;
  MessageKeeper messages(writer);
  MessageKeeper pipeline(writer->GetExecutive());
  writer->SetInputData(image);
  writer->SetFileName(name.c_str());
  writer->SetPixelType(pixelType);
  writer->Write();
  CHECK(writer->GetErrorCode() == code);
  CHECK(messages.OneError(EndOfName(name)));
  writer->Write();
  CHECK(messages.OneError(text));
  CHECK(pipeline.Silent());
  CHECK(CountFiles(Directory) == files);
}

void TestRefusals()
{
  const unsigned long format = vtkErrorCode::FileFormatError;
  auto byte = [](int components) { return MakeImage(VTK_UNSIGNED_CHAR, components); };
  Refused(byte(4), Directory + "bad.jpg", format, "jpeg holds 1 or 3 components");
  Refused(byte(2), Directory + "bad.jpg", format, "jpeg holds 1 or 3 components");
  Refused(byte(5), Directory + "bad.png", format, "png holds up to 4 components");
  Refused(byte(5), Directory + "bad.dpx", format, "dpx holds 1, 3 or 4 components");
  Refused(byte(2), Directory + "bad.dpx", format, "dpx holds 1, 3 or 4 components");
  Refused(byte(4), Directory + "bad.gif", format, "gif holds 3 components");
  Refused(byte(1), Directory + "bad.webp", format, "webp");
  Refused(byte(3), Directory + "bad.iff", format, "iff");
  Refused(byte(3), Directory + "bad.null", format, "makes no file");
  Refused(byte(3), Directory + "bad.term", format, "makes no file");
  Refused(byte(1), Directory + "bad.ico", format, "ico holds 4 components");
  Refused(byte(3), Directory + "bad.ico", format, "ico holds 4 components");
  Refused(MakeImage(VTK_UNSIGNED_SHORT, 4, 256), Directory + "bad.ico", format, "uint8");
  Refused(MakeImage(VTK_UNSIGNED_CHAR, 4, 257), Directory + "bad.ico", format, "256");
  Refused(byte(3), Directory + "bad.jp2", format, "at least 32 x 32 samples");
  Refused(byte(3), Directory + "bad.rla", format, "what it would hold instead is float");
  Refused(MakeImage(VTK_UNSIGNED_CHAR, 3, 65536, 1), Directory + "bad.gif", format, "65535");
  Refused(MakeImage(VTK_UNSIGNED_CHAR, 3, 1, 65501), Directory + "bad.jpg", format, "65500");
  Refused(byte(4), Directory + "bad.hdr", format, "hdr");
  Refused(MakeImage(VTK_FLOAT, 1), Directory + "bad.hdr", format, "-channel");
  Refused(MakeImage(VTK_FLOAT, 3), Directory + "bad.png", format,
    "png does not hold pixels of type float");
  Refused(MakeImage(VTK_UNSIGNED_SHORT, 3), Directory + "bad.jpg", format, "uint16");
  Refused(byte(3), Directory + "bad.exr", format, "uint8");
  Refused(MakeImage(VTK_INT, 1), Directory + "bad.png", format, "type int");
  Refused(
    MakeImage(VTK_FLOAT, 1), Directory + "bad.tif", format, "half", vtkOpenImageIOWriter::Half);
  Refused(
    byte(3), Directory + "bad.unknown", vtkErrorCode::UnrecognizedFileTypeError, "bad.unknown");
  Refused(byte(3), Directory + "bad", vtkErrorCode::UnrecognizedFileTypeError, "");
  Refused(byte(3), "", vtkErrorCode::NoFileNameError, "no file name");

  Refused(
    byte(3), Directory + "none/bad.png", vtkErrorCode::CannotOpenFileError, "cannot be written");
  std::filesystem::create_directory(Directory + "folder.png");
  Refused(byte(3), Directory + "folder.png", vtkErrorCode::CannotOpenFileError, "not a file");
  WriteText(Directory + "text", "text");
  Refused(
    byte(3), Directory + "text/bad.png", vtkErrorCode::CannotOpenFileError, "cannot be written");

  const unsigned long unknown = vtkErrorCode::UnknownError;
  vtkNew<vtkImageData> empty;
  Refused(empty, Directory + "bad.png", unknown, "empty");
  vtkNew<vtkImageData> bare;
  bare->SetDimensions(3, 3, 1);
  Refused(bare, Directory + "bad.png", unknown, "no scalars");
  vtkNew<vtkImageData> volume;
  volume->SetDimensions(3, 3, 3);
  volume->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  Refused(volume, Directory + "bad.png", unknown, "3 slices");
  vtkNew<vtkImageData> bits;
  bits->SetDimensions(8, 1, 1);
  bits->AllocateScalars(VTK_BIT, 1);
  Refused(bits, Directory + "bad.png", unknown, "bit");

  vtkNew<vtkOpenImageIOWriter> writer;
  MessageKeeper messages(writer);
  writer->SetFileName((Directory + "bad.png").c_str());
  writer->Write();
  CHECK(messages.OneError("no input") && writer->GetErrorCode() == unknown);

  // Nothing comes from a reader that fails, and that is not a success.
  vtkNew<vtkOpenImageIOReader> reader;
  MessageKeeper readerMessages(reader);
  reader->SetFileName((Directory + "none.png").c_str());
  writer->SetInputConnection(reader->GetOutputPort());
  writer->Write();
  CHECK(readerMessages.OneError("does not exist"));
  CHECK(messages.OneError("empty") && writer->GetErrorCode() == unknown);
  CHECK(!std::filesystem::exists(Directory + "bad.png"));

  writer->SetQuality(0);
  CHECK(writer->GetQuality() == 1);
  writer->SetQuality(101);
  CHECK(writer->GetQuality() == 100);
  writer->SetPixelType(77);
  CHECK(writer->GetPixelType() == vtkOpenImageIOWriter::Float);
  writer->SetCompression("zip");
  std::ostringstream text;
  writer->Print(text);
  for (const char* member : { "PixelType: Float", "Compression: zip", "Quality: 100" })
  {
    CHECK(text.str().find(member) != std::string::npos);
  }
}

void TestWholeFiles()
{
  const std::string directory = Directory + "whole/";
  std::filesystem::create_directory(directory);
  for (const char* extension : { "exr", "tif", "png", "sgi" })
  {
    const std::string name = directory + "kept." + extension;
    const bool real = std::string(extension) == "exr";
    auto image = MakeImage(real ? VTK_FLOAT : VTK_UNSIGNED_CHAR, 4, 1024, 1500);
    vtkNew<vtkOpenImageIOWriter> writer;
    MessageKeeper messages(writer);
    writer->SetInputData(image);
    writer->SetFileName(name.c_str());
    WriteText(name, "what was here before");
    const int files = CountFiles(directory);

    // Told to stop on the way.
    ProgressKeeper progress(writer);
    int most = 0;
    progress.AtStep = [&] { most = std::max(most, CountFiles(directory)); };
    progress.StopAbove = 0.0; // the pipeline announces 0 itself
    writer->Write();
    CHECK(writer->GetErrorCode() == vtkErrorCode::UserError && messages.Silent());
    CHECK(most == files + 1);
    CHECK(CountFiles(directory) == files && FileText(name) == "what was here before");
    progress.StopAbove = VTK_DOUBLE_MAX;

#ifndef _WIN32
    // No room on the disk: a limit on the size of files has the same effect.
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before;
    getrlimit(RLIMIT_FSIZE, &before);
    rlimit limit = before;
    limit.rlim_cur = 1000;
    setrlimit(RLIMIT_FSIZE, &limit);
    writer->Write();
    setrlimit(RLIMIT_FSIZE, &before);
    CHECK(writer->GetErrorCode() == vtkErrorCode::OutOfDiskSpaceError);
    CHECK(messages.OneError(EndOfName(name)));
    CHECK(CountFiles(directory) == files && FileText(name) == "what was here before");

    // The last byte finds no room.
    writer->SetFileName((directory + "size." + extension).c_str());
    writer->SetInputData(MakeImage(real ? VTK_FLOAT : VTK_UNSIGNED_CHAR, 4));
    writer->Write();
    CHECK(writer->GetErrorCode() == vtkErrorCode::NoError);
    limit.rlim_cur = std::filesystem::file_size(writer->GetFileName()) - 1;
    std::filesystem::remove(writer->GetFileName());
    setrlimit(RLIMIT_FSIZE, &limit);
    writer->Write();
    setrlimit(RLIMIT_FSIZE, &before);
    CHECK(writer->GetErrorCode() == vtkErrorCode::OutOfDiskSpaceError);
    CHECK(messages.OneError("Cannot write"));
    CHECK(CountFiles(directory) == files);
    writer->SetFileName(name.c_str());
    writer->SetInputData(image);
#endif

    // And now the whole.
    progress.Steps.clear();
    writer->Write();
    CHECK(writer->GetErrorCode() == vtkErrorCode::NoError && messages.Silent());
    CHECK(CountFiles(directory) == files);
    CHECK(progress.Rises() && progress.Steps.size() > 1);
    CHECK(LargestDifference(image->GetPointData()->GetScalars(),
            ReadBack(name)->GetPointData()->GetScalars()) == 0.0);
  }

#ifndef _WIN32
  // A link stays a link, and a replaced file keeps its permissions.
  const std::string target = directory + "target.png";
  WriteText(target, "old");
  std::filesystem::permissions(target, std::filesystem::perms(0640));
  std::filesystem::create_symlink("target.png", directory + "link.png");
  vtkNew<vtkOpenImageIOWriter> writer;
  writer->SetInputData(MakeImage(VTK_UNSIGNED_CHAR, 3));
  writer->SetFileName((directory + "link.png").c_str());
  writer->Write();
  CHECK(writer->GetErrorCode() == vtkErrorCode::NoError);
  CHECK(std::filesystem::is_symlink(directory + "link.png"));
  CHECK(std::filesystem::status(target).permissions() == std::filesystem::perms(0640));
  CHECK(ReadBack(target)->GetNumberOfPoints() == 21 * 17);
#endif

  const std::string umlaut = directory + "H\xc3\xb6hen \xe5\xb1\xb1.exr";
  vtkNew<vtkOpenImageIOWriter> unicode;
  unicode->SetInputData(MakeImage(VTK_FLOAT, 1));
  unicode->SetFileName(umlaut.c_str());
  unicode->Write();
  CHECK(ReadBack(umlaut)->GetNumberOfPoints() == 21 * 17);
}
}

int TestOpenImageIOWriter(int argc, char* argv[])
{
  Directory = EmptyDirectory(argc, argv, "TestOpenImageIOWriter");
  TestRoundTrips();
  TestSizes();
  TestConversions();
  TestMetadata();
  TestRefusals();
  TestWholeFiles();
  return Failures;
}
