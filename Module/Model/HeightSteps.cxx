// SPDX-License-Identifier: BSD-3-Clause
#include "HeightSteps.h"

#include "HeightReader.h"
#include "HeightTypes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <vector>

namespace relief
{

namespace
{

constexpr float Half = 0.4999f; // what is rounded on the way out stays within half a step
constexpr float Flank = 1.5f;   // neighbours farther apart, in steps, are not smoothed across
constexpr int Sweeps = 24;      // at each size of blocks
constexpr std::int64_t MostSamples = std::int64_t(1) << 20;
constexpr std::size_t FewLevels = 256;
constexpr std::size_t ManySamples = 10000;

// How far the samples that are looked at lie apart.
int Apart(int columns, int rows)
{
  int apart = 1;
  while (((columns - 1) / apart + std::int64_t(1)) * ((rows - 1) / apart + 1) > MostSamples)
  {
    ++apart;
  }
  return apart;
}

// The field, or means over its blocks, in steps: what is stored and how it is smoothed. A link is
// how much a sample and its neighbour to the right, or above, draw each other.
struct Level
{
  int columns;
  int rows;
  std::vector<float> stored; // NaN without data
  std::vector<float> smooth;
  std::vector<float> linkX;
  std::vector<float> linkY;

  Level(int width, int height)
    : columns(width)
    , rows(height)
    , stored(static_cast<std::size_t>(width) * height, std::numeric_limits<float>::quiet_NaN())
    , linkX(this->stored.size(), 0.0f)
    , linkY(this->stored.size(), 0.0f)
  {
  }

