// SPDX-License-Identifier: BSD-3-Clause
// Heights of triangles at samples: which samples a triangle has is exact, edges leave no cracks,
// and heights are those of the planes, whoever shares out the work.
#include "TriangleHeights.h"
#include "TriangleOrientation.h"

#include "ReliefTestUtilities.h"

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <thread>
#include <vector>

namespace
{
int Failures = 0;

struct Mesh
{
  std::vector<double> points;
  std::vector<std::uint32_t> corners;

  std::uint32_t AddPoint(double x, double y, double z)
  {
    this->points.insert(this->points.end(), { x, y, z });
    return static_cast<std::uint32_t>(this->points.size() / 3 - 1);
  }
  void AddTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c)
  {
    this->corners.insert(this->corners.end(), { a, b, c });
  }
  relief::TriangleMesh View() const
  {
    return { this->points.data(), this->corners.data(), this->corners.size() / 3 };
  }
};

struct Heights
{
  int columns;
  int rows;
  std::vector<double> heights;
  std::vector<std::uint32_t> triangles;
  relief::TriangleCount count;

  std::size_t At(int i, int j) const
  {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(this->columns) +
      static_cast<std::size_t>(i);
  }
};

void Serial(int count, const std::function<void(int, int)>& body)
{
  body(0, count);
}

