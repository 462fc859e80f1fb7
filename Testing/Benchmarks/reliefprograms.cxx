// SPDX-License-Identifier: BSD-3-Clause
//
// Compares reliefshade with gdaldem hillshade, from file to file, as processes of their own: all
// that a user waits for. Each number is the least of several runs, in which the two took turns.
//
//   reliefprograms RELIEFSHADE GDALDEM FOLDER [TABLE.csv [SIZE]]
//
// Files are made in FOLDER and removed. With a SIZE, the large field is that small, for a trial
// run.
#include "BenchmarkTerrain.h"
#include "Comparison.h"

#include <gdal.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <string>
#include <vector>

namespace
{
using namespace bench;

[[noreturn]] void Fail(const std::string& what)
{
  std::cerr << what << "\n";
  std::exit(EXIT_FAILURE);
}

// What a process took.
struct Cost
{
  double processor = 1.0e9; // seconds
  double wall = 1.0e9;      // seconds
  double memory = 0.0;      // GB, at most
};

Cost RunProcess(const std::vector<std::string>& words)
{
  std::vector<char*> arguments;
  for (const std::string& word : words)
  {
    arguments.push_back(const_cast<char*>(word.c_str()));
  }
  arguments.push_back(nullptr);
  const auto start = std::chrono::steady_clock::now();
  // No vfork(), which posix_spawn() uses: the child's memory would begin with this process's.
  const pid_t child = fork();
  if (child == 0)
  {
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  int status = 0;
  rusage used = {};
  if (child < 0 || wait4(child, &status, 0, &used) != child || status != 0)
  {
    Fail(words[0] + " failed");
  }
  auto seconds = [](const timeval& time)
  { return static_cast<double>(time.tv_sec) + 1.0e-6 * static_cast<double>(time.tv_usec); };
  Cost cost;
  cost.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  cost.processor = seconds(used.ru_utime) + seconds(used.ru_stime);
  cost.memory = static_cast<double>(used.ru_maxrss) * 1024.0e-9;
  return cost;
}

// A terrain as an uncompressed GeoTIFF.
void WriteHeights(int size, const std::string& fileName)
{
  const Relief relief = Terrain(size, size, TerrainSpacing);
  GDALDatasetH file = GDALCreate(GDALGetDriverByName("GTiff"), fileName.c_str(), relief.columns,
    relief.rows, 1, GDT_Float32, nullptr);
  double transform[6] = { 5.0e5, relief.spacing, 0.0, 4.0e6, 0.0, -relief.spacing };
  bool good = file && GDALSetGeoTransform(file, transform) == CE_None;
  for (int j = 0; good && j < relief.rows; ++j)
  {
    // The file's first row is the northernmost.
    const std::size_t at = static_cast<std::size_t>(relief.rows - 1 - j) * relief.columns;
    good = GDALRasterIO(GDALGetRasterBand(file, 1), GF_Write, 0, j, relief.columns, 1,
             const_cast<float*>(relief.heights.data() + at), relief.columns, 1, GDT_Float32, 0,
             0) == CE_None;
  }
  GDALClose(file);
  if (!good)
  {
    Fail("cannot write " + fileName);
  }
}

// The least of each number of several runs of several commands in turn; each makes `output` anew.
std::vector<Cost> RaceProcesses(
  const std::vector<std::vector<std::string>>& commands, const std::string& output, int repetitions)
{
  std::vector<Cost> least(commands.size());
  for (int k = -1; k < repetitions; ++k) // the first warms up
  {
    for (std::size_t c = 0; c < commands.size(); ++c)
    {
      std::remove(output.c_str());
      const Cost cost = RunProcess(commands[c]);
      if (k >= 0)
      {
        least[c].processor = std::min(least[c].processor, cost.processor);
        least[c].wall = std::min(least[c].wall, cost.wall);
        least[c].memory = std::max(least[c].memory, cost.memory);
      }
    }
  }
  std::remove(output.c_str());
  return least;
}

std::vector<Cost> CompareSize(const std::string& reliefshade, const std::string& gdaldem,
  const std::string& folder, int size, int repetitions)
{
  const std::string input = folder + "/heights.tif";
  const std::string output = folder + "/shaded.tif";
  WriteHeights(size, input);
  const std::vector<std::string> shade = { reliefshade, "--quiet", "--sun", "315,45", "--tolerance",
    "0", input, output };
  auto threads = [&](const char* number)
  {
    std::vector<std::string> words = shade;
    words.insert(words.begin() + 1, { "--threads", number });
    return words;
  };
  const std::vector<Cost> costs =
    RaceProcesses({ threads("1"), threads("2"), { gdaldem, "hillshade", "-q", input, output } },
      output, repetitions);
  std::remove(input.c_str());
  for (const Cost& cost : costs)
  {
    std::cout << "  " << size << "^2: " << std::setprecision(3) << cost.processor
              << " s of processor time, " << cost.wall << " s, " << cost.memory << " GB\n";
  }
  return costs;
}
}

int main(int argc, char* argv[])
{
  if (argc < 4)
  {
    Fail("reliefprograms RELIEFSHADE GDALDEM FOLDER [TABLE.csv [SIZE]]");
  }
  GDALAllRegister();
  const bool trial = argc > 5;
  const int size = trial ? std::atoi(argv[5]) : 16384;
  Table table;
  table.SetColumn("measured");
  const std::vector<Cost> small = CompareSize(argv[1], argv[2], argv[3], 256, trial ? 1 : 25);
  table.Add("program, 256^2, processor time, against gdaldem hillshade",
    small[0].processor / small[2].processor, "x", 1.5, Table::AtMost);
  const std::vector<Cost> large = CompareSize(argv[1], argv[2], argv[3], size, trial ? 1 : 3);
  const std::string name = "program, " + std::to_string(size) + "^2 GeoTIFF to GeoTIFF, ";
  table.Add(name + "processor time, against gdaldem", large[0].processor / large[2].processor, "x",
    2.5, Table::AtMost);
  table.Add(name + "2 threads, wall clock, against gdaldem", large[1].wall / large[2].wall, "x",
    1.5, Table::AtMost);
  table.Add(name + "peak memory", large[0].memory, " GB", 2.2, Table::AtMost);
  table.Add(name + "gdaldem's", large[2].memory, " GB", 0.0, Table::AtMost);
  table.WriteText(std::cout);
  if (argc > 4)
  {
    std::ofstream file(argv[4]);
    table.WriteCSV(file);
    file.close();
    if (!file)
    {
      Fail(std::string("cannot write ") + argv[4]);
    }
  }
  return EXIT_SUCCESS;
}
