// SPDX-License-Identifier: BSD-3-Clause
#ifndef PictureWriter_h
#define PictureWriter_h

#include "EffectPlan.h"
#include "Scene.h"

namespace relief
{

/// Where results go: arrays over a rectangle of samples, row by row. Any may be null, and null
/// layers cost nothing.
struct Target
{
  int i0 = 0; ///< the sample that stands first in the arrays
  int j0 = 0;
  int width = 0; ///< samples in a row of the arrays
  int rows = 0;  ///< rows in the arrays
  float* rgba = nullptr;
  unsigned char* rgba8 = nullptr;
  float* illumination = nullptr;
  float* thickness = nullptr;
  float* shadow = nullptr;
  float* normals = nullptr; ///< 3 components, as those below
  float* base = nullptr;
  float* diffuse = nullptr;
  float* scatter = nullptr;
  float* specular = nullptr;
};

struct SceneTile;

/// What a picture is made of.
struct PictureParts
{
  glm::vec3 base{};      ///< of samples, where it is not textured
  bool bases = false;    ///< tiles bring their own
  int channels = 3;      ///< of the terms that tiles bring; 1 where all are the same
  bool terms[3] = {};    ///< which of SceneTile's terms tiles bring
  float exposure = 1.0f; ///< a factor
  double illuminationScale = 0.0;
};

/// Writes shaded tiles to a target: the picture, linear or encoded, and the layers.
class PictureWriter
{
public:
  PictureWriter(const Target& target, const PictureParts& parts)
    : Out(target)
    , Parts(parts)
  {
  }

  /// Lets other threads see what this one has written.
  static void Flush();

  /// Writes the samples of a tile that are asked for. Before another thread reads them, this one
  /// calls Flush().
  void Write(const SceneTile& tile) const;

  /// The largest component of the colours of a tile's samples, in the tile's order; NaN where there
  /// are no data or no sample.
  void FindLargest(const SceneTile& tile, float* largest) const;

private:
  Target Out;
  PictureParts Parts;
};

}

#endif
