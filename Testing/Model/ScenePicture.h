// SPDX-License-Identifier: BSD-3-Clause
#ifndef ScenePicture_h
#define ScenePicture_h

/// @file
/// A terrain, scenes and all that shading them gives, for the tests of scenes.

#include "PreparedTerrain.h"

#include "SceneShading.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

// Hills with holes, larger than a tile each way and no multiple of one.
inline Terrain Hills()
{
  Random random(Seed());
  Terrain terrain(75, 45, 1.0, 1.25);
  terrain.Fill([&](double x, double y)
    { return 3.0 * std::sin(0.3 * x) * std::cos(0.25 * y) + random.Uniform(0.0, 0.5); });
  for (int k = 0; k < 40; ++k)
  {
    terrain.At(random.Integer(20, 40), random.Integer(10, 20)) = NoData;
  }
  terrain.RoundToSingle();
  return terrain;
}

// A terrain prepared for shading, padded for the lockstep integrator or not.
struct Prepared
{
  explicit Prepared(const Terrain& terrain, bool padded = true)
  {
    Prepare(terrain, this->Field, padded);
  }
  relief::HeightField Field;
};

// All that a scene can give.
struct Picture
{
  std::vector<float> rgba, illumination, thickness, normals, base, diffuse, scatter, specular;
  std::vector<unsigned char> rgba8;
  int lightsTraced = 0;
  std::uint64_t rays = 0;
  std::uint64_t cells = 0;
  int effects = 0;
};

enum Layers
{
  ColorOnly,
  IlluminationOnly,
  AllLayers
};

struct Part
{
  int i0, i1, j0, j1;
};

inline Picture Shade(const relief::HeightField& field, const relief::Scene& scene,
  Layers layers = ColorOnly, std::vector<Part> parts = {})
{
  int columns = field.GetField().heights.columns;
  int rows = field.GetField().heights.rows;
  std::size_t samples = static_cast<std::size_t>(columns) * rows;
  Picture picture;
  relief::Target target;
  target.width = columns;
  auto layer = [&](std::vector<float>& values, int components)
  {
    values.assign(samples * components, -1.0f);
    return values.data();
  };
  if (layers == IlluminationOnly)
  {
    target.illumination = layer(picture.illumination, 1);
  }
  else
  {
    target.rgba = layer(picture.rgba, 4);
  }
  if (layers == AllLayers)
  {
    picture.rgba8.assign(samples * 4, 77);
    target.rgba8 = picture.rgba8.data();
    target.illumination = layer(picture.illumination, 1);
    target.thickness = layer(picture.thickness, 1);
    target.normals = layer(picture.normals, 3);
    target.base = layer(picture.base, 3);
    target.diffuse = layer(picture.diffuse, 3);
    target.scatter = layer(picture.scatter, 3);
    target.specular = layer(picture.specular, 3);
  }
  relief::SceneShading shading(field, scene, target);
  if (parts.empty())
  {
    parts.push_back({ 0, columns, 0, rows });
  }
  for (const Part& part : parts)
  {
    shading.Shade(part.i0, part.i1, part.j0, part.j1);
  }
  picture.lightsTraced = shading.GetLightsTraced();
  picture.rays = shading.GetRaysTraced();
  picture.cells = shading.GetCellsVisited();
  picture.effects = shading.GetEffects();
  return picture;
}

// Everything at once: a sun, a lamp and a light from below, all effects.
inline relief::Scene Rich()
{
  relief::Scene scene;
  scene.base = glm::dvec3(0.05, 0.1, 0.02);
  scene.diffuse = glm::dvec3(0.9, 0.6, 0.3);
  scene.specular = glm::dvec3(0.5, 0.7, 1.0);
  scene.specularCoefficient = 0.3;
  scene.scatterCoefficient = 0.4;
  scene.specularFalloff = { 0.2, 1.0, 3.0 };
  scene.scatterFalloff = { -1.0, 1.0, 2.0 };
  scene.medium.depth = 0.8;
  scene.lights = { Sun(315.0, 40.0), Lamp(30.3, 20.6, 8.0), Lamp(10.2, 60.7, -3.0) };
  scene.lights[0].color = glm::dvec3(1.0, 0.9, 0.8);
  scene.lights[1].intensity = 0.7;
  scene.lights[2].weight = 0.5;
  return scene;
}

// A scene in which only what the test changes shows: white, one sun.
inline relief::Scene Plain()
{
  relief::Scene scene;
  scene.medium.depth = 0.8;
  scene.lights = { Sun(315.0, 30.0) };
  return scene;
}

inline bool Equal(const std::vector<float>& a, const std::vector<float>& b)
{
  return a.size() == b.size() &&
    std::equal(a.begin(), a.end(), b.begin(),
      [](float x, float y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

// Bit for bit, as the same scene in other pieces must be.
inline void ExpectEqual(const Picture& a, const Picture& b)
{
  EXPECT_TRUE(Equal(a.rgba, b.rgba));
  EXPECT_EQ(a.rgba8, b.rgba8);
  EXPECT_TRUE(Equal(a.illumination, b.illumination));
  EXPECT_TRUE(Equal(a.thickness, b.thickness));
  EXPECT_TRUE(Equal(a.normals, b.normals));
  EXPECT_TRUE(Equal(a.base, b.base));
  EXPECT_TRUE(Equal(a.diffuse, b.diffuse));
  EXPECT_TRUE(Equal(a.scatter, b.scatter));
  EXPECT_TRUE(Equal(a.specular, b.specular));
}

// Cuts a field into rectangles, the upper ones first; some may be empty.
inline std::vector<Part> RandomParts(int columns, int rows, Random& random)
{
  auto cuts = [&](int size)
  {
    std::vector<int> places = { 0, size };
    for (int cut = 0; cut < 4; ++cut)
    {
      places.push_back(random.Integer(0, size));
    }
    std::sort(places.begin(), places.end());
    return places;
  };
  const std::vector<int> x = cuts(columns);
  const std::vector<int> y = cuts(rows);
  std::vector<Part> parts;
  for (std::size_t j = y.size() - 1; j > 0; --j)
  {
    for (std::size_t i = 1; i < x.size(); ++i)
    {
      parts.push_back({ x[i - 1], x[i], y[j - 1], y[j] });
    }
  }
  return parts;
}

#endif
