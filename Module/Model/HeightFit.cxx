// SPDX-License-Identifier: BSD-3-Clause
#include "HeightFit.h"

#include "HeightReader.h"
#include "HeightTypes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace relief
{

namespace
{

// What the pictures of terrain, medallions, depth maps, textures and stepped reliefs were judged
// by.
constexpr double SteepSlope = 0.7; // 35 degrees
constexpr double FromShare = 0.7;  // the slopes between these quantiles become that steep
constexpr double ToShare = 0.8;
constexpr double GentleClimbs = 2.0;  // slopes that climb the relief fewer times across count less
constexpr double HighestRelief = 0.2; // of the longer side
constexpr double RangeTail = 0.02;    // of the heights at either end, which are not its relief

constexpr int MostBlocks = 512; // along an axis
constexpr int LeastEdge = 4;    // of a block, in samples
constexpr int FewBlocks = 8;    // blocks of small fields are smaller
constexpr int ReadAlong = 4;    // samples of a block along an axis

int BlockEdge(int samples, int longer)
{
  const int usual = std::max(LeastEdge, (longer + MostBlocks - 1) / MostBlocks);
  return std::clamp(samples / FewBlocks, 1, usual);
}

// The mean over the samples of a block that have data, and where they are on the mean.
struct Mean
{
  double x = 0.0;
  double y = 0.0;
  double height = std::numeric_limits<double>::quiet_NaN(); // without data
};

struct Gradient
{
  double x = 0.0;
  double y = 0.0;
};

// The field's blocks.
class Blocks
{
public:
  explicit Blocks(const SampledHeights& source)
    : Source(source)
    , EdgeX(BlockEdge(source.columns, std::max(source.columns, source.rows)))
    , EdgeY(BlockEdge(source.rows, std::max(source.columns, source.rows)))
    , Columns((source.columns + this->EdgeX - 1) / this->EdgeX)
    , Rows((source.rows + this->EdgeY - 1) / this->EdgeY)
    , Means(static_cast<std::size_t>(this->Columns) * this->Rows)
  {
  }

  int GetRows() const { return this->Rows; }
  void Measure(int row);
  std::vector<double> GetHeights() const;
  std::vector<double> GetSlopes() const;

private:
  Mean MeanOf(int column, int row) const;
  const Mean& At(int column, int row) const
  {
    return this->Means[static_cast<std::size_t>(row) * this->Columns + column];
  }

  const SampledHeights& Source;
  int EdgeX;
  int EdgeY;
  int Columns;
  int Rows;
  std::vector<Mean> Means;
};

Mean Blocks::MeanOf(int column, int row) const
{
  const int i0 = column * this->EdgeX;
  const int j0 = row * this->EdgeY;
  const int width = std::min(this->EdgeX, this->Source.columns - i0);
  const int height = std::min(this->EdgeY, this->Source.rows - j0);
  const int alongX = std::min(width, ReadAlong);
  const int alongY = std::min(height, ReadAlong);
  // Heights above the block's first, which keeps the digits of a small relief that lies high.
  int count = 0;
  double first = 0.0;
  double sum = 0.0;
  double sumX = 0.0;
  double sumY = 0.0;
  for (int b = 0; b < alongY; ++b)
  {
    const int j = j0 + static_cast<int>((2LL * b + 1) * height / (2LL * alongY));
    for (int a = 0; a < alongX; ++a)
    {
      const int i = i0 + static_cast<int>((2LL * a + 1) * width / (2LL * alongX));
      double value = 0.0;
      if (this->Source.read(i, j, value))
      {
        first = count == 0 ? value : first;
        sum += value - first;
        sumX += i;
        sumY += j;
        ++count;
      }
    }
  }
  Mean mean;
  if (count > 0)
  {
    mean.x = sumX / count * this->Source.spacingX;
    mean.y = sumY / count * this->Source.spacingY;
    mean.height = first + sum / count;
  }
  return mean;
}

void Blocks::Measure(int row)
{
  for (int column = 0; column < this->Columns; ++column)
  {
    this->Means[static_cast<std::size_t>(row) * this->Columns + column] = this->MeanOf(column, row);
  }
}

std::vector<double> Blocks::GetHeights() const
{
  std::vector<double> heights;
  for (const Mean& mean : this->Means)
  {
    if (std::isfinite(mean.height))
    {
      heights.push_back(mean.height);
    }
  }
  return heights;
}

// The gradient of the plane through three means; none where one lacks.
std::optional<Gradient> PlaneGradient(const Mean& corner, const Mean& alongX, const Mean& alongY)
{
  const double x1 = alongX.x - corner.x;
  const double y1 = alongX.y - corner.y;
  const double h1 = alongX.height - corner.height;
  const double x2 = alongY.x - corner.x;
  const double y2 = alongY.y - corner.y;
  const double h2 = alongY.height - corner.height;
  const double area = x1 * y2 - x2 * y1;
  const Gradient gradient{ (h1 * y2 - h2 * y1) / area, (x1 * h2 - x2 * h1) / area };
  const bool found = std::isfinite(gradient.x) && std::isfinite(gradient.y);
  return found ? std::optional<Gradient>(gradient) : std::nullopt;
}

// Between each four neighbouring means; where one lacks, between the others.
std::vector<double> Blocks::GetSlopes() const
{
  std::vector<double> slopes;
  for (int row = 0; row + 1 < this->Rows; ++row)
  {
    for (int column = 0; column + 1 < this->Columns; ++column)
    {
      const Mean& a = this->At(column, row);
      const Mean& b = this->At(column + 1, row);
      const Mean& c = this->At(column, row + 1);
      const Mean& d = this->At(column + 1, row + 1);
      const std::optional<Gradient> lower = PlaneGradient(a, b, c);
      const std::optional<Gradient> upper = PlaneGradient(d, c, b);
      if (lower && upper)
      {
        slopes.push_back(std::hypot(0.5 * (lower->x + upper->x), 0.5 * (lower->y + upper->y)));
      }
      else if (lower || upper)
      {
        const Gradient gradient = lower ? *lower : *upper;
        slopes.push_back(std::hypot(gradient.x, gradient.y));
      }
    }
  }
  return slopes;
}

// From the lowest height to the highest, few at either end left out if anything remains.
double ReliefOf(std::vector<double> heights)
{
  std::sort(heights.begin(), heights.end());
  const auto tail = static_cast<std::size_t>(RangeTail * static_cast<double>(heights.size()));
  const double usual = heights[heights.size() - 1 - tail] - heights[tail];
  return usual > 0.0 ? usual : heights.back() - heights.front();
}

// The geometric mean of the slopes between two quantiles, which no gap among them tears. A slope
// counts whole from `gentle` on. 0 if all are level.
double SteepSlopeOf(std::vector<double> slopes, double gentle)
{
  std::sort(slopes.begin(), slopes.end());
  const auto weight = [gentle](double slope) { return std::min(1.0, slope / gentle); };
  double all = 0.0;
  for (const double slope : slopes)
  {
    all += weight(slope);
  }
  double below = 0.0;
  double counted = 0.0;
  double sum = 0.0;
  for (const double slope : slopes)
  {
    const double above = below + weight(slope);
    const double part = std::min(above, ToShare * all) - std::max(below, FromShare * all);
    if (part > 0.0)
    {
      sum += part * std::log(slope);
      counted += part;
    }
    below = above;
  }
  return counted > 0.0 ? std::exp(sum / counted) : 0.0;
}

}

//------------------------------------------------------------------------------
double FitHeightScale(const SampledHeights& source, const ParallelFor& parallelFor)
{
  // Two blocks along each axis at least.
  if (source.columns < 2 || source.rows < 2)
  {
    return 0.0;
  }
  Blocks blocks(source);
  parallelFor(blocks.GetRows(),
    [&blocks](int begin, int end)
    {
      for (int row = begin; row < end; ++row)
      {
        blocks.Measure(row);
      }
    });

  // How high the field is, and how steep.
  std::vector<double> heights = blocks.GetHeights();
  std::vector<double> slopes = blocks.GetSlopes();
  const double relief = heights.empty() ? 0.0 : ReliefOf(std::move(heights));
  if (!(relief > 0.0))
  {
    return 0.0;
  }
  const double side =
    std::max((source.columns - 1) * source.spacingX, (source.rows - 1) * source.spacingY);
  const double steep = SteepSlopeOf(std::move(slopes), GentleClimbs * relief / side);
  const double scale = std::min(SteepSlope / steep, HighestRelief * side / relief);
  return std::isfinite(scale) ? scale : 0.0;
}

//------------------------------------------------------------------------------
template <class T>
double FitHeightScale(const HeightSource<T>& source, const ParallelFor& parallelFor)
{
  const HeightReader<T> reader(source);
  const SampledHeights samples{ source.columns, source.rows, source.spacingX, source.spacingY,
    [&reader](int i, int j, double& height) { return reader.ReadStored(i, j, height); } };
  return FitHeightScale(samples, parallelFor);
}

#define RELIEF_INSTANTIATE(T)                                                                      \
  template double FitHeightScale(const HeightSource<T>&, const ParallelFor&)
RELIEF_FOR_HEIGHT_TYPES(RELIEF_INSTANTIATE);
#undef RELIEF_INSTANTIATE

}
