// SPDX-License-Identifier: BSD-3-Clause
#ifndef EnvironmentLights_h
#define EnvironmentLights_h

/// @file
/// The lights that stand for an environment, kept until what they depend on changes. Not installed.

#include "ImageFrame.h"

#include "LightSampling.h"
#include "vtkType.h" // For vtkMTimeType

#include <string>
#include <tuple>
#include <vector>

class vtkReliefEnvironment;

namespace relief::hosts
{
class EnvironmentLights
{
public:
  /// The samples of an environment as directional lights in the image's frame; without an image
  /// there are none, and nothing is kept. Warns in the
  /// environment's name of texels that are no colours. Returns an empty text, or what is wrong.
  std::string Sample(
    vtkReliefEnvironment* environment, const ImageFrame& frame, std::vector<Light>& result);

  /// Frees what is kept.
  void Release();

private:
  // Modification times are never given twice.
  RadianceMap Map;
  vtkMTimeType MapTime = 0;
  std::vector<Light> Lights;
  std::tuple<vtkMTimeType, int, int, glm::dmat3> LightsMadeFrom;
};
}

#endif
