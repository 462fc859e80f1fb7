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
const near = 28; // pixels
const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

export class LightDots {
  /**
   * @param page   what has field, state and turning; change(state, gesture), endGesture()
   */
  constructor(frame, page) {
    this.frame = frame;
    this.page = page;
    this.box = frame.querySelector("#dots");
    this.horizon = frame.querySelector("#horizon");
    this.pointer = null;
    const listeners = {
      pointerdown: (event) => this.down(event),
      pointermove: (event) => this.move(event),
      pointerup: (event) => this.up(event),
      pointercancel: (event) => this.up(event),
      wheel: (event) => this.wheel(event),
      keydown: (event) => this.key(event),
      keyup: () => page.endGesture(),
    };
    for (const [name, listener] of Object.entries(listeners)) {
      frame.addEventListener(name, listener, { passive: false });
    }
  }

  show() {
    const { state, field } = this.page;
    const { lights } = state.scene;
    while (this.box.children.length > lights.length) {
      this.box.lastChild.remove();
    }
    while (this.box.children.length < lights.length) {
      this.box.append(document.createElement("div"));
    }
    lights.forEach((light, k) => {
      const dot = this.box.children[k];
      // Those that are outside stay at the rim, to be caught.
      const [u, v] = placeOfLight(light, field).map((c) => Math.min(Math.max(c, 0), 1));
      dot.className = `dot${k === state.selected ? " selected" : ""}${light.on === false ? " off" : ""}`;
      dot.style.left = `${100 * u}%`;
      dot.style.top = `${100 * v}%`;
      dot.style.background = colorToHex(light.color ?? [1, 1, 1]);
    });
    const [w, h] = extentOf(field);
    const share = Math.min(w, h);
    const circle = this.horizon.firstElementChild;
    circle.setAttribute("cx", "50%");
    circle.setAttribute("cy", "50%");
    circle.setAttribute("r", `${((share / w) * this.frame.clientWidth) / 2 || 0}`);
    this.horizon.classList.toggle("sun", lights[state.selected].kind === "sun");
  }

  placeOf(event) {
    const { left, top, width, height } = this.frame.getBoundingClientRect();
    return [(event.clientX - left) / width, (event.clientY - top) / height];
  }

  // The dot under the pointer, or else the selected one, which then comes to it.
  down(event) {
    if (event.button !== 0 || this.pointer !== null || !this.page.field) {
      return;
    }
    event.preventDefault();
    this.frame.focus({ preventScroll: true });
    this.frame.setPointerCapture(event.pointerId);
    this.pointer = event.pointerId;
    this.frame.classList.add("dragging");
    const { state, field } = this.page;
    const place = this.placeOf(event);
    this.begin = { place, environment: state.scene.environment };
    if (this.page.turning) {
      return;
    }
    const { clientWidth: w, clientHeight: h } = this.frame;
    const apart = state.scene.lights.map((light) => {
      const at = placeOfLight(light, field).map((c) => Math.min(Math.max(c, 0), 1));
      return Math.hypot((at[0] - place[0]) * w, (at[1] - place[1]) * h);
    });
    const nearest = apart.indexOf(Math.min(...apart));
    if (apart[nearest] <= near) {
      const at = placeOfLight(state.scene.lights[nearest], field);
      this.grip = [at[0] - place[0], at[1] - place[1]];
      if (nearest !== state.selected) {
        this.page.select(nearest);
      }
    } else {
      this.grip = [0, 0];
      this.drag(place);
    }
  }

  move(event) {
    if (event.pointerId !== this.pointer) {
      return;
    }
    const place = this.placeOf(event);
    if (this.page.turning) {
      this.turn(place);
    } else {
      this.drag(place);
    }
  }

  drag(place) {
    const { state, field } = this.page;
    const to = place.map((c, k) => c + this.grip[k]);
    this.page.changeLight(moveLight(state.scene.lights[state.selected], to, field, state.scene), "drag");
  }

  turn(place) {
    const environment = this.begin.environment;
    if (environment) {
      const [du, dv] = place.map((c, k) => c - this.begin.place[k]);
      const rotationZ = ((((environment.rotationZ ?? 0) + 180 * du) % 360) + 360) % 360;
      const tilt = Math.min(Math.max((environment.tilt ?? 0) + 180 * dv, -180), 180);
      this.page.changeEnvironment({ rotationZ: round(rotationZ, 5), tilt: round(tilt, 5) }, "turn");
    }
  }

  up(event) {
    if (event.pointerId === this.pointer) {
      this.pointer = null;
      this.frame.classList.remove("dragging");
      this.page.endGesture();
    }
  }

  raise(steps, gesture) {
    const { state, field } = this.page;
    this.page.changeLight(raiseLight(state.scene.lights[state.selected], steps, field, state.scene), gesture);
  }

  wheel(event) {
    if (!event.ctrlKey && this.frame.matches(":focus")) {
      event.preventDefault();
      this.raise(-Math.sign(event.deltaY), "wheel");
    }
  }

  key(event) {
    if (event.ctrlKey || event.altKey || event.metaKey || !this.page.field) {
      return;
    }
    const { state, field } = this.page;
    const light = state.scene.lights[state.selected];
    const steps = event.shiftKey ? 10 : 1;
    if (event.key in arrows) {
      const [dx, dy] = arrows[event.key];
      if (this.page.turning) {
        this.begin = { place: [0, 0], environment: state.scene.environment };
        this.turn([(dx * steps) / 180, (dy * steps) / 180]);
      } else {
        const [u, v] = placeOfLight(light, field);
        const [w, h] = extentOf(field);
        const step = 0.01 * steps * Math.min(w, h);
        this.page.changeLight(
          moveLight(light, [u + (dx * step) / w, v + (dy * step) / h], field, state.scene),
          "keys",
        );
      }
    } else if (event.key === "PageUp" || event.key === "PageDown") {
      this.raise(event.key === "PageUp" ? steps : -steps, "keys");
    } else {
      return;
    }
    event.preventDefault();
  }
}
