// SPDX-License-Identifier: BSD-3-Clause
#include "GatheredSamples.h"

#include "vtkCellData.h"
#include "vtkCommunicator.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkMatrix3x3.h"
#include "vtkMultiProcessController.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace relief::paraview
{
namespace
{
// What a process tells the others of its piece.
enum Told
{
  HasSamples,
  LacksArray,
  Type,
  Components,
  OfCells,
  Extent,
  Origin = Extent + 6,
  Spacing = Origin + 3,
  Direction = Spacing + 3,
  NumberTold = Direction + 9
};
using Telling = std::array<double, NumberTold>;

bool IsEmpty(const int extent[6])
{
  return extent[0] > extent[1] || extent[2] > extent[3] || extent[4] > extent[5];
}

vtkIdType SizeOf(const int extent[6])
{
  return IsEmpty(extent) ? 0
                         : static_cast<vtkIdType>(extent[1] - extent[0] + 1) *
      (extent[3] - extent[2] + 1) * (extent[5] - extent[4] + 1);
}

std::array<int, 6> ExtentOf(const Telling& told)
{
  std::array<int, 6> extent;
  std::transform(told.begin() + Extent, told.begin() + Extent + 6, extent.begin(),
    [](double value) { return static_cast<int>(value); });
  return extent;
}

// The part of a piece that lies in the slice.
Telling Describe(vtkImageData* piece, int slice, const ArrayChoice& choice, vtkDataArray*& array)
{
  Telling told{};
  int extent[6] = { 0, -1, 0, -1, 0, -1 };
  bool ofCells = choice.ofCells;
  array = piece && piece->GetNumberOfPoints() > 0 ? FindArray(piece, choice, ofCells) : nullptr;
  if (array)
  {
    FindSampleExtent(piece->GetExtent(), ofCells, extent);
    extent[4] = std::max(extent[4], slice);
    extent[5] = std::min(extent[5], slice);
    told[HasSamples] = IsEmpty(extent) ? 0.0 : 1.0;
    told[Type] = array->GetDataType();
    told[Components] = array->GetNumberOfComponents();
    told[OfCells] = ofCells ? 1.0 : 0.0;
    std::copy_n(piece->GetOrigin(), 3, told.begin() + Origin);
    std::copy_n(piece->GetSpacing(), 3, told.begin() + Spacing);
    std::copy_n(piece->GetDirectionMatrix()->GetData(), 9, told.begin() + Direction);
  }
  else
  {
    told[LacksArray] = piece && piece->GetNumberOfPoints() > 0 ? 1.0 : 0.0;
  }
  std::copy_n(extent, 6, told.begin() + Extent);
  return told;
}

// Copies a box of samples, row by row, from an array over one extent to an array over another.
void CopyBox(vtkDataArray* from, const int fromExtent[6], vtkDataArray* to, const int toExtent[6],
  const int box[6])
{
  const auto place = [](const int extent[6], int i, int j, int k)
  {
    const vtkIdType columns = extent[1] - extent[0] + 1;
    const vtkIdType rows = extent[3] - extent[2] + 1;
    return (i - extent[0]) + columns * ((j - extent[2]) + rows * (k - extent[4]));
  };
  for (int k = box[4]; k <= box[5]; ++k)
  {
    for (int j = box[2]; j <= box[3]; ++j)
    {
      to->InsertTuples(
        place(toExtent, box[0], j, k), box[1] - box[0] + 1, place(fromExtent, box[0], j, k), from);
    }
  }
}

vtkSmartPointer<vtkDataArray> MakeArray(const Telling& like, vtkIdType samples)
{
  auto array = vtkSmartPointer<vtkDataArray>::Take(
    vtkDataArray::CreateDataArray(static_cast<int>(like[Type])));
  array->SetNumberOfComponents(static_cast<int>(like[Components]));
  array->SetNumberOfTuples(samples);
  return array;
}

// Whether pieces cover an extent; where they overlap they are one.
bool Cover(const std::vector<Telling>& pieces, const int extent[6])
{
  const vtkIdType columns = extent[1] - extent[0] + 1;
  const vtkIdType rows = extent[3] - extent[2] + 1;
  std::vector<bool> covered(static_cast<std::size_t>(columns * rows), false);
  for (const Telling& told : pieces)
  {
    const auto piece = ExtentOf(told);
    for (int j = piece[2]; told[HasSamples] != 0.0 && j <= piece[3]; ++j)
    {
      const auto row = covered.begin() + columns * (j - extent[2]);
      std::fill(row + (piece[0] - extent[0]), row + (piece[1] - extent[0] + 1), true);
    }
  }
  return std::all_of(covered.begin(), covered.end(), [](bool one) { return one; });
}

// What every process gets: the pieces, in the order of the processes, placed.
std::string Exchange(vtkMultiProcessController* controller, const std::vector<Telling>& pieces,
  const Telling& like, vtkDataArray* own, const int extent[6], vtkDataArray* all)
{
  std::vector<vtkIdType> lengths;
  std::vector<vtkIdType> offsets;
  vtkIdType total = 0;
  for (const Telling& told : pieces)
  {
    const auto piece = ExtentOf(told);
    offsets.push_back(total);
    lengths.push_back(
      told[HasSamples] != 0.0 ? SizeOf(piece.data()) * static_cast<int>(like[Components]) : 0);
    total += lengths.back();
  }
  if (total > std::numeric_limits<int>::max())
  {
    return "the image has " + std::to_string(total) +
      " values, and processes exchange no more than " +
      std::to_string(std::numeric_limits<int>::max()) + "; use one process";
  }
  auto received = MakeArray(like, total / static_cast<int>(like[Components]));
  controller->AllGatherV(own, received, lengths.data(), offsets.data());
  for (std::size_t rank = 0; rank < pieces.size(); ++rank)
  {
    const auto piece = ExtentOf(pieces[rank]);
    if (lengths[rank] > 0)
    {
      auto part = MakeArray(like, 0);
      const vtkIdType samples = SizeOf(piece.data());
      part->InsertTuples(0, samples, offsets[rank] / static_cast<int>(like[Components]), received);
      CopyBox(part, piece.data(), all, extent, piece.data());
    }
  }
  return std::string();
}
}

//------------------------------------------------------------------------------
ArrayChoice ChooseArray(int association, const char* name)
{
  return { association == vtkDataObject::FIELD_ASSOCIATION_CELLS, name ? name : "" };
}

//------------------------------------------------------------------------------
vtkDataArray* FindArray(vtkImageData* image, const ArrayChoice& choice, bool& ofCells)
{
  vtkDataSetAttributes* points = image->GetPointData();
  vtkDataSetAttributes* cells = image->GetCellData();
  if (!choice.name.empty())
  {
    ofCells = choice.ofCells;
    return (ofCells ? cells : points)->GetArray(choice.name.c_str());
  }
  for (vtkDataSetAttributes* attributes : { points, cells })
  {
    ofCells = attributes == cells;
    if (vtkDataArray* scalars = attributes->GetScalars())
    {
      return scalars;
    }
  }
  for (vtkDataSetAttributes* attributes : { points, cells })
  {
    ofCells = attributes == cells;
    if (attributes->GetNumberOfArrays() == 1)
    {
      return attributes->GetArray(0);
    }
  }
  ofCells = false;
  return nullptr;
}

//------------------------------------------------------------------------------
void FindSampleExtent(const int extent[6], bool ofCells, int samples[6])
{
  for (int axis = 0; axis < 3; ++axis)
  {
    samples[2 * axis] = extent[2 * axis];
    const bool fewer = ofCells && extent[2 * axis + 1] > extent[2 * axis];
    samples[2 * axis + 1] = extent[2 * axis + 1] - (fewer ? 1 : 0);
  }
}

//------------------------------------------------------------------------------
void FindSampleShift(const int whole[6], bool ofCells, double shift[3])
{
  for (int axis = 0; axis < 3; ++axis)
  {
    shift[axis] = ofCells && whole[2 * axis + 1] > whole[2 * axis] ? 0.5 : 0.0;
  }
}

//------------------------------------------------------------------------------
std::string GatherSamples(vtkMultiProcessController* controller, vtkImageData* piece,
  const int whole[6], int slice, const ArrayChoice& choice, vtkImageData* samples)
{
  samples->Initialize();
  vtkDataArray* array = nullptr;
  const Telling own = Describe(piece, slice, choice, array);
  const int processes = controller ? controller->GetNumberOfProcesses() : 1;
  std::vector<Telling> pieces(static_cast<std::size_t>(processes), own);
  if (processes > 1)
  {
    controller->AllGather(own.data(), pieces.front().data(), NumberTold);
  }
  if (std::any_of(
        pieces.begin(), pieces.end(), [](const Telling& told) { return told[LacksArray] != 0.0; }))
  {
    return choice.name.empty()
      ? std::string("the input has no scalars; choose an array by its name")
      : "the input has no array '" + choice.name + "' of " + (choice.ofCells ? "cells" : "points");
  }
  const auto first = std::find_if(
    pieces.begin(), pieces.end(), [](const Telling& told) { return told[HasSamples] != 0.0; });
  if (first == pieces.end())
  {
    return std::string();
  }
  const Telling like = *first;
  if (std::any_of(pieces.begin(), pieces.end(),
        [&like](const Telling& told)
        {
          return told[HasSamples] != 0.0 &&
            !std::equal(told.begin() + Type, told.begin() + Extent, like.begin() + Type);
        }))
  {
    return "the pieces of the input have arrays of different types";
  }

  int extent[6];
  FindSampleExtent(whole, like[OfCells] != 0.0, extent);
  extent[4] = extent[5] = slice;
  const auto ownExtent = ExtentOf(own);
  vtkSmartPointer<vtkDataArray> all = array;
  const bool isWhole = std::equal(ownExtent.begin(), ownExtent.end(), extent);
  if (processes > 1 || !isWhole || array->GetNumberOfTuples() != SizeOf(extent))
  {
    if (!Cover(pieces, extent))
    {
      return "the pieces of the input do not make up its whole extent";
    }
    const bool has = own[HasSamples] != 0.0;
    auto part = MakeArray(like, has ? SizeOf(ownExtent.data()) : 0);
    if (has)
    {
      int held[6];
      FindSampleExtent(piece->GetExtent(), own[OfCells] != 0.0, held);
      CopyBox(array, held, part, ownExtent.data(), ownExtent.data());
    }
    all = part;
    if (processes > 1)
    {
      all = MakeArray(like, SizeOf(extent));
      const std::string wrong = Exchange(controller, pieces, like, part, extent, all);
      if (!wrong.empty())
      {
        return wrong;
      }
    }
  }

  double shift[3];
  FindSampleShift(whole, like[OfCells] != 0.0, shift);
  samples->SetExtent(extent);
  samples->SetSpacing(&like[Spacing]);
  samples->SetDirectionMatrix(&like[Direction]);
  samples->SetOrigin(&like[Origin]);
  double origin[3];
  samples->TransformContinuousIndexToPhysicalPoint(shift, origin);
  samples->SetOrigin(origin);
  samples->GetPointData()->SetScalars(all);
  if (piece)
  {
    samples->GetFieldData()->ShallowCopy(piece->GetFieldData());
  }
  return std::string();
}

//------------------------------------------------------------------------------
KeptSamples::KeptSamples() = default;

KeptSamples::~KeptSamples() = default;

//------------------------------------------------------------------------------
std::string KeptSamples::Update(vtkMultiProcessController* controller, vtkImageData* piece,
  const int whole[6], int slice, const ArrayChoice& choice)
{
  std::array<int, 6> extent{};
  std::copy_n(whole, 6, extent.begin());
  const Origin origin(
    piece, piece ? piece->GetMTime() : 0, extent, slice, choice.ofCells, choice.name);
  int changed = !this->Made || this->MadeFrom != origin ? 1 : 0;
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    const int own = changed;
    controller->AllReduce(&own, &changed, 1, vtkCommunicator::MAX_OP);
  }
  if (changed == 0)
  {
    return std::string();
  }
  const std::string wrong = GatherSamples(controller, piece, whole, slice, choice, this->Samples);
  this->Made = wrong.empty();
  this->MadeFrom = origin;
  return wrong;
}

//------------------------------------------------------------------------------
void KeptSamples::Release()
{
  this->Samples->Initialize();
  this->Made = false;
}
}
