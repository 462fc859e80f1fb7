// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkReliefConversion_h
#define vtkReliefConversion_h

/// @file
/// From VTK's images, lights and scenes to what the model takes. Private to the module; functions
/// return an empty text, or what is wrong.

#include "SceneShading.h"

#include <string>
#include <vector>

class vtkDataArray;
class vtkImageData;
class vtkLight;
class vtkLightCollection;
class vtkReliefEnvironment;
class vtkReliefScene;

/// The image's own frame: world coordinates with origin and direction taken off, its first sample
/// at (0, 0), x and y growing with the index.
class vtkReliefImageFrame
{
public:
  std::string Assign(vtkImageData* image);

  glm::dvec3 VectorFromWorld(const double world[3]) const;
  glm::dvec3 PointFromWorld(const double world[3]) const;
  bool IsWorld() const;
  void NormalToWorld(float* n) const;

  double Spacing[2] = { 1.0, 1.0 };

private:
  double Origin[3];
  double Direction[9];
  double Inverse[9];
  double Sign[2] = { 1.0, 1.0 };
  double First[2] = { 0.0, 0.0 };
};

/// Checks that an image is one slice of scalars.
std::string vtkReliefCheckImage(vtkImageData* image, vtkDataArray* scalars, const char* what);

/// Checks that an image is one slice of scalars of one component.
std::string vtkReliefCheckInput(vtkImageData* image, vtkDataArray* scalars, const char* what);

/// An image of grey, RGB or either with alpha as a texture whose place is left open.
std::string vtkReliefConvertColors(
  vtkImageData* image, vtkDataArray* scalars, const char* what, relief::ColorTexture& result);

/// One of VTK's lights in the image's frame, above the field's datum.
std::string vtkReliefConvertLight(
  vtkLight* light, const vtkReliefImageFrame& frame, double datum, relief::Light& result);

/// The samples of an environment as directional lights in the image's frame.
class vtkReliefEnvironmentSampler
{
public:
  static std::string Sample(vtkReliefEnvironment* environment, const vtkReliefImageFrame& frame,
    std::vector<relief::Light>& lights);
};

/// All lights of a scene: those switched on, suns with a disc as several, and the samples of its
/// environment. A scene that has neither lights nor environment takes `otherwise` or, if that is
/// null too, the default sun.
std::string vtkReliefConvertLights(vtkReliefScene* scene, vtkLightCollection* otherwise,
  const vtkReliefImageFrame& frame, const relief::HeightField& field,
  std::vector<relief::Light>& result);

/// Everything of a scene but its lights.
relief::Scene vtkReliefConvertMaterial(
  vtkReliefScene* scene, const vtkReliefImageFrame& frame, double datum);

#endif
