// SPDX-License-Identifier: BSD-3-Clause
// ESRI ASCII grids of any content, by the library's own reader and by the way the program takes.
#include "FuzzInput.h"

#include "EsriGrid.h"
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
  reliefshade::MemoryBudget budget(64.0 * 1024.0 * 1024.0, "the fuzzer");
  const FuzzFile file(".asc", data, size);
  bool own = false;
  if (relief::raster::IsEsriGrid(file.Name()))
  {
    try
    {
      const auto heights = relief::raster::ReadEsriHeights(file.Name(), { budget }, nullptr);
      FUZZ_CHECK(heights->GetNumberOfPoints() > 0);
      own = true;
    }
    catch (const relief::io::Failure&)
    {
    }
    reliefshade::takeError();
    try
    {
      const reliefshade::Raster raster =
        reliefshade::readRaster(file.Name(), reliefshade::ReadOptions(), budget);
      FUZZ_CHECK(raster.Heights->GetNumberOfPoints() > 0);
      FUZZ_CHECK(own);
      FUZZ_CHECK(raster.Spacing[0] > 0.0 && raster.Spacing[1] > 0.0);
    }
    catch (const reliefshade::Failure&)
    {
    }
  }
  return 0;
}
