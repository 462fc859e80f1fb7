// SPDX-License-Identifier: BSD-3-Clause
//
// Puts the page together in one folder:
//
//     node assemble.mjs SOURCE PACKAGE WEBGL NODE_MODULES TERRAIN FIGURE OUTPUT

import { createHash } from "node:crypto";
import {
  copyFileSync,
  mkdirSync,
  readdirSync,
  readFileSync,
  rmSync,
  statSync,
  writeFileSync,
} from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

import { metresOfDegree } from "./geodesy.js";
import { medallionHeights } from "./medallion.mjs";

const [source, packageFolder, webgl, modules, terrainFile, figureFile, output] = process.argv
  .slice(2)
  .map((path) => resolve(path));

const { build } = await import(pathToFileURL(join(modules, "esbuild", "lib", "main.js")));

//--------------------------------------------------------------------------------------------------
// The page's scripts, each with all that it needs in one file: requests for some fifty modules would take longer
// than what they do. What few need is a script of its own.
const scripts = [
  join(source, "main.js"),
  join(packageFolder, "worker.js"),
  ...["files.worker.js", "tiff.js", "hdr.js"].map((name) => join(source, name)),
];

async function bundle(entryPoints, how = {}) {
  const { metafile } = await build({
    entryPoints,
    outdir: output,
    entryNames: "[name]",
    bundle: true,
    external: ["./tiff.js", "./hdr.js"],
    format: "esm",
    minify: true,
    legalComments: "none", // see writeLicenses()
    target: ["chrome91", "firefox114", "safari16.4"], // which have workers of modules
    alias: { reliefshading: packageFolder, "reliefshading-webgl": join(webgl, "relief-gl.js") },
    nodePaths: [modules],
    metafile: true,
    logLevel: "warning",
    ...how,
  });
  return Object.keys(metafile.inputs);
}

// Of the libraries that are in the scripts, with the notices in their files.
function writeLicenses(sources) {
  const comment = /\/\*[^]*?\*\/|(?:^[ \t]*\/\/.*\n\s*)+/gm;
  const notices = new Map(); // by library
  for (const file of sources) {
    const name = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(file)?.[1];
    if (name) {
      const found = readFileSync(file, "utf8").match(comment) ?? [];
      const told = found.filter((text) => /copyright/i.test(text)).map((text) => text.trim());
      notices.set(name, new Set([...(notices.get(name) ?? []), ...told]));
    }
  }
  const texts = [...notices].sort().map(([name, told]) => {
    const folder = join(modules, name);
    const { version, license } = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
    const files = readdirSync(folder).filter((one) => /^licen[sc]e(\.\w+)?$/i.test(one));
    const whole = files.map((one) => readFileSync(join(folder, one), "utf8").trim());
    return [`${name} ${version}: ${license}`, ...whole, ...told].join("\n\n");
  });
  const own = readFileSync(join(packageFolder, "LICENSE"), "utf8").trim();
  mkdirSync(join(output, "libraries"));
  writeFileSync(
    join(output, "libraries", "LICENSES.txt"),
    [own, ...texts, ""].join(`\n\n${"-".repeat(80)}\n\n`),
  );
}

//--------------------------------------------------------------------------------------------------
// The examples, as 16-bit PNG.

// The figure's heights, white is 65535, and its spacing and scale in centimetres; it is 20 cm wide.
function readFigure() {
  const bytes = readFileSync(figureFile);
  const head = /^P5\n# (\S+) (\S+)\n(\d+) (\d+)\n65535\n/.exec(bytes.toString("latin1", 0, 200));
  const [spacing, top, width, height] = head.slice(1).map(Number);
  const at = head[0].length;
  const data = Uint16Array.from({ length: width * height }, (_, k) => bytes.readUInt16BE(at + 2 * k));
  const centimetres = (value) => Number((10 * value).toPrecision(6));
  return { data, width, height, spacing: centimetres(spacing), scale: centimetres(top / 65535) };
}

