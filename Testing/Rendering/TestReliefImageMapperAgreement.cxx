// SPDX-License-Identifier: BSD-3-Clause
//
// The mapper's colours are the filter's, in scenes over all features, at every sample. Each host's
// d is within 1e-3 and the tolerance of the exact one (Documentation/Model.md, "Accuracy"), also
// where a ray grazes the surface or runs through a hole's corner: such a cell belongs to the hole,
// however a host rounds. Lights here are no brighter than 1, or count so seldom at one sample that
// this holds for their sums, too.

#include "ReliefMapperTestUtilities.h"

#include "vtkColorTransferFunction.h"
#include "vtkDoubleArray.h"
#include "vtkLight.h"
#include "vtkMatrix3x3.h"
#include "vtkReliefEnvironment.h"
#include "vtkReliefMaterial.h"
#include "vtkShortArray.h"

#include <algorithm>
#include <limits>

namespace
{

int Failures = 0;

struct Case
{
  const char* name;
  std::function<void(vtkReliefScene*)> prepare;
  std::function<vtkSmartPointer<vtkImageData>()> heights;
  std::function<void(vtkOpenGLReliefImageMapper*, vtkImageReliefShading*)> configure;
};

constexpr int Columns = 150;
constexpr int Rows = 110;

vtkSmartPointer<vtkImageData> Terrain()
{
  return MakeHeights(Columns, Rows, Hills(1));
}

// Single samples, a strip and a corner without data.
vtkSmartPointer<vtkImageData> Holes()
{
  return MakeHeights(Columns, Rows,
    [](int i, int j)
    {
      const bool hole = (i * 7 + j * 13) % 101 == 0 || (i > 60 && i < 66 && j > 20) || i + j < 30;
      return hole ? std::numeric_limits<double>::quiet_NaN() : Hills(2)(i, j);
    });
}

// A picture of waves, its components between 0 and a largest value.
template <class ArrayType>
vtkSmartPointer<vtkImageData> MakePicture(int columns, int rows, int components, double largest)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(columns, rows, 1);
  vtkNew<ArrayType> values;
  values->SetNumberOfComponents(components);
  values->SetNumberOfTuples(image->GetNumberOfPoints());
  for (vtkIdType at = 0; at < image->GetNumberOfPoints(); ++at)
  {
    for (int c = 0; c < components; ++c)
    {
      const double wave = std::sin(0.3 * (at % columns) + c) * std::cos(0.2 * (at / columns) - c);
      values->SetComponent(at, c, std::floor(100.0 * (0.5 + 0.5 * wave)) / 100.0 * largest);
    }
  }
  image->GetPointData()->SetScalars(values);
  return image;
}

vtkLight* AddLamp(vtkReliefScene* scene, double x, double y, double z)
{
  vtkNew<vtkLight> lamp;
  lamp->SetLightTypeToSceneLight();
  lamp->PositionalOn();
  lamp->SetPosition(x, y, z);
  scene->AddLight(lamp);
  return lamp;
}

void AddColoredLights(vtkReliefScene* scene, int count)
{
  for (int k = 0; k < count; ++k)
  {
    vtkLight* sun = scene->AddSun(37.0 * k, 10.0 + 70.0 * k / count);
    sun->SetDiffuseColor(0.3 + 0.7 * (k % 3 == 0), 0.3 + 0.7 * (k % 3 == 1), 0.5);
    sun->SetIntensity(1.5 / (1 + k));
  }
}

void MakeShiny(vtkReliefScene* scene, double ks)
{
  vtkReliefMaterial* material = scene->GetMaterial();
  material->SetSpecularCoefficient(ks);
  material->SetSpecularRange(0.2, 0.9);
  material->SetSpecularPower(3.0);
  material->SetSpecularColor(1.0, 0.8, 0.6);
  material->SetDiffuseColor(0.2, 0.6, 0.4);
  material->SetBaseColor(0.05, 0.02, 0.1);
}

