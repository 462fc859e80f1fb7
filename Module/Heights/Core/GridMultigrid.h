// SPDX-License-Identifier: BSD-3-Clause
#ifndef GridMultigrid_h
#define GridMultigrid_h

#include "HeightEdges.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace relief
{

/// Solves the normal equations of edges roughly, on any domain and with any weights. Samples are
/// joined to their strongest neighbours, pairs to pairs, until each connected part is one; what the
/// parts want as a whole corrects their samples. (Y. Notay, "An aggregation-based algebraic
/// multigrid method", ETNA 37, 2010, with K-cycles and a Gauss-Seidel sweep on either side.)
/// Results do not depend on how the work is shared out. Needs about 200 bytes a sample of the
/// domain.
class GridMultigrid
{
public:
  GridMultigrid(const HeightEdges& edges, const ParallelFor& parallelFor);

  /// Of a residual, a correction of the heights; 0 where no edge is.
  void Solve(const std::vector<double>& residual, std::vector<double>& correction);

private:
  /// Neighbours of each node, and how they are coupled. Sums of rows are 0: a node's own factor is
  /// the sum of its couplings.
  struct Graph
  {
    std::vector<int> first; ///< where a node's neighbours begin; one more than nodes
    std::vector<int> neighbors;
    std::vector<double> couplings;

    int GetSize() const { return static_cast<int>(this->first.size()) - 1; }
  };

  struct Level
  {
    Graph graph;
    std::vector<int> middle;    ///< where neighbours in the same block begin that are after a node
    std::vector<int> inside;    ///< where those of other blocks begin
    std::vector<double> pivots; ///< what a sweep divides by, inverted
    std::vector<int> coarse;    ///< the node of the next level; -1 where nothing is left to know
    std::vector<int> firstMember; ///< where a coarse node's members begin
    std::vector<int> members;
    std::vector<double> residual;
    std::vector<double> solution;
    std::vector<double> work;
    // Of the two steps of a K-cycle.
    std::vector<double> firstDirection;
    std::vector<double> firstImage;
    std::vector<double> secondImage;
  };

  static std::vector<int> Pair(const Graph& graph, int& count);
  static Graph Join(const Graph& fine, const std::vector<int>& firstMember,
    const std::vector<int>& members, const std::vector<int>& coarse);
  static void ListMembers(const std::vector<int>& coarse, int count, std::vector<int>& firstMember,
    std::vector<int>& members);
  static void PrepareSweeps(Level& level);
  void AddLevels(Graph&& graph);

  void ForNodes(int count, const std::function<void(int, int)>& body) const;
  double Sum(const std::vector<double>& a, const std::vector<double>& b) const;
  double SumWeighted(const Level& level) const;
  void Multiply(
    const Graph& graph, const std::vector<double>& x, std::vector<double>& result) const;
  void AddTo(std::vector<double>& a, double factor, const std::vector<double>& b) const;
  void Sweep(const Level& level, bool forth, std::vector<double>& values) const;
  void Smooth(Level& level, bool forth) const;
  void Restrict(const Level& fine, Level& coarse) const;
  void Cycle(std::size_t at);
  void TwoCycles(std::size_t at);

  ParallelFor Parallel;
  double Scale = 0.0;               ///< of couplings against weights
  std::vector<std::size_t> Samples; ///< where the nodes of the first level lie
  std::vector<Level> Levels;
};

}

#endif
