// SPDX-License-Identifier: BSD-3-Clause
#include "Growth.h"

#include "BenchmarkTerrain.h"
#include "Curves.h"
#include "Integrators.h"
#include "Timing.h"

#include <cmath>
#include <memory>

namespace bench
{

namespace
{
// Small fields are pieces along the diagonal of a larger one, so that all sizes see the same
// ground.
constexpr int GroundSize = 2048;

struct Fields
{
  int size;
  std::vector<std::unique_ptr<relief::HeightField>> pieces;
};

Fields MakeFields(int size)
{
  Fields fields;
  fields.size = size;
  const int count = size < GroundSize ? GroundSize / size : 1;
  for (int k = 0; k < count; ++k)
  {
    fields.pieces.push_back(Prepare(Terrain(size, size, TerrainSpacing, k * size)));
  }
  return fields;
}
}

std::vector<GrowthPoint> MeasureGrowth(int first, int last, int repetitions)
{
  const relief::Light sun = Sun(CurveAzimuth, GrowthAltitude);
  std::vector<Fields> sizes;
  for (int size = first; size <= last; size *= 2)
  {
    sizes.push_back(MakeFields(size));
  }
  std::vector<float> d(static_cast<std::size_t>(last) * last);
  std::vector<double> exact(1 << 20);

  std::vector<GrowthPoint> points;
  std::vector<Rival> rivals;
  auto add = [&](const std::string& name, const Fields& fields, double samples,
               const std::function<void(const relief::HeightField&)>& run)
  {
    points.push_back({ name, fields.size, 0.0 });
    Rival rival;
    rival.samples = samples * static_cast<double>(fields.pieces.size());
    rival.run = [&fields, run]
    {
      for (const auto& piece : fields.pieces)
      {
        run(*piece);
      }
    };
    rivals.push_back(rival);
  };
  for (const Fields& fields : sizes)
  {
    const double samples = static_cast<double>(fields.size) * fields.size;
    add(ExactMarked, fields, samples,
      [&](const relief::HeightField& field)
      { RunSweep(field, Medium(field, MarkedTolerance), sun, d.data()); });
    add("exact, tolerance 0", fields, samples,
      [&](const relief::HeightField& field)
      { RunSweep(field, Medium(field, 0.0), sun, d.data()); });

    const relief::HeightField& one = *fields.pieces.front();
    const Probe reference = SpreadProbe(one, 32768);
    add("double reference, ray by ray", fields, static_cast<double>(reference.Size()),
      [&, reference](const relief::HeightField& field)
      { RunReference(field, Medium(field, 0.0), sun, reference, exact.data()); });

    // A step for each sample that the way to the sphere about the field is long.
    const Probe thin = Thinned(reference, 8192);
    const relief::HeightView<float>& heights = one.GetField().heights;
    const double diagonal = std::hypot(std::hypot(heights.columns - 1.0, heights.rows - 1.0),
      (one.GetTop() - one.GetBottom()) / heights.spacingX);
    const int steps = static_cast<int>(diagonal / 2.0);
    add("fixed steps of one sample", fields, static_cast<double>(thin.Size()),
      [&, thin, steps](const relief::HeightField& field)
      {
        RunSteps(field, Medium(field, 0.0), SunOnSphere(field, CurveAzimuth, GrowthAltitude),
          Stepping::Published, steps, thin, d.data());
      });
  }
  Race(rivals, repetitions);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    points[k].nanoseconds = rivals[k].Least();
  }
  return points;
}

double GrowthExponent(
  const std::vector<GrowthPoint>& points, const std::string& integrator, int first)
{
  double n = 0.0;
  double sx = 0.0;
  double sy = 0.0;
  double sxx = 0.0;
  double sxy = 0.0;
  for (const GrowthPoint& point : points)
  {
    if (point.integrator == integrator && point.size >= first)
    {
      const double x = std::log(point.size);
      const double y = std::log(point.nanoseconds);
      n += 1.0;
      sx += x;
      sy += y;
      sxx += x * x;
      sxy += x * y;
    }
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}
