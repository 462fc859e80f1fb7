// SPDX-License-Identifier: BSD-3-Clause
#include "ReliefPasses.h"

#include "vtkOpenGLFramebufferObject.h"
#include "vtkOpenGLQuadHelper.h"
#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLShaderCache.h"
#include "vtkOpenGLState.h"
#include "vtkReliefThreads.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include "ReliefGridTrace.h"
#include "ReliefOpenGL.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace
{

vtkSmartPointer<vtkTextureObject> NewTexture(
  vtkOpenGLRenderWindow* window, const relief::ReliefGrid& grid, int components)
{
  auto texture = vtkSmartPointer<vtkTextureObject>::New();
  texture->SetContext(window);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
  texture->SetMinificationFilter(vtkTextureObject::Nearest);
  texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  return texture->Allocate2D(grid.size[0], grid.size[1], components, VTK_FLOAT) ? texture : nullptr;
}

void SetColor(vtkShaderProgram* program, const char* name, const glm::dvec3& color)
{
  const float values[3] = { static_cast<float>(color.x), static_cast<float>(color.y),
    static_cast<float>(color.z) };
  program->SetUniform3f(name, values);
}

void SetFalloff(vtkShaderProgram* program, const char* name, const relief::f64::ReliefFalloff& f)
{
  SetColor(program, name, glm::dvec3(f.lo, f.hi, f.power));
}

// Sets the uniforms of a grid, by their prefix.
void SetGrid(vtkShaderProgram* program, const std::string& prefix, const relief::ReliefGrid& grid)
{
  const float stride[2] = { static_cast<float>(grid.stride[0]),
    static_cast<float>(grid.stride[1]) };
  program->SetUniform2i((prefix + "First").c_str(), grid.first);
  program->SetUniform2f((prefix + "Stride").c_str(), stride);
  program->SetUniform2i((prefix + "Size").c_str(), grid.size);
}

void SetTexture(vtkShaderProgram* program, const char* name, vtkTextureObject* texture,
  std::vector<vtkTextureObject*>& active)
{
  texture->Activate();
  program->SetUniformi(name, texture->GetTextureUnit());
  active.push_back(texture);
}

void Deactivate(const std::vector<vtkTextureObject*>& active)
{
  for (vtkTextureObject* texture : active)
  {
    texture->Deactivate();
  }
}

std::string Key(const char* kind, std::initializer_list<bool> features)
{
  std::string key = kind;
  for (bool feature : features)
  {
    key += feature ? '1' : '0';
  }
  return key;
}

}

//------------------------------------------------------------------------------
bool ReliefLayer::Allocate(
  vtkOpenGLRenderWindow* window, const relief::ReliefGrid& newGrid, int components)
{
  const bool fits =
    this->texture && this->grid.size[0] == newGrid.size[0] && this->grid.size[1] == newGrid.size[1];
  if (!fits)
  {
    this->texture = NewTexture(window, newGrid, components);
  }
  // What has no room holds nothing.
  this->grid = this->texture ? newGrid : relief::ReliefGrid();
  return this->texture != nullptr;
}

//------------------------------------------------------------------------------
bool ReliefSumLayers::Allocate(vtkOpenGLRenderWindow* window, const relief::ReliefGrid& newGrid,
  const relief::SumFeatures& newFeatures)
{
  const bool fits = this->grid.size[0] == newGrid.size[0] && this->grid.size[1] == newGrid.size[1];
  this->grid = newGrid;
  this->features = newFeatures;
  const bool wanted[3] = { newFeatures.diffuse, newFeatures.scatter, newFeatures.specular };
  bool all = true;
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (!wanted[k])
    {
      this->textures[k] = nullptr;
    }
    else if (!fits || !this->textures[k])
    {
      // Four components: OpenGL need not be able to draw into three.
      this->textures[k] = NewTexture(window, newGrid, 4);
      all = all && this->textures[k];
    }
  }
  return all;
}

