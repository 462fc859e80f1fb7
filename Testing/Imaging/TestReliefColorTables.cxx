// SPDX-License-Identifier: BSD-3-Clause
// Colour tables of vtkImageReliefShading.
#include "vtkImageReliefShading.h"

#include "vtkColorTransferFunction.h"
#include "vtkDiscretizableColorTransferFunction.h"
#include "vtkLookupTable.h"
#include "vtkPiecewiseFunction.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkShortArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedShortArray.h"

#include "ReliefTextureTestUtilities.h"

namespace
{
int Failures = 0;

// Unlit terms would hide the tint: level ground under a sun overhead shows it as it is.
template <class ArrayType>
void TestTable(vtkScalarsToColors* table, double bound)
{
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(MakeHeights<ArrayType>(30, 20, [](int i, int j) { return 4 * i + j; }));
  filter->GetScene()->SetHeightScale(0.0); // colours are those of the values as they are
  filter->GetScene()->AddSun(0.0, 90.0);
  filter->GetScene()->GetMaterial()->SetDiffuseColor(0.25, 0.5, 1.0);
  filter->SetLookupTable(table);
  CHECK(filter->GetLookupTable() == table);
  auto output = Update(filter);
  const double* constant = filter->GetScene()->GetMaterial()->GetDiffuseColor();
  for (int j = 0; j < 20; ++j)
  {
    for (int i = 0; i < 30; ++i)
    {
      double color[3];
      table->GetColor(4 * i + j, color);
      const double alpha = table->GetOpacity(4 * i + j);
      for (int c = 0; c < 3; ++c)
      {
        CHECK_NEAR(Value(output, nullptr, i, j, c),
          alpha * Decode(color[c]) + (1.0 - alpha) * constant[c], bound);
      }
    }
  }
}

void TestTables()
{
  vtkNew<vtkLookupTable> lookup;
  lookup->SetRange(0.0, 135.0);
  lookup->SetNumberOfTableValues(12);
  lookup->SetHueRange(0.1, 0.6);
  lookup->SetAlphaRange(0.2, 1.0);
  lookup->Build();
  TestTable<vtkFloatArray>(lookup, 2e-6);
  TestTable<vtkShortArray>(lookup, 2e-6);
  // Heights of 8 bits are heights and not colours.
  TestTable<vtkUnsignedCharArray>(lookup, 2e-6);

  // Functions are rounded to 8 bits on their way.
  vtkNew<vtkColorTransferFunction> function;
  function->AddRGBPoint(0.0, 0.1, 0.4, 0.2);
  function->AddRGBPoint(50.0, 0.9, 0.8, 0.4);
  function->AddRGBPoint(140.0, 1.0, 1.0, 1.0);
  TestTable<vtkFloatArray>(function, 0.006);
  TestTable<vtkDoubleArray>(function, 0.006);
  vtkNew<vtkDiscretizableColorTransferFunction> discrete;
  discrete->DeepCopy(function);
  discrete->DiscretizeOn();
  discrete->SetNumberOfValues(8);
  discrete->Build();
  TestTable<vtkFloatArray>(discrete, 0.006);
  TestTable<vtkUnsignedShortArray>(discrete, 0.006);
  vtkNew<vtkPiecewiseFunction> opacity;
  opacity->AddPoint(0.0, 0.0);
  opacity->AddPoint(140.0, 1.0);
  discrete->SetScalarOpacityFunction(opacity);
  discrete->EnableOpacityMappingOn();
  discrete->Build();
  TestTable<vtkFloatArray>(discrete, 0.006);
}

// Texture over table over constant, and no colour where there is no data.
void TestTableBelowTexture()
{
  vtkNew<vtkLookupTable> table;
  table->SetRange(0.0, 10.0);
  table->SetNumberOfTableValues(2);
  table->SetTableValue(0, 1.0, 0.0, 0.0, 1.0);
  table->SetTableValue(1, 0.0, 1.0, 0.0, 0.0);
  vtkNew<vtkImageReliefShading> filter;
  filter->SetInputData(
    MakeHeights(4, 4, [](int i, int j) { return i == 3 && j == 3 ? -9999.0
                                           : i < 2               ? 1.0
                                                                 : 9.0; }));
  filter->SetNoDataValue(-9999.0);
  filter->GetScene()->SetHeightScale(0.0);
  filter->GetScene()->AddSun(0.0, 90.0);
  filter->GetScene()->GetMaterial()->SetDiffuseColor(0.25, 0.5, 1.0);
  filter->SetLookupTable(table);
  filter->SetDiffuseTextureData(MakeTexture<vtkFloatArray>(4, 4, 4,
    [](int, int j) {
      return Color{ 0.0, 0.0, 2.0, j < 2 ? 0.5 : 0.0 };
    }));
  auto output = Update(filter);
  auto is = [&](int i, int j, double r, double g, double b)
  {
    return std::abs(Value(output, nullptr, i, j, 0) - r) < 1e-6 &&
      std::abs(Value(output, nullptr, i, j, 1) - g) < 1e-6 &&
      std::abs(Value(output, nullptr, i, j, 2) - b) < 1e-6;
  };
  CHECK(is(0, 3, 1.0, 0.0, 0.0));    // the table
  CHECK(is(2, 3, 0.25, 0.5, 1.0));   // the constant below its transparent half
  CHECK(is(0, 0, 0.5, 0.0, 1.0));    // half of the texture over the table
  CHECK(is(2, 0, 0.125, 0.25, 1.5)); // and over the constant
  CHECK(is(3, 3, 0.0, 0.0, 0.0) && Value(output, nullptr, 3, 3, 3) == 0.0f);
}
}

int TestReliefColorTables(int, char*[])
{
  TestTables();
  TestTableBelowTexture();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
