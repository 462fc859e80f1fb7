// SPDX-License-Identifier: BSD-3-Clause
//
// How much of a ray runs inside the height field: the last of the model's five texts, in the dialect of
// ReliefModel.glsl. It follows ReliefSurroundings.glsl, and asks each host for one thing more:
//   real reliefTop(field)                          no height lies above it

// What rounding makes of the height of a ray above its start, relative to it: a ray that is no further
// from the surface runs along it. That is not inside, or a few units in the last place would decide anew
// at every sample. By twice as much of its length a ray ends before its light, so that one on the surface
// lights.
const real RELIEF_ROUNDING = 4.0f * RELIEF_EPSILON;

// What a trace found: at least `thickness` of the ray runs inside the material, and at most `rest`
// more (0 unless the tolerance ended the trace early).
struct ReliefTrace
{
  real thickness;
  real rest;
  int cells; // cells and blocks visited
};

//-------------------------------------------------------------------------------------------------
// Thickness: the length of a ray inside the material (section 3.2.1)

// Height above base at a ray's start: bilinear at the position clamped to the image, over the corners
// that have data; the start sample's own where none has.
RELIEF_FIELD_FN real reliefStartHeight(RELIEF_FIELD field, ReliefRay ray)
{
  if (ray.x == 0.0f && ray.y == 0.0f)
  {
    return 0.0f;
  }
  real x = clamp(ray.x, -real(ray.i), real(reliefColumns(field) - 1 - ray.i));
  real y = clamp(ray.y, -real(ray.j), real(reliefRows(field) - 1 - ray.j));
  int ci = clamp(ray.i + int(floor(x)), 0, max(reliefColumns(field) - 2, 0));
  int cj = clamp(ray.j + int(floor(y)), 0, max(reliefRows(field) - 2, 0));
  // Both weights by their own subtraction: the small one beside the sample keeps its digits.
  real west = real(ci + 1 - ray.i) - x;
  real east = x - real(ci - ray.i);
  real south = real(cj + 1 - ray.j) - y;
  real north = y - real(cj - ray.j);
  real sum = 0.0f;
  real weights = 0.0f;
  for (int corner = 0; corner < 4; ++corner)
  {
    int di = corner & 1;
    int dj = corner >> 1;
    real weight = (di == 1 ? east : west) * (dj == 1 ? north : south);
    if (weight > 0.0f)
    {
      real height = reliefHeight(field, ci + di, cj + dj) - ray.base;
      if (!isnan(height))
      {
        sum += weight * height;
        weights += weight;
      }
    }
  }
  return weights > 0.0f ? sum / weights : real(0.0f);
}

// Height at length s of a ray that crosses there a grid line between two samples: for axis 0 a line of
// constant x between the rows j and j + 1, for axis 1 one of constant y between the columns i and i + 1.
RELIEF_FN real reliefEdgeHeight(ReliefRay ray, int axis, int i, int j, real s, real first, real second)
{
  real place = axis == 0 ? ray.y + ray.dy * s : ray.x + ray.dx * s;
  int line = axis == 0 ? j - ray.j : i - ray.i;
  return reliefBetween(place, real(line), first, second);
}

// What rounding makes of a ray's height at length s.
RELIEF_FN real reliefMargin(ReliefRay ray, real s)
{
  return RELIEF_ROUNDING * (s * abs(ray.dz) + ray.sink);
}

// How far ground at a height above base lies above a ray at length s; 0 where rounding may say so.
RELIEF_FN real reliefAbove(ReliefRay ray, real ground, real s)
{
  real above = ground - (s * ray.dz - ray.sink);
  return abs(above) <= reliefMargin(ray, s) ? real(0.0f) : above;
}

// Whether the error of d is within the tolerance, however much of `rest` is inside.
RELIEF_FN bool reliefSettled(ReliefMedium medium, real thickness, real rest)
{
  return reliefIllumination(medium, thickness) - reliefIllumination(medium, thickness + rest) <=
    2.0f * medium.tolerance;
}

// Whether a ray runs down into bottomless material for ever.
RELIEF_FN bool reliefEndless(ReliefMedium medium, ReliefRay ray)
{
  return ray.dz < 0.0f && !medium.useFloor && ray.end >= RELIEF_INFINITY;
}

