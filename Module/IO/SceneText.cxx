// SPDX-License-Identifier: BSD-3-Clause
#include "SceneText.h"

#include "vtkCollectionRange.h"
#include "vtkErrorCode.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkReliefAngles.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"

#include "EnvironmentPicture.h"
#include "FileGuard.h"
#include "SceneJSON.h"
#include "SceneParameters.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>
#include <limits>

namespace relief::io
{
namespace
{
const int Version = 1;
const std::vector<std::string> LightKinds = { "sun", "point" };

// Of an environment's image, by vtkReliefEnvironment::ImageSources. An image of the user's own has
// no name: in its place stands what says that there is none.
std::vector<std::string> ImageKinds()
{
  std::vector<std::string> kinds;
  for (const char* name : parameters::ImageSourceNames())
  {
    kinds.push_back(parameters::NameAsKey(name));
  }
  kinds[vtkReliefEnvironment::UserImage] = "none";
  return kinds;
}

//------------------------------------------------------------------------------
void WriteParameters(JSONWriter& json, parameters::Owner owner, vtkObject* object)
{
  for (const parameters::Parameter* parameter : parameters::Of(owner))
  {
    json.Parameter(*parameter, parameter->Get(object));
  }
}

void ReadParameters(JSONReader& json, parameters::Owner owner, vtkObject* object)
{
  for (const parameters::Parameter* parameter : parameters::Of(owner))
  {
    parameters::Values value{ 0.0, 0.0, 0.0 };
    if (json.Parameter(*parameter, value))
    {
      parameter->Set(object, value);
    }
  }
}

//------------------------------------------------------------------------------
// Whether a sun at these angles shines from v, to the last bit of each component.
bool Reproduces(double azimuth, double altitude, const double v[3])
{
  double sun[3];
  double unit[3];
  vtkReliefDirection(azimuth, altitude, sun);
  std::copy_n(v, 3, unit);
  if (std::abs(vtkMath::Norm(v) - 1.0) > 1e-12)
  {
    vtkMath::Normalize(unit);
    vtkMath::Normalize(sun);
  }
  return std::equal(sun, sun + 3, unit);
}

double Rounded(double value, int decimals)
{
  const double scale = std::pow(10.0, decimals);
  return std::round(value * scale) / scale;
}

// The angles of a sun, with as few decimals as give it back. Returns false if none do: a direction
// that no angles were the origin of.
bool FindAngles(const double v[3], double& azimuth, double& altitude)
{
  vtkReliefAngles(v, azimuth, altitude);
  for (int decimals = 0; decimals <= 13; ++decimals)
  {
    const double a = Rounded(azimuth, decimals);
    const double b = Rounded(altitude, decimals);
    if (Reproduces(a, b, v))
    {
      azimuth = a;
      altitude = b;
      return true;
    }
  }
  // The neighbours of what the arc tangents give.
  const int reach = 8;
  const double infinite = std::numeric_limits<double>::infinity();
  double a = azimuth;
  double lowest = altitude;
  for (int i = 0; i < reach; ++i)
  {
    a = std::nextafter(a, -infinite);
    lowest = std::nextafter(lowest, -infinite);
  }
  for (int i = 0; i <= 2 * reach; ++i, a = std::nextafter(a, infinite))
  {
    double b = lowest;
    for (int j = 0; j <= 2 * reach; ++j, b = std::nextafter(b, infinite))
    {
      if (Reproduces(a, b, v))
      {
        azimuth = a;
        altitude = b;
        return true;
      }
    }
  }
  azimuth = Rounded(azimuth, 9);
  altitude = Rounded(altitude, 9);
  return false;
}

//------------------------------------------------------------------------------
void WriteLight(JSONWriter& json, vtkLight* light)
{
  double position[3];
  light->GetTransformedPosition(position);
  const bool positional = light->GetPositional() != 0;
  json.Text("kind", LightKinds[positional ? 1 : 0]);
  if (positional)
  {
    json.Vector("position", position, 3);
  }
  else
  {
    double focal[3];
    light->GetTransformedFocalPoint(focal);
    double toward[3];
    vtkMath::Subtract(position, focal, toward);
    double azimuth;
    double altitude;
    const bool exact = FindAngles(toward, azimuth, altitude);
    if (!std::isfinite(vtkMath::Norm(toward)) || vtkMath::Norm(toward) == 0.0)
    {
      throw Failure(
        vtkErrorCode::UnknownError, "a sun's position and focal point must be finite and differ");
    }
    json.Number("azimuth", azimuth);
    json.Number("altitude", altitude);
    if (!exact)
    {
      json.Vector("toward", toward, 3);
    }
  }
  for (const parameters::Parameter* parameter : parameters::Of(parameters::Owner::Light))
  {
    const parameters::Values value = parameter->Get(light);
    if (parameters::Counts(*parameter, light) || value != parameter->Default)
    {
      json.Parameter(*parameter, value);
    }
  }
}

// Adds a light to the scene. Its kind decides which keys it must have.
void ReadLight(JSONReader& json, vtkReliefScene* scene)
{
  vtkNew<vtkLight> lamp;
  vtkLight* light = lamp;
  if (json.NeedChoice("kind", LightKinds) == 0)
  {
    const double azimuth = json.NeedNumber("azimuth");
    const double altitude = json.NeedNumber("altitude");
    json.Check("", parameters::CheckSun(azimuth, altitude, 0.0));
    light = scene->AddSun(azimuth, altitude);
    // The last digits of the direction, unless somebody has changed the angles since.
    double toward[3];
    if (json.Vector("toward", toward, 3) && vtkMath::Norm(toward) > 0.0 &&
      vtkMath::DegreesFromRadians(vtkMath::AngleBetweenVectors(toward, light->GetPosition())) <
        1e-8)
    {
      light->SetPosition(toward);
    }
  }
  else
  {
    light->SetLightTypeToSceneLight();
    light->PositionalOn();
    double position[3];
    json.NeedVector("position", position, 3);
    light->SetPosition(position);
    scene->AddLight(light);
  }
  ReadParameters(json, parameters::Owner::Light, light);
}

//------------------------------------------------------------------------------
std::string RelativeTo(const std::string& folder, const std::string& fileName)
{
  using vtksys::SystemTools;
  const std::string file = SystemTools::CollapseFullPath(fileName);
  if (folder.empty())
  {
    return file;
  }
  const std::string from = SystemTools::CollapseFullPath(folder) + "/";
  return file.compare(0, from.size(), from) == 0 ? file.substr(from.size()) : file;
}

void WriteEnvironment(
  JSONWriter& json, vtkReliefEnvironment* environment, const std::string& folder)
{
  const int source = environment->GetImageSource();
  if (environment->GetImage() && source == vtkReliefEnvironment::UserImage)
  {
    throw Failure(vtkErrorCode::UnknownError,
      "the environment's image was set without a file name; SetFileName tells where it is");
  }
  // A file may be named that is not read yet.
  const bool any = environment->GetImage() || source == vtkReliefEnvironment::File;
  json.Text("image", ImageKinds()[any ? source : vtkReliefEnvironment::UserImage]);
  if (source == vtkReliefEnvironment::ClearSky)
  {
    json.Number("azimuth", environment->GetClearSkyParameters()[0]);
    json.Number("altitude", environment->GetClearSkyParameters()[1]);
    json.Number("turbidity", environment->GetClearSkyParameters()[2]);
  }
  else if (source == vtkReliefEnvironment::File)
  {
    json.Text("file", RelativeTo(folder, environment->GetFileName()));
  }
  WriteParameters(json, parameters::Owner::Environment, environment);
}

void ReadEnvironment(JSONReader& json, vtkReliefEnvironment* environment, const std::string& folder)
{
  switch (json.NeedChoice("image", ImageKinds()))
  {
    case vtkReliefEnvironment::WhiteDome:
      environment->SetImageToWhiteDome();
      break;
    case vtkReliefEnvironment::ClearSky:
    {
      const double azimuth = json.NeedNumber("azimuth");
      const double altitude = json.NeedNumber("altitude");
      double turbidity = parameters::UsualTurbidity;
      json.Number("turbidity", turbidity);
      json.Check("", parameters::CheckClearSky(azimuth, altitude, turbidity));
      environment->SetImageToClearSky(azimuth, altitude, turbidity);
      break;
    }
    case vtkReliefEnvironment::File:
    {
      const std::string file = json.NeedText("file");
      const std::string path = vtksys::SystemTools::FileIsFullPath(file) ? file : folder + file;
      const EnvironmentPicture picture = ReadEnvironmentPicture(path);
      if (!picture.Image)
      {
        json.Fail("file", "\"" + path + "\" cannot be read: " + picture.Reason);
      }
      environment->SetImage(picture.Image);
      environment->SetFileName(path.c_str());
      break;
    }
    default:
      break;
  }
  ReadParameters(json, parameters::Owner::Environment, environment);
}
}

//------------------------------------------------------------------------------
std::string SceneToText(vtkReliefScene* scene, const std::string& folder)
{
  JSONWriter json;
  json.BeginObject(nullptr);
  json.Count("reliefScene", Version);
  WriteParameters(json, parameters::Owner::Scene, scene);
  json.BeginObject("material");
  WriteParameters(json, parameters::Owner::Material, scene->GetMaterial());
  json.EndObject();
  json.BeginArray("lights");
  for (vtkLight* light : vtk::Range(scene->GetLights()))
  {
    json.BeginObject(nullptr);
    WriteLight(json, light);
    json.EndObject();
  }
  json.EndArray();
  if (scene->GetEnvironment())
  {
    json.BeginObject("environment");
    WriteEnvironment(json, scene->GetEnvironment(), folder);
    json.EndObject();
  }
  json.EndObject();
  return json.GetText();
}

//------------------------------------------------------------------------------
SceneTextReport SceneFromText(
  const std::string& text, const std::string& folder, vtkReliefScene* scene)
{
  JSONDocument document(text);
  JSONReader json(document);
  const int version = json.NeedCount("reliefScene");
  if (version != Version)
  {
    json.Fail("reliefScene",
      version > Version ? "the file is of version " + std::to_string(version) +
          ", this program reads version " + std::to_string(Version)
                        : "there is no version " + std::to_string(version));
  }
  SceneTextReport report;
  ReadParameters(json, parameters::Owner::Scene, scene);
  double scale = 0.0;
  report.NamesHeightScale = json.Number("heightScale", scale);
  json.Object("material",
    [&](JSONReader& inner)
    { ReadParameters(inner, parameters::Owner::Material, scene->GetMaterial()); });
  json.Objects("lights", [&](JSONReader& inner) { ReadLight(inner, scene); });
  json.Object("environment",
    [&](JSONReader& inner)
    {
      vtkNew<vtkReliefEnvironment> environment;
      ReadEnvironment(inner, environment, folder);
      scene->SetEnvironment(environment);
    });
  json.Finish();
  report.UnknownKeys = document.GetUnknownKeys();
  return report;
}
}
