// SPDX-License-Identifier: BSD-3-Clause
#ifndef Comparison_h
#define Comparison_h

/// @file
/// What the comparisons have in common: rivals that take turns, and the table that says how they
/// compare.

#include "BenchmarkTerrain.h"
#include "Timing.h"

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace bench
{

/// The table: what was measured with each of the sets of vector instructions, and what is expected.
class Table
{
public:
  enum Goal
  {
    AtMost,
    AtLeast
  };

  /// What is added from now on stands in this column.
  void SetColumn(const std::string& name);

  /// A ratio or a number with its unit; a goal of 0 is none.
  void Add(const std::string& name, double measured, const char* unit, double goal, Goal kind);

  void WriteText(std::ostream& out) const;
  void WriteCSV(std::ostream& out) const;

private:
  struct Row
  {
    std::string name;
    std::string goal;
    std::map<std::string, std::pair<std::string, bool>> measured; ///< by column; whether it is met
  };
  std::string Column;
  std::vector<std::string> Columns;
  std::vector<Row> Rows;
};

/// Rivals by their names.
class Contest
{
public:
  void Add(const std::string& name, double samples, const std::function<void()>& run,
    Clock clock = Clock::Thread, const std::function<void()>& before = {});

  /// Lets all take turns, and prints their times.
  void Race(int repetitions);

  /// The least time of a rival, in ns a sample.
  double operator[](const std::string& name) const { return this->Times.at(name); }

private:
  std::vector<Rival> Rivals;
  std::map<std::string, double> Times;
};

/// "name, 20"
std::string At(const std::string& name, double altitude);

/// Whole scenes through the filter: against a hillshade, against d alone, against one another.
void CompareScenes(const Relief& relief, int repetitions, Table& table);

/// Several threads against one.
void CompareThreads(const Relief& relief, int repetitions, Table& table);

}

#endif
