// SPDX-License-Identifier: BSD-3-Clause
//
// The mapper among others: with actors in front of it and behind it, in layers, stacks and
// assemblies, with each way to draw what is translucent, smoothed, in stereo and in pictures of a
// window's parts.

#include "ReliefMapperTestUtilities.h"

#include "vtkActor.h"
#include "vtkAssembly.h"
#include "vtkImageStack.h"
#include "vtkPlaneSource.h"
#include "vtkPolyDataMapper.h"
#include "vtkProperty.h"
#include "vtkReliefMaterial.h"
#include "vtkRenderStepsPass.h"
#include "vtkSSAAPass.h"
#include "vtkWindowToImageFilter.h"

#include <array>

namespace
{

int Failures = 0;

using Color = std::array<int, 3>;

vtkSmartPointer<vtkImageData> Terrain()
{
  return MakeHeights(120, 90, Hills(1));
}

// Under a sun in the zenith the whole field has the material's colour.
void MakeEven(vtkReliefScene* scene, double r, double g, double b)
{
  scene->RemoveAllLights();
  scene->AddSun(0.0, 90.0);
  scene->GetMaterial()->SetOffsetModeToVertical(); // slopes are as bright as level ground
  scene->GetMaterial()->SetDiffuseColor(r, g, b);
}

Color Pixel(MapperStage& stage, int x, int y)
{
  auto pixels = stage.Pixels();
  const vtkIdType at = static_cast<vtkIdType>(y) * stage.window->GetSize()[0] + x;
  Color color;
  for (int c = 0; c < 3; ++c)
  {
    color[c] = pixels->GetTypedComponent(at, c);
  }
  return color;
}

bool IsNear(const Color& color, int r, int g, int b)
{
  const bool near =
    std::abs(color[0] - r) <= 2 && std::abs(color[1] - g) <= 2 && std::abs(color[2] - b) <= 2;
  if (!near)
  {
    std::cout << "The pixel is " << color[0] << ", " << color[1] << ", " << color[2] << std::endl;
  }
  return near;
}

// A rectangle of one colour, parallel to the field.
vtkSmartPointer<vtkActor> MakeRectangle(
  double x0, double x1, double z, double r, double g, double b, double opacity = 1.0)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(x0, -10.0, z);
  plane->SetPoint1(x1, -10.0, z);
  plane->SetPoint2(x0, 110.0, z);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(plane->GetOutputPort());
  auto actor = vtkSmartPointer<vtkActor>::New();
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetColor(r, g, b);
  actor->GetProperty()->SetOpacity(opacity);
  return actor;
}

vtkSmartPointer<vtkImageSlice> MakeSlice(double r, double g, double b)
{
  auto mapper = vtkSmartPointer<vtkReliefImageMapper>::New();
  mapper->SetInputData(Terrain());
  mapper->BorderOn();
  MakeEven(mapper->GetScene(), r, g, b);
  auto slice = vtkSmartPointer<vtkImageSlice>::New();
  slice->SetMapper(mapper);
  return slice;
}

// Opaque actors hide it and are hidden by it, whichever is added first.
void TestDepth()
{
  MapperStage stage(Terrain());
  MakeEven(stage.Scene(), 1.0, 0.0, 0.0);
  stage.renderer->AddViewProp(MakeRectangle(20.0, 50.0, 5.0, 0.0, 1.0, 0.0));
  stage.renderer->AddViewProp(MakeRectangle(40.0, 90.0, -5.0, 0.0, 0.0, 1.0));
  for (int round = 0; round < 2; ++round)
  {
    CHECK(stage.Render());
    CHECK(IsNear(Pixel(stage, 10, 45), 255, 0, 0));
    CHECK(IsNear(Pixel(stage, 30, 45), 0, 255, 0));
    CHECK(IsNear(Pixel(stage, 45, 45), 0, 255, 0));
    CHECK(IsNear(Pixel(stage, 70, 45), 255, 0, 0));
    stage.renderer->RemoveViewProp(stage.slice);
    stage.renderer->AddViewProp(stage.slice);
  }
}

