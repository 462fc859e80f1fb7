// SPDX-License-Identifier: BSD-3-Clause
//
// The WebAssembly that shades, called with a description of a run (options.js). Nothing is checked here.

import { need, rowsFrom, WebModule } from "./load.js";

/** As ArrayType of WebHeights.h numbers them. */
const arrayTypes = [
  Int8Array,
  Uint8Array,
  Int16Array,
  Uint16Array,
  Int32Array,
  Uint32Array,
  Float32Array,
  Float64Array,
];

/** As ColorTexture.h numbers them. */
const texelTypes = [Uint8Array, Uint16Array, Float32Array, Float64Array];

/** As ReliefWeb.cxx numbers them. */
export const layerNames = [
  "illumination",
  "thickness",
  "normals",
  "base",
  "diffuse",
  "scatter",
  "specular",
  "shadow",
];
const components = { normals: 3, base: 3, diffuse: 3, scatter: 3, specular: 3 };
const effectNames = [
  "illumination",
  "normals",
  "specular",
  "scatter",
  "baseTexture",
  "diffuseTexture",
  "specularTexture",
];
/** As ReliefWeb.cxx numbers them; "default" are the lights of a scene that was given none. */
export const presetNames = ["multidirectional", "sky-dome", "sun-and-sky", "combined", "igor", "default"];
const presetSkies = ["none", "whiteDome", "clearSky"];
const skyNumbers = { none: 0, file: 0, whiteDome: 1, clearSky: 2, picture: 3 };

export const module = new WebModule(new URL("./reliefshading.wasm", import.meta.url));
const using = (body) => module.using(body);

/** Loads what is needed; later calls find it there. */
export const load = () => module.load();

function setHeights(wasm, put, run) {
  const type = arrayTypes.findIndex((Type) => run.heights instanceof Type);
  wasm.reliefHeights(put(run.heights), type, run.width, run.height, run.spacing[0], run.spacing[1]);
  if (run.nodata !== undefined) {
    wasm.reliefNoData(run.nodata);
  }
  if (run.mask) {
    wasm.reliefMask(put(run.mask));
  }
}

function picture(put, { data, width, height }) {
  const plain =
    data instanceof Uint8ClampedArray ? new Uint8Array(data.buffer, data.byteOffset, data.length) : data;
  const type = texelTypes.findIndex((Type) => plain instanceof Type);
  return [put(plain), type, data.length / (width * height), width, height];
}

function setLights(wasm, scene) {
  for (const light of scene.lights) {
    const { on, intensity, color, angularDiameter } = light;
    if (on && light.kind === "sun") {
      const toward = light.toward ?? [0, 0, 0];
      wasm.reliefSun(light.azimuth, light.altitude, ...toward, angularDiameter, intensity, ...color);
    } else if (on) {
      wasm.reliefLamp(...light.position, intensity, ...color);
    }
  }
  // Lights that are off are lights all the same: a scene of nothing else is dark.
  if (scene.lights.length > 0 && !scene.environment) {
    wasm.reliefSky(skyNumbers.none, 0, 0, 0);
  }
}

function setEnvironment(wasm, put, { image, azimuth, altitude, turbidity, picture: map }) {
  wasm.reliefSky(skyNumbers[image], azimuth ?? 0, altitude ?? 0, turbidity ?? 0);
  if (image === "picture") {
    wasm.reliefSkyPicture(...picture(put, map));
  }
}

function warningsOf(wasm, run) {
  const warnings = [];
  const [hasData, cleaned, unusable] = [5, 6, 7].map((number) => wasm.reliefNumber(number));
  if (hasData === 0) {
    warnings.push("No sample has data; the picture is transparent.");
  } else if (run.width < 2 || run.height < 2) {
    warnings.push(
      `An image of ${run.width} x ${run.height} samples has no surface between them; each is shaded as level ground.`,
    );
  }
  if (cleaned > 0) {
    warnings.push(
      `The environment has ${cleaned} texels that are not finite, negative or above 1e30; a negative component counts as 0, the others as black texels.`,
    );
  }
  if (unusable > 0) {
    warnings.push(
      `The textures have ${unusable} texels with negative or non-finite components; these count as 0.`,
    );
  }
  return warnings;
}

//--------------------------------------------------------------------------------------------------
/** The scale that heights without a unit get, with six significant digits; 1 where none is found. */
export function fitScale(run) {
  return using((wasm, put) => {
    setHeights(wasm, put, run);
    const scale = wasm.reliefFitHeightScale();
    return scale > 0 ? Number(scale.toPrecision(6)) : 1;
  });
}

