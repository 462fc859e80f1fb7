// SPDX-License-Identifier: BSD-3-Clause
#include "ReliefColorLayers.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkReliefThreads.h"
#include "vtkTextureObject.h"

namespace
{

// Lays textures over a colour at every sample of a grid.
std::vector<glm::vec3> Cover(const std::vector<relief::ColorTexture>& textures,
  const glm::dvec3& constant, const relief::ReliefGrid& grid, int columns, int rows)
{
  const int width = grid.size[0];
  std::vector<glm::vec3> colors(
    static_cast<std::size_t>(width) * grid.size[1], glm::vec3(constant));
  vtkReliefFor(0, grid.size[1], 0,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (int y = static_cast<int>(begin); y < end; ++y)
      {
        const int j = grid.SampleOf(1, y, rows);
        glm::vec3* row = colors.data() + static_cast<std::size_t>(y) * width;
        for (const relief::ColorTexture& texture : textures)
        {
          if (grid.stride[0] == 1.0)
          {
            texture.Cover(grid.first[0], grid.first[0] + width, j, row);
            continue;
          }
          for (int x = 0; x < width; ++x)
          {
            const int i = grid.SampleOf(0, x, columns);
            texture.Cover(i, i + 1, j, row + x);
          }
        }
      }
    });
  return colors;
}

}

//------------------------------------------------------------------------------
bool ReliefColorLayers::Update(vtkOpenGLRenderWindow* window, const relief::Scene& scene,
  int effects, const relief::ReliefGrid& grid, int columns, int rows, std::uint64_t version)
{
  const std::vector<relief::ColorTexture>* textures[3] = { &scene.baseTextures,
    &scene.diffuseTextures, &scene.specularTextures };
  const glm::dvec3 constants[3] = { scene.base, scene.diffuse, scene.specular };
  const int shown[3] = { relief::BaseTextureEffect, relief::DiffuseTextureEffect,
    relief::SpecularTextureEffect };
  for (std::size_t k = 0; k < 3; ++k)
  {
    Layer& layer = this->Layers[k];
    if (!(effects & shown[k]))
    {
      layer = Layer();
      continue;
    }
    if (layer.texture && layer.grid == grid && layer.version == version &&
      layer.constant == constants[k] && layer.count == textures[k]->size())
    {
      continue;
    }
    std::vector<glm::vec3> colors = Cover(*textures[k], constants[k], grid, columns, rows);
    layer.texture = vtkSmartPointer<vtkTextureObject>::New();
    layer.texture->SetContext(window);
    if (!layer.texture->Create2DFromRaw(
          grid.size[0], grid.size[1], 3, VTK_FLOAT, &colors.front().x))
    {
      return false;
    }
    layer.grid = grid;
    layer.version = version;
    layer.constant = constants[k];
    layer.count = textures[k]->size();
  }
  return true;
}
