// SPDX-License-Identifier: BSD-3-Clause
// Which channels and parts of a file are read, colours that alpha has multiplied, and Radiance's
// headers.
#include "vtkOpenImageIOReader.h"

#include "vtkErrorCode.h"

#include "ImageFileTestUtilities.h"

#include <array>
#include <cmath>

using OIIO::ImageSpec;
using OIIO::TypeDesc;

namespace
{
int Failures = 0;
std::string Directory;

double Value(vtkImageData* image, int i, int j, int component)
{
  return image->GetScalarComponentAsDouble(i, j, 0, component);
}

bool Near(double a, double b, double tolerance = 1e-6)
{
  return std::abs(a - b) <= tolerance;
}

// One pixel with channels of these names, whose values are 1, 2, 3 ...
void Layers(const std::string& name, const std::vector<std::string>& channels)
{
  ImageSpec spec(1, 1, static_cast<int>(channels.size()), OIIO::TypeFloat);
  spec.channelnames = channels;
  std::vector<float> values;
  for (std::size_t k = 0; k < channels.size(); ++k)
  {
    values.push_back(static_cast<float>(k + 1));
  }
  CHECK(WriteFile(name, spec, values));
}

void TestChannels()
{
  const std::string name = Directory + "layers.exr";
  Layers(name,
    { "View.Combined.R", "View.Combined.G", "View.Combined.B", "View.Combined.A", "View.Depth.Z",
      "View.Mist.Z", "View.Index.X" });
  vtkNew<vtkOpenImageIOReader> reader;
  MessageKeeper messages(reader);
  reader->SetFileName(name.c_str());
  reader->Update();
  CHECK(messages.Silent() && reader->GetNumberOfFileChannels() == 7);
  CHECK(reader->GetFileChannelName(4) == "View.Depth.Z" && reader->GetFileChannelName(7).empty());
  CHECK(reader->GetOutput()->GetNumberOfScalarComponents() == 7);
  const std::pair<const char*, double> chosen[] = { { "View.Depth.Z", 5.0 }, { "Depth.Z", 5.0 },
    { "Mist.Z", 6.0 }, { "X", 7.0 }, { "View.Combined.A", 4.0 } };
  for (const auto& choice : chosen)
  {
    for (const bool alphaAsMask : { false, true })
    {
      reader->SetChannelName(choice.first);
      reader->SetAlphaAsMask(alphaAsMask);
      reader->Update();
      CHECK(messages.Silent() && reader->GetOutput()->GetNumberOfScalarComponents() == 1);
      CHECK(Value(reader->GetOutput(), 0, 0, 0) == choice.second);
      CHECK(Value(reader->GetMaskOutput(), 0, 0, 0) == 255.0);
    }
  }
  // Two end with Z, none is called depth.
  for (const char* wrong : { "Z", "depth", "epth.Z" })
  {
    reader->SetChannelName(wrong);
    reader->Update();
    CHECK(messages.OneError("it has no channel \"" + std::string(wrong) + "\", or several, of "));
    CHECK(reader->GetErrorCode() == vtkErrorCode::FileFormatError);
    CHECK(reader->GetErrorReason().find("View.Combined.R, View") != std::string::npos);
  }
  reader->SetChannelName(std::string(9999, 'x').c_str());
  reader->Update();
  CHECK(messages.OneError("...") && reader->GetErrorReason().size() < 180);
  // What is written is not what is asked for: it can be read all the same.
  CHECK(reader->CanReadFile(name.c_str()) == 2);
}

void TestParts()
{
  const std::string name = Directory + "parts.exr";
  std::vector<ImageSpec> specs(3, ImageSpec(1, 1, 1, OIIO::TypeFloat));
  const char* const parts[] = { "Combined", "Depth", "Index" };
  const char* const channels[] = { "Y", "Depth.Z", "Index.X" };
  for (int k = 0; k < 3; ++k)
  {
    specs[k].channelnames = { channels[k] };
    specs[k].attribute("oiio:subimagename", parts[k]);
  }
  auto output = OIIO::ImageOutput::create(name);
  CHECK(output->open(name, 3, specs.data()));
  for (int k = 0; k < 3; ++k)
  {
    CHECK(k == 0 || output->open(name, specs[k], OIIO::ImageOutput::AppendSubimage));
    const float value = 10.0f + k;
    CHECK(output->write_image(OIIO::TypeFloat, &value));
  }
  output->close();
  output->geterror();

  vtkNew<vtkOpenImageIOReader> reader;
  MessageKeeper messages(reader);
  reader->SetFileName(name.c_str());
  for (int k = 0; k < 3; ++k)
  {
    reader->SetSubimageName(parts[k]);
    reader->Update();
    CHECK(messages.Silent() && Value(reader->GetOutput(), 0, 0, 0) == 10.0 + k);
  }
  reader->SetSubimageName("depth");
  reader->Update();
  CHECK(messages.OneError("it has no part \"depth\", only Combined, Depth, Index"));
  reader->SetSubimageName("Combined");
  reader->SetChannelName("Z");
  reader->Update();
  CHECK(messages.OneError("no channel \"Z\""));
  // Without a part, any may have the channel.
  reader->SetSubimageName(nullptr);
  reader->Update();
  CHECK(messages.Silent() && Value(reader->GetOutput(), 0, 0, 0) == 11.0);
  reader->SetChannelName("X");
  reader->Update();
  CHECK(messages.Silent() && Value(reader->GetOutput(), 0, 0, 0) == 12.0);
  reader->SetChannelName("W");
  reader->Update();
  CHECK(messages.OneError("no channel \"W\""));
}

// Two pixels, half and quite transparent. What is stored, and what the colour is.
template <typename T>
void CheckAlpha(const std::string& extension, bool premultiplied, std::array<T, 8> stored,
  std::array<double, 8> straight)
{
  const std::string name = Directory + "alpha." + extension;
  ImageSpec spec(2, 1, 4, OIIO::BaseTypeFromC<T>::value);
  spec.attribute("oiio:UnassociatedAlpha", premultiplied ? 0 : 1);
  CHECK(WriteFile(name, spec, std::vector<T>(stored.begin(), stored.end())));
  vtkNew<vtkOpenImageIOReader> reader;
  MessageKeeper messages(reader);
  reader->SetFileName(name.c_str());
  for (const bool asked : { false, true })
  {
    reader->SetStraightAlpha(asked);
    reader->Update();
    for (int c = 0; c < 8 && messages.Silent(); ++c)
    {
      const double expected = asked ? straight[c] : static_cast<double>(stored[c]);
      CHECK(Near(Value(reader->GetOutput(), c / 4, 0, c % 4), expected));
    }
    CHECK(messages.Silent());
  }
}

void TestAlpha()
{
  // Light without a cover, and a cover above 1, stay as they are.
  CheckAlpha<float>("exr", true, { 0.5f, 0.25f, 0.0f, 0.5f, 0.3f, 0.2f, 0.1f, 0.0f },
    { 1.0, 0.5, 0.0, 0.5, 0.3f, 0.2f, 0.1f, 0.0 });
  CheckAlpha<float>("exr", true, { 3.0f, 0.25f, 0.0f, 0.5f, 0.3f, 0.2f, 0.1f, 2.0f },
    { 6.0, 0.5, 0.0, 0.5, 0.3f, 0.2f, 0.1f, 2.0 });
  CheckAlpha<unsigned char>(
    "tif", true, { 128, 64, 0, 128, 9, 8, 7, 0 }, { 255, 128, 0, 128, 9, 8, 7, 0 });
  // A colour above its alpha is the brightest that there is.
  CheckAlpha<unsigned short>("tif", true, { 30000, 15000, 0, 30000, 9, 8, 7, 1 },
    { 65535, 32768, 0, 30000, 65535, 65535, 65535, 1 });
  CheckAlpha<unsigned char>(
    "tif", false, { 128, 64, 0, 128, 9, 8, 7, 0 }, { 128, 64, 0, 128, 9, 8, 7, 0 });
  CheckAlpha<unsigned char>(
    "png", false, { 128, 64, 0, 128, 9, 8, 7, 0 }, { 128, 64, 0, 128, 9, 8, 7, 0 });
  // Depth is no colour.
  const std::string name = Directory + "depth.exr";
  Layers(name, { "R", "G", "B", "A", "Z" });
  ImageSpec spec(1, 1, 5, OIIO::TypeFloat);
  spec.channelnames = { "R", "G", "B", "A", "Z" };
  CHECK(WriteFile(name, spec, std::vector<float>{ 0.5f, 0.5f, 0.5f, 0.5f, 700.0f }));
  vtkNew<vtkOpenImageIOReader> reader;
  reader->SetFileName(name.c_str());
  reader->StraightAlphaOn();
  reader->SetChannelName("Z");
  reader->Update();
  CHECK(Value(reader->GetOutput(), 0, 0, 0) == 700.0);
  reader->SetChannelName("G");
  reader->Update();
  CHECK(Value(reader->GetOutput(), 0, 0, 0) == 1.0);
}

// A picture of 3 x 2 pixels in one of Radiance's orders: red is 1 and more by the column, green by
// the row from the top.
void WriteRadiance(
  const std::string& name, const std::string& lines, char first, bool firstUp, bool secondUp)
{
  const int size[2] = { 3, 2 };
  const int outer = first == 'X' ? 0 : 1;
  std::string pixels;
  for (int a = 0; a < size[outer]; ++a)
  {
    for (int b = 0; b < size[1 - outer]; ++b)
    {
      // + is to the right, and upward.
      const int x = outer == 0 ? (firstUp ? a : 2 - a) : (secondUp ? b : 2 - b);
      const int up = outer == 1 ? (firstUp ? a : 1 - a) : (secondUp ? b : 1 - b);
      const int top = 1 - up;
      // The exponent stands for 8 of 256.
      const char pixel[] = { static_cast<char>(32 * (x + 1)), static_cast<char>(32 * (top + 1)), 0,
        static_cast<char>(128 + 3) };
      pixels.append(pixel, 4);
    }
  }
  const auto axis = [&size](bool up, int which)
  { return std::string(up ? "+" : "-") + "XY"[which] + " " + std::to_string(size[which]); };
  WriteText(name,
    "#?RADIANCE\n" + lines + "\n" + axis(firstUp, outer) + " " + axis(secondUp, 1 - outer) + "\n" +
      pixels);
}

void TestRadiance()
{
  const std::string name = Directory + "order.hdr";
  const std::string format = "FORMAT=32-bit_rle_rgbe\n";
  vtkNew<vtkOpenImageIOReader> reader;
  MessageKeeper messages(reader);
  reader->SetFileName(name.c_str());
  const auto holds = [&](double red, double green)
  {
    reader->Modified();
    reader->Update();
    vtkImageData* image = reader->GetOutput();
    bool same =
      messages.Silent() && image->GetDimensions()[0] == 3 && image->GetDimensions()[1] == 2;
    for (int i = 0; same && i < 3; ++i)
    {
      for (int j = 0; j < 2; ++j)
      {
        same = same && Near(Value(image, i, j, 0), (i + 1) / red, 0.02 / red) &&
          Near(Value(image, i, j, 1), (2 - j) / green, 0.02 / green);
      }
    }
    return same;
  };
  for (int order = 0; order < 8; ++order)
  {
    WriteRadiance(name, format, (order & 1) != 0 ? 'X' : 'Y', (order & 2) != 0, (order & 4) != 0);
    CHECK(holds(1.0, 1.0));
  }
  // Exposures multiply one another; what is none is passed over.
  const std::pair<const char*, std::array<double, 2>> exposures[] = {
    { "EXPOSURE=4.0\n", { 4.0, 4.0 } }, { "EXPOSURE= 4\nEXPOSURE=0.5\n", { 2.0, 2.0 } },
    { "COLORCORR=2 0.5 1\n", { 2.0, 0.5 } }, { "EXPOSURE=bright\nEXPOSURE=-1\n", { 1.0, 1.0 } }
  };
  for (const auto& exposure : exposures)
  {
    WriteRadiance(name, exposure.first + format, 'Y', false, true);
    CHECK(holds(exposure.second[0], exposure.second[1]));
  }
  WriteRadiance(name, "FORMAT=32-bit_rle_xyze\n", 'Y', false, true);
  reader->Modified();
  reader->Update();
  CHECK(messages.OneError("its FORMAT is 32-bit_rle_xyze (CIE's XYZ)"));
}
}

int TestOpenImageIOReaderChannels(int argc, char* argv[])
{
  Directory = EmptyDirectory(argc, argv, "TestOpenImageIOReaderChannels");
  TestChannels();
  TestParts();
  TestAlpha();
  TestRadiance();
  return Failures;
}
