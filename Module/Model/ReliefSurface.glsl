// SPDX-License-Identifier: BSD-3-Clause
//
// The height field's surface and what a straight line has of it: the second of the model's three texts,
// in the dialect of ReliefModel.glsl, which it follows. Each host supplies the height field through
//   int reliefColumns(field), reliefRows(field)    size in samples
//   real reliefSpacingX(field), reliefSpacingY(field)
//   real reliefHeight(field, i, j)                 height of a sample, NaN where there is no data

// Slope along one axis from a sample's height and its two neighbours': central, one-sided where one
// neighbour has no data, level where neither has.
RELIEF_FN real reliefSlope(real before, real here, real after, real spacing)
{
  if (isnan(before))
  {
    return isnan(after) ? real(0.0f) : (after - here) / spacing;
  }
  return isnan(after) ? (here - before) / spacing : (after - before) / (2.0f * spacing);
}

// The unit normal at a sample (section 4.3.5.1, with the division by the spacing).
RELIEF_FIELD_FN real3 reliefNormal(RELIEF_FIELD field, int i, int j)
{
  real none = RELIEF_NAN;
  real here = reliefHeight(field, i, j);
  real west = i > 0 ? reliefHeight(field, i - 1, j) : none;
  real east = i + 1 < reliefColumns(field) ? reliefHeight(field, i + 1, j) : none;
  real south = j > 0 ? reliefHeight(field, i, j - 1) : none;
  real north = j + 1 < reliefRows(field) ? reliefHeight(field, i, j + 1) : none;
  // Within numbers: differences of huge heights overflow.
  real most = 1.0e30f;
  real gx = clamp(reliefSlope(west, here, east, reliefSpacingX(field)), -most, most);
  real gy = clamp(reliefSlope(south, here, north, reliefSpacingY(field)), -most, most);
  // Scaled by the larger slope first: the squares of a cliff's slopes would overflow.
  real scale = max(real(1.0f), max(abs(gx), abs(gy)));
  real3 n = real3(-gx / scale, -gy / scale, 1.0f / scale);
  return n / sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
}

//-------------------------------------------------------------------------------------------------
// The length of a straight line inside the material (section 3.2.1)

// The share of 0 <= u <= 1 in which a + (b - a) u + c u (u - 1) is positive. The height of a bilinear
// patch above a straight ray is such a quadratic, a and b its values where the ray enters and leaves.
RELIEF_FN real reliefInsideShare(real a, real b, real c)
{
  bool aInside = a > 0.0f;
  bool bInside = b > 0.0f;
  real all = aInside ? real(1.0f) : real(0.0f);
  // Only a turning point between the ends that curves toward zero can cross it, and then twice.
  if (aInside == bInside && (abs(c) <= abs(b - a) || (c > 0.0f) != aInside))
  {
    return all;
  }
  // Scaled by the largest first: the squares of huge heights would overflow, of tiny ones vanish.
  real scale = max(abs(a), max(abs(b), abs(c)));
  // Each crossing is found from the end inside it, the higher one first: 1 - u would have lost the
  // digits of a short stretch.
  real high = max(a, b) / scale;
  real low = min(a, b) / scale;
  c /= scale;
  real slope = low - high - c; // away from the higher end
  real rise = high - low - c;  // away from the lower one
  // From the end nearer to zero: where two crossings meet there, nothing cancels.
  real discriminant =
    abs(low) < abs(high) ? rise * rise - 4.0f * low * c : slope * slope - 4.0f * high * c;
  real root = sqrt(max(discriminant, real(0.0f)));
  real share;
  if (aInside != bInside)
  {
    // Of the two ways to write that root, the one in which nothing cancels.
    share = slope < 0.0f ? 2.0f * high / (root - slope) : -(slope + root) / (2.0f * c);
  }
  else if (discriminant <= 0.0f)
  {
    return all;
  }
  else
  {
    share = aInside ? 2.0f * high / (root - slope) + 2.0f * low / (root - rise)
                    : root / abs(c);
  }
  return clamp(share, real(0.0f), real(1.0f));
}

// The inside length between s0 and s1, restricted to [from, to], of such a quadratic.
RELIEF_FN real reliefPatchLength(real s0, real s1, real a, real b, real c, real from, real to)
{
  real len = s1 - s0;
  if (from <= s0 && to >= s1)
  {
    return len * reliefInsideShare(a, b, c);
  }
  if (!(len > 0.0f) || to <= s0 || from >= s1)
  {
    return 0.0f;
  }
  real u0 = max(from - s0, real(0.0f)) / len;
  real u1 = min((to - s0) / len, real(1.0f));
  real span = u1 - u0;
  if (!(span > 0.0f))
  {
    return 0.0f;
  }
  real a0 = a + (b - a) * u0 + c * u0 * (u0 - 1.0f);
  real b0 = a + (b - a) * u1 + c * u1 * (u1 - 1.0f);
  return (min(to, s1) - max(from, s0)) * reliefInsideShare(a0, b0, c * span * span);
}

// The inside length between s0 and s1 under level ground that lies `ground` above the start of a ray
// which rises by dz per unit of length; s1 may be infinite.
RELIEF_FN real reliefLevelLength(real s0, real s1, real ground, real dz)
{
  if (!(s1 > s0))
  {
    return 0.0f;
  }
  if (dz == 0.0f)
  {
    return ground > 0.0f ? s1 - s0 : real(0.0f);
  }
  real crossing = ground / dz;
  real begin = dz > 0.0f ? s0 : max(s0, crossing);
  real end = dz > 0.0f ? min(s1, crossing) : s1;
  return end > begin ? end - begin : real(0.0f); // both may be infinite
}
