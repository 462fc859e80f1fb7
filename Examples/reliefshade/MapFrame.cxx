// SPDX-License-Identifier: BSD-3-Clause
#include "MapFrame.h"

#include "vtkCollectionRange.h"
#include "vtkImageReliefShading.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkReliefScene.h"

#include <cmath>
#include <sstream>

namespace
{

template <class Change>
void changeLamps(vtkReliefScene* scene, const Change& change)
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

namespace reliefshade
{

//------------------------------------------------------------------------------
void placeHeights(Raster& raster)
{
  if (!raster.Reference.Present)
  {
    raster.MapStep = raster.Spacing;
  }
  for (vtkImageData* image : { raster.Heights.Get(), raster.Mask.Get() })
  {
    if (image)
    {
      image->SetOrigin(0.0, 0.0, 0.0);
      image->SetSpacing(raster.Spacing[0], raster.Spacing[1], 1.0);
    }
  }
}

//------------------------------------------------------------------------------
void setHeights(const Raster& raster, vtkImageReliefShading* shading)
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
MapFrame::MapFrame(const Raster& raster)
  : Origin(raster.MapOrigin)
  , Step(raster.MapStep)
  , Spacing(raster.Spacing)
  , HeightUnit(raster.HeightUnit)
{
}

//------------------------------------------------------------------------------
double MapFrame::CoordinateToHeights(int axis, double value) const
{
  return (value - this->Origin[axis]) / this->Step[axis] * this->Spacing[axis];
}

//------------------------------------------------------------------------------
double MapFrame::CoordinateToMap(int axis, double value) const
{
  const double exact = this->Origin[axis] + value / this->Spacing[axis] * this->Step[axis];
  const double perUnit = std::pow(10.0, 6.0 - std::floor(std::log10(this->Step[axis])));
  const double rounded = std::round(exact * perUnit) / perUnit;
  return std::isfinite(rounded) ? rounded : exact;
}

//------------------------------------------------------------------------------
void MapFrame::ToHeights(vtkReliefScene* scene) const
{
  scene->SetHeightScale(scene->GetHeightScale() * this->HeightUnit);
  changeLamps(
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
  changeLamps(scene, [this](int axis, double value) { return this->CoordinateToMap(axis, value); });
}

}
