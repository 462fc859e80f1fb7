// SPDX-License-Identifier: BSD-3-Clause
#include "PieceHeights.h"

#include "HeightReader.h"
#include "HeightRows.h"
#include "SceneShading.h"

#include "vtkMatrix3x3.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <sstream>
#include <type_traits>

namespace relief::hosts
{
namespace
{
constexpr int RegionSize = RasterBounds::RegionSize;

// How often it is taken for granted that what has not come yet has no holes. Then all as far as the
// border comes, in portions.
constexpr int MostGuesses = 4;

std::string ExtentText(const int extent[6])
{
  std::ostringstream text;
  text << "(" << extent[0] << ", " << extent[1] << ", " << extent[2] << ", " << extent[3] << ")";
  return text.str();
}

// Empty where the image has all of an extent.
std::string CheckHas(vtkImageData* image, const int extent[6], const char* what)
{
  const int* given = image->GetExtent();
  const bool has = given[0] <= extent[0] && given[1] >= extent[1] && given[2] <= extent[2] &&
    given[3] >= extent[3];
  return has ? std::string()
             : std::string("the ") + what + " image has the extent " + ExtentText(given) + ", " +
      ExtentText(extent) + " was asked for";
}

// Tells whether a sample of the heights' image has data by a mask of another extent.
std::function<bool(int, int)> ReadMaskFrom(const HeightInputs& inputs)
{
  if (!inputs.mask)
  {
    return nullptr;
  }
  HeightInputs own = inputs;
  own.image = inputs.mask;
  const int* heights = inputs.image->GetExtent();
  const int* mask = inputs.mask->GetExtent();
  return [hasData = ReadMask(own), di = heights[0] - mask[0], dj = heights[2] - mask[2]](
           int i, int j) { return hasData(i + di, j + dj); };
}
}

//------------------------------------------------------------------------------
std::string PartialField::Begin(const WholeHeights& whole)
{
  auto parts = [](const WholeHeights& w)
  { return std::tie(w.range[0], w.range[1], w.scale, w.floats, w.padded); };
  const double* matrix = whole.image->GetDirectionMatrix()->GetData();
  const bool same = this->Reserved && parts(whole) == parts(this->Known) &&
    std::equal(whole.image->GetExtent(), whole.image->GetExtent() + 6, this->Image->GetExtent()) &&
    std::equal(
      whole.image->GetSpacing(), whole.image->GetSpacing() + 3, this->Image->GetSpacing()) &&
    std::equal(whole.image->GetOrigin(), whole.image->GetOrigin() + 3, this->Image->GetOrigin()) &&
    std::equal(matrix, matrix + 9, this->Image->GetDirectionMatrix()->GetData());
  if (same)
  {
    return std::string();
  }
  this->Known = whole;
  this->Known.image = this->Image;
  this->Image->CopyStructure(whole.image);
  return this->Reserve();
}

//------------------------------------------------------------------------------
std::string PartialField::Reserve()
{
  this->Reserved = false;
  std::string wrong = this->Frame.Assign(this->Image);
  if (!wrong.empty())
  {
    return wrong;
  }
  // As HeightField does with all of the heights.
  const double ends[2] = { this->Known.range[0] * this->Known.scale,
    this->Known.range[1] * this->Known.scale };
  const double lo = std::min(ends[0], ends[1]);
  const double hi = std::max(ends[0], ends[1]);
  this->Datum = HeightField::FindDatum(lo, hi, this->Known.floats);
  const int* extent = this->Image->GetExtent();
  this->Bounds.Assume(extent[1] - extent[0] + 1, extent[3] - extent[2] + 1,
    { static_cast<float>(lo - this->Datum), static_cast<float>(hi - this->Datum) });
  if (!this->Sparse)
  {
    this->Sparse = std::make_unique<SparseHeights>();
  }
  wrong = this->Sparse->Reserve(
    this->Bounds, this->Frame.Spacing[0], this->Frame.Spacing[1], this->Datum, this->Known.padded);
  this->Reserved = wrong.empty();
  return wrong;
}

//------------------------------------------------------------------------------
TileRegions::Found PartialField::Find(const Scene& scene, const int piece[6]) const
{
  const int* whole = this->Image->GetExtent();
  if (std::equal(piece, piece + 4, whole))
  {
    TileRegions::Found all;
    all.read = RegionSet(this->Bounds.GetRegionColumns(), this->Bounds.GetRegionRows());
    all.level = all.read;
    all.read.Add(0, all.read.GetColumns() - 1, 0, all.read.GetRows() - 1);
    return all;
  }
  return TileRegions(*this->Sparse, scene)
    .Find(
      piece[0] - whole[0], piece[1] - whole[0] + 1, piece[2] - whole[2], piece[3] - whole[2] + 1);
}

//------------------------------------------------------------------------------
std::string PartialField::Fill(const RegionSet& regions, const HeightInputs& inputs)
{
  HeightInputs unmasked = inputs;
  unmasked.mask = nullptr;
  unmasked.scale = this->Known.scale;
  const int* whole = this->Image->GetExtent();
  const int* given = inputs.image->GetExtent();
  const int di = whole[0] - given[0];
  const int dj = whole[2] - given[2];
  WithHeightSource(unmasked, this->Frame.Spacing,
    [&](auto heights)
    {
      const std::function<bool(int, int)> hasData = ReadMaskFrom(inputs);
      this->Sparse->Fill(
        regions,
        [&](int i0, int i1, int j0, int j1, float* to, std::ptrdiff_t pitch)
        {
          auto part = heights;
          part.data += i0 + di;
          part.columns = i1 - i0;
          if (hasData)
          {
            part.hasData = [&](int i, int j) { return hasData(i0 + di + i, j); };
          }
          const HeightReader reader(part);
          for (int j = j0; j < j1; ++j)
          {
            reader.Read(j + dj, this->Datum, to + (j - j0) * pitch);
          }
        },
        ForRows);
    });
  this->Sparse->Complete(ForRows);
  this->Learn(regions);
  return this->CheckRange(regions);
}

//------------------------------------------------------------------------------
// Finds the bounds of regions that have come, and anew those of others that end at them.
void PartialField::Learn(const RegionSet& regions)
{
  RegionSet learned(regions.GetColumns(), regions.GetRows());
  for (const RegionSet::Interval& run : regions.GetIntervals())
  {
    for (int j = std::max(run.row - 1, 0); j <= run.row; ++j)
    {
      for (int i = std::max(run.begin - 1, 0); i < run.end; ++i)
      {
        if (regions.Has(i, j) || (this->Sparse->IsFilled(i, j) && !this->Bounds.IsAssumed(i, j)))
        {
          learned.Add(i, i, j, j);
        }
      }
    }
  }
  const std::vector<RegionSet::Interval> runs = learned.GetIntervals();
  const HeightView<float>& heights = this->Sparse->GetField().GetField().heights;
  const MinMaxPyramid& pyramid = this->Sparse->GetField().GetPyramid();
  const int level = std::min(MinMaxPyramid::RegionLevel, pyramid.GetNumberOfLevels()) - 1;
  ForRows(static_cast<int>(runs.size()),
    [&](int begin, int end)
    {
      for (int k = begin; k < end; ++k)
      {
        const int j0 = runs[k].row * RegionSize;
        const int j1 = std::min(j0 + RegionSize, heights.rows);
        for (int i = runs[k].begin; i < runs[k].end; ++i)
        {
          const int i0 = i * RegionSize;
          const int i1 = std::min(i0 + RegionSize, heights.columns);
          RasterBounds::Range range;
          for (int j = j0; j < j1; ++j)
          {
            AddToRange(heights.data + j * heights.stepY + i0, i1 - i0, range.lo, range.hi);
          }
          const bool cells = this->Bounds.HasCells(i, runs[k].row);
          this->Bounds.Learn(i, runs[k].row, range,
            cells ? pyramid.Over(level, i0, std::min(i1, heights.columns - 1) - 1, j0,
                      std::min(j1, heights.rows - 1) - 1)
                  : MinMaxPyramid::Bounds());
        }
      }
    });
}

//------------------------------------------------------------------------------
std::string PartialField::CheckRange(const RegionSet& regions) const
{
  RasterBounds::Range found;
  for (const RegionSet::Interval& run : regions.GetIntervals())
  {
    for (int i = run.begin; i < run.end; ++i)
    {
      const RasterBounds::Range& range = this->Bounds.RangeAt(i, run.row);
      found.lo = std::min(found.lo, range.lo);
      found.hi = std::max(found.hi, range.hi);
    }
  }
  const HeightField& field = this->Sparse->GetField();
  if (!(found.lo < field.GetBottom()) && !(found.hi > field.GetTop()))
  {
    return std::string();
  }
  double ends[2] = { (found.lo + this->Datum) / this->Known.scale,
    (found.hi + this->Datum) / this->Known.scale };
  std::sort(ends, ends + 2);
  std::ostringstream message;
  message << "heights reach from " << ends[0] << " to " << ends[1] << ", HeightRange says "
          << this->Known.range[0] << " to " << this->Known.range[1]
          << "; give the range of all heights";
  return message.str();
}

//------------------------------------------------------------------------------
void PartialField::ExtentOf(const RegionSet::Block& regions, int extent[6]) const
{
  const int* whole = this->Image->GetExtent();
  std::copy_n(whole, 6, extent);
  extent[0] = whole[0] + regions.i0 * RegionSize;
  extent[1] = std::min(whole[0] + (regions.i1 + 1) * RegionSize - 1, whole[1]);
  extent[2] = whole[2] + regions.j0 * RegionSize;
  extent[3] = std::min(whole[2] + (regions.j1 + 1) * RegionSize - 1, whole[3]);
}

//------------------------------------------------------------------------------
void PartialField::Release()
{
  this->Reserved = false;
  this->Bounds = RasterBounds();
  this->Sparse.reset();
}

//------------------------------------------------------------------------------
std::string PieceHeights::Begin(const WholeHeights& whole)
{
  this->Asked = RegionSet();
  return this->Empty.Begin(whole);
}

//------------------------------------------------------------------------------
void PieceHeights::Ask(const Scene& scene, const int piece[6], int extent[6])
{
  this->Guesses = 0;
  this->Portion = 0;
  this->AskFor(this->Empty.Find(scene, piece).read, 0, extent);
}

//------------------------------------------------------------------------------
// Asks for regions: all, or at first as many as an extent of so many holds.
void PieceHeights::AskFor(const RegionSet& missing, std::size_t most, int extent[6])
{
  RegionSet::Block around = { missing.GetColumns(), -1, missing.GetRows(), -1 };
  auto count = [](const RegionSet::Block& block)
  {
    return static_cast<std::size_t>(block.i1 - block.i0 + 1) *
      static_cast<std::size_t>(block.j1 - block.j0 + 1);
  };
  this->Asked = RegionSet(missing.GetColumns(), missing.GetRows());
  for (const RegionSet::Interval& run : missing.GetIntervals())
  {
    const RegionSet::Block wider = { std::min(around.i0, run.begin),
      std::max(around.i1, run.end - 1), std::min(around.j0, run.row), run.row };
    if (most > 0 && around.j1 >= 0 && count(wider) > most)
    {
      break;
    }
    around = wider;
    this->Asked.Add(run.begin, run.end - 1, run.row, run.row);
  }
  this->Portion = std::max(this->Portion, count(around));
  this->Empty.ExtentOf(around, extent);
}

//------------------------------------------------------------------------------
PieceHeights::Origin PieceHeights::OriginOf(const HeightInputs& inputs)
{
  return { inputs.image, std::max(inputs.image->GetMTime(), inputs.scalars->GetMTime()),
    inputs.mask ? std::max(inputs.mask->GetMTime(), inputs.maskScalars->GetMTime()) : 0,
    inputs.scalars, inputs.maskScalars, inputs.useNoData,
    // NaN is no data in any case, and would never compare equal.
    std::isnan(inputs.noData) ? 0.0 : inputs.noData };
}

//------------------------------------------------------------------------------
std::string PieceHeights::FillFirst(const WholeHeights& whole, const HeightInputs& inputs)
{
  std::string wrong = this->Held.Begin(whole);
  const Origin from = OriginOf(inputs);
  if (wrong.empty() && from != this->TakenFrom)
  {
    this->TakenFrom = from;
    this->Used = RegionSet();
    wrong = this->Held.Reserve();
  }
  if (wrong.empty())
  {
    // Those of the last piece stay, which may be shaded again under other lights.
    const RasterBounds& bounds = this->Held.Bounds;
    RegionSet kept(bounds.GetRegionColumns(), bounds.GetRegionRows());
    kept.Add(this->Asked);
    kept.Add(this->Used);
    this->Held.Sparse->Forget(kept);
  }
  return wrong.empty() ? this->FillMore(inputs) : wrong;
}

//------------------------------------------------------------------------------
std::string PieceHeights::FillMore(const HeightInputs& inputs)
{
  const RegionSet missing = this->Held.Sparse->FindMissing(this->Asked);
  RegionSet::Block around = { missing.GetColumns(), -1, missing.GetRows(), -1 };
  for (const RegionSet::Interval& run : missing.GetIntervals())
  {
    around = { std::min(around.i0, run.begin), std::max(around.i1, run.end - 1),
      std::min(around.j0, run.row), run.row };
  }
  std::string wrong;
  if (around.j1 >= 0)
  {
    int extent[6];
    this->Held.ExtentOf(around, extent);
    wrong = CheckHas(inputs.image, extent, "height");
    wrong = wrong.empty() && inputs.mask ? CheckHas(inputs.mask, extent, "mask") : wrong;
    wrong = wrong.empty() ? this->Held.Fill(missing, inputs) : wrong;
  }
  if (!wrong.empty())
  {
    this->Release();
  }
  return wrong;
}

//------------------------------------------------------------------------------
bool PieceHeights::NeedsMore(const Scene& scene, const int piece[6], int extent[6])
{
  TileRegions::Found found = this->Held.Find(scene, piece);
  RegionSet missing = this->Held.Sparse->FindMissing(found.read);
  const bool any = missing.Count() > 0;
  if (any && ++this->Guesses > MostGuesses)
  {
    this->Held.Bounds.AssumeHoles();
    missing = this->Held.Sparse->FindMissing(this->Held.Find(scene, piece).read);
  }
  if (any)
  {
    this->AskFor(missing, this->Portion, extent);
    return true;
  }
  this->Used = found.read;
  this->Used.Add(found.level);
  this->Held.Sparse->FillLevel(found.level, ForRows);
  this->Held.Sparse->Complete(ForRows);
  return false;
}

//------------------------------------------------------------------------------
void PieceHeights::Release()
{
  this->Empty.Release();
  this->Held.Release();
  this->TakenFrom = Origin();
}
}
