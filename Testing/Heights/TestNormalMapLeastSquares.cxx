// SPDX-License-Identifier: BSD-3-Clause
// vtkNormalMapToHeightField by least squares, and by path sums: exact cases, equations,
// invariances.
#include "vtkNormalMapToHeightField.h"

#include "vtkSMPTools.h"

#include "NormalMapTestUtilities.h"

#include <cstdlib>
#include <string>

namespace
{
int Failures = 0;

constexpr double Pi = 3.14159265358979323846;

SurfaceAt Hilly(int i, int j, int size)
{
  const double k = 4.0 * Pi / size;
  const double a = 0.04 * size;
  return { a * std::sin(k * i + 0.3) * std::cos(0.7 * k * j) +
      0.5 * a * std::sin(0.4 * k * (i + j)),
    a * k * std::cos(k * i + 0.3) * std::cos(0.7 * k * j) +
      0.2 * a * k * std::cos(0.4 * k * (i + j)),
    -0.7 * a * k * std::sin(k * i + 0.3) * std::sin(0.7 * k * j) +
      0.2 * a * k * std::cos(0.4 * k * (i + j)) };
}

std::function<double(int, int)> HeightOf(const Surface& surface)
{
  return [surface](int i, int j) { return surface(i, j).height; };
}

// Slopes that are those of no surface.
Surface MakeRough(unsigned int seed)
{
  return [seed](int i, int j)
  {
    unsigned int k = 2654435761u * (seed + 7919u * static_cast<unsigned int>(i)) ^
      2246822519u * (seed + 104729u * static_cast<unsigned int>(j));
    k = (k ^ k >> 15) * 3266489917u;
    k ^= k >> 13;
    return SurfaceAt{ 0.0, (k & 1023u) / 512.0 - 1.0, (k >> 10 & 1023u) / 512.0 - 1.0 };
  };
}

//------------------------------------------------------------------------------
// The gradient of the sum of squares that heights of rough slopes leave, at its largest.
double WorstImbalance(vtkImageData* heights, const Surface& slopes, const Domain& domain,
  const std::function<double(int, int)>& weight)
{
  const int* size = heights->GetDimensions();
  double worst = 0.0;
  for (int j = 0; j < size[1]; ++j)
  {
    for (int i = 0; i < size[0]; ++i)
    {
      double sum = 0.0;
      for (const auto& step : { std::make_pair(1, 0), std::make_pair(-1, 0), std::make_pair(0, 1),
             std::make_pair(0, -1) })
      {
        const int x = i + step.first;
        const int y = j + step.second;
        const bool inside = x >= 0 && y >= 0 && x < size[0] && y < size[1];
        if (domain(i, j) && inside && domain(x, y))
        {
          const SurfaceAt a = slopes(i, j);
          const SurfaceAt b = slopes(x, y);
          const double rise = 0.5 * (step.first * (a.x + b.x) + step.second * (a.y + b.y));
          const double w = 2.0 / (1.0 / weight(i, j) + 1.0 / weight(x, y));
          sum += w * (HeightAt(heights, x, y) - HeightAt(heights, i, j) - rise);
        }
      }
      worst = std::max(worst, std::abs(sum));
    }
  }
  return worst;
}

//------------------------------------------------------------------------------
// The dense normal equations of a whole rectangle, with the mean at 0, by elimination.
std::vector<double> SolveDensely(int columns, int rows, const Surface& slopes)
{
  const int n = columns * rows;
  std::vector<std::vector<double>> a(n, std::vector<double>(n + 1, 1.0));
  for (std::vector<double>& row : a)
  {
    row[n] = 0.0;
  }
  const auto add = [&](int p, int q, double rise)
  {
    a[p][p] += 1.0;
    a[q][q] += 1.0;
    a[p][q] -= 1.0;
    a[q][p] -= 1.0;
    a[p][n] -= rise;
    a[q][n] += rise;
  };
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      if (i + 1 < columns)
      {
        add(j * columns + i, j * columns + i + 1, 0.5 * (slopes(i, j).x + slopes(i + 1, j).x));
      }
      if (j + 1 < rows)
      {
        add(j * columns + i, (j + 1) * columns + i, 0.5 * (slopes(i, j).y + slopes(i, j + 1).y));
      }
    }
  }
  // The matrix is positive definite: no pivots.
  for (int p = 0; p < n; ++p)
  {
    for (int q = p + 1; q < n; ++q)
    {
      const double factor = a[q][p] / a[p][p];
      for (int k = p; k <= n; ++k)
      {
        a[q][k] -= factor * a[p][k];
      }
    }
  }
  std::vector<double> result(n);
  for (int p = n - 1; p >= 0; --p)
  {
    double sum = a[p][n];
    for (int k = p + 1; k < n; ++k)
    {
      sum -= a[p][k] * result[k];
    }
    result[p] = sum / a[p][p];
  }
  return result;
}

