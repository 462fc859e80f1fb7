// SPDX-License-Identifier: BSD-3-Clause
//
// The texts of the shading programs, put together as ReliefPrograms.cxx does it for the desktop: each holds
// what a scene calls for and nothing else. Only the header differs, which makes them GLSL ES 3.00.

import { texts } from './shaders.js';

const FLT_MIN = 1.1754943508222875e-38;
const FLT_EPSILON = 1.1920928955078125e-7;

// How many lights a program for gathering adds at once, at most.
export const MOST_GATHERED = 4;

// Keeps of a text what the features ask for.
export function selectLines(text, features)
{
  const kept = []; // of the enclosing conditions
  const result = [];
  const lines = text.split('\n');
  if (lines[lines.length - 1] === '')
  {
    lines.pop();
  }
  for (const line of lines)
  {
    const at = line.indexOf('//RELIEF::');
    if (at < 0)
    {
      if (kept.every(Boolean))
      {
        result.push(line);
      }
      continue;
    }
    const [what, name] = line.slice(at + 10).trim().split(/\s+/);
    if (what === 'If' && name)
    {
      kept.push(features.has(name));
    }
    else if (what === 'Else' && kept.length > 0)
    {
      kept.push(!kept.pop());
    }
    else if (what === 'End' && kept.length > 0)
    {
      kept.pop();
    }
    else
    {
      throw new Error(`in a shader: ${line}`);
    }
  }
  if (kept.length > 0)
  {
    throw new Error('in a shader: //RELIEF::End is missing');
  }
  return result.join('\n') + '\n';
}

function featuresOf(wanted)
{
  return new Set(Object.keys(wanted).filter((name) => wanted[name]));
}

function lightFeatures(light)
{
  return {
    Positional: light.positional,
    SurfaceNormal: light.surfaceNormal,
    TangentPlane: light.tangentPlane,
    Exponential: light.exponential,
    Floor: light.floor,
    Deep: light.deep,
    FixedStep: light.fixedStep,
    Combined: light.combined,
    Igor: light.igor,
  };
}

// In place of the function of that name, for the texts that follow it.
const LEVEL_BEYOND = '#define reliefNeverReturns(field, ray, s, axis) false\n';

// A quick one takes the ground beyond the data for level, as long as something coarse is to be shown: it is
// compiled in half the time.
export function traceText(light, quick = false)
{
  const features = featuresOf({
    ...lightFeatures(light),
    Normals: light.surfaceNormal || light.combined || light.igor,
  });
  return texts.ReliefPreludeGLSL + selectLines(texts.ReliefField, features) + texts.ReliefLeaves +
    texts.ReliefModel + texts.ReliefSurface + texts.ReliefSurroundings + (quick ? LEVEL_BEYOND : '') +
    texts.ReliefThickness + texts.ReliefGrid + selectLines(texts.ReliefLight, features) +
    selectLines(texts.ReliefTraceFS, features);
}

export function gatherText(light, sums, lights)
{
  const direction = sums.scatter || sums.specular;
  const needsRay = direction && light.positional;
  const needsNormal = sums.specular || (needsRay && light.surfaceNormal);
  const features = featuresOf({
    Diffuse: sums.diffuse,
    Scatter: sums.scatter,
    Specular: sums.specular,
    Illumination: sums.diffuse || sums.scatter,
    Direction: direction,
    Normals: needsNormal,
    Surface: needsNormal || needsRay,
    Second: lights > 1,
    Third: lights > 2,
    Fourth: lights > 3,
    Positional: needsRay,
    SurfaceNormal: light.surfaceNormal,
    TangentPlane: light.tangentPlane,
  });
  let text = `#define LIGHTS ${lights}\n`;
  let output = 0;
  for (const [name, wanted] of [['DIFFUSE_SUM', sums.diffuse], ['SCATTER_SUM', sums.scatter],
    ['SPECULAR_SUM', sums.specular]])
  {
    if (wanted)
    {
      text += `#define ${name} gl_FragData[${output++}]\n`;
    }
  }
  text += texts.ReliefPreludeGLSL + selectLines(texts.ReliefField, features) + texts.ReliefLeaves +
    texts.ReliefModel;
  text += needsRay || needsNormal ? texts.ReliefSurface : '';
  text += needsRay ? texts.ReliefSurroundings + texts.ReliefThickness : '';
  text += texts.ReliefGrid;
  text += needsRay ? selectLines(texts.ReliefLight, features) : '';
  return text + selectLines(texts.ReliefGatherFS, features);
}

