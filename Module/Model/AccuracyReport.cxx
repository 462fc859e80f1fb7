// SPDX-License-Identifier: BSD-3-Clause
#include "AccuracyReport.h"

#include "EffectPlan.h"
#include "IlluminationCheck.h"
#include "ReferenceIllumination.h"
#include "SceneShading.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <limits>
#include <random>

namespace relief
{

namespace
{
constexpr double Tolerances[] = { 0.0, 0.0001, 0.0003, 0.001, 0.003, 0.01, 0.03, 0.1 };
constexpr int FewestSteps = 8;
constexpr int MostSteps = 1024;

// Turns. Fixed steps, which take long and differ by factors, run in every third only.
constexpr int Repetitions = 9;
constexpr int TurnsOfSteps = 3;

// What a run may do: rays of the exact integrator, points of fixed steps, and points at which steps
// are left out. A run takes a fraction of a second then, and steps a second or two.
constexpr std::size_t RaysOfRun = std::size_t{ 1 } << 19;
constexpr std::size_t PointsOfRun = std::size_t{ 1 } << 24;
constexpr std::size_t MostPointsOfRun = std::size_t{ 1 } << 26;
// And the fewest tiles that stand for a field.
constexpr std::size_t FewestTiles = 16;

// Samples to compare, and cells that the reference may visit for them.
constexpr std::size_t MostProbes = std::size_t{ 1 } << 15;
constexpr std::size_t FewestProbes = 1024;
constexpr std::uint64_t CellsOfReference = std::uint64_t{ 1 } << 28;

// How much quicker a setting must be to count as quicker.
constexpr double Quicker = 1.1;

// Processor time of the calling thread, where the system tells it.
double ThreadSeconds()
{
#ifdef CLOCK_THREAD_CPUTIME_ID
  timespec now;
  if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) == 0)
  {
    return static_cast<double>(now.tv_sec) + 1.0e-9 * static_cast<double>(now.tv_nsec);
  }
#endif
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// How many lights are traced.
std::size_t CountLights(const HeightField& field, const Scene& scene)
{
  const EffectPlan plan = PlanEffects(field, scene);
  const auto count = std::count_if(plan.lights.begin(), plan.lights.end(),
    [](const LightPlan& light) { return light.lit && !light.dark; });
  return std::max<std::size_t>(static_cast<std::size_t>(count), 1);
}

std::size_t CountData(const HeightView<float>& heights, int column, int row)
{
  constexpr int width = SweepThickness::TileWidth;
  constexpr int height = SweepThickness::TileHeight;
  std::size_t count = 0;
  for (int j = row * height; j < std::min((row + 1) * height, heights.rows); ++j)
  {
    for (int i = column * width; i < std::min((column + 1) * width, heights.columns); ++i)
    {
      count += std::isnan(heights.At(i, j)) ? 0 : 1;
    }
  }
  return count;
}
}

AccuracyReport::AccuracyReport(const HeightField& field, const Scene& scene, std::uint64_t seed)
  : Heights(field)
  , Shown(scene)
{
  this->FindTiles(seed);
  this->DrawProbes(seed);
  if (!this->Tiles.empty())
  {
    this->ListPoints();
  }
}

