// SPDX-License-Identifier: BSD-3-Clause
// How a build without OpenImageIO reads an environment's picture: Radiance alone, bit for bit as a
// build with OpenImageIO does.
#include "EnvironmentPicture.h"
#include "FileTestUtilities.h"

#if defined(RELIEF_USE_OPENIMAGEIO)
#include "vtkOpenImageIOReader.h"
#include "vtkOpenImageIOWriter.h"
#endif

#include <array>
#include <random>

using relief::io::EnvironmentPicture;
using relief::io::ReadEnvironmentPicture;

namespace
{
int Failures = 0;
std::string Folder;

std::string Pixels(int count, unsigned int seed)
{
  std::mt19937 random(seed);
  std::string bytes;
  for (int i = 0; i < count; ++i)
  {
    // No first pixel that would begin a compressed line.
    for (int c = 0; c < 3; ++c)
    {
      bytes += static_cast<char>(3 + random() % 253);
    }
    bytes += static_cast<char>(100 + random() % 50);
  }
  return bytes;
}

std::string Put(const std::string& name, const std::string& content)
{
  WriteText(Folder + name, content);
  return Folder + name;
}

const float* Colors(vtkImageData* image)
{
  return static_cast<const float*>(image->GetScalarPointer());
}

//------------------------------------------------------------------------------
/// The numbers of the upper row come last, each divided by the exposures of the header.
void TestNumbers()
{
  const std::string bytes = Pixels(16 * 5, 1);
  const std::string name = Put("plain.hdr",
    "#?RADIANCE\n# somebody's\nEXPOSURE=2.5\nEXPOSURE=3\nCOLORCORR=1 2 "
    "0.5\nFORMAT=32-bit_rle_rgbe\n"
    "\n-Y 5 +X 16\n" +
      bytes);
  const EnvironmentPicture picture = ReadEnvironmentPicture(name);
  CHECK(picture.Reason.empty());
  CHECK(picture.Image && picture.Image->GetNumberOfPoints() == 80 &&
    picture.Image->GetNumberOfScalarComponents() == 3 &&
    picture.Image->GetScalarType() == VTK_FLOAT);
  if (Failures)
  {
    return;
  }
  const std::array<double, 3> exposure{ 7.5, 15.0, 3.75 };
  for (int i = 0; i < 80; ++i)
  {
    const int file = (4 - i / 16) * 16 + i % 16;
    const auto byte = [&](int c) { return static_cast<unsigned char>(bytes[4 * file + c]); };
    for (int c = 0; c < 3; ++c)
    {
      const float stored = std::ldexp(static_cast<float>(byte(c)), byte(3) - 136);
      CHECK(Colors(picture.Image)[3 * i + c] == static_cast<float>(stored / exposure[c]));
    }
  }
}

//------------------------------------------------------------------------------
/// What another build reads is the same, compressed lines and headers of all kinds.
void TestAgreement()
{
#if defined(RELIEF_USE_OPENIMAGEIO)
  vtkNew<vtkImageData> image;
  image->SetDimensions(40, 20, 1);
  image->AllocateScalars(VTK_FLOAT, 3);
  std::mt19937 random(2);
  auto* numbers = static_cast<float*>(image->GetScalarPointer());
  for (int i = 0; i < 2400; ++i)
  {
    numbers[i] = i % 7 < 4 ? 0.5f : std::ldexp(static_cast<float>(random() % 1000), -10);
  }
  vtkNew<vtkOpenImageIOWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName((Folder + "written.hdr").c_str());
  writer->Write();
  Put("rgbe.hdr",
    "#?RGBE\nGAMMA=2.2\nEXPOSURE=0.3\nFORMAT=32-bit_rle_rgbe\n\n-Y 3 +X 4\n" + Pixels(12, 3));
  Put("aspect.hdr",
    "#?RADIANCE\nPIXASPECT=2\nFORMAT=32-bit_rle_rgbe\nCOLORCORR=1 2 3\nEXPOSURE=7\n\n-Y 4 +X 3\n" +
      Pixels(12, 4));
  for (const char* name : { "written.hdr", "rgbe.hdr", "aspect.hdr" })
  {
    std::cout << "  " << name << std::endl;
    vtkNew<vtkOpenImageIOReader> reader;
    reader->SetFileName((Folder + name).c_str());
    reader->Update();
    const EnvironmentPicture picture = ReadEnvironmentPicture(Folder + name);
    const vtkIdType points = reader->GetOutput()->GetNumberOfPoints();
    CHECK(points > 0 && picture.Image && picture.Image->GetNumberOfPoints() == points);
    CHECK(picture.Image &&
      std::memcmp(Colors(picture.Image), Colors(reader->GetOutput()),
        static_cast<std::size_t>(points) * 3 * sizeof(float)) == 0);
  }
#endif
}

//------------------------------------------------------------------------------
void Refused(const std::string& name, const std::string& text)
{
  const EnvironmentPicture picture = ReadEnvironmentPicture(name);
  if (picture.Image || picture.Reason.find(text) == std::string::npos ||
    picture.Reason.size() > 200)
  {
    std::cout << name << ": \"" << picture.Reason << "\"" << std::endl;
    ++Failures;
  }
}

void TestRefusals()
{
  Refused(Folder + "absent.hdr", "does not exist");
  Refused(Folder, "folder");
  Refused(Put("picture.png", "\x89PNG\r\n\x1a\n"), "no Radiance picture");
  Refused(Put("empty.hdr", ""), "no Radiance picture");
  const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n";
  const std::string bytes = Pixels(32, 5);
  for (const char* order : { "+Y 4 +X 8", "-Y 4 -X 8", "+X 8 -Y 4", "-X 8 +Y 4" })
  {
    Refused(Put("turned.hdr", head + order + "\n" + bytes), "turn it upright");
  }
  Refused(Put("xyz.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 4 +X 8\n" + bytes), "ra_xyze");
  Refused(Put("huge.hdr", head + "-Y 2000000 +X 2000000\n" + bytes), "memory");
  for (const char* size : { "-Y 0 +X 8", "-Y -4 +X 8", "-Y a +X b", "-Y 99999999999 +X 8", "" })
  {
    Refused(Put("size.hdr", head + size + "\n" + bytes), "damaged");
  }
  for (std::size_t length : { std::size_t(0), std::size_t(1), bytes.size() / 2, bytes.size() - 1 })
  {
    Refused(Put("short.hdr", head + "-Y 4 +X 8\n" + bytes.substr(0, length)), "ends early");
  }
  // A compressed line that is longer than the picture is wide.
  Refused(Put("run.hdr",
            head + "-Y 2 +X 8\n\x02\x02" + std::string(1, '\0') + "\x08\xff\x01" +
              std::string(64, '\x70')),
    "damaged");
  Refused(Put("head.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe"), "damaged");
}
}

//------------------------------------------------------------------------------
int TestEnvironmentPicturePlain(int argc, char* argv[])
{
  Folder = EmptyDirectory(argc, argv, "TestEnvironmentPicturePlain");
  TestNumbers();
  TestAgreement();
  TestRefusals();
  return Failures ? EXIT_FAILURE : EXIT_SUCCESS;
}
