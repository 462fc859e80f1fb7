// SPDX-License-Identifier: BSD-3-Clause
#include "UndeclaredNoData.h"

#include "HeightRuns.h"
#include "ShortestText.h"

#include "vtkDataArray.h"
#include "vtkPointData.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

namespace relief::raster
{
namespace
{
/// Calls a step with every value that counts as a height so far.
template <class Step>
void ForHeights(const Raster& raster, const Step& step)
{
  const auto* all =
    raster.Mask ? static_cast<const unsigned char*>(raster.Mask->GetScalarPointer()) : nullptr;
  // A value that no sample has where there is none.
  const double none = raster.NoData.value_or(std::numeric_limits<double>::infinity());
  ForRuns(raster.Heights->GetPointData()->GetScalars(),
    [&](const auto* values, vtkIdType count, vtkIdType first)
    {
      const unsigned char* shown = all ? all + first : nullptr;
      for (vtkIdType i = 0; i < count; ++i)
      {
        const auto value = static_cast<double>(values[i]);
        if (std::isfinite(value) && value != none && (!shown || shown[i] != 0))
        {
          step(value);
        }
      }
    });
}

//------------------------------------------------------------------------------
void FindEnds(const Raster& raster, ValueEnds& ends)
{
  if (!raster.Mask && !raster.NoData)
  {
    // All that nearly every raster needs.
    std::array<double, 2> found = { ends.Lowest, ends.Highest };
    if (raster.Ends)
    {
      found = *raster.Ends;
    }
    else
    {
      ForRuns(raster.Heights->GetPointData()->GetScalars(),
        [&found](const auto* values, vtkIdType count, vtkIdType)
        { AddToEnds(values, count, found); });
    }
    ends.Lowest = found[0];
    ends.Highest = found[1];
    if (std::isfinite(ends.Lowest) && std::isfinite(ends.Highest))
    {
      return;
    }
    ends = ValueEnds();
  }
  ForHeights(raster,
    [&ends](double value)
    {
      ends.Lowest = std::min(ends.Lowest, value);
      ends.Highest = std::max(ends.Highest, value);
    });
}

//------------------------------------------------------------------------------
void FindSeconds(const Raster& raster, ValueEnds& ends)
{
  ends.Count = 0;
  ForHeights(raster,
    [&ends](double value)
    {
      ++ends.Count;
      ends.AtLowest += value == ends.Lowest ? 1 : 0;
      ends.AtHighest += value == ends.Highest ? 1 : 0;
      ends.SecondLowest =
        value > ends.Lowest ? std::min(ends.SecondLowest, value) : ends.SecondLowest;
      ends.SecondHighest =
        value < ends.Highest ? std::max(ends.SecondHighest, value) : ends.SecondHighest;
    });
}

//------------------------------------------------------------------------------
/// No height is as many of any unit in use.
constexpr double NoHeight = 1e9;

/// The numbers that files mark with.
bool IsUsual(double value)
{
  static const std::array<double, 13> usual = { -999.0, -9999.0, -99999.0, -999999.0, -9999999.0,
    -999.9, -9999.9, -32768.0, -32767.0, 9999.0, 99999.0, 32767.0, 65535.0 };
  return std::abs(value) >= NoHeight ||
    std::any_of(usual.begin(), usual.end(),
      [value](double one) { return std::abs(value - one) <= 1e-6 * std::abs(one); });
}

//------------------------------------------------------------------------------
/// Whether the file's numbers are known to be heights of a map, where gdalwarp fills what it turns
/// in with 0: corners of the raster, that is.
bool IsMarker(double value, const RasterHeader& header)
{
  return IsUsual(value) || (value == 0.0 && header.Reference.Present);
}

//------------------------------------------------------------------------------
void FindCorners(const Raster& part, int firstRow, int rows, ValueEnds& ends)
{
  vtkDataArray* heights = part.Heights->GetPointData()->GetScalars();
  const vtkIdType columns = part.Columns;
  const vtkIdType last = heights->GetNumberOfTuples() - 1;
  if (firstRow == 0)
  {
    ends.Corners[0] = heights->GetComponent(0, 0);
    ends.Corners[1] = heights->GetComponent(columns - 1, 0);
  }
  if (firstRow + part.Rows == rows)
  {
    ends.Corners[2] = heights->GetComponent(last - columns + 1, 0);
    ends.Corners[3] = heights->GetComponent(last, 0);
  }
}
}

//------------------------------------------------------------------------------
void ValueEnds::Add(const ValueEnds& other)
{
  const double lowest = std::min(this->Lowest, other.Lowest);
  const double highest = std::max(this->Highest, other.Highest);
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const double value : { this->Lowest, this->SecondLowest, other.Lowest, other.SecondLowest })
  {
    low = value > lowest ? std::min(low, value) : low;
  }
  for (const double value :
    { this->Highest, this->SecondHighest, other.Highest, other.SecondHighest })
  {
    high = value < highest ? std::max(high, value) : high;
  }
  this->AtLowest =
    (this->Lowest == lowest ? this->AtLowest : 0) + (other.Lowest == lowest ? other.AtLowest : 0);
  this->AtHighest = (this->Highest == highest ? this->AtHighest : 0) +
    (other.Highest == highest ? other.AtHighest : 0);
  this->Lowest = lowest;
  this->Highest = highest;
  this->SecondLowest = low;
  this->SecondHighest = high;
  this->Count += other.Count;
  for (std::size_t k = 0; k < this->Corners.size(); ++k)
  {
    this->Corners[k] = std::isnan(this->Corners[k]) ? other.Corners[k] : this->Corners[k];
  }
}

