// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What module.js calls: a run is set up call by call, shaded, and its results are read. Everything
/// that is given was checked by options.js, and stays where it is until the run ends. Texts are
/// UTF-8 and end with 0; an empty one says that all is well.

#include "WebMemory.h"
#include "WebPlan.h"

#include "Angles.h"
#include "AutomaticExposure.h"
#include "ModelVersion.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace
{

using namespace relief;
using namespace relief::web;

/// What may be asked for, as index.js numbers it.
enum Layer
{
  Picture,
  Illumination,
  Thickness,
  Normals,
  Base,
  Diffuse,
  Scatter,
  Specular,
  Shadow,
  NumberOfLayers
};
constexpr int Components[NumberOfLayers] = { 4, 1, 1, 3, 3, 3, 3, 3, 1 };

enum Number
{
  LightsTraced,
  RaysTraced,
  CellsVisited,
  ExposureStops,
  Effects,
  SamplesWithData, // whether there are any
  CleanedTexels,
  UnusableTexels,
  NumberOfNumbers
};

struct Run
{
  WebHeights heights;
  WebScene scene;
  bool wanted[NumberOfLayers] = {};
  bool eightBit = true;
  int firstRow = 0; ///< of those that are shaded, from the south; all at first
  int rows = 0;
  std::unique_ptr<float[]> layers[NumberOfLayers];
  std::unique_ptr<unsigned char[]> codes;
  double numbers[NumberOfNumbers] = {};
  std::vector<double> lights; ///< those that stand for the environment
  std::vector<double> plan;
  std::string wrong;
};

std::unique_ptr<Run> TheRun;

Target MakeTarget(Run& run)
{
  const std::size_t samples =
    static_cast<std::size_t>(run.heights.columns) * static_cast<std::size_t>(run.rows);
  Target target;
  target.width = run.heights.columns;
  target.j0 = run.firstRow;
  target.rows = run.rows;
  if (run.eightBit)
  {
    run.codes.reset(new unsigned char[4 * samples]);
    target.rgba8 = run.codes.get();
  }
  run.wanted[Picture] = !run.eightBit;
  float** const places[NumberOfLayers] = { &target.rgba, &target.illumination, &target.thickness,
    &target.normals, &target.base, &target.diffuse, &target.scatter, &target.specular,
    &target.shadow };
  for (int layer = 0; layer < NumberOfLayers; ++layer)
  {
    if (run.wanted[layer])
    {
      run.layers[layer].reset(new float[Components[layer] * samples]);
      *places[layer] = run.layers[layer].get();
    }
  }
  return target;
}

void CountTexels(Run& run, int effects)
{
  const std::pair<const ColorTexture*, int> textures[] = { { &run.scene.baseTexture,
                                                             BaseTextureEffect },
    { &run.scene.diffuseTexture, DiffuseTextureEffect },
    { &run.scene.specularTexture, SpecularTextureEffect } };
  for (const auto& [texture, effect] : textures)
  {
    run.numbers[UnusableTexels] += texture->texels && (effects & effect)
      ? static_cast<double>(texture->CountUnusable(0, texture->rows))
      : 0.0;
  }
}

// Heights and scene as the model takes them. Returns what is wrong.
std::string Prepare(Run& run, HeightField& field, Scene& scene, int& cleaned)
{
  scene = MaterialOf(run.scene, run.heights);
  const bool padded = SceneShading::WantsPadding(scene, run.heights.columns);
  const std::string wrong = Assign(run.heights, run.scene[key::SceneHeightScale], padded, field);
  if (wrong.empty())
  {
    Complete(run.scene, run.heights, field, scene, cleaned);
  }
  return wrong;
}

// Finds an automatic exposure, and notes what that took.
void Expose(Run& run, const HeightField& field, Scene& scene)
{
  if (run.scene[key::SceneAutomaticExposure] != 0.0 && field.HasData())
  {
    AutomaticExposure exposure(field, scene);
    exposure.Measure(0, exposure.GetNumberOfTiles());
    scene.exposure = exposure.GetStops();
    run.numbers[RaysTraced] += static_cast<double>(exposure.GetShading().GetRaysTraced());
    run.numbers[CellsVisited] += static_cast<double>(exposure.GetShading().GetCellsVisited());
  }
  run.numbers[ExposureStops] = scene.exposure;
}

std::string Shade(Run& run)
{
  HeightField field;
  Scene scene;
  int cleaned = 0;
  const std::string wrong = Prepare(run, field, scene, cleaned);
  if (!wrong.empty())
  {
    return wrong;
  }
  if (run.wanted[Shadow] && scene.sun.empty())
  {
    return "the layer shadow is that of a sun, and no sun is on; add a sun, or leave the layer out";
  }
  if (run.eightBit)
  {
    Expose(run, field, scene);
  }
  else
  {
    scene.exposure = 0.0;
  }
  SceneShading shading(field, scene, MakeTarget(run));
  shading.Shade(0, run.heights.columns, run.firstRow, run.firstRow + run.rows);
  PictureWriter::Flush();
  run.numbers[LightsTraced] = shading.GetLightsTraced();
  run.numbers[RaysTraced] += static_cast<double>(shading.GetRaysTraced());
  run.numbers[CellsVisited] += static_cast<double>(shading.GetCellsVisited());
  run.numbers[Effects] = shading.GetEffects();
  run.numbers[SamplesWithData] = field.HasData() ? 1.0 : 0.0;
  run.numbers[CleanedTexels] = cleaned;
  CountTexels(run, shading.GetEffects());
  return std::string();
}

ColorTexture MakePicture(const void* texels, int type, int components, int columns, int rows)
{
  ColorTexture picture;
  picture.texels = texels;
  picture.type = static_cast<ColorTexture::Type>(type);
  picture.components = components;
  picture.columns = columns;
  picture.rows = rows;
  return picture;
}

void SetPower(WebScene::Source& source, double intensity, double r, double g, double b)
{
  source.light.intensity = intensity;
  source.light.color = { r, g, b };
}

}

