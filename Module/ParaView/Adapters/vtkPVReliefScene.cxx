// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVReliefScene.h"

#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefEnvironmentImage.h"
#include "vtkReliefMaterial.h"
#include "vtkSmartPointer.h"

#include "SceneParameters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <tuple>
#include <utility>

vtkStandardNewMacro(vtkPVReliefScene);

namespace parameters = relief::parameters;

namespace
{
using Held = std::pair<const parameters::Parameter*, parameters::Values>;

// What the names of parameters begin with; both kinds of lights have those of the table's.
constexpr const char* SunPrefix = "Sun.";
constexpr const char* LampPrefix = "Lamp.";

std::string Prefix(const parameters::Parameter& parameter)
{
  return std::string(parameters::NameOf(parameter.Of)) + ".";
}
}

struct vtkPVReliefScene::Settings
{
  Settings();

  // Hands an owner its parameters, in the order of the table.
  void Give(vtkObject* owner, parameters::Owner of, const std::string& prefix) const;

  std::map<std::string, Held> Parameters;
  int Lighting = SUN;
  double Azimuth = parameters::UsualAzimuth;
  double Altitude = parameters::UsualAltitude;
  bool SunByTime = false;
  std::string SunTime;
  std::array<double, 2> SunPlace{ 0.0, 0.0 };
  double SunConvergence = 0.0;
  double SunElevation = 0.0;
  bool SunRefraction = true;
  int EnvironmentSource = WHITE_DOME;
  double Turbidity = parameters::UsualTurbidity;
  std::string EnvironmentFile;
  bool UseLamp = false;
  std::array<double, 3> LampPosition{ 0.0, 0.0, 1.0 };

  bool FitHeightScale = false;
  // What the height scale was chosen from last.
  using Origin = std::tuple<vtkImageData*, vtkMTimeType, vtkImageData*, vtkMTimeType, double>;
  Origin FittedTo;

  // Where the sun stands after all: azimuth from +y, and altitude.
  std::array<double, 2> Sun{ 0.0, 0.0 };
  // The image that was read last, and from where.
  vtkSmartPointer<vtkImageData> Image;
  std::string ImageFile;
  bool Changed = true;
};

//------------------------------------------------------------------------------
vtkPVReliefScene::Settings::Settings()
{
  for (const parameters::Parameter& parameter : parameters::All())
  {
    const Held held{ &parameter, parameter.Default };
    if (parameter.Of != parameters::Owner::Light)
    {
      this->Parameters.emplace(Prefix(parameter) + parameter.Name, held);
      continue;
    }
    this->Parameters.emplace(std::string(SunPrefix) + parameter.Name, held);
    if (!parameter.OfSuns)
    {
      this->Parameters.emplace(std::string(LampPrefix) + parameter.Name, held);
    }
  }
  this->Parameters[std::string(SunPrefix) + "Intensity"].second[0] = parameters::UsualIntensity;
}

//------------------------------------------------------------------------------
void vtkPVReliefScene::Settings::Give(
  vtkObject* owner, parameters::Owner of, const std::string& prefix) const
{
  for (const parameters::Parameter* parameter : parameters::Of(of))
  {
    const auto held = this->Parameters.find(prefix + parameter->Name);
    if (held != this->Parameters.end())
    {
      parameter->Set(owner, held->second.second);
    }
  }
}

//------------------------------------------------------------------------------
vtkPVReliefScene::vtkPVReliefScene()
  : Internal(new Settings)
{
}

//------------------------------------------------------------------------------
vtkPVReliefScene::~vtkPVReliefScene() = default;

