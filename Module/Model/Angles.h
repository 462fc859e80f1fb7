// SPDX-License-Identifier: BSD-3-Clause
#ifndef Angles_h
#define Angles_h

/// @file
/// Angles in degrees, exact at multiples of 90: a sun due east must not shine a little from the
/// north.

#include <cmath>

namespace relief
{

/// Half a turn in radians.
constexpr double Pi = 3.141592653589793;

/// A degree in radians, and a radian in degrees.
constexpr double Degree = 0.017453292519943295;
constexpr double Radian = 57.29577951308232;

inline double SinDegrees(double degrees)
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
  return std::sin(turn * Degree);
}

inline double CosDegrees(double degrees)
{
  return SinDegrees(90.0 - std::abs(std::remainder(degrees, 360.0)));
}

/// The unit vector toward an azimuth, clockwise from +y, and an altitude above the horizon.
inline void DirectionOf(double azimuth, double altitude, double direction[3])
{
  const double level = CosDegrees(altitude);
  direction[0] = SinDegrees(azimuth) * level;
  direction[1] = CosDegrees(azimuth) * level;
  direction[2] = SinDegrees(altitude);
}

}

#endif