async function writeExamples() {
  const { encode } = await import(pathToFileURL(join(modules, "fast-png", "lib", "index.js")));
  // As modules: what is for CommonJS wants a Node.js that mixes both.
  const { fromArrayBuffer } = await import(
    pathToFileURL(join(modules, "geotiff", "dist-module", "geotiff.js"))
  );
  const folder = join(output, "examples");
  mkdirSync(folder, { recursive: true });
  const write = (name, data, width, height) =>
    writeFileSync(join(folder, name), encode({ data, width, height, channels: 1, depth: 16 }));

  const bytes = readFileSync(terrainFile);
  const tiff = await fromArrayBuffer(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length));
  const image = await tiff.getImage();
  const [width, height] = [image.getWidth(), image.getHeight()];
  const [metres] = await image.readRasters();
  const [dx, dy] = image.getResolution().map(Math.abs);
  const [mx, my] = metresOfDegree(image.getOrigin()[1] - (dy * height) / 2);
  write("terrain.png", Uint16Array.from(metres), width, height);
  const spacing = [dx * mx, dy * my].map((length) => Number(length.toPrecision(6)));

  const size = 720;
  const { heights, step } = medallionHeights(size);
  const most = heights.reduce((a, b) => Math.max(a, b));
  write(
    "medallion.png",
    Uint16Array.from(heights, (h) => Math.round((65535 * h) / most)),
    size,
    size,
  );
  // In millimetres, of a medal 60 mm across.
  const millimetres = 30;
  const sample = step * millimetres;
  const corner = (sample * (1 - size)) / 2;
  const medal = { lengths: false, spacing: [sample, sample], origin: [corner, corner] };

  const figure = readFigure();
  write("owl.png", figure.data, figure.width, figure.height);

  const examples = [
    {
      name: "medallion",
      label: "Medallion",
      file: "medallion.png",
      field: medal,
      scene: {
        heightScale: Number(((most * millimetres) / 65535).toPrecision(6)),
        subsurfaceDepth: 0.15,
        baseColor: [0.01, 0.01, 0.012],
        diffuseColor: [0.42, 0.23, 0.1],
        specularColor: [1, 0.75, 0.4],
        specularCoefficient: 0.45,
        specularPower: 8,
        lights: [{ kind: "point", position: [-21, 21, 26], color: [1, 0.9, 0.75], intensity: 1.4 }],
      },
    },
    {
      name: "terrain",
      label: "Terrain",
      file: "terrain.png",
      field: { lengths: true, spacing, origin: [0, 0] },
      scene: {
        heightScale: 2,
        subsurfaceDepth: 120,
        diffuseColor: [0.9, 0.86, 0.78],
        lights: [
          { kind: "sun", azimuth: 315, altitude: 25, color: [1, 0.85, 0.65] },
          { kind: "sun", azimuth: 120, altitude: 50, color: [0.2, 0.5, 0.7], intensity: 0.6 },
        ],
      },
    },
    {
      name: "owl",
      label: "Owl",
      file: "owl.png",
      field: { lengths: false, spacing: [figure.spacing, figure.spacing], origin: [0, 0] },
      scene: {
        heightScale: figure.scale,
        subsurfaceDepth: 0.3,
        baseColor: [0.02, 0.012, 0.01],
        diffuseColor: [0.7, 0.56, 0.38],
        lights: [{ kind: "sun", azimuth: 300, altitude: 32, color: [1, 0.93, 0.8], intensity: 0.85 }],
        environment: { image: "whiteDome", intensity: 0.15, numberOfSamples: 32 },
      },
    },
    {
      name: "alabaster",
      label: "Alabaster",
      file: "medallion.png",
      field: medal,
      scene: {
        heightScale: Number(((most * millimetres) / 65535).toPrecision(6)),
        subsurfaceDepth: 1,
        diffuseColor: [0.95, 0.8, 0.62],
        forwardScatterCoefficient: 0.6,
        useFloor: true,
        floorHeight: -2,
        lights: [{ kind: "point", position: [8, 10, -30], color: [1, 0.86, 0.65], intensity: 1.4 }],
        environment: { image: "whiteDome", intensity: 0.12, numberOfSamples: 32 },
      },
    },
  ];
  writeFileSync(join(folder, "examples.json"), `${JSON.stringify(examples, null, 1)}\n`);
}

//--------------------------------------------------------------------------------------------------
// What is kept for when there is no network: all but what is read or wanted by few. A build is known by what is in
// its files.
async function writeOffline() {
  const hash = createHash("sha256");
  const names = readdirSync(output, { recursive: true })
    .filter((name) => statSync(join(output, name)).isFile())
    .map((name) => name.replaceAll("\\", "/"))
    .sort();
  names.forEach((name) => hash.update(name).update(readFileSync(join(output, name))));
  const files = names.filter((name) => !/^(hdr\.js|reliefheights\.wasm|libraries\/.*)$/.test(name));
  const define = { FILES: JSON.stringify(files), BUILD: JSON.stringify(hash.digest("hex").slice(0, 16)) };
  await bundle([join(source, "offline.js")], { define });
}

//--------------------------------------------------------------------------------------------------
rmSync(output, { recursive: true, force: true });
mkdirSync(output, { recursive: true });
writeLicenses(await bundle(scripts));
for (const [folder, name] of [
  [source, "index.html"],
  [source, "style.css"],
  [packageFolder, "reliefshading.wasm"],
  [packageFolder, "reliefheights.wasm"],
]) {
  copyFileSync(join(folder, name), join(output, name));
}
await writeExamples();
await writeOffline();
// Last: what the build looks at to see whether all is there.
writeFileSync(join(output, "assembled"), "");
