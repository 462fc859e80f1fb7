// SPDX-License-Identifier: BSD-3-Clause
// vtkDepthToHeightField on meshes: heights against every triangle of the mesh in long double,
// frames, directions, kinds of cells, what comes with heights.
#include "vtkDepthToHeightField.h"

#include "vtkCellData.h"
#include "vtkCleanPolyData.h"
#include "vtkConeSource.h"
#include "vtkDataArray.h"
#include "vtkImageReliefShading.h"
#include "vtkMath.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkParametricFunctionSource.h"
#include "vtkParametricTorus.h"
#include "vtkSMPTools.h"
#include "vtkSphereSource.h"
#include "vtkSuperquadricSource.h"
#include "vtkTriangleFilter.h"
#include "vtkUnsignedCharArray.h"

#include "HeightTestMeshes.h"

#include <cstdlib>
#include <random>
#include <string>

namespace
{
int Failures = 0;

vtkSmartPointer<vtkPolyData> Triangulated(vtkAlgorithm* source)
{
  // At poles sources have triangles without area.
  vtkNew<vtkCleanPolyData> clean;
  clean->SetInputConnection(source->GetOutputPort());
  clean->SetTolerance(1e-6);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(clean->GetOutputPort());
  triangles->PassLinesOff();
  triangles->PassVertsOff();
  triangles->Update();
  return triangles->GetOutput();
}

std::vector<vtkSmartPointer<vtkPolyData>> MakeShapes()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(24);
  sphere->SetPhiResolution(16);
  vtkNew<vtkConeSource> cone;
  cone->SetResolution(37);
  cone->SetDirection(0.3, -0.2, 1.0);
  vtkNew<vtkParametricTorus> torus;
  vtkNew<vtkParametricFunctionSource> ring;
  ring->SetParametricFunction(torus);
  ring->SetUResolution(30);
  ring->SetVResolution(20);
  vtkNew<vtkSuperquadricSource> superquadric;
  superquadric->ToroidalOn();
  superquadric->SetThetaResolution(32);
  superquadric->SetPhiResolution(24);
  return { Triangulated(sphere), Triangulated(cone), Triangulated(ring),
    Triangulated(superquadric) };
}

// The same mesh with other points.
template <class Change>
vtkSmartPointer<vtkPolyData> Moved(vtkPolyData* mesh, const Change& change)
{
  auto moved = vtkSmartPointer<vtkPolyData>::New();
  moved->ShallowCopy(mesh);
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (vtkIdType i = 0; i < mesh->GetNumberOfPoints(); ++i)
  {
    double point[3];
    mesh->GetPoint(i, point);
    change(point);
    points->InsertNextPoint(point);
  }
  moved->SetPoints(points);
  moved->GetPointData()->Initialize();
  return moved;
}

// An image in double with a mesh that is looked at.
vtkSmartPointer<vtkDepthToHeightField> MakeFilter(vtkDataObject* input, int resolution)
{
  auto filter = vtkSmartPointer<vtkDepthToHeightField>::New();
  filter->SetInputDataObject(0, input);
  filter->SetResolution(resolution);
  filter->SetOutputScalarTypeToDouble();
  return filter;
}

