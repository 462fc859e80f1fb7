// SPDX-License-Identifier: BSD-3-Clause
#include "ClearSky.h"

#include "Angles.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace relief
{

namespace
{

// Of R. Perez, R. Seals and J. Michalsky, "All-weather model for sky luminance distribution", 1993:
// relative values at the cosine of a polar angle and at an angle from the sun.
struct Perez
{
  double a, b, c, d, e;

  double operator()(double cosine, double angle) const
  {
    const double cosAngle = std::cos(angle);
    return (1.0 + this->a * std::exp(this->b / cosine)) *
      (1.0 + this->c * std::exp(this->d * angle) + this->e * cosAngle * cosAngle);
  }
};

// Chromaticity of the zenith: a polynomial in the sun's polar angle and the turbidity.
double Zenith(const double (&k)[3][4], double polar, double turbidity)
{
  double sum = 0.0;
  for (const double(&row)[4] : k)
  {
    sum = sum * turbidity + ((row[0] * polar + row[1]) * polar + row[2]) * polar + row[3];
  }
  return sum;
}

// From CIE xyY to linear sRGB, IEC 61966-2-1.
glm::dvec3 ToRGB(double x, double y, double luminance)
{
  const double X = x / y * luminance;
  const double Z = (1.0 - x - y) / y * luminance;
  return { 3.2406 * X - 1.5372 * luminance - 0.4986 * Z,
    -0.9689 * X + 1.8758 * luminance + 0.0415 * Z, 0.0557 * X - 0.2040 * luminance + 1.0570 * Z };
}

}

//------------------------------------------------------------------------------
RadianceMap ClearSky(const glm::dvec3& sun, double turbidity, int columns, int rows)
{
  const double t = turbidity;
  const Perez luminance = { 0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251,
    0.1206 * t - 2.5771, -0.0670 * t + 0.3703 };
  const Perez chromaX = { -0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125,
    -0.0641 * t - 0.8989, -0.0033 * t + 0.0452 };
  const Perez chromaY = { -0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102,
    -0.0441 * t - 1.6537, -0.0109 * t + 0.0529 };
  static const double zenithX[3][4] = { { 0.00166, -0.00375, 0.00209, 0.0 },
    { -0.02903, 0.06377, -0.03202, 0.00394 }, { 0.11693, -0.21196, 0.06052, 0.25886 } };
  static const double zenithY[3][4] = { { 0.00275, -0.00610, 0.00317, 0.0 },
    { -0.04214, 0.08970, -0.04153, 0.00516 }, { 0.15346, -0.26756, 0.06670, 0.26688 } };
  const double sunPolar = std::acos(glm::clamp(sun.z, -1.0, 1.0));
  const double x = Zenith(zenithX, sunPolar, t) / chromaX(1.0, sunPolar);
  const double y = Zenith(zenithY, sunPolar, t) / chromaY(1.0, sunPolar);

  // At the middle of each texel; one that the horizon cuts is as bright as its part above it.
  std::vector<glm::dvec3> colors;
  const int above = (rows + 1) / 2;
  double irradiance = 0.0;
  for (int j = 0; j < above; ++j)
  {
    const double part = std::min(1.0, 0.5 * rows - j);
    const double polar = Pi * (j + 0.5 * part) / rows;
    const double area = 2.0 * Pi / columns * (Pi / rows) * std::sin(polar) * part;
    for (int i = 0; i < columns; ++i)
    {
      const double azimuth = 2.0 * Pi * (i + 0.5) / columns;
      const glm::dvec3 toward(
        std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
      const double angle = std::acos(glm::clamp(glm::dot(toward, sun), -1.0, 1.0));
      const glm::dvec3 color = glm::max(ToRGB(x * chromaX(toward.z, angle),
                                          y * chromaY(toward.z, angle), luminance(toward.z, angle)),
        glm::dvec3(0.0));
      colors.push_back(part * color);
      irradiance += Luminance(color) * toward.z * area;
    }
  }
  RadianceMap map(columns, rows);
  for (int j = 0; j < above; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      map.Set(i, j, colors[static_cast<std::size_t>(j) * columns + i] * (Pi / irradiance));
    }
  }
  return map;
}

//------------------------------------------------------------------------------
glm::dvec3 SunColor(const glm::dvec3& sun, double turbidity)
{
  const double polar = glm::degrees(std::acos(glm::clamp(sun.z, -1.0, 1.0)));
  // Relative optical mass of the air, F. Kasten 1965.
  const double mass =
    1.0 / (std::max(sun.z, 0.0) + 0.15 * std::pow(93.885 - std::min(polar, 90.0), -1.253));
  const double haze = 0.04608 * turbidity - 0.04586;
  const double wavelengths[3] = { 0.611, 0.549, 0.464 }; // of sRGB's primaries, micrometres
  glm::dvec3 color(0.0);
  for (int c = 0; c < 3; ++c)
  {
    color[c] = std::exp(
      -mass * (0.008735 * std::pow(wavelengths[c], -4.08) + haze * std::pow(wavelengths[c], -1.3)));
  }
  return color / Luminance(color);
}

}
