// SPDX-License-Identifier: BSD-3-Clause
//
// The steps of shading, each a pass over the texels of a grid: trace a light, gather the lights, compose the
// colours, show them. All of WebGL that this folder calls, as ReliefPasses and ReliefFieldTextures are for
// the desktop.

import { ReliefError } from './error.js';
import {
  composeProgram, DISPLAY, gatherProgram, MOST_GATHERED, probeText, singleDepth, SUM, traceProgram, VERTEX_PROGRAM, webProgram,
} from './programs.js';

const MOST_POOLED = 64 * 1024 * 1024; // bytes of textures that wait to be used again
const MOST_DRAWN = 512 * 1024; // texels in one call
const FORMATS = { 1: ['R32F', 'RED'], 2: ['RG32F', 'RG'], 4: ['RGBA32F', 'RGBA'] };
const SUMS = ['diffuse', 'scatter', 'specular'];

export class Passes
{
  constructor(gl, options = {})
  {
    this.gl = gl;
    if (!gl.getExtension('EXT_color_buffer_float') && !gl.isContextLost())
    {
      throw new ReliefError('the graphics processor cannot draw into floats (EXT_color_buffer_float is ' +
        'missing): use another browser or device, or shade on the processor');
    }
    this.parallel = gl.getExtension('KHR_parallel_shader_compile');
    this.blends = options.floatBlend !== false && Boolean(gl.getExtension('EXT_float_blend'));
    this.mostSize = gl.getParameter(gl.MAX_TEXTURE_SIZE);
    this.framebuffer = gl.createFramebuffer();
    this.pixel = new Float32Array(4);
    this.programs = new Map();
    this.pool = [];
    this.pooled = 0; // their bytes
    this.compiled = false; // whether the last pass was the first of its program
    // How programs tell what is no number; by the bits of it where they must.
    this.tests = options.nanByBits ? [true] : [false, true];
    this.checkNumbers();
  }

  //----------------------------------------------------------------------------
  // Textures

