// SPDX-License-Identifier: BSD-3-Clause
// Values that can be worked out by hand: planes, a pyramid under a known sun, frames, layers,
// types.
#include "vtkImageReliefShading.h"

#include "vtkCharArray.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkLight.h"
#include "vtkLongArray.h"
#include "vtkLongLongArray.h"
#include "vtkMath.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkReliefStatistics.h"
#include "vtkShortArray.h"
#include "vtkSignedCharArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedIntArray.h"
#include "vtkUnsignedLongArray.h"
#include "vtkUnsignedLongLongArray.h"
#include "vtkUnsignedShortArray.h"

#include "ReliefTestUtilities.h"

#include <algorithm>
#include <functional>
#include <iostream>
#include <sstream>

namespace
{
int Failures = 0;

// d of a plane of slope (gx, gy) with the vertical offset.
double PlaneIllumination(double gx, double gy, vtkLight* sun)
{
  const double* l = sun->GetPosition();
  return std::min(1.0, std::max(0.0, l[2] - gx * l[0] - gy * l[1]));
}

void TestDefaults()
{
  vtkNew<vtkImageReliefShading> filter;
  CHECK(filter->GetOutputScalarType() == VTK_FLOAT && !filter->GetUseNoDataValue());
  filter->SetInputData(MakeHeights(5, 4, [](int, int) { return 7.0; }));
  filter->Update();
  vtkImageData* output = filter->GetOutput();
  CHECK(output->GetScalarType() == VTK_FLOAT && output->GetNumberOfScalarComponents() == 4);
  CHECK(output->GetPointData()->GetNumberOfArrays() == 1);
  // Level ground under the default sun, 45 degrees up and no brighter than that white is left.
  for (int c = 0; c < 3; ++c)
  {
    CHECK_NEAR(Value(output, nullptr, 2, 2, c), 0.95 * std::sqrt(0.5), 1e-6);
  }
  CHECK(Value(output, nullptr, 2, 2, 3) == 1.0f);

  std::ostringstream printed;
  filter->Print(printed);
  for (const char* name :
    { "Scene", "NoDataValue", "UseNoDataValue", "OutputScalarType", "GenerateIllumination",
      "GenerateThickness", "GenerateShadow", "GenerateNormals", "GenerateBase", "GenerateDiffuse",
      "GenerateScatter", "GenerateSpecular", "CacheMemoryLimit", "Statistics" })
  {
    CHECK(printed.str().find(std::string(name) + ":") != std::string::npos);
  }
}

// A pyramid-shaped hill: its faces look north, east, south and west, so that the sun's azimuth
// shows.
void TestPyramid()
{
  const int size = 41;
  const double slope = 0.25;
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(MakeHeights(size, size,
    [&](int i, int j) { return slope * (20 - std::max(std::abs(i - 20), std::abs(j - 20))); }));
  filter->GetScene()->SetTolerance(0.0);
  filter->GetScene()->GetMaterial()->SetOffsetModeToVertical();
  filter->GenerateIlluminationOn();
  struct
  {
    int i, j;
    double gx, gy;
  } faces[] = { { 20, 32, 0.0, -slope }, { 32, 20, -slope, 0.0 }, { 20, 8, 0.0, slope },
    { 8, 20, slope, 0.0 } };
  for (double azimuth : { 0.0, 90.0, 180.0, 270.0, 315.0 })
  {
    for (double altitude : { 20.0, 45.0, 90.0 })
    {
      filter->GetScene()->RemoveAllLights();
      vtkLight* sun = filter->GetScene()->AddSun(azimuth, altitude);
      filter->Update();
      for (const auto& face : faces)
      {
        CHECK_NEAR(Value(filter->GetOutput(), "Illumination", face.i, face.j),
          PlaneIllumination(face.gx, face.gy, sun), 2e-6);
      }
    }
  }
  // In words: the morning sun lights the eastern face best and the western one least.
  filter->GetScene()->RemoveAllLights();
  filter->GetScene()->AddSun(90.0, 30.0);
  filter->Update();
  float north = Value(filter->GetOutput(), "Illumination", 20, 32);
  float east = Value(filter->GetOutput(), "Illumination", 32, 20);
  float south = Value(filter->GetOutput(), "Illumination", 20, 8);
  float west = Value(filter->GetOutput(), "Illumination", 8, 20);
  CHECK(east > north && north == south && south > west);
}

template <class ArrayType>
void TestScalarType(vtkImageData* expected)
{
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(MakeHeights<ArrayType>(40, 30, Hills(3)));
  filter->Update();
  CHECK(SameBytes(
    filter->GetOutput()->GetPointData()->GetScalars(), expected->GetPointData()->GetScalars()));
}

void TestScalarTypes()
{
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(MakeHeights(40, 30, Hills(3)));
  filter->Update();
  vtkImageData* expected = filter->GetOutput();
  TestScalarType<vtkCharArray>(expected);
  TestScalarType<vtkSignedCharArray>(expected);
  TestScalarType<vtkUnsignedCharArray>(expected);
  TestScalarType<vtkShortArray>(expected);
  TestScalarType<vtkUnsignedShortArray>(expected);
  TestScalarType<vtkIntArray>(expected);
  TestScalarType<vtkUnsignedIntArray>(expected);
  TestScalarType<vtkLongArray>(expected);
  TestScalarType<vtkUnsignedLongArray>(expected);
  TestScalarType<vtkLongLongArray>(expected);
  TestScalarType<vtkUnsignedLongLongArray>(expected);
  TestScalarType<vtkIdTypeArray>(expected);
  TestScalarType<vtkDoubleArray>(expected);
}

// Origin, direction, spacing's sign and the extent's start are taken off before anything is
// computed.
void TestFrames()
{
  auto heights = MakeHeights(50, 40, Hills(5));
  heights->SetSpacing(1.5, 2.0, 1.0);
  const double lamp[3] = { 20.0, 90.0, 70.0 };
  auto shade = [&](vtkImageData* image, const double position[3], double azimuth)
  {
    vtkNew<vtkImageReliefShading> filter;
    filter->SetInputData(image);
    filter->GetScene()->SetTolerance(0.0);
    filter->GetScene()->AddSun(azimuth, 25.0);
    filter->GetScene()->GetMaterial()->SetSpecularCoefficient(0.3);
    filter->GenerateNormalsOn();
    vtkNew<vtkLight> light;
    light->PositionalOn();
    light->SetPosition(position);
    filter->GetScene()->AddLight(light);
    filter->Update();
    auto result = vtkSmartPointer<vtkImageData>::New();
    result->ShallowCopy(filter->GetOutput());
    return result;
  };
  auto expected = shade(heights, lamp, 300.0);
  vtkDataArray* colors = expected->GetPointData()->GetScalars();

  // A map's coordinates, exact in binary: the same picture, bit for bit.
  vtkNew<vtkImageData> moved;
  moved->ShallowCopy(heights);
  moved->SetOrigin(500000.0, 4.6e6, 128.0);
  const double movedLamp[3] = { 500000.0 + lamp[0], 4.6e6 + lamp[1], 128.0 + lamp[2] };
  CHECK(SameBytes(shade(moved, movedLamp, 300.0)->GetPointData()->GetScalars(), colors));

  // An extent that starts elsewhere.
  vtkNew<vtkImageData> shifted;
  shifted->ShallowCopy(heights);
  shifted->SetExtent(-100, -51, 200, 239, 0, 0);
  shifted->SetOrigin(150.0, -400.0, 0.0);
  auto shiftedResult = shade(shifted, lamp, 300.0);
  CHECK(SameBytes(shiftedResult->GetPointData()->GetScalars(), colors));
  CHECK(shiftedResult->GetExtent()[0] == -100 && shiftedResult->GetOrigin()[0] == 150.0);

  // Turned by a quarter counter-clockwise: the light turns along.
  vtkNew<vtkImageData> turned;
  turned->ShallowCopy(heights);
  turned->SetDirectionMatrix(0, -1, 0, 1, 0, 0, 0, 0, 1);
  turned->SetOrigin(10.0, 20.0, 30.0);
  const double turnedLamp[3] = { 10.0 - lamp[1], 20.0 + lamp[0], 30.0 + lamp[2] };
  auto turnedResult = shade(turned, turnedLamp, 210.0);
  CHECK(LargestDifference(turnedResult->GetPointData()->GetScalars(), colors) < 2e-6);
  // Normals are told in world coordinates.
  for (int k = 0; k < 3; ++k)
  {
    CHECK_NEAR(
      Value(turnedResult, "Normals", 17, 11, 0), -Value(expected, "Normals", 17, 11, 1), 1e-6);
    CHECK_NEAR(
      Value(turnedResult, "Normals", 17, 11, 1), Value(expected, "Normals", 17, 11, 0), 1e-6);
    CHECK_NEAR(
      Value(turnedResult, "Normals", 17, 11, 2), Value(expected, "Normals", 17, 11, 2), 1e-6);
  }

  // Rows that run from north to south, by a negative spacing and by a mirrored direction.
  auto flippedHeights = MakeHeights(50, 40, [](int i, int j) { return Hills(5)(i, 39 - j); });
  flippedHeights->SetSpacing(1.5, -2.0, 1.0);
  flippedHeights->SetOrigin(0.0, 78.0, 0.0);
  auto flipped = shade(flippedHeights, lamp, 300.0);
  flippedHeights->SetSpacing(1.5, 2.0, 1.0);
  flippedHeights->SetDirectionMatrix(1, 0, 0, 0, -1, 0, 0, 0, 1);
  auto mirrored = shade(flippedHeights, lamp, 300.0);
  for (int j = 0; j < 40; ++j)
  {
    for (int i = 0; i < 50; ++i)
    {
      CHECK_NEAR(Value(flipped, nullptr, i, 39 - j), Value(expected, nullptr, i, j), 2e-6);
      CHECK_NEAR(Value(mirrored, nullptr, i, 39 - j), Value(expected, nullptr, i, j), 2e-6);
      CHECK_NEAR(
        Value(flipped, "Normals", i, 39 - j, 1), Value(expected, "Normals", i, j, 1), 2e-6);
    }
  }
}

void TestLayersAndEncoding()
{
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(MakeHeights(30, 20, Hills(8)));
  vtkReliefMaterial* material = filter->GetScene()->GetMaterial();
  material->SetBaseColor(0.05, 0.1, 0.0);
  material->SetDiffuseColor(0.8, 0.5, 0.3);
  material->SetSpecularCoefficient(0.25);
  material->SetForwardScatterCoefficient(0.5);
  material->SetForwardScatterRange(-1.0, 1.0);
  filter->GetScene()->AddSun(40.0, 30.0)->SetDiffuseColor(1.0, 0.9, 0.7);
  filter->GetScene()->AddSun(200.0, 60.0)->SetIntensity(0.5);
  filter->GenerateIlluminationOn();
  filter->GenerateThicknessOn();
  filter->GenerateNormalsOn();
  filter->GenerateBaseOn();
  filter->GenerateDiffuseOn();
  filter->GenerateScatterOn();
  filter->GenerateSpecularOn();
  filter->Update();
  vtkNew<vtkImageData> linear;
  linear->ShallowCopy(filter->GetOutput());
  CHECK(linear->GetPointData()->GetNumberOfArrays() == 8);
  CHECK(linear->GetPointData()->GetScalars() != linear->GetPointData()->GetArray("Illumination"));
  for (int j = 0; j < 20; ++j)
  {
    for (int i = 0; i < 30; ++i)
    {
      double length = 0.0;
      for (int c = 0; c < 3; ++c)
      {
        CHECK_NEAR(Value(linear, nullptr, i, j, c),
          Value(linear, "Base", i, j, c) + Value(linear, "Diffuse", i, j, c) +
            Value(linear, "Scatter", i, j, c) + Value(linear, "Specular", i, j, c),
          1e-6);
        length += std::pow(Value(linear, "Normals", i, j, c), 2);
      }
      CHECK_NEAR(length, 1.0, 1e-6);
      CHECK_NEAR(Value(linear, "Base", i, j, 1), 0.75 * 0.1, 1e-6);
      CHECK(
        Value(linear, "Illumination", i, j) >= 0.0f && Value(linear, "Illumination", i, j) <= 1.0f);
      CHECK(Value(linear, "Thickness", i, j) > 0.0f);
    }
  }
  CHECK(
    filter->GetStatistics()->GetEffectNames() == "Illumination Normals Specular ForwardScatter");

  filter->SetOutputScalarTypeToUnsignedChar();
  filter->Update();
  CHECK(filter->GetOutput()->GetScalarType() == VTK_UNSIGNED_CHAR);
  for (int j = 0; j < 20; ++j)
  {
    for (int i = 0; i < 30; ++i)
    {
      double c = std::min(1.0, static_cast<double>(Value(linear, nullptr, i, j, 0)));
      double code = 255.0 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055);
      CHECK_NEAR(Value(filter->GetOutput(), nullptr, i, j, 0), code, 0.5001);
      CHECK(Value(filter->GetOutput(), nullptr, i, j, 3) == 255.0f);
    }
  }
}