// Tiles with data that are spread over the field, as many as a run may shade, and then in a random
// order: any number of the first of them are spread over the field as well.
void AccuracyReport::FindTiles(std::uint64_t seed)
{
  const HeightView<float>& heights = this->Heights.GetField().heights;
  const int columns = (heights.columns + SweepThickness::TileWidth - 1) / SweepThickness::TileWidth;
  const int rows = (heights.rows + SweepThickness::TileHeight - 1) / SweepThickness::TileHeight;
  std::vector<std::pair<int, int>> tiles;
  std::vector<std::size_t> counts;
  for (int row = 0; row < rows; ++row)
  {
    for (int column = 0; column < columns; ++column)
    {
      const std::size_t count = CountData(heights, column, row);
      this->NumberOfSamples += count;
      if (count > 0)
      {
        tiles.emplace_back(column, row);
        counts.push_back(count);
      }
    }
  }
  const std::size_t lights = CountLights(this->Heights, this->Shown);
  const std::size_t most = std::max(RaysOfRun / (SweepThickness::TileSize * lights), FewestTiles);
  const std::size_t count = std::min(most, tiles.size());
  std::mt19937_64 random(seed);
  std::vector<std::size_t> order(count);
  for (std::size_t k = 0; k < count; ++k)
  {
    // One of each stretch of tiles, row by row.
    const std::size_t begin = tiles.size() * k / count;
    const std::size_t end = tiles.size() * (k + 1) / count;
    order[k] = begin + static_cast<std::size_t>(random() % (end - begin));
  }
  for (std::size_t k = 0; k < count; ++k)
  {
    std::swap(order[k], order[k + static_cast<std::size_t>(random() % (count - k))]);
    this->Tiles.push_back(tiles[order[k]]);
    this->Counts.push_back(counts[order[k]]);
  }
}

// Samples of all tiles, one of each in turn.
void AccuracyReport::DrawProbes(std::uint64_t seed)
{
  const HeightView<float>& heights = this->Heights.GetField().heights;
  constexpr int width = SweepThickness::TileWidth;
  const std::size_t wanted =
    this->Tiles.empty() ? 0 : (MostProbes + this->Tiles.size() - 1) / this->Tiles.size();
  std::vector<std::vector<std::size_t>> drawn;
  for (const auto& [column, row] : this->Tiles)
  {
    const auto hasData = [&, column = column, row = row](std::size_t at)
    {
      const int i = column * width + static_cast<int>(at) % width;
      const int j = row * SweepThickness::TileHeight + static_cast<int>(at) / width;
      return i < heights.columns && j < heights.rows && !std::isnan(heights.At(i, j));
    };
    drawn.push_back(
      DrawSamples(SweepThickness::TileSize, wanted, seed + drawn.size() + 1, hasData));
  }
  for (std::size_t round = 0; round < wanted; ++round)
  {
    for (std::size_t tile = 0; tile < drawn.size(); ++tile)
    {
      if (round < drawn[tile].size())
      {
        const int at = static_cast<int>(drawn[tile][round]);
        const auto& [column, row] = this->Tiles[tile];
        this->Probes.push_back(
          { tile, column * width + at % width, row * SweepThickness::TileHeight + at / width,
            std::numeric_limits<double>::quiet_NaN() });
      }
    }
  }
}

void AccuracyReport::ListPoints()
{
  const bool exact = this->Shown.integrator == Integrator::Exact;
  const double own = this->Shown.medium.tolerance;
  std::vector<double> tolerances(std::begin(Tolerances), std::end(Tolerances));
  std::vector<int> steps;
  const std::size_t lights = CountLights(this->Heights, this->Shown);
  const std::size_t fewest = std::min(FewestTiles, this->Tiles.size());
  for (int count = FewestSteps; count <= MostSteps; count *= 2)
  {
    const std::size_t points = fewest * SweepThickness::TileSize * lights * count;
    if (points <= MostPointsOfRun)
    {
      steps.push_back(count);
    }
  }
  if (exact)
  {
    tolerances.push_back(own);
  }
  else
  {
    steps.push_back(this->Shown.steps);
  }
  std::sort(tolerances.begin(), tolerances.end());
  tolerances.erase(std::unique(tolerances.begin(), tolerances.end()), tolerances.end());
  std::sort(steps.begin(), steps.end());
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  for (const double tolerance : tolerances)
  {
    AccuracyPoint point;
    point.tolerance = tolerance;
    point.present = exact && tolerance == own;
    this->Points.push_back(point);
    this->TilesOf.push_back(this->Tiles.size());
  }
  for (const int count : steps)
  {
    AccuracyPoint point;
    point.integrator = Integrator::FixedStep;
    point.steps = count;
    point.present = !exact && count == this->Shown.steps;
    this->Points.push_back(point);
    const std::size_t affordable =
      PointsOfRun / (SweepThickness::TileSize * lights * static_cast<std::size_t>(count));
    this->TilesOf.push_back(std::clamp(affordable, fewest, this->Tiles.size()));
  }
}

