// SPDX-License-Identifier: BSD-3-Clause
//
// What the tests do in the page. A test returns what is wrong, as texts, or what the runner then judges.

import { Passes } from '/modules/passes.js';
import { probeText } from '/modules/programs.js';
import { ReliefError, ReliefRenderer } from '/modules/relief-gl.js';
import { planScene, sceneFromJSON } from '/package/index.js';

const TYPES = { float32: Float32Array, uint8: Uint8Array };
const SUN = { kind: 'sun', azimuth: 315, altitude: 35 };

// Notes what is not as it should be.
class Checks
{
  constructor()
  {
    this.wrong = [];
  }

  that(holds, text)
  {
    if (!holds)
    {
      this.wrong.push(text);
    }
  }

  equal(got, expected, text)
  {
    this.that(Object.is(got, expected), `${text}: ${got}, ${expected} is expected`);
  }

  // Whether a ReliefError comes that says this.
  throws(body, says, text)
  {
    try
    {
      body();
    }
    catch (error)
    {
      this.that(error instanceof ReliefError && says.test(error.message) && error.message.length <= 240,
        `${text}: ${error.name}: ${error.message}`);
      return;
    }
    this.that(false, `${text}: nothing is thrown`);
  }
}

function hills(width, height = width, scale = 10)
{
  const values = new Float32Array(width * height);
  for (let j = 0; j < height; ++j)
  {
    for (let i = 0; i < width; ++i)
    {
      values[j * width + i] = scale * (Math.sin(i / 7 + Math.cos(j / 9)) + 0.5 * Math.sin(i / 3.1 - j / 4.3));
    }
  }
  return values;
}

function newRenderer(width, height = width, options = {})
{
  return new ReliefRenderer(new OffscreenCanvas(width, height), options);
}

// A scene as a file has it, beside it textures.
function optionsOf({ textures = {}, ...file })
{
  const options = sceneFromJSON(JSON.stringify({ reliefScene: 1, ...file }));
  for (const [name, texture] of Object.entries(textures))
  {
    options[`${name}Texture`] = texture;
  }
  return options;
}

async function setScene(renderer, scene)
{
  renderer.setScene(await planScene(optionsOf(scene), renderer.bounds));
}

const witnesses = new Map();

// The colours of a scene for which nothing is kept: of heights that are set anew all is. One renderer for all, as
// programs take long to compile.
async function afresh(heights, layout, scene, request, options = {})
{
  const kind = JSON.stringify(options);
  if (!witnesses.has(kind))
  {
    witnesses.set(kind, newRenderer(1, 1, options));
  }
  const renderer = witnesses.get(kind);
  renderer.canvas.width = layout.width;
  renderer.canvas.height = layout.height;
  renderer.setHeights(heights, layout);
  await setScene(renderer, scene);
  renderer.render(request);
  return renderer.readColors().data;
}

function farthest(a, b)
{
  return a.length === b.length
    ? a.reduce((most, v, k) => (Math.abs(v - b[k]) <= most ? most : Math.abs(v - b[k])), 0) : Infinity;
}

//--------------------------------------------------------------------------------------------------

async function load(file)
{
  const data = await (await fetch(`/data/${file.file}`)).arrayBuffer();
  return new TYPES[file.type](data);
}

async function loadCase(one)
{
  const textures = {};
  for (const [name, file] of Object.entries(one.textures))
  {
    textures[name] = { width: file.width, height: file.height, data: await load(file) };
  }
  return {
    ...one, values: await load(one.heights), expected: await load(one.colors), scene: { ...one.scene, textures },
  };
}

// With rows from south to north.
function flipped(values, height)
{
  const result = new values.constructor(values.length);
  const row = values.length / height;
  for (let j = 0; j < height; ++j)
  {
    result.set(values.subarray(j * row, (j + 1) * row), (height - 1 - j) * row);
  }
  return result;
}

function compare(got, expected)
{
  const found = { samples: expected.length / 4, wrong: 0, worst: 0, alpha: 0 };
  for (let k = 0; k < expected.length; k += 4)
  {
    let difference = 0;
    for (let c = 0; c < 3; ++c)
    {
      const d = Math.abs(got[k + c] - expected[k + c]);
      difference = Number.isNaN(d) ? Infinity : Math.max(difference, d);
    }
    found.alpha += got[k + 3] !== expected[k + 3] ? 1 : 0;
    found.wrong += difference > 2e-3 ? 1 : 0;
    found.worst = Math.max(found.worst, difference);
  }
  return found;
}

