// SPDX-License-Identifier: BSD-3-Clause
#include "HeightRows.h"

#include "HeightWindows.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "HeightRows.cxx"
#include <hwy/foreach_target.h>

// After the loop over the targets, which defines for which one this is.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace relief
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

namespace
{
using Tag = hn::CappedTag<float, 16>;
using Vector = hn::Vec<Tag>;
using Bounds = MinMaxPyramid::Bounds;
static_assert(sizeof(Bounds) == 3 * sizeof(float));

constexpr float Infinity = std::numeric_limits<float>::infinity();
}

// NaN in place of what is no height; `marker` is NaN where nothing marks that.
template <class Type, class Values>
HWY_INLINE Values OnlyHeights(Type type, Values values, Values lengths, float marker)
{
  // False for NaN.
  const auto finite = hn::Le(hn::Abs(values), hn::Set(type, std::numeric_limits<float>::max()));
  const auto has = hn::AndNot(hn::Eq(values, hn::Set(type, marker)), finite);
  return hn::IfThenElse(has, lengths, hn::Set(type, std::numeric_limits<float>::quiet_NaN()));
}

void ReadHeights(
  const float* values, int count, double scale, double datum, const float* noData, float* heights)
{
  const Tag tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const hn::CappedTag<double, 8> wide;
  const hn::Rebind<float, decltype(wide)> narrow;
  const int wideLanes = static_cast<int>(hn::Lanes(wide));
  const float none = std::numeric_limits<float>::quiet_NaN();
  const float marker = noData ? *noData : none;
  const bool same = scale == 1.0 && datum == 0.0;
  int i = 0;
  for (; same && i + lanes <= count; i += lanes)
  {
    const Vector value = hn::LoadU(tag, values + i);
    hn::StoreU(OnlyHeights(tag, value, value, marker), tag, heights + i);
  }
  for (; !same && i + wideLanes <= count; i += wideLanes)
  {
    const auto value = hn::LoadU(narrow, values + i);
    const auto length = hn::DemoteTo(narrow,
      hn::Sub(hn::Mul(hn::PromoteTo(wide, value), hn::Set(wide, scale)), hn::Set(wide, datum)));
    hn::StoreU(OnlyHeights(narrow, value, length, marker), narrow, heights + i);
  }
  for (; i < count; ++i)
  {
    const bool has =
      std::abs(values[i]) <= std::numeric_limits<float>::max() && values[i] != marker;
    heights[i] = has ? static_cast<float>(static_cast<double>(values[i]) * scale - datum) : none;
  }
}

void AddToRange(const float* heights, int count, float& lo, float& hi)
{
  const Tag tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  Vector low = hn::Set(tag, lo);
  Vector high = hn::Set(tag, hi);
  int i = 0;
  for (; i + lanes <= count; i += lanes)
  {
    const Vector height = hn::LoadU(tag, heights + i);
    const auto missing = hn::IsNaN(height);
    low = hn::Min(low, hn::IfThenElse(missing, low, height));
    high = hn::Max(high, hn::IfThenElse(missing, high, height));
  }
  lo = hn::GetLane(hn::MinOfLanes(tag, low));
  hi = hn::GetLane(hn::MaxOfLanes(tag, high));
  for (; i < count; ++i)
  {
    lo = heights[i] < lo ? heights[i] : lo;
    hi = heights[i] > hi ? heights[i] : hi;
  }
}

