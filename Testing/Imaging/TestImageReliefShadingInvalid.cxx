// SPDX-License-Identifier: BSD-3-Clause
// Bad input: one clear message, an empty output, the filter usable afterwards.
#include "vtkImageReliefShading.h"

#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkReliefScene.h"
#include "vtkUnsignedCharArray.h"

#include "ReliefTestUtilities.h"
#include "ReliefUnusableImages.h"

#include <limits>

int TestImageReliefShadingInvalid(int, char*[])
{
  int Failures = 0;
  auto good = MakeHeights(6, 5, Hills(1));
  vtkNew<vtkImageReliefShading> filter;
  MessageKeeper messages(filter);

  // Updates, expects one error that contains the text, and no output; then all is well again.
  auto refused = [&](vtkImageData* heights, const std::string& text)
  {
    filter->SetInputData(heights);
    filter->Update();
    bool one = messages.OneError(text);
    bool empty = filter->GetOutput()->GetNumberOfPoints() == 0 &&
      filter->GetOutput()->GetPointData()->GetNumberOfArrays() == 0;
    filter->SetInputData(good);
    filter->SetMaskData(nullptr);
    filter->GetScene()->RemoveAllLights();
    filter->Update();
    return one && empty && messages.Silent() && filter->GetOutput()->GetNumberOfPoints() == 30;
  };

  for (const auto& [image, text] : UnusableImages("height", 1))
  {
    CHECK(refused(image, text));
  }
  vtkNew<vtkImageData> vectors;
  vectors->SetDimensions(4, 4, 1);
  vectors->AllocateScalars(VTK_FLOAT, 3);
  CHECK(refused(vectors, "3 components"));
  auto flat = MakeHeights(4, 4, [](int, int) { return 0.0; });
  flat->SetSpacing(1.0, vtkMath::Nan(), 1.0);
  CHECK(refused(flat, "nan"));

  auto huge = MakeHeights<vtkDoubleArray>(4, 4, [](int i, int) { return i == 2 ? 1e300 : 0.0; });
  CHECK(refused(huge, "1e+300"));

  filter->SetMaskData(MakeHeights(3, 3, [](int, int) { return 1.0; }));
  CHECK(refused(good, "mask's extent is (0, 2, 0, 2)"));
  filter->SetMaskData(vectors);
  CHECK(refused(good, "the mask image has 3 components"));

  filter->GetScene()->AddSun(0.0, 45.0);
  filter->GetScene()->AddSun(0.0, 45.0)->SetPosition(0.0, 0.0, 0.0);
  CHECK(refused(good, "light 1"));
  filter->GetScene()->AddSun(0.0, 45.0)->SetPosition(vtkMath::Nan(), 0.0, 1.0);
  CHECK(refused(good, "light 0"));
  filter->GetScene()->AddSun(0.0, 45.0)->SetIntensity(vtkMath::Inf());
  CHECK(refused(good, "light 0"));

  // Unusual but valid input is shaded, with one warning.
  filter->SetInputData(MakeHeights(4, 4, [](int, int) { return vtkMath::Nan(); }));
  filter->Update();
  CHECK(messages.OneWarning("No sample has data"));
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 16);
  for (int c = 0; c < 4; ++c)
  {
    CHECK(Value(filter->GetOutput(), nullptr, 2, 2, c) == 0.0f);
  }
  for (int columns : { 1, 9 })
  {
    for (int rows : { 1, 9 })
    {
      filter->SetInputData(MakeHeights(columns, rows, [](int i, int j) { return i + j; }));
      filter->Update();
      CHECK(columns * rows == 81 ? messages.Silent() : messages.OneWarning("level ground"));
      CHECK(std::isfinite(Value(filter->GetOutput(), nullptr, columns - 1, rows - 1)));
      CHECK(columns * rows == 81 ||
        std::abs(Value(filter->GetOutput(), nullptr, 0, 0) - 0.95 * std::sqrt(0.5)) < 1e-6);
    }
  }

  // Setters refuse and keep.
  filter->SetOutputScalarType(VTK_DOUBLE);
  CHECK(messages.OneError("SetOutputScalarType: 11"));
  CHECK(filter->GetOutputScalarType() == VTK_FLOAT);
  vtkReliefScene* scene = filter->GetScene();
  filter->SetScene(nullptr);
  CHECK(messages.OneError("null") && filter->GetScene() == scene);

  // NaN may be named as the nodata value; naming it again changes nothing.
  filter->SetNoDataValue(vtkMath::Nan());
  vtkMTimeType time = filter->GetMTime();
  filter->SetNoDataValue(vtkMath::Nan());
  CHECK(filter->GetMTime() == time && filter->GetUseNoDataValue());
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
