// SPDX-License-Identifier: BSD-3-Clause
//
// The functions of ReliefModel.glsl and ReliefSurface.glsl, and those of ReliefThickness.glsl that
// stand alone.
#include "ReliefModel.h"
#include "TestTerrain.h"
#include "ThicknessOracle.h"

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include <algorithm>

namespace
{
using namespace relief::f64;

constexpr double Infinite = std::numeric_limits<double>::infinity();

glm::dvec3 RandomColor(Random& random)
{
  return glm::dvec3(random.Uniform(0.0, 2.0), random.Uniform(0.0, 2.0), random.Uniform(0.0, 2.0));
}

glm::dvec3 RandomDirection(Random& random, double lowest)
{
  double z = random.Uniform(lowest, 1.0);
  double turn = random.Uniform(0.0, 2.0 * Pi);
  double level = std::sqrt(1.0 - z * z);
  return glm::dvec3(level * std::cos(turn), level * std::sin(turn), z);
}
}

TEST(ModelFunctions, Illumination)
{
  ReliefMedium medium = Sunk(2.0);
  EXPECT_EQ(reliefIllumination(medium, 0.0), 1.0);
  EXPECT_EQ(reliefIllumination(medium, 2.0), 1.0);
  EXPECT_EQ(reliefIllumination(medium, 4.0), 0.5);
  EXPECT_EQ(reliefIllumination(medium, Infinite), 0.0);
  medium.attenuation = RELIEF_EXPONENTIAL;
  medium.density = 0.25;
  EXPECT_EQ(reliefIllumination(medium, 0.0), 1.0);
  EXPECT_EQ(reliefIllumination(medium, 2.0), 1.0);
  EXPECT_DOUBLE_EQ(reliefIllumination(medium, 6.0), std::exp(-1.0));
  EXPECT_EQ(reliefIllumination(medium, Infinite), 0.0);
  medium.density = 0.0;
  EXPECT_EQ(reliefIllumination(medium, 6.0), 1.0);
  // Depth 0: nothing but the point itself is unshadowed.
  medium = Sunk(0.0);
  EXPECT_EQ(reliefIllumination(medium, 0.0), 1.0);
  EXPECT_EQ(reliefIllumination(medium, 1e-300), 0.0);
}

TEST(ModelFunctions, Falloff)
{
  ReliefFalloff whole = { 0.0, 1.0, 1.0 };
  EXPECT_EQ(reliefFalloff(whole, -0.5), 0.0);
  EXPECT_EQ(reliefFalloff(whole, 0.25), 0.25);
  EXPECT_EQ(reliefFalloff(whole, 1.5), 1.0);
  ReliefFalloff narrow = { 0.25, 0.75, 2.0 };
  EXPECT_EQ(reliefFalloff(narrow, 0.25), 0.0);
  EXPECT_EQ(reliefFalloff(narrow, 0.5), 0.25);
  EXPECT_EQ(reliefFalloff(narrow, 0.75), 1.0);
  ReliefFalloff negative = { -1.0, 0.0, 0.5 };
  EXPECT_EQ(reliefFalloff(negative, -0.75), 0.5);
  // Equal ends are a step at the upper one, whatever the power.
  for (double power : { 0.0, 1.0, 7.0 })
  {
    ReliefFalloff step = { 0.5, 0.5, power };
    EXPECT_EQ(reliefFalloff(step, 0.4999), 0.0);
    EXPECT_EQ(reliefFalloff(step, 0.5), 1.0);
    EXPECT_EQ(reliefFalloff(step, 0.6), 1.0);
  }
  // A power of 0 is 1 for every x: 0 to the power of 0 is 1 as well.
  ReliefFalloff flat = { 0.0, 1.0, 0.0 };
  for (double x : { -1.0, 0.0, 0.5, 1.0, 2.0 })
  {
    EXPECT_EQ(reliefFalloff(flat, x), 1.0);
  }
}