//------------------------------------------------------------------------------
void TestShapes()
{
  const double directions[][3] = { { 0.0, 0.0, 1.0 }, { 0.0, 1.0, 0.0 }, { -1.0, 0.0, 0.0 },
    { 1.0, 2.0, 3.0 }, { 1e-3, -5e4, 20.0 } };
  for (const auto& shape : MakeShapes())
  {
    for (const double* direction : directions)
    {
      const auto filter = MakeFilter(shape, 50);
      filter->SetViewDirection(direction);
      filter->Update();
      int hit = 0;
      CHECK(CountWrong(filter, shape, 1e-9 * shape->GetLength(), &hit) == 0);
      CHECK(hit > 200);
      // The direction and right-handed axes.
      const double* axes = filter->GetViewAxes();
      double cross[3];
      vtkMath::Cross(axes, axes + 3, cross);
      double unit[3] = { direction[0], direction[1], direction[2] };
      vtkMath::Normalize(unit);
      for (int k = 0; k < 3; ++k)
      {
        CHECK_NEAR(cross[k], axes[6 + k], 1e-12);
        CHECK_NEAR(unit[k], axes[6 + k], 1e-12);
      }
      // The highest sample is that of the output, as float too.
      double range[2];
      filter->GetOutput()->GetPointData()->GetScalars()->GetFiniteRange(range);
      CHECK(range[0] == filter->GetLowestHeight() && range[1] == filter->GetHighestHeight());
      filter->SetOutputScalarTypeToFloat();
      filter->Update();
      CHECK(filter->GetOutput()->GetScalarType() == VTK_FLOAT);
      CHECK(CountWrong(filter, shape, 1e-6 * shape->GetLength()) == 0);
    }
  }
}

//------------------------------------------------------------------------------
// A mesh that is turned, looked at from a direction that is turned.
void TestTurned()
{
  const auto shape = MakeShapes()[3];
  const double angle = 0.7;
  const double turn[3][3] = { { std::cos(angle), 0.0, std::sin(angle) }, { 0.0, 1.0, 0.0 },
    { -std::sin(angle), 0.0, std::cos(angle) } };
  const auto turned =
    Moved(shape, [&turn](double* point) { vtkMath::Multiply3x3(turn, point, point); });
  const auto straight = MakeFilter(shape, 80);
  const auto other = MakeFilter(turned, 80);
  other->SetViewDirection(turn[0][2], turn[1][2], turn[2][2]);
  straight->Update();
  other->Update();
  vtkImageData* a = straight->GetOutput();
  vtkImageData* b = other->GetOutput();
  CHECK(a->GetDimensions()[0] == b->GetDimensions()[0]);
  CHECK(a->GetDimensions()[1] == b->GetDimensions()[1]);
  int differ = 0;
  for (vtkIdType i = 0; i < std::min(a->GetNumberOfPoints(), b->GetNumberOfPoints()); ++i)
  {
    const double x = a->GetPointData()->GetScalars()->GetComponent(i, 0);
    const double y = b->GetPointData()->GetScalars()->GetComponent(i, 0);
    differ += std::isnan(x) != std::isnan(y) || std::abs(x - y) > 1e-9 ? 1 : 0;
  }
  CHECK(differ == 0);
  // Up turns the image by quarters: what was right is down.
  straight->SetViewUp(1.0, 0.0, 0.0);
  straight->Update();
  CHECK(CountWrong(straight, shape, 1e-9) == 0);
  CHECK_NEAR(straight->GetViewAxes()[1], -1.0, 1e-15);
  // Up along the view does not count.
  straight->SetViewDirection(0.0, 5.0, 0.0);
  straight->SetViewUp(0.0, 1.0, 0.0);
  straight->Update();
  CHECK(straight->GetViewAxes()[5] == -1.0 && straight->GetViewAxes()[0] == 1.0);
  straight->SetViewDirection(0.0, -5.0, 0.0);
  straight->Update();
  CHECK(straight->GetViewAxes()[5] == 1.0 && straight->GetViewAxes()[0] == 1.0);
  straight->SetViewDirection(5.0, 0.0, 0.0);
  straight->SetViewUp(1.0, 0.0, 0.0);
  straight->Update();
  CHECK(straight->GetViewAxes()[4] == 1.0);
}

