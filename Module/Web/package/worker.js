// SPDX-License-Identifier: BSD-3-Clause
//
// What createWorkerShader() starts: answers one call after the other. Results are handed over, not copied.

import { fitHeightScale, shade } from "./index.js";

const answers = { shade, fitHeightScale };

self.onmessage = async ({ data: { call, what, heights, options } }) => {
  try {
    const result = await answers[what](heights, options);
    const arrays = result.data ? [result.data, ...Object.values(result.layers)] : [];
    self.postMessage({ call, result }, arrays.map((array) => array.buffer));
  } catch (error) {
    self.postMessage({ call, error: { name: error.name, message: error.message } });
  }
};
