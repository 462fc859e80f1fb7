// SPDX-License-Identifier: BSD-3-Clause
#include "HostInputs.h"

#include "SceneConversion.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
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
           "in "
           "memory are expected";
  }
  source.scale = this->Scene->GetHeightScale();
  // Where the image lies does not matter for that.
  source.padded = sweeps &&
    SceneShading::WantsPadding(
      ConvertMaterial(this->Scene, ImageFrame(), 0.0), heights.image->GetDimensions()[0]);
  const std::string wrong = this->Heights.Update(source);
  if (!wrong.empty())
  {
    return wrong;
  }
  return this->Textures.Place(heights,
    { At(inputs, DiffusePort, arrays), At(inputs, BasePort, arrays),
      At(inputs, SpecularPort, arrays) },
    this->LookupTable, reading.stretchTextures, this->Host);
}

//------------------------------------------------------------------------------
void HostInputs::Release()
{
  this->Heights.Release();
  this->Textures.Release();
  this->Environment.Release();
}
}
