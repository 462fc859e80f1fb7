// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightReader_h
#define HeightReader_h

#include "HeightField.h"
#include "HeightRows.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>

namespace relief
{

/// Turns rows of a caller's heights, which must outlive this object, into lengths.
template <class T>
class HeightReader
{
public:
  explicit HeightReader(const HeightSource<T>& source)
    : Source(source)
    , NoData(source.hasNoData ? NoDataOf<T>(source.noData) : std::nullopt)
  {
  }

  /// Row j as lengths above the datum, NaN without data, scaled in double precision. Real is double
  /// where float may not do.
  template <class Real>
  void Read(int j, double datum, Real* row) const
  {
    const T* values = this->Source.data + j * this->Source.stepY;
    const std::ptrdiff_t step = this->Source.stepX;
    const int columns = this->Source.columns;
    const double scale = this->Source.scale;
    if constexpr (std::is_same_v<T, float> && std::is_same_v<Real, float>)
    {
      if (step == 1)
      {
        ReadHeights(values, columns, scale, datum, this->NoData ? &*this->NoData : nullptr, row);
        this->ApplyMask(j, row);
        return;
      }
    }
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
    if (this->NoData)
    {
      const T noData = *this->NoData;
      for (int i = 0; i < columns; ++i)
      {
        row[i] = values[i * step] == noData ? none : row[i];
      }
    }
    this->ApplyMask(j, row);
  }

  /// A sample as it is stored. Returns whether it has data.
  bool ReadStored(int i, int j, double& height) const
  {
    const T stored = this->Source.data[i * this->Source.stepX + j * this->Source.stepY];
    height = static_cast<double>(stored);
    return std::isfinite(height) && !(this->NoData && stored == *this->NoData) &&
      !(this->Source.hasData && !this->Source.hasData(i, j));
  }

private:
  template <class Real>
  void ApplyMask(int j, Real* row) const
  {
    for (int i = 0; this->Source.hasData && i < this->Source.columns; ++i)
    {
      row[i] = this->Source.hasData(i, j) ? row[i] : std::numeric_limits<Real>::quiet_NaN();
    }
  }

  const HeightSource<T>& Source;
  std::optional<T> NoData;
};

}

#endif
