// SPDX-License-Identifier: BSD-3-Clause
#include "Comparison.h"
#include "Curves.h"
#include "FilterRun.h"
#include "Integrators.h"
#ifdef RELIEF_HAVE_GDAL
#include "GdalHillshade.h"
#endif

#include <vtkReliefEnvironment.h>
#include <vtkReliefMaterial.h>

#include <algorithm>
#include <functional>
#include <memory>

namespace bench
{

namespace
{
// The filter over a scene that differs from one exact sun, 45 or 20 degrees high, by what a
// function changes.
using Change = std::function<void(FilterRun&)>;

std::shared_ptr<FilterRun> MakeRun(const Relief& relief, double altitude, const Change& change = {})
{
  auto run = std::make_shared<FilterRun>(
    relief, std::vector<std::pair<double, double>>{ { CurveAzimuth, altitude } });
  run->GetScene()->SetTolerance(0.0);
  if (change)
  {
    change(*run);
  }
  return run;
}

void SetFloor(FilterRun& run, const Relief& relief)
{
  // A quarter of the heights lie below it.
  std::vector<float> heights = relief.heights;
  const auto quarter = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 4);
  std::nth_element(heights.begin(), quarter, heights.end());
  run.GetScene()->GetMaterial()->SetUseFloor(true);
  run.GetScene()->GetMaterial()->SetFloorHeight(*quarter);
}

void AddWhole(const Relief& relief, Contest& rivals)
{
  const auto all = static_cast<double>(relief.heights.size());
  auto add = [&](const std::string& name, double altitude, const Change& change = {})
  {
    auto run = MakeRun(relief, altitude, change);
    rivals.Add(name, all, [run] { run->Run(1); });
  };
  const Change toFloat = [](FilterRun& run) { run.GetFilter()->SetOutputScalarTypeToFloat(); };
  add("filter, 45", 45.0);
  add("filter, 20", 20.0);
  add("filter, float, 45", 45.0, toFloat);
  for (const bool isFloat : { false, true })
  {
    auto run = MakeRun(relief, 45.0, isFloat ? toFloat : Change());
    rivals.Add(isFloat ? "filter, heights kept, float, 45" : "filter, heights kept, 45", all,
      [run] { run->RunMoved(1); });
  }
  add("filter, highlights alone, 45", 45.0,
    [](FilterRun& run) { run.GetScene()->GetMaterial()->SetSpecularCoefficient(1.0); });
  add("filter, vertical, 20", 20.0,
    [](FilterRun& run) { run.GetScene()->GetMaterial()->SetOffsetModeToVertical(); });
  add("filter, normal offset, 20", 20.0,
    [](FilterRun& run) { run.GetScene()->GetMaterial()->SetOffsetModeToSurfaceNormal(); });
  add("filter, vertical, floor, 20", 20.0,
    [&](FilterRun& run)
    {
      run.GetScene()->GetMaterial()->SetOffsetModeToVertical();
      SetFloor(run, relief);
    });
  add("filter, t = 0, 20", 20.0,
    [](FilterRun& run)
    {
      run.GetScene()->GetMaterial()->AutomaticSubsurfaceDepthOff();
      run.GetScene()->GetMaterial()->SetSubsurfaceDepth(0.0);
    });
}

// Skies, beside one sun over the same field.
void CompareSkies(const Relief& relief, int repetitions, Table& table)
{
  const auto all = static_cast<double>(relief.heights.size());
  Contest rivals;
  auto add = [&](const std::string& name, const Change& change)
  {
    auto run = MakeRun(relief, 20.0, change);
    rivals.Add(name, all, [run] { run->Run(1); });
  };
  add("one sun, 20", {});
  add("sky of 64 samples",
    [](FilterRun& run)
    {
      run.GetScene()->SetLightsToSkyDome();
      run.GetScene()->GetEnvironment()->SetNumberOfSamples(64);
    });
  add("sun and sky",
    [](FilterRun& run) { run.GetScene()->SetLightsToSunAndSky(CurveAzimuth, 20.0); });
  rivals.Race(repetitions);
  table.Add("sky of 64 samples (32 lights) against one sun, 20",
    rivals["sky of 64 samples"] / rivals["one sun, 20"], "x", 10.0, Table::AtMost);
  table.Add("sun and sky (80 lights) against one sun, 20",
    rivals["sun and sky"] / rivals["one sun, 20"], "x", 20.0, Table::AtMost);
}

// d alone: offsets, depth 0, tolerance, lamps.
void CompareLightAlone(const Relief& relief, int repetitions, Table& table)
{
  const auto field = Prepare(relief);
  const auto all = static_cast<double>(relief.heights.size());
  std::vector<float> d(relief.heights.size());
  Contest rivals;
  auto add = [&](const std::string& name, double altitude, relief::f64::ReliefMedium medium)
  {
    rivals.Add(name, all,
      [&, altitude, medium] { RunSweep(*field, medium, Sun(CurveAzimuth, altitude), d.data()); });
  };
  const relief::f64::ReliefMedium exact = Medium(*field, 0.0);
  relief::f64::ReliefMedium opaque = exact;
  opaque.depth = 0.0;
  for (const double altitude : { 20.0, 45.0 })
  {
    add(At("vertical", altitude), altitude, exact);
    add(At("tangent plane", altitude), altitude,
      Medium(*field, 0.0, relief::f64::RELIEF_TANGENT_PLANE));
    add(At("t = 0", altitude), altitude, opaque);
  }
  add("exact, 10", 10.0, exact);
  add("tolerance 0.02, 10", 10.0, Medium(*field, 0.02));
  const relief::Light lamp = Lamp(*field, CurveAzimuth, 20.0, LampDistance);
  rivals.Add("lamp, 20", all, [&] { RunScene(*field, exact, lamp, d.data()); });
  rivals.Race(repetitions);
  for (const double altitude : { 20.0, 45.0 })
  {
    const double vertical = rivals[At("vertical", altitude)];
    table.Add(At("d alone, offset to the tangent plane against vertical", altitude),
      rivals[At("tangent plane", altitude)] / vertical, "x", 1.15, Table::AtMost);
    table.Add(At("d alone, t = 0 against t one sample", altitude),
      rivals[At("t = 0", altitude)] / vertical, "x", 1.1, Table::AtMost);
  }
  table.Add("d alone, tolerance 0.02 against 0, 10",
    rivals["tolerance 0.02, 10"] / rivals["exact, 10"], "x", 0.7, Table::AtMost);
  table.Add("d alone, lamp against sun, 20", rivals["lamp, 20"] / rivals["vertical, 20"], "x", 2.5,
    Table::AtMost);
}
}

