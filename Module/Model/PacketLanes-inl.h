// SPDX-License-Identifier: BSD-3-Clause
// Included once for each instruction set, hence the guard that toggles.
#if defined(PacketLanes_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef PacketLanes_inl_h
#undef PacketLanes_inl_h
#else
#define PacketLanes_inl_h
#endif

#include "HeightView.h"
#include "ThicknessLanes-inl.h"

#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace relief
{
namespace HWY_NAMESPACE
{

using Ints = hn::Vec<IntTag>;

constexpr float Infinity = std::numeric_limits<float>::infinity();

// The rays of neighbouring samples of a row, and what has been found of them.
struct Packet
{
  HWY_ALIGN float x[MaxLanes]; // start, in samples from the sample
  HWY_ALIGN float y[MaxLanes];
  HWY_ALIGN float base[MaxLanes];
  HWY_ALIGN float sink[MaxLanes];
  HWY_ALIGN float dx[MaxLanes];
  HWY_ALIGN float dy[MaxLanes];
  HWY_ALIGN float dz[MaxLanes];
  HWY_ALIGN float from[MaxLanes]; // the stretch that can be inside
  HWY_ALIGN float to[MaxLanes];
  HWY_ALIGN float end[MaxLanes];
  HWY_ALIGN float ground[MaxLanes]; // height above base at the start
  HWY_ALIGN float cellX[MaxLanes];  // the cell ahead, from the sample; whole numbers
  HWY_ALIGN float cellY[MaxLanes];
  HWY_ALIGN std::int32_t lane[MaxLanes];   // of its sample: columns from the first
  HWY_ALIGN std::int32_t active[MaxLanes]; // -1 or 0
  HWY_ALIGN std::int32_t alone[MaxLanes];  // to be traced by itself
  HWY_ALIGN std::int32_t upright[MaxLanes];
  HWY_ALIGN float s[MaxLanes];         // how far rays have come, where the ground is known
  HWY_ALIGN float thickness[MaxLanes]; // and what they have so far
  HWY_ALIGN float rest[MaxLanes];
  // Rays that have left the image inside: where, below which ground, and what they had till then.
  HWY_ALIGN std::int32_t beyond[MaxLanes]; // -1 or 0
  HWY_ALIGN float left[MaxLanes];
  HWY_ALIGN float leftGround[MaxLanes];
  HWY_ALIGN float kept[MaxLanes];
  HWY_ALIGN std::int32_t leftAlongX[MaxLanes]; // whether through a line of constant x
  HWY_ALIGN std::int32_t resumed[MaxLanes];    // whether it came there over data that have been
                                               // looked at
};

HWY_INLINE float Least(Tag tag, Mask mask, Vector v)
{
  return hn::GetLane(hn::MinOfLanes(tag, hn::IfThenElse(mask, v, hn::Set(tag, Infinity))));
}

HWY_INLINE float Greatest(Tag tag, Mask mask, Vector v)
{
  return hn::GetLane(hn::MaxOfLanes(tag, hn::IfThenElse(mask, v, hn::Set(tag, -Infinity))));
}

// The heights that rays read: at cells of their own, or, while all rays are in cells side by side
// as their samples are, by loads of unit stride. The cells are passed around: on some processors a
// vector has no size that a compiler knows, and so cannot be a member.
class HeightLanes
{
public:
  HeightLanes(const HeightView<float>& heights, Tag tag)
    : Data(heights.data)
    , PitchX(static_cast<std::int32_t>(heights.stepX))
    , PitchY(static_cast<std::int32_t>(heights.stepY))
    , Count(this->PitchY * (heights.rows - 1) + this->PitchX * (heights.columns - 1) + 1)
    , Lanes(static_cast<std::int32_t>(hn::Lanes(tag)))
  {
  }

  // Finds out how to read at these cells.
  HWY_INLINE void SetCells(Ints index)
  {
    const IntTag intTag;
    const Ints first = hn::Sub(index, hn::Iota(intTag, 0));
    this->Start = hn::GetLane(first);
    this->SideBySide = this->PitchX == 1 && this->Start >= 0 &&
      this->Start < this->Count - this->Lanes - this->PitchY &&
      hn::AllTrue(intTag, hn::Eq(first, hn::Set(intTag, this->Start)));
  }

  bool AreSideBySide() const { return this->SideBySide; }

  // The corner (x, y), 0 or 1, of the cells that have been set.
  HWY_INLINE Vector Corner(Tag tag, int x, int y, Ints index, Mask active) const
  {
    const std::int32_t offset = x * this->PitchX + y * this->PitchY;
    if (this->SideBySide)
    {
      return hn::LoadU(tag, this->Data + this->Start + offset);
    }
    return hn::GatherIndex(tag, this->Data + offset, OfActive(index, active));
  }

  // At samples of each ray's own.
  HWY_INLINE Vector Gather(Tag tag, Ints samples, Mask active) const
  {
    return hn::GatherIndex(tag, this->Data, OfActive(samples, active));
  }

private:
  // Rays that are not active may be anywhere.
  static HWY_INLINE Ints OfActive(Ints samples, Mask active)
  {
    return hn::IfThenElseZero(hn::RebindMask(IntTag(), active), samples);
  }

  const float* Data;
  std::int32_t PitchX;
  std::int32_t PitchY;
  std::int32_t Count;
  std::int32_t Lanes;
  std::int32_t Start = 0;
  bool SideBySide = false;
};

}
}
HWY_AFTER_NAMESPACE();

#endif
