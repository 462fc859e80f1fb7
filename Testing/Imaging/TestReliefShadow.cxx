// SPDX-License-Identifier: BSD-3-Clause
// The layer Shadow: of the first sun, by the geometry alone.
#include "vtkImageReliefShading.h"

#include "vtkLight.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkReliefStatistics.h"

#include "ReliefTestUtilities.h"

#include <cmath>

namespace
{
int Failures = 0;

vtkSmartPointer<vtkImageReliefShading> MakeShading()
{
  auto shading = vtkSmartPointer<vtkImageReliefShading>::New();
  const auto heights = MakeHeights(90, 70, Waves);
  heights->SetSpacing(2.0, 1.5, 1.0);
  shading->SetInputData(heights);
  shading->GenerateShadowOn();
  shading->GetScene()->AddSun(300.0, 12.0);
  return shading;
}

vtkDataArray* ShadowOf(vtkImageReliefShading* shading)
{
  shading->Update();
  return shading->GetOutput()->GetPointData()->GetArray("Shadow");
}

//------------------------------------------------------------------------------
// Nothing of the material changes it, nor what other lights there are.
void TestGeometryAlone()
{
  const auto shading = MakeShading();
  vtkNew<vtkFloatArray> shadow;
  shadow->DeepCopy(ShadowOf(shading));
  double range[2];
  shadow->GetRange(range);
  CHECK(range[0] == 0.0 && range[1] == 1.0);
  vtkReliefScene* scene = shading->GetScene();
  vtkReliefMaterial* material = scene->GetMaterial();
  auto same = [&] { return SameBytes(shadow, ShadowOf(shading)); };
  material->SetSubsurfaceDepth(7.0);
  CHECK(same());
  material->SetOffsetModeToSurfaceNormal();
  CHECK(same());
  material->SetAttenuationToExponential();
  CHECK(same());
  material->UseFloorOn();
  material->SetFloorHeight(-3.0);
  CHECK(same());
  material->SetSpecularCoefficient(1.0);
  CHECK(same());
  scene->SetTolerance(0.1);
  CHECK(same());
  scene->AddSun(90.0, 50.0);
  CHECK(same());
  vtkNew<vtkLight> lamp;
  lamp->SetLightTypeToSceneLight();
  lamp->PositionalOn();
  lamp->SetPosition(50.0, 50.0, 50.0);
  scene->AddLight(lamp);
  CHECK(same());
  shading->SetOutputScalarTypeToUnsignedChar();
  CHECK(same());
  scene->SetIntegratorToFixedStep();
  CHECK(same());
}

//------------------------------------------------------------------------------
// d = 0 in the limit t = 0, and nowhere else.
void TestLimit()
{
  const auto shading = MakeShading();
  shading->GenerateIlluminationOn();
  shading->GetScene()->SetTolerance(0.0);
  shading->GetScene()->GetMaterial()->SetSubsurfaceDepth(0.0);
  shading->GetScene()->GetMaterial()->SetOffsetModeToVertical();
  shading->Update();
  vtkImageData* output = shading->GetOutput();
  for (int j = 0; j < 70; ++j)
  {
    for (int i = 0; i < 90; ++i)
    {
      const float shadow = Value(output, "Shadow", i, j);
      const float d = Value(output, "Illumination", i, j);
      CHECK(std::isnan(shadow) ? std::isnan(d) : (shadow == 1.0f) == (d == 0.0f));
    }
  }
}

//------------------------------------------------------------------------------
// The first sun that is on; a lamp is none, and neither is the sky.
void TestFirstSun()
{
  const auto shading = MakeShading();
  vtkNew<vtkFloatArray> shadow;
  shadow->DeepCopy(ShadowOf(shading));
  vtkReliefScene* scene = shading->GetScene();
  scene->RemoveAllLights();
  vtkNew<vtkLight> lamp;
  lamp->SetLightTypeToSceneLight();
  lamp->PositionalOn();
  lamp->SetPosition(50.0, 50.0, 50.0);
  scene->AddLight(lamp);
  vtkLight* off = scene->AddSun(90.0, 30.0);
  off->SwitchOff();
  vtkLight* dark = scene->AddSun(300.0, 12.0);
  dark->SetIntensity(0.0);
  CHECK(SameBytes(shadow, ShadowOf(shading)));
  off->SwitchOn();
  CHECK(!SameBytes(shadow, ShadowOf(shading)));
  CHECK(shading->GetStatistics()->GetRaysTraced() > 0);

  MessageKeeper messages(shading);
  scene->SetLightsToSkyDome();
  shading->Update();
  CHECK(messages.OneError("no sun is on") && shading->GetOutput()->GetNumberOfPoints() == 0);
  shading->GenerateShadowOff();
  shading->Update();
  CHECK(!shading->GetOutput()->GetPointData()->HasArray("Shadow"));
  CHECK(shading->GetOutput()->GetNumberOfPoints() == 90 * 70);
}

//------------------------------------------------------------------------------
// A sun with a width has an edge that is neither.
void TestWidth()
{
  const auto shading = MakeShading();
  vtkReliefScene* scene = shading->GetScene();
  scene->RemoveAllLights();
  scene->AddSun(300.0, 12.0, 4.0);
  vtkDataArray* shadow = ShadowOf(shading);
  int between = 0;
  for (vtkIdType at = 0; at < shadow->GetNumberOfTuples(); ++at)
  {
    const double share = shadow->GetTuple1(at);
    CHECK(std::isnan(share) || (share >= 0.0 && share <= 1.0));
    between += share > 0.0 && share < 1.0 ? 1 : 0;
  }
  CHECK(between > 100);
}
}

//------------------------------------------------------------------------------
int TestReliefShadow(int, char*[])
{
  TestGeometryAlone();
  TestLimit();
  TestFirstSun();
  TestWidth();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
