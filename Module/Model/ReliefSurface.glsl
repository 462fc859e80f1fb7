// SPDX-License-Identifier: BSD-3-Clause
//
// The height field's surface and what a straight line has of it: the third of the model's five texts,
// in the dialect of ReliefModel.glsl. It follows ReliefLeaves.glsl. Each host supplies the height field through
//   int reliefColumns(field), reliefRows(field)    size in samples
//   real reliefSpacingX(field), reliefSpacingY(field)
//   real reliefHeight(field, i, j)                 height of a sample, NaN where there is no data

// The slopes of the tangent plane at a sample, by central differences.
RELIEF_FIELD_FN void reliefSlopes(RELIEF_FIELD field, int i, int j, RELIEF_OUT(real) gx, RELIEF_OUT(real) gy)
{
  real none = RELIEF_NAN;
  real here = reliefHeight(field, i, j);
  real west = i > 0 ? reliefHeight(field, i - 1, j) : none;
  real east = i + 1 < reliefColumns(field) ? reliefHeight(field, i + 1, j) : none;
  real south = j > 0 ? reliefHeight(field, i, j - 1) : none;
  real north = j + 1 < reliefRows(field) ? reliefHeight(field, i, j + 1) : none;
  gx = reliefSlope(west, here, east, reliefSpacingX(field));
  gy = reliefSlope(south, here, north, reliefSpacingY(field));
}

// The unit normal at a sample.
RELIEF_FIELD_FN real3 reliefNormal(RELIEF_FIELD field, int i, int j)
{
  real gx;
  real gy;
  reliefSlopes(field, i, j, gx, gy);
  real3 n;
  reliefUnitNormal(gx, gy, n.x, n.y, n.z);
  return n;
}

// How far below a sample the point lies that is sunk straight down from it.
RELIEF_FIELD_FN real reliefSink(RELIEF_FIELD field, ReliefMedium medium, int i, int j)
{
  // An image of one row or column has no surface, and is shaded as level ground.
  if (medium.offset != RELIEF_TANGENT_PLANE || reliefColumns(field) < 2 || reliefRows(field) < 2)
  {
    return medium.depth;
  }
  real gx;
  real gy;
  reliefSlopes(field, i, j, gx, gy);
  return reliefTangentSink(medium.depth, gx, gy);
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
  real discriminant = reliefDiscriminant(high, low, c);
  real root = sqrt(max(discriminant, real(0.0f)));
  real share;
  if (aInside && bInside)
  {
    // What two crossings leave, each found from its own end.
    share = 2.0f * high / (root - (low - high - c)) + 2.0f * low / (root - (high - low - c));
  }
  else
  {
    real numerator;
    real denominator;
    reliefCrossings(aInside != bInside, root, high, low, c, root, numerator, denominator);
    share = numerator / denominator;
  }
  return aInside == bInside && discriminant <= 0.0f ? all : clamp(share, real(0.0f), real(1.0f));
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
