// SPDX-License-Identifier: BSD-3-Clause
#ifndef RadianceMap_h
#define RadianceMap_h

#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace relief
{

/// Radiance from every direction, linear RGB: a latitude-longitude image. Row 0 begins at the
/// zenith (+z), the last row ends at the nadir; column 0 begins at +x, and the columns run
/// counter-clockwise seen from above. A texel has one radiance all over.
class RadianceMap
{
public:
  /// What exceeds it counts as infinite: sums and colours must stay finite in single precision.
  static constexpr double Largest = 1e30;

  RadianceMap() = default;

  /// A black map; both numbers are at least 1.
  RadianceMap(int columns, int rows);

  /// Sets a texel. One with a NaN or an infinite channel becomes black, a negative channel becomes
  /// 0.
  void Set(int column, int row, const glm::dvec3& radiance);

  /// How many texels Set() had to clean.
  std::size_t GetCleaned() const { return this->Cleaned; }

  int GetColumns() const { return this->Columns; }
  int GetRows() const { return this->Rows; }
  const glm::vec3& At(int column, int row) const
  {
    return this->Texels[static_cast<std::size_t>(row) * this->Columns + column];
  }

  /// The mean over the sphere.
  glm::dvec3 GetMean() const;

private:
  int Columns = 0;
  int Rows = 0;
  std::vector<glm::vec3> Texels;
  std::size_t Cleaned = 0;
};

/// Of a linear colour with the primaries of Rec. 709, which are those of sRGB.
inline double Luminance(const glm::dvec3& c)
{
  return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
}

/// A rectangle of azimuth and m = 1 - cos(polar angle), which runs from 0 at the zenith to 2 at the
/// nadir: its area is its solid angle.
struct SkyPatch
{
  double azimuth0;
  double azimuth1;
  double m0;
  double m1;

  double Area() const { return (this->azimuth1 - this->azimuth0) * (this->m1 - this->m0); }
};

/// m where the polar angle is part / whole of pi. Both halves are exact mirror images.
double FromZenith(std::int64_t part, std::int64_t whole);

/// The unit vector at a height above the horizon (the cosine of the polar angle) and an azimuth.
inline glm::dvec3 SkyDirection(double height, double azimuth)
{
  const double level = std::sqrt(std::max(0.0, 1.0 - height * height));
  return { level * std::cos(azimuth), level * std::sin(azimuth), height };
}

/// A map that is turned counter-clockwise about its axis, seen through patches of the sphere.
class TurnedMap
{
public:
  /// The map must outlive this object.
  TurnedMap(const RadianceMap& map, double turn);

  /// A column or row of texels, or a part of one, along the axis across it.
  struct Slab
  {
    int texel;
    double begin;
    double end;
  };

  /// Finds the columns and rows of a patch, and where it cuts them.
  void Cut(const SkyPatch& patch);
  std::vector<Slab> ColumnsIn;
  std::vector<Slab> RowsIn;

  /// The mean over a patch, parts of texels counted as parts.
  glm::dvec3 Mean(const SkyPatch& patch);

private:
  const RadianceMap& Map;
  double Turn;
  std::vector<double> Edges; // of the rows
};

}

#endif
