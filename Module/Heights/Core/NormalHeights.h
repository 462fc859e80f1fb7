// SPDX-License-Identifier: BSD-3-Clause
#ifndef NormalHeights_h
#define NormalHeights_h

#include "BilateralIntegration.h"
#include "NormalIntegration.h"
#include "NormalMap.h"

#include <string>
#include <vector>

namespace relief
{

/// How heights are found.
enum class NormalMethod
{
  LeastSquares,
  DiscontinuityPreserving,
  PathSums
};

/// What is wanted of normals.
struct NormalRequest
{
  NormalIntegration integration;
  GreenAxis green = GreenAxis::Automatic;
  NormalMethod method = NormalMethod::LeastSquares;
  BilateralWeights bilateral; ///< of DiscontinuityPreserving
  HeightDatum datum = HeightDatum::Mean;
};

/// The heights of normals, NaN where there are none.
struct NormalHeights
{
  std::vector<double> heights; ///< in units of the shorter spacing, or logarithms of depths
  GreenAxis green = GreenAxis::Up;
  bool greenKnown = true; ///< false if green was to be found and cannot be told: it is up
  int parts = 0;          ///< that are connected
  SolverEnd end;          ///< without heights if it was stopped
};

/// The spacing of an integration, of which the shorter one is 1; returns what 1 stands for. The
/// signs do not matter.
double ScaleSpacing(const double spacing[2], double scaled[2]);

/// Finds the heights. Returns an empty text, or why there are none: numbers beyond what any surface
/// with such normals has, as the steepest that is of use rises by 1000 times the distance of two
/// samples.
std::string FindNormalHeights(NormalMap map, const NormalRequest& request,
  const ParallelFor& parallelFor, NormalHeights& result);

}

#endif