  texture(width, height, components)
  {
    const at = this.pool.findIndex((t) =>
      t.width === width && t.height === height && t.components === components);
    if (at >= 0)
    {
      const [found] = this.pool.splice(at, 1);
      this.pooled -= sizeOf(found);
      return found;
    }
    const { gl } = this;
    const handle = gl.createTexture();
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, handle);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl[FORMATS[components][0]], width, height);
    for (const [name, value] of [['MIN_FILTER', gl.NEAREST], ['MAG_FILTER', gl.NEAREST],
      ['WRAP_S', gl.CLAMP_TO_EDGE], ['WRAP_T', gl.CLAMP_TO_EDGE]])
    {
      gl.texParameteri(gl.TEXTURE_2D, gl[`TEXTURE_${name}`], value);
    }
    return { handle, width, height, components };
  }

  release(texture)
  {
    if (!texture)
    {
      return;
    }
    this.pool.unshift(texture);
    this.pooled += sizeOf(texture);
    while (this.pooled > MOST_POOLED)
    {
      const oldest = this.pool.pop();
      this.pooled -= sizeOf(oldest);
      this.gl.deleteTexture(oldest.handle);
    }
  }

  load(texture, values, row = 0, rows = texture.height)
  {
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE0);
    gl.bindTexture(gl.TEXTURE_2D, texture.handle);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 4);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, row, texture.width, rows, gl[FORMATS[texture.components][1]],
      gl.FLOAT, values);
  }

  setField(field)
  {
    if (field.columns > this.mostSize || field.rows > this.mostSize)
    {
      throw new ReliefError(`the field has ${field.columns} x ${field.rows} samples, and this graphics ` +
        `processor takes ${this.mostSize} along a side (MAX_TEXTURE_SIZE): shade a part of it, or every second`);
    }
    this.release(this.heights);
    this.release(this.bounds);
    this.field = field;
    this.heights = this.texture(field.columns, field.rows, 1);
    this.load(this.heights, field.values);
    this.bounds = this.texture(field.bounds.width, field.bounds.height, 2);
    this.load(this.bounds, field.bounds.values);
  }

  //----------------------------------------------------------------------------
  // Programs

  // Begins a program, if it has not been begun. Browsers compile several at once, and while others draw, until
  // somebody asks how it went.
  start({ key, text })
  {
    let program = this.programs.get(key);
    if (!program)
    {
      program = this.compile(key, webProgram(text(), { nanByBits: this.nanByBits }));
      this.programs.set(key, program);
    }
    return program;
  }

  // Makes a program the current one, when it is compiled.
  use(wanted)
  {
    const { gl } = this;
    const program = this.start(wanted);
    this.compiled = !program.used;
    if (!program.used)
    {
      this.complete(program);
      program.used = true;
    }
    gl.useProgram(program.handle);
    this.current = program;
    this.unit = 0;
    return program;
  }

  // Whether a program could be used without waiting for it.
  isReady(wanted)
  {
    const program = this.start(wanted);
    return program.used || !this.parallel ||
      this.gl.getProgramParameter(program.handle, this.parallel.COMPLETION_STATUS_KHR) !== false;
  }

  compile(key, text)
  {
    const { gl } = this;
    const handle = gl.createProgram();
    const shaders = [[gl.VERTEX_SHADER, VERTEX_PROGRAM], [gl.FRAGMENT_SHADER, text]].map(([type, source]) =>
    {
      const shader = gl.createShader(type);
      gl.shaderSource(shader, source);
      gl.compileShader(shader);
      gl.attachShader(handle, shader);
      return shader;
    });
    gl.linkProgram(handle);
    return { key, handle, shaders, used: false, places: new Map() };
  }

  complete({ key, handle, shaders })
  {
    const { gl } = this;
    if (!gl.getProgramParameter(handle, gl.LINK_STATUS) && !gl.isContextLost())
    {
      const log = shaders.map((s) => gl.getShaderInfoLog(s)).join('') + gl.getProgramInfoLog(handle);
      throw new ReliefError(`the shading program "${key}" was refused: ${log.trim().slice(0, 120)}`);
    }
    shaders.forEach((shader) => gl.deleteShader(shader));
  }

  // Sets a uniform of the current program, if it has one of that name.
  set(kind, name, ...values)
  {
    const { gl, current } = this;
    if (!current.places.has(name))
    {
      current.places.set(name, gl.getUniformLocation(current.handle, name));
    }
    const place = current.places.get(name);
    if (place !== null)
    {
      gl[`uniform${kind}`](place, ...values);
    }
  }

  setTexture(name, texture)
  {
    const { gl } = this;
    gl.activeTexture(gl.TEXTURE0 + this.unit);
    gl.bindTexture(gl.TEXTURE_2D, texture.handle);
    this.set('1i', name, this.unit++);
  }

  setGrid(prefix, grid)
  {
    this.set('2i', `${prefix}First`, ...grid.first);
    this.set('2f', `${prefix}Stride`, ...grid.stride);
    this.set('2i', `${prefix}Size`, ...grid.size);
  }

  setSurface(grid)
  {
    const { field } = this;
    this.setTexture('reliefHeights', this.heights);
    this.setTexture('reliefBlocks', this.bounds);
    this.set('2i', 'reliefSize', field.columns, field.rows);
    this.set('2f', 'reliefSpacing', ...field.spacing);
    this.set('1f', 'reliefHighest', field.top);
    this.set('1i', 'reliefLevelCount', field.bounds.x.length);
    if (field.bounds.x.length > 0)
    {
      this.set('1iv', 'reliefLevelX', field.bounds.x);
      this.set('1iv', 'reliefLevelY', field.bounds.y);
    }
    this.setGrid('grid', grid);
  }

  setLight(scene, light)
  {
    const { medium } = scene;
    this.set('1f', 'mediumDepth', singleDepth(medium));
    this.set('1f', 'mediumDensity', medium.density);
    this.set('1f', 'mediumFloor', medium.floorHeight);
    this.set('1f', 'mediumTolerance', Math.fround(medium.tolerance) * Math.fround(light.toleranceScale));
    const vector = light.traced.slice();
    if (light.positional)
    {
      // Farther away than this, a sample more or less does not show.
      const farthest = 1e9;
      const cell = [0, 1].map((axis) =>
        Math.min(Math.max(Math.floor(vector[axis] / this.field.spacing[axis]), -farthest), farthest));
      cell.forEach((c, axis) => { vector[axis] -= c * this.field.spacing[axis]; });
      this.set('2i', 'lightSample', ...cell);
    }
    this.set('3f', 'lightVector', ...vector);
  }

  //----------------------------------------------------------------------------
  // Drawing

  // Draws rows of targets of one size by the current program, in place of what they hold or in addition to it.
  draw(targets, begin, end, add = false)
  {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
    for (let k = 0; k < SUMS.length; ++k)
    {
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + k, gl.TEXTURE_2D,
        targets[k] ? targets[k].handle : null, 0);
    }
    gl.drawBuffers(targets.map((_, k) => gl.COLOR_ATTACHMENT0 + k));
    if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE && !gl.isContextLost())
    {
      throw new ReliefError(`the graphics processor cannot draw into ${targets.length} textures of ` +
        `${targets[0].width} x ${targets[0].height} floats: use a smaller picture`);
    }
    this.drawInto(targets[0].width, targets[0].height, begin, end, add);
  }

  drawInto(width, height, begin, end, add)
  {
    const { gl } = this;
    gl.disable(gl.DEPTH_TEST);
    gl.disable(gl.CULL_FACE);
    gl.viewport(0, 0, width, height);
    gl.enable(gl.SCISSOR_TEST);
    if (add)
    {
      gl.enable(gl.BLEND);
      gl.blendFunc(gl.ONE, gl.ONE);
    }
    else
    {
      gl.disable(gl.BLEND);
    }
    // In bands: where the processor draws, a large picture would take longer than a browser likes.
    const band = Math.max(Math.floor(MOST_DRAWN / width), 1);
    for (let row = begin; row < end; row += band)
    {
      gl.scissor(0, row, width, Math.min(band, end - row));
      gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
  }

  // Waits until all has been drawn. Browsers finish a read sooner than they take finish() seriously.
  finish()
  {
    const { gl } = this;
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
    gl.readBuffer(gl.COLOR_ATTACHMENT0);
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.FLOAT, this.pixel);
  }

  // What the framebuffer's first texture holds.
  read(texture)
  {
    const { gl } = this;
    const values = new Float32Array(4 * texture.width * texture.height);
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture.handle, 0);
    for (let k = 1; k < SUMS.length; ++k)
    {
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + k, gl.TEXTURE_2D, null, 0);
    }
    gl.readBuffer(gl.COLOR_ATTACHMENT0);
    gl.pixelStorei(gl.PACK_ALIGNMENT, 4);
    gl.readPixels(0, 0, texture.width, texture.height, gl.RGBA, gl.FLOAT, values);
    return values;
  }

  //----------------------------------------------------------------------------
  // Whether the processor knows infinity and what is no number: the model is built on both, and some
  // compilers take them for impossible.

  checkNumbers()
  {
    const given = this.texture(4, 1, 1);
    this.load(given, Float32Array.of(NaN, Infinity, 1, 0));
    const result = this.texture(1, 1, 4);
    for (this.nanByBits of this.tests)
    {
      this.use({ key: `probe${this.nanByBits}`, text: probeText });
      this.setTexture('given', given);
      this.draw([result], 0, 1);
      if (this.read(result)[0] === 1)
      {
        this.release(given);
        this.release(result);
        return;
      }
    }
    if (!this.gl.isContextLost())
    {
      throw new ReliefError('the graphics processor does not know infinity, or what is no number: use another ' +
        'browser or device, or shade on the processor');
    }
  }

  //----------------------------------------------------------------------------
  // The passes

  // Begins what a scene of these lights is going to be shaded with, first what the first picture needs, which is
  // coarse where time is short.
  prepare(scene, first, rest, textures, coarse)
  {
    const { sums } = scene;
    const traced = [...first, ...rest].filter((light) => light.matte);
    if (coarse)
    {
      first.filter((light) => light.matte).forEach((light) => this.start(traceProgram(scene, light, true)));
    }
    const any = sums.diffuse || sums.scatter || sums.specular;
    for (const lights of any ? [first, rest].filter((list) => list.length > 0) : [])
    {
      const alike = !(sums.scatter || sums.specular) || lights.every((light) => light.directional);
      this.start(gatherProgram(scene, lights[0], sums, alike ? Math.min(lights.length, MOST_GATHERED) : 1));
    }
    this.start(composeProgram(any && first.length > 0, any && rest.length > 0, sums, textures));
    this.start(DISPLAY);
    traced.forEach((light) => this.start(traceProgram(scene, light, false)));
  }

  // Traces a light for the rows [begin, end) of a layer of one float, or quickly: level beyond the data.
  trace(scene, light, layer, begin, end, quick)
  {
    this.use(traceProgram(scene, light, quick));
    this.setSurface(layer.grid);
    this.setLight(scene, light);
    this.set('1i', 'lightSteps', scene.steps);
    this.draw([layer.texture], begin, end);
  }

  clear(sums)
  {
    const { gl } = this;
    for (const texture of sums.textures.filter(Boolean))
    {
      gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture.handle, 0);
      for (let k = 1; k < SUMS.length; ++k)
      {
        gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + k, gl.TEXTURE_2D, null, 0);
      }
      gl.drawBuffers([gl.COLOR_ATTACHMENT0]);
      gl.disable(gl.SCISSOR_TEST);
      gl.clearBufferfv(gl.COLOR, 0, [0, 0, 0, 0]);
    }
  }

  // Adds lights to sums, or begins new ones with them, in as few passes as can be. Each light has a plan and,
  // where a sum needs it, the layer of its illumination.
  gather(scene, lights, sums, add)
  {
    const wanted = sums.features;
    const together = (a, b) =>
      (!(wanted.scatter || wanted.specular) || (a.light.directional && b.light.directional)) &&
      (!(wanted.diffuse || wanted.scatter) || a.layer.grid.equals(b.layer.grid));
    for (let begin = 0, end = 1; begin < lights.length; begin = end, ++end)
    {
      while (end < lights.length && end - begin < MOST_GATHERED && together(lights[begin], lights[end]))
      {
        ++end;
      }
      const more = add || begin > 0;
      const apart = more && !this.blends;
      const into = apart ? this.sumsLike(sums) : sums;
      this.gatherTogether(scene, lights.slice(begin, end), into, more && this.blends);
      if (apart)
      {
        this.addTo(sums, into);
      }
    }
  }

  sumsLike(sums)
  {
    return {
      ...sums,
      textures: sums.textures.map((t) => (t ? this.texture(t.width, t.height, 4) : null)),
    };
  }

  // For processors that do not blend floats.
  addTo(sums, others)
  {
    others.textures.forEach((other, k) =>
    {
      if (other)
      {
        const sum = this.texture(other.width, other.height, 4);
        this.use(SUM);
        this.setTexture('first', sums.textures[k]);
        this.setTexture('second', other);
        this.draw([sum], 0, sum.height);
        this.release(other);
        this.release(sums.textures[k]);
        sums.textures[k] = sum;
      }
    });
  }

  gatherTogether(scene, lights, sums, add)
  {
    const wanted = sums.features;
    const first = lights[0].light;
    const program = gatherProgram(scene, first, wanted, lights.length);
    this.use(program);
    this.setSurface(sums.grid);
    if (program.positional)
    {
      this.setLight(scene, first);
    }
    if (wanted.diffuse || wanted.scatter)
    {
      lights.forEach(({ layer }, k) => this.setTexture(`illumination${k}`, layer.texture));
      this.setGrid('illumination', lights[0].layer.grid);
    }
    this.set('3fv', 'lightRadiance', lights.flatMap(({ light }) => light.radiance));
    this.set('3fv', 'lightToward', lights.flatMap(({ light }) => light.vector));
    this.set('3f', 'scatterFalloff', ...scene.scatterFalloff);
    this.set('3f', 'specularFalloff', ...scene.specularFalloff);
    this.draw(sums.textures.filter(Boolean), 0, sums.grid.size[1], add);
  }

  // Makes colours of sums, of which either may be null, and of the material's colours or of textures.
  compose(scene, first, later, laterScale, sums, colorTextures, colors)
  {
    const program = composeProgram(Boolean(first), Boolean(later), sums, colorTextures);
    const { compose } = program;
    this.use(program);
    this.setSurface(colors.grid);
    this.set('2f', 'coefficients', scene.specularCoefficient, scene.scatterCoefficient);
    for (const name of ['base', 'diffuse', 'specular'])
    {
      this.set('3f', `${name}Color`, ...scene[name]);
      if (compose[`${name}Texture`])
      {
        this.setTexture(`${name}Colors`, colorTextures[name]);
      }
    }
    for (const [set, layers] of [['first', first], ['later', later]])
    {
      SUMS.forEach((name, k) =>
      {
        if (layers && layers.textures[k] && sums[name])
        {
          this.setTexture(`${set}${name[0].toUpperCase()}${name.slice(1)}`, layers.textures[k]);
        }
      });
    }
    if (later)
    {
      this.set('3f', 'laterScale', ...laterScale);
      this.setGrid('later', later.grid);
    }
    this.draw([colors.texture], 0, colors.grid.size[1]);
  }

  // Draws a picture of colours: into a texture of four floats, or onto the canvas.
  show(colors, place, { target = null, encoded = true, exposure = 1, background = [0, 0, 0, 0] })
  {
    const { gl } = this;
    this.use(DISPLAY);
    this.setTexture('colors', colors.texture);
    this.setGrid('grid', colors.grid);
    this.set('2f', 'viewOrigin', ...place.origin);
    this.set('2f', 'viewStep', ...place.step);
    this.set('2f', 'fieldSize', this.field.columns, this.field.rows);
    this.set('1f', 'exposure', exposure);
    this.set('1i', 'encoded', encoded ? 1 : 0);
    this.set('4f', 'background', ...background);
    if (target)
    {
      this.draw([target], 0, target.height);
      return;
    }
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    this.drawInto(place.width, place.height, 0, place.height, false);
  }

  dispose()
  {
    const { gl } = this;
    this.release(this.heights);
    this.release(this.bounds);
    this.programs.forEach(({ handle }) => gl.deleteProgram(handle));
    this.pool.forEach(({ handle }) => gl.deleteTexture(handle));
    gl.deleteFramebuffer(this.framebuffer);
    this.programs.clear();
    this.pool = [];
    this.pooled = 0;
  }
}

function sizeOf(texture)
{
  return 4 * texture.components * texture.width * texture.height;
}
