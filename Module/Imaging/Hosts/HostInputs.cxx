// SPDX-License-Identifier: BSD-3-Clause
#include "HostInputs.h"

#include "SceneConversion.h"

#include "vtkAlgorithm.h"
#include "vtkAlgorithmOutput.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMatrix3x3.h"
#include "vtkNew.h"
#include "vtkReliefScene.h"
#include "vtkReliefSetters.h"
#include "vtkReliefStatistics.h"
#include "vtkScalarsToColors.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>

// Hosts hand the model's bits on as they are.
static_assert(static_cast<int>(vtkReliefStatistics::Illumination) == relief::IlluminationEffect);
static_assert(static_cast<int>(vtkReliefStatistics::Normals) == relief::NormalsEffect);
static_assert(static_cast<int>(vtkReliefStatistics::Specular) == relief::SpecularEffect);
static_assert(static_cast<int>(vtkReliefStatistics::ForwardScatter) == relief::ScatterEffect);
static_assert(static_cast<int>(vtkReliefStatistics::BaseTexture) == relief::BaseTextureEffect);
static_assert(
  static_cast<int>(vtkReliefStatistics::DiffuseTexture) == relief::DiffuseTextureEffect);
static_assert(
  static_cast<int>(vtkReliefStatistics::SpecularTexture) == relief::SpecularTextureEffect);

namespace relief::hosts
{
namespace
{
// What is at a port, whole as far as the pipeline knows.
TextureInput At(
  vtkInformationVector** inputs, int port, const std::function<vtkDataArray*(int)>& arrays)
{
  TextureInput result;
  vtkInformation* info = inputs[port]->GetInformationObject(0);
  result.image = vtkImageData::GetData(info);
  if (result.image)
  {
    result.scalars = arrays(port);
    std::copy_n(info->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT())
        ? info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT())
        : result.image->GetExtent(),
      6, result.whole);
  }
  return result;
}
}

//------------------------------------------------------------------------------
HostInputs::HostInputs(vtkObject* host)
  : Host(host)
  , Scene(vtkSmartPointer<vtkReliefScene>::New())
{
}

//------------------------------------------------------------------------------
HostInputs::~HostInputs() = default;

//------------------------------------------------------------------------------
void HostInputs::NameArrays(vtkAlgorithm* host)
{
  for (int port = 0; port < NumberOfPorts; ++port)
  {
    host->SetInputArrayToProcess(
      port, port, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  }
}

//------------------------------------------------------------------------------
int HostInputs::FillPort(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  if (port != HeightsPort)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
void HostInputs::AskForAll(vtkInformationVector** inputs)
{
  for (int port = 0; port < NumberOfPorts; ++port)
  {
    vtkInformation* info = inputs[port]->GetInformationObject(0);
    if (info && info->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()))
    {
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(),
        info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()), 6);
    }
  }
}

//------------------------------------------------------------------------------
void HostInputs::AskForPart(vtkInformationVector** inputs, const int extent[6])
{
  AskForAll(inputs);
  for (int port : { HeightsPort, MaskPort })
  {
    vtkInformation* info = inputs[port]->GetInformationObject(0);
    if (info)
    {
      // As it is: its source must not take the output's piece of it.
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent, 6);
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 1);
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    }
  }
}

//------------------------------------------------------------------------------
void HostInputs::SetScene(vtkReliefScene* scene)
{
  relief::SetObject(this->Host, this->Scene, scene, "Scene");
}

//------------------------------------------------------------------------------
vtkReliefScene* HostInputs::GetScene() const
{
  return this->Scene;
}

//------------------------------------------------------------------------------
void HostInputs::SetLookupTable(vtkScalarsToColors* table)
{
  if (this->LookupTable != table)
  {
    this->LookupTable = table;
    this->Textures.Release();
    this->Host->Modified();
  }
}

//------------------------------------------------------------------------------
vtkScalarsToColors* HostInputs::GetLookupTable() const
{
  return this->LookupTable;
}

//------------------------------------------------------------------------------
void HostInputs::SetNoDataValue(double value, double& held, bool& used)
{
  // Never equal to itself, NaN must not count as a change.
  const bool same = held == value || (std::isnan(value) && std::isnan(held));
  if (!same || !used)
  {
    held = value;
    used = true;
    this->Host->Modified();
  }
}

//------------------------------------------------------------------------------
vtkMTimeType HostInputs::GetMTime(vtkMTimeType own) const
{
  return std::max(
    { own, this->Scene->GetMTime(), this->LookupTable ? this->LookupTable->GetMTime() : 0 });
}

