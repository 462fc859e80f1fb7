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

bool IsGrey(const glm::vec3& color)
{
  return color.x == color.y && color.y == color.z;
}
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
    plan.terms.share = light.share;
    plan.thickness = target.thickness && first;
    plan.medium = scene.medium;
    plan.medium.tolerance =
      plan.thickness ? 0.0 : scene.medium.tolerance * light.light.toleranceScale;
    plan.single = relief::ToSingle(plan.medium);
    plan.trace = light.trace || plan.thickness || (light.lit && target.illumination && !light.dark);
    anyTrace = anyTrace || plan.trace;
    if (plan.trace && cache && this->NeedsEveryD(plan))
    {
      this->UseCache(plan, cached);
    }
    if (plan.trace && !plan.kept && scene.integrator == Integrator::Exact)
    {
      plan.sweep = SweepThickness::MakeWhereItApplies(field, plan.medium, plan.light, sweeps);
    }
    first = false;
    this->Plans.push_back(std::move(plan));
  }

  this->MakeRoom();
  if (target.shadow)
  {
    this->Shadow = std::make_unique<SunShadow>(field, scene.sun, sweeps);
  }

  this->Effects = FindEffects(scene, effects, anyTrace, target.normals != nullptr);
  this->HasNormals = (this->Effects & NormalsEffect) != 0;
  this->Parts = this->MakeParts(effects);
  this->Writer = std::make_unique<PictureWriter>(target, this->Parts);
  const auto shown = std::count_if(
    this->Plans.begin(), this->Plans.end(), [](const Plan& plan) { return plan.shows; });
  this->Rounds = shown > 1 || (this->Effects & (DiffuseTextureEffect | SpecularTextureEffect)) != 0;
  bool none = true;
  bool noTerms = true;
  for (Plan& plan : this->Plans)
  {
    plan.terms = this->TermsOf(plan);
    plan.terms.firstIllumination = none;
    plan.terms.first = noTerms;
    none = none && !(plan.shows || plan.trace);
    noTerms = noTerms && !plan.shows;
    this->NeedsRing = this->NeedsRing || (!plan.directional && plan.shows);
  }
  this->NeedsRing = this->NeedsRing || this->HasNormals;
}

void SceneShading::Redirect(const Target& target)
{
  this->Out = target;
  this->Writer = std::make_unique<PictureWriter>(target, this->Parts);
}

void SceneShading::SetOutline(const HeightOutline* outline)
{
  this->Outline = outline;
  this->Error = OutlineError();
}

void SceneShading::AddError(const OutlineError& error)
{
  const std::lock_guard<std::mutex> lock(this->ErrorMutex);
  this->Error.Add(error);
}

PictureParts SceneShading::MakeParts(const EffectPlan& effects) const
{
  const Scene& scene = this->Parameters;
  PictureParts parts;
  parts.base =
    f32::reliefBaseTerm(static_cast<float>(scene.specularCoefficient), glm::vec3(scene.base));
  parts.bases = (this->Effects & BaseTextureEffect) != 0;
  parts.terms[SceneTile::Diffuse] = effects.diffuse;
  parts.terms[SceneTile::Scatter] = effects.scatter;
  parts.terms[SceneTile::Specular] = (this->Effects & SpecularEffect) != 0;
  parts.exposure = static_cast<float>(f64::reliefExposureFactor(scene.exposure));
  parts.illuminationScale = effects.shareSum != 0.0 ? 1.0 / effects.shareSum : 0.0;
  const bool textured =
    (this->Effects & (BaseTextureEffect | DiffuseTextureEffect | SpecularTextureEffect)) != 0;
  const bool grey = !textured && IsGrey(parts.base) && IsGrey(glm::vec3(scene.diffuse)) &&
    IsGrey(glm::vec3(scene.specular)) &&
    std::all_of(this->Plans.begin(), this->Plans.end(),
      [](const Plan& plan) { return !plan.shows || IsGrey(plan.radiance); });
  parts.channels = grey ? 1 : 3;
  return parts;
}

