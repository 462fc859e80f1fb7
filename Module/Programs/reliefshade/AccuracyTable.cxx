// SPDX-License-Identifier: BSD-3-Clause
#include "AccuracyTable.h"

#include "vtkReliefAccuracyReport.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cstdio>

namespace reliefshade
{

//------------------------------------------------------------------------------
AccuracyTable readTable(vtkReliefAccuracyReport* report)
{
  vtkTable* values = report->GetOutput();
  AccuracyTable table;
  table.Samples = report->GetNumberOfSamples();
  table.Compared = report->GetNumberOfComparedSamples();
  table.Seed = report->GetSeed();
  table.VisibleError = report->GetVisibleError();
  for (vtkIdType at = 0; at < values->GetNumberOfRows(); ++at)
  {
    const auto value = [&](const char* column) { return values->GetValueByName(at, column); };
    AccuracyRow row;
    row.Exact = value("Integrator").ToString() == "Exact";
    row.Tolerance = value("Tolerance").ToDouble();
    row.Steps = value("Steps").ToInt();
    row.Present = value("Present").ToInt() != 0;
    row.Recommended = at == report->GetRecommendedRow();
    row.Nanoseconds = value("Nanoseconds").ToDouble();
    row.Seconds = value("Seconds").ToDouble();
    row.ErrorOf999 = value("ErrorOf999").ToDouble();
    row.LargestError = value("LargestError").ToDouble();
    row.RmsError = value("RMSError").ToDouble();
    row.Samples = static_cast<vtkIdType>(value("Samples").ToLongLong());
    table.Rows.push_back(row);
  }
  return table;
}

//------------------------------------------------------------------------------
std::string brief(double number, int digits)
{
  char text[64];
  std::snprintf(text, sizeof text, "%.*g", digits, number);
  return text;
}

//------------------------------------------------------------------------------
std::string optionOf(const AccuracyRow& row)
{
  return row.Exact ? "--tolerance " + brief(row.Tolerance, 9)
                   : "--integrator fixed-step --steps " + std::to_string(row.Steps);
}

//------------------------------------------------------------------------------
std::string adviceOf(const AccuracyTable& table)
{
  const auto find = [&table](bool AccuracyRow::*flag)
  {
    return std::find_if(
      table.Rows.begin(), table.Rows.end(), [flag](const AccuracyRow& row) { return row.*flag; });
  };
  const auto best = find(&AccuracyRow::Recommended);
  const auto present = find(&AccuracyRow::Present);
  if (best == table.Rows.end() || present == table.Rows.end())
  {
    return std::string();
  }
  const bool hidden = best->ErrorOf999 <= table.VisibleError;
  std::string text = "Take " + std::string(present->Exact ? "" : "--integrator exact ") +
    optionOf(*best) + ": 99.9 % of the samples err by no more than " + brief(best->ErrorOf999, 2) +
    ", " + (hidden ? "less than" : "while") + " a step of an 8-bit picture in its darkest tones" +
    (hidden ? " (" : " is ") + brief(table.VisibleError, 2) + (hidden ? ")" : "") +
    ", and no setting of which that is true is quicker by more than a tenth.";
  if (best->Present)
  {
    return text + " It is what you have.";
  }
  if (present->Exact && present->ErrorOf999 <= table.VisibleError &&
    present->Nanoseconds <= 1.1 * best->Nanoseconds)
  {
    return text + " What you have, " + optionOf(*present) + ", does as well.";
  }
  return text + " What you have, " + optionOf(*present) + ", takes " +
    brief(present->Nanoseconds / best->Nanoseconds, 2) + " times as long and errs by " +
    brief(present->ErrorOf999, 2) + ".";
}

//------------------------------------------------------------------------------
std::string toCsv(const AccuracyTable& table)
{
  std::string text = "integrator,tolerance,steps,present,recommended,nanoseconds_per_sample,"
                     "seconds,error_999,error_largest,error_rms,samples,seed\n";
  for (const AccuracyRow& row : table.Rows)
  {
    text += (row.Exact ? "exact," + brief(row.Tolerance, 9) + ","
                       : "fixed-step,," + std::to_string(row.Steps)) +
      "," + (row.Present ? "1," : "0,") + (row.Recommended ? "1," : "0,") +
      brief(row.Nanoseconds, 6) + "," + brief(row.Seconds, 6) + "," + brief(row.ErrorOf999, 6) +
      "," + brief(row.LargestError, 6) + "," + brief(row.RmsError, 6) + "," +
      std::to_string(row.Samples) + "," + std::to_string(table.Seed) + "\n";
  }
  return text;
}

}
