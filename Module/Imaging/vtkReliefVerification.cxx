// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefVerification.h"

#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkImageReliefShading.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkReliefAbort.h"
#include "vtkReliefColumns.h"
#include "vtkReliefThreads.h"
#include "vtkTable.h"

#include "HeightInputs.h"
#include "HeightReader.h"
#include "IlluminationCheck.h"
#include "TiledHeights.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <limits>
#include <map>
#include <new>
#include <numeric>
#include <utility>

vtkStandardNewMacro(vtkReliefVerification);

namespace
{
// `extent` is that of the heights, from whose first sample the model counts.
void FillTable(const relief::IlluminationCheck& check, const int* extent, vtkTable* table)
{
  auto* columns = vtkReliefAddColumn<vtkIntArray>(table, "Column");
  auto* rows = vtkReliefAddColumn<vtkIntArray>(table, "Row");
  auto* illuminations = vtkReliefAddColumn<vtkDoubleArray>(table, "Illumination");
  auto* references = vtkReliefAddColumn<vtkDoubleArray>(table, "Reference");
  auto* errors = vtkReliefAddColumn<vtkDoubleArray>(table, "Error");
  auto* grazing = vtkReliefAddColumn<vtkIntArray>(table, "Grazing");
  for (const relief::IlluminationCheck::Sample& sample : check.GetSamples())
  {
    columns->InsertNextValue(sample.i + extent[0]);
    rows->InsertNextValue(sample.j + extent[2]);
    illuminations->InsertNextValue(sample.d);
    references->InsertNextValue(sample.reference);
    errors->InsertNextValue(sample.error);
    grazing->InsertNextValue(sample.grazing ? 1 : 0);
  }
}

//------------------------------------------------------------------------------
constexpr const char* NoPicture = "the shading has been ended before it gave a picture";

vtkFloatArray* IlluminationOf(vtkImageData* shaded)
{
  return shaded ? vtkFloatArray::SafeDownCast(shaded->GetPointData()->GetArray("Illumination"))
                : nullptr;
}

//------------------------------------------------------------------------------
// Whether samples of heights that are read as needed have data: of one, or of all in their order.
class DataLookup
{
public:
  explicit DataLookup(relief::hosts::TiledHeights& heights)
    : Supply(heights.GetSupply())
    , Survey(heights.Survey())
    , Columns(static_cast<std::size_t>(this->Supply.GetColumns()))
  {
  }

  bool operator()(std::size_t at)
  {
    const int i = static_cast<int>(at % this->Columns);
    const int j = static_cast<int>(at / this->Columns);
    const bool goesOn = at == this->Last + 1;
    this->Last = at;
    if (!goesOn)
    {
      return this->Read({ i, i + 1, j, j + 1 }).front();
    }
    if (this->Rows.empty() || at < this->First || at >= this->First + this->Rows.size())
    {
      const int end = std::min(j + relief::RasterBounds::RegionSize, this->Supply.GetRows());
      this->Rows = this->Read({ 0, static_cast<int>(this->Columns), j, end });
      this->First = static_cast<std::size_t>(j) * this->Columns;
    }
    return this->Rows[at - this->First];
  }

private:
  std::vector<bool> Read(const relief::hosts::HeightSupply::Window& window)
  {
    const relief::hosts::HeightSupply::Part part = this->Supply.Read(window);
    std::vector<float> row(static_cast<std::size_t>(window.i1 - window.i0));
    std::vector<bool> present;
    const double unit[2] = { 1.0, 1.0 };
    relief::hosts::WithHeightSource(relief::hosts::InputsOf(part, this->Survey.scale), unit,
      [&](const auto& heights)
      {
        const relief::HeightReader reader(heights);
        for (int j = 0; j < window.j1 - window.j0; ++j)
        {
          reader.Read(j, this->Survey.datum, row.data());
          for (const float height : row)
          {
            present.push_back(!std::isnan(height));
          }
        }
      });
    return present;
  }

