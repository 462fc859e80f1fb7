// SPDX-License-Identifier: BSD-3-Clause
// vtkNormalMapToHeightField: encodings, green, no data, parts, levels, units, refusals.
#include "vtkNormalMapToHeightField.h"

#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkMath.h"
#include "vtkShortArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedIntArray.h"
#include "vtkUnsignedShortArray.h"

#include "NormalMapTestUtilities.h"

#include <cstdlib>
#include <sstream>
#include <string>

namespace
{
int Failures = 0;

constexpr int Columns = 90;
constexpr int Rows = 70;

SurfaceAt Hill(int i, int j)
{
  return { 6.0 * std::sin(0.1 * i + 0.2) * std::cos(0.08 * j) + 1.5 * std::sin(0.07 * (i + j)),
    0.6 * std::cos(0.1 * i + 0.2) * std::cos(0.08 * j) + 0.105 * std::cos(0.07 * (i + j)),
    -0.48 * std::sin(0.1 * i + 0.2) * std::sin(0.08 * j) + 0.105 * std::cos(0.07 * (i + j)) };
}

double HillHeight(int i, int j)
{
  return Hill(i, j).height;
}

void HillNormal(int i, int j, double* n)
{
  const SurfaceAt at = Hill(i, j);
  const double length = std::hypot(at.x, at.y, 1.0);
  n[0] = -at.x / length;
  n[1] = -at.y / length;
  n[2] = 1.0 / length;
}

//------------------------------------------------------------------------------
// Codes of integers are n = 2 c / m - 1 where they are unsigned, n = c / m where they are signed.
template <class ArrayType>
void TestType(int outputType, int encoding, double largest, double bound)
{
  const auto code = [&](double n)
  {
    return encoding == vtkNormalMapToHeightField::Unsigned ? 0.5 * largest * (n + 1.0)
                                                           : largest * n;
  };
  const bool integer = largest > 1.0;
  const auto normals = MakeVectors<ArrayType>(Columns, Rows, 3,
    [&](int i, int j, double* n)
    {
      HillNormal(i, j, n);
      for (int c = 0; c < 3; ++c)
      {
        n[c] = integer ? std::round(code(n[c])) : code(n[c]);
      }
    });
  vtkNew<vtkIntArray> place;
  place->SetName("place");
  normals->GetFieldData()->AddArray(place);
  vtkNew<vtkNormalMapToHeightField> filter;
  filter->SetInputData(normals);
  filter->Update();
  vtkImageData* result = filter->GetOutput();
  CHECK(filter->GetUsedEncoding() == encoding);
  CHECK(filter->IsGreenKnown() && filter->GetUsedGreen() == vtkNormalMapToHeightField::Up);
  CHECK(result->GetScalarType() == outputType);
  CHECK(result->GetPointData()->GetScalars()->GetName() == std::string("Height"));
  CHECK(result->GetFieldData()->GetArray("place") == place);
  const HeightError error = CompareHeights(result, HillHeight);
  CHECK(error.count == Columns * Rows && error.worst < bound);
  // Told, it is the same.
  vtkNew<vtkNormalMapToHeightField> told;
  told->SetInputData(normals);
  told->SetEncoding(encoding);
  told->Update();
  CHECK(SameBytes(
    told->GetOutput()->GetPointData()->GetScalars(), result->GetPointData()->GetScalars()));
}

void TestTypes()
{
  using Filter = vtkNormalMapToHeightField;
  TestType<vtkUnsignedCharArray>(VTK_FLOAT, Filter::Unsigned, 255.0, 0.2);
  TestType<vtkUnsignedShortArray>(VTK_FLOAT, Filter::Unsigned, 65535.0, 0.02);
  TestType<vtkUnsignedIntArray>(VTK_DOUBLE, Filter::Unsigned, 4294967295.0, 0.02);
  TestType<vtkShortArray>(VTK_FLOAT, Filter::Signed, 32767.0, 0.02);
  TestType<vtkFloatArray>(VTK_FLOAT, Filter::Unsigned, 1.0, 0.02);
  TestType<vtkFloatArray>(VTK_FLOAT, Filter::Signed, 1.0, 0.02);
  TestType<vtkDoubleArray>(VTK_DOUBLE, Filter::Unsigned, 1.0, 0.02);
  TestType<vtkDoubleArray>(VTK_DOUBLE, Filter::Signed, 1.0, 0.02);
}

//------------------------------------------------------------------------------
// The middle of 8 bits lies between two codes: a level map stored as 128 leans, unless it is told.
void TestZeroCode()
{
  const auto level = MakeVectors<vtkUnsignedCharArray>(Columns, Rows, 3,
    [](int, int, double* n)
    {
      n[0] = n[1] = 128.0;
      n[2] = 255.0;
    });
  vtkNew<vtkNormalMapToHeightField> filter;
  filter->SetInputData(level);
  filter->Update();
  const double lean = HeightAt(filter->GetOutput(), 1, 0) - HeightAt(filter->GetOutput(), 0, 0);
  CHECK_NEAR(lean, -1.0 / 255.0, 1e-5);
  CHECK(!filter->IsGreenKnown() && filter->GetUsedGreen() == vtkNormalMapToHeightField::Up);
  filter->SetZeroCode(128.0);
  filter->Update();
  CHECK(CompareHeights(filter->GetOutput(), [](int, int) { return 0.0; }).worst == 0.0);
}

//------------------------------------------------------------------------------
// Normals of any length are the same normals.
void TestLengths()
{
  vtkNew<vtkNormalMapToHeightField> filter;
  filter->SetEncodingToSigned();
  for (const double length : { 1e-200, 0.3, 1e308 })
  {
    filter->SetInputData(MakeVectors(Columns, Rows, 3,
      [&](int i, int j, double* n)
      {
        HillNormal(i, j, n);
        std::for_each(n, n + 3, [length](double& c) { c *= length; });
      }));
    filter->Update();
    CHECK(CompareHeights(filter->GetOutput(), HillHeight).worst < 0.02);
  }
}

//------------------------------------------------------------------------------
void TestGreen()
{
  using Filter = vtkNormalMapToHeightField;
  const auto waves = [](int i, int) { return SurfaceAt{ 0.0, 0.5 * std::sin(0.2 * i), 0.0 }; };
  for (const double noise : { 0.0, 0.02 })
  {
    for (const double sign : { 1.0, -1.0 })
    {
      const auto turned = [sign](const Surface& surface)
      {
        return [sign, surface](int i, int j)
        {
          const SurfaceAt at = surface(i, j);
          return SurfaceAt{ at.height, at.x, sign * at.y };
        };
      };
      vtkNew<Filter> filter;
      filter->SetInputData(MakeNormals(Columns, Rows, turned(Hill), noise));
      filter->Update();
      CHECK(filter->IsGreenKnown());
      CHECK(filter->GetUsedGreen() == (sign > 0.0 ? Filter::Up : Filter::Down));
      const HeightError error = CompareHeights(filter->GetOutput(), HillHeight);
      CHECK(error.rms < 0.02 * error.range);
      // The wrong sign is taken where it is asked for.
      filter->SetGreen(sign > 0.0 ? Filter::Down : Filter::Up);
      filter->Update();
      CHECK(filter->IsGreenKnown() && filter->GetUsedGreen() == filter->GetGreen());
      CHECK(CompareHeights(filter->GetOutput(), HillHeight).rms > 0.1 * error.range);
      // Waves along an axis look the same with both.
      filter->SetGreenToAutomatic();
      filter->SetInputData(MakeNormals(Columns, Rows, turned(waves), noise));
      filter->Update();
      CHECK(!filter->IsGreenKnown() && filter->GetUsedGreen() == Filter::Up);
    }
  }
}

//------------------------------------------------------------------------------
// A mask, alpha, a weight of 0 and a normal of no use are the same gap.
void TestNoData()
{
  const auto gap = [](int i, int j)
  { return i == 40 || std::hypot(i - 70, j - 40) < 9.0 || (i < 3 && j > 60); };
  const auto normal = [&](int i, int j, double* n)
  {
    HillNormal(i, j, n);
    n[3] = gap(i, j) ? 0.0 : 0.5;
  };
  for (const int method : { 0, 1, 2 })
  {
    vtkNew<vtkNormalMapToHeightField> byMask;
    byMask->SetMethod(method);
    byMask->SetInputData(MakeVectors(Columns, Rows, 3, normal));
    byMask->SetMaskData(
      MakeHeights(Columns, Rows, [&](int i, int j) { return gap(i, j) ? 0.0 : -2.0; }));
    byMask->Update();
    vtkDataArray* expected = byMask->GetOutput()->GetPointData()->GetScalars();
    CHECK(byMask->GetNumberOfParts() == 2);
    for (int j = 0; j < Rows; ++j)
    {
      for (int i = 0; i < Columns; ++i)
      {
        CHECK(std::isnan(HeightAt(byMask->GetOutput(), i, j)) == gap(i, j));
      }
    }
    vtkNew<vtkNormalMapToHeightField> byAlpha;
    byAlpha->SetMethod(method);
    byAlpha->SetInputData(MakeVectors(Columns, Rows, 4, normal));
    byAlpha->Update();
    CHECK(SameBytes(byAlpha->GetOutput()->GetPointData()->GetScalars(), expected));
    const double bad[6][3] = { { 0.0, 0.0, 0.0 }, { 0.3, 0.1, -0.5 }, { 1.0, 0.0, 0.0 },
      { vtkMath::Nan(), 0.0, 1.0 }, { 0.0, vtkMath::Inf(), 1.0 }, { 0.0, 0.0, vtkMath::Inf() } };
    vtkNew<vtkNormalMapToHeightField> byNormal;
    byNormal->SetMethod(method);
    byNormal->SetInputData(MakeVectors(Columns, Rows, 3,
      [&](int i, int j, double* n)
      {
        normal(i, j, n);
        if (gap(i, j))
        {
          std::copy_n(bad[(i + j) % 6], 3, n);
        }
      }));
    byNormal->Update();
    CHECK(SameBytes(byNormal->GetOutput()->GetPointData()->GetScalars(), expected));
    vtkNew<vtkNormalMapToHeightField> byWeight;
    byWeight->SetMethod(method);
    byWeight->SetTolerance(1e-9);
    byWeight->SetInputData(MakeVectors(Columns, Rows, 3, normal));
    byWeight->SetWeightsData(MakeHeights(
      Columns, Rows, [&](int i, int j) { return !gap(i, j) ? 2.5
                                           : i % 2         ? 0.0
                                                           : -1.0; }));
    byWeight->Update();
    CHECK(LargestDifference(byWeight->GetOutput()->GetPointData()->GetScalars(), expected) < 2e-3);
  }
}

//------------------------------------------------------------------------------
// Each part has its own level.
void TestLevels()
{
  vtkNew<vtkNormalMapToHeightField> filter;
  filter->SetInputData(MakeVectors(Columns, Rows, 3, HillNormal));
  const auto columnOf = [](int i) {
    return i < 30 ? 0 : i < 31 ? -1 : i < 32 ? 1 : i < 33 ? -1 : 2;
  };
  filter->SetMaskData(MakeMask(Columns, Rows, [&](int i, int) { return columnOf(i) >= 0; }));
  for (const int datum : { vtkNormalMapToHeightField::Mean, vtkNormalMapToHeightField::Minimum })
  {
    filter->SetDatum(datum);
    filter->Update();
    double sums[3] = { 0.0, 0.0, 0.0 };
    double least[3] = { 1e9, 1e9, 1e9 };
    for (int j = 0; j < Rows; ++j)
    {
      for (int i = 0; i < Columns; ++i)
      {
        if (columnOf(i) >= 0)
        {
          const double height = HeightAt(filter->GetOutput(), i, j);
          sums[columnOf(i)] += height;
          least[columnOf(i)] = std::min(least[columnOf(i)], height);
        }
      }
    }
    for (int part = 0; part < 3; ++part)
    {
      CHECK(datum == vtkNormalMapToHeightField::Mean ? std::abs(sums[part]) < 1e-8
                                                     : least[part] == 0.0);
    }
    CHECK(filter->GetNumberOfParts() == 3);
  }
}

//------------------------------------------------------------------------------
// Heights are in the unit of the spacing, which may differ between the axes and be negative.
void TestSpacing()
{
  const auto surface = [](int i, int j)
  {
    const SurfaceAt at = Hill(i, j);
    return SurfaceAt{ 0.5 * at.height, at.x / 0.002 * 0.5, at.y / 0.004 * 0.5 };
  };
  const auto normals = MakeNormals(Columns, Rows,
    [&](int i, int j)
    {
      const SurfaceAt at = surface(i, j);
      return SurfaceAt{ 0.0, at.x * 0.01, at.y * 0.01 };
    });
  for (const double sign : { 1.0, -1.0 })
  {
    normals->SetSpacing(sign * 0.002, 0.004, 7.0);
    vtkNew<vtkNormalMapToHeightField> filter;
    filter->SetInputData(normals);
    for (const int method :
      { vtkNormalMapToHeightField::LeastSquares, vtkNormalMapToHeightField::DiscontinuityPreserving,
        vtkNormalMapToHeightField::PathSums })
    {
      filter->SetMethod(method);
      filter->Update();
      const HeightError error = CompareHeights(
        filter->GetOutput(), [&](int i, int j) { return 0.01 * surface(i, j).height; });
      CHECK(error.rms <
        (method == vtkNormalMapToHeightField::LeastSquares ? 0.002 : 0.01) * error.range);
    }
  }
}

//------------------------------------------------------------------------------
// Images of any extent, down to one sample, and of no data at all.
void TestSizes()
{
  for (const int method : { 0, 1, 2 })
  {
    for (const auto& size : { std::make_pair(1, 1), std::make_pair(1, 5), std::make_pair(4, 1),
           std::make_pair(2, 2), std::make_pair(3, 2) })
    {
      vtkNew<vtkNormalMapToHeightField> filter;
      MessageKeeper messages(filter);
      filter->SetMethod(method);
      filter->SetInputData(MakeVectors(size.first, size.second, 3, HillNormal));
      filter->Update();
      CHECK(messages.Silent() && filter->GetNumberOfParts() == 1);
      CHECK(!std::isnan(HeightAt(filter->GetOutput(), size.first - 1, size.second - 1)));
      filter->SetMaskData(MakeMask(size.first, size.second, [](int, int) { return false; }));
      filter->Update();
      CHECK(messages.Silent() && filter->GetNumberOfParts() == 0);
      CHECK(std::isnan(HeightAt(filter->GetOutput(), 0, 0)));
    }
  }
  const auto normals = MakeVectors(Columns, Rows, 3, HillNormal);
  normals->SetExtent(-7, Columns - 8, 100, Rows + 99, 3, 3);
  vtkNew<vtkNormalMapToHeightField> filter;
  filter->SetInputData(normals);
  filter->Update();
  CHECK(
    filter->GetOutput()->GetExtent()[0] == -7 && filter->GetOutput()->GetExtent()[3] == Rows + 99);
  CHECK(CompareHeights(filter->GetOutput(), HillHeight).worst < 0.02);
}

//------------------------------------------------------------------------------
// Finite heights of normals that are as steep, and weights that are as far apart, as they can be.
void TestExtremes()
{
  const auto wild = MakeVectors(Columns, Rows, 3,
    [](int i, int j, double* n)
    {
      n[0] = std::sin(1e4 * i + j);
      n[1] = std::sin(3e4 * j - i);
      n[2] = (i + j) % 3 ? 1e-3 : 1.0;
    });
  wild->SetSpacing(1e30, 1e24, 1.0);
  vtkNew<vtkNormalMapToHeightField> filter;
  MessageKeeper messages(filter);
  filter->SetInputData(wild);
  for (const bool weighted : { false, true })
  {
    filter->SetWeightsData(weighted
        ? MakeHeights<vtkDoubleArray>(Columns, Rows,
            [](int i, int j) { return std::pow(10.0, (7 * i + 11 * j) % 600 - 300); })
            .Get()
        : nullptr);
    for (const int method : { 0, 1, 2 })
    {
      filter->SetMethod(method);
      filter->SetSmoothness(1000.0);
      filter->SetMaximumIterations(20);
      filter->Update();
      for (int j = 0; j < Rows; ++j)
      {
        for (int i = 0; i < Columns; ++i)
        {
          const bool used = !std::isnan(HeightAt(filter->GetOutput(), i, j));
          double n[3];
          wild->GetPointData()->GetScalars()->GetTuple(j * Columns + i, n);
          CHECK(used == (n[2] / std::hypot(n[0], n[1], n[2]) > 1e-3));
          CHECK(!std::isinf(HeightAt(filter->GetOutput(), i, j)));
        }
      }
    }
  }
  CHECK(messages.Silent());
  // Depths of a camera stay finite too.
  filter->SetWeightsData(nullptr);
  filter->SetProjectionToPerspective();
  filter->SetFocalLengthX(1e-3);
  filter->SetDistance(1e30);
  for (const int method : { 0, 1, 2 })
  {
    filter->SetMethod(method);
    filter->Update();
    for (vtkIdType at = 0; at < Columns * Rows; ++at)
    {
      CHECK(!std::isinf(filter->GetOutput()->GetPointData()->GetScalars()->GetComponent(at, 0)));
    }
  }
}

//------------------------------------------------------------------------------
void TestProgress()
{
  for (const int method : { 0, 1 })
  {
    vtkNew<vtkNormalMapToHeightField> filter;
    filter->SetMethod(method);
    filter->SetInputData(MakeNormals(Columns, Rows, Hill, 0.05));
    filter->SetWeightsData(
      MakeHeights(Columns, Rows, [](int i, int j) { return 1.0 + (3 * i + j) % 5; }));
    ProgressKeeper progress(filter);
    filter->Update();
    CHECK(progress.Steps.size() >= 3 && progress.Rises() && progress.Steps.back() <= 1.0);
    progress.StopAbove = 0.01;
    progress.Steps.clear();
    filter->Modified();
    filter->Update();
    CHECK(!progress.Steps.empty() && filter->GetOutput()->GetNumberOfPoints() == 0);
    progress.StopAbove = VTK_DOUBLE_MAX;
    filter->Modified();
    filter->Update();
    CHECK(filter->GetOutput()->GetNumberOfPoints() == Columns * Rows);
  }
}

//------------------------------------------------------------------------------
void TestSetters()
{
  vtkNew<vtkNormalMapToHeightField> filter;
  MessageKeeper messages(filter);
  const vtkMTimeType time = filter->GetMTime();
  filter->SetEncoding(3);
  CHECK(messages.OneError("SetEncoding: 3 was given"));
  filter->SetGreen(-1);
  CHECK(messages.OneError("SetGreen"));
  filter->SetMethod(3);
  CHECK(messages.OneError("SetMethod"));
  filter->SetProjection(2);
  CHECK(messages.OneError("SetProjection"));
  filter->SetDatum(2);
  CHECK(messages.OneError("SetDatum"));
  filter->SetMaximumIterations(0);
  CHECK(messages.OneError("SetMaximumIterations"));
  for (const double value : { -2.0, vtkMath::Nan(), vtkMath::Inf() })
  {
    filter->SetZeroCode(value);
    CHECK(messages.OneError("SetZeroCode"));
    filter->SetFocalLengthX(value);
    CHECK(messages.OneError("SetFocalLengthX"));
    filter->SetFocalLengthY(value);
    CHECK(messages.OneError("SetFocalLengthY"));
    filter->SetDistance(value);
    CHECK(messages.OneError("SetDistance"));
    filter->SetSmoothness(value);
    CHECK(messages.OneError("SetSmoothness"));
    filter->SetEnergyTolerance(value);
    CHECK(messages.OneError("SetEnergyTolerance"));
    filter->SetTolerance(value);
    CHECK(messages.OneError("SetTolerance"));
  }
  filter->SetPrincipalPointX(vtkMath::Inf());
  CHECK(messages.OneError("SetPrincipalPointX"));
  filter->SetPrincipalPointY(-vtkMath::Inf());
  CHECK(messages.OneError("SetPrincipalPointY"));
  filter->SetPrincipalPointX(vtkMath::Nan());
  CHECK(filter->GetMTime() == time && messages.Silent());
  filter->SetPrincipalPointX(3.0);
  CHECK(filter->GetMTime() > time && filter->GetPrincipalPointX() == 3.0);
  filter->SetPrincipalPointX(vtkMath::Nan());
  CHECK(std::isnan(filter->GetPrincipalPointX()));
  std::ostringstream text;
  filter->Print(text);
  CHECK(text.str().find("Smoothness: 2") != std::string::npos);
}

//------------------------------------------------------------------------------
void TestRefusals()
{
  vtkNew<vtkNormalMapToHeightField> filter;
  MessageKeeper messages(filter);
  const auto normals = MakeVectors(Columns, Rows, 3, HillNormal);
  const auto refused = [&](const std::string& text)
  {
    filter->Update();
    CHECK(messages.OneError(text));
    CHECK(filter->GetOutput()->GetNumberOfPoints() == 0);
  };
  filter->SetInputData(MakeHeights(4, 3, [](int, int) { return 1.0; }));
  refused("1 components");
  vtkNew<vtkImageData> empty;
  filter->SetInputData(empty);
  refused("is empty");
  vtkNew<vtkImageData> slices;
  slices->SetDimensions(4, 4, 2);
  slices->AllocateScalars(VTK_FLOAT, 3);
  filter->SetInputData(slices);
  refused("2 slices");
  vtkNew<vtkImageData> nothing;
  nothing->SetDimensions(4, 4, 1);
  filter->SetInputData(nothing);
  refused("no scalars");
  filter->SetInputData(normals);
  filter->SetMaskData(MakeMask(4, 4, [](int, int) { return true; }));
  refused("the mask image's extent");
  filter->SetMaskData(normals);
  refused("the mask image has 3 components");
  filter->SetMaskData(nullptr);
  filter->SetWeightsData(MakeHeights(4, 4, [](int, int) { return 1.0; }));
  refused("the weight image's extent");
  filter->SetWeightsData(nullptr);
  filter->SetZeroCode(2.0);
  refused("ZeroCode is 2");
  filter->SetZeroCode(-1.0);
  filter->SetProjectionToPerspective();
  refused("FocalLengthX is 0");
  filter->SetProjectionToOrthographic();
  for (const double spacing : { 0.0, vtkMath::Nan(), vtkMath::Inf(), 1e-7, 1e31 })
  {
    normals->SetSpacing(1.0, spacing, 1.0);
    refused("the spacing is (1, ");
  }
  normals->SetSpacing(1.0, 1.0, 1.0);
  filter->Update();
  CHECK(messages.Silent() && filter->GetOutput()->GetNumberOfPoints() == Columns * Rows);
}
}

//------------------------------------------------------------------------------
int TestNormalMapToHeightField(int, char*[])
{
  TestTypes();
  TestZeroCode();
  TestLengths();
  TestGreen();
  TestNoData();
  TestLevels();
  TestSpacing();
  TestSizes();
  TestExtremes();
  TestProgress();
  TestSetters();
  TestRefusals();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