// All scenes by one renderer, one after the other, so that what is kept of one must not spoil the next; every
// second one with its rows from the south.
export async function agreement()
{
  const cases = await (await fetch('/data/scenes.json')).json();
  const canvas = new OffscreenCanvas(1, 1);
  const renderer = new ReliefRenderer(canvas);
  const results = [];
  for (const [number, given] of cases.entries())
  {
    const one = await loadCase(given);
    const { width, height } = one.heights;
    // A sample has a pixel at least.
    const [sx, sy] = one.spacing;
    canvas.width = Math.ceil(width * Math.max(sx / sy, 1));
    canvas.height = Math.ceil(height * Math.max(sy / sx, 1));
    const south = number % 2 === 1;
    const scene = { ...one.scene, textures: { ...one.scene.textures } };
    for (const [name, texture] of Object.entries(scene.textures))
    {
      scene.textures[name] = south ? { ...texture, data: flipped(texture.data, texture.height) } : texture;
    }
    renderer.setHeights(south ? flipped(one.values, height) : one.values,
      { width, height, spacing: one.spacing, rows: south ? 'south-first' : 'north-first' });
    await setScene(renderer, scene);
    const state = renderer.render();
    const colors = renderer.readColors();
    const found = { name: one.name, ...state, ...compare(colors.data, one.expected) };
    if (canvas.width === width && canvas.height === height)
    {
      // Where pixels are samples, the picture is the colours.
      found.picture = compare(renderer.readLinear().data, colors.data);
    }
    results.push(found);
  }
  renderer.dispose();
  return results;
}

//--------------------------------------------------------------------------------------------------

// Infinity and what is no number, as programs see them.
export async function numbers()
{
  const checks = new Checks();
  const gl = new OffscreenCanvas(1, 1).getContext('webgl2');
  for (const nanByBits of [false, true])
  {
    const passes = new Passes(gl, { nanByBits });
    const given = passes.texture(4, 1, 1);
    const result = passes.texture(1, 1, 4);
    passes.load(given, Float32Array.of(NaN, Infinity, 1, 0));
    passes.use({ key: 'again', text: probeText });
    passes.setTexture('given', given);
    passes.draw([result], 0, 1);
    const [all, constants, textures, computed] = passes.read(result);
    checks.equal(constants, 1, `constants, by bits: ${nanByBits}`);
    checks.equal(textures, 1, `textures, by bits: ${nanByBits}`);
    checks.equal(computed, 1, `computed, by bits: ${nanByBits}`);
    checks.equal(all, 1, `all, by bits: ${nanByBits}`);
    passes.dispose();
  }

  // Holes of all kinds: nothing is shown there, and no number goes astray elsewhere.
  const layout = { width: 40, height: 30 };
  const heights = hills(40, 30);
  for (const [k, value] of [[0, NaN], [45, Infinity], [90, -Infinity], [333, NaN], [334, NaN], [1199, NaN]])
  {
    heights[k] = value;
  }
  for (let k = 600; k < 610; ++k)
  {
    heights[k] = NaN;
  }
  const scene = { lights: [SUN, { kind: 'point', position: [10, 10, 30] }],
    material: { subsurfaceDepth: 3, specularCoefficient: 0.3, forwardScatterCoefficient: 0.2 } };
  const plain = await afresh(heights, layout, scene);
  const byBits = await afresh(heights, layout, scene, {}, { nanByBits: true });
  checks.equal(farthest(plain, byBits), 0, 'the same by bits');
  heights.forEach((h, k) =>
  {
    checks.equal(plain[4 * k + 3], Number.isFinite(h) ? 1 : 0, `alpha of sample ${k}`);
    checks.that(plain.slice(4 * k, 4 * k + 4).every(Number.isFinite), `sample ${k} is no number`);
  });
  const fields = [
    ['all holes', new Float32Array(12).fill(NaN), 4, 3], ['one sample', Float32Array.of(5), 1, 1],
    ['two', Float32Array.of(1, 2), 2, 1], ['a column', Float32Array.of(1, 2, 9, 4), 1, 4],
    ['level', new Float32Array(64), 8, 8], ['huge', Float32Array.of(1e37, -1e37, 0, 1e37), 2, 2],
    ['tiny', Float32Array.of(1e-40, 0, 0, -1e-42), 2, 2],
  ];
  for (const [name, values, width, height] of fields)
  {
    const colors = await afresh(values, { width, height }, scene);
    checks.that(colors.every(Number.isFinite), `${name}: ${colors.slice(0, 8)}`);
  }
  return checks.wrong;
}

//--------------------------------------------------------------------------------------------------

