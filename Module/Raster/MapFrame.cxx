// SPDX-License-Identifier: BSD-3-Clause
#include "MapFrame.h"

#include "vtkCollectionRange.h"
#include "vtkImageReliefShading.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkReliefScene.h"

#include <cmath>
#include <sstream>

namespace relief::raster
{
namespace
{
template <class Change>
void ChangeLamps(vtkReliefScene* scene, const Change& change)
{
  for (vtkLight* light : vtk::Range(scene->GetLights()))
  {
    if (light->GetPositional())
    {
      double position[3];
      light->GetPosition(position);
      position[0] = change(0, position[0]);
      position[1] = change(1, position[1]);
      light->SetPosition(position);
    }
  }
}
}

//------------------------------------------------------------------------------
void SetHeights(const Raster& raster, vtkImageReliefShading* shading)
{
  shading->SetInputData(raster.Heights);
  if (raster.Mask)
  {
    shading->SetMaskData(raster.Mask);
  }
  if (raster.NoData)
  {
    shading->SetNoDataValue(*raster.NoData);
  }
}

//------------------------------------------------------------------------------
MapFrame::MapFrame(const RasterHeader& raster)
  : Origin(raster.MapOrigin)
  , Step(raster.MapStep)
  , Scale(raster.MetersPerUnit)
  , HeightUnit(raster.HeightUnit)
{
}

//------------------------------------------------------------------------------
double MapFrame::CoordinateToHeights(int axis, double value) const
{
  return (value - this->Origin[axis]) * this->Scale[axis];
}

//------------------------------------------------------------------------------
double MapFrame::CoordinateToMap(int axis, double value) const
{
  const double exact = this->Origin[axis] + value / this->Scale[axis];
  const double perUnit = std::pow(10.0, 6.0 - std::floor(std::log10(this->Step[axis])));
  const double rounded = std::round(exact * perUnit) / perUnit;
  return std::isfinite(rounded) ? rounded : exact;
}

//------------------------------------------------------------------------------
void MapFrame::ToHeights(vtkReliefScene* scene) const
{
  scene->SetHeightScale(scene->GetHeightScale() * this->HeightUnit);
  ChangeLamps(
    scene, [this](int axis, double value) { return this->CoordinateToHeights(axis, value); });
}

//------------------------------------------------------------------------------
void MapFrame::ToMap(vtkReliefScene* scene) const
{
  // Multiplied and divided, a number may have lost its last digit.
  std::stringstream decimal;
  decimal.precision(15);
  decimal << scene->GetHeightScale() / this->HeightUnit;
  double heightScale;
  decimal >> heightScale;
  scene->SetHeightScale(heightScale);
  ChangeLamps(scene, [this](int axis, double value) { return this->CoordinateToMap(axis, value); });
}
}
