// SPDX-License-Identifier: BSD-3-Clause
//
// Texels, decoded, premultiplied and interpolated.
#include "ColorTexture.h"
#include "ReliefModel.h"
#include "TestTerrain.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

using namespace relief;

namespace
{
template <class T>
ColorTexture::Type TypeOf();
template <>
ColorTexture::Type TypeOf<std::uint8_t>()
{
  return ColorTexture::Type::Byte;
}
template <>
ColorTexture::Type TypeOf<std::uint16_t>()
{
  return ColorTexture::Type::Short;
}
template <>
ColorTexture::Type TypeOf<float>()
{
  return ColorTexture::Type::Float;
}
template <>
ColorTexture::Type TypeOf<double>()
{
  return ColorTexture::Type::Double;
}

// A texture that lies sample on texel.
template <class T>
ColorTexture Texture(const std::vector<T>& texels, int columns, int rows, int components)
{
  EXPECT_EQ(texels.size(), static_cast<std::size_t>(columns) * rows * components);
  ColorTexture texture;
  texture.texels = texels.data();
  texture.type = TypeOf<T>();
  texture.components = components;
  texture.columns = columns;
  texture.rows = rows;
  return texture;
}

// The colour over a constant, at a position in texels.
glm::vec3 At(ColorTexture texture, double u, double v, const glm::vec3& constant)
{
  texture.origin = glm::dvec2(u, v);
  glm::vec3 color = constant;
  texture.Cover(0, 1, 0, &color);
  return color;
}

const glm::vec3 Below(0.25f, 0.5f, 0.75f);

template <class T>
void TestEveryCode()
{
  const int most = std::numeric_limits<T>::max();
  std::vector<T> texels;
  for (int code = 0; code <= most; ++code)
  {
    texels.push_back(static_cast<T>(code));
  }
  const ColorTexture texture = Texture(texels, most + 1, 1, 1);
  std::vector<glm::vec3> colors(texels.size(), Below);
  texture.Cover(0, most + 1, 0, colors.data());
  for (int code = 0; code <= most; ++code)
  {
    const double share = static_cast<double>(code) / most;
    const double linear = share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
    ASSERT_NEAR(colors[code].x, linear, 1e-7);
    ASSERT_EQ(colors[code], glm::vec3(colors[code].x));
    ASSERT_EQ(std::lround(f32::reliefEncode(colors[code].x) * static_cast<float>(most)), code);
  }
  EXPECT_EQ(colors[0].x, 0.0f);
  EXPECT_EQ(colors[most].x, 1.0f);
}
}

TEST(ColorTexture, EveryCodeIsDecoded)
{
  TestEveryCode<std::uint8_t>();
  TestEveryCode<std::uint16_t>();
}

TEST(ColorTexture, FloatsAreTaken)
{
  Random random(Seed());
  std::vector<float> single;
  std::vector<double> twice;
  for (int k = 0; k < 7 * 5 * 3; ++k)
  {
    single.push_back(static_cast<float>(random.Uniform(0.0, 20.0)));
    twice.push_back(single.back());
  }
  for (int j = 0; j < 5; ++j)
  {
    for (int i = 0; i < 7; ++i)
    {
      const float* texel = single.data() + 3 * (7 * j + i);
      const glm::vec3 expected(texel[0], texel[1], texel[2]);
      EXPECT_EQ(At(Texture(single, 7, 5, 3), i, j, Below), expected);
      EXPECT_EQ(At(Texture(twice, 7, 5, 3), i, j, Below), expected);
    }
  }
}

TEST(ColorTexture, Components)
{
  const std::vector<float> texel = { 0.5f, 0.25f, 1.0f, 0.75f };
  EXPECT_EQ(At(Texture(std::vector<float>{ 0.5f }, 1, 1, 1), 0, 0, Below), glm::vec3(0.5f));
  EXPECT_EQ(
    At(Texture(std::vector<float>{ 0.5f, 0.25f }, 1, 1, 2), 0, 0, Below), 0.125f + 0.75f * Below);
  EXPECT_EQ(At(Texture(std::vector<float>{ 0.5f, 0.25f, 1.0f }, 1, 1, 3), 0, 0, Below),
    glm::vec3(0.5f, 0.25f, 1.0f));
  EXPECT_EQ(
    At(Texture(texel, 1, 1, 4), 0, 0, Below), 0.75f * glm::vec3(0.5f, 0.25f, 1.0f) + 0.25f * Below);
  EXPECT_EQ(Texture(texel, 1, 1, 4).Read(0, 0), glm::vec4(0.375f, 0.1875f, 0.75f, 0.75f));
  // Alpha is linear where colours are encoded.
  const std::vector<std::uint8_t> encoded = { 255, 51 };
  const glm::vec4 read = Texture(encoded, 1, 1, 2).Read(0, 0);
  EXPECT_FLOAT_EQ(read.w, 0.2f);
  EXPECT_NEAR(read.x, 0.2f, 1e-7f);
}

