// SPDX-License-Identifier: BSD-3-Clause
//
// Puts the page together in one folder:
//
//     node assemble.mjs SOURCE PACKAGE WEBGL NODE_MODULES TERRAIN FIGURE OUTPUT

import { createHash } from "node:crypto";
import {
  copyFileSync,
  cpSync,
  existsSync,
  mkdirSync,
  readdirSync,
  readFileSync,
  rmSync,
  writeFileSync,
} from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

import { metresOfDegree } from "./geodesy.js";
import { medallionHeights } from "./medallion.mjs";

const [source, packageFolder, webgl, modules, terrainFile, figureFile, output] = process.argv.slice(2);

const pageFiles = [
  "index.html",
  "style.css",
  "main.js",
  "offline.js",
  "history.js",
  "scene.js",
  "source-section.js",
  "sources.js",
  "geodesy.js",
  "hdr.js",
  "files.js",
  "files.worker.js",
  "picture.js",
  "view.js",
  "gestures.js",
  "lights.js",
  "controls.js",
  "panel.js",
];

//--------------------------------------------------------------------------------------------------
// Libraries as they are, but for the names by which their modules find each other: browsers know no others than
// paths, in workers.
const libraries = { "fast-png": "lib", iobuffer: "lib", fflate: "esm" };
const entries = { iobuffer: "iobuffer/iobuffer.js", fflate: "fflate/browser.js" };

const copied = []; // their files

