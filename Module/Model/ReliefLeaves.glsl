// SPDX-License-Identifier: BSD-3-Clause
//
// The formulas in which every traversal ends: what a ray has of level ground and of one patch, where it
// begins, ends and enters a cell; and those of the look that differ from sample to sample. In the dialect
// of ReliefModel.glsl, which follows, but without operators and branches on numbers: here `real` is also a
// vector with a ray or sample in each lane and RELIEF_BOOL its mask (ThicknessLanes-inl.h), and the vectors
// of some processors have functions only. So reliefSelect() takes what a ray needs of what is computed for
// all. RELIEF_SAME is a number that all lanes have in common.

// What these functions are for single rays, in every language.
#ifndef RELIEF_LANES
#define RELIEF_BOOL bool
#define RELIEF_SAME real
#define reliefReal(x) real(x)
#define reliefSelect(mask, a, b) ((mask) ? (a) : (b))
#define reliefAnd(a, b) ((a) && (b))
#define reliefLess(a, b) ((a) < (b))
#define reliefAtMost(a, b) ((a) <= (b))
#define reliefEqual(a, b) ((a) == (b))
#define reliefMissing(a) isnan(a)
#define reliefNegate(a) (-(a))
#define reliefAdd(a, b) ((a) + (b))
#define reliefSubtract(a, b) ((a) - (b))
#define reliefMultiply(a, b) ((a) * (b))
#define reliefMultiplyAdd(a, b, c) ((a) * (b) + (c))
#define reliefDivide(a, b) ((a) / (b))
#endif

// Slope along one axis from a sample's height and its two neighbours': central, one-sided where one
// neighbour has no data, level where neither has. Within numbers: differences of huge heights overflow.
RELIEF_FN real reliefSlope(real before, real here, real after, real spacing)
{
  RELIEF_BOOL first = reliefMissing(before);
  RELIEF_BOOL last = reliefMissing(after);
  real low = reliefSelect(first, here, before);
  real high = reliefSelect(last, here, after);
  real both = reliefSelect(last, spacing, reliefAdd(spacing, spacing));
  real slope = reliefDivide(reliefSubtract(high, low), reliefSelect(first, spacing, both));
  return max(min(slope, reliefReal(1.0e30f)), reliefReal(-1.0e30f));
}

// How far below a sample the point lies that is `depth` below the tangent plane there, whose slopes are
// gx and gy; twice the depth at most.
RELIEF_FN real reliefTangentSink(real depth, real gx, real gy)
{
  // Steeper than the limit is as steep, and its squares do not overflow.
  real two = reliefReal(2.0f);
  real x = min(abs(gx), two);
  real y = min(abs(gy), two);
  real squares = reliefMultiplyAdd(x, x, reliefMultiplyAdd(y, y, reliefReal(1.0f)));
  return reliefMultiply(depth, min(sqrt(squares), two));
}

// A component of a direction that is this small comes from rounding in somebody's sine or cosine; over
// the largest image it moves the ray by less than a ten-thousandth of a sample, but it would take a ray
// along the last grid line out of the image.
const float RELIEF_ALONG_AXIS = 1.0e-12f;

// The unit vector and the distance to a light at (x, y, z); up, where it is at the start. Scaled by the
// largest part first, so that the squares neither overflow nor vanish.
RELIEF_FN void reliefToward(real x, real y, real z, RELIEF_OUT(real) lx, RELIEF_OUT(real) ly,
  RELIEF_OUT(real) lz, RELIEF_OUT(real) distance)
{
  real zero = reliefReal(0.0f);
  real scale = max(abs(x), max(abs(y), abs(z)));
  RELIEF_BOOL apart = reliefLess(zero, scale);
  real partX = reliefDivide(x, scale);
  real partY = reliefDivide(y, scale);
  real partZ = reliefDivide(z, scale);
  real squares = reliefMultiplyAdd(
    partZ, partZ, reliefMultiplyAdd(partY, partY, reliefMultiply(partX, partX)));
  real size = sqrt(squares);
  lx = reliefSelect(apart, reliefDivide(partX, size), zero);
  ly = reliefSelect(apart, reliefDivide(partY, size), zero);
  lz = reliefSelect(apart, reliefDivide(partZ, size), reliefReal(1.0f));
  distance = reliefSelect(apart, reliefMultiply(scale, size), zero);
}

