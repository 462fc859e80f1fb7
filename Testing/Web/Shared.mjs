// SPDX-License-Identifier: BSD-3-Clause
//
// Fields and scenes that tests share.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

/** The package that was built. */
export const packageFolder = process.env.RELIEF_PACKAGE;
export const {
  createWorkerShader,
  environmentLights,
  findExposure,
  fitHeightScale,
  heightsOfMesh,
  heightsOfNormals,
  init,
  parameters,
  planScene,
  presetNames,
  presetOptions,
  sceneFromJSON,
  sceneToJSON,
  shade,
  version,
} = await import(pathToFileURL(join(packageFolder, "index.js")).href);
export const readText = (...names) => readFileSync(join(...names), "utf8");

/** Numbers in [0, 1) that are the same on every machine. */
export function makeRandom(seed) {
  let state = seed >>> 0;
  return () => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return state / 2 ** 32;
  };
}

/** Hills of several sizes, with a relief of about `relief`. */
export function makeTerrain(width, height, relief = 20, seed = 1) {
  const random = makeRandom(seed);
  const waves = Array.from({ length: 12 }, (_, k) => ({
    x: (random() - 0.5) * 0.12 * (k + 1),
    y: (random() - 0.5) * 0.12 * (k + 1),
    phase: 7 * random(),
    size: 1 / (k + 1.5),
  }));
  return Float32Array.from({ length: width * height }, (_, at) => {
    const i = at % width;
    const j = Math.floor(at / width);
    return relief * waves.reduce((sum, w) => sum + w.size * Math.sin(w.x * i + w.y * j + w.phase), 0);
  });
}

/** A plane that rises by so much from sample to sample toward the east, and toward the north. */
export const makePlane = (width, height, east, north) =>
  Float64Array.from(
    { length: width * height },
    (_, at) => east * (at % width) - north * Math.floor(at / width),
  );
