// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefScene.h"

#include "HeightScale.h"
#include "SceneParameters.h"
#include "SunAt.h"
#include "vtkCollectionRange.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleKey.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkReliefAngles.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefSetters.h"

#include "LightPresets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

vtkStandardNewMacro(vtkReliefScene);

namespace parameters = relief::parameters;

namespace
{
// vtkLight::DeepCopy shares the matrix, and leaves out the information that has the diameter.
vtkSmartPointer<vtkLight> CopyOf(vtkLight* light)
{
  auto copy = vtkSmartPointer<vtkLight>::New();
  copy->DeepCopy(light);
  if (light->GetTransformMatrix())
  {
    vtkNew<vtkMatrix4x4> matrix;
    matrix->DeepCopy(light->GetTransformMatrix());
    copy->SetTransformMatrix(matrix);
  }
  parameters::Copy(light, copy);
  return copy;
}

// A preset in the place of all lights.
void SetLights(vtkReliefScene* scene, const relief::LightPreset& preset)
{
  scene->RemoveAllLights();
  for (const relief::LightPreset::Sun& from : preset.suns)
  {
    vtkLight* sun = scene->AddSun(from.azimuth, from.altitude, from.diameter);
    sun->SetDiffuseColor(from.color.x, from.color.y, from.color.z);
    sun->SetIntensity(from.intensity);
  }
  vtkSmartPointer<vtkReliefEnvironment> sky;
  if (preset.sky != relief::LightPreset::Sky::None)
  {
    sky = vtkSmartPointer<vtkReliefEnvironment>::New();
    sky->SetNumberOfSamples(preset.skySamples);
    sky->SetSampling(static_cast<int>(preset.skySampling));
    sky->SetIntensity(preset.skyIntensity);
  }
  if (preset.sky == relief::LightPreset::Sky::WhiteDome)
  {
    sky->SetImageToWhiteDome();
  }
  else if (sky)
  {
    sky->SetImageToClearSky(
      preset.suns.front().azimuth, preset.suns.front().altitude, parameters::UsualTurbidity);
  }
  scene->SetEnvironment(sky);
  if (preset.response)
  {
    scene->SetResponse(*preset.response);
  }
}
}

vtkInformationKeyMacro(vtkReliefScene, ANGULAR_DIAMETER, Double);

//------------------------------------------------------------------------------
vtkReliefScene::vtkReliefScene()
  : Material(vtkSmartPointer<vtkReliefMaterial>::New())
{
  parameters::SetDefaults(this);
}

//------------------------------------------------------------------------------
vtkReliefScene::~vtkReliefScene() = default;

//------------------------------------------------------------------------------
// What each of these takes is in the table of parameters.
void vtkReliefScene::SetHeightScale(double value)
{
  parameters::Set(this, this->HeightScale, value, "HeightScale");
}

void vtkReliefScene::SetIntegrator(int integrator)
{
  parameters::Set(this, this->Integrator, integrator, "Integrator");
}

void vtkReliefScene::SetExposure(double value)
{
  parameters::Set(this, this->Exposure, value, "Exposure");
  if (this->Exposure == value) // it was taken
  {
    this->SetAutomaticExposure(false);
  }
}

//------------------------------------------------------------------------------
void vtkReliefScene::SetTolerance(double value)
{
  parameters::Set(this, this->Tolerance, value, "Tolerance");
}

void vtkReliefScene::SetNumberOfSteps(int value)
{
  parameters::Set(this, this->NumberOfSteps, value, "NumberOfSteps");
}

void vtkReliefScene::SetResponse(int response)
{
  parameters::Set(this, this->Response, response, "Response");
}

void vtkReliefScene::SetNumberOfSunSamples(int value)
{
  parameters::Set(this, this->NumberOfSunSamples, value, "NumberOfSunSamples");
}

//------------------------------------------------------------------------------
double vtkReliefScene::FitHeightScale(vtkImageData* heights, vtkImageData* mask)
{
  return this->FitHeightScale(heights, mask, std::numeric_limits<double>::quiet_NaN());
}

//------------------------------------------------------------------------------
double vtkReliefScene::FitHeightScale(vtkImageData* heights, vtkImageData* mask, double noData)
{
  if (!heights)
  {
    vtkErrorMacro("FitHeightScale: null was given, an image of heights is expected; "
      << this->HeightScale << " is kept.");
    return this->HeightScale;
  }
  relief::hosts::HeightInputs inputs;
  inputs.image = heights;
  inputs.scalars = heights->GetPointData()->GetScalars();
  inputs.mask = mask;
  inputs.maskScalars = mask ? mask->GetPointData()->GetScalars() : nullptr;
  inputs.useNoData = true;
  inputs.noData = noData;
  std::string wrong;
  const double scale = relief::hosts::FitHeightScale(inputs, wrong);
  if (!wrong.empty())
  {
    vtkErrorMacro("FitHeightScale: " << wrong << "; " << this->HeightScale << " is kept.");
    return this->HeightScale;
  }
  this->SetHeightScale(scale > 0.0 ? relief::hosts::RoundHeightScale(scale) : 1.0);
  return this->HeightScale;
}

