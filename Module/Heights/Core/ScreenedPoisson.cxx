// SPDX-License-Identifier: BSD-3-Clause
#include "ScreenedPoisson.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relief
{

namespace
{
constexpr int FewSamples = 16384; // threads are not worth it
constexpr int CoarsestSweeps = 16;
}

//------------------------------------------------------------------------------
LinkGrid::LinkGrid(int width, int height)
  : columns(width)
  , rows(height)
  , right(static_cast<std::size_t>(width + 2) * (height + 2), 0.0f)
  , up(this->right.size(), 0.0f)
  , border(this->right.size(), 0.0f)
  , mass(this->right.size(), 0.0f)
{
}

//------------------------------------------------------------------------------
ScreenedPoisson::Level::Level(LinkGrid links)
  : grid(std::move(links))
  , inverse(this->grid.Size(), 0.0f)
  , b(this->grid.Size(), 0.0f)
  , x(this->grid.Size(), 0.0f)
{
}

//------------------------------------------------------------------------------
ScreenedPoisson::ScreenedPoisson(LinkGrid grid, const ParallelFor& parallelFor)
  : Parallel(parallelFor)
  , Sums(static_cast<std::size_t>(grid.rows))
{
  this->Levels.emplace_back(std::move(grid));
  for (int x = this->Levels[0].grid.columns, y = this->Levels[0].grid.rows; x > 2 || y > 2;)
  {
    x = (x + 1) / 2;
    y = (y + 1) / 2;
    this->Levels.emplace_back(LinkGrid(x, y));
  }
}

//------------------------------------------------------------------------------
void ScreenedPoisson::ForRows(const Level& level, const std::function<void(int)>& body) const
{
  const auto part = [&body](int begin, int end)
  {
    for (int j = begin; j < end; ++j)
    {
      body(j);
    }
  };
  if (level.grid.columns * static_cast<double>(level.grid.rows) <= FewSamples)
  {
    part(0, level.grid.rows);
    return;
  }
  this->Parallel(level.grid.rows, part);
}

//------------------------------------------------------------------------------
// The sum over the rows of the finest level.
double ScreenedPoisson::SumRows(const std::function<double(int)>& row)
{
  this->ForRows(this->Levels[0], [&](int j) { this->Sums[j] = row(j); });
  double sum = 0.0;
  for (const double part : this->Sums)
  {
    sum += part;
  }
  return sum;
}

//------------------------------------------------------------------------------
// Beyond the last column or row lies the margin, where all is 0.
void LinkGrid::Coarsen(LinkGrid& coarse, int j) const
{
  for (int i = 0; i < coarse.columns; ++i)
  {
    const std::size_t at = this->At(2 * i, 2 * j);
    const std::size_t above = at + this->Pitch();
    const auto sum = [&](const std::vector<float>& v)
    { return v[at] + v[at + 1] + v[above] + v[above + 1]; };
    const std::size_t k = coarse.At(i, j);
    coarse.mass[k] = sum(this->mass);
    coarse.border[k] = 0.5f * sum(this->border);
    coarse.right[k] = 0.5f * (this->right[at + 1] + this->right[above + 1]);
    coarse.up[k] = 0.5f * (this->up[above] + this->up[above + 1]);
  }
}

//------------------------------------------------------------------------------
std::vector<double> LinkGrid::Coarsen(const LinkGrid& coarse, const std::vector<double>& b) const
{
  std::vector<double> sums(coarse.Size(), 0.0);
  for (int j = 0; j < coarse.rows; ++j)
  {
    for (int i = 0; i < coarse.columns; ++i)
    {
      const std::size_t at = this->At(2 * i, 2 * j);
      const std::size_t above = at + this->Pitch();
      sums[coarse.At(i, j)] = b[at] + b[at + 1] + b[above] + b[above + 1];
    }
  }
  return sums;
}

//------------------------------------------------------------------------------
void ScreenedPoisson::SetScreen(double screen)
{
  this->Screen = screen;
  for (std::size_t depth = 0; depth < this->Levels.size(); ++depth)
  {
    Level& level = this->Levels[depth];
    if (depth > 0)
    {
      const LinkGrid& fine = this->Levels[depth - 1].grid;
      this->ForRows(level, [&](int j) { fine.Coarsen(level.grid, j); });
    }
    const LinkGrid& grid = level.grid;
    this->ForRows(level,
      [&](int j)
      {
        for (std::size_t k = grid.At(0, j); k < grid.At(grid.columns, j); ++k)
        {
          const double diagonal = static_cast<double>(grid.right[k]) + grid.right[k - 1] +
            grid.up[k] + grid.up[k - grid.Pitch()] + grid.border[k] + screen * grid.mass[k];
          level.inverse[k] = grid.mass[k] > 0.0f ? static_cast<float>(1.0 / diagonal) : 0.0f;
        }
      });
  }
}

//------------------------------------------------------------------------------
// Gauss-Seidel over every other sample, as on a chess-board.
void ScreenedPoisson::Relax(Level& level, int color) const
{
  const LinkGrid& grid = level.grid;
  const int pitch = grid.Pitch();
  const float* right = grid.right.data();
  const float* up = grid.up.data();
  float* x = level.x.data();
  this->ForRows(level,
    [&](int j)
    {
      const std::size_t end = grid.At(grid.columns, j);
      for (std::size_t k = grid.At((j + color) & 1, j); k < end; k += 2)
      {
        x[k] = level.inverse[k] *
          (level.b[k] + right[k] * x[k + 1] + right[k - 1] * x[k - 1] + up[k] * x[k + pitch] +
            up[k - pitch] * x[k - pitch]);
      }
    });
}

//------------------------------------------------------------------------------
void ScreenedPoisson::Restrict(const Level& fine, Level& coarse) const
{
  const LinkGrid& grid = fine.grid;
  const int pitch = grid.Pitch();
  const auto residual = [&](std::size_t k)
  {
    if (!(grid.mass[k] > 0.0f))
    {
      return 0.0f;
    }
    const float* x = fine.x.data();
    return fine.b[k] + grid.right[k] * x[k + 1] + grid.right[k - 1] * x[k - 1] +
      grid.up[k] * x[k + pitch] + grid.up[k - pitch] * x[k - pitch] - x[k] / fine.inverse[k];
  };
  this->ForRows(coarse,
    [&](int j)
    {
      for (int i = 0; i < coarse.grid.columns; ++i)
      {
        const std::size_t k = grid.At(2 * i, 2 * j);
        // Beyond the last column or row lies the margin, which has no mass.
        coarse.b[coarse.grid.At(i, j)] =
          residual(k) + residual(k + 1) + residual(k + pitch) + residual(k + pitch + 1);
      }
    });
}

//------------------------------------------------------------------------------
void ScreenedPoisson::Prolong(const Level& coarse, Level& fine) const
{
  const LinkGrid& grid = fine.grid;
  this->ForRows(fine,
    [&](int j)
    {
      for (int i = 0; i < grid.columns; ++i)
      {
        const std::size_t k = grid.At(i, j);
        fine.x[k] += grid.mass[k] > 0.0f ? coarse.x[coarse.grid.At(i / 2, j / 2)] : 0.0f;
      }
    });
}

//------------------------------------------------------------------------------
// The order of colors is turned around on the way back: the preconditioner has to be symmetric.
void ScreenedPoisson::Cycle(std::size_t depth)
{
  Level& level = this->Levels[depth];
  const bool coarsest = depth + 1 == this->Levels.size();
  const int sweeps = coarsest ? CoarsestSweeps : 2;
  for (int sweep = 0; sweep < sweeps; ++sweep)
  {
    this->Relax(level, 0);
    this->Relax(level, 1);
  }
  if (!coarsest)
  {
    // Coarse levels cost little, and are gone through twice: a W-cycle.
    Level& coarse = this->Levels[depth + 1];
    std::fill(coarse.x.begin(), coarse.x.end(), 0.0f);
    this->Restrict(level, coarse);
    this->Cycle(depth + 1);
    this->Cycle(depth + 1);
    this->Prolong(coarse, level);
  }
  for (int sweep = 0; sweep < sweeps; ++sweep)
  {
    this->Relax(level, 1);
    this->Relax(level, 0);
  }
}

//------------------------------------------------------------------------------
void ScreenedPoisson::Precondition(const std::vector<double>& r, std::vector<double>& z)
{
  Level& level = this->Levels[0];
  this->ForRows(level,
    [&](int j)
    {
      for (std::size_t k = level.grid.At(0, j); k < level.grid.At(level.grid.columns, j); ++k)
      {
        level.b[k] = static_cast<float>(r[k]);
      }
    });
  std::fill(level.x.begin(), level.x.end(), 0.0f);
  this->Cycle(0);
  this->ForRows(level,
    [&](int j)
    {
      for (std::size_t k = level.grid.At(0, j); k < level.grid.At(level.grid.columns, j); ++k)
      {
        z[k] = level.x[k];
      }
    });
}

//------------------------------------------------------------------------------
// q becomes the matrix times p; returns p * q.
double ScreenedPoisson::Apply(const std::vector<double>& p, std::vector<double>& q)
{
  const LinkGrid& grid = this->Levels[0].grid;
  const int pitch = grid.Pitch();
  return this->SumRows(
    [&](int j)
    {
      double sum = 0.0;
      for (std::size_t k = grid.At(0, j); k < grid.At(grid.columns, j); ++k)
      {
        q[k] = (grid.border[k] + this->Screen * grid.mass[k]) * p[k] +
          grid.right[k] * (p[k] - p[k + 1]) + grid.right[k - 1] * (p[k] - p[k - 1]) +
          grid.up[k] * (p[k] - p[k + pitch]) + grid.up[k - pitch] * (p[k] - p[k - pitch]);
        sum += p[k] * q[k];
      }
      return sum;
    });
}

//------------------------------------------------------------------------------
double ScreenedPoisson::Dot(const std::vector<double>& a, const std::vector<double>& b)
{
  const LinkGrid& grid = this->Levels[0].grid;
  return this->SumRows(
    [&](int j)
    {
      double sum = 0.0;
      for (std::size_t k = grid.At(0, j); k < grid.At(grid.columns, j); ++k)
      {
        sum += a[k] * b[k];
      }
      return sum;
    });
}

//------------------------------------------------------------------------------
int ScreenedPoisson::Solve(
  const std::vector<double>& b, std::vector<double>& x, double tolerance, int most)
{
  const Level& level = this->Levels[0];
  std::vector<double> r(b.size(), 0.0);
  std::vector<double> z(b.size(), 0.0);
  std::vector<double> q(b.size(), 0.0);
  const auto combine = [&](std::vector<double>& to, double factor, const std::vector<double>& with)
  {
    this->ForRows(level,
      [&](int j)
      {
        for (std::size_t k = level.grid.At(0, j); k < level.grid.At(level.grid.columns, j); ++k)
        {
          to[k] += factor * with[k];
        }
      });
  };
  this->Apply(x, q);
  r = b;
  combine(r, -1.0, q);
  const double enough = tolerance * tolerance * this->Dot(b, b);
  this->Precondition(r, z);
  std::vector<double> p = z;
  double rz = this->Dot(r, z);
  int count = 0;
  while (count < most && rz > 0.0 && this->Dot(r, r) > enough)
  {
    const double pq = this->Apply(p, q);
    if (!(pq > 0.0))
    {
      break; // nothing but rounding is left
    }
    combine(x, rz / pq, p);
    combine(r, -rz / pq, q);
    this->Precondition(r, z);
    const double next = this->Dot(r, z);
    const double beta = next / rz;
    this->ForRows(level,
      [&](int j)
      {
        for (std::size_t k = level.grid.At(0, j); k < level.grid.At(level.grid.columns, j); ++k)
        {
          p[k] = z[k] + beta * p[k];
        }
      });
    rz = next;
    ++count;
  }
  return count;
}

}
