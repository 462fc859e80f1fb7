// SPDX-License-Identifier: BSD-3-Clause
// Textures of vtkImageReliefShading: where they lie, what they say, what they cost.
#include "vtkImageReliefShading.h"

#include "vtkLight.h"
#include "vtkLookupTable.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkReliefStatistics.h"
#include "vtkSMPTools.h"
#include "vtkTrivialProducer.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedShortArray.h"

#include "ReliefTextureTestUtilities.h"

#include <algorithm>
#include <sstream>

namespace
{
int Failures = 0;

// Linear in the world, for which interpolation is exact.
Color RampAt(double x, double y)
{
  return { 2.0 + 0.01 * x, 3.0 + 0.02 * y, 2.0 + 0.01 * x + 0.03 * y, 1.0 };
}

vtkSmartPointer<vtkImageData> MakeRamp(
  int columns, int rows, double originX, double originY, double spacingX, double spacingY)
{
  auto image = MakeTexture<vtkFloatArray>(columns, rows, 3,
    [&](int i, int j) { return RampAt(originX + i * spacingX, originY + j * spacingY); });
  image->SetOrigin(originX, originY, 0.0);
  image->SetSpacing(spacingX, spacingY, 1.0);
  return image;
}

// Shows the base colour alone, and so a base texture as it is.
void ShowBase(vtkImageReliefShading* filter, vtkImageData* heights)
{
  filter->SetInputData(heights);
  filter->GetScene()->GetMaterial()->SetDiffuseColor(0.0, 0.0, 0.0);
  filter->GetScene()->GetMaterial()->SetBaseColor(0.125, 0.25, 0.5);
}

void SetUpEffects(vtkImageReliefShading* filter)
{
  vtkReliefMaterial* material = filter->GetScene()->GetMaterial();
  material->SetBaseColor(0.05, 0.1, 0.0);
  material->SetDiffuseColor(0.8, 0.5, 0.3);
  material->SetSpecularColor(0.3, 0.6, 0.9);
  material->SetSpecularCoefficient(0.25);
  material->SetForwardScatterCoefficient(0.5);
  material->SetForwardScatterRange(-1.0, 1.0);
  filter->GetScene()->AddSun(40.0, 30.0)->SetDiffuseColor(1.0, 0.9, 0.7);
  filter->GetScene()->AddSun(200.0, 60.0)->SetIntensity(0.5);
  vtkNew<vtkLight> lamp;
  lamp->PositionalOn();
  lamp->SetPosition(20.0, 10.0, 80.0);
  filter->GetScene()->AddLight(lamp);
  filter->GenerateBaseOn();
  filter->GenerateDiffuseOn();
  filter->GenerateScatterOn();
  filter->GenerateSpecularOn();
}

// Each port colours its own terms, and layers add up to the colour.
void TestPorts()
{
  auto color = [](int i, int j) {
    return Color{ 0.1 + 0.02 * i, 0.9 - 0.03 * j, 0.01 * (i + j), 1.0 };
  };
  auto texture = MakeTexture<vtkFloatArray>(30, 20, 3, color);
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(MakeHeights(30, 20, Hills(8)));
  SetUpEffects(filter);
  auto plain = Update(filter);
  struct
  {
    void (vtkImageReliefShading::*set)(vtkDataObject*);
    std::vector<const char*> layers;
    double constant[3];
    const char* effect;
  } ports[] = { { &vtkImageReliefShading::SetDiffuseTextureData, { "Diffuse", "Scatter" },
                  { 0.8, 0.5, 0.3 }, "DiffuseTexture" },
    { &vtkImageReliefShading::SetBaseTextureData, { "Base" }, { 0.05, 0.1, 0.0 }, "BaseTexture" },
    { &vtkImageReliefShading::SetSpecularTextureData, { "Specular" }, { 0.3, 0.6, 0.9 },
      "SpecularTexture" } };
  for (const auto& port : ports)
  {
    (filter->*port.set)(texture);
    auto textured = Update(filter);
    CHECK(filter->GetStatistics()->GetEffectNames() ==
      std::string("Illumination Normals Specular ForwardScatter ") + port.effect);
    double largest = 0.0;
    for (int j = 0; j < 20; ++j)
    {
      for (int i = 0; i < 30; ++i)
      {
        for (int c = 0; c < 3; ++c)
        {
          double sum = 0.0;
          for (const char* layer : { "Base", "Diffuse", "Scatter", "Specular" })
          {
            const double value = Value(textured, layer, i, j, c);
            const double before = Value(plain, layer, i, j, c);
            sum += value;
            const bool touched = std::find(port.layers.begin(), port.layers.end(),
                                   std::string(layer)) != port.layers.end();
            if (!touched)
            {
              CHECK(value == before);
            }
            else if (port.constant[c] > 0.0)
            {
              CHECK_NEAR(value, before / port.constant[c] * color(i, j)[c], 2e-6);
              largest = std::max(largest, value);
            }
          }
          CHECK_NEAR(Value(textured, nullptr, i, j, c), sum, 1e-6);
        }
      }
    }
    CHECK(largest > 0.01);
    (filter->*port.set)(nullptr);
  }
  // Without textures everything is as before.
  CHECK(
    SameBytes(Update(filter)->GetPointData()->GetScalars(), plain->GetPointData()->GetScalars()));
}

template <class ArrayType>
void TestType(int components, double most, bool encoded)
{
  auto code = [&](int i, int j)
  {
    // Whole codes, so that integers hold them.
    return Color{ std::floor(255.0 * (i % 9) / 9.0) / 255.0, std::floor(255.0 * j / 7.0) / 255.0,
      0.2, (i + j) % 6 / 5.0 };
  };
  vtkNew<vtkImageReliefShading> filter;
  ShowBase(filter, MakeHeights(18, 7, Hills(2)));
  filter->SetBaseTextureData(MakeTexture<ArrayType>(18, 7, components, code, most));
  auto output = Update(filter);
  const double* base = filter->GetScene()->GetMaterial()->GetBaseColor();
  for (int j = 0; j < 7; ++j)
  {
    for (int i = 0; i < 18; ++i)
    {
      const Color texel = code(i, j);
      const double alpha = components == 2 ? texel[1] : components == 4 ? texel[3] : 1.0;
      for (int c = 0; c < 3; ++c)
      {
        const double value = texel[components < 3 ? 0 : c];
        CHECK_NEAR(Value(output, nullptr, i, j, c),
          alpha * (encoded ? Decode(value) : value) + (1.0 - alpha) * base[c], 1e-6);
      }
    }
  }
}

void TestTypesAndComponents()
{
  for (int components = 1; components <= 4; ++components)
  {
    TestType<vtkUnsignedCharArray>(components, 255.0, true);
    TestType<vtkUnsignedShortArray>(components, 65535.0, true);
    TestType<vtkFloatArray>(components, 1.0, false);
    TestType<vtkDoubleArray>(components, 1.0, false);
  }
}

// Every sample takes the colour of its own place in the world, whatever frames heights and texture
// have. Checked with colours that are linear in the world, for which interpolation is exact.
void TestPlaces()
{
  auto check = [](vtkImageData* heights, vtkImageData* texture, double bound)
  {
    vtkNew<vtkImageReliefShading> filter;
    ShowBase(filter, heights);
    filter->SetBaseTextureData(texture);
    auto output = Update(filter);
    const int* extent = output->GetExtent();
    int inside = 0;
    for (int j = extent[2]; j <= extent[3]; ++j)
    {
      for (int i = extent[0]; i <= extent[1]; ++i)
      {
        double world[3];
        double index[3];
        output->TransformIndexToPhysicalPoint(i, j, extent[4], world);
        texture->TransformPhysicalPointToContinuousIndex(world, index);
        const int* t = texture->GetExtent();
        const bool within =
          index[0] >= t[0] && index[0] <= t[1] && index[1] >= t[2] && index[1] <= t[3];
        const bool beyond = index[0] < t[0] - 0.501 || index[0] > t[1] + 0.501 ||
          index[1] < t[2] - 0.501 || index[1] > t[3] + 0.501;
        for (int c = 0; c < 3; ++c)
        {
          const float value = Value(output, nullptr, i, j, c);
          if (within)
          {
            CHECK_NEAR(value, RampAt(world[0], world[1])[c], bound);
            ++inside;
          }
          else if (beyond)
          {
            CHECK(value == 0.125f * (1 << c));
          }
        }
      }
    }
    return inside / 3;
  };
  auto heights = MakeHeights(25, 20, Hills(3));
  heights->SetSpacing(2.0, 3.0, 1.0);
  // Of another spacing, around, within and beside the heights.
  CHECK(check(heights, MakeRamp(40, 50, -10.0, -5.0, 1.7, 1.6), 4e-6) == 500);
  CHECK(check(heights, MakeRamp(10, 9, 11.0, 12.5, 1.7, 1.6), 4e-6) > 10);
  CHECK(check(heights, MakeRamp(10, 9, 41.0, -12.5, 3.0, 7.0), 4e-6) > 10);
  // A map's coordinates.
  auto onMap = MakeHeights(25, 20, Hills(3));
  onMap->SetSpacing(0.5, 0.5, 1.0);
  onMap->SetOrigin(500000.25, 4600000.25, 0.0);
  CHECK(check(onMap, MakeRamp(30, 30, 500002.0, 4600001.0, 0.2, 0.3), 0.02) > 50);
  // Rows from north to south, in either.
  auto flipped = MakeHeights(25, 20, Hills(3));
  flipped->SetSpacing(2.0, -3.0, 1.0);
  flipped->SetOrigin(0.0, 57.0, 0.0);
  CHECK(check(flipped, MakeRamp(40, 50, -10.0, -5.0, 1.7, 1.6), 4e-6) == 500);
  CHECK(check(heights, MakeRamp(40, 50, -10.0, 74.0, 1.7, -1.6), 4e-6) == 500);
  // Extents that start elsewhere.
  auto shifted = MakeHeights(25, 20, Hills(3));
  shifted->SetExtent(-5, 19, 7, 26, 2, 2);
  shifted->SetSpacing(2.0, 3.0, 1.0);
  CHECK(check(shifted, MakeRamp(40, 50, -10.5, 15.0, 1.7, 1.6), 4e-6) == 500);
  auto cut = MakeRamp(40, 50, -10.0 - 3 * 1.7, -5.0 + 2 * 1.6, 1.7, 1.6);
  cut->SetExtent(3, 42, -2, 47, 0, 0);
  cut->SetOrigin(-10.0 - 6 * 1.7, -5.0 + 4 * 1.6, 0.0);
  CHECK(check(heights, cut, 4e-6) == 500);
  // Turned, mirrored, both.
  const double c = std::cos(0.3);
  const double s = std::sin(0.3);
  auto turned = MakeHeights(25, 20, Hills(3));
  turned->SetDirectionMatrix(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0);
  turned->SetOrigin(20.0, 10.0, 5.0);
  CHECK(check(turned, MakeRamp(40, 50, -10.0, -5.0, 1.7, 1.6), 4e-6) == 500);
  auto turnedTexture = MakeTexture<vtkDoubleArray>(30, 40, 3,
    [&](int i, int j)
    { return RampAt(1.0 - s * 2.0 * j + c * 1.5 * i, -12.0 + c * 2.0 * j + s * 1.5 * i); });
  turnedTexture->SetSpacing(1.5, 2.0, 1.0);
  turnedTexture->SetOrigin(1.0, -12.0, -7.0);
  turnedTexture->SetDirectionMatrix(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0);
  CHECK(check(heights, turnedTexture, 4e-6) > 300);
  CHECK(check(turned, turnedTexture, 4e-6) > 300);
  auto mirrored = MakeHeights(25, 20, Hills(3));
  mirrored->SetDirectionMatrix(-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0);
  mirrored->SetOrigin(30.0, 0.0, 0.0);
  CHECK(check(mirrored, MakeRamp(40, 50, -10.0, -5.0, 1.7, 1.6), 4e-6) == 500);
}

// The same frame, however awkward, gives every sample its own texel to the last bit.
void TestSameFrame()
{
  auto color = [](int i, int j) {
    return Color{ (i * 37 + j * 101) % 256 / 255.0, (i * j) % 256 / 255.0, i % 2 * 1.0, 1.0 };
  };
  auto place = [](vtkImageData* image)
  {
    const double c = std::cos(0.7);
    const double s = std::sin(0.7);
    image->SetDirectionMatrix(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0);
    image->SetSpacing(0.1, -0.7, 1.0);
    image->SetOrigin(512345.6, 4.6e6, 12.3);
  };
  auto heights = MakeHeights(60, 50, Hills(4));
  auto texture = MakeTexture<vtkUnsignedCharArray>(60, 50, 3, color, 255.0);
  vtkNew<vtkImageReliefShading> filter;
  ShowBase(filter, heights);
  filter->SetBaseTextureData(texture);
  filter->SetOutputScalarTypeToUnsignedChar();
  filter->GenerateBaseOn();
  auto expected = Update(filter);
  place(heights);
  place(texture);
  filter->Modified();
  auto placed = Update(filter);
  CHECK(SameBytes(
    placed->GetPointData()->GetArray("Base"), expected->GetPointData()->GetArray("Base")));
  for (int j = 0; j < 50; ++j)
  {
    for (int i = 0; i < 60; ++i)
    {
      for (int c = 0; c < 3; ++c)
      {
        CHECK(Value(placed, nullptr, i, j, c) == std::round(255.0 * color(i, j)[c]));
      }
    }
  }
}

void TestStretch()
{
  // Twice and a third as fine: areas match, so each sample takes the mean of two texels, or one.
  auto texture = MakeTexture<vtkFloatArray>(20, 4, 1,
    [](int i, int j) {
      return Color{ 1.0 * i + 100.0 * j, 0.0, 0.0, 0.0 };
    });
  texture->SetOrigin(1e6, 1e6, 1e6);
  texture->SetSpacing(0.001, 0.001, 1.0);
  vtkNew<vtkImageReliefShading> filter;
  ShowBase(filter, MakeHeights(10, 12, Hills(1)));
  filter->SetBaseTextureData(texture);
  filter->StretchTexturesOn();
  CHECK(filter->GetStretchTextures());
  auto output = Update(filter);
  for (int j = 0; j < 12; ++j)
  {
    for (int i = 0; i < 10; ++i)
    {
      const double row = std::clamp((j + 0.5) / 3.0 - 0.5, 0.0, 3.0);
      CHECK_NEAR(Value(output, nullptr, i, j), 2.0 * i + 0.5 + 100.0 * row, 2e-4);
    }
  }
  // A piece of the output is the same as in the whole.
  int extent[6] = { 3, 7, 5, 9, 0, 0 };
  filter->UpdateExtent(extent);
  for (int j = 5; j <= 9; ++j)
  {
    for (int i = 3; i <= 7; ++i)
    {
      CHECK(Value(filter->GetOutput(), nullptr, i, j) == Value(output, nullptr, i, j));
    }
  }
}

// A distributed input is a piece of its whole extent; the texture is stretched over the whole.
void TestDistributed()
{
  auto whole = MakeHeights(16, 12, Hills(1));
  auto texture = MakeTexture<vtkFloatArray>(40, 30, 1,
    [](int i, int j) {
      return Color{ 1.0 * i + 100.0 * j, 0.0, 0.0, 0.0 };
    });
  vtkNew<vtkImageReliefShading> filter;
  ShowBase(filter, whole);
  filter->SetBaseTextureData(texture);
  filter->StretchTexturesOn();
  auto expected = Update(filter);
  vtkNew<vtkImageData> piece;
  piece->SetExtent(8, 15, 6, 11, 0, 0);
  piece->AllocateScalars(VTK_FLOAT, 1);
  piece->GetPointData()->GetScalars()->Fill(5.0);
  vtkNew<vtkTrivialProducer> producer;
  producer->SetOutput(piece);
  producer->SetWholeExtent(0, 15, 0, 11, 0, 0);
  filter->SetInputConnection(producer->GetOutputPort());
  filter->Update();
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 48);
  for (int j = 6; j < 12; ++j)
  {
    for (int i = 8; i < 16; ++i)
    {
      CHECK_NEAR(Value(filter->GetOutput(), nullptr, i, j), Value(expected, nullptr, i, j), 1e-4);
    }
  }
}

