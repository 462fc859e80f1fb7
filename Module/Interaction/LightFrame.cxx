// SPDX-License-Identifier: BSD-3-Clause
#include "LightFrame.h"

#include "vtkCamera.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkProp3D.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <cmath>

namespace relief::widget
{

LightFrame::LightFrame() = default;
LightFrame::~LightFrame() = default;

bool LightFrame::Place(vtkImageData* heights, double halfSize[2])
{
  const int* extent = heights->GetExtent();
  const double* spacing = heights->GetSpacing();
  const double* direction = heights->GetDirectionMatrix()->GetData();
  const double* origin = heights->GetOrigin();
  const double size = spacing[0] * spacing[1] * vtkMatrix3x3::Determinant(direction);
  if (!std::isfinite(size + origin[0] + origin[1] + origin[2]) || size == 0.0)
  {
    return false;
  }
  double middle[3] = { 0.0, 0.0, 0.0 };
  for (int axis = 0; axis < 2; ++axis)
  {
    middle[axis] = 0.5 * (extent[2 * axis] + extent[2 * axis + 1]) * spacing[axis];
    halfSize[axis] = 0.5 * (extent[2 * axis + 1] - extent[2 * axis]) * std::abs(spacing[axis]);
  }
  double world[3];
  vtkMatrix3x3::MultiplyPoint(direction, middle, world);
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      this->LocalToWorld->SetElement(row, column, direction[3 * row + column]);
    }
    this->LocalToWorld->SetElement(row, 3, world[row] + origin[row]);
  }
  this->ImageHeight = extent[4] * spacing[2];
  return true;
}

void LightFrame::Place(const double bounds[6], double halfSize[2])
{
  this->LocalToWorld->Identity();
  for (int axis = 0; axis < 3; ++axis)
  {
    this->LocalToWorld->SetElement(axis, 3, 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]));
  }
  halfSize[0] = 0.5 * (bounds[1] - bounds[0]);
  halfSize[1] = 0.5 * (bounds[3] - bounds[2]);
  this->ImageHeight = 0.0;
}

void LightFrame::Copy(const LightFrame& other)
{
  this->LocalToWorld->DeepCopy(other.LocalToWorld);
  this->ImageHeight = other.ImageHeight;
}

bool LightFrame::Read(vtkLight* light, PlacedLight& placed) const
{
  double position[4] = { 0.0, 0.0, 0.0, 1.0 };
  double focal[4] = { 0.0, 0.0, 0.0, 1.0 };
  light->GetTransformedPosition(position);
  light->GetTransformedFocalPoint(focal);
  vtkNew<vtkMatrix4x4> toLocal;
  vtkMatrix4x4::Invert(this->LocalToWorld, toLocal);
  toLocal->MultiplyPoint(position, position);
  placed.Positional = light->GetPositional() != 0;
  if (placed.Positional)
  {
    std::copy_n(position, 3, placed.Vector);
    return std::isfinite(position[0] + position[1] + position[2]);
  }
  toLocal->MultiplyPoint(focal, focal);
  vtkMath::Subtract(position, focal, placed.Vector);
  const double length = vtkMath::Normalize(placed.Vector);
  return std::isfinite(length) && length > 0.0;
}

