// SPDX-License-Identifier: BSD-3-Clause
#include "HeightField.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <sstream>
#include <type_traits>

namespace relief
{

namespace
{

// What one pass over the caller's values tells.
struct Survey
{
  double lo = std::numeric_limits<double>::infinity();
  double hi = -std::numeric_limits<double>::infinity();
  bool plain = true; // float samples can be used as they are

  void Add(const Survey& other)
  {
    this->lo = std::min(this->lo, other.lo);
    this->hi = std::max(this->hi, other.hi);
    this->plain = this->plain && other.plain;
  }
};

// A sample's height as a length, NaN without data.
template <class T>
class SampleReader
{
public:
  explicit SampleReader(const HeightSource<T>& source)
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
    }
    else
    {
      this->HasNoData = this->HasNoData &&
        std::abs(source.noData) <= static_cast<double>(std::numeric_limits<T>::max());
    }
    if (this->HasNoData)
    {
      this->NoData = static_cast<T>(source.noData);
    }
  }

  double Height(int i, int j) const
  {
    T value = this->Source.data[i * this->Source.stepX + j * this->Source.stepY];
    bool missing = (this->HasNoData && value == this->NoData) ||
      (this->Source.hasData && !this->Source.hasData(i, j));
    if constexpr (std::is_floating_point_v<T>)
    {
      missing = missing || !std::isfinite(value);
    }
    return missing ? std::numeric_limits<double>::quiet_NaN()
                   : static_cast<double>(value) * this->Source.scale;
  }

  /// Whether the caller's own value says all that Height() says.
  bool IsPlain(double height, int i, int j) const
  {
    return !std::isnan(height) ||
      std::isnan(
        static_cast<double>(this->Source.data[i * this->Source.stepX + j * this->Source.stepY]));
  }

private:
  const HeightSource<T>& Source;
  T NoData;
  bool HasNoData;
};

}

template <class T>
std::string HeightField::Assign(
  const HeightSource<T>& source, const ParallelFor& parallelFor, bool padded)
{
  SampleReader<T> reader(source);
  Survey survey;
  std::mutex mutex;
  parallelFor(source.rows,
    [&](int begin, int end)
    {
      Survey part;
      for (int j = begin; j < end; ++j)
      {
        for (int i = 0; i < source.columns; ++i)
        {
          double height = reader.Height(i, j);
          part.lo = height < part.lo ? height : part.lo;
          part.hi = height > part.hi ? height : part.hi;
          part.plain = part.plain && reader.IsPlain(height, i, j);
        }
      }
      std::lock_guard<std::mutex> lock(mutex);
      survey.Add(part);
    });

  bool hasData = survey.hi >= survey.lo;
  this->Datum = 0.0;
  if (hasData)
  {
    double largest = std::max(std::abs(survey.lo), std::abs(survey.hi));
    if (largest > std::numeric_limits<float>::max())
    {
      std::ostringstream message;
      message << "heights reach from " << survey.lo << " to " << survey.hi
              << ", numbers within single precision (3.4e38) are expected";
      return message.str();
    }
    // Float input has no more digits to keep.
    if (!std::is_same_v<T, float> && largest > 64.0 * (survey.hi - survey.lo))
    {
      this->Datum = survey.lo + (survey.hi - survey.lo) / 2.0;
    }
  }
  this->Bottom = static_cast<float>(survey.lo - this->Datum);
  this->Top = static_cast<float>(survey.hi - this->Datum);

  HeightView<float>& view = this->Prepared.heights;
  view.columns = source.columns;
  view.rows = source.rows;
  view.spacingX = source.spacingX;
  view.spacingY = source.spacingY;
  this->MissingRow = nullptr;
  bool inPlace = false;
  if constexpr (std::is_same_v<T, float>)
  {
    inPlace = !padded && survey.plain && source.scale == 1.0;
    if (inPlace)
    {
      this->Copy = std::vector<float>();
      view.data = source.data;
      view.stepX = source.stepX;
      view.stepY = source.stepY;
    }
  }
  if (!inPlace)
  {
    const float none = std::numeric_limits<float>::quiet_NaN();
    const int margin = padded ? Padding : 0;
    const std::size_t pitch = static_cast<std::size_t>(source.columns) + 2 * margin;
    this->Copy.resize(pitch * (static_cast<std::size_t>(source.rows) + (padded ? 1 : 0)));
    float* first = this->Copy.data() + margin;
    parallelFor(source.rows,
      [&](int begin, int end)
      {
        for (int j = begin; j < end; ++j)
        {
          float* row = first + static_cast<std::size_t>(j) * pitch;
          std::fill_n(row - margin, margin, none);
          for (int i = 0; i < source.columns; ++i)
          {
            row[i] = static_cast<float>(reader.Height(i, j) - this->Datum);
          }
          std::fill_n(row + source.columns, margin, none);
        }
      });
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
