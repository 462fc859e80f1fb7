// SPDX-License-Identifier: BSD-3-Clause
// Included once for each instruction set, hence the guard that toggles.
#if defined(SweepCells_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef SweepCells_inl_h
#undef SweepCells_inl_h
#else
#define SweepCells_inl_h
#endif

#include "SweepCrossings-inl.h"
#include "SweepFloor-inl.h"

#include <cmath>
#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace relief
{
namespace HWY_NAMESPACE
{

// Where rays along a grid line have no data: where a sample on it has none, or neither of the cells
// beside it has.
HWY_INLINE Mask MissingAlong(
  Tag tag, const SweepThickness::Plan& plan, const Rows& rows, int x, int y)
{
  auto missing = [&](int i0, int j0, int i1, int j1)
  { return hn::IsNaN(hn::Add(hn::LoadU(tag, rows(j0) + i0), hn::LoadU(tag, rows(j1) + i1))); };
  return plan.dy == 0.0f
    ? hn::Or(missing(x, y, x + 1, y),
        hn::And(missing(x, y + 1, x + 1, y + 1), missing(x, y - 1, x + 1, y - 1)))
    : hn::Or(missing(x, y, x, y + 1),
        hn::And(missing(x + 1, y, x + 1, y + 1), missing(x - 1, y, x - 1, y + 1)));
}

// Walks a group's cells with every ray of a tile. While Floored, some of the rays have not come out
// of the floor where the group begins.
template <bool Floored>
void WalkCells(
  const SweepThickness::Plan& plan, const Rows& rows, const Crossings::Group& group, Tile& tile)
{
  const Tag tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const Vector zero = hn::Zero(tag);
  const Vector none = hn::Set(tag, -1.0f);
  const bool along = plan.dx == 0.0f || plan.dy == 0.0f;
  for (int row = 0; row < tile.rows; ++row)
  {
    for (int column = 0; column < SweepThickness::TileWidth; column += lanes)
    {
      const int at = row * SweepThickness::TileWidth + column;
      const int x = tile.x0 + column;
      const int y = tile.y0 + row;
      const Vector base = hn::Load(tag, tile.base + at);
      const Vector more = hn::Load(tag, tile.more + at);
      Vector surface = hn::Load(tag, tile.surface + at);
      Vector ground = hn::Load(tag, tile.ground + at);
      Vector left = hn::Load(tag, tile.left + at);
      Vector kept = hn::Load(tag, tile.kept + at);
      Vector thickness = hn::Load(tag, tile.thickness + at);
      Vector rise = hn::Set(tag, group.riseIn);
      Vector margin = MarginOf(tag, MarginAt(plan, group.riseIn), more);
      for (int k = group.begin; k < group.end; ++k)
      {
        const Crossings::Cell& cell = plan.crossings.GetCells()[k];
        const Vector twist =
          Twist(tag, rows(y + cell.y) + x + cell.x, rows(y + cell.y + 1) + x + cell.x);
        const Vector next =
          Interpolate(tag, hn::LoadU(tag, rows(y + cell.firstY) + x + cell.firstX),
            hn::LoadU(tag, rows(y + cell.secondY) + x + cell.secondX), cell.weight);

        // Across a hole the ground stays where it was, and so it does in a cell that is only
        // touched. Out of a hole it jumps to the surface.
        const Mask missing =
          along ? MissingAlong(tag, plan, rows, x + cell.x, y + cell.y) : hn::IsNaN(twist);
        const Mask held = hn::Ge(left, zero);
        const Mask hole = cell.touches ? hn::Or(missing, held) : missing;
        const Mask leaves = hn::AndNot(held, hole);
        kept = hn::IfThenElse(leaves, thickness, kept);
        left = hn::IfThenElse(
          hole, hn::IfThenElse(held, left, hn::Set(tag, static_cast<float>(k))), none);
        const Vector from = hn::IfThenElse(hole, ground, surface);
        ground = hn::IfThenElse(hole, ground, next);
        surface = next;
        Vector a = Above(from, base, rise, more);
        rise = hn::Set(tag, cell.rise);
        Vector marginIn = margin;
        margin = MarginOf(tag, MarginAt(plan, cell.rise), more);
        const Vector b = Above(ground, base, rise, more);
        const Vector bend = along ? zero : hn::Mul(twist, hn::Set(tag, cell.bend));
        Vector c = hn::IfThenZeroElse(hole, bend);

        Vector length = hn::Set(tag, cell.length);
        Vector under = zero;
        if (Floored)
        {
          under = UnderFloor(tag, hn::Load(tag, tile.from + at), cell.distance, cell.length);
          length = hn::Sub(length, under);
        }
        const Mask aInside = hn::Gt(a, zero);
        // A turning point reaches zero only if the bow, a quarter of c deep, is deeper than the
        // ends are far; and an end within the margin, which grows along the ray, is not inside.
        const Vector bow = hn::Abs(hn::Mul(c, hn::Set(tag, 0.25f)));
        const Mask crosses = hn::Or(hn::Xor(aInside, hn::Gt(b, zero)),
          hn::Ge(hn::Add(bow, margin), hn::Min(hn::Abs(a), hn::Abs(b))));
        if (HWY_LIKELY(hn::AllFalse(tag, crosses)))
        {
          thickness = hn::Add(thickness, hn::IfThenElseZero(aInside, length));
        }
        else
        {
          if (Floored)
          {
            ComeOut(tag, under, cell.length, b, margin, a, c, marginIn);
          }
          const Vector share = InsideShare(tag, a, b, c, marginIn, margin);
          thickness = hn::MulAdd(length, share, thickness);
        }
      }
      hn::Store(surface, tag, tile.surface + at);
      hn::Store(ground, tag, tile.ground + at);
      hn::Store(left, tag, tile.left + at);
      hn::Store(kept, tag, tile.kept + at);
      hn::Store(thickness, tag, tile.thickness + at);
    }
  }
}

// How far below zero, and above it, both ends of a step have to be for rays to be all out or all
// in, for patches with twists of at most `twist`.
HWY_INLINE float BowOf(
  const SweepThickness::Plan& plan, const SweepThickness::Step& step, float twist)
{
  return 0.25f * twist * std::abs(step.bend) + WidestMargin(plan, step.margin);
}

// The lanes in which a vector of windows, each HeightWindows::Step samples from the next, has those
// of a vector of cells.
HWY_INLINE hn::Vec<IntTag> WindowLanes(IntTag tag, int firstCell)
{
  static_assert(HeightWindows::Step == 2);
  return hn::ShiftRight<1>(hn::Iota(tag, firstCell % HeightWindows::Step));
}

// The rays of a vector of samples. Deeper, they are sunk by more than t; Floored, some have not
// come out of the floor yet.
template <bool Deeper, bool Floored>
struct RaysOf
{
  Vector base;
  Vector more;
  const float* from; // as in the tile

  RaysOf(const Tile& tile, int at)
    : base(hn::Load(Tag(), tile.base + at))
    , more(Deeper ? hn::Load(Tag(), tile.more + at) : hn::Zero(Tag()))
    , from(tile.from + at)
  {
  }

  HWY_INLINE Vector Above(Tag tag, Vector ground, float rise) const
  {
    const Vector over = hn::Sub(hn::Sub(ground, this->base), hn::Set(tag, rise));
    return Deeper ? hn::Add(over, this->more) : over;
  }

  HWY_INLINE Vector Margin(Tag tag, float margin) const
  {
    return Deeper ? MarginOf(tag, margin, this->more) : hn::Set(tag, margin);
  }

  HWY_INLINE Vector Under(Tag tag, float distance, float length) const
  {
    return Floored ? UnderFloor(tag, hn::Load(tag, this->from), distance, length) : hn::Zero(tag);
  }
};

// Takes vectors of rays past a group of cells without a walk.
template <bool Deeper, bool Floored, bool Tolerant>
class GroupLook
{
public:
  GroupLook(const SweepThickness::Plan& plan, const Crossings::Group& group, int firstCell)
    : RiseIn(group.riseIn)
    , RiseOut(group.riseOut)
    , Margin(WidestMargin(plan, MarginAt(plan, group.riseOut)))
    , Distance(group.distance)
    , Length(group.length)
    , Tolerance(plan.medium)
    , Lanes(hn::IndicesFromVec(Tag(), WindowLanes(IntTag(), firstCell)))
  {
  }

  // Finds what rays have of the group, if the windows show each of them to be below the ground or
  // above it, or if d is known well enough without. Returns whether that is so.
  HWY_INLINE bool Skip(const float* lowest, const float* highest,
    const RaysOf<Deeper, Floored>& rays, Tile& tile, int at) const
  {
    const Tag tag;
    const Vector low = hn::TableLookupLanes(hn::LoadU(tag, lowest), this->Lanes);
    const Vector high = hn::TableLookupLanes(hn::LoadU(tag, highest), this->Lanes);
    // Rays without data compare false, and so need no walk.
    const Mask all = hn::Gt(rays.Above(tag, low, this->RiseOut), hn::Set(tag, this->Margin));
    const Mask any = hn::Ge(rays.Above(tag, high, this->RiseIn), hn::Zero(tag));
    const Mask open = hn::AndNot(all, any);
    const Vector thickness = hn::Load(tag, tile.thickness + at);
    const Vector length = hn::Set(tag, this->Length);
    if (!hn::AllFalse(tag, open))
    {
      if (!Tolerant)
      {
        return false;
      }
      // What waits to be measured makes rays thicker, and so d less doubtful.
      const Vector before = hn::Load(tag, tile.unknown + at);
      const Vector unknown = hn::Add(before, length);
      if (!hn::AllFalse(tag, hn::And(open, this->Tolerance.OpenFor(tag, thickness, unknown))))
      {
        return false;
      }
      hn::Store(hn::IfThenElse(open, unknown, before), tag, tile.unknown + at);
    }
    const Vector inside = hn::Sub(length, rays.Under(tag, this->Distance, this->Length));
    hn::Store(hn::Add(thickness, hn::IfThenElseZero(all, inside)), tag, tile.thickness + at);
    return true;
  }

private:
  float RiseIn;
  float RiseOut;
  float Margin; // of the ray that is sunk deepest
  float Distance;
  float Length;
  Settler Tolerance;
  decltype(hn::IndicesFromVec(Tag(), hn::Zero(IntTag()))) Lanes;
};

// Walks a vector of rays, from where they have left the cell before `steps` through `count` cells.
// Where both ends are further from zero than the `bows`, a ray is all in or all out. `own` are the
// rays' samples in the heights.
template <bool Deeper, bool Floored>
HWY_INLINE void WalkVector(const SweepThickness::Step* steps, int count, const float* bows,
  const float* own, std::ptrdiff_t pitch, const RaysOf<Deeper, Floored>& rays, Tile& tile, int at,
  Waiting& waiting)
{
  const Tag tag;
  auto exitOf = [&](const SweepThickness::Step& step)
  {
    const Vector ground = Interpolate(
      tag, hn::LoadU(tag, own + step.first), hn::LoadU(tag, own + step.second), step.weight);
    return rays.Above(tag, ground, step.rise);
  };
  Vector thickness = hn::Load(tag, tile.thickness + at);
  Vector a = exitOf(steps[0]);
  for (int k = 0; k < count; ++k)
  {
    const SweepThickness::Step& step = steps[k + 1];
    const Vector b = exitOf(step);
    const Vector under = rays.Under(tag, step.distance, step.length);
    const Vector length = hn::Sub(hn::Set(tag, step.length), under);
    const Vector bow = hn::Set(tag, bows[k]);
    const Mask inside = hn::Gt(hn::Min(a, b), bow);
    const Mask crosses = hn::AndNot(inside, hn::Ge(hn::Max(a, b), hn::Neg(bow)));
    thickness = hn::Add(thickness, hn::IfThenElseZero(inside, length));
    if (!hn::AllFalse(tag, crosses))
    {
      const float* lower = own + step.cell;
      Vector c = hn::Mul(Twist(tag, lower, lower + pitch), hn::Set(tag, step.bend));
      Vector marginIn = rays.Margin(tag, steps[k].margin);
      const Vector margin = rays.Margin(tag, step.margin);
      if (Floored)
      {
        ComeOut(tag, under, step.length, b, margin, a, c, marginIn);
      }
      const std::size_t found = hn::CountTrue(tag, crosses);
      if (Floored || 2 * found > hn::Lanes(tag))
      {
        const Vector share = InsideShare(tag, a, b, c, marginIn, margin);
        thickness = hn::MulAdd(length, hn::IfThenElseZero(crosses, share), thickness);
      }
      else
      {
        waiting.Add<Deeper>(tag, crosses, at, a, b, c, marginIn, margin, length);
      }
    }
    a = b;
  }
  hn::Store(thickness, tag, tile.thickness + at);
}

// Takes a tile's rays through a group's cells where all of these are in the image and none is a
// hole. What a hole before them held ends here, so rays start at the surface; the first cell is not
// one that is only touched, if anything is held. Surface and ground are left as they are. Returns
// how many vectors are walked.
template <bool Deeper, bool Floored, bool Tolerant>
int WalkVectors(const SweepThickness::Plan& plan, const Crossings::Group& group, const float* bows,
  Tile& tile, Waiting& waiting)
{
  const Tag tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const HeightView<float>& heights = plan.field->GetField().heights;
  const HeightWindows& windows = plan.field->GetWindows();
  const std::ptrdiff_t pitch = heights.stepY;
  const float* const first = heights.data + tile.y0 * pitch + tile.x0;
  const SweepThickness::Step* const steps = plan.steps.data() + group.begin;
  const int count = group.end - group.begin;
  const int x = tile.x0 + group.x0;
  const int y = tile.y0 + group.y0;
  const GroupLook<Deeper, Floored, Tolerant> look(plan, group, x);
  const int rows = tile.rows;
  int walked = 0;
  for (int row = 0; row < rows; ++row)
  {
    const float* const lowest = windows.Lowest(x, y + row);
    const float* const highest = windows.Highest(x, y + row);
    for (int column = 0; column < SweepThickness::TileWidth; column += lanes)
    {
      // Windows are as regular as vectors, but for those of a single sample.
      const int at = row * SweepThickness::TileWidth + column;
      const int window = (x % HeightWindows::Step + column) / HeightWindows::Step;
      const RaysOf<Deeper, Floored> rays(tile, at);
      if (!look.Skip(lowest + window, highest + window, rays, tile, at))
      {
        WalkVector(
          steps, count, bows, first + row * pitch + column, pitch, rays, tile, at, waiting);
        ++walked;
      }
    }
  }
  return walked;
}

template <bool Deeper>
auto* ChooseWalk(bool floored, bool tolerant)
{
  return floored ? WalkVectors<Deeper, true, false>
    : tolerant   ? WalkVectors<Deeper, false, true>
                 : WalkVectors<Deeper, false, false>;
}

// The same for a group whose patches have twists of at most `twist`. While `floored`, some of the
// rays have not come out of the floor where it begins. Returns how many cells are visited.
std::size_t WalkWholeCells(const SweepThickness::Plan& plan, const Crossings::Group& group,
  float twist, bool floored, Tile& tile, Waiting& waiting)
{
  const int count = group.end - group.begin;
  float bows[Crossings::GroupSize];
  for (int k = 0; k < count; ++k)
  {
    bows[k] = BowOf(plan, plan.steps[group.begin + k + 1], twist);
  }
  const bool deeper = plan.medium.offset == f32::RELIEF_TANGENT_PLANE;
  const bool tolerant = plan.medium.tolerance > 0.0f;
  auto* const walk = (deeper ? ChooseWalk<true> : ChooseWalk<false>)(floored, tolerant);
  const int walked = walk(plan, group, bows, tile, waiting);
  if (waiting.count >= Waiting::Enough)
  {
    waiting.AddTo(tile.thickness);
  }
  const int lanes = static_cast<int>(hn::Lanes(Tag()));
  const int looks = tile.rows * SweepThickness::TileWidth / lanes;
  return static_cast<std::size_t>(looks) + static_cast<std::size_t>(walked * lanes * count);
}

// Sets surface and ground to the surface's height at the exit of a cell, after cells without holes.
void Resume(const SweepThickness::Plan& plan, const Rows& rows, int index, Tile& tile)
{
  const Tag tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const Crossings::Cell& cell = plan.crossings.GetCells()[index];
  for (int row = 0; row < tile.rows; ++row)
  {
    const float* first = rows(tile.y0 + row + cell.firstY) + tile.x0 + cell.firstX;
    const float* second = rows(tile.y0 + row + cell.secondY) + tile.x0 + cell.secondX;
    for (int column = 0; column < SweepThickness::TileWidth; column += lanes)
    {
      const int at = row * SweepThickness::TileWidth + column;
      const Vector height = Interpolate(
        tag, hn::LoadU(tag, first + column), hn::LoadU(tag, second + column), cell.weight);
      hn::Store(height, tag, tile.surface + at);
      // Rays that have left the image keep what they held.
      const Vector ground = hn::Load(tag, tile.ground + at);
      hn::Store(hn::IfThenElse(hn::IsNaN(height), ground, height), tag, tile.ground + at);
    }
  }
}

}
}
HWY_AFTER_NAMESPACE();

#endif
