// SPDX-License-Identifier: BSD-3-Clause
#include "HeightReader.h"

#include "HeightRows.h"
#include "HeightTypes.h"

#include <cmath>
#include <limits>
#include <type_traits>

namespace relief
{

//------------------------------------------------------------------------------
template <class T>
template <class Real>
void HeightReader<T>::Read(int j, double datum, Real* row) const
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

//------------------------------------------------------------------------------
template <class T>
template <class Real>
void HeightReader<T>::ApplyMask(int j, Real* row) const
{
  for (int i = 0; this->Source.hasData && i < this->Source.columns; ++i)
  {
    row[i] = this->Source.hasData(i, j) ? row[i] : std::numeric_limits<Real>::quiet_NaN();
  }
}

//------------------------------------------------------------------------------
// Here and nowhere else, since every reader of heights would compile them all.
#define ReadAs(type)                                                                               \
  template void HeightReader<type>::Read(int, double, float*) const;                               \
  template void HeightReader<type>::Read(int, double, double*) const
RELIEF_FOR_HEIGHT_TYPES(ReadAs);
#undef ReadAs

}
