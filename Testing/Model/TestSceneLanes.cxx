// SPDX-License-Identifier: BSD-3-Clause
//
// Composing in lanes against the model's own functions, sample by sample, on every instruction set
// that this machine has.
#include "CodeTable.h"
#include "ScenePicture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

using namespace relief;

namespace
{
constexpr int Columns = 53;
constexpr int Rows = 38;

class SceneLanes : public EveryTarget
{
};

glm::dvec3 RandomColor(Random& random, bool grey)
{
  const double first = random.Uniform(0.0, 1.5);
  return grey ? glm::dvec3(first)
              : glm::dvec3(first, random.Uniform(0.0, 1.5), random.Chance(0.2) ? 0.0 : first);
}

f64::ReliefFalloff RandomFalloff(Random& random)
{
  const double powers[] = { 0.0, 0.5, 1.0, 1.0, 3.0, 20.0 };
  const double lo = random.Uniform(-1.0, 0.8);
  const double hi = random.Chance(0.2) ? lo : lo + random.Uniform(0.05, 1.0);
  return { lo, hi, powers[random.Integer(0, 5)] };
}

double Extreme(Random& random)
{
  const int kind = random.Integer(0, 3);
  return kind == 0 ? 0.0 : kind == 1 ? 1.0 : random.Uniform(0.0, 1.0);
}

Terrain RandomGround(Random& random)
{
  Terrain terrain(Columns, Rows, 1.0, 1.25);
  const double missing = random.Chance(0.5) ? 0.03 : 0.0;
  for (int k = 0; k < Columns * Rows; ++k)
  {
    terrain.heights[k] = random.Chance(missing)
      ? NoData
      : 3.0 * std::sin(0.3 * (k % Columns)) + random.Uniform(0.0, 1.0);
  }
  terrain.RoundToSingle();
  return terrain;
}

// Texels, one for each sample, that live as long as this.
struct Texels
{
  explicit Texels(Random& random)
  {
    for (int k = 0; k < 3 * Columns * Rows; ++k)
    {
      this->Values.push_back(static_cast<float>(random.Uniform(0.0, 1.5)));
    }
    this->Texture.texels = this->Values.data();
    this->Texture.type = ColorTexture::Type::Float;
    this->Texture.components = 3;
    this->Texture.columns = Columns;
    this->Texture.rows = Rows;
  }
  glm::vec3 At(std::size_t k) const
  {
    return { this->Values[3 * k], this->Values[3 * k + 1], this->Values[3 * k + 2] };
  }
  std::vector<float> Values;
  ColorTexture Texture;
};

Scene RandomLook(Random& random, const Texels& texels)
{
  const bool grey = random.Chance(0.4);
  Scene scene;
  scene.base = RandomColor(random, grey);
  scene.diffuse = RandomColor(random, grey);
  scene.specular = RandomColor(random, grey);
  scene.specularCoefficient = Extreme(random);
  scene.scatterCoefficient = Extreme(random);
  scene.specularFalloff = RandomFalloff(random);
  scene.scatterFalloff = RandomFalloff(random);
  scene.medium.depth = 0.8;
  scene.medium.offset = random.Integer(0, 2);
  scene.response = random.Integer(0, 2);
  scene.exposure = random.Uniform(-1.0, 1.0);
  for (std::vector<ColorTexture>* textures :
    { &scene.baseTextures, &scene.diffuseTextures, &scene.specularTextures })
  {
    if (!grey && random.Chance(0.3))
    {
      textures->push_back(texels.Texture);
    }
  }
  const int lights = random.Chance(0.4) ? 1 : random.Integer(0, 5);
  for (int k = 0; k < lights; ++k)
  {
    Light light = random.Chance(0.6)
      ? Sun(random.Uniform(0.0, 360.0), random.Uniform(-20.0, 90.0))
      : Lamp(random.Uniform(0.0, 60.0), random.Uniform(0.0, 50.0), random.Uniform(5.0, 20.0));
    light.color = RandomColor(random, grey);
    light.intensity = random.Uniform(0.1, 2.0);
    light.weight = random.Uniform(0.1, 1.0);
    scene.lights.push_back(light);
  }
  return scene;
}

// d of a light as the scene traces it, told by the layer of a white one alone.
std::vector<float> IlluminationOf(const HeightField& field, const Scene& look, Light light)
{
  Scene scene;
  scene.medium = look.medium;
  light.color = glm::dvec3(1.0);
  light.intensity = light.weight = light.open = 1.0;
  scene.lights = { light };
  return Shade(field, scene, AllLayers).illumination;
}

// What a monotonic function of an angle's cosine makes of it, if rounding has moved that a little.
struct Bracket
{
  double lo = 0.0;
  double hi = 0.0;
};

Bracket Around(const f32::ReliefFalloff& falloff, float x)
{
  constexpr float rounding = 4e-6f;
  return { f32::reliefFalloff(falloff, x - rounding), f32::reliefFalloff(falloff, x + rounding) };
}

// The terms of one sample, by the text's functions alone.
struct Terms
{
  glm::dvec3 diffuse{ 0.0 };
  glm::dvec3 scatterLo{ 0.0 };
  glm::dvec3 scatterHi{ 0.0 };
  glm::dvec3 specularLo{ 0.0 };
  glm::dvec3 specularHi{ 0.0 };
};

Terms TermsAt(const HeightField& prepared, const Scene& scene, const Texels& texels,
  const std::vector<std::vector<float>>& d, int i, int j)
{
  auto single = [](const f64::ReliefFalloff& falloff)
  {
    return f32::ReliefFalloff{ static_cast<float>(falloff.lo), static_cast<float>(falloff.hi),
      static_cast<float>(falloff.power) };
  };
  const Field<float>& field = prepared.GetField();
  const std::size_t k = static_cast<std::size_t>(j) * Columns + i;
  const auto ks = static_cast<float>(scene.specularCoefficient);
  const auto kf = static_cast<float>(scene.scatterCoefficient);
  const glm::vec3 diffuse = scene.diffuseTextures.empty() ? glm::vec3(scene.diffuse) : texels.At(k);
  const glm::vec3 specular =
    scene.specularTextures.empty() ? glm::vec3(scene.specular) : texels.At(k);
  const glm::vec3 n = f32::reliefNormal(field, i, j);
  Terms terms;
  for (std::size_t index = 0; index < scene.lights.size(); ++index)
  {
    const Light& light = scene.lights[index];
    const glm::vec3 radiance(light.color * (light.intensity * light.weight));
    glm::vec3 l;
    f32::reliefRay(field, ToSingle(scene.medium), i, j, n,
      LightFrom<float>(light, field.heights, i, j), light.positional, l);
    const float answer = f32::reliefResponse(scene.response, d[index][k], n, l);
    terms.diffuse += glm::dvec3(f32::reliefDiffuseTerm(ks, kf, answer, radiance, diffuse));
    const Bracket f = Around(single(scene.scatterFalloff), -l.z);
    terms.scatterLo += glm::dvec3(
      f32::reliefScatterTerm(ks, kf, static_cast<float>(f.lo), answer, radiance, diffuse));
    terms.scatterHi += glm::dvec3(
      f32::reliefScatterTerm(ks, kf, static_cast<float>(f.hi), answer, radiance, diffuse));
    const Bracket s = Around(single(scene.specularFalloff), f32::reliefMirror(n, l));
    terms.specularLo +=
      glm::dvec3(f32::reliefSpecularTerm(ks, static_cast<float>(s.lo), radiance, specular));
    terms.specularHi +=
      glm::dvec3(f32::reliefSpecularTerm(ks, static_cast<float>(s.hi), radiance, specular));
  }
  return terms;
}

void ExpectPicture(const HeightField& field, const Scene& scene, const Texels& texels,
  const std::vector<std::vector<float>>& d, const Picture& picture)
{
  const float exposure = static_cast<float>(f64::reliefExposureFactor(scene.exposure));
  constexpr double rounding = 4e-6;
  for (int k = 0; k < Columns * Rows; ++k)
  {
    const int i = k % Columns;
    const int j = k / Columns;
    const float* rgba = &picture.rgba[4 * static_cast<std::size_t>(k)];
    const unsigned char* codes = &picture.rgba8[4 * static_cast<std::size_t>(k)];
    const bool hasData = !std::isnan(field.GetField().heights.At(i, j));
    ASSERT_EQ(rgba[3], hasData ? 1.0f : 0.0f);
    ASSERT_EQ(codes[3], hasData ? 255 : 0);
    const Terms terms = hasData ? TermsAt(field, scene, texels, d, i, j) : Terms();
    const glm::vec3 base = f32::reliefBaseTerm(static_cast<float>(scene.specularCoefficient),
      scene.baseTextures.empty() ? glm::vec3(scene.base) : texels.At(k));
    for (int c = 0; c < 3; ++c)
    {
      const std::size_t at = 3 * static_cast<std::size_t>(k) + c;
      if (!hasData)
      {
        ASSERT_EQ(rgba[c], 0.0f);
        ASSERT_EQ(codes[c], 0);
        ASSERT_TRUE(std::isnan(picture.base[at]) && std::isnan(picture.diffuse[at]) &&
          std::isnan(picture.scatter[at]) && std::isnan(picture.specular[at]));
        continue;
      }
      ASSERT_EQ(picture.base[at], base[c]);
      ASSERT_NEAR(picture.diffuse[at], terms.diffuse[c], rounding);
      ASSERT_GE(picture.scatter[at], terms.scatterLo[c] - rounding);
      ASSERT_LE(picture.scatter[at], terms.scatterHi[c] + rounding);
      ASSERT_GE(picture.specular[at], terms.specularLo[c] - rounding);
      ASSERT_LE(picture.specular[at], terms.specularHi[c] + rounding);
      // The layers as they are add up to the colour, and the codes are the colour's.
      ASSERT_EQ(rgba[c],
        picture.base[at] + picture.diffuse[at] + picture.scatter[at] + picture.specular[at]);
      ASSERT_EQ(codes[c], CodeTable::Get()(exposure * rgba[c]));
    }
  }
}
}

