// SPDX-License-Identifier: BSD-3-Clause
//
// What sums and colours were made from: whatever compares equal need not be made again.
#include "ReliefFrames.h"

#include "vtkTextureObject.h"

#include <tuple>

//------------------------------------------------------------------------------
bool ReliefFrames::Same(const relief::f64::ReliefFalloff& a, const relief::f64::ReliefFalloff& b)
{
  return a.lo == b.lo && a.hi == b.hi && a.power == b.power;
}

//------------------------------------------------------------------------------
bool ReliefFrames::GatheredLight::operator==(const GatheredLight& other) const
{
  auto parts = [](const GatheredLight& l)
  { return std::tie(l.stamp, l.directional, l.vector, l.radiance); };
  return parts(*this) == parts(other);
}

//------------------------------------------------------------------------------
bool ReliefFrames::Gathered::operator==(const Gathered& other) const
{
  auto parts = [](const Gathered& g)
  { return std::tie(g.grid, g.sums, g.lights, g.depth, g.offset, g.field); };
  return parts(*this) == parts(other) && Same(this->specular, other.specular) &&
    Same(this->scatter, other.scatter);
}

//------------------------------------------------------------------------------
bool ReliefFrames::Composed::operator==(const Composed& other) const
{
  auto parts = [](const Composed& c)
  {
    return std::tie(c.first, c.grid, c.laterStamp, c.laterScale, c.base, c.diffuse, c.specular,
      c.specularCoefficient, c.scatterCoefficient, c.field, c.textures);
  };
  return parts(*this) == parts(other);
}

//------------------------------------------------------------------------------
ReliefFrames::Gathered ReliefFrames::DescribeFirst() const
{
  Gathered from;
  from.grid = this->Shown;
  from.sums = this->Sums;
  from.specular = this->Parameters->specularFalloff;
  from.scatter = this->Parameters->scatterFalloff;
  for (const auto& [light, key, entry] : this->First)
  {
    from.lights.push_back(
      { entry ? entry->stamp : 0, light->directional, light->light.vector, light->radiance });
  }
  if (!this->First.empty())
  {
    from.depth = this->Parameters->medium.depth;
    from.offset = this->Parameters->medium.offset;
    from.field = this->Passes->GetField().GetVersion();
  }
  return from;
}

//------------------------------------------------------------------------------
ReliefFrames::Composed ReliefFrames::DescribeColors() const
{
  const relief::Scene& scene = *this->Parameters;
  Composed from;
  from.first = *this->GatheredFrom;
  from.grid = this->Shown;
  from.laterStamp = this->LaterSums.stamp;
  from.laterScale = this->LaterScale;
  from.base = scene.base;
  from.diffuse = scene.diffuse;
  from.specular = scene.specular;
  from.specularCoefficient = scene.specularCoefficient;
  from.scatterCoefficient = scene.scatterCoefficient;
  from.field = this->Passes->GetField().GetVersion();
  from.textures = this->Asked.textures;
  return from;
}
