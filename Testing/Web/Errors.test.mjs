// SPDX-License-Identifier: BSD-3-Clause
//
// Each mistake has one message that names it, what was given and what was expected.

import assert from "node:assert/strict";
import { test } from "node:test";

import { createWorkerShader, parameters, sceneFromJSON, shade } from "./Shared.mjs";

const heights = new Float32Array(12);
const size = { width: 4, height: 3 };

async function refuses(options, Type, message, given = heights) {
  await assert.rejects(
    () => shade(given, { ...size, ...options }),
    (error) => {
      assert.equal(error.constructor, Type, `${error}`);
      assert.ok(error.message.length <= 250, error.message);
      assert.match(error.message, message);
      return true;
    },
  );
}

test("values out of range are RangeErrors", async () => {
  const cases = [
    [{ specularCoefficient: 1.5 }, /^specularCoefficient: 1.5 was given, a number in \[0, 1\] is expected$/],
    [{ tolerance: -1 }, /^tolerance: -1 was given, a finite number of at least 0 is expected$/],
    [{ heightScale: NaN }, /^heightScale: NaN was given, a finite number is expected$/],
    [{ depth: -1 }, /^subsurfaceDepth: -1 was given, a finite number of at least 0/],
    [{ exposure: 21 }, /^exposure: 21 was given, a number in \[-20, 20\] is expected$/],
    [
      { baseColor: [0, -1, 0] },
      /^baseColor: \[0,-1,0\] was given, finite components of at least 0 are expected$/,
    ],
    [
      { specularRange: [1, 0] },
      /^specularRange: .*two finite numbers of which the first is not the larger are expected$/,
    ],
    [{ numberOfSteps: 0 }, /^numberOfSteps: 0 was given, a number in \[1, 1000000\] is expected$/],
    [
      { environment: { image: "whiteDome", radius: 0 } },
      /^environment.radius: 0 was given, a number above 0 is expected$/,
    ],
    [
      { environment: { image: "clearSky", azimuth: 0, altitude: -5 } },
      /^environment: azimuth 0, altitude -5, turbidity 3 was given/,
    ],
    [
      { sun: [0, 91] },
      /^sun: azimuth 0, altitude 91 was given, a finite azimuth and an altitude in \[-90, 90\]/,
    ],
    [
      { suns: [[0, 10], { angularDiameter: 91 }] },
      /^suns\[1\].angularDiameter: 91 was given, a number in \[0, 90\] is expected$/,
    ],
    [
      { preset: { name: "sun-and-sky", altitude: -1 } },
      /^preset: azimuth 315, altitude -1 was given, .* in \[0, 90\]/,
    ],
    [{ lamp: [0, NaN, 1] }, /^lamp.position: .* a finite position is expected$/],
    [{ spacing: 0 }, /^spacing: 0 was given, numbers from 1e-32 to 1e32 are expected$/],
    [{ spacing: [1, -2] }, /^spacing: \[1,-2\] was given/],
    [{ width: 0 }, /^width: 0 was given, a whole number in \[1, 1073741824\] is expected$/],
    [{ height: 2.5 }, /^height: 2.5 was given/],
    [
      { width: 20000, height: 20000 },
      /^width 20000 x height 20000 is too large, at most 134217728 are expected/,
    ],
    [{ width: 5 }, /^heights: 12 values were given, width 5 x height 3 = 15 are expected$/],
    [{ mask: [1] }, /^mask: 1 values were given, 12 are expected, as many as heights$/],
    [
      { diffuseTexture: { data: new Uint8Array(7), width: 2, height: 1 } },
      /^diffuseTexture.data: Uint8Array of 7 was given, 1 \(grey\), 2/,
    ],
    [{ layers: ["shadow"], lamp: [0, 0, 1] }, /^the layer shadow is that of a sun, and no sun is on/],
  ];
  for (const [options, message] of cases) {
    await refuses(options, RangeError, message);
  }
  await refuses({}, RangeError, /^heights reach from 0 to 1e\+300, numbers within single precision/, [
    1e300,
    ...new Array(11).fill(0),
  ]);
});

