// SPDX-License-Identifier: BSD-3-Clause
//
// Files that tests open in the page.

import { COLUMNS, encode, ROWS } from './harness.mjs';

export function hills(most)
{
  return Uint16Array.from({ length: COLUMNS * ROWS }, (_, k) =>
  {
    const [i, j] = [k % COLUMNS, Math.floor(k / COLUMNS)];
    return most * (0.5 + 0.3 * Math.sin(i / 9 + Math.cos(j / 13)) + 0.2 * Math.sin(i / 5 - j / 7));
  });
}

export const png = (data, channels, depth) => Buffer.from(encode({ data, width: COLUMNS, height: ROWS, channels, depth }));
export const heights16 = png(hills(60000), 1, 16);
export const heights8 = png(Uint8Array.from(hills(250)), 1, 8);
export const stripes = png(Uint8Array.from({ length: 3 * COLUMNS * ROWS }, (_, k) => (k % 3 === 0 || k % 90 < 45 ? 255 : 30)), 3, 8);
export const half = png(Uint8Array.from({ length: COLUMNS * ROWS }, (_, k) => (k % COLUMNS < COLUMNS / 2 ? 255 : 0)), 1, 8);

// A TIFF of one strip of floats, little-endian, 2 units a sample; more of its tags, and others of its place, as
// [tag, type, values].
export function floatTiff({ data = Float32Array.from(hills(60), (h) => h / 2), columns = COLUMNS, samples = 1, northing = 5000,
  place = [[33550, 12, [2, 2, 0]], [33922, 12, [0, 0, 0, 1000, northing, 0]]], more = [] } = {})
{
  const [short, long, double] = [3, 4, 12];
  const rows = data.length / samples / columns;
  const tags = [[256, short, [columns]], [257, short, [rows]], [258, short, Array(samples).fill(32)], [259, short, [1]],
    [262, short, [1]], [273, long, [0]], [277, short, [samples]], [278, short, [rows]], [279, long, [data.byteLength]],
    [339, short, Array(samples).fill(3)], ...place, ...more]
    .sort((a, b) => a[0] - b[0]);
  const arrays = { 2: Uint8Array, [short]: Uint16Array, [long]: Uint32Array, [double]: Float64Array };
  const bytesOf = ([, type, content]) => Buffer.from(arrays[type].from(content).buffer);
  const room = (bytes) => (bytes.length > 4 ? 8 * Math.ceil(bytes.length / 8) : 0);
  let at = 8 + 2 + 12 * tags.length + 4;
  const begin = at + tags.reduce((sum, tag) => sum + room(bytesOf(tag)), 0);
  tags.find(([tag]) => tag === 273)[2] = [begin];
  const head = Buffer.alloc(begin);
  head.write('II', 0);
  head.writeUInt16LE(42, 2);
  head.writeUInt32LE(8, 4);
  head.writeUInt16LE(tags.length, 8);
  tags.forEach(([tag, type, content], k) =>
  {
    const bytes = bytesOf([tag, type, content]);
    const entry = 10 + 12 * k;
    head.writeUInt16LE(tag, entry);
    head.writeUInt16LE(type, entry + 2);
    head.writeUInt32LE(content.length, entry + 4);
    if (bytes.length > 4)
    {
      head.writeUInt32LE(at, entry + 8);
      bytes.copy(head, at);
      at += room(bytes);
    }
    else
    {
      bytes.copy(head, entry + 8);
    }
  });
  return Buffer.concat([head, Buffer.from(data.buffer)]);
}

// A panorama, floats of red, green and blue from the top: a bright place in the east, a dim one in the south-west.
export const AROUND = [32, 16];
export const panorama = Float32Array.from({ length: 3 * AROUND[0] * AROUND[1] }, (_, k) =>
{
  const [i, j, c] = [Math.floor(k / 3) % AROUND[0], Math.floor(k / 3 / AROUND[0]), k % 3];
  return 0.1 + (i < 4 && j < 7 ? [9, 5, 2][c] : 0) + (i > 18 && i < 23 && j > 2 && j < 8 ? [0.5, 1, 2][c] : 0);
});