function copyLibrary(name, folder, depth = "../") {
  const from = join(modules, name, folder);
  const to = join(output, "libraries", name);
  const copy = (below) => {
    mkdirSync(join(to, below), { recursive: true });
    for (const entry of readdirSync(join(from, below), { withFileTypes: true })) {
      const path = join(below, entry.name);
      if (entry.isDirectory()) {
        copy(path);
      } else if (path.endsWith(".js")) {
        const up = depth + "../".repeat(path.split(/[\\/]/).length - 1);
        const text = readFileSync(join(from, path), "utf8")
          .replace(
            /(\bfrom\s*)(['"])(iobuffer|fflate)\2/g,
            (_, word, quote, library) => `${word}${quote}${up}${entries[library]}${quote}`,
          )
          .replace(/^\/\/# sourceMappingURL=.*$/m, "");
        writeFileSync(join(to, path), text);
        copied.push(`${name}/${path.replaceAll("\\", "/")}`);
      }
    }
  };
  copy("");
}

// Two loaders of three.js, and what they need of it.
function copyLoaders() {
  const folder = join(output, "libraries", "three");
  mkdirSync(folder, { recursive: true });
  copyFileSync(join(modules, "three", "build", "three.core.js"), join(folder, "three.core.js"));
  for (const name of ["EXRLoader.js", "HDRLoader.js"]) {
    const text = readFileSync(join(modules, "three", "examples", "jsm", "loaders", name), "utf8")
      .replace(/(\bfrom\s*)'three'/, "$1'./three.core.js'")
      .replace(/(\bfrom\s*)'\.\.\/libs\/fflate\.module\.js'/, `$1'../${entries.fflate}'`);
    writeFileSync(join(folder, name), text);
  }
}

function copyLibraries() {
  Object.entries(libraries).forEach(([name, folder]) => copyLibrary(name, folder));
  mkdirSync(join(output, "libraries", "geotiff"), { recursive: true });
  const text = readFileSync(join(modules, "geotiff", "dist-browser", "geotiff.js"), "utf8");
  writeFileSync(
    join(output, "libraries", "geotiff", "geotiff.js"),
    text.replace(/^\/\/# sourceMappingURL=.*$/m, ""),
  );
  copyLoaders();
  // geotiff.js has its own dependencies in it.
  const parts = readdirSync(modules).flatMap((name) =>
    name.startsWith(".")
      ? []
      : name.startsWith("@")
        ? readdirSync(join(modules, name)).map((inner) => `${name}/${inner}`)
        : [name],
  );
  const names = ["LICENSE", "LICENCE", "LICENSE.md", "LICENSE.txt"];
  const texts = parts.map((name) => {
    const { version, license } = JSON.parse(readFileSync(join(modules, name, "package.json"), "utf8"));
    const file = names.map((one) => join(modules, name, one)).find(existsSync);
    return `${name} ${version}: ${license}\n\n${file ? readFileSync(file, "utf8").trim() : ""}\n`;
  });
  writeFileSync(join(output, "libraries", "LICENSES.txt"), texts.join(`\n${"-".repeat(80)}\n\n`));
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
// All modules of the page itself, the WebAssembly and the list of examples are asked for at once.
function preload() {
  const file = join(output, "index.html");
  const scripts = (folder) =>
    readdirSync(join(output, folder))
      .filter((name) => name.endsWith(".js") && !/worker\.js$|^hdr\.js$|^offline\.js$/.test(name))
      .map((name) => (folder ? `${folder}/${name}` : name));
  const modules = ["", "reliefshading", "webgl"]
    .flatMap(scripts)
    .map((name) => `    <link rel="modulepreload" href="${name}" />\n`);
  const data = ["examples/examples.json", "reliefshading/reliefshading.wasm"]
    .map((name) => `    <link rel="preload" as="fetch" crossorigin href="${name}" />\n`)
    .join("");
  const text = readFileSync(file, "utf8");
  const filled = text.replace(/ {4}<!-- What the first picture needs.*-->\n/, [...modules, data].join(""));
  if (filled === text) {
    throw new Error("index.html has no place for what is asked for first");
  }
  writeFileSync(file, filled);
}

// Nor does the worker that reads files go down the libraries step by step.
function importLibraries() {
  const file = join(output, "files.worker.js");
  const scripts = copied.map((path) => `import "./libraries/${path}";\n`);
  const text = readFileSync(file, "utf8");
  const filled = text.replace(/^\/\/ The files of libraries.*\n/m, scripts.join(""));
  if (filled === text) {
    throw new Error("files.worker.js has no place for the files of libraries");
  }
  writeFileSync(file, filled);
}

// What is kept for when there is no network: all but what few need. A build is known by what is in its files.
function listForOffline() {
  const file = join(output, "offline.js");
  const names = [];
  const hash = createHash("sha256");
  const walk = (below) => {
    for (const entry of readdirSync(join(output, below), { withFileTypes: true })) {
      const name = below ? `${below}/${entry.name}` : entry.name;
      if (entry.isDirectory()) {
        walk(name);
      } else {
        hash.update(name).update(readFileSync(join(output, name)));
        names.push(name);
      }
    }
  };
  walk("");
  const seldom = /^libraries\/three\/|reliefheights\.wasm$|\.(ts|json|md|txt)$|LICENSE$|^offline\.js$/;
  const kept = names.filter((name) => !seldom.test(name) || name === "examples/examples.json");
  const text = readFileSync(file, "utf8")
    .replace('const build = ""; // filled in', `const build = "${hash.digest("hex").slice(0, 16)}";`)
    .replace("const files = []; // filled in", `const files = ${JSON.stringify(kept)};`);
  if (text.includes("filled in")) {
    throw new Error("offline.js has no place for the files that are kept");
  }
  writeFileSync(file, text);
}

//--------------------------------------------------------------------------------------------------
rmSync(output, { recursive: true, force: true });
mkdirSync(output, { recursive: true });
pageFiles.forEach((name) => copyFileSync(join(source, name), join(output, name)));
cpSync(packageFolder, join(output, "reliefshading"), { recursive: true });
mkdirSync(join(output, "webgl"));
readdirSync(webgl)
  .filter((name) => name.endsWith(".js"))
  .forEach((name) => copyFileSync(join(webgl, name), join(output, "webgl", name)));
copyLibraries();
await writeExamples();
preload();
importLibraries();
listForOffline();
// Last: what the build looks at to see whether all is there.
writeFileSync(join(output, "assembled"), "");
