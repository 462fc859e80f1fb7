// SPDX-License-Identifier: BSD-3-Clause
#include "Raster.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkMath.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace
{

template <typename ArrayT>
void toNaN(ArrayT* heights, double noData)
{
  using ValueT = typename ArrayT::ValueType;
  if (!(std::abs(noData) <= std::numeric_limits<double>::max()))
  {
    return; // no finite value of this type is meant, and the others are no data in any case
  }
  // Four units in the last place of single precision.
  const double allowed = 4.0 * std::numeric_limits<float>::epsilon() * std::abs(noData);
  const vtkIdType count = heights->GetNumberOfValues();
  ValueT* values = heights->GetPointer(0);
  for (vtkIdType i = 0; i < count; ++i)
  {
    if (std::abs(values[i] - noData) <= allowed)
    {
      values[i] = std::numeric_limits<ValueT>::quiet_NaN();
    }
  }
}

}

namespace reliefshade
{

//------------------------------------------------------------------------------
std::array<double, 2> metresPerRadian(double latitude, double a, double f1)
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
MapGrid mapGrid(const GeoReference& reference, int rows)
{
  const std::array<double, 6>& t = reference.Transform;
  const double southRow = reference.SouthUp ? 0.5 : rows - 0.5;
  return { { t[0] + 0.5 * t[1], t[3] + southRow * t[5] }, { t[1], std::abs(t[5]) } };
}

//------------------------------------------------------------------------------
void placeOnMap(Raster& raster)
{
  int size[3];
  raster.Heights->GetDimensions(size);
  const MapGrid grid = mapGrid(raster.Reference, size[1]);
  raster.MapOrigin = grid.Origin;
  raster.MapStep = grid.Step;
}

//------------------------------------------------------------------------------
void spaceByDegrees(Raster& raster, double radians, double a, double f1)
{
  int size[3];
  raster.Heights->GetDimensions(size);
  const double centre = raster.MapOrigin[1] + 0.5 * (size[1] - 1) * raster.MapStep[1];
  const double latitude = centre * radians;
  if (!(std::abs(latitude) < 0.5 * vtkMath::Pi()))
  {
    throw std::runtime_error(
      "its centre lies at latitude " + std::to_string(centre) + ", beyond the pole");
  }
  const std::array<double, 2> metres = metresPerRadian(latitude, a, f1);
  raster.Spacing = { metres[0] * radians * raster.MapStep[0],
    metres[1] * radians * raster.MapStep[1] };
  raster.Geographic = true;
}

//------------------------------------------------------------------------------
void markNoData(Raster& raster)
{
  vtkDataArray* heights = raster.Heights->GetPointData()->GetScalars();
  if (!raster.NoData)
  {
    return;
  }
  if (auto* floats = vtkFloatArray::SafeDownCast(heights))
  {
    toNaN(floats, *raster.NoData);
  }
  else if (auto* doubles = vtkDoubleArray::SafeDownCast(heights))
  {
    toNaN(doubles, *raster.NoData);
  }
  else
  {
    return;
  }
  raster.NoData.reset();
}

//------------------------------------------------------------------------------
void applyScale(Raster& raster)
{
  if (raster.Scale == 1.0 && raster.Offset == 0.0)
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
  raster.Scale = 1.0;
  raster.Offset = 0.0;
  raster.NoData.reset();
}

}
