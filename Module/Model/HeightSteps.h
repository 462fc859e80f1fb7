// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightSteps_h
#define HeightSteps_h

#include "HeightField.h"

#include <cstddef>

namespace relief
{

/// How finely heights are stored.
struct HeightSteps
{
  double step = 0.0;       ///< the least difference between two heights; 0 if all are the same
  std::size_t levels = 0;  ///< how many heights differ
  std::size_t samples = 0; ///< of how many that were looked at
};

/// Looks at no more than 2^20 samples, on a fixed grid.
template <class T>
HeightSteps FindHeightSteps(const HeightSource<T>& source);

/// Whether a field of more than 10 000 samples has at most 256 heights, and most neighbours are the
/// same, the others one step apart: gentle ground that was stored in few steps.
template <class T>
bool ShowsTerraces(const HeightSource<T>& source);

/// Smooths the terraces of heights that were rounded to whole steps: into `result`, row by row
/// without gaps, NaN without data. No height leaves the half step that it was rounded within; of
/// all such surfaces the one with the gentlest slopes (by their squares) is approached, from means
/// over ever smaller blocks. Neighbours that are more than one step and a half apart are a true
/// flank and do not draw each other, nor does anything across samples without data. Neither the
/// source's scale nor its spacing count. Takes 22 bytes a sample; does not depend on how the rows
/// are shared out. The step is above 0.
template <class T, class Out>
void SmoothHeightSteps(
  const HeightSource<T>& source, double step, const ParallelFor& parallelFor, Out* result);

}

#endif
