// SPDX-License-Identifier: BSD-3-Clause
#ifndef SceneText_h
#define SceneText_h

/// @file
/// A scene as JSON, and back; Documentation/SceneFile.md describes it. Private to the module.

#include <string>

class vtkReliefScene;

namespace relief::io
{
/// Images of environments within the folder, which ends in a slash or is empty, are named relative
/// to it. Throws a Failure if the scene cannot be told in text.
std::string SceneToText(vtkReliefScene* scene, const std::string& folder);

/// What a scene's text told beside the scene.
struct SceneTextReport
{
  std::string UnknownKeys; ///< that were left out, as part of a sentence
  bool NamesHeightScale = false;
};

/// Fills a new scene. Throws a Failure that names line and key.
SceneTextReport SceneFromText(
  const std::string& text, const std::string& folder, vtkReliefScene* scene);
}

#endif
