// SPDX-License-Identifier: BSD-3-Clause
//
// Heights of meshes and of normals: what they are of shapes that are known, the same as the native filters find,
// and what is refused.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";

import { heightsOfMesh, heightsOfNormals, makeRandom, shade } from "./Shared.mjs";

//--------------------------------------------------------------------------------------------------
// Meshes.

// A ring with bumps, of quads, moved; and a plate of polygons, one of them concave, before it.
function ringObj(shift = [0, 0, 0]) {
  const [around, across] = [60, 24];
  const lines = ["# a ring and a plate", "o ring"];
  for (let i = 0; i < around; ++i) {
    for (let j = 0; j < across; ++j) {
      const [a, b] = [(2 * Math.PI * i) / around, (2 * Math.PI * j) / across];
      const r = 1 + 0.2 * Math.sin(5 * a) * Math.cos(2 * b);
      const point = [(3 + r * Math.cos(b)) * Math.cos(a), (3 + r * Math.cos(b)) * Math.sin(a), r * Math.sin(b)];
      lines.push(`v ${point.map((c, k) => (c + shift[k]).toPrecision(9)).join(" ")}`);
    }
  }
  lines.push("vn 0 0 1");
  for (let i = 0; i < around; ++i) {
    for (let j = 0; j < across; ++j) {
      const at = (k, l) => ((k % around) * across + (l % across)) + 1;
      lines.push(`f ${at(i, j)}//1 ${at(i + 1, j)}//1 ${at(i + 1, j + 1)}//1 ${at(i, j + 1)}//1`);
    }
  }
  const plate = [[-1, -1], [1, -1.2], [0.2, 0], [1.1, 1], [0, 0.4], [-1, 1]];
  plate.forEach(([x, y]) => lines.push(`v ${x + shift[0]} ${y + shift[1]} ${0.3 * x - 0.1 * y + 0.5 + shift[2]} 0.5 0.5 0.5`));
  lines.push("f -6//1 -5//1 -4//1 \\", "  -3//1 -2//1 -1//1", "f -6//1 -4//1 -6//1");
  return `${lines.join("\n")}\n`;
}

test("a plane has the heights of the plane, rows from the north", async () => {
  const obj = "v 0 0 0\nv 4 0 0\nv 4 2 1\nv 0 2 1\nf 1 2 3 4\n";
  const { heights, width, height, spacing, origin, triangles, warnings } = await heightsOfMesh(obj, { resolution: 52 });
  assert.deepEqual([width, height, triangles, warnings], [52, 27, 2, []]);
  let inside = 0;
  for (let k = 0; k < heights.length; ++k) {
    const x = origin[0] + (k % width) * spacing[0];
    const y = origin[1] + (height - 1 - Math.floor(k / width)) * spacing[1];
    const there = x >= 0 && x <= 4 && y >= 0 && y <= 2;
    assert.equal(Number.isNaN(heights[k]), !there, `${x}, ${y}`);
    assert.ok(!there || Math.abs(heights[k] - y / 2) < 1e-12);
    inside += there ? 1 : 0;
  }
  assert.ok(inside > 1000);
  // From below left is right, and heights are depths toward the other side.
  const below = await heightsOfMesh(obj, { resolution: 52, viewDirection: [0, 0, -3] });
  assert.ok(below.heights.every((h, k) => {
    const mirrored = heights[width * Math.floor(k / width) + (width - 1 - (k % width))];
    return Number.isNaN(h) ? Number.isNaN(mirrored) : Math.abs(h + mirrored) < 1e-12;
  }));
  // What was found is what is shaded.
  const { data } = await shade(heights, { width, height, spacing, sun: [0, 60], output: "float" });
  assert.ok(data[4 * (10 * width + 20) + 3] === 1);
});

