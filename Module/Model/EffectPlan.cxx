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
  plan.mirror = ks > 0.0 && (!scene.specularTextures.empty() || !IsBlack(scene.specular));
  for (const Light& light : scene.lights)
  {
    LightPlan one;
    one.light = light;
    one.directional = !light.positional;
    one.vector = glm::vec3(light.vector);
    one.radiance = glm::vec3(light.color * (light.intensity * light.weight));
    one.lit = light.intensity * light.weight != 0.0 && !IsBlack(light.color);
    // With the closed form r is infinite below the horizon, unless a floor ends it.
    one.dark = one.directional && light.vector.z < 0.0 && !scene.medium.useFloor &&
      scene.integrator == Integrator::Exact;
    // Where all light is scattered forward, a sun from which none comes this way gives nothing.
    const bool neverScattered = one.directional && kf == 1.0 &&
      f64::reliefForwardScatter(scene.scatterFalloff, light.vector) == 0.0;
    one.trace = one.lit && plan.matte && !one.dark && !neverScattered;
    one.shows = one.trace || (one.lit && plan.mirror);
    if (scene.integrator == Integrator::FixedStep && one.directional)
    {
      one.light =
        OnBoundingSphere(light, field.GetField().heights, field.GetBottom(), field.GetTop());
    }
    plan.diffuse = plan.diffuse || (one.trace && kf < 1.0);
    plan.scatter = plan.scatter || (one.trace && kf > 0.0);
    plan.specular = plan.specular || (one.lit && plan.mirror);
    plan.lights.push_back(one);
  }
  return plan;
}

}
