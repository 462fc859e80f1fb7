// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVReliefRepresentation.h"

#include "vtkAlgorithmOutput.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkImageProperty.h"
#include "vtkImageSlice.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix3x3.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkOpenGLReliefImageMapper.h"
#include "vtkPVReliefScene.h"
#include "vtkPVRenderView.h"
#include "vtkPVView.h"
#include "vtkRenderer.h"
#include "vtkScalarsToColors.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include "GatheredSamples.h"

#include <algorithm>
#include <limits>
#include <string>

vtkStandardNewMacro(vtkPVReliefRepresentation);

namespace
{
// What is sent to the client keeps six digits of an image's origin and spacing only.
constexpr const char* FrameName = "ReliefFrame";
}

class vtkPVReliefRepresentation::Internals
{
public:
  // Named outright: no object factory has to be registered in each of ParaView's programs.
  vtkNew<vtkOpenGLReliefImageMapper> Mapper;
  vtkSmartPointer<vtkScalarsToColors> Table;
  relief::paraview::ArrayChoice Choice;
  int Slice = 0;
  bool Tint = false;
  bool UseNoData = false;
  double NoData = 0.0;
  relief::paraview::KeptSamples Heights; // of this process, whole
  vtkNew<vtkImageData> Shown;            // what is drawn
  vtkImageData* Delivered = nullptr;     // what that was made from
  vtkMTimeType DeliveredTime = 0;
};

//------------------------------------------------------------------------------
vtkPVReliefRepresentation::vtkPVReliefRepresentation()
  : Internal(new Internals)
{
  this->Internal->Mapper->ProgressiveOff();
  this->Actor->SetMapper(this->Internal->Mapper);
}

//------------------------------------------------------------------------------
vtkPVReliefRepresentation::~vtkPVReliefRepresentation() = default;

//------------------------------------------------------------------------------
void vtkPVReliefRepresentation::SetInputArrayToProcess(
  int, int, int, int association, const char* name)
{
  this->Internal->Choice = relief::paraview::ChooseArray(association, name);
  this->MarkModified();
}

//------------------------------------------------------------------------------
void vtkPVReliefRepresentation::SetSlice(int slice)
{
  if (this->Internal->Slice != slice)
  {
    this->Internal->Slice = slice;
    this->MarkModified();
  }
}

//------------------------------------------------------------------------------
void vtkPVReliefRepresentation::SetScene(vtkReliefScene* scene)
{
  if (scene)
  {
    this->Internal->Mapper->SetScene(scene);
  }
}

void vtkPVReliefRepresentation::SetLampPosition(double x, double y, double z)
{
  if (auto* scene = vtkPVReliefScene::SafeDownCast(this->Internal->Mapper->GetScene()))
  {
    scene->SetLampPosition(x, y, z);
  }
}

void vtkPVReliefRepresentation::SetTint(bool tint)
{
  this->Internal->Tint = tint;
}

void vtkPVReliefRepresentation::SetLookupTable(vtkScalarsToColors* table)
{
  this->Internal->Table = table;
}

void vtkPVReliefRepresentation::SetUseHeightWithoutData(bool use)
{
  this->Internal->UseNoData = use;
}

void vtkPVReliefRepresentation::SetHeightWithoutData(double value)
{
  this->Internal->NoData = value;
}

void vtkPVReliefRepresentation::SetProgressive(bool progressive)
{
  this->Internal->Mapper->SetProgressive(progressive);
}

void vtkPVReliefRepresentation::SetTracing(int device)
{
  this->Internal->Mapper->SetTracing(device);
}

//------------------------------------------------------------------------------
void vtkPVReliefRepresentation::SetInterpolate(bool interpolate)
{
  this->Actor->GetProperty()->SetInterpolationType(
    interpolate ? VTK_LINEAR_INTERPOLATION : VTK_NEAREST_INTERPOLATION);
}

void vtkPVReliefRepresentation::SetOpacity(double opacity)
{
  this->Actor->GetProperty()->SetOpacity(opacity);
}

void vtkPVReliefRepresentation::SetPickable(int pickable)
{
  this->Actor->SetPickable(pickable);
}

void vtkPVReliefRepresentation::SetPosition(double x, double y, double z)
{
  this->Actor->SetPosition(x, y, z);
}

void vtkPVReliefRepresentation::SetScale(double x, double y, double z)
{
  this->Actor->SetScale(x, y, z);
}

void vtkPVReliefRepresentation::SetOrientation(double x, double y, double z)
{
  this->Actor->SetOrientation(x, y, z);
}

void vtkPVReliefRepresentation::SetOrigin(double x, double y, double z)
{
  this->Actor->SetOrigin(x, y, z);
}

void vtkPVReliefRepresentation::SetVisibility(bool visible)
{
  this->Actor->SetVisibility(visible);
  this->Superclass::SetVisibility(visible);
}

//------------------------------------------------------------------------------
int vtkPVReliefRepresentation::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkPVReliefRepresentation::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  Internals& internal = *this->Internal;
  vtkInformation* info = inputs[0]->GetInformationObject(0);
  if (!info)
  {
    internal.Heights.Release();
    return this->Superclass::RequestData(request, inputs, outputs);
  }
  int whole[6];
  info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole);
  const bool several = internal.Choice.ofCells && whole[5] > whole[4];
  const int slice = std::clamp(internal.Slice, whole[4], whole[5] - (several ? 1 : 0));
  const std::string wrong =
    internal.Heights.Update(vtkMultiProcessController::GetGlobalController(),
      vtkImageData::GetData(info), whole, slice, internal.Choice);
  if (!wrong.empty())
  {
    internal.Heights.Release();
    vtkErrorMacro(<< wrong << ".");
  }
  return this->Superclass::RequestData(request, inputs, outputs);
}

