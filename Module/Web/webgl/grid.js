// SPDX-License-Identifier: BSD-3-Clause
//
// Which samples a view needs: ReliefGrid, for pictures that look straight down.

// Texel k of a grid stands for the samples in [k, k + 1) strides and shades the middle one.
export class Grid
{
  constructor(first = [0, 0], size = [0, 0], stride = [1, 1])
  {
    this.first = first;
    this.size = size;
    this.stride = stride; // at least 1
  }

  get empty()
  {
    return this.size[0] < 1 || this.size[1] < 1;
  }

  // Texels for a sample.
  get detail()
  {
    return 1 / (this.stride[0] * this.stride[1]);
  }

  get texels()
  {
    return this.size[0] * this.size[1];
  }

  sameStride(other)
  {
    return this.stride[0] === other.stride[0] && this.stride[1] === other.stride[1];
  }

  equals(other)
  {
    return this.sameStride(other) && this.first[0] === other.first[0] && this.first[1] === other.first[1] &&
      this.size[0] === other.size[0] && this.size[1] === other.size[1];
  }

  // Whether the other grid's samples are among this one's.
  holds(other)
  {
    return this.sameStride(other) && this.reaches(other);
  }

  // Whether what the other grid needs of a field can be read from this one: it holds it, or has all samples
  // there.
  serves(other, field)
  {
    const samples = [field.columns, field.rows];
    return this.holds(other) || (this.stride[0] === 1 && this.stride[1] === 1 && [0, 1].every((axis) =>
      this.first[axis] <= other.sampleOf(axis, 0, samples[axis]) &&
      this.first[axis] + this.size[axis] > other.sampleOf(axis, other.size[axis] - 1, samples[axis])));
  }

  // Whether this grid reaches as far as the other, however coarse it is.
  reaches(other)
  {
    const same = this.sameStride(other);
    return !this.empty && [0, 1].every((axis) =>
    {
      const begin = this.first[axis];
      const end = begin + this.size[axis];
      const otherEnd = other.first[axis] + other.size[axis];
      if (same)
      {
        // Texels of the same stride must be there one by one.
        return begin <= other.first[axis] && end >= otherEnd;
      }
      const stride = this.stride[axis];
      return begin * stride <= other.first[axis] * other.stride[axis] + stride &&
        end * stride >= otherEnd * other.stride[axis] - stride;
    });
  }

  sampleOf(axis, texel, samples)
  {
    return Math.min(Math.floor((this.first[axis] + texel + 0.5) * this.stride[axis]), samples - 1);
  }
}

// Where a picture lies on the field: `origin` is the place of its lower left corner, in samples from the
// field's corner, `step` the samples for a pixel. At zoom 1 the whole field fits.
export function placeView(field, width, height, view)
{
  const size = [field.columns, field.rows];
  const lengths = [0, 1].map((axis) => size[axis] * field.spacing[axis]);
  const pixel = Math.max(lengths[0] / width, lengths[1] / height) / view.zoom;
  const step = [pixel / field.spacing[0], pixel / field.spacing[1]];
  const origin = [view.centerX * size[0] - 0.5 * width * step[0],
    (1 - view.centerY) * size[1] - 0.5 * height * step[1]];
  return { origin, step, width, height };
}

// The part of the field that a picture shows.
export function visiblePart(field, place)
{
  const size = [field.columns, field.rows];
  const pixels = [place.width, place.height];
  const lo = [0, 1].map((axis) => Math.max(place.origin[axis], 0));
  const hi = [0, 1].map((axis) => Math.min(place.origin[axis] + pixels[axis] * place.step[axis], size[axis]));
  return { any: lo[0] < hi[0] && lo[1] < hi[1], lo, hi, stride: place.step };
}

function roundStride(stride)
{
  // The rest forgives what rounding does to a view that shows a whole number of samples a pixel.
  return Math.max(1, 2 ** (Math.floor(4 * Math.log2(stride) + 1e-4) / 4));
}

// A grid over the visible part of a field with a texel a pixel, or a sample where these are larger, times
// `coarseness`, at least 1; coarser where it would have too many texels.
export function makeGrid(part, columns, rows, coarseness, mostTexels, mostAlong)
{
  if (!part.any)
  {
    return new Grid();
  }
  const samples = [columns, rows];
  for (let factor = coarseness;; factor *= 2 ** 0.25)
  {
    const grid = new Grid([0, 0], [0, 0], [1, 1]);
    for (const axis of [0, 1])
    {
      const stride = roundStride(Math.max(part.stride[axis], 1) * factor);
      const last = Math.ceil(samples[axis] / stride) - 1;
      const within = (k) => Math.min(Math.max(k, 0), last);
      // A texel more on each side, between which and its neighbour the picture is interpolated.
      const begin = within(Math.floor(part.lo[axis] / stride) - 1);
      const end = within(Math.floor(part.hi[axis] / stride) + 1);
      grid.first[axis] = begin;
      grid.size[axis] = end - begin + 1;
      grid.stride[axis] = stride;
    }
    if (grid.texels === 1 ||
      (grid.texels <= mostTexels && grid.size[0] <= mostAlong && grid.size[1] <= mostAlong))
    {
      return grid;
    }
  }
}
