// SPDX-License-Identifier: BSD-3-Clause
// What an environment takes and refuses, which way it faces, and what the filter makes of it.
#include "vtkReliefEnvironment.h"

#include "vtkIntArray.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkReliefStatistics.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedShortArray.h"

#include "ReliefTestUtilities.h"

#include <limits>
#include <sstream>

namespace
{

const double Pi = 3.14159265358979323846;

/// An environment's image: row 0 is the bottom, as VTK has it.
template <class ArrayType = vtkFloatArray>
vtkSmartPointer<vtkImageData> MakeMap(
  int columns, int rows, int components, const std::function<double(int, int, int)>& value)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(columns, rows, 1);
  vtkNew<ArrayType> values;
  values->SetNumberOfComponents(components);
  values->SetNumberOfTuples(image->GetNumberOfPoints());
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      for (int c = 0; c < components; ++c)
      {
        values->SetComponent(j * columns + i, c, value(i, j, c));
      }
    }
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

/// Colours that differ all around, brightest in the first quarter, some from below.
vtkSmartPointer<vtkImageData> Lopsided()
{
  return MakeMap(24, 12, 3,
    [](int i, int j, int c) { return (i < 6 ? 2.0 : 0.3) + 0.1 * j + 0.2 * std::sin(i + c); });
}

/// A relief that is lit by an environment alone.
struct Lit
{
  Lit(vtkImageData* heights, vtkImageData* map)
  {
    this->Environment->SetImage(map);
    this->Shading->GetScene()->SetEnvironment(this->Environment);
    this->Shading->SetInputData(heights);
  }
  vtkImageData* Update()
  {
    this->Shading->Update();
    return this->Shading->GetOutput();
  }
  vtkNew<vtkReliefEnvironment> Environment;
  vtkNew<vtkImageReliefShading> Shading;
};

/// The colour of level ground under a map of one colour, with its factor for the sphere taken out.
double LevelColor(vtkImageData* map, int component = 0)
{
  Lit lit(MakeHeights(3, 3, [](int, int) { return 0.0; }), map);
  return Value(lit.Update(), nullptr, 1, 1, component);
}

int TestParameters()
{
  int Failures = 0;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  vtkNew<vtkReliefEnvironment> environment;
  CHECK(!environment->GetImage() && environment->GetRotationZ() == 0.0);
  CHECK(environment->GetTilt() == 0.0 && environment->GetIntensity() == 1.0);
  CHECK(environment->GetRadius() == infinity);
  CHECK(environment->GetSampling() == vtkReliefEnvironment::SolidAngle);
  CHECK(environment->GetNumberOfSamples() == 64);

  vtkMTimeType time = environment->GetMTime();
  auto changed = [&]()
  {
    bool later = environment->GetMTime() > time;
    time = environment->GetMTime();
    return later;
  };
  environment->SetRotationZ(-370.0);
  CHECK(changed() && environment->GetRotationZ() == -370.0);
  environment->SetTilt(30.0);
  CHECK(changed());
  environment->SetIntensity(0.0);
  CHECK(changed());
  environment->SetRadius(12.0);
  CHECK(changed());
  environment->SetRadius(12.0);
  CHECK(!changed());
  environment->SetRadiusToInfinity();
  CHECK(changed() && environment->GetRadius() == infinity);
  environment->SetSamplingToImportance();
  CHECK(changed() && environment->GetSampling() == vtkReliefEnvironment::Importance);
  environment->SetNumberOfSamples(1);
  CHECK(changed());
  environment->SetImageToWhiteDome();
  CHECK(changed() && environment->GetImage());
  environment->GetImage()->GetPointData()->GetScalars()->Modified();
  CHECK(changed());
  environment->SetImageToClearSky(700.0, 0.0);
  CHECK(changed());
  CHECK(environment->GetImage()->GetPointData()->GetScalars()->GetNumberOfComponents() == 3);

  MessageKeeper messages(environment);
  environment->SetRotationZ(nan);
  CHECK(messages.OneError("nan"));
  environment->SetTilt(infinity);
  CHECK(messages.OneError("inf"));
  environment->SetIntensity(-1.0);
  CHECK(messages.OneError("-1"));
  environment->SetRadius(0.0);
  CHECK(messages.OneError("0"));
  environment->SetRadius(nan);
  CHECK(messages.OneError("nan"));
  environment->SetSampling(3);
  CHECK(messages.OneError("3"));
  environment->SetNumberOfSamples(0);
  CHECK(messages.OneError("0"));
  environment->SetNumberOfSamples(65537);
  CHECK(messages.OneError("65537"));
  environment->SetImageToClearSky(nan, 10.0);
  CHECK(messages.OneError("nan"));
  environment->SetImageToClearSky(10.0, -1.0);
  CHECK(messages.OneError("-1"));
  environment->SetImageToClearSky(10.0, 20.0, 1.5);
  CHECK(messages.OneError("1.5"));
  CHECK(!changed());

  std::ostringstream printed;
  environment->Print(printed);
  for (const char* name :
    { "Image", "RotationZ", "Tilt", "Intensity", "Radius", "Sampling", "NumberOfSamples" })
  {
    CHECK(printed.str().find(std::string(name) + ":") != std::string::npos);
  }
  return Failures;
}