  std::size_t At(int i, int j) const { return static_cast<std::size_t>(j) * this->columns + i; }
};

void ForRows(const ParallelFor& parallelFor, int rows, const std::function<void(int)>& body)
{
  parallelFor(rows,
    [&body](int begin, int end)
    {
      for (int j = begin; j < end; ++j)
      {
        body(j);
      }
    });
}

// Links of the field itself.
void Connect(Level& level, const ParallelFor& parallelFor)
{
  // False for NaN.
  const auto near = [](float a, float b) { return std::abs(a - b) <= Flank ? 1.0f : 0.0f; };
  ForRows(parallelFor, level.rows,
    [&](int j)
    {
      for (int i = 0; i < level.columns; ++i)
      {
        const std::size_t at = level.At(i, j);
        const float here = level.stored[at];
        level.linkX[at] = i + 1 < level.columns ? near(here, level.stored[at + 1]) : 0.0f;
        level.linkY[at] = j + 1 < level.rows ? near(here, level.stored[level.At(i, j + 1)]) : 0.0f;
      }
    });
}

// The mean of a block of 2 x 2; NaN where data lack or a flank runs through it.
float MeanOf(const Level& fine, int x, int y)
{
  const int width = std::min(2, fine.columns - x);
  const int height = std::min(2, fine.rows - y);
  float sum = 0.0f;
  bool whole = true;
  for (int b = 0; b < height; ++b)
  {
    for (int a = 0; a < width; ++a)
    {
      const std::size_t at = fine.At(x + a, y + b);
      sum += fine.stored[at];
      whole = whole && (a + 1 == width || fine.linkX[at] > 0.0f) &&
        (b + 1 == height || fine.linkY[at] > 0.0f);
    }
  }
  return whole ? sum / static_cast<float>(width * height) : std::numeric_limits<float>::quiet_NaN();
}

// The mean of the links that lead from a block to the next one along an axis.
float LinkOf(const Level& fine, int x, int y, bool alongX)
{
  const std::vector<float>& links = alongX ? fine.linkX : fine.linkY;
  const int lastX = alongX ? x + 1 : std::min(x + 1, fine.columns - 1);
  const int lastY = alongX ? std::min(y + 1, fine.rows - 1) : y + 1;
  return 0.5f *
    (links[alongX ? fine.At(lastX, y) : fine.At(x, lastY)] + links[fine.At(lastX, lastY)]);
}

Level Coarser(const Level& fine, const ParallelFor& parallelFor)
{
  Level coarse((fine.columns + 1) / 2, (fine.rows + 1) / 2);
  ForRows(parallelFor, coarse.rows,
    [&](int j)
    {
      for (int i = 0; i < coarse.columns; ++i)
      {
        coarse.stored[coarse.At(i, j)] = MeanOf(fine, 2 * i, 2 * j);
      }
    });
  ForRows(parallelFor, coarse.rows,
    [&](int j)
    {
      for (int i = 0; i < coarse.columns; ++i)
      {
        // Differences are NaN where either block lacks.
        const std::size_t at = coarse.At(i, j);
        const float here = coarse.stored[at];
        if (i + 1 < coarse.columns && !std::isnan(coarse.stored[at + 1] - here))
        {
          coarse.linkX[at] = LinkOf(fine, 2 * i, 2 * j, true);
        }
        if (j + 1 < coarse.rows && !std::isnan(coarse.stored[coarse.At(i, j + 1)] - here))
        {
          coarse.linkY[at] = LinkOf(fine, 2 * i, 2 * j, false);
        }
      }
    });
  return coarse;
}

// One sample takes the mean of those that draw it, as far as its half step goes. Along an axis it
// is drawn from both sides or not at all, so that borders do not become level.
void Relax(Level& level, int i, int j)
{
  const std::size_t at = level.At(i, j);
  const std::size_t pitch = static_cast<std::size_t>(level.columns);
  float weight = 0.0f;
  float sum = 0.0f;
  const auto add = [&](const std::vector<float>& links, bool inside, std::size_t step)
  {
    const float link = inside ? std::min(links[at], links[at - step]) : 0.0f;
    if (link > 0.0f)
    {
      weight += 2.0f * link;
      sum += link * (level.smooth[at - step] + level.smooth[at + step]);
    }
  };
  add(level.linkX, i > 0, 1);
  add(level.linkY, j > 0, pitch);
  if (weight > 0.0f)
  {
    const float stored = level.stored[at];
    level.smooth[at] = std::clamp(sum / weight, stored - Half, stored + Half);
  }
}

// Every other sample at a time, like the squares of a chessboard: those of one colour depend on the
// other colour only.
void Relax(Level& level, const ParallelFor& parallelFor)
{
  for (int half = 0; half < 2 * Sweeps; ++half)
  {
    ForRows(parallelFor, level.rows,
      [&](int j)
      {
        for (int i = (j + half) % 2; i < level.columns; i += 2)
        {
          Relax(level, i, j);
        }
      });
  }
}

// Between the centres of the coarse blocks that are linked.
float Between(const Level& coarse, int i, int j)
{
  const int x = i / 2;
  const int y = j / 2;
  const std::size_t at = coarse.At(x, y);
  const std::size_t pitch = static_cast<std::size_t>(coarse.columns);
  const auto follows = [](const std::vector<float>& links, std::size_t from, bool inside)
  { return inside && links[from] > 0.0f; };
  const bool right = i % 2 == 1;
  const bool up = j % 2 == 1;
  const float value = coarse.smooth[at];
  float result = value;
  if (right ? follows(coarse.linkX, at, true) : follows(coarse.linkX, at - 1, x > 0))
  {
    result += 0.25f * (coarse.smooth[right ? at + 1 : at - 1] - value);
  }
  if (up ? follows(coarse.linkY, at, true) : follows(coarse.linkY, at - pitch, y > 0))
  {
    result += 0.25f * (coarse.smooth[up ? at + pitch : at - pitch] - value);
  }
  return result;
}

void StartFrom(const Level& coarse, Level& fine, const ParallelFor& parallelFor)
{
  fine.smooth = fine.stored;
  ForRows(parallelFor, fine.rows,
    [&](int j)
    {
      for (int i = 0; i < fine.columns; ++i)
      {
        const std::size_t at = fine.At(i, j);
        const float start = Between(coarse, i, j);
        const float stored = fine.stored[at];
        if (std::isfinite(start) && std::isfinite(stored))
        {
          fine.smooth[at] = std::clamp(start, stored - Half, stored + Half);
        }
      }
    });
}

}

//------------------------------------------------------------------------------
template <class T>
HeightSteps FindHeightSteps(const HeightSource<T>& source)
{
  const HeightReader<T> reader(source);
  const int apart = Apart(source.columns, source.rows);
  std::vector<double> heights;
  for (int j = 0; j < source.rows; j += apart)
  {
    for (int i = 0; i < source.columns; i += apart)
    {
      double height = 0.0;
      if (reader.ReadStored(i, j, height))
      {
        heights.push_back(height);
      }
    }
  }
  HeightSteps found;
  found.samples = heights.size();
  std::sort(heights.begin(), heights.end());
  heights.erase(std::unique(heights.begin(), heights.end()), heights.end());
  found.levels = heights.size();
  for (std::size_t k = 1; k < heights.size(); ++k)
  {
    const double step = heights[k] - heights[k - 1];
    found.step = found.step > 0.0 ? std::min(found.step, step) : step;
  }
  return found;
}

//------------------------------------------------------------------------------
template <class T, class Out>
void SmoothHeightSteps(
  const HeightSource<T>& source, double step, const ParallelFor& parallelFor, Out* result)
{
  // Steps are counted from a height of the field, which may lie high.
  const HeightReader<T> reader(source);
  double first = 0.0;
  bool any = false;
  for (int j = 0; j < source.rows && !any; ++j)
  {
    for (int i = 0; i < source.columns && !any; ++i)
    {
      any = reader.ReadStored(i, j, first);
    }
  }
  std::vector<Level> levels;
  levels.emplace_back(source.columns, source.rows);
  ForRows(parallelFor, source.rows,
    [&](int j)
    {
      for (int i = 0; i < source.columns; ++i)
      {
        double height = 0.0;
        if (reader.ReadStored(i, j, height))
        {
          levels[0].stored[levels[0].At(i, j)] = static_cast<float>((height - first) / step);
        }
      }
    });
  Connect(levels[0], parallelFor);

  // From the coarsest blocks down to the samples.
  while (std::max(levels.back().columns, levels.back().rows) > 4)
  {
    levels.push_back(Coarser(levels.back(), parallelFor));
  }
  levels.back().smooth = levels.back().stored;
  for (std::size_t k = levels.size(); k-- > 0;)
  {
    Relax(levels[k], parallelFor);
    if (k > 0)
    {
      StartFrom(levels[k], levels[k - 1], parallelFor);
      levels.pop_back();
    }
  }

  // What lies in the half step of a large height is told from that height.
  const Level& field = levels[0];
  ForRows(parallelFor, source.rows,
    [&](int j)
    {
      for (int i = 0; i < source.columns; ++i)
      {
        const std::size_t at = field.At(i, j);
        double height = 0.0;
        const bool data = reader.ReadStored(i, j, height);
        const double moved = static_cast<double>(field.smooth[at]) - field.stored[at];
        result[at] = data ? static_cast<Out>(height + step * std::clamp(moved, -0.5, 0.5))
                          : std::numeric_limits<Out>::quiet_NaN();
      }
    });
}

//------------------------------------------------------------------------------
// Whether there are more heights than that: most fields tell it by a few of their samples.
template <class T>
bool HasMoreLevels(const HeightSource<T>& source, std::size_t most)
{
  const HeightReader<T> reader(source);
  const int apart = Apart(source.columns, source.rows);
  std::vector<double> levels; // in order
  for (int j = 0; j < source.rows; j += apart)
  {
    double last = std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i < source.columns; i += apart)
    {
      double height = 0.0;
      if (!reader.ReadStored(i, j, height) || height == last)
      {
        continue;
      }
      last = height;
      const auto place = std::lower_bound(levels.begin(), levels.end(), height);
      if (place == levels.end() || *place != height)
      {
        levels.insert(place, height);
      }
      if (levels.size() > most)
      {
        return true;
      }
    }
  }
  return false;
}

