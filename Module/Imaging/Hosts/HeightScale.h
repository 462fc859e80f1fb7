// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightScale_h
#define HeightScale_h

/// @file
/// What is found out of heights: the scale of those that have no unit, terraces, and a hash. Not
/// installed.

#include "HeightInputs.h"
#include "vtkReliefShadingModule.h" // For export macro

#include <cstdint>
#include <string>

namespace relief::hosts
{
/// What vtkReliefScene::FitHeightScale() takes, not rounded, or 0 where there is nothing to scale.
/// Where the heights cannot be shaded, `wrong` tells why.
VTKRELIEFSHADING_EXPORT double FitHeightScale(const HeightInputs& inputs, std::string& wrong);

/// As it is told and typed, with six significant digits.
VTKRELIEFSHADING_EXPORT double RoundHeightScale(double scale);

/// Whether integers are stored in so few steps that the edges of terraces show, which
/// vtkReliefStepSmoothing smooths.
VTKRELIEFSHADING_EXPORT bool ShowsTerraces(const HeightInputs& inputs);

/// The model's hash of heights (HeightHash.h). Where they cannot be shaded, `wrong` tells why.
VTKRELIEFSHADING_EXPORT std::uint64_t HashHeights(const HeightInputs& inputs, std::string& wrong);
}

#endif