//------------------------------------------------------------------------------
// Far from the origin, digits are kept, and all lies where it is.
void TestFarAway()
{
  const double place[3] = { 500000.0, 5400000.0, 300.0 };
  for (const auto& shape : MakeShapes())
  {
    const auto far = Moved(shape, [&place](double* point) { vtkMath::Add(point, place, point); });
    for (const bool slanted : { false, true })
    {
      const auto filter = MakeFilter(far, 60);
      filter->SetViewDirection(slanted ? 0.2 : 0.0, slanted ? -0.3 : 0.0, 1.0);
      MessageKeeper messages(filter);
      filter->Update();
      // The grid's own place has the digits of doubles.
      CHECK(CountWrong(filter, far, 2e-8) <= (slanted ? 2 : 0));
      CHECK(messages.Silent());
      if (!slanted)
      {
        CHECK(std::abs(filter->GetOutput()->GetOrigin()[0] - 500000.0) < 10.0);
        CHECK(std::abs(filter->GetLowestHeight() - 300.0) < 10.0);
      }
    }
    // Looked at along y heights are in the millions, for which float has no digits.
    const auto filter = MakeFilter(far, 60);
    filter->SetViewDirection(0.0, 1.0, 0.0);
    filter->SetOutputScalarTypeToFloat();
    MessageKeeper messages(filter);
    filter->Update();
    CHECK(messages.OneWarning("SetOutputScalarTypeToDouble()"));
    filter->SetNormalizeToFromLowest();
    filter->Update();
    CHECK(messages.Silent());
    CHECK(filter->GetOutput()->GetScalarRange()[0] == 0.0);
  }
}

//------------------------------------------------------------------------------
// Frames, dimensions, margins; heights in units.
void TestFrames()
{
  // A slope over x from 0 to 8, y from 0 to 4, whose corners lie on samples.
  const auto slope = MakeMesh({ 0, 0, 1, 8, 0, 5, 8, 4, 5, 0, 4, 1 }, { { 0, 1, 2 }, { 0, 2, 3 } });
  const auto filter = MakeFilter(slope, 100);
  filter->SetDimensions(16, 8);
  filter->SetFrame(-0.25, 15.75, -0.25, 3.75);
  filter->Update();
  vtkImageData* image = filter->GetOutput();
  CHECK(image->GetDimensions()[0] == 16 && image->GetDimensions()[1] == 8);
  CHECK(image->GetOrigin()[0] == 0.25 && image->GetOrigin()[1] == 0.0);
  CHECK(image->GetSpacing()[0] == 1.0 && image->GetSpacing()[1] == 0.5);
  for (int i = 0; i < 16; ++i)
  {
    const double height = image->GetScalarComponentAsDouble(i, 0, 0, 0);
    CHECK(i < 8 ? height == 1.0 + 0.5 * (0.25 + i) : std::isnan(height));
  }
  // Samples on corners and edges are hit.
  filter->SetFrame(-0.5, 8.5, -0.5, 4.5);
  filter->SetDimensions(9, 5);
  filter->Update();
  for (int i = 0; i < 45; ++i)
  {
    CHECK(
      filter->GetOutput()->GetScalarComponentAsDouble(i % 9, i / 9, 0, 0) == 1.0 + 0.5 * (i % 9));
  }
  // Resolution along the longer side of a frame, whose cells nearly are squares.
  filter->SetDimensions(0, 0);
  filter->SetFrame(0.0, 8.0, 0.0, 3.99);
  filter->Update();
  CHECK(filter->GetOutput()->GetDimensions()[0] == 100);
  CHECK(filter->GetOutput()->GetDimensions()[1] == 50);
  // Around the bounds.
  filter->SetFrame(0.0, 0.0, 0.0, 0.0);
  filter->SetMargin(0.125);
  filter->Update();
  image = filter->GetOutput();
  CHECK(image->GetDimensions()[0] == 100 && image->GetDimensions()[1] == 60);
  CHECK_NEAR(image->GetSpacing()[0], 0.1, 1e-15);
  CHECK(image->GetSpacing()[0] == image->GetSpacing()[1]);
  CHECK_NEAR(image->GetOrigin()[0], -0.95, 1e-14);
  CHECK_NEAR(image->GetOrigin()[1], -0.95, 1e-14);
  // In the middle of dimensions of another shape.
  filter->SetDimensions(50, 50);
  filter->Update();
  CHECK_NEAR(filter->GetOutput()->GetSpacing()[1], 0.2, 1e-15);
  CHECK_NEAR(filter->GetOutput()->GetOrigin()[1], -2.9, 1e-14);
  filter->SetNormalizeToUnitRange();
  filter->Update();
  CHECK(filter->GetOutput()->GetScalarRange()[0] == 0.0);
  CHECK(filter->GetOutput()->GetScalarRange()[1] == 1.0);
  const double from = filter->GetLowestHeight();
  CHECK(from > 1.0 && from < 1.2);
  filter->SetNormalizeToFromLowest();
  filter->Update();
  CHECK_NEAR(filter->GetOutput()->GetScalarRange()[1], filter->GetHighestHeight() - from, 1e-15);
  // All at one height.
  const auto flat = MakeMesh({ 0, 0, 7, 1, 0, 7, 0, 1, 7 }, { { 0, 1, 2 } });
  filter->SetInputDataObject(0, flat);
  filter->SetNormalizeToUnitRange();
  filter->Update();
  CHECK(filter->GetOutput()->GetScalarRange()[0] == 0.0);
  CHECK(filter->GetOutput()->GetScalarRange()[1] == 0.0 && filter->GetLowestHeight() == 7.0);
}

