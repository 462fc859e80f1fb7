// SPDX-License-Identifier: BSD-3-Clause
//
// Compares the exact integrator with what else computes light on a height field, in one process,
// and prints a table. Each time is the least of several runs, in which the rivals took turns.
//
//   reliefcomparison [TABLE.csv [SIZE]]
//
// With a SIZE, the field is that small, for a trial run.
#include "BenchmarkTerrain.h"
#include "Curves.h"
#include "FilterRun.h"
#include "Growth.h"
#include "Integrators.h"
#include "LightSampling.h"
#include "SceneShading.h"
#include "Targets.h"
#include "Timing.h"
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
#include <map>
#include <sstream>
#include <thread>

namespace
{
using namespace bench;

// The table: what was measured, and what is expected of it.
class Table
{
public:
  void Add(const std::string& name, double measured, const char* unit, double goal, bool atLeast)
  {
    std::ostringstream value;
    value << std::setprecision(3) << measured << unit;
    std::ostringstream aim;
    if (goal > 0.0)
    {
      aim << (atLeast ? ">= " : "<= ") << goal << unit;
    }
    const bool met = atLeast ? measured >= goal : measured <= goal;
    this->Rows.push_back({ name, value.str(), aim.str(), goal > 0.0 ? (met ? "yes" : "no") : "" });
  }

  void Write(std::ostream& out, bool csv) const
  {
    for (const auto& row : this->Rows)
    {
      if (csv)
      {
        out << "\"" << row[0] << "\",\"" << row[1] << "\"\n";
        continue;
      }
      out << std::left << std::setw(76) << row[0] << std::right << std::setw(12) << row[1]
          << std::setw(12) << row[2] << std::setw(5) << row[3] << "\n";
    }
  }

private:
  std::vector<std::vector<std::string>> Rows{ { "what", "measured", "goal", "met" } };
};

// Rivals by their names.
class Contest
{
public:
  void Add(const std::string& name, double samples, const std::function<void()>& run,
    Clock clock = Clock::Thread)
  {
    Rival rival;
    rival.name = name;
    rival.samples = samples;
    rival.run = run;
    rival.clock = clock;
    this->Rivals.push_back(rival);
  }
  void Race(int repetitions)
  {
    bench::Race(this->Rivals, repetitions);
    for (const Rival& rival : this->Rivals)
    {
      std::cout << "  " << std::left << std::setw(48) << rival.name << std::right << std::setw(12)
                << std::setprecision(4) << rival.Least() << " ns a sample, median "
                << rival.Median() << "\n";
      this->Times[rival.name] = rival.Least();
    }
  }
  double operator[](const std::string& name) const { return this->Times.at(name); }

private:
  std::vector<Rival> Rivals;
  std::map<std::string, double> Times;
};

std::string At(const std::string& name, double altitude)
{
  return name + ", " + std::to_string(static_cast<int>(altitude));
}

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
      [&, sun] { RunSweep(*field, Medium(*field, DefaultTolerance), sun, d.data()); });
    if (OnlyAVX2::Matters())
    {
      rivals.Add(At("exact, AVX2", altitude), all,
        [&, sun]
        {
          const OnlyAVX2 restricted;
          RunSweep(*field, Medium(*field, 0.0), sun, d.data());
        });
    }
    rivals.Add(At("reference", altitude), static_cast<double>(probe.Size()),
      [&, sun] { RunReference(*field, Medium(*field, 0.0), sun, probe, exact.data()); });
  }
  rivals.Add("lamp, exact", all, [&] { RunScene(*field, Medium(*field, 0.0), lamp, d.data()); });
  rivals.Add("lamp, default tolerance", all,
    [&] { RunScene(*field, Medium(*field, DefaultTolerance), lamp, d.data()); });
  rivals.Add("lamp, reference", static_cast<double>(probe.Size()),
    [&] { RunReference(*field, Medium(*field, 0.0), lamp, probe, exact.data()); });
  rivals.Add("padded copy and bounds", all, [&] { Prepare(relief); });
  FilterRun filter(relief, { { 315.0, 45.0 } });
  rivals.Add("whole filter, 45", all, [&] { filter.Run(1); });
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
    table.Add(At("exact (tolerance 0) against the double reference, sun at", altitude),
      rivals[At("reference", altitude)] / rivals[At("exact", altitude)], "x", goal, true);
    if (OnlyAVX2::Matters())
    {
      table.Add(At("the same with AVX2 only", altitude),
        rivals[At("reference", altitude)] / rivals[At("exact, AVX2", altitude)], "x", goal / 2.0,
        true);
    }
  }
