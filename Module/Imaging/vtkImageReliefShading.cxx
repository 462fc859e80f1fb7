// SPDX-License-Identifier: BSD-3-Clause
#include "vtkImageReliefShading.h"

#include "vtkAlgorithmOutput.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkExtentTranslator.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerRequestKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkReliefAbort.h"
#include "vtkReliefScene.h"
#include "vtkReliefStatistics.h"
#include "vtkReliefThreads.h"
#include "vtkScalarsToColors.h"
#include "vtkSmartPointer.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnsignedCharArray.h"

#include "HeightHash.h"
#include "HeightScale.h"
#include "HostInputs.h"
#include "ModelVersion.h"
#include "PictureArrays.h"
#include "PictureExposure.h"
#include "PreparedScene.h"
#include "ReservedMemory.h"
#include "SceneShading.h"
#include "TiledHeights.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <new>
#include <vector>

vtkStandardNewMacro(vtkImageReliefShading);

namespace
{

// The part of a whole extent that an output is asked for; empty if there is none.
void FindPiece(const int whole[6], vtkInformation* outInfo, int piece[6])
{
  outInfo->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), piece);
  for (int axis = 0; axis < 3; ++axis)
  {
    piece[2 * axis] = std::max(piece[2 * axis], whole[2 * axis]);
    piece[2 * axis + 1] = std::min(piece[2 * axis + 1], whole[2 * axis + 1]);
  }
}

// The same before the executive has cut the piece of a number out of the extent, as it does before
// data are made.
void FindNumberedPiece(const int whole[6], vtkInformation* outInfo, int piece[6])
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  FindPiece(whole, outInfo, piece);
  const int pieces = outInfo->Get(Pipeline::UPDATE_NUMBER_OF_PIECES());
  if (pieces > 1)
  {
    const int mode = outInfo->Has(vtkExtentTranslator::UPDATE_SPLIT_MODE())
      ? outInfo->Get(vtkExtentTranslator::UPDATE_SPLIT_MODE())
      : vtkExtentTranslator::BLOCK_MODE;
    int all[6];
    std::copy_n(piece, 6, all);
    vtkNew<vtkExtentTranslator> translator;
    translator->PieceToExtentThreadSafe(outInfo->Get(Pipeline::UPDATE_PIECE_NUMBER()), pieces,
      outInfo->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()), all, piece, mode, 0);
  }
}

bool IsEmpty(const int extent[6])
{
  return extent[0] > extent[1] || extent[2] > extent[3] || extent[4] > extent[5];
}

}

class vtkImageReliefShading::Internals
{
public:
  explicit Internals(vtkImageReliefShading* self)
    : Self(self)
    , Inputs(self)
  {
  }

  relief::hosts::HostInputs::Reading GetReading() const;
  std::string Prepare(vtkInformationVector** inputs);
  bool AsksForPieces(vtkInformationVector** inputs) const;
  std::string PreparePiece(vtkInformationVector** inputs, vtkInformation* outInfo);
  void WarnOfHeights();
  std::string MakeOutput(vtkImageData* input, int outExtent[6], vtkInformation* outInfo,
    vtkSmartPointer<vtkDataArray>& last, relief::Target& target);
  std::unique_ptr<relief::SceneShading> Plan(const relief::Target& target);
  relief::SceneShading* PlanTile(const relief::Target& target);
  relief::hosts::WindowProvider GetProvider();
  void FindExposure();
  relief::hosts::TiledHeights::Needs Estimate(const int extent[6], vtkInformationVector** inputs);
  bool IsAborted() const;
  bool ShadeBands(const relief::Target& target, relief::SceneShading& shading);
  void Tell(const relief::SceneShading& shading);

  vtkImageReliefShading* Self;
  vtkNew<vtkReliefStatistics> Statistics;
  bool InPieces = false;                   // what has been asked for
  relief::hosts::PictureExposure Exposure; // of the run at hand
  // What it was found from: parts of a picture are of one exposure, which is found once.
  std::uint64_t ExposedScene = 0;
  std::uint64_t ExposedField = 0;

