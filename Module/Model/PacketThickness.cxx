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

// Sets up the rays of a packet as reliefRay() and reliefStretch() do. Rays that start outside the
// image, stay in one cell or never end are rare: they are marked to be traced alone.
void SetUpRays(const Field<float>& field, const f32::ReliefMedium& medium, const Light& light,
  int i, int j, const Samples& samples, Packet& packet, std::int32_t* alone)
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
  const Vector sink = alongNormal ? hn::Mul(depth, hn::Load(tag, samples.normalZ)) : depth;
  const Vector perX = hn::Set(tag, 1.0f / reliefSpacingX(field));
  const Vector perY = hn::Set(tag, 1.0f / reliefSpacingY(field));
  const Vector x = hn::Neg(hn::Mul(offsetX, perX));
  const Vector y = hn::Neg(hn::Mul(offsetY, perY));

  Vector lx = hn::Load(tag, samples.lightX);
  Vector ly = hn::Load(tag, samples.lightY);
  Vector dz = hn::Load(tag, samples.lightZ);
  Vector to = hn::Set(tag, Infinity);
  if (light.positional)
  {
    lx = hn::Add(lx, offsetX);
    ly = hn::Add(ly, offsetY);
    dz = hn::Add(dz, sink);
    const Vector scale = hn::Max(hn::Abs(lx), hn::Max(hn::Abs(ly), hn::Abs(dz)));
    const Vector partX = hn::Div(lx, scale);
    const Vector partY = hn::Div(ly, scale);
    const Vector partZ = hn::Div(dz, scale);
    const Vector size =
      hn::Sqrt(hn::MulAdd(partX, partX, hn::MulAdd(partY, partY, hn::Mul(partZ, partZ))));
    const Mask apart = hn::Gt(scale, zero);
    to = hn::IfThenElseZero(apart, hn::Mul(scale, size));
    const Vector perSize = hn::Div(one, size);
    lx = hn::IfThenElseZero(apart, hn::Mul(partX, perSize));
    ly = hn::IfThenElseZero(apart, hn::Mul(partY, perSize));
    dz = hn::IfThenElse(apart, hn::Mul(partZ, perSize), one);
  }
  // As reliefTrace() ends a ray before its light.
  const Vector before = hn::Set(tag, 2.0f * f32::RELIEF_ROUNDING);
  to = light.positional ? hn::NegMulAdd(before, to, to) : to;
  // As the model takes directions along an axis.
  const Vector tiny = hn::Set(tag, 1.0e-12f);
  const Vector dx = hn::IfThenZeroElse(hn::Lt(hn::Abs(lx), tiny), hn::Mul(lx, perX));
  const Vector dy = hn::IfThenZeroElse(hn::Lt(hn::Abs(ly), tiny), hn::Mul(ly, perY));
  const Mask up = hn::Gt(dz, zero);
  const Mask down = hn::Lt(dz, zero);
  const Mask endless = hn::And(down, hn::Eq(to, hn::Set(tag, Infinity)));

  Vector from = zero;
  if (medium.useFloor)
  {
    const Vector above = hn::Add(hn::Sub(hn::Set(tag, medium.floorHeight), base), sink);
    const Vector crossing = hn::Div(above, dz);
    from = hn::IfThenElseZero(up, hn::Max(crossing, zero));
    to = hn::IfThenElse(down, hn::Min(to, crossing), to);
    const Mask under = hn::And(hn::Eq(dz, zero), hn::Ge(above, zero));
    to = hn::IfThenElse(under, zero, to);
  }
  const Vector top = hn::Add(hn::Sub(hn::Set(tag, field.top), base), sink);
  to = hn::IfThenElse(up, hn::Min(to, hn::Div(top, dz)), to);

  // The cell ahead, as reliefCellAhead() tells it, from the sample.
  const Vector lane = hn::ConvertTo(tag, hn::Iota(intTag, 0));
  const Vector columns = hn::Set(tag, static_cast<float>(field.heights.columns - 1 - i));
  const Vector rows = hn::Set(tag, static_cast<float>(field.heights.rows - 1 - j));
  auto ahead = [&](Vector start, Vector direction, Vector cells)
  {
    const Vector cell =
      hn::IfThenElse(hn::Lt(direction, zero), hn::Sub(hn::Ceil(start), one), hn::Floor(start));
    const Mask lastLine = hn::And(
      hn::Eq(direction, zero), hn::And(hn::Eq(cell, cells), hn::Eq(start, hn::Floor(start))));
    return hn::IfThenElse(lastLine, hn::Sub(cell, one), cell);
  };
  const Vector columnsAhead = hn::Sub(columns, lane);
  const Vector cellX = ahead(x, dx, columnsAhead);
  const Vector cellY = ahead(y, dy, rows);
  const Vector firstX = hn::Sub(hn::Set(tag, static_cast<float>(-i)), lane);
  const Mask outside = hn::Or(hn::Or(hn::Lt(cellX, firstX), hn::Ge(cellX, columnsAhead)),
    hn::Or(hn::Lt(cellY, hn::Set(tag, static_cast<float>(-j))), hn::Ge(cellY, rows)));
  const Mask upright = hn::And(hn::Eq(dx, zero), hn::Eq(dy, zero));
  Mask single = hn::Or(outside, upright);
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
  hn::Store(hn::VecFromMask(intTag, hn::RebindMask(intTag, single)), intTag, alone);
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

