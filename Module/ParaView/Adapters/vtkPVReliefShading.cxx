// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPVReliefShading.h"

#include "vtkAlgorithmOutput.h"
#include "vtkCommunicator.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVReliefScene.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include "GatheredSamples.h"
#include "HostInputs.h"

#include <algorithm>
#include <array>
#include <limits>
#include <string>

vtkStandardNewMacro(vtkPVReliefShading);

using Pipeline = vtkStreamingDemandDrivenPipeline;
using relief::hosts::HostInputs;

class vtkPVReliefShading::Internals
{
public:
  bool HeightsAreOfCells(vtkAlgorithmOutput* connection) const;
  std::string Gather(vtkInformationVector** inputs);

  std::array<relief::paraview::ArrayChoice, HostInputs::NumberOfPorts> Choices;
  bool PlacedAsCells = false; // as the output's whole extent has been told
  std::array<relief::paraview::KeptSamples, HostInputs::NumberOfPorts> Samples;
  // The inputs of the run at hand, gathered.
  std::array<vtkNew<vtkInformationVector>, HostInputs::NumberOfPorts> Whole;
};

//------------------------------------------------------------------------------
vtkPVReliefShading::vtkPVReliefShading()
  : Internal(new Internals)
{
}

//------------------------------------------------------------------------------
vtkPVReliefShading::~vtkPVReliefShading() = default;

//------------------------------------------------------------------------------
void vtkPVReliefShading::SetInputArrayToProcess(
  int index, int, int, int association, const char* name)
{
  if (index < 0 || index >= HostInputs::NumberOfPorts)
  {
    vtkErrorMacro("SetInputArrayToProcess: " << index << " was given, an input from 0 to "
                                             << HostInputs::NumberOfPorts - 1 << " is expected.");
    return;
  }
  // The superclass goes on taking the scalars of points, which the array becomes.
  this->Internal->Choices[static_cast<std::size_t>(index)] =
    relief::paraview::ChooseArray(association, name);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkPVReliefShading::SetHeightWithoutData(double value)
{
  const bool used = this->UseNoDataValue;
  this->SetNoDataValue(value);
  this->SetUseNoDataValue(used);
}

//------------------------------------------------------------------------------
void vtkPVReliefShading::SetUseHeightWithoutData(bool use)
{
  this->SetUseNoDataValue(use);
}

//------------------------------------------------------------------------------
void vtkPVReliefShading::SetLampPosition(double x, double y, double z)
{
  if (auto* scene = vtkPVReliefScene::SafeDownCast(this->GetScene()))
  {
    scene->SetLampPosition(x, y, z);
  }
}

//------------------------------------------------------------------------------
// Whether the heights belong to the cells. A name comes with what it belongs to; without one, only
// the data tell: those of any process, which are brought up to date for that. All processes must
// ask.
bool vtkPVReliefShading::Internals::HeightsAreOfCells(vtkAlgorithmOutput* connection) const
{
  const relief::paraview::ArrayChoice& choice = this->Choices[HostInputs::HeightsPort];
  if (!choice.name.empty())
  {
    return choice.ofCells;
  }
  vtkMultiProcessController* controller = vtkMultiProcessController::GetGlobalController();
  const int processes = controller ? controller->GetNumberOfProcesses() : 1;
  vtkAlgorithm* producer = connection->GetProducer();
  const int port = connection->GetIndex();
  enum
  {
    Unknown,
    OfPoints,
    OfCells
  };
  int own = Unknown;
  int known = Unknown;
  for (int attempt = 0; known == Unknown && attempt < 2; ++attempt)
  {
    if (attempt > 0)
    {
      vtkNew<vtkInformationVector> requests;
      requests->SetNumberOfInformationObjects(producer->GetNumberOfOutputPorts());
      vtkInformation* request = requests->GetInformationObject(port);
      request->Set(
        Pipeline::UPDATE_PIECE_NUMBER(), processes > 1 ? controller->GetLocalProcessId() : 0);
      request->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), processes);
      request->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
      producer->Update(port, requests);
    }
    auto* image = vtkImageData::SafeDownCast(producer->GetOutputDataObject(port));
    bool ofCells = false;
    if (image && image->GetNumberOfPoints() > 0 &&
      relief::paraview::FindArray(image, choice, ofCells))
    {
      own = ofCells ? OfCells : OfPoints;
    }
    known = own;
    if (processes > 1)
    {
      controller->AllReduce(&own, &known, 1, vtkCommunicator::MAX_OP);
    }
  }
  return known == OfCells;
}

