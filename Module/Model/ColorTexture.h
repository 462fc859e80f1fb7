// SPDX-License-Identifier: BSD-3-Clause
#ifndef ColorTexture_h
#define ColorTexture_h

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstddef>

namespace relief
{

/// A picture that colours a surface: texels that somebody else owns, row by row, and where they lie
/// over the samples of a field. Integers are sRGB-encoded, floating-point numbers linear; alpha is
/// linear in both. Nothing is copied: texels are decoded where they are read.
struct ColorTexture
{
  enum class Type
  {
    Byte,  ///< unsigned 8 bit, 255 is 1
    Short, ///< unsigned 16 bit, 65535 is 1
    Float,
    Double
  };

  const void* texels = nullptr;
  Type type = Type::Byte;
  int components = 4; ///< 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha
  int columns = 0;
  int rows = 0;

  ///@{
  /// Sample (i, j) of the field lies at origin + i * alongI + j * alongJ, in texels; the centre of
  /// the first texel is (0, 0).
  glm::dvec2 origin = glm::dvec2(0.0, 0.0);
  glm::dvec2 alongI = glm::dvec2(1.0, 0.0);
  glm::dvec2 alongJ = glm::dvec2(0.0, 1.0);
  ///@}

  /// Places it so that it covers `samples` of the heights from edge to edge. The field's first
  /// sample is their `first`, the texture's first texel the `texel` of what covers them, which has
  /// so many `texels`.
  void Stretch(const glm::ivec2& samples, const glm::ivec2& first, const glm::ivec2& texels,
    const glm::ivec2& texel);

  /// Whether any of the field's area [i0, i1] x [j0, j1] (pixel areas, so that a field of n columns
  /// is [-0.5, n - 0.5]) lies on the texture.
  bool Overlaps(double i0, double i1, double j0, double j1) const;

  /// A texel in linear light, its colour multiplied by its alpha. Components that are negative, not
  /// finite, or too large for single precision count as 0, an alpha above 1 as 1.
  glm::vec4 Read(int column, int row) const;

  /// A texel's colour in linear light, whatever its alpha is, and whether or not it is finite.
  glm::dvec3 ReadColor(int column, int row) const;

  /// Lays the texture over the colours of the samples [i0, i1) of row j. Bilinear between the
  /// centres of texels; level from the outermost centres to the outer edge, half a texel beyond;
  /// farther out the colours stay.
  void Cover(int i0, int i1, int j, glm::vec3* colors) const;

  /// How many texels of the rows [begin, end) have components that Read() takes for 0 because they
  /// are negative or not finite.
  std::size_t CountUnusable(int begin, int end) const;
};

}

#endif
