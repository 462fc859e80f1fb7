// SPDX-License-Identifier: BSD-3-Clause
//
// The catalogue of hard cases through the filter, and those that only images of VTK have: origins
// far away, negative spacings, integers of 64 bits.
#include "ReliefHardCaseUtilities.h"

#include "vtkLongLongArray.h"

namespace
{

int Failures = 0;

void TestCatalogue()
{
  vtkNew<vtkImageReliefShading> filter;
  MessageKeeper warnings(filter); // of single rows, and of none with data
  filter->GenerateIlluminationOn();
  int lights = 0;
  ForEachHardLight(
    [&](const char* name, const HardScene& hard, std::size_t light)
    {
      Assign(hard, light, filter->GetScene());
      filter->SetInputData(ImageOf(hard.terrain));
      filter->Update();
      CHECK(CountWrong("filter", name, hard, light, filter->GetOutput(), "Illumination") == 0);
      ++lights;
    });
  std::cout << lights << " scenes" << std::endl;
  CHECK(lights > 100);

  for (const HardCase& test : HardCases())
  {
    if (test.refused)
    {
      vtkNew<vtkImageReliefShading> refusing;
      MessageKeeper errors(refusing);
      refusing->SetInputData(ImageOf(test.scene.terrain));
      refusing->Update();
      CHECK(errors.OneError(test.refused));
      CHECK(refusing->GetOutput()->GetNumberOfPoints() == 0);
    }
  }
}

// d of a small relief lit by a lamp and a sun.
vtkSmartPointer<vtkImageData> Shade(vtkImageData* heights, double x, double y, double z)
{
  vtkNew<vtkImageReliefShading> filter;
  vtkReliefScene* scene = filter->GetScene();
  scene->SetTolerance(0.0);
  scene->GetMaterial()->SetSubsurfaceDepth(0.1);
  scene->AddSun(300.0, 20.0);
  vtkNew<vtkLight> lamp;
  lamp->SetLightTypeToSceneLight();
  lamp->PositionalOn();
  lamp->SetPosition(x, y, z);
  scene->AddLight(lamp);
  filter->SetInputData(heights);
  filter->Update();
  return filter->GetOutput();
}

double Bumps(int i, int j)
{
  return std::floor(8.0 * std::sin(1.3 * i + 0.4 * j) * std::cos(0.7 * j)) / 16.0;
}

void TestImages()
{
  auto plain = MakeHeights(12, 9, Bumps);
  plain->SetSpacing(0.1, 0.1, 1.0);
  auto expected = Shade(plain, 0.35, 0.55, 0.8);
  vtkDataArray* colors = expected->GetPointData()->GetScalars();

  // Where maps are, to a hundred millionth of a sample.
  auto far = MakeHeights(12, 9, Bumps);
  far->SetSpacing(0.1, 0.1, 1.0);
  far->SetOrigin(1e7, -2e7, 0.0);
  auto shaded = Shade(far, 1e7 + 0.35, -2e7 + 0.55, 0.8);
  CHECK(LargestDifference(shaded->GetPointData()->GetScalars(), colors) < 1e-5);

  // From right to left.
  auto mirrored = MakeHeights(12, 9, [](int i, int j) { return Bumps(11 - i, j); });
  mirrored->SetSpacing(-0.1, 0.1, 1.0);
  mirrored->SetOrigin(1.1, 0.0, 0.0);
  shaded = Shade(mirrored, 0.35, 0.55, 0.8);
  for (int j = 0; j < 9; ++j)
  {
    for (int i = 0; i < 12; ++i)
    {
      CHECK_NEAR(Value(shaded, nullptr, 11 - i, j), Value(expected, nullptr, i, j), 1e-5);
    }
  }

  // Sixteenths of a unit, 1e15 of them above 0: far more digits than float has.
  auto high =
    MakeHeights<vtkLongLongArray>(12, 9, [](int i, int j) { return 1e15 + 16.0 * Bumps(i, j); });
  high->SetSpacing(1.6, 1.6, 1.0);
  auto low = MakeHeights(12, 9, [](int i, int j) { return 16.0 * Bumps(i, j); });
  low->SetSpacing(1.6, 1.6, 1.0);
  shaded = Shade(high, 5.6, 8.8, 1e15 + 13.0);
  CHECK(LargestDifference(shaded->GetPointData()->GetScalars(),
          Shade(low, 5.6, 8.8, 13.0)->GetPointData()->GetScalars()) < 1e-5);
}

}

int TestReliefHardCases(int, char*[])
{
  TestCatalogue();
  TestImages();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
