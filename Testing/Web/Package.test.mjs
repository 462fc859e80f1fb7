// SPDX-License-Identifier: BSD-3-Clause
//
// The package as people get it: packed, installed without a network, imported by its name. Its size, and the
// examples of its documentation.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { gzipSync } from "node:zlib";

import { packageFolder, parameters, readText, version } from "./Shared.mjs";

let folder;

before(() => {
  folder = mkdtempSync(join(tmpdir(), "reliefshading-"));
  const npm = (where, ...words) =>
    execFileSync("npm", [...words, "--offline", "--no-audit", "--no-fund"], {
      cwd: where,
      encoding: "utf8",
      stdio: ["ignore", "pipe", "pipe"],
    });
  const packed = npm(folder, "pack", packageFolder).trim().split("\n").pop();
  writeFileSync(
    join(folder, "package.json"),
    JSON.stringify({ name: "user", private: true, type: "module" }),
  );
  npm(folder, "install", `./${packed}`);
});
after(() => rmSync(folder, { recursive: true, force: true }));

function run(name, script) {
  writeFileSync(join(folder, name), script);
  return execFileSync(process.execPath, [name], { cwd: folder, encoding: "utf8" });
}

test("it is installed from a tarball and imported by name", () => {
  const description = JSON.parse(readText(packageFolder, "package.json"));
  assert.equal(description.version, version);
  assert.equal(description.dependencies, undefined);
  const script = `
    import { shade, version } from "reliefshading";
    import { readFileSync } from "node:fs";
    import { createRequire } from "node:module";
    const { data } = await shade(new Float32Array(4), { width: 2, height: 2, sun: [0, 90] });
    const table = JSON.parse(readFileSync(createRequire(import.meta.url).resolve("reliefshading/parameters.json"), "utf8"));
    console.log(data.join(" "), version, table.length);`;
  const white = new Array(16).fill(255).join(" ");
  assert.equal(run("user.js", script).trim(), `${white} ${version} ${parameters.length}`);
});

test("each file that the package needs is in it", () => {
  const installed = join(folder, "node_modules", "reliefshading");
  for (const name of [
    "index.js",
    "index.d.ts",
    "worker.js",
    "parameters.json",
    "heights.js",
    "reliefheights.wasm",
    "reliefshading.wasm",
    "README.md",
    "LICENSE",
  ]) {
    assert.ok(readFileSync(join(installed, name)).length > 0, name);
  }
});

// Bundlers make one script of a worker, unless they are told otherwise.
test("what a worker needs is there from its beginning", () => {
  const scripts = JSON.parse(readText(packageFolder, "package.json")).files.filter((name) => /\.js$/.test(name));
  // What load.js asks for in Node.js is none of them.
  const late = scripts.filter((name) => /\bimport\("/.test(readText(packageFolder, name)));
  assert.deepEqual(late, []);
});

test("the WebAssembly takes at most 150 kB compressed", (t) => {
  const bytes = gzipSync(readFileSync(join(packageFolder, "reliefshading.wasm")), { level: 9 }).length;
  t.diagnostic(`reliefshading.wasm: ${bytes} bytes compressed`);
  assert.ok(bytes <= 150e3, `${bytes} bytes`);
});

test("where memory runs out there is one error, and the next run is well", () => {
  // A copy whose memory may have 48 MiB: in section 5 the greatest number of pages, which is 65536, has 3 bytes.
  const small = join(folder, "small");
  cpSync(packageFolder, small, { recursive: true });
  const wasm = readFileSync(join(small, "reliefshading.wasm"));
  const at = wasm.indexOf(Buffer.from([0x80, 0x80, 0x04]));
  assert.ok(at > 0 && at < 3000, `the limit of memory is not where it was expected: ${at}`);
  wasm.set([0x80, 0x86, 0x00], at);
  writeFileSync(join(small, "reliefshading.wasm"), wasm);
  const script = `
    import { shade } from "./small/index.js";
    for (const n of [10, 2500, 10, 4000, 10]) {
      console.log(await shade(new Float32Array(n * n), { width: n, height: n, sun: [0, 90] }).then((r) => r.data[0], String));
    }`;
  const full = "RangeError: there is not enough memory for the run";
  assert.deepEqual(run("memory.js", script).trim().split("\n"), ["255", full, "255", full, "255"]);
});

test("the types document every parameter", () => {
  const types = readText(packageFolder, "index.d.ts");
  assert.ok(!types.includes("@"), "a place was left open");
  for (const { key, help, unit } of parameters) {
    assert.match(types, new RegExp(`^  ${key}\\?: `, "m"));
    assert.ok(types.includes(help), key);
    assert.ok(unit === "" || types.includes(`Unit: ${unit}.`), key);
  }
});

// Every line "console.log(…); // prints …" says what the example prints.
for (const [title, file] of [
  ["README.md", join(packageFolder, "README.md")],
  ["Browser.md", process.env.RELIEF_DOCUMENTATION],
]) {
  test(`the examples of ${title} do what they say`, () => {
    const examples = [...readFileSync(file, "utf8").matchAll(/^```js\n([\s\S]*?)^```$/gm)].map(
      (match) => match[1],
    );
    assert.ok(examples.length > 0);
    mkdirSync(join(folder, "examples"), { recursive: true });
    examples.forEach((example, k) => {
      const expected = [...example.matchAll(/console\.log\(.*\); \/\/ prints (.*)$/gm)].map(
        (match) => match[1],
      );
      assert.ok(expected.length > 0, `example ${k} prints nothing`);
      assert.deepEqual(
        run(join("examples", `${title}-${k}.js`), example)
          .trim()
          .split("\n"),
        expected,
      );
    });
  });
}
