// SPDX-License-Identifier: BSD-3-Clause
//
// Scenes as the files that reliefshade --scene takes, which Documentation/SceneFile.md describes.

import { environmentRows, lightRows, materialRows, readScene, sceneKeys, sceneRows } from "./options.js";
import { needFinite, needVector, needWord, readParameter, shown, typeError } from "./values.js";

const fileVersion = 1;
const imageWords = ["none", "whiteDome", "clearSky", "file"];

//--------------------------------------------------------------------------------------------------
// Writing.

const numberText = (value) => (Object.is(value, -0) ? "-0.0" : String(value));
const vectorText = (values) => `[${values.map(numberText).join(", ")}]`;

function valueText(row, value) {
  switch (row.kind) {
    case "length":
      return value === Infinity ? '"infinite"' : numberText(value);
    case "flag":
      return String(value);
    case "choice":
      return `"${row.choices[value].name}"`;
    case "color":
    case "range":
      return vectorText(value);
    default:
      return numberText(value);
  }
}

const valuesOf = (rows, values) =>
  rows
    .filter((row) => values[row.key] !== undefined)
    .map((row) => [row.key, valueText(row, values[row.key])]);

// Lines of an object's members: texts, or lists of members or of objects.
function lines(members, indent) {
  return members.map(([key, text]) => `${indent}"${key}": ${text}`).join(",\n");
}

const block = (members, indent) => `{\n${lines(members, `${indent}  `)}\n${indent}}`;

function lightMembers(light) {
  const place =
    light.kind === "sun"
      ? [
          ["azimuth", numberText(light.azimuth)],
          ["altitude", numberText(light.altitude)],
        ]
      : [["position", vectorText(light.position)]];
  const toward = light.toward ? [["toward", vectorText(light.toward)]] : [];
  return [["kind", `"${light.kind}"`], ...place, ...toward, ...valuesOf(lightRows, light)];
}

function environmentMembers(environment) {
  const { image, file, azimuth, altitude, turbidity } = environment;
  if (image === "picture" && typeof file !== "string") {
    throw new TypeError(
      "environment: its image was given as pixels, which the file of a scene has not; name their file by environment.file",
    );
  }
  const word = image === "picture" ? "file" : image;
  const more =
    word === "file"
      ? [["file", JSON.stringify(file)]]
      : word === "clearSky"
        ? [
            ["azimuth", numberText(azimuth)],
            ["altitude", numberText(altitude)],
            ["turbidity", numberText(turbidity)],
          ]
        : [];
  return [["image", `"${word}"`], ...more, ...valuesOf(environmentRows, environment)];
}

/** The text of a scene's file. Options that are none of a scene, as width and layers, are left out. */
export async function sceneToText(options, presetLights) {
  const ofScene = Object.fromEntries(Object.entries(options).filter(([key]) => sceneKeys.includes(key)));
  const { scene, material, lights, environment, fitted } = await readScene(ofScene, presetLights);
  if (fitted) {
    throw new TypeError(
      'heightScale: "auto" depends on heights, which the file of a scene has not; give the number, statistics.heightScale',
    );
  }
  const list = lights.map((light) => `    ${block(lightMembers(light), "    ")}`).join(",\n");
  const members = [
    ["reliefScene", String(fileVersion)],
    ...valuesOf(sceneRows, scene),
    ["material", block(valuesOf(materialRows, material), "  ")],
    ["lights", lights.length === 0 ? "[]" : `[\n${list}\n  ]`],
    ...(environment ? [["environment", block(environmentMembers(environment), "  ")]] : []),
  ];
  return `${block(members, "")}\n`;
}

//--------------------------------------------------------------------------------------------------
// Reading.

const isObject = (value) => typeof value === "object" && value !== null && !Array.isArray(value);

