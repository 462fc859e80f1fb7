// SPDX-License-Identifier: BSD-3-Clause
//
// The picture in the canvas: by WebGL 2, or by the exact sums in workers where there is none. Workers are ready
// sooner, so that the first picture is theirs.

import { createWorkerShader, planScene } from "reliefshading";
import { rowOf, shadeOptions, usualOf } from "./scene.js";
import { ReliefRenderer } from "reliefshading-webgl";

const seconds = 0.03; // for a frame
const calm = 160; // milliseconds without a change, after which the picture becomes as good as it gets
const smooth = 0.06; // seconds for a picture in workers while something moves
const coarseSamples = [4000, 60000]; // of such a picture, at least and at most
const patience = 6000; // milliseconds in which a lost context may come back
const mostSeen = 2 ** 22; // samples that workers shade for the screen, unless pixels are finer
const impatience = 0.3; // seconds after which a fine picture is given up for one that moves
const mostWorkers = 4;
// Where the processor shades graphics are in software, too.
const plainContext = { willReadFrequently: true };
const mostCopied = 2 ** 26; // samples in all workers together

/** Every nth sample. */
function coarser(field, n) {
  if (n <= 1) {
    return field;
  }
  const width = Math.ceil(field.width / n);
  const height = Math.ceil(field.height / n);
  const heights = new field.heights.constructor(width * height);
  for (let j = 0; j < height; ++j) {
    for (let i = 0; i < width; ++i) {
      heights[j * width + i] = field.heights[j * n * field.width + i * n];
    }
  }
  return { ...field, heights, width, height, spacing: field.spacing.map((size) => n * size) };
}

/** What a scene leaves to the default, if it does. */
const numberIn = (owner, key, values) => values[key] ?? usualOf(rowOf(owner, key));

/** How many lights a scene has, about. */
function lightsIn({ lights, environment, ...scene }) {
  const ofSuns = numberIn("scene", "numberOfSunSamples", scene);
  const count = (light) => (light.angularDiameter > 0 ? ofSuns : 1);
  const shining = lights.filter((light) => light.on !== false);
  const shines = environment && environment.image !== "none";
  const around = shines ? numberIn("environment", "numberOfSamples", environment) : 0;
  return Math.max(
    shining.reduce((sum, light) => sum + count(light), around),
    1,
  );
}

/** A scene of few lights, for while something moves. */
function withFewLights(options) {
  const most = (owner, key, values) => ({
    ...values,
    [key]: Math.min(numberIn(owner, key, values), usualOf(rowOf(owner, key))),
  });
  const few = most("scene", "numberOfSunSamples", options);
  return options.environment
    ? { ...few, environment: most("environment", "numberOfSamples", options.environment) }
    : few;
}

/** Whether WebGL is there but computed by the processor, which the exact sums then do sooner. */
function inSoftware() {
  const gl = document.createElement("canvas").getContext("webgl2");
  if (!gl) {
    return false;
  }
  const names = gl.getExtension("WEBGL_debug_renderer_info");
  const name = gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  gl.getExtension("WEBGL_lose_context")?.loseContext(); // there are only so many
  return /SwiftShader|llvmpipe|softpipe|software|Basic Render/i.test(name);
}

/** How many workers shade a field; each of them has a copy of the heights. */
export function workersFor({ width, height }) {
  const room = Math.floor(mostCopied / (width * height));
  return Math.max(Math.min(room, mostWorkers, navigator.hardwareConcurrency || 1), 1);
}

//--------------------------------------------------------------------------------------------------
class OnGraphicsProcessor {
  /** @param on   lost(whether), redraw(), wrong(error) */
  constructor(canvas, on) {
    this.name = "WebGL 2";
    this.on = on;
    const onLost = () => on.lost(true);
    const onRestored = () => on.lost(false);
    this.renderer = new ReliefRenderer(canvas, { onLost, onRestored });
  }

  setField(field) {
    this.field = field;
    this.renderer.setHeights(field.heights, field);
    this.unexposed = null;
  }

  async setScene(state, field, assets) {
    const options = shadeOptions(state, field, assets);
    const plan = await planScene(options, this.renderer.bounds);
    this.renderer.setScene(plan);
    this.unexposed = plan.automaticExposure ? options : null;
  }

  // By all samples, which the graphics processor has not; until then the samples that are shown decide, and while
  // things move the last one stays.
  async expose() {
    const { field } = this;
    const options = this.unexposed;
    this.exposing = true;
    try {
      this.exposer ??= createWorkerShader();
      const stops = await this.exposer.findExposure(field.heights, options);
      if (!this.disposed && field === this.field) {
        this.renderer.setExposure(stops);
      }
    } catch (error) {
      this.on.wrong(error);
    }
    this.exposing = false;
    if (options === this.unexposed) {
      this.unexposed = null;
    }
    this.on.redraw();
  }

  async draw({ zoom, center: [centerX, centerY] }, moving) {
    const { converged, lost } = this.renderer.render({ seconds, moving, zoom, centerX, centerY });
    if (this.unexposed && !this.exposing && !moving) {
      this.expose();
    }
    return { converged: lost || (converged && !this.unexposed && !this.exposing) };
  }

