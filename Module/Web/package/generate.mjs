// SPDX-License-Identifier: BSD-3-Clause
//
// Makes what the package and its WebAssembly have of the table of parameters:
//
//     node generate.mjs header TABLE FILE          WebParameters.h, their numbers in C++
//     node generate.mjs package TABLE FOLDER VERSION README LICENSE
//                                                  parameters, types and package.json

import { copyFileSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";

const sources = dirname(fileURLToPath(import.meta.url));

const capital = (word) => word[0].toUpperCase() + word.slice(1);

const enumerators = (table) =>
  table.filter((row) => row.owner !== "light").map((row) => capital(row.owner) + row.name);

function makeHeader(table) {
  return `// SPDX-License-Identifier: BSD-3-Clause
#ifndef WebParameters_h
#define WebParameters_h

// Made by generate.mjs from the table of parameters.

namespace relief::web::key
{

/// The parameters of scene, material and environment, in the order of the table.
enum Parameter
{
${enumerators(table)
  .map((name) => `  ${name},\n`)
  .join("")}  NumberOfParameters
};

}

#endif
`;
}

//--------------------------------------------------------------------------------------------------
// The type of a parameter's value.
function typeOf(row) {
  switch (row.kind) {
    case "flag":
      return "boolean";
    case "color":
      return "Color";
    case "range":
      return "readonly [number, number]";
    case "length":
      return 'number | "infinite"';
    case "choice":
      return row.choices.map((choice) => `"${choice.word}"`).join(" | ");
    default:
      return "number";
  }
}

function rangeOf(row) {
  const { minimum, maximum } = row;
  if (row.kind === "flag" || row.kind === "choice") {
    return "";
  }
  if (row.kind === "range") {
    return "the first not the larger";
  }
  if (minimum !== null && maximum !== null) {
    return `${row.kind === "count" ? "a whole number, " : ""}${minimum} to ${maximum}`;
  }
  return minimum === null ? "" : row.minimumOpen ? `above ${minimum}` : `at least ${minimum}`;
}

function defaultOf(row) {
  switch (row.kind) {
    case "flag":
      return String(row.default[0] !== 0);
    case "choice":
      return `"${row.choices[row.default[0]].word}"`;
    case "color":
    case "range":
      return `[${row.default.join(", ")}]`;
    case "length":
      return row.default[0] === null ? '"infinite"' : String(row.default[0]);
    default:
      return String(row.default[0]);
  }
}

// A member of an interface with its documentation.
function member(row, table) {
  const automatic = table.some((other) => other.owner === row.owner && other.name === `Automatic${row.name}`);
  const auto = automatic || row.key === "heightScale" ? ' | "auto"' : "";
  const facts = [
    row.unit === "" ? "" : `Unit: ${row.unit}.`,
    rangeOf(row) === "" ? "" : `Range: ${rangeOf(row)}.`,
    `Default: ${defaultOf(row)}.`,
  ];
  return `  /** ${row.help}. ${facts.filter((fact) => fact !== "").join(" ")} */
  ${row.key}?: ${typeOf(row)}${auto};\n`;
}

function makeTypes(table) {
  const members = (...owners) =>
    table
      .filter((row) => owners.includes(row.owner))
      .map((row) => member(row, table))
      .join("");
  return readFileSync(join(sources, "index.d.ts.in"), "utf8")
    .replace("  // @SCENE@\n", members("scene", "material"))
    .replace("  // @ENVIRONMENT@\n", members("environment"))
    .replace("  // @LIGHT@\n", members("light"));
}

//--------------------------------------------------------------------------------------------------
function makePackage(table, folder, version, readme, license) {
  mkdirSync(folder, { recursive: true });
  const write = (name, text) => writeFileSync(join(folder, name), text);
  const rows = JSON.stringify(table, null, 2);
  write("parameters.json", rows + "\n");
  write(
    "parameters.js",
    `// Made from the table of parameters.\nexport const version = ${JSON.stringify(version)};\n` +
      `/** Of a sun of which nothing is said, and of a clear sky. */\nexport const usual = ${JSON.stringify(usual)};\n` +
      `export const parameters = ${rows};\n`,
  );
  write("index.d.ts", makeTypes(table));
  const scripts = [
    "heights.js",
    "index.js",
    "load.js",
    "module.js",
    "options.js",
    "plan.js",
    "scene.js",
    "shader.js",
    "values.js",
    "worker.js",
  ];
  for (const name of scripts) {
    copyFileSync(join(sources, name), join(folder, name));
  }
  copyFileSync(readme, join(folder, "README.md"));
  copyFileSync(license, join(folder, "LICENSE"));
  const files = [...scripts, "index.d.ts", "parameters.js", "parameters.json"];
  const description = {
    name: "reliefshading",
    version,
    description: "Integrated shading of height fields: shade, soft shadows and translucency, exactly",
    license: "BSD-3-Clause",
    type: "module",
    exports: {
      ".": { types: "./index.d.ts", default: "./index.js" },
      "./parameters.json": "./parameters.json",
      "./reliefheights.wasm": "./reliefheights.wasm",
      "./reliefshading.wasm": "./reliefshading.wasm",
      "./package.json": "./package.json",
    },
    types: "./index.d.ts",
    files: [...files, "reliefheights.wasm", "reliefshading.wasm"],
    sideEffects: false,
    engines: { node: ">=18" },
    keywords: ["relief", "hillshade", "terrain", "dem", "shading", "normal-map", "heightmap", "webassembly"],
  };
  write("package.json", JSON.stringify(description, null, 2) + "\n");
}

const [what, tableFile, to, ...rest] = process.argv.slice(2);
const { parameters: table, usual } = JSON.parse(readFileSync(tableFile, "utf8"));
if (what === "header") {
  mkdirSync(dirname(to), { recursive: true });
  writeFileSync(to, makeHeader(table));
} else {
  makePackage(table, to, ...rest);
}
