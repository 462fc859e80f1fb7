// SPDX-License-Identifier: BSD-3-Clause
// vtkOpenImageIOReader against files that OpenImageIO wrote: values, types, rows, alpha, metadata,
// parts.
#include "vtkOpenImageIOReader.h"

#include "vtkCallbackCommand.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkImageReader2Collection.h"
#include "vtkImageReader2Factory.h"
#include "vtkIntArray.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkStringArray.h"

#include "ImageFileTestUtilities.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <algorithm>
#include <limits>
#include <sstream>

using OIIO::ImageSpec;
using OIIO::TypeDesc;

namespace
{
int Failures = 0;
std::string Directory;

// Values that every type from 8 bits on holds, different in all rows, columns and channels.
template <typename T>
std::vector<T> Pattern(int width, int height, int channels)
{
  std::vector<T> values;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      for (int c = 0; c < channels; ++c)
      {
        values.push_back(static_cast<T>((7 * x + 31 * y + 3 * c + 1) % 120));
      }
    }
  }
  return values;
}

// Whether the image holds the pattern with its top row at the top.
bool HoldsPattern(vtkImageData* image, int width, int height, int channels, double tolerance = 0.0)
{
  int extent[6];
  image->GetExtent(extent);
  if (extent[0] != 0 || extent[2] != 0 || extent[1] != width - 1 || extent[3] != height - 1 ||
    image->GetNumberOfScalarComponents() != channels)
  {
    return false;
  }
  const std::vector<double> expected = Pattern<double>(width, height, channels);
  for (int j = 0; j < height; ++j)
  {
    for (int i = 0; i < width; ++i)
    {
      for (int c = 0; c < channels; ++c)
      {
        const double value = image->GetScalarComponentAsDouble(i, j, 0, c);
        if (!(std::abs(value - expected[((height - 1 - j) * width + i) * channels + c]) <=
              tolerance))
        {
          return false;
        }
      }
    }
  }
  return true;
}

template <typename T>
void TestType(const std::string& extension, int channels, TypeDesc stored, int vtkType)
{
  const std::string name = Directory + "type." + extension;
  ImageSpec spec(13, 9, channels, stored);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  CHECK(WriteFile(name, spec, Pattern<T>(13, 9, channels)));
  vtkNew<vtkOpenImageIOReader> reader;
  reader->SetFileName(name.c_str());
  reader->Update();
  CHECK(reader->GetErrorCode() == vtkErrorCode::NoError);
  CHECK(reader->GetOutput()->GetScalarType() == vtkType);
  const bool holds = HoldsPattern(reader->GetOutput(), 13, 9, channels);
  CHECK(holds);
  if (!holds)
  {
    std::cout << "  " << extension << " " << channels << " " << stored << std::endl;
  }
}

void TestTypes()
{
  for (int channels = 1; channels <= 4; ++channels)
  {
    TestType<unsigned char>("png", channels, OIIO::TypeUInt8, VTK_UNSIGNED_CHAR);
    TestType<unsigned short>("png", channels, OIIO::TypeUInt16, VTK_UNSIGNED_SHORT);
  }
  for (int channels = 1; channels <= 6; ++channels)
  {
    TestType<float>("exr", channels, OIIO::TypeHalf, VTK_FLOAT);
    TestType<float>("exr", channels, OIIO::TypeFloat, VTK_FLOAT);
    TestType<unsigned int>("exr", channels, TypeDesc::UINT32, VTK_UNSIGNED_INT);
    TestType<unsigned char>("tif", channels, OIIO::TypeUInt8, VTK_UNSIGNED_CHAR);
    TestType<char>("tif", channels, OIIO::TypeInt8, VTK_SIGNED_CHAR);
    TestType<unsigned short>("tif", channels, OIIO::TypeUInt16, VTK_UNSIGNED_SHORT);
    TestType<short>("tif", channels, OIIO::TypeInt16, VTK_SHORT);
    TestType<float>("tif", channels, OIIO::TypeFloat, VTK_FLOAT);
    TestType<double>("tif", channels, TypeDesc::DOUBLE, VTK_DOUBLE);
  }
  TestType<unsigned char>("bmp", 3, OIIO::TypeUInt8, VTK_UNSIGNED_CHAR);
  TestType<unsigned char>("tga", 4, OIIO::TypeUInt8, VTK_UNSIGNED_CHAR);

  // Lossy formats, within what they promise.
  vtkNew<vtkOpenImageIOReader> reader;
  const std::string hdr = Directory + "lossy.hdr";
  CHECK(WriteFile(hdr, ImageSpec(13, 9, 3, OIIO::TypeFloat), Pattern<float>(13, 9, 3)));
  reader->SetFileName(hdr.c_str());
  reader->Update();
  CHECK(reader->GetOutput()->GetScalarType() == VTK_FLOAT);
  CHECK(HoldsPattern(reader->GetOutput(), 13, 9, 3, 0.5));

  const std::string jpeg = Directory + "lossy.jpg";
  std::vector<unsigned char> ramp;
  for (int y = 0; y < 64; ++y)
  {
    for (int x = 0; x < 64; ++x)
    {
      ramp.push_back(static_cast<unsigned char>(3 * y + x / 2));
    }
  }
  CHECK(WriteFile(jpeg, ImageSpec(64, 64, 1, OIIO::TypeUInt8), ramp));
  reader->SetFileName(jpeg.c_str());
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  CHECK(image->GetScalarType() == VTK_UNSIGNED_CHAR && image->GetNumberOfPoints() == 64 * 64);
  CHECK_NEAR(image->GetScalarComponentAsDouble(0, 0, 0, 0), 189.0, 4.0);
  CHECK_NEAR(image->GetScalarComponentAsDouble(63, 63, 0, 0), 31.0, 4.0);
}