// Waits for an event, and until its listeners are through.
const happens = async (body) =>
{
  await new Promise((done) => { body(done); });
  await new Promise((done) => { setTimeout(done, 50); });
};

// The context is lost and comes back with the same picture.
export async function context()
{
  const checks = new Checks();
  for (const canvas of [document.getElementById('canvas'), new OffscreenCanvas(1, 1)])
  {
    canvas.width = 64;
    canvas.height = 48;
    let restored = () => {};
    let lost = () => {};
    const renderer = new ReliefRenderer(canvas, { onLost: () => lost(), onRestored: () => restored() });
    renderer.setHeights(hills(64, 48), { width: 64, height: 48 });
    await setScene(renderer, { lights: [SUN], material: { specularCoefficient: 0.2, diffuseColor: [0.9, 0.7, 0.4] },
      textures: { base: { width: 2, height: 1, data: new Uint8Array([255, 0, 0, 255, 0, 0, 255, 128]) } } });
    renderer.render({ zoom: 1.5, centerX: 0.4 });
    const before = renderer.readPixels();
    const extension = renderer.gl.getExtension('WEBGL_lose_context');
    await happens((done) => { lost = done; extension.loseContext(); });
    const state = renderer.render({ zoom: 1.5, centerX: 0.4 });
    checks.that(state.lost && !state.converged, 'what is lost is said to be there');
    checks.throws(() => renderer.readPixels(), /no picture/, 'reading what is lost');
    await happens((done) => { restored = done; extension.restoreContext(); });
    const after = renderer.readPixels();
    checks.that(before.data.some((v) => v > 0), 'there is a picture');
    checks.that(before.data.every((v, k) => v === after.data[k]), 'the picture is another one');
    checks.equal(renderer.gl.getError(), 0, 'error of WebGL');
    renderer.dispose();
  }
  return checks.wrong;
}

//--------------------------------------------------------------------------------------------------

// What a change makes anew, and that it shows.
export async function keptWork()
{
  const checks = new Checks();
  const layout = { width: 60, height: 50 };
  const heights = hills(60, 50);
  const renderer = newRenderer(60, 50);
  renderer.setHeights(heights, layout);
  let scene = {
    lights: [SUN, { kind: 'sun', azimuth: 90, altitude: 50, intensity: 0.4 }],
    environment: { image: 'clearSky', azimuth: 120, altitude: 40, numberOfSamples: 16, intensity: 0.3 },
    material: {},
  };
  const step = async (name, change, traced, request = {}) =>
  {
    scene = { ...scene, ...change };
    await setScene(renderer, scene);
    const state = renderer.render(request);
    checks.equal(state.lightsTraced, traced, `${name}: lights traced`);
    checks.that(state.converged, `${name}: has not converged`);
    const difference = farthest(renderer.readColors().data, await afresh(heights, layout, scene, request));
    checks.that(difference < 1e-5, `${name}: differs from a new picture by ${difference}`);
  };
  const material = (more) => ({ material: { ...scene.material, ...more } });
  await step('first', {}, 10);
  await step('again', {}, 0);
  await step('colours', material({ diffuseColor: [0.8, 0.5, 0.3], baseColor: [0, 0.1, 0] }), 0);
  await step('coefficients', material({ specularCoefficient: 0.3, forwardScatterCoefficient: 0.4 }), 0);
  await step('falloffs', material({ specularPower: 4, forwardScatterRange: [-0.5, 0.5] }), 0);
  await step('exposure', { exposure: 1 }, 0);
  await step('intensity', { lights: [{ ...SUN, intensity: 0.7, color: [1, 0.5, 0.2] }, scene.lights[1]] }, 0);
  await step('a sun', { lights: [{ ...SUN, azimuth: 300 }, scene.lights[1]] }, 1);
  const environment = (more) => ({ environment: { ...scene.environment, ...more } });
  await step('the environment, brighter', environment({ intensity: 0.6 }), 0);
  // Its lights stay where they are; only their colours are others.
  await step('the environment, turned', environment({ rotationZ: 50 }), 0);
  await step('it comes nearer', environment({ radius: 200 }), 8);
  await step('and leaves', environment({ radius: 'infinite' }), 8);
  await step('a light fewer', { lights: [scene.lights[0]] }, 0);
  await step('a texture', { textures: { diffuse: { width: 1, height: 2, data: Float32Array.of(1, 0.5) } } }, 0);
  await step('another', { textures: { diffuse: { width: 1, height: 2, data: Float32Array.of(0.2, 0.5) } } }, 0);
  await step('depth', material({ subsurfaceDepth: 2 }), 9);
  await step('height scale', { heightScale: 0.5 }, 9);
  await step('response', { response: 'Combined' }, 9);
  await step('what exact does not look at', { numberOfSteps: 99 }, 0);
  // Lights that show no more are forgotten.
  await step('no diffuse colour', { ...material({ diffuseColor: [0, 0, 0] }), textures: {} }, 0);
  renderer.dispose();
  return checks.wrong;
}

