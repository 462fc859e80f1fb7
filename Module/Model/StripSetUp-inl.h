// SPDX-License-Identifier: BSD-3-Clause
// Included once for each instruction set, hence the guard that toggles.
#if defined(StripSetUp_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef StripSetUp_inl_h
#undef StripSetUp_inl_h
#else
#define StripSetUp_inl_h
#endif

#include "PacketLanes-inl.h"
#include "StripTrace-inl.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace relief
{
namespace HWY_NAMESPACE
{

// Least and greatest of what active rays have.
class LaneRange
{
public:
  explicit LaneRange(Tag tag)
  {
    hn::Store(hn::Set(tag, std::numeric_limits<float>::infinity()), tag, this->Low);
    hn::Store(hn::Set(tag, -std::numeric_limits<float>::infinity()), tag, this->High);
  }

  HWY_INLINE void Add(Tag tag, Mask active, Vector v)
  {
    const Vector low = hn::Load(tag, this->Low);
    const Vector high = hn::Load(tag, this->High);
    hn::Store(hn::IfThenElse(active, hn::Min(low, v), low), tag, this->Low);
    hn::Store(hn::IfThenElse(active, hn::Max(high, v), high), tag, this->High);
  }

  double Least(Tag tag) const { return hn::GetLane(hn::MinOfLanes(tag, hn::Load(tag, this->Low))); }
  double Greatest(Tag tag) const
  {
    return hn::GetLane(hn::MaxOfLanes(tag, hn::Load(tag, this->High)));
  }

private:
  HWY_ALIGN float Low[MaxLanes];
  HWY_ALIGN float High[MaxLanes];
};

// Copies the samples of a tile, and which of them are traced. Returns how many are.
int LoadSamples(
  const Field<float>& field, const RowRequest<float>* requests, int rows, StripTile& tile)
{
  const Tag tag;
  const IntTag intTag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const HeightView<float>& heights = field.heights;
  tile.x0 = requests[0].begin;
  tile.y0 = requests[0].j;
  int samples = 0;
  const int size = requests[0].end - tile.x0;
  tile.column0 = 0;
  tile.column1 = size - 1;
  tile.row0 = 0;
  tile.row1 = rows - 1;
  std::fill_n(tile.left, StripTile::Size, StripTile::NotLeft);
  std::fill_n(tile.anyLeft, StripTile::Height, false);
  for (int at = 0; at < StripTile::Size; at += lanes)
  {
    const int row = at / StripTile::Width;
    const int column = at % StripTile::Width;
    tile.rays[at] = 0;
    const int within = row < rows ? std::min(size - column, lanes) : 0;
    if (within <= 0)
    {
      continue;
    }
    const float* own = heights.data + (tile.y0 + row) * heights.stepY + tile.x0 + column;
    const unsigned char* wanted = requests[row].wanted;
    for (int k = 0; k < within; ++k)
    {
      tile.base[at + k] = own[k];
      tile.active[at + k] = !wanted || wanted[column + k] ? -1 : 0;
    }
    for (int k = within; k < lanes; ++k)
    {
      tile.base[at + k] = 0.0f;
      tile.active[at + k] = 0;
    }
    const Vector base = hn::Load(tag, tile.base + at);
    const Mask active = hn::AndNot(
      hn::IsNaN(base), hn::MaskFromVec(hn::BitCast(tag, hn::Load(intTag, tile.active + at))));
    // Above everything there is nothing to do.
    hn::Store(hn::IfThenElse(active, base, hn::Set(tag, StripTile::Idle)), tag, tile.base + at);
    hn::Store(hn::VecFromMask(intTag, hn::RebindMask(intTag, active)), intTag, tile.active + at);
    tile.rays[at] = static_cast<int>(hn::CountTrue(tag, active));
    samples += tile.rays[at];
  }
  return samples;
}

// Chooses the axis along which the rays of a tile run most. Returns whether there is one.
bool ChooseAxis(
  const Field<float>& field, const Light& light, int columns, int rows, StripTile& tile)
{
  const HeightView<float>& heights = field.heights;
  glm::dvec3 toward = light.vector;
  if (light.positional)
  {
    toward.x -= (tile.x0 + 0.5 * columns) * heights.spacingX;
    toward.y -= (tile.y0 + 0.5 * rows) * heights.spacingY;
  }
  const double x = toward.x / heights.spacingX;
  const double y = toward.y / heights.spacingY;
  tile.alongX = std::abs(x) >= std::abs(y);
  tile.side = (tile.alongX ? x : y) < 0.0 ? -1 : 1;
  tile.ahead = tile.side * (tile.alongX ? heights.stepX : heights.stepY);
  tile.lateral = tile.alongX ? heights.stepY : heights.stepX;
  return x != 0.0 || y != 0.0;
}

// Sets up the rays of a tile, as reliefRay() does. Returns whether all of them run to the side that
// has been chosen.
bool SetUpStrips(const Field<float>& field, const f32::ReliefMedium& medium, const Light& light,
  const RowRequest<float>* requests, int rows, StripTile& tile)
{
  const Tag tag;
  const IntTag intTag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const HeightView<float>& heights = field.heights;
  const Vector zero = hn::Zero(tag);
  const Vector one = hn::Set(tag, 1.0f);
  const Vector depth = hn::Set(tag, medium.depth);
  const bool alongNormal = medium.offset == f32::RELIEF_SURFACE_NORMAL;
  const float spacingX = reliefSpacingX(field);
  const float spacingY = reliefSpacingY(field);
  const Vector perX = hn::Set(tag, 1.0f / spacingX);
  const Vector perY = hn::Set(tag, 1.0f / spacingY);
  const Vector side = hn::Set(tag, static_cast<float>(tile.side));
  // Distances to a lamp are found in double, as LightFrom() does.
  HWY_ALIGN float lightX[StripTile::Width];
  const float lightZ = static_cast<float>(light.vector.z);
  const float lightZLow = static_cast<float>(light.vector.z - static_cast<double>(lightZ));
  for (int k = 0; k < StripTile::Width; ++k)
  {
    const double shift = light.positional ? (tile.x0 + k) * heights.spacingX : 0.0;
    lightX[k] = static_cast<float>(light.vector.x - shift);
  }
  HWY_ALIGN float normals[3 * MaxLanes];
  LaneRange mains(tag);
  LaneRange slopes(tag);
  LaneRange shifts(tag);
  LaneRange climbs(tag);
  LaneRange starts(tag);
  LaneRange sinks(tag);
  LaneRange ends(tag);
  tile.footLo = std::numeric_limits<double>::infinity();
  tile.footHi = -tile.footLo;
  for (int at = 0; at < StripTile::Size; at += lanes)
  {
    const int row = at / StripTile::Width;
    const int column = at % StripTile::Width;
    if (tile.rays[at] == 0)
    {
      continue;
    }
    const Mask active = hn::MaskFromVec(hn::BitCast(tag, hn::Load(intTag, tile.active + at)));
    const Vector base = hn::Load(tag, tile.base + at);
    Vector offsetX = zero;
    Vector offsetY = zero;
    Vector sink = depth;
    if (alongNormal)
    {
      const int size = requests[row].end - requests[row].begin - column;
      const float* own = &requests[row].normals[column].x;
      if (size < lanes)
      {
        std::copy_n(own, 3 * size, normals);
        std::fill(normals + 3 * size, normals + 3 * lanes, 0.0f);
        own = normals;
      }
      Vector nx;
      Vector ny;
      Vector nz;
      hn::LoadInterleaved3(tag, own, nx, ny, nz);
      offsetX = hn::Mul(depth, nx);
      offsetY = hn::Mul(depth, ny);
      sink = hn::Mul(depth, nz);
    }
    else if (medium.offset == f32::RELIEF_TANGENT_PLANE)
    {
      HWY_ALIGN float deeper[MaxLanes];
      for (int k = 0; k < lanes; ++k)
      {
        deeper[k] = tile.active[at + k]
          ? f32::reliefSink(field, medium, tile.x0 + column + k, tile.y0 + row)
          : medium.depth;
      }
      sink = hn::Load(tag, deeper);
    }
    Vector lx = hn::Load(tag, lightX + column);
    const double shiftY = light.positional ? (tile.y0 + row) * heights.spacingY : 0.0;
    Vector ly = hn::Set(tag, static_cast<float>(light.vector.y - shiftY));
    Vector lz = hn::Set(tag, lightZ);
    Vector size = one;
    if (light.positional)
    {
      lx = hn::Add(lx, offsetX);
      ly = hn::Add(ly, offsetY);
      lz = hn::Add(hn::Add(hn::Sub(lz, base), hn::Set(tag, lightZLow)), sink);
      size = hn::Sqrt(hn::MulAdd(lx, lx, hn::MulAdd(ly, ly, hn::Mul(lz, lz))));
    }
    // As reliefAlong(): what is rounding in a direction does not count.
    const Vector least = hn::Mul(size, hn::Set(tag, f32::RELIEF_ALONG_AXIS));
    const Vector alongX = hn::IfThenZeroElse(hn::Lt(hn::Abs(lx), least), hn::Mul(lx, perX));
    const Vector alongY = hn::IfThenZeroElse(hn::Lt(hn::Abs(ly), least), hn::Mul(ly, perY));
    const Vector x = hn::Neg(hn::Mul(offsetX, perX));
    const Vector y = hn::Neg(hn::Mul(offsetY, perY));
    const Vector main = hn::Mul(side, tile.alongX ? alongX : alongY);
    const Vector other = tile.alongX ? alongY : alongX;
    const Vector start = hn::Mul(side, tile.alongX ? x : y);
    const Vector startRow = tile.alongX ? y : x;
    const Vector inverse = hn::Div(one, main);
    const Vector slope = hn::Mul(other, inverse);
    const Vector climb = hn::Mul(lz, inverse);
    const Vector across = hn::Div(main, other);
    const Vector shift = hn::NegMulAdd(start, slope, startRow);
    const Vector drop = hn::NegMulAdd(start, climb, hn::Neg(sink));
    hn::Store(sink, tag, tile.sink + at);
    hn::Store(slope, tag, tile.slope + at);
    hn::Store(shift, tag, tile.shift + at);
    hn::Store(climb, tag, tile.climb + at);
    hn::Store(drop, tag, tile.drop + at);
    hn::Store(hn::Mul(size, inverse), tag, tile.span + at);
    hn::Store(across, tag, tile.across + at);
    hn::Store(hn::NegMulAdd(startRow, across, start), tag, tile.back + at);
    hn::Store(start, tag, tile.start + at);
    hn::Store(startRow, tag, tile.startRow + at);
    hn::Store(zero, tag, tile.inside + at);
    mains.Add(tag, active, main);
    slopes.Add(tag, active, slope);
    climbs.Add(tag, active, climb);
    const Vector foot = hn::Add(base, drop);
    tile.lowest[at] = Least(tag, active, foot);
    tile.highest[at] = Greatest(tag, active, foot);
    tile.footLo = std::min<double>(tile.footLo, tile.lowest[at]);
    tile.footHi = std::max<double>(tile.footHi, tile.highest[at]);
    sinks.Add(tag, active, sink);
    ends.Add(tag, active, hn::Add(start, main));
    if (alongNormal)
    {
      shifts.Add(tag, active, shift);
      starts.Add(tag, active, start);
    }
  }
  tile.slopeLo = slopes.Least(tag);
  tile.slopeHi = slopes.Greatest(tag);
  tile.climbLo = climbs.Least(tag);
  tile.climbHi = climbs.Greatest(tag);
  tile.sinkHi = sinks.Greatest(tag);
  tile.shiftLo = alongNormal ? shifts.Least(tag) : 0.0;
  tile.shiftHi = alongNormal ? shifts.Greatest(tag) : 0.0;
  tile.startLo = alongNormal ? starts.Least(tag) : 0.0;
  tile.startHi = alongNormal ? starts.Greatest(tag) : 0.0;
  // As reliefTrace() ends a ray before its light. Greater whole numbers are no floats.
  tile.end = 1.6e7;
  if (light.positional)
  {
    const double nearest = ends.Least(tag) - 2.0 * f32::RELIEF_ROUNDING * mains.Greatest(tag);
    tile.end = std::max(std::min(nearest, tile.end), -tile.end);
  }
  const double most = 1.0 + 4.0 * std::numeric_limits<float>::epsilon();
  return mains.Least(tag) > 0.0 && tile.slopeLo >= -most && tile.slopeHi <= most;
}

// The heights of the ground above the points where rays start, each in a cell of its own.
void FindStartHeights(const Field<float>& field, const Strip* strips, int count, StripTile& tile)
{
  const Tag tag;
  const IntTag intTag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const HeightView<float>& heights = field.heights;
  const Vector one = hn::Set(tag, 1.0f);
  int lowest = strips[0].row;
  int highest = lowest;
  for (int k = 0; k < count; ++k)
  {
    lowest = std::min(lowest, strips[k].row);
    highest = std::max(highest, strips[k].row + strips[k].rows - 1);
  }
  const Vector firstLine = hn::Set(tag, static_cast<float>(strips[0].line));
  const Vector lastLine = hn::Set(tag, static_cast<float>(strips[count - 1].line));
  const Vector firstRow = hn::Set(tag, static_cast<float>(lowest));
  const Vector lastRow = hn::Set(tag, static_cast<float>(highest));
  const auto ahead = hn::Set(intTag, static_cast<std::int32_t>(tile.ahead));
  const auto lateral = hn::Set(intTag, static_cast<std::int32_t>(tile.lateral));
  for (int at = 0; at < StripTile::Size; at += lanes)
  {
    if (tile.rays[at] == 0)
    {
      continue;
    }
    const float* sample = heights.data + (tile.y0 + at / StripTile::Width) * heights.stepY +
      tile.x0 + at % StripTile::Width;
    const Mask active = hn::MaskFromVec(hn::BitCast(tag, hn::Load(intTag, tile.active + at)));
    const Vector base = hn::Load(tag, tile.base + at);
    const Vector start = hn::IfThenElse(active, hn::Load(tag, tile.start + at), firstLine);
    const Vector startRow = hn::IfThenElse(active, hn::Load(tag, tile.startRow + at), firstRow);
    const Vector line = hn::Min(hn::Max(hn::Floor(start), firstLine), lastLine);
    const Vector row = hn::Min(hn::Max(hn::Floor(startRow), firstRow), lastRow);
    const auto index = hn::Add(hn::Iota(intTag, 0),
      hn::Add(
        hn::Mul(hn::ConvertTo(intTag, line), ahead), hn::Mul(hn::ConvertTo(intTag, row), lateral)));
    const Vector h00 = hn::Sub(hn::GatherIndex(tag, sample, index), base);
    const Vector h10 = hn::Sub(hn::GatherIndex(tag, sample + tile.ahead, index), base);
    const Vector h01 = hn::Sub(hn::GatherIndex(tag, sample + tile.lateral, index), base);
    const Vector h11 =
      hn::Sub(hn::GatherIndex(tag, sample + tile.ahead + tile.lateral, index), base);
    const Vector far = hn::Sub(start, line);
    const Vector near = hn::Sub(hn::Add(line, one), start);
    const Vector upper = hn::Sub(startRow, row);
    const Vector lower = hn::Sub(hn::Add(row, one), startRow);
    const Vector ground = hn::MulAdd(lower, hn::MulAdd(near, h00, hn::Mul(far, h10)),
      hn::Mul(upper, hn::MulAdd(near, h01, hn::Mul(far, h11))));
    hn::Store(hn::Add(ground, hn::Load(tag, tile.sink + at)), tag, tile.startAbove + at);
  }
}

}
}
HWY_AFTER_NAMESPACE();

#endif
