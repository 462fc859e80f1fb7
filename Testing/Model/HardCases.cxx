// SPDX-License-Identifier: BSD-3-Clause
#include "HardCases.h"

#include "ReliefModel.h"

#include <algorithm>
#include <cfloat>
#include <utility>

namespace
{
using relief::Light;
using relief::f64::RELIEF_EXPONENTIAL;
using relief::f64::RELIEF_RECIPROCAL;
using relief::f64::RELIEF_SURFACE_NORMAL;
using relief::f64::RELIEF_TANGENT_PLANE;
using relief::f64::RELIEF_VERTICAL;
using relief::f64::ReliefMedium;

// Eighths, which float holds.
Terrain Rough(int columns = 9, int rows = 7, double scale = 1.0)
{
  Terrain terrain(columns, rows);
  terrain.Fill(
    [scale](double x, double y) {
      return scale * std::round(8.0 * (std::sin(1.3 * x + 0.4 * y) + std::cos(0.7 * y * x))) / 8.0;
    });
  return terrain;
}

Terrain Plane(int slopeX, int slopeY)
{
  Terrain terrain(9, 7);
  terrain.Fill([=](double x, double y) { return slopeX * x + slopeY * y; });
  return terrain;
}

Terrain Level(int columns = 9, int rows = 7, double height = 0.0)
{
  Terrain terrain(columns, rows);
  terrain.Fill([height](double, double) { return height; });
  return terrain;
}

template <class HasData>
Terrain Pierced(Terrain terrain, HasData&& hasData)
{
  for (int j = 0; j < terrain.rows; ++j)
  {
    for (int i = 0; i < terrain.columns; ++i)
    {
      terrain.At(i, j) = hasData(i, j) ? terrain.At(i, j) : NoData;
    }
  }
  return terrain;
}

Terrain Spaced(Terrain terrain, double spacingX, double spacingY)
{
  terrain.spacingX = spacingX;
  terrain.spacingY = spacingY;
  return terrain;
}

Terrain With(Terrain terrain, int i, int j, double height)
{
  terrain.At(i, j) = height;
  return terrain;
}

ReliefMedium Dense(double density)
{
  ReliefMedium medium = Sunk(0.5);
  medium.attenuation = RELIEF_EXPONENTIAL;
  medium.density = density;
  return medium;
}

// The angle whose tangent is a slope, in degrees.
double Climb(double slope)
{
  return std::atan(slope) * 180.0 / Pi;
}

// A unit in the last place beside an angle.
double Beside(double angle)
{
  return std::nextafter(angle, 1e3);
}

std::function<double(int, int)> Everywhere(double d)
{
  return [d](int, int) { return d; };
}

std::vector<Light> Suns(const std::vector<double>& azimuths, double altitude)
{
  std::vector<Light> suns;
  for (double azimuth : azimuths)
  {
    suns.push_back(Sun(azimuth, altitude));
  }
  return suns;
}

std::vector<HardCase> MakeCases()
{
  const std::vector<double> axes = { 0.0, 90.0, 180.0, 270.0 };
  const std::vector<double> diagonals = { 45.0, 135.0, 225.0, 315.0 };
  std::vector<double> besideAxes;
  std::vector<double> besideDiagonals;
  for (int k = 0; k < 4; ++k)
  {
    besideAxes.insert(besideAxes.end(), { Beside(axes[k]), std::nextafter(axes[k], -1e3) });
    besideDiagonals.insert(
      besideDiagonals.end(), { Beside(diagonals[k]), std::nextafter(diagonals[k], -1e3) });
  }
  const Terrain rough = Rough();
  const double h = rough.At(4, 3);
  const ReliefMedium t = Sunk(1.0);
  const ReliefMedium half = Sunk(0.5);
  const ReliefMedium normal = Sunk(0.5, RELIEF_SURFACE_NORMAL);
  std::vector<HardCase> cases;
  auto add = [&cases](const char* name, const char* hard, Terrain terrain, ReliefMedium medium,
               std::vector<Light> lights, std::function<double(int, int)> known = nullptr)
  {
    cases.push_back(
      { name, hard, { std::move(terrain), medium, std::move(lights) }, std::move(known) });
  };

  // Where the light is.
  add("LampAtSamples", "lamps exactly at a sample, at its sunken point, above, below and beside it",
    rough, half,
    { Lamp(4, 3, h), Lamp(4, 3, h - 0.5), Lamp(4, 3, h + 1), Lamp(4, 3, h - 1), Lamp(3, 3, h),
      Lamp(4, 2, h - 0.5), Lamp(4.5, 3.5, h) });
  add("LampAtSamplesAlongNormals", "the same, points sunk along the normal", rough, normal,
    { Lamp(4, 3, h), Lamp(4, 3, h - 0.5), Lamp(4, 3, h + 1), Lamp(4, 3, h - 1), Lamp(3, 3, h) });
  add("LampsAtDepthZero", "lamps on the surface: whether their rays touch it is rounding's", rough,
    Sunk(0.0),
    { Lamp(4, 3, h), Lamp(1, 1, rough.At(1, 1)), Lamp(0, 0, rough.At(0, 0)), Lamp(4, 3, h + 1e-6),
      Lamp(4 + 1e-6, 3, h + 1e-7) });
  add("LampOnLevelGround", "a lamp at the height of the surface: all rays are level", Level(), t,
    { Lamp(4, 3, 0), Lamp(-5, 3, 0), Lamp(4.5, 3.25, 0) });
  add("LampOnAPlane", "a lamp in the plane of the surface, at depth 0: every ray runs along it",
    Plane(1, -2), Sunk(0.0), { Lamp(20, 10, 0), Lamp(4, 3, -2), Lamp(-7, -3, -1) });
  add("LampOnAGable", "lamps on a gable, from under its eaves and along its ridge",
    With(Plane(0, 0), 4, 3, 2.0), Sunk(0.0), { Lamp(4, 3, 2), Lamp(4, -3, 2), Lamp(4, 6, 2) });
  add("FarLamps", "lamps 1e9 samples away", rough, half,
    { Lamp(1e9, 0, 1e9), Lamp(0, 1e9, 1e3), Lamp(-1e9, -1e9, 1e9), Lamp(4, 3, 1e9),
      Lamp(4, 3, -1e9) });
  add("NearLamps", "lamps 1e-6 samples from a sample and from its sunken point", rough, half,
    { Lamp(4 + 1e-6, 3, h), Lamp(4, 3 - 1e-6, h), Lamp(4, 3, h + 1e-6),
      Lamp(4 + 1e-6, 3 + 1e-6, h - 0.5), Lamp(4, 3, h - 0.5 + 1e-6) });

  // Directions.
  add("AlongAxes", "rays along grid lines, the first and the last among them", rough, half,
    Suns(axes, 20.0));
  add("BesideAxes", "a unit in the last place off the axes", rough, half, Suns(besideAxes, 20.0));
  add("AlongDiagonals", "rays through grid points", rough, half, Suns(diagonals, 20.0));
  add("BesideDiagonals", "a unit in the last place off the diagonals", rough, half,
    Suns(besideDiagonals, 20.0));
  add("AlongAxesWithHoles", "rays along grid lines and diagonals beside holes",
    Pierced(rough, [](int i, int j) { return (3 * i + 5 * j) % 7 != 0; }), half,
    { Sun(0, 15), Sun(90, 15), Sun(45, 15), Sun(315, 15), Sun(Beside(45), 15) });
  add("Horizon", "altitude 0: rays are level and may never end", rough, half, Suns(axes, 0.0));
  add("AboveTheHorizon", "altitude 1e-6: rays end 1e8 samples away", rough, half,
    { Sun(100, 1e-6), Sun(0, 1e-6), Sun(315, 1e-6) });
  add("BelowTheHorizon", "altitude -1e-6: nothing ends a ray", rough, half,
    { Sun(100, -1e-6), Sun(0, -1e-6), Sun(180, -90) }, Everywhere(0.0));
  add("Zenith", "altitude 90: a ray never leaves its cell", rough, half, { Sun(77, 90) },
    Everywhere(1.0));
  add("LevelGroundFlatSun", "d is the sine of the altitude, however small", Level(), t,
    { Sun(33, 0.01) }, Everywhere(std::sin(0.01 * Pi / 180.0)));

  // Rays along the surface.
  add("CoplanarRays", "whole numbers and a sun at 45 degrees: rays run along the surface",
    With(With(Plane(1, 0), 4, 3, 6.0), 6, 2, 3.0), t,
    { Sun(90, 45), Sun(270, 45), Sun(0, 45), Sun(45, 45) });
  add("CoplanarSteps", "steps of whole numbers, tread and riser along the ray", Level(), t,
    { Sun(90, 45), Sun(270, 45), Sun(90, Climb(0.5)), Sun(90, Climb(2.0)) });
  for (int j = 0; j < 7; ++j)
  {
    for (int i = 0; i < 9; ++i)
    {
      cases.back().scene.terrain.At(i, j) = (i * i + 3 * j) % 4;
    }
  }
  add("CoplanarPlaneDepthZero", "a whole plane seen edge-on", Plane(1, 0), Sunk(0.0),
    { Sun(90, 45), Sun(90, Beside(45)), Sun(90, std::nextafter(45, 0)) });
  add("GrazedPlane", "a sun a millionth of a degree above a plane", Plane(1, 0), Sunk(0.25),
    { Sun(90, 45 + 1e-6), Sun(90, 45 - 1e-6), Sun(90, 45) });
  add("TouchedPeaks", "a ray that touches a peak in one point, at depth 0",
    With(With(Level(), 6, 3, 2.0), 2, 3, 4.0), Sunk(0.0),
    { Sun(90, 45), Sun(270, 45), Sun(90, Climb(1.0 / 3.0)), Sun(90, Climb(0.5)) });

  // Sizes.
  add("OneSample", "nothing but a sample", Level(1, 1, 5.0), t, { Sun(200, 30), Lamp(0, 0, 9) });
  add("OneRow", "a row: no cell", Rough(9, 1), t, { Sun(90, 30), Sun(0, 30), Lamp(4, 0, 3) });
  add("OneColumn", "a column: no cell", Rough(1, 7), normal, { Sun(90, 30), Lamp(0, 3, 3) });
  add("TwoByTwo", "one cell", Rough(2, 2), half, { Sun(45, 20), Sun(90, 20), Lamp(0.5, 0.5, 1) });
  add("Constant", "a level field high above 0", Level(9, 7, 8848.0), t, { Sun(111, 30) },
    Everywhere(std::sin(30.0 * Pi / 180.0)));

  // Reliefs.
  add("Relief1e-6", "hardly any relief", Rough(9, 7, 1e-6), t, { Sun(111, 30), Sun(45, 1e-4) });
  add("Relief1e6", "relief of 1e6 per sample", Rough(9, 7, 1e6), t,
    { Sun(111, 30), Lamp(4, 3, 3e6) });
  add("Relief1e30", "relief of which the square is no number in float", Rough(9, 7, 0x1p100),
    Sunk(0x1p99), { Sun(111, 30), Sun(45, 89), Lamp(4, 3, 0x1p102) });
  add("Relief1e-30", "relief of which the square is 0 in float",
    Spaced(Rough(9, 7, 0x1p-100), 0x1p-100, 0x1p-100), Sunk(0x1p-101),
    { Sun(111, 30), Sun(45, 20), Lamp(0x1p-98, 0x1p-98, 0x1p-98) });
  add("NearTheLargestFloat", "heights near the largest float, of a relief that float tells",
    With(Level(9, 7, -FLT_MAX), 4, 3, -FLT_MAX * 0.9999), Sunk(0x1p100), { Sun(111, 30) });
  cases.push_back({ "FromEndToEndOfFloat", "heights of which the difference is no float",
    { With(Level(9, 7, FLT_MAX), 4, 3, -FLT_MAX), t, { Sun(111, 30) } }, nullptr, "2.12676e+37" });
  cases.push_back({ "UndeclaredNoData", "the lowest float where the file means no data",
    { With(rough, 4, 3, -FLT_MAX), t, { Sun(111, 30) } }, nullptr, "no data" });
  add("Denormal", "heights that float only just holds", Rough(9, 7, 1e-42), t, { Sun(111, 30) },
    Everywhere(std::sin(30.0 * Pi / 180.0)));
  add("Infinite", "infinite heights are none", With(With(rough, 4, 3, Infinite), 2, 2, -Infinite),
    half, { Sun(111, 30), Lamp(4, 3, 3) });
  add("DoubleDigits", "a millimetre's relief at 1e9: float holds 64 there", Level(9, 7), Sunk(1e-3),
    { Sun(111, 30), Lamp(4, 3, 1e9 + 0.01) });
  for (int k = 0; k < 63; ++k)
  {
    cases.back().scene.terrain.heights[k] = 1e9 + std::ldexp((k * 7) % 5, -10);
  }
  cases.back().scene.terrain.spacingX = cases.back().scene.terrain.spacingY = 1e-3;

  // Points sunk along the normal, a hair's breadth from where the ray crosses a line of the grid.
  Terrain crest(3, 3, 59.0, 160.0);
  crest.heights = { 0.0, 0.0, 0.0, 246.0, 241.0, 536.0, 0.0, 0.0, 0.0 };
  add("CrestSkimmed", "a ray past its own sample, by a millionth of what the next ones are higher",
    crest, Sunk(0.0006, RELIEF_SURFACE_NORMAL),
    { Lamp(-454, 182, 299), Lamp(-454, 138, 299), Lamp(572, 182, 299) });
  Terrain saddle(3, 3);
  saddle.heights = { 0.0, 4.0, 0.0, 3.0, 2.0, 5.0, 0.0, 4.0, 0.0 };
  add("AlongNormalAndSurface", "a ray back through its own sample and on along the surface", saddle,
    Sunk(1e-6, RELIEF_SURFACE_NORMAL), { Sun(-90, 45), Sun(-90, 44.9) });

  // Where rounding takes a ray through a cell whose corner it passes.
  Terrain corners(3, 2, 238.7755161343693, 238.7755161343693);
  corners.heights = { 0.0, 0.0, 4988451.5, 0.0, 4988451.5, 0.0 };
  add("BowOfNothing",
    "a cell that is crossed by a rounding error, bent so little that its square vanishes", corners,
    Sunk(0.0), { Sun(-45, 0) });

  Terrain corner(2, 2);
  corner.heights = { 0.0, 0.0, 1.0, 0.0 };
  ReliefMedium clear = Dense(1.0);
  clear.depth = 0.0;
  add("CrossingsThatMeet", "a ray that touches the surface where it starts, or where it ends",
    corner, clear, { Lamp(0, 1, 0), Lamp(1, 0, 0) });

  // Spacings.
  add("Spacing1To1000", "a sample a thousand times as long as wide", Spaced(rough, 1.0, 1000.0),
    half, { Sun(111, 30), Sun(45, 30), Sun(0, 1), Lamp(4, 3000, 3) });
  add("Spacing1000To1", "and as wide as long", Spaced(rough, 1000.0, 1.0), normal,
    { Sun(111, 30), Sun(45, 30), Sun(90, 1), Lamp(4000, 3, 3) });
  add("SpacingOfATenth", "a spacing that binary numbers do not hold", Spaced(rough, 0.1, 0.1),
    Sunk(0.1), { Sun(45, 30), Lamp(0.3, 0.6, 3), Lamp(0.8, 0.6, 1) });

  // Depths.
  add("DepthZero", "t = 0 is the limit", rough, Sunk(0.0),
    { Sun(111, 30), Sun(45, 30), Lamp(4, 3, 5) });
  add("DepthZeroAlongNormals", "t = 0 is the limit", rough, Sunk(0.0, RELIEF_SURFACE_NORMAL),
    { Sun(111, 30), Sun(45, 30), Lamp(4, 3, 5) });
  add("DepthZeroBelowTangentPlanes", "t = 0 is the limit", rough, Sunk(0.0, RELIEF_TANGENT_PLANE),
    { Sun(111, 30), Sun(45, 30), Lamp(4, 3, 5) });
  add("DepthDenormal", "t that float does not hold", rough, Sunk(1e-310),
    { Sun(111, 30), Sun(45, 30) });
  add("DepthBeyondTheRelief", "t larger than all relief", rough, Sunk(1e6),
    { Sun(111, 30), Lamp(4, 3, 5) });
  add("DepthBeyondTheLight", "t larger than the way to the light", rough, Sunk(10.0),
    { Lamp(4, 3, 5), Lamp(4, 3, -5) });
  add("DensityZero", "a material that lets everything through", rough, Dense(0.0), { Sun(111, 30) },
    Everywhere(1.0));
  add("Density1e30", "a material that lets nothing through", rough, Dense(1e30),
    { Sun(111, 30), Sun(0, 90), Lamp(4, 3, 3) });
  ReliefMedium opaque = Dense(5e29);
  opaque.depth = 1.0;
  opaque.offset = RELIEF_SURFACE_NORMAL;
  Terrain steps(5, 3);
  steps.heights = { 0, 0, 0, -34.280296325683594, 0, 0, -36, -35.280296325683594,
    -34.280296325683594, -35.280296325683594, 0, 0, 0, -34.280296325683594, 0 };
  add("OpaqueAtTheDepth", "a ray that has run inside for just t, where d falls from 1 to 0", steps,
    opaque, { Lamp(0, 1, -35.280296325683594) });

  // Holes.
  add("Checkerboard", "no cell has all its corners: level ground",
    Pierced(rough, [](int i, int j) { return (i + j) % 2 == 0; }), t, { Sun(111, 30) },
    Everywhere(std::sin(30.0 * Pi / 180.0)));
  add("OneValid", "one sample with data",
    Pierced(rough, [](int i, int j) { return i == 4 && j == 3; }), normal, { Sun(111, 30) },
    Everywhere(std::sin(30.0 * Pi / 180.0)));
  add("BorderOnly", "data on the border only",
    Pierced(rough, [](int i, int j) { return i == 0 || j == 0 || i == 8 || j == 6; }), half,
    { Sun(111, 30), Sun(45, 20), Lamp(4, 3, 5) });
  add("RingAroundAPeak", "a ring without data around a peak",
    Pierced(With(rough, 4, 3, 9.0),
      [](int i, int j) { return std::max(std::abs(i - 4), std::abs(j - 3)) != 1; }),
    half, { Sun(111, 30), Sun(45, 20), Lamp(4, 3, 9) });

  // Floors.
  add("FloorAboveTheSurface", "no material at all", rough, WithFloor(half, 3.0),
    { Sun(111, 30), Sun(111, -30), Lamp(4, 3, -8) }, Everywhere(1.0));
  add("FloorAtSamples", "a floor at the height of samples and of sunken points", rough,
    WithFloor(half, h), { Sun(111, 30), Sun(45, -30), Sun(0, 0), Lamp(4, 3, h - 2) });
  add("FloorAtDepthZero", "a floor where rays begin", Level(), WithFloor(Sunk(0.0), 0.0),
    { Sun(111, 30) }, Everywhere(1.0));
  add("FloorNextToDepthZero", "a floor next to where rays begin", Level(),
    WithFloor(Sunk(0.0), -3e-11), { Lamp(4, 3, 5), Sun(111, 30) });
  add("FloorAtTheStart", "a floor as deep as rays begin, in cells that rise far above that",
    With(Level(), 1, 1, 0.002), WithFloor(Sunk(1e-6, RELIEF_TANGENT_PLANE), -1e-6),
    { Sun(165, 75), Sun(345, 75), Sun(75, 30) });
  return cases;
}

}

const std::vector<HardCase>& HardCases()
{
  static const std::vector<HardCase> cases = MakeCases();
  return cases;
}