test("texts, bytes, points and triangles are the same mesh", async () => {
  const text = "v 0 0 0\nv 3 0 1\nv 0 3 2\nf 1 2 3\n";
  const points = [0, 0, 0, 3, 0, 1, 0, 3, 2];
  const meshes = [
    new TextEncoder().encode(text), new TextEncoder().encode(text).buffer, { points },
    { points: Float32Array.from(points), triangles: [0, 1, 2] },
    { points: Float64Array.from(points), triangles: Uint16Array.of(0, 1, 2) },
  ];
  const expected = await heightsOfMesh(text, { resolution: 30 });
  for (const mesh of meshes) {
    assert.deepEqual(await heightsOfMesh(mesh, { resolution: 30 }), expected);
  }
});

test("what is left out of a mesh is told", async () => {
  const points = [0, 0, 0, 1, 0, 0, 0, 1, 0, NaN, 0, 0];
  const { warnings, triangles } = await heightsOfMesh({ points, triangles: [0, 1, 2, 0, 1, 3, 1, 1, 2] });
  assert.equal(triangles, 1);
  assert.deepEqual(warnings, [
    "Of the mesh are left out: 1 triangles without area, 1 triangles whose corners are no finite points.",
  ]);
});

//--------------------------------------------------------------------------------------------------
// Normals.

const [columns, rows] = [90, 70];
const hill = (x, y) => 9 * Math.exp(-(((x - 40) / 18) ** 2) - ((y - 30) / 14) ** 2) + 2 * Math.sin(x / 9 + y / 7);

// The normals of a surface of pixels of a size, y down in rows, as codes of 8 or 16 bits or as they are.
function normalsOf(surface, [sx, sy], Type, green = 1, channels = 3) {
  const data = new Type(channels * columns * rows);
  const largest = Type === Uint16Array ? 65535 : 255;
  const code = (c) => (Type === Float32Array || Type === Float64Array ? c : Math.round((largest * (c + 1)) / 2));
  for (let j = 0; j < rows; ++j) {
    for (let i = 0; i < columns; ++i) {
      const e = 1e-4;
      const dx = (surface(i + e, j) - surface(i - e, j)) / (2 * e * sx);
      const dy = -(surface(i, j + e) - surface(i, j - e)) / (2 * e * sy);
      const length = Math.hypot(dx, dy, 1);
      const normal = [-dx / length, (-green * dy) / length, 1 / length].map(code);
      data.set(channels === 4 ? [...normal, i < 20 && j < 30 ? 0 : largest] : normal, channels * (j * columns + i));
    }
  }
  return { data, width: columns, height: rows };
}

// Of heights whose mean is 0, the largest difference.
function apartFrom(surface, heights) {
  const values = Array.from(heights, (_, k) => surface(k % columns, Math.floor(k / columns)));
  const mean = values.reduce((sum, value) => sum + value, 0) / values.length;
  return values.reduce((worst, value, k) => Math.max(worst, Math.abs(value - mean - heights[k])), 0);
}

test("normals of a surface give the surface, whichever way green points", async () => {
  for (const green of [1, -1]) {
    for (const [Type, most] of [[Uint8Array, 0.1], [Uint16Array, 0.03], [Float32Array, 0.03], [Float64Array, 0.03]]) {
      const found = await heightsOfNormals(normalsOf(hill, [1, 1], Type, green));
      assert.equal(found.heights.constructor, Type === Float64Array ? Float64Array : Float32Array);
      assert.deepEqual([found.green, found.greenKnown, found.parts], [green > 0 ? "up" : "down", true, 1]);
      assert.equal(found.encoding, Type === Uint8Array || Type === Uint16Array ? "unsigned" : "signed");
      const apart = apartFrom(hill, found.heights);
      assert.ok(apart < most, `${Type.name}: ${apart}`);
    }
  }
});