  // Of heights that are read as they are needed: all of their tiles are shaded by one object, whose
  // counts go on from tile to tile.
  struct TileShading
  {
    std::unique_ptr<relief::SceneShading> shading;
    std::uint64_t scene = 0;
    std::uint64_t field = 0;
    std::vector<bool> layers;
    std::uint64_t rays = 0;
    std::uint64_t cells = 0;
  } Tiles;

  // Kept between updates.
  relief::hosts::HostInputs Inputs;
  relief::hosts::PreparedScene Scene;
  relief::IlluminationCache Cache;
};

//------------------------------------------------------------------------------
vtkImageReliefShading::vtkImageReliefShading()
  : Internal(new Internals(this))
{
  this->SetNumberOfInputPorts(relief::hosts::HostInputs::NumberOfPorts);
  relief::hosts::HostInputs::NameArrays(this);
}

//------------------------------------------------------------------------------
vtkImageReliefShading::~vtkImageReliefShading() = default;

//------------------------------------------------------------------------------
void vtkImageReliefShading::SetScene(vtkReliefScene* scene)
{
  this->Internal->Inputs.SetScene(scene);
}

//------------------------------------------------------------------------------
vtkReliefScene* vtkImageReliefShading::GetScene()
{
  return this->Internal->Inputs.GetScene();
}

//------------------------------------------------------------------------------
void vtkImageReliefShading::SetLookupTable(vtkScalarsToColors* table)
{
  this->Internal->Inputs.SetLookupTable(table);
}

//------------------------------------------------------------------------------
vtkScalarsToColors* vtkImageReliefShading::GetLookupTable()
{
  return this->Internal->Inputs.GetLookupTable();
}

//------------------------------------------------------------------------------
void vtkImageReliefShading::SetNoDataValue(double value)
{
  this->Internal->Inputs.SetNoDataValue(value, this->NoDataValue, this->UseNoDataValue);
}

//------------------------------------------------------------------------------
void vtkImageReliefShading::SetHeightRange(double least, double greatest)
{
  // False for NaN.
  if (!(least <= greatest && std::abs(least) <= VTK_DOUBLE_MAX && greatest <= VTK_DOUBLE_MAX))
  {
    vtkErrorMacro(
      "SetHeightRange: " << least << " to " << greatest
                         << " was given, finite numbers, the least first, are expected; "
                         << this->HeightRange[0] << " to " << this->HeightRange[1] << " is kept.");
    return;
  }
  if (this->HeightRange[0] != least || this->HeightRange[1] != greatest || !this->UseHeightRange)
  {
    this->HeightRange[0] = least;
    this->HeightRange[1] = greatest;
    this->UseHeightRange = true;
    this->Modified();
  }
}

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
  this->Internal->Inputs.Release();
  this->Internal->Tiles = Internals::TileShading();
  this->Internal->Cache.Keep({});
}

//------------------------------------------------------------------------------
vtkReliefStatistics* vtkImageReliefShading::GetStatistics()
{
  return this->Internal->Statistics;
}

//------------------------------------------------------------------------------
vtkMTimeType vtkImageReliefShading::GetMTime()
{
  return this->Internal->Inputs.GetMTime(this->Superclass::GetMTime());
}

//------------------------------------------------------------------------------
// Brings all that is at the ports up to date, whole.
vtkInformationVector** vtkImageReliefShading::UpdateInputs()
{
  for (int port = 0; port < relief::hosts::HostInputs::NumberOfPorts; ++port)
  {
    if (this->GetNumberOfInputConnections(port) > 0)
    {
      this->GetInputConnection(port, 0)->GetProducer()->UpdateWholeExtent();
    }
  }
  return this->GetExecutive()->GetInputInformation();
}

//------------------------------------------------------------------------------
// When what is shaded has changed, be it here or anywhere before.
vtkMTimeType vtkImageReliefShading::GetPipelineMTime()
{
  auto* pipeline = vtkDemandDrivenPipeline::SafeDownCast(this->GetExecutive());
  pipeline->UpdatePipelineMTime();
  return std::max(this->GetMTime(), pipeline->GetPipelineMTime());
}

