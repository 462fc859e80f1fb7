// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightSummary_h
#define HeightSummary_h

/// @file
/// What an image's heights are on the whole. Not installed.

#include "vtkReliefShadingModule.h" // For export macro
#include "vtkType.h"                // For vtkIdType

class vtkDataArray;

namespace relief::hosts
{
/// Of the samples that have data, in the heights' own values, before any scale.
struct HeightSummary
{
  vtkIdType samples = 0; ///< how many there are; without any, the numbers below are 0
  double least = 0.0;
  double greatest = 0.0;
  double mean = 0.0;
  bool HasData() const { return this->samples > 0; }
};

/// Looks at every height once, O(samples). What has no data is what the shading takes for it
/// (Documentation/Conventions.md, "No data, mask and alpha"): values that are not finite, those
/// that equal `noData` in the type of the heights where `useNoData`, and those at which the mask,
/// which may be null, is 0 or NaN. Of several components the first counts. A mask of fewer values
/// is no mask for the samples beyond.
VTKRELIEFSHADING_EXPORT HeightSummary SummarizeHeights(
  vtkDataArray* heights, vtkDataArray* mask = nullptr, bool useNoData = false, double noData = 0.0);
}

#endif
