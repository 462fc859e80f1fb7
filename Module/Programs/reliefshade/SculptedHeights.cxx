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
constexpr double squeezedBytes = 110.0;
}

namespace reliefshade
{

//------------------------------------------------------------------------------
void checkSculpting(const Sculpting& sculpting)
{
  if (sculpting.Integration && !sculpting.Green)
  {
    throw Failure("--normal-method", "is of normal maps; see --normal-map", UsageFailure);
  }
}

//------------------------------------------------------------------------------
Raster readNormalMap(
  const std::string& file, const Sculpting& sculpting, MemoryBudget& budget, double bytesPerSample)
{
  const int method = sculpting.Integration.value_or(vtkNormalMapToHeightField::LeastSquares);
  const bool many = method == vtkNormalMapToHeightField::DiscontinuityPreserving;
  vtkSmartPointer<vtkImageData> map =
    readPicture(file, budget, 1.0, bytesPerSample + (many ? bilateralBytes : integratedBytes));
  Raster raster;
  aboutFile(file,
    [&]
    {
      vtkNew<vtkNormalMapToHeightField> heights;
      heights->SetInputData(map);
      heights->SetGreen(*sculpting.Green);
      heights->SetMethod(method);
      runToEnd(heights);
      raster.Heights = heights->GetOutput();
      raster.ScalarType = raster.Heights->GetScalarType();
      raster.Columns = raster.Heights->GetDimensions()[0];
      raster.Rows = raster.Heights->GetDimensions()[1];
      raster.OneUnit = true;
      relief::raster::SetSpacing(raster, { 1.0, 1.0 });
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