//------------------------------------------------------------------------------
// Hands this process's heights to the view, which brings them to where they are drawn.
void vtkPVReliefRepresentation::Deliver(vtkInformation* in)
{
  vtkImageData* heights = this->Internal->Heights.Get();
  vtkNew<vtkImageData> sent;
  sent->ShallowCopy(heights);
  vtkNew<vtkDoubleArray> frame;
  frame->SetName(FrameName);
  frame->SetNumberOfValues(15);
  std::copy_n(heights->GetOrigin(), 3, frame->GetPointer(0));
  std::copy_n(heights->GetSpacing(), 3, frame->GetPointer(3));
  std::copy_n(heights->GetDirectionMatrix()->GetData(), 9, frame->GetPointer(6));
  vtkNew<vtkFieldData> fields;
  fields->AddArray(frame);
  sent->SetFieldData(fields);
  vtkPVView::SetPiece(in, this, sent);
  // A client has no heights before they are drawn, and no bounds of theirs.
  if (heights->GetNumberOfPoints() > 0)
  {
    double bounds[6];
    heights->GetBounds(bounds);
    vtkNew<vtkMatrix4x4> matrix;
    this->Actor->GetMatrix(matrix);
    vtkPVRenderView::SetGeometryBounds(in, this, bounds, matrix);
  }
  vtkPVRenderView::SetDeliverToClientAndRenderingProcesses(in, this, true, false);
}

//------------------------------------------------------------------------------
// Takes what has been delivered, and all that is set, before it is drawn.
void vtkPVReliefRepresentation::Take(vtkInformation* in)
{
  Internals& internal = *this->Internal;
  vtkAlgorithmOutput* port = vtkPVRenderView::GetPieceProducer(in, this);
  if (!port)
  {
    return;
  }
  port->GetProducer()->Update();
  auto* got =
    vtkImageData::SafeDownCast(port->GetProducer()->GetOutputDataObject(port->GetIndex()));
  auto* frame =
    got ? vtkDoubleArray::SafeDownCast(got->GetFieldData()->GetArray(FrameName)) : nullptr;
  if (frame && got->GetNumberOfPoints() > 0 &&
    (internal.Delivered != got || internal.DeliveredTime != got->GetMTime()))
  {
    internal.Delivered = got;
    internal.DeliveredTime = got->GetMTime();
    internal.Shown->ShallowCopy(got);
    internal.Shown->SetOrigin(frame->GetPointer(0));
    internal.Shown->SetSpacing(frame->GetPointer(3));
    internal.Shown->SetDirectionMatrix(frame->GetPointer(6));
    internal.Mapper->SetInputDataObject(internal.Shown);
  }
  else if (got && got->GetNumberOfPoints() == 0)
  {
    internal.Delivered = nullptr;
    internal.Mapper->SetInputDataObject(nullptr);
  }

  internal.Mapper->SetLookupTable(internal.Tint ? internal.Table.Get() : nullptr);
  internal.Mapper->SetNoDataValue(internal.NoData);
  internal.Mapper->SetUseNoDataValue(internal.UseNoData);
  if (auto* scene = vtkPVReliefScene::SafeDownCast(internal.Mapper->GetScene()))
  {
    scene->Update(internal.Delivered ? internal.Shown.Get() : nullptr, nullptr,
      internal.UseNoData ? internal.NoData : std::numeric_limits<double>::quiet_NaN());
  }
}

//------------------------------------------------------------------------------
int vtkPVReliefRepresentation::ProcessViewRequest(
  vtkInformationRequestKey* request, vtkInformation* in, vtkInformation* out)
{
  if (!this->Superclass::ProcessViewRequest(request, in, out))
  {
    return 0;
  }
  if (request == vtkPVView::REQUEST_UPDATE())
  {
    this->Deliver(in);
  }
  else if (request == vtkPVView::REQUEST_RENDER())
  {
    this->Take(in);
  }
  return 1;
}

//------------------------------------------------------------------------------
bool vtkPVReliefRepresentation::AddToView(vtkView* view)
{
  if (auto* renderView = vtkPVRenderView::SafeDownCast(view))
  {
    renderView->GetRenderer()->AddViewProp(this->Actor);
    return this->Superclass::AddToView(view);
  }
  return false;
}

//------------------------------------------------------------------------------
bool vtkPVReliefRepresentation::RemoveFromView(vtkView* view)
{
  if (auto* renderView = vtkPVRenderView::SafeDownCast(view))
  {
    renderView->GetRenderer()->RemoveViewProp(this->Actor);
    return this->Superclass::RemoveFromView(view);
  }
  return false;
}

//------------------------------------------------------------------------------
void vtkPVReliefRepresentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const Internals& internal = *this->Internal;
  os << indent << "Array: " << internal.Choice.name
     << (internal.Choice.ofCells ? " (cells)" : " (points)") << "\n";
  os << indent << "Slice: " << internal.Slice << "\n";
  os << indent << "Tint: " << (internal.Tint ? "On" : "Off") << "\n";
  os << indent << "Mapper:\n";
  internal.Mapper->PrintSelf(os, indent.GetNextIndent());
}
