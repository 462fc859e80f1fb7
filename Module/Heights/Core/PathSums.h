// SPDX-License-Identifier: BSD-3-Clause
#ifndef PathSums_h
#define PathSums_h

#include "NormalIntegration.h"

namespace relief
{

/// Heights by sums along one path to each sample, for comparison: from the lowest, leftmost sample
/// up the first column, then along each row, with the mean rise of both neighbours at each step.
/// Errors of single normals add up along a row and differ from row to row, as streaks. Where data
/// are missing, runs of a row that touch one already reached go on from the first such touch, in
/// the order in which they are reached; each part that is connected begins at its lowest sample,
/// the leftmost of these.
std::vector<double> SumPaths(
  const NormalMap& map, const NormalIntegration& integration, const ParallelFor& parallelFor);

}

#endif
