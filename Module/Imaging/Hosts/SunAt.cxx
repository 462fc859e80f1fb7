// SPDX-License-Identifier: BSD-3-Clause
#include "SunAt.h"

namespace relief::hosts
{
//------------------------------------------------------------------------------
SolarPosition SunAt(
  const ClockTime& time, double longitude, double latitude, const std::optional<double>& elevation)
{
  return FindSun(JulianDay(time), longitude, latitude, elevation ? StandardAir(*elevation) : Air());
}
}
