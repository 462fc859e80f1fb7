// SPDX-License-Identifier: BSD-3-Clause
//
// Shades height fields in a canvas by WebGL 2, with the very texts of the desktop's mapper.

import { ReliefError } from './error.js';
import { prepareField, takeHeights } from './field.js';
import { Frames } from './frames.js';
import { placeView, visiblePart } from './grid.js';
import { Passes } from './passes.js';

export { ReliefError };

const CACHE_BYTES = 256 * 1024 * 1024;
const MOST_STOPS = 20;
const WHITE_SHARE = 0.995; // of samples that automatic exposure leaves below pure white

function positive(value, usual, name)
{
  const number = value ?? usual;
  if (!(number > 0))
  {
    throw new ReliefError(`${name} is ${value}: a number above 0 is expected`);
  }
  return number;
}

// Rows of pixels from the top instead of from the bottom.
function turnOver(values, width, height)
{
  const turned = new Float32Array(values.length);
  for (let j = 0; j < height; ++j)
  {
    turned.set(values.subarray(4 * width * j, 4 * width * (j + 1)), 4 * width * (height - 1 - j));
  }
  return turned;
}

export class ReliefRenderer
{
  /**
   * @param {HTMLCanvasElement|OffscreenCanvas} canvas
   * @param {object} [options]
   *   cacheBytes   memory for the illuminations that are kept, 256 MB
   *   background   red, green, blue, alpha (premultiplied, 0 to 1) where there is no data, [0, 0, 0, 0]
   *   preserveDrawingBuffer, powerPreference   as getContext() takes them
   *   onLost, onRestored   called when the context has been lost, and when the last picture is back
   */
  constructor(canvas, options = {})
  {
    this.canvas = canvas;
    this.options = { background: [0, 0, 0, 0], ...options };
    this.gl = canvas?.getContext?.('webgl2', {
      alpha: true, antialias: false, depth: false, stencil: false, premultipliedAlpha: true,
      preserveDrawingBuffer: options.preserveDrawingBuffer ?? false,
      powerPreference: options.powerPreference ?? 'high-performance',
    });
    if (!this.gl)
    {
      throw new ReliefError('this browser or canvas gives no WebGL 2: turn on hardware acceleration, use another ' +
        'browser, or shade on the processor');
    }
    this.lost = this.gl.isContextLost();
    this.source = null;  // what setHeights() was given
    this.scene = null;   // what setScene() was given
    this.textures = 0;   // changes with the scene's textures
    this.stops = null;   // of an automatic exposure that was found elsewhere
    this.field = null;   // heights by the scene's scale
    this.last = null;    // how the last picture was asked for
    this.listeners = {
      webglcontextlost: (event) => this.loseContext(event),
      webglcontextrestored: () => this.restoreContext(),
    };
    for (const [name, listener] of Object.entries(this.listeners))
    {
      canvas.addEventListener(name, listener);
    }
    if (!this.lost)
    {
      this.begin();
    }
  }

  begin()
  {
    this.passes = new Passes(this.gl, this.options);
    this.frames = new Frames(this.passes);
    this.loaded = null;
    this.exposure = { version: -1, stops: 0 };
  }

  loseContext(event)
  {
    event.preventDefault(); // or it would not come back
    this.lost = true;
    this.options.onLost?.();
  }

  restoreContext()
  {
    this.lost = false;
    this.begin();
    if (this.last && this.source && this.scene)
    {
      this.render(this.last);
    }
    this.options.onRestored?.();
  }

  /**
   * The heights, row by row; what is not finite has no data. They are read when they are needed, and again after
   * the context was lost: leave them as they are, or call this again.
   * @param {Float32Array} heights   or any other array of numbers
   * @param {object} layout
   *   width, height   samples along x (east) and y (north)
   *   spacing         the length between samples, one number or one for each axis, 1
   *   rows            "north-first", as pictures have them, or "south-first"
   *   origin          x and y of the south-west sample, in which lamps have their positions, [0, 0]
   *   noData          a height that means no data
   */
  setHeights(heights, layout)
  {
    this.source = takeHeights(heights, layout);
    this.field = null;
    this.scene = null;
    this.stops = null;
  }

  /** What planScene() of the package reliefshading wants to know of the heights. */
  get bounds()
  {
    return this.needSource().bounds;
  }