//------------------------------------------------------------------------------
// What the next update would shade. Returns an empty text, or what is wrong.
std::string vtkImageReliefShading::PrepareModel(
  const relief::HeightField*& field, relief::Scene& scene)
{
  Internals& internal = *this->Internal;
  std::string wrong = internal.Prepare(this->UpdateInputs());
  if (wrong.empty() && internal.Inputs.GetTiledHeights())
  {
    wrong = "the heights are read as they are needed; heights in memory are expected";
  }
  if (wrong.empty())
  {
    field = &internal.Inputs.GetField();
    scene = internal.Scene.Get();
  }
  return wrong;
}

//------------------------------------------------------------------------------
double vtkImageReliefShading::EstimateMemory(const int extent[6])
{
  return this->Internal->Estimate(extent, this->UpdateInputs()).bytes / 1024.0;
}

//------------------------------------------------------------------------------
// Every light's rays cross what is provided, and begin at the extent's own samples.
double vtkImageReliefShading::EstimateWork(const int extent[6])
{
  return this->Internal->Estimate(extent, this->UpdateInputs()).samples;
}

//------------------------------------------------------------------------------
int vtkImageReliefShading::GetModelVersion()
{
  return relief::ModelVersion;
}

//------------------------------------------------------------------------------
std::string vtkImageReliefShading::GetHeightHash()
{
  vtkInformationVector** inputs = this->UpdateInputs();
  std::string wrong;
  const std::uint64_t hash = relief::hosts::HashHeights(
    relief::hosts::HostInputs::ReadHeights(
      inputs, [&](int port) { return this->GetInputArrayToProcess(port, inputs); },
      this->Internal->GetReading()),
    wrong);
  if (!wrong.empty())
  {
    vtkErrorMacro(<< wrong << ".");
    return std::string();
  }
  return relief::HashText(hash);
}

//------------------------------------------------------------------------------
int vtkImageReliefShading::FillInputPortInformation(int port, vtkInformation* info)
{
  return relief::hosts::HostInputs::FillPort(port, info);
}

//------------------------------------------------------------------------------
int vtkImageReliefShading::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkInformation* info = outputs->GetInformationObject(0);
  vtkDataObject::SetPointDataActiveScalarInfo(info, this->OutputScalarType, 4);
  if (this->UseHeightRange)
  {
    // A process makes the piece that it is asked for by its number, whatever its input can do.
    info->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkImageReliefShading::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  Internals& internal = *this->Internal;
  internal.InPieces = internal.AsksForPieces(inputs);
  if (!internal.InPieces)
  {
    relief::hosts::HostInputs::AskForAll(inputs);
    return 1;
  }
  int piece[6];
  FindNumberedPiece(
    inputs[0]->GetInformationObject(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()),
    outputs->GetInformationObject(0), piece);
  internal.Inputs.AskForPiece(inputs, this->HeightRange, piece);
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
relief::hosts::HostInputs::Reading vtkImageReliefShading::Internals::GetReading() const
{
  return { this->Self->UseNoDataValue, this->Self->NoDataValue, this->Self->StretchTextures };
}

//------------------------------------------------------------------------------
// Heights, textures and scene, as far as they have changed. Returns an empty text, or what is
// wrong.
std::string vtkImageReliefShading::Internals::Prepare(vtkInformationVector** inputs)
{
  const std::string wrong = this->Inputs.Update(
    inputs, [&](int port) { return this->Self->GetInputArrayToProcess(port, inputs); },
    this->GetReading(), true);
  if (!wrong.empty())
  {
    return wrong;
  }
  this->WarnOfHeights();
  return this->Scene.Update(this->Inputs);
}

//------------------------------------------------------------------------------
// Whether a piece of the picture can be made of a piece of the heights: nothing that is asked for
// depends on all of them but by their range.
bool vtkImageReliefShading::Internals::AsksForPieces(vtkInformationVector** inputs) const
{
  vtkInformation* info = inputs[0]->GetInformationObject(0);
  const bool exposed = this->Self->OutputScalarType == VTK_UNSIGNED_CHAR &&
    this->Inputs.GetScene()->GetAutomaticExposure();
  if (!this->Self->UseHeightRange || exposed || !relief::CanReserveMemory() || !info ||
    !info->Has(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()))
  {
    return false;
  }
  const int* whole = info->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
  return !IsEmpty(whole) && whole[4] == whole[5];
}

//------------------------------------------------------------------------------
// The same as Prepare(), of what the output's piece depends on. Returns an empty text, or what is
// wrong.
std::string vtkImageReliefShading::Internals::PreparePiece(
  vtkInformationVector** inputs, vtkInformation* outInfo)
{
  int piece[6];
  FindPiece(
    inputs[0]->GetInformationObject(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()),
    outInfo, piece);
  const auto arrays = [&](int port) { return this->Self->GetInputArrayToProcess(port, inputs); };
  const relief::hosts::HostInputs::Reading reading = this->GetReading();
  std::string wrong =
    this->Inputs.UpdatePiece(inputs, arrays, reading, this->Self->HeightRange, piece);
  if (wrong.empty())
  {
    this->WarnOfHeights();
    wrong = this->Scene.Update(this->Inputs);
  }
  int first[6];
  inputs[0]->GetInformationObject(0)->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), first);
  bool further = false;
  int extent[6];
  while (wrong.empty() && this->Inputs.MissesOfPiece(this->Scene.Get(), piece, extent))
  {
    if (this->IsAborted())
    {
      return std::string();
    }
    further = true;
    wrong = this->Inputs.UpdatePieceFurther(this->Self, extent, inputs, arrays, reading);
  }
  if (further && wrong.empty())
  {
    wrong = this->Inputs.RestorePiece(this->Self, first, inputs, arrays, reading);
  }
  return wrong;
}

