// SPDX-License-Identifier: BSD-3-Clause
//
// Compares the exact integrator with what else computes light on a height field, in one process,
// and prints a table. Each time is the least of several runs, in which the rivals took turns.
//
//   reliefcomparison [TABLE.csv [SIZE]]
//
// With a SIZE, the field is that small, for a trial run.
#include "BenchmarkTerrain.h"
#include "Comparison.h"
#include "Curves.h"
#include "FilterRun.h"
#include "Growth.h"
#include "Integrators.h"
#include "LightSampling.h"
#include "SceneShading.h"
#include "Targets.h"
#ifdef RELIEF_HAVE_EMBREE
#include "EmbreeShadows.h"
#endif
#ifdef RELIEF_HAVE_GDAL
#include "GdalHillshade.h"
#endif

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iostream>

namespace
{
using namespace bench;

// One thread, one light.
void CompareIntegrators(const Relief& relief, int repetitions, Table& table)
{
  const auto field = Prepare(relief);
  const auto all = static_cast<double>(relief.heights.size());
  const Probe probe = SpreadProbe(*field, 65536);
  std::vector<float> d(relief.heights.size());
  std::vector<double> exact(probe.rows.size() * probe.columns);
  std::vector<unsigned char> lit(relief.heights.size());
  const relief::Light lamp = Lamp(*field, 315.0, 20.0, LampDistance);

  Contest rivals;
  for (double altitude : { 20.0, 45.0 })
  {
    const relief::Light sun = Sun(315.0, altitude);
    rivals.Add(At("exact", altitude), all,
      [&, sun] { RunSweep(*field, Medium(*field, 0.0), sun, d.data()); });
    rivals.Add(At("default tolerance", altitude), all,
      [&, sun] { RunSweep(*field, Medium(*field, MarkedTolerance), sun, d.data()); });
    rivals.Add(At("reference", altitude), static_cast<double>(probe.Size()),
      [&, sun] { RunReference(*field, Medium(*field, 0.0), sun, probe, exact.data()); });
  }
  rivals.Add("lamp, exact", all, [&] { RunScene(*field, Medium(*field, 0.0), lamp, d.data()); });
  rivals.Add("lamp, default tolerance", all,
    [&] { RunScene(*field, Medium(*field, MarkedTolerance), lamp, d.data()); });
  rivals.Add("lamp, reference", static_cast<double>(probe.Size()),
    [&] { RunReference(*field, Medium(*field, 0.0), lamp, probe, exact.data()); });
  rivals.Add("padded copy and bounds", all, [&] { Prepare(relief); });
#ifdef RELIEF_HAVE_EMBREE
  const EmbreeShadows grid(relief, EmbreeShadows::Grid);
  const EmbreeShadows triangles(relief, EmbreeShadows::Triangles);
  for (double altitude : { 20.0, 45.0 })
  {
    const relief::Light sun = Sun(315.0, altitude);
    rivals.Add(At("Embree, grid", altitude), all, [&, sun] { grid.Run(sun, lit.data()); });
    rivals.Add(
      At("Embree, triangles", altitude), all, [&, sun] { triangles.Run(sun, lit.data()); });
  }
  rivals.Add(
    "Embree, building a grid", all, [&] { EmbreeShadows(relief, EmbreeShadows::Grid); },
    Clock::Process);
  rivals.Add(
    "Embree, building triangles", all, [&] { EmbreeShadows(relief, EmbreeShadows::Triangles); },
    Clock::Process);
#endif
#ifdef RELIEF_HAVE_GDAL
  const GdalHillshade hillshade(relief);
  rivals.Add("gdaldem hillshade, 45", all, [&] { hillshade.Run(315.0, 45.0); });
#endif
  rivals.Race(repetitions);

  const std::pair<double, double> goals[] = { { 20.0, 100.0 }, { 45.0, 150.0 } };
  for (const auto& [altitude, goal] : goals)
  {
    table.Add(At("d alone, tolerance 0, against the double reference", altitude),
      rivals[At("reference", altitude)] / rivals[At("exact", altitude)], "x", goal, Table::AtLeast);
  }
#ifdef RELIEF_HAVE_EMBREE
  for (double altitude : { 20.0, 45.0 })
  {
    const double rays =
      std::min(rivals[At("Embree, grid", altitude)], rivals[At("Embree, triangles", altitude)]);
    table.Add(
      At("d alone, tolerance 0, against Embree's hard shadows, its tree not counted", altitude),
      rays / rivals[At("exact", altitude)], "x", altitude == 20.0 ? 6.0 : 0.0, Table::AtLeast);
  }
#endif
#ifdef RELIEF_HAVE_GDAL
  const double hillshadeTime = rivals["gdaldem hillshade, 45"];
  table.Add("time of d alone, tolerance 0, in gdaldem hillshades, 45",
    rivals["exact, 45"] / hillshadeTime, "x", 1.5, Table::AtMost);
  table.Add("time of d alone, default tolerance, in gdaldem hillshades, 45",
    rivals["default tolerance, 45"] / hillshadeTime, "x", 1.5, Table::AtMost);
#endif
  table.Add("lamp, tolerance 0, against the double reference, about 20",
    rivals["lamp, reference"] / rivals["lamp, exact"], "x", 20.0, Table::AtLeast);
  table.Add("lamp, default tolerance, against the double reference, about 20",
    rivals["lamp, reference"] / rivals["lamp, default tolerance"], "x", 20.0, Table::AtLeast);
  table.Add("padded copy and bounds, a sample", rivals["padded copy and bounds"], " ns", 8.0,
    Table::AtMost);
}

// The thesis's fixed steps of the same error as the default tolerance.
void CompareFixedSteps(const Relief& relief, int repetitions, Table& table)
{
  const auto field = Prepare(relief);
  const Probe probe = SpreadProbe(*field, 65536);
  std::vector<float> d(relief.heights.size());
  std::vector<double> exact(probe.rows.size() * probe.columns);
  const relief::Light sun = Sun(315.0, 20.0);
  RunReference(*field, Medium(*field, 0.0), sun, probe, exact.data());
  auto run = [&] { RunSweep(*field, Medium(*field, MarkedTolerance), sun, d.data()); };
  const double sweep = LeastTime(static_cast<double>(d.size()), repetitions, run);
  const ErrorOfD error = Compare(probe, exact, Pick(probe, d).data());
  std::cout << "  default tolerance, 20: errors at most " << error.most << ", 99.9 % "
            << error.mostOf999 << ", rms " << error.rms << "; " << 100.0 * ShareBelowTop(*field)
            << " % of the fixed steps' way is below the highest ground\n";
  const int mostSteps = relief.columns > 512 ? 1 << 19 : 1024;
  for (const auto& [stepping, name] : { std::pair(Stepping::Published, StepsPublished),
         std::pair(Stepping::Thickness, StepsThickness),
         std::pair(Stepping::Bilinear, StepsBilinear) })
  {
    const StepsFor found = FindSteps(*field, stepping, error.mostOf999, mostSteps);
    if (found.steps == 0)
    {
      std::cout << "  " << name << ": up to " << mostSteps << " steps no error below "
                << found.error << "\n";
      continue;
    }
    std::cout << "  " << name << ": " << found.steps << " steps, error " << found.error << ", "
              << found.nanoseconds << " ns a sample\n";
    table.Add("default tolerance against " + std::to_string(found.steps) + " fixed steps (" + name +
        "), 20",
      found.nanoseconds / sweep, "x", 100.0, Table::AtLeast);
  }
}

// Many lights at once, and each of them alone, as 8-bit colour.
void CompareLights(const Relief& relief, const std::vector<relief::Light>& lights,
  const std::string& name, int repetitions, Table& table)
{
  const auto field = Prepare(relief);
  std::vector<unsigned char> rgba(4 * relief.heights.size());
  relief::Scene scene;
  scene.medium = Medium(*field, MarkedTolerance);
  auto shade = [&](std::size_t first, std::size_t last)
  {
    scene.lights.assign(lights.begin() + static_cast<std::ptrdiff_t>(first),
      lights.begin() + static_cast<std::ptrdiff_t>(last));
    relief::Target target;
    target.width = relief.columns;
    target.rgba8 = rgba.data();
    relief::SceneShading shading(*field, scene, target);
    shading.Shade(0, relief.columns, 0, relief.rows);
  };
  Contest rivals;
  const std::size_t count = lights.size();
  const double work = static_cast<double>(count * relief.heights.size());
  rivals.Add(name + " at once, a light", work, [&] { shade(0, count); });
  rivals.Add(name + " one after another, a light", work,
    [&]
    {
      for (std::size_t k = 0; k < count; ++k)
      {
        shade(k, k + 1);
      }
    });
  rivals.Race(repetitions);
  table.Add("a light among " + name + " against one alone, time",
    rivals[name + " at once, a light"] / rivals[name + " one after another, a light"], "x", 1.0,
    Table::AtMost);
}

std::vector<relief::Light> ManySuns(int count)
{
  std::vector<relief::Light> lights;
  for (const auto& sun : Suns(count))
  {
    lights.push_back(Sun(sun.first, sun.second));
    lights.back().weight = 1.0 / count;
  }
  return lights;
}

// The lights of a white sky that are above the horizon: half of all.
std::vector<relief::Light> WhiteSky(int count)
{
  relief::RadianceMap white(1, 1);
  white.Set(0, 0, glm::dvec3(1.0));
  std::vector<relief::Light> lights = relief::SampleEnvironment(
    white, relief::EnvironmentSampling::SolidAngle, 2 * count, glm::dmat3(1.0));
  lights.erase(std::remove_if(lights.begin(), lights.end(),
                 [](const relief::Light& light) { return light.vector.z < 0.0; }),
    lights.end());
  return lights;
}

void CompareSizes(int small, int large, int repetitions, Table& table)
{
  std::vector<std::unique_ptr<relief::HeightField>> fields;
  fields.push_back(Prepare(Terrain(small, small, TerrainSpacing, 0)));
  fields.push_back(Prepare(Terrain(small, small, TerrainSpacing, small)));
  fields.push_back(Prepare(Terrain(large, large)));
  std::vector<float> d(static_cast<std::size_t>(large) * large);
  Contest rivals;
  for (double altitude : { 10.0, 20.0 })
  {
    for (int size : { small, large })
    {
      const double samples = static_cast<double>(size) * size * (size == small ? 2.0 : 1.0);
      rivals.Add(At(std::to_string(size), altitude), samples,
        [&, altitude, size]
        {
          const std::size_t first = size == small ? 0 : 2;
          const std::size_t last = size == small ? 2 : 3;
          for (std::size_t k = first; k < last; ++k)
          {
            RunSweep(
              *fields[k], Medium(*fields[k], MarkedTolerance), Sun(315.0, altitude), d.data());
          }
        });
    }
  }
  rivals.Race(repetitions);
  for (double altitude : { 10.0, 20.0 })
  {
    table.Add(At("a sample among " + std::to_string(large) + "^2 against one among " +
                  std::to_string(small) + "^2, time",
                altitude),
      rivals[At(std::to_string(large), altitude)] / rivals[At(std::to_string(small), altitude)],
      "x", 1.3, Table::AtMost);
  }
}
}