//------------------------------------------------------------------------------
template <class Value>
void vtkPVReliefScene::Note(Value& held, const Value& value)
{
  if (held != value)
  {
    held = value;
    this->Internal->Changed = true;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkPVReliefScene::SetParameter(const char* name, double value)
{
  this->SetParameter(name, value, 0.0, 0.0);
}

void vtkPVReliefScene::SetParameter(const char* name, double first, double second)
{
  this->SetParameter(name, first, second, 0.0);
}

void vtkPVReliefScene::SetParameter(const char* name, double first, double second, double third)
{
  const auto found = this->Internal->Parameters.find(name ? name : "");
  if (found == this->Internal->Parameters.end())
  {
    vtkErrorMacro("SetParameter: there is no parameter '" << (name ? name : "") << "'.");
    return;
  }
  const parameters::Parameter& parameter = *found->second.first;
  parameters::Values& held = found->second.second;
  parameters::Values values{ first, second, third };
  if (parameter.Is == parameters::Kind::Length && values[0] == 0.0)
  {
    values[0] = std::numeric_limits<double>::infinity();
  }
  if (const auto refusal = parameters::Check(parameter, values))
  {
    vtkErrorMacro(<< name << ": " << refusal->Reason() << "; " << parameters::Text(parameter, held)
                  << " is kept.");
    return;
  }
  this->Note(held, values);
}

//------------------------------------------------------------------------------
void vtkPVReliefScene::SetLighting(int mode)
{
  this->Note(this->Internal->Lighting, std::clamp<int>(mode, SUN, SUN_AND_ENVIRONMENT));
}

void vtkPVReliefScene::SetSunAzimuth(double degrees)
{
  this->Note(this->Internal->Azimuth, degrees);
}

void vtkPVReliefScene::SetSunAltitude(double degrees)
{
  this->Note(this->Internal->Altitude, degrees);
}

void vtkPVReliefScene::SetSunByTime(bool byTime)
{
  this->Note(this->Internal->SunByTime, byTime);
}

void vtkPVReliefScene::SetSunTime(const char* time)
{
  this->Note(this->Internal->SunTime, std::string(time ? time : ""));
}

void vtkPVReliefScene::SetSunPlace(double longitude, double latitude)
{
  this->Note(this->Internal->SunPlace, { longitude, latitude });
}

void vtkPVReliefScene::SetSunConvergence(double degrees)
{
  this->Note(this->Internal->SunConvergence, degrees);
}

void vtkPVReliefScene::SetSunElevation(double meters)
{
  this->Note(this->Internal->SunElevation, meters);
}

void vtkPVReliefScene::SetSunRefraction(bool refraction)
{
  this->Note(this->Internal->SunRefraction, refraction);
}

void vtkPVReliefScene::SetEnvironmentSource(int source)
{
  this->Note(this->Internal->EnvironmentSource, std::clamp<int>(source, WHITE_DOME, IMAGE_FILE));
}

void vtkPVReliefScene::SetTurbidity(double turbidity)
{
  this->Note(this->Internal->Turbidity, turbidity);
}

void vtkPVReliefScene::SetEnvironmentFile(const char* fileName)
{
  this->Note(this->Internal->EnvironmentFile, std::string(fileName ? fileName : ""));
}

void vtkPVReliefScene::SetUseLamp(bool use)
{
  this->Note(this->Internal->UseLamp, use);
}

void vtkPVReliefScene::SetLampPosition(double x, double y, double z)
{
  this->Note(this->Internal->LampPosition, { x, y, z });
}

void vtkPVReliefScene::SetFitHeightScale(bool fit)
{
  this->Note(this->Internal->FitHeightScale, fit);
}

//------------------------------------------------------------------------------
void vtkPVReliefScene::Update(vtkImageData* heights, vtkImageData* mask, double noData)
{
  // NaN would never compare equal; no height is infinite.
  const Settings::Origin origin(heights, heights ? heights->GetMTime() : 0, mask,
    mask ? mask->GetMTime() : 0,
    std::isnan(noData) ? std::numeric_limits<double>::infinity() : noData);
  const bool fits = this->Internal->FitHeightScale;
  const bool changed = this->Internal->Changed;
  if (changed)
  {
    this->Internal->Changed = false;
    this->Internal->Give(this, parameters::Owner::Scene, "Scene.");
    this->Internal->Give(this->GetMaterial(), parameters::Owner::Material, "Material.");
    this->MakeLights();
  }
  if (fits && heights && (changed || this->Internal->FittedTo != origin))
  {
    this->FitHeightScale(heights, mask, noData);
    this->Internal->FittedTo = origin;
  }
}

//------------------------------------------------------------------------------
// Finds where the sun stands. False, after an error, where time or place are none.
bool vtkPVReliefScene::PlaceSun()
{
  Settings& settings = *this->Internal;
  settings.Sun = { settings.Azimuth, settings.Altitude };
  if (settings.SunByTime)
  {
    double angles[2];
    if (!this->FindSun(settings.SunTime.c_str(), settings.SunPlace[0], settings.SunPlace[1],
          settings.SunElevation, settings.SunRefraction, angles))
    {
      return false;
    }
    settings.Sun = { angles[0] - settings.SunConvergence, angles[1] };
  }
  return true;
}

//------------------------------------------------------------------------------
void vtkPVReliefScene::MakeLights()
{
  const Settings& settings = *this->Internal;
  if (settings.Lighting != MULTIDIRECTIONAL && settings.Lighting != SKY_DOME && !this->PlaceSun())
  {
    return; // the lights are kept
  }
  switch (settings.Lighting)
  {
    case MULTIDIRECTIONAL:
      this->SetLightsToMultidirectional();
      break;
    case SKY_DOME:
      this->SetLightsToSkyDome();
      break;
    case SUN_AND_SKY:
      this->SetLightsToSunAndSky(settings.Sun[0], settings.Sun[1]);
      break;
    default:
      this->RemoveAllLights();
      this->SetEnvironment(nullptr);
      this->AddOwnSun();
      if (settings.Lighting == SUN_AND_ENVIRONMENT)
      {
        this->AddEnvironment();
      }
      break;
  }
  this->AddLamp();
}

//------------------------------------------------------------------------------
void vtkPVReliefScene::AddOwnSun()
{
  const Settings& settings = *this->Internal;
  if (vtkLight* sun = this->AddSun(settings.Sun[0], settings.Sun[1]))
  {
    settings.Give(sun, parameters::Owner::Light, SunPrefix);
  }
}

//------------------------------------------------------------------------------
void vtkPVReliefScene::AddLamp()
{
  const Settings& settings = *this->Internal;
  if (settings.UseLamp)
  {
    vtkNew<vtkLight> lamp;
    lamp->SetLightTypeToSceneLight();
    lamp->PositionalOn();
    lamp->SetPosition(settings.LampPosition.data());
    settings.Give(lamp, parameters::Owner::Light, LampPrefix);
    this->AddLight(lamp);
  }
}

//------------------------------------------------------------------------------
void vtkPVReliefScene::AddEnvironment()
{
  Settings& settings = *this->Internal;
  vtkNew<vtkReliefEnvironment> environment;
  if (settings.EnvironmentSource == WHITE_DOME)
  {
    environment->SetImageToWhiteDome();
  }
  else if (settings.EnvironmentSource == CLEAR_SKY)
  {
    const auto refusal =
      parameters::CheckClearSky(settings.Sun[0], settings.Sun[1], settings.Turbidity);
    if (refusal)
    {
      vtkErrorMacro("Clear sky: " << refusal->Reason() << "; there is no environment.");
      return;
    }
    environment->SetImageToClearSky(settings.Sun[0], settings.Sun[1], settings.Turbidity);
  }
  else
  {
    const std::string& file = settings.EnvironmentFile;
    if (!settings.Image || settings.ImageFile != file)
    {
      const std::string wrong = file.empty()
        ? std::string("no file is named; name one, or take another environment")
        : vtkReliefEnvironmentImage::TryToRead(environment, file.c_str());
      if (!wrong.empty())
      {
        settings.Image = nullptr;
        vtkErrorMacro(
          "EnvironmentFile '" << file << "': " << wrong << "; there is no environment.");
        return;
      }
      settings.Image = environment->GetImage();
      settings.ImageFile = file;
    }
    environment->SetImage(settings.Image);
    environment->SetFileName(file.c_str());
  }
  settings.Give(environment, parameters::Owner::Environment, "Environment.");
  this->SetEnvironment(environment);
}

//------------------------------------------------------------------------------
void vtkPVReliefScene::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const Settings& settings = *this->Internal;
  os << indent << "Lighting: " << settings.Lighting << "\n";
  os << indent << "Sun: " << settings.Azimuth << ", " << settings.Altitude << "\n";
  os << indent << "SunByTime: " << (settings.SunByTime ? settings.SunTime : "Off") << "\n";
  os << indent << "EnvironmentSource: " << settings.EnvironmentSource << "\n";
  os << indent << "EnvironmentFile: " << settings.EnvironmentFile << "\n";
  os << indent << "Turbidity: " << settings.Turbidity << "\n";
  os << indent << "FitHeightScale: " << (settings.FitHeightScale ? "On" : "Off") << "\n";
  os << indent << "UseLamp: " << (settings.UseLamp ? "On" : "Off") << "\n";
  for (const auto& held : settings.Parameters)
  {
    os << indent << held.first << ": " << parameters::Text(*held.second.first, held.second.second)
       << "\n";
  }
}
