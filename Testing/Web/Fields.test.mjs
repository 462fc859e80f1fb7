// SPDX-License-Identifier: BSD-3-Clause
//
// What is known of pictures: planes, rows, no data, scales, exposures.

import assert from "node:assert/strict";
import { test } from "node:test";

import {
  environmentLights,
  fitHeightScale,
  makePlane,
  makeRandom,
  makeTerrain,
  parameters,
  shade,
} from "./Shared.mjs";

const sine = (degrees) => Math.sin((degrees * Math.PI) / 180);
const near = (value, expected, bound, text) =>
  assert.ok(Math.abs(value - expected) <= bound, `${text ?? "value"}: ${value}, expected ${expected}`);

test("on level ground d is the sine of the altitude, and r what light has passed", async () => {
  for (const altitude of [5, 30, 62.5, 90]) {
    for (const Type of [
      Float32Array,
      Float64Array,
      Int8Array,
      Uint8Array,
      Int16Array,
      Uint16Array,
      Int32Array,
      Uint32Array,
    ]) {
      const heights = new Type(12 * 9).fill(100);
      const { layers, data } = await shade(heights, {
        width: 12,
        height: 9,
        spacing: 30,
        sun: [77, altitude],
        layers: ["illumination", "thickness"],
        output: "float",
      });
      for (let k = 0; k < heights.length; ++k) {
        near(layers.illumination[k], sine(altitude), 1e-6, Type.name);
        near(layers.thickness[k], 30 / sine(altitude), 1e-3);
        near(data[4 * k], sine(altitude), 1e-6);
        assert.equal(data[4 * k + 3], 1);
      }
    }
  }
});

test("on planes d is the cosine of the light's angle", async () => {
  const random = makeRandom(7);
  for (let run = 0; run < 8; ++run) {
    const [east, north] = [random() - 0.5, random() - 0.5];
    const [azimuth, altitude] = [360 * random(), 50 + 40 * random()];
    const { layers } = await shade(makePlane(40, 30, east, north), {
      width: 40,
      height: 30,
      sun: [azimuth, altitude],
      layers: ["illumination", "normals"],
      tolerance: 0,
    });
    const n = [-east, -north, 1].map((c) => c / Math.hypot(east, north, 1));
    const level = sine(90 - altitude);
    const l = [sine(azimuth) * level, sine(90 - azimuth) * level, sine(altitude)];
    const cosine = n[0] * l[0] + n[1] * l[1] + n[2] * l[2];
    const middle = 15 * 40 + 20;
    near(layers.illumination[middle], cosine, 2e-5, `${east} ${north} ${azimuth} ${altitude}`);
    n.forEach((c, k) => near(layers.normals[3 * middle + k], c, 1e-6));
  }
});

test("the first row is the northern one", async () => {
  // A wall along the middle row: a sun in the north shades what is south of it, which are the later rows.
  const [width, height] = [20, 21];
  const heights = new Float32Array(width * height);
  heights.fill(10, 10 * width, 11 * width);
  const { layers } = await shade(heights, { width, height, sun: [0, 30], layers: ["shadow"] });
  assert.equal(layers.shadow[5 * width + 10], 0);
  assert.equal(layers.shadow[14 * width + 10], 1);
});

test("lamps stand at coordinates whose origin is the south-western sample", async () => {
  const [width, height] = [31, 21];
  const heights = new Float32Array(width * height);
  const options = { width, height, spacing: 2, layers: ["illumination"] };
  const { layers } = await shade(heights, { ...options, lamp: [2 * 25, 2 * 16, 10] });
  const brightest = layers.illumination.indexOf(Math.max(...layers.illumination));
  assert.equal(brightest, (height - 1 - 16) * width + 25);
  const moved = await shade(heights, { ...options, origin: [4e5, 5e6], lamp: [4e5 + 50, 5e6 + 32, 10] });
  assert.deepEqual(moved.layers, layers);
});