// Height above base at which a ray leaves cell (ci, cj) through the line at lineX or lineY.
RELIEF_FIELD_FN real reliefHeightAtExit(RELIEF_FIELD field, ReliefRay ray, bool throughX, int lineX,
  int lineY, int ci, int cj, real s)
{
  int i = throughX ? lineX : ci;
  int j = throughX ? cj : lineY;
  real first = reliefHeight(field, i, j) - ray.base;
  real second = reliefHeight(field, throughX ? i : i + 1, throughX ? j + 1 : j) - ray.base;
  return reliefEdgeHeight(ray, throughX ? 0 : 1, i, j, s, first, second);
}

// The inside length of a ray between s0 and s1, as far as it is in [from, to], under one patch, whose
// corners' heights above base are given. The ray is at height `ground` at s0, and then at s1.
RELIEF_FN real reliefCellLength(ReliefRay ray, int ci, int cj, bool throughX, real s0, real s1, real h00,
  real h10, real h01, real h11, real from, real to, RELIEF_INOUT(real) ground)
{
  bool near = throughX ? ray.dx < 0.0f : ray.dy < 0.0f;
  real next = throughX ? reliefEdgeHeight(ray, 0, ci, cj, s1, near ? h00 : h10, near ? h01 : h11)
                       : reliefEdgeHeight(ray, 1, ci, cj, s1, near ? h00 : h01, near ? h10 : h11);
  real twist = (h11 - h10) - (h01 - h00);
  real bend = twist * (ray.dx * (s1 - s0)) * (ray.dy * (s1 - s0));
  // A bow no deeper than rounding, a quarter of it, is none.
  bend = abs(bend) <= 4.0f * reliefMargin(ray, s1) ? real(0.0f) : bend;
  real above = reliefAbove(ray, ground, s0);
  ground = next;
  return reliefPatchLength(s0, s1, above, reliefAbove(ray, next, s1), bend, from, to);
}

// How much of a ray at length s can still be inside. The ground beyond the data may make twice of what
// the surface makes.
RELIEF_FN real reliefRest(ReliefMedium medium, ReliefRay ray, real s, real from, real to)
{
  real rest = to - max(s, from);
  return reliefGoesOn(medium, ray) ? min(2.0f * rest, ray.end - s) : rest;
}

