// SPDX-License-Identifier: BSD-3-Clause
#ifndef SolarPosition_h
#define SolarPosition_h

#include <string>

namespace relief
{

/// The air that bends sunlight.
struct Air
{
  double pressure = 0.0;     ///< in hectopascals; 0 for none
  double temperature = 15.0; ///< in degrees Celsius
};

/// The standard atmosphere (ISO 2533) at a height above sea level in metres, in [-1000, 11000].
Air StandardAir(double elevation);

/// Where the sun's centre is seen, in degrees: clockwise from true north, in [0, 360), and above
/// the level horizon.
struct SolarPosition
{
  double azimuth = 0.0;
  double altitude = 0.0;
};

/// The sun at a time, a Julian date of UTC, and a place: degrees of longitude to the east and of
/// latitude to the north. Within 0.003 degrees of the exact place from 1600 to 2399, as far as UTC
/// tells the Earth's rotation, to 0.9 s or 0.004 degrees.
///
/// Longitude after P. Bretagnon and J.-L. Simon, "Planetary programs and tables from -4000 to
/// +2800" (Willmann-Bell, 1986); nutation, obliquity and sidereal time after J. Meeus,
/// "Astronomical algorithms" (2nd edition, Willmann-Bell, 1998), chapters 12 and 22; parallax;
/// refraction after T. Saemundsson, "Atmospheric refraction", Sky and Telescope 72 (1986), where
/// the sun's upper edge is above the horizon, as I. Reda and A. Andreas, "Solar position algorithm
/// for solar radiation applications" (Solar Energy 76, 2004), have it.
SolarPosition FindSun(double julianDay, double longitude, double latitude, const Air& air);

/// How far dynamical time is ahead of the Earth's rotation, in seconds, by the polynomials of
/// F. Espenak and J. Meeus, "Five millennium canon of solar eclipses" (NASA/TP-2006-214141), for
/// years, which may have fractions, from 1600 on.
double DeltaT(double year);

/// What is wrong with a place or a height above sea level, empty if nothing is: longitudes are in
/// [-180, 360], latitudes in [-90, 90], heights in [-1000, 11000].
std::string CheckPlace(double longitude, double latitude, double elevation);

}

#endif
