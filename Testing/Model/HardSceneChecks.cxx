// SPDX-License-Identifier: BSD-3-Clause
#include "HardSceneChecks.h"

#include "PacketThickness.h"
#include "PreparedTerrain.h"
#include "SceneShading.h"
#include "SweepThickness.h"
#include "ThicknessOracle.h"

#include <algorithm>
#include <functional>
#include <sstream>

namespace
{
using oracle::Real;
using relief::Light;

// The relative spacing of the numbers in which a method computes.
Real EpsilonOf(Method method)
{
  return method == Method::Reference ? Real(0x1p-52) : Real(0x1p-23);
}

// How far d may be from that of heights moved: the division t / r, the sum of r, and the few
// operations in a cell that are no error of a height.
Real RoundingOf(const HardScene& scene, Method method)
{
  // At depth 0 the oracle's limit is that of a depth of 1e-10 samples, or of the way to the light.
  const double depth = scene.medium.depth;
  const Real digits =
    depth > 0.0 ? 16 * std::numeric_limits<double>::denorm_min() / Real(depth) : Real(6e-8);
  return 16 * std::max(EpsilonOf(method), digits);
}

Terrain WithoutInfinities(Terrain terrain)
{
  for (double& height : terrain.heights)
  {
    height = std::isinf(height) ? NoData : height;
  }
  return terrain;
}

bool HasHoles(const Terrain& terrain)
{
  return std::any_of(
    terrain.heights.begin(), terrain.heights.end(), [](double h) { return !std::isfinite(h); });
}

// Greatest less least height.
Real ReliefOf(const Terrain& terrain)
{
  Real lo = oracle::Infinity;
  Real hi = -oracle::Infinity;
  for (double height : terrain.heights)
  {
    lo = std::isfinite(height) ? std::min(lo, Real(height)) : lo;
    hi = std::isfinite(height) ? std::max(hi, Real(height)) : hi;
  }
  return hi > lo ? hi - lo : Real(0);
}

Real UnitOf(const HardScene& scene, Method method)
{
  return EpsilonOf(method) * (ReliefOf(scene.terrain) + scene.medium.depth);
}

// The values of d that heights within a distance have.
struct Span
{
  Real lo = oracle::Infinity;
  Real hi = -oracle::Infinity;

  void Add(Real d)
  {
    this->lo = std::min(this->lo, d);
    this->hi = std::max(this->hi, d);
  }
  bool Holds(Real d, Real rounding) const
  {
    return d >= this->lo - rounding && d <= this->hi + rounding;
  }
};

// All of them, and at depth 0, where a shadow's edge is a jump, what they may be on either side.
struct Spans
{
  Span all;
  std::vector<Span> sides;

