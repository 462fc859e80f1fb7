// SPDX-License-Identifier: BSD-3-Clause
// vtkDepthToHeightField: what is refused, and meshes with nothing or nonsense in them.
#include "vtkDepthToHeightField.h"

#include "vtkMath.h"
#include "vtkMultiBlockDataSet.h"
#include "vtkRenderer.h"

#include "HeightTestMeshes.h"

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>

namespace
{
int Failures = 0;

bool FailsAs(vtkDepthToHeightField* filter, const std::string& text)
{
  MessageKeeper messages(filter);
  filter->Update();
  return messages.OneError(text) && filter->GetOutput()->GetNumberOfPoints() == 0 &&
    std::isnan(filter->GetLowestHeight());
}

//------------------------------------------------------------------------------
void TestSetters()
{
  vtkNew<vtkDepthToHeightField> filter;
  MessageKeeper messages(filter);
  const vtkMTimeType time = filter->GetMTime();
  const double nan = vtkMath::Nan();
  filter->SetViewDirection(0.0, 0.0, 0.0);
  CHECK(messages.OneError("SetViewDirection: 0, 0, 0") && filter->GetViewDirection()[2] == 1.0);
  filter->SetViewUp(0.0, nan, 0.0);
  CHECK(messages.OneError("SetViewUp") && filter->GetViewUp()[1] == 1.0);
  filter->SetViewUp(vtkMath::Inf(), 0.0, 0.0);
  CHECK(messages.OneError("SetViewUp"));
  for (const int samples : { 0, -3, 65537 })
  {
    filter->SetResolution(samples);
    CHECK(messages.OneError("SetResolution") && filter->GetResolution() == 1024);
    filter->SetDimensions(samples, 4);
    CHECK(messages.OneError("SetDimensions") && filter->GetDimensions()[1] == 0);
  }
  filter->SetFrame(1.0, 1.0, 0.0, 1.0);
  CHECK(messages.OneError("SetFrame"));
  filter->SetFrame(0.0, 1.0, nan, 1.0);
  CHECK(messages.OneError("SetFrame"));
  filter->SetFrame(0.0, vtkMath::Inf(), 0.0, 1.0);
  CHECK(messages.OneError("SetFrame") && filter->GetFrame()[1] == 0.0);
  for (const double margin : { -0.1, 10.5, nan })
  {
    filter->SetMargin(margin);
    CHECK(messages.OneError("SetMargin") && filter->GetMargin() == 0.02);
  }
  filter->SetNormalize(3);
  CHECK(messages.OneError("SetNormalize") && filter->GetNormalize() == 0);
  filter->SetOutputScalarType(VTK_INT);
  CHECK(messages.OneError("SetOutputScalarType") && filter->GetOutputScalarType() == VTK_FLOAT);
  CHECK(filter->GetMTime() == time);
  std::ostringstream text;
  filter->Print(text);
  CHECK(text.str().find("ViewDirection: 0, 0, 1") != std::string::npos);
}

//------------------------------------------------------------------------------
void TestNothing()
{
  vtkNew<vtkDepthToHeightField> filter;
  CHECK(FailsAs(filter, "nothing to look at"));
  vtkNew<vtkPolyData> empty;
  filter->SetInputDataObject(0, empty);
  CHECK(FailsAs(filter, "no triangles"));
  vtkNew<vtkMultiBlockDataSet> blocks;
  filter->SetInputDataObject(0, blocks);
  CHECK(FailsAs(filter, "no triangles"));
  // Out of sight: beside the frame, between samples, edge-on, in a line toward the eye.
  const auto mesh = MakeMesh({ 0, 0, 0, 1, 0, 0, 0, 1, 0 }, { { 0, 1, 2 } });
  filter->SetInputDataObject(0, mesh);
  filter->SetFrame(5.0, 6.0, 5.0, 6.0);
  CHECK(FailsAs(filter, "no sample hits a triangle"));
  filter->SetFrame(-1e10, 2e10, -1e10, 1e10);
  filter->SetDimensions(2, 2);
  CHECK(FailsAs(filter, "no sample hits a triangle"));
  filter->SetFrame(0.0, 0.0, 0.0, 0.0);
  filter->SetDimensions(0, 0);
  filter->SetViewDirection(1.0, 0.0, 0.0);
  CHECK(FailsAs(filter, "no sample hits a triangle"));
  const auto needle = MakeMesh({ 0, 0, 0, 0, 0, 1, 0, 0, 3 }, { { 0, 1, 2 } });
  filter->SetInputDataObject(0, needle);
  filter->SetViewDirection(0.0, 0.0, 1.0);
  CHECK(filter->GetNumberOfTriangles() == 1);
  MessageKeeper messages(filter);
  filter->Update();
  CHECK(!messages.Silent() && filter->GetNumberOfDegenerateTriangles() == 1);
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 0);
}