int main(int argc, char* argv[])
{
  const int trial = argc > 2 ? std::atoi(argv[2]) : 0;
  const int size = trial > 0 ? trial : 2048;
  const int repetitions = trial > 0 ? 1 : 7;
  const Relief relief = Terrain(size, size, TerrainSpacing * 2048 / size);
  std::cout << std::unitbuf << Environment() << "\nTerrain of " << size << "^2 samples, slopes of "
            << std::setprecision(3) << MeanSlope(relief) << " degrees on average; the least of "
            << repetitions << " runs in turn\n";
  Table table;
  auto compare = [&](const std::string& vectors)
  {
    table.SetColumn(vectors);
    std::cout << vectors << "\n";
    CompareIntegrators(relief, repetitions, table);
    CompareScenes(relief, repetitions, table);
  };
  compare(relief::SweepThickness::GetTargetName());
  CompareThreads(relief, trial > 0 ? 1 : 15, table);
  CompareFixedSteps(relief, repetitions, table);
  CompareSizes(trial > 0 ? trial : 1024, trial > 0 ? 2 * trial : 16384, repetitions, table);
  const Relief many = trial > 0 ? relief : Terrain(1024, 1024, 2.0 * TerrainSpacing);
  CompareLights(many, ManySuns(64), "64 suns", trial > 0 ? 1 : 5, table);
  CompareLights(many, WhiteSky(256), "256 of a white sky", trial > 0 ? 1 : 3, table);
  if (OnlyAVX2::Matters())
  {
    const OnlyAVX2 restricted;
    compare(relief::SweepThickness::GetTargetName());
  }
  std::cout << "\n";
  table.WriteText(std::cout);
  if (argc > 1)
  {
    std::ofstream file(argv[1]);
    table.WriteCSV(file);
    file.close();
    if (!file)
    {
      std::cerr << "cannot write " << argv[1] << "\n";
      return EXIT_FAILURE;
    }
  }
  return EXIT_SUCCESS;
}