void TestRows()
{
  // The bottom left sample of the image begins the last row of the file.
  const std::string name = Directory + "rows.tif";
  const std::vector<unsigned char> values = { 10, 20, 30, 40, 50, 60 };
  ImageSpec spec(2, 3, 1, OIIO::TypeUInt8);
  CHECK(WriteFile(name, spec, values));
  vtkNew<vtkOpenImageIOReader> reader;
  reader->SetFileName(name.c_str());
  reader->Update();
  CHECK(Value(reader->GetOutput(), nullptr, 0, 0) == 50 && values[4] == 50);
  CHECK(Value(reader->GetOutput(), nullptr, 1, 2) == 20 && values[1] == 20);

  // Where the file's first sample and the next one of its row stand, for each Orientation.
  const int first[8][2] = { { 0, 2 }, { 1, 2 }, { 1, 0 }, { 0, 0 }, { 0, 1 }, { 2, 1 }, { 2, 0 },
    { 0, 0 } };
  const int second[8][2] = { { 1, 2 }, { 0, 2 }, { 0, 0 }, { 1, 0 }, { 0, 0 }, { 2, 0 }, { 2, 1 },
    { 0, 1 } };
  for (int orientation = 1; orientation <= 8; ++orientation)
  {
    spec.attribute("Orientation", orientation);
    CHECK(WriteFile(name, spec, values));
    reader->Modified();
    reader->Update();
    vtkImageData* image = reader->GetOutput();
    const int* dimensions = image->GetDimensions();
    CHECK(dimensions[0] == (orientation < 5 ? 2 : 3) && dimensions[1] == (orientation < 5 ? 3 : 2));
    const int* a = first[orientation - 1];
    const int* b = second[orientation - 1];
    CHECK(Value(image, nullptr, a[0], a[1]) == 10);
    CHECK(Value(image, nullptr, b[0], b[1]) == 20);
    CHECK(image->GetFieldData()->GetArray("Orientation")->GetTuple1(0) == 1);
  }
}

