// SPDX-License-Identifier: BSD-3-Clause
// Threads and pieces give the same bytes; statistics; progress, abort and memory.
#include "vtkImageReliefShading.h"

#include "vtkExtentTranslator.h"
#include "vtkLight.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkReliefStatistics.h"
#include "vtkSMPTools.h"
#include "vtkShortArray.h"
#include "vtkUnsignedCharArray.h"

#include "ReliefTestUtilities.h"

#include <fstream>
#include <random>

namespace
{
int Failures = 0;

// A scene that uses every effect, with holes. With the vertical offset suns are swept in lockstep,
// with the other they are traced ray by ray.
void SetUp(vtkImageReliefShading* filter, int offsetMode)
{
  filter->SetInputData(MakeHeights(131, 97, Hills(6)));
  filter->SetMaskData(MakeHeights<vtkUnsignedCharArray>(
    131, 97, [](int i, int j) { return (i * i + 3 * j) % 101 == 0 ? 0 : 1; }));
  vtkReliefMaterial* material = filter->GetScene()->GetMaterial();
  material->SetSpecularCoefficient(0.3);
  material->SetForwardScatterCoefficient(0.2);
  material->SetForwardScatterRange(-1.0, 1.0);
  material->SetOffsetMode(offsetMode);
  filter->GetScene()->AddSun(290.0, 15.0);
  vtkNew<vtkLight> lamp;
  lamp->PositionalOn();
  lamp->SetPosition(60.0, 50.0, 80.0);
  filter->GetScene()->AddLight(lamp);
  filter->GenerateIlluminationOn();
  filter->GenerateThicknessOn();
  filter->GenerateNormalsOn();
}

void TestThreads(int offsetMode)
{
  vtkNew<vtkImageReliefShading> filter;
  SetUp(filter, offsetMode);
  vtkNew<vtkImageData> one;
  // TBB takes no more threads than it started with.
  vtkSMPTools::SetBackend("STDThread");
  for (int threads : { 1, 2, 7 })
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
    CHECK(filter->GetStatistics()->GetLightsTraced() == 2);
    CHECK(filter->GetStatistics()->GetRaysTraced() > 131 * 97);
  }
  vtkSMPTools::Initialize(0);
}

void TestPieces(int offsetMode)
{
  vtkNew<vtkImageReliefShading> filter;
  SetUp(filter, offsetMode);
  filter->Update();
  vtkNew<vtkImageData> whole;
  whole->DeepCopy(filter->GetOutput());
  const unsigned int seed = 20;
  std::mt19937 random(seed);
  for (int round = 0; round < 20; ++round)
  {
    int extent[6] = { 0, 0, 0, 0, 0, 0 };
    extent[0] = static_cast<int>(random() % 131);
    extent[1] = extent[0] + static_cast<int>(random() % (131 - extent[0]));
    extent[2] = static_cast<int>(random() % 97);
    extent[3] = extent[2] + static_cast<int>(random() % (97 - extent[2]));
    filter->Modified();
    filter->UpdateExtent(extent);
    vtkImageData* piece = filter->GetOutput();
    CHECK(std::equal(extent, extent + 6, piece->GetExtent()));
    for (int array = 0; array < whole->GetPointData()->GetNumberOfArrays(); ++array)
    {
      vtkDataArray* a = whole->GetPointData()->GetArray(array);
      vtkDataArray* b = piece->GetPointData()->GetArray(array);
      const std::size_t tuple =
        static_cast<std::size_t>(a->GetNumberOfComponents()) * a->GetDataTypeSize();
      const std::size_t width = extent[1] - extent[0] + 1;
      for (int j = extent[2]; j <= extent[3]; ++j)
      {
        const char* rowA = static_cast<const char*>(a->GetVoidPointer(0)) +
          (static_cast<std::size_t>(j) * 131 + extent[0]) * tuple;
        const char* rowB =
          static_cast<const char*>(b->GetVoidPointer(0)) + (j - extent[2]) * width * tuple;
        if (std::memcmp(rowA, rowB, width * tuple) != 0)
        {
          std::cout << "seed " << seed << ", round " << round << ": row " << j << " differs in "
                    << a->GetName() << std::endl;
          ++Failures;
        }
      }
    }
  }
}

