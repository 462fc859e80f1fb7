// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightRuns_h
#define HeightRuns_h

#include "PaddedHeights.h"

#include "vtkDataArray.h"

#include <algorithm>
#include <array>
#include <limits>

namespace relief::raster
{
template <class T, class Step>
void ForRunsOf(T* values, vtkIdType count, const Step& step)
{
  constexpr vtkIdType most = 1 << 14;
  for (vtkIdType first = 0; first < count; first += most)
  {
    step(values + first, std::min(most, count - first), first);
  }
}

/// The least and the greatest of some values, beside those that there are; NaN is none of them. In
/// lanes, for compilers that make vectors of them.
template <class T>
void AddToEnds(const T* values, vtkIdType count, std::array<double, 2>& ends)
{
  constexpr int lanes = 16;
  std::array<T, lanes> lowest;
  std::array<T, lanes> highest;
  lowest.fill(std::numeric_limits<T>::max());
  highest.fill(std::numeric_limits<T>::lowest());
  const auto add = [&](T value, std::size_t lane)
  {
    lowest[lane] = value < lowest[lane] ? value : lowest[lane];
    highest[lane] = value > highest[lane] ? value : highest[lane];
  };
  vtkIdType i = 0;
  for (; i + lanes <= count; i += lanes)
  {
    for (int k = 0; k < lanes; ++k)
    {
      add(values[i + k], k);
    }
  }
  for (; i < count; ++i)
  {
    add(values[i], 0);
  }
  // Where there was none they are no ends.
  const T low = *std::min_element(lowest.begin(), lowest.end());
  const T high = *std::max_element(highest.begin(), highest.end());
  if (low <= high)
  {
    ends[0] = std::min(ends[0], static_cast<double>(low));
    ends[1] = std::max(ends[1], static_cast<double>(high));
  }
}

/// Calls step(values, count, first) with all heights of an array, in runs that lie in one piece of
/// memory and in the cache; `first` is the place of a run among all heights.
template <class Step>
void ForRuns(vtkDataArray* heights, const Step& step)
{
  if (auto* padded = hosts::PaddedHeights::SafeDownCast(heights))
  {
    for (vtkIdType j = 0; j < padded->GetRows(); ++j)
    {
      step(padded->GetRow(j), padded->GetColumns(), j * padded->GetColumns());
    }
    return;
  }
  switch (heights->GetDataType())
  {
    vtkTemplateMacro(ForRunsOf(
      static_cast<VTK_TT*>(heights->GetVoidPointer(0)), heights->GetNumberOfTuples(), step));
  }
}
}

#endif
