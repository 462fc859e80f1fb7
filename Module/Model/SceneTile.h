// SPDX-License-Identifier: BSD-3-Clause
#ifndef SceneTile_h
#define SceneTile_h

#include "SweepThickness.h"

#include <glm/vec3.hpp>

namespace relief
{

/// Sums and intermediate results of a tile of samples. It is computed as far as it lies in the
/// image, whatever part of it is asked for: neighbouring rays are traced together, and results must
/// not depend on the company.
struct SceneTile
{
  int column; ///< of the tile
  int row;
  int i0, i1, j0, j1;                     ///< in the image
  int askedI0, askedI1, askedJ0, askedJ1; ///< asked for
  bool anyData;

  static constexpr int Width = SweepThickness::TileWidth;
  static constexpr int Size = SweepThickness::TileSize;
  unsigned char hasData[Size];
  unsigned char wanted[Size];
  glm::vec3 normals[Size];
  glm::vec3 toLight[Size];
  float scatterFactor[Size];
  float d[Size];
  float r[Size];
  // Sums over the lights, which may be a million: in float, small ones would be lost in them.
  glm::dvec3 diffuse[Size];
  glm::dvec3 scatter[Size];
  glm::dvec3 specular[Size];
  double illumination[Size];
  glm::vec3 base[Size];  // where it is textured
  glm::vec3 color[Size]; // that a texture gives
  float thickness[Size];

  /// The place of a sample in the arrays.
  int At(int i, int j) const
  {
    return (j - this->row * SweepThickness::TileHeight) * Width + (i - this->column * Width);
  }

  template <class Body>
  void ForEach(Body&& body) const
  {
    this->ForRectangle(this->i0, this->i1, this->j0, this->j1, body);
  }

  template <class Body>
  void ForEachAsked(Body&& body) const
  {
    this->ForRectangle(this->askedI0, this->askedI1, this->askedJ0, this->askedJ1, body);
  }

private:
  template <class Body>
  void ForRectangle(int x0, int x1, int y0, int y1, Body& body) const
  {
    for (int j = y0; j < y1; ++j)
    {
      int at = this->At(x0, j);
      for (int i = x0; i < x1; ++i, ++at)
      {
        body(i, j, at);
      }
    }
  }
};

}

#endif
