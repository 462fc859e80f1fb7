// SPDX-License-Identifier: BSD-3-Clause
#include "NormalMap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace relief
{
namespace
{
// Largest code of integers; fractions reach 1.
template <class T>
constexpr double LargestCode()
{
  return std::is_floating_point<T>::value ? 1.0
                                          : static_cast<double>(std::numeric_limits<T>::max());
}

template <class T>
bool IsCovered(const NormalSource<T>& source, int i, int j)
{
  const std::size_t at = static_cast<std::size_t>(j) * source.columns + i;
  if (source.components == 4)
  {
    const T alpha = source.data[4 * at + 3];
    // False for NaN.
    if (!(alpha > T(0)))
    {
      return false;
    }
  }
  return !source.hasData || source.hasData(i, j);
}

// Fractions below 0 are signed, but for what filters of images leave; of others the length tells,
// which is 1.
constexpr double ClearlyNegative = -0.05;

template <class T>
NormalEncoding FindEncoding(const NormalSource<T>& source)
{
  if (source.encoding != NormalEncoding::Automatic)
  {
    return source.encoding;
  }
  if (!std::is_floating_point<T>::value)
  {
    return std::is_signed<T>::value ? NormalEncoding::Signed : NormalEncoding::Unsigned;
  }
  double errors[2] = { 0.0, 0.0 };
  for (int j = 0; j < source.rows; ++j)
  {
    for (int i = 0; i < source.columns; ++i)
    {
      const T* c =
        source.data + (static_cast<std::size_t>(j) * source.columns + i) * source.components;
      const double length = std::hypot(c[0], c[1], c[2]);
      if (!std::isfinite(length) || length == 0.0 || !IsCovered(source, i, j))
      {
        continue;
      }
      if (std::min({ c[0], c[1], c[2] }) < T(ClearlyNegative))
      {
        return NormalEncoding::Signed;
      }
      errors[0] += std::abs(length - 1.0);
      errors[1] += std::abs(std::hypot(2.0 * c[0] - 1.0, 2.0 * c[1] - 1.0, 2.0 * c[2] - 1.0) - 1.0);
    }
  }
  return errors[1] < errors[0] ? NormalEncoding::Unsigned : NormalEncoding::Signed;
}

// Fills a row. The weights are as they were given.
template <class T>
void ReadRow(const NormalSource<T>& source, bool perspective, int j, NormalMap& map)
{
  const double largest = LargestCode<T>();
  const bool isUnsigned = map.encoding == NormalEncoding::Unsigned;
  const double half = 0.5 * largest;
  const double zero = !isUnsigned ? 0.0 : source.zeroCode >= 0.0 ? source.zeroCode : half;
  const double scale = isUnsigned ? 1.0 / half : 1.0 / largest;
  for (int i = 0; i < source.columns; ++i)
  {
    const std::size_t at = map.At(i, j);
    const T* c = source.data + at * source.components;
    const double n[3] = { (c[0] - zero) * scale, (c[1] - zero) * scale, (c[2] - zero) * scale };
    const double size = std::max({ std::abs(n[0]), std::abs(n[1]), std::abs(n[2]) });
    bool used = std::isfinite(n[0]) && std::isfinite(n[1]) && std::isfinite(n[2]) && size > 0.0 &&
      IsCovered(source, i, j);
    if (used)
    {
      // Divided by the largest first, no square overflows.
      const double m[3] = { n[0] / size, n[1] / size, n[2] / size };
      const double length = std::hypot(m[0], m[1], m[2]);
      map.x[at] = m[0] / length;
      map.y[at] = m[1] / length;
      map.z[at] = m[2] / length;
      used = perspective || map.z[at] > LeastNormalCosine;
    }
    if (source.weight)
    {
      const double weight = source.weight(i, j);
      used = used && weight > 0.0 && std::isfinite(weight);
      map.weight[at] = used ? weight : 0.0;
    }
    map.used[at] = used;
  }
}

// The largest becomes 1.
void ScaleWeights(std::vector<double>& weights)
{
  const double largest = weights.empty() ? 0.0 : *std::max_element(weights.begin(), weights.end());
  for (double& weight : weights)
  {
    weight = weight > 0.0 ? std::max(weight / largest, LeastNormalWeight) : 0.0;
  }
}

struct Slope
{
  double x;
  double y;
};

// Of the height, or of the depth's logarithm, for one sign of green; NaN where it is not seen.
Slope SlopeFor(const NormalMap& map, const NormalCamera& camera, const double spacing[2], int i,
  int j, double sign)
{
  const std::size_t at = map.At(i, j);
  const double y = sign * map.y[at];
  if (!camera.perspective)
  {
    return { -map.x[at] / map.z[at] * spacing[0], -y / map.z[at] * spacing[1] };
  }
  const double a = (i - camera.centerX) / camera.focalX;
  const double b = (j - camera.centerY) / camera.focalY;
  const double facing = map.z[at] - map.x[at] * a - y * b;
  if (!(facing > LeastNormalCosine))
  {
    return { std::numeric_limits<double>::quiet_NaN(), 0.0 };
  }
  return { map.x[at] / facing / camera.focalX, y / facing / camera.focalY };
}

double RayLength(const NormalCamera& camera, int i, int j)
{
  return camera.perspective
    ? std::hypot((i - camera.centerX) / camera.focalX, (j - camera.centerY) / camera.focalY, 1.0)
    : 1.0;
}

// The curl around a cell of four samples.
double CurlAt(const NormalMap& map, const NormalCamera& camera, const double spacing[2], int i,
  int j, double sign)
{
  const Slope a = SlopeFor(map, camera, spacing, i, j, sign);
  const Slope b = SlopeFor(map, camera, spacing, i + 1, j, sign);
  const Slope c = SlopeFor(map, camera, spacing, i, j + 1, sign);
  const Slope d = SlopeFor(map, camera, spacing, i + 1, j + 1, sign);
  return 0.5 * ((a.x + b.x) + (b.y + d.y) - (c.x + d.x) - (a.y + c.y));
}
}

//------------------------------------------------------------------------------
template <class T>
NormalMap ReadNormals(
  const NormalSource<T>& source, const NormalCamera& camera, const ParallelFor& parallelFor)
{
  NormalMap map;
  map.columns = source.columns;
  map.rows = source.rows;
  map.encoding = FindEncoding(source);
  map.x.resize(map.GetSize());
  map.y.resize(map.GetSize());
  map.z.resize(map.GetSize());
  map.used.resize(map.GetSize());
  map.weight.resize(source.weight ? map.GetSize() : 0);
  parallelFor(source.rows,
    [&](int begin, int end)
    {
      for (int j = begin; j < end; ++j)
      {
        ReadRow(source, camera.perspective, j, map);
      }
    });
  ScaleWeights(map.weight);
  return map;
}

//------------------------------------------------------------------------------
double FacingNormal(const NormalMap& map, const NormalCamera& camera, int i, int j)
{
  const std::size_t at = map.At(i, j);
  if (!camera.perspective)
  {
    return map.z[at];
  }
  const double a = (i - camera.centerX) / camera.focalX;
  const double b = (j - camera.centerY) / camera.focalY;
  return map.z[at] - map.x[at] * a - map.y[at] * b;
}

//------------------------------------------------------------------------------
void TurnGreen(NormalMap& map)
{
  for (double& y : map.y)
  {
    y = -y;
  }
}

//------------------------------------------------------------------------------
void FaceCamera(NormalMap& map, const NormalCamera& camera, const ParallelFor& parallelFor)
{
  parallelFor(map.rows,
    [&](int begin, int end)
    {
      for (int j = begin; j < end; ++j)
      {
        for (int i = 0; i < map.columns; ++i)
        {
          // False for NaN.
          const bool faces =
            FacingNormal(map, camera, i, j) > LeastNormalCosine * RayLength(camera, i, j);
          map.used[map.At(i, j)] = map.used[map.At(i, j)] && faces;
        }
      }
    });
}

//------------------------------------------------------------------------------
GreenAxis FindGreenAxis(const NormalMap& map, const NormalCamera& camera, const double spacing[2],
  const ParallelFor& parallelFor)
{
  struct Sums
  {
    double up = 0.0;
    double down = 0.0;
    double difference = 0.0;
    double square = 0.0;
  };
  // Sums by row, so that they do not depend on how the rows are shared out.
  std::vector<Sums> sums(static_cast<std::size_t>(std::max(0, map.rows - 1)));
  parallelFor(std::max(0, map.rows - 1),
    [&](int begin, int end)
    {
      for (int j = begin; j < end; ++j)
      {
        for (int i = 0; i + 1 < map.columns; ++i)
        {
          const std::size_t at = map.At(i, j);
          const std::size_t above = at + map.columns;
          if (!map.used[at] || !map.used[at + 1] || !map.used[above] || !map.used[above + 1])
          {
            continue;
          }
          // An error of a normal is one of its slope by the square of z.
          const double least =
            std::min({ map.z[at], map.z[at + 1], map.z[above], map.z[above + 1] });
          const double up = least * least * std::abs(CurlAt(map, camera, spacing, i, j, 1.0));
          const double down = least * least * std::abs(CurlAt(map, camera, spacing, i, j, -1.0));
          if (std::isfinite(up) && std::isfinite(down))
          {
            sums[j].up += up;
            sums[j].down += down;
            sums[j].difference += down - up;
            sums[j].square += (down - up) * (down - up);
          }
        }
      }
    });
  Sums all;
  for (const Sums& row : sums)
  {
    all.up += row.up;
    all.down += row.down;
    all.difference += row.difference;
    all.square += row.square;
  }
  // Chance stays within a few standard deviations, and rounding of the codes below a small share.
  const bool clear = std::abs(all.difference) > 0.02 * (all.up + all.down) &&
    std::abs(all.difference) > 6.0 * std::sqrt(all.square);
  if (!clear)
  {
    return GreenAxis::Automatic;
  }
  return all.difference > 0.0 ? GreenAxis::Up : GreenAxis::Down;
}

//------------------------------------------------------------------------------
#define RELIEF_READ_NORMALS(T)                                                                     \
  template NormalMap ReadNormals(const NormalSource<T>&, const NormalCamera&, const ParallelFor&)
RELIEF_READ_NORMALS(char);
RELIEF_READ_NORMALS(signed char);
RELIEF_READ_NORMALS(unsigned char);
RELIEF_READ_NORMALS(short);
RELIEF_READ_NORMALS(unsigned short);
RELIEF_READ_NORMALS(int);
RELIEF_READ_NORMALS(unsigned int);
RELIEF_READ_NORMALS(long);
RELIEF_READ_NORMALS(unsigned long);
RELIEF_READ_NORMALS(long long);
RELIEF_READ_NORMALS(unsigned long long);
RELIEF_READ_NORMALS(float);
RELIEF_READ_NORMALS(double);
#undef RELIEF_READ_NORMALS
}
