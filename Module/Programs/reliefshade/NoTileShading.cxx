// SPDX-License-Identifier: BSD-3-Clause

// What stands for TileShading.cxx in a build that has no rasters to read as they are needed.

#include "TileShading.h"

#include "Failure.h"
#include "Options.h"

namespace relief::streaming
{
class PiecePlan
{
};

class TileStore
{
};
}

namespace reliefshade
{

//------------------------------------------------------------------------------
bool readsAsNeeded(
  const Options& options, const ReadOptions&, std::unique_ptr<relief::raster::RasterFile>&)
{
  if (options.Memory > 0.0)
  {
    throw Failure("--memory",
      "this program is built without the module for heights that do not fit into memory",
      UsageFailure);
  }
  return false;
}

//------------------------------------------------------------------------------
Raster readAsNeeded(const Options&)
{
  throw Failure("--memory", "heights in memory are expected");
}

//------------------------------------------------------------------------------
bool isTiled(const Raster&)
{
  return false;
}

//------------------------------------------------------------------------------
TileShading::TileShading(
  const Options& options, const Raster& raster, vtkImageReliefShading* shading, double)
  : Given(options)
  , Heights(raster)
  , Shading(shading)
{
}

//------------------------------------------------------------------------------
TileShading::~TileShading() = default;

//------------------------------------------------------------------------------
void TileShading::ShadeShare(const RunPart&, ShadingReport&) {}

//------------------------------------------------------------------------------
void TileShading::HandOver(bool, ShadingReport&, const std::function<void(vtkImageData*)>&) const {}

//------------------------------------------------------------------------------
const std::vector<std::array<int, 6>>& TileShading::GetPieces() const
{
  static const std::vector<std::array<int, 6>> none;
  return none;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> TileShading::LoadLayer(const int*, const std::string&) const
{
  return nullptr;
}

//------------------------------------------------------------------------------
void TileShading::Finish() {}

}
