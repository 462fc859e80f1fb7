// SPDX-License-Identifier: BSD-3-Clause
// Included once for each instruction set, hence the guard that toggles.
#if defined(SweepTile_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef SweepTile_inl_h
#undef SweepTile_inl_h
#else
#define SweepTile_inl_h
#endif

#include "SweepThickness.h"
#include "ThicknessLanes-inl.h"

#include <cstddef>
#include <cstdint>
#include <limits>

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

HWY_INLINE Rows RowsOf(const SweepThickness::Plan& plan)
{
  const HeightView<float>& heights = plan.field->GetField().heights;
  return { heights.data, heights.stepY, plan.field->GetMissingRow(), heights.rows };
}

// A tile of samples, and its state at the grid line that its rays crossed last.
struct Tile
{
  int x0; // the first sample
  int y0;
  int rows;                                          // of samples in the image
  HWY_ALIGN float base[SweepThickness::TileSize];    // the samples' own heights
  HWY_ALIGN float more[SweepThickness::TileSize];    // how much deeper than t the points are sunk
  HWY_ALIGN float surface[SweepThickness::TileSize]; // the surface's height at the crossing
  HWY_ALIGN float ground[SweepThickness::TileSize];  // that, or the height held across a hole
  // The cell in which a ray's data ended, counted from 0, and its thickness there; -1 while it is
  // over data. A number of cells is less than 2^24.
  HWY_ALIGN float left[SweepThickness::TileSize];
  HWY_ALIGN float kept[SweepThickness::TileSize];
  HWY_ALIGN float unknown[SweepThickness::TileSize]; // how much more may be inside
  HWY_ALIGN float from[SweepThickness::TileSize];    // where the rays come out of the floor, if any
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
// has climbed above the sample if it was sunk by t. If it was sunk by more, that counts as well.
HWY_INLINE float MarginAt(const SweepThickness::Plan& plan, float rise)
{
  return f32::RELIEF_ROUNDING * (rise + 2.0f * plan.medium.depth);
}

HWY_INLINE Vector MarginOf(Tag tag, float margin, Vector more)
{
  return hn::MulAdd(hn::Set(tag, f32::RELIEF_ROUNDING), more, hn::Set(tag, margin));
}

// That of the ray that is sunk deepest.
HWY_INLINE float WidestMargin(const SweepThickness::Plan& plan, float margin)
{
  const bool deeper = plan.medium.offset == f32::RELIEF_TANGENT_PLANE;
  return margin + (deeper ? f32::RELIEF_ROUNDING * plan.medium.depth : 0.0f);
}

// How far ground lies above rays that have risen by `rise`.
HWY_INLINE Vector Above(Vector ground, Vector base, Vector rise, Vector more)
{
  return hn::Add(hn::Sub(hn::Sub(ground, base), rise), more);
}

// How much deeper than t the points below a vector of samples are sunk. A whole depth at most, so
// the difference is exact.
HWY_INLINE Vector SunkMore(Tag tag, const SweepThickness::Plan& plan, const float* south,
  const float* own, const float* north)
{
  const HeightView<float>& heights = plan.field->GetField().heights;
  if (plan.medium.offset != f32::RELIEF_TANGENT_PLANE || plan.medium.depth == 0.0f ||
    heights.columns < 2 || heights.rows < 2)
  {
    return hn::Zero(tag);
  }
  const Vector here = hn::LoadU(tag, own);
  const Vector gx = lanes::reliefSlope(hn::LoadU(tag, own - 1), here, hn::LoadU(tag, own + 1),
    hn::Set(tag, static_cast<float>(heights.spacingX)));
  const Vector gy = lanes::reliefSlope(hn::LoadU(tag, south), here, hn::LoadU(tag, north),
    hn::Set(tag, static_cast<float>(heights.spacingY)));
  const Vector depth = hn::Set(tag, plan.medium.depth);
  return hn::Sub(lanes::reliefTangentSink(depth, gx, gy), depth);
}

// What the samples of a tile have in common.
struct TileHeights
{
  float lowest;        // by as much lower as a point is sunk by more than t
  float highest;       // of the samples themselves
  std::size_t samples; // with data
};

// Puts the rays of a tile at their samples.
HWY_INLINE TileHeights LoadTile(const SweepThickness::Plan& plan, const Rows& rows, Tile& tile)
{
  const Tag tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const float infinity = std::numeric_limits<float>::infinity();
  Vector low = hn::Set(tag, infinity);
  Vector high = hn::Set(tag, -infinity);
  std::size_t samples = 0;
  for (int row = 0; row < SweepThickness::TileHeight; ++row)
  {
    const float* south = rows(tile.y0 + row - 1) + tile.x0;
    const float* own = rows(tile.y0 + row) + tile.x0;
    const float* north = rows(tile.y0 + row + 1) + tile.x0;
    for (int column = 0; column < SweepThickness::TileWidth; column += lanes)
    {
      const int at = row * SweepThickness::TileWidth + column;
      const Vector base = hn::LoadU(tag, own + column);
      const Vector more = SunkMore(tag, plan, south + column, own + column, north + column);
      hn::Store(base, tag, tile.base + at);
      hn::Store(more, tag, tile.more + at);
      hn::Store(hn::Zero(tag), tag, tile.thickness + at);
      hn::Store(hn::Zero(tag), tag, tile.unknown + at);
      const Mask missing = hn::IsNaN(base);
      low = hn::IfThenElse(missing, low, hn::Min(low, hn::Sub(base, more)));
      high = hn::IfThenElse(missing, high, hn::Max(high, base));
      samples += static_cast<std::size_t>(lanes) - hn::CountTrue(tag, missing);
    }
  }
  return { hn::GetLane(hn::MinOfLanes(tag, low)), hn::GetLane(hn::MaxOfLanes(tag, high)), samples };
}

}
}
HWY_AFTER_NAMESPACE();

#endif