// Samples along an axis per unit of length.
RELIEF_FN real reliefAlong(real l, real spacing)
{
  RELIEF_BOOL along = reliefLess(abs(l), reliefReal(RELIEF_ALONG_AXIS));
  return reliefSelect(along, reliefReal(0.0f), reliefDivide(l, spacing));
}

// The grid line behind which a ray at x enters a cell along one axis, both counted from its sample: the
// cell lies ahead; beside a ray along a grid line it is the one after the line, and before the last line
// the last.
RELIEF_FN real reliefLineAhead(real x, real dx, real last)
{
  RELIEF_BOOL back = reliefLess(dx, reliefReal(0.0f));
  real line = floor(reliefSelect(back, reliefNegate(x), x));
  real before = reliefSubtract(line, reliefReal(1.0f));
  RELIEF_BOOL alongLast = reliefAnd(reliefEqual(dx, reliefReal(0.0f)),
    reliefAnd(reliefEqual(line, last), reliefEqual(x, line)));
  real behind = reliefSubtract(reliefReal(-1.0f), line);
  return reliefSelect(back, behind, reliefSelect(alongLast, before, line));
}

// The stretch of a ray that can be inside: above the floor, not above everything and this side of the
// light. Nothing where it ends before it begins.
RELIEF_FN void reliefStretch(bool useFloor, real floorHeight, real top, real base, real sink, real dz,
  real end, RELIEF_OUT(real) from, RELIEF_OUT(real) to)
{
  real zero = reliefReal(0.0f);
  RELIEF_BOOL up = reliefLess(zero, dz);
  from = zero;
  to = end;
  if (useFloor)
  {
    real above = reliefAdd(reliefSubtract(floorHeight, base), sink);
    real crossing = reliefDivide(above, dz);
    from = reliefSelect(up, max(crossing, zero), zero);
    to = reliefSelect(reliefLess(dz, zero), min(to, crossing), to);
    RELIEF_BOOL under = reliefAnd(reliefEqual(dz, zero), reliefAtMost(zero, above));
    to = reliefSelect(under, zero, to);
  }
  real below = reliefAdd(reliefSubtract(top, base), sink);
  to = reliefSelect(up, min(to, reliefDivide(below, dz)), to);
}

// The height at a place on a grid line between two samples, the first of them at `line`. From the nearer
// of the two: beside the start's own sample rounding counts as little as the other weighs.
RELIEF_FN real reliefBetween(real place, real line, real first, real second)
{
  real before = reliefSubtract(place, line);
  real after = reliefSubtract(reliefAdd(line, reliefReal(1.0f)), place);
  RELIEF_BOOL far = reliefLess(after, before);
  real weight = max(min(before, after), reliefReal(0.0f));
  real near = reliefSelect(far, second, first);
  real other = reliefSelect(far, first, second);
  return reliefMultiplyAdd(reliefSubtract(other, near), weight, near);
}

// The inside length between s0 and s1 under level ground that lies `ground` above the start of a ray
// which rises by dz per unit of length; s1 may be infinite.
RELIEF_FN real reliefLevelLength(real s0, real s1, real ground, real dz)
{
  real zero = reliefReal(0.0f);
  real crossing = reliefDivide(ground, dz);
  RELIEF_BOOL up = reliefLess(zero, dz);
  real begin = reliefSelect(up, s0, max(s0, crossing));
  real end = reliefSelect(up, min(s1, crossing), s1);
  real level = reliefSelect(reliefLess(zero, ground), reliefSubtract(s1, s0), zero);
  // Both may be infinite.
  real slanted = reliefSelect(reliefLess(begin, end), reliefSubtract(end, begin), zero);
  real length = reliefSelect(reliefEqual(dz, zero), level, slanted);
  return reliefSelect(reliefLess(s0, s1), length, zero);
}

