// SPDX-License-Identifier: BSD-3-Clause
#ifndef MeshFileChecks_h
#define MeshFileChecks_h

/// @file
/// What is looked at in a file of a mesh before a reader of VTK is let at it. Private to the
/// module.

#include <string>

namespace relief::io
{

/// Throws a Failure if the content is not what an extension in lower case, with its dot, promises,
/// or if the file has less than its header tells: for PLY, STL, binary glTF and VTK's own formats
/// their first bytes, for the first three the sizes as well, for OBJ that numbers are there and
/// can be read, and that faces have the points that they name. The readers take memory by such
/// numbers, or follow them.
void CheckMeshFile(const std::string& fileName, const std::string& extension);

}

#endif
