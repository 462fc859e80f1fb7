// SPDX-License-Identifier: BSD-3-Clause
#include "ReliefGridTrace.h"

#include "PacketThickness.h"
#include "StepThickness.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>

namespace relief
{

namespace
{

constexpr int TileWidth = SweepThickness::TileWidth;
constexpr int TileHeight = SweepThickness::TileHeight;

// As many lanes as the widest vectors have, or a multiple.
constexpr int PacketWidth = SweepThickness::TileWidth;

// What a ray of a packet costs beside a sample that is swept. The farther its rays are apart, the
// less often they can be treated alike.
constexpr double PacketCost = 5.0;

// In samples swept, for each texel. A tile is swept whole, whatever is wanted of it.
double SweepCost(const ReliefGrid& grid)
{
  return std::min<double>(grid.stride[0], TileWidth) * std::min<double>(grid.stride[1], TileHeight);
}

double RowCost(const ReliefGrid& grid)
{
  return PacketCost * std::sqrt(std::min(grid.stride[0], 64.0));
}

bool IsSwept(
  const HeightField& field, const Scene& scene, const LightPlan& light, const ReliefGrid& grid)
{
  return scene.integrator == Integrator::Exact && scene.response != f64::RELIEF_IGOR &&
    field.GetMissingRow() && SweepThickness::Applies(scene.medium, light.light) &&
    SweepCost(grid) <= RowCost(grid);
}

}

//------------------------------------------------------------------------------
GridTrace::GridTrace(
  const HeightField& field, const Scene& scene, const LightPlan& light, const ReliefGrid& grid)
  : Heights(field)
  , Parameters(scene)
  , Source(light)
  , Grid(grid)
  , Medium(scene.medium)
  , ByTiles(IsSwept(field, scene, light, grid))
{
  this->Medium.tolerance *= light.light.toleranceScale;
  if (this->ByTiles)
  {
    this->Swept = std::make_unique<SweepThickness>(field, this->Medium, light.light);
  }
  const bool all = grid.stride[0] == 1.0 && grid.stride[1] == 1.0;
  this->ByTiles = this->ByTiles ||
    (all && scene.integrator == Integrator::Exact && scene.response != f64::RELIEF_IGOR);

  // Packets must have the same rays wherever the grid begins.
  const int samples = field.GetField().heights.columns;
  const int texels = static_cast<int>(std::ceil(samples / grid.stride[0])) - grid.first[0];
  int end = grid.size[0];
  if (!this->ByTiles)
  {
    this->First = grid.first[0] % PacketWidth;
    end = std::min(
      (grid.first[0] + end + PacketWidth - 1) / PacketWidth * PacketWidth - grid.first[0], texels);
  }
  for (int texel = -this->First; texel < end; ++texel)
  {
    this->Columns.push_back(grid.SampleOf(0, texel, samples));
  }
}

//------------------------------------------------------------------------------
int GridTrace::EndOfBand(const HeightField& field, const ReliefGrid& grid, int row)
{
  const int samples = field.GetField().heights.rows;
  while (row < grid.size[1] &&
    grid.SampleOf(1, row, samples) / TileHeight == grid.SampleOf(1, row - 1, samples) / TileHeight)
  {
    ++row;
  }
  return std::min(row, grid.size[1]);
}

//------------------------------------------------------------------------------
double GridTrace::EstimateWork(
  const HeightField& field, const Scene& scene, const LightPlan& light, const ReliefGrid& grid)
{
  return grid.GetNumberOfTexels() *
    (IsSwept(field, scene, light, grid) ? SweepCost(grid) : RowCost(grid));
}

//------------------------------------------------------------------------------
// Fills normals at the samples of a request, where points are sunk along them.
void GridTrace::FindNormals(RowRequest<float>& request, glm::vec3* normals) const
{
  const Field<float>& field = this->Heights.GetField();
  if (this->Medium.offset != f64::RELIEF_SURFACE_NORMAL)
  {
    return;
  }
  for (int k = 0; k < request.end - request.begin; ++k)
  {
    const int i = request.ColumnOf(k);
    const bool hasData = !std::isnan(field.heights.At(i, request.j));
    normals[k] = hasData ? f32::reliefNormal(field, i, request.j) : glm::vec3(0.0f);
  }
  request.normals = normals;
}

//------------------------------------------------------------------------------
// Fills d of a tile's samples that have data, as far as they are in the image.
void GridTrace::TraceTile(int tileColumn, int tileRow, float* d, RayCount& count) const
{
  if (this->Swept)
  {
    this->Swept->IlluminateTile(tileColumn, tileRow, d, nullptr, count);
    return;
  }
  const Field<float>& field = this->Heights.GetField();
  const int rows = std::min(TileHeight, field.heights.rows - tileRow * TileHeight);
  RowRequest<float> requests[TileHeight];
  glm::vec3 normals[SweepThickness::TileSize];
  for (int row = 0; row < rows; ++row)
  {
    RowRequest<float>& request = requests[row];
    request.j = tileRow * TileHeight + row;
    request.begin = tileColumn * TileWidth;
    request.end = std::min(request.begin + TileWidth, field.heights.columns);
    request.illumination = d + static_cast<std::ptrdiff_t>(row) * TileWidth;
    this->FindNormals(request, normals + static_cast<std::ptrdiff_t>(row) * TileWidth);
  }
  TracePacketTile(field, ToSingle(this->Medium), this->Source.light, requests, rows, count);
}

//------------------------------------------------------------------------------
// Fills the rows [first, last) of the grid, which lie in one row of tiles.
void GridTrace::TraceTiles(int first, int last, float* d, RayCount& count) const
{
  const HeightView<float>& heights = this->Heights.GetField().heights;
  const int* columns = this->Columns.data();
  const int width = this->Grid.size[0];
  const int tileRow = this->Grid.SampleOf(1, first, heights.rows) / TileHeight;
  alignas(TileWidth * sizeof(float)) float tile[SweepThickness::TileSize];
  for (int begin = 0, end = 0; begin < width; begin = end)
  {
    // A tile, and the columns that lie in it.
    const int tileColumn = columns[begin] / TileWidth;
    while (end < width && columns[end] / TileWidth == tileColumn)
    {
      ++end;
    }
    this->TraceTile(tileColumn, tileRow, tile, count);
    for (int row = first; row < last; ++row)
    {
      const int j = this->Grid.SampleOf(1, row, heights.rows);
      const float* from = tile + (j - tileRow * TileHeight) * TileWidth;
      float* to = d + static_cast<std::ptrdiff_t>(row - first) * width;
      for (int k = begin; k < end; ++k)
      {
        const int i = columns[k];
        to[k] = std::isnan(heights.At(i, j)) ? 0.0f : from[i - tileColumn * TileWidth];
      }
    }
  }
}

//------------------------------------------------------------------------------
// Fills a row of the grid, by packets or, point by point, by fixed steps.
void GridTrace::TraceRow(int row, float* d, RayCount& count) const
{
  if (this->Parameters.response == f64::RELIEF_IGOR)
  {
    return; // which no ray changes
  }
  const Field<float>& field = this->Heights.GetField();
  const f32::ReliefMedium medium = ToSingle(this->Medium);
  std::vector<float> illumination(this->Columns.size(), 0.0f);
  std::vector<glm::vec3> normals(this->Columns.size());
  RowRequest<float> request;
  request.j = this->Grid.SampleOf(1, row, field.heights.rows);
  request.end = static_cast<int>(this->Columns.size());
  request.columns = this->Columns.data();
  request.illumination = illumination.data();
  this->FindNormals(request, normals.data());
  if (this->Parameters.integrator == Integrator::FixedStep)
  {
    StepRow(field, medium, this->Source.light, this->Parameters.steps, request, count);
  }
  else
  {
    TracePackets(field, medium, this->Source.light, request, count);
  }
  std::copy_n(illumination.begin() + this->First, this->Grid.size[0], d);
}

//------------------------------------------------------------------------------
// Puts the surface's answer in the place of d.
void GridTrace::AnswerRow(int row, float* d) const
{
  const Field<float>& field = this->Heights.GetField();
  const f32::ReliefMedium medium = ToSingle(this->Medium);
  const Light& light = this->Source.light;
  const int j = this->Grid.SampleOf(1, row, field.heights.rows);
  for (int k = 0; k < this->Grid.size[0]; ++k)
  {
    const int i = this->Columns[this->First + k];
    if (std::isnan(field.heights.At(i, j)))
    {
      d[k] = 0.0f;
      continue;
    }
    const glm::vec3 n = f32::reliefNormal(field, i, j);
    glm::vec3 l = this->Source.vector;
    if (light.positional)
    {
      f32::reliefRay(field, medium, i, j, n, LightFrom<float>(light, field.heights, i, j), true, l);
    }
    d[k] = f32::reliefResponse(this->Parameters.response, d[k], n, l);
  }
}

//------------------------------------------------------------------------------
void GridTrace::Trace(
  int begin, int end, float* d, const ParallelFor& parallelFor, RayCount& count) const
{
  // What is traced as a whole: a row of the grid, or those in a row of tiles.
  std::vector<int> parts{ begin };
  while (parts.back() < end)
  {
    const int next = parts.back() + 1;
    parts.push_back(
      this->ByTiles ? std::min(EndOfBand(this->Heights, this->Grid, next), end) : next);
  }
  const bool answers = this->Parameters.response != f64::RELIEF_ILLUMINATION;
  std::atomic<std::uint64_t> rays{ 0 };
  std::atomic<std::uint64_t> cells{ 0 };
  parallelFor(static_cast<int>(parts.size()) - 1,
    [&](int from, int to)
    {
      RayCount work;
      for (int k = from; k < to; ++k)
      {
        float* row = d + static_cast<std::size_t>(parts[k] - begin) * this->Grid.size[0];
        if (this->ByTiles)
        {
          this->TraceTiles(parts[k], parts[k + 1], row, work);
        }
        else
        {
          this->TraceRow(parts[k], row, work);
        }
        for (int answered = parts[k]; answers && answered < parts[k + 1]; ++answered)
        {
          this->AnswerRow(
            answered, row + static_cast<std::size_t>(answered - parts[k]) * this->Grid.size[0]);
        }
      }
      rays += work.rays;
      cells += work.cells;
    });
  count.rays += rays;
  count.cells += cells;
}

//------------------------------------------------------------------------------
bool IsSoftwareRenderer(const std::string& renderer)
{
  std::string name = renderer;
  std::transform(name.begin(), name.end(), name.begin(),
    [](unsigned char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
  // Mesa's, Google's, Microsoft's and Apple's.
  const char* const known[] = { "llvmpipe", "softpipe", "swrast", "swr ", "software", "swiftshader",
    "mesa x11", "basic render", "gdi generic" };
  return std::any_of(std::begin(known), std::end(known),
    [&name](const char* part) { return name.find(part) != std::string::npos; });
}

}