//------------------------------------------------------------------------------
bool SameHeights(vtkImageData* a, vtkImageData* b)
{
  return LargestDifference(a->GetPointData()->GetScalars(), b->GetPointData()->GetScalars()) <
    1e-12;
}

// Quads, strips, concave polygons and triangles of the same surface.
void TestCells()
{
  const std::vector<double> corners = { 0, 0, 0, 1, 0, 1, 2, 0, 2, 0, 1, 1, 1, 1, 2, 2, 1, 3 };
  const auto triangles = MakeMesh(corners, { { 0, 1, 4 }, { 0, 4, 3 }, { 1, 2, 5 }, { 1, 5, 4 } });
  const auto quads = MakeMesh(corners, { { 0, 1, 4, 3 }, { 5, 4, 1, 2 } });
  const auto strip = MakeMesh(corners, {}, { { 0, 3, 1, 4, 2, 5 } });
  const auto polygon = MakeMesh(corners, { { 0, 1, 2, 5, 4, 3 } });
  const auto expected = MakeFilter(triangles, 64);
  expected->Update();
  for (vtkPolyData* mesh : { quads.Get(), strip.Get(), polygon.Get() })
  {
    const auto filter = MakeFilter(mesh, 64);
    MessageKeeper messages(filter);
    filter->Update();
    CHECK(SameHeights(expected->GetOutput(), filter->GetOutput()));
    CHECK(messages.Silent() && filter->GetNumberOfTriangles() == 4);
  }
  // An arrow head of four corners, begun at each and turned either way; a star of ten corners.
  for (int begin = 0; begin < 4; ++begin)
  {
    for (const int step : { 1, 3 })
    {
      std::vector<vtkIdType> ids;
      for (int k = 0; k < 4; ++k)
      {
        ids.push_back((begin + step * k) % 4);
      }
      const auto head = MakeMesh({ 0, 0, 0, 4, 2, 0, 0, 4, 0, 1, 2, 0 }, { ids });
      const auto filter = MakeFilter(head, 10);
      filter->SetFrame(-0.5, 4.5, -0.5, 4.5);
      filter->SetDimensions(5, 5);
      filter->Update();
      const auto at = [&](int i, int j)
      { return filter->GetOutput()->GetScalarComponentAsDouble(i, j, 0, 0); };
      CHECK(std::isnan(at(0, 2)) && at(1, 2) == 0.0 && at(3, 2) == 0.0 && at(0, 0) == 0.0);
      CHECK(at(0, 4) == 0.0 && at(1, 1) == 0.0 && std::isnan(at(3, 1)));
    }
  }
  std::vector<double> star;
  std::vector<vtkIdType> around;
  for (int k = 0; k < 10; ++k)
  {
    const double radius = k % 2 == 0 ? 10.0 : 3.0;
    const double angle = vtkMath::Pi() * k / 5.0;
    star.insert(star.end(), { radius * std::cos(angle), radius * std::sin(angle), 2.0 });
    around.push_back(k);
  }
  const auto filter = MakeFilter(MakeMesh(star, { around }), 200);
  filter->Update();
  CHECK(filter->GetNumberOfTriangles() == 8);
  vtkImageData* image = filter->GetOutput();
  double area = 0.0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const double* x = image->GetPoint(i);
    const double height = image->GetPointData()->GetScalars()->GetComponent(i, 0);
    const double radius = std::hypot(x[0], x[1]);
    CHECK(radius > 2.5 || height == 2.0);
    CHECK(radius < 10.0 || std::isnan(height));
    area += std::isnan(height) ? 0.0 : image->GetSpacing()[0] * image->GetSpacing()[1];
  }
  CHECK_NEAR(area, 5.0 * 10.0 * 3.0 * std::sin(vtkMath::Pi() / 5.0), 1.0);
}

