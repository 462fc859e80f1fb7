// SPDX-License-Identifier: BSD-3-Clause
#include "ReliefCompression.h"

#include "DepthLinks.h"
#include "ScreenedPoisson.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

namespace relief
{

namespace
{
// Found as those of DepthLinks.cxx were.
constexpr double Attenuation = 0.7;   // alpha of Weyrich et al., in inverse mean slopes
constexpr double LargestStep = 0.1;   // of a silhouette, as a share of the budget
constexpr int SolvingRounds = 3;      // with steps, between which closed gaps are held faster
constexpr double WholeForm = 100.0;   // lengths are shares of the image's longer side
constexpr double BaseLength = 0.03;   // details of TwoScale are smaller
constexpr double LargestDetail = 0.5; // of TwoScale, as a share of the budget
constexpr double Tolerance = 1e-5;
constexpr int SearchSide = 400;
constexpr double SearchTolerance = 1e-4;
constexpr double SearchEnough = 5e-4;
constexpr int SearchRounds = 16;
constexpr int MostIterations = 200;

// How large forms and details share the budget.
struct Shares
{
  double whole = 1.0; // of the whole form's slopes that stay
  double fine = 0.0;  // of details' slopes, beside these
};

class Compressor
{
public:
  Compressor(
    const UnitDepth& depth, const CompressionSettings& settings, const ParallelFor& parallelFor)
    : Depth(depth)
    , Settings(settings)
    , Parallel(parallelFor)
    , Links(depth, settings.jump, parallelFor)
  {
  }

  // Heights by the two methods, but for a factor and a constant.
  std::vector<double> Integrate();
  std::vector<double> Separate();

  // From the lowest height to the budget.
  std::vector<double> Fit(const std::vector<double>& x, double lowest) const;

private:
  double RangeOf(const std::vector<double>& x) const { return this->Links.RangeOf(x).Length(); }
  double ScreenOf(double length) const;
  double Kept(double even) const;
  double FindLength(std::vector<double> b, const Shares& shares) const;
  double FindShare(const std::vector<double>& fixed, const std::vector<double>& added) const;
  void Bound(std::vector<double>& details, double share) const;
  std::vector<double> Raise(ScreenedPoisson& solver, const std::vector<double>& x) const;

