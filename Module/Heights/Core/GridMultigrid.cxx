// SPDX-License-Identifier: BSD-3-Clause
#include "GridMultigrid.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace relief
{
namespace
{
// Nodes of a block: sweeps of blocks go side by side, and sums are those of blocks, however many
// threads there are.
constexpr int BlockSize = 4096;

// Fewer are done before another thread has come.
constexpr int LeastBlocks = 6;

// A pair is good from this on: its coupling times the sum of the inverses of what each is coupled
// with in all, after Notay 2010. In an even grid it is 1/2.
constexpr double GoodPair = 0.2;

// As large as a group may grow by single nodes that found nobody else, in a round of pairing.
constexpr int LargestGroup = 2;

// From this share of all couplings on the strongest one decides.
constexpr double DominantShare = 0.6;

// What is below this share of the curvature of single nodes is rounding.
constexpr double LeastCurvature = 1e-14;

// A level that is hardly smaller than the one before does not help.
constexpr double LeastReduction = 0.9;

// Sweeps on the last level, whose parts have a few nodes each.
constexpr int LastSweeps = 4;

// A second step on a coarse level is left out where the first one has done this much (Notay 2010).
constexpr double GoodReduction = 0.25;
}

//------------------------------------------------------------------------------
GridMultigrid::GridMultigrid(const HeightEdges& edges, const ParallelFor& parallelFor)
  : Parallel(parallelFor)
{
  // Relative to the largest, so that no product of couplings is out of range.
  double largest = 0.0;
  for (std::size_t at = 0; at < edges.GetSize(); ++at)
  {
    largest = std::max({ largest, edges.weightX[at], edges.weightY[at] });
  }
  const double scale = largest > 0.0 ? 1.0 / largest : 0.0;
  this->Scale = scale;
  const auto couple = [scale](double weight) { return weight * scale; };
  std::vector<int> nodes(edges.GetSize(), -1);
  const auto columns = static_cast<std::size_t>(edges.columns);
  // An edge beyond the grid weighs 0, so the left neighbour of a first column is none.
  const auto left = [&](std::size_t at) { return at > 0 ? couple(edges.weightX[at - 1]) : 0.0; };
  const auto below = [&](std::size_t at)
  { return at >= columns ? couple(edges.weightY[at - columns]) : 0.0; };
  for (std::size_t at = 0; at < edges.GetSize(); ++at)
  {
    const double right = couple(edges.weightX[at]);
    if (right + couple(edges.weightY[at]) + left(at) + below(at) > 0.0)
    {
      nodes[at] = static_cast<int>(this->Samples.size());
      this->Samples.push_back(at);
    }
  }
  Graph graph;
  graph.first.reserve(this->Samples.size() + 1);
  graph.first.push_back(0);
  for (const std::size_t at : this->Samples)
  {
    const auto add = [&](double coupling, std::size_t other)
    {
      if (coupling > 0.0)
      {
        graph.neighbors.push_back(nodes[other]);
        graph.couplings.push_back(coupling);
      }
    };
    add(couple(edges.weightX[at]), at + 1);
    add(couple(edges.weightY[at]), at + columns);
    add(left(at), at - 1);
    add(below(at), at - columns);
    graph.first.push_back(static_cast<int>(graph.neighbors.size()));
  }
  this->AddLevels(std::move(graph));
}

//------------------------------------------------------------------------------
// Joins nodes in pairs that are strongly coupled for both, then those left over to the group of
// their strongest neighbour. Returns each node's group; -1 for those without neighbours.
std::vector<int> GridMultigrid::Pair(const Graph& graph, int& count)
{
  const int size = graph.GetSize();
  std::vector<int> groups(static_cast<std::size_t>(size), -1);
  std::vector<double> strongest(static_cast<std::size_t>(size), 0.0);
  std::vector<int> best(static_cast<std::size_t>(size), -1);
  std::vector<double> sums(static_cast<std::size_t>(size), 0.0);
  for (int node = 0; node < size; ++node)
  {
    for (int k = graph.first[node]; k < graph.first[node + 1]; ++k)
    {
      sums[node] += graph.couplings[k];
      if (graph.couplings[k] > strongest[node])
      {
        strongest[node] = graph.couplings[k];
        best[node] = graph.neighbors[k];
      }
    }
  }
  std::vector<int> sizes;
  const auto open = [&](int node)
  {
    groups[node] = static_cast<int>(sizes.size());
    sizes.push_back(1);
  };
  const auto join = [&](int node, int group)
  {
    groups[node] = group;
    ++sizes[group];
  };
  for (int node = 0; node < size; ++node)
  {
    double most = GoodPair;
    int partner = -1;
    for (int k = graph.first[node]; k < graph.first[node + 1] && groups[node] < 0; ++k)
    {
      const int other = graph.neighbors[k];
      const double quality = graph.couplings[k] * (1.0 / sums[node] + 1.0 / sums[other]);
      if (groups[other] < 0 && quality > most)
      {
        most = quality;
        partner = other;
      }
    }
    if (partner >= 0)
    {
      open(node);
      join(partner, groups[node]);
    }
  }
  // A node that depends on one neighbour may join it however many others do, as all of them are one
  // step from it; those that joined so take nobody in.
  const std::vector<int> paired = groups;
  for (int node = 0; node < size; ++node)
  {
    if (groups[node] >= 0 || best[node] < 0)
    {
      continue;
    }
    const int group = groups[best[node]];
    const bool leaf = strongest[node] >= DominantShare * sums[node] && paired[best[node]] >= 0;
    if (group >= 0 && (leaf || sizes[group] < LargestGroup))
    {
      join(node, group);
    }
    else
    {
      open(node);
    }
  }
  count = static_cast<int>(sizes.size());
  return groups;
}

//------------------------------------------------------------------------------
void GridMultigrid::ListMembers(const std::vector<int>& coarse, int count,
  std::vector<int>& firstMember, std::vector<int>& members)
{
  firstMember.assign(static_cast<std::size_t>(count) + 1, 0);
  for (const int group : coarse)
  {
    if (group >= 0)
    {
      ++firstMember[group + 1];
    }
  }
  for (int group = 0; group < count; ++group)
  {
    firstMember[group + 1] += firstMember[group];
  }
  members.resize(static_cast<std::size_t>(firstMember[count]));
  std::vector<int> next(firstMember.begin(), firstMember.end() - 1);
  for (std::size_t node = 0; node < coarse.size(); ++node)
  {
    if (coarse[node] >= 0)
    {
      members[next[coarse[node]]++] = static_cast<int>(node);
    }
  }
}

//------------------------------------------------------------------------------
// The graph of groups: couplings between two groups add up.
GridMultigrid::Graph GridMultigrid::Join(const Graph& fine, const std::vector<int>& firstMember,
  const std::vector<int>& members, const std::vector<int>& coarse)
{
  const int count = static_cast<int>(firstMember.size()) - 1;
  Graph result;
  result.first.reserve(firstMember.size());
  result.first.push_back(0);
  std::vector<int> places(static_cast<std::size_t>(count), -1);
  for (int group = 0; group < count; ++group)
  {
    const int begin = result.first.back();
    for (int m = firstMember[group]; m < firstMember[group + 1]; ++m)
    {
      for (int k = fine.first[members[m]]; k < fine.first[members[m] + 1]; ++k)
      {
        const int other = coarse[fine.neighbors[k]];
        if (other == group)
        {
          continue;
        }
        if (places[other] < begin)
        {
          places[other] = static_cast<int>(result.neighbors.size());
          result.neighbors.push_back(other);
          result.couplings.push_back(0.0);
        }
        result.couplings[places[other]] += fine.couplings[k];
      }
    }
    result.first.push_back(static_cast<int>(result.neighbors.size()));
  }
  return result;
}

//------------------------------------------------------------------------------
// Orders a node's neighbours: those before it in its block, those after it, those of other blocks,
// which sweeps do not see. A pivot that counts couplings to those half as much again keeps what two
// blocks do at once from doing too much. (A. H. Baker et al., "Multigrid smoothers for
// ultraparallel computing", SIAM J. Sci. Comput. 33, 2011.)
void GridMultigrid::PrepareSweeps(Level& level)
{
  Graph& graph = level.graph;
  const int size = graph.GetSize();
  level.pivots.resize(static_cast<std::size_t>(size));
  level.middle.resize(static_cast<std::size_t>(size));
  level.inside.resize(static_cast<std::size_t>(size));
  std::vector<std::pair<int, double>> row;
  for (int node = 0; node < size; ++node)
  {
    row.clear();
    double sum = 0.0;
    for (int k = graph.first[node]; k < graph.first[node + 1]; ++k)
    {
      row.emplace_back(graph.neighbors[k], graph.couplings[k]);
    }
    int next = graph.first[node];
    const auto place = [&](bool inside, bool before, double share)
    {
      for (const std::pair<int, double>& entry : row)
      {
        const bool isInside = entry.first / BlockSize == node / BlockSize;
        if (isInside == inside && (!inside || (entry.first < node) == before))
        {
          graph.neighbors[next] = entry.first;
          graph.couplings[next++] = entry.second;
          sum += share * entry.second;
        }
      }
      return next;
    };
    level.middle[node] = place(true, true, 1.0);
    level.inside[node] = place(true, false, 1.0);
    place(false, false, 1.5);
    level.pivots[node] = sum > 0.0 ? 1.0 / sum : 0.0;
  }
}

//------------------------------------------------------------------------------
void GridMultigrid::AddLevels(Graph&& graph)
{
  while (graph.GetSize() > 0)
  {
    this->Levels.emplace_back();
    Level& level = this->Levels.back();
    level.graph = std::move(graph);
    const auto size = static_cast<std::size_t>(level.graph.GetSize());
    PrepareSweeps(level);
    level.residual.resize(size);
    level.solution.resize(size);
    level.work.resize(size);
    if (this->Levels.size() > 1)
    {
      level.firstDirection.resize(size);
      level.firstImage.resize(size);
      level.secondImage.resize(size);
    }
    // Two rounds of pairs make groups of four.
    int count = 0;
    std::vector<int> members;
    std::vector<int> firstMember;
    const std::vector<int> pairs = Pair(level.graph, count);
    ListMembers(pairs, count, firstMember, members);
    const Graph joined = Join(level.graph, firstMember, members, pairs);
    const std::vector<int> groups = Pair(joined, count);
    level.coarse.resize(size);
    for (std::size_t node = 0; node < size; ++node)
    {
      level.coarse[node] = pairs[node] >= 0 ? groups[pairs[node]] : -1;
    }
    ListMembers(groups, count, firstMember, members);
    graph = Join(joined, firstMember, members, groups);
    ListMembers(level.coarse, count, level.firstMember, level.members);
    if (count > LeastReduction * static_cast<double>(size))
    {
      return;
    }
  }
}

//------------------------------------------------------------------------------
void GridMultigrid::ForNodes(int count, const std::function<void(int, int)>& body) const
{
  const int blocks = (count + BlockSize - 1) / BlockSize;
  const auto some = [&](int begin, int end)
  {
    for (int block = begin; block < end; ++block)
    {
      body(block * BlockSize, std::min(count, (block + 1) * BlockSize));
    }
  };
  if (blocks < LeastBlocks)
  {
    some(0, blocks);
  }
  else
  {
    this->Parallel(blocks, some);
  }
}

//------------------------------------------------------------------------------
double GridMultigrid::Sum(const std::vector<double>& a, const std::vector<double>& b) const
{
  std::vector<double> sums((a.size() + BlockSize - 1) / BlockSize);
  this->ForNodes(static_cast<int>(a.size()),
    [&](int begin, int end)
    {
      double sum = 0.0;
      for (int node = begin; node < end; ++node)
      {
        sum += a[node] * b[node];
      }
      sums[begin / BlockSize] = sum;
    });
  double sum = 0.0;
  for (const double block : sums)
  {
    sum += block;
  }
  return sum;
}

//------------------------------------------------------------------------------
// Squares of a level's solution, weighed as they would be if all neighbours were 0.
double GridMultigrid::SumWeighted(const Level& level) const
{
  double sum = 0.0;
  for (std::size_t node = 0; node < level.solution.size(); ++node)
  {
    const double value = level.solution[node];
    sum += level.pivots[node] > 0.0 ? value * value / level.pivots[node] : 0.0;
  }
  return sum;
}

//------------------------------------------------------------------------------
void GridMultigrid::Multiply(
  const Graph& graph, const std::vector<double>& x, std::vector<double>& result) const
{
  this->ForNodes(graph.GetSize(),
    [&](int begin, int end)
    {
      for (int node = begin; node < end; ++node)
      {
        double sum = 0.0;
        for (int k = graph.first[node]; k < graph.first[node + 1]; ++k)
        {
          sum += graph.couplings[k] * (x[node] - x[graph.neighbors[k]]);
        }
        result[node] = sum;
      }
    });
}

//------------------------------------------------------------------------------
// A sweep of Gauss-Seidel from 0, within blocks: forth with the nodes before, back with those
// after.
void GridMultigrid::Sweep(const Level& level, bool forth, std::vector<double>& values) const
{
  const Graph& graph = level.graph;
  this->ForNodes(graph.GetSize(),
    [&](int begin, int end)
    {
      const int step = forth ? 1 : -1;
      const std::vector<int>& from = forth ? graph.first : level.middle;
      const std::vector<int>& to = forth ? level.middle : level.inside;
      for (int node = forth ? begin : end - 1; node >= begin && node < end; node += step)
      {
        double sum = values[node];
        for (int k = from[node]; k < to[node]; ++k)
        {
          sum += graph.couplings[k] * values[graph.neighbors[k]];
        }
        values[node] = sum * level.pivots[node];
      }
    });
}

//------------------------------------------------------------------------------
// Adds what a sweep makes of the rest.
void GridMultigrid::Smooth(Level& level, bool forth) const
{
  const Graph& graph = level.graph;
  const std::vector<double>& x = level.solution;
  this->ForNodes(graph.GetSize(),
    [&](int begin, int end)
    {
      for (int node = begin; node < end; ++node)
      {
        double rest = level.residual[node];
        for (int k = graph.first[node]; k < graph.first[node + 1]; ++k)
        {
          rest -= graph.couplings[k] * (x[node] - x[graph.neighbors[k]]);
        }
        level.work[node] = rest;
      }
    });
  this->Sweep(level, forth, level.work);
  this->AddTo(level.solution, 1.0, level.work);
}

//------------------------------------------------------------------------------
void GridMultigrid::AddTo(std::vector<double>& a, double factor, const std::vector<double>& b) const
{
  this->ForNodes(static_cast<int>(a.size()),
    [&](int begin, int end)
    {
      for (int node = begin; node < end; ++node)
      {
        a[node] += factor * b[node];
      }
    });
}

//------------------------------------------------------------------------------
// What is left to do goes to the next level, group by group.
void GridMultigrid::Restrict(const Level& fine, Level& coarse) const
{
  const Graph& graph = fine.graph;
  this->ForNodes(coarse.graph.GetSize(),
    [&](int begin, int end)
    {
      for (int group = begin; group < end; ++group)
      {
        double sum = 0.0;
        for (int m = fine.firstMember[group]; m < fine.firstMember[group + 1]; ++m)
        {
          const int node = fine.members[m];
          double rest = fine.residual[node];
          for (int k = graph.first[node]; k < graph.first[node + 1]; ++k)
          {
            rest -= graph.couplings[k] * (fine.solution[node] - fine.solution[graph.neighbors[k]]);
          }
          sum += rest;
        }
        coarse.residual[group] = sum;
      }
    });
}

//------------------------------------------------------------------------------
// From the residual of a level, its solution.
void GridMultigrid::Cycle(std::size_t at)
{
  Level& level = this->Levels[at];
  level.solution = level.residual;
  this->Sweep(level, true, level.solution);
  if (at + 1 == this->Levels.size())
  {
    for (int sweep = 1; sweep < LastSweeps; ++sweep)
    {
      this->Smooth(level, sweep % 2 == 0);
    }
    return;
  }
  this->Restrict(level, this->Levels[at + 1]);
  this->TwoCycles(at + 1);
  const std::vector<double>& coarse = this->Levels[at + 1].solution;
  this->ForNodes(level.graph.GetSize(),
    [&](int begin, int end)
    {
      for (int node = begin; node < end; ++node)
      {
        level.solution[node] += level.coarse[node] >= 0 ? coarse[level.coarse[node]] : 0.0;
      }
    });
  this->Smooth(level, false);
}

//------------------------------------------------------------------------------
// Two steps of conjugate gradients with cycles as their preconditioner: groups that are constant
// correct too little by themselves.
void GridMultigrid::TwoCycles(std::size_t at)
{
  Level& level = this->Levels[at];
  this->Cycle(at);
  this->Multiply(level.graph, level.solution, level.firstImage);
  const double curvature = this->Sum(level.solution, level.firstImage);
  const double slope = this->Sum(level.solution, level.residual);
  // Levels of parts are free: where rounding left nothing but these, a step would be without
  // bounds.
  if (!(curvature > LeastCurvature * this->SumWeighted(level)))
  {
    std::fill(level.solution.begin(), level.solution.end(), 0.0);
    return;
  }
  const double before = this->Sum(level.residual, level.residual);
  level.firstDirection = level.solution;
  this->AddTo(level.residual, -slope / curvature, level.firstImage);
  const double after = this->Sum(level.residual, level.residual);
  double first = slope / curvature;
  double second = 0.0;
  // Two visits of levels that do not become half as large would take ever longer.
  const bool small = 2 * level.graph.GetSize() <= this->Levels[at - 1].graph.GetSize();
  if (small && after > GoodReduction * GoodReduction * before)
  {
    this->Cycle(at);
    this->Multiply(level.graph, level.solution, level.secondImage);
    const double mixed = this->Sum(level.solution, level.firstImage);
    const double own = this->Sum(level.solution, level.secondImage) - mixed * mixed / curvature;
    if (own > 0.0)
    {
      second = this->Sum(level.solution, level.residual) / own;
      first -= mixed * second / curvature;
    }
  }
  const auto factor = first;
  const auto secondFactor = second;
  this->ForNodes(level.graph.GetSize(),
    [&](int begin, int end)
    {
      for (int node = begin; node < end; ++node)
      {
        level.solution[node] =
          factor * level.firstDirection[node] + secondFactor * level.solution[node];
      }
    });
}

//------------------------------------------------------------------------------
void GridMultigrid::Solve(const std::vector<double>& residual, std::vector<double>& correction)
{
  correction.assign(residual.size(), 0.0);
  double largest = 0.0;
  for (const std::size_t at : this->Samples)
  {
    largest = std::max(largest, std::abs(residual[at]));
  }
  if (!(largest > 0.0) || !std::isfinite(largest))
  {
    return;
  }
  Level& finest = this->Levels.front();
  const int size = finest.graph.GetSize();
  const double scale = 1.0 / largest;
  this->ForNodes(size,
    [&](int begin, int end)
    {
      for (int node = begin; node < end; ++node)
      {
        finest.residual[node] = residual[this->Samples[node]] * scale;
      }
    });
  this->Cycle(0);
  // The couplings were divided by the largest weight.
  const double back = largest * this->Scale;
  this->ForNodes(size,
    [&](int begin, int end)
    {
      for (int node = begin; node < end; ++node)
      {
        correction[this->Samples[node]] = back * finest.solution[node];
      }
    });
}

}
