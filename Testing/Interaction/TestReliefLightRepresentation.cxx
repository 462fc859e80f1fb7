// SPDX-License-Identifier: BSD-3-Clause
//
// The dot of a light: where it is, what moving it does to the light, under any camera.

#include "ReliefWidgetTestUtilities.h"

#include "vtkLight.h"
#include "vtkLightCollection.h"
#include "vtkMath.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkReliefMaterial.h"
#include "vtkTransform.h"

#include <cstdlib>
#include <limits>
#include <random>
#include <sstream>

namespace
{
int Failures = 0;

// 121 by 81 samples about (60, 40): the compass has radius 40.
vtkSmartPointer<vtkImageData> Terrain()
{
  return MakeHeights(121, 81, Hills(3));
}

std::array<double, 3> Toward(vtkLight* sun)
{
  double position[3];
  double focal[3];
  sun->GetTransformedPosition(position);
  sun->GetTransformedFocalPoint(focal);
  vtkMath::Subtract(position, focal, position);
  vtkMath::Normalize(position);
  return { position[0], position[1], position[2] };
}

double Altitude(vtkLight* sun)
{
  return vtkMath::DegreesFromRadians(std::asin(Toward(sun)[2]));
}

double Azimuth(vtkLight* sun)
{
  const auto toward = Toward(sun);
  return vtkMath::DegreesFromRadians(std::atan2(toward[0], toward[1]));
}

void TestCompass()
{
  vtkSmartPointer<vtkImageData> terrain = Terrain();
  WidgetStage stage(terrain);
  vtkReliefLightRepresentation* dot = stage.Dot();
  double at[3];
  CHECK(!dot->GetDotPosition(at)); // no light yet
  stage.Widget->On();
  struct
  {
    double azimuth, altitude, x, y;
  } suns[] = { { 0, 90, 60, 40 }, { 0, 0, 60, 80 }, { 90, 0, 100, 40 }, { 180, 45, 60, 20 },
    { 270, 67.5, 50, 40 }, { 315, 0, 60 - 40 * std::sqrt(0.5), 40 + 40 * std::sqrt(0.5) },
    { 90, -90, 140, 40 }, { 0, -45, 60, 100 } };
  for (const auto& expected : suns)
  {
    stage.Scene()->RemoveAllLights();
    vtkLight* sun = stage.Scene()->AddSun(expected.azimuth, expected.altitude);
    CHECK(dot->GetLight() == sun && dot->GetDotPosition(at));
    CHECK_NEAR(at[2], 0.0, 1e-12);
    // A sun in the nadir has no azimuth: any place on the outer circle is right.
    if (expected.altitude > -90.0)
    {
      CHECK_NEAR(at[0], expected.x, 1e-9);
      CHECK_NEAR(at[1], expected.y, 1e-9);
    }
    else
    {
      CHECK_NEAR(std::hypot(at[0] - 60.0, at[1] - 40.0), 80.0, 1e-9);
    }
  }

  // PlaceFactor scales the compass.
  dot->SetPlaceFactor(0.5);
  CHECK(dot->GetDotPosition(at));
  CHECK_NEAR(at[1], 70.0, 1e-9);
  dot->SetPlaceFactor(1.0);

  // A dot is moved: two pixels for each unit, and the middle of the window is that of the relief.
  stage.Scene()->RemoveAllLights();
  vtkLight* sun = stage.Scene()->AddSun(20.0, 30.0);
  auto move = [&](double x, double y) { return dot->MoveDot(121.0 + 2.0 * x, 81.0 + 2.0 * y); };
  CHECK(move(0.0, -20.0));
  CHECK_NEAR(Altitude(sun), 45.0, 1e-6);
  CHECK_NEAR(std::abs(Azimuth(sun)), 180.0, 1e-6);
  CHECK(move(30.0, 0.0));
  CHECK_NEAR(Altitude(sun), 22.5, 1e-6);
  CHECK_NEAR(Azimuth(sun), 90.0, 1e-6);
  // It stops at the horizon, and with a floor at the nadir.
  CHECK(move(-50.0, -50.0));
  CHECK_NEAR(Altitude(sun), 0.0, 1e-9);
  CHECK_NEAR(Azimuth(sun), -135.0, 1e-6);
  stage.Scene()->GetMaterial()->UseFloorOn();
  CHECK(move(60.0, 0.0));
  CHECK_NEAR(Altitude(sun), -45.0, 1e-6);
  CHECK(move(0.0, 500.0));
  CHECK_NEAR(Altitude(sun), -90.0, 1e-6);
  stage.Scene()->GetMaterial()->UseFloorOff();
}

void TestRaising()
{
  vtkSmartPointer<vtkImageData> terrain = Terrain();
  WidgetStage stage(terrain);
  vtkReliefLightRepresentation* dot = stage.Dot();
  CHECK(!dot->RaiseLight(1.0));
  vtkLight* sun = stage.Scene()->AddSun(135.0, 30.0);
  CHECK(dot->RaiseLight(2.5));
  CHECK_NEAR(Altitude(sun), 32.5, 1e-9);
  CHECK_NEAR(Azimuth(sun), 135.0, 1e-9);
  // Through the zenith and back the azimuth is the old one.
  CHECK(dot->RaiseLight(1000.0));
  CHECK(Toward(sun)[2] == 1.0);
  CHECK(dot->RaiseLight(-10.0));
  CHECK_NEAR(Altitude(sun), 80.0, 1e-9);
  CHECK_NEAR(Azimuth(sun), 135.0, 1e-9);
  CHECK(dot->RaiseLight(-1000.0) && Altitude(sun) == 0.0);
  stage.Scene()->GetMaterial()->UseFloorOn();
  CHECK(dot->RaiseLight(-30.0));
  CHECK_NEAR(Altitude(sun), -30.0, 1e-9);
  // Where the floor is gone, a sun below the horizon sinks no further but may rise.
  stage.Scene()->GetMaterial()->UseFloorOff();
  CHECK(dot->RaiseLight(-1.0));
  CHECK_NEAR(Altitude(sun), -30.0, 1e-9);
  CHECK(dot->RaiseLight(1.0));
  CHECK_NEAR(Altitude(sun), -29.0, 1e-9);
  CHECK(!dot->RaiseLight(NAN) && std::abs(Altitude(sun) + 29.0) < 1e-9);

  // A lamp moves by tenths where it is high, less near the mean height, and to the other side.
  stage.Scene()->RemoveAllLights();
  stage.Scene()->SetHeightScale(2.0);
  vtkNew<vtkLight> lamp;
  lamp->PositionalOn();
  const double mean = 2.0 * dot->GetMeanHeight();
  CHECK(mean > 40.0 && mean < 80.0);
  lamp->SetPosition(10.0, 20.0, mean + 300.0);
  stage.Scene()->AddLight(lamp);
  CHECK(dot->RaiseLight(1.0));
  CHECK_NEAR(lamp->GetPosition()[2] - mean, 300.0 * std::exp(0.1), 0.1);
  CHECK(dot->RaiseLight(-1.0));
  CHECK_NEAR(lamp->GetPosition()[2] - mean, 300.0, 1e-9);
  lamp->SetPosition(10.0, 20.0, mean + 1.0);
  CHECK(dot->RaiseLight(-5.0));
  CHECK(lamp->GetPosition()[2] < mean && lamp->GetPosition()[2] > mean - 3.0);
  CHECK(dot->RaiseLight(1e6));
  CHECK(lamp->GetPosition()[2] - mean <= 1200.0 + 1e-6 && lamp->GetPosition()[2] > mean + 1000.0);
  CHECK_NEAR(lamp->GetPosition()[0], 10.0, 1e-9);
  // One that is far away already is not pulled back.
  lamp->SetPosition(10.0, 20.0, 1e6);
  CHECK(dot->RaiseLight(1.0));
  CHECK_NEAR(lamp->GetPosition()[2], 1e6, 1e-3);
}

double Change(vtkImageReliefShading* shading, vtkFloatArray* before)
{
  shading->Update();
  vtkDataArray* now = shading->GetOutput()->GetPointData()->GetScalars();
  double sum = 0.0;
  for (vtkIdType i = 0; i < now->GetNumberOfTuples(); ++i)
  {
    sum += std::pow(now->GetComponent(i, 0) - before->GetComponent(i, 0), 2);
  }
  return std::sqrt(sum / now->GetNumberOfTuples());
}

void TestSwitching()
{
  for (const auto& sunAngles :
    { std::array<double, 2>{ 315.0, 45.0 }, { 20.0, 15.0 }, { 100.0, 70.0 }, { 0.0, 90.0 } })
  {
    vtkSmartPointer<vtkImageData> terrain = Terrain();
    WidgetStage stage(terrain);
    stage.Shading->SetOutputScalarTypeToFloat();
    vtkReliefLightRepresentation* dot = stage.Dot();
    vtkLight* light = stage.Scene()->AddSun(sunAngles[0], sunAngles[1], 0.5);
    light->SetIntensity(0.7);
    const auto toward = Toward(light);
    stage.Shading->Update();
    vtkNew<vtkFloatArray> picture;
    picture->DeepCopy(stage.Shading->GetOutput()->GetPointData()->GetScalars());

    CHECK(dot->SwitchLightType() && light->GetPositional());
    const double middle[3] = { 60.0, 40.0, dot->GetMeanHeight() };
    double away[3];
    vtkMath::Subtract(light->GetPosition(), middle, away);
    const double distance = vtkMath::Normalize(away);
    for (int axis = 0; axis < 3; ++axis)
    {
      CHECK_NEAR(away[axis], toward[axis], 1e-12);
    }
    double at[3];
    CHECK(dot->GetDotPosition(at));
    CHECK(at[0] > 0.0 && at[0] < 120.0 && at[1] > 0.0 && at[1] < 80.0);
    CHECK(light->GetIntensity() == 0.7);

    // Nearer, the picture would have changed more.
    const double change = Change(stage.Shading, picture);
    light->SetPosition(middle[0] + 0.5 * distance * away[0], middle[1] + 0.5 * distance * away[1],
      middle[2] + 0.5 * distance * away[2]);
    const double nearer = Change(stage.Shading, picture);
    std::cout << "altitude " << sunAngles[1] << ": the picture changes by " << change << ", by "
              << nearer << " with the lamp half as far" << std::endl;
    CHECK(change < nearer);

    // Back it is the sun that it was, disc and all.
    light->SetPosition(middle[0] + distance * away[0], middle[1] + distance * away[1],
      middle[2] + distance * away[2]);
    CHECK(dot->SwitchLightType() && !light->GetPositional());
    for (int axis = 0; axis < 3; ++axis)
    {
      CHECK_NEAR(Toward(light)[axis], toward[axis], 1e-12);
    }
    CHECK(vtkReliefScene::GetAngularDiameter(light) == 0.5);
    CHECK_NEAR(Change(stage.Shading, picture), 0.0, 1e-3);
  }

  // A lamp comes back to its old distance, in the direction that its sun has been moved to.
  vtkSmartPointer<vtkImageData> terrain = Terrain();
  WidgetStage stage(terrain);
  vtkNew<vtkLight> lamp;
  lamp->PositionalOn();
  const double mean = stage.Dot()->GetMeanHeight();
  lamp->SetPosition(60.0 + 8.0, 40.0, mean + 6.0);
  stage.Scene()->AddLight(lamp);
  CHECK(stage.Dot()->SwitchLightType() && stage.Dot()->SwitchLightType());
  CHECK_NEAR(lamp->GetPosition()[0], 68.0, 1e-9);
  CHECK_NEAR(lamp->GetPosition()[2], mean + 6.0, 1e-9);
  CHECK(stage.Dot()->SwitchLightType() && stage.Dot()->RaiseLight(100.0));
  CHECK(stage.Dot()->SwitchLightType());
  CHECK_NEAR(lamp->GetPosition()[0], 60.0, 1e-9);
  CHECK_NEAR(lamp->GetPosition()[2], mean + 10.0, 1e-9);
  // In the very middle it has no direction, and becomes a sun in the zenith.
  lamp->SetPosition(60.0, 40.0, mean);
  CHECK(stage.Dot()->SwitchLightType());
  CHECK_NEAR(Toward(lamp)[2], 1.0, 1e-12);
}

// Under random cameras, planes and prop matrices: the dot of a light is where moving it there
// leaves the light as it is, and a moved dot is seen where it was moved to.
void TestCameras()
{
  const char* given = std::getenv("RELIEF_SEED");
  const unsigned int seed = given ? std::atoi(given) : std::random_device()();
  std::cout << "RELIEF_SEED=" << seed << std::endl;
  std::mt19937 random(seed);
  auto in = [&](double low, double high)
  { return std::uniform_real_distribution<double>(low, high)(random); };
  vtkSmartPointer<vtkImageData> terrain = Terrain();
  WidgetStage stage(terrain);
  vtkReliefLightRepresentation* dot = stage.Dot();
  dot->SetRenderer(stage.Renderer);
  stage.Scene()->GetMaterial()->UseFloorOn();
  int moved = 0;
  int stopped = 0;
  for (int round = 0; round < 300; ++round)
  {
    terrain->SetSpacing(
      in(0.5, 2.0) * (round % 3 ? 1.0 : -1.0), in(0.5, 2.0) * (round % 4 ? 1.0 : -1.0), 1.0);
    terrain->SetOrigin(in(-500.0, 500.0), in(-500.0, 500.0), in(-500.0, 500.0));
    vtkNew<vtkTransform> turn;
    turn->RotateWXYZ(in(0.0, 360.0), in(-1.0, 1.0), in(-1.0, 1.0), in(-1.0, 1.0));
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        terrain->GetDirectionMatrix()->SetElement(i, j, turn->GetMatrix()->GetElement(i, j));
      }
    }
    dot->PlaceWidget(terrain);
    dot->SetDraped(round % 2);
    dot->SetProp(nullptr);
    if (round % 5 == 0)
    {
      stage.Slice->SetPosition(in(-100.0, 100.0), in(-100.0, 100.0), in(-100.0, 100.0));
      stage.Slice->RotateX(in(0.0, 360.0));
      stage.Slice->SetScale(in(0.5, 2.0));
      dot->SetProp(stage.Slice);
    }
    vtkNew<vtkLight> light;
    vtkNew<vtkMatrix4x4> transform;
    if (round % 7 == 0)
    {
      turn->Scale(2.0, 0.5, 1.0);
      turn->Translate(3.0, 4.0, 5.0);
      transform->DeepCopy(turn->GetMatrix());
      light->SetTransformMatrix(transform);
    }
    light->SetPositional(round % 2 == 0);
    double middle[3];
    terrain->GetCenter(middle);
    light->SetPosition(
      middle[0] + in(-60.0, 60.0), middle[1] + in(-60.0, 60.0), middle[2] + in(-60.0, 60.0));
    light->SetFocalPoint(middle);
    stage.Scene()->RemoveAllLights();
    stage.Scene()->AddLight(light);