// The statistics say that only what a scene calls for is done.
void TestEffects()
{
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(MakeHeights(20, 20, Hills(1)));
  vtkReliefScene* scene = filter->GetScene();
  vtkReliefMaterial* material = scene->GetMaterial();
  vtkReliefStatistics* statistics = filter->GetStatistics();

  vtkLight* sun = scene->AddSun(315.0, 45.0);
  filter->Update();
  CHECK(statistics->GetRaysTraced() == 400 && statistics->GetLightsTraced() == 1);
  CHECK(statistics->GetCellsVisited() >= 400 && statistics->GetLightsReused() == 0);
  CHECK(statistics->GetEffectNames() == "Illumination");

  material->SetSpecularCoefficient(1.0);
  filter->Update();
  CHECK(statistics->GetRaysTraced() == 0 && statistics->GetLightsTraced() == 0);
  CHECK(statistics->GetEffectNames() == "Normals Specular");
  filter->GenerateIlluminationOn();
  filter->Update();
  CHECK(statistics->GetRaysTraced() == 400);
  filter->GenerateIlluminationOff();
  material->SetSpecularColor(0.0, 0.0, 0.0);
  filter->Update();
  CHECK(statistics->GetRaysTraced() == 0 && statistics->GetEffectNames().empty());

  material->SetSpecularCoefficient(0.0);
  sun->SetDiffuseColor(0.0, 0.0, 0.0);
  filter->Update();
  CHECK(statistics->GetRaysTraced() == 0 && statistics->GetEffectNames().empty());
  sun->SetDiffuseColor(1.0, 1.0, 1.0);
  sun->SetIntensity(0.0);
  filter->Update();
  CHECK(statistics->GetRaysTraced() == 0);
  sun->SetIntensity(1.0);
  material->SetDiffuseColor(0.0, 0.0, 0.0);
  filter->Update();
  CHECK(statistics->GetRaysTraced() == 0);
  material->SetDiffuseColor(1.0, 1.0, 1.0);

  // Below the horizon, without a floor, light cannot get through.
  vtkLight* night = scene->AddSun(0.0, -10.0);
  filter->Update();
  CHECK(statistics->GetLightsTraced() == 1);
  material->UseFloorOn();
  filter->Update();
  CHECK(statistics->GetLightsTraced() == 2);
  material->UseFloorOff();
  scene->RemoveLight(night);

  // Light from in front is not scattered forward.
  material->SetForwardScatterCoefficient(1.0);
  filter->Update();
  CHECK(statistics->GetRaysTraced() == 0);
  material->SetForwardScatterRange(-1.0, 1.0);
  filter->Update();
  CHECK(statistics->GetRaysTraced() == 400);
  CHECK(statistics->GetEffectNames() == "Illumination ForwardScatter");

  sun->SetSwitch(0);
  material->SetBaseColor(0.5, 0.25, 0.0);
  filter->Update();
  CHECK(statistics->GetRaysTraced() == 0);
  CHECK(Value(filter->GetOutput(), nullptr, 3, 3, 1) == 0.25f);
}