//------------------------------------------------------------------------------
template <class T>
bool ShowsTerraces(const HeightSource<T>& source)
{
  if (HasMoreLevels(source, FewLevels))
  {
    return false;
  }
  const HeightSteps steps = FindHeightSteps(source);
  if (steps.levels < 3 || steps.samples <= ManySamples)
  {
    return false;
  }
  const HeightReader<T> reader(source);
  const int apart = Apart(source.columns, source.rows);
  std::int64_t same = 0;
  std::int64_t single = 0;
  std::int64_t more = 0;
  for (int j = 0; j < source.rows; j += apart)
  {
    for (int i = 0; i + 1 < source.columns; i += apart)
    {
      double a = 0.0;
      double b = 0.0;
      if (reader.ReadStored(i, j, a) && reader.ReadStored(i + 1, j, b))
      {
        const double steep = std::abs(a - b) / steps.step;
        ++(steep < 0.5 ? same : steep < Flank ? single : more);
      }
    }
  }
  return same > single + more && single > 4 * more && single > 0;
}

#define RELIEF_INSTANTIATE(T)                                                                      \
  template bool ShowsTerraces(const HeightSource<T>&);                                             \
  template HeightSteps FindHeightSteps(const HeightSource<T>&);                                    \
  template void SmoothHeightSteps(                                                                 \
    const HeightSource<T>&, double, const ParallelFor&, float* result);                            \
  template void SmoothHeightSteps(                                                                 \
    const HeightSource<T>&, double, const ParallelFor&, double* result)
RELIEF_FOR_HEIGHT_TYPES(RELIEF_INSTANTIATE);
#undef RELIEF_INSTANTIATE

}
