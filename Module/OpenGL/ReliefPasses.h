// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefPasses_h
#define ReliefPasses_h

#include "EffectPlan.h"
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

  /// The scene whose lights and colours are drawn.
  void SetScene(const relief::Scene& scene);

  ///@{
  /// Each returns whether it could be done; what could not is in GetProblem().
  ///
  /// Traces a light for the rows [begin, end) of a layer of one float.
  bool Trace(const relief::LightPlan& light, const ReliefLayer& layer, int begin, int end);
  /// Sets sums to 0.
  bool Clear(const ReliefSumLayers& sums);
  /// Adds a light, whose illumination may be null where no sum needs it, to sums.
  bool Gather(
    const relief::LightPlan& light, const ReliefLayer* illumination, const ReliefSumLayers& sums);
  /// Makes colours of sums, of which either may be null, and of the material's colours or those of
  /// its textures.
  bool Compose(const ReliefSumLayers* first, const ReliefSumLayers* later,
    const glm::dvec3& laterScale, const relief::SumFeatures& features,
    const ReliefColorLayers& textures, const ReliefLayer& colors);
  ///@}

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
  bool Draw(vtkOpenGLQuadHelper* quad, const std::vector<vtkTextureObject*>& targets, int begin,
    int end, bool add);

  vtkOpenGLRenderWindow* Window;
  relief::Scene Parameters;
  ReliefFieldTextures Field;
  std::map<std::string, std::unique_ptr<vtkOpenGLQuadHelper>> Programs;
  vtkNew<vtkOpenGLFramebufferObject> Framebuffer;
  std::string Problem;
  bool Compiled = false;
};

#endif
