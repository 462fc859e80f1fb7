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
#include "vtkSmartPointer.h"
#include "vtkUnsignedCharArray.h"

#include "ReliefKeptWork.h"
#include "ReliefTestUtilities.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <random>

namespace
{
int Failures = 0;

// A scene that uses every effect, with holes. With the vertical offset suns are swept in lockstep,
// with the other they are traced ray by ray.
void SetUp(vtkImageReliefShading* filter, int offsetMode, bool exposed)
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
  filter->GenerateShadowOn();
  filter->GenerateNormalsOn();
  filter->GetScene()->SetAutomaticExposure(exposed);
  filter->SetOutputScalarType(exposed ? VTK_UNSIGNED_CHAR : VTK_FLOAT);
}

// The depth at which suns have their limit, and a floor amid the heights.
void SetLimits(vtkImageReliefShading* filter)
{
  vtkReliefMaterial* material = filter->GetScene()->GetMaterial();
  material->SetSubsurfaceDepth(0.0);
  material->SetFloorHeight(30.0);
  material->UseFloorOn();
}

void TestThreads(int offsetMode, bool exposed, bool limits = false)
{
  vtkNew<vtkImageReliefShading> filter;
  SetUp(filter, offsetMode, exposed);
  if (limits)
  {
    SetLimits(filter);
  }
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

void TestPieces(int offsetMode, bool exposed, bool limits = false)
{
  vtkNew<vtkImageReliefShading> filter;
  SetUp(filter, offsetMode, exposed);
  if (limits)
  {
    SetLimits(filter);
  }
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

// Parts of a picture have one exposure, which is looked for once.
void TestExposureOfPieces()
{
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(MakeHeights(131, 96, Hills(3)));
  filter->SetCacheMemoryLimit(0);
  filter->SetOutputScalarTypeToUnsignedChar();
  filter->GetScene()->AddSun(300.0, 20.0);
  filter->GetScene()->AutomaticExposureOn();
  vtkReliefStatistics* statistics = filter->GetStatistics();
  const auto shade = [&](int first, int last)
  {
    int extent[6] = { 0, 130, first, last, 0, 0 };
    filter->UpdateExtent(extent);
    return statistics->GetRaysTraced();
  };
  const vtkTypeInt64 withSearch = shade(0, 31);
  const double exposure = statistics->GetExposure();
  const vtkTypeInt64 without = shade(32, 63);
  CHECK(withSearch > without && without == 131 * 32);
  CHECK(statistics->GetExposure() == exposure && exposure != 0.0);
  filter->GetScene()->SetHeightScale(2.0);
  CHECK(shade(64, 95) > without); // of another scene
  // Linear numbers have none.
  filter->SetOutputScalarTypeToFloat();
  CHECK(shade(0, 31) == without && statistics->GetExposure() == 0.0);
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
  // Along a diagonal, sample (i, j) has min(i, 19 - j) cells before it and as many that its ray
  // touches at corners; over all samples that is twice 2470.
  CHECK(statistics->GetCellsVisited() > 0 && statistics->GetCellsVisited() <= 2 * 2470);
  CHECK(statistics->GetLightsReused() == 0);
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

// What light does not depend on traces no ray, and what it does traces all.
void TestNothingInVain()
{
  for (int columns : { 50, 90 }) // packets, and the sweep
  {
    auto heights = MakeHeights(columns, 40, Hills(9));
    vtkNew<vtkImageReliefShading> filter;
    filter->SetInputData(heights);
    vtkReliefScene* scene = filter->GetScene();
    scene->AddSun(300.0, 20.0);
    filter->Update();
    for (const SceneChange& change : ChangesOfAScene())
    {
      change.make(scene, scene->GetMaterial());
      filter->Update();
      const vtkTypeInt64 rays = filter->GetStatistics()->GetRaysTraced();
      const vtkTypeInt64 expected = change.traces ? columns * 40 : 0;
      vtkNew<vtkImageReliefShading> fresh;
      fresh->SetInputData(heights);
      fresh->SetScene(scene);
      fresh->Update();
      if (rays != expected ||
        !SameBytes(filter->GetOutput()->GetPointData()->GetScalars(),
          fresh->GetOutput()->GetPointData()->GetScalars()))
      {
        std::cout << change.name << ", " << columns << " columns: " << rays << " rays, " << expected
                  << " are expected, or other colours" << std::endl;
        ++Failures;
      }
    }
  }
}

// Images that share their scalars, and so the time of the last change, are not the same.
void TestSharedScalars()
{
  auto heights = MakeHeights(30, 20, Hills(4));
  vtkNew<vtkImageData> wide;
  wide->ShallowCopy(heights);
  wide->SetSpacing(3.0, 3.0, 1.0);
  heights->GetPointData()->GetScalars()->Modified();
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(heights);
  filter->Update();
  filter->SetInputData(wide);
  filter->Update();
  vtkNew<vtkImageReliefShading> fresh;
  fresh->SetInputData(wide);
  fresh->Update();
  CHECK(SameBytes(filter->GetOutput()->GetPointData()->GetScalars(),
    fresh->GetOutput()->GetPointData()->GetScalars()));
}

// A picture that somebody holds stays as it is; the room of one that nobody holds is used again.
void TestRoomOfPictures()
{
  vtkNew<vtkImageReliefShading> filter;
  SetUp(filter, vtkReliefMaterial::Vertical, true);
  filter->Update();
  vtkSmartPointer<vtkDataArray> held = filter->GetOutput()->GetPointData()->GetScalars();
  vtkSmartPointer<vtkDataArray> copy = vtk::TakeSmartPointer(held->NewInstance());
  copy->DeepCopy(held);
  filter->GetScene()->GetMaterial()->SetDiffuseColor(0.2, 0.4, 0.6);
  filter->Update();
  vtkDataArray* const other = filter->GetOutput()->GetPointData()->GetScalars();
  CHECK(other != held);
  CHECK(SameBytes(held, copy));
  CHECK(!SameBytes(held, other));
  const void* const room = other->GetVoidPointer(0);
  CHECK(reinterpret_cast<std::uintptr_t>(room) % 64 == 0);
  filter->GetScene()->GetMaterial()->SetDiffuseColor(1.0, 1.0, 1.0);
  filter->Update();
  CHECK(filter->GetOutput()->GetPointData()->GetScalars()->GetVoidPointer(0) == room);
  vtkNew<vtkImageReliefShading> fresh;
  SetUp(fresh, vtkReliefMaterial::Vertical, true);
  fresh->GetScene()->GetMaterial()->SetDiffuseColor(1.0, 1.0, 1.0);
  fresh->Update();
  CHECK(SameBytes(filter->GetOutput()->GetPointData()->GetScalars(),
    fresh->GetOutput()->GetPointData()->GetScalars()));
  // A picture of another type is another array.
  filter->SetOutputScalarTypeToFloat();
  filter->Update();
  CHECK(vtkFloatArray::SafeDownCast(filter->GetOutput()->GetPointData()->GetScalars()));
}

void TestProgressAndAbort()
{
  vtkNew<vtkImageReliefShading> filter;
  SetUp(filter, vtkReliefMaterial::Vertical, false);
  filter->SetCacheMemoryLimit(0);
  ProgressKeeper progress(filter);
  filter->Update();
  CHECK(progress.Steps.size() >= 3 && progress.Rises() && progress.Steps.back() <= 1.0);

  progress.StopAbove = 0.3;
  progress.Steps.clear();
  filter->Modified();
  filter->Update();
  // Since VTK 9.2 the pipeline tells of the end even where there was none.
  if (!progress.Steps.empty() && progress.Steps.back() == 1.0)
  {
    progress.Steps.pop_back();
  }
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
  for (int offsetMode : { vtkReliefMaterial::Vertical, vtkReliefMaterial::SurfaceNormal,
         vtkReliefMaterial::TangentPlane })
  {
    for (bool exposed : { false, true })
    {
      TestThreads(offsetMode, exposed);
      TestPieces(offsetMode, exposed);
    }
  }
  TestThreads(vtkReliefMaterial::TangentPlane, true, true);
  TestPieces(vtkReliefMaterial::TangentPlane, true, true);
  TestExposureOfPieces();
  TestEffects();
  TestReuse();
  TestNothingInVain();
  TestSharedScalars();
  TestRoomOfPictures();
  TestProgressAndAbort();
  TestMemory();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
