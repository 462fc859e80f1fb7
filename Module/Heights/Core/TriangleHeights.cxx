// SPDX-License-Identifier: BSD-3-Clause
#include "TriangleHeights.h"

#include "TriangleOrientation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace relief
{

namespace
{
// Each band of rows is filled by one thread at a time, and so are the bins of a block of triangles.
constexpr int MostBands = 256;
constexpr std::size_t BlockSize = 4096;
constexpr std::size_t BlocksAtOnce = 256;
// Triangles over more bands than this are not put into each of them.
constexpr int MostBandsOfBin = 4;
// Samples of the triangles' boxes between two questions whether to go on.
constexpr double WorkAtOnce = 1e8;
constexpr double Farthest = 1e100;
// Coordinates up to here are rounded by far less than a sample where an edge crosses a row.
constexpr double FarthestCrossing = 1e9;

// A triangle and the bands it lies in.
struct BandedTriangle
{
  std::uint32_t triangle;
  std::uint16_t first;
  std::uint16_t last;
};

// The triangles of a block, by band. Those in few bands are sorted: band b has the items from
// begins[b] to begins[b + 1].
struct Bins
{
  std::vector<BandedTriangle> few;
  std::vector<BandedTriangle> many;
  std::vector<std::uint32_t> items;
  std::vector<std::uint32_t> begins;
  std::size_t leftOut = 0;
  double work = 0.0;
};

// Three corners; which samples may lie within them.
struct Corners
{
  const double* p[3];

  Corners(const TriangleMesh& mesh, std::size_t triangle)
  {
    for (int k = 0; k < 3; ++k)
    {
      this->p[k] = mesh.points + 3 * static_cast<std::size_t>(mesh.corners[3 * triangle + k]);
    }
  }

  double Least(int axis) const
  {
    return std::min(std::min(this->p[0][axis], this->p[1][axis]), this->p[2][axis]);
  }
  double Most(int axis) const
  {
    return std::max(std::max(this->p[0][axis], this->p[1][axis]), this->p[2][axis]);
  }

  bool AreUsable() const
  {
    bool usable = true;
    for (const double* point : this->p)
    {
      // Not so for NaN.
      usable = usable && std::abs(point[0]) <= Farthest && std::abs(point[1]) <= Farthest &&
        std::abs(point[2]) <= Farthest;
    }
    return usable;
  }

  double Weights(double x, double y, double weights[3]) const
  {
    for (int k = 0; k < 3; ++k)
    {
      const double* a = this->p[(k + 1) % 3];
      const double* b = this->p[(k + 2) % 3];
      weights[k] = OrientedArea(a[0], a[1], b[0], b[1], x, y);
    }
    return weights[0] + weights[1] + weights[2];
  }
};

// The samples of an axis from `low` to `high`: none if the first is behind the last.
struct Range
{
  int first;
  int last;

  Range(double low, double high, int begin, int end)
    : first(static_cast<int>(std::max(std::min(std::ceil(low), 1.0 * end), 1.0 * begin)))
    , last(static_cast<int>(std::min(std::max(std::floor(high), begin - 1.0), end - 1.0)))
  {
  }
  bool IsEmpty() const { return this->first > this->last; }
};

//------------------------------------------------------------------------------
class Rasterizer
{
public:
  Rasterizer(const TriangleMesh& mesh, const TriangleHeights& result)
    : Mesh(mesh)
    , Result(result)
    , BandRows((result.rows + MostBands - 1) / MostBands)
    , Bands((result.rows + this->BandRows - 1) / this->BandRows)
  {
  }

  int GetBands() const { return this->Bands; }

  void Clear(int band) const;
  void Sort(std::size_t begin, std::size_t end, Bins& bins) const;
  void Fill(int band, const Bins& bins) const;

private:
  void SortFew(Bins& bins) const;
  void FillTriangle(std::uint32_t triangle, int firstRow, int endRow) const;
  Range FindColumns(const Corners& corners, const Range& box, int row) const;

  const TriangleMesh& Mesh;
  const TriangleHeights& Result;
  int BandRows;
  int Bands;
};

//------------------------------------------------------------------------------
void Rasterizer::Clear(int band) const
{
  const std::size_t columns = static_cast<std::size_t>(this->Result.columns);
  const std::size_t begin = columns * static_cast<std::size_t>(band * this->BandRows);
  const std::size_t end =
    columns * static_cast<std::size_t>(std::min((band + 1) * this->BandRows, this->Result.rows));
  std::fill(this->Result.heights + begin, this->Result.heights + end,
    std::numeric_limits<double>::quiet_NaN());
  if (this->Result.triangles)
  {
    std::fill(this->Result.triangles + begin, this->Result.triangles + end, NoTriangle);
  }
}

//------------------------------------------------------------------------------
// Most of a fine mesh's triangles lie between the samples, and end here.
void Rasterizer::Sort(std::size_t begin, std::size_t end, Bins& bins) const
{
  bins.few.clear();
  bins.many.clear();
  bins.leftOut = 0;
  bins.work = 0.0;
  for (std::size_t triangle = begin; triangle < end; ++triangle)
  {
    const Corners corners(this->Mesh, triangle);
    if (!corners.AreUsable())
    {
      ++bins.leftOut;
      continue;
    }
    const Range columns(corners.Least(0), corners.Most(0), 0, this->Result.columns);
    const Range rows(corners.Least(1), corners.Most(1), 0, this->Result.rows);
    if (columns.IsEmpty() || rows.IsEmpty())
    {
      continue;
    }
    const BandedTriangle banded = { static_cast<std::uint32_t>(triangle),
      static_cast<std::uint16_t>(rows.first / this->BandRows),
      static_cast<std::uint16_t>(rows.last / this->BandRows) };
    (banded.last - banded.first < MostBandsOfBin ? bins.few : bins.many).push_back(banded);
    bins.work += 1.0 * (columns.last - columns.first + 1) * (rows.last - rows.first + 1);
  }
  this->SortFew(bins);
}

//------------------------------------------------------------------------------
// By counting.
void Rasterizer::SortFew(Bins& bins) const
{
  bins.begins.assign(static_cast<std::size_t>(this->Bands) + 1, 0);
  for (const BandedTriangle& banded : bins.few)
  {
    for (int band = banded.first; band <= banded.last; ++band)
    {
      ++bins.begins[band + 1];
    }
  }
  for (int band = 0; band < this->Bands; ++band)
  {
    bins.begins[band + 1] += bins.begins[band];
  }
  bins.items.resize(bins.begins.back());
  // From the last triangle to the first: the ends of bands sink to their begins.
  for (auto banded = bins.few.rbegin(); banded != bins.few.rend(); ++banded)
  {
    for (int band = banded->first; band <= banded->last; ++band)
    {
      bins.items[--bins.begins[band + 1]] = banded->triangle;
    }
  }
  bins.begins.erase(bins.begins.begin());
  bins.begins.push_back(static_cast<std::uint32_t>(bins.items.size()));
}

//------------------------------------------------------------------------------
void Rasterizer::Fill(int band, const Bins& bins) const
{
  const int firstRow = band * this->BandRows;
  const int endRow = std::min(firstRow + this->BandRows, this->Result.rows);
  for (std::uint32_t item = bins.begins[band]; item < bins.begins[band + 1]; ++item)
  {
    this->FillTriangle(bins.items[item], firstRow, endRow);
  }
  for (const BandedTriangle& banded : bins.many)
  {
    if (banded.first <= band && band <= banded.last)
    {
      this->FillTriangle(banded.triangle, firstRow, endRow);
    }
  }
}

//------------------------------------------------------------------------------
// Where the edges cross a row, and one sample more to either side; what lies in the triangle is
// decided for each sample.
Range Rasterizer::FindColumns(const Corners& corners, const Range& box, int row) const
{
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (int k = 0; k < 3; ++k)
  {
    const double* a = corners.p[k];
    const double* b = corners.p[(k + 1) % 3];
    if ((a[1] <= row && row <= b[1]) || (b[1] <= row && row <= a[1]))
    {
      const bool level = a[1] == b[1];
      const double x = level ? a[0] : a[0] + (row - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
      low = std::min(low, level ? std::min(a[0], b[0]) : x);
      high = std::max(high, level ? std::max(a[0], b[0]) : x);
    }
  }
  return Range(low - 1.0, high + 1.0, box.first, box.last + 1);
}

//------------------------------------------------------------------------------
void Rasterizer::FillTriangle(std::uint32_t triangle, int firstRow, int endRow) const
{
  Corners corners(this->Mesh, triangle);
  const double* const* p = corners.p;
  const double area = OrientedArea(p[0][0], p[0][1], p[1][0], p[1][1], p[2][0], p[2][1]);
  if (area == 0.0)
  {
    return;
  }
  if (area < 0.0)
  {
    std::swap(corners.p[1], corners.p[2]);
  }
  const Range box(corners.Least(0), corners.Most(0), 0, this->Result.columns);
  const Range rows(corners.Least(1), corners.Most(1), firstRow, endRow);
  const double least = corners.Least(2);
  const double most = corners.Most(2);
  const bool narrow = box.last - box.first < 3;
  const bool far =
    std::max(std::max(std::abs(corners.Least(0)), std::abs(corners.Most(0))),
      std::max(std::abs(corners.Least(1)), std::abs(corners.Most(1)))) > FarthestCrossing;
  for (int row = rows.first; row <= rows.last; ++row)
  {
    const Range columns = narrow || far ? box : this->FindColumns(corners, box, row);
    const std::size_t begin =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(this->Result.columns);
    for (int column = columns.first; column <= columns.last; ++column)
    {
      double w[3];
      const double sum = corners.Weights(column, row, w);
      if (!(w[0] >= 0.0 && w[1] >= 0.0 && w[2] >= 0.0 && sum > 0.0))
      {
        continue;
      }
      const double plane = (w[0] * p[0][2] + w[1] * p[1][2] + w[2] * p[2][2]) / sum;
      const double height = std::min(std::max(plane, least), most);
      double& highest = this->Result.heights[begin + static_cast<std::size_t>(column)];
      // So for NaN, too. Triangles come in their order within a bin, but not all of a band do.
      const bool higher = !(height <= highest);
      if (this->Result.triangles)
      {
        std::uint32_t& first = this->Result.triangles[begin + static_cast<std::size_t>(column)];
        first = higher || (height == highest && triangle < first) ? triangle : first;
      }
      highest = higher ? height : highest;
    }
  }
}
}

//------------------------------------------------------------------------------
TriangleCount FindTriangleHeights(const TriangleMesh& mesh, const ParallelFor& parallelFor,
  const std::function<bool(double)>& goOn, const TriangleHeights& result)
{
  TriangleCount count;
  const Rasterizer rasterizer(mesh, result);
  const auto forBands = [&](const std::function<void(int)>& body)
  {
    parallelFor(rasterizer.GetBands(),
      [&](int begin, int end)
      {
        for (int band = begin; band < end; ++band)
        {
          body(band);
        }
      });
  };
  forBands([&](int band) { rasterizer.Clear(band); });
  const std::size_t blocks = (mesh.triangles + BlockSize - 1) / BlockSize;
  std::vector<Bins> bins(std::min(blocks, BlocksAtOnce));
  for (std::size_t first = 0; first < blocks; first += BlocksAtOnce)
  {
    const std::size_t some = std::min(BlocksAtOnce, blocks - first);
    parallelFor(static_cast<int>(some),
      [&](int begin, int end)
      {
        for (int k = begin; k < end; ++k)
        {
          const std::size_t at = BlockSize * (first + static_cast<std::size_t>(k));
          rasterizer.Sort(at, std::min(at + BlockSize, mesh.triangles), bins[k]);
        }
      });
    std::size_t filled = 0;
    while (filled < some)
    {
      std::size_t end = filled;
      for (double work = 0.0; end < some && work < WorkAtOnce; ++end)
      {
        work += bins[end].work;
        count.leftOut += bins[end].leftOut;
      }
      forBands(
        [&](int band)
        {
          for (std::size_t k = filled; k < end; ++k)
          {
            rasterizer.Fill(band, bins[k]);
          }
        });
      filled = end;
      if (goOn && !goOn(static_cast<double>(first + filled) / static_cast<double>(blocks)))
      {
        return count;
      }
    }
  }
  count.whole = true;
  return count;
}

//------------------------------------------------------------------------------
void FindTriangleWeights(
  const TriangleMesh& mesh, std::uint32_t triangle, double x, double y, double weights[3])
{
  const double sum = Corners(mesh, triangle).Weights(x, y, weights);
  for (int k = 0; k < 3; ++k)
  {
    weights[k] = sum != 0.0 ? weights[k] / sum : 1.0 / 3.0;
  }
}

}
