// SPDX-License-Identifier: BSD-3-Clause
//
// Reads and writes files away from the page: heights and pictures from PNG, TIFF, OpenEXR and Radiance's by
// libraries, from all else by the browser, heights of meshes and of normals by the package; pictures as PNG.

import { convertIndexedToRgb, decode, encode } from "fast-png";
import { tellUndeclared } from "./nodata.js";
import { encodings, isMesh, looksLikeNormals, usualReading, usualView } from "./sources.js";

const most = 2 ** 26; // samples

class Refusal extends Error {}

function checkSize(width, height) {
  if (width * height > most) {
    throw new Refusal(`it has ${width} × ${height} samples, more than the ${most} that a page has room for`);
  }
}

//--------------------------------------------------------------------------------------------------
// Each reader returns { data, width, height, channels }, and what else it knows.

const begins = (bytes, ...head) => head.every((byte, k) => bytes[k] === byte);
const isPng = (bytes) => begins(bytes, 137, 80, 78, 71);
const isExr = (bytes) => begins(bytes, 0x76, 0x2f, 0x31, 0x01);
const isRadiance = (bytes) => begins(bytes, 35, 63); // "#?"
const isTiff = (bytes) =>
  begins(bytes, 73, 73, 42, 0) || begins(bytes, 77, 77, 0, 42) || begins(bytes, 73, 73, 43, 0);

async function readPng(bytes) {
  const view = new DataView(bytes.buffer);
  if (bytes.length < 33) {
    throw new Refusal("it ends too soon");
  }
  checkSize(view.getUint32(16), view.getUint32(20));
  if (bytes[24] < 8) {
    return readByBrowser(bytes);
  }
  const png = decode(bytes, { checkCrc: true });
  const data = png.palette ? convertIndexedToRgb(png) : png.data;
  return { ...png, data, channels: data.length / (png.width * png.height) };
}

async function readByBrowser(bytes) {
  const how = { premultiplyAlpha: "none", colorSpaceConversion: "none" };
  const bitmap = await createImageBitmap(new Blob([bytes]), how);
  const { width, height } = bitmap;
  checkSize(width, height);
  const context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
  context.drawImage(bitmap, 0, 0);
  return { data: context.getImageData(0, 0, width, height).data, width, height, channels: 4 };
}

// By scripts that few need.
const linear = () => import("./hdr.js");
const tiff = () => import("./tiff.js");

const kinds = [
  { is: isPng, name: "PNG", read: readPng },
  { is: isTiff, name: "TIFF", read: async (bytes) => (await tiff()).readTiff(bytes, checkSize) },
  { is: isExr, name: "OpenEXR", read: async (bytes) => (await linear()).readExr(bytes, checkSize) },
  { is: isRadiance, name: "Radiance picture", read: async (bytes) => (await linear()).readRadiance(bytes, checkSize) },
];

async function read(name, buffer) {
  const bytes = new Uint8Array(buffer);
  const kind = kinds.find(({ is }) => is(bytes));
  try {
    return await (kind ? kind.read : readByBrowser)(bytes);
  } catch (error) {
    const why =
      error instanceof Refusal
        ? error.message
        : kind
          ? `the ${kind.name} is damaged, cut short or of a kind that is not read here`
          : "it is no picture that this browser reads (PNG, TIFF, OpenEXR, JPEG …)";
    throw new Refusal(`“${name}” cannot be opened: ${why}.`);
  }
}

//--------------------------------------------------------------------------------------------------

const brightness = (red, green, blue) => 0.2126 * red + 0.7152 * green + 0.0722 * blue;

// Of a colour what it stands for; what is transparent has no data, nor has what no float goes beyond.
function toHeights({ data, width, height, channels, nodata, alpha = channels % 2 === 0, ...rest }, meaning = brightness) {
  const heights = new Float32Array(width * height);
  const colored = channels >= 3;
  for (let k = 0, at = 0; k < heights.length; ++k, at += channels) {
    const value = colored ? meaning(data[at], data[at + 1], data[at + 2]) : data[at];
    heights[k] = value === nodata || Math.abs(value) > 3.4e38 ? NaN : value;
  }
  if (alpha) {
    for (let k = 0; k < heights.length; ++k) {
      heights[k] = data[channels * k + channels - 1] === 0 ? NaN : heights[k];
    }
  }
  if (!heights.some(Number.isFinite)) {
    throw new Refusal("There is no sample with data in it.");
  }
  return { heights, width, height, lengths: false, spacing: [1, 1], origin: [0, 0], ...pick(rest) };
}

// What the package says is wrong with a file, by its name.
async function found(name, make) {
  const { heightsOfMesh, heightsOfNormals } = await import("reliefshading/heights.js");
  try {
    return await make(heightsOfMesh, heightsOfNormals);
  } catch (error) {
    throw new Refusal(`“${name}” cannot be opened: ${error.message.replace(/^(mesh|normals): /, "")}.`);
  }
}