// Number types, components, encoding.
int TestImages()
{
  int Failures = 0;
  auto constant = [](double value) { return [value](int, int, int) { return value; }; };
  CHECK_NEAR(LevelColor(MakeMap(4, 2, 3, constant(0.25))), 0.25, 1e-6);
  CHECK_NEAR(LevelColor(MakeMap<vtkDoubleArray>(1, 1, 3, constant(0.25))), 0.25, 1e-6);
  // 50 % grey on screen is 0.214 linear.
  CHECK_NEAR(LevelColor(MakeMap<vtkUnsignedCharArray>(4, 2, 3, constant(127.5))), 0.2122, 0.0001);
  CHECK_NEAR(LevelColor(MakeMap<vtkUnsignedCharArray>(4, 2, 3, constant(255))), 1.0, 1e-6);
  CHECK_NEAR(
    LevelColor(MakeMap<vtkUnsignedShortArray>(4, 2, 3, constant(32767.5))), 0.21404, 0.00002);
  CHECK_NEAR(LevelColor(MakeMap<vtkUnsignedShortArray>(4, 2, 3, constant(65535))), 1.0, 1e-6);
  // Grey, and alpha, which does not count.
  auto numbered = [](int, int, int c) { return 0.1 * (c + 1); };
  for (int components : { 1, 2, 3, 4 })
  {
    auto map = MakeMap(4, 2, components, numbered);
    CHECK_NEAR(LevelColor(map, 0), 0.1, 1e-6);
    CHECK_NEAR(LevelColor(map, 1), components < 3 ? 0.1 : 0.2, 1e-6);
    CHECK_NEAR(LevelColor(map, 2), components < 3 ? 0.1 : 0.3, 1e-6);
  }

  // What is wrong is one error of the filter, and an empty output.
  auto says = [&](vtkImageData* map, const std::string& text)
  {
    Lit lit(MakeHeights(3, 3, [](int, int) { return 0.0; }), map);
    MessageKeeper messages(lit.Shading);
    bool empty = lit.Update()->GetNumberOfPoints() == 0;
    return messages.OneError("the environment" + text) && empty;
  };
  vtkNew<vtkImageData> empty;
  CHECK(says(empty, " image is empty"));
  vtkNew<vtkImageData> bare;
  bare->SetDimensions(2, 2, 1);
  CHECK(says(bare, " image has no scalars"));
  CHECK(says(MakeMap(2, 2, 5, constant(1.0)), " image has 5 components"));
  CHECK(says(MakeMap<vtkIntArray>(2, 2, 3, constant(1.0)), " scalars are of type int"));
  vtkNew<vtkImageData> thick;
  thick->SetDimensions(2, 2, 2);
  thick->AllocateScalars(VTK_FLOAT, 3);
  CHECK(says(thick, " image has 2 slices"));

  // Texels that are no radiance are counted, once for every change of the image.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  auto spoiled = MakeMap(4, 2, 3,
    [&](int i, int j, int c) {
      return i == 0 && j == 0 ? nan : i == 1 && c == 1 ? -1.0 : i == 2 ? 1e300 : 0.5;
    });
  Lit lit(MakeHeights(3, 3, [](int, int) { return 0.0; }), spoiled);
  MessageKeeper messages(lit.Environment);
  vtkImageData* output = lit.Update();
  CHECK(messages.OneWarning("5 texels"));
  CHECK(std::isfinite(Value(output, nullptr, 1, 1)) && Value(output, nullptr, 1, 1) > 0.1);
  lit.Environment->SetRotationZ(10.0);
  lit.Update();
  CHECK(messages.Silent());
  spoiled->GetPointData()->GetScalars()->SetComponent(0, 0, 0.0);
  spoiled->GetPointData()->GetScalars()->Modified();
  lit.Update();
  CHECK(messages.OneWarning("5 texels"));
  return Failures;
}

