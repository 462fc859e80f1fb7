// SPDX-License-Identifier: BSD-3-Clause
//
// The package in a page of a browser: by itself, and in a worker, which leaves the page free.

import assert from "node:assert/strict";
import { execFile } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { createServer } from "node:http";
import { tmpdir } from "node:os";
import { extname, join, normalize } from "node:path";
import { test } from "node:test";
import { promisify } from "node:util";

import { makeTerrain, packageFolder, shade } from "./Shared.mjs";

const page = `<!doctype html><title>running</title><pre id="result"></pre>
<script type="module">
const lines = [];
const sum = (data) => data.reduce((a, b) => a + b, 0);
try {
  const { createWorkerShader, shade } = await import("/package/index.js");
  const { width, height, heights } = await (await fetch("/terrain")).json();
  const options = { width, height, sun: [315, 20], layers: ["illumination"] };
  const here = await shade(Float32Array.from(heights), options);
  lines.push("here " + sum(here.data));
  const image = new ImageData(here.data, width, height);
  lines.push("image " + image.width + " " + image.height);

  const shader = createWorkerShader();
  let turns = 0; // of the page, while the worker shades
  const timer = setInterval(() => ++turns, 5);
  const large = await shader.shade(new Float32Array(600 * 600).map(() => Math.random()), {
    width: 600, height: 600, suns: Array.from({ length: 12 }, (_, k) => [30 * k, 8]),
  });
  clearInterval(timer);
  lines.push("free " + (turns > 3) + " " + large.data.length);
  const given = Float32Array.from(heights);
  const there = await shader.shade(given, options, { transfer: true });
  lines.push("worker " + sum(there.data) + " " + there.layers.illumination.length + " given " + given.length);
  const several = createWorkerShader({ workers: 3 });
  const banded = await several.shade(Float32Array.from(heights), { ...options, exposure: "auto" });
  const whole = await shade(Float32Array.from(heights), { ...options, exposure: "auto" });
  const same = (a, b) => a.length === b.length && a.every((value, k) => value === b[k]);
  lines.push("bands " + same(banded.data, whole.data) + " " + same(banded.layers.illumination, whole.layers.illumination) +
    " " + banded.height);
  const thin = await several.shade(new Float32Array(5), { width: 5, height: 1 });
  lines.push("thin " + thin.data.length);
  several.terminate();
  const before = await (await fetch("/asked")).text();
  const { heightsOfMesh } = await import("/package/index.js");
  const mesh = { points: [0, 0, 0, 3, 0, 1, 0, 3, 2] };
  const [seen, seenThere] = [await heightsOfMesh(mesh, { resolution: 30 }), await shader.heightsOfMesh(mesh, { resolution: 30 })];
  const level = await shader.heightsOfNormals({ data: new Uint8Array(48).fill(255), width: 4, height: 4 }, { green: "up" });
  const none = await shader.heightsOfMesh("none").catch((e) => e);
  lines.push("mesh " + seen.heights.every((h, k) => Object.is(h, seenThere.heights[k])) + " " + level.heights.length + " " +
    (none instanceof RangeError));
  lines.push("asked " + before + ", then " + (await (await fetch("/asked")).text()));
  const error = await shader.shade(new Float32Array(4), { width: 2, height: 2, depth: -1 }).catch((e) => e);
  lines.push("error " + (error instanceof RangeError) + " " + error.message);
  shader.terminate();
  lines.push("ended " + (await shader.shade(given, options).catch((e) => e.message)));
} catch (error) {
  lines.push("failed " + error);
}
document.getElementById("result").textContent = lines.join("\\n");
await fetch("/done", { method: "POST", body: lines.join("\\n") });
</script>`;

const types = { ".js": "text/javascript", ".wasm": "application/wasm" };

test("a page shades, and its worker does", { timeout: 120000 }, async () => {
  const [width, height] = [64, 48];
  const heights = makeTerrain(width, height);
  const asked = []; // of WebAssembly
  let report;
  const done = new Promise((resolve) => (report = resolve));
  const server = createServer((request, response) => {
    const send = (type, body) => response.writeHead(200, { "content-type": type }).end(body);
    if (request.url === "/") {
      send("text/html", page);
    } else if (request.url === "/terrain") {
      send("application/json", JSON.stringify({ width, height, heights: Array.from(heights) }));
    } else if (request.url === "/done") {
      let text = "";
      request.on("data", (part) => (text += part));
      request.on("end", () => {
        send("text/plain", "");
        report(text);
      });
    } else if (request.url === "/asked") {
      send("text/plain", asked.join(" "));
    } else if (request.url.startsWith("/package/")) {
      const name = normalize(request.url.slice("/package/".length));
      if (name.endsWith(".wasm")) {
        asked.push(name);
      }
      send(types[extname(name)] ?? "text/plain", readFileSync(join(packageFolder, name)));
    } else {
      response.writeHead(404).end();
    }
  });
  await new Promise((resolve) => server.listen(0, "127.0.0.1", resolve));
  const profile = mkdtempSync(join(tmpdir(), "reliefshading-"));
  const browser = promisify(execFile)(process.env.RELIEF_CHROMIUM, [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--no-first-run",
    `--user-data-dir=${profile}`,
    "--remote-debugging-port=0",
    `http://127.0.0.1:${server.address().port}/`,
  ]);
  const ended = browser.catch((error) => error);
  try {
    const lines = (await Promise.race([done, ended.then((error) => `the browser ended: ${error}`)])).split(
      "\n",
    );
    const { data } = await shade(heights, { width, height, sun: [315, 20] });
    const sum = data.reduce((a, b) => a + b, 0);
    assert.deepEqual(lines, [
      `here ${sum}`,
      `image ${width} ${height}`,
      `free true ${4 * 600 * 600}`,
      `worker ${sum} ${width * height} given 0`,
      `bands true true ${height}`,
      "thin 20",
      "mesh true 16 true",
      // Once for the page and all workers, and what few need when it is needed.
      "asked reliefshading.wasm, then reliefshading.wasm reliefheights.wasm reliefheights.wasm",
      "error true subsurfaceDepth: -1 was given, a finite number of at least 0 is expected",
      "ended the worker was terminated",
    ]);
  } finally {
    browser.child.kill();
    await ended;
    server.close();
    server.closeAllConnections();
    rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
  }
});
