// SPDX-License-Identifier: BSD-3-Clause
// Included once for each instruction set, hence the guard that toggles.
#if defined(PacketTrace_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef PacketTrace_inl_h
#undef PacketTrace_inl_h
#else
#define PacketTrace_inl_h
#endif

#include "MinMaxPyramid.h"
#include "RayThickness.h"
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
  HWY_ALIGN float ground[MaxLanes]; // height above base at the start
  HWY_ALIGN float cellX[MaxLanes];  // the cell ahead, from the sample; whole numbers
  HWY_ALIGN float cellY[MaxLanes];
  HWY_ALIGN std::int32_t active[MaxLanes]; // -1 or 0
  HWY_ALIGN float thickness[MaxLanes];
  HWY_ALIGN float rest[MaxLanes];
};

// reliefLevelLength() for the lanes of a vector; the end may be infinite.
HWY_INLINE Vector LevelLength(Tag tag, Vector s0, Vector s1, Vector ground, Vector dz)
{
  const Vector zero = hn::Zero(tag);
  const Vector crossing = hn::Div(ground, dz);
  const Mask up = hn::Gt(dz, zero);
  const Vector begin = hn::IfThenElse(up, s0, hn::Max(s0, crossing));
  const Vector end = hn::IfThenElse(up, hn::Min(s1, crossing), s1);
  const Vector level = hn::IfThenElseZero(hn::Gt(ground, zero), hn::Sub(s1, s0));
  // Both may be infinite.
  const Vector slanted = hn::IfThenElseZero(hn::Gt(end, begin), hn::Sub(end, begin));
  const Vector length = hn::IfThenElse(hn::Eq(dz, zero), level, slanted);
  return hn::IfThenElseZero(hn::Gt(s1, s0), length);
}

HWY_INLINE float Least(Tag tag, Mask mask, Vector v)
{
  return hn::GetLane(hn::MinOfLanes(tag, hn::IfThenElse(mask, v, hn::Set(tag, Infinity))));
}

HWY_INLINE float Greatest(Tag tag, Mask mask, Vector v)
{
  return hn::GetLane(hn::MaxOfLanes(tag, hn::IfThenElse(mask, v, hn::Set(tag, -Infinity))));
}

// The heights that rays read: at cells of their own, or, while all rays are in cells side by side
// as their samples are, by loads of unit stride.
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

  // Finds out how to read at these cells. Rays that are not active may be anywhere.
  HWY_INLINE void SetCells(Ints index, Mask active)
  {
    const IntTag intTag;
    const Ints first = hn::Sub(index, hn::Iota(intTag, 0));
    this->Start = hn::GetLane(first);
    this->SideBySide = this->PitchX == 1 && this->Start >= 0 &&
      this->Start < this->Count - this->Lanes - this->PitchY &&
      hn::AllTrue(intTag, hn::Eq(first, hn::Set(intTag, this->Start)));
    if (!this->SideBySide)
    {
      this->Index = hn::IfThenElseZero(hn::RebindMask(intTag, active), index);
    }
  }

  bool AreSideBySide() const { return this->SideBySide; }

  // The corner (x, y) of the cells, 0 or 1.
  HWY_INLINE Vector Corner(Tag tag, int x, int y) const
  {
    const std::int32_t offset = x * this->PitchX + y * this->PitchY;
    return this->SideBySide ? hn::LoadU(tag, this->Data + this->Start + offset)
                            : hn::GatherIndex(tag, this->Data + offset, this->Index);
  }

  // At samples of each ray's own.
  HWY_INLINE Vector Gather(Tag tag, Ints samples, Mask active) const
  {
    const Ints own = hn::IfThenElseZero(hn::RebindMask(IntTag(), active), samples);
    return hn::GatherIndex(tag, this->Data, own);
  }

private:
  const float* Data;
  std::int32_t PitchX;
  std::int32_t PitchY;
  std::int32_t Count;
  std::int32_t Lanes;
  std::int32_t Start = 0;
  Ints Index;
  bool SideBySide = false;
};

