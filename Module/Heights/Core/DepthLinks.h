// SPDX-License-Identifier: BSD-3-Clause
#ifndef DepthLinks_h
#define DepthLinks_h

#include "ParallelFor.h"
#include "ScreenedPoisson.h"
#include "UnitDepth.h"

#include <cstddef>
#include <functional>
#include <limits>
#include <vector>

namespace relief
{

/// Depth on the grid of a solver, with its margin; which links between samples lead over a gap, and
/// what the others ask of a relief. All values are shares of the range of the depth.
class DepthLinks
{
public:
  struct Range
  {
    double least = std::numeric_limits<double>::infinity();
    double largest = -std::numeric_limits<double>::infinity();

    void Add(double value)
    {
      this->least = value < this->least ? value : this->least;
      this->largest = value > this->largest ? value : this->largest;
    }

    double Length() const
    {
      return this->largest > this->least ? this->largest - this->least : 0.0;
    }
  };

  /// Gaps are links that are longer than `jump`.
  DepthLinks(const UnitDepth& depth, double jump, const ParallelFor& parallelFor);

  /// Sets what links ask for: slopes are attenuated, to log(1 + a * s) / a for a slope of s mean
  /// slopes (Weyrich et al. 2007), gaps are let go.
  void SetTargets(double attenuation);

  /// The right-hand side of the least squares, where gaps and the border of the background leave a
  /// step.
  std::vector<double> RightSide(double step) const;

  /// Holds gaps faster over which less than half the step is left; returns how many there were.
  int TightenSteps(const std::vector<double>& x, double step);

  /// A grid of links within surfaces alone, all of one weight.
  LinkGrid SurfaceLinks() const;

  const LinkGrid& GetGrid() const { return this->Grid; }
  const std::vector<double>& GetDepth() const { return this->Z; }
  bool Has(std::size_t k) const { return this->Grid.mass[k] > 0.0f; }

  Range RangeOf(const std::vector<double>& x) const;
  std::vector<double> Mix(const std::vector<double>& a, double shareOfA,
    const std::vector<double>& b, double shareOfB) const;
  void ForRows(const std::function<void(int)>& body) const;

private:
  // The way from a sample to the next one, how long it is, and what a link along it weighs.
  struct Axis
  {
    std::ptrdiff_t along;
    double length;
    float weight;
    // 1 or -1 where a link leads over a gap to a nearer surface or a farther one.
    std::vector<signed char> jumps;
    std::vector<float> targets;
  };

  bool IsLink(std::size_t k, const Axis& axis) const
  {
    return this->Has(k) && this->Has(k + axis.along);
  }
  double Difference(std::size_t k, const Axis& axis) const;
  bool IsJump(std::size_t k, const Axis& axis, double jump) const;
  double Slope(std::size_t k, const Axis& axis) const;
  double CrossSlope(std::size_t k, const Axis& axis, const Axis& other) const;
  double MeanSlope() const;
  void SetTarget(std::size_t k, double mean, double attenuation, Axis& axis, const Axis& other,
    std::vector<float>& links);
  float BorderOf(int i, int j) const;

  ParallelFor Parallel;
  LinkGrid Grid;
  Axis X;
  Axis Y;
  std::vector<double> Z;
};

}

#endif
