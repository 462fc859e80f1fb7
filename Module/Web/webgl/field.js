// SPDX-License-Identifier: BSD-3-Clause
//
// Heights made ready for the shading programs: lengths in single precision, NaN without data, rows from
// south to north, and their bounds over blocks, by which rays skip. As HeightField and MinMaxPyramid do it.

import { ReliefError } from './error.js';

const BLOCK = 4;        // cells along a side of the smallest block that has bounds
const MOST_LEVELS = 16; // for which ReliefField.glsl has room
const SHORTEST = 1e-32; // a spacing, and the longest by its reciprocal

let versions = 0;

function isSize(n)
{
  return Number.isInteger(n) && n >= 1;
}

// Checks what setHeights() was given and keeps it as it will be needed again.
export function takeHeights(heights, layout = {})
{
  const { width, height } = layout;
  if (!ArrayBuffer.isView(heights) || heights instanceof DataView || typeof heights[0] === 'bigint')
  {
    throw new ReliefError('the heights are no array of numbers: a Float32Array is expected');
  }
  if (!isSize(width) || !isSize(height))
  {
    throw new ReliefError(`the field's size is ${width} x ${height}: whole numbers from 1 on are expected`);
  }
  if (heights.length !== width * height)
  {
    throw new ReliefError(`there are ${heights.length} heights for a field of ${width} x ${height}: ` +
      `${width * height} are expected`);
  }
  const given = layout.spacing ?? 1;
  const spacing = typeof given === 'number' ? [given, given] : [Number(given[0]), Number(given[1])];
  if (!spacing.every((s) => s >= SHORTEST && s <= 1 / SHORTEST))
  {
    throw new ReliefError(`the spacing is ${given}: one or two lengths above 0 are expected`);
  }
  const origin = layout.origin ?? [0, 0];
  if (!Number.isFinite(origin[0]) || !Number.isFinite(origin[1]))
  {
    throw new ReliefError(`the origin is ${origin}: the x and y of the south-west sample are expected`);
  }
  const rows = layout.rows ?? 'north-first';
  if (rows !== 'north-first' && rows !== 'south-first')
  {
    throw new ReliefError(`the rows are "${rows}": "north-first" or "south-first" is expected`);
  }
  const noData = layout.noData ?? null;
  const place = { width, height, spacing, origin: [Number(origin[0]), Number(origin[1])] };
  return {
    heights, columns: width, rows: height, spacing, northFirst: rows === 'north-first', noData,
    bounds: { ...place, ...rangeOf(heights, noData), floats: heights instanceof Float32Array },
  };
}

// The least and the greatest height that is one.
function rangeOf(heights, noData)
{
  let bottom = Infinity;
  let top = -Infinity;
  for (let k = 0; k < heights.length; ++k)
  {
    const height = heights[k];
    if (Math.abs(height) <= Number.MAX_VALUE && height !== noData)
    {
      bottom = height < bottom ? height : bottom;
      top = height > top ? height : top;
    }
  }
  return top >= bottom ? { bottom, top } : { bottom: 1, top: 0 };
}

// Scales the heights and counts them from a datum.
export function prepareField(source, scale, datum)
{
  const { heights, columns, rows, noData } = source;
  const values = new Float32Array(heights.length);
  let top = -Infinity;
  for (let j = 0; j < rows; ++j)
  {
    let from = (source.northFirst ? rows - 1 - j : j) * columns;
    for (let k = j * columns, end = k + columns; k < end; ++k, ++from)
    {
      const given = heights[from];
      const known = Math.abs(given) <= Number.MAX_VALUE && given !== noData;
      values[k] = known ? given * scale - datum : NaN;
      top = values[k] > top ? values[k] : top;
    }
  }
  return {
    version: ++versions, scale, datum, values, columns, rows, spacing: source.spacing,
    northFirst: source.northFirst, top, bounds: layOut(buildPyramid(values, columns, rows)),
  };
}

// Whether all cells of a block with samples that have no data are holes, or some.
function isMixed(values, columns, i0, i1, j0, j1)
{
  for (let j = j0; j < j1; ++j)
  {
    for (let i = i0; i < i1; ++i)
    {
      const k = j * columns + i;
      if (!Number.isNaN(values[k] + values[k + 1] + values[k + columns] + values[k + columns + 1]))
      {
        return true;
      }
    }
  }
  return false;
}