TEST(ModelFunctions, Specularity)
{
  // All of [-1, 1], so that s tells R.l: s = (1 + R.l) / 2.
  ReliefFalloff all = { -1.0, 1.0, 1.0 };
  auto cosine = [&](const glm::dvec3& n, const glm::dvec3& l)
  { return 2.0 * reliefSpecularity(all, n, l) - 1.0; };
  // Level ground reflects the zenith; a slope of 45 degrees toward +x reflects +x.
  EXPECT_NEAR(cosine(glm::dvec3(0.0, 0.0, 1.0), Toward(70.0, 30.0)), 0.5, 1e-15);
  glm::dvec3 slope = glm::normalize(glm::dvec3(1.0, 0.0, 1.0));
  EXPECT_NEAR(cosine(slope, glm::dvec3(1.0, 0.0, 0.0)), 1.0, 1e-15);
  EXPECT_NEAR(cosine(slope, glm::dvec3(0.0, 0.0, 1.0)), 0.0, 1e-15);
  Random random(Seed());
  for (int k = 0; k < 1000; ++k)
  {
    glm::dvec3 n = RandomDirection(random, 0.0);
    glm::dvec3 l = RandomDirection(random, -1.0);
    glm::dvec3 mirrored = glm::reflect(glm::dvec3(0.0, 0.0, -1.0), n);
    EXPECT_NEAR(cosine(n, l), glm::dot(mirrored, l), 1e-14);
  }
  // Lights behind the reflection do not show.
  ReliefFalloff front = { 0.0, 1.0, 1.0 };
  EXPECT_EQ(reliefSpecularity(front, glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.0, 0.0, -1.0)), 0.0);
}

TEST(ModelFunctions, ForwardScatter)
{
  ReliefFalloff falloff = { 0.0, 1.0, 1.0 };
  EXPECT_EQ(reliefForwardScatter(falloff, glm::dvec3(0.0, 0.0, -1.0)), 1.0);
  EXPECT_NEAR(reliefForwardScatter(falloff, Toward(200.0, -30.0)), 0.5, 1e-15);
  EXPECT_EQ(reliefForwardScatter(falloff, Toward(200.0, 0.0)), 0.0);
  EXPECT_EQ(reliefForwardScatter(falloff, Toward(200.0, 30.0)), 0.0);
}

// The four terms sum to the equation as Documentation/Model.md prints it for one light.
TEST(ModelFunctions, IntegratedEquation)
{
  Random random(Seed());
  for (int k = 0; k < 1000; ++k)
  {
    double ks = random.Uniform(0.0, 1.0);
    double kf = random.Uniform(0.0, 1.0);
    double d = random.Uniform(0.0, 1.0);
    double f = random.Uniform(0.0, 1.0);
    double s = random.Uniform(0.0, 1.0);
    double intensity = random.Uniform(0.0, 3.0);
    glm::dvec3 cB = RandomColor(random);
    glm::dvec3 cD = RandomColor(random);
    glm::dvec3 cS = RandomColor(random);
    glm::dvec3 cL = RandomColor(random);
    glm::dvec3 light = intensity * cL;
    glm::dvec3 sum = reliefBaseTerm(ks, cB) + reliefDiffuseTerm(ks, kf, d, light, cD) +
      reliefScatterTerm(ks, kf, f, d, light, cD) + reliefSpecularTerm(ks, s, light, cS);
    for (int c = 0; c < 3; ++c)
    {
      double expected =
        (1.0 - ks) * (cB[c] + ((1.0 - kf) + kf * f) * d * intensity * cD[c] * cL[c]) +
        ks * s * intensity * cS[c] * cL[c];
      EXPECT_NEAR(sum[c], expected, 1e-14);
    }
  }
}

