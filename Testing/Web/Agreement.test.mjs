// SPDX-License-Identifier: BSD-3-Clause
//
// WebAssembly and the native filter give the same pictures and layers, over all that scenes have.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";

import { makeRandom, makeTerrain, sceneToJSON, shade } from "./Shared.mjs";

const width = 97;
const height = 83;
const samples = width * height;
const terrain = makeTerrain(width, height);

function withHoles(heights) {
  const result = heights.slice();
  for (let j = 20; j < 35; ++j) {
    result.fill(NaN, j * width + 40, j * width + 58);
  }
  result[5 * width + 5] = NaN;
  return result;
}

function makePicture(columns, rows, components, Type, top) {
  const random = makeRandom(columns);
  return {
    data: Type.from({ length: columns * rows * components }, () => top * random()),
    width: columns,
    height: rows,
  };
}

// A panorama with a bright spot.
function makePanorama() {
  const picture = makePicture(64, 32, 3, Float32Array, 0.4);
  picture.data.fill(30, (6 * 64 + 9) * 3, (6 * 64 + 12) * 3);
  return picture;
}

// Rays end where what follows is less than the tolerance, in groups that depend on the processor. So what is
// compared has none; that the default keeps its promise is a test of its own.
const exact = { tolerance: 0 };

const everything = ["illumination", "thickness", "normals", "base", "diffuse", "scatter", "specular"];
const marked = Int16Array.from(terrain, (h, k) => (k % 37 === 0 ? -9999 : 100 * h));
const bytes = Uint8Array.from(terrain, (h) => 128 + 3 * h);
const mask = Uint8Array.from(
  { length: samples },
  (_, k) => ((k % width) - 60) ** 2 + (k / width - 40) ** 2 > 150,
);

const scenes = {
  default: {},
  sun: { sun: [315, 20], layers: everything },
  lowSun: { sun: [75, 4], depth: 3 },
  disc: {
    sun: { azimuth: 200, altitude: 18, angularDiameter: 6 },
    numberOfSunSamples: 24,
    layers: ["shadow"],
  },
  suns: {
    suns: [
      [10, 30],
      { azimuth: 100, altitude: 50, color: [1, 0.5, 0.2], intensity: 0.6 },
      { azimuth: 20, altitude: 9, on: false },
      { azimuth: 250, altitude: 70, intensity: -0.1 },
    ],
    layers: ["illumination"],
  },
  lamp: { lamp: [30, 50, 25], layers: ["illumination", "thickness"] },
  lampAndSun: {
    lamps: [{ position: [80, 10, 40], color: [1, 0.8, 0.6], intensity: 0.7 }],
    sun: [300, 35],
    specularCoefficient: 0.4,
    specularPower: 8,
    specularRange: [0.2, 1],
    specularColor: [0.9, 1, 0.8],
    layers: everything,
  },
  backlight: {
    floor: -40,
    lamp: [48, 40, -60],
    depth: 6,
    forwardScatterCoefficient: 0.6,
    forwardScatterPower: 2,
    forwardScatterRange: [-0.2, 0.9],
    layers: everything,
  },
  exponential: { sun: [120, 25], attenuation: "exponential", density: 0.3, depth: 2 },
  vertical: { sun: [315, 40], offsetMode: "vertical", depth: 4 },
  normal: { sun: [315, 40], offsetMode: "normal", depth: 4 },
  opaque: { sun: [210, 22], depth: 0 },
  soft: { sun: [315, 30], depth: 25, tolerance: 0 },
  fixedSteps: { lamp: [20, 20, 50], integrator: "fixed-step", numberOfSteps: 100 },
  skyDome: { preset: "sky-dome" },
  sunAndSky: { preset: { name: "sun-and-sky", azimuth: 290, altitude: 20 }, layers: ["illumination"] },
  multidirectional: { preset: "multidirectional" },
  combined: { preset: { name: "combined", azimuth: 315, altitude: 35 } },
  igor: { preset: "igor" },
  panorama: {
    environment: {
      image: makePanorama(),
      rotationZ: 33,
      tilt: 20,
      sampling: "importance",
      numberOfSamples: 48,
      intensity: 0.8,
    },
  },
  sphere: {
    environment: { image: "whiteDome", radius: 300, sampling: "uniform", numberOfSamples: 25 },
    sun: [40, 40],
  },
  marked: { heights: marked, nodata: -9999, heightScale: 0.012, spacing: 1.5, sun: [315, 30] },
  fitted: { heights: bytes, mask, heightScale: "auto", sun: [315, 30] },
  textures: {
    sun: [315, 35],
    lamp: [10, 10, 30],
    specularCoefficient: 0.3,
    layers: everything,
    baseTexture: makePicture(13, 9, 4, Uint8Array, 255),
    diffuseTexture: makePicture(width, height, 3, Float32Array, 1.5),
    specularTexture: makePicture(31, 40, 1, Uint16Array, 65535),
  },
  datum: {
    heights: Float64Array.from(terrain, (h) => 1e7 + h),
    sun: [315, 25],
    lamp: [50, 50, 1e7 + 30],
    floor: 1e7 - 60,
    layers: ["thickness"],
  },
  oblong: { spacing: [2, 3.5], heightScale: -2, sun: [200, 25], layers: ["normals"] },
  holes: { heights: withHoles(terrain), sun: [315, 15], layers: everything },
  codes: { sun: [315, 25], exposure: "auto", diffuseColor: [0.4, 0.3, 0.2], output: "rgba8" },
  stops: { preset: "sky-dome", exposure: 1.25, output: "rgba8" },
};

