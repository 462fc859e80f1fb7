// SPDX-License-Identifier: BSD-3-Clause
#include "AutomaticExposure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>

namespace relief
{

namespace
{
constexpr double Share = 0.995; // of samples that are not pure white
constexpr double MostStops = 20.0;

// From one tile to the next in both directions, so that there are no more than a number of them.
int FindStep(int columns, int rows, int most)
{
  int step = 1;
  while (((columns + step - 1) / step) * ((rows + step - 1) / step) > most)
  {
    ++step;
  }
  return step;
}
}

AutomaticExposure::AutomaticExposure(const HeightField& field, const Scene& scene)
  : Shading(field, scene, Target())
{
  constexpr int width = SweepThickness::TileWidth;
  constexpr int height = SweepThickness::TileHeight;
  const HeightView<float>& heights = field.GetField().heights;
  const int columns = (heights.columns + width - 1) / width;
  const int rows = (heights.rows + height - 1) / height;
  const int step = FindStep(columns, rows, MostSamples / SweepThickness::TileSize);
  for (int row = std::min(step / 2, rows - 1); row < rows; row += step)
  {
    for (int column = std::min(step / 2, columns - 1); column < columns; column += step)
    {
      this->Tiles.push_back({ column, row });
    }
  }
  this->Largest.assign(
    this->Tiles.size() * SweepThickness::TileSize, std::numeric_limits<float>::quiet_NaN());
}

void AutomaticExposure::Measure(int begin, int end)
{
  for (int k = begin; k < end; ++k)
  {
    const Tile& tile = this->Tiles[static_cast<std::size_t>(k)];
    this->Shading.FindLargest(tile.column, tile.row,
      this->Largest.data() + static_cast<std::size_t>(k) * SweepThickness::TileSize);
  }
}

double AutomaticExposure::GetStops() const
{
  std::vector<float> values;
  std::copy_if(this->Largest.begin(), this->Largest.end(), std::back_inserter(values),
    [](float value) { return !std::isnan(value); });
  if (values.empty())
  {
    return 0.0;
  }
  const auto at = static_cast<std::size_t>(Share * static_cast<double>(values.size() - 1));
  const auto quantile = values.begin() + static_cast<std::ptrdiff_t>(at);
  std::nth_element(values.begin(), quantile, values.end());
  // What is a little less than white, so that white is left to the few that are brighter.
  const double bright = f64::reliefDecode(254.0 / 255.0);
  return *quantile > 0.0f
    ? std::clamp(std::log2(bright / static_cast<double>(*quantile)), -MostStops, MostStops)
    : 0.0;
}

}
