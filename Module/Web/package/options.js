// SPDX-License-Identifier: BSD-3-Clause
//
// Options as users write them, checked and made a description of a run.

import { parameters, usual } from "./parameters.js";
import { layerNames, presetNames } from "./module.js";
import {
  defaultOf,
  needFinite,
  needNumber,
  needObject,
  needVector,
  needWord,
  rangeError,
  readParameters,
  refuseUnknown,
  shown,
  typeError,
} from "./values.js";

const ofOwner = (...owners) => parameters.filter((row) => owners.includes(row.owner));
/** What scene, material and environment have, in the order of their numbers. */
export const numbered = ofOwner("scene", "material", "environment");
export const sceneRows = ofOwner("scene");
export const materialRows = ofOwner("material");
export const environmentRows = ofOwner("environment");
export const lightRows = ofOwner("light");

//--------------------------------------------------------------------------------------------------
// Lights.

function checkAngles(name, azimuth, altitude, low) {
  needNumber(`${name}.azimuth`, azimuth);
  needNumber(`${name}.altitude`, altitude);
  if (!Number.isFinite(azimuth) || !(altitude >= low && altitude <= 90)) {
    throw new RangeError(
      `${name}: azimuth ${azimuth}, altitude ${altitude} was given, a finite azimuth and an altitude in ` +
        `[${low}, 90] degrees are expected`,
    );
  }
}

const lightKeys = lightRows.map((row) => row.key);

function readSun(name, value) {
  if (Array.isArray(value) || ArrayBuffer.isView(value)) {
    if (value.length !== 2) {
      throw typeError(name, value, "[azimuth, altitude] or an object is");
    }
    return readSun(name, { azimuth: value[0], altitude: value[1] });
  }
  needObject(name, value, "[azimuth, altitude] or an object is");
  refuseUnknown(`${name}.`, value, ["kind", "azimuth", "altitude", "toward", ...lightKeys]);
  const { azimuth = usual.azimuth, altitude = usual.altitude, toward } = value;
  checkAngles(name, azimuth, altitude, -90);
  const light = { kind: "sun", azimuth, altitude, ...readParameters(lightRows, `${name}.`, value) };
  return toward === undefined ? light : { ...light, toward: needVector(`${name}.toward`, toward, 3) };
}

function readLamp(name, value) {
  if (Array.isArray(value) || ArrayBuffer.isView(value)) {
    return readLamp(name, { position: value });
  }
  needObject(name, value, "[x, y, z] or an object is");
  const rows = lightRows.filter((row) => !row.ofSuns);
  refuseUnknown(`${name}.`, value, ["kind", "position", ...rows.map((row) => row.key)]);
  return {
    kind: "point",
    position: needVector(`${name}.position`, value.position, 3, "a finite position is"),
    ...readParameters(rows, `${name}.`, value),
  };
}

function readLights(options) {
  const lights = [];
  const add = (name, read) => {
    if (options[name] !== undefined) {
      lights.push(read(name, options[name]));
    }
  };
  const addAll = (name, read) => {
    if (options[name] !== undefined) {
      if (!Array.isArray(options[name])) {
        throw typeError(name, options[name], "an array is");
      }
      options[name].forEach((light, k) => lights.push(read(`${name}[${k}]`, light)));
    }
  };
  add("sun", readSun);
  addAll("suns", readSun);
  add("lamp", readLamp);
  addAll("lamps", readLamp);
  addAll("lights", (name, light) => {
    const kind = needWord(`${name}.kind`, needObject(name, light).kind, ["sun", "point"]);
    return kind === 0 ? readSun(name, light) : readLamp(name, light);
  });
  return lights;
}

async function readPreset(options, presetLights) {
  const value = options.preset;
  const object =
    typeof value === "string" ? { name: value } : needObject("preset", value, "a name or an object is");
  refuseUnknown("preset.", object, ["name", "azimuth", "altitude"]);
  const name = presetNames[needWord("preset", object.name, presetNames)];
  const { azimuth = usual.azimuth, altitude = usual.altitude } = object;
  checkAngles("preset", azimuth, altitude, name === "sun-and-sky" ? 0 : -90);
  const placed = ["sun-and-sky", "combined", "igor"].includes(name);
  if (placed && (options.sun !== undefined || options.suns !== undefined)) {
    throw new TypeError(
      `${options.sun !== undefined ? "sun" : "suns"}: the preset "${name}" brings its own; place it by ` +
        `preset: { name: "${name}", azimuth: 315, altitude: 45 }`,
    );
  }
  if (!placed && (object.azimuth !== undefined || object.altitude !== undefined)) {
    throw new TypeError(`preset: "${name}" has no sun to be placed; leave azimuth and altitude out`);
  }
  return presetLights(name, azimuth, altitude);
}

