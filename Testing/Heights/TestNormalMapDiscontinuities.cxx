// SPDX-License-Identifier: BSD-3-Clause
// vtkNormalMapToHeightField where surfaces jump, and as a camera sees them.
#include "vtkNormalMapToHeightField.h"

#include "NormalMapTestUtilities.h"

#include <cstdlib>

namespace
{
int Failures = 0;

constexpr double None = std::numeric_limits<double>::quiet_NaN();

std::function<double(int, int)> HeightOf(const Surface& surface)
{
  return [surface](int i, int j) { return surface(i, j).height; };
}

// A tent on the ground, whose gables are cliffs: it touches the ground along two sides.
SurfaceAt Tent(int i, int j)
{
  const double x = i - 63.5;
  const double y = j - 63.5;
  if (std::abs(x) > 40.0 || std::abs(y) > 30.0)
  {
    return { 0.0, 0.0, 0.0 };
  }
  return { 0.8 * (40.0 - std::abs(x)), x > 0.0 ? -0.8 : 0.8, 0.0 };
}

// Ramps side by side that rise from a common floor to different heights: stairs, with cliffs
// between them. How much is won depends on their slopes: this one suits the method; at half of it
// it wins next to nothing over least squares.
SurfaceAt Stairs(int i, int j)
{
  const int stair = i / 32;
  const double slope = 0.5 * stair;
  const double y = std::max(0, j - 30);
  return { slope * y, 0.0, j > 30 ? slope : 0.0 };
}

//------------------------------------------------------------------------------
void TestCliffs()
{
  for (const Surface& surface : { Surface(Tent), Surface(Stairs) })
  {
    vtkNew<vtkNormalMapToHeightField> filter;
    filter->SetInputData(MakeNormals(128, 128, surface));
    filter->SetGreenToUp();
    filter->Update();
    const HeightError smeared = CompareHeights(filter->GetOutput(), HeightOf(surface));
    filter->SetMethodToDiscontinuityPreserving();
    filter->SetMaximumIterations(300);
    filter->Update();
    const HeightError kept = CompareHeights(filter->GetOutput(), HeightOf(surface));
    std::cout << "cliffs, mean error of " << smeared.range << ": least squares " << smeared.mean
              << ", discontinuity preserving " << kept.mean << ", "
              << filter->GetNumberOfIterations() << " iterations" << std::endl;
    CHECK(kept.mean < 0.15 * smeared.mean && kept.mean < 0.02 * kept.range);
    CHECK(filter->GetConverged() && filter->GetNumberOfIterations() < 300);
    filter->SetMaximumIterations(2);
    filter->Update();
    CHECK(!filter->GetConverged() && filter->GetNumberOfIterations() == 2);
  }
}

//------------------------------------------------------------------------------
// Where nothing jumps, it is close to least squares.
void TestSmooth()
{
  const Surface hill = [](int i, int j)
  {
    return SurfaceAt{ 8.0 * std::sin(0.06 * i) * std::cos(0.05 * j),
      0.48 * std::cos(0.06 * i) * std::cos(0.05 * j),
      -0.4 * std::sin(0.06 * i) * std::sin(0.05 * j) };
  };
  const Surface plane = [](int i, int j) { return SurfaceAt{ 0.4 * i - 0.3 * j, 0.4, -0.3 }; };
  vtkNew<vtkNormalMapToHeightField> filter;
  filter->SetMethodToDiscontinuityPreserving();
  filter->SetGreenToUp();
  filter->SetInputData(MakeNormals(160, 130, hill));
  filter->Update();
  HeightError error = CompareHeights(filter->GetOutput(), HeightOf(hill));
  CHECK(error.rms < 2e-3 * error.range);
  filter->SetInputData(MakeNormals(160, 130, plane));
  filter->SetMaskData(
    MakeMask(160, 130, [](int i, int j) { return std::hypot(i - 80, j - 65) < 60.0; }));
  filter->Update();
  error = CompareHeights(filter->GetOutput(), HeightOf(plane));
  CHECK(error.worst < 2e-3 * error.range);
}

//------------------------------------------------------------------------------
struct Camera
{
  double focalX;
  double focalY;
  double centerX;
  double centerY;

