// SPDX-License-Identifier: BSD-3-Clause
#ifndef CosineTransform_h
#define CosineTransform_h

#include "ParallelFor.h"

#include <memory>
#include <vector>

namespace relief
{

/// Cosine transforms of rectangles of one size, forth (DCT-II) and back (its inverse), by Fourier
/// transforms of the same length. (J. Makhoul, "A fast cosine transform in one and two dimensions",
/// IEEE Trans. ASSP 28, 1980.) Lengths with large prime factors go by a convolution of a length
/// without. (L. Bluestein, "A linear filtering approach to the computation of discrete Fourier
/// transform", 1970.) Results do not depend on how the rows are shared out.
class CosineTransform
{
public:
  /// Both are at least 1.
  CosineTransform(int columns, int rows);
  ~CosineTransform();

  /// values[k] = sum of values[n] cos(pi k (2 n + 1) / (2 N)), along both axes.
  void Forward(std::vector<double>& values, const ParallelFor& parallelFor) const;

  /// Takes Forward() back.
  void Backward(std::vector<double>& values, const ParallelFor& parallelFor) const;

private:
  class Line;

  void Transform(std::vector<double>& values, bool backward, const ParallelFor& parallelFor) const;

  int Columns;
  int Rows;
  std::unique_ptr<Line> AlongX;
  std::unique_ptr<Line> AlongY;
};

}

#endif
