// SPDX-License-Identifier: BSD-3-Clause
//
// Shades height fields. index.d.ts documents what is here.

import { fitScale, layerNames, load, presetLights, presetNames, shadeRun } from "./module.js";
import { readField, readRun } from "./options.js";
import { sceneFromText, sceneToText } from "./scene.js";

export { parameters, version } from "./parameters.js";
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

//--------------------------------------------------------------------------------------------------
const errorTypes = { RangeError, TypeError, Error };

export function createWorkerShader() {
  if (typeof Worker === "undefined") {
    throw new Error("there is no Worker here, in which a page stays free while it shades; call shade() instead");
  }
  const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
  const waiting = new Map();
  let calls = 0;
  let ended = null;

  const end = (error) => {
    ended = error;
    worker.terminate();
    waiting.forEach(({ reject }) => reject(error));
    waiting.clear();
  };
  worker.onmessage = ({ data: { call, result, error } }) => {
    const { resolve, reject } = waiting.get(call);
    waiting.delete(call);
    if (error) {
      const Type = errorTypes[error.name] ?? Error;
      reject(new Type(error.message));
    } else {
      resolve(result);
    }
  };
  worker.onerror = (event) => end(new Error(`the worker failed: ${event.message ?? "it cannot be loaded"}`));

  const call = (what, heights, options, { transfer = false } = {}) =>
    new Promise((resolve, reject) => {
      if (ended) {
        throw ended;
      }
      const id = calls++;
      const given = transfer && ArrayBuffer.isView(heights) ? [heights.buffer] : [];
      worker.postMessage({ call: id, what, heights, options }, given);
      waiting.set(id, { resolve, reject });
    });
  return {
    shade: (heights, options = {}, how) => call("shade", heights, options, how),
    fitHeightScale: (heights, options = {}, how) => call("fitHeightScale", heights, options, how),
    terminate: () => end(new Error("the worker was terminated")),
  };
}
