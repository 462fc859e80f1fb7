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

#include <algorithm>
#include <cstring>
#include <iterator>
#include <vector>

namespace
{
// The widgets that are on, in the order in which they were switched on: of these the key focus
// makes its round. As all widgets they live in one thread.
std::vector<vtkReliefLightWidget*>& EnabledWidgets()
{
  // Never destroyed: a widget may outlive what is static.
  static auto* widgets = new std::vector<vtkReliefLightWidget*>;
  return *widgets;
}

// Those of an interactor that have a dot.
std::vector<vtkReliefLightWidget*> DotsOf(vtkRenderWindowInteractor* interactor)
{
  std::vector<vtkReliefLightWidget*> dots;
  double position[3];
  std::copy_if(EnabledWidgets().begin(), EnabledWidgets().end(), std::back_inserter(dots),
    [&](vtkReliefLightWidget* widget)
    {
      return widget->GetInteractor() == interactor && widget->GetProcessEvents() &&
        widget->GetLightRepresentation()->GetDotPosition(position);
    });
  return dots;
}
}

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
  on(vtkCommand::LeaveEvent, vtkWidgetEvent::HoverLeave, vtkReliefLightWidget::LeaveAction);
  on(vtkCommand::MouseWheelForwardEvent, vtkWidgetEvent::Up, vtkReliefLightWidget::UpAction);
  on(vtkCommand::MouseWheelBackwardEvent, vtkWidgetEvent::Down, vtkReliefLightWidget::DownAction);
  // Keys with control or alt are somebody else's.
  auto onKey = [this](const char* key, int modifier, unsigned long widgetEvent,
                 vtkWidgetCallbackMapper::CallbackType action)
  {
    this->CallbackMapper->SetCallbackMethod(
      vtkCommand::KeyPressEvent, modifier, 0, 0, key, widgetEvent, this, action);
  };
  for (const char* key : { "Left", "Right", "Up", "Down", "Prior", "Next" })
  {
    for (const int modifier : { vtkEvent::NoModifier, vtkEvent::ShiftModifier })
    {
      onKey(key, modifier, vtkWidgetEvent::Translate, vtkReliefLightWidget::TranslateAction);
    }
  }
  onKey("Tab", vtkEvent::NoModifier, vtkWidgetEvent::Right, vtkReliefLightWidget::NextAction);
  for (const char* back : { "Tab", "ISO_Left_Tab" })
  {
    onKey(
      back, vtkEvent::ShiftModifier, vtkWidgetEvent::Left, vtkReliefLightWidget::PreviousAction);
  }
  onKey("Escape", vtkEvent::AnyModifier, vtkWidgetEvent::Reset, vtkReliefLightWidget::ResetAction);
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
    this->SetKeyFocus(false);
    this->SetHovering(false);
  }
  this->Superclass::SetEnabled(enabling);
  // Whether it is on now VTK decides: without an interactor it is not.
  std::vector<vtkReliefLightWidget*>& widgets = EnabledWidgets();
  const auto place = std::find(widgets.begin(), widgets.end(), this);
  if (this->Enabled && place == widgets.end())
  {
    widgets.push_back(this);
  }
  else if (!this->Enabled && place != widgets.end())
  {
    widgets.erase(place);
  }
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
void vtkReliefLightWidget::Highlight()
{
  this->GetLightRepresentation()->Highlight(this->Hovering || this->KeyFocus);
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::SetHovering(bool over)
{
  this->Hovering = over;
  this->Highlight();
  this->SetCursor(
    over ? vtkReliefLightRepresentation::Nearby : vtkReliefLightRepresentation::Outside);
}

//------------------------------------------------------------------------------
bool vtkReliefLightWidget::Hover()
{
  const bool over = this->IsOverDot();
  if (this->Hovering != over)
  {
    this->SetHovering(over);
    for (vtkReliefLightWidget* other : EnabledWidgets())
    {
      if (over && other != this && other->Interactor == this->Interactor)
      {
        other->SetKeyFocus(false);
      }
    }
    this->Render();
  }
  return over;
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::SetKeyFocus(bool focus)
{
  if (focus == this->KeyFocus || (focus && !this->Enabled))
  {
    return;
  }
  this->KeyFocus = focus;
  if (focus)
  {
    // No other has it, and none is left to the mouse until that moves.
    for (vtkReliefLightWidget* other : EnabledWidgets())
    {
      if (other != this && other->Interactor == this->Interactor)
      {
        other->SetHovering(false);
        other->SetKeyFocus(false);
      }
    }
  }
  this->Highlight();
  this->Modified();
  this->InvokeEvent(vtkCommand::SelectionChangedEvent, nullptr);
}

//------------------------------------------------------------------------------
// From the dot that has the key focus, or else is under the mouse, to one beside it, round and
// round.
void vtkReliefLightWidget::FocusNeighbor(int step)
{
  const std::vector<vtkReliefLightWidget*> dots = DotsOf(this->Interactor);
  const auto is = [&dots](bool vtkReliefLightWidget::*state)
  { return std::find_if(dots.begin(), dots.end(), [&](auto* dot) { return dot->*state; }); };
  if (dots.empty() || is(&vtkReliefLightWidget::Dragging) != dots.end())
  {
    return;
  }
  auto current = is(&vtkReliefLightWidget::KeyFocus);
  if (current == dots.end())
  {
    current = is(&vtkReliefLightWidget::Hovering);
  }
  const int count = static_cast<int>(dots.size());
  const int next = current == dots.end() ? (step > 0 ? 0 : count - 1)
                                         : static_cast<int>(current - dots.begin()) + step;
  this->EventCallbackCommand->SetAbortFlag(1);
  dots[(next + count) % count]->SetKeyFocus(true);
  this->Render();
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
  this->SetHovering(this->IsOverDot()); // the mouse may be over the dot and outside the window
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
void vtkReliefLightWidget::Press(int state)
{
  if (this->Dragging)
  {
    return;
  }
  if (this->Hover())
  {
    this->StartDrag(state);
  }
  else if (this->KeyFocus)
  {
    this->SetKeyFocus(false);
    this->Render();
  }
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
  else
  {
    self->Press(vtkReliefLightRepresentation::Moving);
  }
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::ScaleAction(vtkAbstractWidget* widget)
{
  static_cast<vtkReliefLightWidget*>(widget)->Press(vtkReliefLightRepresentation::Raising);
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
// No move tells that the mouse is no longer over the dot.
void vtkReliefLightWidget::LeaveAction(vtkAbstractWidget* widget)
{
  auto* self = static_cast<vtkReliefLightWidget*>(widget);
  if (!self->Dragging && self->Hovering)
  {
    self->SetHovering(false);
    self->Render();
  }
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
  if (!key || self->Dragging || !(self->Hovering || self->KeyFocus))
  {
    return;
  }
  const double step = self->Interactor->GetShiftKey() ? 10.0 : 1.0;
  const double z = std::strcmp(key, "Prior") == 0 ? step
    : std::strcmp(key, "Next") == 0               ? -step
                                                  : 0.0;
  if (z != 0.0)
  {
    self->ChangeAtOnce([&] { return self->GetLightRepresentation()->RaiseLight(z); });
    return;
  }
  const double x = std::strcmp(key, "Left") == 0 ? -step
    : std::strcmp(key, "Right") == 0             ? step
                                                 : 0.0;
  const double y = std::strcmp(key, "Down") == 0 ? -step : std::strcmp(key, "Up") == 0 ? step : 0.0;
  self->ChangeAtOnce([&] { return self->GetLightRepresentation()->ShiftDot(x, y); });
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::NextAction(vtkAbstractWidget* widget)
{
  static_cast<vtkReliefLightWidget*>(widget)->FocusNeighbor(1);
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::PreviousAction(vtkAbstractWidget* widget)
{
  static_cast<vtkReliefLightWidget*>(widget)->FocusNeighbor(-1);
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
  else if (self->KeyFocus)
  {
    self->EventCallbackCommand->SetAbortFlag(1);
    self->SetKeyFocus(false);
    self->Render();
  }
}

//------------------------------------------------------------------------------
void vtkReliefLightWidget::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Dragging: " << (this->Dragging ? "On\n" : "Off\n");
  os << indent << "KeyFocus: " << (this->KeyFocus ? "On\n" : "Off\n");
}