//------------------------------------------------------------------------------
void HostInputs::Print(ostream& os, vtkIndent indent, const Reading& reading) const
{
  auto name = [](bool on) { return on ? "On" : "Off"; };
  os << indent << "Scene:\n";
  this->Scene->PrintSelf(os, indent.GetNextIndent());
  os << indent << "NoDataValue: " << reading.noData << "\n";
  os << indent << "UseNoDataValue: " << name(reading.useNoData) << "\n";
  os << indent << "StretchTextures: " << name(reading.stretchTextures) << "\n";
  os << indent << "LookupTable:" << (this->LookupTable ? "\n" : " (none)\n");
  if (this->LookupTable)
  {
    this->LookupTable->PrintSelf(os, indent.GetNextIndent());
  }
}

//------------------------------------------------------------------------------
HeightInputs HostInputs::ReadHeights(vtkInformationVector** inputs,
  const std::function<vtkDataArray*(int)>& arrays, const Reading& reading)
{
  const TextureInput heights = At(inputs, HeightsPort, arrays);
  const TextureInput mask = At(inputs, MaskPort, arrays);
  HeightInputs source;
  source.image = heights.image;
  source.scalars = heights.scalars;
  source.mask = mask.image;
  source.maskScalars = mask.scalars;
  source.useNoData = reading.useNoData;
  source.noData = reading.noData;
  return source;
}

//------------------------------------------------------------------------------
std::string HostInputs::Update(vtkInformationVector** inputs,
  const std::function<vtkDataArray*(int)>& arrays, const Reading& reading, bool sweeps)
{
  const TextureInput heights = At(inputs, HeightsPort, arrays);
  if (!heights.image)
  {
    return "there are no heights";
  }
  PreparedHeights::Source source = ReadHeights(inputs, arrays, reading);
  if (!sweeps && FindTiled(source))
  {
    return "the heights are read as they are needed, which is for vtkImageReliefShading; heights "
           "in memory are expected";
  }
  source.scale = this->Scene->GetHeightScale();
  source.padded = sweeps && this->WantsPadding(heights.image->GetDimensions()[0]);
  this->OfPiece = false;
  this->Piece.Release();
  const std::string wrong = this->Heights.Update(source);
  return wrong.empty() ? this->Place(heights, inputs, arrays, reading) : wrong;
}

//------------------------------------------------------------------------------
bool HostInputs::WantsPadding(int columns) const
{
  // Where the image lies does not matter for that.
  return SceneShading::WantsPadding(ConvertMaterial(this->Scene, ImageFrame(), 0.0), columns);
}

//------------------------------------------------------------------------------
std::string HostInputs::Place(const TextureInput& heights, vtkInformationVector** inputs,
  const std::function<vtkDataArray*(int)>& arrays, const Reading& reading)
{
  return this->Textures.Place(heights,
    { At(inputs, DiffusePort, arrays), At(inputs, BasePort, arrays),
      At(inputs, SpecularPort, arrays) },
    this->LookupTable, reading.stretchTextures, this->Host);
}

//------------------------------------------------------------------------------
void HostInputs::AskForPiece(
  vtkInformationVector** inputs, const double range[2], const int piece[6])
{
  // What is wrong with the scene is told once there are heights, of which a piece will do.
  AskForPart(inputs, piece);
  if (piece[0] > piece[1] || piece[2] > piece[3])
  {
    return;
  }
  vtkInformation* info = inputs[HeightsPort]->GetInformationObject(0);
  vtkNew<vtkImageData> image;
  image->SetExtent(info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()));
  image->SetSpacing(info->Has(vtkDataObject::SPACING()) ? info->Get(vtkDataObject::SPACING())
                                                        : image->GetSpacing());
  image->SetOrigin(
    info->Has(vtkDataObject::ORIGIN()) ? info->Get(vtkDataObject::ORIGIN()) : image->GetOrigin());
  if (info->Has(vtkDataObject::DIRECTION()))
  {
    image->SetDirectionMatrix(info->Get(vtkDataObject::DIRECTION()));
  }
  vtkInformation* scalars = vtkDataObject::GetActiveFieldInformation(
    info, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  const bool floats = !scalars || !scalars->Has(vtkDataObject::FIELD_ARRAY_TYPE()) ||
    scalars->Get(vtkDataObject::FIELD_ARRAY_TYPE()) == VTK_FLOAT;
  const WholeHeights whole = { image, { range[0], range[1] }, this->Scene->GetHeightScale(), floats,
    this->WantsPadding(image->GetDimensions()[0]) };
  std::string wrong = this->Piece.Begin(whole);
  if (wrong.empty())
  {
    const PartialField& empty = this->Piece.GetEmpty();
    relief::Scene scene = ConvertMaterial(this->Scene, empty.Frame, empty.GetField().GetDatum());
    wrong =
      ConvertLights(this->Scene, nullptr, this->Environment, empty.Frame, empty.GetField(), scene);
    if (wrong.empty())
    {
      int extent[6];
      this->Piece.Ask(scene, piece, extent);
      AskForPart(inputs, extent);
    }
  }
}

