// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestTerrain_h
#define TestTerrain_h

/// @file
/// Height fields and lights for the model's tests.

#include "MinMaxPyramid.h"
#include "RayThickness.h"

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <vector>

constexpr double Pi = 3.14159265358979323846;
constexpr double NoData = std::numeric_limits<double>::quiet_NaN();

/// Seed of every random scene, overridable to look for others: RELIEF_SEED=7 ctest -L model, or
/// RELIEF_SEED=fresh for one that never was before, which is printed.
inline std::uint64_t Seed()
{
  auto choose = []() -> std::uint64_t
  {
    const char* text = std::getenv("RELIEF_SEED");
    if (text && std::string(text) == "fresh")
    {
      std::random_device device;
      const std::uint64_t seed = (static_cast<std::uint64_t>(device()) << 32) | device();
      std::printf("RELIEF_SEED=%llu\n", static_cast<unsigned long long>(seed));
      return seed;
    }
    return text ? std::strtoull(text, nullptr, 10) : 20170501;
  };
  static const std::uint64_t seed = choose();
  return seed;
}

/// Random numbers that are the same everywhere, which the standard's distributions are not.
class Random
{
public:
  explicit Random(std::uint64_t seed)
    : Engine(seed)
  {
  }
  double Uniform(double lo, double hi)
  {
    return lo + (hi - lo) * static_cast<double>(this->Engine() >> 11) * 0x1p-53;
  }
  /// From lo to hi, both included.
  int Integer(int lo, int hi)
  {
    return lo + static_cast<int>(this->Engine() % static_cast<std::uint64_t>(hi - lo + 1));
  }
  bool Chance(double probability) { return this->Uniform(0.0, 1.0) < probability; }
  /// Between lo and hi, each decade as likely as another.
  double Logarithmic(double lo, double hi)
  {
    return std::exp(this->Uniform(std::log(lo), std::log(hi)));
  }

private:
  std::mt19937_64 Engine;
};

/// A height field as a test writes it down.
struct Terrain
{
  int columns = 0;
  int rows = 0;
  double spacingX = 1.0;
  double spacingY = 1.0;
  std::vector<double> heights;

  Terrain() = default;
  Terrain(int c, int r, double sx = 1.0, double sy = 1.0)
    : columns(c)
    , rows(r)
    , spacingX(sx)
    , spacingY(sy)
    , heights(static_cast<std::size_t>(c) * r, 0.0)
  {
  }

  double& At(int i, int j)
  {
    return this->heights[static_cast<std::size_t>(j) * this->columns + i];
  }
  double At(int i, int j) const
  {
    return this->heights[static_cast<std::size_t>(j) * this->columns + i];
  }

  /// Sets every sample to f(x, y).
  template <class F>
  void Fill(F&& f)
  {
    for (int j = 0; j < this->rows; ++j)
    {
      for (int i = 0; i < this->columns; ++i)
      {
        this->At(i, j) = f(i * this->spacingX, j * this->spacingY);
      }
    }
  }

  /// Rounds heights to what float holds, so that float and double shade the same surface.
  void RoundToSingle()
  {
    for (double& height : this->heights)
    {
      height = static_cast<float>(height);
    }
  }

  double Greatest() const
  {
    double greatest = 0.0;
    for (double height : this->heights)
    {
      greatest = std::abs(height) > greatest ? std::abs(height) : greatest;
    }
    return greatest;
  }
};

/// A relief as the module's functions take it, in one precision, with bounds or without.
template <class T>
class Samples
{
public:
  explicit Samples(const Terrain& terrain)
    : Heights(terrain.heights.begin(), terrain.heights.end())
    , Single(terrain.heights.begin(), terrain.heights.end())
  {
    this->Plain.heights = View(this->Heights.data(), terrain);
    T top = -std::numeric_limits<T>::infinity();
    for (T height : this->Heights)
    {
      top = height > top ? height : top;
    }
    this->Plain.top = top;
    this->Pyramid.Allocate(terrain.columns, terrain.rows);
    this->Pyramid.BuildBase(
      View(this->Single.data(), terrain), 0, this->Pyramid.GetNumberOfBaseRows());
    this->Pyramid.BuildUpper();
    this->Bounded = this->Plain;
    this->Bounded.bounds = &this->Pyramid;
  }
  Samples(const Samples&) = delete;
  void operator=(const Samples&) = delete;

