// SPDX-License-Identifier: BSD-3-Clause
#include "HeightWindows.h"

#include "HeightRows.h"
#include "HeightView.h"

#include <algorithm>
#include <vector>

namespace relief
{

void HeightWindows::SetSize(int columns, int rows, int margin)
{
  this->Samples = columns;
  const int cellColumns = std::max(columns - 1, 0);
  const int cellRows = std::max(rows - 1, 0);
  this->Columns = (cellColumns + Step - 1) / Step;
  this->Rows = (cellRows + Step - 1) / Step;
  this->Pitch = static_cast<std::size_t>(this->Columns) + margin;
}

void HeightWindows::Allocate(int columns, int rows, int margin)
{
  this->SetSize(columns, rows, margin);
  this->Lows.Allocate(this->Pitch * this->Rows);
  this->Highs.Allocate(this->Pitch * this->Rows);
}

bool HeightWindows::Reserve(int columns, int rows, int margin)
{
  this->SetSize(columns, rows, margin);
  const std::size_t count = this->Pitch * this->Rows;
  return this->Lows.Reserve(count) && this->Highs.Reserve(count);
}

void HeightWindows::BuildRegions(const HeightView<float>& heights, int begin, int end, int row)
{
  constexpr int side = MinMaxPyramid::RegionSize / Step;
  const int first = begin * side;
  const int count = std::min(end * side, this->Columns) - first;
  if (count <= 0)
  {
    return;
  }
  // The last of them reach over samples of the region behind, from which others begin that would
  // not have all of theirs: these are left out.
  const int i0 = first * Step;
  const int samples = std::min((count - 1) * Step + Size + 1, this->Samples - i0);
  std::vector<float> lows(static_cast<std::size_t>(count) + Size);
  std::vector<float> highs(lows.size());
  for (int j = row * side; j < std::min((row + 1) * side, this->Rows); ++j)
  {
    const float* rows[Size + 1];
    int number = 0;
    for (int k = j * Step; k <= std::min(j * Step + Size, heights.rows - 1); ++k)
    {
      rows[number++] = heights.data + k * heights.stepY + i0;
    }
    BoundWindows(rows, number, samples, lows.data(), highs.data());
    const std::size_t at = j * this->Pitch + first;
    std::copy_n(lows.data(), count, this->Lows.data() + at);
    std::copy_n(highs.data(), count, this->Highs.data() + at);
  }
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