//------------------------------------------------------------------------------
// Random triangles that cross one another, turned either way.
void TestSoup(unsigned int seed)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  for (int n = 0; n < 10; ++n)
  {
    const double scale = std::pow(10.0, 3.0 * place(random));
    std::vector<double> points;
    std::vector<std::vector<vtkIdType>> triangles;
    for (vtkIdType t = 0; t < 60; ++t)
    {
      const double center[3] = { place(random), place(random), place(random) };
      const double size = t % 3 == 0 ? 0.02 : 0.4;
      for (int k = 0; k < 9; ++k)
      {
        points.push_back(scale * (center[k % 3] + size * place(random)));
      }
      triangles.push_back({ 3 * t, 3 * t + 1, 3 * t + 2 });
    }
    const auto mesh = MakeMesh(points, triangles);
    const auto filter = MakeFilter(mesh, 70);
    filter->SetViewDirection(place(random), place(random), place(random));
    filter->SetViewUp(place(random), place(random), place(random));
    filter->Update();
    CHECK(CountWrong(filter, mesh, 1e-9 * scale) == 0);
  }
}

//------------------------------------------------------------------------------
void TestThreads()
{
  const auto shapes = MakeShapes();
  const auto filter = MakeFilter(shapes[2], 300);
  filter->SetViewDirection(1.0, 2.0, 4.0);
  filter->GenerateMaskOn();
  filter->GenerateNormalsOn();
  filter->Update();
  vtkNew<vtkImageData> many;
  many->DeepCopy(filter->GetOutput());
  vtkSMPTools::Initialize(1);
  filter->Modified();
  filter->Update();
  vtkSMPTools::Initialize(0);
  for (const char* name : { "Height", "Mask", "Normals" })
  {
    CHECK(SameBytes(
      many->GetPointData()->GetArray(name), filter->GetOutput()->GetPointData()->GetArray(name)));
  }
}