export function composeText(compose)
{
  const { sums } = compose;
  const any = sums.diffuse || sums.scatter || sums.specular;
  const features = featuresOf({
    Diffuse: sums.diffuse,
    Scatter: sums.scatter,
    Specular: sums.specular,
    DiffuseColor: sums.diffuse || sums.scatter,
    First: compose.first && any,
    Later: compose.later && any,
    BaseTexture: compose.baseTexture,
    DiffuseTexture: compose.diffuseTexture,
    SpecularTexture: compose.specularTexture,
  });
  return texts.ReliefPreludeGLSL + selectLines(texts.ReliefField, features) + texts.ReliefLeaves +
    texts.ReliefModel + texts.ReliefGrid + selectLines(texts.ReliefComposeFS, features);
}

// What comes before a text: the version, the precisions, and names for what it draws into.
export function webHeader(text, { nanByBits = false } = {})
{
  const outputs = new Set(text.match(/gl_FragData\[\d\]/g));
  let header = '#version 300 es\n' +
    'precision highp float;\nprecision highp int;\n' +
    'precision highp sampler2D;\nprecision highp sampler3D;\n';
  if (nanByBits)
  {
    // For compilers that take it for granted that every number is one.
    header += '#define isnan(x) ((floatBitsToUint(x) & 0x7fffffffu) > 0x7f800000u)\n';
  }
  for (let k = 0; k < outputs.size; ++k)
  {
    header += `layout(location = ${k}) out vec4 fragOutput${k};\n`;
  }
  return header;
}

// A text as WebGL 2 takes it.
export function webProgram(text, options)
{
  return webHeader(text, options) + text.replace(/gl_FragData\[(\d)\]/g, 'fragOutput$1');
}

// A triangle over the whole of what is drawn into.
export const VERTEX_PROGRAM = `#version 300 es
out vec2 texCoord;
void main()
{
  vec2 corner = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));
  texCoord = corner;
  gl_Position = vec4(2.0 * corner - 1.0, 0.0, 1.0);
}
`;

// Shows the colours of a grid: between its texels they are interpolated, with a filter of its own, since not
// every processor filters floats.
export function displayText()
{
  return texts.ReliefPreludeGLSL + texts.ReliefLeaves + texts.ReliefModel + `
uniform sampler2D colors;
uniform ivec2 gridFirst;
uniform vec2 gridStride;
uniform ivec2 gridSize;
uniform vec2 viewOrigin; // the sample in the picture's lower left corner
uniform vec2 viewStep;   // samples for a pixel
uniform vec2 fieldSize;
uniform float exposure;
uniform bool encoded;
uniform vec4 background;
void main()
{
  vec2 at = viewOrigin + gl_FragCoord.xy * viewStep;
  if (any(lessThan(at, vec2(0.0))) || any(greaterThanEqual(at, fieldSize)))
  {
    gl_FragData[0] = background;
    return;
  }
  vec2 place = at / gridStride - vec2(gridFirst) - 0.5;
  // Rounding must not blend where texels and pixels are the same.
  vec2 nearest = floor(place + 0.5);
  place = mix(place, nearest, vec2(lessThan(abs(place - nearest), vec2(1.0e-3))));
  vec2 low = floor(place);
  vec2 share = place - low;
  ivec2 last = gridSize - 1;
  ivec2 a = clamp(ivec2(low), ivec2(0), last);
  ivec2 b = clamp(ivec2(low) + 1, ivec2(0), last);
  vec4 south = mix(texelFetch(colors, a, 0), texelFetch(colors, ivec2(b.x, a.y), 0), share.x);
  vec4 north = mix(texelFetch(colors, ivec2(a.x, b.y), 0), texelFetch(colors, b, 0), share.x);
  vec4 color = mix(south, north, share.y);
  if (!encoded)
  {
    gl_FragData[0] = color;
    return;
  }
  // Beside samples without data colour and alpha fall off together.
  vec3 shown = exposure * vec3(color) / max(color.w, 1.0e-6);
  vec3 code = vec3(reliefEncode(shown.x), reliefEncode(shown.y), reliefEncode(shown.z));
  gl_FragData[0] = vec4(code * color.w, color.w) + (1.0 - color.w) * background;
}
`;
}

