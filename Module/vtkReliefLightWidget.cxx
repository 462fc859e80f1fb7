// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefLightWidget.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkEvent.h"
#include "vtkObjectFactory.h"
#include "vtkReliefLightRepresentation.h"
#include "vtkRenderWindow.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkRenderer.h"
#include "vtkWidgetCallbackMapper.h"
#include "vtkWidgetEvent.h"

#include <cstring>

vtkStandardNewMacro(vtkReliefLightWidget);

//------------------------------------------------------------------------------
vtkReliefLightWidget::vtkReliefLightWidget()
{
  // The first match counts, so modified events come before those with any modifier.
  auto on = [this](unsigned long event, unsigned long widgetEvent,
              vtkWidgetCallbackMapper::CallbackType action)
  { this->CallbackMapper->SetCallbackMethod(event, widgetEvent, this, action); };
  this->CallbackMapper->SetCallbackMethod(vtkCommand::LeftButtonPressEvent, vtkEvent::ShiftModifier,
    0, 0, nullptr, vtkWidgetEvent::Scale, this, vtkReliefLightWidget::ScaleAction);
  on(vtkCommand::LeftButtonPressEvent, vtkWidgetEvent::Select, vtkReliefLightWidget::SelectAction);
  on(vtkCommand::LeftButtonDoubleClickEvent, vtkWidgetEvent::ModifyEvent,
    vtkReliefLightWidget::ModifyAction);
  on(vtkCommand::LeftButtonReleaseEvent, vtkWidgetEvent::EndSelect,
    vtkReliefLightWidget::EndSelectAction);
  on(vtkCommand::MouseMoveEvent, vtkWidgetEvent::Move, vtkReliefLightWidget::MoveAction);
  on(vtkCommand::MouseWheelForwardEvent, vtkWidgetEvent::Up, vtkReliefLightWidget::UpAction);
  on(vtkCommand::MouseWheelBackwardEvent, vtkWidgetEvent::Down, vtkReliefLightWidget::DownAction);
  auto onKey =
    [this](const char* key, unsigned long widgetEvent, vtkWidgetCallbackMapper::CallbackType action)
  {
    this->CallbackMapper->SetCallbackMethod(
      vtkCommand::KeyPressEvent, vtkEvent::AnyModifier, 0, 0, key, widgetEvent, this, action);
  };
  for (const char* key : { "Left", "Right", "Up", "Down" })
  {
    onKey(key, vtkWidgetEvent::Translate, vtkReliefLightWidget::TranslateAction);
  }
  onKey("Escape", vtkWidgetEvent::Reset, vtkReliefLightWidget::ResetAction);
}

