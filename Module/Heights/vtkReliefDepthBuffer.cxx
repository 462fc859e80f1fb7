// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefDepthBuffer.h"

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"

#include "HeightInputs.h"

#include <cmath>
#include <limits>

namespace relief::hosts
{

namespace
{
// A camera as its matrices tell, so that every kind of camera will do.
struct CameraFrame
{
  ViewAxes view;
  double shift[3];                   // from the view's frame to the camera's
  vtkNew<vtkMatrix4x4> fromClipping; // to the camera's frame
  double focal = 0.0;                // the focal plane's depth in clipping coordinates

  // A point from clipping coordinates, -1 to 1, to the view's frame.
  void Find(double x, double y, double depth, double point[3]) const
  {
    const double clipping[4] = { x, y, depth, 1.0 };
    double camera[4];
    this->fromClipping->MultiplyPoint(clipping, camera);
    for (int k = 0; k < 3; ++k)
    {
      point[k] = camera[k] / camera[3] - this->shift[k];
    }
  }
};

bool FindCameraFrame(vtkRenderer* renderer, CameraFrame& frame)
{
  vtkCamera* camera = renderer->GetActiveCamera();
  vtkMatrix4x4* toCamera = camera->GetViewTransformMatrix();
  for (int k = 0; k < 3; ++k)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      frame.view.axes[k][axis] = toCamera->GetElement(k, axis);
    }
    frame.shift[k] = toCamera->GetElement(k, 3);
  }
  vtkMatrix4x4* toClipping =
    camera->GetProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0);
  if (!(std::abs(toClipping->Determinant()) > 0.0))
  {
    return false;
  }
  vtkMatrix4x4::Invert(toClipping, frame.fromClipping);
  const double focus[4] = { 0.0, 0.0, -camera->GetDistance(), 1.0 };
  double clipping[4];
  toClipping->MultiplyPoint(focus, clipping);
  frame.focal = clipping[2] / clipping[3];
  return std::isfinite(frame.focal);
}

std::string Place(const CameraFrame& frame, DepthHeights& result)
{
  double first[3];
  double next[3];
  frame.Find(1.0 / result.columns - 1.0, 1.0 / result.rows - 1.0, frame.focal, first);
  frame.Find(3.0 / result.columns - 1.0, 3.0 / result.rows - 1.0, frame.focal, next);
  result.view = frame.view;
  for (int k = 0; k < 2; ++k)
  {
    result.origin[k] = first[k];
    result.spacing[k] = next[k] - first[k];
    if (!std::isfinite(first[k]) || !(result.spacing[k] > 0.0))
    {
      return "the renderer's camera has no room between its planes: call ResetCamera()";
    }
  }
  return {};
}
}

//------------------------------------------------------------------------------
bool FindPixels(vtkRenderer* renderer, int& columns, int& rows)
{
  columns = rows = 0;
  if (!renderer || !renderer->GetRenderWindow())
  {
    return false;
  }
  int x = 0;
  int y = 0;
  renderer->GetTiledSizeAndOrigin(&columns, &rows, &x, &y);
  return columns > 0 && rows > 0;
}

//------------------------------------------------------------------------------
std::string FindDepthFrame(vtkRenderer* renderer, DepthHeights& result)
{
  CameraFrame frame;
  if (!FindPixels(renderer, result.columns, result.rows))
  {
    return "the renderer has no pixels: add it to a window that is not empty";
  }
  return FindCameraFrame(renderer, frame)
    ? Place(frame, result)
    : "the renderer's camera has no room between its planes: call ResetCamera()";
}

//------------------------------------------------------------------------------
std::string ReadDepthHeights(vtkRenderer* renderer, DepthHeights& result)
{
  if (!renderer->GetRenderWindow())
  {
    return "the renderer has no window: add it to one";
  }
  // A window may get its size only now.
  renderer->GetRenderWindow()->Render();
  const std::string wrong = FindDepthFrame(renderer, result);
  if (!wrong.empty())
  {
    return wrong;
  }
  int columns = 0;
  int rows = 0;
  int x = 0;
  int y = 0;
  renderer->GetTiledSizeAndOrigin(&columns, &rows, &x, &y);
  std::vector<float> depths(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  if (renderer->GetRenderWindow()->GetZbufferData(
        x, y, x + columns - 1, y + rows - 1, depths.data()) != VTK_OK)
  {
    return "the window gives no depth buffer";
  }
  CameraFrame frame;
  FindCameraFrame(renderer, frame);
  result.heights.resize(depths.size());
  ForRows(rows,
    [&](int begin, int end)
    {
      for (int row = begin; row < end; ++row)
      {
        for (int column = 0; column < columns; ++column)
        {
          const std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
            static_cast<std::size_t>(column);
          double point[3];
          frame.Find((2.0 * column + 1.0) / columns - 1.0, (2.0 * row + 1.0) / rows - 1.0,
            2.0 * depths[at] - 1.0, point);
          // At the far plane nothing was drawn.
          result.heights[at] =
            depths[at] < 1.0f ? point[2] : std::numeric_limits<double>::quiet_NaN();
        }
      }
    });
  return {};
}

}