// What a light gives, once for all samples.
LightTerms SceneShading::TermsOf(const Plan& plan) const
{
  // A textured colour is the same for all lights: their sum is multiplied by it.
  const glm::vec3 white(1.0f);
  LightTerms terms = plan.terms;
  terms.channels = this->Parts.channels;
  terms.only = !this->Rounds;
  terms.diffuse = this->Parts.terms[SceneTile::Diffuse] && plan.shows;
  terms.scatter = this->Parts.terms[SceneTile::Scatter] && plan.shows;
  terms.specular = this->Parts.terms[SceneTile::Specular] && plan.shows;
  terms.illumination = this->Out.illumination != nullptr;
  terms.ks = static_cast<float>(this->Parameters.specularCoefficient);
  terms.kf = static_cast<float>(this->Parameters.scatterCoefficient);
  terms.directional = plan.directional;
  terms.scatterFactor = f32::reliefForwardScatter(this->ScatterFalloff, plan.vector);
  terms.vector = plan.vector;
  terms.radiance = plan.radiance;
  terms.diffuseColor =
    this->Effects & DiffuseTextureEffect ? white : glm::vec3(this->Parameters.diffuse);
  terms.specularColor =
    this->Effects & SpecularTextureEffect ? white : glm::vec3(this->Parameters.specular);
  terms.falloff = this->SpecularFalloff;
  return terms;
}

bool SceneShading::WantsPadding(const Scene& scene, int columns)
{
  // Any sun but one in the zenith.
  Light sun;
  sun.vector = glm::dvec3(0.6, 0.0, 0.8);
  // In a narrower image the margins would outweigh the samples, and little would be won.
  constexpr int margins = 2 * HeightField::Padding;
  return columns >= margins && scene.integrator == Integrator::Exact &&
    SweepThickness::Applies(scene.medium, sun);
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
  key.light = MakeIlluminationKey(this->FieldVersion, this->Parameters, plan);
  key.light.medium.tolerance = plan.thickness ? 0.0 : key.light.medium.tolerance;
  key.i0 = this->Out.i0;
  key.j0 = this->Out.j0;
  key.columns = this->Out.width;
  key.rows = this->Out.rows;
  key.thickness = plan.thickness;
  plan.kept = this->Cache->Find(key);
  const std::size_t size = IlluminationCache::SizeOf(key);
  if (!plan.kept && cached + size <= this->Cache->GetLimit())
  {
    plan.fresh = std::make_shared<IlluminationCache::Entry>();
    plan.fresh->key = key;
  }
  cached += plan.kept || plan.fresh ? size : 0;
}

// Room for the illuminations that are to be kept, once it is known which of those at hand are used.
void SceneShading::MakeRoom()
{
  const std::size_t samples = static_cast<std::size_t>(this->Out.width) * this->Out.rows;
  for (Plan& plan : this->Plans)
  {
    if (plan.fresh)
    {
      plan.fresh->illumination = this->Cache->TakeUnused(samples);
      plan.fresh->illumination.Allocate(samples);
      plan.fresh->thickness.Allocate(plan.fresh->key.thickness ? samples : 0);
    }
  }
}