TEST_P(SceneLanes, ComposeAsTheTextDoes)
{
  Random random(Seed());
  const Texels texels(random);
  for (int round = 0; round < 60; ++round)
  {
    SCOPED_TRACE(round);
    const Prepared prepared(RandomGround(random), random.Chance(0.7));
    const Scene scene = RandomLook(random, texels);
    std::vector<std::vector<float>> d;
    for (const Light& light : scene.lights)
    {
      d.push_back(IlluminationOf(prepared.Field, scene, light));
    }
    const Picture picture = Shade(prepared.Field, scene, AllLayers);
    ExpectPicture(prepared.Field, scene, texels, d, picture);
    if (HasFatalFailure())
    {
      return;
    }
    for (int k = 0; k < Columns * Rows; ++k)
    {
      const glm::vec3 n = f32::reliefNormal(prepared.Field.GetField(), k % Columns, k / Columns);
      for (int c = 0; c < 3 && !std::isnan(picture.rgba[4 * k]) && picture.rgba[4 * k + 3] > 0.0f;
           ++c)
      {
        ASSERT_NEAR(picture.normals[3 * k + c], n[c], 1e-6f);
      }
    }
  }
}

// One light is float's own product, and several are summed in double, bit for bit.
TEST_P(SceneLanes, SumsAreExact)
{
  Random random(Seed());
  const Prepared prepared(RandomGround(random));
  for (int lights : { 1, 2, 40 })
  {
    Scene scene;
    scene.diffuse = glm::dvec3(0.9, 0.7, 0.3);
    scene.scatterCoefficient = 0.25;
    scene.medium.depth = 0.8;
    std::vector<std::vector<double>> sums(3, std::vector<double>(Columns * Rows, 0.0));
    for (int k = 0; k < lights; ++k)
    {
      scene.lights.push_back(Sun(random.Uniform(0.0, 360.0), random.Uniform(5.0, 80.0)));
      scene.lights.back().weight = random.Chance(0.3) ? 1e-6 : 1.0 / lights;
      scene.lights.back().color = RandomColor(random, false);
      const std::vector<float> d = IlluminationOf(prepared.Field, scene, scene.lights.back());
      const glm::vec3 radiance(scene.lights.back().color * scene.lights.back().weight);
      const glm::vec3 full =
        f32::reliefDiffuseTerm(0.0f, 0.25f, 1.0f, radiance, glm::vec3(scene.diffuse));
      for (std::size_t at = 0; at < d.size(); ++at)
      {
        for (int c = 0; c < 3; ++c)
        {
          sums[c][at] += static_cast<double>(d[at]) * static_cast<double>(full[c]);
        }
      }
    }
    const Picture picture = Shade(prepared.Field, scene, AllLayers);
    for (int k = 0; k < Columns * Rows; ++k)
    {
      for (int c = 0; c < 3 && picture.rgba[4 * k + 3] > 0.0f; ++c)
      {
        ASSERT_EQ(picture.diffuse[3 * k + c], static_cast<float>(sums[c][k]))
          << lights << " lights, sample " << k;
      }
    }
  }
}

