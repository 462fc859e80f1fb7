// SPDX-License-Identifier: BSD-3-Clause
#include "WebNormals.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace relief::web
{

namespace
{
void Serial(int count, const std::function<void(int, int)>& body)
{
  body(0, count);
}

template <class T>
NormalMap Read(const WebNormals& normals, const NormalCamera& camera)
{
  // Those of the core begin in the south.
  const auto row =
    static_cast<std::size_t>(normals.columns) * static_cast<std::size_t>(normals.components);
  const T* from = static_cast<const T*>(normals.samples);
  std::vector<T> turned(row * static_cast<std::size_t>(normals.rows));
  for (std::size_t j = 0; j < static_cast<std::size_t>(normals.rows); ++j)
  {
    std::copy_n(from + j * row, row, turned.end() - static_cast<std::ptrdiff_t>((j + 1) * row));
  }
  NormalSource<T> source;
  source.data = turned.data();
  source.columns = normals.columns;
  source.rows = normals.rows;
  source.components = normals.components;
  source.encoding = normals.encoding;
  if (normals.mask)
  {
    source.hasData = [&normals](int i, int j)
    { return normals.mask[(normals.rows - 1 - j) * normals.columns + i] != 0; };
  }
  return ReadNormals(source, camera, Serial);
}

NormalMap ReadAny(const WebNormals& normals, const NormalCamera& camera)
{
  switch (normals.type)
  {
    case NormalType::Uint8:
      return Read<unsigned char>(normals, camera);
    case NormalType::Uint16:
      return Read<unsigned short>(normals, camera);
    case NormalType::Float32:
      return Read<float>(normals, camera);
    default:
      return Read<double>(normals, camera);
  }
}
}

//------------------------------------------------------------------------------
std::string FindHeights(
  const WebNormals& normals, NormalRequest request, NormalHeights& result, NormalEncoding& encoding)
{
  const double unit = ScaleSpacing(normals.spacing, request.integration.spacing);
  NormalMap map = ReadAny(normals, request.integration.camera);
  encoding = map.encoding;
  if (std::none_of(map.used.begin(), map.used.end(), [](unsigned char used) { return used != 0; }))
  {
    return "it has no normal that faces the viewer";
  }
  const std::string wrong = FindNormalHeights(std::move(map), request, Serial, result);
  for (double& height : result.heights)
  {
    height *= unit;
  }
  return wrong;
}

}
