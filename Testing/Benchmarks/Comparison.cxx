// SPDX-License-Identifier: BSD-3-Clause
#include "Comparison.h"

#include <algorithm>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace bench
{

void Table::SetColumn(const std::string& name)
{
  this->Column = name;
  if (std::find(this->Columns.begin(), this->Columns.end(), name) == this->Columns.end())
  {
    this->Columns.push_back(name);
  }
}

void Table::Add(const std::string& name, double measured, const char* unit, double goal, Goal kind)
{
  auto found = std::find_if(
    this->Rows.begin(), this->Rows.end(), [&](const Row& row) { return row.name == name; });
  if (found == this->Rows.end())
  {
    std::ostringstream aim;
    if (goal > 0.0)
    {
      aim << (kind == AtLeast ? ">= " : "<= ") << goal << unit;
    }
    found = this->Rows.insert(found, { name, aim.str(), {} });
  }
  std::ostringstream value;
  value << std::setprecision(3) << measured << unit;
  const bool met = goal <= 0.0 || (kind == AtLeast ? measured >= goal : measured <= goal);
  found->measured[this->Column] = { value.str(), met };
}

void Table::WriteText(std::ostream& out) const
{
  out << std::left << std::setw(68) << "what" << std::right;
  for (const std::string& column : this->Columns)
  {
    out << std::setw(13) << column;
  }
  out << std::setw(12) << "goal"
      << "\n";
  for (const Row& row : this->Rows)
  {
    out << std::left << std::setw(68) << row.name << std::right;
    for (const std::string& column : this->Columns)
    {
      const auto found = row.measured.find(column);
      const bool missed = found != row.measured.end() && !found->second.second;
      out << std::setw(12) << (found == row.measured.end() ? "" : found->second.first)
          << (missed ? '!' : ' ');
    }
    out << std::setw(12) << row.goal << "\n";
  }
}

void Table::WriteCSV(std::ostream& out) const
{
  out << "what";
  for (const std::string& column : this->Columns)
  {
    out << "," << column;
  }
  out << ",goal\n";
  for (const Row& row : this->Rows)
  {
    out << "\"" << row.name << "\"";
    for (const std::string& column : this->Columns)
    {
      const auto found = row.measured.find(column);
      out << ",\"" << (found == row.measured.end() ? "" : found->second.first) << "\"";
    }
    out << ",\"" << row.goal << "\"\n";
  }
}

void Contest::Add(const std::string& name, double samples, const std::function<void()>& run,
  Clock clock, const std::function<void()>& before)
{
  Rival rival;
  rival.name = name;
  rival.samples = samples;
  rival.run = run;
  rival.clock = clock;
  rival.before = before;
  this->Rivals.push_back(rival);
}

void Contest::Race(int repetitions)
{
  bench::Race(this->Rivals, repetitions);
  for (const Rival& rival : this->Rivals)
  {
    std::cout << "  " << std::left << std::setw(48) << rival.name << std::right << std::setw(12)
              << std::setprecision(4) << rival.Least() << " ns a sample, median " << rival.Median()
              << "\n";
    this->Times[rival.name] = rival.Least();
  }
}

std::string At(const std::string& name, double altitude)
{
  return name + ", " + std::to_string(static_cast<int>(altitude));
}

}