  const UnitDepth& Depth;
  const CompressionSettings& Settings;
  const ParallelFor& Parallel;
  DepthLinks Links;
};

//------------------------------------------------------------------------------
// Samples are drawn to 0 so that forms are kept over a length.
double Compressor::ScreenOf(double length) const
{
  const double samples = length * std::max(this->Depth.columns, this->Depth.rows);
  return 1.0 / (samples * samples);
}

//------------------------------------------------------------------------------
// What the slopes of details are multiplied by where all slopes alike would be multiplied by
// `even`.
double Compressor::Kept(double even) const
{
  return std::pow(std::min(even, 1.0), 1.0 - this->Settings.detail);
}

//------------------------------------------------------------------------------
// The length over which forms are kept beside the whole's share, for the budget. A grid of few
// samples tells. It is found by regula falsi (the Illinois way), which is smooth in what it is
// given.
double Compressor::FindLength(std::vector<double> b, const Shares& shares) const
{
  LinkGrid grid = this->Links.GetGrid();
  while (std::max(grid.columns, grid.rows) > SearchSide)
  {
    LinkGrid coarse = grid.Halved();
    for (int j = 0; j < coarse.rows; ++j)
    {
      grid.Coarsen(coarse, j);
    }
    b = grid.Coarsen(coarse, b);
    grid = std::move(coarse);
  }
  ScreenedPoisson solver(grid, this->Parallel);
  const auto solve = [&](double logLength, std::vector<double>& x)
  {
    solver.SetScreen(this->ScreenOf(std::exp(logLength)));
    solver.Solve(b, x, SearchTolerance, MostIterations);
  };
  double high = std::log(WholeForm);
  std::vector<double> whole(grid.Size(), 0.0);
  solve(high, whole);
  std::vector<double> fine = whole;
  const auto excess = [&](double logLength)
  {
    solve(logLength, fine);
    DepthLinks::Range range;
    for (std::size_t k = 0; k < fine.size(); ++k)
    {
      if (grid.mass[k] > 0.0f)
      {
        range.Add(shares.whole * whole[k] + shares.fine * fine[k]);
      }
    }
    return range.Length() > 0.0 ? std::log(range.Length() / this->Settings.budget) : -1e3;
  };
  double excessHigh = excess(high);
  double low = std::log(0.5 / std::max(this->Depth.columns, this->Depth.rows));
  double excessLow = excess(low);
  double middle = excessHigh > 0.0 ? low : high;
  int side = 0;
  for (int n = 0; n < SearchRounds && excessHigh > 0.0 && excessLow < 0.0; ++n)
  {
    middle = (low * excessHigh - high * excessLow) / (excessHigh - excessLow);
    const double found = excess(middle);
    if (std::abs(found) < SearchEnough)
    {
      break;
    }
    const int last = side;
    side = found > 0.0 ? 1 : -1;
    (side > 0 ? high : low) = middle;
    (side > 0 ? excessHigh : excessLow) = found;
    // An end that stays twice loses weight.
    (side > 0 ? excessLow : excessHigh) *= side == last ? 0.5 : 1.0;
  }
  return std::exp(middle);
}

//------------------------------------------------------------------------------
// How much of `added` brings the range to the budget; 0 if nothing does.
double Compressor::FindShare(
  const std::vector<double>& fixed, const std::vector<double>& added) const
{
  const auto fallsShort = [&](double share)
  { return this->RangeOf(this->Links.Mix(fixed, 1.0, added, share)) < this->Settings.budget; };
  double high = 1.0;
  for (int n = 0; n < 40 && fallsShort(high); ++n)
  {
    high *= 2.0;
  }
  if (!fallsShort(0.0) || fallsShort(high))
  {
    return 0.0;
  }
  double low = 0.0;
  for (int n = 0; n < 50; ++n)
  {
    const double middle = 0.5 * (low + high);
    (fallsShort(middle) ? low : high) = middle;
  }
  return low;
}

//------------------------------------------------------------------------------
// Where surfaces need less than the budget, gaps get the rest.
std::vector<double> Compressor::Raise(ScreenedPoisson& solver, const std::vector<double>& x) const
{
  std::vector<double> steps(x.size(), 0.0);
  solver.Solve(this->Links.Mix(this->Links.RightSide(1.0), 1.0, this->Links.RightSide(0.0), -1.0),
    steps, Tolerance, MostIterations);
  const double range = this->RangeOf(steps);
  const double rest = std::max(this->Settings.budget - this->RangeOf(x), 0.0);
  return this->Links.Mix(x, 1.0, steps, range > 0.0 ? rest / range : 0.0);
}

//------------------------------------------------------------------------------
std::vector<double> Compressor::Integrate()
{
  // In full round nothing is attenuated.
  this->Links.SetTargets(Attenuation * (1.0 - this->Settings.budget));
  ScreenedPoisson solver(this->Links.GetGrid(), this->Parallel);
  std::vector<double> b = this->Links.RightSide(0.0);
  std::vector<double> whole(b.size(), 0.0);
  solver.SetScreen(this->ScreenOf(WholeForm));
  solver.Solve(b, whole, Tolerance, MostIterations);
  const double range = this->RangeOf(whole);
  const bool leveled = range > this->Settings.budget;
  Shares shares;
  double length = WholeForm;
  if (leveled)
  {
    const double even = this->Settings.budget / range;
    shares.whole = (1.0 - this->Settings.detail) * even;
    shares.fine = this->Kept(even) - shares.whole;
    length = this->FindLength(b, shares);
  }
  std::vector<double> fine = whole;
  std::vector<double> x = whole;
  double step = 0.0;
  for (int round = 0; round <= SolvingRounds; ++round)
  {
    solver.GetGrid() = this->Links.GetGrid();
    if (leveled)
    {
      solver.SetScreen(this->ScreenOf(length));
      solver.Solve(b, fine, Tolerance, MostIterations);
    }
    solver.SetScreen(this->ScreenOf(WholeForm));
    solver.Solve(b, whole, Tolerance, MostIterations);
    x = this->Links.Mix(whole, shares.whole, fine, shares.fine);
    // Slopes are those of forms and details together, and so are steps.
    const double together = shares.whole + shares.fine;
    if (round == 0)
    {
      step = LargestStep * this->Settings.silhouettes * this->RangeOf(x) / together;
    }
    else if (round == SolvingRounds || this->Links.TightenSteps(x, step * together) == 0)
    {
      break;
    }
    b = this->Links.RightSide(step);
  }
  return leveled ? x : this->Raise(solver, x);
}

//------------------------------------------------------------------------------
// Forms are smoothed but not across gaps, as in weighted least squares: Z. Farbman, R. Fattal,
// D. Lischinski, R. Szeliski, "Edge-preserving decompositions for multi-scale tone and detail
// manipulation", ACM Transactions on Graphics 27/3, 2008.
std::vector<double> Compressor::Separate()
{
  ScreenedPoisson solver(this->Links.SurfaceLinks(), this->Parallel);
  const double screen = this->ScreenOf(BaseLength);
  solver.SetScreen(screen);
  const std::vector<double>& depth = this->Links.GetDepth();
  std::vector<double> base = depth;
  solver.Solve(this->Links.Mix(depth, screen, depth, 0.0), base, Tolerance, MostIterations);
  std::vector<double> details = this->Links.Mix(depth, 1.0, base, -1.0);
  const double share = this->Kept(this->Settings.budget);
  if (share < 1.0)
  {
    this->Bound(details, share);
  }
  return this->Links.Mix(details, 1.0, base, this->FindShare(details, base));
}

//------------------------------------------------------------------------------
// Multiplies details by a share, or by less where they would need too much of the budget. What is
// more than twice as large as most is bent down first.
void Compressor::Bound(std::vector<double>& details, double share) const
{
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t k = 0; k < details.size(); ++k)
  {
    sum += details[k] * details[k];
    count += this->Links.Has(k) ? 1.0 : 0.0;
  }
  const double bend = 2.0 * std::sqrt(sum / count);
  if (!(bend > 0.0))
  {
    return;
  }
  for (double& detail : details)
  {
    detail = bend * std::tanh(detail / bend);
  }
  const double range = this->RangeOf(details);
  const double most = LargestDetail * this->Settings.budget;
  share = share * range > most ? most / range : share;
  for (double& detail : details)
  {
    detail *= share;
  }
}

//------------------------------------------------------------------------------
std::vector<double> Compressor::Fit(const std::vector<double>& x, double lowest) const
{
  const DepthLinks::Range range = this->Links.RangeOf(x);
  const double length = range.Length();
  std::vector<double> result(this->Depth.values.size(), std::numeric_limits<double>::quiet_NaN());
  this->Links.ForRows(
    [&](int j)
    {
      for (int i = 0; i < this->Depth.columns; ++i)
      {
        const std::size_t k = this->Links.GetGrid().At(i, j);
        if (this->Links.Has(k))
        {
          // Islands of one height each may have become alike: they are all on top.
          const double share = length > 0.0 ? (x[k] - range.least) / length : 1.0;
          result[this->Depth.At(i, j)] = lowest * (1.0 - share) + this->Settings.budget * share;
        }
      }
    });
  return result;
}
}

//------------------------------------------------------------------------------
std::vector<double> CompressDepth(
  const UnitDepth& depth, const CompressionSettings& settings, const ParallelFor& parallelFor)
{
  if (settings.method != CompressionSettings::Linear && depth.halfRange > 0.0)
  {
    Compressor compressor(depth, settings, parallelFor);
    const bool integrate = settings.method == CompressionSettings::GradientDomain;
    const double lowest =
      integrate && depth.hasBackground ? LargestStep * settings.silhouettes * settings.budget : 0.0;
    return compressor.Fit(integrate ? compressor.Integrate() : compressor.Separate(), lowest);
  }
  std::vector<double> result = depth.values;
  for (double& value : result)
  {
    value *= settings.budget;
  }
  return result;
}

}
