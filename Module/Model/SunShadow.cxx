// SPDX-License-Identifier: BSD-3-Clause
#include "SunShadow.h"

#include "PacketThickness.h"

#include <algorithm>

namespace relief
{

namespace
{
// The limit that tells hidden samples; any attenuation has it.
constexpr f64::ReliefMedium Opaque = { 0.0, f64::RELIEF_VERTICAL, f64::RELIEF_RECIPROCAL, 1.0,
  false, 0.0, 0.0 };
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
    RowRequest<float>& request = requests[rows];
    request.j = row * height + rows;
    request.begin = column * width;
    request.end = std::min(request.begin + width, this->Heights.heights.columns);
    request.illumination = d + rows * width;
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
  // Rounding of the shares must not show where all or none of the disc is hidden.
  std::transform(sums, sums + SweepThickness::TileSize, hidden,
    [](double sum) { return static_cast<float>(std::min(sum, 1.0)); });
}

}