  bool Hold(Real d, Real rounding) const
  {
    return this->sides.empty() ? this->all.Holds(d, rounding)
                               : std::any_of(this->sides.begin(), this->sides.end(),
                                   [&](const Span& side) { return side.Holds(d, rounding); });
  }
};

// d at the start of a ray; at depth 0 by the definition of the limit, of a depth so small that the
// surface about the sample is flat.
Real IlluminationOf(const HardScene& scene, const Light& light, int i, int j, oracle::Nudge nudge,
  Real epsilon, Real stretch)
{
  const Terrain& terrain = scene.terrain;
  const relief::f64::ReliefMedium& medium = scene.medium;
  oracle::Ray ray = oracle::RayOf(terrain, medium, light, i, j);
  nudge.close = oracle::CloseTo(terrain, ray, epsilon);
  const Real r = oracle::Thickness(terrain, medium, ray, nudge) * (1 + stretch);
  if (medium.depth > 0.0 || std::isinf(r) || ray.length == 0 ||
    medium.attenuation == relief::f64::RELIEF_EXPONENTIAL)
  {
    return std::isinf(r) ? Real(0) : oracle::Illumination(medium, r);
  }
  if (r > 0)
  {
    return 0;
  }
  const Real way = std::min({ ray.length, Real(terrain.spacingX), Real(terrain.spacingY) });
  relief::f64::ReliefMedium sunk = medium;
  sunk.depth = static_cast<double>(1e-10L * way);
  ray = oracle::RayOf(terrain, sunk, light, i, j);
  ray.length = 1e-3L * way;
  return oracle::Illumination(sunk, oracle::Thickness(terrain, sunk, ray, nudge));
}

// What may differ between a computation and the oracle.
struct Slack
{
  Real distance;        ///< heights, and a lamp's and the floor's
  Real epsilon;         ///< relative: how close to the corner of a hole a ray meets it or not
  bool lateral = false; ///< whether the ray moves and turns by epsilon as well
};

Spans SpansOf(const HardScene& scene, const Light& light, int i, int j, const Slack& slack)
{
  HardScene moved = scene;
  moved.terrain = WithoutInfinities(scene.terrain);
  const bool limit = scene.medium.depth == 0.0;
  // A dense material tells r from t to the last digit of either.
  const bool dense = scene.medium.attenuation == relief::f64::RELIEF_EXPONENTIAL;
  const int lifts = slack.distance > 0 ? 1 : 0;
  const int moves = light.positional ? lifts : 0;
  Spans spans;
  for (int tie = -1; tie <= 1; ++tie)
  {
    Span lit;
    Span dark;
    for (int lift = -lifts; lift <= lifts; ++lift)
    {
      Span side; // as a lamp moves, d changes gradually
      for (int move = -moves; move <= moves; ++move)
      {
        for (int lateral = slack.lateral ? 0 : 13; lateral < (slack.lateral ? 27 : 14); ++lateral)
        {
          for (int stretch = dense ? -1 : 0; stretch <= (dense ? 1 : 0); ++stretch)
          {
            Light lamp = light;
            lamp.vector.z += static_cast<double>(move * slack.distance);
            moved.medium.floorHeight =
              static_cast<double>(scene.medium.floorHeight - lift * slack.distance);
            oracle::Nudge nudge;
            nudge.stays = true;
            nudge.raise = lift * slack.distance;
            nudge.tie = tie;
            // Its start by the rounding of the normal, too.
            const Terrain& terrain = moved.terrain;
            const Real depth = moved.medium.depth;
            nudge.x =
              (lateral % 3 - 1) * slack.epsilon * (terrain.columns + depth / terrain.spacingX);
            nudge.y =
              (lateral / 3 % 3 - 1) * slack.epsilon * (terrain.rows + depth / terrain.spacingY);
            nudge.turn = (lateral / 9 - 1) * slack.epsilon;
            const Real d =
              IlluminationOf(moved, lamp, i, j, nudge, slack.epsilon, 8 * stretch * slack.epsilon);
            spans.all.Add(d);
            side.Add(d);
            (d > 0 ? lit : dark).Add(d);
          }
        }
      }
      if (limit)
      {
        spans.sides.push_back(side);
      }
    }
    if (limit)
    {
      spans.sides.push_back(lit);
      spans.sides.push_back(dark);
    }
  }
  return spans;
}

// What rounding may make of d by moving heights by so many units.
Slack SlackOf(const HardScene& scene, Method method, double units)
{
  return { units * UnitOf(scene, method), std::max(units, 1.0) * EpsilonOf(method) };
}

// Whether a lamp is so close to a ray's start that their distance is made of the last digits of
// where they are.
bool IsNextTo(const Terrain& terrain, const oracle::Ray& ray)
{
  return ray.length <
    1e-6L * std::max(terrain.columns * terrain.spacingX, terrain.rows * terrain.spacingY);
}

std::string Describe(Method method, std::size_t light, int i, int j)
{
  std::ostringstream text;
  text.precision(9);
  text << NameOf(method) << ", light " << light << ", sample " << i << ' ' << j << ": ";
  return text.str();
}

template <class... Parts>
std::string Text(const Parts&... parts)
{
  std::ostringstream text;
  text.precision(9);
  (text << ... << parts);
  return text.str();
}

// Calls body(i, j, at) for every sample with data until it returns a text, which is returned.
template <class Body>
std::string ForEachSample(const Terrain& terrain, Body&& body)
{
  for (int j = 0; j < terrain.rows; ++j)
  {
    for (int i = 0; i < terrain.columns; ++i)
    {
      if (std::isfinite(terrain.At(i, j)))
      {
        const std::string wrong = body(i, j, static_cast<std::size_t>(j) * terrain.columns + i);
        if (!wrong.empty())
        {
          return wrong;
        }
      }
    }
  }
  return std::string();
}

// Calls body(method, index of a light) for all that apply until it returns a text.
template <class Body>
std::string ForEachMethod(const HardScene& scene, const HardTracer& tracer, Body&& body)
{
  for (std::size_t k = 0; k < scene.lights.size(); ++k)
  {
    for (Method method : AllMethods)
    {
      if (tracer.Applies(method, scene.lights[k]))
      {
        const std::string wrong = body(method, k);
        if (!wrong.empty())
        {
          return wrong;
        }
      }
    }
  }
  return std::string();
}

// What is wrong with a d where another is expected, if they differ by more than heights moved by
// rounding make them differ.
std::string Compare(const HardScene& scene, Method method, std::size_t light, int i, int j,
  double expected, double d, Real unit, bool onlyBrighter = false)
{
  const Real rounding = RoundingOf(scene, method);
  if (d <= expected + rounding && (onlyBrighter || d >= expected - rounding))
  {
    return std::string();
  }
  const Slack slack = { MostUnits * unit, MostUnits * EpsilonOf(method) };
  const Spans spans = SpansOf(scene, scene.lights[light], i, j, slack);
  if ((onlyBrighter ? d <= spans.all.hi + rounding : spans.Hold(d, rounding)) ||
    IsJump(scene, scene.lights[light], i, j, d, method))
  {
    return std::string();
  }
  return Text(Describe(method, light, i, j), "d = ", d, ", not ", expected,
    onlyBrighter ? " or less, and at most " : "; rounding allows ", spans.all.lo, " to ",
    spans.all.hi);
}
}

