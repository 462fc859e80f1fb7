// SPDX-License-Identifier: BSD-3-Clause
#include "SculptedHeights.h"

#include "Failure.h"
#include "MessageLog.h"
#include "Watch.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkNormalMapToHeightField.h"
#include "vtkReliefCompression.h"

#include <limits>

namespace
{
// What the filters say they need while they run.
constexpr double integratedBytes = 120.0;
constexpr double bilateralBytes = 250.0;
constexpr double squeezedBytes = 190.0;
}

namespace reliefshade
{

//------------------------------------------------------------------------------
void checkSculpting(const Sculpting& sculpting, bool tinted)
{
  if (sculpting.Relief && tinted)
  {
    throw Failure("--tint",
      "gives colours by height, of which --relief leaves a share; leave one of them out",
      UsageFailure);
  }
  if (sculpting.Integration && !sculpting.Green)
  {
    throw Failure("--normal-method", "is of normal maps; see --normal-map", UsageFailure);
  }
}

//------------------------------------------------------------------------------
Raster readNormalMap(const std::string& file, const std::string& mask,
  const std::array<double, 2>& spacing, const Sculpting& sculpting, MemoryBudget& budget,
  double bytesPerSample)
{
  const int method = sculpting.Integration.value_or(vtkNormalMapToHeightField::LeastSquares);
  const bool many = method == vtkNormalMapToHeightField::DiscontinuityPreserving;
  vtkSmartPointer<vtkImageData> map =
    readPicture(file, budget, 1.0, bytesPerSample + (many ? bilateralBytes : integratedBytes));
  map->SetSpacing(spacing[0], spacing[1], 1.0);
  Raster raster;
  raster.Heights = map;
  if (!mask.empty())
  {
    addMask(mask, ReadOptions(), file, budget, raster);
  }
  aboutFile(file,
    [&]
    {
      vtkNew<vtkNormalMapToHeightField> heights;
      heights->SetInputData(map);
      if (raster.Mask)
      {
        heights->SetMaskData(raster.Mask);
      }
      heights->SetGreen(*sculpting.Green);
      heights->SetMethod(method);
      runToEnd(heights);
      raster.Heights = heights->GetOutput();
      raster.ScalarType = raster.Heights->GetScalarType();
      raster.Columns = raster.Heights->GetDimensions()[0];
      raster.Rows = raster.Heights->GetDimensions()[1];
      raster.OneUnit = true;
      relief::raster::SetSpacing(raster, spacing);
      using relief::raster::Warning;
      if (!heights->IsGreenKnown())
      {
        raster.Warnings.push_back(
          { "which way green points cannot be told: up is taken; see --normal-map",
            Warning::None });
      }
      if (!heights->GetConverged())
      {
        raster.Warnings.push_back({ "its heights were still changing after " +
            std::to_string(heights->GetNumberOfIterations()) + " steps; see --normal-method",
          Warning::None });
      }
    });
  return raster;
}

//------------------------------------------------------------------------------
void squeezeHeights(double relief, const std::string& heights, MemoryBudget& budget, Raster& raster)
{
  const auto samples = static_cast<double>(raster.Heights->GetNumberOfPoints());
  aboutFile(heights,
    [&]
    {
      budget.Claim(4.0 * samples, squeezedBytes * samples);
      vtkNew<vtkReliefCompression> squeeze;
      squeeze->SetInputData(raster.Heights);
      if (raster.Mask)
      {
        squeeze->SetMaskData(raster.Mask);
      }
      squeeze->SetNoDataValue(raster.NoData.value_or(std::numeric_limits<double>::quiet_NaN()));
      squeeze->SetHeightBudget(relief);
      runToEnd(squeeze);
      raster.Heights = squeeze->GetOutput();
      raster.NoData.reset(); // NaN tells
    });
  raster.HasNaN.reset();
  raster.Ends.reset();
}

}
