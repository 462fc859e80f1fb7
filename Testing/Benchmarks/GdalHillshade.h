// SPDX-License-Identifier: BSD-3-Clause
#ifndef GdalHillshade_h
#define GdalHillshade_h

#include "BenchmarkTerrain.h"

#include <memory>

namespace bench
{

/// gdaldem hillshade (Horn's slopes, no shadows) from memory to memory.
class GdalHillshade
{
public:
  explicit GdalHillshade(const Relief& relief);
  ~GdalHillshade();

  void Run(double azimuth, double altitude) const;

private:
  class Internals;
  std::unique_ptr<Internals> Internal;
};

}

#endif
