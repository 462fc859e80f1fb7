// SPDX-License-Identifier: BSD-3-Clause
#include "LightPresets.h"

#include "Angles.h"
#include "ClearSky.h"
#include "ReliefModel.h"

namespace relief
{

LightPreset DefaultLights()
{
  LightPreset result;
  result.suns.push_back({ UsualAzimuth, UsualAltitude, UsualIntensity });
  return result;
}

LightPreset MultidirectionalLights()
{
  LightPreset result;
  for (const double azimuth : { 225.0, 270.0, 315.0, 360.0 })
  {
    result.suns.push_back({ azimuth, 30.0, 0.25 });
  }
  return result;
}

LightPreset SkyDomeLights()
{
  LightPreset result;
  result.sky = LightPreset::Sky::WhiteDome;
  result.skySamples = 128;
  // Summits see more of it than level ground does, up to 1.6 times where slopes are steep.
  result.skyIntensity = 0.62;
  return result;
}

LightPreset SunAndSkyLights(double azimuth, double altitude)
{
  LightPreset result;
  result.suns.push_back({ azimuth, altitude, 0.55, 0.533,
    SunColor({ 0.0, 0.0, SinDegrees(altitude) }, UsualTurbidity) });
  result.sky = LightPreset::Sky::Clear;
  result.skySampling = EnvironmentSampling::Importance;
  result.skyIntensity = 0.2;
  return result;
}

LightPreset CombinedLights(double azimuth, double altitude)
{
  LightPreset result;
  result.suns.push_back({ azimuth, altitude });
  result.response = f64::RELIEF_COMBINED;
  return result;
}

LightPreset IgorLights(double azimuth)
{
  LightPreset result;
  result.suns.push_back({ azimuth });
  result.response = f64::RELIEF_IGOR;
  return result;
}

}