// A grey scene, of which one channel is computed, is the coloured one bit for bit.
TEST_P(SceneLanes, GreyIsAColour)
{
  Random random(Seed());
  const Prepared prepared(RandomGround(random));
  for (int lights : { 1, 3 })
  {
    Scene scene = Rich();
    scene.base = glm::dvec3(0.1);
    scene.diffuse = glm::dvec3(0.7);
    scene.specular = glm::dvec3(0.6);
    scene.lights.resize(lights);
    for (Light& light : scene.lights)
    {
      light.color = glm::dvec3(0.9);
    }
    const Picture grey = Shade(prepared.Field, scene, AllLayers);
    scene.base.z = 0.0;
    const Picture coloured = Shade(prepared.Field, scene, AllLayers);
    for (std::size_t at = 0; at < grey.diffuse.size(); ++at)
    {
      ASSERT_TRUE(std::isnan(grey.diffuse[at]) || grey.diffuse[at] == coloured.diffuse[at]);
      ASSERT_TRUE(std::isnan(grey.scatter[at]) || grey.scatter[at] == coloured.scatter[at]);
      ASSERT_TRUE(std::isnan(grey.specular[at]) || grey.specular[at] == coloured.specular[at]);
    }
    for (std::size_t at = 0; at < grey.rgba.size(); at += 4)
    {
      for (std::size_t c = 0; c < 3; ++c)
      {
        ASSERT_EQ(grey.rgba[at + c], grey.rgba[at]);
        ASSERT_EQ(grey.rgba8[at + c], grey.rgba8[at]);
      }
      ASSERT_EQ(grey.rgba[at], coloured.rgba[at]);
      ASSERT_EQ(grey.rgba8[at + 1], coloured.rgba8[at + 1]);
    }
  }
}