// Sums the closed-form inside length cell by cell, blocks that lie wholly above or below the ray at
// once. Across holes the surface is held level.
RELIEF_FIELD_FN ReliefTrace reliefTrace(RELIEF_FIELD field, ReliefMedium medium, ReliefRay ray)
{
  ReliefTrace result;
  result.thickness = 0.0f;
  result.rest = 0.0f;
  result.cells = 0;

  ray.end -= ray.end < RELIEF_INFINITY ? 2.0f * RELIEF_ROUNDING * ray.end : real(0.0f);
  if (reliefEndless(medium, ray))
  {
    result.thickness = RELIEF_INFINITY;
    return result;
  }
  real from;
  real to;
  reliefStretch(medium.useFloor, medium.floorHeight, reliefTop(field), ray.base, ray.sink, ray.dz,
    ray.end, from, to);

  int columns = reliefColumns(field) - 1; // cells along x
  int rows = reliefRows(field) - 1;
  int ci = reliefCellAhead(ray.x, ray.dx, ray.i, columns);
  int cj = reliefCellAhead(ray.y, ray.dy, ray.j, rows);
  real inverseX = ray.dx == 0.0f ? real(0.0f) : real(1.0f) / ray.dx;
  real inverseY = ray.dy == 0.0f ? real(0.0f) : real(1.0f) / ray.dy;

  real s = 0.0f;
  real ground = reliefStartHeight(field, ray); // height above base at s: the surface's or the held one
  bool onSurface = true;                       // which of the two
  int axis = 0;                                // the axis whose grid line was crossed last
  real left = 0.0f; // while it is held: where the data ended, through which axis, and the length till then
  int leftAxis = 0;
  real kept = 0.0f;

  // A ray from outside runs under the held level until it meets the image, if it does.
  bool outside = ci < 0 || ci >= columns || cj < 0 || cj >= rows;
  if (outside && columns > 0 && rows > 0)
  {
    int ei;
    int ej;
    real entry = reliefEntry(ray, columns, rows, ci, cj, ei, ej, axis);
    if (entry > 0.0f && ei >= 0 && ei < columns && ej >= 0 && ej < rows)
    {
      ci = ei;
      cj = ej;
      outside = false;
      result.thickness += reliefLevelLength(from, min(entry, to), reliefAbove(ray, ground, 0.0f), ray.dz);
      s = entry;
      onSurface = false;
    }
  }

  int levels = reliefLevels(field);
  int level = levels > 0 ? 1 : 0; // 0: cells, else blocks of level - 1
  while (!outside && s < to)
  {
    real rest = reliefRest(medium, ray, s, from, to);
    bool open = !onSurface && reliefAbove(ray, ground, left) > 0.0f; // what lies beyond is not known
    if (medium.tolerance > 0.0f && !open && reliefSettled(medium, result.thickness, rest))
    {
      result.rest = rest;
      return result;
    }
    ++result.cells;

    int shift = level > 0 ? RELIEF_BLOCK_SHIFT + level - 1 : 0;
    int bi = ci >> shift;
    int bj = cj >> shift;
    int lineX = ray.dx < 0.0f ? bi << shift : min((bi + 1) << shift, columns);
    int lineY = ray.dy < 0.0f ? bj << shift : min((bj + 1) << shift, rows);
    real exitX = ray.dx == 0.0f ? RELIEF_INFINITY : (real(lineX - ray.i) - ray.x) * inverseX;
    real exitY = ray.dy == 0.0f ? RELIEF_INFINITY : (real(lineY - ray.j) - ray.y) * inverseY;
    bool throughX = exitX <= exitY;
    real s1 = max(throughX ? exitX : exitY, s);
    // A ray through a grid point only touches the cells beside it, whichever of them rounding takes it
    // through: they do not end a hole.
    bool holds = !onSurface && s1 - s <= RELIEF_TOUCH * s1;

    if (level > 0)
    {
      real lo;
      real hi;
      reliefBounds(field, level - 1, bi, bj, lo, hi);
      real z0 = s * ray.dz - ray.sink;
      real z1 = min(s1, to) * ray.dz - ray.sink;
      bool under = max(z0, z1) + reliefMargin(ray, min(s1, to)) < lo - ray.base;
      bool hole = lo > hi;
      if (hole && reliefAlongSide(ray, bi << shift, bj << shift))
      {
        --level;
        continue;
      }
      if (hole || holds)
      {
        if (onSurface)
        {
          left = s;
          leftAxis = axis;
          kept = result.thickness;
        }
        result.thickness +=
          reliefLevelLength(max(s, from), min(s1, to), reliefAbove(ray, ground, 0.0f), ray.dz);
        onSurface = false;
      }
      else if (min(z0, z1) > hi - ray.base || under)
      {
        if (under)
        {
          result.thickness += max(min(s1, to) - max(s, from), real(0.0f));
        }
        onSurface = true;
      }
      else
      {
        --level;
        continue;
      }
    }
    else
    {
      real h00;
      real h10;
      real h01;
      real h11;
      reliefCorners(field, ray, ci, cj, h00, h10, h01, h11);
      real twist = (h11 - h10) - (h01 - h00);
      if (isnan(twist) || holds)
      {
        if (onSurface)
        {
          left = s;
          leftAxis = axis;
          kept = result.thickness;
        }
        result.thickness +=
          reliefLevelLength(max(s, from), min(s1, to), reliefAbove(ray, ground, 0.0f), ray.dz);
        onSurface = false;
      }
      else
      {
        if (!onSurface)
        {
          bool far = axis == 0 ? ray.dx < 0.0f : ray.dy < 0.0f;
          ground = axis == 0
            ? reliefEdgeHeight(ray, 0, ci, cj, s, far ? h10 : h00, far ? h11 : h01)
            : reliefEdgeHeight(ray, 1, ci, cj, s, far ? h01 : h00, far ? h11 : h10);
        }
        onSurface = true;
        if (s1 >= RELIEF_INFINITY)
        {
          // A vertical ray never leaves its cell.
          result.thickness += reliefLevelLength(from, to, reliefAbove(ray, ground, 0.0f), ray.dz);
        }
        else
        {
          result.thickness +=
            reliefCellLength(ray, ci, cj, throughX, s, s1, h00, h10, h01, h11, from, to, ground);
        }
      }
    }

    // Step into the cell ahead.
    s = s1;
    if (s >= to)
    {
      break;
    }
    axis = throughX ? 0 : 1;
    int previousI = ci;
    int previousJ = cj;
    if (level > 0)
    {
      reliefLeaveBlock(ray, throughX, shift, columns, rows, s, ci, cj);
      ground = onSurface ? reliefHeightAtExit(field, ray, throughX, lineX, lineY, ci, cj, s) : ground;
    }
    if (throughX)
    {
      ci = lineX - (ray.dx < 0.0f ? 1 : 0);
    }
    else
    {
      cj = lineY - (ray.dy < 0.0f ? 1 : 0);
    }
    outside = ci < 0 || ci >= columns || cj < 0 || cj >= rows;

    // Go up only where a block of the next level begins: the one left has been looked at already.
    int above = RELIEF_BLOCK_SHIFT + level;
    if (level < levels && (ci >> above != previousI >> above || cj >> above != previousJ >> above))
    {
      ++level;
    }
  }

  if (outside && onSurface)
  {
    left = s;
    leftAxis = axis;
    kept = result.thickness;
    onSurface = false;
  }
  if (s < to)
  {
    result.thickness += reliefLevelLength(max(s, from), to, reliefAbove(ray, ground, 0.0f), ray.dz);
  }
  real above = reliefAbove(ray, ground, left);
  if (!onSurface && above > 0.0f && reliefGoesOn(medium, ray) &&
    reliefNeverReturns(field, ray, left, leftAxis))
  {
    result.thickness = kept + reliefBeyond(field, medium, ray, left, leftAxis, above);
  }
  return result;
}

