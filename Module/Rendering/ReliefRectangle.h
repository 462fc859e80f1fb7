// SPDX-License-Identifier: BSD-3-Clause
#ifndef ReliefRectangle_h
#define ReliefRectangle_h

#include "ReliefPasses.h"

#include "vtkNew.h"

class vtkActor;
class vtkImageProperty;
class vtkInformation;
class vtkMatrix4x4;
class vtkOpenGLTexture;
class vtkPlaneCollection;
class vtkPolyData;
class vtkRenderer;
class vtkWindow;

/// The rectangle that shows a grid's colours. VTK's own polygon mapper draws it, which knows
/// cameras, clipping planes, selection and translucency.
class ReliefRectangle
{
public:
  struct Place
  {
    double corners[4][3]; ///< in data coordinates, counter-clockwise
    double samples[4][2]; ///< the same in samples
    vtkMatrix4x4* toWorld = nullptr;
    vtkPlaneCollection* clippingPlanes = nullptr;
    vtkInformation* propertyKeys = nullptr;
  };

  ReliefRectangle();
  ~ReliefRectangle();
  ReliefRectangle(const ReliefRectangle&) = delete;
  void operator=(const ReliefRectangle&) = delete;

  /// Draws colours times an exposure, sRGB-encoded or as they are.
  void Draw(vtkRenderer* renderer, const Place& place, const ReliefLayer& colors,
    vtkImageProperty* property, bool encoded, double exposure);

  /// Draws the backing colour of the property, which shows where there are no data.
  void DrawBacking(vtkRenderer* renderer, const Place& place, vtkImageProperty* property);

  void ReleaseGraphicsResources(vtkWindow* window);

private:
  void SetEncoding(bool encoded);

  vtkNew<vtkPolyData> Polygon;
  vtkNew<vtkActor> Picture;
  vtkNew<vtkActor> Backing;
  vtkNew<vtkOpenGLTexture> Texture;
  int Encoding = -1;
};

#endif