// By hand, at angles whose sines are known; in codes, which are what cartographers' formulas tell.
TEST(ModelFunctions, CombinedResponse)
{
  const auto code = [](double d, const glm::dvec3& n, const glm::dvec3& l)
  { return reliefEncode(reliefResponse(RELIEF_COMBINED, d, n, l)); };
  const glm::dvec3 up(0.0, 0.0, 1.0);
  // Level ground is white whatever the light.
  EXPECT_NEAR(code(0.0, up, Toward(10.0, 5.0)), 1.0, 1e-7);
  EXPECT_NEAR(code(1.0, up, Toward(10.0, 90.0)), 1.0, 1e-7);
  // A slope of 30 degrees to the south: with light from straight above, under which it is at 30
  // degrees, too; with light from the north, 45 high, away by 75; and in shadow, by 90.
  const glm::dvec3 south = glm::normalize(glm::dvec3(0.0, -0.5, std::sqrt(0.75)));
  EXPECT_NEAR(code(1.0, south, up), 1.0 - 4.0 / 36.0, 1e-6);
  EXPECT_NEAR(
    code(1.0, south, Toward(0.0, 45.0)), 1.0 - 4.0 * (30.0 * 75.0) / (180.0 * 180.0), 1e-6);
  EXPECT_NEAR(code(0.0, south, up), 1.0 - 4.0 * (30.0 * 90.0) / (180.0 * 180.0), 1e-6);
  // Half the light is as an angle of 60 degrees.
  EXPECT_NEAR(code(0.5, south, up), 1.0 - 4.0 * (30.0 * 60.0) / (180.0 * 180.0), 1e-6);
  // A wall in front of a light that is behind it: never below black.
  EXPECT_EQ(code(0.0, glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(-1.0, 0.0, 0.0)), 0.0);
  EXPECT_NEAR(code(1.0, glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(1.0, 0.0, 0.0)), 1.0, 1e-7);
}

TEST(ModelFunctions, IgorResponse)
{
  const auto code = [](const glm::dvec3& n, const glm::dvec3& l)
  { return reliefEncode(reliefResponse(RELIEF_IGOR, 0.0, n, l)); };
  const glm::dvec3 up(0.0, 0.0, 1.0);
  const glm::dvec3 south = glm::normalize(glm::dvec3(0.0, -0.5, std::sqrt(0.75)));
  EXPECT_NEAR(code(up, Toward(10.0, 5.0)), 1.0, 1e-7);
  // Whatever falls to the light is white, by its azimuth alone.
  for (double altitude : { -80.0, 0.0, 20.0, 89.0 })
  {
    EXPECT_NEAR(code(south, Toward(180.0, altitude)), 1.0, 1e-4);
    EXPECT_NEAR(code(south, Toward(90.0, altitude)), 1.0 - 0.5 * (30.0 / 90.0), 1e-5);
    EXPECT_NEAR(code(south, Toward(0.0, altitude)), 1.0 - 30.0 / 90.0, 1e-4);
  }
  // A light that comes from no side.
  EXPECT_NEAR(code(south, up), 1.0, 1e-7);
  EXPECT_NEAR(code(glm::dvec3(0.0, 1.0, 0.0), Toward(180.0, 45.0)), 0.0, 1e-4);
}

// Decoding is IEC 61966-2-1's, and encoding gives every code of 8 and 16 bits back.
template <class Real, class Encode, class Decode>
void TestCodes(Encode&& encode, Decode&& decode, double bound)
{
  for (int most : { 255, 65535 })
  {
    for (int code = 0; code <= most; ++code)
    {
      const double share = static_cast<double>(code) / most;
      const double linear =
        share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
      const Real decoded = decode(static_cast<Real>(share));
      ASSERT_NEAR(decoded, linear, bound);
      ASSERT_EQ(std::lround(encode(decoded) * static_cast<Real>(most)), code);
    }
  }
}

