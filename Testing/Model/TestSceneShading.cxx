// SPDX-License-Identifier: BSD-3-Clause
//
// Whole scenes: lights add up, layers add up to the colour, and pieces to the whole.
#include "ScenePicture.h"
#include "StepThickness.h"

#include <glm/geometric.hpp>

#include <algorithm>

using namespace relief;

TEST(SceneShading, LightsAddUp)
{
  Prepared prepared(Hills());
  Scene scene = Rich();
  scene.base = glm::dvec3(0.0);
  Picture all = Shade(prepared.Field, scene);
  std::vector<double> sum(all.rgba.size(), 0.0);
  for (const Light& light : Rich().lights)
  {
    scene.lights = { light };
    Picture one = Shade(prepared.Field, scene);
    std::transform(sum.begin(), sum.end(), one.rgba.begin(), sum.begin(), std::plus<double>());
  }
  for (std::size_t k = 0; k < sum.size(); ++k)
  {
    if (k % 4 != 3)
    {
      EXPECT_NEAR(all.rgba[k], sum[k], 1e-6);
    }
  }
  // The same light twice is a light of twice the intensity, or of twice the weight.
  scene = Plain();
  Picture once = Shade(prepared.Field, scene);
  scene.lights.push_back(scene.lights[0]);
  Picture twice = Shade(prepared.Field, scene);
  scene.lights.pop_back();
  scene.lights[0].intensity = 2.0;
  EXPECT_TRUE(Equal(twice.rgba, Shade(prepared.Field, scene).rgba));
  scene.lights[0].intensity = 1.0;
  scene.lights[0].weight = 2.0;
  EXPECT_TRUE(Equal(twice.rgba, Shade(prepared.Field, scene).rgba));
  EXPECT_EQ(twice.rgba[0], 2.0f * once.rgba[0]);
}

TEST(SceneShading, LayersSumToTheColour)
{
  Terrain terrain = Hills();
  Prepared prepared(terrain);
  Picture picture = Shade(prepared.Field, Rich(), AllLayers);
  EXPECT_TRUE(Equal(picture.rgba, Shade(prepared.Field, Rich()).rgba));
  double scattered = 0.0;
  double reflected = 0.0;
  for (std::size_t k = 0; k < terrain.heights.size(); ++k)
  {
    if (std::isnan(terrain.heights[k]))
    {
      continue;
    }
    EXPECT_EQ(picture.rgba[4 * k + 3], 1.0f);
    for (std::size_t c = 0; c < 3; ++c)
    {
      std::size_t at = 3 * k + c;
      EXPECT_NEAR(picture.rgba[4 * k + c],
        picture.base[at] + picture.diffuse[at] + picture.scatter[at] + picture.specular[at], 1e-6);
      scattered += picture.scatter[at];
      reflected += picture.specular[at];
    }
  }
  EXPECT_GT(scattered, 1.0);
  EXPECT_GT(reflected, 1.0);
}

