// SPDX-License-Identifier: BSD-3-Clause
#include "HeightField.h"

#include "HeightReader.h"
#include "HeightRows.h"
#include "HeightTypes.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <string>
#include <type_traits>

namespace relief
{

namespace
{

// Least and greatest height.
struct Range
{
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();

  void Add(double low, double high)
  {
    this->lo = low < this->lo ? low : this->lo;
    this->hi = high > this->hi ? high : this->hi;
  }
};

// Six digits, as streams write them: where the model is all of a program, they would be most of it.
std::string NumberText(double value)
{
  if (value == 0.0 || !std::isfinite(value))
  {
    return value == 0.0 ? "0" : value > 0.0 ? "inf" : "-inf";
  }
  double size = std::abs(value);
  int exponent = static_cast<int>(std::floor(std::log10(size)));
  size = std::round(size * std::pow(10.0, -exponent) * 1e5);
  exponent += size >= 1e6 ? 1 : 0;
  std::string digits = std::to_string(static_cast<long>(size >= 1e6 ? size / 10.0 : size));
  const bool plain = exponent >= 0 && exponent < 6;
  digits.insert(plain ? static_cast<std::size_t>(exponent) + 1 : 1, ".");
  digits.erase(digits.find_last_not_of('0') + 1);
  digits.erase(digits.find_last_not_of('.') + 1);
  const std::string sign = value < 0.0 ? "-" : "";
  const std::string power = std::to_string(std::abs(exponent));
  return sign + digits +
    (plain ? std::string()
           : (exponent < 0 ? "e-" : "e+") + std::string(power.size() < 2 ? "0" : "") + power);
}

void AddRowToRange(const float* row, int columns, Range& range)
{
  float lo = std::numeric_limits<float>::infinity();
  float hi = -lo;
  AddToRange(row, columns, lo, hi);
  range.Add(lo, hi);
}

void AddRowToRange(const double* row, int columns, Range& range)
{
  for (int i = 0; i < columns; ++i)
  {
    range.Add(row[i], row[i]);
  }
}

// Adds what body(begin, end, part) finds in rows, in parallel.
template <class Body>
Range RangeOfRows(int rows, const ParallelFor& parallelFor, Body&& body)
{
  Range range;
  std::mutex mutex;
  parallelFor(rows,
    [&](int begin, int end)
    {
      Range part;
      body(begin, end, part);
      std::lock_guard<std::mutex> lock(mutex);
      range.Add(part.lo, part.hi);
    });
  return range;
}

// In double, whatever the datum.
template <class T>
Range ExactRange(
  const HeightSource<T>& source, const HeightReader<T>& reader, const ParallelFor& parallelFor)
{
  return RangeOfRows(source.rows, parallelFor,
    [&](int begin, int end, Range& part)
    {
      std::vector<double> row(source.columns);
      for (int j = begin; j < end; ++j)
      {
        reader.Read(j, 0.0, row.data());
        AddRowToRange(row.data(), source.columns, part);
      }
    });
}

// Bands of rows, each as high as a block; at least one.
constexpr int Band = MinMaxPyramid::BlockSize;

int CountBands(int rows)
{
  return std::max((rows - 1 + Band - 1) / Band, 1);
}

}

double HeightField::FindDatum(double lo, double hi, bool floats)
{
  // By the heights as float has them.
  const double low = static_cast<float>(lo);
  const double high = static_cast<float>(hi);
  const double largest = std::max(std::abs(low), std::abs(high));
  return high >= low && !floats && largest > 64.0 * (high - low) ? lo + (hi - lo) / 2.0 : 0.0;
}

// The differences of differences of heights must be numbers too.
std::string HeightField::CheckRange(double lo, double hi)
{
  constexpr double most = std::numeric_limits<float>::max() / 16.0;
  if (!(hi - lo > most))
  {
    return std::string();
  }
  return "heights reach from " + NumberText(lo) + " to " + NumberText(hi) +
    ", a relief of at most " + NumberText(most) +
    " is expected; a value that means no data is told by the nodata value";
}

std::uint64_t HeightField::NextVersion()
{
  static std::atomic<std::uint64_t> versions{ 0 };
  return ++versions;
}

template <class T>
std::string HeightField::Assign(
  const HeightSource<T>& source, const ParallelFor& parallelFor, bool padded)
{
  this->Version = NextVersion();
  HeightView<float>& view = this->Prepared.heights;
  view.columns = source.columns;
  view.rows = source.rows;
  view.spacingX = source.spacingX;
  view.spacingY = source.spacingY;
  this->MissingRow = nullptr;
  this->Pyramid.Allocate(source.columns, source.rows);
  // The sweep's vectors go on behind the last window, a tile's worth and what one has more.
  constexpr int margin = 2 * Padding;
  this->Windows.Allocate(padded ? source.columns : 0, padded ? source.rows : 0, margin);
  std::string wrong;
  bool inPlace = false;
  if constexpr (std::is_same_v<T, float>)
  {
    inPlace = (!padded || (source.margin >= Padding && source.stepX == 1)) &&
      this->AssignInPlace(source, parallelFor, wrong);
    this->MissingRow = inPlace && padded ? source.data + source.rows * source.stepY : nullptr;
  }
  if (!inPlace)
  {
    wrong = this->AssignCopy(source, parallelFor, padded);
  }
  if (!wrong.empty())
  {
    return wrong;
  }

  this->Pyramid.BuildUpper();
  for (int size = 0; size < NumberOfSquares; ++size)
  {
    this->Squares[size].Build(
      this->Pyramid, size, padded ? GetNumberOfBlocks(size) : 0, parallelFor);
  }
  this->Prepared.top = this->Top;
  this->Prepared.bounds = &this->Pyramid;
  return std::string();
}

void HeightField::BoundBand(int band, const float* const* rows, int count)
{
  this->Pyramid.BuildBaseRow(band, rows, std::min(count, Band + 1));
  const int end =
    std::min((band + 1) * Band / HeightWindows::Step, this->Windows.GetNumberOfRows());
  for (int row = band * Band / HeightWindows::Step; row < end; ++row)
  {
    const int first = row * HeightWindows::Step - band * Band;
    this->Windows.BuildRow(row, rows + first, std::min(count - first, HeightWindows::Size + 1));
  }
}

bool HeightField::AssignInPlace(
  const HeightSource<float>& source, const ParallelFor& parallelFor, std::string& wrong)
{
  const bool marked = source.hasNoData && NoDataOf<float>(source.noData);
  if (source.scale != 1.0 || marked || source.hasData)
  {
    return false;
  }
  HeightView<float>& view = this->Prepared.heights;
  view.data = source.data;
  view.stepX = source.stepX;
  view.stepY = source.stepY;
  Range range;
  if (source.stepX == 1)
  {
    const int bands = CountBands(source.rows);
    range = RangeOfRows(bands, parallelFor,
      [&](int begin, int end, Range& part)
      {
        for (int band = begin; band < end; ++band)
        {
          const float* rows[RowsOfBand];
          int count = 0;
          for (int j = band * Band; j < source.rows && count < RowsOfBand; ++j, ++count)
          {
            rows[count] = source.data + j * source.stepY;
            if (count < Band || band + 1 == bands)
            {
              AddRowToRange(rows[count], source.columns, part);
            }
          }
          this->BoundBand(band, rows, count);
        }
      });
  }
  else
  {
    range = RangeOfRows(source.rows, parallelFor,
      [&](int begin, int end, Range& part)
      {
        for (int j = begin; j < end; ++j)
        {
          for (int i = 0; i < source.columns; ++i)
          {
            part.Add(view.At(i, j), view.At(i, j));
          }
        }
      });
    parallelFor(this->Pyramid.GetNumberOfBaseRows(),
      [&](int begin, int end) { this->Pyramid.BuildBase(view, begin, end); });
  }
  if (range.hi == std::numeric_limits<double>::infinity() ||
    range.lo == -std::numeric_limits<double>::infinity())
  {
    return false; // a height that is infinite is none
  }
  wrong = CheckRange(range.lo, range.hi);
  if (wrong.empty())
  {
    this->Copy.Allocate(0);
    this->Datum = 0.0;
    this->Bottom = static_cast<float>(range.lo);
    this->Top = static_cast<float>(range.hi);
  }
  return true;
}

template <class T>
std::string HeightField::AssignCopy(
  const HeightSource<T>& source, const ParallelFor& parallelFor, bool padded)
{
  const HeightReader<T> reader(source);
  const float none = std::numeric_limits<float>::quiet_NaN();
  const int margin = padded ? Padding : 0;
  const std::size_t pitch = static_cast<std::size_t>(source.columns) + 2 * margin;
  this->Copy.Allocate(pitch * (static_cast<std::size_t>(source.rows) + (padded ? 1 : 0)));
  float* first = this->Copy.data() + margin;
  auto rowAt = [&](int j) { return first + static_cast<std::size_t>(j) * pitch; };
  const int bands = CountBands(source.rows);
  // Bounds are found while a band's heights are in the cache. Rows behind its own, which close its
  // blocks and windows, may be another part's.
  auto copy = [&](double datum)
  {
    return RangeOfRows(bands, parallelFor,
      [&](int begin, int end, Range& part)
      {
        const int endRow = end < bands ? end * Band : source.rows;
        std::vector<float> beyond;
        int next = begin * Band;
        for (int band = begin; band < end; ++band)
        {
          const int last = std::min(band * Band + RowsOfBand, source.rows);
          for (; next < std::min(last, endRow); ++next)
          {
            float* row = rowAt(next);
            std::fill_n(row - margin, margin, none);
            reader.Read(next, datum, row);
            std::fill_n(row + source.columns, margin, none);
            AddRowToRange(row, source.columns, part);
          }
          const std::size_t columns = source.columns;
          beyond.resize(columns * std::max(last - endRow, 0));
          const float* rows[RowsOfBand];
          for (int j = band * Band; j < last; ++j)
          {
            float* row = j < endRow ? rowAt(j) : beyond.data() + columns * (j - endRow);
            if (j >= endRow)
            {
              reader.Read(j, datum, row);
            }
            rows[j - band * Band] = row;
          }
          this->BoundBand(band, rows, last - band * Band);
        }
      });
  };

  this->Datum = 0.0;
  Range range = copy(0.0);
  const bool hasData = range.hi >= range.lo;
  if (FindDatum(range.lo, range.hi, std::is_same_v<T, float>) != 0.0)
  {
    const Range exact = ExactRange(source, reader, parallelFor);
    this->Datum = FindDatum(exact.lo, exact.hi, false);
    range = copy(this->Datum);
  }
  if (hasData && (std::isinf(range.lo) || std::isinf(range.hi)))
  {
    const Range exact = ExactRange(source, reader, parallelFor);
    return "heights reach from " + NumberText(exact.lo) + " to " + NumberText(exact.hi) +
      ", numbers within single precision (3.4e38) are expected";
  }
  const std::string wrong = CheckRange(range.lo, range.hi);
  if (!wrong.empty())
  {
    return wrong;
  }
  this->Bottom = static_cast<float>(range.lo);
  this->Top = static_cast<float>(range.hi);
  if (padded)
  {
    float* missing = first + static_cast<std::size_t>(source.rows) * pitch;
    std::fill_n(missing - margin, pitch, none);
    this->MissingRow = missing;
  }
  this->Prepared.heights.data = first;
  this->Prepared.heights.stepX = 1;
  this->Prepared.heights.stepY = static_cast<std::ptrdiff_t>(pitch);
  return std::string();
}

#define RELIEF_INSTANTIATE(T)                                                                      \
  template std::string HeightField::Assign(const HeightSource<T>&, const ParallelFor&, bool)
RELIEF_FOR_HEIGHT_TYPES(RELIEF_INSTANTIATE);
#undef RELIEF_INSTANTIATE

}
