// SPDX-License-Identifier: BSD-3-Clause
#include "BenchmarkTerrain.h"

#include "MedallionHeights.h"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkTIFFReader.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <iostream>

namespace bench
{

namespace
{
constexpr double TileSpacingX = 74.6; // metres, Examples/Data/README.md
constexpr double TileSpacingY = 92.5;
constexpr double Degree = 3.14159265358979323846 / 180.0;

// The longest wavelength of the added detail, about what the smoothed tile still shows; and its
// amplitude, by which the slopes at TerrainSpacing are 17 degrees on average.
constexpr double DetailWavelength = 300.0;
constexpr double DetailAmplitude = 26.0;

struct Tile
{
  int columns = 0;
  int rows = 0;
  std::vector<float> heights;
};

const Tile& ExampleTile()
{
  static const Tile tile = []
  {
    vtkNew<vtkTIFFReader> reader;
    reader->SetFileName(RELIEF_EXAMPLES_FOLDER "/Data/jacksboro.tif");
    reader->SetOrientationType(4); // the southernmost row first
    reader->Update();
    vtkImageData* image = reader->GetOutput();
    Tile read;
    read.columns = image->GetDimensions()[0];
    read.rows = image->GetDimensions()[1];
    if (read.columns < 2 || read.rows < 2)
    {
      std::cerr << "cannot read " << reader->GetFileName() << "\n";
      std::exit(EXIT_FAILURE);
    }
    for (int j = 0; j < read.rows; ++j)
    {
      for (int i = 0; i < read.columns; ++i)
      {
        read.heights.push_back(static_cast<float>(image->GetScalarComponentAsDouble(i, j, 0, 0)));
      }
    }
    return read;
  }();
  return tile;
}

// A sample's index, mirrored into [0, count).
int Mirror(int i, int count)
{
  const int period = 2 * (count - 1);
  i = ((i % period) + period) % period;
  return i < count ? i : period - i;
}

// The four samples, from i - 1 on, and their weights, of a uniform cubic B-spline.
struct Spline
{
  int index[4];
  double weight[4];

