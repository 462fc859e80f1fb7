// SPDX-License-Identifier: BSD-3-Clause
//
// The mapper in several renderers and windows, without its graphics resources, in motion and while
// its picture is refined.

#include "ReliefMapperTestUtilities.h"

#include "vtkCallbackCommand.h"
#include "vtkGenericRenderWindowInteractor.h"
#include "vtkLight.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"

namespace
{

int Failures = 0;

vtkSmartPointer<vtkImageData> Terrain(int columns = 120, int rows = 90)
{
  return MakeHeights(columns, rows, Hills(1));
}

unsigned long Observe(vtkObject* object, unsigned long event, std::function<void()> body)
{
  vtkNew<vtkCallbackCommand> command;
  command->SetClientData(new std::function<void()>(std::move(body)));
  command->SetClientDataDeleteCallback(
    [](void* data) { delete static_cast<std::function<void()>*>(data); });
  command->SetCallback([](vtkObject*, unsigned long, void* data, void*)
    { (*static_cast<std::function<void()>*>(data))(); });
  return object->AddObserver(event, command);
}

// Two renderers of a window see the same slice from different places, and neither traces anew
// because the other has drawn.
void TestRenderers()
{
  MapperStage stage(Terrain());
  stage.Scene()->AddSun(300.0, 30.0);
  CHECK(stage.Render());
  auto alone = stage.Shading();

  vtkNew<vtkRenderer> second;
  second->AddViewProp(stage.slice);
  second->SetViewport(0.5, 0.0, 1.0, 1.0);
  second->GetActiveCamera()->DeepCopy(stage.renderer->GetActiveCamera());
  second->GetActiveCamera()->SetParallelScale(20.0);
  stage.renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  stage.renderer->GetActiveCamera()->SetParallelScale(90.0);
  stage.window->AddRenderer(second);
  CHECK(stage.Render());
  CHECK(stage.Render());
  CHECK(stage.mapper->GetStatistics()->GetRaysTraced() == 0);
  vtkNew<vtkImageData> detail;
  CHECK(stage.mapper->GetShading(second, detail));
  const int i = static_cast<int>(detail->GetOrigin()[0]) + 10;
  const int j = static_cast<int>(detail->GetOrigin()[1]) + 10;
  CHECK(detail->GetSpacing()[0] == 1.0);
  CHECK(Value(detail, nullptr, 10, 10) == Value(alone, nullptr, i, j));

  // Two slices in one renderer, the upper one of which lets the lower one through.
  MapperStage both(Terrain());
  both.Scene()->AddSun(0.0, 90.0); // all white
  both.Scene()->GetMaterial()->SetOffsetModeToVertical();
  auto upper = vtkSmartPointer<vtkReliefImageMapper>::New();
  upper->SetInputData(Terrain());
  upper->GetScene()->GetMaterial()->SetDiffuseColor(0.0, 0.0, 0.0);
  vtkNew<vtkImageSlice> over;
  over->SetMapper(upper);
  over->SetPosition(30.0, 0.0, 1.0);
  over->GetProperty()->SetOpacity(0.4);
  both.renderer->AddViewProp(over);
  CHECK(both.Render());
  auto pixels = both.Pixels();
  CHECK(pixels->GetTypedComponent(45 * 120 + 10, 0) == 255);
  CHECK_NEAR(pixels->GetTypedComponent(45 * 120 + 80, 0), 0.6 * 255.0, 1.0);
}

// One slice in two windows, each with resources of its own.
void TestWindows()
{
  MapperStage stage(Terrain());
  stage.Scene()->AddSun(300.0, 30.0);
  CHECK(stage.Render());
  auto expected = stage.Pixels();

  vtkNew<vtkRenderer> renderer;
  renderer->AddViewProp(stage.slice);
  renderer->SetActiveCamera(stage.renderer->GetActiveCamera());
  vtkSmartPointer<vtkRenderWindow> other = vtkSmartPointer<vtkRenderWindow>::New();
  other->OffScreenRenderingOn();
  other->SetMultiSamples(0);
  other->SetSize(120, 90);
  other->AddRenderer(renderer);
  WatchOpenGL(other);
  for (int round = 0; round < 3; ++round)
  {
    other->Render();
    vtkNew<vtkUnsignedCharArray> pixels;
    other->GetPixelData(0, 0, 119, 89, 0, pixels.Get(), 0);
    CHECK(SameBytes(pixels, expected));
    CHECK(stage.Render());
    CHECK(SameBytes(stage.Pixels(), expected));
  }
  CHECK(stage.mapper->GetStatistics()->GetRaysTraced() == 0);
  other = nullptr;
  CHECK(stage.Render());
  CHECK(SameBytes(stage.Pixels(), expected));
}

// Graphics resources may be released at any time, and a lost context comes back.
void TestRelease()
{
  MapperStage stage(Terrain());
  stage.Scene()->AddSun(300.0, 30.0);
  CHECK(stage.Render());
  auto expected = stage.Pixels();
  stage.mapper->ReleaseGraphicsResources(stage.window);
  stage.mapper->ReleaseGraphicsResources(stage.window);
  CHECK(!stage.mapper->GetConverged());
  CHECK(stage.Render() && stage.mapper->GetConverged());
  CHECK(SameBytes(stage.Pixels(), expected));

  stage.window->Finalize();
  CHECK(stage.Render());
  CHECK(SameBytes(stage.Pixels(), expected));

  // Out of the renderer and back; the window first, then the mapper.
  stage.renderer->RemoveViewProp(stage.slice);
  CHECK(stage.Render());
  stage.renderer->AddViewProp(stage.slice);
  CHECK(stage.Render());
  CHECK(SameBytes(stage.Pixels(), expected));
  stage.slice->VisibilityOff();
  CHECK(stage.Render());
  stage.slice->VisibilityOn();
  stage.renderer->DrawOff();
  CHECK(stage.Render());
  stage.renderer->DrawOn();
  CHECK(stage.Render());
  CHECK(SameBytes(stage.Pixels(), expected));
  stage.renderer->RemoveViewProp(stage.slice);
  stage.window = nullptr;
  vtkNew<vtkImageData> nothing;
  CHECK(!stage.mapper->GetShading(stage.renderer, nothing));
}

// While things move, detail is given up for the frame rate; at rest it comes back.
void TestMotion(int device)
{
  MapperStage stage(Terrain(600, 450));
  stage.mapper->SetTracing(device);
  vtkLight* sun = stage.Scene()->AddSun(300.0, 30.0);
  CHECK(stage.Render()); // tells how fast this machine is
  sun->SetPosition(-1.0, 0.5, 0.5);
  CHECK(stage.Render());
  sun->SetPosition(-1.0, 1.0, 0.5);
  stage.window->SetDesiredUpdateRate(10000.0);
  CHECK(stage.Render());
  CHECK(!stage.mapper->GetConverged() && stage.mapper->GetRefinement() < 1.0);
  const vtkTypeInt64 rays = stage.mapper->GetStatistics()->GetRaysTraced();
  CHECK(rays > 0 && rays < 600 * 450 / 16);
  CHECK(stage.Shading()->GetSpacing()[0] > 4.0);

  // Nothing moves any more, but the window has not been told.
  CHECK(stage.Render());
  CHECK(stage.mapper->GetStatistics()->GetRaysTraced() == 0);

  int converged = 0;
  Observe(stage.mapper, vtkReliefImageMapper::ConvergedEvent, [&]() { ++converged; });
  stage.window->SetDesiredUpdateRate(0.0001);
  CHECK(stage.Render());
  CHECK(stage.mapper->GetConverged() && stage.mapper->GetRefinement() == 1.0 && converged == 1);
  CHECK(stage.mapper->GetStatistics()->GetRaysTraced() == 600 * 450);
  auto moved = stage.Shading();
  CHECK(stage.Render() && converged == 1);

  MapperStage fresh(Terrain(600, 450));
  fresh.mapper->SetTracing(device);
  fresh.Scene()->AddSun(300.0, 30.0)->SetPosition(-1.0, 1.0, 0.5);
  CHECK(fresh.Render());
  CHECK(
    SameBytes(moved->GetPointData()->GetScalars(), fresh.Shading()->GetPointData()->GetScalars()));
}

// An interactor whose timers fire when a test says so.
class Timers
{
public:
  explicit Timers(vtkRenderWindow* window)
  {
    this->Interactor->AddObserver(vtkCommand::CreateTimerEvent, this, &Timers::Create);
    this->Interactor->SetRenderWindow(window);
    this->Interactor->Initialize();
  }