const char* NameOf(Method method)
{
  switch (method)
  {
    case Method::Reference:
      return "reference";
    case Method::Rays:
      return "rays";
    case Method::Sweep:
      return "sweep";
    case Method::Packets:
      return "packets";
    default:
      return "scene";
  }
}

HardTracer::HardTracer(const HardScene& scene)
  : Scene(scene)
  , Exact(std::make_unique<Samples<double>>(WithoutInfinities(scene.terrain)))
{
  this->Refusal = Assign(scene.terrain, this->Field);
}

bool HardTracer::Applies(Method method, const Light& light) const
{
  return method != Method::Sweep || relief::SweepThickness::Applies(this->Scene.medium, light);
}

Traced<double> HardTracer::Trace(Method method, const Light& light) const
{
  if (method == Method::Reference)
  {
    return ::Trace<double>(this->Exact->WithoutBounds(), this->Scene.medium, light);
  }

  // The field's heights count from its datum.
  Light lowered = light;
  lowered.vector.z -= light.positional ? this->Field.GetDatum() : 0.0;
  relief::f64::ReliefMedium medium = this->Scene.medium;
  medium.floorHeight -= this->Field.GetDatum();
  const relief::Field<float>& field = this->Field.GetField();
  const int columns = field.heights.columns;
  const int rows = field.heights.rows;
  Traced<double> result;
  result.d.assign(static_cast<std::size_t>(columns) * rows, NoData);
  result.r = result.d;
  auto keep = [&](int i, int j, float d, float r)
  {
    if (i < columns && j < rows && !std::isnan(field.heights.At(i, j)))
    {
      result.d[static_cast<std::size_t>(j) * columns + i] = d;
      result.r[static_cast<std::size_t>(j) * columns + i] = r;
    }
  };

  if (method == Method::Scene)
  {
    relief::Scene whole;
    whole.medium = medium;
    whole.lights = { lowered };
    std::vector<float> d(result.d.size());
    std::vector<float> r(result.r.size());
    relief::Target target;
    target.width = columns;
    target.illumination = d.data();
    target.thickness = medium.tolerance == 0.0 ? r.data() : nullptr; // which is always exact
    relief::SceneShading(this->Field, whole, target).Shade(0, columns, 0, rows);
    for (std::size_t at = 0; at < d.size(); ++at)
    {
      result.d[at] = d[at];
      result.r[at] = r[at];
    }
    return result;
  }
  if (method == Method::Sweep)
  {
    using relief::SweepThickness;
    const SweepThickness sweep(this->Field, medium, lowered);
    for (int row = 0; row * SweepThickness::TileHeight < rows; ++row)
    {
      for (int column = 0; column * SweepThickness::TileWidth < columns; ++column)
      {
        float d[SweepThickness::TileSize];
        float r[SweepThickness::TileSize];
        sweep.IlluminateTile(column, row, d, r, result.count);
        for (int at = 0; at < SweepThickness::TileSize; ++at)
        {
          keep(column * SweepThickness::TileWidth + at % SweepThickness::TileWidth,
            row * SweepThickness::TileHeight + at / SweepThickness::TileWidth, d[at], r[at]);
        }
      }
    }
    return result;
  }
  std::vector<glm::vec3> normals(columns);
  std::vector<float> d(columns);
  std::vector<float> r(columns);
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      normals[i] = relief::f32::reliefNormal(field, i, j);
    }
    relief::RowRequest<float> request;
    request.j = j;
    request.end = columns;
    request.normals =
      medium.offset == relief::f64::RELIEF_SURFACE_NORMAL ? normals.data() : nullptr;
    request.illumination = d.data();
    request.thickness = r.data();
    (method == Method::Rays ? relief::TraceRow<float, float> : relief::TracePackets)(
      field, relief::ToSingle(medium), lowered, request, result.count);
    for (int i = 0; i < columns; ++i)
    {
      keep(i, j, d[i], r[i]);
    }
  }
  return result;
}