void TestAlpha()
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const std::string name = Directory + "alpha.exr";
  // The top row, then the bottom one; alpha is 1, 0, NaN, 0.25.
  const std::vector<float> values = { 1, 2, 3, 1, 4, 5, 6, 0, 7, 8, 9, nan, 10, 11, 12, 0.25f };
  CHECK(WriteFile(name, ImageSpec(2, 2, 4, OIIO::TypeFloat), values));
  vtkNew<vtkOpenImageIOReader> reader;
  reader->SetFileName(name.c_str());
  reader->Update();
  CHECK(reader->GetOutput()->GetNumberOfScalarComponents() == 4);
  CHECK(reader->GetOutput()->GetPointData()->GetArray("Alpha") == nullptr);
  vtkImageData* mask = reader->GetMaskOutput();
  auto checkMask = [&]
  {
    CHECK(mask->GetScalarType() == VTK_UNSIGNED_CHAR && mask->GetNumberOfPoints() == 4);
    CHECK(Value(mask, nullptr, 0, 0) == 0 && Value(mask, nullptr, 1, 0) == 255);
    CHECK(Value(mask, nullptr, 0, 1) == 255 && Value(mask, nullptr, 1, 1) == 0);
  };
  checkMask();

  reader->AlphaAsMaskOn();
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  CHECK(image->GetNumberOfScalarComponents() == 3);
  CHECK(Value(image, nullptr, 1, 0, 0) == 10 && Value(image, nullptr, 1, 0, 2) == 12);
  CHECK(Value(image, "Alpha", 0, 1) == 1 && Value(image, "Alpha", 1, 0) == 0.25f);
  CHECK(std::isnan(Value(image, "Alpha", 0, 0)));
  CHECK(image->GetPointData()->GetArray("Alpha")->GetDataType() == VTK_FLOAT);
  checkMask();

  // Without alpha there is no such array, and the mask hides nothing.
  const std::string opaque = Directory + "opaque.png";
  CHECK(WriteFile(
    opaque, ImageSpec(2, 2, 1, OIIO::TypeUInt8), std::vector<unsigned char>{ 0, 1, 2, 3 }));
  reader->SetFileName(opaque.c_str());
  reader->Update();
  CHECK(reader->GetOutput()->GetNumberOfScalarComponents() == 1);
  CHECK(reader->GetOutput()->GetPointData()->GetArray("Alpha") == nullptr);
  CHECK(mask->GetScalarRange()[0] == 255);

  // Colours under alpha 0 are kept.
  const std::string hidden = Directory + "hidden.png";
  ImageSpec unassociated(1, 1, 4, OIIO::TypeUInt8);
  unassociated.attribute("oiio:UnassociatedAlpha", 1);
  CHECK(WriteFile(hidden, unassociated, std::vector<unsigned char>{ 9, 8, 7, 0 }));
  reader->AlphaAsMaskOff();
  reader->SetFileName(hidden.c_str());
  reader->Update();
  CHECK(Value(reader->GetOutput(), nullptr, 0, 0, 0) == 9);
  CHECK(Value(mask, nullptr, 0, 0) == 0);

  // OpenImageIO 2.4 gives the alpha of a GIF a channel number that there is not.
  const std::string gif = Directory + "alpha.gif";
  CHECK(WriteFile(
    gif, ImageSpec(2, 1, 3, OIIO::TypeUInt8), std::vector<unsigned char>{ 255, 0, 0, 0, 0, 0 }));
  reader->AlphaAsMaskOn();
  reader->SetFileName(gif.c_str());
  reader->Update();
  CHECK(reader->GetOutput()->GetNumberOfScalarComponents() == 3);
  CHECK(Value(reader->GetOutput(), "Alpha", 1, 0) == 255);
  CHECK(Value(mask, nullptr, 0, 0) == 255 && Value(mask, nullptr, 1, 0) == 255);

  // The mask fits the filter: hidden samples come out transparent, with one run of the reader.
  const std::string heights = Directory + "heights.tif";
  std::vector<float> relief;
  for (int k = 0; k < 64; ++k)
  {
    relief.push_back(static_cast<float>(k % 5));
    relief.push_back(k == 9 ? 0.0f : 1.0f);
  }
  ImageSpec withAlpha(8, 8, 2, OIIO::TypeFloat);
  withAlpha.alpha_channel = 1;
  CHECK(WriteFile(heights, withAlpha, relief));
  vtkNew<vtkOpenImageIOReader> source;
  source->SetFileName(heights.c_str());
  source->AlphaAsMaskOn();
  int runs = 0;
  vtkNew<vtkCallbackCommand> count;
  count->SetClientData(&runs);
  count->SetCallback(
    [](vtkObject*, unsigned long, void* data, void*) { ++*static_cast<int*>(data); });
  source->AddObserver(vtkCommand::EndEvent, count);
  vtkNew<vtkImageReliefShading> shading;
  shading->SetInputConnection(source->GetOutputPort());
  shading->SetMaskConnection(source->GetMaskOutputPort());
  shading->Update();
  CHECK(Value(shading->GetOutput(), nullptr, 1, 6, 3) == 0);
  CHECK(Value(shading->GetOutput(), nullptr, 1, 5, 3) == 1);
  CHECK(runs == 1);
}

