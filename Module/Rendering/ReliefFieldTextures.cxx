// SPDX-License-Identifier: BSD-3-Clause
#include "ReliefFieldTextures.h"

#include "vtkOpenGLRenderWindow.h"
#include "vtkOpenGLState.h"
#include "vtkShaderProgram.h"
#include "vtkTextureObject.h"

#include "ReliefOpenGL.h"

#include <algorithm>
#include <sstream>

namespace
{
// How many levels ReliefField.glsl has room for: blocks of 4 << 15 cells.
constexpr int MaximumLevels = 16;
}

//------------------------------------------------------------------------------
std::string ReliefTiledTexture::Load(vtkOpenGLRenderWindow* window, const float* values,
  int columns, int rows, int pitch, int components, int maximumSize)
{
  this->Texture = vtkSmartPointer<vtkTextureObject>::New();
  this->Texture->SetContext(window);
  this->Texture->SetMinificationFilter(vtkTextureObject::Nearest);
  this->Texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  this->Texture->SetWrapS(vtkTextureObject::ClampToEdge);
  this->Texture->SetWrapT(vtkTextureObject::ClampToEdge);
  this->TileShift = 0;
  std::ostringstream message;
  message << "there is no texture for " << columns << " x " << rows << " samples: ";
  if (columns <= maximumSize && rows <= maximumSize)
  {
    glPixelStorei(GL_UNPACK_ROW_LENGTH, pitch);
    const bool loaded = this->Texture->Create2DFromRaw(
      columns, rows, components, VTK_FLOAT, const_cast<float*>(values));
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    if (!loaded)
    {
      message << "OpenGL has none of floats";
      return message.str();
    }
    return std::string();
  }

  const int largest = std::min(maximumSize, vtkTextureObject::GetMaximumTextureSize3D(window));
  while ((2 << this->TileShift) <= largest)
  {
    ++this->TileShift;
  }
  const int side = 1 << this->TileShift;
  this->TilesInRow = (columns + side - 1) / side;
  const int tiles = this->TilesInRow * ((rows + side - 1) / side);
  if (tiles > vtkTextureObject::GetMaximumTextureSize3D(window))
  {
    message << tiles << " tiles of " << side << " x " << side << " would be needed, "
            << vtkTextureObject::GetMaximumTextureSize3D(window) << " are possible";
    return message.str();
  }
  if (!this->Texture->Allocate3D(side, side, tiles, components, VTK_FLOAT))
  {
    message << "OpenGL has none of floats";
    return message.str();
  }
  vtkOpenGLState* state = window->GetState();
  state->vtkglPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  this->Texture->Activate();
  glPixelStorei(GL_UNPACK_ROW_LENGTH, pitch);
  for (int tile = 0; tile < tiles; ++tile)
  {
    const int x = tile % this->TilesInRow * side;
    const int y = tile / this->TilesInRow * side;
    glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, tile, std::min(side, columns - x),
      std::min(side, rows - y), 1, components == 1 ? GL_RED : GL_RG, GL_FLOAT,
      values + (static_cast<std::size_t>(y) * pitch + x) * components);
  }
  glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
  this->Texture->Deactivate();
  return std::string();
}

//------------------------------------------------------------------------------
void ReliefTiledTexture::Use(vtkShaderProgram* program, const std::string& name) const
{
  this->Texture->Activate();
  program->SetUniformi(name.c_str(), this->Texture->GetTextureUnit());
  if (this->IsTiled())
  {
    const int tiles[2] = { this->TilesInRow, this->TileShift };
    program->SetUniform2i((name + "Tiles").c_str(), tiles);
  }
}

//------------------------------------------------------------------------------
std::string ReliefFieldTextures::Load(
  vtkOpenGLRenderWindow* window, const relief::HeightField& field, int maximumSize)
{
  if (this->Version == field.GetVersion())
  {
    return std::string();
  }
  this->Version = 0;
  const relief::HeightView<float>& heights = field.GetField().heights;
  this->Size[0] = heights.columns;
  this->Size[1] = heights.rows;
  this->Spacing[0] = heights.spacingX;
  this->Spacing[1] = heights.spacingY;
  this->Top = field.GetTop();
  std::string wrong = this->Heights.Load(window, heights.data, heights.columns, heights.rows,
    static_cast<int>(heights.stepY), 1, maximumSize);
  if (!wrong.empty())
  {
    return wrong;
  }

  // The base level at the left, the others in a column beside it.
  const relief::MinMaxPyramid& pyramid = field.GetPyramid();
  const int levels = std::min(pyramid.GetNumberOfLevels(), MaximumLevels);
  auto blocks = [&](int level, int samples)
  {
    const int cells = 1 << (relief::MinMaxPyramid::BlockShift + level);
    return (samples - 1 + cells - 1) / cells;
  };
  this->LevelX.assign(levels, 0);
  this->LevelY.assign(levels, 0);
  int width = 1;
  int height = 1;
  for (int level = 0; level < levels; ++level)
  {
    this->LevelX[level] = level > 0 ? blocks(0, heights.columns) : 0;
    this->LevelY[level] = level > 1 ? this->LevelY[level - 1] + blocks(level - 1, heights.rows) : 0;
    width = std::max(width, this->LevelX[level] + blocks(level, heights.columns));
    height = std::max(height, this->LevelY[level] + blocks(level, heights.rows));
  }
  std::vector<float> values(2 * static_cast<std::size_t>(width) * height);
  for (int level = 0; level < levels; ++level)
  {
    for (int j = 0; j < blocks(level, heights.rows); ++j)
    {
      float* row = values.data() +
        2 * (static_cast<std::size_t>(this->LevelY[level] + j) * width + this->LevelX[level]);
      for (int i = 0; i < blocks(level, heights.columns); ++i)
      {
        row[2 * i] = pyramid.At(level, i, j).lo;
        row[2 * i + 1] = pyramid.At(level, i, j).hi;
      }
    }
  }
  wrong = this->Bounds.Load(window, values.data(), width, height, width, 2, maximumSize);
  if (wrong.empty())
  {
    this->Version = field.GetVersion();
  }
  return wrong;
}

//------------------------------------------------------------------------------
relief::FieldLayout ReliefFieldTextures::GetLayout() const
{
  relief::FieldLayout layout;
  layout.tiledHeights = this->Heights.IsTiled();
  layout.tiledBounds = this->Bounds.IsTiled();
  return layout;
}

//------------------------------------------------------------------------------
void ReliefFieldTextures::Use(vtkShaderProgram* program) const
{
  this->Heights.Use(program, "reliefHeights");
  this->Bounds.Use(program, "reliefBlocks");
  const int levels = static_cast<int>(this->LevelX.size());
  program->SetUniform2i("reliefSize", this->Size);
  const float spacing[2] = { static_cast<float>(this->Spacing[0]),
    static_cast<float>(this->Spacing[1]) };
  program->SetUniform2f("reliefSpacing", spacing);
  program->SetUniformf("reliefHighest", this->Top);
  program->SetUniformi("reliefLevelCount", levels);
  if (levels > 0)
  {
    program->SetUniform1iv("reliefLevelX", levels, this->LevelX.data());
    program->SetUniform1iv("reliefLevelY", levels, this->LevelY.data());
  }
}

//------------------------------------------------------------------------------
void ReliefFieldTextures::Deactivate() const
{
  this->Bounds.GetTexture()->Deactivate();
  this->Heights.GetTexture()->Deactivate();
}
