// SPDX-License-Identifier: BSD-3-Clause
#ifndef WidgetDiary_h
#define WidgetDiary_h

/// @file
/// What the tests of vtkReliefLightWidget share: events of mouse and keys, and those of the widget.

#include "ReliefWidgetTestUtilities.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkLight.h"
#include "vtkMath.h"

#include <cmath>
#include <functional>
#include <string>
#include <utility>

// A window of 202 by 162 pixels; the middle of the relief is at (101, 81), the horizon 80 pixels
// away.
inline vtkSmartPointer<vtkImageData> Terrain()
{
  return MakeHeights(101, 81, Hills(5));
}

inline double Altitude(vtkLight* sun)
{
  double position[3];
  vtkMath::Assign(sun->GetPosition(), position);
  return vtkMath::DegreesFromRadians(std::asin(position[2] / vtkMath::Norm(position)));
}

inline double Azimuth(vtkLight* sun)
{
  return vtkMath::DegreesFromRadians(std::atan2(sun->GetPosition()[0], sun->GetPosition()[1]));
}

inline void Observe(vtkObject* object, unsigned long event, std::function<void(unsigned long)> body)
{
  using Body = std::function<void(unsigned long)>;
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(new Body(std::move(body)));
  command->SetClientDataDeleteCallback([](void* data) { delete static_cast<Body*>(data); });
  command->SetCallback(
    [](vtkObject*, unsigned long id, void* data, void*) { (*static_cast<Body*>(data))(id); });
  object->AddObserver(event, command);
}

// The events of the widget, one letter each.
struct Diary
{
  explicit Diary(vtkReliefLightWidget* widget)
  {
    Observe(
      widget, vtkCommand::StartInteractionEvent, [this](unsigned long) { this->Text += 'S'; });
    Observe(widget, vtkCommand::InteractionEvent, [this](unsigned long) { this->Text += 'I'; });
    Observe(widget, vtkCommand::EndInteractionEvent, [this](unsigned long) { this->Text += 'E'; });
    Observe(widget, vtkCommand::EnableEvent, [this](unsigned long) { this->Text += '+'; });
    Observe(widget, vtkCommand::DisableEvent, [this](unsigned long) { this->Text += '-'; });
  }
  std::string Read()
  {
    std::string text;
    text.swap(this->Text);
    return text;
  }
  std::string Text;
};

constexpr unsigned long Press = vtkCommand::LeftButtonPressEvent;
constexpr unsigned long Release = vtkCommand::LeftButtonReleaseEvent;
constexpr unsigned long Move = vtkCommand::MouseMoveEvent;
constexpr unsigned long Key = vtkCommand::KeyPressEvent;

#endif