void TestMetadata()
{
  const std::string name = Directory + "metadata.exr";
  ImageSpec spec(3, 2, 5, OIIO::TypeFloat);
  spec.channelnames = { "R", "G", "B", "A", "depth.Z" };
  spec.x = 4;
  spec.y = -2;
  spec.full_width = 20;
  spec.full_height = 10;
  spec.attribute("Artist", "Ada Lovelace");
  spec.attribute("exposure", 1.5f);
  spec.attribute("tries", 7);
  const float white[3] = { 0.25f, 0.5f, 0.75f };
  spec.attribute("white", OIIO::TypeVector, white);
  CHECK(WriteFile(name, spec, Pattern<float>(3, 2, 5)));

  vtkNew<vtkOpenImageIOReader> reader;
  reader->SetFileName(name.c_str());
  reader->Update();
  CHECK(HoldsPattern(reader->GetOutput(), 3, 2, 5));
  CHECK(reader->GetOutput()->GetSpacing()[0] == 1.0 && reader->GetOutput()->GetOrigin()[1] == 0.0);
  vtkFieldData* data = reader->GetOutput()->GetFieldData();
  auto text = [&](const char* key, int i)
  {
    auto strings = vtkStringArray::SafeDownCast(data->GetAbstractArray(key));
    return strings && i < strings->GetNumberOfValues() ? std::string(strings->GetValue(i)) : "";
  };
  CHECK(text("Artist", 0) == "Ada Lovelace");
  CHECK(text("ChannelNames", 3) == "A" && text("ChannelNames", 4) == "depth.Z");
  // OpenImageIO says nothing of the encoding since 3.1, and before what floats are supposed to be.
  const std::string space = text("oiio:ColorSpace", 0);
  CHECK(space == "Linear" || space == "lin_rec709" ||
    (OIIO_VERSION >= OIIO_MAKE_VERSION(3, 1, 0) && space.empty()));
  vtkDataArray* exposure = data->GetArray("exposure");
  CHECK(exposure && exposure->GetDataType() == VTK_FLOAT && exposure->GetTuple1(0) == 1.5);
  vtkDataArray* tries = data->GetArray("tries");
  CHECK(vtkIntArray::SafeDownCast(tries) && tries->GetTuple1(0) == 7);
  vtkDataArray* vector = data->GetArray("white");
  CHECK(vector && vector->GetNumberOfComponents() == 3 && vector->GetNumberOfTuples() == 1);
  CHECK(vector && vector->GetComponent(0, 2) == 0.75);
  vtkDataArray* origin = data->GetArray("DataWindowOrigin");
  CHECK(origin && origin->GetComponent(0, 0) == 4 && origin->GetComponent(0, 1) == -2);

  // A stored resolution is no spacing; the user's is.
  const std::string png = Directory + "resolution.png";
  ImageSpec dense(2, 2, 1, OIIO::TypeUInt8);
  dense.attribute("XResolution", 300.0f);
  dense.attribute("YResolution", 300.0f);
  CHECK(WriteFile(png, dense, std::vector<unsigned char>{ 1, 2, 3, 4 }));
  reader->SetFileName(png.c_str());
  reader->Update();
  CHECK(reader->GetOutput()->GetSpacing()[0] == 1.0);
  CHECK(reader->GetOutput()->GetFieldData()->GetArray("XResolution") != nullptr);
  reader->SetDataSpacing(30.0, 20.0, 1.0);
  reader->SetDataOrigin(5.0, 6.0, 7.0);
  reader->Update();
  CHECK(reader->GetOutput()->GetSpacing()[1] == 20.0 && reader->GetOutput()->GetOrigin()[0] == 5.0);
  CHECK(reader->GetMaskOutput()->GetSpacing()[1] == 20.0);
}

