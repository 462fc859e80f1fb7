// SPDX-License-Identifier: BSD-3-Clause
//
// Adds LIGHTS lights to the sums over the lights that the integrated equation needs, without the
// material's colours: these may then change without a light being looked at again.

uniform vec3 lightRadiance[LIGHTS]; // weight, intensity and colour
//RELIEF::If Direction
//RELIEF::If Positional
//RELIEF::Else
uniform vec3 lightToward[LIGHTS]; // unit vectors
//RELIEF::End
//RELIEF::End
//RELIEF::If Illumination
uniform sampler2D illumination0;
//RELIEF::If Second
uniform sampler2D illumination1;
//RELIEF::End
//RELIEF::If Third
uniform sampler2D illumination2;
//RELIEF::End
//RELIEF::If Fourth
uniform sampler2D illumination3;
//RELIEF::End
uniform ivec2 illuminationFirst; // their grid
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
  //RELIEF::If Diffuse
  vec3 diffuse = vec3(0.0);
  //RELIEF::End
  //RELIEF::If Scatter
  ReliefFalloff toward = ReliefFalloff(scatterFalloff.x, scatterFalloff.y, scatterFalloff.z);
  vec3 scatter = vec3(0.0);
  //RELIEF::End
  //RELIEF::If Specular
  ReliefFalloff mirrored = ReliefFalloff(specularFalloff.x, specularFalloff.y, specularFalloff.z);
  vec3 specular = vec3(0.0);
  //RELIEF::End
  //RELIEF::If Illumination
  ivec2 texel = gridTexel(at, illuminationFirst, illuminationStride, illuminationSize);
  float d[LIGHTS];
  d[0] = texelFetch(illumination0, texel, 0).x;
  //RELIEF::If Second
  d[1] = texelFetch(illumination1, texel, 0).x;
  //RELIEF::End
  //RELIEF::If Third
  d[2] = texelFetch(illumination2, texel, 0).x;
  //RELIEF::End
  //RELIEF::If Fourth
  d[3] = texelFetch(illumination3, texel, 0).x;
  //RELIEF::End
  //RELIEF::End
  //RELIEF::If Surface
  if (!isnan(reliefHeight(0, at.x, at.y)))
  //RELIEF::End
  {
    //RELIEF::If Normals
    vec3 n = reliefNormal(0, at.x, at.y);
    //RELIEF::End
    for (int k = 0; k < LIGHTS; ++k)
    {
      //RELIEF::If Direction
      //RELIEF::If Positional
      vec3 l;
      //RELIEF::If Normals
      lightRay(lightMedium(), at, n, l);
      //RELIEF::Else
      lightRay(lightMedium(), at, vec3(0.0, 0.0, 1.0), l);
      //RELIEF::End
      //RELIEF::Else
      vec3 l = lightToward[k];
      //RELIEF::End
      //RELIEF::End
      //RELIEF::If Diffuse
      diffuse += d[k] * lightRadiance[k];
      //RELIEF::End
      //RELIEF::If Scatter
      scatter += (reliefForwardScatter(toward, l) * d[k]) * lightRadiance[k];
      //RELIEF::End
      //RELIEF::If Specular
      specular += reliefSpecularity(mirrored, n, l) * lightRadiance[k];
      //RELIEF::End
    }
  }
  //RELIEF::If Diffuse
  DIFFUSE_SUM = vec4(diffuse, 0.0);
  //RELIEF::End
  //RELIEF::If Scatter
  SCATTER_SUM = vec4(scatter, 0.0);
  //RELIEF::End
  //RELIEF::If Specular
  SPECULAR_SUM = vec4(specular, 0.0);
  //RELIEF::End
}