  needSource()
  {
    if (!this.source)
    {
      throw new ReliefError('there are no heights: call setHeights() first');
    }
    return this.source;
  }

  /**
   * A scene as planScene() of the package reliefshading makes it of options, for the heights that were set; with
   * other heights it has to be made anew.
   */
  setScene(scene)
  {
    if (!Array.isArray(scene?.lights) || !scene.medium)
    {
      throw new ReliefError('the scene has no plan: what planScene() gives is expected');
    }
    this.needSource();
    if (this.field && (this.field.scale !== scene.heightScale || this.field.datum !== scene.datum))
    {
      this.field = null;
    }
    const before = this.scene?.textures ?? {};
    const after = { ...scene.textures };
    const names = ['base', 'diffuse', 'specular'];
    // A picture that is given again is the same one, as long as its array is.
    const same = (name) => before[name]?.data === after[name]?.data && before[name]?.width === after[name]?.width;
    names.filter(same).forEach((name) => { after[name] = before[name]; });
    this.textures += names.every(same) ? 0 : 1;
    this.scene = { ...scene, textures: after };
  }

  /**
   * What an automatic exposure is, in stops, as findExposure() of the package finds it by all samples; null where it
   * is not known: then the samples that are shown decide.
   */
  setExposure(stops)
  {
    this.stops = stops;
  }

  prepare()
  {
    this.needSource();
    if (!this.scene)
    {
      throw new ReliefError('there is no scene for these heights: call setScene() first');
    }
    this.field = this.field ?? prepareField(this.source, this.scene.heightScale, this.scene.datum);
    if (this.loaded !== this.field)
    {
      this.passes.setField(this.field);
      this.loaded = this.field;
    }
  }

  /**
   * Shades as much as there is time for and draws to the canvas, at its size. Call it again until it has
   * converged.
   * @param {object} [request]
   *   seconds   the time to take, Infinity. A first picture is coarse if it must be
   *   moving    whether another picture is wanted next, rather than a better one: while something is dragged
   *   detail    texels for a pixel along a side, at most: 1, or less to shade less
   *   centerX, centerY   what lies in the middle of the canvas, as shares of the field from its upper left
   *                      corner, 0.5
   *   zoom      1 for the whole field in the canvas
   * @returns {{converged: boolean, lightsTraced: number, lightsReused: number, detail: number,
   *   progress: number, milliseconds: number, longestDraw: number, lost: boolean}}
   */
  render(request = {})
  {
    const begin = performance.now();
    if (this.disposed)
    {
      throw new ReliefError('the renderer was disposed of: make a new one');
    }
    this.last = { ...request };
    if (this.lost || this.gl.isContextLost())
    {
      return { converged: false, lightsTraced: 0, lightsReused: 0, detail: 0, progress: 0, milliseconds: 0,
        longestDraw: 0, lost: true };
    }
    this.prepare();
    const { frames, passes, canvas } = this;
    const view = { centerX: request.centerX ?? 0.5, centerY: request.centerY ?? 0.5,
      zoom: positive(request.zoom, 1, 'zoom') };
    const detail = Math.min(positive(request.detail, 1, 'detail'), 1);
    this.place = placeView(this.field, canvas.width, canvas.height, view);
    const part = visiblePart(this.field, this.place);
    if (part.any)
    {
      frames.update(this.field, this.scene, {
        part, pixels: canvas.width * canvas.height, mostSize: passes.mostSize, textures: this.textures,
        memory: this.options.cacheBytes ?? CACHE_BYTES, seconds: positive(request.seconds, Infinity, 'seconds'),
        moving: request.moving ?? false, coarseness: 1 / detail,
      });
      this.show(null, true);
    }
    else
    {
      this.clear();
    }
    return {
      converged: !part.any || frames.converged,
      lightsTraced: part.any ? frames.traced.size : 0,
      lightsReused: part.any ? frames.reused : 0,
      detail: part.any ? this.shownDetail() : 1,
      progress: part.any ? frames.progress : 1,
      milliseconds: performance.now() - begin,
      longestDraw: part.any ? 1000 * frames.longestDraw : 0,
      lost: false,
    };
  }

