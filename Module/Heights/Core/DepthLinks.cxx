// SPDX-License-Identifier: BSD-3-Clause
#include "DepthLinks.h"

#include <algorithm>
#include <cmath>

namespace relief
{

namespace
{
// Found by looking at reliefs, and by how alike their shading is:
// Testing/Heights/TestReliefCompressionSimilarity.cxx.
constexpr float WeakLink = 0.3f;     // across a gap and to the background, as against a surface's
constexpr float Tightening = 4.0f;   // of links across gaps that have closed
constexpr double FlatSlope = 0.1;    // in mean slopes: what is gentler stays flat,
constexpr double FlatWeight = 100.0; // as it is held faster
constexpr double MostAspect = 1000.0;
}

//------------------------------------------------------------------------------
DepthLinks::DepthLinks(const UnitDepth& depth, double jump, const ParallelFor& parallelFor)
  : Parallel(parallelFor)
  , Grid(depth.columns, depth.rows)
  , Z(this->Grid.Size(), 0.0)
{
  // Cells are as large as squares of length 1.
  const double aspect =
    depth.aspect > 0.0 ? std::clamp(depth.aspect, 1.0 / MostAspect, MostAspect) : 1.0;
  const std::vector<signed char> jumps(this->Grid.Size(), 0);
  const std::vector<float> targets(this->Grid.Size(), 0.0f);
  this->X = { 1, 1.0 / std::sqrt(aspect), static_cast<float>(aspect), jumps, targets };
  this->Y = { this->Grid.Pitch(), std::sqrt(aspect), static_cast<float>(1.0 / aspect), jumps,
    targets };
  this->ForRows(
    [&](int j)
    {
      for (int i = 0; i < depth.columns; ++i)
      {
        const double value = depth.values[depth.At(i, j)];
        const std::size_t k = this->Grid.At(i, j);
        this->Grid.mass[k] = std::isnan(value) ? 0.0f : 1.0f;
        this->Z[k] = std::isnan(value) ? 0.0 : value;
      }
    });
  this->ForRows(
    [&](int j)
    {
      for (std::size_t k = this->Grid.At(0, j); k < this->Grid.At(this->Grid.columns, j); ++k)
      {
        for (Axis* axis : { &this->X, &this->Y })
        {
          const signed char sign = this->Difference(k, *axis) > 0.0 ? 1 : -1;
          axis->jumps[k] = this->IsJump(k, *axis, jump) ? sign : 0;
        }
      }
    });
}

//------------------------------------------------------------------------------
void DepthLinks::ForRows(const std::function<void(int)>& body) const
{
  this->Parallel(this->Grid.rows,
    [&body](int begin, int end)
    {
      for (int j = begin; j < end; ++j)
      {
        body(j);
      }
    });
}

//------------------------------------------------------------------------------
// From a sample to the next one along an axis; 0 where either has no data.
double DepthLinks::Difference(std::size_t k, const Axis& axis) const
{
  return this->IsLink(k, axis) ? this->Z[k + axis.along] - this->Z[k] : 0.0;
}

//------------------------------------------------------------------------------
// Steep flanks go on: to one side of a jump at least there is nothing like it for two links. As a
// jump that is smoothed takes two links, one is not enough.
bool DepthLinks::IsJump(std::size_t k, const Axis& axis, double jump) const
{
  constexpr double Unknown = std::numeric_limits<double>::infinity();
  const double here = std::abs(this->Difference(k, axis));
  if (!(here > jump))
  {
    return false;
  }
  // The steepest of the next two links to a side; nothing is known where data end.
  const auto side = [&](std::ptrdiff_t way)
  {
    double largest = Unknown;
    std::size_t at = k + way;
    for (int n = 0; n < 2 && this->IsLink(at, axis); ++n, at += way)
    {
      largest = std::max(n == 0 ? 0.0 : largest, std::abs(this->Difference(at, axis)));
    }
    return largest;
  };
  const double gentler = std::min(side(axis.along), side(-axis.along));
  return gentler == Unknown || here > 2.0 * gentler;
}

//------------------------------------------------------------------------------
double DepthLinks::Slope(std::size_t k, const Axis& axis) const
{
  return axis.jumps[k] != 0 ? 0.0 : this->Difference(k, axis) / axis.length;
}

//------------------------------------------------------------------------------
// The mean of the slopes across a link, over the four of them that touch it.
double DepthLinks::CrossSlope(std::size_t k, const Axis& axis, const Axis& other) const
{
  double sum = 0.0;
  int count = 0;
  for (const std::size_t from : { k, k + axis.along })
  {
    for (const std::size_t at : { from, from - other.along })
    {
      if (other.jumps[at] == 0 && this->IsLink(at, other))
      {
        sum += this->Difference(at, other) / other.length;
        ++count;
      }
    }
  }
  return count > 0 ? sum / count : 0.0;
}

//------------------------------------------------------------------------------
double DepthLinks::MeanSlope() const
{
  std::vector<double> sums(static_cast<std::size_t>(this->Grid.rows), 0.0);
  std::vector<double> counts(sums.size(), 0.0);
  this->ForRows(
    [&](int j)
    {
      for (std::size_t k = this->Grid.At(0, j); k < this->Grid.At(this->Grid.columns, j); ++k)
      {
        const double p = this->Slope(k, this->X);
        const double q = this->Slope(k, this->Y);
        sums[j] += std::sqrt(p * p + q * q);
        counts[j] += this->Has(k) ? 1.0 : 0.0;
      }
    });
  double sum = 0.0;
  double count = 0.0;
  for (std::size_t j = 0; j < sums.size(); ++j)
  {
    sum += sums[j];
    count += counts[j];
  }
  return count > 0.0 ? sum / count : 0.0;
}

//------------------------------------------------------------------------------
void DepthLinks::SetTarget(std::size_t k, double mean, double attenuation, Axis& axis,
  const Axis& other, std::vector<float>& links)
{
  links[k] = 0.0f;
  axis.targets[k] = 0.0f;
  if (!this->IsLink(k, axis))
  {
    return;
  }
  links[k] = axis.weight * (axis.jumps[k] != 0 ? WeakLink : 1.0f);
  if (axis.jumps[k] == 0 && mean > 0.0)
  {
    const double p = this->Difference(k, axis) / axis.length;
    const double q = this->CrossSlope(k, axis, other);
    const double s = std::sqrt(p * p + q * q) / mean;
    const double a = attenuation * s;
    const double factor = a > 1e-6 ? std::log1p(a) / a : 1.0;
    axis.targets[k] = static_cast<float>(p * axis.length * factor);
    const double flat = std::max(1.0 - s / FlatSlope, 0.0);
    links[k] *= static_cast<float>(1.0 + FlatWeight * flat * flat);
  }
}

//------------------------------------------------------------------------------
// What a sample's links to the background weigh; beyond the image there is none.
float DepthLinks::BorderOf(int i, int j) const
{
  const std::size_t k = this->Grid.At(i, j);
  float weight = 0.0f;
  if (this->Has(k))
  {
    weight += i > 0 && !this->Has(k - 1) ? this->X.weight : 0.0f;
    weight += i + 1 < this->Grid.columns && !this->Has(k + 1) ? this->X.weight : 0.0f;
    weight += j > 0 && !this->Has(k - this->Grid.Pitch()) ? this->Y.weight : 0.0f;
    weight += j + 1 < this->Grid.rows && !this->Has(k + this->Grid.Pitch()) ? this->Y.weight : 0.0f;
  }
  return WeakLink * weight;
}

//------------------------------------------------------------------------------
void DepthLinks::SetTargets(double attenuation)
{
  const double mean = this->MeanSlope();
  this->ForRows(
    [&](int j)
    {
      for (int i = 0; i < this->Grid.columns; ++i)
      {
        const std::size_t k = this->Grid.At(i, j);
        this->SetTarget(k, mean, attenuation, this->X, this->Y, this->Grid.right);
        this->SetTarget(k, mean, attenuation, this->Y, this->X, this->Grid.up);
        this->Grid.border[k] = this->BorderOf(i, j);
      }
    });
}

//------------------------------------------------------------------------------
std::vector<double> DepthLinks::RightSide(double step) const
{
  std::vector<double> b(this->Grid.Size(), 0.0);
  const auto flow = [step](const std::vector<float>& links, const Axis& axis, std::size_t k)
  { return links[k] * (axis.jumps[k] != 0 ? step * axis.jumps[k] : axis.targets[k]); };
  this->ForRows(
    [&](int j)
    {
      for (std::size_t k = this->Grid.At(0, j); k < this->Grid.At(this->Grid.columns, j); ++k)
      {
        b[k] = flow(this->Grid.right, this->X, k - 1) - flow(this->Grid.right, this->X, k) +
          flow(this->Grid.up, this->Y, k - this->Grid.Pitch()) - flow(this->Grid.up, this->Y, k) +
          this->Grid.border[k] * step;
      }
    });
  return b;
}

//------------------------------------------------------------------------------
int DepthLinks::TightenSteps(const std::vector<double>& x, double step)
{
  std::vector<int> counts(static_cast<std::size_t>(this->Grid.rows), 0);
  const auto tighten = [&](std::size_t k, const Axis& axis, float& link)
  {
    const double left = axis.jumps[k] * (x[k + axis.along] - x[k]);
    const bool closed = axis.jumps[k] != 0 && left < 0.5 * step;
    link = closed ? Tightening * std::max(link, axis.weight) : link;
    return closed ? 1 : 0;
  };
  this->ForRows(
    [&](int j)
    {
      for (std::size_t k = this->Grid.At(0, j); k < this->Grid.At(this->Grid.columns, j); ++k)
      {
        counts[j] += tighten(k, this->X, this->Grid.right[k]);
        counts[j] += tighten(k, this->Y, this->Grid.up[k]);
      }
    });
  int count = 0;
  for (const int row : counts)
  {
    count += row;
  }
  return count;
}

//------------------------------------------------------------------------------
LinkGrid DepthLinks::SurfaceLinks() const
{
  LinkGrid grid(this->Grid.columns, this->Grid.rows);
  grid.mass = this->Grid.mass;
  this->ForRows(
    [&](int j)
    {
      for (std::size_t k = grid.At(0, j); k < grid.At(grid.columns, j); ++k)
      {
        const auto link = [&](const Axis& axis)
        { return axis.jumps[k] == 0 && this->IsLink(k, axis) ? axis.weight : 0.0f; };
        grid.right[k] = link(this->X);
        grid.up[k] = link(this->Y);
      }
    });
  return grid;
}

//------------------------------------------------------------------------------
DepthLinks::Range DepthLinks::RangeOf(const std::vector<double>& x) const
{
  std::vector<Range> ranges(static_cast<std::size_t>(this->Grid.rows));
  this->ForRows(
    [&](int j)
    {
      Range& range = ranges[j];
      for (std::size_t k = this->Grid.At(0, j); k < this->Grid.At(this->Grid.columns, j); ++k)
      {
        if (this->Has(k))
        {
          range.Add(x[k]);
        }
      }
    });
  Range all;
  for (const Range& range : ranges)
  {
    // Rows without data have no range.
    all.least = std::min(all.least, range.least);
    all.largest = std::max(all.largest, range.largest);
  }
  return all;
}

//------------------------------------------------------------------------------
std::vector<double> DepthLinks::Mix(const std::vector<double>& a, double shareOfA,
  const std::vector<double>& b, double shareOfB) const
{
  std::vector<double> x(this->Grid.Size(), 0.0);
  this->ForRows(
    [&](int j)
    {
      for (std::size_t k = this->Grid.At(0, j); k < this->Grid.At(this->Grid.columns, j); ++k)
      {
        x[k] = shareOfA * a[k] + shareOfB * b[k];
      }
    });
  return x;
}

}
