// SPDX-License-Identifier: BSD-3-Clause
#ifndef WebScene_h
#define WebScene_h

/// @file
/// A scene as JavaScript names it, and as the model takes it.

#include "LightPresets.h"
#include "Scene.h"
#include "WebHeights.h"
#include "WebParameters.h"

#include <array>
#include <string>
#include <vector>

namespace relief::web
{

/// The value of a parameter, as many numbers as it has; 1 or 0 for a flag, a choice's place.
using Values = std::array<double, 3>;

/// Whence an environment has its map, as options.js numbers them.
enum class Sky
{
  None,
  WhiteDome,
  Clear,
  Picture
};

struct WebScene
{
  /// By key::Parameter, of the scene, the material and the environment; checked by the caller.
  std::array<Values, key::NumberOfParameters> values{};
  /// Lights with their diameter in radians. Heights of lamps are above 0, not above the datum.
  struct Source
  {
    Light light;
    double diameter = 0.0;
  };
  std::vector<Source> sources;
  Sky sky = Sky::None;
  bool hasEnvironment = false;
  double skyAzimuth = 0.0; ///< of the sun in a clear sky
  double skyAltitude = 0.0;
  double turbidity = UsualTurbidity;
  ColorTexture skyPicture;
  /// The lights that stand for the environment, where they have been found before.
  std::vector<Light> samples;
  /// Pictures that cover the heights, without texels where there are none.
  ColorTexture baseTexture;
  ColorTexture diffuseTexture;
  ColorTexture specularTexture;

  double operator[](key::Parameter parameter) const { return this->values[parameter][0]; }
};

/// All of a scene but its lights and what the datum of a field adds.
Scene MaterialOf(const WebScene& scene, const WebHeights& heights);

/// Brings the datum, the lights and the textures. `cleaned` is how many texels of the environment
/// are not as they were given. Returns where the lights of the environment begin.
std::size_t Complete(const WebScene& scene, const WebHeights& heights, const HeightField& field,
  Scene& result, int& cleaned);

/// The lights that stand for the environment, infinitely far away; none where it has no map.
std::vector<Light> EnvironmentLights(const WebScene& scene, int& cleaned);

/// The source that a preset's sun is.
WebScene::Source SourceOf(const LightPreset::Sun& sun);

}

#endif