test("other mistakes are TypeErrors, with a suggestion where there is one", async () => {
  const cases = [
    [
      { specularCoeficient: 0.5 },
      /^specularCoeficient: there is no such option; did you mean specularCoefficient\?$/,
    ],
    [{ sunn: [0, 1] }, /^sunn: there is no such option; did you mean suns?\?$/],
    [{ zzzzzzzz: 1 }, /^zzzzzzzz: there is no such option$/],
    [{ sun: { azimut: 3 } }, /^sun.azimut: there is no such option; did you mean azimuth\?$/],
    [
      { environment: { image: "whiteDome", rotation: 3 } },
      /^environment.rotation: there is no such option; did you mean rotationZ\?$/,
    ],
    [{ specularCoefficient: "1" }, /^specularCoefficient: "1" was given, a number is expected$/],
    [{ useFloor: 1 }, /^useFloor: 1 was given, true or false is expected$/],
    [{ numberOfSunSamples: 1.5 }, /^numberOfSunSamples: 1.5 was given, a whole number is expected$/],
    [
      { offsetMode: "sideways" },
      /^offsetMode: "sideways" was given, "vertical", "normal" or "tangent-plane" is expected$/,
    ],
    [{ baseColor: [1, 2] }, /^baseColor: \[1,2\] was given, an array of 3 numbers is expected$/],
    [{ sun: [1] }, /^sun: \[1\] was given, \[azimuth, altitude\] or an object is expected$/],
    [{ sun: 315 }, /^sun: 315 was given/],
    [{ suns: [315, 25] }, /^suns\[0\]: 315 was given/],
    [{ lamp: {} }, /^lamp.position: undefined was given, an array of 3 numbers is expected$/],
    [{ lamp: { position: [0, 0, 1], angularDiameter: 1 } }, /^lamp.angularDiameter: there is no such option/],
    [
      { preset: "sky" },
      /^preset: "sky" was given, "multidirectional", "sky-dome", .* "igor" or "default" is expected$/,
    ],
    [{ preset: "igor", sun: [1, 2] }, /^sun: the preset "igor" brings its own; place it by preset:/],
    [{ preset: { name: "sky-dome", azimuth: 1 } }, /^preset: "sky-dome" has no sun to be placed/],
    [
      { preset: "sky-dome", environment: "whiteDome" },
      /^environment.image: the sky of the preset is there already/,
    ],
    [{ environment: { intensity: 1 } }, /^environment.image: undefined was given/],
    [
      { environment: { image: "file", file: "a.exr" } },
      /^environment.file: "a.exr" is not read here; give its pixels/,
    ],
    [{ depth: 1, subsurfaceDepth: 2 }, /^depth: subsurfaceDepth was given, too/],
    [{ floor: 1, useFloor: false }, /^floor: floorHeight or useFloor was given, too/],
    [{ layers: "illumination" }, /^layers: "illumination" was given, an array is expected$/],
    [{ layers: ["brightness"] }, /^layers\[0\]: "brightness" was given, "illumination", "thickness"/],
    [{ output: "png" }, /^output: "png" was given, "rgba8" or "float" is expected$/],
    [{ width: "4" }, /^width: "4" was given, a whole number is expected$/],
    [{ mask: 5 }, /^mask: 5 was given, an array, 0 where there are no data, is expected$/],
    [{ nodata: "x" }, /^nodata: "x" was given, a number is expected$/],
    [{ spacing: "1" }, /^spacing: "1" was given, a number, or two of them, is expected$/],
    [
      { baseTexture: { data: [1], width: 1, height: 1 } },
      /^baseTexture.data: \[1\] was given, an array of 8 or 16 bit/,
    ],
  ];
  for (const [options, message] of cases) {
    await refuses(options, TypeError, message);
  }
  await refuses(
    {},
    TypeError,
    /^heights: BigInt64Array of 12 was given, a typed array of integers up to 32 bit/,
    new BigInt64Array(12),
  );
  await refuses({}, TypeError, /^heights: null was given/, null);
  await refuses({}, TypeError, /^heights: "abc" was given/, "abc");
  await assert.rejects(() => shade(heights, null), TypeError);
});

test("every parameter is refused where the table says so, and taken at its ends", async () => {
  for (const row of parameters) {
    const set = (value) => {
      const options = { [row.key]: value };
      switch (row.owner) {
        case "environment":
          return { environment: { image: "whiteDome", numberOfSamples: 8, ...options } };
        case "light":
          return { sun: options };
        default:
          return options;
      }
    };
    const wrong = new RegExp(`(^|\\.)${row.key}: `);
    await refuses(set(Symbol("no")), TypeError, wrong);
    await refuses(set("no such word"), TypeError, wrong);
    if (["number", "count", "length"].includes(row.kind)) {
      await refuses(set(NaN), RangeError, wrong);
      for (const end of [row.minimum, row.maximum].filter((value) => value !== null)) {
        const outside = end === row.minimum ? end - 1 : end + 1;
        await refuses(set(outside), RangeError, wrong);
        // Many lights take long, and are the same.
        if (!(row.minimumOpen && end === row.minimum) && end < 1000) {
          await shade(heights, { ...size, ...set(end) });
        }
      }
    }
    for (const choice of row.choices) {
      await shade(heights, { ...size, ...set(choice.word) });
      await shade(heights, { ...size, ...set(choice.name) });
    }
  }
});

test("scenes that are wrong say where", () => {
  const fails = (text, Type, message) =>
    assert.throws(
      () => sceneFromJSON(text),
      (error) => {
        assert.equal(error.constructor, Type, `${error}`);
        assert.match(error.message, message);
        return true;
      },
    );
  fails("{", SyntaxError, /JSON/);
  fails("[]", TypeError, /^scene: \[\] was given, an object with the key "reliefScene" is expected$/);
  fails("{}", TypeError, /^scene: the key "reliefScene" is missing$/);
  fails('{ "reliefScene": 2 }', RangeError, /version 2, this package reads version 1$/);
  fails(
    '{ "reliefScene": 1, "material": { "specularCoefficient": 1.5 } }',
    RangeError,
    /^material.specularCoefficient: 1.5 was given, a number in \[0, 1\] is expected$/,
  );
  fails(
    '{ "reliefScene": 1, "lights": [{ "kind": "star" }] }',
    TypeError,
    /^lights\[0\].kind: "star" was given, "sun" or "point"/,
  );
  fails(
    '{ "reliefScene": 1, "lights": [{ "kind": "sun", "azimuth": 1 }] }',
    TypeError,
    /^lights\[0\]: the key "altitude" is missing$/,
  );
  fails('{ "reliefScene": 1, "environment": {} }', TypeError, /^environment: the key "image" is missing$/);
  fails(5, TypeError, /^scene: 5 was given/);
});

test("there is no worker in Node.js, and that is said", () => {
  assert.throws(() => createWorkerShader(), /there is no Worker here/);
});

test("after an error the next run is well", async () => {
  await refuses({}, RangeError, /./, [1e300, ...new Array(11).fill(0)]);
  const { data } = await shade(heights, { ...size, sun: [0, 90] });
  assert.equal(data[0], 255);
});
