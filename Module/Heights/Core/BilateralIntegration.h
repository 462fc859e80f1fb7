// SPDX-License-Identifier: BSD-3-Clause
#ifndef BilateralIntegration_h
#define BilateralIntegration_h

#include "NormalIntegration.h"

namespace relief
{

/// How a discontinuity is told from a slope.
struct BilateralWeights
{
  double smoothness = 2.0;     ///< k: how sharply the better side is preferred, above 0
  double tolerance = 1e-4;     ///< the relative change of the energy to end at
  int maximumIterations = 150; ///< how often the weights are found anew
};

/// Heights that may jump: on each axis a sample follows its normal to the side that fits on better,
/// which is the one the surface is continuous at. The weight of the right side is
/// 1 / (1 + exp(-k (l^2 - r^2))), where l and r are the differences to the left and right in units
/// of the spacing times the cosine of the normal, that of the left side the rest to 1; the same up
/// and down. Weights and heights are found in turn, by least squares; of the integration's limits
/// only Proceed counts. (X. Cao, H. Santo, B. Shi, F. Okura, Y. Matsushita, "Bilateral normal
/// integration", ECCV 2022, for both views.)
std::vector<double> IntegrateBilaterally(const NormalMap& map, const NormalIntegration& integration,
  const BilateralWeights& weights, const ParallelFor& parallelFor, SolverEnd& end);

}

#endif
