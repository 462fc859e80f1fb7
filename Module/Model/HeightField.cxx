// SPDX-License-Identifier: BSD-3-Clause
#include "HeightField.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <mutex>
#include <sstream>
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

// Empty, or what is wrong: the differences of differences of heights must be numbers too.
std::string CheckRelief(const Range& range)
{
  constexpr double most = std::numeric_limits<float>::max() / 16.0;
  if (!(range.hi - range.lo > most))
  {
    return std::string();
  }
  std::ostringstream message;
  message << "heights reach from " << range.lo << " to " << range.hi << ", a relief of at most "
          << most << " is expected; a value that means no data is told by the nodata value";
  return message.str();
}

// Turns a caller's rows into heights.
template <class T>
class RowReader
{
public:
  explicit RowReader(const HeightSource<T>& source)
    : Source(source)
    , NoData(static_cast<T>(0))
    , HasNoData(source.hasNoData)
  {
    // A nodata value is compared in the type of the samples, in which files store it.
    if constexpr (std::is_integral_v<T>)
    {
      this->HasNoData = this->HasNoData && std::floor(source.noData) == source.noData &&
        source.noData >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
        source.noData <= static_cast<double>(std::numeric_limits<T>::max());
      this->NoData = static_cast<T>(this->HasNoData ? source.noData : 0.0);
    }
    else
    {
      // The largest float is often written with so few digits that it reads a little larger.
      constexpr double largest = std::numeric_limits<T>::max();
      this->HasNoData = this->HasNoData && std::abs(source.noData) / (1.0 + 2e-8) <= largest;
      this->NoData = static_cast<T>(std::clamp(source.noData, -largest, largest));
    }
  }

  // Heights as lengths above the datum, NaN without data. Real is double where float may not do.
  template <class Real>
  void Read(int j, double datum, Real* row) const
  {
    const T* values = this->Source.data + j * this->Source.stepY;
    const std::ptrdiff_t step = this->Source.stepX;
    const int columns = this->Source.columns;
    const double scale = this->Source.scale;
    if (step == 1)
    {
      for (int i = 0; i < columns; ++i)
      {
        row[i] = static_cast<Real>(static_cast<double>(values[i]) * scale - datum);
      }
    }
    else
    {
      for (int i = 0; i < columns; ++i)
      {
        row[i] = static_cast<Real>(static_cast<double>(values[i * step]) * scale - datum);
      }
    }
    const Real none = std::numeric_limits<Real>::quiet_NaN();
    if constexpr (std::is_floating_point_v<T>)
    {
      for (int i = 0; i < columns; ++i)
      {
        // False for NaN.
        bool finite = std::abs(values[i * step]) <= std::numeric_limits<T>::max();
        row[i] = finite ? row[i] : none;
      }
    }
    if (this->HasNoData)
    {
      for (int i = 0; i < columns; ++i)
      {
        row[i] = values[i * step] == this->NoData ? none : row[i];
      }
    }
    if (this->Source.hasData)
    {
      for (int i = 0; i < columns; ++i)
      {
        row[i] = this->Source.hasData(i, j) ? row[i] : none;
      }
    }
  }

  // Whether float values can be used as they stand: nothing to change and no infinity among them.
  bool IsPlain(const float* row, int j) const
  {
    bool plain = this->Source.scale == 1.0 && !this->HasNoData && !this->Source.hasData;
    const T* values = this->Source.data + j * this->Source.stepY;
    for (int i = 0; plain && i < this->Source.columns; ++i)
    {
      plain =
        !std::isnan(row[i]) || values[i * this->Source.stepX] != values[i * this->Source.stepX];
    }
    return plain;
  }

private:
  const HeightSource<T>& Source;
  T NoData;
  bool HasNoData;
};

template <class Real>
void AddToRange(const Real* row, int columns, Range& range)
{
  Real lo = std::numeric_limits<Real>::infinity();
  Real hi = -lo;
  for (int i = 0; i < columns; ++i)
  {
    lo = row[i] < lo ? row[i] : lo;
    hi = row[i] > hi ? row[i] : hi;
  }
  range.Add(lo, hi);
}

}