//------------------------------------------------------------------------------
std::vector<vtkTextureObject*> ReliefSumLayers::Used() const
{
  std::vector<vtkTextureObject*> used;
  for (const auto& texture : this->textures)
  {
    if (texture)
    {
      used.push_back(texture);
    }
  }
  return used;
}

//------------------------------------------------------------------------------
ReliefPasses::ReliefPasses(vtkOpenGLRenderWindow* window)
  : Window(window)
{
  this->Framebuffer->SetContext(window);
}

//------------------------------------------------------------------------------
ReliefPasses::~ReliefPasses() = default;

//------------------------------------------------------------------------------
void ReliefPasses::SetScene(
  const relief::HeightField& field, const relief::Scene& scene, bool onProcessor)
{
  this->Heights = &field;
  this->Parameters = &scene;
  this->OnProcessor = onProcessor;
}

//------------------------------------------------------------------------------
void ReliefPasses::Finish()
{
  glFinish();
}

//------------------------------------------------------------------------------
relief::LightFeatures ReliefPasses::Features(const relief::LightPlan& light) const
{
  const relief::f64::ReliefMedium& medium = this->Parameters->medium;
  relief::LightFeatures features;
  features.positional = light.light.positional;
  features.surfaceNormal = medium.offset == relief::f64::RELIEF_SURFACE_NORMAL;
  features.tangentPlane = medium.offset == relief::f64::RELIEF_TANGENT_PLANE;
  features.exponential = medium.attenuation == relief::f64::RELIEF_EXPONENTIAL;
  features.floor = medium.useFloor;
  features.deep = features.exponential || relief::ToSingle(medium).depth > 0.0f;
  features.fixedStep = this->Parameters->integrator == relief::Integrator::FixedStep;
  features.combined = this->Parameters->response == relief::f64::RELIEF_COMBINED;
  features.igor = this->Parameters->response == relief::f64::RELIEF_IGOR;
  return features;
}

//------------------------------------------------------------------------------
// Makes a program ready, compiled when it is needed first, with the uniforms of field and grid.
template <class MakeText>
vtkOpenGLQuadHelper* ReliefPasses::UseProgram(
  const std::string& key, const relief::ReliefGrid& grid, MakeText&& makeText)
{
  const relief::FieldLayout layout = this->Field.GetLayout();
  std::unique_ptr<vtkOpenGLQuadHelper>& quad =
    this->Programs[Key(key.c_str(), { layout.tiledHeights, layout.tiledBounds })];
  this->Compiled = !quad;
  if (!quad)
  {
    quad = std::make_unique<vtkOpenGLQuadHelper>(
      this->Window, nullptr, makeText(layout).c_str(), nullptr);
  }
  else if (quad->Program)
  {
    this->Window->GetShaderCache()->ReadyShaderProgram(quad->Program);
  }
  if (!quad->Program)
  {
    this->Problem = "a shading program could not be compiled";
    return nullptr;
  }
  this->Field.Use(quad->Program);
  SetGrid(quad->Program, "grid", grid);
  return quad.get();
}

//------------------------------------------------------------------------------
void ReliefPasses::SetLight(vtkShaderProgram* program, const relief::LightPlan& light)
{
  const relief::f32::ReliefMedium medium = relief::ToSingle(this->Parameters->medium);
  program->SetUniformf("mediumDepth", medium.depth);
  program->SetUniformf("mediumDensity", medium.density);
  program->SetUniformf("mediumFloor", medium.floorHeight);
  program->SetUniformf(
    "mediumTolerance", medium.tolerance * static_cast<float>(light.light.toleranceScale));
  glm::dvec3 vector = light.light.vector;
  if (light.light.positional)
  {
    // Farther away than this, a sample more or less does not show.
    constexpr double farthest = 1.0e9;
    const double* spacing = this->Field.GetSpacing();
    int cell[2];
    for (int axis = 0; axis < 2; ++axis)
    {
      const double at = std::floor(vector[axis] / spacing[axis]);
      cell[axis] = static_cast<int>(std::clamp(at, -farthest, farthest));
      vector[axis] -= static_cast<double>(cell[axis]) * spacing[axis];
    }
    program->SetUniform2i("lightSample", cell);
  }
  SetColor(program, "lightVector", vector);
}

