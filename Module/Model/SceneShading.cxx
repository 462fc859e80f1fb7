// SPDX-License-Identifier: BSD-3-Clause
#include "SceneShading.h"

#include "StepThickness.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relief
{

namespace
{
// Samples shaded together: few enough for their buffers to stay in the first-level cache.
constexpr int Chunk = 256;

bool IsBlack(const glm::dvec3& color)
{
  return color.x == 0.0 && color.y == 0.0 && color.z == 0.0;
}

f32::ReliefFalloff ToSingle(const f64::ReliefFalloff& falloff)
{
  return { static_cast<float>(falloff.lo), static_cast<float>(falloff.hi),
    static_cast<float>(falloff.power) };
}

void Store(float* layer, std::size_t at, const glm::vec3& value)
{
  if (layer)
  {
    layer[3 * at] = value.x;
    layer[3 * at + 1] = value.y;
    layer[3 * at + 2] = value.z;
  }
}
}

// Sums and intermediate results of a chunk of one row.
struct SceneShading::Row
{
  glm::vec3 normals[Chunk];
  glm::vec3 toLight[Chunk];
  float scatterFactor[Chunk];
  unsigned char wanted[Chunk];
  float d[Chunk];
  float r[Chunk];
  glm::vec3 diffuse[Chunk];
  glm::vec3 scatter[Chunk];
  glm::vec3 specular[Chunk];
  float illumination[Chunk];
  float thickness[Chunk];
};

SceneShading::SceneShading(const HeightField& field, const Scene& scene, const Target& target)
  : Heights(field.GetField())
  , Parameters(scene)
  , Out(target)
  , Medium(relief::ToSingle(scene.medium))
  , ExactMedium(this->Medium)
  , SpecularFalloff(ToSingle(scene.specularFalloff))
  , ScatterFalloff(ToSingle(scene.scatterFalloff))
  , Rays(new std::atomic<std::uint64_t>[scene.lights.size()] {})
{
  this->ExactMedium.tolerance = 0.0f;
  double ks = scene.specularCoefficient;
  double kf = scene.scatterCoefficient;
  bool diffuseShows = ks < 1.0 && !IsBlack(scene.diffuse);
  bool specularShows = ks > 0.0 && !IsBlack(scene.specular);
  this->HasScatter = diffuseShows && kf > 0.0;

  bool firstLight = true;
  for (const Light& light : scene.lights)
  {
    Plan plan;
    plan.light = light;
    plan.directional = !light.positional;
    plan.vector = glm::vec3(light.vector);
    plan.radiance = glm::vec3(light.color * (light.intensity * light.weight));
    plan.share = static_cast<float>(light.intensity * light.weight);
    bool lit = plan.share != 0.0f && !IsBlack(light.color);
    plan.shows = lit && (diffuseShows || specularShows);
    plan.thickness = target.thickness && firstLight;
    plan.needsD = plan.thickness || (lit && (diffuseShows || target.illumination));
    bool neverLit = plan.directional && light.vector.z < 0.0 && !scene.medium.useFloor &&
      scene.integrator == Integrator::Exact;
    plan.trace = plan.needsD && (!neverLit || plan.thickness);
    if (scene.integrator == Integrator::FixedStep && plan.directional)
    {
      plan.light =
        OnBoundingSphere(light, this->Heights.heights, field.GetBottom(), field.GetTop());
    }
    if (lit)
    {
      this->ShareSum += plan.share;
    }
    firstLight = false;
    this->Plans.push_back(plan);
  }

  bool anyNeedsD = false;
  bool anyTrace = false;
  bool anyShows = false;
  for (const Plan& plan : this->Plans)
  {
    anyNeedsD = anyNeedsD || plan.needsD;
    anyTrace = anyTrace || plan.trace;
    anyShows = anyShows || plan.shows;
  }
  bool hasSpecular = specularShows && anyShows;
  this->HasScatter = this->HasScatter && anyShows;
  this->HasNormals = hasSpecular || target.normals ||
    (anyTrace && scene.medium.offset == f64::RELIEF_SURFACE_NORMAL);
  this->Effects = (anyNeedsD ? IlluminationEffect : 0) | (this->HasNormals ? NormalsEffect : 0) |
    (hasSpecular ? SpecularEffect : 0) | (this->HasScatter ? ScatterEffect : 0);
}

void SceneShading::Shade(int i0, int i1, int j0, int j1)
{
  Row row;
  for (int j = j0; j < j1; ++j)
  {
    for (int i = i0; i < i1; i += Chunk)
    {
      this->ShadeRow(j, i, std::min(i + Chunk, i1), row);
    }
  }
}

void SceneShading::ShadeRow(int j, int i0, int i1, Row& row)
{
  int count = i1 - i0;
  for (int k = 0; k < count; ++k)
  {
    row.diffuse[k] = row.scatter[k] = row.specular[k] = glm::vec3(0.0f);
    row.illumination[k] = 0.0f;
    row.thickness[k] = 0.0f;
    if (this->HasNormals && !std::isnan(this->Heights.heights.At(i0 + k, j)))
    {
      row.normals[k] = f32::reliefNormal(this->Heights, i0 + k, j);
    }
  }
  for (std::size_t index = 0; index < this->Plans.size(); ++index)
  {
    const Plan& plan = this->Plans[index];
    if (plan.shows || plan.needsD)
    {
      this->AddLight(plan, index, j, i0, i1, row);
    }
  }
  this->Write(j, i0, i1, row);
}

void SceneShading::AddLight(const Plan& plan, std::size_t index, int j, int i0, int i1, Row& row)
{
  int count = i1 - i0;
  float ks = static_cast<float>(this->Parameters.specularCoefficient);
  float kf = static_cast<float>(this->Parameters.scatterCoefficient);
  glm::vec3 diffuse(this->Parameters.diffuse);
  glm::vec3 specular(this->Parameters.specular);
  bool hasSpecular = (this->Effects & SpecularEffect) && plan.shows;
  bool hasScatter = this->HasScatter && plan.shows;

  // Directions, and with them forward scattering, which can tell that d does not show.
  const HeightView<float>& heights = this->Heights.heights;
  bool everyD = plan.thickness || this->Out.illumination;
  for (int k = 0; k < count; ++k)
  {
    float height = heights.At(i0 + k, j);
    row.wanted[k] = plan.trace && !std::isnan(height);
    row.d[k] = 0.0f;
    row.r[k] = std::numeric_limits<float>::infinity();
    if (std::isnan(height) || (!hasSpecular && !hasScatter))
    {
      continue;
    }
    row.toLight[k] = plan.vector;
    if (!plan.directional)
    {
      f32::reliefRay(this->Heights, this->Medium, i0 + k, j, row.normals[k],
        LightFrom<float>(plan.light, (i0 + k) * heights.spacingX, j * heights.spacingY), true,
        row.toLight[k]);
    }
    if (hasScatter)
    {
      row.scatterFactor[k] = f32::reliefForwardScatter(this->ScatterFalloff, row.toLight[k]);
      row.wanted[k] = row.wanted[k] && (everyD || kf < 1.0f || row.scatterFactor[k] > 0.0f);
    }
  }

  if (plan.trace)
  {
    RowRequest<float> request;
    request.j = j;
    request.begin = i0;
    request.end = i1;
    request.normals = this->Medium.offset == f32::RELIEF_SURFACE_NORMAL ? row.normals : nullptr;
    request.wanted = row.wanted;
    request.illumination = row.d;
    request.thickness = plan.thickness ? row.r : nullptr;
    RayCount work;
    if (this->Parameters.integrator == Integrator::FixedStep)
    {
      StepRow(this->Heights, this->Medium, plan.light, this->Parameters.steps, request, work);
    }
    else
    {
      TraceRow<float>(this->Heights, plan.thickness ? this->ExactMedium : this->Medium, plan.light,
        request, work);
    }
    this->Rays[index] += work.rays;
    this->Cells += work.cells;
  }

  for (int k = 0; k < count; ++k)
  {
    if (plan.thickness)
    {
      row.thickness[k] = row.r[k];
    }
    if (this->Out.illumination)
    {
      row.illumination[k] += plan.share * row.d[k];
    }
    if (!plan.shows || std::isnan(heights.At(i0 + k, j)))
    {
      continue;
    }
    row.diffuse[k] += f32::reliefDiffuseTerm(ks, kf, row.d[k], plan.radiance, diffuse);
    if (hasScatter)
    {
      row.scatter[k] +=
        f32::reliefScatterTerm(ks, kf, row.scatterFactor[k], row.d[k], plan.radiance, diffuse);
    }
    if (hasSpecular)
    {
      float s = f32::reliefSpecularity(this->SpecularFalloff, row.normals[k], row.toLight[k]);
      row.specular[k] += f32::reliefSpecularTerm(ks, s, plan.radiance, specular);
    }
  }
}

void SceneShading::Write(int j, int i0, int i1, const Row& row)
{
  const Target& out = this->Out;
  const float none = std::numeric_limits<float>::quiet_NaN();
  glm::vec3 base = f32::reliefBaseTerm(
    static_cast<float>(this->Parameters.specularCoefficient), glm::vec3(this->Parameters.base));
  for (int i = i0; i < i1; ++i)
  {
    int k = i - i0;
    std::size_t at = static_cast<std::size_t>(j - out.j0) * out.width + (i - out.i0);
    bool hasData = !std::isnan(this->Heights.heights.At(i, j));
    glm::vec3 color = base + row.diffuse[k] + row.scatter[k] + row.specular[k];
    if (out.rgba)
    {
      float* rgba = out.rgba + 4 * at;
      rgba[0] = hasData ? color.x : 0.0f;
      rgba[1] = hasData ? color.y : 0.0f;
      rgba[2] = hasData ? color.z : 0.0f;
      rgba[3] = hasData ? 1.0f : 0.0f;
    }
    if (out.rgba8)
    {
      unsigned char* rgba = out.rgba8 + 4 * at;
      for (int c = 0; c < 3; ++c)
      {
        rgba[c] =
          hasData ? static_cast<unsigned char>(f32::reliefEncode(color[c]) * 255.0f + 0.5f) : 0;
      }
      rgba[3] = hasData ? 255 : 0;
    }
    if (out.illumination)
    {
      float mean = this->ShareSum != 0.0f ? row.illumination[k] / this->ShareSum : 0.0f;
      out.illumination[at] = hasData ? mean : none;
    }
    if (out.thickness)
    {
      out.thickness[at] = hasData ? row.thickness[k] : none;
    }
    Store(out.normals, at, hasData ? row.normals[k] : glm::vec3(none));
    Store(out.base, at, hasData ? base : glm::vec3(none));
    Store(out.diffuse, at, hasData ? row.diffuse[k] : glm::vec3(none));
    Store(out.scatter, at, hasData ? row.scatter[k] : glm::vec3(none));
    Store(out.specular, at, hasData ? row.specular[k] : glm::vec3(none));
  }
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