void SceneShading::KeepIlluminations()
{
  std::vector<std::shared_ptr<IlluminationCache::Entry>> used;
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

namespace
{
// The tile of a column and row, of which [i0, i1) x [j0, j1) is asked for.
void Place(SceneTile& tile, int column, int row, const HeightView<float>& heights, int i0, int i1,
  int j0, int j1)
{
  constexpr int width = SweepThickness::TileWidth;
  constexpr int height = SweepThickness::TileHeight;
  tile.column = column;
  tile.row = row;
  tile.i0 = column * width;
  tile.i1 = std::min(tile.i0 + width, heights.columns);
  tile.j0 = row * height;
  tile.j1 = std::min(tile.j0 + height, heights.rows);
  tile.askedI0 = std::max(i0, tile.i0);
  tile.askedI1 = std::min(i1, tile.i1);
  tile.askedJ0 = std::max(j0, tile.j0);
  tile.askedJ1 = std::min(j1, tile.j1);
}
}

void SceneShading::Shade(int i0, int i1, int j0, int j1)
{
  constexpr int width = SweepThickness::TileWidth;
  constexpr int height = SweepThickness::TileHeight;
  const std::unique_ptr<SceneTile> tile(new SceneTile); // whose arrays have no values yet
  for (int row = j0 / height; row * height < j1; ++row)
  {
    for (int column = i0 / width; column * width < i1; ++column)
    {
      Place(*tile, column, row, this->Heights.heights, i0, i1, j0, j1);
      this->ShadeTile(*tile);
      this->Writer->Write(*tile);
    }
  }
  PictureWriter::Flush();
}

void SceneShading::FindLargest(int column, int row, float* largest)
{
  const HeightView<float>& heights = this->Heights.heights;
  const std::unique_ptr<SceneTile> tile(new SceneTile); // whose arrays have no values yet
  Place(*tile, column, row, heights, 0, heights.columns, 0, heights.rows);
  this->ShadeTile(*tile);
  this->Writer->FindLargest(*tile, largest);
}

void SceneShading::ShadeTile(SceneTile& tile)
{
  const HeightView<float>& heights = this->Heights.heights;
  tile.anyData = LoadHeights(heights, this->NeedsRing, tile);
  if (!tile.anyData)
  {
    return;
  }
  tile.outlined = this->Outline && !this->Outline->IsWhole(tile.i0, tile.j0);
  std::fill_n(tile.thickness.values, this->Out.thickness ? SceneTile::Size : 0, 0.0f);
  std::fill_n(tile.illumination.values, this->Out.illumination ? SceneTile::Size : 0, 0.0);
  if (this->HasNormals)
  {
    FindNormals(static_cast<float>(heights.spacingX), static_cast<float>(heights.spacingY), tile);
  }
  if (this->Medium.offset == f32::RELIEF_SURFACE_NORMAL && this->HasNormals)
  {
    tile.ForEach(
      [&](int, int, int at)
      {
        tile.normals[at] = glm::vec3(
          tile.normal[0].values[at], tile.normal[1].values[at], tile.normal[2].values[at]);
      });
  }
  if (this->Shadow)
  {
    RayCount work;
    if (!tile.outlined)
    {
      this->Shadow->ShadeTile(tile.column, tile.row, tile.shadow.values, work);
    }
    else if (!this->Shadow->ShadeTile(
               *this->Outline, tile.column, tile.row, tile.shadow.values, work))
    {
      OutlineError error;
      error.shadow = true;
      this->AddError(error);
    }
    this->ShadowRays += work.rays;
    this->Cells += work.cells;
  }
  for (std::size_t index = 0; index < this->Plans.size(); ++index)
  {
    const Plan& plan = this->Plans[index];
    if (plan.shows || plan.trace)
    {
      this->AddLight(plan, index, tile);
    }
  }
  this->ApplyTextures(tile);
  for (int term = 0; this->Rounds && term < SceneTile::NumberOfTerms; ++term)
  {
    if (this->Parts.terms[term])
    {
      RoundSums(static_cast<SceneTile::Term>(term), this->Parts.channels, tile);
    }
  }
}

// Fills d and r of the wanted samples.
void SceneShading::Illuminate(const Plan& plan, std::size_t index, SceneTile& tile)
{
  // Row by row between the tile and what is kept.
  const int first = tile.At(tile.askedI0, tile.askedJ0);
  const int columns = tile.askedI1 - tile.askedI0;
  auto forRows = [&](auto&& body)
  {
    for (int j = tile.askedJ0; j < tile.askedJ1; ++j)
    {
      body(first + (j - tile.askedJ0) * SceneTile::Width,
        static_cast<std::size_t>(j - this->Out.j0) * this->Out.width +
          (tile.askedI0 - this->Out.i0));
    }
  };
  if (plan.kept)
  {
    const IlluminationCache::Entry& kept = *plan.kept;
    forRows(
      [&](int at, std::size_t place)
      {
        std::copy_n(kept.illumination.data() + place, columns, tile.d.values + at);
        if (plan.thickness)
        {
          std::copy_n(kept.thickness.data() + place, columns, tile.r.values + at);
        }
      });
    return;
  }
  RayCount work;
  if (tile.outlined)
  {
    this->IlluminateByOutline(plan, tile, work);
  }
  else if (plan.sweep)
  {
    plan.sweep->IlluminateTile(
      tile.column, tile.row, tile.d.values, plan.thickness ? tile.r.values : nullptr, work);
  }
  else
  {
    RowRequest<float> rows[SweepThickness::TileHeight];
    for (int j = tile.j0; j < tile.j1; ++j)
    {
      rows[j - tile.j0] = this->RowOf(plan, j, tile);
      if (this->Parameters.integrator == Integrator::FixedStep)
      {
        StepRow(
          this->Heights, this->Medium, plan.light, this->Parameters.steps, rows[j - tile.j0], work);
      }
    }
    if (this->Parameters.integrator != Integrator::FixedStep)
    {
      TracePacketTile(this->Heights, plan.single, plan.light, rows, tile.j1 - tile.j0, work);
    }
  }
  this->Rays[index] += work.rays;
  this->Cells += work.cells;
  if (plan.fresh)
  {
    IlluminationCache::Entry& fresh = *plan.fresh;
    forRows(
      [&](int at, std::size_t place)
      {
        std::copy_n(tile.d.values + at, columns, fresh.illumination.data() + place);
        if (plan.thickness)
        {
          std::copy_n(tile.r.values + at, columns, fresh.thickness.data() + place);
        }
      });
  }
}

// What of a row of a tile a light is traced for.
RowRequest<float> SceneShading::RowOf(const Plan& plan, int j, SceneTile& tile) const
{
  const int at = tile.At(tile.i0, j);
  RowRequest<float> request;
  request.j = j;
  request.begin = tile.i0;
  request.end = tile.i1;
  request.normals = this->Medium.offset == f32::RELIEF_SURFACE_NORMAL ? tile.normals + at : nullptr;
  request.wanted = tile.wanted + at;
  request.illumination = tile.d.values + at;
  request.thickness = plan.thickness ? tile.r.values + at : nullptr;
  return request;
}

// The middle between the bounds of d is nowhere further from it than half of what lies between.
void SceneShading::IlluminateByOutline(const Plan& plan, SceneTile& tile, RayCount& work)
{
  static_assert(SceneTile::Width <= HeightOutline::MostSamples);
  HeightOutline::Row row;
  OutlineError error;
  for (int j = tile.j0; j < tile.j1; ++j)
  {
    const RowRequest<float> request = this->RowOf(plan, j, tile);
    if (this->Parameters.integrator == Integrator::FixedStep)
    {
      this->Outline->StepRow(this->Medium, plan.light, this->Parameters.steps, request, row, work);
    }
    else
    {
      this->Outline->TraceRow(plan.medium, plan.light, request, row, work);
    }
    const int first = tile.At(tile.i0, j);
    for (int k = 0; k < tile.i1 - tile.i0; ++k)
    {
      if (!tile.HasData(first + k) || !request.wanted[k])
      {
        continue;
      }
      const double off = (row.greatestD[k] - row.leastD[k]) / 2.0;
      request.illumination[k] = static_cast<float>(row.leastD[k] + off);
      error.tolerance = std::max(error.tolerance, std::abs(off) / plan.light.toleranceScale);
      if (request.thickness)
      {
        request.thickness[k] = static_cast<float>(row.leastR[k]);
        error.thickness = error.thickness || row.leastR[k] != row.greatestR[k];
      }
    }
  }
  this->AddError(error);
}

// Whether an integrator takes all samples of a tile, whichever are wanted.
bool SceneShading::TakesAll(const Plan& plan, const SceneTile& tile)
{
  return plan.kept || (plan.sweep && !tile.outlined);
}

// Tells integrators that take samples one by one which are wanted. Returns whether any is.
bool SceneShading::FindWanted(const Plan& plan, bool hasScatter, SceneTile& tile) const
{
  const bool everyD = this->NeedsEveryD(plan) || !hasScatter;
  if (everyD && TakesAll(plan, tile))
  {
    return true;
  }
  bool anyWanted = false;
  tile.ForEach(
    [&](int, int, int at)
    {
      const float factor =
        plan.directional ? plan.terms.scatterFactor : tile.scatterFactor.values[at];
      tile.wanted[at] = tile.HasData(at) && (everyD || factor > 0.0f);
      anyWanted |= tile.wanted[at] != 0;
    });
  return anyWanted;
}

void SceneShading::AddLight(const Plan& plan, std::size_t index, SceneTile& tile)
{
  const bool hasScatter = plan.terms.scatter;
  const bool answers = this->Parameters.response != f64::RELIEF_ILLUMINATION && plan.matte;
  if (!plan.directional && (plan.terms.specular || hasScatter || answers))
  {
    FindDirections(plan.light, this->Medium, this->Heights.heights, tile);
    if (hasScatter)
    {
      FindScatter(this->ScatterFalloff, tile);
    }
  }
  const bool traces = plan.trace && this->FindWanted(plan, hasScatter, tile);
  if (!traces || !TakesAll(plan, tile))
  {
    std::fill_n(tile.d.values, SceneTile::Size, 0.0f);
    std::fill_n(tile.r.values, SceneTile::Size, std::numeric_limits<float>::infinity());
  }
  if (traces)
  {
    this->Illuminate(plan, index, tile);
  }
  if (plan.thickness)
  {
    std::copy_n(tile.r.values, SceneTile::Size, tile.thickness.values);
  }
  if (plan.terms.illumination)
  {
    AddIllumination(plan.terms, tile);
  }
  if (answers)
  {
    FindResponse(this->Parameters.response, plan.terms, tile);
  }
  AddTerms(plan.terms, tile);
}

// Finds the textured colours and multiplies what the lights gave by them.
void SceneShading::ApplyTextures(SceneTile& tile) const
{
  auto cover = [&](const glm::dvec3& constant, const std::vector<ColorTexture>& textures)
  {
    std::fill_n(tile.texels, SceneTile::Size, glm::vec3(constant));
    for (const ColorTexture& texture : textures)
    {
      for (int j = tile.askedJ0; j < tile.askedJ1; ++j)
      {
        texture.Cover(tile.askedI0, tile.askedI1, j, tile.texels + tile.At(tile.askedI0, j));
      }
    }
  };
  auto multiply = [&](SceneTile::Term term)
  {
    for (int c = 0; this->Parts.terms[term] && c < 3; ++c)
    {
      double* sums = tile.sums[term][c].values;
      tile.ForEachAsked(
        [&](int, int, int at) { sums[at] *= static_cast<double>(tile.texels[at][c]); });
    }
  };

  if (this->Effects & BaseTextureEffect)
  {
    const float ks = static_cast<float>(this->Parameters.specularCoefficient);
    cover(this->Parameters.base, this->Parameters.baseTextures);
    tile.ForEachAsked(
      [&](int, int, int at)
      {
        const glm::vec3 base = f32::reliefBaseTerm(ks, tile.texels[at]);
        tile.base[0].values[at] = base.x;
        tile.base[1].values[at] = base.y;
        tile.base[2].values[at] = base.z;
      });
  }
  if (this->Effects & DiffuseTextureEffect)
  {
    cover(this->Parameters.diffuse, this->Parameters.diffuseTextures);
    multiply(SceneTile::Diffuse);
    multiply(SceneTile::Scatter);
  }
  if (this->Effects & SpecularTextureEffect)
  {
    cover(this->Parameters.specular, this->Parameters.specularTextures);
    multiply(SceneTile::Specular);
  }
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
  std::uint64_t rays = this->ShadowRays;
  for (std::size_t index = 0; index < this->Plans.size(); ++index)
  {
    rays += this->Rays[index];
  }
  return rays;
}

}
