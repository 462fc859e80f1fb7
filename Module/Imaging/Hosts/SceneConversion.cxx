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

#include "LightSampling.h"

#include <algorithm>
#include <cmath>
#include <string>

static_assert(
  static_cast<int>(vtkReliefMaterial::SurfaceNormal) == relief::f64::RELIEF_SURFACE_NORMAL);
static_assert(
  static_cast<int>(vtkReliefMaterial::TangentPlane) == relief::f64::RELIEF_TANGENT_PLANE);
static_assert(static_cast<int>(vtkReliefMaterial::Exponential) == relief::f64::RELIEF_EXPONENTIAL);

namespace relief::hosts
{
namespace
{
// As LargestLength: the model's single precision needs room, and what is beyond looks the same.
constexpr double LargestColor = 1e6;
constexpr double LargestRadiance = 1e30;
constexpr double LargestNumber = 1e30;
constexpr double LargestHeight = 4e37; // beyond any relief that is not refused

double Bounded(double value, double largest)
{
  return std::clamp(value, -largest, largest);
}

f64::ReliefFalloff Falloff(const double range[2], double power)
{
  return { Bounded(range[0], LargestNumber), Bounded(range[1], LargestNumber),
    Bounded(power, LargestNumber) };
}

// A lamp farther away stands in the same direction, and light that is stronger is as white.
void Bound(Light& light)
{
  const double length = std::hypot(light.vector.x, light.vector.y, light.vector.z);
  if (light.positional && length > LargestLength)
  {
    light.vector *= LargestLength / length;
  }
  const double brightest =
    std::max({ std::abs(light.color.x), std::abs(light.color.y), std::abs(light.color.z) }) *
    std::abs(light.weight);
  if (std::abs(light.intensity) * brightest > LargestRadiance)
  {
    light.intensity = std::copysign(LargestRadiance / brightest, light.intensity);
  }
}
}

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
  std::vector<Light>& result, std::vector<Light>& sun)
{
  result.clear();
  sun.clear();
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
      const double diameter =
        converted.positional ? 0.0 : vtkReliefScene::GetAngularDiameter(light);
      const std::vector<Light> disc = SampleDisc(
        converted, vtkMath::RadiansFromDegrees(diameter), scene->GetNumberOfSunSamples());
      result.insert(result.end(), disc.begin(), disc.end());
      if (sun.empty() && !converted.positional)
      {
        sun = disc;
      }
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
    if (std::isfinite(environment->GetRadius()))
    {
      const HeightView<float>& heights = field.GetField().heights;
      const glm::dvec3 center(0.5 * (heights.columns - 1) * heights.spacingX,
        0.5 * (heights.rows - 1) * heights.spacingY,
        field.HasData() ? 0.5 * (static_cast<double>(field.GetBottom()) + field.GetTop()) : 0.0);
      PlaceOnSphere(samples, center, environment->GetRadius());
    }
    if (result.empty())
    {
      result = std::move(samples);
    }
    else
    {
      result.insert(result.end(), samples.begin(), samples.end());
    }
  }
  else
  {
    environmentLights.Release();
  }
  std::for_each(result.begin(), result.end(), Bound);
  return std::string();
}

//------------------------------------------------------------------------------
Scene ConvertMaterial(vtkReliefScene* scene, const ImageFrame& frame, double datum)
{
  vtkReliefMaterial* material = scene->GetMaterial();
  auto color = [](const double c[3])
  {
    return glm::dvec3(
      std::min(c[0], LargestColor), std::min(c[1], LargestColor), std::min(c[2], LargestColor));
  };
  Scene result;
  result.base = color(material->GetBaseColor());
  result.diffuse = color(material->GetDiffuseColor());
  result.specular = color(material->GetSpecularColor());
  result.specularCoefficient = material->GetSpecularCoefficient();
  result.scatterCoefficient = material->GetForwardScatterCoefficient();
  result.specularFalloff = Falloff(material->GetSpecularRange(), material->GetSpecularPower());
  result.scatterFalloff =
    Falloff(material->GetForwardScatterRange(), material->GetForwardScatterPower());
  result.medium.depth = std::min(material->GetDepthFor(frame.Spacing), LargestLength);
  result.medium.offset = material->GetOffsetMode();
  result.medium.attenuation = material->GetAttenuation();
  result.medium.density = std::min(material->GetDensity(), LargestNumber);
  result.medium.useFloor = material->GetUseFloor();
  result.medium.floorHeight = Bounded(material->GetFloorHeight() - datum, LargestHeight);
  result.medium.tolerance = std::min(scene->GetTolerance(), 1.0); // of d, which is no more
  result.integrator =
    scene->GetIntegrator() == vtkReliefScene::Exact ? Integrator::Exact : Integrator::FixedStep;
  result.steps = scene->GetNumberOfSteps();
  result.response = scene->GetResponse();
  result.exposure = scene->GetExposure();
  return result;
}
}