//------------------------------------------------------------------------------
void TestMaskAndNormals()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetRadius(2.0);
  sphere->SetThetaResolution(60);
  sphere->SetPhiResolution(60);
  sphere->Update();
  for (const bool smooth : { true, false })
  {
    vtkNew<vtkPolyData> mesh;
    mesh->ShallowCopy(sphere->GetOutput());
    if (!smooth)
    {
      mesh->GetPointData()->Initialize();
    }
    const auto filter = MakeFilter(mesh, 90);
    filter->SetViewDirection(1.0, 1.0, 1.0);
    filter->SetFrame(-2.1, 2.1, -1.5, 2.7);
    filter->SetDimensions(90, 70); // oblong
    filter->GenerateMaskOn();
    filter->GenerateNormalsOn();
    filter->GenerateColorsOn(); // but it has none
    filter->Update();
    vtkImageData* image = filter->GetOutput();
    CHECK(!image->GetPointData()->GetArray("Color"));
    vtkDataArray* normals = image->GetPointData()->GetArray("Normals");
    vtkDataArray* mask = image->GetPointData()->GetArray("Mask");
    CHECK(normals->GetDataType() == VTK_FLOAT && mask->GetDataType() == VTK_UNSIGNED_CHAR);
    CHECK(image->GetPointData()->GetScalars()->GetName() == std::string("Height"));
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      double point[3];
      image->GetPoint(i, point);
      point[2] = image->GetPointData()->GetScalars()->GetComponent(i, 0);
      const double* normal = normals->GetTuple3(i);
      CHECK(mask->GetComponent(i, 0) == (std::isnan(point[2]) ? 0.0 : 1.0));
      if (std::isnan(point[2]))
      {
        CHECK(normal[0] == 0.0 && normal[1] == 0.0 && normal[2] == 0.0);
        continue;
      }
      CHECK_NEAR(vtkMath::Norm(normal), 1.0, 1e-6);
      // On a sphere it is where the point is.
      CHECK_NEAR(vtkMath::Dot(normal, point) / 2.0, 1.0, 0.01);
    }
  }
  // Both sides of a plane are seen from where they are seen.
  const auto plane = MakeMesh({ 0, 0, 0, 4, 0, 4, 0, 4, 0 }, { { 0, 1, 2 } });
  for (const double side : { 1.0, -1.0 })
  {
    const auto filter = MakeFilter(plane, 20);
    filter->SetViewDirection(0.0, 0.0, side);
    filter->GenerateNormalsOn();
    filter->Update();
    vtkDataArray* normals = filter->GetOutput()->GetPointData()->GetArray("Normals");
    CHECK_NEAR(normals->GetRange(2)[1], std::sqrt(0.5), 1e-6);
    CHECK_NEAR(normals->GetRange(0)[0], -std::sqrt(0.5), 1e-6);
  }
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkUnsignedCharArray> MakeColors(
  int components, const std::vector<std::vector<int>>& colors)
{
  auto array = vtkSmartPointer<vtkUnsignedCharArray>::New();
  array->SetName("paint");
  array->SetNumberOfComponents(components);
  for (const auto& color : colors)
  {
    for (const int value : color)
    {
      array->InsertNextValue(static_cast<unsigned char>(value));
    }
  }
  return array;
}

// One triangle with colors of points beside one with a color of its own, and one with none.
void TestColors()
{
  const auto ofPoints = MakeMesh({ 0, 0, 0, 10, 0, 0, 0, 10, 0 }, { { 0, 1, 2 } });
  ofPoints->GetPointData()->SetScalars(
    MakeColors(3, { { 0, 100, 7 }, { 200, 100, 7 }, { 0, 0, 7 } }));
  const auto ofCells = MakeMesh({ 20, 0, 0, 30, 0, 0, 20, 10, 0, 30, 10, 0 }, { { 0, 1, 3, 2 } });
  vtkNew<vtkCellArray> vertex; // whose color comes before that of polygons
  vertex->InsertNextCell({ 0 });
  ofCells->SetVerts(vertex);
  ofCells->GetCellData()->SetScalars(MakeColors(4, { { 1, 1, 1, 1 }, { 9, 8, 7, 60 } }));
  const auto plain = MakeMesh({ 40, 0, 0, 50, 0, 0, 40, 10, 0 }, { { 0, 1, 2 } });
  const auto filter = MakeFilter(ofPoints, 100);
  filter->AddInputDataObject(0, ofCells);
  filter->AddInputDataObject(0, plain);
  filter->SetFrame(-0.5, 50.5, -0.5, 10.5);
  filter->SetDimensions(51, 11);
  filter->GenerateColorsOn();
  MessageKeeper messages(filter);
  filter->Update();
  CHECK(messages.OneWarning("1 vertices and lines") && filter->GetNumberOfOtherCells() == 1);
  vtkDataArray* colors = filter->GetOutput()->GetPointData()->GetArray("Color");
  CHECK(
    colors && colors->GetNumberOfComponents() == 4 && colors->GetDataType() == VTK_UNSIGNED_CHAR);
  const auto same = [&](int i, int j, std::vector<double> color)
  { return std::equal(color.begin(), color.end(), colors->GetTuple(51 * j + i)); };
  CHECK(same(0, 0, { 0, 100, 7, 255 }) && same(10, 0, { 200, 100, 7, 255 }));
  CHECK(same(5, 0, { 100, 100, 7, 255 }) && same(2, 5, { 40, 50, 7, 255 }));
  CHECK(same(25, 5, { 9, 8, 7, 60 }) && same(29, 9, { 9, 8, 7, 60 }));
  CHECK(same(41, 3, { 255, 255, 255, 255 }) && same(15, 3, { 0, 0, 0, 0 }));
}

