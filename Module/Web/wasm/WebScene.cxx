// SPDX-License-Identifier: BSD-3-Clause
#include "WebScene.h"

#include "Angles.h"
#include "ClearSky.h"
#include "EnvironmentMap.h"
#include "SceneBounds.h"

namespace relief::web
{

namespace
{

glm::dvec3 ColorOf(const Values& values)
{
  return { values[0], values[1], values[2] };
}

RadianceMap MapOf(const WebScene& scene)
{
  glm::dvec3 sun;
  switch (scene.sky)
  {
    case Sky::WhiteDome:
      return WhiteDome();
    case Sky::Clear:
      DirectionOf(scene.skyAzimuth, scene.skyAltitude, &sun.x);
      return ClearSky(sun, scene.turbidity, ClearSkyColumns, ClearSkyRows);
    default:
      return relief::MapOf(scene.skyPicture, true);
  }
}

void AddEnvironment(const WebScene& scene, const HeightField& field, Scene& result, int& cleaned)
{
  std::vector<Light> samples = EnvironmentLights(scene, cleaned);
  PlaceAround(field, scene[key::EnvironmentRadius], samples);
  result.lights.insert(result.lights.end(), samples.begin(), samples.end());
}

void AddTexture(
  ColorTexture picture, const WebHeights& heights, std::vector<ColorTexture>& textures)
{
  if (picture.texels)
  {
    StretchOver(heights, picture);
    textures.push_back(picture);
  }
}

}

std::vector<Light> EnvironmentLights(const WebScene& scene, int& cleaned)
{
  std::vector<Light> samples = scene.samples;
  if (scene.sky != Sky::None)
  {
    const RadianceMap map = MapOf(scene);
    cleaned = static_cast<int>(map.GetCleaned());
    samples =
      SampleEnvironment(map, static_cast<EnvironmentSampling>(scene[key::EnvironmentSampling]),
        static_cast<int>(scene[key::EnvironmentNumberOfSamples]),
        TurnOf(scene[key::EnvironmentRotationZ], scene[key::EnvironmentTilt]));
  }
  for (Light& light : samples)
  {
    light.intensity = scene[key::EnvironmentIntensity];
  }
  return samples;
}

WebScene::Source SourceOf(const LightPreset::Sun& sun)
{
  WebScene::Source result;
  DirectionOf(sun.azimuth, sun.altitude, &result.light.vector.x);
  result.light.color = sun.color;
  result.light.intensity = sun.intensity;
  result.diameter = sun.diameter * Degree;
  return result;
}

Scene MaterialOf(const WebScene& scene, const WebHeights& heights)
{
  const auto& values = scene.values;
  auto falloff = [&](key::Parameter range, key::Parameter power) {
    return f64::ReliefFalloff{ values[range][0], values[range][1], values[power][0] };
  };
  Scene result;
  result.base = ColorOf(values[key::MaterialBaseColor]);
  result.diffuse = ColorOf(values[key::MaterialDiffuseColor]);
  result.specular = ColorOf(values[key::MaterialSpecularColor]);
  result.specularCoefficient = scene[key::MaterialSpecularCoefficient];
  result.scatterCoefficient = scene[key::MaterialForwardScatterCoefficient];
  result.specularFalloff = falloff(key::MaterialSpecularRange, key::MaterialSpecularPower);
  result.scatterFalloff =
    falloff(key::MaterialForwardScatterRange, key::MaterialForwardScatterPower);
  result.medium.depth = scene[key::MaterialAutomaticSubsurfaceDepth] != 0.0
    ? (heights.spacing[0] + heights.spacing[1]) / 2.0
    : scene[key::MaterialSubsurfaceDepth];
  result.medium.offset = static_cast<int>(scene[key::MaterialOffsetMode]);
  result.medium.attenuation = static_cast<int>(scene[key::MaterialAttenuation]);
  result.medium.density = scene[key::MaterialDensity];
  result.medium.useFloor = scene[key::MaterialUseFloor] != 0.0;
  result.medium.floorHeight = scene[key::MaterialFloorHeight];
  result.medium.tolerance = scene[key::SceneTolerance];
  result.integrator =
    scene[key::SceneIntegrator] == 0.0 ? Integrator::Exact : Integrator::FixedStep;
  result.steps = static_cast<int>(scene[key::SceneNumberOfSteps]);
  result.response = static_cast<int>(scene[key::SceneResponse]);
  result.exposure = scene[key::SceneExposure];
  Bound(result);
  return result;
}

std::size_t Complete(const WebScene& scene, const WebHeights& heights, const HeightField& field,
  Scene& result, int& cleaned)
{
  result.medium.floorHeight = scene[key::MaterialFloorHeight] - field.GetDatum();
  Bound(result);
  const int samples = static_cast<int>(scene[key::SceneNumberOfSunSamples]);
  for (WebScene::Source source : scene.sources)
  {
    source.light.vector.z -= source.light.positional ? field.GetDatum() : 0.0;
    result.Add(source.light, source.diameter, samples);
  }
  if (scene.sources.empty() && !scene.hasEnvironment)
  {
    for (const LightPreset::Sun& sun : DefaultLights().suns)
    {
      const WebScene::Source source = SourceOf(sun);
      result.Add(source.light, source.diameter, samples);
    }
  }
  const std::size_t around = result.lights.size();
  AddEnvironment(scene, field, result, cleaned);
  for (Light& light : result.lights)
  {
    Bound(light);
  }
  AddTexture(scene.diffuseTexture, heights, result.diffuseTextures);
  AddTexture(scene.baseTexture, heights, result.baseTextures);
  AddTexture(scene.specularTexture, heights, result.specularTextures);
  return around;
}

}