// What no change touches is not computed again, and is the same as if it were.
void TestReuse()
{
  auto heights = MakeHeights(90, 70, Hills(9));
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(heights);
  vtkReliefScene* scene = filter->GetScene();
  vtkReliefMaterial* material = scene->GetMaterial();
  vtkReliefStatistics* statistics = filter->GetStatistics();
  vtkLight* first = scene->AddSun(300.0, 20.0);
  vtkLight* second = scene->AddSun(100.0, 50.0);
  vtkNew<vtkLight> lamp;
  lamp->PositionalOn();
  lamp->SetPosition(40.0, 30.0, 90.0);
  scene->AddLight(lamp);

  // Updates, and compares with a filter that has nothing to reuse.
  auto check = [&](int traced, int reused)
  {
    filter->Update();
    vtkNew<vtkImageReliefShading> fresh;
    fresh->SetInputData(heights);
    fresh->SetScene(scene);
    fresh->SetCacheMemoryLimit(0);
    fresh->SetGenerateThickness(filter->GetGenerateThickness());
    fresh->Update();
    bool same = SameBytes(filter->GetOutput()->GetPointData()->GetScalars(),
      fresh->GetOutput()->GetPointData()->GetScalars());
    bool counts =
      statistics->GetLightsTraced() == traced && statistics->GetLightsReused() == reused;
    if (!same || !counts)
    {
      std::cout << "same " << same << ", traced " << statistics->GetLightsTraced() << ", reused "
                << statistics->GetLightsReused() << std::endl;
    }
    return same && counts && fresh->GetStatistics()->GetLightsReused() == 0;
  };
  CHECK(check(3, 0));
  material->SetDiffuseColor(0.9, 0.7, 0.5);
  CHECK(check(0, 3));
  CHECK(statistics->GetRaysTraced() == 0 && statistics->GetCellsVisited() == 0);
  material->SetSpecularCoefficient(0.4);
  material->SetForwardScatterCoefficient(0.3);
  material->SetSpecularPower(3.0);
  first->SetIntensity(0.5);
  second->SetDiffuseColor(1.0, 0.0, 0.0);
  CHECK(check(0, 3));
  lamp->SetPosition(41.0, 30.0, 90.0);
  CHECK(check(1, 2));
  first->SetPosition(0.0, 1.0, 1.0);
  CHECK(check(1, 2));
  scene->RemoveLight(second);
  CHECK(check(0, 2));
  filter->GenerateNormalsOn();
  CHECK(check(0, 2));
  filter->GenerateThicknessOn(); // the first light's, to the last digit
  CHECK(check(1, 1));
  material->SetBaseColor(0.1, 0.1, 0.1);
  CHECK(check(0, 2));
  filter->GenerateThicknessOff();
  CHECK(check(1, 1));
  material->SetSubsurfaceDepth(2.0);
  CHECK(check(2, 0));
  material->SetOffsetModeToSurfaceNormal();
  CHECK(check(2, 0));
  material->SetAttenuationToExponential();
  CHECK(check(2, 0));
  material->UseFloorOn();
  CHECK(check(2, 0));
  scene->SetTolerance(0.01);
  CHECK(check(2, 0));
  scene->SetHeightScale(1.5);
  CHECK(check(2, 0));
  scene->SetIntegratorToFixedStep();
  CHECK(check(2, 0));
  scene->SetNumberOfSteps(32);
  CHECK(check(2, 0));
  scene->SetIntegratorToExact();
  CHECK(check(2, 0));
  heights->GetPointData()->GetScalars()->SetTuple1(2000, 99.0);
  heights->Modified();
  CHECK(check(2, 0));
  filter->SetNoDataValue(99.0);
  filter->Update();
  CHECK(statistics->GetLightsTraced() == 2);
  filter->UseNoDataValueOff();
  CHECK(check(2, 0));
  // Room for one light, but not for two.
  filter->SetCacheMemoryLimit(
    static_cast<unsigned long>(4 * heights->GetNumberOfPoints() / 1024 + 1));
  material->SetBaseColor(0.2, 0.1, 0.1);
  CHECK(check(0, 2));
  material->SetBaseColor(0.3, 0.1, 0.1);
  CHECK(check(1, 1));
  filter->ReleaseCache();
  material->SetBaseColor(0.4, 0.1, 0.1);
  CHECK(check(2, 0));
}

void TestProgressAndAbort()
{
  vtkNew<vtkImageReliefShading> filter;
  SetUp(filter, vtkReliefMaterial::Vertical);
  filter->SetCacheMemoryLimit(0);
  ProgressKeeper progress(filter);
  filter->Update();
  CHECK(progress.Steps.size() >= 3 && progress.Rises() && progress.Steps.back() <= 1.0);

  progress.StopAbove = 0.3;
  progress.Steps.clear();
  filter->Modified();
  filter->Update();
  CHECK(!progress.Steps.empty() && progress.Steps.back() < 0.9);
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 0);
  progress.StopAbove = VTK_DOUBLE_MAX;
  filter->Update();
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 131 * 97);
}

// Peak memory beside input and output stays under 16 bytes a sample.
double MegabytesFromStatus(const char* key)
{
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word)
  {
    if (word == key)
    {
      double kilobytes = 0.0;
      status >> kilobytes;
      return kilobytes / 1024.0;
    }
  }
  return -1.0;
}

void TestMemory()
{
  if (MegabytesFromStatus("VmHWM:") < 0.0 || IsMemorySanitized)
  {
    std::cout << "Memory is not measured: there is no /proc/self/status, or a sanitizer."
              << std::endl;
    return;
  }
  const int size = 2048;
  vtkNew<vtkImageReliefShading> filter;
  // A small field first: code, thread stacks and the allocator's own needs are not the filter's.
  filter->SetInputData(MakeHeights<vtkShortArray>(64, 64, Hills(1)));
  filter->Update();
  filter->SetInputData(MakeHeights<vtkShortArray>(size, size, Hills(1)));
  double before = MegabytesFromStatus("VmRSS:");
  filter->Update();
  double samples = static_cast<double>(size) * size / 1048576.0;
  double output = samples * 4 * sizeof(float);
  double bytes = (MegabytesFromStatus("VmHWM:") - before - output) / samples;
  std::cout << "Memory beside input and output: " << bytes << " bytes a sample" << std::endl;
  CHECK(bytes < 16.0);
}
}

int TestImageReliefShadingPipeline(int, char*[])
{
  for (int offsetMode : { vtkReliefMaterial::Vertical, vtkReliefMaterial::SurfaceNormal })
  {
    TestThreads(offsetMode);
    TestPieces(offsetMode);
  }
  TestEffects();
  TestReuse();
  TestProgressAndAbort();
  TestMemory();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
