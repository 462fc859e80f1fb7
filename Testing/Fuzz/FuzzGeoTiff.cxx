// SPDX-License-Identifier: BSD-3-Clause
// GeoTIFF files of any content, as heights and as pictures that lie on a map.
#include "FuzzInput.h"

#include "Failure.h"
#include "MessageLog.h"
#include "RasterFiles.h"
#include "ReferencedPicture.h"

extern "C" int LLVMFuzzerInitialize(int*, char***)
{
  reliefshade::catchMessages();
  relief::raster::KeepGdalQuiet();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string begin(reinterpret_cast<const char*>(data), size < 4 ? size : 4);
  if (begin != std::string("II*\0", 4) && begin != std::string("MM\0*", 4) &&
    begin != std::string("II+\0", 4) && begin != std::string("MM\0+", 4))
  {
    return 0;
  }
  reliefshade::MemoryBudget budget(64.0 * 1024.0 * 1024.0, "the fuzzer");
  const FuzzFile file(".tif", data, size);
  reliefshade::ReadOptions options;
  const int choice = data[size - 1];
  options.Band = choice & 3;
  options.Degrees = (choice & 4) != 0;
  reliefshade::takeError();
  try
  {
    const reliefshade::Raster raster = reliefshade::readRaster(file.Name(), options, budget);
    FUZZ_CHECK(raster.Heights->GetNumberOfPoints() > 0);
    FUZZ_CHECK(raster.Heights->GetNumberOfScalarComponents() == 1);
    FUZZ_CHECK(raster.Spacing[0] > 0.0 && raster.Spacing[1] > 0.0);
    FUZZ_CHECK(
      !raster.Mask || raster.Mask->GetNumberOfPoints() == raster.Heights->GetNumberOfPoints());
    const vtkSmartPointer<vtkImageData> picture =
      reliefshade::readTexture(file.Name(), raster, budget);
    FUZZ_CHECK(picture->GetNumberOfPoints() > 0);
  }
  catch (const reliefshade::Failure&)
  {
  }
  return 0;
}
