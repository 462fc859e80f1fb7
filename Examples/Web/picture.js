// SPDX-License-Identifier: BSD-3-Clause
//
// The picture in the canvas: by WebGL 2, or by the exact sums in a worker where there is none.

import { createWorkerShader } from "./reliefshading/index.js";
import { rendererScene, shadeOptions } from "./scene.js";
import { ReliefRenderer } from "./webgl/relief-gl.js";

const seconds = 0.03; // for a frame
const calm = 160; // milliseconds without a change, after which the picture becomes as good as it gets
const coarseSamples = 60000; // of a picture while something moves, in a worker

/** Every nth sample, so that there are at most so many. */
function coarser(field) {
  const n = Math.ceil(Math.sqrt((field.width * field.height) / coarseSamples));
  if (n <= 1) {
    return field;
  }
  const width = Math.ceil(field.width / n);
  const height = Math.ceil(field.height / n);
  const heights = new Float32Array(width * height);
  for (let j = 0; j < height; ++j) {
    for (let i = 0; i < width; ++i) {
      heights[j * width + i] = field.heights[j * n * field.width + i * n];
    }
  }
  return { ...field, heights, width, height, spacing: field.spacing.map((size) => n * size) };
}

/** Whether WebGL is computed by the processor, which the exact sums then do sooner. */
function inSoftware(gl) {
  const names = gl.getExtension("WEBGL_debug_renderer_info");
  const name = gl.getParameter(names ? names.UNMASKED_RENDERER_WEBGL : gl.RENDERER);
  return /SwiftShader|llvmpipe|softpipe|software|Basic Render/i.test(name);
}

//--------------------------------------------------------------------------------------------------
class OnGraphicsProcessor {
  constructor(canvas, onLost, onRestored) {
    this.name = "WebGL 2";
    this.renderer = new ReliefRenderer(canvas, { onLost, onRestored });
  }

  setField(field) {
    this.renderer.setHeights(field.heights, field);
  }

  async setScene(state, field, assets) {
    this.renderer.setScene(await rendererScene(state, assets));
  }

  async draw(moving) {
    const { converged, lost } = this.renderer.render({ seconds, moving });
    return { converged: converged || lost };
  }

  dispose() {
    this.renderer.dispose();
  }
}

class OnProcessor {
  constructor(canvas) {
    this.name = "WebAssembly";
    this.canvas = canvas;
    this.context = canvas.getContext("2d");
    this.shader = createWorkerShader({ workers: Math.min(4, navigator.hardwareConcurrency || 1) });
  }

  setField(field) {
    this.fields = [field, coarser(field)];
    this.fresh = true; // a coarse picture comes first
  }

  async setScene(state, field, assets) {
    // A coarse picture has a depth of its own where it is automatic.
    const depth = state.scene.subsurfaceDepth ?? "auto";
    const mean = (field.spacing[0] + field.spacing[1]) / 2;
    this.options = [0, 1].map((k) => ({
      ...shadeOptions(state, this.fields[k], assets),
      subsurfaceDepth: depth === "auto" ? mean : depth,
    }));
  }

  async draw(moving) {
    const k = moving || this.fresh ? 1 : 0;
    this.fresh = false;
    const { data, width, height } = await this.shader.shade(this.fields[k].heights, this.options[k]);
    const picture = await createImageBitmap(new ImageData(data, width, height));
    this.context.clearRect(0, 0, this.canvas.width, this.canvas.height);
    this.context.drawImage(picture, 0, 0, this.canvas.width, this.canvas.height);
    return { converged: k === 0 };
  }

  dispose() {
    this.shader.terminate();
  }
}

//--------------------------------------------------------------------------------------------------
export class Picture {
  /**
   * @param assets    pixels by their names
   * @param on        wrong(error), busy(whether), host(name), lost(whether)
   * @param host      "webgl" or "wasm"; else what is quicker
   */
  constructor(canvas, assets, on, host) {
    this.canvas = canvas;
    this.assets = assets;
    this.on = on;
    this.frames = 0;
    this.changed = false;
    this.moving = false;
    this.waiting = [];
    this.first = new Promise((resolve) => (this.tellFirst = resolve));
    this.host = null;
    this.begin(host);
  }

  begin(host) {
    if (host !== "wasm") {
      try {
        this.host = new OnGraphicsProcessor(
          this.canvas,
          () => this.on.lost(true),
          () => {
            this.on.lost(false);
            this.schedule();
          },
        );
        if (host !== "webgl" && inSoftware(this.host.renderer.gl)) {
          this.host.dispose();
          this.host = null;
          this.replaceCanvas();
        }
      } catch {
        this.replaceCanvas();
      }
    }
    this.host ??= new OnProcessor(this.canvas);
    this.on.host(this.host.name);
  }

  // A canvas that has given one kind of context gives no other.
  replaceCanvas() {
    const fresh = this.canvas.cloneNode();
    this.canvas.replaceWith(fresh);
    this.canvas = fresh;
  }

  /** What WebGL 2 refuses, as a field that is too large, goes on in a worker. */
  fallBack() {
    this.host.dispose();
    this.host = null;
    this.replaceCanvas();
    this.begin("wasm");
    this.host.setField(this.field);
    this.changed = true;
  }

  setField(field) {
    this.field = field;
    this.host.setField(field);
  }

  setState(state, moving) {
    this.state = state;
    this.changed = true;
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
    if (this.canvas.width !== width || this.canvas.height !== height) {
      this.canvas.width = width;
      this.canvas.height = height;
      this.schedule();
    }
  }

  schedule() {
    this.wanted = true;
    if (!this.running && this.field && this.state) {
      this.running = true;
      requestAnimationFrame(() => this.frame());
    }
  }

  async frame() {
    this.wanted = false;
    let converged = true;
    try {
      if (this.changed) {
        this.changed = false;
        await this.host.setScene(this.state, this.field, this.assets);
      }
      const moving = this.moving;
      ({ converged } = await this.host.draw(moving));
      converged = converged && moving === this.moving;
      this.frames += 1;
      this.tellFirst();
    } catch (error) {
      if (error.name === "ReliefError" && this.host instanceof OnGraphicsProcessor && !this.refused) {
        this.refused = true; // once; what is wrong with the scene is told by the other
        this.fallBack();
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