const wordOf = (rows, key, place) => rows.find((row) => row.key === key).choices[place].word;

/** What a preset stands for, as options. */
export async function presetOptions(preset, presetLights) {
  const { lights, environment, response } = await readPreset({ preset }, presetLights);
  const options = { lights };
  if (environment) {
    const { azimuth, altitude, sampling, ...rest } = environment;
    const place = environment.image === "clearSky" ? { azimuth, altitude } : {};
    options.environment = { ...rest, ...place, sampling: wordOf(environmentRows, "sampling", sampling) };
  }
  return response === undefined ? options : { ...options, response: wordOf(sceneRows, "response", response) };
}

//--------------------------------------------------------------------------------------------------
// Pictures and the environment.

const texelTypes = [Uint8Array, Uint8ClampedArray, Uint16Array, Float32Array, Float64Array];

function readPicture(name, value) {
  const { data, width, height } = needObject(name, value, "{ data, width, height } is");
  if (!texelTypes.some((Type) => data instanceof Type)) {
    throw typeError(
      `${name}.data`,
      data,
      "an array of 8 or 16 bit (sRGB), Float32Array or Float64Array (linear) is",
    );
  }
  checkSize(name, width, height);
  if (![1, 2, 3, 4].includes(data.length / (width * height))) {
    throw rangeError(
      `${name}.data`,
      data,
      `1 (grey), 2 (grey, alpha), 3 (RGB) or 4 (RGB, alpha) for each of ${width} x ${height} texels are`,
    );
  }
  return { data, width, height };
}

// WebAssembly has room for so many, with a picture of floats.
const mostSamples = 2 ** 27;

export function checkSize(name, width, height) {
  for (const [key, size] of Object.entries({ width, height })) {
    const path = name === "" ? key : `${name}.${key}`;
    needNumber(path, size, "a whole number is");
    if (!Number.isInteger(size) || size < 1 || size > 2 ** 30) {
      throw rangeError(path, size, "a whole number in [1, 1073741824] is");
    }
  }
  if (width * height > mostSamples) {
    const path = name === "" ? "" : `${name}: `;
    throw new RangeError(
      `${path}width ${width} x height ${height} is too large, at most ${mostSamples} are expected; use parts`,
    );
  }
}

const imageWords = ["none", "whiteDome", "clearSky", "file"];
const environmentKeys = environmentRows.map((row) => row.key);

/** An environment, upon what a preset brings of one. */
function readEnvironment(value, ofPreset) {
  const object =
    typeof value === "string" ? { image: value } : needObject("environment", value, "a name or an object is");
  const { image, azimuth, altitude, turbidity, file } = object;
  refuseUnknown("environment.", object, [
    "image",
    "azimuth",
    "altitude",
    "turbidity",
    "file",
    ...environmentKeys,
  ]);
  if (image === undefined && !ofPreset) {
    throw typeError("environment.image", image, '"whiteDome", "clearSky" or { data, width, height } is');
  }
  if (image !== undefined && ofPreset) {
    throw new TypeError("environment.image: the sky of the preset is there already; leave one of them out");
  }
  const values = readParameters(environmentRows, "environment.", { ...ofPreset?.words, ...object });
  if (ofPreset) {
    return { ...ofPreset, ...values };
  }
  if (typeof image === "object" && image !== null) {
    return { image: "picture", picture: readPicture("environment.image", image), file, ...values };
  }
  const word = imageWords[needWord("environment.image", image, imageWords)];
  if (word === "file") {
    if (typeof file !== "string" || file === "") {
      throw typeError("environment.file", file, "a text is");
    }
    return { image: word, file, ...values };
  }
  if (word !== "clearSky") {
    return { image: word, ...values };
  }
  const haze = needNumber("environment.turbidity", turbidity ?? usual.turbidity);
  needNumber("environment.azimuth", azimuth);
  needNumber("environment.altitude", altitude);
  if (!Number.isFinite(azimuth) || !(altitude >= 0 && altitude <= 90) || !(haze >= 2 && haze <= 10)) {
    throw new RangeError(
      `environment: azimuth ${azimuth}, altitude ${altitude}, turbidity ${haze} was given, a finite azimuth, an ` +
        "altitude in [0, 90] degrees and a turbidity in [2, 10] are expected",
    );
  }
  return { image: word, azimuth, altitude, turbidity: haze, ...values };
}

