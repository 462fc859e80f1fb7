// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkReliefAngles_h
#define vtkReliefAngles_h

/// @file
/// Angles in degrees, exact at multiples of 90: a sun due east must not shine a little from the
/// north. Private to the module.

#include "vtkMath.h"

#include <cmath>

inline double vtkReliefSinDegrees(double degrees)
{
  double turn = std::remainder(degrees, 360.0); // exact, in [-180, 180]
  if (turn > 90.0)
  {
    turn = 180.0 - turn;
  }
  else if (turn < -90.0)
  {
    turn = -180.0 - turn;
  }
  return std::sin(vtkMath::RadiansFromDegrees(turn));
}

inline double vtkReliefCosDegrees(double degrees)
{
  return vtkReliefSinDegrees(90.0 - std::abs(std::remainder(degrees, 360.0)));
}

/// The unit vector toward an azimuth, clockwise from +y, and an altitude above the horizon.
inline void vtkReliefDirection(double azimuth, double altitude, double direction[3])
{
  const double level = vtkReliefCosDegrees(altitude);
  direction[0] = vtkReliefSinDegrees(azimuth) * level;
  direction[1] = vtkReliefCosDegrees(azimuth) * level;
  direction[2] = vtkReliefSinDegrees(altitude);
}

/// The angles of a vector, which need not be a unit vector: the azimuth in [0, 360), the altitude.
/// A vertical one has the azimuth 0.
inline void vtkReliefAngles(const double direction[3], double& azimuth, double& altitude)
{
  azimuth = vtkMath::DegreesFromRadians(std::atan2(direction[0], direction[1]));
  azimuth += azimuth < 0.0 ? 360.0 : 0.0;
  altitude =
    vtkMath::DegreesFromRadians(std::atan2(direction[2], std::hypot(direction[0], direction[1])));
}

#endif