// Translucent over an opaque actor, and peeled under a translucent one too.
void TestTranslucency()
{
  for (const bool peeling : { false, true })
  {
    MapperStage stage(Terrain());
    MakeEven(stage.Scene(), 1.0, 0.0, 0.0);
    stage.slice->GetProperty()->SetOpacity(0.5);
    stage.slice->ForceTranslucentOn(); // or else it is drawn in its turn, as every vtkImageSlice
    stage.renderer->AddViewProp(MakeRectangle(40.0, 90.0, -5.0, 0.0, 0.0, 1.0));
    if (peeling)
    {
      stage.window->SetAlphaBitPlanes(1);
      stage.renderer->UseDepthPeelingOn();
      stage.renderer->AddViewProp(MakeRectangle(60.0, 120.0, 5.0, 0.0, 1.0, 0.0, 0.5));
    }
    CHECK(stage.Render());
    CHECK(IsNear(Pixel(stage, 10, 45), 128, 0, 0));
    CHECK(IsNear(Pixel(stage, 50, 45), 128, 0, 128));
    if (peeling)
    {
      CHECK(IsNear(Pixel(stage, 70, 45), 64, 128, 64));
      CHECK(IsNear(Pixel(stage, 100, 45), 64, 128, 0));
    }
  }
}

// As ParaView has it: a layer of annotations over the scene, views side by side, one of them empty.
void TestLayers()
{
  MapperStage stage(Terrain());
  MakeEven(stage.Scene(), 1.0, 0.0, 0.0);
  stage.window->SetSize(240, 90);
  stage.window->SetNumberOfLayers(2);
  stage.renderer->SetViewport(0.0, 0.0, 0.5, 1.0);
  vtkNew<vtkRenderer> over;
  over->SetLayer(1);
  over->InteractiveOff();
  over->SetViewport(0.0, 0.0, 0.5, 1.0);
  over->SetActiveCamera(stage.renderer->GetActiveCamera());
  auto farther = MakeSlice(0.0, 1.0, 0.0);
  farther->SetPosition(80.0, 0.0, -50.0);
  over->AddViewProp(farther);
  stage.window->AddRenderer(over);
  vtkNew<vtkRenderer> beside;
  beside->SetViewport(0.5, 0.0, 1.0, 1.0);
  beside->SetBackground(0.0, 0.0, 1.0);
  beside->SetActiveCamera(stage.renderer->GetActiveCamera());
  beside->AddViewProp(stage.slice);
  stage.window->AddRenderer(beside);
  vtkNew<vtkRenderer> empty;
  empty->SetViewport(0.75, 0.5, 0.75, 0.5);
  empty->AddViewProp(stage.slice);
  stage.window->AddRenderer(empty);

  CHECK(stage.Render());
  CHECK(IsNear(Pixel(stage, 40, 45), 255, 0, 0));
  CHECK(IsNear(Pixel(stage, 100, 45), 0, 255, 0));
  CHECK(IsNear(Pixel(stage, 160, 45), 255, 0, 0));

  // Hidden, shown again.
  for (vtkRenderer* renderer : { beside.Get(), over.Get() })
  {
    renderer->DrawOff();
    CHECK(stage.Render());
    renderer->DrawOn();
  }
  CHECK(stage.Render());
  CHECK(IsNear(Pixel(stage, 40, 45), 255, 0, 0));
  CHECK(IsNear(Pixel(stage, 100, 45), 0, 255, 0));
  stage.window->RemoveRenderer(over);
  CHECK(stage.Render());
  CHECK(IsNear(Pixel(stage, 100, 45), 255, 0, 0));
}

// A stack draws its slices in the order of their layers, wherever they lie; an assembly moves its
// parts.
void TestGroups()
{
  MapperStage stage(Terrain());
  stage.renderer->RemoveViewProp(stage.slice);
  MakeEven(stage.Scene(), 1.0, 0.0, 0.0);
  auto upper = MakeSlice(0.0, 1.0, 0.0);
  upper->GetProperty()->SetLayerNumber(1);
  upper->GetProperty()->SetOpacity(0.5);
  upper->SetPosition(60.0, 0.0, -5.0);
  vtkNew<vtkImageStack> stack;
  stack->AddImage(upper);
  stack->AddImage(stage.slice);
  stage.renderer->AddViewProp(stack);
  CHECK(stage.Render());
  CHECK(IsNear(Pixel(stage, 30, 45), 255, 0, 0));
  CHECK(IsNear(Pixel(stage, 90, 45), 128, 128, 0));
  stage.renderer->RemoveViewProp(stack);

  vtkNew<vtkAssembly> assembly;
  assembly->AddPart(stage.slice);
  assembly->SetPosition(50.0, 0.0, 0.0);
  stage.renderer->AddViewProp(assembly);
  CHECK(stage.Render());
  CHECK(IsNear(Pixel(stage, 30, 45), 0, 0, 0));
  CHECK(IsNear(Pixel(stage, 90, 45), 255, 0, 0));
}

