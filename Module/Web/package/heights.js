// SPDX-License-Identifier: BSD-3-Clause
//
// Heights of meshes and of normal maps, by a module of WebAssembly that is loaded for them. index.d.ts documents
// what is here.

import { need, rowsFrom, WebModule } from "./load.js";
import { checkSize, readMask, readSpacing } from "./options.js";
import {
  needNumber,
  needObject,
  needVector,
  needWord,
  rangeError,
  refuseUnknown,
  typeError,
} from "./values.js";

const module = new WebModule(new URL("./reliefheights.wasm", import.meta.url));
const using = (body) => module.using(body);

/** As ReliefHeightsWeb.cxx numbers them. */
const numberNames = [
  "columns",
  "rows",
  "spacingX",
  "spacingY",
  "firstX",
  "firstY",
  "triangles",
  "degenerate",
  "notFinite",
  "green",
  "greenKnown",
  "parts",
  "iterations",
  "converged",
  "encoding",
];
/** As NormalEncoding, GreenAxis and NormalMethod number them. */
const encodings = ["auto", "unsigned", "signed"];
const greens = ["auto", "up", "down"];
const methods = ["least-squares", "cliffs", "path-sums"];
/** As NormalType numbers them. */
const normalTypes = [Uint8Array, Uint16Array, Float32Array, Float64Array];

const mostResolution = 65536;

const numbersOf = (wasm) =>
  Object.fromEntries(numberNames.map((name, number) => [name, wasm.reliefNumber(number)]));

//--------------------------------------------------------------------------------------------------
// Meshes.

function readPoints(points) {
  const plain = Array.isArray(points) ? Float64Array.from(points) : points;
  if (!(plain instanceof Float32Array) && !(plain instanceof Float64Array)) {
    throw typeError("mesh.points", points, "x, y and z of each point as an array of numbers is");
  }
  if (plain.length === 0 || plain.length % 3 !== 0) {
    throw new RangeError(
      `mesh.points: ${plain.length} numbers were given, three for each point are expected`,
    );
  }
  return plain;
}

function readTriangles(triangles, points) {
  if (triangles === undefined || triangles === null) {
    if (points % 3 !== 0) {
      throw new RangeError(
        `mesh.points: ${points} points were given without triangles, three for each triangle are expected`,
      );
    }
    return Uint32Array.from({ length: points }, (_, k) => k);
  }
  const whole =
    Array.isArray(triangles) ||
    [Uint8Array, Uint16Array, Uint32Array, Int32Array].some((Type) => triangles instanceof Type);
  if (!whole) {
    throw typeError("mesh.triangles", triangles, "three points of each triangle as an array of numbers is");
  }
  if (triangles.length === 0 || triangles.length % 3 !== 0) {
    throw new RangeError(
      `mesh.triangles: ${triangles.length} numbers were given, three for each triangle are expected`,
    );
  }
  for (let k = 0; k < triangles.length; ++k) {
    const point = triangles[k];
    if (!(Number.isInteger(point) && point >= 0 && point < points)) {
      throw new RangeError(
        `mesh.triangles: ${point} was given, a whole number from 0 to ${points - 1}, of a point, is expected`,
      );
    }
  }
  return triangles instanceof Uint32Array ? triangles : Uint32Array.from(triangles);
}

// The text of an OBJ as bytes, or points and triangles.
function readMesh(mesh) {
  if (typeof mesh === "string") {
    return { text: new TextEncoder().encode(mesh) };
  }
  if (mesh instanceof ArrayBuffer) {
    return { text: new Uint8Array(mesh) };
  }
  if (mesh instanceof Uint8Array) {
    return { text: mesh };
  }
  const { points, triangles } = needObject(
    "mesh",
    mesh,
    "the text of an OBJ, its bytes, or { points, triangles } is",
  );
  refuseUnknown("mesh.", mesh, ["points", "triangles"]);
  const places = readPoints(points);
  return { points: places, triangles: readTriangles(triangles, places.length / 3) };
}

function readDirection(name, value) {
  const vector = needVector(name, value, 3);
  if (vector.every((c) => c === 0)) {
    throw rangeError(name, value, "a vector that is not 0 is");
  }
  return vector;
}

function leftOut({ degenerate, notFinite }) {
  const parts = [
    [degenerate, "triangles without area"],
    [notFinite, "triangles whose corners are no finite points"],
  ].filter(([count]) => count > 0);
  return parts.length > 0
    ? [`Of the mesh are left out: ${parts.map(([count, what]) => `${count} ${what}`).join(", ")}.`]
    : [];
}

