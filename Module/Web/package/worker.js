// SPDX-License-Identifier: BSD-3-Clause
//
// What shader.js starts: answers one call after the other. Results are handed over, not copied.

import { heightsOfMesh, heightsOfNormals } from "./heights.js";
import { exposureOf, fitScale, load, module, presetLights, shadeRun } from "./module.js";
import { readField, readRun } from "./options.js";

const answers = {
  shade: async (heights, options, band) =>
    shadeRun(await readRun(heights, options, { presetLights, fitScale }), band),
  findExposure: async (heights, options) =>
    exposureOf(await readRun(heights, options, { presetLights, fitScale })),
  fitHeightScale: (heights, options) => fitScale(readField(heights, options)),
  heightsOfMesh,
  heightsOfNormals,
};

async function answer({ call, what, heights, options, band }) {
  try {
    const result = await answers[what](heights, options, band);
    const arrays = [result.data, result.heights, ...Object.values(result.layers ?? {})];
    self.postMessage(
      { call, result },
      arrays.filter((array) => array).map((array) => array.buffer),
    );
  } catch (error) {
    self.postMessage({ call, error: { name: error.name, message: error.message } });
  }
}

// What shader.js has compiled comes by itself.
let begin;
let last = new Promise((resolve) => (begin = resolve)); // so that calls are answered in their order

self.onmessage = ({ data }) => {
  if (data.compiled !== undefined) {
    if (data.compiled) {
      module.take(data.compiled);
    }
    // Meanwhile; where it fails the first call says so.
    load().catch(() => {});
    begin();
  } else {
    last = last.then(() => answer(data));
  }
};