    vtkCamera* camera = stage.Camera();
    camera->SetParallelProjection(round % 11 < 5);
    double focal[3];
    vtkMath::Assign(stage.Slice->GetCenter(), focal);
    camera->SetFocalPoint(focal);
    camera->SetPosition(
      focal[0] + in(-300.0, 300.0), focal[1] + in(-300.0, 300.0), focal[2] + in(-300.0, 300.0));
    camera->SetViewUp(in(-1.0, 1.0), in(-1.0, 1.0), in(-1.0, 1.0));
    stage.Renderer->ResetCameraClippingRange();

    double before[3];
    light->GetPosition(before);
    auto seen = stage.DotInWindow();
    if (!dot->MoveDot(seen[0], seen[1]))
    {
      continue; // behind the camera, or the plane is seen edge-on
    }
    ++moved;
    for (int axis = 0; axis < 3; ++axis)
    {
      CHECK_NEAR(light->GetPosition()[axis], before[axis], 1e-3);
    }
    if (!dot->ShiftDot(3.0, -2.0))
    {
      continue;
    }
    const auto shifted = stage.DotInWindow();
    const double error = std::hypot(shifted[0] - seen[0] - 3.0, shifted[1] - seen[1] + 2.0);
    // A plane that is seen almost edge-on leaves a few hundredths of a pixel to rounding.
    if (error > 0.1)
    {
      // Only where the light has come to the end of its way.
      double position[3];
      light->GetTransformedPosition(position);
      const auto toward = Toward(light);
      vtkMatrix3x3* axes = terrain->GetDirectionMatrix();
      const double down = toward[0] * axes->GetElement(0, 2) + toward[1] * axes->GetElement(1, 2) +
        toward[2] * axes->GetElement(2, 2);
      CHECK(light->GetPositional()
          ? std::sqrt(vtkMath::Distance2BetweenPoints(position, middle)) > 600.0
          : down < -1.0 + 1e-9);
      ++stopped;
    }
  }
  std::cout << moved << " of 300 dots moved, " << stopped << " to the end" << std::endl;
  CHECK(moved > 200 && stopped < moved / 4);
}

