// SPDX-License-Identifier: BSD-3-Clause
//
// What the tests do in the page. Each returns what the runner then judges.

import { ReliefError, ReliefRenderer } from '/modules/relief-gl.js';

const TYPES = { float32: Float32Array, uint8: Uint8Array };

async function load(file)
{
  const data = await (await fetch(`/data/${file.file}`)).arrayBuffer();
  return new TYPES[file.type](data);
}

export async function loadCase(one)
{
  const textures = {};
  for (const [name, file] of Object.entries(one.textures))
  {
    textures[name] = { width: file.width, height: file.height, data: await load(file) };
  }
  return {
    ...one, values: await load(one.heights), expected: await load(one.colors),
    scene: { ...one.scene, textures },
  };
}

// Every second case has its rows from south to north.
function flipped(values, width, height)
{
  const result = new values.constructor(values.length);
  const row = values.length / height;
  for (let j = 0; j < height; ++j)
  {
    result.set(values.subarray(j * row, (j + 1) * row), (height - 1 - j) * row);
  }
  return result;
}

export function newRenderer(width, height, options)
{
  return new ReliefRenderer(new OffscreenCanvas(width, height), options);
}

function compare(got, expected)
{
  let wrong = 0;
  let worst = 0;
  let alpha = 0;
  for (let k = 0; k < expected.length; k += 4)
  {
    let difference = 0;
    for (let c = 0; c < 3; ++c)
    {
      const d = Math.abs(got[k + c] - expected[k + c]);
      difference = Number.isNaN(d) ? Infinity : Math.max(difference, d);
    }
    alpha += got[k + 3] !== expected[k + 3] ? 1 : 0;
    wrong += difference > 2e-3 ? 1 : 0;
    worst = Math.max(worst, difference);
  }
  return { samples: expected.length / 4, wrong, worst, alpha };
}

// All scenes by one renderer, one after the other, so that what is kept of one must not spoil the next.
export async function agree(options)
{
  const cases = await (await fetch('/data/scenes.json')).json();
  const canvas = new OffscreenCanvas(1, 1);
  const renderer = new ReliefRenderer(canvas, options);
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
    const turn = (values) => (south ? flipped(values, width, height) : values);
    const scene = { ...one.scene, textures: { ...one.scene.textures } };
    for (const [name, texture] of Object.entries(scene.textures))
    {
      scene.textures[name] = south
        ? { ...texture, data: flipped(texture.data, texture.width, texture.height) } : texture;
    }
    renderer.setHeights(turn(one.values),
      { width, height, spacing: one.spacing, rows: south ? 'south-first' : 'north-first' });
    renderer.setScene(scene);
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

// What the constants and numbers without a value are to a program, each alone.
export function probe(options)
{
  const renderer = newRenderer(4, 4, options);
  const byBits = renderer.passes.nanByBits;
  renderer.dispose();
  return { byBits };
}
