// SPDX-License-Identifier: BSD-3-Clause
// Included once for each instruction set, hence the guard that toggles.
#if defined(ThicknessLanes_inl_h) == defined(HWY_TARGET_TOGGLE)
#ifdef ThicknessLanes_inl_h
#undef ThicknessLanes_inl_h
#else
#define ThicknessLanes_inl_h
#endif

#include "SweepThickness.h"

#include <hwy/contrib/math/math-inl.h>
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

// The leaves of the model's text for a ray in each lane of a vector.
namespace lanes
{
using real = Vector;

HWY_INLINE Vector reliefReal(float x)
{
  return hn::Set(Tag(), x);
}

HWY_INLINE Vector reliefSelect(Mask mask, Vector a, Vector b)
{
  return hn::IfThenElse(mask, a, b);
}

HWY_INLINE Mask reliefAnd(Mask a, Mask b)
{
  return hn::And(a, b);
}

HWY_INLINE Mask reliefLess(Vector a, Vector b)
{
  return hn::Lt(a, b);
}

HWY_INLINE Mask reliefAtMost(Vector a, Vector b)
{
  return hn::Le(a, b);
}

HWY_INLINE Mask reliefEqual(Vector a, Vector b)
{
  return hn::Eq(a, b);
}

HWY_INLINE Mask reliefMissing(Vector a)
{
  return hn::IsNaN(a);
}

HWY_INLINE Vector reliefNegate(Vector a)
{
  return hn::Neg(a);
}

HWY_INLINE Vector reliefAdd(Vector a, Vector b)
{
  return hn::Add(a, b);
}

HWY_INLINE Vector reliefSubtract(Vector a, Vector b)
{
  return hn::Sub(a, b);
}

HWY_INLINE Vector reliefMultiply(Vector a, Vector b)
{
  return hn::Mul(a, b);
}

HWY_INLINE Vector reliefMultiplyAdd(Vector a, Vector b, Vector c)
{
  return hn::MulAdd(a, b, c);
}

HWY_INLINE Vector reliefDivide(Vector a, Vector b)
{
  return hn::Div(a, b);
}

HWY_INLINE Vector abs(Vector a)
{
  return hn::Abs(a);
}

HWY_INLINE Vector acos(Vector a)
{
  return hn::Acos(Tag(), a);
}

HWY_INLINE Vector atan(Vector a)
{
  return hn::Atan(Tag(), a);
}

HWY_INLINE Vector floor(Vector a)
{
  return hn::Floor(a);
}

HWY_INLINE Vector sqrt(Vector a)
{
  return hn::Sqrt(a);
}

HWY_INLINE Vector min(Vector a, Vector b)
{
  return hn::Min(a, b);
}

HWY_INLINE Vector max(Vector a, Vector b)
{
  return hn::Max(a, b);
}

// Of numbers from 0 to 1 to powers above 0, to single precision of 1.
HWY_INLINE Vector pow(Vector x, Vector power)
{
  const Tag tag;
  const Mask some = hn::Gt(x, hn::Zero(tag));
  const Vector logarithm = hn::Log(tag, hn::IfThenElse(some, x, hn::Set(tag, 1.0f)));
  return hn::IfThenElseZero(some, hn::Exp(tag, hn::Mul(power, logarithm)));
}

#define RELIEF_LANES
#define RELIEF_BOOL Mask
#define RELIEF_SAME float
#define RELIEF_FN HWY_INLINE
#define RELIEF_OUT(type) type&
#include "ReliefLeaves.glsl"
#undef RELIEF_LANES
#undef RELIEF_BOOL
#undef RELIEF_SAME
#undef RELIEF_FN
#undef RELIEF_OUT
}

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
  const Vector discriminant = lanes::reliefDiscriminant(high, low, c);
  const Vector root = hn::Sqrt(hn::Max(discriminant, zero));

  // A bow no deeper than the margin, a quarter of c, is none.
  const Vector bend = hn::Abs(c);
  const Vector least = hn::Mul(hn::Set(tag, 4.0f), marginB);
  const Mask differ = hn::Xor(aInside, bInside);
  const Mask turns = hn::And(hn::Gt(bend, hn::Max(fall, least)),
    hn::And(hn::Not(hn::Xor(hn::Gt(c, zero), aInside)), hn::Gt(discriminant, zero)));

  // One crossing; or two, the stretch between them or what is left of it.
  const Vector between = hn::IfThenElse(aInside, hn::Sub(bend, root), root);
  Vector numerator;
  Vector denominator;
  lanes::reliefCrossings(differ, between, high, low, c, root, numerator, denominator);
  // What is left, if that is short and would have lost its digits, is found from either end.
  const Mask left = hn::AndNot(differ, hn::And(turns, aInside));
  const Mask brief = hn::And(left, hn::Lt(between, hn::Mul(hn::Set(tag, 0.0625f), bend)));
  if (HWY_UNLIKELY(!hn::AllFalse(tag, brief)))
  {
    const Vector beside = hn::Sub(root, hn::Sub(hn::Sub(low, high), c));
    const Vector across = hn::Sub(root, hn::Sub(fall, c)); // from the lower end
    const Vector ends =
      hn::Add(hn::Mul(hn::Add(high, high), across), hn::Mul(hn::Add(low, low), beside));
    numerator = hn::IfThenElse(brief, ends, numerator);
    denominator = hn::IfThenElse(brief, hn::Mul(beside, across), denominator);
  }
  const Vector share = hn::Min(hn::Max(hn::Div(numerator, denominator), zero), one);
  return hn::IfThenElse(hn::Or(differ, turns), share, hn::IfThenElseZero(aInside, one));
}

// d of rays by the reciprocal attenuation at a depth above 0, as reliefTraced() tells it; `rest`
// may be null. The thicknesses are aligned, and their number is one of whole vectors.
HWY_INLINE void IlluminateReciprocal(
  float depth, int count, const float* thickness, const float* rest, float* d)
{
  const Tag tag;
  const Vector t = hn::Set(tag, depth);
  const int width = static_cast<int>(hn::Lanes(tag));
  for (int at = 0; at < count; at += width)
  {
    const Vector r = hn::Load(tag, thickness + at);
    Vector result = hn::Div(t, hn::Max(r, t));
    if (rest)
    {
      const Vector low = hn::Div(t, hn::Max(hn::Add(r, hn::Load(tag, rest + at)), t));
      result = hn::Mul(hn::Add(result, low), hn::Set(tag, 0.5f));
    }
    hn::StoreU(result, tag, d + at);
  }
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

  // The same for a rest that is finite.
  HWY_INLINE Mask OpenFor(Tag tag, Vector thickness, Vector rest) const
  {
    if (this->Exponential || this->Depth == 0.0f)
    {
      return this->Open(tag, thickness, rest);
    }
    const Vector depth = hn::Set(tag, this->Depth);
    const Vector r = hn::Max(thickness, depth);
    const Vector whole = hn::Mul(hn::Mul(hn::Set(tag, this->Twice), r), hn::Add(r, rest));
    return hn::Gt(hn::Mul(depth, rest), whole);
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