// A ray from the point sunk below sample (i, j), whose normal is n, to a light. `light` is the unit
// vector toward a directional light, or the position of a positional one relative to sample (i, j).
// The unit vector toward the light comes back in l.
RELIEF_FIELD_FN ReliefRay reliefRay(RELIEF_FIELD field, ReliefMedium medium, int i, int j, real3 n,
  real3 light, bool positional, RELIEF_OUT(real3) l)
{
  ReliefRay ray;
  ray.i = i;
  ray.j = j;
  ray.base = reliefHeight(field, i, j);
  bool sunkAlongNormal = medium.offset == RELIEF_SURFACE_NORMAL;
  real3 offset = sunkAlongNormal ? medium.depth * n : real3(0.0f, 0.0f, reliefSink(field, medium, i, j));
  ray.x = -offset.x / reliefSpacingX(field);
  ray.y = -offset.y / reliefSpacingY(field);
  ray.sink = offset.z;
  ray.end = RELIEF_INFINITY;
  l = light;
  if (positional)
  {
    real3 toLight = light + offset;
    reliefToward(toLight.x, toLight.y, toLight.z, l.x, l.y, l.z, ray.end);
  }
  ray.dx = reliefAlong(l.x, reliefSpacingX(field));
  ray.dy = reliefAlong(l.y, reliefSpacingY(field));
  ray.dz = l.z;
  return ray;
}

//-------------------------------------------------------------------------------------------------
// Depth 0

// The slopes of the plane in one of the four quadrants about a ray's sample. Returns whether there is none:
// outside the image and in a hole.
RELIEF_FIELD_FN bool reliefQuadrant(
  RELIEF_FIELD field, ReliefRay ray, int di, int dj, RELIEF_OUT(real) gx, RELIEF_OUT(real) gy)
{
  int i1 = ray.i + di;
  int j1 = ray.j + dj;
  real none = RELIEF_NAN;
  bool hasColumn = i1 >= 0 && i1 < reliefColumns(field);
  bool hasRow = j1 >= 0 && j1 < reliefRows(field);
  real hx = hasColumn ? reliefHeight(field, i1, ray.j) - ray.base : none;
  real hy = hasRow ? reliefHeight(field, ray.i, j1) - ray.base : none;
  gx = isnan(hx) ? real(0.0f) : hx / (real(di) * reliefSpacingX(field));
  gy = isnan(hy) ? real(0.0f) : hy / (real(dj) * reliefSpacingY(field));
  return isnan(hx + hy) || isnan(reliefHeight(field, i1, j1));
}

