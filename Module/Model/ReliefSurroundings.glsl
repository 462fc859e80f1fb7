// SPDX-License-Identifier: BSD-3-Clause
//
// Where data end: the way of a ray through the cells, and how the ground goes on where a ray leaves the
// data for good. The fourth of the model's five texts, in the dialect of ReliefModel.glsl. It follows
// ReliefSurface.glsl, and asks each host for bounds of the heights:
//   int reliefLevels(field)                        levels of bounds, 0 for none
//   void reliefBounds(field, level, i, j, lo, hi)  bounds of a block of RELIEF_BLOCK << level cells:
//                                                  lo > hi where every cell is a hole, and
//                                                  (-infinity, infinity) where some are

// Cells along a side of the smallest block that has bounds, as a power of two.
const int RELIEF_BLOCK_SHIFT = 2;

// Of its length from the start, what a ray must run in a cell for more than touching it.
const real RELIEF_TOUCH = 1.0e-6f;

// A ray from the sunken point p' to a light. It starts (x, y) samples away from sample (i, j), sink
// below the height base of that sample, and runs for end units of length.
struct ReliefRay
{
  int i;
  int j;
  real x;
  real y;
  real base;
  real sink;
  real dx; // samples along x per unit of length
  real dy;
  real dz; // rise per unit of length
  real end;
};

// Cells of one kind, with data or holes, that follow one another on a line.
struct ReliefRun
{
  real first; // lengths along the line where they begin and end
  real last;
  int firstI; // the cells there
  int firstJ;
  int lastI;
  int lastJ;
  bool stopped; // by a cell of the other kind
};

//-------------------------------------------------------------------------------------------------
// The way through the cells

// The cell along one axis that a ray at x enters.
RELIEF_FN int reliefCellAhead(real x, real dx, int index, int cells)
{
  // A point sunk far outside the image may lie further away than an int counts.
  real line = reliefLineAhead(x, dx, real(cells - index));
  return index + int(clamp(line, real(-1.0e9f), real(1.0e9f)));
}

// Where a ray that starts outside the image, in cell (ci, cj), crosses the border that it meets last: the
// cell (ei, ej) behind it, the axis whose line the border is, and how far it is, 0 where the ray runs
// away from it. The cell is in the image if the ray enters it.
RELIEF_FN real reliefEntry(ReliefRay ray, int columns, int rows, int ci, int cj, RELIEF_OUT(int) ei,
  RELIEF_OUT(int) ej, RELIEF_OUT(int) axis)
{
  real inverseX = ray.dx == 0.0f ? real(0.0f) : real(1.0f) / ray.dx;
  real inverseY = ray.dy == 0.0f ? real(0.0f) : real(1.0f) / ray.dy;
  real entryX = ci < 0 && ray.dx > 0.0f ? (-real(ray.i) - ray.x) * inverseX
    : ci >= columns && ray.dx < 0.0f    ? (real(columns - ray.i) - ray.x) * inverseX
                                        : real(0.0f);
  real entryY = cj < 0 && ray.dy > 0.0f ? (-real(ray.j) - ray.y) * inverseY
    : cj >= rows && ray.dy < 0.0f       ? (real(rows - ray.j) - ray.y) * inverseY
                                        : real(0.0f);
  real entry = max(entryX, entryY);
  // Where it enters, it has crossed the other border it came from before: at a corner of the image
  // rounding must not tell otherwise.
  ei = ci;
  ej = cj;
  axis = 0;
  if (entryX >= entryY && entryX > 0.0f)
  {
    ei = ci < 0 ? 0 : columns - 1;
    ej = reliefCellAhead(ray.y + ray.dy * entry, ray.dy, ray.j, rows);
    ej = entryY > 0.0f ? clamp(ej, 0, rows - 1) : ej;
  }
  else if (entryY > 0.0f)
  {
    axis = 1;
    ej = cj < 0 ? 0 : rows - 1;
    ei = reliefCellAhead(ray.x + ray.dx * entry, ray.dx, ray.i, columns);
    ei = entryX > 0.0f ? clamp(ei, 0, columns - 1) : ei;
  }
  return entry;
}

