// SPDX-License-Identifier: BSD-3-Clause
#ifndef TriangleOrientation_h
#define TriangleOrientation_h

#include <cmath>

namespace relief
{

/// A sum of doubles kept exactly, as parts that do not overlap, the least first.
/// J. R. Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
/// predicates", Discrete & Computational Geometry 18, 1997, section 2.4.
class ExactSum
{
public:
  void Add(double value)
  {
    int kept = 0;
    for (int i = 0; i < this->Count; ++i)
    {
      const double sum = value + this->Parts[i];
      const double part = sum - value;
      const double rest = (value - (sum - part)) + (this->Parts[i] - part);
      if (rest != 0.0)
      {
        this->Parts[kept++] = rest;
      }
      value = sum;
    }
    if (value != 0.0)
    {
      this->Parts[kept++] = value;
    }
    this->Count = kept;
  }

  void AddProduct(double a, double b)
  {
    const double product = a * b;
    this->Add(std::fma(a, b, -product));
    this->Add(product);
  }

  /// Nearly the sum; its sign is exact.
  double Get() const
  {
    double sum = 0.0;
    for (int i = 0; i < this->Count; ++i)
    {
      sum += this->Parts[i];
    }
    return sum;
  }

private:
  double Parts[12]; // room for six products
  int Count = 0;
};

/// Twice the area of the triangle a b p, positive where it turns counterclockwise. Exact in its
/// sign, so that triangles with a common edge agree on what lies where, and to 2^-25 of its value.
/// For coordinates up to 1e100.
inline double OrientedArea(double ax, double ay, double bx, double by, double px, double py)
{
  const double left = (ax - px) * (by - py);
  const double right = (ay - py) * (bx - px);
  const double area = left - right;
  const double size = std::abs(left) + std::abs(right);
  // Rounding is below 2^-51 of this size: what is far above has its sign, and 25 bits besides.
  if (std::abs(area) > 0x1p-26 * size || size == 0.0)
  {
    return area;
  }
  ExactSum sum;
  sum.AddProduct(ax, by);
  sum.AddProduct(-bx, ay);
  sum.AddProduct(bx, py);
  sum.AddProduct(-px, by);
  sum.AddProduct(px, ay);
  sum.AddProduct(-ax, py);
  return sum.Get();
}

}

#endif
