// SPDX-License-Identifier: BSD-3-Clause
#include "HardSceneChecks.h"

#include "RayThickness.h"
#include "SweepThickness.h"

#include <algorithm>
#include <functional>
#include <sstream>

namespace
{
using oracle::Real;
using relief::Light;

bool HasHoles(const Terrain& terrain)
{
  return std::any_of(
    terrain.heights.begin(), terrain.heights.end(), [](double h) { return !std::isfinite(h); });
}

Real SizeOf(const Terrain& terrain)
{
  return std::max(terrain.columns * terrain.spacingX, terrain.rows * terrain.spacingY);
}

// Whether a lamp is so close to a ray's start that their distance is made of the last digits of
// where they are.
bool IsNextTo(const Terrain& terrain, const oracle::Ray& ray)
{
  return ray.length < 1e-6L * SizeOf(terrain);
}

// Whether a sun's rays are traced one by one; then d differs from the swept one by rounding.
bool IsSweptAlone(const HardScene& scene)
{
  return relief::SweepThickness::IsExtreme(
    static_cast<double>(ReliefOf(scene.terrain) + scene.medium.depth));
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
// rounding make them differ, and by more than `positions`, what rounded positions make of d.
std::string Compare(const HardScene& scene, Method method, std::size_t light, int i, int j,
  double expected, double d, Real unit, bool onlyBrighter = false, Real positions = 0)
{
  const Real rounding = RoundingOf(scene, method) + positions;
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
  const Terrain terrain = WithoutInfinities(scene.terrain);
  const HardTracer before(scene);
  const HardTracer after(raised);
  if (!after.GetRefusal().empty())
  {
    return std::string(); // higher than float tells
  }
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
          const int near = scene.medium.offset == relief::f64::RELIEF_VERTICAL ? 0 : 1;
          if (std::abs(si - i) <= near && std::abs(sj - j) <= near)
          {
            return std::string();
          }
          // Ground behind the point tells how it goes on beyond the data.
          const oracle::Ray ray = oracle::RayOf(terrain, scene.medium, scene.lights[light], si, sj);
          const Real sx = scene.terrain.spacingX;
          const Real sy = scene.terrain.spacingY;
          const Real ahead =
            (i - si - ray.x) * sx * ray.stepX * sx + (j - sj - ray.y) * sy * ray.stepY * sy;
          const Real cell = scene.medium.offset == relief::f64::RELIEF_SURFACE_NORMAL
            ? std::hypot(sx, sy)
            : Real(0);
          if (ray.stepZ > 0 && !scene.medium.useFloor && ahead <= cell)
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
            // Double holds a mirrored lamp to the last digit of where it is.
            const Real positions = 16 * EpsilonOf(Method::Reference) * SizeOf(terrain) / ray.length;
            return Compare(scene, method, light, i, j, traced.d[at], opposite.d[place(i, j)],
              UnitOf(scene, method), false, positions);
          });
      });
    if (!wrong.empty())
    {
      return Text("mirror ", mirror, ": ", wrong);
    }
  }
  return std::string();
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
            return same ||
                (!sameBits && IsExplained(scaled, scaled.lights[light], i, j, b.d[at], method))
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
