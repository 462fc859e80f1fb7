// SPDX-License-Identifier: BSD-3-Clause
#include "HeightOutline.h"

#include "StepThickness.h"

#include <algorithm>
#include <limits>

namespace relief
{

namespace
{
constexpr int RegionShift = MinMaxPyramid::RegionShift;
constexpr int RegionLevel = MinMaxPyramid::RegionLevel;

// The field in one precision, with what is left out as high as it may be at most, or at least.
template <class Real>
struct FilledField
{
  HeightView<float> heights;
  float top = 0.0f;
  const SparseHeights* sparse = nullptr;
  bool upper = false;
  mutable bool guessed = false; // whether anything was asked for that is not there

  // The height that a region without heights has; none if it has no data.
  float Guess(int i, int j) const
  {
    const RasterBounds::Range& range = this->sparse->GetBounds().RangeAt(i, j);
    this->guessed = true;
    return range.lo > range.hi ? std::numeric_limits<float>::quiet_NaN()
      : this->upper            ? range.hi
                               : range.lo;
  }

  // Widens bounds of cells by the samples of a region that close them.
  void Close(int i, int j, MinMaxPyramid::Bounds& bounds) const
  {
    const RasterBounds& raster = this->sparse->GetBounds();
    if (i < raster.GetRegionColumns() && j < raster.GetRegionRows())
    {
      const RasterBounds::Range& range = raster.RangeAt(i, j);
      bounds.lo = std::min(bounds.lo, range.lo);
      bounds.hi = std::max(bounds.hi, range.hi);
    }
  }

  bool IsFilled(int i, int j) const
  {
    const RasterBounds& raster = this->sparse->GetBounds();
    return i >= raster.GetRegionColumns() || j >= raster.GetRegionRows() ||
      this->sparse->IsFilled(i, j);
  }

