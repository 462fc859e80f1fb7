// SPDX-License-Identifier: BSD-3-Clause
#include "SceneConversion.h"

#include "SceneParameters.h"
#include "vtkCollectionRange.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"

#include "EnvironmentMap.h"
#include "SceneBounds.h"

#include <cmath>
#include <string>

static_assert(
  static_cast<int>(vtkReliefMaterial::SurfaceNormal) == relief::f64::RELIEF_SURFACE_NORMAL);
static_assert(
  static_cast<int>(vtkReliefMaterial::TangentPlane) == relief::f64::RELIEF_TANGENT_PLANE);
static_assert(static_cast<int>(vtkReliefMaterial::Exponential) == relief::f64::RELIEF_EXPONENTIAL);

namespace relief::hosts
{
//------------------------------------------------------------------------------
// One of VTK's lights in the image's frame, above the field's datum.
static std::string ConvertLight(
  vtkLight* light, const ImageFrame& frame, double datum, Light& result)
{
  double position[3];
  double focal[3];
  light->GetTransformedPosition(position);
  light->GetTransformedFocalPoint(focal);
  result.color = glm::dvec3(
    light->GetDiffuseColor()[0], light->GetDiffuseColor()[1], light->GetDiffuseColor()[2]);
  result.intensity = light->GetIntensity();
  result.positional = light->GetPositional() != 0;
  if (!std::isfinite(result.intensity) ||
    !std::isfinite(result.color.x + result.color.y + result.color.z))
  {
    return "its intensity and colour must be finite";
  }
  if (!std::isfinite(position[0] + position[1] + position[2]))
  {
    return "its position must be finite";
  }
  if (result.positional)
  {
    result.vector = frame.PointFromWorld(position) - glm::dvec3(0.0, 0.0, datum);
    return std::isfinite(std::hypot(result.vector.x, result.vector.y, result.vector.z))
      ? std::string()
      : "its position must be finite";
  }
  const double toward[3] = { position[0] - focal[0], position[1] - focal[1],
    position[2] - focal[2] };
  glm::dvec3 v = frame.VectorFromWorld(toward);
  const double length = std::hypot(v.x, v.y, v.z);
  if (!std::isfinite(length) || length == 0.0)
  {
    return "its position and focal point must be finite and differ";
  }
  result.vector = v / length;
  return std::string();
}

//------------------------------------------------------------------------------
std::string ConvertLights(vtkReliefScene* scene, vtkLightCollection* otherwise,
  EnvironmentLights& environmentLights, const ImageFrame& frame, const HeightField& field,
  Scene& result)
{
  vtkReliefEnvironment* environment = scene->GetEnvironment();
  vtkNew<vtkReliefScene> unlit;
  vtkLightCollection* lights = scene->GetLights();
  if (lights->GetNumberOfItems() == 0 && !environment)
  {
    lights = otherwise;
    if (!lights)
    {
      unlit->SetLightsToDefault();
      lights = unlit->GetLights();
    }
  }
  int lightIndex = 0;
  for (vtkLight* light : vtk::Range(lights))
  {
    if (light->GetSwitch())
    {
      Light converted;
      const std::string wrong = ConvertLight(light, frame, field.GetDatum(), converted);
      if (!wrong.empty())
      {
        return "light " + std::to_string(lightIndex) + ": " + wrong;
      }
      result.Add(converted, vtkMath::RadiansFromDegrees(vtkReliefScene::GetAngularDiameter(light)),
        scene->GetNumberOfSunSamples());
    }
    ++lightIndex;
  }

  if (environment)
  {
    std::vector<Light> samples;
    const std::string wrong = environmentLights.Sample(environment, frame, samples);
    if (!wrong.empty())
    {
      return wrong;
    }
    PlaceAround(field, environment->GetRadius(), samples);
    if (result.lights.empty())
    {
      result.lights = std::move(samples);
    }
    else
    {
      result.lights.insert(result.lights.end(), samples.begin(), samples.end());
    }
  }
  else
  {
    environmentLights.Release();
  }
  for (Light& light : result.lights)
  {
    Bound(light);
  }
  return std::string();
}

//------------------------------------------------------------------------------
Scene ConvertMaterial(vtkReliefScene* scene, const ImageFrame& frame, double datum)
{
  vtkReliefMaterial* material = scene->GetMaterial();
  auto color = [](const double c[3]) { return glm::dvec3(c[0], c[1], c[2]); };
  auto falloff = [](const double range[2], double power) {
    return f64::ReliefFalloff{ range[0], range[1], power };
  };
  Scene result;
  result.base = color(material->GetBaseColor());
  result.diffuse = color(material->GetDiffuseColor());
  result.specular = color(material->GetSpecularColor());
  result.specularCoefficient = material->GetSpecularCoefficient();
  result.scatterCoefficient = material->GetForwardScatterCoefficient();
  result.specularFalloff = falloff(material->GetSpecularRange(), material->GetSpecularPower());
  result.scatterFalloff =
    falloff(material->GetForwardScatterRange(), material->GetForwardScatterPower());
  result.medium.depth = material->GetDepthFor(frame.Spacing);
  result.medium.offset = material->GetOffsetMode();
  result.medium.attenuation = material->GetAttenuation();
  result.medium.density = material->GetDensity();
  result.medium.useFloor = material->GetUseFloor();
  result.medium.floorHeight = material->GetFloorHeight() - datum;
  result.medium.tolerance = scene->GetTolerance();
  result.integrator =
    scene->GetIntegrator() == vtkReliefScene::Exact ? Integrator::Exact : Integrator::FixedStep;
  result.steps = scene->GetNumberOfSteps();
  result.response = scene->GetResponse();
  result.exposure = scene->GetExposure();
  Bound(result);
  return result;
}
}