// Block by block, until the reference has done what it may; what is left over is not compared.
bool AccuracyReport::TraceProbes(const ParallelFor& parallelFor, const Progress& progress)
{
  const ReferenceIllumination reference(this->Heights, this->Shown);
  std::uint64_t cells = 0;
  std::size_t done = 0;
  while (done < this->Probes.size() && (done < FewestProbes || cells < CellsOfReference))
  {
    const std::size_t count = std::min<std::size_t>(256, this->Probes.size() - done);
    std::vector<std::uint64_t> visited(count, 0);
    parallelFor(static_cast<int>(count),
      [&](int begin, int end)
      {
        for (int k = begin; k < end; ++k)
        {
          Probe& probe = this->Probes[done + static_cast<std::size_t>(k)];
          probe.exact = reference.At(probe.i, probe.j, visited[static_cast<std::size_t>(k)]);
        }
      });
    for (const std::uint64_t number : visited)
    {
      cells += number;
    }
    done += count;
    if (!progress(std::max(static_cast<double>(done) / static_cast<double>(this->Probes.size()),
          std::min(static_cast<double>(cells) / CellsOfReference, 1.0))))
    {
      return false;
    }
  }
  this->Probes.resize(done);
  return true;
}

// Shades the tiles of a point. `illumination` gets the tiles' values one after another.
bool AccuracyReport::Run(std::size_t index, std::vector<float>& illumination, double& seconds,
  const std::function<bool()>& goOn) const
{
  constexpr int width = SweepThickness::TileWidth;
  constexpr int height = SweepThickness::TileHeight;
  const AccuracyPoint& point = this->Points[index];
  Scene scene = this->Shown;
  scene.integrator = point.integrator;
  scene.medium.tolerance = point.tolerance;
  scene.steps = point.steps > 0 ? point.steps : scene.steps;

  // Arrays whose rows are a tile wide: the samples of a tile have places of their own there, and
  // those of the tiles before, which are taken out by then, are written over.
  const HeightView<float>& heights = this->Heights.GetField().heights;
  const std::size_t places = static_cast<std::size_t>(width) * heights.rows + heights.columns;
  std::vector<float> values(places);
  std::vector<unsigned char> colors(4 * places);
  Target target;
  target.width = width;
  target.rows = heights.rows;
  target.illumination = values.data();
  target.rgba8 = colors.data();
  SceneShading shading(this->Heights, scene, target);

  illumination.assign(this->TilesOf[index] * SweepThickness::TileSize, 0.0f);
  seconds = 0.0;
  for (std::size_t k = 0; k < this->TilesOf[index]; ++k)
  {
    const auto& [column, row] = this->Tiles[k];
    const int i0 = column * width;
    const int j0 = row * height;
    const int i1 = std::min(i0 + width, heights.columns);
    const int j1 = std::min(j0 + height, heights.rows);
    const double start = ThreadSeconds();
    shading.Shade(i0, i1, j0, j1);
    seconds += ThreadSeconds() - start;
    for (int j = j0; j < j1; ++j)
    {
      std::copy_n(values.data() + static_cast<std::size_t>(j) * width + i0, i1 - i0,
        illumination.data() + k * SweepThickness::TileSize +
          static_cast<std::size_t>(j - j0) * width);
    }
    if (k % 16 == 0 && !goOn())
    {
      return false;
    }
  }
  return true;
}

