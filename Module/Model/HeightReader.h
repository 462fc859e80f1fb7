// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightReader_h
#define HeightReader_h

#include "HeightField.h"

#include <cmath>
#include <cstddef>
#include <optional>

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
  /// where float may not do, and float.
  template <class Real>
  void Read(int j, double datum, Real* row) const;

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
  void ApplyMask(int j, Real* row) const;

  const HeightSource<T>& Source;
  std::optional<T> NoData;
};

}

#endif
