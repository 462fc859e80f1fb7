// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes for the host upon WebGL 2: their numbers as the model takes them, and what is wanted of each light. The
// WebAssembly finds all of it, by the same code as for its own pictures.

import { environmentLights, planNumbers, presetLights } from "./module.js";
import { numbered, readPlanned } from "./options.js";
import { needNumber, needObject } from "./values.js";

// The lights of the last environment: finding those of a large picture takes a while, and while a light is dragged
// they stay.
let last = { picture: null, key: "", lights: [] };

async function lightsAround({ scene, parameters }) {
  const { environment } = scene;
  if (!environment || environment.image === "none") {
    return environment ? [] : null;
  }
  const { picture, radius, intensity, ...rest } = environment;
  const key = JSON.stringify(rest);
  if (key !== last.key || picture?.data !== last.picture) {
    // The plan multiplies by the intensity.
    const plain = parameters.map((value, k) =>
      numbered[k].owner === "environment" && numbered[k].key === "intensity" ? [1, 0, 0] : value,
    );
    const lights = await environmentLights({ environment, parameters: plain });
    last = { picture: picture?.data, key, lights };
  }
  return last.lights;
}

/** Reads numbers in the order in which PlanNumbers() writes them. */
function unpack(numbers) {
  let at = 0;
  const number = () => numbers[at++];
  const flag = () => number() !== 0;
  const vector = () => [number(), number(), number()];
  // Members are evaluated in their order.
  const plan = {
    datum: number(),
    base: vector(),
    diffuse: vector(),
    specular: vector(),
    specularCoefficient: number(),
    scatterCoefficient: number(),
    specularFalloff: vector(),
    scatterFalloff: vector(),
    medium: {
      depth: number(),
      density: number(),
      floorHeight: number(),
      tolerance: number(),
      useFloor: flag(),
      exponential: flag(),
      surfaceNormal: flag(),
      tangentPlane: flag(),
    },
    fixedStep: flag(),
    steps: number(),
    combined: flag(),
    igor: flag(),
    exposure: number(),
    sums: { diffuse: flag(), scatter: flag(), specular: flag() },
  };
  const light = () => ({
    directional: flag(),
    vector: vector(),
    positional: flag(),
    traced: vector(),
    radiance: vector(),
    toleranceScale: number(),
    one: flag(),
    matte: flag(),
    shows: flag(),
  });
  return { ...plan, lights: Array.from({ length: number() }, light) };
}

export async function planScene(options, bounds) {
  needObject("bounds", bounds);
  needNumber("bounds.bottom", bounds.bottom);
  needNumber("bounds.top", bounds.top);
  const { bottom, top, floats = true, ...place } = bounds;
  const run = await readPlanned({ ...options, ...place }, presetLights);
  const around = await lightsAround(run);
  const { scene } = run.scene;
  return {
    ...unpack(await planNumbers(run, { bottom, top, floats }, around)),
    automaticExposure: scene.automaticExposure,
    heightScale: run.heightScale,
    textures: run.textures,
  };
}
