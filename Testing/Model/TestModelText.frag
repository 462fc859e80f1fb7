#version 150
// SPDX-License-Identifier: BSD-3-Clause
//
// The smallest host that the model's text has as GLSL: heights in a texture, bounds in another, and
// a main that calls every entry point, so that none escapes the compiler.

//RELIEF::Prelude

uniform sampler2D heights;
uniform sampler2D bounds;
uniform vec2 spacing;
uniform float top;
uniform int levels;

int reliefColumns(int field)
{
  return textureSize(heights, 0).x;
}

int reliefRows(int field)
{
  return textureSize(heights, 0).y;
}

float reliefSpacingX(int field)
{
  return spacing.x;
}

float reliefSpacingY(int field)
{
  return spacing.y;
}

float reliefHeight(int field, int i, int j)
{
  return texelFetch(heights, ivec2(i, j), 0).x;
}

float reliefTop(int field)
{
  return top;
}

int reliefLevels(int field)
{
  return levels;
}

void reliefBounds(int field, int level, int i, int j, out float lo, out float hi)
{
  vec2 b = texelFetch(bounds, ivec2(i, j), level).xy;
  lo = b.x;
  hi = b.y;
}

//RELIEF::Model

uniform vec3 light;
uniform bool positional;
uniform vec3 coefficients;
uniform ReliefMedium medium;
uniform ReliefFalloff falloff;
out vec4 color;

void main()
{
  int field = 0;
  ivec2 at = ivec2(gl_FragCoord.xy);
  vec3 n = reliefNormal(field, at.x, at.y);
  vec3 l;
  ReliefRay ray = reliefRay(field, medium, at.x, at.y, n, light, positional, l);
  ReliefTrace trace;
  float d = reliefExact(field, medium, ray, n, l, trace);
  d += float(reliefStepCount(field, ray, 256)) + reliefIllumination(medium, trace.thickness);
  d = reliefResponse(positional ? RELIEF_COMBINED : RELIEF_IGOR, d, n, l);
  float f = reliefForwardScatter(falloff, l);
  float s = reliefSpecularity(falloff, n, l);
  vec3 sum = reliefBaseTerm(coefficients.x, n) +
    reliefDiffuseTerm(coefficients.x, coefficients.y, d, l, n) +
    reliefScatterTerm(coefficients.x, coefficients.y, f, d, l, n) +
    reliefSpecularTerm(coefficients.x, s, l, n);
  sum = reliefOver(vec3(reliefDecode(sum.x)), s, sum);
  color = vec4(reliefEncode(sum.x), reliefEncode(sum.y), reliefEncode(sum.z), 1.0);
}
