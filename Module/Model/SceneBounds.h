// SPDX-License-Identifier: BSD-3-Clause
#ifndef SceneBounds_h
#define SceneBounds_h

/// @file
/// Numbers that are too large for single precision, which the model multiplies: what is beyond
/// looks the same (Documentation/Conventions.md).

#include "Scene.h"

namespace relief
{

/// Longer lengths count as this one.
constexpr double LargestLength = 1e32;

/// A lamp farther away stands in the same direction, and light that is stronger is as white.
void Bound(Light& light);

/// All of a scene but its lights.
void Bound(Scene& scene);

}

#endif