void TestMissingData()
{
  // The same holes by value, NaN, infinity and mask give the same picture.
  auto hole = [](int i, int j) { return (i - 12) * (i - 12) + (j - 9) * (j - 9) < 16; };
  auto shade = [](vtkImageData* heights, vtkImageData* mask, bool noData)
  {
    vtkNew<vtkImageReliefShading> filter;
    filter->SetInputData(heights);
    if (mask)
    {
      filter->SetMaskData(mask);
    }
    if (noData)
    {
      filter->SetNoDataValue(-9999.0);
    }
    filter->GenerateIlluminationOn();
    filter->Update();
    auto result = vtkSmartPointer<vtkImageData>::New();
    result->ShallowCopy(filter->GetOutput());
    return result;
  };
  auto byValue = shade(MakeHeights<vtkShortArray>(
                         30, 25, [&](int i, int j) { return hole(i, j) ? -9999 : Hills(2)(i, j); }),
    nullptr, true);
  auto byNaN = shade(
    MakeHeights(30, 25, [&](int i, int j) { return hole(i, j) ? vtkMath::Nan() : Hills(2)(i, j); }),
    nullptr, false);
  auto byInfinity = shade(
    MakeHeights(30, 25, [&](int i, int j) { return hole(i, j) ? vtkMath::Inf() : Hills(2)(i, j); }),
    nullptr, false);
  auto byMask = shade(MakeHeights(30, 25, Hills(2)),
    MakeHeights<vtkUnsignedCharArray>(30, 25, [&](int i, int j) { return hole(i, j) ? 0 : 255; }),
    false);
  vtkDataArray* colors = byValue->GetPointData()->GetScalars();
  CHECK(SameBytes(byNaN->GetPointData()->GetScalars(), colors));
  CHECK(SameBytes(byInfinity->GetPointData()->GetScalars(), colors));
  CHECK(SameBytes(byMask->GetPointData()->GetScalars(), colors));
  for (int j = 0; j < 25; ++j)
  {
    for (int i = 0; i < 30; ++i)
    {
      for (int c = 0; c < 4; ++c)
      {
        CHECK(!hole(i, j) || Value(byMask, nullptr, i, j, c) == 0.0f);
      }
      CHECK(std::isnan(Value(byMask, "Illumination", i, j)) == hole(i, j));
      CHECK(Value(byMask, nullptr, i, j, 3) == (hole(i, j) ? 0.0f : 1.0f));
    }
  }

  // A void in level ground neither casts a shadow nor darkens its rim.
  auto level =
    shade(MakeHeights(30, 25, [&](int i, int j) { return hole(i, j) ? vtkMath::Nan() : 100.0; }),
      nullptr, false);
  for (int j = 0; j < 25; ++j)
  {
    for (int i = 0; i < 30; ++i)
    {
      CHECK(hole(i, j) || std::abs(Value(level, "Illumination", i, j) - std::sqrt(0.5)) < 1e-6);
    }
  }
}