void AccuracyReport::Compare(const std::vector<float>& illumination, AccuracyPoint& point) const
{
  constexpr int width = SweepThickness::TileWidth;
  std::vector<double> errors;
  for (const Probe& probe : this->Probes)
  {
    const auto& [column, row] = this->Tiles[probe.tile];
    const std::size_t at = probe.tile * SweepThickness::TileSize +
      static_cast<std::size_t>(
        (probe.j - row * SweepThickness::TileHeight) * width + probe.i - column * width);
    if (at < illumination.size())
    {
      errors.push_back(std::abs(static_cast<double>(illumination[at]) - probe.exact));
    }
  }
  point.compared = errors.size();
  if (errors.empty())
  {
    return;
  }
  double squares = 0.0;
  for (const double error : errors)
  {
    point.most = std::max(point.most, error);
    squares += error * error;
  }
  point.rms = std::sqrt(squares / static_cast<double>(errors.size()));
  // The least that 99.9 % do not exceed.
  const auto kept =
    static_cast<std::ptrdiff_t>(std::ceil(0.999 * static_cast<double>(errors.size()))) - 1;
  std::nth_element(errors.begin(), errors.begin() + kept, errors.end());
  point.mostOf999 = errors[static_cast<std::size_t>(kept)];
}

bool AccuracyReport::Measure(const ParallelFor& parallelFor, const Progress& progress)
{
  // The reference counts as much as a turn.
  const double turns = Repetitions + 2;
  if (this->Points.empty() ||
    !this->TraceProbes(parallelFor, [&](double share) { return progress(share / turns); }))
  {
    return false;
  }
  std::vector<float> illumination;
  std::vector<double> least(this->Points.size(), std::numeric_limits<double>::infinity());
  // The first turn warms up, and its results are compared.
  for (int turn = 0; turn <= Repetitions; ++turn)
  {
    for (std::size_t k = 0; k < this->Points.size(); ++k)
    {
      const double done = (turn + 1 + static_cast<double>(k) / this->Points.size()) / turns;
      const bool rests = this->Points[k].integrator == Integrator::FixedStep;
      if (rests && turn % TurnsOfSteps != 0)
      {
        continue;
      }
      double seconds = 0.0;
      if (!this->Run(k, illumination, seconds, [&] { return progress(done); }))
      {
        return false;
      }
      if (turn == 0)
      {
        this->Compare(illumination, this->Points[k]);
      }
      else
      {
        least[k] = std::min(least[k], seconds);
      }
    }
  }
  for (std::size_t k = 0; k < this->Points.size(); ++k)
  {
    AccuracyPoint& point = this->Points[k];
    for (std::size_t tile = 0; tile < this->TilesOf[k]; ++tile)
    {
      point.timed += this->Counts[tile];
    }
    const double perSample = least[k] / static_cast<double>(point.timed);
    point.nanoseconds = 1.0e9 * perSample;
    point.seconds = perSample * static_cast<double>(this->NumberOfSamples);
  }
  return progress(1.0);
}

double AccuracyReport::GetVisibleError() const
{
  double brightness = 0.0;
  for (const Light& light : this->Shown.lights)
  {
    const glm::dvec3& c = light.color;
    brightness += std::abs(light.intensity * light.weight) * light.open *
      std::max({ std::abs(c.x), std::abs(c.y), std::abs(c.z) });
  }
  brightness *= f64::reliefExposureFactor(this->Shown.exposure);
  // sRGB begins with 12.92 * 255 steps for 1.
  return 1.0 / (12.92 * 255.0 * std::max(brightness, 1.0));
}

std::size_t AccuracyReport::GetRecommended() const
{
  const double visible = this->GetVisibleError();
  // Tolerances come first, and the first of them is 0, which promises all that there is.
  const auto good = [&](const AccuracyPoint& point)
  {
    return point.integrator == Integrator::Exact &&
      (point.tolerance == 0.0 || point.mostOf999 <= visible);
  };
  double quickest = std::numeric_limits<double>::infinity();
  for (const AccuracyPoint& point : this->Points)
  {
    quickest = good(point) ? std::min(quickest, point.nanoseconds) : quickest;
  }
  const auto found = std::find_if(this->Points.begin(), this->Points.end(),
    [&](const AccuracyPoint& point)
    { return good(point) && point.nanoseconds <= Quicker * quickest; });
  return found != this->Points.end() ? static_cast<std::size_t>(found - this->Points.begin()) : 0;
}

}
