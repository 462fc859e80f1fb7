// SPDX-License-Identifier: BSD-3-Clause
#ifndef NormalIntegration_h
#define NormalIntegration_h

#include "ConjugateGradients.h"
#include "HeightEdges.h"
#include "NormalMap.h"

#include <vector>

namespace relief
{

/// What the heights of normals are made with. Heights of an orthographic view are in units of the
/// shorter spacing here, those of a perspective one are logarithms of depths.
struct NormalIntegration
{
  NormalCamera camera;
  double spacing[2] = { 1.0, 1.0 }; ///< the shorter one is 1
  SolverLimits limits;
};

/// The rise to the next column and the next row that a normal asks for.
struct NormalRise
{
  double x;
  double y;
};
NormalRise FindRise(const NormalMap& map, const NormalIntegration& integration, int i, int j);

/// The edges of least squares: the rise between two neighbours is the mean of what both ask for, so
/// that planes and quadratic surfaces are exact, to the border. (B. K. P. Horn and M. J. Brooks,
/// "The variational approach to shape from shading", CVGIP 33, 1986; T. Simchony, R. Chellappa and
/// M. Shao, "Direct analytical methods for solving Poisson equations in computer vision problems",
/// PAMI 12, 1990, with free boundaries.) An edge weighs the harmonic mean of both samples' weights,
/// as the variance of that mean asks for.
HeightEdges MakeEdges(
  const NormalMap& map, const NormalIntegration& integration, const ParallelFor& parallelFor);

/// Heights by least squares. Whole rectangles without weights take two cosine transforms, which
/// are no iterations, other domains conjugate gradients.
std::vector<double> IntegrateNormals(const NormalMap& map, const NormalIntegration& integration,
  const ParallelFor& parallelFor, SolverEnd& end);

/// Heights that fit edges, from those given.
SolverEnd SolveEdges(const HeightEdges& edges, const SolverLimits& limits,
  std::vector<double>& heights, const ParallelFor& parallelFor);

/// Numbers the parts of a domain whose samples are connected side by side, from 0; -1 where the map
/// is not used.
std::vector<int> FindParts(const NormalMap& map, int& count);

/// Takes from the values of each part their mean.
void RemoveMeans(const std::vector<int>& parts, int count, std::vector<double>& values);

/// Which level heights of a part that is connected have.
enum class HeightDatum
{
  Mean,
  Minimum
};

/// Moves each part so that its mean or its minimum is 0. Heights where the map is not used become
/// NaN. Returns the number of parts.
int LevelHeights(const NormalMap& map, HeightDatum datum, std::vector<double>& heights);

}

#endif