#ifdef RELIEF_HAVE_EMBREE
  for (double altitude : { 20.0, 45.0 })
  {
    const double rays =
      std::min(rivals[At("Embree, grid", altitude)], rivals[At("Embree, triangles", altitude)]);
    table.Add(At("exact against Embree's hard shadows, without its tree, sun at", altitude),
      rays / rivals[At("exact", altitude)], "x", altitude == 20.0 ? 6.0 : 0.0, true);
  }
#endif
#ifdef RELIEF_HAVE_GDAL
  const double hillshadeTime = rivals["gdaldem hillshade, 45"];
  table.Add("time of d alone, tolerance 0, in gdaldem hillshades, 45",
    rivals["exact, 45"] / hillshadeTime, "x", 1.5, false);
  table.Add("time of d alone, default tolerance, in gdaldem hillshades, 45",
    rivals["default tolerance, 45"] / hillshadeTime, "x", 1.5, false);
  table.Add("time of the whole filter, 8-bit colour, in gdaldem hillshades, 45",
    rivals["whole filter, 45"] / hillshadeTime, "x", 3.0, false);
#endif
  table.Add("lamp, tolerance 0, against the double reference, about 20",
    rivals["lamp, reference"] / rivals["lamp, exact"], "x", 20.0, true);
  table.Add("lamp, default tolerance, against the double reference, about 20",
    rivals["lamp, reference"] / rivals["lamp, default tolerance"], "x", 20.0, true);
  table.Add(
    "padded copy and bounds, a sample", rivals["padded copy and bounds"], " ns", 8.0, false);

  // Fixed steps of the same error.
  const relief::Light sun = Sun(315.0, 20.0);
  RunReference(*field, Medium(*field, 0.0), sun, probe, exact.data());
  RunSweep(*field, Medium(*field, DefaultTolerance), sun, d.data());
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
      found.nanoseconds / rivals["default tolerance, 20"], "x", 100.0, true);
  }
}

void CompareThreads(const Relief& relief, int repetitions, Table& table)
{
  FilterRun filter(relief, { { 315.0, 45.0 } });
  FilterRun suns(relief, Suns(8));
  Contest rivals;
  const auto all = static_cast<double>(relief.heights.size());
  for (int threads : { 1, 2 })
  {
    const std::string suffix = threads == 1 ? ", 1 thread" : ", 2 threads";
    rivals.Add(
      "whole filter, 1 sun" + suffix, all, [&, threads] { filter.Run(threads); }, Clock::Wall);
    rivals.Add(
      "whole filter, 8 suns" + suffix, all, [&, threads] { suns.Run(threads); }, Clock::Wall);
  }
  rivals.Race(repetitions);
  for (const char* name : { "whole filter, 1 sun", "whole filter, 8 suns" })
  {
    table.Add("2 threads (" + FilterRun::ThreadedBackend() + ") against 1, wall clock, " + name,
      rivals[std::string(name) + ", 1 thread"] / rivals[std::string(name) + ", 2 threads"], "x",
      1.8, true);
  }
}

// Many lights at once, and each of them alone, as 8-bit colour.
void CompareLights(const Relief& relief, const std::vector<relief::Light>& lights,
  const std::string& name, int repetitions, Table& table)
{
  const auto field = Prepare(relief);
  std::vector<unsigned char> rgba(4 * relief.heights.size());
  relief::Scene scene;
  scene.medium = Medium(*field, DefaultTolerance);
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
    false);
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
              *fields[k], Medium(*fields[k], DefaultTolerance), Sun(315.0, altitude), d.data());
          }
        });
    }
  }
  rivals.Race(repetitions);
  for (double altitude : { 10.0, 20.0 })
  {
    table.Add(At("a sample among " + std::to_string(large) + "^2 against one among " +
                  std::to_string(small) + "^2, time, sun at",
                altitude),
      rivals[At(std::to_string(large), altitude)] / rivals[At(std::to_string(small), altitude)],
      "x", 1.3, false);
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
  CompareIntegrators(relief, repetitions, table);
  CompareSizes(trial > 0 ? trial : 1024, trial > 0 ? 2 * trial : 8192, repetitions, table);
  const Relief many = trial > 0 ? relief : Terrain(1024, 1024, 2.0 * TerrainSpacing);
  CompareLights(many, ManySuns(64), "64 suns", trial > 0 ? 1 : 5, table);
  CompareLights(many, WhiteSky(256), "256 of a white sky", trial > 0 ? 1 : 3, table);
  CompareThreads(relief, trial > 0 ? 1 : 15, table);
  std::cout << "\n";
  table.Write(std::cout, false);
  if (argc > 1)
  {
    std::ofstream file(argv[1]);
    table.Write(file, true);
    file.close();
    if (!file)
    {
      std::cerr << "cannot write " << argv[1] << "\n";
      return EXIT_FAILURE;
    }
  }
  return EXIT_SUCCESS;
}
