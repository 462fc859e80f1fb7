// SPDX-License-Identifier: BSD-3-Clause
//
// Ways to read the file of heights: a mesh as seen from one side, a picture by its brightness, as normals or as
// heights that its colours encode.

export const isMesh = (name) => /\.obj$/i.test(name);

/** How a mesh is read, as reliefshade does it; and a picture, where it does not look like normals. */
export const usualView = { direction: [0, 0, 1], up: [0, 1, 0], resolution: 1024 };
export const usualReading = { as: "brightness", green: "auto", method: "least-squares" };

/** Metres by the red, green and blue of tiles of heights, as of reliefshade --encoding. */
export const encodings = {
  terrarium: (red, green, blue) => 256 * red + green + blue / 256 - 32768,
  "terrain-rgb": (red, green, blue) => (65536 * red + 256 * green + blue) / 10 - 10000,
};

/** Whether the colours of a picture are directions: nearly all of length 1, and toward the viewer. */
export function looksLikeNormals({ data, width, height, channels }) {
  const largest = data instanceof Uint16Array ? 65535 : data instanceof Float32Array ? 1 : 255;
  const step = channels * Math.max(Math.floor((width * height) / 20000), 1);
  let [count, fitting, grey] = [0, 0, 0];
  for (let at = 0; at < data.length; at += step) {
    const [x, y, z] = [0, 1, 2].map((c) => (2 * data[at + c]) / largest - 1);
    if (channels === 4 && data[at + 3] === 0) {
      continue;
    }
    count += 1;
    grey += x === y && y === z ? 1 : 0;
    fitting += z > 0 && Math.abs(Math.hypot(x, y, z) - 1) < 0.1 ? 1 : 0;
  }
  return channels >= 3 && fitting > 0.95 * count && grey < 0.5 * count;
}