void CompareScenes(const Relief& relief, int repetitions, Table& table)
{
  const auto field = Prepare(relief);
  const auto all = static_cast<double>(relief.heights.size());
  std::vector<float> d(relief.heights.size());
  Contest rivals;
  rivals.Add("d alone, 45", all,
    [&]
    {
      RunSweep(*field, Medium(*field, 0.0, relief::f64::RELIEF_TANGENT_PLANE),
        Sun(CurveAzimuth, 45.0), d.data());
    });
  AddWhole(relief, rivals);
#ifdef RELIEF_HAVE_GDAL
  const GdalHillshade hillshade(relief);
  rivals.Add("gdaldem hillshade, 45", all, [&] { hillshade.Run(CurveAzimuth, 45.0); });
#endif
  rivals.Race(repetitions);
#ifdef RELIEF_HAVE_GDAL
  const double plain = rivals["gdaldem hillshade, 45"];
  table.Add("whole filter, one sun, against a hillshade, 45", rivals["filter, 45"] / plain, "x",
    1.0, Table::AtMost);
  table.Add("whole filter, one sun, against a hillshade, 20", rivals["filter, 20"] / plain, "x",
    2.0, Table::AtMost);
  table.Add("whole filter, highlights alone, against a hillshade",
    rivals["filter, highlights alone, 45"] / plain, "x", 0.8, Table::AtMost);
#endif
  for (const char* name : { "filter, 45", "filter, float, 45", "filter, heights kept, 45",
         "filter, heights kept, float, 45" })
  {
    table.Add(std::string("whole ") + name + ", against d alone",
      rivals[name] / rivals["d alone, 45"], "x", 1.25, Table::AtMost);
  }
  const double vertical = rivals["filter, vertical, 20"];
  table.Add("whole filter, t = 0 against t one sample, 20",
    rivals["filter, t = 0, 20"] / rivals["filter, 20"], "x", 1.1, Table::AtMost);
  table.Add("whole filter, normal offset against vertical, 20",
    rivals["filter, normal offset, 20"] / vertical, "x", 2.0, Table::AtMost);
  table.Add("whole filter, floor against none, 20",
    rivals["filter, vertical, floor, 20"] / vertical, "x", 1.5, Table::AtMost);
  CompareLightAlone(relief, repetitions, table);
  CompareSkies(relief, std::max(1, repetitions / 3), table);
}

void CompareThreads(const Relief& relief, int repetitions, Table& table)
{
  FilterRun filter(relief, { { CurveAzimuth, 45.0 } });
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
  for (const auto& [name, goal] :
    { std::pair("whole filter, 1 sun", 1.95), std::pair("whole filter, 8 suns", 1.9) })
  {
    table.Add("2 threads (" + FilterRun::ThreadedBackend() + ") against 1, wall clock, " + name,
      rivals[std::string(name) + ", 1 thread"] / rivals[std::string(name) + ", 2 threads"], "x",
      goal, Table::AtLeast);
  }
}

}