  dispose() {
    this.disposed = true;
    this.renderer.dispose();
    this.exposer?.terminate();
  }
}

class OnProcessor {
  constructor(canvas) {
    this.name = "WebAssembly";
    this.canvas = canvas;
    this.context = canvas.getContext("2d", plainContext);
    this.since = null; // when a fine picture was begun
    this.employ(workersFor({ width: 1, height: 1 }));
  }

  employ(count) {
    if (count !== this.workers) {
      this.shader?.terminate();
      this.shader = createWorkerShader({ workers: count });
      this.workers = count;
    }
  }

  /** A fine picture that takes long is given up. */
  interrupt() {
    const { since, workers } = this;
    if (since !== null && performance.now() - since > 1000 * impatience) {
      this.since = null;
      this.workers = 0;
      this.employ(workers);
    }
  }

  setField(field) {
    this.field = field;
    this.fields = new Map(); // of every nth sample
    if (this.since !== null) {
      this.workers = 0; // what they do is of no use
    }
    this.employ(workersFor(field));
    this.shown = null; // a coarse picture comes first
    this.rate = 0; // seconds for a sample and a light
    this.since = null;
  }

  async setScene(state, field, assets) {
    const options = shadeOptions(state, field, assets);
    if ((options.subsurfaceDepth ?? "auto") === "auto") {
      // A coarse picture has a depth of its own where it is automatic.
      options.subsurfaceDepth = (field.spacing[0] + field.spacing[1]) / 2;
    }
    this.options = options;
    this.quick = withFewLights(options);
    this.made = null; // what the fine picture was made of
    this.rough = false; // whether there is a coarse one
  }

  // Every nth sample.
  every(n) {
    if (!this.fields.has(n)) {
      this.fields.set(n, coarser(this.field, n));
    }
    return this.fields.get(n);
  }

  // As fine as there is time for.
  coarseField() {
    const { width, height } = this.field;
    const [least, most] = coarseSamples;
    const lights = lightsIn(this.quick);
    const wanted = this.rate > 0 ? smooth / (this.rate * lights) : (4 * most) / lights;
    return this.every(Math.ceil(Math.sqrt((width * height) / Math.min(Math.max(wanted, least), most))));
  }

  // All samples, but of a large field no more than there are pixels.
  fineField(view) {
    const { width, height, spacing } = this.field;
    const pixels = this.ratio(view, 0) * view.scale * Math.min(...spacing);
    return this.every(width * height > mostSeen ? Math.max(Math.floor(1 / pixels), 1) : 1);
  }

  async shade({ heights, width, height, spacing }, options) {
    const begin = performance.now();
    const { data } = await this.shader.shade(heights, { ...options, width, height, spacing });
    const rate = (performance.now() - begin) / 1000 / (width * height * lightsIn(options));
    this.rate = this.rate > 0 ? (this.rate + rate) / 2 : rate;
    const picture = new OffscreenCanvas(width, height);
    picture.getContext("2d", plainContext).putImageData(new ImageData(data, width, height), 0, 0);
    return picture;
  }

  // Shades a field, unless that is interrupted.
  async make(wanted, fine) {
    const { shader, field } = this;
    this.since = fine ? performance.now() : null;
    try {
      const picture = await this.shade(wanted, fine ? this.options : this.quick);
      if (field === this.field) {
        this.shown = picture;
        this.made = fine ? wanted : null;
        this.rough = !fine;
      }
    } catch (error) {
      if (shader === this.shader) {
        throw error;
      }
    }
    this.since = null;
  }

  async draw(view, moving) {
    const fine = this.fineField(view);
    const quick = moving || !this.shown;
    if (this.made !== fine && !(quick && this.rough)) {
      await (quick ? this.make(this.coarseField(), false) : this.make(fine, true));
    }
    if (!this.shown) {
      return { converged: false };
    }
    const [left, top] = view.toPixels([0, 0]).map((c, axis) => c * this.ratio(view, axis));
    const size = view.size.map((length, axis) => length * this.ratio(view, axis));
    this.context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    this.context.drawImage(this.shown, left, top, ...size);
    return { converged: this.made === fine };
  }

  ratio(view, axis) {
    return [this.canvas.width, this.canvas.height][axis] / view.room[axis];
  }

  dispose() {
    this.shader.terminate();
    this.shader = null;
  }
}

//--------------------------------------------------------------------------------------------------
export class Picture {
  /**
   * @param assets    pixels by their names
   * @param on        wrong(error), busy(whether), host(name), lost(whether), told(what is to be known)
   * @param kind      "webgl" or "wasm"; else what is quicker
   */
  constructor(canvas, assets, on, kind) {
    this.canvas = canvas;
    this.assets = assets;
    this.on = on;
    this.kind = kind;
    this.frames = 0;
    this.changed = false;
    this.moving = false;
    this.waiting = [];
    this.first = new Promise((resolve) => (this.tellFirst = resolve));
    this.host = null;
    this.next = null; // the canvas of a host that has not drawn yet
    this.begin(kind);
  }

