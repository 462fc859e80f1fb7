// SPDX-License-Identifier: BSD-3-Clause
#include "HeightSummary.h"

#include "HeightField.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace relief::hosts
{
namespace
{
struct Worker
{
  vtkDataArray* Mask;
  bool UseNoData;
  double NoData;
  HeightSummary Result;

  template <class ArrayType>
  void operator()(ArrayType* array)
  {
    using T = vtk::GetAPIType<ArrayType>;
    const std::optional<T> noData =
      this->UseNoData ? NoDataOf<T>(this->NoData) : std::optional<T>();
    const vtkIdType masked = this->Mask ? this->Mask->GetNumberOfTuples() : 0;
    double least = std::numeric_limits<double>::infinity();
    double greatest = -least;
    double sum = 0.0;
    vtkIdType at = 0;
    for (const auto tuple : vtk::DataArrayTupleRange(array))
    {
      const T stored = tuple[0];
      const auto height = static_cast<double>(stored);
      const double mask = at < masked ? this->Mask->GetComponent(at, 0) : 1.0;
      ++at;
      if (std::isfinite(height) && stored != noData && mask == mask && mask != 0.0)
      {
        least = std::min(least, height);
        greatest = std::max(greatest, height);
        sum += height;
        ++this->Result.samples;
      }
    }
    if (this->Result.HasData())
    {
      this->Result.least = least;
      this->Result.greatest = greatest;
      this->Result.mean = sum / static_cast<double>(this->Result.samples);
    }
  }
};
}

//------------------------------------------------------------------------------
HeightSummary SummarizeHeights(
  vtkDataArray* heights, vtkDataArray* mask, bool useNoData, double noData)
{
  Worker worker{ mask, useNoData, noData, {} };
  if (heights->GetNumberOfComponents() == 1 && vtkArrayDispatch::Dispatch::Execute(heights, worker))
  {
    return worker.Result;
  }
  worker(heights);
  return worker.Result;
}
}