std::vector<float> HardTracer::Count(const Light& light, int steps) const
{
  const relief::HeightView<float>& heights = this->Field.GetField().heights;
  relief::Scene whole;
  whole.medium = this->Scene.medium;
  whole.integrator = relief::Integrator::FixedStep;
  whole.steps = steps;
  whole.lights = { light };
  whole.lights[0].vector.z -= light.positional ? this->Field.GetDatum() : 0.0;
  std::vector<float> d(this->Scene.terrain.heights.size());
  relief::Target target;
  target.width = heights.columns;
  target.illumination = d.data();
  relief::SceneShading(this->Field, whole, target).Shade(0, heights.columns, 0, heights.rows);
  return d;
}

double BackwardError(
  const HardScene& scene, const Light& light, int i, int j, double d, Method method, double most)
{
  const Real rounding = RoundingOf(scene, method);
  for (double units = 0.0; units <= most; units = units == 0.0 ? 1.0 : 2.0 * units)
  {
    if (SpansOf(scene, light, i, j, SlackOf(scene, method, units)).Hold(d, rounding))
    {
      return units;
    }
  }
  return Infinite;
}

bool IsJump(const HardScene& scene, const Light& light, int i, int j, double d, Method method)
{
  Slack slack = SlackOf(scene, method, 4.0);
  slack.lateral = true;
  return SpansOf(scene, light, i, j, slack)
    .Hold(d, std::max(RoundingOf(scene, method), 16 * slack.epsilon));
}