  // Fires the timers that are due until none is asked for any more; how many have fired.
  int Run()
  {
    int fired = 0;
    for (; this->Pending && fired < 100000; ++fired)
    {
      int timer = this->Pending;
      this->Pending = 0;
      this->Interactor->InvokeEvent(vtkCommand::TimerEvent, &timer);
    }
    return fired;
  }

  // A timer passes that nobody hears of.
  void Miss() { this->Pending = 0; }

private:
  void Create(vtkObject*, unsigned long, void* timer)
  {
    this->Pending = this->Interactor->GetTimerEventDuration() == 1 ? *static_cast<int*>(timer) : 0;
  }

  vtkNew<vtkGenericRenderWindowInteractor> Interactor;
  int Pending = 0;
};

// With an interactor, a picture with many lights comes at once and gets better by itself.
void TestRefinement(int device)
{
  MapperStage stage(Terrain(300, 225));
  stage.mapper->SetTracing(device);
  stage.Scene()->SetLightsToSkyDome();
  CHECK(stage.Render() && stage.mapper->GetConverged());
  const Agreement complete = CompareColors(stage.Shading(), stage.Shading(), 0.0);
  auto expected = stage.Shading();

  Timers timers(stage.window);
  stage.mapper->SetCacheMemoryLimit(0);
  stage.mapper->SetProgressiveFrameTime(1.0e-4);
  stage.mapper->ReleaseGraphicsResources(stage.window);
  CHECK(stage.Render());
  CHECK(!stage.mapper->GetConverged());
  CHECK(stage.mapper->GetStatistics()->GetLightsTraced() == 1);
  // As bright as it will be, if not yet lit from all sides.
  const Agreement first = CompareColors(stage.Shading(), stage.Shading(), 0.0);
  CHECK_NEAR(first.mean / complete.mean, 1.0, 0.5);

  double refinement = 0.0;
  bool rises = true;
  auto note = [&]()
  {
    rises = rises && stage.mapper->GetRefinement() >= refinement;
    refinement = stage.mapper->GetRefinement();
  };
  // Not even after a timer that came while a dragged dot held the interactor's focus.
  timers.Miss();
  CHECK(stage.Render() && !stage.mapper->GetConverged());
  const unsigned long observer = Observe(stage.window, vtkCommand::EndEvent, note);
  int converged = 0;
  Observe(stage.mapper, vtkReliefImageMapper::ConvergedEvent, [&]() { ++converged; });
  CHECK(timers.Run() > 10 && rises);
  stage.window->RemoveObserver(observer);
  CHECK(stage.mapper->GetConverged() && converged == 1);
  CHECK(timers.Run() == 0);
  CHECK(CompareColors(expected, stage.Shading(), 1.0e-4).shareBeyond == 0.0);

  // With Progressive off a frame is complete in any case.
  stage.mapper->ReleaseGraphicsResources(stage.window);
  stage.mapper->ProgressiveOff();
  CHECK(stage.Render() && stage.mapper->GetConverged());

  // The same with lights whose illumination is kept: coarse first, then band by band.
  stage.mapper->ProgressiveOn();
  stage.mapper->SetCacheMemoryLimit(262144);
  stage.Scene()->SetEnvironment(nullptr);
  for (int k = 0; k < 6; ++k)
  {
    stage.Scene()->AddSun(60.0 * k, 30.0)->SetIntensity(0.3);
  }
  CHECK(stage.Render());
  CHECK(!stage.mapper->GetConverged() && stage.Shading()->GetSpacing()[0] > 1.0);
  CHECK(timers.Run() > 1);
  CHECK(stage.mapper->GetConverged() && stage.Shading()->GetSpacing()[0] == 1.0);
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(stage.mapper->GetInput());
  filter->SetScene(stage.Scene());
  filter->Update();
  CHECK(CompareColors(filter->GetOutput(), stage.Shading(), 6e-3).shareBeyond <= 1e-3);
}

}

int TestReliefImageMapperWindows(int, char*[])
{
  TestRenderers();
  TestWindows();
  TestRelease();
  for (const int device : TracingDevices)
  {
    TestMotion(device);
    TestRefinement(device);
  }
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
