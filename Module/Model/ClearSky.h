// SPDX-License-Identifier: BSD-3-Clause
#ifndef ClearSky_h
#define ClearSky_h

#include "RadianceMap.h"

namespace relief
{

/// @file
/// Daylight without clouds after A. J. Preetham, P. Shirley and B. Smits, "A practical analytic
/// model for daylight", SIGGRAPH 1999 (appendices A.1 and A.2), as linear RGB with the primaries of
/// sRGB. `turbidity` says how hazy the air is, from 2 (very clear) to 10; the model was fitted
/// between 2 and 6. Directions are unit vectors with z up.

/// The sky with the sun at `sun`, at or above the horizon, and black below the horizon. It is
/// scaled so that it gives level white ground, by itself, the luminance 1.
RadianceMap ClearSky(const glm::dvec3& sun, double turbidity, int columns, int rows);

/// The colour of a sun at that height after its way through the air, scaled to luminance 1.
glm::dvec3 SunColor(const glm::dvec3& sun, double turbidity);

}

#endif