  relief::hosts::HeightSupply& Supply;
  const relief::hosts::HeightSurvey& Survey;
  std::size_t Columns;
  std::size_t Last = std::numeric_limits<std::size_t>::max() - 1;
  std::vector<bool> Rows; // those that begin with a sample
  std::size_t First = 0;
};

//------------------------------------------------------------------------------
// The same samples as of heights in memory.
std::vector<relief::IlluminationCheck::Sample> DrawOfTiled(
  relief::hosts::TiledHeights& heights, std::size_t wanted, std::uint64_t seed)
{
  const auto columns = static_cast<std::size_t>(heights.GetSupply().GetColumns());
  const auto rows = static_cast<std::size_t>(heights.GetSupply().GetRows());
  DataLookup lookup(heights);
  std::vector<relief::IlluminationCheck::Sample> samples;
  for (const std::size_t at : relief::DrawSamples(
         columns * rows, wanted, seed, [&lookup](std::size_t k) { return lookup(k); }))
  {
    relief::IlluminationCheck::Sample sample;
    sample.i = static_cast<int>(at % columns);
    sample.j = static_cast<int>(at / columns);
    samples.push_back(sample);
  }
  return samples;
}

//------------------------------------------------------------------------------
// Which samples lie in which piece, those without any left out; without pieces, in which region.
std::map<std::array<int, 6>, std::vector<std::size_t>> SamplesOfPieces(
  const std::vector<relief::IlluminationCheck::Sample>& samples, const int extent[6],
  const std::vector<std::array<int, 6>>& pieces)
{
  constexpr int region = relief::RasterBounds::RegionSize;
  std::map<std::array<int, 6>, std::vector<std::size_t>> found;
  for (std::size_t k = 0; k < samples.size(); ++k)
  {
    const int i = samples[k].i + extent[0];
    const int j = samples[k].j + extent[2];
    const auto around = std::find_if(pieces.begin(), pieces.end(),
      [i, j](const std::array<int, 6>& piece)
      { return i >= piece[0] && i <= piece[1] && j >= piece[2] && j <= piece[3]; });
    const int i0 = extent[0] + samples[k].i / region * region;
    const int j0 = extent[2] + samples[k].j / region * region;
    found[around != pieces.end() ? *around
                                 : std::array<int, 6>{ i0, std::min(i0 + region - 1, extent[1]), j0,
                                     std::min(j0 + region - 1, extent[3]), extent[4], extent[5] }]
      .push_back(k);
  }
  return found;
}
}

//------------------------------------------------------------------------------
vtkReliefVerification::vtkReliefVerification()
{
  this->SetNumberOfInputPorts(0);
}

//------------------------------------------------------------------------------
vtkReliefVerification::~vtkReliefVerification() = default;