// Bilinear interpolation is exact on what is linear along each axis, wherever texels lie.
TEST(ColorTexture, RampsAreExact)
{
  auto ramp = [](double u, double v)
  { return glm::dvec3(0.5 + 0.1 * u, 0.2 + 0.05 * v + 0.01 * u, 3.0 + 0.5 * u + 0.02 * u * v); };
  std::vector<double> texels;
  for (int v = 0; v < 9; ++v)
  {
    for (int u = 0; u < 12; ++u)
    {
      const glm::dvec3 color = ramp(u, v);
      texels.insert(texels.end(), { color.x, color.y, color.z });
    }
  }
  ColorTexture texture = Texture(texels, 12, 9, 3);
  Random random(Seed());
  for (int round = 0; round < 200; ++round)
  {
    texture.origin = glm::dvec2(random.Uniform(0.0, 3.0), random.Uniform(2.0, 5.0));
    texture.alongI = glm::dvec2(random.Uniform(0.0, 1.0), random.Uniform(-0.1, 0.1));
    texture.alongJ = glm::dvec2(random.Uniform(0.0, 0.1), random.Uniform(-0.2, 0.2));
    for (int j = 0; j < 4; ++j)
    {
      std::vector<glm::vec3> colors(8, Below);
      texture.Cover(1, 9, j, colors.data());
      for (int i = 1; i < 9; ++i)
      {
        const glm::dvec2 at = texture.origin + static_cast<double>(i) * texture.alongI +
          static_cast<double>(j) * texture.alongJ;
        const glm::dvec3 expected = ramp(std::min(at.x, 11.0), at.y);
        const bool inside = at.x <= 11.5;
        for (int c = 0; c < 3; ++c)
        {
          ASSERT_NEAR(colors[i - 1][c], inside ? expected[c] : Below[c], 4e-6)
            << "RELIEF_SEED=" << Seed() << " at " << at.x << ", " << at.y;
        }
      }
    }
  }
}

TEST(ColorTexture, EdgesAreLevelForHalfATexel)
{
  const std::vector<float> texels = { 1.0f, 2.0f, 4.0f, 8.0f, 16.0f, 32.0f };
  const ColorTexture texture = Texture(texels, 3, 2, 1);
  auto at = [&](double u, double v) { return At(texture, u, v, glm::vec3(0.5f)).x; };
  EXPECT_EQ(at(-0.5, 0.0), 1.0f);
  EXPECT_EQ(at(-0.25, -0.5), 1.0f);
  EXPECT_EQ(at(2.5, 0.5), 18.0f);
  EXPECT_EQ(at(1.0, 1.5), 16.0f);
  EXPECT_EQ(at(0.5, 0.0), 1.5f);
  for (double beyond : { 1e-3, 0.6, 1e12, std::numeric_limits<double>::infinity() })
  {
    EXPECT_EQ(at(-0.5 - beyond, 0.0), 0.5f);
    EXPECT_EQ(at(2.5 + beyond, 0.0), 0.5f);
    EXPECT_EQ(at(1.0, -0.5 - beyond), 0.5f);
    EXPECT_EQ(at(1.0, 1.5 + beyond), 0.5f);
  }
  EXPECT_EQ(at(std::numeric_limits<double>::quiet_NaN(), 0.0), 0.5f);
  // What rounding does to positions is forgiven.
  EXPECT_EQ(at(1.0 + 1e-8, 1.0 - 1e-8), 16.0f);
  EXPECT_EQ(at(-0.5 - 1e-8, 0.0), 1.0f);
}

// The colour of transparent texels does not bleed into their neighbours.
TEST(ColorTexture, TransparentColoursDoNotBleed)
{
  const std::vector<float> texels = { 1.0f, 0.0f, 0.0f, 1.0f, 0.0f, 1.0f, 0.0f, 0.0f };
  const ColorTexture texture = Texture(texels, 2, 1, 4);
  for (double u : { 0.0, 0.25, 0.5, 0.75, 1.0 })
  {
    const float alpha = static_cast<float>(1.0 - u);
    EXPECT_EQ(
      At(texture, u, 0.0, Below), alpha * glm::vec3(1.0f, 0.0f, 0.0f) + (1.0f - alpha) * Below);
  }
}

