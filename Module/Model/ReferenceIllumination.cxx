// SPDX-License-Identifier: BSD-3-Clause
#include "ReferenceIllumination.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace relief
{

namespace
{
// Single precision, in which the scene is shaded.
constexpr double Epsilon = 0x1p-23;
// How far d is from that of some heights within rounding.
constexpr double RoundingOfD = 2e-6;

// A field whose heights are moved, but for one sample's own: how deep a point lies below the
// surface is what t says exactly. Those behind it, as seen along a ray, may move the other way,
// which changes the slope at which the ground goes on beyond the data.
struct MovedField
{
  const Field<float>& plain;
  int i;
  int j;
  double aheadX; // of the ray
  double aheadY;
  double raise;
  double raiseBehind;
};

int reliefColumns(const MovedField& field)
{
  return field.plain.heights.columns;
}

int reliefRows(const MovedField& field)
{
  return field.plain.heights.rows;
}

double reliefSpacingX(const MovedField& field)
{
  return field.plain.heights.spacingX;
}

double reliefSpacingY(const MovedField& field)
{
  return field.plain.heights.spacingY;
}

double reliefHeight(const MovedField& field, int i, int j)
{
  const double height = field.plain.heights.At(i, j);
  if (i == field.i && j == field.j)
  {
    return height;
  }
  const bool behind = (i - field.i) * field.aheadX + (j - field.j) * field.aheadY < 0.0;
  return height + (behind ? field.raiseBehind : field.raise);
}

double reliefTop(const MovedField& field)
{
  return field.plain.top + std::max({ field.raise, field.raiseBehind, 0.0 });
}

int reliefLevels(const MovedField&)
{
  return 0;
}

void reliefBounds(const MovedField&, int, int, int, double& lo, double& hi)
{
  lo = -std::numeric_limits<double>::infinity();
  hi = -lo;
}

// The normal that points are sunk along, if they are.
glm::dvec3 NormalAt(const Field<float>& field, const f64::ReliefMedium& medium, int i, int j)
{
  return medium.offset == f64::RELIEF_SURFACE_NORMAL ? f64::reliefNormal(field, i, j)
                                                     : glm::dvec3(0.0, 0.0, 1.0);
}
}

ReferenceIllumination::ReferenceIllumination(const HeightField& field, const Scene& scene)
  : Plain(field.GetField())
  , Medium(scene.medium)
  , Unit(Epsilon * (static_cast<double>(field.GetTop()) - field.GetBottom() + scene.medium.depth))
{
  this->Plain.bounds = nullptr;
  this->Medium.tolerance = 0.0;
  Scene exact = scene;
  exact.integrator = Integrator::Exact;
  double sizes = 0.0;
  const EffectPlan effects = PlanEffects(field, exact);
  for (const LightPlan& plan : effects.lights)
  {
    if (!plan.lit)
    {
      continue;
    }
    const double share = plan.light.intensity * plan.light.weight;
    this->Sources.push_back({ plan.light, share, !plan.dark });
    sizes += std::abs(share);
    this->Tolerance += std::abs(share) * scene.medium.tolerance * plan.light.toleranceScale;
  }
  this->Scale = effects.shareSum != 0.0 ? 1.0 / effects.shareSum : 0.0;
  this->Tolerance *= std::abs(this->Scale);
  this->Rounding = RoundingOfD * sizes * std::abs(this->Scale);
}

double ReferenceIllumination::Trace(const Light& light, int i, int j, std::uint64_t& cells) const
{
  const glm::dvec3 n = NormalAt(this->Plain, this->Medium, i, j);
  double d = 0.0;
  RowRequest<double> request;
  request.j = j;
  request.begin = i;
  request.end = i + 1;
  request.normals = &n;
  request.illumination = &d;
  RayCount count;
  TraceRow<double>(this->Plain, this->Medium, light, request, count);
  cells += count.cells;
  return d;
}

double ReferenceIllumination::At(int i, int j, std::uint64_t& cells) const
{
  double sum = 0.0;
  for (const Source& source : this->Sources)
  {
    sum += source.traced ? source.share * this->Trace(source.light, i, j, cells) : 0.0;
  }
  return sum * this->Scale;
}

ReferenceIllumination::Span ReferenceIllumination::SpanOf(const Light& light, int i, int j) const
{
  const HeightView<float>& heights = this->Plain.heights;
  const glm::dvec3 n = NormalAt(this->Plain, this->Medium, i, j);
  const double raise = MostUnits * this->Unit;
  const double turn = 4.0 * Epsilon;
  const double shiftX = turn * (heights.columns + this->Medium.depth / heights.spacingX);
  const double shiftY = turn * (heights.rows + this->Medium.depth / heights.spacingY);
  // A dense material tells r from t to the last digit of either.
  const double dense = this->Medium.attenuation == f64::RELIEF_EXPONENTIAL ? 8.0 * Epsilon : 0.0;
  // As they are, up, down, and up ahead of the sample and down behind it, or the other way.
  constexpr double moves[][2] = { { 0, 0 }, { 1, 1 }, { -1, -1 }, { 1, -1 }, { -1, 1 } };
  Span span = { std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() };
  for (const auto& move : moves)
  {
    f64::ReliefMedium medium = this->Medium;
    medium.floorHeight -= move[0] * raise;
    for (int lift = light.positional ? -1 : 0; lift <= (light.positional ? 1 : 0); ++lift)
    {
      glm::dvec3 toward = LightFrom<double>(light, heights, i, j);
      toward.z += lift * raise;
      glm::dvec3 l;
      const f64::ReliefRay straight =
        f64::reliefRay(this->Plain, this->Medium, i, j, n, toward, light.positional, l);
      const MovedField moved = { this->Plain, i, j, straight.dx, straight.dy, move[0] * raise,
        move[1] * raise };
      for (int side = 0; side < 27; ++side)
      {
        f64::ReliefRay ray = straight;
        const int turned = side / 9 - 1;
        const double angle = turned * turn;
        ray.dx -= angle * l.y / heights.spacingX;
        ray.dy += angle * l.x / heights.spacingY;
        ray.x += (side % 3 - 1) * shiftX;
        ray.y += (side / 3 % 3 - 1) * shiftY;
        const f64::ReliefTrace trace = f64::reliefTrace(moved, medium, ray);
        for (int stretch = -1; stretch <= 1; ++stretch)
        {
          f64::ReliefTrace stretched = trace;
          stretched.thickness *= 1.0 + stretch * dense;
          const double d = f64::reliefTraced(moved, medium, ray, n, l, stretched);
          span.lo = std::min(span.lo, d);
          span.hi = std::max(span.hi, d);
        }
      }
    }
  }
  return span;
}

ReferenceIllumination::Span ReferenceIllumination::SpanAt(int i, int j) const
{
  Span sum = { 0.0, 0.0 };
  for (const Source& source : this->Sources)
  {
    const Span one = source.traced ? this->SpanOf(source.light, i, j) : Span{ 0.0, 0.0 };
    const double share = source.share * this->Scale;
    sum.lo += share * (share < 0.0 ? one.hi : one.lo);
    sum.hi += share * (share < 0.0 ? one.lo : one.hi);
  }
  return sum;
}

}
