// SPDX-License-Identifier: BSD-3-Clause
#ifndef AccuracyTable_h
#define AccuracyTable_h

#include "vtkType.h"

#include <string>
#include <vector>

class vtkReliefAccuracyReport;

namespace reliefshade
{

/// A row of a report's table.
struct AccuracyRow
{
  bool Exact = true;
  double Tolerance = 0.0;
  int Steps = 0;
  bool Present = false;
  bool Recommended = false;
  double Nanoseconds = 0.0;
  double Seconds = 0.0;
  double ErrorOf999 = 0.0;
  double LargestError = 0.0;
  double RmsError = 0.0;
  vtkIdType Samples = 0;
};

/// What was measured.
struct AccuracyTable
{
  std::vector<AccuracyRow> Rows;
  vtkTypeInt64 Samples = 0;  ///< of the field that have data
  vtkTypeInt64 Compared = 0; ///< of these, at most
  unsigned int Seed = 0;
  double VisibleError = 0.0;
};

AccuracyTable readTable(vtkReliefAccuracyReport* report);

/// A number as people read it, with so many significant digits and without trailing zeros.
std::string brief(double number, int digits);

/// As it is typed: --tolerance 0.001.
std::string optionOf(const AccuracyRow& row);

/// Which setting to take, and why, in a few sentences.
std::string adviceOf(const AccuracyTable& table);

/// The numbers alone: a line of names, and one for each row.
std::string toCsv(const AccuracyTable& table);

}

#endif