// The sum of two textures, for processors that do not blend floats.
export function sumText()
{
  return `uniform sampler2D first;
uniform sampler2D second;
void main()
{
  ivec2 at = ivec2(gl_FragCoord.xy);
  gl_FragData[0] = texelFetch(first, at, 0) + texelFetch(second, at, 0);
}
`;
}

// 1 where infinity and what is no number are what they should be, as the model uses them: as constants, in
// textures, computed and compared.
export function probeText()
{
  return texts.ReliefPreludeGLSL + `
uniform sampler2D given; // NaN, infinity, 1, 0
float taken(int k)
{
  return texelFetch(given, ivec2(k, 0), 0).x;
}
void main()
{
  float none = taken(0);
  float endless = taken(1);
  float one = taken(2);
  float zero = taken(3);
  bool constants = isnan(RELIEF_NAN) && !isnan(RELIEF_INFINITY) && RELIEF_INFINITY > 3.0e38 &&
    -RELIEF_INFINITY < -3.0e38 && endless >= RELIEF_INFINITY && one / zero >= RELIEF_INFINITY &&
    isnan(one * RELIEF_NAN) && isnan(RELIEF_NAN - RELIEF_NAN) && !(one < RELIEF_NAN) && !(RELIEF_NAN < one);
  bool textures = isnan(none) && !isnan(endless) && !isnan(one) && !isnan(zero);
  bool computed = isnan(none - one) && isnan((none - one) - (zero - one)) && isnan(one + none) &&
    isnan(endless - endless) && isnan(zero / zero) && one / endless == 0.0;
  bool compared = !(none < one) && !(none > one) && !(none == none) && !(one <= none) && one < endless &&
    min(one, endless) == one && max(-endless, one) == one;
  gl_FragData[0] = vec4(constants && textures && computed && compared ? 1.0 : 0.0,
    float(constants), float(textures), float(computed));
}
`;
}

//--------------------------------------------------------------------------------------------------
// Which programs a scene's passes are made with: a key that is the same for the same text, and the text.

// What is made of so small a depth would have few digits; d is its limit, to all that float has.
export function singleDepth(medium)
{
  const depth = Math.fround(medium.depth);
  return depth < FLT_MIN / FLT_EPSILON ? 0 : depth;
}

function keyOf(kind, features)
{
  return kind + Object.keys(features).filter((name) => features[name]).join(' ');
}

function featuresOfLight(scene, light)
{
  const { medium } = scene;
  return {
    positional: light.positional,
    surfaceNormal: medium.surfaceNormal,
    tangentPlane: medium.tangentPlane,
    exponential: medium.exponential,
    floor: medium.useFloor,
    deep: medium.exponential || singleDepth(medium) > 0,
    fixedStep: scene.fixedStep,
    combined: scene.combined,
    igor: scene.igor,
  };
}

export function traceProgram(scene, light, quick)
{
  const features = featuresOfLight(scene, light);
  return { key: keyOf(quick ? 'quick trace ' : 'trace ', features), text: () => traceText(features, quick) };
}

// For so many lights at once, of which one is given.
export function gatherProgram(scene, light, wanted, count)
{
  const positional = !light.directional && (wanted.scatter || wanted.specular);
  const features = { ...featuresOfLight(scene, light), positional };
  const { surfaceNormal, tangentPlane } = features;
  const key = keyOf('gather', { positional, surfaceNormal, tangentPlane, ...wanted });
  return { key: `${key}${count}`, text: () => gatherText(features, wanted, count), positional };
}

export function composeProgram(first, later, sums, textures)
{
  const compose = {
    sums, first, later,
    baseTexture: Boolean(textures.base),
    diffuseTexture: (sums.diffuse || sums.scatter) && Boolean(textures.diffuse),
    specularTexture: sums.specular && Boolean(textures.specular),
  };
  const key = keyOf('compose', { ...sums, ...compose, sums: false });
  return { key, text: () => composeText(compose), compose };
}

export const DISPLAY = { key: 'display', text: displayText };
export const SUM = { key: 'sum', text: sumText };
