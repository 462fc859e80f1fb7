// SPDX-License-Identifier: BSD-3-Clause
#ifndef SculptedHeights_h
#define SculptedHeights_h

#include "RasterFiles.h"

#include <array>
#include <optional>
#include <string>

namespace reliefshade
{

/// What becomes of heights before light falls on them.
struct Sculpting
{
  /// INPUT is a normal map, whose green points there: of vtkNormalMapToHeightField.
  std::optional<int> Green;
  std::optional<int> Integration; ///< how it becomes heights, of the same
  std::optional<double> Relief;   ///< height of the relief, as a share of the depth
};

/// Throws a Failure, of the command line, for options that do not go together. `tinted`: heights
/// give colours.
void checkSculpting(const Sculpting& sculpting, bool tinted);

/// Reads a picture of normals and makes heights of it, in the unit of its spacing, of those samples
/// that a mask's file shows, if it has a name. Throws a Failure that names the file.
Raster readNormalMap(const std::string& file, const std::string& mask,
  const std::array<double, 2>& spacing, const Sculpting& sculpting, MemoryBudget& budget,
  double bytesPerSample);

/// Squeezes heights into a relief. Throws a Failure that names `heights`.
void squeezeHeights(
  double relief, const std::string& heights, MemoryBudget& budget, Raster& raster);

}

#endif
