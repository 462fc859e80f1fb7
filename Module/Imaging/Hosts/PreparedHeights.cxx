// SPDX-License-Identifier: BSD-3-Clause
#include "PreparedHeights.h"

#include "HeightInputs.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <new>

namespace relief::hosts
{
//------------------------------------------------------------------------------
std::string PreparedHeights::Update(const Source& source)
{
  std::string wrong = CheckHeights(source);
  if (wrong.empty())
  {
    wrong = this->Frame.Assign(source.image);
  }
  if (wrong.empty())
  {
    wrong = FindTiled(source) ? this->PrepareTiled(source) : this->Prepare(source);
  }
  if (!wrong.empty())
  {
    this->Release();
  }
  return wrong;
}

//------------------------------------------------------------------------------
std::string PreparedHeights::PrepareTiled(const Source& source)
{
  if (source.mask)
  {
    return "the heights are read as they are needed, and take no mask beside their own";
  }
  this->Field.reset();
  this->InPlace = nullptr;
  this->Tiled = FindTiled(source);
  try
  {
    return this->Tiled->Prepare(source.scale, this->Frame.Spacing, source.padded);
  }
  catch (const std::bad_alloc&)
  {
    return "there is not enough memory for the bounds of the heights";
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
}

//------------------------------------------------------------------------------
std::string PreparedHeights::Prepare(const Source& source)
{
  this->Tiled = nullptr;
  // Images may share their scalars, and then their time.
  const Origin madeFrom(source.image,
    std::max(source.image->GetMTime(), source.scalars->GetMTime()),
    source.mask ? std::max(source.mask->GetMTime(), source.maskScalars->GetMTime()) : 0,
    source.scalars, source.maskScalars, source.scale, source.useNoData,
    // NaN is no data in any case, and would never compare equal.
    std::isnan(source.noData) ? 0.0 : source.noData, source.padded);
  if (this->Field && this->MadeFrom == madeFrom)
  {
    return std::string();
  }

  // Room of the same size is used again.
  this->MadeFrom = Origin();
  if (!this->Field)
  {
    this->Field = std::make_unique<HeightField>();
  }
  std::string wrong;
  try
  {
    WithHeightSource(source, this->Frame.Spacing,
      [&](const auto& heights) { wrong = this->Field->Assign(heights, ForRows, source.padded); });
  }
  catch (const std::bad_alloc&)
  {
    wrong = "there is not enough memory for the prepared heights";
  }
  if (wrong.empty())
  {
    this->MadeFrom = madeFrom;
    this->InPlace = this->Field->IsInPlace() ? source.scalars : nullptr;
  }
  return wrong;
}

//------------------------------------------------------------------------------
void PreparedHeights::Release()
{
  this->Field.reset();
  this->Tiled = nullptr;
  this->InPlace = nullptr;
}
}
