// SPDX-License-Identifier: BSD-3-Clause
#ifndef IlluminationKey_h
#define IlluminationKey_h

#include "EffectPlan.h"
#include "Scene.h"

#include <cstddef>
#include <cstdint>

namespace relief
{

/// All that the illumination d of one light depends on, and nothing else: what is kept under an
/// equal key is what would be computed. Whatever the integrator and the attenuation do not look at
/// is 0 here, so changing it traces nothing.
struct IlluminationKey
{
  std::uint64_t field = 0;             ///< HeightField::GetVersion()
  glm::dvec3 vector = glm::dvec3(0.0); ///< of the light
  bool positional = false;
  f64::ReliefMedium medium = {};
  int steps = 0;    ///< of FixedStep, 0 for Exact
  int response = 0; ///< where what stands for d is kept in its place

  bool operator==(const IlluminationKey& other) const;
  bool operator!=(const IlluminationKey& other) const { return !(*this == other); }
};

/// The key of one of a scene's lights, over a field of that version.
IlluminationKey MakeIlluminationKey(
  std::uint64_t field, const Scene& scene, const LightPlan& light);

/// For containers: equal keys have equal hashes.
struct IlluminationHash
{
  std::size_t operator()(const IlluminationKey& key) const;
};

}

#endif
