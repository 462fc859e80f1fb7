// SPDX-License-Identifier: BSD-3-Clause
#include "WebHeights.h"

#include "HeightFit.h"

namespace relief::web
{

namespace
{

// The model's rows begin in the south.
template <class T>
HeightSource<T> SourceOf(const WebHeights& heights, double scale)
{
  HeightSource<T> source;
  const std::ptrdiff_t last = static_cast<std::ptrdiff_t>(heights.rows) - 1;
  source.data = static_cast<const T*>(heights.samples) + last * heights.columns;
  source.stepY = -static_cast<std::ptrdiff_t>(heights.columns);
  source.columns = heights.columns;
  source.rows = heights.rows;
  source.spacingX = heights.spacing[0];
  source.spacingY = heights.spacing[1];
  source.scale = scale;
  source.hasNoData = heights.hasNoData;
  source.noData = heights.noData;
  if (heights.mask)
  {
    source.hasData = [&heights, last](int i, int j)
    { return heights.mask[(last - j) * heights.columns + i] != 0; };
  }
  return source;
}

template <class Body>
void WithSource(const WebHeights& heights, double scale, const Body& body)
{
  switch (heights.type)
  {
    case ArrayType::Int8:
      return body(SourceOf<signed char>(heights, scale));
    case ArrayType::Uint8:
      return body(SourceOf<unsigned char>(heights, scale));
    case ArrayType::Int16:
      return body(SourceOf<short>(heights, scale));
    case ArrayType::Uint16:
      return body(SourceOf<unsigned short>(heights, scale));
    case ArrayType::Int32:
      return body(SourceOf<int>(heights, scale));
    case ArrayType::Uint32:
      return body(SourceOf<unsigned int>(heights, scale));
    case ArrayType::Float32:
      return body(SourceOf<float>(heights, scale));
    case ArrayType::Float64:
      return body(SourceOf<double>(heights, scale));
  }
}

}

void ForRows(int count, const std::function<void(int, int)>& body)
{
  body(0, count);
}

std::string Assign(const WebHeights& heights, double scale, bool padded, HeightField& field)
{
  std::string wrong;
  WithSource(
    heights, scale, [&](const auto& source) { wrong = field.Assign(source, ForRows, padded); });
  return wrong;
}

double FitScale(const WebHeights& heights)
{
  double scale = 0.0;
  WithSource(heights, 1.0, [&](const auto& source) { scale = FitHeightScale(source, ForRows); });
  return scale;
}

void StretchOver(const WebHeights& heights, ColorTexture& picture)
{
  picture.Stretch({ heights.columns, heights.rows }, glm::ivec2(0),
    { picture.columns, picture.rows }, glm::ivec2(0));
  // Its first row is the northern one, too.
  picture.origin.y = picture.rows - 1.0 - picture.origin.y;
  picture.alongJ.y = -picture.alongJ.y;
}

}