test("spacing, masks and alpha count", async () => {
  const spacing = [2, 3];
  const normals = normalsOf(hill, spacing, Float64Array);
  const { heights } = await heightsOfNormals(normals, { spacing, green: "up", encoding: "signed" });
  const apart = apartFrom(hill, heights);
  assert.ok(apart < 0.03, `${apart}`);
  const mask = Array.from({ length: columns * rows }, (_, k) => k % columns !== 45);
  const halves = await heightsOfNormals(normals, { spacing, mask });
  assert.equal(halves.parts, 2);
  assert.ok(halves.heights.every((h, k) => Number.isNaN(h) === (k % columns === 45)));
  const cut = await heightsOfNormals(normalsOf(hill, [1, 1], Uint8Array, 1, 4));
  assert.ok(cut.heights.every((h, k) => Number.isNaN(h) === (k % columns < 20 && k < 30 * columns)));
});

test("a slope says nothing of green, and that is told", async () => {
  const { greenKnown, warnings } = await heightsOfNormals(normalsOf((x, y) => x / 3 + y / 5, [1, 1], Float32Array));
  assert.equal(greenKnown, false);
  assert.match(warnings[0], /green/);
});

//--------------------------------------------------------------------------------------------------
// Against the native filters.

const cliff = (x, y) => hill(x, y) + (x > 50 ? 8 : 0);
const disc = Uint8Array.from({ length: columns * rows }, (_, k) =>
  (k % columns - 44) ** 2 + (Math.floor(k / columns) - 33) ** 2 < 900 ? 1 : 0);
const noisy = normalsOf(hill, [1, 1], Uint8Array);
const random = makeRandom(5);
noisy.data = noisy.data.map((code) => Math.min(255, Math.max(0, code + Math.round(16 * (random() - 0.5)))));

const meshJobs = {
  ring: [ringObj(), { resolution: 300 }],
  aside: [ringObj(), { resolution: 211, viewDirection: [1, -2, 0.7] }],
  upright: [ringObj(), { resolution: 150, viewDirection: [0.2, 1, 0.1], viewUp: [1, 0, 1] }],
  above: [ringObj(), { resolution: 97, viewDirection: [0, 1, 0] }],
  far: [ringObj([48000, -73000, 12000]), { resolution: 128 }],
  usual: [ringObj(), {}],
};
const normalJobs = {
  bytes: [normalsOf(hill, [1, 1], Uint8Array), {}],
  shorts: [normalsOf(hill, [1, 1], Uint16Array, -1), {}],
  floats: [normalsOf(hill, [2, 3], Float32Array), { spacing: [2, 3], green: "up" }],
  doubles: [normalsOf(hill, [1, 1], Float64Array), { green: "down" }],
  disc: [normalsOf(hill, [1, 1], Uint8Array), {}, disc],
  alpha: [normalsOf(hill, [1, 1], Uint8Array, 1, 4), {}],
  noisy: [noisy, { green: "up" }],
  cliffs: [normalsOf(cliff, [1, 1], Uint8Array), { method: "cliffs", green: "up" }],
  paths: [normalsOf(hill, [1, 1], Uint8Array), { method: "path-sums" }],
};
const typeNames = { Uint8Array: "uint8", Uint16Array: "uint16", Float32Array: "float32", Float64Array: "float64" };

function writeJobs(folder) {
  const write = (file, data) => {
    writeFileSync(join(folder, file), data);
    return file;
  };
  const jobs = Object.entries(meshJobs).map(([name, [text, options]]) =>
    ({ name, options, mesh: write(`${name}.obj`, text) }));
  for (const [name, [{ data, width, height }, options, mask]] of Object.entries(normalJobs)) {
    const job = { name, options, width, height, type: typeNames[data.constructor.name], normals: write(`${name}.raw`, data) };
    jobs.push(mask ? { ...job, mask: write(`${name}.mask`, mask) } : job);
  }
  writeFileSync(join(folder, "jobs.json"), JSON.stringify(jobs));
  return jobs;
}

const native = process.env.RELIEF_NATIVE_HEIGHTS === "1";