  double A(double i) const { return (i - this->centerX) / this->focalX; }
  double B(double j) const { return (j - this->centerY) / this->focalY; }
};

constexpr Camera Seen = { 210.0, 190.0, 70.0, 48.0 };

void SetCamera(vtkNormalMapToHeightField* filter, double distance)
{
  filter->SetProjectionToPerspective();
  filter->SetFocalLengthX(Seen.focalX);
  filter->SetFocalLengthY(Seen.focalY);
  filter->SetPrincipalPointX(Seen.centerX);
  filter->SetPrincipalPointY(Seen.centerY);
  filter->SetDistance(distance);
}

// Depths of a picture and their normals. The depth is NaN where nothing is seen.
struct Depths
{
  std::function<double(int, int)> depth;
  std::function<void(int, int, double*)> normal;
};

Depths MakePlane(const double n[3], double offset)
{
  Depths plane;
  const double x = n[0];
  const double y = n[1];
  const double z = n[2];
  plane.depth = [=](int i, int j) { return offset / (x * Seen.A(i) + y * Seen.B(j) - z); };
  plane.normal = [=](int, int, double* normal)
  {
    normal[0] = x;
    normal[1] = y;
    normal[2] = z;
  };
  return plane;
}

// A ball of a radius around (0.3, -0.2, -10).
Depths MakeBall(double radius)
{
  Depths ball;
  ball.depth = [=](int i, int j)
  {
    const double ray[3] = { Seen.A(i), Seen.B(j), -1.0 };
    const double center[3] = { 0.3, -0.2, -10.0 };
    double rr = 0.0;
    double rc = 0.0;
    double cc = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      rr += ray[k] * ray[k];
      rc += ray[k] * center[k];
      cc += center[k] * center[k];
    }
    const double root = rc * rc - rr * (cc - radius * radius);
    // Not as far as its edge, where slopes are infinite.
    return root > 0.25 * rr * radius * radius ? (rc - std::sqrt(root)) / rr : None;
  };
  const auto depth = ball.depth;
  ball.normal = [=](int i, int j, double* normal)
  {
    const double d = depth(i, j);
    normal[0] = d * Seen.A(i) - 0.3;
    normal[1] = d * Seen.B(j) + 0.2;
    normal[2] = 10.0 - d;
  };
  return ball;
}

// The geometric mean of depths, which normals do not tell.
double MeanDepth(const Depths& seen, int columns, int rows)
{
  double sum = 0.0;
  int count = 0;
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      const double depth = seen.depth(i, j);
      sum += std::isnan(depth) ? 0.0 : std::log(depth);
      count += std::isnan(depth) ? 0 : 1;
    }
  }
  return std::exp(sum / count);
}

double WorstDepth(vtkImageData* heights, const Depths& seen, double distance)
{
  double worst = 0.0;
  for (int j = 0; j < heights->GetDimensions()[1]; ++j)
  {
    for (int i = 0; i < heights->GetDimensions()[0]; ++i)
    {
      const double depth = seen.depth(i, j);
      const double height = HeightAt(heights, i, j);
      CHECK(std::isnan(depth) == std::isnan(height));
      if (!std::isnan(depth))
      {
        worst = std::max(worst, std::abs(distance - height - depth) / depth);
      }
    }
  }
  return worst;
}

