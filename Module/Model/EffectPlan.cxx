// SPDX-License-Identifier: BSD-3-Clause
#include "EffectPlan.h"

#include "StepThickness.h"

namespace relief
{

namespace
{
bool IsBlack(const glm::dvec3& color)
{
  return color.x == 0.0 && color.y == 0.0 && color.z == 0.0;
}
}

EffectPlan PlanEffects(const HeightField& field, const Scene& scene)
{
  const double ks = scene.specularCoefficient;
  const double kf = scene.scatterCoefficient;
  EffectPlan plan;
  plan.matte = ks < 1.0 && (!scene.diffuseTextures.empty() || !IsBlack(scene.diffuse));
  double all = 0.0;
  plan.mirror = ks > 0.0 && (!scene.specularTextures.empty() || !IsBlack(scene.specular));
  for (const Light& light : scene.lights)
  {
    LightPlan one;
    one.light = light;
    one.directional = !light.positional;
    one.vector = glm::vec3(light.vector);
    one.radiance = glm::vec3(light.color * (light.intensity * light.weight));
    one.share = static_cast<float>(light.intensity * light.weight);
    one.lit = light.intensity * light.weight != 0.0 && !IsBlack(light.color);
    // With the closed form r is infinite below the horizon, unless a floor ends it.
    one.dark = one.directional && light.vector.z < 0.0 && !scene.medium.useFloor &&
      scene.integrator == Integrator::Exact;
    // Where all light is scattered forward, a sun from which none comes this way gives nothing.
    const bool neverScattered = one.directional && kf == 1.0 &&
      f64::reliefForwardScatter(scene.scatterFalloff, light.vector) == 0.0;
    const bool answers = scene.response != f64::RELIEF_ILLUMINATION;
    one.matte = one.lit && plan.matte && (answers || !one.dark) && !neverScattered;
    one.trace = one.matte && !one.dark && scene.response != f64::RELIEF_IGOR;
    one.shows = one.matte || (one.lit && plan.mirror);
    if (scene.integrator == Integrator::FixedStep && one.directional)
    {
      one.light =
        OnBoundingSphere(light, field.GetField().heights, field.GetBottom(), field.GetTop());
    }
    plan.diffuse = plan.diffuse || (one.matte && kf < 1.0);
    plan.scatter = plan.scatter || (one.matte && kf > 0.0);
    plan.specular = plan.specular || (one.lit && plan.mirror);
    plan.shareSum += one.lit ? one.share * light.open : 0.0;
    all += one.lit ? one.share : 0.0f;
    plan.lights.push_back(one);
  }
  // An environment that shines from below only gives level ground nothing in the open.
  plan.shareSum = plan.shareSum != 0.0 ? plan.shareSum : all;
  return plan;
}

int FindEffects(const Scene& scene, const EffectPlan& plan, bool traced, bool normals)
{
  const bool illuminates = plan.diffuse || plan.scatter;
  const bool answers = illuminates && scene.response != f64::RELIEF_ILLUMINATION;
  const bool illumination = (illuminates && scene.response != f64::RELIEF_IGOR) || traced;
  const bool offset = illumination && scene.medium.offset == f64::RELIEF_SURFACE_NORMAL;
  int effects = 0;
  auto add = [&](bool wanted, Effect effect) { effects |= wanted ? effect : 0; };
  add(illumination, IlluminationEffect);
  add(plan.specular || answers || offset || normals, NormalsEffect);
  add(plan.specular, SpecularEffect);
  add(plan.scatter, ScatterEffect);
  add(scene.specularCoefficient < 1.0 && !scene.baseTextures.empty(), BaseTextureEffect);
  add(illuminates && !scene.diffuseTextures.empty(), DiffuseTextureEffect);
  add(plan.specular && !scene.specularTextures.empty(), SpecularTextureEffect);
  return effects;
}

}
