// SPDX-License-Identifier: BSD-3-Clause
#ifndef UndeclaredNoData_h
#define UndeclaredNoData_h

#include "Raster.h"

#include <array>
#include <limits>
#include <string>

namespace relief::raster
{
/// The ends of a raster's stored values, and the next ones to them, of what counts as a height.
struct ValueEnds
{
  double Lowest = std::numeric_limits<double>::infinity();
  double Highest = -std::numeric_limits<double>::infinity();
  ///@{
  /// Looked for where that end is a value that files mark with.
  double SecondLowest = std::numeric_limits<double>::infinity();
  double SecondHighest = -std::numeric_limits<double>::infinity();
  vtkIdType AtLowest = 0;
  vtkIdType AtHighest = 0;
  ///@}
  vtkIdType Count = 0;
  /// The corner samples, whatever they are.
  std::array<double, 4> Corners{ std::numeric_limits<double>::quiet_NaN(),
    std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN(),
    std::numeric_limits<double>::quiet_NaN() };

  /// Adds those of other samples. Corners that are there stay.
  void Add(const ValueEnds& other);
};

/// Those of whole rows of a raster with so many rows in all, in the file's values and after
/// MarkNoData; `firstRow` is the row of the part's first.
ValueEnds EndsOfRows(const Raster& part, int firstRow, int rows);

/// What to warn of if that is so (WarnOfUndeclaredNoData), by what is known of all samples of a
/// raster that has this header; else an empty text.
std::string TellUndeclared(const ValueEnds& ends, const RasterHeader& header);

/// Warns if heights, in the file's values and after MarkNoData, look as if they held a value that
/// means no data and that nobody declared: the lowest or the highest one, several times, far from
/// all others, and one that is used so.
VTKIORELIEFRASTER_EXPORT void WarnOfUndeclaredNoData(Raster& raster);
}

#endif
