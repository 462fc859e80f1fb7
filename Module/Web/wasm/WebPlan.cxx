// SPDX-License-Identifier: BSD-3-Clause
#include "WebPlan.h"

#include "EffectPlan.h"

#include <algorithm>
#include <array>
#include <limits>

namespace relief::web
{

namespace
{

/// A field of the same bounds and the same place, of its corners alone.
std::string AssignCorners(
  const WebHeights& heights, const WebRange& range, double scale, HeightField& field)
{
  const bool hasData = range.greatest >= range.least;
  const double none = std::numeric_limits<double>::quiet_NaN();
  const double least = hasData ? range.least : none;
  const double greatest = hasData ? range.greatest : none;
  const std::array<double, 4> doubles = { least, greatest, greatest, least };
  std::array<float, 4> floats{};
  std::transform(doubles.begin(), doubles.end(), floats.begin(),
    [](double height) { return static_cast<float>(height); });
  WebHeights corners;
  corners.samples = range.floats ? static_cast<const void*>(floats.data()) : doubles.data();
  corners.type = range.floats ? ArrayType::Float32 : ArrayType::Float64;
  corners.columns = std::min(heights.columns, 2);
  corners.rows = std::min(heights.rows, 2);
  corners.spacing[0] = heights.spacing[0] * std::max(heights.columns - 1, 1);
  corners.spacing[1] = heights.spacing[1] * std::max(heights.rows - 1, 1);
  return Assign(corners, scale, false, field);
}

class Writer
{
public:
  explicit Writer(std::vector<double>& numbers)
    : Numbers(numbers)
  {
  }

  template <class... T>
  void Add(T... values)
  {
    (this->Numbers.push_back(static_cast<double>(values)), ...);
  }

  template <class Vector>
  void AddVector(const Vector& v)
  {
    this->Add(v.x, v.y, v.z);
  }

private:
  std::vector<double>& Numbers;
};

void AddMaterial(const Scene& scene, Writer& to)
{
  to.AddVector(scene.base);
  to.AddVector(scene.diffuse);
  to.AddVector(scene.specular);
  to.Add(scene.specularCoefficient, scene.scatterCoefficient);
  for (const f64::ReliefFalloff& falloff : { scene.specularFalloff, scene.scatterFalloff })
  {
    to.Add(falloff.lo, falloff.hi, falloff.power);
  }
  const f64::ReliefMedium& medium = scene.medium;
  to.Add(medium.depth, medium.density, medium.floorHeight, medium.tolerance, medium.useFloor,
    medium.attenuation == f64::RELIEF_EXPONENTIAL, medium.offset == f64::RELIEF_SURFACE_NORMAL,
    medium.offset == f64::RELIEF_TANGENT_PLANE);
  to.Add(scene.integrator == Integrator::FixedStep, scene.steps,
    scene.response == f64::RELIEF_COMBINED, scene.response == f64::RELIEF_IGOR, scene.exposure);
}

}

std::string PlanNumbers(const WebScene& scene, const WebHeights& heights, const WebRange& range,
  std::vector<double>& numbers)
{
  Scene planned = MaterialOf(scene, heights);
  HeightField field;
  const std::string wrong = AssignCorners(heights, range, scene[key::SceneHeightScale], field);
  if (!wrong.empty())
  {
    return wrong;
  }
  int cleaned = 0;
  const std::size_t around = Complete(scene, heights, field, planned, cleaned);
  const EffectPlan plan = PlanEffects(field, planned);
  Writer to(numbers);
  to.Add(field.GetDatum());
  AddMaterial(planned, to);
  to.Add(plan.diffuse, plan.scatter, plan.specular, plan.lights.size());
  for (std::size_t k = 0; k < plan.lights.size(); ++k)
  {
    const LightPlan& one = plan.lights[k];
    to.Add(one.directional);
    to.AddVector(one.vector);
    to.Add(one.light.positional);
    to.AddVector(one.light.vector);
    to.AddVector(one.radiance);
    to.Add(one.light.toleranceScale);
    // A light by itself, not one of many that stand for a disc or for an environment.
    to.Add(planned.lights[k].weight == 1.0 && k < around);
    to.Add(one.matte, one.shows);
  }
  return std::string();
}

}
