// SPDX-License-Identifier: BSD-3-Clause
//
// A scene, as scene files have it, checked and made what the shading programs take; which of its effects
// show, and what it wants of each light. As SceneConversion, LightSampling and EffectPlan do it.

import { ReliefError } from './error.js';

export const VERTICAL = 0;
export const SURFACE_NORMAL = 1;
export const TANGENT_PLANE = 2;
export const ILLUMINATION = 0;
export const COMBINED = 1;
export const IGOR = 2;

// The model's single precision needs room, and what is beyond looks the same.
const LARGEST_LENGTH = 1e32;
const LARGEST_COLOR = 1e6;
const LARGEST_RADIANCE = 1e30;
const LARGEST_NUMBER = 1e30;
const LARGEST_HEIGHT = 4e37;
const GOLDEN_RATIO = (1 + Math.sqrt(5)) / 2;

//--------------------------------------------------------------------------------------------------
// The table of parameters: default, and what is taken.

const number = (usual, least = -Infinity, most = Infinity) => ({ kind: 'number', usual, least, most });
const count = (usual, least, most) => ({ kind: 'count', usual, least, most });
const flag = (usual) => ({ kind: 'flag', usual });
const color = (usual, least = 0) => ({ kind: 'color', usual, least });
const range = (usual) => ({ kind: 'range', usual });
const choice = (names) => ({ kind: 'choice', usual: 0, names });

const SCENE = {
  heightScale: number(1),
  integrator: choice(['Exact', 'FixedStep']),
  tolerance: number(0.0003, 0),
  numberOfSteps: count(256, 1, 1000000),
  response: choice(['Illumination', 'Combined', 'Igor']),
  numberOfSunSamples: count(16, 1, 4096),
  exposure: number(0, -20, 20),
  automaticExposure: flag(false),
};

const MATERIAL = {
  baseColor: color([0, 0, 0]),
  diffuseColor: color([1, 1, 1]),
  specularColor: color([1, 1, 1]),
  specularCoefficient: number(0, 0, 1),
  specularRange: range([0, 1]),
  specularPower: number(1, 0),
  forwardScatterCoefficient: number(0, 0, 1),
  forwardScatterRange: range([0, 1]),
  forwardScatterPower: number(1, 0),
  subsurfaceDepth: number(1, 0),
  automaticSubsurfaceDepth: flag(true),
  offsetMode: { ...choice(['Vertical', 'SurfaceNormal', 'TangentPlane']), usual: TANGENT_PLANE },
  attenuation: choice(['Reciprocal', 'Exponential']),
  density: number(1, 0),
  useFloor: flag(false),
  floorHeight: number(0),
};

const LIGHT = {
  angularDiameter: number(0, 0, 90),
  color: color([1, 1, 1], -Infinity),
  intensity: number(1),
  on: flag(true),
};

// One of the lights that stand for an environment.
const SAMPLE = {
  color: color([1, 1, 1], -Infinity),
  intensity: number(1),
  weight: number(1),
  toleranceScale: number(1, 0),
};

function readWord(row, value)
{
  const plain = (text) => text.replace(/[-_ ]/g, '').toLowerCase();
  // The command line has a short word for this one.
  const given = plain(String(value)) === 'normal' ? 'surfacenormal' : plain(String(value));
  const at = row.names.findIndex((name) => plain(name) === given);
  return at >= 0 ? at : undefined;
}

function readNumbers(value, length)
{
  const numbers = Array.isArray(value) || ArrayBuffer.isView(value) ? Array.from(value) : [];
  return numbers.length === length && numbers.every(Number.isFinite) ? numbers : undefined;
}

// A value of a row, or undefined where it takes none such.
function readValue(row, value)
{
  switch (row.kind)
  {
    case 'number':
      return Number.isFinite(value) && value >= row.least && value <= row.most ? value : undefined;
    case 'count':
      return Number.isInteger(value) && value >= row.least && value <= row.most ? value : undefined;
    case 'flag':
      return typeof value === 'boolean' ? value : undefined;
    case 'choice':
      return readWord(row, value);
    case 'range':
    {
      const ends = readNumbers(value, 2);
      return ends && ends[0] <= ends[1] ? ends : undefined;
    }
    default:
    {
      const parts = readNumbers(value, 3);
      return parts && parts.every((c) => c >= row.least) ? parts : undefined;
    }
  }
}

