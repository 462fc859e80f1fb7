// SPDX-License-Identifier: BSD-3-Clause
//
// What mouse, fingers, wheel and keys do on the picture. A light is dragged by its dot, and comes to where one
// taps. Two fingers, the wheel, the middle button and dragging with the space bar held move and enlarge the
// picture, and so does dragging beside the dots once a part of it is out of sight.

import { moveLight, placeOfLight, raiseLight } from "./lights.js";

const slop = { mouse: 3, pen: 5, touch: 8 }; // pixels that are no dragging yet
const doubleTap = { seconds: 0.35, pixels: 24 };
const step = 1.25; // by which keys and buttons enlarge
const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const zooming = { "+": step, "=": step, "-": 1 / step, _: 1 / step };
const lineHeight = 16; // of wheels that count lines
const minus = (a, b) => [a[0] - b[0], a[1] - b[1]];
const apart = (a, b) => Math.hypot(...minus(a, b));
const between = (a, b) => [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
const round = (value, digits) => Number(value.toPrecision(digits));

export class Gestures {
  /**
   * @param page   what has field, state, view, dots and turning; changeLight(), changeEnvironment(), select(),
   *               endGesture(), cancelGesture()
   */
  constructor(frame, page) {
    this.frame = frame;
    this.page = page;
    this.pointers = new Map(); // places by their numbers
    this.action = null; // what they do
    this.space = false;
    this.lastTap = null;
    const listeners = {
      pointerdown: (event) => this.down(event),
      pointermove: (event) => this.move(event),
      pointerup: (event) => this.up(event, true),
      pointercancel: (event) => this.up(event, false),
      wheel: (event) => this.wheel(event),
      keydown: (event) => this.key(event),
      keyup: (event) => this.keyUp(event),
      blur: () => this.holdSpace(false),
      // What the middle button does elsewhere.
      auxclick: (event) => event.preventDefault(),
    };
    for (const [name, listener] of Object.entries(listeners)) {
      frame.addEventListener(name, listener, { passive: false });
    }
  }

  placeOf(event) {
    const { left, top } = this.frame.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  }

  get light() {
    const { scene, selected } = this.page.state;
    return scene.lights[selected];
  }

  //------------------------------------------------------------------------------------------------
  // Pointers.

  down(event) {
    const taken = event.button === 0 || event.button === 1;
    if (!taken || !this.page.field || this.pointers.size === 2 || this.pointers.has(event.pointerId)) {
      return;
    }
    event.preventDefault();
    this.frame.focus({ preventScroll: true });
    this.frame.setPointerCapture(event.pointerId);
    const at = this.placeOf(event);
    this.pointers.set(event.pointerId, at);
    this.frame.classList.add("dragging");
    if (this.pointers.size === 2) {
      // The first of two fingers was not meant to move anything.
      this.page.cancelGesture();
      this.lastTap = null;
      this.action = { what: "pinch" };
      return;
    }
    this.action = this.begin(event, at);
  }

  begin(event, at) {
    if (event.button === 1 || this.space) {
      return { what: "pan" };
    }
    const { page } = this;
    if (page.turning) {
      return { what: "turn", at, environment: page.state.scene.environment };
    }
    const nearest = page.dots.near(at);
    const press = { what: "press", at, slop: slop[event.pointerType] ?? slop.mouse };
    if (nearest === null) {
      return press;
    }
    if (nearest !== page.state.selected) {
      page.select(nearest);
    }
    return { ...press, grip: minus(placeOfLight(this.light, page.field), page.view.toShare(at)) };
  }

  move(event) {
    const before = this.pointers.get(event.pointerId);
    if (!before) {
      return;
    }
    const at = this.placeOf(event);
    const { page, action } = this;
    if (action.what === "press" && apart(at, action.at) > action.slop) {
      const ofLight = action.grip || page.view.isWhole;
      this.action = ofLight ? { what: "light", grip: action.grip ?? [0, 0] } : { what: "pan" };
    }
    switch (this.action.what) {
      case "light":
        this.dragLight(at, this.action.grip, "drag");
        break;
      case "turn":
        this.turn(minus(at, this.action.at), this.action.environment);
        break;
      case "pan":
        page.view.panBy(minus(at, before));
        break;
      case "pinch":
        this.pinch(event.pointerId, before, at);
        break;
      default:
    }
    if (this.action.what !== "press") {
      this.pointers.set(event.pointerId, at);
    }
  }

  // The place between the fingers goes with them.
  pinch(id, before, at) {
    const [other] = [...this.pointers].filter(([one]) => one !== id).map(([, place]) => place);
    if (!other) {
      return;
    }
    const { view } = this.page;
    view.panBy(minus(between(at, other), between(before, other)));
    view.zoomBy(Math.max(apart(at, other), 1) / Math.max(apart(before, other), 1), between(at, other));
  }

  up(event, meant) {
    if (!this.pointers.delete(event.pointerId)) {
      return;
    }
    if (this.pointers.size > 0) {
      this.action = { what: "pan" };
      return;
    }
    const { action } = this;
    this.action = null;
    this.frame.classList.remove("dragging");
    if (action.what === "press" && meant) {
      this.tap(action, event.timeStamp / 1000);
    } else {
      this.page.endGesture();
    }
  }

  // The light comes there, unless it is there. A second tap shows the whole relief and takes back what the first
  // one did.
  tap({ at, grip }, now) {
    const { page, lastTap } = this;
    const second =
      lastTap && now - lastTap.time < doubleTap.seconds && apart(at, lastTap.at) < doubleTap.pixels;
    if (second && !page.view.isWhole) {
      this.lastTap = null;
      if (page.history.state === lastTap.state) {
        page.cancelGesture();
      }
      page.view.fit();
      return;
    }
    page.endGesture();
    if (!grip) {
      this.dragLight(at, [0, 0], "tap");
    }
    this.lastTap = { time: now, at, state: page.history.state };
  }

  dragLight(at, grip, gesture) {
    const { state, field, view } = this.page;
    const place = view.toShare(at).map((c, k) => c + grip[k]);
    this.page.changeLight(moveLight(this.light, place, field, state.scene), gesture);
  }

  turn(pixels, environment) {
    if (environment) {
      const [du, dv] = pixels.map((c, k) => c / this.page.view.size[k]);
      const rotationZ = ((((environment.rotationZ ?? 0) + 180 * du) % 360) + 360) % 360;
      const tilt = Math.min(Math.max((environment.tilt ?? 0) + 180 * dv, -180), 180);
      this.page.changeEnvironment({ rotationZ: round(rotationZ, 5), tilt: round(tilt, 5) }, "turn");
    }
  }

  //------------------------------------------------------------------------------------------------
  // Wheel and keys.

  raise(steps, gesture) {
    const { state, field } = this.page;
    this.page.changeLight(raiseLight(this.light, steps, field, state.scene), gesture);
  }

  wheel(event) {
    if (!this.page.field) {
      return;
    }
    event.preventDefault();
    // With shift some browsers turn it on its side.
    const turned = event.deltaY || event.deltaX;
    if (event.shiftKey) {
      this.raise(-Math.sign(turned), "wheel");
      return;
    }
    const pixels = event.deltaMode === 0 ? turned : turned * lineHeight;
    // Pinching on a pad comes as small steps with control.
    const speed = event.ctrlKey ? 0.01 : 0.002;
    this.page.view.zoomBy(Math.exp(-speed * Math.min(Math.max(pixels, -400), 400)), this.placeOf(event));
  }

  holdSpace(held) {
    this.space = held;
    this.frame.classList.toggle("panning", held);
  }

  keyUp(event) {
    if (event.key === " ") {
      this.holdSpace(false);
    }
    this.page.endGesture();
  }

  key(event) {
    const { page } = this;
    const command = event.ctrlKey || event.metaKey;
    if (event.altKey || !page.field || (command && !(event.key in arrows))) {
      return;
    }
    const steps = event.shiftKey ? 10 : 1;
    if (event.key in arrows) {
      this.arrow(arrows[event.key], steps, command || this.space);
    } else if (event.key in zooming) {
      page.view.zoomBy(zooming[event.key]);
    } else if (event.key === "0") {
      page.view.fit();
    } else if (event.key === " ") {
      this.holdSpace(true);
    } else if (event.key === "PageUp" || event.key === "PageDown") {
      this.raise(event.key === "PageUp" ? steps : -steps, "keys");
    } else if (event.key === "Escape" && this.action) {
      this.action = { what: "nothing" };
      page.cancelGesture();
    } else {
      return;
    }
    event.preventDefault();
  }

  arrow([dx, dy], steps, panning) {
    const { page } = this;
    const { view, field, state } = page;
    if (panning) {
      const pixels = 0.1 * Math.min(...view.room);
      view.panBy([-dx * pixels, -dy * pixels]);
    } else if (page.turning) {
      const [w, h] = view.size;
      this.turn([(dx * steps * w) / 180, (dy * steps * h) / 180], state.scene.environment);
    } else {
      const [u, v] = placeOfLight(this.light, field);
      const pixels = 0.01 * steps * Math.min(...view.size);
      const place = [u + (dx * pixels) / view.size[0], v + (dy * pixels) / view.size[1]];
      page.changeLight(moveLight(this.light, place, field, state.scene), "keys");
    }
  }
}