// A place between two samples, counted from the nearer one, as reliefEdgeHeight() does.
struct Between
{
  HWY_INLINE Between(Tag tag, Vector place, Vector cell)
  {
    const Vector before = hn::Sub(place, cell);
    const Vector after = hn::Sub(hn::Add(cell, hn::Set(tag, 1.0f)), place);
    this->Far = hn::Lt(after, before);
    this->Weight = hn::Max(hn::Min(before, after), hn::Zero(tag));
  }

  HWY_INLINE Vector At(Tag, Vector first, Vector second) const
  {
    const Vector near = hn::IfThenElse(this->Far, second, first);
    const Vector other = hn::IfThenElse(this->Far, first, second);
    return hn::MulAdd(hn::Sub(other, near), this->Weight, near);
  }

  Mask Far;
  Vector Weight;
};

// Traces the active rays of a packet. Its samples are (i, j), (i + 1, j), ... Rays that have come
// to their end go on beside the others, without counting, which keeps the packet's cells side by
// side.
void TraceLanes(const Field<float>& field, const f32::ReliefMedium& medium, int i, int j,
  Packet& packet, RayCount& count)
{
  const Tag tag;
  const IntTag intTag;
  const HeightView<float>& heights = field.heights;
  const Vector zero = hn::Zero(tag);
  const Vector one = hn::Set(tag, 1.0f);
  const Vector infinite = hn::Set(tag, Infinity);
  const Settler settler(medium);
  HeightLanes reader(heights, tag);

  const Vector x = hn::Load(tag, packet.x);
  const Vector y = hn::Load(tag, packet.y);
  const Vector base = hn::Load(tag, packet.base);
  const Vector sink = hn::Load(tag, packet.sink);
  const Vector dx = hn::Load(tag, packet.dx);
  const Vector dy = hn::Load(tag, packet.dy);
  const Vector dz = hn::Load(tag, packet.dz);
  const Vector from = hn::Load(tag, packet.from);
  const Vector to = hn::Load(tag, packet.to);
  const Mask west = hn::Lt(dx, zero);
  const Mask south = hn::Lt(dy, zero);
  const Mask alongY = hn::Eq(dx, zero);
  const Mask alongX = hn::Eq(dy, zero);
  // A ray along a grid line never crosses it: times 0 plus infinity. The start is multiplied apart:
  // a start close to a line, added to whole cells, would lose its distance from it.
  const Vector inverseX = hn::IfThenZeroElse(alongY, hn::Div(one, dx));
  const Vector inverseY = hn::IfThenZeroElse(alongX, hn::Div(one, dy));
  const Vector startX = hn::IfThenElse(alongY, infinite, hn::Neg(hn::Mul(x, inverseX)));
  const Vector startY = hn::IfThenElse(alongX, infinite, hn::Neg(hn::Mul(y, inverseY)));
  const Vector perCell = hn::Div(one, hn::Max(hn::Abs(dx), hn::Abs(dy)));
  const Vector acrossX = hn::Abs(dx);
  const Vector acrossY = hn::Abs(dy);
  const Vector aheadX = hn::IfThenZeroElse(west, one); // from a cell to the line ahead of it
  const Vector aheadY = hn::IfThenZeroElse(south, one);
  const Vector stepX = hn::IfThenElse(west, hn::Set(tag, -1.0f), one);
  const Vector stepY = hn::IfThenElse(south, hn::Set(tag, -1.0f), one);

  // Sample i + lane stands at lane, as a cell does that begins there.
  const Vector lane = hn::ConvertTo(tag, hn::Iota(intTag, 0));
  const Vector lastX = hn::Sub(hn::Set(tag, static_cast<float>(heights.columns - 2 - i)), lane);
  const Vector firstX = hn::Sub(hn::Set(tag, static_cast<float>(-i)), lane);
  const Vector lastY = hn::Set(tag, static_cast<float>(heights.rows - 2 - j));
  const Vector firstY = hn::Set(tag, static_cast<float>(-j));
  const Ints pitchX = hn::Set(intTag, static_cast<std::int32_t>(heights.stepX));
  const Ints pitchY = hn::Set(intTag, static_cast<std::int32_t>(heights.stepY));
  const Ints ownIndex =
    hn::Add(hn::Set(intTag, static_cast<std::int32_t>(j * heights.stepY + i * heights.stepX)),
      hn::Mul(hn::Iota(intTag, 0), pitchX));
  const Mask none = hn::Lt(zero, zero);
  const Ints zeroInts = hn::Zero(intTag);
  const auto westInts = hn::RebindMask(intTag, west);
  const auto southInts = hn::RebindMask(intTag, south);
  const Ints moveX = hn::IfThenElse(westInts, hn::Sub(zeroInts, pitchX), pitchX);
  const Ints moveY = hn::IfThenElse(southInts, hn::Sub(zeroInts, pitchY), pitchY);
  const Ints edgeX = hn::IfThenZeroElse(westInts, pitchX); // from a cell to the edge ahead
  const Ints edgeY = hn::IfThenZeroElse(southInts, pitchY);

  Vector cellX = hn::Load(tag, packet.cellX);
  Vector cellY = hn::Load(tag, packet.cellY);
  auto indexOf = [&]()
  {
    return hn::Add(ownIndex,
      hn::Add(hn::Mul(hn::ConvertTo(intTag, cellY), pitchY),
        hn::Mul(hn::ConvertTo(intTag, cellX), pitchX)));
  };
  Ints index = indexOf();
  Vector s = zero;
  Vector ground = hn::Load(tag, packet.ground);
  Vector thickness = zero;
  Vector rest = zero;
  Vector above = hn::Add(ground, sink); // the ground's height above the ray
  Mask onSurface = hn::Not(none); // whether ground is the surface's height, or one that is held
  bool allOnSurface = true;
  bool resumed = false; // after a skipped stretch, where the ground is not known yet
  Mask active = hn::MaskFromVec(hn::BitCast(tag, hn::Load(intTag, packet.active)));
  active = hn::And(active, hn::Lt(s, to));

  const bool anyFrom = !hn::AllFalse(tag, hn::Gt(from, zero));
  // Whether all rays run to the same side of each axis, and to which.
  const bool oneWay = (hn::AllTrue(tag, west) || hn::AllFalse(tag, west)) &&
    (hn::AllTrue(tag, south) || hn::AllFalse(tag, south));
  const int eastward = hn::AllFalse(tag, west) ? 1 : 0;
  const int northward = hn::AllFalse(tag, south) ? 1 : 0;

  // The margin of reliefAbove(), and more than it anywhere on the ray.
  const Vector rounding = hn::Set(tag, f32::RELIEF_ROUNDING);
  auto marginAt = [&](Vector rise) { return hn::Mul(rounding, hn::Add(hn::Abs(rise), sink)); };
  const Vector widest = marginAt(hn::IfThenZeroElse(hn::Eq(dz, zero), hn::Mul(to, dz)));

  const int stepsBetweenLooks = 6;
  // Steps to the next look for something to skip. Rays sunk along the normal may first cross a grid
  // line just beside their sample, where only the careful steps keep the sample's height apart.
  int untilLook = medium.offset == f32::RELIEF_SURFACE_NORMAL ? 2 : 0;
  float reach = 8.0f; // how many cells to look ahead
  float twist =
    Infinity; // no patch in the stretch looked at is more twisted; infinite where it has holes
  while (!hn::AllFalse(tag, active))
  {
    if (untilLook == 0)
    {
      untilLook = stepsBetweenLooks;
      twist = Infinity;
      count.cells += 1;
      if (medium.tolerance > 0.0f)
      {
        const Vector left = hn::Sub(to, hn::Max(s, from));
        const Mask settled = hn::AndNot(settler.Open(tag, thickness, left), active);
        rest = hn::IfThenElse(settled, left, rest);
        active = hn::AndNot(settled, active);
        if (hn::AllFalse(tag, active))
        {
          break;
        }
      }

      // As far as all rays get in `reach` cells. Where rays would leave the image they keep to
      // their steps.
      const Vector ahead = hn::MulAdd(hn::Set(tag, reach - 0.5f), perCell, s);
      const Vector x1 = hn::MulAdd(dx, ahead, x);
      const Vector y1 = hn::MulAdd(dy, ahead, y);
      const Vector endX = hn::Floor(x1);
      const Vector endY = hn::Floor(y1);
      const Mask inside = hn::And(hn::And(hn::Ge(endX, firstX), hn::Le(endX, lastX)),
        hn::And(hn::Ge(endY, firstY), hn::Le(endY, lastY)));
      const Mask within = hn::And(hn::And(hn::Ge(cellX, firstX), hn::Le(cellX, lastX)),
        hn::And(hn::Ge(cellY, firstY), hn::Le(cellY, lastY)));
      if (hn::AllFalse(tag, hn::AndNot(hn::And(inside, within), active)))
      {
        const Vector lowX = hn::Add(hn::Min(cellX, endX), lane);
        const Vector highX = hn::Add(hn::Max(cellX, endX), lane);
        const Vector z0 = hn::Sub(hn::MulAdd(s, dz, base), sink);
        const Vector z1 = hn::Sub(hn::MulAdd(ahead, dz, base), sink);
        const int i0 = i + static_cast<int>(Least(tag, active, lowX));
        const int i1 = i + static_cast<int>(Greatest(tag, active, highX));
        const int j0 = j + static_cast<int>(Least(tag, active, hn::Min(cellY, endY)));
        const int j1 = j + static_cast<int>(Greatest(tag, active, hn::Max(cellY, endY)));
        const int size = std::max(i1 - i0, j1 - j0);
        const int level = std::min(size > 40 ? 3
            : size > 20                      ? 2
                                             : 1,
          field.bounds->GetNumberOfLevels() - 1);
        const MinMaxPyramid::Bounds bounds = field.bounds->Over(level, i0, i1, j0, j1);
        const bool over = Least(tag, active, hn::Min(z0, z1)) > bounds.hi;
        const bool under = Greatest(tag, active, hn::Add(hn::Max(z0, z1), widest)) < bounds.lo;
        if (over || under)
        {
          if (under)
          {
            const Vector length = hn::Max(hn::Sub(hn::Min(ahead, to), hn::Max(s, from)), zero);
            thickness = hn::Add(thickness, hn::IfThenElseZero(active, length));
          }
          s = ahead;
          // Still a cell that was looked at, so that the surface is known where a hole begins
          // behind it.
          cellX = hn::IfThenElse(alongY, cellX, endX);
          cellY = hn::IfThenElse(alongX, cellY, endY);
          index = indexOf();
          onSurface = none;
          allOnSurface = false;
          resumed = true;
          active = hn::And(active, hn::Lt(s, to));
          reach = std::min(2.0f * reach, 64.0f);
          untilLook = 0;
          continue;
        }
        twist = bounds.twist;
      }
      if (reach > 8.0f)
      {
        reach *= 0.5f;
        if (reach > 16.0f)
        {
          untilLook = 0;
          continue;
        }
      }
    }
    --untilLook;
    count.cells += hn::CountTrue(tag, active);

    // Where the ray leaves its cell.
    const Vector exitX = hn::MulAdd(hn::Add(cellX, aheadX), inverseX, startX);
    const Vector exitY = hn::MulAdd(hn::Add(cellY, aheadY), inverseY, startY);
    const Mask throughX = hn::Le(exitX, exitY);
    const Vector s1 = hn::Max(hn::Min(exitX, exitY), s);
    const Vector length = hn::Sub(s1, s);
    const auto throughXInts = hn::RebindMask(intTag, throughX);
    // Rays whose stretch begins or ends in this cell.
    const Mask ending = hn::AndNot(hn::Lt(s1, to), active);
    const Mask clipped = anyFrom ? hn::Or(ending, hn::And(active, hn::Gt(from, s))) : ending;
    const bool whole = twist < Infinity && hn::AllFalse(tag, clipped) && allOnSurface;
    bool done = false;
    Vector next = ground;
    if (whole)
    {
      // No holes about: two samples tell the height at the exit, and if no ray is near the surface,
      // that is all.
      reader.SetCells(index, active);
      Vector first;
      Vector second;
      if (reader.AreSideBySide() && oneWay)
      {
        first = hn::IfThenElse(
          throughX, reader.Corner(tag, eastward, 0), reader.Corner(tag, 0, northward));
        second = hn::IfThenElse(
          throughX, reader.Corner(tag, eastward, 1), reader.Corner(tag, 1, northward));
      }
      else
      {
        const Ints edge = hn::IfThenElse(throughXInts, edgeX, edgeY);
        const Ints other = hn::Add(edge, hn::IfThenElse(throughXInts, pitchY, pitchX));
        first = reader.Gather(tag, hn::Add(index, edge), active);
        second = reader.Gather(tag, hn::Add(index, other), active);
      }
      const Vector share = hn::IfThenElse(
        throughX, hn::Sub(hn::MulAdd(dy, s1, y), cellY), hn::Sub(hn::MulAdd(dx, s1, x), cellX));
      next = hn::MulAdd(hn::Sub(second, first), share, hn::Sub(first, base));
      const Vector a = above;
      const Vector b = hn::Sub(next, hn::Sub(hn::Mul(s1, dz), sink));
      const Vector bow = hn::MulAdd(hn::Set(tag, 0.25f * twist),
        hn::Mul(hn::Mul(acrossX, length), hn::Mul(acrossY, length)), widest);
      const Mask in = hn::Gt(hn::Min(a, b), bow);
      const Mask out = hn::Lt(hn::Add(hn::Max(a, b), bow), zero);
      if (hn::AllFalse(tag, hn::AndNot(hn::Or(in, out), active)))
      {
        thickness = hn::Add(thickness, hn::IfThenElseZero(hn::And(in, active), length));
        above = b;
        done = true;
      }
    }
    if (!done)
    {
      // Rays that have left the image end under level ground.
      const Mask inImage = hn::And(hn::And(hn::Ge(cellX, firstX), hn::Le(cellX, lastX)),
        hn::And(hn::Ge(cellY, firstY), hn::Le(cellY, lastY)));
      const Mask leaving = hn::AndNot(inImage, active);
      if (!hn::AllFalse(tag, leaving))
      {
        const Vector level = hn::Add(ground, sink);
        const Mask apart = hn::Gt(hn::Abs(level), marginAt(zero));
        const Vector tail =
          LevelLength(tag, hn::Max(s, from), to, hn::IfThenElseZero(apart, level), dz);
        thickness = hn::Add(thickness, hn::IfThenElseZero(leaving, tail));
        active = hn::AndNot(leaving, active);
        if (hn::AllFalse(tag, active))
        {
          break;
        }
      }

      reader.SetCells(index, active);
      const Vector h00 = hn::Sub(reader.Corner(tag, 0, 0), base);
      const Vector h10 = hn::Sub(reader.Corner(tag, 1, 0), base);
      const Vector h01 = hn::Sub(reader.Corner(tag, 0, 1), base);
      const Vector h11 = hn::Sub(reader.Corner(tag, 1, 1), base);
      const Vector ownTwist = hn::Sub(hn::Sub(h11, h10), hn::Sub(h01, h00));
      // A cell of which a ray only touches a corner does not end a hole.
      const Mask touched =
        hn::AndNot(onSurface, hn::Le(length, hn::Mul(s1, hn::Set(tag, f32::RELIEF_TOUCH))));
      const Mask hole = resumed ? hn::IsNaN(ownTwist) : hn::Or(hn::IsNaN(ownTwist), touched);
      const Vector first =
        hn::IfThenElse(throughX, hn::IfThenElse(west, h00, h10), hn::IfThenElse(south, h00, h01));
      const Vector second =
        hn::IfThenElse(throughX, hn::IfThenElse(west, h01, h11), hn::IfThenElse(south, h10, h11));

      // A ray that comes out of a hole or from a skipped stretch meets the patch where it is.
      if (!hn::AllFalse(tag, hn::AndNot(onSurface, active)))
      {
        const Between alongRow(tag, hn::MulAdd(dx, s, x), cellX);
        const Between alongColumn(tag, hn::MulAdd(dy, s, y), cellY);
        const Vector here =
          alongColumn.At(tag, alongRow.At(tag, h00, h10), alongRow.At(tag, h01, h11));
        ground = hn::IfThenElse(hn::Or(onSurface, hole), ground, here);
      }
      const Between alongEdge(tag,
        hn::IfThenElse(throughX, hn::MulAdd(dy, s1, y), hn::MulAdd(dx, s1, x)),
        hn::IfThenElse(throughX, cellY, cellX));
      next = hn::IfThenElse(hole, ground, alongEdge.At(tag, first, second));

      Vector begin = s;
      Vector end = s1;
      const Vector rise0 = hn::Mul(s, dz);
      const Vector rise1 = hn::Mul(s1, dz);
      Vector a = hn::Sub(ground, hn::Sub(rise0, sink));
      Vector b = hn::Sub(next, hn::Sub(rise1, sink));
      above = b;
      Vector c = hn::IfThenZeroElse(
        hole, hn::Mul(ownTwist, hn::Mul(hn::Mul(dx, length), hn::Mul(dy, length))));
      if (!hn::AllFalse(tag, clipped))
      {
        // reliefPatchLength(): the quadratic over the part of the cell within [from, to].
        begin = hn::Min(hn::Max(s, from), s1);
        end = hn::Max(hn::Min(s1, to), begin);
        const Vector perLength = hn::IfThenElseZero(hn::Gt(length, zero), hn::Div(one, length));
        const Vector u0 = hn::Mul(hn::Sub(begin, s), perLength);
        const Vector u1 = hn::Mul(hn::Sub(end, s), perLength);
        const Vector rise = hn::Sub(b, a);
        const Vector a0 = hn::Add(a, hn::Mul(u0, hn::MulAdd(c, hn::Sub(u0, one), rise)));
        const Vector b0 = hn::Add(a, hn::Mul(u1, hn::MulAdd(c, hn::Sub(u1, one), rise)));
        const Vector span = hn::Sub(u1, u0);
        a = hn::IfThenElse(clipped, a0, a);
        b = hn::IfThenElse(clipped, b0, b);
        c = hn::IfThenElse(clipped, hn::Mul(c, hn::Mul(span, span)), c);
      }
      onSurface = hn::Not(hole);
      allOnSurface = hn::AllFalse(tag, hn::AndNot(onSurface, active));
      resumed = false;
      const Vector scale = Normalizer(tag, hn::Max(hn::Abs(a), hn::Max(hn::Abs(b), hn::Abs(c))));
      const Vector share = InsideShare(tag, hn::Mul(a, scale), hn::Mul(b, scale), hn::Mul(c, scale),
        hn::Mul(marginAt(hn::Mul(begin, dz)), scale), hn::Mul(marginAt(hn::Mul(end, dz)), scale));
      const Vector part = hn::Mul(hn::Sub(end, begin), share);
      thickness = hn::Add(thickness, hn::IfThenElseZero(active, part));
    }

    active = hn::AndNot(ending, active);
    ground = next;
    cellX = hn::IfThenElse(throughX, hn::Add(cellX, stepX), cellX);
    cellY = hn::IfThenElse(throughX, cellY, hn::Add(cellY, stepY));
    index = hn::Add(index, hn::IfThenElse(throughXInts, moveX, moveY));
    s = s1;
  }
  hn::Store(thickness, tag, packet.thickness);
  hn::Store(rest, tag, packet.rest);
}

}
}
HWY_AFTER_NAMESPACE();

#endif