test("no data is transparent, whatever says so", async () => {
  const [width, height] = [30, 20];
  const terrain = makeTerrain(width, height);
  const holes = [3, 77, 400, 599];
  const asNaN = terrain.slice();
  const asValue = terrain.slice();
  const mask = new Array(terrain.length).fill(true);
  for (const at of holes) {
    asNaN[at] = NaN;
    asValue[at] = -9999;
    mask[at] = false;
  }
  const options = { width, height, sun: [315, 30], layers: ["illumination", "normals"] };
  const first = await shade(asNaN, options);
  for (let k = 0; k < terrain.length; ++k) {
    const hole = holes.includes(k);
    assert.equal(first.data[4 * k + 3], hole ? 0 : 255);
    assert.equal(Number.isNaN(first.layers.illumination[k]), hole);
    assert.equal(Number.isNaN(first.layers.normals[3 * k]), hole);
  }
  assert.deepEqual((await shade(asValue, { ...options, nodata: -9999 })).data, first.data);
  assert.deepEqual((await shade(terrain, { ...options, mask })).data, first.data);
  assert.deepEqual((await shade(Array.from(asNaN), options)).data.length, first.data.length);
  assert.deepEqual(
    (
      await shade(
        Array.from(asNaN, (h) => (Number.isNaN(h) ? null : h)),
        options,
      )
    ).data,
    first.data,
  );

  const none = await shade(new Float32Array(6).fill(NaN), { width: 3, height: 2 });
  assert.ok(none.data.every((code) => code === 0));
  assert.match(none.warnings[0], /No sample has data/);
  const line = await shade(new Float32Array(5), {
    width: 5,
    height: 1,
    sun: [0, 30],
    layers: ["illumination"],
  });
  assert.match(line.warnings[0], /5 x 1 samples has no surface/);
  near(line.layers.illumination[2], 0.5, 1e-6);
});

test("a run gives the same bytes whenever it is made", async () => {
  const terrain = makeTerrain(70, 50);
  const options = { width: 70, height: 50, preset: "sun-and-sky", layers: ["illumination"] };
  const first = await shade(terrain, options);
  await shade(makeTerrain(90, 90, 400, 3), { width: 90, height: 90, lamp: [1, 2, 300], subsurfaceDepth: 80 });
  const second = await shade(terrain, options);
  assert.deepEqual(second, first);
  const [one, two] = await Promise.all([shade(terrain, options), shade(terrain, options)]);
  assert.deepEqual(one.data, first.data);
  assert.deepEqual(two.data, first.data);
});

test("what is given is left alone", async () => {
  const terrain = makeTerrain(20, 20);
  const copy = terrain.slice();
  const options = Object.freeze({
    width: 20,
    height: 20,
    suns: Object.freeze([Object.freeze([10, 20])]),
    depth: "auto",
  });
  await shade(terrain, options);
  assert.deepEqual(terrain, copy);
  // A part of a longer array.
  const long = new Float32Array(500);
  long.set(terrain, 33);
  const part = await shade(long.subarray(33, 433), options);
  assert.deepEqual(part.data, (await shade(terrain, options)).data);
});

test("heights without a unit get a scale", async () => {
  const terrain = makeTerrain(120, 90, 1);
  const options = { width: 120, height: 90 };
  const scale = await fitHeightScale(terrain, options);
  const larger = await fitHeightScale(
    terrain.map((h) => 64 * h),
    options,
  );
  near(scale / larger / 64, 1, 1e-5);
  const { statistics } = await shade(terrain, { ...options, heightScale: "auto" });
  assert.equal(statistics.heightScale, scale);
  assert.equal(await fitHeightScale(new Float32Array(100), { width: 10, height: 10 }), 1);
});

