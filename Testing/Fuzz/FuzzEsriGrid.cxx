// SPDX-License-Identifier: BSD-3-Clause
// ESRI ASCII grids of any content, by reliefshade's own reader and by the way the program takes.
#include "FuzzInput.h"

#include "EsriGrid.h"
#include "Failure.h"
#include "MemoryBudget.h"
#include "MessageLog.h"
#include "RasterReader.h"

#include <stdexcept>

extern "C" int LLVMFuzzerInitialize(int*, char***)
{
  reliefshade::catchMessages();
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  reliefshade::MemoryBudget budget(64.0 * 1024.0 * 1024.0);
  const FuzzFile file(".asc", data, size);
  bool own = false;
  if (reliefshade::isEsriGrid(file.Name()))
  {
    try
    {
      const reliefshade::EsriGrid grid =
        reliefshade::readEsriGrid(file.Name(), reliefshade::MemoryPlan{ budget });
      FUZZ_CHECK(grid.Heights->GetNumberOfPoints() > 0);
      own = true;
    }
    catch (const std::runtime_error&)
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
