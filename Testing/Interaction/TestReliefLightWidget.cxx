// SPDX-License-Identifier: BSD-3-Clause
//
// Mouse and keys on the dot of a light: recorded, synthetic, and at bad moments.

#include "WidgetDiary.h"

#include "vtkCallbackCommand.h"
#include "vtkInteractorEventRecorder.h"
#include "vtkLight.h"
#include "vtkMath.h"
#include "vtkReliefMaterial.h"
#include "vtkWidgetEvent.h"
#include "vtkWidgetEventTranslator.h"

#include <algorithm>
#include <functional>
#include <sstream>
#include <vector>

namespace
{
int Failures = 0;

void TestDragging()
{
  WidgetStage stage(Terrain());
  vtkLight* sun = stage.Scene()->AddSun(0.0, 45.0); // its dot: 40 pixels above the middle
  stage.Widget->On();
  stage.Window->Render();
  Diary diary(stage.Widget);
  const vtkMTimeType still = stage.Camera()->GetMTime();
  auto dot = stage.DotInWindow();
  CHECK_NEAR(dot[0], 101.0, 1e-6);
  CHECK_NEAR(dot[1], 121.0, 1e-6);

  // Over the dot the cursor is a hand, and a press that moves nothing changes nothing.
  CHECK(stage.Window->GetCurrentCursor() == VTK_CURSOR_DEFAULT);
  stage.Event(Move, 103, 122);
  CHECK(stage.Window->GetCurrentCursor() == VTK_CURSOR_HAND);
  vtkMTimeType time = sun->GetMTime();
  stage.Event(Press, 103, 122);
  CHECK(stage.Widget->GetDragging());
  stage.Event(Release, 103, 122);
  CHECK(!stage.Widget->GetDragging() && sun->GetMTime() == time && diary.Read() == "SE");

  // The dot goes as far as the mouse, not to the mouse; the filter's picture follows.
  stage.Shading->Update();
  const vtkMTimeType picture = stage.Shading->GetOutput()->GetMTime();
  stage.Event(Press, 103, 122);
  stage.Event(Move, 123, 102);
  stage.Event(Move, 143, 82);
  CHECK(stage.Shading->GetOutput()->GetMTime() > picture);
  stage.Event(Release, 143, 82);
  CHECK(diary.Read() == "SIIE");
  CHECK_NEAR(Azimuth(sun), 90.0, 1e-6);
  CHECK_NEAR(Altitude(sun), 45.0, 1e-6);

  // Released elsewhere in the window it is released all the same.
  stage.Event(Press, 141, 81);
  stage.Event(Move, 181, 81);
  stage.Event(Release, 181, 81);
  stage.Event(Move, 20, 20);
  CHECK_NEAR(Altitude(sun), 0.0, 1e-6);
  CHECK(stage.Window->GetCurrentCursor() == VTK_CURSOR_DEFAULT);
  CHECK(diary.Read() == "SIE");

  // All the while the camera stood still. Beside the dot it turns.
  CHECK(stage.Camera()->GetMTime() == still);
  time = sun->GetMTime();
  stage.Event(Press, 20, 20);
  stage.Event(Move, 30, 30);
  stage.Event(Release, 30, 30);
  CHECK(stage.Camera()->GetMTime() > still && sun->GetMTime() == time && diary.Read().empty());
}

void TestRaising()
{
  WidgetStage stage(Terrain());
  vtkLight* sun = stage.Scene()->AddSun(0.0, 45.0);
  stage.Widget->On();
  Diary diary(stage.Widget);
  const vtkMTimeType still = stage.Camera()->GetMTime();
  // Five pixels are a degree.
  stage.Event(Move, 101, 121);
  stage.Event(Press, 101, 121, true);
  CHECK(stage.Window->GetCurrentCursor() == VTK_CURSOR_SIZENS);
  stage.Event(Move, 101, 146, true);
  CHECK_NEAR(Altitude(sun), 50.0, 1e-6);
  stage.Event(Move, 101, 96, true);
  CHECK_NEAR(Altitude(sun), 40.0, 1e-6);
  stage.Event(Release, 101, 96, true);
  CHECK(diary.Read() == "SIIE");

  // The wheel keeps its hold while the dot runs away from under it, until the mouse moves.
  auto dot = stage.DotInWindow();
  stage.Event(Move, dot[0], dot[1]);
  for (int i = 0; i < 30; ++i)
  {
    stage.Event(vtkCommand::MouseWheelForwardEvent, dot[0], dot[1]);
  }
  CHECK_NEAR(Altitude(sun), 70.0, 1e-6);
  stage.Event(vtkCommand::MouseWheelBackwardEvent, dot[0], dot[1]);
  CHECK_NEAR(Altitude(sun), 69.0, 1e-6);
  CHECK(diary.Read().size() == 3 * 31 && stage.Camera()->GetMTime() == still);
  stage.Event(Move, dot[0], dot[1] + 1.0);
  stage.Event(vtkCommand::MouseWheelForwardEvent, dot[0], dot[1] + 1.0);
  CHECK_NEAR(Altitude(sun), 69.0, 1e-6);
  CHECK(stage.Camera()->GetMTime() > still); // now it is the camera's
}

// The mouse leaves the window: no move tells of it.
void TestLeaving()
{
  WidgetStage stage(Terrain());
  stage.Scene()->AddSun(180.0, 80.0);
  stage.Widget->On();
  auto dot = stage.DotInWindow();
  const auto far = stage.Pixel(101, 1);
  stage.Event(Move, dot[0], dot[1]);
  CHECK(stage.Pixel(101, 1) != far);
  stage.Interactor->InvokeEvent(vtkCommand::LeaveEvent, nullptr);
  CHECK(stage.Pixel(101, 1) == far);
  CHECK(stage.Window->GetCurrentCursor() == VTK_CURSOR_DEFAULT);
  // While the dot is dragged it stays with the mouse; released beyond the window it is done with.
  vtkNew<vtkReliefMaterial> material;
  material->UseFloorOn();
  stage.Scene()->SetMaterial(material);
  stage.Event(Move, dot[0], dot[1]);
  stage.Event(Press, dot[0], dot[1]);
  stage.Interactor->InvokeEvent(vtkCommand::LeaveEvent, nullptr);
  CHECK(stage.Widget->GetDragging() && stage.Pixel(101, 1) != far);
  stage.Event(Move, 101, -20);
  CHECK_NEAR(stage.DotInWindow()[1], -20.0, 0.5);
  stage.Event(Release, 101, -20);
  const auto released = stage.Pixel(181, 81); // where the horizon would be
  stage.Event(Move, 5, 5);
  CHECK(stage.Pixel(181, 81) == released);
}

// Until the first frame the renderer has no camera; whoever makes it one keeps it from the reset.
void TestBeforeTheFirstFrame()
{
  vtkSmartPointer<vtkImageData> terrain = Terrain();
  terrain->SetOrigin(5000.0, 7000.0, 0.0); // far from where a camera stands that nobody has set
  vtkNew<vtkImageReliefShading> shading;
  shading->SetInputData(terrain);
  shading->SetOutputScalarTypeToUnsignedChar();
  shading->GetScene()->AddSun(0.0, 45.0);
  vtkNew<vtkImageSliceMapper> mapper;
  mapper->SetInputConnection(shading->GetOutputPort());
  vtkNew<vtkImageSlice> slice;
  slice->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddViewProp(slice);
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetSize(202, 162);
  window->AddRenderer(renderer);
  vtkNew<vtkGenericRenderWindowInteractor> interactor;
  interactor->SetRenderWindow(window);
  interactor->SetInteractorStyle(nullptr); // it may ask for the camera
  interactor->EnableRenderOff();
  vtkNew<vtkReliefLightWidget> widget;
  widget->SetInteractor(interactor);
  vtkReliefLightRepresentation* dot = widget->GetLightRepresentation();
  dot->SetScene(shading->GetScene());
  dot->PlaceWidget(terrain);
  widget->On();
  // All that could ask for the camera.
  double at[3];
  CHECK(dot->GetDotPosition(at));
  CHECK(!dot->MoveDot(101.0, 81.0) && !dot->ShiftDot(1.0, 1.0));
  CHECK(dot->RaiseLight(1.0) && dot->SwitchLightType() && dot->SwitchLightType());
  CHECK(dot->ComputeInteractionState(101, 81) == vtkReliefLightRepresentation::Outside);
  dot->Highlight(1);
  dot->BuildRepresentation();
  const auto event = [&](unsigned long id, const char* key)
  {
    interactor->SetEventInformation(101, 81, 0, 0, 0, 0, key);
    interactor->InvokeEvent(id, nullptr);
  };
  for (const unsigned long id : std::vector<unsigned long>{ Move, Press, Release,
         vtkCommand::MouseWheelForwardEvent, vtkCommand::LeftButtonDoubleClickEvent, Release })
  {
    event(id, nullptr);
  }
  for (const char* key : { "Tab", "Right", "Prior", "Escape" })
  {
    event(Key, key);
  }
  widget->Off();
  widget->On();
  CHECK(!renderer->IsActiveCameraCreated());

  // Then VTK makes it and sets it on the relief, and the dot is there.
  interactor->EnableRenderOn();
  window->Render();
  const double* focus = renderer->GetActiveCamera()->GetFocalPoint();
  CHECK_NEAR(focus[0], 5050.0, 1.0);
  CHECK_NEAR(focus[1], 7040.0, 1.0);
  CHECK(dot->GetDotPosition(at));
  renderer->SetWorldPoint(at[0], at[1], at[2], 1.0);
  renderer->WorldToDisplay();
  const double* shown = renderer->GetDisplayPoint();
  CHECK(dot->ComputeInteractionState(static_cast<int>(shown[0]), static_cast<int>(shown[1])) ==
    vtkReliefLightRepresentation::Nearby);
  window->SetInteractor(nullptr);
}

void TestDoubleClick()
{
  WidgetStage stage(Terrain());
  vtkLight* light = stage.Scene()->AddSun(0.0, 45.0);
  stage.Widget->On();
  Diary diary(stage.Widget);
  // Told by a press that is a repetition, and by an event of its own.
  stage.Event(Press, 101, 121);
  stage.Event(Release, 101, 121);
  stage.Event(Press, 101, 121, false, 1);
  stage.Event(Release, 101, 121, false, 1);
  CHECK(light->GetPositional() && diary.Read() == "SESIE");
  auto dot = stage.DotInWindow();
  stage.Event(vtkCommand::LeftButtonDoubleClickEvent, dot[0], dot[1], false, 1);
  stage.Event(Release, dot[0], dot[1]);
  CHECK(!light->GetPositional() && diary.Read() == "SIE");
  dot = stage.DotInWindow();
  CHECK_NEAR(dot[0], 101.0, 1e-6);
  CHECK_NEAR(dot[1], 121.0, 1e-6);
  // Beside the dot it is not the widget's.
  stage.Event(Press, 20, 20, false, 1);
  stage.Event(Release, 20, 20, false, 1);
  CHECK(!light->GetPositional() && diary.Read().empty());
}

// What vtkInteractorEventRecorder has recorded: the dot of a sun is dragged to the east, made a
// lamp's, dragged again and raised.
void TestRecordedEvents()
{
  const char* events = "# StreamVersion 1.1\n"
                       "MouseMoveEvent 90 110 0 0 0 0 0\n"
                       "MouseMoveEvent 101 121 0 0 0 0 0\n"
                       "LeftButtonPressEvent 101 121 0 0 0 0 0\n"
                       "MouseMoveEvent 111 111 0 0 0 0 0\n"
                       "MouseMoveEvent 121 101 0 0 0 0 0\n"
                       "MouseMoveEvent 141 81 0 0 0 0 0\n"
                       "LeftButtonReleaseEvent 141 81 0 0 0 0 0\n"
                       "LeftButtonPressEvent 141 81 0 0 0 0 0\n"
                       "LeftButtonReleaseEvent 141 81 0 0 0 0 0\n"
                       "LeftButtonPressEvent 141 81 0 0 1 0 0\n"
                       "LeftButtonReleaseEvent 141 81 0 0 1 0 0\n"
                       "MouseMoveEvent 191 81 0 0 0 0 0\n"
                       "LeftButtonPressEvent 191 81 0 0 0 0 0\n"
                       "MouseMoveEvent 151 61 0 0 0 0 0\n"
                       "LeftButtonReleaseEvent 151 61 0 0 0 0 0\n"
                       "MouseWheelForwardEvent 151 61 0 0 0 0 0\n"
                       "MouseMoveEvent 20 20 0 0 0 0 0\n";
  WidgetStage stage(Terrain());
  vtkLight* light = stage.Scene()->AddSun(0.0, 45.0);
  stage.Widget->On();
  stage.Window->Render();
  const vtkMTimeType still = stage.Camera()->GetMTime();
  Diary diary(stage.Widget);
  vtkNew<vtkInteractorEventRecorder> recorder;
  recorder->SetInteractor(stage.Interactor);
  recorder->ReadFromInputStringOn();
  recorder->SetInputString(events);
  recorder->Play();
  CHECK(diary.Read() == "SIIIESESIESIESIE");
  CHECK(light->GetPositional());
  // The lamp was put nine tenths of the way to the edge, 45 of 50, in the east; as high above the
  // mean, for the sun was at 45 degrees. It was dragged by (-20, -10) and raised by a step.
  const double* position = light->GetPosition();
  CHECK_NEAR(position[0], 50.0 + 45.0 - 20.0, 1e-6);
  CHECK_NEAR(position[1], 40.0 - 10.0, 1e-6);
  const double height = position[2] - stage.Dot()->GetMeanHeight();
  CHECK_NEAR(height, 4.0 * std::sinh(std::asinh(45.0 / 4.0) + 0.1), 1e-6);
  CHECK(stage.Camera()->GetMTime() == still);
}

void TestPicture()
{
  WidgetStage stage(Terrain());
  vtkLight* sun = stage.Scene()->AddSun(0.0, 45.0);
  sun->SetDiffuseColor(2.0, 1.0, 0.0); // the dot: orange, at full brightness
  const auto without = stage.Pixel(101, 121);
  stage.Widget->On();
  const std::array<int, 3> orange = { 255, 128, 0 };
  CHECK(without != orange && stage.Pixel(101, 121) == orange);
  // It follows the light, whoever moves it; and gets dark with it.
  sun->SetPosition(1.0, 0.0, 1.0);
  CHECK(stage.Pixel(101, 121) != orange && stage.Pixel(141, 81) == orange);
  sun->SwitchOff();
  CHECK((stage.Pixel(141, 81) == std::array<int, 3>{ 0, 0, 0 }));
  sun->SwitchOn();
  // The slice is moved, and the dot with it.
  stage.Dot()->SetProp(stage.Slice);
  stage.Slice->SetPosition(-10.0, 5.0, 0.0);
  CHECK(stage.Pixel(121, 91) == orange);
  stage.Slice->SetPosition(0.0, 0.0, 0.0);
  // The horizon is shown while the mouse is over the dot of a sun.
  const auto south = stage.Pixel(101, 1);
  stage.Event(Move, 141, 81);
  CHECK(stage.Pixel(101, 1) != south);
  stage.Event(Move, 20, 20);
  CHECK(stage.Pixel(101, 1) == south);
  // Gone, it leaves nothing.
  const auto corner = stage.Pixel(150, 81);
  stage.Widget->Off();
  CHECK(stage.Pixel(141, 81) != orange && stage.Pixel(150, 81) != corner);
  // Graphics resources come and go.
  stage.Widget->On();
  stage.Window->Finalize();
  CHECK(stage.Pixel(141, 81) == orange);
}

// Whatever happens in the middle of a drag ends it, once, and the camera has the mouse again.
void TestBadMoments()
{
  const std::function<void(WidgetStage&)> moments[] = {
    [](WidgetStage& stage) { stage.Widget->Off(); },
    [](WidgetStage& stage) { stage.Widget->ProcessEventsOff(); },
    [](WidgetStage& stage) { stage.Scene()->RemoveAllLights(); },
    [](WidgetStage& stage) { stage.Dot()->SetScene(nullptr); },
    [](WidgetStage& stage) { stage.Dot()->SetLight(stage.Scene()->AddSun(10.0, 10.0)); },
    [](WidgetStage& stage) { stage.Widget->SetInteractor(nullptr); },
    [](WidgetStage& stage) { stage.Widget->SetRepresentation(nullptr); },
    [](WidgetStage& stage)
    {
      vtkNew<vtkReliefLightRepresentation> other;
      stage.Widget->SetRepresentation(other);
    },
  };
  int number = 0;
  for (const auto& moment : moments)
  {
    WidgetStage stage(Terrain());
    stage.Scene()->AddSun(0.0, 45.0);
    stage.Widget->On();
    stage.Window->Render();
    Diary diary(stage.Widget);
    vtkSmartPointer<vtkReliefLightWidget> widget = stage.Widget.Get();
    stage.Event(Press, 101, 121);
    stage.Event(Move, 105, 121);
    moment(stage);
    stage.Event(Move, 110, 121);
    std::string happened = diary.Read();
    CHECK(happened.substr(0, 2) == "SI");
    CHECK(std::count(happened.begin(), happened.end(), 'E') == 1);
    CHECK(!widget->GetDragging());
    const vtkMTimeType still = stage.Camera()->GetMTime();
    stage.Event(Release, 110, 121);
    stage.Event(Press, 20, 20);
    stage.Event(Move, 30, 30);
    stage.Event(Release, 30, 30);
    CHECK(stage.Camera()->GetMTime() > still);
    if (Failures)
    {
      std::cout << "moment " << number << ": " << happened << std::endl;
    }
    ++number;
  }

  // The interactor goes away in the middle of a drag, after its window or before it, or the widget
  // does, or from within an event.
  {
    WidgetStage stage(Terrain());
    stage.Scene()->AddSun(0.0, 45.0);
    stage.Widget->On();
    Diary diary(stage.Widget);
    stage.Event(Press, 101, 121);
    stage.Interactor->SetRenderWindow(nullptr);
    stage.Window->SetInteractor(nullptr);
    stage.Interactor = nullptr;
    CHECK(stage.Widget->GetInteractor() == nullptr && diary.Read() == "SE-");
  }
  {
    WidgetStage stage(Terrain());
    stage.Scene()->AddSun(0.0, 45.0);
    stage.Widget->On();
    Diary diary(stage.Widget);
    stage.Event(Press, 101, 121);
    stage.Window->SetInteractor(nullptr);
    stage.Interactor = nullptr;
    CHECK(stage.Widget->GetInteractor() == nullptr && !stage.Widget->GetEnabled());
    CHECK(diary.Read() == "SE-");
  }
  {
    WidgetStage stage(Terrain());
    stage.Scene()->AddSun(0.0, 45.0);
    {
      vtkNew<vtkReliefLightWidget> widget;
      widget->SetInteractor(stage.Interactor);
      widget->GetLightRepresentation()->SetScene(stage.Scene());
      widget->GetLightRepresentation()->PlaceWidget(Terrain());
      widget->On();
      stage.Event(Press, 101, 121);
      CHECK(widget->GetDragging());
    }
    const vtkMTimeType still = stage.Camera()->GetMTime();
    stage.Event(Release, 101, 121);
    stage.Event(Press, 101, 121);
    stage.Event(Move, 111, 121);
    stage.Event(Release, 111, 121);
    CHECK(stage.Camera()->GetMTime() > still);
    stage.Window->Render();
  }
  {
    WidgetStage stage(Terrain());
    stage.Scene()->AddSun(0.0, 45.0);
    stage.Widget->On();
    Observe(
      stage.Widget, vtkCommand::InteractionEvent, [&](unsigned long) { stage.Widget->Off(); });
    stage.Event(Press, 101, 121);
    stage.Event(Move, 111, 121);
    CHECK(!stage.Widget->GetDragging() && !stage.Widget->GetEnabled());
  }

  // Without a scene there is nothing to take hold of; without an interactor, an error of VTK's own.
  WidgetStage stage(Terrain());
  stage.Dot()->SetScene(nullptr);
  stage.Widget->On();
  stage.Event(Press, 101, 121);
  stage.Event(vtkCommand::LeftButtonDoubleClickEvent, 101, 121);
  stage.Event(vtkCommand::MouseWheelForwardEvent, 101, 121);
  stage.Event(Release, 101, 121);
  CHECK(!stage.Widget->GetDragging());
  stage.Window->Render();
  vtkNew<vtkReliefLightWidget> loose;
  MessageKeeper messages(loose);
  loose->On();
  CHECK(messages.OneError("interactor") && !loose->GetEnabled());
  std::ostringstream printed;
  loose->Print(printed);
  CHECK(printed.str().find("Dragging: Off") != std::string::npos);
}

// Two lights have a widget each; the one that is on top of the other gets the mouse.
void TestTwoLights()
{
  WidgetStage stage(Terrain());
  vtkLight* north = stage.Scene()->AddSun(0.0, 45.0);
  vtkLight* east = stage.Scene()->AddSun(90.0, 45.0);
  vtkNew<vtkReliefLightWidget> second;
  second->SetInteractor(stage.Interactor);
  second->GetLightRepresentation()->SetScene(stage.Scene());
  second->GetLightRepresentation()->SetLight(east);
  second->GetLightRepresentation()->PlaceWidget(Terrain());
  stage.Widget->On();
  second->On();
  stage.Event(Press, 141, 81);
  CHECK(second->GetDragging() && !stage.Widget->GetDragging());
  stage.Event(Move, 101, 121); // over the other dot
  stage.Event(Release, 101, 121);
  CHECK_NEAR(Azimuth(east), 0.0, 1e-6);
  stage.Event(Press, 101, 121);
  stage.Event(Move, 61, 81);
  stage.Event(Release, 61, 81);
  CHECK_NEAR(std::abs(Azimuth(north) - Azimuth(east)), 90.0, 1e-6); // one of them, not both
}

// Other buttons and keys may be given to what the widget does.
void TestTranslations()
{
  WidgetStage stage(Terrain());
  vtkLight* sun = stage.Scene()->AddSun(0.0, 45.0);
  stage.Widget->GetEventTranslator()->SetTranslation(
    vtkCommand::RightButtonPressEvent, vtkWidgetEvent::Select);
  stage.Widget->GetEventTranslator()->SetTranslation(
    vtkCommand::RightButtonReleaseEvent, vtkWidgetEvent::EndSelect);
  stage.Widget->On();
  stage.Event(vtkCommand::RightButtonPressEvent, 101, 121);
  stage.Event(Move, 141, 81);
  stage.Event(vtkCommand::RightButtonReleaseEvent, 141, 81);
  CHECK_NEAR(Azimuth(sun), 90.0, 1e-6);
}
}

int TestReliefLightWidget(int, char*[])
{
  TestDragging();
  TestRaising();
  TestLeaving();
  TestBeforeTheFirstFrame();
  TestDoubleClick();
  TestRecordedEvents();
  TestPicture();
  TestBadMoments();
  TestTwoLights();
  TestTranslations();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