// Members by rows, as options; what else an object has is noted as unknown.
function readMembers(object, path, rows, others, unknown) {
  const values = {};
  for (const row of rows) {
    if (object[row.key] !== undefined) {
      readParameter(row, path + row.key, object[row.key]);
      values[row.key] = row.kind === "choice" ? wordOf(row, object[row.key]) : object[row.key];
    }
  }
  for (const key of Object.keys(object)) {
    if (!others.includes(key) && !rows.some((row) => row.key === key)) {
      unknown.push(path + key);
    }
  }
  return values;
}

const wordOf = (row, word) => row.choices[readParameter(row, row.key, word)].word;

function need(object, path, key) {
  if (object[key] === undefined) {
    throw new TypeError(`${path.replace(/\.$/, "") || "scene"}: the key "${key}" is missing`);
  }
  return object[key];
}

function readLight(light, path, unknown) {
  const kind = needWord(`${path}kind`, need(light, path, "kind"), ["sun", "point"]);
  if (kind === 1) {
    const values = readMembers(light, path, lightRows, ["kind", "position"], unknown);
    delete values.angularDiameter; // means nothing for a lamp
    return {
      kind: "point",
      position: needVector(`${path}position`, need(light, path, "position"), 3),
      ...values,
    };
  }
  const sun = {
    kind: "sun",
    azimuth: needFinite(`${path}azimuth`, need(light, path, "azimuth")),
    altitude: needFinite(`${path}altitude`, need(light, path, "altitude")),
    ...readMembers(light, path, lightRows, ["kind", "azimuth", "altitude", "toward"], unknown),
  };
  return light.toward === undefined ? sun : { ...sun, toward: needVector(`${path}toward`, light.toward, 3) };
}

function readEnvironment(environment, unknown) {
  const path = "environment.";
  const image = imageWords[needWord(`${path}image`, need(environment, path, "image"), imageWords)];
  const result = { image };
  for (const key of { clearSky: ["azimuth", "altitude"], file: ["file"] }[image] ?? []) {
    result[key] = need(environment, path, key);
  }
  if (image === "clearSky" && environment.turbidity !== undefined) {
    result.turbidity = environment.turbidity;
  }
  const others = ["image", "azimuth", "altitude", "turbidity", "file"];
  return { ...result, ...readMembers(environment, path, environmentRows, others, unknown) };
}

// Where a number that has an automatic one was given: the switch decides, as in the file.
function withAutomatic(values, rows) {
  for (const row of rows) {
    const automatic = rows.find((other) => other.name === `Automatic${row.name}`);
    if (automatic && values[automatic.key] === true) {
      values[row.key] = "auto";
    }
    if (automatic) {
      delete values[automatic.key];
    }
  }
  return values;
}

/** The options of a scene, and which keys of its file nobody knows. */
export function sceneFromText(text) {
  if (typeof text !== "string") {
    throw typeError("scene", text, "the text of a file is");
  }
  const object = JSON.parse(text);
  if (!isObject(object)) {
    throw typeError("scene", object, 'an object with the key "reliefScene" is');
  }
  if (need(object, "", "reliefScene") !== fileVersion) {
    throw new RangeError(
      `reliefScene: the file is of version ${shown(object.reliefScene)}, this package reads version ${fileVersion}`,
    );
  }
  const unknown = [];
  const others = ["reliefScene", "material", "lights", "environment"];
  const options = withAutomatic(readMembers(object, "", sceneRows, others, unknown), sceneRows);
  if (object.material !== undefined) {
    if (!isObject(object.material)) {
      throw typeError("material", object.material, "an object is");
    }
    Object.assign(
      options,
      withAutomatic(readMembers(object.material, "material.", materialRows, [], unknown), materialRows),
    );
  }
  if (object.lights !== undefined) {
    if (!Array.isArray(object.lights) || !object.lights.every(isObject)) {
      throw typeError("lights", object.lights, "an array of objects is");
    }
    options.lights = object.lights.map((light, k) => readLight(light, `lights[${k}].`, unknown));
  }
  if (object.environment !== undefined) {
    if (!isObject(object.environment)) {
      throw typeError("environment", object.environment, "an object is");
    }
    options.environment = readEnvironment(object.environment, unknown);
  }
  return { options, unknown };
}