//------------------------------------------------------------------------------
void vtkImageReliefShading::Internals::WarnOfHeights()
{
  const relief::HeightField& field = this->Inputs.GetField();
  const relief::HeightView<float>& heights = field.GetField().heights;
  if (!field.HasData())
  {
    vtkWarningWithObjectMacro(this->Self, "No sample has data; the output is transparent.");
  }
  else if (heights.columns < 2 || heights.rows < 2)
  {
    vtkWarningWithObjectMacro(this->Self,
      "An image of " << heights.columns << " x " << heights.rows
                     << " samples has no surface between them; each is shaded as level ground.");
  }
}

//------------------------------------------------------------------------------
// The picture, in the last one's room if it may, and the layers, to be filled. Returns an empty
// text, or what is wrong.
std::string vtkImageReliefShading::Internals::MakeOutput(vtkImageData* input, int outExtent[6],
  vtkInformation* outInfo, vtkSmartPointer<vtkDataArray>& last, relief::Target& target)
{
  const int* extent = input->GetExtent();
  vtkImageData* output = vtkImageData::GetData(outInfo);
  output->CopyStructure(input);
  output->SetExtent(outExtent);
  const vtkImageReliefShading* self = this->Self;
  try
  {
    const vtkIdType samples = output->GetNumberOfPoints();
    vtkSmartPointer<vtkDataArray> picture;
    if (self->OutputScalarType == VTK_FLOAT)
    {
      const auto colors = relief::hosts::MakePicture<vtkFloatArray>(last, samples, 4);
      target.rgba = colors->GetPointer(0);
      picture = colors;
    }
    else
    {
      const auto codes = relief::hosts::MakePicture<vtkUnsignedCharArray>(last, samples, 4);
      target.rgba8 = codes->GetPointer(0);
      picture = codes;
    }
    picture->SetName("Shading");
    output->GetPointData()->SetScalars(picture);
    target.illumination =
      relief::hosts::AddLayer(output, self->GenerateIllumination, "Illumination", 1);
    target.thickness = relief::hosts::AddLayer(output, self->GenerateThickness, "Thickness", 1);
    target.shadow = relief::hosts::AddLayer(output, self->GenerateShadow, "Shadow", 1);
    target.normals = relief::hosts::AddLayer(output, self->GenerateNormals, "Normals", 3);
    target.base = relief::hosts::AddLayer(output, self->GenerateBase, "Base", 3);
    target.diffuse = relief::hosts::AddLayer(output, self->GenerateDiffuse, "Diffuse", 3);
    target.scatter = relief::hosts::AddLayer(output, self->GenerateScatter, "Scatter", 3);
    target.specular = relief::hosts::AddLayer(output, self->GenerateSpecular, "Specular", 3);
  }
  catch (const std::bad_alloc&)
  {
    return "there is not enough memory for the output";
  }
  target.i0 = outExtent[0] - extent[0];
  target.j0 = outExtent[2] - extent[2];
  target.width = outExtent[1] - outExtent[0] + 1;
  target.rows = outExtent[3] - outExtent[2] + 1;
  return std::string();
}

