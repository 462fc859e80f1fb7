// SPDX-License-Identifier: BSD-3-Clause
//
// Measures what accuracy costs: every integrator over its knob, and the cost of a sample against
// the size of the field. Writes tables (CSV) and charts (PNG) into a folder.
//
//   reliefaccuracy FOLDER [SIZE]
//
// With a SIZE, all fields are that small, for a trial run.
#include "BenchmarkTerrain.h"
#include "Charts.h"
#include "Curves.h"
#include "Growth.h"

#include <vtkPlotPoints.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <map>

namespace
{
using namespace bench;

// One look for each integrator in all charts.
Series Look(const std::string& name)
{
  struct Style
  {
    unsigned char color[3];
    int marker;
  };
  static const std::map<std::string, Style> styles = {
    { Lockstep, { { 0, 90, 181 }, vtkPlotPoints::CIRCLE } },
    { LampScene, { { 0, 158, 115 }, vtkPlotPoints::DIAMOND } },
    { RayByRay, { { 86, 180, 233 }, vtkPlotPoints::SQUARE } },
    { StepsPublished, { { 180, 30, 30 }, vtkPlotPoints::CROSS } },
    { StepsThickness, { { 230, 120, 0 }, vtkPlotPoints::PLUS } },
    { StepsBilinear, { { 150, 90, 160 }, vtkPlotPoints::CIRCLE } },
    { ExactMarked, { { 0, 90, 181 }, vtkPlotPoints::CIRCLE } },
    { "exact, tolerance 0", { { 86, 180, 233 }, vtkPlotPoints::SQUARE } },
    { "double reference, ray by ray", { { 110, 110, 110 }, vtkPlotPoints::DIAMOND } },
    { "fixed steps of one sample", { { 180, 30, 30 }, vtkPlotPoints::CROSS } },
  };
  Series series;
  series.name = name;
  const Style& style = styles.at(name);
  std::copy_n(style.color, 3, series.color);
  series.marker = style.marker;
  return series;
}

bool DrawCurves(
  const std::vector<CurvePoint>& points, const std::string& title, const std::string& fileName)
{
  Chart chart;
  chart.title = title;
  chart.xTitle = "time for a sample and light, one thread (ns)";
  chart.yTitle = "error of d that 99.9 % of the samples keep";
  for (const char* name :
    { Lockstep, LampScene, RayByRay, StepsPublished, StepsThickness, StepsBilinear })
  {
    Series series = Look(name);
    for (const CurvePoint& point : points)
    {
      if (point.integrator == name)
      {
        series.x.push_back(point.nanoseconds);
        series.y.push_back(point.error.mostOf999);
      }
    }
    chart.series.push_back(series);
  }
  Series preset;
  preset.name = Marked;
  preset.line = false;
  preset.marker = vtkPlotPoints::CIRCLE;
  for (const CurvePoint& point : points)
  {
    if (point.knob == MarkedTolerance)
    {
      preset.x.push_back(point.nanoseconds);
      preset.y.push_back(point.error.mostOf999);
    }
  }
  chart.series.insert(chart.series.begin(), preset);
  return DrawChart(chart, fileName);
}

// Tells how many steps the default tolerance's error takes, and appends what more steps than the
// curves have bring, timed once, where they bring anything.
void FollowSteps(const Relief& relief, int mostSteps, std::vector<CurvePoint>& points)
{
  const auto field = Prepare(relief);
  for (const auto& [stepping, name] : { std::pair(Stepping::Published, StepsPublished),
         std::pair(Stepping::Thickness, StepsThickness),
         std::pair(Stepping::Bilinear, StepsBilinear) })
  {
    const StepsFor found = FindSteps(*field, stepping, MarkedTolerance, 1 << 20);
    if (found.steps == 0)
    {
      std::cout << "  " << name << ": no number of steps for an error of " << MarkedTolerance
                << ", none below " << found.error << "\n";
      continue;
    }
    std::cout << "  " << name << ": " << found.steps << " steps for an error of " << found.error
              << ", " << found.nanoseconds << " ns a sample\n";
    for (CurvePoint point : found.tried)
    {
      if (point.knob > mostSteps)
      {
        point.scene = relief.name;
        point.integrator = name;
        points.push_back(point);
      }
    }
  }
}

bool DrawGrowth(const std::vector<GrowthPoint>& points, const std::string& fileName)
{
  Chart chart;
  chart.title = "Cost of a sample against the size of the field: terrain, sun 10\xc2\xb0 high";
  chart.xTitle = "samples";
  chart.yTitle = "time for a sample and light, one thread (ns)";
  chart.powersOfTwo = true;
  chart.legendAbove = true;
  for (const char* name : { "fixed steps of one sample", "double reference, ray by ray",
         "exact, tolerance 0", ExactMarked })
  {
    Series series = Look(name);
    for (const GrowthPoint& point : points)
    {
      if (point.integrator == name)
      {
        series.x.push_back(point.size);
        series.y.push_back(point.nanoseconds);
      }
    }
    chart.series.push_back(series);
  }
  return DrawChart(chart, fileName);
}
}