//------------------------------------------------------------------------------
void TestExactSurfaces()
{
  const Surface plane = [](int i, int j) { return SurfaceAt{ 0.3 * i - 1.7 * j, 0.3, -1.7 }; };
  const Surface bowl = [](int i, int j)
  {
    return SurfaceAt{ 0.01 * i * i - 0.02 * i * j + 0.005 * j * j + 0.1 * i,
      0.02 * i - 0.02 * j + 0.1, -0.02 * i + 0.01 * j };
  };
  const Domain ring = [](int i, int j)
  { return std::hypot(i - 40, j - 30) < 29.0 && std::hypot(i - 45, j - 32) > 8.0; };
  for (const Surface& surface : { plane, bowl })
  {
    vtkNew<vtkNormalMapToHeightField> filter;
    filter->SetInputData(MakeNormals(81, 60, surface));
    filter->SetGreenToUp();
    filter->SetTolerance(1e-12);
    filter->Update();
    CHECK(CompareHeights(filter->GetOutput(), HeightOf(surface)).worst < 1e-10);
    CHECK(filter->GetOutput()->GetScalarType() == VTK_DOUBLE && filter->GetConverged());
    filter->SetMaskData(MakeMask(81, 60, ring));
    filter->Update();
    CHECK(CompareHeights(filter->GetOutput(), HeightOf(surface)).worst < 1e-8);
    // Weights leave exact what is exact.
    filter->SetWeightsData(MakeHeights(81, 60, [](int i, int j) { return 1.0 + (3 * i + j) % 7; }));
    filter->Update();
    CHECK(CompareHeights(filter->GetOutput(), HeightOf(surface)).worst < 1e-8);
    filter->SetMethodToPathSums();
    filter->Update();
    CHECK(CompareHeights(filter->GetOutput(), HeightOf(surface)).worst < 1e-10);
  }
}

//------------------------------------------------------------------------------
void TestDenseSolutions()
{
  for (const auto& size : { std::make_pair(1, 1), std::make_pair(1, 6), std::make_pair(5, 1),
         std::make_pair(2, 2), std::make_pair(7, 6), std::make_pair(8, 13), std::make_pair(15, 16),
         std::make_pair(37, 3), std::make_pair(4, 41), std::make_pair(67, 2) })
  {
    const Surface slopes = MakeRough(17);
    const std::vector<double> expected = SolveDensely(size.first, size.second, slopes);
    vtkNew<vtkNormalMapToHeightField> filter;
    filter->SetGreenToUp();
    filter->SetInputData(MakeNormals(size.first, size.second, slopes));
    filter->Update();
    const double worst = CompareHeights(filter->GetOutput(),
      [&](int i, int j) {
        return expected[j * size.first + i];
      }).worst;
    if (worst > 1e-10)
    {
      std::cout << size.first << " x " << size.second << std::endl;
    }
    CHECK(worst <= 1e-10);
    CHECK_NEAR(HeightAt(filter->GetOutput(), 0, 0), expected[0], 1e-10);
  }
}

//------------------------------------------------------------------------------
// Weights of 1 make conjugate gradients of a direct solution.
void TestSolversAgree()
{
  const Surface slopes = MakeRough(5);
  vtkNew<vtkNormalMapToHeightField> filter;
  filter->SetGreenToUp();
  filter->SetTolerance(1e-11);
  filter->SetInputData(MakeNormals(131, 94, slopes));
  filter->Update();
  CHECK(filter->GetNumberOfIterations() == 0);
  const vtkNew<vtkImageData> direct;
  direct->DeepCopy(filter->GetOutput());
  filter->SetWeightsData(MakeHeights(131, 94, [](int, int) { return 3.0; }));
  filter->Update();
  CHECK(filter->GetNumberOfIterations() > 0 && filter->GetConverged());
  CHECK(CompareHeights(filter->GetOutput(), [&](int i, int j) { return HeightAt(direct, i, j); })
          .worst < 1e-8);
  // A mask of everything is none.
  filter->SetWeightsData(nullptr);
  filter->SetMaskData(MakeMask(131, 94, [](int, int) { return true; }));
  filter->Update();
  CHECK(LargestDifference(filter->GetOutput()->GetPointData()->GetScalars(),
          direct->GetPointData()->GetScalars()) == 0.0);
}

