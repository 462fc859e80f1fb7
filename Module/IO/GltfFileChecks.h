// SPDX-License-Identifier: BSD-3-Clause
#ifndef GltfFileChecks_h
#define GltfFileChecks_h

/// @file
/// What is looked at in a file of glTF before VTK's loader follows its numbers. Private to the
/// module.

#include "vtkGLTFDocumentLoader.h"

#include <vtk_jsoncpp.h>

#include <string>
#include <vector>

namespace relief::io
{

/// The JSON of a file. Throws a Failure if there is none, or if it needs an extension that changes
/// its polygons.
Json::Value ReadGltfJson(const std::string& fileName, bool binary);

/// The files beside it that its buffers lie in, as far as they are there. Throws what
/// ReadGltfJson() does.
std::vector<std::string> GltfFiles(const std::string& fileName, bool binary);

/// Makes a model whose descriptions are loaded ready for its data: leaves out what a mesh at rest
/// does not have, and reads the buffers, of which the one inside a binary file is taken from the
/// caller. Throws a Failure for parts that reach beyond the data, or are of no type that can be
/// read. Returns false where the loader left out parts, of which it has reported an error.
bool PrepareGltf(const std::string& fileName, const Json::Value& root, std::vector<char>& inside,
  vtkGLTFDocumentLoader::Model& model);

}

#endif
