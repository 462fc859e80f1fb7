// SPDX-License-Identifier: BSD-3-Clause
#include "PictureWriter.h"

#include "CodeTable.h"
#include "SceneTile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "PictureWriter.cxx"
#include <hwy/foreach_target.h>

// After the loop over the targets, which defines for which one this is.
#include "ThicknessLanes-inl.h"
#include <hwy/cache_control.h>

HWY_BEFORE_NAMESPACE();
namespace relief
{
namespace HWY_NAMESPACE
{

// The codes of linear values, as CodeTable tells them one by one.
HWY_INLINE hn::Vec<IntTag> CodesOf(const std::int32_t* entries, Vector linear)
{
  const Tag tag;
  const IntTag integers;
  const hn::RebindToUnsigned<Tag> whole;
  // NaN is 0 too.
  const Vector c =
    hn::IfThenElseZero(hn::Gt(linear, hn::Zero(tag)), hn::Min(linear, hn::Set(tag, 1.0f)));
  const Vector place = hn::Mul(c, hn::Set(tag, static_cast<float>(CodeTable::Steps)));
  const auto step = hn::ConvertTo(integers, place);
  const Vector beyond = hn::Sub(place, hn::ConvertTo(tag, step));
  const auto parts =
    hn::ConvertTo(integers, hn::Mul(beyond, hn::Set(tag, static_cast<float>(CodeTable::Parts))));
  const auto sum = hn::Add(hn::GatherIndex(integers, entries, step), parts);
  return hn::BitCast(integers, hn::ShiftRight<24>(hn::BitCast(whole, sum)));
}

// The colour of samples: of the layers as they are written, so that those add up to it.
HWY_INLINE Vector ColorAt(const PictureParts& parts, const SceneTile& tile, int channel, int at)
{
  const Tag tag;
  Vector color =
    parts.bases ? hn::Load(tag, tile.base[channel].values + at) : hn::Set(tag, parts.base[channel]);
  for (int term = 0; term < SceneTile::NumberOfTerms; ++term)
  {
    if (parts.terms[term])
    {
      color = hn::Add(color, hn::Load(tag, tile.terms[term][channel].values + at));
    }
  }
  return color;
}

// Copies what is written once and not read soon past the caches, where it fills whole lines of
// them: they need not be read first.
template <class T>
HWY_INLINE void CopyPast(const T* from, int count, T* to)
{
  constexpr std::size_t line = 64;
  const hn::CappedTag<std::int32_t, line / sizeof(std::int32_t)> tag;
  const std::size_t size = static_cast<std::size_t>(count) * sizeof(T);
  if (reinterpret_cast<std::uintptr_t>(to) % line != 0 || size % line != 0)
  {
    std::copy_n(from, count, to);
    return;
  }
  const auto* words = reinterpret_cast<const std::int32_t*>(from);
  auto* target = reinterpret_cast<std::int32_t*>(to);
  for (std::size_t k = 0; k < size / sizeof(std::int32_t); k += hn::Lanes(tag))
  {
    hn::Stream(hn::LoadU(tag, words + k), tag, target + k);
  }
}

// One row of a tile, of which some samples are asked for.
class RowWriter
{
public:
  RowWriter(const SceneTile& tile, const Target& target, int j)
    : First(tile.At(tile.i0, j))
    , Begin(tile.askedI0 - tile.i0)
    , Count(tile.askedI1 - tile.askedI0)
    , Place(static_cast<std::size_t>(j - target.j0) * target.width + (tile.askedI0 - target.i0))
    , Heights(tile.HeightsOf(j - tile.row * SceneTile::Width))
  {
  }

