// SPDX-License-Identifier: BSD-3-Clause
#ifndef LightSampling_h
#define LightSampling_h

#include "RadianceMap.h"
#include "RayThickness.h"

#include <glm/mat3x3.hpp>

#include <vector>

namespace relief
{

enum class EnvironmentSampling
{
  Uniform,    ///< equal steps of azimuth and polar angle, w = 1/N each, as the thesis has it
  SolidAngle, ///< patches of equal solid angle in each half of the sphere, w = solid angle / pi
  Importance  ///< small patches where light is strong and uneven, w = solid angle / pi
};

/// A map as directional lights. A light stands for a patch of the sphere: its colour is the mean
/// radiance of the texels in the patch, weighted by their solid angle, parts of texels counted as
/// parts. `toField` turns the map's frame to the field's; it may mirror.
///
/// - Uniform: rows of patches that are equal in (u, v), sqrt(N) rows; a square N gives a square
///   grid, as in the thesis (section 4.3.2.2). The light shines from the patch's middle in (u, v).
/// - SolidAngle and Importance: the sum of colour and weight is the map's own integral at every
///   number of samples. Patches do not cross the horizon of the map's tilted frame (unless one
///   light stands for all). A light's height above that horizon is the mean over its patch, so that
///   on level ground, where d is that height, a uniform sky gives what its integral gives.
/// - SolidAngle: each half is cut into bands, and these into nearly square patches, as P. Leopardi,
///   "A partition of the unit sphere into regions of equal area and small diameter", ETNA 25
///   (2006), does; but the pole has several patches, and where N is a multiple of 8 the pattern
///   looks the same after a quarter turn.
/// - Importance: the patch whose light could err most, its energy times its spread (a quarter
///   of that below the horizon, which seldom shows), is cut in two
///   where the spreads of the halves become least, until there are N (variance minimisation:
///   K. Viriyothai and P. Debevec, "Variance minimization light probe sampling", SIGGRAPH Posters
///   2009, after Debevec's median cut of 2005). The light shines from its patch's centre of
///   energy. Black patches give no light, so there may be fewer than N.
///
/// The pattern does not turn when the map turns about its own axis, so a map that looks the same
/// after a part of a turn is sampled the same; it leans and turns with everything else. Uniform and
/// SolidAngle keep the very same directions and tolerances while it turns.
///
/// A scene's tolerance is shared out to the lights (their toleranceScale), so that the weighted sum
/// of their colours times d errs by at most the tolerance times the map's mean in every channel:
/// evenly, or with Importance so that bright lights are traced more exactly than dim ones.
std::vector<Light> SampleEnvironment(
  const RadianceMap& map, EnvironmentSampling sampling, int samples, const glm::dmat3& toField);

/// Puts directional lights on a sphere, as positional ones.
void PlaceOnSphere(std::vector<Light>& lights, const glm::dvec3& center, double radius);

/// A sun's disc as directional lights of equal solid angle and equal weight, which sum to the
/// sun's. `diameter` is an angle in radians; 0, or one sample, gives the sun itself. Samples lie
/// in pairs opposite one another on a sunflower's spiral (H. Vogel, "A better way to construct the
/// sunflower head", Mathematical Biosciences 44 (1979)), so their mean direction is the sun's.
std::vector<Light> SampleDisc(const Light& sun, double diameter, int samples);

}

#endif
