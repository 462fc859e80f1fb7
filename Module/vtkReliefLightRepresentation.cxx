// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefLightRepresentation.h"

#include "vtkActor2D.h"
#include "vtkArrayDispatch.h"
#include "vtkCamera.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkProp3D.h"
#include "vtkPropCollection.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkRenderer.h"
#include "vtkWeakPointer.h"

#include "LightCompass.h"
#include "LightDot.h"

#include <algorithm>
#include <cmath>
#include <vector>

vtkStandardNewMacro(vtkReliefLightRepresentation);

using relief::widget::LightCompass;
using relief::widget::LightDot;
using relief::widget::PlacedLight;

namespace
{
const double PixelsPerStep = 5.0;

// The mean of the values that are finite; 0 if none is.
struct MeanWorker
{
  double Mean = 0.0;

  template <class ArrayType>
  void operator()(ArrayType* array)
  {
    double sum = 0.0;
    vtkIdType count = 0;
    for (const auto stored : vtk::DataArrayValueRange(array))
    {
      const auto value = static_cast<double>(stored);
      if (std::isfinite(value))
      {
        sum += value;
        ++count;
      }
    }
    this->Mean = count > 0 ? sum / static_cast<double>(count) : 0.0;
  }
};
}

class vtkReliefLightRepresentation::Internals
{
public:
  explicit Internals(vtkReliefLightRepresentation* owner)
    : Owner(owner)
  {
  }

  LightCompass& UpdateCompass();
  double GetPlaneHeight();
  bool GetLight(PlacedLight& placed);
  bool SetLight(const PlacedLight& placed);
  void GetLocalToShown(vtkMatrix4x4* matrix);
  bool LocalToDisplay(const double local[3], double display[2]);
  bool DisplayToPlane(const double display[2], double point[2]);
  bool GetDotInDisplay(double display[2]);
  std::vector<relief::widget::Point> GetHorizon();
  void GetDotColor(double color[3]);

  vtkReliefLightRepresentation* Owner;

  // The place. Local coordinates are x and y from the middle of the relief, z as heights.
  vtkNew<vtkMatrix4x4> LocalToWorld;
  double ImageHeight = 0.0; // z of the image's plane
  LightCompass Compass;

  // How far away a sun was when it was a lamp.
  vtkWeakPointer<vtkLight> FormerLamp;
  double FormerDistance = 0.0;

  // While something is dragged.
  vtkWeakPointer<vtkLight> DraggedLight;
  PlacedLight StartLight;
  double DragOffset[2];

  bool Highlighted = false;
  LightDot Dot;
};

//------------------------------------------------------------------------------
// The compass, for what else it depends on may have changed.
LightCompass& vtkReliefLightRepresentation::Internals::UpdateCompass()
{
  vtkReliefScene* scene = this->Owner->Scene;
  this->Compass.PlaceFactor = this->Owner->PlaceFactor;
  this->Compass.MeanHeight = this->Owner->MeanHeight * (scene ? scene->GetHeightScale() : 1.0);
  this->Compass.LowestAltitude = scene && scene->GetMaterial()->GetUseFloor() ? -90.0 : 0.0;
  return this->Compass;
}

//------------------------------------------------------------------------------
double vtkReliefLightRepresentation::Internals::GetPlaneHeight()
{
  return this->Owner->Draped ? this->UpdateCompass().MeanHeight : this->ImageHeight;
}

//------------------------------------------------------------------------------
bool vtkReliefLightRepresentation::Internals::GetLight(PlacedLight& placed)
{
  vtkLight* light = this->Owner->GetLight();
  if (!light)
  {
    return false;
  }
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
  if (!std::isfinite(length) || length == 0.0)
  {
    return false;
  }
  this->Compass.Remember(placed);
  return true;
}

