// SPDX-License-Identifier: BSD-3-Clause
#include "HardSceneShrinking.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

namespace
{
using relief::Light;

// How much there is to read in a number: its shortest decimal text, then its size. A number is only
// ever replaced by one of less, so that shrinking ends.
std::pair<std::ptrdiff_t, double> ComplexityOf(double x)
{
  std::array<char, 32> text;
  const char* end = std::to_chars(text.data(), text.data() + text.size(), x).ptr;
  return { end - text.data(), std::abs(x) };
}

// Numbers that read more easily than x, the simplest first; none where x is as simple as can be.
std::vector<double> Simpler(double x)
{
  if (!std::isfinite(x))
  {
    return { 0.0 };
  }
  const double whole = std::trunc(x);
  std::vector<double> result = { 0.0, 1.0, std::trunc(x / 2.0), whole - std::copysign(1.0, x),
    whole, std::round(x) };
  for (int digits = 0; x != 0.0 && digits < 7; ++digits)
  {
    const double unit = std::pow(10.0, std::floor(std::log10(std::abs(x))) - digits);
    result.push_back(std::round(x / unit) * unit);
  }
  auto isNoSimpler = [x](double candidate) { return ComplexityOf(candidate) >= ComplexityOf(x); };
  result.erase(std::remove_if(result.begin(), result.end(), isNoSimpler), result.end());
  return result;
}

// Without the columns [first, first + count). Lamps behind them come along or stay.
HardScene WithoutColumns(const HardScene& scene, int first, int count, bool lampsStay)
{
  HardScene result = scene;
  const Terrain& from = scene.terrain;
  result.terrain = Terrain(from.columns - count, from.rows, from.spacingX, from.spacingY);
  for (int j = 0; j < from.rows; ++j)
  {
    for (int i = 0; i < result.terrain.columns; ++i)
    {
      result.terrain.At(i, j) = from.At(i < first ? i : i + count, j);
    }
  }
  for (Light& light : result.lights)
  {
    light.vector.x -= light.positional && !lampsStay && light.vector.x > first * from.spacingX
      ? count * from.spacingX
      : 0.0;
  }
  return result;
}

HardScene WithoutRows(const HardScene& scene, int first, int count, bool lampsStay)
{
  HardScene result = scene;
  const Terrain& from = scene.terrain;
  result.terrain = Terrain(from.columns, from.rows - count, from.spacingX, from.spacingY);
  auto begin = from.heights.begin() + static_cast<std::ptrdiff_t>(first) * from.columns;
  std::copy(from.heights.begin(), begin, result.terrain.heights.begin());
  std::copy(begin + static_cast<std::ptrdiff_t>(count) * from.columns, from.heights.end(),
    result.terrain.heights.begin() + static_cast<std::ptrdiff_t>(first) * from.columns);
  for (Light& light : result.lights)
  {
    light.vector.y -= light.positional && !lampsStay && light.vector.y > first * from.spacingY
      ? count * from.spacingY
      : 0.0;
  }
  return result;
}

class Shrinker
{
public:
  Shrinker(HardScene scene, const std::function<bool(const HardScene&)>& fails)
    : Best(std::move(scene))
    , Fails(fails)
  {
  }

  const HardScene& Run()
  {
    do
    {
      this->Changed = false;
      this->DropLights();
      this->DropSamples();
      this->SimplifyMedium();
      this->SimplifyLights();
      this->SimplifyHeights();
    } while (this->Changed);
    return this->Best;
  }

private:
  bool Try(const HardScene& candidate)
  {
    if (!this->Fails(candidate))
    {
      return false;
    }
    this->Best = candidate;
    this->Changed = true;
    return true;
  }

  // Puts the simplest number that still fails where `number` finds it.
  void SimplifyNumber(const std::function<double&(HardScene&)>& number)
  {
    for (double simpler : Simpler(number(this->Best)))
    {
      HardScene candidate = this->Best;
      number(candidate) = simpler;
      if (this->Try(candidate))
      {
        return;
      }
    }
  }

  void DropLights()
  {
    for (std::size_t k = this->Best.lights.size(); k-- > 0 && this->Best.lights.size() > 1;)
    {
      HardScene candidate = this->Best;
      candidate.lights.erase(candidate.lights.begin() + static_cast<std::ptrdiff_t>(k));
      this->Try(candidate);
    }
  }