bool LightFrame::Write(const PlacedLight& placed, vtkLight* light) const
{
  vtkNew<vtkMatrix4x4> fromWorld;
  if (light->GetTransformMatrix())
  {
    if (light->GetTransformMatrix()->Determinant() == 0.0)
    {
      return false;
    }
    vtkMatrix4x4::Invert(light->GetTransformMatrix(), fromWorld);
  }
  double position[4] = { placed.Vector[0], placed.Vector[1], placed.Vector[2],
    placed.Positional ? 1.0 : 0.0 };
  this->LocalToWorld->MultiplyPoint(position, position);
  if (!placed.Positional)
  {
    double distance = 1.0;
    if (light->GetPositional())
    {
      light->SetFocalPoint(0.0, 0.0, 0.0);
    }
    double focal[3];
    light->GetTransformedFocalPoint(focal);
    if (!light->GetPositional())
    {
      double old[3];
      light->GetTransformedPosition(old);
      distance = std::sqrt(vtkMath::Distance2BetweenPoints(old, focal));
    }
    vtkMath::Normalize(position);
    for (int axis = 0; axis < 3; ++axis)
    {
      position[axis] = focal[axis] + distance * position[axis];
    }
    position[3] = 1.0;
  }
  fromWorld->MultiplyPoint(position, position);
  light->SetPositional(placed.Positional);
  light->SetPosition(position);
  return true;
}

void LightFrame::GetLocalToShown(vtkProp3D* prop, vtkMatrix4x4* matrix) const
{
  matrix->DeepCopy(this->LocalToWorld);
  if (prop)
  {
    vtkNew<vtkMatrix4x4> moved;
    prop->GetMatrix(moved);
    vtkMatrix4x4::Multiply4x4(moved, matrix, matrix);
  }
}

void LightFrame::ToShown(vtkProp3D* prop, const double local[3], double world[3]) const
{
  vtkNew<vtkMatrix4x4> shown;
  this->GetLocalToShown(prop, shown);
  double point[4] = { local[0], local[1], local[2], 1.0 };
  shown->MultiplyPoint(point, point);
  std::copy_n(point, 3, world);
}

bool LightFrame::ToDisplay(
  vtkRenderer* renderer, vtkProp3D* prop, const double local[3], double display[2]) const
{
  // Asked for a camera, the renderer would make one that it does not set on what is there.
  if (!renderer->IsActiveCameraCreated())
  {
    return false;
  }
  double point[4] = { 0.0, 0.0, 0.0, 1.0 };
  this->ToShown(prop, local, point);
  renderer->GetActiveCamera()
    ->GetCompositeProjectionTransformMatrix(renderer->GetTiledAspectRatio(), 0.0, 1.0)
    ->MultiplyPoint(point, point);
  // w is the depth in perspective; behind the camera a point would come out upside down.
  if (!(point[3] > 0.0))
  {
    return false;
  }
  renderer->SetViewPoint(point[0] / point[3], point[1] / point[3], point[2] / point[3]);
  renderer->ViewToDisplay();
  std::copy_n(renderer->GetDisplayPoint(), 2, display);
  return std::isfinite(display[0] + display[1]);
}

bool LightFrame::FromDisplay(vtkRenderer* renderer, vtkProp3D* prop, const double display[2],
  double height, double point[2]) const
{
  vtkNew<vtkMatrix4x4> shown;
  vtkNew<vtkMatrix4x4> toLocal;
  this->GetLocalToShown(prop, shown);
  if (!renderer->IsActiveCameraCreated() || shown->Determinant() == 0.0)
  {
    return false;
  }
  vtkMatrix4x4::Invert(shown, toLocal);
  double ends[2][4];
  for (int end = 0; end < 2; ++end)
  {
    renderer->SetDisplayPoint(display[0], display[1], end);
    renderer->DisplayToWorld();
    renderer->GetWorldPoint(ends[end]);
    for (int i = 0; i < 4; ++i)
    {
      ends[end][i] /= renderer->GetWorldPoint()[3];
    }
    toLocal->MultiplyPoint(ends[end], ends[end]);
  }
  const double along = (height - ends[0][2]) / (ends[1][2] - ends[0][2]);
  double hit[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    hit[axis] = ends[0][axis] + along * (ends[1][axis] - ends[0][axis]);
  }
  std::copy_n(hit, 2, point);
  // Not finite where the line runs along the plane; not seen where it meets the plane behind the
  // camera.
  double seen[2];
  return std::isfinite(hit[0] + hit[1] + hit[2]) && this->ToDisplay(renderer, prop, hit, seen);
}

}