test("an automatic exposure shows next to nothing as white", async () => {
  const terrain = makeTerrain(120, 90);
  const options = { width: 120, height: 90, sun: { azimuth: 315, altitude: 30, intensity: 0.1 } };
  const dark = await shade(terrain, options);
  const bright = await shade(terrain, { ...options, exposure: "auto" });
  assert.equal(dark.statistics.exposure, 0);
  assert.ok(bright.statistics.exposure > 2);
  const whites = bright.data.filter((code, k) => k % 4 === 0 && code === 255).length;
  assert.ok(whites < 0.006 * terrain.length);
  assert.deepEqual(
    (await shade(terrain, { ...options, exposure: bright.statistics.exposure })).data,
    bright.data,
  );
});

test("only what the scene calls for is done", async () => {
  const terrain = makeTerrain(20, 20);
  const { statistics } = await shade(terrain, {
    width: 20,
    height: 20,
    sun: [315, 30],
    diffuseColor: [0, 0, 0],
  });
  assert.deepEqual([statistics.raysTraced, statistics.lightsTraced], [0, 0]);
  assert.deepEqual(statistics.effectsEvaluated, []);
  const off = await shade(terrain, { width: 20, height: 20, sun: { on: false } });
  assert.ok(off.data.every((code, k) => code === (k % 4 === 3 ? 255 : 0)));
});

test("every parameter changes the picture or what is done for it", async () => {
  const terrain = makeTerrain(48, 40);
  const sun = { azimuth: 315, altitude: 20 };
  const lit = { sun: [315, 20] };
  const shiny = { ...lit, specularCoefficient: 0.5 };
  const backlit = { lamp: [24, 20, -60], floor: -50, depth: 6, forwardScatterCoefficient: 0.5 };
  const sky = { image: "clearSky", azimuth: 100, altitude: 30 };
  // Two scenes that differ in that parameter alone.
  const pairs = {
    scene: {
      heightScale: [lit, { ...lit, heightScale: 2 }],
      integrator: [lit, { ...lit, integrator: "fixed-step" }],
      tolerance: [lit, { ...lit, tolerance: 0.2 }],
      numberOfSteps: [16, 64].map((numberOfSteps) => ({ ...lit, integrator: "fixed-step", numberOfSteps })),
      response: [lit, { ...lit, response: "igor" }],
      numberOfSunSamples: [2, 9].map((numberOfSunSamples) => ({
        sun: { ...sun, angularDiameter: 9 },
        numberOfSunSamples,
      })),
      exposure: [lit, { ...lit, exposure: -1 }],
      automaticExposure: [lit, { ...lit, automaticExposure: true }],
    },
    material: {
      baseColor: [lit, { ...lit, baseColor: [0, 0.2, 0] }],
      diffuseColor: [lit, { ...lit, diffuseColor: [1, 0.5, 1] }],
      specularColor: [shiny, { ...shiny, specularColor: [0, 1, 0] }],
      specularCoefficient: [lit, shiny],
      specularRange: [shiny, { ...shiny, specularRange: [-1, 0.5] }],
      specularPower: [shiny, { ...shiny, specularPower: 9 }],
      forwardScatterCoefficient: [backlit, { ...backlit, forwardScatterCoefficient: 1 }],
      forwardScatterRange: [backlit, { ...backlit, forwardScatterRange: [0.5, 1] }],
      forwardScatterPower: [backlit, { ...backlit, forwardScatterPower: 4 }],
      subsurfaceDepth: [lit, { ...lit, subsurfaceDepth: 9 }],
      automaticSubsurfaceDepth: [false, true].map((automatic) => ({
        ...lit,
        subsurfaceDepth: 9,
        automaticSubsurfaceDepth: automatic,
      })),
      offsetMode: [lit, { ...lit, offsetMode: "vertical" }],
      attenuation: [lit, { ...lit, attenuation: "exponential" }],
      density: [0.5, 2].map((density) => ({ ...lit, attenuation: "exponential", density })),
      useFloor: [backlit, { ...backlit, floor: undefined }],
      floorHeight: [backlit, { ...backlit, floor: -30 }],
    },
    environment: {
      rotationZ: [sky, { ...sky, rotationZ: 90 }],
      tilt: [sky, { ...sky, tilt: 30 }],
      intensity: [sky, { ...sky, intensity: 0.5 }],
      radius: [sky, { ...sky, radius: 60 }],
      sampling: [sky, { ...sky, sampling: "uniform" }],
      numberOfSamples: [sky, { ...sky, numberOfSamples: 16 }],
    },
    light: {
      angularDiameter: [sun, { ...sun, angularDiameter: 9 }],
      color: [sun, { ...sun, color: [1, 0.5, 0] }],
      intensity: [sun, { ...sun, intensity: 0.5 }],
      on: [sun, { ...sun, on: false }],
    },
  };
  const wrap = {
    scene: (o) => o,
    material: (o) => o,
    environment: (o) => ({ environment: o }),
    light: (o) => ({ sun: o }),
  };
  for (const { owner, key } of parameters) {
    assert.ok(pairs[owner][key], `${owner}.${key} has no scenes here`);
    const results = [];
    for (const options of pairs[owner][key]) {
      const { data } = await shade(terrain, { width: 48, height: 40, ...wrap[owner](options) });
      results.push(data);
    }
    assert.notDeepEqual(results[0], results[1], `${owner}.${key} changes nothing`);
  }
});

