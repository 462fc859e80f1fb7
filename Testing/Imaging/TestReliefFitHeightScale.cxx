// SPDX-License-Identifier: BSD-3-Clause
// vtkReliefScene::FitHeightScale: what it takes, what it refuses, and that the picture does not
// depend on how heights are stored.
#include "vtkReliefScene.h"

#include "vtkImageShiftScale.h"
#include "vtkMath.h"
#include "vtkSMPTools.h"
#include "vtkUnsignedCharArray.h"

#include "HeightScale.h"
#include "ReliefTestUtilities.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>
#include <string>

namespace
{
int Failures = 0;

double Hills(int i, int j)
{
  return 100.0 * std::sin(0.05 * i) * std::cos(0.04 * j) + 20.0 * std::sin(0.2 * i + 0.15 * j);
}

double Fit(vtkImageData* heights, vtkImageData* mask = nullptr)
{
  vtkNew<vtkReliefScene> scene;
  return scene->FitHeightScale(heights, mask);
}

vtkSmartPointer<vtkImageData> Stored(
  vtkImageData* heights, int type, double lowest, double shift, double factor)
{
  vtkNew<vtkImageShiftScale> store;
  store->SetInputData(heights);
  store->SetShift(0.5 / factor - lowest + shift); // casts cut
  store->SetScale(factor);
  store->SetOutputScalarType(type);
  store->Update();
  return store->GetOutput();
}

vtkSmartPointer<vtkImageData> Picture(vtkImageData* heights)
{
  vtkNew<vtkImageReliefShading> shading;
  shading->SetInputData(heights);
  shading->GetScene()->FitHeightScale(heights);
  shading->SetOutputScalarTypeToUnsignedChar();
  shading->Update();
  return shading->GetOutput();
}

double GreatestDifference(vtkImageData* a, vtkImageData* b)
{
  vtkDataArray* one = a->GetPointData()->GetScalars();
  vtkDataArray* other = b->GetPointData()->GetScalars();
  double greatest = 0.0;
  for (vtkIdType at = 0; at < one->GetNumberOfTuples(); ++at)
  {
    greatest = std::max(greatest, std::abs(one->GetComponent(at, 0) - other->GetComponent(at, 0)));
  }
  return greatest;
}

//------------------------------------------------------------------------------
void TestPicturesAgree()
{
  const auto heights = MakeHeights<vtkDoubleArray>(300, 200, Hills);
  double range[2];
  heights->GetScalarRange(range);
  const double size = range[1] - range[0];
  const auto expected = Picture(heights);
  double gray[2];
  expected->GetScalarRange(gray);
  CHECK(gray[1] - gray[0] > 80.0); // there is something to see
  for (const auto& other : { Stored(heights, VTK_UNSIGNED_SHORT, range[0], 0.0, 65535.0 / size),
         Stored(heights, VTK_FLOAT, range[0], 0.0, 1.0 / size),
         Stored(heights, VTK_INT, range[0], 1000.0, 1e6 / size) })
  {
    CHECK(GreatestDifference(expected, Picture(other)) <= 2.0);
  }
  // Eight bits round the heights, so the picture; not the scale.
  const auto byte = Stored(heights, VTK_UNSIGNED_CHAR, range[0], 0.0, 255.0 / size);
  CHECK_NEAR(Fit(byte) * 255.0 / size / Fit(heights), 1.0, 0.005);
}

//------------------------------------------------------------------------------
void TestNumber()
{
  const auto heights = MakeHeights(300, 200, Hills);
  vtkNew<vtkReliefScene> scene;
  const double scale = scene->FitHeightScale(heights);
  CHECK(scale > 0.0 && scene->GetHeightScale() == scale);
  std::ostringstream text;
  text.precision(6);
  text << scale;
  CHECK(std::stod(text.str()) == scale);
  CHECK(relief::hosts::RoundHeightScale(0.012345678) == 0.0123457);
  CHECK(relief::hosts::RoundHeightScale(12345678.0) == 12345700.0);
  CHECK(relief::hosts::RoundHeightScale(3.14159265e-200) == 3.14159e-200);
  // Again, whatever the scale was and however many threads there are.
  scene->SetHeightScale(-7.0);
  vtkSMPTools::Initialize(1);
  CHECK(scene->FitHeightScale(heights) == scale);
  vtkSMPTools::Initialize(0);
  // A spacing is the unit that heights get; its sign mirrors the image only.
  heights->SetSpacing(-30.0, 30.0, 1.0);
  heights->SetOrigin(500000.0, 1e6, 3.0);
  CHECK_NEAR(scene->FitHeightScale(heights) / scale, 30.0, 0.01);
}

//------------------------------------------------------------------------------
// What has no data does not count, by whatever it is told.
void TestNoData()
{
  const auto heights = MakeHeights<vtkDoubleArray>(300, 200, Hills);
  const auto mask = MakeHeights<vtkUnsignedCharArray>(300, 200,
    [](int i, int j) { return (i - 150) * (i - 150) + (j - 90) * (j - 90) < 2500 ? 0.0 : 1.0; });
  const double expected = Fit(heights, mask);
  CHECK(expected > 0.0 && expected != Fit(heights));
  for (const double none : { vtkMath::Nan(), vtkMath::Inf(), vtkMath::NegInf(), -9999.0 })
  {
    const auto holed = MakeHeights<vtkDoubleArray>(300, 200,
      [&](int i, int j)
      { return mask->GetScalarComponentAsDouble(i, j, 0, 0) == 0.0 ? none : Hills(i, j); });
    vtkNew<vtkReliefScene> scene;
    CHECK(scene->FitHeightScale(holed, nullptr, none) == expected);
    CHECK((scene->FitHeightScale(holed) == expected) == !(none == -9999.0));
  }
}

//------------------------------------------------------------------------------
void TestRefusals()
{
  vtkNew<vtkReliefScene> scene;
  MessageKeeper messages(scene);
  scene->SetHeightScale(3.0);
  const auto refuses = [&](vtkImageData* heights, vtkImageData* mask, const char* reason)
  {
    CHECK(scene->FitHeightScale(heights, mask) == 3.0 && scene->GetHeightScale() == 3.0);
    CHECK(messages.OneError(std::string("FitHeightScale: ") + reason));
  };
  const auto heights = MakeHeights(30, 20, Hills);
  refuses(nullptr, nullptr, "null was given");
  refuses(vtkNew<vtkImageData>(), nullptr, "the height image is empty");
  refuses(heights, MakeHeights(20, 30, Hills), "the mask's extent");
  vtkNew<vtkImageData> bare;
  bare->SetDimensions(30, 20, 1);
  refuses(bare, nullptr, "the height image has no scalars");
  refuses(heights, bare, "the mask image has no scalars");
  bare->AllocateScalars(VTK_FLOAT, 3);
  refuses(bare, nullptr, "the height image has 3 components");
  heights->SetSpacing(0.0, 1.0, 1.0);
  refuses(heights, nullptr, "the spacing is (0");

  // Nothing to scale is no error.
  CHECK(scene->FitHeightScale(MakeHeights(30, 20, [](int, int) { return 8.0; })) == 1.0);
  scene->SetHeightScale(3.0);
  CHECK(scene->FitHeightScale(MakeHeights(30, 1, Hills)) == 1.0);
  CHECK(scene->FitHeightScale(MakeHeights(30, 20, [](int, int) { return vtkMath::Nan(); })) == 1.0);
  CHECK(messages.Silent());
}
}

//------------------------------------------------------------------------------
int TestReliefFitHeightScale(int, char*[])
{
  TestPicturesAgree();
  TestNumber();
  TestNoData();
  TestRefusals();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
