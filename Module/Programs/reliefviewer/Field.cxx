// SPDX-License-Identifier: BSD-3-Clause
#include "Field.h"

#include "HeightScaling.h"
#include "HeightSummary.h"
#include "MeshHeights.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <utility>

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
vtkIdType Field::SampleAt(double x, double y) const
{
  const std::array<double, 2>& d = this->Heights.Direction;
  const long i = std::lround((x * d[0] + y * d[1]) / this->Heights.Spacing[0]);
  const long j = std::lround((y * d[0] - x * d[1]) / this->Heights.Spacing[1]);
  const bool inside = i >= 0 && j >= 0 && i < this->Samples[0] && j < this->Samples[1];
  return inside ? static_cast<vtkIdType>(j) * this->Samples[0] + i : -1;
}

//------------------------------------------------------------------------------
double Field::Size() const
{
  const double size = std::max(this->Length(0), this->Length(1));
  return size > 0.0 ? size : this->MeanSpacing();
}

//------------------------------------------------------------------------------
Field readField(const std::string& file, const reliefshade::ReadOptions& options)
{
  reliefshade::MemoryBudget budget(reliefshade::machineMemory(), "this machine");
  Field field = makeField(reliefshade::isMesh(file)
      ? reliefshade::readMesh(file, reliefshade::MeshView(), budget, 0.0)
      : reliefshade::readRaster(file, options, budget));
  field.Reading = options;
  return field;
}

//------------------------------------------------------------------------------
Field withMask(const Field& field, const std::string& heights, const std::string& file,
  const reliefshade::ReadOptions& options)
{
  reliefshade::MemoryBudget budget(reliefshade::machineMemory(), "this machine");
  reliefshade::Raster raster = field.Heights;
  raster.Mask = field.OwnMask;
  reliefshade::addMask(file, options, heights, budget, raster);
  Field masked = makeField(std::move(raster));
  masked.Reading = field.Reading;
  masked.MaskFile = file;
  masked.MaskReading = options;
  masked.OwnMask = field.OwnMask;
  return masked;
}

//------------------------------------------------------------------------------
Field withoutMask(const Field& field)
{
  reliefshade::Raster raster = field.Heights;
  raster.Mask = field.OwnMask;
  Field own = makeField(std::move(raster));
  own.Reading = field.Reading;
  return own;
}

//------------------------------------------------------------------------------
Field makeField(reliefshade::Raster heights)
{
  Field field;
  field.Heights = std::move(heights);
  field.OwnMask = field.Heights.Mask;
  relief::raster::PlaceHeights(field.Heights);
  field.Frame = reliefshade::MapFrame(field.Heights);
  int size[3];
  field.Heights.Heights->GetDimensions(size);
  field.Samples = { size[0], size[1] };
  const double* bounds = field.Heights.Heights->GetBounds();
  field.Corner = { bounds[0], bounds[2] };
  field.Reach = { bounds[1] - bounds[0], bounds[3] - bounds[2] };
  vtkDataArray* scalars = field.Heights.Heights->GetPointData()->GetScalars();
  const reliefshade::Raster& raster = field.Heights;
  const relief::hosts::HeightSummary summary = relief::hosts::SummarizeHeights(scalars,
    raster.Mask ? raster.Mask->GetPointData()->GetScalars() : nullptr, raster.NoData.has_value(),
    raster.NoData.value_or(0.0));
  if (summary.HasData())
  {
    field.Lowest = summary.least;
    field.Highest = summary.greatest;
    field.Mean = summary.mean;
  }
  field.FittingScale = reliefshade::fittingHeightScale(raster);
  field.UsualScale =
    relief::raster::HasLengths(raster) || field.FittingScale == 0.0 ? 1.0 : field.FittingScale;
  return field;
}

}
