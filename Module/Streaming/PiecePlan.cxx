// SPDX-License-Identifier: BSD-3-Clause
#include "PiecePlan.h"

#include "RasterBounds.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkImageReliefShading.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

namespace relief::streaming
{
namespace
{
/// Of the memory that a run may take, what pieces and bounds may. The rest is for the program
/// itself, and for what files are read through.
constexpr double MemoryShare = 0.7;

//------------------------------------------------------------------------------
/// What is in memory while a piece is shaded and the one before is saved.
double BytesOf(vtkImageReliefShading* shading, const PieceExtent& piece, double sampleBytes)
{
  const double samples = (piece[1] - piece[0] + 1.0) * (piece[3] - piece[2] + 1.0);
  return 1024.0 * shading->EstimateMemory(piece.data()) + 2.0 * sampleBytes * samples;
}

//------------------------------------------------------------------------------
/// Makes a band of arrays as a piece has them.
void MakeRoom(vtkImageData* piece, const PieceExtent& whole, const std::vector<std::string>& arrays,
  vtkImageData* band)
{
  const int* extent = piece->GetExtent();
  band->SetExtent(whole[0], whole[1], extent[2], extent[3], extent[4], extent[5]);
  for (const std::string& name : arrays)
  {
    vtkDataArray* values = piece->GetPointData()->GetArray(name.c_str());
    const auto all = vtkSmartPointer<vtkDataArray>::Take(values->NewInstance());
    all->SetName(name.c_str());
    all->SetNumberOfComponents(values->GetNumberOfComponents());
    all->SetNumberOfTuples(band->GetNumberOfPoints());
    band->GetPointData()->AddArray(all);
  }
  band->GetPointData()->SetActiveScalars(arrays.front().c_str());
}

//------------------------------------------------------------------------------
/// Copies an array of a piece to its place in the band.
void CopyArray(const char* name, vtkImageData* piece, vtkImageData* band)
{
  vtkDataArray* from = piece->GetPointData()->GetArray(name);
  vtkDataArray* to = band->GetPointData()->GetArray(name);
  const int components = from->GetNumberOfComponents();
  const int* extent = piece->GetExtent();
  const vtkIdType columns = band->GetDimensions()[0];
  const vtkIdType width = extent[1] - extent[0] + 1;
  const vtkIdType first = extent[0] - band->GetExtent()[0];
  const std::size_t bytes = static_cast<std::size_t>(width) * components * from->GetDataTypeSize();
  for (vtkIdType j = 0; j <= extent[3] - extent[2]; ++j)
  {
    std::memcpy(to->GetVoidPointer((j * columns + first) * components),
      from->GetVoidPointer(j * width * components), bytes);
  }
}
}

//------------------------------------------------------------------------------
PiecePlan::PiecePlan(
  vtkImageReliefShading* shading, const int extent[6], double memory, double sampleBytes)
{
  std::copy_n(extent, 6, this->Whole.begin());
  constexpr int region = RasterBounds::RegionSize;
  // Runs of few pieces lose more when they are stopped, and are shared out badly.
  constexpr int usualPieces = 64;
  const int columns = extent[1] - extent[0] + 1;
  const int rows = extent[3] - extent[2] + 1;
  this->Room = MemoryShare * memory - BoundsBytes * columns * rows;
  this->Columns = (columns + region - 1) / region * region;
  this->Rows = region * std::clamp(rows / usualPieces / region, 1, 16);
  for (;;)
  {
    this->Pieces = this->Cut();
    double largest = 0.0;
    for (const PieceExtent& piece : this->Pieces)
    {
      largest = std::max(largest, BytesOf(shading, piece, sampleBytes));
      if (largest > this->Room)
      {
        break;
      }
    }
    if (largest <= this->Room)
    {
      this->Fit = true;
      return;
    }
    if (this->Rows > region)
    {
      this->Rows /= 2;
    }
    else if (this->Columns > 4 * region)
    {
      this->Columns = (this->Columns / 2 + region - 1) / region * region;
    }
    else
    {
      return;
    }
  }
}

//------------------------------------------------------------------------------
double PiecePlan::MemoryFor(double bytes) const
{
  const double samples =
    (this->Whole[1] - this->Whole[0] + 1.0) * (this->Whole[3] - this->Whole[2] + 1.0);
  return (bytes + BoundsBytes * samples) / MemoryShare;
}

//------------------------------------------------------------------------------
double PiecePlan::FindLargest(vtkImageReliefShading* shading, double sampleBytes) const
{
  double largest = 0.0;
  for (const PieceExtent& piece : this->Pieces)
  {
    largest = std::max(largest, BytesOf(shading, piece, sampleBytes));
  }
  return largest;
}

//------------------------------------------------------------------------------
std::vector<PieceExtent> PiecePlan::Cut() const
{
  std::vector<PieceExtent> pieces;
  for (int j = this->Whole[2]; j <= this->Whole[3]; j += this->Rows)
  {
    for (int i = this->Whole[0]; i <= this->Whole[1]; i += this->Columns)
    {
      pieces.push_back({ i, std::min(i + this->Columns - 1, this->Whole[1]), j,
        std::min(j + this->Rows - 1, this->Whole[3]), this->Whole[4], this->Whole[5] });
    }
  }
  return pieces;
}

//------------------------------------------------------------------------------
int PiecePlan::GetNumberOfBands() const
{
  const int rows = this->Whole[3] - this->Whole[2] + 1;
  return this->Rows > 0 ? (rows + this->Rows - 1) / this->Rows : 0;
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkImageData> PiecePlan::LoadBand(int band, const std::vector<std::string>& arrays,
  const std::function<vtkSmartPointer<vtkImageData>(const PieceExtent&)>& load) const
{
  auto all = vtkSmartPointer<vtkImageData>::New();
  for (const PieceExtent& extent : this->Pieces)
  {
    if (extent[2] != this->Whole[2] + band * this->Rows)
    {
      continue;
    }
    const vtkSmartPointer<vtkImageData> piece = load(extent);
    if (extent[0] == this->Whole[0] && extent[1] == this->Whole[1])
    {
      return piece;
    }
    if (all->GetNumberOfPoints() == 0)
    {
      MakeRoom(piece, this->Whole, arrays, all);
    }
    for (const std::string& name : arrays)
    {
      CopyArray(name.c_str(), piece, all);
    }
  }
  return all;
}

//------------------------------------------------------------------------------
std::vector<PieceExtent> ShareOf(vtkImageReliefShading* shading,
  const std::vector<PieceExtent>& pieces, int process, int processes)
{
  if (processes < 2)
  {
    return pieces;
  }
  std::vector<double> ends; // of their work, one after another
  double sum = 0.0;
  for (const PieceExtent& piece : pieces)
  {
    // Of heights in memory nothing is told.
    const double work = shading->EstimateWork(piece.data());
    sum += work > 0.0 ? work : (piece[1] - piece[0] + 1.0) * (piece[3] - piece[2] + 1.0);
    ends.push_back(sum);
  }
  std::vector<PieceExtent> share;
  double begin = 0.0;
  for (std::size_t k = 0; k < pieces.size(); ++k)
  {
    const double middle = 0.5 * (begin + ends[k]);
    begin = ends[k];
    if (std::min(static_cast<int>(middle / sum * processes), processes - 1) == process)
    {
      share.push_back(pieces[k]);
    }
  }
  return share;
}

//------------------------------------------------------------------------------
std::vector<std::string> ArraysOf(vtkImageReliefShading* shading)
{
  std::vector<std::string> arrays{ "Shading" };
  const std::pair<bool, const char*> layers[] = { { shading->GetGenerateIllumination(),
                                                    "Illumination" },
    { shading->GetGenerateThickness(), "Thickness" }, { shading->GetGenerateShadow(), "Shadow" },
    { shading->GetGenerateNormals(), "Normals" }, { shading->GetGenerateBase(), "Base" },
    { shading->GetGenerateDiffuse(), "Diffuse" }, { shading->GetGenerateScatter(), "Scatter" },
    { shading->GetGenerateSpecular(), "Specular" } };
  for (const auto& [on, name] : layers)
  {
    if (on)
    {
      arrays.emplace_back(name);
    }
  }
  return arrays;
}
}
