// SPDX-License-Identifier: BSD-3-Clause
#include "vtkReliefHeights.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkReliefThreads.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <sstream>

namespace
{

void ForRows(int count, const std::function<void(int, int)>& body)
{
  vtkReliefFor(0, count, 0,
    [&](vtkIdType begin, vtkIdType end) { body(static_cast<int>(begin), static_cast<int>(end)); });
}

template <class T>
std::function<bool(int, int)> ReadMask(const T* mask, int columns)
{
  return [mask, columns](int i, int j)
  {
    T value = mask[static_cast<std::ptrdiff_t>(j) * columns + i];
    return value == value && value != 0;
  };
}

std::string CheckSource(const vtkReliefHeights::Source& source)
{
  std::string wrong = vtkReliefCheckInput(source.image, source.scalars, "height");
  if (!wrong.empty() || !source.mask)
  {
    return wrong;
  }
  wrong = vtkReliefCheckInput(source.mask, source.maskScalars, "mask");
  const int* expected = source.image->GetExtent();
  const int* given = source.mask->GetExtent();
  if (wrong.empty() && !std::equal(expected, expected + 6, given))
  {
    std::ostringstream message;
    message << "the mask's extent is (" << given[0] << ", " << given[1] << ", " << given[2] << ", "
            << given[3] << "), that of the heights is expected: (" << expected[0] << ", "
            << expected[1] << ", " << expected[2] << ", " << expected[3] << ")";
    wrong = message.str();
  }
  return wrong;
}

}

//------------------------------------------------------------------------------
std::string vtkReliefHeights::Update(const Source& source)
{
  std::string wrong = CheckSource(source);
  if (wrong.empty())
  {
    wrong = this->Frame.Assign(source.image);
  }
  if (wrong.empty())
  {
    wrong = this->Prepare(source);
  }
  if (!wrong.empty())
  {
    this->Release();
  }
  return wrong;
}

//------------------------------------------------------------------------------
std::string vtkReliefHeights::Prepare(const Source& source)
{
  const Origin madeFrom(std::max(source.image->GetMTime(), source.scalars->GetMTime()),
    source.mask ? std::max(source.mask->GetMTime(), source.maskScalars->GetMTime()) : 0,
    source.scalars, source.maskScalars, source.scale, source.useNoData,
    // NaN is no data in any case, and would never compare equal.
    std::isnan(source.noData) ? 0.0 : source.noData, source.padded);
  if (this->Field && this->MadeFrom == madeFrom)
  {
    return std::string();
  }

  this->Field = std::make_unique<relief::HeightField>();
  const int* extent = source.image->GetExtent();
  const int columns = extent[1] - extent[0] + 1;
  std::string wrong;
  try
  {
    std::function<bool(int, int)> hasData;
    if (source.mask)
    {
      switch (source.maskScalars->GetDataType())
      {
        vtkTemplateMacro(
          hasData =
            ReadMask(static_cast<const VTK_TT*>(source.maskScalars->GetVoidPointer(0)), columns));
      }
    }
    switch (source.scalars->GetDataType())
    {
      vtkTemplateMacro({
        relief::HeightSource<VTK_TT> heights;
        heights.data = static_cast<const VTK_TT*>(source.scalars->GetVoidPointer(0));
        heights.stepY = columns;
        heights.columns = columns;
        heights.rows = extent[3] - extent[2] + 1;
        heights.spacingX = this->Frame.Spacing[0];
        heights.spacingY = this->Frame.Spacing[1];
        heights.scale = source.scale;
        heights.hasNoData = source.useNoData && !std::isnan(source.noData);
        heights.noData = source.noData;
        heights.hasData = hasData;
        wrong = this->Field->Assign(heights, ForRows, source.padded);
      });
    }
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
void vtkReliefHeights::Release()
{
  this->Field.reset();
  this->InPlace = nullptr;
}
