// SPDX-License-Identifier: BSD-3-Clause
#ifndef ScreenedPoisson_h
#define ScreenedPoisson_h

#include "ParallelFor.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace relief
{

/// Samples of a grid and how they are linked, with a margin of one sample to all sides whose values
/// are 0. The energy of values x is the sum over
///  - links to the right: right * (x[i + 1, j] - x[i, j])^2, and up likewise,
///  - samples: border * x^2 + screen * mass * x^2,
/// less twice the sum of b * x for a right-hand side b.
struct LinkGrid
{
  LinkGrid(int width, int height);

  int columns;
  int rows;
  std::vector<float> right;
  std::vector<float> up;
  std::vector<float> border; ///< the weight of a link to a neighbor that is held at 0
  std::vector<float> mass;   ///< 1 for a sample, 0 for none: it then needs to be without links

  int Pitch() const { return this->columns + 2; }
  std::size_t At(int i, int j) const
  {
    return static_cast<std::size_t>(j + 1) * this->Pitch() + i + 1;
  }
  std::size_t Size() const { return this->right.size(); }

  ///@{
  /// A grid of half as many columns and rows, rounded up, and what stands to its right: two links
  /// side by side become one that is twice as long, which has half their sum; all else is summed.
  /// Its solution is about this one's.
  LinkGrid Halved() const { return { (this->columns + 1) / 2, (this->rows + 1) / 2 }; }
  void Coarsen(LinkGrid& coarse, int j) const; // a row
  std::vector<double> Coarsen(const LinkGrid& coarse, const std::vector<double>& b) const;
  ///@}
};

/// Finds the values of least energy by conjugate gradients with a W-cycle of multigrid for a
/// preconditioner: blocks of 2 x 2 samples become one, so that masks and weak links need nothing of
/// their own. Some 20 iterations, however many samples there are. All sums are by rows in a fixed
/// order: results do not depend on the number of threads. (U. Trottenberg, C. Oosterlee,
/// A. Schueller, "Multigrid", 2001, sections 7.8 and A.6.) Takes 70 bytes a sample.
class ScreenedPoisson
{
public:
  ScreenedPoisson(LinkGrid grid, const ParallelFor& parallelFor);

  /// How strongly samples are drawn to 0; larger than 0. Its inverse root is the length, in
  /// samples, over which forms are kept.
  void SetScreen(double screen);

  /// The links, which may be changed before SetScreen() is called.
  LinkGrid& GetGrid() { return this->Levels.front().grid; }

  /// Improves x until its residual is `tolerance` of what b is, or for a number of iterations;
  /// returns how many there were. Both have the margin.
  int Solve(const std::vector<double>& b, std::vector<double>& x, double tolerance, int most);

private:
  struct Level
  {
    explicit Level(LinkGrid links);

    LinkGrid grid;
    std::vector<float> inverse; // of the diagonal; 0 where there is no sample
    std::vector<float> b;
    std::vector<float> x;
  };

  void ForRows(const Level& level, const std::function<void(int)>& body) const;
  double SumRows(const std::function<double(int)>& row);
  void Relax(Level& level, int color) const;
  void Restrict(const Level& fine, Level& coarse) const;
  void Prolong(const Level& coarse, Level& fine) const;
  void Cycle(std::size_t depth);
  void Precondition(const std::vector<double>& r, std::vector<double>& z);
  double Apply(const std::vector<double>& p, std::vector<double>& q);
  double Dot(const std::vector<double>& a, const std::vector<double>& b);

  ParallelFor Parallel;
  std::vector<Level> Levels;
  std::vector<double> Sums;
  double Screen = 1.0;
};

}

#endif
