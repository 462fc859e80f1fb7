// SPDX-License-Identifier: BSD-3-Clause
#include "RasterFieldData.h"

#include "FileGuard.h"

#include "vtkDoubleArray.h"
#include "vtkErrorCode.h"
#include "vtkFieldData.h"
#include "vtkIntArray.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace relief::raster
{
namespace
{
//------------------------------------------------------------------------------
template <class ArrayT, class Numbers>
void AddNumbers(vtkFieldData* data, const char* name, const Numbers& numbers)
{
  vtkNew<ArrayT> array;
  array->SetName(name);
  for (const auto number : numbers)
  {
    array->InsertNextValue(number);
  }
  data->AddArray(array);
}

//------------------------------------------------------------------------------
void AddText(vtkFieldData* data, const char* name, const std::string& text)
{
  if (!text.empty())
  {
    vtkNew<vtkStringArray> array;
    array->SetName(name);
    array->InsertNextValue(text);
    data->AddArray(array);
  }
}

//------------------------------------------------------------------------------
template <std::size_t Count>
std::array<double, Count> GetNumbers(vtkFieldData* data, const char* name)
{
  vtkDataArray* array = data->GetArray(name);
  std::array<double, Count> numbers{};
  bool good = array && array->GetNumberOfValues() == static_cast<vtkIdType>(Count);
  for (std::size_t k = 0; good && k < Count; ++k)
  {
    numbers[k] = array->GetVariantValue(static_cast<vtkIdType>(k)).ToDouble();
    good = std::isfinite(numbers[k]);
  }
  if (!good)
  {
    throw io::Failure(vtkErrorCode::FileFormatError,
      std::string("the field data ") + name + " are not " + std::to_string(Count) + " numbers");
  }
  return numbers;
}

//------------------------------------------------------------------------------
std::string GetText(vtkFieldData* data, const char* name)
{
  auto* array = vtkStringArray::SafeDownCast(data->GetAbstractArray(name));
  return array && array->GetNumberOfValues() > 0 ? std::string(array->GetValue(0)) : std::string();
}

/// An image that lies as its raster does; filters may have dropped its direction, or turned it.
void CheckDirection(const std::array<double, 2>& direction, vtkImageData* image)
{
  const std::array<double, 9> expected = DirectionMatrix(direction);
  const double* found = image->GetDirectionMatrix()->GetData();
  if (!std::equal(expected.begin(), expected.end(), found,
        [](double one, double other) { return std::abs(one - other) <= 1e-6; }))
  {
    throw io::Failure(vtkErrorCode::FileFormatError,
      "the image is turned against its georeference by its direction matrix");
  }
}

//------------------------------------------------------------------------------
/// A map whose samples have a size, and whose numbers leave room to compute with.
void CheckTransform(const GeoReference& reference, const std::array<double, 2>& size)
{
  const std::array<double, 6>& t = reference.Transform;
  const double largest = 1e30;
  const std::array<double, 2> end = MapPoint(reference, size[0], size[1]);
  const bool small = std::abs(t[0]) <= largest && std::abs(t[3]) <= largest &&
    std::abs(end[0]) <= largest && std::abs(end[1]) <= largest;
  const double area = t[1] * t[5] - t[2] * t[4];
  if (!small || !std::isfinite(area) || area == 0.0)
  {
    throw io::Failure(vtkErrorCode::FileFormatError,
      "the field data geo:transform are no place on a map: samples without a size, or beyond 1e30");
  }
}
}

//------------------------------------------------------------------------------
void AddFieldData(const RasterHeader& header, const double* origin, vtkFieldData* data)
{
  if (header.Reference.Present)
  {
    AddNumbers<vtkDoubleArray>(data, "geo:transform", header.Reference.Transform);
    AddNumbers<vtkIntArray>(data, "geo:size", std::array<int, 2>{ header.Columns, header.Rows });
    AddNumbers<vtkDoubleArray>(data, "geo:spacing", header.Spacing);
    AddNumbers<vtkDoubleArray>(data, "geo:origin", std::array<double, 2>{ origin[0], origin[1] });
    if (header.IsTurned())
    {
      AddNumbers<vtkDoubleArray>(data, "geo:direction", header.Direction);
    }
    AddText(data, "geo:crs", header.Reference.Crs);
    AddText(data, "geo:areaOrPoint", header.Reference.AreaOrPoint);
  }
  AddNumbers<vtkDoubleArray>(data, "geo:heightUnit", std::array<double, 1>{ header.HeightUnit });
  if (header.NoData)
  {
    AddNumbers<vtkDoubleArray>(data, "geo:noData", std::array<double, 1>{ *header.NoData });
  }
  AddText(data, "geo:driver", header.Driver);
}

//------------------------------------------------------------------------------
GeoReference FindReference(vtkFieldData* data, vtkImageData* image)
{
  GeoReference reference;
  if (!data->GetAbstractArray("geo:transform"))
  {
    return reference;
  }
  reference.Present = true;
  reference.Transform = GetNumbers<6>(data, "geo:transform");
  reference.Crs = GetText(data, "geo:crs");
  reference.AreaOrPoint = GetText(data, "geo:areaOrPoint");
  std::array<double, 6>& t = reference.Transform;
  reference.SouthUp = t[1] * t[5] - t[2] * t[4] > 0.0;
  const std::array<double, 2> size = GetNumbers<2>(data, "geo:size");
  CheckTransform(reference, size);
  const std::array<double, 2> spacing = GetNumbers<2>(data, "geo:spacing");
  std::array<double, 2> start{ 0.0, 0.0 };
  if (data->GetAbstractArray("geo:origin"))
  {
    start = GetNumbers<2>(data, "geo:origin");
  }
  std::array<double, 2> direction{ 1.0, 0.0 };
  if (data->GetAbstractArray("geo:direction"))
  {
    direction = GetNumbers<2>(data, "geo:direction");
  }
  CheckDirection(direction, image);
  const int* extent = image->GetExtent();
  const double* own = image->GetSpacing();
  const double* origin = image->GetOrigin();
  // From the raster's first sample to the image's origin, along rows and along columns.
  const double away[2] = { origin[0] - start[0], origin[1] - start[1] };
  const double along[2] = { away[0] * direction[0] + away[1] * direction[1],
    away[1] * direction[0] - away[0] * direction[1] };
  // Where the image's first sample lies, counted in samples of the raster, and how many of them
  // there are from one to the next. For the whole raster these are exactly 0 and 1.
  double first[2];
  double step[2];
  double count[2];
  for (int k = 0; k < 2; ++k)
  {
    first[k] = (along[k] + extent[2 * k] * own[k]) / spacing[k];
    step[k] = own[k] / spacing[k];
    count[k] = extent[2 * k + 1] - extent[2 * k] + 1;
    const double end = first[k] + (count[k] - 1.0) * step[k];
    if (!(step[k] > 0.0) || !(first[k] >= -0.5 - 0.5 * step[k]) ||
      !(end <= size[k] - 0.5 + 0.5 * step[k]))
    {
      throw io::Failure(vtkErrorCode::FileFormatError,
        "the image reaches beyond the raster from which its georeference comes");
    }
  }
  // From the file's first row, which is the image's last unless the south is up.
  const double firstRow =
    reference.SouthUp ? first[1] : size[1] - 1.0 - (first[1] + (count[1] - 1.0) * step[1]);
  const std::array<double, 2> corner =
    MapPoint(reference, first[0] + 0.5 - 0.5 * step[0], firstRow + 0.5 - 0.5 * step[1]);
  t = { corner[0], t[1] * step[0], t[2] * step[1], corner[1], t[4] * step[0], t[5] * step[1] };
  return reference;
}
}
