// SPDX-License-Identifier: BSD-3-Clause
// vtkOpenImageIOReader over files of any content: the picture that the header promises or an error,
// and neither more memory than allowed nor a value that was not read.
#include "FuzzInput.h"
#include "FuzzMessages.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkOpenImageIOReader.h"
#include "vtkPointData.h"

namespace
{
struct Format
{
  const char* Extension;
  std::size_t At;
  std::string Begin;
};

// The formats that vtkOpenImageIOReader.h answers for, by what files begin with.
std::string ExtensionOf(const std::string& bytes)
{
  static const Format formats[] = { { ".png", 0, "\x89PNG" },
    { ".tif", 0, std::string("II*\0", 4) }, { ".tif", 0, std::string("MM\0*", 4) },
    { ".tif", 0, std::string("II+\0", 4) }, { ".exr", 0, "\x76\x2f\x31\x01" },
    { ".jpg", 0, "\xff\xd8\xff" }, { ".hdr", 0, "#?RADIANCE" }, { ".hdr", 0, "#?RGBE" },
    { ".pfm", 0, "PF" }, { ".pfm", 0, "Pf" }, { ".pgm", 0, "P2" }, { ".ppm", 0, "P3" },
    { ".pgm", 0, "P5" }, { ".ppm", 0, "P6" }, { ".pbm", 0, "P1" }, { ".pbm", 0, "P4" },
    { ".bmp", 0, "BM" }, { ".gif", 0, "GIF8" }, { ".jp2", 4, "jP  " } };
  for (const Format& format : formats)
  {
    if (bytes.compare(format.At, format.Begin.size(), format.Begin) == 0)
    {
      return format.Extension;
    }
  }
  return std::string();
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string extension =
    size > 16 ? ExtensionOf(std::string(reinterpret_cast<const char*>(data), 16)) : std::string();
  if (extension.empty())
  {
    return 0;
  }
  FuzzMessages messages;
  const FuzzFile file(extension, data, size);
  // The last byte, which few formats need, chooses how the file is read.
  const int choice = data[size - 1];
  vtkNew<vtkOpenImageIOReader> reader;
  // A decoder may need its memory for the header already.
  reader->SetMemoryLimit(64 * 1024);
  reader->CanReadFile(file.Name().c_str());
  reader->SetFileName(file.Name().c_str());
  reader->SetAlphaAsMask(choice & 1);
  reader->SetSubimage(choice >> 1 & 3);
  reader->SetMipLevel(choice >> 3 & 1);
  reader->Update();
  vtkImageData* image = reader->GetOutput();
  if (reader->GetErrorCode() != 0)
  {
    FUZZ_CHECK(messages.Count() == 1);
    FUZZ_CHECK(image->GetNumberOfPoints() == 0);
    FUZZ_CHECK(reader->GetMaskOutput()->GetNumberOfPoints() == 0);
    return 0;
  }
  FUZZ_CHECK(messages.Count() == 0);
  FUZZ_CHECK(image->GetNumberOfPoints() > 0);
  FUZZ_CHECK(
    image->GetPointData()->GetScalars()->GetNumberOfTuples() == image->GetNumberOfPoints());
  FUZZ_CHECK(reader->GetMaskOutput()->GetNumberOfPoints() == image->GetNumberOfPoints());
  return 0;
}
