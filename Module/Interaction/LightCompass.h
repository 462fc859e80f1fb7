// SPDX-License-Identifier: BSD-3-Clause
#ifndef LightCompass_h
#define LightCompass_h

/// @file
/// Lights as dots on a plane: where a light's dot is, and what becomes of the light when its dot is
/// moved. vtkReliefLightRepresentation.h has the rules. Private to the module.

namespace relief::widget
{
/// A light in the frame of a relief: x and y from its middle, z as heights.
struct PlacedLight
{
  bool Positional;
  double Vector[3]; // a lamp's position; the unit vector toward a sun
};

/// What a dot's place means, on a relief of a given size.
class LightCompass
{
public:
  double HalfSize[2] = { 0.5, 0.5 }; ///< of the relief
  double PlaceFactor = 1.0;
  double MeanHeight = 0.0;
  double LowestAltitude = 0.0; ///< how far down suns are moved, in degrees

  /// From the zenith to the horizon.
  double GetRadius() const;

  /// Remembers the azimuth of a sun, for when it is in the zenith and has none.
  void Remember(const PlacedLight& light);

  void GetDot(const PlacedLight& light, double dot[2]) const;
  void SetDot(const double dot[2], PlacedLight& light);
  void Raise(PlacedLight& light, double steps) const;

  /// Makes a sun of a lamp and returns the lamp's distance from the middle.
  double ToSun(PlacedLight& light) const;
  /// Makes a lamp of a sun, at a distance, or at one for its dot to be within the relief if that is
  /// 0.
  void ToLamp(PlacedLight& light, double distance) const;

private:
  double GetFarthest(double now) const;
  void SetSun(double altitude, PlacedLight& light) const;

  double Azimuth[2] = { 0.0, 1.0 };
};
}

#endif