void TestPlaces()
{
  vtkNew<vtkReliefLightRepresentation> dot;
  vtkNew<vtkReliefScene> scene;
  vtkNew<vtkLight> lamp;
  lamp->PositionalOn();
  lamp->SetPosition(1.0, 2.0, 3.0);
  scene->AddLight(lamp);
  dot->SetScene(scene);
  double at[3];
  CHECK(dot->GetDotPosition(at) && at[0] == 1.0 && at[1] == 2.0 && at[2] == 0.0);
  CHECK(!dot->MoveDot(5.0, 5.0) && !dot->ShiftDot(5.0, 5.0)); // without a renderer
  CHECK(dot->ComputeInteractionState(1, 2) == vtkReliefLightRepresentation::Outside);

  double bounds[6] = { 0.0, 10.0, 0.0, 20.0, 4.0, 8.0 };
  dot->PlaceWidget(bounds);
  CHECK(dot->GetDotPosition(at));
  CHECK_NEAR(at[0], 1.0, 1e-12);
  CHECK_NEAR(at[2], 6.0, 1e-12);

  // Flat in the plane of the image, or draped at the mean of the scaled heights without its holes.
  auto heights = MakeHeights(3, 2, [](int i, int) { return i == 2 ? NAN : 10.0 + 10.0 * i; });
  heights->SetOrigin(0.0, 0.0, 100.0);
  dot->PlaceWidget(heights);
  CHECK(dot->GetMeanHeight() == 15.0);
  CHECK(dot->GetDotPosition(at) && at[2] == 100.0);
  dot->DrapedOn();
  scene->SetHeightScale(3.0);
  CHECK(dot->GetDotPosition(at) && at[2] == 145.0);
  dot->SetMeanHeight(20.0);
  CHECK(dot->GetDotPosition(at) && at[2] == 160.0);

  // What is no place is refused.
  MessageKeeper messages(dot);
  dot->PlaceWidget(static_cast<vtkImageData*>(nullptr));
  CHECK(messages.OneError("null"));
  vtkNew<vtkImageData> empty;
  dot->PlaceWidget(empty);
  CHECK(messages.OneError("without heights"));
  auto flat = MakeHeights(3, 2, [](int, int) { return 1.0; });
  flat->GetDirectionMatrix()->Zero();
  dot->PlaceWidget(flat);
  CHECK(messages.OneError("singular"));
  flat->GetDirectionMatrix()->Identity();
  flat->SetSpacing(INFINITY, 1.0, 1.0);
  dot->PlaceWidget(flat);
  CHECK(messages.OneError("finite"));
  double upsideDown[6] = { 0.0, 10.0, 20.0, 0.0, 0.0, 0.0 };
  dot->PlaceWidget(upsideDown);
  CHECK(messages.OneError("(0, 10, 20, 0, 0, 0)"));
  CHECK(dot->GetDotPosition(at) && at[2] == 160.0);

  // Reliefs of one sample and of one row.
  for (const auto& size : { std::array<int, 2>{ 1, 1 }, { 50, 1 } })
  {
    auto thin = MakeHeights(size[0], size[1], [](int, int) { return 1.0; });
    dot->PlaceWidget(thin);
    CHECK(dot->GetDotPosition(at) && dot->RaiseLight(1.0));
    CHECK(dot->SwitchLightType() && dot->SwitchLightType());
    CHECK(std::isfinite(lamp->GetPosition()[0] + lamp->GetPosition()[2]));
  }
  CHECK(messages.Silent());
}