//--------------------------------------------------------------------------------------------------
const numpyTypes = {
  Int16Array: "<i2",
  Uint8Array: "u1",
  Uint16Array: "<u2",
  Float32Array: "<f4",
  Float64Array: "<f8",
};
const capital = (word) => word[0].toUpperCase() + word.slice(1);

// A scene as a job of Native.py; its arrays are written into the folder.
async function makeJob(name, options, folder) {
  const save = (label, data, columns, rows) => {
    const file = `${name}-${label}`;
    writeFileSync(join(folder, file), data);
    return { file, type: numpyTypes[data.constructor.name], width: columns, height: rows };
  };
  const { heights = terrain, spacing = 1, nodata, mask: given, layers = [], environment } = options;
  const job = {
    name,
    spacing: typeof spacing === "number" ? [spacing, spacing] : spacing,
    output: options.output ?? "float",
    nodata,
    heights: save("heights", heights, width, height),
    layers: layers.map(capital),
    textures: {},
    fit: options.heightScale === "auto",
  };
  if (given) {
    job.mask = save("mask", given, width, height);
  }
  for (const texture of ["base", "diffuse", "specular"]) {
    const picture = options[`${texture}Texture`];
    if (picture) {
      job.textures[capital(texture)] = save(texture, picture.data, picture.width, picture.height);
    }
  }
  let forFile = { ...options, heightScale: job.fit ? 1 : (options.heightScale ?? 1) };
  if (typeof environment?.image === "object") {
    const { image, rotationZ, tilt, numberOfSamples, intensity } = environment;
    job.environment = {
      image: save("environment", image.data, image.width, image.height),
      values: {
        RotationZ: rotationZ,
        Tilt: tilt,
        NumberOfSamples: numberOfSamples,
        Intensity: intensity,
        Sampling: 2,
      },
    };
    forFile = { ...forFile, environment: undefined };
  }
  job.scene = await sceneToJSON(forFile);
  return job;
}

// Of thickness, which has no bound, beside its size.
function largestDifference(ours, native, relative = false) {
  assert.equal(ours.length, native.length);
  let most = 0;
  for (let k = 0; k < ours.length; ++k) {
    // Equal covers what is infinite; no data are NaN in both.
    if (ours[k] !== native[k] && !(Number.isNaN(ours[k]) && Number.isNaN(native[k]))) {
      const difference = Math.abs(ours[k] - native[k]) / (relative ? Math.max(1, Math.abs(native[k])) : 1);
      most = Number.isNaN(difference) ? Infinity : Math.max(most, difference);
    }
  }
  return most;
}

// The angle of slopes that are nearly level has half the digits of their normals.
const bounds = { igor: 5e-5 };

async function compare(t, settings, boundOf) {
  const folder = mkdtempSync(join(tmpdir(), "reliefshading-"));
  try {
    const jobs = [];
    for (const [name, options] of Object.entries(scenes)) {
      jobs.push(await makeJob(name, { ...settings, ...options }, folder));
    }
    writeFileSync(join(folder, "jobs.json"), JSON.stringify(jobs));
    const script = join(dirname(fileURLToPath(import.meta.url)), "Native.py");
    execFileSync(process.env.RELIEF_PYTHON, [script, join(folder, "jobs.json")], { stdio: "inherit" });
    const results = JSON.parse(readFileSync(join(folder, "results.json"), "utf8"));

    for (const [at, [name, options]] of Object.entries(scenes).entries()) {
      await t.test(name, async () => {
        const { heights = terrain, output = "float", ...rest } = { ...settings, ...options };
        const ours = await shade(heights, { width, height, ...rest, output });
        const read = (label, Type) => {
          const file = readFileSync(join(folder, `${name}.${label}`));
          return new Type(file.buffer.slice(file.byteOffset, file.byteOffset + file.byteLength));
        };
        const picture = largestDifference(
          ours.data,
          read("picture", output === "float" ? Float32Array : Uint8Array),
        );
        const layers = Object.entries(ours.layers).map(([layer, data]) => [
          layer,
          largestDifference(data, read(capital(layer), Float32Array), layer === "thickness"),
        ]);
        const text = layers
          .map(([layer, difference]) => `${layer} ${difference.toExponential(1)}`)
          .join(", ");
        t.diagnostic(`${name}: picture ${picture.toExponential(1)}${text && `, ${text}`}`);
        if (output === "float") {
          assert.ok(picture <= boundOf(name, "picture"), `the picture differs by ${picture}`);
        } else {
          // Codes are whole: a difference of rounding may be one of them, beside 255.
          assert.ok(picture <= 1, `codes differ by ${picture}`);
        }
        for (const [layer, difference] of layers) {
          assert.ok(difference <= boundOf(name, layer), `${layer} differs by ${difference}`);
        }
        assert.equal(ours.statistics.heightScale, results[at].heightScale);
        assert.ok(Math.abs(ours.statistics.exposure - results[at].exposure) < 1e-5);
        assert.deepEqual(ours.warnings, []);
        assert.equal(ours.statistics.lightsTraced, results[at].lightsTraced);
        assert.equal(ours.statistics.raysTraced, results[at].raysTraced);
      });
    }
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
}

test("pictures and layers are those of the native filter", { timeout: 240000 }, (t) =>
  compare(t, exact, (name) => bounds[name] ?? 1e-5),
);

test("with the default tolerance they differ by no more than twice that", { timeout: 240000 }, (t) =>
  // Both may be off by it, times the intensity of all lights, which is at most 2 here. What remains of r is
  // not bounded, only what it does to d.
  compare(t, {}, (name, layer) => (layer === "thickness" ? Infinity : 2 * 0.0003 * 2)),
);