async function meshHeights(name, buffer, how) {
  const { direction: viewDirection, up: viewUp, resolution } = how;
  const { heights, width, height, spacing, warnings } = await found(name, (heightsOfMesh) =>
    heightsOfMesh(buffer, { viewDirection, viewUp, resolution }),
  );
  const source = { kind: "mesh", how };
  // As reliefshade counts, from the south-western sample.
  return { heights, width, height, spacing, origin: [0, 0], lengths: true, source, warnings };
}

async function normalHeights(name, { data, width, height }, how) {
  const { green, method } = how;
  const { heights, spacing, warnings } = await found(name, (_, heightsOfNormals) =>
    heightsOfNormals({ data, width, height }, { green, method }),
  );
  return { heights, width, height, spacing, origin: [0, 0], lengths: true, warnings };
}

async function fetched(name, address) {
  const response = await fetch(address);
  if (!response.ok) {
    throw new Refusal(`“${name}” cannot be loaded: ${response.status}.`);
  }
  return response.arrayBuffer();
}

// In one of the ways of sources.js.
async function readHeights({ name, address, how, ...file }) {
  const buffer = file.buffer ?? (await fetched(name, address));
  if (isMesh(name)) {
    return meshHeights(name, buffer, { ...usualView, ...how });
  }
  const picture = await read(name, buffer);
  if (picture.channels < 3 || picture.channels > 4 || picture.lengths) {
    const { unit, told, lengths } = picture;
    const field = toHeights(picture);
    const warnings = [
      unit && `has heights in ${unit} and a spacing in metres: Height scale is what makes them alike.`,
      told,
      tellUndeclared(field.heights, field.width, lengths),
    ];
    return { ...field, warnings: warnings.filter(Boolean).map((text) => `“${name}” ${text}`) };
  }
  const looks = how?.as === undefined && looksLikeNormals(picture);
  const way = { ...usualReading, ...(looks ? { as: "normals" } : {}), ...how };
  const encoding = encodings[way.as];
  if (encoding && !(picture.data instanceof Uint8Array || picture.data instanceof Uint8ClampedArray)) {
    throw new Refusal(`“${name}” cannot be opened: heights are encoded in colours of 8 bits, and it has others.`);
  }
  const field = await (way.as === "normals" ? normalHeights(name, picture, way) : toHeights(picture, encoding));
  const told = looks
    ? [`“${name}” looks like a picture of normals and is read as one; under Heights it can be read by its brightness.`]
    : [];
  return { ...field, source: { kind: "picture", how: way }, warnings: [...told, ...(field.warnings ?? [])] };
}

const pick = ({ lengths, spacing, origin }) => (lengths ? { lengths, spacing, origin } : {});

const pictureTypes = [Uint8Array, Uint8ClampedArray, Uint16Array, Float32Array];

function toPicture({ data, width, height, channels }) {
  const plain = pictureTypes.some((Type) => data instanceof Type) ? data : Float32Array.from(data);
  if (channels <= 4) {
    return { data: plain, width, height };
  }
  const colors = new plain.constructor(3 * width * height);
  for (let k = 0; k < width * height; ++k) {
    colors.set(plain.subarray(channels * k, channels * k + 3), 3 * k);
  }
  return { data: colors, width, height };
}

// 1 where alpha, or else brightness, is at least half.
function toMask({ data, width, height, channels }) {
  const white = data instanceof Uint16Array ? 65535 : data instanceof Float32Array ? 1 : 255;
  const alphaAt = channels - 1;
  const wholeAlpha = channels === 2 || channels === 4;
  let transparent = false;
  for (let k = 0; wholeAlpha && !transparent && k < width * height; ++k) {
    transparent = data[channels * k + alphaAt] < white;
  }
  const mask = new Uint8Array(width * height);
  for (let k = 0; k < mask.length; ++k) {
    mask[k] = data[channels * k + (transparent ? alphaAt : 0)] >= white / 2 ? 1 : 0;
  }
  return { data: mask, width, height };
}

const opaque = (data) => {
  for (let k = 3; k < data.length; k += 4) {
    if (data[k] !== 255) {
      return false;
    }
  }
  return true;
};

function writePng({ data, width, height }) {
  if (!opaque(data)) {
    return encode({ data, width, height, channels: 4, depth: 8 });
  }
  const colors = new Uint8Array(3 * width * height);
  for (let k = 0, at = 0; at < data.length; at += 4) {
    colors[k++] = data[at];
    colors[k++] = data[at + 1];
    colors[k++] = data[at + 2];
  }
  return encode({ data: colors, width, height, channels: 3, depth: 8 });
}

const answers = {
  heights: readHeights,
  picture: async ({ name, buffer }) => toPicture(await read(name, buffer)),
  mask: async ({ name, buffer }) => toMask(await read(name, buffer)),
  png: ({ picture }) => ({ data: writePng(picture) }),
};

self.onmessage = async ({ data }) => {
  try {
    const result = await answers[data.what](data);
    self.postMessage({ result }, [(result.heights ?? result.data).buffer]);
  } catch (error) {
    const known = error instanceof Refusal;
    self.postMessage({ error: known ? error.message : `The file cannot be handled: ${error.message}` });
  }
};