//------------------------------------------------------------------------------
std::string HostInputs::UpdatePiece(vtkInformationVector** inputs,
  const std::function<vtkDataArray*(int)>& arrays, const Reading& reading, const double range[2],
  const int piece[6])
{
  TextureInput heights = At(inputs, HeightsPort, arrays);
  const HeightInputs source = ReadHeights(inputs, arrays, reading);
  std::string wrong = CheckPart(source);
  if (!wrong.empty())
  {
    return wrong;
  }
  vtkNew<vtkImageData> image;
  image->CopyStructure(heights.image);
  image->SetExtent(heights.whole);
  const WholeHeights whole = { image, { range[0], range[1] }, this->Scene->GetHeightScale(),
    heights.scalars->GetDataType() == VTK_FLOAT, this->WantsPadding(image->GetDimensions()[0]) };
  this->OfPiece = true;
  this->Heights.Release();
  wrong = this->Piece.FillFirst(whole, source);
  if (!wrong.empty())
  {
    return wrong;
  }
  heights.frame = this->Piece.GetHeld().Image;
  std::copy_n(piece, 6, heights.shown);
  return this->Place(heights, inputs, arrays, reading);
}

//------------------------------------------------------------------------------
vtkImageData* HostInputs::GetImage(vtkInformationVector** inputs) const
{
  return this->OfPiece ? this->Piece.GetHeld().Image.Get() : vtkImageData::GetData(inputs[0]);
}

//------------------------------------------------------------------------------
bool HostInputs::MissesOfPiece(const relief::Scene& scene, const int piece[6], int extent[6])
{
  return this->Piece.NeedsMore(scene, piece, extent);
}

//------------------------------------------------------------------------------
// Has heights and mask bring an extent. Returns an empty text, or what is wrong.
std::string HostInputs::Bring(vtkAlgorithm* host, const int extent[6])
{
  auto connectionOf = [&](int port) -> vtkAlgorithmOutput*
  {
    const bool connected = host->GetNumberOfInputConnections(port) > 0;
    return connected ? host->GetInputConnection(port, 0) : nullptr;
  };
  // Both ports of one reader at once.
  vtkAlgorithm* done = nullptr;
  for (int port : { HeightsPort, MaskPort })
  {
    vtkAlgorithm* producer = connectionOf(port) ? connectionOf(port)->GetProducer() : nullptr;
    if (!producer || producer == done)
    {
      continue;
    }
    vtkNew<vtkInformationVector> requests;
    requests->SetNumberOfInformationObjects(producer->GetNumberOfOutputPorts());
    for (int other : { HeightsPort, MaskPort })
    {
      if (connectionOf(other) && connectionOf(other)->GetProducer() == producer)
      {
        requests->GetInformationObject(connectionOf(other)->GetIndex())
          ->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent, 6);
      }
    }
    if (!producer->Update(connectionOf(port)->GetIndex(), requests))
    {
      return "the input could not bring further heights";
    }
    done = producer;
  }
  return std::string();
}

//------------------------------------------------------------------------------
std::string HostInputs::UpdatePieceFurther(vtkAlgorithm* host, const int extent[6],
  vtkInformationVector** inputs, const std::function<vtkDataArray*(int)>& arrays,
  const Reading& reading)
{
  std::string wrong = Bring(host, extent);
  if (!wrong.empty())
  {
    return wrong;
  }
  const HeightInputs source = ReadHeights(inputs, arrays, reading);
  wrong = CheckPart(source);
  return wrong.empty() ? this->Piece.FillMore(source) : wrong;
}

//------------------------------------------------------------------------------
std::string HostInputs::RestorePiece(vtkAlgorithm* host, const int extent[6],
  vtkInformationVector** inputs, const std::function<vtkDataArray*(int)>& arrays,
  const Reading& reading)
{
  std::string wrong = Bring(host, extent);
  if (wrong.empty())
  {
    const HeightInputs source = ReadHeights(inputs, arrays, reading);
    wrong = CheckPart(source);
    if (wrong.empty())
    {
      this->Piece.Remember(source);
    }
  }
  return wrong;
}

//------------------------------------------------------------------------------
void HostInputs::Release()
{
  this->Heights.Release();
  this->Piece.Release();
  this->Textures.Release();
  this->Environment.Release();
}
}