//------------------------------------------------------------------------------
// A light's own coordinates become the world's by its transform. A sun keeps its focal point and
// how far away it stands; only what was a lamp gets those of vtkReliefScene::AddSun.
bool vtkReliefLightRepresentation::Internals::SetLight(const PlacedLight& placed)
{
  vtkLight* light = this->Owner->GetLight();
  vtkNew<vtkMatrix4x4> fromWorld;
  if (!light || (light->GetTransformMatrix() && light->GetTransformMatrix()->Determinant() == 0.0))
  {
    return false;
  }
  if (light->GetTransformMatrix())
  {
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

//------------------------------------------------------------------------------
void vtkReliefLightRepresentation::Internals::GetLocalToShown(vtkMatrix4x4* matrix)
{
  matrix->DeepCopy(this->LocalToWorld);
  if (this->Owner->Prop)
  {
    vtkNew<vtkMatrix4x4> moved;
    this->Owner->Prop->GetMatrix(moved);
    vtkMatrix4x4::Multiply4x4(moved, matrix, matrix);
  }
}

//------------------------------------------------------------------------------
bool vtkReliefLightRepresentation::Internals::LocalToDisplay(
  const double local[3], double display[2])
{
  vtkRenderer* renderer = this->Owner->Renderer;
  if (!renderer)
  {
    return false;
  }
  vtkNew<vtkMatrix4x4> shown;
  this->GetLocalToShown(shown);
  double point[4] = { local[0], local[1], local[2], 1.0 };
  shown->MultiplyPoint(point, point);
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

//------------------------------------------------------------------------------
bool vtkReliefLightRepresentation::Internals::DisplayToPlane(
  const double display[2], double point[2])
{
  vtkRenderer* renderer = this->Owner->Renderer;
  if (!renderer)
  {
    return false;
  }
  vtkNew<vtkMatrix4x4> shown;
  vtkNew<vtkMatrix4x4> toLocal;
  this->GetLocalToShown(shown);
  if (shown->Determinant() == 0.0)
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
  const double along = (this->GetPlaneHeight() - ends[0][2]) / (ends[1][2] - ends[0][2]);
  double hit[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    hit[axis] = ends[0][axis] + along * (ends[1][axis] - ends[0][axis]);
  }
  std::copy_n(hit, 2, point);
  // Not finite where the line runs along the plane; not seen where it meets the plane behind the
  // camera.
  double seen[2];
  return std::isfinite(hit[0] + hit[1] + hit[2]) && this->LocalToDisplay(hit, seen);
}

//------------------------------------------------------------------------------
bool vtkReliefLightRepresentation::Internals::GetDotInDisplay(double display[2])
{
  PlacedLight placed;
  if (!this->GetLight(placed))
  {
    return false;
  }
  double dot[3] = { 0.0, 0.0, this->GetPlaneHeight() };
  this->UpdateCompass().GetDot(placed, dot);
  return this->LocalToDisplay(dot, display);
}

//------------------------------------------------------------------------------
// Empty if a part of it is behind the camera.
std::vector<relief::widget::Point> vtkReliefLightRepresentation::Internals::GetHorizon()
{
  const int sides = 96;
  std::vector<relief::widget::Point> horizon(sides + 1);
  const double radius = this->UpdateCompass().GetRadius();
  for (int i = 0; i <= sides; ++i)
  {
    const double angle = 2.0 * vtkMath::Pi() * i / sides;
    const double local[3] = { radius * std::cos(angle), radius * std::sin(angle),
      this->GetPlaneHeight() };
    if (!this->LocalToDisplay(local, horizon[i].data()))
    {
      return {};
    }
  }
  return horizon;
}

//------------------------------------------------------------------------------
void vtkReliefLightRepresentation::Internals::GetDotColor(double color[3])
{
  vtkLight* light = this->Owner->GetLight();
  light->GetDiffuseColor(color);
  const double brightest = std::max({ color[0], color[1], color[2] });
  const double scale = light->GetSwitch() && brightest > 0.0 ? 1.0 / brightest : 0.0;
  vtkMath::MultiplyScalar(color, scale);
}

//------------------------------------------------------------------------------
vtkReliefLightRepresentation::vtkReliefLightRepresentation()
  : Internal(new Internals(this))
{
  this->PlaceFactor = 1.0;
  this->HandleSize = 7.0;
}

//------------------------------------------------------------------------------
vtkReliefLightRepresentation::~vtkReliefLightRepresentation() = default;

//------------------------------------------------------------------------------
void vtkReliefLightRepresentation::SetScene(vtkReliefScene* scene)
{
  if (this->Scene != scene)
  {
    this->Scene = scene;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkReliefScene* vtkReliefLightRepresentation::GetScene()
{
  return this->Scene;
}

//------------------------------------------------------------------------------
void vtkReliefLightRepresentation::SetLight(vtkLight* light)
{
  if (this->Light != light)
  {
    this->Light = light;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkLight* vtkReliefLightRepresentation::GetLight()
{
  if (!this->Scene)
  {
    return nullptr;
  }
  vtkLightCollection* lights = this->Scene->GetLights();
  if (this->Light)
  {
    return lights->IsItemPresent(this->Light) ? this->Light.Get() : nullptr;
  }
  return vtkLight::SafeDownCast(lights->GetItemAsObject(0));
}

//------------------------------------------------------------------------------
void vtkReliefLightRepresentation::SetProp(vtkProp3D* prop)
{
  if (this->Prop != prop)
  {
    this->Prop = prop;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkProp3D* vtkReliefLightRepresentation::GetProp()
{
  return this->Prop;
}

//------------------------------------------------------------------------------
void vtkReliefLightRepresentation::PlaceWidget(vtkImageData* heights)
{
  vtkDataArray* values = heights ? heights->GetPointData()->GetScalars() : nullptr;
  if (!values || heights->GetNumberOfPoints() < 1)
  {
    vtkErrorMacro(
      "PlaceWidget: " << (heights ? "an image without heights" : "null")
                      << " was given, an image with scalars is expected; the place is kept.");
    return;
  }
  const int* extent = heights->GetExtent();
  const double* spacing = heights->GetSpacing();
  const double* direction = heights->GetDirectionMatrix()->GetData();
  const double* origin = heights->GetOrigin();
  const double size = spacing[0] * spacing[1] * vtkMatrix3x3::Determinant(direction);
  if (!std::isfinite(size + origin[0] + origin[1] + origin[2]) || size == 0.0)
  {
    vtkErrorMacro(
      "PlaceWidget: an image was given whose origin, spacing or direction matrix is not "
      "finite, or whose spacing is 0 or matrix singular; the place is kept.");
    return;
  }
  double middle[3] = { 0.0, 0.0, 0.0 };
  for (int axis = 0; axis < 2; ++axis)
  {
    middle[axis] = 0.5 * (extent[2 * axis] + extent[2 * axis + 1]) * spacing[axis];
    this->Internal->Compass.HalfSize[axis] =
      0.5 * (extent[2 * axis + 1] - extent[2 * axis]) * std::abs(spacing[axis]);
  }
  double world[3];
  vtkMatrix3x3::MultiplyPoint(direction, middle, world);
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 3; ++column)
    {
      this->Internal->LocalToWorld->SetElement(row, column, direction[3 * row + column]);
    }
    this->Internal->LocalToWorld->SetElement(row, 3, world[row] + origin[row]);
  }
  this->Internal->ImageHeight = extent[4] * spacing[2];
  MeanWorker worker;
  if (!vtkArrayDispatch::Dispatch::Execute(values, worker))
  {
    worker(values);
  }
  this->MeanHeight = worker.Mean;
  this->Placed = 1;
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkReliefLightRepresentation::PlaceWidget(double bounds[6])
{
  if (!(bounds[0] <= bounds[1] && bounds[2] <= bounds[3] && bounds[4] <= bounds[5]))
  {
    vtkErrorMacro("PlaceWidget: bounds (" << bounds[0] << ", " << bounds[1] << ", " << bounds[2]
                                          << ", " << bounds[3] << ", " << bounds[4] << ", "
                                          << bounds[5]
                                          << ") were given, minima that are not above their maxima "
                                             "are expected; the place is kept.");
    return;
  }
  this->Internal->LocalToWorld->Identity();
  for (int axis = 0; axis < 3; ++axis)
  {
    this->Internal->LocalToWorld->SetElement(
      axis, 3, 0.5 * (bounds[2 * axis] + bounds[2 * axis + 1]));
  }
  this->Internal->Compass.HalfSize[0] = 0.5 * (bounds[1] - bounds[0]);
  this->Internal->Compass.HalfSize[1] = 0.5 * (bounds[3] - bounds[2]);
  this->Internal->ImageHeight = 0.0;
  this->MeanHeight = 0.0;
  this->Placed = 1;
  this->Modified();
}

//------------------------------------------------------------------------------
bool vtkReliefLightRepresentation::GetDotPosition(double position[3])
{
  PlacedLight placed;
  if (!this->Internal->GetLight(placed))
  {
    return false;
  }
  double dot[4] = { 0.0, 0.0, this->Internal->GetPlaneHeight(), 1.0 };
  this->Internal->UpdateCompass().GetDot(placed, dot);
  vtkNew<vtkMatrix4x4> shown;
  this->Internal->GetLocalToShown(shown);
  shown->MultiplyPoint(dot, dot);
  std::copy_n(dot, 3, position);
  return true;
}

//------------------------------------------------------------------------------
bool vtkReliefLightRepresentation::MoveDot(double displayX, double displayY)
{
  PlacedLight placed;
  const double display[2] = { displayX, displayY };
  double point[2];
  if (!this->Internal->GetLight(placed) || !this->Internal->DisplayToPlane(display, point))
  {
    return false;
  }
  this->Internal->UpdateCompass().SetDot(point, placed);
  return this->Internal->SetLight(placed);
}

//------------------------------------------------------------------------------
bool vtkReliefLightRepresentation::ShiftDot(double pixelsX, double pixelsY)
{
  double display[2];
  return this->Internal->GetDotInDisplay(display) &&
    this->MoveDot(display[0] + pixelsX, display[1] + pixelsY);
}

//------------------------------------------------------------------------------
bool vtkReliefLightRepresentation::RaiseLight(double steps)
{
  PlacedLight placed;
  if (!std::isfinite(steps) || !this->Internal->GetLight(placed))
  {
    return false;
  }
  this->Internal->UpdateCompass().Raise(placed, steps);
  return this->Internal->SetLight(placed);
}

//------------------------------------------------------------------------------
bool vtkReliefLightRepresentation::SwitchLightType()
{
  PlacedLight placed;
  if (!this->Internal->GetLight(placed))
  {
    return false;
  }
  Internals& internal = *this->Internal;
  const LightCompass& compass = internal.UpdateCompass();
  if (placed.Positional)
  {
    internal.FormerLamp = this->GetLight();
    internal.FormerDistance = compass.ToSun(placed);
  }
  else
  {
    compass.ToLamp(placed, internal.FormerLamp == this->GetLight() ? internal.FormerDistance : 0.0);
  }
  return internal.SetLight(placed);
}

//------------------------------------------------------------------------------
int vtkReliefLightRepresentation::ComputeInteractionState(int X, int Y, int vtkNotUsed(modify))
{
  const double near = this->HandleSize + 4.0;
  double dot[2];
  this->InteractionState =
    this->Internal->GetDotInDisplay(dot) && std::hypot(X - dot[0], Y - dot[1]) <= near ? Nearby
                                                                                       : Outside;
  return this->InteractionState;
}

//------------------------------------------------------------------------------
void vtkReliefLightRepresentation::SetInteractionState(int state)
{
  this->InteractionState =
    vtkMath::ClampValue(state, static_cast<int>(Outside), static_cast<int>(Raising));
}

//------------------------------------------------------------------------------
// The dot keeps its distance from the mouse: a press alone moves nothing.
void vtkReliefLightRepresentation::StartWidgetInteraction(double eventPosition[2])
{
  Internals& internal = *this->Internal;
  internal.DraggedLight = nullptr;
  double dot[2];
  if (!internal.GetDotInDisplay(dot) || !internal.GetLight(internal.StartLight))
  {
    this->InteractionState = Outside;
    return;
  }
  internal.DraggedLight = this->GetLight();
  for (int axis = 0; axis < 2; ++axis)
  {
    this->StartEventPosition[axis] = eventPosition[axis];
    internal.DragOffset[axis] = dot[axis] - eventPosition[axis];
  }
}

//------------------------------------------------------------------------------
void vtkReliefLightRepresentation::WidgetInteraction(double eventPosition[2])
{
  Internals& internal = *this->Internal;
  if (!internal.DraggedLight || internal.DraggedLight != this->GetLight())
  {
    internal.DraggedLight = nullptr;
    this->InteractionState = Outside;
    return;
  }
  if (this->InteractionState == Moving)
  {
    this->MoveDot(
      eventPosition[0] + internal.DragOffset[0], eventPosition[1] + internal.DragOffset[1]);
  }
  else if (this->InteractionState == Raising)
  {
    PlacedLight placed = internal.StartLight;
    internal.Compass.Remember(placed);
    internal.UpdateCompass().Raise(
      placed, (eventPosition[1] - this->StartEventPosition[1]) / PixelsPerStep);
    internal.SetLight(placed);
  }
}

//------------------------------------------------------------------------------
void vtkReliefLightRepresentation::EndWidgetInteraction(double eventPosition[2])
{
  this->Internal->DraggedLight = nullptr;
  this->ComputeInteractionState(
    static_cast<int>(eventPosition[0]), static_cast<int>(eventPosition[1]));
}

//------------------------------------------------------------------------------
void vtkReliefLightRepresentation::CancelWidgetInteraction()
{
  if (this->Internal->DraggedLight && this->Internal->DraggedLight == this->GetLight())
  {
    this->Internal->SetLight(this->Internal->StartLight);
  }
}

//------------------------------------------------------------------------------
void vtkReliefLightRepresentation::Highlight(int highlight)
{
  this->Internal->Highlighted = highlight != 0;
}

//------------------------------------------------------------------------------
void vtkReliefLightRepresentation::BuildRepresentation()
{
  Internals& internal = *this->Internal;
  internal.Dot.Clear();
  PlacedLight placed;
  relief::widget::Point center;
  if (internal.GetLight(placed) && internal.GetDotInDisplay(center.data()))
  {
    const double* outline = internal.Highlighted ? this->SelectedOutlineColor : this->OutlineColor;
    if (internal.Highlighted && !placed.Positional)
    {
      internal.Dot.AddLine(internal.GetHorizon(), outline);
    }
    double fill[3];
    internal.GetDotColor(fill);
    internal.Dot.AddDot(center, this->HandleSize, !placed.Positional, outline, fill);
  }
  internal.Dot.Finish();
  this->BuildTime.Modified();
}

//------------------------------------------------------------------------------
int vtkReliefLightRepresentation::RenderOverlay(vtkViewport* viewport)
{
  // Light, camera, window and prop may each have changed; drawing anew costs less than to ask.
  this->BuildRepresentation();
  vtkActor2D* actor = this->Internal->Dot.GetActor();
  return actor->GetVisibility() ? actor->RenderOverlay(viewport) : 0;
}

//------------------------------------------------------------------------------
void vtkReliefLightRepresentation::GetActors2D(vtkPropCollection* actors)
{
  if (actors && this->GetVisibility())
  {
    actors->AddItem(this->Internal->Dot.GetActor());
  }
}

//------------------------------------------------------------------------------
void vtkReliefLightRepresentation::ReleaseGraphicsResources(vtkWindow* window)
{
  this->Internal->Dot.GetActor()->ReleaseGraphicsResources(window);
}

//------------------------------------------------------------------------------
void vtkReliefLightRepresentation::ShallowCopy(vtkProp* prop)
{
  if (auto* other = vtkReliefLightRepresentation::SafeDownCast(prop))
  {
    this->SetScene(other->Scene);
    this->SetLight(other->Light);
    this->SetProp(other->Prop);
    this->SetDraped(other->Draped);
    this->SetOutlineColor(other->OutlineColor);
    this->SetSelectedOutlineColor(other->SelectedOutlineColor);
    this->Internal->LocalToWorld->DeepCopy(other->Internal->LocalToWorld);
    this->Internal->Compass = other->Internal->Compass;
    this->Internal->ImageHeight = other->Internal->ImageHeight;
    this->MeanHeight = other->MeanHeight;
  }
  this->Superclass::ShallowCopy(prop);
}

//------------------------------------------------------------------------------
void vtkReliefLightRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Scene: " << this->Scene.Get() << "\n";
  os << indent << "Light: " << this->Light.Get() << "\n";
  os << indent << "Prop: " << this->Prop.Get() << "\n";
  os << indent << "MeanHeight: " << this->MeanHeight << "\n";
  os << indent << "Draped: " << (this->Draped ? "On\n" : "Off\n");
  os << indent << "OutlineColor: " << this->OutlineColor[0] << " " << this->OutlineColor[1] << " "
     << this->OutlineColor[2] << "\n";
  os << indent << "SelectedOutlineColor: " << this->SelectedOutlineColor[0] << " "
     << this->SelectedOutlineColor[1] << " " << this->SelectedOutlineColor[2] << "\n";
}
