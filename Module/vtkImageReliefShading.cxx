// SPDX-License-Identifier: BSD-3-Clause
#include "vtkImageReliefShading.h"

#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkReliefConversion.h"
#include "vtkReliefHeights.h"
#include "vtkReliefMaterial.h"
#include "vtkReliefScene.h"
#include "vtkReliefSetters.h"
#include "vtkReliefStatistics.h"
#include "vtkReliefTextures.h"
#include "vtkReliefThreads.h"
#include "vtkScalarsToColors.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include "SceneShading.h"

#include <algorithm>
#include <new>
#include <sstream>

vtkStandardNewMacro(vtkImageReliefShading);

#define vtkReliefThisClass vtkImageReliefShading

static_assert(static_cast<int>(vtkReliefStatistics::Illumination) == relief::IlluminationEffect);
static_assert(static_cast<int>(vtkReliefStatistics::Normals) == relief::NormalsEffect);
static_assert(static_cast<int>(vtkReliefStatistics::Specular) == relief::SpecularEffect);
static_assert(static_cast<int>(vtkReliefStatistics::ForwardScatter) == relief::ScatterEffect);
static_assert(static_cast<int>(vtkReliefStatistics::BaseTexture) == relief::BaseTextureEffect);
static_assert(
  static_cast<int>(vtkReliefStatistics::DiffuseTexture) == relief::DiffuseTextureEffect);
static_assert(
  static_cast<int>(vtkReliefStatistics::SpecularTexture) == relief::SpecularTextureEffect);

namespace
{

// Whether lights may be swept in lockstep, for which the heights are copied with a margin. In a
// narrow image the margin would outweigh the samples, and little would be won.
bool IsSwept(vtkReliefScene* scene, int columns)
{
  return columns >= 64 && scene->GetIntegrator() == vtkReliefScene::Exact &&
    scene->GetMaterial()->GetOffsetMode() == vtkReliefMaterial::Vertical &&
    !scene->GetMaterial()->GetUseFloor();
}

float* AddLayer(vtkImageData* image, bool wanted, const char* name, int components)
{
  if (!wanted)
  {
    return nullptr;
  }
  vtkNew<vtkFloatArray> layer;
  layer->SetName(name);
  layer->SetNumberOfComponents(components);
  layer->SetNumberOfTuples(image->GetNumberOfPoints());
  image->GetPointData()->AddArray(layer);
  return layer->GetPointer(0);
}

}

class vtkImageReliefShading::Internals
{
public:
  vtkSmartPointer<vtkReliefScene> Scene = vtkSmartPointer<vtkReliefScene>::New();
  vtkSmartPointer<vtkScalarsToColors> LookupTable;
  vtkNew<vtkReliefStatistics> Statistics;

  // Kept between updates.
  vtkReliefHeights Heights;
  relief::IlluminationCache Cache;
  vtkReliefTextures Textures;
};

