// SPDX-License-Identifier: BSD-3-Clause
#ifndef EffectPlan_h
#define EffectPlan_h

#include "HeightField.h"
#include "Scene.h"

#include <vector>

namespace relief
{

/// What is evaluated to shade a scene, as bits.
enum Effect
{
  IlluminationEffect = 1,
  NormalsEffect = 2,
  SpecularEffect = 4,
  ScatterEffect = 8,
  BaseTextureEffect = 16,
  DiffuseTextureEffect = 32,
  SpecularTextureEffect = 64
};

/// A light and what a scene wants of it.
struct LightPlan
{
  Light light;        ///< as the integrator takes it
  glm::vec3 vector;   ///< toward it, for a directional light's highlight and scattering
  bool directional;   ///< as the scene has it
  glm::vec3 radiance; ///< weight, intensity and colour
  float share;        ///< weight and intensity, for the mean illumination
  bool lit;           ///< it is not black
  bool dark;          ///< its illumination is 0 everywhere
  bool shows;         ///< it brightens something
  bool matte;         ///< the surface's answer to it shows and is not known to be 0
  bool trace;         ///< that answer depends on its illumination, which is not known to be 0
};

/// Which effects a scene calls for, and what it wants of each of its lights, in their order.
struct EffectPlan
{
  bool matte = false;    ///< illumination shows, where there is any
  bool mirror = false;   ///< highlights show, where there is light
  bool diffuse = false;  ///< light that goes straight through shows
  bool scatter = false;  ///< forward scattering shows
  bool specular = false; ///< highlights show
  /// What the mean illumination is divided by: what the lights that are not black give level ground
  /// in the open.
  double shareSum = 0.0;
  std::vector<LightPlan> lights;
};

EffectPlan PlanEffects(const HeightField& field, const Scene& scene);

/// The effects that a planned scene's colours call for, as bits of Effect. Layers may call for
/// more: `traced`, that the illumination of a light is found whether it shows or not, and
/// `normals`.
int FindEffects(
  const Scene& scene, const EffectPlan& plan, bool traced = false, bool normals = false);

}

#endif
