// SPDX-License-Identifier: BSD-3-Clause
// A scene of whatever a host may hand to the model: any heights; spacings, lights and parameters
// within the bounds of SceneConversion. Samples with data get numbers, in range where the model
// says so; samples without data stay without; and the second run, from what the first has kept,
// gives the same.
#include "FuzzInput.h"

#include "SceneShading.h"

#include <algorithm>
#include <iostream>
#include <vector>

namespace
{
using relief::HeightField;
using relief::Scene;

void inOneGo(int count, const std::function<void(int, int)>& body)
{
  body(0, count);
}

// Prepares heights of one type.
template <class T>
bool Prepare(FuzzInput& input, HeightField& field, std::vector<T>& values)
{
  relief::HeightSource<T> source;
  source.columns = input.Integer(1, 40);
  source.rows = input.Integer(1, 20);
  source.stepY = source.columns;
  source.spacingX = std::clamp(input.Positive(), 1e-15, 1e15);
  source.spacingY = input.Flag() ? source.spacingX : std::clamp(input.Positive(), 1e-15, 1e15);
  source.scale = input.Flag() ? 1.0 : input.Finite();
  source.hasNoData = input.Flag();
  source.noData = source.hasNoData ? input.Finite() : 0.0;
  if (input.Flag())
  {
    const int period = input.Integer(2, 9);
    const int remainder = input.Integer(0, period - 1);
    source.hasData = [=](int i, int j) { return (3 * i + 5 * j) % period != remainder; };
  }
  const bool padded = input.Flag();
  // A few numbers make a pattern: bytes are few.
  double palette[16];
  const double lift = input.Finite();
  for (double& height : palette)
  {
    height = lift + input.Number();
  }
  const int mixI = input.Integer(1, 255);
  const int mixJ = input.Integer(1, 255);
  values.resize(static_cast<std::size_t>(source.columns) * source.rows);
  for (int j = 0; j < source.rows; ++j)
  {
    for (int i = 0; i < source.columns; ++i)
    {
      const double height = palette[(i * mixI + j * mixJ + i * j) / 7 % 16];
      if constexpr (std::is_integral_v<T>)
      {
        const double least = std::numeric_limits<T>::lowest();
        const double most = std::nextafter(std::numeric_limits<T>::max(), 0.0);
        values[j * source.columns + i] =
          static_cast<T>(std::isnan(height) ? 0.0 : std::clamp(height, least, most));
      }
      else if (std::is_same_v<T, float> && std::abs(height) > std::numeric_limits<float>::max())
      {
        values[j * source.columns + i] =
          static_cast<T>(std::copysign(std::numeric_limits<float>::infinity(), height));
      }
      else
      {
        values[j * source.columns + i] = static_cast<T>(height);
      }
    }
  }
  source.data = values.data();
  return field.Assign(source, inOneGo, padded).empty();
}

glm::dvec3 Color(FuzzInput& input)
{
  const double r = std::abs(input.Bounded(1e6));
  const double g = std::abs(input.Bounded(1e6));
  return { r, g, std::abs(input.Bounded(1e6)) };
}

relief::f64::ReliefFalloff Falloff(FuzzInput& input)
{
  const double a = input.Bounded(1e30);
  const double b = input.Bounded(1e30);
  return { std::min(a, b), std::max(a, b), std::abs(input.Bounded(1e30)) };
}

std::vector<relief::ColorTexture> Textures(FuzzInput& input, const std::vector<double>& texels)
{
  std::vector<relief::ColorTexture> textures(input.Integer(0, 7) < 6 ? 0 : input.Integer(1, 2));
  for (relief::ColorTexture& texture : textures)
  {
    texture.texels = texels.data();
    texture.type = static_cast<relief::ColorTexture::Type>(input.Integer(0, 3));
    texture.components = input.Integer(1, 4);
    texture.columns = input.Integer(1, 3);
    texture.rows = input.Integer(1, 4);
    texture.origin = { input.Finite(), input.Finite() };
    texture.alongI = { input.Finite(), input.Finite() };
    texture.alongJ = { input.Finite(), input.Finite() };
  }
  return textures;
}

relief::Light MakeLight(FuzzInput& input)
{
  relief::Light light;
  light.positional = input.Flag();
  const double x = input.Bounded(5e14);
  const double y = input.Bounded(5e14);
  light.vector = { x, y, input.Bounded(5e14) };
  const double length = std::sqrt(light.vector.x * light.vector.x +
    light.vector.y * light.vector.y + light.vector.z * light.vector.z);
  if (!light.positional)
  {
    light.vector =
      std::isfinite(length) && length > 0.0 ? light.vector / length : glm::dvec3(0.0, 0.0, 1.0);
  }
  light.color = Color(input);
  light.intensity = input.Flag() ? 1.0 : input.Bounded(1e24);
  return light;
}

Scene MakeScene(FuzzInput& input, const std::vector<double>& texels)
{
  Scene scene;
  scene.base = Color(input);
  scene.diffuse = Color(input);
  scene.specular = Color(input);
  scene.specularCoefficient = input.Share();
  scene.scatterCoefficient = input.Share();
  scene.specularFalloff = Falloff(input);
  scene.scatterFalloff = Falloff(input);
  scene.medium.depth = std::abs(input.Bounded(1e15));
  scene.medium.offset = AnyOffset(input);
  scene.medium.attenuation = input.Flag();
  scene.medium.density = std::abs(input.Bounded(1e30));
  scene.medium.useFloor = input.Flag();
  scene.medium.floorHeight = input.Bounded(1e30);
  scene.medium.tolerance = input.Share();
  scene.integrator = input.Flag() ? relief::Integrator::FixedStep : relief::Integrator::Exact;
  scene.steps = input.Integer(1, 40);
  scene.baseTextures = Textures(input, texels);
  scene.diffuseTextures = Textures(input, texels);
  scene.specularTextures = Textures(input, texels);
  const int lights = input.Integer(0, 3);
  for (int k = 0; k < lights; ++k)
  {
    scene.lights.push_back(MakeLight(input));
  }
  return scene;
}

std::ostream& operator<<(std::ostream& out, const glm::dvec3& v)
{
  return out << '(' << v.x << ' ' << v.y << ' ' << v.z << ')';
}

// What the bytes stand for, with RELIEF_FUZZ_VERBOSE in the environment.
void Print(const HeightField& field, const Scene& scene)
{
  const relief::HeightView<float>& h = field.GetField().heights;
  const relief::f64::ReliefMedium& m = scene.medium;
  std::cout << h.columns << " x " << h.rows << ", spacing " << h.spacingX << ' ' << h.spacingY
            << ", heights " << field.GetBottom() << " to " << field.GetTop() << " above "
            << field.GetDatum() << (field.GetMissingRow() ? ", padded" : "") << "\nbase "
            << scene.base << ", diffuse " << scene.diffuse << ", specular " << scene.specular
            << ", textures " << scene.baseTextures.size() << scene.diffuseTextures.size()
            << scene.specularTextures.size() << ", ks " << scene.specularCoefficient << ", kf "
            << scene.scatterCoefficient << ", falloffs " << scene.specularFalloff.lo << ' '
            << scene.specularFalloff.hi << ' ' << scene.specularFalloff.power << ", "
            << scene.scatterFalloff.lo << ' ' << scene.scatterFalloff.hi << ' '
            << scene.scatterFalloff.power << "\nt " << m.depth << ", offset " << m.offset
            << ", attenuation " << m.attenuation << ' ' << m.density << ", floor " << m.useFloor
            << ' ' << m.floorHeight << ", tolerance " << m.tolerance << ", integrator "
            << static_cast<int>(scene.integrator) << ' ' << scene.steps << std::endl;
  for (const relief::Light& light : scene.lights)
  {
    std::cout << (light.positional ? "light at " : "light toward ") << light.vector << ", colour "
              << light.color << " x " << light.intensity << std::endl;
  }
}

// All that a run writes.
struct Result
{
  std::vector<float> rgba;
  std::vector<unsigned char> rgba8;
  std::vector<float> illumination;
  std::vector<float> thickness;
  std::vector<float> vectors[5];
};

Result Shade(FuzzInput choice, const HeightField& field, const Scene& scene,
  relief::IlluminationCache& cache, relief::Target& target)
{
  const relief::HeightView<float>& heights = field.GetField().heights;
  target = relief::Target();
  target.i0 = choice.Integer(0, heights.columns - 1);
  target.j0 = choice.Integer(0, heights.rows - 1);
  target.width = heights.columns - target.i0;
  target.rows = heights.rows - target.j0;
  const std::size_t samples = static_cast<std::size_t>(target.width) * target.rows;
  Result result;
  auto layer = [&](std::vector<float>& values, int components)
  {
    // Not a number that a run would leave.
    values.assign(choice.Flag() ? samples * components : 0, -12345.0f);
    return values.empty() ? nullptr : values.data();
  };
  target.rgba = layer(result.rgba, 4);
  if (choice.Flag())
  {
    result.rgba8.resize(samples * 4);
    target.rgba8 = result.rgba8.data();
  }
  target.illumination = layer(result.illumination, 1);
  target.thickness = layer(result.thickness, 1);
  target.normals = layer(result.vectors[0], 3);
  target.base = layer(result.vectors[1], 3);
  target.diffuse = layer(result.vectors[2], 3);
  target.scatter = layer(result.vectors[3], 3);
  target.specular = layer(result.vectors[4], 3);
  relief::SceneShading shading(field, scene, target, &cache);
  shading.Shade(target.i0, heights.columns, target.j0, heights.rows);
  shading.KeepIlluminations();
  return result;
}

bool Same(const std::vector<float>& a, const std::vector<float>& b)
{
  return a.size() == b.size() &&
    (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0);
}

void Check(const Result& result, const relief::Target& target, const HeightField& field)
{
  for (int j = 0; j < target.rows; ++j)
  {
    for (int i = 0; i < target.width; ++i)
    {
      const std::size_t at = static_cast<std::size_t>(j) * target.width + i;
      const bool hasData = !std::isnan(field.GetField().heights.At(target.i0 + i, target.j0 + j));
      for (int c = 0; !result.rgba.empty() && c < 4; ++c)
      {
        const float value = result.rgba[4 * at + c];
        FUZZ_CHECK(hasData ? !std::isnan(value) : value == 0.0f);
        FUZZ_CHECK(c < 3 || value == (hasData ? 1.0f : 0.0f));
      }
      FUZZ_CHECK(result.rgba8.empty() || result.rgba8[4 * at + 3] == (hasData ? 255 : 0));
      for (const std::vector<float>& vectors : result.vectors)
      {
        for (int c = 0; !vectors.empty() && c < 3; ++c)
        {
          FUZZ_CHECK(std::isnan(vectors[3 * at + c]) == !hasData);
        }
      }
      if (!result.illumination.empty())
      {
        FUZZ_CHECK(std::isnan(result.illumination[at]) == !hasData);
      }
      if (!result.thickness.empty())
      {
        FUZZ_CHECK(hasData ? result.thickness[at] >= 0.0f : std::isnan(result.thickness[at]));
      }
      if (hasData && !result.vectors[0].empty())
      {
        const float* n = &result.vectors[0][3 * at];
        FUZZ_CHECK(std::abs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1.0f) < 1e-3f);
      }
    }
  }
}
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  FuzzInput input(data, size);
  FuzzInput choice(data, size);
  for (int k = 0; k < 16; ++k)
  {
    input.Take<std::uint8_t>();
  }
  HeightField field;
  std::vector<float> floats;
  std::vector<double> doubles;
  std::vector<short> shorts;
  std::vector<unsigned char> bytes;
  std::vector<long long> longs;
  bool prepared = false;
  switch (input.Integer(0, 7))
  {
    case 0:
      prepared = Prepare(input, field, shorts);
      break;
    case 1:
      prepared = Prepare(input, field, bytes);
      break;
    case 2:
      prepared = Prepare(input, field, longs);
      break;
    case 3:
      prepared = Prepare(input, field, doubles);
      break;
    default:
      prepared = Prepare(input, field, floats);
  }
  if (!prepared)
  {
    return 0; // refused with a message
  }
  std::vector<double> texels(3 * 4 * 4);
  for (double& texel : texels)
  {
    texel = input.Number();
  }
  const Scene scene = MakeScene(input, texels);
  if (std::getenv("RELIEF_FUZZ_VERBOSE"))
  {
    Print(field, scene);
  }
  relief::IlluminationCache cache;
  cache.SetLimit(std::size_t(1) << 20);
  relief::Target target;
  const Result first = Shade(choice, field, scene, cache, target);
  Check(first, target, field);
  const Result second = Shade(choice, field, scene, cache, target);
  FUZZ_CHECK(Same(first.rgba, second.rgba) && first.rgba8 == second.rgba8);
  FUZZ_CHECK(Same(first.illumination, second.illumination));
  FUZZ_CHECK(Same(first.thickness, second.thickness));
  for (int k = 0; k < 5; ++k)
  {
    FUZZ_CHECK(Same(first.vectors[k], second.vectors[k]));
  }
  return 0;
}
