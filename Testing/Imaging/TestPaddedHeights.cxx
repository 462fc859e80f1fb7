// SPDX-License-Identifier: BSD-3-Clause
//
// Heights that come with margins are shaded where they are, as those in one piece of memory are in
// a copy; and to everybody else they are an array like any other.

#include "PaddedHeights.h"

#include "PreparedHeights.h"

#include "vtkFloatArray.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"

#include "ReliefTestUtilities.h"

#include <cmath>
#include <limits>

namespace
{
int Failures = 0;

using relief::hosts::PaddedHeights;

/// The same image, its heights with margins.
vtkSmartPointer<vtkImageData> Padded(vtkImageData* image)
{
  const int* size = image->GetDimensions();
  vtkNew<PaddedHeights> heights;
  heights->MakeRoom(size[0], size[1]);
  vtkDataArray* values = image->GetPointData()->GetScalars();
  for (vtkIdType at = 0; at < values->GetNumberOfTuples(); ++at)
  {
    heights->SetComponent(at, 0, values->GetComponent(at, 0));
  }
  auto padded = vtkSmartPointer<vtkImageData>::New();
  padded->CopyStructure(image);
  padded->GetPointData()->SetScalars(heights);
  return padded;
}

/// Floats, some without data.
vtkSmartPointer<vtkImageData> Terrain(int columns, int rows)
{
  vtkSmartPointer<vtkImageData> image = MakeHeights(columns, rows, Hills(5));
  auto floats = vtkSmartPointer<vtkFloatArray>::New();
  floats->DeepCopy(image->GetPointData()->GetScalars());
  for (vtkIdType at = 0; at < floats->GetNumberOfTuples(); at += 97)
  {
    floats->SetValue(at, std::numeric_limits<float>::quiet_NaN());
  }
  image->GetPointData()->SetScalars(floats);
  return image;
}

void TestArray()
{
  vtkSmartPointer<vtkImageData> image = Terrain(70, 9);
  vtkSmartPointer<vtkImageData> padded = Padded(image);
  vtkDataArray* expected = image->GetPointData()->GetScalars();
  vtkDataArray* heights = padded->GetPointData()->GetScalars();
  CHECK(padded->GetScalarType() == VTK_FLOAT && heights->GetNumberOfTuples() == 630);
  vtkNew<vtkFloatArray> copy;
  copy->DeepCopy(heights);
  CHECK(SameBytes(copy, expected) && SameBytes(heights, expected));
  CHECK(heights->GetComponent(71, 0) == expected->GetComponent(71, 0));
  auto another = vtkSmartPointer<vtkDataArray>::Take(heights->NewInstance());
  another->DeepCopy(heights);
  CHECK(another->GetNumberOfTuples() == 630);
  CHECK(another->GetComponent(629, 0) == expected->GetComponent(629, 0));
  // Margins are NaN, and so is the row behind the last.
  auto* rows = PaddedHeights::SafeDownCast(heights);
  for (int k = 0; k < PaddedHeights::GetMargin(); ++k)
  {
    CHECK(std::isnan(rows->GetRow(0)[-1 - k]) && std::isnan(rows->GetRow(8)[70 + k]));
    CHECK(std::isnan(rows->GetRow(9)[-1 - k]) && std::isnan(rows->GetRow(9)[2 * k]));
  }
}

void TestInPlace()
{
  vtkSmartPointer<vtkImageData> image = Padded(Terrain(70, 9));
  relief::hosts::PreparedHeights prepared;
  relief::hosts::HeightInputs inputs;
  inputs.image = image;
  inputs.scalars = image->GetPointData()->GetScalars();
  inputs.padded = true;
  const float* first = PaddedHeights::SafeDownCast(inputs.scalars)->GetRow(0);
  CHECK(prepared.Update(inputs).empty());
  CHECK(prepared.GetField().IsInPlace() && prepared.GetField().GetField().heights.data == first);
  CHECK(prepared.GetField().GetMissingRow() == first + 9 * (70 + 2 * 32));
  // What has to change is copied.
  inputs.scale = 2.0;
  CHECK(prepared.Update(inputs).empty() && !prepared.GetField().IsInPlace());
  CHECK(prepared.GetField().GetMissingRow() != nullptr);
  // Rows of another image are none of this one.
  vtkNew<vtkImageData> other;
  other->SetDimensions(9, 70, 1);
  other->GetPointData()->SetScalars(inputs.scalars);
  inputs.image = other;
  inputs.scale = 1.0;
  CHECK(relief::hosts::FindPadded(inputs) == nullptr);
  CHECK(prepared.Update(inputs).empty() && !prepared.GetField().IsInPlace());
}

void TestPictures()
{
  for (const int columns : { 20, 63, 64, 131 })
  {
    vtkSmartPointer<vtkImageData> image = Terrain(columns, 50);
    for (const int offset : { vtkReliefMaterial::Vertical, vtkReliefMaterial::SurfaceNormal,
           vtkReliefMaterial::TangentPlane })
    {
      for (const double scale : { 1.0, 0.5 })
      {
        vtkNew<vtkImageReliefShading> filters[2];
        for (int k = 0; k < 2; ++k)
        {
          filters[k]->GetScene()->SetHeightScale(scale);
          filters[k]->GetScene()->GetMaterial()->SetOffsetMode(offset);
          filters[k]->GetScene()->AddSun(315.0, 15.0);
          filters[k]->GenerateIlluminationOn();
          filters[k]->SetInputData(k == 0 ? image : Padded(image));
          filters[k]->Update();
        }
        for (int array = 0; array < 2; ++array)
        {
          vtkDataArray* a = filters[0]->GetOutput()->GetPointData()->GetArray(array);
          vtkDataArray* b = filters[1]->GetOutput()->GetPointData()->GetArray(array);
          CHECK(SameBytes(a, b));
        }
      }
    }
  }
}
}

int TestPaddedHeights(int, char*[])
{
  TestArray();
  TestInPlace();
  TestPictures();
  return Failures;
}