namespace
{
// Bounds of a block in which a sample seems to have no data. Where only the sum of huge heights was
// not a number, those found hold.
Bounds HoleBounds(const float* const* rows, int count, int begin, int end, const Bounds& found)
{
  bool anyHole = false;
  bool anyCell = false;
  for (int j = 0; j + 1 < count; ++j)
  {
    for (int i = begin; i < end; ++i)
    {
      const bool hole = std::isnan(rows[j][i]) || std::isnan(rows[j][i + 1]) ||
        std::isnan(rows[j + 1][i]) || std::isnan(rows[j + 1][i + 1]);
      anyHole = anyHole || hole;
      anyCell = anyCell || !hole;
    }
  }
  return !anyHole ? found : anyCell ? MinMaxPyramid::GetMixed() : Bounds();
}

// Some columns of a row of blocks, before their bounds are found along the rows.
struct Columns
{
  static constexpr int Most = 256;
  // One block more: a block ends with the next one's first column.
  static constexpr int Size = Most + 64;
  HWY_ALIGN float lo[Size];
  HWY_ALIGN float hi[Size];
  HWY_ALIGN float sum[Size]; // NaN where any height is
  HWY_ALIGN float twist[Size];
};

// Goes down so many columns; after the last one comes another only if `more`.
void BoundColumns(
  const float* const* rows, int count, int begin, int size, bool more, Columns& columns)
{
  const Tag tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  int i = 0;
  for (; i + lanes + (more ? 0 : 1) <= size; i += lanes)
  {
    const float* row = rows[0] + begin + i;
    Vector height = hn::LoadU(tag, row);
    Vector step = hn::Sub(hn::LoadU(tag, row + 1), height);
    Vector lo = height;
    Vector hi = height;
    Vector sum = height;
    Vector twist = hn::Zero(tag);
    for (int j = 1; j < count; ++j)
    {
      row = rows[j] + begin + i;
      height = hn::LoadU(tag, row);
      const Vector next = hn::Sub(hn::LoadU(tag, row + 1), height);
      lo = hn::Min(lo, height);
      hi = hn::Max(hi, height);
      sum = hn::Add(sum, height);
      twist = hn::Max(twist, hn::Abs(hn::Sub(next, step)));
      step = next;
    }
    hn::Store(lo, tag, columns.lo + i);
    hn::Store(hi, tag, columns.hi + i);
    hn::Store(sum, tag, columns.sum + i);
    hn::Store(twist, tag, columns.twist + i);
  }
  for (; i < size; ++i)
  {
    columns.lo[i] = columns.hi[i] = columns.sum[i] = rows[0][begin + i];
    columns.twist[i] = 0.0f;
    for (int j = 1; j < count; ++j)
    {
      const float* before = rows[j - 1] + begin + i;
      const float* row = rows[j] + begin + i;
      columns.lo[i] = std::min(columns.lo[i], row[0]);
      columns.hi[i] = std::max(columns.hi[i], row[0]);
      columns.sum[i] += row[0];
      if (more || i + 1 < size)
      {
        columns.twist[i] =
          std::max(columns.twist[i], std::abs((row[1] - row[0]) - (before[1] - before[0])));
      }
    }
  }
}

// What of a vector of blocks is found along the rows: of each its own columns, and the next one's
// first.
template <class Operation>
HWY_INLINE Vector Along(Tag tag, const float* columns, bool closing, Operation&& operation)
{
  Vector a, b, c, d;
  hn::LoadInterleaved4(tag, columns, a, b, c, d);
  Vector found = operation(operation(a, b), operation(c, d));
  if (closing)
  {
    Vector next, unused;
    hn::LoadInterleaved4(tag, columns + MinMaxPyramid::BlockSize, next, unused, unused, unused);
    found = operation(found, next);
  }
  return found;
}
}

void BoundBlocks(const float* const* rows, int count, int columns, Bounds* blocks)
{
  const Tag tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  constexpr int size = MinMaxPyramid::BlockSize;
  static_assert(size == 4);
  const int number = (columns - 1 + size - 1) / size;
  Columns part;
  for (int begin = 0; begin < columns - 1; begin += Columns::Most)
  {
    // One column more than the blocks have cells, as far as there is one.
    const int last = std::min(begin + Columns::Most + 1, columns);
    BoundColumns(rows, count, begin, last - begin, last < columns, part);
    for (int i = last - begin; i < Columns::Size; ++i)
    {
      part.lo[i] = Infinity;
      part.hi[i] = -Infinity;
      part.sum[i] = part.twist[i] = 0.0f;
    }
    const int first = begin / size;
    const int end = std::min(first + Columns::Most / size, number);
    for (int k = first; k < end; k += lanes)
    {
      const int at = k * size - begin;
      auto least = [](Vector a, Vector b) { return hn::Min(a, b); };
      auto most = [](Vector a, Vector b) { return hn::Max(a, b); };
      auto both = [](Vector a, Vector b) { return hn::Add(a, b); };
      const Vector lo = Along(tag, part.lo + at, true, least);
      const Vector hi = Along(tag, part.hi + at, true, most);
      const Vector twist = Along(tag, part.twist + at, false, most);
      const bool holes = !hn::AllFalse(tag, hn::IsNaN(Along(tag, part.sum + at, true, both)));
      HWY_ALIGN float found[3 * 16];
      hn::StoreInterleaved3(lo, hi, twist, tag, found);
      for (int lane = 0; lane < std::min(lanes, end - k); ++lane)
      {
        const Bounds bounds = { found[3 * lane], found[3 * lane + 1], found[3 * lane + 2] };
        const int i = (k + lane) * size;
        blocks[k + lane] =
          holes ? HoleBounds(rows, count, i, std::min(i + size, columns - 1), bounds) : bounds;
      }
    }
  }
}

