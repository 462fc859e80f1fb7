// SPDX-License-Identifier: BSD-3-Clause
// Heights that are read as they are needed: every extent of the picture is bit for bit that of the
// whole heights. RELIEF_SEED repeats a run.
#include "vtkImageReliefShading.h"

#include "vtkLight.h"
#include "vtkLookupTable.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkReliefStatistics.h"
#include "vtkReliefVerification.h"
#include "vtkShortArray.h"
#include "vtkTable.h"
#include "vtkUnsignedCharArray.h"
#include "vtkVariant.h"

#include "ReliefLongRunTestUtilities.h"
#include "ReliefTestUtilities.h"
#include "TiledHeightsTestUtilities.h"

#include <cmath>
#include <random>
#include <string>

namespace
{
int Failures = 0;

// A field with cliffs, holes in some and a plain elsewhere.
std::function<double(int, int)> RandomHeights(std::mt19937& random)
{
  const std::function<double(int, int)> hills = Hills(random());
  const double scale = std::pow(10.0, Between(random, -1.0, 1.0));
  const double above = Chance(random, 0.3) ? Between(random, -1e5, 1e5) : 0.0;
  const int plain = static_cast<int>(random() % 200);
  return [=](int i, int j)
  { return above + std::round(scale * (i > plain && i < plain + 150 ? 30.0 : hills(i, j))); };
}

void RandomScene(std::mt19937& random, int columns, int rows, vtkReliefScene* scene)
{
  vtkReliefMaterial* material = scene->GetMaterial();
  material->SetSubsurfaceDepth(Chance(random, 0.2) ? 0.0 : std::pow(10.0, Between(random, -1, 2)));
  material->SetSpecularCoefficient(Chance(random, 0.5) ? 0.0 : Between(random, 0.0, 0.9));
  material->SetForwardScatterCoefficient(Chance(random, 0.5) ? 0.0 : Between(random, 0.0, 0.9));
  material->SetForwardScatterRange(-1.0, 1.0);
  material->SetOffsetMode(static_cast<int>(random() % 3));
  if (Chance(random, 0.3))
  {
    material->SetFloorHeight(Between(random, -10.0, 40.0));
    material->UseFloorOn();
  }
  scene->SetHeightScale(Chance(random, 0.5) ? 1.0 : Between(random, 0.2, 3.0));
  scene->SetAutomaticExposure(Chance(random, 0.5));
  if (Chance(random, 0.1))
  {
    scene->SetIntegrator(vtkReliefScene::FixedStep);
  }
  const int suns = Chance(random, 0.8) ? 1 + static_cast<int>(random() % 2) : 0;
  for (int k = 0; k < suns; ++k)
  {
    scene->AddSun(Between(random, 0.0, 360.0), std::pow(10.0, Between(random, 0.0, 1.95)),
      Chance(random, 0.2) ? 2.0 : 0.0);
  }
  if (suns == 0 || Chance(random, 0.3))
  {
    vtkNew<vtkLight> lamp;
    lamp->PositionalOn();
    lamp->SetPosition(
      Between(random, -50.0, columns + 50.0), Between(random, -50.0, rows + 50.0), 90.0);
    scene->AddLight(lamp);
  }
  if (Chance(random, 0.15))
  {
    scene->SetLightsToSkyDome();
  }
}

void TestRandomPictures()
{
  const unsigned int seed = ChooseSeed();
  std::mt19937 random(seed);
  const int rounds = FromEnvironment("RELIEF_ROUNDS", IsMemorySanitized ? 10 : 40);
  for (int round = 0; round < rounds; ++round)
  {
    Pair pair;
    const int columns = 2 + static_cast<int>(random() % 500);
    const int rows = 2 + static_cast<int>(random() % 400);
    const auto height = RandomHeights(random);
    const bool shorts = Chance(random, 0.3);
    const bool doubles = !shorts && Chance(random, 0.3);
    const vtkSmartPointer<vtkImageData> heights = shorts
      ? MakeHeights<vtkShortArray>(
          columns, rows, [&](int i, int j) { return std::fmod(height(i, j), 3e4); })
      : doubles ? MakeHeights<vtkDoubleArray>(columns, rows, height)
                : MakeHeights(columns, rows, height);
    const int holes = 40 + static_cast<int>(random() % 400);
    const vtkSmartPointer<vtkImageData> mask = Chance(random, 0.3)
      ? MakeHeights<vtkUnsignedCharArray>(
          columns, rows, [=](int i, int j) { return (i * i / 64 + 3 * j) % holes == 0 ? 0 : 1; })
      : nullptr;
    const bool noData = Chance(random, 0.2);
    pair.SetHeights(heights, mask, noData, height(columns / 2, rows / 2));
    const unsigned int sceneSeed = random();
    vtkNew<vtkLookupTable> table;
    double range[2];
    heights->GetScalarRange(range);
    table->SetRange(range);
    const bool tinted = Chance(random, 0.4);
    const bool layers = Chance(random, 0.6);
    const bool exposed = Chance(random, 0.5);
    pair.ForBoth(
      [&](vtkImageReliefShading* filter)
      {
        std::mt19937 same(sceneSeed);
        RandomScene(same, columns, rows, filter->GetScene());
        filter->SetOutputScalarType(exposed ? VTK_UNSIGNED_CHAR : VTK_FLOAT);
        filter->SetLookupTable(tinted ? table.Get() : nullptr);
        filter->SetGenerateIllumination(layers);
        filter->SetGenerateNormals(layers);
        filter->SetGenerateThickness(layers);
        filter->SetGenerateBase(layers);
        filter->SetGenerateDiffuse(layers);
        filter->SetGenerateScatter(layers);
        filter->SetGenerateSpecular(layers);
      });
    pair.Whole->Update();
    CHECK(pair.Whole->GetOutput()->GetNumberOfPoints() > 0);
    for (int piece = 0; piece < 5; ++piece)
    {
      int extent[6] = { 0, columns - 1, 0, rows - 1, 0, 0 };
      if (piece > 0)
      {
        extent[0] = static_cast<int>(random() % columns);
        extent[1] = extent[0] + static_cast<int>(random() % (columns - extent[0]));
        extent[2] = static_cast<int>(random() % rows);
        extent[3] = extent[2] + static_cast<int>(random() % (rows - extent[2]));
      }
      const std::string difference = Compare(pair.Whole->GetOutput(), pair.Tiled, extent);
      if (!difference.empty())
      {
        std::cout << "RELIEF_SEED=" << seed << ", round " << round << ", piece " << piece << " of "
                  << columns << " x " << rows << ": " << difference << std::endl;
        ++Failures;
      }
      if (piece == 0)
      {
        CHECK(
          pair.Tiled->GetStatistics()->GetExposure() == pair.Whole->GetStatistics()->GetExposure());
      }
    }
    CHECK(pair.Tiled->GetHeightHash() == pair.Whole->GetHeightHash());
  }
}

// A high sun needs little beside the extent, and is told so; what an earlier run has found is used.
void TestWhatIsRead()
{
  Pair pair;
  pair.SetHeights(MakeHeights(1024, 1024, Hills(3)), nullptr, false, 0.0);
  pair.ForBoth([](vtkImageReliefShading* filter) { filter->GetScene()->AddSun(315.0, 60.0); });
  pair.Whole->Update();
  const int extent[6] = { 512, 639, 512, 639, 0, 0 };
  const double needs = pair.Tiled->EstimateMemory(extent);
  CHECK(needs > 128.0 * 128.0 * 4.0 / 1024.0);
  CHECK(needs < 8192.0);
  CHECK(pair.Supply->Share == 1.0);
  const int all[6] = { 0, 1023, 0, 1023, 0, 0 };
  CHECK(pair.Tiled->EstimateWork(all) > 5.0 * pair.Tiled->EstimateWork(extent));
  CHECK(pair.Whole->EstimateMemory(extent) == 0.0);
  pair.Supply->Samples = 0;
  CHECK(Compare(pair.Whole->GetOutput(), pair.Tiled, extent).empty());
  CHECK(pair.Supply->Samples >= 128 * 128);
  CHECK(pair.Supply->Samples < 450 * 450);
  // The same again reads nothing.
  pair.Supply->Samples = 0;
  const int part[6] = { 520, 600, 520, 600, 0, 0 };
  CHECK(Compare(pair.Whole->GetOutput(), pair.Tiled, part).empty());
  CHECK(pair.Supply->Samples == 0);
  // Work is that of the piece.
  CHECK(pair.Tiled->GetStatistics()->GetRaysTraced() <
    pair.Whole->GetStatistics()->GetRaysTraced() / 20);
  // Nor does another look at the same heights go through all of them.
  vtkNew<TiledHeights> other;
  other->SetSupply(pair.Supply);
  pair.Supply->Samples = 0;
  other->Survey(1.0);
  CHECK(pair.Supply->Samples == 0);
}

// To all others it is an array like any other.
void TestArray()
{
  Pair pair;
  pair.SetHeights(MakeHeights(200, 150, Waves), nullptr, false, 0.0);
  vtkDataArray* expected = pair.Heights->GetPointData()->GetScalars();
  CHECK(LargestDifference(pair.Array, expected) == 0.0);
  CHECK(pair.Array->GetVoidPointer(0) != nullptr);
  const float* copy = static_cast<const float*>(pair.Array->GetVoidPointer(0));
  CHECK(copy[777] == static_cast<float>(expected->GetTuple1(777)));
  CHECK(std::isnan(copy[7 * 200 + 5])); // the one without data
}

// The same samples are retraced, with the same result, and a failure is told.
void TestVerification()
{
  Pair pair;
  pair.SetHeights(MakeHeights(300, 200, Waves), nullptr, false, 0.0);
  pair.Whole->GenerateIlluminationOn();
  pair.Tiled->GenerateIlluminationOn();
  vtkNew<vtkReliefVerification> whole;
  whole->SetShading(pair.Whole);
  whole->Update();
  vtkNew<vtkReliefVerification> tiled;
  tiled->SetShading(pair.Tiled);
  MessageKeeper messages(tiled);
  MessageKeeper shading(pair.Tiled);
  tiled->Update();
  CHECK(messages.Silent());
  CHECK(tiled->GetKept() && tiled->GetNumberOfRetracedSamples() == 1000);
  CHECK(tiled->GetLargestError() == whole->GetLargestError());
  vtkTable* expected = whole->GetOutput();
  vtkTable* table = tiled->GetOutput();
  CHECK(table->GetNumberOfRows() > 0 && table->GetNumberOfRows() == expected->GetNumberOfRows());
  CHECK(table->GetNumberOfColumns() == expected->GetNumberOfColumns());
  bool same = true;
  for (vtkIdType row = 0; row < expected->GetNumberOfRows(); ++row)
  {
    for (vtkIdType column = 0; column < expected->GetNumberOfColumns(); ++column)
    {
      same &= table->GetValue(row, column) == expected->GetValue(row, column);
    }
  }
  CHECK(same);
  pair.Supply->Fails = true;
  pair.Tiled->Modified();
  tiled->SetSeed(2);
  tiled->Update();
  CHECK(messages.OneError("the disk is gone"));
  CHECK(!tiled->GetKept() && table->GetNumberOfRows() == 0);
}

void TestErrors()
{
  Pair pair;
  pair.SetHeights(MakeHeights(300, 200, Waves), nullptr, false, 0.0);
  const int extent[6] = { 0, 99, 0, 99, 0, 0 };
  MessageKeeper messages(pair.Tiled);
  pair.Supply->Fails = true;
  pair.Tiled->UpdateExtent(extent);
  CHECK(messages.OneError("the disk is gone"));
  CHECK(pair.Tiled->GetOutput()->GetNumberOfPoints() == 0);
  // It recovers.
  pair.Supply->Fails = false;
  pair.Whole->Update();
  pair.Tiled->Modified();
  CHECK(Compare(pair.Whole->GetOutput(), pair.Tiled, extent).empty());
  CHECK(messages.Silent());
  // And fails amid a picture.
  pair.Supply->Fails = true;
  const int next[6] = { 150, 299, 100, 199, 0, 0 };
  pair.Tiled->UpdateExtent(next);
  CHECK(messages.OneError("the disk is gone"));
  pair.Supply->Fails = false;
  pair.Tiled->Modified();
  CHECK(Compare(pair.Whole->GetOutput(), pair.Tiled, next).empty());
  // What cannot be had beside such heights says so.
  pair.Tiled->SetMaskData(pair.Heights);
  pair.Tiled->UpdateExtent(next);
  CHECK(messages.OneError("no mask beside their own"));
}
}

int TestTiledHeights(int, char*[])
{
  TestRandomPictures();
  TestWhatIsRead();
  TestArray();
  TestVerification();
  TestErrors();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