  // Halves first, then quarters, down to single columns and rows.
  void DropSamples()
  {
    this->Drop(&Terrain::columns, WithoutColumns);
    this->Drop(&Terrain::rows, WithoutRows);
  }

  template <class Without>
  void Drop(int Terrain::*size, Without&& without)
  {
    for (int count = std::max(this->Best.terrain.*size / 2, 1); count > 0; count /= 2)
    {
      for (int first = this->Best.terrain.*size - count; first >= 0; first -= count)
      {
        for (bool lampsStay : { false, true })
        {
          const int samples = this->Best.terrain.*size;
          if (samples > count && first + count <= samples)
          {
            this->Try(without(this->Best, first, count, lampsStay));
          }
        }
      }
    }
  }

  void SimplifyMedium()
  {
    auto tryMedium = [this](auto&& change)
    {
      HardScene candidate = this->Best;
      change(candidate.medium);
      const relief::f64::ReliefMedium& a = candidate.medium;
      const relief::f64::ReliefMedium& b = this->Best.medium;
      if (a.useFloor != b.useFloor || a.offset != b.offset || a.attenuation != b.attenuation)
      {
        this->Try(candidate);
      }
    };
    using relief::f64::ReliefMedium;
    tryMedium(
      [](ReliefMedium& medium)
      {
        medium.useFloor = false;
        medium.floorHeight = 0.0;
      });
    tryMedium([](ReliefMedium& medium) { medium.offset = relief::f64::RELIEF_VERTICAL; });
    tryMedium(
      [](ReliefMedium& medium)
      {
        medium.attenuation = relief::f64::RELIEF_RECIPROCAL;
        medium.density = 1.0;
      });
    this->SimplifyNumber([](HardScene& scene) -> double& { return scene.medium.tolerance; });
    this->SimplifyNumber([](HardScene& scene) -> double& { return scene.medium.floorHeight; });
    this->SimplifyPositive([](HardScene& scene) -> double& { return scene.medium.density; });
    this->SimplifyPositive([](HardScene& scene) -> double& { return scene.medium.depth; });
    this->SimplifyPositive([](HardScene& scene) -> double& { return scene.terrain.spacingX; });
    this->SimplifyPositive([](HardScene& scene) -> double& { return scene.terrain.spacingY; });
  }

  // 0 is another case for a depth, and none for a spacing.
  void SimplifyPositive(const std::function<double&(HardScene&)>& number)
  {
    for (double simpler : Simpler(number(this->Best)))
    {
      HardScene candidate = this->Best;
      number(candidate) = simpler;
      if (simpler > 0.0 && this->Try(candidate))
      {
        return;
      }
    }
  }

  // Lamps by their coordinates; suns, which must stay of unit length, by their angles.
  void SimplifyLights()
  {
    for (std::size_t k = 0; k < this->Best.lights.size(); ++k)
    {
      if (this->Best.lights[k].positional)
      {
        for (int axis = 0; axis < 3; ++axis)
        {
          this->SimplifyNumber(
            [k, axis](HardScene& scene) -> double& { return scene.lights[k].vector[axis]; });
        }
        continue;
      }
      const glm::dvec3 v = this->Best.lights[k].vector;
      const double azimuth = std::atan2(v.x, v.y) * 180.0 / Pi;
      const double altitude = std::asin(std::clamp(v.z, -1.0, 1.0)) * 180.0 / Pi;
      for (double step : { 45.0, 15.0, 5.0, 1.0 })
      {
        HardScene candidate = this->Best;
        candidate.lights[k] =
          Sun(std::round(azimuth / step) * step, std::round(altitude / step) * step);
        if (candidate.lights[k].vector == v || this->Try(candidate))
        {
          break;
        }
      }
    }
  }

  void SimplifyHeights()
  {
    for (std::size_t k = 0; k < this->Best.terrain.heights.size(); ++k)
    {
      this->SimplifyNumber([k](HardScene& scene) -> double& { return scene.terrain.heights[k]; });
    }
  }

  HardScene Best;
  const std::function<bool(const HardScene&)>& Fails;
  bool Changed = false;
};

}

HardScene Shrink(HardScene scene, const std::function<bool(const HardScene&)>& fails)
{
  return Shrinker(std::move(scene), fails).Run();
}