int main(int argc, char* argv[])
{
  if (argc < 2)
  {
    std::cerr << "usage: reliefaccuracy FOLDER [SIZE]\n";
    return EXIT_FAILURE;
  }
  const std::string folder = argv[1];
  const int trial = argc > 2 ? std::atoi(argv[2]) : 0;
  const int size = trial > 0 ? trial : 1024;
  const int repetitions = trial > 0 ? 1 : 5;
  const int mostSteps = trial > 0 ? 64 : 4096;
  std::cout << std::unitbuf << Environment() << "\n";

  bool good = true;
  std::ofstream table(folder + "/accuracy.csv");
  table
    << "scene,integrator,steps or tolerance,ns per sample,largest error,99.9 % error,rms error\n";
  const std::pair<Relief, const char*> scenes[] = {
    { Terrain(size, size, TerrainSpacing * 2048 / size), "Terrain, sun 20\xc2\xb0 high" },
    { trial > 0 ? Medallion(trial) : Medallion(), "Bas-relief, sun 20\xc2\xb0 high" },
    { City(size, size), "Houses, sun 20\xc2\xb0 high" },
  };
  for (const auto& [relief, title] : scenes)
  {
    std::vector<CurvePoint> points = MeasureCurves(relief, repetitions, mostSteps);
    std::cout << relief.name << ": slopes of " << MeanSlope(relief) << " degrees on average, "
              << points.size() << " settings measured\n";
    if (trial == 0)
    {
      FollowSteps(relief, mostSteps, points);
    }
    for (const CurvePoint& point : points)
    {
      table << point.scene << ",\"" << point.integrator << "\"," << point.knob << ","
            << point.nanoseconds << "," << point.error.most << "," << point.error.mostOf999 << ","
            << point.error.rms << "\n";
    }
    good = DrawCurves(points, title, folder + "/" + relief.name + ".png") && good;
  }
  table.close();

  const int last = trial > 0 ? 4 * trial : 8192;
  const std::vector<GrowthPoint> growth = MeasureGrowth(trial > 0 ? trial : 256, last, repetitions);
  std::ofstream growthTable(folder + "/growth.csv");
  growthTable << "integrator,samples along a side,ns per sample\n";
  for (const GrowthPoint& point : growth)
  {
    growthTable << "\"" << point.integrator << "\"," << point.size << "," << point.nanoseconds
                << "\n";
    if (point.size == last)
    {
      std::cout << point.integrator << ": cost of a sample ~ size^"
                << GrowthExponent(growth, point.integrator, trial) << " over all sizes, ^"
                << GrowthExponent(growth, point.integrator, last / 8) << " over the last four\n";
    }
  }
  growthTable.close();
  good = DrawGrowth(growth, folder + "/growth.png") && good;
  if (!good || !table || !growthTable)
  {
    std::cerr << "cannot write into " << folder << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