void TestPartsOfFiles()
{
  // Tiles; the last ones reach beyond the picture.
  const std::string tiled = Directory + "tiled.exr";
  ImageSpec spec(75, 50, 3, OIIO::TypeFloat);
  spec.tile_width = spec.tile_height = 32;
  CHECK(WriteFile(tiled, spec, Pattern<float>(75, 50, 3)));
  vtkNew<vtkOpenImageIOReader> reader;
  reader->SetFileName(tiled.c_str());
  reader->Update();
  CHECK(HoldsPattern(reader->GetOutput(), 75, 50, 3));

  // Part of the extent, of both outputs together and of the mask alone.
  for (const std::string& name : { tiled, Directory + "scanlines.png" })
  {
    if (name != tiled)
    {
      CHECK(
        WriteFile(name, ImageSpec(75, 50, 3, OIIO::TypeUInt8), Pattern<unsigned char>(75, 50, 3)));
    }
    vtkNew<vtkOpenImageIOReader> whole;
    whole->SetFileName(name.c_str());
    whole->Update();
    vtkNew<vtkOpenImageIOReader> part;
    part->SetFileName(name.c_str());
    const int extent[6] = { 10, 20, 33, 47, 0, 0 };
    part->UpdateExtent(extent);
    CHECK(std::equal(extent, extent + 6, part->GetOutput()->GetExtent()));
    CHECK(std::equal(extent, extent + 6, part->GetMaskOutput()->GetExtent()));
    for (int j = 33; j <= 47; ++j)
    {
      for (int i = 10; i <= 20; ++i)
      {
        CHECK(Value(part->GetOutput(), nullptr, i, j, 2) ==
          Value(whole->GetOutput(), nullptr, i, j, 2));
      }
    }
    part->Update(1);
    CHECK(part->GetMaskOutput()->GetNumberOfPoints() == 75 * 50);
  }

  // Pages of a TIFF.
  const std::string pages = Directory + "pages.tif";
  auto output = OIIO::ImageOutput::create(pages);
  std::vector<ImageSpec> specs = { ImageSpec(4, 3, 1, OIIO::TypeUInt8),
    ImageSpec(2, 2, 1, OIIO::TypeUInt16) };
  CHECK(output->open(pages, 2, specs.data()));
  CHECK(output->write_image(OIIO::TypeUInt8, Pattern<unsigned char>(4, 3, 1).data()));
  CHECK(output->open(pages, specs[1], OIIO::ImageOutput::AppendSubimage));
  const unsigned short page[4] = { 1, 2, 3, 40000 };
  CHECK(output->write_image(OIIO::TypeUInt16, page));
  output->close();
  output->geterror();
  reader->SetFileName(pages.c_str());
  reader->Update();
  CHECK(HoldsPattern(reader->GetOutput(), 4, 3, 1));
  reader->SetSubimage(1);
  reader->Update();
  CHECK(reader->GetOutput()->GetScalarType() == VTK_UNSIGNED_SHORT);
  CHECK(reader->GetOutput()->GetNumberOfPoints() == 4);
  CHECK(Value(reader->GetOutput(), nullptr, 1, 0) == 40000);

  // Levels of an OpenEXR file.
  const std::string levels = Directory + "levels.exr";
  ImageSpec constant(64, 32, 1, OIIO::TypeFloat);
  OIIO::ImageBuf buffer(constant);
  OIIO::ImageBufAlgo::fill(buffer, { 2.0f });
  constant.tile_width = constant.tile_height = 32;
  CHECK(
    OIIO::ImageBufAlgo::make_texture(OIIO::ImageBufAlgo::MakeTxTexture, buffer, levels, constant));
  reader->SetFileName(levels.c_str());
  reader->SetSubimage(0);
  reader->SetMipLevel(2);
  reader->Update();
  CHECK(reader->GetOutput()->GetDimensions()[0] == 16);
  CHECK(reader->GetOutput()->GetDimensions()[1] == 8);
  CHECK(Value(reader->GetOutput(), nullptr, 3, 3) == 2.0f);
}