void TestWhichLight()
{
  vtkNew<vtkReliefLightRepresentation> dot;
  CHECK(dot->GetLight() == nullptr && !dot->SwitchLightType());
  vtkNew<vtkReliefScene> scene;
  dot->SetScene(scene);
  CHECK(dot->GetLight() == nullptr);
  vtkLight* first = scene->AddSun(10.0, 20.0);
  vtkLight* second = scene->AddSun(30.0, 40.0);
  CHECK(dot->GetLight() == first);
  dot->SetLight(second);
  CHECK(dot->GetLight() == second);
  vtkSmartPointer<vtkLight> kept = second;
  scene->RemoveLight(second);
  double at[3];
  CHECK(dot->GetLight() == nullptr && !dot->GetDotPosition(at) && !dot->RaiseLight(1.0));
  scene->AddLight(second);
  CHECK(dot->GetLight() == second);
  dot->SetLight(nullptr);
  CHECK(dot->GetLight() == first);

  // Lights that are nowhere have no dot, and are left alone.
  first->SetPosition(NAN, 0.0, 0.0);
  CHECK(!dot->GetDotPosition(at) && !dot->RaiseLight(1.0));
  first->SetPosition(first->GetFocalPoint());
  CHECK(!dot->GetDotPosition(at));
  first->PositionalOn();
  first->SetPosition(0.0, std::numeric_limits<double>::infinity(), 0.0);
  CHECK(!dot->GetDotPosition(at) && !dot->SwitchLightType());

  // Neither is a light whose transform cannot be undone.
  first->SetPosition(0.0, 0.0, 0.0);
  vtkNew<vtkMatrix4x4> flat;
  flat->SetElement(2, 2, 0.0);
  first->SetTransformMatrix(flat);
  CHECK(dot->GetDotPosition(at) && !dot->RaiseLight(1.0));

  std::ostringstream printed;
  dot->Print(printed);
  for (const char* name : { "Scene", "Light", "Prop", "Draped", "MeanHeight", "OutlineColor" })
  {
    CHECK(printed.str().find(std::string(name) + ":") != std::string::npos);
  }
}

