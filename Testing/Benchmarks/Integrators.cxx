// SPDX-License-Identifier: BSD-3-Clause
#include "Integrators.h"

#include "SceneShading.h"
#include "StepThickness.h"
#include "SweptRows.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <fstream>
#include <sstream>

namespace bench
{

namespace
{
constexpr double Degree = 3.14159265358979323846 / 180.0;

// Calls body(request) for the rows of a probe.
template <class Real, class Body>
void ForEachRow(const relief::HeightField& field, const Probe& probe, int offset, Real* d,
  std::vector<Real>* r, Body&& body)
{
  std::vector<unsigned char> wanted(probe.columns, 0);
  for (int i = 0; i < probe.columns; i += probe.stride)
  {
    wanted[i] = 1;
  }
  std::vector<typename relief::Precision<Real>::Vec3> normals(
    offset == relief::f64::RELIEF_SURFACE_NORMAL ? probe.columns : 0);
  for (std::size_t k = 0; k < probe.rows.size(); ++k)
  {
    for (std::size_t i = 0; i < normals.size(); ++i)
    {
      const auto n =
        relief::f32::reliefNormal(field.GetField(), static_cast<int>(i), probe.rows[k]);
      normals[i] = typename relief::Precision<Real>::Vec3(n);
    }
    relief::RowRequest<Real> request;
    request.j = probe.rows[k];
    request.end = probe.columns;
    request.normals = normals.empty() ? nullptr : normals.data();
    request.wanted = wanted.data();
    request.illumination = d + k * probe.columns;
    request.thickness = r ? r->data() : nullptr;
    body(request);
  }
}

// The thickness by steps over the bilinear surface. A point amid each step counts as the whole
// step, which errs by half a step at each crossing.
float BilinearSteps(const relief::Field<float>& field, const relief::f32::ReliefRay& ray, int steps)
{
  const relief::HeightView<float>& heights = field.heights;
  const float lastX = static_cast<float>(heights.columns - 1);
  const float lastY = static_cast<float>(heights.rows - 1);
  const float x0 = static_cast<float>(ray.i) + ray.x;
  const float y0 = static_cast<float>(ray.j) + ray.y;
  const float infinity = std::numeric_limits<float>::infinity();
  // Beyond the image the surface is level from where the ray left.
  const float leaveX = ray.dx != 0.0f ? ((ray.dx > 0.0f ? lastX : 0.0f) - x0) / ray.dx : infinity;
  const float leaveY = ray.dy != 0.0f ? ((ray.dy > 0.0f ? lastY : 0.0f) - y0) / ray.dy : infinity;
  const float leave = std::min(leaveX, leaveY);
  const float length = ray.end / static_cast<float>(steps);
  int count = 0;
  for (int k = 0; k < steps; ++k)
  {
    const float s = (static_cast<float>(k) + 0.5f) * length;
    const float over = std::min(s, leave);
    const float x = std::min(std::max(x0 + over * ray.dx, 0.0f), lastX);
    const float y = std::min(std::max(y0 + over * ray.dy, 0.0f), lastY);
    const int i = std::min(static_cast<int>(x), heights.columns - 2);
    const int j = std::min(static_cast<int>(y), heights.rows - 2);
    const float u = x - static_cast<float>(i);
    const float v = y - static_cast<float>(j);
    const float* corner = heights.data + j * heights.stepY + i;
    const float lower = corner[0] + u * (corner[1] - corner[0]);
    const float* next = corner + heights.stepY;
    const float upper = next[0] + u * (next[1] - next[0]);
    const float surface = lower + v * (upper - lower);
    count += s * ray.dz - ray.sink < surface - ray.base ? 1 : 0;
  }
  return static_cast<float>(count) * length;
}

double Width(const relief::HeightField& field)
{
  const relief::HeightView<float>& heights = field.GetField().heights;
  return heights.spacingX * (heights.columns - 1);
}
}

Probe SpreadProbe(const relief::HeightField& field, std::size_t samples)
{
  const relief::HeightView<float>& heights = field.GetField().heights;
  Probe probe;
  probe.columns = heights.columns;
  const int wanted = static_cast<int>(samples / heights.columns);
  const int count = std::max(std::min(wanted, heights.rows / 4), 1);
  for (int k = 0; k < count; ++k)
  {
    probe.rows.push_back(static_cast<int>((k + 0.5) * heights.rows / count));
  }
  return probe;
}

Probe Thinned(const Probe& probe, std::size_t samples)
{
  Probe thinned = probe;
  thinned.stride = 1;
  if (thinned.Size() > samples)
  {
    thinned.stride = static_cast<int>(thinned.Size() / samples);
  }
  return thinned;
}

relief::Light Sun(double azimuth, double altitude)
{
  relief::Light light;
  light.vector = glm::dvec3(std::sin(azimuth * Degree) * std::cos(altitude * Degree),
    std::cos(azimuth * Degree) * std::cos(altitude * Degree), std::sin(altitude * Degree));
  return light;
}

relief::Light Lamp(const relief::HeightField& field, double azimuth, double altitude, double widths)
{
  const relief::HeightView<float>& heights = field.GetField().heights;
  relief::Light light = Sun(azimuth, altitude);
  light.positional = true;
  light.vector = light.vector * (widths * Width(field)) +
    glm::dvec3(Width(field) / 2.0, heights.spacingY * (heights.rows - 1) / 2.0,
      (field.GetTop() + field.GetBottom()) / 2.0);
  return light;
}

relief::Light SunOnSphere(const relief::HeightField& field, double azimuth, double altitude)
{
  return relief::OnBoundingSphere(
    Sun(azimuth, altitude), field.GetField().heights, field.GetBottom(), field.GetTop());
}

relief::f64::ReliefMedium Medium(const relief::HeightField& field, double tolerance, int offset)
{
  return { field.GetField().heights.spacingX, offset, relief::f64::RELIEF_RECIPROCAL, 1.0, false,
    0.0, tolerance };
}

void RunSweep(const relief::HeightField& field, const relief::f64::ReliefMedium& medium,
  const relief::Light& light, float* d)
{
  const int columns = field.GetField().heights.columns;
  relief::RayCount count;
  ForEachSweptRow(field, medium, light, SweptLayers::Illumination, count,
    [&](int i, int j, int size, const float* row, const float*)
    { std::copy_n(row, size, d + static_cast<std::size_t>(j) * columns + i); });
}

void RunScene(const relief::HeightField& field, const relief::f64::ReliefMedium& medium,
  const relief::Light& light, float* d)
{
  const relief::HeightView<float>& heights = field.GetField().heights;
  relief::Scene scene;
  scene.diffuse = glm::dvec3(0.0); // no colour, d alone
  scene.medium = medium;
  scene.lights.push_back(light);
  relief::Target target;
  target.width = heights.columns;
  target.illumination = d;
  relief::SceneShading shading(field, scene, target);
  shading.Shade(0, heights.columns, 0, heights.rows);
}

void RunRays(const relief::HeightField& field, const relief::f64::ReliefMedium& medium,
  const relief::Light& light, const Probe& probe, float* d)
{
  relief::RayCount count;
  ForEachRow<float>(field, probe, medium.offset, d, nullptr,
    [&](const relief::RowRequest<float>& request) {
      relief::TraceRow<float>(field.GetField(), relief::ToSingle(medium), light, request, count);
    });
}

void RunReference(const relief::HeightField& field, const relief::f64::ReliefMedium& medium,
  const relief::Light& light, const Probe& probe, double* d)
{
  relief::Field<float> plain = field.GetField();
  plain.bounds = nullptr;
  relief::f64::ReliefMedium exact = medium;
  exact.tolerance = 0.0;
  relief::RayCount count;
  ForEachRow<double>(field, probe, medium.offset, d, nullptr,
    [&](const relief::RowRequest<double>& request)
    { relief::TraceRow<double>(plain, exact, light, request, count); });
}

void RunSteps(const relief::HeightField& field, const relief::f64::ReliefMedium& medium,
  const relief::Light& light, Stepping stepping, int steps, const Probe& probe, float* d)
{
  const relief::f32::ReliefMedium single = relief::ToSingle(medium);
  relief::RayCount count;
  std::vector<float> r(probe.columns);
  ForEachRow<float>(field, probe, medium.offset, d, &r,
    [&](const relief::RowRequest<float>& request)
    {
      if (stepping == Stepping::Bilinear)
      {
        relief::ForEachRay<float>(field.GetField(), single, light, request, count,
          [&](int k, const relief::f32::ReliefRay& ray, const glm::vec3&, const glm::vec3&)
          {
            request.illumination[k] =
              relief::f32::reliefIllumination(single, BilinearSteps(field.GetField(), ray, steps));
          });
        return;
      }
      relief::StepRow(field.GetField(), single, light, steps, request, count);
      for (int i = 0; stepping == Stepping::Thickness && i < probe.columns; i += probe.stride)
      {
        request.illumination[i] = relief::f32::reliefIllumination(single, r[i]);
      }
    });
}

ErrorOfD Compare(const Probe& probe, const std::vector<double>& reference, const float* d)
{
  std::vector<double> errors;
  for (std::size_t k = 0; k < probe.rows.size(); ++k)
  {
    for (int i = 0; i < probe.columns; i += probe.stride)
    {
      const std::size_t at = k * probe.columns + i;
      errors.push_back(std::abs(static_cast<double>(d[at]) - reference[at]));
    }
  }
  ErrorOfD error;
  for (double e : errors)
  {
    error.most = std::max(error.most, e);
    error.rms += e * e;
  }
  error.rms = std::sqrt(error.rms / static_cast<double>(errors.size()));
  const auto place = errors.begin() + static_cast<std::ptrdiff_t>(0.999 * (errors.size() - 1));
  std::nth_element(errors.begin(), place, errors.end());
  error.mostOf999 = *place;
  return error;
}

std::vector<float> Pick(const Probe& probe, const std::vector<float>& all)
{
  std::vector<float> picked;
  for (int row : probe.rows)
  {
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(row) * probe.columns;
    picked.insert(picked.end(), begin, begin + probe.columns);
  }
  return picked;
}

std::string Environment()
{
  std::string processor = "unknown processor";
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
  {
    if (line.rfind("model name", 0) == 0)
    {
      processor = line.substr(line.find(':') + 2);
      break;
    }
  }
  char date[32];
  const std::time_t now = std::time(nullptr);
  std::strftime(date, sizeof(date), "%Y-%m-%d", std::gmtime(&now));
  std::ostringstream text;
  text << processor << ", " << relief::SweepThickness::GetTargetName() << ", "
#if defined(__clang__)
       << "Clang " __clang_version__
#elif defined(__GNUC__)
       << "GCC " __VERSION__
#endif
       << ", " << date;
  return text.str();
}

}
