// SPDX-License-Identifier: BSD-3-Clause
#ifndef LightFrame_h
#define LightFrame_h

#include "LightCompass.h"

#include "vtkNew.h"

class vtkImageData;
class vtkLight;
class vtkMatrix4x4;
class vtkProp3D;
class vtkRenderer;

namespace relief::widget
{
/// Where a relief is in the world and on the display: VTK's lights in the relief's frame and back.
/// vtkReliefLightRepresentation.h has the rules. Private to the module.
class LightFrame
{
public:
  LightFrame();
  ~LightFrame();

  /// The heights' z at the image's plane.
  double ImageHeight = 0.0;

  ///@{
  /// Takes the place of an image or of bounds and returns half the relief's size. False if the
  /// image's geometry is singular or not finite; then the place is kept.
  bool Place(vtkImageData* heights, double halfSize[2]);
  void Place(const double bounds[6], double halfSize[2]);
  ///@}
  void Copy(const LightFrame& other);

  /// False if the light's numbers are not finite or it has no direction.
  bool Read(vtkLight* light, PlacedLight& placed) const;

  /// False if the light's own transform is singular. A sun keeps its focal point and how far away
  /// it stands; only what was a lamp gets those of vtkReliefScene::AddSun.
  bool Write(const PlacedLight& placed, vtkLight* light) const;

  /// A point as the prop, which may be null, shows it in the world.
  void ToShown(vtkProp3D* prop, const double local[3], double world[3]) const;

  /// False behind the camera, and until the renderer has one.
  bool ToDisplay(
    vtkRenderer* renderer, vtkProp3D* prop, const double local[3], double display[2]) const;

  /// Where the line of sight meets a height; false if it does not in front of the camera.
  bool FromDisplay(vtkRenderer* renderer, vtkProp3D* prop, const double display[2], double height,
    double point[2]) const;

private:
  void GetLocalToShown(vtkProp3D* prop, vtkMatrix4x4* matrix) const;

  // Local coordinates are x and y from the middle of the relief, z as heights.
  vtkNew<vtkMatrix4x4> LocalToWorld;
};
}

#endif
