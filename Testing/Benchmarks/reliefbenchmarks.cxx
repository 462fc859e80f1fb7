// SPDX-License-Identifier: BSD-3-Clause
//
// Time for a sample and light (the counter time_per_sample) of each integrator, over one thing at a
// time: size, altitude, roughness, offset, lights, threads; and what the rest of the filter costs.
//
//   reliefbenchmarks [--size=64] [Google Benchmark's own options]
//
// With --size, all fields are that small, for a trial run.
#include "BenchmarkTerrain.h"
#include "Curves.h"
#include "FilterRun.h"
#include "Integrators.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>

namespace
{
using namespace bench;

// The case about which one thing at a time is varied.
struct Case
{
  std::string ground = "terrain";
  int size = 1024;
  double altitude = 20.0;
  double tolerance = MarkedTolerance;
  int offset = relief::f64::RELIEF_VERTICAL;
};

// The last relief made, which the next benchmark mostly wants too. Larger terrains go on, they are
// not stretched.
const Relief& Ground(const std::string& name, int size)
{
  static Relief last;
  if (last.name != name || last.columns != size)
  {
    last = name == "terrain" ? Terrain(size, size)
      : name == "dome"       ? Dome(size, size)
                             : WhiteNoise(size, size);
  }
  return last;
}

// Time divided by the samples of an iteration and the lights.
void CountSamples(benchmark::State& state, double samples, int lights = 1)
{
  state.counters["time_per_sample"] = benchmark::Counter(
    samples * lights, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

#ifdef __linux__
// The most memory that the process has had since the last Reset(), in bytes.
class PeakMemory
{
public:
  PeakMemory() { std::ofstream("/proc/self/clear_refs") << "5"; }
  static double Get(const std::string& field = "VmHWM:")
  {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
    {
      if (word == field)
      {
        double kibibytes = 0.0;
        status >> kibibytes;
        return 1024.0 * kibibytes;
      }
    }
    return 0.0;
  }
};
#endif

// Measures the most memory that a function needs, in bytes a sample.
template <class F>
void CountMemory(benchmark::State& state, double samples, F&& run)
{
#ifdef __linux__
  const double before = PeakMemory::Get("VmRSS:");
  const PeakMemory peak;
  run();
  state.counters["bytes_per_sample"] = (PeakMemory::Get() - before) / samples;
#else
  run();
#endif
}

enum class Kind
{
  Exact, // what the filter takes
  Lockstep,
  RayByRay,
  Lamp,
  Reference,
  FixedStep
};

void RunCase(benchmark::State& state, Kind kind, const Case& c)
{
  const Relief& relief = Ground(c.ground, c.size);
  const auto field = Prepare(relief);
  const relief::f64::ReliefMedium medium = Medium(*field, c.tolerance, c.offset);
  const relief::Light sun = Sun(315.0, c.altitude);
  const relief::Light lamp = Lamp(*field, 315.0, c.altitude, LampDistance);
  const relief::Light sphere = SunOnSphere(*field, 315.0, c.altitude);
  const bool whole = kind == Kind::Exact || kind == Kind::Lockstep || kind == Kind::Lamp;
  // Whole rows of about so many samples, of what is slow.
  const Probe probe = SpreadProbe(*field, kind == Kind::FixedStep ? 32768 : 65536);
  std::vector<float> d(whole ? relief.heights.size() : probe.rows.size() * probe.columns);
  std::vector<double> exact(kind == Kind::Reference ? d.size() : 0);
  for (auto _ : state)
  {
    switch (kind)
    {
      case Kind::Exact:
        RunScene(*field, medium, sun, d.data());
        break;
      case Kind::Lockstep:
        RunSweep(*field, medium, sun, d.data());
        break;
      case Kind::RayByRay:
        RunRays(*field, medium, sun, probe, d.data());
        break;
      case Kind::Lamp:
        RunScene(*field, medium, lamp, d.data());
        break;
      case Kind::Reference:
        RunReference(*field, medium, sun, probe, exact.data());
        break;
      case Kind::FixedStep:
        RunSteps(*field, medium, sphere, Stepping::Published, 256, probe, d.data());
        break;
    }
    benchmark::ClobberMemory();
  }
  CountSamples(state, static_cast<double>(whole ? d.size() : probe.Size()));

  // What the time buys.
  if (kind != Kind::Reference && kind != Kind::FixedStep)
  {
    std::vector<double> reference(probe.rows.size() * probe.columns);
    RunReference(*field, medium, kind == Kind::Lamp ? lamp : sun, probe, reference.data());
    const ErrorOfD error = Compare(probe, reference, (whole ? Pick(probe, d) : d).data());
    state.counters["error_max"] = error.most;
    state.counters["error_999"] = error.mostOf999;
    state.counters["error_rms"] = error.rms;
  }
}

void Register(const std::string& name, Kind kind, const Case& c)
{
  benchmark::RegisterBenchmark(
    name.c_str(), [kind, c](benchmark::State& state) { RunCase(state, kind, c); })
    ->Unit(benchmark::kMillisecond);
}

void RegisterIntegrators(const std::vector<int>& sizes, int size)
{
  const std::pair<const char*, Kind> kinds[] = { { "exact", Kind::Exact },
    { "lockstep", Kind::Lockstep }, { "ray_by_ray", Kind::RayByRay }, { "lamp", Kind::Lamp },
    { "reference", Kind::Reference }, { "fixed_step_256", Kind::FixedStep } };
  Case base;
  base.size = size;
  for (const auto& [name, kind] : kinds)
  {
    const std::string prefix = std::string(name) + "/";
    for (double altitude : { 5.0, 10.0, 20.0, 45.0, 80.0 })
    {
      Case c = base;
      c.altitude = altitude;
      Register(prefix + "altitude:" + std::to_string(static_cast<int>(altitude)), kind, c);
    }
    if (kind != Kind::Reference && kind != Kind::FixedStep)
    {
      Case c = base;
      c.tolerance = 0.0;
      Register(prefix + "tolerance:0", kind, c);
    }
    if (kind != Kind::Lockstep) // which sinks points vertically only
    {
      Case c = base;
      c.offset = relief::f64::RELIEF_SURFACE_NORMAL;
      Register(prefix + "offset:normal", kind, c);
    }
    for (const char* ground : { "dome", "noise" })
    {
      Case c = base;
      c.ground = ground;
      Register(prefix + "ground:" + ground, kind, c);
    }
  }
  for (int larger : sizes)
  {
    for (const auto& [name, kind] : kinds)
    {
      Case c = base;
      c.size = larger;
      Register(std::string(name) + "/size:" + std::to_string(larger), kind, c);
    }
  }
}

void RegisterFilter(const std::vector<int>& sizes, int size)
{
  for (int larger : sizes)
  {
    benchmark::RegisterBenchmark(("prepare/size:" + std::to_string(larger)).c_str(),
      [larger](benchmark::State& state)
      {
        const Relief& relief = Ground("terrain", larger);
        const auto samples = static_cast<double>(relief.heights.size());
        CountMemory(state, samples, [&] { Prepare(relief); });
        for (auto _ : state)
        {
          benchmark::DoNotOptimize(Prepare(relief));
        }
        CountSamples(state, samples);
      })
      ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("bounds/size:" + std::to_string(larger)).c_str(),
      [larger](benchmark::State& state)
      {
        const Relief& relief = Ground("terrain", larger);
        const auto field = Prepare(relief);
        for (auto _ : state)
        {
          relief::MinMaxPyramid pyramid;
          pyramid.Allocate(relief.columns, relief.rows);
          pyramid.BuildBase(field->GetField().heights, 0, pyramid.GetNumberOfBaseRows());
          pyramid.BuildUpper();
          benchmark::ClobberMemory();
        }
        const auto samples = static_cast<double>(relief.heights.size());
        CountSamples(state, samples);
        state.counters["bytes_per_sample"] =
          static_cast<double>(field->GetPyramid().GetMemorySize()) / samples;
      })
      ->Unit(benchmark::kMillisecond);
  }

  auto registerFilter = [](int samplesAlong, int lights, int threads)
  {
    benchmark::RegisterBenchmark(("filter/size:" + std::to_string(samplesAlong) + "/lights:" +
                                   std::to_string(lights) + "/threads:" + std::to_string(threads))
                                   .c_str(),
      [samplesAlong, lights, threads](benchmark::State& state)
      {
        const Relief& relief = Ground("terrain", samplesAlong);
        FilterRun filter(relief, Suns(lights));
        const auto samples = static_cast<double>(relief.heights.size());
        CountMemory(state, samples, [&] { filter.Run(threads); });
        for (auto _ : state)
        {
          filter.Run(threads);
        }
        CountSamples(state, samples, lights);
      })
      ->UseRealTime()
      ->MeasureProcessCPUTime()
      ->Unit(benchmark::kMillisecond);
  };
  for (int lights : { 1, 8, 64 })
  {
    for (int threads : { 1, 2 })
    {
      registerFilter(size, lights, threads);
    }
  }
  for (int larger : sizes)
  {
    registerFilter(larger, 1, 1);
  }
}
}

int main(int argc, char* argv[])
{
  std::vector<int> sizes = { 512, 2048, 4096, 8192 };
  int size = 1024;
  for (int k = 1; k < argc; ++k)
  {
    const std::string argument = argv[k];
    if (argument.rfind("--size=", 0) == 0)
    {
      size = std::atoi(argument.c_str() + 7);
      sizes = { size / 2 };
      std::copy(argv + k + 1, argv + argc, argv + k);
      --argc;
      break;
    }
  }
  RegisterIntegrators(sizes, size);
  RegisterFilter(sizes, size);
  benchmark::AddCustomContext("environment", Environment());
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
  {
    return EXIT_FAILURE;
  }
  benchmark::RunSpecifiedBenchmarks();
  return EXIT_SUCCESS;
}