//------------------------------------------------------------------------------
// What fills heights that are read as they are needed; none where all are in memory.
relief::hosts::WindowProvider vtkImageReliefShading::Internals::GetProvider()
{
  using relief::hosts::HeightSupply;
  relief::hosts::TiledHeights* heights = this->Inputs.GetTiledHeights();
  return !heights ? relief::hosts::WindowProvider()
                  : [this, heights](const std::vector<HeightSupply::Window>& windows)
  { heights->Provide(this->Scene.Get(), this->Scene.GetVersion(), windows); };
}

//------------------------------------------------------------------------------
relief::hosts::TiledHeights::Needs vtkImageReliefShading::Internals::Estimate(
  const int extent[6], vtkInformationVector** inputs)
{
  const std::string wrong = this->Prepare(inputs);
  if (!wrong.empty())
  {
    vtkErrorWithObjectMacro(this->Self, << wrong << ".");
    return {};
  }
  relief::hosts::TiledHeights* heights = this->Inputs.GetTiledHeights();
  const int* whole = vtkImageData::GetData(inputs[0])->GetExtent();
  return !heights ? relief::hosts::TiledHeights::Needs()
                  : heights->Estimate(this->Scene.Get(), this->Scene.GetVersion(),
                      { extent[0] - whole[0], extent[1] + 1 - whole[0], extent[2] - whole[2],
                        extent[3] + 1 - whole[2] });
}

//------------------------------------------------------------------------------
// The exposure of 8-bit output, unless it is at hand.
void vtkImageReliefShading::Internals::FindExposure()
{
  const std::uint64_t version = this->Scene.GetVersion();
  const std::uint64_t field = this->Inputs.GetField().GetVersion();
  if (this->Self->OutputScalarType == VTK_FLOAT)
  {
    this->Exposure = relief::hosts::PictureExposure();
    this->ExposedScene = 0;
  }
  else if (this->ExposedScene != version || this->ExposedField != field)
  {
    this->Exposure = relief::hosts::FindExposure(
      this->Inputs.GetScene(), this->Inputs.GetField(), this->Scene.Get(), this->GetProvider());
    this->ExposedScene = version;
    this->ExposedField = field;
  }
  else
  {
    this->Exposure.rays = this->Exposure.cells = 0; // no work of this run's
  }
}

//------------------------------------------------------------------------------
// Provides the heights that a part of the picture depends on. What is planned holds for all tiles.
relief::SceneShading* vtkImageReliefShading::Internals::PlanTile(const relief::Target& target)
{
  this->FindExposure();
  this->GetProvider()(
    { { target.i0, target.i0 + target.width, target.j0, target.j0 + target.rows } });
  const std::vector<bool> layers{ target.rgba8 != nullptr, target.illumination != nullptr,
    target.thickness != nullptr, target.shadow != nullptr, target.normals != nullptr,
    target.base != nullptr, target.diffuse != nullptr, target.scatter != nullptr,
    target.specular != nullptr };
  const std::uint64_t version = this->Scene.GetVersion();
  const std::uint64_t field = this->Inputs.GetField().GetVersion();
  TileShading& tiles = this->Tiles;
  if (tiles.shading && tiles.scene == version && tiles.field == field && tiles.layers == layers)
  {
    tiles.shading->Redirect(target);
    tiles.rays = tiles.shading->GetRaysTraced();
    tiles.cells = tiles.shading->GetCellsVisited();
    return tiles.shading.get();
  }
  relief::Scene scene = this->Scene.Get();
  scene.exposure = this->Exposure.stops;
  tiles.shading =
    std::make_unique<relief::SceneShading>(this->Inputs.GetField(), scene, target, nullptr);
  tiles.scene = version;
  tiles.field = field;
  tiles.layers = layers;
  tiles.rays = tiles.cells = 0;
  return tiles.shading.get();
}

