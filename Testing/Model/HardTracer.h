// SPDX-License-Identifier: BSD-3-Clause
#ifndef HardTracer_h
#define HardTracer_h

/// @file
/// Every way in which d is computed, for one light of a hard scene.

#include "HardScene.h"
#include "HeightField.h"

#include <memory>
#include <string>

/// The ways in which d of one light is computed.
enum class Method
{
  Reference, ///< double, ray by ray, without bounds
  Rays,      ///< float, ray by ray, with bounds
  Sweep,     ///< suns in lockstep
  Packets,   ///< neighbouring rays in lanes
  Scene      ///< as a whole scene chooses
};
constexpr Method AllMethods[] = { Method::Reference, Method::Rays, Method::Sweep, Method::Packets,
  Method::Scene };
const char* NameOf(Method method);

/// A scene made ready for all methods.
class HardTracer
{
public:
  explicit HardTracer(const HardScene& scene);

  /// What is wrong with the heights, or nothing.
  const std::string& GetRefusal() const { return this->Refusal; }

  bool Applies(Method method, const relief::Light& light) const;

  /// d and r of every sample, NaN where nothing was traced.
  Traced<double> Trace(Method method, const relief::Light& light) const;

  /// d by the fixed steps.
  std::vector<float> Count(const relief::Light& light, int steps) const;

private:
  HardScene Scene;
  std::unique_ptr<Samples<double>> Exact;
  relief::HeightField Field;
  std::string Refusal;
};

#endif
