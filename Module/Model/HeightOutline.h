// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightOutline_h
#define HeightOutline_h

#include "RayThickness.h"
#include "RegionSet.h"
#include "SparseHeights.h"

#include <utility>

namespace relief
{

/// A field of which regions are left out that rays may meet, since there is no memory for them.
/// All that is known there is the least and the greatest height.
///
/// It is enough to bound d. With its start fixed, the length of a ray inside the material grows
/// with every height that it meets: so d is least where the regions are filled with their greatest
/// height, greatest where they are filled with their least, and between these with their own. That
/// holds as long as the regions that TileRegions calls needed are filled: how the ground goes on
/// beyond the data depends on slopes, and what a hole is on where data are.
///
/// The model's text traces both in double precision, a ray at a time, over fields that answer for
/// what is not there. That takes no memory, but some 40 times as long as the loops in lanes.
/// Nothing of a tolerance is used up: rays run to their end.
class HeightOutline
{
public:
  /// `whole` are the regions whose own samples depend on nothing that is left out: these are traced
  /// as ever, bit for bit. The heights must outlive this object, and stay filled as they are.
  HeightOutline(const SparseHeights& heights, RegionSet whole)
    : Heights(heights)
    , Whole(std::move(whole))
  {
  }

  /// Whether the samples of the region that holds sample (i, j) depend on nothing that is left out.
  bool IsWhole(int i, int j) const
  {
    return this->Whole.Has(i / RasterBounds::RegionSize, j / RasterBounds::RegionSize);
  }

  /// How many samples of a row are traced at once, at most.
  static constexpr int MostSamples = 64;

  /// Between what the d and the r of a row's samples lie; of those that are not traced, anything.
  struct Row
  {
    double leastD[MostSamples];
    double greatestD[MostSamples];
    double leastR[MostSamples];
    double greatestR[MostSamples];
  };

  /// Traces a light for a request of at most that many samples, into which nothing is written.
  void TraceRow(const f64::ReliefMedium& medium, const Light& light,
    const RowRequest<float>& request, Row& row, RayCount& count) const;

  /// The same by fixed steps, as StepRow() has it.
  void StepRow(const f32::ReliefMedium& medium, const Light& light, int steps,
    const RowRequest<float>& request, Row& row, RayCount& count) const;

private:
  const SparseHeights& Heights;
  RegionSet Whole;
};

/// What is wrong with what has been shaded by an outline, at most.
struct OutlineError
{
  /// Of d, over all lights and samples: half of what lies between its bounds, in the light's share
  /// of the tolerance. The tolerance that is wanted.
  double tolerance = 0.0;
  /// Of layers that have no tolerance, whether they are not known: r, and the sun's shadow.
  bool thickness = false;
  bool shadow = false;

  void Add(const OutlineError& other)
  {
    this->tolerance = other.tolerance > this->tolerance ? other.tolerance : this->tolerance;
    this->thickness = this->thickness || other.thickness;
    this->shadow = this->shadow || other.shadow;
  }
};

}

#endif
