// SPDX-License-Identifier: BSD-3-Clause
#include "ReliefView.h"

#include "Document.h"

#include "vtkCallbackCommand.h"
#include "vtkCamera.h"
#include "vtkEvent.h"
#include "vtkGenericOpenGLRenderWindow.h"
#include "vtkImageProperty.h"
#include "vtkImageSlice.h"
#include "vtkInteractorStyleImage.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkObjectFactory.h"
#include "vtkReliefImageMapper.h"
#include "vtkReliefLightRepresentation.h"
#include "vtkReliefLightWidget.h"
#include "vtkReliefScene.h"
#include "vtkReliefStatistics.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkTimerLog.h"
#include "vtkWidgetEventTranslator.h"

#include <QFocusEvent>
#include <QResizeEvent>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace reliefviewer
{

namespace
{
constexpr double StillRate = 0.001;
constexpr double MovingRate = 15.0;
constexpr double DotRadius = 7.0;    // on a screen of usual resolution, as
constexpr double MiddleRadius = 8.0; // where the mouse's direction from the middle is no angle
constexpr double SelectedOutline[3] = { 1.0, 0.85, 0.4 };
constexpr double OtherOutline[3] = { 1.0, 1.0, 1.0 };
}

//------------------------------------------------------------------------------
/// The mouse beside the dots. VTK's own keys are left out: the menus have what they do.
class ReliefView::Style : public vtkInteractorStyleImage
{
public:
  static Style* New();
  vtkTypeMacro(Style, vtkInteractorStyleImage);

  ReliefView* View = nullptr;

  void OnLeftButtonDown() override
  {
    if (!this->Interactor->GetControlKey() || !this->Turn(true))
    {
      this->Pan(true);
    }
  }
  void OnLeftButtonUp() override
  {
    this->Turn(false);
    this->Pan(false);
  }
  void OnMiddleButtonDown() override { this->Pan(true); }
  void OnMiddleButtonUp() override { this->Pan(false); }
  void OnRightButtonDown() override { this->Turn(true); }
  void OnRightButtonUp() override { this->Turn(false); }
  void OnMouseWheelForward() override { this->Wheel(1.2); }
  void OnMouseWheelBackward() override { this->Wheel(1.0 / 1.2); }
  void OnChar() override {}
  void OnKeyPress() override
  {
    if (this->View->Turn.IsUnderWay() && std::strcmp(this->Interactor->GetKeySym(), "Escape") == 0)
    {
      this->View->Turn.Cancel();
      this->ReleaseFocus();
    }
  }

  void OnMouseMove() override
  {
    const int* at = this->Interactor->GetEventPosition();
    vtkRenderer* renderer = this->View->Renderer;
    renderer->SetDisplayPoint(at[0], at[1], 0.0);
    renderer->DisplayToWorld();
    const double* world = renderer->GetWorldPoint();
    emit this->View->hovered(true, world[0], world[1]);
    if (this->View->Turn.IsUnderWay())
    {
      this->View->TurnTo(at[0], at[1]);
      if (!this->View->Turn.IsUnderWay())
      {
        this->ReleaseFocus();
      }
    }
    this->Superclass::OnMouseMove();
  }

private:
  bool Turn(bool on)
  {
    const int* at = this->Interactor->GetEventPosition();
    EnvironmentTurn& turn = this->View->Turn;
    if (on && !turn.IsUnderWay() && this->State == VTKIS_NONE &&
      turn.Start(this->View->AngleOf(at[0], at[1])))
    {
      this->GrabFocus(this->EventCallbackCommand);
      return true;
    }
    if (!on && turn.IsUnderWay())
    {
      turn.End();
      this->ReleaseFocus();
    }
    return false;
  }

  void Pan(bool on)
  {
    const int* at = this->Interactor->GetEventPosition();
    this->FindPokedRenderer(at[0], at[1]);
    if (on && this->CurrentRenderer && !this->View->Turn.IsUnderWay())
    {
      this->View->Fitted = false;
      this->GrabFocus(this->EventCallbackCommand);
      this->StartPan();
    }
    else if (!on && this->State == VTKIS_PAN)
    {
      this->EndPan();
      this->ReleaseFocus();
      this->View->Refresh(); // in full detail
    }
  }

  void Wheel(double factor)
  {
    const int* at = this->Interactor->GetEventPosition();
    this->View->ZoomAt(factor, at[0], at[1]);
  }
};
vtkStandardNewMacro(ReliefView::Style);

//------------------------------------------------------------------------------
ReliefView::ReliefView(Document* document, QWidget* parent)
  : QVTKOpenGLNativeWidget(parent)
  , Shown(document)
  , Turn(document)
{
  this->setFocusPolicy(Qt::StrongFocus);
  this->setMouseTracking(true);
  this->setMinimumSize(120, 120);
  this->setContextMenuPolicy(Qt::PreventContextMenu); // the right button turns

  vtkNew<vtkGenericOpenGLRenderWindow> window;
  window->SetMultiSamples(0);
  window->AddRenderer(this->Renderer);
  this->setRenderWindow(window);
  // Every move of the mouse comes as such. VTK 9.6 takes it a second time where it comes as
  // hovering too.
  this->setAttribute(Qt::WA_Hover, false);
  this->Renderer->SetBackground(0.16, 0.165, 0.175);
  this->Renderer->GetActiveCamera()->ParallelProjectionOn();
  window->AddObserver(vtkCommand::StartEvent, this, &ReliefView::FrameBegins);
  window->AddObserver(vtkCommand::EndEvent, this, &ReliefView::FrameEnds);

  this->ImageMapper->SetScene(document->Scene());
  this->Slice->SetMapper(this->ImageMapper);
  this->Slice->GetProperty()->SetInterpolationTypeToLinear();

  vtkNew<Style> style;
  style->View = this;
  this->interactor()->SetInteractorStyle(style);
  this->interactor()->SetDesiredUpdateRate(MovingRate);
  this->interactor()->SetStillUpdateRate(StillRate);

  this->Pending.setSingleShot(true);
  connect(&this->Pending, &QTimer::timeout, this, [this] { this->renderWindow()->Render(); });
  connect(document, &Document::fieldChanged, this, &ReliefView::TakeField);
  connect(document, &Document::maskChanged, this, &ReliefView::TakeHeights);
  connect(document, &Document::selectionChanged, this, &ReliefView::HighlightSelected);
  connect(document, &Document::stepping, this,
    [this](bool on)
    {
      this->renderWindow()->SetDesiredUpdateRate(on ? MovingRate : StillRate);
      this->Refresh();
    });
  connect(document, &Document::changed, this,
    [this]
    {
      this->TakeLights();
      this->Refresh();
    });
  this->TakeLights();
}

//------------------------------------------------------------------------------
ReliefView::~ReliefView()
{
  this->Pending.stop();
  for (vtkReliefLightWidget* light : this->Lights)
  {
    light->RemoveAllObservers(); // a drag that ends now changes nothing: the document may be gone
    light->SetInteractor(nullptr);
  }
  this->renderWindow()->RemoveAllObservers();
}

//------------------------------------------------------------------------------
void ReliefView::TakeField()
{
  this->TakeHeights();
  this->Fit();
}

//------------------------------------------------------------------------------
void ReliefView::TakeHeights()
{
  const Field& field = this->Shown->OpenedField();
  this->ImageMapper->SetInputData(field.Heights.Heights);
  this->ImageMapper->SetMaskData(field.Heights.Mask);
  this->ImageMapper->SetUseNoDataValue(field.Heights.NoData.has_value());
  if (field.Heights.NoData)
  {
    this->ImageMapper->SetNoDataValue(*field.Heights.NoData);
  }
  this->Renderer->AddViewProp(this->Slice);
  for (vtkReliefLightWidget* light : this->Lights)
  {
    this->PlaceDot(light->GetLightRepresentation());
  }
  this->TakeLights();
}

//------------------------------------------------------------------------------
void ReliefView::PlaceDot(vtkReliefLightRepresentation* dot)
{
  const Field& field = this->Shown->OpenedField();
  double bounds[6] = { field.At(0, 0.0), field.At(0, 1.0), field.At(1, 0.0), field.At(1, 1.0), 0.0,
    0.0 };
  dot->PlaceWidget(bounds);
  dot->SetMeanHeight(field.Mean);
}

//------------------------------------------------------------------------------
void ReliefView::TakeLights()
{
  vtkLightCollection* lights = this->Shown->Scene()->GetLights();
  const std::size_t count = this->Shown->HasField() ? lights->GetNumberOfItems() : 0;
  while (this->Lights.size() > count)
  {
    this->Lights.back()->Off();
    this->Lights.back()->SetInteractor(nullptr);
    this->Lights.pop_back();
  }
  while (this->Lights.size() < count)
  {
    auto widget = vtkSmartPointer<vtkReliefLightWidget>::New();
    widget->SetInteractor(this->interactor());
    widget->SetDefaultRenderer(this->Renderer);
    widget->KeyPressActivationOff();
    widget->GetLightRepresentation()->SetScene(this->Shown->Scene());
    this->PlaceDot(widget->GetLightRepresentation());
    // Tab is a key of the window: focusNextPrevChild().
    for (const int modifier : { vtkEvent::NoModifier, vtkEvent::ShiftModifier })
    {
      widget->GetEventTranslator()->RemoveTranslation(
        vtkCommand::KeyPressEvent, modifier, 0, 0, "Tab");
    }
    for (const unsigned long event :
      { vtkCommand::StartInteractionEvent, vtkCommand::InteractionEvent,
        vtkCommand::EndInteractionEvent, vtkCommand::SelectionChangedEvent })
    {
      widget->AddObserver(event, this, &ReliefView::LightEvent);
    }
    this->Lights.push_back(widget);
  }
  for (std::size_t i = 0; i < count; ++i)
  {
    this->Lights[i]->GetLightRepresentation()->SetLight(
      vtkLight::SafeDownCast(lights->GetItemAsObject(static_cast<int>(i))));
    this->Lights[i]->GetLightRepresentation()->SetHandleSize(
      DotRadius * this->effectiveDevicePixelRatio());
    this->Lights[i]->SetEnabled(this->DotsShown);
  }
  this->HighlightSelected();
}

//------------------------------------------------------------------------------
void ReliefView::HighlightSelected()
{
  for (std::size_t i = 0; i < this->Lights.size(); ++i)
  {
    const bool selected =
      this->Lights.size() > 1 && static_cast<int>(i) == this->Shown->SelectedLightIndex();
    this->Lights[i]->GetLightRepresentation()->SetOutlineColor(
      selected ? SelectedOutline : OtherOutline);
  }
  // What gives the focus up to another says so, too.
  const bool keys = this->Keys;
  for (std::size_t i = 0; i < this->Lights.size(); ++i)
  {
    const bool selected = static_cast<int>(i) == this->Shown->SelectedLightIndex();
    this->Lights[i]->SetKeyFocus(keys && selected);
  }
  this->Keys = keys;
  this->Refresh();
}

//------------------------------------------------------------------------------
void ReliefView::LightEvent(vtkObject* widget, unsigned long event, void*)
{
  const auto light = std::find(this->Lights.begin(), this->Lights.end(), widget);
  if (light == this->Lights.end())
  {
    return;
  }
  if (event == vtkCommand::StartInteractionEvent)
  {
    this->Shown->SelectLight(static_cast<int>(light - this->Lights.begin()));
    this->Shown->StartStep();
  }
  else if (event == vtkCommand::InteractionEvent)
  {
    this->Shown->Change();
  }
  else if (event == vtkCommand::SelectionChangedEvent)
  {
    this->Keys = (*light)->GetKeyFocus(); // the mouse or escape has taken it
    this->Refresh();
  }
  else
  {
    this->Shown->EndStep(tr("Move light"));
  }
}

//------------------------------------------------------------------------------
vtkReliefLightRepresentation* ReliefView::Dot(int light) const
{
  return light >= 0 && light < static_cast<int>(this->Lights.size())
    ? this->Lights[light]->GetLightRepresentation()
    : nullptr;
}

//------------------------------------------------------------------------------
void ReliefView::SwitchLightType()
{
  if (vtkReliefLightRepresentation* dot = this->Dot(this->Shown->SelectedLightIndex()))
  {
    this->Shown->Edit(tr("Switch between sun and lamp"), [dot] { dot->SwitchLightType(); });
  }
}

//------------------------------------------------------------------------------
void ReliefView::ShowDots(bool on)
{
  this->DotsShown = on;
  this->TakeLights();
}

//------------------------------------------------------------------------------
void ReliefView::TakeKeys()
{
  this->setFocus(Qt::ShortcutFocusReason);
  this->Keys = true;
  this->HighlightSelected();
}

//------------------------------------------------------------------------------
// From one side of the row of lights or the other.
void ReliefView::focusInEvent(QFocusEvent* event)
{
  QVTKOpenGLNativeWidget::focusInEvent(event);
  const Qt::FocusReason reason = event->reason();
  if (reason == Qt::TabFocusReason || reason == Qt::BacktabFocusReason)
  {
    this->Keys = true;
    this->Shown->SelectLight(
      reason == Qt::TabFocusReason ? 0 : static_cast<int>(this->Lights.size()) - 1);
    this->HighlightSelected();
  }
}

//------------------------------------------------------------------------------
void ReliefView::focusOutEvent(QFocusEvent* event)
{
  QVTKOpenGLNativeWidget::focusOutEvent(event);
  // A menu, or another window, gives it back.
  if (event->reason() != Qt::PopupFocusReason && event->reason() != Qt::ActiveWindowFocusReason &&
    event->reason() != Qt::MenuBarFocusReason)
  {
    this->Keys = false;
    this->HighlightSelected();
  }
}

//------------------------------------------------------------------------------
bool ReliefView::focusNextPrevChild(bool next)
{
  const int count = this->DotsShown ? static_cast<int>(this->Lights.size()) : 0;
  const int first = next ? 0 : count - 1;
  const int light = this->Keys ? this->Shown->SelectedLightIndex() + (next ? 1 : -1) : first;
  if (light >= 0 && light < count)
  {
    this->Keys = true;
    this->Shown->SelectLight(light);
    this->HighlightSelected();
    return true;
  }
  return QVTKOpenGLNativeWidget::focusNextPrevChild(next);
}

//------------------------------------------------------------------------------
/// Counter-clockwise about the middle of the window, in degrees; none close to it.
std::optional<double> ReliefView::AngleOf(double displayX, double displayY) const
{
  const int* size = this->renderWindow()->GetSize();
  const double x = displayX - 0.5 * size[0];
  const double y = displayY - 0.5 * size[1];
  return std::hypot(x, y) < MiddleRadius * this->effectiveDevicePixelRatio()
    ? std::optional<double>()
    : vtkMath::DegreesFromRadians(std::atan2(y, x));
}

//------------------------------------------------------------------------------
void ReliefView::TurnTo(double displayX, double displayY)
{
  if (const auto turned = this->Turn.Follow(this->AngleOf(displayX, displayY)))
  {
    emit this->environmentTurned(*turned);
  }
}

//------------------------------------------------------------------------------
void ReliefView::Fit()
{
  const Field& field = this->Shown->OpenedField();
  const int* size = this->renderWindow()->GetSize();
  const double width = field.Length(0) + field.Heights.Spacing[0];
  const double height = field.Length(1) + field.Heights.Spacing[1];
  const double aspect = static_cast<double>(std::max(size[0], 1)) / std::max(size[1], 1);
  const double margin = 1.04;
  const double x = field.At(0, 0.5);
  const double y = field.At(1, 0.5);
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  camera->SetFocalPoint(x, y, 0.0);
  camera->SetPosition(x, y, std::max(width, height));
  camera->SetViewUp(0.0, 1.0, 0.0);
  camera->SetParallelScale(0.5 * margin * std::max(height, width / aspect));
  this->Renderer->ResetCameraClippingRange();
  this->Fitted = true;
  this->Refresh();
}

//------------------------------------------------------------------------------
void ReliefView::ShowSamples()
{
  const int* size = this->renderWindow()->GetSize();
  this->Renderer->GetActiveCamera()->SetParallelScale(
    0.5 * size[1] * this->Shown->OpenedField().Heights.Spacing[1]);
  this->Fitted = false;
  this->Refresh();
}

//------------------------------------------------------------------------------
void ReliefView::Zoom(double factor)
{
  const int* size = this->renderWindow()->GetSize();
  this->ZoomAt(factor, 0.5 * size[0], 0.5 * size[1]);
}

//------------------------------------------------------------------------------
void ReliefView::ZoomAt(double factor, double displayX, double displayY)
{
  vtkCamera* camera = this->Renderer->GetActiveCamera();
  const Field& field = this->Shown->OpenedField();
  const int* size = this->renderWindow()->GetSize();
  const double perPixel = 2.0 * camera->GetParallelScale() / std::max(size[1], 1);
  // From a sample over half the window to a tenth of the window for the whole field.
  const double spacing = field.MeanSpacing();
  const double scale =
    std::max(spacing, std::min(camera->GetParallelScale() / factor, 10.0 * field.Size()));
  // The point under the mouse stays there.
  const double moved = perPixel * (1.0 - scale / camera->GetParallelScale());
  const double dx = moved * (displayX - 0.5 * size[0]);
  const double dy = moved * (displayY - 0.5 * size[1]);
  double focus[3];
  double position[3];
  camera->GetFocalPoint(focus);
  camera->GetPosition(position);
  camera->SetFocalPoint(focus[0] + dx, focus[1] + dy, focus[2]);
  camera->SetPosition(position[0] + dx, position[1] + dy, position[2]);
  camera->SetParallelScale(scale);
  this->Fitted = false;
  this->Refresh();
}

//------------------------------------------------------------------------------
void ReliefView::Refresh()
{
  this->Pending.start(0);
}

//------------------------------------------------------------------------------
QPoint ReliefView::ToWidget(double x, double y) const
{
  vtkRenderer* renderer = this->Renderer;
  renderer->SetWorldPoint(x, y, 0.0, 1.0);
  renderer->WorldToDisplay();
  const double* display = renderer->GetDisplayPoint();
  const double ratio = this->effectiveDevicePixelRatio();
  return { static_cast<int>(std::floor(display[0] / ratio)),
    static_cast<int>(std::floor(this->height() - display[1] / ratio)) };
}

//------------------------------------------------------------------------------
void ReliefView::FrameBegins()
{
  this->Pending.stop(); // it shows all changes so far
  this->FrameBegan = vtkTimerLog::GetUniversalTime();
}

//------------------------------------------------------------------------------
void ReliefView::FrameEnds()
{
  this->Frame.Seconds = vtkTimerLog::GetUniversalTime() - this->FrameBegan;
  this->Frame.LightsTraced =
    static_cast<int>(this->ImageMapper->GetStatistics()->GetLightsTraced());
  this->Frame.Converged = this->ImageMapper->GetConverged();
  this->Frame.Refinement = this->ImageMapper->GetRefinement();
  emit this->frameShown();
}

//------------------------------------------------------------------------------
void ReliefView::resizeEvent(QResizeEvent* event)
{
  QVTKOpenGLNativeWidget::resizeEvent(event);
  if (this->Fitted)
  {
    this->Fit();
  }
}

//------------------------------------------------------------------------------
void ReliefView::leaveEvent(QEvent* event)
{
  QVTKOpenGLNativeWidget::leaveEvent(event);
  emit this->hovered(false, 0.0, 0.0);
}

}