/** What a preset stands for, as options have it. */
export async function presetLights(name, azimuth, altitude) {
  const wasm = await load();
  const address = wasm.reliefPreset(presetNames.indexOf(name), azimuth, altitude) >>> 0;
  const numbers = new Float64Array(wasm.memory.buffer, address, 64);
  const [sky, intensity, numberOfSamples, sampling, response, count] = numbers;
  const lights = [];
  for (let k = 0, at = 6; k < count; ++k, at += 7) {
    const [a, h, angularDiameter, power, ...color] = numbers.slice(at, at + 7);
    lights.push({
      kind: "sun",
      azimuth: a,
      altitude: h,
      angularDiameter,
      intensity: power,
      color,
      on: true,
    });
  }
  return {
    lights,
    environment:
      sky === 0 ? null : { image: presetSkies[sky], azimuth, altitude, intensity, numberOfSamples, sampling },
    response: response < 0 ? undefined : response,
  };
}

/** The lights that stand for the environment of a run, as the host upon WebGL 2 takes them. */
export function environmentLights({ parameters, environment }) {
  return using((wasm, put) => {
    parameters.forEach((value, number) => wasm.reliefParameter(number, ...value));
    setEnvironment(wasm, put, environment);
    const count = wasm.reliefEnvironmentLights();
    const numbers = new Float64Array(wasm.memory.buffer, wasm.reliefEnvironmentNumbers() >>> 0, 8 * count);
    return Array.from({ length: count }, (_, k) => {
      const [x, y, z, r, g, b, weight, toleranceScale] = numbers.slice(8 * k, 8 * k + 8);
      return { direction: [x, y, z], color: [r, g, b], weight, toleranceScale };
    });
  });
}

// Lights, environment and textures of a run whose heights are there.
function setScene(wasm, put, run) {
  run.parameters.forEach((value, number) => wasm.reliefParameter(number, ...value));
  setLights(wasm, run.scene);
  if (run.scene.environment) {
    setEnvironment(wasm, put, run.scene.environment);
  }
  for (const [name, texture] of Object.entries(run.textures)) {
    wasm.reliefTexture(1 + layerNames.indexOf(name), ...picture(put, texture));
  }
}

/** The exposure of a run in stops, given or found over all of its samples. */
export function exposureOf(run) {
  return using((wasm, put) => {
    setHeights(wasm, put, run);
    setScene(wasm, put, run);
    need(wasm, wasm.reliefExpose());
    return wasm.reliefNumber(3);
  });
}

/**
 * The numbers of a plan (WebPlan.h) of a run without heights, of which `range` has the least and the greatest. In
 * the place of an environment it has `around`, the lights that stand for it.
 */
export function planNumbers(run, range, around) {
  return using((wasm, put) => {
    wasm.reliefHeights(0, 0, run.width, run.height, ...run.spacing);
    setScene(wasm, put, { ...run, scene: { ...run.scene, environment: null } });
    if (around) {
      wasm.reliefSky(skyNumbers.none, 0, 0, 0);
    }
    for (const { direction, color, weight, toleranceScale } of around ?? []) {
      wasm.reliefSample(...direction, ...color, weight, toleranceScale);
    }
    need(wasm, wasm.reliefPlan(range.bottom, range.top, range.floats ? 1 : 0));
    return Array.from(
      new Float64Array(wasm.memory.buffer, wasm.reliefPlanNumbers() >>> 0, wasm.reliefPlanSize()),
    );
  });
}

/**
 * Shades a run, or only part k of so many bands of rows, from the south; see index.d.ts for what comes of it.
 * A band may have no rows.
 */
export function shadeRun(run, [k, bands] = [0, 1]) {
  return using((wasm, put) => {
    setHeights(wasm, put, run);
    setScene(wasm, put, run);
    run.layers.forEach((name) => wasm.reliefWant(1 + layerNames.indexOf(name)));
    if (run.output === "float") {
      wasm.reliefWantFloat();
    }
    // Whole tiles, as evenly as may be.
    const tile = wasm.reliefTileHeight();
    const border = (at) => Math.min(run.height, Math.round(((at / bands) * run.height) / tile) * tile);
    const first = border(k);
    const height = (k + 1 === bands ? run.height : border(k + 1)) - first;
    wasm.reliefRows(first, height);
    need(wasm, wasm.reliefShade());

    const { width } = run;
    const Type = run.output === "float" ? Float32Array : Uint8ClampedArray;
    const layers = {};
    for (const name of run.layers) {
      const address = wasm.reliefResult(1 + layerNames.indexOf(name));
      layers[name] = rowsFrom(wasm, address, Float32Array, width, height, components[name] ?? 1);
    }
    const number = (k) => wasm.reliefNumber(k);
    return {
      data: rowsFrom(wasm, wasm.reliefResult(0), Type, width, height, 4),
      width,
      height,
      layers,
      statistics: {
        lightsTraced: number(0),
        raysTraced: number(1),
        cellsVisited: number(2),
        exposure: number(3),
        heightScale: run.heightScale,
        effectsEvaluated: effectNames.filter((name, bit) => number(4) & (1 << bit)),
        modelVersion: wasm.reliefModelVersion(),
      },
      warnings: warningsOf(wasm, run),
    };
  });
}
