// SPDX-License-Identifier: BSD-3-Clause
#ifndef EmbreeShadows_h
#define EmbreeShadows_h

#include "BenchmarkTerrain.h"
#include "RayThickness.h"

#include <memory>
#include <string>

namespace bench
{

/// Hard shadows by Embree, on one thread: whether one ray from each sample toward a sun meets the
/// surface.
class EmbreeShadows
{
public:
  enum Surface
  {
    Grid, ///< Embree's own bilinear grids
    Triangles
  };

  /// Builds the tree.
  EmbreeShadows(const Relief& relief, Surface surface);
  ~EmbreeShadows();

  /// Sets a byte for every sample, 1 where it is lit. Rays go in packets of 16, 4 x 4 samples each.
  void Run(const relief::Light& sun, unsigned char* lit) const;

private:
  class Internals;
  std::unique_ptr<Internals> Internal;
};

}

#endif