// Many threads, each with a part of its own.
void Threaded(int count, const std::function<void(int, int)>& body)
{
  std::vector<std::thread> threads;
  for (int begin = 0; begin < count; begin += 1 + count / 7)
  {
    threads.emplace_back(body, begin, std::min(begin + 1 + count / 7, count));
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
}

Heights Run(const Mesh& mesh, int columns, int rows,
  const relief::ParallelFor& parallelFor = Serial, const std::function<bool(double)>& goOn = {})
{
  Heights result{ columns, rows, {}, {}, {} };
  result.heights.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  result.triangles.resize(result.heights.size());
  result.count = relief::FindTriangleHeights(mesh.View(), parallelFor, goOn,
    { columns, rows, result.heights.data(), result.triangles.data() });
  return result;
}

//------------------------------------------------------------------------------
// Signs of areas that doubles get wrong, against integers of 128 bits.
void TestOrientation(unsigned int seed)
{
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<std::int64_t> large(-(1LL << 45), 1LL << 45);
  std::uniform_int_distribution<std::int64_t> small(-2, 2);
  std::uniform_int_distribution<std::int64_t> part(-(1LL << 20), 1LL << 20);
  int zeros = 0;
  for (int n = 0; n < 100000; ++n)
  {
    const std::int64_t a[2] = { large(random), large(random) };
    const std::int64_t step[2] = { part(random), part(random) };
    const std::int64_t m = part(random);
    const std::int64_t b[2] = { a[0] + m * step[0], a[1] + m * step[1] };
    const std::int64_t k = part(random);
    const std::int64_t p[2] = { a[0] + k * step[0] + small(random),
      a[1] + k * step[1] + small(random) };
    const __int128 exact = static_cast<__int128>(a[0] - p[0]) * (b[1] - p[1]) -
      static_cast<__int128>(a[1] - p[1]) * (b[0] - p[0]);
    const double area = relief::OrientedArea(static_cast<double>(a[0]), static_cast<double>(a[1]),
      static_cast<double>(b[0]), static_cast<double>(b[1]), static_cast<double>(p[0]),
      static_cast<double>(p[1]));
    CHECK((exact > 0) == (area > 0.0) && (exact < 0) == (area < 0.0));
    CHECK_NEAR(area, static_cast<double>(exact), 0x1p-25 * std::abs(static_cast<double>(exact)));
    zeros += exact == 0 ? 1 : 0;
  }
  CHECK(zeros > 1000);
}

//------------------------------------------------------------------------------
// Corners on a grid of quarters of samples: integers tell exactly what lies where.
void TestExact(unsigned int seed)
{
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<int> corner(-40, 40 * 4);
  constexpr int size = 30;
  for (int n = 0; n < 200; ++n)
  {
    Mesh mesh;
    std::vector<std::int64_t> whole;
    const int triangles = 1 + n % 5;
    for (int k = 0; k < 3 * triangles; ++k)
    {
      whole.push_back(corner(random));
      whole.push_back(corner(random));
      mesh.AddPoint(0.25 * static_cast<double>(whole[2 * k]),
        0.25 * static_cast<double>(whole[2 * k + 1]), corner(random));
      mesh.corners.push_back(static_cast<std::uint32_t>(k));
    }
    const Heights result = Run(mesh, size, size);
    for (int j = 0; j < size; ++j)
    {
      for (int i = 0; i < size; ++i)
      {
        long double highest = -INFINITY;
        for (int t = 0; t < triangles; ++t)
        {
          const std::int64_t* w = whole.data() + 6 * t;
          const auto area = [&](int a, int b)
          {
            return (w[2 * a] - 4 * i) * (w[2 * b + 1] - 4 * j) -
              (w[2 * a + 1] - 4 * j) * (w[2 * b] - 4 * i);
          };
          std::int64_t parts[3] = { area(1, 2), area(2, 0), area(0, 1) };
          const std::int64_t sum = parts[0] + parts[1] + parts[2];
          const bool inside = sum > 0 ? parts[0] >= 0 && parts[1] >= 0 && parts[2] >= 0
                                      : sum < 0 && parts[0] <= 0 && parts[1] <= 0 && parts[2] <= 0;
          long double height = 0.0L;
          for (int k = 0; inside && k < 3; ++k)
          {
            height += static_cast<long double>(parts[k]) / sum *
              mesh.points[static_cast<std::size_t>(9 * t + 3 * k + 2)];
          }
          highest = inside && height > highest ? height : highest;
        }
        const double found = result.heights[result.At(i, j)];
        CHECK(std::isnan(found) == (highest == -INFINITY));
        CHECK((result.triangles[result.At(i, j)] == relief::NoTriangle) == std::isnan(found));
        CHECK(std::isnan(found) || std::abs(found - static_cast<double>(highest)) < 1e-11);
      }
    }
  }
}

//------------------------------------------------------------------------------
// A triangulation of a rectangle from (low, low) to (high, high): corners moved at random, on whole
// samples or anywhere, and diagonals at random.
Mesh MakeTriangulation(
  std::mt19937_64& random, int cells, double low, double high, bool whole, bool shared)
{
  std::uniform_real_distribution<double> move(-0.3, 0.3);
  const double step = (high - low) / cells;
  std::vector<double> corners;
  for (int j = 0; j <= cells; ++j)
  {
    for (int i = 0; i <= cells; ++i)
    {
      const double x = low + step * (i + (i > 0 && i < cells ? move(random) : 0.0));
      const double y = low + step * (j + (j > 0 && j < cells ? move(random) : 0.0));
      corners.insert(corners.end(),
        { whole ? std::round(x) : x, whole ? std::round(y) : y,
          std::sin(0.3 * x) * std::cos(0.2 * y) });
    }
  }
  Mesh mesh;
  mesh.points = corners;
  const auto at = [&](int i, int j)
  {
    const std::size_t k = 3 * static_cast<std::size_t>(j * (cells + 1) + i);
    // Each triangle may have points of its own.
    return shared ? static_cast<std::uint32_t>(k / 3)
                  : mesh.AddPoint(corners[k], corners[k + 1], corners[k + 2]);
  };
  for (int j = 0; j < cells; ++j)
  {
    for (int i = 0; i < cells; ++i)
    {
      const bool turned = random() % 2 == 0;
      mesh.AddTriangle(at(i, j), at(i + 1, j), at(turned ? i : i + 1, j + 1));
      mesh.AddTriangle(at(turned ? i + 1 : i, j), at(i + 1, j + 1), at(i, j + 1));
      if (random() % 2 == 0)
      {
        std::swap(mesh.corners[mesh.corners.size() - 1], mesh.corners[mesh.corners.size() - 2]);
      }
    }
  }
  return mesh;
}

void TestNoCracks(unsigned int seed)
{
  std::mt19937_64 random(seed);
  constexpr int size = 120;
  for (int n = 0; n < 40; ++n)
  {
    const bool whole = n % 2 == 0;
    const Mesh mesh = MakeTriangulation(random, 1 + n, 10.0, 100.0, whole, n % 3 != 0);
    const Heights result = Run(mesh, size, size, n % 4 < 2 ? Serial : Threaded);
    int wrong = 0;
    for (int j = 0; j < size; ++j)
    {
      for (int i = 0; i < size; ++i)
      {
        const bool inside = i >= 10 && i <= 100 && j >= 10 && j <= 100;
        wrong += std::isnan(result.heights[result.At(i, j)]) == inside ? 1 : 0;
      }
    }
    CHECK(wrong == 0);
  }
}

//------------------------------------------------------------------------------
bool Same(const Heights& a, const Heights& b)
{
  return std::memcmp(a.heights.data(), b.heights.data(), a.heights.size() * sizeof(double)) == 0 &&
    a.triangles == b.triangles;
}

// Large and small triangles that overlap, some at the same height; more than are binned at once.
void TestThreads(unsigned int seed)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-20.0, 420.0);
  std::uniform_real_distribution<double> small(-1.0, 1.0);
  Mesh mesh;
  for (int n = 0; n < 1200000; ++n)
  {
    const double x = place(random);
    const double y = place(random);
    const double scale = n % 20000 == 0 ? 200.0 : 1.0;
    const double z = std::floor(4.0 * small(random));
    for (int k = 0; k < 3; ++k)
    {
      mesh.corners.push_back(
        mesh.AddPoint(x + scale * small(random), y + scale * small(random), z));
    }
  }
  std::vector<double> progress;
  const Heights serial = Run(mesh, 400, 410, Serial,
    [&progress](double done)
    {
      progress.push_back(done);
      return true;
    });
  CHECK(serial.count.whole && serial.count.leftOut == 0);
  CHECK(progress.size() >= 2 && std::is_sorted(progress.begin(), progress.end()));
  CHECK(progress.back() == 1.0);
  CHECK(Same(serial, Run(mesh, 400, 410, Threaded)));
  const Heights stopped = Run(mesh, 400, 410, Serial, [](double) { return false; });
  CHECK(!stopped.count.whole);
  // The same without the triangles' numbers.
  std::vector<double> heights(serial.heights.size());
  relief::FindTriangleHeights(mesh.View(), Threaded, {}, { 400, 410, heights.data(), nullptr });
  CHECK(std::memcmp(heights.data(), serial.heights.data(), heights.size() * sizeof(double)) == 0);
}

