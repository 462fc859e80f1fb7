// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkReliefAngles_h
#define vtkReliefAngles_h

/// @file
/// Angles in degrees as VTK's classes take them, exact at multiples of 90. Private to the module.

#include "vtkMath.h"

#include "Angles.h"

#include <cmath>

inline double vtkReliefSinDegrees(double degrees)
{
  return relief::SinDegrees(degrees);
}

inline double vtkReliefCosDegrees(double degrees)
{
  return relief::CosDegrees(degrees);
}

/// The unit vector toward an azimuth, clockwise from +y, and an altitude above the horizon.
inline void vtkReliefDirection(double azimuth, double altitude, double direction[3])
{
  relief::DirectionOf(azimuth, altitude, direction);
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
