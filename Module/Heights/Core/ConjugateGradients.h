// SPDX-License-Identifier: BSD-3-Clause
#ifndef ConjugateGradients_h
#define ConjugateGradients_h

#include "HeightEdges.h"

#include <functional>
#include <vector>

namespace relief
{

/// Solves the normal equations roughly: from a residual, a correction.
using Preconditioner =
  std::function<void(const std::vector<double>& residual, std::vector<double>& correction)>;

/// Told the share of the work that is done, from 0 to 1 and rising; false ends the work. May be
/// empty.
using Proceed = std::function<bool(double share)>;

struct SolverLimits
{
  double tolerance = 1e-6; ///< of the heights, relative
  int maximumIterations = 500;
  Proceed proceed;
};

struct SolverEnd
{
  int iterations = 0;
  bool converged = false;
  bool stopped = false; ///< by Proceed
};

/// Heights that fit edges best, by conjugate gradients from the heights that are given. They end
/// where the error, as the preconditioner sees it, is at most the tolerance of the heights, both in
/// the norm of the equations. The preconditioner may differ a little from call to call. (Y. Notay,
/// "Flexible conjugate gradients", SIAM J. Sci. Comput. 22, 2000.) What edges do not determine, as
/// the level of each part that is connected, comes out as anything.
SolverEnd SolveByConjugateGradients(const HeightEdges& edges, const Preconditioner& precondition,
  const SolverLimits& limits, std::vector<double>& heights, const ParallelFor& parallelFor);

}

#endif