//------------------------------------------------------------------------------
// Null where there is no memory for it.
std::unique_ptr<relief::SceneShading> vtkImageReliefShading::Internals::Plan(
  const relief::Target& target)
{
  this->Cache.SetLimit(static_cast<std::size_t>(this->Self->CacheMemoryLimit) * 1024);
  try
  {
    this->FindExposure();
    relief::Scene scene = this->Scene.Get();
    scene.exposure = this->Exposure.stops;
    return std::make_unique<relief::SceneShading>(
      this->Inputs.GetField(), scene, target, &this->Cache);
  }
  catch (const std::bad_alloc&)
  {
    return nullptr;
  }
}

//------------------------------------------------------------------------------
bool vtkImageReliefShading::Internals::IsAborted() const
{
  return vtkReliefIsAborted(this->Self);
}

//------------------------------------------------------------------------------
// Bands of tiles, one after another: between them observers hear of progress, on this thread, and
// may abort. Returns whether none did.
bool vtkImageReliefShading::Internals::ShadeBands(
  const relief::Target& target, relief::SceneShading& shading)
{
  constexpr int width = relief::SweepThickness::TileWidth;
  constexpr int height = relief::SweepThickness::TileHeight;
  const int firstRow = target.j0;
  const int endRow = target.j0 + target.rows;
  const int firstColumn = target.i0 / width;
  const int columns = (target.i0 + target.width + width - 1) / width - firstColumn;
  const int rows = (endRow + height - 1) / height - firstRow / height;
  // Threads wait for one another at a band's end, so short runs have few; and they take pieces of a
  // row that are short beside a band, but long beside the handing out.
  const double lights = std::max(shading.GetNumberOfLights(), 1);
  const double work = lights * target.width * target.rows;
  const int bands = static_cast<int>(std::clamp(work / 4.0e6, 3.0, 16.0));
  const int band = (rows + bands - 1) / bands;
  const double shares = 8.0 * vtkSMPTools::GetEstimatedNumberOfThreads();
  const int piece = std::clamp(
    static_cast<int>(std::min(64.0 / lights, columns * static_cast<double>(band) / shares)), 1,
    columns);
  const int pieces = (columns + piece - 1) / piece;
  for (int begin = 0; begin < rows && !this->IsAborted(); begin += band)
  {
    const int end = std::min(begin + band, rows);
    vtkReliefFor(static_cast<vtkIdType>(begin) * pieces, static_cast<vtkIdType>(end) * pieces, 1,
      [&](vtkIdType from, vtkIdType to)
      {
        for (vtkIdType at = from; at < to; ++at)
        {
          const int row = firstRow / height + static_cast<int>(at / pieces);
          const int column = firstColumn + static_cast<int>(at % pieces) * piece;
          shading.Shade(std::max(target.i0, column * width),
            std::min(target.i0 + target.width, (column + piece) * width),
            std::max(firstRow, row * height), std::min(endRow, (row + 1) * height));
        }
      });
    this->Self->UpdateProgress(static_cast<double>(end) / rows);
  }
  return !this->IsAborted();
}

//------------------------------------------------------------------------------
void vtkImageReliefShading::Internals::Tell(const relief::SceneShading& shading)
{
  this->Statistics->SetLightsReused(shading.GetLightsReused());
  this->Statistics->SetLightsTraced(shading.GetLightsTraced());
  const bool tile = &shading == this->Tiles.shading.get();
  const std::uint64_t rays =
    shading.GetRaysTraced() - (tile ? this->Tiles.rays : 0) + this->Exposure.rays;
  const std::uint64_t cells =
    shading.GetCellsVisited() - (tile ? this->Tiles.cells : 0) + this->Exposure.cells;
  this->Statistics->SetRaysTraced(static_cast<vtkTypeInt64>(rays));
  this->Statistics->SetCellsVisited(static_cast<vtkTypeInt64>(cells));
  this->Statistics->SetExposure(this->Exposure.stops);
  this->Statistics->SetEffectsEvaluated(shading.GetEffects());
}

