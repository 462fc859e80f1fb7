// SPDX-License-Identifier: BSD-3-Clause
#include "NormalIntegration.h"

#include "Angles.h"
#include "CosineTransform.h"
#include "GridMultigrid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relief
{
namespace
{
// A domain without weights that fills this much of its rectangle, with a boundary of at most so
// many times the side of a square of its size, has the rectangle's own inverse as a good
// preconditioner: it sees through holes, which is wrong near their boundaries only.
constexpr double LeastFilled = 0.5;
constexpr double LongestBoundary = 12.0;

// Above, its iterations are too many after all.
constexpr int RectangleIterations = 40;

bool FillsRectangle(const NormalMap& map)
{
  std::size_t filled = 0;
  std::size_t boundary = 0;
  for (int j = 0; j < map.rows; ++j)
  {
    for (int i = 0; i < map.columns; ++i)
    {
      const std::size_t at = map.At(i, j);
      filled += map.used[at];
      boundary += i + 1 < map.columns && map.used[at] != map.used[at + 1];
      boundary += j + 1 < map.rows && map.used[at] != map.used[at + map.columns];
    }
  }
  const auto size = static_cast<double>(filled);
  return size >= LeastFilled * static_cast<double>(map.GetSize()) &&
    static_cast<double>(boundary) <= LongestBoundary * std::sqrt(size);
}

// The inverse of the Laplacian with free boundaries of a whole rectangle; the mean is left at 0.
class RectangleInverse
{
public:
  RectangleInverse(int columns, int rows, double weightX, double weightY)
    : Transform(columns, rows)
    , Columns(columns)
    , Rows(rows)
    , AlongX(Eigenvalues(columns, weightX))
    , AlongY(Eigenvalues(rows, weightY))
  {
  }

  void Apply(std::vector<double>& values, const ParallelFor& parallelFor) const
  {
    this->Transform.Forward(values, parallelFor);
    parallelFor(this->Rows,
      [&](int begin, int end)
      {
        for (int j = begin; j < end; ++j)
        {
          double* row = values.data() + static_cast<std::size_t>(j) * this->Columns;
          for (int i = 0; i < this->Columns; ++i)
          {
            row[i] = i + j > 0 ? row[i] / (this->AlongX[i] + this->AlongY[j]) : 0.0;
          }
        }
      });
    this->Transform.Backward(values, parallelFor);
  }

private:
  static std::vector<double> Eigenvalues(int count, double weight)
  {
    std::vector<double> values(static_cast<std::size_t>(count));
    for (int k = 0; k < count; ++k)
    {
      const double sine = std::sin(0.5 * Pi * k / count);
      values[k] = 4.0 * weight * sine * sine;
    }
    return values;
  }

  CosineTransform Transform;
  int Columns;
  int Rows;
  std::vector<double> AlongX;
  std::vector<double> AlongY;
};

// How much edges along each axis weigh: rises are as uncertain as slopes are, times the length.
void EdgeWeights(const double spacing[2], double weights[2])
{
  weights[0] = 1.0 / (spacing[0] * spacing[0]);
  weights[1] = 1.0 / (spacing[1] * spacing[1]);
}

double HarmonicMean(double a, double b)
{
  return 2.0 * a / (a + b) * b;
}
}

//------------------------------------------------------------------------------
NormalRise FindRise(const NormalMap& map, const NormalIntegration& integration, int i, int j)
{
  const std::size_t at = map.At(i, j);
  const double facing = FacingNormal(map, integration.camera, i, j);
  if (integration.camera.perspective)
  {
    // Of n (d (a, b, -1))' = 0 along a column or a row.
    return { map.x[at] / facing / integration.camera.focalX,
      map.y[at] / facing / integration.camera.focalY };
  }
  return { -map.x[at] / facing * integration.spacing[0],
    -map.y[at] / facing * integration.spacing[1] };
}

//------------------------------------------------------------------------------
HeightEdges MakeEdges(
  const NormalMap& map, const NormalIntegration& integration, const ParallelFor& parallelFor)
{
  HeightEdges edges;
  edges.Resize(map.columns, map.rows);
  double weights[2];
  EdgeWeights(integration.spacing, weights);
  const bool weighted = !map.weight.empty();
  parallelFor(map.rows,
    [&](int begin, int end)
    {
      for (int j = begin; j < end; ++j)
      {
        for (int i = 0; i < map.columns; ++i)
        {
          const std::size_t at = map.At(i, j);
          if (!map.used[at])
          {
            continue;
          }
          const NormalRise here = FindRise(map, integration, i, j);
          if (i + 1 < map.columns && map.used[at + 1])
          {
            edges.riseX[at] = 0.5 * (here.x + FindRise(map, integration, i + 1, j).x);
            edges.weightX[at] =
              weights[0] * (weighted ? HarmonicMean(map.weight[at], map.weight[at + 1]) : 1.0);
          }
          const std::size_t above = at + map.columns;
          if (j + 1 < map.rows && map.used[above])
          {
            edges.riseY[at] = 0.5 * (here.y + FindRise(map, integration, i, j + 1).y);
            edges.weightY[at] =
              weights[1] * (weighted ? HarmonicMean(map.weight[at], map.weight[above]) : 1.0);
          }
        }
      }
    });
  return edges;
}

//------------------------------------------------------------------------------
std::vector<double> IntegrateNormals(const NormalMap& map, const NormalIntegration& integration,
  const ParallelFor& parallelFor, SolverEnd& end)
{
  const HeightEdges edges = MakeEdges(map, integration, parallelFor);
  std::vector<double> heights(map.GetSize());
  if (!map.weight.empty() || !FillsRectangle(map))
  {
    end = SolveEdges(edges, integration.limits, heights, parallelFor);
    return heights;
  }
  double weights[2];
  EdgeWeights(integration.spacing, weights);
  const RectangleInverse inverse(map.columns, map.rows, weights[0], weights[1]);
  if (std::find(map.used.begin(), map.used.end(), 0) == map.used.end())
  {
    edges.FindRightSide(heights, parallelFor);
    inverse.Apply(heights, parallelFor);
    end = SolverEnd();
    end.converged = true;
    return heights;
  }
  // The level of each part is free: what rounding leaves of it in a residual would grow.
  int count = 0;
  const std::vector<int> parts = FindParts(map, count);
  const auto precondition = [&](const std::vector<double>& residual, std::vector<double>& result)
  {
    result = residual;
    RemoveMeans(parts, count, result);
    inverse.Apply(result, parallelFor);
    for (std::size_t at = 0; at < result.size(); ++at)
    {
      result[at] = map.used[at] ? result[at] : 0.0;
    }
  };
  SolverLimits limits = integration.limits;
  limits.maximumIterations = std::min(RectangleIterations, limits.maximumIterations);
  end = SolveByConjugateGradients(edges, precondition, limits, heights, parallelFor);
  if (!end.converged && !end.stopped)
  {
    const int before = end.iterations;
    limits.maximumIterations = integration.limits.maximumIterations - before;
    end = SolveEdges(edges, limits, heights, parallelFor);
    end.iterations += before;
  }
  return heights;
}

//------------------------------------------------------------------------------
SolverEnd SolveEdges(const HeightEdges& edges, const SolverLimits& limits,
  std::vector<double>& heights, const ParallelFor& parallelFor)
{
  GridMultigrid multigrid(edges, parallelFor);
  const auto precondition = [&](
                              const std::vector<double>& residual, std::vector<double>& correction)
  { multigrid.Solve(residual, correction); };
  return SolveByConjugateGradients(edges, precondition, limits, heights, parallelFor);
}

//------------------------------------------------------------------------------
std::vector<int> FindParts(const NormalMap& map, int& count)
{
  std::vector<int> parts(map.GetSize(), -1);
  std::vector<std::size_t> reached;
  const auto columns = static_cast<std::size_t>(map.columns);
  count = 0;
  for (std::size_t start = 0; start < map.GetSize(); ++start)
  {
    if (!map.used[start] || parts[start] >= 0)
    {
      continue;
    }
    const auto reach = [&](bool inside, std::size_t other)
    {
      if (inside && map.used[other] && parts[other] < 0)
      {
        parts[other] = count;
        reached.push_back(other);
      }
    };
    reach(true, start);
    while (!reached.empty())
    {
      const std::size_t at = reached.back();
      reached.pop_back();
      const std::size_t i = at % columns;
      reach(i + 1 < columns, at + 1);
      reach(i > 0, at - 1);
      reach(at + columns < map.GetSize(), at + columns);
      reach(at >= columns, at - columns);
    }
    ++count;
  }
  return parts;
}

//------------------------------------------------------------------------------
void RemoveMeans(const std::vector<int>& parts, int count, std::vector<double>& values)
{
  std::vector<double> sums(static_cast<std::size_t>(count));
  std::vector<std::size_t> sizes(static_cast<std::size_t>(count));
  for (std::size_t at = 0; at < values.size(); ++at)
  {
    if (parts[at] >= 0)
    {
      sums[parts[at]] += values[at];
      ++sizes[parts[at]];
    }
  }
  for (std::size_t at = 0; at < values.size(); ++at)
  {
    if (parts[at] >= 0)
    {
      values[at] -= sums[parts[at]] / static_cast<double>(sizes[parts[at]]);
    }
  }
}

//------------------------------------------------------------------------------
int LevelHeights(const NormalMap& map, HeightDatum datum, std::vector<double>& heights)
{
  int count = 0;
  const std::vector<int> parts = FindParts(map, count);
  // Twice, as the first mean of heights far above 0 is rounded.
  RemoveMeans(parts, count, heights);
  RemoveMeans(parts, count, heights);
  std::vector<double> least(static_cast<std::size_t>(count), std::numeric_limits<double>::max());
  for (std::size_t at = 0; at < heights.size(); ++at)
  {
    if (parts[at] < 0)
    {
      heights[at] = std::numeric_limits<double>::quiet_NaN();
    }
    else
    {
      least[parts[at]] = std::min(least[parts[at]], heights[at]);
    }
  }
  for (std::size_t at = 0; at < heights.size() && datum == HeightDatum::Minimum; ++at)
  {
    heights[at] -= parts[at] < 0 ? 0.0 : least[parts[at]];
  }
  return count;
}

}
