// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefScene.h"

#include "vtkCollectionRange.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleKey.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkReliefAngles.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefSetters.h"

#include "ClearSky.h"

#include <algorithm>

vtkStandardNewMacro(vtkReliefScene);

#define vtkReliefThisClass vtkReliefScene
vtkReliefSetNumberBody(HeightScale, double, true, "a finite number");
vtkReliefSetNumberBody(
  Integrator, int, value == Exact || value == FixedStep, "Exact (0) or FixedStep (1)");
vtkReliefSetNumberBody(Tolerance, double, value >= 0.0, "a finite number of at least 0");
vtkReliefSetNumberBody(
  NumberOfSteps, int, value >= 1 && value <= 1000000, "a number in [1, 1000000]");
vtkReliefSetNumberBody(
  NumberOfSunSamples, int, value >= 1 && value <= 4096, "a number in [1, 4096]");

vtkInformationKeyMacro(vtkReliefScene, ANGULAR_DIAMETER, Double);

//------------------------------------------------------------------------------
vtkReliefScene::vtkReliefScene()
  : Material(vtkSmartPointer<vtkReliefMaterial>::New())
{
}

//------------------------------------------------------------------------------
vtkReliefScene::~vtkReliefScene() = default;

//------------------------------------------------------------------------------
vtkReliefSetObjectBody(Material, vtkReliefMaterial, this->Material);

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
  if (!std::isfinite(azimuth) || !(std::abs(altitude) <= 90.0) ||
    !(angularDiameter >= 0.0 && angularDiameter <= 90.0))
  {
    vtkErrorMacro("AddSun: azimuth "
      << azimuth << ", altitude " << altitude << ", angular diameter " << angularDiameter
      << " was given, a finite azimuth, an altitude in [-90, 90] and a diameter in [0, 90] degrees "
         "are expected; no light is added.");
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
void vtkReliefScene::SetAngularDiameter(vtkLight* light, double degrees)
{
  if (!light || !(degrees >= 0.0 && degrees <= 90.0))
  {
    vtkErrorMacro("SetAngularDiameter: " << degrees << " was given for "
                                         << (light ? "a light" : "no light")
                                         << ", a vtkLight and a number in [0, 90] are expected; "
                                            "nothing is changed.");
    return;
  }
  if (vtkReliefScene::GetAngularDiameter(light) != degrees)
  {
    if (!light->GetInformation())
    {
      vtkNew<vtkInformation> information;
      light->SetInformation(information);
    }
    light->GetInformation()->Set(ANGULAR_DIAMETER(), degrees);
    light->Modified();
  }
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
void vtkReliefScene::SetLightsToMultidirectional()
{
  this->RemoveAllLights();
  this->SetEnvironment(nullptr);
  for (double azimuth : { 225.0, 270.0, 315.0, 360.0 })
  {
    this->AddSun(azimuth, 30.0)->SetIntensity(0.25);
  }
}

//------------------------------------------------------------------------------
void vtkReliefScene::SetLightsToSkyDome()
{
  this->RemoveAllLights();
  vtkNew<vtkReliefEnvironment> dome;
  dome->SetImageToWhiteDome();
  dome->SetNumberOfSamples(128);
  this->SetEnvironment(dome);
}

//------------------------------------------------------------------------------
void vtkReliefScene::SetLightsToSunAndSky(double azimuth, double altitude)
{
  if (!std::isfinite(azimuth) || !(altitude >= 0.0 && altitude <= 90.0))
  {
    vtkErrorMacro("SetLightsToSunAndSky: azimuth "
      << azimuth << ", altitude " << altitude
      << " was given, a finite azimuth and an altitude in [0, 90] degrees are expected; the lights "
         "are kept.");
    return;
  }
  const double turbidity = 3.0;
  this->RemoveAllLights();
  vtkLight* sun = this->AddSun(azimuth, altitude, 0.533);
  const glm::dvec3 color = relief::SunColor({ 0.0, 0.0, vtkReliefSinDegrees(altitude) }, turbidity);
  sun->SetDiffuseColor(color.x, color.y, color.z);
  sun->SetIntensity(0.8);
  vtkNew<vtkReliefEnvironment> sky;
  sky->SetImageToClearSky(azimuth, altitude, turbidity);
  sky->SetSamplingToImportance();
  sky->SetIntensity(0.3);
  this->SetEnvironment(sky);
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
  os << indent << "HeightScale: " << this->HeightScale << "\n";
  os << indent << "Integrator: " << (this->Integrator == Exact ? "Exact" : "FixedStep") << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "NumberOfSteps: " << this->NumberOfSteps << "\n";
  os << indent << "NumberOfSunSamples: " << this->NumberOfSunSamples << "\n";
}