void RaiseTo(const float* others, std::size_t count, float* values)
{
  const Tag tag;
  const std::size_t lanes = hn::Lanes(tag);
  std::size_t k = 0;
  for (; k + lanes <= count; k += lanes)
  {
    hn::StoreU(hn::Max(hn::LoadU(tag, values + k), hn::LoadU(tag, others + k)), tag, values + k);
  }
  for (; k < count; ++k)
  {
    values[k] = std::max(values[k], others[k]);
  }
}

namespace
{
// The windows that begin at `lanes` columns, every second one of these: what is found in five
// columns from there on.
template <class Operation>
HWY_INLINE Vector AlongWindows(Tag tag, const float* columns, Operation&& operation)
{
  static_assert(HeightWindows::Step == 2 && HeightWindows::Size == 4);
  Vector a, b, c, d, e, unused;
  hn::LoadInterleaved2(tag, columns, a, b);
  hn::LoadInterleaved2(tag, columns + 2, c, d);
  hn::LoadInterleaved2(tag, columns + 4, e, unused);
  return operation(operation(operation(a, b), operation(c, d)), e);
}
}

void BoundWindows(const float* const* rows, int count, int columns, float* lowest, float* highest)
{
  const Tag tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  constexpr int step = HeightWindows::Step;
  constexpr int most = 256;
  HWY_ALIGN float lo[most + 64];
  HWY_ALIGN float hi[most + 64];
  const int number = (columns - 1 + step - 1) / step;
  for (int begin = 0; begin < columns - 1; begin += most)
  {
    // Down the columns; NaN leaves what was found before.
    const int size = std::min(most + HeightWindows::Size, columns - begin);
    int i = 0;
    for (; i + lanes <= size; i += lanes)
    {
      Vector low = hn::Set(tag, Infinity);
      Vector high = hn::Set(tag, -Infinity);
      for (int j = 0; j < count; ++j)
      {
        const Vector height = hn::LoadU(tag, rows[j] + begin + i);
        low = hn::IfThenElse(hn::Lt(height, low), height, low);
        high = hn::IfThenElse(hn::Gt(height, high), height, high);
      }
      hn::Store(low, tag, lo + i);
      hn::Store(high, tag, hi + i);
    }
    for (; i < most + 64; ++i)
    {
      lo[i] = Infinity;
      hi[i] = -Infinity;
      for (int j = 0; j < count && i < size; ++j)
      {
        const float height = rows[j][begin + i];
        lo[i] = height < lo[i] ? height : lo[i];
        hi[i] = height > hi[i] ? height : hi[i];
      }
    }
    // Then along the rows.
    const int first = begin / step;
    const int end = std::min(first + most / step, number);
    for (int k = first; k < end; k += lanes)
    {
      const int at = k * step - begin;
      const Vector low =
        AlongWindows(tag, lo + at, [](Vector a, Vector b) { return hn::Min(a, b); });
      const Vector high =
        AlongWindows(tag, hi + at, [](Vector a, Vector b) { return hn::Max(a, b); });
      if (k + lanes <= end)
      {
        hn::StoreU(low, tag, lowest + k);
        hn::StoreU(high, tag, highest + k);
        continue;
      }
      HWY_ALIGN float found[2 * 16];
      hn::Store(low, tag, found);
      hn::Store(high, tag, found + lanes);
      std::copy_n(found, end - k, lowest + k);
      std::copy_n(found + lanes, end - k, highest + k);
    }
  }
}

