// SPDX-License-Identifier: BSD-3-Clause
//
// Adds one light, through blending, to the sums over the lights that the integrated equation needs,
// without the material's colours: these may then change without a light being looked at again.

//RELIEF::If Direction
//RELIEF::If Positional
//RELIEF::Else
uniform vec3 lightVector; // unit vector toward it
//RELIEF::End
//RELIEF::End
uniform vec3 lightRadiance; // weight, intensity and colour
//RELIEF::If Illumination
uniform sampler2D illumination;
uniform ivec2 illuminationFirst; // its grid
uniform vec2 illuminationStride;
uniform ivec2 illuminationSize;
//RELIEF::End
//RELIEF::If Scatter
uniform vec3 scatterFalloff; // lo, hi, power
//RELIEF::End
//RELIEF::If Specular
uniform vec3 specularFalloff;
//RELIEF::End

void main()
{
  ivec2 at = gridSample(gridHere());
  if (isnan(reliefHeight(0, at.x, at.y)))
  {
    discard;
  }
  //RELIEF::If Normals
  vec3 n = reliefNormal(0, at.x, at.y);
  //RELIEF::End
  //RELIEF::If Direction
  //RELIEF::If Positional
  //RELIEF::If Normals
  vec3 l;
  lightRay(lightMedium(), at, n, l);
  //RELIEF::Else
  vec3 l;
  lightRay(lightMedium(), at, vec3(0.0, 0.0, 1.0), l);
  //RELIEF::End
  //RELIEF::Else
  vec3 l = lightVector;
  //RELIEF::End
  //RELIEF::End
  //RELIEF::If Illumination
  float d = texelFetch(illumination,
    gridTexel(at, illuminationFirst, illuminationStride, illuminationSize), 0).x;
  //RELIEF::End
  //RELIEF::If Diffuse
  DIFFUSE_SUM = vec4(d * lightRadiance, 0.0);
  //RELIEF::End
  //RELIEF::If Scatter
  ReliefFalloff toward = ReliefFalloff(scatterFalloff.x, scatterFalloff.y, scatterFalloff.z);
  SCATTER_SUM = vec4((reliefForwardScatter(toward, l) * d) * lightRadiance, 0.0);
  //RELIEF::End
  //RELIEF::If Specular
  ReliefFalloff mirrored = ReliefFalloff(specularFalloff.x, specularFalloff.y, specularFalloff.z);
  SPECULAR_SUM = vec4(reliefSpecularity(mirrored, n, l) * lightRadiance, 0.0);
  //RELIEF::End
}
