// SPDX-License-Identifier: BSD-3-Clause
//
// Textured colours in whole scenes.
#include "ScenePicture.h"

using namespace relief;

namespace
{
// Random colours, one texel for each sample.
struct Texels
{
  Texels(const Terrain& terrain, unsigned int salt)
  {
    Random random(Seed() + salt);
    for (std::size_t k = 0; k < 3 * terrain.heights.size(); ++k)
    {
      this->Values.push_back(static_cast<float>(random.Uniform(0.0, 2.0)));
    }
    this->Texture.texels = this->Values.data();
    this->Texture.type = ColorTexture::Type::Float;
    this->Texture.components = 3;
    this->Texture.columns = terrain.columns;
    this->Texture.rows = terrain.rows;
  }
  glm::dvec3 At(std::size_t k) const
  {
    return glm::dvec3(this->Values[3 * k], this->Values[3 * k + 1], this->Values[3 * k + 2]);
  }
  std::vector<float> Values;
  ColorTexture Texture;
};
}

// A texture sample by sample is the constant colour of each sample in turn.
TEST(SceneTextures, EachSampleHasItsOwnColour)
{
  Terrain terrain = Hills();
  Prepared prepared(terrain);
  Texels base(terrain, 1);
  Texels diffuse(terrain, 2);
  Texels specular(terrain, 3);
  Scene scene = Rich();
  scene.baseTextures = { base.Texture };
  scene.diffuseTextures = { diffuse.Texture };
  scene.specularTextures = { specular.Texture };
  Picture textured = Shade(prepared.Field, scene, AllLayers);
  // White, whose layers the textures multiply.
  Scene white = Rich();
  white.base = white.diffuse = white.specular = glm::dvec3(1.0);
  Picture plain = Shade(prepared.Field, white, AllLayers);
  for (std::size_t k = 0; k < terrain.heights.size(); ++k)
  {
    for (int c = 0; c < 3 && !std::isnan(terrain.heights[k]); ++c)
    {
      const std::size_t at = 3 * k + static_cast<std::size_t>(c);
      EXPECT_NEAR(textured.base[at], plain.base[at] * base.At(k)[c], 1e-6);
      EXPECT_NEAR(textured.diffuse[at], plain.diffuse[at] * diffuse.At(k)[c], 1e-6);
      EXPECT_NEAR(textured.scatter[at], plain.scatter[at] * diffuse.At(k)[c], 1e-6);
      EXPECT_NEAR(textured.specular[at], plain.specular[at] * specular.At(k)[c], 1e-6);
      EXPECT_NEAR(textured.rgba[4 * k + c],
        textured.base[at] + textured.diffuse[at] + textured.scatter[at] + textured.specular[at],
        1e-6);
    }
  }
  EXPECT_TRUE(Equal(textured.rgba, Shade(prepared.Field, scene).rgba));
  EXPECT_TRUE(Equal(textured.illumination, plain.illumination));

  // And one sample's texel as the constant colour of all.
  Random random(Seed());
  for (int round = 0; round < 5; ++round)
  {
    const std::size_t k = random.Integer(0, static_cast<int>(terrain.heights.size()) - 1);
    Scene constant = Rich();
    constant.base = base.At(k);
    constant.diffuse = diffuse.At(k);
    constant.specular = specular.At(k);
    Picture picture = Shade(prepared.Field, constant);
    for (std::size_t c = 0; c < 4; ++c)
    {
      EXPECT_NEAR(picture.rgba[4 * k + c], textured.rgba[4 * k + c], 2e-6);
    }
  }
}

// Later textures lie over earlier ones, all over the constant.
TEST(SceneTextures, TexturesLieOverOneAnother)
{
  Terrain terrain = Hills();
  Prepared prepared(terrain);
  Texels below(terrain, 1);
  const float half[] = { 0.25f, 0.5f };
  ColorTexture above;
  above.texels = half;
  above.type = ColorTexture::Type::Float;
  above.components = 2;
  above.columns = above.rows = 1;
  above.alongI = above.alongJ = glm::dvec2(0.0); // everywhere
  Scene scene;
  scene.medium.depth = 0.8;
  scene.baseTextures = { below.Texture, above };
  Picture picture = Shade(prepared.Field, scene, AllLayers);
  for (std::size_t k = 0; k < terrain.heights.size(); ++k)
  {
    for (int c = 0; c < 3 && !std::isnan(terrain.heights[k]); ++c)
    {
      EXPECT_NEAR(picture.base[3 * k + c], 0.125 + 0.5 * below.At(k)[c], 1e-6);
    }
  }
}

TEST(SceneTextures, PiecesEqualWhole)
{
  Terrain terrain = Hills();
  Prepared prepared(terrain);
  Texels texels(terrain, 4);
  Scene scene = Rich();
  ColorTexture turned = texels.Texture;
  turned.origin = glm::dvec2(3.3, 4.4);
  turned.alongI = glm::dvec2(0.7, 0.2);
  turned.alongJ = glm::dvec2(-0.2, 0.7);
  scene.baseTextures = { turned };
  scene.diffuseTextures = { turned };
  scene.specularTextures = { texels.Texture };
  Picture whole = Shade(prepared.Field, scene, AllLayers);
  Random random(Seed());
  for (int number = 0; number < 3; ++number)
  {
    SCOPED_TRACE(::testing::Message() << "RELIEF_SEED=" << Seed());
    const std::vector<Part> parts = RandomParts(terrain.columns, terrain.rows, random);
    ExpectEqual(Shade(prepared.Field, scene, AllLayers, parts), whole);
  }
}

// Textures are read where their colour shows, and hide that a constant is black.
TEST(SceneTextures, OnlyWhatTheSceneCallsFor)
{
  Terrain terrain = Hills();
  Prepared prepared(terrain);
  Texels texels(terrain, 5);
  auto textured = [&]()
  {
    Scene scene = Plain();
    scene.baseTextures = scene.diffuseTextures = scene.specularTextures = { texels.Texture };
    scene.specularCoefficient = 0.5;
    return scene;
  };
  auto effects = [&](const Scene& scene) { return Shade(prepared.Field, scene).effects; };
  const int highlights = NormalsEffect | SpecularEffect;

  Scene scene = textured();
  EXPECT_EQ(effects(scene),
    IlluminationEffect | highlights | BaseTextureEffect | DiffuseTextureEffect |
      SpecularTextureEffect);
  scene.specularCoefficient = 0.0;
  EXPECT_EQ(effects(scene), IlluminationEffect | BaseTextureEffect | DiffuseTextureEffect);
  scene.specularCoefficient = 1.0;
  EXPECT_EQ(effects(scene), highlights | SpecularTextureEffect);
  EXPECT_EQ(Shade(prepared.Field, scene).rays, 0u);

  scene = textured();
  scene.diffuse = scene.specular = glm::dvec3(0.0);
  EXPECT_EQ(effects(scene), effects(textured()));
  EXPECT_TRUE(Equal(Shade(prepared.Field, scene).rgba, Shade(prepared.Field, textured()).rgba));
  scene.diffuseTextures.clear();
  EXPECT_EQ(effects(scene), highlights | BaseTextureEffect | SpecularTextureEffect);
  scene.specularTextures.clear();
  EXPECT_EQ(effects(scene), BaseTextureEffect);

  // Without light only the base shows.
  scene = textured();
  scene.lights.clear();
  EXPECT_EQ(effects(scene), BaseTextureEffect);
}
