// SPDX-License-Identifier: BSD-3-Clause
#include "PathSums.h"

namespace relief
{

//------------------------------------------------------------------------------
std::vector<double> SumPaths(
  const NormalMap& map, const NormalIntegration& integration, const ParallelFor& parallelFor)
{
  const HeightEdges edges = MakeEdges(map, integration, parallelFor);
  const auto columns = static_cast<std::size_t>(map.columns);
  std::vector<double> heights(map.GetSize());
  std::vector<unsigned char> seen(map.GetSize());
  // Samples that runs were reached at, first come, first served.
  struct Touch
  {
    std::size_t at;
    double height;
  };
  std::vector<Touch> touches;
  const auto touch = [&](std::size_t at, double height)
  {
    if (map.used[at] && !seen[at])
    {
      touches.push_back({ at, height });
    }
  };
  for (std::size_t start = 0; start < map.GetSize(); ++start)
  {
    if (!map.used[start] || seen[start])
    {
      continue;
    }
    touches.assign(1, Touch{ start, 0.0 });
    std::size_t next = 0;
    while (next < touches.size())
    {
      const Touch reached = touches[next++];
      const std::size_t at = reached.at;
      if (seen[at])
      {
        continue;
      }
      seen[at] = 1;
      heights[at] = reached.height;
      const std::size_t row = at / columns * columns;
      std::size_t first = at;
      for (; first > row && map.used[first - 1] && !seen[first - 1]; --first)
      {
        seen[first - 1] = 1;
        heights[first - 1] = heights[first] - edges.riseX[first - 1];
      }
      std::size_t last = at;
      for (; last + 1 < row + columns && map.used[last + 1] && !seen[last + 1]; ++last)
      {
        seen[last + 1] = 1;
        heights[last + 1] = heights[last] + edges.riseX[last];
      }
      for (std::size_t k = first; k <= last; ++k)
      {
        if (k + columns < map.GetSize())
        {
          touch(k + columns, heights[k] + edges.riseY[k]);
        }
        if (k >= columns)
        {
          touch(k - columns, heights[k] - edges.riseY[k - columns]);
        }
      }
    }
  }
  return heights;
}

}
