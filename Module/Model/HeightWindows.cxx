// SPDX-License-Identifier: BSD-3-Clause
#include "HeightWindows.h"

#include "HeightView.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace relief
{

void HeightWindows::Allocate(int columns, int rows, int margin)
{
  const int cellColumns = std::max(columns - 1, 0);
  const int cellRows = std::max(rows - 1, 0);
  this->Columns = (cellColumns + Step - 1) / Step;
  this->Rows = (cellRows + Step - 1) / Step;
  this->Pitch = static_cast<std::size_t>(this->Columns) + margin;
  this->Lows.Allocate(this->Pitch * this->Rows);
  this->Highs.Allocate(this->Pitch * this->Rows);
}

void HeightWindows::Build(const HeightView<float>& heights, int begin, int end)
{
  // Down the columns first, then two columns at a time, then along, so that all but the last is
  // whole rows at a time. Behind the last column there is nothing to be found.
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const int columns = heights.columns;
  std::vector<float> lo(columns + Size, infinity);
  std::vector<float> hi(columns + Size, -infinity);
  for (int row = begin; row < end; ++row)
  {
    std::fill_n(lo.begin(), columns, infinity);
    std::fill_n(hi.begin(), columns, -infinity);
    const int last = std::min(row * Step + Size, heights.rows - 1);
    for (int j = row * Step; j <= last; ++j)
    {
      const float* own = heights.data + j * heights.stepY;
      for (int i = 0; i < columns; ++i)
      {
        lo[i] = std::min(lo[i], own[i]); // NaN leaves what was found before
        hi[i] = std::max(hi[i], own[i]);
      }
    }
    float* low = this->Lows.data() + row * this->Pitch;
    float* high = this->Highs.data() + row * this->Pitch;
    for (int window = 0; window < this->Columns; ++window)
    {
      const int i = window * Step;
      static_assert(Size == 4);
      low[window] =
        std::min(std::min(std::min(lo[i], lo[i + 1]), std::min(lo[i + 2], lo[i + 3])), lo[i + 4]);
      high[window] =
        std::max(std::max(std::max(hi[i], hi[i + 1]), std::max(hi[i + 2], hi[i + 3])), hi[i + 4]);
    }
    std::fill(low + this->Columns, low + this->Pitch, 0.0f);
    std::fill(high + this->Columns, high + this->Pitch, 0.0f);
  }
}

}
