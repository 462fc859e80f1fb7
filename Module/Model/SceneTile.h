// SPDX-License-Identifier: BSD-3-Clause
#ifndef SceneTile_h
#define SceneTile_h

#include "SweepThickness.h"

#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>

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
  bool outlined; ///< some heights that it depends on are known by their bounds only

  static constexpr int Width = SweepThickness::TileWidth;
  static constexpr int Size = SweepThickness::TileSize;
  /// One number of every sample, aligned for vectors of any width.
  template <class T>
  struct alignas(Width * sizeof(float)) Plane
  {
    T values[Size];
  };
  template <class T>
  using Color = Plane<T>[3];

  /// What the lights sum up to.
  enum Term
  {
    Diffuse,
    Scatter,
    Specular,
    NumberOfTerms
  };

  /// Heights, NaN without data and outside the image, with those of the neighbours where there are
  /// normals: the field's own where all of these are in the image, otherwise a copy.
  const float* firstHeight; ///< of the tile's first sample
  std::ptrdiff_t pitch;     ///< from row to row
  static constexpr int RingPitch = 3 * Width;
  alignas(Width * sizeof(float)) float ring[(Width + 2) * RingPitch];
  Plane<float> d;
  Plane<float> r;
  Plane<float> thickness; // r of the first light
  Plane<float> shadow;    // of the first sun
  Plane<float> share;     // of a light, in a term
  Color<float> normal;
  Color<float> toLight;
  Plane<float> scatterFactor;
  // Sums over the lights, which may be a million: in float, small ones would be lost in them.
  Color<double> sums[NumberOfTerms];
  Plane<double> illumination;
  // The sums, rounded; of a grey picture only the first channel.
  Color<float> terms[NumberOfTerms];
  Color<float> base; // where it is textured
  // For what takes samples one by one.
  glm::vec3 normals[Size];
  glm::vec3 texels[Size];
  unsigned char wanted[Size];

  const float* HeightsOf(int row) const { return this->firstHeight + row * this->pitch; }

  /// By its place in the other arrays.
  bool HasData(int at) const { return !std::isnan(this->HeightsOf(at / Width)[at % Width]); }

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
