// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefModelScene_h
#define ReliefModelScene_h

#include "ColorTexture.h"
#include "LightSampling.h"
#include "RayThickness.h"

#include <vector>

namespace relief
{

enum class Integrator
{
  Exact,
  FixedStep
};

/// Material, lights and accuracy; lengths in the field's unit, heights from its height 0.
struct Scene
{
  glm::dvec3 base = glm::dvec3(0.0);
  glm::dvec3 diffuse = glm::dvec3(1.0);
  glm::dvec3 specular = glm::dvec3(1.0);
  ///@{
  /// Textures over these colours, the lowest first. One that lies nowhere on the field does not
  /// belong here: it would count as something that shows.
  std::vector<ColorTexture> baseTextures;
  std::vector<ColorTexture> diffuseTextures;
  std::vector<ColorTexture> specularTextures;
  ///@}
  double specularCoefficient = 0.0;
  double scatterCoefficient = 0.0;
  f64::ReliefFalloff specularFalloff = { 0.0, 1.0, 1.0 };
  f64::ReliefFalloff scatterFalloff = { 0.0, 1.0, 1.0 };
  f64::ReliefMedium medium = { 1.0, f64::RELIEF_VERTICAL, f64::RELIEF_RECIPROCAL, 1.0, false, 0.0,
    0.0 };
  int response = f64::RELIEF_ILLUMINATION;
  std::vector<Light> lights;
  /// The directions of the first sun's disc, for the layer of its shadow alone; empty without a
  /// sun.
  std::vector<Light> sun;
  /// In stops: what colours are multiplied by, as a power of 2, where they become 8-bit numbers.
  double exposure = 0.0;
  Integrator integrator = Integrator::Exact;
  int steps = 256;

  /// Adds a light; where it is directional and has a diameter, in radians, as so many samples of
  /// its disc.
  void Add(const Light& light, double diameter, int samples)
  {
    const std::vector<Light> disc = SampleDisc(light, light.positional ? 0.0 : diameter, samples);
    this->lights.insert(this->lights.end(), disc.begin(), disc.end());
    if (this->sun.empty() && !light.positional)
    {
      this->sun = disc;
    }
  }
};

}

#endif