  // Texels for a pixel along a side.
  shownDetail()
  {
    const wanted = Math.max(this.place.step[0], 1) * Math.max(this.place.step[1], 1);
    return Math.min(Math.sqrt(this.frames.shown.detail * wanted), 1);
  }

  show(target, encoded)
  {
    const stops = this.scene.automaticExposure ? this.stops ?? this.findExposure() : this.scene.exposure;
    this.passes.show(this.frames.colors, this.place,
      { target, encoded, exposure: 2 ** stops, background: encoded ? this.options.background : [0, 0, 0, 0] });
  }

  clear()
  {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.disable(gl.SCISSOR_TEST);
    gl.clearColor(...this.options.background);
    gl.clear(gl.COLOR_BUFFER_BIT);
  }

  // As bright as can be with next to nothing that is pure white, by the samples that are shown.
  findExposure()
  {
    if (this.exposure.version !== this.frames.version)
    {
      const colors = this.passes.read(this.frames.colors.texture);
      const largest = [];
      for (let k = 0; k < colors.length; k += 4)
      {
        if (colors[k + 3] > 0)
        {
          largest.push(Math.max(colors[k], colors[k + 1], colors[k + 2]));
        }
      }
      largest.sort((a, b) => a - b);
      const bright = largest[Math.floor(WHITE_SHARE * (largest.length - 1))];
      // A little less than white, so that white is left to the few that are brighter.
      const stops = bright > 0 ? Math.log2(((254 / 255 + 0.055) / 1.055) ** 2.4 / bright) : 0;
      this.exposure = {
        version: this.frames.version, stops: Math.min(Math.max(stops, -MOST_STOPS), MOST_STOPS),
      };
    }
    return this.exposure.stops;
  }

  // The last picture, rows from the top, four numbers a pixel.
  readPicture(encoded)
  {
    const { width, height } = this.place ?? { width: 0, height: 0 };
    if (this.lost || !(width * height > 0) || !this.frames)
    {
      throw new ReliefError('there is no picture to read: call render() first, and again after a lost context');
    }
    if (!this.frames.colors)
    {
      // Nothing of the field has been seen yet.
      const background = encoded ? this.options.background : [0, 0, 0, 0];
      return { width, height, data: Float32Array.from({ length: 4 * width * height }, (_, k) => background[k % 4]) };
    }
    const target = this.passes.texture(width, height, 4);
    this.show(target, encoded);
    const values = this.passes.read(target);
    this.passes.release(target);
    return { width, height, data: turnOver(values, width, height) };
  }

  /** The last picture as sRGB bytes with straight alpha, rows from the top, as ImageData has them. */
  readPixels()
  {
    const { width, height, data } = this.readPicture(true);
    const bytes = new Uint8ClampedArray(data.length);
    for (let k = 0; k < data.length; k += 4)
    {
      const alpha = data[k + 3];
      for (let c = 0; c < 3; ++c)
      {
        bytes[k + c] = alpha > 0 ? (255 * data[k + c]) / alpha : 0;
      }
      bytes[k + 3] = 255 * alpha;
    }
    return { width, height, data: bytes };
  }

  /** The last picture in linear light before exposure, red, green, blue, alpha, premultiplied; rows from the top. */
  readLinear()
  {
    return this.readPicture(false);
  }

  /**
   * The colours of the samples that were shaded, as readLinear() has them, one for each texel of their grid:
   * first and stride, in samples from the south-west, and size. Rows from the top.
   */
  readColors()
  {
    if (this.lost || !this.frames?.colors)
    {
      throw new ReliefError('there are no colours to read: call render() first, and again after a lost context');
    }
    const { grid, texture } = this.frames.colors;
    return {
      width: grid.size[0], height: grid.size[1], first: [...grid.first], stride: [...grid.stride],
      data: turnOver(this.passes.read(texture), ...grid.size),
    };
  }

  /** Frees all that the graphics processor holds. */
  dispose()
  {
    if (this.disposed)
    {
      return;
    }
    this.disposed = true;
    for (const [name, listener] of Object.entries(this.listeners))
    {
      this.canvas.removeEventListener(name, listener);
    }
    this.frames?.dispose();
    this.passes?.dispose();
    this.frames = null;
    this.passes = null;
    this.source = null;
    this.field = null;
  }
}