// The cell of a block through which a ray leaves it at length s: along the line that it crosses the cell
// follows from the position, and rounding must not take it out of the block.
RELIEF_FN void reliefLeaveBlock(ReliefRay ray, bool throughX, int shift, int columns, int rows, real s,
  RELIEF_INOUT(int) ci, RELIEF_INOUT(int) cj)
{
  if (throughX)
  {
    int first = (cj >> shift) << shift;
    int cell = reliefCellAhead(ray.y + ray.dy * s, ray.dy, ray.j, rows);
    cj = clamp(cell, first, min(first + (1 << shift), rows) - 1);
  }
  else
  {
    int first = (ci >> shift) << shift;
    int cell = reliefCellAhead(ray.x + ray.dx * s, ray.dx, ray.i, columns);
    ci = clamp(cell, first, min(first + (1 << shift), columns) - 1);
  }
}

// Whether a ray runs along the west or the south side of cells that begin at sample (i, j).
RELIEF_FN bool reliefAlongSide(ReliefRay ray, int i, int j)
{
  return (ray.dx == 0.0f && ray.x == real(i - ray.i)) || (ray.dy == 0.0f && ray.y == real(j - ray.j));
}

// Heights above base of the corners of a cell, some of them no number where it is a hole. A ray along the
// grid line between a hole and a cell with data runs over the latter, of which it meets the samples on
// the line only.
RELIEF_FIELD_FN void reliefCorners(RELIEF_FIELD field, ReliefRay ray, int ci, int cj,
  RELIEF_OUT(real) h00, RELIEF_OUT(real) h10, RELIEF_OUT(real) h01, RELIEF_OUT(real) h11)
{
  h00 = reliefHeight(field, ci, cj) - ray.base;
  h10 = reliefHeight(field, ci + 1, cj) - ray.base;
  h01 = reliefHeight(field, ci, cj + 1) - ray.base;
  h11 = reliefHeight(field, ci + 1, cj + 1) - ray.base;
  if (!isnan((h11 - h10) - (h01 - h00)) || !reliefAlongSide(ray, ci, cj))
  {
    return;
  }
  if (ray.dy == 0.0f && cj > 0 &&
    !isnan(reliefHeight(field, ci, cj - 1) - reliefHeight(field, ci + 1, cj - 1)))
  {
    h01 = h00;
    h11 = h10;
  }
  else if (ray.dx == 0.0f && ci > 0 &&
    !isnan(reliefHeight(field, ci - 1, cj) - reliefHeight(field, ci - 1, cj + 1)))
  {
    h10 = h00;
    h11 = h01;
  }
}

// The line of a ray from its place at length s on, the same way or back. There it has crossed a grid line
// of this axis, unless it is its start.
RELIEF_FIELD_FN ReliefRay reliefLineFrom(RELIEF_FIELD field, ReliefRay ray, real s, int axis, bool back)
{
  ReliefRay line = ray;
  line.x = ray.x + ray.dx * s;
  line.y = ray.y + ray.dy * s;
  if (s > 0.0f)
  {
    line.x = axis == 0 ? floor(line.x + 0.5f) : line.x;
    line.y = axis == 1 ? floor(line.y + 0.5f) : line.y;
    // At a corner of the image rounding must not take it out.
    line.x = clamp(line.x, -real(ray.i), real(reliefColumns(field) - 1 - ray.i));
    line.y = clamp(line.y, -real(ray.j), real(reliefRows(field) - 1 - ray.j));
  }
  line.dx = back ? -ray.dx : ray.dx;
  line.dy = back ? -ray.dy : ray.dy;
  return line;
}

