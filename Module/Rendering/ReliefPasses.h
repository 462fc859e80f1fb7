// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefPasses_h
#define ReliefPasses_h

#include "EffectPlan.h"
#include "RayThickness.h"
#include "ReliefColorLayers.h"
#include "ReliefFieldTextures.h"
#include "ReliefGrid.h"
#include "ReliefPrograms.h"

#include "vtkNew.h"
#include "vtkSmartPointer.h"

#include <array>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

class vtkOpenGLFramebufferObject;
class vtkOpenGLQuadHelper;
class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;

namespace relief
{
class GridTrace;
}

/// One float, or four, for each texel of a grid.
struct ReliefLayer
{
  relief::ReliefGrid grid;
  vtkSmartPointer<vtkTextureObject> texture;

  /// Makes room for a grid; false where OpenGL has none.
  bool Allocate(vtkOpenGLRenderWindow* window, const relief::ReliefGrid& newGrid, int components);
};

/// Sums over lights, those that a scene needs: diffuse, scatter and specular.
struct ReliefSumLayers
{
  relief::ReliefGrid grid;
  relief::SumFeatures features;
  std::array<vtkSmartPointer<vtkTextureObject>, 3> textures;

  bool Allocate(vtkOpenGLRenderWindow* window, const relief::ReliefGrid& newGrid,
    const relief::SumFeatures& newFeatures);
  std::vector<vtkTextureObject*> Used() const;
};

/// A light and its illumination, which may be null where no sum needs it.
struct LitLayer
{
  relief::LightPlan light;
  const ReliefLayer* illumination = nullptr;
};

/// The steps of shading, each a pass over the texels of a grid: the model's programs and what they
/// draw into. They leave OpenGL's state as it was.
class ReliefPasses
{
public:
  explicit ReliefPasses(vtkOpenGLRenderWindow* window);
  ~ReliefPasses();
  ReliefPasses(const ReliefPasses&) = delete;
  void operator=(const ReliefPasses&) = delete;

  ReliefFieldTextures& GetField() { return this->Field; }

  /// The scene whose lights and colours are drawn, over a field, which must stay until they are.
  /// Rays are traced by a program, or by the processor, which then fills the texture.
  void SetScene(const relief::HeightField& field, const relief::Scene& scene, bool onProcessor);

  /// Gets ready for bands of a light over a grid: to be called before the first Trace().
  void BeginTrace(const relief::LightPlan& light, const relief::ReliefGrid& grid);

  ///@{
  /// Each returns whether it could be done; what could not is in GetProblem().
  ///
  /// Traces a light for the rows [begin, end) of a layer of one float. Bands that end where
  /// EndOfBand() tells trace nothing twice.
  bool Trace(const relief::LightPlan& light, const ReliefLayer& layer, int begin, int end);
  /// Sets sums to 0.
  bool Clear(const ReliefSumLayers& sums);
  /// Adds lights to sums, or begins new ones with them, in as few passes as can be.
  bool Gather(const std::vector<LitLayer>& lights, const ReliefSumLayers& sums, bool add);
  /// Makes colours of sums, of which either may be null, and of the material's colours or those of
  /// its textures.
  bool Compose(const ReliefSumLayers* first, const ReliefSumLayers* later,
    const glm::dvec3& laterScale, const relief::SumFeatures& features,
    const ReliefColorLayers& textures, const ReliefLayer& colors);
  ///@}

  /// The first row, from `row` on, at which a band of rows may end.
  int EndOfBand(const relief::ReliefGrid& grid, int row) const;

  /// How much work it is to trace a light for a grid, to be compared with others only.
  double EstimateWork(const relief::LightPlan& light, const relief::ReliefGrid& grid) const;

  /// What has been traced by the processor so far.
  const relief::RayCount& GetTracedWork() const { return this->TracedWork; }

  /// What failed last, or an empty text.
  const std::string& GetProblem() const { return this->Problem; }

  /// Waits until all has been drawn.
  void Finish();

  /// Whether the last pass was the first of its program, which takes the time of compiling it.
  bool WasCompiled() const { return this->Compiled; }
  int GetNumberOfPrograms() const { return static_cast<int>(this->Programs.size()); }

private:
  relief::LightFeatures Features(const relief::LightPlan& light) const;
  template <class MakeText>
  vtkOpenGLQuadHelper* UseProgram(
    const std::string& key, const relief::ReliefGrid& grid, MakeText&& makeText);
  void SetLight(vtkShaderProgram* program, const relief::LightPlan& light);
  bool GatherTogether(const LitLayer* lights, int count, const ReliefSumLayers& sums, bool add);
  bool TraceOnProcessor(const ReliefLayer& layer, int begin, int end);
  bool Draw(vtkOpenGLQuadHelper* quad, const std::vector<vtkTextureObject*>& targets, int begin,
    int end, bool add);

  vtkOpenGLRenderWindow* Window;
  const relief::HeightField* Heights = nullptr;
  const relief::Scene* Parameters = nullptr;
  bool OnProcessor = false;
  std::unique_ptr<relief::GridTrace> Tracer; // of the light that is traced on the processor
  relief::RayCount TracedWork;
  std::vector<float> Illumination; // of a band, on its way into a texture
  ReliefFieldTextures Field;
  std::map<std::string, std::unique_ptr<vtkOpenGLQuadHelper>> Programs;
  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
  std::string Problem;
  bool Compiled = false;
};

#endif
