// SPDX-License-Identifier: BSD-3-Clause
//
// The lights as dots on the picture, which mouse, finger and keys move. A lamp is above its dot; a sun's dot is
// read like a compass about the middle: its distance from there is the sun's distance from the zenith.

import { anglesOf, colorToHex, directionOf } from "./scene.js";

const lowest = -89; // altitude
const round = (value, digits = 7) => Number(value.toPrecision(digits));

/** What a lamp's height is measured from: the middle between the lowest and the highest sample. */
export function middleHeight(field, scene) {
  return ((field.bottom + field.top) / 2) * (scene.heightScale ?? 1);
}

export function extentOf({ width, height, spacing }) {
  return [width * spacing[0], height * spacing[1]];
}

function middleOf({ width, height, spacing, origin }) {
  return [origin[0] + ((width - 1) / 2) * spacing[0], origin[1] + ((height - 1) / 2) * spacing[1]];
}

/** A light as a share of the picture: from the left, and from the top. */
export function placeOfLight(light, field) {
  const [w, h] = extentOf(field);
  const [mx, my] = middleOf(field);
  if (light.kind === "point") {
    return [(light.position[0] - mx) / w + 0.5, 0.5 - (light.position[1] - my) / h];
  }
  const reach = (Math.min(w, h) / 2) * ((90 - light.altitude) / 90);
  const turn = (light.azimuth * Math.PI) / 180;
  return [0.5 + (reach * Math.sin(turn)) / w, 0.5 - (reach * Math.cos(turn)) / h];
}

/** The light at another place. A sun goes below the horizon only where there is a floor. */
export function moveLight(light, [u, v], field, scene) {
  const [w, h] = extentOf(field);
  const [mx, my] = middleOf(field);
  const x = (u - 0.5) * w;
  const y = (0.5 - v) * h;
  if (light.kind === "point") {
    return { ...light, position: [round(mx + x, 9), round(my + y, 9), light.position[2]] };
  }
  const { toward, ...rest } = light;
  const zenith = (90 * Math.hypot(x, y)) / (Math.min(w, h) / 2);
  const altitude = Math.max(90 - zenith, scene.useFloor ? lowest : 0);
  const azimuth = zenith > 0 ? anglesOf([x, y, 0]).azimuth : light.azimuth;
  return { ...rest, azimuth: round(azimuth, 6), altitude: round(altitude, 6) };
}

/**
 * A scene over a field that was read in another way: lamps stay where they are on the picture and above it.
 *
 * @param heightScale   of a field without lengths, or after one
 */
export function carriedOver(scene, before, after, heightScale) {
  const next = before.lengths && after.lengths ? { ...scene } : { ...scene, heightScale };
  const rise = middleHeight(after, next) - middleHeight(before, scene);
  next.lights = scene.lights.map((light) => {
    if (light.kind !== "point") {
      return light;
    }
    const { position } = moveLight(light, placeOfLight(light, before), after, scene);
    return { ...light, position: [position[0], position[1], round(position[2] + rise, 9)] };
  });
  return next;
}

/** The light raised by steps: a degree for a sun, a hundredth of the relief for a lamp. */
export function raiseLight(light, steps, field, scene) {
  if (light.kind === "point") {
    const [x, y, z] = light.position;
    return { ...light, position: [x, y, round(z + (steps * Math.max(...extentOf(field))) / 100, 9)] };
  }
  const { toward, ...rest } = light;
  const altitude = Math.min(Math.max(light.altitude + steps, scene.useFloor ? lowest : 0), 90);
  return { ...rest, altitude: round(altitude, 6) };
}

/** A lamp of a sun or a sun of a lamp, in the same direction from the middle of the relief. */
export function otherKind(light, field, scene) {
  const { kind, azimuth, altitude, toward, position, angularDiameter, ...rest } = light;
  const middle = [...middleOf(field), middleHeight(field, scene)];
  if (kind === "point") {
    const angles = anglesOf(position.map((c, k) => c - middle[k]));
    const low = scene.useFloor ? lowest : 0;
    return {
      kind: "sun",
      azimuth: round(angles.azimuth, 6),
      altitude: round(Math.max(angles.altitude, low), 6),
      ...rest,
    };
  }
  const far = Math.max(...extentOf(field)) * 0.6;
  return {
    kind: "point",
    position: directionOf(light).map((c, k) => round(middle[k] + far * c, 9)),
    ...rest,
  };
}

export function describe(light, field, scene) {
  const off = light.on === false ? ", off" : "";
  if (light.kind === "sun") {
    return `Sun at azimuth ${light.azimuth.toFixed(0)}°, altitude ${light.altitude.toFixed(0)}°${off}`;
  }
  const [u, v] = placeOfLight(light, field);
  const above = light.position[2] - middleHeight(field, scene);
  const percent = (share) => `${(100 * share).toFixed(0)} %`;
  return `Point light ${percent(u)} across, ${percent(v)} down, ${Number(above.toPrecision(3))} up${off}`;
}

//--------------------------------------------------------------------------------------------------
const reach = 28; // pixels about a dot where it is caught

export class LightDots {
  /** @param page   what has field, state and view */
  constructor(frame, page) {
    this.page = page;
    this.box = frame.querySelector("#dots");
    this.horizon = frame.querySelector("#horizon");
  }

  // Those that are out of sight stay at the rim, to be caught.
  placeOf(light) {
    const { view, field } = this.page;
    return view.toPixels(placeOfLight(light, field)).map((c, k) => Math.min(Math.max(c, 0), view.room[k]));
  }

  /** The number of the light whose dot is near a place in pixels, or null. */
  near(at) {
    const apart = this.page.state.scene.lights.map((light) => {
      const [x, y] = this.placeOf(light);
      return Math.hypot(x - at[0], y - at[1]);
    });
    const nearest = apart.indexOf(Math.min(...apart));
    return apart[nearest] <= reach ? nearest : null;
  }

  show() {
    const { state, field, view } = this.page;
    const { lights } = state.scene;
    while (this.box.children.length > lights.length) {
      this.box.lastChild.remove();
    }
    while (this.box.children.length < lights.length) {
      this.box.append(document.createElement("div"));
    }
    lights.forEach((light, k) => {
      const dot = this.box.children[k];
      const [x, y] = this.placeOf(light);
      dot.className = `dot${k === state.selected ? " selected" : ""}${light.on === false ? " off" : ""}`;
      dot.style.left = `${x}px`;
      dot.style.top = `${y}px`;
      dot.style.background = colorToHex(light.color ?? [1, 1, 1]);
    });
    const circle = this.horizon.firstElementChild;
    const [x, y] = view.toPixels([0.5, 0.5]);
    circle.setAttribute("cx", x);
    circle.setAttribute("cy", y);
    circle.setAttribute("r", (Math.min(...extentOf(field)) * view.scale) / 2);
    this.horizon.classList.toggle("sun", lights[state.selected].kind === "sun");
  }
}