//------------------------------------------------------------------------------
vtkImageReliefShading::vtkImageReliefShading()
  : Internal(new Internals)
{
  this->SetNumberOfInputPorts(5);
  for (int port = 1; port < 5; ++port)
  {
    this->SetInputArrayToProcess(
      port, port, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  }
}

//------------------------------------------------------------------------------
vtkImageReliefShading::~vtkImageReliefShading() = default;

//------------------------------------------------------------------------------
vtkReliefSetObjectBody(Scene, vtkReliefScene, this->Internal->Scene);

//------------------------------------------------------------------------------
vtkReliefScene* vtkImageReliefShading::GetScene()
{
  return this->Internal->Scene;
}

//------------------------------------------------------------------------------
void vtkImageReliefShading::SetLookupTable(vtkScalarsToColors* table)
{
  if (this->Internal->LookupTable != table)
  {
    this->Internal->LookupTable = table;
    this->Internal->Textures.Release();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkScalarsToColors* vtkImageReliefShading::GetLookupTable()
{
  return this->Internal->LookupTable;
}

//------------------------------------------------------------------------------
vtkReliefSetNoDataValueBody();

//------------------------------------------------------------------------------
void vtkImageReliefShading::SetOutputScalarType(int type)
{
  if (type != VTK_FLOAT && type != VTK_UNSIGNED_CHAR)
  {
    vtkErrorMacro("SetOutputScalarType: "
      << type << " was given, VTK_FLOAT (" << VTK_FLOAT << ") or VTK_UNSIGNED_CHAR ("
      << VTK_UNSIGNED_CHAR << ") is expected; " << this->OutputScalarType << " is kept.");
    return;
  }
  if (this->OutputScalarType != type)
  {
    this->OutputScalarType = type;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkImageReliefShading::SetCacheMemoryLimit(unsigned long kibibytes)
{
  // What is kept changes no result, so this does not ask for an update.
  this->CacheMemoryLimit = kibibytes;
}

//------------------------------------------------------------------------------
void vtkImageReliefShading::ReleaseCache()
{
  this->Internal->Heights.Release();
  this->Internal->Cache.Keep({});
  this->Internal->Textures.Release();
}

//------------------------------------------------------------------------------
vtkReliefStatistics* vtkImageReliefShading::GetStatistics()
{
  return this->Internal->Statistics;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkImageReliefShading::GetMTime()
{
  vtkScalarsToColors* table = this->Internal->LookupTable;
  return std::max({ this->Superclass::GetMTime(), this->Internal->Scene->GetMTime(),
    table ? table->GetMTime() : 0 });
}

//------------------------------------------------------------------------------
int vtkImageReliefShading::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  if (port > 0)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkImageReliefShading::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkDataObject::SetPointDataActiveScalarInfo(
    outputs->GetInformationObject(0), this->OutputScalarType, 4);
  return 1;
}

//------------------------------------------------------------------------------
int vtkImageReliefShading::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  for (int port = 0; port < this->GetNumberOfInputPorts(); ++port)
  {
    vtkInformation* info = inputs[port]->GetInformationObject(0);
    if (info && info->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()))
    {
      info->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(),
        info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()), 6);
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkImageReliefShading::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  try
  {
    return this->Shade(inputs, outputs);
  }
  catch (const std::bad_alloc&)
  {
    vtkImageData::GetData(outputs, 0)->Initialize();
    this->ReleaseCache();
    vtkErrorMacro("There is not enough memory to shade the image.");
    return 1;
  }
}

//------------------------------------------------------------------------------
int vtkImageReliefShading::Shade(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  vtkInformation* outInfo = outputs->GetInformationObject(0);
  vtkImageData* output = vtkImageData::GetData(outInfo);
  vtkImageData* input = vtkImageData::GetData(inputs[0]);
  vtkImageData* mask = vtkImageData::GetData(inputs[1]);
  vtkReliefScene* scene = this->Internal->Scene;
  vtkReliefStatistics* statistics = this->Internal->Statistics;
  output->Initialize();

  // An error leaves the output empty. The pipeline would add a message of its own to a failure.
  auto fail = [&](const std::string& message)
  {
    vtkErrorMacro(<< message << ".");
    output->Initialize();
    return 1;
  };

  const int* extent = input->GetExtent();
  const int columns = extent[1] - extent[0] + 1;
  vtkReliefHeights& heights = this->Internal->Heights;
  vtkReliefHeights::Source source;
  source.image = input;
  source.scalars = this->GetInputArrayToProcess(0, inputs);
  source.mask = mask;
  source.maskScalars = mask ? this->GetInputArrayToProcess(1, inputs) : nullptr;
  source.scale = scene->GetHeightScale();
  source.useNoData = this->UseNoDataValue;
  source.noData = this->NoDataValue;
  source.padded = IsSwept(scene, columns);
  std::string wrong = heights.Update(source);
  if (!wrong.empty())
  {
    return fail(wrong);
  }
  const relief::HeightField& field = heights.GetField();
  const vtkReliefImageFrame& frame = heights.GetFrame();
  if (!field.HasData())
  {
    vtkWarningMacro("No sample has data; the output is transparent.");
  }
  else if (columns < 2 || extent[3] == extent[2])
  {
    vtkWarningMacro("An image of "
      << columns << " x " << extent[3] - extent[2] + 1
      << " samples has no surface between them; each is shaded as level "
         "ground.");
  }

  relief::Scene parameters = vtkReliefConvertMaterial(scene, frame, field.GetDatum());
  wrong = vtkReliefConvertLights(scene, nullptr, frame, field, parameters.lights);
  if (!wrong.empty())
  {
    return fail(wrong);
  }

  auto textureInput = [&](int port)
  {
    vtkReliefTextureInput result;
    result.image = vtkImageData::GetData(inputs[port]);
    if (result.image)
    {
      vtkInformation* info = inputs[port]->GetInformationObject(0);
      result.scalars = this->GetInputArrayToProcess(port, inputs);
      std::copy_n(info->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT())
          ? info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT())
          : result.image->GetExtent(),
        6, result.whole);
    }
    return result;
  };
  vtkReliefTextures& textures = this->Internal->Textures;
  wrong = textures.Add(textureInput(0), { textureInput(2), textureInput(3), textureInput(4) },
    this->Internal->LookupTable, this->StretchTextures, this, parameters);
  if (!wrong.empty())
  {
    return fail(wrong);
  }

  // A distributed input holds its piece only, whatever has been asked for.
  int outExtent[6];
  outInfo->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), outExtent);
  for (int axis = 0; axis < 3; ++axis)
  {
    outExtent[2 * axis] = std::max(outExtent[2 * axis], extent[2 * axis]);
    outExtent[2 * axis + 1] = std::min(outExtent[2 * axis + 1], extent[2 * axis + 1]);
  }
  output->CopyStructure(input);
  output->SetExtent(outExtent);
  relief::Target target;
  try
  {
    output->AllocateScalars(this->OutputScalarType, 4);
    output->GetPointData()->GetScalars()->SetName("Shading");
    target.illumination = AddLayer(output, this->GenerateIllumination, "Illumination", 1);
    target.thickness = AddLayer(output, this->GenerateThickness, "Thickness", 1);
    target.normals = AddLayer(output, this->GenerateNormals, "Normals", 3);
    target.base = AddLayer(output, this->GenerateBase, "Base", 3);
    target.diffuse = AddLayer(output, this->GenerateDiffuse, "Diffuse", 3);
    target.scatter = AddLayer(output, this->GenerateScatter, "Scatter", 3);
    target.specular = AddLayer(output, this->GenerateSpecular, "Specular", 3);
  }
  catch (const std::bad_alloc&)
  {
    return fail("there is not enough memory for the output");
  }
  if (output->GetNumberOfPoints() == 0)
  {
    return 1;
  }
  target.i0 = outExtent[0] - extent[0];
  target.j0 = outExtent[2] - extent[2];
  target.width = outExtent[1] - outExtent[0] + 1;
  target.rows = outExtent[3] - outExtent[2] + 1;
  void* pixels = output->GetPointData()->GetScalars()->GetVoidPointer(0);
  if (this->OutputScalarType == VTK_FLOAT)
  {
    target.rgba = static_cast<float*>(pixels);
  }
  else
  {
    target.rgba8 = static_cast<unsigned char*>(pixels);
  }

  // Bands of tiles, one after another: between them observers hear of progress, on this thread, and
  // may abort.
  relief::IlluminationCache& cache = this->Internal->Cache;
  cache.SetLimit(static_cast<std::size_t>(this->CacheMemoryLimit) * 1024);
  std::unique_ptr<relief::SceneShading> shading;
  try
  {
    shading = std::make_unique<relief::SceneShading>(field, parameters, target, &cache);
  }
  catch (const std::bad_alloc&)
  {
    return fail(
      "there is not enough memory to keep illuminations; SetCacheMemoryLimit(0) keeps none");
  }
  textures.WarnOfTexels(parameters, shading->GetEffects(), this);
  const int height = relief::SweepThickness::TileHeight;
  const int firstRow = target.j0;
  const int endRow = target.j0 + outExtent[3] - outExtent[2] + 1;
  const int tiles = (endRow + height - 1) / height;
  const int band =
    std::max((tiles - firstRow / height + 15) / 16, 2 * vtkSMPTools::GetEstimatedNumberOfThreads());
  for (int begin = firstRow / height; begin < tiles && !this->AbortExecute; begin += band)
  {
    const int end = std::min(begin + band, tiles);
    vtkReliefFor(begin, end, 1,
      [&](vtkIdType from, vtkIdType to)
      {
        shading->Shade(target.i0, target.i0 + target.width,
          std::max(firstRow, static_cast<int>(from) * height),
          std::min(endRow, static_cast<int>(to) * height));
      });
    this->UpdateProgress(
      static_cast<double>(std::min(end * height, endRow) - firstRow) / (endRow - firstRow));
  }
  if (this->AbortExecute)
  {
    output->Initialize();
    return 1;
  }

  if (target.normals && !frame.IsWorld())
  {
    for (vtkIdType at = 0; at < output->GetNumberOfPoints(); ++at)
    {
      frame.NormalToWorld(target.normals + 3 * at);
    }
  }
  shading->KeepIlluminations();
  statistics->SetLightsReused(shading->GetLightsReused());
  statistics->SetLightsTraced(shading->GetLightsTraced());
  statistics->SetRaysTraced(static_cast<vtkTypeInt64>(shading->GetRaysTraced()));
  statistics->SetCellsVisited(static_cast<vtkTypeInt64>(shading->GetCellsVisited()));
  statistics->SetEffectsEvaluated(shading->GetEffects());
  return 1;
}

