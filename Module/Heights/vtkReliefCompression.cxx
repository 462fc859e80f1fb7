// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefCompression.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkReliefAbort.h"
#include "vtkReliefSetters.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include "HeightInputs.h"
#include "ReliefCompression.h"

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkReliefCompression);

namespace
{
// Thrown where an observer ends the work.
struct Ended
{
};

// Returns what is wrong with the depth.
std::string Compress(const relief::hosts::HeightInputs& inputs,
  const relief::CompressionSettings& settings, const relief::ParallelFor& parallelFor,
  float background, float* result)
{
  const double* given = inputs.image->GetSpacing();
  const double spacing[2] = { given[0], given[1] };
  std::string wrong;
  relief::hosts::WithHeightSource(inputs, spacing,
    [&](const auto& heights)
    {
      const relief::UnitDepth depth = relief::ReadUnitDepth(heights, parallelFor);
      if (!(2.0 * settings.budget * depth.halfRange <= std::numeric_limits<float>::max()))
      {
        wrong = "the relief would be higher than single precision can tell; give depth in a larger "
                "unit, or a lower HeightBudget";
        return;
      }
      const std::vector<double> shares = relief::CompressDepth(depth, settings, parallelFor);
      for (std::size_t k = 0; k < shares.size(); ++k)
      {
        // Multiplied in this order the product is finite.
        result[k] = std::isnan(shares[k]) ? background
                                          : static_cast<float>(2.0 * shares[k] * depth.halfRange);
      }
    });
  return wrong;
}
}

//------------------------------------------------------------------------------
vtkReliefCompression::vtkReliefCompression()
  : NoDataValue(std::numeric_limits<double>::quiet_NaN())
{
  this->SetNumberOfInputPorts(2);
}

//------------------------------------------------------------------------------
void vtkReliefCompression::SetMethod(int method)
{
  relief::SetNumber(this, this->Method, method, method >= GradientDomain && method <= Linear,
    "0 (GradientDomain), 1 (TwoScale) or 2 (Linear)", "Method");
}

//------------------------------------------------------------------------------
void vtkReliefCompression::SetHeightBudget(double value)
{
  relief::SetNumber(this, this->HeightBudget, value, value > 0.0 && value <= 1.0,
    "a number above 0 and up to 1", "HeightBudget");
}

//------------------------------------------------------------------------------
void vtkReliefCompression::SetDetail(double value)
{
  relief::SetNumber(
    this, this->Detail, value, value >= 0.0 && value <= 1.0, "a number from 0 to 1", "Detail");
}

//------------------------------------------------------------------------------
void vtkReliefCompression::SetSilhouettes(double value)
{
  relief::SetNumber(this, this->Silhouettes, value, value >= 0.0 && value <= 1.0,
    "a number from 0 to 1", "Silhouettes");
}

//------------------------------------------------------------------------------
void vtkReliefCompression::SetJumpThreshold(double value)
{
  relief::SetNumber(this, this->JumpThreshold, value, value > 0.0 && value <= 1.0,
    "a number above 0 and up to 1", "JumpThreshold");
}

//------------------------------------------------------------------------------
void vtkReliefCompression::SetNoDataValue(double value)
{
  // NaN never equals itself.
  if (this->NoDataValue != value && !(std::isnan(value) && std::isnan(this->NoDataValue)))
  {
    this->NoDataValue = value;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkReliefCompression::SetMaskData(vtkImageData* mask)
{
  this->SetInputData(1, mask);
}

//------------------------------------------------------------------------------
void vtkReliefCompression::SetMaskConnection(vtkAlgorithmOutput* mask)
{
  this->SetInputConnection(1, mask);
}

//------------------------------------------------------------------------------
int vtkReliefCompression::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkReliefCompression::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkDataObject::SetPointDataActiveScalarInfo(outputs->GetInformationObject(0), VTK_FLOAT, 1);
  return 1;
}

//------------------------------------------------------------------------------
// Every height depends on all of the depth.
int vtkReliefCompression::RequestUpdateExtent(
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
// Loops over threads that tell of progress, and end where an observer asks for it. How many there
// will be depends on the depth: each takes what is left a little farther.
std::function<void(int, const std::function<void(int, int)>&)> vtkReliefCompression::Watched()
{
  // Copies of it count together.
  const auto left = std::make_shared<double>(1.0);
  return [this, left](int count, const std::function<void(int, int)>& body)
  {
    constexpr double usualLoops = 2000.0;
    *left *= 1.0 - 1.0 / usualLoops;
    this->UpdateProgress(1.0 - *left);
    if (vtkReliefIsAborted(this))
    {
      throw Ended();
    }
    relief::hosts::ForRows(count, body);
  };
}

//------------------------------------------------------------------------------
int vtkReliefCompression::RequestData(
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
      relief::CompressionSettings settings;
      settings.method = this->Method;
      settings.budget = this->HeightBudget;
      settings.detail = this->Detail;
      settings.silhouettes = this->Silhouettes;
      settings.jump = this->JumpThreshold;
      output->CopyStructure(heights.image);
      output->AllocateScalars(VTK_FLOAT, 1);
      vtkDataArray* result = output->GetPointData()->GetScalars();
      result->SetName(heights.scalars->GetName());
      wrong = Compress(heights, settings, this->Watched(),
        this->FillBackground ? 0.0f : std::numeric_limits<float>::quiet_NaN(),
        static_cast<float*>(result->GetVoidPointer(0)));
      output->GetFieldData()->PassData(heights.image->GetFieldData());
    }
  }
  catch (const Ended&)
  {
    output->Initialize(); // an observer asked for it
  }
  catch (const std::bad_alloc&)
  {
    wrong = "there is not enough memory to compress the depth";
  }
  if (!wrong.empty())
  {
    output->Initialize();
    vtkErrorMacro(<< wrong << ".");
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkReliefCompression::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Method: " << this->Method << "\n";
  os << indent << "HeightBudget: " << this->HeightBudget << "\n";
  os << indent << "Detail: " << this->Detail << "\n";
  os << indent << "Silhouettes: " << this->Silhouettes << "\n";
  os << indent << "JumpThreshold: " << this->JumpThreshold << "\n";
  os << indent << "FillBackground: " << this->FillBackground << "\n";
  os << indent << "NoDataValue: " << this->NoDataValue << "\n";
}
