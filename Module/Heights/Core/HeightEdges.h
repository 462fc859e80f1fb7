// SPDX-License-Identifier: BSD-3-Clause
#ifndef HeightEdges_h
#define HeightEdges_h

#include "ParallelFor.h"

#include <cstddef>
#include <vector>

namespace relief
{

/// What heights of a grid should satisfy: between neighbours a and b, for each edge of a weight
/// above 0, that h(b) - h(a) is the edge's rise, in the sense of least squares. Edges lead from
/// each sample to its right, and up; those beyond the grid weigh 0.
struct HeightEdges
{
  int columns = 0;
  int rows = 0;
  std::vector<double> weightX;
  std::vector<double> weightY;
  std::vector<double> riseX;
  std::vector<double> riseY;

  /// All weights and rises are 0.
  void Resize(int newColumns, int newRows);

  std::size_t At(int i, int j) const { return static_cast<std::size_t>(j) * this->columns + i; }
  std::size_t GetSize() const { return static_cast<std::size_t>(this->columns) * this->rows; }

  /// The right side of the normal equations.
  void FindRightSide(std::vector<double>& result, const ParallelFor& parallelFor) const;

  /// The left side of the normal equations: a weighted Laplacian with free boundaries.
  void Apply(const std::vector<double>& heights, std::vector<double>& result,
    const ParallelFor& parallelFor) const;
};

/// Sums of products of two grids of the same size, which do not depend on how rows are shared out.
double SumProducts(const std::vector<double>& a, const std::vector<double>& b, int columns,
  const ParallelFor& parallelFor);

}

#endif