//--------------------------------------------------------------------------------------------------

// One message for each thing that can be wrong, and what was there before stays.
export async function errors()
{
  const checks = new Checks();
  checks.throws(() => new ReliefRenderer(null), /gives no WebGL 2/, 'no canvas');
  const taken = new OffscreenCanvas(4, 4);
  taken.getContext('2d');
  checks.throws(() => new ReliefRenderer(taken), /gives no WebGL 2/, 'a canvas with another context');
  const { prototype } = WebGL2RenderingContext;
  const replaced = (name, replacement, body) =>
  {
    const original = prototype[name];
    prototype[name] = replacement(original);
    try
    {
      body();
    }
    finally
    {
      prototype[name] = original;
    }
  };
  replaced('getExtension', () => () => null,
    () => checks.throws(() => newRenderer(4), /EXT_color_buffer_float/, 'no floats'));
  replaced('shaderSource', (original) => function broken(shader, text)
  {
    original.call(this, shader, text.replace('void main()', 'void main('));
  }, () => checks.throws(() => newRenderer(4), /was refused/, 'a program'));

  const renderer = newRenderer(16);
  checks.throws(() => renderer.render(), /setHeights/, 'no heights');
  checks.throws(() => renderer.bounds, /setHeights/, 'bounds of no heights');
  checks.throws(() => renderer.readPixels(), /no picture/, 'no picture');
  checks.throws(() => renderer.setHeights([1, 2], { width: 2, height: 1 }), /no array of numbers/, 'a plain array');
  checks.throws(() => renderer.setHeights(new Float32Array(5), { width: 2, height: 2 }), /5 heights/, 'too many');
  checks.throws(() => renderer.setHeights(new Float32Array(5), { width: 2.5, height: 2 }), /size/, 'half a sample');
  checks.throws(() => renderer.setHeights(new Float32Array(4), { width: 2, height: 2, spacing: 0 }), /spacing/,
    'no spacing');
  checks.throws(() => renderer.setHeights(new Float32Array(4), { width: 2, height: 2, rows: 'up' }), /rows/, 'rows');
  renderer.setHeights(new Float32Array(4), { width: 2, height: 2 });
  checks.throws(() => renderer.render(), /setScene/, 'no scene');
  checks.throws(() => renderer.setScene({ lights: [SUN] }), /planScene/, 'a scene that was not planned');
  const long = renderer.gl.getParameter(renderer.gl.MAX_TEXTURE_SIZE) + 1;
  renderer.setHeights(new Float32Array(long), { width: long, height: 1 });
  await setScene(renderer, {});
  checks.throws(() => renderer.render(), /MAX_TEXTURE_SIZE/, 'too large');

  // What is wrong with a scene is told by the package, before anything is changed.
  renderer.setHeights(Float32Array.of(3e38, -3e38, 0, 0), { width: 2, height: 2 });
  const scenes = [
    [{}, /reach from/, 'too much relief'], [{ tolerance: -1 }, /tolerance/, 'no tolerance'],
    [{ heightScale: 'auto' }, /fitHeightScale/, 'an automatic scale'],
    [{ baseTexture: { width: 2, height: 2, data: new Uint8Array(3) } }, /baseTexture/, 'no picture'],
  ];
  for (const [options, says, text] of scenes)
  {
    const error = await planScene(options, renderer.bounds).catch((e) => e);
    checks.that(error instanceof Error && says.test(error.message), `${text}: ${error.message}`);
  }
  renderer.setHeights(hills(16), { width: 16, height: 16 });
  await setScene(renderer, { lights: [SUN] });
  renderer.render();
  const before = renderer.readPixels();
  checks.throws(() => renderer.render({ zoom: 0 }), /zoom/, 'no zoom');
  checks.throws(() => renderer.render({ seconds: -1 }), /seconds/, 'no time');
  renderer.render();
  checks.that(renderer.readPixels().data.every((v, k) => v === before.data[k]), 'the scene was spoilt');
  checks.equal(renderer.gl.getError(), 0, 'error of WebGL');
  renderer.dispose();
  renderer.dispose();
  checks.throws(() => renderer.render(), /disposed/, 'after dispose');
  return checks.wrong;
}

