// SPDX-License-Identifier: BSD-3-Clause
#include "PaddedHeights.h"

#include "HeightField.h"

#include "vtkObjectFactory.h"

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace relief::hosts
{
vtkStandardNewMacro(PaddedHeights);

namespace
{
/// Memory that the system takes from nobody before it is written; null where there is none. Much of
/// it in large pages: to be given small ones takes as long as to read the heights into them.
float* Take(std::size_t bytes)
{
#ifdef __linux__
  constexpr std::size_t page = std::size_t(2) << 20;
  if (bytes >= 4 * page)
  {
    void* memory = std::aligned_alloc(page, (bytes + page - 1) / page * page);
    if (memory)
    {
      madvise(memory, bytes, MADV_HUGEPAGE); // else they are small ones
    }
    return static_cast<float*>(memory);
  }
#endif
  return static_cast<float*>(std::malloc(bytes));
}
}

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
  this->Memory.reset(Take(count * sizeof(float)));
  if (!this->Memory)
  {
    throw std::bad_alloc();
  }
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
