// SPDX-License-Identifier: BSD-3-Clause
//
// What a scene does not call for is not done, and what it does, is.
#include "ScenePicture.h"

#include <algorithm>

using namespace relief;

// What the scene does not call for is not done (Documentation/Model.md).
TEST(SceneEffects, OnlyWhatTheSceneCallsFor)
{
  Prepared prepared(Hills());
  auto shade = [&](const Scene& scene, Layers layers = ColorOnly)
  { return Shade(prepared.Field, scene, layers); };

  // Nothing special: rays, and no normals.
  Scene scene = Plain();
  EXPECT_EQ(shade(scene).effects, IlluminationEffect);
  EXPECT_EQ(shade(scene).lightsTraced, 1);
  EXPECT_GT(shade(scene).rays, 0u);
  EXPECT_GT(shade(scene).cells, 0u);

  // A normal offset needs normals.
  scene.medium.offset = f64::RELIEF_SURFACE_NORMAL;
  EXPECT_EQ(shade(scene).effects, IlluminationEffect | NormalsEffect);

  // Highlights need normals, and a black specular colour none.
  scene = Plain();
  scene.specularCoefficient = 0.5;
  EXPECT_EQ(shade(scene).effects, IlluminationEffect | NormalsEffect | SpecularEffect);
  scene.specular = glm::dvec3(0.0);
  EXPECT_EQ(shade(scene).effects, IlluminationEffect);

  // Nothing but highlights: no ray.
  scene = Plain();
  scene.specularCoefficient = 1.0;
  EXPECT_EQ(shade(scene).effects, NormalsEffect | SpecularEffect);
  EXPECT_EQ(shade(scene).rays, 0u);
  EXPECT_EQ(shade(scene).lightsTraced, 0);

  // Scattering.
  scene = Plain();
  scene.scatterCoefficient = 0.5;
  EXPECT_EQ(shade(scene).effects, IlluminationEffect | ScatterEffect);

  // Black surfaces and black lights: no ray.
  scene = Plain();
  scene.diffuse = glm::dvec3(0.0);
  EXPECT_EQ(shade(scene).rays, 0u);
  scene = Plain();
  scene.lights[0].color = glm::dvec3(0.0);
  EXPECT_EQ(shade(scene).rays, 0u);
  scene = Plain();
  scene.lights[0].intensity = 0.0;
  EXPECT_EQ(shade(scene).rays, 0u);
  scene = Plain();
  scene.lights.push_back(Sun(100.0, 20.0));
  scene.lights[0].color = glm::dvec3(0.0);
  EXPECT_EQ(shade(scene).lightsTraced, 1);

  // Below the horizon: no ray, unless there is a floor to come through.
  scene = Plain();
  scene.lights[0] = Sun(315.0, -10.0);
  EXPECT_EQ(shade(scene).rays, 0u);
  EXPECT_EQ(shade(scene).rgba[0], 0.0f);
  scene.medium = WithFloor(scene.medium, -5.0);
  EXPECT_GT(shade(scene).rays, 0u);
  EXPECT_GT(shade(scene).rgba[0], 0.0f);

  // All scattered forward and the light behind the eye: no ray.
  scene = Plain();
  scene.scatterCoefficient = 1.0;
  EXPECT_EQ(shade(scene).rays, 0u);
  scene.lights = { Lamp(35.0, 20.0, 10.0) };
  EXPECT_EQ(shade(scene).rays, 0u);
  scene.lights = { Lamp(35.0, 20.0, -10.0) };
  EXPECT_GT(shade(scene).rays, 0u);
  scene.lights = { Lamp(35.0, 20.0, 0.0) }; // behind some samples only
  std::uint64_t some = shade(scene).rays;
  EXPECT_GT(some, 0u);
  scene.scatterCoefficient = 0.5;
  EXPECT_LT(some, shade(scene).rays);
}

// A layer that is asked for is computed whether the colour shows it or not.
TEST(SceneEffects, LayersCallForTheirEffects)
{
  Terrain terrain = Hills();
  Prepared prepared(terrain);
  auto shade = [&](const Scene& scene, auto choose)
  {
    std::vector<float> layer(3 * terrain.heights.size(), -1.0f);
    Target target;
    target.width = terrain.columns;
    choose(target, layer.data());
    SceneShading shading(prepared.Field, scene, target);
    shading.Shade(0, terrain.columns, 0, terrain.rows);
    return std::make_pair(shading.GetRaysTraced(), layer[0]);
  };
  auto illumination = [](Target& target, float* layer) { target.illumination = layer; };
  auto thickness = [](Target& target, float* layer) { target.thickness = layer; };
  auto normals = [](Target& target, float* layer) { target.normals = layer; };
  float d = shade(Plain(), illumination).second;
  float r = shade(Plain(), thickness).second;
  EXPECT_GT(d, 0.0f);
  EXPECT_NEAR(d, std::min(1.0f, 0.8f / r), 1e-6f);

  // Colours that hide d.
  Scene scene = Plain();
  scene.diffuse = glm::dvec3(0.0);
  EXPECT_EQ(shade(scene, illumination).second, d);
  EXPECT_EQ(shade(scene, thickness).second, r);
  EXPECT_EQ(shade(scene, normals).first, 0u);
  EXPECT_NE(shade(scene, normals).second, -1.0f);
  scene = Plain();
  scene.specularCoefficient = 1.0;
  EXPECT_EQ(shade(scene, illumination).second, d);
  scene = Plain();
  scene.scatterCoefficient = 1.0;
  EXPECT_EQ(shade(scene, illumination).second, d);
  EXPECT_EQ(shade(scene, thickness).second, r);

  // The thickness is that of the first light, exact whatever the tolerance.
  scene = Plain();
  scene.lights.push_back(Sun(100.0, 50.0));
  scene.medium.tolerance = 0.2;
  EXPECT_EQ(shade(scene, thickness).second, r);
  scene.lights[0].color = glm::dvec3(0.0);
  EXPECT_EQ(shade(scene, thickness).second, r);
  scene.lights[0] = Sun(315.0, -10.0);
  EXPECT_TRUE(std::isinf(shade(scene, thickness).second));
}
