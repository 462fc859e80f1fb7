// SPDX-License-Identifier: BSD-3-Clause
#include "HeightWindows.h"

#include "HeightRows.h"

#include <algorithm>

namespace relief
{

void HeightWindows::Allocate(int columns, int rows, int margin)
{
  this->Samples = columns;
  const int cellColumns = std::max(columns - 1, 0);
  const int cellRows = std::max(rows - 1, 0);
  this->Columns = (cellColumns + Step - 1) / Step;
  this->Rows = (cellRows + Step - 1) / Step;
  this->Pitch = static_cast<std::size_t>(this->Columns) + margin;
  this->Lows.Allocate(this->Pitch * this->Rows);
  this->Highs.Allocate(this->Pitch * this->Rows);
}

void HeightWindows::BuildRow(int row, const float* const* samples, int count)
{
  float* low = this->Lows.data() + row * this->Pitch;
  float* high = this->Highs.data() + row * this->Pitch;
  BoundWindows(samples, count, this->Samples, low, high);
  // Behind the last column there is nothing to be found.
  std::fill(low + this->Columns, low + this->Pitch, 0.0f);
  std::fill(high + this->Columns, high + this->Pitch, 0.0f);
}

}
