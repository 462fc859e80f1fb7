// SPDX-License-Identifier: BSD-3-Clause
#ifndef SunAt_h
#define SunAt_h

#include "vtkReliefShadingModule.h" // For export macro

#include "ClockTime.h"
#include "SolarPosition.h"

#include <optional>

namespace relief::hosts
{
/// The sun over a place in degrees, through standard air at an elevation in metres above the sea,
/// or without air.
VTKRELIEFSHADING_EXPORT SolarPosition SunAt(
  const ClockTime& time, double longitude, double latitude, const std::optional<double>& elevation);
}

#endif