function expected(row)
{
  const between = (what) => row.most < Infinity ? `${what} from ${row.least} to ${row.most}`
    : row.least > -Infinity ? `${what} of at least ${row.least}` : what;
  const words = {
    number: () => between('a number'),
    count: () => between('a whole number'),
    flag: () => 'true or false',
    choice: () => `one of ${row.names.join(', ')}`,
    range: () => 'two numbers, the first not the larger',
    color: () => (row.least > -Infinity ? 'three numbers of at least 0' : 'three numbers'),
  };
  return words[row.kind]();
}

// Values by a table, with defaults for those that are missing; other keys are allowed if named.
function readTable(table, object, where, others = [])
{
  if (object === null || typeof object !== 'object' || Array.isArray(object))
  {
    throw new ReliefError(`${where || 'the scene'} is ${JSON.stringify(object)}: an object is expected`);
  }
  const at = (key) => (where ? `${where}.${key}` : key);
  const unknown = Object.keys(object).find((key) => !(key in table) && !others.includes(key));
  if (unknown !== undefined)
  {
    throw new ReliefError(`${at(unknown)} is not known: leave it out, or look at its spelling`);
  }
  const values = {};
  for (const [key, row] of Object.entries(table))
  {
    values[key] = object[key] === undefined ? row.usual : readValue(row, object[key]);
    if (values[key] === undefined)
    {
      throw new ReliefError(
        `${at(key)}: ${JSON.stringify(object[key])} was given, ${expected(row)} is expected`);
    }
  }
  return values;
}

// By the owners that the parameters' table has; an environment is given as lights.
export const TABLES = { Scene: SCENE, Material: MATERIAL, Light: LIGHT };

//--------------------------------------------------------------------------------------------------
// Lights

function degrees(angle)
{
  return (angle * Math.PI) / 180;
}

// Exact at multiples of a right angle.
function cosine(angle)
{
  return Math.abs(angle % 180) === 90 ? 0 : Math.cos(degrees(angle));
}

function sine(angle)
{
  return angle % 180 === 0 ? 0 : Math.sin(degrees(angle));
}

function normalized(v)
{
  const length = Math.hypot(...v);
  return v.map((c) => c / length);
}

function readDirection(value, where)
{
  const vector = readNumbers(value, 3);
  if (!vector || Math.hypot(...vector) === 0)
  {
    throw new ReliefError(`${where}: ${JSON.stringify(value)} was given, a vector toward the light is expected`);
  }
  return normalized(vector);
}

function sunDirection(light, where)
{
  if (!Number.isFinite(light.azimuth) || !Number.isFinite(light.altitude))
  {
    throw new ReliefError(`${where} has no direction: azimuth and altitude, in degrees, are expected`);
  }
  const level = cosine(light.altitude);
  const vector = [sine(light.azimuth) * level, cosine(light.azimuth) * level, sine(light.altitude)];
  // A light that was dragged has the last digits of its direction, too.
  const toward = light.toward && readDirection(light.toward, `${where}.toward`);
  return toward && vector.every((c, k) => Math.abs(c - toward[k]) < 2e-10) ? toward : vector;
}

// A sun's disc as lights of equal weight, as SampleDisc() has it.
function sampleDisc(sun, diameter, samples)
{
  if (diameter === 0 || samples === 1)
  {
    return [sun];
  }
  const axis = sun.vector;
  const level = Math.hypot(axis[0], axis[1]);
  const right = level > 0 ? [-axis[1] / level, axis[0] / level, 0] : [1, 0, 0];
  const up = [axis[1] * right[2] - axis[2] * right[1], axis[2] * right[0] - axis[0] * right[2],
    axis[0] * right[1] - axis[1] * right[0]];
  const s = Math.sin(0.25 * diameter);
  const area = 2 * s * s; // 1 - cos(diameter / 2)
  const odd = samples % 2;
  return Array.from({ length: samples }, (_, k) =>
  {
    const pair = Math.floor((k + odd) / 2);
    const m = k < odd ? 0 : (area * (2 * pair + 1 - odd)) / samples;
    const angle = Math.PI * (GOLDEN_RATIO * pair + ((k + odd) % 2));
    const away = Math.sqrt(m * (2 - m));
    const vector = axis.map((a, c) =>
      (1 - m) * a + away * (Math.cos(angle) * right[c] + Math.sin(angle) * up[c]));
    return { ...sun, vector: normalized(vector), weight: sun.weight / samples };
  });
}

