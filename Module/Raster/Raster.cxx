// SPDX-License-Identifier: BSD-3-Clause
#include "Raster.h"

#include "FileGuard.h"
#include "HeightRuns.h"

#include "vtkDataArray.h"
#include "vtkErrorCode.h"
#include "vtkFloatArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iterator>
#include <limits>
#include <sstream>
#include <type_traits>

namespace relief::raster
{
namespace
{
// No height is as low, and none that is shaded; markers are printed with two digits at least.
constexpr double EndOfSingles = 3.4e38;

/// The least number of a type that is not below a number.
template <class ValueT>
ValueT NotBelow(double number)
{
  const auto value = static_cast<ValueT>(number);
  return static_cast<double>(value) < number
    ? std::nextafter(value, std::numeric_limits<ValueT>::infinity())
    : value;
}

/// The values that stand for no data.
template <class ValueT>
struct Markers
{
  explicit Markers(const std::optional<double>& noData)
  {
    // No finite value of this type is meant by the others, which are no data in any case.
    if (noData && std::abs(*noData) < EndOfSingles)
    {
      // Four units in the last place of single precision.
      const double allowed = 4.0 * std::numeric_limits<float>::epsilon() * std::abs(*noData);
      this->Lowest = NotBelow<ValueT>(*noData - allowed);
      this->Highest = -NotBelow<ValueT>(-(*noData + allowed));
    }
  }
  ValueT End = NotBelow<ValueT>(EndOfSingles);
  ValueT Lowest = std::numeric_limits<ValueT>::infinity(); // above the highest: none
  ValueT Highest = -std::numeric_limits<ValueT>::infinity();
};

/// Returns whether any of them is NaN then.
template <class ValueT>
bool ToNaN(ValueT* values, vtkIdType count, const Markers<ValueT>& markers)
{
  const Markers<ValueT> marks = markers; // which no value overwrites, for all that compilers know
  // Written for vectors: no branch, and false of NaN.
  const auto isNone = [&marks](ValueT value)
  {
    return static_cast<int>(!(std::abs(value) < marks.End)) |
      (static_cast<int>(value >= marks.Lowest) & static_cast<int>(value <= marks.Highest));
  };
  int any = 0;
  for (vtkIdType i = 0; i < count; ++i)
  {
    any |= isNone(values[i]);
  }
  // As seldom as that is, nothing is written where nothing changes.
  for (vtkIdType i = 0; any && i < count; ++i)
  {
    values[i] = isNone(values[i]) ? std::numeric_limits<ValueT>::quiet_NaN() : values[i];
  }
  return any != 0;
}
}

//------------------------------------------------------------------------------
std::array<double, 2> MetersPerRadian(double latitude, double a, double f1)
{
  // J. P. Snyder, Map Projections: A Working Manual, USGS Professional Paper 1395, 1987, pp. 24-25:
  // N cos(latitude) with N of equation 4-20, and R' of equation 4-18.
  const double flattening = f1 > 0.0 ? 1.0 / f1 : 0.0;
  const double e2 = flattening * (2.0 - flattening);
  const double s = std::sin(latitude);
  const double w2 = 1.0 - e2 * s * s;
  const double primeVertical = a / std::sqrt(w2);
  const double meridional = a * (1.0 - e2) / (w2 * std::sqrt(w2));
  return { primeVertical * std::cos(latitude), meridional };
}

//------------------------------------------------------------------------------
std::array<double, 2> MapPoint(const GeoReference& reference, double column, double row)
{
  const std::array<double, 6>& t = reference.Transform;
  return { t[0] + column * t[1] + row * t[2], t[3] + column * t[4] + row * t[5] };
}

//------------------------------------------------------------------------------
std::array<std::array<double, 2>, 4> Corners(const RasterHeader& raster)
{
  const GeoReference& reference = raster.Reference;
  return { MapPoint(reference, 0.0, 0.0), MapPoint(reference, raster.Columns, 0.0),
    MapPoint(reference, 0.0, raster.Rows), MapPoint(reference, raster.Columns, raster.Rows) };
}

//------------------------------------------------------------------------------
void PlaceOnMap(RasterHeader& raster)
{
  const std::array<double, 6>& t = raster.Reference.Transform;
  const std::array<double, 2>& m = raster.MetersPerUnit;
  raster.MapOrigin =
    MapPoint(raster.Reference, 0.5, raster.Reference.SouthUp ? 0.5 : raster.Rows - 0.5);
  if (t[2] == 0.0 && t[4] == 0.0)
  {
    raster.MapStep = { std::abs(t[1]), std::abs(t[5]) };
    raster.Spacing = { raster.MapStep[0] * m[0], raster.MapStep[1] * m[1] };
    raster.Direction = { t[1] < 0.0 ? -1.0 : 1.0, 0.0 };
    return;
  }
  raster.MapStep = { std::hypot(t[1], t[4]), std::hypot(t[2], t[5]) };
  raster.Spacing = { std::hypot(t[1] * m[0], t[4] * m[1]), std::hypot(t[2] * m[0], t[5] * m[1]) };
  raster.Direction = { t[1] * m[0] / raster.Spacing[0], t[4] * m[1] / raster.Spacing[0] };
}

//------------------------------------------------------------------------------
void CheckAngles(const RasterHeader& raster)
{
  const std::array<double, 6>& t = raster.Reference.Transform;
  const std::array<double, 2>& m = raster.MetersPerUnit;
  const double cosine = (t[1] * t[2] * m[0] * m[0] + t[4] * t[5] * m[1] * m[1]) /
    (raster.Spacing[0] * raster.Spacing[1]);
  // Small enough that no place is off by more than the scale of a map may be.
  if (raster.Reference.Present && std::abs(cosine) > 1.0 - LeastScale)
  {
    throw io::Failure(vtkErrorCode::FileFormatError,
      "its rows and columns do not stand at right angles on the ground; gdalwarp -dstnodata -9999 "
      "makes a raster that is north up");
  }
}

//------------------------------------------------------------------------------
void SpaceByDegrees(RasterHeader& raster, double radians, double a, double f1)
{
  const GeoReference& reference = raster.Reference;
  const double center = MapPoint(reference, 0.5 * raster.Columns, 0.5 * raster.Rows)[1];
  const double latitude = center * radians;
  if (!(std::abs(latitude) < 0.5 * vtkMath::Pi()))
  {
    throw io::Failure(vtkErrorCode::FileFormatError,
      "its centre lies at latitude " + std::to_string(center) + ", beyond the pole");
  }
  const std::array<double, 2> metres = MetersPerRadian(latitude, a, f1);
  raster.MetersPerUnit = { metres[0] * radians, metres[1] * radians };
  raster.Geographic = true;
  PlaceOnMap(raster);

  // Along the meridian nothing much changes; along the parallels, from one end to the other.
  double least = 1.0;
  double greatest = 1.0;
  for (const std::array<double, 2>& corner : Corners(raster))
  {
    const double there = std::min(std::abs(corner[1] * radians), 0.5 * vtkMath::Pi());
    const double share = MetersPerRadian(there, a, f1)[0] / metres[0];
    least = std::min(least, share);
    greatest = std::max(greatest, share);
  }
  WarnOfScales(raster, least, greatest);
}

//------------------------------------------------------------------------------
void WarnOfScales(RasterHeader& raster, double least, double greatest)
{
  if (greatest <= MostVariation * least)
  {
    return;
  }
  std::ostringstream text;
  text << "a step of its map is " << std::setprecision(2) << std::fixed << least << " to "
       << greatest
       << " times as long as at its centre, whose spacing is taken for all; take a smaller part, "
          "or gdalwarp -t_srs to a map of even scale";
  raster.Warnings.push_back({ text.str(), Warning::Spacing });
}

//------------------------------------------------------------------------------
bool LooksLikeDegrees(const RasterHeader& raster)
{
  if (!raster.Reference.Present || !raster.Reference.Crs.empty() || raster.Geographic)
  {
    return false;
  }
  const double east = raster.MapOrigin[0] + raster.Columns * raster.MapStep[0];
  const double north = raster.MapOrigin[1] + raster.Rows * raster.MapStep[1];
  // Grids of metres are seldom finer than a tenth and start at the map's origin where they are.
  return raster.MapStep[0] < 0.1 && raster.MapOrigin[0] >= -181.0 && east <= 361.0 &&
    raster.MapOrigin[1] >= -91.0 && north <= 91.0;
}

//------------------------------------------------------------------------------
bool HasLengths(const RasterHeader& raster)
{
  static const char* const pictures[] = { "BMP", "GIF", "JPEG", "JPEGXL", "PNG", "PNM", "WEBP" };
  const bool picture =
    std::find(std::begin(pictures), std::end(pictures), raster.Driver) != std::end(pictures);
  return raster.OneUnit || (raster.Reference.Present && !picture);
}

//------------------------------------------------------------------------------
void MarkNoData(Raster& raster)
{
  vtkDataArray* heights = raster.Heights->GetPointData()->GetScalars();
  if (heights->GetDataType() != VTK_FLOAT && heights->GetDataType() != VTK_DOUBLE)
  {
    return;
  }
  bool any = false;
  std::array<double, 2> ends = { std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };
  ForRuns(heights,
    [&](auto* values, vtkIdType count, vtkIdType)
    {
      using ValueT = std::remove_pointer_t<decltype(values)>;
      if constexpr (std::is_floating_point_v<ValueT>)
      {
        any = ToNaN(values, count, Markers<ValueT>(raster.NoData)) || any;
        AddToEnds(values, count, ends);
      }
    });
  raster.HasNaN = any;
  raster.Ends = ends;
  raster.NoData.reset();
}

namespace
{
template <class ValueT>
bool LacksAny(const ValueT* values, vtkIdType count, const std::optional<double>& noData)
{
  // A value that no sample has where there is none.
  const double none = noData.value_or(std::numeric_limits<double>::infinity());
  return std::any_of(values, values + count,
    [none](ValueT value)
    {
      const auto height = static_cast<double>(value);
      return !std::isfinite(height) || height == none;
    });
}
}

//------------------------------------------------------------------------------
bool LacksData(const Raster& raster)
{
  const vtkIdType count = raster.Heights->GetNumberOfPoints();
  if (raster.Mask)
  {
    const auto* shown = static_cast<const unsigned char*>(raster.Mask->GetScalarPointer());
    if (std::any_of(shown, shown + count, [](unsigned char value) { return value == 0; }))
    {
      return true;
    }
  }
  bool lacks = raster.HasNaN.value_or(false);
  if (!raster.HasNaN || raster.NoData)
  {
    ForRuns(raster.Heights->GetPointData()->GetScalars(),
      [&](const auto* values, vtkIdType number, vtkIdType)
      { lacks = lacks || LacksAny(values, number, raster.NoData); });
  }
  return lacks;
}

//------------------------------------------------------------------------------
bool IsScaled(const RasterHeader& raster)
{
  return raster.Scale != 1.0 || raster.Offset != 0.0;
}

//------------------------------------------------------------------------------
void ApplyScale(Raster& raster)
{
  if (!IsScaled(raster))
  {
    return;
  }
  vtkDataArray* stored = raster.Heights->GetPointData()->GetScalars();
  vtkNew<vtkFloatArray> heights;
  heights->SetName(stored->GetName());
  heights->SetNumberOfTuples(stored->GetNumberOfTuples());
  for (vtkIdType i = 0; i < stored->GetNumberOfTuples(); ++i)
  {
    const double value = stored->GetComponent(i, 0);
    const bool marked = raster.NoData && value == *raster.NoData;
    heights->SetValue(i,
      marked ? std::numeric_limits<float>::quiet_NaN()
             : static_cast<float>(raster.Scale * value + raster.Offset));
  }
  raster.Heights->GetPointData()->SetScalars(heights);
  raster.HasNaN.reset();
  raster.Ends.reset();
  raster.Scale = 1.0;
  raster.Offset = 0.0;
  raster.NoData.reset();
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> MakeMask(vtkImageData* alpha)
{
  auto mask = vtkSmartPointer<vtkImageData>::New();
  mask->CopyStructure(alpha);
  mask->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  auto* values = static_cast<unsigned char*>(mask->GetScalarPointer());
  vtkDataArray* shares = alpha->GetPointData()->GetScalars();
  for (vtkIdType i = 0; i < shares->GetNumberOfTuples(); ++i)
  {
    values[i] = shares->GetComponent(i, 0) > 0.0 ? 255 : 0;
  }
  return mask;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> MaskOfHeights(const Raster& raster)
{
  auto mask = vtkSmartPointer<vtkImageData>::New();
  mask->CopyStructure(raster.Heights);
  mask->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  mask->GetPointData()->GetScalars()->SetName("Mask");
  auto* values = static_cast<unsigned char*>(mask->GetScalarPointer());
  vtkDataArray* heights = raster.Heights->GetPointData()->GetScalars();
  const auto* own =
    raster.Mask ? static_cast<const unsigned char*>(raster.Mask->GetScalarPointer()) : nullptr;
  for (vtkIdType i = 0; i < heights->GetNumberOfTuples(); ++i)
  {
    const double height = heights->GetComponent(i, 0);
    const bool none =
      std::isnan(height) || (raster.NoData && height == *raster.NoData) || (own && own[i] == 0);
    values[i] = none ? 0 : 255;
  }
  return mask;
}

//------------------------------------------------------------------------------
void MarkMasked(Raster& raster, vtkImageData* mask, int scalarType)
{
  vtkDataArray* stored = raster.Heights->GetPointData()->GetScalars();
  vtkSmartPointer<vtkDataArray> heights = stored;
  if (scalarType != stored->GetDataType())
  {
    heights.TakeReference(vtkDataArray::CreateDataArray(scalarType));
    heights->SetName(stored->GetName());
    heights->DeepCopy(stored);
  }
  const auto* shown = static_cast<const unsigned char*>(mask->GetScalarPointer());
  for (vtkIdType i = 0; i < heights->GetNumberOfTuples(); ++i)
  {
    if (shown[i] == 0)
    {
      heights->SetComponent(i, 0, std::numeric_limits<double>::quiet_NaN());
    }
  }
  raster.Heights->GetPointData()->SetScalars(heights);
}

//------------------------------------------------------------------------------
std::array<double, 9> DirectionMatrix(const std::array<double, 2>& direction)
{
  const double c = direction[0];
  const double s = direction[1];
  return { c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0 };
}

//------------------------------------------------------------------------------
void SetSpacing(RasterHeader& raster, const std::array<double, 2>& spacing)
{
  const std::array<double, 2> stretched = { spacing[0] / raster.Spacing[0],
    spacing[1] / raster.Spacing[1] };
  if (raster.IsTurned() && std::abs(stretched[0] / stretched[1] - 1.0) > 1.0 - LeastScale)
  {
    std::ostringstream text;
    text << "a turned raster keeps the proportion of its samples, " << raster.Spacing[0] << " x "
         << raster.Spacing[1] << " m, and not " << spacing[0] << " x " << spacing[1];
    throw io::Failure(vtkErrorCode::FileFormatError, text.str());
  }
  raster.Spacing = spacing;
  raster.HeightUnit = 1.0;
  for (int k = 0; raster.Reference.Present && k < 2; ++k)
  {
    raster.MetersPerUnit[k] *= stretched[k];
  }
}

//------------------------------------------------------------------------------
void PlaceHeights(Raster& raster)
{
  if (!raster.Reference.Present)
  {
    raster.MapStep = raster.Spacing;
  }
  for (vtkImageData* image : { raster.Heights.Get(), raster.Mask.Get() })
  {
    if (image)
    {
      image->SetOrigin(0.0, 0.0, 0.0);
      image->SetSpacing(raster.Spacing[0], raster.Spacing[1], 1.0);
      image->SetDirectionMatrix(DirectionMatrix(raster.Direction).data());
    }
  }
}
}