RELIEF_EXPORT int reliefModelVersion()
{
  return relief::ModelVersion;
}

RELIEF_EXPORT void reliefBegin()
{
  EndWithoutMemory();
  TheRun = std::make_unique<Run>();
}

RELIEF_EXPORT void reliefEnd()
{
  TheRun.reset();
}

RELIEF_EXPORT void reliefHeights(
  const void* samples, int type, int columns, int rows, double spacingX, double spacingY)
{
  WebHeights& heights = TheRun->heights;
  heights.samples = samples;
  heights.type = static_cast<ArrayType>(type);
  heights.columns = columns;
  heights.rows = rows;
  heights.spacing[0] = spacingX;
  heights.spacing[1] = spacingY;
  TheRun->rows = rows;
}

// The rows that are shaded, from the south; those that begin and end at multiples of a tile cost
// least.
RELIEF_EXPORT void reliefRows(int first, int count)
{
  TheRun->firstRow = first;
  TheRun->rows = count;
}

RELIEF_EXPORT int reliefTileHeight()
{
  return SweepThickness::TileHeight;
}

RELIEF_EXPORT void reliefNoData(double value)
{
  TheRun->heights.hasNoData = true;
  TheRun->heights.noData = value;
}

RELIEF_EXPORT void reliefMask(const unsigned char* mask)
{
  TheRun->heights.mask = mask;
}

// The scale of heights without a unit, not rounded; 0 where there is nothing to scale.
RELIEF_EXPORT double reliefFitHeightScale()
{
  return FitScale(TheRun->heights);
}

RELIEF_EXPORT void reliefParameter(int parameter, double a, double b, double c)
{
  TheRun->scene.values[static_cast<std::size_t>(parameter)] = { a, b, c };
}

// A sun at angles in degrees; (x, y, z) has the last digits of its direction, unless it disagrees
// with them, as 0 does.
RELIEF_EXPORT void reliefSun(double azimuth, double altitude, double x, double y, double z,
  double diameter, double intensity, double r, double g, double b)
{
  LightPreset::Sun sun;
  sun.azimuth = azimuth;
  sun.altitude = altitude;
  sun.diameter = diameter;
  WebScene::Source source = SourceOf(sun);
  SetPower(source, intensity, r, g, b);
  const glm::dvec3& v = source.light.vector;
  const double length = std::hypot(x, y, z);
  // As sine of the angle between them: it has digits where the cosine is 1.
  const double apart = std::hypot(v.y * z - v.z * y, v.z * x - v.x * z, v.x * y - v.y * x) / length;
  if (length > 0.0 && v.x * x + v.y * y + v.z * z > 0.0 && apart < 1e-8 * Degree)
  {
    source.light.vector = glm::dvec3(x / length, y / length, z / length);
  }
  TheRun->scene.sources.push_back(source);
}

RELIEF_EXPORT void reliefLamp(
  double x, double y, double z, double intensity, double r, double g, double b)
{
  WebScene::Source source;
  source.light.positional = true;
  source.light.vector = { x, y, z };
  SetPower(source, intensity, r, g, b);
  TheRun->scene.sources.push_back(source);
}

RELIEF_EXPORT void reliefSky(int sky, double azimuth, double altitude, double turbidity)
{
  WebScene& scene = TheRun->scene;
  scene.hasEnvironment = true;
  scene.sky = static_cast<Sky>(sky);
  scene.skyAzimuth = azimuth;
  scene.skyAltitude = altitude;
  scene.turbidity = turbidity;
}

RELIEF_EXPORT void reliefSkyPicture(
  const void* texels, int type, int components, int columns, int rows)
{
  TheRun->scene.skyPicture = MakePicture(texels, type, components, columns, rows);
}

