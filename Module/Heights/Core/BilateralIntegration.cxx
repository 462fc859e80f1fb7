// SPDX-License-Identifier: BSD-3-Clause
#include "BilateralIntegration.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relief
{
namespace
{
// The weights sharpen over so many steps: the first heights are those of least squares, whose
// smeared cliffs should not decide yet where the surface jumps.
constexpr int GraduatedSteps = 5;

// How exact each step is. Rougher ones leave the result to chance; finer ones change nothing, as
// the weights have not settled yet.
constexpr double InnerTolerance = 1e-4;
constexpr int InnerIterations = 100;

// What turns a rise into the unit that sides are compared in: the rise over the spacing times the
// normal's cosine. That of a smooth surface is below 1.
struct Factor
{
  double x;
  double y;
};

Factor FindFactor(const NormalMap& map, const NormalIntegration& integration, int i, int j)
{
  const double facing = FacingNormal(map, integration.camera, i, j);
  return integration.camera.perspective
    ? Factor{ facing * integration.camera.focalX, facing * integration.camera.focalY }
    : Factor{ facing / integration.spacing[0], facing / integration.spacing[1] };
}

// The weight of the side behind which `after` lies; a side without a neighbour counts as level.
double WeightOf(double after, double before, double smoothness)
{
  return 1.0 / (1.0 + std::exp(-smoothness * (before * before - after * after)));
}

// What a sample asks of the edges to its four sides.
struct Sides
{
  double right;
  double left;
  double up;
  double down;
  NormalRise rise;
};

class Reweighting
{
public:
  Reweighting(const NormalMap& map, const NormalIntegration& integration)
    : Map(map)
    , Integration(integration)
  {
    this->Edges.Resize(map.columns, map.rows);
    this->Constants.resize(static_cast<std::size_t>(map.rows));
    this->Energies.resize(static_cast<std::size_t>(map.rows));
  }

  // Weighs the edges by the heights.
  void Weigh(const std::vector<double>& heights, double smoothness, const ParallelFor& parallelFor);

  // Of the heights, with the weights as they are.
  double FindEnergy(const std::vector<double>& heights, const ParallelFor& parallelFor);

  const HeightEdges& GetEdges() const { return this->Edges; }

private:
  bool IsUsed(int i, int j) const
  {
    return i >= 0 && j >= 0 && i < this->Map.columns && j < this->Map.rows &&
      this->Map.used[this->Map.At(i, j)];
  }

  Sides WeighSides(const std::vector<double>& heights, double smoothness, int i, int j) const;

  void WeighRow(
    const std::vector<double>& heights, double smoothness, int j, std::vector<Sides>& sides) const;

  const NormalMap& Map;
  const NormalIntegration& Integration;
  HeightEdges Edges;
  std::vector<double> Constants; // by row: what is left of the energy at the best rise of each edge
  std::vector<double> Energies;
};

//------------------------------------------------------------------------------
Sides Reweighting::WeighSides(
  const std::vector<double>& heights, double smoothness, int i, int j) const
{
  const std::size_t at = this->Map.At(i, j);
  const Factor factor = FindFactor(this->Map, this->Integration, i, j);
  const double here = heights[at];
  const double right = this->IsUsed(i + 1, j) ? factor.x * (heights[at + 1] - here) : 0.0;
  const double left = this->IsUsed(i - 1, j) ? factor.x * (here - heights[at - 1]) : 0.0;
  const std::size_t columns = static_cast<std::size_t>(this->Map.columns);
  const double up = this->IsUsed(i, j + 1) ? factor.y * (heights[at + columns] - here) : 0.0;
  const double down = this->IsUsed(i, j - 1) ? factor.y * (here - heights[at - columns]) : 0.0;
  const double own = this->Map.weight.empty() ? 1.0 : this->Map.weight[at];
  Sides sides;
  const double toRight = WeightOf(right, left, smoothness);
  const double toUp = WeightOf(up, down, smoothness);
  sides.right = own * factor.x * factor.x * toRight;
  sides.left = own * factor.x * factor.x * (1.0 - toRight);
  sides.up = own * factor.y * factor.y * toUp;
  sides.down = own * factor.y * factor.y * (1.0 - toUp);
  sides.rise = FindRise(this->Map, this->Integration, i, j);
  return sides;
}

//------------------------------------------------------------------------------
void Reweighting::WeighRow(
  const std::vector<double>& heights, double smoothness, int j, std::vector<Sides>& sides) const
{
  for (int i = 0; i < this->Map.columns && j < this->Map.rows; ++i)
  {
    if (this->IsUsed(i, j))
    {
      sides[i] = this->WeighSides(heights, smoothness, i, j);
    }
  }
}

//------------------------------------------------------------------------------
void Reweighting::Weigh(
  const std::vector<double>& heights, double smoothness, const ParallelFor& parallelFor)
{
  HeightEdges& edges = this->Edges;
  // Both samples of an edge pull at it: the sum of two squares is one about their weighted mean,
  // and a constant.
  const auto join = [](double a, double riseA, double b, double riseB, double& weight, double& rise)
  {
    weight = a + b;
    rise = weight > 0.0 ? (a * riseA + b * riseB) / weight : 0.0;
    return weight > 0.0 ? a / weight * b * (riseA - riseB) * (riseA - riseB) : 0.0;
  };
  parallelFor(edges.rows,
    [&](int begin, int end)
    {
      std::vector<Sides> here(static_cast<std::size_t>(edges.columns));
      std::vector<Sides> above(static_cast<std::size_t>(edges.columns));
      this->WeighRow(heights, smoothness, begin, above);
      for (int j = begin; j < end; ++j)
      {
        std::swap(here, above);
        this->WeighRow(heights, smoothness, j + 1, above);
        double constant = 0.0;
        for (int i = 0; i < edges.columns; ++i)
        {
          if (!this->IsUsed(i, j))
          {
            continue;
          }
          const std::size_t at = edges.At(i, j);
          const Sides& own = here[i];
          if (this->IsUsed(i + 1, j))
          {
            constant += join(own.right, own.rise.x, here[i + 1].left, here[i + 1].rise.x,
              edges.weightX[at], edges.riseX[at]);
          }
          if (this->IsUsed(i, j + 1))
          {
            constant += join(own.up, own.rise.y, above[i].down, above[i].rise.y, edges.weightY[at],
              edges.riseY[at]);
          }
        }
        this->Constants[j] = constant;
      }
    });
}

//------------------------------------------------------------------------------
double Reweighting::FindEnergy(const std::vector<double>& heights, const ParallelFor& parallelFor)
{
  const HeightEdges& edges = this->Edges;
  parallelFor(edges.rows,
    [&](int begin, int end)
    {
      for (int j = begin; j < end; ++j)
      {
        double sum = this->Constants[j];
        for (int i = 0; i < edges.columns; ++i)
        {
          const std::size_t at = edges.At(i, j);
          if (edges.weightX[at] > 0.0)
          {
            const double error = heights[at + 1] - heights[at] - edges.riseX[at];
            sum += edges.weightX[at] * error * error;
          }
          if (edges.weightY[at] > 0.0)
          {
            const double error = heights[at + edges.columns] - heights[at] - edges.riseY[at];
            sum += edges.weightY[at] * error * error;
          }
        }
        this->Energies[j] = sum;
      }
    });
  double energy = 0.0;
  for (const double row : this->Energies)
  {
    energy += row;
  }
  return energy;
}
}

//------------------------------------------------------------------------------
std::vector<double> IntegrateBilaterally(const NormalMap& map, const NormalIntegration& integration,
  const BilateralWeights& weights, const ParallelFor& parallelFor, SolverEnd& end)
{
  std::vector<double> heights(map.GetSize());
  Reweighting reweighting(map, integration);
  double before = -1.0;
  end = SolverEnd();
  SolverLimits limits;
  limits.tolerance = InnerTolerance;
  limits.maximumIterations = InnerIterations;
  while (end.iterations < weights.maximumIterations && !end.converged)
  {
    const double done = static_cast<double>(end.iterations) / weights.maximumIterations;
    end.stopped = integration.limits.proceed && !integration.limits.proceed(done);
    if (end.stopped)
    {
      return heights;
    }
    ++end.iterations;
    const double share = std::min(1.0, static_cast<double>(end.iterations) / GraduatedSteps);
    reweighting.Weigh(heights, weights.smoothness * share, parallelFor);
    SolveEdges(reweighting.GetEdges(), limits, heights, parallelFor);
    const double energy = reweighting.FindEnergy(heights, parallelFor);
    const bool settled = before >= 0.0 && std::abs(before - energy) <= weights.tolerance * before;
    end.converged = energy <= 0.0 || (end.iterations > GraduatedSteps && settled);
    before = energy;
  }
  return heights;
}

}
