// SPDX-License-Identifier: BSD-3-Clause
#include "Field.h"

#include "MemoryBudget.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace
{

using namespace reliefviewer;

/// Least, greatest and mean height of the samples that have data.
struct Measure
{
  Field& Measured;

  template <class ArrayType>
  void operator()(ArrayType* heights) const
  {
    const reliefshade::Raster& raster = Measured.Heights;
    vtkDataArray* mask = raster.Mask ? raster.Mask->GetPointData()->GetScalars() : nullptr;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    double sum = 0.0;
    vtkIdType count = 0;
    vtkIdType at = -1;
    for (const auto stored : vtk::DataArrayValueRange<1>(heights))
    {
      ++at;
      const double height = static_cast<double>(stored);
      if (!std::isfinite(height) || (raster.NoData && height == *raster.NoData) ||
        (mask && mask->GetComponent(at, 0) == 0.0))
      {
        continue;
      }
      low = std::min(low, height);
      high = std::max(high, height);
      sum += height;
      ++count;
    }
    if (count > 0)
    {
      Measured.Lowest = low;
      Measured.Highest = high;
      Measured.Mean = sum / count;
    }
  }
};

}

namespace reliefviewer
{

//------------------------------------------------------------------------------
bool Field::HasData(vtkIdType sample) const
{
  const double height =
    this->Heights.Heights->GetPointData()->GetScalars()->GetComponent(sample, 0);
  return std::isfinite(height) && !(this->Heights.NoData && height == *this->Heights.NoData) &&
    !(this->Heights.Mask &&
      this->Heights.Mask->GetPointData()->GetScalars()->GetComponent(sample, 0) == 0.0);
}

//------------------------------------------------------------------------------
double Field::Size() const
{
  const double size = std::max(this->Length(0), this->Length(1));
  return size > 0.0 ? size : this->MeanSpacing();
}

//------------------------------------------------------------------------------
double Field::FittingScale() const
{
  const double range = this->Highest - this->Lowest;
  return range > 0.0 ? 0.1 * this->Size() / (range * this->Heights.HeightUnit) : 0.0;
}

//------------------------------------------------------------------------------
Field readField(const std::string& file, const reliefshade::ReadOptions& options)
{
  reliefshade::MemoryBudget budget(reliefshade::machineMemory());
  return makeField(reliefshade::readRaster(file, options, budget));
}

//------------------------------------------------------------------------------
Field makeField(reliefshade::Raster heights)
{
  Field field;
  field.Heights = std::move(heights);
  reliefshade::placeHeights(field.Heights);
  field.Frame = reliefshade::MapFrame(field.Heights);
  int size[3];
  field.Heights.Heights->GetDimensions(size);
  field.Samples = { size[0], size[1] };
  vtkDataArray* scalars = field.Heights.Heights->GetPointData()->GetScalars();
  const Measure measure{ field };
  if (!vtkArrayDispatch::Dispatch::Execute(scalars, measure))
  {
    measure(scalars);
  }
  return field;
}

}