// The cells with data, or else the holes, that a line from a place at length s of its ray runs over
// first, over a length of `reach` at most, none from outside the image. Cells of the other kind that it
// only touches do not count.
RELIEF_FIELD_FN ReliefRun reliefRunOver(
  RELIEF_FIELD field, ReliefRay line, real s, bool data, real reach)
{
  int columns = reliefColumns(field) - 1;
  int rows = reliefRows(field) - 1;
  int ci = reliefCellAhead(line.x, line.dx, line.i, columns);
  int cj = reliefCellAhead(line.y, line.dy, line.j, rows);
  real u = 0.0f;
  bool outside = ci < 0 || ci >= columns || cj < 0 || cj >= rows;
  ReliefRun run;
  run.first = u;
  run.last = u;
  run.firstI = ci;
  run.firstJ = cj;
  run.lastI = ci;
  run.lastJ = cj;
  run.stopped = false;

  real inverseX = line.dx == 0.0f ? real(0.0f) : real(1.0f) / line.dx;
  real inverseY = line.dy == 0.0f ? real(0.0f) : real(1.0f) / line.dy;
  bool none = true;
  int levels = reliefLevels(field);
  int level = levels;
  while (!outside && u < reach)
  {
    // The largest block whose cells are all of one kind.
    int shift = level > 0 ? RELIEF_BLOCK_SHIFT + level - 1 : 0;
    int bi = ci >> shift;
    int bj = cj >> shift;
    int nextI = min((bi + 1) << shift, columns);
    int nextJ = min((bj + 1) << shift, rows);
    int lineX = line.dx < 0.0f ? bi << shift : nextI;
    int lineY = line.dy < 0.0f ? bj << shift : nextJ;
    real exitX = line.dx == 0.0f ? RELIEF_INFINITY : (real(lineX - line.i) - line.x) * inverseX;
    real exitY = line.dy == 0.0f ? RELIEF_INFINITY : (real(lineY - line.j) - line.y) * inverseY;
    bool throughX = exitX <= exitY;
    real u1 = max(throughX ? exitX : exitY, u);
    bool hole;
    if (level > 0)
    {
      real lo;
      real hi;
      reliefBounds(field, level - 1, bi, bj, lo, hi);
      hole = lo > hi;
      if ((hole && reliefAlongSide(line, bi << shift, bj << shift)) ||
        (!hole && !(lo > -RELIEF_INFINITY)))
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
      reliefCorners(field, line, ci, cj, h00, h10, h01, h11);
      hole = isnan((h11 - h10) - (h01 - h00));
    }
    if (hole != data)
    {
      run.firstI = none ? ci : run.firstI;
      run.firstJ = none ? cj : run.firstJ;
      run.first = none ? u : run.first;
      none = false;
      run.last = min(u1, reach);
      run.lastI = clamp(line.i + int(floor(line.x + line.dx * run.last)), bi << shift, nextI - 1);
      run.lastJ = clamp(line.j + int(floor(line.y + line.dy * run.last)), bj << shift, nextJ - 1);
    }
    else if (u1 - u > RELIEF_TOUCH * (s + u1))
    {
      run.stopped = true;
      return run;
    }

    // Step into the cell ahead, and go up where a block of the next level begins.
    u = u1;
    int previousI = ci;
    int previousJ = cj;
    if (level > 0)
    {
      reliefLeaveBlock(line, throughX, shift, columns, rows, u, ci, cj);
    }
    ci = throughX ? lineX - (line.dx < 0.0f ? 1 : 0) : ci;
    cj = throughX ? cj : lineY - (line.dy < 0.0f ? 1 : 0);
    outside = ci < 0 || ci >= columns || cj < 0 || cj >= rows;
    int above = RELIEF_BLOCK_SHIFT + level;
    if (level < levels && (ci >> above != previousI >> above || cj >> above != previousJ >> above))
    {
      ++level;
    }
  }
  return run;
}

//-------------------------------------------------------------------------------------------------
// Beyond the data

// Whether a ray that leaves the data at length s, through a grid line of this axis, meets none before it
// is out of the image.
RELIEF_FIELD_FN bool reliefNeverReturns(RELIEF_FIELD field, ReliefRay ray, real s, int axis)
{
  if (ray.dx == 0.0f && ray.dy == 0.0f)
  {
    return true;
  }
  ReliefRay line = reliefLineFrom(field, ray, s, axis, false);
  return !reliefRunOver(field, line, s, false, RELIEF_INFINITY).stopped;
}

