// SPDX-License-Identifier: BSD-3-Clause
//
// The height field that the model's text reads, as a host on the GPU has it: heights in a texture of
// one float a sample, NaN without data, and the levels of the bounds side by side in another. What is
// larger than a texture may be lies in tiles, the slices of a 3D texture.

//RELIEF::If TiledHeights
uniform sampler3D reliefHeights;
uniform ivec2 reliefHeightsTiles; // tiles in a row, and a tile's side as a power of two
//RELIEF::Else
uniform sampler2D reliefHeights;
//RELIEF::End
//RELIEF::If TiledBounds
uniform sampler3D reliefBlocks;
uniform ivec2 reliefBlocksTiles;
//RELIEF::Else
uniform sampler2D reliefBlocks;
//RELIEF::End
uniform ivec2 reliefSize;    // samples along x and y
uniform vec2 reliefSpacing;
uniform float reliefHighest; // no height lies above it
uniform int reliefLevelCount;
uniform int reliefLevelX[16]; // where each level of the bounds begins
uniform int reliefLevelY[16];

//RELIEF::If Tiled
ivec3 reliefTile(ivec2 at, ivec2 tiles)
{
  ivec2 tile = at >> tiles.y;
  return ivec3(at - (tile << tiles.y), tile.y * tiles.x + tile.x);
}
//RELIEF::End

int reliefColumns(int field)
{
  return reliefSize.x;
}

int reliefRows(int field)
{
  return reliefSize.y;
}

float reliefSpacingX(int field)
{
  return reliefSpacing.x;
}

float reliefSpacingY(int field)
{
  return reliefSpacing.y;
}

float reliefHeight(int field, int i, int j)
{
  //RELIEF::If TiledHeights
  return texelFetch(reliefHeights, reliefTile(ivec2(i, j), reliefHeightsTiles), 0).x;
  //RELIEF::Else
  return texelFetch(reliefHeights, ivec2(i, j), 0).x;
  //RELIEF::End
}

float reliefTop(int field)
{
  return reliefHighest;
}

int reliefLevels(int field)
{
  return reliefLevelCount;
}

void reliefBounds(int field, int level, int i, int j, out float lo, out float hi)
{
  ivec2 at = ivec2(reliefLevelX[level] + i, reliefLevelY[level] + j);
  //RELIEF::If TiledBounds
  vec2 bounds = texelFetch(reliefBlocks, reliefTile(at, reliefBlocksTiles), 0).xy;
  //RELIEF::Else
  vec2 bounds = texelFetch(reliefBlocks, at, 0).xy;
  //RELIEF::End
  lo = bounds.x;
  hi = bounds.y;
}
