// SPDX-License-Identifier: BSD-3-Clause
// vtkDepthToHeightField on a renderer: the depth buffer against the mesh itself, for cameras of
// both kinds, and what is no picture.
#include "vtkDepthToHeightField.h"

#include "vtkActor.h"
#include "vtkCamera.h"
#include "vtkConeSource.h"
#include "vtkMath.h"
#include "vtkPolyDataMapper.h"
#include "vtkRenderWindow.h"
#include "vtkRenderer.h"
#include "vtkSphereSource.h"
#include "vtkTriangleFilter.h"

#include "HeightTestMeshes.h"
#include "ReliefOpenGLTestUtilities.h"

#include <cmath>
#include <cstdlib>

namespace
{
int Failures = 0;

constexpr int Columns = 150;
constexpr int Rows = 100;
// Steps of a buffer of 24 bits.
constexpr double Step = 0x1p-24;

vtkSmartPointer<vtkPolyData> MakeSphere()
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(24);
  sphere->SetPhiResolution(16);
  sphere->Update();
  return sphere->GetOutput();
}

// A mesh in a renderer, in the right part of a window.
struct Stage
{
  vtkNew<vtkActor> actor;
  vtkSmartPointer<vtkRenderer> renderer = vtkSmartPointer<vtkRenderer>::New();
  vtkSmartPointer<vtkRenderWindow> window = vtkSmartPointer<vtkRenderWindow>::New();
  vtkNew<vtkDepthToHeightField> filter;

  explicit Stage(vtkPolyData* mesh)
  {
    auto mapper = vtkSmartPointer<vtkPolyDataMapper>::New();
    mapper->SetInputData(mesh);
    this->actor->SetMapper(mapper);
    this->renderer->AddActor(this->actor);
    this->renderer->SetViewport(0.25, 0.0, 1.0, 0.5);
    this->window->OffScreenRenderingOn();
    this->window->SetMultiSamples(0);
    this->window->SetSize(Columns * 4 / 3, Rows * 2);
    this->window->AddRenderer(this->renderer);
    WatchOpenGL(vtkOpenGLRenderWindow::SafeDownCast(this->window));
    vtkCamera* camera = this->renderer->GetActiveCamera();
    camera->SetPosition(3.0, 2.0, 4.0);
    camera->SetViewUp(0.1, 1.0, 0.0);
    camera->SetViewAngle(30.0);
    this->filter->SetRenderer(this->renderer);
    this->filter->SetOutputScalarTypeToDouble();
    this->filter->GenerateMaskOn();
  }
};

//------------------------------------------------------------------------------
// The same frame of the mesh itself. What OpenGL has of a triangle is that of corners moved by up
// to the 256th of a pixel.
void TestParallel()
{
  const auto mesh = MakeSphere();
  Stage stage(mesh);
  vtkCamera* camera = stage.renderer->GetActiveCamera();
  camera->ParallelProjectionOn();
  camera->SetParallelScale(0.6);
  stage.renderer->ResetCameraClippingRange();
  stage.filter->Update();
  vtkImageData* depth = stage.filter->GetOutput();
  CHECK(depth->GetDimensions()[0] == Columns && depth->GetDimensions()[1] == Rows);
  CHECK_NEAR(depth->GetSpacing()[0], 1.2 / Rows, 1e-12);
  CHECK_NEAR(depth->GetSpacing()[1], 1.2 / Rows, 1e-12);

  vtkNew<vtkDepthToHeightField> exact;
  exact->SetInputDataObject(0, mesh);
  exact->SetViewDirection(3.0, 2.0, 4.0);
  exact->SetViewUp(0.1, 1.0, 0.0);
  const double* origin = depth->GetOrigin();
  const double spacing = 1.2 / Rows;
  exact->SetFrame(origin[0] - 0.5 * spacing, origin[0] + (Columns - 0.5) * spacing,
    origin[1] - 0.5 * spacing, origin[1] + (Rows - 0.5) * spacing);
  exact->SetDimensions(Columns, Rows);
  exact->SetOutputScalarTypeToDouble();
  exact->GenerateNormalsOn();
  vtkNew<vtkPolyData> facets;
  facets->ShallowCopy(mesh);
  facets->GetPointData()->Initialize();
  exact->SetInputDataObject(0, facets);
  exact->Update();
  for (int k = 0; k < 9; ++k)
  {
    CHECK_NEAR(exact->GetViewAxes()[k], stage.filter->GetViewAxes()[k], 1e-12);
  }
  vtkDataArray* normals = exact->GetOutput()->GetPointData()->GetArray("Normals");
  const double range = camera->GetClippingRange()[1] - camera->GetClippingRange()[0];
  int edges = 0;
  int hits = 0;
  for (vtkIdType i = 0; i < depth->GetNumberOfPoints(); ++i)
  {
    const double a = depth->GetPointData()->GetScalars()->GetComponent(i, 0);
    const double b = exact->GetOutput()->GetPointData()->GetScalars()->GetComponent(i, 0);
    CHECK(depth->GetPointData()->GetArray("Mask")->GetComponent(i, 0) == (std::isnan(a) ? 0 : 1));
    edges += std::isnan(a) != std::isnan(b) ? 1 : 0;
    if (!std::isnan(a) && !std::isnan(b))
    {
      const double* normal = normals->GetTuple3(i);
      const double slope = std::hypot(normal[0], normal[1]) / normal[2];
      CHECK_NEAR(a, b, 2.0 * range * Step + 1e-6 + slope * spacing / 100.0);
      ++hits;
    }
  }
  CHECK(edges <= 10 && hits > 2000);
}

