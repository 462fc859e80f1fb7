// SPDX-License-Identifier: BSD-3-Clause
//
// What the mapper does with its settings, its input and its slice, and what it does not do twice.

#include "ReliefMapperTestUtilities.h"

#include "vtkCellPicker.h"
#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkPlane.h"
#include "vtkPropPicker.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"

#include "ReliefOpenGL.h"

#include <algorithm>
#include <limits>

namespace
{

int Failures = 0;

vtkSmartPointer<vtkImageData> Terrain(int columns = 120, int rows = 90)
{
  return MakeHeights(columns, rows, Hills(1));
}

vtkSmartPointer<vtkImageData> Filtered(MapperStage& stage, int type = VTK_FLOAT)
{
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(stage.mapper->GetInput());
  filter->SetScene(stage.Scene());
  filter->SetOutputScalarType(type);
  filter->Update();
  vtkSmartPointer<vtkImageData> output = filter->GetOutput();
  return output;
}

// One channel of a pixel of the screen.
int Pixel(vtkUnsignedCharArray* pixels, MapperStage& stage, int x, int y, int c = 0)
{
  return pixels->GetTypedComponent(static_cast<vtkIdType>(y) * stage.window->GetSize()[0] + x, c);
}

// A factory makes the mapper; settings out of range are refused.
void TestSettings()
{
  auto mapper = vtkSmartPointer<vtkReliefImageMapper>::New();
  auto* open = vtkOpenGLReliefImageMapper::SafeDownCast(mapper);
  CHECK(open != nullptr);
  CHECK(mapper->GetSRGBEncoding() && mapper->GetProgressive() && !mapper->GetCropping());
  CHECK(mapper->GetCacheMemoryLimit() == 262144);
  CHECK(!mapper->GetConverged() && mapper->GetRefinement() == 0.0);
  MessageKeeper messages(mapper);
  mapper->SetScene(nullptr);
  CHECK(messages.OneError("null was given") && mapper->GetScene());
  mapper->SetProgressiveFrameTime(0.0);
  CHECK(
    messages.OneError("SetProgressiveFrameTime: 0") && mapper->GetProgressiveFrameTime() == 0.2);
  CHECK(mapper->GetTracing() == vtkReliefImageMapper::TraceAutomatically);
  mapper->SetTracing(3);
  CHECK(messages.OneError("SetTracing: 3") &&
    mapper->GetTracing() == vtkReliefImageMapper::TraceAutomatically);
  open->SetTextureSizeLimit(10);
  CHECK(messages.OneError("SetTextureSizeLimit: 10") && open->GetTextureSizeLimit() == 0);

  const vtkMTimeType before = mapper->GetMTime();
  mapper->GetScene()->GetMaterial()->SetDensity(0.5);
  CHECK(mapper->GetMTime() > before);
  const double* bounds = mapper->GetBounds();
  CHECK(bounds[0] > bounds[1]); // without input there are none
  std::ostringstream text;
  mapper->Print(text);
  CHECK(text.str().find("ProgressiveFrameTime: 0.2") != std::string::npos);
}

// Only what has changed is done again, and colours compile nothing.
void TestWork(int device)
{
  MapperStage stage(Terrain());
  stage.mapper->SetTracing(device);
  // The program that traces.
  const int tracer = device == vtkReliefImageMapper::TraceOnGraphicsProcessor ? 1 : 0;
  vtkReliefMaterial* material = stage.Scene()->GetMaterial();
  vtkReliefStatistics* statistics = stage.mapper->GetStatistics();
  vtkLight* sun = stage.Scene()->AddSun(300.0, 30.0);
  vtkLight* other = stage.Scene()->AddSun(120.0, 40.0);
  other->SetIntensity(0.3);
  CHECK(stage.Render() && stage.mapper->GetConverged());
  CHECK(statistics->GetLightsTraced() == 2 && statistics->GetLightsReused() == 0);
  CHECK(statistics->GetRaysTraced() == 2 * 120 * 90);
  CHECK(statistics->GetEffectNames() == "Illumination");
  CHECK(stage.mapper->GetNumberOfPrograms() == 2 + tracer);

  // Nothing has changed.
  CHECK(stage.Render());
  CHECK(statistics->GetLightsTraced() == 0 && statistics->GetLightsReused() == 2);

  // Colours, intensities and coefficients trace nothing.
  material->SetDiffuseColor(0.2, 0.5, 0.9);
  material->SetBaseColor(0.1, 0.0, 0.0);
  sun->SetDiffuseColor(1.0, 0.9, 0.5);
  sun->SetIntensity(0.7);
  CHECK(stage.Render());
  CHECK(statistics->GetRaysTraced() == 0 && stage.mapper->GetNumberOfPrograms() == 2 + tracer);
  CHECK(CompareColors(Filtered(stage), stage.Shading(), 6e-3).shareBeyond <= 1e-3);

  // Highlights and scattering need other sums, but no ray.
  material->SetSpecularCoefficient(0.4);
  material->SetForwardScatterCoefficient(0.5);
  CHECK(stage.Render());
  CHECK(statistics->GetRaysTraced() == 0 && stage.mapper->GetNumberOfPrograms() == 4 + tracer);
  CHECK(statistics->GetEffectsEvaluated() ==
    (vtkReliefStatistics::Illumination | vtkReliefStatistics::Normals |
      vtkReliefStatistics::Specular | vtkReliefStatistics::ForwardScatter));
  material->SetSpecularPower(7.0);
  CHECK(stage.Render());
  CHECK(statistics->GetRaysTraced() == 0 && stage.mapper->GetNumberOfPrograms() == 4 + tracer);
  CHECK(CompareColors(Filtered(stage), stage.Shading(), 6e-3).shareBeyond <= 1e-3);

  // A light that moves is traced, the other is not.
  sun->SetPosition(1.0, 1.0, 0.4);
  CHECK(stage.Render());
  CHECK(statistics->GetLightsTraced() == 1 && statistics->GetLightsReused() == 1);
  CHECK(stage.mapper->GetNumberOfPrograms() == 4 + tracer);

  // What is known already needs no program.
  material->SetSpecularCoefficient(0.0);
  material->SetForwardScatterCoefficient(0.0);
  CHECK(stage.Render());
  CHECK(statistics->GetRaysTraced() == 0 && stage.mapper->GetNumberOfPrograms() == 4 + tracer);

  // With highlights only, no ray is of use.
  material->SetSpecularCoefficient(1.0);
  material->SetSubsurfaceDepth(4.0);
  CHECK(stage.Render());
  CHECK(statistics->GetRaysTraced() == 0);
  CHECK(statistics->GetEffectsEvaluated() ==
    (vtkReliefStatistics::Normals | vtkReliefStatistics::Specular));

  // The depth concerns every light, and so do the heights.
  material->SetSpecularCoefficient(0.0);
  CHECK(stage.Render());
  CHECK(statistics->GetLightsTraced() == 2);
  stage.Scene()->SetHeightScale(0.5);
  CHECK(stage.Render());
  CHECK(statistics->GetLightsTraced() == 2);
  CHECK(CompareColors(Filtered(stage), stage.Shading(), 6e-3).shareBeyond <= 1e-3);

  // Lights for which there is no room are traced when one of them moves, and only then.
  stage.mapper->SetCacheMemoryLimit(4 * 120 * 90 / 1024 + 1); // for one
  CHECK(stage.Render());
  CHECK(statistics->GetLightsTraced() == 1 && statistics->GetLightsReused() == 1);
  material->SetDiffuseColor(1.0, 1.0, 1.0);
  CHECK(stage.Render());
  CHECK(statistics->GetLightsTraced() == 0);
  CHECK(CompareColors(Filtered(stage), stage.Shading(), 6e-3).shareBeyond <= 1e-3);
  stage.mapper->SetCacheMemoryLimit(0);
  CHECK(stage.Render());
  CHECK(statistics->GetLightsTraced() == 2 && statistics->GetLightsReused() == 0);
  // All of one colour and as bright as before, or twice as bright.
  sun->SetIntensity(2.0 * sun->GetIntensity());
  other->SetIntensity(2.0 * other->GetIntensity());
  CHECK(stage.Render());
  CHECK(statistics->GetLightsTraced() == 0);
  CHECK(CompareColors(Filtered(stage), stage.Shading(), 1.2e-2).shareBeyond <= 1e-3);

  // An environment that turns about its axis has new colours, from the same directions.
  stage.mapper->SetCacheMemoryLimit(262144);
  stage.Scene()->SetLightsToSunAndSky(200.0, 40.0);
  stage.Scene()->GetEnvironment()->SetSamplingToSolidAngle();
  CHECK(stage.Render());
  const vtkTypeInt64 lights = statistics->GetLightsTraced();
  CHECK(lights > 20);
  stage.Scene()->GetEnvironment()->SetRotationZ(30.0);
  stage.Scene()->GetEnvironment()->SetIntensity(0.5);
  CHECK(stage.Render());
  CHECK(statistics->GetLightsTraced() == 0 && statistics->GetLightsReused() == lights);
  CHECK(CompareColors(Filtered(stage), stage.Shading(), 6e-3).shareBeyond <= 1e-3);
}

// One device takes over from the other, with the same picture; of itself the mapper takes one.
void TestDevices()
{
  MapperStage stage(Terrain(300, 200));
  stage.Scene()->AddSun(300.0, 20.0);
  vtkReliefStatistics* statistics = stage.mapper->GetStatistics();
  stage.mapper->SetTracingToProcessor();
  CHECK(stage.Render() && stage.mapper->GetConverged());
  const vtkTypeInt64 cells = statistics->GetCellsVisited();
  auto processor = stage.Shading();
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(stage.mapper->GetInput());
  filter->SetScene(stage.Scene());
  filter->Update();
  CHECK(cells > 0 && cells == filter->GetStatistics()->GetCellsVisited());
  CHECK(CompareColors(filter->GetOutput(), processor, 1.0e-5).shareBeyond == 0.0);

  stage.mapper->SetTracingToGraphicsProcessor();
  CHECK(stage.Render() && stage.mapper->GetConverged());
  CHECK(statistics->GetLightsTraced() == 1 && statistics->GetCellsVisited() == 0);
  CHECK(CompareColors(processor, stage.Shading(), 2.0e-3).shareBeyond <= 1.0e-3);

  stage.mapper->SetTracingToProcessor();
  CHECK(stage.Render());
  CHECK(statistics->GetLightsTraced() == 1 && statistics->GetCellsVisited() == cells);
  CHECK(SameBytes(
    processor->GetPointData()->GetScalars(), stage.Shading()->GetPointData()->GetScalars()));
  // Nothing twice.
  CHECK(stage.Render() && statistics->GetCellsVisited() == 0);

  // By itself it takes the processor where that is what draws.
  stage.mapper->SetTracingToAutomatic();
  const std::string renderer = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  stage.Scene()->AddSun(100.0, 20.0);
  CHECK(stage.Render());
  const bool onProcessor = statistics->GetCellsVisited() > 0;
  CHECK(onProcessor || renderer.find("llvmpipe") == std::string::npos);
}

// The screen shows the filter's 8-bit output; without encoding, the linear colours at the exposure.
void CheckScreen(MapperStage& stage, bool encoded)
{
  stage.mapper->SetSRGBEncoding(encoded);
  CHECK(stage.Render());
  auto pixels = stage.Pixels();
  auto expected = Filtered(stage, encoded ? VTK_UNSIGNED_CHAR : VTK_FLOAT);
  const double exposure = std::exp2(stage.mapper->GetStatistics()->GetExposure());
  double largest = 0.0;
  for (vtkIdType at = 0; at < expected->GetNumberOfPoints(); ++at)
  {
    for (int c = 0; c < 3; ++c)
    {
      const double value = expected->GetPointData()->GetScalars()->GetComponent(at, c);
      const double code = encoded ? value : 255.0 * std::min(exposure * value, 1.0);
      largest = std::max(largest, std::abs(code - pixels->GetTypedComponent(at, c)));
    }
  }
  // Each is off by its tolerance, of less than a code, and rounded.
  CHECK_NEAR(largest, 0.0, 2.0);
}

void TestScreen()
{
  MapperStage stage(Terrain());
  vtkReliefScene* scene = stage.Scene();
  scene->AddSun(300.0, 30.0);
  scene->GetMaterial()->SetDiffuseColor(0.9, 0.6, 0.3);
  vtkReliefStatistics* statistics = stage.mapper->GetStatistics();
  for (const bool encoded : { true, false })
  {
    scene->SetExposure(0.0);
    CheckScreen(stage, encoded);
    scene->SetExposure(-1.25);
    CheckScreen(stage, encoded);
    CHECK(statistics->GetLightsTraced() == 0 && statistics->GetExposure() == -1.25);
    scene->AutomaticExposureOn();
    CheckScreen(stage, encoded);
    CHECK(statistics->GetLightsTraced() == 0);
    CHECK(statistics->GetExposure() > 0.0 && statistics->GetExposure() < 1.0);
  }
  // Of the whole field, not of what is seen of it.
  const double whole = statistics->GetExposure();
  stage.mapper->CroppingOn();
  stage.mapper->SetCroppingRegion(0, 20, 0, 20, 0, 0);
  CHECK(stage.Render() && statistics->GetExposure() == whole);
}

// What has no data lets the background through, and opacity everything.
void TestTransparency()
{
  MapperStage stage(MakeHeights(120, 90,
    [](int i, int j)
    { return i < 60 ? std::numeric_limits<double>::quiet_NaN() : Hills(1)(i, j); }));
  stage.Scene()->AddSun(0.0, 90.0); // all white
  stage.Scene()->GetMaterial()->SetOffsetModeToVertical();
  stage.renderer->SetBackground(0.0, 0.0, 1.0);
  CHECK(stage.Render());
  auto pixels = stage.Pixels();
  CHECK(Pixel(pixels, stage, 20, 45, 0) == 0 && Pixel(pixels, stage, 20, 45, 2) == 255);
  CHECK(Pixel(pixels, stage, 80, 45, 0) == 255);

  stage.slice->GetProperty()->SetOpacity(0.5);
  CHECK(stage.Render());
  pixels = stage.Pixels();
  CHECK_NEAR(Pixel(pixels, stage, 80, 45, 0), 127.5, 1.0);
  CHECK(Pixel(pixels, stage, 20, 45, 0) == 0 && Pixel(pixels, stage, 20, 45, 2) == 255);

  // Interpolated, the colour does not darken toward missing samples.
  stage.slice->GetProperty()->SetOpacity(1.0);
  stage.slice->GetProperty()->SetInterpolationTypeToLinear();
  stage.renderer->SetBackground(1.0, 1.0, 1.0);
  stage.renderer->GetActiveCamera()->SetParallelScale(10.0);
  CHECK(stage.Render());
  pixels = stage.Pixels();
  int darkest = 255;
  for (vtkIdType at = 0; at < pixels->GetNumberOfTuples(); ++at)
  {
    darkest = std::min<int>(darkest, pixels->GetTypedComponent(at, 0));
  }
  CHECK(darkest >= 254);

  stage.slice->GetProperty()->BackingOn();
  stage.slice->GetProperty()->SetBackingColor(1.0, 0.0, 0.0);
  stage.LookAtAll();
  CHECK(stage.Render());
  pixels = stage.Pixels();
  CHECK(Pixel(pixels, stage, 20, 45, 0) == 255 && Pixel(pixels, stage, 20, 45, 1) == 0);
}

// Cropping and clipping planes show less and change nothing of it.
void TestCropping()
{
  MapperStage stage(Terrain());
  stage.Scene()->AddSun(300.0, 15.0);
  CHECK(stage.Render());
  auto whole = stage.Pixels();
  stage.mapper->CroppingOn();
  stage.mapper->SetCroppingRegion(40, 79, 30, 200, 0, 0);
  const double* bounds = stage.slice->GetBounds();
  CHECK(bounds[0] == 39.5 && bounds[1] == 79.5 && bounds[2] == 29.5 && bounds[3] == 89.5);
  CHECK(stage.Render());
  auto cropped = stage.Pixels();
  bool same = true;
  for (int y = 0; y < 90; ++y)
  {
    for (int x = 0; x < 120; ++x)
    {
      const bool inside = x >= 40 && x < 80 && y >= 30;
      same = same && Pixel(cropped, stage, x, y) == (inside ? Pixel(whole, stage, x, y) : 0);
    }
  }
  CHECK(same);
  CHECK(stage.mapper->GetStatistics()->GetRaysTraced() <= 42 * 62);

  stage.mapper->CroppingOff();
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(60.0, 0.0, 0.0);
  plane->SetNormal(1.0, 0.0, 0.0);
  stage.mapper->AddClippingPlane(plane);
  CHECK(stage.Render());
  auto clipped = stage.Pixels();
  CHECK(Pixel(clipped, stage, 30, 40) == 0);
  CHECK(Pixel(clipped, stage, 90, 40) == Pixel(whole, stage, 90, 40));

  // A region outside the image shows nothing, without complaint.
  stage.mapper->RemoveAllClippingPlanes();
  stage.mapper->CroppingOn();
  stage.mapper->SetCroppingRegion(500, 600, 0, 10, 0, 0);
  CHECK(stage.Render());
  CHECK(Pixel(stage.Pixels(), stage, 60, 45) == 0);
}

// A sample that covers several pixels is shown as the property's interpolation type has it.
void TestMagnification()
{
  MapperStage stage(Terrain());
  stage.Scene()->AddSun(300.0, 30.0);
  stage.mapper->SetSRGBEncoding(false);
  // 10 pixels a sample, the middle of the window between the samples 59 and 60 of a row where the
  // shading changes.
  vtkCamera* camera = stage.renderer->GetActiveCamera();
  camera->SetParallelScale(4.5);
  auto expected = Filtered(stage);
  int row = 10;
  auto step = [&]()
  { return std::abs(Value(expected, nullptr, 59, row) - Value(expected, nullptr, 60, row)); };
  while (step() < 0.2f && row < 80)
  {
    ++row;
  }
  // The middle of pixel 45 in its middle.
  camera->SetFocalPoint(59.5, row - 0.05, 0.0);
  camera->SetPosition(59.5, row - 0.05, 100.0);
  const double left = 255.0 * Value(expected, nullptr, 59, row);
  const double right = 255.0 * Value(expected, nullptr, 60, row);
  CHECK(std::abs(left - right) > 20.0);

  CHECK(stage.Render());
  CHECK(stage.mapper->GetStatistics()->GetRaysTraced() <= 16 * 13);
  auto pixels = stage.Pixels();
  CHECK_NEAR(Pixel(pixels, stage, 58, 45), left, 2.0);
  CHECK_NEAR(Pixel(pixels, stage, 61, 45), right, 2.0);
  stage.slice->GetProperty()->SetInterpolationTypeToLinear();
  CHECK(stage.Render());
  CHECK(stage.mapper->GetStatistics()->GetRaysTraced() == 0);
  pixels = stage.Pixels();
  CHECK_NEAR(Pixel(pixels, stage, 57, 45), left + 0.25 * (right - left), 3.0);
  CHECK_NEAR(Pixel(pixels, stage, 62, 45), left + 0.75 * (right - left), 3.0);
}

// A picture costs what can be seen of it.
void TestMinification()
{
  MapperStage stage(Terrain(1200, 900));
  stage.window->SetSize(120, 90);
  CHECK(stage.Render());
  auto shading = stage.Shading();
  const double stride = shading->GetSpacing()[0];
  CHECK(stride > 10.0 / 1.2 && stride <= 10.0);
  CHECK(stage.mapper->GetStatistics()->GetRaysTraced() <= 2 * 120 * 90);
  // Each texel shows one of the field's samples.
  auto expected = Filtered(stage);
  double largest = 0.0;
  for (int y = 1; y < shading->GetDimensions()[1] - 1; ++y)
  {
    for (int x = 1; x < shading->GetDimensions()[0] - 1; ++x)
    {
      const int i = static_cast<int>((x + 0.5) * stride);
      const int j = static_cast<int>((y + 0.5) * stride);
      largest = std::max<double>(
        largest, std::abs(Value(shading, nullptr, x, y) - Value(expected, nullptr, i, j)));
    }
  }
  CHECK_NEAR(largest, 0.0, 4.5e-3);

  // One part of it, at full detail.
  stage.renderer->GetActiveCamera()->SetParallelScale(45.0);
  CHECK(stage.Render());
  CHECK(stage.mapper->GetStatistics()->GetRaysTraced() <= 124 * 94);

  // A slanted view down to the horizon.
  vtkCamera* camera = stage.renderer->GetActiveCamera();
  camera->ParallelProjectionOff();
  camera->SetPosition(600.0, -20.0, 30.0);
  camera->SetFocalPoint(600.0, 400.0, 0.0);
  camera->SetViewUp(0.0, 0.0, 1.0);
  camera->SetClippingRange(1.0, 5000.0);
  CHECK(stage.Render() && stage.mapper->GetConverged());
  CHECK(stage.mapper->GetStatistics()->GetRaysTraced() <= 3 * 120 * 90);
  CHECK(Pixel(stage.Pixels(), stage, 60, 30) > 0);

  // Nothing in view.
  camera->SetFocalPoint(600.0, -400.0, 500.0);
  CHECK(stage.Render() && stage.mapper->GetConverged());
  CHECK(stage.mapper->GetStatistics()->GetRaysTraced() == 0);
  CHECK(stage.mapper->GetStatistics()->GetEffectsEvaluated() == 0);
}

// The slice's matrix moves picture and lights; the renderer's lights stay where they are.
void TestMatrix()
{
  MapperStage stage(Terrain(90, 90));
  stage.Scene()->AddSun(300.0, 30.0);
  stage.slice->SetOrigin(44.5, 44.5, 0.0);
  CHECK(stage.Render());
  auto before = stage.Pixels();
  stage.slice->RotateZ(90.0);
  CHECK(stage.Render());
  auto after = stage.Pixels();
  int largest = 0;
  for (int y = 0; y < 90; ++y)
  {
    for (int x = 0; x < 90; ++x)
    {
      // What was at (x, y) has turned counter-clockwise.
      largest =
        std::max(largest, std::abs(Pixel(before, stage, x, y) - Pixel(after, stage, 89 - y, x)));
    }
  }
  CHECK(largest <= 1);

  // A sun of the renderer, on the slice that has turned, is as one of the scene on heights that
  // have.
  stage.Scene()->RemoveAllLights();
  vtkNew<vtkLight> sun;
  sun->SetLightTypeToSceneLight();
  sun->SetPosition(-1.0, 1.0, 0.6);
  stage.renderer->AddLight(sun);
  CHECK(stage.Render());
  auto turned = stage.Pixels();
  MapperStage other(MakeHeights(90, 90, [](int i, int j) { return Hills(1)(j, 89 - i); }));
  other.Scene()->AddLight(sun);
  CHECK(other.Render());
  auto expected = other.Pixels();
  CHECK(LargestDifference(expected, turned) <= 4.0);
  CHECK(LargestDifference(expected, after) > 20.0);

  // A headlight is left out: the default sun shines.
  stage.renderer->RemoveAllLights();
  stage.slice->SetOrientation(0.0, 0.0, 0.0);
  CHECK(stage.Render());
  CHECK(stage.renderer->GetLights()->GetNumberOfItems() == 1); // VTK has made one
  CHECK(CompareColors(Filtered(stage), stage.Shading(), 6e-3).shareBeyond <= 1e-3);
}

void TestPicking()
{
  MapperStage stage(MakeHeights(120, 90,
    [](int i, int j)
    { return i < 60 ? std::numeric_limits<double>::quiet_NaN() : Hills(1)(i, j); }));
  CHECK(stage.Render());
  vtkNew<vtkCellPicker> cells;
  CHECK(cells->Pick(80.0, 40.0, 0.0, stage.renderer) == 1);
  CHECK(cells->GetViewProp() == stage.slice.Get());
  // The pixel's corner, half a sample from its middle.
  CHECK_NEAR(cells->GetPickPosition()[0], 79.5, 0.01);
  CHECK_NEAR(cells->GetPickPosition()[1], 39.5, 0.01);
  CHECK(cells->GetPointIJK()[0] == 80 && cells->GetPointIJK()[1] == 40);

  vtkNew<vtkPropPicker> props;
  CHECK(props->PickProp(80.0, 40.0, stage.renderer) == 1);
  CHECK(props->GetViewProp() == stage.slice.Get());
  // What is not seen is not picked.
  CHECK(props->PickProp(20.0, 40.0, stage.renderer) == 0);
  CHECK(stage.mapper->GetStatistics()->GetRaysTraced() == 120 * 90); // of the picture, before
}

// Bad input is reported once, shows nothing and hinders nothing later.
void TestBadInput()
{
  auto heights = Terrain();
  MapperStage stage(heights);
  MessageKeeper messages(stage.mapper);
  vtkNew<vtkImageData> colors;
  colors->SetDimensions(120, 90, 1);
  colors->AllocateScalars(VTK_FLOAT, 3);
  stage.mapper->SetInputData(colors);
  CHECK(stage.Render());
  CHECK(messages.OneError("the height image has 3 components, 1 is expected"));
  CHECK(Pixel(stage.Pixels(), stage, 60, 45) == 0);
  CHECK(stage.Render());
  CHECK(messages.Silent());

  stage.mapper->SetInputData(heights);
  stage.mapper->SetMaskData(Terrain(10, 10));
  CHECK(stage.Render());
  CHECK(messages.OneError("the mask's extent is (0, 9, 0, 9)"));
  stage.mapper->SetMaskConnection(nullptr);

  vtkNew<vtkLight> lamp;
  lamp->PositionalOn();
  lamp->SetPosition(std::numeric_limits<double>::infinity(), 0.0, 0.0);
  stage.Scene()->AddLight(lamp);
  CHECK(stage.Render());
  CHECK(messages.OneError("light 0: its position must be finite"));
  stage.Scene()->RemoveAllLights();

  CHECK(stage.Render() && stage.mapper->GetConverged());
  CHECK(messages.Silent());
  CHECK(Pixel(stage.Pixels(), stage, 60, 45) > 0);

  // A texture that lies elsewhere is warned of once.
  auto elsewhere = Terrain(10, 10);
  elsewhere->SetOrigin(1.0e4, 0.0, 0.0);
  stage.mapper->SetDiffuseTextureData(elsewhere);
  CHECK(stage.Render());
  CHECK(messages.OneWarning("diffuse texture"));
  stage.Scene()->GetMaterial()->SetDiffuseColor(0.5, 0.5, 0.5);
  CHECK(stage.Render() && messages.Silent());
  stage.mapper->SetDiffuseTextureData(nullptr);

  // Without any data there is nothing to see, and nothing wrong.
  stage.mapper->SetInputData(
    MakeHeights(120, 90, [](int, int) { return std::numeric_limits<double>::quiet_NaN(); }));
  CHECK(stage.Render() && messages.Silent());
  CHECK(Pixel(stage.Pixels(), stage, 60, 45) == 0);
}

}

int TestReliefImageMapper(int, char*[])
{
  TestSettings();
  for (const int device : TracingDevices)
  {
    TestWork(device);
  }
  TestDevices();
  TestScreen();
  TestTransparency();
  TestCropping();
  TestMagnification();
  TestMinification();
  TestMatrix();
  TestPicking();
  TestBadInput();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