// What a preset brings of an environment: its parameters as options, too.
function presetEnvironment({ image, azimuth, altitude, intensity, numberOfSamples, sampling }) {
  const choices = environmentRows.find((row) => row.key === "sampling").choices;
  const words = { intensity, numberOfSamples, sampling: choices[sampling].name };
  const values = readParameters(environmentRows, "environment.", words);
  const place = image === "clearSky" ? { azimuth, altitude, turbidity: usual.turbidity } : {};
  return { image, ...place, ...values, words };
}

//--------------------------------------------------------------------------------------------------
/** The options of a scene; others are those of a run. */
export const sceneKeys = [
  "preset",
  "sun",
  "suns",
  "lamp",
  "lamps",
  "lights",
  "environment",
  "depth",
  "floor",
  ...sceneRows.map((row) => row.key),
  ...materialRows.map((row) => row.key),
];
const textureKeys = { baseTexture: "base", diffuseTexture: "diffuse", specularTexture: "specular" };
const runKeys = [
  "width",
  "height",
  "spacing",
  "origin",
  "nodata",
  "mask",
  "layers",
  "output",
  ...Object.keys(textureKeys),
];

// Short names of parameters, as those.
function spelledOut(options) {
  const { depth, floor, ...rest } = options;
  if (depth !== undefined) {
    if (rest.subsurfaceDepth !== undefined) {
      throw new TypeError("depth: subsurfaceDepth was given, too, and is the same; leave one of them out");
    }
    rest.subsurfaceDepth = depth;
  }
  if (floor !== undefined && floor !== null) {
    if (rest.floorHeight !== undefined || rest.useFloor !== undefined) {
      throw new TypeError(
        "floor: floorHeight or useFloor was given, too, and is the same; leave one of them out",
      );
    }
    rest.floorHeight = needFinite("floor", floor);
    rest.useFloor = true;
  }
  return rest;
}

/** A scene that was checked: values of scene and material, lights, and the environment or null. */
export async function readScene(given, presetLights) {
  const options = spelledOut(given);
  const preset = options.preset === undefined ? null : await readPreset(options, presetLights);
  const fitted = options.heightScale === "auto";
  const scene = readParameters(sceneRows, "", fitted ? { ...options, heightScale: undefined } : options);
  if (options.response === undefined && preset?.response !== undefined) {
    scene.response = preset.response;
  }
  const lights = [...(preset?.lights ?? []), ...readLights(options)];
  const brought = preset?.environment ? presetEnvironment(preset.environment) : null;
  const environment =
    options.environment === undefined || options.environment === null
      ? brought
      : readEnvironment(options.environment, brought);
  return { scene, material: readParameters(materialRows, "", options), lights, environment, fitted };
}

/** As WebScene.h has the values of parameters. */
function numbersOf({ scene, material, environment }) {
  const owners = { scene, material, environment: environment ?? {} };
  return numbered.map((row) => {
    const value = owners[row.owner][row.key] ?? defaultOf(row);
    const numbers = Array.isArray(value) ? value : [Number(value)];
    return [0, 1, 2].map((k) => numbers[k] ?? 0);
  });
}

const heightTypes = [
  Int8Array,
  Uint8Array,
  Uint8ClampedArray,
  Int16Array,
  Uint16Array,
  Int32Array,
  Uint32Array,
  Float32Array,
  Float64Array,
];

function readHeights(heights, width, height) {
  let array = heights;
  if (Array.isArray(heights)) {
    array = Float64Array.from(heights, (value) => (value === null ? NaN : value));
  } else if (heights instanceof Uint8ClampedArray) {
    array = new Uint8Array(heights.buffer, heights.byteOffset, heights.length);
  } else if (!heightTypes.some((Type) => heights instanceof Type)) {
    throw typeError(
      "heights",
      heights,
      "a typed array of integers up to 32 bit or of floats, or an array of numbers, is",
    );
  }
  checkSize("", width, height);
  if (array.length !== width * height) {
    throw new RangeError(
      `heights: ${array.length} values were given, width ${width} x height ${height} = ${width * height} are expected`,
    );
  }
  return array;
}

