// SPDX-License-Identifier: BSD-3-Clause
//
// Which samples are shaded: texel k of a grid, counted from the grid's origin at the field's first
// sample, stands for the samples from k to k + 1 strides, and shades the one in their middle.

uniform ivec2 gridFirst; // the texel of the grid that is the first of the texture
uniform vec2 gridStride; // samples from texel to texel, at least 1
uniform ivec2 gridSize;  // texels in the texture
in vec2 texCoord;        // (0, 0) to (1, 1) over the texture

ivec2 gridHere()
{
  return ivec2(texCoord * vec2(gridSize));
}

ivec2 gridSample(ivec2 texel)
{
  return min(ivec2(floor((vec2(gridFirst + texel) + 0.5) * gridStride)), reliefSize - 1);
}

// The texel that stands for a sample in a texture of another grid.
ivec2 gridTexel(ivec2 at, ivec2 first, vec2 stride, ivec2 size)
{
  return clamp(ivec2(floor((vec2(at) + 0.5) / stride)) - first, ivec2(0), size - 1);
}
