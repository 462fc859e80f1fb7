// SPDX-License-Identifier: BSD-3-Clause
#ifndef PacketTiles_h
#define PacketTiles_h

/// @file
/// A whole field in tiles of packets, for tests.

#include "PacketThickness.h"
#include "SweepThickness.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

/// d, r and, for points sunk along normals, the normals of all samples, row by row. `wanted` may be
/// empty, for all.
struct PacketField
{
  std::vector<float> d;
  std::vector<float> r;
  std::vector<glm::vec3> normals;
  std::vector<unsigned char> wanted;
};

inline PacketField MakePacketField(const relief::Field<float>& field)
{
  const int columns = field.heights.columns;
  const int rows = field.heights.rows;
  PacketField all;
  all.d.assign(static_cast<std::size_t>(columns) * rows, -1.0f);
  all.r = all.d;
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      all.normals.push_back(relief::f32::reliefNormal(field, i, j));
    }
  }
  return all;
}

/// Traces a field tile by tile, as the filter does.
inline void TracePacketTiles(const relief::Field<float>& field,
  const relief::f32::ReliefMedium& medium, const relief::Light& light, PacketField& all,
  relief::RayCount& count)
{
  using relief::SweepThickness;
  const int columns = field.heights.columns;
  for (int y = 0; y < field.heights.rows; y += SweepThickness::TileHeight)
  {
    const int rows = std::min(SweepThickness::TileHeight, field.heights.rows - y);
    for (int x = 0; x < columns; x += SweepThickness::TileWidth)
    {
      std::array<relief::RowRequest<float>, SweepThickness::TileHeight> requests;
      for (int row = 0; row < rows; ++row)
      {
        const std::size_t at = static_cast<std::size_t>(y + row) * columns + x;
        relief::RowRequest<float>& request = requests[row];
        request.j = y + row;
        request.begin = x;
        request.end = std::min(x + SweepThickness::TileWidth, columns);
        request.normals = all.normals.data() + at;
        request.wanted = all.wanted.empty() ? nullptr : all.wanted.data() + at;
        request.illumination = all.d.data() + at;
        request.thickness = all.r.data() + at;
      }
      relief::TracePacketTile(field, medium, light, requests.data(), rows, count);
    }
  }
}

#endif
