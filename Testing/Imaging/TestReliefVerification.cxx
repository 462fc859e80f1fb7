// SPDX-License-Identifier: BSD-3-Clause
// vtkReliefVerification: what was shaded is retraced; what is not what was shaded is found.
#include "vtkReliefVerification.h"

#include "vtkLight.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkTable.h"

#include "ReliefTestUtilities.h"

#include <algorithm>
#include <limits>
#include <string>

namespace
{
int Failures = 0;

double Value(vtkReliefVerification* verification, vtkIdType row, const char* column)
{
  return verification->GetOutput()->GetValueByName(row, column).ToDouble();
}

vtkSmartPointer<vtkImageReliefShading> MakeShading()
{
  auto shading = vtkSmartPointer<vtkImageReliefShading>::New();
  const auto heights = MakeHeights(60, 45, Waves);
  heights->SetExtent(10, 69, -5, 39, 2, 2);
  heights->SetSpacing(2.0, 1.5, 1.0);
  shading->SetInputData(heights);
  shading->GenerateIlluminationOn();
  shading->GetScene()->AddSun(315.0, 12.0);
  shading->GetScene()->AddSun(90.0, 40.0, 0.5)->SetIntensity(0.4);
  shading->GetScene()->SetHeightScale(1.5);
  return shading;
}

//------------------------------------------------------------------------------
void TestKept()
{
  const auto shading = MakeShading();
  vtkReliefScene* scene = shading->GetScene();
  vtkNew<vtkReliefVerification> verification;
  verification->SetShading(shading);
  verification->Update();
  CHECK(verification->GetKept());
  CHECK(verification->GetNumberOfRetracedSamples() == 1000);
  CHECK_NEAR(verification->GetPromisedError(), 0.000302, 1e-10);
  CHECK_NEAR(verification->GetRoundingError(), 2e-6, 1e-12);
  CHECK(verification->GetLargestError() <= verification->GetPromisedError());
  CHECK(verification->GetNumberOfGrazingSamples() < 10);
  vtkTable* table = verification->GetOutput();
  CHECK(table->GetNumberOfRows() == 1000 && table->GetNumberOfColumns() == 6);
  double largest = 0.0;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const int column = static_cast<int>(Value(verification, row, "Column"));
    const int line = static_cast<int>(Value(verification, row, "Row"));
    CHECK(column >= 10 && column <= 69 && line >= -5 && line <= 39);
    CHECK(::Value(shading->GetOutput(), "Illumination", column, line) ==
      static_cast<float>(Value(verification, row, "Illumination")));
    if (Value(verification, row, "Error") > largest)
    {
      largest = Value(verification, row, "Error");
      CHECK(largest != verification->GetLargestError() ||
        (column == verification->GetWorstColumn() && line == verification->GetWorstRow()));
    }
  }
  CHECK(largest == verification->GetLargestError());

  // All there are, whatever the offset, the environment and the tolerance.
  verification->SetNumberOfSamples(1000000);
  for (int mode = 0; mode < 3; ++mode)
  {
    scene->GetMaterial()->SetOffsetMode(mode);
    scene->SetTolerance(mode == 1 ? 0.0 : 0.01);
    verification->Update();
    CHECK(verification->GetKept() && verification->GetNumberOfRetracedSamples() == 60 * 45 - 1);
  }
  scene->SetLightsToSkyDome();
  verification->Update();
  CHECK(verification->GetKept());
  scene->GetMaterial()->UseFloorOn();
  scene->GetMaterial()->SetFloorHeight(-12.0);
  verification->SetSeed(7);
  verification->Update();
  CHECK(verification->GetKept());
}

//------------------------------------------------------------------------------
// d that somebody has changed behind the shading's back.
void TestBroken()
{
  const auto shading = MakeShading();
  shading->Update();
  vtkDataArray* layer = shading->GetOutput()->GetPointData()->GetArray("Illumination");
  const vtkIdType at = (20 + 5) * 60 + (33 - 10);
  layer->SetTuple1(at, layer->GetTuple1(at) + 0.001);
  vtkNew<vtkReliefVerification> verification;
  verification->SetShading(shading);
  verification->SetNumberOfSamples(60 * 45);
  verification->Update();
  CHECK(!verification->GetKept());
  CHECK_NEAR(verification->GetLargestError(), 0.001, 0.0004);
  CHECK(verification->GetWorstColumn() == 33 && verification->GetWorstRow() == 20);
  // Few samples do not meet it.
  verification->SetNumberOfSamples(5);
  verification->Update();
  CHECK(verification->GetKept() && verification->GetOutput()->GetNumberOfRows() == 5);
}

