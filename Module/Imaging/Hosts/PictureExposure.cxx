// SPDX-License-Identifier: BSD-3-Clause
#include "PictureExposure.h"

#include "vtkReliefScene.h"
#include "vtkReliefThreads.h"

#include "AutomaticExposure.h"

namespace relief::hosts
{

//------------------------------------------------------------------------------
PictureExposure FindExposure(
  vtkReliefScene* scene, const HeightField& field, const Scene& converted)
{
  PictureExposure result;
  result.stops = converted.exposure;
  if (scene->GetAutomaticExposure() && field.HasData())
  {
    AutomaticExposure exposure(field, converted);
    vtkReliefFor(0, exposure.GetNumberOfTiles(), 1,
      [&](vtkIdType begin, vtkIdType end)
      { exposure.Measure(static_cast<int>(begin), static_cast<int>(end)); });
    result.stops = exposure.GetStops();
    result.rays = exposure.GetShading().GetRaysTraced();
    result.cells = exposure.GetShading().GetCellsVisited();
  }
  return result;
}
}