// For the layers that have the same numbers: Base, Diffuse and Specular.
RELIEF_EXPORT void reliefTexture(
  int which, const void* texels, int type, int components, int columns, int rows)
{
  WebScene& scene = TheRun->scene;
  ColorTexture& texture = which == Base ? scene.baseTexture
    : which == Diffuse                  ? scene.diffuseTexture
                                        : scene.specularTexture;
  texture = MakePicture(texels, type, components, columns, rows);
}

RELIEF_EXPORT void reliefWant(int layer)
{
  TheRun->wanted[layer] = true;
}

// Linear colours instead of codes of 8 bits.
RELIEF_EXPORT void reliefWantFloat()
{
  TheRun->eightBit = false;
}

// Returns what is wrong.
RELIEF_EXPORT const char* reliefShade()
{
  TheRun->wrong = Shade(*TheRun);
  return TheRun->wrong.c_str();
}

// Finds the exposure, as reliefNumber() then has it, and shades nothing. Returns what is wrong.
RELIEF_EXPORT const char* reliefExpose()
{
  HeightField field;
  Scene scene;
  int cleaned = 0;
  TheRun->wrong = Prepare(*TheRun, field, scene, cleaned);
  if (TheRun->wrong.empty())
  {
    Expose(*TheRun, field, scene);
  }
  return TheRun->wrong.c_str();
}

// Rows from south to north; null where it was not asked for.
RELIEF_EXPORT const void* reliefResult(int layer)
{
  return layer == Picture && TheRun->eightBit
    ? static_cast<const void*>(TheRun->codes.get())
    : static_cast<const void*>(TheRun->layers[layer].get());
}

RELIEF_EXPORT double reliefNumber(int number)
{
  return TheRun->numbers[number];
}

// The lights that stand for the run's environment, eight numbers each: direction, color times
// intensity, weight, scale of the tolerance.
RELIEF_EXPORT int reliefEnvironmentLights()
{
  int cleaned = 0;
  TheRun->lights.clear();
  for (const Light& light : EnvironmentLights(TheRun->scene, cleaned))
  {
    const glm::dvec3 color = light.color * light.intensity;
    for (const double number : { light.vector.x, light.vector.y, light.vector.z, color.x, color.y,
           color.z, light.weight, light.toleranceScale })
    {
      TheRun->lights.push_back(number);
    }
  }
  return static_cast<int>(TheRun->lights.size() / 8);
}

RELIEF_EXPORT const double* reliefEnvironmentNumbers()
{
  return TheRun->lights.data();
}

// A light that stands for the environment, as reliefEnvironmentLights() has found it.
RELIEF_EXPORT void reliefSample(
  double x, double y, double z, double r, double g, double b, double weight, double toleranceScale)
{
  Light light;
  light.vector = { x, y, z };
  light.color = { r, g, b };
  light.weight = weight;
  light.toleranceScale = toleranceScale;
  TheRun->scene.samples.push_back(light);
}

// What a host upon a graphics processor does for heights of this range, as reliefPlanNumbers() then
// has it. Returns what is wrong.
RELIEF_EXPORT const char* reliefPlan(double least, double greatest, int floats)
{
  TheRun->wrong =
    PlanNumbers(TheRun->scene, TheRun->heights, { least, greatest, floats != 0 }, TheRun->plan);
  return TheRun->wrong.c_str();
}

RELIEF_EXPORT const double* reliefPlanNumbers()
{
  return TheRun->plan.data();
}

RELIEF_EXPORT int reliefPlanSize()
{
  return static_cast<int>(TheRun->plan.size());
}

// A preset of LightPresets.h as numbers: those of its sky (kind, intensity, samples, sampling),
// response or -1, how many suns; and of each sun azimuth, altitude, diameter, intensity, color.
RELIEF_EXPORT const double* reliefPreset(int which, double azimuth, double altitude)
{
  static double numbers[64];
  const LightPreset preset = which == 0 ? MultidirectionalLights()
    : which == 1                        ? SkyDomeLights()
    : which == 2                        ? SunAndSkyLights(azimuth, altitude)
    : which == 3                        ? CombinedLights(azimuth, altitude)
    : which == 4                        ? IgorLights(azimuth)
                                        : DefaultLights();
  double* to = numbers;
  for (const double number :
    { static_cast<double>(preset.sky), preset.skyIntensity, static_cast<double>(preset.skySamples),
      static_cast<double>(preset.skySampling), static_cast<double>(preset.response.value_or(-1)),
      static_cast<double>(preset.suns.size()) })
  {
    *to++ = number;
  }
  for (const LightPreset::Sun& sun : preset.suns)
  {
    for (const double number : { sun.azimuth, sun.altitude, sun.diameter, sun.intensity,
           sun.color.x, sun.color.y, sun.color.z })
    {
      *to++ = number;
    }
  }
  return numbers;
}