//------------------------------------------------------------------------------
int vtkPVReliefShading::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (!this->Superclass::RequestInformation(request, inputs, outputs))
  {
    return 0;
  }
  vtkInformation* in = inputs[0]->GetInformationObject(0);
  vtkInformation* out = outputs->GetInformationObject(0);
  this->Internal->PlacedAsCells =
    this->Internal->HeightsAreOfCells(this->GetInputConnection(HostInputs::HeightsPort, 0));
  if (this->Internal->PlacedAsCells && in->Has(Pipeline::WHOLE_EXTENT()))
  {
    const int* whole = in->Get(Pipeline::WHOLE_EXTENT());
    int samples[6];
    double shift[3];
    relief::paraview::FindSampleExtent(whole, true, samples);
    relief::paraview::FindSampleShift(whole, true, shift);
    out->Set(Pipeline::WHOLE_EXTENT(), samples, 6);
    if (in->Has(vtkDataObject::ORIGIN()) && in->Has(vtkDataObject::SPACING()))
    {
      const double* origin = in->Get(vtkDataObject::ORIGIN());
      const double* spacing = in->Get(vtkDataObject::SPACING());
      const double moved[3] = { origin[0] + shift[0] * spacing[0],
        origin[1] + shift[1] * spacing[1], origin[2] + shift[2] * spacing[2] };
      out->Set(vtkDataObject::ORIGIN(), moved, 3);
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
// Makes every input whole, in every process. Returns an empty text, or what is wrong.
std::string vtkPVReliefShading::Internals::Gather(vtkInformationVector** inputs)
{
  for (std::size_t port = 0; port < this->Whole.size(); ++port)
  {
    this->Whole[port]->SetNumberOfInformationObjects(0);
    vtkInformation* in = inputs[port]->GetInformationObject(0);
    if (!in || !in->Has(Pipeline::WHOLE_EXTENT()))
    {
      this->Samples[port].Release();
      continue;
    }
    const int* whole = in->Get(Pipeline::WHOLE_EXTENT());
    if (whole[4] != whole[5])
    {
      return "the input has " + std::to_string(whole[5] - whole[4] + 1) +
        " slices, an image of one is expected; extract one first";
    }
    const std::string wrong =
      this->Samples[port].Update(vtkMultiProcessController::GetGlobalController(),
        vtkImageData::GetData(in), whole, whole[4], this->Choices[port]);
    if (!wrong.empty())
    {
      return wrong;
    }
    vtkImageData* all = this->Samples[port].Get();
    vtkNew<vtkInformation> info;
    info->Copy(in);
    info->Set(vtkDataObject::DATA_OBJECT(), all);
    info->Set(Pipeline::WHOLE_EXTENT(), all->GetExtent(), 6);
    this->Whole[port]->Append(info);
  }
  return std::string();
}

//------------------------------------------------------------------------------
int vtkPVReliefShading::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* in = inputs[0]->GetInformationObject(0);
  vtkInformation* out = outputs->GetInformationObject(0);
  vtkImageData* output = vtkImageData::GetData(out);
  const auto fail = [&](const std::string& message)
  {
    vtkErrorMacro(<< message << ".");
    output->Initialize();
    return 1;
  };
  const std::string wrong = this->Internal->Gather(inputs);
  if (!wrong.empty())
  {
    return fail(wrong);
  }
  vtkImageData* piece = vtkImageData::GetData(in);
  if (piece->GetNumberOfPoints() == 0)
  {
    output->Initialize();
    return 1;
  }

  std::array<vtkInformationVector*, HostInputs::NumberOfPorts> whole;
  std::copy(this->Internal->Whole.begin(), this->Internal->Whole.end(), whole.begin());
  if (auto* scene = vtkPVReliefScene::SafeDownCast(this->GetScene()))
  {
    scene->Update(vtkImageData::GetData(whole[HostInputs::HeightsPort], 0),
      vtkImageData::GetData(whole[HostInputs::MaskPort], 0),
      this->UseNoDataValue ? this->NoDataValue : std::numeric_limits<double>::quiet_NaN());
  }

  // Its own piece of them: of cells, those at its edges too, for pieces to meet.
  int asked[6];
  int mine[6];
  out->Get(Pipeline::UPDATE_EXTENT(), asked);
  const int* held = piece->GetExtent();
  const int* all = vtkImageData::GetData(whole[0], 0)->GetExtent();
  for (int axis = 0; axis < 3; ++axis)
  {
    mine[2 * axis] = std::max({ asked[2 * axis], held[2 * axis], all[2 * axis] });
    mine[2 * axis + 1] = std::min({ asked[2 * axis + 1], held[2 * axis + 1], all[2 * axis + 1] });
  }
  out->Set(Pipeline::UPDATE_EXTENT(), mine, 6);
  const int done = this->Superclass::RequestData(request, whole.data(), outputs);
  out->Set(Pipeline::UPDATE_EXTENT(), asked, 6);
  return done;
}

//------------------------------------------------------------------------------
void vtkPVReliefShading::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  for (const auto& choice : this->Internal->Choices)
  {
    os << indent << "Array: " << choice.name << (choice.ofCells ? " (cells)" : " (points)") << "\n";
  }
}