std::string CheckRange(const HardScene& scene)
{
  const HardTracer tracer(scene);
  return ForEachMethod(scene, tracer,
    [&](Method method, std::size_t light)
    {
      const Traced<double> traced = tracer.Trace(method, scene.lights[light]);
      for (std::size_t at = 0; at < traced.d.size(); ++at)
      {
        const int i = static_cast<int>(at) % scene.terrain.columns;
        const int j = static_cast<int>(at) / scene.terrain.columns;
        const double d = traced.d[at];
        const double r = traced.r[at];
        if (!std::isfinite(scene.terrain.heights[at]))
        {
          if (!std::isnan(d) || !std::isnan(r))
          {
            return Text(Describe(method, light, i, j), "d = ", d, " where there is no data");
          }
          continue;
        }
        if (!(d >= 0.0 && d <= 1.0 && r >= 0.0))
        {
          return Text(Describe(method, light, i, j), "d = ", d, ", r = ", r);
        }
        const double expected = method == Method::Reference
          ? relief::f64::reliefIllumination(scene.medium, r)
          : relief::f32::reliefIllumination(relief::ToSingle(scene.medium), static_cast<float>(r));
        const double depth =
          method == Method::Reference ? scene.medium.depth : relief::ToSingle(scene.medium).depth;
        const bool contact = depth == 0.0 && r == 0.0;
        if (!contact && std::abs(d - expected) > 4 * EpsilonOf(method))
        {
          return Text(Describe(method, light, i, j), "d = ", d, " at r = ", r, ", not ", expected);
        }
      }
      return std::string();
    });
}

std::string CheckBackwardError(const HardScene& scene, double units, BackwardErrors& found)
{
  const HardTracer tracer(scene);
  return ForEachMethod(scene, tracer,
    [&](Method method, std::size_t light)
    {
      const Traced<double> traced = tracer.Trace(method, scene.lights[light]);
      double& largest = method == Method::Reference ? found.reference : found.single;
      return ForEachSample(scene.terrain,
        [&](int i, int j, std::size_t at)
        {
          const double error =
            BackwardError(scene, scene.lights[light], i, j, traced.d[at], method, units);
          ++found.samples;
          found.moved += error > 0.0 ? 1 : 0;
          found.far += error > 4.0 ? 1 : 0;
          if (error <= units)
          {
            largest = std::max(largest, error);
            return std::string();
          }
          if (IsJump(scene, scene.lights[light], i, j, traced.d[at], method))
          {
            ++found.jumps;
            return std::string();
          }
          const Spans spans = SpansOf(scene, scene.lights[light], i, j, SlackOf(scene, method, 0));
          const Span allowed =
            SpansOf(scene, scene.lights[light], i, j, SlackOf(scene, method, units)).all;
          return Text(Describe(method, light, i, j), "d = ", traced.d[at], " (r = ", traced.r[at],
            "), not ", spans.all.hi, "; rounding allows ", allowed.lo, " to ", allowed.hi);
        });
    });
}

std::string CheckRaisedWall(const HardScene& scene, int i, int j, double height)
{
  HardScene raised = scene;
  double& wall = raised.terrain.At(i, j);
  if (!std::isfinite(wall) || height < wall)
  {
    return std::string();
  }
  wall = height;
  const HardTracer before(scene);
  const HardTracer after(raised);
  if (!after.GetRefusal().empty())
  {
    return std::string(); // higher than float tells
  }
  const bool alongNormal = scene.medium.offset == relief::f64::RELIEF_SURFACE_NORMAL;
  return ForEachMethod(scene, before,
    [&](Method method, std::size_t light)
    {
      const Traced<double> low = before.Trace(method, scene.lights[light]);
      const Traced<double> high = after.Trace(method, scene.lights[light]);
      const Real unit = UnitOf(raised, method);
      return ForEachSample(scene.terrain,
        [&](int si, int sj, std::size_t at)
        {
          // The sample itself goes up with its wall, and normals beside it turn.
          const int near = alongNormal ? 1 : 0;
          if (std::abs(si - i) <= near && std::abs(sj - j) <= near)
          {
            return std::string();
          }
          const std::string wrong =
            Compare(scene, method, light, si, sj, low.d[at], high.d[at], unit, true);
          return wrong.empty() ? wrong
                               : Text("with ", i, ' ', j, " raised to ", height, ": ", wrong);
        });
    });
}

