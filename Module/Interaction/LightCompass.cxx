// SPDX-License-Identifier: BSD-3-Clause
#include "LightCompass.h"

#include "vtkReliefAngles.h"

#include <algorithm>
#include <cmath>

namespace relief::widget
{
namespace
{
const double EdgeMargin = 0.9;     // how near to the edge of the relief a new lamp's dot comes
const double FarthestLamp = 10.0;  // in sizes of the relief
const double RaiseStep = 0.1;      // of a lamp's height, where that is large beside:
const double SmallestHeight = 0.1; // in radii of the compass
const double SmallestLevel = 1e-9; // of a unit vector that has an azimuth

double AltitudeOf(const PlacedLight& sun)
{
  double azimuth;
  double altitude;
  vtkReliefAngles(sun.Vector, azimuth, altitude);
  return altitude;
}
}

//------------------------------------------------------------------------------
// A relief of one row or column has no shorter side to speak of, one of one sample no size at all.
double LightCompass::GetRadius() const
{
  double radius = std::min(this->HalfSize[0], this->HalfSize[1]);
  if (radius == 0.0)
  {
    radius = std::max(this->HalfSize[0], this->HalfSize[1]);
  }
  return this->PlaceFactor * (radius > 0.0 ? radius : 1.0);
}

//------------------------------------------------------------------------------
// How far lamps go; one that is farther already is not pulled back.
double LightCompass::GetFarthest(double now) const
{
  const double half = std::max({ this->HalfSize[0], this->HalfSize[1], this->GetRadius() });
  return std::max(FarthestLamp * 2.0 * half, std::abs(now));
}

//------------------------------------------------------------------------------
void LightCompass::Remember(const PlacedLight& light)
{
  const double level = std::hypot(light.Vector[0], light.Vector[1]);
  if (!light.Positional && level > SmallestLevel)
  {
    this->Azimuth[0] = light.Vector[0] / level;
    this->Azimuth[1] = light.Vector[1] / level;
  }
}

//------------------------------------------------------------------------------
void LightCompass::SetSun(double altitude, PlacedLight& light) const
{
  const double level = vtkReliefCosDegrees(altitude);
  light.Vector[0] = level * this->Azimuth[0];
  light.Vector[1] = level * this->Azimuth[1];
  light.Vector[2] = vtkReliefSinDegrees(altitude);
}

//------------------------------------------------------------------------------
void LightCompass::GetDot(const PlacedLight& light, double dot[2]) const
{
  std::copy_n(light.Vector, 2, dot);
  if (!light.Positional)
  {
    const double distance = this->GetRadius() * (1.0 - AltitudeOf(light) / 90.0);
    dot[0] = distance * this->Azimuth[0];
    dot[1] = distance * this->Azimuth[1];
  }
}

//------------------------------------------------------------------------------
void LightCompass::SetDot(const double dot[2], PlacedLight& light)
{
  if (light.Positional)
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      const double farthest = this->GetFarthest(light.Vector[axis]);
      light.Vector[axis] = std::clamp(dot[axis], -farthest, farthest);
    }
    return;
  }
  const double distance = std::hypot(dot[0], dot[1]) / this->GetRadius();
  this->Remember({ false, { dot[0] / this->GetRadius(), dot[1] / this->GetRadius(), 0.0 } });
  this->SetSun(std::max(90.0 * (1.0 - distance), this->LowestAltitude), light);
}

//------------------------------------------------------------------------------
void LightCompass::Raise(PlacedLight& light, double steps) const
{
  if (light.Positional)
  {
    // asinh is the logarithm of large heights and passes through 0.
    const double smallest = SmallestHeight * this->GetRadius();
    const double height = light.Vector[2] - this->MeanHeight;
    const double farthest = this->GetFarthest(height);
    const double raised = smallest * std::sinh(std::asinh(height / smallest) + RaiseStep * steps);
    light.Vector[2] = this->MeanHeight + std::clamp(raised, -farthest, farthest);
    return;
  }
  // A sun that is lower already than dots go may rise, and is not thrown up.
  const double now = AltitudeOf(light);
  this->SetSun(std::clamp(now + steps, std::min(now, this->LowestAltitude), 90.0), light);
}

//------------------------------------------------------------------------------
double LightCompass::ToSun(PlacedLight& light) const
{
  double* v = light.Vector;
  v[2] -= this->MeanHeight;
  const double distance = vtkMath::Normalize(v);
  if (distance == 0.0)
  {
    v[2] = 1.0;
  }
  light.Positional = false;
  return distance;
}

//------------------------------------------------------------------------------
void LightCompass::ToLamp(PlacedLight& light, double distance) const
{
  double* v = light.Vector;
  if (distance == 0.0)
  {
    distance = this->GetFarthest(0.0);
    for (int axis = 0; axis < 2; ++axis)
    {
      const double half = std::max(this->HalfSize[axis], 0.1 * this->GetRadius());
      distance = std::min(distance, EdgeMargin * half / std::abs(v[axis]));
    }
  }
  vtkMath::MultiplyScalar(v, distance);
  v[2] += this->MeanHeight;
  light.Positional = true;
}
}
