// SPDX-License-Identifier: BSD-3-Clause
#include "ConjugateGradients.h"

#include <algorithm>
#include <cmath>

namespace relief
{
namespace
{
// a[k] = factorA * a[k] + factorB * b[k]
void Combine(std::vector<double>& a, double factorA, const std::vector<double>& b, double factorB,
  int columns, const ParallelFor& parallelFor)
{
  parallelFor(static_cast<int>(a.size() / columns),
    [&](int begin, int end)
    {
      const std::size_t last = static_cast<std::size_t>(end) * columns;
      for (std::size_t at = static_cast<std::size_t>(begin) * columns; at < last; ++at)
      {
        a[at] = factorA * a[at] + factorB * b[at];
      }
    });
}
}

//------------------------------------------------------------------------------
SolverEnd SolveByConjugateGradients(const HeightEdges& edges, const Preconditioner& precondition,
  const SolverLimits& limits, std::vector<double>& heights, const ParallelFor& parallelFor)
{
  const int columns = edges.columns;
  const auto sum = [&](const std::vector<double>& a, const std::vector<double>& b)
  { return SumProducts(a, b, columns, parallelFor); };
  std::vector<double> right;
  std::vector<double> residual;
  std::vector<double> correction(edges.GetSize());
  std::vector<double> image;
  edges.FindRightSide(right, parallelFor);
  edges.Apply(heights, residual, parallelFor);
  Combine(residual, -1.0, right, 1.0, columns, parallelFor);
  precondition(residual, correction);
  std::vector<double> direction = correction;
  double error = sum(residual, correction);
  const double first = error;
  double done = 0.0;
  SolverEnd end;
  for (;; ++end.iterations)
  {
    // The product of heights and right side is their square in the norm of the equations.
    const double size = std::max(first, sum(heights, right));
    // False for NaN. Next to 0 rounding decides on the sign.
    const double goal = limits.tolerance * limits.tolerance * size;
    if (std::abs(error) <= goal)
    {
      end.converged = true;
      return end;
    }
    // Errors fall by about the same factor each time.
    const double share = std::log(first / error) / std::log(first / goal);
    done = share > done && share <= 1.0 ? share : done;
    if (limits.proceed && !limits.proceed(done))
    {
      end.stopped = true;
      return end;
    }
    edges.Apply(direction, image, parallelFor);
    const double curvature = sum(direction, image);
    const double step = sum(direction, residual) / curvature;
    if (end.iterations >= limits.maximumIterations || !(curvature > 0.0) || !std::isfinite(step))
    {
      return end;
    }
    Combine(heights, 1.0, direction, step, columns, parallelFor);
    Combine(residual, 1.0, image, -step, columns, parallelFor);
    precondition(residual, correction);
    error = sum(residual, correction);
    const double conjugate = -sum(correction, image) / curvature;
    Combine(direction, conjugate, correction, 1.0, columns, parallelFor);
  }
}

}
