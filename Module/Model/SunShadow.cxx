// SPDX-License-Identifier: BSD-3-Clause
#include "SunShadow.h"

#include "PacketThickness.h"

#include <algorithm>
#include <cmath>

namespace relief
{

namespace
{
// The limit that tells hidden samples; any attenuation has it.
constexpr f64::ReliefMedium Opaque = { 0.0, f64::RELIEF_VERTICAL, f64::RELIEF_RECIPROCAL, 1.0,
  false, 0.0, 0.0 };

// Rounding of the shares must not show where all or none of the disc is hidden.
void RoundShares(const double sums[SweepThickness::TileSize], float* hidden)
{
  std::transform(sums, sums + SweepThickness::TileSize, hidden,
    [](double sum) { return static_cast<float>(std::min(sum, 1.0)); });
}
}

SunShadow::SunShadow(const HeightField& field, const std::vector<Light>& disc, std::size_t taken)
  : Heights(field.GetField())
  , Medium(ToSingle(Opaque))
{
  double sum = 0.0;
  for (const Light& light : disc)
  {
    sum += light.weight;
  }
  for (const Light& light : disc)
  {
    Direction direction;
    direction.light = light;
    direction.share = light.weight / sum;
    direction.up = light.vector.z >= 0.0;
    if (direction.up)
    {
      direction.sweep = SweepThickness::MakeWhereItApplies(field, Opaque, light, taken);
    }
    this->Directions.push_back(std::move(direction));
  }
}

// The samples of a tile in a row.
RowRequest<float> SunShadow::RowOf(int column, int j) const
{
  RowRequest<float> request;
  request.j = j;
  request.begin = column * SweepThickness::TileWidth;
  request.end = std::min(request.begin + SweepThickness::TileWidth, this->Heights.heights.columns);
  return request;
}

void SunShadow::Illuminate(
  const Direction& direction, int column, int row, float* d, RayCount& count) const
{
  if (direction.sweep)
  {
    direction.sweep->IlluminateTile(column, row, d, nullptr, count);
    return;
  }
  constexpr int width = SweepThickness::TileWidth;
  constexpr int height = SweepThickness::TileHeight;
  RowRequest<float> requests[height];
  int rows = 0;
  for (; rows < height && row * height + rows < this->Heights.heights.rows; ++rows)
  {
    requests[rows] = this->RowOf(column, row * height + rows);
    requests[rows].illumination = d + rows * width;
  }
  TracePacketTile(this->Heights, this->Medium, direction.light, requests, rows, count);
}

void SunShadow::ShadeTile(int column, int row, float* hidden, RayCount& count) const
{
  double sums[SweepThickness::TileSize] = {};
  alignas(SweepThickness::TileWidth * sizeof(float)) float d[SweepThickness::TileSize] = {};
  for (const Direction& direction : this->Directions)
  {
    if (direction.up)
    {
      this->Illuminate(direction, column, row, d, count);
    }
    for (int at = 0; at < SweepThickness::TileSize; ++at)
    {
      sums[at] += direction.up && d[at] > 0.0f ? 0.0 : direction.share;
    }
  }
  RoundShares(sums, hidden);
}

bool SunShadow::ShadeTile(
  const HeightOutline& outline, int column, int row, float* hidden, RayCount& count) const
{
  constexpr int width = SweepThickness::TileWidth;
  double least[SweepThickness::TileSize] = {};
  double greatest[SweepThickness::TileSize] = {};
  HeightOutline::Row bounds = {};
  const int end = std::min((row + 1) * SweepThickness::TileHeight, this->Heights.heights.rows);
  for (const Direction& direction : this->Directions)
  {
    for (int j = row * SweepThickness::TileHeight; j < end; ++j)
    {
      const RowRequest<float> request = this->RowOf(column, j);
      if (direction.up)
      {
        outline.TraceRow(Opaque, direction.light, request, bounds, count);
      }
      const int first = (j - row * SweepThickness::TileHeight) * width;
      for (int k = 0; k < request.end - request.begin; ++k)
      {
        const bool traced =
          direction.up && !std::isnan(this->Heights.heights.At(request.begin + k, j));
        least[first + k] += traced && bounds.greatestD[k] > 0.0 ? 0.0 : direction.share;
        greatest[first + k] += traced && bounds.leastD[k] > 0.0 ? 0.0 : direction.share;
      }
    }
  }
  RoundShares(greatest, hidden);
  return std::equal(least, least + SweepThickness::TileSize, greatest);
}

}