// The layers of one light are the model's own numbers.
TEST(SceneShading, LayersAreTheModelsTerms)
{
  Terrain terrain = Hills();
  for (bool padded : { false, true })
  {
    Prepared prepared(terrain, padded);
    Samples<double> samples(terrain);
    for (const Light& light : Rich().lights)
    {
      Scene scene = Rich();
      scene.lights = { light };
      Picture picture = Shade(prepared.Field, scene, AllLayers);
      Traced<double> traced = Trace<double>(samples.WithoutBounds(), scene.medium, light);
      double ks = scene.specularCoefficient;
      double kf = scene.scatterCoefficient;
      glm::dvec3 radiance = light.color * (light.intensity * light.weight);
      int misses = 0;
      for (int j = 0; j < terrain.rows; ++j)
      {
        for (int i = 0; i < terrain.columns; ++i)
        {
          std::size_t k = static_cast<std::size_t>(j) * terrain.columns + i;
          if (std::isnan(terrain.heights[k]))
          {
            continue;
          }
          glm::dvec3 n = f64::reliefNormal(samples.WithBounds(), i, j);
          glm::dvec3 l = light.vector;
          if (light.positional)
          {
            l = glm::normalize(light.vector -
              glm::dvec3(i * terrain.spacingX, j * terrain.spacingY,
                terrain.heights[k] - scene.medium.depth));
          }
          double f = f64::reliefForwardScatter(scene.scatterFalloff, l);
          double s = f64::reliefSpecularity(scene.specularFalloff, n, l);
          double d = traced.d[k];
          // A sample in a thousand may be off by more, where its ray grazes the surface.
          double r = traced.r[k];
          misses += std::abs(picture.illumination[k] - d) > 1e-5 ||
              std::abs(picture.thickness[k] - r) > 1e-4 * std::max(1.0, r)
            ? 1
            : 0;
          d = picture.illumination[k];
          for (int c = 0; c < 3; ++c)
          {
            std::size_t at = 3 * k + static_cast<std::size_t>(c);
            EXPECT_NEAR(picture.normals[at], n[c], 1e-6);
            EXPECT_NEAR(picture.base[at], (1.0 - ks) * scene.base[c], 1e-6);
            EXPECT_NEAR(picture.diffuse[at],
              (1.0 - ks) * (1.0 - kf) * d * radiance[c] * scene.diffuse[c], 1e-6);
            EXPECT_NEAR(
              picture.scatter[at], (1.0 - ks) * kf * f * d * radiance[c] * scene.diffuse[c], 1e-6);
            EXPECT_NEAR(picture.specular[at], ks * s * radiance[c] * scene.specular[c], 1e-5);
          }
        }
      }
      EXPECT_LE(misses, 3);
    }
  }
}

// Mean d of the lights, weighted by weight times intensity.
TEST(SceneShading, IlluminationIsTheWeightedMean)
{
  Prepared prepared(Hills());
  Scene scene = Rich();
  Picture all = Shade(prepared.Field, scene, AllLayers);
  std::vector<double> sum(all.illumination.size(), 0.0);
  double weights = 0.0;
  for (const Light& light : Rich().lights)
  {
    scene.lights = { light };
    Picture one = Shade(prepared.Field, scene, AllLayers);
    for (std::size_t k = 0; k < sum.size(); ++k)
    {
      sum[k] += light.weight * light.intensity * one.illumination[k];
    }
    weights += light.weight * light.intensity;
  }
  for (std::size_t k = 0; k < sum.size(); ++k)
  {
    if (!std::isnan(sum[k]))
    {
      EXPECT_NEAR(all.illumination[k], sum[k] / weights, 1e-6);
    }
  }
}

TEST(SceneShading, NoLight)
{
  Terrain terrain = Hills();
  Prepared prepared(terrain);
  Scene scene = Rich();
  for (int off = 0; off < 3; ++off)
  {
    scene.lights = off == 0 ? std::vector<Light>() : Rich().lights;
    for (Light& light : scene.lights)
    {
      light.intensity = off == 1 ? 0.0 : light.intensity;
      light.color = off == 2 ? glm::dvec3(0.0) : light.color;
    }
    Picture picture = Shade(prepared.Field, scene);
    EXPECT_EQ(picture.effects, 0);
    EXPECT_EQ(picture.rays, 0u);
    for (std::size_t k = 0; k < terrain.heights.size(); ++k)
    {
      for (int c = 0; c < 3 && !std::isnan(terrain.heights[k]); ++c)
      {
        EXPECT_NEAR(picture.rgba[4 * k + c], 0.7 * scene.base[c], 1e-7);
      }
    }
  }
}

