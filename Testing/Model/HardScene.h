// SPDX-License-Identifier: BSD-3-Clause
#ifndef HardScene_h
#define HardScene_h

/// @file
/// A scene that is hard to compute: small enough to be written down as code, which is also how it
/// prints.

#include "TestTerrain.h"

#include <ostream>
#include <vector>

constexpr double Infinite = std::numeric_limits<double>::infinity();

struct HardScene
{
  Terrain terrain; ///< infinite heights count as none
  relief::f64::ReliefMedium medium = Sunk(1.0);
  std::vector<relief::Light> lights;
};

/// The scene as C++ that builds it again, bit for bit.
std::ostream& operator<<(std::ostream& out, const HardScene& scene);

/// With no data where heights are infinite.
Terrain WithoutInfinities(Terrain terrain);

#endif
