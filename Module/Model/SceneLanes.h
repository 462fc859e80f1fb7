// SPDX-License-Identifier: BSD-3-Clause
#ifndef SceneLanes_h
#define SceneLanes_h

/// @file
/// What a scene computes of a tile's samples besides d, in the lanes of vectors: the model's own
/// text, compiled for several instruction sets and chosen at run time.

#include "SceneTile.h"

namespace relief
{

/// A light's part in the terms of the integrated equation.
struct LightTerms
{
  int channels = 3;              ///< that are computed: 1 where all are the same
  bool first = true;             ///< sums begin with it
  bool firstIllumination = true; ///< the mean illumination does
  bool only = true;              ///< there is no other: float has the whole sum
  bool diffuse = false;
  bool scatter = false;
  bool specular = false;
  bool illumination = false;
  float ks = 0.0f;
  float kf = 0.0f;
  float share = 0.0f;         ///< in the mean illumination
  bool directional = true;    ///< otherwise directions and scatter factors are the tile's
  float scatterFactor = 0.0f; ///< of a directional light
  glm::vec3 vector{};         ///< toward it
  glm::vec3 radiance{};
  glm::vec3 diffuseColor{};
  glm::vec3 specularColor{};
  f32::ReliefFalloff falloff{}; ///< of highlights
};

/// Copies the heights of a tile's samples, and with `ring` those of their neighbours. Returns
/// whether any sample has data.
bool LoadHeights(const HeightView<float>& heights, bool ring, SceneTile& tile);

/// Adds d, which is the light's own, to a tile's mean illumination.
void AddIllumination(const LightTerms& light, SceneTile& tile);

/// Puts the surface's answer to a light in the place of its d. Needs normals and, of a lamp,
/// directions.
void FindResponse(int response, const LightTerms& light, SceneTile& tile);

/// Adds what a light gives to the sums of a tile, in which d, or what stands for it, is its own.
void AddTerms(const LightTerms& light, SceneTile& tile);

/// Rounds the sums over several lights of a term.
void RoundSums(SceneTile::Term term, int channels, SceneTile& tile);

/// The normals of all samples of a tile, of which the neighbours' heights are known.
void FindNormals(float spacingX, float spacingY, SceneTile& tile);

/// The directions toward a lamp, as the model's reliefRay() has them.
void FindDirections(const Light& lamp, const f32::ReliefMedium& medium,
  const HeightView<float>& heights, SceneTile& tile);

/// What is scattered this way of a lamp's light.
void FindScatter(const f32::ReliefFalloff& falloff, SceneTile& tile);

}

#endif