//------------------------------------------------------------------------------
// Draws rows of targets of one size, in place of what they hold or in addition to it.
bool ReliefPasses::Draw(vtkOpenGLQuadHelper* quad, const std::vector<vtkTextureObject*>& targets,
  int begin, int end, bool add)
{
  vtkOpenGLState* state = this->Window->GetState();
  vtkOpenGLState::ScopedglViewport viewport(state);
  vtkOpenGLState::ScopedglScissor scissor(state);
  vtkOpenGLState::ScopedglEnableDisable scissorTest(state, GL_SCISSOR_TEST);
  vtkOpenGLState::ScopedglEnableDisable depthTest(state, GL_DEPTH_TEST);
  vtkOpenGLState::ScopedglEnableDisable cullFace(state, GL_CULL_FACE);
  vtkOpenGLState::ScopedglEnableDisable blend(state, GL_BLEND);
  vtkOpenGLState::ScopedglBlendFuncSeparate blendFunction(state);
  vtkOpenGLState::ScopedglDepthMask depthMask(state);
  vtkOpenGLState::ScopedglColorMask colorMask(state);
  vtkOpenGLState::ScopedglClearColor clearColor(state);

  state->PushFramebufferBindings();
  this->Framebuffer->Bind();
  const auto count = static_cast<unsigned int>(targets.size());
  for (unsigned int k = 0; k < count; ++k)
  {
    this->Framebuffer->AddColorAttachment(k, targets[k]);
  }
  this->Framebuffer->ActivateDrawBuffers(count);
  const char* reason = "";
  const bool complete = vtkOpenGLFramebufferObject::GetFrameBufferStatus(
    vtkOpenGLFramebufferObject::GetDrawMode(), reason);
  if (complete)
  {
    const int width = static_cast<int>(targets[0]->GetWidth());
    state->vtkglViewport(0, 0, width, static_cast<int>(targets[0]->GetHeight()));
    state->vtkglEnable(GL_SCISSOR_TEST);
    state->vtkglScissor(0, begin, width, end - begin);
    state->vtkglDisable(GL_DEPTH_TEST);
    state->vtkglDisable(GL_CULL_FACE);
    state->vtkglDepthMask(GL_FALSE);
    state->vtkglColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    if (add)
    {
      state->vtkglEnable(GL_BLEND);
      state->vtkglBlendFuncSeparate(GL_ONE, GL_ONE, GL_ONE, GL_ONE);
    }
    else
    {
      state->vtkglDisable(GL_BLEND);
    }
    if (quad)
    {
      quad->Render();
    }
    else
    {
      state->vtkglClearColor(0.0f, 0.0f, 0.0f, 0.0f);
      state->vtkglClear(GL_COLOR_BUFFER_BIT);
    }
  }
  else
  {
    this->Problem = std::string("OpenGL cannot draw into floats: ") + reason;
  }
  this->Framebuffer->RemoveColorAttachments(count);
  state->PopFramebufferBindings();
  return complete;
}

//------------------------------------------------------------------------------
int ReliefPasses::EndOfBand(const relief::ReliefGrid& grid, int row) const
{
  return this->OnProcessor ? relief::GridTrace::EndOfBand(*this->Heights, grid, row)
                           : std::min(row, grid.size[1]);
}

//------------------------------------------------------------------------------
double ReliefPasses::EstimateWork(
  const relief::LightPlan& light, const relief::ReliefGrid& grid) const
{
  return this->OnProcessor
    ? relief::GridTrace::EstimateWork(*this->Heights, *this->Parameters, light, grid)
    : grid.GetNumberOfTexels();
}

//------------------------------------------------------------------------------
void ReliefPasses::BeginTrace(const relief::LightPlan& light, const relief::ReliefGrid& grid)
{
  this->Tracer = this->OnProcessor
    ? std::make_unique<relief::GridTrace>(*this->Heights, *this->Parameters, light, grid)
    : nullptr;
}