// An OpenEXR file of scanlines that are not compressed, its channels as it has them, in the order of their names.
export function exrOf(values, [columns, rows], names)
{
  const text = (string) => Buffer.from(`${string}\0`, 'latin1');
  const ints = (...numbers) => Buffer.from(Int32Array.from(numbers).buffer);
  const attribute = (name, type, ...parts) =>
  {
    const value = Buffer.concat(parts);
    return Buffer.concat([text(name), text(type), ints(value.length), value]);
  };
  const channels = names.flatMap((name) => [text(name), ints(2, 0, 1, 1)]);
  const box = ints(0, 0, columns - 1, rows - 1);
  const head = Buffer.concat([Buffer.from([0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0]),
    attribute('channels', 'chlist', ...channels, Buffer.from([0])), attribute('compression', 'compression', Buffer.from([0])),
    attribute('dataWindow', 'box2i', box), attribute('displayWindow', 'box2i', box),
    attribute('lineOrder', 'lineOrder', Buffer.from([0])),
    attribute('pixelAspectRatio', 'float', Buffer.from(Float32Array.of(1).buffer)),
    attribute('screenWindowCenter', 'v2f', Buffer.from(Float32Array.of(0, 0).buffer)),
    attribute('screenWindowWidth', 'float', Buffer.from(Float32Array.of(1).buffer)), Buffer.from([0])]);
  const size = names.length * columns * 4;
  const offsets = Buffer.alloc(8 * rows);
  const lines = [];
  for (let j = 0; j < rows; ++j)
  {
    offsets.writeBigUInt64LE(BigInt(head.length + 8 * rows + j * (size + 8)), 8 * j);
    // Blue comes before green and red.
    const planes = names.map((_, c) => Buffer.from(Float32Array.from({ length: columns }, (__, i) =>
      values[names.length * (j * columns + i) + names.length - 1 - c]).buffer));
    lines.push(ints(j, size), ...planes);
  }
  return Buffer.concat([head, offsets, ...lines]);
}

// A Radiance picture without repetitions, of half the values, which its exposure makes up for.
export function radianceOf(values, [columns, rows])
{
  const head = Buffer.from(`#?RADIANCE\nEXPOSURE=0.5\nFORMAT=32-bit_rle_rgbe\n\n-Y ${rows} +X ${columns}\n`, 'latin1');
  const lines = [];
  for (let j = 0; j < rows; ++j)
  {
    const planes = [0, 1, 2, 3].map(() => Buffer.alloc(columns));
    for (let i = 0; i < columns; ++i)
    {
      const color = [0, 1, 2].map((c) => values[3 * (j * columns + i) + c] / 2);
      const exponent = Math.floor(Math.log2(Math.max(...color))) + 1;
      color.forEach((value, c) => { planes[c][i] = Math.floor((value / 2 ** exponent) * 256); });
      planes[3][i] = exponent + 128;
    }
    lines.push(Buffer.from([2, 2, columns >> 8, columns & 255]),
      ...planes.flatMap((plane) => [Buffer.from([columns]), plane]));
  }
  return Buffer.concat([head, ...lines]);
}

// A mesh as text: a bowl upon a slab, of quads, in its own unit, y up.
export function bowlObj()
{
  const [around, along] = [64, 20];
  const lines = ['# a bowl upon a slab'];
  for (let j = 0; j <= along; ++j)
  {
    for (let i = 0; i < around; ++i)
    {
      const [turn, rise] = [(2 * Math.PI * i) / around, (Math.PI / 2) * (j / along)];
      const radius = 20 * Math.sin(rise) * (1 + 0.08 * Math.cos(6 * turn));
      lines.push(`v ${radius * Math.cos(turn)} ${20 - 20 * Math.cos(rise)} ${radius * Math.sin(turn)}`);
    }
  }
  for (let j = 0; j < along; ++j)
  {
    for (let i = 0; i < around; ++i)
    {
      const at = (k, l) => l * around + (k % around) + 1;
      lines.push(`f ${at(i, j)} ${at(i, j + 1)} ${at(i + 1, j + 1)} ${at(i + 1, j)}`);
    }
  }
  [[-30, -25], [30, -25], [30, 25], [-30, 25]].forEach(([x, z]) => lines.push(`v ${x} -1 ${z}`));
  lines.push('f -4 -3 -2 -1');
  return Buffer.from(`${lines.join('\n')}\n`);
}

// The normals of the hills, steeper, as a picture of 8 bits; green points up or down.
export function normalPicture(green = 1)
{
  const height = hills(900);
  const at = (i, j) => height[Math.min(Math.max(j, 0), ROWS - 1) * COLUMNS + Math.min(Math.max(i, 0), COLUMNS - 1)] / 30;
  const data = new Uint8Array(3 * COLUMNS * ROWS);
  for (let k = 0; k < COLUMNS * ROWS; ++k)
  {
    const [i, j] = [k % COLUMNS, Math.floor(k / COLUMNS)];
    const slope = [(at(i + 1, j) - at(i - 1, j)) / 2, (at(i, j - 1) - at(i, j + 1)) / 2];
    const length = Math.hypot(...slope, 1);
    data.set([-slope[0], -green * slope[1], 1].map((c) => Math.round(127.5 * (c / length + 1))), 3 * k);
  }
  return png(data, 3, 8);
}
