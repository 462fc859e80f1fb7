// SPDX-License-Identifier: BSD-3-Clause
// Included once for each instruction set, hence the guard that toggles.
#if defined(ThicknessLanes_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef ThicknessLanes_inl_h
#undef ThicknessLanes_inl_h
#else
#define ThicknessLanes_inl_h
#endif

#include "SweepThickness.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

HWY_BEFORE_NAMESPACE();
namespace relief
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

// As many rays as fit into one vector, at most a row of a tile.
constexpr int MaxLanes = 16;
static_assert(MaxLanes == SweepThickness::TileWidth);
using Tag = hn::CappedTag<float, MaxLanes>;
using Vector = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;
using IntTag = hn::RebindToSigned<Tag>;

// The power of two that brings a number's magnitude to [1, 2), as far as there is one.
HWY_INLINE Vector Normalizer(Tag tag, Vector magnitude)
{
  const IntTag intTag;
  const auto exponent =
    hn::And(hn::BitCast(intTag, magnitude), hn::Set(intTag, std::int32_t{ 0x7F800000 }));
  // 2^-127 is no normal number.
  const auto inverse = hn::Max(hn::Sub(hn::Set(intTag, std::int32_t{ 0x7F000000 }), exponent),
    hn::Set(intTag, std::int32_t{ 0x00800000 }));
  return hn::BitCast(tag, inverse);
}

// reliefInsideShare() for the lanes of a vector, of numbers whose squares are numbers too. An end
// within its margin of 0 is on the surface.
HWY_INLINE Vector InsideShare(Tag tag, Vector a, Vector b, Vector c, Vector marginA, Vector marginB)
{
  const Vector zero = hn::Zero(tag);
  const Vector one = hn::Set(tag, 1.0f);
  const Mask aInside = hn::Gt(a, marginA);
  const Mask bInside = hn::Gt(b, marginB);
  a = hn::IfThenElse(aInside, a, hn::Min(a, zero));
  b = hn::IfThenElse(bInside, b, hn::Min(b, zero));
  const Vector high = hn::Max(a, b);
  const Vector low = hn::Min(a, b);
  const Vector fall = hn::Sub(high, low);
  const Vector slope = hn::Sub(hn::Sub(low, high), c); // away from the higher end
  const Vector rise = hn::Sub(fall, c);                // away from the lower one
  // From the end nearer to zero: where two crossings meet there, nothing cancels.
  const Mask fromLow = hn::Lt(hn::Abs(low), hn::Abs(high));
  const Vector end = hn::IfThenElse(fromLow, low, high);
  const Vector away = hn::IfThenElse(fromLow, rise, slope);
  const Vector discriminant =
    hn::Sub(hn::Mul(away, away), hn::Mul(hn::Set(tag, 4.0f), hn::Mul(end, c)));
  const Vector root = hn::Sqrt(hn::Max(discriminant, zero));

  // A bow no deeper than the margin, a quarter of c, is none.
  const Vector bend = hn::Abs(c);
  const Vector least = hn::Mul(hn::Set(tag, 4.0f), marginB);
  const Mask differ = hn::Xor(aInside, bInside);
  const Mask turns = hn::And(hn::Gt(bend, hn::Max(fall, least)),
    hn::And(hn::Not(hn::Xor(hn::Gt(c, zero), aInside)), hn::Gt(discriminant, zero)));

  // One crossing, from the end inside it; or two, the stretch between them or what is left of it.
  // One division serves all. Where the surface does not fall away from the higher end, c is
  // negative.
  const Mask falls = hn::And(differ, hn::Lt(slope, zero));
  const Vector twice = hn::Add(high, high);
  const Vector beside = hn::Sub(root, slope);
  const Vector between = hn::IfThenElse(aInside, hn::Sub(bend, root), root);
  Vector numerator = hn::IfThenElse(
    falls, twice, hn::IfThenElse(differ, hn::Add(root, slope), hn::Add(between, between)));
  Vector denominator = hn::IfThenElse(falls, beside, hn::Add(bend, bend));
  // What is left, if that is short and would have lost its digits, is found from either end.
  const Mask left = hn::AndNot(differ, hn::And(turns, aInside));
  const Mask brief = hn::And(left, hn::Lt(between, hn::Mul(hn::Set(tag, 0.0625f), bend)));
  if (HWY_UNLIKELY(!hn::AllFalse(tag, brief)))
  {
    const Vector across = hn::Sub(root, rise); // as beside, from the lower end
    numerator = hn::IfThenElse(
      brief, hn::Add(hn::Mul(twice, across), hn::Mul(hn::Add(low, low), beside)), numerator);
    denominator = hn::IfThenElse(brief, hn::Mul(beside, across), denominator);
  }
  const Vector share = hn::Min(hn::Max(hn::Div(numerator, denominator), zero), one);
  return hn::IfThenElse(hn::Or(differ, turns), share, hn::IfThenElseZero(aInside, one));
}

// Tells which rays' d may still change by more than the tolerance.
class Settler
{
public:
  explicit Settler(const f32::ReliefMedium& medium)
    : Exponential(medium.attenuation == f32::RELIEF_EXPONENTIAL)
    , Depth(medium.depth)
    , Twice(2.0f * medium.tolerance)
    , Density(medium.density)
    // exp(-a (r - t)) <= 2 epsilon beyond this thickness.
    , Dark(this->Exponential ? medium.depth - std::log(std::min(this->Twice, 1.0f)) / medium.density
                             : 0.0f)
  {
  }

  HWY_INLINE Mask Open(Tag tag, Vector thickness, Vector rest) const
  {
    const Vector twice = hn::Set(tag, this->Twice);
    if (this->Exponential)
    {
      // The slope of d is at most a. Of an endless rest, which lets nothing through, it says
      // nothing. A dense material is dark right behind the depth, at which it is not yet.
      const Mask endless = hn::Eq(rest, hn::Set(tag, std::numeric_limits<float>::infinity()));
      return hn::And(hn::Le(thickness, hn::Set(tag, this->Dark)),
        hn::Or(endless, hn::Gt(hn::Mul(rest, hn::Set(tag, this->Density)), twice)));
    }
    // At depth 0 nothing gets through any thickness at all.
    if (this->Depth == 0.0f)
    {
      return hn::Le(thickness, hn::Zero(tag));
    }
    // t / r - t / (r + rest) = t / (r (r / rest + 1)) > 2 epsilon, also where the rest is infinite.
    const Vector depth = hn::Set(tag, this->Depth);
    const Vector r = hn::Max(thickness, depth);
    const Vector one = hn::Set(tag, 1.0f);
    return hn::Gt(depth, hn::Mul(hn::Mul(twice, r), hn::Add(hn::Div(r, rest), one)));
  }

private:
  bool Exponential;
  float Depth;
  float Twice;
  float Density;
  float Dark;
};

}
}
HWY_AFTER_NAMESPACE();

#endif