// Height above base of the surface at length u of a line, in cell (ci, cj).
RELIEF_FIELD_FN real reliefHeightIn(RELIEF_FIELD field, ReliefRay line, int ci, int cj, real u)
{
  real h00;
  real h10;
  real h01;
  real h11;
  reliefCorners(field, line, ci, cj, h00, h10, h01, h11);
  real x = line.x + line.dx * u;
  real south = reliefBetween(x, real(ci - line.i), h00, h10);
  real north = reliefBetween(x, real(ci - line.i), h01, h11);
  return reliefBetween(line.y + line.dy * u, real(cj - line.j), south, north);
}

// How much the ground rises per unit of a ray that leaves the data at length s: the mean of what lies
// behind on its line, back to its start and further if that is near.
RELIEF_FIELD_FN real reliefRiseBehind(
  RELIEF_FIELD field, ReliefMedium medium, ReliefRay ray, real s, int axis)
{
  real lx = ray.dx * reliefSpacingX(field);
  real ly = ray.dy * reliefSpacingY(field);
  real across = sqrt(lx * lx + ly * ly);
  if (across == 0.0f || reliefColumns(field) < 2 || reliefRows(field) < 2)
  {
    return 0.0f;
  }
  real cell = min(reliefSpacingX(field), reliefSpacingY(field)) / across;
  real way = ray.dz > 0.0f ? medium.depth / ray.dz : RELIEF_INFINITY;
  ReliefRay line = reliefLineFrom(field, ray, s, axis, true);
  ReliefRun run = reliefRunOver(field, line, s, true, max(s, max(cell, way)));
  // Data that do not reach back to the ray's start say nothing of the ground there: a wall in front of it
  // would count as one behind.
  bool outside = ray.x < -real(ray.i) || ray.x > real(reliefColumns(field) - 1 - ray.i) ||
    ray.y < -real(ray.j) || ray.y > real(reliefRows(field) - 1 - ray.j);
  if (outside || (run.stopped && s - run.last > RELIEF_TOUCH * s))
  {
    return 0.0f;
  }
  real size = run.last - run.first;
  if (size > RELIEF_TOUCH * (s + run.last))
  {
    return (reliefHeightIn(field, line, run.firstI, run.firstJ, run.first) -
             reliefHeightIn(field, line, run.lastI, run.lastJ, run.last)) /
      size;
  }
  // Nothing, where the line touches but a corner: a sample, whose tangent plane goes on. Elsewhere it is a
  // hole's, and level.
  real nearX = clamp(floor(line.x + 0.5f), -real(ray.i), real(reliefColumns(field) - 1 - ray.i));
  real nearY = clamp(floor(line.y + 0.5f), -real(ray.j), real(reliefRows(field) - 1 - ray.j));
  bool elsewhere = s > 0.0f ? max(abs(line.x - nearX), abs(line.y - nearY)) > 1.0e-3f
                            : ray.x != 0.0f || ray.y != 0.0f;
  if (elsewhere)
  {
    return 0.0f;
  }
  int i = ray.i + int(nearX);
  int j = ray.j + int(nearY);
  if (isnan(reliefHeight(field, i, j)))
  {
    return 0.0f;
  }
  real gx;
  real gy;
  reliefSlopes(field, i, j, gx, gy);
  return gx * lx + gy * ly;
}

// The inside length of a ray from where it leaves the data for good at length s, `above` below their
// surface: the ground goes on as it came, but no more than half as steep as the ray.
RELIEF_FIELD_FN real reliefBeyond(
  RELIEF_FIELD field, ReliefMedium medium, ReliefRay ray, real s, int axis, real above)
{
  real fall = ray.dz - min(reliefRiseBehind(field, medium, ray, s, axis), ray.dz / 2.0f);
  return fall > 0.0f ? min(above / fall, ray.end - s) : ray.end - s;
}

// Whether the ground goes on beyond the data for a ray: it does for one that rises, without a floor.
RELIEF_FN bool reliefGoesOn(ReliefMedium medium, ReliefRay ray)
{
  return ray.dz > 0.0f && !medium.useFloor;
}
