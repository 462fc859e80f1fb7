// SPDX-License-Identifier: BSD-3-Clause
//
// Pictures that colour a surface, stretched over the field: decoded, multiplied by their alpha and laid over
// a colour at every sample of a grid, as ColorTexture and ReliefColorLayers do it.

const WHITES = [[Uint8Array, 255], [Uint8ClampedArray, 255], [Uint16Array, 65535]]; // other texels are linear
const LARGEST_FLOAT = 3.4028234663852886e38;
const SNAP = 1e-6; // what rounding does to coordinates is less

function decode(code)
{
  return code <= 0.04045 ? code / 12.92 : ((code + 0.055) / 1.055) ** 2.4;
}

const tables = new Map();

function decodeTable(white)
{
  if (!tables.has(white))
  {
    tables.set(white, Float32Array.from({ length: white + 1 }, (_, code) => decode(code / white)));
  }
  return tables.get(white);
}

// Returns a function that puts a texel's colour, multiplied by its alpha, and alpha into an array.
function makeReader(texture)
{
  const { data, width, height } = texture;
  const components = data.length / (width * height);
  const white = WHITES.find(([Type]) => data instanceof Type)?.[1];
  const table = white ? decodeTable(white) : null;
  const color = table ? (v) => table[v] : (v) => (v >= 0 && v <= LARGEST_FLOAT ? v : 0);
  const alpha = table ? (v) => v / white : (v) => Math.min(color(v), 1);
  const grey = components < 3;
  const hasAlpha = components % 2 === 0;
  return (column, row, out) =>
  {
    const k = (row * width + column) * components;
    const a = hasAlpha ? alpha(data[k + components - 1]) : 1;
    out[0] = a * color(data[k]);
    out[1] = grey ? out[0] : a * color(data[k + 1]);
    out[2] = grey ? out[0] : a * color(data[k + 2]);
    out[3] = a;
  };
}

// The two texels beside a position, and the second one's share.
function neighbours(position, count)
{
  const nearest = Math.floor(position + 0.5);
  const snapped = Math.abs(position - nearest) < SNAP ? nearest : position;
  const at = Math.min(Math.max(snapped, 0), count - 1);
  const first = Math.floor(at);
  return { first, second: Math.min(first + 1, count - 1), share: at - first };
}

// Colours of a grid's texels, four floats each, rows from south to north.
export function coverGrid(texture, constant, grid, field)
{
  const [width, height] = grid.size;
  const read = makeReader(texture);
  const colors = new Float32Array(4 * width * height);
  const along = (axis, size, texels) => Array.from({ length: size }, (_, texel) =>
    neighbours((grid.sampleOf(axis, texel, axis === 0 ? field.columns : field.rows) + 0.5) *
      (texels / (axis === 0 ? field.columns : field.rows)) - 0.5, texels));
  const xs = along(0, width, texture.width);
  const ys = along(1, height, texture.height);
  const a = new Float32Array(4);
  const b = new Float32Array(4);
  const south = new Float32Array(4);
  const north = new Float32Array(4);
  const blend = (x, row, out) =>
  {
    read(x.first, row, a);
    out.set(a);
    if (x.share > 0)
    {
      read(x.second, row, b);
      for (let c = 0; c < 4; ++c)
      {
        out[c] += x.share * (b[c] - a[c]);
      }
    }
  };
  // The picture's rows lie as those of the heights.
  const row = (j) => (field.northFirst ? texture.height - 1 - j : j);
  for (let j = 0, k = 0; j < height; ++j)
  {
    for (let i = 0; i < width; ++i, k += 4)
    {
      blend(xs[i], row(ys[j].first), south);
      if (ys[j].share > 0)
      {
        blend(xs[i], row(ys[j].second), north);
        for (let c = 0; c < 4; ++c)
        {
          south[c] += ys[j].share * (north[c] - south[c]);
        }
      }
      for (let c = 0; c < 3; ++c)
      {
        colors[k + c] = south[c] + (1 - south[3]) * constant[c];
      }
      colors[k + 3] = 1;
    }
  }
  return colors;
}
