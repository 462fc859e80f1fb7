// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What heights.js calls: heights of meshes and of normals, in a module of its own. Everything that
/// is given was checked there, and stays where it is until the run ends. Texts are UTF-8 and end
/// with 0; an empty one says that all is well.

#include "WebMemory.h"
#include "WebMesh.h"
#include "WebNormals.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace relief;
using namespace relief::web;

/// What is told of heights that were found, as heights.js numbers it.
enum Number
{
  Columns,
  Rows,
  SpacingX,
  SpacingY,
  FirstX, ///< of the southern, western sample
  FirstY,
  Triangles,
  Degenerate,
  NotFinite,
  Green, ///< as GreenAxis has it
  GreenKnown,
  Parts,
  Iterations,
  Converged,
  Encoding, ///< as NormalEncoding has it
  NumberOfNumbers
};

struct Run
{
  WebMesh mesh;
  double direction[3] = { 0.0, 0.0, 1.0 };
  double up[3] = { 0.0, 1.0, 0.0 };
  WebNormals normals;
  std::vector<double> heights;
  double numbers[NumberOfNumbers] = {};
  std::string wrong;
};

std::unique_ptr<Run> TheRun;

template <class T>
void TakePoints(const T* points, std::size_t count, std::vector<double>& to)
{
  to.assign(points, points + 3 * count);
}

}

RELIEF_EXPORT void reliefBegin()
{
  EndWithoutMemory();
  TheRun = std::make_unique<Run>();
}

RELIEF_EXPORT void reliefEnd()
{
  TheRun.reset();
}

// A mesh by the text of an OBJ. Returns what is wrong.
RELIEF_EXPORT const char* reliefMeshText(const char* text, std::size_t length)
{
  TheRun->wrong = TheRun->mesh.ReadObj(text, length);
  return TheRun->wrong.c_str();
}

// Points of a mesh, x, y and z of each, in double precision or in single.
RELIEF_EXPORT void reliefMeshPoints(const void* points, int isDouble, std::size_t count)
{
  std::vector<double>& to = TheRun->mesh.points;
  isDouble ? TakePoints(static_cast<const double*>(points), count, to)
           : TakePoints(static_cast<const float*>(points), count, to);
}

// Triangles between them.
RELIEF_EXPORT void reliefMeshTriangles(const std::uint32_t* corners, std::size_t triangles)
{
  WebMesh& mesh = TheRun->mesh;
  mesh.corners.assign(corners, corners + 3 * triangles);
  mesh.ends.resize(triangles);
  for (std::size_t k = 0; k < triangles; ++k)
  {
    mesh.ends[k] = static_cast<std::uint32_t>(3 * (k + 1));
  }
}

// From where the mesh is seen, and what is up.
RELIEF_EXPORT void reliefMeshView(double x, double y, double z, double upX, double upY, double upZ)
{
  const double view[6] = { x, y, z, upX, upY, upZ };
  std::copy_n(view, 3, TheRun->direction);
  std::copy_n(view + 3, 3, TheRun->up);
}

// Finds the heights of the mesh, so many samples along its longer side. Returns what is wrong.
RELIEF_EXPORT const char* reliefMeshHeights(int resolution)
{
  FrameRequest request;
  request.resolution = resolution;
  MeshHeights found;
  TheRun->wrong =
    FindMeshHeights(std::move(TheRun->mesh), TheRun->direction, TheRun->up, request, found);
  double* numbers = TheRun->numbers;
  numbers[Columns] = found.frame.columns;
  numbers[Rows] = found.frame.rows;
  numbers[SpacingX] = found.frame.spacing[0];
  numbers[SpacingY] = found.frame.spacing[1];
  numbers[FirstX] = found.frame.first[0];
  numbers[FirstY] = found.frame.first[1];
  numbers[Triangles] = static_cast<double>(found.triangles);
  numbers[Degenerate] = static_cast<double>(found.degenerate);
  numbers[NotFinite] = static_cast<double>(found.notFinite);
  TheRun->heights = std::move(found.heights);
  return TheRun->wrong.c_str();
}

RELIEF_EXPORT void reliefNormals(const void* samples, int type, int components, int columns,
  int rows, double spacingX, double spacingY)
{
  WebNormals& normals = TheRun->normals;
  normals.samples = samples;
  normals.type = static_cast<NormalType>(type);
  normals.components = components;
  normals.columns = columns;
  normals.rows = rows;
  normals.spacing[0] = spacingX;
  normals.spacing[1] = spacingY;
}

RELIEF_EXPORT void reliefNormalMask(const unsigned char* mask)
{
  TheRun->normals.mask = mask;
}

// Finds the heights of the normals; encoding, green and method as NormalEncoding, GreenAxis and
// NormalMethod number them. Returns what is wrong.
RELIEF_EXPORT const char* reliefNormalHeights(int encoding, int green, int method)
{
  Run& run = *TheRun;
  run.normals.encoding = static_cast<NormalEncoding>(encoding);
  NormalRequest request;
  request.green = static_cast<GreenAxis>(green);
  request.method = static_cast<NormalMethod>(method);
  NormalHeights found;
  NormalEncoding used = NormalEncoding::Automatic;
  run.wrong = FindHeights(run.normals, request, found, used);
  run.numbers[Columns] = run.normals.columns;
  run.numbers[Rows] = run.normals.rows;
  run.numbers[SpacingX] = run.normals.spacing[0];
  run.numbers[SpacingY] = run.normals.spacing[1];
  run.numbers[Green] = static_cast<double>(found.green);
  run.numbers[GreenKnown] = found.greenKnown ? 1.0 : 0.0;
  run.numbers[Parts] = found.parts;
  run.numbers[Iterations] = found.end.iterations;
  run.numbers[Converged] = found.end.converged ? 1.0 : 0.0;
  run.numbers[Encoding] = static_cast<double>(used);
  run.heights = std::move(found.heights);
  return run.wrong.c_str();
}

// Rows from south to north.
RELIEF_EXPORT const double* reliefHeights()
{
  return TheRun->heights.data();
}

RELIEF_EXPORT double reliefNumber(int number)
{
  return TheRun->numbers[number];
}
