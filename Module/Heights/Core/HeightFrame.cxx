// SPDX-License-Identifier: BSD-3-Clause
#include "HeightFrame.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace relief
{

namespace
{
constexpr std::int64_t MostSamples = std::int64_t{ 1 } << 30;

// How many cells of a size there are, rounded up but for rounding errors.
int CountCells(double size, double spacing, int most)
{
  const double cells = std::ceil(size / spacing - 1e-9);
  return static_cast<int>(std::min(std::max(cells, 1.0), 1.0 * most));
}
}

//------------------------------------------------------------------------------
std::string FitHeightFrame(const FrameRequest& request, HeightFrame& result)
{
  const double* sides = request.hasFrame ? request.frame : request.bounds;
  double size[2] = { sides[1] - sides[0], sides[3] - sides[2] };
  const double longer = std::max(size[0], size[1]);
  if (!(longer > 0.0) || !std::isfinite(longer))
  {
    return "the triangles lie in a line toward the eye: choose another ViewDirection";
  }
  if (!request.hasFrame)
  {
    size[0] += 2.0 * request.margin * longer;
    size[1] += 2.0 * request.margin * longer;
  }
  int dimensions[2] = { request.dimensions[0], request.dimensions[1] };
  const double spacing = dimensions[0] > 0
    ? std::max(size[0] / dimensions[0], size[1] / dimensions[1])
    : std::max(size[0], size[1]) / request.resolution;
  if (!std::isnormal(spacing))
  {
    return "the triangles are too small to be sampled: scale them up";
  }
  for (int k = 0; k < 2; ++k)
  {
    dimensions[k] =
      dimensions[k] > 0 ? dimensions[k] : CountCells(size[k], spacing, request.resolution);
    // A given frame is filled, bounds lie in the middle.
    result.spacing[k] = request.hasFrame ? size[k] / dimensions[k] : spacing;
    result.first[k] = request.hasFrame
      ? sides[2 * k] + 0.5 * result.spacing[k]
      : 0.5 * (sides[2 * k] + sides[2 * k + 1]) - 0.5 * (dimensions[k] - 1) * spacing;
  }
  result.columns = dimensions[0];
  result.rows = dimensions[1];
  if (std::int64_t{ result.columns } * result.rows > MostSamples)
  {
    return std::to_string(result.columns) + " x " + std::to_string(result.rows) +
      " samples are asked for, at most 2^30 are possible: lower the Resolution or the Dimensions";
  }
  return {};
}

}