// Which way is up, and which way round.
int TestDirections()
{
  int Failures = 0;
  auto level = MakeHeights(3, 3, [](int, int) { return 0.0; });
  // The picture's top row, the last of the image, is the zenith.
  CHECK_NEAR(LevelColor(MakeMap(1, 2, 1, [](int, int j, int) { return 1.0 * j; })), 1.0, 1e-6);
  CHECK(LevelColor(MakeMap(1, 2, 1, [](int, int j, int) { return 1.0 - j; })) == 0.0f);

  // One bright texel on the horizon's upper side, at an azimuth counter-clockwise from +x; a ramp
  // in each direction tells from where the light comes.
  auto comesFrom = [](vtkReliefEnvironment* environment, double x, double y)
  {
    vtkNew<vtkImageReliefShading> shading;
    shading->GetScene()->SetEnvironment(environment);
    shading->GetScene()->GetMaterial()->SetOffsetModeToSurfaceNormal();
    auto shade = [&](double sign)
    {
      shading->SetInputData(
        MakeHeights(41, 41, [&](int i, int j) { return -0.3 * sign * (x * i + y * j); }));
      shading->Update();
      return Value(shading->GetOutput(), nullptr, 20, 20);
    };
    return shade(1.0) - shade(-1.0); // a slope that faces (x, y), and one that faces away
  };
  auto bright = MakeMap(4, 4, 1, [](int i, int j, int) { return i == 0 && j == 2 ? 1.0 : 0.0; });
  vtkNew<vtkReliefEnvironment> environment;
  environment->SetImage(bright); // from azimuth 45, between +x and +y
  for (int sampling : { 0, 1, 2 })
  {
    environment->SetSampling(sampling);
    environment->SetTilt(0.0);
    environment->SetRotationZ(0.0);
    CHECK(comesFrom(environment, 1.0, 1.0) > 0.02);
    CHECK_NEAR(comesFrom(environment, 1.0, -1.0), 0.0, 0.02);
    environment->SetRotationZ(90.0);
    CHECK(comesFrom(environment, -1.0, 1.0) > 0.02);
    environment->SetRotationZ(-45.0);
    CHECK(comesFrom(environment, 1.0, 0.0) > 0.02);
    CHECK_NEAR(comesFrom(environment, 0.0, 1.0), 0.0, 0.02);
    // A tilt lowers what stands in the south and lifts what stands in the north.
    environment->SetRotationZ(45.0);
    const double upright = comesFrom(environment, 0.0, 1.0);
    environment->SetTilt(40.0);
    CHECK(comesFrom(environment, 0.0, 1.0) < upright);
    environment->SetTilt(-90.0);
    CHECK(comesFrom(environment, 0.0, 1.0) == 0.0);
  }

  // No image is no light, and no default sun either.
  Lit dark(level, nullptr);
  CHECK(Value(dark.Update(), nullptr, 1, 1) == 0.0f && Value(dark.Update(), nullptr, 1, 1, 3) == 1);
  dark.Shading->GetScene()->SetEnvironment(nullptr);
  CHECK(Value(dark.Update(), nullptr, 1, 1) > 0.5f);
  return Failures;
}