//-------------------------------------------------------------------------------------------------
// Where the height of a patch above a ray is positive. It is a quadratic, of which c is the second
// coefficient, between its higher and its lower end.

RELIEF_FN real reliefDiscriminant(real high, real low, real c)
{
  // From the end nearer to zero: where two crossings meet there, nothing cancels.
  RELIEF_BOOL fromLow = reliefLess(abs(low), abs(high));
  real slope = reliefSubtract(reliefSubtract(low, high), c); // away from the higher end
  real rise = reliefSubtract(reliefSubtract(high, low), c);  // away from the lower one
  real end = reliefSelect(fromLow, low, high);
  real away = reliefSelect(fromLow, rise, slope);
  return reliefSubtract(
    reliefMultiply(away, away), reliefMultiply(reliefReal(4.0f), reliefMultiply(end, c)));
}

// The share of the line before its one crossing, from the end inside it, or else `between` of c: the
// stretch between two crossings or what they leave. As a fraction, so that one division serves all.
RELIEF_FN void reliefCrossings(RELIEF_BOOL one, real between, real high, real low, real c, real root,
  RELIEF_OUT(real) numerator, RELIEF_OUT(real) denominator)
{
  real slope = reliefSubtract(reliefSubtract(low, high), c);
  // Of the two ways to write that root, the one in which nothing cancels. Where the surface does not fall
  // away from the higher end, c is negative.
  RELIEF_BOOL falls = reliefAnd(one, reliefLess(slope, reliefReal(0.0f)));
  real bend = abs(c);
  real other = reliefSelect(one, reliefAdd(root, slope), reliefAdd(between, between));
  numerator = reliefSelect(falls, reliefAdd(high, high), other);
  denominator = reliefSelect(falls, reliefSubtract(root, slope), reliefAdd(bend, bend));
}

//-------------------------------------------------------------------------------------------------
// The look: what of it differs from sample to sample

// The unit normal of a surface that has slopes gx and gy (section 4.3.5.1, with the division by the spacing).
RELIEF_FN void reliefUnitNormal(
  real gx, real gy, RELIEF_OUT(real) nx, RELIEF_OUT(real) ny, RELIEF_OUT(real) nz)
{
  // Scaled by the larger slope first: the squares of a cliff's slopes would overflow.
  real one = reliefReal(1.0f);
  real scale = max(one, max(abs(gx), abs(gy)));
  real z = reliefDivide(one, scale);
  real x = reliefMultiply(reliefNegate(gx), z);
  real y = reliefMultiply(reliefNegate(gy), z);
  real squares = reliefMultiplyAdd(z, z, reliefMultiplyAdd(y, y, reliefMultiply(x, x)));
  real inverse = reliefDivide(one, sqrt(squares));
  nx = reliefMultiply(x, inverse);
  ny = reliefMultiply(y, inverse);
  nz = reliefMultiply(z, inverse);
}

// R * l of section 3.4: the view's mirror image R in the surface of normal n, compared with the light
// direction l.
RELIEF_FN real reliefMirrorOf(real nx, real ny, real nz, real lx, real ly, real lz)
{
  real twice = reliefAdd(nz, nz);
  real level = reliefMultiplyAdd(
    reliefMultiply(twice, ny), ly, reliefMultiply(reliefMultiply(twice, nx), lx));
  real up = reliefSubtract(reliefMultiply(twice, nz), reliefReal(1.0f));
  return reliefMultiplyAdd(up, lz, level);
}

// F of section 4.3.6: 0 at lo, 1 at hi; a step at hi where the two are equal.
RELIEF_FN real reliefFalloffOf(RELIEF_SAME lo, RELIEF_SAME hi, RELIEF_SAME power, real x)
{
  real zero = reliefReal(0.0f);
  real one = reliefReal(1.0f);
  if (!(hi > lo))
  {
    return reliefSelect(reliefAtMost(reliefReal(hi), x), one, zero);
  }
  real share = reliefDivide(reliefSubtract(x, reliefReal(lo)), reliefReal(hi - lo));
  share = max(min(share, one), zero);
  // pow(0, 0) is undefined in GLSL; a power of 0 means no falloff at all. Most powers are 1.
  return power == 0.0f ? one : power == 1.0f ? share : pow(share, reliefReal(power));
}

