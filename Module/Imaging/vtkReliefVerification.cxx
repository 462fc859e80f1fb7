// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefVerification.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkImageReliefShading.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkReliefAbort.h"
#include "vtkReliefColumns.h"
#include "vtkReliefThreads.h"
#include "vtkTable.h"

#include "IlluminationCheck.h"

#include <algorithm>
#include <new>

vtkStandardNewMacro(vtkReliefVerification);

namespace
{
// `extent` is that of the heights, from whose first sample the model counts.
void FillTable(const relief::IlluminationCheck& check, const int* extent, vtkTable* table)
{
  auto* columns = vtkReliefAddColumn<vtkIntArray>(table, "Column");
  auto* rows = vtkReliefAddColumn<vtkIntArray>(table, "Row");
  auto* illuminations = vtkReliefAddColumn<vtkDoubleArray>(table, "Illumination");
  auto* references = vtkReliefAddColumn<vtkDoubleArray>(table, "Reference");
  auto* errors = vtkReliefAddColumn<vtkDoubleArray>(table, "Error");
  auto* grazing = vtkReliefAddColumn<vtkIntArray>(table, "Grazing");
  for (const relief::IlluminationCheck::Sample& sample : check.GetSamples())
  {
    columns->InsertNextValue(sample.i + extent[0]);
    rows->InsertNextValue(sample.j + extent[2]);
    illuminations->InsertNextValue(sample.d);
    references->InsertNextValue(sample.reference);
    errors->InsertNextValue(sample.error);
    grazing->InsertNextValue(sample.grazing ? 1 : 0);
  }
}
}

//------------------------------------------------------------------------------
vtkReliefVerification::vtkReliefVerification()
{
  this->SetNumberOfInputPorts(0);
}

//------------------------------------------------------------------------------
vtkReliefVerification::~vtkReliefVerification() = default;

//------------------------------------------------------------------------------
void vtkReliefVerification::SetShading(vtkImageReliefShading* shading)
{
  if (this->Shading != shading)
  {
    this->Shading = shading;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkImageReliefShading* vtkReliefVerification::GetShading()
{
  return this->Shading;
}

//------------------------------------------------------------------------------
void vtkReliefVerification::SetNumberOfSamples(vtkTypeInt64 count)
{
  if (count < 1)
  {
    vtkErrorMacro("SetNumberOfSamples: " << count
                                         << " was given, a number of at least 1 is expected; "
                                         << this->NumberOfSamples << " is kept.");
  }
  else if (this->NumberOfSamples != count)
  {
    this->NumberOfSamples = count;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkMTimeType vtkReliefVerification::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->Shading ? std::max(own, this->Shading->GetPipelineMTime()) : own;
}

//------------------------------------------------------------------------------
void vtkReliefVerification::Forget()
{
  this->Kept = false;
  this->LargestError = 0.0;
  this->WorstColumn = -1;
  this->WorstRow = -1;
  this->PromisedError = 0.0;
  this->RoundingError = 0.0;
  this->NumberOfRetracedSamples = 0;
  this->NumberOfGrazingSamples = 0;
}

//------------------------------------------------------------------------------
// Returns an empty text, or what is wrong.
std::string vtkReliefVerification::Verify(vtkTable* table)
{
  if (!this->Shading)
  {
    return "there is no shading to verify; SetShading() gives it";
  }

  // What was shaded, and the field and scene that it is of.
  const relief::HeightField* field = nullptr;
  relief::Scene scene;
  std::string wrong = this->Shading->PrepareModel(field, scene);
  if (wrong.empty() && !this->Shading->GetGenerateIllumination())
  {
    wrong = "the shading has no layer Illumination; its GenerateIlluminationOn() makes it";
  }
  if (wrong.empty() && scene.integrator != relief::Integrator::Exact)
  {
    wrong = "fixed steps promise no accuracy; the scene's integrator Exact does";
  }
  if (!wrong.empty())
  {
    return wrong;
  }
  this->Shading->Update();
  wrong = this->Shading->PrepareModel(field, scene);
  vtkImageData* output = this->Shading->GetOutput();
  auto* layer = vtkFloatArray::SafeDownCast(output->GetPointData()->GetArray("Illumination"));
  if (!wrong.empty() || !layer)
  {
    return wrong.empty() ? "the shading has been ended before it gave a picture" : wrong;
  }
  const int* extent =
    vtkImageData::SafeDownCast(this->Shading->GetInputDataObject(0, 0))->GetExtent();
  const int* shaded = output->GetExtent();
  relief::IlluminationCheck::Part part;
  part.i0 = shaded[0] - extent[0];
  part.j0 = shaded[2] - extent[2];
  part.columns = shaded[1] - shaded[0] + 1;
  part.rows = shaded[3] - shaded[2] + 1;
  part.illumination = layer->GetPointer(0);

  // Block by block, that observers may end it.
  relief::IlluminationCheck check(
    *field, scene, part, static_cast<std::size_t>(this->NumberOfSamples), this->Seed);
  const auto count = static_cast<vtkIdType>(check.GetNumberOfSamples());
  constexpr vtkIdType block = 256;
  for (vtkIdType begin = 0; begin < count; begin += block)
  {
    const vtkIdType end = std::min(begin + block, count);
    vtkReliefFor(begin, end, 1,
      [&](vtkIdType from, vtkIdType to)
      { check.Retrace(static_cast<std::size_t>(from), static_cast<std::size_t>(to)); });
    this->UpdateProgress(static_cast<double>(end) / static_cast<double>(count));
    if (vtkReliefIsAborted(this))
    {
      return std::string();
    }
  }

  FillTable(check, extent, table);
  this->Kept = check.IsKept();
  this->PromisedError = check.GetTolerance() + check.GetRounding();
  this->RoundingError = check.GetRounding();
  this->NumberOfRetracedSamples = count;
  this->NumberOfGrazingSamples = static_cast<vtkTypeInt64>(check.CountGrazing());
  if (const relief::IlluminationCheck::Sample* worst = check.GetWorst())
  {
    this->LargestError = worst->error;
    this->WorstColumn = worst->i + extent[0];
    this->WorstRow = worst->j + extent[2];
  }
  return std::string();
}

//------------------------------------------------------------------------------
int vtkReliefVerification::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkTable* table = vtkTable::GetData(outputs);
  table->Initialize();
  this->Forget();
  std::string wrong;
  try
  {
    wrong = this->Verify(table);
  }
  catch (const std::bad_alloc&)
  {
    table->Initialize();
    this->Forget();
    wrong = "there is not enough memory to verify the shading";
  }
  if (!wrong.empty())
  {
    vtkErrorMacro(<< wrong << ".");
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkReliefVerification::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Shading: " << this->Shading << "\n";
  os << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Kept: " << (this->Kept ? "On" : "Off") << "\n";
  os << indent << "LargestError: " << this->LargestError << "\n";
  os << indent << "WorstColumn: " << this->WorstColumn << "\n";
  os << indent << "WorstRow: " << this->WorstRow << "\n";
  os << indent << "PromisedError: " << this->PromisedError << "\n";
  os << indent << "RoundingError: " << this->RoundingError << "\n";
  os << indent << "NumberOfRetracedSamples: " << this->NumberOfRetracedSamples << "\n";
  os << indent << "NumberOfGrazingSamples: " << this->NumberOfGrazingSamples << "\n";
}
