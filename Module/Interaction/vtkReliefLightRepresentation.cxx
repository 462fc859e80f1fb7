// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefLightRepresentation.h"

#include "vtkActor2D.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkProp3D.h"
#include "vtkPropCollection.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkRenderer.h"
#include "vtkWeakPointer.h"

#include "HeightSummary.h"
#include "LightCompass.h"
#include "LightDot.h"
#include "LightFrame.h"

#include <algorithm>
#include <cmath>
#include <vector>

vtkStandardNewMacro(vtkReliefLightRepresentation);

using relief::widget::LightCompass;
using relief::widget::LightDot;
using relief::widget::LightFrame;
using relief::widget::PlacedLight;

namespace
{
const double PixelsPerStep = 5.0;

// The body of a setter of a colour as it is shown.
void SetShown(vtkObject* self, const char* name, const double given[3], double held[3])
{
  double color[3];
  for (int c = 0; c < 3; ++c)
  {
    if (std::isnan(given[c]))
    {
      vtkErrorWithObjectMacro(self,
        "Set" << name << ": (" << given[0] << ", " << given[1] << ", " << given[2]
              << ") was given, three numbers are expected; the old colour is kept.");
      return;
    }
    color[c] = vtkMath::ClampValue(given[c], 0.0, 1.0);
  }
  if (!std::equal(color, color + 3, held))
  {
    std::copy_n(color, 3, held);
    self->Modified();
  }
}
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
  bool LocalToDisplay(const double local[3], double display[2]);
  bool GetDotInDisplay(double display[2]);
  std::vector<relief::widget::Point> GetHorizon();
  void GetDotColor(double color[3]);

  vtkReliefLightRepresentation* Owner;

  LightFrame Frame;
  LightCompass Compass;

  // How far away a sun was when it was a lamp.
  vtkWeakPointer<vtkLight> FormerLamp;
  double FormerDistance = 0.0;

  // While something is dragged.
  vtkWeakPointer<vtkLight> DraggedLight;
  PlacedLight StartLight;
  double StartPosition[3]; // the same, to the last bit
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
  return this->Owner->Draped ? this->UpdateCompass().MeanHeight : this->Frame.ImageHeight;
}

//------------------------------------------------------------------------------
bool vtkReliefLightRepresentation::Internals::GetLight(PlacedLight& placed)
{
  vtkLight* light = this->Owner->GetLight();
  if (!light || !this->Frame.Read(light, placed))
  {
    return false;
  }
  if (!placed.Positional)
  {
    this->Compass.Remember(placed);
  }
  return true;
}

//------------------------------------------------------------------------------
bool vtkReliefLightRepresentation::Internals::SetLight(const PlacedLight& placed)
{
  vtkLight* light = this->Owner->GetLight();
  return light && this->Frame.Write(placed, light);
}

//------------------------------------------------------------------------------
bool vtkReliefLightRepresentation::Internals::LocalToDisplay(
  const double local[3], double display[2])
{
  vtkRenderer* renderer = this->Owner->Renderer;
  return renderer && this->Frame.ToDisplay(renderer, this->Owner->Prop, local, display);
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
void vtkReliefLightRepresentation::SetOutlineColor(double red, double green, double blue)
{
  const double color[3] = { red, green, blue };
  SetShown(this, "OutlineColor", color, this->OutlineColor);
}

//------------------------------------------------------------------------------
void vtkReliefLightRepresentation::SetSelectedOutlineColor(double red, double green, double blue)
{
  const double color[3] = { red, green, blue };
  SetShown(this, "SelectedOutlineColor", color, this->SelectedOutlineColor);
}

//------------------------------------------------------------------------------
void vtkReliefLightRepresentation::PlaceOnHeights(vtkImageData* heights)
{
  vtkDataArray* values = heights ? heights->GetPointData()->GetScalars() : nullptr;
  if (!values || heights->GetNumberOfPoints() < 1)
  {
    vtkErrorMacro(
      "PlaceOnHeights: " << (heights ? "an image without heights" : "null")
                         << " was given, an image with scalars is expected; the place is kept.");
    return;
  }
  if (!this->Internal->Frame.Place(heights, this->Internal->Compass.HalfSize))
  {
    vtkErrorMacro(
      "PlaceOnHeights: an image was given whose origin, spacing or direction matrix is not "
      "finite, or whose spacing is 0 or matrix singular; the place is kept.");
    return;
  }
  this->MeanHeight = relief::hosts::SummarizeHeights(values).mean;
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
  this->Internal->Frame.Place(bounds, this->Internal->Compass.HalfSize);
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
  double dot[3] = { 0.0, 0.0, this->Internal->GetPlaneHeight() };
  this->Internal->UpdateCompass().GetDot(placed, dot);
  this->Internal->Frame.ToShown(this->Prop, dot, position);
  return true;
}

//------------------------------------------------------------------------------
bool vtkReliefLightRepresentation::MoveDot(double displayX, double displayY)
{
  PlacedLight placed;
  const double display[2] = { displayX, displayY };
  double point[2];
  if (!this->Renderer || !this->Internal->GetLight(placed) ||
    !this->Internal->Frame.FromDisplay(
      this->Renderer, this->Prop, display, this->Internal->GetPlaneHeight(), point))
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
  internal.DraggedLight->GetPosition(internal.StartPosition);
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
    this->Internal->DraggedLight->SetPosition(this->Internal->StartPosition);
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
    this->Internal->Frame.Copy(other->Internal->Frame);
    this->Internal->Compass = other->Internal->Compass;
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
