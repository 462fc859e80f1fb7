// SPDX-License-Identifier: BSD-3-Clause
//
// The page's scene: options of the package reliefshading, as they came from a file, and beside them the
// pictures that are open. A key that is missing has its default.

import { parameters, presetOptions, sceneFromJSON, sceneToJSON, usual } from "reliefshading";

const find = (owner, key) => parameters.find((row) => row.owner === owner && row.key === key);

/** The row of a parameter. */
export function rowOf(owner, key) {
  const row = find(owner, key);
  if (!row) {
    throw new Error(`there is no parameter ${owner}.${key}`);
  }
  return row;
}

/** A default as options have it. */
export function usualOf(row) {
  switch (row.kind) {
    case "flag":
      return row.default[0] !== 0;
    case "choice":
      return row.choices[row.default[0]].word;
    case "color":
    case "range":
      return row.default;
    default:
      return row.default[0] ?? "infinite";
  }
}

/** A sun of which nothing is said. */
export const usualSun = { kind: "sun", azimuth: usual.azimuth, altitude: usual.altitude };

//--------------------------------------------------------------------------------------------------
// Colours: linear in scenes, sRGB in the page.

const encode = (c) => (c <= 0.0031308 ? 12.92 * c : 1.055 * c ** (1 / 2.4) - 0.055);
const decode = (c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);

export function colorToHex(color) {
  return `#${color.map((c) => toCode(c).toString(16).padStart(2, "0")).join("")}`;
}

/** The code of 8 bits that a linear component has. */
export const toCode = (c) => Math.round(255 * encode(Math.min(Math.max(c, 0), 1)));

export function hexToColor(hex) {
  return [1, 3, 5].map((at) => Number(decode(parseInt(hex.slice(at, at + 2), 16) / 255).toPrecision(6)));
}

//--------------------------------------------------------------------------------------------------
// Directions of suns.

const degree = Math.PI / 180;

export function directionOf({ azimuth, altitude }) {
  const level = Math.cos(altitude * degree);
  return [
    Math.sin(azimuth * degree) * level,
    Math.cos(azimuth * degree) * level,
    Math.sin(altitude * degree),
  ];
}

export function anglesOf([x, y, z]) {
  const azimuth = (Math.atan2(x, y) / degree + 360) % 360;
  return { azimuth, altitude: Math.atan2(z, Math.hypot(x, y)) / degree };
}

//--------------------------------------------------------------------------------------------------
// For those who shade.

const textureKeys = { base: "baseTexture", diffuse: "diffuseTexture", specular: "specularTexture" };

// The environment with its pixels; none where they are not there yet.
function environmentOf({ scene, images }, assets) {
  if (!scene.environment) {
    return undefined;
  }
  const { image, ...rest } = scene.environment;
  if (image !== "file") {
    return scene.environment;
  }
  const picture = assets.get(images.environment);
  return picture ? { ...rest, image: picture } : undefined;
}

/** Options for shade(). */
export function shadeOptions(state, field, assets) {
  const options = { ...state.scene, environment: environmentOf(state, assets) };
  const { width, height, spacing, origin } = field;
  for (const [name, key] of Object.entries(textureKeys)) {
    options[key] = assets.get(state.images[name]);
  }
  // A scene without light has a sun of its own, but not one whose environment is only missing.
  return { ...options, width, height, spacing, origin };
}

//--------------------------------------------------------------------------------------------------
// Files and links.

export function sceneFile(state) {
  return sceneToJSON(state.scene);
}

/** A scene with the lights of a preset, and the environment and response that belong to them. */
export async function withPreset(scene, name) {
  const { lights, environment, response, ...rest } = scene;
  return withLight({ ...rest, ...(await presetOptions(name)) });
}

/** A scene from the text of a file, with at least one light to be moved. */
export async function readSceneFile(text) {
  let scene;
  try {
    scene = sceneFromJSON(text);
  } catch (error) {
    throw error instanceof SyntaxError ? new Error("it is no JSON") : error;
  }
  return withLight(scene);
}

async function withLight(scene) {
  if (scene.lights?.length > 0) {
    return scene;
  }
  // Beside an environment the added one is off, and changes nothing.
  const lights = scene.environment ? [{ ...usualSun, on: false }] : (await presetOptions("default")).lights;
  return { ...scene, lights };
}

/** A link's text. It names an example and has no pixels. */
export function toLink(example, scene) {
  const bytes = new TextEncoder().encode(JSON.stringify({ example, scene }));
  const text = btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
  return text.replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
}

/** What a link has, checked as a file is; null where it has nothing. */
export async function fromLink(hash) {
  const text = hash.replace(/^#/, "");
  if (text === "") {
    return null;
  }
  try {
    const binary = atob(text.replaceAll("-", "+").replaceAll("_", "/"));
    const bytes = Uint8Array.from(binary, (c) => c.charCodeAt(0));
    const { example, scene } = JSON.parse(new TextDecoder().decode(bytes));
    return { example: String(example), scene: await readSceneFile(await sceneToJSON(scene)) };
  } catch (error) {
    throw new Error(`The link has no scene that can be read: ${error.message}`);
  }
}