// sRGB to linear, IEC 61966-2-1, of a code from 0 to 1.
RELIEF_FN real reliefDecodeOf(real code)
{
  real linear = reliefDivide(code, reliefReal(12.92f));
  // The same 0.055 below and above, so that 1 stays 1.
  real foot = reliefReal(0.055f);
  real base = reliefDivide(reliefAdd(code, foot), reliefAdd(reliefReal(1.0f), foot));
  return reliefSelect(
    reliefAtMost(code, reliefReal(0.04045f)), linear, pow(base, reliefReal(2.4f)));
}

//-------------------------------------------------------------------------------------------------
// Cartographers' answers of a surface to light, which stand in the place of d: bright where it is level,
// the darker the steeper it is and the farther away light comes from.

// `whole` is the share of black that one unit of both angles gives, in codes of sRGB.
RELIEF_FN real reliefSlopeResponse(
  real away, real nx, real ny, real nz, RELIEF_SAME whole)
{
  real squares = reliefMultiplyAdd(ny, ny, reliefMultiply(nx, nx));
  real slope = atan(reliefDivide(sqrt(squares), nz));
  real shade = reliefMultiply(reliefMultiply(away, slope), reliefReal(whole));
  return reliefDecodeOf(max(reliefSubtract(reliefReal(1.0f), shade), reliefReal(0.0f)));
}

RELIEF_FN real reliefAngleOf(real cosine)
{
  return acos(max(min(cosine, reliefReal(1.0f)), reliefReal(-1.0f)));
}

// Slope times the angle at which light comes in, that of a hillshade or, in shadow, of d: GDAL's combined
// shading, there with the cosine alone. (2 / pi)^2.
RELIEF_FN real reliefCombinedResponse(
  real d, real nx, real ny, real nz, real lx, real ly, real lz)
{
  real level = reliefMultiplyAdd(ny, ly, reliefMultiply(nx, lx));
  real cosine = reliefMultiplyAdd(nz, lz, level);
  return reliefSlopeResponse(reliefAngleOf(min(d, cosine)), nx, ny, nz, 0.40528473f);
}

// Slope times the angle on the map between where the ground falls to and the light: I. Maerevoet's shading,
// as in GDAL. Nothing is behind anything. 2 / pi^2.
RELIEF_FN real reliefIgorResponse(real nx, real ny, real nz, real lx, real ly)
{
  real level = reliefMultiplyAdd(ny, ly, reliefMultiply(nx, lx));
  real falls = reliefMultiplyAdd(ny, ny, reliefMultiply(nx, nx));
  real leans = reliefMultiplyAdd(ly, ly, reliefMultiply(lx, lx));
  real size = sqrt(reliefMultiply(falls, leans));
  RELIEF_BOOL aside = reliefLess(reliefReal(0.0f), size);
  real cosine = reliefSelect(aside, reliefDivide(level, size), reliefReal(1.0f));
  return reliefSlopeResponse(reliefAngleOf(cosine), nx, ny, nz, 0.20264237f);
}

// What of a light goes straight through, is scattered toward the eye and is mirrored: its shares in the
// terms of the integrated equation (sections 3.5 and 4.3.7).
RELIEF_FN real reliefDiffuseShare(RELIEF_SAME ks, RELIEF_SAME kf, real d)
{
  return reliefMultiply(reliefReal((1.0f - ks) * (1.0f - kf)), d);
}

RELIEF_FN real reliefScatterShare(RELIEF_SAME ks, RELIEF_SAME kf, real f, real d)
{
  return reliefMultiply(reliefMultiply(reliefReal((1.0f - ks) * kf), f), d);
}

RELIEF_FN real reliefSpecularShare(RELIEF_SAME ks, real s)
{
  return reliefMultiply(reliefReal(ks), s);
}