//------------------------------------------------------------------------------
void vtkReliefVerification::SetShading(vtkImageReliefShading* shading)
{
  if (this->Shading != shading)
  {
    this->Shading = shading;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
vtkImageReliefShading* vtkReliefVerification::GetShading()
{
  return this->Shading;
}

//------------------------------------------------------------------------------
void vtkReliefVerification::SetNumberOfSamples(vtkTypeInt64 count)
{
  if (count < 1)
  {
    vtkErrorMacro("SetNumberOfSamples: " << count
                                         << " was given, a number of at least 1 is expected; "
                                         << this->NumberOfSamples << " is kept.");
  }
  else if (this->NumberOfSamples != count)
  {
    this->NumberOfSamples = count;
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkReliefVerification::SetPieces(
  const std::vector<std::array<int, 6>>& pieces, const PieceSource& source)
{
  this->Pieces = pieces;
  this->Source = source;
  this->Modified();
}

//------------------------------------------------------------------------------
vtkMTimeType vtkReliefVerification::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->Shading ? std::max(own, this->Shading->GetPipelineMTime()) : own;
}

//------------------------------------------------------------------------------
void vtkReliefVerification::Forget()
{
  this->Kept = false;
  this->LargestError = 0.0;
  this->WorstColumn = -1;
  this->WorstRow = -1;
  this->PromisedError = 0.0;
  this->RoundingError = 0.0;
  this->NumberOfRetracedSamples = 0;
  this->NumberOfGrazingSamples = 0;
}

//------------------------------------------------------------------------------
// Block by block, that observers may end it. Returns whether they have not.
bool vtkReliefVerification::Retrace(
  relief::IlluminationCheck& check, const std::vector<std::size_t>& samples, std::size_t done)
{
  constexpr std::size_t block = 256;
  for (std::size_t begin = 0; begin < samples.size(); begin += block)
  {
    const std::size_t end = std::min(begin + block, samples.size());
    vtkReliefFor(static_cast<vtkIdType>(begin), static_cast<vtkIdType>(end), 1,
      [&](vtkIdType from, vtkIdType to)
      {
        for (vtkIdType k = from; k < to; ++k)
        {
          check.Retrace(samples[static_cast<std::size_t>(k)]);
        }
      });
    this->UpdateProgress(
      static_cast<double>(done + end) / static_cast<double>(check.GetNumberOfSamples()));
    if (vtkReliefIsAborted(this))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// `extent` is that of the heights.
void vtkReliefVerification::Tell(
  const relief::IlluminationCheck& check, const int extent[6], vtkTable* table)
{
  FillTable(check, extent, table);
  this->Kept = check.IsKept();
  this->PromisedError = check.GetTolerance() + check.GetRounding();
  this->RoundingError = check.GetRounding();
  this->NumberOfRetracedSamples = static_cast<vtkTypeInt64>(check.GetNumberOfSamples());
  this->NumberOfGrazingSamples = static_cast<vtkTypeInt64>(check.CountGrazing());
  if (const relief::IlluminationCheck::Sample* worst = check.GetWorst())
  {
    this->LargestError = worst->error;
    this->WorstColumn = worst->i + extent[0];
    this->WorstRow = worst->j + extent[2];
  }
}

//------------------------------------------------------------------------------
// Returns an empty text, or what is wrong.
std::string vtkReliefVerification::Verify(vtkTable* table)
{
  if (!this->Shading)
  {
    return "there is no shading to verify; SetShading() gives it";
  }
  const relief::HeightField* field = nullptr;
  relief::hosts::TiledHeights* tiled = nullptr;
  relief::Scene scene;
  std::string wrong = this->Shading->PrepareModel(field, scene, &tiled);
  if (wrong.empty() && !this->Shading->GetGenerateIllumination())
  {
    wrong = "the shading has no layer Illumination; its GenerateIlluminationOn() makes it";
  }
  if (wrong.empty() && scene.integrator != relief::Integrator::Exact)
  {
    wrong = "fixed steps promise no accuracy; the scene's integrator Exact does";
  }
  return !wrong.empty() ? wrong : tiled ? this->VerifyPieces(table) : this->VerifyWhole(table);
}

//------------------------------------------------------------------------------
std::string vtkReliefVerification::VerifyWhole(vtkTable* table)
{
  // What was shaded, and the field and scene that it is of.
  this->Shading->Update();
  const relief::HeightField* field = nullptr;
  relief::Scene scene;
  const std::string wrong = this->Shading->PrepareModel(field, scene);
  vtkImageData* output = this->Shading->GetOutput();
  vtkFloatArray* layer = IlluminationOf(output);
  if (!wrong.empty() || !layer)
  {
    return wrong.empty() ? NoPicture : wrong;
  }
  const int* extent =
    vtkImageData::SafeDownCast(this->Shading->GetInputDataObject(0, 0))->GetExtent();
  const int* shaded = output->GetExtent();
  relief::IlluminationCheck::Part part;
  part.i0 = shaded[0] - extent[0];
  part.j0 = shaded[2] - extent[2];
  part.columns = shaded[1] - shaded[0] + 1;
  part.rows = shaded[3] - shaded[2] + 1;
  part.illumination = layer->GetPointer(0);
  relief::IlluminationCheck check(
    *field, scene, part, static_cast<std::size_t>(this->NumberOfSamples), this->Seed);
  std::vector<std::size_t> all(check.GetNumberOfSamples());
  std::iota(all.begin(), all.end(), std::size_t(0));
  if (this->Retrace(check, all, 0))
  {
    this->Tell(check, extent, table);
  }
  return std::string();
}

//------------------------------------------------------------------------------
std::string vtkReliefVerification::VerifyPieces(vtkTable* table)
{
  const relief::HeightField* field = nullptr;
  relief::hosts::TiledHeights* heights = nullptr;
  relief::Scene scene;
  std::string wrong = this->Shading->PrepareModel(field, scene, &heights);
  if (!wrong.empty())
  {
    return wrong;
  }
  int extent[6];
  vtkImageData::SafeDownCast(this->Shading->GetInputDataObject(0, 0))->GetExtent(extent);
  relief::IlluminationCheck check(*field, scene,
    DrawOfTiled(*heights, static_cast<std::size_t>(this->NumberOfSamples), this->Seed));
  std::size_t done = 0;
  for (const auto& [piece, samples] : SamplesOfPieces(check.GetSamples(), extent, this->Pieces))
  {
    vtkSmartPointer<vtkImageData> shaded;
    if (this->Source)
    {
      shaded = this->Source(piece.data());
    }
    else
    {
      this->Shading->UpdateExtent(piece.data());
      shaded = this->Shading->GetOutput();
    }
    vtkFloatArray* layer = IlluminationOf(shaded);
    if (!layer)
    {
      return NoPicture;
    }
    std::vector<std::array<int, 2>> places;
    for (const std::size_t k : samples)
    {
      const relief::IlluminationCheck::Sample& sample = check.GetSamples()[k];
      int point[3] = { sample.i + extent[0], sample.j + extent[2], extent[4] };
      check.SetIllumination(k, layer->GetValue(shaded->ComputePointId(point)));
      places.push_back({ sample.i, sample.j });
    }
    this->Shading->ProvideSamples(places);
    if (!this->Retrace(check, samples, done))
    {
      return std::string();
    }
    done += samples.size();
  }
  this->Tell(check, extent, table);
  return std::string();
}

//------------------------------------------------------------------------------
int vtkReliefVerification::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkTable* table = vtkTable::GetData(outputs);
  table->Initialize();
  this->Forget();
  std::string wrong;
  try
  {
    wrong = this->Verify(table);
  }
  catch (const std::bad_alloc&)
  {
    table->Initialize();
    this->Forget();
    wrong = "there is not enough memory to verify the shading";
  }
  catch (const std::exception& error) // of whoever gives heights, or pieces
  {
    table->Initialize();
    this->Forget();
    wrong = error.what();
  }
  if (!wrong.empty())
  {
    vtkErrorMacro(<< wrong << ".");
  }
  return 1;
}

//------------------------------------------------------------------------------
void vtkReliefVerification::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Shading: " << this->Shading << "\n";
  os << indent << "NumberOfSamples: " << this->NumberOfSamples << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "Kept: " << (this->Kept ? "On" : "Off") << "\n";
  os << indent << "LargestError: " << this->LargestError << "\n";
  os << indent << "WorstColumn: " << this->WorstColumn << "\n";
  os << indent << "WorstRow: " << this->WorstRow << "\n";
  os << indent << "PromisedError: " << this->PromisedError << "\n";
  os << indent << "RoundingError: " << this->RoundingError << "\n";
  os << indent << "NumberOfRetracedSamples: " << this->NumberOfRetracedSamples << "\n";
  os << indent << "NumberOfGrazingSamples: " << this->NumberOfGrazingSamples << "\n";
}
