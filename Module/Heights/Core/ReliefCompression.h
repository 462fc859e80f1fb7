// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefCompression_h
#define ReliefCompression_h

#include "ParallelFor.h"
#include "UnitDepth.h"

#include <vector>

namespace relief
{

/// How depth becomes a relief; vtkReliefCompression says what they mean.
struct CompressionSettings
{
  enum Methods
  {
    GradientDomain = 0,
    TwoScale = 1,
    Linear = 2
  };
  int method = GradientDomain;
  double budget = 0.1;
  double detail = 0.6;
  double silhouettes = 0.5;
  double jump = 0.03;
};

/// The relief as a share of the depth's range: from 0, or a silhouette's step where there is
/// background, to the budget; NaN without data. Does not depend on the number of threads.
std::vector<double> CompressDepth(
  const UnitDepth& depth, const CompressionSettings& settings, const ParallelFor& parallelFor);

}

#endif