//------------------------------------------------------------------------------
ValueEnds EndsOfRows(const Raster& part, int firstRow, int rows)
{
  ValueEnds ends;
  FindEnds(part, ends);
  if (IsMarker(ends.Lowest, part) || IsMarker(ends.Highest, part))
  {
    FindSeconds(part, ends);
  }
  else
  {
    // If other rows have a marker, these ends are next to it.
    ForHeights(part, [&ends](double) { ++ends.Count; });
  }
  FindCorners(part, firstRow, rows, ends);
  return ends;
}

//------------------------------------------------------------------------------
std::string TellUndeclared(const ValueEnds& ends, const RasterHeader& header)
{
  const bool low = IsMarker(ends.Lowest, header);
  const bool high = IsMarker(ends.Highest, header);
  if (!(ends.Lowest < ends.Highest))
  {
    return std::string();
  }
  for (const bool below : { true, false })
  {
    const double value = below ? ends.Lowest : ends.Highest;
    const vtkIdType times = below ? ends.AtLowest : ends.AtHighest;
    const double next = below ? ends.SecondLowest : ends.SecondHighest;
    const double gap = std::abs(value - next);
    // How far the others reach. The other end may mark no data as well.
    const double rest = below ? (high ? ends.SecondHighest : ends.Highest) - next
                              : next - (low ? ends.SecondLowest : ends.Lowest);
    // What is also the white of a picture must have more than black beside it.
    const bool marks = value < 0.0 || value >= NoHeight || rest > 0.0;
    const bool inCorner =
      std::find(ends.Corners.begin(), ends.Corners.end(), value) != ends.Corners.end();
    const bool apart = value == 0.0 ? gap > rest && inCorner : gap > 0.5 * rest;
    if (!(below ? low : high) || times < 2 || !marks || !apart)
    {
      continue;
    }
    const auto digits = [&header](double number) {
      return header.ScalarType == VTK_FLOAT ? TextOf(static_cast<float>(number)) : TextOf(number);
    };
    std::ostringstream text;
    text << "its " << (below ? "lowest" : "highest") << " value, " << digits(value) << " in "
         << times << " of " << ends.Count << " samples, lies far from the next one, "
         << digits(next) << ", and is taken for a height; it looks like no data";
    return text.str();
  }
  return std::string();
}

//------------------------------------------------------------------------------
void WarnOfUndeclaredNoData(Raster& raster)
{
  ValueEnds ends;
  FindEnds(raster, ends);
  if (!IsMarker(ends.Lowest, raster) && !IsMarker(ends.Highest, raster))
  {
    return; // as nearly always, after one look at the heights
  }
  FindSeconds(raster, ends);
  FindCorners(raster, 0, raster.Rows, ends);
  RasterHeader header = raster;
  header.ScalarType = raster.Heights->GetScalarType();
  const std::string text = TellUndeclared(ends, header);
  if (!text.empty())
  {
    raster.Warnings.push_back({ text, Warning::NoData });
  }
}
}
