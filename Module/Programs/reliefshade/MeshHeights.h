// SPDX-License-Identifier: BSD-3-Clause
#ifndef MeshHeights_h
#define MeshHeights_h

#include "RasterFiles.h"

#include <array>
#include <optional>
#include <string>

namespace reliefshade
{

/// How a mesh is looked at; what was not asked for is as vtkDepthToHeightField has it.
struct MeshView
{
  std::optional<std::array<double, 3>> Direction; ///< toward the eye
  std::optional<std::array<double, 3>> Up;        ///< in the picture
  std::optional<int> Resolution;                  ///< samples along the longer side
};

/// Whether a file's extension is that of a mesh.
bool isMesh(const std::string& file);

/// Throws a Failure, of the command line, if there is an option that the kind of input does not
/// take. `normals`: it is a normal map.
void checkMeshOptions(
  const std::string& input, const MeshView& view, const ReadOptions& options, bool normals);

/// Reads a mesh and takes its heights as seen from one side, NaN where nothing is seen; they have
/// the unit of their spacing, which is the mesh's. `bytesPerSample` as for readRaster(). Throws a
/// Failure that names the file.
Raster readMesh(
  const std::string& file, const MeshView& view, MemoryBudget& budget, double bytesPerSample);

}

#endif
