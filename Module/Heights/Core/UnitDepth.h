// SPDX-License-Identifier: BSD-3-Clause
#ifndef UnitDepth_h
#define UnitDepth_h

#include "HeightField.h"
#include "ParallelFor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace relief
{

/// Depth as a share of its range, in [0, 1]; NaN without data.
struct UnitDepth
{
  int columns = 0;
  int rows = 0;
  double aspect = 1.0; ///< the spacing along y by that along x
  std::vector<double> values;
  double halfRange = 0.0; ///< half the difference of the largest and the least; 0 without data
  bool hasBackground = false;

  std::size_t At(int i, int j) const { return static_cast<std::size_t>(j) * this->columns + i; }
};

/// Reads a caller's depth, whatever its type.
template <class T>
UnitDepth ReadUnitDepth(const HeightSource<T>& source, const ParallelFor& parallelFor);

//------------------------------------------------------------------------------
template <class T>
UnitDepth ReadUnitDepth(const HeightSource<T>& source, const ParallelFor& parallelFor)
{
  UnitDepth depth;
  depth.columns = source.columns;
  depth.rows = source.rows;
  depth.aspect = std::abs(source.spacingY / source.spacingX);
  depth.values.resize(static_cast<std::size_t>(source.columns) * source.rows);
  const std::optional<T> noData = source.hasNoData ? NoDataOf<T>(source.noData) : std::nullopt;
  struct Bounds
  {
    double least = std::numeric_limits<double>::infinity();
    double largest = -std::numeric_limits<double>::infinity();
    bool gaps = false;
  };
  std::vector<Bounds> bounds(static_cast<std::size_t>(source.rows));
  parallelFor(source.rows,
    [&](int begin, int end)
    {
      for (int j = begin; j < end; ++j)
      {
        Bounds& row = bounds[j];
        for (int i = 0; i < source.columns; ++i)
        {
          const T stored = source.data[i * source.stepX + j * source.stepY];
          // Halves have a finite difference, however large they are.
          double half = 0.5 * static_cast<double>(stored);
          const bool has = std::isfinite(half) && !(noData && stored == *noData) &&
            !(source.hasData && !source.hasData(i, j));
          half = has ? half : std::numeric_limits<double>::quiet_NaN();
          row.least = has ? std::min(row.least, half) : row.least;
          row.largest = has ? std::max(row.largest, half) : row.largest;
          row.gaps = row.gaps || !has;
          depth.values[depth.At(i, j)] = half;
        }
      }
    });
  Bounds all;
  for (const Bounds& row : bounds)
  {
    all.least = std::min(all.least, row.least);
    all.largest = std::max(all.largest, row.largest);
    all.gaps = all.gaps || row.gaps;
  }
  depth.hasBackground = all.gaps;
  depth.halfRange = all.largest > all.least ? all.largest - all.least : 0.0;
  const double divisor = depth.halfRange > 0.0 ? depth.halfRange : 1.0;
  parallelFor(source.rows,
    [&](int begin, int end)
    {
      for (std::size_t k = depth.At(0, begin); k < depth.At(0, end); ++k)
      {
        depth.values[k] = (depth.values[k] - all.least) / divisor;
      }
    });
  return depth;
}

}

#endif