//------------------------------------------------------------------------------
int vtkImageReliefShading::Shade(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  Internals& internal = *this->Internal;
  vtkInformation* outInfo = outputs->GetInformationObject(0);
  vtkImageData* output = vtkImageData::GetData(outInfo);
  vtkSmartPointer<vtkDataArray> last = output->GetPointData()->GetScalars();
  output->Initialize();
  // An error leaves the output empty. The pipeline would add a message of its own to a failure.
  auto fail = [&](const std::string& message)
  {
    vtkErrorMacro(<< message << ".");
    output->Initialize();
    return 1;
  };

  // What is shaded, and where to. Of a piece the image is the whole, without heights; a distributed
  // input holds its piece only, whatever has been asked for.
  relief::Target target;
  if (internal.InPieces && IsEmpty(outInfo->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT())))
  {
    return 1;
  }
  // Heights that are read as they are needed do without extents.
  const bool pieces = internal.InPieces &&
    !relief::hosts::TiledHeights::SafeDownCast(this->GetInputArrayToProcess(0, inputs));
  std::string wrong = pieces ? internal.PreparePiece(inputs, outInfo) : internal.Prepare(inputs);
  if (wrong.empty() && this->GenerateShadow && internal.Scene.Get().sun.empty())
  {
    wrong =
      "the layer Shadow is that of a sun, and no sun is on; add a sun, or leave the layer out";
  }
  if (wrong.empty())
  {
    vtkImageData* image = internal.Inputs.GetImage(inputs);
    int piece[6];
    FindPiece(image->GetExtent(), outInfo, piece);
    wrong = internal.MakeOutput(image, piece, outInfo, last, target);
  }
  if (!wrong.empty())
  {
    return fail(wrong);
  }
  if (output->GetNumberOfPoints() == 0)
  {
    return 1;
  }

  // What can be decided once, then all samples.
  const bool tiled = internal.Inputs.GetTiledHeights() != nullptr;
  std::unique_ptr<relief::SceneShading> whole;
  relief::SceneShading* shading = nullptr;
  try
  {
    whole = tiled ? nullptr : internal.Plan(target);
    shading = tiled ? internal.PlanTile(target) : whole.get();
  }
  catch (const std::bad_alloc&)
  {
    throw;
  }
  catch (const std::exception& error) // of who reads heights
  {
    return fail(error.what());
  }
  if (!shading)
  {
    return fail(
      "there is not enough memory to keep illuminations; SetCacheMemoryLimit(0) keeps none");
  }
  internal.Inputs.GetTextures().WarnOfTexels(shading->GetEffects(), this);
  if (!internal.ShadeBands(target, *shading))
  {
    output->Initialize();
    return 1;
  }

  // Where the heights come from, for writers: as VTK's filters do.
  output->GetFieldData()->PassData(vtkImageData::GetData(inputs[0])->GetFieldData());

  // The model knows the image's own frame only.
  const relief::hosts::ImageFrame& frame = internal.Inputs.GetFrame();
  if (target.normals && !frame.IsWorld())
  {
    vtkReliefFor(0, output->GetNumberOfPoints(), 0,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (vtkIdType at = begin; at < end; ++at)
        {
          frame.NormalToWorld(target.normals + 3 * at);
        }
      });
  }
  if (whole)
  {
    whole->KeepIlluminations();
  }
  internal.Tell(*shading);
  return 1;
}

//------------------------------------------------------------------------------
void vtkImageReliefShading::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  auto printSwitch = [&](const char* name, bool on)
  { os << indent << name << ": " << (on ? "On" : "Off") << "\n"; };
  this->Internal->Inputs.Print(os, indent, this->Internal->GetReading());
  os << indent << "HeightRange: " << this->HeightRange[0] << " to " << this->HeightRange[1] << "\n";
  printSwitch("UseHeightRange", this->UseHeightRange);
  os << indent
     << "OutputScalarType: " << (this->OutputScalarType == VTK_FLOAT ? "Float" : "UnsignedChar")
     << "\n";
  printSwitch("GenerateIllumination", this->GenerateIllumination);
  printSwitch("GenerateThickness", this->GenerateThickness);
  printSwitch("GenerateShadow", this->GenerateShadow);
  printSwitch("GenerateNormals", this->GenerateNormals);
  printSwitch("GenerateBase", this->GenerateBase);
  printSwitch("GenerateDiffuse", this->GenerateDiffuse);
  printSwitch("GenerateScatter", this->GenerateScatter);
  printSwitch("GenerateSpecular", this->GenerateSpecular);
  os << indent << "CacheMemoryLimit: " << this->CacheMemoryLimit << "\n";
  os << indent << "Statistics:\n";
  this->Internal->Statistics->PrintSelf(os, indent.GetNextIndent());
}