// Heights that single precision cannot hold keep their relief.
void TestLargeOffsets()
{
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(MakeHeights(40, 30, Hills(4)));
  filter->GetScene()->SetTolerance(0.0);
  filter->Update();
  vtkNew<vtkImageData> expected;
  expected->ShallowCopy(filter->GetOutput());
  filter->SetInputData(
    MakeHeights<vtkDoubleArray>(40, 30, [](int i, int j) { return 1e10 + Hills(4)(i, j); }));
  filter->Update();
  CHECK(LargestDifference(filter->GetOutput()->GetPointData()->GetScalars(),
          expected->GetPointData()->GetScalars()) < 2e-6);
}

// The usual tolerance shows in no picture: black shadows are within a step of 255 as well, whatever
// light casts them.
void TestUsualToleranceInPictures()
{
  struct
  {
    const char* name;
    std::function<void(vtkReliefScene*)> light;
  } lightings[] = {
    { "a low sun", [](vtkReliefScene* scene) { scene->AddSun(300.0, 4.0); } },
    { "a sun", [](vtkReliefScene* scene) { scene->AddSun(200.0, 17.0); } },
    { "a sun's disc", [](vtkReliefScene* scene) { scene->AddSun(135.0, 9.0, 8.0); } },
    { "a floor",
      [](vtkReliefScene* scene)
      {
        scene->AddSun(45.0, 12.0);
        scene->GetMaterial()->UseFloorOn();
        scene->GetMaterial()->SetFloorHeight(-40.0);
      } },
    { "a lamp",
      [](vtkReliefScene* scene)
      {
        vtkNew<vtkLight> lamp;
        lamp->PositionalOn();
        lamp->SetPosition(-150.0, -90.0, 60.0);
        scene->AddLight(lamp);
      } },
    { "a sky", [](vtkReliefScene* scene) { scene->SetLightsToSkyDome(); } },
    { "a sun and a sky", [](vtkReliefScene* scene) { scene->SetLightsToSunAndSky(315.0, 12.0); } },
  };
  for (const auto& lighting : lightings)
  {
    vtkNew<vtkImageReliefShading> filter;
    filter->SetInputData(MakeHeights(
      180, 120, [](int i, int j) { return 4.0 * Hills(3)(i, j) + (i > 90 ? 90.0 : 0.0); }));
    filter->SetOutputScalarTypeToUnsignedChar();
    lighting.light(filter->GetScene());
    filter->Update();
    vtkNew<vtkImageData> usual;
    usual->ShallowCopy(filter->GetOutput());
    filter->GetScene()->SetTolerance(0.0);
    filter->Update();
    const double largest = LargestDifference(
      usual->GetPointData()->GetScalars(), filter->GetOutput()->GetPointData()->GetScalars());
    CHECK(largest <= 1.0);
    if (largest > 1.0)
    {
      std::cerr << lighting.name << ": " << largest << " of 255\n";
    }
  }
}
}

int TestImageReliefShading(int, char*[])
{
  TestDefaults();
  TestPyramid();
  TestScalarTypes();
  TestFrames();
  TestLayersAndEncoding();
  TestMissingData();
  TestLargeOffsets();
  TestUsualToleranceInPictures();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