// Smoothed windows and passes show the same, but for the field's edges.
void TestSmoothing()
{
  MapperStage stage(Terrain());
  stage.Scene()->AddSun(300.0, 30.0);
  CHECK(stage.Render());
  auto expected = stage.Pixels();
  MapperStage samples(Terrain());
  samples.Scene()->AddSun(300.0, 30.0);
  samples.window->SetMultiSamples(4);
  CHECK(samples.Render());
  CHECK(LargestDifference(expected, samples.Pixels()) <= 1.0);

  // Each pixel from four, which then show the samples' own edges: nearest samples, no mixing.
  MakeEven(stage.Scene(), 1.0, 0.5, 0.0);
  CHECK(stage.Render());
  expected = stage.Pixels();
  vtkNew<vtkRenderStepsPass> steps;
  vtkNew<vtkSSAAPass> smooth;
  smooth->SetDelegatePass(steps);
  stage.renderer->SetPass(smooth);
  CHECK(stage.Render());
  CHECK(Pixel(stage, 60, 45) == (Color{ expected->GetValue(0), expected->GetValue(1), 0 }));
  stage.renderer->ReleaseGraphicsResources(stage.window);
  stage.renderer->SetPass(nullptr);
  stage.renderer->UseFXAAOn();
  CHECK(stage.Render());
  CHECK(LargestDifference(expected, stage.Pixels()) <= 1.0);
}

// The eyes see the field from two places.
void TestStereo()
{
  MapperStage stage(Terrain());
  MakeEven(stage.Scene(), 1.0, 1.0, 1.0);
  stage.window->StereoCapableWindowOff();
  stage.window->SetStereoTypeToSplitViewportHorizontal();
  stage.window->StereoRenderOn();
  CHECK(stage.Render());
  CHECK(IsNear(Pixel(stage, 30, 45), 255, 255, 255) && IsNear(Pixel(stage, 90, 45), 255, 255, 255));
  stage.window->SetStereoTypeToRedBlue();
  CHECK(stage.Render());
  CHECK(IsNear(Pixel(stage, 60, 45), 255, 0, 255));
}

// A picture larger than its window is put together from parts, as a larger window shows it.
void TestPictures()
{
  MapperStage stage(Terrain());
  stage.Scene()->AddSun(300.0, 30.0);
  CHECK(stage.Render());
  vtkNew<vtkWindowToImageFilter> picture;
  picture->SetInput(stage.window);
  picture->SetScale(3);
  picture->ReadFrontBufferOff();
  picture->Update();

  MapperStage large(Terrain());
  large.Scene()->AddSun(300.0, 30.0);
  large.window->SetSize(360, 270);
  CHECK(large.Render());
  CHECK(SameBytes(picture->GetOutput()->GetPointData()->GetScalars(), large.Pixels()));
}

// A mapper may be taken from its slice, outlive its window and be shown by another; or go first.
void TestExchange()
{
  auto stage = std::make_unique<MapperStage>(Terrain());
  MakeEven(stage->Scene(), 1.0, 0.0, 0.0);
  CHECK(stage->Render());
  vtkSmartPointer<vtkOpenGLReliefImageMapper> old = stage->mapper;
  stage->slice->SetMapper(MakeSlice(0.0, 1.0, 0.0)->GetMapper());
  CHECK(stage->Render());
  CHECK(IsNear(Pixel(*stage, 60, 45), 0, 255, 0));
  stage.reset();

  MapperStage other(Terrain());
  other.slice->SetMapper(old);
  CHECK(other.Render());
  CHECK(IsNear(Pixel(other, 60, 45), 255, 0, 0));
  old = nullptr;
  other.mapper = nullptr;
  other.slice->SetMapper(MakeSlice(0.0, 1.0, 0.0)->GetMapper());
  CHECK(other.Render());
  CHECK(IsNear(Pixel(other, 60, 45), 0, 255, 0));
}

// Many slices in one renderer do not run out of texture units.
void TestMany()
{
  MapperStage stage(Terrain());
  MakeEven(stage.Scene(), 1.0, 0.0, 0.0);
  for (int k = 1; k < 40; ++k)
  {
    auto slice = MakeSlice(0.0, 1.0, k / 40.0);
    slice->SetPosition(3.0 * k, 0.0, 0.1 * k);
    stage.renderer->AddViewProp(slice);
  }
  CHECK(stage.Render());
  CHECK(IsNear(Pixel(stage, 1, 45), 255, 0, 0));
  for (int k = 1; k < 40; ++k)
  {
    CHECK(Pixel(stage, 3 * k + 1, 45)[1] == 255);
  }
  CHECK(stage.Render());
}

}

int TestReliefImageMapperLayouts(int, char*[])
{
  TestDepth();
  TestTranslucency();
  TestLayers();
  TestGroups();
  TestSmoothing();
  TestStereo();
  TestPictures();
  TestExchange();
  TestMany();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
