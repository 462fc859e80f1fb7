// SPDX-License-Identifier: BSD-3-Clause
//
// The mapper beside VTK's shadows: its picture stays as it is and costs no more, and shadows of
// what is around it fall as they should, its own too.

#include "ReliefMapperTestUtilities.h"

#include "vtkActor.h"
#include "vtkCameraPass.h"
#include "vtkLight.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkRenderPassCollection.h"
#include "vtkSequencePass.h"
#include "vtkShadowMapBakerPass.h"
#include "vtkShadowMapPass.h"
#include "vtkSphereSource.h"

namespace
{

int Failures = 0;

constexpr int Width = 400;
constexpr int Height = 100;
constexpr int Left = -50;  // x of the first column
constexpr int Bottom = -5; // y of the first row

vtkSmartPointer<vtkActor> AddActor(vtkRenderer* renderer, vtkPolyDataAlgorithm* source)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(source->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->SetDiffuse(1.0);
  actor->GetProperty()->SetSpecular(0.0);
  renderer->AddViewProp(actor);
  return actor;
}

// A relief of 120 by 90 samples and, at its right, a ball; below both a plane. A light shines from
// above the left, so that shadows fall 40 units to the right of what is 40 units above the plane.
struct ShadowStage : MapperStage
{
  vtkSmartPointer<vtkActor> ball;
  vtkSmartPointer<vtkActor> plane;
  vtkNew<vtkLight> light;
  vtkSmartPointer<vtkShadowMapPass> shadows;

  ShadowStage()
    : MapperStage(MakeHeights(120, 90, Hills(1)))
  {
    this->Scene()->AddSun(300.0, 30.0);
    vtkNew<vtkSphereSource> sphere;
    sphere->SetCenter(220.0, 45.0, 0.0);
    sphere->SetRadius(15.0);
    sphere->SetThetaResolution(32);
    sphere->SetPhiResolution(32);
    this->ball = AddActor(this->renderer, sphere);
    vtkNew<vtkPlaneSource> ground;
    ground->SetOrigin(Left, Bottom, -40.0);
    ground->SetPoint1(Left + Width, Bottom, -40.0);
    ground->SetPoint2(Left, Bottom + Height, -40.0);
    this->plane = AddActor(this->renderer, ground);
    this->light->SetLightTypeToSceneLight();
    this->light->SetPosition(-1.0, 0.0, 1.0);
    this->light->SetFocalPoint(0.0, 0.0, 0.0);
    this->renderer->AutomaticLightCreationOff();
    this->renderer->AddLight(this->light);

    this->window->SetSize(Width, Height);
    vtkCamera* camera = this->renderer->GetActiveCamera();
    camera->SetFocalPoint(Left + 0.5 * Width, Bottom + 0.5 * Height, 0.0);
    camera->SetPosition(Left + 0.5 * Width, Bottom + 0.5 * Height, 100.0);
    camera->SetParallelScale(0.5 * Height);
  }

  ~ShadowStage() { this->EnableShadows(false); }

  // As programs do it, by passes of its own each time.
  void EnableShadows(bool enable)
  {
    if (this->shadows)
    {
      this->shadows->ReleaseGraphicsResources(this->window);
      this->shadows = nullptr;
      this->renderer->SetPass(nullptr);
    }
    if (!enable)
    {
      return;
    }
    this->shadows = vtkSmartPointer<vtkShadowMapPass>::New();
    vtkNew<vtkRenderPassCollection> passes;
    passes->AddItem(this->shadows->GetShadowMapBakerPass());
    passes->AddItem(this->shadows);
    vtkNew<vtkSequencePass> sequence;
    sequence->SetPasses(passes);
    vtkNew<vtkCameraPass> pass;
    pass->SetDelegatePass(sequence);
    this->renderer->SetPass(pass);
  }

  int Red(int x, int y)
  {
    return this->Pixels()->GetTypedComponent(
      static_cast<vtkIdType>(y - Bottom) * Width + x - Left, 0);
  }