// Colours are as shown: clamped to [0, 1], and a number each.
void TestColors()
{
  vtkSmartPointer<vtkImageData> terrain = Terrain();
  WidgetStage stage(terrain);
  vtkReliefLightRepresentation* dot = stage.Dot();
  auto is = [](const double* color, double r, double g, double b)
  { return color[0] == r && color[1] == g && color[2] == b; };
  CHECK(is(dot->GetOutlineColor(), 1.0, 1.0, 1.0));
  CHECK(is(dot->GetSelectedOutlineColor(), 1.0, 0.6, 0.1));
  dot->SetOutlineColor(-1.0, 0.25, 1.5);
  CHECK(is(dot->GetOutlineColor(), 0.0, 0.25, 1.0));
  const double bright[3] = { INFINITY, -INFINITY, 0.75 };
  dot->SetSelectedOutlineColor(bright);
  CHECK(is(dot->GetSelectedOutlineColor(), 1.0, 0.0, 0.75));

  MessageKeeper messages(dot);
  const vtkMTimeType time = dot->GetMTime();
  dot->SetOutlineColor(0.0, NAN, 0.0);
  CHECK(messages.OneError("SetOutlineColor: (0, nan, 0)"));
  dot->SetSelectedOutlineColor(0.0, 0.0, NAN);
  CHECK(messages.OneError("SetSelectedOutlineColor: (0, 0, nan)"));
  dot->SetOutlineColor(-2.0, 0.25, 2.0); // as it is
  CHECK(is(dot->GetOutlineColor(), 0.0, 0.25, 1.0) && dot->GetMTime() == time);
  CHECK(is(dot->GetSelectedOutlineColor(), 1.0, 0.0, 0.75));

  // A light's own colour may be anything.
  stage.Scene()->AddSun(20.0, 30.0)->SetDiffuseColor(NAN, 0.5, -1.0);
  dot->SetRenderer(stage.Renderer);
  dot->BuildRepresentation();
  CHECK(messages.Silent());
}

