// SPDX-License-Identifier: BSD-3-Clause
//
// Keys choose a light and move it, with the mouse over its dot and without.

#include "WidgetDiary.h"

namespace
{
int Failures = 0;

void TestKeys()
{
  WidgetStage stage(Terrain());
  vtkLight* sun = stage.Scene()->AddSun(0.0, 45.0);
  stage.Widget->On();
  Diary diary(stage.Widget);
  const auto before = stage.DotInWindow();
  auto press = [&](const char* key, bool shift = false)
  { stage.Event(Key, before[0], before[1], shift, 0, key); };
  press("Right"); // not over the dot yet
  CHECK(diary.Read().empty());
  stage.Event(Move, before[0], before[1]);
  press("Right", true);
  press("Right", true);
  press("Down");
  press("a");
  auto dot = stage.DotInWindow();
  CHECK_NEAR(dot[0], before[0] + 20.0, 1e-6);
  CHECK_NEAR(dot[1], before[1] - 1.0, 1e-6);
  press("Left", true);
  press("Up");
  dot = stage.DotInWindow();
  CHECK_NEAR(dot[0], before[0] + 10.0, 1e-6);
  CHECK_NEAR(dot[1], before[1], 1e-6);
  CHECK(diary.Read() == "SIESIESIESIESIE");

  // Escape puts the light back and ends the drag.
  const double azimuth = Azimuth(sun);
  stage.Event(Move, dot[0], dot[1]);
  stage.Event(Press, dot[0], dot[1]);
  stage.Event(Move, 60, 60);
  CHECK(std::abs(Azimuth(sun) - azimuth) > 10.0);
  stage.Event(Key, 60, 60, false, 0, "Escape");
  CHECK_NEAR(Azimuth(sun), azimuth, 1e-9);
  CHECK(!stage.Widget->GetDragging() && diary.Read() == "SIIE");
  stage.Event(Move, 70, 70);
  stage.Event(Release, 70, 70);
  CHECK_NEAR(Azimuth(sun), azimuth, 1e-9);
  stage.Event(Key, 60, 60, false, 0, "Escape");
  CHECK(diary.Read().empty());

  // The key i, as for all widgets.
  stage.Interactor->SetKeyCode('i');
  stage.Interactor->InvokeEvent(vtkCommand::CharEvent, nullptr);
  CHECK(!stage.Widget->GetEnabled() && diary.Read() == "-");
  stage.Interactor->InvokeEvent(vtkCommand::CharEvent, nullptr);
  CHECK(stage.Widget->GetEnabled() && diary.Read() == "+");
}

// Keys alone choose a light and move it: without the mouse, and without what is beside the dots.
void TestKeyFocus()
{
  WidgetStage stage(Terrain());
  vtkLight* north = stage.Scene()->AddSun(0.0, 45.0);
  vtkLight* east = stage.Scene()->AddSun(90.0, 45.0);
  vtkNew<vtkReliefLightWidget> second;
  second->SetInteractor(stage.Interactor);
  second->GetLightRepresentation()->SetScene(stage.Scene());
  second->GetLightRepresentation()->SetLight(east);
  second->GetLightRepresentation()->PlaceWidget(Terrain());
  stage.Dot()->SetLight(north);
  second->KeyFocusOn();
  CHECK(!second->GetKeyFocus()); // it is off
  stage.Widget->On();
  second->On();
  // What the style would see of the keys.
  std::string passed;
  vtkNew<vtkCallbackCommand> style;
  style->SetClientData(&passed);
  style->SetCallback(
    [](vtkObject* interactor, unsigned long, void* data, void*)
    {
      *static_cast<std::string*>(data) +=
        vtkRenderWindowInteractor::SafeDownCast(interactor)->GetKeySym();
    });
  stage.Interactor->AddObserver(vtkCommand::KeyPressEvent, style, 0.0);
  const auto press = [&](const char* key, bool shift = false)
  { stage.Event(Key, 5, 5, shift, 0, key); };
  const auto focus = [&]
  {
    return std::string(stage.Widget->GetKeyFocus() ? "1" : "") + (second->GetKeyFocus() ? "2" : "");
  };

  // Without a dot of its own a key is the style's.
  press("Up");
  CHECK(passed == "Up" && Altitude(north) > 45.0 - 1e-9 && Altitude(east) > 45.0 - 1e-9);
  passed.clear();
  const auto south = stage.Pixel(101, 1);
  press("Tab");
  CHECK(focus() == "1" && stage.Pixel(101, 1) != south); // the horizon is shown
  press("Tab");
  CHECK(focus() == "2");
  press("Tab");
  CHECK(focus() == "1");
  press("ISO_Left_Tab", true); // as X11 calls it
  CHECK(focus() == "2");
  press("Tab", true);
  CHECK(focus() == "1");
  press("Right", true);
  CHECK(Azimuth(north) > 10.0 && std::abs(Azimuth(east) - 90.0) < 1e-9);
  press("Prior");
  const double altitude = Altitude(north);
  press("Next", true);
  CHECK_NEAR(Altitude(north), altitude - 10.0, 1e-6);
  CHECK(passed.empty());
  // With control they are somebody else's.
  stage.Interactor->SetEventInformation(5, 5, 1, 0, 0, 0, "Right");
  const vtkMTimeType time = north->GetMTime();
  stage.Interactor->InvokeEvent(Key, nullptr);
  CHECK(passed == "Right" && north->GetMTime() == time);

  // Escape, a press beside the dot, another dot under the mouse, and the switch take it away.
  const auto horizon = stage.Pixel(101, 1);
  press("Escape");
  CHECK(focus().empty() && stage.Pixel(101, 1) != horizon);
  // The wheel away from the dot stays the camera's.
  press("Tab");
  stage.Event(vtkCommand::MouseWheelForwardEvent, 5, 5);
  CHECK(north->GetMTime() == time && focus() == "1");
  stage.Event(Press, 5, 5);
  stage.Event(Release, 5, 5);
  CHECK(focus().empty());
  press("Tab");
  const std::array<double, 2> dot = [&]
  {
    double at[3];
    second->GetLightRepresentation()->GetDotPosition(at);
    stage.Renderer->SetWorldPoint(at[0], at[1], at[2], 1.0);
    stage.Renderer->WorldToDisplay();
    const double* shown = stage.Renderer->GetDisplayPoint();
    return std::array<double, 2>{ shown[0], shown[1] };
  }();
  stage.Event(Move, dot[0], dot[1]);
  CHECK(focus().empty());
  press("Tab"); // on from the one under the mouse
  CHECK(focus() == "1");
  stage.Widget->Off();
  CHECK(focus().empty());
  press("Tab");
  CHECK(focus() == "2");
  // A light that is gone has no turn.
  stage.Widget->On();
  stage.Scene()->RemoveLight(north);
  press("Tab");
  CHECK(focus() == "2");
  stage.Scene()->RemoveAllLights();
  passed.clear();
  press("Tab");
  CHECK(passed == "Tab");
}
}

int TestReliefLightWidgetKeys(int, char*[])
{
  TestKeys();
  TestKeyFocus();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