//------------------------------------------------------------------------------
// The nearest triangle on the line from the eye through a point; returns how far along, or NaN.
double Trace(vtkPolyData* mesh, const double eye[3], const double through[3])
{
  double direction[3];
  vtkMath::Subtract(through, eye, direction);
  double nearest = vtkMath::Nan();
  for (vtkIdType i = 0; i < mesh->GetNumberOfCells(); ++i)
  {
    const vtkIdType* ids = nullptr;
    vtkIdType count = 0;
    mesh->GetPolys()->GetCellAtId(i, count, ids);
    double p[3][3];
    for (int k = 0; k < 3; ++k)
    {
      mesh->GetPoint(ids[k], p[k]);
    }
    double first[3];
    double second[3];
    double from[3];
    vtkMath::Subtract(p[1], p[0], first);
    vtkMath::Subtract(p[2], p[0], second);
    vtkMath::Subtract(eye, p[0], from);
    const double volume = vtkMath::Determinant3x3(first, second, direction);
    const double u = vtkMath::Determinant3x3(from, second, direction) / volume;
    const double v = vtkMath::Determinant3x3(first, from, direction) / volume;
    const double t = -vtkMath::Determinant3x3(first, second, from) / volume;
    if (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && t > 0.0 && !(t >= nearest))
    {
      nearest = t;
    }
  }
  return nearest;
}

// Samples of the focal plane, and what lies behind them as seen from the eye.
void TestPerspective()
{
  const auto mesh = MakeSphere();
  Stage stage(mesh);
  vtkCamera* camera = stage.renderer->GetActiveCamera();
  camera->SetViewAngle(14.0);
  camera->SetWindowCenter(0.1, -0.05);
  stage.renderer->ResetCameraClippingRange();
  stage.filter->Update();
  vtkImageData* depth = stage.filter->GetOutput();
  const double* axes = stage.filter->GetViewAxes();
  const double distance = camera->GetDistance();
  CHECK_NEAR(depth->GetSpacing()[1],
    2.0 * distance * std::tan(vtkMath::RadiansFromDegrees(7.0)) / Rows, 1e-9);
  double eye[3];
  camera->GetPosition(eye);
  const double focus = vtkMath::Dot(camera->GetFocalPoint(), axes + 6);
  const double* range = camera->GetClippingRange();
  int wrong = 0;
  int hits = 0;
  int edges = 0;
  for (int n = 0; n < Columns * Rows; ++n)
  {
    double at[3];
    depth->GetPoint(n, at);
    double through[3];
    for (int k = 0; k < 3; ++k)
    {
      through[k] = at[0] * axes[k] + at[1] * axes[3 + k] + focus * axes[6 + k];
    }
    const double t = Trace(mesh, eye, through);
    const double height = depth->GetPointData()->GetScalars()->GetComponent(n, 0);
    edges += std::isnan(t) != std::isnan(height) ? 1 : 0;
    if (std::isnan(t) || std::isnan(height))
    {
      continue;
    }
    const double expected = vtkMath::Dot(eye, axes + 6) - t * distance;
    const double step = std::pow(t * distance, 2.0) * (range[1] - range[0]) / (range[0] * range[1]);
    // Steep flanks have more of where corners were moved to.
    wrong += std::abs(height - expected) > 2.0 * step * Step + 2e-4 ? 1 : 0;
    ++hits;
  }
  CHECK(hits > 2000 && edges <= 10 && wrong <= hits / 50);
}

//------------------------------------------------------------------------------
void TestChanges()
{
  const auto mesh = MakeSphere();
  Stage stage(mesh);
  stage.renderer->GetActiveCamera()->ParallelProjectionOn();
  stage.renderer->ResetCamera();
  stage.filter->Update();
  const double high = stage.filter->GetHighestHeight();
  CHECK_NEAR(high, 0.5, 0.02);
  CHECK(stage.filter->GetOutput()->GetScalarRange()[1] == high);
  // What the camera does is noticed.
  stage.renderer->GetActiveCamera()->Zoom(0.5);
  stage.filter->Update();
  CHECK_NEAR(stage.filter->GetOutput()->GetSpacing()[0],
    4.0 * stage.renderer->GetActiveCamera()->GetParallelScale() / (2.0 * Rows), 1e-9);
  stage.window->SetSize(80, 60);
  stage.filter->Modified();
  stage.filter->SetNormalizeToUnitRange();
  stage.filter->Update();
  CHECK(stage.filter->GetOutput()->GetDimensions()[0] == 60);
  CHECK(stage.filter->GetOutput()->GetDimensions()[1] == 30);
  CHECK(stage.filter->GetOutput()->GetScalarRange()[1] == 1.0);
  MessageKeeper messages(stage.filter);
  stage.filter->GenerateColorsOn();
  stage.filter->Update();
  CHECK(messages.OneWarning("of meshes only"));
  stage.filter->GenerateColorsOff();
  // Nothing is seen.
  stage.actor->VisibilityOff();
  stage.filter->Modified();
  stage.filter->Update();
  CHECK(messages.OneError("drew nothing"));
  CHECK(stage.filter->GetOutput()->GetNumberOfPoints() == 0);
}
}

//------------------------------------------------------------------------------
int TestDepthToHeightFieldRenderer(int, char*[])
{
  TestParallel();
  TestPerspective();
  TestChanges();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
