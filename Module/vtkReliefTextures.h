// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkReliefTextures_h
#define vtkReliefTextures_h

/// @file
/// Images and colour tables as the model's textures. Private to the module.

#include "SceneShading.h"

#include "vtkSmartPointer.h"
#include "vtkType.h"

#include <array>
#include <string>
#include <tuple>

class vtkDataArray;
class vtkImageData;
class vtkObject;
class vtkScalarsToColors;
class vtkUnsignedCharArray;

/// An image as it comes through a port.
struct vtkReliefTextureInput
{
  vtkImageData* image = nullptr; ///< null where the port has none
  vtkDataArray* scalars = nullptr;
  int whole[6] = { 0, 0, 0, 0, 0, 0 }; ///< the whole extent, of which a distributed image is a part
};

class vtkReliefTextures
{
public:
  /// Adds a colour table, which may be null, and the textures for the diffuse, base and specular
  /// colour to a scene. They are read where they are: heights and textures must outlive the scene.
  /// Warns in the name of the reporter. Returns an empty text, or what is wrong.
  std::string Add(const vtkReliefTextureInput& heights,
    const std::array<vtkReliefTextureInput, 3>& textures, vtkScalarsToColors* table, bool stretch,
    vtkObject* reporter, relief::Scene& scene);

  /// Warns of texels that are negative or not finite, once for each array, where they show: effects
  /// are those of the scene's SceneShading.
  void WarnOfTexels(const relief::Scene& scene, int effects, vtkObject* reporter);

  /// Frees the table's colours.
  void Release();

private:
  relief::ColorTexture MapHeights(const vtkReliefTextureInput& heights, vtkScalarsToColors* table);

  // The table's colours, and what they were made from: modification times are never given twice.
  vtkSmartPointer<vtkUnsignedCharArray> Colors;
  std::tuple<vtkMTimeType, vtkMTimeType, void*, void*> MadeFrom;
  // The arrays of the last update, and those whose texels were counted.
  using Version = std::tuple<vtkMTimeType, const void*>;
  Version Given[3];
  Version Counted[3];
};

#endif