std::string CheckMirrors(const HardScene& scene)
{
  const Terrain& terrain = scene.terrain;
  const double width = (terrain.columns - 1) * terrain.spacingX;
  const double height = (terrain.rows - 1) * terrain.spacingY;
  const bool holes = HasHoles(terrain);
  for (int mirror = 0; mirror < 3; ++mirror)
  {
    HardScene other = scene;
    if (mirror == 2)
    {
      other.terrain = Terrain(terrain.rows, terrain.columns, terrain.spacingY, terrain.spacingX);
    }
    auto place = [&](int i, int j)
    {
      const int oi = mirror == 0 ? terrain.columns - 1 - i : mirror == 1 ? i : j;
      const int oj = mirror == 0 ? j : mirror == 1 ? terrain.rows - 1 - j : i;
      return static_cast<std::size_t>(oj) * other.terrain.columns + oi;
    };
    for (int j = 0; j < terrain.rows; ++j)
    {
      for (int i = 0; i < terrain.columns; ++i)
      {
        other.terrain.heights[place(i, j)] = terrain.At(i, j);
      }
    }
    for (Light& light : other.lights)
    {
      glm::dvec3& v = light.vector;
      if (mirror == 2)
      {
        std::swap(v.x, v.y);
      }
      else
      {
        double& part = mirror == 0 ? v.x : v.y;
        part = (light.positional ? (mirror == 0 ? width : height) : 0.0) - part;
      }
    }
    const HardTracer tracer(scene);
    const HardTracer mirrored(other);
    const std::string wrong = ForEachMethod(scene, tracer,
      [&](Method method, std::size_t light)
      {
        const Traced<double> traced = tracer.Trace(method, scene.lights[light]);
        const Traced<double> opposite = mirrored.Trace(method, other.lights[light]);
        return ForEachSample(terrain,
          [&](int i, int j, std::size_t at)
          {
            // A ray along a grid line belongs to the cell after it, and a mirror makes that the one
            // before.
            const oracle::Ray ray = oracle::RayOf(terrain, scene.medium, scene.lights[light], i, j);
            const Real along = 1e-6L / std::max(terrain.spacingX, terrain.spacingY);
            if (IsNextTo(scene.terrain, ray))
            {
              return std::string();
            }
            if (holes && (std::abs(ray.stepX) < along || std::abs(ray.stepY) < along))
            {
              return std::string();
            }
            return Compare(scene, method, light, i, j, traced.d[at], opposite.d[place(i, j)],
              UnitOf(scene, method));
          });
      });
    if (!wrong.empty())
    {
      return Text("mirror ", mirror, ": ", wrong);
    }
  }
  return std::string();
}

// Whether a sun's rays are traced one by one; then its d differs from the swept one by rounding.
static bool IsSweptAlone(const HardScene& scene)
{
  return relief::SweepThickness::IsExtreme(
    static_cast<double>(ReliefOf(scene.terrain) + scene.medium.depth));
}

static bool IsExplained(
  const HardScene& scene, std::size_t light, int i, int j, double d, Method method)
{
  return BackwardError(scene, scene.lights[light], i, j, d, method, MostUnits) <= MostUnits ||
    IsJump(scene, scene.lights[light], i, j, d, method);
}