  // How many of the relief's pixels differ from another picture's, but for its margin.
  int CountOther(vtkUnsignedCharArray* expected)
  {
    auto pixels = this->Pixels();
    int others = 0;
    for (int y = 2; y < 87; ++y)
    {
      for (int x = 2; x < 117; ++x)
      {
        const vtkIdType at = static_cast<vtkIdType>(y - Bottom) * Width + x - Left;
        for (int c = 0; c < 3; ++c)
        {
          others += pixels->GetTypedComponent(at, c) != expected->GetTypedComponent(at, c);
        }
      }
    }
    return others;
  }
};

void TestShadows(int device)
{
  ShadowStage stage;
  stage.mapper->SetTracing(device);
  CHECK(stage.Render());
  auto plain = stage.Pixels();
  const vtkTypeInt64 rays = stage.mapper->GetStatistics()->GetRaysTraced();
  const int lit = stage.Red(200, 45);
  CHECK(rays > 0 && lit > 150);
  CHECK(stage.Red(140, 45) == lit && stage.Red(260, 45) == lit);

  // The picture is the same, and nothing of it is traced for the light's camera.
  stage.mapper->ReleaseGraphicsResources(stage.window);
  stage.EnableShadows(true);
  CHECK(stage.Render());
  CHECK(stage.CountOther(plain) == 0);
  CHECK(stage.mapper->GetStatistics()->GetRaysTraced() == rays);
  // The relief's shadow, the ball's, and neither.
  CHECK(stage.Red(140, 45) < lit / 2);
  CHECK(stage.Red(260, 45) < lit / 2);
  CHECK(std::abs(stage.Red(200, 45) - lit) <= 2);

  // Later frames trace no ray, even where the shadows are measured anew.
  for (int round = 0; round < 2; ++round)
  {
    stage.ball->SetPosition(0.0, 0.0, 4.0 * round);
    CHECK(stage.Render());
    CHECK(stage.mapper->GetStatistics()->GetRaysTraced() == 0);
    CHECK(stage.mapper->GetConverged());
    CHECK(stage.CountOther(plain) == 0);
  }

  // What is hidden throws no shadow.
  stage.slice->VisibilityOff();
  CHECK(stage.Render());
  CHECK(std::abs(stage.Red(140, 45) - lit) <= 2);
}

// Backing, translucency, no data, lights of any number, and the renderer's own lights as the
// scene's.
void TestKinds()
{
  ShadowStage stage;
  vtkNew<vtkLight> second;
  second->SetLightTypeToSceneLight();
  second->SetPosition(100.0, 400.0, 300.0);
  second->SetFocalPoint(100.0, 45.0, 0.0);
  second->PositionalOn();
  second->SetConeAngle(60.0);
  for (int kind = 0; kind < 5; ++kind)
  {
    stage.EnableShadows(false);
    vtkImageProperty* property = stage.slice->GetProperty();
    property->SetBacking(kind == 1);
    property->SetBackingColor(0.2, 0.6, 0.4);
    property->SetOpacity(kind == 2 ? 0.5 : 1.0);
    if (kind == 3)
    {
      stage.renderer->AddLight(second);
    }
    if (kind == 4)
    {
      stage.Scene()->RemoveAllLights();
    }
    CHECK(stage.Render());
    auto plain = stage.Pixels();
    stage.EnableShadows(true);
    CHECK(stage.Render());
    if (kind != 2) // what shines through is in shadow
    {
      CHECK(stage.CountOther(plain) == 0);
    }
  }
}

// A backing has the colour that it was given, whatever the lights.
void TestBackingColor()
{
  for (const bool lights : { true, false })
  {
    MapperStage stage(MakeHeights(120, 90, [](int, int) { return std::nan(""); }));
    stage.slice->GetProperty()->BackingOn();
    stage.slice->GetProperty()->SetBackingColor(0.2, 0.6, 0.4);
    stage.renderer->SetAutomaticLightCreation(lights);
    CHECK(stage.Render());
    const double expected[] = { 0.2, 0.6, 0.4 };
    for (int c = 0; c < 3; ++c)
    {
      CHECK_NEAR(stage.Pixels()->GetTypedComponent(45 * 120 + 60, c), 255.0 * expected[c], 1.0);
    }
  }
}

}

int TestReliefImageMapperShadows(int, char*[])
{
  for (const int device : TracingDevices)
  {
    TestShadows(device);
  }
  TestKinds();
  TestBackingColor();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
