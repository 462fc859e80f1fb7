// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefStepSmoothing.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkReliefSetters.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include "HeightInputs.h"
#include "HeightSteps.h"

#include <cmath>
#include <limits>
#include <new>
#include <string>

vtkStandardNewMacro(vtkReliefStepSmoothing);

namespace
{
// Which type holds fractions of the type's steps.
int OutputType(int inputType)
{
  switch (inputType)
  {
    case VTK_CHAR:
    case VTK_SIGNED_CHAR:
    case VTK_UNSIGNED_CHAR:
    case VTK_SHORT:
    case VTK_UNSIGNED_SHORT:
    case VTK_FLOAT:
      return VTK_FLOAT;
    default:
      return VTK_DOUBLE;
  }
}

// Returns the step that was used.
double Smooth(const relief::hosts::HeightInputs& inputs, double step, vtkDataArray* result)
{
  const double spacing[2] = { 1.0, 1.0 };
  relief::hosts::WithHeightSource(inputs, spacing,
    [&](const auto& heights)
    {
      step = step > 0.0 ? step : relief::FindHeightSteps(heights).step;
      // Heights that are all the same have no steps; any would do.
      const double used = step > 0.0 ? step : 1.0;
      void* values = result->GetVoidPointer(0);
      if (result->GetDataType() == VTK_FLOAT)
      {
        relief::SmoothHeightSteps(
          heights, used, relief::hosts::ForRows, static_cast<float*>(values));
      }
      else
      {
        relief::SmoothHeightSteps(
          heights, used, relief::hosts::ForRows, static_cast<double*>(values));
      }
    });
  return step;
}
}

//------------------------------------------------------------------------------
vtkReliefStepSmoothing::vtkReliefStepSmoothing()
  : NoDataValue(std::numeric_limits<double>::quiet_NaN())
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
void vtkReliefStepSmoothing::SetStep(double value)
{
  relief::SetNumber(this, this->Step, value, value >= 0.0, "a finite number of at least 0", "Step");
}

//------------------------------------------------------------------------------
void vtkReliefStepSmoothing::SetNoDataValue(double value)
{
  // NaN never equals itself.
  if (this->NoDataValue != value && !(std::isnan(value) && std::isnan(this->NoDataValue)))
  {
    this->NoDataValue = value;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkReliefStepSmoothing::SetMaskData(vtkImageData* mask)
{
  this->SetInputData(1, mask);
}

//------------------------------------------------------------------------------
void vtkReliefStepSmoothing::SetMaskConnection(vtkAlgorithmOutput* mask)
{
  this->SetInputConnection(1, mask);
}

//------------------------------------------------------------------------------
int vtkReliefStepSmoothing::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkReliefStepSmoothing::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* scalars =
    vtkDataObject::GetActiveFieldInformation(inputs[0]->GetInformationObject(0),
      vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  const bool known = scalars && scalars->Has(vtkDataObject::FIELD_ARRAY_TYPE());
  vtkDataObject::SetPointDataActiveScalarInfo(outputs->GetInformationObject(0),
    known ? OutputType(scalars->Get(vtkDataObject::FIELD_ARRAY_TYPE())) : VTK_FLOAT, 1);
  return 1;
}

//------------------------------------------------------------------------------
// Terraces are as wide as they like: all of the input is asked for.
int vtkReliefStepSmoothing::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  for (int port = 0; port < 2; ++port)
  {
    if (vtkInformation* info = inputs[port]->GetInformationObject(0))
    {
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(),
        info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()), 6);
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkReliefStepSmoothing::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkImageData* output = vtkImageData::GetData(outputs, 0);
  output->Initialize();
  relief::hosts::HeightInputs heights;
  heights.image = vtkImageData::GetData(inputs[0]);
  heights.scalars = heights.image->GetPointData()->GetScalars();
  heights.mask = vtkImageData::GetData(inputs[1]);
  heights.maskScalars = heights.mask ? heights.mask->GetPointData()->GetScalars() : nullptr;
  heights.useNoData = true;
  heights.noData = this->NoDataValue;
  std::string wrong = relief::hosts::CheckHeights(heights);
  try
  {
    if (wrong.empty())
    {
      output->CopyStructure(heights.image);
      output->AllocateScalars(OutputType(heights.scalars->GetDataType()), 1);
      vtkDataArray* result = output->GetPointData()->GetScalars();
      result->SetName(heights.scalars->GetName());
      this->UsedStep = Smooth(heights, this->Step, result);
      output->GetFieldData()->PassData(heights.image->GetFieldData());
    }
  }
  catch (const std::bad_alloc&)
  {
    wrong = "there is not enough memory to smooth the heights";
  }
  if (!wrong.empty())
  {
    output->Initialize();
    vtkErrorMacro(<< wrong << ".");
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkReliefStepSmoothing::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Step: " << this->Step << "\n";
  os << indent << "NoDataValue: " << this->NoDataValue << "\n";
  os << indent << "UsedStep: " << this->UsedStep << "\n";
}