std::string CheckScaling(const HardScene& scene)
{
  if (scene.medium.depth > 0.0 && scene.medium.depth < 1e-25)
  {
    return std::string(); // scaled down, float does not hold all its bits
  }
  for (double scale : { 0x1p-12, 0x1p9 })
  {
    HardScene scaled = scene;
    scaled.terrain.spacingX *= scale;
    scaled.terrain.spacingY *= scale;
    for (double& h : scaled.terrain.heights)
    {
      h *= scale;
    }
    scaled.medium.depth *= scale;
    scaled.medium.density /= scale;
    scaled.medium.floorHeight *= scale;
    for (Light& light : scaled.lights)
    {
      light.vector *= light.positional ? scale : 1.0;
    }
    const HardTracer before(scene);
    const HardTracer after(scaled);
    const bool otherWay = IsSweptAlone(scene) != IsSweptAlone(scaled);
    const std::string wrong = ForEachMethod(scene, before,
      [&](Method method, std::size_t light)
      {
        const Traced<double> a = before.Trace(method, scene.lights[light]);
        const Traced<double> b = after.Trace(method, scaled.lights[light]);
        const bool sameBits = !otherWay || (method != Method::Sweep && method != Method::Scene);
        return ForEachSample(scene.terrain,
          [&](int i, int j, std::size_t at)
          {
            const bool same = a.d[at] == b.d[at] && a.r[at] * scale == b.r[at];
            return same || (!sameBits && IsExplained(scaled, light, i, j, b.d[at], method))
              ? std::string()
              : Text(Describe(method, light, i, j), "times ", scale, ": d = ", b.d[at], ", not ",
                  a.d[at], "; r = ", b.r[at], ", not ", a.r[at] * scale);
          });
      });
    if (!wrong.empty())
    {
      return wrong;
    }
  }
  return std::string();
}

std::string CheckNudges(const HardScene& scene)
{
  const HardTracer tracer(scene);
  return ForEachMethod(scene, tracer,
    [&](Method method, std::size_t index)
    {
      const Light& light = scene.lights[index];
      const Traced<double> traced = tracer.Trace(method, light);
      const double epsilon = static_cast<double>(EpsilonOf(method));
      const Real unit = UnitOf(scene, method);
      for (int nudge = 0; nudge < 8; ++nudge)
      {
        HardScene other = scene;
        const double sign = nudge % 2 == 0 ? -1.0 : 1.0;
        double* parts[] = { &other.lights[index].vector.x, &other.lights[index].vector.y,
          &other.lights[index].vector.z, &other.medium.depth };
        double& part = *parts[nudge / 2];
        // Lamps move by a unit of the field: how large their coordinates are does not matter.
        const Terrain& terrain = scene.terrain;
        const double sizes[] = { terrain.columns * terrain.spacingX,
          terrain.rows * terrain.spacingY, static_cast<double>(unit) / epsilon };
        part += sign * epsilon * (light.positional && nudge < 6 ? sizes[nudge / 2] : part);
        const HardTracer nudged(other);
        if (!nudged.Applies(method, other.lights[index]))
        {
          continue;
        }
        const Traced<double> near = nudged.Trace(method, other.lights[index]);
        const std::string wrong = ForEachSample(scene.terrain,
          [&](int i, int j, std::size_t at)
          {
            if (IsNextTo(scene.terrain, oracle::RayOf(scene.terrain, scene.medium, light, i, j)))
            {
              return std::string();
            }
            // Where the model itself jumps, d does as the nudged scene's.
            const std::string jump =
              Compare(scene, method, index, i, j, traced.d[at], near.d[at], unit);
            return jump.empty() ||
                Compare(other, method, index, i, j, Infinite, near.d[at], unit).empty()
              ? std::string()
              : jump;
          });
        if (!wrong.empty())
        {
          return Text("nudge ", nudge, ": ", wrong);
        }
      }
      return std::string();
    });
}

std::string CheckTolerance(const HardScene& scene, double tolerance)
{
  HardScene coarse = scene;
  coarse.medium.tolerance = tolerance;
  const HardTracer exact(scene);
  const HardTracer tracer(coarse);
  return ForEachMethod(scene, exact,
    [&](Method method, std::size_t light)
    {
      const Traced<double> a = exact.Trace(method, scene.lights[light]);
      const Traced<double> b = tracer.Trace(method, scene.lights[light]);
      return ForEachSample(scene.terrain,
        [&](int i, int j, std::size_t at)
        {
          if (std::abs(a.d[at] - b.d[at]) <= tolerance + RoundingOf(scene, method))
          {
            return std::string();
          }
          const std::string wrong = Compare(scene, method, light, i, j, a.d[at],
            b.d[at] + std::copysign(tolerance, a.d[at] - b.d[at]), UnitOf(scene, method));
          return wrong.empty() ? wrong : Text("tolerance ", tolerance, ": ", wrong);
        });
    });
}