export async function heightsOfMesh(mesh, options = {}) {
  refuseUnknown("", needObject("options", options), ["viewDirection", "viewUp", "resolution"]);
  const { viewDirection = [0, 0, 1], viewUp = [0, 1, 0], resolution = 1024 } = options;
  const direction = readDirection("viewDirection", viewDirection);
  const up = readDirection("viewUp", viewUp);
  needNumber("resolution", resolution, "a whole number is");
  if (!Number.isInteger(resolution) || resolution < 1 || resolution > mostResolution) {
    throw rangeError("resolution", resolution, `a whole number in [1, ${mostResolution}] is`);
  }
  const { text, points, triangles } = readMesh(mesh);
  return using((wasm, put) => {
    if (text) {
      need(wasm, wasm.reliefMeshText(put(text), text.length), "mesh: ");
    } else {
      wasm.reliefMeshPoints(put(points), points instanceof Float64Array ? 1 : 0, points.length / 3);
      wasm.reliefMeshTriangles(put(triangles), triangles.length / 3);
    }
    wasm.reliefMeshView(...direction, ...up);
    need(wasm, wasm.reliefMeshHeights(resolution), "mesh: ");
    const numbers = numbersOf(wasm);
    const { columns: width, rows: height } = numbers;
    return {
      heights: rowsFrom(wasm, wasm.reliefHeights(), Float64Array, width, height, 1),
      width,
      height,
      spacing: [numbers.spacingX, numbers.spacingY],
      origin: [numbers.firstX, numbers.firstY],
      triangles: numbers.triangles,
      warnings: leftOut(numbers),
    };
  });
}

//--------------------------------------------------------------------------------------------------
// Normal maps.

function readNormals(value) {
  const { data, width, height } = needObject("normals", value, "{ data, width, height } is");
  const plain =
    data instanceof Uint8ClampedArray ? new Uint8Array(data.buffer, data.byteOffset, data.length) : data;
  if (!normalTypes.some((Type) => plain instanceof Type)) {
    throw typeError("normals.data", data, "an array of 8 or 16 bit, Float32Array or Float64Array is");
  }
  checkSize("normals", width, height);
  const components = plain.length / (width * height);
  if (components !== 3 && components !== 4) {
    throw rangeError(
      "normals.data",
      data,
      `3 (x, y, z) or 4 (with alpha) for each of ${width} x ${height} samples are`,
    );
  }
  return { data: plain, width, height, components };
}

function oddities({ greenKnown, converged, iterations }) {
  const warnings = [];
  if (greenKnown === 0) {
    warnings.push("Which way green points cannot be told: up is taken; see the option green.");
  }
  if (converged === 0) {
    warnings.push(`The heights were still changing after ${iterations} steps.`);
  }
  return warnings;
}

export async function heightsOfNormals(normals, options = {}) {
  refuseUnknown("", needObject("options", options), ["spacing", "green", "method", "encoding", "mask"]);
  const { data, width, height, components } = readNormals(normals);
  const spacing = readSpacing(options.spacing ?? 1);
  const ratio = spacing[0] / spacing[1];
  if (!(ratio >= 1e-6 && ratio <= 1e6)) {
    throw rangeError("spacing", options.spacing, "numbers with a ratio of at most 1e6 are");
  }
  const green = needWord("green", options.green ?? "auto", greens);
  const method = needWord("method", options.method ?? "least-squares", methods);
  const encoding = needWord("encoding", options.encoding ?? "auto", encodings);
  const mask = readMask(options.mask, width * height);
  return using((wasm, put) => {
    const type = normalTypes.findIndex((Type) => data instanceof Type);
    wasm.reliefNormals(put(data), type, components, width, height, ...spacing);
    if (mask) {
      wasm.reliefNormalMask(put(mask));
    }
    need(wasm, wasm.reliefNormalHeights(encoding, green, method), "normals: ");
    const numbers = numbersOf(wasm);
    const Type = data instanceof Float64Array ? Float64Array : Float32Array;
    return {
      heights: rowsFrom(wasm, wasm.reliefHeights(), Float64Array, width, height, 1, Type),
      width,
      height,
      spacing,
      green: greens[numbers.green],
      greenKnown: numbers.greenKnown !== 0,
      encoding: encodings[numbers.encoding],
      parts: numbers.parts,
      iterations: numbers.iterations,
      warnings: oddities(numbers),
    };
  });
}