// Least and greatest height of a block's samples, its sides among them: infinity and its negative where
// every cell is a hole, the reverse where some are.
function buildBase(values, columns, rows)
{
  const level = newLevel(Math.ceil((columns - 1) / BLOCK), Math.ceil((rows - 1) / BLOCK));
  const least = new Float32Array(columns);
  const most = new Float32Array(columns);
  for (let bj = 0; bj < level.rows; ++bj)
  {
    const first = bj * BLOCK;
    const last = Math.min(first + BLOCK, rows - 1);
    least.fill(Infinity);
    most.fill(-Infinity);
    let sum = 0; // NaN where any height is
    for (let j = first; j <= last; ++j)
    {
      for (let i = 0, k = j * columns; i < columns; ++i, ++k)
      {
        const v = values[k];
        sum += v * 0;
        if (v < least[i])
        {
          least[i] = v;
        }
        if (v > most[i])
        {
          most[i] = v;
        }
      }
    }
    const holes = Number.isNaN(sum);
    for (let bi = 0; bi < level.columns; ++bi)
    {
      const begin = bi * BLOCK;
      const end = Math.min(begin + BLOCK, columns - 1);
      let lo = Infinity;
      let hi = -Infinity;
      for (let i = begin; i <= end; ++i)
      {
        lo = least[i] < lo ? least[i] : lo;
        hi = most[i] > hi ? most[i] : hi;
      }
      if (holes && anyMissing(values, columns, begin, end, first, last))
      {
        const mixed = isMixed(values, columns, begin, end, first, last);
        lo = mixed ? -Infinity : Infinity;
        hi = -lo;
      }
      level.lo[bj * level.columns + bi] = lo;
      level.hi[bj * level.columns + bi] = hi;
    }
  }
  return level;
}

function anyMissing(values, columns, i0, i1, j0, j1)
{
  for (let j = j0; j <= j1; ++j)
  {
    for (let i = i0; i <= i1; ++i)
    {
      if (Number.isNaN(values[j * columns + i]))
      {
        return true;
      }
    }
  }
  return false;
}

function newLevel(columns, rows)
{
  return { columns, rows, lo: new Float32Array(columns * rows), hi: new Float32Array(columns * rows) };
}

function buildParents(below)
{
  const level = newLevel(Math.ceil(below.columns / 2), Math.ceil(below.rows / 2));
  for (let j = 0; j < level.rows; ++j)
  {
    const south = 2 * j * below.columns;
    const north = Math.min(2 * j + 1, below.rows - 1) * below.columns;
    for (let i = 0; i < level.columns; ++i)
    {
      const west = 2 * i;
      const east = Math.min(2 * i + 1, below.columns - 1);
      let lo = Infinity;
      let hi = -Infinity;
      let empty = false;
      for (const k of [south + west, south + east, north + west, north + east])
      {
        lo = below.lo[k] < lo ? below.lo[k] : lo;
        hi = below.hi[k] > hi ? below.hi[k] : hi;
        empty = empty || below.lo[k] > below.hi[k];
      }
      // Some of them empty and others not.
      const mixed = empty && lo <= hi;
      level.lo[j * level.columns + i] = mixed ? -Infinity : lo;
      level.hi[j * level.columns + i] = mixed ? Infinity : hi;
    }
  }
  return level;
}

export function buildPyramid(values, columns, rows)
{
  if (columns < 2 || rows < 2)
  {
    return [];
  }
  const levels = [buildBase(values, columns, rows)];
  for (let last = levels[0]; last.columns > 1 || last.rows > 1; last = levels[levels.length - 1])
  {
    levels.push(buildParents(last));
  }
  return levels.slice(0, MOST_LEVELS);
}

// Levels side by side in one picture: the base at the left, the others in a column beside it.
function layOut(levels)
{
  const x = [];
  const y = [];
  let width = 1;
  let height = 1;
  levels.forEach((level, l) =>
  {
    x.push(l > 0 ? levels[0].columns : 0);
    y.push(l > 1 ? y[l - 1] + levels[l - 1].rows : 0);
    width = Math.max(width, x[l] + level.columns);
    height = Math.max(height, y[l] + level.rows);
  });
  const values = new Float32Array(2 * width * height);
  levels.forEach((level, l) =>
  {
    for (let j = 0, k = 0; j < level.rows; ++j)
    {
      let at = 2 * ((y[l] + j) * width + x[l]);
      for (let i = 0; i < level.columns; ++i, ++k)
      {
        values[at++] = level.lo[k];
        values[at++] = level.hi[k];
      }
    }
  });
  return { values, width, height, x, y };
}
