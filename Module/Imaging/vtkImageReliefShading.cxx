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
#include "vtkReliefScene.h"
#include "vtkReliefSetters.h"
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
#include "OutputPiece.h"
#include "PictureArrays.h"
#include "PreparedScene.h"
#include "ReservedMemory.h"
#include "ShadingRun.h"
#include "TiledHeights.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <new>

vtkStandardNewMacro(vtkImageReliefShading);

class vtkImageReliefShading::Internals
{
public:
  explicit Internals(vtkImageReliefShading* self)
    : Self(self)
    , Inputs(self)
    , Run(self, this->Inputs, this->Scene)
  {
  }

  relief::hosts::HostInputs::Reading GetReading() const;
  relief::hosts::TiledHeights::Limit GetLimit() const;
  std::string Prepare(vtkInformationVector** inputs);
  bool AsksForPieces(vtkInformationVector** inputs) const;
  std::string PreparePiece(vtkInformationVector** inputs, vtkInformation* outInfo);
  std::string Convert();
  void WarnOfHeights();
  std::string MakeOutput(vtkImageData* input, int outExtent[6], vtkInformation* outInfo,
    vtkSmartPointer<vtkDataArray>& last, relief::Target& target);
  relief::hosts::TiledHeights::Needs Estimate(const int extent[6], vtkInformationVector** inputs);

  vtkImageReliefShading* Self;
  vtkNew<vtkReliefStatistics> Statistics;
  bool InPieces = false; // what has been asked for

  // Kept between updates.
  relief::hosts::HostInputs Inputs;
  relief::hosts::PreparedScene Scene;
  relief::hosts::ShadingRun Run;
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
void vtkImageReliefShading::SetHeightMemoryLimit(double kibibytes)
{
  relief::SetNumber(this, this->HeightMemoryLimit, kibibytes, kibibytes >= 0.0,
    "a number that is not negative", "HeightMemoryLimit");
}

//------------------------------------------------------------------------------
void vtkImageReliefShading::SetBeyondMemory(int mode)
{
  relief::SetNumber(this, this->BeyondMemory, mode,
    mode == BeyondMemoryRefuse || mode == BeyondMemoryBounds,
    "BeyondMemoryRefuse (0) or BeyondMemoryBounds (1)", "BeyondMemory");
}

//------------------------------------------------------------------------------
void vtkImageReliefShading::ReleaseCache()
{
  this->Internal->Inputs.Release();
  this->Internal->Run.Release();
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
// What the next update would shade, for those who can do with heights that are read as needed if
// they ask for these, null else. Returns an empty text, or what is wrong.
std::string vtkImageReliefShading::PrepareModel(
  const relief::HeightField*& field, relief::Scene& scene, relief::hosts::TiledHeights** tiled)
{
  Internals& internal = *this->Internal;
  std::string wrong = internal.Prepare(this->UpdateInputs());
  if (tiled)
  {
    *tiled = wrong.empty() ? internal.Inputs.GetTiledHeights() : nullptr;
  }
  else if (wrong.empty() && internal.Inputs.GetTiledHeights())
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
// Fills such heights where the light comes from that these samples have, by column and row: all of
// them, whatever may be left out of larger parts.
void vtkImageReliefShading::ProvideSamples(const std::vector<std::array<int, 2>>& samples)
{
  std::vector<relief::hosts::HeightSupply::Window> windows;
  windows.reserve(samples.size());
  for (const std::array<int, 2>& sample : samples)
  {
    windows.push_back({ sample[0], sample[0] + 1, sample[1], sample[1] + 1 });
  }
  Internals& internal = *this->Internal;
  internal.Inputs.GetTiledHeights()->Provide(internal.Scene.Get(), internal.Scene.GetVersion(),
    windows, relief::hosts::TiledHeights::Limit());
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
  relief::hosts::FindNumberedPiece(
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
relief::hosts::TiledHeights::Limit vtkImageReliefShading::Internals::GetLimit() const
{
  const double most = std::numeric_limits<double>::infinity();
  return { this->Self->HeightMemoryLimit < VTK_DOUBLE_MAX ? 1024.0 * this->Self->HeightMemoryLimit
                                                          : most,
    this->Self->BeyondMemory == BeyondMemoryBounds };
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
  return this->Convert();
}

//------------------------------------------------------------------------------
// The scene, once heights are prepared. Returns as Prepare() does.
std::string vtkImageReliefShading::Internals::Convert()
{
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
  return !relief::hosts::IsEmptyExtent(whole) && whole[4] == whole[5];
}

//------------------------------------------------------------------------------
// The same as Prepare(), of what the output's piece depends on. Returns an empty text, or what is
// wrong.
std::string vtkImageReliefShading::Internals::PreparePiece(
  vtkInformationVector** inputs, vtkInformation* outInfo)
{
  int piece[6];
  relief::hosts::FindPiece(
    inputs[0]->GetInformationObject(0)->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT()),
    outInfo, piece);
  const relief::hosts::PieceReading from = { this->Self, inputs,
    [&](int port) { return this->Self->GetInputArrayToProcess(port, inputs); }, this->GetReading(),
    this->Self->HeightRange };
  return relief::hosts::PreparePiece(
    this->Inputs, this->Scene, from, piece, [this] { return this->Convert(); });
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
relief::hosts::TiledHeights::Needs vtkImageReliefShading::Internals::Estimate(
  const int extent[6], vtkInformationVector** inputs)
{
  const std::string wrong = this->Prepare(inputs);
  if (!wrong.empty())
  {
    vtkErrorWithObjectMacro(this->Self, << wrong << ".");
    return {};
  }
  const int* whole = vtkImageData::GetData(inputs[0])->GetExtent();
  this->Run.SetLimit(this->GetLimit());
  return this->Run.Estimate({ extent[0] - whole[0], extent[1] + 1 - whole[0], extent[2] - whole[2],
    extent[3] + 1 - whole[2] });
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
  if (internal.InPieces &&
    relief::hosts::IsEmptyExtent(outInfo->Get(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT())))
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
    relief::hosts::FindPiece(image->GetExtent(), outInfo, piece);
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
  internal.Run.SetLimit(internal.GetLimit());
  wrong = internal.Run.Plan(target, static_cast<std::size_t>(this->CacheMemoryLimit) * 1024);
  if (!wrong.empty())
  {
    return fail(wrong);
  }
  internal.Inputs.GetTextures().WarnOfTexels(internal.Run.GetEffects(), this);
  if (!internal.Run.Shade())
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
  wrong = internal.Run.Finish(internal.Statistics);
  return wrong.empty() ? 1 : fail(wrong);
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
  os << indent << "HeightMemoryLimit: " << this->HeightMemoryLimit << "\n";
  os << indent
     << "BeyondMemory: " << (this->BeyondMemory == BeyondMemoryRefuse ? "Refuse" : "Bounds")
     << "\n";
  os << indent << "Statistics:\n";
  this->Internal->Statistics->PrintSelf(os, indent.GetNextIndent());
}