//------------------------------------------------------------------------------
// The equations hold on all domains, with and without weights.
void TestEquations()
{
  const int columns = 150;
  const int rows = 120;
  const Surface slopes = MakeRough(9);
  const Domain disc = [](int i, int j)
  { return std::hypot(i - 75, j - 60) < 58.0 && std::hypot(i - 90, j - 50) > 15.0; };
  const Domain speckled = [](int i, int j) { return MakeRough(3)(i, j).x > -0.3; };
  const Domain bands = [](int i, int j) { return (i / 9 + j / 4) % 3 != 0; };
  const Domain parts = [](int i, int j) { return i % 30 != 7 && (j % 40 != 11 || i < 7); };
  const auto one = [](int, int) { return 1.0; };
  const auto uneven = [](int i, int j) { return std::pow(10.0, 2.0 * MakeRough(4)(i, j).y); };
  for (const Domain& domain : { disc, speckled, bands, parts })
  {
    vtkNew<vtkNormalMapToHeightField> filter;
    filter->SetGreenToUp();
    filter->SetTolerance(1e-10);
    filter->SetInputData(MakeNormals(columns, rows, slopes));
    filter->SetMaskData(MakeMask(columns, rows, domain));
    filter->Update();
    CHECK(filter->GetConverged() && filter->GetNumberOfIterations() < 120);
    CHECK(WorstImbalance(filter->GetOutput(), slopes, domain, one) < 1e-6);
    filter->SetWeightsData(MakeHeights<vtkDoubleArray>(columns, rows, uneven));
    filter->Update();
    CHECK(filter->GetConverged());
    CHECK(WorstImbalance(filter->GetOutput(), slopes, domain, uneven) < 1e-4);
  }
}

//------------------------------------------------------------------------------
// Heights come back from their normals, analytic ones and those of differences.
void TestRoundTrip()
{
  const int size = 512;
  const Surface analytic = [](int i, int j) { return Hilly(i, j, size); };
  const Surface differences = [](int i, int j)
  {
    // At the border from one side, by three samples.
    const auto slope = [](const std::function<double(int)>& z, int at)
    {
      return at == 0     ? -1.5 * z(0) + 2.0 * z(1) - 0.5 * z(2)
        : at == size - 1 ? 1.5 * z(at) - 2.0 * z(at - 1) + 0.5 * z(at - 2)
                         : 0.5 * (z(at + 1) - z(at - 1));
    };
    return SurfaceAt{ Hilly(i, j, size).height,
      slope([j](int k) { return Hilly(k, j, size).height; }, i),
      slope([i](int k) { return Hilly(i, k, size).height; }, j) };
  };
  const Domain disc = [](int i, int j) { return std::hypot(i - 250, j - 260) < 245.0; };
  for (const Surface& surface : { analytic, differences })
  {
    vtkNew<vtkNormalMapToHeightField> filter;
    filter->SetInputData(MakeNormals(size, size, surface));
    filter->Update();
    HeightError error = CompareHeights(filter->GetOutput(), HeightOf(surface));
    CHECK(error.count == size * size && error.rms < 1e-4 * error.range);
    filter->SetMaskData(MakeMask(size, size, disc));
    filter->Update();
    error = CompareHeights(filter->GetOutput(), HeightOf(surface));
    CHECK(error.count < size * size && error.rms < 1e-4 * error.range);
  }
}

//------------------------------------------------------------------------------
void TestNoise()
{
  const int size = 512;
  const Surface surface = [](int i, int j)
  {
    SurfaceAt at = Hilly(i, j, size);
    return SurfaceAt{ 0.3 * at.height, 0.3 * at.x, 0.3 * at.y };
  };
  double sums = 0.0;
  double squares = 0.0;
  for (unsigned int seed = 1; seed <= 3; ++seed)
  {
    vtkNew<vtkNormalMapToHeightField> filter;
    filter->SetInputData(MakeNormals(size, size, surface, 0.05, seed));
    filter->SetGreenToUp();
    filter->Update();
    squares += CompareHeights(filter->GetOutput(), HeightOf(surface)).rms;
    filter->SetMethodToPathSums();
    filter->Update();
    sums += CompareHeights(filter->GetOutput(), HeightOf(surface)).rms;
  }
  std::cout << "5 % noise, seeds 1 to 3: path sums " << sums / 3.0 << ", least squares "
            << squares / 3.0 << std::endl;
  CHECK(10.0 * squares < sums);
}

