// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes go to reliefshade's files and come back, and the picture stays.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";

import { makeTerrain, parameters, sceneFromJSON, sceneToJSON, shade } from "./Shared.mjs";

const width = 60;
const height = 45;
const terrain = makeTerrain(width, height, 12);
let folder;

before(() => {
  folder = mkdtempSync(join(tmpdir(), "reliefshading-"));
  // An ESRI grid has lengths, whose coordinates are the map's.
  const rows = Array.from({ length: height }, (_, j) =>
    Array.from(terrain.slice(j * width, (j + 1) * width)).join(" "),
  );
  writeFileSync(
    join(folder, "heights.asc"),
    `ncols ${width}\nnrows ${height}\nxllcenter 1000\nyllcenter 2000\ncellsize 1\n${rows.join("\n")}\n`,
  );
});
after(() => rmSync(folder, { recursive: true, force: true }));

function reliefshade(...options) {
  execFileSync(process.env.RELIEFSHADE, options, { cwd: folder, stdio: ["ignore", "ignore", "inherit"] });
}

// A picture's codes: of one component where it is grey.
function readPicture(file) {
  const bytes = readFileSync(join(folder, file));
  const header = /^P([56])\s+(\d+)\s+(\d+)\s+255\s/.exec(bytes.subarray(0, 40).toString("latin1"));
  assert.deepEqual([header[2], header[3]], [String(width), String(height)]);
  return { components: header[1] === "5" ? 1 : 3, codes: bytes.subarray(header[0].length) };
}

// The file of a scene, whose azimuths reliefshade writes in [0, 360).
function parse(text) {
  const scene = JSON.parse(text);
  scene.lights.forEach((light) => light.kind === "sun" && (light.azimuth %= 360));
  return scene;
}

const scenes = {
  plain: {},
  everything: {
    suns: [
      { azimuth: 301.25, altitude: 22.125, color: [1, 0.8, 0.55], intensity: 0.75, angularDiameter: 3 },
      [120, 60],
    ],
    lamps: [{ position: [1030, 2010, 25], intensity: 0.4 }],
    depth: 2.5,
    heightScale: 1.5,
    exposure: 0.5,
    response: "combined",
    environment: {
      image: "clearSky",
      azimuth: 300,
      altitude: 22,
      turbidity: 4,
      intensity: 0.2,
      rotationZ: 10,
    },
    specularCoefficient: 0.2,
    specularPower: 12,
    baseColor: [0.01, 0.02, 0.03],
    attenuation: "exponential",
    density: 0.4,
    floor: -50,
  },
  automatic: { sun: [10, 20], exposure: "auto", depth: "auto" },
  multidirectional: { preset: "multidirectional" },
  skyDome: { preset: "sky-dome", environment: { numberOfSamples: 32 } },
  sunAndSky: { preset: { name: "sun-and-sky", azimuth: 250, altitude: 33 } },
  igor: { preset: { name: "igor", azimuth: 100 } },
  sphere: { environment: { image: "whiteDome", radius: 90 } },
  dark: { sun: { on: false } },
};

for (const [name, options] of Object.entries(scenes)) {
  test(`${name}: reliefshade makes the same picture of the file`, async () => {
    const text = await sceneToJSON({ tolerance: 0, ...options });
    writeFileSync(join(folder, "scene.json"), text);
    reliefshade("heights.asc", "native.ppm", "--scene", "scene.json");
    const { components, codes } = readPicture("native.ppm");
    const run = { width, height, origin: [1000, 2000] };
    const ours = (await shade(terrain, { ...run, tolerance: 0, ...options })).data;
    const back = (await shade(terrain, { ...run, ...sceneFromJSON(text) })).data;
    assert.deepEqual(back, ours, "read again");
    let most = 0;
    for (let k = 0; k < width * height; ++k) {
      for (let c = 0; c < 3; ++c) {
        most = Math.max(most, Math.abs(codes[components * k + (c % components)] - ours[4 * k + c]));
      }
    }
    assert.ok(most <= 1, `codes differ by ${most}`);
  });

  test(`${name}: what reliefshade keeps is what was given to it`, async () => {
    const text = await sceneToJSON(options);
    writeFileSync(join(folder, "scene.json"), text);
    reliefshade("heights.asc", "kept.ppm", "--scene", "scene.json", "--save-scene", "kept.json");
    const kept = readFileSync(join(folder, "kept.json"), "utf8");
    assert.deepEqual(parse(kept), parse(text));
    assert.deepEqual(parse(await sceneToJSON(sceneFromJSON(kept))), parse(text));
  });
}

test("a file names every parameter, and reading it again gives the same text", async () => {
  const text = await sceneToJSON(scenes.everything);
  const scene = JSON.parse(text);
  const places = { scene, material: scene.material, environment: scene.environment, light: scene.lights[0] };
  for (const { owner, key } of parameters) {
    assert.ok(key in places[owner], `${owner}.${key}`);
  }
  assert.equal(await sceneToJSON(sceneFromJSON(text)), text);
});

test("files that people write may leave out what is usual", async () => {
  const options = sceneFromJSON('{ "reliefScene": 1, "material": { "subsurfaceDepth": 60 }, "exposure": 1 }');
  const scene = JSON.parse(await sceneToJSON(options));
  assert.deepEqual([scene.material.automaticSubsurfaceDepth, scene.automaticExposure], [false, false]);
  assert.deepEqual([scene.material.subsurfaceDepth, scene.exposure, scene.tolerance], [60, 1, 0.0003]);
});

test("what a file cannot hold is refused", async () => {
  await assert.rejects(() => sceneToJSON({ heightScale: "auto" }), /depends on heights/);
  const image = { data: new Float32Array(6), width: 2, height: 1 };
  await assert.rejects(() => sceneToJSON({ environment: { image } }), /name their file by environment.file/);
  const text = await sceneToJSON({ environment: { image, file: "sky.exr" } });
  assert.equal(JSON.parse(text).environment.file, "sky.exr");
});

test("keys that nobody knows are left out, and named", (t) => {
  const warn = t.mock.method(console, "warn", () => {});
  assert.deepEqual(sceneFromJSON('{ "reliefScene": 1, "steepness": 2, "lights": [] }'), { lights: [] });
  assert.match(warn.mock.calls[0].arguments[0], /left out: steepness\./);
});