//------------------------------------------------------------------------------
void TestComposite()
{
  const auto shapes = MakeShapes();
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(0, shapes[0]);
  vtkNew<vtkMultiBlockDataSet> outer;
  outer->SetBlock(0, inner);
  outer->SetBlock(1, shapes[1]);
  outer->SetBlock(3, vtkSmartPointer<vtkImageData>::New());
  const auto composite = MakeFilter(outer, 60);
  MessageKeeper messages(composite);
  composite->Update();
  CHECK(messages.OneWarning("1 data sets that are no polygons"));
  CHECK(composite->GetNumberOfOtherDataSets() == 1);
  const auto repeated = MakeFilter(shapes[0], 60);
  repeated->AddInputDataObject(0, shapes[1]);
  repeated->Update();
  CHECK(SameBytes(composite->GetOutput()->GetPointData()->GetScalars(),
    repeated->GetOutput()->GetPointData()->GetScalars()));
  CHECK(composite->GetNumberOfTriangles() ==
    shapes[0]->GetNumberOfPolys() + shapes[1]->GetNumberOfPolys());
}

//------------------------------------------------------------------------------
// A filter downstream, a source that changes, and what one asks in advance.
void TestPipeline()
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkDepthToHeightField> filter;
  filter->SetInputConnection(sphere->GetOutputPort());
  filter->SetResolution(64);
  ProgressKeeper progress(filter);
  vtkNew<vtkImageReliefShading> shading;
  shading->SetInputConnection(filter->GetOutputPort());
  shading->Update();
  CHECK(shading->GetOutput()->GetDimensions()[0] == 64);
  CHECK(progress.Rises() && progress.Steps.size() > 2 && progress.Steps.back() == 1.0);
  progress.Steps.clear();
  shading->Update();
  CHECK(progress.Steps.empty());
  sphere->SetRadius(5.0);
  sphere->SetCenter(100.0, 0.0, 0.0);
  shading->Update();
  CHECK_NEAR(filter->GetOutput()->GetOrigin()[0], 95.0, 0.5);
  vtkNew<vtkConeSource> cone;
  cone->SetCenter(0.0, 100.0, 0.0);
  filter->AddInputConnection(cone->GetOutputPort());
  shading->Update();
  CHECK(filter->GetOutput()->GetSpacing()[1] > 100.0 / 64.0);
  progress.StopAbove = 0.1;
  progress.Steps.clear();
  filter->Modified();
  filter->Update();
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 0);
  // What is above is looked at anew.
  progress.StopAbove = VTK_DOUBLE_MAX;
  filter->Modified();
  filter->Update();
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 64 * 64);
}
}

//------------------------------------------------------------------------------
int TestDepthToHeightField(int, char*[])
{
  const unsigned int seed = std::random_device()();
  std::cout << "seed " << seed << std::endl;
  TestShapes();
  TestTurned();
  TestFarAway();
  TestFrames();
  TestCells();
  TestSoup(seed);
  TestThreads();
  TestMaskAndNormals();
  TestColors();
  TestComposite();
  TestPipeline();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
