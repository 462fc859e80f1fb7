// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefFieldTextures_h
#define ReliefFieldTextures_h

#include "HeightField.h"
#include "ReliefPrograms.h"

#include "vtkSmartPointer.h"

#include <cstdint>
#include <string>
#include <vector>

class vtkOpenGLRenderWindow;
class vtkShaderProgram;
class vtkTextureObject;

/// Numbers in a texture; in tiles, the slices of a 3D texture, where they are more in a row or in a
/// column than a texture may have.
class ReliefTiledTexture
{
public:
  /// Loads rows of `components` floats a texel, `pitch` texels from row to row. Returns an empty
  /// text, or what is wrong.
  std::string Load(vtkOpenGLRenderWindow* window, const float* values, int columns, int rows,
    int pitch, int components, int maximumSize);

  bool IsTiled() const { return this->TileShift > 0; }
  vtkTextureObject* GetTexture() const { return this->Texture; }

  /// Activates the texture and sets the uniforms `name` and `nameTiles`.
  void Use(vtkShaderProgram* program, const std::string& name) const;

private:
  vtkSmartPointer<vtkTextureObject> Texture;
  int TileShift = 0; // a tile's side as a power of two
  int TilesInRow = 0;
};

/// A height field and its bounds as the programs read them.
class ReliefFieldTextures
{
public:
  /// Loads a field, unless it is there already. Returns an empty text, or what is wrong.
  std::string Load(
    vtkOpenGLRenderWindow* window, const relief::HeightField& field, int maximumSize);

  relief::FieldLayout GetLayout() const;
  std::uint64_t GetVersion() const { return this->Version; }
  const double* GetSpacing() const { return this->Spacing; }

  /// Activates the textures and sets the uniforms of ReliefField.glsl.
  void Use(vtkShaderProgram* program) const;
  void Deactivate() const;

private:
  ReliefTiledTexture Heights;
  ReliefTiledTexture Bounds;
  std::uint64_t Version = 0; // of the field, 0 for none
  int Size[2] = { 0, 0 };
  double Spacing[2] = { 1.0, 1.0 };
  float Top = 0.0f;
  std::vector<int> LevelX; // where each level of the bounds begins
  std::vector<int> LevelY;
};

#endif
