// SPDX-License-Identifier: BSD-3-Clause
// vtkReliefStepSmoothing: types, steps, no data, refusals. The smoothing itself is the model's.
#include "vtkReliefStepSmoothing.h"

#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedShortArray.h"

#include "ReliefTestUtilities.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

namespace
{
int Failures = 0;

double Slope(int i, int j)
{
  return 40.0 + i / 25.0 + j / 40.0;
}

double Stored(int i, int j)
{
  return std::round(Slope(i, j));
}

double WorstFrom(vtkImageData* image, double (*height)(int, int), double factor)
{
  double worst = 0.0;
  for (int j = 0; j < 100; ++j)
  {
    for (int i = 0; i < 150; ++i)
    {
      worst = std::max(
        worst, std::abs(image->GetScalarComponentAsDouble(i, j, 0, 0) / factor - height(i, j)));
    }
  }
  return worst;
}

// The mean distance from the slope.
double MeanFrom(vtkImageData* image, double factor)
{
  double sum = 0.0;
  for (int j = 0; j < 100; ++j)
  {
    for (int i = 0; i < 150; ++i)
    {
      sum += std::abs(image->GetScalarComponentAsDouble(i, j, 0, 0) / factor - Slope(i, j));
    }
  }
  return sum / (100.0 * 150.0);
}

//------------------------------------------------------------------------------
template <class ArrayType>
void TestType(int outputType, double factor)
{
  const auto heights =
    MakeHeights<ArrayType>(150, 100, [=](int i, int j) { return factor * Stored(i, j); });
  vtkNew<vtkIntArray> place;
  place->SetName("place");
  heights->GetFieldData()->AddArray(place);
  heights->SetSpacing(-3.0, 2.0, 1.0);
  vtkNew<vtkReliefStepSmoothing> smoothing;
  smoothing->SetInputData(heights);
  smoothing->Update();
  vtkImageData* result = smoothing->GetOutput();
  CHECK(result->GetScalarType() == outputType && smoothing->GetUsedStep() == factor);
  CHECK(result->GetPointData()->GetScalars()->GetName() == std::string("Height"));
  CHECK(result->GetFieldData()->GetArray("place") == place && result->GetSpacing()[0] == -3.0);
  CHECK(WorstFrom(result, Stored, factor) <= 0.5);
  CHECK(MeanFrom(result, factor) < 0.1); // 0.25 as it was stored
  smoothing->SetStep(factor / 1000.0);
  smoothing->Update();
  CHECK(WorstFrom(smoothing->GetOutput(), Stored, factor) <= 0.0005);
}

//------------------------------------------------------------------------------
void TestNoData()
{
  const auto heights = MakeHeights<vtkUnsignedCharArray>(
    150, 100, [](int i, int j) { return i == 70 ? 255.0 : Stored(i, j); });
  const auto mask =
    MakeHeights<vtkUnsignedCharArray>(150, 100, [](int i, int) { return i == 70 ? 0.0 : 1.0; });
  vtkNew<vtkReliefStepSmoothing> byValue;
  byValue->SetInputData(heights);
  byValue->SetNoDataValue(255.0);
  byValue->Update();
  vtkNew<vtkReliefStepSmoothing> byMask;
  byMask->SetInputData(heights);
  byMask->SetMaskData(mask);
  byMask->Update();
  for (int i = 0; i < 150; ++i)
  {
    const double a = byValue->GetOutput()->GetScalarComponentAsDouble(i, 50, 0, 0);
    const double b = byMask->GetOutput()->GetScalarComponentAsDouble(i, 50, 0, 0);
    CHECK(std::isnan(a) == (i == 70) && (std::isnan(a) ? std::isnan(b) : a == b));
  }
}

//------------------------------------------------------------------------------
void TestRefusals()
{
  vtkNew<vtkReliefStepSmoothing> smoothing;
  MessageKeeper messages(smoothing);
  const vtkMTimeType time = smoothing->GetMTime();
  for (const double step : { -1.0, vtkMath::Nan(), vtkMath::Inf() })
  {
    smoothing->SetStep(step);
    CHECK(messages.OneError("SetStep") && smoothing->GetStep() == 0.0);
  }
  smoothing->SetNoDataValue(vtkMath::Nan());
  CHECK(smoothing->GetMTime() == time);
  vtkNew<vtkImageData> colors;
  colors->SetDimensions(4, 3, 1);
  colors->AllocateScalars(VTK_FLOAT, 3);
  smoothing->SetInputData(colors);
  smoothing->Update();
  CHECK(messages.OneError("3 components"));
  CHECK(smoothing->GetOutput()->GetNumberOfPoints() == 0);
  smoothing->SetInputData(MakeHeights(4, 3, Slope));
  smoothing->SetMaskData(MakeHeights(3, 4, Slope));
  smoothing->Update();
  CHECK(messages.OneError("the mask's extent"));
  // What has no steps stays.
  smoothing->SetMaskData(nullptr);
  smoothing->SetInputData(MakeHeights(4, 3, [](int, int) { return 8.0; }));
  smoothing->Update();
  CHECK(messages.Silent() && smoothing->GetUsedStep() == 0.0);
  CHECK(smoothing->GetOutput()->GetScalarComponentAsDouble(2, 1, 0, 0) == 8.0);
}
}

//------------------------------------------------------------------------------
int TestReliefStepSmoothing(int, char*[])
{
  TestType<vtkUnsignedCharArray>(VTK_FLOAT, 1.0);
  TestType<vtkUnsignedShortArray>(VTK_FLOAT, 257.0);
  TestType<vtkIntArray>(VTK_DOUBLE, 1e6);
  TestType<vtkFloatArray>(VTK_FLOAT, 0.5);
  TestType<vtkDoubleArray>(VTK_DOUBLE, 0.125);
  TestNoData();
  TestRefusals();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
