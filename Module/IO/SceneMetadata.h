// SPDX-License-Identifier: BSD-3-Clause
#ifndef SceneMetadata_h
#define SceneMetadata_h

/// @file
/// What a shaded image says about itself in an OpenEXR file's header. Private to the module.

#include <ImfForward.h>

#include <string>

class vtkImageData;
class vtkReliefScene;

namespace relief::io
{
/// Adds the attributes that Documentation/Layers.md lists: the program's, the image's (with its
/// pixel aspect ratio), and the scene's if it is not null. Returns an empty text, or what is wrong
/// with the image's place.
std::string AddMetadata(vtkImageData* image, vtkReliefScene* scene, Imf::Header& header);
}

#endif
