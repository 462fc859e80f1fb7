// SPDX-License-Identifier: BSD-3-Clause
// vtkReliefAccuracyReport: the table of what a shading has as inputs and scene, refusals and
// aborts. What is measured is the model's.
#include "vtkReliefAccuracyReport.h"

#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkTable.h"

#include "ReliefTestUtilities.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace
{
int Failures = 0;

double Value(vtkReliefAccuracyReport* report, vtkIdType row, const char* column)
{
  return report->GetOutput()->GetValueByName(row, column).ToDouble();
}

//------------------------------------------------------------------------------
void TestTable()
{
  vtkNew<vtkImageReliefShading> shading;
  const auto heights = MakeHeights(60, 45, Waves);
  heights->SetSpacing(2.0, 2.0, 1.0);
  shading->SetInputData(heights);
  vtkReliefScene* scene = shading->GetScene();
  scene->AddSun(315.0, 12.0);
  scene->SetTolerance(0.002);
  vtkNew<vtkReliefAccuracyReport> report;
  report->SetShading(shading);
  report->Update();
  vtkTable* table = report->GetOutput();
  CHECK(table->GetNumberOfRows() == 17 && table->GetNumberOfColumns() == 10);
  CHECK(report->GetNumberOfSamples() == 60 * 45 - 1);
  CHECK(report->GetNumberOfComparedSamples() == 60 * 45 - 1);
  int present = 0;
  for (vtkIdType row = 0; row < table->GetNumberOfRows(); ++row)
  {
    const bool exact = row < 9;
    CHECK(table->GetValueByName(row, "Integrator").ToString() == (exact ? "Exact" : "FixedStep"));
    CHECK(std::isnan(Value(report, row, "Tolerance")) == !exact);
    CHECK(exact == (Value(report, row, "Steps") == 0.0));
    CHECK(Value(report, row, "Nanoseconds") > 0.0);
    CHECK_NEAR(Value(report, row, "Seconds"), Value(report, row, "Nanoseconds") * 2699e-9, 1e-12);
    CHECK(Value(report, row, "Samples") == 2699.0);
    CHECK(Value(report, row, "RMSError") <= Value(report, row, "LargestError"));
    CHECK(!exact || Value(report, row, "ErrorOf999") <= Value(report, row, "Tolerance") + 1e-5);
    present += Value(report, row, "Present") == 1.0 ? static_cast<int>(row) + 1 : 0;
  }
  CHECK(present == 5 && Value(report, 4, "Tolerance") == 0.002); // 0, 0.0001, 0.0003, 0.001
  CHECK(report->GetRecommendedRow() >= 0 && report->GetRecommendedRow() < 9);
  CHECK_NEAR(report->GetVisibleError(), 0.0003, 1e-5);

  // Nothing is measured again until something has changed, be it in the scene.
  const vtkMTimeType time = table->GetMTime();
  report->Update();
  CHECK(table->GetMTime() == time);
  scene->SetTolerance(0.01);
  scene->GetMaterial()->SetSubsurfaceDepth(30.0);
  report->Update();
  CHECK(table->GetMTime() != time && table->GetNumberOfRows() == 16);
  CHECK(Value(report, 5, "Present") == 1.0);
}

//------------------------------------------------------------------------------
void TestRefusals()
{
  vtkNew<vtkReliefAccuracyReport> report;
  MessageKeeper messages(report);
  auto refused = [&](const char* why)
  {
    report->Update();
    CHECK(messages.OneError(why));
    CHECK(report->GetOutput()->GetNumberOfRows() == 0 && report->GetRecommendedRow() == -1);
  };
  refused("there is no shading");
  vtkNew<vtkImageReliefShading> shading;
  report->SetShading(shading);
  refused("there are no heights");
  shading->SetInputData(
    MakeHeights(20, 10, [](int, int) { return std::numeric_limits<double>::quiet_NaN(); }));
  MessageKeeper warnings(shading);
  refused("no sample has data");
  CHECK(warnings.OneWarning("No sample has data"));
}

//------------------------------------------------------------------------------
void TestAbort()
{
  vtkNew<vtkImageReliefShading> shading;
  shading->SetInputData(MakeHeights(60, 45, Waves));
  vtkNew<vtkReliefAccuracyReport> report;
  report->SetShading(shading);
  ProgressKeeper progress(report);
  progress.StopAbove = 0.3;
  report->Update();
  // The end, 1, is announced by the pipelines of newer VTKs.
  auto wentOn = [](double step) { return step >= 0.5 && step < 1.0; };
  CHECK(
    !progress.Steps.empty() && std::none_of(progress.Steps.begin(), progress.Steps.end(), wentOn));
  CHECK(report->GetOutput()->GetNumberOfRows() == 0);
  progress.StopAbove = 1.0;
  report->Modified();
  report->Update();
  CHECK(progress.Steps.back() == 1.0 && report->GetOutput()->GetNumberOfRows() == 16);
}
}

//------------------------------------------------------------------------------
int TestReliefAccuracyReport(int, char*[])
{
  TestTable();
  TestRefusals();
  TestAbort();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