//------------------------------------------------------------------------------
// Turned and mirrored normals give turned and mirrored heights.
void TestSymmetries()
{
  const int columns = 90;
  const int rows = 71;
  const Surface slopes = MakeRough(21);
  const Domain domain = [](int i, int j) { return (i - 30) * (j - 40) % 17 != 0 && i + j > 9; };
  const auto run = [&](int width, int height, const Surface& surface, const Domain& inside,
                     bool weighted, int method)
  {
    vtkNew<vtkNormalMapToHeightField> filter;
    filter->SetGreenToUp();
    filter->SetTolerance(1e-10);
    filter->SetMethod(method);
    filter->SetMaximumIterations(3);
    filter->SetInputData(MakeNormals(width, height, surface));
    filter->SetMaskData(weighted ? MakeMask(width, height, inside).Get() : nullptr);
    filter->Update();
    return vtkSmartPointer<vtkImageData>(filter->GetOutput());
  };
  for (const bool masked : { false, true })
  {
    const auto straight =
      run(columns, rows, slopes, domain, masked, vtkNormalMapToHeightField::LeastSquares);
    const auto turned = run(
      rows, columns,
      [&](int i, int j)
      {
        const SurfaceAt at = slopes(j, i);
        return SurfaceAt{ 0.0, at.y, at.x };
      },
      [&](int i, int j) { return domain(j, i); }, masked, vtkNormalMapToHeightField::LeastSquares);
    const auto mirrored = run(
      columns, rows,
      [&](int i, int j)
      {
        const SurfaceAt at = slopes(columns - 1 - i, j);
        return SurfaceAt{ 0.0, -at.x, at.y };
      },
      [&](int i, int j) { return domain(columns - 1 - i, j); }, masked,
      vtkNormalMapToHeightField::LeastSquares);
    double worst = 0.0;
    for (int j = 0; j < rows; ++j)
    {
      for (int i = 0; i < columns; ++i)
      {
        const double height = HeightAt(straight, i, j);
        CHECK(std::isnan(height) == (masked && !domain(i, j)));
        if (!std::isnan(height))
        {
          worst = std::max({ worst, std::abs(height - HeightAt(turned, j, i)),
            std::abs(height - HeightAt(mirrored, columns - 1 - i, j)) });
        }
      }
    }
    CHECK(worst < (masked ? 1e-7 : 1e-10));
  }
}

//------------------------------------------------------------------------------
void TestThreads()
{
  const auto normals = MakeNormals(301, 257, MakeRough(33));
  const auto mask = MakeMask(301, 257, [](int i, int j) { return (i / 7 + j / 5) % 4 != 0; });
  const auto disc =
    MakeMask(301, 257, [](int i, int j) { return std::hypot(i - 150, j - 128) < 127.0; });
  const std::string backend = vtkSMPTools::GetBackend();
  vtkSMPTools::SetBackend("STDThread");
  for (const auto& domain : { vtkSmartPointer<vtkImageData>(), mask, disc })
  {
    for (const int method :
      { vtkNormalMapToHeightField::LeastSquares, vtkNormalMapToHeightField::DiscontinuityPreserving,
        vtkNormalMapToHeightField::PathSums })
    {
      vtkSmartPointer<vtkImageData> first;
      for (const int threads : { 1, 2, 3 })
      {
        vtkSMPTools::Initialize(threads);
        vtkNew<vtkNormalMapToHeightField> filter;
        filter->SetInputData(normals);
        filter->SetMaskData(domain);
        filter->SetMethod(method);
        filter->SetMaximumIterations(4);
        filter->Update();
        if (!first)
        {
          first = filter->GetOutput();
        }
        CHECK(SameBytes(
          first->GetPointData()->GetScalars(), filter->GetOutput()->GetPointData()->GetScalars()));
      }
    }
  }
  vtkSMPTools::Initialize(0);
  vtkSMPTools::SetBackend(backend.c_str());
}
}

//------------------------------------------------------------------------------
int TestNormalMapLeastSquares(int, char*[])
{
  TestExactSurfaces();
  TestDenseSolutions();
  TestSolversAgree();
  TestEquations();
  TestRoundTrip();
  TestNoise();
  TestSymmetries();
  TestThreads();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