//------------------------------------------------------------------------------
// Heights are no input of the verification's own.
void TestChangedHeights()
{
  const auto shading = MakeShading();
  vtkNew<vtkReliefVerification> verification;
  verification->SetShading(shading);
  verification->SetNumberOfSamples(100000);
  verification->Update();
  CHECK(verification->GetNumberOfRetracedSamples() == 60 * 45 - 1);
  auto* heights = vtkImageData::SafeDownCast(shading->GetInputDataObject(0, 0));
  for (vtkIdType at = 0; at < 60; ++at)
  {
    heights->GetPointData()->GetScalars()->SetTuple1(at, std::numeric_limits<double>::quiet_NaN());
  }
  heights->Modified();
  verification->Update();
  CHECK(verification->GetNumberOfRetracedSamples() == 60 * 44 - 1);
}

//------------------------------------------------------------------------------
void TestRefusals()
{
  vtkNew<vtkReliefVerification> verification;
  MessageKeeper messages(verification);
  auto refused = [&](const char* why)
  {
    verification->Update();
    CHECK(messages.OneError(why));
    CHECK(!verification->GetKept() && verification->GetOutput()->GetNumberOfRows() == 0);
    CHECK(verification->GetWorstColumn() == -1);
  };
  refused("there is no shading");
  const auto shading = MakeShading();
  shading->GenerateIlluminationOff();
  verification->SetShading(shading);
  refused("GenerateIlluminationOn()");
  shading->GenerateIlluminationOn();
  shading->GetScene()->SetIntegratorToFixedStep();
  refused("fixed steps promise no accuracy");
  shading->GetScene()->SetIntegratorToExact();
  shading->SetInputData(MakeHeights(20, 10, [](int, int) { return 1e38; }));
  shading->GetScene()->SetHeightScale(100.0);
  refused("height");
  verification->SetNumberOfSamples(0);
  CHECK(messages.OneError("0 was given, a number of at least 1 is expected; 1000 is kept"));
  CHECK(verification->GetNumberOfSamples() == 1000);
}

//------------------------------------------------------------------------------
void TestAbort()
{
  const auto shading = MakeShading();
  vtkNew<vtkReliefVerification> verification;
  verification->SetShading(shading);
  ProgressKeeper progress(verification);
  progress.StopAbove = 0.3;
  verification->Update();
  // The end, 1, is announced by the pipelines of newer VTKs.
  auto wentOn = [](double step) { return step >= 0.6 && step < 1.0; };
  CHECK(
    !progress.Steps.empty() && std::none_of(progress.Steps.begin(), progress.Steps.end(), wentOn));
  CHECK(!verification->GetKept() && verification->GetOutput()->GetNumberOfRows() == 0);
  progress.StopAbove = 1.0;
  verification->Modified();
  verification->Update();
  CHECK(verification->GetKept());
}

//------------------------------------------------------------------------------
// The hash is that of heights, however they come.
void TestHash()
{
  const auto whole = [](int i, int j) { return static_cast<double>((i * 7 + j * 3) % 100); };
  vtkNew<vtkImageReliefShading> shading;
  shading->SetInputData(MakeHeights(60, 45, whole));
  const std::string hash = shading->GetHeightHash();
  CHECK(hash.size() == 16 && hash.find_first_not_of("0123456789abcdef") == std::string::npos);
  shading->GetScene()->SetHeightScale(3.0);
  CHECK(shading->GetHeightHash() == hash);
  shading->SetInputData(MakeHeights<vtkDoubleArray>(60, 45, whole));
  CHECK(shading->GetHeightHash() == hash);
  shading->SetNoDataValue(17.0);
  const std::string pierced = shading->GetHeightHash();
  CHECK(pierced != hash);
  shading->UseNoDataValueOff();
  shading->SetMaskData(
    MakeHeights(60, 45, [&](int i, int j) { return whole(i, j) == 17.0 ? 0.0 : 1.0; }));
  CHECK(shading->GetHeightHash() == pierced);
  MessageKeeper messages(shading);
  shading->SetMaskData(MakeHeights(50, 45, whole));
  CHECK(shading->GetHeightHash().empty() && messages.OneError("mask"));
  vtkNew<vtkImageReliefShading> none;
  MessageKeeper others(none);
  CHECK(none->GetHeightHash().empty() && others.OneError("there are no heights"));
}
}

//------------------------------------------------------------------------------
int TestReliefVerification(int, char*[])
{
  TestKept();
  TestBroken();
  TestChangedHeights();
  TestRefusals();
  TestAbort();
  TestHash();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