// The limit of d for t -> 0 at an unshadowed sample. The ray then stays so near that the surface is
// four planes that meet at the sample; r / t is the inside length of a ray from depth 1 below them.
RELIEF_FIELD_FN real reliefContact(RELIEF_FIELD field, ReliefMedium medium, ReliefRay ray, real3 n, real3 l)
{
  ReliefMedium unit = medium;
  unit.depth = 1.0f;
  real3 start = medium.offset == RELIEF_SURFACE_NORMAL
    ? -n
    : real3(0.0f, 0.0f, -reliefSink(field, unit, ray.i, ray.j));
  real lx = ray.dx * reliefSpacingX(field); // l without what is rounding
  real ly = ray.dy * reliefSpacingY(field);
  bool atLight = !(ray.end > 0.0f); // straight above the point, in the sample
  real from = 0.0f;
  if (medium.useFloor && medium.floorHeight >= ray.base)
  {
    // The floor lies above all that is near, or as high as the sample.
    if (atLight || medium.floorHeight > ray.base || l.z <= 0.0f)
    {
      return 1.0f;
    }
    from = -start.z / l.z;
  }
  if (atLight)
  {
    return medium.offset == RELIEF_SURFACE_NORMAL ? real(1.0f) : real(-1.0f) / start.z;
  }
  real crossX = lx != 0.0f ? -start.x / lx : real(0.0f);
  real crossY = ly != 0.0f ? -start.y / ly : real(0.0f);
  real first = max(min(crossX, crossY), real(0.0f));
  real second = max(max(crossX, crossY), real(0.0f));

  real thickness = 0.0f;
  real s = 0.0f;
  bool sideways = start.x != 0.0f || start.y != 0.0f;
  bool atStart = true;
  bool held = false;
  bool beside = false;   // whether the ray starts beside the data
  real behind = 0.0f;    // how much the last plane rose along the ray
  real leftAbove = 0.0f; // while it is held: its height above the ray where that began
  real kept = 0.0f;      // and the thickness till there
  real ground = 0.0f;    // surface or held level at s
  for (int piece = 0; piece < 3; ++piece)
  {
    bool last = piece == 2;
    real s1 = piece == 0 ? first : second;
    if (!last && !(s1 - s > RELIEF_TOUCH * s1))
    {
      continue; // not there, or only touched
    }
    // A point inside the piece says over which of the four planes it runs.
    real middle = last ? s + 1.0f : (s + s1) / 2.0f;
    // A ray along a grid line runs over the cell after it, along the last line over the last cell.
    real x = start.x + middle * lx;
    real y = start.y + middle * ly;
    int di = x < 0.0f || (x == 0.0f && ray.i == reliefColumns(field) - 1) ? -1 : 1;
    int dj = y < 0.0f || (y == 0.0f && ray.j == reliefRows(field) - 1) ? -1 : 1;
    real gx;
    real gy;
    bool level = reliefQuadrant(field, ray, di, dj, gx, gy);
    // Along a grid line over the cell on the other side, if that has data.
    real otherX;
    real otherY;
    if (level && y == 0.0f && !reliefQuadrant(field, ray, di, -dj, otherX, otherY))
    {
      level = false;
      gx = otherX;
    }
    else if (level && x == 0.0f && !reliefQuadrant(field, ray, -di, dj, otherX, otherY))
    {
      level = false;
      gy = otherY;
    }
    // Outside the image and in a hole the surface is held as high as it was, at the start as high as
    // the corners that have data make it.
    if (atStart || !level)
    {
      ground = gx * (start.x + s * lx) + gy * (start.y + s * ly);
    }
    bool begins = atStart;
    atStart = false;
    real climb = level ? real(0.0f) : gx * lx + gy * ly;
    // The plane's height above the ray is linear along it: value and rate at this piece's start.
    real above = ground - (start.z + s * l.z);
    real rate = climb - l.z;
    if (level && !held)
    {
      if (begins)
      {
        // A start on the border has data behind it.
        beside = sideways &&
          reliefQuadrant(field, ray, start.x < 0.0f || (start.x == 0.0f && lx > 0.0f) ? -1 : 1,
            start.y < 0.0f || (start.y == 0.0f && ly > 0.0f) ? -1 : 1, gx, gy);
        behind = gx * lx + gy * ly;
      }
      leftAbove = above;
      kept = thickness;
    }
    behind = level ? behind : climb;
    held = level;
    if (last && level && !beside && leftAbove > 0.0f && reliefGoesOn(medium, ray) &&
      reliefNeverReturns(field, ray, 0.0f, 0))
    {
      // Beyond the data the ground goes on as it came.
      bool bare = sideways &&
        reliefQuadrant(field, ray, lx > 0.0f || (lx == 0.0f && start.x < 0.0f) ? -1 : 1,
          ly > 0.0f || (ly == 0.0f && start.y < 0.0f) ? -1 : 1, gx, gy);
      real rise = bare ? behind : reliefRiseBehind(field, medium, ray, 0.0f, 0);
      real fall = l.z - min(rise, l.z / 2.0f);
      if (!(fall > 0.0f))
      {
        return 0.0f;
      }
      thickness = kept + leftAbove / fall;
    }
    else if (last)
    {
      if (rate > 0.0f || (rate == 0.0f && above > 0.0f))
      {
        return 0.0f;
      }
      real end = above > 0.0f ? s + above / -rate : s;
      thickness += max(end - max(from, s), real(0.0f));
    }
    else
    {
      thickness +=
        reliefPatchLength(s, s1, above, above + rate * (s1 - s), real(0.0f), from, RELIEF_INFINITY);
      ground += climb * (s1 - s);
      s = s1;
    }
  }
  return thickness > 1.0f ? real(1.0f) / thickness : real(1.0f);
}