test("nothing breaks, whatever the numbers are", async () => {
  const random = makeRandom(11);
  const odd = [NaN, Infinity, -Infinity, 1e38, -1e38, 3e-39, 0, -0, 1e300];
  for (let run = 0; run < 60; ++run) {
    const [width, height] = [1 + Math.floor(9 * random()), 1 + Math.floor(9 * random())];
    const heights = Float64Array.from({ length: width * height }, () =>
      random() < 0.3 ? odd[Math.floor(odd.length * random())] : 10 * random(),
    );
    const options = {
      width,
      height,
      spacing: 10 ** (20 * random() - 10),
      output: "float",
      depth: random() < 0.3 ? 0 : 10 ** (40 * random() - 20),
      sun: [360 * random(), 180 * random() - 90],
      lamp: [1e30 * random(), 0, random()],
      floor: random() < 0.5 ? 5 : null,
      offsetMode: ["vertical", "normal", "tangent-plane"][run % 3],
    };
    try {
      const { data } = await shade(heights, options);
      assert.ok(!data.some(Number.isNaN), JSON.stringify(options));
    } catch (error) {
      assert.ok(error instanceof RangeError, `${error}`);
      assert.match(error.message, /^heights reach from/);
    }
  }
});

test("the lights of an environment light level ground as it does", async () => {
  const run = { width: 3, height: 3, output: "float" };
  const environments = [
    { image: "whiteDome", intensity: 0.5 },
    { image: "clearSky", azimuth: 80, altitude: 25, tilt: 20, rotationZ: 50, numberOfSamples: 40 },
    {
      image: { data: new Uint8Array(24).map((_, k) => 10 * k), width: 4, height: 2 },
      sampling: "importance",
    },
  ];
  for (const environment of environments) {
    const lights = await environmentLights({ environment });
    const { data } = await shade(new Float32Array(9), { ...run, environment });
    for (const c of [0, 1, 2]) {
      const sum = lights.reduce((s, l) => s + l.color[c] * l.weight * Math.max(l.direction[2], 0), 0);
      near(data[16 + c], sum, 2e-3 * Math.max(sum, 1), `component ${c} of ${environment.image}`);
    }
  }
  assert.deepEqual(await environmentLights({}), []);
  assert.deepEqual(await environmentLights({ environment: { image: "none" } }), []);
  await assert.rejects(
    environmentLights({ environment: { image: "whiteDome", radius: 5 } }),
    /environment.radius: 5 was given/,
  );
  await assert.rejects(
    environmentLights({ environment: { image: "file", file: "a.exr" } }),
    /is not read here/,
  );
});