std::string CheckFixedSteps(const HardScene& scene, int steps)
{
  const Terrain terrain = WithoutInfinities(scene.terrain);
  const HardTracer tracer(scene);
  for (std::size_t index = 0; index < scene.lights.size(); ++index)
  {
    const std::vector<float> d = tracer.Count(scene.lights[index], steps);
    // A sun stands on the field's bounding sphere.
    Light light = scene.lights[index];
    if (!light.positional)
    {
      Real lo = oracle::Infinity;
      for (double h : terrain.heights)
      {
        lo = h < lo ? Real(h) : lo;
      }
      const Real size[3] = { (terrain.columns - 1) * terrain.spacingX,
        (terrain.rows - 1) * terrain.spacingY, ReliefOf(terrain) };
      const Real radius = std::sqrt(size[0] * size[0] + size[1] * size[1] + size[2] * size[2]) / 2;
      light.positional = true;
      light.vector = { static_cast<double>(size[0] / 2 + radius * light.vector.x),
        static_cast<double>(size[1] / 2 + radius * light.vector.y),
        static_cast<double>(lo + size[2] / 2 + radius * light.vector.z) };
    }
    const std::string wrong = ForEachSample(terrain,
      [&](int i, int j, std::size_t at)
      {
        const oracle::Ray ray = oracle::RayOf(terrain, scene.medium, light, i, j);
        const Real epsilon = 16 * EpsilonOf(Method::Scene);
        const Real scale = ReliefOf(terrain) + scene.medium.depth;
        const Real smallest = 1e-31L; // a depth of which float takes the limit
        int least = 0;
        int most = 0;
        for (int k = 0; k <= steps; ++k)
        {
          const Real s = ray.length * k / steps;
          const Real x = ray.x + s * ray.stepX;
          const Real y = ray.y + s * ray.stepY;
          const Real z = ray.z + s * ray.stepZ; // above the sample, as h
          // Below, above or within rounding, of every sample that rounding may take for the
          // nearest.
          int below = 0;
          int candidates = 0;
          int unsure = 0;
          const Real near = epsilon *
            (std::abs(ray.x) + std::abs(ray.y) + s * (std::abs(ray.stepX) + std::abs(ray.stepY)) +
              1);
          for (int corner = 0; corner < 4; ++corner)
          {
            const Real nx = std::floor(x + (corner % 2 == 0 ? -near : near) + Real(0.5));
            const Real ny = std::floor(y + (corner / 2 == 0 ? -near : near) + Real(0.5));
            ++candidates;
            unsure += near > 0.25L ? 1 : 0;
            if (nx < -i || ny < -j || nx > terrain.columns - 1 - i || ny > terrain.rows - 1 - j)
            {
              continue;
            }
            const Real h =
              terrain.At(i + static_cast<int>(nx), j + static_cast<int>(ny)) - ray.base;
            unsure += std::abs(z - h) <=
                epsilon * (std::abs(ray.z) + std::abs(s * ray.stepZ) + scale) + smallest
              ? 1
              : 0;
            below += z < h ? 1 : 0;
          }
          least += below == candidates && unsure == 0 ? 1 : 0;
          most += below > 0 || unsure > 0 ? 1 : 0;
        }
        const double epsilonOfD = static_cast<double>(EpsilonOf(Method::Scene));
        return d[at] <= 1.0 / (1.0 + least) + epsilonOfD && d[at] >= 1.0 / (1.0 + most) - epsilonOfD
          ? std::string()
          : Text("fixed steps, light ", index, ", sample ", i, ' ', j, ": d = ", d[at],
              " where between ", least, " and ", most, " points are below");
      });
    if (!wrong.empty())
    {
      return wrong;
    }
  }
  return std::string();
}