  // Calls body(place, at, missing) for the vectors of the row: where the numbers of their samples
  // go, their place in the tile's arrays, and which have no data.
  template <class T, class Body>
  HWY_INLINE void Write(T* layer, int components, Body&& body) const
  {
    const Tag tag;
    HWY_ALIGN T row[4 * SceneTile::Width];
    for (int column = 0; column < SceneTile::Width; column += static_cast<int>(hn::Lanes(tag)))
    {
      body(row + components * column, this->First + column,
        hn::IsNaN(hn::LoadU(tag, this->Heights + column)));
    }
    CopyPast(
      row + components * this->Begin, components * this->Count, layer + components * this->Place);
  }

private:
  int First;
  int Begin;
  int Count;
  std::size_t Place;
  const float* Heights;
};

HWY_INLINE void WriteColors(
  const PictureParts& parts, const SceneTile& tile, float* layer, const RowWriter& row)
{
  const Tag tag;
  const Vector one = hn::Set(tag, 1.0f);
  row.Write(layer, 4,
    [&](float* place, int at, Mask missing)
    {
      auto channel = [&](int c)
      { return hn::IfThenZeroElse(missing, ColorAt(parts, tile, c, at)); };
      const Vector red = channel(0);
      const Vector green = parts.channels == 1 ? red : channel(1);
      const Vector blue = parts.channels == 1 ? red : channel(2);
      hn::StoreInterleaved4(red, green, blue, hn::IfThenZeroElse(missing, one), tag, place);
    });
}

HWY_INLINE void WriteCodes(const PictureParts& parts, const SceneTile& tile,
  const std::int32_t* entries, unsigned char* layer, const RowWriter& row)
{
  const Tag tag;
  const IntTag integers;
  const Vector exposure = hn::Set(tag, parts.exposure);
  row.Write(layer, 4,
    [&](unsigned char* place, int at, Mask missing)
    {
      auto channel = [&](int c)
      { return CodesOf(entries, hn::Mul(exposure, ColorAt(parts, tile, c, at))); };
      auto rgba = channel(0);
      if (parts.channels == 1)
      {
        rgba = hn::Or(rgba, hn::Or(hn::ShiftLeft<8>(rgba), hn::ShiftLeft<16>(rgba)));
      }
      else
      {
        rgba = hn::Or(rgba, hn::Or(hn::ShiftLeft<8>(channel(1)), hn::ShiftLeft<16>(channel(2))));
      }
      // Red is the first byte: Highway's processors have the lowest first.
      rgba = hn::Or(rgba, hn::Set(integers, static_cast<std::int32_t>(0xFF000000u)));
      rgba = hn::IfThenZeroElse(hn::RebindMask(integers, missing), rgba);
      hn::StoreU(rgba, integers, reinterpret_cast<std::int32_t*>(place));
    });
}

HWY_INLINE void WriteNumbers(float* layer, const RowWriter& row, const float* numbers)
{
  const Tag tag;
  const Vector none = hn::Set(tag, std::numeric_limits<float>::quiet_NaN());
  if (layer)
  {
    row.Write(layer, 1,
      [&](float* place, int at, Mask missing)
      { hn::StoreU(hn::IfThenElse(missing, none, hn::Load(tag, numbers + at)), tag, place); });
  }
}

// Three components: planes, or a constant where there are none, of which grey ones have one.
HWY_INLINE void WriteVectors(float* layer, const RowWriter& row,
  const SceneTile::Plane<float>* planes, int channels, const glm::vec3& otherwise)
{
  const Tag tag;
  const Vector none = hn::Set(tag, std::numeric_limits<float>::quiet_NaN());
  if (layer)
  {
    row.Write(layer, 3,
      [&](float* place, int at, Mask missing)
      {
        auto component = [&](int c)
        {
          return hn::IfThenElse(missing, none,
            planes ? hn::Load(tag, planes[channels == 1 ? 0 : c].values + at)
                   : hn::Set(tag, otherwise[c]));
        };
        hn::StoreInterleaved3(component(0), component(1), component(2), tag, place);
      });
  }
}

void WriteTile(const Target& target, const PictureParts& parts, const std::int32_t* entries,
  const SceneTile& tile)
{
  HWY_ALIGN float illumination[SceneTile::Size];
  for (int at = 0; target.illumination && at < SceneTile::Size; ++at)
  {
    illumination[at] = static_cast<float>(tile.illumination.values[at] * parts.illuminationScale);
  }
  auto planes = [&](SceneTile::Term term)
  { return parts.terms[term] ? tile.terms[term] : nullptr; };
  const glm::vec3 black(0.0f);
  for (int j = tile.askedJ0; j < tile.askedJ1; ++j)
  {
    const RowWriter row(tile, target, j);
    if (target.rgba)
    {
      WriteColors(parts, tile, target.rgba, row);
    }
    if (target.rgba8)
    {
      WriteCodes(parts, tile, entries, target.rgba8, row);
    }
    WriteNumbers(target.illumination, row, illumination);
    WriteNumbers(target.thickness, row, tile.thickness.values);
    WriteNumbers(target.shadow, row, tile.shadow.values);
    WriteVectors(target.normals, row, tile.normal, 3, black);
    WriteVectors(target.base, row, parts.bases ? tile.base : nullptr, 3, parts.base);
    WriteVectors(target.diffuse, row, planes(SceneTile::Diffuse), parts.channels, black);
    WriteVectors(target.scatter, row, planes(SceneTile::Scatter), parts.channels, black);
    WriteVectors(target.specular, row, planes(SceneTile::Specular), parts.channels, black);
  }
}

void ColorTile(const PictureParts& parts, SceneTile::Color<float>& colors, const SceneTile& tile)
{
  const Tag tag;
  for (int c = 0; c < 3; ++c)
  {
    for (int at = 0; at < SceneTile::Size; at += static_cast<int>(hn::Lanes(tag)))
    {
      hn::Store(parts.channels == 1 && c > 0 ? hn::Load(tag, colors[0].values + at)
                                             : ColorAt(parts, tile, c, at),
        tag, colors[c].values + at);
    }
  }
}

}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace relief
{
HWY_EXPORT(WriteTile);
HWY_EXPORT(ColorTile);

void PictureWriter::FindLargest(const SceneTile& tile, float* largest) const
{
  SceneTile::Color<float> colors;
  HWY_DYNAMIC_DISPATCH(ColorTile)(this->Parts, colors, tile);
  std::fill_n(largest, SceneTile::Size, std::numeric_limits<float>::quiet_NaN());
  tile.ForEachAsked(
    [&](int, int, int at)
    {
      if (tile.HasData(at))
      {
        largest[at] =
          std::max({ colors[0].values[at], colors[1].values[at], colors[2].values[at] });
      }
    });
}

void PictureWriter::Flush()
{
  hwy::FlushStream();
}

void PictureWriter::Write(const SceneTile& tile) const
{
  HWY_DYNAMIC_DISPATCH(WriteTile)(this->Out, this->Parts, CodeTable::Get().GetEntries(), tile);
}

}

#endif
