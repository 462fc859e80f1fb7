// SPDX-License-Identifier: BSD-3-Clause
#include "PacketThickness.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "PacketThickness.cxx"
#include <hwy/foreach_target.h>

// After the loop over the targets, which defines for which one this is.
#include "PacketTrace-inl.h"
#include "StripTile-inl.h"

HWY_BEFORE_NAMESPACE();
namespace relief
{
namespace HWY_NAMESPACE
{

// Copies what differs from sample to sample: own heights, the light as seen from them, normals.
struct Samples
{
  HWY_ALIGN float lightX[MaxLanes];
  HWY_ALIGN float lightY[MaxLanes];
  HWY_ALIGN float lightZ[MaxLanes];
  HWY_ALIGN float normalX[MaxLanes];
  HWY_ALIGN float normalY[MaxLanes];
  HWY_ALIGN float normalZ[MaxLanes];
};

// Sets up the rays of a packet as reliefRay() does. Rays that start outside the image or never end
// are rare: they are marked to be traced alone.
void SetUpRays(const Field<float>& field, const f32::ReliefMedium& medium, const Light& light,
  int i, int j, const Samples& samples, Packet& packet)
{
  const Tag tag;
  const IntTag intTag;
  const Vector zero = hn::Zero(tag);
  const Vector one = hn::Set(tag, 1.0f);
  const Vector base = hn::Load(tag, packet.base);
  const Vector depth = hn::Set(tag, medium.depth);
  const bool alongNormal = medium.offset == f32::RELIEF_SURFACE_NORMAL;
  const Vector offsetX = alongNormal ? hn::Mul(depth, hn::Load(tag, samples.normalX)) : zero;
  const Vector offsetY = alongNormal ? hn::Mul(depth, hn::Load(tag, samples.normalY)) : zero;
  const Vector sink =
    alongNormal ? hn::Mul(depth, hn::Load(tag, samples.normalZ)) : hn::Load(tag, packet.sink);
  const Vector spacingX = hn::Set(tag, reliefSpacingX(field));
  const Vector spacingY = hn::Set(tag, reliefSpacingY(field));
  const Vector x = hn::Neg(hn::Div(offsetX, spacingX));
  const Vector y = hn::Neg(hn::Div(offsetY, spacingY));

  Vector lx = hn::Load(tag, samples.lightX);
  Vector ly = hn::Load(tag, samples.lightY);
  Vector dz = hn::Load(tag, samples.lightZ);
  Vector end = hn::Set(tag, Infinity);
  if (light.positional)
  {
    lanes::reliefToward(
      hn::Add(lx, offsetX), hn::Add(ly, offsetY), hn::Add(dz, sink), lx, ly, dz, end);
    // As reliefTrace() ends a ray before its light.
    end = hn::NegMulAdd(hn::Set(tag, 2.0f * f32::RELIEF_ROUNDING), end, end);
  }
  const Vector dx = lanes::reliefAlong(lx, spacingX);
  const Vector dy = lanes::reliefAlong(ly, spacingY);
  const Mask endless = hn::And(hn::Lt(dz, zero), hn::Eq(end, hn::Set(tag, Infinity)));
  Vector from;
  Vector to;
  lanes::reliefStretch(medium.useFloor, hn::Set(tag, medium.floorHeight), hn::Set(tag, field.top),
    base, sink, dz, end, from, to);

  // The cell ahead, from the sample.
  const Vector lane = hn::ConvertTo(tag, hn::Load(intTag, packet.lane));
  const Vector columns = hn::Set(tag, static_cast<float>(field.heights.columns - 1 - i));
  const Vector rows = hn::Set(tag, static_cast<float>(field.heights.rows - 1 - j));
  const Vector columnsAhead = hn::Sub(columns, lane);
  const Vector cellX = lanes::reliefLineAhead(x, dx, columnsAhead);
  const Vector cellY = lanes::reliefLineAhead(y, dy, rows);
  const Vector firstX = hn::Sub(hn::Set(tag, static_cast<float>(-i)), lane);
  const Mask outside = hn::Or(hn::Or(hn::Lt(cellX, firstX), hn::Ge(cellX, columnsAhead)),
    hn::Or(hn::Lt(cellY, hn::Set(tag, static_cast<float>(-j))), hn::Ge(cellY, rows)));
  const Mask upright = hn::AndNot(outside, hn::And(hn::Eq(dx, zero), hn::Eq(dy, zero)));
  Mask single = outside;
  single = medium.useFloor ? single : hn::Or(single, endless);

  hn::Store(x, tag, packet.x);
  hn::Store(y, tag, packet.y);
  hn::Store(sink, tag, packet.sink);
  hn::Store(dx, tag, packet.dx);
  hn::Store(dy, tag, packet.dy);
  hn::Store(dz, tag, packet.dz);
  hn::Store(from, tag, packet.from);
  hn::Store(to, tag, packet.to);
  hn::Store(cellX, tag, packet.cellX);
  hn::Store(cellY, tag, packet.cellY);
  hn::Store(end, tag, packet.end);
  hn::Store(hn::VecFromMask(intTag, hn::RebindMask(intTag, single)), intTag, packet.alone);
  hn::Store(hn::VecFromMask(intTag, hn::RebindMask(intTag, upright)), intTag, packet.upright);
}

// reliefStartHeight() of a lane, quickly where its cell is whole.
HWY_INLINE float StartHeight(const Field<float>& field, int i, int j, const Packet& packet, int k)
{
  const HeightView<float>& heights = field.heights;
  const int ci = i + static_cast<int>(packet.cellX[k]);
  const int cj = j + static_cast<int>(packet.cellY[k]);
  const float base = packet.base[k];
  const float h00 = heights.At(ci, cj) - base;
  const float h10 = heights.At(ci + 1, cj) - base;
  const float h01 = heights.At(ci, cj + 1) - base;
  const float h11 = heights.At(ci + 1, cj + 1) - base;
  const float west = packet.cellX[k] + 1.0f - packet.x[k];
  const float east = packet.x[k] - packet.cellX[k];
  const float south = packet.cellY[k] + 1.0f - packet.y[k];
  const float north = packet.y[k] - packet.cellY[k];
  const float height = south * (west * h00 + east * h10) + north * (west * h01 + east * h11);
  if (!std::isnan(height))
  {
    return height;
  }
  f32::ReliefRay ray = {};
  ray.i = i;
  ray.j = j;
  ray.x = packet.x[k];
  ray.y = packet.y[k];
  ray.base = base;
  return f32::reliefStartHeight(field, ray);
}

// Takes those of a packet's rays that have left their tile to the line where they did: just before
// it, where the surface is known. The others are done.
void Resume(
  const HeightView<float>& heights, const StripTile& tile, int at, int lanes, Packet& packet)
{
  const int y = tile.y0 + at / StripTile::Width;
  for (int k = 0; k < lanes; ++k)
  {
    const int ray = at + k;
    const float line = tile.left[ray];
    if (line == StripTile::NotLeft)
    {
      packet.active[k] = 0;
    }
    if (line == StripTile::NotLeft || line == StripTile::AtStart)
    {
      continue;
    }
    const float place = tile.slope[ray] * line + tile.shift[ray];
    const float cell = tile.side > 0 ? line - 1.0f : -line;
    // Along the last line the ray is in the row before it.
    const int x = tile.x0 + ray % StripTile::Width;
    const float last =
      static_cast<float>(tile.alongX ? heights.rows - 2 - y : heights.columns - 2 - x);
    const float row =
      std::min(tile.slope[ray] > 0.0f ? std::ceil(place) - 1.0f : std::floor(place), last);
    packet.cellX[k] = tile.alongX ? cell : row;
    packet.cellY[k] = tile.alongX ? row : cell;
    packet.s[k] = (line - tile.start[ray]) * tile.span[ray];
    packet.thickness[k] = tile.kept[ray] * tile.span[ray];
    packet.resumed[k] = -1;
  }
}

// The thickness of a ray that has left the image inside: the ground goes on as it came.
float Beyond(const Field<float>& field, const f32::ReliefMedium& medium, f32::ReliefRay ray,
  const Packet& packet, int k)
{
  // As reliefTrace() ends a ray before its light.
  ray.end -= ray.end < Infinity ? 2.0f * f32::RELIEF_ROUNDING * ray.end : 0.0f;
  const float above = f32::reliefAbove(ray, packet.leftGround[k], packet.left[k]);
  const int axis = packet.leftAlongX[k] ? 0 : 1;
  return above > 0.0f
    ? packet.kept[k] + f32::reliefBeyond(field, medium, ray, packet.left[k], axis, above)
    : packet.thickness[k];
}

// Sets up a packet of a request that begins with its sample `first`. Returns whether any of its
// rays is traced: those are active.
bool SetUpPacket(const Field<float>& field, const f32::ReliefMedium& medium, const Light& light,
  const RowRequest<float>& request, int first, Packet& packet)
{
  const int lanes = static_cast<int>(hn::Lanes(Tag()));
  const HeightView<float>& heights = field.heights;
  const int size = std::min(lanes, request.end - request.begin - first);
  const int begin = request.ColumnOf(first);
  for (int k = 0; k < lanes; ++k)
  {
    packet.lane[k] = k < size ? request.ColumnOf(first + k) - begin : packet.lane[k - 1] + 1;
  }
  float anyBase = std::numeric_limits<float>::quiet_NaN();
  for (int k = 0; k < size; ++k)
  {
    packet.base[k] = heights.At(begin + packet.lane[k], request.j);
    const bool traced =
      !std::isnan(packet.base[k]) && (!request.wanted || request.wanted[first + k]);
    packet.active[k] = traced ? -1 : 0;
    anyBase = traced ? packet.base[k] : anyBase;
  }
  if (std::isnan(anyBase))
  {
    return false;
  }
  // Lanes without a ray to trace run beside the others.
  Samples samples;
  for (int k = 0; k < lanes; ++k)
  {
    const bool idle = k >= size || !packet.active[k];
    packet.base[k] = idle ? anyBase : packet.base[k];
    packet.active[k] = idle ? 0 : -1;
    packet.ground[k] = 0.0f;
    packet.s[k] = 0.0f;
    packet.thickness[k] = 0.0f;
    packet.rest[k] = 0.0f;
    packet.beyond[k] = 0;
    packet.resumed[k] = 0;
    packet.sink[k] =
      idle ? medium.depth : f32::reliefSink(field, medium, begin + packet.lane[k], request.j);
    const double shiftX = light.positional ? (begin + packet.lane[k]) * heights.spacingX : 0.0;
    const double shiftY = light.positional ? request.j * heights.spacingY : 0.0;
    const double shiftZ = light.positional ? packet.base[k] : 0.0;
    samples.lightX[k] = static_cast<float>(light.vector.x - shiftX);
    samples.lightY[k] = static_cast<float>(light.vector.y - shiftY);
    samples.lightZ[k] = static_cast<float>(light.vector.z - shiftZ);
  }
  const bool alongNormal = medium.offset == f32::RELIEF_SURFACE_NORMAL;
  for (int k = 0; alongNormal && k < lanes; ++k)
  {
    const glm::vec3 n = packet.active[k] ? request.normals[first + k] : glm::vec3(0.0f, 0.0f, 1.0f);
    samples.normalX[k] = n.x;
    samples.normalY[k] = n.y;
    samples.normalZ[k] = n.z;
  }
  SetUpRays(field, medium, light, begin, request.j, samples, packet);
  return true;
}

// Traces the rays of a packet of which some `asked` for it. Those that are to be traced alone, in
// the end, are marked.
void TraceTogether(const Field<float>& field, const f32::ReliefMedium& medium, int i, int j,
  const std::int32_t* asked, Packet& packet, RayCount& count)
{
  const int lanes = static_cast<int>(hn::Lanes(Tag()));
  std::int32_t alone[MaxLanes];
  std::copy_n(packet.alone, MaxLanes, alone);
  bool anyWalks = false;
  bool anyUpright = false;
  for (int k = 0; k < lanes; ++k)
  {
    const bool together = asked[k] && !alone[k];
    packet.active[k] = together && !packet.upright[k] ? -1 : 0;
    anyWalks = anyWalks || packet.active[k];
    anyUpright = anyUpright || (together && packet.upright[k]);
    count.cells += together && packet.upright[k] ? 1 : 0;
    if (together && !packet.resumed[k] && medium.offset == f32::RELIEF_SURFACE_NORMAL)
    {
      packet.ground[k] = StartHeight(field, i + packet.lane[k], j, packet, k);
    }
  }
  if (anyWalks)
  {
    TraceLanes(field, medium, i, j, packet, count);
  }
  if (anyUpright)
  {
    TraceUprightLanes(packet);
  }
  for (int k = 0; k < lanes; ++k)
  {
    packet.alone[k] = alone[k] || (packet.active[k] && packet.alone[k]) ? -1 : 0;
    packet.beyond[k] = packet.active[k] && !packet.alone[k] && packet.beyond[k] &&
        packet.dz[k] > 0.0f && !medium.useFloor
      ? -1
      : 0;
  }
}

// Traces a packet of a request that begins with its sample `first`. If it is of a tile, its rays
// that have left that.
void TracePacket(const Field<float>& field, const f32::ReliefMedium& medium, const Light& light,
  const RowRequest<float>& request, int first, const StripTile* tile, RayCount& count)
{
  const int lanes = static_cast<int>(hn::Lanes(Tag()));
  const int begin = request.ColumnOf(first);
  const int j = request.j;
  const float* left =
    tile ? tile->left + (j - tile->y0) * StripTile::Width + begin - tile->x0 : nullptr;
  if (left && std::count(left, left + lanes, StripTile::NotLeft) == lanes)
  {
    return;
  }
  Packet packet;
  if (!SetUpPacket(field, medium, light, request, first, packet))
  {
    return;
  }
  if (tile)
  {
    const int at = (j - tile->y0) * StripTile::Width + begin - tile->x0;
    Resume(field.heights, *tile, at, lanes, packet);
  }
  HWY_ALIGN std::int32_t asked[MaxLanes];
  std::copy_n(packet.active, MaxLanes, asked);
  TraceTogether(field, medium, begin, j, asked, packet, count);
  HWY_ALIGN float d[MaxLanes];
  const bool simple = medium.attenuation == f32::RELIEF_RECIPROCAL && medium.depth > 0.0f;
  if (simple)
  {
    IlluminateReciprocal(medium.depth, lanes, packet.thickness, packet.rest, d);
  }
  for (int k = 0; k < std::min(lanes, request.end - request.begin - first); ++k)
  {
    if (!asked[k])
    {
      continue;
    }
    ++count.rays;
    f32::ReliefTrace trace = { packet.thickness[k], packet.rest[k], 0 };
    if (packet.alone[k] || packet.beyond[k] || !simple)
    {
      const glm::vec3 n = medium.offset == f32::RELIEF_SURFACE_NORMAL ? request.normals[first + k]
                                                                      : glm::vec3(0.0f, 0.0f, 1.0f);
      glm::vec3 l;
      const int i = begin + packet.lane[k];
      const f32::ReliefRay ray = f32::reliefRay(
        field, medium, i, j, n, LightFrom<float>(light, field.heights, i, j), light.positional, l);
      if (packet.alone[k])
      {
        trace = f32::reliefTrace(field, medium, ray);
        count.cells += static_cast<std::uint64_t>(trace.cells);
      }
      else if (packet.beyond[k])
      {
        trace.thickness = Beyond(field, medium, ray, packet, k);
      }
      d[k] = f32::reliefTraced(field, medium, ray, n, l, trace);
    }
    request.illumination[first + k] = d[k];
    if (request.thickness)
    {
      request.thickness[first + k] = trace.thickness;
    }
  }
}

// How many rays of a row of samples are traced.
int RaysOf(const StripTile& tile, int row)
{
  int rays = 0;
  for (int k = 0; k < StripTile::Width; k += static_cast<int>(hn::Lanes(Tag())))
  {
    rays += tile.rays[row * StripTile::Width + k];
  }
  return rays;
}

// Fills d and r of a tile's rays that have come to their end.
void Illuminate(const f32::ReliefMedium& medium, const RowRequest<float>* requests, int rows,
  const StripTile& tile, const float* rest)
{
  const Tag tag;
  HWY_ALIGN float d[StripTile::Size];
  HWY_ALIGN float thickness[StripTile::Size];
  for (int at = 0; at < StripTile::Size; at += static_cast<int>(hn::Lanes(tag)))
  {
    hn::Store(
      hn::Mul(hn::Load(tag, tile.inside + at), hn::Load(tag, tile.span + at)), tag, thickness + at);
  }
  const bool simple = medium.attenuation == f32::RELIEF_RECIPROCAL && medium.depth > 0.0f;
  if (simple)
  {
    IlluminateReciprocal(medium.depth, StripTile::Size, thickness, rest, d);
  }
  for (int row = 0; row < rows; ++row)
  {
    const RowRequest<float>& request = requests[row];
    const int size = request.end - request.begin;
    if (simple && RaysOf(tile, row) == size)
    {
      std::copy_n(d + row * StripTile::Width, size, request.illumination);
      if (request.thickness)
      {
        std::copy_n(thickness + row * StripTile::Width, size, request.thickness);
      }
      continue;
    }
    for (int k = 0; k < size; ++k)
    {
      const int at = row * StripTile::Width + k;
      if (!tile.active[at])
      {
        continue;
      }
      if (!simple)
      {
        d[at] = f32::reliefIllumination(medium, thickness[at]);
        d[at] = rest && rest[at] > 0.0f
          ? (d[at] + f32::reliefIllumination(medium, thickness[at] + rest[at])) / 2.0f
          : d[at];
      }
      request.illumination[k] = d[at];
      if (request.thickness)
      {
        request.thickness[k] = thickness[at];
      }
    }
  }
}

// Whether rays of a tile may run in strips: where they begin near their samples and above a floor,
// if there is one, and do not run down for ever.
bool AreStripsFor(const Field<float>& field, const f32::ReliefMedium& medium, const Light& light,
  const StripTile& tile)
{
  const bool bounded = light.positional || tile.climbLo >= 0.0;
  const bool overFloor = !medium.useFloor ||
    (tile.climbLo > 0.0 && tile.footLo + LeastRise(tile, tile.startLo) > medium.floorHeight);
  const bool near =
    tile.startLo > -1.0e6 && tile.startHi < 1.0e6 && tile.shiftLo > -1.0e6 && tile.shiftHi < 1.0e6;
  // Depth 0 has a limit that strips do not tell.
  return medium.depth > 0.0f && bounded && overFloor && near && std::abs(field.top) < 1.0e15f &&
    tile.footLo > -1.0e15 && !SweepThickness::IsExtreme(medium.depth);
}

void TracePacketTile(const Field<float>& field, const f32::ReliefMedium& medium, const Light& light,
  const RowRequest<float>* requests, int rows, RayCount& count)
{
  const int lanes = static_cast<int>(hn::Lanes(Tag()));
  const int begin = requests[0].begin;
  const int end = requests[0].end;
  StripTile tile;
  bool strips = field.heights.stepX == 1;
  if (strips)
  {
    if (LoadSamples(field, requests, rows, tile) == 0)
    {
      return;
    }
    strips = ChooseAxis(field, light, end - begin, rows, tile) &&
      SetUpStrips(field, medium, light, requests, rows, tile) &&
      AreStripsFor(field, medium, light, tile);
  }
  if (strips)
  {
    HWY_ALIGN float rest[StripTile::Size];
    const bool settled = StripTracer(field, medium, tile).Trace(rest, count);
    for (int row = 0; row < rows; ++row)
    {
      count.rays += static_cast<std::uint64_t>(RaysOf(tile, row));
    }
    Illuminate(medium, requests, rows, tile, settled ? rest : nullptr);
  }
  for (int row = 0; row < rows; ++row)
  {
    for (int first = 0; first < end - begin && (!strips || tile.anyLeft[row]); first += lanes)
    {
      TracePacket(field, medium, light, requests[row], first, strips ? &tile : nullptr, count);
    }
  }
}

void TracePackets(const Field<float>& field, const f32::ReliefMedium& medium, const Light& light,
  const RowRequest<float>& request, RayCount& count)
{
  const int lanes = static_cast<int>(hn::Lanes(Tag()));
  for (int first = 0; first < request.end - request.begin; first += lanes)
  {
    TracePacket(field, medium, light, request, first, nullptr, count);
  }
}

}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace relief
{
HWY_EXPORT(TracePackets);
HWY_EXPORT(TracePacketTile);

namespace
{
// Packets index samples by 32 bits.
bool ArePacketsFor(const Field<float>& field)
{
  const HeightView<float>& heights = field.heights;
  return static_cast<double>(heights.stepY) * heights.rows +
      static_cast<double>(heights.stepX) * heights.columns <
    2147483647.0 &&
    reliefLevels(field) > 0;
}
}

void TracePackets(const Field<float>& field, const f32::ReliefMedium& medium, const Light& light,
  const RowRequest<float>& request, RayCount& count)
{
  if (!ArePacketsFor(field))
  {
    TraceRow<float>(field, medium, light, request, count);
    return;
  }
  HWY_DYNAMIC_DISPATCH(TracePackets)(field, medium, light, request, count);
}

void TracePacketTile(const Field<float>& field, const f32::ReliefMedium& medium, const Light& light,
  const RowRequest<float>* requests, int rows, RayCount& count)
{
  if (!ArePacketsFor(field))
  {
    for (int row = 0; row < rows; ++row)
    {
      TraceRow<float>(field, medium, light, requests[row], count);
    }
    return;
  }
  HWY_DYNAMIC_DISPATCH(TracePacketTile)(field, medium, light, requests, rows, count);
}

}

#endif
