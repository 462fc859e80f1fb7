// SPDX-License-Identifier: BSD-3-Clause
#ifndef Growth_h
#define Growth_h

#include <string>
#include <vector>

namespace bench
{

/// The cost of a sample in fields of growing size: terrain that goes on, with the same relief for
/// each sample, under a sun of one altitude.
struct GrowthPoint
{
  std::string integrator;
  int size = 0;             ///< samples along a side
  double nanoseconds = 0.0; ///< a sample
};

constexpr double GrowthAltitude = 10.0;

/// Sizes double from `first` to `last`.
std::vector<GrowthPoint> MeasureGrowth(int first, int last, int repetitions);

/// p of cost ~ size^p, fitted to the sizes from `first` on.
double GrowthExponent(
  const std::vector<GrowthPoint>& points, const std::string& integrator, int first);

}

#endif
