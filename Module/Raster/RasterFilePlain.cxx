// SPDX-License-Identifier: BSD-3-Clause
#include "EsriGrid.h"
#include "RasterFile.h"
#include "ReferencedPicture.h"

#include "vtkErrorCode.h"
#include "vtkMath.h"

namespace relief::raster
{
namespace
{
class EsriRaster : public RasterFile
{
public:
  EsriRaster(const std::string& file, const ReadOptions& options)
    : Name(file)
  {
    this->Header = ReadEsriHeader(file);
    PlaceOnMap(this->Header);
    if (options.Degrees || HasGeographicProjection(file))
    {
      // Other ellipsoids than WGS 84's make a difference of less than a thousandth.
      SpaceByDegrees(
        this->Header, vtkMath::RadiansFromDegrees(1.0), Wgs84Radius, Wgs84InverseFlattening);
    }
  }

  Raster Read(const MemoryPlan& plan, const io::StepWatcher& watcher) override
  {
    Raster raster;
    static_cast<RasterHeader&>(raster) = this->Header;
    raster.Heights = ReadEsriHeights(this->Name, plan, watcher);
    return raster;
  }

  bool HasWindows() const override { return true; }

  Raster ReadWindow(const Window& window) override
  {
    Raster raster;
    static_cast<RasterHeader&>(raster) = this->Header;
    raster.Columns = window.i1 - window.i0;
    raster.Rows = window.j1 - window.j0;
    this->Grid = this->Grid ? this->Grid : EsriRows::Of(this->Name);
    raster.Heights = this->Grid->Read(window);
    return raster;
  }

private:
  std::string Name;
  std::shared_ptr<const EsriRows> Grid; // once windows are read
};
}

//------------------------------------------------------------------------------
std::unique_ptr<RasterFile> OpenRaster(const std::string& file, const ReadOptions& options)
{
  if (!IsEsriGrid(file))
  {
    return nullptr;
  }
  if (options.Band > 1)
  {
    throw io::Failure(
      vtkErrorCode::FileFormatError, "it has no band " + std::to_string(options.Band) + ", only 1");
  }
  return std::make_unique<EsriRaster>(file, options);
}

//------------------------------------------------------------------------------
std::vector<std::string> FilesOf(const std::string&)
{
  return {};
}

//------------------------------------------------------------------------------
bool ReadReferencedPicture(
  const std::string&, MemoryBudget&, const io::StepWatcher&, ReferencedPicture&)
{
  return false;
}

//------------------------------------------------------------------------------
bool SameReferenceSystem(const std::string&, const std::string&)
{
  return true;
}

//------------------------------------------------------------------------------
void KeepGdalQuiet() {}
}
