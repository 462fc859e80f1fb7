// SPDX-License-Identifier: BSD-3-Clause
//
// Pictures of linear light, Radiance's and OpenEXR, by the loaders of three.js.

import { EXRLoader } from "three/addons/loaders/EXRLoader.js";
import { HDRLoader } from "three/addons/loaders/HDRLoader.js";

const FLOAT = 1015; // FloatType of three.js

// The beginning of a file as text, a character a byte.
const beginning = (bytes, length) => new TextDecoder("latin1").decode(bytes.subarray(0, length));

function samplesOf({ data, width, height }, channels, sample) {
  const result = new Float32Array(channels * width * height);
  for (let k = 0, at = 0; k < 4 * width * height; k += 4, at += channels) {
    sample(data, k, result, at);
  }
  return { data: result, width, height, channels };
}

// Whether all rows are there, from `at` on; the loader leaves those black that are not.
function isWhole(bytes, at, width, height) {
  const packed = width >= 8 && width < 32768 && bytes[at] === 2 && bytes[at + 1] === 2 && bytes[at + 2] < 128;
  if (!packed) {
    return bytes.length - at >= 4 * width * height;
  }
  let next = at;
  for (let row = 0; row < height; ++row) {
    next += 4;
    for (let k = 0; k < 4 * width;) {
      const count = bytes[next];
      const repeated = count > 128;
      k += repeated ? count - 128 : count;
      next += repeated ? 2 : count + 1;
      if (!count || next > bytes.length) {
        return false;
      }
    }
  }
  return true;
}

/** @param checkSize   refuses what is too large, before it is decoded */
export async function readRadiance(bytes, checkSize) {
  const header = beginning(bytes, 8192);
  const size = /^-Y\s+(\d+)\s+\+X\s+(\d+)\n/m.exec(header);
  if (!size) {
    throw new Error("its rows do not lie from the top to the bottom");
  }
  if (/^FORMAT=32-bit_rle_xyze/m.test(header)) {
    throw new Error("its colours are not red, green and blue");
  }
  const [columns, rows] = [Number(size[2]), Number(size[1])];
  checkSize(columns, rows);
  if (!isWhole(bytes, size.index + size[0].length, columns, rows)) {
    throw new Error("it is cut short");
  }
  const picture = new HDRLoader().setDataType(FLOAT).parse(bytes.buffer);
  // Several lines count together.
  const exposures = [...header.slice(0, size.index).matchAll(/^\s*EXPOSURE\s*=\s*(\S+)\s*$/gm)];
  const exposure = exposures.reduce((product, [, number]) => product * Number(number), 1) || 1;
  return samplesOf(picture, 3, (data, k, to, at) => {
    for (let c = 0; c < 3; ++c) {
      to[at + c] = data[k + c] / exposure;
    }
  });
}

/** @param checkSize   refuses what is too large, before it is decoded */
export async function readExr(bytes, checkSize) {
  const name = "dataWindow\0box2i\0";
  const at = beginning(bytes, 65536).indexOf(name);
  if (at < 0 || at + name.length + 20 > bytes.length) {
    throw new Error("it is cut short");
  }
  const view = new DataView(bytes.buffer, at + name.length + 4);
  const [left, top, right, bottom] = [0, 4, 8, 12].map((offset) => view.getInt32(offset, true));
  checkSize(right - left + 1, bottom - top + 1);
  const picture = new EXRLoader().setDataType(FLOAT).parse(bytes.buffer);
  // Its first row is the lowest one.
  const { width, height } = picture;
  const data = new Float32Array(picture.data.length);
  for (let j = 0; j < height; ++j) {
    data.set(picture.data.subarray(4 * width * j, 4 * width * (j + 1)), 4 * width * (height - 1 - j));
  }
  const opaque = data.every((value, k) => k % 4 !== 3 || value === 1);
  // Colours are multiplied by alpha in files.
  return samplesOf({ data, width, height }, opaque ? 3 : 4, (from, k, to, place) => {
    const alpha = from[k + 3];
    for (let c = 0; c < 3; ++c) {
      to[place + c] = opaque || alpha === 0 ? from[k + c] : from[k + c] / alpha;
    }
    if (!opaque) {
      to[place + 3] = alpha;
    }
  });
}
