// SPDX-License-Identifier: BSD-3-Clause
// Included once for each instruction set, hence the guard that toggles.
#if defined(SweepTrace_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef SweepTrace_inl_h
#undef SweepTrace_inl_h
#else
#define SweepTrace_inl_h
#endif

#include "SweepThickness.h"
#include "ThicknessLanes-inl.h"

#include <cmath>
#include <cstddef>

HWY_BEFORE_NAMESPACE();
namespace relief
{
namespace HWY_NAMESPACE
{

// The rows of the padded heights; rows outside the image have no data.
struct Rows
{
  const float* first;
  std::ptrdiff_t pitch;
  const float* missing;
  int count;

  HWY_INLINE const float* operator()(int j) const
  {
    return static_cast<unsigned int>(j) < static_cast<unsigned int>(this->count)
      ? this->first + j * this->pitch
      : this->missing;
  }
};

// A tile of samples, and its state at the grid line that its rays crossed last.
struct Tile
{
  int x0; // the first sample
  int y0;
  int rows;                                          // of samples in the image
  HWY_ALIGN float base[SweepThickness::TileSize];    // the samples' own heights
  HWY_ALIGN float surface[SweepThickness::TileSize]; // the surface's height at the crossing
  HWY_ALIGN float ground[SweepThickness::TileSize];  // that, or the height held across a hole
  float* thickness;                                  // so far
};

HWY_INLINE Vector Interpolate(Tag tag, Vector first, Vector second, float weight)
{
  return hn::MulAdd(hn::Sub(second, first), hn::Set(tag, weight), first);
}

HWY_INLINE Vector Twist(Tag tag, const float* lower, const float* upper)
{
  return hn::Sub(hn::Sub(hn::LoadU(tag, upper + 1), hn::LoadU(tag, lower + 1)),
    hn::Sub(hn::LoadU(tag, upper), hn::LoadU(tag, lower)));
}

// Within how much of the surface a ray counts as on it, as reliefAbove() tells; `rise` is what it
// has climbed above the sample.
HWY_INLINE float MarginAt(const SweepThickness::Plan& plan, float rise)
{
  return f32::RELIEF_ROUNDING * (rise + 2.0f * plan.medium.depth);
}

// Walks a group's cells with every ray of a tile.
void WalkCells(const SweepThickness::Plan& plan, const Rows& rows,
  const SweepThickness::Group& group, Tile& tile)
{
  const Tag tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const Vector zero = hn::Zero(tag);
  for (int row = 0; row < tile.rows; ++row)
  {
    for (int column = 0; column < SweepThickness::TileWidth; column += lanes)
    {
      const int at = row * SweepThickness::TileWidth + column;
      const int x = tile.x0 + column;
      const int y = tile.y0 + row;
      const Vector base = hn::Load(tag, tile.base + at);
      Vector surface = hn::Load(tag, tile.surface + at);
      Vector ground = hn::Load(tag, tile.ground + at);
      Vector thickness = hn::Load(tag, tile.thickness + at);
      Vector rise = hn::Set(tag, group.riseIn);
      Vector margin = hn::Set(tag, MarginAt(plan, group.riseIn));
      for (int k = group.begin; k < group.end; ++k)
      {
        const SweepThickness::Cell& cell = plan.cells[k];
        const Vector twist =
          Twist(tag, rows(y + cell.y) + x + cell.x, rows(y + cell.y + 1) + x + cell.x);
        const Vector next =
          Interpolate(tag, hn::LoadU(tag, rows(y + cell.firstY) + x + cell.firstX),
            hn::LoadU(tag, rows(y + cell.secondY) + x + cell.secondX), cell.weight);

        // Across a hole the ground stays where it was, and so it does in a cell that is only
        // touched. Out of a hole it jumps to the surface.
        const Mask missing = hn::IsNaN(twist);
        const Mask hole = cell.touches ? hn::Or(missing, hn::Ne(ground, surface)) : missing;
        const Vector from = hn::IfThenElse(hole, ground, surface);
        ground = hn::IfThenElse(hole, ground, next);
        surface = next;
        const Vector a = hn::Sub(hn::Sub(from, base), rise);
        rise = hn::Set(tag, cell.rise);
        const Vector marginIn = margin;
        margin = hn::Set(tag, MarginAt(plan, cell.rise));
        const Vector b = hn::Sub(hn::Sub(ground, base), rise);
        const Vector c = hn::IfThenZeroElse(hole, hn::Mul(twist, hn::Set(tag, cell.bend)));

        const Vector length = hn::Set(tag, cell.length);
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
          thickness = hn::MulAdd(length, InsideShare(tag, a, b, c, marginIn, margin), thickness);
        }
      }
      hn::Store(surface, tag, tile.surface + at);
      hn::Store(ground, tag, tile.ground + at);
      hn::Store(thickness, tag, tile.thickness + at);
    }
  }
}

// The same where all the cells are in the image and none is a hole, whose patches have twists of at
// most `twist`: where both ends are further from zero than the bow can be deep, the ray is all in
// or all out. What a hole before them held ends here, so they start at the surface; the first is
// not one that is only touched, if anything is held.
void WalkWholeCells(
  const SweepThickness::Plan& plan, const SweepThickness::Group& group, float twist, Tile& tile)
{
  const Tag tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const HeightView<float>& heights = plan.field->GetField().heights;
  const std::ptrdiff_t pitch = heights.stepY;

  // What the cells say, once for all rays.
  struct Step
  {
    const float* first;
    const float* second;
    const float* lower;
    float weight, length, rise, marginIn, margin, bend, bow;
  };
  Step steps[SweepThickness::GroupSize];
  const int count = group.end - group.begin;
  const float* origin = heights.data + tile.y0 * pitch + tile.x0;
  for (int k = 0; k < count; ++k)
  {
    const SweepThickness::Cell& cell = plan.cells[group.begin + k];
    const float marginIn = k == 0 ? MarginAt(plan, group.riseIn) : steps[k - 1].margin;
    const float margin = MarginAt(plan, cell.rise);
    steps[k] = { origin + cell.firstY * pitch + cell.firstX,
      origin + cell.secondY * pitch + cell.secondX, origin + cell.y * pitch + cell.x, cell.weight,
      cell.length, cell.rise, marginIn, margin, cell.bend,
      0.25f * twist * std::abs(cell.bend) + margin };
  }

  for (int row = 0; row < tile.rows; ++row)
  {
    for (int column = 0; column < SweepThickness::TileWidth; column += lanes)
    {
      const int at = row * SweepThickness::TileWidth + column;
      const std::ptrdiff_t offset = row * pitch + column;
      const Vector base = hn::Load(tag, tile.base + at);
      Vector thickness = hn::Load(tag, tile.thickness + at);
      Vector a =
        hn::Sub(hn::Sub(hn::Load(tag, tile.surface + at), base), hn::Set(tag, group.riseIn));
      Vector next = base;
      for (int k = 0; k < count; ++k)
      {
        const Step& step = steps[k];
        next = Interpolate(tag, hn::LoadU(tag, step.first + offset),
          hn::LoadU(tag, step.second + offset), step.weight);
        const Vector b = hn::Sub(hn::Sub(next, base), hn::Set(tag, step.rise));
        const Vector bow = hn::Set(tag, step.bow);
        const Mask inside = hn::Gt(hn::Min(a, b), bow);
        const Mask outside = hn::Lt(hn::Add(hn::Max(a, b), bow), hn::Zero(tag));
        const Vector length = hn::Set(tag, step.length);
        if (HWY_LIKELY(hn::AllTrue(tag, hn::Or(inside, outside))))
        {
          thickness = hn::Add(thickness, hn::IfThenElseZero(inside, length));
        }
        else
        {
          const float* lower = step.lower + offset;
          const Vector c = hn::Mul(Twist(tag, lower, lower + pitch), hn::Set(tag, step.bend));
          const Vector share =
            InsideShare(tag, a, b, c, hn::Set(tag, step.marginIn), hn::Set(tag, step.margin));
          thickness = hn::MulAdd(length, share, thickness);
        }
        a = b;
      }
      hn::Store(next, tag, tile.surface + at);
      hn::Store(next, tag, tile.ground + at);
      hn::Store(thickness, tag, tile.thickness + at);
    }
  }
}

// Sets surface and ground to the surface's height at the exit of a cell, after cells without holes.
void Resume(const SweepThickness::Plan& plan, const Rows& rows, int index, Tile& tile)
{
  const Tag tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const SweepThickness::Cell& cell = plan.cells[index];
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
