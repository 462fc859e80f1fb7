// SPDX-License-Identifier: BSD-3-Clause
#ifndef LightPresets_h
#define LightPresets_h

/// @file
/// Lights that stand for common ways to shade a relief, for every host. Angles are in degrees; they
/// are not checked here.

#include "LightSampling.h"
#include "UsualLight.h"

#include <glm/vec3.hpp>

#include <optional>
#include <vector>

namespace relief
{

struct LightPreset
{
  struct Sun
  {
    double azimuth = UsualAzimuth;
    double altitude = UsualAltitude;
    double intensity = 1.0;
    double diameter = 0.0;
    glm::dvec3 color = glm::dvec3(1.0);
  };
  enum class Sky
  {
    None,
    WhiteDome,
    Clear ///< with the first sun in it, through air of the usual turbidity
  };

  std::vector<Sun> suns;
  Sky sky = Sky::None;
  double skyIntensity = 1.0;
  int skySamples = 64;
  EnvironmentSampling skySampling = EnvironmentSampling::SolidAngle;
  std::optional<int> response; ///< where it is not left as it is
};

///@{
/// The lights of a scene that was given none; a sun from each of four sides; a sky that is white
/// all over; a sun that colours the clear sky about it; and what the responses Combined and Igor
/// are for.
LightPreset DefaultLights();
LightPreset MultidirectionalLights();
LightPreset SkyDomeLights();
LightPreset SunAndSkyLights(double azimuth, double altitude);
LightPreset CombinedLights(double azimuth, double altitude);
LightPreset IgorLights(double azimuth);
///@}

}

#endif