//------------------------------------------------------------------------------
void vtkReliefScene::SetMaterial(vtkReliefMaterial* material)
{
  relief::SetObject(this, this->Material, material, "Material");
}

//------------------------------------------------------------------------------
vtkReliefMaterial* vtkReliefScene::GetMaterial()
{
  return this->Material;
}

//------------------------------------------------------------------------------
void vtkReliefScene::AddLight(vtkLight* light)
{
  if (!light)
  {
    vtkErrorMacro("AddLight: null was given, a vtkLight is expected.");
    return;
  }
  if (!this->Lights->IsItemPresent(light))
  {
    this->Lights->AddItem(light);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkReliefScene::RemoveLight(vtkLight* light)
{
  if (light && this->Lights->IsItemPresent(light))
  {
    this->Lights->RemoveItem(light);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkReliefScene::RemoveAllLights()
{
  if (this->Lights->GetNumberOfItems() > 0)
  {
    this->Lights->RemoveAllItems();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkLightCollection* vtkReliefScene::GetLights()
{
  return this->Lights;
}

//------------------------------------------------------------------------------
vtkLight* vtkReliefScene::AddSun(double azimuth, double altitude, double angularDiameter)
{
  if (const auto refusal = parameters::CheckSun(azimuth, altitude, angularDiameter))
  {
    vtkErrorMacro("AddSun: " << refusal->Reason() << "; no light is added.");
    return nullptr;
  }
  vtkNew<vtkLight> sun;
  sun->SetLightTypeToSceneLight();
  sun->PositionalOff();
  sun->SetFocalPoint(0.0, 0.0, 0.0);
  double direction[3];
  vtkReliefDirection(azimuth, altitude, direction);
  sun->SetPosition(direction);
  this->SetAngularDiameter(sun, angularDiameter);
  this->AddLight(sun);
  return sun;
}

//------------------------------------------------------------------------------
bool vtkReliefScene::FindSun(const char* time, double longitude, double latitude, double elevation,
  bool refraction, double angles[2])
{
  relief::ClockTime moment;
  std::string wrong = relief::ParseTime(time ? time : "", moment);
  wrong = wrong.empty() ? relief::CheckPlace(longitude, latitude, elevation) : wrong;
  if (!wrong.empty())
  {
    vtkErrorMacro("FindSun: " << wrong << ".");
    return false;
  }
  const relief::SolarPosition sun = relief::hosts::SunAt(
    moment, longitude, latitude, refraction ? std::optional<double>(elevation) : std::nullopt);
  angles[0] = sun.azimuth;
  angles[1] = sun.altitude;
  return true;
}

//------------------------------------------------------------------------------
vtkLight* vtkReliefScene::AddSunAt(const char* time, double longitude, double latitude,
  double convergence, double elevation, bool refraction)
{
  if (!std::isfinite(convergence))
  {
    vtkErrorMacro("AddSunAt: the convergence " << convergence
                                               << " was given, finite degrees are expected; no "
                                                  "light is added.");
    return nullptr;
  }
  double angles[2];
  return this->FindSun(time, longitude, latitude, elevation, refraction, angles)
    ? this->AddSun(angles[0] - convergence, angles[1])
    : nullptr;
}

//------------------------------------------------------------------------------
void vtkReliefScene::SetAngularDiameter(vtkLight* light, double degrees)
{
  const parameters::Parameter& diameter =
    parameters::Find(parameters::Owner::Light, "AngularDiameter");
  const auto refusal = parameters::Check(diameter, { degrees, 0.0, 0.0 });
  if (!light)
  {
    vtkErrorMacro("SetAngularDiameter: " << degrees
                                         << " was given for no light, a vtkLight is "
                                            "expected; nothing is changed.");
    return;
  }
  if (refusal)
  {
    vtkErrorMacro("SetAngularDiameter: " << refusal->Reason() << "; nothing is changed.");
    return;
  }
  diameter.Set(light, { degrees, 0.0, 0.0 });
}

//------------------------------------------------------------------------------
double vtkReliefScene::GetAngularDiameter(vtkLight* light)
{
  vtkInformation* information = light ? light->GetInformation() : nullptr;
  return information && information->Has(ANGULAR_DIAMETER()) ? information->Get(ANGULAR_DIAMETER())
                                                             : 0.0;
}

//------------------------------------------------------------------------------
void vtkReliefScene::SetEnvironment(vtkReliefEnvironment* environment)
{
  if (this->Environment != environment)
  {
    this->Environment = environment;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkReliefEnvironment* vtkReliefScene::GetEnvironment()
{
  return this->Environment;
}

//------------------------------------------------------------------------------
void vtkReliefScene::SetLightsToDefault()
{
  SetLights(this, relief::DefaultLights());
}

//------------------------------------------------------------------------------
void vtkReliefScene::SetLightsToMultidirectional()
{
  SetLights(this, relief::MultidirectionalLights());
}

//------------------------------------------------------------------------------
void vtkReliefScene::SetLightsToSkyDome()
{
  SetLights(this, relief::SkyDomeLights());
}

//------------------------------------------------------------------------------
void vtkReliefScene::SetLightsToSunAndSky(double azimuth, double altitude)
{
  if (const auto refusal = parameters::CheckSunAndSky(azimuth, altitude))
  {
    vtkErrorMacro("SetLightsToSunAndSky: " << refusal->Reason() << "; the lights are kept.");
    return;
  }
  SetLights(this, relief::SunAndSkyLights(azimuth, altitude));
}

//------------------------------------------------------------------------------
void vtkReliefScene::SetLightsToCombined(double azimuth, double altitude)
{
  if (const auto refusal = parameters::CheckSun(azimuth, altitude, 0.0))
  {
    vtkErrorMacro("SetLightsToCombined: " << refusal->Reason() << "; the lights are kept.");
    return;
  }
  SetLights(this, relief::CombinedLights(azimuth, altitude));
}

//------------------------------------------------------------------------------
void vtkReliefScene::SetLightsToIgor(double azimuth)
{
  if (const auto refusal = parameters::CheckSun(azimuth, parameters::UsualAltitude, 0.0))
  {
    vtkErrorMacro("SetLightsToIgor: " << refusal->Reason() << "; the lights are kept.");
    return;
  }
  SetLights(this, relief::IgorLights(azimuth));
}

//------------------------------------------------------------------------------
void vtkReliefScene::CopyAllBut(vtkReliefScene* other, vtkReliefEnvironment* environment)
{
  parameters::Copy(other, this);
  vtkNew<vtkReliefMaterial> material;
  material->DeepCopy(other->Material);
  this->SetMaterial(material);
  this->RemoveAllLights();
  for (vtkLight* light : vtk::Range(other->Lights.Get()))
  {
    this->AddLight(CopyOf(light));
  }
  this->SetEnvironment(environment);
}

//------------------------------------------------------------------------------
void vtkReliefScene::DeepCopy(vtkReliefScene* other)
{
  if (other && other != this)
  {
    vtkNew<vtkReliefEnvironment> environment;
    environment->DeepCopy(other->Environment);
    this->CopyAllBut(other, other->Environment ? environment.Get() : nullptr);
  }
}

//------------------------------------------------------------------------------
void vtkReliefScene::CopySharingImage(vtkReliefScene* other)
{
  if (other && other != this)
  {
    vtkNew<vtkReliefEnvironment> environment;
    environment->ShallowCopy(other->Environment);
    this->CopyAllBut(other, other->Environment ? environment.Get() : nullptr);
  }
}

//------------------------------------------------------------------------------
void vtkReliefScene::ShallowCopy(vtkReliefScene* other)
{
  if (other && other != this)
  {
    parameters::Copy(other, this);
    this->SetMaterial(other->Material);
    this->RemoveAllLights();
    for (vtkLight* light : vtk::Range(other->Lights.Get()))
    {
      this->AddLight(light);
    }
    this->SetEnvironment(other->Environment);
  }
}

//------------------------------------------------------------------------------
vtkMTimeType vtkReliefScene::GetMTime()
{
  vtkMTimeType time = std::max(
    { this->Superclass::GetMTime(), this->Material->GetMTime(), this->Lights->GetMTime() });
  for (vtkLight* light : vtk::Range(this->Lights.Get()))
  {
    time = std::max(time, light->GetMTime());
    if (vtkMatrix4x4* transform = light->GetTransformMatrix())
    {
      time = std::max(time, transform->GetMTime());
    }
  }
  return this->Environment ? std::max(time, this->Environment->GetMTime()) : time;
}

//------------------------------------------------------------------------------
void vtkReliefScene::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Material:\n";
  this->Material->PrintSelf(os, indent.GetNextIndent());
  os << indent << "Lights:\n";
  this->Lights->PrintSelf(os, indent.GetNextIndent());
  os << indent << "Environment:" << (this->Environment ? "" : " (none)") << "\n";
  if (this->Environment)
  {
    this->Environment->PrintSelf(os, indent.GetNextIndent());
  }
  parameters::Print(this, os, indent);
}