function readLight(light, where)
{
  const values = readTable(LIGHT, light, where,
    ['kind', 'type', 'azimuth', 'altitude', 'toward', 'position']);
  const kind = light.kind ?? light.type;
  const positional = kind === 'point' || kind === 'lamp';
  if (!positional && kind !== 'sun')
  {
    throw new ReliefError(`${where}.kind: ${JSON.stringify(kind)} was given, "sun" or "point" is expected`);
  }
  const position = positional ? readNumbers(light.position, 3) : null;
  if (positional && !position)
  {
    throw new ReliefError(`${where}.position: ${JSON.stringify(light.position)} was given, ` +
      'three coordinates are expected');
  }
  return {
    on: values.on, color: values.color, intensity: values.intensity, weight: 1, toleranceScale: 1,
    positional, vector: position ?? sunDirection(light, where),
    diameter: positional ? 0 : degrees(values.angularDiameter),
  };
}

function readSample(sample, where)
{
  const values = readTable(SAMPLE, sample, where, ['direction']);
  return {
    on: true, color: values.color, intensity: values.intensity, weight: values.weight,
    toleranceScale: values.toleranceScale, positional: false,
    vector: readDirection(sample.direction, `${where}.direction`), diameter: 0, sampled: true,
  };
}

function readList(list, where, read)
{
  if (!Array.isArray(list))
  {
    throw new ReliefError(`${where} is ${JSON.stringify(list)}: an array is expected`);
  }
  return list.map((one, k) => read(one, `${where}[${k}]`));
}

//--------------------------------------------------------------------------------------------------
// Textures

const TEXTURES = ['base', 'diffuse', 'specular'];

function readTexture(texture, where)
{
  const { width, height, data } = texture ?? {};
  const components = texture?.components ?? (data ? data.length / (width * height) : 0);
  if (!ArrayBuffer.isView(data) || ![1, 2, 3, 4].includes(components) ||
    data.length !== width * height * components)
  {
    throw new ReliefError(`${where} is no picture: an ImageData, or width, height and data of 1 to 4 ` +
      'components a texel, is expected');
  }
  const types = [[Uint8Array, 255], [Uint8ClampedArray, 255], [Uint16Array, 65535], [Float32Array, 0],
    [Float64Array, 0]];
  const type = types.find(([array]) => data instanceof array);
  if (!type)
  {
    throw new ReliefError(`${where} has texels of an unknown type: 8 or 16 bits without sign, or floats, ` +
      'are expected');
  }
  return { width, height, data, components, white: type[1] };
}

// Checks a scene, whatever field it is for.
export function readScene(scene)
{
  const values = readTable(SCENE, scene, '',
    ['reliefScene', 'material', 'lights', 'environment', 'environmentLights', 'textures']);
  if (scene.environment && !scene.environmentLights)
  {
    throw new ReliefError('environment was given without environmentLights: the lights that stand for it ' +
      'are expected');
  }
  const material = readTable(MATERIAL, scene.material ?? {}, 'material');
  const given = scene.material ?? {};
  // A depth turns the automatic one off, and so does an exposure.
  material.automaticSubsurfaceDepth =
    given.automaticSubsurfaceDepth ?? given.subsurfaceDepth === undefined;
  values.automaticExposure = scene.automaticExposure ?? false;
  const textures = {};
  for (const [name, texture] of Object.entries(scene.textures ?? {}))
  {
    if (!TEXTURES.includes(name))
    {
      throw new ReliefError(`textures.${name} is not known: ${TEXTURES.join(', ')} are expected`);
    }
    if (texture)
    {
      textures[name] = readTexture(texture, `textures.${name}`);
    }
  }
  const lights = readList(scene.lights ?? [], 'lights', readLight);
  const samples = readList(scene.environmentLights ?? [], 'environmentLights', readSample);
  if (lights.length === 0 && !scene.environmentLights)
  {
    lights.push(readLight({ kind: 'sun', azimuth: 315, altitude: 45, intensity: 0.95 }, 'lights[0]'));
  }
  return { ...values, material, textures, lights: [...lights, ...samples] };
}

//--------------------------------------------------------------------------------------------------
// The scene over a field

const bounded = (value, largest) => Math.min(Math.max(value, -largest), largest);

function falloff(ends, power)
{
  return [bounded(ends[0], LARGEST_NUMBER), bounded(ends[1], LARGEST_NUMBER), bounded(power, LARGEST_NUMBER)];
}

// A lamp farther away stands in the same direction, and light that is stronger is as white.
function bound(light)
{
  const length = Math.hypot(...light.vector);
  const vector = light.positional && length > LARGEST_LENGTH
    ? light.vector.map((c) => c * (LARGEST_LENGTH / length)) : light.vector;
  const brightest = Math.max(...light.color.map(Math.abs)) * Math.abs(light.weight);
  const intensity = Math.abs(light.intensity) * brightest > LARGEST_RADIANCE
    ? Math.sign(light.intensity) * (LARGEST_RADIANCE / brightest) : light.intensity;
  return { ...light, vector, intensity };
}