//------------------------------------------------------------------------------
// Traces by the filter's engines and loads what they find into the layer's texture.
bool ReliefPasses::TraceOnProcessor(const ReliefLayer& layer, int begin, int end)
{
  this->Illumination.resize(static_cast<std::size_t>(layer.grid.size[0]) * (end - begin));
  this->Tracer->Trace(
    begin, end, this->Illumination.data(),
    [](int count, const std::function<void(int, int)>& body)
    {
      vtkReliefFor(0, count, 1,
        [&](vtkIdType from, vtkIdType to) { body(static_cast<int>(from), static_cast<int>(to)); });
    },
    this->TracedWork);
  this->Window->GetState()->vtkglPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  layer.texture->Activate();
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, begin, layer.grid.size[0], end - begin, GL_RED, GL_FLOAT,
    this->Illumination.data());
  layer.texture->Deactivate();
  this->Compiled = false;
  return true;
}

//------------------------------------------------------------------------------
bool ReliefPasses::Trace(
  const relief::LightPlan& light, const ReliefLayer& layer, int begin, int end)
{
  if (this->OnProcessor)
  {
    return this->TraceOnProcessor(layer, begin, end);
  }
  const relief::LightFeatures features = this->Features(light);
  vtkOpenGLQuadHelper* quad = this->UseProgram(
    Key("trace",
      { features.positional, features.surfaceNormal, features.tangentPlane, features.exponential,
        features.floor, features.deep, features.fixedStep, features.combined, features.igor }),
    layer.grid,
    [&](const relief::FieldLayout& layout) { return relief::TraceProgram(layout, features); });
  if (!quad)
  {
    return false;
  }
  this->SetLight(quad->Program, light);
  quad->Program->SetUniformi("lightSteps", this->Parameters->steps);
  const bool drawn = this->Draw(quad, { layer.texture }, begin, end, false);
  this->Field.Deactivate();
  return drawn;
}

//------------------------------------------------------------------------------
bool ReliefPasses::Clear(const ReliefSumLayers& sums)
{
  return this->Draw(nullptr, sums.Used(), 0, sums.grid.size[1], false);
}

