// SPDX-License-Identifier: BSD-3-Clause
#include "SceneText.h"

#include "vtkCollectionRange.h"
#include "vtkErrorCode.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkReliefAngles.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefMessages.h"
#include "vtkReliefScene.h"

#include "ImageFileAccess.h"
#include "SceneJSON.h"

#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cmath>
#include <limits>

namespace relief::io
{
namespace
{
const int Version = 1;
const std::vector<const char*> LightKinds = { "sun", "point" };
const std::vector<const char*> ImageKinds = { "none", "whiteDome", "clearSky", "file" };
const std::vector<const char*> Integrators = { "Exact", "FixedStep" };
const std::vector<const char*> OffsetModes = { "Vertical", "SurfaceNormal" };
const std::vector<const char*> Attenuations = { "Reciprocal", "Exponential" };
const std::vector<const char*> Samplings = { "Uniform", "SolidAngle", "Importance" };

//------------------------------------------------------------------------------
// One list of keys for both directions: a JSONWriter writes the value, a JSONReader that finds the
// key calls the setter.
template <class JSON>
void Describe(JSON& json, vtkReliefMaterial* m)
{
  json.Vector("baseColor", m->GetBaseColor(), 3, [m](const double* c) { m->SetBaseColor(c); });
  json.Vector(
    "diffuseColor", m->GetDiffuseColor(), 3, [m](const double* c) { m->SetDiffuseColor(c); });
  json.Vector(
    "specularColor", m->GetSpecularColor(), 3, [m](const double* c) { m->SetSpecularColor(c); });
  json.Number("specularCoefficient", m->GetSpecularCoefficient(),
    [m](double v) { m->SetSpecularCoefficient(v); });
  json.Vector(
    "specularRange", m->GetSpecularRange(), 2, [m](const double* r) { m->SetSpecularRange(r); });
  json.Number("specularPower", m->GetSpecularPower(), [m](double v) { m->SetSpecularPower(v); });
  json.Number("forwardScatterCoefficient", m->GetForwardScatterCoefficient(),
    [m](double v) { m->SetForwardScatterCoefficient(v); });
  json.Vector("forwardScatterRange", m->GetForwardScatterRange(), 2,
    [m](const double* r) { m->SetForwardScatterRange(r); });
  json.Number("forwardScatterPower", m->GetForwardScatterPower(),
    [m](double v) { m->SetForwardScatterPower(v); });
  // In this order: setting a depth turns the automatic one off.
  const bool automatic = m->GetAutomaticSubsurfaceDepth();
  json.Number(
    "subsurfaceDepth", m->GetSubsurfaceDepth(), [m](double v) { m->SetSubsurfaceDepth(v); });
  json.Flag(
    "automaticSubsurfaceDepth", automatic, [m](bool on) { m->SetAutomaticSubsurfaceDepth(on); });
  json.Choice("offsetMode", m->GetOffsetMode(), OffsetModes, [m](int i) { m->SetOffsetMode(i); });
  json.Choice(
    "attenuation", m->GetAttenuation(), Attenuations, [m](int i) { m->SetAttenuation(i); });
  json.Number("density", m->GetDensity(), [m](double v) { m->SetDensity(v); });
  json.Flag("useFloor", m->GetUseFloor(), [m](bool on) { m->SetUseFloor(on); });
  json.Number("floorHeight", m->GetFloorHeight(), [m](double v) { m->SetFloorHeight(v); });
}

template <class JSON>
void Describe(JSON& json, vtkReliefScene* s)
{
  json.Number("heightScale", s->GetHeightScale(), [s](double v) { s->SetHeightScale(v); });
  json.Choice("integrator", s->GetIntegrator(), Integrators, [s](int i) { s->SetIntegrator(i); });
  json.Number("tolerance", s->GetTolerance(), [s](double v) { s->SetTolerance(v); });
  json.Count("numberOfSteps", s->GetNumberOfSteps(), [s](int n) { s->SetNumberOfSteps(n); });
  json.Count(
    "numberOfSunSamples", s->GetNumberOfSunSamples(), [s](int n) { s->SetNumberOfSunSamples(n); });
}

template <class JSON>
void Describe(JSON& json, vtkReliefEnvironment* e)
{
  json.Number("rotationZ", e->GetRotationZ(), [e](double v) { e->SetRotationZ(v); });
  json.Number("tilt", e->GetTilt(), [e](double v) { e->SetTilt(v); });
  json.Number("intensity", e->GetIntensity(), [e](double v) { e->SetIntensity(v); });
  json.Length("radius", e->GetRadius(), [e](double v) { e->SetRadius(v); });
  json.Choice("sampling", e->GetSampling(), Samplings, [e](int i) { e->SetSampling(i); });
  json.Count("numberOfSamples", e->GetNumberOfSamples(), [e](int n) { e->SetNumberOfSamples(n); });
}

template <class JSON>
void Describe(JSON& json, vtkLight* l)
{
  json.Vector("color", l->GetDiffuseColor(), 3, [l](const double* c) { l->SetDiffuseColor(c); });
  json.Number("intensity", l->GetIntensity(), [l](double v) { l->SetIntensity(v); });
  json.Flag("on", l->GetSwitch() != 0, [l](bool on) { l->SetSwitch(on); });
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
  azimuth = vtkMath::DegreesFromRadians(std::atan2(v[0], v[1]));
  azimuth += azimuth < 0.0 ? 360.0 : 0.0;
  altitude = vtkMath::DegreesFromRadians(std::atan2(v[2], std::hypot(v[0], v[1])));
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
  const double diameter = vtkReliefScene::GetAngularDiameter(light);
  const bool positional = light->GetPositional() != 0;
  json.Choice("kind", positional ? 1 : 0, LightKinds);
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
  if (!positional || diameter != 0.0)
  {
    json.Number("angularDiameter", diameter);
  }
  Describe(json, light);
}

// Adds a light to the scene. Its kind decides which keys it must have.
void ReadLight(JSONReader& json, vtkReliefScene* scene)
{
  const int kind = json.NeedChoice("kind", LightKinds);
  double diameter = 0.0;
  json.Number("angularDiameter", 0.0, [&](double v) { diameter = v; });
  vtkNew<vtkLight> lamp;
  vtkLight* light = lamp;
  if (kind == 0)
  {
    const double azimuth = json.NeedNumber("azimuth");
    const double altitude = json.NeedNumber("altitude");
    json.Check([&] { light = scene->AddSun(azimuth, altitude, diameter); });
    // The last digits of the direction, unless somebody has changed the angles since.
    json.Vector("toward", light->GetPosition(), 3,
      [&](const double* v)
      {
        const double angle = vtkMath::AngleBetweenVectors(v, light->GetPosition());
        if (vtkMath::Norm(v) > 0.0 && vtkMath::DegreesFromRadians(angle) < 1e-8)
        {
          light->SetPosition(v);
        }
      });
  }
  else
  {
    light->SetLightTypeToSceneLight();
    light->PositionalOn();
    double position[3];
    json.NeedVector("position", position, 3);
    light->SetPosition(position);
    json.Check([&] { scene->SetAngularDiameter(light, diameter); });
    scene->AddLight(light);
  }
  Describe(json, light);
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
  json.Choice("image", any ? source : 0, ImageKinds);
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
  Describe(json, environment);
}

void ReadEnvironment(JSONReader& json, vtkReliefEnvironment* environment, const std::string& folder)
{
  switch (json.NeedChoice("image", ImageKinds))
  {
    case vtkReliefEnvironment::WhiteDome:
      environment->SetImageToWhiteDome();
      break;
    case vtkReliefEnvironment::ClearSky:
    {
      const double azimuth = json.NeedNumber("azimuth");
      const double altitude = json.NeedNumber("altitude");
      double turbidity = 3.0;
      json.Number("turbidity", turbidity, [&](double v) { turbidity = v; });
      json.Check([&] { environment->SetImageToClearSky(azimuth, altitude, turbidity); });
      break;
    }
    case vtkReliefEnvironment::File:
    {
      const std::string file = json.NeedText("file");
      const std::string path = vtksys::SystemTools::FileIsFullPath(file) ? file : folder + file;
      json.Check([&] { environment->SetImageToFile(path.c_str()); });
      break;
    }
    default:
      break;
  }
  Describe(json, environment);
}
}

//------------------------------------------------------------------------------
std::string SceneToText(vtkReliefScene* scene, const std::string& folder)
{
  JSONWriter json;
  json.BeginObject(nullptr);
  json.Count("reliefScene", Version);
  Describe(json, scene);
  json.BeginObject("material");
  Describe(json, scene->GetMaterial());
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
std::string SceneFromText(const std::string& text, const std::string& folder, vtkReliefScene* scene)
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
  vtkNew<vtkReliefEnvironment> environment;
  for (vtkObject* object : { static_cast<vtkObject*>(scene),
         static_cast<vtkObject*>(scene->GetMaterial()), static_cast<vtkObject*>(environment) })
  {
    document.Watch(object);
  }
  Describe(json, scene);
  json.Object("material", [&](JSONReader& inner) { Describe(inner, scene->GetMaterial()); });
  json.Objects("lights", [&](JSONReader& inner) { ReadLight(inner, scene); });
  json.Object("environment",
    [&](JSONReader& inner)
    {
      ReadEnvironment(inner, environment, folder);
      scene->SetEnvironment(environment);
    });
  json.Finish();
  return document.GetUnknownKeys();
}
}