void BoundParents(const Bounds* first, const Bounds* second, int columns, Bounds* parents)
{
  const Tag tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const Vector infinity = hn::Set(tag, Infinity);
  const Vector one = hn::Set(tag, 1.0f);
  // Two vectors of blocks: the least and greatest of one above the other, and 1 where any is empty.
  HWY_ALIGN float lo[2 * 16];
  HWY_ALIGN float hi[2 * 16];
  HWY_ALIGN float twist[2 * 16];
  HWY_ALIGN float empty[2 * 16];
  auto join = [&](int at, int place)
  {
    Vector lo0, hi0, twist0, lo1, hi1, twist1;
    hn::LoadInterleaved3(tag, &first[at].lo, lo0, hi0, twist0);
    hn::LoadInterleaved3(tag, &second[at].lo, lo1, hi1, twist1);
    hn::Store(hn::Min(lo0, lo1), tag, lo + place);
    hn::Store(hn::Max(hi0, hi1), tag, hi + place);
    hn::Store(hn::Max(twist0, twist1), tag, twist + place);
    const auto any = hn::Or(hn::Gt(lo0, hi0), hn::Gt(lo1, hi1));
    hn::Store(hn::IfThenElseZero(any, one), tag, empty + place);
  };
  // The greater of each two that are side by side.
  auto most = [&](const float* values)
  {
    Vector even, odd;
    hn::LoadInterleaved2(tag, values, even, odd);
    return hn::Max(even, odd);
  };
  int i = 0;
  for (; 2 * (i + lanes) <= columns; i += lanes)
  {
    join(2 * i, 0);
    join(2 * i + lanes, lanes);
    Vector even, odd;
    hn::LoadInterleaved2(tag, lo, even, odd);
    const Vector least = hn::Min(even, odd);
    const Vector greatest = most(hi);
    // Some of them empty and others not. What is mixed already stays so by itself.
    const auto mixed = hn::And(hn::Gt(most(empty), hn::Zero(tag)), hn::Le(least, greatest));
    hn::StoreInterleaved3(hn::IfThenElse(mixed, hn::Neg(infinity), least),
      hn::IfThenElse(mixed, infinity, greatest), hn::IfThenElse(mixed, infinity, most(twist)), tag,
      &parents[i].lo);
  }
  for (; 2 * i < columns; ++i)
  {
    Bounds bounds;
    bool anyEmpty = false;
    for (const Bounds* row : { first, second })
    {
      for (int k = 2 * i; k < std::min(2 * i + 2, columns); ++k)
      {
        anyEmpty = anyEmpty || row[k].lo > row[k].hi;
        bounds.lo = std::min(bounds.lo, row[k].lo);
        bounds.hi = std::max(bounds.hi, row[k].hi);
        bounds.twist = std::max(bounds.twist, row[k].twist);
      }
    }
    parents[i] = anyEmpty && bounds.lo <= bounds.hi ? MinMaxPyramid::GetMixed() : bounds;
  }
}

}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace relief
{
HWY_EXPORT(ReadHeights);
HWY_EXPORT(AddToRange);
HWY_EXPORT(BoundBlocks);
HWY_EXPORT(BoundWindows);
HWY_EXPORT(BoundParents);
HWY_EXPORT(RaiseTo);

void ReadHeights(
  const float* values, int count, double scale, double datum, const float* noData, float* heights)
{
  HWY_DYNAMIC_DISPATCH(ReadHeights)(values, count, scale, datum, noData, heights);
}

void AddToRange(const float* heights, int count, float& lo, float& hi)
{
  HWY_DYNAMIC_DISPATCH(AddToRange)(heights, count, lo, hi);
}

void BoundBlocks(const float* const* rows, int count, int columns, MinMaxPyramid::Bounds* blocks)
{
  HWY_DYNAMIC_DISPATCH(BoundBlocks)(rows, count, columns, blocks);
}

void BoundWindows(const float* const* rows, int count, int columns, float* lowest, float* highest)
{
  HWY_DYNAMIC_DISPATCH(BoundWindows)(rows, count, columns, lowest, highest);
}

void BoundParents(const MinMaxPyramid::Bounds* first, const MinMaxPyramid::Bounds* second,
  int columns, MinMaxPyramid::Bounds* parents)
{
  HWY_DYNAMIC_DISPATCH(BoundParents)(first, second, columns, parents);
}

void RaiseTo(const float* others, std::size_t count, float* values)
{
  HWY_DYNAMIC_DISPATCH(RaiseTo)(others, count, values);
}

}

#endif
