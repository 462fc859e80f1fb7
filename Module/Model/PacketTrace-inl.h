// SPDX-License-Identifier: BSD-3-Clause
// Included once for each instruction set, hence the guard that toggles.
#if defined(PacketTrace_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef PacketTrace_inl_h
#undef PacketTrace_inl_h
#else
#define PacketTrace_inl_h
#endif

#include "MinMaxPyramid.h"
#include "PacketLanes-inl.h"
#include "RayThickness.h"

#include <algorithm>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace relief
{
namespace HWY_NAMESPACE
{

// Where a packet's rays run. References, since on some processors a vector cannot be a member; all
// is inlined where they are.
struct LaneRays
{
  const Vector& x;
  const Vector& y;
  const Vector& base;
  const Vector& sink;
  const Vector& dx;
  const Vector& dy;
  const Vector& dz;
  const Vector& from;
  const Vector& to;
  const Vector& perCell; // length that is a cell at most
  const Vector& acrossX; // cells per unit of length
  const Vector& acrossY;
  const Vector& lane;
  const Vector& firstX; // cells of the image
  const Vector& lastX;
  const Vector& firstY;
  const Vector& lastY;
  const Vector& widest; // more than the margin anywhere on the ray
  const Mask& west;
  const Mask& south;
  const Mask& alongX;
  const Mask& alongY;
  const Ints& pitchX;
  const Ints& pitchY;
  const Ints& edgeX; // from a cell to the edge ahead
  const Ints& edgeY;
  bool oneWay; // whether all rays run to the same side of each axis, and to which
  int eastward;
  int northward;
};

// How far the rays are.
struct LaneState
{
  Packet& packet;
  Vector& s;
  Vector& cellX;
  Vector& cellY;
  Vector& ground;
  Vector& above; // the ground's height above the ray
  Vector& thickness;
  Mask& onSurface; // whether ground is the surface's height, or one that is held
  Mask& active;
  Mask& inside; // rays that were inside where what is held began
  Mask& alone;  // rays to be traced by themselves
  bool allOnSurface = true;
  bool resumed = false;   // after a skipped stretch, where the ground is not known yet
  float reach = 8.0f;     // how many cells to look ahead
  float twist = Infinity; // no patch in the stretch looked at is more twisted; infinite with holes
};

// The way of the rays through their cells.
struct LaneStep
{
  const Mask& throughX;
  const Vector& s1;
  const Vector& length;
  const Mask& clipped; // rays whose stretch begins or ends in this cell
};

HWY_INLINE Mask InImage(const LaneRays& rays, Vector cellX, Vector cellY)
{
  return hn::And(hn::And(hn::Ge(cellX, rays.firstX), hn::Le(cellX, rays.lastX)),
    hn::And(hn::Ge(cellY, rays.firstY), hn::Le(cellY, rays.lastY)));
}

// The margin of reliefAbove().
HWY_INLINE Vector MarginAt(Vector sink, Vector rise)
{
  return hn::Mul(hn::Set(Tag(), f32::RELIEF_ROUNDING), hn::Add(hn::Abs(rise), sink));
}

// Looks whether the next cells of all rays lie above or below them, and if so takes the rays there.
// Otherwise it learns how twisted the patches are.
HWY_INLINE bool LookAhead(
  const Field<float>& field, int i, int j, const LaneRays& rays, LaneState& state)
{
  const Tag tag;
  const Vector zero = hn::Zero(tag);

  // As far as all rays get in `reach` cells. Where rays would leave the image they keep to their
  // steps.
  const Vector ahead = hn::MulAdd(hn::Set(tag, state.reach - 0.5f), rays.perCell, state.s);
  const Vector x1 = hn::MulAdd(rays.dx, ahead, rays.x);
  const Vector y1 = hn::MulAdd(rays.dy, ahead, rays.y);
  const Vector endX = hn::Floor(x1);
  const Vector endY = hn::Floor(y1);
  const Mask inside = hn::And(InImage(rays, endX, endY), InImage(rays, state.cellX, state.cellY));
  if (!hn::AllFalse(tag, hn::AndNot(inside, state.active)))
  {
    return false;
  }
  const Vector lowX = hn::Add(hn::Min(state.cellX, endX), rays.lane);
  const Vector highX = hn::Add(hn::Max(state.cellX, endX), rays.lane);
  const Vector z0 = hn::Sub(hn::MulAdd(state.s, rays.dz, rays.base), rays.sink);
  const Vector z1 = hn::Sub(hn::MulAdd(ahead, rays.dz, rays.base), rays.sink);
  const int i0 = i + static_cast<int>(Least(tag, state.active, lowX));
  const int i1 = i + static_cast<int>(Greatest(tag, state.active, highX));
  const int j0 = j + static_cast<int>(Least(tag, state.active, hn::Min(state.cellY, endY)));
  const int j1 = j + static_cast<int>(Greatest(tag, state.active, hn::Max(state.cellY, endY)));
  const int size = std::max(i1 - i0, j1 - j0);
  const int level = std::min(size > 40 ? 3
      : size > 20                      ? 2
                                       : 1,
    field.bounds->GetNumberOfLevels() - 1);
  const MinMaxPyramid::Bounds bounds = field.bounds->Over(level, i0, i1, j0, j1);
  const bool over = Least(tag, state.active, hn::Min(z0, z1)) > bounds.hi;
  const bool under = Greatest(tag, state.active, hn::Add(hn::Max(z0, z1), rays.widest)) < bounds.lo;
  if (!over && !under)
  {
    state.twist = bounds.twist;
    return false;
  }
  if (under)
  {
    const Vector part =
      hn::Max(hn::Sub(hn::Min(ahead, rays.to), hn::Max(state.s, rays.from)), zero);
    state.thickness = hn::Add(state.thickness, hn::IfThenElseZero(state.active, part));
  }
  state.s = ahead;
  // Still a cell that was looked at, so that the surface is known where a hole begins behind
  // it.
  state.cellX = hn::IfThenElse(rays.alongY, state.cellX, endX);
  state.cellY = hn::IfThenElse(rays.alongX, state.cellY, endY);
  state.onSurface = hn::Lt(zero, zero);
  state.allOnSurface = false;
  state.resumed = true;
  state.active = hn::And(state.active, hn::Lt(state.s, rays.to));
  state.reach = std::min(2.0f * state.reach, 64.0f);
  return true;
}

// A step where no holes are about and no ray begins or ends: two samples tell the height at the
// exit, and if no ray is near the surface, that is all. Returns whether it is.
HWY_INLINE bool StepQuickly(HeightLanes& reader, Ints index, const LaneRays& rays,
  const LaneStep& step, LaneState& state, Vector& next)
{
  const Tag tag;
  const Vector zero = hn::Zero(tag);
  reader.SetCells(index);
  Vector first;
  Vector second;
  if (reader.AreSideBySide() && rays.oneWay)
  {
    first = hn::IfThenElse(step.throughX, reader.Corner(tag, rays.eastward, 0, index, state.active),
      reader.Corner(tag, 0, rays.northward, index, state.active));
    second =
      hn::IfThenElse(step.throughX, reader.Corner(tag, rays.eastward, 1, index, state.active),
        reader.Corner(tag, 1, rays.northward, index, state.active));
  }
  else
  {
    const Ints edge =
      hn::IfThenElse(hn::RebindMask(IntTag(), step.throughX), rays.edgeX, rays.edgeY);
    const Ints other = hn::Add(
      edge, hn::IfThenElse(hn::RebindMask(IntTag(), step.throughX), rays.pitchY, rays.pitchX));
    first = reader.Gather(tag, hn::Add(index, edge), state.active);
    second = reader.Gather(tag, hn::Add(index, other), state.active);
  }
  const Vector share =
    hn::IfThenElse(step.throughX, hn::Sub(hn::MulAdd(rays.dy, step.s1, rays.y), state.cellY),
      hn::Sub(hn::MulAdd(rays.dx, step.s1, rays.x), state.cellX));
  next = hn::MulAdd(hn::Sub(second, first), share, hn::Sub(first, rays.base));
  const Vector a = state.above;
  const Vector b = hn::Sub(next, hn::Sub(hn::Mul(step.s1, rays.dz), rays.sink));
  const Vector bow = hn::MulAdd(hn::Set(tag, 0.25f * state.twist),
    hn::Mul(hn::Mul(rays.acrossX, step.length), hn::Mul(rays.acrossY, step.length)), rays.widest);
  const Mask in = hn::Gt(hn::Min(a, b), bow);
  const Mask out = hn::Lt(hn::Add(hn::Max(a, b), bow), zero);
  if (hn::AllFalse(tag, hn::AndNot(hn::Or(in, out), state.active)))
  {
    state.thickness =
      hn::Add(state.thickness, hn::IfThenElseZero(hn::And(in, state.active), step.length));
    state.above = b;
    return true;
  }
  return false;
}

// Keeps what rays have where they leave the image inside.
HWY_INLINE void KeepWhereLeft(Mask inside, const LaneRays& rays, const LaneState& state)
{
  const Tag tag;
  const IntTag intTag;
  Packet& packet = state.packet;
  const Mask alongX = hn::Or(hn::Lt(state.cellX, rays.firstX), hn::Gt(state.cellX, rays.lastX));
  hn::BlendedStore(state.s, inside, tag, packet.left);
  hn::BlendedStore(state.ground, inside, tag, packet.leftGround);
  hn::BlendedStore(state.thickness, inside, tag, packet.kept);
  const auto insideInts = hn::RebindMask(intTag, inside);
  hn::BlendedStore(
    hn::VecFromMask(intTag, hn::RebindMask(intTag, alongX)), insideInts, intTag, packet.leftAlongX);
  hn::BlendedStore(hn::VecFromMask(intTag, insideInts), insideInts, intTag, packet.beyond);
}

// A step anywhere. Returns whether any ray goes on.
HWY_INLINE bool StepCarefully(HeightLanes& reader, Ints index, const LaneRays& rays,
  const LaneStep& step, LaneState& state, Vector& next)
{
  const Tag tag;
  const Vector zero = hn::Zero(tag);
  const Vector one = hn::Set(tag, 1.0f);

  // Rays that have left the image end under level ground.
  const Mask leaving = hn::AndNot(InImage(rays, state.cellX, state.cellY), state.active);
  if (!hn::AllFalse(tag, leaving))
  {
    const Vector above = hn::Sub(state.ground, hn::Sub(hn::Mul(state.s, rays.dz), rays.sink));
    KeepWhereLeft(hn::And(hn::And(leaving, state.onSurface), hn::Gt(above, zero)), rays, state);
    const Vector level = hn::Add(state.ground, rays.sink);
    const Mask apart = hn::Gt(hn::Abs(level), MarginAt(rays.sink, zero));
    const Vector tail = lanes::reliefLevelLength(
      hn::Max(state.s, rays.from), rays.to, hn::IfThenElseZero(apart, level), rays.dz);
    state.thickness = hn::Add(state.thickness, hn::IfThenElseZero(leaving, tail));
    state.active = hn::AndNot(leaving, state.active);
    if (hn::AllFalse(tag, state.active))
    {
      return false;
    }
  }

  reader.SetCells(index);
  const Vector h00 = hn::Sub(reader.Corner(tag, 0, 0, index, state.active), rays.base);
  const Vector h10 = hn::Sub(reader.Corner(tag, 1, 0, index, state.active), rays.base);
  const Vector h01 = hn::Sub(reader.Corner(tag, 0, 1, index, state.active), rays.base);
  const Vector h11 = hn::Sub(reader.Corner(tag, 1, 1, index, state.active), rays.base);
  const Vector ownTwist = hn::Sub(hn::Sub(h11, h10), hn::Sub(h01, h00));
  // A cell of which a ray only touches a corner does not end a hole.
  const Mask touched = hn::AndNot(
    state.onSurface, hn::Le(step.length, hn::Mul(step.s1, hn::Set(tag, f32::RELIEF_TOUCH))));
  const Mask hole = state.resumed ? hn::IsNaN(ownTwist) : hn::Or(hn::IsNaN(ownTwist), touched);
  // Along a grid line the cell on its other side may have data.
  const Mask beside = hn::And(hn::IsNaN(ownTwist),
    hn::Or(hn::And(rays.alongX, hn::Eq(rays.y, state.cellY)),
      hn::And(rays.alongY, hn::Eq(rays.x, state.cellX))));
  state.alone = hn::Or(state.alone, hn::And(beside, state.active));
  state.active = hn::AndNot(beside, state.active);
  const Vector first = hn::IfThenElse(
    step.throughX, hn::IfThenElse(rays.west, h00, h10), hn::IfThenElse(rays.south, h00, h01));
  const Vector second = hn::IfThenElse(
    step.throughX, hn::IfThenElse(rays.west, h01, h11), hn::IfThenElse(rays.south, h10, h11));

  // A ray that comes out of a hole or from a skipped stretch meets the patch where it is.
  if (!hn::AllFalse(tag, hn::AndNot(state.onSurface, state.active)))
  {
    const Vector placeX = hn::MulAdd(rays.dx, state.s, rays.x);
    const Vector placeY = hn::MulAdd(rays.dy, state.s, rays.y);
    const Vector here =
      lanes::reliefBetween(placeY, state.cellY, lanes::reliefBetween(placeX, state.cellX, h00, h10),
        lanes::reliefBetween(placeX, state.cellX, h01, h11));
    state.ground = hn::IfThenElse(hn::Or(state.onSurface, hole), state.ground, here);
  }
  const Vector place = hn::IfThenElse(
    step.throughX, hn::MulAdd(rays.dy, step.s1, rays.y), hn::MulAdd(rays.dx, step.s1, rays.x));
  const Vector line = hn::IfThenElse(step.throughX, state.cellY, state.cellX);
  next = hn::IfThenElse(hole, state.ground, lanes::reliefBetween(place, line, first, second));

  Vector begin = state.s;
  Vector end = step.s1;
  const Vector rise0 = hn::Mul(state.s, rays.dz);
  const Vector rise1 = hn::Mul(step.s1, rays.dz);
  Vector a = hn::Sub(state.ground, hn::Sub(rise0, rays.sink));
  Vector b = hn::Sub(next, hn::Sub(rise1, rays.sink));
  state.above = b;
  // Of rays that have ended it stays known.
  const Mask enters = hn::And(state.onSurface, hn::Gt(a, zero));
  const Mask within = hn::And(hn::And(hole, hn::Or(state.inside, enters)), state.active);
  state.inside = hn::Or(hn::AndNot(state.active, state.inside), within);
  Vector c = hn::IfThenZeroElse(
    hole, hn::Mul(ownTwist, hn::Mul(hn::Mul(rays.dx, step.length), hn::Mul(rays.dy, step.length))));
  if (!hn::AllFalse(tag, step.clipped))
  {
    // reliefPatchLength(): the quadratic over the part of the cell within [from, to].
    begin = hn::Min(hn::Max(state.s, rays.from), step.s1);
    end = hn::Max(hn::Min(step.s1, rays.to), begin);
    const Vector perLength =
      hn::IfThenElseZero(hn::Gt(step.length, zero), hn::Div(one, step.length));
    const Vector u0 = hn::Mul(hn::Sub(begin, state.s), perLength);
    const Vector u1 = hn::Mul(hn::Sub(end, state.s), perLength);
    const Vector rise = hn::Sub(b, a);
    const Vector a0 = hn::Add(a, hn::Mul(u0, hn::MulAdd(c, hn::Sub(u0, one), rise)));
    const Vector b0 = hn::Add(a, hn::Mul(u1, hn::MulAdd(c, hn::Sub(u1, one), rise)));
    const Vector span = hn::Sub(u1, u0);
    a = hn::IfThenElse(step.clipped, a0, a);
    b = hn::IfThenElse(step.clipped, b0, b);
    c = hn::IfThenElse(step.clipped, hn::Mul(c, hn::Mul(span, span)), c);
  }
  state.onSurface = hn::Not(hole);
  state.allOnSurface = hn::AllFalse(tag, hn::AndNot(state.onSurface, state.active));
  state.resumed = false;
  const Vector scale = Normalizer(tag, hn::Max(hn::Abs(a), hn::Max(hn::Abs(b), hn::Abs(c))));
  const Vector share = InsideShare(tag, hn::Mul(a, scale), hn::Mul(b, scale), hn::Mul(c, scale),
    hn::Mul(MarginAt(rays.sink, hn::Mul(begin, rays.dz)), scale),
    hn::Mul(MarginAt(rays.sink, hn::Mul(end, rays.dz)), scale));
  const Vector part = hn::Mul(hn::Sub(end, begin), share);
  state.thickness = hn::Add(state.thickness, hn::IfThenElseZero(state.active, part));
  return true;
}

// What rays straight up or down have: ground that is as high everywhere, whatever is about.
void TraceUprightLanes(Packet& packet)
{
  const Tag tag;
  const IntTag intTag;
  const Vector sink = hn::Load(tag, packet.sink);
  const Vector level = hn::Add(hn::Load(tag, packet.ground), sink);
  const Mask apart = hn::Gt(hn::Abs(level), MarginAt(sink, hn::Zero(tag)));
  const Vector length = lanes::reliefLevelLength(hn::Load(tag, packet.from),
    hn::Load(tag, packet.to), hn::IfThenElseZero(apart, level), hn::Load(tag, packet.dz));
  const auto upright = hn::MaskFromVec(hn::Load(intTag, packet.upright));
  hn::BlendedStore(length, hn::RebindMask(tag, upright), tag, packet.thickness);
}

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
  const Vector rayEnd = hn::Load(tag, packet.end);
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
  const Ints lanes = hn::Load(intTag, packet.lane);
  const Vector lane = hn::ConvertTo(tag, lanes);
  const Vector lastX = hn::Sub(hn::Set(tag, static_cast<float>(heights.columns - 2 - i)), lane);
  const Vector firstX = hn::Sub(hn::Set(tag, static_cast<float>(-i)), lane);
  const Vector lastY = hn::Set(tag, static_cast<float>(heights.rows - 2 - j));
  const Vector firstY = hn::Set(tag, static_cast<float>(-j));
  const Ints pitchX = hn::Set(intTag, static_cast<std::int32_t>(heights.stepX));
  const Ints pitchY = hn::Set(intTag, static_cast<std::int32_t>(heights.stepY));
  const Ints ownIndex =
    hn::Add(hn::Set(intTag, static_cast<std::int32_t>(j * heights.stepY + i * heights.stepX)),
      hn::Mul(lanes, pitchX));
  const Ints zeroInts = hn::Zero(intTag);
  const auto westInts = hn::RebindMask(intTag, west);
  const auto southInts = hn::RebindMask(intTag, south);
  const Ints moveX = hn::IfThenElse(westInts, hn::Sub(zeroInts, pitchX), pitchX);
  const Ints moveY = hn::IfThenElse(southInts, hn::Sub(zeroInts, pitchY), pitchY);
  const Ints edgeX = hn::IfThenZeroElse(westInts, pitchX);
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
  Vector s = hn::Load(tag, packet.s);
  Vector ground = hn::Load(tag, packet.ground);
  Vector thickness = hn::Load(tag, packet.thickness);
  Vector rest = zero;
  Vector above = hn::Sub(ground, hn::Sub(hn::Mul(s, dz), sink));
  Mask onSurface = hn::Not(hn::MaskFromVec(hn::BitCast(tag, hn::Load(intTag, packet.resumed))));
  Mask active = hn::MaskFromVec(hn::BitCast(tag, hn::Load(intTag, packet.active)));
  active = hn::And(active, hn::Lt(s, to));
  Mask inside = hn::Lt(zero, zero);
  Mask alone = inside;
  // Rays for which the ground goes on beyond the data, as reliefGoesOn() tells.
  const Mask goesOn = medium.useFloor ? inside : hn::Gt(dz, zero);

  const bool anyFrom = !hn::AllFalse(tag, hn::Gt(from, zero));
  const bool oneWay = (hn::AllTrue(tag, west) || hn::AllFalse(tag, west)) &&
    (hn::AllTrue(tag, south) || hn::AllFalse(tag, south));
  const int eastward = hn::AllFalse(tag, west) ? 1 : 0;
  const int northward = hn::AllFalse(tag, south) ? 1 : 0;

  const Vector widest = MarginAt(sink, hn::IfThenZeroElse(hn::Eq(dz, zero), hn::Mul(to, dz)));
  const LaneRays rays = { x, y, base, sink, dx, dy, dz, from, to, perCell, acrossX, acrossY, lane,
    firstX, lastX, firstY, lastY, widest, west, south, alongX, alongY, pitchX, pitchY, edgeX, edgeY,
    oneWay, eastward, northward };
  hn::Store(zeroInts, intTag, packet.beyond);
  LaneState state = { packet, s, cellX, cellY, ground, above, thickness, onSurface, active, inside,
    alone };
  if (!hn::AllTrue(tag, onSurface))
  {
    state.allOnSurface = false;
    state.resumed = true;
  }

  const int stepsBetweenLooks = 6;
  // Steps to the next look for something to skip. Rays sunk along the normal may first cross a grid
  // line just beside their sample, where only the careful steps keep the sample's height apart.
  int untilLook = medium.offset == f32::RELIEF_SURFACE_NORMAL ? 2 : 0;
  while (!hn::AllFalse(tag, active))
  {
    if (untilLook == 0)
    {
      untilLook = stepsBetweenLooks;
      state.twist = Infinity;
      count.cells += 1;
      if (medium.tolerance > 0.0f)
      {
        // As reliefRest(). What lies beyond data that were left inside is not known.
        const Vector once = hn::Sub(to, hn::Max(s, from));
        const Vector left =
          hn::IfThenElse(goesOn, hn::Min(hn::Add(once, once), hn::Sub(rayEnd, s)), once);
        const Mask open = hn::Or(settler.Open(tag, thickness, left), hn::And(goesOn, inside));
        const Mask settled = hn::AndNot(open, active);
        rest = hn::IfThenElse(settled, left, rest);
        active = hn::AndNot(settled, active);
        if (hn::AllFalse(tag, active))
        {
          break;
        }
      }

      if (LookAhead(field, i, j, rays, state))
      {
        index = indexOf();
        untilLook = 0;
        continue;
      }
      if (state.reach > 8.0f)
      {
        state.reach *= 0.5f;
        if (state.reach > 16.0f)
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
    const LaneStep step = { throughX, s1, length, clipped };
    const bool whole = state.twist < Infinity && hn::AllFalse(tag, clipped) && state.allOnSurface;
    Vector next = ground;
    if (!(whole && StepQuickly(reader, index, rays, step, state, next)) &&
      !StepCarefully(reader, index, rays, step, state, next))
    {
      break;
    }
    active = hn::AndNot(ending, active);
    ground = next;
    cellX = hn::IfThenElse(throughX, hn::Add(cellX, stepX), cellX);
    cellY = hn::IfThenElse(throughX, cellY, hn::Add(cellY, stepY));
    index = hn::Add(index, hn::IfThenElse(throughXInts, moveX, moveY));
    s = s1;
  }
  // Ground beyond a hole that a ray has not left is for the text, which single rays follow.
  alone = hn::Or(alone, hn::And(goesOn, inside));
  hn::Store(thickness, tag, packet.thickness);
  hn::Store(rest, tag, packet.rest);
  hn::Store(hn::VecFromMask(intTag, hn::RebindMask(intTag, alone)), intTag, packet.alone);
}

}
}
HWY_AFTER_NAMESPACE();

#endif
