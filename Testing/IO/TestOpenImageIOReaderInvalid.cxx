// SPDX-License-Identifier: BSD-3-Clause
// What vtkOpenImageIOReader says of files that it cannot read: one message, a code, empty outputs.
#include "vtkOpenImageIOReader.h"

#include "vtkErrorCode.h"
#include "vtkExecutive.h"

#include "ImageFileTestUtilities.h"

using OIIO::ImageSpec;

namespace
{
int Failures = 0;
std::string Directory;

// Reads a file that is to fail. The pipeline behind the reader has nothing to add.
void Refused(const std::string& name, unsigned long code, const std::string& text,
  const std::function<void(vtkOpenImageIOReader*)>& prepare = nullptr)
{
  std::cout << "  " << name << std::endl;
  vtkNew<vtkOpenImageIOReader> reader;
  MessageKeeper messages(reader);
  MessageKeeper pipeline(reader->GetExecutive());
  if (prepare)
  {
    prepare(reader);
  }
  reader->SetFileName(name.c_str());
  reader->Update();
  CHECK(reader->GetErrorCode() == code);
  CHECK(messages.OneError(EndOfName(name)));
  CHECK(pipeline.Silent());
  CHECK(reader->GetOutput()->GetNumberOfPoints() == 0);
  CHECK(reader->GetMaskOutput()->GetNumberOfPoints() == 0);
  CHECK(reader->GetOutput()->GetPointData()->GetNumberOfArrays() == 0);

  // It is said once, and in words that tell the reason.
  reader->Update();
  reader->Update(1);
  CHECK(messages.Silent() && pipeline.Silent() && reader->GetErrorCode() == code);
  reader->Modified();
  reader->Update();
  CHECK(messages.OneError(text));

  // A consumer of both outputs gets nothing either, and no second message.
  vtkNew<vtkImageReliefShading> shading;
  MessageKeeper consumer(shading);
  MessageKeeper consumerPipeline(shading->GetExecutive());
  shading->SetInputConnection(reader->GetOutputPort());
  shading->SetMaskConnection(reader->GetMaskOutputPort());
  reader->Modified();
  shading->Update();
  CHECK(messages.OneError(text));
  CHECK(pipeline.Silent() && consumerPipeline.Silent());
  CHECK(shading->GetOutput()->GetNumberOfPoints() == 0);
}

void Truncate(const std::string& name, double part)
{
  std::filesystem::resize_file(name,
    static_cast<std::uintmax_t>(part * static_cast<double>(std::filesystem::file_size(name))));
}

// Noise, so that compression leaves something to cut off.
std::vector<unsigned char> Noise(size_t count)
{
  std::vector<unsigned char> values;
  unsigned int state = 1;
  while (values.size() < count)
  {
    state = 1664525u * state + 1013904223u;
    values.push_back(static_cast<unsigned char>(state >> 24));
  }
  return values;
}

void TestNames()
{
  Refused("", vtkErrorCode::NoFileNameError, "no file name");
  Refused(Directory + "none.exr", vtkErrorCode::FileNotFoundError, "does not exist");
  Refused(Directory + "none/none.exr", vtkErrorCode::FileNotFoundError, "does not exist");
  Refused(Directory, vtkErrorCode::CannotOpenFileError, "directory");
  vtkNew<vtkOpenImageIOReader> reader;
  MessageKeeper messages(reader);
  reader->Update();
  CHECK(reader->GetErrorCode() == vtkErrorCode::NoFileNameError);
  CHECK(messages.OneError("no file name"));
}

void TestContents()
{
  for (const char* extension : { "exr", "png", "tif", "jpg", "hdr", "bmp", "tga", "txt" })
  {
    const std::string empty = Directory + "empty." + extension;
    WriteText(empty, "");
    Refused(empty, vtkErrorCode::PrematureEndOfFileError, "empty");
    const std::string text = Directory + "text." + extension;
    WriteText(text, "This is no picture, but a text that is longer than most headers are.\n");
    Refused(text, vtkErrorCode::UnrecognizedFileTypeError, "");
    vtkNew<vtkOpenImageIOReader> reader;
    CHECK(reader->CanReadFile(text.c_str()) == 0 && reader->CanReadFile(empty.c_str()) == 0);
  }
  // OpenImageIO's own words are there.
  Refused(Directory + "text.exr", vtkErrorCode::UnrecognizedFileTypeError, "not an OpenEXR file");

  for (const char* extension : { "exr", "png", "tif", "jpg", "hdr", "bmp" })
  {
    const std::string name = Directory + "cut." + extension;
    const bool real = std::string(extension) == "exr" || std::string(extension) == "hdr";
    CHECK(WriteFile(name, ImageSpec(120, 200, 3, real ? OIIO::TypeFloat : OIIO::TypeUInt8),
      Noise(120 * 200 * 3)));
    Truncate(name, 0.6);
    Refused(name, vtkErrorCode::PrematureEndOfFileError, "end early or are damaged");
  }
}

void TestKinds()
{
  const std::string flat = Directory + "flat.exr";
  CHECK(WriteFile(flat, ImageSpec(8, 8, 1, OIIO::TypeFloat), std::vector<float>(64, 1.0f)));
  Refused(flat, vtkErrorCode::FileFormatError, "no subimage 2",
    [](vtkOpenImageIOReader* reader) { reader->SetSubimage(2); });
  Refused(flat, vtkErrorCode::FileFormatError, "MIP level 3",
    [](vtkOpenImageIOReader* reader) { reader->SetMipLevel(3); });

  const std::string volume = Directory + "volume.tif";
  ImageSpec deep(8, 8, 1, OIIO::TypeUInt8);
  deep.depth = deep.full_depth = 4;
  deep.tile_width = deep.tile_height = 16;
  deep.tile_depth = 1;
  if (WriteFile(volume, deep, Noise(8 * 8 * 4)))
  {
    Refused(volume, vtkErrorCode::FileFormatError, "volume of 4 slices");
  }

  // A small file that promises a large picture: 40000 x 50000 in a PNG header.
  const std::string large = Directory + "large.png";
  CHECK(WriteFile(large, ImageSpec(8, 8, 4, OIIO::TypeUInt8), Noise(8 * 8 * 4)));
  std::string bytes = FileText(large);
  bytes.replace(16, 8, std::string("\x00\x00\x9c\x40\x00\x00\xc3\x50", 8));
  // The chunk's check sum, of these bytes.
  unsigned int sum = 0xffffffffu;
  for (size_t i = 12; i < 29; ++i)
  {
    sum ^= static_cast<unsigned char>(bytes[i]);
    for (int bit = 0; bit < 8; ++bit)
    {
      sum = (sum >> 1) ^ (sum & 1 ? 0xedb88320u : 0);
    }
  }
  sum = ~sum;
  for (int i = 0; i < 4; ++i)
  {
    bytes[29 + i] = static_cast<char>(sum >> (24 - 8 * i));
  }
  WriteText(large, bytes);
#if OIIO_VERSION >= OIIO_MAKE_VERSION(3, 1, 0)
  // OpenImageIO itself does not believe it.
  Refused(large, vtkErrorCode::UnrecognizedFileTypeError, "7629 MB");
#else
  Refused(large, vtkErrorCode::FileFormatError, "40000 x 50000",
    [](vtkOpenImageIOReader* reader) { reader->SetMemoryLimit(1024 * 1024); });
#endif

  // 64 floats, 64 bytes of mask and 64 floats that are decoded at a time are below 1 KiB.
  vtkNew<vtkOpenImageIOReader> small;
  CHECK(small->GetMemoryLimit() > 1024 * 1024);
  small->SetMemoryLimit(1);
  small->SetFileName(flat.c_str());
  small->Update();
  CHECK(small->GetErrorCode() == vtkErrorCode::NoError);
}

// Headers that claim more bytes than follow, or other ones than their library takes.
void TestClaims()
{
  const std::string exr = Directory + "claims.exr";
  CHECK(WriteFile(exr, ImageSpec(8, 8, 1, OIIO::TypeFloat), std::vector<float>(64, 1.0f)));
  const std::string header = FileText(exr);
  const std::string compression("compression\0compression\0", 24);
  const std::string window("dataWindow\0box2i\0", 17);
  CHECK(header.find(compression) != std::string::npos && header.find(window) != std::string::npos);

  std::string bytes = header;
  bytes[header.find(compression) + compression.size()] = 9;
  WriteText(exr, bytes);
  Refused(exr, vtkErrorCode::FileFormatError,
    "the attribute \"compression\" in its header claims 9 bytes, and has 1");

  // A type that nobody knows, and that a terminal would not show.
  bytes = header;
  const size_t end = header.find(window) + window.size();
  bytes.replace(end - 6, 10, std::string("\x1b\n\xffox\0\x10\0\0\x10", 10));
  WriteText(exr, bytes);
  Refused(exr, vtkErrorCode::PrematureEndOfFileError,
    "a value of type \"???ox\" in its header claims 268435472 bytes");

  const std::string png = Directory + "claims.png";
  CHECK(WriteFile(png, ImageSpec(8, 8, 1, OIIO::TypeUInt8), Noise(64)));
  bytes = FileText(png);
  bytes[8] = 0x7f;
  WriteText(png, bytes);
  Refused(png, vtkErrorCode::PrematureEndOfFileError,
    "the chunk \"IHDR\" in its header claims 2130706445 bytes");
}

void TestRecovery()
{
  // A reader that failed reads the next file, larger or smaller than the one before.
  const std::string good = Directory + "good.png";
  const std::string better = Directory + "better.png";
  CHECK(WriteFile(good, ImageSpec(4, 3, 1, OIIO::TypeUInt8), Noise(12)));
  CHECK(WriteFile(better, ImageSpec(40, 30, 1, OIIO::TypeUInt8), Noise(1200)));
  vtkNew<vtkOpenImageIOReader> reader;
  MessageKeeper messages(reader);
  MessageKeeper pipeline(reader->GetExecutive());
  for (const std::string& name : { better, good, better })
  {
    reader->SetFileName(name.c_str());
    reader->Update();
    CHECK(reader->GetOutput()->GetNumberOfPoints() == (name == good ? 12 : 1200));
    CHECK(reader->GetMaskOutput()->GetNumberOfPoints() == (name == good ? 12 : 1200));
    CHECK(reader->GetErrorCode() == vtkErrorCode::NoError && messages.Silent());
    reader->SetFileName((Directory + "none.png").c_str());
    reader->Update();
    CHECK(messages.OneError("does not exist"));
    CHECK(reader->GetOutput()->GetNumberOfPoints() == 0);
  }
  CHECK(pipeline.Silent());

  // A file that changes between its header and its pixels.
  reader->SetFileName(good.c_str());
  reader->UpdateInformation();
  std::filesystem::copy_file(better, good, std::filesystem::copy_options::overwrite_existing);
  reader->Update();
  CHECK(messages.OneError("has changed"));
  CHECK(reader->GetErrorCode() == vtkErrorCode::FileFormatError);
  reader->Modified();
  reader->Update();
  CHECK(messages.Silent() && reader->GetOutput()->GetNumberOfPoints() == 1200);
}
}

int TestOpenImageIOReaderInvalid(int argc, char* argv[])
{
  Directory = EmptyDirectory(argc, argv, "TestOpenImageIOReaderInvalid");
  TestNames();
  TestContents();
  TestKinds();
  TestClaims();
  TestRecovery();
  return Failures;
}