// The codes that lanes write of linear values.
namespace
{
std::vector<unsigned char> WrittenCodes(std::vector<float> values)
{
  constexpr int size = SceneTile::Size;
  const std::size_t count = values.size();
  values.resize((count + size - 1) / size * size, 0.0f);
  PictureParts parts;
  parts.channels = 1;
  parts.terms[SceneTile::Diffuse] = true;
  std::vector<unsigned char> rgba(4 * size);
  Target target;
  target.width = SceneTile::Width;
  target.rows = SceneTile::Width;
  target.rgba8 = rgba.data();
  const PictureWriter writer(target, parts);
  auto tile = std::make_unique<SceneTile>();
  tile->i1 = tile->askedI1 = tile->j1 = tile->askedJ1 = SceneTile::Width;
  tile->firstHeight = tile->ring;
  tile->pitch = SceneTile::RingPitch;
  std::vector<unsigned char> codes;
  for (std::size_t begin = 0; begin < values.size(); begin += size)
  {
    std::copy_n(values.data() + begin, size, tile->terms[SceneTile::Diffuse][0].values);
    writer.Write(*tile);
    PictureWriter::Flush();
    for (int at = 0; at < size; ++at)
    {
      EXPECT_EQ(rgba[4 * at], rgba[4 * at + 2]);
      codes.push_back(rgba[4 * at]);
    }
  }
  codes.resize(count);
  return codes;
}
}

TEST_P(SceneLanes, CodesAreExact)
{
  const float infinity = std::numeric_limits<float>::infinity();
  std::vector<float> values = { 0.0f, -0.0f, -1.0f, 1.0f, 7.0f, infinity, -infinity,
    std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::denorm_min(), 1e-30f };
  auto addAround = [&](float value)
  {
    values.insert(
      values.end(), { std::nextafter(value, -1.0f), value, std::nextafter(value, 2.0f) });
  };
  for (int code = 1; code < 256; ++code)
  {
    addAround(CodeTable::Get().GetBegin(code));
  }
  for (int step = 0; step <= CodeTable::Steps; ++step)
  {
    addAround(static_cast<float>(step) / CodeTable::Steps);
  }
  Random random(Seed());
  for (int k = 0; k < 200000; ++k)
  {
    values.push_back(static_cast<float>(
      random.Chance(0.5) ? random.Uniform(0.0, 1.0) : random.Logarithmic(1e-6, 1.0)));
  }
  const std::vector<unsigned char> codes = WrittenCodes(values);
  for (std::size_t k = 0; k < values.size(); ++k)
  {
    ASSERT_EQ(codes[k], CodeTable::Get()(values[k])) << values[k];
  }
}

INSTANTIATE_FOR_EVERY_TARGET(SceneLanes);

// The table itself: what rounding the curve gives, but for values beside which a code begins.
TEST(CodeTable, RoundsTheCurve)
{
  const CodeTable& table = CodeTable::Get();
  for (int k = 0; k <= 1000000; ++k)
  {
    const float linear = static_cast<float>(k) / 1000000;
    const double exact = 255.0 * f64::reliefEncode(static_cast<double>(linear));
    ASSERT_NEAR(table(linear), exact, 0.5 + 1e-4) << linear;
  }
}
