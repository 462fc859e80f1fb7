// SPDX-License-Identifier: BSD-3-Clause
//
// What the package finds for others: plans of scenes for the WebGL host, presets as options, exposures.

import assert from "node:assert/strict";
import { test } from "node:test";

import { findExposure, makeTerrain, planScene, presetNames, presetOptions, shade } from "./Shared.mjs";

const [width, height] = [60, 50];
const heights = Float32Array.from(makeTerrain(width, height));
const spacing = [2, 3];
const bounds = {
  width,
  height,
  spacing,
  bottom: heights.reduce((a, b) => Math.min(a, b)),
  top: heights.reduce((a, b) => Math.max(a, b)),
};
const near = (a, b, most = 1e-6) => a.every((c, k) => Math.abs(c - b[k]) <= most);
const total = (lights, of) => lights.reduce((sum, light) => sum.map((s, c) => s + of(light)[c]), [0, 0, 0]);

test("a sun is planned as it stands, and its disc as lights that sum to it", async () => {
  const one = await planScene({ sun: [90, 30], diffuseColor: [0.5, 0.5, 0.5] }, bounds);
  assert.equal(one.lights.length, 1);
  assert.ok(near(one.lights[0].vector, [Math.cos(Math.PI / 6), 0, 0.5]));
  assert.ok(one.lights[0].directional && one.lights[0].one && one.lights[0].matte && one.lights[0].shows);
  assert.deepEqual(one.sums, { diffuse: true, scatter: false, specular: false });
  assert.equal(one.medium.depth, 2.5); // the mean of the spacing
  const color = [1, 0.5, 0.25];
  const disc = await planScene(
    {
      suns: [{ azimuth: 90, altitude: 30, angularDiameter: 10, color, intensity: 2 }],
      numberOfSunSamples: 12,
    },
    bounds,
  );
  assert.equal(disc.lights.length, 12);
  assert.ok(disc.lights.every((light) => !light.one));
  assert.ok(
    near(
      total(disc.lights, (light) => light.radiance),
      [2, 1, 0.5],
    ),
  );
  const middle = total(disc.lights, (light) => light.vector);
  assert.ok(
    near(
      middle.map((c) => c / Math.hypot(...middle)),
      one.lights[0].vector,
    ),
  );
});

test("lamps stand above the datum and in the frame of the south-western sample", async () => {
  const options = { lamp: [1010, 520, 90000], heightScale: 2 };
  const place = { ...bounds, origin: [1000, 500], bottom: 40000, top: 40100 };
  const single = await planScene(options, place);
  assert.equal(single.datum, 0);
  assert.ok(near(single.lights[0].traced, [10, 20, 90000]));
  const precise = await planScene(options, { ...place, floats: false });
  assert.ok(precise.datum > 80000 && precise.datum < 80200, `${precise.datum}`);
  assert.ok(near(precise.lights[0].traced, [10, 20, 90000 - precise.datum]));
  assert.equal(precise.heightScale, 2);
});

test("an environment is lights far away, or on a sphere about the middle", async () => {
  const environment = { image: "clearSky", azimuth: 120, altitude: 40, numberOfSamples: 16, intensity: 0.5 };
  const far = await planScene({ environment, sun: [315, 45] }, bounds);
  assert.ok(far.lights.length > 8 && far.lights.slice(1).every((light) => light.directional && !light.one));
  const brighter = await planScene({ environment: { ...environment, intensity: 1 } }, bounds);
  assert.ok(
    near(
      brighter.lights[0].radiance,
      far.lights[1].radiance.map((c) => 2 * c),
    ),
  );
  const close = await planScene({ environment: { ...environment, radius: 100 } }, bounds);
  const center = [
    ((width - 1) * spacing[0]) / 2,
    ((height - 1) * spacing[1]) / 2,
    (bounds.bottom + bounds.top) / 2,
  ];
  for (const [k, light] of close.lights.entries()) {
    assert.ok(light.positional && !light.directional);
    const away = light.traced.map((c, axis) => c - center[axis]);
    assert.ok(Math.abs(Math.hypot(...away) - 100) < 1e-3);
    assert.ok(
      near(
        away.map((c) => c / 100),
        far.lights[k + 1].vector,
        1e-5,
      ),
    );
  }
});

test("what does not show is told", async () => {
  const dark = await planScene({ suns: [{ azimuth: 0, altitude: -20 }] }, bounds);
  assert.ok(!dark.lights[0].shows && !dark.sums.diffuse);
  const mirror = await planScene({ sun: [0, 40], specularCoefficient: 1, diffuseColor: [1, 1, 1] }, bounds);
  assert.deepEqual(mirror.sums, { diffuse: false, scatter: false, specular: true });
  const black = await planScene({ sun: [0, 40], diffuseColor: [0, 0, 0] }, bounds);
  assert.ok(!black.lights[0].shows);
  // But for a texture, which may be of any colour.
  const diffuseTexture = { data: new Uint8Array(3), width: 1, height: 1 };
  const textured = await planScene({ sun: [0, 40], diffuseColor: [0, 0, 0], diffuseTexture }, bounds);
  assert.ok(textured.lights[0].shows && textured.textures.diffuse.data === diffuseTexture.data);
});

test("what is wrong with a plan is said", async () => {
  await assert.rejects(planScene({ tolerance: -1 }, bounds), { name: "RangeError", message: /tolerance/ });
  await assert.rejects(planScene({}, { ...bounds, bottom: -3e38, top: 3e38 }), /reach from/);
  await assert.rejects(planScene({}, undefined), { name: "TypeError", message: /bounds/ });
  await assert.rejects(planScene({}, { ...bounds, top: "high" }), {
    name: "TypeError",
    message: /bounds\.top/,
  });
  await assert.rejects(planScene({ heightScale: "auto" }, bounds), /fitHeightScale/);
  await assert.rejects(planScene({ sunn: [1, 2] }, bounds), /did you mean/);
});

test("a preset's options are the preset", async () => {
  assert.equal(presetNames.length, 6);
  for (const preset of presetNames) {
    const options = await presetOptions(preset);
    assert.ok(options.lights.length > 0 || options.environment, preset);
    const given = await shade(heights, { width, height, spacing, ...options });
    const named = await shade(heights, { width, height, spacing, preset });
    assert.deepEqual(given.data, named.data, preset);
  }
  const { lights } = await presetOptions({ name: "sun-and-sky", azimuth: 100, altitude: 12 });
  assert.deepEqual([lights[0].azimuth, lights[0].altitude], [100, 12]);
  const usual = await shade(heights, { width, height, spacing });
  assert.deepEqual((await shade(heights, { width, height, spacing, preset: "default" })).data, usual.data);
  await assert.rejects(presetOptions("noon"), { name: "TypeError", message: /preset/ });
});

test("an exposure is found without a picture", async () => {
  const options = { width, height, spacing, sun: [315, 20], diffuseColor: [0.2, 0.3, 0.1] };
  const { statistics } = await shade(heights, { ...options, exposure: "auto" });
  assert.equal(await findExposure(heights, { ...options, exposure: "auto" }), statistics.exposure);
  assert.ok(statistics.exposure > 1);
  assert.equal(await findExposure(heights, { ...options, exposure: -1.5 }), -1.5);
  assert.equal(
    await findExposure(new Float32Array(4).fill(NaN), { width: 2, height: 2, exposure: "auto" }),
    0,
  );
});
