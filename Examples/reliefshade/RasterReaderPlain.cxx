// SPDX-License-Identifier: BSD-3-Clause
#include "EsriGrid.h"
#include "Picture.h"
#include "RasterReader.h"

#include "vtkMath.h"

namespace reliefshade
{

//------------------------------------------------------------------------------
bool readReferenced(
  const std::string& file, const ReadOptions& options, const MemoryPlan& plan, Raster& raster)
{
  if (!isEsriGrid(file))
  {
    return false;
  }
  const EsriGrid grid = readEsriGrid(file, plan);
  raster.Heights = grid.Heights;
  raster.NoData = grid.NoData;
  raster.Reference.Present = true;
  raster.Reference.Transform = grid.Transform;
  placeOnMap(raster);
  raster.Spacing = raster.MapStep;
  if (options.Degrees || hasGeographicProjection(file))
  {
    // Other ellipsoids than WGS 84's make a difference of less than a thousandth.
    spaceByDegrees(raster, vtkMath::RadiansFromDegrees(1.0), Wgs84Radius, Wgs84InverseFlattening);
  }
  return true;
}

//------------------------------------------------------------------------------
bool readReferencedPicture(const std::string&, MemoryBudget&, Picture&)
{
  return false;
}

//------------------------------------------------------------------------------
bool sameReferenceSystem(const std::string&, const std::string&)
{
  return true;
}

}