TEST(SceneShading, NoDataIsTransparent)
{
  Terrain terrain = Hills();
  Prepared prepared(terrain);
  Picture picture = Shade(prepared.Field, Rich(), AllLayers);
  int missing = 0;
  for (std::size_t k = 0; k < terrain.heights.size(); ++k)
  {
    bool hasData = !std::isnan(terrain.heights[k]);
    missing += hasData ? 0 : 1;
    for (std::size_t c = 0; c < 4; ++c)
    {
      EXPECT_TRUE(hasData ? std::isfinite(picture.rgba[4 * k + c]) : picture.rgba[4 * k + c] == 0);
      EXPECT_TRUE(hasData || picture.rgba8[4 * k + c] == 0);
    }
    EXPECT_EQ(picture.rgba8[4 * k + 3], hasData ? 255 : 0);
    EXPECT_EQ(std::isnan(picture.illumination[k]), !hasData);
    EXPECT_EQ(std::isnan(picture.thickness[k]), !hasData);
    for (std::size_t c = 0; c < 3; ++c)
    {
      for (const std::vector<float>* layer :
        { &picture.normals, &picture.base, &picture.diffuse, &picture.scatter, &picture.specular })
      {
        EXPECT_EQ(std::isnan((*layer)[3 * k + c]), !hasData);
      }
    }
  }
  EXPECT_GT(missing, 20);
  // Nothing at all to shade.
  Terrain empty(40, 10);
  std::fill(empty.heights.begin(), empty.heights.end(), NoData);
  Prepared nothing(empty);
  picture = Shade(nothing.Field, Rich(), AllLayers);
  EXPECT_TRUE(std::all_of(
    picture.rgba.begin(), picture.rgba.end(), [](float value) { return value == 0.0f; }));
  EXPECT_EQ(picture.rays, 0u);
}

TEST(SceneShading, EightBitIsTheEncodedColour)
{
  Terrain terrain = Hills();
  Prepared prepared(terrain);
  Scene scene = Rich();
  scene.lights[1].intensity = 4.0; // clamped in places
  Picture picture = Shade(prepared.Field, scene, AllLayers);
  int clamped = 0;
  for (std::size_t k = 0; k < picture.rgba.size(); ++k)
  {
    if (k % 4 != 3 && !std::isnan(terrain.heights[k / 4]))
    {
      double code = 255.0 * f64::reliefEncode(picture.rgba[k]);
      clamped += picture.rgba[k] > 1.0f ? 1 : 0;
      // The nearest code, or either of two that are as near.
      EXPECT_LE(std::abs(picture.rgba8[k] - code), 0.5 + 1e-4) << picture.rgba[k];
    }
  }
  EXPECT_GT(clamped, 10);
}

// Pieces in any order, of any size, are the whole, bit for bit.
TEST(SceneShading, PiecesEqualWhole)
{
  Terrain terrain = Hills();
  Random random(Seed());
  for (int variant = 0; variant < 7; ++variant)
  {
    Prepared prepared(terrain, variant != 1);
    Scene scene = Rich();
    scene.medium.tolerance = 0.02;
    scene.medium.offset = variant == 2 ? f64::RELIEF_SURFACE_NORMAL
      : variant >= 4                   ? f64::RELIEF_TANGENT_PLANE
                                       : f64::RELIEF_VERTICAL;
    scene.medium.depth = variant == 5 ? 0.0 : scene.medium.depth;
    scene.medium = variant == 6 ? WithFloor(scene.medium, 0.0) : scene.medium;
    scene.integrator = variant == 3 ? Integrator::FixedStep : Integrator::Exact;
    Picture whole = Shade(prepared.Field, scene, AllLayers);
    for (int number = 0; number < 5; ++number)
    {
      SCOPED_TRACE(::testing::Message() << "RELIEF_SEED=" << Seed() << " variant " << variant);
      const std::vector<Part> parts = RandomParts(terrain.columns, terrain.rows, random);
      ExpectEqual(Shade(prepared.Field, scene, AllLayers, parts), whole);
    }
  }
}

// A rectangle of samples whose arrays start elsewhere than the field.
TEST(SceneShading, TargetOfAPart)
{
  Terrain terrain = Hills();
  Prepared prepared(terrain);
  Picture whole = Shade(prepared.Field, Rich());
  std::vector<float> rgba(4 * 20 * 10);
  Target target;
  target.i0 = 33;
  target.j0 = 17;
  target.width = 20;
  target.rgba = rgba.data();
  SceneShading shading(prepared.Field, Rich(), target);
  shading.Shade(33, 53, 17, 27);
  for (int j = 0; j < 10; ++j)
  {
    for (int i = 0; i < 20 * 4; ++i)
    {
      EXPECT_EQ(rgba[j * 80 + i], whole.rgba[((j + 17) * 75 + 33) * 4 + i]);
    }
  }
}