TEST(ColorTexture, UnusableTexelsAreZero)
{
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinite = std::numeric_limits<float>::infinity();
  const std::vector<float> texels = { nan, 0.5f, 1.0f, 1.0f, 0.5f, -1.0f, 1.0f, 1.0f, //
    0.5f, 0.5f, infinite, 1.0f, 0.5f, 0.5f, 0.5f, nan,                                //
    0.5f, 0.5f, 0.5f, 7.0f, 0.0f, 0.0f, 0.0f, 0.0f };
  const ColorTexture texture = Texture(texels, 2, 3, 4);
  EXPECT_EQ(texture.Read(0, 0), glm::vec4(0.0f, 0.5f, 1.0f, 1.0f));
  EXPECT_EQ(texture.Read(1, 0), glm::vec4(0.5f, 0.0f, 1.0f, 1.0f));
  EXPECT_EQ(texture.Read(0, 1), glm::vec4(0.5f, 0.5f, 0.0f, 1.0f));
  EXPECT_EQ(texture.Read(1, 1), glm::vec4(0.0f));
  EXPECT_EQ(texture.Read(0, 2), glm::vec4(0.5f, 0.5f, 0.5f, 1.0f)); // alpha ends at 1
  EXPECT_EQ(texture.CountUnusable(0, 3), 4u);
  EXPECT_EQ(texture.CountUnusable(1, 2), 2u);
  EXPECT_EQ(texture.CountUnusable(2, 3), 0u);
  // Too large for single precision.
  const std::vector<double> large = { 1e300, 1e30, -1e300, -0.0 };
  EXPECT_EQ(Texture(large, 4, 1, 1).CountUnusable(0, 1), 2u);
  EXPECT_EQ(Texture(large, 4, 1, 1).Read(0, 0).x, 0.0f);
  EXPECT_EQ(Texture(large, 4, 1, 1).Read(1, 0).x, 1e30f);
  EXPECT_EQ(Texture(std::vector<std::uint8_t>(4, 0), 4, 1, 1).CountUnusable(0, 1), 0u);
}

TEST(ColorTexture, StretchedCoversTheSamplesFromEdgeToEdge)
{
  const std::vector<float> texels(20, 1.0f);
  ColorTexture texture = Texture(texels, 5, 4, 1);
  auto at = [&](double i, double j)
  { return texture.origin + i * texture.alongI + j * texture.alongJ; };
  texture.Stretch({ 10, 2 }, { 0, 0 }, { 5, 4 }, { 0, 0 });
  EXPECT_EQ(at(-0.5, -0.5), glm::dvec2(-0.5, -0.5));
  EXPECT_EQ(at(9.5, 1.5), glm::dvec2(4.5, 3.5));
  // Parts of both.
  texture.Stretch({ 10, 2 }, { 4, 1 }, { 50, 40 }, { 3, 7 });
  EXPECT_EQ(at(-4.5, -1.5), glm::dvec2(-3.5, -7.5));
  EXPECT_EQ(at(5.5, 0.5), glm::dvec2(46.5, 32.5));
}

TEST(ColorTexture, Overlap)
{
  const std::vector<float> texels(20, 1.0f);
  ColorTexture texture = Texture(texels, 5, 4, 1);
  auto overlaps = [&](double u, double v)
  {
    texture.origin = glm::dvec2(u, v);
    return texture.Overlaps(-0.5, 9.5, -0.5, 6.5); // 10 x 7 samples
  };
  EXPECT_TRUE(overlaps(0.0, 0.0));
  EXPECT_TRUE(overlaps(4.9, 0.0));
  EXPECT_FALSE(overlaps(5.1, 0.0));
  EXPECT_TRUE(overlaps(-9.9, -6.9));
  EXPECT_FALSE(overlaps(-10.1, 0.0));
  EXPECT_FALSE(overlaps(0.0, -7.1));
  EXPECT_FALSE(overlaps(0.0, 4.1));
  // A field turned by 45 degrees whose bounding box meets the texture and whose area does not.
  texture.alongI = glm::dvec2(1.0, 1.0);
  texture.alongJ = glm::dvec2(-1.0, 1.0);
  EXPECT_FALSE(overlaps(10.0, 0.0));
  EXPECT_TRUE(overlaps(9.0, -1.0));
  EXPECT_TRUE(overlaps(3.0, -1.0));
  // Texels much finer than samples: the whole texture within one sample's area.
  texture.alongI = glm::dvec2(100.0, 0.0);
  texture.alongJ = glm::dvec2(0.0, 100.0);
  EXPECT_TRUE(overlaps(-250.0, -250.0));
}