TEST(ModelFunctions, Encoding)
{
  TestCodes<double>([](double c) { return reliefEncode(c); },
    [](double c) { return reliefDecode(c); },
    1e-7); // the constants are single precision
  TestCodes<float>([](float c) { return relief::f32::reliefEncode(c); },
    [](float c) { return relief::f32::reliefDecode(c); }, 1e-6);
  EXPECT_EQ(reliefDecode(-0.5), 0.0);
  EXPECT_EQ(reliefDecode(1.5), 1.0);
  EXPECT_EQ(relief::f32::reliefDecode(1.0f), 1.0f);
  EXPECT_NEAR(reliefEncode(0.18), 0.461356, 1e-6); // mid grey
  EXPECT_NEAR(reliefEncode(0.0031308), 12.92 * 0.0031308, 1e-7);
  EXPECT_EQ(reliefEncode(-1.0), 0.0);
  EXPECT_NEAR(reliefEncode(1.0), 1.0, 1e-7); // its constants are single precision
  EXPECT_EQ(reliefEncode(7.0), reliefEncode(1.0));
  // The greatest code of 8 bits is 255, not 254 or an overflow.
  EXPECT_EQ(static_cast<int>(relief::f32::reliefEncode(1e30f) * 255.0f + 0.5f), 255);
}

// A texel over what lies below: alpha 1 hides it, alpha 0 leaves it.
TEST(ModelFunctions, Over)
{
  const glm::dvec3 texel(0.25, 0.5, 0.125);
  const glm::dvec3 below(0.5, 2.0, 1.0);
  EXPECT_EQ(reliefOver(texel, 1.0, below), texel);
  EXPECT_EQ(reliefOver(glm::dvec3(0.0), 0.0, below), below);
  EXPECT_EQ(reliefOver(texel, 0.5, below), glm::dvec3(0.5, 1.5, 0.625));
}

// The share of [0, 1] in which a + (b - a) u + c u (u - 1) > 0, against the same in long double.
// Raising or lowering the quadratic by the rounding of its coefficients brackets the answer, which
// says how far a nearly double root may be off.
template <class Real, class Share>
void TestInsideShare(Share&& share)
{
  Random random(Seed());
  auto exact = [](long double a, long double b, long double c, long double raise)
  { return oracle::PositiveLength(0.0L, 1.0L, a + raise, (a + b) / 2 - c / 4 + raise, b + raise); };
  for (int k = 0; k < 1000000; ++k)
  {
    Real v[3];
    for (Real& value : v)
    {
      double size = random.Chance(0.5) ? random.Uniform(0.0, 1.0) : random.Logarithmic(1e-9, 1e9);
      value = static_cast<Real>(random.Chance(0.5) ? size : -size);
      value = random.Chance(0.03) ? Real(0) : value;
    }
    switch (random.Integer(0, 19))
    {
      case 0: // level
        v[1] = v[0];
        break;
      case 1: // turns at an end
        v[2] = v[1] - v[0];
        break;
      case 2: // a double root in the middle, to rounding
        v[1] = v[0];
        v[2] = 4 * v[0];
        break;
      default:
        break;
    }
    Real got = share(v[0], v[1], v[2]);
    long double scale = std::abs(v[0]) + std::abs(v[1]) + std::abs(v[2]);
    long double rounding = 8 * scale * std::numeric_limits<Real>::epsilon();
    Real eps = 16 * std::numeric_limits<Real>::epsilon();
    ASSERT_GE(got, exact(v[0], v[1], v[2], -rounding) - eps) << v[0] << ' ' << v[1] << ' ' << v[2];
    ASSERT_LE(got, exact(v[0], v[1], v[2], rounding) + eps) << v[0] << ' ' << v[1] << ' ' << v[2];
  }
}

TEST(ModelFunctions, InsideShareInDouble)
{
  TestInsideShare<double>([](double a, double b, double c) { return reliefInsideShare(a, b, c); });
}

TEST(ModelFunctions, InsideShareInSingle)
{
  TestInsideShare<float>(
    [](float a, float b, float c) { return relief::f32::reliefInsideShare(a, b, c); });
}

