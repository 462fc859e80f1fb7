// SPDX-License-Identifier: BSD-3-Clause
#include "WebMesh.h"

#include "ObjText.h"
#include "PolygonCutter.h"

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace relief::web
{

namespace
{
// Of heights in double precision there is room for these in the addresses of WebAssembly.
constexpr double MostSamples = 268435456.0;

void Serial(int count, const std::function<void(int, int)>& body)
{
  body(0, count);
}

// Numbers as VTK's reader has them, in single precision.
class MeshText : public io::ObjText
{
public:
  MeshText(const char* text, std::size_t length, WebMesh& mesh)
    : At(text)
    , End(text + length)
    , Mesh(mesh)
  {
  }

private:
  bool NextLine(std::string& line) override
  {
    if (this->At == this->End)
    {
      return false;
    }
    const std::size_t rest = static_cast<std::size_t>(this->End - this->At);
    const void* found = std::memchr(this->At, '\n', rest);
    const char* end = found ? static_cast<const char*>(found) : this->End;
    line.assign(this->At, end);
    this->At = found ? end + 1 : end;
    return true;
  }

  // There is no other language's setting here that strtof could follow.
  bool TakeNumber(Kind kind, const char* begin, const char*, bool) override
  {
    const float value = std::strtof(begin, nullptr);
    if (kind == Points && std::isfinite(value))
    {
      this->Mesh.points.push_back(value);
    }
    return std::isfinite(value);
  }

  void TakeFace(const std::vector<std::uint64_t>& corners) override
  {
    for (const std::uint64_t corner : corners)
    {
      this->Mesh.corners.push_back(static_cast<std::uint32_t>(corner));
    }
    this->Mesh.ends.push_back(static_cast<std::uint32_t>(this->Mesh.corners.size()));
  }

  const char* At;
  const char* End;
  WebMesh& Mesh;
};

//------------------------------------------------------------------------------
void Gather(const WebMesh& mesh, const ViewAxes& view, MeshTriangles& triangles)
{
  const std::size_t count = mesh.points.size() / 3;
  PointBounds bounds;
  for (std::size_t i = 0; i < count; ++i)
  {
    if (IsUsablePoint(mesh.points.data() + 3 * i))
    {
      bounds.Add(mesh.points.data() + 3 * i);
    }
  }
  double center[3];
  FindMeshCenter(bounds, center);
  triangles.view = view;
  view.Transform(center, triangles.center);
  triangles.points.resize(mesh.points.size());
  for (std::size_t i = 0; i < count; ++i)
  {
    PlacePoint(mesh.points.data() + 3 * i, view, center, triangles.points.data() + 3 * i);
  }
  triangles.corners.reserve(mesh.corners.size());
  PolygonCutter cutter(triangles, 0, count, false);
  std::size_t begin = 0;
  for (const std::uint32_t end : mesh.ends)
  {
    cutter.CutPolygon(0, mesh.corners.data() + begin, end - begin);
    begin = end;
  }
  FindTriangleBounds(triangles, Serial);
}
}

//------------------------------------------------------------------------------
std::string WebMesh::ReadObj(const char* text, std::size_t length)
{
  const std::string wrong = MeshText(text, length, *this).Read();
  return wrong.empty() && this->ends.empty()
    ? "it has no polygons: " + std::to_string(this->points.size() / 3) + " points"
    : wrong;
}

//------------------------------------------------------------------------------
std::string FindMeshHeights(WebMesh&& mesh, const double direction[3], const double up[3],
  const FrameRequest& request, MeshHeights& result)
{
  MeshTriangles triangles;
  Gather(mesh, MakeViewAxes(direction, up), triangles);
  const std::size_t points = mesh.points.size() / 3;
  mesh = WebMesh();
  result.triangles = triangles.corners.size() / 3;
  result.degenerate = triangles.degenerate;
  result.notFinite = triangles.notFinite;
  if (result.triangles == 0)
  {
    return "there are no triangles to look at among " + std::to_string(points) + " points, " +
      std::to_string(result.notFinite) + " triangles not finite and " +
      std::to_string(result.degenerate) + " without area";
  }
  FrameRequest fitted = request;
  std::copy_n(triangles.bounds, 4, fitted.bounds);
  const std::string wrong = FitHeightFrame(fitted, result.frame);
  if (!wrong.empty())
  {
    return wrong;
  }
  const double samples = 1.0 * result.frame.columns * result.frame.rows;
  if (samples > MostSamples)
  {
    return std::to_string(result.frame.columns) + " x " + std::to_string(result.frame.rows) +
      " samples are asked for, at most 2^28 are possible here: lower the resolution";
  }
  MoveToSamples(triangles, result.frame, Serial);
  result.heights.resize(
    static_cast<std::size_t>(result.frame.columns) * static_cast<std::size_t>(result.frame.rows));
  FindTriangleHeights(triangles.GetMesh(), Serial, {},
    { result.frame.columns, result.frame.rows, result.heights.data(), nullptr });
  bool any = false;
  for (double& height : result.heights)
  {
    any = any || !std::isnan(height);
    height += triangles.center[2];
  }
  result.frame.first[0] += triangles.center[0];
  result.frame.first[1] += triangles.center[1];
  return any ? "" : "no sample hits a triangle: look from another direction, or more finely";
}

}