//------------------------------------------------------------------------------
void vtkImageReliefShading::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  auto printSwitch = [&](const char* name, bool on)
  { os << indent << name << ": " << (on ? "On" : "Off") << "\n"; };
  os << indent << "Scene:\n";
  this->Internal->Scene->PrintSelf(os, indent.GetNextIndent());
  os << indent << "NoDataValue: " << this->NoDataValue << "\n";
  printSwitch("UseNoDataValue", this->UseNoDataValue);
  printSwitch("StretchTextures", this->StretchTextures);
  os << indent << "LookupTable:";
  if (this->Internal->LookupTable)
  {
    os << "\n";
    this->Internal->LookupTable->PrintSelf(os, indent.GetNextIndent());
  }
  else
  {
    os << " (none)\n";
  }
  os << indent
     << "OutputScalarType: " << (this->OutputScalarType == VTK_FLOAT ? "Float" : "UnsignedChar")
     << "\n";
  printSwitch("GenerateIllumination", this->GenerateIllumination);
  printSwitch("GenerateThickness", this->GenerateThickness);
  printSwitch("GenerateNormals", this->GenerateNormals);
  printSwitch("GenerateBase", this->GenerateBase);
  printSwitch("GenerateDiffuse", this->GenerateDiffuse);
  printSwitch("GenerateScatter", this->GenerateScatter);
  printSwitch("GenerateSpecular", this->GenerateSpecular);
  os << indent << "CacheMemoryLimit: " << this->CacheMemoryLimit << "\n";
  os << indent << "Statistics:\n";
  this->Internal->Statistics->PrintSelf(os, indent.GetNextIndent());
}
