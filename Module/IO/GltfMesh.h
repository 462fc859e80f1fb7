// SPDX-License-Identifier: BSD-3-Clause
#ifndef GltfMesh_h
#define GltfMesh_h

/// @file
/// The meshes of glTF where its nodes put them. Private to the module.

#include <string>

class vtkCommand;
class vtkPolyData;

namespace relief::io
{

/// Reads all meshes of the default scene, as they stand without animation and skins. Pictures are
/// not looked at. What VTK's loader reports goes to `listener`. Throws a Failure, also for parts
/// that reach beyond the data, which the loader would follow.
void ReadGltf(const std::string& fileName, bool binary, vtkCommand* listener, vtkPolyData* output);

}

#endif