  begin(kind) {
    this.mayChange = kind !== "webgl" && kind !== "wasm";
    if (kind === "webgl") {
      this.host = this.onGraphicsProcessor(this.canvas);
      if (!this.host) {
        this.replaceCanvas();
      }
    }
    this.host ??= new OnProcessor(this.canvas);
    this.on.host(this.host.name);
  }

  onGraphicsProcessor(canvas) {
    const on = {
      lost: (lost) => this.lose(lost),
      redraw: () => this.schedule(),
      wrong: this.on.wrong,
    };
    try {
      return new OnGraphicsProcessor(canvas, on);
    } catch {
      return null;
    }
  }

  // A graphics processor goes on, where there is one. What workers have drawn stays until it has drawn, too.
  changeHost() {
    const canvas = this.canvas.cloneNode();
    const host = inSoftware() ? null : this.onGraphicsProcessor(canvas);
    if (host) {
      this.host.dispose();
      this.host = host;
      this.next = canvas;
      host.setField(this.field);
      this.changed = true;
      this.on.host(host.name);
    }
  }

  showNext() {
    if (this.next) {
      this.canvas.replaceWith(this.next);
      this.canvas = this.next;
      this.next = null;
    }
  }

  // A context that is lost mostly comes back soon.
  lose(lost) {
    this.on.lost(lost);
    clearTimeout(this.gone);
    if (lost) {
      this.gone = setTimeout(() => {
        this.fallBack("the graphics processor was lost and has not come back.");
        this.schedule();
      }, patience);
    }
    this.schedule();
  }

  end() {
    clearTimeout(this.gone);
    this.host.dispose();
    this.host = null;
    this.next = null;
    this.replaceCanvas();
  }

  // A canvas that has given one kind of context gives no other.
  replaceCanvas() {
    const fresh = this.canvas.cloneNode();
    this.canvas.replaceWith(fresh);
    this.canvas = fresh;
  }

  /** What WebGL 2 refuses, as a field that is too large, goes on in workers, until there is another field. */
  fallBack(reason) {
    this.end();
    this.begin("wasm");
    this.host.setField(this.field);
    this.changed = true;
    this.refused = true;
    this.on.told(`This relief is shaded by the processor: ${reason}`);
  }

  setField(field) {
    this.field = field;
    if (this.refused) {
      this.refused = false;
      this.end();
      this.begin(this.kind);
    }
    this.host.setField(field);
  }

  setState(state, moving) {
    this.state = state;
    this.changed = true;
    this.move(moving);
  }

  /** Another part of the relief is seen. */
  setView(view, moving) {
    this.view = view;
    this.move(moving);
  }

  move(moving) {
    if (moving) {
      this.host.interrupt?.();
    }
    this.moving = moving;
    clearTimeout(this.timer);
    if (moving) {
      this.timer = setTimeout(() => this.rest(), calm);
    }
    this.schedule();
  }

  rest() {
    this.moving = false;
    this.schedule();
  }

  resize(width, height) {
    for (const canvas of [this.canvas, this.next]) {
      if (canvas && (canvas.width !== width || canvas.height !== height)) {
        canvas.width = width;
        canvas.height = height;
        this.schedule();
      }
    }
  }

  schedule() {
    this.wanted = true;
    if (!this.running && this.field && this.state && this.view) {
      this.running = true;
      // The first picture waits for nothing.
      if (this.frames === 0) {
        this.frame();
      } else {
        requestAnimationFrame(() => this.frame());
      }
    }
  }

  async frame() {
    this.wanted = false;
    const { field } = this;
    let converged = true;
    try {
      if (this.changed) {
        this.changed = false;
        await this.host.setScene(this.state, this.field, this.assets);
      }
      const moving = this.moving;
      ({ converged } = await this.host.draw(this.view, moving));
      converged = converged && moving === this.moving;
      this.frames += 1;
      this.showNext();
      this.tellFirst();
      if (this.mayChange) {
        this.mayChange = false;
        // When it is seen: what comes now takes a while.
        await new Promise((seen) => requestAnimationFrame(() => setTimeout(seen)));
        this.changeHost();
        converged = false;
      }
    } catch (error) {
      if (field !== this.field) {
        converged = false; // there is another one now, of which nothing is said
      } else if (error.name === "ReliefError" && this.host instanceof OnGraphicsProcessor) {
        this.fallBack(error.message);
        converged = false;
      } else {
        this.on.wrong(error);
        this.tellFirst();
      }
    }
    this.on.busy(!converged);
    if (this.wanted || (!converged && !this.moving) || this.changed) {
      requestAnimationFrame(() => this.frame());
      return;
    }
    this.running = false;
    if (converged) {
      this.waiting.splice(0).forEach((resolve) => resolve());
    }
  }

  /** Resolves when the picture is as good as it gets. */
  settled() {
    return new Promise((resolve) => {
      this.waiting.push(resolve);
      this.schedule();
    });
  }
}
