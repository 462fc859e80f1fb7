// SPDX-License-Identifier: BSD-3-Clause
#include "ColorTexture.h"

#include "ReliefModel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace relief
{

namespace
{
// Positions within this many texels of a texel's centre or of the edge are taken to be there: what
// rounding does to the coordinates of a map is less, and nobody sees it.
constexpr double Snap = 1e-6;

template <class Code>
const std::array<float, std::numeric_limits<Code>::max() + 1>& DecodeTable()
{
  static const auto table = []()
  {
    std::array<float, std::numeric_limits<Code>::max() + 1> values;
    const double top = std::numeric_limits<Code>::max();
    for (std::size_t code = 0; code < values.size(); ++code)
    {
      values[code] = static_cast<float>(f64::reliefDecode(code / top));
    }
    return values;
  }();
  return table;
}

// Components as they are stored, made linear.
template <class Code>
struct Encoded
{
  const std::array<float, std::numeric_limits<Code>::max() + 1>& table = DecodeTable<Code>();

  double Stored(Code code) const { return this->table[code]; }
  float Color(Code code) const { return this->table[code]; }
  float Alpha(Code code) const
  {
    return static_cast<float>(code) / static_cast<float>(std::numeric_limits<Code>::max());
  }
};

template <class T>
struct Linear
{
  static bool Usable(T value)
  {
    return value >= T(0) && value <= static_cast<T>(std::numeric_limits<float>::max());
  }
  double Stored(T value) const { return value; }
  float Color(T value) const { return Usable(value) ? static_cast<float>(value) : 0.0f; }
  float Alpha(T value) const { return std::min(this->Color(value), 1.0f); }
};

// Reads texels of one type.
template <class T, class Decoder>
struct Reader
{
  explicit Reader(const ColorTexture& texture)
    : Texture(texture)
    , Texels(static_cast<const T*>(texture.texels))
  {
  }

  const T* At(int column, int row) const
  {
    return this->Texels +
      (static_cast<std::size_t>(row) * this->Texture.columns + column) * this->Texture.components;
  }

  glm::vec4 operator()(int column, int row) const
  {
    const T* texel = this->At(column, row);
    const int components = this->Texture.components;
    const glm::vec3 color = components < 3
      ? glm::vec3(this->Decode.Color(texel[0]))
      : glm::vec3(
          this->Decode.Color(texel[0]), this->Decode.Color(texel[1]), this->Decode.Color(texel[2]));
    const float alpha = components % 2 == 0 ? this->Decode.Alpha(texel[components - 1]) : 1.0f;
    return glm::vec4(alpha * color, alpha);
  }

  glm::dvec3 Color(int column, int row) const
  {
    const T* texel = this->At(column, row);
    const int next = this->Texture.components < 3 ? 0 : 1; // grey repeats
    return glm::dvec3(this->Decode.Stored(texel[0]), this->Decode.Stored(texel[next]),
      this->Decode.Stored(texel[2 * next]));
  }

  const ColorTexture& Texture;
  const T* Texels;
  Decoder Decode;
};

// Calls a body with the reader of a texture's type.
template <class Body>
auto WithReader(const ColorTexture& texture, Body&& body)
{
  switch (texture.type)
  {
    case ColorTexture::Type::Byte:
      return body(Reader<std::uint8_t, Encoded<std::uint8_t>>(texture));
    case ColorTexture::Type::Short:
      return body(Reader<std::uint16_t, Encoded<std::uint16_t>>(texture));
    case ColorTexture::Type::Float:
      return body(Reader<float, Linear<float>>(texture));
    default:
      return body(Reader<double, Linear<double>>(texture));
  }
}

// The two texels beside a position along one axis, and the second one's share. Outside the texture
// there are none.
struct Neighbours
{
  Neighbours(double position, int count)
    : inside(position >= -0.5 - Snap && position <= count - 0.5 + Snap)
  {
    if (this->inside)
    {
      const int nearest = static_cast<int>(position + 0.5); // inside, that is no less than 0
      position = std::abs(position - nearest) < Snap ? nearest : position;
      position = std::clamp(position, 0.0, count - 1.0);
      this->first = static_cast<int>(position);
      this->second = std::min(this->first + 1, count - 1);
      this->share = static_cast<float>(position - this->first);
    }
  }

  bool inside;
  int first = 0;
  int second = 0;
  float share = 0.0f;
};

template <class ReaderType>
glm::vec4 Interpolate(const ReaderType& read, const Neighbours& x, const Neighbours& y)
{
  auto along = [&](int row)
  {
    const glm::vec4 first = read(x.first, row);
    return x.share > 0.0f ? first + x.share * (read(x.second, row) - first) : first;
  };
  const glm::vec4 first = along(y.first);
  return y.share > 0.0f ? first + y.share * (along(y.second) - first) : first;
}

// Whether a parallelogram's shadow on an axis meets [lo, hi].
bool Meets(double corner, double side, double other, double lo, double hi)
{
  const double least = corner + std::min(side, 0.0) + std::min(other, 0.0);
  const double greatest = corner + std::max(side, 0.0) + std::max(other, 0.0);
  return greatest > lo && least < hi;
}
}

void ColorTexture::Stretch(const glm::ivec2& samples, const glm::ivec2& first,
  const glm::ivec2& texels, const glm::ivec2& texel)
{
  const glm::dvec2 scale = glm::dvec2(texels) / glm::dvec2(samples);
  this->origin = (glm::dvec2(first) + 0.5) * scale - 0.5 - glm::dvec2(texel);
  this->alongI = glm::dvec2(scale.x, 0.0);
  this->alongJ = glm::dvec2(0.0, scale.y);
}

bool ColorTexture::Overlaps(double i0, double i1, double j0, double j1) const
{
  // Two parallelograms are apart if they are so along an axis of either (separating axes).
  const glm::dvec2 corner = this->origin + i0 * this->alongI + j0 * this->alongJ;
  const glm::dvec2 width = (i1 - i0) * this->alongI;
  const glm::dvec2 height = (j1 - j0) * this->alongJ;
  if (!Meets(corner.x, width.x, height.x, -0.5, this->columns - 0.5) ||
    !Meets(corner.y, width.y, height.y, -0.5, this->rows - 0.5))
  {
    return false;
  }
  const double area = this->alongI.x * this->alongJ.y - this->alongI.y * this->alongJ.x;
  if (area == 0.0)
  {
    return true;
  }
  // The texture's first corner and its sides, in samples.
  auto toI = [&](double u, double v) { return (u * this->alongJ.y - v * this->alongJ.x) / area; };
  auto toJ = [&](double u, double v) { return (v * this->alongI.x - u * this->alongI.y) / area; };
  const double u = -0.5 - this->origin.x;
  const double v = -0.5 - this->origin.y;
  return Meets(toI(u, v), toI(this->columns, 0.0), toI(0.0, this->rows), i0, i1) &&
    Meets(toJ(u, v), toJ(this->columns, 0.0), toJ(0.0, this->rows), j0, j1);
}

glm::vec4 ColorTexture::Read(int column, int row) const
{
  return WithReader(*this, [&](const auto& read) { return read(column, row); });
}

glm::dvec3 ColorTexture::ReadColor(int column, int row) const
{
  return WithReader(*this, [&](const auto& read) { return read.Color(column, row); });
}

void ColorTexture::Cover(int i0, int i1, int j, glm::vec3* colors) const
{
  const glm::dvec2 start = this->origin + static_cast<double>(j) * this->alongJ;
  WithReader(*this,
    [&](const auto& read)
    {
      const bool level = this->alongI.y == 0.0; // rows lie along rows
      Neighbours y(start.y, this->rows);
      for (int i = i0; i < i1; ++i)
      {
        const double steps = i;
        const Neighbours x(start.x + steps * this->alongI.x, this->columns);
        y = level ? y : Neighbours(start.y + steps * this->alongI.y, this->rows);
        if (x.inside && y.inside)
        {
          const glm::vec4 texel = Interpolate(read, x, y);
          colors[i - i0] =
            f32::reliefOver(glm::vec3(texel.x, texel.y, texel.z), texel.w, colors[i - i0]);
        }
      }
    });
}

std::size_t ColorTexture::CountUnusable(int begin, int end) const
{
  auto count = [&](const auto* texels, auto usable)
  {
    std::size_t unusable = 0;
    const auto* texel = texels + static_cast<std::size_t>(begin) * this->columns * this->components;
    const auto* last = texels + static_cast<std::size_t>(end) * this->columns * this->components;
    for (; texel != last; texel += this->components)
    {
      unusable += std::all_of(texel, texel + this->components, usable) ? 0 : 1;
    }
    return unusable;
  };
  switch (this->type)
  {
    case Type::Float:
      return count(static_cast<const float*>(this->texels), Linear<float>::Usable);
    case Type::Double:
      return count(static_cast<const double*>(this->texels), Linear<double>::Usable);
    default:
      return 0;
  }
}

}