template <class T>
std::string HeightField::Assign(
  const HeightSource<T>& source, const ParallelFor& parallelFor, bool padded)
{
  static std::atomic<std::uint64_t> versions{ 0 };
  this->Version = ++versions;
  const RowReader<T> reader(source);
  const float none = std::numeric_limits<float>::quiet_NaN();
  HeightView<float>& view = this->Prepared.heights;
  view.columns = source.columns;
  view.rows = source.rows;
  view.spacingX = source.spacingX;
  view.spacingY = source.spacingY;
  this->MissingRow = nullptr;
  std::mutex mutex;

  bool inPlace = false;
  if constexpr (std::is_same_v<T, float>)
  {
    if (!padded)
    {
      Range range;
      inPlace = true;
      parallelFor(source.rows,
        [&](int begin, int end)
        {
          std::vector<float> row(source.columns);
          Range part;
          bool plain = true;
          for (int j = begin; j < end && plain; ++j)
          {
            reader.Read(j, 0.0, row.data());
            plain = reader.IsPlain(row.data(), j);
            AddToRange(row.data(), source.columns, part);
          }
          std::lock_guard<std::mutex> lock(mutex);
          inPlace = inPlace && plain;
          range.Add(part.lo, part.hi);
        });
      if (inPlace)
      {
        const std::string wrong = CheckRelief(range);
        if (!wrong.empty())
        {
          return wrong;
        }
        this->Copy = std::vector<float>();
        this->Datum = 0.0;
        this->Bottom = static_cast<float>(range.lo);
        this->Top = static_cast<float>(range.hi);
        view.data = source.data;
        view.stepX = source.stepX;
        view.stepY = source.stepY;
      }
    }
  }

  if (!inPlace)
  {
    const int margin = padded ? Padding : 0;
    const std::size_t pitch = static_cast<std::size_t>(source.columns) + 2 * margin;
    this->Copy.resize(pitch * (static_cast<std::size_t>(source.rows) + (padded ? 1 : 0)));
    float* first = this->Copy.data() + margin;

    auto copy = [&](double datum)
    {
      Range range;
      parallelFor(source.rows,
        [&](int begin, int end)
        {
          Range part;
          for (int j = begin; j < end; ++j)
          {
            float* row = first + static_cast<std::size_t>(j) * pitch;
            std::fill_n(row - margin, margin, none);
            reader.Read(j, datum, row);
            std::fill_n(row + source.columns, margin, none);
            AddToRange(row, source.columns, part);
          }
          std::lock_guard<std::mutex> lock(mutex);
          range.Add(part.lo, part.hi);
        });
      return range;
    };
    auto exactRange = [&]()
    {
      Range range;
      std::vector<double> row(source.columns);
      for (int j = 0; j < source.rows; ++j)
      {
        reader.Read(j, 0.0, row.data());
        AddToRange(row.data(), source.columns, range);
      }
      return range;
    };
    this->Datum = 0.0;
    Range range = copy(0.0);
    const double largest = std::max(std::abs(range.lo), std::abs(range.hi));
    const bool hasData = range.hi >= range.lo;
    // Float input has no more digits to keep.
    if (hasData && !std::is_same_v<T, float> && largest > 64.0 * (range.hi - range.lo))
    {
      const Range exact = exactRange();
      this->Datum = exact.lo + (exact.hi - exact.lo) / 2.0;
      range = copy(this->Datum);
    }
    if (hasData && (std::isinf(range.lo) || std::isinf(range.hi)))
    {
      const Range exact = exactRange();
      std::ostringstream message;
      message << "heights reach from " << exact.lo << " to " << exact.hi
              << ", numbers within single precision (3.4e38) are expected";
      return message.str();
    }
    const std::string wrong = CheckRelief(range);
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
    view.data = first;
    view.stepX = 1;
    view.stepY = static_cast<std::ptrdiff_t>(pitch);
  }

  this->Pyramid.Allocate(source.columns, source.rows);
  parallelFor(this->Pyramid.GetNumberOfBaseRows(),
    [&](int begin, int end) { this->Pyramid.BuildBase(view, begin, end); });
  this->Pyramid.BuildUpper();
  this->Prepared.top = this->Top;
  this->Prepared.bounds = &this->Pyramid;
  return std::string();
}

#define RELIEF_INSTANTIATE(T)                                                                      \
  template std::string HeightField::Assign(const HeightSource<T>&, const ParallelFor&, bool)
RELIEF_INSTANTIATE(char);
RELIEF_INSTANTIATE(signed char);
RELIEF_INSTANTIATE(unsigned char);
RELIEF_INSTANTIATE(short);
RELIEF_INSTANTIATE(unsigned short);
RELIEF_INSTANTIATE(int);
RELIEF_INSTANTIATE(unsigned int);
RELIEF_INSTANTIATE(long);
RELIEF_INSTANTIATE(unsigned long);
RELIEF_INSTANTIATE(long long);
RELIEF_INSTANTIATE(unsigned long long);
RELIEF_INSTANTIATE(float);
RELIEF_INSTANTIATE(double);
#undef RELIEF_INSTANTIATE

}
