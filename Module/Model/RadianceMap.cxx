// SPDX-License-Identifier: BSD-3-Clause
#include "RadianceMap.h"

#include "Angles.h"

#include <algorithm>
#include <cmath>

namespace relief
{

namespace
{

std::vector<double> RowEdges(int rows)
{
  std::vector<double> edges;
  for (int j = 0; j <= rows; ++j)
  {
    edges.push_back(FromZenith(j, rows));
  }
  return edges;
}

}

//------------------------------------------------------------------------------
double FromZenith(std::int64_t part, std::int64_t whole)
{
  if (2 * part == whole)
  {
    return 1.0;
  }
  if (2 * part > whole)
  {
    return 2.0 - FromZenith(whole - part, whole);
  }
  const double s = std::sin(0.5 * Pi * static_cast<double>(part) / static_cast<double>(whole));
  return 2.0 * s * s;
}

//------------------------------------------------------------------------------
RadianceMap::RadianceMap(int columns, int rows)
  : Columns(columns)
  , Rows(rows)
  , Texels(static_cast<std::size_t>(columns) * rows, glm::vec3(0.0f))
{
}

//------------------------------------------------------------------------------
void RadianceMap::Set(int column, int row, const glm::dvec3& radiance)
{
  glm::dvec3 clean(0.0);
  bool whole = true;
  for (int c = 0; c < 3; ++c)
  {
    whole = whole && std::abs(radiance[c]) <= Largest; // not NaN either
    clean[c] = std::max(0.0, radiance[c]);
  }
  clean = whole ? clean : glm::dvec3(0.0);
  this->Cleaned += clean == radiance ? 0 : 1;
  this->Texels[static_cast<std::size_t>(row) * this->Columns + column] = glm::vec3(clean);
}

//------------------------------------------------------------------------------
glm::dvec3 RadianceMap::GetMean() const
{
  const std::vector<double> edges = RowEdges(this->Rows);
  glm::dvec3 sum(0.0);
  for (int j = 0; j < this->Rows; ++j)
  {
    glm::dvec3 along(0.0);
    for (int i = 0; i < this->Columns; ++i)
    {
      along += glm::dvec3(this->At(i, j));
    }
    sum += along * (edges[j + 1] - edges[j]);
  }
  return sum / (2.0 * this->Columns);
}

//------------------------------------------------------------------------------
TurnedMap::TurnedMap(const RadianceMap& map, double turn)
  : Map(map)
  , Turn(turn)
  , Edges(RowEdges(map.GetRows()))
{
}

//------------------------------------------------------------------------------
void TurnedMap::Cut(const SkyPatch& patch)
{
  const int columns = this->Map.GetColumns();
  const double scale = columns / (2.0 * Pi);
  // Rounding must not leave slivers of a neighbour: a map turned by whole texels keeps them whole.
  auto place = [&](double azimuth)
  {
    const double x = (azimuth - this->Turn) * scale;
    return std::abs(x - std::round(x)) < 1e-9 ? std::round(x) : x;
  };
  const double x0 = place(patch.azimuth0);
  const double x1 = place(patch.azimuth1);
  this->ColumnsIn.clear();
  for (double x = std::floor(x0); x < x1; x += 1.0)
  {
    const int texel = static_cast<int>(x - std::floor(x / columns) * columns) % columns;
    this->ColumnsIn.push_back({ texel, patch.azimuth0 + (std::max(x, x0) - x0) / scale,
      patch.azimuth0 + (std::min(x + 1.0, x1) - x0) / scale });
  }

  this->RowsIn.clear();
  auto row = std::upper_bound(this->Edges.begin(), this->Edges.end() - 1, patch.m0) -
    this->Edges.begin() - 1;
  for (; row < this->Map.GetRows() && this->Edges[row] < patch.m1; ++row)
  {
    const double begin = std::max(patch.m0, this->Edges[row]);
    const double end = std::min(patch.m1, this->Edges[row + 1]);
    if (end > begin)
    {
      this->RowsIn.push_back({ static_cast<int>(row), begin, end });
    }
  }
}

//------------------------------------------------------------------------------
glm::dvec3 TurnedMap::Mean(const SkyPatch& patch)
{
  this->Cut(patch);
  glm::dvec3 sum(0.0);
  for (const Slab& row : this->RowsIn)
  {
    glm::dvec3 along(0.0);
    for (const Slab& column : this->ColumnsIn)
    {
      along += glm::dvec3(this->Map.At(column.texel, row.texel)) * (column.end - column.begin);
    }
    sum += along * (row.end - row.begin);
  }
  return sum / patch.Area();
}

}
