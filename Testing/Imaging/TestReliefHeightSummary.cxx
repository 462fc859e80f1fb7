// SPDX-License-Identifier: BSD-3-Clause
//
// Range and mean are those of the samples that the filter shades: both take the same for no data.

#include "HeightSummary.h"

#include "vtkCharArray.h"
#include "vtkIntArray.h"
#include "vtkLongLongArray.h"
#include "vtkShortArray.h"
#include "vtkSignedCharArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedShortArray.h"

#include "ReliefTestUtilities.h"

#include <algorithm>
#include <limits>

namespace
{
int Failures = 0;

using relief::hosts::HeightSummary;
using relief::hosts::SummarizeHeights;

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();

// The samples that come out of the filter with an alpha of 1.
HeightSummary FromFilter(vtkImageData* heights, vtkImageData* mask, bool useNoData, double noData)
{
  vtkNew<vtkImageReliefShading> filter;
  MessageKeeper warnings(filter); // where nothing has data
  filter->SetInputData(heights);
  filter->SetMaskData(mask);
  filter->SetNoDataValue(noData);
  filter->SetUseNoDataValue(useNoData);
  filter->Update();
  vtkDataArray* colors = filter->GetOutput()->GetPointData()->GetScalars();
  vtkDataArray* values = heights->GetPointData()->GetScalars();
  HeightSummary result;
  double sum = 0.0;
  for (vtkIdType at = 0; at < values->GetNumberOfTuples(); ++at)
  {
    if (colors->GetComponent(at, 3) == 1.0)
    {
      const double height = values->GetComponent(at, 0);
      result.least = result.samples > 0 ? std::min(result.least, height) : height;
      result.greatest = result.samples > 0 ? std::max(result.greatest, height) : height;
      sum += height;
      ++result.samples;
    }
  }
  result.mean = result.samples > 0 ? sum / static_cast<double>(result.samples) : 0.0;
  return result;
}

void Compare(vtkImageData* heights, vtkImageData* mask, bool useNoData, double noData)
{
  vtkDataArray* values = heights->GetPointData()->GetScalars();
  const HeightSummary expected = FromFilter(heights, mask, useNoData, noData);
  const HeightSummary given = SummarizeHeights(
    values, mask ? mask->GetPointData()->GetScalars() : nullptr, useNoData, noData);
  const bool same = given.samples == expected.samples && given.least == expected.least &&
    given.greatest == expected.greatest && given.mean == expected.mean &&
    given.HasData() == (expected.samples > 0);
  if (!same)
  {
    std::cout << values->GetDataTypeAsString() << ", mask " << (mask != nullptr) << ", nodata "
              << useNoData << " " << noData << ": " << given.samples << " in [" << given.least
              << ", " << given.greatest << "], " << expected.samples << " in [" << expected.least
              << ", " << expected.greatest << "] are expected" << std::endl;
    ++Failures;
  }
}

template <class ArrayType>
void TestType()
{
  auto heights = MakeHeights<ArrayType>(12, 9, [](int i, int j) { return (i * 7 + j * 3) % 100; });
  auto mask = MakeHeights<vtkFloatArray>(
    12, 9, [](int i, int j) { return (i + j) % 4 == 0 ? 0.0
                                : (i + j) % 4 == 1    ? NaN
                                                      : -0.5; });
  for (vtkImageData* masked : { static_cast<vtkImageData*>(nullptr), mask.Get() })
  {
    Compare(heights, masked, false, 7.0);
    // Numbers that the type has, that it has not, and that no number is.
    for (double noData : { 7.0, 0.0, 7.5, -1.0, 300.0, 1e40, -1e300, NaN, Infinity })
    {
      Compare(heights, masked, true, noData);
    }
  }
}

template <class ArrayType>
void TestFloats(double largest)
{
  auto heights = MakeHeights<ArrayType>(8, 8,
    [](int i, int j) {
      return i == 3 ? NaN : j == 2 ? Infinity : j == 5 ? -Infinity : 0.1 * i - 3.0 * j;
    });
  Compare(heights, nullptr, false, 0.0);
  Compare(heights, nullptr, true, 0.1);
  // The largest number of the type, written with too few digits.
  heights->GetPointData()->GetScalars()->SetTuple1(0, -largest);
  Compare(heights, nullptr, true, -largest * (1.0 + (largest < 1e39 ? 1e-8 : 0.0)));
  auto none = MakeHeights<ArrayType>(4, 4, [](int, int) { return NaN; });
  Compare(none, nullptr, false, 0.0);
}
}

int TestReliefHeightSummary(int, char*[])
{
  TestType<vtkCharArray>();
  TestType<vtkSignedCharArray>();
  TestType<vtkUnsignedCharArray>();
  TestType<vtkShortArray>();
  TestType<vtkUnsignedShortArray>();
  TestType<vtkIntArray>();
  TestType<vtkLongLongArray>();
  TestType<vtkFloatArray>();
  TestType<vtkDoubleArray>();
  TestFloats<vtkFloatArray>(std::numeric_limits<float>::max());
  TestFloats<vtkDoubleArray>(std::numeric_limits<double>::max());

  // 2^63, which no such value is.
  auto wide = MakeHeights<vtkLongLongArray>(4, 4, [](int i, int j) { return i * j; });
  vtkLongLongArray::SafeDownCast(wide->GetPointData()->GetScalars())
    ->SetValue(5, std::numeric_limits<long long>::lowest());
  Compare(wide, nullptr, true, 9223372036854775808.0);
  CHECK(SummarizeHeights(wide->GetPointData()->GetScalars(), nullptr, true, 9223372036854775808.0)
          .samples == 16);

  const HeightSummary empty = SummarizeHeights(vtkNew<vtkFloatArray>());
  CHECK(!empty.HasData() && empty.mean == 0.0 && empty.least == 0.0);
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
