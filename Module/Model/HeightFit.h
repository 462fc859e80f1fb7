// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightFit_h
#define HeightFit_h

#include "HeightField.h"

#include <functional>

namespace relief
{

/// Heights of which only some samples are looked at.
struct SampledHeights
{
  int columns = 0;
  int rows = 0;
  double spacingX = 1.0;
  double spacingY = 1.0;
  /// Reads a sample; returns whether it has data. Asked from several threads at once, by each for
  /// the samples of a few rows at a time.
  std::function<bool(int i, int j, double& height)> read;
};

/// The scale with which heights that have no unit make a good first picture; 0 where there is
/// nothing to scale: no relief, no two rows or columns, no data. The source's own scale does not
/// count.
///
/// It is chosen by slopes. The steep ones, about the steepest quarter's least, become those of 35
/// degrees, unless the relief would then be higher than a fifth of the field's longer side. They
/// are measured between means over blocks of at least 4 x 4 samples: what a number type rounds
/// averages out there, and the same relief in 8 bits, 16 bits or from 0 to 1, shifted or
/// multiplied, is scaled to the same lengths. Ground that would not climb the field's relief twice
/// on the way across counts less the gentler it is, so that flanks between flats decide alone.
///
/// A field has at most 512 blocks along each axis, of which 16 samples each are read. The result
/// does not depend on how the rows are shared out.
template <class T>
double FitHeightScale(const HeightSource<T>& source, const ParallelFor& parallelFor);
double FitHeightScale(const SampledHeights& source, const ParallelFor& parallelFor);

}

#endif
