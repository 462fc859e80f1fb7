// SPDX-License-Identifier: BSD-3-Clause
//
// The package's types, as TypeScript sees them: what its documentation says is right, and mistakes are none of it.

import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { cpSync, mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";

import { packageFolder } from "./Shared.mjs";

const user = `
import {
  createWorkerShader, heightsOfMesh, heightsOfNormals, parameters, presetOptions, sceneFromJSON, sceneToJSON, shade,
} from "reliefshading";

const heights = new Float32Array(12);
const size = { width: 4, height: 3 };
const { data, layers, width, height } = await shade(heights, { ...size, sun: [315, 25], depth: "auto", layers: ["normals"] });
export const image: ImageData = new ImageData(data, width, height);
export const normals: Float32Array | undefined = layers.normals;
export const linear: Float32Array = (await shade(heights, { ...size, output: "float" })).data;
const shader = createWorkerShader({ workers: "auto" });
new ImageData((await shader.shade(heights, size, { transfer: true })).data, 4, 3);
shader.terminate();
const found = await heightsOfMesh("v 0 0 0", { resolution: 10, viewDirection: [0, 0, 1] });
await shade(found.heights, { width: found.width, height: found.height, spacing: found.spacing });
await heightsOfNormals({ data: new Uint8Array(12), width: 2, height: 2 }, { green: "up" });
await shade(heights, { ...size, ...sceneFromJSON(await sceneToJSON({ preset: "igor" })), ...(await presetOptions("sky-dome")) });
export const label: string = parameters[0]!.label;
// @ts-expect-error
await shade(heights, { ...size, sunn: [315, 25] });
// @ts-expect-error
await shade(heights, { ...size, layers: ["illuminations"] });
// @ts-expect-error
await shade(heights, { width: "4", height: 3 });
`;

test("the types are those of what people write", () => {
  const folder = mkdtempSync(join(tmpdir(), "reliefshading-"));
  try {
    const installed = join(folder, "node_modules", "reliefshading");
    mkdirSync(installed, { recursive: true });
    cpSync(packageFolder, installed, { recursive: true });
    writeFileSync(join(folder, "package.json"), '{ "type": "module" }');
    writeFileSync(join(folder, "user.ts"), user);
    const compiler = join(process.env.RELIEF_TOOLS, "node_modules", "typescript", "bin", "tsc");
    for (const module of ["nodenext", "es2022"]) {
      const how = `--noEmit --strict --target es2022 --lib es2022,dom --module ${module}`;
      const resolution = module === "es2022" ? "bundler" : module;
      const words = [compiler, ...how.split(" "), "--moduleResolution", resolution, "user.ts"];
      const { status, stdout } = spawnSync(process.execPath, words, { cwd: folder, encoding: "utf8" });
      assert.equal(status, 0, stdout);
    }
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});
