// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefImageMapper.h"

#include "vtkCommand.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMath.h"
#include "vtkMatrix4x4.h"
#include "vtkObjectFactory.h"
#include "vtkPlane.h"
#include "vtkReliefScene.h"
#include "vtkReliefSetters.h"
#include "vtkReliefStatistics.h"
#include "vtkScalarsToColors.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include "HostInputs.h"

#include <algorithm>

vtkAbstractObjectFactoryNewMacro(vtkReliefImageMapper);

static_assert(
  static_cast<int>(vtkReliefImageMapper::ConvergedEvent) > static_cast<int>(vtkCommand::UserEvent));

//------------------------------------------------------------------------------
vtkReliefImageMapper::vtkReliefImageMapper()
  : Inputs(new relief::hosts::HostInputs(this))
{
  this->SetNumberOfInputPorts(relief::hosts::HostInputs::NumberOfPorts);
  relief::hosts::HostInputs::NameArrays(this);
  // The executive updates only what has an output.
  this->SetNumberOfOutputPorts(1);
}

//------------------------------------------------------------------------------
vtkReliefImageMapper::~vtkReliefImageMapper() = default;

//------------------------------------------------------------------------------
void vtkReliefImageMapper::SetScene(vtkReliefScene* scene)
{
  this->Inputs->SetScene(scene);
}

//------------------------------------------------------------------------------
vtkReliefScene* vtkReliefImageMapper::GetScene()
{
  return this->Inputs->GetScene();
}

//------------------------------------------------------------------------------
void vtkReliefImageMapper::SetNoDataValue(double value)
{
  this->Inputs->SetNoDataValue(value, this->NoDataValue, this->UseNoDataValue);
}

//------------------------------------------------------------------------------
void vtkReliefImageMapper::SetLookupTable(vtkScalarsToColors* table)
{
  this->Inputs->SetLookupTable(table);
}

//------------------------------------------------------------------------------
vtkScalarsToColors* vtkReliefImageMapper::GetLookupTable()
{
  return this->Inputs->GetLookupTable();
}

//------------------------------------------------------------------------------
void vtkReliefImageMapper::SetProgressiveFrameTime(double seconds)
{
  relief::SetNumber(this, this->ProgressiveFrameTime, seconds, seconds > 0.0,
    "a finite number above 0", "ProgressiveFrameTime");
}

//------------------------------------------------------------------------------
void vtkReliefImageMapper::SetTracing(int device)
{
  relief::SetNumber(this, this->Tracing, device,
    device >= TraceAutomatically && device <= TraceOnProcessor,
    "0 (automatic), 1 (graphics processor) or 2 (processor)", "Tracing");
}

//------------------------------------------------------------------------------
vtkReliefStatistics* vtkReliefImageMapper::GetStatistics()
{
  return this->Statistics;
}

//------------------------------------------------------------------------------
void vtkReliefImageMapper::SetProgressOfPicture(bool converged, double refinement)
{
  const bool completed = converged && !this->Converged;
  this->Converged = converged;
  this->Refinement = refinement;
  if (completed)
  {
    this->InvokeEvent(ConvergedEvent);
  }
}

//------------------------------------------------------------------------------
vtkMTimeType vtkReliefImageMapper::GetMTime()
{
  return this->Inputs->GetMTime(this->Superclass::GetMTime());
}

//------------------------------------------------------------------------------
int vtkReliefImageMapper::FillInputPortInformation(int port, vtkInformation* info)
{
  return relief::hosts::HostInputs::FillPort(port, info);
}

//------------------------------------------------------------------------------
vtkTypeBool vtkReliefImageMapper::ProcessRequest(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
  {
    this->Superclass::ProcessRequest(request, inputs, outputs);
    this->UpdateSlice();
    return 1;
  }
  if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_EXTENT()))
  {
    relief::hosts::HostInputs::AskForAll(inputs);
    return 1;
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    // The output is there for the executive only.
    vtkInformation* info = outputs->GetInformationObject(0);
    vtkDataObject* output = info->Get(vtkDataObject::DATA_OBJECT());
    if (output && info->Has(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()))
    {
      output->GetInformation()->Set(vtkDataObject::DATA_EXTENT(),
        info->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT()), 6);
    }
    return 1;
  }
  return this->Superclass::ProcessRequest(request, inputs, outputs);
}

