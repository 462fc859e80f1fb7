// SPDX-License-Identifier: BSD-3-Clause
#ifndef SceneConversion_h
#define SceneConversion_h

/// @file
/// From VTK's lights and scenes to what the model takes. Not installed; functions return an empty
/// text, or what is wrong.

#include "EnvironmentLights.h"
#include "ImageFrame.h"
#include "vtkReliefShadingModule.h" // For export macro

#include "SceneShading.h"

#include <string>

class vtkLightCollection;
class vtkReliefScene;

namespace relief::hosts
{
/// All lights of a scene: those switched on, suns with a disc as several, and the samples of its
/// environment. A scene that has neither lights nor environment takes `otherwise` or, if that is
/// null too, the default sun. They are added to the result, which has none yet.
VTKRELIEFSHADING_EXPORT std::string ConvertLights(vtkReliefScene* scene,
  vtkLightCollection* otherwise, EnvironmentLights& environmentLights, const ImageFrame& frame,
  const HeightField& field, Scene& result);

/// Everything of a scene but its lights.
VTKRELIEFSHADING_EXPORT Scene ConvertMaterial(
  vtkReliefScene* scene, const ImageFrame& frame, double datum);
}

#endif
