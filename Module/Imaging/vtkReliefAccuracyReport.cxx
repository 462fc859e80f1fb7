// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefAccuracyReport.h"

#include "vtkDoubleArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageReliefShading.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkReliefAbort.h"
#include "vtkReliefColumns.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include "AccuracyReport.h"
#include "HeightInputs.h"
#include "PictureExposure.h"

#include <algorithm>
#include <limits>
#include <new>

vtkStandardNewMacro(vtkReliefAccuracyReport);

namespace
{
void FillTable(const std::vector<relief::AccuracyPoint>& points, vtkTable* table)
{
  auto* integrators = vtkReliefAddColumn<vtkStringArray>(table, "Integrator");
  auto* tolerances = vtkReliefAddColumn<vtkDoubleArray>(table, "Tolerance");
  auto* steps = vtkReliefAddColumn<vtkIntArray>(table, "Steps");
  auto* present = vtkReliefAddColumn<vtkIntArray>(table, "Present");
  auto* nanoseconds = vtkReliefAddColumn<vtkDoubleArray>(table, "Nanoseconds");
  auto* seconds = vtkReliefAddColumn<vtkDoubleArray>(table, "Seconds");
  auto* mostOf999 = vtkReliefAddColumn<vtkDoubleArray>(table, "ErrorOf999");
  auto* most = vtkReliefAddColumn<vtkDoubleArray>(table, "LargestError");
  auto* rms = vtkReliefAddColumn<vtkDoubleArray>(table, "RMSError");
  auto* samples = vtkReliefAddColumn<vtkIdTypeArray>(table, "Samples");
  for (const relief::AccuracyPoint& point : points)
  {
    const bool exact = point.integrator == relief::Integrator::Exact;
    integrators->InsertNextValue(exact ? "Exact" : "FixedStep");
    tolerances->InsertNextValue(exact ? point.tolerance : std::numeric_limits<double>::quiet_NaN());
    steps->InsertNextValue(point.steps);
    present->InsertNextValue(point.present ? 1 : 0);
    nanoseconds->InsertNextValue(point.nanoseconds);
    seconds->InsertNextValue(point.seconds);
    mostOf999->InsertNextValue(point.mostOf999);
    most->InsertNextValue(point.most);
    rms->InsertNextValue(point.rms);
    samples->InsertNextValue(static_cast<vtkIdType>(point.compared));
  }
}
}

//------------------------------------------------------------------------------
vtkReliefAccuracyReport::vtkReliefAccuracyReport()
{
  this->SetNumberOfInputPorts(0);
}

//------------------------------------------------------------------------------
vtkReliefAccuracyReport::~vtkReliefAccuracyReport() = default;

//------------------------------------------------------------------------------
void vtkReliefAccuracyReport::SetShading(vtkImageReliefShading* shading)
{
  if (this->Shading != shading)
  {
    this->Shading = shading;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkImageReliefShading* vtkReliefAccuracyReport::GetShading()
{
  return this->Shading;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkReliefAccuracyReport::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->Shading ? std::max(own, this->Shading->GetPipelineMTime()) : own;
}

//------------------------------------------------------------------------------
// Returns an empty text, or what is wrong.
std::string vtkReliefAccuracyReport::Measure(vtkTable* table)
{
  const relief::HeightField* field = nullptr;
  relief::Scene scene;
  const std::string wrong = this->Shading ? this->Shading->PrepareModel(field, scene)
                                          : "there is no shading to measure; SetShading() gives it";
  if (!wrong.empty() || !field->HasData())
  {
    return wrong.empty() ? "no sample has data, so there is nothing to measure" : wrong;
  }
  scene.exposure = relief::hosts::FindExposure(this->Shading->GetScene(), *field, scene).stops;
  relief::AccuracyReport report(*field, scene, this->Seed);
  const bool whole = report.Measure(relief::hosts::ForRows,
    [this](double done)
    {
      this->UpdateProgress(done);
      return !vtkReliefIsAborted(this);
    });
  if (whole)
  {
    FillTable(report.GetPoints(), table);
    this->RecommendedRow = static_cast<vtkIdType>(report.GetRecommended());
    this->VisibleError = report.GetVisibleError();
    this->NumberOfSamples = static_cast<vtkTypeInt64>(report.GetNumberOfSamples());
    this->NumberOfComparedSamples = static_cast<vtkTypeInt64>(report.GetNumberOfProbes());
  }
  return std::string();
}

//------------------------------------------------------------------------------
int vtkReliefAccuracyReport::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkTable* table = vtkTable::GetData(outputs);
  table->Initialize();
  this->RecommendedRow = -1;
  this->VisibleError = 0.0;
  this->NumberOfSamples = 0;
  this->NumberOfComparedSamples = 0;
  std::string wrong;
  try
  {
    wrong = this->Measure(table);
  }
  catch (const std::bad_alloc&)
  {
    table->Initialize();
    wrong = "there is not enough memory to measure the shading";
  }
  if (!wrong.empty())
  {
    vtkErrorMacro(<< wrong << ".");
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkReliefAccuracyReport::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Shading: " << this->Shading << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "RecommendedRow: " << this->RecommendedRow << "\n";
  os << indent << "VisibleError: " << this->VisibleError << "\n";
  os << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n";
  os << indent << "NumberOfComparedSamples: " << this->NumberOfComparedSamples << "\n";
}
