// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefScene.h"

#include "vtkCollectionRange.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefSetters.h"

#include <algorithm>

vtkStandardNewMacro(vtkReliefScene);

#define vtkReliefThisClass vtkReliefScene
vtkReliefSetNumberBody(HeightScale, double, true, "a finite number");
vtkReliefSetNumberBody(
  Integrator, int, value == Exact || value == FixedStep, "Exact (0) or FixedStep (1)");
vtkReliefSetNumberBody(Tolerance, double, value >= 0.0, "a finite number of at least 0");
vtkReliefSetNumberBody(
  NumberOfSteps, int, value >= 1 && value <= 1000000, "a number in [1, 1000000]");

namespace
{
// The sine of an angle in degrees, exact at multiples of 90: a sun due east must not shine a little
// from the north.
double SinDegrees(double degrees)
{
  double turn = std::remainder(degrees, 360.0); // exact, in [-180, 180]
  if (turn > 90.0)
  {
    turn = 180.0 - turn;
  }
  else if (turn < -90.0)
  {
    turn = -180.0 - turn;
  }
  return std::sin(vtkMath::RadiansFromDegrees(turn));
}

double CosDegrees(double degrees)
{
  return SinDegrees(90.0 - std::abs(std::remainder(degrees, 360.0)));
}
}

//------------------------------------------------------------------------------
vtkReliefScene::vtkReliefScene()
  : Material(vtkSmartPointer<vtkReliefMaterial>::New())
{
}

//------------------------------------------------------------------------------
vtkReliefScene::~vtkReliefScene() = default;

//------------------------------------------------------------------------------
void vtkReliefScene::SetMaterial(vtkReliefMaterial* material)
{
  if (!material)
  {
    vtkErrorMacro(
      "SetMaterial: null was given, a vtkReliefMaterial is expected; the old material is "
      "kept.");
    return;
  }
  if (this->Material != material)
  {
    this->Material = material;
    this->Modified();
  }
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
vtkLight* vtkReliefScene::AddSun(double azimuth, double altitude)
{
  if (!std::isfinite(azimuth) || !std::isfinite(altitude) || std::abs(altitude) > 90.0)
  {
    vtkErrorMacro("AddSun: azimuth " << azimuth << ", altitude " << altitude
                                     << " was given, a finite azimuth and an altitude in [-90, 90] "
                                        "degrees are expected; no light is added.");
    return nullptr;
  }
  vtkNew<vtkLight> sun;
  sun->SetLightTypeToSceneLight();
  sun->PositionalOff();
  sun->SetFocalPoint(0.0, 0.0, 0.0);
  double level = CosDegrees(altitude);
  sun->SetPosition(SinDegrees(azimuth) * level, CosDegrees(azimuth) * level, SinDegrees(altitude));
  this->AddLight(sun);
  return sun;
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
  return time;
}

//------------------------------------------------------------------------------
void vtkReliefScene::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Material:\n";
  this->Material->PrintSelf(os, indent.GetNextIndent());
  os << indent << "Lights:\n";
  this->Lights->PrintSelf(os, indent.GetNextIndent());
  os << indent << "HeightScale: " << this->HeightScale << "\n";
  os << indent << "Integrator: " << (this->Integrator == Exact ? "Exact" : "FixedStep") << "\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "NumberOfSteps: " << this->NumberOfSteps << "\n";
}