  const relief::Field<T>& WithBounds() const { return this->Bounded; }
  const relief::Field<T>& WithoutBounds() const { return this->Plain; }

private:
  template <class U>
  static relief::HeightView<U> View(const U* data, const Terrain& terrain)
  {
    relief::HeightView<U> view;
    view.data = data;
    view.stepX = 1;
    view.stepY = terrain.columns;
    view.columns = terrain.columns;
    view.rows = terrain.rows;
    view.spacingX = terrain.spacingX;
    view.spacingY = terrain.spacingY;
    return view;
  }

  std::vector<T> Heights;
  std::vector<float> Single;
  relief::MinMaxPyramid Pyramid;
  relief::Field<T> Plain;
  relief::Field<T> Bounded;
};

/// Unit vector toward azimuth (clockwise from +y) and altitude, in degrees; exact along the axes.
inline glm::dvec3 Toward(double azimuth, double altitude)
{
  auto sine = [](double degrees)
  {
    double turn = std::fmod(degrees, 360.0);
    turn = turn < 0.0 ? turn + 360.0 : turn;
    return turn == 0.0 || turn == 180.0 ? 0.0 : std::sin(turn * Pi / 180.0);
  };
  double level = sine(altitude + 90.0);
  return glm::dvec3(sine(azimuth) * level, sine(azimuth + 90.0) * level, sine(altitude));
}

inline relief::Light Directional(const glm::dvec3& toward)
{
  relief::Light light;
  light.vector = toward;
  return light;
}

inline relief::Light Sun(double azimuth, double altitude)
{
  return Directional(Toward(azimuth, altitude));
}

inline relief::Light Lamp(double x, double y, double z)
{
  relief::Light light;
  light.vector = glm::dvec3(x, y, z);
  light.positional = true;
  return light;
}

/// Every way down to p'.
constexpr int AllOffsets[] = { relief::f64::RELIEF_VERTICAL, relief::f64::RELIEF_SURFACE_NORMAL,
  relief::f64::RELIEF_TANGENT_PLANE };

inline const char* NameOfOffset(int offset)
{
  return offset == relief::f64::RELIEF_VERTICAL    ? "Vertical"
    : offset == relief::f64::RELIEF_SURFACE_NORMAL ? "SurfaceNormal"
                                                   : "TangentPlane";
}

/// Reciprocal attenuation, exact, without a floor.
inline relief::f64::ReliefMedium Sunk(double depth, int offset = relief::f64::RELIEF_VERTICAL)
{
  return { depth, offset, relief::f64::RELIEF_RECIPROCAL, 1.0, false, 0.0, 0.0 };
}

inline relief::f64::ReliefMedium WithFloor(relief::f64::ReliefMedium medium, double height)
{
  medium.useFloor = true;
  medium.floorHeight = height;
  return medium;
}

/// The medium in one precision.
template <class Real>
typename relief::Precision<Real>::Medium MediumIn(const relief::f64::ReliefMedium& medium)
{
  if constexpr (std::is_same_v<Real, float>)
  {
    return relief::ToSingle(medium);
  }
  else
  {
    return medium;
  }
}

/// Illumination and thickness of every sample, NaN where nothing was traced.
template <class Real>
struct Traced
{
  std::vector<Real> d;
  std::vector<Real> r;
  relief::RayCount count;
};

/// Traces every sample of a field for one light.
template <class Real, class T>
Traced<Real> Trace(const relief::Field<T>& field, const relief::f64::ReliefMedium& medium,
  const relief::Light& light)
{
  int columns = field.heights.columns;
  int rows = field.heights.rows;
  std::size_t size = static_cast<std::size_t>(columns) * rows;
  Traced<Real> traced;
  traced.d.assign(size, std::numeric_limits<Real>::quiet_NaN());
  traced.r.assign(size, std::numeric_limits<Real>::quiet_NaN());
  std::vector<typename relief::Precision<Real>::Vec3> normals(columns);
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      if constexpr (std::is_same_v<Real, float>)
      {
        normals[i] = relief::f32::reliefNormal(field, i, j);
      }
      else
      {
        normals[i] = relief::f64::reliefNormal(field, i, j);
      }
    }
    relief::RowRequest<Real> request;
    request.j = j;
    request.end = columns;
    request.normals =
      medium.offset == relief::f64::RELIEF_SURFACE_NORMAL ? normals.data() : nullptr;
    request.illumination = traced.d.data() + static_cast<std::size_t>(j) * columns;
    request.thickness = traced.r.data() + static_cast<std::size_t>(j) * columns;
    relief::TraceRow<Real>(field, MediumIn<Real>(medium), light, request, traced.count);
  }
  return traced;
}

#endif
