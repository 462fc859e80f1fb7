// SPDX-License-Identifier: BSD-3-Clause
// Lights, suns, refusals and modification times of vtkReliefScene.
#include "vtkReliefScene.h"

#include "vtkInformation.h"
#include "vtkInformationDoubleKey.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefStatistics.h"

#include "ReliefTestUtilities.h"

#include <limits>
#include <sstream>

int TestReliefScene(int, char*[])
{
  int Failures = 0;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  vtkNew<vtkReliefScene> scene;
  CHECK(scene->GetMaterial() != nullptr && scene->GetLights()->GetNumberOfItems() == 0);
  CHECK(scene->GetHeightScale() == 1.0 && scene->GetTolerance() == 0.0003);
  CHECK(scene->GetIntegrator() == vtkReliefScene::Exact && scene->GetNumberOfSteps() == 256);

  // Azimuth runs clockwise from north, altitude up from the horizon; multiples of 90 degrees are
  // exact.
  struct
  {
    double azimuth, altitude, x, y, z;
  } suns[] = { { 0, 0, 0, 1, 0 }, { 90, 0, 1, 0, 0 }, { 180, 0, 0, -1, 0 }, { 270, 0, -1, 0, 0 },
    { 360, 0, 0, 1, 0 }, { -90, 0, -1, 0, 0 }, { 810, 0, 1, 0, 0 }, { 123, 90, 0, 0, 1 },
    { 123, -90, 0, 0, -1 } };
  for (const auto& sun : suns)
  {
    vtkLight* light = scene->AddSun(sun.azimuth, sun.altitude);
    CHECK(light && !light->GetPositional() && light->GetSwitch());
    CHECK(light->GetPosition()[0] == sun.x);
    CHECK(light->GetPosition()[1] == sun.y);
    CHECK(light->GetPosition()[2] == sun.z);
  }
  vtkLight* northwest = scene->AddSun(315.0, 30.0);
  CHECK_NEAR(northwest->GetPosition()[0], -std::sqrt(0.375), 1e-15);
  CHECK_NEAR(northwest->GetPosition()[1], std::sqrt(0.375), 1e-15);
  CHECK_NEAR(northwest->GetPosition()[2], 0.5, 1e-15);
  for (double azimuth = -400.0; azimuth < 400.0; azimuth += 0.37)
  {
    scene->RemoveAllLights();
    vtkLight* light = scene->AddSun(azimuth, 33.0);
    double radians = vtkMath::RadiansFromDegrees(azimuth);
    CHECK_NEAR(light->GetPosition()[0], std::sin(radians) * std::cos(0.57595865315812877), 1e-14);
    CHECK_NEAR(light->GetPosition()[1], std::cos(radians) * std::cos(0.57595865315812877), 1e-14);
  }

  // The scene changes with its lights and its material, also with their replacement.
  vtkNew<vtkLight> light;
  vtkMTimeType time = scene->GetMTime();
  auto changed = [&]()
  {
    bool later = scene->GetMTime() > time;
    time = scene->GetMTime();
    return later;
  };
  scene->AddLight(light);
  CHECK(changed());
  scene->AddLight(light);
  CHECK(!changed() && scene->GetLights()->GetNumberOfItems() == 2);
  light->SetIntensity(2.0);
  CHECK(changed());
  vtkNew<vtkMatrix4x4> matrix;
  light->SetTransformMatrix(matrix);
  CHECK(changed());
  matrix->SetElement(0, 3, 1.0);
  CHECK(changed());
  scene->GetMaterial()->SetDensity(3.0);
  CHECK(changed());
  vtkNew<vtkReliefMaterial> material;
  scene->SetMaterial(material);
  CHECK(changed() && scene->GetMaterial() == material);
  scene->RemoveLight(light);
  CHECK(changed() && scene->GetLights()->GetNumberOfItems() == 1);
  scene->RemoveLight(light);
  CHECK(!changed());
  scene->RemoveAllLights();
  CHECK(changed());
  vtkNew<vtkReliefEnvironment> environment;
  scene->SetEnvironment(environment);
  CHECK(changed() && scene->GetEnvironment() == environment);
  environment->SetTilt(5.0);
  CHECK(changed());
  scene->SetEnvironment(nullptr);
  CHECK(changed() && !scene->GetEnvironment());
  environment->SetTilt(6.0);
  CHECK(!changed());
  CHECK(scene->GetNumberOfSunSamples() == 16);
  scene->SetNumberOfSunSamples(4);
  CHECK(changed());

  // A sun's disc belongs to its light, whatever the scene.
  vtkLight* disc = scene->AddSun(315.0, 45.0, 0.5);
  CHECK(changed() && vtkReliefScene::GetAngularDiameter(disc) == 0.5);
  CHECK(vtkReliefScene::GetAngularDiameter(light) == 0.0);
  CHECK(vtkReliefScene::GetAngularDiameter(nullptr) == 0.0);
  scene->SetAngularDiameter(disc, 2.0);
  CHECK(changed() && vtkReliefScene::GetAngularDiameter(disc) == 2.0);
  scene->SetAngularDiameter(disc, 2.0);
  CHECK(!changed());
  CHECK(disc->GetInformation()->Get(vtkReliefScene::ANGULAR_DIAMETER()) == 2.0);

  // A sun of a time and a place stands where its angles say, the map's north taken off them.
  double angles[2] = { -1.0, -1.0 };
  const char* const morning = "2026-06-21T06:30+02:00";
  CHECK(scene->FindSun(morning, 13.4, 52.52, 0.0, true, angles));
  CHECK_NEAR(angles[0], 68.158, 0.01); // testing SolarPosition has the sources
  CHECK_NEAR(angles[1], 12.961, 0.01);
  double bare[2];
  CHECK(scene->FindSun("2026-06-21T04:30Z", 13.4, 52.52, 0.0, false, bare));
  CHECK(bare[0] == angles[0] && bare[1] < angles[1] - 0.05);
  CHECK(scene->FindSun(morning, 13.4, 52.52, 3000.0, true, bare));
  CHECK(bare[1] < angles[1] - 0.01);
  const auto standsAt = [](vtkLight* sun, double azimuth, double altitude)
  {
    const double a = vtkMath::RadiansFromDegrees(azimuth);
    const double h = vtkMath::RadiansFromDegrees(altitude);
    const double* p = sun->GetPosition();
    return !sun->GetPositional() && sun->GetIntensity() == 1.0 &&
      std::abs(p[0] - std::sin(a) * std::cos(h)) < 1e-12 &&
      std::abs(p[1] - std::cos(a) * std::cos(h)) < 1e-12 && std::abs(p[2] - std::sin(h)) < 1e-12;
  };
  CHECK(standsAt(scene->AddSunAt(morning, 13.4, 52.52), angles[0], angles[1]) && changed());
  CHECK(standsAt(scene->AddSunAt(morning, 13.4, 52.52, 10.0), angles[0] - 10.0, angles[1]));
  vtkLight* night = scene->AddSunAt("2026-06-21T23:00Z", 13.4, 52.52);
  CHECK(night && night->GetPosition()[2] < 0.0);
  {
    MessageKeeper messages(scene);
    const int lights = scene->GetLights()->GetNumberOfItems();
    const double before[2] = { angles[0], angles[1] };
    CHECK(!scene->AddSunAt("2026-06-21T06:30", 13.4, 52.52) && messages.OneError("zone"));
    CHECK(!scene->AddSunAt(nullptr, 13.4, 52.52) && messages.OneError("no date"));
    CHECK(!scene->AddSunAt(morning, 13.4, 90.1) && messages.OneError("latitude 90.1"));
    CHECK(!scene->AddSunAt(morning, nan, 0.0) && messages.OneError("longitude nan"));
    CHECK(!scene->AddSunAt(morning, 0.0, 0.0, nan) && messages.OneError("convergence nan"));
    CHECK(!scene->AddSunAt(morning, 0.0, 0.0, 0.0, 2e4) && messages.OneError("sea level 20000"));
    CHECK(!scene->FindSun("now", 0.0, 0.0, 0.0, true, angles) && messages.OneError("'now'"));
    CHECK(angles[0] == before[0] && angles[1] == before[1]);
    CHECK(scene->GetLights()->GetNumberOfItems() == lights);
  }

  // Presets replace what was there.
  scene->SetLightsToMultidirectional();
  CHECK(changed() && scene->GetLights()->GetNumberOfItems() == 4 && !scene->GetEnvironment());
  scene->SetLightsToSkyDome();
  CHECK(changed() && scene->GetLights()->GetNumberOfItems() == 0 && scene->GetEnvironment());
  scene->SetLightsToSunAndSky(200.0, 20.0);
  CHECK(changed() && scene->GetLights()->GetNumberOfItems() == 1 && scene->GetEnvironment());
  vtkLight* real = vtkLight::SafeDownCast(scene->GetLights()->GetItemAsObject(0));
  CHECK(vtkReliefScene::GetAngularDiameter(real) == 0.533);
  CHECK_NEAR(real->GetPosition()[2], std::sin(vtkMath::RadiansFromDegrees(20.0)), 1e-15);
  CHECK(real->GetDiffuseColor()[0] > real->GetDiffuseColor()[2]);

  scene->SetLightsToCombined(200.0, 20.0);
  CHECK(changed() && scene->GetLights()->GetNumberOfItems() == 1 && !scene->GetEnvironment());
  CHECK(scene->GetResponse() == vtkReliefScene::Combined);
  scene->SetLightsToIgor(200.0);
  CHECK(changed() && scene->GetResponse() == vtkReliefScene::Igor);
  {
    MessageKeeper refused(scene);
    scene->SetLightsToCombined(200.0, 91.0);
    CHECK(refused.OneError("91"));
    scene->SetLightsToIgor(nan);
    CHECK(refused.OneError("nan"));
    scene->SetResponse(3);
    CHECK(refused.OneError("3"));
    CHECK(!changed() && scene->GetResponse() == vtkReliefScene::Igor);
  }
  scene->SetResponseToIllumination();
  scene->SetLightsToSunAndSky(200.0, 20.0);
  CHECK(changed());

  // On level ground they give what they say; the disc as much as a point would.
  vtkNew<vtkImageReliefShading> shading;
  shading->SetInputData(MakeHeights(3, 3, [](int, int) { return 0.0; }));
  shading->SetScene(scene);
  auto level = [&](int c)
  {
    shading->Update();
    return Value(shading->GetOutput(), nullptr, 1, 1, c);
  };
  auto luminance = [&]() { return 0.2126 * level(0) + 0.7152 * level(1) + 0.0722 * level(2); };
  CHECK_NEAR(luminance(), 0.2 + 0.55 * std::sin(vtkMath::RadiansFromDegrees(20.0)), 0.005);
  scene->SetLightsToSkyDome();
  CHECK_NEAR(luminance(), 0.62, 1e-5);
  scene->SetLightsToMultidirectional();
  CHECK_NEAR(luminance(), 0.5, 1e-6);
  CHECK(shading->GetStatistics()->GetLightsTraced() == 4);
  // Level ground answers by its slope alone, and illuminations that are kept serve any answer.
  scene->SetLightsToCombined(10.0, 30.0);
  CHECK_NEAR(level(0), 1.0, 1e-6);
  CHECK(shading->GetStatistics()->GetLightsTraced() == 1);
  scene->SetResponseToIllumination();
  CHECK_NEAR(level(0), 0.5, 1e-6);
  CHECK(shading->GetStatistics()->GetLightsReused() == 1);
  scene->SetResponseToIgor();
  CHECK_NEAR(level(0), 1.0, 1e-6);
  CHECK(shading->GetStatistics()->GetLightsTraced() == 0);
  scene->SetResponseToIllumination();

  scene->RemoveAllLights();
  scene->AddSun(10.0, 30.0, 3.0);
  CHECK_NEAR(level(0), 0.5, 1e-3);
  CHECK(shading->GetStatistics()->GetLightsTraced() == 4);
  scene->RemoveAllLights();
  CHECK(changed());
  scene->SetIntegratorToFixedStep();
  scene->SetIntegratorToFixedStep();
  CHECK(changed());

  // Refusals.
  MessageKeeper messages(scene);
  scene->SetTolerance(-0.5);
  CHECK(messages.OneError("-0.5"));
  scene->SetHeightScale(nan);
  CHECK(messages.OneError("nan"));
  scene->SetIntegrator(7);
  CHECK(messages.OneError("7"));
  scene->SetNumberOfSteps(0);
  CHECK(messages.OneError("0"));
  scene->SetNumberOfSteps(1000001);
  CHECK(messages.OneError("1000001"));
  scene->AutomaticExposureOn();
  scene->SetExposure(20.5);
  CHECK(messages.OneError("20.5"));
  CHECK(scene->GetAutomaticExposure() && scene->GetExposure() == 0.0);
  scene->SetExposure(-20.0);
  CHECK(!scene->GetAutomaticExposure() && scene->GetExposure() == -20.0);
  CHECK(changed());
  scene->SetNumberOfSunSamples(0);
  CHECK(messages.OneError("0"));
  scene->SetNumberOfSunSamples(4097);
  CHECK(messages.OneError("4097"));
  scene->SetAngularDiameter(light, 90.5);
  CHECK(messages.OneError("90.5"));
  scene->SetAngularDiameter(nullptr, 1.0);
  CHECK(messages.OneError("no light"));
  CHECK(scene->AddSun(315.0, 45.0, -1.0) == nullptr && messages.OneError("-1"));
  scene->SetLightsToSunAndSky(315.0, -1.0);
  CHECK(messages.OneError("-1"));
  scene->SetMaterial(nullptr);
  CHECK(messages.OneError("null"));
  scene->AddLight(nullptr);
  CHECK(messages.OneError("null"));
  CHECK(scene->AddSun(nan, 45.0) == nullptr && messages.OneError("nan"));
  CHECK(scene->AddSun(315.0, 91.0) == nullptr && messages.OneError("91"));
  CHECK(scene->GetLights()->GetNumberOfItems() == 0 && scene->GetMaterial() == material);
  CHECK(!changed());

  std::ostringstream printed;
  scene->Print(printed);
  for (const char* name :
    { "Material", "Lights", "Environment", "HeightScale", "Integrator", "Tolerance",
      "NumberOfSteps", "NumberOfSunSamples", "Response", "Exposure", "AutomaticExposure" })
  {
    CHECK(printed.str().find(std::string(name) + ":") != std::string::npos);
  }
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
