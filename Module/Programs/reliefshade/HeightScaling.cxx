// SPDX-License-Identifier: BSD-3-Clause
#include "HeightScaling.h"

#include "HeightScale.h"
#include "MessageLog.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkReliefScene.h"
#include "vtkReliefStepSmoothing.h"

#include <algorithm>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace
{

using reliefshade::Raster;

// A fitting scale so far from 1 means that a picture in true proportions shows next to nothing.
constexpr double FarFromOne = 20.0;

relief::hosts::HeightInputs inputsOf(const Raster& raster)
{
  relief::hosts::HeightInputs inputs;
  inputs.image = raster.Heights;
  inputs.scalars = raster.Heights->GetPointData()->GetScalars();
  inputs.mask = raster.Mask;
  inputs.maskScalars = raster.Mask ? raster.Mask->GetPointData()->GetScalars() : nullptr;
  inputs.useNoData = raster.NoData.has_value();
  inputs.noData = raster.NoData.value_or(0.0);
  return inputs;
}

/// Whether a warning has told that the values may not be what they mean: how they look beside their
/// spacing is its consequence.
bool areDoubted(const Raster& raster)
{
  using relief::raster::Warning;
  return std::any_of(raster.Warnings.begin(), raster.Warnings.end(),
    [](const Warning& warning)
    { return warning.Remedy == Warning::NoData || warning.Remedy == Warning::HeightScale; });
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
double fittingHeightScale(const Raster& raster)
{
  const relief::hosts::HeightInputs inputs = inputsOf(raster);
  std::string wrong; // the shading tells it
  const double scale = relief::hosts::FitHeightScale(inputs, wrong);
  return relief::hosts::RoundHeightScale(scale / raster.HeightUnit);
}

//------------------------------------------------------------------------------
std::string scaleHeights(
  HeightScaling scaling, bool unit, const Raster& raster, vtkReliefScene* scene)
{
  const double fitting = scaling == HeightScaling::Given ? 0.0 : fittingHeightScale(raster);
  std::ostringstream text;
  if (!(fitting > 0.0))
  {
    return std::string();
  }
  if (scaling == HeightScaling::Usual && unit)
  {
    if (!areDoubted(raster) && (fitting > FarFromOne || fitting < 1.0 / FarFromOne))
    {
      text << "warning: beside its spacing its relief is so "
           << (fitting > 1.0 ? "low that it hardly shows" : "high that it is all walls")
           << "; --height-scale auto takes " << fitting;
    }
    return text.str();
  }
  scene->SetHeightScale(fitting);
  text << (unit ? "" : "its heights have no unit: ") << "--height-scale " << fitting << " is taken";
  return text.str();
}

//------------------------------------------------------------------------------
void smoothSteps(Raster& raster)
{
  vtkNew<vtkReliefStepSmoothing> smoothing;
  smoothing->SetInputData(raster.Heights);
  if (raster.Mask)
  {
    smoothing->SetMaskData(raster.Mask);
  }
  smoothing->SetNoDataValue(raster.NoData.value_or(std::numeric_limits<double>::quiet_NaN()));
  smoothing->Update();
  if (hasError())
  {
    throw std::runtime_error(takeError());
  }
  raster.Heights = smoothing->GetOutput();
  raster.NoData.reset(); // NaN tells
}

//------------------------------------------------------------------------------
bool showsTerraces(const Raster& raster)
{
  return relief::hosts::ShowsTerraces(inputsOf(raster));
}

}
