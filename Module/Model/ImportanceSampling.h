// SPDX-License-Identifier: BSD-3-Clause
#ifndef ImportanceSampling_h
#define ImportanceSampling_h

#include "RadianceMap.h"

namespace relief
{

/// A patch that one light stands for, and the direction it shines from.
struct PatchLight
{
  SkyPatch patch;
  glm::dvec3 toward;
};

/// Divides the sphere for EnvironmentSampling::Importance; `turn` is in radians.
std::vector<PatchLight> DivideByImportance(const RadianceMap& map, double turn, int samples);

}

#endif
