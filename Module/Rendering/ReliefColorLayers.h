// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefColorLayers_h
#define ReliefColorLayers_h

#include "ReliefGrid.h"
#include "SceneShading.h"

#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkTextureObject;

/// The colours of textures at the samples of a grid. Textures are read by the filter's own code,
/// and only where they are seen: on the graphics processor is what a picture needs, whatever their
/// size.
class ReliefColorLayers
{
public:
  /// Reads the textures of a scene that show, by its effects, unless what is there still holds;
  /// `version` changes with them. False where OpenGL has no room.
  bool Update(vtkOpenGLRenderWindow* window, const relief::Scene& scene, int effects,
    const relief::ReliefGrid& grid, int columns, int rows, std::uint64_t version);

  ///@{
  /// One float RGB for each texel of the grid, or null where the colour is the material's.
  vtkTextureObject* GetBase() const { return this->Layers[0].texture; }
  vtkTextureObject* GetDiffuse() const { return this->Layers[1].texture; }
  vtkTextureObject* GetSpecular() const { return this->Layers[2].texture; }
  ///@}

private:
  struct Layer
  {
    vtkSmartPointer<vtkTextureObject> texture;
    relief::ReliefGrid grid;
    std::uint64_t version = 0;
    glm::dvec3 constant = glm::dvec3(0.0);
    std::size_t count = 0; // of textures
  };
  std::array<Layer, 3> Layers;
};

#endif