void TestThreadsAndPieces()
{
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(MakeHeights(131, 97, Hills(6)));
  SetUpEffects(filter);
  auto texture = MakeRamp(50, 40, -7.0, -9.0, 3.1, 2.9);
  filter->SetDiffuseTextureData(texture);
  filter->SetBaseTextureData(texture);
  filter->SetSpecularTextureData(texture);
  vtkNew<vtkLookupTable> table;
  table->SetRange(0.0, 60.0);
  filter->SetLookupTable(table);
  vtkSMPTools::SetBackend("STDThread");
  vtkNew<vtkImageData> one;
  for (int threads : { 1, 3 })
  {
    vtkSMPTools::Initialize(threads);
    filter->ReleaseCache();
    filter->Modified();
    filter->Update();
    if (threads == 1)
    {
      one->DeepCopy(filter->GetOutput());
    }
    for (int array = 0; array < one->GetPointData()->GetNumberOfArrays(); ++array)
    {
      CHECK(SameBytes(one->GetPointData()->GetArray(array),
        filter->GetOutput()->GetPointData()->GetArray(array)));
    }
  }
  vtkSMPTools::Initialize(0);
  int extent[6] = { 40, 90, 33, 70, 0, 0 };
  filter->Modified();
  filter->UpdateExtent(extent);
  vtkImageData* piece = filter->GetOutput();
  for (int array = 0; array < one->GetPointData()->GetNumberOfArrays(); ++array)
  {
    const char* name = one->GetPointData()->GetArrayName(array);
    for (int j = 33; j <= 70; ++j)
    {
      for (int i = 40; i <= 90; ++i)
      {
        for (int c = 0; c < 3; ++c)
        {
          CHECK(Value(piece, name, i, j, c) == Value(one, name, i, j, c));
        }
      }
    }
  }
}