//------------------------------------------------------------------------------
vtkReliefLightWidget::~vtkReliefLightWidget()
{
  this->SetEnabled(0);
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::SetRepresentation(vtkReliefLightRepresentation* representation)
{
  this->SetWidgetRepresentation(representation);
}

//------------------------------------------------------------------------------
vtkReliefLightRepresentation* vtkReliefLightWidget::GetLightRepresentation()
{
  this->CreateDefaultRepresentation();
  return static_cast<vtkReliefLightRepresentation*>(this->WidgetRep);
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::CreateDefaultRepresentation()
{
  if (!this->WidgetRep)
  {
    this->WidgetRep = vtkReliefLightRepresentation::New();
  }
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::SetEnabled(int enabling)
{
  if (!enabling && this->Enabled)
  {
    this->EndDrag();
    this->Hovering = false;
    this->GetLightRepresentation()->Highlight(0);
    this->SetCursor(vtkReliefLightRepresentation::Outside);
  }
  this->Superclass::SetEnabled(enabling);
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::SetProcessEvents(vtkTypeBool process)
{
  if (!process)
  {
    this->EndDrag();
  }
  this->Superclass::SetProcessEvents(process);
}

//------------------------------------------------------------------------------
// VTK asks the interactor's window, which may be gone before the interactor.
void vtkReliefLightWidget::SetCursor(int state)
{
  if (this->ManagesCursor && this->Interactor && this->Interactor->GetRenderWindow())
  {
    this->RequestCursorShape(state == vtkReliefLightRepresentation::Outside ? VTK_CURSOR_DEFAULT
        : state == vtkReliefLightRepresentation::Raising                    ? VTK_CURSOR_SIZENS
                                                                            : VTK_CURSOR_HAND);
  }
}

//------------------------------------------------------------------------------
bool vtkReliefLightWidget::IsOverDot()
{
  const int* at = this->Interactor->GetEventPosition();
  return this->CurrentRenderer && this->CurrentRenderer->IsInViewport(at[0], at[1]) &&
    this->WidgetRep->ComputeInteractionState(at[0], at[1]) == vtkReliefLightRepresentation::Nearby;
}

//------------------------------------------------------------------------------
bool vtkReliefLightWidget::Hover()
{
  const bool over = this->IsOverDot();
  if (this->Hovering != over)
  {
    this->Hovering = over;
    this->WidgetRep->Highlight(over);
    this->SetCursor(this->WidgetRep->GetInteractionState());
    this->Render();
  }
  return over;
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::StartDrag(int state)
{
  const int* at = this->Interactor->GetEventPosition();
  double position[2] = { static_cast<double>(at[0]), static_cast<double>(at[1]) };
  vtkReliefLightRepresentation* dot = this->GetLightRepresentation();
  dot->StartWidgetInteraction(position);
  dot->SetInteractionState(state);
  this->Dragging = true;
  this->SetCursor(state);
  // No camera moves meanwhile, and the button's release comes here wherever it happens.
  this->GrabFocus(this->EventCallbackCommand);
  this->EventCallbackCommand->SetAbortFlag(1);
  this->StartInteraction();
  this->InvokeEvent(vtkCommand::StartInteractionEvent, nullptr);
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::EndDrag()
{
  if (!this->Dragging)
  {
    return;
  }
  this->Dragging = false;
  const int* at = this->Interactor->GetEventPosition();
  double position[2] = { static_cast<double>(at[0]), static_cast<double>(at[1]) };
  this->WidgetRep->EndWidgetInteraction(position);
  const int state = this->WidgetRep->GetInteractionState();
  this->Hovering = state != vtkReliefLightRepresentation::Outside;
  this->WidgetRep->Highlight(this->Hovering);
  this->SetCursor(state);
  this->ReleaseFocus();
  this->EventCallbackCommand->SetAbortFlag(1);
  if (this->Interactor->GetRenderWindow())
  {
    this->EndInteraction();
  }
  this->InvokeEvent(vtkCommand::EndInteractionEvent, nullptr);
}

//------------------------------------------------------------------------------
// A change that is no drag: whole before anything is shown.
template <class Change>
void vtkReliefLightWidget::ChangeAtOnce(const Change& change)
{
  this->EventCallbackCommand->SetAbortFlag(1);
  this->InvokeEvent(vtkCommand::StartInteractionEvent, nullptr);
  if (change())
  {
    this->InvokeEvent(vtkCommand::InteractionEvent, nullptr);
  }
  this->InvokeEvent(vtkCommand::EndInteractionEvent, nullptr);
  this->Render();
}

//------------------------------------------------------------------------------
// Some windows tell a double-click by an event of its own, others by a press that counts as a
// repetition, wherever the first one was.
void vtkReliefLightWidget::SelectAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkReliefLightWidget*>(widget);
  if (self->Interactor->GetRepeatCount() > 0)
  {
    ModifyAction(widget);
  }
  else if (!self->Dragging && self->Hover())
  {
    self->StartDrag(vtkReliefLightRepresentation::Moving);
  }
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::ScaleAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkReliefLightWidget*>(widget);
  if (!self->Dragging && self->Hover())
  {
    self->StartDrag(vtkReliefLightRepresentation::Raising);
  }
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::MoveAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkReliefLightWidget*>(widget);
  vtkWidgetRepresentation* dot = self->WidgetRep;
  if (!self->Dragging)
  {
    self->Hover();
    return;
  }
  const int* at = self->Interactor->GetEventPosition();
  double position[2] = { static_cast<double>(at[0]), static_cast<double>(at[1]) };
  dot->WidgetInteraction(position);
  if (dot->GetInteractionState() == vtkReliefLightRepresentation::Outside)
  {
    self->EndDrag(); // the light is gone
    self->Render();
    return;
  }
  self->EventCallbackCommand->SetAbortFlag(1);
  self->InvokeEvent(vtkCommand::InteractionEvent, nullptr);
  self->Render();
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::EndSelectAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkReliefLightWidget*>(widget);
  if (self->Dragging)
  {
    self->EndDrag();
    self->Render(); // at the rate for still pictures
  }
}

//------------------------------------------------------------------------------
// What wheel and keys do to the dot may move it away from under the mouse. They keep their hold on
// it until the mouse moves.
void vtkReliefLightWidget::Raise(double steps)
{
  if (!this->Dragging && this->Hovering)
  {
    this->ChangeAtOnce([&] { return this->GetLightRepresentation()->RaiseLight(steps); });
  }
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::UpAction(vtkAbstractWidget* widget)
{
  static_cast<vtkReliefLightWidget*>(widget)->Raise(1.0);
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::DownAction(vtkAbstractWidget* widget)
{
  static_cast<vtkReliefLightWidget*>(widget)->Raise(-1.0);
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::TranslateAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkReliefLightWidget*>(widget);
  const char* key = self->Interactor->GetKeySym();
  if (!key || self->Dragging || !self->Hovering)
  {
    return;
  }
  const double step = self->Interactor->GetShiftKey() ? 10.0 : 1.0;
  const double x = std::strcmp(key, "Left") == 0 ? -step
    : std::strcmp(key, "Right") == 0             ? step
                                                 : 0.0;
  const double y = std::strcmp(key, "Down") == 0 ? -step : std::strcmp(key, "Up") == 0 ? step : 0.0;
  self->ChangeAtOnce([&] { return self->GetLightRepresentation()->ShiftDot(x, y); });
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::ModifyAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkReliefLightWidget*>(widget);
  if (!self->Dragging && self->Hover())
  {
    self->ChangeAtOnce([self] { return self->GetLightRepresentation()->SwitchLightType(); });
  }
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::ResetAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkReliefLightWidget*>(widget);
  if (self->Dragging)
  {
    self->GetLightRepresentation()->CancelWidgetInteraction();
    self->EventCallbackCommand->SetAbortFlag(1);
    self->InvokeEvent(vtkCommand::InteractionEvent, nullptr);
    self->EndDrag();
    self->Render();
  }
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Dragging: " << (this->Dragging ? "On\n" : "Off\n");
}
