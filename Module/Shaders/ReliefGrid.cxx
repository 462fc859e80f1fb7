// SPDX-License-Identifier: BSD-3-Clause
#include "ReliefGrid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace relief
{

namespace
{

struct Corner
{
  std::array<double, 2> at;   // in samples
  std::array<double, 4> clip; // in clip coordinates, before the division
};

double InsideOf(const Corner& corner, int plane)
{
  const double sign = plane % 2 == 0 ? 1.0 : -1.0;
  return corner.clip[3] + sign * corner.clip[plane / 2];
}

// The part of a polygon within one of the six planes of the view (I. E. Sutherland, G. W. Hodgman,
// "Reentrant polygon clipping", 1974).
std::vector<Corner> Clip(const std::vector<Corner>& polygon, int plane)
{
  std::vector<Corner> result;
  for (std::size_t k = 0; k < polygon.size(); ++k)
  {
    const Corner& a = polygon[k];
    const Corner& b = polygon[(k + 1) % polygon.size()];
    const double insideA = InsideOf(a, plane);
    const double insideB = InsideOf(b, plane);
    if (insideA >= 0.0)
    {
      result.push_back(a);
    }
    if ((insideA >= 0.0) != (insideB >= 0.0))
    {
      const double t = insideA / (insideA - insideB);
      Corner between;
      for (std::size_t c = 0; c < 2; ++c)
      {
        between.at[c] = a.at[c] + t * (b.at[c] - a.at[c]);
      }
      for (std::size_t c = 0; c < 4; ++c)
      {
        between.clip[c] = a.clip[c] + t * (b.clip[c] - a.clip[c]);
      }
      result.push_back(between);
    }
  }
  return result;
}

double RoundStride(double stride)
{
  // The rest forgives what rounding does to a camera that shows a whole number of samples a pixel.
  return std::max(1.0, std::exp2(std::floor(4.0 * std::log2(stride) + 1e-4) / 4.0));
}

}

VisiblePart FindVisiblePart(
  const double toClip[16], const double area[4], const int viewportSize[2])
{
  std::vector<Corner> polygon;
  for (int k = 0; k < 4; ++k)
  {
    Corner corner;
    corner.at = { area[k == 1 || k == 2 ? 1 : 0], area[k >= 2 ? 3 : 2] };
    for (std::size_t c = 0; c < 4; ++c)
    {
      corner.clip[c] =
        toClip[4 * c] * corner.at[0] + toClip[4 * c + 1] * corner.at[1] + toClip[4 * c + 3];
    }
    polygon.push_back(corner);
  }
  for (int plane = 0; plane < 6 && !polygon.empty(); ++plane)
  {
    polygon = Clip(polygon, plane);
  }
  VisiblePart part;
  part.any = !polygon.empty();
  double pixels[2] = { 0.0, 0.0 }; // in a sample, at most
  for (int axis = 0; axis < 2; ++axis)
  {
    part.lo[axis] = std::numeric_limits<double>::infinity();
    part.hi[axis] = -std::numeric_limits<double>::infinity();
  }
  for (const Corner& corner : polygon)
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      part.lo[axis] = std::min(part.lo[axis], corner.at[axis]);
      part.hi[axis] = std::max(part.hi[axis], corner.at[axis]);
      // How far the picture of the point moves when it goes along the axis.
      const double w = corner.clip[3];
      double squares = 0.0;
      for (int c = 0; c < 2; ++c)
      {
        const double rate =
          (toClip[4 * c + axis] * w - corner.clip[c] * toClip[12 + axis]) / (w * w);
        squares += std::pow(rate * viewportSize[c] / 2.0, 2);
      }
      pixels[axis] = std::max(pixels[axis], std::sqrt(squares));
    }
  }
  for (int axis = 0; axis < 2; ++axis)
  {
    // NaN where a corner lies in the eye.
    part.stride[axis] = pixels[axis] > 0.0 ? 1.0 / pixels[axis] : 1.0;
  }
  return part;
}

bool ReliefGrid::operator==(const ReliefGrid& other) const
{
  return std::equal(this->first, this->first + 2, other.first) &&
    std::equal(this->size, this->size + 2, other.size) &&
    std::equal(this->stride, this->stride + 2, other.stride);
}

bool ReliefGrid::Holds(const ReliefGrid& other) const
{
  return std::equal(this->stride, this->stride + 2, other.stride) && this->Reaches(other);
}

bool ReliefGrid::Reaches(const ReliefGrid& other) const
{
  bool reaches = !this->IsEmpty();
  for (int axis = 0; axis < 2; ++axis)
  {
    const double lo = other.first[axis] * other.stride[axis];
    const double hi = (other.first[axis] + other.size[axis]) * other.stride[axis];
    reaches = reaches && this->first[axis] * this->stride[axis] <= lo + this->stride[axis] &&
      (this->first[axis] + this->size[axis]) * this->stride[axis] >= hi - this->stride[axis];
  }
  // Texels of the same stride must be there one by one.
  if (std::equal(this->stride, this->stride + 2, other.stride))
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      reaches = reaches && this->first[axis] <= other.first[axis] &&
        this->first[axis] + this->size[axis] >= other.first[axis] + other.size[axis];
    }
  }
  return reaches;
}

int ReliefGrid::SampleOf(int axis, int texel, int samples) const
{
  return std::min(
    static_cast<int>(std::floor((this->first[axis] + texel + 0.5) * this->stride[axis])),
    samples - 1);
}

ReliefGrid MakeGrid(const VisiblePart& part, int columns, int rows, double coarseness,
  double maximumTexels, int maximumSize)
{
  ReliefGrid grid;
  if (!part.any)
  {
    return grid;
  }
  const int samples[2] = { columns, rows };
  for (double factor = coarseness;; factor *= std::exp2(0.25))
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      const double stride = RoundStride(std::max(part.stride[axis], 1.0) * factor);
      const int last = static_cast<int>(std::ceil(samples[axis] / stride)) - 1;
      // A texel more on each side, between which and its neighbour the picture is interpolated.
      const int begin = static_cast<int>(std::floor(part.lo[axis] / stride)) - 1;
      const int end = static_cast<int>(std::floor(part.hi[axis] / stride)) + 1;
      grid.first[axis] = std::clamp(begin, 0, last);
      grid.size[axis] = std::clamp(end, 0, last) - grid.first[axis] + 1;
      grid.stride[axis] = stride;
    }
    const bool single = grid.size[0] == 1 && grid.size[1] == 1;
    if (single ||
      (grid.GetNumberOfTexels() <= maximumTexels && grid.size[0] <= maximumSize &&
        grid.size[1] <= maximumSize))
    {
      return grid;
    }
  }
}

}
