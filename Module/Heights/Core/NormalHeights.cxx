// SPDX-License-Identifier: BSD-3-Clause
#include "NormalHeights.h"

#include "PathSums.h"

#include <algorithm>
#include <cmath>

namespace relief
{

namespace
{
// Normals whose green points up, of those that face the camera.
void Face(NormalMap& map, const NormalRequest& request, const ParallelFor& parallelFor,
  NormalHeights& result)
{
  const NormalIntegration& integration = request.integration;
  result.green = request.green;
  if (result.green == GreenAxis::Automatic)
  {
    result.green = FindGreenAxis(map, integration.camera, integration.spacing, parallelFor);
    result.greenKnown = result.green != GreenAxis::Automatic;
    result.green = result.greenKnown ? result.green : GreenAxis::Up;
  }
  if (result.green == GreenAxis::Down)
  {
    TurnGreen(map);
  }
  FaceCamera(map, integration.camera, parallelFor);
}

std::vector<double> Integrate(const NormalMap& map, const NormalRequest& request,
  const ParallelFor& parallelFor, SolverEnd& end)
{
  switch (request.method)
  {
    case NormalMethod::PathSums:
      end.converged = true;
      return SumPaths(map, request.integration, parallelFor);
    case NormalMethod::DiscontinuityPreserving:
      return IntegrateBilaterally(map, request.integration, request.bilateral, parallelFor, end);
    default:
      return IntegrateNormals(map, request.integration, parallelFor, end);
  }
}

// Of depths the logarithm must be a number.
bool AreInRange(
  const NormalMap& map, const NormalIntegration& integration, const std::vector<double>& heights)
{
  const double size = integration.spacing[0] * map.columns + integration.spacing[1] * map.rows;
  const double most = integration.camera.perspective ? 700.0 : 1e6 * size;
  // NaN is no data.
  return std::none_of(
    heights.begin(), heights.end(), [most](double height) { return std::abs(height) > most; });
}
}

//------------------------------------------------------------------------------
double ScaleSpacing(const double spacing[2], double scaled[2])
{
  const double unit = std::min(std::abs(spacing[0]), std::abs(spacing[1]));
  scaled[0] = std::abs(spacing[0]) / unit;
  scaled[1] = std::abs(spacing[1]) / unit;
  return unit;
}

//------------------------------------------------------------------------------
std::string FindNormalHeights(NormalMap map, const NormalRequest& request,
  const ParallelFor& parallelFor, NormalHeights& result)
{
  result = NormalHeights();
  Face(map, request, parallelFor, result);
  std::vector<double> heights = Integrate(map, request, parallelFor, result.end);
  if (result.end.stopped)
  {
    return {};
  }
  if (!AreInRange(map, request.integration, heights))
  {
    return "the heights of these normals grow beyond all bounds";
  }
  result.parts = LevelHeights(map, request.datum, heights);
  result.heights = std::move(heights);
  return {};
}

}
