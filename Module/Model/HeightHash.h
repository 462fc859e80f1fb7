// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightHash_h
#define HeightHash_h

#include "HeightField.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace relief
{

/// Mixes a number into a hash: a multiplication, and its upper half back into the lower. It tells
/// fields apart; it does not keep a secret.
inline std::uint64_t MixHash(std::uint64_t hash, std::uint64_t number)
{
  hash = (hash ^ number) * 0x9e3779b97f4a7c15u;
  return hash ^ (hash >> 32);
}

/// The hash of a row of heights, j of a source.
template <class T>
std::uint64_t HashRow(const HeightSource<T>& source, int j)
{
  const std::optional<T> noData =
    source.hasNoData ? NoDataOf<T>(source.noData) : std::optional<T>();
  std::uint64_t hash = static_cast<std::uint64_t>(source.columns);
  for (int i = 0; i < source.columns; ++i)
  {
    const T stored = source.data[i * source.stepX + j * source.stepY];
    const float height = static_cast<float>(stored) + 0.0f; // no -0
    const bool missing = !std::isfinite(static_cast<double>(stored)) || stored == noData ||
      (source.hasData && !source.hasData(i, j));
    std::uint32_t bits = 0x7fc00000u; // NaN, of which there are many
    if (!missing)
    {
      std::memcpy(&bits, &height, sizeof bits);
    }
    hash = MixHash(hash, bits);
  }
  return hash;
}

/// The hash of heights by those of their rows, from the first one on.
inline std::uint64_t HashOfRows(const std::vector<std::uint64_t>& rows)
{
  std::uint64_t hash = static_cast<std::uint64_t>(rows.size());
  for (const std::uint64_t row : rows)
  {
    hash = MixHash(hash, row);
  }
  return hash;
}

/// A hash of heights: of their values in single precision, before any scale, of where there are no
/// data, and of the numbers of columns and rows. The type of the samples, their spacing and what
/// stands where there are no data do not count; 0 and -0 are one height. It is the same on every
/// machine and with any number of threads.
template <class T>
std::uint64_t HashHeights(const HeightSource<T>& source, const ParallelFor& parallelFor)
{
  std::vector<std::uint64_t> hashes(static_cast<std::size_t>(source.rows));
  parallelFor(source.rows,
    [&](int begin, int end)
    {
      for (int j = begin; j < end; ++j)
      {
        hashes[static_cast<std::size_t>(j)] = HashRow(source, j);
      }
    });
  return HashOfRows(hashes);
}

/// A hash as it is written: 16 hexadecimal digits in lower case.
inline std::string HashText(std::uint64_t hash)
{
  std::string text(16, '0');
  for (int at = 15; at >= 0; --at, hash >>= 4)
  {
    text[static_cast<std::size_t>(at)] = "0123456789abcdef"[hash & 15];
  }
  return text;
}

}

#endif