// Algorithm 1 as it is called by itself.
TEST(SceneShading, FixedStep)
{
  Terrain terrain = Hills();
  Prepared prepared(terrain);
  Scene scene = Plain();
  scene.integrator = Integrator::FixedStep;
  scene.steps = 100;
  Picture picture = Shade(prepared.Field, scene, AllLayers);
  const Field<float>& field = prepared.Field.GetField();
  Light placed = OnBoundingSphere(
    scene.lights[0], field.heights, prepared.Field.GetBottom(), prepared.Field.GetTop());
  std::vector<float> d(terrain.columns, NAN);
  for (int j = 0; j < terrain.rows; ++j)
  {
    RowRequest<float> request;
    request.j = j;
    request.end = terrain.columns;
    request.illumination = d.data();
    RayCount count;
    StepRow(field, ToSingle(scene.medium), placed, 100, request, count);
    for (int i = 0; i < terrain.columns; ++i)
    {
      if (!std::isnan(terrain.At(i, j)))
      {
        EXPECT_NEAR(picture.illumination[j * terrain.columns + i], d[i], 1e-7f);
      }
    }
  }
}

// Beyond a hole of any width the surface goes on as it is, not as it was held, and not where a
// shadow ended before.
TEST(SceneShading, HolesOfAnyWidth)
{
  for (int width = 1; width <= 24; ++width)
  {
    for (double before : { 0.0, 4.0 })
    {
      // Ground, a hole across, a plateau.
      Terrain terrain(34, 45);
      terrain.Fill(
        [=](double, double y) {
          return y < 10.0 ? before : y < 10.0 + width ? NoData : y < 38.0 ? 3.0 : 0.0;
        });
      terrain.At(3, 11) = 1.0;
      Prepared prepared(terrain);
      Samples<double> samples(terrain);
      Scene scene = Plain();
      for (double azimuth : { 0.0, 3.0, 40.0, 180.0 })
      {
        for (double altitude : { 1.0, 4.0, 12.0 })
        {
          SCOPED_TRACE(::testing::Message() << width << ' ' << before << ' ' << azimuth);
          scene.lights[0] = Sun(azimuth, altitude);
          Picture picture = Shade(prepared.Field, scene, AllLayers);
          Traced<double> traced =
            Trace<double>(samples.WithoutBounds(), scene.medium, scene.lights[0]);
          for (std::size_t k = 0; k < traced.d.size(); ++k)
          {
            if (!std::isnan(traced.d[k]))
            {
              ASSERT_NEAR(picture.illumination[k], traced.d[k], 1e-5) << k % 34 << ' ' << k / 34;
            }
          }
        }
      }
    }
  }
}

// A tolerance bounds the error of d in the picture, too.
TEST(SceneShading, Tolerance)
{
  for (bool padded : { false, true })
  {
    Prepared prepared(Hills(), padded);
    Scene scene = Plain();
    scene.lights[0] = Sun(200.0, 8.0);
    Picture exact = Shade(prepared.Field, scene);
    std::uint64_t cells = exact.cells;
    for (double tolerance : { 0.002, 0.02, 0.1 })
    {
      scene.medium.tolerance = tolerance;
      Picture picture = Shade(prepared.Field, scene);
      EXPECT_LE(picture.cells, cells);
      cells = picture.cells;
      for (std::size_t k = 0; k < exact.rgba.size(); ++k)
      {
        ASSERT_NEAR(picture.rgba[k], exact.rgba[k], tolerance + 1e-5);
      }
    }
    EXPECT_LT(cells, exact.cells);
  }
}

TEST(SceneShading, WantsPaddingWhereSunsAreSwept)
{
  relief::Scene scene;
  EXPECT_TRUE(relief::SceneShading::WantsPadding(scene, 64));
  EXPECT_FALSE(relief::SceneShading::WantsPadding(scene, 63));
  scene.medium.useFloor = true;
  EXPECT_TRUE(relief::SceneShading::WantsPadding(scene, 64));
  scene.medium.useFloor = false;
  scene.medium.offset = relief::f64::RELIEF_SURFACE_NORMAL;
  EXPECT_FALSE(relief::SceneShading::WantsPadding(scene, 1000));
  scene.medium.offset = relief::f64::RELIEF_TANGENT_PLANE;
  EXPECT_TRUE(relief::SceneShading::WantsPadding(scene, 64));
  scene.integrator = relief::Integrator::FixedStep;
  EXPECT_FALSE(relief::SceneShading::WantsPadding(scene, 1000));
}
