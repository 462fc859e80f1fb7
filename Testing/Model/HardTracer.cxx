// SPDX-License-Identifier: BSD-3-Clause
#include "HardTracer.h"

#include "PacketThickness.h"
#include "PreparedTerrain.h"
#include "SceneShading.h"
#include "SweptRows.h"

using relief::Light;

const char* NameOf(Method method)
{
  switch (method)
  {
    case Method::Reference:
      return "reference";
    case Method::Rays:
      return "rays";
    case Method::Sweep:
      return "sweep";
    case Method::Packets:
      return "packets";
    default:
      return "scene";
  }
}

HardTracer::HardTracer(const HardScene& scene)
  : Scene(scene)
  , Exact(std::make_unique<Samples<double>>(WithoutInfinities(scene.terrain)))
{
  this->Refusal = Assign(scene.terrain, this->Field);
}

bool HardTracer::Applies(Method method, const Light& light) const
{
  return method != Method::Sweep || relief::SweepThickness::Applies(this->Scene.medium, light);
}

Traced<double> HardTracer::Trace(Method method, const Light& light) const
{
  if (method == Method::Reference)
  {
    return ::Trace<double>(this->Exact->WithoutBounds(), this->Scene.medium, light);
  }

  // The field's heights count from its datum.
  Light lowered = light;
  lowered.vector.z -= light.positional ? this->Field.GetDatum() : 0.0;
  relief::f64::ReliefMedium medium = this->Scene.medium;
  medium.floorHeight -= this->Field.GetDatum();
  const relief::Field<float>& field = this->Field.GetField();
  const int columns = field.heights.columns;
  const int rows = field.heights.rows;
  Traced<double> result;
  result.d.assign(static_cast<std::size_t>(columns) * rows, NoData);
  result.r = result.d;
  auto keep = [&](int i, int j, float d, float r)
  {
    if (!std::isnan(field.heights.At(i, j)))
    {
      result.d[static_cast<std::size_t>(j) * columns + i] = d;
      result.r[static_cast<std::size_t>(j) * columns + i] = r;
    }
  };

  if (method == Method::Scene)
  {
    relief::Scene whole;
    whole.medium = medium;
    whole.lights = { lowered };
    std::vector<float> d(result.d.size());
    std::vector<float> r(result.r.size());
    relief::Target target;
    target.width = columns;
    target.illumination = d.data();
    target.thickness = medium.tolerance == 0.0 ? r.data() : nullptr; // which is always exact
    relief::SceneShading(this->Field, whole, target).Shade(0, columns, 0, rows);
    for (std::size_t at = 0; at < d.size(); ++at)
    {
      result.d[at] = d[at];
      result.r[at] = r[at];
    }
    return result;
  }
  if (method == Method::Sweep)
  {
    ForEachSweptRow(this->Field, medium, lowered, SweptLayers::Thickness, result.count,
      [&](int i, int j, int size, const float* d, const float* r)
      {
        for (int k = 0; k < size; ++k)
        {
          keep(i + k, j, d[k], r[k]);
        }
      });
    return result;
  }
  std::vector<glm::vec3> normals(columns);
  std::vector<float> d(columns);
  std::vector<float> r(columns);
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      normals[i] = relief::f32::reliefNormal(field, i, j);
    }
    relief::RowRequest<float> request;
    request.j = j;
    request.end = columns;
    request.normals =
      medium.offset == relief::f64::RELIEF_SURFACE_NORMAL ? normals.data() : nullptr;
    request.illumination = d.data();
    request.thickness = r.data();
    (method == Method::Rays ? relief::TraceRow<float, float> : relief::TracePackets)(
      field, relief::ToSingle(medium), lowered, request, result.count);
    for (int i = 0; i < columns; ++i)
    {
      keep(i, j, d[i], r[i]);
    }
  }
  return result;
}

std::vector<float> HardTracer::Count(const Light& light, int steps) const
{
  const relief::HeightView<float>& heights = this->Field.GetField().heights;
  relief::Scene whole;
  whole.medium = this->Scene.medium;
  whole.integrator = relief::Integrator::FixedStep;
  whole.steps = steps;
  whole.lights = { light };
  whole.lights[0].vector.z -= light.positional ? this->Field.GetDatum() : 0.0;
  std::vector<float> d(this->Scene.terrain.heights.size());
  relief::Target target;
  target.width = heights.columns;
  target.illumination = d.data();
  relief::SceneShading(this->Field, whole, target).Shade(0, heights.columns, 0, heights.rows);
  return d;
}