//------------------------------------------------------------------------------
bool ReliefPasses::Gather(
  const std::vector<LitLayer>& lights, const ReliefSumLayers& sums, bool add)
{
  auto together = [&sums](const LitLayer& a, const LitLayer& b)
  {
    const bool directions =
      !sums.features.NeedsDirection() || (a.light.directional && b.light.directional);
    return directions &&
      (!sums.features.NeedsIllumination() || a.illumination->grid == b.illumination->grid);
  };
  for (std::size_t begin = 0, end = 1; begin < lights.size(); begin = end, ++end)
  {
    while (end < lights.size() && end - begin < relief::MostGathered &&
      together(lights[begin], lights[end]))
    {
      ++end;
    }
    if (!this->GatherTogether(
          &lights[begin], static_cast<int>(end - begin), sums, add || begin > 0))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// Adds lights in one pass.
bool ReliefPasses::GatherTogether(
  const LitLayer* lights, int count, const ReliefSumLayers& sums, bool add)
{
  const relief::LightPlan& first = lights[0].light;
  relief::LightFeatures features = this->Features(first);
  features.positional = !first.directional;
  const relief::SumFeatures& wanted = sums.features;
  vtkOpenGLQuadHelper* quad =
    this->UseProgram(Key(("gather" + std::to_string(count)).c_str(),
                       { features.positional && wanted.NeedsDirection(), features.surfaceNormal,
                         features.tangentPlane, wanted.diffuse, wanted.scatter, wanted.specular }),
      sums.grid,
      [&](const relief::FieldLayout& layout)
      { return relief::GatherProgram(layout, features, wanted, count); });
  if (!quad)
  {
    return false;
  }
  vtkShaderProgram* program = quad->Program;
  std::vector<vtkTextureObject*> active;
  if (wanted.NeedsDirection() && !first.directional)
  {
    this->SetLight(program, first);
  }
  float radiances[relief::MostGathered][3];
  float directions[relief::MostGathered][3];
  for (int k = 0; k < count; ++k)
  {
    for (int c = 0; c < 3; ++c)
    {
      radiances[k][c] = lights[k].light.radiance[c];
      directions[k][c] = lights[k].light.vector[c];
    }
    if (wanted.NeedsIllumination())
    {
      SetTexture(program, ("illumination" + std::to_string(k)).c_str(),
        lights[k].illumination->texture, active);
    }
  }
  program->SetUniform3fv("lightRadiance", count, radiances);
  program->SetUniform3fv("lightToward", count, directions);
  SetFalloff(program, "scatterFalloff", this->Parameters->scatterFalloff);
  SetFalloff(program, "specularFalloff", this->Parameters->specularFalloff);
  if (wanted.NeedsIllumination())
  {
    SetGrid(program, "illumination", lights[0].illumination->grid);
  }
  const bool drawn = this->Draw(quad, sums.Used(), 0, sums.grid.size[1], add);
  Deactivate(active);
  this->Field.Deactivate();
  return drawn;
}

//------------------------------------------------------------------------------
bool ReliefPasses::Compose(const ReliefSumLayers* first, const ReliefSumLayers* later,
  const glm::dvec3& laterScale, const relief::SumFeatures& features,
  const ReliefColorLayers& textures, const ReliefLayer& colors)
{
  relief::ComposeFeatures compose;
  compose.sums = features;
  compose.first = first != nullptr;
  compose.later = later != nullptr;
  compose.baseTexture = textures.GetBase() != nullptr;
  compose.diffuseTexture = features.NeedsIllumination() && textures.GetDiffuse();
  compose.specularTexture = features.specular && textures.GetSpecular();
  vtkOpenGLQuadHelper* quad = this->UseProgram(
    Key("compose",
      { features.diffuse, features.scatter, features.specular, compose.first, compose.later,
        compose.baseTexture, compose.diffuseTexture, compose.specularTexture }),
    colors.grid,
    [&](const relief::FieldLayout& layout) { return relief::ComposeProgram(layout, compose); });
  if (!quad)
  {
    return false;
  }
  vtkShaderProgram* program = quad->Program;
  const float coefficients[2] = { static_cast<float>(this->Parameters->specularCoefficient),
    static_cast<float>(this->Parameters->scatterCoefficient) };
  program->SetUniform2f("coefficients", coefficients);
  SetColor(program, "baseColor", this->Parameters->base);
  SetColor(program, "diffuseColor", this->Parameters->diffuse);
  SetColor(program, "specularColor", this->Parameters->specular);
  std::vector<vtkTextureObject*> active;
  if (compose.baseTexture)
  {
    SetTexture(program, "baseColors", textures.GetBase(), active);
  }
  if (compose.diffuseTexture)
  {
    SetTexture(program, "diffuseColors", textures.GetDiffuse(), active);
  }
  if (compose.specularTexture)
  {
    SetTexture(program, "specularColors", textures.GetSpecular(), active);
  }
  const char* const names[2][3] = { { "firstDiffuse", "firstScatter", "firstSpecular" },
    { "laterDiffuse", "laterScatter", "laterSpecular" } };
  for (int set = 0; set < 2; ++set)
  {
    const ReliefSumLayers* sums = set == 0 ? first : later;
    for (std::size_t k = 0; sums && k < 3; ++k)
    {
      if (sums->textures[k])
      {
        SetTexture(program, names[set][k], sums->textures[k], active);
      }
    }
  }
  if (later)
  {
    SetColor(program, "laterScale", laterScale);
    SetGrid(program, "later", later->grid);
  }
  const bool drawn = this->Draw(quad, { colors.texture }, 0, colors.grid.size[1], false);
  Deactivate(active);
  this->Field.Deactivate();
  return drawn;
}
