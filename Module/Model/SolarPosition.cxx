// SPDX-License-Identifier: BSD-3-Clause
#include "SolarPosition.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <sstream>

namespace relief
{

namespace
{
constexpr double Radians = 3.14159265358979323846 / 180.0; // of a degree
constexpr double Arcsecond = 1.0 / 3600.0;
constexpr double J2000 = 2451545.0;
constexpr double DaysOfCentury = 36525.0;

constexpr double LowestElevation = -1000.0;
constexpr double HighestElevation = 11000.0; // where the troposphere ends

double Sine(double degrees)
{
  return std::sin(std::remainder(degrees, 360.0) * Radians);
}

double Cosine(double degrees)
{
  return std::cos(std::remainder(degrees, 360.0) * Radians);
}

double Polynomial(const double* coefficients, int count, double x)
{
  double sum = 0.0;
  for (int k = count - 1; k >= 0; --k)
  {
    sum = sum * x + coefficients[k];
  }
  return sum;
}

// Of the sun's longitude, by Bretagnon and Simon: amplitude in 1e-7 radians, degrees of phase and
// degrees a century.
struct Term
{
  double amplitude;
  double phase;
  double speed;
};

constexpr Term LongitudeTerms[] = { { 403406, 270.54861, 0.9287892 },
  { 195207, 340.19128, 35999.1376958 }, { 119433, 63.91854, 35999.4089666 },
  { 112392, 331.26220, 35998.7287385 }, { 3891, 317.843, 71998.20261 },
  { 2819, 86.631, 71998.4403 }, { 1721, 240.052, 36000.35726 }, { 660, 310.26, 71997.4812 },
  { 350, 247.23, 32964.4678 }, { 334, 260.87, -19.4410 }, { 314, 297.82, 445267.1117 },
  { 268, 343.14, 45036.8840 }, { 242, 166.79, 3.1008 }, { 234, 81.53, 22518.4434 },
  { 158, 3.50, -19.9739 }, { 132, 132.75, 65928.9345 }, { 129, 182.95, 9038.0293 },
  { 114, 162.03, 3034.7684 }, { 99, 29.8, 33718.148 }, { 93, 266.4, 3034.448 },
  { 86, 249.2, -2280.773 }, { 78, 157.6, 29929.992 }, { 72, 257.8, 31556.493 },
  { 68, 185.1, 149.588 }, { 64, 69.9, 9037.750 }, { 46, 8.0, 107997.405 }, { 38, 197.1, -4444.176 },
  { 37, 250.4, 151.771 }, { 32, 65.3, 67555.316 }, { 29, 162.7, 31556.080 },
  { 28, 341.5, -4561.540 }, { 27, 291.6, 107996.706 }, { 27, 98.5, 1221.655 },
  { 25, 146.7, 62894.167 }, { 24, 110.0, 31437.369 }, { 21, 5.2, 14578.298 },
  { 21, 342.6, -31931.757 }, { 20, 230.9, 34777.243 }, { 18, 256.1, 1221.999 },
  { 17, 45.3, 62894.511 }, { 14, 242.9, -4442.039 }, { 13, 115.2, 107997.909 },
  { 13, 151.8, 119.066 }, { 13, 285.3, 16859.071 }, { 12, 53.3, -4.578 }, { 10, 126.6, 26895.292 },
  { 10, 205.7, -39.127 }, { 10, 85.9, 12297.536 }, { 10, 146.1, 90073.778 } };

// The sun's geometric longitude, from the mean equinox of date; `c` in dynamical centuries.
double Longitude(double c)
{
  double sum = 0.0;
  for (const Term& term : LongitudeTerms)
  {
    sum += term.amplitude * Sine(term.phase + term.speed * c);
  }
  return 282.7771834 + 36000.76953744 * c + 1e-7 / Radians * sum;
}

// Of the equinox along the ecliptic and of the obliquity, in degrees: the four largest terms, which
// leave out less than half a second of arc.
struct Nutation
{
  double longitude;
  double obliquity;
};

Nutation FindNutation(double c)
{
  const double node = 125.04452 - 1934.136261 * c;
  const double sun = 280.4665 + 36000.7698 * c;
  const double moon = 218.3165 + 481267.8813 * c;
  return { Arcsecond *
      (-17.20 * Sine(node) - 1.32 * Sine(2.0 * sun) - 0.23 * Sine(2.0 * moon) +
        0.21 * Sine(2.0 * node)),
    Arcsecond *
      (9.20 * Cosine(node) + 0.57 * Cosine(2.0 * sun) + 0.10 * Cosine(2.0 * moon) -
        0.09 * Cosine(2.0 * node)) };
}

// In degrees, of an altitude in degrees. Saemundsson's is for 1010 hPa and 10 degrees Celsius.
double Refraction(double altitude, const Air& air)
{
  // Where the upper edge, half a degree's disc as it is refracted there, has not risen, nobody sees
  // it, and the formula ends.
  constexpr double lowest = -(0.26667 + 0.5667);
  if (altitude < lowest)
  {
    return 0.0;
  }
  const double minutes = 1.02 / std::tan((altitude + 10.3 / (altitude + 5.11)) * Radians);
  return std::max(minutes, 0.0) / 60.0 * (air.pressure / 1010.0) * 283.0 /
    (273.0 + air.temperature);
}

// A stretch of years for DeltaT, which begins there: a polynomial in years since another.
struct Stretch
{
  double from;
  double origin;
  double coefficients[8];
};

constexpr Stretch Stretches[] = { { 1600, 1600, { 120, -0.9808, -0.01532, 1.0 / 7129 } },
  { 1700, 1700, { 8.83, 0.1603, -0.0059285, 0.00013336, -1.0 / 1174000 } },
  { 1800, 1800,
    { 13.72, -0.332447, 0.0068612, 0.0041116, -0.00037436, 0.0000121272, -0.0000001699,
      0.000000000875 } },
  { 1860, 1860, { 7.62, 0.5737, -0.251754, 0.01680668, -0.0004473624, 1.0 / 233174 } },
  { 1900, 1900, { -2.79, 1.494119, -0.0598939, 0.0061966, -0.000197 } },
  { 1920, 1920, { 21.20, 0.84493, -0.076100, 0.0020936 } },
  { 1941, 1950, { 29.07, 0.407, -1.0 / 233, 1.0 / 2547 } },
  { 1961, 1975, { 45.45, 1.067, -1.0 / 260, -1.0 / 718 } },
  { 1986, 2000, { 63.86, 0.3345, -0.060374, 0.0017275, 0.000651814, 0.00002373599 } },
  { 2005, 2000, { 62.92, 0.32217, 0.005589 } },
  // -20 + 32 u^2 with u in centuries since 1820, which until 2150 is led to what went before.
  { 2050, 1820, { -20 - 0.5628 * (2150 - 1820), 0.5628, 0.0032 } },
  { 2150, 1820, { -20, 0, 0.0032 } } };
}

//------------------------------------------------------------------------------
Air StandardAir(double elevation)
{
  const double share = 1.0 - 2.25577e-5 * elevation;
  return { 1013.25 * std::pow(share, 5.25588), 15.0 - 0.0065 * elevation };
}

//------------------------------------------------------------------------------
double DeltaT(double year)
{
  const auto* const after = std::find_if(std::begin(Stretches) + 1, std::end(Stretches),
    [year](const Stretch& stretch) { return year < stretch.from; });
  const Stretch& stretch = *(after - 1);
  return Polynomial(stretch.coefficients, 8, year - stretch.origin);
}

//------------------------------------------------------------------------------
SolarPosition FindSun(double julianDay, double longitude, double latitude, const Air& air)
{
  const double days = julianDay - J2000;
  const double seconds = DeltaT(2000.0 + days / 365.2425);
  const double c = (days + seconds / 86400.0) / DaysOfCentury;

  // Seen from the Earth's centre, at the true equinox of date.
  const Nutation nutation = FindNutation(c);
  const double anomaly = 357.52911 + 35999.05029 * c;
  const double distance = 1.00014 - 0.01671 * Cosine(anomaly) - 0.00014 * Cosine(2.0 * anomaly);
  const double aberration = 20.4898 * Arcsecond / distance;
  const double ecliptic = Longitude(c) - aberration + nutation.longitude;
  constexpr double obliquities[] = { 84381.448, -46.8150, -0.00059, 0.001813 };
  const double obliquity = Arcsecond * Polynomial(obliquities, 4, c) + nutation.obliquity;
  // Toward the equinox, the point 90 degrees east of it on the equator, and the pole.
  const double x = Cosine(ecliptic);
  const double y = Sine(ecliptic) * Cosine(obliquity);
  const double z = Sine(ecliptic) * Sine(obliquity);

  // The equinox's hour angle at the place, then the sun's direction to the east, north and zenith.
  const double centuries = days / DaysOfCentury;
  const double greenwich = 280.46061837 + 360.98564736629 * days +
    centuries * centuries * (0.000387933 - centuries / 38710000.0);
  const double sidereal = greenwich + nutation.longitude * Cosine(obliquity) + longitude;
  const double south = x * Cosine(sidereal) + y * Sine(sidereal); // on the equator
  const double east = y * Cosine(sidereal) - x * Sine(sidereal);
  const double north = z * Cosine(latitude) - south * Sine(latitude);
  const double up = z * Sine(latitude) + south * Cosine(latitude);

  SolarPosition sun;
  sun.azimuth = std::atan2(east, north) / Radians;
  sun.azimuth += sun.azimuth < 0.0 ? 360.0 : 0.0;
  sun.azimuth = sun.azimuth < 360.0 ? sun.azimuth : 0.0;
  sun.altitude = std::atan2(up, std::hypot(east, north)) / Radians;
  sun.altitude -= 8.794 * Arcsecond / distance * Cosine(sun.altitude);
  sun.altitude += Refraction(sun.altitude, air);
  return sun;
}

//------------------------------------------------------------------------------
std::string CheckPlace(double longitude, double latitude, double elevation)
{
  std::ostringstream wrong;
  if (!(longitude >= -180.0 && longitude <= 360.0))
  {
    wrong << "the longitude " << longitude << " was given, degrees in [-180, 360] are expected";
  }
  else if (!(latitude >= -90.0 && latitude <= 90.0))
  {
    wrong << "the latitude " << latitude << " was given, degrees in [-90, 90] are expected";
  }
  else if (!(elevation >= LowestElevation && elevation <= HighestElevation))
  {
    wrong << "the height above sea level " << elevation << " was given, metres in ["
          << LowestElevation << ", " << HighestElevation << "] are expected";
  }
  return wrong.str();
}

}
