// SPDX-License-Identifier: BSD-3-Clause
#include "PictureExposure.h"

#include "vtkReliefScene.h"
#include "vtkReliefThreads.h"

#include "AutomaticExposure.h"

#include <algorithm>
#include <vector>

namespace relief::hosts
{
namespace
{
// Of a field that is filled as it is needed, so many are filled for at a time.
constexpr int TilesAtOnce = 16;

//------------------------------------------------------------------------------
std::vector<HeightSupply::Window> WindowsOf(
  const AutomaticExposure& exposure, const HeightView<float>& heights, int begin, int end)
{
  std::vector<HeightSupply::Window> windows;
  for (int tile = begin; tile < end; ++tile)
  {
    const int i = exposure.GetFirstColumn(tile);
    const int j = exposure.GetFirstRow(tile);
    windows.push_back({ i, std::min(i + SweepThickness::TileWidth, heights.columns), j,
      std::min(j + SweepThickness::TileHeight, heights.rows) });
  }
  return windows;
}
}

//------------------------------------------------------------------------------
PictureExposure FindExposure(vtkReliefScene* scene, const HeightField& field,
  const Scene& converted, const WindowProvider& provide, bool sparing)
{
  PictureExposure result;
  result.stops = converted.exposure;
  if (!scene->GetAutomaticExposure() || !field.HasData())
  {
    return result;
  }
  AutomaticExposure exposure(field, converted);
  const int count = exposure.GetNumberOfTiles();
  const int step = !provide ? std::max(count, 1) : sparing ? 1 : TilesAtOnce;
  for (int first = 0; first < count; first += step)
  {
    const int last = std::min(first + step, count);
    if (provide)
    {
      exposure.GetShading().SetOutline(
        provide(WindowsOf(exposure, field.GetField().heights, first, last)));
    }
    vtkReliefFor(first, last, 1,
      [&](vtkIdType begin, vtkIdType end)
      { exposure.Measure(static_cast<int>(begin), static_cast<int>(end)); });
    result.error.Add(exposure.GetShading().GetOutlineError());
  }
  result.stops = exposure.GetStops();
  result.rays = exposure.GetShading().GetRaysTraced();
  result.cells = exposure.GetShading().GetCellsVisited();
  return result;
}
}