  Spline(double x, int count)
  {
    const int i = static_cast<int>(std::floor(x));
    const double u = x - i;
    const double v = 1.0 - u;
    this->weight[0] = v * v * v / 6.0;
    this->weight[1] = 2.0 / 3.0 - u * u * (2.0 - u) / 2.0;
    this->weight[2] = 2.0 / 3.0 - v * v * (2.0 - v) / 2.0;
    this->weight[3] = u * u * u / 6.0;
    for (int k = 0; k < 4; ++k)
    {
      this->index[k] = Mirror(i - 1 + k, count);
    }
  }
};

// A number in [0, 1) that looks random (Steele, Lea and Flood 2014, the finalizer of SplitMix64).
double Hash(std::int64_t i, std::int64_t j, std::uint64_t seed)
{
  std::uint64_t z = seed * 0x9e3779b97f4a7c15u +
    static_cast<std::uint64_t>(i) * 0xd1b54a32d192ed03u +
    static_cast<std::uint64_t>(j) * 0xabc98388fb8fac03u;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  z ^= z >> 31;
  return static_cast<double>(z >> 11) * 0x1p-53;
}

double Fade(double u)
{
  return u * u * u * (u * (6.0 * u - 15.0) + 10.0);
}

// Random values on a lattice, blended smoothly between, along a row of a relief.
void AddNoise(std::vector<double>& row, double x0, double spacing, double y, double wavelength,
  double amplitude, std::uint64_t seed)
{
  const double v = y / wavelength;
  const auto j = static_cast<std::int64_t>(std::floor(v));
  const double fade = Fade(v - static_cast<double>(j));
  auto value = [&](std::int64_t i)
  { return (1.0 - fade) * Hash(i, j, seed) + fade * Hash(i, j + 1, seed); };
  auto last = static_cast<std::int64_t>(std::floor(x0 / wavelength));
  double left = value(last);
  double right = value(last + 1);
  for (std::size_t k = 0; k < row.size(); ++k)
  {
    const double u = (x0 + static_cast<double>(k) * spacing) / wavelength;
    const auto i = static_cast<std::int64_t>(std::floor(u));
    if (i != last)
    {
      left = i == last + 1 ? right : value(i);
      right = value(i + 1);
      last = i;
    }
    const double t = Fade(u - static_cast<double>(i));
    row[k] += amplitude * (2.0 * (left + t * (right - left)) - 1.0);
  }
}

Relief Make(const char* name, int columns, int rows, double spacing)
{
  Relief relief;
  relief.name = name;
  relief.columns = columns;
  relief.rows = rows;
  relief.spacing = spacing;
  relief.heights.resize(static_cast<std::size_t>(columns) * rows);
  return relief;
}

template <class F>
void Fill(Relief& relief, F&& f)
{
  for (int j = 0; j < relief.rows; ++j)
  {
    for (int i = 0; i < relief.columns; ++i)
    {
      relief.heights[static_cast<std::size_t>(j) * relief.columns + i] =
        static_cast<float>(f(i, j));
    }
  }
}
}

Relief Terrain(int columns, int rows, double spacing, int first)
{
  const Tile& tile = ExampleTile();
  Relief relief = Make("terrain", columns, rows, spacing);
  std::vector<Spline> across;
  for (int i = 0; i < columns; ++i)
  {
    across.emplace_back((first + i) * spacing / TileSpacingX, tile.columns);
  }
  std::vector<double> line(tile.columns);
  std::vector<double> row(columns);
  for (int j = 0; j < rows; ++j)
  {
    const double y = (first + j) * spacing;
    const Spline along(y / TileSpacingY, tile.rows);
    for (int i = 0; i < tile.columns; ++i)
    {
      line[i] = 0.0;
      for (int k = 0; k < 4; ++k)
      {
        line[i] += along.weight[k] *
          tile.heights[static_cast<std::size_t>(along.index[k]) * tile.columns + i];
      }
    }
    for (int i = 0; i < columns; ++i)
    {
      row[i] = 0.0;
      for (int k = 0; k < 4; ++k)
      {
        row[i] += across[i].weight[k] * line[across[i].index[k]];
      }
    }
    double amplitude = DetailAmplitude;
    std::uint64_t octave = 1;
    for (double wavelength = DetailWavelength; wavelength >= 2.0 * spacing; wavelength /= 2.0)
    {
      AddNoise(row, first * spacing, spacing, y, wavelength, amplitude, octave);
      amplitude /= 2.0;
      ++octave;
    }
    std::copy(
      row.begin(), row.end(), relief.heights.begin() + static_cast<std::ptrdiff_t>(j) * columns);
  }
  return relief;
}

Relief Medallion(int size)
{
  auto image = medallion::MakeHeights();
  const int first = std::max(medallion::Samples - size, 0) / 2;
  size = std::min(size, medallion::Samples);
  Relief relief = Make("medallion", size, size, medallion::Spacing);
  Fill(relief,
    [&](int i, int j)
    { return *static_cast<const float*>(image->GetScalarPointer(first + i, first + j, 0)); });
  return relief;
}

Relief City(int columns, int rows)
{
  Relief relief = Make("city", columns, rows, 1.0);
  constexpr int block = 64;
  constexpr int street = 12;
  constexpr int lot = 13; // four lots of 13 m along a block
  Fill(relief,
    [](int i, int j)
    {
      const double ground = 6.0 * std::sin(i / 190.0) * std::cos(j / 230.0);
      const int x = i % block - street;
      const int y = j % block - street;
      if (x < 0 || y < 0)
      {
        return ground;
      }
      const std::int64_t houseX = static_cast<std::int64_t>(i / block) * 4 + x / lot;
      const std::int64_t houseY = static_cast<std::int64_t>(j / block) * 4 + y / lot;
      const double kind = Hash(houseX, houseY, 100);
      if (kind < 0.2)
      {
        return ground + 0.3 * Hash(i, j, 101); // a yard
      }
      const double storeys = std::floor(kind < 0.95 ? 1.0 + 7.0 * Hash(houseX, houseY, 102)
                                                    : 10.0 + 15.0 * Hash(houseX, houseY, 102));
      return 3.2 * storeys + 6.0;
    });
  return relief;
}

Relief Dome(int columns, int rows)
{
  Relief relief = Make("dome", columns, rows, 1.0);
  const double turn = 3.14159265358979323846;
  const double height = std::tan(20.0 * Degree) * std::min(columns, rows) / turn;
  Fill(relief,
    [&](int i, int j)
    { return height * std::sin(turn * i / (columns - 1)) * std::sin(turn * j / (rows - 1)); });
  return relief;
}

Relief WhiteNoise(int columns, int rows)
{
  Relief relief = Make("noise", columns, rows, 1.0);
  Fill(relief, [](int i, int j) { return 2.0 * Hash(i, j, 200); });
  return relief;
}

double MeanSlope(const Relief& relief)
{
  double sum = 0.0;
  std::size_t count = 0;
  for (int j = 1; j + 1 < relief.rows; ++j)
  {
    const float* here = relief.heights.data() + static_cast<std::size_t>(j) * relief.columns;
    for (int i = 1; i + 1 < relief.columns; ++i)
    {
      const double gx = (here[i + 1] - here[i - 1]) / (2.0 * relief.spacing);
      const double gy =
        (here[i + relief.columns] - here[i - relief.columns]) / (2.0 * relief.spacing);
      sum += std::atan(std::hypot(gx, gy));
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) / Degree : 0.0;
}

std::unique_ptr<relief::HeightField> Prepare(const Relief& relief, bool padded)
{
  relief::HeightSource<float> source;
  source.data = relief.heights.data();
  source.stepY = relief.columns;
  source.columns = relief.columns;
  source.rows = relief.rows;
  source.spacingX = relief.spacing;
  source.spacingY = relief.spacing;
  auto field = std::make_unique<relief::HeightField>();
  const std::string wrong = field->Assign(
    source, [](int count, const std::function<void(int, int)>& body) { body(0, count); }, padded);
  if (!wrong.empty())
  {
    std::cerr << wrong << "\n";
    std::exit(EXIT_FAILURE);
  }
  return field;
}

}