// A sun that the scene did not make keeps its focal point and its distance from there.
void TestFocalPoint()
{
  vtkNew<vtkReliefLightRepresentation> dot;
  vtkNew<vtkReliefScene> scene;
  dot->SetScene(scene);
  vtkNew<vtkLight> sun;
  sun->SetFocalPoint(5.0, 6.0, 7.0);
  sun->SetPosition(5.0, 6.0 + 30.0, 7.0 + 40.0);
  scene->AddLight(sun);
  CHECK(dot->RaiseLight(10.0));
  CHECK(sun->GetFocalPoint()[0] == 5.0 && sun->GetFocalPoint()[2] == 7.0);
  CHECK_NEAR(std::sqrt(vtkMath::Distance2BetweenPoints(sun->GetPosition(), sun->GetFocalPoint())),
    50.0, 1e-9);
  CHECK_NEAR(Altitude(sun), vtkMath::DegreesFromRadians(std::atan2(40.0, 30.0)) + 10.0, 1e-9);
}

// A plane that is seen from its edge has no point under the mouse, and one behind the camera none
// either.
void TestUnseenPlanes()
{
  vtkSmartPointer<vtkImageData> terrain = Terrain();
  WidgetStage stage(terrain);
  stage.Dot()->SetRenderer(stage.Renderer);
  vtkLight* sun = stage.Scene()->AddSun(20.0, 30.0);
  const vtkMTimeType time = sun->GetMTime();
  stage.Camera()->SetFocalPoint(60.0, 40.0, 0.0);
  stage.Camera()->SetPosition(60.0, -200.0, 0.0);
  stage.Camera()->SetViewUp(0.0, 0.0, 1.0);
  CHECK(!stage.Dot()->MoveDot(100.0, 100.0));
  stage.Camera()->ParallelProjectionOff();
  stage.Camera()->SetPosition(60.0, -200.0, 50.0);
  stage.Camera()->SetFocalPoint(60.0, 40.0, 50.0);
  CHECK(!stage.Dot()->MoveDot(100.0, 120.0)); // above the horizon: the plane is behind
  CHECK(stage.Dot()->MoveDot(100.0, 40.0));   // below it: seen
  CHECK(sun->GetMTime() > time);
  stage.Camera()->SetPosition(60.0, 400.0, 50.0);
  stage.Camera()->SetFocalPoint(60.0, 500.0, 50.0);
  CHECK(stage.Dot()->ComputeInteractionState(100, 100) == vtkReliefLightRepresentation::Outside);
  stage.Widget->On();
  stage.Window->Render(); // without a dot
}
}

int TestReliefLightRepresentation(int, char*[])
{
  TestCompass();
  TestRaising();
  TestSwitching();
  TestCameras();
  TestPlaces();
  TestWhichLight();
  TestColors();
  TestFocalPoint();
  TestUnseenPlanes();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
