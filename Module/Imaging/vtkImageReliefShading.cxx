// SPDX-License-Identifier: BSD-3-Clause
#include "vtkImageReliefShading.h"

#include "vtkAlgorithmOutput.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
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
#include "LargePages.h"
#include "ModelVersion.h"
#include "PictureExposure.h"
#include "PreparedScene.h"
#include "SceneShading.h"
#include "TiledHeights.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <new>
#include <vector>

vtkStandardNewMacro(vtkImageReliefShading);

namespace
{

// Memory that begins at a line of the caches, which whole lines can be written to.
constexpr std::align_val_t Line{ 64 };

void FreeLines(void* memory)
{
  ::operator delete(memory, Line);
}

// Room for the picture. That of the last run is used again where nobody else has come to hold it,
// as vtkImageData::AllocateScalars() does.
template <class Array>
vtkSmartPointer<Array> MakePicture(
  vtkSmartPointer<vtkDataArray>& last, vtkIdType samples, int components)
{
  auto array = Array::SafeDownCast(last) != nullptr && last->GetReferenceCount() == 1 &&
      last->GetNumberOfComponents() == components && last->GetNumberOfTuples() == samples
    ? vtkSmartPointer<Array>(Array::SafeDownCast(last))
    : nullptr;
  last = nullptr; // before there is more
  if (array)
  {
    array->Modified();
    return array;
  }
  using Number = typename Array::ValueType;
  array = vtkSmartPointer<Array>::New();
  array->SetNumberOfComponents(components);
  const vtkIdType values = samples * components;
  const std::size_t bytes = static_cast<std::size_t>(values) * sizeof(Number);
  auto* memory = static_cast<Number*>(::operator new(bytes, Line));
  relief::UseLargePages(memory, bytes);
  array->SetArray(memory, values, 0, vtkAbstractArray::VTK_DATA_ARRAY_USER_DEFINED);
  array->SetArrayFreeFunction(FreeLines);
  return array;
}

float* AddLayer(vtkImageData* image, bool wanted, const char* name, int components)
{
  if (!wanted)
  {
    return nullptr;
  }
  // Where there is no memory, VTK's own arrays would report it as well.
  vtkSmartPointer<vtkDataArray> none;
  const auto layer = MakePicture<vtkFloatArray>(none, image->GetNumberOfPoints(), components);
  layer->SetName(name);
  image->GetPointData()->AddArray(layer);
  return layer->GetPointer(0);
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
  void WarnOfHeights();
  std::string MakeOutput(vtkImageData* input, vtkInformation* outInfo,
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
  vtkDataObject::SetPointDataActiveScalarInfo(
    outputs->GetInformationObject(0), this->OutputScalarType, 4);
  return 1;
}

//------------------------------------------------------------------------------
int vtkImageReliefShading::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector*)
{
  relief::hosts::HostInputs::AskForAll(inputs);
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
std::string vtkImageReliefShading::Internals::MakeOutput(vtkImageData* input,
  vtkInformation* outInfo, vtkSmartPointer<vtkDataArray>& last, relief::Target& target)
{
  // A distributed input holds its piece only, whatever has been asked for.
  const int* extent = input->GetExtent();
  int outExtent[6];
  outInfo->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), outExtent);
  for (int axis = 0; axis < 3; ++axis)
  {
    outExtent[2 * axis] = std::max(outExtent[2 * axis], extent[2 * axis]);
    outExtent[2 * axis + 1] = std::min(outExtent[2 * axis + 1], extent[2 * axis + 1]);
  }
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
      const auto colors = MakePicture<vtkFloatArray>(last, samples, 4);
      target.rgba = colors->GetPointer(0);
      picture = colors;
    }
    else
    {
      const auto codes = MakePicture<vtkUnsignedCharArray>(last, samples, 4);
      target.rgba8 = codes->GetPointer(0);
      picture = codes;
    }
    picture->SetName("Shading");
    output->GetPointData()->SetScalars(picture);
    target.illumination = AddLayer(output, self->GenerateIllumination, "Illumination", 1);
    target.thickness = AddLayer(output, self->GenerateThickness, "Thickness", 1);
    target.shadow = AddLayer(output, self->GenerateShadow, "Shadow", 1);
    target.normals = AddLayer(output, self->GenerateNormals, "Normals", 3);
    target.base = AddLayer(output, self->GenerateBase, "Base", 3);
    target.diffuse = AddLayer(output, self->GenerateDiffuse, "Diffuse", 3);
    target.scatter = AddLayer(output, self->GenerateScatter, "Scatter", 3);
    target.specular = AddLayer(output, self->GenerateSpecular, "Specular", 3);
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

  // What is shaded, and where to.
  relief::Target target;
  std::string wrong = internal.Prepare(inputs);
  if (wrong.empty() && this->GenerateShadow && internal.Scene.Get().sun.empty())
  {
    wrong =
      "the layer Shadow is that of a sun, and no sun is on; add a sun, or leave the layer out";
  }
  wrong = wrong.empty()
    ? internal.MakeOutput(vtkImageData::GetData(inputs[0]), outInfo, last, target)
    : wrong;
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