//--------------------------------------------------------------------------------------------------

// Coarse pictures come first, and end where a picture that takes its time is at once.
export async function progress()
{
  const checks = new Checks();
  const layout = { width: 160, height: 140 };
  const heights = hills(160, 140);
  const scene = {
    lights: [SUN, { kind: 'point', position: [80, 70, 40], intensity: 0.3 }],
    environment: { image: 'whiteDome', numberOfSamples: 28, intensity: 0.4 },
    material: { subsurfaceDepth: 2, forwardScatterCoefficient: 0.3, specularCoefficient: 0.2 },
  };
  const whole = await afresh(heights, layout, scene);
  const blended = await afresh(heights, layout, scene, {}, { floatBlend: false });
  checks.that(farthest(whole, blended) < 1e-6, 'without blending floats the sums differ');

  const renderer = newRenderer(160, 140);
  renderer.setHeights(heights, layout);
  await setScene(renderer, scene);
  const mean = (data) => data.reduce((sum, v) => sum + v, 0) / data.length;
  const first = renderer.render({ seconds: 0.001 });
  checks.that(!first.converged && first.detail < 1 && first.progress < 1, 'the first picture is all');
  checks.that(Math.abs(mean(renderer.readLinear().data) - mean(whole)) < 0.05, 'the first picture is too dark');
  let last = first;
  let before = first.progress;
  let frames = 1;
  for (; !last.converged && frames < 2000; ++frames)
  {
    last = renderer.render({ seconds: 0.001 });
    checks.that(last.progress >= before - 1e-9, `progress goes back from ${before} to ${last.progress}`);
    before = last.progress;
  }
  checks.that(last.converged && last.detail === 1, `has not converged after ${frames} pictures`);
  checks.that(frames > 3, 'took no time');
  const difference = farthest(renderer.readColors().data, whole);
  checks.that(difference < 1e-5, `differs from a picture made at once by ${difference}`);

  // While a light is dragged one picture follows another.
  for (let k = 1; k < 5; ++k)
  {
    await setScene(renderer, { ...scene, lights: [{ ...SUN, azimuth: 315 + k }, scene.lights[1]] });
    const state = renderer.render({ seconds: 0.001, moving: true });
    checks.that(state.lightsTraced <= 1 && state.detail < 1, `${state.lightsTraced} lights for a moving one`);
  }
  const finished = renderer.render();
  checks.that(finished.converged && finished.lightsTraced === 1, 'what was dragged is not finished');

  // Coarser if asked for, and no finer light is forgotten for it.
  const coarse = renderer.render({ detail: 0.25 });
  checks.that(!coarse.converged && coarse.detail <= 0.3 && coarse.lightsTraced === 0, 'a coarse picture');
  checks.equal(renderer.render().lightsTraced, 0, 'back from a coarse picture: lights traced');

  // Views: beside the field there is nothing, and far away neither.
  checks.equal(renderer.render({ zoom: 0.5 }).lightsTraced, 0, 'zooming out: lights traced');
  const small = renderer.readPixels();
  checks.equal(small.data[3], 0, 'alpha beside the field');
  checks.equal(small.data[4 * (70 * 160 + 80) + 3], 255, 'alpha in the middle');
  checks.that(renderer.render({ centerX: 9 }).converged, 'nothing to see');
  const near = renderer.render({ zoom: 8, centerX: 0.1, centerY: 0.2 });
  checks.that(near.converged && near.lightsTraced === 0, `zooming in: ${near.lightsTraced} lights traced`);
  // Its middle is the sample there.
  const at = renderer.readLinear().data.slice(4 * (70 * 160 + 80));
  const sample = whole.slice(4 * (28 * 160 + 16));
  checks.that(at.length > 0 && sample.length > 0 && Math.abs(at[0] - sample[0]) < 0.2, 'zoomed elsewhere');
  // As bright as can be.
  await setScene(renderer, { ...scene, automaticExposure: true });
  renderer.render();
  const bright = () => Math.max(...renderer.readPixels().data.filter((_, k) => k % 4 !== 3));
  checks.that(bright() >= 254, `automatic exposure ends at ${bright()}`);
  // Unless somebody knows better.
  renderer.setExposure(-3);
  renderer.render();
  checks.that(bright() < 150, `an exposure that was set gives ${bright()}`);
  checks.equal(renderer.gl.getError(), 0, 'error of WebGL');
  renderer.dispose();
  return checks.wrong;
}
