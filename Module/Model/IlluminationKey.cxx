// SPDX-License-Identifier: BSD-3-Clause
#include "IlluminationKey.h"

#include <glm/vector_relational.hpp>

#include <functional>
#include <initializer_list>
#include <tuple>

namespace relief
{

namespace
{
auto Parts(const f64::ReliefMedium& medium)
{
  return std::tie(medium.depth, medium.offset, medium.attenuation, medium.density, medium.useFloor,
    medium.floorHeight, medium.tolerance);
}
}

bool IlluminationKey::operator==(const IlluminationKey& other) const
{
  return this->field == other.field && this->vector == other.vector &&
    this->positional == other.positional && this->steps == other.steps &&
    this->response == other.response && Parts(this->medium) == Parts(other.medium);
}

IlluminationKey MakeIlluminationKey(std::uint64_t field, const Scene& scene, const LightPlan& light)
{
  IlluminationKey key;
  key.field = field;
  key.vector = light.light.vector;
  key.positional = light.light.positional;
  key.medium.depth = scene.medium.depth;
  key.medium.offset = scene.medium.offset;
  if (scene.integrator == Integrator::FixedStep)
  {
    // Algorithm 1 counts points: it knows no attenuation, floor or tolerance.
    key.steps = scene.steps;
    return key;
  }
  key.medium.attenuation = scene.medium.attenuation;
  key.medium.density =
    scene.medium.attenuation == f64::RELIEF_EXPONENTIAL ? scene.medium.density : 0.0;
  key.medium.useFloor = scene.medium.useFloor;
  key.medium.floorHeight = scene.medium.useFloor ? scene.medium.floorHeight : 0.0;
  key.medium.tolerance = scene.medium.tolerance * light.light.toleranceScale;
  return key;
}

std::size_t IlluminationHash::operator()(const IlluminationKey& key) const
{
  // What differs between the lights of a scene, and what a user turns most; the rest may collide.
  std::size_t hash = std::hash<std::uint64_t>()(key.field);
  for (const double number :
    { key.vector.x, key.vector.y, key.vector.z, key.medium.depth, key.medium.tolerance })
  {
    // As boost::hash_combine spreads bits.
    hash ^= std::hash<double>()(number) + 0x9e3779b9 + (hash << 6) + (hash >> 2);
  }
  return hash;
}

}
