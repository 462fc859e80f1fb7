// SPDX-License-Identifier: BSD-3-Clause
#include "PaddedHeights.h"

#include "HeightField.h"
#include "LargePages.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <new>

namespace relief::hosts
{
vtkStandardNewMacro(PaddedHeights);

//------------------------------------------------------------------------------
void PaddedHeights::Free::operator()(float* heights) const
{
  std::free(heights);
}

//------------------------------------------------------------------------------
int PaddedHeights::GetMargin()
{
  return HeightField::Padding;
}

//------------------------------------------------------------------------------
void PaddedHeights::MakeRoom(vtkIdType columns, vtkIdType rows)
{
  const int margin = GetMargin();
  this->Columns = std::max<vtkIdType>(columns, 1);
  this->Rows = rows;
  this->Pitch = columns + 2 * margin;
  const auto count = static_cast<std::size_t>(this->Pitch) * static_cast<std::size_t>(rows + 1);
  this->Memory.reset(static_cast<float*>(std::malloc(count * sizeof(float))));
  if (!this->Memory)
  {
    throw std::bad_alloc();
  }
  relief::UseLargePages(this->Memory.get(), count * sizeof(float));
  this->First = this->Memory.get() + margin;
  const float none = std::numeric_limits<float>::quiet_NaN();
  for (vtkIdType j = 0; j < rows; ++j)
  {
    std::fill_n(this->GetRow(j) - margin, margin, none);
    std::fill_n(this->GetRow(j) + columns, margin, none);
  }
  std::fill_n(this->GetRow(rows) - margin, this->Pitch, none);
  this->Size = columns * rows;
  this->MaxId = this->Size - 1;
}

//------------------------------------------------------------------------------
bool PaddedHeights::AllocateTuples(vtkIdType count)
{
  try
  {
    this->MakeRoom(count, 1); // a copy that VTK makes knows nothing of rows
  }
  catch (const std::bad_alloc&)
  {
    return false;
  }
  return true;
}

//------------------------------------------------------------------------------
bool PaddedHeights::ReallocateTuples(vtkIdType)
{
  return false; // an image's heights do not become more
}

//------------------------------------------------------------------------------
void* PaddedHeights::GetVoidPointer(vtkIdType at)
{
  this->Copy.resize(static_cast<std::size_t>(this->Size));
  for (vtkIdType j = 0; j < this->Rows; ++j)
  {
    std::copy_n(this->GetRow(j), this->Columns, this->Copy.begin() + j * this->Columns);
  }
  return this->Copy.data() + at;
}
}