//------------------------------------------------------------------------------
void TestTooLarge()
{
  const auto mesh = MakeMesh({ 0, 0, 0, 1, 0, 0, 0, 1, 0 }, { { 0, 1, 2 } });
  vtkNew<vtkDepthToHeightField> filter;
  filter->SetInputDataObject(0, mesh);
  filter->SetDimensions(65536, 65536);
  CHECK(FailsAs(filter, "65536 x 65536 samples"));
  filter->SetDimensions(0, 0);
  filter->SetResolution(65536);
  CHECK(FailsAs(filter, "65536 x 65536 samples"));
}

//------------------------------------------------------------------------------
// One good triangle among bad ones: what is left out is counted and told once.
void TestNonsense()
{
  const double nan = vtkMath::Nan();
  const double infinity = vtkMath::Inf();
  const auto mesh = MakeMesh(
    { 0, 0, 3, 1, 0, 3, 0, 1, 3, nan, 0, 0, 0, infinity, 0, 0, 0, 1e200, 2, 0, 3, 0.5, 0, 3 },
    { { 0, 1, 2 }, { 0, 1, 3 }, { 4, 1, 2 }, { 0, 5, 2 }, { 0, 1, 1 }, { 0, 1, 6 }, { 0, 1 }, {},
      { 0, 1, 99 }, { 0, -1, 2 }, { 0, 1, 2, 3 }, { 0, 1, 2, 3, 4 }, { 0, 0, 0, 0, 0 },
      { 0, 1, 6, 7, 0 } },
    { { 0, 1 }, { 0, 1, 3, 2 } });
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({ 0, 1 });
  lines->InsertNextCell({ 0, 2 });
  mesh->SetLines(lines);
  vtkNew<vtkDepthToHeightField> filter;
  filter->SetInputDataObject(0, mesh);
  filter->SetResolution(32);
  filter->GenerateNormalsOn();
  MessageKeeper messages(filter);
  filter->Update();
  CHECK(messages.OneWarning("2 vertices and lines"));
  CHECK(filter->GetNumberOfOtherCells() == 2);
  CHECK(filter->GetNumberOfNonFiniteTriangles() == 5 + 2 + 3 + 2);
  CHECK(filter->GetNumberOfDegenerateTriangles() >= 2 + 2 + 3);
  vtkImageData* image = filter->GetOutput();
  CHECK(image->GetScalarRange()[0] == 3.0 && image->GetScalarRange()[1] == 3.0);
  CHECK(filter->GetLowestHeight() == 3.0 && filter->GetHighestHeight() == 3.0);
  // Only bad ones.
  const auto bad = MakeMesh({ nan, 0, 0, 1, 0, 0, 0, 1, 0 }, { { 0, 1, 2 } });
  filter->SetInputDataObject(0, bad);
  filter->Update();
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 0);
  CHECK(filter->GetNumberOfNonFiniteTriangles() == 1);
}

//------------------------------------------------------------------------------
// Extremes of size.
void TestSizes()
{
  for (const double scale : { 1e-60, 1e-30, 1e30, 1e99 })
  {
    const auto mesh = MakeMesh({ 0, 0, 0, scale, 0, 0, 0, scale, scale }, { { 0, 1, 2 } });
    vtkNew<vtkDepthToHeightField> filter;
    filter->SetInputDataObject(0, mesh);
    filter->SetResolution(16);
    filter->SetOutputScalarTypeToDouble();
    MessageKeeper messages(filter);
    filter->Update();
    CHECK(messages.Silent());
    CHECK_NEAR(filter->GetHighestHeight() / scale, 0.98, 0.06);
  }
  // A single sample.
  const auto mesh = MakeMesh({ 0, 0, 2, 1, 0, 2, 1, 1, 2, 0, 1, 2 }, { { 0, 1, 2, 3 } });
  vtkNew<vtkDepthToHeightField> filter;
  filter->SetInputDataObject(0, mesh);
  filter->SetResolution(1);
  filter->Update();
  CHECK(filter->GetOutput()->GetNumberOfPoints() == 1);
  CHECK(filter->GetOutput()->GetScalarComponentAsDouble(0, 0, 0, 0) == 2.0);
}

