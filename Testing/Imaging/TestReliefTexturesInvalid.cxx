// SPDX-License-Identifier: BSD-3-Clause
// Textures that vtkImageReliefShading refuses or wonders about: one message, and nothing that is
// not finite.
#include "vtkImageReliefShading.h"

#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkReliefScene.h"
#include "vtkReliefStatistics.h"
#include "vtkShortArray.h"
#include "vtkSignedCharArray.h"

#include "ReliefTextureTestUtilities.h"
#include "ReliefUnusableImages.h"

namespace
{
int Failures = 0;

Color Grey(int, int)
{
  return { 0.5, 0.5, 0.5, 1.0 };
}

// Heights that stand apart from the origin.
vtkSmartPointer<vtkImageData> MakeGround()
{
  auto heights = MakeHeights(6, 5, Hills(1));
  heights->SetOrigin(100.0, 200.0, 0.0);
  return heights;
}

// The output is empty.
void TestRefused()
{
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(MakeGround());
  MessageKeeper messages(filter);
  auto refused = [&](vtkImageData* texture, const std::string& text)
  {
    filter->SetDiffuseTextureData(texture);
    filter->Update();
    const bool one = messages.OneError(text) && filter->GetOutput()->GetNumberOfPoints() == 0;
    filter->SetDiffuseTextureData(nullptr);
    filter->Update();
    return one && messages.Silent() && filter->GetOutput()->GetNumberOfPoints() == 30;
  };
  CHECK(refused(MakeTexture<vtkShortArray>(4, 4, 3, Grey),
    "the diffuse texture scalars are of type short; unsigned char or unsigned short (sRGB), float "
    "or double (linear) is expected"));
  CHECK(refused(MakeTexture<vtkSignedCharArray>(4, 4, 3, Grey), "signed char"));
  CHECK(refused(MakeTexture<vtkIntArray>(4, 4, 1, Grey), "type int"));
  for (const auto& [image, text] : UnusableImages("diffuse texture", 3))
  {
    CHECK(refused(image, text));
  }
  vtkNew<vtkImageData> five;
  five->SetDimensions(4, 4, 1);
  five->AllocateScalars(VTK_FLOAT, 5);
  filter->SetSpecularTextureData(five); // whether it shows or not
  filter->Update();
  CHECK(messages.OneError("the specular texture image has 5 components, 1 (grey)"));
}

// The constant colour shows.
void TestNowhere()
{
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(MakeGround());
  MessageKeeper messages(filter);
  auto plain = Update(filter);
  filter->SetDiffuseTextureData(MakeTexture<vtkFloatArray>(4, 4, 3, Grey));
  filter->Update();
  CHECK(
    messages.OneWarning("The diffuse texture lies nowhere on the heights: its bounds in x and y "
                        "are (0, 3, 0, 3), theirs (100, 105, 200, 204)"));
  CHECK(SameBytes(
    filter->GetOutput()->GetPointData()->GetScalars(), plain->GetPointData()->GetScalars()));
  filter->StretchTexturesOn();
  filter->Update();
  CHECK(messages.Silent());
  CHECK(filter->GetStatistics()->GetEffectNames() == "Illumination DiffuseTexture");
}

// Texels that are no colours.
void TestTexels()
{
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(MakeGround());
  MessageKeeper messages(filter);
  filter->StretchTexturesOn();
  auto dirty = MakeTexture<vtkFloatArray>(6, 5, 3,
    [](int i, int j)
    {
      return i == 2 && j == 2 ? Color{ vtkMath::Nan(), 0.5, 0.5, 1.0 }
        : i == 3 && j == 3    ? Color{ -1.0, vtkMath::Inf(), 0.5, 1.0 }
                              : Color{ 0.5, 0.5, 0.5, 1.0 };
    });
  filter->SetDiffuseTextureData(dirty);
  filter->Update();
  CHECK(messages.OneWarning("The diffuse texture has 2 texels with negative or non-finite"));
  for (int j = 0; j < 5; ++j)
  {
    for (int i = 0; i < 6; ++i)
    {
      const float red = Value(filter->GetOutput(), nullptr, i, j, 0);
      CHECK(std::isfinite(red));
      CHECK((red == 0.0f) == ((i == 2 && j == 2) || (i == 3 && j == 3)));
      CHECK(std::isfinite(Value(filter->GetOutput(), nullptr, i, j, 1)));
      CHECK(Value(filter->GetOutput(), nullptr, i, j, 2) > 0.0f);
    }
  }
  // Told once; told again when the array changes.
  filter->GetScene()->AddSun(100.0, 20.0);
  filter->Update();
  CHECK(messages.Silent());
  dirty->GetPointData()->GetScalars()->SetTuple3(1, -1.0, -1.0, -1.0);
  dirty->GetPointData()->GetScalars()->Modified();
  dirty->Modified();
  filter->Update();
  CHECK(messages.OneWarning("has 3 texels"));
  // A texture that is not read is not looked at.
  filter->SetDiffuseTextureData(nullptr);
  filter->SetSpecularTextureData(dirty);
  filter->Update();
  CHECK(messages.Silent());
}
}

int TestReliefTexturesInvalid(int, char*[])
{
  TestRefused();
  TestNowhere();
  TestTexels();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