// Turning the relief with its environment changes nothing but rounding.
int TestTurning()
{
  int Failures = 0;
  const int size = 70;
  auto hills = [](int i, int j) { return 0.1 * Hills(5)(i, j); };
  for (int sampling : { 0, 1, 2 })
  {
    Lit lit(MakeHeights(size, size, hills), Lopsided());
    lit.Environment->SetSampling(sampling);
    lit.Environment->SetTilt(sampling == 1 ? 15.0 : 0.0);
    vtkReliefScene* scene = lit.Shading->GetScene();
    scene->SetTolerance(0.0);
    scene->GetMaterial()->SetSubsurfaceDepth(0.5);
    vtkNew<vtkImageData> before;
    before->DeepCopy(lit.Update());

    // By the direction matrix.
    auto turned = MakeHeights(size, size, hills);
    const double c = std::cos(30.0 * Pi / 180.0);
    const double s = std::sin(30.0 * Pi / 180.0);
    turned->SetDirectionMatrix(c, -s, 0, s, c, 0, 0, 0, 1);
    lit.Shading->SetInputData(turned);
    if (lit.Environment->GetTilt() == 0.0)
    {
      lit.Environment->SetRotationZ(30.0);
      CHECK(LargestDifference(before->GetPointData()->GetScalars(),
              lit.Update()->GetPointData()->GetScalars()) < 1e-4);
      // The picture turns indeed.
      lit.Environment->SetRotationZ(0.0);
      CHECK(LargestDifference(before->GetPointData()->GetScalars(),
              lit.Update()->GetPointData()->GetScalars()) > 0.02);

      // By turning the samples a quarter counter-clockwise.
      lit.Shading->SetInputData(
        MakeHeights(size, size, [&](int i, int j) { return hills(j, size - 1 - i); }));
      lit.Environment->SetRotationZ(90.0);
      vtkImageData* after = lit.Update();
      double largest = 0.0;
      for (int j = 0; j < size; ++j)
      {
        for (int i = 0; i < size; ++i)
        {
          largest = std::max<double>(largest,
            std::abs(Value(after, nullptr, i, j) - Value(before, nullptr, j, size - 1 - i)));
        }
      }
      CHECK(largest < 1e-3);
      lit.Environment->SetRotationZ(0.0);
    }

    // Stored the other way round along x, with a negative spacing: the same relief.
    auto mirrored = MakeHeights(size, size, [&](int i, int j) { return hills(size - 1 - i, j); });
    mirrored->SetSpacing(-1.0, 1.0, 1.0);
    lit.Shading->SetInputData(mirrored);
    vtkImageData* after = lit.Update();
    double largest = 0.0;
    for (int j = 0; j < size; ++j)
    {
      for (int i = 0; i < size; ++i)
      {
        largest = std::max<double>(
          largest, std::abs(Value(after, nullptr, i, j) - Value(before, nullptr, size - 1 - i, j)));
      }
    }
    CHECK(largest < 1e-3);
  }
  return Failures;
}

// A map that is made anew tells of its bad texels again.
int TestRelease()
{
  int Failures = 0;
  auto image = MakeMap(4, 2, 3,
    [](int i, int j, int) { return i + j == 0 ? std::numeric_limits<double>::quiet_NaN() : 1.0; });
  Lit lit(MakeHeights(3, 3, [](int, int) { return 0.0; }), image);
  vtkReliefScene* scene = lit.Shading->GetScene();
  MessageKeeper messages(lit.Environment);
  lit.Update();
  CHECK(messages.OneWarning("1 texels"));
  scene->Modified();
  lit.Update();
  CHECK(messages.Silent());
  lit.Shading->ReleaseCache();
  lit.Shading->Modified();
  lit.Update();
  CHECK(messages.OneWarning("1 texels"));

  // Nothing is kept for an environment that is gone, or that has no image.
  scene->SetEnvironment(nullptr);
  lit.Update();
  scene->SetEnvironment(lit.Environment);
  lit.Update();
  CHECK(messages.OneWarning("1 texels"));
  lit.Environment->SetImage(nullptr);
  lit.Update();
  lit.Environment->SetImage(image);
  lit.Update();
  CHECK(messages.OneWarning("1 texels"));
  return Failures;
}