void MakeWaxy(vtkReliefScene* scene, double kf)
{
  vtkReliefMaterial* material = scene->GetMaterial();
  material->SetForwardScatterCoefficient(kf);
  material->SetForwardScatterRange(-0.8, 0.9);
  material->SetForwardScatterPower(1.5);
  material->SetUseFloor(true);
  material->SetFloorHeight(-10.0);
}

std::vector<Case> MakeCases()
{
  auto sun = [](vtkReliefScene* scene) { scene->AddSun(300.0, 25.0); };
  auto noChange = [](vtkReliefScene*) {};
  std::vector<Case> cases;
  cases.push_back({ "no lights: the default sun", noChange, Terrain, nullptr });
  cases.push_back({ "a sun", sun, Terrain, nullptr });
  cases.push_back(
    { "a sun along the grid", [](vtkReliefScene* s) { s->AddSun(90.0, 12.0); }, Terrain, nullptr });
  cases.push_back(
    { "the zenith", [](vtkReliefScene* s) { s->AddSun(0.0, 90.0); }, Terrain, nullptr });
  cases.push_back(
    { "the horizon", [](vtkReliefScene* s) { s->AddSun(200.0, 0.0); }, Terrain, nullptr });
  cases.push_back({ "a sun below, with nothing to shine through",
    [](vtkReliefScene* s) { s->AddSun(200.0, -30.0); }, Terrain, nullptr });
  cases.push_back(
    { "a lamp", [](vtkReliefScene* s) { AddLamp(s, 60.0, 40.0, 70.0); }, Terrain, nullptr });
  cases.push_back({ "a lamp inside the relief",
    [](vtkReliefScene* s) { AddLamp(s, 60.0, 40.0, 20.0); }, Terrain, nullptr });
  cases.push_back({ "a lamp far outside",
    [](vtkReliefScene* s) { AddLamp(s, -4000.0, 900.0, 1500.0); }, Terrain, nullptr });
  cases.push_back({ "deep",
    [](vtkReliefScene* s)
    {
      s->AddSun(140.0, 20.0);
      s->GetMaterial()->SetSubsurfaceDepth(8.0);
    },
    Terrain, nullptr });
  cases.push_back({ "depth 0",
    [](vtkReliefScene* s)
    {
      s->AddSun(140.0, 30.0);
      s->GetMaterial()->SetSubsurfaceDepth(0.0);
    },
    Terrain, nullptr });
  cases.push_back({ "depth 0 along the normal",
    [](vtkReliefScene* s)
    {
      s->AddSun(141.0, 30.0);
      s->GetMaterial()->SetSubsurfaceDepth(0.0);
      s->GetMaterial()->SetOffsetModeToSurfaceNormal();
    },
    Terrain, nullptr });
  cases.push_back({ "offset straight down",
    [](vtkReliefScene* s)
    {
      s->AddSun(300.0, 25.0);
      s->GetMaterial()->SetOffsetModeToVertical();
      s->GetMaterial()->SetSubsurfaceDepth(3.0);
    },
    Terrain, nullptr });
  cases.push_back({ "depth 0 straight down",
    [](vtkReliefScene* s)
    {
      AddLamp(s, 90.0, 60.0, 60.0);
      s->GetMaterial()->SetSubsurfaceDepth(0.0);
      s->GetMaterial()->SetOffsetModeToVertical();
    },
    Terrain, nullptr });
  cases.push_back({ "offset along the normal",
    [](vtkReliefScene* s)
    {
      s->AddSun(300.0, 25.0);
      s->GetMaterial()->SetOffsetModeToSurfaceNormal();
      s->GetMaterial()->SetSubsurfaceDepth(3.0);
    },
    Terrain, nullptr });
  cases.push_back({ "exponential",
    [](vtkReliefScene* s)
    {
      AddLamp(s, 20.0, 90.0, 50.0);
      s->GetMaterial()->SetAttenuationToExponential();
      s->GetMaterial()->SetDensity(0.15);
    },
    Terrain, nullptr });
  cases.push_back({ "a floor",
    [](vtkReliefScene* s)
    {
      s->AddSun(300.0, -40.0);
      s->GetMaterial()->SetUseFloor(true);
      s->GetMaterial()->SetFloorHeight(5.0);
      s->GetMaterial()->SetSubsurfaceDepth(6.0);
    },
    Terrain, nullptr });
  cases.push_back({ "lit from behind, scattering forward",
    [](vtkReliefScene* s)
    {
      AddLamp(s, 70.0, 50.0, -40.0);
      MakeWaxy(s, 0.7);
    },
    Terrain, nullptr });
  cases.push_back({ "all scattered forward",
    [](vtkReliefScene* s)
    {
      s->AddSun(30.0, -60.0);
      s->AddSun(30.0, 60.0);
      MakeWaxy(s, 1.0);
    },
    Terrain, nullptr });
  cases.push_back({ "highlights",
    [](vtkReliefScene* s)
    {
      s->AddSun(300.0, 43.0);
      MakeShiny(s, 0.4);
    },
    Terrain, nullptr });
  cases.push_back({ "highlights of a lamp",
    [](vtkReliefScene* s)
    {
      AddLamp(s, 60.0, 40.0, 90.0);
      MakeShiny(s, 0.5);
    },
    Terrain, nullptr });
  cases.push_back({ "nothing but highlights",
    [](vtkReliefScene* s)
    {
      s->AddSun(300.0, 45.0);
      MakeShiny(s, 1.0);
    },
    Terrain, nullptr });
  cases.push_back({ "all effects",
    [](vtkReliefScene* s)
    {
      AddLamp(s, 90.0, 60.0, 60.0);
      s->AddSun(80.0, -20.0);
      s->AddSun(260.0, 30.0);
      MakeWaxy(s, 0.5);
      MakeShiny(s, 0.3);
      s->GetMaterial()->SetOffsetModeToSurfaceNormal();
    },
    Holes, nullptr });
  cases.push_back(
    { "five coloured suns", [](vtkReliefScene* s) { AddColoredLights(s, 5); }, Terrain, nullptr });
  cases.push_back({ "more lights than are kept", [](vtkReliefScene* s) { AddColoredLights(s, 24); },
    Terrain, nullptr });
  cases.push_back({ "more lights than are kept, all effects",
    [](vtkReliefScene* s)
    {
      AddColoredLights(s, 9);
      AddLamp(s, 90.0, 60.0, 60.0);
      MakeWaxy(s, 0.5);
      MakeShiny(s, 0.3);
    },
    Terrain,
    [](vtkOpenGLReliefImageMapper* mapper, vtkImageReliefShading*)
    { mapper->SetCacheMemoryLimit(2 * 4 * Columns * Rows / 1024 + 1); } });
  cases.push_back({ "an environment",
    [](vtkReliefScene* s)
    {
      s->SetLightsToSunAndSky(300.0, 35.0);
      MakeShiny(s, 0.2);
    },
    Holes, nullptr });
  cases.push_back({ "an environment on a sphere",
    [](vtkReliefScene* s)
    {
      s->SetLightsToSkyDome();
      s->GetEnvironment()->SetNumberOfSamples(40);
      s->GetEnvironment()->SetRadius(200.0);
      MakeWaxy(s, 0.4);
    },
    Terrain, nullptr });
  cases.push_back({ "textures and a table",
    [](vtkReliefScene* s)
    {
      s->AddSun(300.0, 35.0);
      MakeShiny(s, 0.3);
      MakeWaxy(s, 0.2);
    },
    Holes,
    [](vtkOpenGLReliefImageMapper* mapper, vtkImageReliefShading* filter)
    {
      vtkNew<vtkColorTransferFunction> table;
      table->AddRGBPoint(0.0, 0.1, 0.5, 0.2);
      table->AddRGBPoint(60.0, 0.9, 0.8, 0.6);
      auto bytes = MakePicture<vtkUnsignedCharArray>(40, 30, 4, 255.0);
      bytes->SetOrigin(20.0, 10.0, 0.0);
      bytes->SetSpacing(2.3, 1.7, 1.0);
      auto floats = MakePicture<vtkFloatArray>(70, 90, 3, 1.0);
      mapper->SetLookupTable(table);
      mapper->SetDiffuseTextureData(bytes);
      mapper->SetBaseTextureData(floats);
      mapper->SetSpecularTextureData(bytes);
      filter->SetLookupTable(table);
      filter->SetDiffuseTextureData(bytes);
      filter->SetBaseTextureData(floats);
      filter->SetSpecularTextureData(bytes);
    } });
  cases.push_back({ "a stretched texture", sun, Terrain,
    [](vtkOpenGLReliefImageMapper* mapper, vtkImageReliefShading* filter)
    {
      auto bytes = MakePicture<vtkUnsignedCharArray>(40, 30, 2, 255.0);
      mapper->SetDiffuseTextureData(bytes);
      mapper->StretchTexturesOn();
      filter->SetDiffuseTextureData(bytes);
      filter->StretchTexturesOn();
    } });
  cases.push_back({ "holes", sun, Holes, nullptr });
  cases.push_back({ "holes and a lamp, along the normal",
    [](vtkReliefScene* s)
    {
      AddLamp(s, 90.0, 60.0, 60.0);
      s->GetMaterial()->SetOffsetModeToSurfaceNormal();
    },
    Holes, nullptr });
  cases.push_back({ "a nodata value", sun, Terrain,
    [](vtkOpenGLReliefImageMapper* mapper, vtkImageReliefShading* filter)
    {
      mapper->SetNoDataValue(31.0);
      filter->SetNoDataValue(31.0);
    } });
  cases.push_back({ "a mask", sun, Terrain,
    [](vtkOpenGLReliefImageMapper* mapper, vtkImageReliefShading* filter)
    {
      auto mask = MakeHeights<vtkUnsignedCharArray>(
        Columns, Rows, [](int i, int j) { return std::hypot(i - 70, j - 50) < 50 ? 255.0 : 0.0; });
      mapper->SetMaskData(mask);
      filter->SetMaskData(mask);
    } });
  cases.push_back({ "combined with slope, in holes",
    [](vtkReliefScene* s)
    {
      s->SetLightsToCombined(300.0, 25.0);
      AddLamp(s, 60.0, 40.0, 70.0)->SetIntensity(0.2);
      MakeWaxy(s, 0.3);
    },
    Holes, nullptr });
  cases.push_back({ "combined with slope, along the normal, shiny",
    [](vtkReliefScene* s)
    {
      s->SetResponseToCombined();
      AddLamp(s, 60.0, 40.0, 70.0);
      MakeShiny(s, 0.4);
      s->GetMaterial()->SetOffsetModeToSurfaceNormal();
    },
    Terrain, nullptr });
  cases.push_back({ "by slope and aspect",
    [](vtkReliefScene* s)
    {
      s->SetLightsToIgor(300.0);
      AddLamp(s, 60.0, 40.0, 70.0)->SetIntensity(0.2);
      MakeShiny(s, 0.2);
    },
    Holes, nullptr });
  cases.push_back({ "combined with slope, under a sky",
    [](vtkReliefScene* s)
    {
      s->SetLightsToSkyDome();
      s->GetEnvironment()->SetNumberOfSamples(32);
      s->SetResponseToCombined();
    },
    Terrain, nullptr });
  cases.push_back({ "a fixed step and a sun",
    [](vtkReliefScene* s)
    {
      s->AddSun(300.0, 25.0);
      s->SetIntegratorToFixedStep();
    },
    Holes, nullptr });
  cases.push_back({ "a fixed step and a lamp",
    [](vtkReliefScene* s)
    {
      AddLamp(s, 60.0, 40.0, 70.0);
      s->SetIntegratorToFixedStep();
      s->SetNumberOfSteps(100);
      s->GetMaterial()->SetOffsetModeToSurfaceNormal();
    },
    Terrain, nullptr });
  cases.push_back({ "spacing, origin, extent and sign",
    [](vtkReliefScene* s)
    {
      s->SetHeightScale(-2.0);
      s->AddSun(300.0, 25.0);
      AddLamp(s, 500100.0, 4000100.0, 300.0);
    },
    []()
    {
      auto image = Terrain();
      image->SetExtent(10, 9 + Columns, -5, Rows - 6, 3, 3);
      image->SetOrigin(500000.0, 4000000.0, 100.0);
      image->SetSpacing(2.0, 3.0, 1.0);
      return image;
    },
    nullptr });
  cases.push_back({ "whole numbers high above 0", sun,
    []()
    {
      return MakeHeights<vtkDoubleArray>(
        Columns, Rows, [](int i, int j) { return 2.0e7 + Hills(4)(i, j); });
    },
    nullptr });
  cases.push_back({ "short integers", sun,
    []() { return MakeHeights<vtkShortArray>(Columns, Rows, Hills(5)); }, nullptr });
  cases.push_back({ "heights in tiles",
    [](vtkReliefScene* s)
    {
      AddLamp(s, 60.0, 40.0, 70.0);
      s->AddSun(300.0, 25.0);
      MakeShiny(s, 0.4);
    },
    Holes,
    [](vtkOpenGLReliefImageMapper* mapper, vtkImageReliefShading*)
    { mapper->SetTextureSizeLimit(150); } });
  cases.push_back(
    { "heights and bounds in tiles", sun, []() { return MakeHeights(600, 300, Hills(6)); },
      [](vtkOpenGLReliefImageMapper* mapper, vtkImageReliefShading*)
      { mapper->SetTextureSizeLimit(600); } });
  cases.push_back(
    { "a single column", sun, []() { return MakeHeights(1, 40, Hills(7)); }, nullptr });
  return cases;
}

