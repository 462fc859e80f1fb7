// SPDX-License-Identifier: BSD-3-Clause
//
// Shades height fields. index.d.ts documents what is here.

import {
  environmentLights as lightsOf,
  exposureOf,
  fitScale,
  layerNames,
  load,
  presetLights,
  presetNames,
  shadeRun,
} from "./module.js";
import { presetOptions as optionsOf, readField, readRun, readSurroundings } from "./options.js";
import { sceneFromText, sceneToText } from "./scene.js";

export { heightsOfMesh, heightsOfNormals } from "./heights.js";
export { parameters, usual, version } from "./parameters.js";
export { planScene } from "./plan.js";
export { createWorkerShader } from "./shader.js";
export { layerNames, presetNames };

export async function init() {
  await load();
}

export async function shade(heights, options = {}) {
  return shadeRun(await readRun(heights, options, { presetLights, fitScale }));
}

export async function fitHeightScale(heights, options = {}) {
  return fitScale(readField(heights, options));
}

export async function findExposure(heights, options = {}) {
  return exposureOf(await readRun(heights, options, { presetLights, fitScale }));
}

export function presetOptions(preset) {
  return optionsOf(preset, presetLights);
}

export async function environmentLights(options = {}) {
  const surroundings = await readSurroundings(options, presetLights);
  return surroundings === null ? [] : lightsOf(surroundings);
}

export function sceneToJSON(options = {}) {
  return sceneToText(options, presetLights);
}

export function sceneFromJSON(text) {
  const { options, unknown } = sceneFromText(text);
  if (unknown.length > 0) {
    console.warn(`The scene has keys that are not known and left out: ${unknown.join(", ")}.`);
  }
  return options;
}
