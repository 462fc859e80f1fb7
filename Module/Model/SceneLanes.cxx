// SPDX-License-Identifier: BSD-3-Clause
#include "SceneLanes.h"

#include <algorithm>
#include <cmath>
#include <limits>

// Compiles the rest of this file once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "SceneLanes.cxx"
#include <hwy/foreach_target.h>

// After the loop over the targets, which defines for which one this is.
#include "ThicknessLanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace relief
{
namespace HWY_NAMESPACE
{

// Half as many samples, in double.
using WideTag = hn::CappedTag<double, MaxLanes / 2>;
using NarrowTag = hn::Rebind<float, WideTag>;

// Adds one channel of a term to the sums, or begins them: what `term` makes of each sample's share,
// in double.
template <class Term>
HWY_INLINE void AddPlane(const float* shares, bool first, double* sums, Term&& term)
{
  const WideTag wide;
  const NarrowTag narrow;
  for (int at = 0; at < SceneTile::Size; at += static_cast<int>(hn::Lanes(wide)))
  {
    const auto value = term(hn::Load(narrow, shares + at));
    hn::Store(first ? value : hn::Add(hn::Load(wide, sums + at), value), wide, sums + at);
  }
}

// Adds shares times a number, which a double holds exactly.
HWY_INLINE void AddProducts(const float* shares, float factor, bool first, double* sums)
{
  const WideTag wide;
  const auto wideFactor = hn::Set(wide, static_cast<double>(factor));
  AddPlane(shares, first, sums,
    [&](auto share) { return hn::Mul(hn::PromoteTo(wide, share), wideFactor); });
}

// What a term of the equation is in one channel of colour.
template <class D, class V>
HWY_INLINE V Tint(D tag, V share, float light, float color)
{
  return hn::Mul(hn::Mul(share, hn::Set(tag, light)), hn::Set(tag, color));
}

// Adds d times a colour.
HWY_INLINE void AddColor(
  const LightTerms& light, SceneTile::Term term, const glm::vec3& color, SceneTile& tile)
{
  const Tag tag;
  for (int c = 0; c < light.channels; ++c)
  {
    if (!light.only)
    {
      AddProducts(tile.d.values, color[c], light.first, tile.sums[term][c].values);
      continue;
    }
    for (int at = 0; at < SceneTile::Size; at += static_cast<int>(hn::Lanes(tag)))
    {
      hn::Store(hn::Mul(hn::Load(tag, tile.d.values + at), hn::Set(tag, color[c])), tag,
        tile.terms[term][c].values + at);
    }
  }
}

// Adds the tile's shares times the light's and a surface's colour.
HWY_INLINE void AddShares(
  const LightTerms& light, SceneTile::Term term, const glm::vec3& surface, SceneTile& tile)
{
  const Tag tag;
  const WideTag wide;
  const NarrowTag narrow;
  for (int c = 0; c < light.channels; ++c)
  {
    if (!light.only)
    {
      AddPlane(tile.share.values, light.first, tile.sums[term][c].values,
        [&](auto share)
        { return hn::PromoteTo(wide, Tint(narrow, share, light.radiance[c], surface[c])); });
      continue;
    }
    for (int at = 0; at < SceneTile::Size; at += static_cast<int>(hn::Lanes(tag)))
    {
      hn::Store(Tint(tag, hn::Load(tag, tile.share.values + at), light.radiance[c], surface[c]),
        tag, tile.terms[term][c].values + at);
    }
  }
}

// Copies heights where some are outside the image, or not side by side.
void CopyHeights(const HeightView<float>& heights, SceneTile& tile)
{
  constexpr int width = SceneTile::Width;
  const int i0 = tile.column * width;
  const int begin = std::max(i0 - 1, 0);
  const int end = std::min(i0 + width + 1, heights.columns);
  std::fill_n(
    tile.ring, (width + 2) * SceneTile::RingPitch, std::numeric_limits<float>::quiet_NaN());
  float* first = tile.ring + SceneTile::RingPitch + width;
  for (int row = -1; row <= width; ++row)
  {
    const int j = tile.row * width + row;
    for (int i = begin; j >= 0 && j < heights.rows && i < end; ++i)
    {
      first[row * SceneTile::RingPitch + i - i0] = heights.At(i, j);
    }
  }
  tile.firstHeight = first;
  tile.pitch = SceneTile::RingPitch;
}

bool LoadHeights(const HeightView<float>& heights, bool ring, SceneTile& tile)
{
  const Tag tag;
  constexpr int width = SceneTile::Width;
  const int i0 = tile.column * width;
  const int j0 = tile.row * width;
  const int more = ring ? 1 : 0;
  if (heights.stepX == 1 && i0 >= more && j0 >= more && i0 + width + more <= heights.columns &&
    j0 + width + more <= heights.rows)
  {
    tile.firstHeight = heights.data + j0 * heights.stepY + i0;
    tile.pitch = heights.stepY;
  }
  else
  {
    CopyHeights(heights, tile);
  }
  for (int at = 0; at < SceneTile::Size; at += static_cast<int>(hn::Lanes(tag)))
  {
    const Vector height = hn::LoadU(tag, tile.HeightsOf(at / width) + at % width);
    if (!hn::AllTrue(tag, hn::IsNaN(height)))
    {
      return true;
    }
  }
  return false;
}

HWY_INLINE Vector NormalAt(const SceneTile& tile, int axis, int at)
{
  return hn::Load(Tag(), tile.normal[axis].values + at);
}

// Toward a light, along one axis.
HWY_INLINE Vector TowardAt(const LightTerms& light, const SceneTile& tile, int axis, int at)
{
  return light.directional ? hn::Set(Tag(), light.vector[axis])
                           : hn::Load(Tag(), tile.toLight[axis].values + at);
}

// The shares of light that are mirrored toward the eye.
HWY_INLINE void FindMirrored(const LightTerms& light, SceneTile& tile)
{
  const Tag tag;
  const f32::ReliefFalloff& falloff = light.falloff;
  const bool begins = falloff.hi > falloff.lo && falloff.power > 0.0f;
  for (int at = 0; at < SceneTile::Size; at += static_cast<int>(hn::Lanes(tag)))
  {
    const Vector mirror =
      lanes::reliefMirrorOf(NormalAt(tile, 0, at), NormalAt(tile, 1, at), NormalAt(tile, 2, at),
        TowardAt(light, tile, 0, at), TowardAt(light, tile, 1, at), TowardAt(light, tile, 2, at));
    Vector share = hn::Zero(tag);
    // Most samples mirror nothing toward the eye.
    if (!begins || !hn::AllTrue(tag, hn::Le(mirror, hn::Set(tag, falloff.lo))))
    {
      share = lanes::reliefSpecularShare(
        light.ks, lanes::reliefFalloffOf(falloff.lo, falloff.hi, falloff.power, mirror));
    }
    hn::Store(share, tag, tile.share.values + at);
  }
}

void AddIllumination(const LightTerms& light, SceneTile& tile)
{
  AddProducts(tile.d.values, light.share, light.firstIllumination, tile.illumination.values);
}

void FindResponse(int response, const LightTerms& light, SceneTile& tile)
{
  const Tag tag;
  for (int at = 0; at < SceneTile::Size; at += static_cast<int>(hn::Lanes(tag)))
  {
    const Vector x = TowardAt(light, tile, 0, at);
    const Vector y = TowardAt(light, tile, 1, at);
    const Vector nx = NormalAt(tile, 0, at);
    const Vector ny = NormalAt(tile, 1, at);
    const Vector nz = NormalAt(tile, 2, at);
    const Vector answer = response == f32::RELIEF_IGOR
      ? lanes::reliefIgorResponse(nx, ny, nz, x, y)
      : lanes::reliefCombinedResponse(
          hn::Load(tag, tile.d.values + at), nx, ny, nz, x, y, TowardAt(light, tile, 2, at));
    hn::Store(answer, tag, tile.d.values + at);
  }
}

void AddTerms(const LightTerms& light, SceneTile& tile)
{
  const Tag tag;
  if (light.diffuse)
  {
    AddColor(light, SceneTile::Diffuse,
      f32::reliefDiffuseTerm(light.ks, light.kf, 1.0f, light.radiance, light.diffuseColor), tile);
  }
  if (light.scatter && light.directional)
  {
    AddColor(light, SceneTile::Scatter,
      f32::reliefScatterTerm(
        light.ks, light.kf, light.scatterFactor, 1.0f, light.radiance, light.diffuseColor),
      tile);
  }
  else if (light.scatter)
  {
    for (int at = 0; at < SceneTile::Size; at += static_cast<int>(hn::Lanes(tag)))
    {
      hn::Store(lanes::reliefScatterShare(light.ks, light.kf,
                  hn::Load(tag, tile.scatterFactor.values + at), hn::Load(tag, tile.d.values + at)),
        tag, tile.share.values + at);
    }
    AddShares(light, SceneTile::Scatter, light.diffuseColor, tile);
  }
  if (light.specular)
  {
    FindMirrored(light, tile);
    AddShares(light, SceneTile::Specular, light.specularColor, tile);
  }
}

void RoundSums(SceneTile::Term term, int channels, SceneTile& tile)
{
  const WideTag wide;
  const NarrowTag narrow;
  for (int c = 0; c < channels; ++c)
  {
    for (int at = 0; at < SceneTile::Size; at += static_cast<int>(hn::Lanes(wide)))
    {
      hn::Store(hn::DemoteTo(narrow, hn::Load(wide, tile.sums[term][c].values + at)), narrow,
        tile.terms[term][c].values + at);
    }
  }
}

// The slopes of the tangent planes at a vector of samples.
HWY_INLINE void SlopesAt(
  const SceneTile& tile, float spacingX, float spacingY, int at, Vector& gx, Vector& gy)
{
  const Tag tag;
  const float* own = tile.HeightsOf(at / SceneTile::Width) + at % SceneTile::Width;
  const Vector here = hn::LoadU(tag, own);
  gx = lanes::reliefSlope(
    hn::LoadU(tag, own - 1), here, hn::LoadU(tag, own + 1), hn::Set(tag, spacingX));
  gy = lanes::reliefSlope(hn::LoadU(tag, own - tile.pitch), here, hn::LoadU(tag, own + tile.pitch),
    hn::Set(tag, spacingY));
}

void FindNormals(float spacingX, float spacingY, SceneTile& tile)
{
  const Tag tag;
  for (int at = 0; at < SceneTile::Size; at += static_cast<int>(hn::Lanes(tag)))
  {
    Vector gx, gy, x, y, z;
    SlopesAt(tile, spacingX, spacingY, at, gx, gy);
    lanes::reliefUnitNormal(gx, gy, x, y, z);
    hn::Store(x, tag, tile.normal[0].values + at);
    hn::Store(y, tag, tile.normal[1].values + at);
    hn::Store(z, tag, tile.normal[2].values + at);
  }
}

void FindDirections(const Light& lamp, const f32::ReliefMedium& medium,
  const HeightView<float>& heights, SceneTile& tile)
{
  const Tag tag;
  const WideTag wide;
  const NarrowTag narrow;
  const Vector depth = hn::Set(tag, medium.depth);
  const float spacingX = static_cast<float>(heights.spacingX);
  const float spacingY = static_cast<float>(heights.spacingY);
  const bool tangent =
    medium.offset == f32::RELIEF_TANGENT_PLANE && heights.columns > 1 && heights.rows > 1;
  // As LightFrom(): subtracted in double.
  HWY_ALIGN float x[SceneTile::Width];
  HWY_ALIGN float z[SceneTile::Width];
  for (int column = 0; column < SceneTile::Width; ++column)
  {
    x[column] = static_cast<float>(lamp.vector.x - (tile.i0 + column) * heights.spacingX);
  }
  for (int at = 0; at < SceneTile::Size; at += static_cast<int>(hn::Lanes(tag)))
  {
    const int row = at / SceneTile::Width;
    const int column = at % SceneTile::Width;
    if (column == 0)
    {
      const float* own = tile.HeightsOf(row);
      for (int k = 0; k < SceneTile::Width; k += static_cast<int>(hn::Lanes(wide)))
      {
        const auto up =
          hn::Sub(hn::Set(wide, lamp.vector.z), hn::PromoteTo(wide, hn::LoadU(narrow, own + k)));
        hn::Store(hn::DemoteTo(narrow, up), narrow, z + k);
      }
    }
    const float north = static_cast<float>(lamp.vector.y - (tile.j0 + row) * heights.spacingY);
    Vector toX = hn::Load(tag, x + column);
    Vector toY = hn::Set(tag, north);
    Vector toZ = hn::Load(tag, z + column);
    if (medium.offset == f32::RELIEF_SURFACE_NORMAL)
    {
      toX = hn::Add(toX, hn::Mul(depth, NormalAt(tile, 0, at)));
      toY = hn::Add(toY, hn::Mul(depth, NormalAt(tile, 1, at)));
      toZ = hn::Add(toZ, hn::Mul(depth, NormalAt(tile, 2, at)));
    }
    else
    {
      Vector sink = depth;
      if (tangent)
      {
        Vector gx, gy;
        SlopesAt(tile, spacingX, spacingY, at, gx, gy);
        sink = lanes::reliefTangentSink(depth, gx, gy);
      }
      toZ = hn::Add(toZ, sink);
    }
    Vector lx, ly, lz, distance;
    lanes::reliefToward(toX, toY, toZ, lx, ly, lz, distance);
    hn::Store(lx, tag, tile.toLight[0].values + at);
    hn::Store(ly, tag, tile.toLight[1].values + at);
    hn::Store(lz, tag, tile.toLight[2].values + at);
  }
}

void FindScatter(const f32::ReliefFalloff& falloff, SceneTile& tile)
{
  const Tag tag;
  for (int at = 0; at < SceneTile::Size; at += static_cast<int>(hn::Lanes(tag)))
  {
    const Vector down = hn::Neg(hn::Load(tag, tile.toLight[2].values + at));
    hn::Store(lanes::reliefFalloffOf(falloff.lo, falloff.hi, falloff.power, down), tag,
      tile.scatterFactor.values + at);
  }
}

}
}
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace relief
{
HWY_EXPORT(LoadHeights);
HWY_EXPORT(AddIllumination);
HWY_EXPORT(FindResponse);
HWY_EXPORT(AddTerms);
HWY_EXPORT(RoundSums);
HWY_EXPORT(FindNormals);
HWY_EXPORT(FindDirections);
HWY_EXPORT(FindScatter);

bool LoadHeights(const HeightView<float>& heights, bool ring, SceneTile& tile)
{
  return HWY_DYNAMIC_DISPATCH(LoadHeights)(heights, ring, tile);
}

void AddIllumination(const LightTerms& light, SceneTile& tile)
{
  HWY_DYNAMIC_DISPATCH(AddIllumination)(light, tile);
}

void FindResponse(int response, const LightTerms& light, SceneTile& tile)
{
  HWY_DYNAMIC_DISPATCH(FindResponse)(response, light, tile);
}

void AddTerms(const LightTerms& light, SceneTile& tile)
{
  HWY_DYNAMIC_DISPATCH(AddTerms)(light, tile);
}

void RoundSums(SceneTile::Term term, int channels, SceneTile& tile)
{
  HWY_DYNAMIC_DISPATCH(RoundSums)(term, channels, tile);
}

void FindNormals(float spacingX, float spacingY, SceneTile& tile)
{
  HWY_DYNAMIC_DISPATCH(FindNormals)(spacingX, spacingY, tile);
}

void FindDirections(const Light& lamp, const f32::ReliefMedium& medium,
  const HeightView<float>& heights, SceneTile& tile)
{
  HWY_DYNAMIC_DISPATCH(FindDirections)(lamp, medium, heights, tile);
}

void FindScatter(const f32::ReliefFalloff& falloff, SceneTile& tile)
{
  HWY_DYNAMIC_DISPATCH(FindScatter)(falloff, tile);
}

}

#endif
