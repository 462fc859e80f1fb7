// SPDX-License-Identifier: BSD-3-Clause
//
// A light and the ray toward it.

uniform float mediumDepth;
//RELIEF::If Exponential
uniform float mediumDensity;
//RELIEF::End
//RELIEF::If Floor
uniform float mediumFloor;
//RELIEF::End
uniform float mediumTolerance;
//RELIEF::If Positional
uniform ivec2 lightSample; // the sample that the light stands above, not necessarily in the image
uniform vec3 lightVector;  // its position from there, at height 0
//RELIEF::Else
uniform vec3 lightVector; // unit vector toward it
//RELIEF::End

ReliefMedium lightMedium()
{
  ReliefMedium medium;
  medium.depth = mediumDepth;
  //RELIEF::If SurfaceNormal
  medium.offset = RELIEF_SURFACE_NORMAL;
  //RELIEF::Else
  //RELIEF::If TangentPlane
  medium.offset = RELIEF_TANGENT_PLANE;
  //RELIEF::Else
  medium.offset = RELIEF_VERTICAL;
  //RELIEF::End
  //RELIEF::End
  //RELIEF::If Exponential
  medium.attenuation = RELIEF_EXPONENTIAL;
  medium.density = mediumDensity;
  //RELIEF::Else
  medium.attenuation = RELIEF_RECIPROCAL;
  medium.density = 0.0;
  //RELIEF::End
  //RELIEF::If Floor
  medium.useFloor = true;
  medium.floorHeight = mediumFloor;
  //RELIEF::Else
  medium.useFloor = false;
  medium.floorHeight = 0.0;
  //RELIEF::End
  medium.tolerance = mediumTolerance;
  return medium;
}

ReliefRay lightRay(ReliefMedium medium, ivec2 at, vec3 n, out vec3 l)
{
  //RELIEF::If Positional
  // Whole samples are subtracted first, or a light far away would lose its place among them.
  vec3 light =
    lightVector + vec3(vec2(lightSample - at) * reliefSpacing, -reliefHeight(0, at.x, at.y));
  return reliefRay(0, medium, at.x, at.y, n, light, true, l);
  //RELIEF::Else
  return reliefRay(0, medium, at.x, at.y, n, lightVector, false, l);
  //RELIEF::End
}