// Known quadratics: u (1 - u) - 3 / 16 is positive between 1 / 4 and 3 / 4.
TEST(ModelFunctions, InsideShareOfKnownQuadratics)
{
  EXPECT_EQ(reliefInsideShare(1.0, 2.0, 0.0), 1.0);
  EXPECT_EQ(reliefInsideShare(-1.0, -2.0, 0.0), 0.0);
  EXPECT_EQ(reliefInsideShare(0.0, 0.0, 0.0), 0.0);
  EXPECT_EQ(reliefInsideShare(3.0, -1.0, 0.0), 0.75);
  EXPECT_EQ(reliefInsideShare(-3.0, 1.0, 0.0), 0.25);
  EXPECT_NEAR(reliefInsideShare(-0.1875, -0.1875, -1.0), 0.5, 1e-15);
  EXPECT_NEAR(reliefInsideShare(0.1875, 0.1875, 1.0), 0.5, 1e-15);
  EXPECT_EQ(reliefInsideShare(0.0, 0.0, -1.0), 1.0); // u (1 - u)
  EXPECT_EQ(reliefInsideShare(0.0, 0.0, 1.0), 0.0);
}

TEST(ModelFunctions, Normals)
{
  // A plane's, exactly, at the edges too, with spacings that differ.
  Terrain terrain(7, 6, 2.0, 0.5);
  terrain.Fill([](double x, double y) { return 3.0 * x - 0.25 * y + 7.0; });
  auto normal = [&terrain](int i, int j)
  {
    Samples<double> samples(terrain);
    glm::dvec3 n = reliefNormal(samples.WithBounds(), i, j);
    EXPECT_NEAR(glm::length(n), 1.0, 1e-15);
    EXPECT_NEAR(glm::distance(n, oracle::Normal(terrain, i, j)), 0.0, 1e-15);
    return n;
  };
  glm::dvec3 plane = glm::normalize(glm::dvec3(-3.0, 0.25, 1.0));
  for (int j = 0; j < 6; ++j)
  {
    for (int i = 0; i < 7; ++i)
    {
      EXPECT_NEAR(glm::distance(normal(i, j), plane), 0.0, 1e-15);
    }
  }
  // Central inside, one-sided at the edges: x^2 at spacing 2.
  terrain.Fill([](double x, double) { return x * x; });
  EXPECT_NEAR(normal(3, 3).x / normal(3, 3).z, -12.0, 1e-12);
  EXPECT_NEAR(normal(0, 3).x / normal(0, 3).z, -2.0, 1e-12);
  EXPECT_NEAR(normal(6, 3).x / normal(6, 3).z, -22.0, 1e-12);
  // One-sided beside a hole, level where neither neighbour has data.
  terrain.At(4, 3) = NoData;
  EXPECT_NEAR(normal(3, 3).x / normal(3, 3).z, -10.0, 1e-12);
  terrain.At(2, 3) = NoData;
  EXPECT_EQ(normal(3, 3), glm::dvec3(0.0, 0.0, 1.0));
  terrain = Terrain(1, 1);
  EXPECT_EQ(normal(0, 0), glm::dvec3(0.0, 0.0, 1.0));
}

// Slopes whose squares overflow.
TEST(ModelFunctions, SteepNormals)
{
  Terrain terrain(3, 3);
  terrain.Fill([](double x, double y) { return 1e30 * x - 1e30 * y; });
  Samples<float> samples(terrain);
  for (int j = 0; j < 3; ++j)
  {
    for (int i = 0; i < 3; ++i)
    {
      glm::vec3 n = relief::f32::reliefNormal(samples.WithBounds(), i, j);
      EXPECT_NEAR(n.x, -std::sqrt(0.5f), 1e-6f);
      EXPECT_NEAR(n.y, std::sqrt(0.5f), 1e-6f);
      EXPECT_GE(n.z, 0.0f);
      EXPECT_LE(n.z, 1e-29f);
    }
  }
}