//------------------------------------------------------------------------------
// Finds what is shown of the whole extent, and the plane in which it lies.
void vtkReliefImageMapper::UpdateSlice()
{
  std::copy_n(this->DataWholeExtent, 6, this->DisplayExtent);
  for (int axis = 0; this->Cropping && axis < 3; ++axis)
  {
    int* range = this->DisplayExtent + 2 * axis;
    range[0] = std::max(range[0], this->CroppingRegion[2 * axis]);
    range[1] = std::min(range[1], this->CroppingRegion[2 * axis + 1]);
  }
  double corners[3][3];
  for (int k = 0; k < 3; ++k)
  {
    const double index[3] = { this->DisplayExtent[0] + (k == 1 ? 1.0 : 0.0),
      this->DisplayExtent[2] + (k == 2 ? 1.0 : 0.0), static_cast<double>(this->DisplayExtent[4]) };
    vtkImageData::TransformContinuousIndexToPhysicalPoint(index[0], index[1], index[2],
      this->DataOrigin, this->DataSpacing, this->DataDirection, corners[k]);
    double point[4] = { corners[k][0], corners[k][1], corners[k][2], 1.0 };
    this->GetDataToWorldMatrix()->MultiplyPoint(point, point);
    std::transform(point, point + 3, corners[k], [&](double c) { return c / point[3]; });
  }
  double along[2][3];
  double normal[3];
  vtkMath::Subtract(corners[1], corners[0], along[0]);
  vtkMath::Subtract(corners[2], corners[0], along[1]);
  vtkMath::Cross(along[0], along[1], normal);
  vtkMath::Normalize(normal);
  this->SlicePlane->SetOrigin(corners[0]);
  this->SlicePlane->SetNormal(normal);
}

//------------------------------------------------------------------------------
void vtkReliefImageMapper::GetIndexBounds(double extent[6])
{
  if (!this->GetInput())
  {
    return;
  }
  this->UpdateInformation();
  const double border = this->Border ? 0.5 : 0.0;
  for (int k = 0; k < 6; ++k)
  {
    const double outward = k % 2 == 0 ? -border : border;
    extent[k] = this->DisplayExtent[k] + (k < 4 ? outward : 0.0);
  }
}

//------------------------------------------------------------------------------
double* vtkReliefImageMapper::GetBounds()
{
  vtkMath::UninitializeBounds(this->Bounds);
  if (!this->GetInput())
  {
    return this->Bounds;
  }
  double extent[6];
  this->GetIndexBounds(extent);
  if (extent[0] > extent[1] || extent[2] > extent[3])
  {
    return this->Bounds;
  }
  for (int corner = 0; corner < 4; ++corner)
  {
    double point[3];
    vtkImageData::TransformContinuousIndexToPhysicalPoint(extent[corner & 1],
      extent[2 + (corner >> 1)], extent[4], this->DataOrigin, this->DataSpacing,
      this->DataDirection, point);
    for (int axis = 0; axis < 3; ++axis)
    {
      double* range = this->Bounds + 2 * axis;
      range[0] = corner == 0 ? point[axis] : std::min(range[0], point[axis]);
      range[1] = corner == 0 ? point[axis] : std::max(range[1], point[axis]);
    }
  }
  return this->Bounds;
}

//------------------------------------------------------------------------------
void vtkReliefImageMapper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  auto printSwitch = [&](const char* name, bool on)
  { os << indent << name << ": " << (on ? "On" : "Off") << "\n"; };
  this->Inputs->Print(
    os, indent, { this->UseNoDataValue, this->NoDataValue, this->StretchTextures });
  printSwitch("Cropping", this->Cropping);
  os << indent << "CroppingRegion: (";
  for (int k = 0; k < 6; ++k)
  {
    os << this->CroppingRegion[k] << (k < 5 ? ", " : ")\n");
  }
  printSwitch("SRGBEncoding", this->SRGBEncoding);
  os << indent << "CacheMemoryLimit: " << this->CacheMemoryLimit << "\n";
  printSwitch("Progressive", this->Progressive);
  os << indent << "ProgressiveFrameTime: " << this->ProgressiveFrameTime << "\n";
  const char* const devices[] = { "Automatic", "GraphicsProcessor", "Processor" };
  os << indent << "Tracing: " << devices[this->Tracing] << "\n";
  os << indent << "Converged: " << (this->Converged ? "Yes" : "No") << "\n";
  os << indent << "Refinement: " << this->Refinement << "\n";
  os << indent << "Statistics:\n";
  this->Statistics->PrintSelf(os, indent.GetNextIndent());
}