// Colours change no ray: only what they are multiplied with is taken from the last update.
void TestReuse()
{
  auto texture = MakeTexture<vtkFloatArray>(40, 30, 3,
    [](int i, int j) {
      return Color{ 0.02 * i, 0.03 * j, 0.5, 1.0 };
    });
  auto heights = MakeHeights(40, 30, Hills(5));
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(heights);
  vtkReliefMaterial* material = filter->GetScene()->GetMaterial();
  vtkReliefStatistics* statistics = filter->GetStatistics();
  filter->GetScene()->AddSun(300.0, 30.0);
  filter->Update();
  CHECK(statistics->GetRaysTraced() == 1200);
  auto reused = [&]()
  {
    const vtkMTimeType before = filter->GetOutput()->GetMTime();
    filter->Update();
    return filter->GetOutput()->GetMTime() > before && statistics->GetRaysTraced() == 0 &&
      statistics->GetLightsReused() == 1;
  };
  filter->SetDiffuseTextureData(texture);
  CHECK(reused());
  CHECK_NEAR(
    Value(filter->GetOutput(), nullptr, 10, 10, 0) / Value(filter->GetOutput(), nullptr, 10, 10, 2),
    0.4, 1e-6);
  texture->GetPointData()->GetScalars()->SetTuple3(10 * 40 + 10, 1.0, 0.0, 0.5);
  texture->GetPointData()->GetScalars()->Modified();
  texture->Modified();
  CHECK(reused());
  CHECK_NEAR(
    Value(filter->GetOutput(), nullptr, 10, 10, 0) / Value(filter->GetOutput(), nullptr, 10, 10, 2),
    2.0, 1e-6);
  filter->StretchTexturesOn();
  CHECK(reused());
  vtkNew<vtkLookupTable> table;
  table->SetRange(0.0, 60.0);
  filter->SetLookupTable(table);
  CHECK(reused());
  filter->SetDiffuseTextureData(nullptr);
  CHECK(reused());
  table->SetHueRange(0.0, 0.1);
  CHECK(reused());
  table->SetTableValue(3, 1.0, 0.0, 1.0, 1.0);
  CHECK(reused());
  vtkMTimeType time = filter->GetMTime();
  CHECK(filter->GetMTime() == time);
  const vtkMTimeType before = filter->GetOutput()->GetMTime();
  filter->Update();
  CHECK(filter->GetOutput()->GetMTime() == before); // nothing changed, nothing done
  filter->SetLookupTable(nullptr);
  CHECK(reused());
  CHECK(filter->GetLookupTable() == nullptr);

  // Only what shows is read.
  filter->SetDiffuseTextureData(texture);
  filter->SetBaseTextureData(texture);
  filter->SetSpecularTextureData(texture);
  filter->SetLookupTable(table);
  filter->Update();
  CHECK(statistics->GetEffectNames() == "Illumination BaseTexture DiffuseTexture");
  material->SetSpecularCoefficient(1.0);
  filter->Update();
  CHECK(statistics->GetEffectNames() == "Normals Specular SpecularTexture");
  material->SetSpecularCoefficient(0.0);
  filter->SetBaseTextureData(nullptr);
  filter->SetSpecularTextureData(nullptr);
  filter->SetDiffuseTextureData(nullptr);
  material->SetDiffuseColor(0.0, 0.0, 0.0); // a table shows on a black material
  filter->Update();
  CHECK(statistics->GetEffectNames() == "Illumination DiffuseTexture");
  filter->SetLookupTable(nullptr);
  filter->Update();
  CHECK(statistics->GetEffectNames().empty());
}

void TestPrint()
{
  vtkNew<vtkImageReliefShading> filter;
  CHECK(!filter->GetStretchTextures() && !filter->GetLookupTable());
  auto print = [&]()
  {
    std::ostringstream text;
    filter->Print(text);
    return text.str();
  };
  CHECK(print().find("LookupTable: (none)") != std::string::npos);
  CHECK(print().find("StretchTextures: Off") != std::string::npos);
  vtkNew<vtkLookupTable> table;
  filter->SetLookupTable(table);
  CHECK(print().find("TableRange") != std::string::npos);
}
}

int TestReliefTextures(int, char*[])
{
  TestPorts();
  TestTypesAndComponents();
  TestPlaces();
  TestSameFrame();
  TestStretch();
  TestDistributed();
  TestThreadsAndPieces();
  TestReuse();
  TestPrint();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