//------------------------------------------------------------------------------
// Any bits as points, any numbers of points, any kinds of cells, seen from anywhere.
double AnyNumber(std::mt19937_64& random)
{
  const std::uint64_t bits = random();
  double number = 0.0;
  std::memcpy(&number, &bits, sizeof(number));
  const double usual = static_cast<double>(random() % 2001) / 100.0 - 10.0;
  return random() % 40 == 0 ? number : random() % 3 == 0 ? std::round(usual) : usual;
}

void TestAnything(unsigned int seed)
{
  std::mt19937_64 random(seed);
  int seen = 0;
  for (int n = 0; n < 400; ++n)
  {
    std::vector<double> points(3 * (1 + random() % 40));
    std::generate(points.begin(), points.end(), [&random] { return AnyNumber(random); });
    const auto any = [&](std::size_t most)
    {
      std::vector<std::vector<vtkIdType>> cells(random() % 12);
      for (auto& cell : cells)
      {
        cell.resize(random() % most);
        for (vtkIdType& id : cell)
        {
          id =
            static_cast<vtkIdType>(random() % (points.size() / 3 + (random() % 30 == 0 ? 2 : 0)));
        }
      }
      return cells;
    };
    const auto polygons = any(9);
    const auto mesh = MakeMesh(points, polygons, any(6));
    vtkNew<vtkDepthToHeightField> filter;
    filter->SetInputDataObject(0, mesh);
    filter->SetResolution(1 + static_cast<int>(random() % 40));
    filter->SetNormalize(static_cast<int>(random() % 3));
    filter->SetOutputScalarType(random() % 2 == 0 ? VTK_FLOAT : VTK_DOUBLE);
    filter->GenerateMaskOn();
    filter->GenerateNormalsOn();
    MessageKeeper messages(filter); // whatever they say
    filter->SetViewDirection(AnyNumber(random), AnyNumber(random), 1.0);
    filter->SetViewUp(AnyNumber(random), 1.0, AnyNumber(random));
    if (random() % 3 == 0)
    {
      filter->SetFrame(AnyNumber(random), AnyNumber(random), -1.0, AnyNumber(random));
    }
    filter->Update();
    vtkImageData* image = filter->GetOutput();
    seen += image->GetNumberOfPoints() > 0 ? 1 : 0;
    for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
    {
      const double height = image->GetPointData()->GetScalars()->GetComponent(i, 0);
      const double* normal = image->GetPointData()->GetArray("Normals")->GetTuple3(i);
      const double length = vtkMath::Norm(normal);
      const bool there = image->GetPointData()->GetArray("Mask")->GetComponent(i, 0) == 1.0;
      CHECK(there == !std::isnan(height) && std::abs(length - (there ? 1.0 : 0.0)) < 1e-5);
      CHECK(!(filter->GetNormalize() == vtkDepthToHeightField::UnitRange && there) ||
        (height >= 0.0 && height <= 1.0));
    }
    CHECK(
      image->GetNumberOfPoints() == 0 || filter->GetLowestHeight() <= filter->GetHighestHeight());
  }
  CHECK(seen > 100);
}

//------------------------------------------------------------------------------
void TestRendererWithoutWindow()
{
  vtkNew<vtkDepthToHeightField> filter;
  const auto renderer = vtkSmartPointer<vtkRenderer>::New();
  filter->SetRenderer(renderer);
  CHECK(filter->GetRenderer() == renderer);
  CHECK(FailsAs(filter, "no window"));
  filter->SetRenderer(nullptr);
  CHECK(FailsAs(filter, "nothing to look at"));
}
}

//------------------------------------------------------------------------------
int TestDepthToHeightFieldInvalid(int, char*[])
{
  const unsigned int seed = std::random_device()();
  std::cout << "seed " << seed << std::endl;
  TestSetters();
  TestNothing();
  TestTooLarge();
  TestNonsense();
  TestSizes();
  TestAnything(seed);
  TestRendererWithoutWindow();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