test("heights are those of the native filters", { skip: !native && "the native filters are not there" }, async (t) => {
  const folder = mkdtempSync(join(tmpdir(), "reliefheights-"));
  try {
    const jobs = writeJobs(folder);
    const script = join(dirname(fileURLToPath(import.meta.url)), "NativeHeights.py");
    execFileSync(process.env.RELIEF_PYTHON, [script, join(folder, "jobs.json")], { stdio: "inherit" });
    const results = JSON.parse(readFileSync(join(folder, "results.json"), "utf8"));
    for (const [k, { name, options }] of jobs.entries()) {
      const [given, , mask] = meshJobs[name] ?? normalJobs[name];
      const found = await (meshJobs[name] ? heightsOfMesh(given, options) : heightsOfNormals(given, { ...options, mask }));
      const { width, height, type, origin, ...told } = results[k];
      assert.deepEqual([found.width, found.height], [width, height], name);
      assert.ok(meshJobs[name] === undefined || origin.every((c, axis) => c === found.origin[axis]), `${name}: ${origin}`);
      for (const [key, value] of Object.entries(told)) {
        assert.deepEqual(found[key], value, `${name}: ${key}`);
      }
      assert.equal(typeNames[found.heights.constructor.name], type, name);
      const bytes = readFileSync(join(folder, `${name}.heights`));
      const expected = new found.heights.constructor(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
      let [worst, differing, least, greatest] = [0, 0, Infinity, -Infinity];
      expected.forEach((h, at) => {
        assert.equal(Number.isNaN(found.heights[at]), Number.isNaN(h), `${name}, sample ${at}`);
        if (!Number.isNaN(h)) {
          worst = Math.max(worst, Math.abs(found.heights[at] - h));
          differing += found.heights[at] === h ? 0 : 1;
          [least, greatest] = [Math.min(least, h), Math.max(greatest, h)];
        }
      });
      t.diagnostic(`${name}: ${differing} of ${expected.length} differ, by ${worst} of ${greatest - least} at most`);
      // Meshes take sums and roots only, which are the same everywhere.
      assert.ok(worst <= (meshJobs[name] ? 0 : 2e-6 * (greatest - least)), `${name}: ${worst}`);
    }
  } finally {
    rmSync(folder, { recursive: true, force: true });
  }
});

//--------------------------------------------------------------------------------------------------
async function refuses(call, Type, message) {
  await assert.rejects(call, (error) => {
    assert.equal(error.constructor, Type, `${error}`);
    assert.ok(error.message.length <= 250 && !error.message.includes("\n"), error.message);
    assert.match(error.message, message);
    return true;
  });
}

test("mistakes about meshes have one message each", async () => {
  const points = [0, 0, 0, 1, 0, 0, 0, 1, 0];
  for (const [mesh, message] of [
    ["no mesh at all", /^mesh: it is no OBJ file: it has no line of a point, 'v x y z'$/],
    ["", /no OBJ file/],
    [Uint8Array.of(0x89, 0x50, 0x4e, 0x47, 0, 1, 2, 255), /no OBJ file/],
    ["v 0 0 0\nv 1 0 0\nv 0 1 0\n", /^mesh: it has no polygons: 3 points$/],
    ["v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nv 4 5", /^mesh: line 5: a point is 'v x y z', with 3 numbers, not 'v 4 5'$/],
    ["v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n", /^mesh: line 4: a face names number 4 of 3 points$/],
    ["v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2", /^mesh: line 4: a face has 2 corners/],
    [`v 0 0 0\nv 1 0 ${"9".repeat(5000)}`, /^mesh: line 2: a point is/],
    ["v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", /^mesh: there are no triangles to look at among 3 points, .* 1 without area$/],
    ["v 0 0 0\nv 1 0 0\nv 1 1e300 0\nf 1 2 3\n", /^mesh: line 3/],
    [{ points: [0, 0, 0, 1] }, /^mesh.points: 4 numbers were given, three for each point/],
    [{ points: [0, 0, 0, 1, 1, 1] }, /^mesh.points: 2 points were given without triangles/],
    [{ points, triangles: [0, 1] }, /^mesh.triangles: 2 numbers were given, three for each triangle/],
    [{ points, triangles: [0, 1, 3] }, /^mesh.triangles: 3 was given, a whole number from 0 to 2/],
    [{ points, triangles: [0, 1, -1] }, /^mesh.triangles: -1 was given/],
  ]) {
    await refuses(() => heightsOfMesh(mesh), RangeError, message);
  }
  await refuses(() => heightsOfMesh({ points }, { viewDirection: [0, 0, 0] }), RangeError, /^viewDirection: .*not 0/);
  await refuses(() => heightsOfMesh({ points }, { viewDirection: [1, 0, 0] }), RangeError, /^mesh: no sample hits a triangle: look from another direction/);
  await refuses(() => heightsOfMesh({ points }, { resolution: 0 }), RangeError, /^resolution: 0 was given/);
  await refuses(() => heightsOfMesh({ points }, { resolution: 65536 }), RangeError, /^mesh: 65536 x 65536 samples are asked for/);
  await refuses(() => heightsOfMesh({ points }, { resolution: 30000 }), RangeError, /^mesh: 30000 x 30000 samples .* at most 2\^28 are possible here/);
  await refuses(() => heightsOfMesh({ points }, { viewUp: [1, 0] }), TypeError, /^viewUp: .*an array of 3 numbers/);
  await refuses(() => heightsOfMesh({ points }, { view: [1, 0, 0] }), TypeError, /^view: there is no such option/);
  await refuses(() => heightsOfMesh(7), TypeError, /^mesh: 7 was given, the text of an OBJ/);
  await refuses(() => heightsOfMesh({ points, faces: [] }), TypeError, /^mesh.faces: there is no such option/);
  await refuses(() => heightsOfMesh({ points: "x" }), TypeError, /^mesh.points: "x" was given/);
  // And the next one is well.
  assert.equal((await heightsOfMesh({ points }, { resolution: 10 })).width, 10);
});

test("mistakes about normals have one message each", async () => {
  const level = { data: Uint8Array.of(128, 128, 255, 128, 128, 255), width: 2, height: 1 };
  await refuses(() => heightsOfNormals({ ...level, width: 3 }), RangeError, /^normals.data: .*3 \(x, y, z\) or 4 .*each of 3 x 1 samples are expected/);
  await refuses(() => heightsOfNormals({ ...level, data: new Uint8Array(2) }), RangeError, /^normals.data/);
  await refuses(() => heightsOfNormals({ ...level, data: [0, 0, 1, 0, 0, 1] }), TypeError, /^normals.data/);
  await refuses(() => heightsOfNormals({ ...level, height: 0 }), RangeError, /^normals.height: 0 was given/);
  await refuses(() => heightsOfNormals(level, { green: "left" }), TypeError, /^green: "left" was given, "auto", "up" or "down" is expected/);
  await refuses(() => heightsOfNormals(level, { method: "guess" }), TypeError, /^method: .*"least-squares", "cliffs" or "path-sums"/);
  await refuses(() => heightsOfNormals(level, { encoding: 8 }), TypeError, /^encoding: 8 was given/);
  await refuses(() => heightsOfNormals(level, { spacing: 0 }), RangeError, /^spacing: 0 was given/);
  await refuses(() => heightsOfNormals(level, { spacing: [1, 1e7] }), RangeError, /^spacing: .*ratio of at most 1e6/);
  await refuses(() => heightsOfNormals(level, { mask: [1] }), RangeError, /^mask: 1 values were given, 2 are expected/);
  await refuses(() => heightsOfNormals(level, { mask: [0, 0] }), RangeError, /^normals: it has no normal that faces the viewer/);
  await refuses(() => heightsOfNormals(null), TypeError, /^normals: null was given/);
  await refuses(() => heightsOfNormals(level, { sun: [1, 2] }), TypeError, /^sun: there is no such option/);
  assert.equal((await heightsOfNormals(level)).heights.length, 2);
});
