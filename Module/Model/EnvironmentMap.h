// SPDX-License-Identifier: BSD-3-Clause
#ifndef EnvironmentMap_h
#define EnvironmentMap_h

/// @file
/// What an environment is made of before it is sampled as lights, for every host.

#include "ColorTexture.h"
#include "HeightField.h"
#include "LightSampling.h"
#include "RadianceMap.h"

#include <glm/mat3x3.hpp>

namespace relief
{

/// A clear sky's map has as many texels.
constexpr int ClearSkyColumns = 256;
constexpr int ClearSkyRows = 128;

/// The map of a latitude-longitude image, whose zenith is its first row, or else its last one.
RadianceMap MapOf(const ColorTexture& image, bool zenithFirst);

/// White above the horizon, black below.
RadianceMap WhiteDome();

/// From the map's frame to one whose z points up, in degrees: about the vertical, counter-clockwise
/// seen from above, then with the zenith toward the south. A column for each of the map's axes.
glm::dmat3 TurnOf(double rotationZ, double tilt);

/// Puts directional lights on a sphere about the middle of a field, half way between its least and
/// greatest height. An infinite radius leaves them as they are.
void PlaceAround(const HeightField& field, double radius, std::vector<Light>& lights);

}

#endif