void TestPerspective()
{
  const double n[3] = { 0.3, -0.4, 0.8 };
  struct Case
  {
    Depths seen;
    double bounds[2];
  };
  for (const Case& one :
    { Case{ MakePlane(n, -7.0), { 2e-6, 5e-4 } }, Case{ MakeBall(2.0), { 2e-4, 5e-4 } } })
  {
    const double distance = MeanDepth(one.seen, 141, 97);
    for (const int method : { vtkNormalMapToHeightField::LeastSquares,
           vtkNormalMapToHeightField::DiscontinuityPreserving })
    {
      vtkNew<vtkNormalMapToHeightField> filter;
      filter->SetInputData(MakeVectors(141, 97, 3, one.seen.normal));
      filter->SetMethod(method);
      SetCamera(filter, distance);
      filter->Update();
      const double worst = WorstDepth(filter->GetOutput(), one.seen, distance);
      std::cout << "camera, method " << method << ": worst error of a depth " << worst << std::endl;
      CHECK(worst < one.bounds[method]);
      CHECK(filter->GetUsedGreen() == vtkNormalMapToHeightField::Up);
    }
  }
  // The ball's green is told from its curl, here from one that points down.
  vtkNew<vtkNormalMapToHeightField> filter;
  const Depths ball = MakeBall(2.0);
  filter->SetInputData(MakeVectors(141, 97, 3,
    [&](int i, int j, double* normal)
    {
      ball.normal(i, j, normal);
      normal[1] = -normal[1];
    }));
  const double distance = MeanDepth(ball, 141, 97);
  SetCamera(filter, distance);
  filter->Update();
  CHECK(filter->IsGreenKnown() && filter->GetUsedGreen() == vtkNormalMapToHeightField::Down);
  CHECK(WorstDepth(filter->GetOutput(), ball, distance) < 1e-4);
}

//------------------------------------------------------------------------------
// A camera far away sees what an orthographic view does; the middle is its own choice.
void TestFarCamera()
{
  const Surface hill = [](int i, int j)
  {
    return SurfaceAt{ 3.0 * std::sin(0.1 * i) * std::cos(0.1 * j),
      0.3 * std::cos(0.1 * i) * std::cos(0.1 * j), -0.3 * std::sin(0.1 * i) * std::sin(0.1 * j) };
  };
  vtkNew<vtkNormalMapToHeightField> filter;
  filter->SetInputData(MakeNormals(80, 70, hill));
  filter->SetProjectionToPerspective();
  filter->SetFocalLengthX(1e6);
  filter->SetDistance(1e6);
  filter->Update();
  CHECK(CompareHeights(filter->GetOutput(), HeightOf(hill)).worst < 0.01);
}

//------------------------------------------------------------------------------
// Noise under weights that tear every sample from its neighbours: heights that are finite, or none
// and one message.
void TestTornSamples()
{
  std::mt19937 random(5);
  std::normal_distribution<double> spread;
  const auto noise = MakeVectors(20, 30, 3,
    [&](int, int, double* normal)
    {
      normal[0] = spread(random);
      normal[1] = spread(random);
      normal[2] = std::abs(spread(random)) + 0.01;
    });
  for (const double smoothness : { 2.0, 50.0, 1000.0 })
  {
    vtkNew<vtkNormalMapToHeightField> filter;
    MessageKeeper messages(filter);
    filter->SetInputData(noise);
    filter->SetEncodingToSigned();
    filter->SetMethodToDiscontinuityPreserving();
    filter->SetSmoothness(smoothness);
    filter->Update();
    vtkImageData* output = filter->GetOutput();
    if (output->GetNumberOfPoints() == 0)
    {
      CHECK(messages.OneError("beyond all bounds"));
      continue;
    }
    CHECK(messages.Silent());
    vtkDataArray* heights = output->GetPointData()->GetScalars();
    for (vtkIdType k = 0; k < heights->GetNumberOfTuples(); ++k)
    {
      CHECK(std::isnan(heights->GetComponent(k, 0)) || std::abs(heights->GetComponent(k, 0)) < 5e7);
    }
  }
}
}

//------------------------------------------------------------------------------
int TestNormalMapDiscontinuities(int, char*[])
{
  TestTornSamples();
  TestCliffs();
  TestSmooth();
  TestPerspective();
  TestFarCamera();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