  // Bounds of a block in a region, some of whose heights are not there. They hold for what is left
  // out whatever its heights are, but for a block that has nothing else: there they are exact.
  MinMaxPyramid::Bounds BoundsOf(int i, int j, bool right, bool above) const
  {
    const RasterBounds& raster = this->sparse->GetBounds();
    if (raster.HasHoles(i, j))
    {
      return MinMaxPyramid::GetMixed();
    }
    MinMaxPyramid::Bounds bounds;
    if (this->sparse->IsFilled(i, j))
    {
      this->Close(i, j, bounds);
    }
    else
    {
      bounds.lo = bounds.hi = this->Guess(i, j);
    }
    if (right)
    {
      this->Close(i + 1, j, bounds);
    }
    if (above)
    {
      this->Close(i, j + 1, bounds);
    }
    if (right && above)
    {
      this->Close(i + 1, j + 1, bounds);
    }
    return bounds;
  }
};

template <class Real>
int reliefColumns(const FilledField<Real>& field)
{
  return field.heights.columns;
}

template <class Real>
int reliefRows(const FilledField<Real>& field)
{
  return field.heights.rows;
}

template <class Real>
Real reliefSpacingX(const FilledField<Real>& field)
{
  return static_cast<Real>(field.heights.spacingX);
}

template <class Real>
Real reliefSpacingY(const FilledField<Real>& field)
{
  return static_cast<Real>(field.heights.spacingY);
}

template <class Real>
Real reliefHeight(const FilledField<Real>& field, int i, int j)
{
  const int regionI = i >> RegionShift;
  const int regionJ = j >> RegionShift;
  return static_cast<Real>(field.sparse->IsFilled(regionI, regionJ)
      ? field.heights.At(i, j)
      : field.Guess(regionI, regionJ));
}

template <class Real>
Real reliefTop(const FilledField<Real>& field)
{
  return static_cast<Real>(field.top);
}

// All of them: those of whole regions and more are known of the whole raster.
template <class Real>
int reliefLevels(const FilledField<Real>& field)
{
  return field.sparse->GetField().GetPyramid().GetNumberOfLevels();
}

template <class Real>
void reliefBounds(const FilledField<Real>& field, int level, int i, int j, Real& lo, Real& hi)
{
  const MinMaxPyramid& pyramid = field.sparse->GetField().GetPyramid();
  MinMaxPyramid::Bounds bounds;
  const int shift = RegionLevel - level; // blocks along a side of a region
  const int regionI = shift > 0 ? i >> shift : 0;
  const int regionJ = shift > 0 ? j >> shift : 0;
  // The last blocks of a region end with samples of the next.
  const int last = (1 << std::max(shift, 0)) - 1;
  const bool right = (i & last) == last;
  const bool above = (j & last) == last;
  const bool known = shift <= 0 ||
    (field.sparse->IsFilled(regionI, regionJ) && (!right || field.IsFilled(regionI + 1, regionJ)) &&
      (!above || field.IsFilled(regionI, regionJ + 1)) &&
      (!right || !above || field.IsFilled(regionI + 1, regionJ + 1)));
  bounds = known ? pyramid.At(level, i, j) : field.BoundsOf(regionI, regionJ, right, above);
  lo = static_cast<Real>(bounds.lo);
  hi = static_cast<Real>(bounds.hi);
}

template <class Real>
FilledField<Real> MakeFilled(const SparseHeights& sparse, bool upper)
{
  FilledField<Real> field;
  field.heights = sparse.GetField().GetField().heights;
  field.top = sparse.GetField().GetTop();
  field.sparse = &sparse;
  field.upper = upper;
  return field;
}
}

void HeightOutline::TraceRow(const f64::ReliefMedium& medium, const Light& light,
  const RowRequest<float>& request, Row& row, RayCount& count) const
{
  const FilledField<double> upper = MakeFilled<double>(this->Heights, true);
  const FilledField<double> lower = MakeFilled<double>(this->Heights, false);
  f64::ReliefMedium exact = medium;
  exact.tolerance = 0.0;
  glm::dvec3 normals[MostSamples];
  RowRequest<double> rays;
  rays.j = request.j;
  rays.begin = request.begin;
  rays.end = request.end;
  rays.wanted = request.wanted;
  if (request.normals)
  {
    std::copy_n(request.normals, request.end - request.begin, normals);
    rays.normals = normals;
  }
  ForEachRay<double>(upper, exact, light, rays, count,
    [&](int k, const f64::ReliefRay& ray, const glm::dvec3& n, const glm::dvec3& l)
    {
      f64::ReliefTrace trace;
      upper.guessed = false;
      row.leastD[k] = row.greatestD[k] = f64::reliefExact(upper, exact, ray, n, l, trace);
      row.leastR[k] = row.greatestR[k] = trace.thickness;
      count.cells += static_cast<std::uint64_t>(trace.cells);
      // No more light can get through than all.
      if (upper.guessed && (request.thickness || row.leastD[k] < 1.0))
      {
        row.greatestD[k] = f64::reliefExact(lower, exact, ray, n, l, trace);
        row.leastR[k] = trace.thickness;
        count.cells += static_cast<std::uint64_t>(trace.cells);
      }
    });
}

void HeightOutline::StepRow(const f32::ReliefMedium& medium, const Light& light, int steps,
  const RowRequest<float>& request, Row& row, RayCount& count) const
{
  const FilledField<float> upper = MakeFilled<float>(this->Heights, true);
  const FilledField<float> lower = MakeFilled<float>(this->Heights, false);
  ForEachRay<float>(upper, medium, light, request, count,
    [&](int k, const f32::ReliefRay& ray, const glm::vec3&, const glm::vec3&)
    {
      const int most = f32::reliefStepCount(upper, ray, steps);
      const int least = f32::reliefStepCount(lower, ray, steps);
      row.leastD[k] = StepIllumination(most);
      row.greatestD[k] = StepIllumination(least);
      row.leastR[k] = StepLength(ray, least, steps);
      row.greatestR[k] = StepLength(ray, most, steps);
      count.cells += 2 * (static_cast<std::uint64_t>(steps) + 1);
    });
}

}