void TestCase(const Case& test, int device, double tolerance, double bound)
{
  vtkSmartPointer<vtkImageData> heights = test.heights();
  MapperStage stage(heights);
  stage.window->SetSize(std::max(heights->GetDimensions()[0], 120), heights->GetDimensions()[1]);
  stage.mapper->SetTracing(device);
  stage.Scene()->SetTolerance(tolerance);
  test.prepare(stage.Scene());
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(heights);
  filter->SetScene(stage.Scene());
  if (test.configure)
  {
    test.configure(stage.mapper, filter);
  }
  MessageKeeper warnings(filter); // of a single column
  filter->Update();
  const double* spacing = heights->GetSpacing();
  if (spacing[0] != spacing[1])
  {
    // More than a pixel for a sample along one axis.
    stage.renderer->GetActiveCamera()->SetParallelScale(
      heights->GetDimensions()[1] * std::min(spacing[0], spacing[1]) / 2.0);
    stage.window->SetSize(2 * heights->GetDimensions()[0], 2 * heights->GetDimensions()[1]);
    stage.LookAtAll();
  }
  CHECK(stage.Render());
  CHECK(stage.mapper->GetConverged());
  const Agreement agreement = CompareColors(filter->GetOutput(), stage.Shading(), bound);
  std::cout << test.name << ", device " << device << ", tolerance " << tolerance << ": "
            << agreement.largest << " at most, " << 100.0 * agreement.shareBeyond << " % beyond "
            << bound << ", mean " << agreement.mean << std::endl;
  CHECK(agreement.shareBeyond <= 1.0e-3);
  if (device == vtkReliefImageMapper::TraceOnProcessor)
  {
    // The same d, summed in another precision. Angles near 0 have half the digits of their cosines.
    const bool angles = stage.Scene()->GetResponse() != vtkReliefScene::Illumination;
    const Agreement close =
      CompareColors(filter->GetOutput(), stage.Shading(), angles ? 5.0e-5 : 1.0e-5);
    CHECK(close.shareBeyond == 0.0);
  }
  // Fixed steps count points. One on the border between two samples may fall to either, and the
  // first that does takes d = 1 / (1 + n) from 1 to 1/2.
  const bool counts = stage.Scene()->GetIntegrator() == vtkReliefScene::FixedStep;
  CHECK(agreement.largest <= (counts ? 0.5 + 1.0e-6 : bound));
}

}

int TestReliefImageMapperAgreement(int, char*[])
{
  for (const Case& test : MakeCases())
  {
    for (const int device : TracingDevices)
    {
      TestCase(test, device, 0.0, 2.0e-3);
      TestCase(test, device, 0.002, 6.0e-3);
    }
  }
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