//------------------------------------------------------------------------------
void TestHardTriangles()
{
  Mesh mesh;
  const auto add = [&mesh](double x, double y, double z)
  { mesh.corners.push_back(mesh.AddPoint(x, y, z)); };
  // Nothing at all.
  CHECK(std::isnan(Run(mesh, 1, 1).heights[0]) && Run(mesh, 1, 1).count.whole);
  // A wall seen edge-on, a point, a line.
  for (const double z : { 0.0, 5.0, 9.0 })
  {
    add(z == 9.0 ? 3.0 : 1.0, 2.0, z);
  }
  for (int k = 0; k < 3; ++k)
  {
    add(4.0, 4.0, 1.0);
  }
  CHECK(std::isnan(Run(mesh, 8, 8).heights[Run(mesh, 8, 8).At(1, 2)]));
  // What is not finite or far away is counted, and does no harm to others.
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : { std::nan(""), infinity, -infinity, 1e101 })
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      add(axis == 0 ? bad : 0.0, axis == 1 ? bad : 0.0, axis == 2 ? bad : 0.0);
      add(5.0, 0.0, 0.0);
      add(0.0, 5.0, 0.0);
    }
  }
  const Heights bad = Run(mesh, 8, 8);
  CHECK(bad.count.leftOut == 12 && bad.count.whole);
  for (const double height : bad.heights)
  {
    CHECK(std::isnan(height));
  }
  // Large ones are cut exactly, needles too, and heights stay within what the corners have.
  add(-1e90, -1e90, 2.0);
  add(1e90, -1e90, 2.0);
  add(0.0, 1e90, 2.0);
  add(-1e9, 4.0 - 1e-9, 7.0);
  add(1e9, 4.0, 8.0);
  add(-1e9, 4.0 + 1e-9, 7.0);
  const Heights large = Run(mesh, 8, 8);
  for (int j = 0; j < 8; ++j)
  {
    for (int i = 0; i < 8; ++i)
    {
      const double height = large.heights[large.At(i, j)];
      CHECK(j == 4 ? height >= 7.0 && height <= 8.0 : height == 2.0);
    }
  }
}

//------------------------------------------------------------------------------
void TestWeights(unsigned int seed)
{
  std::mt19937_64 random(seed);
  const Mesh mesh = MakeTriangulation(random, 9, 3.0, 57.0, false, true);
  const Heights result = Run(mesh, 60, 60);
  for (int j = 0; j < 60; ++j)
  {
    for (int i = 0; i < 60; ++i)
    {
      const std::uint32_t triangle = result.triangles[result.At(i, j)];
      if (triangle == relief::NoTriangle)
      {
        continue;
      }
      double weights[3];
      relief::FindTriangleWeights(mesh.View(), triangle, i, j, weights);
      double point[3] = { 0.0, 0.0, 0.0 };
      for (int k = 0; k < 3; ++k)
      {
        CHECK(weights[k] >= 0.0);
        for (int axis = 0; axis < 3; ++axis)
        {
          point[axis] +=
            weights[k] * mesh.points[3 * mesh.corners[3 * std::size_t{ triangle } + k] + axis];
        }
      }
      CHECK_NEAR(point[0], i, 1e-9);
      CHECK_NEAR(point[1], j, 1e-9);
      CHECK_NEAR(point[2], result.heights[result.At(i, j)], 1e-9);
    }
  }
}
}

//------------------------------------------------------------------------------
int TestTriangleHeights(int, char*[])
{
  const unsigned int seed = std::random_device()();
  std::cout << "seed " << seed << std::endl;
  TestOrientation(seed);
  TestExact(seed);
  TestNoCracks(seed);
  TestThreads(seed);
  TestHardTriangles();
  TestWeights(seed);
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