void TestFactory()
{
  const std::string exr = Directory + "factory.exr";
  CHECK(WriteFile(exr, ImageSpec(4, 3, 3, OIIO::TypeHalf), Pattern<float>(4, 3, 3)));
  auto made =
    vtkSmartPointer<vtkImageReader2>::Take(vtkImageReader2Factory::CreateImageReader2(exr.c_str()));
  CHECK(vtkOpenImageIOReader::SafeDownCast(made));
  if (made)
  {
    made->SetFileName(exr.c_str());
    made->Update();
    CHECK(HoldsPattern(made->GetOutput(), 4, 3, 3));
  }
  auto byExtension = vtkSmartPointer<vtkImageReader2>::Take(
    vtkImageReader2Factory::CreateImageReader2FromExtension("exr"));
  CHECK(vtkOpenImageIOReader::SafeDownCast(byExtension));

  // VTK keeps its own formats.
  const std::string png = Directory + "factory.png";
  CHECK(WriteFile(png, ImageSpec(4, 3, 1, OIIO::TypeUInt8), Pattern<unsigned char>(4, 3, 1)));
  auto own =
    vtkSmartPointer<vtkImageReader2>::Take(vtkImageReader2Factory::CreateImageReader2(png.c_str()));
  CHECK(own && own->IsA("vtkPNGReader"));

  vtkNew<vtkOpenImageIOReader> reader;
  CHECK(reader->CanReadFile(exr.c_str()) == 2 && reader->CanReadFile(png.c_str()) == 2);
  CHECK(reader->CanReadFile(Directory.c_str()) == 0);
  CHECK(reader->CanReadFile("") == 0 && reader->CanReadFile(nullptr) == 0);
  CHECK(reader->CanReadFile((Directory + "none.exr").c_str()) == 0);
  const std::string extensions = std::string(reader->GetFileExtensions()) + " ";
  for (const char* extension : { ".exr ", ".png ", ".tif ", ".tiff ", ".jpg ", ".hdr " })
  {
    CHECK(extensions.find(extension) != std::string::npos);
  }
  CHECK(extensions.find(".null ") == std::string::npos);
  CHECK(std::string(reader->GetDescriptiveName()) == "OpenImageIO");

  // Names are UTF-8.
  const std::string umlaut = Directory + "H\xc3\xb6hen \xe5\xb1\xb1.exr";
  CHECK(WriteFile(umlaut, ImageSpec(4, 3, 3, OIIO::TypeHalf), Pattern<float>(4, 3, 3)));
  reader->SetFileName(umlaut.c_str());
  reader->Update();
  CHECK(HoldsPattern(reader->GetOutput(), 4, 3, 3));

  std::ostringstream text;
  reader->Print(text);
  for (const char* member : { "Subimage: 0", "MipLevel: 0", "AlphaAsMask: Off", "MemoryLimit: " })
  {
    CHECK(text.str().find(member) != std::string::npos);
  }
  reader->SetSubimage(-3);
  reader->SetMipLevel(-1);
  reader->SetMemoryLimit(-5);
  CHECK(reader->GetSubimage() == 0 && reader->GetMipLevel() == 0 && reader->GetMemoryLimit() == 0);
}

void TestProgressAndAbort()
{
  const std::string name = Directory + "large.exr";
  const int width = 1024;
  const int height = 1500;
  ImageSpec spec(width, height, 4, OIIO::TypeFloat);
  spec.attribute("compression", "none");
  CHECK(WriteFile(name, spec, Pattern<float>(width, height, 4)));

  vtkNew<vtkOpenImageIOReader> reader;
  reader->SetFileName(name.c_str());
  ProgressKeeper progress(reader);
  progress.StopAbove = 0.0; // the pipeline announces 0 itself
  MessageKeeper messages(reader);
  reader->Update();
  CHECK(reader->GetErrorCode() == vtkErrorCode::UserError && messages.Silent());
  CHECK(reader->GetOutput()->GetNumberOfPoints() == 0);
  CHECK(reader->GetMaskOutput()->GetNumberOfPoints() == 0);

  progress.StopAbove = VTK_DOUBLE_MAX;
  progress.Steps.clear();
  reader->Modified();
  reader->Update();
  CHECK(reader->GetErrorCode() == vtkErrorCode::NoError);
  CHECK(HoldsPattern(reader->GetOutput(), width, height, 4));
  CHECK(progress.Steps.size() > 4 && progress.Steps.back() == 1.0);
  CHECK(progress.Rises());
}
}

int TestOpenImageIOReader(int argc, char* argv[])
{
  Directory = EmptyDirectory(argc, argv, "TestOpenImageIOReader");
  TestTypes();
  TestRows();
  TestAlpha();
  TestMetadata();
  TestPartsOfFiles();
  TestFactory();
  TestProgressAndAbort();
  return Failures;
}
