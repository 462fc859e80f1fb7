// SPDX-License-Identifier: BSD-3-Clause
#include "SceneShading.h"

#include "PacketThickness.h"
#include "SceneTile.h"
#include "StepThickness.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relief
{

namespace
{
f32::ReliefFalloff ToSingle(const f64::ReliefFalloff& falloff)
{
  return { static_cast<float>(falloff.lo), static_cast<float>(falloff.hi),
    static_cast<float>(falloff.power) };
}

// Adds a colour times a number to all samples of a tile, also those without data, where any number
// may stand.
void AddTo(glm::dvec3* sums, const float* factors, const glm::vec3& color)
{
  const glm::dvec3 wide(color);
  for (int at = 0; at < SceneTile::Size; ++at)
  {
    sums[at] += static_cast<double>(factors[at]) * wide;
  }
}

// 8-bit codes of linear values, the same as rounding reliefEncode(): every code's range begins
// where the curve passes half a code below it, and a table says from which code to look.
class CodeTable
{
public:
  CodeTable()
  {
    this->Begin[0] = 0.0f;
    for (int code = 1; code < 256; ++code)
    {
      this->Begin[code] = static_cast<float>(f64::reliefDecode((code - 0.5) / 255.0));
    }
    this->Begin[256] = std::numeric_limits<float>::infinity();
    int code = 0;
    for (int k = 0; k <= Steps; ++k)
    {
      const float linear = static_cast<float>(k) / Steps;
      while (linear >= this->Begin[code + 1])
      {
        ++code;
      }
      this->First[k] = static_cast<unsigned char>(code);
    }
  }

  unsigned char operator()(float linear) const
  {
    const float c = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f; // NaN too
    int code = this->First[static_cast<int>(c * Steps)];
    while (c >= this->Begin[code + 1])
    {
      ++code;
    }
    return static_cast<unsigned char>(code);
  }

private:
  static constexpr int Steps = 4096;
  float Begin[257];
  unsigned char First[Steps + 1];
};
}

SceneShading::SceneShading(
  const HeightField& field, const Scene& scene, const Target& target, IlluminationCache* cache)
  : Heights(field.GetField())
  , FieldVersion(field.GetVersion())
  , Cache(cache)
  , Parameters(scene)
  , Out(target)
  , Medium(relief::ToSingle(scene.medium))
  , SpecularFalloff(ToSingle(scene.specularFalloff))
  , ScatterFalloff(ToSingle(scene.scatterFalloff))
  , Rays(new std::atomic<std::uint64_t>[scene.lights.size()] {})
{
  const EffectPlan effects = PlanEffects(field, scene);
  bool first = true;
  bool anyTrace = false;
  std::size_t cached = 0;
  std::size_t sweeps = 0; // bytes
  for (const LightPlan& light : effects.lights)
  {
    Plan plan;
    static_cast<LightPlan&>(plan) = light;
    plan.share = static_cast<float>(light.light.intensity * light.light.weight);
    plan.thickness = target.thickness && first;
    plan.medium = scene.medium;
    plan.medium.tolerance =
      plan.thickness ? 0.0 : scene.medium.tolerance * light.light.toleranceScale;
    plan.single = relief::ToSingle(plan.medium);
    plan.trace = light.trace || plan.thickness || (light.lit && target.illumination && !light.dark);
    plan.scatterFactor = f32::reliefForwardScatter(this->ScatterFalloff, plan.vector);
    this->ShareSum += light.lit ? plan.share : 0.0f;
    anyTrace = anyTrace || plan.trace;
    if (plan.trace && cache && this->NeedsEveryD(plan))
    {
      this->UseCache(plan, cached);
    }
    if (plan.trace && !plan.kept && scene.integrator == Integrator::Exact &&
      field.GetMissingRow() && SweepThickness::Applies(scene.medium, plan.light))
    {
      // A sun's list of crossings is as long as the image. What no more room is for is traced by
      // packets, which need no list.
      plan.sweep = sweeps < MostSweepMemory
        ? std::make_unique<SweepThickness>(field, plan.medium, plan.light)
        : nullptr;
      sweeps += plan.sweep ? plan.sweep->GetMemorySize() : 0;
    }
    first = false;
    this->Plans.push_back(std::move(plan));
  }

  this->HasScatter = effects.scatter;
  this->HasNormals = effects.specular || target.normals ||
    (anyTrace && scene.medium.offset == f64::RELIEF_SURFACE_NORMAL);
  const bool textured = !scene.diffuseTextures.empty() && (effects.diffuse || effects.scatter);
  const bool baseTextured = !scene.baseTextures.empty() && scene.specularCoefficient < 1.0;
  this->Effects = (anyTrace ? IlluminationEffect : 0) | (this->HasNormals ? NormalsEffect : 0) |
    (effects.specular ? SpecularEffect : 0) | (effects.scatter ? ScatterEffect : 0) |
    (baseTextured ? BaseTextureEffect : 0) | (textured ? DiffuseTextureEffect : 0) |
    (effects.specular && !scene.specularTextures.empty() ? SpecularTextureEffect : 0);
}

// Whether d shows at every sample. Where all the light is scattered forward and none comes this
// way, it does not.
bool SceneShading::NeedsEveryD(const Plan& plan) const
{
  return plan.thickness || this->Out.illumination || this->Parameters.scatterCoefficient < 1.0;
}

// Finds a light's illumination in the cache, or makes room to keep it there beside what is kept of
// the lights before it.
void SceneShading::UseCache(Plan& plan, std::size_t& cached)
{
  IlluminationCache::Key key;
  key.field = this->FieldVersion;
  key.i0 = this->Out.i0;
  key.j0 = this->Out.j0;
  key.columns = this->Out.width;
  key.rows = this->Out.rows;
  key.vector = plan.light.vector;
  key.positional = plan.light.positional;
  key.medium = plan.medium;
  if (this->Parameters.integrator == Integrator::FixedStep)
  {
    key.steps = this->Parameters.steps;
    key.medium.tolerance = 0.0; // which it does not know
  }
  key.thickness = plan.thickness;
  plan.kept = this->Cache->Find(key);
  const std::size_t size = IlluminationCache::SizeOf(key);
  if (!plan.kept && cached + size <= this->Cache->GetLimit())
  {
    const std::size_t samples = static_cast<std::size_t>(key.columns) * key.rows;
    plan.fresh = std::make_shared<IlluminationCache::Entry>();
    plan.fresh->key = key;
    plan.fresh->illumination.resize(samples);
    plan.fresh->thickness.resize(key.thickness ? samples : 0);
  }
  cached += plan.kept || plan.fresh ? size : 0;
}

void SceneShading::KeepIlluminations()
{
  std::vector<std::shared_ptr<const IlluminationCache::Entry>> used;
  for (const Plan& plan : this->Plans)
  {
    if (plan.kept || plan.fresh)
    {
      used.push_back(plan.kept ? plan.kept : plan.fresh);
    }
  }
  if (this->Cache)
  {
    this->Cache->Keep(std::move(used));
  }
}

void SceneShading::Shade(int i0, int i1, int j0, int j1)
{
  constexpr int width = SweepThickness::TileWidth;
  constexpr int height = SweepThickness::TileHeight;
  const HeightView<float>& heights = this->Heights.heights;
  auto tile = std::make_unique<SceneTile>();
  for (tile->row = j0 / height; tile->row * height < j1; ++tile->row)
  {
    tile->j0 = tile->row * height;
    tile->j1 = std::min(tile->j0 + height, heights.rows);
    tile->askedJ0 = std::max(j0, tile->j0);
    tile->askedJ1 = std::min(j1, tile->j1);
    for (tile->column = i0 / width; tile->column * width < i1; ++tile->column)
    {
      tile->i0 = tile->column * width;
      tile->i1 = std::min(tile->i0 + width, heights.columns);
      tile->askedI0 = std::max(i0, tile->i0);
      tile->askedI1 = std::min(i1, tile->i1);
      this->ShadeTile(*tile);
    }
  }
}

void SceneShading::ShadeTile(SceneTile& tile)
{
  tile.anyData = false;
  tile.ForEach(
    [&](int i, int j, int at)
    {
      const bool hasData = !std::isnan(this->Heights.heights.At(i, j));
      tile.hasData[at] = hasData;
      tile.anyData |= hasData;
    });
  const bool hasScatter = this->HasScatter;
  const bool hasSpecular = (this->Effects & SpecularEffect) != 0;
  std::fill_n(tile.diffuse, SceneTile::Size, glm::dvec3(0.0));
  std::fill_n(tile.scatter, hasScatter ? SceneTile::Size : 0, glm::dvec3(0.0));
  std::fill_n(tile.specular, hasSpecular ? SceneTile::Size : 0, glm::dvec3(0.0));
  std::fill_n(tile.illumination, this->Out.illumination ? SceneTile::Size : 0, 0.0);
  std::fill_n(tile.thickness, this->Out.thickness ? SceneTile::Size : 0, 0.0f);
  if (this->HasNormals)
  {
    tile.ForEach(
      [&](int i, int j, int at)
      {
        tile.normals[at] =
          tile.hasData[at] ? f32::reliefNormal(this->Heights, i, j) : glm::vec3(0.0f);
      });
  }
  for (std::size_t index = 0; tile.anyData && index < this->Plans.size(); ++index)
  {
    const Plan& plan = this->Plans[index];
    if (plan.shows || plan.trace)
    {
      this->AddLight(plan, index, tile);
    }
  }
  if (tile.anyData)
  {
    this->ApplyTextures(tile);
  }
  this->Write(tile);
}

// Fills d and r of the wanted samples.
void SceneShading::Illuminate(const Plan& plan, std::size_t index, SceneTile& tile)
{
  auto place = [&](int i, int j)
  { return static_cast<std::size_t>(j - this->Out.j0) * this->Out.width + (i - this->Out.i0); };
  if (plan.kept)
  {
    tile.ForEachAsked(
      [&](int i, int j, int at)
      {
        tile.d[at] = plan.kept->illumination[place(i, j)];
        tile.r[at] = plan.thickness ? plan.kept->thickness[place(i, j)] : tile.r[at];
      });
    return;
  }
  RayCount work;
  if (plan.sweep)
  {
    plan.sweep->IlluminateTile(
      tile.column, tile.row, tile.d, plan.thickness ? tile.r : nullptr, work);
  }
  else
  {
    for (int j = tile.j0; j < tile.j1; ++j)
    {
      const int at = tile.At(tile.i0, j);
      RowRequest<float> request;
      request.j = j;
      request.begin = tile.i0;
      request.end = tile.i1;
      request.normals =
        this->Medium.offset == f32::RELIEF_SURFACE_NORMAL ? tile.normals + at : nullptr;
      request.wanted = tile.wanted + at;
      request.illumination = tile.d + at;
      request.thickness = plan.thickness ? tile.r + at : nullptr;
      if (this->Parameters.integrator == Integrator::FixedStep)
      {
        StepRow(this->Heights, this->Medium, plan.light, this->Parameters.steps, request, work);
      }
      else
      {
        TracePackets(this->Heights, plan.single, plan.light, request, work);
      }
    }
  }
  this->Rays[index] += work.rays;
  this->Cells += work.cells;
  if (plan.fresh)
  {
    tile.ForEachAsked(
      [&](int i, int j, int at)
      {
        plan.fresh->illumination[place(i, j)] = tile.d[at];
        if (plan.thickness)
        {
          plan.fresh->thickness[place(i, j)] = tile.r[at];
        }
      });
  }
}

void SceneShading::AddLight(const Plan& plan, std::size_t index, SceneTile& tile)
{
  const float ks = static_cast<float>(this->Parameters.specularCoefficient);
  const float kf = static_cast<float>(this->Parameters.scatterCoefficient);
  // A textured colour is the same for all lights: their sum is multiplied by it.
  const glm::vec3 white(1.0f);
  const glm::vec3 diffuse =
    this->Effects & DiffuseTextureEffect ? white : glm::vec3(this->Parameters.diffuse);
  const glm::vec3 specular =
    this->Effects & SpecularTextureEffect ? white : glm::vec3(this->Parameters.specular);
  const bool hasSpecular = (this->Effects & SpecularEffect) && plan.shows;
  const bool hasScatter = this->HasScatter && plan.shows;
  const HeightView<float>& heights = this->Heights.heights;

  if (!plan.directional && (hasSpecular || hasScatter))
  {
    tile.ForEach(
      [&](int i, int j, int at)
      {
        if (tile.hasData[at])
        {
          f32::reliefRay(this->Heights, this->Medium, i, j, tile.normals[at],
            LightFrom<float>(plan.light, heights, i, j), true, tile.toLight[at]);
          tile.scatterFactor[at] =
            hasScatter ? f32::reliefForwardScatter(this->ScatterFalloff, tile.toLight[at]) : 0.0f;
        }
      });
  }

  const bool everyD = this->NeedsEveryD(plan) || !hasScatter;
  bool anyWanted = false;
  tile.ForEach(
    [&](int, int, int at)
    {
      const float factor = plan.directional ? plan.scatterFactor : tile.scatterFactor[at];
      tile.wanted[at] = tile.hasData[at] && (everyD || factor > 0.0f);
      anyWanted |= tile.wanted[at] != 0;
    });
  if (!plan.trace || !anyWanted || !plan.sweep)
  {
    std::fill_n(tile.d, SceneTile::Size, 0.0f);
    std::fill_n(tile.r, SceneTile::Size, std::numeric_limits<float>::infinity());
  }
  if (plan.trace && anyWanted)
  {
    this->Illuminate(plan, index, tile);
  }

  if (plan.thickness)
  {
    std::copy_n(tile.r, SceneTile::Size, tile.thickness);
  }
  if (this->Out.illumination)
  {
    tile.ForEach(
      [&](int, int, int at) { tile.illumination[at] += double(plan.share) * tile.d[at]; });
  }
  if (!plan.shows)
  {
    return;
  }
  const glm::vec3 full = f32::reliefDiffuseTerm(ks, kf, 1.0f, plan.radiance, diffuse);
  AddTo(tile.diffuse, tile.d, full);
  if (hasScatter && plan.directional)
  {
    AddTo(tile.scatter, tile.d,
      f32::reliefScatterTerm(ks, kf, plan.scatterFactor, 1.0f, plan.radiance, diffuse));
  }
  else if (hasScatter)
  {
    tile.ForEach(
      [&](int, int, int at)
      {
        tile.scatter[at] += glm::dvec3(f32::reliefScatterTerm(
          ks, kf, tile.scatterFactor[at], tile.d[at], plan.radiance, diffuse));
      });
  }
  if (hasSpecular)
  {
    tile.ForEach(
      [&](int, int, int at)
      {
        const glm::vec3& l = plan.directional ? plan.vector : tile.toLight[at];
        const float mirror = f32::reliefMirror(tile.normals[at], l);
        if (!f32::reliefFalloffIsZero(this->SpecularFalloff, mirror))
        {
          const float s = f32::reliefFalloff(this->SpecularFalloff, mirror);
          tile.specular[at] += glm::dvec3(f32::reliefSpecularTerm(ks, s, plan.radiance, specular));
        }
      });
  }
}

// Finds the textured colours and multiplies what the lights gave by them.
void SceneShading::ApplyTextures(SceneTile& tile)
{
  auto cover =
    [&](const glm::dvec3& constant, const std::vector<ColorTexture>& textures, glm::vec3* colors)
  {
    std::fill_n(colors, SceneTile::Size, glm::vec3(constant));
    for (const ColorTexture& texture : textures)
    {
      for (int j = tile.askedJ0; j < tile.askedJ1; ++j)
      {
        texture.Cover(tile.askedI0, tile.askedI1, j, colors + tile.At(tile.askedI0, j));
      }
    }
  };
  auto multiply = [&](glm::dvec3* sums)
  { tile.ForEachAsked([&](int, int, int at) { sums[at] *= glm::dvec3(tile.color[at]); }); };

  if (this->Effects & BaseTextureEffect)
  {
    const float ks = static_cast<float>(this->Parameters.specularCoefficient);
    cover(this->Parameters.base, this->Parameters.baseTextures, tile.base);
    tile.ForEachAsked(
      [&](int, int, int at) { tile.base[at] = f32::reliefBaseTerm(ks, tile.base[at]); });
  }
  if (this->Effects & DiffuseTextureEffect)
  {
    cover(this->Parameters.diffuse, this->Parameters.diffuseTextures, tile.color);
    multiply(tile.diffuse);
    if (this->HasScatter)
    {
      multiply(tile.scatter);
    }
  }
  if (this->Effects & SpecularTextureEffect)
  {
    cover(this->Parameters.specular, this->Parameters.specularTextures, tile.color);
    multiply(tile.specular);
  }
}

void SceneShading::Write(const SceneTile& tile)
{
  static const CodeTable codes;
  const Target& out = this->Out;
  const float none = std::numeric_limits<float>::quiet_NaN();
  const glm::vec3 missing(none);
  const glm::vec3 base = f32::reliefBaseTerm(
    static_cast<float>(this->Parameters.specularCoefficient), glm::vec3(this->Parameters.base));
  const glm::vec3* bases = this->Effects & BaseTextureEffect ? tile.base : nullptr;
  const bool hasScatter = this->HasScatter;
  const bool hasSpecular = (this->Effects & SpecularEffect) != 0;
  auto place = [&](int i, int j)
  { return static_cast<std::size_t>(j - out.j0) * out.width + (i - out.i0); };

  tile.ForEachAsked(
    [&](int i, int j, int at)
    {
      // Of the layers as they are written, so that those add up to it.
      glm::vec3 color = (bases ? bases[at] : base) + glm::vec3(tile.diffuse[at]);
      if (hasScatter)
      {
        color += glm::vec3(tile.scatter[at]);
      }
      if (hasSpecular)
      {
        color += glm::vec3(tile.specular[at]);
      }
      const bool hasData = tile.hasData[at] != 0;
      if (out.rgba)
      {
        float* rgba = out.rgba + 4 * place(i, j);
        rgba[0] = hasData ? color.x : 0.0f;
        rgba[1] = hasData ? color.y : 0.0f;
        rgba[2] = hasData ? color.z : 0.0f;
        rgba[3] = hasData ? 1.0f : 0.0f;
      }
      if (out.rgba8)
      {
        unsigned char* rgba = out.rgba8 + 4 * place(i, j);
        rgba[0] = hasData ? codes(color.x) : 0;
        rgba[1] = hasData ? codes(color.y) : 0;
        rgba[2] = hasData ? codes(color.z) : 0;
        rgba[3] = hasData ? 255 : 0;
      }
    });

  const double scale = this->ShareSum != 0.0 ? 1.0 / this->ShareSum : 0.0;
  auto writeNumbers = [&](float* layer, const auto* values, auto factor)
  {
    if (layer)
    {
      tile.ForEachAsked(
        [&](int i, int j, int at) {
          layer[place(i, j)] = tile.hasData[at] ? static_cast<float>(values[at] * factor) : none;
        });
    }
  };
  auto writeVectors = [&](float* layer, const auto* values, const glm::vec3& otherwise)
  {
    if (layer)
    {
      tile.ForEachAsked(
        [&](int i, int j, int at)
        {
          const glm::vec3 value = !tile.hasData[at] ? missing
            : values                                ? glm::vec3(values[at])
                                                    : otherwise;
          std::copy_n(&value.x, 3, layer + 3 * place(i, j));
        });
    }
  };
  writeNumbers(out.illumination, tile.illumination, scale);
  writeNumbers(out.thickness, tile.thickness, 1.0f);
  writeVectors(out.normals, tile.normals, missing);
  writeVectors(out.base, bases, base);
  writeVectors(out.diffuse, tile.diffuse, missing);
  const glm::dvec3* none3 = nullptr;
  writeVectors(out.scatter, hasScatter ? tile.scatter : none3, glm::vec3(0.0f));
  writeVectors(out.specular, hasSpecular ? tile.specular : none3, glm::vec3(0.0f));
}

int SceneShading::GetLightsReused() const
{
  return static_cast<int>(std::count_if(
    this->Plans.begin(), this->Plans.end(), [](const Plan& plan) { return plan.kept != nullptr; }));
}

int SceneShading::GetLightsTraced() const
{
  int traced = 0;
  for (std::size_t index = 0; index < this->Plans.size(); ++index)
  {
    traced += this->Rays[index] > 0 ? 1 : 0;
  }
  return traced;
}

std::uint64_t SceneShading::GetRaysTraced() const
{
  std::uint64_t rays = 0;
  for (std::size_t index = 0; index < this->Plans.size(); ++index)
  {
    rays += this->Rays[index];
  }
  return rays;
}

}