export function placeScene(scene, field)
{
  const { material } = scene;
  const capped = (c) => c.map((x) => Math.min(x, LARGEST_COLOR));
  const depth = material.automaticSubsurfaceDepth
    ? (field.spacing[0] + field.spacing[1]) / 2 : material.subsurfaceDepth;
  const lights = [];
  for (const light of scene.lights.filter((one) => one.on))
  {
    const place = light.positional
      ? [light.vector[0] - field.origin[0], light.vector[1] - field.origin[1], light.vector[2] - field.datum]
      : light.vector;
    lights.push(...sampleDisc({ ...light, vector: place }, light.diameter, scene.numberOfSunSamples));
  }
  return {
    base: capped(material.baseColor),
    diffuse: capped(material.diffuseColor),
    specular: capped(material.specularColor),
    specularCoefficient: material.specularCoefficient,
    scatterCoefficient: material.forwardScatterCoefficient,
    specularFalloff: falloff(material.specularRange, material.specularPower),
    scatterFalloff: falloff(material.forwardScatterRange, material.forwardScatterPower),
    medium: {
      depth: Math.min(depth, LARGEST_LENGTH),
      offset: material.offsetMode,
      exponential: material.attenuation === 1,
      density: Math.min(material.density, LARGEST_NUMBER),
      useFloor: material.useFloor,
      floorHeight: bounded(material.floorHeight - field.datum, LARGEST_HEIGHT),
      tolerance: Math.min(scene.tolerance, 1),
    },
    fixedStep: scene.integrator === 1,
    steps: scene.numberOfSteps,
    response: scene.response,
    exposure: scene.exposure,
    automaticExposure: scene.automaticExposure,
    textures: scene.textures,
    lights: lights.map(bound),
  };
}

const isBlack = (c) => c[0] === 0 && c[1] === 0 && c[2] === 0;

function scattersForward(ends, up)
{
  const [lo, hi] = ends;
  const x = -up;
  return !(hi > lo) ? x >= hi : ends[2] === 0 || x > lo;
}

function onBoundingSphere(vector, field)
{
  const size = [(field.columns - 1) * field.spacing[0], (field.rows - 1) * field.spacing[1],
    field.hasData ? field.top - field.bottom : 0];
  const middle = [size[0] / 2, size[1] / 2, (field.hasData ? field.bottom : 0) + size[2] / 2];
  return vector.map((c, k) => middle[k] + (c * Math.hypot(...size)) / 2);
}

// Which effects a scene calls for, and what it wants of each of its lights.
export function planEffects(field, scene)
{
  const { specularCoefficient: ks, scatterCoefficient: kf } = scene;
  const plan = { diffuse: false, scatter: false, specular: false, lights: [] };
  plan.matte = ks < 1 && (Boolean(scene.textures.diffuse) || !isBlack(scene.diffuse));
  plan.mirror = ks > 0 && (Boolean(scene.textures.specular) || !isBlack(scene.specular));
  for (const light of scene.lights)
  {
    const directional = !light.positional;
    const strength = light.intensity * light.weight;
    const lit = strength !== 0 && !isBlack(light.color);
    // With the closed form r is infinite below the horizon, unless a floor ends it.
    const dark = directional && light.vector[2] < 0 && !scene.medium.useFloor && !scene.fixedStep;
    // Where all light is scattered forward, a sun from which none comes this way gives nothing.
    const never = directional && kf === 1 && !scattersForward(scene.scatterFalloff, light.vector[2]);
    const answers = scene.response !== ILLUMINATION;
    const matte = lit && plan.matte && (answers || !dark) && !never;
    const onSphere = scene.fixedStep && directional;
    plan.lights.push({
      directional,
      vector: light.vector,                 // toward a directional one
      positional: light.positional || onSphere, // as the integrator takes it
      traced: onSphere ? onBoundingSphere(light.vector, field) : light.vector,
      radiance: light.color.map((c) => Math.fround(c * strength)),
      toleranceScale: light.toleranceScale,
      one: light.weight === 1 && !light.sampled,
      matte,
      shows: matte || (lit && plan.mirror),
    });
    plan.diffuse = plan.diffuse || (matte && kf < 1);
    plan.scatter = plan.scatter || (matte && kf > 0);
    plan.specular = plan.specular || (lit && plan.mirror);
  }
  return plan;
}
