// SPDX-License-Identifier: BSD-3-Clause
#include "HeightEdges.h"

namespace relief
{

//------------------------------------------------------------------------------
void HeightEdges::Resize(int newColumns, int newRows)
{
  this->columns = newColumns;
  this->rows = newRows;
  for (std::vector<double>* values : { &this->weightX, &this->weightY, &this->riseX, &this->riseY })
  {
    values->assign(this->GetSize(), 0.0);
  }
}

//------------------------------------------------------------------------------
void HeightEdges::FindRightSide(std::vector<double>& result, const ParallelFor& parallelFor) const
{
  result.resize(this->GetSize());
  parallelFor(this->rows,
    [&](int begin, int end)
    {
      for (int j = begin; j < end; ++j)
      {
        for (int i = 0; i < this->columns; ++i)
        {
          const std::size_t at = this->At(i, j);
          double sum = -this->weightX[at] * this->riseX[at] - this->weightY[at] * this->riseY[at];
          sum += i > 0 ? this->weightX[at - 1] * this->riseX[at - 1] : 0.0;
          const std::size_t below = at - this->columns;
          sum += j > 0 ? this->weightY[below] * this->riseY[below] : 0.0;
          result[at] = sum;
        }
      }
    });
}

//------------------------------------------------------------------------------
void HeightEdges::Apply(const std::vector<double>& heights, std::vector<double>& result,
  const ParallelFor& parallelFor) const
{
  result.resize(this->GetSize());
  parallelFor(this->rows,
    [&](int begin, int end)
    {
      for (int j = begin; j < end; ++j)
      {
        for (int i = 0; i < this->columns; ++i)
        {
          const std::size_t at = this->At(i, j);
          const double here = heights[at];
          double sum = i + 1 < this->columns ? this->weightX[at] * (here - heights[at + 1]) : 0.0;
          sum += i > 0 ? this->weightX[at - 1] * (here - heights[at - 1]) : 0.0;
          if (j + 1 < this->rows)
          {
            sum += this->weightY[at] * (here - heights[at + this->columns]);
          }
          if (j > 0)
          {
            sum += this->weightY[at - this->columns] * (here - heights[at - this->columns]);
          }
          result[at] = sum;
        }
      }
    });
}

//------------------------------------------------------------------------------
double SumProducts(const std::vector<double>& a, const std::vector<double>& b, int columns,
  const ParallelFor& parallelFor)
{
  const int rows = columns > 0 ? static_cast<int>(a.size() / columns) : 0;
  std::vector<double> sums(static_cast<std::size_t>(rows));
  parallelFor(rows,
    [&](int begin, int end)
    {
      for (int j = begin; j < end; ++j)
      {
        const std::size_t first = static_cast<std::size_t>(j) * columns;
        double sum = 0.0;
        for (int i = 0; i < columns; ++i)
        {
          sum += a[first + i] * b[first + i];
        }
        sums[j] = sum;
      }
    });
  double sum = 0.0;
  for (const double row : sums)
  {
    sum += row;
  }
  return sum;
}

}