// d by the reciprocal attenuation at a depth above 0, as reliefTraced() tells it.
void IlluminateReciprocal(float depth, const Packet& packet, float* d)
{
  const Tag tag;
  const Vector t = hn::Set(tag, depth);
  const Vector r = hn::Load(tag, packet.thickness);
  const Vector rest = hn::Load(tag, packet.rest);
  const Vector high = hn::Div(t, hn::Max(r, t));
  const Vector low = hn::Div(t, hn::Max(hn::Add(r, rest), t));
  hn::Store(hn::Mul(hn::Add(high, low), hn::Set(tag, 0.5f)), tag, d);
}

void TracePackets(const Field<float>& field, const f32::ReliefMedium& medium, const Light& light,
  const RowRequest<float>& request, RayCount& count)
{
  const Tag tag;
  const int lanes = static_cast<int>(hn::Lanes(tag));
  const HeightView<float>& heights = field.heights;
  const int j = request.j;
  const bool alongNormal = medium.offset == f32::RELIEF_SURFACE_NORMAL;
  const bool simple = medium.attenuation == f32::RELIEF_RECIPROCAL && medium.depth > 0.0f;
  Packet packet;
  Samples samples;
  HWY_ALIGN std::int32_t alone[MaxLanes];
  HWY_ALIGN float d[MaxLanes];
  for (int begin = request.begin; begin < request.end; begin += lanes)
  {
    const int size = std::min(lanes, request.end - begin);
    const int first = begin - request.begin;
    float anyBase = std::numeric_limits<float>::quiet_NaN();
    for (int k = 0; k < size; ++k)
    {
      packet.base[k] = heights.At(begin + k, j);
      const bool traced =
        !std::isnan(packet.base[k]) && (!request.wanted || request.wanted[first + k]);
      packet.active[k] = traced ? -1 : 0;
      count.rays += traced ? 1 : 0;
      anyBase = traced ? packet.base[k] : anyBase;
    }
    if (std::isnan(anyBase))
    {
      continue;
    }
    // Lanes without a ray to trace run beside the others.
    for (int k = 0; k < lanes; ++k)
    {
      const bool idle = k >= size || !packet.active[k];
      packet.base[k] = idle ? anyBase : packet.base[k];
      packet.active[k] = idle ? 0 : -1;
      packet.ground[k] = 0.0f;
      const double shiftX = light.positional ? (begin + k) * heights.spacingX : 0.0;
      const double shiftY = light.positional ? j * heights.spacingY : 0.0;
      const double shiftZ = light.positional ? packet.base[k] : 0.0;
      samples.lightX[k] = static_cast<float>(light.vector.x - shiftX);
      samples.lightY[k] = static_cast<float>(light.vector.y - shiftY);
      samples.lightZ[k] = static_cast<float>(light.vector.z - shiftZ);
    }
    for (int k = 0; alongNormal && k < lanes; ++k)
    {
      const glm::vec3 n =
        packet.active[k] ? request.normals[first + k] : glm::vec3(0.0f, 0.0f, 1.0f);
      samples.normalX[k] = n.x;
      samples.normalY[k] = n.y;
      samples.normalZ[k] = n.z;
    }
    SetUpRays(field, medium, light, begin, j, samples, packet, alone);

    auto rayOf = [&](int k, glm::vec3& n, glm::vec3& l)
    {
      n = alongNormal ? request.normals[first + k] : glm::vec3(0.0f, 0.0f, 1.0f);
      return f32::reliefRay(field, medium, begin + k, j, n,
        LightFrom<float>(light, heights, begin + k, j), light.positional, l);
    };
    HWY_ALIGN std::int32_t asked[MaxLanes];
    bool anyTogether = false;
    for (int k = 0; k < lanes; ++k)
    {
      asked[k] = packet.active[k];
      packet.active[k] = asked[k] && !alone[k] ? -1 : 0;
      anyTogether = anyTogether || packet.active[k];
    }
    for (int k = 0; alongNormal && k < size; ++k)
    {
      if (packet.active[k])
      {
        packet.ground[k] = StartHeight(field, begin + k, j, packet, k);
      }
    }
    if (anyTogether)
    {
      TraceLanes(field, medium, begin, j, packet, count);
      if (simple)
      {
        IlluminateReciprocal(medium.depth, packet, d);
      }
    }
    for (int k = 0; k < size; ++k)
    {
      if (!asked[k])
      {
        continue;
      }
      f32::ReliefTrace trace = { packet.thickness[k], packet.rest[k], 0 };
      if (alone[k] || !simple)
      {
        glm::vec3 n;
        glm::vec3 l;
        const f32::ReliefRay ray = rayOf(k, n, l);
        if (alone[k])
        {
          trace = f32::reliefTrace(field, medium, ray);
          count.cells += static_cast<std::uint64_t>(trace.cells);
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
}

}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace relief
{
HWY_EXPORT(TracePackets);

void TracePackets(const Field<float>& field, const f32::ReliefMedium& medium, const Light& light,
  const RowRequest<float>& request, RayCount& count)
{
  // Packets index samples by 32 bits.
  const HeightView<float>& heights = field.heights;
  const bool small = static_cast<double>(heights.stepY) * heights.rows +
      static_cast<double>(heights.stepX) * heights.columns <
    2147483647.0;
  if (!small || reliefLevels(field) == 0)
  {
    TraceRow<float>(field, medium, light, request, count);
    return;
  }
  HWY_DYNAMIC_DISPATCH(TracePackets)(field, medium, light, request, count);
}

}

#endif