export function readMask(mask, samples) {
  if (mask === undefined || mask === null) {
    return null;
  }
  if (!(Array.isArray(mask) || ArrayBuffer.isView(mask)) || mask instanceof DataView) {
    throw typeError("mask", mask, "an array, 0 where there are no data, is");
  }
  if (mask.length !== samples) {
    throw new RangeError(
      `mask: ${mask.length} values were given, ${samples} are expected, as many as heights`,
    );
  }
  return mask instanceof Uint8Array ? mask : Uint8Array.from(mask, (value) => (Number(value) ? 1 : 0));
}

export function readSpacing(spacing) {
  const pair = typeof spacing === "number" ? [spacing, spacing] : spacing;
  const good = (Array.isArray(pair) || ArrayBuffer.isView(pair)) && pair.length === 2;
  if (!good || ![pair[0], pair[1]].every((size) => typeof size === "number")) {
    throw typeError("spacing", spacing, "a number, or two of them, is");
  }
  if (![pair[0], pair[1]].every((size) => size >= 1e-32 && size <= 1e32)) {
    throw rangeError("spacing", spacing, "numbers from 1e-32 to 1e32 are");
  }
  return [pair[0], pair[1]];
}

function readLayers(layers) {
  if (!Array.isArray(layers)) {
    throw typeError("layers", layers, "an array is");
  }
  return [...new Set(layers.map((name, k) => layerNames[needWord(`layers[${k}]`, name, layerNames)]))];
}

/** The part of a run that fitScale() takes. */
export function readField(heights, options) {
  const { width, height, spacing = 1, nodata, mask } = options;
  const array = readHeights(heights, width, height);
  return {
    heights: array,
    width,
    height,
    spacing: readSpacing(spacing),
    nodata: nodata === undefined || nodata === null ? undefined : needNumber("nodata", nodata),
    mask: readMask(mask, array.length),
  };
}

/** The environment of options, checked, with the values of parameters; null where there is none. */
export async function readSurroundings(options, presetLights) {
  const scene = await readScene(options, presetLights);
  const { environment } = scene;
  if (!environment || environment.image === "none") {
    return null;
  }
  refuseFile(environment);
  if (environment.radius !== Infinity) {
    throw rangeError("environment.radius", environment.radius, 'for lights without heights "infinite" is');
  }
  return { environment, parameters: numbersOf(scene) };
}

function refuseFile(environment) {
  if (environment?.image === "file") {
    throw new TypeError(
      `environment.file: ${shown(environment.file)} is not read here; give its pixels, image: { data, width, height }`,
    );
  }
}

// All of a run but its heights and what is wanted of it.
async function readDressing(options, presetLights) {
  const scene = await readScene(options, presetLights);
  refuseFile(scene.environment);
  const origin = options.origin === undefined ? [0, 0] : needVector("origin", options.origin, 2);
  scene.lights = scene.lights.map((light) =>
    light.kind === "point"
      ? { ...light, position: light.position.map((c, k) => c - (origin[k] ?? 0)) }
      : light,
  );
  const textures = {};
  for (const [key, name] of Object.entries(textureKeys)) {
    if (options[key] !== undefined && options[key] !== null) {
      textures[name] = readPicture(key, options[key]);
    }
  }
  return { scene, textures };
}

/** A run, checked, as module.js takes it. */
export async function readRun(heights, options, { presetLights, fitScale }) {
  needObject("options", options);
  refuseUnknown("", options, [...sceneKeys, ...runKeys]);
  const field = readField(heights, options);
  const { scene, textures } = await readDressing(options, presetLights);
  if (scene.fitted) {
    scene.scene.heightScale = await fitScale(field);
  }
  const output = ["rgba8", "float"][needWord("output", options.output ?? "rgba8", ["rgba8", "float"])];
  return {
    ...field,
    scene,
    textures,
    output,
    parameters: numbersOf(scene),
    heightScale: scene.scene.heightScale,
    layers: readLayers(options.layers ?? []),
  };
}

/** A run without heights, checked, as planNumbers() takes it. */
export async function readPlanned(options, presetLights) {
  needObject("options", options);
  refuseUnknown("", options, [...sceneKeys, ...runKeys]);
  const { width, height, spacing = 1 } = options;
  checkSize("", width, height);
  const { scene, textures } = await readDressing(options, presetLights);
  if (scene.fitted) {
    throw new TypeError('heightScale: "auto" depends on heights; give the number, of fitHeightScale()');
  }
  return {
    width,
    height,
    spacing: readSpacing(spacing),
    scene,
    textures,
    parameters: numbersOf(scene),
    heightScale: scene.scene.heightScale,
  };
}