//-------------------------------------------------------------------------------------------------
// The two integrators

// d at the start of a ray that has been traced, but for the limit at depth 0.
RELIEF_FN real reliefMeasured(ReliefMedium medium, ReliefTrace trace)
{
  real d = reliefIllumination(medium, trace.thickness);
  if (trace.rest > 0.0f)
  {
    return (d + reliefIllumination(medium, trace.thickness + trace.rest)) / 2.0f;
  }
  return d;
}

// d at the start of a ray that has been traced.
RELIEF_FIELD_FN real reliefTraced(
  RELIEF_FIELD field, ReliefMedium medium, ReliefRay ray, real3 n, real3 l, ReliefTrace trace)
{
  if (!(trace.rest > 0.0f) && medium.depth == 0.0f && medium.attenuation == RELIEF_RECIPROCAL &&
    trace.thickness == 0.0f)
  {
    return reliefContact(field, medium, ray, n, l);
  }
  return reliefMeasured(medium, trace);
}

// d at the start of a ray, exactly or within the tolerance.
RELIEF_FIELD_FN real reliefExact(
  RELIEF_FIELD field, ReliefMedium medium, ReliefRay ray, real3 n, real3 l, RELIEF_OUT(ReliefTrace) trace)
{
  trace = reliefTrace(field, medium, ray);
  return reliefTraced(field, medium, ray, n, l, trace);
}

// n of Algorithm 1 (section 4.3.1): how many of the steps + 1 points from the start to the light stand
// below the surface at their nearest sample.
RELIEF_FIELD_FN int reliefStepCount(RELIEF_FIELD field, ReliefRay ray, int steps)
{
  int count = 0;
  for (int k = 0; k <= steps; ++k)
  {
    real s = ray.end * (real(k) / real(steps));
    real x = floor(ray.x + s * ray.dx + 0.5f);
    real y = floor(ray.y + s * ray.dy + 0.5f);
    // Compared as real numbers: a far light's position does not fit into an int.
    if (x >= -real(ray.i) && x < real(reliefColumns(field) - ray.i) && y >= -real(ray.j) &&
      y < real(reliefRows(field) - ray.j) &&
      s * ray.dz - ray.sink < reliefHeight(field, ray.i + int(x), ray.j + int(y)) - ray.base)
    {
      ++count;
    }
  }
  return count;
}
