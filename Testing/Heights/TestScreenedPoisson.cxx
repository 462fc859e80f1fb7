// SPDX-License-Identifier: BSD-3-Clause
// ScreenedPoisson: what it solves for, on masks and weak links too; that neither the number of
// samples nor that of threads matters.
#include "ScreenedPoisson.h"

#include "ReliefTestUtilities.h"

#include <cstdlib>
#include <random>
#include <thread>

namespace
{
using relief::LinkGrid;
using relief::ScreenedPoisson;

int Failures = 0;

void Serial(int count, const std::function<void(int, int)>& body)
{
  body(0, count);
}

// Uneven parts on threads of their own.
void Threaded(int count, const std::function<void(int, int)>& body)
{
  const int first = count / 7;
  const int second = count / 2;
  std::thread a([&] { body(0, first); });
  std::thread b([&] { body(first, second); });
  body(second, count);
  a.join();
  b.join();
}

struct Problem
{
  Problem(int columns, int rows)
    : grid(columns, rows)
    , b(grid.Size(), 0.0)
    , x(grid.Size(), 0.0)
  {
  }

  LinkGrid grid;
  std::vector<double> b;
  std::vector<double> x; // what it is made to solve to
};

// Heights at random on a mask with holes, whose links differ by a factor of 1000, and the
// right-hand side that they answer.
Problem MakeProblem(int columns, int rows, double screen, unsigned int seed)
{
  Problem problem(columns, rows);
  LinkGrid& grid = problem.grid;
  std::mt19937 random(seed);
  const auto uniform = [&random] { return random() / 4294967296.0; };
  const double holes = 0.2 * uniform();
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      const std::size_t k = grid.At(i, j);
      const double place = std::sin(0.05 * i + 1.0) * std::sin(0.07 * j);
      grid.mass[k] = place > -0.4 && uniform() > holes ? 1.0f : 0.0f;
      problem.x[k] =
        grid.mass[k] > 0.0f ? std::sin(0.02 * i) * std::cos(0.03 * j) + uniform() : 0.0;
    }
  }
  const auto weight = [&] { return static_cast<float>(std::pow(10.0, 3.0 * uniform() - 2.0)); };
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      const std::size_t k = grid.At(i, j);
      if (grid.mass[k] > 0.0f)
      {
        grid.right[k] = grid.mass[k + 1] > 0.0f ? weight() : 0.0f;
        grid.up[k] = grid.mass[k + grid.Pitch()] > 0.0f ? weight() : 0.0f;
        grid.border[k] = uniform() < 0.05 ? weight() : 0.0f;
      }
    }
  }
  const std::vector<double>& x = problem.x;
  for (int j = 0; j < rows; ++j)
  {
    for (std::size_t k = grid.At(0, j); k < grid.At(columns, j); ++k)
    {
      const int pitch = grid.Pitch();
      problem.b[k] = (grid.border[k] + screen * grid.mass[k]) * x[k] +
        grid.right[k] * (x[k] - x[k + 1]) + grid.right[k - 1] * (x[k] - x[k - 1]) +
        grid.up[k] * (x[k] - x[k + pitch]) + grid.up[k - pitch] * (x[k] - x[k - pitch]);
    }
  }
  return problem;
}

//------------------------------------------------------------------------------
void TestSolutions()
{
  constexpr unsigned int Seed = 20240607;
  std::cout << "seed " << Seed << std::endl;
  const int sizes[][2] = { { 1, 1 }, { 2, 1 }, { 1, 9 }, { 3, 3 }, { 17, 64 }, { 200, 150 } };
  unsigned int seed = Seed;
  for (const auto& size : sizes)
  {
    for (const double screen : { 1e-4, 1e-2, 1.0, 100.0 })
    {
      const Problem problem = MakeProblem(size[0], size[1], screen, ++seed);
      ScreenedPoisson solver(problem.grid, Serial);
      solver.SetScreen(screen);
      std::vector<double> x(problem.b.size(), 0.0);
      const int count = solver.Solve(problem.b, x, 1e-10, 300);
      double worst = 0.0;
      for (std::size_t k = 0; k < x.size(); ++k)
      {
        worst = std::max(worst, std::abs(x[k] - problem.x[k]));
      }
      CHECK(count < 300);
      CHECK_NEAR(worst, 0.0, 1e-6);
      // It stays where it is.
      CHECK(solver.Solve(problem.b, x, 1e-9, 300) == 0);
    }
  }
}

//------------------------------------------------------------------------------
// A dome's slopes, hardly drawn to 0: iterations do not grow with the number of samples.
void TestSizes()
{
  for (const int size : { 60, 240, 480 })
  {
    LinkGrid grid(size, size);
    std::vector<double> b(grid.Size(), 0.0);
    const auto height = [size](int i, int j)
    { return std::cos(3.0 * i / size) * std::sin(2.0 * j / size); };
    for (int j = 0; j < size; ++j)
    {
      for (int i = 0; i < size; ++i)
      {
        const std::size_t k = grid.At(i, j);
        grid.mass[k] = 1.0f;
        const auto link = [&](std::vector<float>& links, std::size_t next, double slope)
        {
          links[k] = 1.0f;
          b[k] -= slope;
          b[next] += slope;
        };
        if (i + 1 < size)
        {
          link(grid.right, k + 1, height(i + 1, j) - height(i, j));
        }
        if (j + 1 < size)
        {
          link(grid.up, k + grid.Pitch(), height(i, j + 1) - height(i, j));
        }
      }
    }
    ScreenedPoisson solver(grid, Serial);
    solver.SetScreen(1e-4 / (size * static_cast<double>(size)));
    std::vector<double> x(grid.Size(), 0.0);
    const int count = solver.Solve(b, x, 1e-6, 100);
    double worst = 0.0;
    const double base = x[grid.At(0, 0)] - height(0, 0);
    for (int j = 0; j < size; ++j)
    {
      for (int i = 0; i < size; ++i)
      {
        worst = std::max(worst, std::abs(x[grid.At(i, j)] - base - height(i, j)));
      }
    }
    std::cout << size << ": " << count << " iterations, error " << worst << std::endl;
    CHECK(count <= 25);
    CHECK_NEAR(worst, 0.0, 1e-3);
  }
}

//------------------------------------------------------------------------------
void TestThreads()
{
  const Problem problem = MakeProblem(300, 200, 1e-3, 11);
  std::vector<double> one(problem.b.size(), 0.0);
  std::vector<double> many = one;
  ScreenedPoisson serial(problem.grid, Serial);
  serial.SetScreen(1e-3);
  serial.Solve(problem.b, one, 1e-6, 100);
  ScreenedPoisson threaded(problem.grid, Threaded);
  threaded.SetScreen(1e-3);
  threaded.Solve(problem.b, many, 1e-6, 100);
  CHECK(one == many);
}

//------------------------------------------------------------------------------
// No sample, nothing to solve for.
void TestNothing()
{
  ScreenedPoisson solver(LinkGrid(5, 4), Serial);
  solver.SetScreen(1.0);
  std::vector<double> b(42, 0.0);
  std::vector<double> x(42, 0.0);
  CHECK(solver.Solve(b, x, 1e-6, 100) == 0 && x == b);
}
}

//------------------------------------------------------------------------------
int TestScreenedPoisson(int, char*[])
{
  TestSolutions();
  TestSizes();
  TestThreads();
  TestNothing();
  return Failures == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