// Statistics, intensity, radius, and what is kept.
int TestLights()
{
  int Failures = 0;
  Lit lit(MakeHeights(80, 60, [](int i, int j) { return 0.1 * Hills(3)(i, j); }), Lopsided());
  vtkReliefScene* scene = lit.Shading->GetScene();
  vtkReliefStatistics* statistics = lit.Shading->GetStatistics();
  vtkNew<vtkImageData> once;
  once->DeepCopy(lit.Update());
  CHECK(statistics->GetLightsTraced() == 32); // of 64, those above the horizon
  scene->GetMaterial()->SetDiffuseColor(0.5, 0.5, 0.5);
  lit.Environment->SetIntensity(2.0);
  CHECK(LargestDifference(
          once->GetPointData()->GetScalars(), lit.Update()->GetPointData()->GetScalars()) < 1e-5);
  CHECK(statistics->GetLightsTraced() == 0 && statistics->GetLightsReused() == 32);

  // A turn about its axis changes what the samples see, not where they stand.
  lit.Environment->SetRotationZ(37.0);
  vtkNew<vtkImageData> turned;
  turned->DeepCopy(lit.Update());
  CHECK(statistics->GetLightsTraced() == 0 && statistics->GetLightsReused() == 32);
  lit.Shading->ReleaseCache();
  lit.Shading->Modified();
  CHECK(LargestDifference(
          turned->GetPointData()->GetScalars(), lit.Update()->GetPointData()->GetScalars()) == 0.0);
  CHECK(statistics->GetLightsTraced() == 32);
  lit.Environment->SetRotationZ(0.0);

  // Lights add to the environment's.
  scene->GetMaterial()->SetDiffuseColor(1.0, 1.0, 1.0);
  lit.Environment->SetIntensity(1.0);
  scene->AddSun(315.0, 45.0);
  vtkNew<vtkImageData> both;
  both->DeepCopy(lit.Update());
  scene->SetEnvironment(nullptr);
  vtkNew<vtkImageData> sun;
  sun->DeepCopy(lit.Update());
  for (int i = 0; i < 80; i += 7)
  {
    CHECK_NEAR(
      Value(both, nullptr, i, 30), Value(once, nullptr, i, 30) + Value(sun, nullptr, i, 30), 1e-5);
  }
  scene->SetEnvironment(lit.Environment);
  scene->RemoveAllLights();

  // Far away, a sphere is as good as infinity; near by, the light from below finds its way.
  lit.Environment->SetRadius(1e6);
  scene->SetTolerance(0.0);
  vtkNew<vtkImageData> far;
  far->DeepCopy(lit.Update());
  lit.Environment->SetRadiusToInfinity();
  CHECK(LargestDifference(
          far->GetPointData()->GetScalars(), lit.Update()->GetPointData()->GetScalars()) < 0.02);
  lit.Environment->SetRadius(60.0);
  lit.Update();
  CHECK(statistics->GetLightsTraced() == 64);

  // The lights of a sphere about the middle: level ground is brightest there under a white dome.
  Lit dome(MakeHeights(81, 61, [](int, int) { return 7.0; }), nullptr);
  dome.Environment->SetImageToWhiteDome();
  dome.Environment->SetRadius(50.0);
  vtkImageData* output = dome.Update();
  CHECK_NEAR(Value(output, nullptr, 40, 30), 1.0, 0.03);
  CHECK(Value(output, nullptr, 40, 30) > Value(output, nullptr, 2, 2));
  CHECK_NEAR(Value(output, nullptr, 5, 5), Value(output, nullptr, 75, 55), 0.02);
  return Failures;
}

}

int TestReliefEnvironment(int, char*[])
{
  const int failures = TestParameters() + TestImages() + TestDirections() + TestTurning() +
    TestRelease() + TestLights();
  return failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
