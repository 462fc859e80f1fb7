// SPDX-License-Identifier: BSD-3-Clause
//
// The integrated equation over the sums that have been gathered: linear colour, 0 where there is no
// data. The first sums are over the lights whose illumination is kept, the later ones over those that
// are added bit by bit.

uniform vec2 coefficients; // k_s and k_f
//RELIEF::If BaseTexture
uniform sampler2D baseColors;
//RELIEF::Else
uniform vec3 baseColor;
//RELIEF::End
//RELIEF::If DiffuseColor
//RELIEF::If DiffuseTexture
uniform sampler2D diffuseColors;
//RELIEF::Else
uniform vec3 diffuseColor;
//RELIEF::End
//RELIEF::End
//RELIEF::If Specular
//RELIEF::If SpecularTexture
uniform sampler2D specularColors;
//RELIEF::Else
uniform vec3 specularColor;
//RELIEF::End
//RELIEF::End
//RELIEF::If First
//RELIEF::If Diffuse
uniform sampler2D firstDiffuse;
//RELIEF::End
//RELIEF::If Scatter
uniform sampler2D firstScatter;
//RELIEF::End
//RELIEF::If Specular
uniform sampler2D firstSpecular;
//RELIEF::End
//RELIEF::End
//RELIEF::If Later
uniform vec3 laterScale;
uniform ivec2 laterFirst; // their grid
uniform vec2 laterStride;
uniform ivec2 laterSize;
//RELIEF::If Diffuse
uniform sampler2D laterDiffuse;
//RELIEF::End
//RELIEF::If Scatter
uniform sampler2D laterScatter;
//RELIEF::End
//RELIEF::If Specular
uniform sampler2D laterSpecular;
//RELIEF::End
//RELIEF::End

void main()
{
  ivec2 texel = gridHere();
  ivec2 at = gridSample(texel);
  if (isnan(reliefHeight(0, at.x, at.y)))
  {
    gl_FragData[0] = vec4(0.0);
    return;
  }
  //RELIEF::If BaseTexture
  vec3 baseColor = texelFetch(baseColors, texel, 0).xyz;
  //RELIEF::End
  //RELIEF::If DiffuseColor
  //RELIEF::If DiffuseTexture
  vec3 diffuseColor = texelFetch(diffuseColors, texel, 0).xyz;
  //RELIEF::End
  //RELIEF::End
  //RELIEF::If Specular
  //RELIEF::If SpecularTexture
  vec3 specularColor = texelFetch(specularColors, texel, 0).xyz;
  //RELIEF::End
  //RELIEF::End
  vec3 color = reliefBaseTerm(coefficients.x, baseColor);
  //RELIEF::If Later
  ivec2 later = gridTexel(at, laterFirst, laterStride, laterSize);
  //RELIEF::End
  //RELIEF::If Diffuse
  vec3 diffuse = vec3(0.0);
  //RELIEF::If First
  diffuse += texelFetch(firstDiffuse, texel, 0).xyz;
  //RELIEF::End
  //RELIEF::If Later
  diffuse += laterScale * texelFetch(laterDiffuse, later, 0).xyz;
  //RELIEF::End
  color += reliefDiffuseTerm(coefficients.x, coefficients.y, 1.0, diffuse, diffuseColor);
  //RELIEF::End
  //RELIEF::If Scatter
  vec3 scatter = vec3(0.0);
  //RELIEF::If First
  scatter += texelFetch(firstScatter, texel, 0).xyz;
  //RELIEF::End
  //RELIEF::If Later
  scatter += laterScale * texelFetch(laterScatter, later, 0).xyz;
  //RELIEF::End
  color += reliefScatterTerm(coefficients.x, coefficients.y, 1.0, 1.0, scatter, diffuseColor);
  //RELIEF::End
  //RELIEF::If Specular
  vec3 specular = vec3(0.0);
  //RELIEF::If First
  specular += texelFetch(firstSpecular, texel, 0).xyz;
  //RELIEF::End
  //RELIEF::If Later
  specular += laterScale * texelFetch(laterSpecular, later, 0).xyz;
  //RELIEF::End
  color += reliefSpecularTerm(coefficients.x, 1.0, specular, specularColor);
  //RELIEF::End
  gl_FragData[0] = vec4(color, 1.0);
}
